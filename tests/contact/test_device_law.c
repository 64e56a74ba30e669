/* Efforts against the same laws in complex numbers, and their derivatives by everything. */
#include "device_fixture.h"

enum { laws = 400 };
static const double h = 1e-7;

static double effort_with(const ambulo_device *v, double s, double sd, double f) {
  return ambulo__effort_of(v, s, sd, f).value;
}

static void check_members(const ambulo_device *given, double s, double sd, double f) {
  ambulo__effort e = ambulo__effort_of(given, s, sd, f);
  ambulo_device v = *given;
#define BY(name)                                                                                   \
  do {                                                                                             \
    double *at = &v.name, kept = v.name;                                                           \
    v.name = kept + h;                                                                             \
    double up = effort_with(&v, s, sd, f);                                                         \
    v.name = kept - h;                                                                             \
    double difference = (up - effort_with(&v, s, sd, f)) / (2.0 * h);                              \
    *at = kept;                                                                                    \
    assert_close(e.by_##name, difference, 2e-5);                                                   \
  } while (0)
  if (v.kind == AMBULO_DEVICE_SPRING) {
    BY(stiffness);
    BY(rest);
    BY(pretension);
    if (v.side != AMBULO_DEVICE_BOTH) BY(smoothing);
  }
  if (v.kind == AMBULO_DEVICE_DAMPER) BY(damping);
  if (v.kind == AMBULO_DEVICE_ACTUATOR) BY(amount);
#undef BY
}

static void test_laws_and_their_derivatives(void **state) {
  (void)state;
  random_source source = {5};
  random_tree tree;
  ambulo_model *model = NULL;
  random_tree_make(&tree, 8, 6);
  assert_int_equal(ambulo_model_create(&tree.definition, NULL, NULL, &model), AMBULO_OK);
  for (int i = 0; i < laws; i++) {
    ambulo_device v;
    random_device(&source, model, &v);
    v.smoothing = random_between(&source, 0.2, 2);
    double s = random_between(&source, -0.5, 1.5), sd = random_between(&source, -3, 3);
    double f = random_between(&source, 0, 1);
    number energy;
    ambulo__effort e = ambulo__effort_of(&v, s, sd, f);
    assert_close(e.value, creal(reference_effort(&v, s, sd, f, &energy)), 1e-14);
    assert_close(e.by_along, cimag(reference_effort(&v, s + 1e-40 * I, sd, f, &energy)) / 1e-40,
                 1e-13);
    assert_close(e.by_rate, cimag(reference_effort(&v, s, sd + 1e-40 * I, f, &energy)) / 1e-40,
                 1e-13);
    assert_close(e.by_factor * f, e.value, 1e-13);
    check_members(&v, s, sd, f);
  }
  ambulo_model_free(model);
}

/* nothing below, the plain spring above, and no kink between */
static void test_one_side(void **state) {
  (void)state;
  ambulo_device v = ambulo_device_default(AMBULO_DEVICE_SPRING);
  v.coordinate = 0;
  v.stiffness = 200;
  v.rest = 0.1;
  v.side = AMBULO_DEVICE_ABOVE;
  v.smoothing = 0.04;
  assert_true(effort_with(&v, 0.1 - 0.0200001, 0, 1) == 0.0);
  assert_close(effort_with(&v, 0.35, 0, 1), -200 * 0.25, 1e-15);
  assert_close(effort_with(&v, 0.12, 0, 1), -200 * 0.02, 1e-14);
  for (int end = 0; end < 2; end++) {
    double s = end ? 0.12 : 0.08;
    ambulo__effort in = ambulo__effort_of(&v, s + (end ? -1e-9 : 1e-9), 0, 1);
    ambulo__effort out = ambulo__effort_of(&v, s + (end ? 1e-9 : -1e-9), 0, 1);
    assert_close(in.by_along / 200, out.by_along / 200, 1e-9);
  }
  ambulo_device below = v;
  below.side = AMBULO_DEVICE_BELOW;
  for (double s = -0.2; s < 0.5; s += 0.013) {
    double both = effort_with(&v, s, 0, 1) + effort_with(&below, s, 0, 1);
    double mirrored = effort_with(&below, 0.2 - s, 0, 1);
    assert_close(mirrored, -effort_with(&v, s, 0, 1), 1e-12);
    assert_close(both, -200 * (s - 0.1), 1e-12);
  }
}

/* Everything at stiffness 0 is what it tends to: where the pull is straight in the stiffness, its
 * difference from there. */
static void test_no_stiffness(void **state) {
  (void)state;
  const double k = 1e-6, f = 0.7;
  for (int i = 0; i < 2 * 3 * 3 * 9; i++) {
    ambulo_device v = ambulo_device_default(AMBULO_DEVICE_SPRING);
    v.coordinate = i % 2 ? 3 : -1;
    v.side = (ambulo_device_side)(1 + i / 2 % 3);
    v.pretension = 8.0 * (i / 6 % 3 - 1);
    v.rest = 0.3;
    v.smoothing = 0.2;
    double s = 0.3 + 0.04 * (i / 18 - 4), g = v.coordinate >= 0 ? 1 : -1;
    ambulo__effort none = ambulo__effort_of(&v, s, 0, f);
    int pulls = v.side == AMBULO_DEVICE_BOTH ||
                (v.side == AMBULO_DEVICE_ABOVE ? v.pretension > 0 : v.pretension < 0);
    assert_close(none.value, pulls ? -g * f * v.pretension : 0.0, 1e-15);
    assert_true(none.by_along == 0.0 && none.by_rest == 0.0 && none.by_smoothing == 0.0);
    assert_close(none.by_factor * f, none.value, 1e-15);
    if (v.pretension != 0) assert_close(none.by_pretension, pulls ? -g * f : 0.0, 1e-15);
    v.stiffness = k;
    ambulo__effort some = ambulo__effort_of(&v, s, 0, f);
    assert_close(none.by_stiffness, (some.value - none.value) / k, 1e-8);
    assert_close(none.by_stiffness, some.by_stiffness, 1e-12);
    assert_close(none.by_pretension, some.by_pretension, 1e-12);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_laws_and_their_derivatives),
                                     cmocka_unit_test(test_one_side),
                                     cmocka_unit_test(test_no_stiffness)};
  return cmocka_run_group_tests_name("device/law", tests, NULL, NULL);
}
