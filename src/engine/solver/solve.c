/* solver/solve.c - ambulo_solve: from the caller's start, or from one or several of the solver's.
 *
 * From several starts: each is solved on a coarse grid, and the best end is a start on the
 * problem's own. So is start 0, the start pose at rest, whatever it came to on the coarse grid: the
 * better result is returned, and several starts are never worse than one. Start k > 0 has, for each
 * coordinate that is not a translation of the root, the curve over s = t/T
 *
 *     q(s) = q_0 + A (r_0 + r_1 cos 2 pi s + r_2 sin 2 pi s),   r uniform in [-1, 1],
 *     A = .15 of the coordinate's range, at most .3 rad or m
 *
 * cut to the range: motions as slow as a stride, since what is faster is smoothed away before a
 * solve begins. r follows from k and the coordinate alone (splitmix64, Steele, Lea & Flood 2014):
 * every run and machine has the same starts.
 *
 * Two ends are of one valley when their objectives differ by at most .1 % and their control points
 * by .05 rad or m, root mean square.
 *
 * Where the own start leads to a point that holds its rows and is far from optimal, or to a near
 * miss that no contradiction explains, SECOND_STARTS starts are a second look.
 *
 * Reading order: solve.c, session.h, attempts.c, session.c, result.h, audit.c, result.c; between
 * the nodes: dense.h, dense_grid.c, dense_samples.c, dense_cure.c, dense_audit.c; why there is no
 * solution: explain.h, explain.c, elastic.c, relax.c, suggest.c, suggest_feet.c, suggest_forces.c,
 * advice.c; derivatives with the numbers of a problem: sensitivity.h, parameters.c, numbers_walk.c,
 * numbers_body.c, numbers_task.c, differences.c, sensitivities.c; free numbers and finer grids:
 * free_search.h, free_trial.c, free_search.c, free_refined.c.
 */
#include "solver/session.h"

#include "base/diagnostics.h"
#include "base/machine.h"
#include "model/neutral_pose.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

static const double amplitude = 0.15, most_amplitude = 0.3; /* of a range; rad, m */
static const double like_objective = 1e-3, like_points = 0.05;
enum { LEAST_INTERVALS = 12, LEAST_SPLINE = 6, SECOND_STARTS = 3 };

typedef struct ambulo__valleys {
  ambulo_starts shown;
  ambulo_basin basin[AMBULO_MOST_STARTS];
  int taken; /* the basin that is a start on the problem's own grid */
} ambulo__valleys;

typedef struct search_of_starts {
  const ambulo_problem *problem; /* the coarse one */
  ambulo_options options;
  ambulo_allocator allocator;
  double begin, *x[AMBULO_MOST_STARTS]; /* where the valleys' first starts ended; [n] */
  ambulo__valleys *valleys;
} search_of_starts;

/* -------------------------------------------------------------- several starts */

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

static double distance(const search_of_starts *s, const double *a, const double *b) {
  double sum = 0.0;
  for (int j = 0; j < s->problem->variables; j++) sum += (a[j] - b[j]) * (a[j] - b[j]);
  return sqrt(sum / s->problem->variables);
}

static int valley_of(const search_of_starts *s, const ambulo_result *result) {
  int count = s->valleys->shown.basin_count;
  for (int b = 0; b < count; b++) {
    double objective = s->valleys->basin[b].objective;
    double apart = fabs(result->objective - objective);
    if (apart <= like_objective * fabs(objective) && distance(s, result->x, s->x[b]) <= like_points)
      return b;
  }
  return count;
}

static ambulo_status book(search_of_starts *s, int k, const ambulo_result *result) {
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
static void sort(search_of_starts *s) {
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

/* seconds left of the limit, at least one poll; as it is where there is none */
static double time_left(const search_of_starts *s) {
  if (!(s->options.time_limit > 0.0)) return s->options.time_limit;
  return fmax(1e-3, s->options.time_limit - (ambulo__seconds_now() - s->begin));
}

static int is_stopped(const ambulo_result *r) {
  return r->ending_code == AMBULO_ENDING_CALLER || r->ending_code == AMBULO_ENDING_TIME;
}

static ambulo_status run(search_of_starts *s) {
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
    stopped = !status && is_stopped(result);
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

static ambulo_status carry(const search_of_starts *s, const ambulo_problem *to, double **start) {
  int b = s->valleys->taken;
  *start = NULL;
  if (b >= s->valleys->shown.basin_count || s->valleys->basin[b].first == 0) return AMBULO_OK;
  *start = ambulo__alloc(&s->allocator, (size_t)to->variables, sizeof **start);
  if (!*start) return AMBULO_E_MEMORY;
  return ambulo_problem_transfer(s->problem, s->x[b], to, *start);
}

/* *start, to be freed by the caller with the allocator, is where the best of them ends, carried
 * over to the problem's own grid; NULL where that is where the first one ends, which is the
 * solver's own start, or where none ends at a solution. The valleys are the caller's likewise.
 * again: the own start has led nowhere. */
static ambulo_status solve_starts(search_of_starts *s, const ambulo_problem *problem, int again,
                                  double **start) {
  ambulo_problem *grid = NULL;
  s->valleys = ambulo__alloc(&s->allocator, 1, sizeof *s->valleys);
  if (!s->valleys) return AMBULO_E_MEMORY;
  ambulo_status status = coarse(problem, &s->allocator, &grid);
  s->problem = grid;
  if (!status) status = run(s);
  if (!status) {
    sort(s);
    s->valleys->shown.intervals = grid->definition.intervals;
    s->valleys->shown.basins = s->valleys->basin;
    if (again && s->valleys->basin[0].first == 0) s->valleys->taken = 1;
    status = carry(s, problem, start);
  }
  for (int b = 0; b < AMBULO_MOST_STARTS; b++) ambulo__free(&s->allocator, s->x[b]);
  ambulo_problem_free(grid);
  return status;
}

typedef struct answer {
  ambulo_result *result;
  ambulo_diagnostics *messages; /* about it */
} answer;

static ambulo_status answer_from(const search_of_starts *s, const ambulo_problem *problem,
                                 const double *start, answer *out) {
  ambulo_options options = s->options;
  if (s->valleys) options.time_limit = time_left(s);
  out->messages = ambulo_diagnostics_create(&s->allocator);
  if (!out->messages) return AMBULO_E_MEMORY;
  return ambulo__solve_once(problem, &options, start, 1, &s->allocator, out->messages,
                            &out->result);
}

/* from the other starts' best: where that is better, it changes places with the own one */
static ambulo_status challenge(search_of_starts *s, const ambulo_problem *problem,
                               const double *start, answer *own) {
  answer best = {0}, other = *own;
  if (!start || is_stopped(own->result)) return AMBULO_OK;
  ambulo_status status = answer_from(s, problem, start, &best);
  if (!status && ambulo__result_is_better(best.result, own->result)) {
    *own = best;
    best = other;
    s->valleys->shown.chosen = s->valleys->basin[s->valleys->taken].first;
  }
  ambulo_result_free(best.result);
  ambulo_diagnostics_free(best.messages);
  return status;
}

/* the better of the solver's own start and of the best of the others */
static ambulo_status compare(search_of_starts *s, const ambulo_problem *problem, answer *own) {
  double *start = NULL;
  int several = s->options.starts > 1;
  ambulo_status status = several ? solve_starts(s, problem, 0, &start) : AMBULO_OK;
  if (!status) status = answer_from(s, problem, NULL, own);
  int again = !status && !several && ambulo__result_leaves_doubts(&s->options, own->result);
  if (again) {
    s->options.starts = SECOND_STARTS;
    status = solve_starts(s, problem, 1, &start);
  }
  if (!status) status = challenge(s, problem, start, own);
  ambulo__free(&s->allocator, start);
  return again && status != AMBULO_E_MEMORY ? AMBULO_OK : status;
}

static ambulo_status solve_from_starts(const ambulo_problem *problem, const ambulo_options *options,
                                       const ambulo_allocator *allocator,
                                       ambulo_diagnostics *diagnostics, ambulo_result **result) {
  search_of_starts s = {.options = *options, .begin = ambulo__seconds_now()};
  answer own = {0};
  s.allocator = ambulo__allocator_or_default(allocator);
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status = compare(&s, problem, &own);
  ambulo__diagnostics_append(own.messages, diagnostics);
  ambulo_diagnostics_free(own.messages);
  if (status) {
    ambulo_result_free(own.result);
    ambulo__free(&s.allocator, s.valleys);
    return ambulo__conclude(diagnostics, errors, status, NULL);
  }
  own.result->valleys = s.valleys;
  own.result->timing.total = ambulo__seconds_now() - s.begin;
  *result = own.result;
  return AMBULO_OK;
}

const ambulo_starts *ambulo_result_starts(const ambulo_result *result) {
  return result && result->valleys ? &result->valleys->shown : NULL;
}

ambulo_status ambulo_solve(const ambulo_problem *problem, const ambulo_options *options,
                           const double *start, const ambulo_allocator *allocator,
                           ambulo_diagnostics *diagnostics, ambulo_result **result) {
  if (!problem || !result) return AMBULO_E_ARGUMENT;
  ambulo_options own;
  ambulo_status status = ambulo__options_own(problem, options, diagnostics, &own);
  if (status) return status;
  if (!start) return solve_from_starts(problem, &own, allocator, diagnostics, result);
  return ambulo__solve_once(problem, &own, start, 1, allocator, diagnostics, result);
}
