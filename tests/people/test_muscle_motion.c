/* The motion that muscles are found for: a result and its table are one, with what hands hold. */
#include <math.h>

#include "ambulo/tools/tools.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/scratch.h"
#include "solver/result.h"

typedef struct lifted {
  ambulo_problem *problem;
  ambulo_result *result;
  ambulo_muscles *muscles;
  char table[SCRATCH_PATH + 64];
} lifted;

/* a box in hands, at a point that is no solution */
static void open_lift(void **state, lifted *l, const char *override) {
  char folder[SCRATCH_PATH + 16];
  ambulo_report_options report = ambulo_report_options_default();
  report.overwrite = 1;
  (void)snprintf(folder, sizeof folder, "%s/lift", (char *)*state);
  (void)snprintf(l->table, sizeof l->table, "%s/motion.csv", folder);
  assert_int_equal(ambulo_problem_load("models/lift.yaml", &override, 1, NULL, NULL, &l->problem),
                   AMBULO_OK);
  assert_int_equal(ambulo__result_create(l->problem, NULL, &l->result), AMBULO_OK);
  for (int i = 0; i < ambulo_problem_variable_count(l->problem); i++)
    l->result->x[i] = 0.2 * sin(1.7 * i);
  assert_int_equal(ambulo_report_write(l->problem, l->result, folder, &report, NULL, NULL),
                   AMBULO_OK);
  assert_int_equal(ambulo_muscles_load("models/trunk_muscles.yaml",
                                       ambulo_problem_model(l->problem), NULL, NULL, &l->muscles),
                   AMBULO_OK);
}

static void close_lift(lifted *l) {
  ambulo_muscles_free(l->muscles);
  ambulo_result_free(l->result);
  ambulo_problem_free(l->problem);
}

static void a_result_is_its_table_with_what_hands_hold(void **state) {
  lifted l;
  ambulo_muscle_analysis *file = NULL, *own = NULL;
  open_lift(state, &l, "load[0].mass=10");
  assert_int_equal(ambulo_muscle_analysis_create(l.muscles, l.table, NULL, NULL, NULL, &file),
                   AMBULO_OK);
  assert_int_equal(
      ambulo_muscle_analysis_of_result(l.problem, l.result, l.muscles, 0, NULL, NULL, &own),
      AMBULO_OK);
  const ambulo_muscle_values *a = ambulo_muscle_analysis_values(file),
                             *b = ambulo_muscle_analysis_values(own);
  assert_int_equal(a->rows, b->rows);
  assert_memory_equal(a->contact, b->contact, 3 * (size_t)a->rows * sizeof(double));
  assert_memory_equal(a->between_links, b->between_links, 3 * (size_t)a->rows * sizeof(double));
  ambulo_muscle_analysis_free(file);
  ambulo_muscle_analysis_free(own);
  close_lift(&l);
}

/* twice the box is twice the difference at the joint, and none where it is not held */
static void a_heavier_box_is_borne(void **state) {
  static const char *const masses[] = {"load[0].mass=5", "load[0].mass=10", "load[0].mass=15"};
  double up[3][2] = {{0.0}};
  for (int i = 0; i < 3; i++) {
    lifted l;
    ambulo_muscle_analysis *own = NULL;
    open_lift(state, &l, masses[i]);
    assert_int_equal(
        ambulo_muscle_analysis_of_result(l.problem, l.result, l.muscles, 73, NULL, NULL, &own),
        AMBULO_OK);
    const ambulo_muscle_values *v = ambulo_muscle_analysis_values(own);
    for (int held = 0; held < 2; held++) {
      const double *f = v->between_links + 3 * (held ? 36 : 4); /* of 3.6 s, from 0.9 to 2.8 */
      up[i][held] = f[1];
    }
    ambulo_muscle_analysis_free(own);
    close_lift(&l);
  }
  assert_close(up[1][0], up[0][0], 1e-12);
  assert_true(fabs(up[1][1] - up[0][1]) > 10.0);
  assert_close(up[2][1] - up[0][1], 2.0 * (up[1][1] - up[0][1]), 1e-2);
}

static void memory_may_run_out(void **state) {
  lifted l;
  long k = 0;
  open_lift(state, &l, "load[0].mass=10");
  for (int failed = 1; failed; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_muscle_analysis *a = NULL;
    ambulo_status status = ambulo_muscle_analysis_create(l.muscles, l.table, NULL, &hook, NULL, &a);
    failed = memory.failed;
    assert_int_equal(status, failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo_muscle_analysis_free(a);
    assert_int_equal(memory.live, 0);
  }
  assert_true(k > 20);
  close_lift(&l);
}

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

int main(void) {
  const struct CMUnitTest tests[] = {SCRATCH_TEST(a_result_is_its_table_with_what_hands_hold),
                                     SCRATCH_TEST(a_heavier_box_is_borne),
                                     SCRATCH_TEST(memory_may_run_out)};
  return cmocka_run_group_tests_name("people/muscle_motion", tests, NULL, NULL);
}
