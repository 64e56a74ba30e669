/* What killed runs leave behind goes, and nothing else. */
#include "study/batch.h"
#include "support/scratch.h"

static const char id[] = "000000001-0000abcd";

static void make(void **state) {
  static const char *const folders[] = {"cases",
                                        "cases/cd",
                                        "cases/cd/000000001-0000abcd",
                                        "cases/cd/000000001-0000abcd.tmp-77-0",
                                        "cases/cd/000000001-0000abcd.old-77-0",
                                        "cases/cd/000000001-0000abcd.tmp-78-0"};
  for (size_t i = 0; i < sizeof folders / sizeof *folders; i++)
    assert_int_equal(mkdir(scratch_path(state, folders[i]), 0777), 0);
  scratch_write(scratch_path(state, "cases/cd/000000001-0000abcd/summary.json"), "{}");
  scratch_write(scratch_path(state, "cases/cd/000000001-0000abcd.tmp-77-0/motion.csv"), "x");
  scratch_write(scratch_path(state, "cases/cd/000000001-0000abcd.json"), "{}");
  scratch_write(scratch_path(state, "cases/cd/000000001-0000abcd.json.tmp-79-0"), "{");
  scratch_write(scratch_path(state, "results.csv.tmp-79-0"), "id");
  scratch_write(scratch_path(state, "results.csv"), "id\n");
}

static void leftovers_of_a_case(void **state) {
  make(state);
  ambulo__clean_folder(scratch_path(state, "cases/cd"), "000000002-");
  assert_int_equal(entries_in(scratch_path(state, "cases/cd")), 6);
  ambulo__clean_folder(scratch_path(state, "cases/cd"), id);
  assert_int_equal(entries_in(scratch_path(state, "cases/cd")), 2);
  assert_int_equal(entries_in(scratch_path(state, "cases/cd/000000001-0000abcd")), 1);
}

static void leftovers_of_all(void **state) {
  make(state);
  ambulo__clean_folder(*state, "");
  assert_int_equal(entries_in(*state), 2);
  assert_int_equal(entries_in(scratch_path(state, "cases/cd")), 6);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(leftovers_of_a_case), TEST(leftovers_of_all)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
