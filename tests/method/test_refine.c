/* Coarse grids: which, what they carry over, and when there are none. */
#include "method/refine.h"
#include "problem/nlp.h"
#include "support/arm.h"
#include "support/engine_fixture.h"

static double refine(engine_fixture *f, int *levels) {
  assert_int_equal(ambulo__refine(f->engine, NULL, f->x, levels), AMBULO_OK);
  assert_int_equal(ambulo__evaluate(f->engine->workspace, f->x), AMBULO_OK);
  return f->engine->workspace->objective;
}

/* 36 intervals start from 12, whose optimum is known */
static void the_next_grid_is_carried_over(void **state) {
  (void)state;
  engine_fixture f;
  int levels = -1, forces = 0;
  engine_open(&f, "yardstick_36");
  for (int i = 0; i < f.engine->setup->inequalities; i++) f.engine->iterate.lambda[i] = -1.0;
  (void)refine(&f, &levels);
  assert_int_equal(levels, 1);
  assert_close(f.engine->iterate.carried_objective / 0.35640, 1.0, 2e-2); /* it is left early */
  for (int i = 0; i < f.engine->setup->inequalities; i++) {
    assert_true(f.engine->iterate.lambda[i] >= 0.0);
    forces += f.engine->iterate.lambda[i] > 0.0;
  }
  assert_true(forces > 10);
  engine_close(&f);
}

static void few_intervals_have_no_coarser_grid(void **state) {
  (void)state;
  engine_fixture f;
  int levels = -1;
  engine_open(&f, "yardstick_12");
  (void)refine(&f, &levels);
  assert_int_equal(levels, 0);
  for (int j = 0; j < f.n; j++) assert_true(f.x[j] == 0.0);
  assert_true(f.engine->iterate.carried_objective < 0.0);
  assert_int_equal(f.run.evaluations, 0);
  engine_close(&f);
}

/* 25 intervals of five phases start from 12; 36 of nine do not: 12 would be fewer than two a phase.
 * A trajectory of 6 keeps the 4 that its knots on events need, not 3 */
static void grids_on_events_stop_where_phases_have_too_few(void **state) {
  (void)state;
  static const struct {
    const char *name, *override;
    int levels;
  } all[] = {{"yardstick_36", "time.grid=events", 0},
             {"support/walk_rigid", "time.grid=events", 1},
             {"support/walk_rigid", "trajectory={degree: 4, intervals: 6, knots: events}", 1}};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
    engine_fixture f;
    int levels = -1;
    engine_open_with(&f, all[i].name, all[i].override);
    (void)refine(&f, &levels);
    assert_int_equal(levels, all[i].levels);
    assert_true((f.run.evaluations > 0) == all[i].levels);
    engine_close(&f);
  }
}

/* Half the nodes are two for each of 14 knot intervals: the trajectory keeps them all, and its
 * objective is near to the walk's 0.1231. With 7 it is 0.14. */
static void coarse_trajectories_keep_what_two_nodes_hold(void **state) {
  (void)state;
  engine_fixture f;
  int levels = -1;
  engine_open(&f, "walk_normal");
  (void)refine(&f, &levels);
  assert_int_equal(levels, 1);
  assert_close(f.engine->iterate.carried_objective / 0.1231, 1.0, 0.05);
  engine_close(&f);
}

/* On 14 intervals feet on their places, head at its own and rest at both ends contradict each other
 * by 22 mm: that is left, for a start without multipliers. */
static void a_grid_without_room_is_left_early(void **state) {
  (void)state;
  engine_fixture f;
  int levels = -1;
  engine_open_with(&f, "reach_standing", "time.intervals=28");
  (void)refine(&f, &levels);
  assert_int_equal(levels, 1);
  assert_in_range(f.run.iterations, 7, 25); /* 72 until nothing helps */
  assert_true(f.engine->iterate.carried_objective < 0.0);
  for (int i = 0; i < f.engine->setup->inequalities; i++)
    assert_true(f.engine->iterate.lambda[i] == 0.0);
  engine_close(&f);
}

static double height(void *user, const ambulo_node_state *s, ambulo_node_gradient *g) {
  (void)user;
  if (g) g->points[1] += 1.0;
  return s->points[1];
}

/* functions of the caller may count nodes: they are asked on his grid alone */
static void callbacks_have_no_coarser_grid(void **state) {
  (void)state;
  for (int kind = 0; kind < 3; kind++) {
    engine_fixture f = {.options = ambulo_options_default()};
    int levels = -1;
    ambulo_model *model = arm_create();
    ambulo_problem_definition d = arm_definition(model);
    ambulo_term term = ambulo_term_default(AMBULO_USER_TERM);
    ambulo_user_row row = {"low", "m", AMBULO_NOT_NEGATIVE, 0.0, 1.0, height, NULL};
    term.function = height;
    d.intervals = 32;
    if (kind == 1) d.terms = &term;
    if (kind == 2) d.user_rows = &row;
    d.user_row_count = kind == 2;
    assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &f.problem), AMBULO_OK);
    f.n = ambulo_problem_variable_count(f.problem);
    f.x = calloc((size_t)f.n, sizeof *f.x);
    ambulo__run_begin(&f.run, &f.options);
    assert_int_equal(ambulo__engine_create(f.problem, f.x, NULL, &f.run, NULL, &f.engine),
                     AMBULO_OK);
    (void)refine(&f, &levels);
    assert_int_equal(levels, kind == 0);
    assert_int_equal(f.run.evaluations > 0, kind == 0);
    engine_close(&f);
    ambulo_model_free(model);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_next_grid_is_carried_over),
      cmocka_unit_test(few_intervals_have_no_coarser_grid),
      cmocka_unit_test(grids_on_events_stop_where_phases_have_too_few),
      cmocka_unit_test(coarse_trajectories_keep_what_two_nodes_hold),
      cmocka_unit_test(a_grid_without_room_is_left_early),
      cmocka_unit_test(callbacks_have_no_coarser_grid),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
