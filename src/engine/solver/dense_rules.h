/* solver/dense_rules.h - what is asked of a motion between its nodes, family by family: the one
 * table of tolerances (docs/results.md and include/ambulo/solve.h repeat it). */
#ifndef AMBULO_SOLVER_DENSE_RULES_H
#define AMBULO_SOLVER_DENSE_RULES_H

#include "problem/nlp.h"

enum { AMBULO__DENSE_RULES = 24 };

/* What helps where more intervals do not. */
typedef enum ambulo__dense_remedy {
  AMBULO__REMEDY_NONE,
  AMBULO__REMEDY_CONTROL_POINTS, /* joint limits on the control points */
  AMBULO__REMEDY_TOLERANCE,      /* contacts within a tolerance, then more time intervals */
  AMBULO__REMEDY_TRANSFER        /* a load that passes gradually from foot to foot */
} ambulo__dense_remedy;

typedef struct ambulo__dense_rule {
  ambulo__row_kind kind;
  ambulo__measure measure; /* AMBULO__OTHER_MEASURE: any */
  double tolerance;        /* in that, or a share of the limit */
  /* Where two nodes hold a row its ratio goes down with this power of the number of time intervals,
   * at least: with the trajectory's kept; with the trajectory's in proportion. 0: it need not go
   * down at all. */
  double order_alone, order_both;
  /* Beside an event it goes down with the gap to the node: where a contact ends to the first
   * power, where it begins to this one. */
  double order_landing;
  int of_limit;  /* 1: the tolerance is a share */
  int at_events; /* 1: its rows change when a contact begins or ends */
  ambulo__dense_remedy remedy;
} ambulo__dense_rule;

/* 0 <= index < AMBULO__DENSE_RULES */
const ambulo__dense_rule *ambulo__dense_rule_at(int index);
/* The rule of a row; -1: rows on the ends, the same on every grid, and rows of the caller, which
 * are not asked between the nodes. */
int ambulo__dense_rule_of_row(const ambulo__table_row *row);
/* The rules of what no row covers. */
int ambulo__dense_rule_of_slip(void);
int ambulo__dense_rule_of_force(void);

/* What the violation of a row of limits is compared with: the larger of the coordinate's two
 * bounds. Where both are zero: 1 rad/s or 1 m/s; the body weight, times 0.1 m for a torque. The row
 * belongs to `problem`. */
double ambulo__dense_limit_size(const ambulo_problem *problem, const ambulo__table_row *row);

#endif
