/* model/conditions.h - under which conditions a model moves: load it carries, slope it climbs.
 *
 * Applied to a model of one's own between loading and first use; a model that others may
 * already read never changes. */
#ifndef AMBULO_MODEL_CONDITIONS_H
#define AMBULO_MODEL_CONDITIONS_H

#include "model/model.h"

#define AMBULO__LARGEST_SLOPE 0.6 /* rad */

/* Fixes a body of `mass` (kg) without extent at `position` (link frame, m). */
void ambulo__model_carry(ambulo_model *model, int link, double mass, const double position[3]);

/* Takes all loads off again that it knows of; bodies and mass are its own. */
void ambulo__model_put_down(ambulo_model *model);
/* Another size, of a model that carries nothing: `heavier` and `longer` times what is a share of
 * the subject's mass and stature in its file (of a model made from C all masses), and the stature.
 */
void ambulo__model_resize(ambulo_model *model, double heavier, double longer);

/* Tilts the ground: the world's axes stay with it (up is its normal, forward points uphill for
 * slope > 0, rad) and gravity is turned instead. */
void ambulo__model_tilt(ambulo_model *model, double slope);

/* Built anew from its own parts, but for its points, whose first model->point_count are its own;
 * directions are copied, not derived again, bit for bit. Errors: as ambulo_model_create. */
ambulo_status ambulo__model_copy(const ambulo_model *model, const ambulo_point *points,
                                 int point_count, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo_model **copy);

#endif
