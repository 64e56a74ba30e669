/* contact/row_table.h - constraint rows as linear forms on channels.
 *
 *     value_r = constant_r + sum_t coefficient_t * channel_t(node_t)
 *
 * Every row of the gait problem has this form once the moment equation of the ZMP is
 * written without the division (Eq. 17'). A term may instead stand on one unknown
 * (node = -1, channel = index into x): control-point bounds. Curved rows (contact/curved.h)
 * and those of the caller are functions of one node's channels.
 *
 * Modules append rows here, in physical units; nlp gives them numbers.
 */
#ifndef AMBULO_CONTACT_ROW_TABLE_H
#define AMBULO_CONTACT_ROW_TABLE_H

#include "ambulo/problem.h"
#include "base/alloc.h"
#include "contact/curved.h"
#include "contact/row_kind.h"

typedef struct ambulo__row_term {
  int node; /* -1: `channel` is the index of an unknown */
  int channel;
  double coefficient;
} ambulo__row_term;

typedef struct ambulo__table_row {
  const char *family;  /* text of the kind, or the caller's name */
  const char *subject; /* a name that lives in the model (or static text) */
  const char *detail;  /* static text, or a name that lives in the model or the problem */
  const char *unit;    /* text of the measure, or the caller's */
  /* small ambulo__row_kind, ambulo__measure, ambulo_relation: rows are many */
  unsigned char kind, measure, relation;
  unsigned char before; /* 1: it is about what the feet did just before its node, on an event */
  int group;            /* rows of one family have the same; 0 .. group_count - 1 */
  int node;             /* the node whose channels it uses; -1: several, or none */
  int user;             /* value and coefficients come from a function at every evaluation: index of
                           the caller's user row, of the table's curved row, by kind; -1: linear, as
                           above */
  double time;
  double constant;
  double size; /* in unit: what counts as one; violations are judged relative to it */
  int first_term, term_count;
} ambulo__table_row;

typedef struct ambulo__row_table {
  ambulo_allocator allocator;
  ambulo__table_row *rows;
  int row_count, row_capacity;
  ambulo__row_term *terms;
  int term_count, term_capacity;
  ambulo__curved *curved;
  int curved_count, curved_capacity;
  int *group_row; /* the first row of each group, in the order in which groups begin */
  int group_count, group_capacity;
  int before;           /* what rows begun from now on have of that name; 0 after init */
  double weight;        /* of the body, N: what forces are measured by; 1 after init */
  ambulo_status status; /* sticky: E_MEMORY once an append failed, E_INTERNAL for a form that
                           overflowed */
} ambulo__row_table;

void ambulo__row_table_init(ambulo__row_table *table, const ambulo_allocator *allocator);
void ambulo__row_table_clear(ambulo__row_table *table);
/* Starts a row (its terms follow by ambulo__row_term_add). */
void ambulo__row_begin(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                       const char *detail, ambulo__measure measure, ambulo_relation relation,
                       int node, double time, double constant);
/* Adds the caller's own row number `index` at a node, under the caller's name and unit. Names may
 * be those of the table: the row is of AMBULO__KIND_USER all the same. */
void ambulo__row_user(ambulo__row_table *table, const ambulo_user_row *user, int index, int node,
                      double time);
/* Adds a row at a node, not negative, in m, that is a function of an arc; of a point and a segment;
 * of a capsule and what it keeps clear of; of the root wrench. */
void ambulo__row_arc(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                     const char *detail, int node, double time, const ambulo__arc *arc);
void ambulo__row_apart(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                       const char *detail, int node, double time, const ambulo__apart *apart);
void ambulo__row_solid(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                       const char *detail, int node, double time, const ambulo__solid *solid);
void ambulo__row_spin(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                      const char *detail, int node, double time, const ambulo__spin *spin);
/* What a curved row is a function of; NULL: the row is linear, or the caller's. */
static inline const ambulo__curved *ambulo__row_curved_of(const ambulo__row_table *table,
                                                          const ambulo__table_row *row) {
  return row->user >= 0 && row->kind != AMBULO__KIND_USER ? &table->curved[row->user] : NULL;
}
/* The arc of a row; NULL: it has none. */
static inline const ambulo__arc *ambulo__row_arc_of(const ambulo__row_table *table,
                                                    const ambulo__table_row *row) {
  const ambulo__curved *curved = ambulo__row_curved_of(table, row);
  return curved && curved->form == AMBULO__CURVED_ARC ? &curved->of.arc : NULL;
}
/* The capsules of a row; NULL: it has none. */
static inline const ambulo__solid *ambulo__row_solid_of(const ambulo__row_table *table,
                                                        const ambulo__table_row *row) {
  const ambulo__curved *curved = ambulo__row_curved_of(table, row);
  return curved && curved->form == AMBULO__CURVED_SOLID ? &curved->of.solid : NULL;
}
/* Adds a term to the row begun last. Zero coefficients are skipped. */
void ambulo__row_term_add(ambulo__row_table *table, int node, int channel, double coefficient);

/* What is missed at `value`, in the row's unit; infinite where that is not finite. */
double ambulo__row_missed(const ambulo__table_row *row, double value);
/* 1: the two rows of one table say the same of different times. */
int ambulo__rows_alike(const ambulo__table_row *a, const ambulo__table_row *b);

#endif
