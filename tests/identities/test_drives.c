/* What drives add, by the public interface, on random trees with and without them: the power that a
 * torque gives is the change of energy, rotors and all, and what damping and friction take; the
 * mass matrix has the rotors on its diagonal, and the wrench knows nothing of them. */
#include "support/lagrangian_energy.h"
#include "support/random_model.h"
#include "support/test.h"

#include "ambulo/mechanics.h"

enum { TREES = 40, MOST = 40 };

typedef struct pair {
  random_tree tree;
  ambulo_model *bare, *driven;
  int d;
} pair;

static void open_pair(pair *p, int number) {
  random_tree_make(&p->tree, 13 * (uint64_t)number + 1, 1 + number % 20);
  if (number % 2) (void)random_tree_put_on_root(&p->tree, (uint64_t)number);
  assert_int_equal(ambulo_model_create(&p->tree.definition, NULL, NULL, &p->bare), AMBULO_OK);
  random_tree_drive(&p->tree, (uint64_t)number + 7);
  assert_int_equal(ambulo_model_create(&p->tree.definition, NULL, NULL, &p->driven), AMBULO_OK);
  p->d = ambulo_model_coordinate_count(p->driven);
  assert_in_range(p->d, 1, MOST);
}

static void shut_pair(pair *p) {
  ambulo_model_free(p->bare);
  ambulo_model_free(p->driven);
}

static void fill(double *state, int count, uint64_t seed, double size) {
  random_source source = {seed};
  for (int i = 0; i < count; i++) state[i] = random_between(&source, -size, size);
}

/* of a motion q + qd t + qdd t^2 / 2, kinetic and potential energy and that of the rotors */
static double energy(const pair *p, const double *q, const double *qd, const double *qdd, double t,
                     void *scratch) {
  double at[MOST], rate[MOST], kinetic, potential, rotors = 0.0;
  for (int i = 0; i < p->d; i++) {
    double armature = ambulo_model_coordinate(p->driven, i)->armature;
    at[i] = q[i] + t * (qd[i] + 0.5 * t * qdd[i]);
    rate[i] = qd[i] + t * qdd[i];
    rotors += 0.5 * armature * rate[i] * rate[i];
  }
  lagrangian_energy(p->driven, at, rate, &kinetic, &potential, scratch);
  return kinetic + potential + rotors;
}

static double speed_of(const ambulo_coordinate *c) {
  return c->type == AMBULO_REVOLUTE ? 0.1 : 0.01;
}

/* sum tau qd = d/dt (T + V + sum a qd^2 / 2) + sum b qd^2 + c |qd| / sqrt(1 + (v / qd)^2) */
static void power_is_energy_and_losses(void **state) {
  (void)state;
  static pair p;
  for (int number = 0; number < TREES; number++) {
    const double step = 1e-4;
    double q[MOST], qd[MOST], qdd[MOST], tau[MOST], power = 0.0, losses = 0.0, size = 1.0;
    open_pair(&p, number);
    fill(q, p.d, 100 + (uint64_t)number, 1.0);
    fill(qd, p.d, 200 + (uint64_t)number, 1.0);
    fill(qdd, p.d, 300 + (uint64_t)number, 2.0);
    void *scratch = malloc(ambulo__lagrangian_scratch_size(p.driven));
    ambulo_mechanics *mechanics = NULL;
    assert_int_equal(ambulo_mechanics_create(p.driven, NULL, &mechanics), AMBULO_OK);
    assert_int_equal(ambulo_mechanics_inverse_dynamics(
                         mechanics, 1, q, qd, qdd,
                         &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau}),
                     AMBULO_OK);
    for (int i = 0; i < p.d; i++) {
      const ambulo_coordinate *c = ambulo_model_coordinate(p.driven, i);
      double v = speed_of(c) / qd[i];
      power += tau[i] * qd[i];
      size += fabs(tau[i] * qd[i]);
      losses += c->damping * qd[i] * qd[i] + c->friction * fabs(qd[i]) / sqrt(1.0 + v * v);
    }
    double e[4];
    for (int k = 0; k < 4; k++)
      e[k] = energy(&p, q, qd, qdd, step * (k < 2 ? k - 2 : k - 1), scratch);
    double change = (e[0] - 8.0 * e[1] + 8.0 * e[2] - e[3]) / (12.0 * step);
    assert_close(power, change + losses, 1e-8 * size);
    ambulo_mechanics_free(mechanics);
    free(scratch);
    shut_pair(&p);
  }
}

typedef struct slopes {
  double tau_q[MOST * MOST], tau_qd[MOST * MOST], mass[MOST * MOST], wrench[6 * MOST], root[6];
} slopes;

static void slopes_of(const ambulo_model *model, const double *q, const double *qd,
                      const double *qdd, slopes *s) {
  ambulo_mechanics *mechanics = NULL;
  const ambulo_jacobians to = {.size = sizeof to,
                               .tau_q = s->tau_q,
                               .tau_qd = s->tau_qd,
                               .tau_qdd = s->mass,
                               .wrench_qdd = s->wrench};
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  /* twice: entries that others leave alone do not pile up */
  for (int run = 0; run < 2; run++)
    assert_int_equal(ambulo_mechanics_jacobians(mechanics, 1, q, qd, qdd, &to), AMBULO_OK);
  assert_int_equal(ambulo_mechanics_inverse_dynamics(
                       mechanics, 1, q, qd, qdd,
                       &(ambulo_outputs){.size = sizeof(ambulo_outputs), .wrench = s->root}),
                   AMBULO_OK);
  ambulo_mechanics_free(mechanics);
}

static void expect_diagonal(const double *driven, const double *bare, const double *added, int d) {
  double size = 1.0;
  for (int i = 0; i < d * d; i++) size = fmax(size, fabs(bare[i]));
  for (int i = 0; i < d; i++)
    for (int k = 0; k < d; k++)
      assert_close(driven[i * d + k] - bare[i * d + k], i == k ? added[i] : 0.0, 1e-12 * size);
}

static void rotors_are_on_the_diagonal(void **state) {
  (void)state;
  static pair p;
  static slopes bare, driven;
  for (int number = 0; number < TREES; number++) {
    double q[MOST], qd[MOST], qdd[MOST], nothing[MOST] = {0.0}, armature[MOST], damping[MOST];
    open_pair(&p, number);
    fill(q, p.d, 400 + (uint64_t)number, 1.0);
    fill(qd, p.d, 500 + (uint64_t)number, 0.2);
    fill(qdd, p.d, 600 + (uint64_t)number, 2.0);
    slopes_of(p.bare, q, qd, qdd, &bare);
    slopes_of(p.driven, q, qd, qdd, &driven);
    for (int i = 0; i < p.d; i++) {
      const ambulo_coordinate *c = ambulo_model_coordinate(p.driven, i);
      double v = speed_of(c);
      armature[i] = c->armature;
      damping[i] = c->damping + c->friction * v * v / pow(qd[i] * qd[i] + v * v, 1.5);
    }
    expect_diagonal(driven.mass, bare.mass, armature, p.d);
    expect_diagonal(driven.tau_qd, bare.tau_qd, damping, p.d);
    expect_diagonal(driven.tau_q, bare.tau_q, nothing, p.d);
    for (int i = 0; i < 6; i++) assert_close(driven.root[i], bare.root[i], 0.0);
    for (int i = 0; i < 6 * p.d; i++) assert_close(driven.wrench[i], bare.wrench[i], 0.0);
    shut_pair(&p);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(power_is_energy_and_losses),
                                     cmocka_unit_test(rotors_are_on_the_diagonal)};
  return cmocka_run_group_tests_name("identities/drives", tests, NULL, NULL);
}
