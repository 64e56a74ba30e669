/* show/canvas.h - pictures of bodies in space, without a graphics library: rays meet capsules,
 * triangles and the floor, lit by the sky and a sun.
 *
 * Places are along forward, left and up, m. A canvas has `AMBULO__CANVAS_FINE` times as many points
 * to a side as the picture has pixels, whose mean a pixel is.
 */
#ifndef AMBULO_SHOW_CANVAS_H
#define AMBULO_SHOW_CANVAS_H

#include "base/alloc.h"

enum { AMBULO__CANVAS_FINE = 2 };

typedef struct ambulo__camera {
  double eye[3];
  double ahead[3], right[3], up[3]; /* unit vectors at right angles */
  double slope;                     /* tangent of half the angle from the lower to the upper edge */
} ambulo__camera;

/* Looks from `eye` to `target`; `upright`: what is up in the picture. */
void ambulo__camera_set(ambulo__camera *camera, const double eye[3], const double target[3],
                        const double upright[3], double slope);

typedef struct ambulo__canvas {
  int width, height;     /* points */
  float *depth;          /* [height][width]: along `ahead`, m */
  unsigned char *color;  /* [height][width][3] */
  unsigned char *shadow; /* [height][width]: 1 where something keeps the sun off the floor */
  ambulo__camera camera;
} ambulo__canvas;

/* Of a picture of so many pixels. Errors: E_MEMORY. */
ambulo_status ambulo__canvas_create(int width, int height, const ambulo_allocator *allocator,
                                    ambulo__canvas *canvas);
void ambulo__canvas_free(ambulo__canvas *canvas, const ambulo_allocator *allocator);

/* A colour, 0xrrggbb. */
typedef unsigned ambulo__color;

/* Begins a picture: sky, and a floor with a grid of half metres at this height; none: sky alone. */
void ambulo__canvas_begin(ambulo__canvas *canvas, const ambulo__camera *camera, int floor,
                          double height);
/* What a capsule keeps the sun off the floor at this height; before what stands on it. */
void ambulo__canvas_shade(ambulo__canvas *canvas, const double from[3], const double to[3],
                          double radius, double height);
/* Darkens what is in shadow. */
void ambulo__canvas_dim(ambulo__canvas *canvas);
/* A capsule; from = to: a sphere. `on_top`: in front of everything, of its plain colour. */
void ambulo__canvas_capsule(ambulo__canvas *canvas, const double from[3], const double to[3],
                            double radius, ambulo__color color, int on_top);
/* A triangle with two sides. */
void ambulo__canvas_triangle(ambulo__canvas *canvas, const double a[3], const double b[3],
                             const double c[3], ambulo__color color);
/* The picture: [height / FINE][width / FINE][3]. */
void ambulo__canvas_pixels(const ambulo__canvas *canvas, unsigned char *pixels);

#endif
