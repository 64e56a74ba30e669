/* Problems and solutions whose memory gives out at each place that asks for it: E_MEMORY, nothing
 * leaked, no problem and no point. */
#include "ambulo/tools/tools.h"
#include "support/fail_sites.h"
#include "support/scratch.h"

static fail_sites sites;

static ambulo_status load(const ambulo_allocator *a, void *data) {
  ambulo_problem *p = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_problem_load(data, NULL, 0, a, list, &p);
  assert_int_equal(p != NULL, status == AMBULO_OK);
  assert_int_equal(ambulo_diagnostics_error_count(list) > 0, status != AMBULO_OK);
  ambulo_diagnostics_free(list);
  ambulo_problem_free(p);
  return status;
}

/* one of each kind: devices, holds, feet, references, obstacles, free numbers, tasks */
static void problems(void **state) {
  (void)state;
  static const char *const files[] = {"pendulum_swing", "run_exotendon", "walk_ankle_exoskeleton",
                                      "walk_tracking",  "step_over",     "stairs_up",
                                      "walk_carrying",  "walk_turn"};
  for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
    char path[200];
    (void)snprintf(path, sizeof path, "models/%s.yaml", files[i]);
    print_message("%s: %d places\n", files[i], fail_at_every_site(&sites, load, path, 2));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(problems)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
