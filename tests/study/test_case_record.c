/* Records: written and read back, refused when damaged, of what a result folder holds; what lifts a
 * limit. */
#include "study/batch.h"
#include "support/fail_alloc.h"
#include "support/scratch.h"
#include "support/sealed_lines.h"
#include "support/yaml_mutation.h"

static const char id[] = "000000001-0000abcd";
static const char record_path[] = "cases/cd/000000001-0000abcd.json";
enum { KEY = 0x1234 };
static ambulo_allocator plain;

static ambulo__record sample(void) {
  ambulo__record r = {.key = KEY,
                      .state = "timeout",
                      .exit_code = -1,
                      .signal = 9,
                      .start = "000000000-00000000",
                      .origin = 0x123456789abcdef0ULL,
                      .seconds = 1.25,
                      .limit_seconds = 1.0,
                      .violation = 0.1};
  return r;
}

static int open_folder(void **state) {
  plain = ambulo__allocator_or_default(NULL);
  if (scratch_open(state)) return -1;
  return mkdir(scratch_path(state, "cases"), 0777) || mkdir(scratch_path(state, "cases/cd"), 0777);
}

/* a result folder as a solve leaves it, and a log */
static void make_result(void **state) {
  assert_int_equal(mkdir(scratch_path(state, "cases/cd/000000001-0000abcd"), 0777), 0);
  scratch_write(scratch_path(state, "cases/cd/000000001-0000abcd/summary.json"),
                "{\"verdict\": \"optimal\", \"audit\": {\"violation\": {\"worst\": 1e-9}}}\n");
  scratch_write(scratch_path(state, "cases/cd/000000001-0000abcd/motion.csv"), "time,q.pin\n0,1\n");
  scratch_write(scratch_path(state, "cases/cd/000000001-0000abcd/solution.yaml"), "ambulo: 1\n");
  scratch_write(scratch_path(state, "cases/cd/000000001-0000abcd.log"), "warning: x\n");
}

/* of the result, written */
static ambulo__record finish(void **state) {
  ambulo__record r = sample();
  int taken = 0;
  make_result(state);
  assert_int_equal(ambulo__record_take_result(*state, id, &plain, NULL, &r, &taken), AMBULO_OK);
  assert_int_equal(taken, 1);
  assert_int_equal(ambulo__record_write(*state, id, &r, "", &plain, NULL), AMBULO_OK);
  return r;
}

static ambulo__finding find(void **state, int files, ambulo__record *record,
                            ambulo__damage *damage) {
  ambulo__finding finding = AMBULO__FOUND_NOTHING;
  assert_int_equal(ambulo__record_find(*state, id, KEY, files, &plain, &finding, record, damage),
                   AMBULO_OK);
  return finding;
}

static void a_round_trip(void **state) {
  ambulo__record r = sample(), back;
  ambulo__damage damage;
  assert_int_equal(find(state, 1, &back, &damage), AMBULO__FOUND_NOTHING);
  assert_int_equal(ambulo__record_write(*state, id, &r, "", &plain, NULL), AMBULO_OK);
  assert_int_equal(find(state, 1, &back, &damage), AMBULO__FOUND_INTACT);
  assert_true(back.key == r.key && back.origin == r.origin && back.signal == 9);
  assert_string_equal(back.state, "timeout");
  assert_string_equal(back.start, r.start);
  assert_true(back.seconds == 1.25 && back.violation == 0.1 && back.exit_code == -1);
  assert_int_equal(back.files.count, 0);
}

static void a_result_is_taken_with_all_its_files(void **state) {
  static const char *const endings[] = {".log", "/motion.csv", "/solution.yaml", "/summary.json"};
  ambulo__record back;
  ambulo__damage damage;
  ambulo__record r = finish(state);
  assert_string_equal(r.state, "optimal");
  assert_true(r.valid && r.violation == 1e-9);
  assert_int_equal(find(state, 1, &back, &damage), AMBULO__FOUND_INTACT);
  assert_int_equal(back.files.count, 4);
  for (int i = 0; i < 4; i++) {
    assert_string_equal(back.files.file[i].ending, endings[i]);
    assert_string_equal(back.files.file[i].digest, r.files.file[i].digest);
  }
  /* printf 'ambulo: 1\n' | sha256sum */
  assert_string_equal(back.files.file[2].digest,
                      "34070ea9f0501f787abe5861c15f83b7a7763f19267212ab5848924de308757a");
}

static void other_inputs_and_earlier_versions_are_stale(void **state) {
  ambulo__record back;
  ambulo__damage damage;
  ambulo__finding finding;
  (void)finish(state);
  assert_int_equal(ambulo__record_find(*state, id, KEY + 1, 1, &plain, &finding, &back, &damage),
                   AMBULO_OK);
  assert_int_equal(finding, AMBULO__FOUND_STALE);
  static const char *const earlier[] = {
      "{\"schema\": \"ambulo-case/1\", \"id\": \"000000001-0000abcd\"}\n",
      "{\"schema\": \"ambulo-case/2\", \"id\": \"000000001-0000abcd\"}\n"};
  for (int i = 0; i < 2; i++) {
    scratch_write(scratch_path(state, record_path), earlier[i]);
    assert_int_equal(find(state, 1, &back, &damage), AMBULO__FOUND_STALE);
  }
}

/* every byte of the record changed, every length cut */
static void damage_of_the_record_is_seen(void **state) {
  ambulo__record back;
  ambulo__damage damage = {"", ""};
  (void)finish(state);
  const char *path = scratch_path(state, record_path);
  char *text = read_whole(path);
  size_t length = strlen(text);
  for (size_t i = 0; i < length; i++) {
    char kept = text[i];
    text[i] = kept == 'x' ? 'y' : 'x';
    scratch_write(path, text);
    assert_int_equal(find(state, 0, &back, &damage), AMBULO__FOUND_DAMAGED);
    assert_string_equal(damage.ending, ".json");
    text[i] = kept;
  }
  scratch_write(path, text);
  assert_int_equal(find(state, 0, &back, &damage), AMBULO__FOUND_INTACT);
  for (size_t i = length; i-- > 0;) {
    assert_int_equal(truncate(path, (off_t)i), 0);
    assert_int_equal(find(state, 0, &back, &damage), AMBULO__FOUND_DAMAGED);
  }
  free(text);
}

static void damage_of_any_file_is_seen(void **state) {
  static const char *const files[] = {
      "cases/cd/000000001-0000abcd.log", "cases/cd/000000001-0000abcd/motion.csv",
      "cases/cd/000000001-0000abcd/solution.yaml", "cases/cd/000000001-0000abcd/summary.json"};
  ambulo__record back;
  ambulo__damage damage;
  (void)finish(state);
  for (int i = 0; i < 4; i++) {
    const char *path = scratch_path(state, files[i]);
    char *text = read_whole(path);
    size_t length = strlen(text);
    assert_int_equal(truncate(path, (off_t)length - 1), 0);
    assert_int_equal(find(state, 1, &back, &damage), AMBULO__FOUND_DAMAGED);
    assert_string_equal(damage.what, "is not what was written");
    assert_non_null(strstr(path, damage.ending));
    assert_int_equal(find(state, 0, &back, &damage), AMBULO__FOUND_INTACT); /* not looked at */
    assert_int_equal(unlink(path), 0);
    assert_int_equal(find(state, 1, &back, &damage), AMBULO__FOUND_DAMAGED);
    assert_string_equal(damage.what, "cannot open: No such file or directory");
    assert_int_equal(mkdir(path, 0777), 0);
    assert_int_equal(find(state, 1, &back, &damage), AMBULO__FOUND_DAMAGED);
    assert_string_equal(damage.what, "not a regular file (it is a folder)");
    assert_int_equal(rmdir(path), 0);
    scratch_write(path, text);
    free(text);
  }
  assert_int_equal(find(state, 1, &back, &damage), AMBULO__FOUND_INTACT);
}

/* whole and sealed, but by somebody who does not keep to what a record says */
static void contradictions_are_seen(void **state) {
  ambulo__record back;
  ambulo__damage damage;
  ambulo__record right = finish(state);
  for (int i = 0; i < 5; i++) {
    ambulo__record r = right;
    if (i == 0) r.valid = 0;
    if (i == 1) (void)snprintf(r.state, sizeof r.state, "infeasible");
    if (i == 2) (void)snprintf(r.state, sizeof r.state, "great");
    if (i == 3) r.files.count = 1; /* valid, and no result */
    if (i == 4) r.signal = 1000;
    assert_int_equal(ambulo__record_write(*state, id, &r, "", &plain, NULL), AMBULO_OK);
    assert_int_equal(find(state, 1, &back, &damage), AMBULO__FOUND_DAMAGED);
  }
  /* the record of another case in this one's place */
  assert_int_equal(ambulo__record_write(*state, "000000002-0000abcd", &right, "", &plain, NULL), 0);
  assert_int_equal(rename(scratch_path(state, "cases/cd/000000002-0000abcd.json"),
                          scratch_path(state, record_path)),
                   0);
  assert_int_equal(find(state, 1, &back, &damage), AMBULO__FOUND_DAMAGED);
}

/* sealed, with a value of another type in each line in turn */
static void fields_of_another_type_are_damage(void **state) {
  int tried = 0, numbers = 0;
  ambulo__record back;
  ambulo__damage damage;
  (void)finish(state);
  const char *path = scratch_path(state, record_path);
  char *text = read_whole(path);
  for (int line = 0; line < 30; line++) {
    for (int i = 0; i < MUTATION_VALUES; i++) {
      ambulo__text_buffer changed = sealed_with(text, line, mutation_values[i]);
      if (!changed.data) break;
      scratch_write(path, changed.data);
      ambulo__text_free(&changed);
      tried++;
      /* a number may be another one, which nobody can tell who has sealed it */
      ambulo__finding finding = find(state, 1, &back, &damage);
      numbers += finding == AMBULO__FOUND_INTACT;
      int is_number = i < 2, is_word = i == 2 || i == 4; /* legal under "start" */
      int is_start = line == 5;
      assert_true(finding == AMBULO__FOUND_DAMAGED || is_number || (is_word && is_start));
    }
  }
  free(text);
  assert_true(tried > 15 * MUTATION_VALUES && numbers <= 2 * 7);
}

/* the k-th request for memory fails: E_MEMORY, never "missing" or "damaged" */
static void without_memory_nothing_is_called_damaged(void **state) {
  (void)finish(state);
  for (int call = 0; call < 3; call++) {
    for (long k = 0;; k++) {
      fail_alloc memory = fail_alloc_at(k);
      ambulo_allocator hook = fail_alloc_hook(&memory);
      ambulo__record r = sample();
      ambulo__finding finding = AMBULO__FOUND_NOTHING;
      ambulo__damage damage;
      int taken = 0;
      ambulo_status status;
      if (call == 0) {
        status = ambulo__record_find(*state, id, KEY, 1, &hook, &finding, &r, &damage);
      } else if (call == 1) {
        status = ambulo__record_take_result(*state, id, &hook, NULL, &r, &taken);
      } else {
        status = ambulo__record_write(*state, "000000003-0000abcd", &r, "", &hook, NULL);
      }
      assert_int_equal(memory.live, 0);
      assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
      if (memory.failed) continue;
      assert_int_equal(call == 0 ? finding == AMBULO__FOUND_INTACT : call == 1 ? taken : 1, 1);
      break;
    }
  }
}

static void wider_limits_reopen_a_case(void **state) {
  (void)state;
  ambulo__record r = sample();
  assert_false(ambulo__record_was_cut(&r, 1.0, 0));
  assert_false(ambulo__record_was_cut(&r, 0.5, 0));
  assert_true(ambulo__record_was_cut(&r, 2.0, 0));
  assert_true(ambulo__record_was_cut(&r, 0.0, 0));
  snprintf(r.state, sizeof r.state, "optimal");
  assert_false(ambulo__record_was_cut(&r, 0.0, 0));
  snprintf(r.state, sizeof r.state, "memory");
  r.limit_megabytes = 300;
  assert_false(ambulo__record_was_cut(&r, 0.0, 300));
  assert_true(ambulo__record_was_cut(&r, 0.0, 301));
  assert_true(ambulo__record_was_cut(&r, 0.0, 0));
  r.limit_megabytes = 0; /* the machine had none left: not the case's own end */
  assert_true(ambulo__record_was_cut(&r, 0.0, 0));
  assert_true(ambulo__record_was_cut(&r, 0.0, 300));
}

static void equal_and_free(char *path, const char *expected) {
  const ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_non_null(path);
  assert_string_equal(path, expected);
  ambulo__free(&a, path);
}

static void cases_spread_over_folders(void **state) {
  (void)state;
  const ambulo_allocator a = ambulo__allocator_or_default(NULL);
  equal_and_free(ambulo__case_path(&a, "d", "000000001-0000abcd", ".json"),
                 "d/cases/cd/000000001-0000abcd.json");
  equal_and_free(ambulo__case_path(&a, ".", "x", "/gait.svg"), "./cases/00/x/gait.svg");
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, open_folder, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(a_round_trip),
      TEST(a_result_is_taken_with_all_its_files),
      TEST(other_inputs_and_earlier_versions_are_stale),
      TEST(damage_of_the_record_is_seen),
      TEST(damage_of_any_file_is_seen),
      TEST(contradictions_are_seen),
      TEST(fields_of_another_type_are_damage),
      TEST(without_memory_nothing_is_called_damaged),
      cmocka_unit_test(wider_limits_reopen_a_case),
      cmocka_unit_test(cases_spread_over_folders),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
