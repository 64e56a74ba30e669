#include "support/model_text.h"

#define ROOT                                                                                       \
  "links:\n"                                                                                       \
  "  - {name: base, parent: none, joint: fixed, dh: [90, 1, 2, -90]}\n"
#define LINK(name, parent, more)                                                                   \
  "  - {name: " name ", parent: " parent ", joint: revolute, dh: [0, 0, 0, 0], " MODEL_BODY more   \
  "}\n"

static void what_is_read(void **state) {
  (void)state;
  model_case c = model_good(MODEL_HEAD ROOT LINK("hip", "base",
                                                 ",\n     coordinate: {name: q, range: [-30, none],"
                                                 " speed: [-90, 180], torque: [none, 20],"
                                                 " actuated: false, mirror_sign: -1}")
                                LINK("knee", "hip", ""));
  const ambulo_link *base = ambulo_model_link(c.model, 0);
  const ambulo_coordinate *q = ambulo_model_coordinate(c.model, 0);
  double pi = acos(-1);
  assert_close(base->theta, pi / 2, 1e-15);
  assert_close(base->d, 1, 0);
  assert_close(base->a, 2, 0);
  assert_close(base->alpha, -pi / 2, 1e-15);
  assert_int_equal(base->parent, -1);
  assert_int_equal(base->coordinate, -1);
  assert_int_equal(ambulo_model_link(c.model, 2)->parent, 1);
  assert_string_equal(q->name, "q");
  assert_close(q->range[0], -pi / 6, 1e-15);
  assert_true(isinf(q->range[1]) && q->range[1] > 0);
  assert_close(q->speed[1], pi, 1e-15);
  assert_true(isinf(q->torque[0]) && q->torque[0] < 0);
  assert_close(q->torque[1], 20, 0);
  assert_int_equal(q->actuated, 0);
  assert_close(q->mirror_sign, -1, 0);
  assert_string_equal(ambulo_model_coordinate(c.model, 1)->name, "knee");
  assert_int_equal(ambulo_model_coordinate(c.model, 1)->actuated, 1);
  model_shut(&c);
}

/* rotors by the units of bodies, the rest by those of torques; of sliders too */
static void drives(void **state) {
  (void)state;
  static const char *const units[] = {
      "angle: degrees", "angle: degrees, length: stature, mass: body_mass, torque: weight_stature"};
  for (int shares = 0; shares < 2; shares++) {
    const double m = shares ? 70 : 1, h = shares ? 1.75 : 1, f = shares ? m * 9.81 : 1;
    char text[900];
    (void)snprintf(text, sizeof text,
                   "ambulo: 1\nname: t\nunits: {%s}\nsubject: {mass: 70, stature: 1.75}\n"
                   "links:\n"
                   "  - {name: a, parent: none, joint: revolute, dh: [0, 0, 0, 0], " MODEL_BODY
                   ",\n"
                   "     coordinate: {armature: 0.5, damping: 0.25, friction: 2}}\n"
                   "  - {name: b, parent: a, joint: prismatic, dh: [0, 0, 0, 0], " MODEL_BODY ",\n"
                   "     coordinate: {armature: 3, damping: 4, friction: 5}}\n"
                   "  - {name: c, parent: b, joint: revolute, dh: [0, 0, 0, 0], " MODEL_BODY "}\n",
                   units[shares]);
    model_case c = model_good(text);
    const ambulo_coordinate *a = ambulo_model_coordinate(c.model, 0);
    const ambulo_coordinate *b = ambulo_model_coordinate(c.model, 1);
    assert_close(a->armature, 0.5 * m * h * h, 1e-12);
    assert_close(a->damping, 0.25 * f * h, 1e-12);
    assert_close(a->friction, 2 * f * h, 1e-12);
    assert_close(b->armature, 3 * m, 1e-12);
    assert_close(b->damping, 4 * f / h, 1e-12);
    assert_close(b->friction, 5 * f, 1e-12);
    assert_close(ambulo_model_coordinate(c.model, 2)->armature, 0, 0);
    model_shut(&c);
  }
  model_bad(MODEL_HEAD ROOT LINK("hip", "base", ",\n     coordinate: {armature: -1}"),
            AMBULO_E_MODEL,
            "t.yaml:7:18: error[E_MODEL]: armature of coordinate 'hip' is out of range (got -1 kg "
            "m^2); expected 0 to 1e12");
}

static void pairs(void **state) {
  (void)state;
  model_case c = model_good(MODEL_HEAD ROOT LINK("l", "base", ", coordinate: {mirror: r}")
                                LINK("r", "base", ", coordinate: {mirror: l}"));
  assert_int_equal(ambulo_model_coordinate(c.model, 0)->mirror, 1);
  assert_int_equal(ambulo_model_coordinate(c.model, 1)->mirror, 0);
  model_shut(&c);
}

/* children may come first in the file */
static void any_order(void **state) {
  (void)state;
  model_case c = model_good(MODEL_HEAD "links:\n" LINK("knee", "hip", "") LINK("hip", "world", ""));
  assert_string_equal(ambulo_model_link(c.model, 0)->name, "hip");
  assert_string_equal(ambulo_model_coordinate(c.model, 1)->name, "knee");
  model_shut(&c);
}

static void broken_trees(void **state) {
  (void)state;
  model_bad(MODEL_HEAD ROOT LINK("thigh", "base", "") LINK("shank", "tigh", ""), AMBULO_E_MODEL,
            "t.yaml:7:27: error[E_MODEL]: unknown link (got 'tigh'); expected the name of a link "
            "of this model\n  hint: did you mean 'thigh'?");
  model_bad(MODEL_HEAD ROOT LINK("a", "b", "") LINK("b", "a", ""), AMBULO_E_MODEL,
            "t.yaml:6:5: error[E_MODEL]: the links form a cycle (a-b-a,");
  model_bad(MODEL_HEAD ROOT LINK("a", "a", ""), AMBULO_E_MODEL,
            "t.yaml:6:5: error[E_MODEL]: the links form a cycle (a-a,");
  model_bad(MODEL_HEAD ROOT LINK("a", "base", "") LINK("a", "base", ", coordinate: {name: b}"),
            AMBULO_E_MODEL,
            "t.yaml:7:5: error[E_MODEL]: two links are named 'a' (the first one at line 6)");
  model_bad(
      MODEL_HEAD ROOT LINK("a", "base", ", coordinate: {name: q}")
          LINK("b", "base", ", coordinate: {name: q}"),
      AMBULO_E_MODEL,
      "t.yaml:7:136: error[E_MODEL]: two coordinates are named 'q' (the first one at line 6)");
  model_bad(MODEL_HEAD ROOT LINK("a", "none", ""), AMBULO_E_MODEL,
            "t.yaml:6:23: error[E_MODEL]: two roots: 'base' (line 5) and 'a' hang on the world");
  model_bad(MODEL_HEAD ROOT LINK("none", "base", ""), AMBULO_E_MODEL,
            "t.yaml:6:12: error[E_MODEL]: no link can be named 'none'");
  model_bad(MODEL_HEAD ROOT, AMBULO_E_MODEL, "t.yaml:1:1: error[E_MODEL]: the model cannot move");
  model_bad(MODEL_HEAD "links: []\n", AMBULO_E_MODEL,
            "t.yaml:1:1: error[E_MODEL]: the model cannot move");
}

static void broken_links(void **state) {
  (void)state;
  model_bad(MODEL_HEAD ROOT LINK("'a/b'", "base", ""), AMBULO_E_SCHEMA,
            "t.yaml:6:12: error[E_SCHEMA]: got the quoted text 'a/b'; expected a name");
  model_bad(MODEL_HEAD ROOT "  - {name: a, parent: base, joint: hinge, dh: [0, 0, 0, 0]}\n",
            AMBULO_E_SCHEMA,
            "t.yaml:6:36: error[E_SCHEMA]: got 'hinge'; expected one of: fixed, revolute, "
            "prismatic");
  model_bad(MODEL_HEAD ROOT "  - {name: a, parent: base, joint: revolute, dh: [0, 0, 0]}\n",
            AMBULO_E_SCHEMA,
            "t.yaml:6:50: error[E_SCHEMA]: got a sequence of 3; expected a sequence of 4 numbers");
  model_bad(MODEL_HEAD ROOT "  - {name: a, parent: base, joint: revolute, dh: [0, .nan, 0, 0]}\n",
            AMBULO_E_SCHEMA, "t.yaml:6:54: error[E_SCHEMA]: got '.nan'; expected a finite number");
  model_bad(MODEL_HEAD ROOT "  - {name: a, joint: revolute, dh: [0, 0, 0, 0]}\n", AMBULO_E_SCHEMA,
            "t.yaml:6:5: error[E_SCHEMA]: missing required key 'parent' in links[1] ('a')");
  model_bad(MODEL_HEAD ROOT "  - {name: a, parent: base, joint: fixed, dh: [0, 0, 0, 0],"
                            " coordinate: {name: q}}\n",
            AMBULO_E_SCHEMA,
            "t.yaml:6:73: error[E_SCHEMA]: link 'a' is fixed; expected no coordinate");
  model_bad(MODEL_HEAD ROOT "  - 3\n", AMBULO_E_SCHEMA, "t.yaml:6:5: error[E_SCHEMA]: got '3'");
}

static void broken_coordinates(void **state) {
  (void)state;
  model_bad(MODEL_HEAD ROOT LINK("a", "base", ",\n     coordinate: {range: [2, 1]}"),
            AMBULO_E_MODEL,
            "t.yaml:7:18: error[E_MODEL]: range limits of coordinate 'a' contradict each other");
  model_bad(MODEL_HEAD ROOT LINK("a", "base", ",\n     coordinate: {mirror: b}"), AMBULO_E_MODEL,
            "t.yaml:7:27: error[E_MODEL]: unknown coordinate (got 'b')");
  model_bad(MODEL_HEAD ROOT LINK("a", "base", ",\n     coordinate: {mirror_sign: 2}"),
            AMBULO_E_SCHEMA, "t.yaml:7:32: error[E_SCHEMA]: got '2'; expected one of: 1, -1");
  model_bad(MODEL_HEAD ROOT LINK("a", "base", ",\n     coordinate: {range: [2]}"), AMBULO_E_SCHEMA,
            "t.yaml:7:26: error[E_SCHEMA]: got a sequence of 1; expected a sequence of 2");
  model_bad(MODEL_HEAD ROOT LINK("a", "base", ",\n     coordinate: {actuated: yes}"),
            AMBULO_E_SCHEMA, "t.yaml:7:29: error[E_SCHEMA]: got 'yes'; expected true or false");
  model_bad(MODEL_HEAD ROOT LINK("a", "base", ",\n     coordinate: {rnge: [1, 2]}"),
            AMBULO_E_SCHEMA, "t.yaml:7:19: error[E_SCHEMA]: unknown key 'rnge'");
}

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
  const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_read),
                                     cmocka_unit_test(drives),
                                     cmocka_unit_test(pairs),
                                     cmocka_unit_test(any_order),
                                     cmocka_unit_test(broken_trees),
                                     cmocka_unit_test(broken_links),
                                     cmocka_unit_test(broken_coordinates),
                                     cmocka_unit_test(gyration_and_inertia),
                                     cmocka_unit_test(several_bodies),
                                     cmocka_unit_test(faults)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
