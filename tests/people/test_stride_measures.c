/* Work of the joints and the path of the centre of mass, against energy and momentum. */
#include "ambulo/tools/load.h"
#include "ambulo/ambulo.h"
#include "mechanics/pose.h"
#include "people/stride.h"
#include "people/stride_measures.h"
#include "support/fail_alloc.h"
#include "support/test.h"

#include <string.h>

typedef struct solved {
  ambulo_problem *problem;
  ambulo_result *result;
  ambulo__stride stride;
  ambulo__economy economy;
} solved;

static solved solve(const char *file, int samples) {
  solved s = {.problem = NULL};
  assert_int_equal(ambulo_problem_load(file, NULL, 0, NULL, NULL, &s.problem), AMBULO_OK);
  assert_int_equal(ambulo_solve(s.problem, NULL, NULL, NULL, NULL, &s.result), AMBULO_OK);
  assert_int_equal(
      ambulo__stride_create(s.problem, ambulo_result_x(s.result), samples, NULL, &s.stride),
      AMBULO_OK);
  assert_int_equal(ambulo__economy_of(&s.stride, NULL, &s.economy), AMBULO_OK);
  return s;
}

static void release(solved *s) {
  ambulo__economy_free(&s->economy);
  ambulo__stride_free(&s->stride);
  ambulo_result_free(s->result);
  ambulo_problem_free(s->problem);
}

/* a rod of 3 kg and 1 m from hanging to level, from rest to rest: m g 0.5 m */
static void work_lifts_a_pendulum(void **state) {
  (void)state;
  solved s = solve("models/pendulum_swing.yaml", 4001);
  const ambulo__economy *e = &s.economy;
  assert_close(e->positive_sum + e->negative_sum, 3.0 * 9.81 * 0.5, 1e-5);
  assert_true(e->positive_sum > 14.7 && e->negative_sum < 0.0);
  assert_close(e->positive[0], e->positive_sum, 0.0);
  assert_close(e->distance, 0.5, 1e-6);
  assert_close(e->feet, 0.0, 0.0); /* it has none */
  release(&s);
}

/* m d2c/dt2 = F + m g at every sample: what the centre of mass does is what the ground makes it do
 */
static void forces_move_the_center_of_mass(void **state) {
  (void)state;
  solved s = solve("models/walk_normal.yaml", 2001);
  const ambulo_model *m = s.problem->model;
  ambulo__pose pose;
  assert_int_equal(ambulo__pose_create(m, NULL, &pose), AMBULO_OK);
  double h = s.stride.times[1] - s.stride.times[0], error = 0.0, mean = 0.0;
  for (int k = 1; k + 1 < s.stride.samples; k++) {
    double c[3][3], force = 0.0, up;
    for (int j = 0; j < 3; j++) {
      ambulo__pose_at(&pose, s.stride.q + (size_t)(k + j - 1) * (size_t)s.stride.coordinates);
      ambulo__pose_center_of_mass(&pose, c[j]);
    }
    up = (c[0][1] - 2.0 * c[1][1] + c[2][1]) / (h * h);
    for (int foot = 0; foot < 2; foot++) force += s.stride.grf[3 * (2 * k + foot) + 1];
    error += fabs(force / m->mass - 9.81 - up) / s.stride.samples;
    mean += fabs(up) / s.stride.samples;
  }
  assert_true(mean > 1.0);
  assert_true(error < 2e-3 * mean); /* differences over a jump of the third derivative */
  ambulo__pose_free(&pose);
  release(&s);
}

/* a stride that repeats gains no energy, and what the ground does is small beside it */
static void a_walk_gains_no_energy(void **state) {
  (void)state;
  solved s = solve("models/walk_normal.yaml", 2001);
  const ambulo_model *m = s.problem->model;
  const ambulo__economy *e = &s.economy;
  assert_true(fabs(e->positive_sum + e->negative_sum) < 0.015 * e->positive_sum);
  assert_close(e->distance, 2.0 * s.problem->definition.travel, 1e-6);
  assert_close(e->feet, e->distance, 1e-6); /* in a whole stride heels go as far as the body */
  for (int i = 0; i < m->coordinate_count; i++) {
    const ambulo_coordinate *c = &m->coordinates[i];
    if (!c->actuated) {
      assert_close(e->positive[i] - e->negative[i], 0.0, 0.0);
      continue;
    }
    assert_true(e->positive[i] > 0.0 && e->negative[i] < 0.0);
    assert_close(e->positive[i], e->positive[c->mirror], 1e-2 * e->positive_sum);
  }
  assert_true(e->rise > 0.02 && e->rise < 0.06 && e->sway > 0.01 && e->sway < 0.06);
  release(&s);
}

/* the way to the side, from pose to pose */
static void sway_is_from_side_to_side(void **state) {
  (void)state;
  solved s = solve("models/walk_normal.yaml", 101);
  ambulo__pose pose;
  double least = INFINITY, most = -INFINITY;
  const double *left = s.problem->model->left;
  assert_int_equal(ambulo__pose_create(s.problem->model, NULL, &pose), AMBULO_OK);
  for (int k = 0; k < s.stride.samples; k++) {
    double c[3];
    ambulo__pose_at(&pose, s.stride.q + (size_t)k * (size_t)s.stride.coordinates);
    ambulo__pose_center_of_mass(&pose, c);
    double aside = left[0] * c[0] + left[1] * c[1] + left[2] * c[2];
    least = fmin(least, aside);
    most = fmax(most, aside);
  }
  assert_close(s.economy.sway, most - least, 1e-15);
  ambulo__pose_free(&pose);
  release(&s);
}

/* torques of a pelvis that no ground carries are nobody's work */
static void what_is_not_actuated_does_no_work(void **state) {
  (void)state;
  solved s = solve("tests/support/walk_without_reaction.yaml", 101);
  const ambulo_model *m = s.problem->model;
  for (int i = 0; i < m->coordinate_count; i++)
    if (!m->coordinates[i].actuated)
      assert_close(s.economy.positive[i] - s.economy.negative[i], 0.0, 0.0);
  release(&s);
}

/* stairs: the climb itself is no rise of the centre of mass beside its path */
static void a_climb_is_no_excursion(void **state) {
  (void)state;
  solved s = solve("models/stairs_up.yaml", 501);
  assert_true(s.problem->definition.rise > 0.1);
  assert_true(s.economy.rise < 0.6 * s.problem->definition.rise);
  assert_true(s.economy.positive_sum + s.economy.negative_sum >
              0.95 * s.problem->model->mass * 9.81 * 2.0 * s.problem->definition.rise);
  release(&s);
}

/* who rises from a chair goes forward with the centre of mass, not with the feet */
static void rising_is_no_way(void **state) {
  (void)state;
  solved s = solve("models/sit_to_stand.yaml", 101);
  assert_true(s.economy.distance > 0.1);
  assert_true(s.economy.feet < 5e-3);
  release(&s);
}

static void every_allocation_may_fail(void **state) {
  (void)state;
  solved s = solve("models/pendulum_swing.yaml", 11);
  for (long k = 0; k < 100; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__economy economy;
    ambulo_status status = ambulo__economy_of(&s.stride, &allocator, &economy);
    if (status == AMBULO_OK)
      ambulo__economy_free(&economy);
    else
      assert_int_equal(status, AMBULO_E_MEMORY);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
    assert_true(k < 99);
  }
  release(&s);
}

static int test_economy_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(work_lifts_a_pendulum),
                                     cmocka_unit_test(forces_move_the_center_of_mass),
                                     cmocka_unit_test(a_walk_gains_no_energy),
                                     cmocka_unit_test(a_climb_is_no_excursion),
                                     cmocka_unit_test(rising_is_no_way),
                                     cmocka_unit_test(sway_is_from_side_to_side),
                                     cmocka_unit_test(what_is_not_actuated_does_no_work),
                                     cmocka_unit_test(every_allocation_may_fail)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Impulses of the ground's force: momentum is balanced over a stride, and each foot's share is what
 * a very fine sum gives. */

typedef struct test_impulse_solved {
  ambulo_problem *problem;
  ambulo_result *result;
} test_impulse_solved;

static test_impulse_solved test_impulse_solve(const char *file, const char *const *overrides,
                                              int count) {
  test_impulse_solved s = {NULL, NULL};
  assert_int_equal(ambulo_problem_load(file, overrides, count, NULL, NULL, &s.problem), AMBULO_OK);
  assert_int_equal(ambulo_solve(s.problem, NULL, NULL, NULL, NULL, &s.result), AMBULO_OK);
  return s;
}

static void test_impulse_release(test_impulse_solved *s) {
  ambulo_result_free(s->result);
  ambulo_problem_free(s->problem);
}

static double along(const double *a, const double *b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* over a stride that repeats, the ground gives back what gravity takes: 794.61 N s of 75 kg in
 * 1.08 s, and nothing forward on level ground */
static void a_stride_gains_no_momentum(void **state) {
  (void)state;
  static const char *const files[] = {"tests/support/walk_rigid.yaml", "models/walk_uphill.yaml",
                                      "models/walk_asymmetric.yaml"};
  for (int i = 0; i < 3; i++) {
    test_impulse_solved s = test_impulse_solve(files[i], NULL, 0);
    const ambulo_model *model = s.problem->model;
    double impulse[3 * 16], sum[3], mass = ambulo_model_mass(model);
    double time = ambulo_problem_duration(s.problem);
    if (ambulo_problem_ends(s.problem) == AMBULO_ENDS_MIRRORED) time *= 2.0;
    assert_int_equal(ambulo__impulses(s.problem, ambulo_result_x(s.result), NULL, impulse), 0);
    for (int k = 0; k < 3; k++) {
      sum[k] = impulse[k] + impulse[3 + k] + mass * ambulo_model_gravity(model)[k] * time;
      assert_close(sum[k] / (mass * 9.81 * time), 0.0, 1e-6);
    }
    if (i == 0)
      assert_close(along(impulse, model->up) + along(impulse + 3, model->up), 794.61, 1e-5);
    test_impulse_release(&s);
  }
}

/* 20,000 intervals of the trapezoidal rule; a periodic stride, and a step with its mirror image */
static void each_foot_gets_its_own(void **state) {
  (void)state;
  static const char *const files[] = {"models/walk_asymmetric.yaml",
                                      "tests/support/walk_rigid.yaml"};
  enum { FINE = 20001 };
  for (int k = 0; k < 2; k++) {
    test_impulse_solved s = test_impulse_solve(files[k], NULL, 0);
    ambulo__stride stride = {.samples = 0};
    double impulse[3 * 16];
    assert_int_equal(
        ambulo__stride_create(s.problem, ambulo_result_x(s.result), FINE, NULL, &stride),
        AMBULO_OK);
    assert_int_equal(ambulo__impulses(s.problem, ambulo_result_x(s.result), NULL, impulse), 0);
    for (int i = 0; i < 6; i++) {
      double sum = 0.0, step = stride.duration / (FINE - 1);
      for (int n = 0; n < FINE; n++)
        sum += (n % (FINE - 1) ? step : 0.5 * step) * stride.grf[6 * n + i];
      assert_close(impulse[i] / 800.0, sum / 800.0, 2e-5);
    }
    ambulo__stride_free(&stride);
    test_impulse_release(&s);
  }
}

static void nothing_without_ground_reaction(void **state) {
  (void)state;
  ambulo_problem *problem = NULL;
  double untouched = 7.0;
  assert_int_equal(ambulo_problem_load("tests/support/walk_without_reaction.yaml", NULL, 0, NULL,
                                       NULL, &problem),
                   0);
  double *x = calloc((size_t)problem->variables, sizeof *x);
  assert_int_equal(ambulo__impulses(problem, x, NULL, &untouched), AMBULO_OK);
  assert_close(untouched, 7.0, 0.0);
  free(x);
  ambulo_problem_free(problem);
}

static void test_impulse_every_allocation_may_fail(void **state) {
  (void)state;
  ambulo_problem *problem = NULL;
  assert_int_equal(
      ambulo_problem_load("tests/support/walk_rigid.yaml", NULL, 0, NULL, NULL, &problem), 0);
  double *x = calloc((size_t)problem->variables, sizeof *x), impulse[6] = {7.0};
  for (long k = 0; k < 100; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_status status = ambulo__impulses(problem, x, &hook, impulse);
    assert_int_equal(memory.live, 0);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    if (!memory.failed) break;
    assert_close(impulse[0], 7.0, 0.0);
    assert_true(k < 99);
  }
  free(x);
  ambulo_problem_free(problem);
}

static int test_impulse_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_stride_gains_no_momentum),
                                     cmocka_unit_test(each_foot_gets_its_own),
                                     cmocka_unit_test(nothing_without_ground_reaction),
                                     cmocka_unit_test(test_impulse_every_allocation_may_fail)};
  return cmocka_run_group_tests_name("stride/impulse", tests, NULL, NULL);
}

/* How near a motion comes to what it keeps clear of: by hand as the body stands, over both steps of
 * a mirrored walk, and of a walk that was solved with a margin, between its nodes too. */

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
  assert_true(count == 16);                           /* with the mirror image of each pair */
  assert_true(least > 0.03 - 0.001 && least < 0.033); /* and it is kept by no more than asked */
  /* the second step is the first one's image */
  assert_close(named(list, count, "shank_r", "thigh_l")->gap,
               named(list, count, "thigh_r", "shank_l")->gap, 2e-4);
  free(list);
  ambulo_result_free(result);
  ambulo_problem_free(p);
}

static int test_approach_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gaps_by_hand),
      cmocka_unit_test(solved_walks_keep_their_margin_between_nodes)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_economy_tests() + test_impulse_tests() + test_approach_tests();
}
