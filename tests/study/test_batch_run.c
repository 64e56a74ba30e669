/* Which case may start: shards, chains, records that are taken, and those that are not; how many
 * processes. */
#include "base/machine.h"
#include "study/batch.h"
#include "support/sweep_files.h"

/* two chains of three along T, by n */
static const char chains[] =
    "axes:\n  - {key: time.intervals, name: n, values: [8, 10]}\n"
    "  - {key: time.duration, name: T, values: [1, 2, 3]}\nstart_from: neighbour\nalong: T\n";
static const char front_problem[] =
    "ambulo: 1\nkind: problem\nname: swing\nmodel: one.yaml\n"
    "angles: radians\ntime: {duration: 1.0, intervals: 10}\ntrajectory: {intervals: 6}\n"
    "ends: {initial: {pin: 0}, final: {pin: 1}}\n"
    "objective:\n  - {term: torque_squared, weight: 1}\n  - {term: acceleration, weight: 1}\n";
static ambulo_allocator plain;

static ambulo__supervisor open_run(void **state, const ambulo_sweep *sweep, int shard, int shards) {
  plain = ambulo__allocator_or_default(NULL);
  ambulo__supervisor batch = {.sweep = sweep,
                              .directory = *state,
                              .options = ambulo_batch_options_default(),
                              .allocator = &plain,
                              .workers = 1};
  batch.options.shard = shard;
  batch.options.shards = shards;
  assert_int_equal(ambulo__queue_open(&batch), AMBULO_OK);
  return batch;
}

static ambulo_sweep *sweep_of(void **state, const char *text) {
  ambulo_sweep *sweep = NULL;
  assert_int_equal(sweep_load(state, text, NULL, &sweep), AMBULO_OK);
  return sweep;
}

/* what the end of its worker does */
static void finish(ambulo__supervisor *batch, int index, int solved) {
  batch->of[index].origin = ambulo__queue_origin(batch, index);
  batch->of[index].state = AMBULO__CASE_DONE;
  batch->of[index].solved = (unsigned char)solved;
}

/* a record without a result folder: of a case that ended without one, or of one that is damaged */
static void record(ambulo__supervisor *batch, int index, const char *case_state,
                   unsigned long long origin) {
  const char *id = batch->sweep->cases[index].id;
  ambulo__record r = {
      .key = batch->sweep->cases[index].key, .origin = origin, .limit_seconds = 5.0};
  char folder[SCRATCH_PATH + 64];
  snprintf(r.state, sizeof r.state, "%s", case_state);
  snprintf(folder, sizeof folder, "%s/cases", batch->directory);
  (void)mkdir(folder, 0777);
  snprintf(folder, sizeof folder, "%s/cases/%s", batch->directory, id + strlen(id) - 2);
  (void)mkdir(folder, 0777);
  assert_int_equal(ambulo__record_write(batch->directory, id, &r, "", &plain, NULL), AMBULO_OK);
}

static void a_chain_goes_on_in_its_order(void **state) {
  ambulo_sweep *sweep = sweep_of(state, chains);
  ambulo__supervisor batch = open_run(state, sweep, 1, 1);
  assert_int_equal(batch.progress.cases, 6);
  assert_int_equal(ambulo__queue_next(&batch), 0);
  batch.of[0].state = AMBULO__CASE_RUNNING;
  batch.progress.running = 1;
  assert_int_equal(ambulo__queue_next(&batch), 3);
  assert_int_equal(ambulo__queue_next(&batch), -1);
  finish(&batch, 0, 1);
  assert_int_equal(ambulo__queue_follower(&batch, 0), 1);
  assert_int_equal(ambulo__queue_start_of(&batch, 1), 0);
  finish(&batch, 1, 0);
  assert_int_equal(ambulo__queue_follower(&batch, 1), 2);
  /* past one without a solution, to the nearest with one */
  assert_int_equal(ambulo__queue_start_of(&batch, 2), 0);
  assert_int_equal(ambulo__queue_start_of(&batch, 3), -1);
  finish(&batch, 2, 1);
  assert_int_equal(ambulo__queue_follower(&batch, 2), -1);
  ambulo__queue_free(&batch);
  ambulo_sweep_free(sweep);
}

static void shards_take_whole_chains_and_every_case_once(void **state) {
  ambulo_sweep *sweep = sweep_of(state, chains);
  int taken[6] = {0};
  for (int shard = 1; shard <= 4; shard++) {
    ambulo__supervisor batch = open_run(state, sweep, shard, 4);
    assert_int_equal(batch.progress.cases, shard <= 2 ? 3 : 0);
    for (int k = 0; k < 6; k++) {
      taken[k] += batch.of[k].state != AMBULO__CASE_ELSEWHERE;
      int previous = sweep->cases[k].previous;
      if (previous >= 0) assert_int_equal(batch.of[k].state, batch.of[previous].state);
    }
    ambulo__queue_free(&batch);
  }
  for (int k = 0; k < 6; k++) assert_int_equal(taken[k], 1);
  ambulo_sweep_free(sweep);
}

static void records_are_taken_when_they_fit(void **state) {
  ambulo_sweep *sweep = sweep_of(state, chains);
  ambulo__supervisor batch = open_run(state, sweep, 1, 1);
  record(&batch, 0, "crashed", 0);
  record(&batch, 1, "crashed", 0);
  record(&batch, 3, "timeout", 0);
  record(&batch, 4, "crashed", 17); /* began from something else than zero */
  ambulo__queue_free(&batch);
  batch = open_run(state, sweep, 1, 1);
  assert_int_equal(batch.progress.done, 2);
  assert_int_equal(batch.progress.failed, 2);
  assert_int_equal(ambulo__queue_next(&batch), 2);
  assert_int_equal(ambulo__queue_next(&batch), 3); /* 3 was cut off after 5 s: no limit now */
  finish(&batch, 3, 1);
  assert_int_equal(ambulo__queue_follower(&batch, 3), 4);
  ambulo__queue_free(&batch);
  ambulo_sweep_free(sweep);
}

/* it counts only once the case before it is done, and leads on to the one behind it */
static void a_record_waits_for_the_case_before_it(void **state) {
  ambulo_sweep *sweep = sweep_of(state, chains);
  ambulo__supervisor batch = open_run(state, sweep, 1, 1);
  record(&batch, 1, "crashed", 0);
  ambulo__queue_free(&batch);
  batch = open_run(state, sweep, 1, 1);
  assert_int_equal(batch.progress.done, 0);
  finish(&batch, 0, 0);
  assert_int_equal(ambulo__queue_follower(&batch, 0), 2);
  assert_int_equal(batch.progress.done, 1);
  batch.of[1].state = AMBULO__CASE_WAITING;
  finish(&batch, 0, 1); /* with a solution it would have begun from that */
  assert_int_equal(ambulo__queue_follower(&batch, 0), 1);
  ambulo__queue_free(&batch);
  ambulo_sweep_free(sweep);
}

static void as_asked_or_as_the_machine_has(void **state) {
  (void)state;
  assert_int_equal(ambulo_batch_workers(1, 0), 1);
  assert_true(ambulo_batch_workers(0, 1) >= 1);
  assert_true(ambulo_batch_workers(0, 1) <= sysconf(_SC_NPROCESSORS_ONLN));
  assert_int_equal(ambulo_batch_workers(3, 1), 3);
}

static void as_memory_allows(void **state) {
  (void)state;
  double megabytes = ambulo__free_megabytes();
  if (megabytes <= 0.0) skip(); /* the system does not tell */
  assert_int_equal(ambulo_batch_workers(64, (int)(2.0 * megabytes)), 1);
  assert_true(ambulo_batch_workers(64, (int)(0.3 * megabytes)) <= 6);
}

/* options that mean nothing: of batches, fronts and fits; nothing is made */
static void arguments(void **state) {
  ambulo_sweep *sweeps[2];
  sweeps[0] = sweep_of(state, chains);
  assert_int_equal(sweep_load_over(state, front_problem,
                                   "front: {terms: [torque_squared, acceleration], points: 5}\n",
                                   NULL, NULL, &sweeps[1]),
                   AMBULO_OK);
  const char *folder = scratch_path(state, "out");
  int entries = entries_in(*state);
  for (int s = 0; s < 2; s++) {
    for (int i = 0; i < 12; i++) {
      ambulo_batch_options o = ambulo_batch_options_default();
      if (i == 0) o.size = 0;
      if (i == 1) o.shards = 0;
      if (i == 2) o.shard = 0;
      if (i == 3) o.shard = o.shards + 1;
      if (i == 4) o.workers = -1;
      if (i == 5) o.workers = 4097;
      if (i == 6) o.case_seconds = 0.0;
      if (i == 7) o.case_seconds = -1.0;
      if (i == 8) o.case_megabytes = -1;
      if (i == 9) o.grace = -1.0;
      ambulo_status status = ambulo_batch_run(i == 10 ? NULL : sweeps[s], i == 11 ? NULL : folder,
                                              &o, NULL, NULL, NULL);
      if (status != AMBULO_E_ARGUMENT) print_error("option %d of %d\n", i, s);
      assert_int_equal(status, AMBULO_E_ARGUMENT);
    }
    ambulo_sweep_free(sweeps[s]);
  }
  assert_int_equal(entries_in(*state), entries);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(arguments),
      TEST(a_chain_goes_on_in_its_order),
      TEST(shards_take_whole_chains_and_every_case_once),
      TEST(records_are_taken_when_they_fit),
      TEST(a_record_waits_for_the_case_before_it),
      cmocka_unit_test(as_asked_or_as_the_machine_has),
      cmocka_unit_test(as_memory_allows),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
