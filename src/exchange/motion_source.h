/* exchange/motion_source.h - a motion with its torques and forces, as inverse dynamics has them.
 *
 * Read by ambulo_inverse_dynamics_motion (ambulo/tools/inverse.h), so that what is exported is what
 * `ambulo inverse` says: units, filters, rates, forces of feet and their points. */
#ifndef AMBULO_EXCHANGE_MOTION_SOURCE_H
#define AMBULO_EXCHANGE_MOTION_SOURCE_H

#include "ambulo/tools/inverse.h"
#include "base/alloc.h"
#include "base/diagnostics.h"
#include "formats/motion_file.h"

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

#endif
