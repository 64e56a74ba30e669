/* Inverse dynamics of motion files: our own results come back, and where the table goes. */
#include "support/arm.h"
#include "ambulo/tools/load.h"
#include "support/inverse_table.h"
#include "support/scratch.h"
#include "support/walker_result.h"

#include <glob.h>

/* ---------------------------------------------------------------- round trip */

/* A few steps of a solve of a problem file into <scratch>/walk; its motion.csv. What comes back
 * does so from every motion: it need not be the best. */
static const char *solve(void **state, const char *file, ambulo_problem **problem) {
  ambulo_result *result = NULL;
  ambulo_report_options options = ambulo_report_options_default();
  const char *folder = scratch_path(state, "walk");
  options.overwrite = 1;
  assert_int_equal(ambulo_problem_load(file, NULL, 0, NULL, NULL, problem), AMBULO_OK);
  ambulo_options few = ambulo_problem_options(*problem);
  few.maximum_iterations = 3;
  few.continuation = 0;
  few.feasibility_tolerance = few.optimality_tolerance = 1.0;
  assert_int_equal(ambulo_solve(*problem, &few, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_report_write(*problem, result, folder, &options, NULL, NULL), AMBULO_OK);
  ambulo_result_free(result);
  return scratch_path(state, "walk/motion.csv");
}

/* largest difference of the columns that begin with `prefix`, of which there are `count` */
static double difference(const ambulo__motion *a, const ambulo__motion *b, const char *prefix,
                         int count) {
  double worst = 0.0;
  assert_int_equal(a->rows, b->rows);
  for (int c = 0; c < a->columns; c++) {
    if (strncmp(a->names[c], prefix, strlen(prefix)) != 0) continue;
    count--;
    for (int k = 0; k < a->rows; k++) {
      double x = a->values[k * a->columns + c], y = table_cell(b, k, a->names[c]);
      if (isnan(x) && isnan(y)) continue;
      worst = isnan(x - y) ? INFINITY : fmax(worst, fabs(x - y));
    }
  }
  assert_int_equal(count, 0);
  return worst;
}

static int columns_of(const ambulo__motion *m, const char *prefix) {
  int count = 0;
  for (int c = 0; c < m->columns; c++) count += strncmp(m->names[c], prefix, strlen(prefix)) == 0;
  return count;
}

/* adds torques of devices at joints to those of the person; 0: some device is between two points */
static int add_devices(const ambulo_problem *problem, ambulo__motion *motion) {
  int complete = 1;
  for (int i = 0; i < ambulo_problem_device_count(problem); i++) {
    const ambulo_device *device = ambulo_problem_device(problem, i);
    const ambulo_coordinate *c =
        ambulo_model_coordinate(ambulo_problem_model(problem), device->coordinate);
    char own[100], person[100];
    complete &= c != NULL;
    if (!c) continue;
    (void)snprintf(own, sizeof own, "device.%s.torque", device->name);
    (void)snprintf(person, sizeof person, "tau.%s", c->name);
    int from = ambulo__motion_column(motion, own), to = ambulo__motion_column(motion, person);
    for (int k = 0; k < motion->rows; k++)
      motion->values[k * motion->columns + to] += motion->values[k * motion->columns + from];
  }
  return complete;
}

/* every torque to 1e-9 of the body weight (times 1 m), from solve to motion.csv to inverse */
static void comes_back(void **state, const char *file) {
  ambulo_problem *problem = NULL;
  const char *path = solve(state, file, &problem);
  const ambulo_model *model = ambulo_problem_model(problem);
  double weight = 9.81 * ambulo_model_mass(model);
  int d = ambulo_model_coordinate_count(model);
  ambulo_inverse_options options = ambulo_inverse_options_default();
  ambulo_ground_residual residual = {.moment_rms = 7.0};
  ambulo__motion *solved = NULL;
  char *text = NULL;
  options.strict = 1;
  options.ground_height = ambulo_problem_ground_height(problem);
  assert_int_equal(ambulo__motion_read(path, 0, NULL, NULL, &solved), AMBULO_OK);
  int loaded = ambulo__motion_column(solved, "grf.left.x") >= 0;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_inverse_dynamics_motion(
      model, path, NULL, &options, NULL, list,
      &(ambulo_inverse_outputs){
          .size = sizeof(ambulo_inverse_outputs), .residual = &residual, .text = &text});
  if (status) assert_message(list, 0, "(no message)");
  assert_int_equal(status, AMBULO_OK);
  ambulo__motion *m = table_of_text(text);
  int complete = add_devices(problem, solved); /* inverse dynamics are of person and devices */
  assert_true(!complete || difference(solved, m, "tau.", d) < 1e-9 * weight);
  assert_true(difference(solved, m, "qdd.", d) == 0.0);
  assert_true(difference(solved, m, "zmp.", 3) < 1e-9);
  if (loaded) {
    assert_true(difference(solved, m, "grf.", 6) < 1e-9 * weight);
    assert_true(difference(solved, m, "moment.", 6) < 1e-9 * weight);
    assert_true(residual.force_rms[1] < 1e-9 && residual.moment_rms < 1e-9);
    for (int k = 0; k < m->rows; k++)
      assert_true(fabs(table_cell(m, k, "residual.moment.z")) < 1e-9 * weight);
  } else {
    assert_true(residual.moment_rms == 7.0);
    assert_int_equal(ambulo__motion_column(m, "residual.force.x"), -1);
  }
  assert_true(difference(solved, m, "held.", columns_of(solved, "held.")) < 1e-9 * weight);
  ambulo_diagnostics_free(list);
  ambulo_text_free(text, NULL);
  ambulo__motion_free(m);
  ambulo__motion_free(solved);
  ambulo_problem_free(problem);
}

static void every_shipped_walk_comes_back(void **state) {
  glob_t found;
  int problems = 0;
  assert_int_equal(glob("models/walk*.yaml", 0, NULL, &found), 0);
  for (size_t i = 0; i < found.gl_pathc; i++) {
    ambulo_file_kind kind = AMBULO_FILE_MODEL;
    assert_int_equal(ambulo_file_kind_of(found.gl_pathv[i], NULL, NULL, &kind), AMBULO_OK);
    if (kind != AMBULO_FILE_PROBLEM) continue;
    comes_back(state, found.gl_pathv[i]);
    problems++;
  }
  globfree(&found);
  assert_true(problems >= 10);
}

/* what hands hold on the way, from the floor, and what they push; its own table has it too */
static void what_hands_hold_comes_back(void **state) {
  comes_back(state, "models/lift.yaml");
  comes_back(state, "models/push_wall.yaml");
}

/* what inverse wrote is a motion too */
static void table_comes_back(void **state, const char *file, int d) {
  ambulo_problem *problem = NULL;
  const char *motion = solve(state, file, &problem);
  const ambulo_model *model = ambulo_problem_model(problem);
  const char *first = scratch_path(state, "first.csv"), *second = scratch_path(state, "second.csv");
  ambulo__motion *a = NULL, *b = NULL;
  assert_int_equal(ambulo_inverse_dynamics_motion(model, motion, first, NULL, NULL, NULL, NULL), 0);
  assert_int_equal(ambulo_inverse_dynamics_motion(model, first, second, NULL, NULL, NULL, NULL), 0);
  assert_int_equal(ambulo__motion_read(first, 0, NULL, NULL, &a), AMBULO_OK);
  assert_int_equal(ambulo__motion_read(second, 0, NULL, NULL, &b), AMBULO_OK);
  assert_true(difference(a, b, "tau.", d) < 1e-9);
  assert_true(difference(a, b, "power.", d) < 1e-8);
  assert_true(difference(a, b, "wrench.", 6) < 1e-9);
  assert_true(difference(a, b, "free_moment.", 2) < 1e-9);
  assert_true(difference(a, b, "moment.", 6) < 1e-9);
  assert_true(difference(a, b, "held.", columns_of(a, "held.")) < 1e-9);
  ambulo__motion_free(a);
  ambulo__motion_free(b);
  ambulo_problem_free(problem);
}

static void its_own_table_comes_back(void **state) {
  table_comes_back(state, "tests/support/walk_rigid.yaml", 18);
  table_comes_back(state, "models/walk_carrying.yaml", 31);
}

/* wrench, power and residual are what they are called; other ways to name the same forces */
static void wrench_power_and_residual(void **state) {
  ambulo_problem *problem = NULL;
  const char *motion = solve(state, "tests/support/walk_rigid.yaml", &problem);
  const ambulo_model *model = ambulo_problem_model(problem);
  ambulo_inverse_options options = ambulo_inverse_options_default();
  ambulo__motion *with = inverse_of(model, motion, &options, NULL, AMBULO_OK);
  options.forces = motion;
  ambulo__motion *named = inverse_of(model, motion, &options, NULL, AMBULO_OK);
  options.without_forces = 1;
  ambulo__motion *without = inverse_of(model, motion, &options, NULL, AMBULO_OK);
  assert_true(difference(with, named, "tau.", 18) == 0.0);
  assert_int_equal(ambulo__motion_column(without, "grf.left.x"), -1);
  for (int k = 0; k < with->rows; k++) {
    assert_close(table_cell(with, k, "power.knee_angle_r"),
                 table_cell(with, k, "tau.knee_angle_r") * table_cell(with, k, "qd.knee_angle_r"),
                 1e-13);
    /* without forces the root carries all: its forces are the root wrench */
    assert_close(table_cell(without, k, "tau.pelvis_ty"), table_cell(without, k, "wrench.force.y"),
                 1e-9);
    assert_close(table_cell(with, k, "wrench.force.y"),
                 table_cell(with, k, "grf.left.y") + table_cell(with, k, "grf.right.y"), 1e-9);
    /* M = p x F on level ground: M_z = x F_y, M_x = - z F_y */
    assert_close(table_cell(with, k, "wrench.moment.z"),
                 table_cell(with, k, "zmp.x") * table_cell(with, k, "wrench.force.y"), 1e-9);
    assert_close(table_cell(with, k, "wrench.moment.x"),
                 -table_cell(with, k, "zmp.z") * table_cell(with, k, "wrench.force.y"), 1e-9);
  }
  options = ambulo_inverse_options_default();
  options.ground_height = 0.5;
  ambulo__motion *high = inverse_of(model, motion, &options, NULL, AMBULO_OK);
  for (int k = 0; k < high->rows; k++) {
    double share = table_cell(high, k, "wrench.force.x") / table_cell(high, k, "wrench.force.y");
    assert_close(table_cell(high, k, "zmp.y"), 0.5, 1e-14);
    assert_close(table_cell(high, k, "zmp.x"), table_cell(with, k, "zmp.x") + 0.5 * share, 1e-12);
  }
  ambulo__motion_free(high);
  ambulo__motion_free(with);
  ambulo__motion_free(named);
  ambulo__motion_free(without);
  ambulo_problem_free(problem);
}

/* ------------------------------------------------------------------- output */

static const char *write_arm(void **state) {
  const char *path = scratch_path(state, "arm.csv");
  scratch_write(path, "time,shoulder,elbow\n0,0,0.1\n0.1,0.1,0.1\n0.2,0.3,0.1\n0.3,0.4,0.1\n");
  return path;
}

static ambulo_status write_to(const ambulo_model *model, const char *motion, const char *output,
                              int overwrite, ambulo_diagnostics *list) {
  ambulo_inverse_options options = ambulo_inverse_options_default();
  options.overwrite = overwrite;
  return ambulo_inverse_dynamics_motion(model, motion, output, &options, NULL, list, NULL);
}

/* without forces, by default otherwise */
static ambulo_status of_file(const ambulo_model *model, const char *motion, const char *output,
                             const ambulo_allocator *allocator, char **text) {
  ambulo_inverse_options options = ambulo_inverse_options_default();
  ambulo_inverse_outputs outputs = ambulo_inverse_outputs_default();
  options.without_forces = 1;
  outputs.text = text;
  return ambulo_inverse_dynamics_motion(model, motion, output, &options, allocator, NULL, &outputs);
}

static void files_and_texts_agree(void **state) {
  ambulo_model *model = arm_create();
  const char *motion = write_arm(state), *output = scratch_path(state, "out.csv");
  char *text = NULL;
  assert_int_equal(of_file(model, motion, NULL, NULL, &text), AMBULO_OK);
  for (int again = 0; again < 2; again++) {
    assert_int_equal(of_file(model, motion, output, NULL, NULL), AMBULO_OK);
    assert_file_equal(output, text);
  }
  assert_memory_equal(text, "# ambulo motion: mass 3.5 kg, gravity 0 -9.81 0 m/s^2; SI units", 62);
  ambulo_text_free(text, NULL);
  ambulo_model_free(model);
}

static void inputs_and_files_of_others_are_kept(void **state) {
  ambulo_model *model = arm_create();
  const char *motion = write_arm(state), *own = scratch_path(state, "own.csv");
  const char *link_name = scratch_path(state, "link.csv"),
             *other = scratch_path(state, "thesis.tex");
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  char *before = read_text(motion);
  scratch_write(other, "years of work");
  assert_int_equal(symlink(motion, link_name), 0);
  assert_int_equal(write_to(model, motion, motion, 0, list), AMBULO_E_IO);
  assert_message(list, 0, "the output is the input");
  assert_int_equal(write_to(model, motion, link_name, 0, list), AMBULO_E_IO);
  assert_message(list, 1, "the output is the input");
  assert_int_equal(write_to(model, motion, other, 0, list), AMBULO_E_IO);
  assert_message(list, 2, "ambulo did not write it");
  assert_file_equal(other, "years of work");
  /* its own table is written over, unless it is the input */
  assert_int_equal(write_to(model, motion, own, 0, NULL), AMBULO_OK);
  assert_int_equal(write_to(model, motion, own, 0, NULL), AMBULO_OK);
  assert_int_equal(write_to(model, own, own, 0, list), AMBULO_E_IO);
  assert_message(list, 3, "the output is the input");
  char *after = read_text(motion);
  assert_string_equal(before, after);
  /* forces are inputs as well */
  ambulo_inverse_options options = ambulo_inverse_options_default();
  options.forces = own;
  assert_int_equal(ambulo_inverse_dynamics_motion(model, motion, own, &options, NULL, list, NULL),
                   AMBULO_E_IO);
  assert_message(list, 4, "the output is the input");
  assert_int_equal(write_to(model, motion, other, 1, NULL), AMBULO_OK);
  assert_int_equal(write_to(model, motion, motion, 1, NULL), AMBULO_OK);
  assert_int_equal(entries_in(*state), 4);
  free(before);
  free(after);
  ambulo_diagnostics_free(list);
  ambulo_model_free(model);
}

/* an allocator that meanwhile lets somebody else write where the output is to go */
static void *resize_and_intrude(void *user, void *pointer, size_t size) {
  const char *path = user;
  if (access(path, F_OK) != 0) scratch_write(path, "years of work");
  if (size > 0) return realloc(pointer, size);
  free(pointer);
  return NULL;
}

static void what_appears_in_the_meantime_is_kept(void **state) {
  ambulo_model *model = arm_create();
  char output[SCRATCH_PATH + 256];
  snprintf(output, sizeof output, "%s", scratch_path(state, "out.csv"));
  ambulo_allocator intruder = {resize_and_intrude, output};
  assert_int_equal(of_file(model, write_arm(state), output, &intruder, NULL), AMBULO_E_IO);
  assert_file_equal(output, "years of work");
  ambulo_model_free(model);
}

static void nothing_is_written_after_a_doubt_of_the_strict(void **state) {
  ambulo_model *model = arm_create();
  ambulo_inverse_options options = ambulo_inverse_options_default();
  const char *motion = scratch_path(state, "m.csv"), *output = scratch_path(state, "out.csv");
  scratch_write(motion, "time,shoulder\n0,0\n0.1,0\n0.2,0\n0.3,0\n");
  options.strict = 1;
  assert_int_equal(
      ambulo_inverse_dynamics_motion(model, motion, output, &options, NULL, NULL, NULL),
      AMBULO_E_SCHEMA);
  assert_int_equal(entries_in(*state), 1);
  ambulo_model_free(model);
}

static void bad_arguments(void **state) {
  ambulo_model *model = arm_create();
  const char *motion = write_arm(state);
  char *text = NULL;
  ambulo_inverse_options good = ambulo_inverse_options_default(), bad[12];
  for (int i = 0; i < 12; i++) bad[i] = good;
  bad[0].size = 0;
  bad[1].length_unit = 0.0;
  bad[2].time_unit = -1.0;
  bad[3].force_length_unit = (double)NAN;
  bad[4].force_time_unit = INFINITY;
  bad[5].cutoff = -1.0;
  bad[6].cutoff = 0.0;
  bad[7].force_cutoff = 0.0;
  bad[8].filter_order = 3;
  bad[9].filter_order = 0;
  bad[10].ground_height = (double)NAN;
  bad[11].filter_order = 10;
  for (int i = 0; i < 12; i++)
    assert_int_equal(
        ambulo_inverse_dynamics_motion(
            model, motion, NULL, &bad[i], NULL, NULL,
            &(ambulo_inverse_outputs){.size = sizeof(ambulo_inverse_outputs), .text = &text}),
        AMBULO_E_ARGUMENT);
  assert_int_equal(
      ambulo_inverse_dynamics_motion(
          NULL, motion, NULL, NULL, NULL, NULL,
          &(ambulo_inverse_outputs){.size = sizeof(ambulo_inverse_outputs), .text = &text}),
      AMBULO_E_ARGUMENT);
  assert_int_equal(
      ambulo_inverse_dynamics_motion(
          model, NULL, NULL, NULL, NULL, NULL,
          &(ambulo_inverse_outputs){.size = sizeof(ambulo_inverse_outputs), .text = &text}),
      AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_inverse_dynamics_motion(model, motion, NULL, NULL, NULL, NULL, NULL),
                   AMBULO_E_ARGUMENT);
  assert_null(text);
  good.forces = motion;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(
      ambulo_inverse_dynamics_motion(
          model, motion, NULL, &good, NULL, list,
          &(ambulo_inverse_outputs){.size = sizeof(ambulo_inverse_outputs), .text = &text}),
      AMBULO_E_SCHEMA);
  assert_message(list, 0, "the model 'arm' has no feet that forces could act on");
  ambulo_diagnostics_free(list);
  ambulo_model_free(model);
}

static void a_full_device(void **state) {
  ambulo_model *model = arm_create();
  assert_int_equal(of_file(model, write_arm(state), "/dev/full", NULL, NULL), AMBULO_E_IO);
  ambulo_model_free(model);
}

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

int main(void) {
  const struct CMUnitTest tests[] = {SCRATCH_TEST(every_shipped_walk_comes_back),
                                     SCRATCH_TEST(what_hands_hold_comes_back),
                                     SCRATCH_TEST(its_own_table_comes_back),
                                     SCRATCH_TEST(wrench_power_and_residual),
                                     SCRATCH_TEST(files_and_texts_agree),
                                     SCRATCH_TEST(inputs_and_files_of_others_are_kept),
                                     SCRATCH_TEST(what_appears_in_the_meantime_is_kept),
                                     SCRATCH_TEST(nothing_is_written_after_a_doubt_of_the_strict),
                                     SCRATCH_TEST(bad_arguments),
                                     SCRATCH_TEST(a_full_device)};
  return cmocka_run_group_tests_name("inverse/inverse", tests, NULL, NULL);
}
