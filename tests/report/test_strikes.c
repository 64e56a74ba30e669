/* Strikes from schedules: mirrored steps, periodic strides, free motions. */
#include "report/strikes.h"
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
  int count = ambulo__strikes(problem, strikes, 8);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
  return count;
}

static int strikes_of(ambulo_ends ends, double early, ambulo__strike *strikes) {
  return strikes_from(ends, early, 0.5, strikes);
}

/* a whole step: foot 1 lands at the last instant, as foot 0 does at the first */
static void a_contact_that_begins_at_the_end_is_the_next_strike(void **state) {
  (void)state;
  ambulo__strike s[8];
  int count = strikes_from(AMBULO_ENDS_MIRRORED, 0.1, 1.0, s), first = 0;
  for (int i = 0; i < count; i++) first += s[i].foot == 0 && s[i].time == 0.0;
  assert_int_equal(first, 1);
}

static void periodic(void **state) {
  (void)state;
  ambulo__strike s[8];
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
  ambulo__strike s[8];
  assert_int_equal(strikes_of(AMBULO_ENDS_MIRRORED, 0.1, s), 4);
  assert_int_equal(s[0].foot, 1);
  assert_close(s[0].time, 0.0, 0.0);
  assert_int_equal(s[1].foot, 0);
  assert_close(s[1].time, 1.0, 0.0);
  assert_int_equal(s[2].foot, 1);
  assert_close(s[2].time, 0.5, 0.0);
  assert_int_equal(s[3].foot, 0);
  assert_close(s[3].time, 1.5, 0.0);
}

static void free_ends(void **state) {
  (void)state;
  ambulo__strike s[8];
  assert_int_equal(strikes_of(AMBULO_ENDS_FREE, 0.1, s), 1);
  assert_close(s[0].time, 0.5, 0.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(periodic), cmocka_unit_test(mirrored), cmocka_unit_test(free_ends),
      cmocka_unit_test(a_contact_that_begins_at_the_end_is_the_next_strike)};
  return cmocka_run_group_tests_name("report/strikes", tests, NULL, NULL);
}
