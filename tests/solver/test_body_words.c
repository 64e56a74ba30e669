/* Violations of capsules and obstacles in words: inside, or only too near. */
#include "solver/body_words.h"
#include "ambulo/tools/tools.h"
#include "support/test.h"

#include <string.h>

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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(what_happens_is_said),
                                     cmocka_unit_test(others_are_left_alone)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
