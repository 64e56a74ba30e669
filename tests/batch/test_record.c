/* Records: written and read back, refused when damaged; what lifts a limit. */
#include "batch/record.h"
#include "support/scratch.h"

static const char id[] = "000000001-0000abcd";

static ambulo__record sample(void) {
  ambulo__record r = {.key = 0xfedcba9876543210ULL,
                      .state = "timeout",
                      .exit_code = -1,
                      .signal = 9,
                      .start = "000000000-00000000",
                      .origin = 0x123456789abcdef0ULL,
                      .seconds = 1.25,
                      .limit_seconds = 1.0,
                      .violation = 0.1,
                      .summary = 0x1ULL};
  return r;
}

static void make_folders(void **state) {
  assert_int_equal(mkdir(scratch_path(state, "cases"), 0777), 0);
  assert_int_equal(mkdir(scratch_path(state, "cases/cd"), 0777), 0);
}

static void a_round_trip(void **state) {
  const ambulo_allocator plain = ambulo__allocator_or_default(NULL);
  ambulo__record r = sample(), back;
  make_folders(state);
  assert_int_equal(ambulo__record_read(*state, id, &plain, &back), AMBULO__RECORD_ABSENT);
  assert_int_equal(ambulo__record_write(*state, id, &r, &plain, NULL), AMBULO_OK);
  assert_int_equal(ambulo__record_read(*state, id, &plain, &back), AMBULO__RECORD_READ);
  assert_true(back.origin == r.origin);
  assert_true(back.key == r.key && back.summary == r.summary && back.signal == 9);
  assert_string_equal(back.state, "timeout");
  assert_string_equal(back.start, r.start);
  assert_true(back.seconds == 1.25 && back.violation == 0.1 && back.exit_code == -1);
  assert_false(ambulo__record_summary_intact(*state, id, &back, &plain));
}

static void damage_is_seen(void **state) {
  const ambulo_allocator plain = ambulo__allocator_or_default(NULL);
  ambulo__record r = sample(), back;
  make_folders(state);
  const char *path = scratch_path(state, "cases/cd/000000001-0000abcd.json");
  assert_int_equal(ambulo__record_write(*state, id, &r, &plain, NULL), AMBULO_OK);
  assert_int_equal(truncate(path, 100), 0);
  assert_int_equal(ambulo__record_read(*state, id, &plain, &back), AMBULO__RECORD_CORRUPT);
  scratch_write(path, "{\"id\": \"another\"}\n");
  assert_int_equal(ambulo__record_read(*state, id, &plain, &back), AMBULO__RECORD_CORRUPT);
}

static void wider_limits_reopen_a_case(void **state) {
  (void)state;
  ambulo__record r = sample();
  assert_false(ambulo__record_was_cut(&r, 1.0, 0));
  assert_false(ambulo__record_was_cut(&r, 0.5, 0));
  assert_true(ambulo__record_was_cut(&r, 2.0, 0));
  assert_true(ambulo__record_was_cut(&r, 0.0, 0));
  snprintf(r.state, sizeof r.state, "optimal");
  assert_false(ambulo__record_was_cut(&r, 0.0, 0));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(a_round_trip, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(damage_is_seen, scratch_open, scratch_close),
      cmocka_unit_test(wider_limits_reopen_a_case),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
