/* Boxes and pushes in the picture: where they are before, while and after they are held. */
#include "show/gait_held.h"

#include "ambulo/tools/tools.h"
#include "support/test.h"

#define LOADS                                                                                      \
  "load=[{name: box, hands: [hand_r, hand_l], mass: 10, center: [0.05, 0, -0.1], size: [0.3, "     \
  "0.4, 0.2], from: 0.5, to: 2}, {name: rope, hands: [hand_l], force: [0, 0, 100], from: 0.5, "    \
  "to: 2}, {name: ball, hands: [hand_r], mass: 8}]"

static const char *const overrides[] = {"time.intervals=32", "constraints.reach=[]", "obstacles=[]",
                                        LOADS};

static double attribute(const char *svg, const char *key) {
  const char *at = strstr(svg, key);
  assert_non_null(at);
  return strtod(at + strlen(key), NULL);
}

static int count(const char *svg, const char *what) {
  int seen = 0;
  for (const char *at = svg; (at = strstr(at, what)); at++) seen++;
  return seen;
}

/* the middle of both hands at a time */
static void middle_at(const ambulo_problem *p, const double *x, double time, double middle[3],
                      double *q) {
  ambulo_workspace *workspace = NULL;
  double *points = calloc(3 * (size_t)p->model->point_count, sizeof *points);
  const ambulo_motion motion = {.size = sizeof(ambulo_motion), .points = points, .q = q};
  const ambulo_hold *hold = &p->definition.holds[0];
  assert_int_equal(ambulo_workspace_create(p, NULL, &workspace), AMBULO_OK);
  assert_int_equal(ambulo_problem_motion(p, workspace, x, 1, &time, &motion), AMBULO_OK);
  for (int k = 0; k < 3; k++)
    middle[k] = 0.5 * (points[3 * hold->hand[0] + k] + points[3 * hold->hand[1] + k]);
  ambulo_workspace_free(workspace);
  free(points);
}

static void test_where_things_are(void **state) {
  (void)state;
  ambulo_problem *p = NULL;
  ambulo__held_places places;
  ambulo__pose pose;
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo_problem_load("models/lift.yaml", overrides, 4, NULL, NULL, &p),
                   AMBULO_OK);
  double *x = calloc((size_t)p->variables, sizeof *x), q[64];
  for (int j = 0; j < p->variables; j++)
    x[j] = 0.2 * sin(1.3 * (j % p->coordinates) + 0.7 * (j / p->coordinates));
  assert_int_equal(ambulo__pose_create(p->model, NULL, &pose), AMBULO_OK);
  assert_int_equal(ambulo__held_places_create(p, x, &a, &places), AMBULO_OK);
  assert_int_equal(places.count, 3);
  const double times[] = {0.1, 0.5, 1.2, 2.0, 3.0}, of_box[] = {0.5, 0.5, 1.2, 2.0, 2.0};
  for (int i = 0; i < 5; i++) {
    ambulo__figure_view view = {.half = 5, .x = 100, .base = 400, .scale = 100, .time = times[i]};
    ambulo__text_buffer text;
    double middle[3], unused[64];
    ambulo__text_init(&text, NULL);
    middle_at(p, x, times[i], middle, q);
    ambulo__pose_at(&pose, q);
    middle_at(p, x, of_box[i], middle, unused);
    ambulo__gait_held_draw(p, &places, &pose, &view, &text);
    const char *svg = ambulo__text_data(&text);
    assert_int_equal(count(svg, "\"box\""), 1);
    assert_int_equal(count(svg, "\"load\""), 1);
    assert_int_equal(count(svg, "\"push\""), i == 2 ? 3 : 0); /* a shaft and two barbs */
    assert_close(attribute(svg, "width=\""), 30, 1e-6);
    assert_close(attribute(svg, "height=\""), 20, 1e-6);
    assert_close(attribute(svg, " x=\""), 100 + 100 * (middle[0] + 0.05) - 15, 1e-3);
    assert_close(attribute(svg, " y=\""), 400 - 100 * (middle[1] - 0.1) - 10, 1e-3);
    ambulo__text_free(&text);
  }
  ambulo__free(&a, places.place);
  ambulo__pose_free(&pose);
  free(x);
  ambulo_problem_free(p);
}

/* what stands is drawn beside its figure only, what is held always */
static void test_beside_the_figure(void **state) {
  (void)state;
  ambulo_problem *p = NULL;
  ambulo__held_places places;
  ambulo__pose pose;
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo_problem_load("models/lift.yaml", overrides, 4, NULL, NULL, &p),
                   AMBULO_OK);
  double *x = calloc((size_t)p->variables, sizeof *x), *q = calloc(64, sizeof *q);
  assert_int_equal(ambulo__pose_create(p->model, NULL, &pose), AMBULO_OK);
  assert_int_equal(ambulo__held_places_create(p, x, &a, &places), AMBULO_OK);
  ambulo__pose_at(&pose, q);
  for (int held = 0; held < 2; held++) {
    ambulo__figure_view view = {.origin = 3, .half = 0.2, .scale = 100, .time = held ? 1.2 : 0.0};
    ambulo__text_buffer text;
    ambulo__text_init(&text, NULL);
    ambulo__gait_held_draw(p, &places, &pose, &view, &text);
    assert_int_equal(count(ambulo__text_data(&text), "\"box\""), held);
    assert_int_equal(count(ambulo__text_data(&text), "\"load\""), 1); /* held from the beginning */
    ambulo__text_free(&text);
  }
  ambulo__free(&a, places.place);
  ambulo__pose_free(&pose);
  free(x);
  free(q);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_where_things_are),
                                     cmocka_unit_test(test_beside_the_figure)};
  return cmocka_run_group_tests_name("picture/gait_held", tests, NULL, NULL);
}
