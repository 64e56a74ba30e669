/* ambulo/model.h - the skeleton: an immutable tree of Denavit-Hartenberg links.
 *
 * Each link hangs on its parent by one classical ("distal") DH transform
 *
 *     T(q) = Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha)
 *
 * (Denavit & Hartenberg 1955; the seed's Fig. 1). A revolute link adds its
 * coordinate q to theta, a prismatic link adds q to d, a fixed link has no
 * coordinate; a coupled link adds a function of another link's coordinate. The link frame is the
 * frame *after* the transform; bodies and points are given in it. Units: SI and radians, always.
 *
 * A model is built from a definition in memory or from a YAML file
 * (docs/model-format.md), checked, and never changes afterwards: it may be shared
 * between threads without locks.
 *
 * Coordinates are numbered in the order in which links with a coordinate appear, once
 * every parent stands before its children (a definition in another order is sorted).
 */
#ifndef AMBULO_MODEL_H
#define AMBULO_MODEL_H

#include "ambulo/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ambulo_model ambulo_model;

typedef enum ambulo_joint_type {
  AMBULO_JOINT_TYPE_NOT_SET = 0, /* refused */
  AMBULO_FIXED,
  AMBULO_REVOLUTE,
  AMBULO_PRISMATIC
} ambulo_joint_type;

/* One coordinate q_i. Ranges are +-INFINITY where unlimited. */
typedef struct ambulo_coordinate {
  const char *name;       /* e.g. "knee_angle_r" */
  ambulo_joint_type type; /* AMBULO_REVOLUTE (rad, N m) or AMBULO_PRISMATIC (m, N) */
  double range[2];        /* [min, max], rad or m */
  double speed[2];        /* [min, max], rad/s or m/s */
  double torque[2];       /* [min, max] generalized force, N m or N */
  int actuated;           /* 0: no muscle drives it: its torque is 0 beside devices, or, of a
                             coordinate that moves a whole body not hinged to the world, what
                             the ground supplies */
  int mirror;             /* its counterpart in the mirror image; itself if unpaired (in a
                             definition also -1) */
  double mirror_sign;     /* +1 or -1: q_mirror = mirror_sign * q */
  double default_value;   /* its value in the start pose, where a solve begins unless the caller
                             gives a start: rad or m; 0 */
  /* What its drive adds to tau, and to nothing else:
   *   armature qdd + damping qd + friction qd / sqrt(qd^2 + v^2),
   * v = AMBULO_FRICTION_RATE of a revolute, AMBULO_FRICTION_SPEED of a prismatic one. Each is
   * finite and not negative, and 0 where nothing but the ground moves a whole body. */
  double armature; /* inertia of the rotor times the gear ratio squared, kg m^2 or kg; 0 */
  double damping;  /* N m s/rad or N s/m; 0 */
  double friction; /* dry friction, N m or N; 0 */
} ambulo_coordinate;

/* Speed at which dry friction has 0.71 of its size; at ten times that, 0.995. */
#define AMBULO_FRICTION_RATE 0.1   /* rad/s */
#define AMBULO_FRICTION_SPEED 0.01 /* m/s */

/* Which limit of a coordinate, and the interval that it leaves. */
typedef enum ambulo_limited {
  AMBULO_LIMITED_NOT_SET = 0, /* refused */
  AMBULO_LIMITED_POSITION,    /* `range` */
  AMBULO_LIMITED_SPEED,
  AMBULO_LIMITED_TORQUE
} ambulo_limited;
typedef struct ambulo_limits {
  double low, high;    /* rad, m, per s, N m or N; +-INFINITY without limit */
  int low_of, high_of; /* coordinates whose limits set the two ends */
} ambulo_limits;

/* One link as given (after scaling to the subject). */
typedef struct ambulo_link {
  const char *name;
  int parent; /* index of the parent link; -1: the world */
  ambulo_joint_type type;
  double theta, d, a, alpha; /* DH constants: rad, m, m, rad */
  int coordinate;            /* coordinate index; -1 for a fixed or coupled link */
  double mass;               /* kg; 0: no body */
  double com[3];             /* centre of mass in the link frame, m */
  double inertia[6];         /* about the centre of mass, link axes: xx yy zz xy xz yz, kg m^2 */
  /* A coupled joint, revolute or prismatic, has no coordinate and no limits of its own: its value,
   * rad or m, is a function of a coordinate, as the parts of a knee that slide as it bends. A joint
   * that is not coupled has coupled_to = -1. */
  int coupled_to;           /* that coordinate; its own joint is not coupled */
  int knot_count;           /* points of the function, 2 to 1024; 0: it is the polynomial */
  const double (*knots)[2]; /* [knot_count]: coordinate, ascending, and value of the joint. The
                           cubic spline through them, straight beyond both ends; its second
                           derivative is continuous between the ends */
  double polynomial[5];     /* the sum of polynomial[i] times q to the power of i */
} ambulo_link;

/* A named point fixed on a link. */
typedef struct ambulo_point {
  const char *name;
  int link;
  double position[3]; /* link frame, m */
} ambulo_point;

/* A foot: which points touch the ground. Points are indices. A planar foot has
 * one heel and one toe point; a spatial one two of each. A point foot, as of a quadruped, has one
 * point at all: heel[0], toe[0], heel_center and toe_center are the same, without a second corner,
 * tip or arcs. It stands flat (AMBULO_CONTACT_FLAT), and its link may turn about it freely. */
typedef struct ambulo_foot {
  const char *name; /* "left", "right" */
  int heel[2];      /* corner points at the heel; [1] = -1 if there is only one */
  int toe[2];       /* corner points at the toe; [1] = -1 if there is only one */
  int heel_center;  /* point placed on the foothold */
  int toe_center;   /* point that fixes the heading, and the place in toe contact */
  int mirror;       /* its counterpart in the mirror image (in a definition -1: itself) */
  int has_tip;      /* 1: a tip reaches further ahead than the pivot of push-off */
  int tip;          /* its point, which must clear the ground only late in swing */
  /* Heel and forefoot as arcs, on which the foot rolls without slip. Their radius is the height of
   * the arc's centre above the heel centre at q = 0; radius 0 is a fixed point. */
  int has_arcs; /* 1: both */
  int arc[2];   /* points: centre of the heel's, of the forefoot's */
} ambulo_foot;

/* A small surface of a link that may press on something: a hand, the seat, an elbow, the pad of a
 * robot. The contacts of a problem say what it rests on (problem.h). */
typedef struct ambulo_patch {
  const char *name; /* "hand_r", "seat"; also different from the feet's */
  int point;        /* its middle, which a contact holds in place */
  double size[2];   /* half its length along the surface's forward, half its width along left, m:
                       how far the centre of pressure may be from the middle; > 0 */
  int mirror;       /* its counterpart in the mirror image (in a definition -1: itself) */
} ambulo_patch;

/* The space that a link occupies: all points within `radius` of a line segment. Problems keep
 * capsules clear of each other and of obstacles (collision.h). */
typedef struct ambulo_capsule {
  const char *name; /* "shank_r" */
  int link;
  double from[3], to[3]; /* ends of the line, link frame, m; equal: a sphere */
  double radius;         /* m, > 0 */
  int mirror;            /* its counterpart in the mirror image (in a definition -1: itself) */
} ambulo_capsule;

/* ------------------------------------------------------------ build in code */

/* Everything a model consists of. Arrays are borrowed during the call only.
 * In the definition `parent`, `link`, `mirror` and point numbers are indices
 * into these arrays, `coupled_to` one into `coordinates`; `links[i].coordinate` is ignored
 * (numbered by order);
 * `coordinates[k]` describes the k-th link that has a coordinate. */
typedef struct ambulo_model_definition {
  /* Set by ambulo_model_definition_default(): its own, and those of the items below. */
  size_t size, link_size, coordinate_size, point_size, foot_size, patch_size, capsule_size;
  const char *name;
  double gravity[3]; /* m/s^2, world frame; up is -gravity/|gravity| */
  double forward[3]; /* walking direction, world frame; must not be vertical */
  const ambulo_link *links;
  int link_count;
  const ambulo_coordinate *coordinates;
  int coordinate_count;
  const ambulo_point *points;
  int point_count;
  const ambulo_foot *feet;
  int foot_count;
  double stature; /* m; AMBULO_OFF: unknown */
  const ambulo_patch *patches;
  int patch_count;
  const ambulo_capsule *capsules;
  int capsule_count;
} ambulo_model_definition;

/* Gravity -9.81 along y, forward x, no links. */
#ifndef AMBULO_DECLARATIONS_ONLY
static inline ambulo_model_definition ambulo_model_definition_default(void) {
  ambulo_model_definition usual;
  usual.size = sizeof usual;
  usual.link_size = sizeof(ambulo_link);
  usual.coordinate_size = sizeof(ambulo_coordinate);
  usual.point_size = sizeof(ambulo_point);
  usual.foot_size = sizeof(ambulo_foot);
  usual.patch_size = sizeof(ambulo_patch);
  usual.capsule_size = sizeof(ambulo_capsule);
  ambulo_defaults("ambulo_model_definition", &usual, sizeof usual);
  return usual;
}
#endif
/* Neutral values: unlimited, actuated, own mirror. Indices of links and points that must be set are
 * -1, which is refused. */
AMBULO_DEFAULT(ambulo_link);
AMBULO_DEFAULT(ambulo_coordinate);
AMBULO_DEFAULT(ambulo_point);
AMBULO_DEFAULT(ambulo_foot);
AMBULO_DEFAULT(ambulo_patch);
AMBULO_DEFAULT(ambulo_capsule);

/* Checks the definition (acyclic, masses positive, inertias physical, limits ordered, names unique)
 * and builds the model. `allocator` and `diagnostics` may be NULL. Free with ambulo_model_free.
 * Errors: E_ARGUMENT, E_MODEL, E_LIMIT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status
ambulo_model_create(const ambulo_model_definition *definition, const ambulo_allocator *allocator,
                    ambulo_diagnostics *diagnostics, ambulo_model **model);

/* Accepts NULL. */
AMBULO_API void ambulo_model_free(ambulo_model *model);

/* --------------------------------------------------------- other conditions */

/* A slope and a load: `ground` and `load` of a problem file. */
typedef struct ambulo_conditions {
  size_t size;             /* set by ambulo_conditions_default() */
  double slope;            /* rad, -0.6 to 0.6: rise of the ground along forward. The world's axes
                              stay with the ground; gravity turns instead. 0: unchanged */
  int load_link;           /* link that carries a point mass; -1: none */
  double load_mass;        /* kg, 1e-6 to 1000 */
  double load_position[3]; /* link frame, m */
} ambulo_conditions;
AMBULO_DEFAULT(ambulo_conditions); /* slope unchanged, no load */

/* A copy of `model` under other conditions; free it with ambulo_model_free. A load adds to earlier
 * ones; a slope replaces the earlier one. `allocator` and `diagnostics` may be NULL. Errors:
 * E_ARGUMENT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_model_adapt(const ambulo_model *model,
                                                             const ambulo_conditions *conditions,
                                                             const ambulo_allocator *allocator,
                                                             ambulo_diagnostics *diagnostics,
                                                             ambulo_model **adapted);

/* --------------------------------------------------------- left against right */

/* Checks that the body is its own mirror image, coordinate by coordinate as `mirror` and
 * `mirror_sign` say. The mirror plane contains the world's origin, up and forward.
 *
 * Compared at q = 0: the tree of joints, their axes and drives, the mass, centre of mass and
 * inertia that each joint carries, and the points of the feet. The tolerance is 1e-6 of their size
 * (lengths: of the body's; directions: rad). Not compared: points that no foot uses, patches,
 * capsules, limits, `actuated`, and the handedness of link frames.
 *
 * Each difference is a message with both names and both numbers. `allocator` and `diagnostics` may
 * be NULL. Errors: E_MODEL (not symmetric), E_ARGUMENT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_model_check_mirror(
    const ambulo_model *model, const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics);

/* ------------------------------------------------------------------ queries */
/* Pointers belong to the model. Out-of-range indices give NULL; names that do
 * not exist give -1. */

AMBULO_API const char *ambulo_model_name(const ambulo_model *model);
AMBULO_API int ambulo_model_link_count(const ambulo_model *model);
AMBULO_API int ambulo_model_coordinate_count(const ambulo_model *model);
AMBULO_API int ambulo_model_point_count(const ambulo_model *model);
AMBULO_API int ambulo_model_foot_count(const ambulo_model *model);
AMBULO_API int ambulo_model_patch_count(const ambulo_model *model);
AMBULO_API int ambulo_model_capsule_count(const ambulo_model *model);
AMBULO_API const ambulo_link *ambulo_model_link(const ambulo_model *model, int index);
AMBULO_API const ambulo_coordinate *ambulo_model_coordinate(const ambulo_model *model, int index);
AMBULO_API const ambulo_point *ambulo_model_point(const ambulo_model *model, int index);
AMBULO_API const ambulo_foot *ambulo_model_foot(const ambulo_model *model, int index);
AMBULO_API const ambulo_patch *ambulo_model_patch(const ambulo_model *model, int index);
AMBULO_API const ambulo_capsule *ambulo_model_capsule(const ambulo_model *model, int index);
AMBULO_API int ambulo_model_find_link(const ambulo_model *model, const char *name);
AMBULO_API int ambulo_model_find_coordinate(const ambulo_model *model, const char *name);
AMBULO_API int ambulo_model_find_point(const ambulo_model *model, const char *name);
AMBULO_API int ambulo_model_find_foot(const ambulo_model *model, const char *name);
AMBULO_API double ambulo_model_mass(const ambulo_model *model);           /* kg, whole body */
AMBULO_API double ambulo_model_stature(const ambulo_model *model);        /* m; 0 if unknown */
AMBULO_API const double *ambulo_model_gravity(const ambulo_model *model); /* [3], m/s^2 */
AMBULO_API const double *ambulo_model_up(const ambulo_model *model);      /* [3], unit */
AMBULO_API const double *
ambulo_model_forward(const ambulo_model *model);                       /* [3], unit, horizontal */
AMBULO_API const double *ambulo_model_left(const ambulo_model *model); /* [3], unit: up x forward */

#ifdef __cplusplus
}
#endif
#endif
