/* trajectory/basis.h - one linear map from unknowns to the motion at time nodes.
 *
 * The unknowns of a trajectory of d coordinates are n "control points" of d
 * numbers each, row-major: x[c * d + i]. At any time t a few neighbouring control
 * points determine the motion:
 *
 *     D^o q_i(t) = sum_{k < span} weight[o][k] x[(first + k) * d + i],   o = 0..2
 *
 * What a control point is depends on the discretization:
 *   B-spline (Eq. 23)            the control points of a clamped spline
 *   central difference (18-19)   node values q_-1 ... q_N+1 (one ghost at each end)
 *   cubic Hermite (20-22)        q_0, h qd_0, q_1, h qd_1, ... (h = node spacing, so
 *                                that all unknowns have the unit of q)
 */
#ifndef AMBULO_TRAJECTORY_BASIS_H
#define AMBULO_TRAJECTORY_BASIS_H

#include "base/alloc.h"

#define AMBULO__MAX_DEGREE 7
#define AMBULO__MAX_SPAN (AMBULO__MAX_DEGREE + 1)

typedef enum ambulo__basis_kind {
  AMBULO__BSPLINE,
  AMBULO__CENTRAL_DIFFERENCE,
  AMBULO__HERMITE
} ambulo__basis_kind;

/* The map at one time. Orders 0..2 (value, rate, acceleration) stand on control points
 * first .. first + span - 1, order 3 (jerk) on jerk_first .. jerk_first + jerk_span - 1:
 *
 *     D^3 q_i(t) = sum_{k < jerk_span} weight[3][k] x[(jerk_first + k) * d + i]
 *
 * The windows are kept apart because at a breakpoint of a cubic spline q, qd and qdd rest
 * on three control points while the jerk, which jumps there (its right-hand limit is
 * given; the left-hand one at the end), rests on four: a common window would widen every
 * band matrix for the sake of the jerk. Weights beyond a window are zero. jerk_span is 0
 * for central differences. */
typedef struct ambulo__basis_point {
  int first, span;
  int jerk_first, jerk_span;
  double weight[4][AMBULO__MAX_SPAN];
} ambulo__basis_point;

typedef struct ambulo__basis ambulo__basis;

/* degree 3..7 and intervals >= 1 for B-splines; knots (may be NULL: uniform) are
 * the intervals + 1 strictly increasing breakpoints from 0 to duration. For the
 * other two, degree and knots are ignored and intervals is the number N of time
 * intervals. Errors: E_ARGUMENT, E_MEMORY. */
ambulo_status ambulo__basis_create(ambulo__basis_kind kind, int degree, int intervals,
                                   double duration, const double *knots,
                                   const ambulo_allocator *allocator, ambulo__basis **basis);
void ambulo__basis_free(ambulo__basis *basis); /* accepts NULL */

ambulo__basis_kind ambulo__basis_get_kind(const ambulo__basis *basis);
int ambulo__basis_control_points(const ambulo__basis *basis);
int ambulo__basis_degree(const ambulo__basis *basis);
int ambulo__basis_intervals(const ambulo__basis *basis);
double ambulo__basis_duration(const ambulo__basis *basis);
const double *ambulo__basis_breakpoints(const ambulo__basis *basis); /* [intervals + 1] */
/* Largest span of any time (orders 0..3). */
int ambulo__basis_span(const ambulo__basis *basis);

/* The map at time t in [0, duration] (clamped to it; a breakpoint missed by rounding
 * counts as hit). Leading and trailing control points without weight (below 1e-14 of the
 * largest of each order) are trimmed. Between nodes, central differences blend the maps
 * of the two nodes linearly. */
void ambulo__basis_at(const ambulo__basis *basis, double t, ambulo__basis_point *point);

/* A representative time of control point c (Greville abscissa; node time), and
 * whether it stands for a value (1) or for a scaled rate (0, Hermite): what a
 * start that is linear in time needs. */
double ambulo__basis_abscissa(const ambulo__basis *basis, int c, int *is_value);

/* Carries unknowns from one basis to another on the same duration: exact when the
 * target contains the source (knot insertion), least squares in time otherwise. Central
 * differences are no functions of time: as a source they are read as the Hermite curve
 * through their node values and rates, as a target they take node values, with the ghost
 * nodes set so that the rates at both ends are kept.
 * x_from [n_from * d], x_to [n_to * d]. Errors: E_ARGUMENT (durations differ), E_MEMORY,
 * E_NUMERIC. */
ambulo_status ambulo__basis_transfer(const ambulo__basis *from, const double *x_from,
                                     const ambulo__basis *to, double *x_to, int d,
                                     const ambulo_allocator *allocator);

/* what each discretization supplies behind basis.h. */

typedef struct ambulo__basis_methods {
  int (*control_points)(int degree, int intervals);
  int (*span)(int degree, int intervals);
  /* The map at t, which lies in interval `interval` (t == breakpoint[interval] when it
   * stands on one). *point is cleared; all weights from point->first on, untrimmed. */
  void (*at)(const ambulo__basis *basis, int interval, double t, ambulo__basis_point *point);
  double (*abscissa)(const ambulo__basis *basis, int c, int *is_value);
} ambulo__basis_methods;

extern const ambulo__basis_methods ambulo__bspline_methods;
extern const ambulo__basis_methods ambulo__central_difference_methods;
extern const ambulo__basis_methods ambulo__hermite_methods;

struct ambulo__basis {
  ambulo_allocator allocator;
  const ambulo__basis_methods *methods;
  ambulo__basis_kind kind;
  int degree, intervals, control_points, span;
  double duration;     /* s */
  double *breakpoints; /* [intervals + 1], s */
  double *knots;       /* B-spline: clamped, [intervals + 1 + 2 degree]; NULL otherwise */
};

#endif
