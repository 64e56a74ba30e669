/* What presses on L5/S1 by trunk_muscles.yaml, beside a calculation by hand: the moment over the
 * arm of the back's muscles, and what lies above. */
#include <math.h>

#include "ambulo/tools/tools.h"
#include "formats/motion_file.h"
#include "support/messages.h"
#include "support/scratch.h"

typedef struct lifted {
  ambulo_problem *problem;
  ambulo_muscles *muscles;
  ambulo_muscle_analysis *analysis;
  ambulo__motion *table;
} lifted;

static void solve(void **state, const char *file, lifted *l) {
  char folder[SCRATCH_PATH + 16], table[SCRATCH_PATH + 64];
  ambulo_result *result = NULL;
  ambulo_report_options report = ambulo_report_options_default();
  (void)snprintf(folder, sizeof folder, "%s/lift", (char *)*state);
  (void)snprintf(table, sizeof table, "%s/motion.csv", folder);
  assert_int_equal(ambulo_problem_load(file, NULL, 0, NULL, NULL, &l->problem), AMBULO_OK);
  assert_int_equal(ambulo_solve(l->problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_report_write(l->problem, result, folder, &report, NULL, NULL), AMBULO_OK);
  ambulo_result_free(result);
  assert_int_equal(ambulo__motion_read(table, 0, NULL, NULL, &l->table), AMBULO_OK);
  assert_int_equal(ambulo_muscles_load("models/trunk_muscles.yaml",
                                       ambulo_problem_model(l->problem), NULL, NULL, &l->muscles),
                   AMBULO_OK);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_muscle_analysis_create(l->muscles, table, NULL, NULL, list, &l->analysis),
                   AMBULO_OK);
  if (ambulo_diagnostics_count(list)) assert_message(list, 0, "(nothing to say)");
  ambulo_diagnostics_free(list);
}

static void release(lifted *l) {
  ambulo_muscle_analysis_free(l->analysis);
  ambulo_muscles_free(l->muscles);
  ambulo__motion_free(l->table);
  ambulo_problem_free(l->problem);
}

static double cell(const ambulo__motion *table, int row, const char *name) {
  int column = ambulo__motion_column(table, name);
  assert_true(column >= 0);
  return table->values[row * table->columns + column];
}

/* of a man of 75 kg: trunk above the joint, head, both arms (de Leva 1996) */
static const double above = 75.0 * (0.3229 + 0.0694 + 2.0 * (0.0271 + 0.0162 + 0.0061));
static const double arm = 0.0581; /* m */

/* Along the pelvis. Left out are accelerations of the trunk and what muscles of the belly pull as
 * they are stretched, 0.2 to 0.4 kN. */
static double by_hand(const ambulo__motion *table, int row) {
  double held = 0.0, moment = cell(table, row, "tau.lumbar_extension");
  held += cell(table, row, "held.box.hand_r.force.y");
  held += cell(table, row, "held.box.hand_l.force.y");
  return moment / arm + (9.81 * above + held) * cos(cell(table, row, "q.pelvis_tilt"));
}

static void lifting_presses_as_by_hand(void **state) {
  lifted l = {NULL, NULL, NULL, NULL};
  solve(state, "models/lift.yaml", &l);
  const ambulo_muscle_values *v = ambulo_muscle_analysis_values(l.analysis);
  int bent = 0;
  double most = 0.0, most_by_hand = 0.0;
  assert_int_equal(v->joints, 1);
  assert_string_equal(v->joint[0], "L5S1");
  for (int k = 0; k < v->rows; k++) {
    double presses = v->contact[3 * k + 1], hand = by_hand(l.table, k);
    most = fmax(most, presses);
    most_by_hand = fmax(most_by_hand, hand);
    if (cell(l.table, k, "tau.lumbar_extension") < 100.0) continue; /* half of the largest */
    bent++;
    assert_close(presses, hand, 0.2);
  }
  assert_true(bent > 20);
  assert_close(most, most_by_hand, 0.1);
  assert_true(most > 2500.0 && most < 5000.0);
  release(&l);
}

/* Without muscles the joint bears the masses above and the box, in the mean over a time from rest
 * to rest; without the box it would be 18 % less. */
static void the_box_is_borne(void **state) {
  lifted l = {NULL, NULL, NULL, NULL};
  solve(state, "models/lift.yaml", &l);
  const ambulo_muscle_values *v = ambulo_muscle_analysis_values(l.analysis);
  double up = 0.0, time = 0.0;
  for (int k = 1; k < v->rows; k++) {
    const double *f = v->between_links + 3 * k;
    const double tilt = cell(l.table, k, "q.pelvis_tilt"), step = v->times[k] - v->times[k - 1];
    if (v->times[k] < 1.1 || v->times[k] > 2.6) continue;
    up += step * (f[0] * sin(tilt) + f[1] * cos(tilt));
    time += step;
  }
  assert_close(up / time, 9.81 * (above + 10.0), 0.05);
  release(&l);
}

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

int main(void) {
  const struct CMUnitTest tests[] = {SCRATCH_TEST(lifting_presses_as_by_hand),
                                     SCRATCH_TEST(the_box_is_borne)};
  return cmocka_run_group_tests_name("models/trunk_muscles", tests, NULL, NULL);
}
