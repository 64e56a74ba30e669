/* bench/bench_dense.c - what happens between the nodes, and whether what is predicted comes true.
 *
 * 1. For each shipped problem that fails between its nodes: the worst of each family with the
 *    intervals of the file, twice and four times as many time intervals; once with the
 *    trajectory's intervals kept, once with them in proportion.
 * 2. For each family that fails and has settings: the problem solved again with those settings, and
 *    whether the family then holds. Ends with 1 if one does not. */
#include "bench.h"
#include "ambulo/tools/load.h"

enum { MOST_SETTINGS = 6, TEXT = 512, GRIDS = 3, MOST_FAMILIES = 32 };

static const char *const problems[] = {"walk",           "walk_normal",           "walk_loaded",
                                       "walk_uphill",    "walk_tracking",         "walk_asymmetric",
                                       "walker_2d_step", "walk_without_reaction", "two_link_reach",
                                       "pendulum_swing", "fig5a_feasible",        "fig5b_torque",
                                       "yardstick_12",   "yardstick_36",          "yardstick_72"};
enum { PROBLEMS = sizeof problems / sizeof *problems };

typedef struct solved {
  ambulo_problem *problem;
  ambulo_result *result;
} solved;

static void release(solved *s) {
  ambulo_result_free(s->result);
  ambulo_problem_free(s->problem);
}

/* 0 when it has no solution */
static int solve(const char *name, const char *const *overrides, int count, solved *s) {
  char path[TEXT];
  (void)snprintf(path, sizeof path, "%s/models/%s.yaml", AMBULO_SOURCE_DIR, name);
  s->problem = NULL;
  s->result = NULL;
  if (ambulo_problem_load(path, overrides, count, NULL, NULL, &s->problem)) return 0;
  if (ambulo_solve(s->problem, NULL, NULL, NULL, NULL, &s->result)) return 0;
  ambulo_verdict verdict = ambulo_result_verdict(s->result);
  return ambulo_verdict_is_solution(verdict) || verdict == AMBULO_OPTIMAL_AT_NODES ||
         verdict == AMBULO_FEASIBLE_AT_NODES;
}

static const ambulo_dense_family *find(const ambulo_result *result, const ambulo_violation *like) {
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(result);
  for (int i = 0; i < dense->family_count; i++) {
    const ambulo_violation *v = &dense->families[i].violation;
    if (strcmp(v->family, like->family) == 0 && strcmp(v->unit, like->unit) == 0)
      return &dense->families[i];
  }
  return NULL;
}

/* ------------------------------------------------------------------- orders */

/* trajectory.intervals of a problem: a B-spline of degree 3 has 3 control points more */
static int spline_intervals(const ambulo_problem *problem) {
  return ambulo_problem_control_point_count(problem) - 3;
}

static void orders(const char *name, int both) {
  solved base;
  double value[MOST_FAMILIES][GRIDS];
  if (!solve(name, NULL, 0, &base)) return;
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(base.result);
  int n = ambulo_problem_node_count(base.problem) - 1, k = spline_intervals(base.problem);
  int count = dense->family_count < MOST_FAMILIES ? dense->family_count : MOST_FAMILIES;
  for (int i = 0; i < count; i++) value[i][0] = dense->families[i].violation.worst;
  for (int grid = 1; grid < GRIDS && dense->failing; grid++) {
    char time[64], spline[64];
    const char *overrides[] = {time, spline};
    solved finer;
    (void)snprintf(time, sizeof time, "time.intervals=%d", n << grid);
    (void)snprintf(spline, sizeof spline, "trajectory.intervals=%d", both ? k << grid : k);
    int good = solve(name, overrides, 2, &finer);
    for (int i = 0; i < count; i++) {
      const ambulo_dense_family *f =
          good ? find(finer.result, &dense->families[i].violation) : NULL;
      value[i][grid] = f ? f->violation.worst : (double)NAN;
    }
    release(&finer);
  }
  for (int i = 0; i < count; i++) {
    const ambulo_violation *v = &dense->families[i].violation;
    if (dense->families[i].holds) continue;
    printf("%-22s %-5s %-18s %-12s", name, both ? "both" : "time", v->family, v->unit);
    for (int grid = 0; grid < GRIDS; grid++) printf(" %10.2e", value[i][grid]);
    printf("   order %5.2f\n", log2(value[i][0] / value[i][GRIDS - 1]) / (GRIDS - 1));
  }
  release(&base);
}

/* -------------------------------------------------------------------- cures */

/* "--set a=1 --set b=2" to its paths and values, in place */
static int split(char *settings, const char *overrides[MOST_SETTINGS]) {
  int count = 0;
  for (char *word = strtok(settings, " "); word; word = strtok(NULL, " "))
    if (strcmp(word, "--set") != 0 && count < MOST_SETTINGS) overrides[count++] = word;
  return count;
}

/* number of families that were predicted to hold with these settings, and do not */
static int try(const char *name, const ambulo_result *before, const char *settings) {
  char text[TEXT];
  const char *overrides[MOST_SETTINGS];
  solved after;
  int failed = 0;
  (void)snprintf(text, sizeof text, "%s", settings);
  double begin = bench_seconds();
  int good = solve(name, overrides, split(text, overrides), &after);
  double seconds = bench_seconds() - begin;
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(before);
  for (int i = 0; i < dense->family_count; i++) {
    const ambulo_dense_family *f = &dense->families[i];
    if (strcmp(f->settings, settings) != 0) continue;
    const ambulo_dense_family *now = good ? find(after.result, &f->violation) : NULL;
    double share = now ? now->violation.worst / now->tolerance : 0.0;
    int holds = good && share <= 1.0;
    printf("%-22s %-18s %-12s %8.2f -> %6.2f of its tolerance  %s (%.1f s)%s\n", name,
           f->violation.family, f->violation.unit, f->violation.worst / f->tolerance, share,
           settings, seconds, holds ? "" : "   NOT AS FORETOLD");
    failed += !holds;
  }
  release(&after);
  return failed;
}

static int cures(const char *name) {
  solved base;
  int failed = 0;
  if (!solve(name, NULL, 0, &base)) return 1;
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(base.result);
  for (int i = 0; i < dense->family_count; i++) {
    const ambulo_dense_family *f = &dense->families[i];
    int known = 0;
    for (int k = 0; k < i; k++) known |= strcmp(dense->families[k].settings, f->settings) == 0;
    if (f->holds || known) continue;
    if (f->settings[0]) {
      failed += try(name, base.result, f->settings);
    } else {
      printf("%-22s %-18s %-12s %8.2f of its tolerance  %s\n", name, f->violation.family,
             f->violation.unit, f->violation.worst / f->tolerance, f->advice);
    }
  }
  release(&base);
  return failed;
}

int main(void) {
  int failed = 0;
  printf("worst between the nodes with N, 2N, 4N time intervals; trajectory's kept (time), or in "
         "proportion (both)\n");
  for (int i = 0; i < PROBLEMS; i++) {
    orders(problems[i], 0);
    orders(problems[i], 1);
  }
  printf("\nwhat helps\n");
  for (int i = 0; i < PROBLEMS; i++) failed += cures(problems[i]);
  printf("%d not as predicted\n", failed);
  return failed > 0;
}
