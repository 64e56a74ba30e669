/* Any placement and axis as DH rows, against the product of its definition. */
#include "model/placement.h"
#include "support/test.h"

typedef struct frame {
  double r[3][3], p[3];
} frame;

static frame times(const frame *a, const frame *b) {
  frame c;
  for (int i = 0; i < 3; i++) {
    c.p[i] = a->p[i];
    for (int k = 0; k < 3; k++) {
      c.p[i] += a->r[i][k] * b->p[k];
      c.r[i][k] = 0;
      for (int j = 0; j < 3; j++) c.r[i][k] += a->r[i][j] * b->r[j][k];
    }
  }
  return c;
}

static frame about(const double u[3], double angle) {
  double c = cos(angle), s = sin(angle);
  const double cross[3][3] = {{0, -u[2], u[1]}, {u[2], 0, -u[0]}, {-u[1], u[0], 0}};
  frame a = {{{0}}, {0}};
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) a.r[i][k] = c * (i == k) + s * cross[i][k] + (1 - c) * u[i] * u[k];
  return a;
}

/* Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha) */
static frame of_row(const ambulo_link *row, double q) {
  static const double x[3] = {1, 0, 0}, z[3] = {0, 0, 1};
  frame first = about(z, row->theta + (row->type == AMBULO_REVOLUTE ? q : 0));
  frame last = about(x, row->alpha);
  last.p[0] = row->a;
  last.p[2] = row->d + (row->type == AMBULO_PRISMATIC ? q : 0);
  return times(&first, &last);
}

static void compare(const ambulo__placement *p, ambulo_joint_type type, double q) {
  ambulo_link row[AMBULO__MOST_ROWS];
  int joint = -2, count = ambulo__placement_rows(p, type, row, &joint), moving = 0;
  frame want, got = about((const double[3]){0, 0, 1}, 0), move = got;
  assert_true(count >= 1 && count <= AMBULO__MOST_ROWS);
  for (int i = 0; i < 3; i++) {
    want.p[i] = p->xyz[i];
    move.p[i] = type == AMBULO_PRISMATIC ? q * p->axis[i] : 0;
    for (int k = 0; k < 3; k++) want.r[i][k] = p->rotation[i][k];
  }
  if (type == AMBULO_REVOLUTE) move = about(p->axis, q);
  want = times(&want, &move);
  for (int i = 0; i < count; i++) {
    frame f = of_row(&row[i], q);
    got = times(&got, &f);
    moving += row[i].type != AMBULO_FIXED;
  }
  assert_int_equal(moving, type != AMBULO_FIXED);
  if (type != AMBULO_FIXED) assert_int_equal(row[joint].type, type);
  for (int i = 0; i < 3; i++) {
    assert_close(got.p[i], want.p[i], 2e-14);
    for (int k = 0; k < 3; k++) assert_close(got.r[i][k], want.r[i][k], 2e-14);
  }
}

static ambulo__placement placement(const double xyz[3], const double rpy[3], const double axis[3]) {
  ambulo__placement p;
  double size = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  for (int i = 0; i < 3; i++) {
    p.xyz[i] = xyz[i];
    p.axis[i] = axis[i] / size;
  }
  ambulo__rotation_of_rpy(rpy, p.rotation);
  return p;
}

/* oblique, along every axis either way, nearly along them, with and without a way */
static void every_placement(void **state) {
  (void)state;
  static const double axes[][3] = {{1, 0, 0},  {0, 1, 0},    {0, 0, 1},         {-1, 0, 0},
                                   {0, -1, 0}, {0, 0, -1},   {1, 2, 3},         {-0.2, 0.1, 1},
                                   {0, 1, 1},  {1e-9, 0, 1}, {1e-15, 1e-15, 1}, {1, 1e-8, -1e-8}};
  const double right = acos(0),
               turns[][3] = {{0, 0, 0},      {right, 0, 0},        {0, right, 0},  {0, -right, 0.3},
                             {0, 0, -right}, {2 * right, 0, 0},    {0.1, -0.7, 2}, {1e-9, 0, 0},
                             {3, 1.5, -3},   {right, right, right}};
  static const double ways[][3] = {{0, 0, 0}, {0, 0, 0.4}, {1, -2, 0.5}, {-0.3, 0, 0}};
  for (size_t a = 0; a < sizeof axes / sizeof axes[0]; a++)
    for (size_t t = 0; t < sizeof turns / sizeof turns[0]; t++)
      for (size_t w = 0; w < sizeof ways / sizeof ways[0]; w++) {
        ambulo__placement p = placement(ways[w], turns[t], axes[a]);
        compare(&p, AMBULO_FIXED, 0);
        compare(&p, AMBULO_REVOLUTE, 0.7);
        compare(&p, AMBULO_PRISMATIC, -0.3);
      }
}

/* what a person would write by hand: no row that does nothing, right angles exact */
static void plain_joints_are_plain(void **state) {
  (void)state;
  ambulo_link row[AMBULO__MOST_ROWS];
  int joint;
  static const double none[3] = {0, 0, 0}, up[3] = {0, 0, 0.4}, x[3] = {1, 0, 0}, z[3] = {0, 0, 1};
  ambulo__placement p = placement(none, none, z);
  assert_int_equal(ambulo__placement_rows(&p, AMBULO_REVOLUTE, row, &joint), 1);
  assert_int_equal(joint, 0);
  assert_close(row[0].theta, 0, 0);
  assert_close(row[0].alpha, 0, 0);
  assert_int_equal(ambulo__placement_rows(&p, AMBULO_FIXED, row, &joint), 1);
  p = placement(up, none, z);
  assert_int_equal(ambulo__placement_rows(&p, AMBULO_PRISMATIC, row, &joint), 2);
  p = placement(none, none, x);
  assert_int_equal(ambulo__placement_rows(&p, AMBULO_REVOLUTE, row, &joint), 3);
  assert_close(fabs(row[0].theta), acos(0), 0);
  assert_close(fabs(row[0].alpha), acos(0), 0);
  assert_close(row[1].theta, 0, 0);
}

/* angles of a rotation and back, also where pitch is upright */
static void angles_come_back(void **state) {
  (void)state;
  const double right = acos(0);
  const double cases[][3] = {{0.1, 0.2, 0.3}, {-2, 1.2, 3},         {0, right, 0.4},
                             {0, -right, -1}, {1, right - 1e-9, 2}, {0, 0, 0}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    double r[3][3], rpy[3], again[3][3];
    ambulo__rotation_of_rpy(cases[i], r);
    ambulo__rpy_of_rotation((const double(*)[3])r, rpy);
    ambulo__rotation_of_rpy(rpy, again);
    for (int u = 0; u < 3; u++)
      for (int v = 0; v < 3; v++) assert_close(again[u][v], r[u][v], 1e-15);
  }
  static const double turn[3] = {0.3, 0, 0};
  double r[3][3];
  ambulo__rotation_of_rpy(turn, r); /* roll is about x: y goes to z */
  assert_close(r[2][1], sin(0.3), 1e-16);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_placement),
                                     cmocka_unit_test(plain_joints_are_plain),
                                     cmocka_unit_test(angles_come_back)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
