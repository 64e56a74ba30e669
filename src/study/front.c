/* study/front.c - the ends of a front, which points are on it, and the gaps between them (front.h).
 *
 * Ends, as little of one term as there can be: anchors of the first round have shares
 * lambda = 1 - (m - 1) least and least. Once all are solved,
 *
 *     q_j = w_j r_j / sum_k w_k r_k
 *
 * says how much the terms count there. Where a q_j, j != i, of anchor i is not within a factor of 3
 * of `least`, the anchor is asked for again with
 *
 *     w_j = c p_j / r_j,  p_i = 1 - (m - 1) least,  p_j = least,  c = 1 / sum_k p_k / (r_k s_k).
 *
 * Which points are anchors follows from the list alone: they come first, and each has the weights
 * that this file asks for.
 *
 * A point k is beaten where T_wk(j) < T_wk(k) - tolerance * sum_i w_ki r_i for another motion j:
 * its solve ended in a valley. It is dominated where z_j <= z_k in every term and z_ji < z_ki -
 * tolerance in one. The tolerance, 0.002 of the range, is what solves of ordinary accuracy leave.
 */
#include "study/front.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double factor = 3.0;
static const double tolerance = 0.002;
/* of the way between points that were spread evenly over the range */
static const double repeat_share = 0.1;
static const double outside = 0.02;
/* shares of the way that are tried where the first ones lead nowhere; the chord's own is 1/2 */
static const double shares[] = {0.5, 0.35, 0.65};
enum { SHARES = sizeof shares / sizeof *shares };

/* --------------------------------------------------------------------- ends */

double ambulo__front_round(double weight) {
  char text[32];
  (void)snprintf(text, sizeof text, "%.4e", weight);
  return strtod(text, NULL);
}

double ambulo__front_total(const ambulo__front *f, const double *weight, int motion) {
  const ambulo__front_point *x = &f->point[motion];
  double total = x->total;
  for (int i = 0; i < f->terms; i++) total += (weight[i] - x->weight[i]) * x->value[i];
  return total;
}

static double share_at(const ambulo__front *f, int i, int term) {
  return i == term ? 1.0 - (f->terms - 1) * f->least : f->least;
}

static void ask_first(const ambulo__front *f, int term, ambulo__front_request *request) {
  *request = (ambulo__front_request){.from = -1, .parent = {-1, -1}, .anchor = term};
  for (int i = 0; i < f->terms; i++)
    request->weight[i] = ambulo__front_round(f->terms * f->own[i] * share_at(f, i, term));
}

/* 1: its other terms count too much or too little; and the weights that are better */
static int ask_again(const ambulo__front *f, int term, int anchor, const double *range,
                     ambulo__front_request *request) {
  double sum = 0.0, c = 0.0;
  int wrong = 0;
  for (int i = 0; i < f->terms; i++) {
    if (!(range[i] > 0.0)) return 0;
    sum += f->point[anchor].weight[i] * range[i];
    c += share_at(f, i, term) / (range[i] * f->terms * f->own[i]);
  }
  *request = (ambulo__front_request){.from = -1, .parent = {-1, -1}, .anchor = term};
  for (int i = 0; i < f->terms; i++) {
    double q = f->point[anchor].weight[i] * range[i] / sum;
    wrong |= i != term && (q > factor * f->least || q < f->least / factor);
    request->weight[i] = ambulo__front_round(share_at(f, i, term) / range[i] / c);
  }
  return wrong;
}

static int is_asked(const ambulo__front *f, int k, const ambulo__front_request *request) {
  if (k >= f->points) return 0;
  for (int i = 0; i < f->terms; i++)
    if (f->point[k].weight[i] != request->weight[i]) return 0;
  return 1;
}

/* lowest J_i and range over the anchors; 0: one has no solution */
static int measure(const ambulo__front *f, const int *anchor, double *lowest, double *range) {
  for (int i = 0; i < f->terms; i++) {
    double low = INFINITY, high = -INFINITY;
    for (int k = 0; k < f->terms; k++) {
      if (!f->point[anchor[k]].solved) return 0;
      low = fmin(low, f->point[anchor[k]].value[i]);
      high = fmax(high, f->point[anchor[k]].value[i]);
    }
    lowest[i] = low;
    range[i] = high - low;
  }
  return 1;
}

int ambulo__front_anchors(const ambulo__front *f, int anchor[AMBULO__FRONT_TERMS],
                          double lowest[AMBULO__FRONT_TERMS], double range[AMBULO__FRONT_TERMS],
                          ambulo__front_request *requests, int *count) {
  int m = f->terms, next = m;
  *count = 0;
  for (int i = 0; i < m; i++) {
    anchor[i] = i < f->points ? i : -1;
    if (anchor[i] < 0) ask_first(f, i, &requests[(*count)++]);
  }
  if (*count > 0) return 0;
  for (int round = 0; round < AMBULO__FRONT_ROUNDS; round++) {
    int missing = 0, before[AMBULO__FRONT_TERMS];
    if (!measure(f, anchor, lowest, range)) return 0;
    for (int i = 0; i < m; i++) {
      before[i] = anchor[i];
      if (!ask_again(f, i, before[i], range, &requests[missing])) continue;
      if (is_asked(f, next, &requests[missing])) {
        anchor[i] = next++;
      } else {
        missing++;
      }
    }
    *count = missing;
    if (missing > 0) return 0;
  }
  return measure(f, anchor, lowest, range);
}

/* ----------------------------------------------------------------- standing */

double ambulo__front_distance(const ambulo__front *f, int a, int b) {
  double sum = 0.0;
  for (int i = 0; i < f->terms; i++) {
    double d = f->point[a].z[i] - f->point[b].z[i];
    sum += d * d;
  }
  return sqrt(sum);
}

/* the motion that is best for the weights of k, where it is clearly better than its own; -1 */
static int beater(const ambulo__front *f, int k, const double *range) {
  const ambulo__front_point *p = &f->point[k];
  double size = 0.0, best;
  int found = -1;
  for (int i = 0; i < f->terms; i++) size += p->weight[i] * range[i];
  best = p->total - tolerance * size;
  for (int j = 0; j < f->points; j++) {
    if (j == k || !f->point[j].solved) continue;
    double total = ambulo__front_total(f, p->weight, j);
    if (!(total < best)) continue;
    best = total;
    found = j;
  }
  return found;
}

static int dominates(const ambulo__front *f, int j, int k) {
  int better = 0;
  for (int i = 0; i < f->terms; i++) {
    double d = f->point[k].z[i] - f->point[j].z[i];
    if (d < 0.0) return 0;
    better |= d > tolerance;
  }
  return better;
}

static int dominator(const ambulo__front *f, int k) {
  for (int j = 0; j < f->points; j++)
    if (j != k && f->point[j].solved && dominates(f, j, k)) return j;
  return -1;
}

static int is_anchor(const ambulo__front *f, const int *anchor, int k) {
  for (int i = 0; i < f->terms; i++)
    if (anchor[i] == k) return 1;
  return 0;
}

/* an anchor of an earlier round (they come first in the list), beyond those that took its place */
static int is_outside(const ambulo__front *f, const int *anchor, int k) {
  int last = 0;
  for (int i = 0; i < f->terms; i++)
    if (anchor[i] > last) last = anchor[i];
  if (k > last || is_anchor(f, anchor, k)) return 0;
  for (int i = 0; i < f->terms; i++)
    if (f->terms == 2 && (f->point[k].z[i] > 1.0 + outside || f->point[k].z[i] < -outside))
      return 1;
  return 0;
}

/* one that is on the front already and as good as at the same place; anchors come first */
static int twin(const ambulo__front *f, int k) {
  double near = repeat_share / (f->wanted - 1);
  for (int j = 0; j < f->points; j++)
    if (f->point[j].standing == AMBULO__FRONT_ON && ambulo__front_distance(f, j, k) < near)
      return j;
  return -1;
}

static void stand(ambulo__front_point *p, ambulo__front_standing standing, int better) {
  p->standing = standing;
  p->better = better;
}

static void judge_one(ambulo__front *f, const int *anchor, const double *range, int k) {
  ambulo__front_point *p = &f->point[k];
  if (!p->solved || p->standing != AMBULO__FRONT_UNKNOWN) return;
  int other = beater(f, k, range);
  if (other >= 0) {
    stand(p, AMBULO__FRONT_BEATEN, other);
  } else if (is_outside(f, anchor, k)) {
    stand(p, AMBULO__FRONT_OUTSIDE, -1);
  } else if ((other = dominator(f, k)) >= 0) {
    stand(p, AMBULO__FRONT_DOMINATED, other);
  } else if ((other = twin(f, k)) >= 0) {
    stand(p, AMBULO__FRONT_REPEATS, other);
  } else {
    stand(p, AMBULO__FRONT_ON, -1);
  }
}

/* two terms: along z_0; three: in the order of the list */
static void number_places(ambulo__front *f) {
  for (int k = 0, place = 0; k < f->points; k++) {
    ambulo__front_point *p = &f->point[k];
    if (p->standing != AMBULO__FRONT_ON) continue;
    p->place = place++;
    for (int j = 0; j < f->points && f->terms == 2; j++) {
      const ambulo__front_point *o = &f->point[j];
      if (j == 0) p->place = 0;
      if (j != k && o->standing == AMBULO__FRONT_ON)
        p->place += o->z[0] < p->z[0] || (o->z[0] == p->z[0] && j < k);
    }
  }
}

/* from a point to the next in the order of places, or to the nearest one; -1: the last */
static double gap_after(const ambulo__front *f, int k) {
  double gap = -1.0;
  for (int j = 0; j < f->points; j++) {
    if (j == k || f->point[j].standing != AMBULO__FRONT_ON) continue;
    if (f->terms == 2 && f->point[j].place != f->point[k].place + 1) continue;
    double d = ambulo__front_distance(f, k, j);
    if (gap < 0.0 || d < gap) gap = d;
  }
  return gap;
}

static void sum_up(const ambulo__front *f, ambulo__front_report *r) {
  int gaps = 0;
  for (int k = 0; k < f->points; k++) {
    ambulo__front_standing s = f->point[k].standing;
    r->on += s == AMBULO__FRONT_ON;
    r->beaten += s == AMBULO__FRONT_BEATEN;
    r->dominated += s == AMBULO__FRONT_DOMINATED;
    r->repeats += s == AMBULO__FRONT_REPEATS || s == AMBULO__FRONT_OUTSIDE;
    r->unsolved += s == AMBULO__FRONT_UNKNOWN;
    double gap = s == AMBULO__FRONT_ON ? gap_after(f, k) : -1.0;
    if (gap < 0.0) continue;
    gaps++;
    r->mean += gap;
    r->largest = fmax(r->largest, gap);
  }
  if (gaps > 0) r->mean /= gaps;
}

void ambulo__front_judge(ambulo__front *f, ambulo__front_report *report) {
  ambulo__front_request requests[AMBULO__FRONT_TERMS];
  ambulo__front_report r;
  int anchor[AMBULO__FRONT_TERMS], count = 0;
  double lowest[AMBULO__FRONT_TERMS], range[AMBULO__FRONT_TERMS];
  memset(&r, 0, sizeof r);
  for (int k = 0; k < f->points; k++) {
    stand(&f->point[k], AMBULO__FRONT_UNKNOWN, -1);
    f->point[k].place = -1;
  }
  r.complete = ambulo__front_anchors(f, anchor, lowest, range, requests, &count);
  r.conflict = r.complete;
  for (int i = 0; i < f->terms && r.complete; i++) r.conflict &= range[i] > 0.0;
  for (int k = 0; k < f->points && r.conflict; k++)
    for (int i = 0; i < f->terms; i++)
      f->point[k].z[i] = (f->point[k].value[i] - lowest[i]) / range[i];
  for (int i = 0; i < f->terms && r.conflict; i++) judge_one(f, anchor, range, anchor[i]);
  for (int k = 0; k < f->points && r.conflict; k++) judge_one(f, anchor, range, k);
  number_places(f);
  sum_up(f, &r);
  *report = r;
}

/* --------------------------------------------------------------------- gaps */

/* eq. (chord); where noise hides it, the middle */
static double tie(const ambulo__front *f, int a, int b) {
  const ambulo__front_point *A = &f->point[a], *B = &f->point[b];
  double ga = ambulo__front_total(f, A->weight, b) - A->total;
  double gb = ambulo__front_total(f, B->weight, a) - B->total;
  if (!(ga > 0.0) || !(gb > 0.0)) return 0.5;
  return ga / (ga + gb);
}

static int find(const ambulo__front *f, const double *weight) {
  for (int k = 0; k < f->points; k++) {
    int same = 1;
    for (int i = 0; i < f->terms; i++) same &= f->point[k].weight[i] == weight[i];
    if (same) return k;
  }
  return -1;
}

int ambulo__front_between(const ambulo__front *f, int a, int b, double u,
                          ambulo__front_request *request) {
  double best = tie(f, a, b), t = u * best / (u * best + (1.0 - u) * (1.0 - best));
  *request = (ambulo__front_request){.from = -1, .parent = {a, b}, .anchor = -1};
  for (int i = 0; i < f->terms; i++)
    request->weight[i] =
        ambulo__front_round((1.0 - t) * f->point[a].weight[i] + t * f->point[b].weight[i]);
  if (f->neighbour) request->from = u <= 0.5 ? a : b;
  return find(f, request->weight) < 0;
}

int ambulo__front_try(const ambulo__front *f, int a, int b, ambulo__front_request *request) {
  for (int i = 0; i < SHARES; i++)
    if (ambulo__front_between(f, a, b, shares[i], request)) return 1;
  return 0;
}

/* A solve at the chord's own weights that came back to a or b settles it; one that failed or ended
 * in a valley does not, and other shares are tried. */
int ambulo__front_is_refused(const ambulo__front *f, int a, int b) {
  ambulo__front_request request;
  if (ambulo__front_between(f, a, b, shares[0], &request)) return 0;
  ambulo__front_standing s = f->point[find(f, request.weight)].standing;
  return s == AMBULO__FRONT_ON || s == AMBULO__FRONT_REPEATS ||
         !ambulo__front_try(f, a, b, &request);
}

void ambulo__front_gaps(const ambulo__front *f, ambulo__front_gap *gap, int *count) {
  int on = 0;
  for (int k = 0; k < f->points; k++) {
    if (f->point[k].standing != AMBULO__FRONT_ON) continue;
    int place = f->point[k].place;
    if (place > 0) gap[place - 1].b = k;
    gap[place].a = k;
    on++;
  }
  *count = on > 0 ? on - 1 : 0;
  for (int i = 0; i < *count; i++) {
    gap[i].length = ambulo__front_distance(f, gap[i].a, gap[i].b);
    gap[i].refused = ambulo__front_is_refused(f, gap[i].a, gap[i].b);
  }
}
