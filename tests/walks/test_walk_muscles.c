/* models/walk_muscles.yaml from zero: solved at slow, usual and fast speeds; what joints bear and
 * what it costs as measured in people; a weak muscle does less. */
#include "ambulo/tools/load.h"
#include "ambulo/tools/muscle_analysis.h"
#include "support/problem_path.h"
#include "support/test.h"

typedef struct walk {
  ambulo_problem *problem;
  ambulo_result *result;
  ambulo_muscle_analysis *analysis;
  const ambulo_muscle_values *values;
} walk;

static walk open_walk(const char *const *settings, int count) {
  char path[256];
  walk w = {NULL, NULL, NULL, NULL};
  problem_path("walk_muscles", path, sizeof path);
  assert_int_equal(ambulo_problem_load(path, settings, count, NULL, NULL, &w.problem), AMBULO_OK);
  ambulo_options options = ambulo_problem_options(w.problem);
  assert_int_equal(ambulo_solve(w.problem, &options, NULL, NULL, NULL, &w.result), AMBULO_OK);
  if (ambulo_result_verdict(w.result) != AMBULO_OPTIMAL)
    fail_msg("%s: %s", count > 0 ? settings[0] : "",
             ambulo_verdict_name(ambulo_result_verdict(w.result)));
  assert_int_equal(
      ambulo_muscle_analysis_of_result(w.problem, w.result, NULL, 0, NULL, NULL, &w.analysis),
      AMBULO_OK);
  assert_non_null(w.analysis);
  w.values = ambulo_muscle_analysis_values(w.analysis);
  return w;
}

static void close_walk(walk *w) {
  ambulo_muscle_analysis_free(w->analysis);
  ambulo_result_free(w->result);
  ambulo_problem_free(w->problem);
}

/* body weights */
static double largest_contact(const ambulo_muscle_values *v, const char *joint) {
  double most = 0.0;
  int j = 0;
  while (j < v->joints && strcmp(v->joint[j], joint) != 0) j++;
  assert_true(j < v->joints);
  for (int k = 0; k < v->rows; k++) {
    const double *f = v->contact + 3 * ((size_t)k * (size_t)v->joints + (size_t)j);
    most = fmax(most, sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]));
  }
  return most / v->body_weight;
}

static double largest_force(const walk *w, const char *muscle) {
  const ambulo_muscles *muscles = ambulo_problem_muscles(w->problem);
  const int count = ambulo_muscles_count(muscles), m = ambulo_muscles_find(muscles, muscle);
  double most = 0.0;
  assert_true(m >= 0);
  for (int k = 0; k < w->values->rows; k++)
    most = fmax(most, w->values->force[(size_t)k * (size_t)count + (size_t)m]);
  return most;
}

static void speeds(void **state) {
  (void)state;
  static const char *const all[] = {"gait.speed=0.7", "gait.speed=1.28", "gait.speed=1.72",
                                    "gait.speed=0.9", "gait.speed=1.1",  "gait.speed=2"};
  int count = getenv("AMBULO_LONG") ? 6 : 3;
  double cost[6];
  for (int i = 0; i < count; i++) {
    walk w = open_walk(&all[i], 1);
    const ambulo_muscle_values *v = w.values;
    double lasts = v->times[v->rows - 1] - v->times[0];
    double hip = largest_contact(v, "hip_r"), knee = largest_contact(v, "knee_r");
    cost[i] = v->bhargava * lasts / v->distance;
    if (!(hip >= 2.4 && hip <= 4.0 && knee >= 2.2 && knee <= 3.8 && cost[i] < 3.4))
      fail_msg("%s: hip %.2f, knee %.2f body weights, %.2f J/(kg m)", all[i], hip, knee, cost[i]);
    close_walk(&w);
  }
  assert_true(cost[1] < 0.85 * cost[0] && cost[1] < cost[2]);
}

static void weak_plantarflexors_push_less(void **state) {
  (void)state;
  static const char *const weak[] = {"muscles.strength.plantarflexors=0.2"};
  walk strong = open_walk(NULL, 0), other = open_walk(weak, 1);
  assert_true(largest_force(&other, "soleus_l") < 0.85 * largest_force(&strong, "soleus_l"));
  assert_true(largest_force(&strong, "soleus_l") > 800.0);
  close_walk(&strong);
  close_walk(&other);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(speeds),
                                     cmocka_unit_test(weak_plantarflexors_push_less)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
