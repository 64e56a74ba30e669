/* contact/contact_frame.h - where a contact is in the world, and the axes of its surface.
 *
 * With the model's forward f, left l and up n, the ground's height h, and of the contact the place
 * p, the surface normal u (zero: up) and the heading psi,
 *
 *     origin = p_f f + p_l l + (h + p_n) n
 *     left    = unit(u x (cos psi f + sin psi l)),   forward = left x u
 *
 * in world axes. On level ground, heading 0, they are f, l and n themselves. Where u is within 25
 * degrees of the heading or its opposite (the wall that a hand pushes) n takes the heading's place:
 * forward is up the wall. */
#ifndef AMBULO_CONTACT_CONTACT_FRAME_H
#define AMBULO_CONTACT_CONTACT_FRAME_H

#include "ambulo/problem.h"

typedef struct ambulo__contact_frame {
  double origin[3];
  double forward[3], left[3], up[3];
} ambulo__contact_frame;

ambulo__contact_frame ambulo__contact_frame_of(const ambulo_problem_definition *definition,
                                               const ambulo_contact *contact);
/* The surface under a foot in the air, `share` (0 to 1) of the way from one contact to the next:
 * places, headings and normals between theirs. A foot that goes up rises in the first half of the
 * way, one that goes down sinks in the second, so that it passes the edge of a step. */
ambulo__contact_frame ambulo__contact_frame_between(const ambulo_problem_definition *definition,
                                                    const ambulo_contact *from,
                                                    const ambulo_contact *to, double share);
/* The contact that such a surface would be of. */
ambulo_contact ambulo__contact_between(const ambulo_contact *from, const ambulo_contact *to,
                                       double share);
/* direction . (point - origin) */
double ambulo__contact_frame_along(const ambulo__contact_frame *frame, const double direction[3],
                                   const double point[3]);
/* Under a foot: 1 for a normal of zeros, and up to 60 degrees from up. */
int ambulo__contact_normal_is_legal(const double normal[3]);
/* 1 where the contact's surface is the level ground plane and its heading straight ahead. */
int ambulo__contact_is_level(const ambulo_contact *contact);
/* 1 if both hold the foot to the same foothold. */
int ambulo__contacts_same_place(const ambulo_contact *one, const ambulo_contact *other);
/* 1 if all contacts of feet are: what stands on one zero-moment point needs that. */
int ambulo__contacts_are_level(const ambulo_problem_definition *definition);

#endif
