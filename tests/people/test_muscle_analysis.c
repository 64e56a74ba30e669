/* A walk's torques shared among muscles: work, contact forces, costs, and tables that are none. */
#include "people/walk_muscles.h"
#include "solver/result.h"
#include "support/fail_alloc.h"
#include "support/muscle_path.h"

/* q, qd or tau - e of all coordinates at one row */
static void row_of(const walk_muscles *w, int row, const char *prefix, double *values) {
  for (int c = 0; c < ambulo_model_coordinate_count(w->model); c++)
    values[c] = *cell_of(w, row, prefix, ambulo_model_coordinate(w->model, c)->name);
}

/* A muscle that lengthens takes work: -sum F dl/dt is the work of what muscles supply of the
 * torques; and -sum F dl/dq that torque itself, coordinate by coordinate. */
static void muscles_supply_the_torques_and_their_work(void **state) {
  const walk_muscles *w = *state;
  ambulo_muscle_analysis *a = analysis_of(w, w->path, NULL);
  const ambulo_muscle_values *v = ambulo_muscle_analysis_values(a);
  const int d = ambulo_model_coordinate_count(w->model), m = ambulo_muscles_count(w->muscles);
  assert_int_equal(v->rows, w->table->rows);
  double most = 0.0;
  for (int k = 0; k < v->rows; k++) {
    double q[64], qd[64], tau[64], supplied[64] = {0.0}, size = 0.0, work = 0.0, of_torques = 0.0;
    int spanned[64] = {0};
    assert_true(d <= 64 && v->times[k] == w->table->time[k]);
    row_of(w, k, "q", q);
    row_of(w, k, "qd", qd);
    row_of(w, k, "tau", tau);
    for (int i = 0; i < m; i++) {
      const ambulo_muscle *own = ambulo_muscles_get(w->muscles, i);
      const double force = v->force[k * m + i];
      double speed = 0.0;
      assert_true(force >= 0.0 && v->activation[k * m + i] >= 0.0 &&
                  v->activation[k * m + i] <= 1.0);
      for (int c = 0; c < own->coordinate_count; c++) {
        double slope = path_of(own, q, c);
        speed += slope * qd[own->coordinates[c]];
        supplied[own->coordinates[c]] -= slope * force;
        spanned[own->coordinates[c]] = 1;
      }
      work -= force * speed;
      size += fabs(force * speed);
    }
    for (int c = 0; c < d; c++) {
      double wanted = tau[c] - v->reserve[k * d + c];
      if (!spanned[c]) assert_true(v->reserve[k * d + c] == 0.0);
      if (!spanned[c]) continue;
      assert_close(supplied[c], wanted, 1e-9);
      of_torques += wanted * qd[c];
    }
    assert_true(fabs(work - of_torques) <= 1e-9 * size);
    most = fmax(most, fabs(work));
  }
  assert_true(most > 50.0);
  ambulo_muscle_analysis_free(a);
}

static int joint_of(const ambulo_muscle_values *v, const char *name) {
  for (int j = 0; j < v->joints; j++)
    if (strcmp(v->joint[j], name) == 0) return j;
  fail();
  return -1;
}

static double length_of(const double *vector) {
  return sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
}

/* On a foot that stands all of the ground's force goes through the ankle, but for the foot's own
 * weight, 1.6 %, and as much when it lands; and muscles press the joint together. */
static void joints_bear_the_ground_and_the_muscles(void **state) {
  const walk_muscles *w = *state;
  ambulo_muscle_analysis *a = analysis_of(w, w->path, NULL);
  const ambulo_muscle_values *v = ambulo_muscle_analysis_values(a);
  static const char *const names[] = {"hip_r", "knee_r", "ankle_r", "hip_l", "knee_l", "ankle_l"};
  assert_int_equal(v->joints, 6);
  for (int j = 0; j < 6; j++) assert_string_equal(v->joint[j], names[j]);
  assert_close(v->body_weight, 75.0 * 9.81, 1e-12);
  int standing = 0;
  for (int k = 0; k < v->rows; k++)
    for (int side = 0; side < 2; side++) {
      const char *foot = side ? "grf.left" : "grf.right";
      const size_t at = 3 * ((size_t)(k * v->joints + joint_of(v, side ? "ankle_l" : "ankle_r")));
      double ground[3] = {*cell_of(w, k, foot, "x"), *cell_of(w, k, foot, "y"),
                          *cell_of(w, k, foot, "z")};
      if (ground[1] < 0.5 * v->body_weight) continue;
      standing++;
      assert_true(fabs(length_of(v->between_links + at) - length_of(ground)) <
                  0.04 * v->body_weight);
      assert_true(length_of(v->contact + at) > length_of(v->between_links + at));
    }
  assert_true(standing > 100);
  ambulo_muscle_analysis_free(a);
}

static void means_are_those_of_the_rows(void **state) {
  const walk_muscles *w = *state;
  const int m = ambulo_muscles_count(w->muscles), last = w->table->rows - 1;
  ambulo_muscle_options options = ambulo_muscle_options_default();
  for (int k = 0; k < 2; k++) {
    options.resting_power = k ? 0.0 : 1.2;
    options.metabolic = k;
    ambulo_muscle_analysis *a = analysis_of(w, w->path, &options);
    const ambulo_muscle_values *v = ambulo_muscle_analysis_values(a);
    double energy = 0.0, duration = v->times[last] - v->times[0];
    for (int row = 0; row < last; row++)
      for (int i = 0; i < m; i++)
        energy += 0.5 * (v->times[row + 1] - v->times[row]) *
                  (v->metabolic[row * m + i] + v->metabolic[(row + 1) * m + i]);
    assert_close(v->bhargava, options.resting_power + energy / duration / 75.0, 1e-12);
    assert_true(v->umberger > options.resting_power + 1.0 && v->umberger < 8.0);
    /* a stride ends as it began: all of it has gone as far as the pelvis */
    assert_close(v->distance,
                 *cell_of(w, last, "q", "pelvis_tx") - *cell_of(w, 0, "q", "pelvis_tx"), 1e-6);
    ambulo_muscle_analysis_free(a);
  }
}

/* paying for power makes power smaller */
static void a_price_of_power_saves_power(void **state) {
  const walk_muscles *w = *state;
  ambulo_muscle_options dear = ambulo_muscle_options_default();
  dear.metabolic = 10.0;
  ambulo_muscle_analysis *a = analysis_of(w, w->path, NULL), *b = analysis_of(w, w->path, &dear);
  assert_true(ambulo_muscle_analysis_values(b)->bhargava <
              ambulo_muscle_analysis_values(a)->bhargava - 0.05);
  ambulo_muscle_analysis_free(a);
  ambulo_muscle_analysis_free(b);
}

/* ------------------------------------------------------------------ of a result */

static void a_result_has_the_muscles_of_its_table(void **state) {
  const walk_muscles *w = *state;
  ambulo_muscle_analysis *file = analysis_of(w, w->path, NULL), *own = NULL;
  assert_int_equal(
      ambulo_muscle_analysis_of_result(w->problem, w->result, w->muscles, 0, NULL, NULL, &own),
      AMBULO_OK);
  const ambulo_muscle_values *a = ambulo_muscle_analysis_values(file),
                             *b = ambulo_muscle_analysis_values(own);
  const size_t all = (size_t)a->rows * (size_t)ambulo_muscles_count(w->muscles);
  assert_int_equal(a->rows, b->rows);
  assert_memory_equal(a->activation, b->activation, all * sizeof(double));
  assert_memory_equal(a->metabolic, b->metabolic, all * sizeof(double));
  assert_memory_equal(a->contact, b->contact, 3 * (size_t)(a->rows * a->joints) * sizeof(double));
  assert_true(a->umberger == b->umberger && a->distance == b->distance);
  ambulo_muscle_analysis_free(file);
  ambulo_muscle_analysis_free(own);
  assert_int_equal(
      ambulo_muscle_analysis_of_result(w->problem, w->result, w->muscles, 41, NULL, NULL, &own),
      AMBULO_OK);
  assert_int_equal(ambulo_muscle_analysis_values(own)->rows, 41);
  ambulo_muscle_analysis_free(own);
}

static void a_result_without_muscles_has_none(void **state) {
  const walk_muscles *w = *state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_muscle_analysis *a = (ambulo_muscle_analysis *)1;
  ambulo_muscles *muscles = NULL;
  ambulo_model *other = NULL;
  ambulo_result *endless = NULL;
  assert_int_equal(ambulo_muscle_analysis_of_result(w->problem, w->result, NULL, 0, NULL, list, &a),
                   AMBULO_OK);
  assert_null(a);
  assert_int_equal(ambulo_diagnostics_count(list), 0);
  assert_int_equal(ambulo__result_create(w->problem, NULL, &endless), AMBULO_OK);
  endless->x[0] = (double)NAN;
  a = (ambulo_muscle_analysis *)1;
  assert_int_equal(
      ambulo_muscle_analysis_of_result(w->problem, endless, w->muscles, 0, NULL, list, &a),
      AMBULO_OK);
  assert_null(a);
  assert_int_equal(ambulo_diagnostics_count(list), 1);
  assert_message(list, 0, "warning: the motion is not finite; the result is without muscles");
  assert_int_equal(ambulo_model_load("models/lower_body_21.yaml", NULL, NULL, NULL, &other),
                   AMBULO_OK);
  assert_int_equal(ambulo_muscles_load("models/leg_muscles.yaml", other, NULL, NULL, &muscles),
                   AMBULO_OK);
  assert_int_equal(
      ambulo_muscle_analysis_of_result(w->problem, w->result, muscles, 0, NULL, NULL, &a),
      AMBULO_E_ARGUMENT);
  ambulo_muscles_free(muscles);
  ambulo_model_free(other);
  ambulo_result_free(endless);
  ambulo_diagnostics_free(list);
}

/* ----------------------------------------------------------------- what is told */

/* the list of what analysing `path` says is exactly `message` (NULL: nothing) behind its name */
static void expect_told(const walk_muscles *w, const char *path, ambulo_status expected,
                        const char *message) {
  char text[1500];
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_muscle_analysis *a = NULL;
  ambulo_status status = ambulo_muscle_analysis_create(w->muscles, path, NULL, NULL, list, &a);
  (void)snprintf(text, sizeof text, "%s%s", path, message ? message : "");
  if (message || ambulo_diagnostics_count(list)) assert_message(list, 0, text);
  assert_int_equal(ambulo_diagnostics_count(list), message != NULL);
  assert_int_equal(status, expected);
  assert_int_equal(a != NULL, expected == AMBULO_OK);
  ambulo_muscle_analysis_free(a);
  ambulo_diagnostics_free(list);
}

static void tables_that_are_none(void **state) {
  const walk_muscles *w = *state;
  static const char inverse[] = "ambulo motion: mass 75 kg, gravity 0 -9.81 0 m/s^2; SI units";
  expect_told(w, w->path, AMBULO_OK, NULL);
  write_table(w, inverse, 20, NULL);
  expect_told(w, w->other, AMBULO_OK, NULL);
  write_table(w, inverse, 20, "qdd.hip_rotation_l");
  expect_told(w, w->other, AMBULO_E_SCHEMA,
              ": error[E_SCHEMA]: no column 'qdd.hip_rotation_l'; expected a table of 'ambulo "
              "solve' or 'ambulo inverse' of this body\n"
              "  hint: 'ambulo inverse MODEL MOTION -o FILE' makes one of a motion");
  write_table(w, inverse, 1, NULL);
  expect_told(w, w->other, AMBULO_E_SCHEMA,
              ": error[E_SCHEMA]: the table has one row; expected at least 2");
  write_table(w, "inDegrees=yes", 20, NULL);
  expect_told(w, w->other, AMBULO_E_SCHEMA,
              ": error[E_SCHEMA]: angles are in degrees; expected a table of 'ambulo solve' or "
              "'ambulo inverse', in radians");
  expect_told(w, "models/leg_muscles.yaml", AMBULO_E_SCHEMA,
              ": error[E_SCHEMA]: this is a YAML file of Ambulo; expected a motion");
  expect_told(w, "models/none.csv", AMBULO_E_IO, ": error[E_IO]: cannot open");
}

/* torques of one body say nothing of another's muscles */
static void the_motion_of_another_body_is_warned_of(void **state) {
  const walk_muscles *w = *state;
  write_table(w, "ambulo motion: mass 60 kg, gravity 0 -9.81 0 m/s^2", 20, NULL);
  expect_told(w, w->other, AMBULO_OK,
              ": warning: it is the motion of a body of 60 kg; 'lower_body_23' has 75 kg\n"
              "  hint: name the problem it was solved from in place of the model, or --mass");
  write_table(w, "ambulo motion: mass 75 kg, gravity 0 -1.62 0 m/s^2", 20, NULL);
  expect_told(w, w->other, AMBULO_OK,
              ": warning: it is the motion of a body under gravity 0 -1.62 0 m/s^2");
}

static void paths_beyond_their_range_are_warned_of(void **state) {
  const walk_muscles *w = *state;
  double *bend = cell_of(w, 5, "q", "knee_angle_l"), kept = *bend;
  *bend = 2.2; /* 126 degrees */
  write_table(w, "mine", 6, NULL);
  *bend = kept;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_muscle_analysis *a = NULL;
  assert_int_equal(ambulo_muscle_analysis_create(w->muscles, w->other, NULL, NULL, list, &a),
                   AMBULO_OK);
  assert_message(list, 0, "warning: 'knee_angle_l' goes from ");
  assert_message(list, 0, " to 126 degrees; the muscles' paths hold from 0 to 120");
  ambulo_muscle_analysis_free(a);
  ambulo_diagnostics_free(list);
}

static void torques_beyond_the_muscles_are_warned_of(void **state) {
  const walk_muscles *w = *state;
  double *torque = cell_of(w, 3, "tau", "hip_flexion_r"), kept = *torque;
  *torque = 5000.0;
  write_table(w, "mine", 6, NULL);
  *torque = kept;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_muscle_analysis *a = NULL;
  assert_int_equal(ambulo_muscle_analysis_create(w->muscles, w->other, NULL, NULL, list, &a),
                   AMBULO_OK);
  char expected[200];
  const ambulo_muscle_values *v = ambulo_muscle_analysis_values(a);
  const int d = ambulo_model_coordinate_count(w->model);
  double left = v->reserve[3 * d + ambulo_model_find_coordinate(w->model, "hip_flexion_r")];
  assert_true(left > 3000.0 && left < 5000.0);
  (void)snprintf(
      expected, sizeof expected,
      "muscles leave %.1f N m of 'hip_flexion_r' at %.3f s (its largest torque is 5000.0 "
      "N m)",
      left, w->table->time[3]);
  int told = 0;
  for (size_t i = 0; i < ambulo_diagnostics_count(list); i++)
    told += strstr(ambulo_diagnostics_get(list, i)->message, expected) != NULL;
  assert_int_equal(told, 1);
  ambulo_muscle_analysis_free(a);
  ambulo_diagnostics_free(list);
}

static void arguments(void **state) {
  const walk_muscles *w = *state;
  ambulo_muscle_analysis *none = NULL;
  for (int i = 0; i < 5; i++) {
    ambulo_muscle_options o = ambulo_muscle_options_default();
    if (i == 0) o.resting_power = -1.0;
    if (i == 1) o.metabolic = -1.0;
    if (i == 2) o.activation = 0.0; /* nothing is priced */
    if (i == 3) o.reserve = (double)NAN;
    if (i == 4) o.size = 0;
    assert_int_equal(ambulo_muscle_analysis_create(w->muscles, w->path, &o, NULL, NULL, &none),
                     AMBULO_E_ARGUMENT);
  }
  assert_int_equal(ambulo_muscle_analysis_create(NULL, w->path, NULL, NULL, NULL, &none),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_muscle_analysis_create(w->muscles, NULL, NULL, NULL, NULL, &none),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_muscle_analysis_create(w->muscles, w->path, NULL, NULL, NULL, NULL),
                   AMBULO_E_ARGUMENT);
  assert_null(none);
  assert_null(ambulo_muscle_analysis_values(NULL));
  ambulo_muscle_analysis_free(NULL);
}

static void memory_may_run_out_anywhere(void **state) {
  const walk_muscles *w = *state;
  long refused = 0;
  write_table(w, "mine", 4, NULL);
  for (int way = 0; way < 4; way++)
    for (long k = 0;; k++) {
      assert_in_range(k, 0, 5000);
      fail_alloc memory = fail_alloc_at(k);
      memory.only_once = way % 2;
      ambulo_allocator hook = fail_alloc_hook(&memory);
      ambulo_muscle_analysis *a = NULL;
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      ambulo_status status =
          way < 2 ? ambulo_muscle_analysis_create(w->muscles, w->other, NULL, &hook, list, &a)
                  : ambulo_muscle_analysis_of_result(w->problem, w->result, w->muscles, 4, &hook,
                                                     list, &a);
      assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
      assert_int_equal(a != NULL, status == AMBULO_OK);
      if (status) assert_message(list, 0, "error[E_MEMORY]");
      ambulo_muscle_analysis_free(a);
      ambulo_diagnostics_free(list);
      assert_int_equal(memory.live, 0);
      refused += memory.failed;
      if (!memory.failed) break;
    }
  assert_true(refused > 40);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(muscles_supply_the_torques_and_their_work),
      cmocka_unit_test(joints_bear_the_ground_and_the_muscles),
      cmocka_unit_test(means_are_those_of_the_rows),
      cmocka_unit_test(a_price_of_power_saves_power),
      cmocka_unit_test(a_result_has_the_muscles_of_its_table),
      cmocka_unit_test(a_result_without_muscles_has_none),
      cmocka_unit_test(tables_that_are_none),
      cmocka_unit_test(the_motion_of_another_body_is_warned_of),
      cmocka_unit_test(paths_beyond_their_range_are_warned_of),
      cmocka_unit_test(torques_beyond_the_muscles_are_warned_of),
      cmocka_unit_test(arguments),
      cmocka_unit_test(memory_may_run_out_anywhere),
  };
  return cmocka_run_group_tests_name("people/muscle_analysis", tests, open_walk_muscles,
                                     close_walk_muscles);
}
