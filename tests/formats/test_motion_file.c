/* Motion tables from files: names, units, a published motion. */
#include "formats/motion_file.h"
#include "support/messages.h"
#include "support/motion_text.h"
#include "support/scratch.h"
#include "support/test.h"

static void columns_are_found_by_name(void **state) {
  (void)state;
  const char *names[4] = {"q.hip_flexion_r", "/jointset/knee_r/knee_angle_r/value",
                          "/jointset/knee_r/knee_angle_r/speed", "hip_flexion_l"};
  ambulo__motion *motion = NULL;
  assert_int_equal(ambulo__motion_create(1, 4, names, NULL, &motion), AMBULO_OK);
  assert_int_equal(ambulo__motion_column(motion, "hip_flexion_l"), 3);
  assert_int_equal(ambulo__motion_column(motion, "hip_flexion_r"), -1);
  ambulo__motion_free(motion);
  ambulo__motion_free(NULL);
}

static void only_angles_are_converted_and_only_once(void **state) {
  (void)state;
  const char *names[2] = {"tilt", "tx"};
  const unsigned char is_angle[2] = {1, 0};
  ambulo__motion *motion = NULL;
  assert_int_equal(ambulo__motion_create(1, 2, names, NULL, &motion), AMBULO_OK);
  motion->values[0] = motion->values[1] = 180.0;
  ambulo__motion_to_radians(motion, is_angle);
  assert_true(motion->values[0] == 180.0);
  motion->in_degrees = 1;
  ambulo__motion_to_radians(motion, is_angle);
  ambulo__motion_to_radians(motion, is_angle);
  assert_close(motion->values[0], 3.14159265358979312, 1e-15);
  assert_true(motion->values[1] == 180.0);
  assert_int_equal(motion->in_degrees, 0);
  ambulo__motion_free(motion);
}

static void endings_tell_the_format(void **state) {
  (void)state;
  assert_int_equal(ambulo__motion_format_of("a.b/run.CSV"), AMBULO__MOTION_CSV);
  assert_int_equal(ambulo__motion_format_of("run.sto"), AMBULO__MOTION_STO);
  assert_int_equal(ambulo__motion_format_of("run.mot"), AMBULO__MOTION_STO);
  assert_int_equal(ambulo__motion_format_of("run.txt"), AMBULO__MOTION_AUTO);
  assert_int_equal(ambulo__motion_format_of("run"), AMBULO__MOTION_AUTO);
}

static void files_are_read_and_faults_name_them(void **state) {
  const char *path = scratch_path(state, "walk.csv");
  scratch_write(path, "time,q\n0,1\n0.5,2\n");
  ambulo__motion *motion = NULL;
  assert_int_equal(ambulo__motion_read(path, 0, NULL, NULL, &motion), AMBULO_OK);
  assert_int_equal(motion->rows, 2);
  ambulo__motion_free(motion);
  motion = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  scratch_write(path, "time,q\n0,one\n");
  assert_int_equal(ambulo__motion_read(path, 0, NULL, list, &motion), AMBULO_E_SCHEMA);
  assert_message(list, 0, "walk.csv:2:3: ");
  path = scratch_path(state, "missing.sto");
  assert_int_equal(ambulo__motion_read(path, 0, NULL, list, &motion), AMBULO_E_IO);
  assert_message(list, 1, "missing.sto: error[E_IO]");
  assert_null(motion);
  ambulo_diagnostics_free(list);
}

static void sparse_files_beyond_64_mebibytes_are_refused(void **state) {
  const char *path = scratch_path(state, "large.csv");
  scratch_write(path, "");
  assert_int_equal(truncate(path, (off_t)AMBULO__MOTION_MAX_BYTES + 1), 0);
  ambulo__motion *motion = NULL;
  assert_int_equal(ambulo__motion_read(path, 0, NULL, NULL, &motion), AMBULO_E_LIMIT);
}

/* measured walking: skipped where the reference data are not at hand */
static void a_published_opensim_motion_is_read(void **state) {
  (void)state;
  const char *folder = getenv("AMBULO_SHARED_DATA"), *source = getenv("AMBULO_SOURCE_DIR");
  char path[SCRATCH_PATH];
  if (folder) {
    snprintf(path, sizeof path, "%s/opensim_moco_2dwalking_referenceCoordinates.sto", folder);
  } else {
    snprintf(path, sizeof path, "%s/../shared/data/opensim_moco_2dwalking_referenceCoordinates.sto",
             source ? source : ".");
  }
  if (access(path, R_OK) != 0) skip();
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__motion *motion = NULL;
  ambulo_status status = ambulo__motion_read(path, 0, NULL, list, &motion);
  if (status) assert_message(list, 0, "(no message)");
  assert_int_equal(motion->rows, 50);
  assert_int_equal(motion->columns, 10);
  assert_int_equal(motion->in_degrees, 0);
  int height = ambulo__motion_column(motion, "/jointset/groundPelvis/pelvis_ty/value");
  assert_int_equal(height, 2);
  assert_true(motion->values[height] == 0.88365423);
  assert_true(motion->time[1] == 0.00959366);
  int knee = -1;
  assert_int_equal(
      ambulo__motion_find(motion, path, "knee_angle_r", AMBULO__ORDER_VALUE, list, &knee),
      AMBULO_OK);
  assert_int_equal(knee, 6);
  ambulo__motion_free(motion);
  ambulo_diagnostics_free(list);
}

/* Lines above the column names: units, sizes, and whose motion it is. */

static ambulo__table_header take(const char *text, int number, int is_sto) {
  ambulo__table_header header = ambulo__table_header_default();
  ambulo__table_line line = {.start = text, .length = strlen(text), .number = number};
  assert_int_equal(ambulo__table_header_take(&line, is_sto, "f", NULL, &header), AMBULO_OK);
  return header;
}

static void the_unit_of_angles(void **state) {
  (void)state;
  static const struct {
    const char *line;
    int is_sto, degrees, stated;
  } lines[] = {{"inDegrees=yes", 1, 1, 1},
               {" indegrees = No ", 1, 0, 1},
               {"# inDegrees=yes", 0, 1, 1},
               {"inDegrees=yes", 0, 0, 0},
               {"Angles are in degrees.", 1, 1, 1},
               {"angles  are in\tdegrees", 1, 1, 1},
               {"Angles are in radians.", 1, 0, 1},
               {"Angles are in a file", 1, 0, 0},
               {"Angles are", 1, 0, 0},
               {"# Angles are in degrees.", 0, 0, 0},
               {"", 1, 0, 0},
               {"", 0, 0, 0}};
  for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
    ambulo__table_header header = take(lines[i].line, 2, lines[i].is_sto);
    if (header.in_degrees != lines[i].degrees || header.unit_stated != lines[i].stated)
      print_error("line '%s'\n", lines[i].line);
    assert_int_equal(header.in_degrees, lines[i].degrees);
    assert_int_equal(header.unit_stated, lines[i].stated);
  }
}

/* OpenSim writes both; the key decides */
static void the_key_goes_before_the_sentence(void **state) {
  (void)state;
  ambulo__table_header header = ambulo__table_header_default();
  static const char *const texts[] = {"inDegrees=no", "Angles are in degrees."};
  for (int i = 0; i < 4; i++) {
    const char *text = texts[i % 2];
    ambulo__table_line line = {.start = text, .length = strlen(text), .number = i + 1};
    assert_int_equal(ambulo__table_header_take(&line, 1, "f", NULL, &header), AMBULO_OK);
  }
  assert_int_equal(header.in_degrees, 0);
}

static void sizes_of_the_table(void **state) {
  (void)state;
  assert_int_equal(take("nRows=7", 1, 1).declared_rows, 7);
  assert_int_equal(take("datarows = 8", 1, 1).declared_rows, 8);
  assert_int_equal(take("nColumns=9", 1, 1).declared_columns, 9);
  assert_int_equal(take("# nRows=7", 1, 0).declared_rows, -1);
  assert_int_equal(take("datarows 8", 1, 1).declared_rows, 8); /* SIMM */
  assert_int_equal(take("datacolumns\t9 ", 1, 1).declared_columns, 9);
  assert_int_equal(take("datarows 8 of 9", 1, 1).declared_rows, -1);
  assert_int_equal(take("name datarows", 1, 1).declared_rows, -1);
  assert_int_equal(take("version=1", 2, 1).has_version, 1);
  assert_int_equal(take("# version=1", 2, 0).has_version, 0);
  ambulo__table_header header = ambulo__table_header_default();
  ambulo__table_line line = {.start = "nRows=x", .length = 7, .number = 3};
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo__table_header_take(&line, 1, "f.sto", list, &header), AMBULO_E_SCHEMA);
  assert_message(list, 0, "f.sto:3:7: error[E_SCHEMA]: not a count (got 'x')");
  ambulo_diagnostics_free(list);
}

static void whose_motion_it_is(void **state) {
  (void)state;
  static const char text[] = "# ambulo motion: mass 72.5 kg, gravity 0.5 -9.75 0 m/s^2; SI units";
  ambulo__table_header header = take(text, 1, 0);
  assert_close(header.body_mass, 72.5, 0.0);
  assert_close(header.gravity[0], 0.5, 0.0);
  assert_close(header.gravity[1], -9.75, 0.0);
  assert_true(isnan(take(text, 2, 0).body_mass));
  assert_true(isnan(take(text, 1, 1).body_mass));
  assert_true(isnan(take("# ambulo motion: mass x kg, gravity 0 0 0 m", 1, 0).body_mass));
  assert_true(isnan(take("# ambulo motion: mass 70 kg, gravity 0", 1, 0).body_mass));
}

/* Which column stands for a coordinate, and that two that disagree are never chosen between. */

static ambulo__motion *table(const char *text) {
  ambulo__motion *motion = NULL;
  assert_int_equal(
      motion_read_text(text, strlen(text), "m.csv", AMBULO__MOTION_CSV, NULL, NULL, &motion),
      AMBULO_OK);
  return motion;
}

static int find(const ambulo__motion *motion, const char *name, ambulo__motion_order order) {
  int column = -2;
  assert_int_equal(ambulo__motion_find(motion, "m.csv", name, order, NULL, &column), AMBULO_OK);
  return column;
}

static void every_spelling_is_known(void **state) {
  (void)state;
  static const char *const spellings[3][4] = {
      {"th", "q.th", "/jointset/x/th/value", "/jointset/x/th"},
      {"qd.th", "th_u", "/jointset/x/th/speed", "x/th/speed"},
      {"qdd.th", "/jointset/x/th/accel", "/jointset/x/th/acceleration", "x/th/accel"}};
  for (int order = 0; order < 3; order++) {
    for (int i = 0; i < 4; i++) {
      char text[128];
      snprintf(text, sizeof text, "time,other,%s\n0,1,2\n", spellings[order][i]);
      ambulo__motion *motion = table(text);
      for (int asked = 0; asked < 3; asked++)
        assert_int_equal(find(motion, "th", (ambulo__motion_order)asked), asked == order ? 1 : -1);
      assert_int_equal(find(motion, "h", AMBULO__ORDER_VALUE), -1);
      assert_int_equal(find(motion, "", AMBULO__ORDER_VALUE), -1);
      ambulo__motion_free(motion);
    }
  }
}

static void what_only_resembles_is_left(void **state) {
  (void)state;
  ambulo__motion *motion =
      table("time,/forceset/th,/forceset/th/value,tau.th,xth,q.xth,/a/xth/value,"
            "th/value/more,q.th.x,qd.thx\n0,1,2,3,4,5,6,7,8,9\n");
  for (int order = 0; order < 3; order++)
    assert_int_equal(find(motion, "th", (ambulo__motion_order)order), -1);
  ambulo__motion_free(motion);
}

static void refused(const char *header, ambulo__motion_order order, const char *message) {
  char text[128];
  snprintf(text, sizeof text, "time,%s\n0,1,1\n0.5,2,3\n", header);
  ambulo__motion *motion = table(text);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  int column = -2;
  assert_int_equal(ambulo__motion_find(motion, "m.csv", "th", order, list, &column),
                   AMBULO_E_SCHEMA);
  assert_int_equal(column, -2);
  assert_message(list, 0, message);
  assert_message(list, 0, "differ (2 and 3 at t = 0.5 s)");
  ambulo_diagnostics_free(list);
  ambulo__motion_free(motion);
}

static void columns_that_disagree_are_refused(void **state) {
  (void)state;
  refused("th,q.th", AMBULO__ORDER_VALUE, "'th' and 'q.th' both stand for coordinate 'th'");
  refused("/jointset/x/th/value,/jointset/y/th/value", AMBULO__ORDER_VALUE,
          "'/jointset/x/th/value' and '/jointset/y/th/value'");
  refused("qd.th,th_u", AMBULO__ORDER_RATE, "'qd.th' and 'th_u'");
  refused("qdd.th,/x/th/accel", AMBULO__ORDER_ACCELERATION, "'qdd.th' and '/x/th/accel'");
  ambulo__motion *motion = table("time,th,q.th\n0,1,1\n0.5,2,2\n");
  assert_int_equal(find(motion, "th", AMBULO__ORDER_VALUE), 0);
  ambulo__motion_free(motion);
}

/* What counts as hardly an angle in radians, hardly a length in metres. */

static double bound(ambulo_joint_type type, double lower, double upper) {
  ambulo_coordinate c = ambulo_coordinate_default();
  c.type = type;
  c.range[0] = lower;
  c.range[1] = upper;
  return ambulo__largest_plausible(&c);
}

static void bounds_follow_the_range(void **state) {
  (void)state;
  const double turn = 6.283185307179586;
  assert_close(bound(AMBULO_REVOLUTE, -0.3, 0.2), 3.0, 1e-14);
  assert_close(bound(AMBULO_REVOLUTE, 0.0, 2.1), turn, 1e-14);
  assert_close(bound(AMBULO_REVOLUTE, -20.0, 2.0), 40.0, 1e-14);
  assert_close(bound(AMBULO_REVOLUTE, -1.0, INFINITY), 10.0 * turn, 1e-14);
  assert_close(bound(AMBULO_PRISMATIC, -0.2, 0.1), 2.0, 1e-14);
  assert_true(isinf(bound(AMBULO_PRISMATIC, -INFINITY, INFINITY)));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(columns_are_found_by_name),
      cmocka_unit_test(only_angles_are_converted_and_only_once),
      cmocka_unit_test(endings_tell_the_format),
      cmocka_unit_test_setup_teardown(files_are_read_and_faults_name_them, scratch_open,
                                      scratch_close),
      cmocka_unit_test_setup_teardown(sparse_files_beyond_64_mebibytes_are_refused, scratch_open,
                                      scratch_close),
      cmocka_unit_test(a_published_opensim_motion_is_read),
      cmocka_unit_test(the_unit_of_angles),
      cmocka_unit_test(the_key_goes_before_the_sentence),
      cmocka_unit_test(sizes_of_the_table),
      cmocka_unit_test(whose_motion_it_is),
      cmocka_unit_test(every_spelling_is_known),
      cmocka_unit_test(what_only_resembles_is_left),
      cmocka_unit_test(columns_that_disagree_are_refused),
      cmocka_unit_test(bounds_follow_the_range)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
