/* From zero to a point that satisfies every equality. */
#include "problem/callbacks.h"
#include "support/arm.h"
#include "support/engine_fixture.h"

static void equalities_hold_after(const char *name) {
  engine_fixture f;
  engine_open_restored(&f, name);
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  for (int r = 0; r < f.problem->rows; r++) {
    if (f.problem->table.rows[r].relation != AMBULO_EQUAL) continue;
    assert_close(f.engine->workspace->row_value[r], 0.0, 1e-8);
  }
  engine_close(&f);
}

static void yardstick_walks(void **state) {
  (void)state;
  equalities_hold_after("yardstick_12");
}

static void mirrored_step_closes(void **state) {
  (void)state;
  equalities_hold_after("walker_2d_step");
}

static void end_states_are_met(void **state) {
  (void)state;
  equalities_hold_after("two_link_reach");
}

static void a_run_that_is_over_does_not_move(void **state) {
  (void)state;
  engine_fixture f;
  double error;
  engine_open(&f, "yardstick_12");
  unsigned seed = 7;
  double *start = calloc((size_t)f.n, sizeof *start);
  for (int j = 0; j < f.n; j++) f.x[j] = start[j] = 2.0 * random_number(&seed);
  f.options.maximum_evaluations = 0; /* the first point is all there is */
  assert_int_equal(ambulo__restore(f.engine, f.x, &error), AMBULO_OK);
  assert_true(error > 1e-3 && memcmp(start, f.x, (size_t)f.n * sizeof *start) == 0);
  free(start);
  engine_close(&f);
}

/* q_0^3 = 0.001 at 0.5 s: from 0.02 Newton's method goes beyond 0.3, where it is worse off; from
 * `wall` on there are no values; after `calls` of them the run is over */
typedef struct cubic {
  double wall;
  int calls;
  ambulo__run *run;
} cubic;

static double cubed(void *user, const ambulo_node_state *s, ambulo_node_gradient *g) {
  cubic *c = user;
  double q = s->q[0];
  if (g) g->q[0] += 3.0 * q * q;
  if (--c->calls == 0) c->run->stopped = 1;
  return q > c->wall ? (double)NAN : q * q * q - 0.001;
}

static double restore_cubic(cubic *c, double *q) {
  ambulo_model *model = arm_create();
  ambulo_problem_definition d = arm_definition(model);
  ambulo_user_row row = {"own", "", AMBULO_EQUAL, 0.5, 0.5, cubed, c};
  engine_fixture f = {.options = ambulo_options_default()};
  double error = -1.0;
  int calls = c->calls;
  d.end_value_count = 0;
  d.user_rows = &row;
  d.user_row_count = 1;
  d.terms = NULL;
  d.term_count = 0;
  c->run = &f.run;
  c->calls = -1;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &f.problem), AMBULO_OK);
  f.x = calloc((size_t)f.problem->variables, sizeof *f.x);
  for (int j = 0; j < f.problem->variables; j += ARM_COORDINATES) f.x[j] = 0.02;
  ambulo__run_begin(&f.run, &f.options);
  assert_int_equal(ambulo__engine_create(f.problem, f.x, NULL, &f.run, NULL, &f.engine), AMBULO_OK);
  f.engine->iterate.mu = 0.05;
  f.engine->iterate.rho = 10.0;
  c->calls = calls;
  assert_int_equal(ambulo__restore(f.engine, f.x, &error), AMBULO_OK);
  c->calls = -1;
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  ambulo_node_state at;
  double *state = calloc((size_t)f.engine->workspace->channel_count, sizeof *state);
  ambulo__node_state_fill(f.engine->workspace, 5, state);
  at = ambulo__node_state_view(f.problem, 5, state);
  *q = at.q[0];
  free(state);
  engine_close(&f);
  ambulo_model_free(model);
  return error;
}

static void steps_into_nothing_are_halved(void **state) {
  (void)state;
  cubic c = {.wall = 0.2, .calls = -1};
  double q, error = restore_cubic(&c, &q);
  assert_true(error < 1e-9);
  assert_close(q, 0.1, 1e-6);
}

/* nothing but the start has a value: it stays */
static void without_a_way_the_start_stays(void **state) {
  (void)state;
  cubic c = {.wall = 0.02 + 1e-6, .calls = -1};
  double q, error = restore_cubic(&c, &q);
  assert_close(q, 0.02, 1e-9);
  assert_true(error > 1e-6);
}

static void the_best_point_on_the_way_is_kept(void **state) {
  (void)state;
  cubic c = {.wall = INFINITY, .calls = 2};
  double q, error = restore_cubic(&c, &q);
  assert_close(q, 0.02, 1e-9);
  assert_true(error < 1.1 * 0.001 / 1e-3); /* relative to the row's size */
}

/* a metric that cannot be factored is remembered: where x stays says nothing about the rows */
static void a_breakdown_is_remembered(void **state) {
  (void)state;
  engine_fixture f;
  double error;
  engine_open(&f, "yardstick_12");
  f.engine->iterate.mu = -1e9;
  assert_int_equal(ambulo__restore(f.engine, f.x, &error), AMBULO_OK);
  assert_true(error > 1e-6);
  assert_int_equal(f.run.breakdowns, 1);
  engine_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(yardstick_walks),
                                     cmocka_unit_test(mirrored_step_closes),
                                     cmocka_unit_test(end_states_are_met),
                                     cmocka_unit_test(a_run_that_is_over_does_not_move),
                                     cmocka_unit_test(steps_into_nothing_are_halved),
                                     cmocka_unit_test(without_a_way_the_start_stays),
                                     cmocka_unit_test(the_best_point_on_the_way_is_kept),
                                     cmocka_unit_test(a_breakdown_is_remembered)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
