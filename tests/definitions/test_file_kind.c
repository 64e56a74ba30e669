/* What a YAML file says it is. */
#include "support/messages.h"
#include "support/scratch.h"

#include "ambulo/tools/tools.h"

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

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

int main(void) {
  const struct CMUnitTest tests[] = {SCRATCH_TEST(test_kinds), SCRATCH_TEST(test_neither)};
  return cmocka_run_group_tests_name("reader/file_kind", tests, NULL, NULL);
}
