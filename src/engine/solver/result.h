/* solver/result.h - what a solve leaves behind. */
#ifndef AMBULO_SOLVER_RESULT_H
#define AMBULO_SOLVER_RESULT_H

#include "problem/nlp.h"

#define AMBULO__ENDING_SIZE 400

struct ambulo__explanation;  /* solver/explain.h */
struct ambulo__dense_report; /* solver/dense_audit.h */
struct ambulo__outcome;      /* solver/free_outcome.h */
struct ambulo__valleys;      /* solver/starts.h */
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
  struct ambulo__outcome *outcome; /* of free parameters; NULL: there were none */
  char ending[AMBULO__ENDING_SIZE];
};

/* Sized for `problem`; not judged, the audit that of an unknown point. E_MEMORY.
 */
ambulo_status ambulo__result_create(const ambulo_problem *problem,
                                    const ambulo_allocator *allocator, ambulo_result **result);

#endif
