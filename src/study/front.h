/* study/front.h - a Pareto front of two or three terms by weighted sums: what its points are worth,
 * and which weights to solve for next. No files, no solver: numbers in, numbers out.
 *
 * Notation, m terms (2 or 3), n points:
 *
 *     J_i(X)     value of term i of motion X without its weight         [m]
 *     R(X)       all other terms of the objective, with the weights of the file
 *     T_w(X)   = sum_i w_i J_i(X) + R(X), what the case of weights w minimizes
 *     s_i      = m times the weight of term i in the problem file, so that w_i = s_i / m, all
 *                shares 1/m, is the problem as it is written
 *     lambda_i = w_i / s_i, shares; those that are asked for sum to 1
 *     r_i        range of J_i over the anchors; z_i = (J_i - least J_i of the anchors) / r_i
 *
 * The anchor of term i has nearly all of the weight: the others keep the share `least` of
 * sum_i w_i r_i each, so that they are settled where term i leaves them open (otherwise the anchor
 * is Pareto optimal in the weak sense only). r_i is known only after the anchors are solved, so
 * they are asked for again, up to three times, until the shares are right within a factor of 3.
 *
 * T_w is linear in w for a motion. Between neighbours A and B of the front, on the line of weights
 * w(t) = (1 - t) w_A + t w_B, both are worth the same at
 *
 *     t* = a / (a + b),  a = T_wA(B) - T_wA(A) >= 0,  b = T_wB(A) - T_wB(B) >= 0         (chord)
 *
 * which is the normal of the chord from A to B where R is the same (Aneja & Nair 1979, Kim & de
 * Weck 2005, the weighted sum whose points are chosen where the front is open). A solve at t* ends
 * on the front's side of the chord. If it ends where A or B is, nothing of the front is on that
 * side: no weights lead between A and B, the gap refuses to close. That is so where the front is
 * not convex, and where it is straight. Other shares u of the way go by t(u) = u t* / (u t* + (1 -
 * u)(1 - t*)).
 *
 * With the other terms in R, a solved point minimizes sum_i lambda_i (s_i J_i + R): it is Pareto
 * optimal among s_i J_i + R. Among the J_i alone one point may then dominate another.
 *
 * Files: front.h, front.c, front_ask.c; the cases and runs of one: front_cases.c,
 * front_run.c.
 */
#ifndef AMBULO_STUDY_FRONT_H
#define AMBULO_STUDY_FRONT_H

#include "base/alloc.h"

enum { AMBULO__FRONT_TERMS = 3, AMBULO__FRONT_POINTS = 500, AMBULO__FRONT_ROUNDS = 3 };

typedef enum ambulo__front_standing {
  AMBULO__FRONT_UNKNOWN,   /* not solved yet, or no valid solution */
  AMBULO__FRONT_ON,        /* a point of the front */
  AMBULO__FRONT_BEATEN,    /* another motion is better for its own weights: a local valley */
  AMBULO__FRONT_DOMINATED, /* another motion is no worse in every term, and better in one */
  AMBULO__FRONT_REPEATS,   /* where another point is already */
  AMBULO__FRONT_OUTSIDE    /* an anchor that a better chosen one took the place of */
} ambulo__front_standing;

typedef struct ambulo__front_point {
  double weight[AMBULO__FRONT_TERMS];
  double value[AMBULO__FRONT_TERMS]; /* J_i */
  double total;                      /* T_w at its own weights */
  int solved;                        /* 1: it has a valid solution, whose numbers are above */
  int from;                          /* the point whose solution it starts from; -1: zero */
  int parent[2];                     /* the edge it was asked for; -1: none */
  /* set by ambulo__front_judge */
  ambulo__front_standing standing;
  int better; /* the point that beats or dominates it, or that it repeats; -1: none */
  int place;  /* along the front, from 0; -1: not on it */
  double z[AMBULO__FRONT_TERMS];
} ambulo__front_point;

typedef struct ambulo__front {
  int terms, points;               /* m, n */
  int wanted;                      /* points of the front that are asked for */
  int neighbour;                   /* 1: points start from the nearer end of their gap */
  double least;                    /* share of the other terms at an anchor */
  char *name[AMBULO__FRONT_TERMS]; /* of the terms */
  double own[AMBULO__FRONT_TERMS]; /* weights in the problem file */
  ambulo__front_point *point;      /* [points], in the order in which they were asked for */
} ambulo__front;

/* What to solve next. */
typedef struct ambulo__front_request {
  double weight[AMBULO__FRONT_TERMS];
  int from;      /* as of a point */
  int parent[2]; /* as of a point */
  int anchor;    /* of this term; -1: none */
} ambulo__front_request;

/* Two neighbours of the front. */
typedef struct ambulo__front_gap {
  int a, b;
  double length; /* in z */
  int refused;   /* 1: weights between were solved for, and led to neither side of a or b */
} ambulo__front_gap;

/* What a front has become. */
typedef struct ambulo__front_report {
  int on, beaten, dominated, repeats, unsolved;
  int complete;         /* 1: all anchors are solved */
  int conflict;         /* 1: some term has a range: the terms are at odds with each other */
  double largest, mean; /* of the gaps; three terms: from each point to the nearest */
} ambulo__front_report;

/* front.c: the anchors as they are known, anchor[m]: point, or -1 where none is solved that far;
 * range[m], lowest[m]: of J_i over them. Returns 1 when all are solved and shares are right (or all
 * rounds are used up); 0, and requests[0..*count), what to solve first. */
int ambulo__front_anchors(const ambulo__front *front, int anchor[AMBULO__FRONT_TERMS],
                          double lowest[AMBULO__FRONT_TERMS], double range[AMBULO__FRONT_TERMS],
                          ambulo__front_request *requests, int *count);
/* T at the weights of a point, of the motion of another one. */
double ambulo__front_total(const ambulo__front *front, const double *weight, int motion);
/* A weight to five digits, as it stands in the list of cases. */
double ambulo__front_round(double weight);
/* standing, better, place and z of every point. */
void ambulo__front_judge(ambulo__front *front, ambulo__front_report *report);
double ambulo__front_distance(const ambulo__front *front, int a, int b);
/* Of a judged front of two terms, gap[on] in the order of places, of which the first *count = on -
 * 1 are filled. */
void ambulo__front_gaps(const ambulo__front *front, ambulo__front_gap *gap, int *count);
/* Request at share u of the way from a to b. Returns 0 where these weights were solved for already.
 */
int ambulo__front_between(const ambulo__front *front, int a, int b, double u,
                          ambulo__front_request *request);
/* The first share that is tried and was not solved for; 0: all were. */
int ambulo__front_try(const ambulo__front *front, int a, int b, ambulo__front_request *request);
/* Whether every share that is tried was solved for, and a and b are neighbours still. */
int ambulo__front_is_refused(const ambulo__front *front, int a, int b);

/* front_ask.c: what to solve next, at most `room` requests; judges first. *count 0: the front is
 * done. E_MEMORY. */
ambulo_status ambulo__front_ask(ambulo__front *front, const ambulo_allocator *allocator,
                                ambulo__front_request *requests, int room, int *count);

#endif
