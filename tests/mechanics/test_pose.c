/* Forward kinematics of points against those of the dynamics; velocities of any point, and slopes
 * of both, against differences. */
#include "mechanics/pose.h"
#include "mechanics/kernel_fixture.h"
#include "support/fail_alloc.h"
#include "support/walker_result.h"

static void test_points_agree_with_the_mechanics(void **state) {
  (void)state;
  ambulo_model *model = planar_walker_create();
  ambulo_mechanics *mechanics = NULL;
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  ambulo__pose pose;
  assert_int_equal(ambulo__pose_create(model, NULL, &pose), AMBULO_OK);
  double q[WALKER_COORDINATES], zero[WALKER_COORDINATES] = {0.0}, points[3 * WALKER_POINTS];
  for (int i = 0; i < WALKER_COORDINATES; i++) q[i] = sin(1.0 + 1.3 * i);
  assert_int_equal(ambulo_mechanics_inverse_dynamics(
                       mechanics, 1, q, zero, zero,
                       &(ambulo_outputs){.size = sizeof(ambulo_outputs), .points = points}),
                   AMBULO_OK);
  ambulo__pose_at(&pose, q);
  for (int p = 0; p < WALKER_POINTS; p++) {
    const ambulo_point *point = ambulo_model_point(model, p);
    double world[3];
    ambulo__pose_point(&pose, point->link, point->position, world);
    for (int k = 0; k < 3; k++) assert_close(world[k], points[3 * p + k], 1e-13);
  }
  ambulo__pose_free(&pose);
  ambulo_mechanics_free(mechanics);
  ambulo_model_free(model);
}

static void test_a_point_of_the_world_stays(void **state) {
  (void)state;
  const ambulo__pose nothing = {.model = NULL};
  const double place[3] = {1.0, -2.0, 3.0};
  double world[3];
  ambulo__pose_point(&nothing, -1, place, world);
  for (int k = 0; k < 3; k++) assert_close(world[k], place[k], 0.0);
}

static void test_memory_may_fail(void **state) {
  (void)state;
  ambulo_model *model = planar_walker_create();
  ambulo__pose pose = {.model = NULL};
  fail_alloc memory = fail_alloc_at(0);
  ambulo_allocator allocator = fail_alloc_hook(&memory);
  assert_int_equal(ambulo__pose_create(model, &allocator, &pose), AMBULO_E_MEMORY);
  assert_null(pose.model);
  assert_int_equal(memory.live, 0);
  ambulo__pose_free(&pose);
  ambulo_model_free(model);
}

/* ------------------------------------------------------------ velocity of a point */

typedef struct moving {
  kernel_case c;
  double q[max_d], qd[max_d], x[3], v[3], x_q[3 * max_d], v_q[3 * max_d];
} moving;

static void moving_open(moving *m, int number) {
  case_open(&m->c, number);
  for (int i = 0; i < m->c.d; i++) {
    m->q[i] = m->c.q[i * AMBULO__LANES];
    m->qd[i] = m->c.qd[i * AMBULO__LANES];
  }
}

static void move(moving *m, int link, const double *local) {
  assert_int_equal(ambulo_model_point_motion(m->c.model, link, local, m->q, m->qd,
                                             &(ambulo_point_motion){sizeof(ambulo_point_motion),
                                                                    m->x, m->v, m->x_q, m->v_q}),
                   AMBULO_OK);
}

/* q moved by `step` along `along`: where the point is, and how fast */
static void moved_point(const moving *m, int link, const double *local, const double *along,
                        double step, double *x, double *v) {
  double q[max_d];
  for (int i = 0; i < m->c.d; i++) q[i] = m->q[i] + step * along[i];
  ambulo_point_motion to = ambulo_point_motion_default();
  to.position = x;
  to.velocity = v;
  assert_int_equal(ambulo_model_point_motion(m->c.model, link, local, q, m->qd, &to), AMBULO_OK);
}

/* central differences of fourth order along a direction of q */
static void differences(const moving *m, int link, const double *local, const double *along,
                        double *x_along, double *v_along) {
  static const double places[] = {-2.0, -1.0, 1.0, 2.0}, shares[] = {1.0, -8.0, 8.0, -1.0};
  const double h = 1e-3;
  for (int r = 0; r < 3; r++) x_along[r] = v_along[r] = 0.0;
  for (int s = 0; s < 4; s++) {
    double x[3], v[3];
    moved_point(m, link, local, along, places[s] * h, x, v);
    for (int r = 0; r < 3; r++) {
      x_along[r] += shares[s] * x[r] / (12.0 * h);
      v_along[r] += shares[s] * v[r] / (12.0 * h);
    }
  }
}

static void check_slopes(moving *m, int link, const double *local) {
  const int d = m->c.d;
  double size = 1.0, x_t[3], v_t[3];
  move(m, link, local);
  for (int i = 0; i < 3 * d; i++) size = fmax(size, fmax(fabs(m->x_q[i]), fabs(m->v_q[i])));
  differences(m, link, local, m->qd, x_t, v_t);
  for (int r = 0; r < 3; r++) {
    double sum = 0.0;
    for (int c = 0; c < d; c++) sum += m->x_q[r * d + c] * m->qd[c];
    assert_close(m->v[r], sum, 1e-12 * size * d);
    assert_close(m->v[r], x_t[r], 1e-6 * size * d);
  }
  for (int c = 0; c < d; c++) {
    double along[max_d] = {0.0}, by_x[3], by_v[3];
    along[c] = 1.0;
    differences(m, link, local, along, by_x, by_v);
    for (int r = 0; r < 3; r++) {
      assert_close(m->x_q[r * d + c], by_x[r], 1e-9 * size);
      assert_close(m->v_q[r * d + c], by_v[r], 1e-9 * size);
    }
  }
}

static void test_velocities_and_slopes_are_those_of_differences(void **state) {
  (void)state;
  static const int numbers[] = {1, 6, 17, 44, 59, 243, 258, 299, 342, 347, 401, 452};
  const double local[3] = {0.11, -0.23, 0.31};
  int turning = 0, sliding = 0, fixed = 0;
  for (size_t n = 0; n < sizeof numbers / sizeof *numbers; n++) {
    static moving m;
    moving_open(&m, numbers[n]);
    for (int link = 0; link < ambulo_model_link_count(m.c.model); link++) {
      ambulo_joint_type type = ambulo_model_link(m.c.model, link)->type;
      turning += type == AMBULO_REVOLUTE;
      sliding += type == AMBULO_PRISMATIC;
      fixed += type == AMBULO_FIXED;
      check_slopes(&m, link, local);
    }
    case_close(&m.c);
  }
  assert_true(turning > 20 && sliding > 5 && fixed > 5);
}

static void test_slopes_of_points_agree_with_the_mechanics(void **state) {
  (void)state;
  static moving m;
  moving_open(&m, 44);
  const int d = m.c.d, points = ambulo_model_point_count(m.c.model);
  ambulo_mechanics *mechanics = NULL;
  assert_int_equal(ambulo_mechanics_create(m.c.model, NULL, &mechanics), AMBULO_OK);
  double *points_q = lane_array((size_t)(3 * points * d));
  ambulo_jacobians jacobians = ambulo_jacobians_default();
  jacobians.points_q = points_q;
  assert_int_equal(ambulo_mechanics_jacobians(mechanics, 1, m.q, m.qd, m.qd, &jacobians),
                   AMBULO_OK);
  assert_true(points > 0);
  for (int p = 0; p < points; p++) {
    const ambulo_point *point = ambulo_model_point(m.c.model, p);
    move(&m, point->link, point->position);
    for (int i = 0; i < 3 * d; i++) assert_close(m.x_q[i], points_q[3 * p * d + i], 1e-10);
  }
  free(points_q);
  ambulo_mechanics_free(mechanics);
  case_close(&m.c);
}

static void test_a_point_of_the_world_has_no_velocity(void **state) {
  (void)state;
  static moving m;
  moving_open(&m, 6);
  const double place[3] = {1.0, -2.0, 3.0};
  move(&m, -1, place);
  for (int r = 0; r < 3; r++) assert_true(m.x[r] == place[r] && m.v[r] == 0.0);
  for (int i = 0; i < 3 * m.c.d; i++) assert_true(m.x_q[i] == 0.0 && m.v_q[i] == 0.0);
  case_close(&m.c);
}

static void test_faults_leave_results_alone(void **state) {
  (void)state;
  static moving m;
  moving_open(&m, 6);
  const double local[3] = {0.0, 0.0, 0.0}, lost[3] = {0.0, NAN, 0.0};
  ambulo_point_motion to = {sizeof to, m.x, m.v, m.x_q, m.v_q}, half = to, sizeless = to;
  half.position_q = NULL;
  sizeless.size = 0;
  for (int r = 0; r < 3; r++) m.x[r] = m.v[r] = 7.0;
  for (int i = 0; i < 3 * m.c.d; i++) m.x_q[i] = m.v_q[i] = 7.0;
  const int links = ambulo_model_link_count(m.c.model);
#define STATUS(link, place, into) ambulo_model_point_motion(m.c.model, link, place, m.q, m.qd, into)
  assert_int_equal(STATUS(links, local, &to), AMBULO_E_ARGUMENT);
  assert_int_equal(STATUS(-2, local, &to), AMBULO_E_ARGUMENT);
  assert_int_equal(STATUS(0, NULL, &to), AMBULO_E_ARGUMENT);
  assert_int_equal(STATUS(0, local, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(STATUS(0, local, &half), AMBULO_E_ARGUMENT);
  assert_int_equal(STATUS(0, local, &sizeless), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_model_point_motion(NULL, 0, local, m.q, m.qd, &to), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_model_point_motion(m.c.model, 0, local, m.q, NULL, &to),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(STATUS(0, lost, &to), AMBULO_E_NUMERIC);
  m.q[0] = NAN;
  assert_int_equal(STATUS(0, local, &to), AMBULO_E_NUMERIC);
  m.q[0] = 0.0;
  m.qd[m.c.d - 1] = 1e101;
  assert_int_equal(STATUS(0, local, &to), AMBULO_E_NUMERIC);
#undef STATUS
  for (int r = 0; r < 3; r++) assert_true(m.x[r] == 7.0 && m.v[r] == 7.0);
  for (int i = 0; i < 3 * m.c.d; i++) assert_true(m.x_q[i] == 7.0 && m.v_q[i] == 7.0);
  case_close(&m.c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_points_agree_with_the_mechanics),
      cmocka_unit_test(test_a_point_of_the_world_stays),
      cmocka_unit_test(test_memory_may_fail),
      cmocka_unit_test(test_velocities_and_slopes_are_those_of_differences),
      cmocka_unit_test(test_slopes_of_points_agree_with_the_mechanics),
      cmocka_unit_test(test_a_point_of_the_world_has_no_velocity),
      cmocka_unit_test(test_faults_leave_results_alone)};
  return cmocka_run_group_tests_name("mechanics/pose", tests, NULL, NULL);
}
