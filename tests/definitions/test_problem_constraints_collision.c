/* Capsules, obstacles and places to reach in problem files. */
#include "support/find_capsule.h"
#include "base/diagnostics.h"
#include "definitions/problem_text.h"

/* `constraints.collision`, `constraints.reach` and `obstacles` of a problem file: what is read, and
 * what is refused, with the key it is about. */

#define BODY                                                                                       \
  "ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\nangles: degrees\nobjective: none\n"        \
  "time: {duration: 1, intervals: 8}\n"

static void what_is_read(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(
      BODY
      "obstacles:\n"
      "  - {name: step, center: [1, 2, 0.1], half_size: [0.1, 0.2, 0.1], heading: 90}\n"
      "  - {name: bar, from: [0, -1, 1], to: [0, 1, 1], radius: 0.02, margin: 0.05, capsules: "
      "[head]}\n"
      "constraints:\n"
      "  collision: {pairs: [[foot_l, foot_r]], margin: 0.02}\n"
      "  reach: [{point: head_top, place: [0.1, 0.2, 1.6], at: [0.25, 0.5], tolerance: 0.01}]\n");
  const ambulo_problem_definition *d = &p->definition;
  assert_int_equal(d->obstacle_count, 2);
  const ambulo_obstacle *box = ambulo_problem_obstacle(p, 0), *bar = ambulo_problem_obstacle(p, 1);
  assert_string_equal(box->name, "step");
  assert_int_equal(box->shape, AMBULO_OBSTACLE_BOX);
  assert_close(box->center[1], 2.0, 0.0);
  assert_close(box->half[1], 0.2, 0.0);
  assert_close(box->heading, 1.5707963267948966, 1e-15);
  assert_close(box->margin, 0.01, 0.0);
  assert_null(box->capsules);
  assert_int_equal(bar->shape, AMBULO_OBSTACLE_CAPSULE);
  assert_close(bar->from[1], -1.0, 0.0);
  assert_close(bar->to[1], 1.0, 0.0);
  assert_close(bar->radius, 0.02, 0.0);
  assert_close(bar->margin, 0.05, 0.0);
  assert_int_equal(bar->capsule_count, 1);
  assert_int_equal(bar->capsules[0], find_capsule(p->model, "head"));
  assert_null(ambulo_problem_obstacle(p, 2));
  assert_close(d->collision.margin, 0.02, 0.0);
  assert_int_equal(ambulo_problem_pairs(p, 0, NULL), 1);
  assert_int_equal(d->reach_count, 1);
  assert_close(d->reaches[0].from, 0.25, 0.0);
  assert_close(d->reaches[0].to, 0.5, 0.0);
  assert_close(d->reaches[0].place[2], 1.6, 0.0);
  ambulo_problem_free(p);
}

static void pairs_left_out_are_told(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(BODY "constraints: {collision: {}, joint_limits: nodes}\n");
  ambulo_capsule_pair pair = {0, 0};
  assert_true(ambulo_problem_pairs(p, 0, NULL) >= 8);
  assert_close(p->definition.collision.margin, 0.0, 0.0);
  int left = ambulo_problem_pairs_left_out(p, 0, NULL);
  for (int i = 0; i < left; i++) {
    assert_int_equal(ambulo_problem_pairs_left_out(p, i, &pair), left);
    assert_true(pair.one != pair.other);
  }
  ambulo_problem_free(p);
  p = problem_of(BODY "constraints: {collision: {pairs: off}}\n");
  assert_int_equal(ambulo_problem_pairs(p, 0, NULL) + ambulo_problem_pairs_left_out(p, 0, NULL), 0);
  ambulo_problem_free(p);
}

/* the same pairs without a key, with the word, and with an empty section; none with `off` */
static void bodies_are_kept_apart_unless_it_is_off(void **state) {
  (void)state;
  static const char *const same[] = {"", "constraints: {collision: automatic}\n",
                                     "constraints: {collision: {}}\n",
                                     "constraints: {collision: {pairs: automatic}}\n"};
  static const char *const none[] = {"constraints: {collision: off}\n",
                                     "constraints: {collision: {pairs: off}}\n"};
  char text[512];
  int pairs = -1;
  for (int i = 0; i < 4; i++) {
    (void)snprintf(text, sizeof text, BODY "%s", same[i]);
    ambulo_problem *p = problem_of(text);
    if (i == 0) pairs = ambulo_problem_pairs(p, 0, NULL);
    assert_int_equal(ambulo_problem_pairs(p, 0, NULL), pairs);
    assert_close(p->definition.collision.margin, 0.0, 0.0);
    ambulo_problem_free(p);
  }
  assert_true(pairs >= 8);
  for (int i = 0; i < 2; i++) {
    (void)snprintf(text, sizeof text, BODY "%s", none[i]);
    ambulo_problem *p = problem_of(text);
    assert_int_equal(ambulo_problem_pairs(p, 0, NULL), 0);
    ambulo_problem_free(p);
  }
}

/* lengths of another body grow with it; obstacles and places are the task's, and stay */
static void margins_go_with_the_body(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(
      BODY "subject: {stature: 0.875, mass: 75}\nwritten_for: {stature: 1.75, mass: 75}\n"
           "obstacles: [{name: a, center: [1, 0, 0], half_size: [1, 1, 1], margin: 0.02}]\n"
           "constraints: {collision: {margin: 0.02}}\n");
  assert_close(p->definition.collision.margin, 0.01, 1e-15);
  assert_close(p->definition.obstacles[0].margin, 0.02, 0.0);
  ambulo_problem_free(p);
}

static void a_pair_that_overlaps_is_warned_of(void **state) {
  (void)state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem *p = NULL;
  assert_int_equal(
      load_text(BODY "constraints: {collision: {pairs: [[pelvis, thigh_r]]}}\n", list, &p),
      AMBULO_OK);
  assert_message(list, 0, "p.yaml:7:35: warning: 'pelvis' and 'thigh_r' overlap by");
  assert_message(list, 0, "'pairs: automatic' leaves such pairs out");
  ambulo_problem_free(p);
  ambulo_diagnostics_free(list);
}

static const struct {
  const char *text, *message;
  ambulo_status status;
} refused[] = {
    {"constraints: {collision: {pairs: [[shank_l, shank_rr]]}}\n",
     "p.yaml:7:45: error[E_PROBLEM]: unknown capsule (got 'shank_rr'); expected a capsule of the "
     "model\n  hint: did you mean 'shank_r'?",
     AMBULO_E_PROBLEM},
    {"constraints: {collision: {pairs: [[shank_l]]}}\n",
     "expected the names of two capsules, such as [shank_l, shank_r]", AMBULO_E_SCHEMA},
    {"constraints: {collision: {pairs: [[shank_l, shank_l]]}}\n",
     "a capsule and itself (got 'shank_l' twice)", AMBULO_E_PROBLEM},
    {"constraints: {collision: {pairs: [[trunk, head]]}}\n",
     "'trunk' and 'head' are parts of one rigid body", AMBULO_E_PROBLEM},
    {"constraints: {collision: {pairs: all}}\n", "automatic", AMBULO_E_SCHEMA},
    {"constraints: {collision: {pairs: []}}\n", "an empty list; expected pairs of capsules",
     AMBULO_E_SCHEMA},
    {"constraints: {collision: {pairs: {a: b}}}\n", "expected a list of pairs of capsules",
     AMBULO_E_SCHEMA},
    {"constraints: {collision: {margin: -0.1}}\n", "-0.1", AMBULO_E_SCHEMA},
    {"constraints: {collision: {margn: 0.1}}\n", "did you mean 'margin'?", AMBULO_E_SCHEMA},
    {"constraints: {collision: [shank_l]}\n", "expected a mapping", AMBULO_E_SCHEMA},
    {"obstacles: {name: a}\n", "expected a list of {name, center, half_size, heading, from, to, ",
     AMBULO_E_SCHEMA},
    {"obstacles: [{name: a, center: [0, 0, 0]}]\n", "half_size", AMBULO_E_SCHEMA},
    {"obstacles: [{name: a, radius: 1}]\n", "from", AMBULO_E_SCHEMA},
    {"obstacles: [{name: a, center: [0, 0, 0], half_size: [1, 0, 1]}]\n",
     ": 0; expected 1e-06 to 1000", AMBULO_E_SCHEMA},
    {"obstacles: [{center: [0, 0, 0], half_size: [1, 1, 1]}]\n", "missing required key 'name'",
     AMBULO_E_SCHEMA},
    {"obstacles: [{name: a, center: [0, 0, 0], half_size: [1, 1, 1]}, {name: a, center: [0, 0, "
     "0], half_size: [1, 1, 1]}]\n",
     "obstacles[0] and obstacles[1] are both named 'a'", AMBULO_E_PROBLEM},
    {"obstacles: [{name: a, center: [0, 0, 5000], half_size: [1, 1, 1]}]\n",
     ": 5000; expected -1000 to 1000", AMBULO_E_SCHEMA},
    {"obstacles: [{name: a, center: [0, 0, 0], half_size: [1, 1, 1], capsules: [haed]}]\n",
     "did you mean 'head'?", AMBULO_E_PROBLEM},
    {"obstacles: [{name: a, center: [0, 0, 0], half_size: [1, 1, 1], capsules: []}]\n",
     "an empty list; expected names of capsules, or 'all'", AMBULO_E_SCHEMA},
    {"obstacles: [{name: a, center: [0, 0, 0], half_size: [1, 1, 1], heigth: 1}]\n",
     "unknown key 'heigth'", AMBULO_E_SCHEMA},
    {"obstacles: [{name: a, center: [0, 0, 0], half_size: [1, 1, 1]}]\nends: {kind: mirrored}\n",
     "obstacle 'a' stands once and the step for both", AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: head_top, place: [0, 0, 1], at: 0.5}]}\nends: {kind: "
     "mirrored}\n",
     "constraints.reach[0] asks for a place once", AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: knee_r, relative_to: knee_l, place: [0.1, -0.2, 0]}]}\nends: "
     "{kind: "
     "mirrored}\n",
     "the mirror image of constraints.reach[0] is another one", AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: knee_r, relative_to: knee_l, place: [0, -0.2, 0], at: [0, "
     "0.5]}]}\n"
     "ends: {kind: mirrored}\n",
     "straight to the side, from 0 to 1 s", AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: knee_r, relative_to: ankle_l, place: [0, -0.2, 0]}]}\nends: "
     "{kind: "
     "mirrored}\n",
     "expected the way from a point to its mirror image", AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: knee_r, relative_to: knee_r, place: [0, 0, 0]}]}\n",
     "constraints.reach[0] is relative to point", AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: knee_r, relative_to: nee_l, place: [0, 0, 0]}]}\n",
     "hint: did you mean 'knee_l'?", AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: head_tip, place: [0, 0, 1], at: 0.5}]}\n",
     "unknown point (got 'head_tip'); expected a point of the model\n  hint: did you mean "
     "'head_top'?",
     AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: head_top, place: [0, 0, 1]}]}\n", "missing required key 'at'",
     AMBULO_E_SCHEMA},
    {"constraints: {reach: [{point: head_top, place: [0, 1], at: 0.5}]}\n", "p.yaml:7:48",
     AMBULO_E_SCHEMA},
    {"constraints: {reach: [{point: head_top, place: [0, 0, 1], at: 0.3}]}\n",
     "constraints.reach[0]: no node from 0.3 s to 0.3 s, the nearest is at 0.25 s; expected the "
     "time of a node, or grid: events",
     AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: head_top, place: [0, 0, 1], at: [0.5, 0.25]}]}\n",
     "constraints.reach[0] is from 0.5 s to 0.25 s; expected times in 0 to 1 s", AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: head_top, place: [0, 0, 1], at: 2}]}\n",
     "constraints.reach[0] is from 2 s to 2 s", AMBULO_E_PROBLEM},
    {"constraints: {reach: {point: head_top}}\n",
     "expected a list of {point, relative_to, place, at, tolerance}", AMBULO_E_SCHEMA},
};

static void refusals(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
    char text[1024];
    (void)snprintf(text, sizeof text, BODY "%s", refused[i].text);
    expect_refusal(text, refused[i].status, refused[i].message);
  }
  expect_refusal(WALKER "time: {duration: 1, intervals: 4}\nobjective: none\n"
                        "constraints: {collision: {}}\n",
                 AMBULO_E_PROBLEM,
                 "constraints.collision: the model 'walker_2d' has no capsules; expected some");
  expect_refusal(WALKER "time: {duration: 1, intervals: 4}\nobjective: none\n"
                        "obstacles: [{name: a, center: [0, 0, 0], half_size: [1, 1, 1]}]\n",
                 AMBULO_E_PROBLEM, "has no capsules that could keep clear of it");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_read),
                                     cmocka_unit_test(pairs_left_out_are_told),
                                     cmocka_unit_test(bodies_are_kept_apart_unless_it_is_off),
                                     cmocka_unit_test(margins_go_with_the_body),
                                     cmocka_unit_test(a_pair_that_overlaps_is_warned_of),
                                     cmocka_unit_test(refusals)};
  return cmocka_run_group_tests_name("definitions/problem_constraints_collision", tests, NULL,
                                     NULL);
}
