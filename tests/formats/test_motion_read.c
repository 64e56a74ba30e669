/* Tables from text: what is accepted, and every way to be refused. */
#include "formats/motion_file.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/scratch.h"
#include "support/motion_text.h"

static ambulo__motion *read_ok(const char *text, const char *name) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__motion *motion = NULL;
  ambulo_status status = motion_read_text(text, strlen(text), name, ambulo__motion_format_of(name),
                                          NULL, list, &motion);
  if (status) assert_message(list, 0, "(no message)");
  assert_int_equal(status, AMBULO_OK);
  ambulo_diagnostics_free(list);
  return motion;
}

static void check_table(const ambulo__motion *motion) {
  assert_int_equal(motion->rows, 2);
  assert_int_equal(motion->columns, 2);
  assert_string_equal(motion->names[0], "hip");
  assert_string_equal(motion->names[1], "knee");
  const double time[2] = {0.0, 0.5}, values[4] = {1.0, -2.5e-3, 3.0, 4.0};
  for (int r = 0; r < 2; r++) {
    assert_true(motion->time[r] == time[r]);
    for (int c = 0; c < 2; c++) assert_true(motion->values[2 * r + c] == values[2 * r + c]);
  }
}

static void tables_are_read_in_every_dress(void **state) {
  (void)state;
  const char *csv[] = {"time,hip,knee\n0,1,-2.5e-3\n0.5,3,4\n",
                       "# SI units\n\ntime,hip,knee\r\n0,1,-2.5e-3\r\n# half\r\n0.5,3,4",
                       "\xEF\xBB\xBFTime, \"hip\" ,knee\n0 , 1,-2.5E-3\n\n\"0.5\",3.0,+4\n\n"};
  const char *sto[] = {
      "title\nversion=1\nnRows=2\nnColumns=3\ninDegrees=no\nendheader\n"
      "time\thip\tknee\n0\t1\t-2.5e-3\n0.5\t3\t4\n",
      "walk\r\ndatacolumns 3\r\ninDegrees = NO \r\n\r\nendheader  \r\n"
      "time   hip   knee\r\n      0.0  \t 1 -2.5e-3\r\n 0.5 3 4\r\n",
      "title\t\t\nnRows=2\t\t\nendheader\t\t\ntime\thip\tknee\t\n0\t1\t-2.5e-3\t\n0.5\t3\t4\t\n"};
  for (int i = 0; i < 3; i++) {
    ambulo__motion *motion = read_ok(csv[i], "a.csv");
    check_table(motion);
    assert_int_equal(motion->in_degrees, 0);
    ambulo__motion_free(motion);
    motion = read_ok(sto[i], i == 1 ? "a.MOT" : "a.sto");
    check_table(motion);
    ambulo__motion_free(motion);
    motion = read_ok(sto[i], "text without an ending");
    check_table(motion);
    ambulo__motion_free(motion);
  }
}

static void degrees_are_noticed(void **state) {
  (void)state;
  ambulo__motion *motion = read_ok("t\ninDegrees=yes\nendheader\ntime\tq\n0\t1\n", "a.mot");
  assert_int_equal(motion->in_degrees, 1);
  ambulo__motion_free(motion);
  /* measured with OpenSim 4.6: degrees without a version, radians with one */
  motion =
      read_ok("name t\ndatacolumns 2\ndatarows 1\nrange 0 1\nendheader\ntime\tq\n0\t1\n", "a.mot");
  assert_int_equal(motion->in_degrees, 1);
  assert_int_equal(motion->unit_stated, 0);
  ambulo__motion_free(motion);
  motion = read_ok("t\nversion=1\nendheader\ntime\tq\n0\t1\n", "a.mot");
  assert_int_equal(motion->in_degrees, 0);
  ambulo__motion_free(motion);
  motion = read_ok("# inDegrees=yes\ntime,q\n0,1\n", "a.csv");
  assert_int_equal(motion->in_degrees, 1);
  ambulo__motion_free(motion);
  motion = read_ok("# other=yes, 1 = 2\ntime,q\n0,1\n", "a.csv");
  assert_int_equal(motion->in_degrees, 0);
  ambulo__motion_free(motion);
}

static const struct {
  const char *name, *text;
  ambulo_status status;
  const char *message;
} bad[] = {
    {"a.csv", "", AMBULO_E_PARSE, "a.csv: error[E_PARSE]: no column names"},
    {"a.csv", "# only\n\n# comments\n", AMBULO_E_PARSE, "no column names"},
    {"a.csv", "time,q\n", AMBULO_E_PARSE, "no rows"},
    {"a.csv", "time,q\n# end\n\n", AMBULO_E_PARSE, "no rows"},
    {"a.csv", "t,q\n0,1\n", AMBULO_E_SCHEMA, "a.csv:1:1: error[E_SCHEMA]: the first column is 't'"},
    {"a.csv", "0,1\n0.1,2\n", AMBULO_E_SCHEMA, "expected 'time'"},
    {"a.csv", "time,q\n0,1\n1,2,3\n", AMBULO_E_PARSE,
     "a.csv:3:1: error[E_PARSE]: row with 3 cells"},
    {"a.csv", "time,q\n0,1\n1\n", AMBULO_E_PARSE, "row with 1 cells; expected 2"},
    {"a.csv", "time,q\n0,1,\n", AMBULO_E_PARSE, "row with 3 cells"},
    {"a.csv", "time,q\n0,1x\n", AMBULO_E_SCHEMA,
     "a.csv:2:3: error[E_SCHEMA]: column 'q': not a number (got '1x')"},
    {"a.csv", "time,q\n0,\n", AMBULO_E_SCHEMA, "got ''"},
    {"a.csv", "time,q\n0,nan\n", AMBULO_E_SCHEMA, "got 'nan'); expected a finite number"},
    {"a.csv", "time,cop.l.x,q.cop\n0,nan,nan\n", AMBULO_E_SCHEMA, "a.csv:2:7: error"},
    {"a.csv", "time,q\n0,1e999\n", AMBULO_E_SCHEMA, "got '1e999'"},
    {"a.csv", "time,q\n0,0x10\n", AMBULO_E_SCHEMA, "got '0x10'"},
    {"a.csv", "time;q\n0;1\n", AMBULO_E_SCHEMA, "the first column is 'time;q'"},
    {"a.csv", "time,q\ninf,1\n", AMBULO_E_SCHEMA, "column 'time'"},
    {"a.csv", "time,q\n0,1\n0,2\n", AMBULO_E_SCHEMA, "a.csv:3:1: error[E_SCHEMA]: time does not"},
    {"a.csv", "time,q\n0,1\n-1,2\n", AMBULO_E_SCHEMA, "got '-1'"},
    {"a.csv", "time,q,p,q\n0,1,2,3\n", AMBULO_E_SCHEMA,
     "a.csv:1:10: error[E_SCHEMA]: duplicate column 'q' (also column 2)"},
    {"a.csv", "time,,q\n0,1,2\n", AMBULO_E_SCHEMA, "column name of 0 characters"},
    {"a.csv", "time,q\x01z\n0,1\n", AMBULO_E_SCHEMA,
     "a.csv:1:6: error[E_SCHEMA]: column name 'q\\x01z' contains the character 0x01"},
    {"a.csv", "time,q\x7f\n0,1\n", AMBULO_E_SCHEMA, "contains the character 0x7f"},
    {"a.sto", "t\nendheader\ntime\tq,z\n0\t1\n", AMBULO_E_SCHEMA, "contains the character 0x2c"},
    {"a.sto", "t\nendheader\ntime\tq\"\n0\t1\n", AMBULO_E_SCHEMA, "contains the character 0x22"},
    {"a.csv", "time,q\x1b[31m\n0,1\n", AMBULO_E_SCHEMA, "character 0x1b"},
    {"a.csv", "# inDegrees=maybe\ntime,q\n0,1\n", AMBULO_E_SCHEMA,
     "a.csv:1:13: error[E_SCHEMA]: "
     "inDegrees is 'maybe'"},
    {"a.sto", "title\nversion=1\ntime\tq\n0\t1\n", AMBULO_E_PARSE, "no 'endheader' line"},
    {"a.sto", "title\nendheader\n", AMBULO_E_PARSE, "no column names"},
    {"a.sto", "t\nnRows=3\nendheader\ntime\tq\n0\t1\n1\t1\n", AMBULO_E_PARSE,
     "2 rows; expected 3 (nRows)"},
    {"a.sto", "t\nendheader\ntime\tq\n0\t1\n1\t1\n1\t2\n", AMBULO_E_SCHEMA,
     "a.sto:6:1: error[E_SCHEMA]: time does not increase"},
    {"a.csv", "time,q\n0,1\n1,1\n1,1\n", AMBULO_E_SCHEMA,
     "a.csv:4:1: error[E_SCHEMA]: time does not increase"},
    {"a.sto", "t\nnRows=many\nendheader\ntime\tq\n0\t1\n", AMBULO_E_SCHEMA,
     "a.sto:2:7: error[E_SCHEMA]: not a count (got 'many')"},
    {"a.sto", "t\ninDegrees=\nendheader\ntime\tq\n0\t1\n", AMBULO_E_SCHEMA, "inDegrees is ''"},
    {"a.sto", "t\nendheader\ntime\tq\n0 1 2\n", AMBULO_E_PARSE, "row with 3 cells"},
};

static void faults_are_named_with_line_and_column(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    ambulo__motion *motion = NULL;
    ambulo_status status =
        motion_read_text(bad[i].text, strlen(bad[i].text), bad[i].name,
                         ambulo__motion_format_of(bad[i].name), NULL, list, &motion);
    assert_message(list, 0, bad[i].message);
    assert_int_equal(status, bad[i].status);
    assert_null(motion);
    ambulo_diagnostics_free(list);
  }
}

/* what is too little is an error; what is too much is said, where the number stands */
static void more_rows_than_announced_are_taken(void **state) {
  (void)state;
  static const char text[] = "t\nnRows=1\nendheader\ntime\tq\n0\t1\n1\t2\n";
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__motion *motion = NULL;
  assert_int_equal(
      motion_read_text(text, strlen(text), "x.sto", AMBULO__MOTION_AUTO, NULL, list, &motion),
      AMBULO_OK);
  assert_int_equal(motion->rows, 2);
  assert_message(list, 0, "x.sto:2:1: warning: 2 rows, where nRows says 1: all are taken");
  ambulo__motion_free(motion);
  ambulo_diagnostics_free(list);
}

/* OpenSim's tools repeat rows where their runs end */
static void repeated_rows_are_left_out(void **state) {
  (void)state;
  static const char text[] =
      "t\nnRows=5\nendheader\ntime\tq\n0\t1\n0\t1\n1\t2\n1\t2.00000001\n1\t2\n";
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__motion *motion = NULL;
  assert_int_equal(
      motion_read_text(text, strlen(text), "x.sto", AMBULO__MOTION_AUTO, NULL, list, &motion),
      AMBULO_OK);
  assert_int_equal(motion->rows, 2);
  assert_close(motion->time[1], 1, 0);
  assert_close(motion->values[1], 2, 0);
  assert_message(list, 0, "3 rows say the same as the row before, time and all: they are left out");
  ambulo__motion_free(motion);
  ambulo_diagnostics_free(list);
}

static void one_run_reports_all_faults(void **state) {
  (void)state;
  const char *text = "time,q,p\n0,a,b\n1,2\n2,c,3\n1.5,4,5\n";
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__motion *motion = NULL;
  assert_int_equal(
      motion_read_text(text, strlen(text), "x.csv", AMBULO__MOTION_AUTO, NULL, list, &motion),
      AMBULO_E_SCHEMA);
  assert_int_equal(ambulo_diagnostics_error_count(list), 5);
  assert_message(list, 1, "x.csv:2:5");
  assert_message(list, 2, "x.csv:3:1: error[E_PARSE]: row with 2 cells");
  assert_message(list, 3, "x.csv:4:3");
  assert_message(list, 4, "x.csv:5:1: error[E_SCHEMA]: time does not increase");
  ambulo_diagnostics_free(list);
}

static void sizes_are_limited_and_nul_bytes_refused(void **state) {
  (void)state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__motion *motion = NULL;
  assert_int_equal(motion_read_text("time", AMBULO__MOTION_MAX_BYTES + 1, "a.csv",
                                    AMBULO__MOTION_CSV, NULL, list, &motion),
                   AMBULO_E_LIMIT);
  char wide[3 * 5000] = "time";
  for (size_t i = 4; i < sizeof wide - 1; i++) wide[i] = i % 2 ? 'q' : ',';
  assert_int_equal(
      motion_read_text(wide, strlen(wide), "a.csv", AMBULO__MOTION_CSV, NULL, list, &motion),
      AMBULO_E_LIMIT);
  assert_message(list, 1, "expected at most 4096");
  assert_int_equal(
      motion_read_text("time,q\n0,\0001\n", 12, "a.csv", AMBULO__MOTION_CSV, NULL, list, &motion),
      AMBULO_E_PARSE);
  assert_message(list, 2, "a.csv:2:3: error[E_PARSE]: NUL byte");
  assert_null(motion);
  ambulo_diagnostics_free(list);
}

static void texts_cut_anywhere_never_crash(void **state) {
  (void)state;
  const char *text = "t\nnRows=2\nnColumns=2\nendheader\ntime\tq\n0\t1.5\n1\t2.5\n";
  for (size_t length = 0; length < strlen(text) - 4; length++) {
    char *copy = malloc(length + 1); /* sanitizers see a read past the end */
    memcpy(copy, text, length);
    ambulo__motion *motion = NULL;
    ambulo_status status =
        motion_read_text(copy, length, "a.sto", AMBULO__MOTION_STO, NULL, NULL, &motion);
    assert_int_not_equal(status, AMBULO_OK);
    assert_null(motion);
    free(copy);
  }
}

static void every_failed_allocation_is_survived(void **state) {
  (void)state;
  const char *text = "time,hip,knee\n0,1,2\n1,3,4\n";
  for (long k = 0; k < 1000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo__motion *motion = NULL;
    ambulo_status status =
        motion_read_text(text, strlen(text), "a.csv", AMBULO__MOTION_AUTO, &hook, NULL, &motion);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__motion_free(motion);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) return;
  }
  fail();
}

/* measured forces have gaps, motions have none */
static void gaps_are_read_where_they_are_asked_for(void **state) {
  static const char text[] = "time,ground_force_r_px,x\n0,NaN,1\n1,2,nan\n";
  const char *path = scratch_path(state, "forces.csv");
  ambulo__motion *motion = NULL;
  scratch_write(path, text);
  assert_int_equal(ambulo__motion_read(path, 0, NULL, NULL, &motion), AMBULO_E_SCHEMA);
  assert_int_equal(ambulo__motion_read(path, 1, NULL, NULL, &motion), AMBULO_OK);
  assert_true(isnan(motion->values[0]) && isnan(motion->values[3]));
  assert_close(motion->values[2], 2.0, 0.0);
  ambulo__motion_free(motion);
  scratch_write(path, "time,x\nnan,1\n1,2\n");
  assert_int_equal(ambulo__motion_read(path, 1, NULL, NULL, &motion), AMBULO_E_SCHEMA);
}

/* the header of an older OpenSim, and of a table by ambulo */
static void headers_are_taken_in(void **state) {
  (void)state;
  ambulo__motion *motion =
      read_ok("Coordinates\nnRows=1\n\nUnits are S.I. units (second, meters, Newtons, ...)\n"
              "Angles are in degrees.\n\nendheader\ntime\tq\n0\t1\n",
              "a.mot");
  assert_int_equal(motion->in_degrees, 1);
  assert_int_equal(motion->unit_stated, 1);
  assert_true(isnan(motion->body_mass));
  ambulo__motion_free(motion);
  motion =
      read_ok("# ambulo motion: mass 75 kg, gravity 0 -9.81 0 m/s^2; x\ntime,q\n0,1\n", "a.csv");
  assert_close(motion->body_mass, 75.0, 0.0);
  assert_close(motion->gravity[1], -9.81, 0.0);
  assert_int_equal(motion->unit_stated, 0);
  assert_int_equal(motion->declared_columns, -1);
  ambulo__motion_free(motion);
  motion = read_ok("t\nnColumns=3\nendheader\ntime\tq\n0\t1\n", "a.sto");
  assert_int_equal(motion->declared_columns, 3);
  assert_int_equal(motion->columns, 1);
  ambulo__motion_free(motion);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(gaps_are_read_where_they_are_asked_for, scratch_open,
                                      scratch_close),
      cmocka_unit_test(headers_are_taken_in),
      cmocka_unit_test(tables_are_read_in_every_dress),
      cmocka_unit_test(degrees_are_noticed),
      cmocka_unit_test(faults_are_named_with_line_and_column),
      cmocka_unit_test(more_rows_than_announced_are_taken),
      cmocka_unit_test(repeated_rows_are_left_out),
      cmocka_unit_test(one_run_reports_all_faults),
      cmocka_unit_test(sizes_are_limited_and_nul_bytes_refused),
      cmocka_unit_test(texts_cut_anywhere_never_crash),
      cmocka_unit_test(every_failed_allocation_is_survived),
  };
  return cmocka_run_group_tests_name("format/table_read", tests, NULL, NULL);
}
