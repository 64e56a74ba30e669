#include "support/model_text.h"

#define ROD "links:\n  - {name: rod, parent: none, joint: revolute, dh: [0, 0, 1, 0],\n     "

/* radii of gyration and moments say the same */
static void gyration_and_inertia(void **state) {
  (void)state;
  model_case a =
      model_good(MODEL_HEAD ROD "body: {mass: 2, com: [1, 2, 3], gyration: [0.3, 0.4, 0.35]}}\n");
  model_case b = model_good(MODEL_HEAD ROD "body: {mass: 2, com: [1, 2, 3], inertia: [0.18, 0.32, "
                                           "0.245, 0.01, -0.02, 0.03]}}\n");
  const ambulo_link *x = ambulo_model_link(a.model, 0), *y = ambulo_model_link(b.model, 0);
  static const double want[6] = {0.18, 0.32, 0.245, 0.01, -0.02, 0.03};
  for (int i = 0; i < 6; i++) {
    assert_close(x->inertia[i], i < 3 ? want[i] : 0, 1e-15);
    assert_close(y->inertia[i], want[i], 0);
  }
  assert_close(x->mass, 2, 0);
  assert_close(x->com[2], 3, 0);
  model_shut(&a);
  model_shut(&b);
}

static void several_bodies(void **state) {
  (void)state;
  model_case c = model_good(MODEL_HEAD ROD
                            "bodies: [{name: left, mass: 1, com: [-1, 0, 0], gyration: [0, 0, 0]},"
                            " {mass: 3, com: [1, 0, 0], gyration: [0, 0, 0]}]}\n");
  const ambulo_link *link = ambulo_model_link(c.model, 0);
  assert_close(link->mass, 4, 0);
  assert_close(link->com[0], 0.5, 1e-15);
  assert_close(link->inertia[0], 0, 1e-15);
  assert_close(link->inertia[1], 3, 1e-15); /* 1 * 3 / 4 * 2^2 */
  assert_close(link->inertia[2], 3, 1e-15);
  model_shut(&c);
}

static void faults(void **state) {
  (void)state;
  model_bad(MODEL_HEAD ROD "body: {mass: 0, com: [0, 0, 0], gyration: [1, 1, 1]}}\n",
            AMBULO_E_MODEL,
            "t.yaml:6:19: error[E_MODEL]: mass of 'rod' is out of range (got 0 kg)");
  model_bad(MODEL_HEAD ROD "body: {mass: -1, com: [0, 0, 0], gyration: [1, 1, 1]}}\n",
            AMBULO_E_MODEL,
            "t.yaml:6:19: error[E_MODEL]: mass of 'rod' is out of range (got -1 kg)");
  model_bad(MODEL_HEAD ROD "body: {mass: 1, com: [0, 0, 0], inertia: [1, 1, 3, 0, 0, 0]}}\n",
            AMBULO_E_MODEL,
            "t.yaml:6:47: error[E_MODEL]: inertia of 'rod' breaks the triangle inequality "
            "(principal moments 1, 1, 3 kg m^2)");
  model_bad(MODEL_HEAD ROD "bodies: [{name: skull, mass: 1, com: [0, 0, 0], inertia: [1, 1, 1, 4, "
                           "0, 0]}]}\n",
            AMBULO_E_MODEL,
            "t.yaml:6:63: error[E_MODEL]: inertia of 'skull' is not positive semidefinite "
            "(smallest eigenvalue -3 kg m^2)");
  model_bad(MODEL_HEAD ROD "body: {mass: 1, com: [0, 0, 0]}}\n", AMBULO_E_SCHEMA,
            "t.yaml:6:12: error[E_SCHEMA]: a body has no inertia; expected one of `inertia` and "
            "`gyration`");
  model_bad(MODEL_HEAD ROD "body: {mass: 1, com: [0, 0, 0], gyration: [1, 1, 1], inertia: [1, 1, "
                           "1, 0, 0, 0]}}\n",
            AMBULO_E_SCHEMA, "t.yaml:6:12: error[E_SCHEMA]: a body has both");
  model_bad(MODEL_HEAD ROD "body: {mas: 1, mass: 1, com: [0, 0, 0], gyration: [1, 1, 1]}}\n",
            AMBULO_E_SCHEMA, "t.yaml:6:13: error[E_SCHEMA]: unknown key 'mas'");
  model_bad(MODEL_HEAD ROD "body: {com: [0, 0, 0], gyration: [1, 1, 1]}}\n", AMBULO_E_SCHEMA,
            "t.yaml:6:12: error[E_SCHEMA]: missing required key 'mass'");
  model_bad(MODEL_HEAD ROD "body: {mass: 1, com: [0, 0], gyration: [1, 1, 1]}}\n", AMBULO_E_SCHEMA,
            "t.yaml:6:27: error[E_SCHEMA]: got a sequence of 2; expected a sequence of 3 numbers");
  model_bad(MODEL_HEAD ROD MODEL_BODY ", bodies: []}\n", AMBULO_E_SCHEMA,
            "t.yaml:6:74: error[E_SCHEMA]: link 'rod' has `body` and `bodies`");
  model_bad(MODEL_HEAD ROD "bodies: 3}\n", AMBULO_E_SCHEMA,
            "t.yaml:6:14: error[E_SCHEMA]: `bodies` is not a list");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(gyration_and_inertia),
                                     cmocka_unit_test(several_bodies), cmocka_unit_test(faults)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
