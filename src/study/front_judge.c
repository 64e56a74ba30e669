/* study/front_judge.c - which points are on the front (front.h).
 *
 * A point k is beaten where T_wk(j) < T_wk(k) - tolerance * sum_i w_ki r_i for another motion j:
 * its solve ended in a valley. It is dominated where z_j <= z_k in every term and z_ji < z_ki -
 * tolerance in one. The tolerance, 0.002 of the range, is what solves of ordinary accuracy leave.
 */
#include "study/front.h"

#include <math.h>
#include <string.h>

static const double tolerance = 0.002;
/* of the way between points that were spread evenly over the range */
static const double repeat_share = 0.1;
static const double outside = 0.02;

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
