/* show/scene_curves.h - what is drawn over time: coordinates, torques, powers, forces, and
 * people's. */
#ifndef AMBULO_SHOW_SCENE_CURVES_H
#define AMBULO_SHOW_SCENE_CURVES_H

#include "formats/json_text.h"
#include "show/gait_people.h"

/* "coordinates": names, limits, q, tau, power of each, with the people's mean and band where there
 * are some; "forces" of feet and patches; "people": who they are. Errors: E_MEMORY. */
ambulo_status ambulo__scene_curves(ambulo__json *json, const ambulo__stride *stride,
                                   const ambulo__gait_people *people);
/* "coordinates" of a motion alone. */
void ambulo__scene_coordinates(ambulo__json *json, const ambulo_model *model, const double *q,
                               int samples);

#endif
