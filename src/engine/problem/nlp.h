/* problem/nlp.h - the inside of a problem and of a workspace; what the solver builds on.
 *
 * Unknowns x [control_points][d] row-major, so that the unknowns a node depends on
 * are contiguous: node k touches x[first_k * d .. (first_k + span_k) * d), the "local
 * unknowns" of the node; local index = (c - first_k) * d + i. All matrices built from
 * node rows are therefore banded.
 *
 * Rows (problem->rows) are in physical units, as in ambulo/problem.h:
 * equality c = 0, inequality c >= 0. A row whose terms all stand on one node is
 * "local"; the others (periodic, mirrored ends) are "border" rows; a row on unknowns
 * is a "variable" row and also kept as border.
 */
#ifndef AMBULO_PROBLEM_NLP_H
#define AMBULO_PROBLEM_NLP_H

#include "ambulo/solve.h"
#include "contact/devices.h"
#include "contact/row_families.h"
#include "contact/contacts.h"
#include "contact/schedule.h"
#include "mechanics/plan.h"
#include "problem/definition.h"
#include "problem/row_runs.h"
#include "problem/term.h"
#include "trajectory/basis.h"
#include "trajectory/lane_map.h"

/* Which keys the problem's file has, for advice in its words; all 0: the problem was made from C.
 */
typedef struct ambulo__problem_keys {
  int file;         /* it was read from a file */
  int terms;        /* of the objective that the file has */
  int gait;         /* the contacts come from `gait` */
  int steps;        /* of the gait */
  int unlike_steps; /* two step lengths or times that differ */
  int speed;        /* gait.speed is there: with it the step length decides on the duration */
  int travel;       /* ends.travel is there */
  int lengths;      /* gait.step_length is a list */
  int loads;        /* `load` is a list, and which items of it are on links */
  int load_item[AMBULO__MOST_LOADS], hold_item[AMBULO__MOST_LOADS]; /* and in hands */
  ambulo__gait_rule rule; /* what the keys of the gait say */
  ambulo_gait walk;       /* and what they come to */
  double radians;         /* per unit of `angles`; 0: not stated */
  int written_for;        /* numbers of the file are those of another body
                           * (definitions/problem_written_for.c)
                           */
  double longer, heavier; /* than that body: ratios of statures and masses; 1 without */
} ambulo__problem_keys;

struct ambulo__free_section;

struct ambulo_problem {
  ambulo_allocator allocator;
  ambulo_problem_definition definition; /* deep copy: every array belongs to the problem */
  ambulo_options file_options;          /* what the file asks of the solver; all 0: no file */
  ambulo_model *owned_model;            /* freed with the problem; NULL if the caller owns it */
  ambulo_muscles *owned_muscles;        /* likewise */
  ambulo_model
      *extended_model; /* `model` where capsules have rows (problem/queries.c); else NULL */
  ambulo__pairs pairs; /* what automatic collision came to; all 0 of a problem with others */
  char *inputs;        /* the files it was read from (formats/inputs.h); NULL: none, or a variant */
  char *obstacle_names; /* of the definition's obstacles, and of problems made from it */
  struct ambulo__free_section *free; /* one block (solver/free_trial.c); NULL: nothing is free */
  const ambulo_problem *extends;     /* what this one extends (problem/variants.c); NULL: none */
  const ambulo_model *model;
  ambulo__plan *plan;
  const ambulo__kernels *kernels;
  ambulo__basis *basis;
  ambulo__lane_map *map;
  ambulo__channels channels;
  ambulo__slots slots; /* of ground reaction; 0 without */
  int coordinates, control_points, variables;
  int nodes, blocks;
  double *times;      /* [nodes], s; not equally spaced in general */
  double *quadrature; /* [nodes], trapezoidal weights, s */
  double *lean;       /* [coordinates]: of rest postures (ambulo__lean), rad; NULL: on the level */
  int *active;        /* [nodes][feet] contact index or -1 */
  int *before;        /* [nodes][feet] just before the node; NULL but for grids on events */
  double
      *ground; /* [blocks][entries][8], problem/ground_reaction.c; NULL without ground reaction */
  ambulo__devices *devices; /* NULL without */
  ambulo__holds *holds;     /* NULL without */
  size_t taken_at;          /* of the kernels' scratch (ambulo__plan_take_wrench); 0: no contacts */
  double *time_factors; /* [blocks][devices and holds][8]: of profiles, clutches and holds at the
                           nodes (contact/devices.h); NULL without */
  ambulo__row_table table;
  ambulo__row_runs row_runs; /* the linear rows of the table, laid out for evaluation */
  int rows, equalities;
  ambulo__problem_keys keys;
  unsigned long long hash;
};

/* What the problem is without all that it was extended by. */
static inline const ambulo_problem *ambulo__problem_root(const ambulo_problem *problem) {
  while (problem->extends) problem = problem->extends;
  return problem;
}

enum { AMBULO__WORKSPACE_ARRAYS = 23 };

struct ambulo_workspace {
  ambulo_allocator allocator;
  double *owned[AMBULO__WORKSPACE_ARRAYS]; /* what is freed; the problem may be gone by then */
  const ambulo_problem *problem;
  int channel_count;
  double *x;                    /* [variables]: the point the rest belongs to */
  int has_values, has_jacobian; /* channels / channel Jacobians are those of x */
  double *channel;              /* [blocks][channels][8] */
  double *weight;               /* [blocks][channels][8]: adjoint of channel */
  double *term_slope;           /* [blocks][channels][8]: of the objective's terms, but for those of
                                   the caller, by channel; with has_values */
  double *gradient_lanes;       /* [3][d][8]: a block's gq, gqd, gqdd */
  double *scratch;              /* kernels' scratch, one block at a time */
  double *jq, *jqd, *jqdd;      /* [blocks][pattern entries][8] */
  double *row_value;            /* [rows] */
  double *term_value;           /* [terms] */
  double objective;
  double *user_gradient;  /* [user row instances][channels]: slopes of user rows */
  int *user_slot;         /* [rows]: index into user_gradient, or -1 */
  unsigned char *far;     /* [rows]: 1 of rows between bodies that are far apart (method/near.c) */
  int leaves_far_out;     /* values of these are not those of x, but earlier ones */
  double *node_state;     /* scratch for callbacks: [2][channels] */
  double *motion_scratch; /* ... for one gradient by q, qd, qdd: [3][d] */
  double *other_scratch;  /* ... for what devices and hands add to it */
  double *wrench[3];      /* [nodes][6][d]: gradients of the root wrench by q, qd and qdd; NULL
                             without ground reaction */
  double *device_scratch; /* ambulo__room; NULL without devices and holds */
  double *device_states;  /* [nodes][ambulo__devices_entries] */
  double *hold_states;    /* [nodes][ambulo__holds_entries] */
  double *bare_force;     /* [nodes][3][d]: of the bodies' own root force by qdd, where `wrench` has
                             what is held too; NULL without holds */
  struct ambulo__muscle_effort *muscles; /* NULL without a term of muscles */
  ambulo_fault fault;                    /* of the last E_NUMERIC */
  double *fault_scratch;                 /* [variables]: while it is looked for */
  long evaluations, jacobians;
  double seconds_evaluate;
};

/* Longest text of ambulo_fault_text. */
#define AMBULO__FAULT_TEXT 640

/* A workspace without room for Jacobians: values, gradients by reverse sweep, motions. E_MEMORY. */
ambulo_status ambulo__workspace_create_for_values(const ambulo_problem *problem,
                                                  const ambulo_allocator *allocator,
                                                  ambulo_workspace **workspace);

/* ------------------------------------------------------------- evaluation */

/* Channels, objective and rows at x; nothing if x is the point already held.
 * E_NUMERIC if a value is not finite (the workspace then holds no point; workspace->fault). */
ambulo_status ambulo__evaluate(ambulo_workspace *workspace, const double *x);
/* Also the channel Jacobians. */
ambulo_status ambulo__evaluate_jacobian(ambulo_workspace *workspace, const double *x);

/* The value of a term at the channels, without its weight; but for those of the caller, dvalue/dy
 * times `factor` is added to `slopes`, [blocks][channels][8]. */
double ambulo__term_value(ambulo_workspace *workspace, const ambulo_term *term, double factor,
                          double *slopes);

/* After ambulo__evaluate: gradient of objective_weight * J + sum_r weights[r] c_r. E_NUMERIC if an
 * entry is not finite (workspace->fault). */
ambulo_status ambulo__gradient(ambulo_workspace *workspace, double objective_weight,
                               const double *row_weights, double *gradient);

/* After ambulo__evaluate: gradient of one objective term (its weight included). E_NUMERIC. */
ambulo_status ambulo__term_gradient(ambulo_workspace *workspace, int term, double *gradient);

/* ---------------------------------------------- pieces of the reverse sweep (gradient.c) */

/* workspace->weight holds the adjoints dL/dy of the channels y. */
/* Adjoints and gradient [variables] to zero. */
void ambulo__adjoint_clear(ambulo_workspace *workspace, double *gradient);
/* Adds one term of the objective, times objective_weight. */
void ambulo__adjoint_term(ambulo_workspace *workspace, int term, double objective_weight);
/* Adds sum_r weights[r] c_r; what stands on unknowns goes to the gradient at once. */
void ambulo__adjoint_rows(ambulo_workspace *workspace, const double *row_weights, double *gradient);
/* Adds the mechanics' reverse sweep to the adjoints of q, qd, qdd of one block. */
void ambulo__adjoint_block(ambulo_workspace *workspace, int block);
/* Sets them to those of objective_weight times all terms, at a point that is evaluated, and the
 * gradient to zero. */
void ambulo__adjoint_begin(ambulo_workspace *workspace, double objective_weight, double *gradient);
/* From the adjoints of the channels to the gradient. */
void ambulo__adjoint_pull_back(ambulo_workspace *workspace, double *gradient);

/* ---------------------------------------- what is not finite, once seen (nonfinite.c) */

/* Which value or derivative it is: looking for it takes a few evaluations. These write
 * workspace->fault. */
/* After an evaluation with a row or an objective that is not finite. */
void ambulo__fault_of_values(ambulo_workspace *workspace);
/* After a gradient that is not finite; the arguments as in ambulo__gradient. */
void ambulo__fault_of_gradient(ambulo_workspace *workspace, double objective_weight,
                               const double *row_weights, const double *gradient);
/* second derivatives of the objective, sizes that are not finite */
void ambulo__fault_of_curvature(ambulo_workspace *workspace, double value);
void ambulo__fault_of_term_gradient(ambulo_workspace *workspace, int term, const double *gradient);
/* A row whose derivative by unknown `variable` is `value`. */
void ambulo__fault_of_row(ambulo_workspace *workspace, int row, int variable, double value);

/* ---------------------------------------------------------- ground reaction */

/* What the kernels need to know of the ground at `count` times, [blocks][entries][8]; freed with
 * ambulo__free_aligned. *ground is NULL without ground reaction. E_MEMORY. */
ambulo_status ambulo__ground_fill(const ambulo_problem *problem, const ambulo_allocator *allocator,
                                  const double *times, int count, double **ground);
/* What a foot or a patch is given: force, centre of pressure (NaN where the ground does not push),
 * moment about the normal there, moment about the world's origin; N, m, N m. */
typedef struct ambulo__pressure {
  double force[3], center[3], free_moment, moment[3];
} ambulo__pressure;
/* Of a foot or a patch (contact/contacts.h) where contacts share the load, at `time`, from the
 * channels of a node (`channel`: of the first, in the lanes). */
ambulo__pressure ambulo__contact_pressure(const ambulo_problem *problem,
                                          const ambulo__foot_outline *outlines, int effector,
                                          double time, const double *channel);
/* The entries of one block, NULL without ground reaction. */
static inline const double *ambulo__ground_block(const ambulo_problem *problem,
                                                 const double *ground, int block) {
  size_t entries = (size_t)ambulo__plan_ground_entries(problem->plan);
  return ground ? ground + (size_t)block * entries * AMBULO__LANES : NULL;
}

/* The outputs of a block of nodes from its q, qd and qdd, the first channels: inverse dynamics and
 * what the devices leave of it. `ground` and `factors` are the problem's or of other times; the
 * scratch is the kernels', the room of ambulo__room (may be NULL without devices and holds). */
void ambulo__mechanics_block(const ambulo_problem *problem, const double *ground,
                             const double *factors, int block, double *channel, double *scratch,
                             double *room);
size_t ambulo__device_scratch_size(const ambulo_problem *problem);
/* Factors by time, of devices and holds, at one time. */
static inline int ambulo__time_factor_entries(const ambulo_problem *problem) {
  return problem->channels.devices + problem->definition.hold_count;
}
/* A block of them; NULL without. */
static inline const double *ambulo__time_factor_block(const ambulo_problem *problem,
                                                      const double *factors, int block) {
  return factors ? factors +
                       (size_t)block * (size_t)ambulo__time_factor_entries(problem) * AMBULO__LANES
                 : NULL;
}

/* ------------------------------------------------------------- local rows */

/* Entries of workspace->wrench per node and order. */
int ambulo__wrench_entries(const ambulo_problem *problem);
/* Fills it for a block whose Jacobians are there. */
void ambulo__wrench_gather(ambulo_workspace *workspace, int block);
/* After ambulo__evaluate_jacobian: gradient[3][d] of an output of the mechanics
 * (mechanics/plan.h) at a node by q, qd and qdd. */
void ambulo__output_gradient(const ambulo_workspace *workspace, int node, int output,
                             double *gradient);
/* After ambulo__evaluate_jacobian: slopes[3][d] of a row by q, qd and qdd of its node (local rows
 * only). */
void ambulo__row_slopes(const ambulo_workspace *workspace, int row, double *slopes);
/* How many of q, qd and qdd a channel depends on: 1, q only, or 3. */
int ambulo__channel_orders(const ambulo_problem *problem, int channel);
/* Gradient of one channel at one node with respect to the node's local unknowns. */
void ambulo__channel_local_gradient(const ambulo_workspace *workspace, int node, int channel,
                                    double *gradient);
/* Gradient of any row added into a dense vector [variables], times `factor`. */
void ambulo__row_add_gradient(const ambulo_workspace *workspace, int row, double factor,
                              double *gradient);

/* The last node at or before `time` (within 1e-9 s), at most the last but one; with the node after
 * it, and the place between the two, 0 to 1. */
int ambulo__node_at(const ambulo_problem *problem, double time, double *between);

/* First local unknown of a node and their number. */
static inline int ambulo__node_first(const ambulo_problem *p, int node) {
  return ambulo__lane_map_points(p->map)[node].first * p->coordinates;
}
static inline int ambulo__node_width(const ambulo_problem *p, int node) {
  return ambulo__lane_map_points(p->map)[node].span * p->coordinates;
}
/* 1 if all terms of the row stand on one node. */
static inline int ambulo__row_is_local(const ambulo_problem *p, int row) {
  return p->table.rows[row].node >= 0;
}

/* ------------------------------------------------------------------- construction */

/* variants.c: unknowns x [variables] of a motion that rests in the model's start pose. */
void ambulo__start_pose(const ambulo_problem *problem, double *x);
/* The same problem on another grid: `intervals` time intervals and `spline_intervals`
 * intervals of the trajectory. Breakpoints of its own are kept only while their number
 * stays, and times of nodes of its own likewise: other numbers are distributed over the phases.
 * Tracked references are interpolated linearly. The model stays shared, so the
 * new problem must not outlive `problem`. */
ambulo_status ambulo__problem_with_grid(const ambulo_problem *problem, int intervals,
                                        int spline_intervals, const ambulo_allocator *allocator,
                                        ambulo_problem **out);
/* The same for a grid whose solution only starts the next: terms of many valleys are eased
 * (variants.c). */
ambulo_status ambulo__problem_coarser(const ambulo_problem *problem, int intervals,
                                      int spline_intervals, const ambulo_allocator *allocator,
                                      ambulo_problem **out);
/* ambulo_problem_create of a definition that is known to be good, or that moves beyond the ranges
 * of members a little; its obstacles have names that outlive it. */
ambulo_status ambulo__problem_build(const ambulo_problem_definition *definition,
                                    const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, ambulo_problem **problem);

/* Into an empty table. On failure what there is of it is the problem's to free. */
ambulo_status ambulo__problem_build_rows(ambulo_problem *problem, ambulo_diagnostics *diagnostics);

/* ------------------------------------------------- another foothold (moved_foothold.c) */

/* What depends on where contacts are; to be swapped with that of the problem. */
typedef struct ambulo__moved {
  ambulo__row_table table;
  ambulo__row_runs row_runs;
  double *ground;
  int contact; /* the first on that foothold */
  double place[2], heading;
} ambulo__moved;

/* Moves the foothold of a contact: all contacts of its stance stand on `place` (along forward,
 * along left; m), turned by `heading` (rad). Rows keep their number, order and nodes. *moved gets
 * what was there, and is freed by the caller. Errors, which change nothing: E_ARGUMENT for a
 * contact that is not there or returns at the other end; E_PROBLEM for a place out of reach, or
 * where other rows would be needed; E_MEMORY. */
ambulo_status ambulo__problem_move_foothold(ambulo_problem *problem, int contact,
                                            const double place[2], double heading,
                                            ambulo__moved *moved);
/* Back to what *moved has; *moved gets what there was. */
void ambulo__problem_swap_moved(ambulo_problem *problem, ambulo__moved *moved);
void ambulo__moved_free(const ambulo_problem *problem, ambulo__moved *moved);
/* 1: the rows of *moved stand on the same channels as those of the problem. */
int ambulo__moved_is_alike(const ambulo_problem *problem, const ambulo__moved *moved);

/* ---------------------------------------------------------- memory (workspace.c) */

/* How much a problem takes, before it is taken; bytes, as doubles: absurd sizes do not overflow
 * them. Of a workspace of a problem whose grid and plan are there. */
double ambulo__workspace_bytes(const ambulo_problem *problem, int with_jacobians);
/* Of that: slopes of rows that are not linear. */
double ambulo__slope_bytes(const ambulo_problem *problem);
/* Of the rows that this definition can bring at the most, with the tables made of them. */
double ambulo__row_bytes(const ambulo_problem *problem, double rows);
double ambulo__rows_at_most(const ambulo_problem *problem);
/* E_LIMIT with the figures when a problem whose grid and plan are there would not fit. */
ambulo_status ambulo__check_memory(const ambulo_problem *problem, ambulo_diagnostics *diagnostics);

#endif
