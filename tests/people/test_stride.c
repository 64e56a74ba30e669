/* Strides: sampling, and the mirror image that is the second step: a motion of the same body within
 * the same limits. */
#include "ambulo/tools/load.h"
#include "people/stride.h"
#include "support/at_nodes.h"
#include "support/planar_walker.h"
#include "support/test.h"
#include "support/walker_result.h"

enum { D = WALKER_COORDINATES };

static void test_nodes(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  ambulo__stride s;
  assert_int_equal(ambulo__stride_create(w.problem, w.result->x, 0, NULL, &s), AMBULO_OK);
  assert_int_equal(s.samples, 25);
  assert_true(s.mirrored);
  assert_close(s.duration, 2.0 * walker_step_time, 1e-15);
  for (int k = 0; k < 25; k++) assert_close(s.times[k], (double)k * walker_step_time / 12.0, 1e-14);
  ambulo__stride_free(&s);
  walk_close(&w);
}

/* samples stand at the nodes, wherever those are */
static void test_nodes_on_events(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  ambulo_problem *p = walker_problem_on(w.model, 12, AMBULO_GRID_EVENTS);
  ambulo__stride s;
  assert_int_equal(p->variables, w.problem->variables);
  assert_int_equal(ambulo__stride_create(p, w.result->x, 0, NULL, &s), AMBULO_OK);
  assert_int_equal(s.samples, 25);
  for (int k = 0; k <= 12; k++) {
    assert_true(s.times[k] == p->times[k]);
    assert_close(s.times[12 + k], p->times[k] + walker_step_time, 1e-15);
  }
  assert_true(fabs(s.times[1] - walker_step_time / 12.0) > 1e-3);
  ambulo__stride_free(&s);
  ambulo_problem_free(p);
  walk_close(&w);
}

/* node 12 + k is node k with left and right exchanged, one step further on and up */
static void test_mirror(void **state) {
  (void)state;
  static const int image[D] = {0, 1, 2, 6, 7, 8, 3, 4, 5};
  walk w;
  walk_open(&w, 12);
  w.problem->definition.rise = 0.17;
  ambulo__stride s;
  assert_int_equal(ambulo__stride_create(w.problem, w.result->x, 0, NULL, &s), AMBULO_OK);
  for (int k = 1; k <= 12; k++) {
    for (int i = 0; i < D; i++) {
      double shift = i == 0 ? walker_step_length : i == 1 ? 0.17 : 0.0;
      int here = (12 + k) * D + image[i], there = k * D + i;
      assert_close(s.q[here], s.q[there] + shift, 1e-13);
      assert_close(s.qd[here], s.qd[there], 1e-13);
      assert_close(s.qdd[here], s.qdd[there], 1e-13);
      assert_close(s.tau[here], s.tau[there], 1e-13);
    }
    if (isfinite(s.zmp[3 * k])) {
      assert_close(s.zmp[3 * (12 + k)], s.zmp[3 * k] + walker_step_length, 1e-13);
      assert_close(s.zmp[3 * (12 + k) + 1], s.zmp[3 * k + 1] + 0.17, 1e-13);
      assert_close(s.zmp[3 * (12 + k) + 2], -s.zmp[3 * k + 2], 1e-13);
    }
  }
  ambulo__stride_free(&s);
  walk_close(&w);
}

static void test_contacts_change_sides(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  ambulo__stride s;
  assert_int_equal(ambulo__stride_create(w.problem, w.result->x, 11, NULL, &s), AMBULO_OK);
  assert_int_equal(s.samples, 11);
  for (int k = 1; k < 10; k++) {
    double t = walker_step_time * ((double)k + 0.37) / 12.0;
    for (int foot = 0; foot < 2; foot++) {
      const ambulo_contact *now = ambulo__stride_contact(&s, foot, t);
      const ambulo_contact *later = ambulo__stride_contact(&s, 1 - foot, t + walker_step_time);
      assert_ptr_equal(now, later);
    }
  }
  ambulo__stride_free(&s);
  assert_int_equal(ambulo__stride_create(w.problem, w.result->x, 1, NULL, &s), AMBULO_E_ARGUMENT);
  walk_close(&w);
}

/* a sample beyond the model's own limits, for messages; NULL if all keep them */
static const char *beyond(const ambulo__stride *s, int i, int k) {
  const ambulo_coordinate *c = ambulo_model_coordinate(s->model, i);
  const double *limit[3] = {c->range, c->speed, c->torque};
  int at = k * s->coordinates + i;
  double value[3] = {s->q[at], s->qd[at], s->tau[at]};
  static const char *const words[3] = {"range", "speed", "torque"};
  for (int what = 0; what < 3; what++) {
    double slack = 1e-6 * fmax(1.0, fabs(value[what]));
    if (value[what] < limit[what][0] - slack || value[what] > limit[what][1] + slack)
      return words[what];
  }
  return NULL;
}

/* One limit of one side, or of one direction, narrower: the whole stride that is written keeps it,
 * and every limit of every coordinate. */
static void test_limits_hold_in_both_halves(void **state) {
  (void)state;
  static const char *const cases[] = {
      "model.links[shank_l].coordinate.range=[0, 55]",
      "model.links[shank_r].coordinate.range=[0, 20]",
      "model.links[pelvis].coordinate.range=[-1, 30]",
      "model.links[pelvis_forward].coordinate.range=[-1, 0.6]", /* of the stature */
      "model.links[shank_l].coordinate.speed=[-300, 300]",
      "model.links[talus_l].coordinate.torque=[-0.06, 0.04]"};
  for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
    const char *overrides[] = {cases[n], "constraints.torque_limits=true",
                               "constraints.speed_limits=true"};
    ambulo_problem *problem = NULL;
    ambulo_result *result = NULL;
    assert_int_equal(
        ambulo_problem_load("tests/support/walk_rigid.yaml", overrides, 3, NULL, NULL, &problem),
        AMBULO_OK);
    ambulo_options options = ambulo_problem_options(problem);
    assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
    ambulo_verdict verdict = verdict_at_nodes(result);
    if (verdict != AMBULO_OPTIMAL && verdict != AMBULO_FEASIBLE)
      print_error("%s: %s\n", cases[n], ambulo_verdict_name(verdict));
    assert_true(verdict == AMBULO_OPTIMAL || verdict == AMBULO_FEASIBLE);
    ambulo__stride s;
    assert_int_equal(ambulo__stride_create(problem, result->x, 0, NULL, &s), AMBULO_OK);
    for (int k = 0; k < s.samples; k++) {
      for (int i = 0; i < s.coordinates; i++) {
        const char *what = beyond(&s, i, k);
        if (what)
          print_error("%s: %s of %s at %g s\n", cases[n], what,
                      ambulo_model_coordinate(s.model, i)->name, s.times[k]);
        assert_null(what);
      }
    }
    ambulo__stride_free(&s);
    ambulo_result_free(result);
    ambulo_problem_free(problem);
  }
}

/* the mirrored half is a motion of the same body: its torques are those of inverse dynamics */
static void test_the_second_half_obeys_the_same_equations(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  ambulo__stride s;
  ambulo_mechanics *mechanics = NULL;
  assert_int_equal(ambulo__stride_create(w.problem, w.result->x, 0, NULL, &s), AMBULO_OK);
  assert_int_equal(ambulo_mechanics_create(s.model, NULL, &mechanics), AMBULO_OK);
  double *tau = calloc((size_t)(s.samples * D), sizeof *tau);
  assert_int_equal(ambulo_mechanics_inverse_dynamics(
                       mechanics, s.samples, s.q, s.qd, s.qdd,
                       &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau}),
                   AMBULO_OK);
  for (int j = 0; j < s.samples * D; j++) assert_close(s.tau[j], tau[j], 1e-11);
  free(tau);
  ambulo_mechanics_free(mechanics);
  ambulo__stride_free(&s);
  walk_close(&w);
}

static int test_stride_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_nodes),
      cmocka_unit_test(test_nodes_on_events),
      cmocka_unit_test(test_mirror),
      cmocka_unit_test(test_contacts_change_sides),
      cmocka_unit_test(test_limits_hold_in_both_halves),
      cmocka_unit_test(test_the_second_half_obeys_the_same_equations)};
  return cmocka_run_group_tests_name("stride/stride", tests, NULL, NULL);
}

/* Strikes from schedules: mirrored steps, periodic strides, free motions. */

/* foot 0 on the heel to 0.2 s, then flat to 0.6 s; foot 1 down to `early`, and again from `late` */
static int strikes_from(ambulo_ends ends, double early, double late, ambulo__strike *strikes) {
  ambulo_model *model = planar_walker_create();
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
  ambulo_model *model = planar_walker_create();
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

static int test_strikes_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(periodic), cmocka_unit_test(mirrored), cmocka_unit_test(free_ends),
      cmocka_unit_test(the_earlier_time_stays), cmocka_unit_test(what_is_one_event_is_listed_once)};
  return cmocka_run_group_tests_name("stride/strikes", tests, NULL, NULL);
}

int main(void) {
  return test_stride_tests() + test_strikes_tests();
}
