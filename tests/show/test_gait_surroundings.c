/* The ground of a picture: surfaces of contacts, one behind the other. */
#include "ambulo/tools/tools.h"
#include "show/gait_surroundings.h"
#include "support/test.h"
#include "support/walker_result.h"

#include <string.h>

/* ground of the walker on other contacts, which the problem does not own */
static void ground_of(walk *w, const ambulo_contact *contacts, int count, ambulo__gait_ground *g) {
  ambulo_problem_definition own = w->problem->definition;
  w->problem->definition.contacts = contacts;
  w->problem->definition.contact_count = count;
  assert_int_equal(ambulo__gait_ground_create(w->problem, NULL, g), AMBULO_OK);
  w->problem->definition.contacts = own.contacts;
  w->problem->definition.contact_count = own.contact_count;
}

static double height_at(const ambulo__gait_ground *g, double x) {
  for (int i = 0; i < g->count; i++)
    if (x >= g->surface[i].from && x <= g->surface[i].to)
      return ambulo__surface_height(&g->surface[i], x);
  return NAN;
}

static void level_ground_has_no_surfaces(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  ambulo__gait_ground g;
  assert_int_equal(ambulo__gait_ground_create(w.problem, NULL, &g), AMBULO_OK);
  assert_int_equal(g.count, 0);
  ambulo__gait_ground_free(&g);
  walk_close(&w);
}

/* a step that rises: also those before and after it, with risers between their feet */
static void stairs_go_on_before_and_after(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  ambulo_contact contacts[2] = {{0, AMBULO_CONTACT_FLAT, 0.0, 0.4, .place = {0.0, 0.0, 0.0}},
                                {0, AMBULO_CONTACT_TOE, 0.4, 0.5, .place = {0.0, 0.0, 0.0}}};
  w.problem->definition.travel = 0.5;
  w.problem->definition.rise = 0.2;
  ambulo__gait_ground g;
  ground_of(&w, contacts, 2, &g);
  assert_int_equal(g.count, 6); /* heel, flat and toe of a foot are one */
  assert_true(isinf(g.surface[0].from) && isinf(g.surface[5].to));
  for (int i = -2; i <= 3; i++) {
    assert_close(height_at(&g, 0.5 * i), 0.2 * i, 1e-12);
    if (i < 3) assert_close(g.surface[i + 2].to, g.surface[i + 3].from, 0.0);
  }
  double reach = 2.0 * g.surface[2].to - 0.5;
  assert_true(reach > 0.1 && reach < 0.4);
  ambulo__gait_ground_free(&g);
  walk_close(&w);
}

static void a_slope_rises_along_its_surface(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  ambulo_contact contact = {0,   AMBULO_CONTACT_FLAT,      0.0,
                            0.4, .place = {1.0, 0.0, 0.3}, .normal = {-0.1, 0.0, 2.0}};
  w.problem->definition.ends = AMBULO_ENDS_FREE;
  ambulo__gait_ground g;
  ground_of(&w, &contact, 1, &g);
  assert_int_equal(g.count, 1);
  assert_close(height_at(&g, 1.0), 0.3, 1e-15);
  assert_close(height_at(&g, 1.4), 0.32, 1e-12);
  ambulo__gait_ground_free(&g);
  walk_close(&w);
}

static int test_gait_ground_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(level_ground_has_no_surfaces),
                                     cmocka_unit_test(stairs_go_on_before_and_after),
                                     cmocka_unit_test(a_slope_rises_along_its_surface)};
  return cmocka_run_group_tests_name("picture/gait_ground", tests, NULL, NULL);
}

/* Obstacles of a picture: outlines from the side, what of them is beside a figure, rings at places.
 */

static ambulo_problem *task(void) {
  static const char text[] =
      "ambulo: 1\nkind: problem\nmodel: models/lower_body_18.yaml\nangles: degrees\n"
      "time: {duration: 1, intervals: 4}\nobjective: none\n"
      "obstacles:\n"
      "  - {name: box, center: [1, 2, 0.5], half_size: [0.1, 0.2, 0.3]}\n"
      "  - {name: turned, center: [1, 0, 0.5], half_size: [0.1, 0.2, 0.3], heading: 90}\n"
      "  - {name: rail, from: [2, -1, 1], to: [2, 1, 1], radius: 0.05}\n"
      "  - {name: post, from: [3, 0, 0], to: [3, 0, 1], radius: 0.05}\n"
      "constraints:\n"
      "  ground_height: 0.2\n"
      "  reach: [{point: head_top, place: [1, 0, 1.5], at: 0.5}]\n";
  ambulo_problem *p = NULL;
  assert_int_equal(
      ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                      .text = text,
                                                      .length = sizeof text - 1,
                                                      .name = "t"},
                               NULL, NULL, &p),
      0);
  return p;
}

static void expect(const ambulo_problem *p, int obstacle, const double side[4], int is_round) {
  ambulo__outline o = ambulo__obstacle_outline(p, obstacle);
  assert_close(o.from, side[0], 1e-12);
  assert_close(o.to, side[1], 1e-12);
  assert_close(o.low, side[2], 1e-12);
  assert_close(o.high, side[3], 1e-12);
  assert_int_equal(o.is_round, is_round);
}

/* above the ground, wherever that is */
static void outlines(void **state) {
  (void)state;
  ambulo_problem *p = task();
  expect(p, 0, (const double[]){0.9, 1.1, 0.2, 0.8}, 0);
  expect(p, 1, (const double[]){0.8, 1.2, 0.2, 0.8}, 0);
  expect(p, 2, (const double[]){1.95, 2.05, 0.95, 1.05}, 1);
  expect(p, 3, (const double[]){2.95, 3.05, -0.05, 1.05}, 0);
  ambulo_problem_free(p);
}

static int count(const char *text, const char *part) {
  int found = 0;
  for (const char *at = strstr(text, part); at; at = strstr(at + 1, part)) found++;
  return found;
}

static void drawn(const ambulo_problem *p, double origin, double half, double time, int obstacles,
                  int places) {
  ambulo__text_buffer text;
  ambulo__figure_view view = {.origin = origin,
                              .half = half,
                              .x = 100.0,
                              .base = 200.0,
                              .scale = 50.0,
                              .time = time,
                              .apart = 0.2};
  ambulo__text_init(&text, NULL);
  ambulo__gait_obstacles_draw(p, &view, &text);
  assert_int_equal(count(ambulo__text_data(&text), "\"obstacle\""), obstacles);
  assert_int_equal(count(ambulo__text_data(&text), "\"place\""), places);
  ambulo__text_free(&text);
}

static void only_what_is_beside_a_figure_is_drawn(void **state) {
  (void)state;
  ambulo_problem *p = task();
  drawn(p, 0.0, 0.5, 0.0, 0, 0);
  drawn(p, 0.5, 0.45, 0.0, 2, 0); /* a part of both boxes */
  drawn(p, 1.5, 0.55, 0.5, 3, 1); /* and the rail; the place at its time */
  drawn(p, 1.5, 0.45, 0.45, 2, 1);
  drawn(p, 0.0, 9.0, 0.61, 4, 0);
  ambulo_problem_free(p);
}

static void wider(const ambulo_problem *p, double origin, double half, const double want[2]) {
  double left = -0.1, right = 0.1;
  int is_wider = want[0] < left || want[1] > right;
  assert_int_equal(ambulo__obstacles_widen(p, origin, half, &left, &right), is_wider);
  assert_close(left, want[0], 1e-12);
  assert_close(right, want[1], 1e-12);
}

/* by what is beside, to its far side or as far as things are drawn */
static void what_stands_beside_takes_room(void **state) {
  (void)state;
  ambulo_problem *p = task();
  wider(p, 0.0, 0.5, (const double[]){-0.1, 0.1});
  wider(p, 0.5, 0.45, (const double[]){-0.1, 0.45});
  wider(p, 0.5, 1.0, (const double[]){-0.1, 0.7});
  wider(p, 1.5, 0.6, (const double[]){-0.6, 0.55});
  wider(p, 1.0, 0.5, (const double[]){-0.2, 0.2});
  ambulo_problem_free(p);
}

static int test_gait_obstacles_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(outlines),
                                     cmocka_unit_test(only_what_is_beside_a_figure_is_drawn),
                                     cmocka_unit_test(what_stands_beside_takes_room)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Boxes and pushes in the picture: where they are before, while and after they are held. */

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

static int test_gait_held_count(const char *svg, const char *what) {
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
    assert_int_equal(test_gait_held_count(svg, "\"box\""), 1);
    assert_int_equal(test_gait_held_count(svg, "\"load\""), 1);
    assert_int_equal(test_gait_held_count(svg, "\"push\""),
                     i == 2 ? 3 : 0); /* a shaft and two barbs */
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
    assert_int_equal(test_gait_held_count(ambulo__text_data(&text), "\"box\""), held);
    assert_int_equal(test_gait_held_count(ambulo__text_data(&text), "\"load\""),
                     1); /* held from the beginning */
    ambulo__text_free(&text);
  }
  ambulo__free(&a, places.place);
  ambulo__pose_free(&pose);
  free(x);
  free(q);
  ambulo_problem_free(p);
}

static int test_gait_held_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_where_things_are),
                                     cmocka_unit_test(test_beside_the_figure)};
  return cmocka_run_group_tests_name("picture/gait_held", tests, NULL, NULL);
}

int main(void) {
  return test_gait_ground_tests() + test_gait_obstacles_tests() + test_gait_held_tests();
}
