/* Every joint of OpenSim, versions 3 and 4, against its own definition: transforms of
 * every_joint_v3.osim and _v4.osim composed here by hand, with numbers typed from the file. The
 * mass matrix is sum m Jv'Jv + Jw' I Jw and the torque of gravity sum m g dy/dq, with Jacobians by
 * complex steps, which are exact. Torques of a whole state were computed by OpenSim 4.6. */
#include <complex.h>

#include "support/import_case.h"

typedef double complex cx;
typedef struct frame {
  cx r[3][3], p[3];
} frame;

enum { COORDINATES = 22, BODIES = 11 };

static const char *const names[COORDINATES] = {
    "base_rx",   "base_ry",    "base_rz",    "base_tx",    "base_ty", "base_tz",
    "hip_turn",  "rail_way",   "cross_1",    "cross_2",    "bend",    "stretch",
    "line_turn", "shoulder_1", "shoulder_2", "shoulder_3", "elbow_1", "elbow_2",
    "elbow_3",   "plane_turn", "plane_x",    "plane_y"};

/* ----------------------------------------------------------------------- transforms */

static frame times(frame a, frame b) {
  frame c;
  for (int i = 0; i < 3; i++) {
    c.p[i] = a.p[i];
    for (int k = 0; k < 3; k++) {
      c.p[i] += a.r[i][k] * b.p[k];
      c.r[i][k] = 0.0;
      for (int j = 0; j < 3; j++) c.r[i][k] += a.r[i][j] * b.r[j][k];
    }
  }
  return c;
}

static frame slide(double x, double y, double z, cx by) {
  frame a = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {x * by, y * by, z * by}};
  return a;
}

/* about a unit axis: c 1 + s [u]x + (1 - c) u u' */
static frame turn(double x, double y, double z, cx angle) {
  double size = sqrt(x * x + y * y + z * z), u[3] = {x / size, y / size, z / size};
  cx c = ccos(angle), s = csin(angle);
  frame a = slide(0, 0, 0, 0);
  const double cross[3][3] = {{0, -u[2], u[1]}, {u[2], 0, -u[0]}, {-u[1], u[0], 0}};
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++)
      a.r[i][k] = c * (i == k) + s * cross[i][k] + (1.0 - c) * u[i] * u[k];
  return a;
}

static frame back(frame a) {
  frame b;
  for (int i = 0; i < 3; i++) {
    b.p[i] = 0.0;
    for (int k = 0; k < 3; k++) {
      b.r[i][k] = a.r[k][i];
      b.p[i] -= a.r[k][i] * a.p[k];
    }
  }
  return b;
}

/* a frame of the file: location, then turns about x, the turned y and the turned z */
static frame at(double x, double y, double z, double a, double b, double c) {
  frame f = times(slide(x, y, z, 1), turn(1, 0, 0, a));
  return times(times(f, turn(0, 1, 0, b)), turn(0, 0, 1, c));
}

static frame xyz(cx a, cx b, cx c) {
  return times(times(turn(1, 0, 0, a), turn(0, 1, 0, b)), turn(0, 0, 1, c));
}

static frame joint(frame parent, frame in_parent, frame moved, frame in_child) {
  return times(times(parent, in_parent), times(moved, back(in_child)));
}

/* --------------------------------------------------------------------------- bodies */

/* x[n] = m \ right, by elimination; pivots of a spline are good in this order but for the first */
static void eliminate(int n, double m[8][8], double *right) {
  for (int k = 0; k < n; k++)
    for (int i = 0; i < n; i++) {
      double factor = i == k ? 0.0 : m[i][k] / m[k][k];
      for (int j = 0; j < n && factor != 0.0; j++) m[i][j] -= factor * m[k][j];
      right[i] -= factor * right[k];
    }
  for (int k = 0; k < n; k++) right[k] /= m[k][k];
}

/* 6 times the third divided difference of four points */
static double third(const double *x, const double *y) {
  double sum = 0.0;
  for (int i = 0; i < 4; i++) {
    double product = y[i];
    for (int k = 0; k < 4; k++) product /= k == i ? 1.0 : x[i] - x[k];
    sum += product;
  }
  return 6.0 * sum;
}

/* The spline through points, with second derivatives u: the piece of q, as a cubic. The third
 * derivative at both ends is that of the cubic through four points; three points: the parabola. */
static cx spline(int n, const double *x, const double *y, cx q) {
  double m[8][8] = {{0}}, u[8] = {0};
  m[0][0] = m[n - 1][n - 2] = -1;
  m[0][1] = m[n - 1][n - 1] = 1;
  u[0] = n > 3 ? (x[1] - x[0]) * third(x, y) : 0.0;
  u[n - 1] = n > 3 ? (x[n - 1] - x[n - 2]) * third(x + n - 4, y + n - 4) : 0.0;
  for (int i = 1; i + 1 < n; i++) {
    double before = x[i] - x[i - 1], behind = x[i + 1] - x[i];
    m[i][i - 1] = before / 6;
    m[i][i] = (before + behind) / 3;
    m[i][i + 1] = behind / 6;
    u[i] = (y[i + 1] - y[i]) / behind - (y[i] - y[i - 1]) / before;
  }
  eliminate(n, m, u);
  int i = 0;
  while (i + 2 < n && creal(q) > x[i + 1]) i++;
  double h = x[i + 1] - x[i];
  cx a = (x[i + 1] - q) / h, b = (q - x[i]) / h;
  return a * y[i] + b * y[i + 1] +
         ((a * a * a - a) * u[i] + (b * b * b - b) * u[i + 1]) * h * h / 6;
}

static frame knee(cx bend, cx stretch) {
  /* translations: 2 stretch + 0.01 along x; a spline of bend along y; 0.2 times another along
   * (0, 0.1, 1). rotations: 0.2 - bend about (0.1, 0.2, 1), 0.3 about (0, 1, 0.1), 0.12 about
   * (1, 0, 0.05) */
  static const double x[] = {-2.1, -1, -0.2, 0.4, 1, 1.7}, few[] = {-2.1, -0.5, 2.1};
  static const double y[] = {-0.032, 0.0179, 0.0083, 0.0012, 0.007, 0.03}, of[] = {-0.2, 0.05, 0.3};
  const cx small = 0.2 * spline(3, few, of, bend) / sqrt(1.01);
  frame f = times(slide(1, 0, 0, 2 * stretch + 0.01), slide(0, 1, 0, spline(6, x, y, bend)));
  f = times(f, slide(0, 0.1, 1, small));
  f = times(f, turn(0.1, 0.2, 1, 0.2 - bend));
  return times(times(f, turn(0, 1, 0.1, 0.3)), turn(1, 0, 0.05, 0.12));
}

static void pose(const cx q[COORDINATES], frame b[BODIES + 1]) {
  frame ground = slide(0, 0, 0, 0), none = slide(0, 0, 0, 0);
  frame shift = times(slide(1, 0, 0, q[3]), times(slide(0, 1, 0, q[4]), slide(0, 0, 1, q[5])));
  b[0] = joint(ground, at(0.1, 0.9, 0.2, 0.1, -0.3, 0.2), times(shift, xyz(q[0], q[1], q[2])),
               at(0.02, 0.01, -0.04, 0.2, 0.1, -0.1));
  b[1] = joint(b[0], at(0.1, -0.2, 0.05, 0.3, -0.2, 0.5), turn(0, 0, 1, q[6]),
               at(-0.02, 0.03, 0.04, 0.1, 0.2, -0.3));
  b[2] = joint(b[1], at(0, -0.3, 0, 0.4, 0.1, -0.6), slide(1, 0, 0, q[7]),
               at(0.01, -0.02, 0.03, -0.2, 0.3, 0.1));
  b[3] = joint(b[2], at(0.1, 0, 0.02, 0, 0.7, 0), none, at(0, 0.05, 0, 0.3, 0, 0.1));
  b[4] = joint(b[3], at(0.05, 0.02, -0.01, 0.2, 0.2, -0.4),
               times(turn(1, 0, 0, q[8]), turn(0, 1, 0, q[9])), at(0.03, 0.04, 0, 0, -0.2, 0.3));
  b[5] = joint(b[0], at(0, 0.3, 0.15, 0.1, 0.5, -0.2), xyz(q[13], q[14], q[15]),
               at(0.01, 0.12, 0.02, 0.3, 0.1, 0.2));
  b[6] = joint(b[5], at(0, -0.25, 0, -0.1, 0.2, 0.3), xyz(q[16], q[17], q[18]),
               at(0, 0.1, 0, 0.2, -0.3, 0.1));
  frame plane = times(times(slide(1, 0, 0, q[20]), slide(0, 1, 0, q[21])), turn(0, 0, 1, q[19]));
  b[7] =
      joint(b[0], at(-0.1, 0.05, -0.15, 0.6, -0.1, 0.2), plane, at(0.02, 0, -0.01, 0.1, 0.1, 0.4));
  b[8] = joint(b[1], at(0.02, -0.35, 0.01, 0.1, 0.1, 0.2), knee(q[10], q[11]),
               at(0.01, 0.02, -0.01, -0.1, 0.05, 0.15));
  b[9] =
      joint(b[8], at(0, -0.3, 0.02, 0, 0.2, 0.1), turn(0, 0, 1, q[12]), at(0, 0.01, 0, 0.05, 0, 0));
  /* locked at 0.4; follows the hip */
  b[10] = joint(b[9], at(0, -0.15, 0, 0.2, 0, 0.3), turn(0, 0, 1, 0.4), at(0.01, 0, 0, 0, 0.1, 0));
  b[11] = joint(b[9], at(0.02, -0.1, 0.03, 0, -0.3, 0.2), turn(0, 0, 1, 0.5 * q[6] + 0.1),
                at(0, 0.02, 0, 0.1, 0.1, 0.1));
}

static const struct {
  double mass, com[3], inertia[6];
} bodies[BODIES + 1] = {{5, {0.01, 0.02, -0.03}, {0.09, 0.08, 0.07, 0.004, -0.003, 0.002}},
                        {2.5, {0, -0.1, 0.02}, {0.03, 0.02, 0.025, 0.001, 0.002, -0.001}},
                        {1.2, {0.05, 0, 0}, {0.004, 0.006, 0.005, 0, 0, 0.0005}},
                        {0.7, {0, 0.03, 0}, {0.002, 0.001, 0.002, 0, 0, 0}},
                        {1.1, {0.02, -0.04, 0.01}, {0.003, 0.004, 0.005, 0, 0.0002, 0}},
                        {1.5, {-0.03, -0.12, 0}, {0.02, 0.004, 0.019, 0, 0, 0}},
                        {0.9, {0, -0.1, 0.01}, {0.008, 0.002, 0.007, 0.0003, 0, 0}},
                        {1.3, {0.04, 0, 0.02}, {0.005, 0.006, 0.007, 0, 0, 0}},
                        {2.1, {0.01, -0.15, 0}, {0.03, 0.005, 0.031, 0, 0.001, 0}},
                        {0.8, {0, -0.07, 0.015}, {0.004, 0.001, 0.0045, 0, 0, 0}},
                        {0.6, {0.03, 0, 0}, {0.001, 0.002, 0.002, 0, 0, 0}},
                        {0.5, {0, -0.05, 0}, {0.001, 0.0005, 0.001, 0, 0, 0}}};

/* per body: com and turning rate, in the body's axes, by each coordinate */
static double jv[BODIES + 1][COORDINATES][3], jw[BODIES + 1][COORDINATES][3];

static void differentiate(const double *q) {
  const double h = 1e-30;
  for (int k = 0; k < COORDINATES; k++) {
    cx moved[COORDINATES];
    frame f[BODIES + 1];
    for (int i = 0; i < COORDINATES; i++) moved[i] = q[i] + (i == k ? I * h : 0.0);
    pose(moved, f);
    for (int b = 0; b <= BODIES; b++) {
      double spin[3][3]; /* R' dR */
      for (int i = 0; i < 3; i++) {
        cx place = f[b].p[i];
        for (int j = 0; j < 3; j++) place += f[b].r[i][j] * bodies[b].com[j];
        jv[b][k][i] = cimag(place) / h;
        for (int j = 0; j < 3; j++) {
          spin[i][j] = 0.0;
          for (int u = 0; u < 3; u++) spin[i][j] += creal(f[b].r[u][i]) * cimag(f[b].r[u][j]) / h;
        }
      }
      for (int i = 0; i < 3; i++) jw[b][k][i] = spin[(i + 2) % 3][(i + 1) % 3];
    }
  }
}

static double kinetic(int k, int l) {
  static const int entry[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  double sum = 0.0;
  for (int b = 0; b <= BODIES; b++) {
    for (int i = 0; i < 3; i++) {
      sum += bodies[b].mass * jv[b][k][i] * jv[b][l][i];
      for (int j = 0; j < 3; j++) sum += jw[b][k][i] * bodies[b].inertia[entry[i][j]] * jw[b][l][j];
    }
  }
  return sum;
}

static void compare_at(const ambulo_model *model, int seed) {
  double q[COORDINATES], ours[COORDINATES], zero[COORDINATES] = {0},
                                            mass[COORDINATES * COORDINATES];
  double tau[COORDINATES];
  int index[COORDINATES];
  ambulo_mechanics *mechanics = NULL;
  for (int i = 0; i < COORDINATES; i++) {
    q[i] = 0.8 * sin(1.7 * i + seed);
    index[i] = ambulo_model_find_coordinate(model, names[i]);
    if (index[i] < 0) print_error("no coordinate %s\n", names[i]);
    assert_true(index[i] >= 0);
    ours[index[i]] = q[i];
  }
  differentiate(q);
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  ambulo_jacobians jacobians = {.size = sizeof(ambulo_jacobians), .tau_qdd = mass};
  assert_int_equal(ambulo_mechanics_jacobians(mechanics, 1, ours, zero, zero, &jacobians),
                   AMBULO_OK);
  assert_int_equal(ambulo_mechanics_inverse_dynamics(
                       mechanics, 1, ours, zero, zero,
                       &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau}),
                   AMBULO_OK);
  for (int k = 0; k < COORDINATES; k++) {
    double weight = 0.0;
    for (int b = 0; b <= BODIES; b++) weight += bodies[b].mass * 9.80665 * jv[b][k][1];
    assert_close(tau[index[k]], weight, 1e-12);
    for (int l = 0; l < COORDINATES; l++)
      assert_close(mass[index[k] * COORDINATES + index[l]], kinetic(k, l), 1e-12);
  }
  ambulo_mechanics_free(mechanics);
}

static void as_defined(const char *path) {
  import_case c = import_file(path, NULL);
  assert_int_equal(c.status, AMBULO_OK);
  for (int seed = 0; seed < 4; seed++) compare_at(c.model, seed);
  static const double opensim[COORDINATES] = {
      27.2449203475878,   150.121651051138,   -6.38581752334863, -33.5965541283971,
      -0.98287858995573,  41.1399297687702,   36.8531914570125,  14.1683031765468,
      -0.071916152532161, 0.0105599679284223, 60.1001742303382,  -9.30217091750332,
      1.73058212786915,   -2.74031898675325,  0.10914646339516,  -1.9316065911607,
      -1.1786537481667,   0.018000465936255,  0.208939252878585, 4.74779577075262,
      8.59189840699998,   0.173672874955789};
  assert_torques(c.model, opensim, COORDINATES, 1e-12);
  import_shut(&c);
}

static void version_3(void **state) {
  (void)state;
  as_defined("tests/import/every_joint_v3.osim");
}

static void version_4(void **state) {
  (void)state;
  as_defined("tests/import/every_joint_v4.osim");
}

/* limits: of the file; torques of an actuator,
 * control times force; no muscle drives the six of the ground's joint */
static void limits(void **state) {
  (void)state;
  import_case c = import_file("tests/import/every_joint_v4.osim", NULL);
  const ambulo_coordinate *hip =
      ambulo_model_coordinate(c.model, ambulo_model_find_coordinate(c.model, "hip_turn"));
  const ambulo_coordinate *stretch =
      ambulo_model_coordinate(c.model, ambulo_model_find_coordinate(c.model, "stretch"));
  assert_close(hip->range[0], -0.5, 1e-8);
  assert_close(hip->range[1], 1.25, 1e-8);
  assert_close(hip->torque[0], -50, 0);
  assert_close(hip->torque[1], 100, 0);
  assert_int_equal(hip->actuated, 1);
  assert_close(stretch->range[1], 1.5, 1e-12);
  for (int i = 0; i < 6; i++) assert_int_equal(ambulo_model_coordinate(c.model, i)->actuated, 0);
  import_shut(&c);
}

/* what is not carried over is said, and stands in the file */
static void changes_are_named(void **state) {
  (void)state;
  static const char *const told[] = {
      "every_joint_v4.osim:319:13: warning: stretch is no axis' own angle or length: a link "
      "without "
      "mass has it",
      "lock_turn is locked in the source: it is held at 0.4 (--unlock: it moves)",
      "1 SpringGeneralizedForce (muscles and other forces) is left out"};
  import_case c = import_file("tests/import/every_joint_v4.osim", NULL);
  for (int i = 0; i < 3; i++) {
    assert_told(&c, told[i]);
    assert_non_null(
        strstr(c.text, strstr(told[i], "warning: ") ? strstr(told[i], "stretch") : told[i]));
  }
  import_shut(&c);
}

/* --unlock: a locked coordinate moves */
static void other_choices(void **state) {
  (void)state;
  ambulo_import_options options = ambulo_import_options_default();
  options.unlock = 1;
  import_case c = import_file("tests/import/every_joint_v4.osim", &options);
  assert_true(ambulo_model_find_coordinate(c.model, "lock_turn") >= 0);
  import_shut(&c);
}

/* What cannot follow is frozen, and said so: corners, high degrees, curves of curves; with --pose
 * it stands elsewhere. */
#define KNEE(function)                                                                             \
  "<OpenSimDocument Version='40000'><Model name='m'><BodySet><objects><Body name='a'><mass>1"      \
  "</mass><mass_center>0 0 0</mass_center><inertia>1 1 1 0 0 0</inertia></Body></objects>"         \
  "</BodySet><JointSet><objects><CustomJoint name='k'><socket_parent_frame>ground"                 \
  "</socket_parent_frame><socket_child_frame>a</socket_child_frame><coordinates><Coordinate "      \
  "name='q'><range>-1 1</range></Coordinate></coordinates><SpatialTransform>"                      \
  "<TransformAxis name='rotation1'><coordinates>q</coordinates><axis>1 0 0</axis><LinearFunction>" \
  "<coefficients>1 0</coefficients></LinearFunction></TransformAxis><TransformAxis "               \
  "name='translation2'><coordinates>q</coordinates><axis>0 1 0</axis>" function                    \
  "</TransformAxis></SpatialTransform></CustomJoint></objects></JointSet></Model>"                 \
  "</OpenSimDocument>"

static void what_cannot_follow(void **state) {
  ambulo_import_options options = ambulo_import_options_default();
  static const char *const pose[] = {"q=0.5"};
  options.pose = pose;
  options.pose_count = 1;
  import_case c = import_text(state,
                              KNEE("<PiecewiseLinearFunction><x>-1 0 1</x><y>0 0 0.1</y>"
                                   "</PiecewiseLinearFunction>"),
                              &options);
  assert_told(&c, "k: translation2 follows q by a PiecewiseLinearFunction: frozen at q = 0.5; over "
                  "its range it slides by up to 50 mm");
  import_shut(&c);
  c = import_good(state, KNEE("<PolynomialFunction><coefficients>1 0 0 0 0 0</coefficients>"
                              "</PolynomialFunction>"));
  assert_told(&c,
              "translation2 follows q by a PolynomialFunction: frozen at q = 0; over its range");
  import_shut(&c);
  c = import_good(state, KNEE("<PolynomialFunction><coefficients>1 0 0 0 0.25</coefficients>"
                              "</PolynomialFunction>"));
  assert_null(strstr(c.text, "frozen"));
  const ambulo_link *link = ambulo_model_link(c.model, 0);
  for (int i = 0; i < ambulo_model_link_count(c.model) && link->coupled_to < 0; i++)
    link = ambulo_model_link(c.model, i);
  assert_close(link->polynomial[0], 0.25, 1e-12);
  assert_close(link->polynomial[4], 1, 1e-12);
  import_shut(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(version_3),     cmocka_unit_test(version_4),
      cmocka_unit_test(limits),        cmocka_unit_test(changes_are_named),
      cmocka_unit_test(other_choices), cmocka_unit_test(what_cannot_follow)};
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
