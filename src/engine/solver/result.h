/* solver/result.h - what a solve leaves behind, how good it is, and the verdict on it. */
#ifndef AMBULO_SOLVER_RESULT_H
#define AMBULO_SOLVER_RESULT_H

#include "method/engine.h"

#define AMBULO__ENDING_SIZE 400

struct ambulo__explanation;  /* solver/explain.h */
struct ambulo__dense_report; /* solver/dense.h */
struct ambulo__outcome;      /* solver/free_search.c */
struct ambulo__valleys;      /* solver/solve.c */
struct ambulo__refinement;   /* solver/free_refined.c */
struct ambulo__history;      /* method/run.h */

struct ambulo_result {
  ambulo_allocator allocator;
  ambulo_verdict verdict;
  ambulo_ending ending_code;
  int variables, rows, terms, families;
  double objective;
  double *x;                /* [variables] */
  double *term;             /* [terms], weighted */
  double *row;              /* [rows], physical units */
  double *multiplier;       /* [rows]: stationarity is grad J = sum multiplier grad c */
  ambulo_violation *family; /* [families], in the order in which they first appear */
  ambulo_audit audit;
  ambulo_timing timing;
  ambulo_nlopt_work nlopt;
  int iterations, evaluations;
  struct ambulo__explanation *explanation; /* NULL: none */
  struct ambulo__dense_report *dense;      /* NULL: not audited */
  struct ambulo__valleys *valleys;         /* of several starts; NULL: there was one */
  struct ambulo__history *history;
  struct ambulo__outcome *outcome;       /* of free parameters; NULL: there were none */
  struct ambulo__refinement *refinement; /* of finer grids; NULL: there were none */
  char ending[AMBULO__ENDING_SIZE];
};

/* Sized for `problem`; not judged, the audit that of an unknown point. E_MEMORY. */
ambulo_status ambulo__result_create(const ambulo_problem *problem,
                                    const ambulo_allocator *allocator, ambulo_result **result);

/* ----------------------------------------------------------------- verdict */

/* worst / size: what the feasibility tolerance is compared with. */
double ambulo__relative(const ambulo_violation *violation);

/* Name and text of AMBULO_ENDING_LIST; never NULL. */
const char *ambulo__ending_name(ambulo_ending ending);
const char *ambulo__ending_text(ambulo_ending ending);

/* A feasible point that is a KKT point or at the objective's lower bound is optimal however the
 * solver ended; one with a value or a derivative that is not finite never is. */
ambulo_verdict ambulo__verdict_of(const ambulo_audit *audit, const ambulo_options *options,
                                  ambulo_ending ending);

/* What the nodes alone say: that of optimal_at_nodes is optimal. */
ambulo_verdict ambulo__verdict_at_nodes(ambulo_verdict verdict);

/* The verdict of the whole motion; `ratio`: the worst row between the nodes by its tolerance, not
 * a number where it is not finite. */
ambulo_verdict ambulo__verdict_between_nodes(ambulo_verdict verdict, double ratio);

/* (J_n - J) / |J_n| of objectives on grids twice as fine each, by Richardson (free_refined.c); not
 * a number for fewer than two. */
double ambulo__resolution_error(const double *objective, int count);

/* A method that gave up where values or derivatives were not finite failed for that reason. */
void ambulo__ending_of_faults(ambulo__run *run);

/* Nothing that was not finite stays unsaid: of the result as a warning, of points that the search
 * gave up as a note. */
void ambulo__report_faults(const ambulo__run *run, ambulo_result *result,
                           ambulo_diagnostics *diagnostics);

/* Every family that could not be satisfied, and by how much it would have to give: warnings. */
void ambulo__report_families(const ambulo_result *result, double tolerance,
                             ambulo_diagnostics *diagnostics);

/* 1 when `one` is the better: it alone holds its rows, or alone at the nodes; or both do and its
 * objective is lower; or none does and its violation is smaller. */
int ambulo__result_is_better(const ambulo_result *one, const ambulo_result *other);

/* 1 where a second look may help: the rows hold and the KKT residual is large, or they do not and
 * nothing shows that they cannot; and no limit is the reason. */
int ambulo__result_leaves_doubts(const ambulo_options *options, const ambulo_result *result);

/* 1 for endings by time, evaluations, iterations. */
int ambulo__is_limit(ambulo_ending ending);

/* 1 when a cap that the caller may raise ended the run: time, evaluations, or fewer iterations
 * than the default. Its point says nothing about the rows. */
int ambulo__ended_by_cap(const ambulo__run *run);

/* What the explanation adds to the verdict: a solve whose rows are not shown to contradict each
 * other has not converged. The method's own iteration limit is no answer where they do: then no
 * more iterations would have helped. */
void ambulo__settle_verdict(const ambulo__run *run, ambulo_result *result);

/* audit.c: how good a point is, recomputed from its unknowns alone. */

/* Fills result (x must be set): objective, terms, rows, violations per family,
 * multipliers, KKT residual, rank, and what is not finite. `engine` belongs to the same
 * problem; its state is used up. A run that was stopped and is late (run.h) gets what takes one
 * evaluation, the rest stays unknown. E_MEMORY. */
ambulo_status ambulo__audit(ambulo__engine *engine, const ambulo_options *options,
                            ambulo_result *result);

/* Of a point that no engine could be made for: objective, terms, rows, violations. What it takes
 * gradients for stays unknown. E_MEMORY. */
ambulo_status ambulo__audit_values(ambulo_workspace *workspace, ambulo_result *result);

/* Violation of one row's value: |c| or max(0, -c); infinite when it is not finite. */
double ambulo__row_violation(const ambulo_problem *problem, int row, double value);
/* The same with its names. */
ambulo_violation ambulo__violation_of(const ambulo_problem *problem, int row, double value);

#endif
