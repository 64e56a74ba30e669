/* study/fit_outcome.h - what a fit found, and how it is told: fit.json, a table for people. */
#ifndef AMBULO_STUDY_FIT_OUTCOME_H
#define AMBULO_STUDY_FIT_OUTCOME_H

#include "base/text_buffer.h"
#include "study/fit_evaluate.h"

typedef struct ambulo__fit_entry {
  ambulo__fit_step step;
  int solves; /* so far */
} ambulo__fit_entry;

typedef struct ambulo__fit_outcome {
  const ambulo_fit *fit;
  ambulo__fit_runner *runner;
  ambulo__fit_trial *trial; /* [4]: first, best, held-out ones at best, best from zero */
  double *sensitivity;      /* [parameters] */
  ambulo__fit_entry *entry; /* [entries] the course, entry 0 being the start */
  int entries, capacity;
  ambulo_fit_ending ending;
  int stuck; /* the condition whose solves all failed; -1 */
} ambulo__fit_outcome;

enum { AMBULO__FIT_FIRST, AMBULO__FIT_BEST, AMBULO__FIT_APART, AMBULO__FIT_COLD };

/* The trial that scores a condition after the fit: that of the held-out ones is another. */
const ambulo__fit_trial *ambulo__fit_after(const ambulo__fit_outcome *outcome, int condition);
/* Weighted mean of the held-out conditions' distances; NaN without any, or not evaluated. */
double ambulo__fit_held_out(const ambulo__fit_outcome *outcome, int after);
/* -1, 1: parameter i of the best trial is at its lower, its upper bound; 0: between. */
int ambulo__fit_bound(const ambulo__fit_outcome *outcome, int i);
const char *ambulo__fit_ending_name(ambulo_fit_ending ending);

/* About how many solves a fit takes, when none is in the folder yet. */
int ambulo__fit_expected(const ambulo_fit *fit);

/* fit_json.c: appends fit.json. Errors: E_MEMORY. */
ambulo_status ambulo__fit_json(const ambulo__fit_outcome *outcome, ambulo__text_buffer *text);
/* fit_table.c: appends the table. */
void ambulo__fit_table(const ambulo__fit_outcome *outcome, ambulo__text_buffer *text);

#endif
