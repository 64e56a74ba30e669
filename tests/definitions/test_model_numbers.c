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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(by_sex), cmocka_unit_test(faults_by_sex),
                                     cmocka_unit_test(warning_of_degrees),
                                     cmocka_unit_test(numbers)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
