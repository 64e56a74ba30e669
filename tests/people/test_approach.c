/* How near a motion comes to what it keeps clear of: by hand as the body stands, over both steps of
 * a mirrored walk, and of a walk that was solved with a margin, between its nodes too. */
#include "people/approach.h"
#include "ambulo/tools/tools.h"
#include "support/test.h"

#include <string.h>

static ambulo_allocator own;

static const ambulo__approach *named(const ambulo__approach *list, int count, const char *capsule,
                                     const char *other) {
  for (int i = 0; i < count; i++) {
    if (!strcmp(list[i].capsule, capsule) && !strcmp(list[i].other, other)) return &list[i];
  }
  fail_msg("no approach of %s and %s", capsule, other);
  return NULL;
}

/* the body stands for 0.5 s, then moves 1 m forward through a box and back */
static void gaps_by_hand(void **state) {
  (void)state;
  static const char text[] =
      "ambulo: 1\nkind: problem\nmodel: models/lower_body_18.yaml\nobjective: none\n"
      "time: {duration: 1, intervals: 10}\ntrajectory: {intervals: 10}\n"
      "obstacles: [{name: box, center: [0.6, 0, 1.2], half_size: [0.1, 1, 0.1], capsules: [trunk, "
      "head]}]\n"
      "constraints: {collision: {pairs: [[shank_l, shank_r]]}}\n";
  ambulo_problem *p = NULL;
  ambulo__approach *list = NULL;
  int count = 0;
  own = ambulo__allocator_or_default(NULL);
  assert_int_equal(
      ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                      .text = text,
                                                      .length = sizeof text - 1,
                                                      .name = "t"},
                               NULL, NULL, &p),
      AMBULO_OK);
  double *x = calloc((size_t)p->variables, sizeof *x);
  assert_int_equal(ambulo__approaches(p, x, 21, &own, &list, &count), AMBULO_OK);
  assert_int_equal(count, 3);
  assert_close(named(list, count, "shank_r", "shank_l")->gap, 0.07, 1e-4);
  assert_int_equal(named(list, count, "shank_r", "shank_l")->is_obstacle, 0);
  const ambulo__approach *trunk = named(list, count, "trunk", "box");
  assert_close(trunk->gap, 0.5 - 0.12, 1e-4);
  assert_close(trunk->time, 0.0, 1e-12); /* the first of equal ones */
  assert_int_equal(trunk->is_obstacle, 1);
  assert_close(named(list, count, "head", "box")->gap, /* from the box's edge to its lower end */
               hypot(0.5, 0.534643 * 1.75 + 0.39 * 1.75 - 1.3) - 0.09, 1e-4);
  free(list);
  int forward = ambulo_model_find_coordinate(p->model, "pelvis_tx");
  for (int c = 0; c < p->control_points; c++)
    x[c * p->coordinates + forward] = c < p->control_points / 2 ? 0.0 : 0.6;
  assert_int_equal(ambulo__approaches(p, x, 201, &own, &list, &count), AMBULO_OK);
  trunk = named(list, count, "trunk", "box");
  assert_close(trunk->gap, -0.1 - 0.12, 1e-3); /* the shortest way out is back or forward */
  assert_true(trunk->time > 0.5);
  free(list);
  x[0] = NAN;
  assert_int_equal(ambulo__approaches(p, x, 5, &own, &list, &count), AMBULO_OK);
  free(list);
  free(x);
  ambulo_problem_free(p);
}

static void solved_walks_keep_their_margin_between_nodes(void **state) {
  (void)state;
  const char *const settings[] = {"constraints.collision={pairs: automatic, margin: 0.03}"};
  ambulo_problem *p = NULL;
  ambulo_result *result = NULL;
  ambulo__approach *list = NULL;
  int count = 0;
  own = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo_problem_load("models/walk_normal.yaml", settings, 1, NULL, NULL, &p), 0);
  ambulo_options options = ambulo_problem_options(p);
  assert_int_equal(ambulo_solve(p, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_result_verdict(result), AMBULO_OPTIMAL);
  int samples = 2 * 10 * (p->nodes - 1) + 1;
  assert_int_equal(ambulo__approaches(p, ambulo_result_x(result), samples, &own, &list, &count), 0);
  double least = INFINITY;
  for (int i = 0; i < count; i++) least = fmin(least, list[i].gap);
  assert_true(count == 8);
  assert_true(least > 0.03 - 0.001 && least < 0.033); /* and it is kept by no more than asked */
  /* the second step is the first one's image */
  assert_close(named(list, count, "shank_r", "thigh_l")->gap,
               named(list, count, "thigh_r", "shank_l")->gap, 2e-4);
  free(list);
  ambulo_result_free(result);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gaps_by_hand),
      cmocka_unit_test(solved_walks_keep_their_margin_between_nodes)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
