/* support/gauss_newton.h - the objective's Gauss-Newton matrix one node at a time, as a sum of
 * outer products: slow, and independent of the banded metric that it is compared with. */
#ifndef AMBULO_TESTS_GAUSS_NEWTON_H
#define AMBULO_TESTS_GAUSS_NEWTON_H

#include "problem/nlp.h"
#include "problem/callbacks.h"
#include "support/test.h"

enum { GN_WIDEST = 512 }; /* unknowns that one node touches */

/* curvature of the objective along one channel of one node, summed over the terms */
static inline double gn_channel_curvature(const ambulo_workspace *workspace, int node, int channel,
                                          int i) {
  const ambulo_problem *p = workspace->problem;
  double y = workspace->channel[ambulo__lane_index(node, workspace->channel_count, channel)];
  double sum = 0.0;
  for (int t = 0; t < p->definition.term_count; t++) {
    const ambulo_term *term = &p->definition.terms[t];
    if (!ambulo__term_is_simple(term)) continue;
    if (ambulo__term_channel(term, &p->channels, i) != channel) continue;
    double scale = ambulo__term_scale(term, i);
    double u = scale * (y - ambulo__term_offset(term, p->lean, p->coordinates, node, i));
    sum += term->weight * scale * scale * ambulo__term_residual(term, u).curvature;
  }
  return sum * p->quadrature[node];
}

static inline void gn_add_outer(int width, double curvature, const double *g, double *local) {
  for (int a = 0; a < width; a++) {
    double factor = curvature * g[a];
    if (factor == 0.0) continue;
    double *row = local + (size_t)a * (size_t)width;
    for (int b = 0; b < width; b++) row[b] += factor * g[b];
  }
}

/* The part of a form that stands on `node`, as a local gradient; 0 if it has none. A form over
 * two nodes is split by 2 a^2 + 2 b^2 >= (a + b)^2, which keeps the matrix local to the node and
 * above the true one. */
static inline int gn_form_gradient(const ambulo_workspace *workspace, int node, int ahead,
                                   const ambulo__form *form, double *g, int *shared) {
  int parts = 0, width = ambulo__node_width(workspace->problem, node);
  double one[GN_WIDEST];
  assert_true(width <= GN_WIDEST);
  memset(g, 0, (size_t)width * sizeof *g);
  *shared = 0;
  for (int c = 0; c < form->count; c++) {
    if (form->ahead[c] != ahead) {
      *shared = 1;
      continue;
    }
    ambulo__channel_local_gradient(workspace, node, form->channel[c], one);
    for (int i = 0; i < width; i++) g[i] += form->slope[c] * one[i];
    parts++;
  }
  return parts;
}

static inline void gn_add_composite(const ambulo_workspace *workspace, const ambulo_term *term,
                                    int node, double *local) {
  const ambulo_problem *p = workspace->problem;
  ambulo__term_context context = ambulo__term_context_of(workspace);
  double g[GN_WIDEST];
  int width = ambulo__node_width(p, node), last = term->kind == AMBULO_TORQUE_RATE;
  for (int ahead = 0; ahead <= last; ahead++) {
    int base = node - ahead;
    if (base < 0) continue;
    double weight = term->weight * ambulo__term_quadrature(p, term, base);
    int count = ambulo__term_forms(term, &context, base), shared = 0;
    for (int j = 0; j < count; j++) {
      ambulo__form form;
      ambulo__term_form(term, &context, base, j, &form);
      if (!gn_form_gradient(workspace, node, ahead, &form, g, &shared)) continue;
      double curvature = weight * ambulo__term_residual(term, form.u).curvature;
      gn_add_outer(width, shared ? 2.0 * curvature : curvature, g, local);
    }
  }
}

/* Added to the symmetric local[width * width] (row-major, both triangles). Uses the curvature of
 * the terms (problem/term.h). */
static inline void node_gauss_newton(const ambulo_workspace *workspace, int node, double *local) {
  const ambulo_problem *p = workspace->problem;
  double g[GN_WIDEST];
  int width = ambulo__node_width(p, node), d = p->coordinates;
  for (int order = 0; order < 4; order++) {
    for (int i = 0; i < d; i++) {
      int channel = order * d + i;
      double curvature = gn_channel_curvature(workspace, node, channel, i);
      if (curvature == 0.0) continue;
      ambulo__channel_local_gradient(workspace, node, channel, g);
      gn_add_outer(width, curvature, g, local);
    }
  }
  for (int t = 0; t < p->definition.term_count; t++) {
    const ambulo_term *term = &p->definition.terms[t];
    if (!ambulo__is_user_term(term) && !ambulo__term_is_simple(term) && term->weight > 0.0)
      gn_add_composite(workspace, term, node, local);
  }
}

#endif
