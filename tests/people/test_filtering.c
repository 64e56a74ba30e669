/* Filters on the rows of a file: their rate, and rows that no filter fits. */
#include "people/filtering.h"
#include "support/fail_alloc.h"
#include "support/messages.h"

enum { ROWS = 400 };

static void the_rate_is_that_of_the_rows(void **state) {
  (void)state;
  /* 120 rows a second in milliseconds, rounded to whole ones as files are */
  double time[ROWS], x[ROWS];
  for (int k = 0; k < ROWS; k++) {
    time[k] = 1000.0 + (double)(long)(k * 1000.0 / 120.0 + 0.5);
    x[k] = sin(2.0 * 3.14159265358979 * 6.0 * k / 120.0);
  }
  ambulo__filtering f = {.time = time, .rows = ROWS, .time_unit = 1e-3, .cutoff = 6.0, .order = 4};
  assert_int_equal(ambulo__filter(&f, x, 1, NULL), AMBULO_OK);
  double most = 0.0;
  for (int k = 100; k < 300; k++) most = fmax(most, fabs(x[k]));
  assert_close(most, sqrt(0.5), 2e-3);
  double rounded[4] = {0.0, 0.108, 0.2, 0.3}, y[4] = {1.0, 1.0, 1.0, 1.0};
  f = (ambulo__filtering){.time = rounded, .rows = 4, .time_unit = 1.0, .cutoff = 2.0, .order = 4};
  assert_int_equal(ambulo__filter(&f, y, 1, NULL), AMBULO_OK);
}

static void refuse(ambulo__filtering *f, const char *message) {
  double x[3] = {1.0, 2.0, 4.0};
  f->diagnostics = ambulo_diagnostics_create(NULL);
  f->option = "--filter";
  f->file = "m.csv";
  assert_int_equal(ambulo__filter(f, x, 1, NULL), AMBULO_E_SCHEMA);
  assert_message(f->diagnostics, 0, message);
  assert_message(f->diagnostics, 0, "m.csv: error[E_SCHEMA]: --filter ");
  assert_close(x[2], 4.0, 0.0);
  ambulo_diagnostics_free(f->diagnostics);
}

static void what_cannot_be_filtered_is_refused(void **state) {
  (void)state;
  double even[3] = {0.0, 0.1, 0.2}, uneven[3] = {0.0, 0.1, 0.3};
  ambulo__filtering f = {.time = uneven, .rows = 3, .time_unit = 1.0, .cutoff = 1.0, .order = 4};
  refuse(&f, "with steps of 0.15 s, t = 0.1 s would be 0.15 s");
  f.time = even;
  f.cutoff = 5.0;
  refuse(&f, "is 5 Hz; expected less than half the 10 rows a second");
  f.rows = 1;
  refuse(&f, "needs rows of several times");
  f.rows = 3;
  f.cutoff = 1.0;
  double x[3] = {1.0, 2.0, 4.0};
  fail_alloc memory = fail_alloc_at(0);
  ambulo_allocator hook = fail_alloc_hook(&memory);
  assert_int_equal(ambulo__filter(&f, x, 1, &hook), AMBULO_E_MEMORY);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_rate_is_that_of_the_rows),
                                     cmocka_unit_test(what_cannot_be_filtered_is_refused)};
  return cmocka_run_group_tests_name("inverse/filtering", tests, NULL, NULL);
}
