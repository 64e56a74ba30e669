/* mechanics/plan_layout.h - the inside of a plan.
 *
 * Frame 0 is the world, frame k + 1 moves with coordinate k. A frame is chosen so that a joint only
 * mixes two columns of its parent's orientation: its axis is a column of the parent frame, unless
 * the axis is oblique, when a constant rotation ("turn") is put between. Where the axis meets the
 * parent's origin, the frame has that origin.
 *
 * Scratch holds vectors and matrices of lanes; every member named *_at is the offset in doubles of
 * its first entry. A matrix is stored by rows, a symmetric one as xx yy zz xy xz yz.
 */
#ifndef AMBULO_MECHANICS_PLAN_LAYOUT_H
#define AMBULO_MECHANICS_PLAN_LAYOUT_H

#include "mechanics/plan_local.h"

/* What the kernels of the Jacobians read: lists of equal steps. Integers are offsets in doubles:
 * into the scratch, or for output and entry into the [entry][lane] arrays of the caller. */

typedef struct ambulo__rigid_body {
  int frame;
  double mass;
  double com[3]; /* in the frame */
  /* inertia about the centre of mass = base 1 + first u u' + second w w', with
   * u = (1, lower[0], lower[1]), w = (0, 1, lower[2]) in the frame's axes in
   * this order */
  double base, first, second, lower[3];
  int order[3];
  int diagonal; /* lower = 0 */
} ambulo__rigid_body;

/* A joint's row and column of the Jacobians: pairs first .. first + count of
 * ancestors, and the joint itself. The first `straight` pairs are with straight
 * joints, the first `rowless` pairs with joints whose own rows of tau have no
 * entries. */
typedef struct ambulo__change_step {
  int motion;
  int subtree; /* where its subtree stands: in the slot of the frame, or of its only child */
  int first, rowless, straight, count, lower;
  int is_straight; /* prismatic along an axis that stands still: of its motion only S is read */
  int is_rowless;  /* its own row has no entries; then nor have those of its ancestors */
  double mass;
} ambulo__change_step;

/* axis: 0, 1, 2 if the ancestor is straight along that world axis, else -1; upper: the joint's
 * column in the ancestor's row. */
typedef struct ambulo__pair {
  int motion, upper, axis;
} ambulo__pair;

/* The points of one frame. */
typedef struct ambulo__group_step {
  int first, count;       /* points */
  int chain, chain_count; /* motions of the joints that move them */
} ambulo__group_step;

typedef struct ambulo__point_step {
  double position[3];
  int output, entry; /* rows of outputs and weights; first Jacobian entry */
} ambulo__point_step;

typedef struct ambulo__steps {
  ambulo__change_step *changes; /* all coordinates */
  ambulo__pair *pairs;
  ambulo__group_step *groups;
  ambulo__point_step *points; /* all points, by group */
  int *chains;
  int group_count;
} ambulo__steps;

/* Vectors of what kernel_subtree.h sums up. */
#define AMBULO__SUBTREE 27

/* What a drive adds to tau of its coordinate, and to nothing else (kernel_drives.h). */
typedef struct ambulo__drive {
  int input;                          /* entries of the coordinate in the arrays of the caller */
  int diagonal;                       /* its own column in its row of jqd and jqdd */
  int alone;                          /* nothing else is ever written to that entry of jqd */
  double armature, damping, friction; /* SI units */
  double smoothing;                   /* v^2 of the dry friction */
} ambulo__drive;

typedef struct ambulo__frame {
  int subtree_at;   /* load and inertia (27, kernel_subtree.h) of the body and of finished branches;
                       the world's: of all that moves; -1: nothing but those of the only child */
  int body;         /* index, -1: none */
  int last_carried; /* coordinate */
  double subtree_mass;
} ambulo__frame;

typedef struct ambulo__joint {
  int revolute;
  int parent;     /* frame index; the joint's own frame is its coordinate + 1 */
  int still;      /* the parent's orientation is constant */
  double sign;    /* axis = sign * column */
  double shift;   /* angle = sign * q + shift */
  int has_offset; /* the origin moves by `offset` (parent frame) */
  double offset[3];
  int turned;     /* the axis is oblique: columns of the turned frame are computed first */
  double turn[9]; /* rows; turned frame in parent frame */
  int axis;       /* which column of the (turned) frame is the axis */
  int contacts;   /* those that it carries, a bit each */
  int driven;     /* its drive has inertia, damping or friction: tau is more than the bodies' */
  int torque_row; /* ambulo__torque_row */
  int factors;    /* Jacobian: its factors in jq (plan_contacts.c), if the ground reacts */
  int motion_at;  /* Jacobian: S, 2 Sd and Sdd (18, kernel_world.h) */
} ambulo__joint;

/* Row of tau in the Jacobians: the coordinates above and below the joint; the same and, since it
 * carries a contact, multiples of the rows of the root wrench; or none: with ground
 * reaction, because it carries the whole body (tau = 0); without, because it is a row of the root
 * force (plan_pattern.c). */
typedef enum ambulo__torque_row {
  AMBULO__ROW_SPARSE = 0,
  AMBULO__ROW_REACTS,
  AMBULO__ROW_VANISHES,
  AMBULO__ROW_FOLLOWS
} ambulo__torque_row;

/* Factors in jq: by the root wrench (6) and by the centre of mass (3), of a row of tau that reacts
 * and of each of the six rows of a contact (plan_contacts.c). */
enum { AMBULO__CONTACT_FACTORS = 9 };

/* At contacts_at: vectors of all contacts, then slots of vectors of each
 * (kernel_contacts.h). */
enum {
  contacts_wrench = 0,                   /* M, F */
  contacts_floating = 6 * AMBULO__LANES, /* 1 where no contact has weight, else 0 */
  contacts_middle = 7 * AMBULO__LANES,   /* x */
  contacts_rest = 10 * AMBULO__LANES,    /* sum w d */
  contacts_factor = 13 * AMBULO__LANES,  /* of G: 21 */
  contacts_first = 34 * AMBULO__LANES,
  contact_acts = 0,                   /* (moment, force) about the world origin */
  contact_share = 6 * AMBULO__LANES,  /* w */
  contact_arm = 7 * AMBULO__LANES,    /* d */
  contact_line = 10 * AMBULO__LANES,  /* r */
  contact_moved = 13 * AMBULO__LANES, /* u */
  contact_taste = 16 * AMBULO__LANES, /* k */
  contact_close = 17 * AMBULO__LANES, /* 1 / r^2 */
  contact_slot = 18 * AMBULO__LANES
};

typedef struct ambulo__plan_point {
  int frame;
  double position[3];
} ambulo__plan_point;

struct ambulo__plan {
  ambulo_allocator allocator;
  int coordinates, points, bodies;
  ambulo__frame *frames;    /* [coordinates + 1] */
  ambulo__joint *joints;    /* [coordinates] */
  ambulo__rigid_body *body; /* [bodies] */
  ambulo__plan_point *point;
  double gravity[3];
  size_t taken_at;      /* what the bodies hold (ambulo__plan_take_wrench); 0: nothing */
  double fixed_load[6]; /* wrench that holds the bodies fixed to the world */
  int positions_at;     /* Jacobian: positions of the points (3 per point) */
  size_t scratch;       /* doubles */

  /* Ground reaction (kernel_contacts.h). */
  int contacts, contact_frame[AMBULO__MOST_CONTACTS]; /* what they act on */
  double moment_arm, slant;                           /* l, epsilon */
  int vanishing, *roots;                              /* rows of tau that vanish (doubles) */
  double mass, fixed_first[3]; /* of the whole body; mass times position of what is fixed */
  int contacts_at;

  /* Jacobian pattern, see plan.h. Row of tau i: ancestors of i, i, descendants of i. */
  int *start, *column, *rate_start, *by_qdd;
  int dynamic_count, count;
  int *ancestor_start; /* [coordinates + 1] into: */
  int *ancestor;       /* ancestors of coordinate i, ascending, without i */
  int *upper;          /* same length: entry of column i in the row of that ancestor; -1 where
                          that row has none */
  int contact_factors; /* the contacts' factors in jq (plan_contacts.c) */

  ambulo__drive *drives; /* [drive_count]: of the coordinates that have one */
  int drive_count;

  ambulo__steps steps;
  ambulo__local_plan local;
  struct ambulo__coupled_plan *coupled; /* plan_coupled.h; NULL: every joint has a coordinate */
};

/* the steps of compiling a plan, in order. Private to plan*.c. */

/* A mass distribution: mass, centre of mass, inertia about it. */
typedef struct ambulo__mass {
  double mass, com[3], inertia[3][3];
} ambulo__mass;

/* Where a link stands: x_frame = rotation x_link + position, constant. */
typedef struct ambulo__placing {
  int frame;
  double rotation[3][3], position[3];
} ambulo__placing;

/* The same with the rotation and position applied: the link's body seen from its frame. */
ambulo__mass ambulo__mass_of_link(const ambulo_link *link, const ambulo__placing *placing);
/* Adds b to a as one rigid body. */
void ambulo__mass_add(ambulo__mass *a, const ambulo__mass *b);
/* Writes mass, com and the factors of the inertia. */
void ambulo__mass_factor(const ambulo__mass *mass, ambulo__rigid_body *body);

/* What the body stands on. */
typedef struct ambulo__footing {
  int count;                       /* of contacts; 0: it is in the air */
  int link[AMBULO__MOST_CONTACTS]; /* on which they act */
  double moment_arm, slant;
} ambulo__footing;

/* Which joints carry which contact, and their rows; frames, joints, bodies, points are compiled.
 * Errors: E_MEMORY. */
ambulo_status ambulo__plan_carriers(ambulo__plan *plan, const ambulo__footing *footing,
                                    const ambulo__placing *placings);
/* Scratch offsets of everything; frames, joints and bodies are complete otherwise. */
void ambulo__plan_place(ambulo__plan *plan);
/* The lists of steps, from all of the above. Errors: E_MEMORY. */
ambulo_status ambulo__plan_steps_build(ambulo__plan *plan);
void ambulo__plan_steps_free(ambulo__plan *plan);
/* The steps in the bodies' own axes; enlarges the scratch. Errors: E_MEMORY. */
ambulo_status ambulo__plan_local_build(ambulo__plan *plan);
void ambulo__plan_local_free(ambulo__plan *plan);
/* The world axis along which a joint slides, -1: it turns, or slides in another direction. */
int ambulo__plan_world_axis(const ambulo__joint *joint);
/* On contacts (plan_contacts.c): what the factors behind the entries are, and the vectors that the
 * kernels keep at plan->contacts_at. */
void ambulo__plan_contact_factors(ambulo__plan *plan);
int ambulo__plan_contact_parts(const ambulo__plan *plan, int row, ambulo__row_part *part);
int ambulo__plan_contact_entries(const ambulo__plan *plan);
/* Jacobian pattern. Errors: E_MEMORY. */
ambulo_status ambulo__plan_pattern_build(ambulo__plan *plan);

#endif
