/* solver/starts.c - see starts.h.
 *
 * Start 0 is the start pose, at rest. Start k > 0 has, for each coordinate that is not a
 * translation of the root, the curve over s = t/T
 *
 *     q(s) = q_0 + A (r_0 + r_1 cos 2 pi s + r_2 sin 2 pi s),   r uniform in [-1, 1],
 *     A = .15 of the coordinate's range, at most .3 rad or m
 *
 * cut to the range: motions as slow as a stride, since what is faster is smoothed away before a
 * solve begins. r follows from k and the coordinate alone (splitmix64, Steele, Lea & Flood 2014):
 * every run and machine has the same starts.
 *
 * Two ends are of one valley when their objectives differ by at most .5 % and their control points
 * by .05 rad or m, root mean square.
 */
#include "solver/starts.h"
#include "base/machine.h"
#include "contact/row_families.h"
#include "solver/result.h"
#include "model/neutral_pose.h"
#include "problem/nlp.h"
#include "solver/session.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

static const double amplitude = 0.15, most_amplitude = 0.3; /* of a range; rad, m */
static const double like_objective = 5e-3, like_points = 0.05;
enum { LEAST_INTERVALS = 12, LEAST_SPLINE = 6 };

typedef struct search {
  const ambulo_problem *problem; /* the coarse one */
  ambulo_options options;
  ambulo_allocator allocator;
  double begin, *x[AMBULO_MOST_STARTS]; /* where the valleys' first starts ended; [n] */
  ambulo__valleys *valleys;
} search;

/* ------------------------------------------------------------------ the starts */

static double uniform(uint64_t *state) {
  uint64_t z = (*state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return (double)((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1.0;
}

static void fill_start(const ambulo_problem *p, int k, double *x) {
  const double turn = 6.28318530717958647692;
  for (int i = 0; i < p->coordinates; i++) {
    const double *range = p->model->coordinates[i].range;
    double pose = p->model->coordinates[i].default_value;
    uint64_t state = ((uint64_t)k << 32) + (uint64_t)i;
    double a = fmin(most_amplitude, amplitude * (range[1] - range[0])), r[3];
    for (int j = 0; j < 3; j++) r[j] = uniform(&state);
    int still = k == 0 || ambulo__is_root_translation(p->model, i) || !isfinite(a);
    for (int c = 0; c < p->control_points; c++) {
      double angle = turn * c / fmax(1.0, p->control_points - 1.0);
      double q = pose + a * (r[0] + r[1] * cos(angle) + r[2] * sin(angle));
      x[c * p->coordinates + i] = still ? pose : fmin(range[1], fmax(range[0], q));
    }
  }
}

/* ----------------------------------------------------------------- the valleys */

static double distance(const search *s, const double *a, const double *b) {
  double sum = 0.0;
  for (int j = 0; j < s->problem->variables; j++) sum += (a[j] - b[j]) * (a[j] - b[j]);
  return sqrt(sum / s->problem->variables);
}

static int valley_of(const search *s, const ambulo_result *result) {
  int count = s->valleys->shown.basin_count;
  for (int b = 0; b < count; b++) {
    double objective = s->valleys->basin[b].objective;
    double apart = fabs(result->objective - objective);
    if (apart <= like_objective * fabs(objective) && distance(s, result->x, s->x[b]) <= like_points)
      return b;
  }
  return count;
}

static ambulo_status book(search *s, int k, const ambulo_result *result) {
  ambulo_starts *shown = &s->valleys->shown;
  shown->count++;
  if (!ambulo_verdict_is_solution(result->verdict)) return AMBULO_OK;
  int b = valley_of(s, result);
  shown->solved++;
  if (b == shown->basin_count) {
    size_t n = (size_t)s->problem->variables;
    s->x[b] = ambulo__alloc(&s->allocator, n, sizeof *s->x[b]);
    if (!s->x[b]) return AMBULO_E_MEMORY;
    memcpy(s->x[b], result->x, n * sizeof *s->x[b]);
    s->valleys->basin[b] = (ambulo_basin){.objective = result->objective, .first = k};
    shown->basin_count++;
  }
  s->valleys->basin[b].found++;
  return AMBULO_OK;
}

/* the best first, in order of cost */
static void sort(search *s) {
  ambulo_basin *basin = s->valleys->basin;
  int count = s->valleys->shown.basin_count;
  for (int i = 1; i < count; i++) {
    for (int j = i; j > 0 && basin[j].objective < basin[j - 1].objective; j--) {
      ambulo_basin moved = basin[j];
      double *x = s->x[j];
      basin[j] = basin[j - 1];
      basin[j - 1] = moved;
      s->x[j] = s->x[j - 1];
      s->x[j - 1] = x;
    }
  }
  for (int b = 0; b < count; b++) basin[b].distance = distance(s, s->x[b], s->x[0]);
}

/* ------------------------------------------------------------------- the search */

/* seconds left of the limit, at least one poll; off: there is no limit */
static double time_left(const search *s) {
  if (isnan(s->options.time_limit)) return AMBULO_OFF;
  return fmax(1e-3, s->options.time_limit - (ambulo__seconds_now() - s->begin));
}

static ambulo_status run(search *s) {
  double *x = ambulo__alloc(&s->allocator, (size_t)s->problem->variables, sizeof *x);
  ambulo_status status = x ? AMBULO_OK : AMBULO_E_MEMORY;
  int stopped = 0;
  for (int k = 0; k < s->options.starts && !status && !stopped; k++) {
    ambulo_options options = s->options;
    ambulo_result *result = NULL;
    options.starts = options.dense_samples = 1;
    options.time_limit = time_left(s);
    fill_start(s->problem, k, x);
    status =
        ambulo__solve_once(s->problem, &options, k ? x : NULL, 0, &s->allocator, NULL, &result);
    if (!status) status = book(s, k, result);
    stopped = !status && (result->ending_code == AMBULO_ENDING_CALLER ||
                          result->ending_code == AMBULO_ENDING_TIME);
    ambulo_result_free(result);
  }
  ambulo__free(&s->allocator, x);
  return status;
}

/* half the grid; where that is too coarse, the grid itself */
static ambulo_status coarse(const ambulo_problem *p, const ambulo_allocator *a,
                            ambulo_problem **out) {
  int nodes = p->definition.intervals, spline = ambulo__basis_intervals(p->basis);
  if (nodes / 2 >= LEAST_INTERVALS && spline / 2 >= LEAST_SPLINE) {
    ambulo_status status = ambulo__problem_with_grid(p, nodes / 2, spline / 2, a, out);
    if (!status || status == AMBULO_E_MEMORY) return status;
  }
  return ambulo__problem_with_grid(p, nodes, spline, a, out);
}

static ambulo_status carry(const search *s, const ambulo_problem *to, double **start) {
  *start = NULL;
  if (s->valleys->shown.basin_count == 0 || s->valleys->basin[0].first == 0) return AMBULO_OK;
  *start = ambulo__alloc(&s->allocator, (size_t)to->variables, sizeof **start);
  if (!*start) return AMBULO_E_MEMORY;
  return ambulo_problem_transfer(s->problem, s->x[0], to, *start);
}

ambulo_status ambulo__starts(const ambulo_problem *problem, const ambulo_options *options,
                             const ambulo_allocator *allocator, double **start,
                             ambulo__valleys **valleys) {
  search s = {.options = *options, .begin = ambulo__seconds_now()};
  ambulo_problem *grid = NULL;
  s.allocator = ambulo__allocator_or_default(allocator);
  *start = NULL;
  *valleys = s.valleys = ambulo__alloc(&s.allocator, 1, sizeof *s.valleys);
  if (!s.valleys) return AMBULO_E_MEMORY;
  ambulo_status status = coarse(problem, &s.allocator, &grid);
  s.problem = grid;
  if (!status) status = run(&s);
  if (!status) {
    sort(&s);
    s.valleys->shown.intervals = grid->definition.intervals;
    s.valleys->shown.basins = s.valleys->basin;
    status = carry(&s, problem, start);
  }
  for (int b = 0; b < AMBULO_MOST_STARTS; b++) ambulo__free(&s.allocator, s.x[b]);
  ambulo_problem_free(grid);
  return status;
}
