/* contact/foot.h - where a contact is in the world, and the axes of its surface.
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
#ifndef AMBULO_CONTACT_FOOT_H
#define AMBULO_CONTACT_FOOT_H

#include "ambulo/problem.h"
#include "base/alloc.h"
#include "contact/rows.h"
#include "model/model.h"

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

/* the flat foot on the ground.
 *
 * Taken from the model's points at q = 0, relative to the heel centre, in the ground
 * plane, and turned so that the toe centre lies straight ahead: m, [along forward,
 * along left]. */

enum { AMBULO__FOOT_CORNERS = 4 };

typedef struct ambulo__foot_outline {
  double length;                         /* heel centre to toe centre, m */
  int moves_sideways;                    /* 0: a planar foot, which has no lateral rows */
  int count;                             /* corners: 2 (planar foot) or 4 */
  int point[AMBULO__FOOT_CORNERS];       /* the model's point of each corner */
  int is_heel[AMBULO__FOOT_CORNERS];     /* heel corner, else toe corner */
  double place[AMBULO__FOOT_CORNERS][2]; /* relative to the heel centre, m */
  int has_arcs;
  int arc[2];                     /* the model's points: centres of the arcs of heel and forefoot */
  double arc_ahead[2], radius[2]; /* along forward from the heel centre, above it: m */
} ambulo__foot_outline;

ambulo__foot_outline ambulo__foot_outline_of(const ambulo_model *model, int foot);
/* Of all feet, [foot_count]; NULL without memory. Free with ambulo__free. */
ambulo__foot_outline *ambulo__foot_outlines(const ambulo_model *model,
                                            const ambulo_allocator *allocator);

/* Heel centre to the most forward point of the flat foot, its tip if it has one, m. */
double ambulo__foot_reach(const ambulo_model *model, int foot);

/* Whether a corner touches the ground in a mode. */
int ambulo__corner_in_contact(ambulo_contact_mode mode, int is_heel);

/* The point that a contact holds in place, and where: the heel centre on the foothold,
 * or (in toe contact) the toe centre where the flat foot has it, the middle of a patch on its
 * place; world axes, m. `outline`: of the contact's foot; not read for a patch. Returns the point.
 */
int ambulo__contact_point(const ambulo_problem_definition *definition,
                          const ambulo__foot_outline *outline, const ambulo_contact *contact,
                          double place[3]);

/* how a foot is turned, as linear forms of its points.
 *
 * x points from the heel centre to the toe centre, y from the right to the left heel corner;
 * with the axes left l and up n of the surface on which it stands or over which it swings
 *
 *     yaw   = l . x        (turned to the left)
 *     pitch = n . x        (toes up)
 *     roll  = n . y        (left side up)
 *
 * sines of the angles, of a foot whose heel and toe centre are a constant distance apart. */

ambulo__linear ambulo__foot_yaw(const ambulo__gait_context *context, int foot,
                                const double left[3]);
ambulo__linear ambulo__foot_pitch(const ambulo__gait_context *context, int foot,
                                  const double up[3]);
/* No terms for a foot with a single heel corner. */
ambulo__linear ambulo__foot_roll(const ambulo__gait_context *context, int foot, const double up[3]);
/* Distance of heel and toe centre at q = 0, m. */
double ambulo__foot_length(const ambulo_model *model, int foot);

#endif
