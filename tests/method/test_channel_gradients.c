/* Gradients that are kept are those that would be formed, at every node and of every channel. */
#include "method/channel_gradients.h"
#include "support/engine_fixture.h"
#include "support/test.h"

static void expect(ambulo__channel_gradients *g, const ambulo_workspace *w, int node, int channel) {
  double want[1024];
  const int width = ambulo__node_width(w->problem, node);
  assert_true(width <= 1024);
  ambulo__channel_local_gradient(w, node, channel, want);
  const double *got = ambulo__channel_gradients_of(g, w, node, channel);
  assert_memory_equal(got, want, (size_t)width * sizeof *want);
}

static void kept_gradients_are_those_of_their_node(void **state) {
  (void)state;
  static const char *const names[] = {"walk_normal", "yardstick_12", "two_step/walk_normal"};
  for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
    ambulo_problem *p = load_problem(names[n]);
    ambulo_workspace *w = NULL;
    ambulo__pool pool;
    ambulo__channel_gradients g;
    double *x = calloc((size_t)p->variables, sizeof *x);
    int widest = ambulo__basis_span(p->basis) * p->coordinates;
    ambulo__pool_init(&pool, NULL);
    assert_int_equal(ambulo_workspace_create(p, NULL, &w), AMBULO_OK);
    assert_int_equal(ambulo__channel_gradients_create(p, widest, &pool, &g), AMBULO_OK);
    for (int point = 0; point < 3; point++) { /* nothing of the one before is left */
      for (int j = 0; j < p->variables; j++) x[j] = 0.1 * sin(1.0 + j + point);
      assert_int_equal(ambulo__evaluate_jacobian(w, x), AMBULO_OK);
      ambulo__channel_gradients_clear(&g);
      for (int k = 0; k < (point == 1 ? 1 : p->nodes); k++) { /* or of its first nodes */
        for (int c = 0; c < w->channel_count; c++) {
          expect(&g, w, k, c);
          if (k < p->nodes - 1) expect(&g, w, k + 1, c); /* and again, as the node */
        }
      }
    }
    ambulo__pool_clear(&pool);
    ambulo_workspace_free(w);
    ambulo_problem_free(p);
    free(x);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(kept_gradients_are_those_of_their_node)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
