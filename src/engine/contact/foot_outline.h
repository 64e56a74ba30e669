/* contact/foot_outline.h - the flat foot on the ground.
 *
 * Taken from the model's points at q = 0, relative to the heel centre, in the ground
 * plane, and turned so that the toe centre lies straight ahead: m, [along forward,
 * along left]. */
#ifndef AMBULO_CONTACT_FOOT_OUTLINE_H
#define AMBULO_CONTACT_FOOT_OUTLINE_H

#include "ambulo/problem.h"
#include "base/alloc.h"
#include "model/model.h"

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

#endif
