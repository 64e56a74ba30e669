/* What is not finite is found, and named: quantity, place, time. */
#include "problem/nlp.h"
#include "support/poison.h"
#include "support/problem_fixture.h"

typedef struct spoilt {
  fixture f;
  poison effort, height, second;
  ambulo_term terms[2];
  ambulo_user_row rows[2];
} spoilt;

/* the arm's swing with a term and a row of the caller, neither poisoned */
static void open_spoilt(spoilt *s) {
  memset(s, 0, sizeof *s);
  s->f.model = arm_create();
  ambulo_problem_definition definition = arm_definition(s->f.model);
  s->effort = s->height = s->second = (poison){-1, -1, NAN, 0, 0, ARM_COORDINATES};
  s->terms[0] = ambulo_term_default(AMBULO_TORQUE_SQUARED);
  s->terms[1] = ambulo_term_default(AMBULO_USER_TERM);
  s->terms[1].name = "mine";
  s->terms[1].function = poisoned_effort;
  s->terms[1].user = &s->effort;
  s->rows[0] = (ambulo_user_row){"own row", "N m",           AMBULO_NOT_NEGATIVE, 0.2,
                                 0.6,       poisoned_effort, &s->height};
  s->rows[1] = s->rows[0];
  s->rows[1].name = "second row";
  s->rows[1].user = &s->second;
  definition.terms = s->terms;
  definition.term_count = 2;
  definition.user_rows = s->rows;
  definition.user_row_count = 2;
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
  s.f.x[5] = -INFINITY;
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

/* of several that are not finite the one that counts: with a weight, and at the first node */
static void what_counts_is_named(void **state) {
  (void)state;
  spoilt s;
  open_spoilt(&s);
  const ambulo_problem *p = s.f.problem;
  s.effort.node = s.height.node = s.second.node = 4;
  s.effort.entry = s.height.entry = s.second.entry = 0;
  assert_int_equal(evaluate(&s), AMBULO_OK);
  for (int r = 0; r < s.f.m; r++)
    s.f.rows[r] = !strcmp(p->table.rows[r].family, "second row") && p->table.rows[r].node == 4;
  assert_int_equal(differentiate(&s, 0.0, s.f.rows), AMBULO_E_NUMERIC);
  expect_text(fault_of(&s), "the derivative of row second row by q of shoulder at node 4 (t = 0.4 "
                            "s) is not a number");
  memset(s.f.rows, 0, (size_t)s.f.m * sizeof *s.f.rows);
  int limit = 0;
  while (strcmp(p->table.rows[limit].family, "torque_limit") != 0) limit++;
  s.f.rows[limit] = NAN; /* a multiplier gone wrong */
  assert_int_equal(differentiate(&s, 0.0, s.f.rows), AMBULO_E_NUMERIC);
  assert_string_equal(fault_of(&s)->name, "torque_limit");
  fixture_close(&s.f);
}

/* a scale of zero leaves a coordinate out, whatever it is; a row without node has a time */
static void places_are_told(void **state) {
  (void)state;
  spoilt s;
  open_spoilt(&s);
  double scale[ARM_COORDINATES] = {0.0, 1.0};
  ambulo_workspace *w = s.f.workspace;
  ambulo_problem *p = s.f.problem;
  ambulo_term *term = (ambulo_term *)p->definition.terms;
  const double *kept = term->scale;
  assert_int_equal(evaluate(&s), AMBULO_OK);
  term->scale = scale;
  for (int i = 0; i < ARM_COORDINATES; i++) {
    int tau = ambulo__channel_tau(&p->channels, i);
    w->channel[ambulo__lane_index(3 + 2 * i, w->channel_count, tau)] = NAN;
  }
  w->term_value[0] = NAN;
  ambulo__fault_of_values(w);
  expect_text(&w->fault, "the value of objective term 'torque_squared' at node 5 (t = 0.5 s) is "
                         "not a number");
  term->scale = kept;
  w->row_value[2] = NAN;
  p->table.rows[2].node = -1;
  p->table.rows[2].time = 0.37;
  ambulo__fault_of_values(w);
  assert_close(w->fault.time, 0.37, 0);
  fixture_close(&s.f);
}

/* by a coordinate of the second point */
static void points_are_named(void **state) {
  (void)state;
  spoilt s;
  open_spoilt(&s);
  s.effort.node = 3;
  s.effort.entry = ambulo__channel_point(&s.f.problem->channels, 1, 2);
  assert_int_equal(differentiate(&s, 1.0, NULL), AMBULO_E_NUMERIC);
  expect_text(fault_of(&s), "the derivative of objective term 'mine' by points of forearm at node "
                            "3 (t = 0.3 s) is not a number");
  fixture_close(&s.f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(finite_points_have_none), cmocka_unit_test(a_term_is_named),
      cmocka_unit_test(a_row_is_named),          cmocka_unit_test(built_in_ones_are_named),
      cmocka_unit_test(an_unknown_is_named),     cmocka_unit_test(derivative_check_stops),
      cmocka_unit_test(text_fits_small_buffers), cmocka_unit_test(what_counts_is_named),
      cmocka_unit_test(places_are_told),         cmocka_unit_test(points_are_named)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
