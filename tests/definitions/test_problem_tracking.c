/* Terms that follow points and forces on feet: columns, gaps, units, refusals. */
#include "definitions/problem_text.h"
#include "problem/nlp.h"
#include "support/scratch.h"

#include <math.h>

#define LEGS "ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\n"
#define SHARED                                                                                     \
  "ground_reaction: {kind: shared}\ngait: {steps: 1, first_foot: left, step_length: 0.6}\n"

/* the text of a problem with one term, whose reference is `table` in a file of that name */
static const char *text_with(void **state, const char *file, const char *table, const char *term) {
  static char text[4096];
  const char *path = scratch_path(state, file);
  scratch_write(path, table);
  int marks = strstr(term, "point_tracking") != NULL;
  (void)snprintf(text, sizeof text,
                 LEGS "%stime: {duration: 1, intervals: 8}\nobjective: [{%s, reference: %s}]\n",
                 marks ? "" : SHARED, term, path);
  return text;
}

static const ambulo_term *term_of(const ambulo_problem *p) {
  return &p->definition.terms[0];
}

static void check_mark(const ambulo_problem *p, int mark, const char *point, double scale,
                       double at_start) {
  const ambulo_term *term = term_of(p);
  const ambulo_point *own = ambulo_model_point(p->model, term->marks[mark]);
  assert_string_equal(own->name, point);
  assert_close(term->mark_scale[mark], scale, 0.0);
  assert_close(term->mark_reference[3 * mark], at_start, 1e-15);
}

static void points_have_columns_of_their_own_name(void **state) {
  ambulo_problem *p =
      problem_of(text_with(state, "p.csv",
                           "time,head_top.x,head_top.y,head_top.z,heel_r_x,heel_r_y,"
                           "heel_r_z\n0,1,2,3,4,5,6\n1,2,2,3,4,5,6\n",
                           "term: point_tracking, scale: {default: 3, head_top: 7}"));
  const ambulo_term *term = term_of(p);
  assert_int_equal(term->mark_count, 2);
  int first = strcmp(ambulo_model_point(p->model, term->marks[0])->name, "head_top") == 0 ? 0 : 1;
  check_mark(p, first, "head_top", 7.0, 1.0);
  check_mark(p, 1 - first, "heel_r", 3.0, 4.0);
  assert_close(term->mark_reference[4 * 6 + 3 * first], 1.5, 1e-15); /* in between */
  ambulo_problem_free(p);
}

static void markers_of_a_trc_are_named(void **state) {
  static const char trc[] =
      "PathFileType\t4\t(X/Y/Z)\tm.trc\n"
      "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n100\t100\t3\t2\tmm\n"
      "Frame#\tTime\tRHEE\t\t\tTOP\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n"
      "1\t0.5\t100\t200\t300\t0\t1700\t0\n2\t1.0\t\t\t\t200\t1700\t0\n3\t1.5\t300\t200\t300\t400\t"
      "1700\t0\n";
  ambulo_problem *p = problem_of(text_with(
      state, "m.trc", trc, "term: point_tracking, points: {heel_r: RHEE, head_top: TOP}"));
  const ambulo_term *term = term_of(p);
  check_mark(p, 0, "heel_r", 1.0, 0.1);
  check_mark(p, 1, "head_top", 1.0, 0.0);
  for (int k = 0; k <= 8; k++) { /* the marker was not seen at half time */
    assert_int_equal(isnan(term->mark_reference[6 * k]) != 0, k > 0 && k < 8);
    assert_close(term->mark_reference[6 * k + 4], 1.7, 1e-15);
  }
  assert_close(term->mark_reference[6 * 4 + 3], 0.2, 1e-15);
  ambulo_problem_free(p);
}

static void feet_have_columns_of_forces(void **state) {
  static const char table[] = "time,grf.right.x,grf.right.y,grf.right.z,1_vx,1_vy,1_vz\n"
                              "0,1,700,2,3,10,4\n1,1,0,2,3,710,4\n";
  ambulo_problem *p = problem_of(text_with(
      state, "f.csv", table, "term: force_tracking, feet: {left: 1_v}, scale: {left: 2}"));
  const ambulo_term *term = term_of(p);
  int right = 0, left = 1;
  if (strcmp(ambulo_model_foot(p->model, 0)->name, "right") != 0) right = 1, left = 0;
  assert_close(term->foot_reference[6 * 4 + 3 * right + 1], 350.0, 1e-12);
  assert_close(term->foot_reference[6 * 4 + 3 * left + 1], 360.0, 1e-12);
  assert_close(term->foot_scale[right], 1.0, 0.0);
  assert_close(term->foot_scale[left], 2.0, 0.0);
  ambulo_problem_free(p);
}

/* of a foot without columns nothing is asked */
static void a_foot_may_be_left_out(void **state) {
  ambulo_problem *p = problem_of(text_with(state, "c.csv",
                                           "time,cop.right.x,cop.right.y,cop.right.z\n"
                                           "0,0.1,0,0.2\n0.5,nan,nan,nan\n1,0.3,0,0.2\n",
                                           "term: pressure_tracking"));
  const ambulo_term *term = term_of(p);
  int right = strcmp(ambulo_model_foot(p->model, 0)->name, "right") == 0 ? 0 : 1;
  assert_close(term->foot_reference[3 * right], 0.1, 1e-15);
  assert_true(isnan(term->foot_reference[3 * (1 - right)]));
  assert_true(isnan(term->foot_reference[6 * 4 + 3 * right]));
  ambulo_problem_free(p);
}

static void what_is_not_there_is_refused(void **state) {
  static const char table[] = "time,RHEE.x,RHEE.y,RHEE.z\n0,1,2,3\n1,1,2,3\n";
  static const struct {
    const char *term, *message;
  } cases[] = {
      {"term: point_tracking", "the reference has no columns NAME.x, NAME.y, NAME.z of a point"},
      {"term: point_tracking, points: {heel_r: RHEEL}",
       "the reference has no columns 'RHEEL.x', 'RHEEL.y', 'RHEEL.z'"},
      {"term: point_tracking, points: {heel_rr: RHEE}", "unknown point (got 'heel_rr')"},
      {"term: point_tracking, points: [heel_rr]", "unknown point (got 'heel_rr')"},
      {"term: point_tracking, points: []", "no points; expected"},
      {"term: point_tracking, points: {heel_r: RHEE}, scale: {heel_l: 2}", "unknown key 'heel_l'"},
      {"term: point_tracking, points: {heel_r: RHEE}, scale: -1", "-1"},
      {"term: force_tracking", "the reference has no columns 'grf.right.x' of a foot"},
      {"term: force_tracking, feet: {righ: RHEE}", "unknown key 'righ'"},
      {"term: pressure_tracking, feet: {right: RTOE}", "no columns 'RTOE.x'"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    ambulo_problem *p = NULL;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    assert_true(load_text(text_with(state, "bad.csv", table, cases[i].term), list, &p));
    assert_null(p);
    assert_message(list, 0, cases[i].message);
    ambulo_diagnostics_free(list);
  }
  expect_refusal(LEGS "time: {duration: 1, intervals: 8}\nobjective: [{term: point_tracking}]\n",
                 AMBULO_E_SCHEMA, "missing required key 'reference'");
}

static void forces_need_ground_reaction(void **state) {
  static char text[2048];
  const char *path = scratch_path(state, "f.csv");
  scratch_write(path, "time,grf.right.x,grf.right.y,grf.right.z\n0,0,700,0\n1,0,700,0\n");
  (void)snprintf(text, sizeof text,
                 LEGS "time: {duration: 1, intervals: 8}\n"
                      "objective: [{term: force_tracking, reference: %s}]\n",
                 path);
  expect_refusal(text, AMBULO_E_PROBLEM, "no forces on feet without ground_reaction");
}

static void millimetres_are_doubted(void **state) {
  ambulo_problem *p = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  const char *text = text_with(state, "mm.csv", "time,RHEE.x,RHEE.y,RHEE.z\n0,1,1200,3\n1,1,2,3\n",
                               "term: point_tracking, points: {heel_r: RHEE}");
  assert_int_equal(load_text(text, list, &p), AMBULO_OK);
  assert_message(list, 0, "the reference has a place at 1200 m");
  ambulo_diagnostics_free(list);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(points_have_columns_of_their_own_name, scratch_open,
                                      scratch_close),
      cmocka_unit_test_setup_teardown(markers_of_a_trc_are_named, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(feet_have_columns_of_forces, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(a_foot_may_be_left_out, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(what_is_not_there_is_refused, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(forces_need_ground_reaction, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(millimetres_are_doubted, scratch_open, scratch_close),
  };
  return cmocka_run_group_tests_name("definitions/problem_tracking", tests, NULL, NULL);
}
