/* The finer grid: the same trajectory and rows, no objective, contacts moved but for those at the
 * ends; and how fine it may be. */
#include "solver/dense.h"
#include "ambulo/tools/load.h"
#include "support/dense_fixture.h"
#include "support/engine_fixture.h"

/* a finer problem may have as many intervals as any */
static void a_grid_is_as_fine_as_a_problem_may_be(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("pendulum_swing");
  static const int intervals[] = {20, 10000, 10001, 50000, 50001}, samples[] = {10, 10, 9, 2, 1};
  for (int i = 0; i < 5; i++) {
    p->definition.intervals = intervals[i];
    assert_int_equal(ambulo__dense_samples(p, 10), samples[i]);
  }
  p->definition.intervals = 20;
  ambulo_problem_free(p);
}

/* rows and terms of the caller may count nodes, references have a value for each: neither is
 * asked on a grid that is not theirs */
static void callbacks_are_not_asked_off_their_nodes(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("walk_tracking");
  ambulo__dense dense;
  double *x = calloc((size_t)p->variables, sizeof *x);
  ambulo_user_row row = {.name = "own", .unit = "m", .relation = AMBULO_EQUAL, .to = 1.0};
  assert_true(p->definition.term_count > 0);
  const ambulo_user_row *kept = p->definition.user_rows;
  p->definition.user_rows = &row;
  p->definition.user_row_count = 1;
  assert_int_equal(ambulo__dense_open(p, x, 10, 0.0, NULL, NULL, &dense), AMBULO_OK);
  assert_int_equal(dense.fine->definition.term_count, 0);
  assert_int_equal(dense.fine->nodes, 10 * (p->nodes - 1) + 1);
  assert_int_equal(dense.fine->variables, p->variables);
  for (int r = 0; r < dense.fine->rows; r++)
    assert_true(dense.fine->table.rows[r].kind != AMBULO__KIND_USER);
  ambulo__dense_close(&dense);
  p->definition.user_rows = kept;
  p->definition.user_row_count = 0;
  free(x);
  ambulo_problem_free(p);
}

/* every row of the finer grid, those that are not linear too, is what an evaluation there says */
static void rows_are_those_of_an_evaluation(void **state) {
  (void)state;
  static const char *const settings[] = {"constraints.clearance.feet=0.01"};
  ambulo_problem *p = NULL;
  ambulo_workspace *workspace = NULL;
  ambulo__dense dense;
  int arcs = 0, gaps = 0;
  assert_int_equal(ambulo_problem_load("models/walk_normal.yaml", settings, 1, NULL, NULL, &p),
                   AMBULO_OK);
  double *x = calloc((size_t)p->variables, sizeof *x);
  for (int j = 0; j < p->variables; j++) x[j] = 0.1 * sin(7.0 * j);
  assert_int_equal(ambulo__dense_open(p, x, 2, 0.0, NULL, NULL, &dense), AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(dense.fine, NULL, &workspace), AMBULO_OK);
  assert_int_equal(ambulo__evaluate(workspace, x), AMBULO_OK);
  for (int r = 0; r < dense.fine->rows; r++) {
    const ambulo__table_row *row = &dense.fine->table.rows[r];
    const ambulo__curved *curved = ambulo__row_curved_of(&dense.fine->table, row);
    arcs += curved && curved->form == AMBULO__CURVED_ARC;
    gaps += curved && curved->form == AMBULO__CURVED_APART;
    if (row->node >= 0) assert_close(dense.row_value[r], workspace->row_value[r], 1e-12);
  }
  assert_true(arcs > 50 && gaps > 50);
  ambulo_workspace_free(workspace);
  ambulo__dense_close(&dense);
  free(x);
  ambulo_problem_free(p);
}

/* every interval of a grid on events is divided, so that its nodes stay nodes; the trajectory keeps
 * its knots although they sat on events that have moved */
static void grids_on_events_are_divided(void **state) {
  (void)state;
  static const char *const settings[] = {"time.grid=events", "trajectory.knots=events"};
  ambulo_problem *p = NULL;
  assert_int_equal(
      ambulo_problem_load("tests/support/walk_rigid.yaml", settings, 2, NULL, NULL, &p), AMBULO_OK);
  double *x = calloc((size_t)p->variables, sizeof *x);
  for (int shifted = 0; shifted < 2; shifted++) {
    ambulo__dense dense;
    assert_int_equal(ambulo__dense_open(p, x, 4, 0.001 * shifted, NULL, NULL, &dense), AMBULO_OK);
    assert_int_equal(dense.fine->nodes, 4 * 25 + 1);
    for (int k = 0; k < 25; k++) {
      assert_true(dense.fine->times[4 * k] == p->times[k]);
      assert_close(dense.fine->times[4 * k + 2], 0.5 * (p->times[k] + p->times[k + 1]), 1e-15);
    }
    for (int i = 0; i <= 17; i++) {
      assert_true(ambulo__basis_breakpoints(dense.fine->basis)[i] ==
                  ambulo__basis_breakpoints(p->basis)[i]);
    }
    ambulo__dense_close(&dense);
  }
  free(x);
  ambulo_problem_free(p);
}

/* both ends of a contact move, by as much; what begins at 0 or ends at T stays */
static void contacts_move_but_for_the_ends(void **state) {
  (void)state;
  static const double shifts[] = {0.01, -0.01};
  for (int k = 0; k < 2; k++) {
    dense_fixture f;
    dense_open(&f, 20);
    const ambulo_problem_definition *d = &f.problem->definition;
    int moved = 0;
    assert_int_equal(ambulo__dense_open(f.problem, f.x, 5, shifts[k], NULL, NULL, &f.dense),
                     AMBULO_OK);
    const ambulo_problem_definition *fine = &f.dense.fine->definition;
    assert_int_equal(fine->contact_count, d->contact_count);
    for (int i = 0; i < d->contact_count; i++) {
      const double own[] = {d->contacts[i].from, d->contacts[i].to};
      const double now[] = {fine->contacts[i].from, fine->contacts[i].to};
      for (int end = 0; end < 2; end++) {
        int inside = own[end] > 1e-9 && own[end] < d->duration - 1e-9;
        assert_close(now[end], own[end] + (inside ? shifts[k] : 0.0), 1e-15);
        moved += inside;
      }
    }
    assert_true(moved >= 3);
    dense_close(&f);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_grid_is_as_fine_as_a_problem_may_be),
      cmocka_unit_test(callbacks_are_not_asked_off_their_nodes),
      cmocka_unit_test(rows_are_those_of_an_evaluation),
      cmocka_unit_test(grids_on_events_are_divided),
      cmocka_unit_test(contacts_move_but_for_the_ends),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
