/* contact/foot_frame.h - how a foot is turned, as linear forms of its points.
 *
 * x points from the heel centre to the toe centre, y from the right to the left heel corner;
 * with the axes left l and up n of the surface on which it stands or over which it swings
 *
 *     yaw   = l . x        (turned to the left)
 *     pitch = n . x        (toes up)
 *     roll  = n . y        (left side up)
 *
 * sines of the angles, of a foot whose heel and toe centre are a constant distance apart. */
#ifndef AMBULO_CONTACT_FOOT_FRAME_H
#define AMBULO_CONTACT_FOOT_FRAME_H

#include "contact/bounded.h"
#include "contact/foot_outline.h"

ambulo__linear ambulo__foot_yaw(const ambulo__gait_context *context, int foot,
                                const double left[3]);
ambulo__linear ambulo__foot_pitch(const ambulo__gait_context *context, int foot,
                                  const double up[3]);
/* No terms for a foot with a single heel corner. */
ambulo__linear ambulo__foot_roll(const ambulo__gait_context *context, int foot, const double up[3]);
/* Distance of heel and toe centre at q = 0, m. */
double ambulo__foot_length(const ambulo_model *model, int foot);

#endif
