#include "ambulo/ambulo.h"
#include "support/test.h"

/* the exit codes are a contract with scripts */
static void names_and_exit_codes(void **state) {
  (void)state;
  static const struct {
    ambulo_status status;
    const char *name;
    int exit_code;
  } want[] = {{AMBULO_OK, "OK", 0},
              {AMBULO_E_ARGUMENT, "E_ARGUMENT", 2},
              {AMBULO_E_IO, "E_IO", 4},
              {AMBULO_E_PARSE, "E_PARSE", 3},
              {AMBULO_E_SCHEMA, "E_SCHEMA", 3},
              {AMBULO_E_MODEL, "E_MODEL", 3},
              {AMBULO_E_PROBLEM, "E_PROBLEM", 3},
              {AMBULO_E_LIMIT, "E_LIMIT", 5},
              {AMBULO_E_MEMORY, "E_MEMORY", 5},
              {AMBULO_E_NUMERIC, "E_NUMERIC", 1},
              {AMBULO_E_INTERNAL, "E_INTERNAL", 6}};
  for (size_t i = 0; i < sizeof want / sizeof want[0]; i++) {
    assert_string_equal(ambulo_status_name(want[i].status), want[i].name);
    assert_int_equal(ambulo_status_exit_code(want[i].status), want[i].exit_code);
    assert_true(strlen(ambulo_status_text(want[i].status)) > 5);
  }
}

static void unknown_status_is_still_a_text(void **state) {
  (void)state;
  ambulo_status unknown = (ambulo_status)999;
  assert_string_equal(ambulo_status_name(unknown), "E_UNKNOWN");
  assert_non_null(ambulo_status_text(unknown));
  assert_int_equal(ambulo_status_exit_code(unknown), 6);
}

static void version_is_the_header_version(void **state) {
  (void)state;
  assert_string_equal(ambulo_version(), AMBULO_VERSION_STRING);
  char numbers[40];
  (void)snprintf(numbers, sizeof numbers, "%d.%d.%d", AMBULO_VERSION_MAJOR, AMBULO_VERSION_MINOR,
                 AMBULO_VERSION_PATCH);
  assert_string_equal(AMBULO_VERSION_STRING, numbers);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(names_and_exit_codes),
                                     cmocka_unit_test(unknown_status_is_still_a_text),
                                     cmocka_unit_test(version_is_the_header_version)};
  return cmocka_run_group_tests_name("base/status", tests, NULL, NULL);
}
