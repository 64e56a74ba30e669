/* What a YAML file says it is; versions of what is running. */
#include "support/messages.h"
#include "support/scratch.h"

#include "ambulo/ambulo.h"

static void test_kinds(void **state) {
  ambulo_file_kind kind = AMBULO_FILE_MODEL;
  const char *path = scratch_path(state, "file.yaml");
  scratch_write(path, "ambulo: 1\nkind: problem\n");
  assert_int_equal(ambulo_file_kind_of(path, NULL, NULL, &kind), AMBULO_OK);
  assert_int_equal(kind, AMBULO_FILE_PROBLEM);
  scratch_write(path, "ambulo: 1\nkind: model\n");
  assert_int_equal(ambulo_file_kind_of(path, NULL, NULL, &kind), AMBULO_OK);
  assert_int_equal(kind, AMBULO_FILE_MODEL);
}

static void test_neither(void **state) {
  ambulo_file_kind kind = AMBULO_FILE_PROBLEM;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  const char *path = scratch_path(state, "file.yaml");
  scratch_write(path, "ambulo: 1\nkind: modell\n");
  assert_int_equal(ambulo_file_kind_of(path, NULL, list, &kind), AMBULO_E_SCHEMA);
  assert_message(list, 0, "file.yaml:2:7: error[E_SCHEMA]");
  ambulo_diagnostics_clear(list);
  scratch_write(path, "ambulo: 1\n");
  assert_int_equal(ambulo_file_kind_of(path, NULL, list, &kind), AMBULO_E_SCHEMA);
  assert_message(list, 0, "'kind'");
  scratch_write(path, "a: [\n");
  assert_int_equal(ambulo_file_kind_of(path, NULL, NULL, &kind), AMBULO_E_PARSE);
  assert_int_equal(ambulo_file_kind_of(scratch_path(state, "none"), NULL, NULL, &kind),
                   AMBULO_E_IO);
  assert_int_equal(kind, AMBULO_FILE_PROBLEM);
  ambulo_diagnostics_free(list);
}

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
}

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

int main(void) {
  const struct CMUnitTest tests[] = {SCRATCH_TEST(test_kinds), SCRATCH_TEST(test_neither),
                                     cmocka_unit_test(test_versions)};
  return cmocka_run_group_tests_name("report/file_kind", tests, NULL, NULL);
}
