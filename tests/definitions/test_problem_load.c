/* The files of a problem: named, and the same for all loads of it. */
#include "definitions/problem_load.h"

#include "ambulo/extend.h"
#include "definitions/problem_text.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/scratch.h"

#include <errno.h>

#define REST "time: {duration: 1, intervals: 4}\nobjective: none\n"

/* a problem, its model and a reference */
static const char *write_files(void **state) {
  scratch_write(scratch_path(state, "m.yaml"),
                "ambulo: 1\nkind: model\nname: one\nunits: {angle: radians}\nlinks:\n"
                "  - {name: rod, parent: none, joint: revolute, dh: [0, 0, 1, 0],\n"
                "     coordinate: {name: pin, range: [-3, 3]},\n"
                "     body: {mass: 1, com: [-0.5, 0, 0], inertia: [0, 0.1, 0.1, 0, 0, 0]}}\n");
  scratch_write(scratch_path(state, "r.csv"), "time,pin\n0,0\n1,1\n");
  scratch_write(scratch_path(state, "p.yaml"),
                "ambulo: 1\nkind: problem\nname: p\nmodel: m.yaml\nangles: radians\n"
                "time: {duration: 1, intervals: 4}\n"
                "objective: [{term: tracking, weight: 1, reference: r.csv}]\n");
  return scratch_path(state, "p.yaml");
}

static const char *const input_names[] = {"p.yaml", "m.yaml", "r.csv"};

static void a_problem_names_its_files(void **state) {
  const char *path = write_files(state), *line;
  ambulo_problem *p = NULL, *extended = NULL;
  assert_int_equal(ambulo_problem_load(path, NULL, 0, NULL, NULL, &p), AMBULO_OK);
  line = ambulo_problem_inputs(p);
  for (int i = 0; i < 3; i++) {
    char digest[AMBULO__SHA256_TEXT], expected[AMBULO__SHA256_TEXT];
    const char *name;
    size_t length;
    assert_int_equal(ambulo__inputs_next(&line, digest, &name, &length), 1);
    assert_int_equal(strncmp(name, scratch_path(state, input_names[i]), length), 0);
    assert_int_equal(ambulo__digest_file(scratch_path(state, input_names[i]), NULL, expected),
                     AMBULO_OK);
    assert_string_equal(digest, expected);
  }
  assert_string_equal(line, "");
  ambulo_extension extension = ambulo_extension_default();
  assert_int_equal(ambulo_problem_extend(p, &extension, NULL, NULL, &extended), AMBULO_OK);
  assert_string_equal(ambulo_problem_inputs(extended), ambulo_problem_inputs(p));
  ambulo_problem_free(extended);
  ambulo_problem_free(p);
  p = problem_of(PENDULUM REST);
  assert_null(strstr(ambulo_problem_inputs(p), "p.yaml"));
  ambulo_problem_free(p);
}

/* each of the files, after one load and before the next */
static void a_file_that_changes_between_loads(void **state) {
  for (int i = 0; i < 3; i++) {
    const char *path = write_files(state);
    ambulo__text_buffer known;
    ambulo_problem *p = NULL, *q = NULL;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    ambulo__text_init(&known, NULL);
    assert_int_equal(ambulo__problem_load_known(path, NULL, 0, &known, NULL, list, &p), AMBULO_OK);
    FILE *file = fopen(scratch_path(state, input_names[i]), "ab");
    assert_non_null(file);
    fputs("# more\n", file);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(ambulo__problem_load_known(path, NULL, 0, &known, NULL, list, &q),
                     AMBULO_E_IO);
    assert_null(q);
    assert_message(list, 0, "the file changed since the run began");
    assert_message(list, 0, input_names[i]);
    /* what a worker is told is the same, and neither a file more nor one that is away */
    assert_int_equal(setenv("AMBULO_INPUTS", ambulo_problem_inputs(p), 1), 0);
    assert_int_equal(ambulo_problem_load(path, NULL, 0, NULL, NULL, &q), AMBULO_E_IO);
    (void)write_files(state);
    assert_int_equal(ambulo_problem_load(path, NULL, 0, NULL, NULL, &q), AMBULO_OK);
    ambulo_problem_free(q);
    assert_int_equal(unlink(scratch_path(state, input_names[i])), 0);
    assert_int_equal(mkdir(scratch_path(state, "models"), 0700) && errno != EEXIST, 0);
    assert_int_equal(setenv("AMBULO_MODELS", scratch_path(state, "models"), 1), 0);
    char shipped[64];
    (void)snprintf(shipped, sizeof shipped, "models/%s", input_names[i]);
    scratch_write(scratch_path(state, shipped), "ambulo: 1\n");
    ambulo_diagnostics *last = ambulo_diagnostics_create(NULL);
    assert_int_equal(ambulo_problem_load(path, NULL, 0, NULL, last, &q), AMBULO_E_IO);
    assert_message(last, 0, "cannot open");
    ambulo_diagnostics_free(last);
    assert_int_equal(unsetenv("AMBULO_INPUTS") || unsetenv("AMBULO_MODELS"), 0);
    ambulo_problem_free(p);
    ambulo__text_free(&known);
    ambulo_diagnostics_free(list);
  }
}

static void memory_may_give_out(void **state) {
  const char *path = write_files(state);
  for (long k = 0; k < 10000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo__text_buffer known;
    ambulo_problem *p = NULL;
    ambulo__text_init(&known, &hook);
    ambulo_status status = ambulo__problem_load_known(path, NULL, 0, &known, &hook, NULL, &p);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo_problem_free(p);
    ambulo__text_free(&known);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) return;
  }
  fail();
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(a_problem_names_its_files),
                                     TEST(a_file_that_changes_between_loads),
                                     TEST(memory_may_give_out)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
