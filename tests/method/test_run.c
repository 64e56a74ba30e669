/* Limits and the caller's word end a run, and the first reason stays. */
#include "method/run.h"
#include "support/fail_alloc.h"
#include "support/test.h"

#include <nlopt.h>

static int stop_at_three(void *user, const ambulo_progress *progress) {
  (void)user;
  return progress->iteration >= 3;
}

static void evaluations_run_out(void **state) {
  (void)state;
  ambulo_options options = ambulo_options_default();
  ambulo__run run;
  options.maximum_evaluations = 2;
  ambulo__run_begin(&run, &options);
  assert_int_equal(ambulo__run_count(&run), 0);
  assert_int_equal(ambulo__run_count(&run), 1);
  assert_int_equal(run.ending, AMBULO_ENDING_EVALUATIONS);
}

static void time_runs_out(void **state) {
  (void)state;
  ambulo_options options = ambulo_options_default();
  ambulo__run run;
  options.time_limit = 1e-9;
  ambulo__run_begin(&run, &options);
  run.started -= 1.0;
  assert_int_equal(ambulo__run_over(&run), 1);
  assert_int_equal(run.ending, AMBULO_ENDING_TIME);
}

static void caller_says_stop(void **state) {
  (void)state;
  ambulo_options options = ambulo_options_default();
  ambulo__run run;
  options.progress = stop_at_three;
  ambulo__run_begin(&run, &options);
  run.iterations = 2;
  assert_int_equal(ambulo__run_progress(&run, 1.0, 0.0), 0);
  run.iterations = 3;
  assert_int_equal(ambulo__run_progress(&run, 1.0, 0.0), 1);
  run.evaluations = options.maximum_evaluations;
  assert_int_equal(ambulo__run_over(&run), 1);
  assert_int_equal(run.ending, AMBULO_ENDING_CALLER);
}

/* within an iteration, not only after it */
static void caller_is_asked_while_evaluations_are_counted(void **state) {
  (void)state;
  ambulo_options options = ambulo_options_default();
  ambulo__run run;
  options.progress = stop_at_three;
  ambulo__run_begin(&run, &options);
  run.iterations = 3;
  run.polled_at += 1e9;
  assert_int_equal(ambulo__run_count(&run), 0);
  run.polled_at -= 2e9;
  assert_int_equal(ambulo__run_count(&run), 1);
  assert_int_equal(run.ending, AMBULO_ENDING_CALLER);
}

static int count_calls(void *user, const ambulo_progress *progress) {
  int *calls = user;
  assert_true(progress->seconds >= 0.0 && progress->seconds < 100.0); /* since the start */
  assert_true(isnan(progress->seconds_left));                         /* not known here */
  ++*calls;
  return 0;
}

/* between iterations the caller is asked ten times a second, limits each time */
static void polls_are_rare(void **state) {
  (void)state;
  int calls = 0;
  ambulo_options options = ambulo_options_default();
  ambulo__run run;
  options.progress = count_calls;
  options.user = &calls;
  options.time_limit = 50.0;
  ambulo__run_begin(&run, &options);
  run.polled_at += 1000.0; /* no stall of the machine makes it due */
  assert_int_equal(ambulo__run_poll(&run), 0);
  assert_int_equal(calls, 0);
  run.polled_at -= 2000.0;
  assert_int_equal(ambulo__run_poll(&run), 0);
  assert_int_equal(calls, 1);
  run.started -= 60.0;
  assert_int_equal(ambulo__run_poll(&run), 1);
  assert_int_equal(run.ending, AMBULO_ENDING_TIME);
  assert_int_equal(ambulo__run_poll(NULL), 0);
}

/* what is left to do after a stop may take a tenth of the time used, and at least 0.25 s */
static void a_stop_leaves_some_grace(void **state) {
  (void)state;
  static const struct {
    ambulo_ending ending;
    double used, since; /* s before the stop, and after it */
    int late;
  } cases[] = {{AMBULO_ENDING_TIME, 1000.0, 30.0, 0},   {AMBULO_ENDING_TIME, 1000.0, 130.0, 1},
               {AMBULO_ENDING_TIME, 0.0, 10.0, 1},      {AMBULO_ENDING_CALLER, 1000.0, 130.0, 1},
               {AMBULO_ENDING_CALLER, 1000.0, 30.0, 0}, {AMBULO_ENDING_EVALUATIONS, 0.0, 1000.0, 0},
               {AMBULO_ENDING_NONE, 0.0, 1000.0, 0}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    ambulo_options options = ambulo_options_default();
    ambulo__run run;
    ambulo__run_begin(&run, &options);
    run.ending = cases[i].ending;
    run.stopped = run.ending != AMBULO_ENDING_NONE;
    run.stopped_at = run.started - cases[i].since;
    run.started = run.stopped_at - cases[i].used;
    assert_int_equal(ambulo__run_late(&run), cases[i].late);
  }
}

/* the first of all, and the first since the last point that was good */
static void faults_are_remembered(void **state) {
  (void)state;
  ambulo_options options = ambulo_options_default();
  ambulo__run run;
  ambulo__run_begin(&run, &options);
  for (int node = 1; node <= 4; node++) {
    ambulo_fault fault = {.kind = AMBULO_FAULT_TERM, .node = node};
    if (node == 3) ambulo__run_forgive(&run);
    ambulo__run_fault(&run, &fault);
  }
  assert_int_equal(run.first_fault.node, 1);
  assert_int_equal(run.fault.node, 3);
  assert_int_equal(run.faults, 4);
  assert_int_equal(run.faults_lately, 2);
}

/* The way of a solve in bounded memory: what is left of any number of iterations is reported by the
 * header, and by nothing else. */

static ambulo_iteration iteration(int number, int intervals) {
  return (ambulo_iteration){.iteration = number, .intervals = intervals, .objective = number};
}

/* `count` iterations on each of `grids` grids */
static ambulo__history *filled(int grids, int count) {
  ambulo__history *h = ambulo__history_create(NULL);
  assert_non_null(h);
  for (int g = 0, n = 1; g < grids; g++)
    for (int i = 0; i < count; i++, n++) {
      ambulo_iteration it = iteration(n, 10 * (g + 1));
      ambulo__history_add(h, &it);
      assert_int_equal(h->shown.items[h->shown.count - 1].iteration, n); /* the newest is there */
    }
  return h;
}

static void few_are_all_there(void **state) {
  (void)state;
  ambulo__history *h = filled(4, 64);
  assert_int_equal(h->shown.count, AMBULO__HISTORY_MOST);
  assert_int_equal(h->shown.every, 1);
  for (int i = 0; i < h->shown.count; i++) assert_int_equal(h->shown.items[i].iteration, i + 1);
  free(h);
  h = ambulo__history_create(NULL);
  assert_int_equal(h->shown.count, 0);
  free(h);
  ambulo_iteration one = iteration(1, 1);
  ambulo__history_add(NULL, &one);
}

/* of each grid: those whose number on it is a multiple, in order, and its last */
static void many_are_thinned(void **state) {
  (void)state;
  static const int cases[][2] = {{1, 257}, {1, 1000}, {3, 150}, {3, 5000},
                                 {7, 333}, {2, 129},  {40, 9}};
  for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
    int grids = cases[c][0], each = cases[c][1], at = 0;
    ambulo__history *h = filled(grids, each);
    int every = h->shown.every;
    assert_true(every > 1 && h->shown.count <= AMBULO__HISTORY_MOST);
    assert_true(h->shown.count > AMBULO__HISTORY_MOST / 2 - 2 * grids);
    for (int g = 0; g < grids; g++)
      for (int i = 0; i < each; i++) {
        if (i % every != 0 && i != each - 1) continue;
        assert_int_equal(h->shown.items[at].iteration, g * each + i + 1);
        assert_int_equal(h->shown.items[at++].intervals, 10 * (g + 1));
      }
    assert_int_equal(at, h->shown.count);
    free(h);
  }
}

static void more_grids_than_room(void **state) {
  (void)state;
  ambulo__history *h = filled(1000, 1);
  assert_int_equal(h->shown.count, AMBULO__HISTORY_MOST);
  assert_int_equal(h->shown.items[0].iteration, 1);
  free(h);
}

static void memory_may_run_out(void **state) {
  (void)state;
  fail_alloc memory = fail_alloc_at(0);
  ambulo_allocator allocator = fail_alloc_hook(&memory);
  assert_null(ambulo__history_create(&allocator));
  assert_int_equal(memory.live, 0);
}

/* as docs/solver.md and docs/results.md have them */
static void results_have_names(void **state) {
  (void)state;
  assert_string_equal(ambulo__nlopt_name(NLOPT_FORCED_STOP), "FORCED_STOP");
  assert_string_equal(ambulo__nlopt_name(NLOPT_FTOL_REACHED), "FTOL_REACHED");
  assert_string_equal(ambulo__nlopt_name(NLOPT_OUT_OF_MEMORY), "OUT_OF_MEMORY");
  assert_string_equal(ambulo__nlopt_name(77), "unknown result");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(evaluations_run_out),
      cmocka_unit_test(time_runs_out),
      cmocka_unit_test(caller_says_stop),
      cmocka_unit_test(polls_are_rare),
      cmocka_unit_test(a_stop_leaves_some_grace),
      cmocka_unit_test(faults_are_remembered),
      cmocka_unit_test(caller_is_asked_while_evaluations_are_counted),
      cmocka_unit_test(few_are_all_there),
      cmocka_unit_test(many_are_thinned),
      cmocka_unit_test(more_grids_than_room),
      cmocka_unit_test(memory_may_run_out),
      cmocka_unit_test(results_have_names),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
