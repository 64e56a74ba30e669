/* What is predicted comes true: problems are solved again with the settings that the audit names.
 * (bench/bench_dense.c does the same for every shipped problem.) */
#include "support/at_nodes.h"
#include "support/problem_path.h"
#include "ambulo/tools/load.h"
#include "support/dense_fixture.h"
#include "support/engine_fixture.h"

enum { MOST_SETTINGS = 6, TEXT = 400 };

typedef struct solved {
  ambulo_problem *problem;
  ambulo_result *result;
} solved;

static solved solve_with(const char *name, const char *settings) {
  char path[96], text[TEXT];
  const char *overrides[MOST_SETTINGS];
  int count = 0;
  solved s = {NULL, NULL};
  problem_path(name, path, sizeof path);
  (void)snprintf(text, sizeof text, "%s", settings);
  for (char *word = strtok(text, " "); word; word = strtok(NULL, " "))
    if (strcmp(word, "--set") != 0) overrides[count++] = word;
  assert_int_equal(ambulo_problem_load(path, overrides, count, NULL, NULL, &s.problem), AMBULO_OK);
  assert_int_equal(ambulo_solve(s.problem, NULL, NULL, NULL, NULL, &s.result), AMBULO_OK);
  ambulo_verdict verdict = verdict_at_nodes(s.result);
  assert_true(verdict == AMBULO_OPTIMAL || verdict == AMBULO_FEASIBLE);
  return s;
}

static void release(solved *s) {
  ambulo_result_free(s->result);
  ambulo_problem_free(s->problem);
}

/* every family of `before` with these settings holds after them; returns their number */
static int check(const char *name, const ambulo_dense_audit *before, const char *settings) {
  solved s = solve_with(name, settings);
  const ambulo_dense_audit *after = ambulo_result_dense_audit(s.result);
  int count = 0;
  for (int i = 0; i < before->family_count; i++) {
    const ambulo_dense_family *f = &before->families[i];
    if (strcmp(f->settings, settings) != 0) continue;
    count++;
    assert_false(f->holds);
    assert_true(f->violation.worst > f->tolerance);
    for (int k = 0; k < after->family_count; k++) {
      const ambulo_dense_family *now = &after->families[k];
      if (strcmp(now->violation.family, f->violation.family) != 0 ||
          strcmp(now->violation.unit, f->violation.unit) != 0)
        continue;
      if (!now->holds)
        print_error("%s %s: %s is %g, tolerance %g\n", name, settings, f->violation.family,
                    now->violation.worst, now->tolerance);
      assert_true(now->holds);
    }
  }
  release(&s);
  return count;
}

/* all the settings that are named; returns the number of families cured */
static int check_all(const char *name) {
  solved s = solve_with(name, "");
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(s.result);
  int cured = 0;
  for (int i = 0; i < dense->family_count; i++) {
    const ambulo_dense_family *f = &dense->families[i];
    int known = f->settings[0] == '\0';
    for (int k = 0; k < i; k++) known |= strcmp(dense->families[k].settings, f->settings) == 0;
    if (!known) cured += check(name, dense, f->settings);
  }
  release(&s);
  return cured;
}

static void more_time_intervals_cure_a_walk(void **state) {
  (void)state;
  assert_int_equal(check_all("support/walk_rigid"), 7);
}

static void joint_limits_of_an_arm_too(void **state) {
  (void)state;
  assert_int_equal(check_all("support/two_link_reach"), 1);
}

/* contacts that are equations: intervals of the trajectory go with those of time; forces need
 * contacts within a tolerance, joint limits need rows on the control points */
static void contacts_that_are_equations_have_three_cures(void **state) {
  (void)state;
  assert_int_equal(check_all("support/walker_2d_step"), 5);
  assert_int_equal(check_all("support/walk_without_reaction"), 5);
}

/* families that fail have settings or say that more intervals do not help, or too far off */
static void no_failure_is_left_without_a_word(void **state) {
  (void)state;
  static const char *const names[] = {"support/walker_2d_step", "yardstick_12", "fig5a_feasible"};
  for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
    solved s = solve_with(names[n], "");
    const ambulo_dense_audit *dense = ambulo_result_dense_audit(s.result);
    int zmp = 0;
    for (int i = 0; i < dense->family_count; i++) {
      const ambulo_dense_family *f = &dense->families[i];
      if (f->holds) continue;
      assert_true(f->advice[0] != '\0');
      if (strcmp(f->violation.family, "zmp") != 0) continue;
      zmp++;
      assert_string_equal(f->settings, "");
      assert_non_null(strstr(f->advice, "more intervals do not help"));
    }
    assert_int_equal(zmp, 1);
    assert_int_equal(dense->line_count, dense->failing);
    release(&s);
  }
}

/* the gap before toe-off decides, not the number of nodes: on 25 k intervals the walk's toe-off is
 * on a node, and the interval before it is free; the number named has a node just before it */
static void the_number_named_has_nodes_where_they_count(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/walk_rigid");
  ambulo_result *r = NULL;
  assert_int_equal(ambulo_solve(p, NULL, NULL, NULL, NULL, &r), AMBULO_OK);
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(r);
  double toe_off = 0.62 * 1.08 - 0.54;
  assert_true(dense->intervals > 50 && dense->intervals < 1000);
  assert_int_equal(dense->spline_intervals, 17);
  assert_true(ambulo__dense_gap_before(toe_off, 0.54, dense->intervals) < 0.54 / 25 / 16);
  ambulo_result_free(r);
  ambulo_problem_free(p);
}

/* A body that is moved as a whole at 0.4 m/s, on N intervals of 0.55 s, of which only slip is
 * looked at and only beside one event. Slip is speed times gap; 0.7 mm are allowed. */
static int intervals_named(int intervals, double event) {
  dense_fixture f;
  ambulo__events events = {1, &event};
  ambulo__dense_worst worst;
  ambulo__dense_cure cure;
  int slip = AMBULO__DENSE_RULE_SLIP;
  memset(&worst, 0, sizeof worst);
  worst.entry[slip].present = 1;
  worst.entry[slip].ratio = 2.0;
  dense_open(&f, intervals);
  dense_move(&f, 0, 0.0, 0.4, 0.0);
  assert_int_equal(ambulo__dense_cure_find(f.problem, f.x, &events, &worst, NULL, &cure),
                   AMBULO_OK);
  assert_true(cure.cured[slip] && cure.intervals > intervals);
  assert_int_equal(cure.spline_intervals, cure.intervals);
  dense_close(&f);
  return cure.intervals;
}

static void gaps_to_come_are_predicted_from_the_motion(void **state) {
  (void)state;
  const double toe_off = 0.24 * 0.55, foot_flat = 0.16 * 0.55, longest = 0.0007 / 0.4;
  /* toe-off on a node: the interval before it is free, and its slip is there to be seen */
  assert_true(ambulo__dense_gap_before(toe_off, 0.55, intervals_named(25, toe_off)) <= longest);
  /* toe-off just after a node: nothing slips now, and on 22 intervals it would */
  assert_true(ambulo__dense_gap_before(toe_off, 0.55, 21) < longest);
  assert_true(ambulo__dense_gap_before(toe_off, 0.55, 22) > 3.0 * longest);
  assert_true(ambulo__dense_gap_before(toe_off, 0.55, intervals_named(21, toe_off)) <= longest);
  /* the toe comes down on a node: nothing slips now, and on 26 intervals it would */
  assert_true(ambulo__dense_gap_after(foot_flat, 0.55, 25) < 1e-9);
  assert_true(ambulo__dense_gap_after(foot_flat, 0.55, 26) > 5.0 * longest);
  assert_true(ambulo__dense_gap_after(foot_flat, 0.55, intervals_named(25, foot_flat)) <=
              2.0 * longest);
}

/* Two rules that fail between nodes or beside toe-off, at the end of a step that moves as a whole
 * at `speed`. No number is in the audit but what is given here. */
typedef struct asked {
  dense_fixture f;
  double event;
  ambulo__events events;
  ambulo__dense_worst worst;
  ambulo__dense_cure cure;
  int slip, force;
} asked;

static void open_asked(asked *a, int intervals, double speed) {
  memset(a, 0, sizeof *a);
  ambulo__table_row friction = {.kind = AMBULO__KIND_FRICTION, .measure = AMBULO__BODY_WEIGHTS};
  a->slip = AMBULO__DENSE_RULE_SLIP;
  a->force = ambulo__dense_rule_of_row(&friction);
  a->event = 0.24 * 0.55;
  a->events = (ambulo__events){speed > 0.0, &a->event};
  dense_open(&a->f, intervals);
  dense_move(&a->f, 0, 0.0, speed, 0.0);
}

static void fails(asked *a, int rule, double ratio, double between) {
  a->worst.entry[rule].present = 1;
  a->worst.entry[rule].ratio = ratio;
  a->worst.entry[rule].between = between;
}

static void ask(asked *a) {
  assert_int_equal(
      ambulo__dense_cure_find(a->f.problem, a->f.x, &a->events, &a->worst, NULL, &a->cure),
      AMBULO_OK);
}

static double gap_at(int intervals) {
  return ambulo__dense_gap_before(0.24 * 0.55, 0.55, intervals);
}

/* 2 (20 / N)^1.5 <= 0.7 from N = 41 on: where only what lies between nodes fails */
static void between_nodes_the_order_says_how_many(void **state) {
  (void)state;
  asked a;
  open_asked(&a, 20, 0.0);
  fails(&a, a.slip, 2.0, 2.0);
  ask(&a);
  assert_int_equal(a.cure.intervals, 41);
  assert_int_equal(a.cure.cured[a.slip], 1);
  assert_int_equal(a.cure.out_of_reach[a.slip], 0);
  fails(&a, a.slip, 1.0, 1.0); /* holds: nothing is to be cured */
  ask(&a);
  assert_int_equal(a.cure.intervals + a.cure.cured[a.slip], 0);
  dense_close(&a.f);
}

/* beside an event only the gap counts, however bad it is today: 0.4 m/s for 1.75 ms are 0.7 mm.
 * Between nodes 40 times the tolerance would take 370 intervals. */
static void beside_an_event_the_gap_says_how_many(void **state) {
  (void)state;
  asked a;
  open_asked(&a, 25, 0.4);
  fails(&a, a.slip, 40.0, 0.0);
  ask(&a);
  assert_in_range(a.cure.intervals, 26, 100);
  assert_true(gap_at(a.cure.intervals) <= 0.0007 / 0.4);
  dense_close(&a.f);
}

/* a thousand intervals, or four times as many as there are, are tried: 400 (3.637 / 0.7)^(2/3) is
 * 1200; five times as many are too far off */
static void fine_grids_are_made_finer_still(void **state) {
  (void)state;
  asked a;
  open_asked(&a, 400, 0.0);
  fails(&a, a.slip, 3.637, 0.7 * pow(3.0, 1.5));
  ask(&a);
  assert_in_range(a.cure.intervals, 1200, 1201);
  fails(&a, a.slip, 8.0, 0.7 * pow(5.0, 1.5));
  ask(&a);
  assert_int_equal(a.cure.intervals + a.cure.cured[a.slip], 0);
  assert_int_equal(a.cure.out_of_reach[a.slip], 1);
  dense_close(&a.f);
  open_asked(&a, 20, 0.0);
  fails(&a, a.slip, 100.0, 0.7 * pow(49.0, 1.5));
  ask(&a);
  assert_in_range(a.cure.intervals, 980, 981);
  dense_close(&a.f);
}

/* what suffices for one rule need not for another: more intervals have other gaps */
static void a_number_suffices_for_all_at_once(void **state) {
  (void)state;
  asked a;
  open_asked(&a, 25, 0.4);
  a.f.problem->definition.contact_tolerance = 0.002; /* with exact contacts none help friction */
  fails(&a, a.slip, 9.0, 0.0);
  fails(&a, a.force, 3.0, 0.7 * 98.0 / 25.0);
  ask(&a);
  assert_true(gap_at(98) > 0.0007 / 0.4); /* enough for friction alone, not for slip */
  assert_in_range(a.cure.intervals, 99, 150);
  assert_true(gap_at(a.cure.intervals) <= 0.0007 / 0.4);
  assert_int_equal(a.cure.cured[a.slip] + a.cure.cured[a.force], 2);
  dense_close(&a.f);
}

/* toe-off at 0.24 has its smallest gap after a node, 0.04 intervals, on grids of 25 k + 21. Slip
 * at 20 m/s asks for one of these, friction for 998 intervals, and the next such grid is 1021: the
 * one that asks for most is left out. */
static void what_asks_for_most_is_left_out(void **state) {
  (void)state;
  asked a;
  open_asked(&a, 25, 20.0);
  a.f.problem->definition.contact_tolerance = 0.002;
  fails(&a, a.slip, 400.0, 0.0);
  fails(&a, a.force, 40.0, 0.7 * 998.0 / 25.0);
  ask(&a);
  assert_int_equal(a.cure.intervals % 25, 21);
  assert_true(gap_at(a.cure.intervals) <= 0.0007 / 20.0);
  assert_int_equal(a.cure.cured[a.slip], 1);
  assert_int_equal(a.cure.cured[a.force], 0);
  assert_int_equal(a.cure.out_of_reach[a.force], 1);
  dense_close(&a.f);
}

/* heights or places as equations bind the grids; within a tolerance neither does */
static void equations_of_either_kind_are_strict(void **state) {
  (void)state;
  dense_fixture f;
  dense_open(&f, 20);
  ambulo_problem_definition *d = &f.problem->definition;
  for (int kinds = 0; kinds < 4; kinds++) {
    d->ground_penetration = kinds & 1;
    d->foot_strike = kinds >> 1;
    d->contact_tolerance = 0.0;
    assert_int_equal(ambulo__dense_is_strict(f.problem), kinds != 0);
    d->contact_tolerance = 0.002;
    assert_false(ambulo__dense_is_strict(f.problem));
  }
  dense_close(&f);
}

/* moved by half an interval, the toes of one foot would have to carry the body at a time that is
 * looked at: there is no such motion, and what was measured at the nodes has to do */
static void motions_that_cannot_be_moved_are_predicted_from_the_nodes(void **state) {
  (void)state;
  static const char *const overrides[] = {"constraints.zmp=hull", "gait.phases.heel_strike=0",
                                          "gait.phases.heel_off=0.49", "gait.phases.toe_off=0.6",
                                          "time.intervals=16"};
  ambulo_problem *p = NULL;
  ambulo__events events;
  ambulo__dense_worst worst;
  ambulo__dense_cure cure;
  ambulo_allocator allocator = ambulo__allocator_or_default(NULL);
  int slip = AMBULO__DENSE_RULE_SLIP;
  memset(&worst, 0, sizeof worst);
  worst.entry[slip] = (ambulo__dense_entry){.present = 1, .ratio = 2.0, .between = 2.0};
  assert_int_equal(
      ambulo_problem_load("tests/support/walker_2d_step.yaml", overrides, 5, NULL, NULL, &p),
      AMBULO_OK);
  double *x = calloc((size_t)p->variables, sizeof *x);
  assert_int_equal(
      ambulo__events_create(&p->definition, AMBULO__EVENTS_OF_ROWS, &allocator, &events),
      AMBULO_OK);
  assert_int_equal(ambulo__dense_cure_find(p, x, &events, &worst, NULL, &cure), AMBULO_OK);
  assert_int_equal(cure.intervals, 33); /* 2 (16 / N)^1.5 <= 0.7 */
  ambulo__free(&allocator, events.time);
  free(x);
  ambulo_problem_free(p);
}

/* breakpoints of the caller's own would have to be new ones: nothing is predicted then */
static void given_breakpoints_are_left_alone(void **state) {
  (void)state;
  dense_fixture f;
  double event = 0.24 * 0.55;
  ambulo__events events = {1, &event};
  ambulo__dense_worst worst;
  ambulo__dense_cure cure;
  int slip = AMBULO__DENSE_RULE_SLIP;
  memset(&worst, 0, sizeof worst);
  worst.entry[slip].present = 1;
  worst.entry[slip].ratio = 2.0;
  dense_open(&f, 25);
  f.problem->definition.breakpoints = ambulo__basis_breakpoints(f.problem->basis);
  f.problem->definition.spline_intervals = 25;
  assert_int_equal(ambulo__dense_spline_intervals(f.problem, 50), 25);
  assert_int_equal(ambulo__dense_cure_find(f.problem, f.x, &events, &worst, NULL, &cure),
                   AMBULO_OK);
  assert_int_equal(cure.intervals + cure.cured[slip] + cure.out_of_reach[slip], 0);
  f.problem->definition.breakpoints = NULL;
  dense_close(&f);
}

static void grids_keep_their_proportion_where_contacts_are_equations(void **state) {
  (void)state;
  ambulo_problem *exact = load_problem("support/walk_without_reaction"),
                 *tube = load_problem("support/walk_rigid");
  assert_true(ambulo__dense_is_strict(exact) && !ambulo__dense_is_strict(tube));
  assert_int_equal(ambulo__dense_spline_intervals(exact, 48), 36);
  assert_int_equal(ambulo__dense_spline_intervals(exact, 25), 19);
  assert_int_equal(ambulo__dense_spline_intervals(tube, 50), 17);
  ambulo_problem_free(exact);
  ambulo_problem_free(tube);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(more_time_intervals_cure_a_walk),
      cmocka_unit_test(joint_limits_of_an_arm_too),
      cmocka_unit_test(contacts_that_are_equations_have_three_cures),
      cmocka_unit_test(no_failure_is_left_without_a_word),
      cmocka_unit_test(the_number_named_has_nodes_where_they_count),
      cmocka_unit_test(gaps_to_come_are_predicted_from_the_motion),
      cmocka_unit_test(between_nodes_the_order_says_how_many),
      cmocka_unit_test(beside_an_event_the_gap_says_how_many),
      cmocka_unit_test(fine_grids_are_made_finer_still),
      cmocka_unit_test(a_number_suffices_for_all_at_once),
      cmocka_unit_test(what_asks_for_most_is_left_out),
      cmocka_unit_test(equations_of_either_kind_are_strict),
      cmocka_unit_test(motions_that_cannot_be_moved_are_predicted_from_the_nodes),
      cmocka_unit_test(given_breakpoints_are_left_alone),
      cmocka_unit_test(grids_keep_their_proportion_where_contacts_are_equations),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
