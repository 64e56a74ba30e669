/* Options of the tools start from their defaults, in structures of older headers, too. */
#include "ambulo/tools/tools.h"
#include "support/test.h"

static void options_have_their_defaults(void **state) {
  (void)state;
  ambulo_inverse_options inverse = ambulo_inverse_options_default();
  assert_int_equal(inverse.size, sizeof inverse);
  assert_true(inverse.length_unit == 1.0 && isnan(inverse.cutoff));
  assert_int_equal(inverse.filter_order, 4);
  assert_null(inverse.forces);
  ambulo_compare_options compare = ambulo_compare_options_default();
  assert_close(compare.pelvic_tilt, 11.4 * 3.14159265358979323846 / 180.0, 1e-15);
  assert_int_equal(ambulo_batch_options_default().shards, 1);
  assert_int_equal(ambulo_export_options_default().format, AMBULO_EXPORT_OPENSIM);
  assert_true(isnan(ambulo_subject_default().mass));
}

static void older_structures_are_filled_to_their_end(void **state) {
  (void)state;
  ambulo_inverse_options older;
  size_t bytes = offsetof(ambulo_inverse_options, filter_order);
  memset(&older, 0x5a, sizeof older);
  assert_int_equal(ambulo_tool_defaults("ambulo_inverse_options", &older, bytes), AMBULO_OK);
  assert_int_equal(older.size, bytes);
  assert_true(older.time_unit == 1.0);
  assert_int_equal(older.filter_order, 0x5a5a5a5a);
}

static void other_structures_are_refused(void **state) {
  (void)state;
  ambulo_options options = ambulo_options_default();
  assert_int_equal(ambulo_tool_defaults("ambulo_options", &options, sizeof options),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(options.maximum_iterations, 150);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(options_have_their_defaults),
                                     cmocka_unit_test(older_structures_are_filled_to_their_end),
                                     cmocka_unit_test(other_structures_are_refused)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
