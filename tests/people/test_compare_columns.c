/* Names, units and signs of OpenSim and of Plug-in Gait: each file gives the same table. */
#include "people/compare.h"
#include "support/messages.h"
#include "support/subject_motion.h"

#define RAD (SUBJECT_PI / 180.0)

static ambulo_status read_columns(const char *file, ambulo_diagnostics *list, ambulo__subject *s) {
  ambulo__motion *motion = NULL;
  *s = (ambulo__subject){.diagnostics = list, .file = file};
  s->allocator = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__motion_read(file, 0, NULL, list, &motion), AMBULO_OK);
  ambulo_status status = ambulo__subject_columns(s, motion, NULL, 0);
  ambulo__motion_free(motion);
  return status;
}

/* the column is that angle of that side in rad, in all rows */
static void expect_angle(const ambulo__subject *s, const char *column, const char *angle,
                         int side) {
  int at = ambulo__motion_column(s->table, column);
  if (at < 0) print_error("no column %s\n", column);
  assert_true(at >= 0);
  for (int k = 0; k < s->table->rows; k += 7) {
    double share = subject_share(side, s->table->time[k]);
    double value = s->table->values[(size_t)k * (size_t)s->table->columns + (size_t)at];
    if (fabs(value - RAD * subject_angle(angle, side, share)) > 1e-7) print_error("%s\n", column);
    assert_close(value, RAD * subject_angle(angle, side, share), 1e-7);
  }
}

static void expect_all(const ambulo__subject *s) {
  static const char *const joints[] = {"hip_flexion", "hip_adduction", "hip_rotation", "knee_angle",
                                       "ankle_angle"};
  expect_angle(s, "q.pelvis_tilt", "pelvis_tilt", 0);
  expect_angle(s, "q.pelvis_list", "pelvis_list", 0);
  expect_angle(s, "q.pelvis_rotation", "pelvis_rotation", 0);
  for (int side = 0; side < 2; side++) {
    for (int i = 0; i < 5; i++) {
      char name[64];
      (void)snprintf(name, sizeof name, "q.%s_%c", joints[i], "lr"[side]);
      expect_angle(s, name, joints[i], side);
    }
  }
}

static void plain_names_in_degrees(void **state) {
  ambulo__subject s;
  assert_int_equal(read_columns(subject_plain(state), NULL, &s), AMBULO_OK);
  assert_int_equal(s.table->columns, SUBJECT_ANGLES);
  assert_int_equal(s.marker_pelvis, 0);
  expect_all(&s);
  ambulo__subject_free(&s);
}

/* an STO of OpenSim in radians, its knees bent with negative angles, and the way back along -x */
static void paths_in_radians(void **state) {
  static const subject_column columns[] = {
      {"/jointset/ground_pelvis/pelvis_tx/value", "hip_flexion", 0, 0, 0.0},
      {"/jointset/hip_l/hip_flexion_l/value", "hip_flexion", 0, 0, RAD},
      {"/jointset/knee_l/knee_angle_l/value", "knee_angle", 0, 0, -RAD},
      {"/jointset/knee_l/knee_angle_l/speed", "knee_angle", 0, 0, 7.0},
      {"/jointset/knee_r/knee_angle_r/value", "knee_angle", 1, 0, RAD}};
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__subject s;
  const char *path =
      subject_write(state, "subject.sto", "walk\ninDegrees=no\nendheader\n", columns, 5, 0.0);
  assert_int_equal(read_columns(path, list, &s), AMBULO_OK);
  expect_angle(&s, "q.hip_flexion_l", "hip_flexion", 0);
  expect_angle(&s, "q.knee_angle_l", "knee_angle", 0);
  expect_angle(&s, "q.knee_angle_r", "knee_angle", 1);
  assert_message(list, 0, "'/jointset/knee_l/knee_angle_l/value' bends with negative angles");
  assert_int_equal(ambulo_diagnostics_count(list), 1);
  ambulo__subject_free(&s);
  ambulo_diagnostics_free(list);
}

static void plug_in_gait(void **state) {
  static const subject_column columns[] = {{"S01:LPelvisAngles_x", "pelvis_tilt", 0, 0, -1},
                                           {"S01:LPelvisAngles_y", "pelvis_list", 0, 0, 1},
                                           {"S01:LPelvisAngles_z", "pelvis_rotation", 0, 0, -1},
                                           {"S01:LHipAngles_x", "hip_flexion", 0, 0, 1},
                                           {"LHipAngles.Y", "hip_adduction", 0, 0, 1},
                                           {"LHipAngles (3)", "hip_rotation", 0, 0, 1},
                                           {"LKneeAngles:X", "knee_angle", 0, 0, 1},
                                           {"LAnkleAngles1", "ankle_angle", 0, 0, 1},
                                           {"RHipAngles x", "hip_flexion", 1, 0, 1},
                                           {"RHipAngles y", "hip_adduction", 1, 0, 1},
                                           {"RHipAngles z", "hip_rotation", 1, 0, 1},
                                           {"RKneeAngles x", "knee_angle", 1, 0, 1},
                                           {"RAnkleAngles x", "ankle_angle", 1, 0, 1}};
  ambulo__subject s;
  const char *path = subject_write(state, "pig.csv", "", columns, 13, 0.0);
  assert_int_equal(read_columns(path, NULL, &s), AMBULO_OK);
  assert_int_equal(s.marker_pelvis, 1);
  expect_all(&s);
  ambulo__subject_free(&s);
}

/* of the pelvis the right side alone: up and forward are those of the right */
static void the_right_side_of_the_pelvis(void **state) {
  static const subject_column columns[] = {{"RPelvisAngles_x", "pelvis_tilt", 0, 0, -1},
                                           {"RPelvisAngles_y", "pelvis_list", 0, 0, -1},
                                           {"RPelvisAngles_z", "pelvis_rotation", 0, 0, 1}};
  ambulo__subject s;
  const char *path = subject_write(state, "pig.csv", "", columns, 3, 0.0);
  assert_int_equal(read_columns(path, NULL, &s), AMBULO_OK);
  expect_angle(&s, "q.pelvis_tilt", "pelvis_tilt", 0);
  expect_angle(&s, "q.pelvis_list", "pelvis_list", 0);
  expect_angle(&s, "q.pelvis_rotation", "pelvis_rotation", 0);
  ambulo__subject_free(&s);
}

static void units_that_are_not_stated(void **state) {
  static const subject_column degrees[] = {{"hip_flexion_l", "hip_flexion", 0, 0, 1}};
  static const subject_column radians[] = {{"hip_flexion_l", "hip_flexion", 0, 0, RAD}};
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__subject s;
  assert_int_equal(read_columns(subject_write(state, "a.csv", "", radians, 1, 0.0), list, &s),
                   AMBULO_OK);
  expect_angle(&s, "q.hip_flexion_l", "hip_flexion", 0);
  assert_int_equal(ambulo_diagnostics_count(list), 0);
  ambulo__subject_free(&s);
  assert_int_equal(read_columns(subject_write(state, "b.csv", "", degrees, 1, 0.0), list, &s),
                   AMBULO_OK);
  expect_angle(&s, "q.hip_flexion_l", "hip_flexion", 0);
  assert_message(list, 0, "taken for degrees");
  ambulo__subject_free(&s);
  ambulo_diagnostics_free(list);
}

static void nothing_that_is_known(void **state) {
  static const subject_column columns[] = {{"LHipAngles_w", "hip_flexion", 0, 0, 1},
                                           {"MyLHipAngles_x", "hip_flexion", 0, 0, 1},
                                           {"LHipAngles_xy", "hip_flexion", 0, 0, 1}};
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__subject s;
  const char *path = subject_write(state, "other.csv", "", columns, 3, 0.0);
  assert_int_equal(read_columns(path, list, &s), AMBULO_E_SCHEMA);
  assert_message(list, 0,
                 "the file has LHipAngles_w, MyLHipAngles_x, LHipAngles_xy; expected names");
  ambulo_diagnostics_free(list);
}

/* letters of another case are other names */
static void a_name_that_is_near(void **state) {
  static const subject_column columns[] = {{"marker", "hip_flexion", 0, 0, 1},
                                           {"Knee_angle_R", "knee_angle", 1, 0, 1}};
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__subject s;
  const char *path = subject_write(state, "other.csv", "", columns, 2, 0.0);
  assert_int_equal(read_columns(path, list, &s), AMBULO_E_SCHEMA);
  assert_message(list, 0, "hint: did you mean 'knee_angle_r' with 'Knee_angle_R'?");
  ambulo_diagnostics_free(list);
}

static int test_compare_columns_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(plain_names_in_degrees, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(paths_in_radians, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(plug_in_gait, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(the_right_side_of_the_pelvis, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(units_that_are_not_stated, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(a_name_that_is_near, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(nothing_that_is_known, scratch_open, scratch_close)};
  return cmocka_run_group_tests_name("compare/compare_columns", tests, NULL, NULL);
}

/* Forces beside a person's own motion: whose they are, at which times, and where they begin. */

typedef struct measured {
  ambulo__subject subject;
  double onsets[2][AMBULO__MOST_STRIKES];
  int count[2];
} measured;

static ambulo_status read_forces(void **state, const char *file, const char *map,
                                 ambulo_diagnostics *list, measured *m) {
  static const char *const names[] = {"grf.left.x",  "grf.left.y",  "grf.left.z",
                                      "grf.right.x", "grf.right.y", "grf.right.z"};
  ambulo__motion *motion = NULL;
  double *const onsets[2] = {m->onsets[0], m->onsets[1]};
  const char *path = subject_plain(state);
  m->subject = (ambulo__subject){.diagnostics = list, .file = path};
  m->subject.allocator = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__motion_read(path, 0, NULL, NULL, &motion), AMBULO_OK);
  assert_int_equal(ambulo__subject_columns(&m->subject, motion, names, 6), AMBULO_OK);
  ambulo__motion_free(motion);
  return ambulo__subject_forces(&m->subject, file, map, onsets, m->count);
}

static double force_at(const measured *m, const char *column, double t) {
  const ambulo__motion *table = m->subject.table;
  int at = ambulo__motion_column(table, column);
  return table->values[(size_t)lround(100.0 * t) * (size_t)table->columns + (size_t)at];
}

static void by_name_and_by_map(void **state) {
  static const struct {
    const char *left, *right, *map;
  } cases[] = {{"ground_force_l", "ground_force_r", NULL},
               {"ground_force_left", "ground_force_right", NULL},
               {"l_ground_force", "R_ground_force", NULL},
               {"ground_force_calcn_l", "ground_force_calcn_r", NULL},
               {"ground_force_1", "ground_force_2", "left=ground_force_1,right=ground_force_2"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    static measured m;
    const char *file = subject_forces(state, cases[i].left, cases[i].right, 0.005);
    assert_int_equal(read_forces(state, file, cases[i].map, NULL, &m), AMBULO_OK);
    /* the middle of the left foot's stance; the right foot hangs */
    assert_close(force_at(&m, "grf.left.y", 0.86), 700.0, 0.5);
    assert_close(force_at(&m, "grf.right.y", 0.86), 0.0, 1e-9);
    assert_close(force_at(&m, "grf.right.y", 1.46), 700.0, 0.5);
    assert_close(force_at(&m, "grf.left.x", 0.68), -100.0, 0.2);
    assert_int_equal(m.count[0], 5);
    assert_close(m.onsets[0][0], 0.5 + 0.72 / SUBJECT_PI * asin(20.0 / 700.0), 1e-3);
    assert_close(m.onsets[1][0], 1.1 + 0.72 / SUBJECT_PI * asin(20.0 / 700.0), 1e-3);
    ambulo__subject_free(&m.subject);
  }
}

/* 0 where the file has nothing, and no onset of a push too small to be a step */
static void gaps(void **state) {
  static measured m;
  const char *path = scratch_path(state, "gaps.mot");
  FILE *f = fopen(path, "w");
  assert_non_null(f);
  fprintf(f, "forces\nendheader\ntime\tground_force_l_vy\n");
  for (int k = 0; k <= 200; k++) {
    double t = 1.0 + 0.01 * k;
    int step = t >= 2.0 && t < 2.6, push = t >= 1.3 && t < 1.4;
    if (k < 5) {
      fprintf(f, "%.10g\tnan\n", t);
    } else {
      fprintf(f, "%.10g\t%d\n", t, step ? 800 : push ? 90 : 0);
    }
  }
  assert_int_equal(fclose(f), 0);
  assert_int_equal(read_forces(state, path, NULL, NULL, &m), AMBULO_OK);
  assert_int_equal(m.count[0], 1);
  assert_int_equal(m.count[1], 0);
  assert_close(m.onsets[0][0], 2.0, 0.011);
  assert_close(force_at(&m, "grf.left.y", 0.5), 0.0, 0.0);
  assert_close(force_at(&m, "grf.left.y", 1.02), 0.0, 0.0);
  assert_close(force_at(&m, "grf.left.y", 2.3), 800.0, 1e-9);
  assert_close(force_at(&m, "grf.left.y", 5.0), 0.0, 0.0);
  ambulo__subject_free(&m.subject);
}

static void refusals(void **state) {
  static measured m;
  static const char *const maps[] = {"left=ground_force_3", "paw=ground_force_1", "left"};
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  const char *file = subject_forces(state, "ground_force_1", "ground_force_2", 0.0);
  assert_int_equal(read_forces(state, file, NULL, list, &m), AMBULO_E_SCHEMA);
  assert_message(list, 0, "says whose foot it is; the file has ground_force_1, ground_force_2");
  ambulo__subject_free(&m.subject);
  for (size_t i = 0; i < 3; i++) {
    assert_int_equal(read_forces(state, file, maps[i], list, &m), AMBULO_E_SCHEMA);
    assert_message(list, i + 1, "name no foot and group of this file");
    ambulo__subject_free(&m.subject);
  }
  ambulo_diagnostics_free(list);
}

static int test_compare_forces_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(by_name_and_by_map, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(gaps, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(refusals, scratch_open, scratch_close)};
  return cmocka_run_group_tests_name("compare/compare_forces", tests, NULL, NULL);
}

int main(void) {
  return test_compare_columns_tests() + test_compare_forces_tests();
}
