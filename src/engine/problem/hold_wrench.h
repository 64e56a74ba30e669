/* problem/hold_wrench.h - what hands hold, in the evaluation of a block of nodes and in its
 * derivatives.
 *
 * The kernels know the bodies alone. What is held comes to them as a wrench that the contacts must
 * supply too (ambulo__plan_take_wrench), and its way along the arms is added behind them:
 *
 *     begin     kept of each node, wrench for the kernels
 *     (kernels: outputs or forward)
 *     end       torques along the arms; without ground reaction the root wrench
 *     (kernels: reverse)
 *     reverse   gradient by q, qd and qdd
 *
 * All do nothing where nothing is held. `room` has ambulo__device_scratch_size(problem) doubles. */
#ifndef AMBULO_PROBLEM_HOLD_WRENCH_H
#define AMBULO_PROBLEM_HOLD_WRENCH_H

#include "problem/nlp.h"

/* channel: of a block, q, qd, qdd and the outputs; factors: of the block, its devices too. */
void ambulo__hold_wrench_begin(const ambulo_problem *problem, const double *factors,
                               const double *channel, double *scratch, double *room);
void ambulo__hold_wrench_end(const ambulo_problem *problem, double *channel, const double *room);
/* weight: adjoints of the block's channels, to whose q, qd and qdd the gradient is added. */
void ambulo__hold_wrench_reverse(const ambulo_problem *problem, double *weight,
                                 const double *scratch, const double *room);

/* After the Jacobians of a block: what is held is kept for each of its nodes, and its part of the
 * root wrench's rows added to workspace->wrench, the bodies' own force by qdd kept for the centre
 * of mass. */
void ambulo__hold_wrench_gather(ambulo_workspace *workspace, int block);
/* Adds what is held to the gradient [3][d] of a torque, and without ground reaction of a row of the
 * root wrench. */
void ambulo__hold_wrench_add_output(const ambulo_workspace *workspace, int node, int output,
                                    double *gradient);

#endif
