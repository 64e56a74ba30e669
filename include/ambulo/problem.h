/* ambulo/problem.h - a motion-prediction problem: what to minimize, subject to what.
 *
 * Unknowns: the control points of the joint trajectories, x [control_points][d]
 * row-major (d = coordinates). At N + 1 time nodes t_k (ambulo_grid) the motion q,
 * qd, qdd follows linearly from x; torques, root wrench and point positions follow
 * by inverse dynamics (mechanics.h), so the equations of motion always hold ("differential
 * inclusion", the seed's section IV.C).
 *
 *   minimize   sum_terms weight * integral of the term over [0, T] (trapezoidal)   (13)
 *   subject to rows c_r(x) = 0 or c_r(x) >= 0 at the nodes                         (14)
 *
 * Rows carry their physical unit and are never scaled here; every row has a family,
 * a subject (point, foot or coordinate), a time and a unit.
 *
 * A problem is built from a definition in memory or from a YAML file
 * (docs/problem-format.md). It is immutable and may be shared between threads; each
 * thread evaluates in a workspace of its own.
 */
#ifndef AMBULO_PROBLEM_H
#define AMBULO_PROBLEM_H

#include "ambulo/collision.h"
#include "ambulo/device.h"
#include "ambulo/ground.h"
#include "ambulo/hold.h"
#include "ambulo/muscles.h"
#include "ambulo/model.h"
#include "ambulo/objective.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ambulo_problem ambulo_problem;     /* immutable */
typedef struct ambulo_workspace ambulo_workspace; /* one per thread */

/* ---------------------------------------------------------------- vocabulary */

typedef enum ambulo_discretization {
  AMBULO_DISCRETIZATION_NOT_SET = 0, /* refused */
  AMBULO_BSPLINE,                    /* clamped B-spline, Eq. 23 */
  AMBULO_CENTRAL_DIFFERENCE,         /* Eqs. 18-19 */
  AMBULO_HERMITE                     /* Eqs. 20-22 */
} ambulo_discretization;

/* Where nodes or knots are. An event is a time at which a contact begins or ends. Nodes have
 * further events in a swing: when the foot's tip must begin to clear the ground (ambulo_clearance),
 * and when it passes the edges of steps.
 *
 * Phases between neighbouring events share the intervals in proportion to their durations (largest
 * remainder; at least two for nodes, one for knots), equally spaced. With AMBULO_REACTION_SHARED
 * nodes are denser beside events, down to a fifth of the mean distance. A node on an event belongs
 * to both phases: rows of the phase that ends and of the one that begins hold, as one-sided limits.
 */
typedef enum ambulo_grid {
  AMBULO_GRID_NOT_SET = 0, /* refused */
  AMBULO_GRID_UNIFORM,     /* t_k = k T / N; a node on an event belongs to the phase that begins */
  AMBULO_GRID_EVENTS       /* B-splines only */
} ambulo_grid;

/* How a loaded foot touches the ground: which of its corners are at height zero. */
typedef enum ambulo_contact_mode {
  AMBULO_CONTACT_MODE_NOT_SET = 0, /* refused */
  AMBULO_CONTACT_HEEL,             /* heel corners down; heel centre on the foothold */
  AMBULO_CONTACT_FLAT, /* all corners down; heel centre on the foothold, toe centre straight ahead;
                          of a point foot: its point on the foothold */
  AMBULO_CONTACT_TOE,  /* toe corners down; toe centre where the flat foot has it */
  AMBULO_CONTACT_PATCH /* no foot: the middle of a patch on its place, at any orientation */
} ambulo_contact_mode;

/* One foot in one mode on one foothold, or one patch on one place. Nodes with from <= t < to are in
 * contact; a span that ends at the duration includes it, and on a grid on events a node at `to` is
 * in contact too. A patch without contact has no rows: nothing keeps it off the surroundings. */
typedef struct ambulo_contact {
  int foot; /* index of the model's foot; -1 of a patch */
  ambulo_contact_mode mode;
  double from, to; /* s */
  /* Components along forward, left and up. Zeros in all but the first two: level ground, straight
   * ahead. */
  double place[3]; /* of the heel centre, or of the patch, m; the third above the ground's height */
  double normal[3]; /* of the surface, away from it, any length; under a foot within 60 degrees of
                       up; all zero: up */
  double heading; /* of the foot, or of the surface's forward, about up, turned to the left, rad. On
                     a surface that faces that direction (within 25 degrees), up replaces forward */
  int patch;      /* index of the model's patch, of a contact in mode AMBULO_CONTACT_PATCH */
} ambulo_contact;

/* A regular walk; ambulo_gait_expand() turns it into contacts. Step s (0 .. steps) strikes at
 * s * step_time, with feet alternating from `first_foot`. Its foothold is
 * (start + s * step_length, +-step_width / 2), left positive. Use mirrored ends for an odd number
 * of equal steps and periodic ends for an even number.
 *
 * Phases are fractions of the stride (two steps) after the foot's own strike. A negative
 * heel_strike puts the heel down before the nominal strike. */
typedef struct ambulo_gait {
  size_t size, contact_size; /* set by ambulo_gait_default() */
  int steps;
  int first_foot;                                   /* foot that strikes at t = 0 */
  double step_length, step_time, step_width, start; /* m, s, m, m */
  double heel_strike, foot_flat, heel_off, toe_off; /* e.g. 0, 0.08, 0.38, 0.62 */
  /* Unequal steps: those to odd strikes have step_length and step_time, those to even strikes have
   * these. AMBULO_OFF: equal steps. A stride lasts the sum of both. */
  double other_step_length, other_step_time; /* m, s */
  int forefoot; /* 1: down on the toes, not on the heel, from heel_strike to foot_flat */
} ambulo_gait;

/* A contact: level, straight, flat on the ground; foot or patch must be set. A gait: one step with
 * the phases of people. */
AMBULO_PROBLEM_DEFAULT(ambulo_contact);
#ifndef AMBULO_DECLARATIONS_ONLY
static inline ambulo_gait ambulo_gait_default(void) {
  ambulo_gait usual;
  usual.size = sizeof usual;
  usual.contact_size = sizeof(ambulo_contact);
  ambulo_defaults("ambulo_gait", &usual, sizeof usual);
  return usual;
}
#endif

/* Writes the contacts that meet [0, steps * step_time] to contacts [capacity] and sets *count to
 * their number. Errors: E_ARGUMENT (phases out of order, no such foot, fewer than two feet),
 * E_LIMIT
 * (*count > capacity; only *count is set). */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_gait_expand(const ambulo_model *model,
                                                             const ambulo_gait *gait,
                                                             ambulo_contact *contacts, int capacity,
                                                             int *count);

typedef enum ambulo_support {
  AMBULO_SUPPORT_OFF = 0, /* no ZMP rows */
  AMBULO_SUPPORT_BOX,     /* axis-aligned box around the loaded feet (the seed's four rows) */
  AMBULO_SUPPORT_HULL     /* convex hull of the points in contact */
} ambulo_support;

typedef enum ambulo_limit_mode {
  AMBULO_LIMIT_OFF = 0,
  AMBULO_LIMIT_NODES,         /* rows at the time nodes */
  AMBULO_LIMIT_CONTROL_POINTS /* rows on control points: hold at all times, but tighter */
} ambulo_limit_mode;

typedef enum ambulo_ends {
  AMBULO_ENDS_FREE = 0,
  AMBULO_ENDS_PERIODIC, /* state(T) = state(0), moved forward by `travel` */
  AMBULO_ENDS_MIRRORED  /* state(T) = mirror image of state(0), moved forward by `travel`: one step
                           represents both. Body, terms, tubes and footholds must be symmetric;
                           limits hold in both halves (docs/problem-format.md, "ends"). References
                           and user functions refer to the one step */
} ambulo_ends;

/* A prescribed end value: the order-th derivative of a coordinate at t = 0 or T. */
typedef struct ambulo_end_value {
  int coordinate;
  int order; /* 0: q, 1: qd, 2: qdd */
  int final; /* 0: at t = 0, 1: at t = T */
  double value;
} ambulo_end_value;

/* The motion stays within half_width of a reference at every node. */
typedef struct ambulo_tube {
  int samples;              /* >= 2 */
  const double *reference;  /* [samples][d], equally spaced over [0, T], linear in between */
  const double *half_width; /* [d], rad or m, >= 0; INFINITY: the coordinate is free */
} ambulo_tube;

AMBULO_PROBLEM_DEFAULT(ambulo_end_value); /* 0 at the start; the coordinate must be set */
AMBULO_PROBLEM_DEFAULT(ambulo_tube);      /* empty: all must be set */

/* ---------------------------------------------------------------- definition */

/* Borrowed during ambulo_problem_create() only, except `model` and the callbacks'
 * user pointers, which must outlive the problem. */
typedef struct ambulo_problem_definition {
  /* Set by ambulo_problem_definition_default(): its own, those of items, and those of parts. */
  size_t size, contact_size, end_value_size, tube_size, obstacle_size, reach_size, device_size;
  size_t hold_size, term_size, user_row_size, capsule_pair_size;
  size_t clearance_size, ground_reaction_size, collision_size;
  const char *name;
  const ambulo_model *model;

  double duration; /* T, s */
  int intervals;   /* N; nodes = N + 1 */
  ambulo_grid grid;
  ambulo_discretization discretization;
  int degree;                /* of the B-spline, 3..7 */
  int spline_intervals;      /* K, intervals of the trajectory; 0: as many as time intervals */
  ambulo_grid knots;         /* where breakpoints are if not given */
  const double *node_times;  /* [N + 1] rising from 0 to T, with AMBULO_GRID_EVENTS only; nodes
                                within 1e-9 s of an event belong to both phases. NULL: distributed
                                over the phases */
  const double *breakpoints; /* [K + 1] from 0 to T; NULL: as `knots` says */

  const ambulo_contact *contacts;
  int contact_count;
  double ground_height;   /* n . r = h, m */
  int ground_penetration; /* rows on the corners' heights */
  int foot_strike;        /* rows on the contact points' places */
  ambulo_support support; /* ZMP rows */
  double support_margin;  /* m, >= 0: the polygon is shrunk by it */
  double minimum_force;   /* n . F >= minimum_force * m g; AMBULO_OFF: no row */
  /* > 0: contacts hold within a tolerance. Pairs of inequalities on a loaded foot then replace the
   * equalities of ground_penetration and foot_strike. Its contact point is within contact_tolerance
   * (m) of its place in all three directions. The sines of its yaw and roll, and of its pitch when
   * flat, are within orientation_tolerance (yaw and roll on the toes: twice that). On the heel the
   * toes are raised by up to 30 degrees; on the toes the heel is raised. */
  double contact_tolerance, orientation_tolerance;
  double strike_pitch[2]; /* with a tolerance: [min, max] pitch, rad, at the first node of a contact
                             on the heel, or on the toes if both are at most 0. AMBULO_OFF: any */
  ambulo_clearance clearance;
  ambulo_ground_reaction ground_reaction;

  ambulo_limit_mode joint_limits;
  int speed_limits, torque_limits;

  ambulo_ends ends;
  int ends_order; /* highest derivative matched at the ends: 0, 1 (default) or 2; below 2 forces
                     jump between periods */
  double travel;  /* m along forward */
  double rise;    /* m along up over the whole motion, as on stairs; 0 with free ends */
  const ambulo_end_value *end_values;
  int end_value_count;
  int tube_count;
  const ambulo_tube *tubes; /* [tube_count]: distance from reference motions */

  ambulo_collision collision;
  const ambulo_obstacle *obstacles;
  int obstacle_count;
  const ambulo_reach *reaches;
  int reach_count;
  const ambulo_device *devices; /* what the body wears (ambulo/device.h) */
  int device_count;
  const ambulo_hold *holds; /* what hands hold or push (ambulo/hold.h) */
  int hold_count;

  const ambulo_term *terms; /* none: any feasible motion will do (Fig. 5a) */
  int term_count;
  const ambulo_user_row *user_rows;
  int user_row_count;
  const ambulo_muscles *muscles; /* of the terms that share torques, and of a body with the model's
                                    coordinates; must outlive the problem. NULL: none */
} ambulo_problem_definition;

/* One second, 12 equal intervals, cubic B-spline, parts of the body kept apart (collision.h),
 * everything else off or empty. */
#ifndef AMBULO_DECLARATIONS_ONLY
static inline ambulo_problem_definition ambulo_problem_definition_default(void) {
  ambulo_problem_definition usual;
  usual.size = sizeof usual;
  usual.contact_size = sizeof(ambulo_contact);
  usual.end_value_size = sizeof(ambulo_end_value);
  usual.tube_size = sizeof(ambulo_tube);
  usual.obstacle_size = sizeof(ambulo_obstacle);
  usual.reach_size = sizeof(ambulo_reach);
  usual.device_size = sizeof(ambulo_device);
  usual.hold_size = sizeof(ambulo_hold);
  usual.term_size = sizeof(ambulo_term);
  usual.user_row_size = sizeof(ambulo_user_row);
  usual.capsule_pair_size = sizeof(ambulo_capsule_pair);
  usual.clearance_size = sizeof(ambulo_clearance);
  usual.ground_reaction_size = sizeof(ambulo_ground_reaction);
  usual.collision_size = sizeof(ambulo_collision);
  ambulo_problem_defaults("ambulo_problem_definition", &usual, sizeof usual);
  return usual;
}
#endif
/* Checks the definition and builds the problem. `allocator` and `diagnostics` may be NULL; the
 * model must outlive the problem. Contradictions that need no solve are refused with name, time and
 * unit: footholds out of reach, times without support, empty support polygons, overlapping
 * contacts, more equalities than unknowns, ends that do not match the footholds, mirrored ends
 * without symmetry. Errors: E_ARGUMENT, E_PROBLEM, E_LIMIT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_problem_create(
    const ambulo_problem_definition *definition, const ambulo_allocator *allocator,
    ambulo_diagnostics *diagnostics, ambulo_problem **problem);

AMBULO_API void ambulo_problem_free(ambulo_problem *problem); /* accepts NULL */

/* ------------------------------------------------------------------- queries */
/* Pointers belong to the problem. Indices out of range give NULL. */

AMBULO_API const char *ambulo_problem_name(const ambulo_problem *problem);
AMBULO_API const ambulo_model *ambulo_problem_model(const ambulo_problem *problem);
/* NULL: none. */
AMBULO_API const ambulo_muscles *ambulo_problem_muscles(const ambulo_problem *problem);
AMBULO_API double ambulo_problem_duration(const ambulo_problem *problem);
AMBULO_API int ambulo_problem_node_count(const ambulo_problem *problem); /* N + 1 */
/* Time of node `node`, s; NaN: no such node. */
AMBULO_API double ambulo_problem_node_time(const ambulo_problem *problem, int node);
AMBULO_API ambulo_grid ambulo_problem_grid(const ambulo_problem *problem);
AMBULO_API int ambulo_problem_control_point_count(const ambulo_problem *problem);
AMBULO_API int
ambulo_problem_variable_count(const ambulo_problem *problem); /* control points * d */
AMBULO_API int ambulo_problem_row_count(const ambulo_problem *problem);
AMBULO_API int ambulo_problem_equality_count(const ambulo_problem *problem);
AMBULO_API double ambulo_problem_ground_height(const ambulo_problem *problem); /* m along up */
AMBULO_API ambulo_ends ambulo_problem_ends(const ambulo_problem *problem);
AMBULO_API int ambulo_problem_contact_count(const ambulo_problem *problem);
AMBULO_API const ambulo_contact *ambulo_problem_contact(const ambulo_problem *problem, int index);
AMBULO_API int ambulo_problem_device_count(const ambulo_problem *problem);
AMBULO_API const ambulo_device *ambulo_problem_device(const ambulo_problem *problem, int index);
AMBULO_API int ambulo_problem_hold_count(const ambulo_problem *problem);
AMBULO_API const ambulo_hold *ambulo_problem_hold(const ambulo_problem *problem, int index);
AMBULO_API int ambulo_problem_term_count(const ambulo_problem *problem);
AMBULO_API const char *ambulo_problem_term_name(const ambulo_problem *problem, int index);
/* Limits on `what` of coordinate `index` over [0, T]: the model's, and with mirrored ends those of
 * its mirror coordinate too. E_ARGUMENT: no such coordinate. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_problem_limits(const ambulo_problem *problem,
                                                                int index, ambulo_limited what,
                                                                ambulo_limits *limits);
/* Pairs of capsules that rows keep apart. Each function returns their number and, unless `pair` is
 * NULL, copies the index-th. For AMBULO_COLLISION_AUTOMATIC, _left_out lists the pairs that overlap
 * in the rest pose. */
AMBULO_API int ambulo_problem_pairs(const ambulo_problem *problem, int index,
                                    ambulo_capsule_pair *pair);
AMBULO_API int ambulo_problem_pairs_left_out(const ambulo_problem *problem, int index,
                                             ambulo_capsule_pair *pair);
AMBULO_API int ambulo_problem_obstacle_count(const ambulo_problem *problem);
AMBULO_API const ambulo_obstacle *ambulo_problem_obstacle(const ambulo_problem *problem, int index);
/* FNV-1a 64 of the resolved problem: model, schedule, terms, grid. */
AMBULO_API unsigned long long ambulo_problem_hash(const ambulo_problem *problem);

/* One row. Strings belong to the problem. */
typedef struct ambulo_row {
  const char *family;  /* "ground_penetration", "foot_strike", "zmp", "joint_limit", ... */
  const char *subject; /* "left_heel", "knee_angle_r", ... */
  const char *detail;  /* "height", "forward", "upper", ... */
  const char *unit;    /* "m", "rad", "N m", ... */
  ambulo_relation relation;
  int node;    /* -1: not tied to one node */
  double time; /* s; beyond the duration for limits in the mirrored half of a stride */
} ambulo_row;
/* Copies row `index`. E_ARGUMENT: out of range. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_problem_row(const ambulo_problem *problem,
                                                             int index, ambulo_row *row);

#ifdef __cplusplus
}
#endif
#endif
