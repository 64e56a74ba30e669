/* people/strikes.h - when feet strike, from a problem's schedule. */
#ifndef AMBULO_PEOPLE_STRIKES_H
#define AMBULO_PEOPLE_STRIKES_H

#include "ambulo/problem.h"

typedef struct ambulo__strike {
  int foot;    /* of the model */
  double time; /* s, in the motion as it is shown (people/stride.h) */
} ambulo__strike;

/* A foot strikes where a contact begins that no other contact of the same foot leads to; at the
 * beginning of a periodic or mirrored motion the end of it counts as what came before, and at
 * the beginning of any other motion nobody strikes. A mirrored step is followed by its mirror
 * image. Each strike is listed once, in the order of time: what is one event seen twice (a step's
 * last strike and the mirror image of its first; the end of a motion that repeats and its
 * beginning) stands there a single time, the earlier one.
 *
 * strikes [ambulo__most_strikes(problem)]; returns how many there are. */
int ambulo__most_strikes(const ambulo_problem *problem);
int ambulo__strikes(const ambulo_problem *problem, ambulo__strike *strikes);

#endif
