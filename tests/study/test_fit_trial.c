/* Trials: their memory, copies, the cost. */
#include "support/fit_task.h"

static void blocks_do_not_overlap(void **state) {
  (void)state;
  fail_alloc memory = fail_alloc_at(-1);
  ambulo_allocator allocator = fail_alloc_hook(&memory);
  ambulo__fit_sizes sizes = {3, 7, 3, 5};
  ambulo__fit_trial *t = ambulo__fit_trials_make(&sizes, 4, &allocator);
  for (int i = 0; i < 4; i++) {
    assert_true(t[i].u[2] == 0.0 && !t[i].complete && isnan(t[i].distance));
    assert_int_equal(t[i].index[2], -1);
    assert_true(isnan(t[i].apart[0]));
  }
  for (int i = 0; i < 4; i++) {
    for (int k = 0; k < 3; k++) t[i].u[k] = i;
    for (int k = 0; k < 7; k++) t[i].residual[k] = 10 + i;
    for (int k = 0; k < 3; k++) t[i].apart[k] = 20 + i;
    for (int k = 0; k < 15; k++) t[i].score[k] = (ambulo__fit_score){.z = 30 + i};
    for (int k = 0; k < 3; k++) t[i].index[k] = 40 + i;
    for (int k = 0; k < 3; k++) t[i].solved[k] = (unsigned char)(50 + i);
  }
  ambulo__fit_trial_copy(&sizes, &t[1], &t[3]);
  for (int i = 0; i < 4; i++) {
    int from = i == 3 ? 1 : i;
    for (int k = 0; k < 3; k++) assert_true(t[i].u[k] == from);
    for (int k = 0; k < 7; k++) assert_true(t[i].residual[k] == 10 + from);
    for (int k = 0; k < 3; k++) assert_true(t[i].apart[k] == 20 + from);
    for (int k = 0; k < 15; k++) assert_true(t[i].score[k].z == 30 + from);
    for (int k = 0; k < 3; k++) assert_int_equal(t[i].index[k], 40 + from);
    for (int k = 0; k < 3; k++) assert_int_equal(t[i].solved[k], 50 + from);
  }
  allocator.resize(allocator.user, t, 0);
  assert_int_equal(memory.live, 0);
}

static void the_cost(void **state) {
  (void)state;
  fit_made_up w = {.scale = 5.0};
  ambulo__fit_trial *t;
  fit_made_up_open(&w, &t);
  w.task.ridge = 0.5;
  t->distance = 2.0;
  t->u[0] = 3.0;
  t->u[1] = -1.0;
  assert_close(ambulo__fit_cost(&w.task, t), 2.0 + 0.5 * 10.0 / 2.0, 1e-15);
  fit_made_up_close(&w, t);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(blocks_do_not_overlap),
                                     cmocka_unit_test(the_cost)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
