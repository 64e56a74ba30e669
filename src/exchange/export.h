/* exchange/export.h - a model as other programs have it, and a motion of it with all that acts on
 * the body; both as files.
 *
 * Bodies hang each on its parent by one joint.
 * A body moves against its parent by
 *
 *     X(q) = before J_1(q_1) ... J_n(q_n) after                                            (E.1)
 *
 * where J_i turns about or slides along axis[i] of the joint's frame: sliders first, then hinges
 * through one point. Links without mass, points or branches are parts of the joint of the next one.
 * Frames of bodies are those of the links they are called after, but for `single`. Ground: the
 * other program's world, whose axes the model's are turned to. SI units and radians.
 *
 * Reading order: export.h, bodies.c, motion_source.c, loads.c, export.c, model_text.c, markup.c,
 * coupled_text.c, npz.c; external_loads.c; walker.h, walker.c, walk_for.c, walk_robot.c.
 */
#ifndef AMBULO_EXCHANGE_EXPORT_H
#define AMBULO_EXCHANGE_EXPORT_H

#include "ambulo/tools/export.h"
#include "ambulo/tools/inverse.h"
#include "base/alloc.h"
#include "base/diagnostics.h"
#include "base/text_buffer.h"
#include "import/rigid.h"
#include "formats/motion_file.h"
#include "model/model.h"
#include "problem/nlp.h"

#include <stdint.h>

enum { AMBULO__JOINT_MOST = 6 };

typedef struct ambulo__export_body {
  const char *name;
  int parent; /* body; -1: ground */
  int link;
  int joints;                         /* 0: fixed; at most three sliders and three hinges */
  int link_of[AMBULO__JOINT_MOST];    /* whose joint it is */
  int coordinate[AMBULO__JOINT_MOST]; /* of the model; -1: the joint follows another's */
  double axis[AMBULO__JOINT_MOST][3]; /* unit, joint's frame */
  ambulo__rigid before, after;        /* (E.1) */
  double mass, com[3], inertia[6];    /* in the body's frame; about the centre of mass */
} ambulo__export_body;

typedef struct ambulo__bodies {
  ambulo_allocator allocator;
  const ambulo_model *model; /* borrowed */
  ambulo__rigid world;       /* the model's world in the ground's axes */
  int single; /* 1: one coordinate a body, and the origin on the joint's axis (URDF) */
  int root;   /* with a free root: its link, the first body, on no joint; else -1 */
  ambulo__export_body *list; /* [count], parents before children */
  int count;
  int *body_of;         /* [links]: -1: ground */
  ambulo__rigid *place; /* [links]: the link's frame in its body's */
  double *offset;       /* [coordinates]: m to add to a coordinate's values, 0 for most */
} ambulo__bodies;

typedef enum ambulo__ground_axes {
  AMBULO__Y_UP, /* OpenSim: forward near x, up near y */
  AMBULO__Z_UP  /* URDF: forward near x, up near z */
} ambulo__ground_axes;

/* The turn that takes the model's axes to a ground's: one axis to another, so that a slope stays a
 * slope and no number is rounded. */
ambulo__rigid ambulo__ground_turn(const ambulo_model *model, ambulo__ground_axes axes);

/* For OpenSim: joints of several coordinates; sliders of the root count from the ground's origin,
 * as there (`offset`). E_MEMORY. Fills *bodies, which ambulo__bodies_free releases. */
ambulo_status ambulo__bodies_merged(const ambulo_model *model, const ambulo_allocator *allocator,
                                    ambulo__bodies *bodies);
/* For URDF; free_root: without the coordinates that carry the root (ambulo__free_root). E_MEMORY.
 */
ambulo_status ambulo__bodies_single(const ambulo_model *model, int free_root,
                                    const ambulo_allocator *allocator, ambulo__bodies *bodies);
void ambulo__bodies_free(ambulo__bodies *bodies); /* accepts a zero-filled one */

/* The link that the first coordinates carry, none of them actuated, with nothing else on the way;
 * -1: the root is no free body. */
int ambulo__free_root(const ambulo_model *model);

/* T(q) of a link: J(z, q) F (bodies.c). */
ambulo__rigid ambulo__link_transform(const ambulo_link *link, double q);
/* Where a point of a link is in its body's frame. */
void ambulo__body_point(const ambulo__bodies *bodies, int link, const double local[3],
                        double out[3]);

/* ---------------------------------------------------- motion (motion_source.c) */

/* A motion with its torques and forces, read by ambulo_inverse_dynamics_motion, so that what is
 * exported is what `ambulo inverse` says: units, filters, rates, forces of feet and their points.
 */

/* What acts on a link from outside: the ground on a foot, or on a hand what it holds. */
typedef struct ambulo__source_load {
  char *name; /* of the foot; "LOAD_POINT" */
  int link;
  int point; /* of the hand; -1: a foot */
} ambulo__source_load;

typedef struct ambulo__source {
  ambulo_allocator allocator;
  const char *name;
  int rows, coordinates;
  int loads; /* all feet of the model, if the motion has their forces; then hands */
  ambulo__source_load *load;
  double *time;
  double *q, *qd, *qdd, *tau; /* [rows][coordinates], SI, rad */
  double *wrench;             /* [rows][6]: moment about the world's origin, force */
  /* [rows][loads][3], world axes. Points are those of the nearest row with one where the ground
   * does not push, as in the air; a foot that never has one: the origin */
  double *force, *point;
  double *torque; /* [rows][loads][3], at the point: about up, but where a force has no point of its
                     own */
  ambulo__motion *table; /* the file itself, row by row, with what else it says */
} ambulo__source;

/* other_forces: that option, on top of `options`. `motion`: a table, or a folder with a motion.csv.
 * Errors: those of inverse dynamics. Fills *source, which ambulo__source_free releases. */
ambulo_status ambulo__source_read(const ambulo_model *model, const char *motion,
                                  const ambulo_inverse_options *options, int other_forces,
                                  const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo__source *source);
/* Rows of points[rows][loads][3] without one (NaN) of that load take that of the nearest time with
 * one; a load that never has one: the origin. */
void ambulo__fill_points(const double *time, int rows, int loads, int load, double *points);
void ambulo__source_free(ambulo__source *source); /* accepts a zero-filled one */

/* -------------------------------------- root as a free joint (motion_source.c) */

/* Of a link's frame, in the ground's axes: place, and rates of its origin. */
typedef struct ambulo__frame_motion {
  ambulo__rigid place;
  double velocity[3], acceleration[3]; /* of the origin, m/s, m/s^2 */
  double spin[3], spin_rate[3];        /* angular velocity and acceleration, rad/s, rad/s^2 */
} ambulo__frame_motion;

/* The motion of `link` for q, qd, qdd [d]; `world` turns the model's world to the ground's axes. */
void ambulo__frame_motion_of(const ambulo_model *model, int link, const ambulo__rigid *world,
                             const double *q, const double *qd, const double *qdd,
                             ambulo__frame_motion *motion);

/* Unit quaternion (x, y, z, w) of a rotation, of the two the nearer to `before` (NULL: w >= 0). */
void ambulo__quaternion_of(const double rotation[3][3], const double *before, double q[4]);

/* ------------------------------------------------------------- loads (loads.c) */

/* All that pushes or pulls at the bodies of a motion: feet and hands as inverse dynamics has them;
 * of a problem also patches that press on something and devices, from the columns of its
 * motion.csv. A device is a pair of loads that add up to nothing. */

typedef enum ambulo__load_kind {
  AMBULO__LOAD_FOOT,
  AMBULO__LOAD_HAND, /* the root wrench of the source has it */
  AMBULO__LOAD_PATCH,
  AMBULO__LOAD_DEVICE
} ambulo__load_kind;

enum { AMBULO__LOAD_COLUMNS = 9, AMBULO__LOAD_NAME = 136 };

typedef struct ambulo__export_load {
  ambulo__load_kind kind;
  char name[AMBULO__LOAD_NAME];     /* foot, LOAD_POINT of a hand, patch, DEVICE_BODY */
  int index, part;                  /* of the source's loads, or of its kind; end, 0 or 1 */
  int link;                         /* that it acts on; -1: a device at a joint */
  int body;                         /* of export.h; -1: the ground, which nothing moves */
  int column[AMBULO__LOAD_COLUMNS]; /* of the table: force, point, moment; effort */
} ambulo__export_load;

typedef struct ambulo__loads {
  ambulo_allocator allocator;
  int rows, count;
  ambulo__export_load *list; /* [count], feet first */
  double *force, *point;     /* [rows][count][3], the model's world axes, N, m */
  double *torque;            /* [rows][count][3], about the point, N m */
} ambulo__loads;

/* 1 if something of a problem (NULL: nothing) pushes at more of the body than its feet and hands.
 */
int ambulo__has_loads(const ambulo_problem *problem);

/* Fills *loads, which ambulo__loads_free releases, and takes off source->tau what those do that
 * inverse dynamics knew nothing of. `problem`: NULL, or one whose body the bodies are. What the
 * motion has and cannot be carried over is reported. Errors: E_MEMORY. */
ambulo_status ambulo__loads_create(const ambulo__bodies *bodies, const ambulo_problem *problem,
                                   ambulo__source *source, ambulo_diagnostics *diagnostics,
                                   ambulo__loads *loads);
void ambulo__loads_free(ambulo__loads *loads); /* accepts a zero-filled one */

/* The body of an end of a device, 0: the one that its coordinate moves, or its first point's. */
int ambulo__device_end(const ambulo__bodies *bodies, const ambulo_device *device, int end);
/* Force, its point and the torque on that end, for an effort; frames [links][12] of the pose. */
void ambulo__device_load(const ambulo__bodies *bodies, const ambulo_device *device, int end,
                         const double *frames, double effort, double force[3], double point[3],
                         double torque[3]);

/* ---------------------------------------------------------------- .npz (npz.c) */

/* NumPy's .npz: a zip archive of .npy arrays, stored without compression.
 *
 *   ambulo__npz archive;
 *   ambulo__npz_begin(&archive, &text);
 *   ambulo__npz_numbers(&archive, "q", q, 2, (size_t[]){rows, columns});
 *   ambulo__npz_end(&archive);
 *
 * Formats: PKWARE's APPNOTE (local headers, central directory), NEP 1 (npy version 1.0). The bytes
 * do not depend on the machine or the clock. */

enum { AMBULO__NPZ_ARRAYS = 32, AMBULO__NPZ_NAME = 32 };

typedef struct ambulo__npz_entry {
  char name[AMBULO__NPZ_NAME + 8];
  uint32_t crc;
  size_t at, size; /* of the local header; of the array */
} ambulo__npz_entry;

typedef struct ambulo__npz {
  ambulo__text_buffer *text; /* borrowed: the archive, all of it */
  ambulo__npz_entry entry[AMBULO__NPZ_ARRAYS];
  int count;
  int too_large; /* more than the format's 4 GiB, or too many arrays */
} ambulo__npz;

void ambulo__npz_begin(ambulo__npz *npz, ambulo__text_buffer *text);
/* Doubles of shape[dimensions <= 3], the last index fastest. */
void ambulo__npz_numbers(ambulo__npz *npz, const char *name, const double *values, int dimensions,
                         const size_t *shape);
/* Texts, as an array of str. Bytes beyond ASCII become '?'. */
void ambulo__npz_texts(ambulo__npz *npz, const char *name, const char *const *texts, size_t count);
/* The central directory. E_LIMIT or what the text has. */
ambulo_status ambulo__npz_end(ambulo__npz *npz);

/* CRC-32 of ISO 3309, as in zip; crc: 0, or that of the bytes before. */
uint32_t ambulo__crc32(uint32_t crc, const char *bytes, size_t length);

/* A motion as arrays of NumPy, in the coordinates of Pinocchio and MuJoCo. `bodies`:
 * ambulo__bodies_single with a free root, where the model has one; names of links are those of its
 * URDF. Errors: E_LIMIT, E_MEMORY. */
ambulo_status ambulo__npz_motion(const ambulo__bodies *bodies, const ambulo__source *source,
                                 const ambulo__loads *loads, ambulo__text_buffer *text);

/* ------------------------------------------------------------ markup (markup.c) */

/* `plain` with entities for & < > ", between two pieces of markup. */
void ambulo__markup_text(ambulo__text_buffer *text, const char *before, const char *plain,
                         const char *after);
/* "<tag>numbers</tag>\n" behind `depth` tabs. */
void ambulo__markup_element(ambulo__text_buffer *text, int depth, const char *tag,
                            const double *values, int count);
/* The numbers with spaces between them, between two pieces of markup. */
void ambulo__markup_numbers(ambulo__text_buffer *text, const char *before, const double *values,
                            int count, const char *after);
void ambulo__markup_tabs(ambulo__text_buffer *text, int depth);

/* --------------------------------------------- joints that follow (coupled_text.c) */

/* 1: joint i of a body follows the coordinate of another body's joint; in OpenSim it then has one
 * of its own, named after its link. */
int ambulo__follows_elsewhere(const ambulo__export_body *body, const ambulo_model *model, int i);
/* The name of what moves joint i in OpenSim. */
void ambulo__mover_name(const ambulo__export_body *body, const ambulo_model *model, int i,
                        ambulo__text_buffer *text);
/* The function by which joint i depends on that. */
void ambulo__mover_function(const ambulo__export_body *body, const ambulo_model *model, int i,
                            ambulo__text_buffer *text);
/* <CoordinateCouplerConstraint> of joints that follow elsewhere. */
void ambulo__export_couplers(const ambulo__bodies *bodies, ambulo__text_buffer *text);
/* <mimic> of a URDF. */
void ambulo__export_mimic(const ambulo_model *model, int link, ambulo__text_buffer *text);
/* Where joints follow, an array of a robot's coordinates, a curve in a URDF, and a device at what
 * is followed have no counterpart. */
ambulo_status ambulo__coupled_check(const ambulo_model *model, const ambulo_export_options *options,
                                    ambulo_diagnostics *diagnostics);
/* 1: the joint of a link is no straight line of what it follows: a URDF cannot have it. */
int ambulo__is_curved(const ambulo_link *link);

/* ----------------------------------------------- models as text (model_text.c) */

/* First characters of an OpenSim model and of a URDF that ambulo wrote, behind the declaration. */
#define AMBULO__XML_MARK "<!-- ambulo "

/* <OpenSimDocument> of ambulo__bodies_merged. */
void ambulo__export_osim(const ambulo__bodies *bodies, ambulo__text_buffer *text);
/* <robot> of ambulo__bodies_single. */
void ambulo__export_urdf(const ambulo__bodies *bodies, ambulo__text_buffer *text);
/* The name of a body in the file: the ground's is the program's own. */
const char *ambulo__export_name(const ambulo__bodies *bodies, int body);

/* Angles of R = Rot_x(a) Rot_y(b) Rot_z(c), rad: OpenSim's orientations. */
void ambulo__xyz_of_rotation(const double rotation[3][3], double angles[3]);

#endif
