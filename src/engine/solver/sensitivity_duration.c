/* solver/sensitivity_duration.c - the same motion, faster or slower.
 *
 * With s = t / T and control points that stay, q(s) stays too, qd = q' / T and qdd = q'' / T^2.
 * Nodes, contacts and breakpoints are at fixed fractions of T, so that no row comes or goes:
 *
 *     sum_k w_k phi            d/dT = J_t / T           (w_k are proportional to T)
 *     rates, of u the part     v = (y_k+1 - y_k) / (t_k+1 - t_k): J_t / T - sum_k w_k phi' v / T
 *       that is a difference
 *     channels                 dL/dT = -(L_qd . qd + 2 L_qdd . qdd) / T, torques among L_qd, L_qdd
 *     matching ends            their scale s_o of order o is proportional to T^o (contact/ends.c)
 *
 * On a grid on events that is so because all events are at fixed fractions of T.
 *
 * L_qd, L_qdd are the adjoints with the mechanics' reverse sweep in them (problem/gradient.c).
 * Unknowns that are slopes (Hermite) would move with T; at a stationary point that is no matter.
 */
#include "solver/partials.h"

#include "problem/nlp.h"
#include "problem/callbacks.h"

/* the rows' own part: s_o */
static double pull_of_ends(const ambulo__stationary *s) {
  const ambulo_problem *p = s->problem;
  double sum = 0.0;
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    if (row->kind != AMBULO__KIND_PERIODIC && row->kind != AMBULO__KIND_MIRRORED) continue;
    int order = p->table.terms[row->first_term].channel / p->coordinates;
    sum -= s->multiplier[r] * order * (s->workspace->row_value[r] - row->constant);
  }
  return sum;
}

static double pull_of_rates(const ambulo__stationary *s) {
  const ambulo_problem *p = s->problem;
  double sum = 0.0;
  for (int order = 1; order <= 2; order++) {
    for (int node = 0; node < p->nodes; node++) {
      for (int i = 0; i < p->coordinates; i++) {
        int channel = order * p->coordinates + i;
        sum -= order * ambulo__stationary_adjoint(s, node, channel) *
               ambulo__stationary_channel(s, node, channel);
      }
    }
  }
  return sum;
}

/* weight sum_k w_k phi' v */
static double value_of_differences(const ambulo__stationary *s, const ambulo_term *term) {
  ambulo__term_context context = ambulo__term_context_of(s->workspace);
  double sum = 0.0;
  if (!ambulo__term_is_rate(term)) return 0.0;
  for (int node = 0; node < context.nodes; node++) {
    double w = term->weight * ambulo__term_quadrature(s->problem, term, node);
    int count = ambulo__term_forms(term, &context, node);
    for (int j = 0; j < count; j++) {
      ambulo__form form;
      ambulo__term_form(term, &context, node, j, &form);
      sum += w * ambulo__term_residual(term, form.u).slope * form.difference;
    }
  }
  return sum;
}

/* (S.10) J / T - sum w phi' v / T - (L_qd . qd + 2 L_qdd . qdd) / T */
void ambulo__partials_of_duration(const ambulo__stationary *s, ambulo__partials *partials) {
  const ambulo_problem *p = s->problem;
  double sum = 0.0;
  for (int t = 0; t < p->definition.term_count; t++) {
    sum += s->workspace->term_value[t] - value_of_differences(s, &p->definition.terms[t]);
  }
  for (int block = 0; block < p->blocks; block++) ambulo__adjoint_block(s->workspace, block);
  sum += pull_of_ends(s) + pull_of_rates(s);
  partials->duration += sum / p->definition.duration;
}
