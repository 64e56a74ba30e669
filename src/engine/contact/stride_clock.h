/* contact/stride_clock.h - where a foot is in its stride, from its strike to the next. */
#ifndef AMBULO_CONTACT_STRIDE_CLOCK_H
#define AMBULO_CONTACT_STRIDE_CLOCK_H

#include "ambulo/problem.h"

typedef struct ambulo__stride_now {
  double begin[2]; /* s: the strike at or before the time (within 1e-9 s), and the next; may lie
                      outside [0, T] */
  int contact[2];  /* with whose `from` they begin */
  double share;    /* of the stride, 0 to 1 */
} ambulo__stride_now;

/* In a motion that repeats; 0 where the foot does not strike. */
int ambulo__stride_at(const ambulo_problem_definition *definition, int foot, double time,
                      ambulo__stride_now *now);

#endif
