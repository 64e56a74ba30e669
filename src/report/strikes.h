/* report/strikes.h - when feet strike, from a problem's schedule. */
#ifndef AMBULO_REPORT_STRIKES_H
#define AMBULO_REPORT_STRIKES_H

#include "ambulo/problem.h"

typedef struct ambulo__strike {
  int foot;    /* of the model */
  double time; /* s, in the motion as it is shown (report/stride.h) */
} ambulo__strike;

/* A foot strikes where a contact begins that no other contact of the same foot leads to; at the
 * beginning of a periodic or mirrored motion the end of it counts as what came before, and at
 * the beginning of any other motion nobody strikes. A mirrored step is followed by its mirror
 * image. Writes at most `capacity` strikes in the order of the contacts and returns how many
 * there are. */
int ambulo__strikes(const ambulo_problem *problem, ambulo__strike *strikes, int capacity);

#endif
