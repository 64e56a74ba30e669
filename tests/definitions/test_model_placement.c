/* Links with an origin and an axis: the same body as with DH rows, names and places of messages,
 * and what is refused. */
#include "ambulo/mechanics.h"
#include "support/model_text.h"

#include "model/model.h"

/* a thigh on a ball joint and a shank on an oblique hinge, by hand */
#define BY_HAND                                                                                    \
  "links:\n"                                                                                       \
  "  - {name: hips, parent: none, joint: prismatic, dh: [0, 0, 0, 0]}\n"                           \
  "  - {name: a, parent: hips, joint: fixed, dh: [30, 0.2, 0.1, 0]}\n"                             \
  "  - {name: b, parent: a, joint: fixed, dh: [0, 0, 0, 40]}\n"                                    \
  "  - {name: thigh, parent: b, joint: revolute, dh: [0, 0, 0, 0],\n"                              \
  "     body: {mass: 2, com: [0.1, 0.2, 0.3], inertia: [0.1, 0.2, 0.15, 0.01, 0, 0]}}\n"
#define BY_ORIGIN                                                                                  \
  "links:\n"                                                                                       \
  "  - {name: hips, parent: none, joint: prismatic, origin: {}, axis: [0, 0, 1]}\n"                \
  "  - {name: thigh, parent: hips, joint: revolute,\n"                                             \
  "     origin: {xyz: [0.0866025403784438647, 0.05, 0.2], rpy: [40, 0, 30]}, axis: [0, 0, 2],\n"   \
  "     body: {mass: 2, com: [0.1, 0.2, 0.3], inertia: [0.1, 0.2, 0.15, 0.01, 0, 0]}}\n"
#define POINTS "points:\n  - {name: p, link: thigh, position: [0.3, -0.1, 0.2]}\n"

static void the_same_body(void **state) {
  (void)state;
  model_case c[2] = {model_good(MODEL_HEAD BY_HAND POINTS),
                     model_good(MODEL_HEAD BY_ORIGIN POINTS)};
  const double q[2] = {0.3, -0.7}, qd[2] = {1, 2}, qdd[2] = {-3, 0.5};
  double tau[2][2], point[2][3];
  for (int i = 0; i < 2; i++) {
    ambulo_mechanics *m = NULL;
    assert_int_equal(ambulo_mechanics_create(c[i].model, NULL, &m), AMBULO_OK);
    assert_int_equal(
        ambulo_mechanics_inverse_dynamics(
            m, 1, q, qd, qdd,
            &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau[i], .points = point[i]}),
        AMBULO_OK);
    ambulo_mechanics_free(m);
  }
  for (int k = 0; k < 2; k++) assert_close(tau[1][k], tau[0][k], 1e-14);
  for (int k = 0; k < 3; k++) assert_close(point[1][k], point[0][k], 1e-14);
  model_shut(&c[0]);
  model_shut(&c[1]);
}

/* the last row has the link's name and frame, rows before it names of their own; a coordinate is
 * known by the link of the file, also in a copy of the model */
static void names(void **state) {
  (void)state;
  model_case c = model_good(
      MODEL_HEAD
      "links:\n"
      "  - {name: knee, parent: none, joint: revolute, origin: {xyz: [1, 0, 0]}, axis: [1, 2, "
      "3], " MODEL_BODY ",\n     coordinate: {name: bend, range: [0, 90]}}\n"
      "  - {name: foot, parent: knee, joint: fixed, origin: {xyz: [0, 0, 1]}, " MODEL_BODY "}\n");
  int knee = ambulo_model_find_link(c.model, "knee"),
      joint = ambulo_model_find_link(c.model, "knee.joint");
  assert_true(ambulo_model_find_link(c.model, "knee.place") >= 0 && joint >= 0);
  assert_int_equal(c.model->coordinate_link[0], joint);
  assert_int_equal(c.model->coordinate_written[0], knee);
  assert_int_equal(ambulo_model_link(c.model, ambulo_model_find_link(c.model, "foot"))->parent,
                   knee);
  assert_close(ambulo_model_link(c.model, knee)->mass, 2, 0);
  assert_int_equal(ambulo_model_find_coordinate(c.model, "bend"), 0);
  ambulo_model *copy = NULL;
  ambulo_conditions none = ambulo_conditions_default();
  assert_int_equal(ambulo_model_adapt(c.model, &none, NULL, NULL, &copy), AMBULO_OK);
  assert_int_equal(copy->coordinate_written[0], knee);
  ambulo_model_free(copy);
  model_shut(&c);
}

/* a name of 64 letters leaves no room: rows are numbered */
static void long_names(void **state) {
  (void)state;
#define LONG "a123456789b123456789c123456789d123456789e123456789f123456789g123"
  model_case c =
      model_good(MODEL_HEAD "links:\n  - {name: " LONG ", parent: none, joint: revolute, origin: "
                            "{xyz: [1, 0, 0]}, axis: [1, 2, 3], " MODEL_BODY "}\n");
  assert_true(ambulo_model_find_link(c.model, "link1.joint") >= 0);
  assert_string_equal(ambulo_model_coordinate(c.model, 0)->name, LONG);
  model_shut(&c);
}

/* lengths scale, angles have the unit of dh_angle, numbers may differ by sex */
static void units(void **state) {
  (void)state;
  model_case c = model_good(
      "ambulo: 1\nname: t\nsubject: {stature: 2, sex: female}\n"
      "units: {angle: degrees, dh_angle: radians, length: stature}\nlinks:\n"
      "  - {name: a, parent: none, joint: revolute, axis: [0, 0, 1],\n"
      "     origin: {xyz: {male: [0, 0, 1], female: [0, 0, 0.5]}, rpy: [0, 0, 0.5]}, " MODEL_BODY
      "}\n");
  assert_close(ambulo_model_link(c.model, 0)->d, 1, 1e-15);
  assert_close(ambulo_model_link(c.model, 1)->theta, 0.5, 1e-15);
  model_shut(&c);
}

#define ONE(more) MODEL_HEAD "links:\n  - {name: a, parent: none, " MODEL_BODY ",\n     " more "}\n"

static void what_is_refused(void **state) {
  (void)state;
  model_bad(
      ONE("joint: revolute"), AMBULO_E_SCHEMA,
      "t.yaml:5:5: error[E_SCHEMA]: link 'a' has no place; expected `dh`, or `origin` and `axis`");
  model_bad(ONE("joint: revolute, dh: [0, 0, 0, 0], axis: [0, 0, 1]"), AMBULO_E_SCHEMA,
            "t.yaml:6:47: error[E_SCHEMA]: link 'a' has `dh` and `axis`; expected one of `dh` and "
            "`origin`");
  model_bad(ONE("joint: revolute, origin: {}"), AMBULO_E_SCHEMA,
            "t.yaml:5:5: error[E_SCHEMA]: joint 'a' has an origin but no axis");
  model_bad(ONE("joint: revolute, axis: [0, 0, 0]"), AMBULO_E_MODEL,
            "t.yaml:6:29: error[E_MODEL]: the axis of link 'a' has no direction (got [0, 0, 0])");
  model_bad(ONE("joint: revolute, axis: [0, 0]"), AMBULO_E_SCHEMA, "t.yaml:6:29: error[E_SCHEMA]");
  model_bad(ONE("joint: revolute, axis: [0, 0, 1], origin: {xyz: [1, 2]}"), AMBULO_E_SCHEMA,
            "t.yaml:6:54: error[E_SCHEMA]");
  model_bad(ONE("joint: revolute, axis: [0, 0, 1], origin: {rpy: [1, 2]}"), AMBULO_E_SCHEMA,
            "t.yaml:6:54: error[E_SCHEMA]");
  model_bad(ONE("joint: revolute, axis: [0, 0, 1], origin: {rpx: [1, 2, 3]}"), AMBULO_E_SCHEMA,
            "t.yaml:6:49: error[E_SCHEMA]: unknown key 'rpx'");
}

static void a_fixed_link_has_no_axis(void **state) {
  (void)state;
  model_bad(MODEL_HEAD "links:\n  - {name: a, parent: none, joint: fixed, axis: [0, 0, 1]}\n"
                       "  - {name: b, parent: a, joint: revolute, axis: [0, 0, 1], " MODEL_BODY
                       "}\n",
            AMBULO_E_SCHEMA, "t.yaml:5:49: error[E_SCHEMA]: link 'a' is fixed; expected no axis");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_same_body),   cmocka_unit_test(names),
      cmocka_unit_test(long_names),      cmocka_unit_test(units),
      cmocka_unit_test(what_is_refused), cmocka_unit_test(a_fixed_link_has_no_axis)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
