/* method/parameters.h - every constant of the method, by what it governs.
 *
 * Each with its unit, why it is what it is, and what holds it: the test in tests/method that goes
 * red when it is wrong by a hundred or far more, or zero (T), a measured change of the work at half
 * and at double the value (x), or without it (0). Measured over the 17 shipped problems that the
 * solver takes through AUGLAG or SLSQP (293 iterations, 2337 evaluations in all) or, for (0), over
 * 26: the same, central differences, tight tolerances, a finer grid and infeasible tasks. "Free"
 * stands for less than 5 % of the iterations, every verdict the same and every objective to 0.1 %;
 * not told each time are walk_tracking, walk_fast and fig5b_torque, which have second minima 0.12 %
 * lower, 0.14 % higher and 1.0 % lower and go there or not. "other minima": yardsticks have many
 * local minima, and a change of the path ends in another, better or worse, as often as not. All at
 * the objective's scale (REFERENCE_CURVATURE).
 *
 * What is no parameter stays where it is used: NLopt's own constants (mirror.h), sizes of blocks.
 */
#ifndef AMBULO_METHOD_PARAMETERS_H
#define AMBULO_METHOD_PARAMETERS_H

/* ------------------------ damping mu of the model step (auglag.c, pipeline.c) */

/* mu at the start, times the time T/K of a control point; rad^-2 or m^-2 of scaled objective. x:
 * +11 %, +20 % iterations. T: pipeline. */
#define AMBULO__DAMPING_START 0.3
/* The same with central differences: with 0.3 they take twice the iterations at N = 12 (20 to 43),
 * as many at 36 and three quarters at 72; objectives are 2 to 5 % lower (other minima). x: 16, 37,
 * 71 and 36, 65, 66 iterations for 20, 61, 83. T: pipeline. */
#define AMBULO__DAMPING_START_DIFFERENCES 0.06
/* times mu, from a coarser grid's solution: what is left is small. x: free. 0 (1): +4 % iterations,
 * +7 % evaluations. T: pipeline. */
#define AMBULO__DAMPING_CARRIED 0.25
/* bounds of mu, times the one at the start. Least: H0 alone may be singular. x, 0: free, both;
 * but without the largest a step that is too long takes 65 to 93 iterations. T: pipeline (least).
 */
#define AMBULO__DAMPING_LEAST 0.03
#define AMBULO__DAMPING_LARGEST 3.0
/* of each diagonal element of the metric, added to it: a thousand roundings. Else the curvature of
 * smooth motions on grids of thousands of intervals, (T/K)^4 of the diagonal, is rounding of the
 * factor. x: free. walker_2d_step on 640 intervals, KKT residual:
 * 3e-5; 0: 6e-5, and it stalls; 1e-11: 1e-4. T: auglag (a hundredfold). */
#define AMBULO__METRIC_ROUNDING 1e-13
/* rad, m: H0 is kept as it is while no control point has moved by more since it was filled in,
 * which is most of the work where there are many coordinates. Over 44 problems the same points in
 * as many iterations at 0.005 and 0.01; whole bodies take 26 to 34 % less time, walks 10 to 20. x:
 * free; 0.05: +15 % iterations of walks, yardstick_72 +2.8 % of the objective (other minima); 0.1:
 * +50 %. T: engine_point (double). */
#define AMBULO__METRIC_REACH 0.01
/* times an optimality tolerance that is tighter than usual: the same. 0 (as usual): walker_2d_step
 * with contacts that share and 1e-6 ends 0.5 % higher with a KKT residual of 8e-6, not 1e-7 (other
 * minima). T: sensitivities. */
#define AMBULO__METRIC_SHARE 10.0
/* factor by which mu changes. x: +9 % iterations at 1 (none), free at 4. T: pipeline. */
#define AMBULO__DAMPING_CHANGE 2.0
/* of the promised descent: an inner solve that brought more than this found the model too timid.
 * x: +4 %, +12 % iterations. T: auglag. */
#define AMBULO__DAMPING_LOWER_ALL 1.5
/* the same: a model step that brought less was too bold. x: no change; 0 (never): -3 % iterations
 * on shipped problems, 64 to 88 where equalities contradict. T: auglag (a hundredfold). */
#define AMBULO__DAMPING_RAISE_STEP 0.1
/* times mu, in the metric of the way to the surface (restore.c), which starts far away. x: +7 %
 * iterations, both; 0 (1): +11 %, yardstick_72 +2.8 % of the objective (other minima); a step that
 * is too long takes 65 to 79. T: pipeline, model_step. */
#define AMBULO__RESTORE_DAMPING 10.0

/* ------------------------ penalty R on inequalities (pipeline.c) */

/* R at the start, scaled objective per (row unit)^2: weak, so that rows shape the motion late.
 * x: +7 % iterations; double: yardstick_72 +1.2 % of the objective (other minima). T: pipeline. */
#define AMBULO__PENALTY_START 10.0
/* R with a coarser grid's multipliers, which a weak penalty would let drift. x: free.
 * 0 (10): +19 % iterations. T: pipeline. */
#define AMBULO__PENALTY_CARRIED 160.0
/* times the coarse solution's objective: below, that grid had resolved the motion and its
 * multipliers are kept. 0 (never): +20 % iterations; always: +19 %, yardstick_72 +2.5 % of the
 * objective. T: pipeline. */
#define AMBULO__CARRIED_OBJECTIVE 2.0
/* factor of R where NLopt raises its penalty. Half (no growth): 6 of 17 problems run into
 * their limits. Double: +8 % iterations, yardstick_72 +0.6 % of the objective. T: pipeline. */
#define AMBULO__PENALTY_GROWTH 2.0
/* bound of R, and R from a start that nearly satisfies the rows (a weaker one would let go of them,
 * and the solve would wander off into another valley). Beyond, steps are bent by rounding of the
 * rows. x: free. T: stopping. */
#define AMBULO__PENALTY_LIMIT 3000.0
/* where rows do not give way the bound rises by this factor, up to the last. x: free; 0 (no rise):
 * 65 to 150 iterations for a step that is too long. T: stopping, both. */
#define AMBULO__PENALTY_LIMIT_GROWTH 10.0
#define AMBULO__PENALTY_LAST 3e5

/* -------------------------------------------------------------------------- scales (metric.c) */

/* mean curvature of an objective along qdd, per second, that the scale gives to every objective:
 * the one for which mu and R are meant. x: +18 %, +20 % iterations. T: pipeline. */
#define AMBULO__REFERENCE_CURVATURE 0.5
/* s^4: curvature along qdd of the metric where no term has any. Small beside an objective, large
 * beside mu. x: free, a hundredfold too; only problems without an objective have it. T:
 * metric (0). */
#define AMBULO__ACCELERATION_WEIGHT 1e-3

/* -------------------------------------------------------------- one inner solve of NLopt
 * (auglag.c) */

/* evaluations of L-BFGS between two model steps. Half: +50 % iterations, -14 % evaluations,
 * yardstick_72 +2 % of the objective; double: +70 % evaluations, +31 % CPU. T: pipeline. */
#define AMBULO__INNER_EVALUATIONS 8
/* pairs that L-BFGS keeps, here and in direct.c: more than an inner solve has evaluations, so
 * that it forgets none; n doubles each. x: no change. T: pipeline (1). */
#define AMBULO__STORED_VECTORS 20
/* relative change of the value that ends an inner solve: rounding. x: free. T: pipeline. */
#define AMBULO__INNER_VALUE 1e-12
/* the same that counts as zero: below the gradient's own accuracy line searches fail. x: free; 0:
 * +2 % evaluations. T: pipeline. */
#define AMBULO__GRADIENT_NONE (AMBULO__GRADIENT_SMALL / 6.0)

/* --------------------------------------------------------- model step (model_step.c, chart.c) */

/* factorizations of one model. x: +5 % iterations, no change. T: model_step (0). */
#define AMBULO__MODEL_STEPS 15
/* Newton steps of a line search, each a bisection at least: 2^-20 of the step. x: no change.
 * T: model_step (0). */
#define AMBULO__MODEL_SEARCH 20
/* of the gain so far: what a step has to bring; roughly, and where the minimum itself is wanted
 * (polish.c), whose value is then known to rounding. x: free; no change. A first of 1e-2:
 * +13 % iterations. T: model_step, both (a hundredfold; 1e-3). */
#define AMBULO__MODEL_ENOUGH 1e-3
#define AMBULO__MODEL_EXACT 1e-8
/* of phi' at 0: slope that counts as zero along a step. x, 0: free. */
#define AMBULO__MODEL_LEVEL 1e-6
/* rad, m: largest change that a model step proposes; beyond, angles are not small.
 * x: +10 %, +17 % iterations; double: yardstick_72 +1.0 % of the objective. T: chart. */
#define AMBULO__MODEL_STEP_CAP 0.5
/* rad, m: unit of step caps, which the caps here are multiples of. x: +10 %, +16 % iterations;
 * half: yardstick_72 +2 % of the objective. T: chart, restore. */
#define AMBULO__USUAL_CAP 1.0
/* a translation with a wide range may move by this multiple of it. x: no change. T: engine. */
#define AMBULO__RANGE_CAP 2.0

/* -------------------------------- points on the surface and gradients along it (retraction.c) */

/* worst equality of a retracted point, relative to the rows' sizes: a tenth of the usual
 * feasibility tolerance. x: free. T: retraction. */
#define AMBULO__RETRACTION_TOLERANCE 1e-7
/* of a feasibility tolerance that is tighter. 0: walk_normal with 1e-9 is called infeasible.
 * T: pipeline. */
#define AMBULO__RETRACTION_SHARE 0.3
/* error, relative to the rows' sizes, that may be all rounding: then a point that gets no better is
 * reached. Only tolerances near it meet this (0: no change).
 * T: retraction (0). */
#define AMBULO__ROUNDING 1e-11
/* chord steps to a point; a step of L-BFGS that takes more is too long. Half: +27 % iterations;
 * double: free. T: retraction. */
#define AMBULO__CHORD_STEPS 16
/* relative error of a reduced gradient, in the metric, as foretold from the last change. x: free.
 * 1e-3: free, +3 % CPU; 1e-1: free, but walk_without_reaction with a tolerance of 1e-9 ends with a
 * KKT residual of 3e-4, not 6e-6. */
#define AMBULO__ADJOINT_TOLERANCE 1e-2
/* times an optimality tolerance that is tighter than usual: the same. 0 (never): yardstick_12 with
 * 1e-6 is only feasible. T: sensitivities. */
#define AMBULO__ADJOINT_SHARE 100.0
/* passes of a gradient. x: free. T: retraction (no end). */
#define AMBULO__ADJOINT_PASSES 14

/* ------------------------ the way to the surface (restore.c) */

/* Newton steps from anywhere. Shipped problems need fewer than 30 (x: no change). T: restore. */
#define AMBULO__RESTORE_STEPS 60
/* halvings of a step into values that are not finite. Only functions of the caller have such (0: no
 * change); 2^-12 of 0.3 rad. T: restore. */
#define AMBULO__RESTORE_HALVINGS 12
/* rad, m: largest change in one step. x: +4 %, +5 % iterations, yardstick_72 +0.7 % of the
 * objective. 0: yardstick_36 with central differences 61 to 98 iterations, +5 % of the objective
 * (other minima). T: restore. */
#define AMBULO__RESTORE_STEP_CAP 0.3
/* worst equality, relative to the rows' sizes: where it stops, and what the method then takes, here
 * and after smoothing. Newton's last step passes both. x: no change. T: restore; smooth (1e-11). */
#define AMBULO__RESTORE_TARGET 1e-9
#define AMBULO__RESTORED 1e-6

/* -------------------------------------------------------------- when it is done (stopping.c) */

/* points at the bound of the penalty without progress. 0 (never): 65 to 150 iterations for a step
 * that is too long. T: stopping. */
#define AMBULO__STALL 15
/* points without a change that end a solve whose gradient is not small. x: free. T: stopping. */
#define AMBULO__SETTLED 6
/* relative change of f that is none. x: free. T: stopping. */
#define AMBULO__VALUE_CHANGE 1e-5
/* relative change of f that is progress. x: no change. Never: a step that is too long takes 57
 * iterations, not 65, a torque that is too weak 50, not 150. T: stopping. */
#define AMBULO__VALUE_MOVING 1e-3
/* share of the least violation so far that is progress (here and in direct.c); and the one
 * that shows that rows give way. x: no change. T: stopping, both. */
#define AMBULO__VIOLATION_BETTER 0.9
#define AMBULO__VIOLATION_HALVED 0.5
/* of the optimality tolerance: whitened gradient, of max(1, |f|), that is small. x: free. T:
 * stopping. */
#define AMBULO__GRADIENT_SMALL 0.03
/* violation, relative to the rows' sizes, where f may settle and polishing may start.
 * 0: walk_normal with a tolerance of 1e-9 takes 14 to 39 iterations.
 * T: stopping, pipeline. */
#define AMBULO__NEAR_VIOLATION 1e-5
/* the same, where nothing else helps: at a stall and at a limit. 0: no change where there is time.
 * T: stopping, pipeline. */
#define AMBULO__POLISH_LAST_REACH 1e-2
/* of the first f: an objective that goes to zero (besides engine.c's measure). T: stopping. */
#define AMBULO__VANISHED 1e-3
/* of f for the motionless body: the same, for terms without a measure of their own. 0: no
 * change on shipped problems. T: stopping. */
#define AMBULO__VANISHED_AT_REST 1e-6
/* violation and relative change of f that are enough on a coarse grid. Of the change 1e-3: +8 %
 * iterations; 1e-1 ends yardstick_72 11 % higher, 1e-2 in three minima of it as rounding has it (up
 * to 1.5 % higher; 3e-3: the same one in 8 of 8), but takes 47 iterations on 1152 intervals,
 * not 65. 0 (as on the last): +31 %, +47 % iterations. T: stopping. */
#define AMBULO__COARSE_VIOLATION 1e-2
#define AMBULO__COARSE_CHANGE 3e-3

/* whitened gradient, of max(1, |f|), on a coarse grid: its metric foresees that half a hundredth of
 * f is still to be had, COARSE_CHANGE about twice. A change alone is small by chance: without this
 * rounding chose between 1.95, 1.97 and 2.26 for run at 4 m/s. Seven speeds of it on three
 * instruction sets: without -7 % iterations; 0.05, 0.03: +22 %, +31 %. T: stopping. */
#define AMBULO__COARSE_GRADIENT 0.1
/* points at the bound of the penalty without progress, or without half the violation, that show
 * that a coarse grid has no room for the rows: it is left, and its multipliers with it. Over the 48
 * shipped problems, before COARSE_GRADIENT: 2554 iterations; never: 3127 (reach_standing 403 for
 * 37, squat_whole_body 157 for 63, jump 261 for 148 and 2.6 % higher, the others as they are).
 * T: stopping, refine. */
#define AMBULO__COARSE_STALL 6

/* ------------------------------------------------------------------------ polishing (polish.c) */

/* Newton steps. 0: +5 % iterations, and walk_normal with a tolerance of 1e-9 is called infeasible.
 * T: pipeline (0). */
#define AMBULO__POLISH_STEPS 6
/* penalty of its model on rows of length 1 in the metric's diagonal, at first and its growth with
 * each step, to the last: rows are not forced where it costs most unless nothing less helps. 1e3 at
 * first, growth of 10: free. T: pipeline (0; 1e-1; 1). */
#define AMBULO__POLISH_PENALTY 1e2
#define AMBULO__POLISH_GROWTH 10.0
/* of what the multipliers say that the objective rises by, besides VALUE_CHANGE: more is another
 * motion. 0 (any rise): no change. T: pipeline. */
#define AMBULO__POLISH_RISE 3.0
/* times mu, in its metric, which asks for a short step and not for one that costs little: what
 * rounding makes of smooth motions on fine grids is kept down. x, 1, 1e4: free up to 144
 * intervals. */
#define AMBULO__POLISH_DAMPING 100.0

/* -------------------------------------------------------------------- coarse grids (refine.c) */

/* intervals from which a grid has a coarser one, and that this has where it can; and the fewest. x:
 * +20 %, +10 % iterations; double of the fewest: +23 %; yardstick_36 +2 % of the objective or
 * yardstick_72 +18 %. 0 (none): +12 % iterations, +41 % CPU. T: pipeline (0); refine. */
#define AMBULO__COARSE_INTERVALS 24
#define AMBULO__COARSEST_INTERVALS 8
/* intervals of a coarse grid for each knot interval that its trajectory keeps. Over 33 problems
 * of an earlier version, 1030 iterations; 1: +30 %; 3: +4 %; in proportion: +62 %
 * (sit_to_stand 509 for 52, walk_stop 112 for 42). T: refine. */
#define AMBULO__COARSE_NODES_A_KNOT 2

/* -------------------------------------------------------------------- rough starts (smooth.c) */

/* rad, m: what a start is off by; rad/s^2, m/s^2: accelerations of a swinging leg. Together a
 * low-pass of 6 Hz (smooth.c). T: smooth, both. */
#define AMBULO__ROUGH_DEVIATION 0.02
#define AMBULO__ROUGH_ACCELERATION 30.0
/* of the squared accelerations: what a start that is not rough keeps. 0 (never smooth):
 * walk_tracking from noise of 0.2 rad takes 29 to 188 iterations. T: smooth. */
#define AMBULO__ROUGH_KEPT 0.5

/* ------------------------------------------- every row handed to NLopt (direct.c) */

/* evaluations of a call of SLSQP: more than any needs (plain walker_2d_step 880 in all). */
#define AMBULO__CALL_EVALUATIONS 1500
/* calls and evaluations of each that carry a plain start onto the rows. x: no change. */
#define AMBULO__REACH_CALLS 8
#define AMBULO__REACH_EVALUATIONS 120
/* calls without progress. x: -2 %, +1 % iterations of an infeasible task. T: direct (never). */
#define AMBULO__CALLS_IDLE 5
/* relative change of the objective that ends calls. x: no change. */
#define AMBULO__CALLS_SETTLED 1e-8
/* given to NLopt: relative, of value and point; of scaled rows, and of AUGLAG's inner solver in
 * both senses. x: free. */
#define AMBULO__DIRECT_TOLERANCE 1e-11
#define AMBULO__DIRECT_ROW 1e-9
/* bytes: dense work of SLSQP beyond which a problem is refused. */
#define AMBULO__DIRECT_MEMORY 4e9

/* ---------------------------------------------------------- dependent rows (presolve_rank.c) */

/* unknowns up to which all rows are one group. */
#define AMBULO__RANK_ALL_ROWS 200
/* cyclic projections onto border rows. x: no change. */
#define AMBULO__RANK_SWEEPS 500
/* rad, m: distance of the generic point from the start. x: no change. */
#define AMBULO__RANK_SHIFT 0.1
/* of a row's gradient: what is left of it after the others are taken off. x: no change. T:
 * presolve_rank (0). */
#define AMBULO__RANK_DEPENDENCE 1e-8
/* row unit, of 1 + |value|: values of dependent rows that contradict: a microradian does,
 * rounding does not. T: presolve_rank (0). */
#define AMBULO__RANK_CONTRADICTION 1e-7

/* -------------------------------------------------------------------------------- clock (run.c) */

/* s: how often a caller is asked during work without numbers. */
#define AMBULO__POLL_INTERVAL 0.1
/* after a stop, of the time used, and s: to say what was found. T: run. */
#define AMBULO__GRACE_SHARE 0.1
#define AMBULO__GRACE_LEAST 0.25

#endif
