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
#include "linear/sparse_rows.h"
#include "problem/nlp.h"

/* Slopes of channels at a node and the next, each found once.
 *
 * Terms of the objective look at the same torques and forces: a torque counts as a share of the
 * strength, in the power and in the rate on either side of the node. Nodes are taken in turn; what
 * was asked for of the next one is still there when it has become the node.
 */
typedef struct ambulo__channel_slopes {
  const ambulo_problem *problem;
  int slots, entries;
  int *kept;     /* [2][slots]: the node, plus one, whose slopes stand there; 0: none */
  double *value; /* [2][slots][3 d] */
  double *other; /* [3 d]: of channels that are not kept */
} ambulo__channel_slopes;

/* E_MEMORY. */
ambulo_status ambulo__channel_slopes_create(const ambulo_problem *problem, ambulo__pool *pool,
                                            ambulo__channel_slopes *s);
/* Forgets all: another point. */
void ambulo__channel_slopes_clear(ambulo__channel_slopes *s);
/* [3 d] by the node's q, qd and qdd (ambulo__evaluate_jacobian); until the next call, or of torques
 * and forces on contacts until the node after the next is asked for. */
const double *ambulo__channel_slopes_of(ambulo__channel_slopes *s,
                                        const ambulo_workspace *workspace, int node, int channel);

/* The squares of one coordinate at one node, made few.
 *
 * Residuals of a coordinate's torque and motion, linearized (strength, mechanical power, rest
 * postures, ...), are r_j = a_j tau + m_j . (q, qd, qdd). Of their sum of squares, each times its
 * curvature whose root is in a_j and m_j, what is needed is the quadratic form alone. Turning two
 * of them by the angle whose tangent is a_2 / a_1 leaves the sum as it is, and tau in one of them:
 *
 *     r_1' = c r_1 + s r_2 = |(a_1, a_2)| tau + ...,   r_2' = c r_2 - s r_1 = (c m_2 - s m_1) .
 * (...)
 *
 * So however many there are, one square with the torque is left, whose gradient is as long as the
 * node's window, and a form of q, qd and qdd, which depend on the control points of the coordinate
 * alone. A turn cancels nothing: the squares that are left are sums of what was there.
 *
 * (tau * torque + motion . (q, qd, qdd))^2 + the form of q, qd and qdd with the lower triangle
 * `light`, row by row; all zero: no square. */
typedef struct ambulo__joint_squares {
  double tau, motion[3], light[6];
} ambulo__joint_squares;

/* Adds (tau * torque + motion . (q, qd, qdd))^2. */
void ambulo__joint_squares_add(ambulo__joint_squares *s, double tau, const double motion[3]);
/* Lower triangle of the form `light` by the control points, row by row: form [span (span + 1) / 2].
 * 0: there is none. */
int ambulo__joint_squares_light(const ambulo__joint_squares *s, const ambulo__basis_point *point,
                                double *form);

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

/* H0 at the point of the workspace (ambulo__evaluate_jacobian), without mu. */
/* h += what the cones of friction (contact/curved.h) bend the Lagrangian by, of rows with the
 * multipliers lambda [rows->count], at the point of the last fill. */
void ambulo__metric_add_bends(ambulo__metric *metric, const ambulo_workspace *workspace,
                              const ambulo__sparse_rows *rows, const double *lambda,
                              ambulo__band *h);
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
