/* Strikes from schedules: mirrored steps, periodic strides, free motions. */
#include "people/strikes.h"
#include "support/planar_walker.h"
#include "support/test.h"

/* foot 0 on the heel to 0.2 s, then flat to 0.6 s; foot 1 down to `early`, and again from `late` */
static int strikes_from(ambulo_ends ends, double early, double late, ambulo__strike *strikes) {
  ambulo_model *model = walker_create();
  ambulo_problem *problem = NULL;
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_contact contacts[] = {{.foot = 0, .mode = AMBULO_CONTACT_HEEL, .from = 0.0, .to = 0.2},
                               {.foot = 0, .mode = AMBULO_CONTACT_FLAT, .from = 0.2, .to = 0.6},
                               {.foot = 1, .mode = AMBULO_CONTACT_TOE, .from = 0.0, .to = early},
                               {.foot = 1, .mode = AMBULO_CONTACT_FLAT, .from = late, .to = 1.0}};
  d.model = model;
  d.contacts = contacts;
  d.contact_count = 4;
  d.ends = ends;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &problem), AMBULO_OK);
  assert_true(ambulo__most_strikes(problem) <= 16);
  int count = ambulo__strikes(problem, strikes);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
  return count;
}

static int strikes_of(ambulo_ends ends, double early, ambulo__strike *strikes) {
  return strikes_from(ends, early, 0.5, strikes);
}

/* a whole step: foot 1 lands at the last instant, as foot 0 does at the first; the mirror image of
 * that is the same strike of foot 1, and the end of the stride the beginning of the next. (Here
 * foot 1 also comes down on its toes at 0.) */
static void what_is_one_event_is_listed_once(void **state) {
  (void)state;
  static const int feet[] = {0, 1, 1, 0};
  static const double times[] = {0.0, 0.0, 1.0, 1.0};
  ambulo__strike s[16];
  assert_int_equal(strikes_from(AMBULO_ENDS_MIRRORED, 0.1, 1.0, s), 4);
  for (int i = 0; i < 4; i++) {
    assert_int_equal(s[i].foot, feet[i]);
    assert_close(s[i].time, times[i], 0.0);
  }
}

static void periodic(void **state) {
  (void)state;
  ambulo__strike s[16];
  assert_int_equal(strikes_of(AMBULO_ENDS_PERIODIC, 0.1, s), 2);
  assert_int_equal(s[0].foot, 0);
  assert_close(s[0].time, 0.0, 0.0);
  assert_int_equal(s[1].foot, 1);
  assert_close(s[1].time, 0.5, 0.0);
}

/* foot 1 ends on the ground, so foot 0 is down before the step; foot 1 strikes at 0.5 s and
 * its mirror image a step later */
static void mirrored(void **state) {
  (void)state;
  static const int feet[] = {1, 1, 0, 0};
  static const double times[] = {0.0, 0.5, 1.0, 1.5};
  ambulo__strike s[16];
  assert_int_equal(strikes_of(AMBULO_ENDS_MIRRORED, 0.1, s), 4);
  for (int i = 0; i < 4; i++) {
    assert_int_equal(s[i].foot, feet[i]);
    assert_close(s[i].time, times[i], 0.0);
  }
}

static void free_ends(void **state) {
  (void)state;
  ambulo__strike s[16];
  assert_int_equal(strikes_of(AMBULO_ENDS_FREE, 0.1, s), 1);
  assert_close(s[0].time, 0.5, 0.0);
}

/* a schedule may list the end of the cycle first: the strike stays at its beginning */
static void the_earlier_time_stays(void **state) {
  (void)state;
  ambulo_model *model = walker_create();
  ambulo_problem *problem = NULL;
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_contact contacts[] = {{.foot = 0, .mode = AMBULO_CONTACT_FLAT, .from = 1.0, .to = 1.0},
                               {.foot = 1, .mode = AMBULO_CONTACT_FLAT, .from = 0.3, .to = 0.9},
                               {.foot = 0, .mode = AMBULO_CONTACT_FLAT, .from = 0.0, .to = 0.4}};
  ambulo__strike s[16];
  d.model = model;
  d.contacts = contacts;
  d.contact_count = 3;
  d.ends = AMBULO_ENDS_PERIODIC;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &problem), AMBULO_OK);
  assert_int_equal(ambulo__strikes(problem, s), 2);
  assert_int_equal(s[0].foot, 0);
  assert_close(s[0].time, 0.0, 0.0);
  assert_int_equal(s[1].foot, 1);
  assert_close(s[1].time, 0.3, 0.0);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(periodic), cmocka_unit_test(mirrored), cmocka_unit_test(free_ends),
      cmocka_unit_test(the_earlier_time_stays), cmocka_unit_test(what_is_one_event_is_listed_once)};
  return cmocka_run_group_tests_name("stride/strikes", tests, NULL, NULL);
}
