/* Of all points the best is returned: valid before invalid, lower before higher, the start where
 * nothing better was found. Options outside their range are refused with their name. */
#include "solver/session.h"
#include "support/chosen_points.h"
#include "support/test.h"

static void expect(chosen *s, int start_wins, const double *want) {
  assert_int_equal(ambulo__candidates_take(&s->c, s->x), start_wins);
  assert_memory_equal(s->x, want, (size_t)s->f.n * sizeof *s->x);
}

static void the_lowest_valid_point_wins(void **state) {
  (void)state;
  chosen s;
  open_chosen(&s);
  ambulo__candidates_offer(&s.c, s.f.engine, s.invalid);
  assert_false(ambulo__candidates_solved(&s.c));
  expect(&s, 0, s.invalid);
  ambulo__candidates_offer(&s.c, s.f.engine, s.good);
  assert_true(ambulo__candidates_solved(&s.c));
  expect(&s, 0, s.good);
  ambulo__candidates_offer(&s.c, s.f.engine, s.invalid);
  expect(&s, 0, s.good);
  ambulo__candidates_offer(&s.c, s.f.engine, s.better);
  expect(&s, 0, s.better);
  ambulo__candidates_offer(&s.c, s.f.engine, s.good);
  expect(&s, 0, s.better);
  close_chosen(&s);
}

static void a_valid_start_is_not_made_worse(void **state) {
  (void)state;
  chosen s;
  open_chosen(&s);
  ambulo__candidates_offer_start(&s.c, s.f.engine, s.good);
  expect(&s, 1, s.good); /* nothing was found */
  ambulo__candidates_offer(&s.c, s.f.engine, s.invalid);
  expect(&s, 1, s.good);
  ambulo__candidates_offer(&s.c, s.f.engine, s.better);
  expect(&s, 0, s.better);
  close_chosen(&s);
  open_chosen(&s);
  ambulo__candidates_offer_start(&s.c, s.f.engine, s.better);
  ambulo__candidates_offer(&s.c, s.f.engine, s.good);
  expect(&s, 1, s.better);
  close_chosen(&s);
}

/* by however little, where its rows hold as well */
static void a_start_that_is_hardly_better_wins(void **state) {
  (void)state;
  chosen s;
  open_chosen(&s);
  double *middle = &s.good[s.f.n / 2], best = s.better[s.f.n / 2], two[2];
  for (int side = 0; side < 2; side++) {
    *middle = best + (side ? 1e-5 : -1e-5);
    assert_true(ambulo__violation_at(s.f.engine, s.good) < 1e-9);
    two[side] = s.f.engine->workspace->objective;
  }
  *middle = best + (two[1] > two[0] ? 1e-5 : -1e-5);
  ambulo__candidates_offer_start(&s.c, s.f.engine, s.better);
  ambulo__candidates_offer(&s.c, s.f.engine, s.good);
  assert_true(s.c.found.objective > s.c.start.objective);
  assert_true(s.c.found.objective < s.c.start.objective * (1.0 + 1e-6));
  s.c.found.violation = s.c.start.violation;
  expect(&s, 1, s.better);
  s.c.found.violation = 0.5 * s.c.start.violation; /* what better rows may cost */
  expect(&s, s.c.start.violation == 0.0, s.c.start.violation == 0.0 ? s.better : s.good);
  close_chosen(&s);
}

static void an_invalid_start_never_wins(void **state) {
  (void)state;
  chosen s;
  open_chosen(&s);
  ambulo__candidates_offer_start(&s.c, s.f.engine, s.invalid);
  ambulo__candidates_offer(&s.c, s.f.engine, s.good);
  expect(&s, 0, s.good);
  close_chosen(&s);
}

static void points_that_are_not_finite_are_no_candidates(void **state) {
  (void)state;
  chosen s;
  open_chosen(&s);
  double kept = s.invalid[1];
  s.invalid[1] = NAN;
  ambulo__candidates_offer_start(&s.c, s.f.engine, s.invalid);
  ambulo__candidates_offer(&s.c, s.f.engine, s.invalid);
  assert_true(isinf(ambulo__violation_at(s.f.engine, s.invalid)));
  ambulo__candidates_offer(&s.c, s.f.engine, s.good);
  expect(&s, 0, s.good);
  s.invalid[1] = kept;
  close_chosen(&s);
}

/* a start has to be better by a millionth of either sign than a point whose rows hold better, or at
 * all where they hold no better; without any point x stays */
static void ties_go_to_what_was_found(void **state) {
  (void)state;
  static const double cases[][3] = {
      {1.0, 5e-7, 0.0}, {1.0, 2e-6, 1.0}, {-1.0, 5e-7, 0.0}, {-1.0, 2e-6, 1.0}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    double start = 1.0, found = 2.0, x = 0.0;
    ambulo__candidates c = {.n = 1, .tolerance = 1e-6};
    c.start = (ambulo__candidate){.x = &start, .objective = cases[i][0]};
    c.start.violation = 1e-8;
    c.found = (ambulo__candidate){.x = &found, .objective = cases[i][0] + cases[i][1]};
    assert_int_equal(ambulo__candidates_take(&c, &x), cases[i][2] > 0.0);
    assert_true(x == (cases[i][2] > 0.0 ? start : found));
    c.found.violation = 1e-8;
    assert_int_equal(ambulo__candidates_take(&c, &x), 1);
    c.start.violation = c.found.violation = HUGE_VAL;
    x = 3.0;
    assert_int_equal(ambulo__candidates_take(&c, &x), 0);
    assert_true(x == 3.0);
  }
}

/* what violates the rows is no better for a lower objective; equalities are rows too */
static void validity_comes_first(void **state) {
  (void)state;
  chosen s;
  open_chosen(&s);
  ambulo__candidates_offer(&s.c, s.f.engine, s.good);
  s.c.found.objective = HUGE_VAL;
  ambulo__candidates_offer(&s.c, s.f.engine, s.invalid);
  expect(&s, 0, s.good);
  memcpy(s.x, s.better, (size_t)s.f.n * sizeof *s.x);
  s.x[0] += 1e-5;
  assert_true(ambulo__violation_at(s.f.engine, s.x) > 1e-6);
  close_chosen(&s);
}

static void refuse(ambulo_options options, const char *name) {
  ambulo_options own;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo__options_own(NULL, &options, list, &own), AMBULO_E_ARGUMENT);
  const ambulo_diagnostic *message = ambulo_diagnostics_get(list, 0);
  assert_non_null(message);
  if (!strstr(message->message, name)) print_error("%s lacks %s\n", message->message, name);
  assert_non_null(strstr(message->message, name));
  ambulo_diagnostics_free(list);
}

static void defaults_pass(void **state) {
  (void)state;
  ambulo_options own, options = ambulo_options_default();
  assert_int_equal(ambulo__options_own(NULL, &options, NULL, &own), AMBULO_OK);
}

static void each_fault_is_named(void **state) {
  (void)state;
  ambulo_options zeroed = {0}, o = ambulo_options_default();
  refuse(zeroed, "ambulo_options_default");
  o.algorithm = (ambulo_algorithm)9;
  refuse(o, "algorithm");
  o = ambulo_options_default();
  o.maximum_evaluations = 0;
  refuse(o, "maximum_evaluations");
  o = ambulo_options_default();
  o.time_limit = 0.0;
  refuse(o, "solver.time_limit is 0 s; expected 1e-09 to inf, or AMBULO_OFF");
  o = ambulo_options_default();
  o.maximum_memory = -1.0;
  refuse(o, "solver.maximum_memory is -1 bytes; expected 1 to inf, or AMBULO_OFF");
  o = ambulo_options_default();
  static const double no_tolerance[] = {0.0, -1e-6, 1e-300, 1e-15, 1.1, 1e300, INFINITY, NAN};
  for (size_t i = 0; i < sizeof no_tolerance / sizeof *no_tolerance; i++) {
    o = ambulo_options_default();
    o.feasibility_tolerance = no_tolerance[i];
    refuse(o, "feasibility_tolerance");
    o = ambulo_options_default();
    o.optimality_tolerance = no_tolerance[i];
    refuse(o, "optimality_tolerance");
  }
  o = ambulo_options_default();
  o.dense_samples = 0;
  refuse(o, "dense_samples");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_lowest_valid_point_wins),
      cmocka_unit_test(a_valid_start_is_not_made_worse),
      cmocka_unit_test(a_start_that_is_hardly_better_wins),
      cmocka_unit_test(an_invalid_start_never_wins),
      cmocka_unit_test(points_that_are_not_finite_are_no_candidates),
      cmocka_unit_test(ties_go_to_what_was_found),
      cmocka_unit_test(validity_comes_first),
      cmocka_unit_test(defaults_pass),
      cmocka_unit_test(each_fault_is_named),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
