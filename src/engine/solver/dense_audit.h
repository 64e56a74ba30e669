/* solver/dense_audit.h - what a result says about its motion between the nodes. */
#ifndef AMBULO_SOLVER_DENSE_AUDIT_H
#define AMBULO_SOLVER_DENSE_AUDIT_H

#include "base/diagnostics.h"
#include "solver/dense.h"
#include "solver/result.h"

enum {
  AMBULO__DENSE_SETTINGS_SIZE = 160,
  AMBULO__DENSE_LINE_SIZE = 480,
  AMBULO__DENSE_SUMMARY_SIZE = 1200
};

/* The public view and the memory it points into. Names in it are static or live in the model. */
typedef struct ambulo__dense_report {
  ambulo_dense_audit view;
  ambulo__dense_worst worst;
  int family_rule[AMBULO__DENSE_RULES]; /* whose family each is */
  ambulo_dense_family family[AMBULO__DENSE_RULES];
  char settings[AMBULO__DENSE_RULES][AMBULO__DENSE_SETTINGS_SIZE];
  char advice[AMBULO__DENSE_RULES][AMBULO__DENSE_LINE_SIZE];
  const char *line[AMBULO__DENSE_RULES];
  char line_text[AMBULO__DENSE_RULES][AMBULO__DENSE_LINE_SIZE];
  char summary[AMBULO__DENSE_SUMMARY_SIZE];
  char reason[AMBULO__DENSE_LINE_SIZE];
} ambulo__dense_report;

/* Looks at result->x on a grid `samples` times as fine: fills result->dense (families, worst
 * first) and the audit's dense_violation. Where there is no such grid, or it is large and time is
 * up (`in_time` 0), the report says so. E_MEMORY. */
ambulo_status ambulo__dense_audit(const ambulo_problem *problem, int samples, int in_time,
                                  const ambulo_allocator *allocator, ambulo_result *result);

/* After the verdict, for points that satisfy every row at the nodes: what would help, in words,
 * and one warning. `in_time` 0: the intervals that help are not looked for. E_MEMORY. */
ambulo_status ambulo__dense_advise(const ambulo_problem *problem, int in_time,
                                   const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo_result *result);

/* dense_words.c: settings, advice, lines and the summary of a report whose families are there.
 * `cure`: NULL when nothing was predicted. */
void ambulo__dense_words(const ambulo_problem *problem, ambulo_verdict verdict,
                         const ambulo__dense_cure *cure, ambulo__dense_report *report);

#endif
