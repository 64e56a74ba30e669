/* Coarser meshes: what stays of a surface that is made of cells. */
#include "import/meshes.h"
#include "support/fail_alloc.h"
#include "support/test.h"

enum { SIDES = 60, RINGS = 30 };
static const double middle = 0.0100005;

/* a ball of radius 1, as triangles that share no points; none of these lies between two cells */
static ambulo__shell ball(void) {
  const double pi = 3.14159265358979323846;
  int count = 2 * SIDES * RINGS;
  ambulo__shell s = {calloc(9 * (size_t)count, sizeof(double)),
                     calloc(3 * (size_t)count, sizeof(int)), 3 * count, count};
  for (int i = 0, at = 0; i < RINGS; i++)
    for (int k = 0; k < SIDES; k++) {
      const int corners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
      for (int c = 0; c < 6; c++, at++) {
        double down = pi * (i + corners[c][0]) / RINGS;
        double turn = 2.0 * pi * ((k + corners[c][1]) % SIDES) / SIDES;
        double *p = s.points + 3 * at;
        p[0] = middle + sin(down) * cos(turn);
        p[1] = middle + sin(down) * sin(turn);
        p[2] = middle + cos(down);
        s.corners[at] = at;
      }
    }
  return s;
}

/* by the divergence theorem, of a surface without holes */
static double volume(const ambulo__shell *s) {
  double sum = 0.0;
  for (int t = 0; t < s->count; t++) {
    const double *a = s->points + 3 * s->corners[3 * t], *b = s->points + 3 * s->corners[3 * t + 1],
                 *c = s->points + 3 * s->corners[3 * t + 2];
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6.0;
}

/* how many triangles have an edge, whichever way around */
static int uses(const ambulo__shell *s, int from, int to) {
  int count = 0;
  for (int t = 0; t < s->count; t++)
    for (int v = 0; v < 3; v++) {
      int a = s->corners[3 * t + v], b = s->corners[3 * t + (v + 1) % 3];
      count += (a == from && b == to) || (a == to && b == from);
    }
  return count;
}

static void stays_closed(void **state) {
  (void)state;
  const ambulo_allocator heap = ambulo__allocator_or_default(NULL);
  ambulo__shell all = ball(), s = {.points = NULL};
  double exact = 4.0 / 3.0 * 3.14159265358979323846;
  assert_true(fabs(volume(&all) / exact - 1.0) < 0.01);
  assert_int_equal(ambulo__shell_coarsen(&all, 1e-6, &heap, &s), AMBULO_OK);
  assert_int_equal(s.point_count, SIDES * (RINGS - 1) + 2); /* each once */
  assert_int_equal(s.count, 2 * SIDES * (RINGS - 1));       /* without those that have no area */
  assert_close(volume(&s), volume(&all), 1e-12);
  ambulo__shell_free(&heap, &s);
  assert_int_equal(ambulo__shell_coarsen(&all, 0.3, &heap, &s), AMBULO_OK);
  assert_in_range(s.count, 50, 500); /* about twice the area by that of a cell's side: 280 */
  assert_true(fabs(volume(&s) / exact - 1.0) < 0.1);
  for (int t = 0; t < s.count; t++)
    for (int v = 0; v < 3; v++)
      assert_true(uses(&s, s.corners[3 * t + v], s.corners[3 * t + (v + 1) % 3]) >= 2);
  for (int p = 0; p < 3 * s.point_count; p++) assert_true(fabs(s.points[p] - middle) <= 1.0);
  ambulo__shell_free(&heap, &s);
  free(all.points);
  free(all.corners);
}

/* two walls that become one are drawn once; points in the order of triangles, none left over */
static void walls_become_one(void **state) {
  (void)state;
  const ambulo_allocator heap = ambulo__allocator_or_default(NULL);
  double points[] = {9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, .01, 1, 0, .01, 0, 1, .01};
  int corners[] = {3, 2, 1, 4, 5, 6, 1, 4, 2};
  const ambulo__shell walls = {points, corners, 7, 3};
  ambulo__shell s = {.points = NULL};
  assert_int_equal(ambulo__shell_coarsen(&walls, 0.1, &heap, &s), AMBULO_OK);
  assert_int_equal(s.count, 1);
  assert_int_equal(s.point_count, 3);
  for (int v = 0; v < 3; v++) {
    assert_int_equal(s.corners[v], v);
    assert_close(s.points[3 * v + 2], 0.005, 1e-15);
  }
  assert_close(s.points[1], 1.0, 1e-15);
  ambulo__shell_free(&heap, &s);
  const ambulo__shell none = {.points = NULL};
  assert_int_equal(ambulo__shell_coarsen(&none, 0.1, &heap, &s), AMBULO_OK);
  assert_int_equal(s.count, 0);
  ambulo__shell_free(&heap, &s);
}

static void without_memory(void **state) {
  (void)state;
  ambulo__shell all = ball();
  for (long k = 0;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__shell s = {.count = -7};
    ambulo_status status = ambulo__shell_coarsen(&all, 0.3, &allocator, &s);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    if (status) assert_int_equal(s.count, -7);
    if (!status) ambulo__shell_free(&allocator, &s);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  free(all.points);
  free(all.corners);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(stays_closed),
      cmocka_unit_test(walls_become_one),
      cmocka_unit_test(without_memory),
  };
  return cmocka_run_group_tests_name("exchange/shell", tests, NULL, NULL);
}
