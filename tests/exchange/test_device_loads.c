/* Forces and torques of devices on bodies of random trees do the virtual work of the device: their
 * generalized forces are its effort at its coordinate alone, or the gradient of its length. */
#include "exchange/loads.h"

#include "ambulo/mechanics.h"
#include "people/ground_load.h"
#include "mechanics/pose.h"
#include "support/random_model.h"
#include "support/test.h"

enum { SEEDS = 200 };

typedef struct device_case {
  const ambulo__bodies *bodies;
  ambulo__pose *pose;
  double q[random_max_links], force[random_max_links]; /* generalized, of both ends */
} device_case;

/* both ends, through the links whose frames the bodies have */
static void generalized(device_case *c, const ambulo_device *device, double effort) {
  const ambulo__bodies *b = c->bodies;
  double sum[6] = {0};
  memset(c->force, 0, sizeof c->force);
  for (int end = 0; end < 2; end++) {
    double f[3], p[3], t[3], moment[3];
    int body = ambulo__device_end(b, device, end);
    ambulo__device_load(b, device, end, c->pose->frames, effort, f, p, t);
    for (int i = 0; i < 3; i++)
      moment[i] = t[i] + p[(i + 1) % 3] * f[(i + 2) % 3] - p[(i + 2) % 3] * f[(i + 1) % 3];
    for (int i = 0; i < 3; i++) {
      sum[i] += f[i];
      sum[3 + i] += moment[i];
    }
    if (body >= 0)
      ambulo__load_take(b->model, c->pose->frames, b->list[body].link, f, moment, c->force);
  }
  for (int i = 0; i < 6; i++) assert_close(sum[i], 0.0, 1e-7 * fabs(effort));
}

/* three axes of a joint that nearly lie in a plane ask for large torques */
static double size_at(const device_case *c, const ambulo_device *device) {
  double f[3], p[3], t[3];
  ambulo__device_load(c->bodies, device, 0, c->pose->frames, 1.0, f, p, t);
  return 1.0 + fabs(f[0]) + fabs(f[1]) + fabs(f[2]) + fabs(t[0]) + fabs(t[1]) + fabs(t[2]);
}

static int at_joints(device_case *c) {
  int shared = 0;
  for (int i = 0; i < c->bodies->model->coordinate_count; i++) {
    ambulo_device device = ambulo_device_default(AMBULO_DEVICE_ACTUATOR);
    device.coordinate = i;
    int body = ambulo__device_end(c->bodies, &device, 0);
    assert_true(body >= 0 || c->bodies->root >= 0);
    if (body < 0) continue;
    shared += c->bodies->list[body].joints > 1;
    double size = size_at(c, &device);
    if (size > 1e4) continue;
    generalized(c, &device, 7.0);
    for (int k = 0; k < c->bodies->model->coordinate_count; k++)
      assert_close(-c->force[k], k == i ? 7.0 : 0.0, 1e-12 * size);
  }
  return shared;
}

static double length_of(device_case *c, const ambulo_device *device) {
  double a[3], b[3];
  ambulo__pose_point(c->pose, device->link[0], device->position[0], a);
  ambulo__pose_point(c->pose, device->link[1], device->position[1], b);
  return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
              (a[2] - b[2]) * (a[2] - b[2]));
}

static void between_points(device_case *c, random_source *source) {
  const ambulo_model *model = c->bodies->model;
  ambulo_device device = ambulo_device_default(AMBULO_DEVICE_SPRING);
  device.coordinate = -1;
  for (int end = 0; end < 2; end++) {
    int body = random_below(source, c->bodies->count);
    device.link[end] = c->bodies->list[body].link;
    for (int k = 0; k < 3; k++) device.position[end][k] = random_between(source, 1 + end, 2 + end);
  }
  if (length_of(c, &device) < 0.1) return;
  generalized(c, &device, 5.0);
  double held[random_max_links];
  memcpy(held, c->force, sizeof held);
  for (int k = 0; k < model->coordinate_count; k++) {
    double ends[2], q = c->q[k];
    for (int side = 0; side < 2; side++) {
      c->q[k] = q + (side ? 1e-5 : -1e-5);
      ambulo__pose_at(c->pose, c->q);
      ends[side] = length_of(c, &device);
    }
    c->q[k] = q;
    assert_close(held[k], 5.0 * (ends[1] - ends[0]) / 2e-5, 1e-6);
  }
  ambulo__pose_at(c->pose, c->q);
}

static void virtual_work(void **state) {
  (void)state;
  int shared = 0;
  for (uint64_t seed = 1; seed <= SEEDS; seed++) {
    random_tree *tree = malloc(sizeof *tree);
    random_source source = {seed + 900};
    ambulo_model *model = NULL;
    ambulo__pose pose = {.model = NULL};
    random_tree_make(tree, seed, 1 + (int)(seed % 10));
    if (seed % 3 == 0) random_tree_put_on_root(tree, seed);
    assert_int_equal(ambulo_model_create(&tree->definition, NULL, NULL, &model), AMBULO_OK);
    assert_int_equal(ambulo__pose_create(model, NULL, &pose), AMBULO_OK);
    for (int kind = 0; kind < 3; kind++) {
      ambulo__bodies bodies;
      assert_int_equal(kind ? ambulo__bodies_single(model, kind == 2, NULL, &bodies)
                            : ambulo__bodies_merged(model, NULL, &bodies),
                       AMBULO_OK);
      device_case c = {.bodies = &bodies, .pose = &pose};
      for (int i = 0; i < model->coordinate_count; i++) c.q[i] = random_between(&source, -2, 2);
      ambulo__pose_at(&pose, c.q);
      shared += at_joints(&c);
      if (kind < 2) between_points(&c, &source);
      ambulo__bodies_free(&bodies);
    }
    ambulo__pose_free(&pose);
    ambulo_model_free(model);
    free(tree);
  }
  assert_true(shared > 100); /* joints of several axes */
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(virtual_work)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
