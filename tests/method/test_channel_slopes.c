/* Slopes that are kept are those that would be found, at every node and of every channel. */
#include "method/channel_slopes.h"
#include "support/engine_fixture.h"
#include "support/test.h"

static void expect(ambulo__channel_slopes *s, const ambulo_workspace *w, int node, int channel) {
  const ambulo__basis_point *point = &ambulo__lane_map_points(w->problem->map)[node];
  const int d = w->problem->coordinates;
  double want[1024], largest = 1.0;
  assert_true(point->span * d <= 1024);
  ambulo__channel_local_gradient(w, node, channel, want);
  const double *got = ambulo__channel_slopes_of(s, w, node, channel);
  for (int j = 0; j < point->span * d; j++) largest = fmax(largest, fabs(want[j]));
  for (int j = 0; j < point->span * d; j++) {
    double sum = 0.0;
    for (int o = 0; o < 3; o++) sum += point->weight[o][j / d] * got[o * d + j % d];
    assert_close(sum / largest, want[j] / largest, 1e-13);
  }
}

static void kept_slopes_are_those_of_their_node(void **state) {
  (void)state;
  static const char *const names[] = {"walk_normal", "yardstick_12", "support/walk_rigid"};
  for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
    ambulo_problem *p = load_problem(names[n]);
    ambulo_workspace *w = NULL;
    ambulo__pool pool;
    ambulo__channel_slopes g;
    double *x = calloc((size_t)p->variables, sizeof *x);
    ambulo__pool_init(&pool, NULL);
    assert_int_equal(ambulo_workspace_create(p, NULL, &w), AMBULO_OK);
    assert_int_equal(ambulo__channel_slopes_create(p, &pool, &g), AMBULO_OK);
    for (int point = 0; point < 3; point++) { /* nothing of the one before is left */
      for (int j = 0; j < p->variables; j++) x[j] = 0.1 * sin(1.0 + j + point);
      assert_int_equal(ambulo__evaluate_jacobian(w, x), AMBULO_OK);
      ambulo__channel_slopes_clear(&g);
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
  const struct CMUnitTest tests[] = {cmocka_unit_test(kept_slopes_are_those_of_their_node)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
