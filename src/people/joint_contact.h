/* people/joint_contact.h - what the surfaces of joints bear.
 *
 * Cut the body at a joint. What lies below moves by its masses; the ground, the muscles that cross
 * the joint and the surface of the joint itself push it:
 *
 *     C = sum_below m (a - g) - sum of the ground's forces below + sum of hands' below - sum_i f_i
 *
 * C is the contact force on what lies below, f_i the force of muscle i on it, along the axes of a
 * link above: f_i = -F_i pull_i(q) (ambulo/muscles.h). Hands' forces are those that they exert on
 * what they hold. Ligaments and what devices do between points
 * are not known of; a force between two points that lie on either side is part of C.
 *
 * Accelerations of centres of mass, from the root to the ends, with the joint's axis z through the
 * parent's origin and r from there:
 *
 *     w = w_p + z qd,   w' = w_p' + z qdd + w_p x z qd                    (revolute)
 *     a_l = a_p + w' x r + w x (w x r) [+ z qdd + 2 w_p x z qd]           (prismatic: in brackets)
 */
#ifndef AMBULO_PEOPLE_JOINT_CONTACT_H
#define AMBULO_PEOPLE_JOINT_CONTACT_H

#include "ambulo/hold.h"
#include "muscle/muscles.h"

/* A joint that muscles pull across. */
typedef struct ambulo__cut {
  const char *name;
  int link, axes;
} ambulo__cut;

/* The joints that the muscles know of: cuts [at most `most`], in the order in which they come.
 * Returns how many there are. */
int ambulo__cuts(const ambulo_muscles *muscles, int most, ambulo__cut *cuts);

/* One motion, [rows][...]. */
typedef struct ambulo__cut_motion {
  int rows;
  const double *q, *qd, *qdd; /* [d] */
  const double *grf;          /* [feet][3], N, world; NULL: none */
  const double *force;        /* [muscles] N */
  int holds;                  /* what hands hold; 0: nothing */
  const ambulo_hold *hold;    /* [holds] */
  const double *hand_force;   /* [holds][2][3] that each hand exerts, N, world */
} ambulo__cut_motion;

/* contact [rows][cuts][3], N, in the axes of each cut's link above; `between`, which may be NULL,
 * likewise without the muscles: the intersegmental force. E_MEMORY. */
ambulo_status ambulo__joint_contact(const ambulo_muscles *muscles, const ambulo__cut *cuts,
                                    int count, const ambulo__cut_motion *motion,
                                    const ambulo_allocator *allocator, double *contact,
                                    double *between);

#endif
