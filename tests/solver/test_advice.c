/* How suggestions are rounded and written; what helps rows on capsules, obstacles and places. */
#include "ambulo/tools/tools.h"
#include "solver/explain.h"
#include "support/suggest_cases.h"
#include "support/test.h"

#include <math.h>
#include <string.h>

static void new_values_are_rounded_outward(void **state) {
  (void)state;
  assert_close(ambulo__outward(0.123449, 1), 0.1235, 1e-15);
  assert_close(ambulo__outward(0.123451, 0), 0.1234, 1e-15);
  assert_close(ambulo__outward(-123.44, 0), -123.5, 1e-12);
  assert_close(ambulo__outward(-123.46, 1), -123.4, 1e-12);
  assert_close(ambulo__outward(0.25, 1), 0.25, 1e-15);
  assert_true(ambulo__outward(0.0, 1) == 0.0 && isinf(ambulo__outward(INFINITY, 1)));
}

static ambulo_problem *task(void) {
  static const char text[] =
      "ambulo: 1\nkind: problem\nmodel: models/lower_body_18.yaml\nobjective: none\n"
      "time: {duration: 1, intervals: 25}\n" /* 1 cm for what passes */
      "obstacles: [{name: hurdle, center: [0.6, 0, 1.2], half_size: [0.1, 1, 0.1], margin: 0.02}]\n"
      "constraints: {collision: {pairs: [[shank_l, shank_r]], margin: 0.01}}\n";
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

static void what_happens_is_said(void **state) {
  (void)state;
  static const struct {
    ambulo_violation v;
    const char *words;
  } cases[] = {
      {{.worst = 0.042,
        .family = "obstacle",
        .subject = "shank_l",
        .detail = "hurdle",
        .time = 0.31},
       "shank_l is 0.012 m inside obstacle 'hurdle' at t = 0.31 s"},
      {{.worst = 0.012,
        .family = "obstacle",
        .subject = "shank_l",
        .detail = "hurdle",
        .time = 0.31},
       "shank_l comes within 0.018 m of obstacle 'hurdle' at t = 0.31 s, 0.012 m too near"},
      {{.worst = 0.025,
        .family = "collision",
        .subject = "shank_l",
        .detail = "shank_r",
        .time = 1},
       "shank_l is 0.005 m inside shank_r at t = 1 s"},
      {{.worst = 0.005,
        .family = "collision",
        .subject = "shank_l",
        .detail = "shank_r",
        .time = 1},
       "shank_l comes within 0.015 m of shank_r at t = 1 s, 0.005 m too near"}};
  ambulo_problem *p = task();
  char text[300];
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    assert_int_equal(ambulo__bodies_in_words(p, &cases[i].v, text, sizeof text), 1);
    assert_string_equal(text, cases[i].words);
  }
  ambulo_problem_free(p);
}

static void others_are_left_alone(void **state) {
  (void)state;
  ambulo_problem *p = task();
  char text[300] = "as it was";
  ambulo_violation v = {.worst = 0.1, .family = "contact", .subject = "left", .detail = "low"};
  assert_int_equal(ambulo__bodies_in_words(p, &v, text, sizeof text), 0);
  v.family = "obstacle";
  v.detail = "wall";
  assert_int_equal(ambulo__bodies_in_words(p, &v, text, sizeof text), 0);
  v.detail = "hurdle";
  v.worst = INFINITY;
  assert_int_equal(ambulo__bodies_in_words(p, &v, text, sizeof text), 0);
  assert_string_equal(text, "as it was");
  ambulo_problem_free(p);
}

#define OBSTACLE                                                                                   \
  "obstacles=[{name: crate, center: [1, 0, 0.1], half_size: [0.1, 0.1, 0.1], margin: 0.03}]"
static const char NORMAL[] = "models/walk_normal.yaml";
static const char STAND[] = "models/reach_standing.yaml";

static const miss cases[] = {
    {NORMAL,
     {"constraints.collision={margin: 0.02}"},
     "collision",
     "shank_r",
     "shank_l",
     -0.004,
     "m too near: keep a margin of 0.0158 m instead of 0.02 m",
     {"constraints.collision.margin=0.0158"},
     1},
    {NORMAL,
     {"constraints.collision={margin: 0.02}"},
     "collision",
     "shank_r",
     "shank_l",
     -0.06,
     "s: give them another way past each other",
     {0},
     1},
    {STAND,
     {OBSTACLE},
     "obstacle",
     "foot_l",
     "crate",
     -0.01,
     "foot_l comes within 0.0307 m of obstacle 'crate' at t = 2.4 s, 0.01 m too near: keep a "
     "margin "
     "of 0.0198 m instead of 0.03 m",
     {"obstacles[crate].margin=0.0198"},
     1},
    {STAND,
     {OBSTACLE},
     "obstacle",
     "foot_l",
     "crate",
     -0.09,
     "m inside obstacle 'crate' at t = 2.4 s: make 'crate' smaller",
     {0},
     1},
    {STAND,
     {0},
     "reach",
     "head_top",
     "up lower",
     -0.02,
     "head_top does not come to its place at t = 1.2 s, by 0.02 m (up lower)",
     {"constraints.reach[0].tolerance=0.0252"},
     1},
};

static void each_is_said_and_followed(void **state) {
  (void)state;
  try_misses(cases, (int)(sizeof cases / sizeof *cases));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(new_values_are_rounded_outward),
      cmocka_unit_test(what_happens_is_said),
      cmocka_unit_test(others_are_left_alone),
      cmocka_unit_test(each_is_said_and_followed),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
