/* Doubts are warnings; the strict make them errors. */
#include "people/inverse.h"
#include "support/arm.h"
#include "ambulo/tools/load.h"
#include "support/inverse_table.h"
#include "support/messages.h"
#include "support/motion_text.h"
#include "support/scratch.h"

static void strictness_decides(void **state) {
  (void)state;
  for (int strict = 0; strict < 2; strict++) {
    ambulo__doubts doubts = {ambulo_diagnostics_create(NULL), strict, 0, 0};
    assert_int_equal(ambulo__doubts_status(&doubts), AMBULO_OK);
    ambulo__doubt(&doubts, "m.csv", "--angles degrees", "the knee is at %g rad", 65.0);
    assert_int_equal(doubts.count, 1);
    assert_int_equal(ambulo__doubts_status(&doubts), strict ? AMBULO_E_SCHEMA : AMBULO_OK);
    assert_int_equal(ambulo_diagnostics_error_count(doubts.diagnostics), strict);
    assert_message(doubts.diagnostics, 0,
                   strict ? "m.csv: error[E_SCHEMA]: the knee is at 65 rad"
                          : "m.csv: warning: the knee is at 65 rad");
    assert_message(doubts.diagnostics, 0, "hint: --angles degrees");
    ambulo_diagnostics_free(doubts.diagnostics);
  }
}

static void headers_that_count_wrongly(void **state) {
  (void)state;
  static const char *const texts[] = {"t\nnColumns=3\nendheader\ntime\tq\n0\t1\n",
                                      "t\nnColumns=2\nendheader\ntime\tq\n0\t1\n",
                                      "t\nendheader\ntime\tq\n0\t1\n"};
  for (int i = 0; i < 3; i++) {
    ambulo__motion *motion = NULL;
    ambulo__doubts doubts = {ambulo_diagnostics_create(NULL), 0, 0, 0};
    assert_int_equal(motion_read_text(texts[i], strlen(texts[i]), "m.sto", AMBULO__MOTION_STO, NULL,
                                      NULL, &motion),
                     AMBULO_OK);
    ambulo__doubt_header(&doubts, "m.sto", motion);
    assert_int_equal(doubts.count, i == 0);
    if (i == 0)
      assert_message(doubts.diagnostics, 0, "m.sto: warning: 2 columns; the header says 3");
    ambulo_diagnostics_free(doubts.diagnostics);
    ambulo__motion_free(motion);
  }
}

static int test_doubt_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(strictness_decides),
                                     cmocka_unit_test(headers_that_count_wrongly)};
  return cmocka_run_group_tests_name("inverse/doubt", tests, NULL, NULL);
}

/* What hardly can be meant is doubted, with the option that mends it; what can be is not. */

static const double pi = 3.14159265358979323846;

/* the first warning contains `message` and `hint`, strictness makes an error of it, and `mended`
 * (NULL: none) leaves no warning; message NULL: no warning at all */
static void doubted(const ambulo_model *model, const char *path,
                    const ambulo_inverse_options *given, const ambulo_inverse_options *mended,
                    const char *message, const char *hint) {
  ambulo_inverse_options options = given ? *given : ambulo_inverse_options_default();
  for (int strict = 0; strict < 2; strict++) {
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    options.strict = strict;
    ambulo__motion_free(
        inverse_of(model, path, &options, list, strict && message ? AMBULO_E_SCHEMA : AMBULO_OK));
    size_t first = 0, count = ambulo_diagnostics_count(list);
    while (first < count && ambulo_diagnostics_get(list, first)->severity == AMBULO_NOTE) first++;
    if (!message && first < count) assert_message(list, first, "(no message)");
    if (message) {
      assert_message(list, first, message);
      assert_message(list, first, hint);
      assert_message(list, first, strict ? "error[E_SCHEMA]" : "warning");
    }
    ambulo_diagnostics_free(list);
  }
  if (mended) doubted(model, path, mended, NULL, NULL, NULL);
}

/* a walk's hips and knees, and the way of the pelvis */
static const char *write_walk(void **state, double angle, double length, double time) {
  const char *path = scratch_path(state, "walk.csv");
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fprintf(file, "time,pelvis_tx,pelvis_ty,hip_flexion_r,knee_angle_r,pelvis_tilt,lumbar,"
                "ankle_angle_r,hip_flexion_l,knee_angle_l,ankle_angle_l\n");
  for (int k = 0; k <= 100; k++) {
    double t = 0.01 * k;
    fprintf(file, "%.10g,%.10g,%.10g,%.10g,%.10g,0,0,0,0,0,0\n", time * t, length * 1.3 * t,
            length * (0.95 + 0.02 * sin(4.0 * pi * t)), angle * 0.4 * sin(2.0 * pi * t),
            -angle * 0.5 * (1.0 + sin(2.0 * pi * t)));
  }
  fclose(file);
  return path;
}

static ambulo_model *walker(void) {
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/opensim_2d_gait10.yaml", NULL, NULL, NULL, &model), 0);
  return model;
}

static void units_are_doubted(void **state) {
  ambulo_model *model = walker();
  ambulo_inverse_options mended = ambulo_inverse_options_default();
  doubted(model, write_walk(state, 1.0, 1.0, 1.0), NULL, NULL, NULL, NULL);
  mended.angles = AMBULO_ANGLES_DEGREES;
  doubted(model, write_walk(state, 180.0 / pi, 1.0, 1.0), NULL, &mended,
          "rad at t = ", "--angles degrees");
  mended = ambulo_inverse_options_default();
  mended.length_unit = 0.001;
  doubted(model, write_walk(state, 1.0, 1000.0, 1.0), NULL, &mended, " m", "--lengths mm");
  mended = ambulo_inverse_options_default();
  mended.time_unit = 0.001;
  doubted(model, write_walk(state, 1.0, 1.0, 1000.0), NULL, &mended, "the rows are 10 s apart",
          "--time ms");
  ambulo_model_free(model);
}

/* nobody stands that high, even without moving */
static void lengths_at_rest_are_doubted(void **state) {
  ambulo_model *model = walker();
  ambulo_inverse_options mended = ambulo_inverse_options_default();
  const char *path = scratch_path(state, "stand.csv");
  scratch_write(path, "time,pelvis_tx,pelvis_ty,hip_flexion_r,knee_angle_r,pelvis_tilt,lumbar,"
                      "ankle_angle_r,hip_flexion_l,knee_angle_l,ankle_angle_l\n"
                      "0,0,950,0,0,0,0,0,0,0,0\n0.1,0,950,0,0,0,0,0,0,0,0\n"
                      "0.2,0,950,0,0,0,0,0,0,0,0\n0.3,0,950,0,0,0,0,0,0,0,0\n");
  mended.length_unit = 0.001;
  doubted(model, path, NULL, &mended, "'pelvis_ty' is at 950 m at t = 0 s; its range is -3 to 3 m",
          "--lengths mm");
  ambulo_model_free(model);
}

/* joints without range: ten turns, or a speed that no joint has */
static void speeds_are_doubted(void **state) {
  ambulo_model *model = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_model_load("models/pendulum.yaml", NULL, NULL, list, &model), 0);
  ambulo_diagnostics_free(list);
  const char *path = scratch_path(state, "swing.csv");
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fprintf(file, "time,swing\n");
  for (int k = 0; k <= 100; k++) fprintf(file, "%g,%.10g\n", 0.01 * k, 5.0 * sin(60.0 * 0.01 * k));
  fclose(file);
  ambulo_inverse_options mended = ambulo_inverse_options_default();
  mended.angles = AMBULO_ANGLES_DEGREES;
  doubted(model, path, NULL, &mended, "'swing' moves at 29", "--angles degrees");
  ambulo_model_free(model);
}

static void rates_that_contradict_are_doubted(void **state) {
  ambulo_model *model = arm_create();
  const char *path = scratch_path(state, "arm.csv");
  ambulo_inverse_options mended = ambulo_inverse_options_default();
  for (int own = 0; own < 2; own++) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    if (own) fprintf(file, "# ambulo motion: mass 3.5 kg, gravity 0 -9.81 0 m/s^2; SI\n");
    fprintf(file, "time,shoulder,elbow,qd.shoulder,qd.elbow,qdd.shoulder,qdd.elbow\n");
    for (int k = 0; k <= 50; k++) {
      double t = 0.02 * k, s = sin(6.0 * t), c = 6.0 * cos(6.0 * t);
      /* rates in degrees a second beside radians */
      fprintf(file, "%g,%.10g,%.10g,%.10g,%.10g,0,0\n", t, 0.3 * s, 0.1 * s, 0.3 * c,
              own ? 5.7 * c : 0.1 * c * 180.0 / pi);
    }
    fclose(file);
    mended.recompute_rates = 1;
    if (own) {
      doubted(model, path, NULL, NULL, NULL, NULL);
    } else {
      doubted(model, path, NULL, &mended,
              "the rate of 'elbow' differs from the slope of its values", "--derivatives spline");
    }
  }
  ambulo_model_free(model);
}

/* accelerations alone that are wrong: none, in degrees, of the other sign */
static void accelerations_that_contradict_are_doubted(void **state) {
  static const double factors[] = {1.0, 0.0, 57.3, -1.0};
  ambulo_model *model = arm_create();
  const char *path = scratch_path(state, "arm.csv");
  ambulo_inverse_options mended = ambulo_inverse_options_default();
  mended.recompute_rates = 1;
  for (int i = 0; i < 4; i++) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "time,shoulder,elbow,qd.shoulder,qd.elbow,qdd.shoulder,qdd.elbow\n");
    for (int k = 0; k <= 50; k++) {
      double t = 0.02 * k, s = sin(6.0 * t), c = 6.0 * cos(6.0 * t), a = -36.0 * s;
      fprintf(file, "%g,%.10g,%.10g,%.10g,%.10g,%.10g,%.10g\n", t, 0.3 * s, 0.2 * s, 0.3 * c,
              0.2 * c, 0.3 * a, 0.2 * a * factors[i]);
    }
    fclose(file);
    doubted(model, path, NULL, i ? &mended : NULL,
            i ? "the acceleration of 'elbow' differs from the slope of its rates" : NULL,
            "--derivatives spline");
  }
  ambulo_model_free(model);
}

/* the motion of a body with more joints */
static void columns_of_another_model_are_doubted(void **state) {
  ambulo_model *model = arm_create();
  const char *path = scratch_path(state, "arm.csv");
  static const char *const names[] = {"q.wrist", "/jointset/hand/wrist/value", "wrist", "tau.wrist",
                                      "/forceset/wrist/value"};
  for (int i = 0; i < 5; i++) {
    for (int moves = 0; moves < 2; moves++) {
      FILE *file = fopen(path, "w");
      assert_non_null(file);
      fprintf(file, "time,shoulder,elbow,%s\n", names[i]);
      for (int k = 0; k <= 10; k++) fprintf(file, "%g,0.1,0.2,%d\n", 0.1 * k, moves);
      fclose(file);
      doubted(model, path, NULL, NULL, moves && i < 2 ? "is no coordinate of model" : NULL,
              "1 such column is left out");
    }
  }
  ambulo_model_free(model);
}

static void another_body_is_doubted(void **state) {
  ambulo_model *model = arm_create(), *heavy = NULL;
  ambulo_conditions conditions = ambulo_conditions_default();
  const char *path = scratch_path(state, "arm.csv");
  static const char rows[] = "time,shoulder,elbow\n0,0,0\n0.1,0,0\n0.2,0,0\n0.3,0,0\n";
  char text[256];
  snprintf(text, sizeof text, "# ambulo motion: mass 3.5 kg, gravity 0 -9.81 0 m/s^2; SI\n%s",
           rows);
  scratch_write(path, text);
  doubted(model, path, NULL, NULL, NULL, NULL);
  conditions.load_link = 1;
  conditions.load_mass = 0.5;
  assert_int_equal(ambulo_model_adapt(model, &conditions, NULL, NULL, &heavy), AMBULO_OK);
  doubted(heavy, path, NULL, NULL, "it is the motion of a body of 3.5 kg; 'arm' has 4 kg",
          "--mass");
  ambulo_model_free(heavy);
  snprintf(text, sizeof text, "# ambulo motion: mass 3.5 kg, gravity 0.8 -9.77 0 m/s^2; SI\n%s",
           rows);
  scratch_write(path, text);
  doubted(model, path, NULL, NULL, "under gravity 0.8 -9.77 0 m/s^2; 'arm' has 0 -9.81 0",
          "--slope");
  ambulo_model_free(model);
}

/* ------------------------------------------------------------------- forces */

typedef struct standing {
  ambulo_model *model;
  double weight;
  double feet[2]; /* forward, of the middle of each foot */
  char motion[SCRATCH_PATH + 256], forces[SCRATCH_PATH + 256];
} standing;

/* the planar walker stands, one hip forward; the load is shared so that moments balance */
static standing stand(void **state) {
  standing s = {.model = walker()};
  s.weight = 9.81 * ambulo_model_mass(s.model);
  snprintf(s.motion, sizeof s.motion, "%s", scratch_path(state, "stand.csv"));
  snprintf(s.forces, sizeof s.forces, "%s", scratch_path(state, "forces.csv"));
  FILE *file = fopen(s.motion, "w");
  assert_non_null(file);
  fprintf(file, "time,pelvis_tx,pelvis_ty,pelvis_tilt,lumbar,hip_flexion_r,knee_angle_r,"
                "ankle_angle_r,hip_flexion_l,knee_angle_l,ankle_angle_l\n");
  for (int k = 0; k < 10; k++) fprintf(file, "%g,0.3,0.9,0,0,0.6,0,0,-0.6,0,0\n", 0.01 * k);
  fclose(file);
  return s;
}

/* forces of the right and the left foot as shares of the weight, at x in m */
static void write_forces(const standing *s, double right, double right_x, double left,
                         double left_x, double length, double time) {
  FILE *file = fopen(s->forces, "w");
  assert_non_null(file);
  fprintf(file, "time,ground_force_r_vx,ground_force_r_vy,ground_force_r_px,ground_force_r_py,"
                "ground_torque_r_z,ground_force_l_vx,ground_force_l_vy,ground_force_l_px,"
                "ground_force_l_py,ground_torque_l_z\n");
  for (int k = 0; k < 2; k++)
    fprintf(file, "%g,0,%.12g,%.12g,0,0,0,%.12g,%.12g,0,0\n", time * k, right * s->weight,
            length * right_x, left * s->weight, length * left_x);
  fclose(file);
}

/* where the weight acts, from the motion alone */
static double center(const standing *s) {
  ambulo__motion *m = inverse_of(s->model, s->motion, NULL, NULL, AMBULO_OK);
  double x = table_cell(m, 0, "zmp.x");
  ambulo__motion_free(m);
  return x;
}

static void places_and_residuals_are_doubted(void **state) {
  standing s = stand(state);
  ambulo_inverse_options options = ambulo_inverse_options_default(), mended;
  options.forces = s.forces;
  double x = center(&s), right = x + 0.45, left = x - 0.45;
  write_forces(&s, 0.5, right, 0.5, left, 1.0, 1.0);
  doubted(s.model, s.motion, &options, NULL, NULL, NULL);
  write_forces(&s, 0.5, left, 0.5, right, 1.0, 1.0);
  mended = options;
  mended.force_columns = "right=ground_force_l,left=ground_force_r";
  doubted(s.model, s.motion, &options, &mended, "m from foot 'left' (mean)", "--force-columns");
  write_forces(&s, 0.5, right, 0.5, left, 1000.0, 1.0);
  mended = options;
  mended.force_length_unit = 0.001;
  doubted(s.model, s.motion, &options, &mended, "the forces on foot 'right' act ",
          "--grf-lengths mm");
  write_forces(&s, 0.5, right + 3.0, 0.5, left + 3.0, 1.0, 1.0);
  doubted(s.model, s.motion, &options, NULL, "the forces on foot 'right' act 2.",
          "same axes and origin");
  write_forces(&s, 0.6, right, 0.6, left, 1.0, 1.0);
  doubted(s.model, s.motion, &options, NULL, "the forces leave over 0.200 body weights and 0.0",
          "--mass");
  write_forces(&s, 0.75, right, 0.25, left, 1.0, 1.0);
  doubted(s.model, s.motion, &options, NULL,
          "the forces leave over 0.000 body weights and 0.225 body weights m", "--grf-time");
  write_forces(&s, -0.5, right, 0.0, left, 1.0, 1.0); /* no body is that light */
  doubted(s.model, s.motion, &options, NULL, "at the root", "signs and units (N)");
  write_forces(&s, 0.0005, right, 0.0005, left, 1.0, 1.0);
  doubted(s.model, s.motion, &options, NULL, "at the root", "signs and units (N)");
  write_forces(&s, 0.545, right, 0.545, left, 1.0, 1.0);
  doubted(s.model, s.motion, &options, NULL, NULL, NULL);
  write_forces(&s, 0.5, right, 0.5, left, 1.0, 1000.0);
  mended = options;
  mended.force_time_unit = 0.001;
  doubted(s.model, s.motion, &mended, NULL, NULL, NULL);
  ambulo_model_free(s.model);
}

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

static int test_plausibility_tests(void) {
  const struct CMUnitTest tests[] = {SCRATCH_TEST(units_are_doubted),
                                     SCRATCH_TEST(lengths_at_rest_are_doubted),
                                     SCRATCH_TEST(speeds_are_doubted),
                                     SCRATCH_TEST(rates_that_contradict_are_doubted),
                                     SCRATCH_TEST(accelerations_that_contradict_are_doubted),
                                     SCRATCH_TEST(columns_of_another_model_are_doubted),
                                     SCRATCH_TEST(another_body_is_doubted),
                                     SCRATCH_TEST(places_and_residuals_are_doubted)};
  return cmocka_run_group_tests_name("inverse/plausibility", tests, NULL, NULL);
}

int main(void) {
  return test_doubt_tests() + test_plausibility_tests();
}
