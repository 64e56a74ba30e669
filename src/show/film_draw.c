/* show/film_draw.c - one picture of a scene: where the eye is, and what it sees (film_scene.h).
 *
 * The eye goes along with the centre of mass. Where the ground rises or the body leaves it, up and
 * down too. It stands as on the page (viewer/stage.js): from the same sides, as far away as the
 * body is tall. A scene is along its ground; gravity's up is (sin slope, 0, cos slope) in it. */
#include "base/arithmetic.h"
#include "show/film_scene.h"

#include <math.h>
#include <string.h>

static const double half_angle = 0.28674538575880792; /* tangent of 16 degrees */
static const double force_length = 0.9;               /* m for the body weight */
enum {
  FORCE_COLOR = 0x12825a,
  CARRIED_COLOR = 0xb9854a,
  DEVICE_COLOR = 0x1f9e72,
  POST_COLOR = 0xa98d62
};

/* ----------------------------------------------------------------- the eye */

typedef struct extent {
  double least[3], most[3];
} extent;

static extent extent_of(const ambulo__film_scene *s) {
  extent e = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
  for (int p = 0; p < 3 * s->points; p++) {
    for (int k = 0; k < s->samples; k++) {
      double x = s->place[(size_t)p * (size_t)s->samples + (size_t)k];
      e.least[p % 3] = fmin(e.least[p % 3], x);
      e.most[p % 3] = fmax(e.most[p % 3], x);
    }
  }
  return e;
}

static int goes_up(const ambulo__film_scene *s) {
  double least = s->mass[2][0], most = least;
  for (int k = 0; k < s->samples; k++) {
    least = fmin(least, s->mass[2][k]);
    most = fmax(most, s->mass[2][k]);
  }
  return s->rise != 0.0 || s->slope != 0.0 || most - least > 0.7;
}

/* a direction by gravity, in the scene */
static void along_ground(const ambulo__film_scene *s, const double world[3], double scene[3]) {
  double x = world[0], z = world[2];
  scene[0] = cos(s->slope) * x + sin(s->slope) * z;
  scene[1] = world[1];
  scene[2] = cos(s->slope) * z - sin(s->slope) * x;
}

static ambulo__camera camera_of(const ambulo__film_scene *s, ambulo__film_time at,
                                ambulo_film_view view, double aspect) {
  static const double ways[4][3] = {
      {0.52, -1.0, 0.2}, {0.0, -1.0, 0.04}, {1.0, 0.0, 0.06}, {0.0, -1e-3, 1.0}};
  const double up[3] = {0.0, 0.0, 1.0};
  double target[3], way[3], upright[3], eye[3];
  extent e = extent_of(s);
  int rises = s->is_there && goes_up(s);
  double tall = fmax(e.most[2] - e.least[2], s->is_there ? 0.6 : 0.3);
  for (int i = 0; i < 3; i++) target[i] = ambulo__film_value(s->mass[i], at);
  if (!s->is_there) {
    tall = fmax(tall, e.most[0] - e.least[0]);
    target[0] = 0.5 * (e.least[0] + e.most[0]);
    target[2] = 0.5 * (e.least[2] + e.most[2]);
  } else if (!rises) {
    target[2] = 0.5 * (fmax(e.least[2], -0.2) + e.most[2]);
  }
  tall = rises ? fmin(tall, 2.1) : tall;
  tall = fmax(tall, s->is_there ? 1.0 : 0.4);
  double far = (0.58 * tall + 0.12) / half_angle * fmax(1.0, 0.95 / aspect);
  along_ground(s, ways[view], way);
  along_ground(s, up, upright);
  double length = sqrt(ambulo__dot(way, way));
  for (int i = 0; i < 3; i++) eye[i] = target[i] + far / length * way[i];
  ambulo__camera camera;
  ambulo__camera_set(&camera, eye, target, upright, half_angle);
  return camera;
}

/* ---------------------------------------------------------------- the body */

/* one instant: where `period` repetitions have led */
typedef struct instant {
  const ambulo__film_scene *s;
  ambulo__film_time at;
  double shift[3];
  ambulo__canvas *canvas;
} instant;

static void place_of(const instant *w, int point, double place[3]) {
  ambulo__film_point(w->s, point, w->at, place);
  for (int i = 0; i < 3; i++) place[i] += w->shift[i];
}

static double distance(const double a[3], const double b[3]) {
  double off[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  return sqrt(ambulo__dot(off, off));
}

/* 0: it is not drawn, since capsules or shoes are in its place */
static double thickness(const instant *w, const ambulo__film_bone *b, int capsules,
                        const double ends[2][3]) {
  if (b->is_capsule) return w->s->feet > 0 && b->is_foot ? 0.0 : b->radius;
  if (capsules) return 0.0;
  return fmin(fmax(0.13 * distance(ends[0], ends[1]), 0.018), 0.055);
}

static void draw_bones(const instant *w, int shadow) {
  const ambulo__film_scene *s = w->s;
  int capsules = 0;
  for (int i = 0; i < s->bones; i++) capsules += s->bone[i].is_capsule;
  for (int i = 0; i < s->bones; i++) {
    const ambulo__film_bone *b = &s->bone[i];
    double ends[2][3];
    for (int e = 0; e < 2; e++) place_of(w, b->point[e], ends[e]);
    double radius = thickness(w, b, capsules, (const double(*)[3])ends);
    double head = b->is_head && !capsules ? b->radius : 0.0;
    if (shadow && radius > 0.0) ambulo__canvas_shade(w->canvas, ends[0], ends[1], radius, s->floor);
    if (shadow && head > 0.0) ambulo__canvas_shade(w->canvas, ends[1], ends[1], head, s->floor);
    if (shadow) continue;
    if (radius > 0.0) ambulo__canvas_capsule(w->canvas, ends[0], ends[1], radius, b->color, 0);
    if (head > 0.0) ambulo__canvas_capsule(w->canvas, ends[1], ends[1], head, b->color, 0);
  }
}

/* the sole, a rim above it, and what leads from there to the ankle */
static void draw_shoe(const instant *w, const ambulo__film_foot *f) {
  static const int faces[14][3] = {{0, 2, 1}, {0, 3, 2}, {0, 5, 4}, {0, 1, 5}, {1, 6, 5},
                                   {1, 2, 6}, {2, 7, 6}, {2, 3, 7}, {3, 4, 7}, {3, 0, 4},
                                   {4, 8, 5}, {5, 8, 6}, {6, 8, 7}, {7, 8, 4}};
  double p[9][3], ahead[3], aside[3], up[3], middle[3] = {0.0};
  for (int k = 0; k < 4; k++) place_of(w, f->sole[k], p[k]);
  place_of(w, f->ankle, p[8]);
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < 4; k++) middle[i] += 0.25 * p[k][i];
    ahead[i] = p[3][i] - p[0][i];
    aside[i] = p[1][i] - p[0][i];
  }
  ambulo__cross(ahead, aside, up);
  double length = sqrt(ambulo__dot(up, up)), above[3];
  for (int i = 0; i < 3; i++) {
    up[i] /= fmax(length, 1e-12);
    above[i] = p[8][i] - middle[i];
  }
  double sign = ambulo__dot(up, above) < 0.0 ? -1.0 : 1.0;
  double height = fmax(sign * ambulo__dot(up, above), 0.03);
  for (int k = 0; k < 4; k++) {
    double lift = k < 2 ? 0.62 * height : 0.03, inward = k < 2 ? 0.1 : 0.16;
    for (int i = 0; i < 3; i++)
      p[4 + k][i] = p[k][i] + inward * (middle[i] - p[k][i]) + sign * lift * up[i];
  }
  for (int i = 0; i < 3; i++) p[8][i] += 0.012 * sign * up[i];
  for (int k = 0; k < 14; k++)
    ambulo__canvas_triangle(w->canvas, p[faces[k][0]], p[faces[k][1]], p[faces[k][2]], f->color);
}

static void draw_box(const instant *w, const double middle[3], const double size[3]) {
  static const int around[12][3] = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6},
                                    {0, 1, 5}, {0, 5, 4}, {2, 3, 7}, {2, 7, 6},
                                    {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
  double p[8][3];
  for (int k = 0; k < 8; k++)
    for (int i = 0; i < 3; i++) p[k][i] = middle[i] + (k >> i & 1 ? 0.5 : -0.5) * size[i];
  for (int f = 0; f < 12; f++)
    ambulo__canvas_triangle(w->canvas, p[around[f][0]], p[around[f][1]], p[around[f][2]],
                            CARRIED_COLOR);
}

static void draw_rod(const instant *w, double time, const ambulo__film_rod *rod) {
  double ends[2][3], middle[3];
  instant then = *w;
  then.at = ambulo__film_time_of(w->s, fmin(fmax(time, rod->from), rod->to));
  for (int e = 0; e < 2; e++) place_of(&then, rod->point[e], ends[e]);
  for (int i = 0; i < 3; i++) middle[i] = 0.5 * (ends[0][i] + ends[1][i]) + rod->center[i];
  if (rod->radius > 0.0)
    ambulo__canvas_capsule(w->canvas, ends[0], ends[1], rod->radius, DEVICE_COLOR, 0);
  else
    draw_box(w, middle, rod->size);
}

/* a foot in the air has no centre of pressure: none is drawn between two that are far apart */
static void draw_force(const instant *w, const ambulo__film_force *f) {
  double from[3], to[3], head[3], force[3], jump = 0.0;
  for (int i = 0; i < 3; i++) {
    double step = f->pressure[i][w->at.sample + 1] - f->pressure[i][w->at.sample];
    jump += step * step;
    from[i] = ambulo__film_value(f->pressure[i], w->at) + w->shift[i];
    force[i] = ambulo__film_value(f->force[i], w->at) / w->s->weight * force_length;
    to[i] = from[i] + force[i];
  }
  double length = sqrt(ambulo__dot(force, force));
  if (length < 0.05 || jump > 0.04) return;
  ambulo__canvas_capsule(w->canvas, from, to, 0.012, FORCE_COLOR, 1);
  for (int k = 0; k < 12; k++) { /* a cone of discs */
    double share = fmin(0.11, 0.5 * length) / length * (1.0 - k / 12.0);
    for (int i = 0; i < 3; i++) head[i] = to[i] - share * force[i];
    ambulo__canvas_capsule(w->canvas, head, head, 0.004 + 0.034 * (1.0 - k / 12.0), FORCE_COLOR, 1);
  }
}

void ambulo__film_draw(const ambulo__film_scene *s, double time, int period, ambulo_film_view view,
                       ambulo__canvas *canvas) {
  instant w = {.s = s, .at = ambulo__film_time_of(s, time), .canvas = canvas};
  w.shift[0] = period * s->travel;
  w.shift[2] = period * s->rise;
  ambulo__camera camera = camera_of(s, w.at, view, (double)canvas->width / canvas->height);
  for (int i = 0; i < 3; i++) camera.eye[i] += w.shift[i];
  ambulo__canvas_begin(canvas, &camera, s->is_there, s->floor - 0.002);
  if (s->is_there) draw_bones(&w, 1);
  ambulo__canvas_dim(canvas);
  for (int i = 0; i < s->faces; i++)
    ambulo__canvas_triangle(canvas, s->face[i].corner[0], s->face[i].corner[1],
                            s->face[i].corner[2], s->face[i].color);
  for (int i = 0; i < s->posts; i++)
    ambulo__canvas_capsule(canvas, s->post[i].end[0], s->post[i].end[1], s->post[i].radius,
                           POST_COLOR, 0);
  draw_bones(&w, 0);
  for (int i = 0; i < s->feet; i++) draw_shoe(&w, &s->foot[i]);
  for (int i = 0; i < s->rods; i++) draw_rod(&w, time, &s->rod[i]);
  for (int i = 0; i < s->forces; i++) draw_force(&w, &s->force[i]);
}
