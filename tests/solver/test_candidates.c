/* Of all points the best is returned: valid before invalid, lower before higher, the start where
 * nothing better was found. */
#include "solver/candidates.h"
#include "support/engine_fixture.h"
#include "support/fail_alloc.h"

typedef struct chosen {
  engine_fixture f;
  ambulo__candidates c;
  double *good, *better, *invalid, *x;
} chosen;

/* points of the swing of the pendulum: its optimum, a valid point beside it, and one that is not */
static void open_chosen(chosen *s) {
  ambulo_result *result = NULL;
  memset(s, 0, sizeof *s);
  engine_open(&s->f, "pendulum_swing");
  size_t n = (size_t)s->f.n;
  s->good = calloc(n, sizeof *s->good);
  s->better = calloc(n, sizeof *s->better);
  s->invalid = calloc(n, sizeof *s->invalid);
  s->x = calloc(n, sizeof *s->x);
  assert_int_equal(ambulo_solve(s->f.problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  memcpy(s->better, ambulo_result_x(result), n * sizeof *s->x);
  memcpy(s->good, s->better, n * sizeof *s->x);
  s->good[n / 2] += 0.01; /* control points in the middle are free */
  memcpy(s->invalid, s->better, n * sizeof *s->x);
  s->invalid[0] += 0.2; /* the first is prescribed */
  ambulo_result_free(result);
  assert_int_equal(ambulo__candidates_create(&s->c, s->f.engine), AMBULO_OK);
}

static void close_chosen(chosen *s) {
  free(s->good);
  free(s->better);
  free(s->invalid);
  free(s->x);
  engine_close(&s->f);
}

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

static void audits_decide_between_two(void **state) {
  (void)state;
  chosen s;
  int better = -1;
  open_chosen(&s);
  ambulo_options o = ambulo_options_default();
  const ambulo_problem *p = s.f.problem;
  assert_int_equal(ambulo__is_better(p, &o, s.good, s.better, NULL, &better), AMBULO_OK);
  assert_int_equal(better, 1);
  assert_int_equal(ambulo__is_better(p, &o, s.better, s.good, NULL, &better), AMBULO_OK);
  assert_int_equal(better, 0);
  assert_int_equal(ambulo__is_better(p, &o, s.invalid, s.good, NULL, &better), AMBULO_OK);
  assert_int_equal(better, 1);
  close_chosen(&s);
}

/* "not better" is no answer to a lack of memory */
static void lack_of_memory_is_said(void **state) {
  (void)state;
  chosen s;
  open_chosen(&s);
  ambulo_options o = ambulo_options_default();
  int refused = 0;
  for (long k = 0; k < 2000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    int better = -1;
    ambulo_status status =
        ambulo__is_better(s.f.problem, &o, s.good, s.better, &allocator, &better);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) {
      assert_int_equal(status, AMBULO_OK);
      assert_int_equal(better, 1);
      break;
    }
    refused++;
    assert_int_equal(status, AMBULO_E_MEMORY);
    assert_int_equal(better, 0);
  }
  assert_true(refused > 20);
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
  int better = -1;
  open_chosen(&s);
  ambulo_options o = ambulo_options_default();
  ambulo__candidates_offer(&s.c, s.f.engine, s.good);
  s.c.found.objective = HUGE_VAL;
  ambulo__candidates_offer(&s.c, s.f.engine, s.invalid);
  expect(&s, 0, s.good);
  memset(s.invalid, 0, (size_t)s.f.n * sizeof *s.invalid); /* hangs still: costs nothing */
  assert_int_equal(ambulo__is_better(s.f.problem, &o, s.invalid, s.better, NULL, &better),
                   AMBULO_OK);
  assert_int_equal(better, 1);
  memcpy(s.x, s.better, (size_t)s.f.n * sizeof *s.x);
  s.x[0] += 1e-5;
  assert_true(ambulo__violation_at(s.f.engine, s.x) > 1e-6);
  close_chosen(&s);
}

/* rows that hold more closely may cost a hundred-thousandth, no more */
static void closer_rows_have_a_price(void **state) {
  (void)state;
  chosen s;
  open_chosen(&s);
  ambulo_options o = ambulo_options_default();
  o.feasibility_tolerance = 0.1; /* all of these pass */
  o.optimality_tolerance = 1.0;
  size_t n = (size_t)s.f.n;
  double change[2], optimum = 0.0;
  for (int k = 0; k < 3; k++) { /* objective by the first unknown, which is prescribed */
    memcpy(s.x, s.better, n * sizeof *s.x);
    s.x[0] += k == 0 ? 0.0 : k == 1 ? 1e-5 : -1e-5;
    assert_true(ambulo__violation_at(s.f.engine, s.x) < 0.1);
    double objective = s.f.engine->workspace->objective;
    if (k == 0)
      optimum = objective;
    else
      change[k - 1] = objective / optimum - 1.0;
  }
  double slope = (change[0] - change[1]) / 2e-5;
  for (int k = 0; k < 2; k++) {
    int better = -1;
    memcpy(s.x, s.better, n * sizeof *s.x);
    s.x[0] -= (k ? 2e-5 : 5e-6) / slope; /* cheaper by that */
    assert_int_equal(ambulo__is_better(s.f.problem, &o, s.x, s.better, NULL, &better), AMBULO_OK);
    assert_int_equal(better, k == 0);
  }
  close_chosen(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_lowest_valid_point_wins),
                                     cmocka_unit_test(a_valid_start_is_not_made_worse),
                                     cmocka_unit_test(a_start_that_is_hardly_better_wins),
                                     cmocka_unit_test(an_invalid_start_never_wins),
                                     cmocka_unit_test(points_that_are_not_finite_are_no_candidates),
                                     cmocka_unit_test(audits_decide_between_two),
                                     cmocka_unit_test(lack_of_memory_is_said),
                                     cmocka_unit_test(ties_go_to_what_was_found),
                                     cmocka_unit_test(validity_comes_first),
                                     cmocka_unit_test(closer_rows_have_a_price)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
