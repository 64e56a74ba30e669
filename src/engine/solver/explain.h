/* solver/explain.h - why a solve ended without a solution.
 *
 * Parts: relax.c (which families are in conflict, what each would have to give), suggest.c
 * (one suggestion), explain_lines.c (words), explain.c (everything else).
 */
#ifndef AMBULO_SOLVER_EXPLAIN_H
#define AMBULO_SOLVER_EXPLAIN_H

#include "solver/elastic.h"
#include "method/engine.h"
#include "solver/result.h"

enum {
  AMBULO__MOST_CONTRADICTIONS = 6,
  AMBULO__MOST_CONFLICTS = 8,
  AMBULO__MOST_ON_LIMITS = 12,
  AMBULO__MOST_LINES = 80, /* more than all of these can make */
  AMBULO__MOST_SETTINGS = 3,
  AMBULO__LINE_SIZE = 360
};

/* Violation that counts as none, relative to the row's size, while a family gives way. */
#define AMBULO__HOLDS 1e-4

/* The public view and the memory it points into. */
typedef struct ambulo__explanation {
  ambulo_explanation view;
  ambulo_violation contradictory[AMBULO__MOST_CONTRADICTIONS];
  ambulo_conflict conflict[AMBULO__MOST_CONFLICTS];
  int conflict_row[AMBULO__MOST_CONFLICTS]; /* a row of the family in conflict */
  ambulo_on_limit on_limit[AMBULO__MOST_ON_LIMITS];
  const ambulo__table_row *on_limit_row[AMBULO__MOST_ON_LIMITS]; /* one that each stands for */
  const char *line[AMBULO__MOST_LINES];
  char text[AMBULO__MOST_LINES][AMBULO__LINE_SIZE];
  char suggestion[AMBULO__LINE_SIZE];
  const char *settings[AMBULO__MOST_SETTINGS];
  char setting[AMBULO__MOST_SETTINGS][AMBULO__LINE_SIZE];
} ambulo__explanation;

/* What relax.c leaves for suggest.c: the family that gives way most easily. */
typedef struct ambulo__remedy {
  int conflict;  /* index, -1: no family suffices alone */
  int row;       /* worst row of it */
  double *value; /* [rows] of the problem where it gives way */
  int single;    /* 1: only rows like this one give way there, not the rest of the family */
} ambulo__remedy;

/* Fills result->explanation for the verdicts infeasible and limit; nothing for others.
 * `engine`'s workspace is used. E_MEMORY. */
ambulo_status ambulo__explain(ambulo__engine *engine, ambulo_result *result);

/* relax.c: x is moved to a minimum of all violations; conflicts, feasible_point, complete are
 * filled; the workspace ends at x. E_MEMORY. */
ambulo_status ambulo__relax(ambulo__elastic *elastic, double tolerance, double *x,
                            ambulo__pool *pool, ambulo__explanation *out, ambulo__remedy *remedy);

/* suggest.c: writes out->suggestion. */
void ambulo__suggest(const ambulo_problem *problem, const ambulo__remedy *remedy,
                     ambulo__explanation *out);

/* explain_task.c: lines about a gait that is no walk; none about one that may be. */
void ambulo__explain_task(const ambulo_problem *problem, ambulo__explanation *out);

/* explain_lines.c: one more line, and all lines from everything else. */
void ambulo__explain_line(ambulo__explanation *out, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void ambulo__explain_lines(const ambulo_problem *problem, const ambulo_result *result,
                           ambulo__explanation *out);

#endif
