/* linear/sparse_rows.h - gradients of a set of rows, compressed.
 *
 * Row i of the set is row[i] of the problem times scale[i] (a negative scale turns
 * "c >= 0" into "excess <= 0"). Its columns all lie in the window of unknowns of one
 * node, host[i], so that J'WJ is banded; border rows have no host (-1).
 *
 *     value of row i    s_i c_row[i](x)
 *     gradient          s_i dc/dx, entries start[i] .. start[i + 1) of column and value
 *
 * Few of the inequalities are ever active. Those on one node keep their slopes by its motion
 * (row_blocks.h), and have entries when these are asked for: ambulo__sparse_rows_gradient.
 *
 * The pattern is structural (mechanics/plan.h and the basis), fixed at creation. Rows on
 * q, qd, qdd and unknowns alone have constant gradients and are filled once.
 */
#ifndef AMBULO_LINEAR_SPARSE_ROWS_H
#define AMBULO_LINEAR_SPARSE_ROWS_H

#include "linear/pool.h"
#include "linear/row_blocks.h"
#include "problem/callbacks.h"
#include "problem/nlp.h"

/* Whether long work is to end, asked now and then. */
typedef struct ambulo__poll {
  int (*ask)(void *user); /* 1: the work is to end. NULL: never */
  void *user;
} ambulo__poll;

typedef struct ambulo__sparse_rows {
  const ambulo_problem *problem;
  int count;
  int *row, *host, *constant;
  double *scale;
  int *start;   /* [count + 1] */
  int *support; /* columns of one control point, where they are those of each of the host's; else 0
                 */
  int *column;
  int *run_end;   /* of each entry: where the run of consecutive columns that it is in ends */
  double *value;  /* of row i: ambulo__sparse_rows_gradient */
  int *stale;     /* 1 of rows whose entries are not those of the slopes kept; NULL: of none */
  double *dense;  /* [variables + one window]: scratch for one gradient */
  double *slopes; /* [3][d]: scratch for those of one row */
  ambulo__row_blocks *blocks; /* for products; NULL: by the gradients */
} ambulo__sparse_rows;

/* rows[count] with scale 1. Constant gradients are filled by the first fill. `poll` may be NULL.
 * E_MEMORY; E_LIMIT: it said that the work is to end. */
ambulo_status ambulo__sparse_rows_create(const ambulo_problem *problem, const int *rows, int count,
                                         const ambulo__poll *poll, ambulo__pool *pool,
                                         ambulo__sparse_rows *out);
/* Lays out for products what has been created, and is not filled yet. E_MEMORY. */
ambulo_status ambulo__sparse_rows_lay_blocks(ambulo__sparse_rows *rows, ambulo__pool *pool);
/* Writes run_end from start and column. */
void ambulo__sparse_rows_find_runs(ambulo__sparse_rows *rows);
/* Gradients at the point held (ambulo__evaluate_jacobian); `all` includes constant ones.
 * E_NUMERIC: an entry is not finite (workspace->fault). */
ambulo_status ambulo__sparse_rows_fill(ambulo__sparse_rows *rows, ambulo_workspace *workspace,
                                       int all);
/* Writes the entries of a row that is stale. */
void ambulo__sparse_rows_expand(const ambulo__sparse_rows *rows, int i);
/* The entries of row i: value + start[i]. */
static inline const double *ambulo__sparse_rows_gradient(const ambulo__sparse_rows *rows, int i) {
  if (rows->stale && rows->stale[i]) ambulo__sparse_rows_expand(rows, i);
  return rows->value + rows->start[i];
}
/* Sets scale[i] and rescales the gradients held. */
void ambulo__sparse_rows_set_scale(ambulo__sparse_rows *rows, int i, double scale);
/* value[count] at the point held. */
void ambulo__sparse_rows_values(const ambulo__sparse_rows *rows, const ambulo_workspace *workspace,
                                double *value);
/* out = J d */
void ambulo__sparse_rows_multiply(const ambulo__sparse_rows *rows, const double *d, double *out);
/* y += factor J' w */
void ambulo__sparse_rows_add_transpose(const ambulo__sparse_rows *rows, double factor,
                                       const double *w, double *y);
/* Euclidean norm of gradient i. */
double ambulo__sparse_rows_norm(const ambulo__sparse_rows *rows, int i);

/* The node whose window holds every unknown that the row depends on; -1: none. */
int ambulo__row_host(const ambulo_problem *problem, int row);

#endif
