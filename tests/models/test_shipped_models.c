/* Every shipped model loads without a word and is what its comments say. */
#include "mechanics/lagrangian.h"
#include "ambulo/tools/tools.h"
#include "support/messages.h"
#include "support/test.h"

#ifndef AMBULO_SOURCE_DIR
#define AMBULO_SOURCE_DIR "."
#endif

enum { MOST_COORDINATES = 18, MOST_POINTS = 32 };

typedef struct pose {
  double tau[MOST_COORDINATES], wrench[6], points[MOST_POINTS][3];
} pose;

static ambulo_model *load(const char *name, const ambulo_subject *subject) {
  char path[512];
  ambulo_model *model = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  snprintf(path, sizeof path, "%s/models/%s.yaml", AMBULO_SOURCE_DIR, name);
  ambulo_status status = ambulo_model_load(path, subject, NULL, list, &model);
  if (ambulo_diagnostics_count(list) > 0) assert_message(list, 0, "no message at all");
  ambulo_diagnostics_free(list);
  assert_int_equal(status, AMBULO_OK);
  assert_string_equal(ambulo_model_name(model), name);
  assert_true(ambulo_model_coordinate_count(model) <= MOST_COORDINATES);
  assert_true(ambulo_model_point_count(model) <= MOST_POINTS);
  return model;
}

static pose evaluate(const ambulo_model *model, const double *q, const double *qd,
                     const double *qdd) {
  pose p;
  void *scratch = malloc(ambulo__lagrangian_scratch_size(model));
  assert_int_equal(ambulo__lagrangian(0, model, q, qd, qdd,
                                      &(ambulo_outputs){.size = sizeof(ambulo_outputs),
                                                        .tau = p.tau,
                                                        .wrench = p.wrench,
                                                        .points = p.points[0]},
                                      scratch),
                   AMBULO_OK);
  free(scratch);
  return p;
}

static pose still(const ambulo_model *model, const double *q) {
  static const double zero[MOST_COORDINATES];
  return evaluate(model, q, zero, zero);
}

static const double *point(const ambulo_model *model, const pose *p, const char *name) {
  int index = ambulo_model_find_point(model, name);
  if (index < 0) print_error("no point named %s\n", name);
  assert_true(index >= 0);
  return p->points[index];
}

static void set(const ambulo_model *model, double *q, const char *name, double value) {
  int index = ambulo_model_find_coordinate(model, name);
  if (index < 0) print_error("no coordinate named %s\n", name);
  assert_true(index >= 0);
  q[index] = value;
}

static void pendulum(void **state) {
  (void)state;
  ambulo_model *model = load("pendulum", NULL);
  const double q = 0.7, qd = -1.3, qdd = 2.1;
  pose p = evaluate(model, &q, &qd, &qdd);
  assert_close(p.tau[0], 1.0 * qdd + 14.715 * sin(q), 1e-14);
  assert_close(p.points[0][0], sin(q), 1e-15);
  assert_close(p.points[0][1], -cos(q), 1e-15);
  ambulo_model_free(model);
}

static void two_link(void **state) {
  (void)state;
  ambulo_model *model = load("two_link", NULL);
  const double q[2] = {0.4, -1.1}, v[2] = {1.5, -2.5}, a[2] = {3, 4}, g = 9.81;
  const double l1 = 0.3, m1 = 2, c1 = 0.15, i1 = 0.016, m2 = 1.5, c2 = 0.12, i2 = 0.009;
  double h = m2 * l1 * c2, c = cos(q[1]), s = sin(q[1]);
  double tau1 = (i1 + m1 * c1 * c1 + i2 + m2 * (l1 * l1 + c2 * c2) + 2 * h * c) * a[0] +
                (i2 + m2 * c2 * c2 + h * c) * a[1] - h * s * (2 * v[0] * v[1] + v[1] * v[1]) +
                g * (m1 * c1 + m2 * l1) * cos(q[0]) + g * m2 * c2 * cos(q[0] + q[1]);
  double tau2 = (i2 + m2 * c2 * c2 + h * c) * a[0] + (i2 + m2 * c2 * c2) * a[1] +
                h * s * v[0] * v[0] + g * m2 * c2 * cos(q[0] + q[1]);
  pose p = evaluate(model, q, v, a);
  assert_close(p.tau[0], tau1, 1e-14);
  assert_close(p.tau[1], tau2, 1e-14);
  ambulo_model_free(model);
}

/* 2 cm behind the ankle and under the ball, radii 2.5 and 3.4 cm, of a body of 1.75 m */
static void stands_on_arcs(const ambulo_foot *foot, const pose *p, double size) {
  static const double radius[2] = {0.025, 0.034};
  const double *held[2] = {p->points[foot->heel_center], p->points[foot->toe_center]};
  for (int end = 0; end < 2; end++) {
    const double *center = p->points[foot->arc[end]];
    assert_close(center[0] - held[end][0], 0, 1e-9);
    assert_close(center[1] - held[end][1], radius[end] / 1.75 * size, 1e-5);
    assert_close(center[2] - held[end][2], 0, 1e-9);
  }
  assert_close(held[1][0] - held[0][0], 0.16 / 1.75 * size, 1e-5);
}

/* q = 0: upright, both soles on the ground, whatever the subject; the whole weight is there */
static void standing(const char *name, ambulo_subject subject) {
  int rolls = !strcmp(name, "lower_body_18") || !strcmp(name, "lower_body_21");
  ambulo_model *model = load(name, &subject);
  const double q[MOST_COORDINATES] = {0};
  pose p = still(model, q);
  double size = subject.stature, mass = subject.mass;
  assert_close(ambulo_model_mass(model), mass, 1e-12);
  assert_close(ambulo_model_stature(model), size, 0);
  assert_close(p.wrench[4], mass * 9.81, 1e-12);
  for (int f = 0; f < ambulo_model_foot_count(model); f++) {
    const ambulo_foot *foot = ambulo_model_foot(model, f);
    const double *heel = p.points[foot->heel_center], *toe = p.points[foot->toe_center];
    assert_close(heel[1], 0, 2e-6);
    assert_close(toe[1], 0, 2e-6);
    /* a foot with a tip turns about its ball at push-off; the tip is its end */
    const double *end = foot->has_tip ? p.points[foot->tip] : toe;
    assert_close(end[0] - heel[0], (rolls ? 0.215 : 0.245) / 1.75 * size, 1e-5);
    assert_true(toe[0] <= end[0]);
    assert_int_equal(foot->has_arcs, rolls);
    if (rolls) stands_on_arcs(foot, &p, size);
    assert_close(p.points[foot->heel[0]][1], 0, 2e-6);
    assert_close(p.points[foot->toe[0]][1], 0, 2e-6);
  }
  assert_close(point(model, &p, "ankle_r")[1], 0.075 / 1.75 * size, 1e-5);
  double top = point(model, &p, "head_top")[1];
  if (top < 0.98 * size || top > 1.03 * size) {
    print_error("%s: the vertex of a %g m subject stands at %g m\n", name, size, top);
    fail();
  }
  ambulo_model_free(model);
}

static void subjects_stand(void **state) {
  (void)state;
  static const ambulo_subject subjects[] = {{sizeof(ambulo_subject), 75, 1.75, AMBULO_MALE},
                                            {sizeof(ambulo_subject), 60, 1.65, AMBULO_FEMALE},
                                            {sizeof(ambulo_subject), 95, 1.95, AMBULO_MALE}};
  for (int i = 0; i < 3; i++) {
    standing("lower_body_18", subjects[i]);
    standing("lower_body_18_rigid", subjects[i]);
    standing("walker_2d", subjects[i]);
  }
}

/* Signs of Rajagopal et al. (2016), seen in where the ankle and the toe go. X forward, Y up,
 * Z right. */
static void signs_of_the_lower_body(void **state) {
  (void)state;
  ambulo_model *model = load("lower_body_18", NULL);
  static const struct {
    const char *coordinate, *point;
    int axis, direction; /* the point moves so along the axis when the coordinate grows */
  } cases[] = {{"pelvis_tx", "pelvis", 0, 1},
               {"pelvis_ty", "pelvis", 1, 1},
               {"pelvis_tz", "pelvis", 2, 1},
               {"pelvis_tilt", "head_top", 0, -1},
               {"pelvis_list", "head_top", 2, 1},
               {"pelvis_rotation", "toe_r", 2, -1},
               {"hip_flexion_r", "ankle_r", 0, 1},
               {"hip_flexion_l", "ankle_l", 0, 1},
               {"hip_adduction_r", "ankle_r", 2, -1},
               {"hip_adduction_l", "ankle_l", 2, 1},
               {"hip_rotation_r", "toe_r", 2, -1},
               {"hip_rotation_l", "toe_l", 2, 1},
               {"knee_angle_r", "ankle_r", 0, -1},
               {"knee_angle_l", "ankle_l", 0, -1},
               {"ankle_angle_r", "toe_r", 1, 1},
               {"ankle_angle_l", "toe_l", 1, 1},
               {"subtalar_angle_r", "toe_medial_r", 1, 1},
               {"subtalar_angle_l", "toe_medial_l", 1, 1}};
  assert_int_equal(ambulo_model_coordinate_count(model), 18);
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    double q[MOST_COORDINATES] = {0};
    pose before = still(model, q);
    set(model, q, cases[i].coordinate, 0.1);
    pose after = still(model, q);
    double moved = point(model, &after, cases[i].point)[cases[i].axis] -
                   point(model, &before, cases[i].point)[cases[i].axis];
    if (moved * cases[i].direction < 0.003) {
      print_error("%s = 0.1 moves %s by %g m along axis %d, expected sign %d\n",
                  cases[i].coordinate, cases[i].point, moved, cases[i].axis, cases[i].direction);
      fail();
    }
  }
  ambulo_model_free(model);
}

/* mirrored coordinates give mirrored points and forces, by the model's own pairs and signs */
static void mirror_images(const char *name) {
  ambulo_model *model = load(name, NULL);
  int count = ambulo_model_coordinate_count(model);
  double s[2][3][MOST_COORDINATES];
  for (int i = 0; i < count; i++) {
    const ambulo_coordinate *c = ambulo_model_coordinate(model, i);
    for (int k = 0; k < 3; k++) {
      s[0][k][i] = 0.3 * sin(1 + 1.3 * i + 2.1 * k);
      s[1][k][c->mirror] = c->mirror_sign * s[0][k][i];
    }
  }
  pose one = evaluate(model, s[0][0], s[0][1], s[0][2]);
  pose two = evaluate(model, s[1][0], s[1][1], s[1][2]);
  for (int i = 0; i < count; i++) {
    const ambulo_coordinate *c = ambulo_model_coordinate(model, i);
    assert_close(two.tau[c->mirror], c->mirror_sign * one.tau[i], 1e-12);
  }
  for (int f = 0; f < ambulo_model_foot_count(model); f++) {
    const ambulo_foot *foot = ambulo_model_foot(model, f);
    const double *here = one.points[foot->toe_center];
    const double *there = two.points[ambulo_model_foot(model, foot->mirror)->toe_center];
    const double *left = ambulo_model_left(model);
    for (int k = 0; k < 3; k++) {
      assert_close(there[k], (left[k] != 0 ? -1 : 1) * here[k], 1e-13);
    }
  }
  ambulo_model_free(model);
}

static void mirrored(void **state) {
  (void)state;
  mirror_images("lower_body_18");
  mirror_images("walker_2d");
  mirror_images("yardstick_body");
}

/* de Leva's thigh of a man of 75 kg and 1.75 m; Anderson's strength of hip and ankle */
static void published_numbers(void **state) {
  (void)state;
  ambulo_model *model = load("lower_body_18", NULL);
  const ambulo_link *thigh = ambulo_model_link(model, ambulo_model_find_link(model, "thigh_r"));
  double length = 0.4222 * 1.75 / 1.741, mass = 0.1416 * 75, moment = 75 * 9.81 * 1.75;
  assert_close(thigh->mass, mass, 1e-12);
  assert_close(thigh->com[1], -0.4095 * length, 2e-6);
  assert_close(thigh->inertia[0], mass * pow(0.329 * length, 2), 2e-6);
  assert_close(thigh->inertia[1], mass * pow(0.149 * length, 2), 2e-6);
  assert_close(thigh->inertia[2], mass * pow(0.329 * length, 2), 2e-6);
  const ambulo_coordinate *hip =
      ambulo_model_coordinate(model, ambulo_model_find_coordinate(model, "hip_flexion_l"));
  assert_close(hip->torque[0], -(0.161 + 2 * 0.049) * moment, 1e-12);
  assert_close(hip->torque[1], (0.113 + 2 * 0.025) * moment, 1e-12);
  const ambulo_coordinate *ankle =
      ambulo_model_coordinate(model, ambulo_model_find_coordinate(model, "ankle_angle_r"));
  assert_close(ankle->torque[0], -(0.095 + 2 * 0.022) * moment, 1e-12);
  assert_close(ankle->torque[1], (0.033 + 2 * 0.005) * moment, 1e-12);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(pendulum),       cmocka_unit_test(two_link),
      cmocka_unit_test(subjects_stand), cmocka_unit_test(signs_of_the_lower_body),
      cmocka_unit_test(mirrored),       cmocka_unit_test(published_numbers)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
