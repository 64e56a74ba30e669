/* linear/row_blocks.h - products of the rows of each node by its motion.
 *
 * A row on one node k depends on the unknowns through the motion there,
 *
 *     J_i d = y_i . m_k,    m_k = (q, qd, qdd)(d) at the node, 3 d numbers, y_i the row's slopes:
 *
 * less than the gradient has, span d, and for rows on places alone a third of it. m_k is formed
 * once for all rows of the node. Slopes stand side by side, [of the motion][of the rows], so that
 * one vector holds the same slope of eight rows (band_kernels.h). Of a limit of one coordinate one
 * number of the motion is left.
 */
#ifndef AMBULO_LINEAR_ROW_BLOCKS_H
#define AMBULO_LINEAR_ROW_BLOCKS_H

#include "linear/band_kernels.h"
#include "linear/pool.h"
#include "problem/nlp.h"

/* What is known of a row beforehand. */
typedef struct ambulo__row_shape {
  int host;
  int orders; /* 1 of q alone, 3 of q, qd and qdd; 0: of one number of the motion, or none */
  int entry;  /* that number, 0 .. 3 d - 1; -1: the row is none of these */
  double coefficient; /* times it */
  int support;        /* coordinates that it depends on, */
  const int *column;  /* and their unknowns at the first control point, ascending */
} ambulo__row_shape;

/* Rows of one node that depend on as many of q, qd and qdd. */
typedef struct ambulo__row_block {
  int node, orders;
  int count, width; /* rows; whole tiles */
  int first;        /* in `member` */
  int support;      /* coordinates that any of the rows depends on, */
  int *coordinate;  /* and which, ascending */
  int *place;       /* [d]: theirs among these */
  double *slope;    /* [orders][support][width]; beyond the rows zero */
} ambulo__row_block;

typedef struct ambulo__row_blocks {
  const ambulo_problem *problem;
  const ambulo__band_kernels *kernels; /* of this processor */
  int count;
  ambulo__row_block *block; /* ascending nodes */
  int *member;              /* rows, block by block */
  int *block_of, *place_of; /* [rows]: -1: in none */
  int *limit_first;         /* [nodes + 1]: the rows of one number of each node, in `limit` */
  int *limit;
  ambulo__row_shape *shape;        /* [rows] */
  double *motion, *part, *product; /* [3 d], [3 d] of a block, [widest] */
} ambulo__row_blocks;

/* For a set of rows whose columns are there. E_MEMORY. */
struct ambulo__sparse_rows;
ambulo_status ambulo__row_blocks_create(const struct ambulo__sparse_rows *rows, ambulo__pool *pool,
                                        ambulo__row_blocks *blocks);
/* Keeps slopes [3 d] of a row that is in a block. */
void ambulo__row_blocks_keep(ambulo__row_blocks *blocks, int row, const double *slopes);
/* Those kept: slopes [orders][support], both of the row. */
void ambulo__row_blocks_recall(const ambulo__row_blocks *blocks, int row, double *slopes);
/* Whether all that is kept is finite. */
int ambulo__row_blocks_finite(const ambulo__row_blocks *blocks);
/* 1 of a row whose product is found here. */
static inline int ambulo__row_blocks_have(const ambulo__row_blocks *blocks, int row) {
  return blocks->shape[row].orders > 0 || blocks->shape[row].entry >= 0;
}
/* out = scale (J d) of these; of the others nothing is written. */
void ambulo__row_blocks_multiply(const ambulo__row_blocks *blocks, const double *scale,
                                 const double *d, double *out);

#endif
