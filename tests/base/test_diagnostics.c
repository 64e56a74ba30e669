#include "ambulo/ambulo.h"
#include "base/diagnostics.h"
#include "support/fail_alloc.h"
#include "support/test.h"

static const ambulo__place NOWHERE = {NULL, 0, 0, NULL};

static void expect_text(const ambulo_diagnostics *list, size_t index, const char *want) {
  char text[512];
  size_t length = ambulo_diagnostics_format(list, index, text, sizeof text);
  assert_string_equal(text, want);
  assert_int_equal(length, strlen(want));
}

static void forms_of_a_message(void **state) {
  (void)state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__place here = {"walk.yaml", 12, 7, "links[3].mass"};
  ambulo__place line_only = {"walk.yaml", 12, 0, NULL};
  ambulo__place file_only = {"walk.yaml", 0, 0, NULL};
  assert_int_equal(ambulo__error(list, AMBULO_E_SCHEMA, here, "write 1.5", "got '%s'", "1,5"),
                   AMBULO_E_SCHEMA);
  ambulo__error(list, AMBULO_E_IO, file_only, NULL, "cannot open");
  ambulo__error(list, AMBULO_E_MEMORY, NOWHERE, NULL, "out of memory");
  ambulo__warning(list, line_only, "radians?", "angle %d is large", 90);
  ambulo__note(list, NOWHERE, "reordered");
  expect_text(list, 0, "walk.yaml:12:7: error[E_SCHEMA]: got '1,5'\n  hint: write 1.5");
  expect_text(list, 1, "walk.yaml: error[E_IO]: cannot open");
  expect_text(list, 2, "ambulo: error[E_MEMORY]: out of memory");
  expect_text(list, 3, "walk.yaml:12:1: warning: angle 90 is large\n  hint: radians?");
  expect_text(list, 4, "ambulo: note: reordered");
  expect_text(list, 5, "");
  assert_string_equal(ambulo_diagnostics_get(list, 0)->path, "links[3].mass");
  assert_int_equal(ambulo_diagnostics_get(list, 3)->status, AMBULO_OK);
  assert_null(ambulo_diagnostics_get(list, 5));
  assert_int_equal(ambulo_diagnostics_error_count(list), 3);
  ambulo_diagnostics_free(list);
}

/* a terminal must not obey an input file */
static void control_characters_are_escaped(void **state) {
  (void)state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__error(list, AMBULO_E_SCHEMA, NOWHERE, "\a", "got '\x1b[31m\n\x7f'; \xc3\xa9");
  expect_text(list, 0,
              "ambulo: error[E_SCHEMA]: got '\\x1b[31m\\x0a\\x7f'; \xc3\xa9\n  hint: \\x07");
  ambulo_diagnostics_free(list);
}

static void short_buffers_are_terminated(void **state) {
  (void)state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__error(list, AMBULO_E_IO, NOWHERE, NULL, "cannot open");
  size_t need = strlen("ambulo: error[E_IO]: cannot open");
  for (size_t size = 0; size <= need + 2; size++) {
    char text[64];
    memset(text, '#', sizeof text);
    assert_int_equal(ambulo_diagnostics_format(list, 0, text, size), need);
    if (size > 0) assert_int_equal(strlen(text), size - 1 < need ? size - 1 : need);
    assert_int_equal(text[size], '#');
  }
  ambulo_diagnostics_free(list);
}

static void twenty_errors_are_kept_and_all_counted(void **state) {
  (void)state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  for (int i = 0; i < 100; i++) ambulo__warning(list, NOWHERE, NULL, "warning %d", i);
  size_t warnings = ambulo_diagnostics_count(list);
  for (int i = 0; i < 30; i++) ambulo__error(list, AMBULO_E_MODEL, NOWHERE, NULL, "error %d", i);
  assert_int_equal(ambulo_diagnostics_error_count(list), 30);
  assert_int_equal(ambulo_diagnostics_count(list), warnings + 20);
  expect_text(list, warnings + 19, "ambulo: error[E_MODEL]: error 19");
  ambulo__diagnostics_clear(list);
  assert_int_equal(ambulo_diagnostics_count(list), 0);
  assert_int_equal(ambulo_diagnostics_error_count(list), 0);
  ambulo_diagnostics_free(list);
}

static void no_list_and_no_memory_keep_the_status(void **state) {
  (void)state;
  assert_int_equal(ambulo__error(NULL, AMBULO_E_IO, NOWHERE, NULL, "x"), AMBULO_E_IO);
  assert_int_equal(ambulo_diagnostics_count(NULL), 0);
  ambulo__diagnostics_clear(NULL);
  ambulo_diagnostics_free(NULL);
  ambulo__place here = {"file", 1, 1, "path"};
  for (long k = 0;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_diagnostics *list = ambulo_diagnostics_create(&hook);
    assert_int_equal(ambulo__error(list, AMBULO_E_IO, here, "hint", "text"), AMBULO_E_IO);
    ambulo_diagnostics_free(list);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
    assert_true(k < 20);
  }
}

/* the list itself has memory, its messages have not: from each k-th request on, or only there */
static void without_memory_an_error_is_still_told(void **state) {
  (void)state;
  ambulo__place here = {"walk.yaml", 3, 4, "path"};
  for (int only_once = 0; only_once < 2; only_once++) {
    for (long k = 1; k < 14; k++) {
      fail_alloc memory = fail_alloc_at(k);
      memory.only_once = only_once;
      ambulo_allocator hook = fail_alloc_hook(&memory);
      ambulo_diagnostics *list = ambulo_diagnostics_create(&hook);
      ambulo__error(list, AMBULO_E_SCHEMA, here, "hint", "got %d", 7);
      ambulo__error(list, AMBULO_E_MEMORY, here, "hint", "out of memory");
      ambulo__error(list, AMBULO_E_MEMORY, here, NULL, "again");
      char text[512];
      assert_true(ambulo_diagnostics_count(list) >= 2);
      ambulo_diagnostics_format(list, 0, text, sizeof text);
      assert_non_null(strstr(text, "walk.yaml:3:4: error[E_SCHEMA]: got 7"));
      ambulo_diagnostics_format(list, 1, text, sizeof text);
      assert_non_null(strstr(text, "walk.yaml:3:4: error[E_MEMORY]: out of memory"));
      assert_int_equal(ambulo_diagnostics_error_count(list), 3);
      ambulo__diagnostics_clear(list);
      memory.fail_at = 0; /* what was kept without memory is given back for the next one */
      memory.only_once = 0;
      ambulo__error(list, AMBULO_E_MEMORY, here, NULL, "afterwards");
      expect_text(list, 0, "walk.yaml:3:4: error[E_MEMORY]: afterwards");
      ambulo_diagnostics_free(list);
      assert_int_equal(memory.live, 0);
    }
  }
}

/* of warnings and notes the first one, whatever it was short of */
static void without_memory_a_warning_is_still_told(void **state) {
  (void)state;
  ambulo__place here = {"walk.yaml", 3, 4, "path"};
  for (long k = 1; k < 6; k++) {
    fail_alloc memory = fail_alloc_at(k);
    memory.only_once = 1;
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_diagnostics *list = ambulo_diagnostics_create(&hook);
    ambulo__warning(list, here, "hint", "doubtful %d", 7);
    ambulo__error(list, AMBULO_E_SCHEMA, here, "hint", "wrong");
    char text[512];
    ambulo_diagnostics_format(list, 0, text, sizeof text);
    assert_non_null(strstr(text, "walk.yaml:3:4: warning: doubtful 7"));
    ambulo_diagnostics_format(list, 1, text, sizeof text);
    assert_non_null(strstr(text, "walk.yaml:3:4: error[E_SCHEMA]: wrong"));
    ambulo_diagnostics_free(list);
    assert_int_equal(memory.live, 0);
  }
}

static void no_failure_is_concluded_without_an_error(void **state) {
  (void)state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo__conclude(list, 0, AMBULO_OK, "f"), AMBULO_OK);
  assert_int_equal(ambulo_diagnostics_count(list), 0);
  assert_int_equal(ambulo__conclude(list, 0, AMBULO_E_MEMORY, "f"), AMBULO_E_MEMORY);
  expect_text(list, 0, "f: error[E_MEMORY]: memory could not be allocated");
  assert_int_equal(ambulo__conclude(list, 0, AMBULO_E_IO, "f"), AMBULO_E_IO);
  assert_int_equal(ambulo_diagnostics_count(list), 1);
  assert_int_equal(ambulo__conclude(list, 1, AMBULO_E_IO, NULL), AMBULO_E_IO);
  expect_text(list, 1, "ambulo: error[E_IO]: a file could not be read or written");
  assert_int_equal(ambulo__conclude(list, 2, AMBULO_E_ARGUMENT, "f"), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_diagnostics_count(list), 2);
  assert_int_equal(ambulo__conclude(NULL, 0, AMBULO_E_IO, "f"), AMBULO_E_IO);
  ambulo_diagnostics_free(list);
}

static void nearest_names(void **state) {
  (void)state;
  static const char *const words[] = {"mass", "name", "inertia", "center_of_mass", "d", "q"};
  static const struct {
    const char *word, *want;
  } cases[] = {{"mas", "mass"},
               {"Mass", "mass"},
               {"msas", "mass"},
               {"inertai", "inertia"},
               {"interia", "inertia"},
               {"centre_of_mass", "center_of_mass"},
               {"xyz", NULL},
               {"", NULL},
               {"w", NULL},
               {"Q", "q"},
               {"mesh", NULL}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    const char *got = ambulo__nearest(cases[i].word, words, 6);
    if (!got || !cases[i].want) {
      if (got != cases[i].want) print_error("nearest to '%s'\n", cases[i].word);
      assert_ptr_equal(got, cases[i].want);
    } else {
      assert_string_equal(got, cases[i].want);
    }
  }
  char longest[3000];
  memset(longest, 'a', sizeof longest - 1);
  longest[sizeof longest - 1] = '\0';
  assert_null(ambulo__nearest(longest, words, 6));
  assert_null(ambulo__nearest("mass", words, 0));
}

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
  const struct CMUnitTest tests[] = {cmocka_unit_test(forms_of_a_message),
                                     cmocka_unit_test(control_characters_are_escaped),
                                     cmocka_unit_test(short_buffers_are_terminated),
                                     cmocka_unit_test(twenty_errors_are_kept_and_all_counted),
                                     cmocka_unit_test(no_list_and_no_memory_keep_the_status),
                                     cmocka_unit_test(without_memory_an_error_is_still_told),
                                     cmocka_unit_test(without_memory_a_warning_is_still_told),
                                     cmocka_unit_test(no_failure_is_concluded_without_an_error),
                                     cmocka_unit_test(nearest_names),
                                     cmocka_unit_test(names_and_exit_codes),
                                     cmocka_unit_test(unknown_status_is_still_a_text),
                                     cmocka_unit_test(version_is_the_header_version)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
