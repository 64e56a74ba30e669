/* solver/dense_grid.c - the same motion and the same rows on a finer grid of time nodes.
 *
 * The finer problem has the trajectory's own grid, hence the same unknowns, and no objective. User
 * rows and terms may count nodes; they are not asked off the nodes. Events are moved with their
 * contacts, except those at 0 and T, which are nodes on every grid.
 */
#include "problem/nlp.h"
#include "base/arithmetic.h"
#include "solver/dense.h"

#include <string.h>

enum { MOST_INTERVALS = 100000 }; /* of a problem */

static double moved(double time, double shift, double duration) {
  if (time <= AMBULO__INSTANT || time >= duration - AMBULO__INSTANT) return time;
  return time + shift;
}

/* copies of the contacts, moved; NULL without memory */
static ambulo_contact *moved_contacts(const ambulo_problem_definition *d, double shift,
                                      const ambulo_allocator *allocator) {
  ambulo_contact *contacts = ambulo__alloc(allocator, (size_t)d->contact_count, sizeof *contacts);
  for (int i = 0; contacts && i < d->contact_count; i++) {
    contacts[i] = d->contacts[i];
    contacts[i].from = moved(contacts[i].from, shift, d->duration);
    contacts[i].to = moved(contacts[i].to, shift, d->duration);
  }
  return contacts;
}

/* of a grid on events: every interval in `samples` equal ones; NULL without memory */
static double *finer_times(const ambulo_problem *p, int samples,
                           const ambulo_allocator *allocator) {
  int last = p->nodes - 1;
  double *times = ambulo__alloc(allocator, (size_t)last * (size_t)samples + 1, sizeof *times);
  for (int k = 0; times && k < last; k++) {
    double length = p->times[k + 1] - p->times[k];
    for (int i = 0; i < samples; i++) times[k * samples + i] = p->times[k] + length * i / samples;
  }
  if (times) times[last * samples] = p->times[last];
  return times;
}

static ambulo_status create_fine(const ambulo_problem *p, double shift,
                                 ambulo_diagnostics *diagnostics, ambulo__dense *dense) {
  ambulo_problem_definition d = p->definition;
  ambulo_contact *contacts = moved_contacts(&d, shift, &dense->allocator);
  double *times = finer_times(p, dense->samples, &dense->allocator);
  if (!contacts || !times) {
    ambulo__free(&dense->allocator, contacts);
    ambulo__free(&dense->allocator, times);
    return AMBULO_E_MEMORY;
  }
  d.contacts = contacts;
  if (d.grid == AMBULO_GRID_EVENTS) d.node_times = times;
  d.spline_intervals = ambulo__basis_intervals(p->basis);
  if (d.discretization == AMBULO_BSPLINE) d.breakpoints = ambulo__basis_breakpoints(p->basis);
  d.knots = AMBULO_GRID_UNIFORM;
  d.intervals = p->definition.intervals * dense->samples;
  d.terms = NULL;
  d.term_count = 0;
  d.user_rows = NULL;
  d.user_row_count = 0;
  ambulo_status status = ambulo__problem_build(&d, &dense->allocator, diagnostics, &dense->fine);
  ambulo__free(&dense->allocator, contacts);
  ambulo__free(&dense->allocator, times);
  return status;
}

/* rows that are not linear */
static void curved_values(const ambulo_problem *p, ambulo__dense *dense) {
  int channels = ambulo__channel_count(&p->channels);
  for (int o = 0; o < p->row_runs.odd_count; o++) {
    int r = p->row_runs.odd[o];
    const ambulo__curved *row = ambulo__row_curved_of(&p->table, &p->table.rows[r]);
    const double *y =
        dense->channel + (row ? ambulo__lane_index(p->table.rows[r].node, channels, 0) : 0);
    if (row) dense->row_value[r] = ambulo__curved_value(row, y, AMBULO__LANES, NULL);
  }
}

/* as problem/evaluate.c does, without what gradients need */
static ambulo_status evaluate(ambulo__dense *dense, const double *x) {
  const ambulo_problem *p = dense->fine;
  const ambulo_allocator *a = &dense->allocator;
  size_t stride = (size_t)ambulo__channel_count(&p->channels) * AMBULO__LANES;
  size_t d8 = (size_t)p->coordinates * AMBULO__LANES;
  double *scratch = ambulo__alloc_aligned(a, ambulo__plan_scratch(p->plan), sizeof *scratch);
  double *room = ambulo__alloc_aligned(a, ambulo__device_scratch_size(p), sizeof *room);
  dense->channel = ambulo__alloc_aligned(a, stride * (size_t)p->blocks, sizeof *dense->channel);
  dense->row_value = ambulo__alloc_aligned(a, (size_t)p->rows, sizeof *dense->row_value);
  ambulo_status status = AMBULO_E_MEMORY;
  if (scratch && room && dense->channel && dense->row_value) {
    double *c = dense->channel;
    ambulo__lane_map_forward(p->map, x, c, c + d8, c + 2 * d8, NULL, stride);
    for (int b = 0; b < p->blocks; b++, c += stride)
      ambulo__mechanics_block(p, p->ground, p->time_factors, b, c, scratch, room);
    ambulo__row_runs_values(&p->row_runs, dense->channel, dense->row_value);
    curved_values(p, dense);
    status = AMBULO_OK;
  }
  ambulo__free_aligned(a, scratch);
  ambulo__free_aligned(a, room);
  return status;
}

int ambulo__dense_samples(const ambulo_problem *p, int samples) {
  int most = MOST_INTERVALS / p->definition.intervals;
  return samples < most ? samples : most;
}

ambulo_status ambulo__dense_open(const ambulo_problem *p, const double *x, int samples,
                                 double shift, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo__dense *dense) {
  memset(dense, 0, sizeof *dense);
  dense->allocator = ambulo__allocator_or_default(allocator);
  dense->problem = p;
  dense->samples = ambulo__dense_samples(p, samples);
  ambulo_status status = create_fine(p, shift, diagnostics, dense);
  if (!status) status = evaluate(dense, x);
  if (status) ambulo__dense_close(dense);
  return status;
}

void ambulo__dense_close(ambulo__dense *dense) {
  const ambulo_allocator *a = &dense->allocator;
  ambulo__free_aligned(a, dense->channel);
  ambulo__free_aligned(a, dense->row_value);
  ambulo_problem_free(dense->fine);
  dense->channel = dense->row_value = NULL;
  dense->fine = NULL;
}
