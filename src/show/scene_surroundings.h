/* show/scene_surroundings.h - what a body stands on, keeps clear of, reaches for, wears and
 * carries. */
#ifndef AMBULO_SHOW_SCENE_SURROUNDINGS_H
#define AMBULO_SHOW_SCENE_SURROUNDINGS_H

#include "show/scene_body.h"
#include "people/stride.h"

/* "ground", "obstacles", "places", "contacts". Errors: E_MEMORY. */
ambulo_status ambulo__scene_surroundings(ambulo__json *json, const ambulo__stride *stride);
/* "worn": devices and loads, whose points are listed by it. */
void ambulo__scene_worn(ambulo__json *json, const ambulo__stride *stride, ambulo__scene_body *body);

#endif
