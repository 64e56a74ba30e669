/* sensitivity/duration.c - the same motion, faster or slower.
 *
 * With s = t / T and control points that stay, q(s) stays too, qd = q' / T and qdd = q'' / T^2.
 * Nodes, contacts and breakpoints are at fixed fractions of T, so that no row comes or goes:
 *
 *     sum_k w_k phi            d/dT = J_t / T           (w_k are proportional to T)
 *     torque rate              u = scale (tau_k+1 - tau_k) N / T: J_t / T - 2 J_t / T
 *     channels                 dL/dT = -(L_qd . qd + 2 L_qdd . qdd) / T, torques among L_qd, L_qdd
 *     matching ends            their scale s_o of order o is proportional to T^o (gait/ends.c)
 *
 * On a grid on events that is so because all events are at fixed fractions of T.
 *
 * L_qd, L_qdd are the adjoints with the mechanics' reverse sweep in them (nlp/gradient.c). Unknowns
 * that are slopes (Hermite) would move with T; at a stationary point that is no matter.
 */
#include "sensitivity/partials.h"

#include "nlp/adjoint.h"

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

/* (S.10) J / T - (L_qd . qd + 2 L_qdd . qdd) / T */
void ambulo__partials_of_duration(const ambulo__stationary *s, ambulo__partials *partials) {
  const ambulo_problem *p = s->problem;
  double sum = 0.0;
  for (int t = 0; t < p->definition.term_count; t++) {
    int is_rate = ambulo__term_is_rate(p->definition.terms[t].kind);
    sum += (is_rate ? -1.0 : 1.0) * s->workspace->term_value[t];
  }
  for (int block = 0; block < p->blocks; block++) ambulo__adjoint_block(s->workspace, block);
  sum += pull_of_ends(s) + pull_of_rates(s);
  partials->duration += sum / p->definition.duration;
}
