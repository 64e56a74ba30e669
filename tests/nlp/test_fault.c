/* What is not finite is found, and named: quantity, place, time. */
#include "support/poison.h"
#include "support/problem_fixture.h"

typedef struct spoilt {
  fixture f;
  poison effort, height;
  ambulo_term terms[2];
  ambulo_user_row row;
} spoilt;

/* the arm's swing with a term and a row of the caller, neither poisoned */
static void open_spoilt(spoilt *s) {
  memset(s, 0, sizeof *s);
  s->f.model = arm_create();
  ambulo_problem_definition definition = arm_definition(s->f.model);
  s->effort = s->height = (poison){-1, -1, NAN, 0, 0, ARM_COORDINATES};
  s->terms[0] = ambulo_term_default(AMBULO_TORQUE_SQUARED);
  s->terms[1] = ambulo_term_default(AMBULO_USER_TERM);
  s->terms[1].name = "mine";
  s->terms[1].function = poisoned_effort;
  s->terms[1].user = &s->effort;
  s->row = (ambulo_user_row){"own row", "N m",           AMBULO_NOT_NEGATIVE, 0.2,
                             0.6,       poisoned_effort, &s->height};
  definition.terms = s->terms;
  definition.term_count = 2;
  definition.user_rows = &s->row;
  definition.user_row_count = 1;
  fixture_open(&s->f, &definition);
}

static ambulo_status evaluate(spoilt *s) {
  return ambulo_problem_evaluate(s->f.problem, s->f.workspace, s->f.x, NULL, NULL, NULL);
}

static ambulo_status differentiate(spoilt *s, double objective, const double *rows) {
  return ambulo_problem_gradient(s->f.problem, s->f.workspace, s->f.x, objective, rows,
                                 s->f.gradient);
}

static const ambulo_fault *fault_of(const spoilt *s) {
  return ambulo_workspace_fault(s->f.workspace);
}

static void expect_text(const ambulo_fault *fault, const char *want) {
  char text[400];
  ambulo_fault_text(fault, text, sizeof text);
  if (strcmp(text, want) != 0) print_error("got '%s'\nexpected '%s'\n", text, want);
  assert_string_equal(text, want);
}

static void finite_points_have_none(void **state) {
  (void)state;
  spoilt s;
  open_spoilt(&s);
  assert_int_equal(evaluate(&s), AMBULO_OK);
  assert_int_equal(differentiate(&s, 1.0, NULL), AMBULO_OK);
  assert_int_equal(fault_of(&s)->kind, AMBULO_FAULT_NONE);
  expect_text(fault_of(&s), "every value and derivative is finite");
  fixture_close(&s.f);
}

static void a_term_is_named(void **state) {
  (void)state;
  spoilt s;
  open_spoilt(&s);
  s.effort.node = 3;
  assert_int_equal(evaluate(&s), AMBULO_E_NUMERIC);
  assert_int_equal(fault_of(&s)->kind, AMBULO_FAULT_TERM);
  expect_text(fault_of(&s),
              "the value of objective term 'mine' at node 3 (t = 0.3 s) is not a number");
  s.effort.entry = 3 * ARM_COORDINATES + 1;
  s.effort.value = INFINITY;
  assert_int_equal(evaluate(&s), AMBULO_OK);
  assert_int_equal(differentiate(&s, 0.0, NULL), AMBULO_OK); /* nobody asks for it */
  assert_int_equal(differentiate(&s, 1.0, NULL), AMBULO_E_NUMERIC);
  expect_text(fault_of(&s), "the derivative of objective term 'mine' by tau of elbow at node 3 "
                            "(t = 0.3 s) is infinite");
  fixture_close(&s.f);
}

static void a_row_is_named(void **state) {
  (void)state;
  spoilt s;
  open_spoilt(&s);
  const ambulo_problem *p = s.f.problem;
  s.height.node = 4;
  assert_int_equal(evaluate(&s), AMBULO_E_NUMERIC);
  expect_text(fault_of(&s), "the value of row own row at node 4 (t = 0.4 s) is not a number");
  s.height.entry = 0;
  assert_int_equal(evaluate(&s), AMBULO_OK);
  for (int r = 0; r < s.f.m; r++) {
    int own = strcmp(p->table.rows[r].family, "own row") == 0 && p->table.rows[r].node == 4;
    s.f.rows[r] = own;
    ambulo_status status = ambulo_problem_row_gradient(p, s.f.workspace, s.f.x, r, s.f.gradient);
    assert_int_equal(status, own ? AMBULO_E_NUMERIC : AMBULO_OK);
    if (own)
      expect_text(fault_of(&s), "the derivative of row own row by q of shoulder at node 4 (t = 0.4 "
                                "s) is not a number");
  }
  assert_int_equal(differentiate(&s, 1.0, s.f.rows), AMBULO_E_NUMERIC);
  expect_text(fault_of(&s),
              "the derivative of row own row by q of shoulder at node 4 (t = 0.4 s) is "
              "not a number");
  fixture_close(&s.f);
}

/* a torque that is not finite shows in the rows and terms that are made of it */
static void built_in_ones_are_named(void **state) {
  (void)state;
  spoilt s;
  ambulo__kernels own;
  open_spoilt(&s);
  poison_mechanics(s.f.problem, &own, POISON_OUTPUTS, 1, 2, NAN); /* elbow, nodes 2 and 10 */
  assert_int_equal(evaluate(&s), AMBULO_E_NUMERIC);
  assert_int_equal(fault_of(&s)->kind, AMBULO_FAULT_ROW);
  expect_text(fault_of(&s),
              "the value of row torque_limit of elbow (lower) at node 2 (t = 0.2 s) is "
              "not a number");
  poison_mechanics(s.f.problem, &own, POISON_REVERSE, ARM_COORDINATES, 5, INFINITY);
  assert_int_equal(evaluate(&s), AMBULO_OK);
  assert_int_equal(differentiate(&s, 1.0, NULL), AMBULO_E_NUMERIC);
  expect_text(fault_of(&s),
              "the derivative of the inverse dynamics by qd of shoulder at node 5 (t = "
              "0.5 s) is infinite");
  poison_remove(s.f.problem);
  fixture_close(&s.f);
}

static void an_unknown_is_named(void **state) {
  (void)state;
  spoilt s;
  open_spoilt(&s);
  s.f.x[3] = -INFINITY;
  assert_int_equal(evaluate(&s), AMBULO_E_NUMERIC);
  assert_int_equal(fault_of(&s)->kind, AMBULO_FAULT_UNKNOWN);
  expect_text(fault_of(&s), "the value of an unknown of elbow is infinite");
  fixture_close(&s.f);
}

/* the derivative check does not pass over it either */
static void derivative_check_stops(void **state) {
  (void)state;
  spoilt s;
  open_spoilt(&s);
  ambulo_derivative_error errors[16];
  int count = 0;
  s.effort.node = 6;
  s.effort.entry = 1;
  assert_int_equal(
      ambulo_problem_check_derivatives(s.f.problem, s.f.workspace, s.f.x, 0.0, errors, 16, &count),
      AMBULO_E_NUMERIC);
  assert_string_equal(fault_of(&s)->name, "mine");
  fixture_close(&s.f);
}

static void text_fits_small_buffers(void **state) {
  (void)state;
  spoilt s;
  open_spoilt(&s);
  s.effort.node = 3;
  assert_int_equal(evaluate(&s), AMBULO_E_NUMERIC);
  for (size_t size = 0; size < 40; size++) {
    char text[40];
    memset(text, 'x', sizeof text);
    ambulo_fault_text(fault_of(&s), text, size);
    if (size > 0) assert_int_equal(strlen(text), size - 1);
    assert_int_equal(text[size], size < 40 ? 'x' : 0);
  }
  fixture_close(&s.f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(finite_points_have_none), cmocka_unit_test(a_term_is_named),
      cmocka_unit_test(a_row_is_named),          cmocka_unit_test(built_in_ones_are_named),
      cmocka_unit_test(an_unknown_is_named),     cmocka_unit_test(derivative_check_stops),
      cmocka_unit_test(text_fits_small_buffers)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
