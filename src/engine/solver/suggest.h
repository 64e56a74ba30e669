/* solver/suggest.h - parts of a suggestion (explain.h): a sentence, and what to write after --set.
 *
 * With c the value of the worst row where its family gives way alone, and g = |c| what it gives:
 *
 *   limits        y - lo = c or hi - y = c, c < 0: the bound has to move by g
 *   end values    y - value = c: the value that can be reached is value + c
 *   ends          travel that can be reached: travel + c
 *   footholds     missed by c: the spacing that can be reached while two feet are down is
 *                 (place_b + c_b) - (place_a + c_a)
 *   tolerances    |y| <= w missed by g: w + g
 *   friction      mu N - |T| = -g, and N of the contact's own row: mu + g / N
 *
 * These numbers suffice for the rows of that point, which holds all the others within
 * AMBULO__HOLDS. For that, new values leave room for twice as much, at least for a hundredth of g
 * more, and are rounded outward to four figures. Sentences are in SI units and degrees; settings
 * name keys of the problem's file in the file's units, and are given only where the problem was
 * read from one.
 */
#ifndef AMBULO_SOLVER_SUGGEST_H
#define AMBULO_SOLVER_SUGGEST_H

#include "solver/advice.h"

/* Each says what helps a row of its kinds; 0: the row is of none of them. */
int ambulo__advise_feet(const ambulo__advice *a);   /* suggest_feet.c */
int ambulo__advise_forces(const ambulo__advice *a); /* suggest_forces.c */
int ambulo__advise_bodies(const ambulo__advice *a); /* suggest_bodies.c */

#endif
