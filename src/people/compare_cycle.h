/* people/compare_cycle.h - a result folder seen as one gait cycle of each foot, a person's own
 * motion as several.
 *
 * Percent p of a foot's cycle is the time  strike + p / 100 * length.  A result is taken as
 * periodic over what the file holds; between its times it is interpolated by cubic Hermite
 * pieces whose slopes are those of the parabola through three neighbours. */
#ifndef AMBULO_PEOPLE_COMPARE_CYCLE_H
#define AMBULO_PEOPLE_COMPARE_CYCLE_H

#include "ambulo/tools/report.h"
#include "ambulo/tools/compare.h"
#include "people/compare_map.h"
#include "people/compare_subject.h"

typedef enum ambulo__cycle_side { AMBULO__CYCLE_LEFT, AMBULO__CYCLE_RIGHT } ambulo__cycle_side;

typedef struct ambulo__cycle {
  ambulo_allocator allocator;
  ambulo_diagnostics *diagnostics;
  char *motion_path, *summary_path;
  ambulo__sheet sheet;         /* motion.csv; line 0 is its header */
  int rows;                    /* times */
  double *time;                /* [rows], s, rising */
  double *scratch;             /* [4][rows] */
  double strike[2], length[2]; /* s, by side */
  double mass, gravity;        /* kg, m/s^2; mass 0: not known */
  double up[3], forward[3];
  int warned_open;
  int told_strikes, told_gait; /* by the summary: how many strikes; 1: the motion is a gait */
  ambulo__subject *subject;    /* a person's own motion: in place of sheet, strike and length */
} ambulo__cycle;

/* Reads motion.csv and summary.json of a folder (of a file: ambulo__cycle_open_subject) and finds
 * the strikes: the option, else what the summary says, else the onset of the vertical force, else 0
 * for the left foot. Errors: E_IO, E_PARSE, E_SCHEMA, E_MEMORY. Fills *cycle, which
 * ambulo__cycle_close releases. */
ambulo_status ambulo__cycle_open(const char *directory, const ambulo_compare_options *options,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 ambulo__cycle *cycle);
/* Of the file of a person's own motion (compare_subject.h), with its errors. */
ambulo_status ambulo__cycle_open_subject(const char *file, const ambulo_compare_options *options,
                                         const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics, ambulo__cycle *cycle);
void ambulo__cycle_close(ambulo__cycle *cycle); /* accepts a zero-filled one */

/* The curve of one side at percents[count], in the unit of the entry, without the pelvic tilt: the
 * mean over the strides, and of their squares in squares[count] (NULL: not wanted). *strides: one
 * of a result, those between strikes of a person's own motion, and of its forces those that are
 * loaded; 0 (values untouched) when the motion has no such column, or the mass is not known but
 * needed. Errors: E_SCHEMA (a cell is no number). */
ambulo_status ambulo__cycle_spread(ambulo__cycle *cycle, const ambulo__map_entry *entry,
                                   ambulo__cycle_side side, const double *percents, int count,
                                   double *values, double *squares, int *strides);

/* The samples of a result expression for one side, [rows], SI units. */
ambulo_status ambulo__cycle_samples(ambulo__cycle *cycle, const char *expression,
                                    ambulo__cycle_side side, double *values, int *found);

#endif
