/* Dependent rows are found and named; contradictions are distinguished from copies. */
#include "support/arm.h"
#include "ambulo/tools/load.h"
#include "support/engine_fixture.h"

static void flat_soles_and_the_periodic_end_are_dropped(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  const ambulo_problem *p = f.problem;
  int soles = 0, copies = 0;
  for (int r = 0; r < p->rows; r++) {
    if (f.engine->linearized.rows.rank[r] != AMBULO__ROW_DEPENDENT) continue;
    const ambulo__table_row *row = &p->table.rows[r];
    if (row->node == p->nodes - 1) {
      copies++;
    } else {
      assert_string_equal(row->family, "ground_penetration");
      soles++;
    }
  }
  assert_int_equal(soles, 8);
  assert_int_equal(copies, 8);
  assert_int_equal(f.engine->linearized.rows.dropped, 16);
  assert_int_equal(f.engine->setup->equalities + f.engine->setup->borders + 16, p->equalities);
  engine_close(&f);
}

static double shoulder_at_0_4(void *user, const ambulo_node_state *state,
                              ambulo_node_gradient *gradient) {
  (void)user;
  if (gradient) gradient->q[0] += 1.0;
  return state->q[0] - 0.4;
}

/* row: a caller's own, or NULL */
static int ranks_of(const ambulo_end_value *ends, int count, const ambulo_user_row *row,
                    ambulo__row_rank *last, ambulo_diagnostics *list) {
  ambulo_model *model = arm_create();
  ambulo_problem_definition definition = arm_definition(model);
  definition.end_values = ends;
  definition.end_value_count = count;
  definition.ends = AMBULO_ENDS_FREE;
  definition.user_rows = row;
  definition.user_row_count = row ? 1 : 0;
  ambulo_problem *problem = NULL;
  ambulo_workspace *workspace = NULL;
  ambulo__pool pool;
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &problem), AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  int *rank = calloc((size_t)problem->rows, sizeof *rank), dropped = 0;
  double *x = calloc((size_t)problem->variables, sizeof *x);
  assert_int_equal(ambulo__presolve_rank(problem, workspace, x, NULL, &pool, list, rank),
                   AMBULO_OK);
  for (int r = 0; r < problem->rows; r++) {
    if (rank[r] == AMBULO__ROW_INDEPENDENT) continue;
    *last = (ambulo__row_rank)rank[r];
    dropped++;
  }
  free(rank);
  free(x);
  ambulo__pool_clear(&pool);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
  return dropped;
}

static void repeated_value_is_a_copy(void **state) {
  (void)state;
  ambulo_end_value ends[] = {{0, 0, 0, 0.3}, {0, 0, 1, 0.5}, {0, 0, 0, 0.3}};
  ambulo__row_rank last = AMBULO__ROW_INDEPENDENT;
  assert_int_equal(ranks_of(ends, 3, NULL, &last, NULL), 1);
  assert_int_equal(last, AMBULO__ROW_DEPENDENT);
}

/* prescribed values that differ are refused earlier; a caller's own row is only met here */
static void two_values_at_once_contradict_each_other(void **state) {
  (void)state;
  ambulo_end_value ends[] = {{0, 0, 0, 0.3}, {0, 0, 1, 0.5}};
  ambulo_user_row row = {"own", "rad", AMBULO_EQUAL, 0.0, 0.0, shoulder_at_0_4, NULL};
  ambulo__row_rank last = AMBULO__ROW_INDEPENDENT;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ranks_of(ends, 2, &row, &last, list), 1);
  assert_int_equal(last, AMBULO__ROW_CONTRADICTORY);
  assert_int_equal(ambulo_diagnostics_count(list), 1);
  const ambulo_diagnostic *message = ambulo_diagnostics_get(list, 0);
  if (!strstr(message->message, "initial_state") && !strstr(message->message, "own"))
    print_error("%s\n", message->message);
  assert_true(strstr(message->message, "initial_state") || strstr(message->message, "own"));
  ambulo_diagnostics_free(list);
}

/* q_0 + a thousandth of q_1 beside q_0: nearly the same, and a row of its own */
static double nearly_the_shoulder(void *user, const ambulo_node_state *state,
                                  ambulo_node_gradient *gradient) {
  (void)user;
  if (gradient) {
    gradient->q[0] += 1.0;
    gradient->q[1] += 1e-3;
  }
  return state->q[0] + 1e-3 * state->q[1] - 0.3;
}

/* where the hand is ahead, which a straight arm does not change */
static double reach(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  (void)user;
  if (gradient) gradient->points[0] += 1.0;
  return state->points[0] - 0.4;
}

/* nearly dependent, or without a slope where the search starts: not dependent */
static void independent_rows_stay(void **state) {
  (void)state;
  ambulo_end_value ends[] = {{0, 0, 0, 0.3}, {0, 0, 1, 0.5}};
  ambulo_user_row nearly = {"own", "rad", AMBULO_EQUAL, 0.0, 0.0, nearly_the_shoulder, NULL};
  ambulo_user_row straight = {"own", "m", AMBULO_EQUAL, 0.5, 0.5, reach, NULL};
  ambulo__row_rank last = AMBULO__ROW_INDEPENDENT;
  assert_int_equal(ranks_of(ends, 2, &nearly, &last, NULL), 0);
  assert_int_equal(ranks_of(ends, 2, &straight, &last, NULL), 0);
}

/* of contradictions at every node five are reported */
static void the_first_contradictions_are_told(void **state) {
  (void)state;
  double reference[4] = {0.0}, width[2] = {0.0, INFINITY};
  ambulo_model *model = arm_create();
  ambulo_problem_definition d = arm_definition(model);
  ambulo_tube tube = {2, reference, width};
  ambulo_user_row row = {"own", "rad", AMBULO_EQUAL, 0.0, 1.0, shoulder_at_0_4, NULL};
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  engine_fixture f = {.options = ambulo_options_default()};
  d.end_value_count = 0;
  d.tubes = &tube;
  d.tube_count = 1;
  d.user_rows = &row;
  d.user_row_count = 1;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &f.problem), AMBULO_OK);
  f.x = calloc((size_t)f.problem->variables, sizeof *f.x);
  ambulo__run_begin(&f.run, &f.options);
  assert_int_equal(ambulo__engine_create(f.problem, f.x, NULL, &f.run, list, &f.engine), AMBULO_OK);
  assert_true(f.engine->setup->rows->dropped >= 11);
  assert_int_equal(ambulo_diagnostics_count(list), 5);
  engine_close(&f);
  ambulo_diagnostics_free(list);
  ambulo_model_free(model);
}

static double squared(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  (void)user;
  if (gradient) gradient->q[0] += 2.0 * state->q[0];
  return state->q[0] * state->q[0];
}

/* a row of the caller is measured by its gradient; by a millionth where that vanishes */
static void rows_without_a_gradient_have_a_size(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition d = arm_definition(model);
  ambulo_user_row row = {"own", "rad", AMBULO_NOT_NEGATIVE, 0.5, 0.5, squared, NULL};
  engine_fixture f = {.options = ambulo_options_default()};
  d.end_value_count = 0;
  d.user_rows = &row;
  d.user_row_count = 1;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &f.problem), AMBULO_OK);
  f.x = calloc((size_t)f.problem->variables, sizeof *f.x);
  ambulo__run_begin(&f.run, &f.options);
  assert_int_equal(ambulo__engine_create(f.problem, f.x, NULL, &f.run, NULL, &f.engine), AMBULO_OK);
  const ambulo__row_roles *rows = f.engine->setup->rows;
  int own = 0;
  for (int i = 0; i < rows->inequality.count; i++) {
    if (f.problem->table.rows[rows->inequality.row[i]].kind != AMBULO__KIND_USER) continue;
    assert_close(rows->size[i], 1e-6, 1e-18);
    own++;
  }
  assert_int_equal(own, 1);
  engine_close(&f);
  ambulo_model_free(model);
}

/* limits on unknowns that share no node have no place in a band */
static void rows_without_a_node_are_not_regular(void **state) {
  (void)state;
  static const char *const overrides[] = {"constraints.joint_limits=control_points",
                                          "time.intervals=6", "trajectory.intervals=40"};
  for (int count = 0; count <= 3; count += 3) {
    engine_fixture f = {.options = ambulo_options_default()};
    assert_int_equal(
        ambulo_problem_load("models/pendulum_swing.yaml", overrides, count, NULL, NULL, &f.problem),
        AMBULO_OK);
    f.x = calloc((size_t)f.problem->variables, sizeof *f.x);
    ambulo__run_begin(&f.run, &f.options);
    assert_int_equal(ambulo__engine_create(f.problem, f.x, NULL, &f.run, NULL, &f.engine),
                     AMBULO_OK);
    assert_int_equal(f.engine->setup->rows->regular, count == 0);
    engine_close(&f);
  }
}

static void rows_are_measured_by_their_sizes(void **state) {
  (void)state;
  engine_fixture f;
  engine_open_with(&f, "support/walk_rigid", "constraints.torque_limits=true");
  ambulo__row_roles *rows = &f.engine->linearized.rows;
  int other = 0;
  for (int i = 0; i < rows->inequality.count; i++) {
    double size = f.problem->table.rows[rows->inequality.row[i]].size;
    assert_true(rows->size[i] == size &&
                ambulo__rows_size(f.problem, &rows->inequality, i) == size);
    assert_close(rows->inequality.scale[i] * size, -1.0, 1e-14);
    other |= size != 1.0;
  }
  assert_true(other);
  assert_int_equal(rows->regular, 1);
  assert_int_equal(ambulo__rows_contradict(rows, f.problem->rows), 0);
  rows->rank[f.problem->rows - 1] = AMBULO__ROW_CONTRADICTORY;
  assert_int_equal(ambulo__rows_contradict(rows, f.problem->rows), 1);
  assert_int_equal(ambulo__rows_contradict(rows, f.problem->rows - 1), 0);
  engine_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(flat_soles_and_the_periodic_end_are_dropped),
      cmocka_unit_test(repeated_value_is_a_copy),
      cmocka_unit_test(two_values_at_once_contradict_each_other),
      cmocka_unit_test(independent_rows_stay),
      cmocka_unit_test(the_first_contradictions_are_told),
      cmocka_unit_test(rows_without_a_gradient_have_a_size),
      cmocka_unit_test(rows_without_a_node_are_not_regular),
      cmocka_unit_test(rows_are_measured_by_their_sizes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
