/* Principal components: motions of two ways are two components, and no more. */
#include "show/principal.h"

#include "support/test.h"

enum { COUNT = 9, SERIES = 2, SAMPLES = 50, VALUES = SERIES * SAMPLES };

static float motion[COUNT][VALUES];
static const float *rows[COUNT];
static double mean[VALUES], weights[COUNT * COUNT], left[COUNT];

static ambulo__motions two_ways(void) {
  for (int i = 0; i < COUNT; i++) {
    rows[i] = motion[i];
    for (int v = 0; v < VALUES; v++)
      motion[i][v] = (float)(5.0 + (i - 4) * 8.0 * sin(0.1 * v) + (i * i % 5) * cos(0.07 * v));
  }
  for (int v = 0; v < VALUES; v++) {
    mean[v] = 0.0;
    for (int i = 0; i < COUNT; i++) mean[v] += (double)motion[i][v] / COUNT;
  }
  return (ambulo__motions){.motion = rows,
                           .count = COUNT,
                           .series = SERIES,
                           .samples = SAMPLES,
                           .every = 1,
                           .finer = 1.0};
}

static void weights_are_orthogonal(void **state) {
  (void)state;
  ambulo__motions m = two_ways();
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__principal_weights(&m, mean, &a, weights, left), AMBULO_OK);
  for (int k = 0; k < COUNT; k++)
    for (int j = 0; j <= k; j++) {
      double sum = 0.0;
      for (int i = 0; i < COUNT; i++) sum += weights[k * COUNT + i] * weights[j * COUNT + i];
      assert_close(sum / COUNT, j == k ? 1.0 : 0.0, 1e-12);
    }
}

static void two_components_are_all(void **state) {
  (void)state;
  ambulo__motions m = two_ways();
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__principal_weights(&m, mean, &a, weights, left), AMBULO_OK);
  assert_true(left[0] > left[1] && left[1] > 1e-3 && left[2] < 1e-10);
  for (int v = 0; v < VALUES; v++) {
    double b[2] = {0.0, 0.0};
    for (int k = 0; k < 2; k++)
      for (int i = 0; i < COUNT; i++)
        b[k] += weights[k * COUNT + i] * ((double)motion[i][v] - mean[v]) / COUNT;
    for (int i = 0; i < COUNT; i++)
      assert_close(mean[v] + weights[i] * b[0] + weights[COUNT + i] * b[1], motion[i][v], 1e-6);
  }
}

/* what is left is the mean square of every fourth value */
static void what_is_left(void **state) {
  (void)state;
  ambulo__motions m = two_ways();
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__principal_weights(&m, mean, &a, weights, left), AMBULO_OK);
  double sum = 0.0;
  for (int i = 0; i < COUNT; i++)
    for (int v = 0; v < VALUES; v += 4) sum += pow((double)motion[i][v] - mean[v], 2.0);
  assert_close(left[0], sum / (COUNT * (VALUES / 4)), 1e-9);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(weights_are_orthogonal),
      cmocka_unit_test(two_components_are_all),
      cmocka_unit_test(what_is_left),
  };
  return cmocka_run_group_tests_name("page/principal", tests, NULL, NULL);
}
