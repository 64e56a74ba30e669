/* Rows in conflict, and what each family alone would have to give: masses on rails whose answers
 * are known by hand, and a pendulum whose search is cut short at every step. */
#include "support/engine_fixture.h"
#include "support/planar_walker.h"
#include "support/sliders.h"

static void relax(sliders *s, double tolerance) {
  assert_int_equal(ambulo__relax(&s->elastic, tolerance, s->x, &s->pool, &s->out, &s->remedy),
                   AMBULO_OK);
}

static const ambulo_conflict *conflict_of(const sliders *s, const char *family) {
  for (int i = 0; i < s->out.view.conflict_count; i++) {
    if (!strcmp(s->out.conflict[i].shared.family, family)) return &s->out.conflict[i];
  }
  return NULL;
}

/* one mass in two places: half of the way each, or all of it by one */
static void two_that_disagree_share_the_violation(void **state) {
  (void)state;
  const slider_row rows[SLIDER_ROWS] = {{"here", 1.0, 1.0, 0.0, {1.0}, 0},
                                        {"there", 1.0, 1.0, 0.8, {1.0}, 0}};
  sliders *s = sliders_open(rows, INFINITY, NULL);
  relax(s, 1e-6);
  assert_int_equal(s->out.view.complete, 1);
  assert_int_equal(s->out.view.feasible_point, 0);
  assert_int_equal(s->out.view.conflict_count, 2);
  for (int i = 0; i < 2; i++) {
    const ambulo_conflict *c = &s->out.conflict[i];
    assert_close(c->shared.worst, 0.4, 1e-3);
    assert_int_equal(c->alone, 1);
    assert_close(c->relaxation.worst, 0.8, 1e-3);
    assert_int_equal(c->other_count, 0);
  }
  assert_true(s->remedy.conflict >= 0 && !s->remedy.single);
  assert_close(fabs(s->remedy.value[s->remedy.row]), 0.8, 1e-3);
  sliders_close(s);
}

/* the middle one of three holds at the least violation; without an outer one the others still
 * disagree */
static void three_that_disagree_have_no_single_culprit(void **state) {
  (void)state;
  const slider_row rows[SLIDER_ROWS] = {{"left", 1.0, 1.0, 0.0, {1.0}, 0},
                                        {"middle", 1.0, 1.0, 0.4, {1.0}, 0},
                                        {"right", 1.0, 1.0, 0.8, {1.0}, 0}};
  sliders *s = sliders_open(rows, INFINITY, NULL);
  relax(s, 1e-6);
  assert_int_equal(s->out.view.complete, 1);
  assert_int_equal(s->out.view.conflict_count, 2);
  assert_null(conflict_of(s, "middle"));
  for (int i = 0; i < 2; i++) assert_int_equal(s->out.conflict[i].alone, 0);
  assert_int_equal(s->remedy.conflict, -1);
  sliders_close(s);
}

/* a tube of one mass in a corridor of another: nothing is in conflict */
static void a_point_that_satisfies_every_row_is_recognized(void **state) {
  (void)state;
  const slider_row rows[SLIDER_ROWS] = {{"here", 1.0, 1.0, 0.3, {1.0, 0.7, 0.2}, 0},
                                        {"there", 0.5, 0.5, -0.4, {0.3, 1.1, 0.9}, 0}};
  sliders *s = sliders_open(rows, INFINITY, NULL);
  relax(s, 1e-6);
  assert_int_equal(s->out.view.feasible_point, 1);
  assert_int_equal(s->out.view.conflict_count, 0);
  assert_int_equal(s->remedy.conflict, -1);
  sliders_close(s);
}

/* two pairs disagree, one by `little`: how many families are named */
static int families_named(double much, double little, double tolerance) {
  const slider_row rows[SLIDER_ROWS] = {{"a", 1.0, 1.0, 0.0, {1.0}, 0},
                                        {"b", 1.0, 1.0, much, {1.0}, 0},
                                        {"c", 1.0, 1.0, 0.0, {0.0, 1.0}, 0},
                                        {"d", 1.0, 1.0, little, {0.0, 1.0}, 0}};
  sliders *s = sliders_open(rows, INFINITY, NULL);
  relax(s, tolerance);
  int count = s->out.view.conflict_count;
  sliders_close(s);
  return count;
}

/* what is left at the end of a descent is not a conflict: a thousandth of the worst, and ten times
 * the tolerance, are */
static void residues_are_not_named(void **state) {
  (void)state;
  assert_int_equal(families_named(0.8, 0.4, 1e-6), 4);
  assert_int_equal(families_named(0.8, 0.0016, 1e-6), 4);
  assert_int_equal(families_named(0.8, 0.0004, 1e-6), 2);
  assert_int_equal(families_named(0.8, 0.04, 1e-3), 4);
  assert_int_equal(families_named(0.8, 0.01, 1e-3), 2);
}

/* ------------------------------------------------------------------- limits */

/* two places have to add up to 2, as two families ask, and none may be above 0: each gives way by
 * 1; one alone, by 2, is the remedy of one number */
static void one_limit_is_better_advice_than_two(void **state) {
  (void)state;
  const slider_row rows[SLIDER_ROWS] = {{"sum", 1.0, 1.0, 2.0, {1.0, 1.0}, 0},
                                        {"twice", 1.0, 1.0, 2.0, {1.0, 1.0}, 0}};
  sliders *s = sliders_open(rows, 0.0, NULL);
  relax(s, 1e-6);
  const ambulo_conflict *c = conflict_of(s, "joint_limit");
  assert_non_null(c);
  assert_int_equal(c->alone, 1);
  assert_close(c->relaxation.worst, 1.0, 0.01);
  assert_int_equal(c->other_count, 1);
  assert_close(c->others[0].worst, 1.0, 0.01);
  assert_int_equal(s->remedy.single, 1);
  assert_close(s->remedy.value[s->remedy.row], -2.0, 0.01);
  assert_string_equal(s->problem->table.rows[s->remedy.row].detail, "upper");
  sliders_close(s);
}

/* six places have to add up to 6: one alone by 6 is more than four times what each would give */
static void one_limit_does_not_give_for_all(void **state) {
  (void)state;
  const slider_row rows[SLIDER_ROWS] = {
      {"sum", 1.0, 1.0, 6.0, {1.0, 1.0, 1.0, 1.0, 1.0, 1.0}, 0},
      {"twice", 1.0, 1.0, 6.0, {1.0, 1.0, 1.0, 1.0, 1.0, 1.0}, 0}};
  sliders *s = sliders_open(rows, 0.0, NULL);
  relax(s, 1e-6);
  const ambulo_conflict *c = conflict_of(s, "joint_limit");
  assert_int_equal(c->alone, 1);
  assert_close(c->relaxation.worst, 1.0, 0.01);
  assert_int_equal(c->other_count, 3); /* as many as are named */
  assert_int_equal(s->remedy.single, 0);
  assert_close(s->remedy.value[s->remedy.row], -1.0, 0.01);
  sliders_close(s);
}

/* least squares would ask 0.1 of one and 0.3 of the other; the least worst is 0.25 of both */
static void the_worst_row_is_made_as_small_as_it_can_be(void **state) {
  (void)state;
  const slider_row rows[SLIDER_ROWS] = {{"sum", 1.0, 1.0, 1.0, {1.0, 3.0}, 0}};
  sliders *s = sliders_open(rows, 0.0, NULL);
  relax(s, 1e-6);
  const ambulo_conflict *c = conflict_of(s, "joint_limit");
  assert_int_equal(c->alone, 1);
  assert_close(c->relaxation.worst, 0.25, 0.005);
  sliders_close(s);
}

/* each limit is named with its worst time; what gives less than a hundredth of the worst is not */
static void others_are_named_at_their_worst(void **state) {
  (void)state;
  const slider_row rows[SLIDER_ROWS] = {{"most", 1.0, 1.0, 0.5, {1.0}, 0},
                                        {"some", 0.5, 0.5, 0.2, {0.0, 1.0}, 0},
                                        {"more", 1.0, 1.0, 0.4, {0.0, 1.0}, 0},
                                        {"hardly", 1.0, 1.0, 0.003, {0.0, 0.0, 1.0}, 0}};
  sliders *s = sliders_open(rows, 0.0, NULL);
  relax(s, 1e-6);
  const ambulo_conflict *c = conflict_of(s, "joint_limit");
  assert_int_equal(c->alone, 1);
  assert_string_equal(c->relaxation.subject, "s0");
  assert_close(c->relaxation.worst, 0.5, 1e-3);
  assert_int_equal(c->other_count, 1);
  assert_string_equal(c->others[0].subject, "s1");
  assert_close(c->others[0].worst, 0.4, 1e-3);
  assert_close(c->others[0].time, 1.0, 0.0);
  sliders_close(s);
}

/* ------------------------------------------------------------------- travel */

/* a body that is to come 0.3 m further, and as it was, stays where it is and tilts: the travel
 * alone would not suffice, and is not offered as the remedy of one number */
static void the_travel_alone_is_offered_where_it_suffices(void **state) {
  (void)state;
  const slider_row rows[SLIDER_ROWS] = {{"start", 0.0, 0.0, 0.0, {1.0}, 0},
                                        {"stay", 1.0, 1.0, 0.0, {1.0}, 0},
                                        {"lean", 0.0, 0.0, 0.0, {0.0, 0.0, 1.0}, 0},
                                        {"tilt", 1.0, 1.0, 0.1, {0.0, 0.0, 1.0}, 0}};
  sliders *s = calloc(1, sizeof *s);
  s->model = planar_walker_create();
  ambulo_problem_definition d = ambulo_problem_definition_default();
  d.model = s->model;
  d.intervals = 4;
  d.ends = AMBULO_ENDS_PERIODIC;
  d.ends_order = 1;
  d.travel = 0.3;
  sliders_ask(s, &d, rows);
  relax(s, 1e-6);
  const ambulo_conflict *c = conflict_of(s, "periodic");
  assert_non_null(c);
  assert_int_equal(c->alone, 1);
  assert_string_equal(c->relaxation.subject, "pelvis_tx");
  assert_close(c->relaxation.worst, 0.3, 1e-3);
  assert_int_equal(c->other_count, 1);
  assert_string_equal(c->others[0].subject, "pelvis_tilt");
  assert_close(c->others[0].worst, 0.1, 0.01);
  assert_true(&s->out.conflict[s->remedy.conflict] == c);
  assert_int_equal(s->remedy.single, 0);
  sliders_close(s);
}

/* ------------------------------------------------------------ cut short */

typedef struct cut {
  engine_fixture f;
  ambulo__pool pool;
  ambulo__elastic elastic;
  ambulo__explanation out;
  ambulo__remedy remedy;
} cut;

/* after so many model steps */
static cut *open_cut(const char *name, double steps) {
  cut *c = calloc(1, sizeof *c);
  ambulo_allocator allocator = ambulo__allocator_or_default(NULL);
  char path[80];
  (void)snprintf(path, sizeof path, "../tests/infeasible/%s", name);
  engine_open(&c->f, path);
  ambulo__pool_init(&c->pool, &allocator);
  ambulo_workspace *w = c->f.engine->workspace;
  assert_int_equal(ambulo__evaluate(w, c->f.x), AMBULO_OK);
  assert_int_equal(ambulo__elastic_create(c->f.problem, w, &c->f.run, &c->pool, &c->elastic),
                   AMBULO_OK);
  c->elastic.deadline = steps;
  assert_int_equal(ambulo__relax(&c->elastic, 1e-6, c->f.x, &c->pool, &c->out, &c->remedy),
                   AMBULO_OK);
  return c;
}

static void close_cut(cut *c) {
  ambulo__pool_clear(&c->pool);
  engine_close(&c->f);
  free(c);
}

static int untried(const cut *c) {
  int count = 0;
  for (int i = 0; i < c->out.view.conflict_count; i++) count += c->out.conflict[i].alone < 0;
  return count;
}

/* Each family of these would suffice alone. However early the search ends, it never says that one
 * does not, it says that it was cut short where one was not tried, and what it says to suffice
 * does. */
static void a_search_that_is_cut_short_says_nothing_wrong(void **state) {
  (void)state;
  static const char *const names[] = {"torque_too_weak", "range_excludes_posture"};
  for (int n = 0; n < 2; n++) {
    for (double steps = 3.0; steps < 150.0; steps += 7.0) {
      cut *c = open_cut(names[n], steps);
      const ambulo__table_row *rows = c->f.problem->table.rows;
      assert_true(c->elastic.work < steps + 13.0); /* one model more */
      for (int i = 0; i < c->out.view.conflict_count; i++)
        assert_int_not_equal(c->out.conflict[i].alone, 0);
      if (untried(c)) assert_false(c->out.view.complete);
      for (int r = 0; c->remedy.conflict >= 0 && r < c->f.problem->rows; r++) {
        if (rows[r].group != rows[c->remedy.row].group)
          assert_true(ambulo__elastic_excess(&c->elastic, r, c->remedy.value[r]) <= AMBULO__HOLDS);
      }
      close_cut(c);
    }
  }
}

/* the first families leave time for the last, and the search for conflicts leaves half of it for
 * all of them */
static void time_is_shared_out(void **state) {
  (void)state;
  for (double steps = 120.0; steps < 260.0; steps += 20.0) {
    cut *c = open_cut("torque_too_weak", steps);
    assert_int_equal(c->out.view.conflict_count, 3);
    assert_int_equal(untried(c), 0);
    close_cut(c);
  }
  cut *c = open_cut("support_too_narrow", 92.0);
  assert_int_equal(c->out.view.conflict_count, 3);
  assert_true(untried(c) < 3);
  close_cut(c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(two_that_disagree_share_the_violation),
      cmocka_unit_test(three_that_disagree_have_no_single_culprit),
      cmocka_unit_test(a_point_that_satisfies_every_row_is_recognized),
      cmocka_unit_test(residues_are_not_named),
      cmocka_unit_test(one_limit_is_better_advice_than_two),
      cmocka_unit_test(one_limit_does_not_give_for_all),
      cmocka_unit_test(the_worst_row_is_made_as_small_as_it_can_be),
      cmocka_unit_test(others_are_named_at_their_worst),
      cmocka_unit_test(the_travel_alone_is_offered_where_it_suffices),
      cmocka_unit_test(a_search_that_is_cut_short_says_nothing_wrong),
      cmocka_unit_test(time_is_shared_out),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
