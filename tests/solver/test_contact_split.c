/* The tangent of how contacts share a wrench: against complex steps of the reference along random
 * directions in all that it depends on, and along each kind alone. */
#include "solver/contact_split.h"
#include "support/contact_reference.h"
#include "support/random_model.h"
#include "support/test.h"

enum { numbers = sizeof(ambulo__contact_state) / sizeof(double), cases = 200 };

static ambulo__contact_state random_state(random_source *source, int count) {
  ambulo__contact_state s;
  for (int i = 0; i < 6; i++) s.wrench[i] = random_between(source, -900, 900);
  for (int i = 0; i < 3; i++) s.center[i] = random_between(source, 0.8, 1.2);
  for (int k = 0; k < AMBULO__MOST_CONTACTS; k++) {
    s.weight[k] = k < count ? random_between(source, 0.01, 3) : 0;
    for (int i = 0; i < 3; i++) s.place[k][i] = random_between(source, -0.5, 0.5);
  }
  s.moment_arm = random_between(source, 0.05, 0.3);
  s.slant = random_between(source, 0.15, 1.2);
  return s;
}

/* The reference at state + i step change. */
static void reference_at(int count, const ambulo__contact_state *state,
                         const ambulo__contact_state *change, double step, scalar share[][6]) {
  scalar z[numbers], ground[3 + 4 * reference_most_contacts] = {0.1, -0.2, 0.3};
  const double *at = (const double *)state, *by = (const double *)change;
  for (int i = 0; i < numbers; i++) z[i] = at[i] + step * by[i] * I;
  const scalar *weight = z + 9, *place = weight + AMBULO__MOST_CONTACTS;
  const scalar *law = place + 3 * AMBULO__MOST_CONTACTS;
  reference_contacts contacts = {.count = count, .moment_arm = law[0], .slant = law[1]};
  reference_wrench root;
  for (int i = 0; i < 3; i++) {
    root.moment[i] = z[i];
    root.force[i] = z[3 + i];
  }
  for (int k = 0; k < count; k++) {
    ground[3 + 4 * k] = weight[k];
    for (int i = 0; i < 3; i++) ground[4 + 4 * k + i] = place[3 * k + i];
  }
  reference_share(&contacts, ground, &root, z + 6, share);
}

static void check(int count, const ambulo__contact_state *state,
                  const ambulo__contact_state *change) {
  double share[AMBULO__MOST_CONTACTS][6], tangent[AMBULO__MOST_CONTACTS][6], size = 1, slope = 1;
  scalar want[AMBULO__MOST_CONTACTS][6];
  const double step = 1e-40;
  ambulo__contact_split_tangent(count, state, change, share, tangent);
  reference_at(count, state, change, step, want);
  for (int k = 0; k < count; k++) {
    for (int i = 0; i < 6; i++) {
      size = fmax(size, fabs(creal(want[k][i])));
      slope = fmax(slope, fabs(cimag(want[k][i]) / step));
    }
  }
  for (int k = 0; k < count; k++) {
    for (int i = 0; i < 6; i++) {
      assert_close(share[k][i] / size, creal(want[k][i]) / size, 1e-11);
      assert_close(tangent[k][i] / slope, cimag(want[k][i]) / step / slope, 1e-10);
    }
  }
}

static void tangents_equal_complex_steps(void **state) {
  (void)state;
  random_source source = {41};
  for (int i = 0; i < cases; i++) {
    int count = 1 + i % AMBULO__MOST_CONTACTS;
    ambulo__contact_state at = random_state(&source, count), by = random_state(&source, count);
    for (int k = 0; k < count; k++) by.weight[k] -= 1.5;
    check(count, &at, &by);
  }
}

/* wrench, centre of mass, weights, places, reach, slant */
static void each_kind_alone(void **state) {
  (void)state;
  static const int ends[] = {0, 6, 9, 15, 33, 34, 35};
  random_source source = {43};
  assert_int_equal(numbers, 35);
  for (int kind = 0; kind < 6; kind++) {
    for (int i = 0; i < 20; i++) {
      ambulo__contact_state at = random_state(&source, 3), all = random_state(&source, 3), by;
      memset(&by, 0, sizeof by);
      memcpy((double *)&by + ends[kind], (double *)&all + ends[kind],
             (size_t)(ends[kind + 1] - ends[kind]) * sizeof(double));
      check(3, &at, &by);
    }
  }
}

static void nothing_changes_in_flight(void **state) {
  (void)state;
  random_source source = {47};
  double share[AMBULO__MOST_CONTACTS][6], tangent[AMBULO__MOST_CONTACTS][6];
  ambulo__contact_state at = random_state(&source, 0), by = random_state(&source, 4);
  ambulo__contact_split_tangent(4, &at, &by, share, tangent);
  for (int k = 0; k < 4; k++) {
    for (int i = 0; i < 6; i++) {
      assert_close(share[k][i], 0, 0);
      assert_close(tangent[k][i], 0, 0);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(tangents_equal_complex_steps),
                                     cmocka_unit_test(each_kind_alone),
                                     cmocka_unit_test(nothing_changes_in_flight)};
  return cmocka_run_group_tests_name("sensitivity/contact_split", tests, NULL, NULL);
}
