/* Obstacles of a picture: outlines from the side, what of them is beside a figure, rings at places.
 */
#include "show/gait_obstacles.h"
#include "ambulo/tools/tools.h"
#include "support/test.h"

#include <string.h>

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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(outlines),
                                     cmocka_unit_test(only_what_is_beside_a_figure_is_drawn),
                                     cmocka_unit_test(what_stands_beside_takes_room)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
