/* solver/explain.h - why a solve ended without a solution.
 *
 * Parts: elastic.c (the least violation), relax.c (which families are in conflict, what each would
 * have to give), suggest.c (one suggestion), advice.c (how it is written), explain.c (words, and
 * everything else).
 */
#ifndef AMBULO_SOLVER_EXPLAIN_H
#define AMBULO_SOLVER_EXPLAIN_H

#include "linear/border.h"
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

/* A row that misses by no more than this, relative to its size, is a near miss: no contradiction.
 */
#define AMBULO__NEAR_MISS 1e-3

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

/* Fills result->explanation for the verdicts infeasible and limit; nothing for others. nearest [n]:
 * the least violated point, where one was looked for. `engine`'s workspace is used. E_MEMORY. */
ambulo_status ambulo__explain(ambulo__engine *engine, ambulo_result *result, double *nearest);

/* Lines about a gait that is no walk; none about one that may be. */
void ambulo__explain_task(const ambulo_problem *problem, ambulo__explanation *out);

/* One more line, and all lines from everything else. */
void ambulo__explain_line(ambulo__explanation *out, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void ambulo__explain_lines(const ambulo_problem *problem, const ambulo_result *result,
                           ambulo__explanation *out);

/* ------------------------------------------------------------ elastic rows */

/* elastic.c: the least violation that a problem can be brought to.
 *
 * Every row may give way:
 *
 *     minimize  E(x) = sum_r w_r^2 e_r(x)^2 / 2,   e_r = c_r / s_r             (equality)
 *                                                  e_r = min(0, c_r) / s_r     (inequality)
 *
 * with s_r a size that makes rows of different unit comparable (ambulo__rows_size) and w_r a
 * weight, 1 unless a caller of this header changes it. E = 0: the problem has a feasible point. At
 * a minimum with E > 0 the forces sum w^2 e grad e = 0 balance: the rows that carry them contradict
 * each other, at least near that point.
 */

typedef struct ambulo__elastic {
  const ambulo_problem *problem;
  ambulo_workspace *workspace; /* borrowed */
  ambulo__run *run;            /* borrowed: its progress callback can cancel */
  ambulo__sparse_rows local, border;
  int locals, borders, n;
  ambulo__band base, factor; /* equalities' J'J; with active inequalities and damping */
  ambulo__border bordered;   /* the factor with the active border rows */
  double *size;              /* [rows]: s */
  double *weight;            /* [rows]: w */
  double *linear_local, *linear_border, *along_local, *along_border, *pull;
  int *active_local, *active_border;
  double *step, *total, *right, *trial; /* [n] */
  double work, deadline;                /* model steps done; where to stop */
  double time_limit;                    /* s, monotonic clock: the end of the solve's own limit */
  int cancelled;
} ambulo__elastic;

/* Memory from `pool`. E_MEMORY; E_LIMIT when too many rows couple distant unknowns. */
ambulo_status ambulo__elastic_create(const ambulo_problem *problem, ambulo_workspace *workspace,
                                     ambulo__run *run, ambulo__pool *pool,
                                     ambulo__elastic *elastic);

/* Moves x downhill until E has settled, vanishes, or the deadline is met. 1: settled;
 * 0: out of steps or time, cancelled, or no finite value at x. */
int ambulo__elastic_minimize(ambulo__elastic *elastic, double *x);

/* 1 when the steps or the time are used up or the caller's callback said stop. */
int ambulo__elastic_over(ambulo__elastic *elastic);

/* e_r for the value of row r: violations relative to its size, >= 0. */
double ambulo__elastic_excess(const ambulo__elastic *elastic, int row, double value);

/* ---------------------------------------------------------------- remedies */

/* What relax.c leaves for suggest.c: the family that gives way most easily. */
typedef struct ambulo__remedy {
  int conflict;  /* index, -1: no family suffices alone */
  int row;       /* worst row of it */
  double *value; /* [rows] of the problem where it gives way */
  int single;    /* 1: only rows like this one give way there, not the rest of the family */
} ambulo__remedy;

/* relax.c: x is moved to a minimum of all violations; conflicts, feasible_point, confirmed and
 * complete are filled; the workspace ends at x. What families would have to give is not asked of a
 * near miss, nor where a cap ended the run. E_MEMORY. */
ambulo_status ambulo__relax(ambulo__elastic *elastic, double tolerance, double *x,
                            ambulo__pool *pool, ambulo__explanation *out, ambulo__remedy *remedy);

/* suggest.c: writes out->suggestion. */
void ambulo__suggest(const ambulo_problem *problem, const ambulo__remedy *remedy,
                     ambulo__explanation *out);

/* ------------------------------------------------------------- suggestions */

/* Parts of a suggestion: a sentence, and what to write after --set.
 *
 * With c the value of the worst row where its family gives way alone, and g = |c| what it gives:
 *
 *   limits        y - lo = c or hi - y = c, c < 0: the bound has to move by g
 *   end values    y - value = c: the value that can be reached is value + c
 *   ends          travel that can be reached: travel + c
 *   footholds     missed by c: the spacing that can be reached while two feet are down is
 *                 (place_b + c_b) - (place_a + c_a)
 *   tolerances    |y| <= w missed by g: w + g
 *   friction      mu N - |T| = -g, and N of the contact's own row: mu + g / N
 *
 * These numbers suffice for the rows of that point, which holds all the others within
 * AMBULO__HOLDS. For that, new values leave room for twice as much, at least for a hundredth of g
 * more, and are rounded outward to four figures. Sentences are in SI units and degrees; settings
 * name keys of the problem's file in the file's units, and are given only where the problem was
 * read from one.
 */

typedef struct ambulo__advice {
  const ambulo_problem *problem;
  const ambulo__table_row *row;
  double value, give;   /* of the worst row; give = |value| */
  double room;          /* ... and a little more */
  const double *values; /* [rows] */
  ambulo__explanation *out;
} ambulo__advice;

/* suggest_feet.c, suggest_forces.c, advice.c: each says what helps a row of its kinds; 0: the row
 * is of none of them. */
int ambulo__advise_feet(const ambulo__advice *a);
int ambulo__advise_forces(const ambulo__advice *a);
int ambulo__advise_bodies(const ambulo__advice *a);

/* Writes the sentence. */
void ambulo__advice_say(const ambulo__advice *a, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Adds "path=value" to the settings of a problem that was read from a file. */
void ambulo__advice_set(const ambulo__advice *a, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* `value` with four figures, no less (up) or no more than it was. */
double ambulo__outward(double value, int up);

/* The settings of a regular gait with steps of `length` m that take as long as they do now. */
void ambulo__advice_set_step(const ambulo__advice *a, double length);

/* "foot_r is 0.012 m inside obstacle 'beam' at t = 0.31 s", or "comes within .." where only the
 * margin is missed; into text[size]. 0: the violation is of another kind of rows. */
int ambulo__bodies_in_words(const ambulo_problem *problem, const ambulo_violation *violation,
                            char *text, size_t size);

#endif
