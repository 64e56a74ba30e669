/* Work of the joints and the path of the centre of mass, against energy and momentum. */
#include "people/economy.h"
#include "ambulo/tools/tools.h"
#include "mechanics/pose.h"
#include "support/fail_alloc.h"
#include "support/test.h"

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
  assert_close(ambulo__economy_metabolic(e), e->positive_sum / 0.25 - e->negative_sum / 1.2, 1e-12);
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
  solved s = solve("models/walk_without_reaction.yaml", 101);
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

int main(void) {
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
