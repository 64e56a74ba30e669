/* Rays that meet a floor, capsules and triangles: where they are in the picture and how far. */
#include "show/canvas.h"

#include "support/test.h"

enum { WIDTH = 60, HEIGHT = 40, FINE = AMBULO__CANVAS_FINE };
static const double slope = 0.25;
static ambulo_allocator plain;

/* four metres to the right of the origin, which it looks at; one metre of height has 20 pixels */
static ambulo__canvas looking(double forward, double height, int floor) {
  const double eye[3] = {forward, -4.0, height}, target[3] = {forward, 0.0, 0.0};
  const double up[3] = {0.0, 0.0, 1.0};
  ambulo__camera camera;
  ambulo__canvas canvas;
  plain = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__canvas_create(WIDTH, HEIGHT, &plain, &canvas), AMBULO_OK);
  ambulo__camera_set(&camera, eye, target, up, slope);
  ambulo__canvas_begin(&canvas, &camera, floor, 0.0);
  return canvas;
}

static double depth_at(const ambulo__canvas *c, int x, int y) {
  return (double)c->depth[FINE * y * c->width + FINE * x];
}

/* pixels of this column that something is nearer than the sky in */
static int filled(const ambulo__canvas *c, int x) {
  int count = 0;
  for (int y = 0; y < HEIGHT; y++) count += isfinite(depth_at(c, x, y));
  return count;
}

/* of radius r at distance d it covers the angle asin(r / d) to both sides */
static void a_sphere_is_as_large_as_its_angle(void **state) {
  (void)state;
  ambulo__canvas c = looking(0.0, 0.0, 0);
  const double at[3] = {0.0};
  ambulo__canvas_capsule(&c, at, at, 0.5, 0x102030, 0);
  assert_close(depth_at(&c, WIDTH / 2, HEIGHT / 2), 3.5, 1e-3);
  double wide = tan(asin(0.5 / 4.0)) / slope * HEIGHT;
  assert_true(fabs(filled(&c, WIDTH / 2) - wide) <= 1.0);
  assert_int_equal(filled(&c, 2), 0);
  ambulo__canvas_free(&c, &plain);
}

/* along forward, half a metre to both sides, as thick everywhere; its ends are half spheres */
static void a_capsule_is_a_rod_with_round_ends(void **state) {
  (void)state;
  ambulo__canvas c = looking(0.0, 0.0, 0);
  const double from[3] = {-0.5, 0.0, 0.0}, to[3] = {0.5, 0.0, 0.0};
  ambulo__canvas_capsule(&c, from, to, 0.25, 0x102030, 0);
  for (int x = WIDTH / 2 - 8; x <= WIDTH / 2 + 8; x++) {
    assert_true(fabs(filled(&c, x) - 10.0) <= 1.0);
    assert_close(depth_at(&c, x, HEIGHT / 2), 3.75, 1e-3);
  }
  assert_true(filled(&c, WIDTH / 2 + 14) > 0);
  assert_true(filled(&c, WIDTH / 2 + 14) < 8);
  assert_int_equal(filled(&c, WIDTH / 2 + 17), 0);
  /* along the sight it is a sphere, its nearer end */
  const double near[3] = {0.0, -1.0, 0.0}, far[3] = {0.0, 1.0, 0.0};
  ambulo__canvas_free(&c, &plain);
  c = looking(0.0, 0.0, 0);
  ambulo__canvas_capsule(&c, far, near, 0.25, 0x102030, 0);
  assert_close(depth_at(&c, WIDTH / 2, HEIGHT / 2), 2.75, 1e-3);
  ambulo__canvas_free(&c, &plain);
}

/* what is nearer stays, in whatever order it is drawn; on top is on top */
static void the_nearer_one_is_seen(void **state) {
  (void)state;
  const double near[3] = {0.0, -1.0, 0.0}, far[3] = {0.0, 1.0, 0.0};
  for (int order = 0; order < 3; order++) {
    ambulo__canvas c = looking(0.0, 0.0, 0);
    unsigned char pixels[WIDTH * HEIGHT * 3];
    const unsigned char *middle = pixels + 3 * (HEIGHT / 2 * WIDTH + WIDTH / 2);
    ambulo__canvas_capsule(&c, order == 1 ? far : near, order == 1 ? far : near, 0.3,
                           order == 1 ? 0xff : 0xff0000, 0);
    ambulo__canvas_capsule(&c, order == 1 ? near : far, order == 1 ? near : far, 0.3,
                           order == 1 ? 0xff0000 : 0xff, order == 2);
    ambulo__canvas_pixels(&c, pixels);
    assert_true(order == 2 ? middle[0] == 0 && middle[2] == 255
                           : middle[0] > 100 && middle[2] == 0);
    ambulo__canvas_free(&c, &plain);
  }
}

/* the plane left = forward: as far at each point as the ray to it is long */
static void a_triangle_is_in_its_plane(void **state) {
  (void)state;
  ambulo__canvas c = looking(0.0, 0.0, 0);
  const double a[3] = {-1.0, -1.0, -1.0}, b[3] = {1.0, 1.0, -1.0}, d[3] = {0.0, 0.0, 2.0};
  ambulo__canvas_triangle(&c, a, b, d, 0x808080);
  int seen = 0;
  for (int x = 20; x < 40; x++) {
    double right = (2.0 * (FINE * x + 0.5) - c.width) / c.height * slope;
    /* -4 + t = forward = t right */
    double depth = 4.0 / (1.0 - right);
    if (!isfinite(depth_at(&c, x, HEIGHT / 2))) continue;
    seen++;
    assert_close(depth_at(&c, x, HEIGHT / 2), depth, 2e-3);
  }
  assert_true(seen > 10);
  ambulo__canvas_free(&c, &plain);
}

static void the_floor_is_level_and_dark_under_a_body(void **state) {
  (void)state;
  ambulo__canvas c = looking(0.0, 2.0, 1);
  const double at[3] = {0.0, 0.0, 0.5};
  const ambulo__camera *eye = &c.camera;
  for (int y = 0; y < c.height; y += 7) {
    double up = (c.height - 2.0 * (y + 0.5)) / c.height * slope;
    double depth = -eye->eye[2] / (eye->ahead[2] + up * eye->up[2]);
    assert_close((double)c.depth[y * c.width + c.width / 2] / depth, 1.0, 1e-5);
  }
  ambulo__canvas_shade(&c, at, at, 0.3, 0.0);
  int dark = 0;
  double forward = 0.0;
  for (int k = 0; k < c.width * c.height; k++) {
    if (!c.shadow[k]) continue;
    double right = (2.0 * (k % c.width + 0.5) - c.width) / c.height * slope;
    forward += (double)c.depth[k] * right;
    dark++;
  }
  /* a disc of radius 0.3 whose middle the sun has moved by 0.5 * 0.295 / 0.847 back */
  assert_true(dark > 50);
  assert_close(forward / dark, -0.174, 0.02);
  ambulo__canvas_free(&c, &plain);
}

/* the grid comes again each half metre */
static void the_floor_comes_again(void **state) {
  (void)state;
  unsigned char one[WIDTH * HEIGHT * 3], other[WIDTH * HEIGHT * 3];
  for (int k = 0; k < 3; k++) {
    ambulo__canvas c = looking(k == 1 ? 1.5 : k == 2 ? 0.2 : 0.0, 1.0, 1);
    ambulo__canvas_pixels(&c, k ? other : one);
    ambulo__canvas_free(&c, &plain);
    if (k) assert_int_equal(memcmp(one, other, sizeof one) == 0, k == 1);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_sphere_is_as_large_as_its_angle),
      cmocka_unit_test(a_capsule_is_a_rod_with_round_ends),
      cmocka_unit_test(the_nearer_one_is_seen),
      cmocka_unit_test(a_triangle_is_in_its_plane),
      cmocka_unit_test(the_floor_is_level_and_dark_under_a_body),
      cmocka_unit_test(the_floor_comes_again),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
