/* Files that cases are solved from: known, in keys, told to workers. */
#include "formats/inputs.h"
#include "study/study.h"
#include "support/fail_alloc.h"
#include "support/sweep_files.h"

static const char text[] =
    "axes:\n"
    "  - {name: m, key: model, values: [one.yaml, two.yaml]}\n"
    "  - {name: n, key: name, values: [a, b]}\n"
    "  - {name: o, key: \"objective[0]\", values: [\"{term: tracking, weight: 1, reference: "
    "r.csv}\", \"{term: torque_squared, weight: 2}\"]}\n";
enum { CASES = 8 };

static ambulo_sweep *load(void **state) {
  ambulo_sweep *s = NULL;
  assert_int_equal(sweep_load(state, text, NULL, &s), AMBULO_OK);
  assert_int_equal(ambulo_sweep_case_count(s), CASES);
  return s;
}

static int write_files(void **state) {
  if (scratch_open(state)) return -1;
  scratch_write(scratch_path(state, "two.yaml"), sweep_model);
  scratch_write(scratch_path(state, "r.csv"), "time,pin\n0,0\n1,1\n");
  return 0;
}

/* the lines of a case */
static char *inputs_of(const ambulo_sweep *s, int index) {
  ambulo__text_buffer lines;
  ambulo__text_init(&lines, NULL);
  assert_int_equal(ambulo__sweep_case_inputs(s, index, &lines), AMBULO_OK);
  char *copy = strdup(ambulo__text_data(&lines));
  ambulo__text_free(&lines);
  return copy;
}

static int count_lines(const char *lines) {
  int count = 0;
  for (; *lines; lines++) count += *lines == '\n';
  return count;
}

/* the base problem, what it names, and what values name: each once, and nothing else */
static void a_case_knows_its_files(void **state) {
  ambulo_sweep *s = load(state);
  for (int k = 0; k < CASES; k++) {
    char *lines = inputs_of(s, k);
    int two = k >= CASES / 2, reference = k % 2 == 0;
    assert_non_null(ambulo__inputs_find(lines, scratch_path(state, "p.yaml")));
    assert_non_null(ambulo__inputs_find(lines, scratch_path(state, "one.yaml")));
    assert_int_equal(ambulo__inputs_find(lines, scratch_path(state, "two.yaml")) != NULL, two);
    assert_int_equal(ambulo__inputs_find(lines, scratch_path(state, "r.csv")) != NULL, reference);
    assert_int_equal(count_lines(lines), 2 + two + reference);
    free(lines);
  }
  ambulo_sweep_free(s);
}

/* also of one that stands within a value */
static void a_key_is_that_of_the_bytes(void **state) {
  ambulo_sweep *s = load(state);
  scratch_write(scratch_path(state, "r.csv"), "time,pin\n0,0\n1,2\n");
  ambulo_sweep *t = load(state);
  for (int k = 0; k < CASES; k++) {
    assert_string_equal(s->cases[k].id, t->cases[k].id);
    assert_int_equal(s->cases[k].key != t->cases[k].key, k % 2 == 0);
  }
  ambulo_sweep_free(s);
  ambulo_sweep_free(t);
}

/* what is known stays what it is, however long a study grows */
static void a_file_is_what_it_was_first(void **state) {
  ambulo_sweep *s = NULL;
  int a = 0, b = 0;
  const char *first[] = {"name=x", "model=two.yaml"}, *second[] = {"name=y", "model=two.yaml"};
  assert_int_equal(sweep_load(state, "cases:\n  - {name: c, set: {name: z}}\n", NULL, &s),
                   AMBULO_OK);
  assert_int_equal(ambulo__sweep_append(s, "a", first, 2, -1, NULL, &a), AMBULO_OK);
  char *before = inputs_of(s, a);
  scratch_write(scratch_path(state, "two.yaml"), "other");
  assert_int_equal(ambulo__sweep_append(s, "b", second, 2, -1, NULL, &b), AMBULO_OK);
  char *after = inputs_of(s, b);
  assert_string_equal(after, before);
  assert_int_equal(count_lines(after), 3);
  free(before);
  free(after);
  ambulo_sweep_free(s);
}

static void memory_may_give_out(void **state) {
  ambulo_sweep_free(load(state));
  for (long k = 0; k < 20000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_sweep *s = NULL;
    ambulo__text_buffer lines;
    ambulo__text_init(&lines, &hook);
    ambulo_status status = ambulo_sweep_load(scratch_path(state, "s.yaml"), &hook, NULL, &s);
    if (!status) status = ambulo__sweep_case_inputs(s, CASES - 2, &lines);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__text_free(&lines);
    ambulo_sweep_free(s);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) return;
  }
  fail();
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, write_files, scratch_close)
  const struct CMUnitTest tests[] = {TEST(a_case_knows_its_files), TEST(a_key_is_that_of_the_bytes),
                                     TEST(a_file_is_what_it_was_first), TEST(memory_may_give_out)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
