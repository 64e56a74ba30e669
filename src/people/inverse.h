/* people/inverse.h - the inside of an inverse dynamics of a file (ambulo/tools/inverse.h). */
#ifndef AMBULO_PEOPLE_INVERSE_H
#define AMBULO_PEOPLE_INVERSE_H

#include "ambulo/tools/inverse.h"
#include "base/alloc.h"
#include "base/diagnostics.h"
#include "formats/motion_file.h"
#include "people/ground_load.h"
#include "people/hand_load.h"

typedef struct ambulo__inverse {
  ambulo_allocator allocator;
  const ambulo_model *model;
  ambulo_inverse_options options;
  const char *file;
  ambulo__doubts doubts;
  ambulo__motion *given;       /* as in the file, but for its times, which are in s */
  ambulo__motion *force_table; /* of the file of forces; NULL: the motion's own, or none */
  int rows;
  /* [rows][d]; rates and accelerations: of the file, or of a spline */
  double *q, *qd, *qdd;
  /* [d]: the file has it, and it is used */
  unsigned char *has_value, *has_rate, *has_acceleration;
  double *tau, *power;  /* [rows][d], N m or N, W */
  double *wrench, *zmp; /* [rows][6], [rows][3] */
  double *residual;     /* [rows][6]; only with forces, like the rest */
  double *cop, *free_moment;
  ambulo__ground_load load;
  ambulo__load_poses poses;
  ambulo__hand_load hands;
} ambulo__inverse;

/* Reads the motion (inverse_motion.c): given, rows, q, qd, qdd and what the file has; filters.
 * Doubts about units, rates and the body are warnings. Errors: those of ambulo__motion_read,
 * E_SCHEMA, E_NUMERIC, E_MEMORY. */
ambulo_status ambulo__inverse_read(ambulo__inverse *v);

/* inverse_span.c: leaves the rows from options.from to options.to, and of them those at which there
 * are forces, where that is not all of them, with a doubt. Errors: E_SCHEMA (none are left). */
ambulo_status ambulo__inverse_take_span(ambulo__inverse *inverse);
ambulo_status ambulo__inverse_take_covered(ambulo__inverse *inverse);

/* ------------------------------------------------------ doubts (plausibility.c) */

/* Values that hardly are in radians and metres, rows that hardly are that many seconds apart. */
void ambulo__doubt_units(ambulo__inverse *v);
/* Rates and accelerations, once they are known, against the slopes of splines through the values
 * and through the rates [rows][d], NULL: none; and speeds. */
void ambulo__doubt_rates(ambulo__inverse *v, const double *of_values, const double *of_rates);
/* Forces that act far from their foot, and what they leave over. */
void ambulo__doubt_loads(ambulo__inverse *v, const char *forces,
                         const ambulo_ground_residual *residual);

#endif
