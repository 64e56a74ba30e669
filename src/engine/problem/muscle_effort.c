/* problem/muscle_effort.c - see muscle_effort.h. */
#include "problem/muscle_effort.h"

#include <math.h>
#include <string.h>

#include "problem/nlp.h"

static const double apart = 0.01; /* s, on either side */

/* ------------------------------------------------------------------- memory */

static const ambulo_term *term_of(const ambulo_problem *p) {
  for (int t = 0; t < p->definition.term_count; t++)
    if (p->definition.terms[t].kind == AMBULO_MUSCLE_EFFORT) return &p->definition.terms[t];
  return NULL;
}

static void choose_nodes(const ambulo_problem *p, ambulo__muscle_effort *e) {
  for (int k = 0; k < p->nodes; k++) {
    int from = k, to = k;
    while (from > 0 && p->times[k] - p->times[from] < apart) from--;
    while (to + 1 < p->nodes && p->times[to] - p->times[k] < apart) to++;
    e->from[k] = from;
    e->to[k] = to;
  }
}

static ambulo_sharing prices_of(const ambulo_term *term) {
  return (ambulo_sharing){sizeof(ambulo_sharing), term->activation, term->metabolic, term->reserve,
                          1};
}

static ambulo_status allocate(const ambulo_problem *p, const ambulo_term *term,
                              ambulo__muscle_effort *e) {
  const ambulo_muscles *muscles = p->definition.muscles;
  const ambulo_sharing prices = prices_of(term);
  size_t nodes = (size_t)p->nodes;
  for (int l = 0; l < muscles->limb_count; l++) e->forms += muscles->limbs[l].coordinate_count;
  e->nodes = p->nodes;
  e->from = ambulo__alloc(&e->allocator, nodes, sizeof *e->from);
  e->to = ambulo__alloc(&e->allocator, nodes, sizeof *e->to);
  e->rows = ambulo__alloc(&e->allocator, nodes * (size_t)e->forms * AMBULO__LIMB_COORDINATES,
                          sizeof *e->rows);
  if (!e->from || !e->to || !e->rows) return AMBULO_E_MEMORY;
  return ambulo__share_create(muscles, &prices, &e->allocator, &e->share);
}

ambulo_status ambulo__muscle_effort_create(const ambulo_problem *problem,
                                           const ambulo_allocator *allocator,
                                           ambulo__muscle_effort **effort) {
  const ambulo_term *term = term_of(problem);
  if (!term) return AMBULO_OK;
  ambulo__muscle_effort *e = ambulo__alloc(allocator, 1, sizeof *e);
  if (!e) return AMBULO_E_MEMORY;
  e->allocator = *allocator;
  ambulo_status status = allocate(problem, term, e);
  if (status) {
    ambulo__muscle_effort_free(e);
    return status;
  }
  choose_nodes(problem, e);
  *effort = e;
  return AMBULO_OK;
}

void ambulo__muscle_effort_free(ambulo__muscle_effort *e) {
  if (!e) return;
  ambulo_allocator a = e->allocator;
  ambulo__share_free(e->share);
  ambulo__free(&a, e->from);
  ambulo__free(&a, e->to);
  ambulo__free(&a, e->rows);
  ambulo__free(&a, e);
}

/* ------------------------------------------------------------------- a block */

static double *channel_of(const ambulo_workspace *w, double *lanes, int node, int channel) {
  return lanes + ambulo__lane_index(node, w->channel_count, channel);
}

/* the block's q, qd, tau and tau' for a limb */
static void fill(const ambulo_workspace *w, const ambulo__muscle_limb *limb, int first,
                 double *const inputs[AMBULO__SHARE_INPUTS]) {
  const ambulo_problem *p = w->problem;
  const ambulo__muscle_effort *e = w->muscles;
  const size_t bytes = AMBULO__LANES * sizeof(double);
  for (int j = 0; j < limb->coordinate_count; j++) {
    const int c = limb->coordinates[j], at = j * AMBULO__LANES;
    const int tau = ambulo__channel_tau(&p->channels, c);
    memcpy(inputs[0] + at, channel_of(w, w->channel, first, ambulo__channel_q(&p->channels, c)),
           bytes);
    memcpy(inputs[1] + at, channel_of(w, w->channel, first, ambulo__channel_qd(&p->channels, c)),
           bytes);
    memcpy(inputs[2] + at, channel_of(w, w->channel, first, tau), bytes);
    for (int lane = 0; lane < AMBULO__LANES; lane++) {
      int k = first + lane < p->nodes ? first + lane : p->nodes - 1;
      double change =
          *channel_of(w, w->channel, e->to[k], tau) - *channel_of(w, w->channel, e->from[k], tau);
      inputs[3][at + lane] = change / (p->times[e->to[k]] - p->times[e->from[k]]);
    }
  }
}

static void add_slopes(const ambulo_workspace *w, const ambulo__muscle_limb *limb,
                       const ambulo__share_block *b, int first, double factor, double *slopes) {
  const ambulo_problem *p = w->problem;
  const ambulo__muscle_effort *e = w->muscles;
  for (int j = 0; j < limb->coordinate_count; j++) {
    const int c = limb->coordinates[j], at = j * AMBULO__LANES;
    const int tau = ambulo__channel_tau(&p->channels, c);
    double *by_q = channel_of(w, slopes, first, ambulo__channel_q(&p->channels, c));
    double *by_qd = channel_of(w, slopes, first, ambulo__channel_qd(&p->channels, c));
    double *by_tau = channel_of(w, slopes, first, tau);
    for (int lane = 0; lane < AMBULO__LANES && first + lane < p->nodes; lane++) {
      const int k = first + lane;
      const double weight = factor * p->quadrature[k];
      by_q[lane] += weight * b->by_q[at + lane];
      by_qd[lane] += weight * b->by_qd[at + lane];
      by_tau[lane] += weight * b->by_tau[at + lane];
      if (j != limb->elastic) continue;
      double rate =
          weight * b->by_tau_rate[at + lane] / (p->times[e->to[k]] - p->times[e->from[k]]);
      *channel_of(w, slopes, e->to[k], tau) += rate;
      *channel_of(w, slopes, e->from[k], tau) -= rate;
    }
  }
}

static void keep_rows(ambulo__muscle_effort *e, const ambulo__muscle_limb *limb, int form,
                      const ambulo__share_block *b, int first) {
  for (int r = 0; r < limb->coordinate_count; r++)
    for (int c = 0; c <= r; c++)
      for (int lane = 0; lane < AMBULO__LANES && first + lane < e->nodes; lane++) {
        size_t node = (size_t)(first + lane) * (size_t)e->forms;
        e->rows[(node + (size_t)(form + r)) * AMBULO__LIMB_COORDINATES + (size_t)c] =
            b->rows[(r * (r + 1) / 2 + c) * AMBULO__LANES + lane];
      }
}

/* (13.q) the least cost at which muscles supply the torques */
double ambulo__muscle_value(ambulo_workspace *workspace, const ambulo_term *term, double factor,
                            double *slopes) {
  const ambulo_problem *p = workspace->problem;
  ambulo__muscle_effort *e = workspace->muscles;
  const ambulo_muscles *muscles = e->share->muscles;
  double sum = 0.0;
  e->share->sharing = prices_of(term); /* a variant's may be others */
  for (int first = 0; first < p->nodes; first += AMBULO__LANES) {
    int form = 0;
    for (int l = 0; l < muscles->limb_count; l++) {
      const ambulo__muscle_limb *limb = &muscles->limbs[l];
      ambulo__share_block b;
      double *inputs[AMBULO__SHARE_INPUTS];
      ambulo__share_begin(e->share, l, &b, inputs);
      fill(workspace, limb, first, inputs);
      ambulo__share_end(e->share, l, &b);
      for (int lane = 0; lane < AMBULO__LANES && first + lane < p->nodes; lane++)
        sum += p->quadrature[first + lane] * b.cost[lane];
      add_slopes(workspace, limb, &b, first, factor, slopes);
      keep_rows(e, limb, form, &b, first);
      form += limb->coordinate_count;
    }
  }
  return sum;
}

const char *ambulo__muscle_lacks(const ambulo_problem_definition *d) {
  int terms = 0;
  for (int t = 0; t < d->term_count; t++) terms += d->terms[t].kind == AMBULO_MUSCLE_EFFORT;
  if (!d->muscles) return "there are no muscles; expected a file of them under 'muscles'";
  if (d->muscles->model->coordinate_count != ambulo_model_coordinate_count(d->model))
    return "the muscles are of another body";
  return terms > 1 ? "there are two such terms; expected one" : NULL;
}

/* ------------------------------------------------------------------- curvature */

int ambulo__muscle_forms(const ambulo_term *term, const ambulo__term_context *context) {
  (void)term;
  return context->muscles ? context->muscles->forms : 0;
}

void ambulo__muscle_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                         int j, ambulo__form *form) {
  const ambulo__muscle_effort *e = context->muscles;
  const ambulo_muscles *muscles = e->share->muscles;
  const double *row =
      e->rows + ((size_t)node * (size_t)e->forms + (size_t)j) * AMBULO__LIMB_COORDINATES;
  int l = 0;
  (void)term;
  while (j >= muscles->limbs[l].coordinate_count) j -= muscles->limbs[l++].coordinate_count;
  for (int c = 0; c <= j; c++)
    ambulo__form_add(form,
                     ambulo__channel_tau(&context->channels, muscles->limbs[l].coordinates[c]), 0,
                     sqrt(0.5) * row[c]);
}
