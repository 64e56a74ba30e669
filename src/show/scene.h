/* show/scene.h - scene.json: what of a motion is drawn in space, and its curves (docs/results.md).
 *
 * First the body: the ends of its bones over time.
 *
 * A bone is drawn as all that is within a radius of the line between two points: a capsule of the
 * model, or a line of its stick figure (show/skeleton.h), whose radius is 0: thin. */
#ifndef AMBULO_SHOW_SCENE_H
#define AMBULO_SHOW_SCENE_H

#include "ambulo/solve.h"
#include "base/text_buffer.h"
#include "formats/json_text.h"
#include "people/compare.h"
#include "people/muscle_analysis.h"
#include "people/stride.h"
#include "show/gait_people.h"
#include "show/skeleton.h"

/* A point that is fixed on a link (-1: in the world), link frame, m. */
typedef struct ambulo__scene_point {
  int link;
  double at[3];
} ambulo__scene_point;

typedef struct ambulo__scene_body {
  ambulo_allocator allocator;
  const ambulo_model *model;
  ambulo__skeleton skeleton;
  int samples;
  const double *q; /* borrowed: [samples][coordinates] */
  double ground;   /* m along up */
  ambulo__scene_point *points;
  int count, capacity;
  int failed; /* memory ran out */
} ambulo__scene_body;

/* Errors: E_MEMORY. */
ambulo_status ambulo__scene_body_create(const ambulo_model *model, const double *q, int samples,
                                        double ground, const ambulo_allocator *allocator,
                                        ambulo__scene_body *body);
void ambulo__scene_body_free(ambulo__scene_body *body); /* accepts a zero-filled one */

/* The number of a point, which is listed once; 0 without memory (`failed`). */
int ambulo__scene_body_point(ambulo__scene_body *body, int link, const double at[3]);
/* "bones" and "feet", whose points are listed by it. */
void ambulo__scene_bones(ambulo__json *json, ambulo__scene_body *body);
/* "points" and "center_of_mass", after all of them are listed. Errors: E_MEMORY. */
ambulo_status ambulo__scene_points(ambulo__json *json, ambulo__scene_body *body);

/* "meshes" of links and their frames over time, where a file of them stands beside one of `inputs`
 * (formats/inputs.h), the model's (import/meshes.h). Errors: E_MEMORY. */
ambulo_status ambulo__scene_meshes(ambulo__json *json, ambulo__scene_body *body,
                                   const char *inputs);

/* "left", "right" or "middle". */
const char *ambulo__scene_side(ambulo__side side);
/* World axes to forward, left and up above the ground's height. */
void ambulo__scene_place(const ambulo_model *model, double ground, const double world[3],
                         double place[3]);
/* [f, l, u] of a place on one line, rounded to .1 mm. */
void ambulo__scene_json_place(ambulo__json *json, const char *key, const double place[3]);

/* what a body stands on, keeps clear of, reaches for, wears and
 * carries. */

/* "ground", "obstacles", "places", "contacts". Errors: E_MEMORY. */
ambulo_status ambulo__scene_surroundings(ambulo__json *json, const ambulo__stride *stride);
/* "held" and "worn": what hands hold; devices and loads. Their points are listed by it. Errors:
 * E_MEMORY. */
ambulo_status ambulo__scene_worn(ambulo__json *json, const ambulo__stride *stride,
                                 ambulo__scene_body *body);

/* a curve over time as whole numbers of a unit (scene.h). */

/* Units of the series of a scene. */
#define AMBULO__SCENE_LENGTH 1e-4 /* m */
#define AMBULO__SCENE_ANGLE 1e-4  /* rad: .006 degrees */
#define AMBULO__SCENE_TORQUE 1e-2 /* N m */
#define AMBULO__SCENE_POWER 1e-1  /* W */
#define AMBULO__SCENE_FORCE 1e-1  /* N */
#define AMBULO__SCENE_ACTIVATION 1e-3

/* values[k * step], k < count. One that is not finite, or beyond 2^40 units, takes the number
 * before it, the first zero; the others are within half a unit. `key` is NULL inside of arrays. */
void ambulo__series(ambulo__json *json, const char *key, const double *values, int step, int count,
                    double unit);

/* what is drawn over time: coordinates, torques, powers, forces, and
 * people's. */

/* "coordinates": names, limits, q, tau, power of each, with the people's mean and band where there
 * are some; "forces" of feet and patches; "people": who they are. Errors: E_MEMORY. */
ambulo_status ambulo__scene_curves(ambulo__json *json, const ambulo__stride *stride,
                                   const ambulo__gait_people *people);
/* "coordinates" of a motion alone. */
void ambulo__scene_coordinates(ambulo__json *json, const ambulo_model *model, const double *q,
                               int samples);

/* "muscles": lines on links, activations, contact forces; of the stride's own samples. Errors:
 * E_MEMORY. */
ambulo_status ambulo__scene_muscles(ambulo__json *json, const ambulo__stride *stride,
                                    const ambulo_muscle_analysis *analysis);

/* scene.json: what of a motion is drawn in space, and its curves
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

#define AMBULO__SCENE_SCHEMA "ambulo-scene/1"
enum { AMBULO__SCENE_SAMPLES = 161 };

/* Of a result; `people` (NULL: none) beside the curves of a walk (show/gait_people.h); who makes
 * the motion (NULL: the problem's own muscles, if any); the files that the problem was read from
 * (NULL: its own). Errors: E_ARGUMENT, E_MEMORY. */
ambulo_status ambulo__scene_json(const ambulo_problem *problem, const ambulo_result *result,
                                 const ambulo__people *people, const ambulo_muscles *muscles,
                                 const char *inputs, ambulo__text_buffer *text);

/* Of a motion that nobody predicted: q [samples][coordinates], rad and m, evenly spaced over
 * `duration` s; `ground` m along up. Without forces and surroundings. Errors: E_MEMORY. */
ambulo_status ambulo__scene_of_motion(const ambulo_model *model, const char *name, const double *q,
                                      int samples, double duration, double ground,
                                      ambulo__text_buffer *text);

#endif
