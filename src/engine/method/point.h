/* method/point.h - what the engine makes of the point that its workspace holds. */
#ifndef AMBULO_METHOD_POINT_H
#define AMBULO_METHOD_POINT_H

#include "method/engine.h"

/* Whether the objective is next to its lower bound, zero. */
int ambulo__engine_at_lower_bound(const ambulo__engine *engine);
/* Worst |h| and |C x - b|, relative to the sizes of the rows; fills engine->measured.equality and
 * border. */
double ambulo__engine_equality_error(ambulo__engine *engine);
/* Excesses [inequalities]; returns the worst relative to the size of its row (>= 0). */
double ambulo__engine_excess(const ambulo__engine *engine, double *excess);
/* Gradient of scale f + sum p v + sum l h, f not scaled (p, l may be NULL). E_NUMERIC: it is not
 * finite, which the run remembers. */
ambulo_status ambulo__engine_gradient(ambulo__engine *engine, double scale, const double *p,
                                      const double *l, double *gradient);
/* linearized.base = metric + mu I, the metric that of the point in the workspace or of one from
 * which no unknown has moved by more than the roughness. 1: it is not finite, which is reported
 * to the run. */
int ambulo__engine_fill_metric(ambulo__engine *engine, double mu);
/* Relative error of a reduced gradient, and change of an unknown since the metric was filled in,
 * that the optimality tolerance allows. */
double ambulo__engine_roughness(const ambulo__engine *engine);
/* Factor <= 1 that keeps a step below `part` of every coordinate's cap. */
double ambulo__step_limit(const ambulo__setup *setup, const double *step, double part);

#endif
