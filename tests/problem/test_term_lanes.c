/* Terms at a block of nodes, against the same terms one node and residual at a time. */
#include "base/lanes.h"
#include "problem/term.h"
#include "support/random_model.h"
#include "support/test.h"

enum { COORDINATES = 3, NODES = 11 };

static const double scale[] = {1.0, 0.05, 2.0}, offset[] = {0.3, -0.2, 5.0};

static ambulo_term term_of(ambulo_term_kind kind, const double *reference) {
  ambulo_term term = {.kind = kind,
                      .scale = scale,
                      .offset = offset,
                      .reference = reference,
                      .smoothing = 0.1,
                      .power = 3.0};
  return term;
}

static void blocks_are_their_nodes(void **state) {
  (void)state;
  static const ambulo_term_kind kinds[] = {AMBULO_TORQUE_SQUARED, AMBULO_TORQUE_ABSOLUTE,
                                           AMBULO_ACCELERATION,   AMBULO_TRACKING,
                                           AMBULO_TORQUE_POWER,   AMBULO_POSTURE};
  double reference[NODES * COORDINATES], y[AMBULO__LANES];
  random_source source = {3};
  for (int e = 0; e < NODES * COORDINATES; e++) reference[e] = random_between(&source, -1.0, 1.0);
  for (size_t n = 0; n < sizeof kinds / sizeof *kinds; n++) {
    ambulo_term term = term_of(kinds[n], reference);
    assert_true(ambulo__term_is_simple(&term));
    for (int k = 0; k < NODES; k += AMBULO__LANES) {
      for (int i = 0; i < COORDINATES; i++) {
        double u[AMBULO__LANES], value[AMBULO__LANES], slope[AMBULO__LANES];
        for (int l = 0; l < AMBULO__LANES; l++) y[l] = random_between(&source, -1.0, 1.0);
        ambulo__term_lanes(&term, COORDINATES, k, NODES, i, y, u);
        ambulo__term_shapes(&term, ambulo__term_least(&term), u, value, slope);
        for (int l = 0; l < AMBULO__LANES && k + l < NODES; l++) {
          double from = ambulo__term_offset(&term, COORDINATES, k + l, i);
          ambulo__residual want = ambulo__term_residual(&term, scale[i] * (y[l] - from));
          assert_close(value[l], want.value, 0.0);
          assert_close(slope[l], want.slope, 0.0);
        }
      }
    }
  }
}

static void tracking_has_nothing_beyond_the_last_node(void **state) {
  (void)state;
  double reference[NODES * COORDINATES] = {0.0}, y[AMBULO__LANES], u[AMBULO__LANES];
  ambulo_term term = term_of(AMBULO_TRACKING, reference);
  for (int l = 0; l < AMBULO__LANES; l++) y[l] = 1.0;
  ambulo__term_lanes(&term, COORDINATES, 8, NODES, 1, y, u);
  for (int l = 0; l < AMBULO__LANES; l++) assert_close(u[l], 8 + l < NODES ? 0.05 : 0.0, 0.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(blocks_are_their_nodes),
                                     cmocka_unit_test(tracking_has_nothing_beyond_the_last_node)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
