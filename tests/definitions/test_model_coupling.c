/* `coupled` of a link: units of both sides, by sex, beside origin and dh, and what is refused. */
#include "support/model_text.h"

#define COUPLED(joint, more)                                                                       \
  MODEL_HEAD "links:\n"                                                                            \
             "  - {name: hip, parent: none, joint: revolute, dh: [0, 0, 0, 0], " MODEL_BODY "}\n"  \
             "  - {name: lift, parent: hip, joint: prismatic, dh: [0, 0, 0, 0], " MODEL_BODY "}\n" \
             "  - {name: shank, parent: hip, joint: " joint ", " MODEL_BODY ", " more "}\n"
#define DH "dh: [0, 0, 0.1, 0], "

static const double pi = 3.14159265358979323846;

static const ambulo_link *shank_of(const model_case *c) {
  return ambulo_model_link(c->model, ambulo_model_find_link(c->model, "shank"));
}

static void units_of_both_sides(void **state) {
  (void)state;
  model_case c = model_good(COUPLED("revolute", DH "coupled: {to: hip, polynomial: [90, 2, 0.5]}"));
  const ambulo_link *shank = shank_of(&c);
  assert_int_equal(ambulo_model_coordinate_count(c.model), 2);
  assert_int_equal(shank->coordinate, -1);
  assert_int_equal(shank->coupled_to, 0);
  assert_int_equal(shank->knot_count, 0);
  assert_close(shank->polynomial[0], pi / 2, 1e-15);
  assert_close(shank->polynomial[1], 2, 1e-15);
  assert_close(shank->polynomial[2], 0.5 * 180 / pi, 1e-13);
  assert_close(shank->polynomial[3], 0, 0);
  model_shut(&c);
  c = model_good(COUPLED("prismatic", DH "coupled: {to: hip, polynomial: [0.1, 0.002]}"));
  assert_close(shank_of(&c)->polynomial[0], 0.1, 0);
  assert_close(shank_of(&c)->polynomial[1], 0.002 * 180 / pi, 1e-15);
  model_shut(&c);
  c = model_good(COUPLED("revolute", DH "coupled: {to: lift, spline: [[0, 0], [0.1, 90]]}"));
  assert_int_equal(shank_of(&c)->coupled_to, 1);
  assert_int_equal(shank_of(&c)->knot_count, 2);
  assert_close(shank_of(&c)->knots[1][0], 0.1, 0);
  assert_close(shank_of(&c)->knots[1][1], pi / 2, 1e-15);
  model_shut(&c);
}

/* the row that moves has the function, the last one the name and the body */
static void beside_an_origin(void **state) {
  (void)state;
  model_case c =
      model_good(COUPLED("revolute", "origin: {xyz: [0, -0.4, 0.1]}, axis: [0.2, 0, 1], coupled: "
                                     "{to: hip, spline: [[-60, 0], [0, 5], [60, 20]]}"));
  int coupled = 0;
  for (int i = 0; i < ambulo_model_link_count(c.model); i++) {
    const ambulo_link *link = ambulo_model_link(c.model, i);
    if (link->coupled_to < 0) continue;
    coupled++;
    assert_int_equal(link->type, AMBULO_REVOLUTE);
    assert_int_equal(link->knot_count, 3);
    assert_close(link->knots[2][1], pi / 9, 1e-15);
  }
  assert_int_equal(coupled, 1);
  assert_true(shank_of(&c)->mass > 0);
  model_shut(&c);
}

/* one message, which says so */
static void refused(const char *text, ambulo_status status, const char *said) {
  model_case c = model_open(text);
  if (c.status != status || ambulo_diagnostics_count(c.list) != 1) model_print(&c);
  assert_int_equal(c.status, status);
  assert_int_equal(ambulo_diagnostics_count(c.list), 1);
  if (!strstr(ambulo_diagnostics_get(c.list, 0)->message, said)) {
    model_print(&c);
    fail_msg("expected: %s", said);
  }
  model_shut(&c);
}

static void what_is_refused(void **state) {
  (void)state;
  refused(COUPLED("revolute", DH "coupled: {to: hop, polynomial: [0, 1]}"), AMBULO_E_MODEL,
          "unknown coordinate (got 'hop')");
  refused(COUPLED("revolute", DH "coupled: {to: hip}"), AMBULO_E_SCHEMA,
          "link 'shank' is coupled by no function; expected one of `spline` and `polynomial`");
  refused(COUPLED("revolute", DH "coupled: {to: hip, polynomial: [1], spline: [[0, 1], [1, 2]]}"),
          AMBULO_E_SCHEMA, "link 'shank' is coupled by both");
  refused(COUPLED("revolute", DH "coupled: {polynomial: [1]}"), AMBULO_E_SCHEMA,
          "missing required key 'to'");
  refused(COUPLED("fixed", DH "coupled: {to: hip, polynomial: [1]}"), AMBULO_E_SCHEMA,
          "link 'shank' is coupled and fixed");
  refused(COUPLED("revolute", DH "coordinate: {name: k}, coupled: {to: hip, polynomial: [1]}"),
          AMBULO_E_SCHEMA, "link 'shank' is coupled and has a coordinate");
  refused(COUPLED("revolute", DH "coupled: {to: hip, polynomial: []}"), AMBULO_E_SCHEMA,
          "a polynomial without coefficients; expected 1 to 5 numbers");
  refused(COUPLED("revolute", DH "coupled: {to: hip, polynomial: [1, 2, 3, 4, 5, 6]}"),
          AMBULO_E_LIMIT, "too many polynomial (got 6); expected at most 5");
  refused(COUPLED("revolute", DH "coupled: {to: hip, spline: [[0, 1]]}"), AMBULO_E_SCHEMA,
          "a spline has 1 points; expected 2 to 1024");
  refused(COUPLED("revolute", DH "coupled: {to: hip, spline: [[0, 1], [10, 2], [5, 3]]}"),
          AMBULO_E_SCHEMA, "the points of a spline do not ascend (got 5 after 10)");
  refused(COUPLED("revolute", DH "coupled: {to: hip, spline: [[0, 1], [1]]}"), AMBULO_E_SCHEMA,
          "expected");
  refused(COUPLED("revolute", DH "coupled: {to: shank, polynomial: [1]}"), AMBULO_E_MODEL,
          "unknown coordinate (got 'shank')");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(units_of_both_sides),
                                     cmocka_unit_test(beside_an_origin),
                                     cmocka_unit_test(what_is_refused)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
