/* method/multipliers.h - multipliers of one solve, for another.
 *
 * The multiplier of a row that holds all along is a density over time, times the time of its node.
 * Taken as such from another grid, another duration or another problem, linear in time between its
 * nodes, it tells which rows carry a force, and how much.
 */
#ifndef AMBULO_METHOD_MULTIPLIERS_H
#define AMBULO_METHOD_MULTIPLIERS_H

#include "ambulo/again.h"
#include "method/engine.h"

typedef struct ambulo__multiplier {
  unsigned long long series; /* the same for rows of one family, subject and detail */
  double time;               /* share of the duration */
  double density;            /* 1/s, objective not scaled; of rows outside of time not per second */
} ambulo__multiplier;

struct ambulo_multipliers {
  ambulo_allocator allocator;
  ambulo__multiplier *row; /* [count], by series and time */
  int count;
  double interval;  /* longest between nodes, share of the duration */
  double objective; /* where they are from, not scaled */
  int periods;      /* in the motion that they are for */
  int mirrored;     /* every other of them is a mirror image */
};

/* With room for `count`. E_MEMORY. */
ambulo_status ambulo__multipliers_allocate(int count, const ambulo_allocator *allocator,
                                           ambulo_multipliers **multipliers);
/* Brings the rows into their order. */
void ambulo__multipliers_sort(ambulo_multipliers *multipliers);
/* The series of a row with these labels. */
unsigned long long ambulo__multiplier_series(const char *family, const char *subject,
                                             const char *detail);

/* Of the inequalities among a problem's rows, [rows], objective not scaled: rows without a force
 * end the density of those beside them. E_MEMORY. */
ambulo_status ambulo__multipliers_create(const ambulo_problem *problem, const double *by_row,
                                         double objective, const ambulo_allocator *allocator,
                                         ambulo_multipliers **multipliers);
/* Multipliers of an engine by rows of its problem, not scaled: [rows]. */
void ambulo__multipliers_keep(const ambulo__engine *engine, double *by_row);
void ambulo__multipliers_take(ambulo__engine *engine, const double *by_row);

/* Those that an engine ended with; of its inequalities. E_MEMORY. */
ambulo_status ambulo__multipliers_save(const ambulo__engine *engine,
                                       const ambulo_allocator *allocator,
                                       ambulo_multipliers **multipliers);
/* Sets the engine's multipliers; what the others have no rows for starts at zero. NULL: nothing. */
void ambulo__multipliers_transfer(const ambulo_multipliers *multipliers, ambulo__engine *engine);

/* As they are `share` of the duration later. */
void ambulo__multipliers_shift(ambulo_multipliers *multipliers, double share);

#endif
