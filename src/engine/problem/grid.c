/* problem/grid.c - the same problem on another grid, and carrying a solution over.
 *
 * Coarser grids start a continuation (knot insertion), finer ones audit what lies between
 * the nodes. */
#include "problem/problem.h"
#include "base/instant.h"
#include "contact/phases.h"

#include <math.h>
#include <string.h>

/* reference [count][d] at given times from that at the problem's nodes, linear in between */
static void resample(const ambulo_problem *p, const double *source, const double *times, int count,
                     double *target) {
  size_t d = (size_t)p->coordinates;
  for (int k = 0; k < count; k++) {
    double part;
    size_t left = (size_t)ambulo__node_at(p, times[k], &part);
    for (size_t i = 0; i < d; i++) {
      double a = source[left * d + i], b = source[(left + 1) * d + i];
      target[(size_t)k * d + i] = a + part * (b - a);
    }
  }
}

static ambulo_status resample_terms(const ambulo_problem *p, int intervals, const double *times,
                                    ambulo_term *terms, double **references) {
  const ambulo_problem_definition *d = &p->definition;
  int count = 0;
  size_t size = (size_t)(intervals + 1) * (size_t)p->coordinates;
  for (int t = 0; t < d->term_count; t++) count += d->terms[t].reference != NULL;
  *references = ambulo__alloc(&p->allocator, (size_t)count * size, sizeof(double));
  if (!*references) return AMBULO_E_MEMORY;
  double *next = *references;
  for (int t = 0; t < d->term_count; t++) {
    terms[t] = d->terms[t];
    if (!terms[t].reference) continue;
    resample(p, d->terms[t].reference, times, intervals + 1, next);
    terms[t].reference = next;
    next += size;
  }
  return AMBULO_OK;
}

ambulo_status ambulo__problem_with_grid(const ambulo_problem *p, int intervals,
                                        int spline_intervals, const ambulo_allocator *allocator,
                                        ambulo_problem **out) {
  ambulo_problem_definition d = p->definition;
  double *references = NULL, *times = NULL;
  int own =
      p->definition.spline_intervals ? p->definition.spline_intervals : p->definition.intervals;
  ambulo_term *terms = ambulo__alloc(&p->allocator, (size_t)d.term_count, sizeof *terms);
  times = ambulo__alloc(&p->allocator, (size_t)intervals + 1, sizeof *times);
  ambulo_status status = terms && times ? AMBULO_OK : AMBULO_E_MEMORY;
  if (intervals != d.intervals) d.node_times = NULL;
  d.intervals = intervals;
  if (!status) status = ambulo__node_times(&d, &p->allocator, NULL, times);
  if (!status) status = resample_terms(p, intervals, times, terms, &references);
  if (!status) {
    d.spline_intervals = spline_intervals;
    if (spline_intervals != own) d.breakpoints = NULL;
    d.terms = terms;
    status = ambulo_problem_create(&d, allocator, NULL, out);
    if (!status) (*out)->file_options = p->file_options;
  }
  ambulo__free(&p->allocator, references);
  ambulo__free(&p->allocator, times);
  ambulo__free(&p->allocator, terms);
  return status;
}

ambulo_status ambulo_problem_transfer(const ambulo_problem *from, const double *x_from,
                                      const ambulo_problem *to, double *x_to) {
  if (!from || !x_from || !to || !x_to) return AMBULO_E_ARGUMENT;
  if (from->coordinates != to->coordinates) return AMBULO_E_ARGUMENT;
  if (fabs(from->definition.duration - to->definition.duration) > AMBULO__INSTANT)
    return AMBULO_E_ARGUMENT;
  return ambulo__basis_transfer(from->basis, x_from, to->basis, x_to, to->coordinates,
                                &to->allocator);
}
