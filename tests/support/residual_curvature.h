/* tests/support/residual_curvature.h - the curvature of an objective by another route than the
 * metric's: differences of its residuals along a direction. Knows neither gradients nor bands. */
#ifndef AMBULO_TESTS_RESIDUAL_CURVATURE_H
#define AMBULO_TESTS_RESIDUAL_CURVATURE_H

#include "problem/callbacks.h"
#include "support/test.h"

/* residuals u of the composite terms at a node and their curvatures, or the channels */
typedef struct look {
  double *channel; /* [nodes][channels] */
  double *u;       /* [terms][nodes][MOST_FORMS] */
} look;

enum { MOST_FORMS = 64 };

static inline void look_at(ambulo_workspace *w, const double *x, look *l) {
  const ambulo_problem *p = w->problem;
  assert_int_equal(ambulo__evaluate(w, x), AMBULO_OK);
  ambulo__term_context context = ambulo__term_context_of(w);
  for (int k = 0; k < p->nodes; k++) {
    for (int c = 0; c < w->channel_count; c++)
      l->channel[k * w->channel_count + c] = w->channel[ambulo__lane_index(k, w->channel_count, c)];
    for (int t = 0; t < p->definition.term_count; t++) {
      const ambulo_term *term = &p->definition.terms[t];
      double *u = l->u + (t * p->nodes + k) * MOST_FORMS;
      if (term->kind == AMBULO_USER_SQUARE) {
        ambulo_node_state state = ambulo__node_state_view(p, k, l->channel + k * w->channel_count);
        u[0] = term->function(term->user, &state, NULL);
      }
      if (ambulo__is_user_term(term) || ambulo__term_is_simple(term)) continue;
      int forms = ambulo__term_forms(term, &context, k);
      assert_true(forms <= MOST_FORMS);
      for (int j = 0; j < forms; j++) {
        ambulo__form form;
        ambulo__term_form(term, &context, k, j, &form);
        u[j] = form.u;
      }
    }
  }
}

/* d'H d as the sum of curvature (du/dt)^2 along x + t d, by central differences of the residuals
 * themselves: knows neither gradients nor bands. Terms of the caller that are no squares: `second`
 * times the square of the first torque. */
static inline double curvature_along(ambulo_workspace *w, const double *x, const double *d,
                                     double second) {
  const ambulo_problem *p = w->problem;
  const int channels = w->channel_count, n = p->variables, terms = p->definition.term_count;
  const double h = 1e-5;
  look l[3]; /* x - h d, x + h d, x */
  double *y = calloc((size_t)n, sizeof *y), sum = 0.0;
  for (int k = 0; k < 3; k++) {
    l[k].channel = calloc((size_t)(p->nodes * channels), sizeof(double));
    l[k].u = calloc((size_t)(terms * p->nodes * MOST_FORMS), sizeof(double));
    for (int j = 0; j < n; j++) y[j] = x[j] + (k == 2 ? 0.0 : k ? h : -h) * d[j];
    look_at(w, y, &l[k]);
  }
  for (int c = 0; c < p->nodes * channels; c++)
    l[0].channel[c] = (l[1].channel[c] - l[0].channel[c]) / (2.0 * h);
  for (int t = 0; t < terms; t++) {
    const ambulo_term *term = &p->definition.terms[t];
    for (int k = 0; k < p->nodes; k++) {
      const double *dy = l[0].channel;
      double q = p->quadrature[k];
      if (term->kind == AMBULO_USER_TERM) {
        double rate = dy[k * channels + ambulo__channel_tau(&p->channels, 0)];
        sum += term->weight * q * second * rate * rate;
      } else if (ambulo__term_is_simple(term)) {
        for (int i = 0; i < p->coordinates; i++) {
          int at = k * channels + ambulo__term_channel(term, &p->channels, i);
          double scale = ambulo__term_scale(term, i), rate = scale * dy[at];
          double u =
              scale * (l[2].channel[at] - ambulo__term_offset(term, p->lean, p->coordinates, k, i));
          sum += term->weight * q * ambulo__term_residual(term, u).curvature * rate * rate;
        }
      } else {
        for (int j = 0; j < MOST_FORMS; j++) {
          int at = (t * p->nodes + k) * MOST_FORMS + j;
          double rate = (l[1].u[at] - l[0].u[at]) / (2.0 * h);
          double curvature = term->kind == AMBULO_USER_SQUARE
                                 ? 2.0
                                 : ambulo__term_residual(term, l[2].u[at]).curvature;
          sum += term->weight * ambulo__term_quadrature(p, term, k) * curvature * rate * rate;
        }
      }
    }
  }
  for (int k = 0; k < 3; k++) {
    free(l[k].channel);
    free(l[k].u);
  }
  free(y);
  return sum;
}

#endif
