/* people/compare_doubt.h - what hardly can be meant about a reference and the curves asked for. */
#ifndef AMBULO_PEOPLE_COMPARE_DOUBT_H
#define AMBULO_PEOPLE_COMPARE_DOUBT_H

#include "people/compare_people.h"

/* 1 if a comma-separated list names the curve; no list names all. */
int ambulo__curve_is_listed(const char *list, const char *curve);
/* E_SCHEMA, naming it, if the list (may be NULL) names a curve that the people do not have. */
ambulo_status ambulo__curves_check(const char *list, const ambulo__people *people,
                                   ambulo_diagnostics *diagnostics);
/* Warns of a reference over part of the cycle, and of angles that look like radians beside the
 * predicted curve, fine[AMBULO__FINE] in degrees. Returns whether it did. */
int ambulo__curve_doubt(const ambulo__reference_curve *curve, const double *fine, const char *file,
                        ambulo_diagnostics *diagnostics);

#endif
