/* Versions of what is running: from the libraries themselves. */
#include "ambulo/tools/tools.h"
#include "support/test.h"

static void test_versions(void **state) {
  (void)state;
  ambulo_versions v;
  int major, minor, patch;
  ambulo_versions_get(&v);
  assert_string_equal(v.ambulo, AMBULO_VERSION_STRING);
  assert_int_equal(sscanf(v.nlopt, "%d.%d.%d", &major, &minor, &patch), 3);
  assert_int_equal(sscanf(v.libyaml, "%d.%d.%d", &major, &minor, &patch), 3);
  assert_string_equal(v.instruction_set, ambulo_instruction_set());
  assert_true(strlen(v.blas) > 3);
  assert_null(strchr(v.blas, '\n'));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_versions)};
  return cmocka_run_group_tests_name("report/versions", tests, NULL, NULL);
}
