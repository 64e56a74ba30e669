/* method/metric.h - the curvature of the objective as a banded matrix.
 *
 *     H0 = scale * H_GN + mu I   (+ a small metric of accelerations where H_GN is empty)
 *
 * H_GN = sum_k sum_u curvature_uk g_uk g_uk', u the residuals of the objective's terms
 * (problem/term.h) and g their gradients with respect to the unknowns of node k, of a rate also
 * of the next node: then the band is as wide as the two together. Terms of the caller have the
 * curvature of problem/callbacks.h.
 */
#ifndef AMBULO_METHOD_METRIC_H
#define AMBULO_METHOD_METRIC_H

#include "linear/band.h"
#include "method/channel_slopes.h"
#include "method/joint_squares.h"

typedef struct ambulo__metric {
  const ambulo_problem *problem;
  int channels;
  int *channel;   /* [channels]: those with a weight in some simple term, ascending */
  int composites; /* terms whose residuals stand on several channels */
  int users;      /* terms of the caller */
  int rates;      /* 1: some composite is a rate */
  double *probe;  /* [6][channels]: scratch for their curvature; NULL without */
  double *rows;   /* [row_capacity][stride]: one node's weighted gradients by its q, qd and qdd; */
  int row_capacity, stride; /* those of rates by the unknowns of two nodes */
  double *one;              /* [widest window]: gradient of one channel, a form of one coordinate */
  ambulo__spread spread;    /* from the former to the unknowns */
  ambulo__joint_squares *joint;  /* [coordinates], of one node */
  ambulo__channel_slopes slopes; /* of the node and the next */
} ambulo__metric;

ambulo_status ambulo__metric_create(const ambulo_problem *problem, ambulo__pool *pool,
                                    ambulo__metric *metric);

/* Largest number of unknowns of a node, with rates of two neighbours, less one: kd of every matrix
 * of the problem. */
int ambulo__metric_diagonals(const ambulo_problem *problem);

/* H0 at the point held (ambulo__evaluate_jacobian), without mu. */
void ambulo__metric_fill(ambulo__metric *metric, const ambulo_workspace *workspace, double scale,
                         ambulo__band *h);

/* Terms whose residuals stand on several channels, and those of the caller, with a weight. */
int ambulo__metric_is_composite(const ambulo_term *term);
int ambulo__metric_is_users(const ambulo_term *term);
/* Curvature of the simple terms along one channel of one node. */
double ambulo__metric_curvature(const ambulo_workspace *workspace, int node, int channel);

/* weight * sum_k w_k |qdd_k|^2 in its place. */
void ambulo__metric_accelerations(const ambulo__metric *metric, const ambulo_workspace *workspace,
                                  double weight, ambulo__band *h);

/* Factor by which the objective is multiplied inside the solver, so that the constants of the
 * method (mu, rho) meet curvatures of the size that they were found for: an objective in another
 * unit is solved alike. 0 where it has no curvature. */
double ambulo__metric_objective_scale(const ambulo__metric *metric,
                                      const ambulo_workspace *workspace);

#endif
