/* study/front_anchors.c - the ends of a front: as little of one term as there can be (front.h).
 *
 * Anchors of the first round have shares lambda = 1 - (m - 1) least and least. Once all are solved,
 *
 *     q_j = w_j r_j / sum_k w_k r_k
 *
 * says how much the terms count there. Where a q_j, j != i, of anchor i is not within a factor of 3
 * of `least`, the anchor is asked for again with
 *
 *     w_j = c p_j / r_j,  p_i = 1 - (m - 1) least,  p_j = least,  c = 1 / sum_k p_k / (r_k s_k).
 *
 * Which points are anchors follows from the list alone: they come first, and each has the weights
 * that this file asks for. */
#include "study/front.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double factor = 3.0;

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
