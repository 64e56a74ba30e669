/* compare/compare_cycle.h - a result folder seen as one gait cycle of each foot.
 *
 * Percent p of a foot's cycle is the time  strike + p / 100 * length.  A motion is taken as
 * periodic over what the file holds; between its times it is interpolated by cubic Hermite
 * pieces whose slopes are those of the parabola through three neighbours. */
#ifndef AMBULO_COMPARE_COMPARE_CYCLE_H
#define AMBULO_COMPARE_COMPARE_CYCLE_H

#include "ambulo/report.h"
#include "compare/compare_map.h"

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
} ambulo__cycle;

/* Reads motion.csv and summary.json of a folder and finds the strikes: the option, else what the
 * summary says, else the onset of the vertical force, else 0 for the left foot. Errors: E_IO,
 * E_PARSE, E_SCHEMA, E_MEMORY. Fills *cycle, which ambulo__cycle_close releases. */
ambulo_status ambulo__cycle_open(const char *directory, const ambulo_compare_options *options,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 ambulo__cycle *cycle);
void ambulo__cycle_close(ambulo__cycle *cycle); /* accepts a zero-filled one */

/* The curve of one side at percents[count], in the unit of the entry, without the pelvic tilt.
 * *found = 0 (values untouched) when the motion has no such column, or the mass is not known but
 * needed. Errors: E_SCHEMA (a cell is no number). */
ambulo_status ambulo__cycle_curve(ambulo__cycle *cycle, const ambulo__map_entry *entry,
                                  ambulo__cycle_side side, const double *percents, int count,
                                  double *values, int *found);

/* The samples of a result expression for one side, [rows], SI units. */
ambulo_status ambulo__cycle_samples(ambulo__cycle *cycle, const char *expression,
                                    ambulo__cycle_side side, double *values, int *found);

#endif
