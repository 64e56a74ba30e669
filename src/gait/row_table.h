/* gait/row_table.h - constraint rows as linear forms on channels.
 *
 *     value_r = constant_r + sum_t coefficient_t * channel_t(node_t)
 *
 * Every row of the gait problem has this form once the moment equation of the ZMP is
 * written without the division (Eq. 17'). A term may instead stand on one unknown
 * (node = -1, channel = index into x): control-point bounds.
 *
 * Modules append rows here, in physical units; nlp gives them numbers.
 */
#ifndef AMBULO_GAIT_ROW_TABLE_H
#define AMBULO_GAIT_ROW_TABLE_H

#include "ambulo/problem.h"
#include "base/alloc.h"

typedef struct ambulo__row_term {
  int node; /* -1: `channel` is the index of an unknown */
  int channel;
  double coefficient;
} ambulo__row_term;

typedef struct ambulo__table_row {
  const char *family;  /* static text */
  const char *subject; /* a name that lives in the model (or static text) */
  const char *detail;  /* static text */
  const char *unit;    /* static text */
  ambulo_relation relation;
  int node; /* the node whose channels it uses; -1: several, or none */
  double time;
  double constant;
  double size; /* in unit: what counts as one; violations are judged relative to it */
  int first_term, term_count;
  int user; /* index of the caller's user row, whose value and coefficients come
               from its function at every evaluation; -1: linear, as above */
} ambulo__table_row;

typedef struct ambulo__row_table {
  ambulo_allocator allocator;
  ambulo__table_row *rows;
  int row_count, row_capacity;
  ambulo__row_term *terms;
  int term_count, term_capacity;
  double weight;        /* of the body, N: what forces are measured by; 1 after init */
  ambulo_status status; /* sticky: E_MEMORY once an append failed, E_INTERNAL for a form that
                           overflowed */
} ambulo__row_table;

void ambulo__row_table_init(ambulo__row_table *table, const ambulo_allocator *allocator);
void ambulo__row_table_clear(ambulo__row_table *table);
/* Starts a row (its terms follow by ambulo__row_term_add). */
void ambulo__row_begin(ambulo__row_table *table, const char *family, const char *subject,
                       const char *detail, const char *unit, ambulo_relation relation, int node,
                       double time, double constant);
/* The size of a row of this unit, which ambulo__row_begin gives it: 1 m (a leg is .9), 1 rad, 1
 * body weight; the body weight of N, times 1 m of N m (what a step asks of the hips and ankles
 * together); 10 m/s and rad/s (a swinging knee turns at 7); 100 m/s^2 and rad/s^2; 1 of anything
 * else. */
double ambulo__unit_size(const ambulo__row_table *table, const char *unit);
/* Adds a term to the row begun last. Zero coefficients are skipped. */
void ambulo__row_term_add(ambulo__row_table *table, int node, int channel, double coefficient);

#endif
