/* show/scene_body.h - a body in motion: the ends of its bones over time.
 *
 * A bone is drawn as all that is within a radius of the line between two points: a capsule of the
 * model, or a line of its stick figure (show/skeleton.h), whose radius is 0: thin. */
#ifndef AMBULO_SHOW_SCENE_BODY_H
#define AMBULO_SHOW_SCENE_BODY_H

#include "formats/json_text.h"
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

/* "left", "right" or "middle". */
const char *ambulo__scene_side(ambulo__side side);
/* World axes to forward, left and up above the ground's height. */
void ambulo__scene_place(const ambulo_model *model, double ground, const double world[3],
                         double place[3]);
/* [f, l, u] of a place on one line, rounded to .1 mm. */
void ambulo__scene_json_place(ambulo__json *json, const char *key, const double place[3]);

#endif
