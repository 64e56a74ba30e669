/* study/fit_trial.c - see trial.h. */
#include "study/fit_trial.h"

#include <math.h>
#include <string.h>

ambulo__fit_trial *ambulo__fit_trials_make(const ambulo__fit_sizes *s, int count,
                                           const ambulo_allocator *allocator) {
  size_t n = (size_t)s->parameters, m = (size_t)s->residuals, c = (size_t)s->conditions;
  size_t scores = c * (size_t)s->curves;
  /* doubles first, then integers, then bytes: all are aligned */
  size_t each =
      (n + m + c) * sizeof(double) + scores * sizeof(ambulo__fit_score) + c * (sizeof(int) + 1);
  each = (each + 15) / 16 * 16;
  size_t head = ((size_t)count * sizeof(ambulo__fit_trial) + 15) / 16 * 16;
  char *block = ambulo__alloc(allocator, head + (size_t)count * each, 1);
  ambulo__fit_trial *trial = (ambulo__fit_trial *)(void *)block;
  for (int i = 0; block && i < count; i++) {
    char *at = block + head + (size_t)i * each;
    ambulo__fit_trial *t = &trial[i];
    t->u = (double *)(void *)at;
    t->residual = t->u + n;
    t->apart = t->residual + m;
    t->score = (ambulo__fit_score *)(void *)(t->apart + c);
    t->index = (int *)(void *)(t->score + scores);
    t->solved = (unsigned char *)(t->index + c);
    t->distance = t->cost = (double)NAN;
    for (size_t k = 0; k < c; k++) {
      t->index[k] = -1;
      t->apart[k] = (double)NAN;
    }
  }
  return trial;
}

void ambulo__fit_trial_copy(const ambulo__fit_sizes *s, const ambulo__fit_trial *from,
                            ambulo__fit_trial *to) {
  size_t n = (size_t)s->parameters, m = (size_t)s->residuals, c = (size_t)s->conditions;
  memcpy(to->u, from->u, n * sizeof *to->u);
  memcpy(to->residual, from->residual, m * sizeof *to->residual);
  memcpy(to->apart, from->apart, c * sizeof *to->apart);
  memcpy(to->score, from->score, c * (size_t)s->curves * sizeof *to->score);
  memcpy(to->index, from->index, c * sizeof *to->index);
  memcpy(to->solved, from->solved, c);
  memcpy(to->label, from->label, sizeof to->label);
  to->distance = from->distance;
  to->cost = from->cost;
  to->complete = from->complete;
}

double ambulo__fit_cost(const ambulo__fit_task *task, const ambulo__fit_trial *trial) {
  double squares = 0.0;
  int n = task->sizes.parameters;
  for (int i = 0; i < n; i++) squares += trial->u[i] * trial->u[i];
  return trial->distance + task->ridge * squares / (double)n;
}
