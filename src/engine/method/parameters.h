/* method/parameters.h - every constant of the method, by what it governs.
 *
 * Each comes with its unit, the reason for its value, and what holds it there: (T) the test in
 * tests/method that fails when it is wrong; (x) the change of the work at half and at double the
 * value; (0) the change without it. Work was measured over the shipped problems, in iterations.
 * "Free" stands for less than 5 % of the iterations, every verdict the same and every objective to
 * 0.1 %. "Other minima": yardsticks have many local minima, and a change of the path ends in
 * another, better or worse, as often as not. All constants belong to the objective's scale
 * (REFERENCE_CURVATURE).
 *
 * Bounds that no value is sensitive to are derived from these: storage of L-BFGS from the
 * evaluations of an inner solve, bisections from the digits of a double, and so on. NLopt's own
 * constants stand in mirror.h.
 */
#ifndef AMBULO_METHOD_PARAMETERS_H
#define AMBULO_METHOD_PARAMETERS_H

#include "linear/parameters.h"

/* ------------------------------------- damping mu of the model step (trust.c, pipeline.c) */

/* mu at the start, times the time T/K of a control point; rad^-2 or m^-2 of scaled objective. x:
 * +11 %, +20 %. T: pipeline. */
#define AMBULO__DAMPING_START 0.3
/* Factor by which mu changes; with multipliers of a coarser grid it starts two factors lower. x:
 * +9 % at 1 (none), free at 4. 0 of the latter: +4 %. T: pipeline. */
#define AMBULO__DAMPING_CHANGE 2.0
/* Bounds of mu, times the one at the start. Least: H0 alone may be singular. Without the largest a
 * step that is too long takes 93 iterations for 65. T: pipeline (least). */
#define AMBULO__DAMPING_LARGEST 3.0
#define AMBULO__DAMPING_LEAST (AMBULO__DAMPING_LARGEST / 100.0)
/* Of the promised descent: an inner solve that brought more found the model too timid. x: +4 %,
 * +12 %. T: auglag. */
#define AMBULO__DAMPING_LOWER_ALL 1.5
/* The same: a model step that brought less was too bold. 0 (never): +50 iterations over 48
 * problems, 88 for 64 where equalities contradict. T: auglag (a hundredfold). */
#define AMBULO__DAMPING_RAISE_STEP 0.1
/* Times mu, in the metric of the way to the surface, which starts far away. x: +7 %, both; 0 (1):
 * +11 %. T: pipeline, model_step. */
#define AMBULO__RESTORE_DAMPING 10.0
/* Times mu, in the metric of polishing, which asks for a short step and not for a cheap one: it
 * keeps down what rounding makes of smooth motions on fine grids. */
#define AMBULO__POLISH_DAMPING (10.0 * AMBULO__RESTORE_DAMPING)

/* ------------------------------------------------ the metric H0 (metric.c, point.c) */

/* Of each diagonal element of the metric, added to it: a thousand roundings. Otherwise the
 * curvature of smooth motions on grids of thousands of intervals, (T/K)^4 of the diagonal, is
 * rounding of the factor. walker_2d_step on 640 intervals, KKT residual: 3e-5; 0: 6e-5, and it
 * stalls; 1e-11: 1e-4. T: auglag (a hundredfold). */
#define AMBULO__METRIC_ROUNDING 1e-13
/* Rad, m, and relative error of a reduced gradient: this times the optimality tolerance, or the
 * usual one where that is tighter. H0 is kept while no control point has moved by more since it was
 * filled in: at 0.01 the same points in as many iterations as with a new H0 each time, and whole
 * bodies take 26 to 34 % less time; 0.05: +15 % for walks; 0.1: +50 %. Gradients: 1e-3 free, +3 %
 * time. As usual with a tight tolerance: yardstick_12 with 1e-6 is only feasible. T: point
 * (double), sensitivities. */
#define AMBULO__METRIC_SHARE 10.0
#define AMBULO__USUAL_OPTIMALITY 1e-3
/* Mean curvature of an objective along qdd, per second, that the scale gives to every objective:
 * the one for which mu and R are meant. x: +18 %, +20 %. T: pipeline. */
#define AMBULO__REFERENCE_CURVATURE 0.5
/* s^4: curvature along qdd of the metric where no term has any. Small beside an objective, large
 * beside mu. Only problems without an objective have it. T: metric (0). */
#define AMBULO__ACCELERATION_WEIGHT 1e-3

/* --------------------------------------------------- penalty R on inequalities (pipeline.c) */

/* R at the start, scaled objective per (row unit)^2: weak, so that rows shape the motion late. x:
 * +7 %; double: yardstick_72 +1.2 % of the objective (other minima). T: pipeline. */
#define AMBULO__PENALTY_START 10.0
/* R with a coarser grid's multipliers, which a weak penalty would let drift. 0 (10): +19 %. T:
 * pipeline. */
#define AMBULO__PENALTY_COARSE (16.0 * AMBULO__PENALTY_START)
/* The same with those of a solution beside that is far: the objective there differs by BESIDE_FAR
 * of it or more; at most BESIDE_MOST times as much where it is close (pipeline.c). Iterations of 22
 * solves beside one (speed, length, mass, stature, grid), R = 80 for all: 338; double: 372; half:
 * 435; walk at +.1 % of speed, R = 80: 8, 160: 5, 640: 8; at +5 %: 10, 14, 26. T: pipeline. */
#define AMBULO__PENALTY_BESIDE (8.0 * AMBULO__PENALTY_START)
#define AMBULO__BESIDE_FAR 0.05
#define AMBULO__BESIDE_MOST 8.0
/* Least divisor of a row that is short in the metric, near a solution: such rows give way to a
 * larger penalty. The same solves: .1 385, 1 (none) about 500. walker_2d_step on 160 intervals,
 * whose end is looked at again: 30 iterations, 1: 80. From elsewhere the multipliers have still to
 * be found, and it gains nothing. T: pipeline; fine_grids. */
#define AMBULO__SHORT_ROW 0.3
/* Of the promised descent: an inner solve that brought less was short. Promises below GAIN_COUNTS
 * of f are rounding. SHORT_SOLVES in a row show that R is too stiff, where it is above
 * PENALTY_STIFF: it is divided by PENALTY_STEP. 29 problems, evaluations: 16306; 0 (never): 18511;
 * a quarter for a tenth: 18568; .3 for .5: 17314; 2 in a row: 16650; at most 1 fall for 3: 17882;
 * without a bound run_whole_body meets its limit. T: trust. */
#define AMBULO__GAIN_SHORT 0.5
#define AMBULO__GAIN_COUNTS 1e-5
#define AMBULO__SHORT_SOLVES 3
#define AMBULO__PENALTY_FALLS 3
#define AMBULO__PENALTY_STIFF (10.0 * AMBULO__PENALTY_START)
/* Times the coarse solution's objective: below, that grid had resolved the motion and its
 * multipliers are kept. 0 (never): +20 %; always: +19 %, yardstick_72 +2.5 % of the objective. T:
 * pipeline. */
#define AMBULO__COARSE_OBJECTIVE 2.0
/* Factor of R where NLopt raises its penalty. Half (no growth): 6 of 17 problems run into their
 * limits. Double: +8 %. T: pipeline. */
#define AMBULO__PENALTY_GROWTH 2.0
/* Bound of R, and R from a start that nearly satisfies the rows (a weaker one would let go of them,
 * and the solve would wander off into another valley). Beyond, rounding of the rows bends the
 * steps. Where rows do not give way the bound rises tenfold, at most twice. 0 (no rise): 150
 * iterations for 65 where a step is too long. T: stopping, all. */
#define AMBULO__PENALTY_LIMIT 3000.0
#define AMBULO__PENALTY_STEP 10.0
#define AMBULO__PENALTY_LAST (AMBULO__PENALTY_LIMIT * AMBULO__PENALTY_STEP * AMBULO__PENALTY_STEP)

/* ------------------------------------------------------ one inner solve of NLopt (auglag.c) */

/* Evaluations of L-BFGS between two model steps; it keeps as many pairs, so that it forgets none.
 * Half: +50 %, -14 % evaluations; double: +70 % evaluations, +31 % time. T: pipeline. */
#define AMBULO__INNER_EVALUATIONS 8
/* Relative change of the value that ends an inner solve: rounding. x: free. T: pipeline. */
#define AMBULO__INNER_VALUE 1e-12
/* Of the optimality tolerance: whitened gradient, of max(1, |f|), that is small; and a sixth of it,
 * which counts as zero: below a gradient's own accuracy line searches fail. x: free. T: stopping,
 * pipeline. */
#define AMBULO__GRADIENT_SMALL 0.03
#define AMBULO__GRADIENT_NONE (AMBULO__GRADIENT_SMALL / 6.0)

/* ------------------------------------------------------------- model step (model_step.c) */

/* Factorizations of one model. Half: run, hop and reach_standing are not solved; double: free. T:
 * model_step (0). */
#define AMBULO__MODEL_STEPS 15
/* Of the gain so far: what a step has to bring; where the minimum itself is wanted (stopping.c)
 * HALF_DIGITS. x: free. A first of 1e-2: +13 %. T: model_step (a hundredfold). */
#define AMBULO__MODEL_ENOUGH 1e-3
/* Of phi' at 0: slope that counts as zero along a step. x: free. */
#define AMBULO__MODEL_LEVEL 1e-6
/* Rad, m: largest change that a model step proposes; beyond, angles are not small. x: +10 %, +17 %;
 * double: yardstick_72 +1.0 % of the objective. T: augmented. */
#define AMBULO__MODEL_STEP_CAP 0.5

/* ------------------- the equalities' surface: getting there, points on it (equalities.c,
 * equalities.c) */

/* Newton steps from anywhere. Shipped problems need fewer than 30. T: equalities. */
#define AMBULO__RESTORE_STEPS 60
/* Rad, m: largest change in one step. x: +4 %, +5 %, yardstick_72 +0.7 % of the objective. T:
 * equalities. */
#define AMBULO__RESTORE_STEP_CAP 0.3
/* Worst equality, relative to the rows' sizes, that the method starts from; Newton's last step
 * passes it and a thousandth of it, where it stops. T: equalities; smooth. */
#define AMBULO__RESTORED 1e-6
#define AMBULO__RESTORE_TARGET 1e-9
/* Of the feasibility tolerance, at most RESTORED: worst equality of a retracted point. x: free. 0:
 * walk_normal with 1e-9 is called infeasible. T: equalities, pipeline. */
#define AMBULO__RETRACTION_SHARE 0.1
/* Steps of an inner loop: chords to a point, of which a step of L-BFGS that takes more is too long;
 * passes of a gradient; halvings of a step. Half: +27 %; double: free. T: equalities. */
#define AMBULO__INNER_STEPS 16

/* --------------------------------------------------------- when it is done (stopping.c) */

/* Points at the bound of the penalty without progress. 0 (never): 150 iterations for 65 where a
 * step is too long. T: stopping. */
#define AMBULO__STALL 15
/* Points without a change that end a solve whose gradient is not small, or do not move at all at
 * the bound of the penalty, which then rises (run at 3.03 m/s beside 3: 142 iterations, 114);
 * points without progress that show that a coarse grid has no room for the rows, which is then
 * left, and its multipliers with it (2554 iterations over 48 problems; never: 3127); calls of NLopt
 * without progress (slsqp.c). x: free. T: stopping, refine, slsqp. */
#define AMBULO__PATIENCE 6
/* Relative change of f that is none; a hundred times as much is progress. x: free. Never: a torque
 * that is too weak takes 50 iterations, not 150. T: stopping. */
#define AMBULO__VALUE_CHANGE 1e-5
#define AMBULO__VALUE_MOVING (100.0 * AMBULO__VALUE_CHANGE)
/* Share of the least violation so far that is progress. x: no change. T: stopping. */
#define AMBULO__VIOLATION_BETTER 0.9
/* Violation, relative to the rows' sizes, where f may settle and polishing may start. 0:
 * walk_normal with a tolerance of 1e-9 takes 39 iterations for 14. T: stopping, pipeline. */
#define AMBULO__NEAR_VIOLATION 1e-5
/* The same where nothing else helps, at a stall and at a limit; and what is enough on a coarse
 * grid. T: stopping, pipeline. */
#define AMBULO__ROUGH_VIOLATION 1e-2
/* Of the first f: an objective that goes to zero (besides engine.c's measure); of f for the
 * motionless body, for terms without a measure of their own. T: stopping, both. */
#define AMBULO__VANISHED 1e-3
#define AMBULO__VANISHED_AT_REST 1e-6
/* Relative change of f that is enough on a coarse grid. 1e-3: +8 %; 1e-1 ends yardstick_72 11 %
 * higher, 1e-2 in three minima of it as rounding has it. 0 (as on the last): +47 %. T: stopping. */
#define AMBULO__COARSE_CHANGE 3e-3
/* Whitened gradient, of max(1, |f|), that is enough on a coarse grid: its metric foresees that half
 * a hundredth of f is still to be had, COARSE_CHANGE about twice. A change alone is small by
 * chance: without this test rounding chose between 1.95, 1.97 and 2.26 for run at 4 m/s. 0.05,
 * 0.03: +22 %, +31 %. T: stopping. */
#define AMBULO__COARSE_GRADIENT 0.1

/* -------------------------------------------------------------- polishing (stopping.c) */

/* Newton steps. 0: +5 %, and walk_normal with a tolerance of 1e-9 is called infeasible. T: pipeline
 * (0). */
#define AMBULO__POLISH_STEPS 6
/* Penalty of its model on rows of length 1 in the metric's diagonal, at first; each step takes
 * PENALTY_STEP times as much: rows are not forced where it costs most unless nothing less helps. T:
 * pipeline (0; 1e-1; 1). */
#define AMBULO__POLISH_PENALTY 1e2
/* Of what the multipliers say that the objective rises by, besides VALUE_CHANGE: more is another
 * motion. T: pipeline. */
#define AMBULO__POLISH_RISE 3.0

/* -------------------------------------------------------------- coarse grids (refine.c) */

/* Intervals from which a grid has a coarser one, and that this has where it can; a third of it are
 * the fewest. x: +20 %, +10 %; double of the fewest: +23 %. 0 (none): +12 %, +41 % time. T:
 * pipeline (0); refine. */
#define AMBULO__COARSE_INTERVALS 24
#define AMBULO__COARSEST_INTERVALS (AMBULO__COARSE_INTERVALS / 3)
/* Intervals of a coarse grid for each knot interval that its trajectory keeps. Over 33 problems,
 * 1030 iterations; 1: +30 %; 3: +4 %; in proportion: +62 %. T: refine. */
#define AMBULO__COARSE_NODES_A_KNOT 2

/* --------------------------------------------- rows between bodies (near.c, row_roles.c) */

/* m: rows between bodies with at most this value are worked with; in half: other minima; double:
 * +9 % for walks, and lift takes 8000 evaluations. T: near. */
#define AMBULO__NEAR_ROWS 0.02
/* m: what a solve that begins has to see of a far row to take it in. T: near. */
#define AMBULO__NEAR_SEEN 0.003
/* How often rows join at an end. Shipped problems need one or two. T: near (0). */
#define AMBULO__NEAR_ROUNDS 4

/* --------------------------------------------------------------- rough starts (pipeline.c) */

/* Rad, m: what a start is off by; rad/s^2, m/s^2: accelerations of a swinging leg. Together a
 * low-pass of 6 Hz (pipeline.c). T: smooth, both. */
#define AMBULO__ROUGH_DEVIATION 0.02
#define AMBULO__ROUGH_ACCELERATION 30.0

/* ----------------------------------------------- every row handed to NLopt (slsqp.c) */

/* Evaluations of a call of SLSQP: more than any needs (walker_2d_step 130). */
#define AMBULO__CALL_EVALUATIONS 1500
/* Bytes: dense work of SLSQP beyond which a problem is refused. */
#define AMBULO__DIRECT_MEMORY 4e9

/* ------------------------------------------------------ dependent rows (row_roles.c) */

/* Cyclic projections onto border rows. x: no change. */
#define AMBULO__RANK_SWEEPS 500
/* Rad, m: distance of the generic point from the start. x: no change. */
#define AMBULO__RANK_SHIFT 0.1
/* Row unit, of 1 + |value|: values of dependent rows that contradict: a microradian does, rounding
 * does not. T: row_roles (0). */
#define AMBULO__RANK_CONTRADICTION 1e-7

/* ------------------------------------------------------------------------- clock (run.c) */

/* s: how often a caller is asked during work without numbers. */
#define AMBULO__POLL_INTERVAL 0.1
/* After a stop, of the time used, and s: to say what was found. T: run. */
#define AMBULO__GRACE_SHARE 0.1
#define AMBULO__GRACE_LEAST 0.25

#endif
