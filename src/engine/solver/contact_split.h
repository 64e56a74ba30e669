/* solver/contact_split.h - how contacts share a wrench, and what a change of all that it
 * depends on does to that. */
#ifndef AMBULO_SOLVER_CONTACT_SPLIT_H
#define AMBULO_SOLVER_CONTACT_SPLIT_H

#include "mechanics/plan.h"

/* What the law (mechanics/kernel_contacts.h) is told of one instant; or the derivatives of all
 * that by a parameter. World axes, SI units. */
typedef struct ambulo__contact_state {
  double wrench[6];                       /* root wrench: moment about the world origin, force */
  double center[3];                       /* of mass */
  double weight[AMBULO__MOST_CONTACTS];   /* not negative; all zero: flight */
  double place[AMBULO__MOST_CONTACTS][3]; /* the contacts' centres */
  double moment_arm, slant;               /* l, epsilon */
} ambulo__contact_state;

/* For each of `count` contacts the force on it and the moment about its centre, [count][6], and
 * their derivatives, given those of the state. */
void ambulo__contact_split_tangent(int count, const ambulo__contact_state *state,
                                   const ambulo__contact_state *change, double share[][6],
                                   double tangent[][6]);

#endif
