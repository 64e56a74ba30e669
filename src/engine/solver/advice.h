/* solver/advice.h - how a suggestion (suggest.h) is written down: a sentence, and settings for
 * --set. */
#ifndef AMBULO_SOLVER_ADVICE_H
#define AMBULO_SOLVER_ADVICE_H

#include "solver/explain.h"

#include <string.h>

typedef struct ambulo__advice {
  const ambulo_problem *problem;
  const ambulo__table_row *row;
  double value, give;   /* of the worst row; give = |value| */
  double room;          /* ... and a little more */
  const double *values; /* [rows] */
  ambulo__explanation *out;
} ambulo__advice;

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

#endif
