/* show/scene.h - scene.json: what of a motion is drawn in space, and its curves
 * (docs/results.md).
 *
 * Places are along forward, along left and up from the world's origin, the third above the
 * ground's height. Whatever changes with time is a series at evenly spaced times of the motion as
 * it is shown (people/stride.h): whole numbers v_k of a unit, of which the file has
 *
 *     v_0,  v_1 - v_0,  and from then on  (v_k - v_(k-1)) - (v_(k-1) - v_(k-2))
 *
 * Smooth curves have small second differences: a third of the text. All of it is computed here, by
 * the library; who draws adds up. */
#ifndef AMBULO_SHOW_SCENE_H
#define AMBULO_SHOW_SCENE_H

#include "ambulo/solve.h"
#include "base/text_buffer.h"
#include "people/compare.h"
#include "formats/json_text.h"

#define AMBULO__SCENE_SCHEMA "ambulo-scene/1"
enum { AMBULO__SCENE_SAMPLES = 161 };

/* Of a result; `people` (NULL: none) beside the curves of a walk (show/gait_people.h).
 * Errors: E_MEMORY. */
ambulo_status ambulo__scene_json(const ambulo_problem *problem, const ambulo_result *result,
                                 const ambulo__people *people, ambulo__text_buffer *text);

/* Of a motion that nobody predicted: q [samples][coordinates], rad and m, evenly spaced over
 * `duration` s; `ground` m along up. Without forces and surroundings. Errors: E_MEMORY. */
ambulo_status ambulo__scene_of_motion(const ambulo_model *model, const char *name, const double *q,
                                      int samples, double duration, double ground,
                                      ambulo__text_buffer *text);

#endif
