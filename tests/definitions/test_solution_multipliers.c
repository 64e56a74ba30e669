/* multipliers of a solution.yaml: those of the result again, and refusals. */
#include "ambulo/tools/load.h"
#include "method/multipliers.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/walker_solution.h"

/* every third of the inequalities, and of the equalities, which do not count, all */
static void press(walk *w) {
  for (int r = 0; r < w->result->rows; r++) {
    int inequality = w->problem->table.rows[r].relation == AMBULO_NOT_NEGATIVE;
    w->result->multiplier[r] = inequality && r % 3 ? 0.0 : 0.1 + r / 7.0;
  }
}

static const ambulo__multiplier *find(const ambulo_multipliers *m, const ambulo__multiplier *like) {
  for (int i = 0; i < m->count; i++)
    if (m->row[i].series == like->series && m->row[i].time == like->time) return &m->row[i];
  return NULL;
}

/* those that press, with the same bits; the others next to them as zeros or not at all */
static void test_same_multipliers(void **state) {
  walk w;
  walk_open(&w, 12);
  press(&w);
  const char *path = write_solution(state, &w);
  ambulo_multipliers *wanted = NULL, *found = NULL;
  assert_int_equal(ambulo_multipliers_of(w.problem, w.result, NULL, &wanted), AMBULO_OK);
  assert_int_equal(
      ambulo_solution_multipliers(path, w.problem, AMBULO_ENDS_FREE, NULL, NULL, &found),
      AMBULO_OK);
  assert_true(found->objective == wanted->objective && found->interval == wanted->interval);
  assert_int_equal(found->periods, 1);
  int pressing = 0;
  for (int i = 0; i < wanted->count; i++) {
    const ambulo__multiplier *row = &wanted->row[i], *same = find(found, row);
    pressing += row->density > 0.0;
    if (row->density > 0.0) assert_non_null(same);
    if (same) assert_true(same->density == row->density);
  }
  assert_true(pressing > 5 && found->count < wanted->count);
  ambulo_multipliers_free(wanted);
  ambulo_multipliers_free(found);
  walk_close(&w);
}

static void test_periods(void **state) {
  walk w;
  walk_open(&w, 12);
  press(&w);
  const char *path = write_solution(state, &w);
  ambulo_multipliers *m = NULL;
  assert_int_equal(
      ambulo_solution_multipliers(path, w.problem, AMBULO_ENDS_MIRRORED, NULL, NULL, &m),
      AMBULO_OK);
  assert_true(m->mirrored == 1 && m->periods == 1);
  ambulo_multipliers_free(m);
  walk_close(&w);
}

static const char header[] = "ambulo: 1\nkind: solution\nduration: 0.5\n";

static void refuse(void **state, const char *text, ambulo_status expected, const char *message) {
  walk w;
  char whole[600];
  const char *path = scratch_path(state, "solution.yaml");
  (void)snprintf(whole, sizeof whole, "%s%s", header, text);
  scratch_write(path, whole);
  walk_open(&w, 12);
  ambulo_multipliers *m = (ambulo_multipliers *)&w;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_solution_multipliers(path, w.problem, AMBULO_ENDS_FREE, NULL, list, &m),
                   expected);
  assert_true(m == (ambulo_multipliers *)&w);
  assert_message(list, 0, message);
  ambulo_diagnostics_free(list);
  walk_close(&w);
}

#define ROWS "multipliers:\n  objective: 1\n  interval: 0.1\n  rows:\n"

static void test_refusals(void **state) {
  refuse(state, ROWS "    - name: [a, b]\n      times: [0]\n      densities: [1]\n",
         AMBULO_E_SCHEMA, "got 2 texts; expected family, subject and detail");
  refuse(state, ROWS "    - name: [a, b, c]\n      times: [0, 1]\n      densities: [1]\n",
         AMBULO_E_SCHEMA, "expected a sequence of 2 numbers");
  refuse(state, ROWS "    - name: [a, b, c]\n      times: [0, x]\n      densities: [1, 1]\n",
         AMBULO_E_SCHEMA, "'x'");
  refuse(state, ROWS "    - name: [a, b, c]\n      densities: [1]\n", AMBULO_E_SCHEMA, "times");
  refuse(state, "multipliers:\n  objective: 1\n  interval: 2\n  rows: []\n", AMBULO_E_SCHEMA,
         "got '2'; expected a number from 0 to 1");
  refuse(state, "multipliers:\n  objectiv: 1\n  interval: 1\n  rows: []\n", AMBULO_E_SCHEMA,
         "objective");
}

/* a motion that no row presses on: a list of none */
static void test_no_forces(void **state) {
  walk w;
  walk_open(&w, 12);
  const char *path = write_solution(state, &w);
  ambulo_multipliers *m = NULL;
  assert_int_equal(ambulo_solution_multipliers(path, w.problem, AMBULO_ENDS_FREE, NULL, NULL, &m),
                   AMBULO_OK);
  assert_int_equal(m->count, 0);
  ambulo_multipliers_free(m);
  walk_close(&w);
}

/* files of older versions have none */
static void test_none(void **state) {
  walk w;
  const char *path = scratch_path(state, "solution.yaml");
  scratch_write(path, header);
  walk_open(&w, 12);
  ambulo_multipliers *m = NULL;
  assert_int_equal(ambulo_solution_multipliers(path, w.problem, AMBULO_ENDS_FREE, NULL, NULL, &m),
                   AMBULO_OK);
  assert_null(m);
  walk_close(&w);
}

static void test_out_of_memory(void **state) {
  walk w;
  walk_open(&w, 12);
  press(&w);
  const char *path = write_solution(state, &w);
  int refused = 0;
  for (long k = 0;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator a = fail_alloc_hook(&memory);
    ambulo_multipliers *m = NULL;
    ambulo_status status =
        ambulo_solution_multipliers(path, w.problem, AMBULO_ENDS_FREE, &a, NULL, &m);
    ambulo_multipliers_free(m);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
    assert_int_equal(status, AMBULO_E_MEMORY);
    refused++;
  }
  assert_true(refused > 5);
  walk_close(&w);
}

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

int main(void) {
  const struct CMUnitTest tests[] = {SCRATCH_TEST(test_same_multipliers),
                                     SCRATCH_TEST(test_periods),
                                     SCRATCH_TEST(test_refusals),
                                     SCRATCH_TEST(test_no_forces),
                                     SCRATCH_TEST(test_none),
                                     SCRATCH_TEST(test_out_of_memory)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
