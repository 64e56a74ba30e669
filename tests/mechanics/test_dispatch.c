/* Choosing a kernel set: names, the environment's word, and nothing half-built. */
#include <stdlib.h>

#include "mechanics/kernels.h"
#include "ambulo/mechanics.h"
#include "mechanics/plan.h"
#include "support/test.h"

static const char *const names[] = {"avx512", "avx2", "baseline", "scalar"};

static void sets_are_complete_and_named(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    const ambulo__kernels *set = ambulo__kernels_by_name(names[i]);
    if (!set) continue;
    assert_string_equal(set->name, names[i]);
    assert_true(set->outputs && set->forward && set->reverse && set->jacobian);
  }
  assert_non_null(ambulo__kernels_by_name("baseline"));
  assert_non_null(ambulo__kernels_by_name("scalar"));
  assert_null(ambulo__kernels_by_name("avx1024"));
  assert_null(ambulo__kernels_by_name(NULL));
}

static void the_fastest_is_chosen_unless_told(void **state) {
  (void)state;
  unsetenv("AMBULO_ISA");
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    const ambulo__kernels *set = ambulo__kernels_by_name(names[i]);
    if (!set) continue;
    assert_ptr_equal(ambulo__kernels_select(), set);
    break;
  }
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    if (!ambulo__kernels_by_name(names[i])) continue;
    setenv("AMBULO_ISA", names[i], 1);
    assert_string_equal(ambulo__instruction_set(), names[i]);
  }
  setenv("AMBULO_ISA", "nonsense", 1);
  const char *chosen = ambulo__instruction_set();
  unsetenv("AMBULO_ISA");
  assert_string_equal(chosen, ambulo__instruction_set());
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(sets_are_complete_and_named),
                                     cmocka_unit_test(the_fastest_is_chosen_unless_told)};
  return cmocka_run_group_tests_name("mechanics/dispatch", tests, NULL, NULL);
}
