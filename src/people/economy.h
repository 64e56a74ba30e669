/* people/economy.h - what a motion costs in work, and how its centre of mass goes.
 *
 * P_i = tau_i qd_i is the power of actuated coordinate i, W. Over the motion as it is shown (whole
 * strides, stride.h) each has done
 *
 *     W+_i = integral max(0, P_i) dt,   W-_i = integral min(0, P_i) dt          J
 *
 * and what muscles take for it, at efficiencies of 0.25 and -1.2 (Margaria, Int Z Angew Physiol
 * 25:339-351, 1968), is W+ / 0.25 - W- / 1.2. Without ground reaction torques of a leg that stands
 * are not those of a person, and there is none.
 */
#ifndef AMBULO_PEOPLE_ECONOMY_H
#define AMBULO_PEOPLE_ECONOMY_H

#include "people/stride.h"

typedef struct ambulo__economy {
  ambulo_allocator allocator;
  double *positive, *negative;       /* [coordinates], J; 0 of those that are not actuated */
  double positive_sum, negative_sum; /* J */
  double distance;                   /* of the centre of mass along forward, m */
  double feet; /* of the foot that goes farthest, m; 0 without feet, or where none goes forward */
  double rise, sway; /* largest less smallest height above the mean path along up, and place along
                        left, m */
} ambulo__economy;

/* Fills *economy, which ambulo__economy_free releases. Errors: E_MEMORY. */
ambulo_status ambulo__economy_of(const ambulo__stride *stride, const ambulo_allocator *allocator,
                                 ambulo__economy *economy);
void ambulo__economy_free(ambulo__economy *economy); /* accepts a zero-filled one */
/* J for what the muscles take. */
double ambulo__economy_metabolic(const ambulo__economy *economy);

#endif
