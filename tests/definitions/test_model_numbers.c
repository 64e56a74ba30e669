#include "ambulo/tools/load.h"
#include "definitions/model_reader.h"
#include "support/model_text.h"

/* a value by sex may be one number of a list or the whole list */
#define BY_SEX                                                                                     \
  "ambulo: 1\nname: t\nunits: {angle: radians}\nsubject: {sex: SEX}\n"                             \
  "links:\n"                                                                                       \
  "  - {name: rod, parent: none, joint: revolute, dh: [0, 0, {male: 2, female: 1}, 0],\n"          \
  "     coordinate: {range: {male: [-1, 1], female: [-2, {male: 9, female: 2}]}},\n"               \
  "     body: {mass: {male: 5, female: 4}, com: {male: [1, 0, 0], female: [2, 0, 0]},\n"           \
  "            gyration: [0, 0, 0]}}\n"

static void by_sex(void **state) {
  (void)state;
  static const char *const words[] = {"female", "male"};
  static const double want[2][5] = {{1, -2, 2, 4, 2}, {2, -1, 1, 5, 1}};
  for (int i = 0; i < 2; i++) {
    char text[600];
    snprintf(text, sizeof text, "%s", BY_SEX);
    char *at = strstr(text, "SEX");
    char rest[600];
    snprintf(rest, sizeof rest, "%s", at + 3);
    snprintf(at, sizeof text - (size_t)(at - text), "%s%s", words[i], rest);
    model_case c = model_good(text);
    const ambulo_link *link = ambulo_model_link(c.model, 0);
    const ambulo_coordinate *q = ambulo_model_coordinate(c.model, 0);
    assert_close(link->a, want[i][0], 0);
    assert_close(q->range[0], want[i][1], 0);
    assert_close(q->range[1], want[i][2], 0);
    assert_close(link->mass, want[i][3], 0);
    assert_close(link->com[0], want[i][4], 0);
    model_shut(&c);
  }
}

#define ROD_WITH(dh, more)                                                                         \
  MODEL_HEAD "links:\n  - {name: rod, parent: none, joint: revolute, dh: " dh ", " more "}\n"

static void faults_by_sex(void **state) {
  (void)state;
  model_bad(ROD_WITH("[0, 0, {male: 2, female: 1}, 0]", MODEL_BODY), AMBULO_E_SCHEMA,
            "t.yaml:5:59: error[E_SCHEMA]: a value differs by sex, but the subject has none");
  model_bad("subject: {sex: male}\n" ROD_WITH("[0, 0, {male: 2}, 0]", MODEL_BODY), AMBULO_E_SCHEMA,
            "t.yaml:6:59: error[E_SCHEMA]: missing required key 'female'");
  /* the value for the other sex, which nobody reads now */
  model_bad("subject: {sex: male}\n" ROD_WITH("[0, 0, {male: 2, female: [1]}, 0]", MODEL_BODY),
            AMBULO_E_SCHEMA,
            "t.yaml:6:77: error[E_SCHEMA]: got a sequence of 1; expected a number");
  model_bad(
      "subject: {sex: male}\n" ROD_WITH("{male: [0, 0, 2, 0], female: [0, 0, 1]}", MODEL_BODY),
      AMBULO_E_SCHEMA, "t.yaml:6:81: error[E_SCHEMA]: got a sequence of 3; expected 4");
  model_bad(
      "subject: {sex: male}\n" ROD_WITH("[0, 0, {male: 2, femal: 1, female: 1}, 0]", MODEL_BODY),
      AMBULO_E_SCHEMA, "t.yaml:6:69: error[E_SCHEMA]: unknown key 'femal'");
}

static void warning_of_degrees(void **state) {
  (void)state;
  model_case c =
      model_open("ambulo: 1\nname: t\nunits: {angle: radians}\nlinks:\n"
                 "  - {name: rod, parent: none, joint: revolute, dh: [0, 0, 0, 90],\n"
                 "     coordinate: {range: [-120, 120], speed: [-50, 50]}, " MODEL_BODY "}\n");
  assert_int_equal(c.status, AMBULO_OK);
  assert_int_equal(ambulo_diagnostics_count(c.list), 1);
  assert_message(c.list, 0,
                 "t.yaml:5:62: warning: an angle of more than a full turn (got 90 radians)");
  assert_close(ambulo_model_link(c.model, 0)->alpha, 90, 0);
  model_shut(&c);
}

static void numbers(void **state) {
  (void)state;
  model_bad(ROD_WITH("[0, 0, '1', 0]", MODEL_BODY), AMBULO_E_SCHEMA,
            "t.yaml:5:59: error[E_SCHEMA]: got the quoted text '1'; expected a number");
  model_bad(ROD_WITH("[0, 0, 1_000, 0]", MODEL_BODY), AMBULO_E_SCHEMA,
            "t.yaml:5:59: error[E_SCHEMA]: got '1_000'; expected a number");
  model_bad(ROD_WITH("[0, 0, 1e999, 0]", MODEL_BODY), AMBULO_E_SCHEMA,
            "t.yaml:5:59: error[E_SCHEMA]: got '1e999'; expected a finite number");
  model_bad(ROD_WITH("[0, 0, [1], 0]", MODEL_BODY), AMBULO_E_SCHEMA,
            "t.yaml:5:59: error[E_SCHEMA]: got a sequence of 1; expected a number");
  model_bad(ROD_WITH("[0, 0, 1, 0]", MODEL_BODY ", coordinate: {range: [none, all]}"),
            AMBULO_E_SCHEMA, "t.yaml:5:153: error[E_SCHEMA]: got 'all'; expected a number");
}

#define SCALED(subject)                                                                            \
  "ambulo: 1\nname: t\n"                                                                           \
  "units: {angle: degrees, length: stature, mass: body_mass, torque: weight_stature}\n" subject    \
  "gravity: [0, 0, -10]\n"                                                                         \
  "links:\n"                                                                                       \
  "  - {name: slide, parent: none, joint: prismatic, dh: [0, 0.1, 0.2, 0],\n"                      \
  "     coordinate: {range: [-1, 1], speed: [-2, 2], torque: [-0.5, 0.5]}}\n"                      \
  "  - {name: rod, parent: slide, joint: revolute, dh: [90, 0, 0.25, 0],\n"                        \
  "     coordinate: {range: [-45, 45], torque: [-0.1, 0.2]},\n"                                    \
  "     body: {mass: 0.4, com: [0.1, 0, 0], inertia: [0.01, 0.02, 0.03, 0, 0, 0]}}\n"              \
  "points:\n  - {name: tip, link: rod, position: [0.5, 0, 0]}\n"

static void check_scaled(const ambulo_model *model, double mass, double stature) {
  const ambulo_link *slide = ambulo_model_link(model, 0), *rod = ambulo_model_link(model, 1);
  const ambulo_coordinate *x = ambulo_model_coordinate(model, 0);
  const ambulo_coordinate *q = ambulo_model_coordinate(model, 1);
  assert_close(slide->d, 0.1 * stature, 1e-15);
  assert_close(slide->a, 0.2 * stature, 1e-15);
  assert_close(x->range[1], stature, 1e-15);
  assert_close(x->speed[1], 2 * stature, 1e-15);
  assert_close(x->torque[1], 0.5 * mass * 10, 1e-15);
  assert_close(q->range[1], acos(-1) / 4, 1e-15);
  assert_close(q->torque[0], -0.1 * mass * 10 * stature, 1e-15);
  assert_close(rod->mass, 0.4 * mass, 1e-15);
  assert_close(rod->com[0], 0.1 * stature, 1e-15);
  assert_close(rod->inertia[1], 0.02 * mass * stature * stature, 1e-15);
  assert_close(ambulo_model_point(model, 0)->position[0], 0.5 * stature, 1e-15);
  assert_close(ambulo_model_mass(model), 0.4 * mass, 1e-15);
  assert_close(ambulo_model_stature(model), stature, 0);
}

static void subject_of_the_file(void **state) {
  (void)state;
  model_case c = model_good(SCALED("subject: {mass: 80, stature: 1.8}\n"));
  check_scaled(c.model, 80, 1.8);
  model_shut(&c);
}

/* the caller's subject counts, each number by itself */
static void subject_of_the_caller(void **state) {
  (void)state;
  ambulo_subject subject = {.size = sizeof(ambulo_subject), .mass = 60, .stature = 1.6};
  model_case c = model_open_as(SCALED("subject: {mass: 80, stature: 1.8}\n"), &subject);
  check_scaled(c.model, 60, 1.6);
  model_shut(&c);
  c = model_open_as(SCALED(""), &subject);
  check_scaled(c.model, 60, 1.6);
  model_shut(&c);
  subject.stature = AMBULO_OFF;
  c = model_open_as(SCALED("subject: {mass: 80, stature: 1.8}\n"), &subject);
  check_scaled(c.model, 60, 1.8);
  model_shut(&c);
}

static void absent_subject(void **state) {
  (void)state;
  model_case c = model_open(SCALED(""));
  assert_int_equal(c.status, AMBULO_E_SCHEMA);
  assert_message(c.list, 0,
                 "t.yaml:3:33: error[E_SCHEMA]: the unit needs the stature of the subject; "
                 "expected subject.stature");
  assert_message(c.list, 1, "t.yaml:3:48: error[E_SCHEMA]: the unit needs the mass");
  assert_message(c.list, 2, "t.yaml:3:67: error[E_SCHEMA]: the unit needs the mass");
  assert_message(c.list, 3, "t.yaml:3:67: error[E_SCHEMA]: the unit needs the stature");
  model_shut(&c);
}

static void bad_subjects(void **state) {
  (void)state;
  const double off = AMBULO_OFF;
  const size_t size = sizeof(ambulo_subject);
  const ambulo_subject bad[] = {{size, -1, off, AMBULO_MALE},   {size, off, -1, AMBULO_MALE},
                                {size, 0, off, AMBULO_MALE},    {size, off, 0, AMBULO_MALE},
                                {size, off, 20, AMBULO_MALE},   {size, 1e5, off, AMBULO_MALE},
                                {size, off, off, (ambulo_sex)7}};
  for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
    model_case c = model_open_as(MODEL_HEAD MODEL_ROD, &bad[i]);
    assert_int_equal(c.status, AMBULO_E_ARGUMENT);
    assert_message(c.list, 0, "ambulo: error[E_ARGUMENT]: the subject is out of range (got ");
    model_shut(&c);
  }
  model_bad(MODEL_HEAD MODEL_ROD "subject: {mass: 0}\n", AMBULO_E_SCHEMA,
            "t.yaml:6:17: error[E_SCHEMA]: got '0'; expected a number from 0.5 to 1000");
  model_bad(MODEL_HEAD MODEL_ROD "subject: {stature: 175}\n", AMBULO_E_SCHEMA,
            "t.yaml:6:20: error[E_SCHEMA]: got '175'; expected a number from 0.2 to 3");
  model_bad(MODEL_HEAD MODEL_ROD "subject: {sex: none}\n", AMBULO_E_SCHEMA,
            "t.yaml:6:16: error[E_SCHEMA]: got 'none'; expected one of: female, male");
}

/* scaling a model in metres and kilograms would do nothing: the caller is warned */
static void unused_subject(void **state) {
  (void)state;
  ambulo_subject subject = {.size = sizeof(ambulo_subject), .mass = 60, .stature = 1.6};
  model_case c = model_open_as(MODEL_HEAD MODEL_ROD, &subject);
  assert_int_equal(c.status, AMBULO_OK);
  assert_int_equal(ambulo_diagnostics_count(c.list), 2);
  assert_message(c.list, 0, "t.yaml:3:8: warning: the lengths of this model do not depend");
  assert_message(c.list, 1, "t.yaml:3:8: warning: the masses of this model do not depend");
  model_shut(&c);
}

static void units(void **state) {
  (void)state;
  model_bad("ambulo: 1\nname: t\nunits: {angle: grad}\n" MODEL_ROD, AMBULO_E_SCHEMA,
            "t.yaml:3:16: error[E_SCHEMA]: got 'grad'; expected one of: radians, degrees");
  model_bad("ambulo: 1\nname: t\nunits: {angle: degrees, length: kg}\n" MODEL_ROD, AMBULO_E_SCHEMA,
            "t.yaml:3:33: error[E_SCHEMA]: got 'kg'; expected one of: metres, stature");
  model_bad("ambulo: 1\nname: t\nunits: {length: metres}\n" MODEL_ROD, AMBULO_E_SCHEMA,
            "t.yaml:3:8: error[E_SCHEMA]: missing required key 'angle' in units");
  model_case c = model_good("ambulo: 1\nname: t\nunits: {angle: radians, dh_angle: degrees}\n"
                            "links:\n  - {name: rod, parent: none, joint: revolute, dh: [90, 0, 0, "
                            "0], coordinate: {range: [-1, 1]}, " MODEL_BODY "}\n");
  assert_close(ambulo_model_link(c.model, 0)->theta, acos(-1) / 2, 1e-15);
  assert_close(ambulo_model_coordinate(c.model, 0)->range[1], 1, 0);
  model_shut(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(by_sex),
                                     cmocka_unit_test(faults_by_sex),
                                     cmocka_unit_test(warning_of_degrees),
                                     cmocka_unit_test(numbers),
                                     cmocka_unit_test(subject_of_the_file),
                                     cmocka_unit_test(subject_of_the_caller),
                                     cmocka_unit_test(absent_subject),
                                     cmocka_unit_test(bad_subjects),
                                     cmocka_unit_test(unused_subject),
                                     cmocka_unit_test(units)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
