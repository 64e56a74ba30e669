/* The moment about the centre of mass: slopes are those of the value, the world origin may be
 * anywhere, and a force through the centre has none. */
#include "contact/spin.h"
#include "support/curved_slopes.h"
#include "support/random_model.h"
#include "support/test.h"

#include <string.h>

enum { CHANNELS = 12, MOMENT = 0, FORCE = 4, CENTER = 8 };

static ambulo__spin random_spin(random_source *random) {
  ambulo__spin spin = {
      .bound = 0.01, .weight = 700.0, .moment = MOMENT, .force = FORCE, .center = CENTER};
  spin.sign = random_between(random, -1.0, 1.0) < 0.0 ? -1.0 : 1.0;
  for (int i = 0; i < 3; i++) spin.axis[i] = random_between(random, -1.0, 1.0);
  return spin;
}

static void random_wrench(random_source *random, double *y) {
  for (int c = 0; c < CHANNELS; c++)
    y[c] = random_between(random, -1.0, 1.0) * (c < CENTER ? 700.0 : 1.0);
}

/* the value is quadratic: central differences have no error but rounding */
static void slopes_are_those_of_the_value(void **state) {
  (void)state;
  random_source random = {23};
  for (int trial = 0; trial < 200; trial++) {
    ambulo__spin spin = random_spin(&random);
    double y[CHANNELS], slope[CHANNELS] = {0.0};
    random_wrench(&random, y);
    (void)ambulo__spin_value(&spin, y, 1, slope);
    ambulo__curved row = {.form = AMBULO__CURVED_SPIN, .of.spin = spin};
    for (int c = 0; c < CHANNELS; c++)
      assert_close(slope[c], slope_by_difference(&row, y, c, 0.125), 1e-13);
  }
}

/* with d added to every place the moment of the same wrench is d x F more */
static void the_origin_may_be_anywhere(void **state) {
  (void)state;
  random_source random = {5};
  for (int trial = 0; trial < 50; trial++) {
    ambulo__spin spin = random_spin(&random);
    double y[CHANNELS], d[3];
    random_wrench(&random, y);
    double before = ambulo__spin_value(&spin, y, 1, NULL);
    const double *f = y + FORCE;
    for (int i = 0; i < 3; i++) d[i] = random_between(&random, -5.0, 5.0);
    for (int i = 0; i < 3; i++) {
      int j = (i + 1) % 3, k = (i + 2) % 3;
      y[CENTER + i] += d[i];
      y[MOMENT + i] += d[j] * f[k] - d[k] * f[j];
    }
    assert_close(ambulo__spin_value(&spin, y, 1, NULL), before, 1e-12);
  }
}

/* a force of a body weight d ahead of the centre tips the body about left by -d; forward is x, up
 * is y, left is -z */
static void it_is_the_moment_about_the_centre(void **state) {
  (void)state;
  ambulo__spin spin = {.axis = {0.0, 0.0, -1.0},
                       .sign = 1.0,
                       .weight = 700.0,
                       .moment = MOMENT,
                       .force = FORCE,
                       .center = CENTER};
  double lanes[8 * CHANNELS] = {0.0}, y[CHANNELS] = {0.0}, d = 0.03;
  y[CENTER] = 1.2;
  y[CENTER + 1] = 0.9;
  y[FORCE] = 80.0;
  y[FORCE + 1] = 700.0;
  /* r x F, and that of d ahead */
  y[MOMENT + 2] = (y[CENTER] + d) * y[FORCE + 1] - y[CENTER + 1] * y[FORCE];
  assert_close(ambulo__spin_value(&spin, y, 1, NULL), -d, 1e-15);
  spin.sign = -1.0;
  spin.bound = 0.01;
  assert_close(ambulo__spin_value(&spin, y, 1, NULL), 0.01 + d, 1e-15);
  for (int c = 0; c < CHANNELS; c++) lanes[8 * c] = y[c];
  assert_close(ambulo__spin_value(&spin, lanes, 8, NULL), 0.01 + d, 1e-15);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(slopes_are_those_of_the_value),
                                     cmocka_unit_test(the_origin_may_be_anywhere),
                                     cmocka_unit_test(it_is_the_moment_about_the_centre)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
