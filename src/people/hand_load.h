/* people/hand_load.h - what hands hold or push, applied to an inverse dynamics.
 *
 * Columns, as motion.csv has them (docs/results.md): of each hand, a point p of the model, the
 * force f that it exerts, and the moment m about p,
 *
 *     held.LOAD.POINT.force.x|y|z       held.LOAD.POINT.moment.x|y|z
 *
 * and of each load held.LOAD.power, which is computed anew. The hand has -f and -m on it. So the
 * generalized force of each coordinate between hand and world, with axis z through o, gets
 *
 *     revolute   z . (m + (p - o) x f)        prismatic   z . f
 *
 * and the root wrench that the surroundings must supply (p x f + m, f) (ambulo/hold.h has the law
 * that gave f and m). The power of the forces is sum_i qd_i of that without m. Between rows of
 * another file f and m are linear in time. */
#ifndef AMBULO_PEOPLE_HAND_LOAD_H
#define AMBULO_PEOPLE_HAND_LOAD_H

#include "ambulo/hold.h"
#include "people/ground_load.h"

typedef struct ambulo__hand_load {
  ambulo_allocator allocator;
  int rows, loads;
  ambulo_hold *hold;      /* [loads]: name and hands; of one hand, the second is -1 */
  double *force, *moment; /* [rows][loads][2][3], N, N m about the hand's point */
  double *power;          /* [rows][loads], W; after ambulo__hand_load_apply */
} ambulo__hand_load;

/* 1: the table has such columns. */
int ambulo__has_hand_loads(const ambulo__motion *table);

/* The hand of a column "held.LOAD.POINT.force.x", a point of the model, and how long "LOAD.POINT"
 * is, which begins behind "held."; -1: it is no such column. */
int ambulo__hand_of_column(const ambulo_model *model, const char *column, size_t *length);

/* Loads at times[rows]; what is doubted: columns of no point of the model, or of nothing that is
 * known, which are left out; components without a column, which are zero. Errors: E_SCHEMA (three
 * hands, nan, times that are not covered), E_MEMORY, those of a filter. Fills *load, which
 * ambulo__hand_load_free releases. */
ambulo_status ambulo__hand_load_read(const ambulo__load_source *source,
                                     const ambulo_allocator *allocator, ambulo__hand_load *load);
void ambulo__hand_load_free(ambulo__hand_load *load); /* accepts a zero-filled one */

/* tau [rows][d] and wrench [rows][6] (M, F) get their parts, and load->power is filled; q, qd
 * [rows][d]. E_MEMORY. */
ambulo_status ambulo__hand_load_apply(ambulo__hand_load *load, const ambulo_model *model,
                                      const double *q, const double *qd, double *tau,
                                      double *wrench);

#endif
