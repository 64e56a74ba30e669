/* How many processes: as asked, and no more than memory allows. */
#include "study/batch_machine.h"
#include "ambulo/tools/batch.h"
#include "base/machine.h"
#include "support/test.h"

static void as_asked_or_as_the_machine_has(void **state) {
  (void)state;
  assert_true(ambulo__usable_processors() >= 1);
  assert_int_equal(ambulo__worker_count(1, 0), 1);
  assert_true(ambulo__worker_count(0, 1) >= 1);
  assert_true(ambulo__worker_count(0, 1) <= ambulo__usable_processors());
  assert_int_equal(ambulo_batch_workers(1, 1), 1);
}

static void as_memory_allows(void **state) {
  (void)state;
  double megabytes = ambulo__free_megabytes();
  if (megabytes <= 0.0) skip(); /* the system does not tell */
  assert_int_equal(ambulo__worker_count(64, (int)(2.0 * megabytes)), 1);
  assert_true(ambulo__worker_count(64, (int)(0.3 * megabytes)) <= 6);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(as_asked_or_as_the_machine_has),
                                     cmocka_unit_test(as_memory_allows)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
