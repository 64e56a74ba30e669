/* The way from one folder to another. */
#include "formats/paths.h"
#include "support/fail_alloc.h"
#include "support/scratch.h"

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

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(ways), TEST(links), TEST(no_folder)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
