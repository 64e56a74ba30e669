/* method/mirror.h - what NLopt's AUGLAG makes of the rows that it is given.
 *
 * NLopt keeps multipliers and penalty to itself. Both follow from the values that it was given
 * (Birgin & Martinez 2008, algorithm 3.1; NLopt 2.7.1, algs/auglag/auglag.c), for rows c <= 0 with
 * multipliers nu (mu in NLopt and in the paper; here mu is the damping):
 *
 *     at the start             rho = max(1e-6, min(10, 2 |f| / sum max(0, c)^2)),  nu = 0,  I = inf
 *     after every inner solve  I' = max |max(c, -nu / rho)|,  nu <- max(0, nu + rho c),
 *                              rho <- 10 rho where I' > I / 2
 *
 * Every operation stands in NLopt's order, so that the numbers are NLopt's to the last bit
 * (tests/method/test_mirror.c, which sees NLopt's own). They are needed to whiten with the rows
 * that are going to be active, to lower the scale S where rho grows, and to pool gradients:
 *
 * NLopt adds to the objective's gradient each row's, times its force rho c + nu. That sum is one
 * reverse sweep, each gradient alone would be one too, and for each row with a force, however many
 * zeros its gradient has, NLopt adds n numbers: work in proportion to the square of the intervals.
 * So where NLopt asks for gradients one row stands for all, the one with the largest force: its
 * force is the root of the sum of squares, which is what they add to the value, its gradient the
 * sum, divided by that force; the others say that they hold.
 *
 * Another NLopt may do otherwise. Then its first step of an inner solve tells: L-BFGS begins with
 * minus the gradient that NLopt has formed. Where that is not the gradient that the mirror says,
 * auglag.c gives each row its own gradient from then on.
 */
#ifndef AMBULO_METHOD_MIRROR_H
#define AMBULO_METHOD_MIRROR_H

#include "linear/pool.h"

/* NLopt's own constants, in its paper's letters where it has any: no parameters, facts. */
#define AMBULO__NLOPT_FIRST_PENALTY 10.0
#define AMBULO__NLOPT_LEAST_PENALTY 1e-6
#define AMBULO__NLOPT_GROWTH 10.0 /* gam */
#define AMBULO__NLOPT_ENOUGH 0.5  /* tau */
#define AMBULO__NLOPT_LARGEST_MULTIPLIER 1e20

typedef struct ambulo__mirror {
  int rows;
  double *multiplier; /* nu, [rows] */
  double penalty;     /* rho */
  double measure;     /* I, infeasibility and complementarity in one */
  int updates;        /* inner solves since the start */
} ambulo__mirror;

ambulo_status ambulo__mirror_create(int rows, ambulo__pool *pool, ambulo__mirror *mirror);
/* f and the rows [rows] as NLopt sees them where it starts. */
void ambulo__mirror_start(ambulo__mirror *mirror, double f, const double *row);
/* The rows where an inner solve ended. 1 when the penalty has grown. */
int ambulo__mirror_update(ambulo__mirror *mirror, const double *row);
/* Rewrites the rows where NLopt asks for gradients: `gradient` [n] is the sum of all rows'
 * gradients times their forces and the objective's. Returns the row that stands for all, `pooled`
 * its gradient; -1: no row has a force, the objective has it all. */
int ambulo__mirror_pool(const ambulo__mirror *mirror, double *row, unsigned n,
                        const double *gradient, double *pooled);
/* Whether NLopt's first step of an inner solve, from one point [n] to another, is minus this
 * gradient, but for rounding. */
int ambulo__mirror_agrees(unsigned n, const double *from, const double *to, const double *gradient);

/* nlopt_set_local_optimizer copies its argument (nlopt_copy) into one small block and three of n
 * doubles without looking at what malloc returns for them: without memory the process dies. 1 when
 * malloc has all four at once right now; what this function took is free again when it returns,
 * and the copy finds it. Asked right before each such call. */
int ambulo__nlopt_can_copy(unsigned n);

/* L-BFGS of n variables takes one block for `storage` steps and gradients at every inner solve.
 * Where there is none, NLopt silently descends along the gradient instead. 1 when malloc
 * has that, and the variables' two blocks before it, right now. Asked right before each inner
 * solve. */
int ambulo__nlopt_can_descend(unsigned n, unsigned storage);

#endif
