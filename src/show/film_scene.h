/* show/film_scene.h - a scene that is read back, to be drawn at any time (show/scene.h writes it;
 * keys: docs/results.md). */
#ifndef AMBULO_SHOW_FILM_SCENE_H
#define AMBULO_SHOW_FILM_SCENE_H

#include "ambulo/tools/film.h"
#include "formats/yaml_node.h"
#include "show/canvas.h"

typedef struct ambulo__film_bone {
  int point[2];
  double radius; /* m; 0: a line */
  ambulo__color color;
  int is_capsule, is_head, is_foot;
} ambulo__film_bone;

typedef struct ambulo__film_foot {
  int sole[4], ankle;
  ambulo__color color;
} ambulo__film_foot;

/* Series of a force: forward, left, up and where it is. */
typedef struct ambulo__film_force {
  double *force[3], *pressure[3]; /* [samples] N, m */
} ambulo__film_force;

/* A rod between two points: a cable, or a bar of a brace. Radius 0: a box that is carried, of these
 * sizes, about `center` from their middle; before `from` and after `to` (s) it is where it is then.
 */
typedef struct ambulo__film_rod {
  int point[2];
  double radius, size[3], center[3], from, to;
} ambulo__film_rod;

/* A triangle that stands still. */
typedef struct ambulo__film_face {
  double corner[3][3];
  ambulo__color color;
} ambulo__film_face;

/* A capsule that stands still. */
typedef struct ambulo__film_post {
  double end[2][3], radius;
} ambulo__film_post;

typedef struct ambulo__film_scene {
  ambulo_allocator allocator;
  int samples, points, bones, feet, forces, rods, faces, posts;
  int is_there, repeats; /* a ground; the motion goes on after its end */
  double duration, weight, travel, rise, slope, floor;
  double *place;   /* [points][3][samples] */
  double *mass[3]; /* [samples]: of the centre of mass */
  ambulo__film_bone *bone;
  ambulo__film_foot *foot;
  ambulo__film_force *force;
  ambulo__film_rod *rod;
  ambulo__film_face *face;
  ambulo__film_post *post;
  double *series; /* all of the above that change with time */
  size_t used;
} ambulo__film_scene;

/* Errors: E_SCHEMA (what is no scene: the document says where), E_LIMIT, E_MEMORY. */
ambulo_status ambulo__film_scene_read(const ambulo__yaml *document,
                                      const ambulo_allocator *allocator, ambulo__film_scene *scene);
void ambulo__film_scene_free(ambulo__film_scene *scene); /* accepts a zero-filled one */

/* Between which samples a time falls: the first, and the share of the way to the next. */
typedef struct ambulo__film_time {
  int sample;
  double share;
} ambulo__film_time;
ambulo__film_time ambulo__film_time_of(const ambulo__film_scene *scene, double time);
double ambulo__film_value(const double *series, ambulo__film_time at);
void ambulo__film_point(const ambulo__film_scene *scene, int point, ambulo__film_time at,
                        double place[3]);

/* Draws the scene at `time`, `period` repetitions later. */
void ambulo__film_draw(const ambulo__film_scene *scene, double time, int period,
                       ambulo_film_view view, ambulo__canvas *canvas);

#endif
