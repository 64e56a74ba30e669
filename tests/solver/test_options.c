/* Options outside their range are refused with the option's name. */
#include "solver/options.h"
#include "support/test.h"

static void refuse(ambulo_options options, const char *name) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo__options_check(&options, list), AMBULO_E_ARGUMENT);
  const ambulo_diagnostic *message = ambulo_diagnostics_get(list, 0);
  assert_non_null(message);
  if (!strstr(message->message, name)) print_error("%s lacks %s\n", message->message, name);
  assert_non_null(strstr(message->message, name));
  ambulo_diagnostics_free(list);
}

static void defaults_pass(void **state) {
  (void)state;
  ambulo_options options = ambulo_options_default();
  assert_int_equal(ambulo__options_check(&options, NULL), AMBULO_OK);
}

static void each_fault_is_named(void **state) {
  (void)state;
  ambulo_options zeroed = {0}, o = ambulo_options_default();
  refuse(zeroed, "ambulo_options_default");
  o.algorithm = (ambulo_algorithm)9;
  refuse(o, "algorithm");
  o = ambulo_options_default();
  o.maximum_evaluations = 0;
  refuse(o, "maximum_evaluations");
  o = ambulo_options_default();
  o.time_limit = 0.0;
  refuse(o, "solver.time_limit is 0 s; expected 1e-09 to inf, or AMBULO_OFF");
  o = ambulo_options_default();
  o.maximum_memory = -1.0;
  refuse(o, "solver.maximum_memory is -1 bytes; expected 1 to inf, or AMBULO_OFF");
  o = ambulo_options_default();
  static const double no_tolerance[] = {0.0, -1e-6, 1e-300, 1e-15, 1.1, 1e300, INFINITY, NAN};
  for (size_t i = 0; i < sizeof no_tolerance / sizeof *no_tolerance; i++) {
    o = ambulo_options_default();
    o.feasibility_tolerance = no_tolerance[i];
    refuse(o, "feasibility_tolerance");
    o = ambulo_options_default();
    o.optimality_tolerance = no_tolerance[i];
    refuse(o, "optimality_tolerance");
  }
  o = ambulo_options_default();
  o.dense_samples = 0;
  refuse(o, "dense_samples");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(defaults_pass),
                                     cmocka_unit_test(each_fault_is_named)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
