/* bench/bench_robust.c - does it arrive from elsewhere, and for other walks?
 *
 * 1. The yardstick at N = 12 from 20 random starts (independent normal control points,
 *    standard deviation 0.1 rad or m): how many end feasible, how many within 35 % of the
 *    best objective seen.
 * 2. The walk with ground reaction from ten postures offset by 0.15 rad (standard deviation).
 * 3. Ten variations of step length, step time, body mass and stature, from zero. */
#include "bench.h"
#include "ambulo/tools/load.h"

#include <string.h>

enum { STARTS = 20, OFFSETS = 10, MOST_OVERRIDES = 4 };

/* a small linear congruential generator (Knuth, MMIX) and the polar method */
static double uniform(unsigned long long *state) {
  *state = *state * 6364136223846793005ULL + 1442695040888963407ULL;
  return ((double)(*state >> 11) + 0.5) / 9007199254740992.0;
}

static double normal(unsigned long long *state) {
  for (;;) {
    double a = 2.0 * uniform(state) - 1.0, b = 2.0 * uniform(state) - 1.0, s = a * a + b * b;
    if (s > 0.0 && s < 1.0) return a * sqrt(-2.0 * log(s) / s);
  }
}

static ambulo_problem *load(const char *file, const char *const *overrides, int count) {
  char path[512];
  (void)snprintf(path, sizeof path, "%s/models/%s", AMBULO_SOURCE_DIR, file);
  ambulo_problem *problem = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  if (ambulo_problem_load(path, overrides, count, NULL, list, &problem)) {
    char text[512];
    (void)ambulo_diagnostics_format(list, 0, text, sizeof text);
    printf("%s\n", text);
  }
  ambulo_diagnostics_free(list);
  return problem;
}

static int solved(ambulo_verdict verdict) {
  return ambulo_verdict_is_solution(verdict) || verdict == AMBULO_OPTIMAL_AT_NODES ||
         verdict == AMBULO_FEASIBLE_AT_NODES;
}

static void random_starts(void) {
  ambulo_problem *problem = load("yardstick_12.yaml", NULL, 0);
  if (!problem) return;
  ambulo_options options = ambulo_problem_options(problem);
  int n = ambulo_problem_variable_count(problem), feasible = 0, near = 0;
  double *x = calloc((size_t)n, sizeof *x), objective[STARTS], best = INFINITY;
  unsigned long long state = 20261121;
  double begin = bench_seconds();
  for (int k = 0; k < STARTS; k++) {
    for (int i = 0; i < n; i++) x[i] = 0.1 * normal(&state);
    ambulo_result *result = NULL;
    objective[k] = INFINITY;
    if (ambulo_solve(problem, &options, x, NULL, NULL, &result)) continue;
    if (solved(ambulo_result_verdict(result))) objective[k] = ambulo_result_objective(result);
    ambulo_result_free(result);
    if (objective[k] < best) best = objective[k];
  }
  for (int k = 0; k < STARTS; k++) {
    feasible += isfinite(objective[k]);
    near += objective[k] <= 1.35 * best;
  }
  printf("random starts: %d of %d feasible, %d within 35 %% of the best (%.5f), %.2f s each\n",
         feasible, STARTS, near, best, (bench_seconds() - begin) / STARTS);
  free(x);
  ambulo_problem_free(problem);
}

/* posture offsets: every joint starts at a constant angle of its own, 0.15 rad spread */
static void offset_postures(void) {
  ambulo_problem *problem = load("walk_normal.yaml", NULL, 0);
  if (!problem) return;
  const ambulo_model *model = ambulo_problem_model(problem);
  ambulo_options options = ambulo_problem_options(problem);
  int d = ambulo_model_coordinate_count(model), count = 0;
  int points = ambulo_problem_control_point_count(problem);
  double *x = calloc((size_t)(points * d), sizeof *x), low = INFINITY, high = 0.0;
  unsigned long long state = 4711;
  for (int k = 0; k < OFFSETS; k++) {
    for (int i = 0; i < d; i++) {
      double offset = ambulo_model_coordinate(model, i)->actuated ? 0.15 * normal(&state) : 0.0;
      for (int c = 0; c < points; c++) x[c * d + i] = offset;
    }
    ambulo_result *result = NULL;
    if (ambulo_solve(problem, &options, x, NULL, NULL, &result)) continue;
    if (solved(ambulo_result_verdict(result))) {
      double objective = ambulo_result_objective(result);
      count++;
      if (objective < low) low = objective;
      if (objective > high) high = objective;
    }
    ambulo_result_free(result);
  }
  printf("walk_normal from offset postures: %d of %d solved, objective %.5f to %.5f\n", count,
         OFFSETS, low, high);
  free(x);
  ambulo_problem_free(problem);
}

static void variations(void) {
  static const struct {
    const char *file, *set[MOST_OVERRIDES];
  } cases[] = {
      {"yardstick_12.yaml", {"gait.step_length=0.4"}},
      {"yardstick_12.yaml", {"gait.step_length=0.5"}},
      {"yardstick_12.yaml", {"gait.step_length=0.7"}},
      {"yardstick_12.yaml", {"gait.step_length=0.8"}},
      {"yardstick_12.yaml", {"time.duration=2.0"}},
      {"yardstick_12.yaml", {"time.duration=3.2"}},
      {"walk_without_reaction.yaml",
       {"subject.mass=50", "subject.stature=1.55", "subject.sex=female"}},
      {"walk_without_reaction.yaml", {"subject.mass=110", "subject.stature=1.95"}},
      {"walk_without_reaction.yaml", {"gait.step_length=0.5", "time.duration=0.6"}},
      {"walk_without_reaction.yaml", {"gait.step_length=0.75", "time.duration=0.5"}},
  };
  int count = (int)(sizeof cases / sizeof *cases), good = 0;
  for (int k = 0; k < count; k++) {
    int sets = 0;
    while (sets < MOST_OVERRIDES && cases[k].set[sets]) sets++;
    ambulo_problem *problem = load(cases[k].file, cases[k].set, sets);
    ambulo_result *result = NULL;
    if (!problem) continue;
    ambulo_options options = ambulo_problem_options(problem);
    double begin = bench_seconds();
    if (!ambulo_solve(problem, &options, NULL, NULL, NULL, &result)) {
      ambulo_verdict verdict = ambulo_result_verdict(result);
      good += solved(verdict);
      printf("%-18s %-22s %-10s f = %-10.5g violation %.1e  %.2f s\n", cases[k].file,
             cases[k].set[0], ambulo_verdict_name(verdict), ambulo_result_objective(result),
             ambulo_result_audit(result)->violation.worst, bench_seconds() - begin);
    }
    ambulo_result_free(result);
    ambulo_problem_free(problem);
  }
  printf("variations from zero: %d of %d solved at the first try\n", good, count);
}

int main(void) {
  random_starts();
  offset_postures();
  variations();
  return 0;
}
