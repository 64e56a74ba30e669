/* show/scene_series.h - a curve over time as whole numbers of a unit (scene.h). */
#ifndef AMBULO_SHOW_SCENE_SERIES_H
#define AMBULO_SHOW_SCENE_SERIES_H

#include "formats/json_text.h"

/* Units of the series of a scene. */
#define AMBULO__SCENE_LENGTH 1e-4 /* m */
#define AMBULO__SCENE_ANGLE 1e-4  /* rad: .006 degrees */
#define AMBULO__SCENE_TORQUE 1e-2 /* N m */
#define AMBULO__SCENE_POWER 1e-1  /* W */
#define AMBULO__SCENE_FORCE 1e-1  /* N */

/* values[k * step], k < count. One that is not finite, or beyond 2^40 units, takes the number
 * before it, the first zero; the others are within half a unit. `key` is NULL inside of arrays. */
void ambulo__series(ambulo__json *json, const char *key, const double *values, int step, int count,
                    double unit);

#endif
