/* `written_for`: bodies of one shape, at one speed number, have one problem in units of the body.
 */
#include "definitions/problem_text.h"
#include "ambulo/tools/load.h"
#include "solver/sensitivity.h"
#include "support/scratch.h"

#define NUMBERS                                                                                    \
  "ambulo: 1\nkind: problem\nmodel: lower_body_21.yaml\nangles: degrees\n"                         \
  "time: {intervals: 24, grid: events}\n"                                                          \
  "trajectory: {degree: 4, intervals: 8, knots: events}\nends: {kind: mirrored, order: 2}\n"       \
  "objective:\n"                                                                                   \
  "  - {term: torque_power, weight: 1.1, power: 2.6, scale: {default: 0, hip_flexion_r: 0.01, "    \
  "hip_flexion_l: 0.01},\n"                                                                        \
  "     offset: {hip_flexion_r: 3, hip_flexion_l: 3}, passive: {hip_flexion_r: [-2, -5, 1, 4], "   \
  "hip_flexion_l: [-2, -5, 1, 4]}}\n"                                                              \
  "  - {term: torque_power, name: curves, scale: {default: 0, knee_angle_r: 1, knee_angle_l: "     \
  "1},\n"                                                                                          \
  "     strength: {knee_angle_r: [100, 1, 0.5, 200, 0.9, 0.8], knee_angle_l: [100, 1, 0.5, 200, "  \
  "0.9, 0.8]}}\n"                                                                                  \
  "  - {term: torque_power, name: limits, strength: limits, scale: {default: 0, ankle_angle_r: "   \
  "0.5, ankle_angle_l: 0.5}}\n"                                                                    \
  "  - {term: torque_squared, scale: {default: 0.01, pelvis_ty: 0.002}, offset: {pelvis_ty: "      \
  "body_weight, knee_angle_r: 2, knee_angle_l: 2}}\n"                                              \
  "  - {term: torque_absolute, scale: 0.01, smoothing: 0.1}\n"                                     \
  "  - {term: torque_rate, scale: 0.001}\n"                                                        \
  "  - {term: mechanical_power, weight: 0.02, smoothing: 0.05}\n"                                  \
  "  - {term: mechanical_power, name: muscles, tendon: {pelvis_ty: 5e3, ankle_angle_r: 400, "      \
  "ankle_angle_l: 400}}\n"                                                                         \
  "  - {term: acceleration, weight: 1e-3, scale: {pelvis_tx: 5, default: 1}}\n"                    \
  "  - {term: posture, scale: {ankle_angle_r: 1, ankle_angle_l: 1, pelvis_ty: 3}, angles: "        \
  "{ankle_angle_r: 5, ankle_angle_l: 5, pelvis_ty: 0.05}}\n"                                       \
  "  - {term: upright, points: [lumbar, head_top]}\n"                                              \
  "  - {term: clearance, height: 0.03}\n"

#define CONSTRAINTS(more)                                                                          \
  "constraints: {contact_tolerance: 0.001, orientation_tolerance: 0.01, strike_pitch: [12, 23],\n" \
  "  joint_limits: nodes, speed_limits: false, torque_limits: true, " more "\n"                    \
  "  clearance: {height: 0.03, ceiling: 0.4, outward: 0.05, inward: 0.02, feet: 0.01}}\n"

#define OF_REACTION "  - {term: ground_force, weight: 0.1}\n  - {term: force_rate, weight: 0.1}\n"
#define PRESSURE                                                                                   \
  "free_moment: 0.03, pressure: {heel: [-0.03, 0.04], roll: 0.03, flat: [-0.01, 0.03], toe: "      \
  "[-0.03, 0.06], width: 0.04}}\n" CONSTRAINTS("")
#define SHARED                                                                                     \
  OF_REACTION                                                                                      \
  "ground_reaction: {kind: shared, moment_arm: 0.06, slant: 0.3, heel_pad: 0.008, " PRESSURE
/* of a robot: torques carry the pelvis, rows keep the zero-moment point */
#define ZERO_MOMENT                                                                                \
  "  - {term: torque_absolute, name: pelvis, scale: {default: 0, pelvis_ty: 0.1}}\n" CONSTRAINTS(  \
      "zmp: box, zmp_margin: 0.01,")

enum { MOST_TERMS = 14, MOST_ROWS = 20000 };

typedef struct body {
  double mass, stature, longer, heavier;
} body;

static ambulo_problem *problem_of_body(const body *b, const char *reaction, int written_for) {
  char text[4096];
  (void)snprintf(text, sizeof text,
                 NUMBERS "%s%ssubject: {mass: %.17g, stature: %.17g, sex: female}\n"
                         "gait: {steps: 1, first_foot: left, speed: %.17g, step_width: 0.12}\n",
                 reaction, written_for ? "written_for: {mass: 75, stature: 1.75}\n" : "", b->mass,
                 b->stature, 1.3 * sqrt(b->longer));
  return problem_of(text);
}

static double factor_of(const char *unit, const body *b) {
  static const char *const units[] = {"rad", "m", "N m", "N", "", "body weights"};
  const double factors[] = {1.0, b->longer, b->heavier * b->longer, b->heavier, 1.0, 1.0};
  for (int i = 0; i < 6; i++)
    if (strcmp(unit, units[i]) == 0) return factors[i];
  fail_msg("rows of unit '%s'", unit);
  return 1.0;
}

/* a motion near standing, lengths in statures */
static void fill(const ambulo_problem *problem, double longer, double *x) {
  const ambulo_model *model = ambulo_problem_model(problem);
  int n = ambulo_model_coordinate_count(model);
  unsigned state = 5;
  for (int i = 0; i < ambulo_problem_variable_count(problem); i++) {
    state = state * 1664525u + 1013904223u;
    double noise = (double)(state >> 8) / 8388608.0 - 1.0;
    int slides = ambulo_model_coordinate(model, i % n)->type == AMBULO_PRISMATIC;
    x[i] = noise * (slides ? 0.03 * longer : 0.1);
  }
}

static void compare(const body *b, const char *reaction) {
  const body reference = {75.0, 1.75, 1.0, 1.0};
  ambulo_problem *p[2] = {problem_of_body(&reference, reaction, 1),
                          problem_of_body(b, reaction, 1)};
  const body *of[2] = {&reference, b};
  static double terms[2][MOST_TERMS], rows[2][MOST_ROWS];
  int count = ambulo_problem_row_count(p[0]), term_count = ambulo_problem_term_count(p[0]);
  assert_true(term_count >= 13 && term_count <= MOST_TERMS);
  assert_int_equal(ambulo_problem_row_count(p[1]), count);
  assert_true(count < MOST_ROWS);
  for (int i = 0; i < 2; i++) {
    ambulo_workspace *workspace = NULL;
    double *x = calloc((size_t)ambulo_problem_variable_count(p[i]), sizeof *x);
    fill(p[i], of[i]->longer, x);
    assert_int_equal(ambulo_workspace_create(p[i], NULL, &workspace), AMBULO_OK);
    assert_int_equal(ambulo_problem_evaluate(p[i], workspace, x, NULL, terms[i], rows[i]),
                     AMBULO_OK);
    ambulo_workspace_free(workspace);
    free(x);
  }
  for (int t = 0; t < term_count; t++) {
    assert_true(terms[0][t] > 0.0);
    if (fabs(terms[1][t] / (terms[0][t] * sqrt(b->longer)) - 1.0) > 1e-9)
      fail_msg("term %d: %.15g, of the other body %.15g", t, terms[0][t],
               terms[1][t] / sqrt(b->longer));
  }
  for (int r = 0; r < count; r++) {
    ambulo_row row;
    assert_int_equal(ambulo_problem_row(p[0], r, &row), AMBULO_OK);
    double size = factor_of(row.unit, b);
    if (fabs(rows[1][r] / size - rows[0][r]) > 1e-9 * (1.0 + fabs(rows[0][r])))
      fail_msg("%s of %s (%s) at %g s: %.15g, of the other body %.15g", row.family, row.subject,
               row.detail, row.time, rows[0][r], rows[1][r] / size);
  }
  for (int i = 0; i < 2; i++) ambulo_problem_free(p[i]);
}

static void every_number_is_in_units_of_the_body(void **state) {
  (void)state;
  const body bodies[] = {{75.0, 1.75, 1.0, 1.0},
                         {45.0, 1.75, 1.0, 0.6},
                         {75.0, 1.4, 0.8, 1.0},
                         {120.0, 2.1, 1.2, 1.6}};
  for (int i = 0; i < 4; i++) {
    compare(&bodies[i], SHARED);
    compare(&bodies[i], ZERO_MOMENT);
  }
}

/* a test that cannot fail is none: without the key the bodies differ */
static void without_it_numbers_are_si(void **state) {
  (void)state;
  const body large = {120.0, 2.1, 1.2, 1.6};
  ambulo_problem *p = problem_of_body(&large, SHARED, 0), *q = problem_of_body(&large, SHARED, 1);
  assert_close(p->definition.contact_tolerance, 0.001, 0.0);
  assert_close(q->definition.contact_tolerance, 0.0012, 1e-15);
  assert_close(p->keys.walk.step_width, 0.12, 0.0);
  assert_close(q->keys.walk.step_width, 0.144, 1e-15);
  assert_close(p->definition.terms[0].scale[9], 0.01, 0.0);
  ambulo_problem_free(p);
  ambulo_problem_free(q);
}

/* what a length is by default is the body's own */
static void a_width_that_is_not_given(void **state) {
  (void)state;
#define PLAIN                                                                                      \
  "ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\nobjective: none\ntime: {intervals: 4}\n"   \
  "ends: {kind: mirrored}\ngait: {steps: 1, first_foot: left, step_length: 0.7, step_time: 0.5}\n"
  ambulo_problem *p = problem_of(PLAIN "subject: {stature: 2.1}\n");
  ambulo_problem *q =
      problem_of(PLAIN "subject: {stature: 2.1}\nwritten_for: {mass: 75, stature: 1.75}\n");
  assert_true(p->keys.walk.step_width > 0.1);
  assert_close(q->keys.walk.step_width, p->keys.walk.step_width, 1e-15);
  ambulo_problem_free(p);
  ambulo_problem_free(q);
}

/* the way that is tracked is the task; how far from it counts as much goes with the body */
static void scales_of_tracked_translations(void **state) {
  char text[1024];
  const char *file = scratch_path(state, "way.csv");
  scratch_write(file, "# inDegrees=no\ntime,pelvis_ty,hip_flexion_r\n0,0,0\n0.5,0.1,0.2\n1,0,0\n");
  (void)snprintf(text, sizeof text,
                 "ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\n"
                 "time: {intervals: 4, duration: 1}\nsubject: {mass: 60, stature: 2.1}\n"
                 "written_for: {mass: 75, stature: 1.75}\nobjective: [{term: tracking, "
                 "reference: \"%s\", scale: {pelvis_ty: 3, hip_flexion_r: 2}}]\n",
                 file);
  ambulo_problem *p = problem_of(text);
  int up = ambulo_model_find_coordinate(p->model, "pelvis_ty");
  int hip = ambulo_model_find_coordinate(p->model, "hip_flexion_r");
  const ambulo_term *term = &p->definition.terms[0];
  assert_close(term->scale[up], 3.0 / 1.2, 1e-14);
  assert_close(term->scale[hip], 2.0, 0.0);
  assert_close(term->reference[2 * ambulo_model_coordinate_count(p->model) + up], 0.1, 1e-14);
  ambulo_problem_free(p);
}

/* SI of a number by its unit in the file is the file's number, whatever the body */
static void expect_units(const char *numbers) {
  ambulo_problem *problem[2];
  ambulo__parameters known[2];
  int compared = 0;
  for (int i = 0; i < 2; i++) {
    char text[4096];
    (void)snprintf(text, sizeof text, "%ssubject: {mass: %d, stature: %g, sex: female}\n", numbers,
                   i ? 120 : 75, i ? 2.1 : 1.75);
    problem[i] = problem_of(text);
    assert_int_equal(ambulo__parameters_init(problem[i], NULL, &known[i]), AMBULO_OK);
  }
  assert_int_equal(known[0].count, known[1].count);
  for (int k = 0; k < known[0].count; k++) {
    const ambulo__parameter *p = &known[0].list[k], *q = &known[1].list[k];
    double unit = ambulo__parameter_unit(problem[1], q);
    assert_string_equal(p->name, q->name);
    assert_true(unit > 0.0);
    if (strncmp(p->name, "subject.", 8) == 0) continue;
    double own = p->value / ambulo__parameter_unit(problem[0], p);
    if (fabs(q->value / unit - own) > 1e-12 * fabs(own))
      fail_msg("%s: %.15g, of the other body %.15g", p->name, own, q->value / unit);
    compared++;
  }
  assert_true(compared > 7);

  for (int i = 0; i < 2; i++) {
    ambulo__parameters_clear(&known[i]);
    ambulo_problem_free(problem[i]);
  }
}

static void bounds_of_numbers_are_the_files(void **state) {
  (void)state;
#define STEP                                                                                       \
  "written_for: {mass: 75, stature: 1.75}\n"                                                       \
  "gait: {steps: 1, first_foot: left, step_length: 0.7, step_time: 0.5, step_width: 0.12}\n"
  expect_units(NUMBERS SHARED STEP);
  expect_units(NUMBERS "ground_reaction: {kind: shared, moment_arm: 0.06, slant: 0.3, "
                       "loading_rate: 9}\n" CONSTRAINTS("") STEP);
  expect_units("ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\nangles: degrees\n"
               "time: {intervals: 20}\nobjective: none\nends: {kind: mirrored}\n"
               "constraints: {zmp: box, zmp_margin: 0.01, ground_height: 0.02, "
               "contact_tolerance: 0.001}\n" STEP);
}

static void faults_are_named(void **state) {
  (void)state;
#define SMALL "ambulo: 1\nkind: problem\nobjective: none\ntime: {intervals: 4, duration: 1}\n"
  expect_refusal(SMALL "model: lower_body_18.yaml\nwritten_for: {mass: 75}\n", AMBULO_E_SCHEMA,
                 "stature");
  expect_refusal(SMALL
                 "model: lower_body_18.yaml\nwritten_for: {mass: 75, stature: 1.75, sex: male}\n",
                 AMBULO_E_SCHEMA, "sex");
  expect_refusal(SMALL "model: lower_body_18.yaml\nwritten_for: {mass: 75, stature: 17}\n",
                 AMBULO_E_SCHEMA, "17");
  expect_refusal(SMALL "model: yardstick_body.yaml\nwritten_for: {mass: 75, stature: 1.75}\n",
                 AMBULO_E_PROBLEM, "a model that has its own size");
  static const char own[] =
      SMALL "model: lower_body_18.yaml\nwritten_for: {mass: 75, stature: 1.75}\n";
  const char *overrides[] = {"model.units.mass=kilograms"};
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem *p = NULL;
  assert_int_equal(
      ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                      .text = own,
                                                      .length = strlen(own),
                                                      .name = "p.yaml",
                                                      .directory = "models",
                                                      .overrides = overrides,
                                                      .override_count = 1},
                               NULL, list, &p),
      AMBULO_E_PROBLEM);
  assert_message(list, 0, "a model that has its own size");
  ambulo_diagnostics_free(list);
  expect_refusal(SMALL "model: lower_body_18.yaml\nwritten_for: 75\n", AMBULO_E_SCHEMA,
                 "'written_for' is not a mapping");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_number_is_in_units_of_the_body),
      cmocka_unit_test(without_it_numbers_are_si),
      cmocka_unit_test(a_width_that_is_not_given),
      cmocka_unit_test(bounds_of_numbers_are_the_files),
      cmocka_unit_test_setup_teardown(scales_of_tracked_translations, scratch_open, scratch_close),
      cmocka_unit_test(faults_are_named),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
