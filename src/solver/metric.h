/* solver/metric.h - the curvature of the objective as a banded matrix.
 *
 *     H0 = scale * H_GN + mu I   (+ a small metric of accelerations where H_GN is empty)
 *
 * H_GN = sum_k sum_y curvature_yk g_yk g_yk', y the channels that the objective's terms
 * stand on and g their gradients with respect to the unknowns of node k.
 */
#ifndef AMBULO_SOLVER_METRIC_H
#define AMBULO_SOLVER_METRIC_H

#include "solver/band.h"

typedef struct ambulo__metric {
  const ambulo_problem *problem;
  int channels;
  int *channel;          /* [channels]: those with a weight in some term, ascending */
  double *rows;          /* [channels][widest window]: one node's weighted gradients */
} ambulo__metric;

ambulo_status ambulo__metric_create(const ambulo_problem *problem, ambulo__pool *pool,
                                    ambulo__metric *metric);

/* Largest number of unknowns of a node, less one: kd of every matrix of the problem. */
int ambulo__metric_diagonals(const ambulo_problem *problem);

/* H0 at the point held (ambulo__evaluate_jacobian), without mu. */
void ambulo__metric_fill(const ambulo__metric *metric, const ambulo_workspace *workspace,
                         double scale, ambulo__band *h);

/* Factor by which the objective is multiplied inside the solver, a power of two, so that
 * the constants of the method (mu, rho) meet gradients of the size that they were found
 * for, whatever the objective's unit. */
double ambulo__metric_objective_scale(const ambulo__metric *metric,
                                      const ambulo_workspace *workspace);

#endif
