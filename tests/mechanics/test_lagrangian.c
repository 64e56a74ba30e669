/* The reference recursion against laws it does not use: energy balance, symmetry and definiteness
 * of the mass matrix, a root joint that feels the root wrench, and forward dynamics undone. */
#include "mechanics/lagrangian.h"
#include "ambulo/mechanics.h"
#include "support/lagrangian_energy.h"
#include "support/random_model.h"
#include "support/test.h"

enum { max_d = 64, trees = 60 };

typedef struct rig {
  random_tree tree;
  ambulo_model *model;
  void *scratch;
  int d;
  random_source source;
} rig;

static void rig_build(rig *r) {
  assert_int_equal(ambulo_model_create(&r->tree.definition, NULL, NULL, &r->model), AMBULO_OK);
  r->d = ambulo_model_coordinate_count(r->model);
  r->scratch = malloc(ambulo__lagrangian_scratch_size(r->model));
  assert_non_null(r->scratch);
}

static void rig_open(rig *r, int number, int coordinates) {
  r->source.state = (uint64_t)number;
  random_tree_make(&r->tree, 31 * (uint64_t)number + 2, coordinates);
  if (number % 3 == 2) random_tree_couple(&r->tree, (uint64_t)number);
  rig_build(r);
}

static void rig_close(rig *r) {
  ambulo_model_free(r->model);
  free(r->scratch);
}

static void fill(rig *r, double *values, double size) {
  for (int i = 0; i < r->d; i++) values[i] = random_between(&r->source, -size, size);
}

static void inverse(rig *r, const double *q, const double *qd, const double *qdd, double *tau,
                    double *wrench) {
  assert_int_equal(
      ambulo__lagrangian(
          0, r->model, q, qd, qdd,
          &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau, .wrench = wrench},
          r->scratch),
      AMBULO_OK);
}

static double energy(rig *r, const double *q, const double *qd) {
  double kinetic = 0, potential = 0;
  lagrangian_energy(r->model, q, qd, &kinetic, &potential, r->scratch);
  return kinetic + potential;
}

/* dE/dt = qd . tau on the motion with constant acceleration through a state. */
static void power_changes_the_energy(void **state) {
  (void)state;
  static rig r;
  for (int number = 0; number < trees; number++) {
    double q[max_d], qd[max_d], qdd[max_d], tau[max_d], e[4], power = 0;
    static const double times[4] = {-2e-3, -1e-3, 1e-3, 2e-3};
    rig_open(&r, number, 1 + number % 20);
    fill(&r, q, 3);
    fill(&r, qd, 1);
    fill(&r, qdd, 2);
    inverse(&r, q, qd, qdd, tau, NULL);
    for (int i = 0; i < r.d; i++) power += qd[i] * tau[i];
    for (int k = 0; k < 4; k++) {
      double qt[max_d], qdt[max_d], t = times[k];
      for (int i = 0; i < r.d; i++) {
        qt[i] = q[i] + t * (qd[i] + 0.5 * t * qdd[i]);
        qdt[i] = qd[i] + t * qdd[i];
      }
      e[k] = energy(&r, qt, qdt);
    }
    double rate = (e[0] - 8 * e[1] + 8 * e[2] - e[3]) / 12e-3;
    double scale = fmax(fabs(power), fmax(1, fabs(e[0])));
    if (fabs(rate - power) > 1e-6 * scale) {
      print_error("tree %d: dE/dt = %.12g W, qd . tau = %.12g W\n", number, rate, power);
      fail();
    }
    rig_close(&r);
  }
}

/* A massless first joint about (along) a world axis transmits that part of M (F). */
static void root_joint_feels_the_wrench(void **state) {
  (void)state;
  static rig r;
  for (int number = 0; number < trees; number++) {
    random_tree_make(&r.tree, 53 * (uint64_t)number, 12);
    r.source.state = (uint64_t)number;
    ambulo_link *links = r.tree.links;
    double theta = random_between(&r.source, -3, 3);
    ambulo_link tilt = ambulo_link_default(), root = ambulo_link_default();
    for (int i = r.tree.definition.link_count - 1; i >= 0; i--) {
      links[i + 2] = links[i];
      links[i + 2].parent += 2;
    }
    tilt.name = "tilt";
    tilt.theta = theta;
    tilt.alpha = 0.5 * acos(-1);
    root.name = "root";
    root.parent = 0;
    root.type = number % 2 ? AMBULO_REVOLUTE : AMBULO_PRISMATIC;
    links[0] = tilt;
    links[1] = root;
    for (int i = 12; i > 0; i--) r.tree.coordinates[i] = r.tree.coordinates[i - 1];
    r.tree.coordinates[0] = ambulo_coordinate_default();
    r.tree.coordinates[0].name = "root";
    r.tree.coordinates[0].type = root.type;
    for (int i = 0; i < 13; i++) r.tree.coordinates[i].mirror = i;
    r.tree.definition.link_count += 2;
    r.tree.definition.coordinate_count++;
    for (int i = 0; i < r.tree.definition.point_count; i++) r.tree.points[i].link += 2;
    rig_build(&r);
    double q[max_d], qd[max_d], qdd[max_d], tau[max_d], wrench[6];
    fill(&r, q, 3);
    fill(&r, qd, 3);
    fill(&r, qdd, 9);
    inverse(&r, q, qd, qdd, tau, wrench);
    const double *part = root.type == AMBULO_REVOLUTE ? wrench : wrench + 3;
    double want = sin(theta) * part[0] - cos(theta) * part[1];
    assert_close(tau[0], want, 1e-11 * (1 + fabs(part[0]) + fabs(part[1])));
    rig_close(&r);
  }
}

/* mass[i][j] = tau_i(qdd = e_j) - tau_i(0) at qd = 0; bias = tau(qd, 0). */
static void mass_matrix(rig *r, const double *q, double mass[max_d][max_d]) {
  double zero[max_d] = {0}, unit[max_d] = {0}, rest[max_d], tau[max_d];
  inverse(r, q, zero, zero, rest, NULL);
  for (int j = 0; j < r->d; j++) {
    unit[j] = 1;
    inverse(r, q, zero, unit, tau, NULL);
    unit[j] = 0;
    for (int i = 0; i < r->d; i++) mass[i][j] = tau[i] - rest[i];
  }
}

/* Every link gets a body, so that every coordinate moves mass. */
static void rig_open_massive(rig *r, int number) {
  r->source.state = (uint64_t)number;
  random_tree_make(&r->tree, 31 * (uint64_t)number + 2, 1 + number % 12);
  for (int i = 0; i < r->tree.definition.link_count; i++) {
    if (r->tree.links[i].mass == 0) random_body(&r->source, &r->tree.links[i]);
  }
  if (number % 3 == 2) random_tree_couple(&r->tree, (uint64_t)number);
  rig_build(r);
}

/* Cholesky in place; 0 if not positive definite. */
static int factor(double m[max_d][max_d], int n) {
  for (int j = 0; j < n; j++) {
    for (int i = j; i < n; i++) {
      double sum = m[i][j];
      for (int k = 0; k < j; k++) sum -= m[i][k] * m[j][k];
      if (i == j && !(sum > 0)) return 0;
      m[i][j] = i == j ? sqrt(sum) : sum / m[j][j];
    }
  }
  return 1;
}

static void solve(double l[max_d][max_d], int n, double *x) {
  for (int i = 0; i < n; i++) {
    for (int k = 0; k < i; k++) x[i] -= l[i][k] * x[k];
    x[i] /= l[i][i];
  }
  for (int i = n - 1; i >= 0; i--) {
    for (int k = i + 1; k < n; k++) x[i] -= l[k][i] * x[k];
    x[i] /= l[i][i];
  }
}

static void mass_matrix_is_symmetric_and_positive(void **state) {
  (void)state;
  static rig r;
  static double mass[max_d][max_d];
  for (int number = 0; number < trees; number++) {
    double q[max_d], qd[max_d], twice = 0, kinetic = 0, potential = 0, scale = 0;
    rig_open_massive(&r, number);
    fill(&r, q, 3);
    fill(&r, qd, 1);
    mass_matrix(&r, q, mass);
    for (int i = 0; i < r.d; i++) scale = fmax(scale, mass[i][i]);
    for (int i = 0; i < r.d; i++) {
      for (int j = 0; j < r.d; j++) {
        twice += qd[i] * mass[i][j] * qd[j];
        assert_true(fabs(mass[i][j] - mass[j][i]) <= 1e-11 * scale);
      }
    }
    lagrangian_energy(r.model, q, qd, &kinetic, &potential, r.scratch);
    assert_close(twice / kinetic, 2, 1e-10);
    assert_true(factor(mass, r.d));
    rig_close(&r);
  }
}

/* qdd = M^-1 (tau - bias), fed back, asks for tau again. */
static void forward_dynamics_is_undone(void **state) {
  (void)state;
  static rig r;
  static double mass[max_d][max_d];
  for (int number = 0; number < trees; number++) {
    double q[max_d], qd[max_d], zero[max_d] = {0}, qdd[max_d], bias[max_d], tau[max_d], got[max_d];
    double scale = 1;
    rig_open_massive(&r, number);
    fill(&r, q, 3);
    fill(&r, qd, 2);
    fill(&r, tau, 100);
    inverse(&r, q, qd, zero, bias, NULL);
    mass_matrix(&r, q, mass);
    assert_true(factor(mass, r.d));
    for (int i = 0; i < r.d; i++) qdd[i] = tau[i] - bias[i];
    solve(mass, r.d, qdd);
    inverse(&r, q, qd, qdd, got, NULL);
    for (int i = 0; i < r.d; i++) scale = fmax(scale, fabs(bias[i]));
    for (int i = 0; i < r.d; i++) assert_close(got[i] / scale, tau[i] / scale, 1e-8);
    rig_close(&r);
  }
}

static void complex_form_extends_the_real_one(void **state) {
  (void)state;
  static rig r;
  rig_open(&r, 5, 17);
  double x[3 * max_d], z[6 * max_d], tau[max_d], complex_tau[2 * max_d], wrench[6], pairs[12];
  for (int i = 0; i < 3 * r.d; i++) {
    x[i] = random_between(&r.source, -2, 2);
    z[2 * i] = x[i];
    z[2 * i + 1] = 0;
  }
  inverse(&r, x, x + r.d, x + 2 * r.d, tau, wrench);
  assert_int_equal(
      ambulo__lagrangian(
          1, r.model, z, z + 2 * r.d, z + 4 * r.d,
          &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = complex_tau, .wrench = pairs},
          r.scratch),
      AMBULO_OK);
  for (int i = 0; i < r.d; i++) {
    assert_close(complex_tau[2 * i], tau[i], 0);
    assert_close(complex_tau[2 * i + 1], 0, 0);
  }
  for (int i = 0; i < 6; i++) assert_close(pairs[2 * i], wrench[i], 0);
  rig_close(&r);
}

static void refuses_without_touching(void **state) {
  (void)state;
  static rig r;
  rig_open(&r, 3, 4);
  double q[4] = {0}, bad[4] = {0, NAN, 0, 0}, tau[4] = {7, 7, 7, 7};
  const ambulo_model *m = r.model;
  assert_int_equal(ambulo__lagrangian(0, m, q, bad, q,
                                      &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau},
                                      r.scratch),
                   AMBULO_E_NUMERIC);
  assert_int_equal(ambulo__lagrangian(0, m, NULL, q, q,
                                      &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau},
                                      r.scratch),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo__lagrangian(0, NULL, q, q, q,
                                      &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau},
                                      r.scratch),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo__lagrangian(0, m, q, q, q,
                                      &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau},
                                      NULL),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo__lagrangian_scratch_size(NULL), 0);
  for (int i = 0; i < 4; i++) assert_true(tau[i] == 7);
  rig_close(&r);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(power_changes_the_energy),
                                     cmocka_unit_test(root_joint_feels_the_wrench),
                                     cmocka_unit_test(mass_matrix_is_symmetric_and_positive),
                                     cmocka_unit_test(forward_dynamics_is_undone),
                                     cmocka_unit_test(complex_form_extends_the_real_one),
                                     cmocka_unit_test(refuses_without_touching)};
  return cmocka_run_group_tests_name("mechanics/lagrangian", tests, NULL, NULL);
}
