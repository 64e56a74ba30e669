/* show/canvas.c - rays that meet floor, capsules and triangles (canvas.h).
 *
 * The ray of a point of the picture is eye + t d, d = ahead + x right + y up with x, y in tangents:
 * so t is the depth along `ahead`, and what is nearest has the least t.
 *
 *     floor      t = (height - eye_u) / d_u
 *     sphere     |eye + t d - c|^2 = r^2
 *     cylinder   the same of the parts at right angles to its axis; where the foot of the point on
 *                the axis is beyond an end, the sphere of that end
 *     triangle   1 / t is linear over the picture: barycentric in it
 *
 * Light: the sky from above and a sun; the floor fades into the sky far away. */
#include "show/canvas.h"

#include "base/arithmetic.h"

#include <math.h>
#include <string.h>

static const double nearest = 0.05, fade_from = 9.0, fade_to = 24.0, square = 0.5, line = 0.012;
/* to the sun: forward, left, up; as on the page */
static const double sun[3] = {0.295, -0.442, 0.847};
enum { SKY = 0xeef2f6, FLOOR = 0xd2d8df, GRID = 0xaeb8c3 };

static void normalize(double v[3]) {
  double length = sqrt(ambulo__dot(v, v));
  for (int i = 0; i < 3 && length > 0.0; i++) v[i] /= length;
}

void ambulo__camera_set(ambulo__camera *camera, const double eye[3], const double target[3],
                        const double upright[3], double slope) {
  ambulo__camera c = {.slope = slope};
  for (int i = 0; i < 3; i++) {
    c.eye[i] = eye[i];
    c.ahead[i] = target[i] - eye[i];
  }
  normalize(c.ahead);
  ambulo__cross(c.ahead, upright, c.right);
  normalize(c.right);
  ambulo__cross(c.right, c.ahead, c.up);
  *camera = c;
}

ambulo_status ambulo__canvas_create(int width, int height, const ambulo_allocator *a,
                                    ambulo__canvas *canvas) {
  ambulo__canvas c = {.width = AMBULO__CANVAS_FINE * width, .height = AMBULO__CANVAS_FINE * height};
  size_t points = (size_t)c.width * (size_t)c.height;
  c.depth = ambulo__alloc(a, points, sizeof *c.depth);
  c.color = ambulo__alloc(a, points, 3);
  c.shadow = ambulo__alloc(a, points, 1);
  if (!c.depth || !c.color || !c.shadow) {
    ambulo__canvas_free(&c, a);
    return AMBULO_E_MEMORY;
  }
  *canvas = c;
  return AMBULO_OK;
}

void ambulo__canvas_free(ambulo__canvas *c, const ambulo_allocator *a) {
  ambulo__free(a, c->depth);
  ambulo__free(a, c->color);
  ambulo__free(a, c->shadow);
  memset(c, 0, sizeof *c);
}

/* ------------------------------------------------------------------- places */

/* from the middle of the picture to its points: right and up, in tangents */
static double across(const ambulo__canvas *c, double x) {
  return (2.0 * (x + 0.5) - c->width) / c->height * c->camera.slope;
}
static double upward(const ambulo__canvas *c, double y) {
  return (c->height - 2.0 * (y + 0.5)) / c->height * c->camera.slope;
}

static void ray_of(const ambulo__canvas *c, int x, int y, double ray[3]) {
  double right = across(c, x), up = upward(c, y);
  for (int i = 0; i < 3; i++)
    ray[i] = c->camera.ahead[i] + right * c->camera.right[i] + up * c->camera.up[i];
}

/* x, y of the picture and the depth */
static void project(const ambulo__canvas *c, const double at[3], double point[3]) {
  double from[3];
  for (int i = 0; i < 3; i++) from[i] = at[i] - c->camera.eye[i];
  double depth = point[2] = ambulo__dot(from, c->camera.ahead);
  double scale = 0.5 * c->height / (c->camera.slope * fmax(depth, nearest));
  point[0] = 0.5 * c->width + scale * ambulo__dot(from, c->camera.right) - 0.5;
  point[1] = 0.5 * c->height - scale * ambulo__dot(from, c->camera.up) - 0.5;
}

/* a part of the picture: [x from, to), [y from, to) */
typedef struct box {
  int from[2], to[2];
} box;

static int limited(double x, int most) {
  return x < 0.0 ? 0 : x > most ? most : (int)x;
}

static void widen(const ambulo__canvas *c, const double at[3], double radius, int first, box *b) {
  double point[3];
  const int most[2] = {c->width, c->height};
  project(c, at, point);
  double size =
      0.5 * c->height * radius / (c->camera.slope * fmax(point[2] - radius, nearest)) + 2.0;
  for (int i = 0; i < 2; i++) {
    int from = limited(floor(point[i] - size), most[i]),
        to = limited(ceil(point[i] + size), most[i]);
    if (first || from < b->from[i]) b->from[i] = from;
    if (first || to > b->to[i]) b->to[i] = to;
  }
}

/* 0: behind the eye */
static int box_of(const ambulo__canvas *c, const double from[3], const double to[3], double radius,
                  box *b) {
  double one[3], other[3];
  project(c, from, one);
  project(c, to, other);
  if (fmin(one[2], other[2]) < radius + nearest) return 0;
  widen(c, from, radius, 1, b);
  widen(c, to, radius, 0, b);
  return 1;
}

/* -------------------------------------------------------------------- light */

static void put(ambulo__canvas *c, size_t at, ambulo__color color, double light) {
  for (int i = 0; i < 3; i++) {
    double value = (double)(color >> (16 - 8 * i) & 255u) * light;
    c->color[3 * at + (size_t)i] = (unsigned char)(value > 255.0 ? 255.0 : value);
  }
}

static double light_on(const double normal[3]) {
  return 0.62 + 0.14 * normal[2] + 0.42 * fmax(ambulo__dot(normal, sun), 0.0);
}

static ambulo__color mixed(ambulo__color a, ambulo__color b, double share) {
  ambulo__color color = 0;
  for (int shift = 0; shift <= 16; shift += 8) {
    double one = (double)(a >> shift & 255u), other = (double)(b >> shift & 255u);
    color |= (ambulo__color)(one + share * (other - one)) << shift;
  }
  return color;
}

/* how far a line of the grid covers a point that is `wide` m */
static double on_line(double x, double wide) {
  double off = fabs(x - square * rint(x / square));
  double share = (0.5 * line - off) / fmax(wide, 1e-6) + 0.5;
  return share < 0.0 ? 0.0 : share > 1.0 ? fmin(1.0, line / wide) : share;
}

void ambulo__canvas_begin(ambulo__canvas *c, const ambulo__camera *camera, int floor,
                          double height) {
  c->camera = *camera;
  memset(c->shadow, 0, (size_t)c->width * (size_t)c->height);
  for (int y = 0; y < c->height; y++) {
    for (int x = 0; x < c->width; x++) {
      size_t at = (size_t)y * (size_t)c->width + (size_t)x;
      double ray[3];
      ray_of(c, x, y, ray);
      double depth = (height - camera->eye[2]) / ray[2];
      int there = floor && depth > nearest && depth < fade_to;
      c->depth[at] = there ? (float)depth : INFINITY;
      ambulo__color color = SKY;
      if (there) {
        double wide = 2.0 * depth * camera->slope / c->height * 2.0;
        double a = on_line(camera->eye[0] + depth * ray[0], wide);
        double b = on_line(camera->eye[1] + depth * ray[1], wide);
        double far = fmax((depth - fade_from) / (fade_to - fade_from), 0.0);
        color = mixed(mixed(FLOOR, GRID, 0.8 * fmax(a, b)), SKY, far);
      }
      put(c, at, color, 1.0);
    }
  }
}

/* ----------------------------------------------------------------- shadows */

void ambulo__canvas_shade(ambulo__canvas *c, const double from[3], const double to[3],
                          double radius, double height) {
  double end[2][3], way[3];
  const double *ends[2] = {from, to};
  box b;
  for (int e = 0; e < 2; e++)
    for (int i = 0; i < 3; i++) end[e][i] = ends[e][i] - sun[i] / sun[2] * (ends[e][2] - height);
  if (from[2] < height || !box_of(c, end[0], end[1], radius, &b)) return;
  for (int i = 0; i < 3; i++) way[i] = end[1][i] - end[0][i];
  double length = ambulo__dot(way, way);
  for (int y = b.from[1]; y < b.to[1]; y++) {
    for (int x = b.from[0]; x < b.to[0]; x++) {
      size_t at = (size_t)y * (size_t)c->width + (size_t)x;
      double ray[3], off[3];
      if (!isfinite(c->depth[at])) continue;
      ray_of(c, x, y, ray);
      for (int i = 0; i < 3; i++)
        off[i] = c->camera.eye[i] + (double)c->depth[at] * ray[i] - end[0][i];
      double share = length > 0.0 ? ambulo__dot(off, way) / length : 0.0;
      share = share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
      for (int i = 0; i < 3; i++) off[i] -= share * way[i];
      if (ambulo__dot(off, off) < radius * radius) c->shadow[at] = 1;
    }
  }
}

void ambulo__canvas_dim(ambulo__canvas *c) {
  size_t points = (size_t)c->width * (size_t)c->height;
  for (size_t at = 0; at < points; at++)
    for (size_t i = 0; i < 3 && c->shadow[at]; i++)
      c->color[3 * at + i] = (unsigned char)(0.76 * c->color[3 * at + i]);
}

/* ----------------------------------------------------------------- capsules */

/* the nearer meeting of a ray with a sphere about `off` before the eye; INFINITY: none */
static double meet_sphere(const double ray[3], const double off[3], double radius) {
  double a = ambulo__dot(ray, ray), b = ambulo__dot(ray, off);
  double under = b * b - a * (ambulo__dot(off, off) - radius * radius);
  return under < 0.0 ? INFINITY : (-b - sqrt(under)) / a;
}

/* the axis of a capsule: where its first end is from, which way the second, seen from the eye */
typedef struct axis {
  double off[3], end[3], way[3], length, along, square;
} axis;

/* *foot: of the point on the axis, as a share of it */
static double meet(const double ray[3], const axis *x, double radius, double *foot) {

  double ray_way = ambulo__dot(ray, x->way);
  double a = x->length * ambulo__dot(ray, ray) - ray_way * ray_way;
  double b = x->length * ambulo__dot(ray, x->off) - x->along * ray_way;
  double e = x->length * (x->square - radius * radius) - x->along * x->along;
  double under = b * b - a * e;
  if (x->length > 1e-12 && a > 1e-12 && under < 0.0) return INFINITY;
  double depth = x->length > 1e-12 && a > 1e-12 ? (-b - sqrt(under)) / a : 0.0;
  double y = x->length > 1e-12 ? (x->along + depth * ray_way) / x->length : 0.0;
  *foot = y < 0.0 ? 0.0 : y > 1.0 ? 1.0 : y;
  if (x->length > 1e-12 && a > 1e-12 && y > 0.0 && y < 1.0) return depth;
  return meet_sphere(ray, y <= 0.0 ? x->off : x->end, radius);
}

void ambulo__canvas_capsule(ambulo__canvas *c, const double from[3], const double to[3],
                            double radius, ambulo__color color, int on_top) {
  axis a;
  box b;
  if (!box_of(c, from, to, radius, &b)) return;
  for (int i = 0; i < 3; i++) {
    a.off[i] = c->camera.eye[i] - from[i];
    a.end[i] = c->camera.eye[i] - to[i];
    a.way[i] = to[i] - from[i];
  }
  a.length = ambulo__dot(a.way, a.way);
  a.along = ambulo__dot(a.off, a.way);
  a.square = ambulo__dot(a.off, a.off);
  for (int y = b.from[1]; y < b.to[1]; y++) {
    for (int x = b.from[0]; x < b.to[0]; x++) {
      size_t at = (size_t)y * (size_t)c->width + (size_t)x;
      double ray[3], normal[3], foot = 0.0;
      ray_of(c, x, y, ray);
      double depth = meet(ray, &a, radius, &foot);
      if (!(depth > nearest && depth < (on_top ? fade_to : (double)c->depth[at]))) continue;
      for (int i = 0; i < 3; i++)
        normal[i] = (a.off[i] + depth * ray[i] - foot * a.way[i]) / radius;
      put(c, at, color, on_top ? 1.0 : light_on(normal));
      c->depth[at] = on_top ? 0.0F : (float)depth;
    }
  }
}

/* ---------------------------------------------------------------- triangles */

void ambulo__canvas_triangle(ambulo__canvas *c, const double a[3], const double b[3],
                             const double d[3], ambulo__color color) {
  double p[3][3], one[3], other[3], normal[3];
  const double *corner[3] = {a, b, d};
  for (int k = 0; k < 3; k++) {
    project(c, corner[k], p[k]);
    if (p[k][2] < nearest) return;
  }
  double area =
      (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
  if (fabs(area) < 1e-9) return;
  for (int i = 0; i < 3; i++) {
    one[i] = b[i] - a[i];
    other[i] = d[i] - a[i];
  }
  ambulo__cross(one, other, normal);
  normalize(normal);
  for (int i = 0; i < 3; i++) other[i] = c->camera.eye[i] - a[i];
  double side = ambulo__dot(normal, other) < 0.0 ? -1.0 : 1.0;
  for (int i = 0; i < 3; i++) normal[i] *= side;
  double light = light_on(normal);
  int x0 = limited(fmin(fmin(p[0][0], p[1][0]), p[2][0]), c->width);
  int x1 = limited(fmax(fmax(p[0][0], p[1][0]), p[2][0]) + 1.0, c->width);
  int y0 = limited(fmin(fmin(p[0][1], p[1][1]), p[2][1]), c->height);
  int y1 = limited(fmax(fmax(p[0][1], p[1][1]), p[2][1]) + 1.0, c->height);
  for (int y = y0; y < y1; y++) {
    for (int x = x0; x < x1; x++) {
      double w[3], depth = 0.0;
      for (int k = 0; k < 3; k++) {
        const double *q = p[(k + 1) % 3], *r = p[(k + 2) % 3];
        w[k] = ((r[0] - q[0]) * (y - q[1]) - (r[1] - q[1]) * (x - q[0])) / area;
        depth += w[k] / p[k][2];
      }
      size_t at = (size_t)y * (size_t)c->width + (size_t)x;
      if (w[0] < 0.0 || w[1] < 0.0 || w[2] < 0.0 || !(1.0 / depth < (double)c->depth[at])) continue;
      put(c, at, color, light);
      c->depth[at] = (float)(1.0 / depth);
    }
  }
}

void ambulo__canvas_pixels(const ambulo__canvas *c, unsigned char *pixels) {
  enum { FINE = AMBULO__CANVAS_FINE };
  for (int y = 0; y < c->height / FINE; y++) {
    for (int x = 0; x < c->width / FINE; x++) {
      for (int i = 0; i < 3; i++) {
        unsigned sum = FINE * FINE / 2;
        for (int k = 0; k < FINE * FINE; k++)
          sum += c->color[3 * ((FINE * y + k / FINE) * c->width + FINE * x + k % FINE) + i];
        *pixels++ = (unsigned char)(sum / (FINE * FINE));
      }
    }
  }
}
