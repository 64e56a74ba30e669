/* Names of files seen from folders and from other files. */
#include "formats/paths.h"
#include "support/fail_alloc.h"
#include "support/scratch.h"
#include "support/test.h"

static void equal_and_free(char *path, const char *expected) {
  const ambulo_allocator plain = ambulo__allocator_or_default(NULL);
  assert_non_null(path);
  assert_string_equal(path, expected);
  ambulo__free(&plain, path);
}

static void names(void **state) {
  (void)state;
  const ambulo_allocator a = ambulo__allocator_or_default(NULL);
  equal_and_free(ambulo__join_paths(&a, "d", "cases", NULL), "d/cases");
  equal_and_free(ambulo__join_paths(&a, "d", "cases", "cd"), "d/cases/cd");
  equal_and_free(ambulo__sibling_path(&a, "a/b/s.yaml", "../p.yaml"), "a/b/../p.yaml");
  equal_and_free(ambulo__sibling_path(&a, "s.yaml", "p.yaml"), "p.yaml");
  equal_and_free(ambulo__sibling_path(&a, "a/s.yaml", "/p.yaml"), "/p.yaml");
}

/* The way from one folder to another. */

static void check(void **state, const char *from, const char *to, const char *way) {
  fail_alloc memory = fail_alloc_at(-1);
  ambulo_allocator allocator = fail_alloc_hook(&memory);
  char *path = ambulo__path_between(&allocator, scratch_path(state, from), scratch_path(state, to));
  assert_non_null(path);
  assert_string_equal(path, way);
  free(path);
}

static void ways(void **state) {
  static const char *const folders[] = {"a", "a/b", "a/b/c", "ab"};
  for (int i = 0; i < 4; i++) assert_int_equal(mkdir(scratch_path(state, folders[i]), 0777), 0);
  check(state, "a", "a", "");
  check(state, "a/b", "a", "../");
  check(state, "a/b/c", "a", "../../");
  check(state, "a", "a/b/c", "b/c/");
  check(state, "a/b", "ab", "../../ab/"); /* names that begin alike are no parts in common */
  check(state, "ab", "a", "../a/");
  check(state, "a/b/c/", "a/./b/../../ab", "../../../ab/");
}

/* a link is followed to where it leads */
static void links(void **state) {
  assert_int_equal(mkdir(scratch_path(state, "far"), 0777), 0);
  assert_int_equal(mkdir(scratch_path(state, "far/deep"), 0777), 0);
  assert_int_equal(symlink("far/deep", scratch_path(state, "near")), 0);
  check(state, "near", ".", "../../");
}

static void no_folder(void **state) {
  fail_alloc memory = fail_alloc_at(-1);
  ambulo_allocator allocator = fail_alloc_hook(&memory);
  assert_null(ambulo__path_between(&allocator, *state, scratch_path(state, "none")));
  memory.fail_at = 0;
  assert_null(ambulo__path_between(&allocator, *state, *state));
}

/* Files that come with the program: found by their names where nothing else is called so. */

static const ambulo__place nowhere = {"f.yaml", 1, 2, NULL};

/* where `name` of scratch/file is found; "" when beside it */
static const char *found(void **state, const char *name) {
  static char kept[SCRATCH_PATH + 256];
  const ambulo_allocator a = ambulo__allocator_or_default(NULL);
  char *shipped = NULL;
  assert_int_equal(ambulo__shipped_path(&a, scratch_path(state, name), name, &shipped), AMBULO_OK);
  snprintf(kept, sizeof kept, "%s", shipped ? shipped : "");
  ambulo__free(&a, shipped);
  return kept;
}

static void make_models(void **state) {
  assert_int_equal(mkdir(scratch_path(state, "models"), 0700), 0);
  assert_int_equal(mkdir(scratch_path(state, "models/norms"), 0700), 0);
  scratch_write(scratch_path(state, "models/body.yaml"), "shipped");
  scratch_write(scratch_path(state, "models/norms/people.csv"), "shipped");
  scratch_write(scratch_path(state, "secret.yaml"), "not shipped");
  assert_int_equal(setenv("AMBULO_MODELS", scratch_path(state, "models"), 1), 0);
}

static void a_name_is_found(void **state) {
  make_models(state);
  assert_string_equal(found(state, "body.yaml"), scratch_path(state, "models/body.yaml"));
  assert_string_equal(found(state, "norms/people.csv"),
                      scratch_path(state, "models/norms/people.csv"));
  assert_string_equal(found(state, "none.yaml"), "");
  assert_string_equal(found(state, ""), "");
}

static void what_is_beside_comes_first(void **state) {
  make_models(state);
  scratch_write(scratch_path(state, "body.yaml"), "own");
  assert_string_equal(found(state, "body.yaml"), "");
}

static void a_name_stays_below_the_folder(void **state) {
  make_models(state);
  const ambulo_allocator a = ambulo__allocator_or_default(NULL);
  const char *outside[] = {"../secret.yaml", "norms/../../secret.yaml", "norms/.."};
  for (size_t i = 0; i < sizeof outside / sizeof *outside; i++) {
    char *shipped = NULL;
    assert_int_equal(ambulo__shipped_path(&a, "/none/x", outside[i], &shipped), AMBULO_OK);
    assert_null(shipped);
  }
}

/* nothing is taken for what is there, and cannot be read now */
static void a_link_to_nowhere_is_something(void **state) {
  make_models(state);
  assert_int_equal(symlink("nowhere", scratch_path(state, "body.yaml")), 0);
  assert_string_equal(found(state, "body.yaml"), "");
  assert_int_equal(unlink(scratch_path(state, "body.yaml")), 0);
  assert_string_equal(found(state, "body.yaml"), scratch_path(state, "models/body.yaml"));
}

static void without_the_variable_nothing_is_shipped(void **state) {
  make_models(state);
  assert_int_equal(setenv("AMBULO_MODELS", "", 1), 0);
  assert_string_equal(found(state, "body.yaml"), "");
  assert_int_equal(unsetenv("AMBULO_MODELS"), 0);
  assert_string_equal(found(state, "body.yaml"), "");
}

static void what_was_taken_is_said_once(void **state) {
  make_models(state);
  const ambulo_allocator a = ambulo__allocator_or_default(NULL);
  ambulo_diagnostics *messages = ambulo_diagnostics_create(NULL);
  for (int i = 0; i < 2; i++) {
    char *path = NULL;
    assert_int_equal(ambulo__named_file(&a, scratch_path(state, "f.yaml"), "body.yaml", nowhere,
                                        messages, &path),
                     AMBULO_OK);
    assert_string_equal(path, scratch_path(state, "models/body.yaml"));
    ambulo__free(&a, path);
  }
  assert_int_equal(ambulo_diagnostics_count(messages), 1);
  const ambulo_diagnostic *said = ambulo_diagnostics_get(messages, 0);
  assert_int_equal(said->severity, AMBULO_NOTE);
  assert_int_equal(said->column, 2);
  assert_non_null(strstr(said->message, scratch_path(state, "models/body.yaml")));
  ambulo_diagnostics_free(messages);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(names),
      cmocka_unit_test_setup_teardown(ways, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(links, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(no_folder, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(a_name_is_found, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(what_is_beside_comes_first, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(a_name_stays_below_the_folder, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(a_link_to_nowhere_is_something, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(without_the_variable_nothing_is_shipped, scratch_open,
                                      scratch_close),
      cmocka_unit_test_setup_teardown(what_was_taken_is_said_once, scratch_open, scratch_close)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
