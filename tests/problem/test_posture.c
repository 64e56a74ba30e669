/* Posture against gravity: on a slope the rest of the root's pitch is where the trunk stands as it
 * does on the level. */
#include "ambulo/tools/load.h"
#include "model/neutral_pose.h"
#include "problem/nlp.h"
#include "support/test.h"

static const double slope = 0.0996686524911620; /* +10 % */

static ambulo_problem *load(const char *model, double rise, const char *objective) {
  char set[3][512];
  const char *pointer[3] = {set[0], set[1], set[2]};
  ambulo_problem *p = NULL;
  (void)snprintf(set[0], sizeof set[0], "ground.slope=%.17g",
                 rise * 180.0 / 3.14159265358979323846);
  (void)snprintf(set[1], sizeof set[1], "objective=%s", objective);
  (void)snprintf(set[2], sizeof set[2], "model=%s", model);
  assert_int_equal(ambulo_problem_load("models/walk.yaml", pointer, 3, NULL, NULL, &p), AMBULO_OK);
  return p;
}

/* each term of the motion that stays at one pitch, all else at 0; *gradient: by the pitch */
static void at_pitch(const ambulo_problem *p, double pitch, double term[2], double *gradient) {
  ambulo_workspace *w = NULL;
  double value;
  int tilt = ambulo_model_find_coordinate(p->model, "pelvis_tilt");
  double *x = calloc(2 * (size_t)p->variables, sizeof *x), *g = x + p->variables;
  assert_non_null(x);
  for (int j = tilt; j < p->variables; j += p->coordinates) x[j] = pitch;
  assert_int_equal(ambulo_workspace_create(p, NULL, &w), AMBULO_OK);
  assert_int_equal(ambulo_problem_evaluate(p, w, x, &value, term, NULL), AMBULO_OK);
  assert_int_equal(ambulo_problem_gradient(p, w, x, 1.0, NULL, g), AMBULO_OK);
  *gradient = 0.0;
  for (int j = tilt; j < p->variables; j += p->coordinates) *gradient += g[j];
  ambulo_workspace_free(w);
  free(x);
}

#define TERMS                                                                                      \
  "[{term: posture, scale: {pelvis_tilt: 2, pelvis_list: 1}, angles: {pelvis_tilt: 3}}, "          \
  "{term: upright, points: [lumbar, head_top]}]"

static void on_a_slope_the_trunk_stands_as_on_the_level(void **state) {
  (void)state;
  static const double rises[2] = {slope, -slope};
  double level[2], up[2], gradient, rest = 3.0 * 3.14159265358979323846 / 180.0;
  ambulo_problem *flat = load("lower_body_21.yaml", 0.0, TERMS);
  at_pitch(flat, rest, level, &gradient);
  assert_close(level[0], 0.0, 1e-25);
  for (int i = 0; i < 2; i++) {
    ambulo_problem *p = load("lower_body_21.yaml", rises[i], TERMS);
    int tilt = ambulo_model_find_coordinate(p->model, "pelvis_tilt");
    double axis[3], sign = 0.0;
    ambulo__neutral_axis(p->model, tilt, axis);
    for (int k = 0; k < 3; k++) sign += axis[k] * p->model->left[k];
    at_pitch(p, rest + sign * rises[i], up, &gradient);
    assert_close(up[1], level[1], 1e-14); /* the line stands to gravity as it did */
    assert_close(up[0], 0.0, 1e-25);
    ambulo_problem_free(p);
  }
  ambulo_problem_free(flat);
}

#define POSTURE                                                                                    \
  "[{term: posture, scale: {pelvis_tilt: 2}}, {term: posture, weight: 0, scale: {pelvis_list: "    \
  "1}}]"

static void its_gradient_is_that_of_differences(void **state) {
  (void)state;
  ambulo_problem *p = load("lower_body_21.yaml", slope, POSTURE);
  double high[2], low[2], term[2], gradient, unused;
  at_pitch(p, 0.25, term, &gradient);
  at_pitch(p, 0.25 + 1e-5, high, &unused);
  at_pitch(p, 0.25 - 1e-5, low, &unused);
  assert_true(fabs(gradient) > 0.1);
  assert_close((high[0] - low[0]) / 2e-5, gradient, 1e-8);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(on_a_slope_the_trunk_stands_as_on_the_level),
                                     cmocka_unit_test(its_gradient_is_that_of_differences)};
  return cmocka_run_group_tests_name("problem/posture", tests, NULL, NULL);
}
