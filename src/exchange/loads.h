/* exchange/loads.h - all that pushes or pulls at the bodies of a motion.
 *
 * Feet and hands as inverse dynamics has them (motion_source.h); of a problem also patches that
 * press on something and devices, from the columns of its motion.csv. A device is a pair of loads
 * that add up to nothing. */
#ifndef AMBULO_EXCHANGE_LOADS_H
#define AMBULO_EXCHANGE_LOADS_H

#include "exchange/bodies.h"
#include "exchange/motion_source.h"
#include "problem/nlp.h"

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
  int body;                         /* of bodies.h; -1: the ground, which nothing moves */
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
 * motion has and cannot be carried over is told. Errors: E_MEMORY. */
ambulo_status ambulo__loads_create(const ambulo__bodies *bodies, const ambulo_problem *problem,
                                   ambulo__source *source, ambulo_diagnostics *diagnostics,
                                   ambulo__loads *loads);
void ambulo__loads_free(ambulo__loads *loads); /* accepts a zero-filled one */

/* Columns of a load are called force_NAME_v., force_NAME_p., torque_NAME_., behind this. */
const char *ambulo__load_prefix(const ambulo__export_load *load);

/* ------------------------------------------------------ devices (device_loads.c) */

/* The body of an end of a device, 0: the one that its coordinate moves, or its first point's. */
int ambulo__device_end(const ambulo__bodies *bodies, const ambulo_device *device, int end);
/* Force, its point and the torque on that end, for an effort; frames [links][12] of the pose. */
void ambulo__device_load(const ambulo__bodies *bodies, const ambulo_device *device, int end,
                         const double *frames, double effort, double force[3], double point[3],
                         double torque[3]);

#endif
