/* Forces on the feet from files: force and moment between rows, gaps, units, and what is missing.
 */
#include "people/ground_load.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/planar_walker.h"
#include "support/scratch.h"

enum { ROWS = 3 };
static const double times[ROWS] = {0.0, 0.5, 1.0};

typedef struct fixture {
  ambulo_model *model;
  ambulo_inverse_options options;
  ambulo__doubts doubts;
  ambulo__ground_load load;
  int right; /* of the two feet */
} fixture;

static fixture open_fixture(void) {
  fixture f = {.model = planar_walker_create(), .options = ambulo_inverse_options_default()};
  f.right = ambulo_model_find_foot(f.model, "right");
  assert_true(f.right >= 0 && ambulo_model_find_foot(f.model, "left") >= 0);
  return f;
}

static void close_fixture(const fixture *f) {
  ambulo_model_free(f->model);
}

static ambulo_status read_with(void **state, fixture *f, const char *text,
                               const ambulo_allocator *allocator) {
  const char *path = scratch_path(state, "forces.csv");
  scratch_write(path, text);
  ambulo__load_source source = {.model = f->model,
                                .file = path,
                                .options = &f->options,
                                .times = times,
                                .rows = ROWS,
                                .doubts = &f->doubts};
  return ambulo__ground_load_read(&source, allocator, &f->load);
}

/* reads; the messages must be `messages`, in order, separated by newlines (NULL: none) */
static ambulo_status read_text_of(void **state, fixture *f, const char *text,
                                  const char *const *messages, int count) {
  f->doubts = (ambulo__doubts){ambulo_diagnostics_create(NULL), 0, 0, 0};
  ambulo_status status = read_with(state, f, text, NULL);
  if ((int)ambulo_diagnostics_count(f->doubts.diagnostics) != count) {
    print_error("%s\n", text);
    for (size_t i = 0; i < ambulo_diagnostics_count(f->doubts.diagnostics); i++)
      print_error("  %s\n", ambulo_diagnostics_get(f->doubts.diagnostics, i)->message);
  }
  assert_int_equal(ambulo_diagnostics_count(f->doubts.diagnostics), count);
  for (int i = 0; i < count; i++) assert_message(f->doubts.diagnostics, (size_t)i, messages[i]);
  ambulo_diagnostics_free(f->doubts.diagnostics);
  return status;
}

#define GOOD(text, ...)                                                                            \
  do {                                                                                             \
    static const char *const messages_[] = {__VA_ARGS__};                                          \
    int count_ = (int)(sizeof messages_ / sizeof *messages_) - 1;                                  \
    assert_int_equal(read_text_of(state, &f, text, messages_, count_), AMBULO_OK);                 \
  } while (0)
#define BAD(text, status, ...)                                                                     \
  do {                                                                                             \
    static const char *const messages_[] = {__VA_ARGS__};                                          \
    int count_ = (int)(sizeof messages_ / sizeof *messages_) - 1;                                  \
    assert_int_equal(read_text_of(state, &f, text, messages_, count_), status);                    \
  } while (0)

/* force and moment of the right foot at row k; planar: only x, y and the moment about z count */
static void expect(const fixture *f, int k, double fx, double fy, double mz) {
  size_t at = 3 * (2 * (size_t)k + (size_t)f->right);
  assert_close(f->load.force[at], fx, 1e-12);
  assert_close(f->load.force[at + 1], fy, 1e-12);
  assert_close(f->load.moment[at + 2], mz, 1e-12);
}

#define NOTHING_LEFT "no columns of forces on foot 'left'"
#define NO_TORQUE "has no torques"

static void rows_are_joined_by_lines(void **state) {
  fixture f = open_fixture();
  GOOD("time,ground_force_r_vx,ground_force_r_vy,ground_force_r_px,ground_force_r_py,"
       "ground_torque_r_z,ground_force_l_vx,ground_force_l_vy,ground_force_l_px,ground_force_l_py,"
       "ground_torque_l_z\n"
       "-1,0,0,0,0,0,0,0,0,0,0\n1,10,20,0.4,0.1,2,0,6,0.5,0,0\n",
       NULL);
  expect(&f, 0, 5.0, 10.0, 0.5 * (0.4 * 20 - 0.1 * 10 + 2.0));
  expect(&f, 1, 7.5, 15.0, 0.75 * (0.4 * 20 - 0.1 * 10 + 2.0));
  expect(&f, 2, 10.0, 20.0, 0.4 * 20 - 0.1 * 10 + 2.0);
  size_t left = 3 * (2 + (size_t)(1 - f.right));
  assert_close(f.load.force[left + 1], 4.5, 1e-14);
  assert_close(f.load.moment[left + 2], 4.5 * 0.5, 1e-14);
  assert_int_equal(f.load.is_loose[0] + f.load.is_loose[1], 0);
  ambulo__ground_load_free(&f.load);
  close_fixture(&f);
}

/* half of 800 N at 0.5 m turns with 200 N m, whatever an unloaded row says about its point */
static void no_point_is_taken_from_the_air(void **state) {
  static const char *const in_the_air[] = {"0,0", "nan,nan", "NaN,0", "7,3"};
  fixture f = open_fixture();
  for (int i = 0; i < 4; i++) {
    char text[256];
    snprintf(text, sizeof text,
             "time,grf.right.x,grf.right.y,cop.right.x,cop.right.y,free_moment.right\n"
             "0,0,800,0.5,0,0\n1,0,0,%s,nan\n",
             in_the_air[i]);
    GOOD(text, NOTHING_LEFT, NULL);
    expect(&f, 0, 0.0, 800.0, 400.0);
    expect(&f, 1, 0.0, 400.0, 200.0);
    expect(&f, 2, 0.0, 0.0, 0.0);
    ambulo__ground_load_free(&f.load);
  }
  close_fixture(&f);
}

/* noise of a plate that has set its points to zero: they are those of the nearest loaded row */
static void light_rows_lend_a_point(void **state) {
  fixture f = open_fixture();
  GOOD("time,ground_force_r_vx,ground_force_r_vy,ground_force_r_px,ground_force_r_py\n"
       "0,0,500,1.2,0\n0.4,0,15,0,0\n0.5,0,10,nan,nan\n0.6,0,10,0,0\n1,0,600,1.4,0\n",
       NOTHING_LEFT, NO_TORQUE, NULL);
  expect(&f, 1, 0.0, 10.0, 10.0 * 1.2);
  expect(&f, 2, 0.0, 600.0, 600.0 * 1.4);
  ambulo__ground_load_free(&f.load);
  GOOD("time,ground_force_r_vx,ground_force_r_vy,ground_force_r_px,ground_force_r_py\n"
       "0,0,500,1.2,0\n0.5,0,10,0,0\n0.7,0,0,0,0\n0.9,0,600,1.4,0\n1,0,600,1.4,0\n",
       NOTHING_LEFT, NO_TORQUE, NULL);
  expect(&f, 1, 0.0, 10.0, 10.0 * 1.4);
  ambulo__ground_load_free(&f.load);
  BAD("time,ground_force_r_vx,ground_force_r_vy,ground_force_r_px,ground_force_r_py\n"
      "0,0,500,1.2,0\n0.5,0,312,nan,nan\n1,0,600,1.4,0\n",
      AMBULO_E_SCHEMA, NOTHING_LEFT, NO_TORQUE,
      "'ground_force_r' of foot 'right' has no point (nan) at t = 0.5 s, where it carries 312.0 N",
      NULL);
  GOOD("time,ground_force_r_vx,ground_force_r_vy,ground_force_r_px,ground_force_r_py\n"
       "0,0,500,1.2,0\n0.5,0,312,0,0\n0.6,0,312,0,0\n1,0,600,1.4,0\n",
       NOTHING_LEFT, NO_TORQUE, "has the point 0 0 0 at t = 0.5 s, where it carries 312.0 N", NULL);
  expect(&f, 1, 0.0, 312.0, 312.0 * 1.2);
  ambulo__ground_load_free(&f.load);
  BAD("time,grf.right.x,grf.right.y,cop.right.x,cop.right.y,free_moment.right\n"
      "0,0,500,1.2,0,nan\n1,0,600,1.4,0,0\n",
      AMBULO_E_SCHEMA, NOTHING_LEFT, "has no torque (nan) at t = 0 s", NULL);
  BAD("time,grf.right.x,grf.right.y,cop.right.x,cop.right.y,free_moment.right\n"
      "0,0,500,1.2,0,0\n1,nan,600,1.4,0,0\n",
      AMBULO_E_SCHEMA, NOTHING_LEFT, "'grf.right' of foot 'right' has no force (nan) at t = 1 s",
      NULL);
  close_fixture(&f);
}

static void what_is_missing_is_said(void **state) {
  fixture f = open_fixture();
  GOOD("time,ground_force_r_vy,ground_force_r_px\n0,500,1.2\n1,500,1.2\n", NOTHING_LEFT,
       "'ground_force_r' of foot 'right' lacks the x of its force; it is taken as 0",
       "has no y of its points; they are taken to be on the ground", NO_TORQUE, NULL);
  expect(&f, 0, 0.0, 500.0, 600.0);
  ambulo__ground_load_free(&f.load);
  f.options.ground_height = 0.25;
  GOOD("time,ground_force_r_vx,ground_force_r_vy,ground_force_r_px\n0,8,500,1.2\n1,8,500,1.2\n",
       NOTHING_LEFT, "taken to be on the ground", NO_TORQUE, NULL);
  expect(&f, 0, 8.0, 500.0, 600.0 - 0.25 * 8.0);
  ambulo__ground_load_free(&f.load);
  BAD("time,ground_force_r_px,ground_force_r_py\n0,1,2\n1,1,2\n", AMBULO_E_SCHEMA,
      "no column of forces on a foot", NULL);
  BAD("time,ground_force_r_px,ground_force_l_vx,ground_force_l_vy,ground_force_l_px\n0,1,2,3,4\n"
      "1,1,2,3,4\n",
      AMBULO_E_SCHEMA, "'ground_force_r' of foot 'right' has no columns of force", NULL);
  BAD("time,x\n0,1\n1,1\n", AMBULO_E_SCHEMA, "no column of forces on a foot", NULL);
  close_fixture(&f);
}

/* no points: the force waits for a place; moments about the origin need none */
static void forces_without_points(void **state) {
  fixture f = open_fixture();
  GOOD("time,ground_force_r_vx,ground_force_r_vy,ground_force_r_px,ground_force_r_py,"
       "ground_torque_r_y,ground_force_l_vx,ground_force_l_vy,ground_force_l_px,ground_force_l_py\n"
       "0,3,500,0,0,5,0,0,0,0\n1,3,500,0,0,5,0,0,0,0\n",
       NO_TORQUE, "the forces on foot 'right' have no points", NULL);
  size_t at = 3 * (2 + (size_t)f.right);
  assert_int_equal(f.load.is_loose[f.right], 1);
  assert_int_equal(f.load.is_loose[1 - f.right], 0);
  assert_close(f.load.loose[at + 1], 500.0, 0.0);
  assert_close(f.load.moment[at + 1], 5.0, 0.0);
  expect(&f, 1, 3.0, 500.0, 0.0);
  ambulo__ground_load_free(&f.load);
  GOOD("time,ground_force_r_vx,ground_force_r_vy,ground_force_r_px,ground_force_r_py,"
       "ground_torque_r_z\n0,3,500,0,0,600\n1,3,500,0,0,600\n",
       NOTHING_LEFT, NULL);
  assert_int_equal(f.load.is_loose[f.right], 0);
  expect(&f, 1, 3.0, 500.0, 600.0);
  ambulo__ground_load_free(&f.load);
  close_fixture(&f);
}

#define WHOLE                                                                                      \
  "time,grf.right.x,grf.right.y,cop.right.x,cop.right.y,free_moment.right,moment.right.x,"         \
  "moment.right.y,moment.right.z\n"

/* a force without a place has the moment that the file says; what contradicts its place is doubted;
 * rows without one have that of their place */
static void moments_of_the_file_are_whole(void **state) {
  fixture f = open_fixture();
  GOOD(WHOLE "0,2,-1e-5,nan,nan,0,0,0,0.25\n0.5,2,800,0.5,0,0,0,0,400\n1,2,0,nan,nan,0,0,0,7\n",
       NOTHING_LEFT, NULL);
  expect(&f, 0, 2.0, -1e-5, 0.25);
  expect(&f, 1, 2.0, 800.0, 400.0);
  expect(&f, 2, 2.0, 0.0, 7.0);
  assert_int_equal(f.load.is_loose[f.right], 0);
  ambulo__ground_load_free(&f.load);
  GOOD(WHOLE "0,0,800,0.5,0,0,0,0,400\n0.5,0,400,0.5,0,0,0,0,400\n1,0,400,0.5,0,0,nan,nan,nan\n",
       NOTHING_LEFT,
       "the moment of 'grf.right' is 200 N m from that of its force at its point at "
       "t = 0.5 s; the moment is taken",
       NULL);
  expect(&f, 1, 0.0, 400.0, 400.0);
  expect(&f, 2, 0.0, 400.0, 200.0);
  ambulo__ground_load_free(&f.load);
  close_fixture(&f);
}

/* plates in millimetres and milliseconds, two of them under one foot */
static void units_and_several_plates(void **state) {
  fixture f = open_fixture();
  f.options.force_length_unit = f.options.force_time_unit = 1e-3;
  f.options.force_columns = "right=1+2,left=none";
  GOOD("time,ground_force_1_vx,ground_force_1_vy,ground_force_1_px,ground_force_1_py,"
       "ground_torque_1_z,2_ground_force_vx,2_ground_force_vy,2_ground_force_px,"
       "2_ground_force_py,2_ground_torque_z\n"
       "0,1,500,1200,0,3000,0,100,2000,0,0\n1000,1,500,1200,0,3000,0,100,2000,0,0\n",
       NULL);
  expect(&f, 1, 1.0, 600.0, 500.0 * 1.2 + 3.0 + 100.0 * 2.0);
  ambulo__ground_load_free(&f.load);
  f.options.force_columns = "right=1,left=2,middle=3";
  BAD("time,ground_force_1_vx,ground_force_2_vx\n0,1,2\n1000,1,2\n", AMBULO_E_ARGUMENT,
      "'middle' is no foot", NULL);
  close_fixture(&f);
}

static void times_must_be_covered(void **state) {
  fixture f = open_fixture();
#define HEAD "time,grf.right.x,grf.right.y,cop.right.x,cop.right.y,free_moment.right\n"
  BAD(HEAD "0,0,5,1,0,0\n0.9,0,5,1,0,0\n", AMBULO_E_SCHEMA, NOTHING_LEFT,
      "forces from 0 to 0.9 s; expected them from 0 to 1 s", NULL);
  BAD(HEAD "0,0,5,1,0,0\n", AMBULO_E_SCHEMA, NOTHING_LEFT,
      "forces at one time, 0 s; expected at least 2 rows", NULL);
  BAD(HEAD "500,0,5,1,0,0\n1500,0,5,1,0,0\n", AMBULO_E_SCHEMA, NOTHING_LEFT,
      "forces from 500 to 1500 s", NULL);
  BAD(HEAD "400,0,5,1,0,0\n900,0,5,1,0,0\n1000,0,5,1,0,0\n", AMBULO_E_SCHEMA, NOTHING_LEFT,
      "forces from 400 to 1000 s", NULL);
  GOOD(HEAD "0,0,5,1,0,0\n500,0,5,1,0,0\n1000,0,5,1,0,0\n", NOTHING_LEFT,
       "warning: the rows of the forces are 500 s apart, those of the motion 0.5 s\n  hint: times "
       "in milliseconds: --grf-time ms",
       NULL);
  ambulo__ground_load_free(&f.load);
  f.options.force_time_unit = 0.001;
  GOOD(HEAD "0,0,5,1,0,0\n500,0,5,1,0,0\n1000,0,5,1,0,0\n", NOTHING_LEFT, NULL);
  ambulo__ground_load_free(&f.load);
  f.options.force_time_unit = 1.0;
  BAD(HEAD "-5,0,5,1,0,0\n0.2,0,5,1,0,0\n", AMBULO_E_SCHEMA, NOTHING_LEFT, "from -5 to 0.2 s",
      NULL);
  close_fixture(&f);
}

/* a filter leaves what is constant, and levels what is not: force and moment alike */
static void forces_are_filtered_as_moments(void **state) {
  fixture f = open_fixture();
  char text[8192] = HEAD;
  for (int k = 0; k <= 100; k++) {
    size_t used = strlen(text);
    snprintf(text + used, sizeof text - used, "%g,7,%d,%s,0,0\n", 0.01 * k, k % 2 ? 600 : 400,
             k % 2 ? "1" : "2");
  }
  f.options.force_cutoff = 6.0;
  GOOD(text, NOTHING_LEFT, NULL);
  size_t at = 3 * (2 + (size_t)f.right);
  assert_close(f.load.force[at], 7.0, 1e-10);
  assert_close(f.load.force[at + 1], 500.0, 1e-4);
  assert_close(f.load.moment[at + 2], 0.5 * (600.0 * 1.0 + 400.0 * 2.0), 1e-4);
  ambulo__ground_load_free(&f.load);
  f.options.force_cutoff = 60.0;
  BAD(text, AMBULO_E_SCHEMA, NOTHING_LEFT, "--grf-filter is 60 Hz; expected less than half the 100",
      NULL);
  close_fixture(&f);
}

static void every_allocation_may_fail(void **state) {
  fixture f = open_fixture();
  f.options.force_cutoff = 0.1;
  for (long k = 0; k < 200; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_status status =
        read_with(state, &f, HEAD "0,0,5,1,0,0\n0.5,0,6,1,0,0\n1,0,5,1,0,0\n", &hook);
    if (!status) ambulo__ground_load_free(&f.load);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
    assert_true(k < 199);
  }
  close_fixture(&f);
}

/* the error names the option where it would help, and only there */
static void milliseconds_are_recognized(void **state) {
  static const double later[ROWS] = {0.2, 0.7, 1.2};
  static const struct {
    const char *rows;
    int hint;
  } cases[] = {{"200,0,5,1,0,0\n1200,0,5,1,0,0\n", 1}, {"0.3,0,5,1,0,0\n1.2,0,5,1,0,0\n", 0}};
  fixture f = open_fixture();
  for (int i = 0; i < 2; i++) {
    char text[256], message[512];
    const char *path = scratch_path(state, "forces.csv");
    snprintf(text, sizeof text, HEAD "%s", cases[i].rows);
    scratch_write(path, text);
    f.doubts = (ambulo__doubts){ambulo_diagnostics_create(NULL), 0, 0, 0};
    ambulo__load_source source = {.model = f.model,
                                  .file = path,
                                  .options = &f.options,
                                  .times = later,
                                  .rows = ROWS,
                                  .doubts = &f.doubts};
    assert_int_equal(ambulo__ground_load_read(&source, NULL, &f.load), AMBULO_E_SCHEMA);
    ambulo_diagnostics_format(f.doubts.diagnostics, 1, message, sizeof message);
    assert_non_null(strstr(message, "expected them from 0.2 to 1.2 s"));
    assert_int_equal(strstr(message, "--grf-time ms") != NULL, cases[i].hint);
    ambulo_diagnostics_free(f.doubts.diagnostics);
  }
  close_fixture(&f);
}

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

int main(void) {
  const struct CMUnitTest tests[] = {
      SCRATCH_TEST(rows_are_joined_by_lines),    SCRATCH_TEST(no_point_is_taken_from_the_air),
      SCRATCH_TEST(light_rows_lend_a_point),     SCRATCH_TEST(what_is_missing_is_said),
      SCRATCH_TEST(forces_without_points),       SCRATCH_TEST(moments_of_the_file_are_whole),
      SCRATCH_TEST(units_and_several_plates),    SCRATCH_TEST(times_must_be_covered),
      SCRATCH_TEST(milliseconds_are_recognized), SCRATCH_TEST(forces_are_filtered_as_moments),
      SCRATCH_TEST(every_allocation_may_fail)};
  return cmocka_run_group_tests_name("inverse/ground_load", tests, NULL, NULL);
}
