/* models/walk.yaml, one set of numbers for every speed and body, from zero.
 *
 * Beside people: curves of models/norms, which are of a comfortable speed, and figures that are
 * published of others (docs/validation.md has the sources and what is not met). */
#include "support/scratch.h"
#include "stride/economy.h"

#include "ambulo/ambulo.h"

enum { SAMPLES = 1001, SPEEDS = 5, MOST_SETTINGS = 3, TEXT = 64 };
static const double speeds[SPEEDS] = {0.8, 1.0, 1.28, 1.6, 1.9}; /* m/s */
enum { COMFORTABLE = 2 };
static const double degree = 57.295779513082321;

typedef struct walk {
  ambulo_problem *problem;
  ambulo_result *result;
  ambulo__stride stride;
  ambulo__economy economy;
  ambulo_comparison *scores; /* NULL but for those that are compared */
} walk;

static void open_walk(walk *w, const char *const *settings, int count) {
  *w = (walk){.problem = NULL};
  assert_int_equal(ambulo_problem_load(AMBULO_SOURCE_DIR "/models/walk.yaml", settings, count, NULL,
                                       NULL, &w->problem),
                   AMBULO_OK);
  assert_int_equal(ambulo_solve(w->problem, NULL, NULL, NULL, NULL, &w->result), AMBULO_OK);
  assert_int_equal(
      ambulo__stride_create(w->problem, ambulo_result_x(w->result), SAMPLES, NULL, &w->stride),
      AMBULO_OK);
  assert_int_equal(ambulo__economy_of(&w->stride, NULL, &w->economy), AMBULO_OK);
}

static void close_walk(walk *w) {
  ambulo_comparison_free(w->scores);
  ambulo__economy_free(&w->economy);
  ambulo__stride_free(&w->stride);
  ambulo_result_free(w->result);
  ambulo_problem_free(w->problem);
}

static void compare(walk *w, const char *folder) {
  ambulo_report_options options = ambulo_report_options_default();
  options.overwrite = 1;
  assert_int_equal(ambulo_report_write(w->problem, w->result, folder, &options, NULL, NULL),
                   AMBULO_OK);
  assert_int_equal(ambulo_compare_norms(folder, AMBULO_SOURCE_DIR "/models/norms", NULL, NULL, NULL,
                                        &w->scores),
                   AMBULO_OK);
}

static int open_all(void **state) {
  walk *all = calloc(SPEEDS, sizeof *all);
  void *scratch = NULL;
  char text[TEXT], folder[SCRATCH_PATH + TEXT];
  const char *setting = text;
  assert_non_null(all);
  assert_int_equal(scratch_open(&scratch), 0);
  for (int i = 0; i < SPEEDS; i++) {
    (void)snprintf(text, sizeof text, "gait.speed=%.17g", speeds[i]);
    open_walk(&all[i], &setting, 1);
    (void)snprintf(folder, sizeof folder, "%s/walk", (const char *)scratch);
    compare(&all[i], folder);
  }
  assert_int_equal(scratch_close(&scratch), 0);
  *state = all;
  return 0;
}

static int close_all(void **state) {
  walk *all = *state;
  for (int i = 0; i < SPEEDS; i++) close_walk(&all[i]);
  free(all);
  return 0;
}

/* ------------------------------------------------------------------- reading */

static int coordinate(const walk *w, const char *name) {
  int i = ambulo_model_find_coordinate(w->problem->model, name);
  assert_true(i >= 0);
  return i;
}

/* the left foot strikes at 0: values of its side, at a share of the stride */
static double at(const walk *w, const double *values, const char *name, double share) {
  int k = (int)lround(share * (SAMPLES - 1));
  return values[k * w->stride.coordinates + coordinate(w, name)];
}

/* largest of sign times `values` between two shares of the stride */
static double largest(const walk *w, const double *values, const char *name, double sign,
                      double from, double to) {
  double most = -INFINITY;
  int first = (int)lround(from * (SAMPLES - 1)), last = (int)lround(to * (SAMPLES - 1));
  for (int k = first; k <= last; k++)
    most = fmax(most, sign * values[k * w->stride.coordinates + coordinate(w, name)]);
  return most;
}

static int left_foot(const walk *w) {
  return ambulo_model_foot(w->problem->model, 0)->name[0] == 'l' ? 0 : 1;
}

/* largest (sign 1) or smallest vertical force on the left foot, body weights */
static double force(const walk *w, double sign, double from, double to) {
  const ambulo_model *m = w->problem->model;
  double most = -INFINITY;
  int first = (int)lround(from * (SAMPLES - 1)), last = (int)lround(to * (SAMPLES - 1));
  for (int k = first; k <= last; k++)
    most = fmax(most, sign * ambulo__stride_force(&w->stride, k, left_foot(w), m->up));
  return sign * most;
}

static double score(const walk *w, const char *curve) {
  for (int i = 0; i < ambulo_comparison_curve_count(w->scores); i++) {
    const ambulo_curve_score *s = ambulo_comparison_curve(w->scores, i);
    if (strcmp(s->name, curve) == 0) return s->r;
  }
  fail_msg("no curve %s", curve);
  return 0.0;
}

#define WITHIN(what, value, low, high)                                                        \
  do {                                                                                        \
    double v_ = (value);                                                                      \
    if (!(v_ >= (low) && v_ <= (high)))                                                       \
      fail_msg("%s at %g m/s is %.3f; expected %g to %g", what, speeds[i], v_, (double)(low), \
               (double)(high));                                                               \
  } while (0)

/* --------------------------------------------------------------------- tests */

static void every_speed_is_solved(void **state) {
  const walk *all = *state;
  for (int i = 0; i < SPEEDS; i++) {
    assert_int_equal(ambulo_result_verdict(all[i].result), AMBULO_OPTIMAL);
    assert_true(ambulo_result_audit(all[i].result)->violation.worst <= 1e-6);
    const ambulo_dense_audit *dense = ambulo_result_dense_audit(all[i].result);
    if (!dense->holds) fail_msg("%g m/s: %s", speeds[i], dense->summary);
  }
}

/* Perry, Gait Analysis, 1992; Winter, The Biomechanics and Motor Control of Human Gait, 1991 */
static void knees_bend_as_peoples_do(void **state) {
  const walk *all = *state;
  for (int i = 0; i < SPEEDS; i++) {
    const double *q = all[i].stride.q;
    WITHIN("the knee at strike", degree * at(&all[i], q, "knee_angle_l", 0.0), 4.0, 10.5);
    WITHIN("the knee in swing", degree * largest(&all[i], q, "knee_angle_l", 1.0, 0.55, 1.0), 50.0,
           75.0);
    assert_true(score(&all[i], "knee_flexion") >= 0.95);
    assert_true(score(&all[i], "hip_flexion") >= 0.97);
    assert_true(score(&all[i], "ankle_dorsiflexion") >= 0.85);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_speed_is_solved),
                                     cmocka_unit_test(knees_bend_as_peoples_do)};
  return cmocka_run_group_tests(tests, open_all, close_all);
}
