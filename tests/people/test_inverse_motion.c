/* Filters on the rows of a file: their rate, and rows that no filter fits. */
#include "base/diagnostics.h"
#include "people/inverse.h"
#include "people/motion_fit.h"
#include "support/arm.h"
#include "support/fail_alloc.h"
#include "support/inverse_table.h"
#include "support/messages.h"
#include "support/scratch.h"

enum { ROWS = 400 };

static void the_rate_is_that_of_the_rows(void **state) {
  (void)state;
  /* 120 rows a second in milliseconds, rounded to whole ones as files are */
  double time[ROWS], x[ROWS];
  for (int k = 0; k < ROWS; k++) {
    time[k] = 1000.0 + (double)(long)(k * 1000.0 / 120.0 + 0.5);
    x[k] = sin(2.0 * 3.14159265358979 * 6.0 * k / 120.0);
  }
  ambulo__filtering f = {.time = time, .rows = ROWS, .time_unit = 1e-3, .cutoff = 6.0, .order = 4};
  assert_int_equal(ambulo__filter(&f, x, 1, NULL), AMBULO_OK);
  double most = 0.0;
  for (int k = 100; k < 300; k++) most = fmax(most, fabs(x[k]));
  assert_close(most, sqrt(0.5), 2e-3);
  double rounded[4] = {0.0, 0.108, 0.2, 0.3}, y[4] = {1.0, 1.0, 1.0, 1.0};
  f = (ambulo__filtering){.time = rounded, .rows = 4, .time_unit = 1.0, .cutoff = 2.0, .order = 4};
  assert_int_equal(ambulo__filter(&f, y, 1, NULL), AMBULO_OK);
}

static void refuse(ambulo__filtering *f, const char *message) {
  double x[3] = {1.0, 2.0, 4.0};
  f->diagnostics = ambulo_diagnostics_create(NULL);
  f->option = "--filter";
  f->file = "m.csv";
  assert_int_equal(ambulo__filter(f, x, 1, NULL), AMBULO_E_SCHEMA);
  assert_message(f->diagnostics, 0, message);
  assert_message(f->diagnostics, 0, "m.csv: error[E_SCHEMA]: --filter ");
  assert_close(x[2], 4.0, 0.0);
  ambulo_diagnostics_free(f->diagnostics);
}

static void what_cannot_be_filtered_is_refused(void **state) {
  (void)state;
  double even[3] = {0.0, 0.1, 0.2}, uneven[3] = {0.0, 0.1, 0.3};
  ambulo__filtering f = {.time = uneven, .rows = 3, .time_unit = 1.0, .cutoff = 1.0, .order = 4};
  refuse(&f, "with steps of 0.15 s, t = 0.1 s would be 0.15 s");
  f.time = even;
  f.cutoff = 5.0;
  refuse(&f, "is 5 Hz; expected less than half the 10 rows a second");
  f.rows = 1;
  refuse(&f, "needs rows of several times");
  f.rows = 3;
  f.cutoff = 1.0;
  double x[3] = {1.0, 2.0, 4.0};
  fail_alloc memory = fail_alloc_at(0);
  ambulo_allocator hook = fail_alloc_hook(&memory);
  assert_int_equal(ambulo__filter(&f, x, 1, &hook), AMBULO_E_MEMORY);
}

static int test_filtering_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_rate_is_that_of_the_rows),
                                     cmocka_unit_test(what_cannot_be_filtered_is_refused)};
  return cmocka_run_group_tests_name("inverse/filtering", tests, NULL, NULL);
}

/* Values, rates and accelerations of a motion file: what the file has is used, in its units; what
 * it lacks is computed. */

enum { TEST_INVERSE_MOTION_ROWS = 11 };

/* quintic and quadratic in time: splines of degree 5 reproduce them and their rates */
static void at(double t, double q[2], double qd[2], double qdd[2]) {
  q[0] = 0.3 + t - 0.5 * t * t * t;
  q[1] = -0.2 + 0.7 * t * t;
  qd[0] = 1.0 - 1.5 * t * t;
  qd[1] = 1.4 * t;
  qdd[0] = -3.0 * t;
  qdd[1] = 1.4;
}

/* how a test writes the motion: units per radian and second; which columns */
typedef struct dress {
  const char *header;
  double angle, time;
  int value, rate, acceleration; /* 1: columns of both coordinates */
  double wrong;                  /* added to rates and accelerations, to see that they are used */
} dress;

static const char *write_motion(void **state, const dress *d) {
  const char *path = scratch_path(state, "motion.csv");
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fprintf(file, "%s\n", d->header);
  for (int k = 0; k < TEST_INVERSE_MOTION_ROWS; k++) {
    double t = 0.1 * k, q[2], qd[2], qdd[2];
    at(t, q, qd, qdd);
    fprintf(file, "%.17g", d->time * t);
    for (int i = 0; d->value && i < 2; i++) fprintf(file, ",%.17g", d->angle * q[i]);
    for (int i = 0; d->rate && i < 2; i++)
      fprintf(file, ",%.17g", d->angle / d->time * (qd[i] + d->wrong));
    for (int i = 0; d->acceleration && i < 2; i++)
      fprintf(file, ",%.17g", d->angle / d->time / d->time * (qdd[i] + 2.0 * d->wrong));
    fprintf(file, "\n");
  }
  fclose(file);
  return path;
}

/* rates and accelerations off by the given amounts; torques those of what stands there */
static void check(const ambulo_model *model, const ambulo__motion *m, double rate_off,
                  double acceleration_off) {
  static const char *const names[] = {"shoulder", "elbow"};
  ambulo_mechanics *mechanics = NULL;
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  assert_int_equal(m->rows, TEST_INVERSE_MOTION_ROWS);
  for (int k = 0; k < TEST_INVERSE_MOTION_ROWS; k++) {
    double q[2], qd[2], qdd[2], tau[2];
    char column[32];
    at(0.1 * k, q, qd, qdd);
    for (int i = 0; i < 2; i++) {
      qd[i] += rate_off;
      qdd[i] += acceleration_off;
    }
    assert_int_equal(ambulo_mechanics_inverse_dynamics(
                         mechanics, 1, q, qd, qdd,
                         &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau}),
                     0);
    assert_close(m->time[k], 0.1 * k, 1e-12);
    for (int i = 0; i < 2; i++) {
      snprintf(column, sizeof column, "q.%s", names[i]);
      assert_close(table_cell(m, k, column), q[i], 1e-12);
      snprintf(column, sizeof column, "qd.%s", names[i]);
      assert_close(table_cell(m, k, column), qd[i], 1e-9);
      snprintf(column, sizeof column, "qdd.%s", names[i]);
      assert_close(table_cell(m, k, column), qdd[i], 1e-7);
      snprintf(column, sizeof column, "tau.%s", names[i]);
      assert_close(table_cell(m, k, column), tau[i], 1e-7);
      snprintf(column, sizeof column, "power.%s", names[i]);
      assert_close(table_cell(m, k, column), tau[i] * qd[i], 1e-7);
    }
  }
  ambulo_mechanics_free(mechanics);
}

static void one(void **state, const dress *d, const ambulo_inverse_options *options,
                const char *const *messages, double rate_off, double acceleration_off) {
  ambulo_model *model = arm_create();
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__motion *m = inverse_of(model, write_motion(state, d), options, list, AMBULO_OK);
  assert_messages(list, messages);
  check(model, m, rate_off, acceleration_off);
  ambulo__motion_free(m);
  ambulo_model_free(model);
}

static const char *const silence[] = {NULL};
#define ALL "time,shoulder,elbow,qd.shoulder,qd.elbow,qdd.shoulder,qdd.elbow"

static void what_the_file_has_is_used(void **state) {
  ambulo_inverse_options spline = ambulo_inverse_options_default();
  spline.recompute_rates = 1;
  dress d = {ALL, 1.0, 1.0, 1, 1, 1, 0.05};
  one(state, &d, NULL, silence, 0.05, 0.1);
  one(state, &d, &spline, silence, 0.0, 0.0);
  /* accelerations from the given rates, whose slope is right */
  d = (dress){"time,shoulder,elbow,qd.shoulder,qd.elbow", 1.0, 1.0, 1, 1, 0, 0.05};
  one(state, &d, NULL, silence, 0.05, 0.0);
  d = (dress){"time,/jointset/s/shoulder/value,/jointset/e/elbow/value,/jointset/s/shoulder/speed,"
              "/jointset/e/elbow/speed,/jointset/s/shoulder/accel,/jointset/e/elbow/accel",
              1.0,
              1.0,
              1,
              1,
              1,
              0.05};
  one(state, &d, NULL, silence, 0.05, 0.1);
  d = (dress){"time,shoulder,elbow", 1.0, 1.0, 1, 0, 0, 0.0};
  one(state, &d, NULL, silence, 0.0, 0.0);
}

/* accelerations are the slopes of the given rates, not of the values */
static void slopes_of_rates(void **state) {
  ambulo_model *model = arm_create();
  const char *path = scratch_path(state, "m.csv");
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fprintf(file, "time,shoulder,elbow,qd.shoulder,qd.elbow\n");
  for (int k = 0; k < TEST_INVERSE_MOTION_ROWS; k++) {
    double t = 0.1 * k, q[2], qd[2], qdd[2];
    at(t, q, qd, qdd);
    fprintf(file, "%.17g,%.17g,%.17g,%.17g,%.17g\n", t, q[0], q[1], qd[0], qd[1] + 0.05 * t);
  }
  fclose(file);
  ambulo__motion *m = inverse_of(model, path, NULL, NULL, AMBULO_OK);
  for (int k = 0; k < TEST_INVERSE_MOTION_ROWS; k++) {
    assert_close(table_cell(m, k, "qdd.shoulder"), -0.3 * k, 1e-8);
    assert_close(table_cell(m, k, "qdd.elbow"), 1.45, 1e-8);
  }
  ambulo__motion_free(m);
  ambulo_model_free(model);
}

/* accelerations given alone stay, and rates come from the values */
static void accelerations_alone(void **state) {
  dress d = {"time,q.shoulder,q.elbow,qdd.shoulder,qdd.elbow", 1.0, 1.0, 1, 0, 1, 0.05};
  one(state, &d, NULL, silence, 0.0, 0.1);
}

static void units_of_all_orders(void **state) {
  static const char *const told[] = {"note: the file says that its angles are in degrees; taken as "
                                     "radians",
                                     NULL};
  const double degrees = 57.295779513082321;
  ambulo_inverse_options options = ambulo_inverse_options_default();
  dress d = {"# inDegrees=yes\n" ALL, degrees, 1.0, 1, 1, 1, 0.05};
  one(state, &d, NULL, silence, 0.05, 0.1);
  d.header = ALL;
  options.angles = AMBULO_ANGLES_DEGREES;
  one(state, &d, &options, silence, 0.05, 0.1);
  d.time = 1000.0;
  options.time_unit = 0.001;
  one(state, &d, &options, silence, 0.05, 0.1);
  d = (dress){"# inDegrees=yes\n" ALL, 1.0, 1.0, 1, 1, 1, 0.05};
  options = ambulo_inverse_options_default();
  options.angles = AMBULO_ANGLES_RADIANS;
  one(state, &d, &options, told, 0.05, 0.1);
}

/* lengths, their rates and accelerations */
static void lengths_in_millimetres(void **state) {
  ambulo_model *model = NULL;
  ambulo_inverse_options options = ambulo_inverse_options_default();
  options.length_unit = 0.001;
  options.time_unit = 0.001;
  assert_int_equal(ambulo_model_load("models/opensim_2d_gait10.yaml", NULL, NULL, NULL, &model), 0);
  const char *path = scratch_path(state, "m.csv");
  scratch_write(path, "time,pelvis_tx,qd.pelvis_tx,qdd.pelvis_tx\n0,100,2,0.003\n10,120,2,0.003\n");
  ambulo__motion *m = inverse_of(model, path, &options, NULL, AMBULO_OK);
  assert_close(m->time[1], 0.01, 1e-15);
  assert_close(table_cell(m, 1, "q.pelvis_tx"), 0.12, 1e-15);
  assert_close(table_cell(m, 1, "qd.pelvis_tx"), 2.0, 1e-14);
  assert_close(table_cell(m, 1, "qdd.pelvis_tx"), 3.0, 1e-14);
  ambulo__motion_free(m);
  ambulo_model_free(model);
}

/* -3 dB at the cut-off, whatever the rates of the file say */
static void values_are_filtered(void **state) {
  static const char *const told[] = {
      "note: rates and accelerations are those of the filtered values", NULL};
  ambulo_model *model = arm_create();
  ambulo_inverse_options options = ambulo_inverse_options_default();
  const char *path = scratch_path(state, "m.csv");
  const double pi = 3.14159265358979323846;
  for (int order = 2; order <= 8; order += 2) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "time,shoulder,elbow%s\n", order == 4 ? ",qd.elbow" : "");
    for (int k = 0; k <= 200; k++)
      fprintf(file, "%.17g,%.17g,0.5%s\n", 0.01 * k, 0.2 * sin(2.0 * pi * 5.0 * 0.01 * k),
              order == 4 ? ",0.01" : "");
    fclose(file);
    options.cutoff = 5.0;
    options.filter_order = order;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    ambulo__motion *m = inverse_of(model, path, &options, list, AMBULO_OK);
    assert_messages(list, order == 4 ? told : silence);
    double most = 0.0, fastest = 0.0;
    for (int k = 60; k < 140; k++) {
      most = fmax(most, fabs(table_cell(m, k, "q.shoulder")));
      fastest = fmax(fastest, fabs(table_cell(m, k, "qd.shoulder")));
      assert_close(table_cell(m, k, "q.elbow"), 0.5, 1e-12);
      assert_close(table_cell(m, k, "qd.elbow"), 0.0, 1e-9);
    }
    assert_close(most, 0.2 * sqrt(0.5), 1e-6);
    assert_close(fastest, 0.2 * sqrt(0.5) * 2.0 * pi * 5.0, 1e-3);
    ambulo__motion_free(m);
  }
  scratch_write(path, "time,shoulder,elbow\n0,0,0\n0.1,0,0\n0.3,0,0\n0.4,0,0\n");
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  (void)inverse_of(model, path, &options, list, AMBULO_E_SCHEMA);
  assert_message(list, 0, "--filter needs equally spaced times");
  ambulo_diagnostics_free(list);
  ambulo_model_free(model);
}

/* rows that have everything need no spline, however few */
static void few_rows(void **state) {
  ambulo_model *model = arm_create();
  const char *path = scratch_path(state, "m.csv");
  scratch_write(path, ALL "\n0,0.1,0.2,0.3,0.4,0.5,0.6\n");
  ambulo__motion *m = inverse_of(model, path, NULL, NULL, AMBULO_OK);
  assert_int_equal(m->rows, 1);
  assert_close(table_cell(m, 0, "qdd.elbow"), 0.6, 0.0);
  ambulo__motion_free(m);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  scratch_write(path, "time,shoulder,elbow,qd.shoulder,qd.elbow\n0,0,0,0,0\n0.1,0,0,0,0\n");
  (void)inverse_of(model, path, NULL, list, AMBULO_E_SCHEMA);
  assert_message(list, 0, "2 times; expected at least 4 for rates and accelerations");
  ambulo_diagnostics_free(list);
  ambulo_model_free(model);
}

/* `th` beside `q.th`, two paths that end alike: both are named, all of them at once */
static void columns_that_contradict(void **state) {
  ambulo_model *model = arm_create();
  const char *path = scratch_path(state, "m.csv");
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  scratch_write(path, "time,shoulder,q.shoulder,/a/elbow/value,/b/elbow/value,qd.elbow,elbow_u\n"
                      "0,1,1,2,2,3,3\n0.1,1,1.5,2,2.5,3,3.5\n0.2,1,1,2,2,3,3\n0.3,1,1,2,2,3,3\n");
  (void)inverse_of(model, path, NULL, list, AMBULO_E_SCHEMA);
  assert_int_equal(ambulo_diagnostics_count(list), 2);
  assert_message(list, 0, "'shoulder' and 'q.shoulder' both stand for coordinate 'shoulder'");
  assert_message(list, 1, "'/a/elbow/value' and '/b/elbow/value' both stand for");
  ambulo__diagnostics_clear(list);
  scratch_write(path, "time,shoulder,elbow,qd.elbow,elbow_u\n0,1,1,2,3\n0.1,1,1,2,3\n");
  (void)inverse_of(model, path, NULL, list, AMBULO_E_SCHEMA);
  assert_message(list, 0, "'qd.elbow' and 'elbow_u' both stand for coordinate 'elbow'");
  ambulo_diagnostics_free(list);
  ambulo_model_free(model);
}

static void missing_columns(void **state) {
  ambulo_model *model = arm_create();
  const char *path = scratch_path(state, "motion.csv");
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  scratch_write(path, "time,shoulder,wrist\n0,1,1\n0.1,1,1\n0.2,1,1\n0.3,1,1\n");
  ambulo__motion *m = inverse_of(model, path, NULL, list, AMBULO_OK);
  assert_message(list, 0, "warning: no column for coordinate 'elbow'; it is taken as 0");
  assert_close(table_cell(m, 2, "q.elbow"), 0.0, 0.0);
  ambulo__motion_free(m);
  ambulo__diagnostics_clear(list);
  scratch_write(path, "time,ankle,wrist\n0,1,1\n0.1,1,1\n0.2,1,1\n0.3,1,1\n");
  (void)inverse_of(model, path, NULL, list, AMBULO_E_SCHEMA);
  assert_message(list, 0, "no column is named after a coordinate of model 'arm'");
  ambulo__diagnostics_clear(list);
  scratch_write(path, "time,shoulder,elbow\n0,1,1\n0.1,1,1e300\n0.2,1,-1e300\n0.3,1,1\n");
  (void)inverse_of(model, path, NULL, list, AMBULO_E_NUMERIC);
  assert_int_equal(ambulo_diagnostics_error_count(list), 1);
  ambulo_diagnostics_free(list);
  ambulo_model_free(model);
}

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

static int test_inverse_motion_tests(void) {
  const struct CMUnitTest tests[] = {SCRATCH_TEST(what_the_file_has_is_used),
                                     SCRATCH_TEST(slopes_of_rates),
                                     SCRATCH_TEST(accelerations_alone),
                                     SCRATCH_TEST(units_of_all_orders),
                                     SCRATCH_TEST(lengths_in_millimetres),
                                     SCRATCH_TEST(values_are_filtered),
                                     SCRATCH_TEST(few_rows),
                                     SCRATCH_TEST(columns_that_contradict),
                                     SCRATCH_TEST(missing_columns)};
  return cmocka_run_group_tests_name("inverse/inverse_motion", tests, NULL, NULL);
}

int main(void) {
  return test_filtering_tests() + test_inverse_motion_tests();
}
