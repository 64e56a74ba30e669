/* method/parameters.h - every constant of the method, by what it governs. */
#ifndef AMBULO_METHOD_PARAMETERS_H
#define AMBULO_METHOD_PARAMETERS_H

/* ---- damping of the model step (auglag.c) */

#define AMBULO__DAMPING_START 0.3
#define AMBULO__DAMPING_START_DIFFERENCES 0.06
#define AMBULO__DAMPING_CARRIED 0.25
#define AMBULO__DAMPING_LEAST 0.03
#define AMBULO__DAMPING_LARGEST 3.0
#define AMBULO__DAMPING_CHANGE 2.0
#define AMBULO__DAMPING_LOWER_ALL 1.5
#define AMBULO__DAMPING_LOWER_STEP 0.5
#define AMBULO__DAMPING_RAISE_STEP 0.1
#define AMBULO__DAMPING_RAISE 10.0
#define AMBULO__DAMPING_RAISES 6
#define AMBULO__RESTORE_DAMPING 10.0

/* ---- penalty on the inequalities */

#define AMBULO__PENALTY_START 10.0
#define AMBULO__PENALTY_CARRIED 160.0
#define AMBULO__CARRIED_OBJECTIVE 2.0
#define AMBULO__PENALTY_GROWTH 2.0
#define AMBULO__PENALTY_LIMIT 3000.0
#define AMBULO__PENALTY_LIMIT_GROWTH 10.0
#define AMBULO__PENALTY_LAST 3e5
#define AMBULO__SCALE_LEAST 1e-11

/* ---- scales */

#define AMBULO__REFERENCE_CURVATURE 0.5
#define AMBULO__ACCELERATION_WEIGHT 1e-3

/* ---- one inner solve of NLopt */

#define AMBULO__INNER_EVALUATIONS 8
#define AMBULO__STORED_VECTORS 20
#define AMBULO__INNER_VALUE 1e-12
#define AMBULO__INNER_POINT 1e-14
#define AMBULO__GRADIENT_NONE 5e-6

/* ---- model step (model_step.c, chart.c) */

#define AMBULO__MODEL_STEPS 15
#define AMBULO__MODEL_FULL_STEPS 8
#define AMBULO__MODEL_SEARCH 20
#define AMBULO__MODEL_ENOUGH 1e-3
#define AMBULO__MODEL_EXACT 1e-8
#define AMBULO__MODEL_NEGLIGIBLE 1e-10
#define AMBULO__MODEL_LEVEL 1e-6
#define AMBULO__MODEL_WHOLE 1e-3
#define AMBULO__MODEL_GAIN_FLOOR 1e-12
#define AMBULO__MODEL_STEP_CAP 0.5
#define AMBULO__COSINE_LEAST 1e-4
#define AMBULO__USUAL_CAP 1.0
#define AMBULO__RANGE_CAP 2.0

/* ---- points on the surface and gradients along it (retraction.c) */

#define AMBULO__RETRACTION_TOLERANCE 1e-7
#define AMBULO__RETRACTION_SHARE 0.3
#define AMBULO__ROUNDING 1e-11
#define AMBULO__CHORD_STEPS 16
#define AMBULO__CHORD_PATIENCE 4
#define AMBULO__CHORD_GROWTH 10.0
#define AMBULO__WILD_STEP 3.0
#define AMBULO__ADJOINT_TOLERANCE 1e-3
#define AMBULO__ADJOINT_SHARPEN 0.1
#define AMBULO__ADJOINT_LEAST 1e-6
#define AMBULO__ADJOINT_FLOOR 1e-7
#define AMBULO__ADJOINT_PASSES 14

/* ---- the way to the surface (restore.c) */

#define AMBULO__RESTORE_STEPS 60
#define AMBULO__RESTORE_HALVINGS 12
#define AMBULO__RESTORE_STEP_CAP 0.3
#define AMBULO__RESTORE_TARGET 1e-9
#define AMBULO__RESTORED 1e-6

/* ---- when it is done (stopping.c) */

#define AMBULO__STALL 15
#define AMBULO__SETTLED 3
#define AMBULO__VALUE_CHANGE 1e-5
#define AMBULO__VALUE_FLOOR 1e-9
#define AMBULO__VALUE_MOVING 1e-3
#define AMBULO__VIOLATION_BETTER 0.9
#define AMBULO__VIOLATION_HALVED 0.5
#define AMBULO__GRADIENT_SMALL 3e-5
#define AMBULO__NEAR_VIOLATION 1e-5
#define AMBULO__POLISH_LAST_REACH 1e-2
#define AMBULO__VANISHED 1e-3
#define AMBULO__VANISHED_AT_REST 1e-6
#define AMBULO__COARSE_VIOLATION 1e-3
#define AMBULO__COARSE_CHANGE 1e-3

/* ---- polishing (polish.c) */

#define AMBULO__POLISH_STEPS 6
#define AMBULO__POLISH_PENALTY 1e7
#define AMBULO__POLISH_SHARE 0.2

/* ---- coarse grids (refine.c) */

#define AMBULO__COARSE_INTERVALS 24
#define AMBULO__COARSEST_INTERVALS 8

/* ---- rough starts (smooth.c) */

#define AMBULO__ROUGH_DEVIATION 0.02
#define AMBULO__ROUGH_ACCELERATION 30.0
#define AMBULO__ROUGH_KEPT 0.5

/* ---- the finisher */

#define AMBULO__FINISHER_ROUNDS 3
#define AMBULO__FINISHER_EVALUATIONS 40
#define AMBULO__FINISHER_MARGIN 1e-2
#define AMBULO__FINISHER_ADJOINT 1e-8
#define AMBULO__FINISHER_RETRACTION 1e-11
#define AMBULO__FINISHER_ROW 1e-10
#define AMBULO__FINISHER_VALUE 1e-13
#define AMBULO__FINISHER_POINT 1e-13

/* ---- SLSQP on small problems (nlopt_whitened.c) */

#define AMBULO__ROUND_EVALUATIONS 300
#define AMBULO__ROUNDS_IDLE 5
#define AMBULO__ROUNDS_SETTLED 1e-8

/* ---- NLopt on the rows as they are (nlopt_direct.c, nlopt_plain.c) */

#define AMBULO__DIRECT_ROW 1e-9
#define AMBULO__DIRECT_VALUE 1e-11
#define AMBULO__DIRECT_POINT 1e-11
#define AMBULO__DIRECT_INNER 1e-9
#define AMBULO__DIRECT_MEMORY 4e9
#define AMBULO__DIRECT_FAILED_ROW 1e3
#define AMBULO__DIRECT_REACHED 0.1
#define AMBULO__REACH_CALLS 8
#define AMBULO__REACH_EVALUATIONS 120
#define AMBULO__CALL_EVALUATIONS 1500
#define AMBULO__PLAIN_SETTLED 1e-7

/* ---- dependent rows (presolve_rank.c) */

#define AMBULO__RANK_ALL_ROWS 200
#define AMBULO__RANK_SWEEPS 500
#define AMBULO__RANK_SHIFT 0.1
#define AMBULO__RANK_DEPENDENCE 1e-8
#define AMBULO__RANK_CONTRADICTION 1e-7

/* ---- clock (run.c) */

#define AMBULO__POLL_INTERVAL 0.1
#define AMBULO__GRACE_SHARE 0.1
#define AMBULO__GRACE_LEAST 0.25

#endif
