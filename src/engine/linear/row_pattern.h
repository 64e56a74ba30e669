/* linear/row_pattern.h - the unknowns that a row depends on.
 *
 * A channel of a node depends on the motion of some coordinates there, and so on all control points
 * of the node in these coordinates. Most rows stand on channels of one node, their host: their
 * columns are the same coordinates at each of its control points.
 */
#ifndef AMBULO_LINEAR_ROW_PATTERN_H
#define AMBULO_LINEAR_ROW_PATTERN_H

#include "linear/pool.h"
#include "problem/nlp.h"

/* The node whose window holds every unknown that the row depends on; -1: none. */
int ambulo__row_host(const ambulo_problem *problem, int row);

typedef struct ambulo__row_pattern {
  const ambulo_problem *problem;
  unsigned char *known;   /* [channels]: whether the next is filled */
  unsigned char *channel; /* [channels][d]: 1 for the coordinates that a channel depends on */
  unsigned char *mark;    /* [variables]: scratch for one row */
} ambulo__row_pattern;

/* E_MEMORY. */
ambulo_status ambulo__row_pattern_create(const ambulo_problem *problem, ambulo__pool *pool,
                                         ambulo__row_pattern *pattern);
/* *count columns of a row, ascending, into `column` (NULL: they are only counted). Returns how many
 * of them belong to each control point, where these are the same for all of the host's; else 0. */
int ambulo__row_pattern_columns(ambulo__row_pattern *pattern, int row, int host, int *column,
                                int *count);

#endif
