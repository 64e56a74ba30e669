/* Markers of a TRC file: what is taken, and every way to be refused. */
#include "formats/marker_file.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/test.h"

#include <math.h>

#define TOP "PathFileType\t4\t(X/Y/Z)\tm.trc\nDataRate\tNumFrames\tUnits\n"
#define NAMES "Frame#\tTime\tA\t\t\tB\t\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n"

static ambulo_status parse(const char *text, const ambulo_allocator *allocator,
                           ambulo_diagnostics *list, ambulo__motion **motion) {
  return ambulo__markers_parse(text, strlen(text), "m.trc", allocator, list, motion);
}

static void markers_become_columns_in_metres(void **state) {
  (void)state;
  static const struct {
    const char *units;
    double metres;
  } cases[] = {{"100\t2\tmm\n", 1e-3}, {"100\t2\tcm\n", 1e-2}, {"100\t2\tm\r\n", 1.0}};
  for (int i = 0; i < 3; i++) {
    char text[512];
    ambulo__motion *m = NULL;
    (void)snprintf(text, sizeof text, "%s%s%s", TOP, cases[i].units,
                   NAMES "\n1\t0\t1\t2\t3\t\t\t\n2\t0.01\t4\t5\t6\t7\tnan\t9\n\n");
    assert_int_equal(parse(text, NULL, NULL, &m), AMBULO_OK);
    assert_int_equal(m->rows, 2);
    assert_int_equal(m->columns, 6);
    assert_string_equal(m->names[0], "A.x");
    assert_string_equal(m->names[5], "B.z");
    assert_close(m->time[1], 0.01, 0.0);
    assert_close(m->values[2], 3.0 * cases[i].metres, 1e-15);
    assert_close(m->values[6 + 3], 7.0 * cases[i].metres, 1e-15);
    assert_true(isnan(m->values[3]) && isnan(m->values[5]) && isnan(m->values[6 + 4]));
    ambulo__motion_free(m);
  }
}

static void what_is_wrong_has_its_place(void **state) {
  (void)state;
  static const struct {
    const char *text, *message;
    ambulo_status status;
  } cases[] = {
      {"", "the file ends before its first line", AMBULO_E_PARSE},
      {"time,A\n0,1\n", "no PathFileType", AMBULO_E_PARSE},
      {TOP, "the file ends before the values of its keys", AMBULO_E_PARSE},
      {TOP "100\t1\tinch\n" NAMES, "m.trc:3:7: error[E_SCHEMA]: Units is 'inch'", AMBULO_E_SCHEMA},
      {TOP "100\t1\n" NAMES, "no Units", AMBULO_E_SCHEMA},
      {TOP "100\tmany\tmm\n" NAMES, "NumFrames is 'many'", AMBULO_E_SCHEMA},
      {TOP "100\t1\tmm\nFrame#\tA\n", "the second column is not Time", AMBULO_E_SCHEMA},
      {TOP "100\t1\tmm\nFrame#\tTime\n\n", "no markers", AMBULO_E_SCHEMA},
      {TOP "100\t1\tmm\nFrame#\tTime\tA\tB\n", "marker 'B' in column 4", AMBULO_E_SCHEMA},
      {TOP "100\t1\tmm\nFrame#\tTime\tA\t\t\tA\n", "marker 'A' is there twice", AMBULO_E_SCHEMA},
      {TOP "100\t1\tmm\nFrame#\tTime\tA\n", "before the line X1", AMBULO_E_PARSE},
      {TOP "100\t2\tmm\n" NAMES "1\t0\t1\t2\t3\n", "1 rows; expected 2 (NumFrames)",
       AMBULO_E_PARSE},
      {TOP "100\t1\tmm\n" NAMES "1\t0\t1\tx\t3\n", "m.trc:6:7: error[E_SCHEMA]: column 'A.y'",
       AMBULO_E_SCHEMA},
      {TOP "100\t2\tmm\n" NAMES "1\t0\t1\n2\t0\t1\n", "time does not increase", AMBULO_E_SCHEMA},
      {TOP "100\t1\tmm\n" NAMES "1\t\t1\n", "column 'Time': not a number", AMBULO_E_SCHEMA},
      {TOP "100\t1\tmm\n" NAMES "1\t0\t1\t2\t3\t4\t5\t6\t7\n", "row with 9 cells", AMBULO_E_PARSE},
      {TOP "100\t1\tmm\n" NAMES "1\n", "row with 1 cells", AMBULO_E_PARSE},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    ambulo__motion *m = NULL;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    assert_int_equal(parse(cases[i].text, NULL, list, &m), cases[i].status);
    assert_null(m);
    assert_message(list, 0, cases[i].message);
    ambulo_diagnostics_free(list);
  }
}

static void memory_may_run_out(void **state) {
  (void)state;
  for (long k = 0; k < 1000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator a = fail_alloc_hook(&memory);
    ambulo__motion *m = NULL;
    ambulo_status status = parse(TOP "100\t1\tmm\n" NAMES "1\t0\t1\t2\t3\n", &a, NULL, &m);
    ambulo__motion_free(m);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) {
      assert_int_equal(status, AMBULO_OK);
      return;
    }
    assert_int_equal(status, AMBULO_E_MEMORY);
  }
  fail_msg("never enough memory");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(markers_become_columns_in_metres),
                                     cmocka_unit_test(what_is_wrong_has_its_place),
                                     cmocka_unit_test(memory_may_run_out)};
  return cmocka_run_group_tests_name("formats/marker_file", tests, NULL, NULL);
}
