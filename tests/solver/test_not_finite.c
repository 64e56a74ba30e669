/* Values and derivatives that are not finite: whatever is poisoned, wherever, no solve and no audit
 * ends optimal unless it is, and none is silent about it. */
#include "support/at_nodes.h"
#include "support/engine_fixture.h"
#include "support/messages.h"
#include "support/poison.h"
#include "support/problem_fixture.h"

#define COUNT(array) (sizeof array / sizeof *array)

static const double kinds[] = {NAN, INFINITY, -INFINITY};

typedef struct outcome {
  ambulo_status status;
  ambulo_verdict verdict;
  ambulo_fault fault;
  double objective;
  double *x;
  char text[2000]; /* messages */
} outcome;

/* messages of a list, one a line */
static void collect(const ambulo_diagnostics *list, char *text, size_t size) {
  size_t used = 0;
  text[0] = '\0';
  for (size_t i = 0; i < ambulo_diagnostics_count(list) && used + 1 < size; i++) {
    (void)snprintf(text + used, size - used, "%s\n", ambulo_diagnostics_get(list, i)->message);
    used = strlen(text);
  }
}

static outcome solve(const ambulo_problem *problem, int iterations) {
  ambulo_options options = ambulo_problem_options(problem);
  if (iterations) options.maximum_iterations = iterations;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_result *result = NULL;
  outcome o = {.status = ambulo_solve(problem, &options, NULL, NULL, list, &result)};
  collect(list, o.text, sizeof o.text);
  if (!o.status) {
    size_t bytes = (size_t)ambulo_problem_variable_count(problem) * sizeof *o.x;
    o.verdict = verdict_at_nodes(result);
    o.fault = ambulo_result_audit(result)->fault;
    o.objective = ambulo_result_objective(result);
    o.x = malloc(bytes);
    memcpy(o.x, ambulo_result_x(result), bytes);
  }
  ambulo_result_free(result);
  ambulo_diagnostics_free(list);
  return o;
}

/* ------------------------------------------------- functions of the caller */

typedef struct swing {
  fixture f;
  poison poison;
  ambulo_term term;
  ambulo_user_row row;
} swing;

/* the arm's swing with the poison in a term or in a row (large and positive: never active) */
static void open_swing(swing *s, int in_row) {
  memset(s, 0, sizeof *s);
  s->f.model = arm_create();
  ambulo_problem_definition definition = arm_definition(s->f.model);
  s->poison = (poison){-1, -1, NAN, 0, 0, ARM_COORDINATES};
  s->term = ambulo_term_default(AMBULO_USER_TERM);
  s->term.name = "mine";
  s->term.function = poisoned_effort;
  s->term.user = &s->poison;
  s->row =
      (ambulo_user_row){"mine", "N m", AMBULO_NOT_NEGATIVE, 0.0, 1.0, poisoned_effort, &s->poison};
  if (in_row) {
    definition.user_rows = &s->row;
    definition.user_row_count = 1;
  } else {
    definition.terms = &s->term;
    definition.term_count = 1;
  }
  fixture_open(&s->f, &definition);
}

static void expect_failure(const swing *s, const outcome *o) {
  const poison *p = &s->poison;
  int named = strstr(o->text, "mine") != NULL;
  int refused = o->status == AMBULO_E_PROBLEM && p->entry < 0;
  int failed = o->status == AMBULO_OK && o->verdict == AMBULO_NUMERIC_FAILURE &&
               o->fault.kind != AMBULO_FAULT_NONE && o->fault.node == p->node;
  if (named && (refused || failed)) return;
  print_error("node %d, entry %d, %g after %d calls: %s, %s, '%s'\n", p->node, p->entry, p->value,
              p->after, ambulo_status_name(o->status), ambulo_verdict_name(o->verdict), o->text);
  fail();
}

/* every entry at every node, and from the start on or later */
static void functions_of_the_caller(void **state) {
  (void)state;
  for (int in_row = 0; in_row < 2; in_row++) {
    swing s;
    open_swing(&s, in_row);
    int channels = ambulo__channel_count(&s.f.problem->channels);
    for (int node = 0; node <= 10; node++) {
      for (int entry = -1; entry < channels; entry++) {
        s.poison.node = node;
        s.poison.entry = entry;
        s.poison.value = kinds[(node + entry + 1) % (int)COUNT(kinds)];
        s.poison.calls = 0;
        s.poison.after = (node + entry) % 3 == 0 ? 12 : 0;
        outcome o = solve(s.f.problem, 0);
        expect_failure(&s, &o);
        free(o.x);
      }
    }
    fixture_close(&s.f);
  }
}

/* an audit of a good point, spoilt afterwards */
static void audits(void **state) {
  (void)state;
  for (int in_row = 0; in_row < 2; in_row++) {
    swing s;
    open_swing(&s, in_row);
    outcome good = solve(s.f.problem, 0);
    assert_int_equal(good.verdict, AMBULO_OPTIMAL);
    s.poison.node = 7;
    for (s.poison.entry = 0; s.poison.entry < 4 * ARM_COORDINATES; s.poison.entry++) {
      ambulo_result *result = NULL;
      assert_int_equal(ambulo_audit_point(s.f.problem, NULL, good.x, NULL, NULL, &result),
                       AMBULO_OK);
      assert_int_equal(verdict_at_nodes(result), AMBULO_NUMERIC_FAILURE);
      assert_int_equal(ambulo_result_audit(result)->fault.node, 7);
      assert_true(isinf(ambulo_result_audit(result)->kkt));
      ambulo_result_free(result);
    }
    free(good.x);
    fixture_close(&s.f);
  }
}

/* a value and a slope that are finite, with a square that is not: no word about the rows */
static double steep(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  (void)user;
  if (gradient) gradient->qdd[0] += 1e200;
  return 1e200 * state->qdd[0];
}

static void curvature_that_is_not_finite(void **state) {
  (void)state;
  swing s;
  open_swing(&s, 0);
  fixture_close(&s.f);
  s.f.model = arm_create();
  ambulo_problem_definition definition = arm_definition(s.f.model);
  s.term = ambulo_term_default(AMBULO_USER_SQUARE);
  s.term.function = steep;
  definition.terms = &s.term;
  definition.term_count = 1;
  fixture_open(&s.f, &definition);
  outcome o = solve(s.f.problem, 0);
  assert_int_equal(o.status, AMBULO_OK);
  assert_int_equal(o.verdict, AMBULO_NUMERIC_FAILURE);
  assert_non_null(strstr(o.text, "the second derivative of the objective is infinite"));
  assert_null(strstr(o.text, "no point was found"));
  free(o.x);
  fixture_close(&s.f);
}

/* Values that are not finite at trial points alone: a wall that the solve turns back from. The
 * optimum lies this side of it, so that `optimal` is the truth, and it is said that points were
 * rejected. */
static double walled(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  double room = 30.0 - fabs(state->tau[0]);
  (void)user;
  for (int i = 0; i < ARM_COORDINATES; i++) {
    if (gradient) gradient->tau[i] += 2.0 * state->tau[i];
  }
  double sum = state->tau[0] * state->tau[0] + state->tau[1] * state->tau[1];
  return room > 0.0 ? sum : sum + log(room);
}

static void walls_are_turned_back_from(void **state) {
  (void)state;
  swing s;
  open_swing(&s, 0);
  fixture_close(&s.f);
  s.f.model = arm_create();
  ambulo_problem_definition definition = arm_definition(s.f.model);
  s.term.function = walled;
  definition.terms = &s.term;
  definition.term_count = 1;
  definition.torque_limits = 0;
  fixture_open(&s.f, &definition);
  outcome o = solve(s.f.problem, 0);
  assert_int_equal(o.status, AMBULO_OK);
  assert_int_equal(o.verdict, AMBULO_OPTIMAL);
  int rejected = strstr(o.text, "rejected") != NULL;
  if (rejected) assert_non_null(strstr(o.text, "mine"));
  free(o.x);
  fixture_close(&s.f);
}

/* ------------------------------------------------------------ the mechanics */

/* an answer with poison may be optimal only if it is so without */
static void expect_truth(ambulo_problem *problem, const outcome *o, const char *what, size_t entry,
                         int lane) {
  poison_remove(problem);
  if (o->status) {
    assert_true(o->text[0] != '\0');
    return;
  }
  if (o->verdict == AMBULO_NUMERIC_FAILURE) assert_true(o->text[0] != '\0');
  if (!ambulo_verdict_is_solution(o->verdict)) return;
  ambulo_result *clean = NULL;
  assert_int_equal(ambulo_audit_point(problem, NULL, o->x, NULL, NULL, &clean), AMBULO_OK);
  ambulo_verdict truth = verdict_at_nodes(clean);
  int same =
      o->verdict == AMBULO_OPTIMAL ? truth == AMBULO_OPTIMAL : ambulo_verdict_is_solution(truth);
  if (!same)
    print_error("%s %zu, lane %d: %s, in truth %s\n", what, entry, lane,
                ambulo_verdict_name(o->verdict), ambulo_verdict_name(truth));
  assert_true(same);
  ambulo_result_free(clean);
}

static void poison_all(const char *name, int stride, int iterations, int least) {
  static const char *const words[] = {"output", "reverse sweep", "by q", "by qd", "by qdd"};
  ambulo_problem *problem = load_problem(name);
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(problem->plan);
  int d = problem->coordinates, found = 0;
  size_t outputs = (size_t)(ambulo__channel_count(&problem->channels) - 3 * d);
  const size_t counts[] = {outputs, (size_t)(3 * d), (size_t)pattern.count,
                           (size_t)pattern.dynamic_count, (size_t)pattern.dynamic_count};
  ambulo__kernels own;
  for (int array = POISON_OUTPUTS; array < POISON_NOTHING; array++) {
    for (size_t e = 0; e < counts[array]; e += (size_t)stride) {
      int lane = (int)e % AMBULO__LANES;
      poison_mechanics(problem, &own, (poison_array)array, e, lane, kinds[e % COUNT(kinds)]);
      outcome o = solve(problem, iterations);
      found += o.status || o.verdict == AMBULO_NUMERIC_FAILURE;
      expect_truth(problem, &o, words[array], e, lane);
      free(o.x);
    }
  }
  assert_true(found >= least); /* the poison is not in unused places alone */
  ambulo_problem_free(problem);
}

static void small_mechanics(void **state) {
  (void)state;
  poison_all("support/two_link_reach", 1, 0, 12);
}

static void mechanics_of_a_step(void **state) {
  (void)state;
  poison_all("support/walker_2d_step", 11, 3, 8);
}

/* ------------------------------------------ every kind of row and of term */

/* poisons the channel of the mechanics that row r stands on first; 0 when it stands on none */
static int poison_row(ambulo_problem *problem, ambulo__kernels *own, int r) {
  const ambulo__table_row *row = &problem->table.rows[r];
  for (int t = 0; t < row->term_count; t++) {
    const ambulo__row_term *term = &problem->table.terms[row->first_term + t];
    int output = term->channel - ambulo__channel_outputs(&problem->channels);
    if (term->node < 0 || output < 0) continue;
    poison_mechanics(problem, own, POISON_OUTPUTS, (size_t)output, term->node % AMBULO__LANES, NAN);
    return 1;
  }
  return 0;
}

/* The first row of each family: a value that is not finite at the start is refused by name, and
 * an audit of the solution without it would not be called optimal with it. */
static void every_family(void **state) {
  (void)state;
  static const char *const names[] = {"support/walk_rigid", "yardstick_12",
                                      "support/two_link_reach"};
  int families = 0;
  for (size_t i = 0; i < COUNT(names); i++) {
    ambulo_problem *problem = load_problem(names[i]);
    ambulo__kernels own;
    for (int r = 0; r < problem->rows; r++) {
      const char *family = problem->table.rows[r].family;
      if (r > 0 && strcmp(family, problem->table.rows[r - 1].family) == 0) continue;
      if (!poison_row(problem, &own, r)) continue;
      families++;
      outcome o = solve(problem, 0);
      poison_remove(problem);
      assert_int_equal(o.status, AMBULO_E_PROBLEM);
      assert_non_null(strstr(o.text, "not a number"));
      assert_non_null(strstr(o.text, "t = "));
    }
    ambulo_problem_free(problem);
  }
  assert_true(families > 10);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(functions_of_the_caller),
                                     cmocka_unit_test(audits),
                                     cmocka_unit_test(curvature_that_is_not_finite),
                                     cmocka_unit_test(walls_are_turned_back_from),
                                     cmocka_unit_test(small_mechanics),
                                     cmocka_unit_test(mechanics_of_a_step),
                                     cmocka_unit_test(every_family)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
