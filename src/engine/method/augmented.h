/* method/augmented.h - the function that NLopt's inner solver minimizes, and its last point. */
#ifndef AMBULO_METHOD_AUGMENTED_H
#define AMBULO_METHOD_AUGMENTED_H

#include "method/engine.h"

/* The last point, kept because objective and rows are asked for separately. */
typedef struct ambulo__last_point {
  ambulo__trial trial;
  double *w, *gradient; /* [n]: the point, whitened; the gradient by w */
  int is_there;         /* 0: none, or one around another iterate */
  int has_gradient;
  double ceiling; /* highest value since the iterate was set */
} ambulo__last_point;

ambulo_status ambulo__last_point_create(ambulo__engine *engine);
/* The iterate, its multipliers or the whitener are others: nothing is known around them. */
void ambulo__last_point_forget(ambulo__engine *engine);

/* Augmented Lagrangian at retract(x_k + L^-T w); the point in engine->last. gradient [n] may be
 * NULL. A point that cannot be reached, or where something is not finite, has a finite value above
 * that of the iterate. */
double ambulo__augmented(ambulo__engine *engine, const double *w, double *gradient);

/* the variables w that NLopt works on, and the points x that they stand for.
 *
 *     x = R( x_k + L^-T (1 + s a') (w - w_k) / t )
 *
 * x_k the iterate (an earlier point), w_k what NLopt calls it, R the retraction onto the equalities
 * (equalities.c), L L' the metric of the model step at x_k, t > 0 a factor. w_k stays x_k when the
 * chart is laid again, so NLopt's own point does not jump.
 *
 * s = L' d with d the model step, g the gradient of F in whitened coordinates at x_k. The factor
 * with
 *
 *     a = s / sqrt(-(g.s) |s|^2) - g / (g.s)
 *
 * is the one of the BFGS formula in product form (Brodlie, Gourlay & Greenstadt 1973) for which
 * (1 + s a')(1 + a s') (-g) = s: the first step of a quasi-Newton method that starts with the
 * identity, which is what NLopt's L-BFGS does, is the model step.
 *
 * Gradient: dF/dw = (1 + a s') g(x) / t with g(x) of augmented.c.
 */

typedef struct ambulo__chart {
  double *origin;   /* w_k, [n] */
  double *step;     /* s, [n]; zero where it is no descent */
  double *turn;     /* a, [n] */
  double *whitened; /* [n]: scratch, what augmented.c is given */
  double *gradient; /* [n]: g at x_k */
  double stretch;   /* t */
  double start;     /* F at x_k */
} ambulo__chart;

ambulo_status ambulo__chart_create(int n, ambulo__pool *pool, ambulo__chart *chart);

/* Lays the chart at the iterate, which NLopt calls w, after a model step whose result is in
 * engine->quadratic. 0 when F or its gradient is not to be had there, which the run remembers. */
int ambulo__chart_lay(ambulo__chart *chart, ambulo__engine *engine, const double *w,
                      double stretch);

/* F at NLopt's w, and gradient [n]; the point in engine->last. As ambulo__augmented. */
double ambulo__chart_value(ambulo__chart *chart, ambulo__engine *engine, const double *w,
                           double *gradient);
/* Gradient by NLopt's w of scale f + sum p v at the point in engine->last. scale, p and l as in
 * ambulo__reduced_gradient; zero where it is not finite. */
void ambulo__chart_gradient(const ambulo__chart *chart, ambulo__engine *engine, double scale,
                            const double *p, double *l, double *gradient);

#endif
