/* What pushes at a body besides the ground under its feet: which columns become which load, on
 * which body, with which sign; and that torques lose them. */
#include "ambulo/mechanics.h"
#include "ambulo/tools/load.h"
#include "exchange/export.h"
#include "mechanics/pose.h"
#include "people/ground_load.h"
#include "support/messages.h"
#include "support/random_model.h"
#include "support/scratch.h"
#include "support/test.h"

enum { ROWS = 5 };

typedef struct load_case {
  ambulo_problem *problem;
  ambulo__bodies bodies;
  ambulo__source source;
  ambulo__loads loads;
  ambulo_diagnostics *list;
  double *bare; /* tau without them */
} load_case;

/* rows every 0.5 s, all columns constant */
static void write_motion(const char *file, const char *columns, const char *values) {
  char text[2000];
  int at = snprintf(text, sizeof text, "time,q.pelvis_tz,%s\n", columns);
  for (int k = 0; k < ROWS; k++)
    at += snprintf(text + at, sizeof text - (size_t)at, "%g,0,%s\n", 0.5 * k, values);
  scratch_write(file, text);
}

static void open_case(load_case *c, void **state, const char *problem, const char *columns,
                      const char *values) {
  const char *motion = scratch_path(state, "m.csv");
  ambulo_inverse_options none = ambulo_inverse_options_default();
  none.without_forces = 1;
  *c = (load_case){.list = ambulo_diagnostics_create(NULL)};
  write_motion(motion, columns, values);
  assert_int_equal(ambulo_problem_load(problem, NULL, 0, NULL, NULL, &c->problem), AMBULO_OK);
  const ambulo_model *model = ambulo_problem_model(c->problem);
  assert_int_equal(ambulo__source_read(model, motion, &none, 0, NULL, NULL, &c->source), AMBULO_OK);
  size_t bytes = sizeof(double) * ROWS * (size_t)c->source.coordinates;
  c->bare = malloc(bytes);
  memcpy(c->bare, c->source.tau, bytes);
  assert_int_equal(ambulo__bodies_merged(model, NULL, &c->bodies), AMBULO_OK);
  assert_int_equal(ambulo__loads_create(&c->bodies, c->problem, &c->source, c->list, &c->loads),
                   AMBULO_OK);
}

static void close_case(load_case *c) {
  free(c->bare);
  ambulo__loads_free(&c->loads);
  ambulo__bodies_free(&c->bodies);
  ambulo__source_free(&c->source);
  ambulo_diagnostics_free(c->list);
  ambulo_problem_free(c->problem);
}

static void is_load(const load_case *c, int index, const char *name, const char *body) {
  const ambulo__export_load *load = &c->loads.list[index];
  assert_string_equal(load->name, name);
  assert_string_equal(c->bodies.list[load->body].name, body);
}

static void is_vector(const load_case *c, const double *field, int row, int load, double x,
                      double y, double z) {
  const double *v = field + 3 * (row * c->loads.count + load);
  assert_close(v[0], x, 1e-12);
  assert_close(v[1], y, 1e-12);
  assert_close(v[2], z, 1e-12);
}

/* what the torque of a coordinate lost in the first row */
static double lost(const load_case *c, const char *name) {
  int i = ambulo_model_find_coordinate(ambulo_problem_model(c->problem), name);
  assert_true(i >= 0);
  return c->bare[i] - c->source.tau[i];
}

/* the moment is about the origin: (-0.2, 0.5, 0.05) x (10, 300, 20) and 4 N m about up */
static void a_seat(void **state) {
  load_case c;
  open_case(&c, state, "models/sit_to_stand.yaml",
            "grf.seat.x,grf.seat.y,grf.seat.z,cop.seat.x,cop.seat.y,cop.seat.z,moment.seat.x,"
            "moment.seat.y,moment.seat.z",
            "10,300,20,-0.2,0.5,0.05,-5,8.5,-65");
  assert_int_equal(c.loads.count, 1);
  is_load(&c, 0, "seat", "pelvis");
  is_vector(&c, c.loads.force, 0, 0, 10, 300, 20);
  is_vector(&c, c.loads.point, 0, 0, -0.2, 0.5, 0.05);
  is_vector(&c, c.loads.torque, 0, 0, 0, 4, 0);
  assert_close(lost(&c, "pelvis_ty"), 300, 1e-9);
  assert_close(lost(&c, "hip_flexion_r"), 0, 1e-12);
  close_case(&c);
}

/* columns of a problem's own, which are not there */
static void a_seat_that_is_not_told(void **state) {
  load_case c;
  open_case(&c, state, "models/sit_to_stand.yaml", "q.pelvis_tx", "0");
  assert_int_equal(c.loads.count, 0);
  assert_message(c.list, 0, "the motion has no columns of the patch 'seat': it is left out");
  close_case(&c);
}

static void a_device(void **state) {
  load_case c;
  open_case(&c, state, "models/walk_ankle_exoskeleton.yaml",
            "device.ankle_spring_r.torque,device.ankle_spring_l.torque", "-60,0");
  assert_int_equal(c.loads.count, 4);
  is_load(&c, 0, "ankle_spring_r_foot_r", "foot_r");
  is_load(&c, 1, "ankle_spring_r_shank_r", "shank_r");
  assert_int_equal(c.loads.list[1].part, 1);
  for (int i = 0; i < ambulo_model_coordinate_count(ambulo_problem_model(c.problem)); i++) {
    const char *name = ambulo_model_coordinate(ambulo_problem_model(c.problem), i)->name;
    assert_close(lost(&c, name), strcmp(name, "ankle_angle_r") == 0 ? -60.0 : 0.0, 1e-12);
  }
  assert_true(c.loads.torque[2] < -50.0); /* about the left, more or less */
  is_vector(&c, c.loads.torque, 0, 1, -c.loads.torque[0], -c.loads.torque[1], -c.loads.torque[2]);
  close_case(&c);
}

/* the mirrored half of a stride: the tendon between the feet is its own image */
static double tendon_length(load_case *c, int coordinate, double by) {
  const ambulo_device *tendon = &c->problem->definition.devices[0];
  ambulo__pose pose = {.model = NULL};
  double ends[2][3], sum = 0.0;
  assert_int_equal(ambulo__pose_create(ambulo_problem_model(c->problem), NULL, &pose), AMBULO_OK);
  c->source.q[coordinate] += by;
  ambulo__pose_at(&pose, c->source.q);
  c->source.q[coordinate] -= by;
  for (int k = 0; k < 2; k++)
    ambulo__pose_point(&pose, tendon->link[k], tendon->position[k], ends[k]);
  for (int i = 0; i < 3; i++) sum += (ends[1][i] - ends[0][i]) * (ends[1][i] - ends[0][i]);
  ambulo__pose_free(&pose);
  return sqrt(sum);
}

static void a_tendon(void **state) {
  load_case c;
  open_case(&c, state, "models/walk_exotendon.yaml", "device.tendon.force,q.hip_flexion_r",
            "40,0.3");
  assert_int_equal(c.loads.count, 2);
  is_load(&c, 0, "tendon_foot_r", "foot_r");
  double size = 0.0, along = 0.0;
  for (int i = 0; i < 3; i++) {
    const double *f = c.loads.force, *p = c.loads.point;
    assert_close(f[i], -f[3 + i], 1e-12);
    size += f[i] * f[i];
    along += f[i] * (p[3 + i] - p[i]);
  }
  assert_close(sqrt(size), 40.0, 1e-12);
  assert_true(along > 0.0); /* it pulls, and does the virtual work of that */
  int hip = ambulo_model_find_coordinate(ambulo_problem_model(c.problem), "hip_flexion_r");
  double slope = (tendon_length(&c, hip, 1e-5) - tendon_length(&c, hip, -1e-5)) / 2e-5;
  assert_true(fabs(slope) > 0.1);
  assert_close(lost(&c, "hip_flexion_r"), -40.0 * slope, 1e-6);
  close_case(&c);
}

/* a seat that carries is no reason to doubt the feet's forces */
static void feet_are_not_all(void **state) {
  const char *motion = scratch_path(state, "m.csv");
  ambulo_model *model = NULL;
  assert_int_equal(
      ambulo_model_load("models/whole_body_29.yaml",
                        &(ambulo_subject){sizeof(ambulo_subject), 75, 1.75, AMBULO_MALE}, NULL,
                        NULL, &model),
      AMBULO_OK);
  write_motion(motion,
               "grf.right.x,grf.right.y,grf.right.z,cop.right.x,cop.right.y,cop.right.z,"
               "grf.left.x,grf.left.y,grf.left.z,cop.left.x,cop.left.y,cop.left.z,"
               "grf.seat.x,grf.seat.y,grf.seat.z",
               "0,200,0,0,0,0.1,0,200,0,0,0,-0.1,0,335,0");
  for (int others = 0; others < 2; others++) {
    ambulo__source source;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    assert_int_equal(ambulo__source_read(model, motion, NULL, others, NULL, list, &source),
                     AMBULO_OK);
    assert_int_equal(source.loads, 2);
    int doubted = 0;
    for (size_t i = 0; i < ambulo_diagnostics_count(list); i++) {
      char text[400];
      ambulo_diagnostics_format(list, i, text, sizeof text);
      doubted += strstr(text, "'grf.seat' act on no foot") || strstr(text, "the forces leave over");
    }
    assert_int_equal(doubted, others ? 0 : 2);
    ambulo__source_free(&source);
    ambulo_diagnostics_free(list);
  }
  ambulo_model_free(model);
}

/* a model alone knows no devices */
static void without_the_problem(void **state) {
  load_case c;
  open_case(&c, state, "models/walk_exotendon.yaml", "device.tendon.force", "40");
  ambulo__loads loads;
  assert_int_equal(ambulo__loads_create(&c.bodies, NULL, &c.source, c.list, &loads), AMBULO_OK);
  assert_int_equal(loads.count, 0);
  assert_message(c.list, 0,
                 "the motion has 'device.tendon.force', which is left out without its problem");
  ambulo__loads_free(&loads);
  close_case(&c);
}

/* Forces and torques of devices on bodies of random trees do the virtual work of the device: their
 * generalized forces are its effort at its coordinate alone, or the gradient of its length. */

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
      ambulo__load_take(b->model, c->pose->frames, b->list[body].link, c->q, f, moment, c->force);
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
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(a_seat),
      TEST(a_seat_that_is_not_told),
      TEST(a_device),
      TEST(a_tendon),
      TEST(feet_are_not_all),
      TEST(without_the_problem),
      cmocka_unit_test(virtual_work),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
