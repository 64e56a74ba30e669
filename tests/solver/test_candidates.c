/* Of all points the best is returned: valid before invalid, lower before higher, the start where
 * nothing better was found. */
#include "solver/candidates.h"
#include "support/chosen_points.h"

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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_lowest_valid_point_wins),
                                     cmocka_unit_test(a_valid_start_is_not_made_worse),
                                     cmocka_unit_test(a_start_that_is_hardly_better_wins),
                                     cmocka_unit_test(an_invalid_start_never_wins),
                                     cmocka_unit_test(points_that_are_not_finite_are_no_candidates),
                                     cmocka_unit_test(ties_go_to_what_was_found),
                                     cmocka_unit_test(validity_comes_first)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
