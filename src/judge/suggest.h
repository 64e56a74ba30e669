/* judge/suggest.h - parts of a suggestion (explain.h): a sentence, and what to write after --set.
 *
 * With c the value of the worst row where its family gives way alone, and g = |c| what it gives:
 *
 *   limits        y - lo = c or hi - y = c, c < 0: the bound has to move by g
 *   end values    y - value = c: the value that can be reached is value + c
 *   ends          travel that can be reached: travel + c
 *   footholds     missed by c: the spacing that can be reached while two feet are down is
 *                 (place_b + c_b) - (place_a + c_a)
 *   tolerances    |y| <= w missed by g: w + g
 *   friction      mu n - |t| = -g, and mu n + |t| of its partner row: mu (1 + 2 g / (sum of both))
 *
 * These numbers suffice for the rows of that point, which holds all the others within
 * AMBULO__HOLDS. For that, new values leave room for twice as much, at least for a hundredth of g
 * more, and are rounded outward to four figures. Sentences are in SI units and degrees; settings
 * name keys of the problem's file in the file's units, and are given only where the problem was
 * read from one.
 */
#ifndef AMBULO_JUDGE_SUGGEST_H
#define AMBULO_JUDGE_SUGGEST_H

#include "judge/explain.h"

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

/* Each says what helps a row of its kinds; 0: the row is of none of them. */
int ambulo__advise_feet(const ambulo__advice *a);   /* suggest_feet.c */
int ambulo__advise_forces(const ambulo__advice *a); /* suggest_forces.c */

#endif
