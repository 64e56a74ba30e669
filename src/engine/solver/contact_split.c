/* solver/contact_split.c - the tangent of the wrenches on contacts.
 *
 * The equations of mechanics/kernel_contacts.h, in their letters, changed by p (a dot). The point x
 * stands still, and so does the sum of the weights by which they are divided: neither matters. With
 * e = r / |r|,  r. = c. - p_c.,  e. = (r. - e (e . r.)) / |r|,  d. = p_c.,
 * g. = -2 epsilon. / epsilon^3:
 *
 *     A_c. u  = w. (u + g e (e.u)) + w g. e (e.u) + w g (e. (e.u) + e (e. . u))
 *     f_c.    = A_c (v. + eta. x d) + s_c,     s_c = A_c. u + A_c (eta x d.)
 *     m_c.    = w l^2 eta. + q_c,              q_c = (w. l^2 + 2 w l l.) eta
 *     G y.    = (M. - x x F. - sum (q_c + d x s_c + d. x f_c),  F. - sum s_c)
 *
 * since the sums stay those of the root wrench.
 */
#include "solver/contact_split.h"
#include "base/arithmetic.h"

#include <math.h>
#include <string.h>

static void add(const double a[3], double factor, double out[3]) {
  for (int i = 0; i < 3; i++) out[i] += factor * a[i];
}

/* One contact: w, d, e, |r|, and u when y is known. */
typedef struct contact {
  double weight, arm[3], line[3], distance, moved[3];
} contact;

typedef struct split {
  int count;
  double preference, spin; /* g, l^2 */
  double middle[3];        /* x */
  double factor[6][6];     /* G = L L^T, moments first */
  contact contacts[AMBULO__MOST_CONTACTS];
} split;

/* out += factor A_c v */
static void add_push(const split *s, const contact *c, const double v[3], double factor,
                     double out[3]) {
  add(v, factor * c->weight, out);
  add(c->line, factor * c->weight * s->preference * ambulo__dot(c->line, v), out);
}

/* Returns 0 in flight. */
static int place(split *s, const ambulo__contact_state *state) {
  double total = 0;
  for (int k = 0; k < s->count; k++) total += state->weight[k];
  if (!(total > 0)) return 0;
  for (int k = 0; k < s->count; k++) {
    s->contacts[k].weight = state->weight[k] / total;
    add(state->place[k], s->contacts[k].weight, s->middle);
  }
  for (int k = 0; k < s->count; k++) {
    contact *c = &s->contacts[k];
    for (int i = 0; i < 3; i++) {
      c->arm[i] = state->place[k][i] - s->middle[i];
      c->line[i] = state->center[i] - state->place[k][i];
    }
    c->distance = sqrt(ambulo__dot(c->line, c->line));
    for (int i = 0; i < 3; i++) c->line[i] /= c->distance;
  }
  return 1;
}

/* G, column by column: what a unit multiplier makes of the sums. */
static void couple(split *s) {
  memset(s->factor, 0, sizeof s->factor);
  for (int column = 0; column < 6; column++) {
    double y[6] = {0};
    y[column] = 1;
    for (int k = 0; k < s->count; k++) {
      const contact *c = &s->contacts[k];
      double u[3] = {y[3], y[4], y[5]}, f[3] = {0}, m[3] = {0};
      ambulo__add_cross(y, c->arm, 1, u);
      add_push(s, c, u, 1, f);
      add(y, c->weight * s->spin, m);
      ambulo__add_cross(c->arm, f, 1, m);
      for (int i = 0; i < 3; i++) {
        s->factor[i][column] += m[i];
        s->factor[3 + i][column] += f[i];
      }
    }
  }
}

static void factor(split *s) {
  for (int k = 0; k < 6; k++) {
    for (int i = k; i < 6; i++) {
      for (int j = 0; j < k; j++) s->factor[i][k] -= s->factor[i][j] * s->factor[k][j];
      s->factor[i][k] /= i == k ? sqrt(s->factor[k][k]) : s->factor[k][k];
    }
  }
}

static void solve(const split *s, double t[6]) {
  for (int i = 0; i < 6; i++) {
    for (int j = 0; j < i; j++) t[i] -= s->factor[i][j] * t[j];
    t[i] /= s->factor[i][i];
  }
  for (int i = 5; i >= 0; i--) {
    for (int j = i + 1; j < 6; j++) t[i] -= s->factor[j][i] * t[j];
    t[i] /= s->factor[i][i];
  }
}

/* (f, m) += what the multipliers y make of a contact; u: where v + eta x d is left, or NULL */
static void add_share(const split *s, const contact *c, const double y[6], double *u,
                      double share[6]) {
  double moved[3] = {y[3], y[4], y[5]};
  ambulo__add_cross(y, c->arm, 1, moved);
  add_push(s, c, moved, 1, share);
  add(y, c->weight * s->spin, share + 3);
  if (u) memcpy(u, moved, sizeof moved);
}

/* s_c and q_c */
static void own_change(const split *s, int k, const double y[6], const ambulo__contact_state *state,
                       const ambulo__contact_state *change, double scale, double out[6]) {
  const contact *c = &s->contacts[k];
  double weight = change->weight[k] * scale, turn[3], swept[3] = {0};
  double along = ambulo__dot(c->line, c->moved), cube = state->slant * state->slant * state->slant;
  for (int i = 0; i < 3; i++) turn[i] = change->center[i] - change->place[k][i];
  add(c->line, -ambulo__dot(c->line, turn), turn);
  for (int i = 0; i < 3; i++) turn[i] /= c->distance;
  memset(out, 0, 6 * sizeof *out);
  add(c->moved, weight, out);
  add(c->line, weight * s->preference * along, out);
  add(c->line, -2 * change->slant / cube * c->weight * along, out);
  add(turn, c->weight * s->preference * along, out);
  add(c->line, c->weight * s->preference * ambulo__dot(turn, c->moved), out);
  ambulo__add_cross(y, change->place[k], 1, swept);
  add_push(s, c, swept, 1, out);
  add(y, weight * s->spin + 2 * c->weight * state->moment_arm * change->moment_arm, out + 3);
}

/* (W'.T) the tangent of (W') */
void ambulo__contact_split_tangent(int count, const ambulo__contact_state *state,
                                   const ambulo__contact_state *change, double share[][6],
                                   double tangent[][6]) {
  split s = {.count = count, .spin = state->moment_arm * state->moment_arm};
  double y[6], by_p[6], scale = 0;
  s.preference = 1 / (state->slant * state->slant) - 1;
  for (int k = 0; k < count; k++) {
    memset(share[k], 0, 6 * sizeof share[k][0]);
    memset(tangent[k], 0, 6 * sizeof tangent[k][0]);
    scale += state->weight[k];
  }
  if (!place(&s, state)) return;
  couple(&s);
  factor(&s);
  memcpy(y, state->wrench, sizeof y);
  ambulo__add_cross(s.middle, state->wrench + 3, -1, y);
  solve(&s, y);
  memcpy(by_p, change->wrench, sizeof by_p);
  ambulo__add_cross(s.middle, change->wrench + 3, -1, by_p);
  for (int k = 0; k < count; k++) {
    contact *c = &s.contacts[k];
    double *own = tangent[k];
    add_share(&s, c, y, c->moved, share[k]);
    own_change(&s, k, y, state, change, 1 / scale, own);
    add(own + 3, -1, by_p);
    ambulo__add_cross(c->arm, own, -1, by_p);
    ambulo__add_cross(change->place[k], share[k], -1, by_p);
    add(own, -1, by_p + 3);
  }
  solve(&s, by_p);
  for (int k = 0; k < count; k++) add_share(&s, &s.contacts[k], by_p, NULL, tangent[k]);
}
