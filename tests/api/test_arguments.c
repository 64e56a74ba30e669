/* Arguments outside what the headers allow: E_ARGUMENT, and outputs stay as they are. */
#include "support/arm.h"
#include "ambulo/tools/tools.h"
#include "support/test.h"

enum { ROOM = 4000 };

typedef struct objects {
  ambulo_model *model;
  ambulo_problem *problem;
  ambulo_workspace *workspace;
  ambulo_mechanics *mechanics;
  ambulo_result *result;
  double x[ROOM], out[ROOM];
} objects;

static const double untouched = 7.5;

static int open_objects(void **state) {
  objects *o = calloc(1, sizeof *o);
  if (!o) return -1;
  for (int i = 0; i < ROOM; i++) o->out[i] = untouched;
  o->model = arm_create();
  ambulo_problem_definition definition = arm_definition(o->model);
  int bad = ambulo_problem_create(&definition, NULL, NULL, &o->problem) ||
            ambulo_workspace_create(o->problem, NULL, &o->workspace) ||
            ambulo_mechanics_create(o->model, NULL, &o->mechanics) ||
            ambulo_audit_point(o->problem, NULL, o->x, NULL, NULL, &o->result);
  *state = o;
  return bad ? -1 : 0;
}

static int close_objects(void **state) {
  objects *o = *state;
  ambulo_result_free(o->result);
  ambulo_mechanics_free(o->mechanics);
  ambulo_workspace_free(o->workspace);
  ambulo_problem_free(o->problem);
  ambulo_model_free(o->model);
  free(o);
  return 0;
}

static void assert_untouched(const objects *o) {
  for (int i = 0; i < ROOM; i++) assert_true(o->out[i] == untouched);
}

#define REFUSED(call) assert_int_equal(call, AMBULO_E_ARGUMENT)

static void objects_are_not_made_of_nothing(void **state) {
  objects *o = *state;
  ambulo_problem_definition d = arm_definition(o->model);
  ambulo_model *model = o->model;
  ambulo_problem *problem = o->problem;
  ambulo_workspace *workspace = o->workspace;
  ambulo_mechanics *mechanics = o->mechanics;
  ambulo_result *result = o->result;
  REFUSED(ambulo_model_load(NULL, NULL, NULL, NULL, &model));
  REFUSED(ambulo_model_load("x", NULL, NULL, NULL, NULL));
  REFUSED(ambulo_model_load_with(NULL, NULL, 0, NULL, NULL, NULL, &model));
  REFUSED(ambulo_model_load_with("x", NULL, 0, NULL, NULL, NULL, NULL));
  REFUSED(ambulo_model_load_with("x", NULL, 1, NULL, NULL, NULL, &model));
  REFUSED(ambulo_model_load_with("x", NULL, -1, NULL, NULL, NULL, &model));
  REFUSED(ambulo_model_load_text(NULL, 0, "x", NULL, NULL, NULL, &model));
  REFUSED(ambulo_model_create(NULL, NULL, NULL, &model));
  REFUSED(ambulo_problem_load(NULL, NULL, 0, NULL, NULL, &problem));
  REFUSED(ambulo_problem_load("x", NULL, 2, NULL, NULL, &problem));
  REFUSED(ambulo_problem_load("x", NULL, -1, NULL, NULL, &problem));
  REFUSED(ambulo_problem_load_text(
      &(ambulo_problem_text){
          .size = sizeof(ambulo_problem_text),
      },
      NULL, NULL, &problem));
  REFUSED(ambulo_problem_create(NULL, NULL, NULL, &problem));
  REFUSED(ambulo_problem_create(&d, NULL, NULL, NULL));
  d.model = NULL;
  REFUSED(ambulo_problem_create(&d, NULL, NULL, &problem));
  REFUSED(ambulo_workspace_create(NULL, NULL, &workspace));
  REFUSED(ambulo_workspace_create(problem, NULL, NULL));
  REFUSED(ambulo_mechanics_create(NULL, NULL, &mechanics));
  REFUSED(ambulo_mechanics_create(model, NULL, NULL));
  REFUSED(ambulo_solve(NULL, NULL, NULL, NULL, NULL, &result));
  REFUSED(ambulo_solve(problem, NULL, NULL, NULL, NULL, NULL));
  REFUSED(ambulo_audit_point(problem, NULL, NULL, NULL, NULL, &result));
  REFUSED(ambulo_audit_point(NULL, NULL, o->x, NULL, NULL, &result));
  const ambulo_progress last = {.point = o->x};
  const ambulo_ending ending = AMBULO_ENDING_TIME;
  REFUSED(ambulo_audit_progress(NULL, NULL, &last, ending, NULL, NULL, &result));
  REFUSED(ambulo_audit_progress(problem, NULL, NULL, ending, NULL, NULL, &result));
  REFUSED(ambulo_audit_progress(problem, NULL, &last, ending, NULL, NULL, NULL));
  REFUSED(ambulo_audit_progress(problem, NULL, &last, AMBULO_ENDING_NONE, NULL, NULL, &result));
  assert_ptr_equal(model, o->model);
  assert_ptr_equal(problem, o->problem);
  assert_ptr_equal(workspace, o->workspace);
  assert_ptr_equal(mechanics, o->mechanics);
  assert_ptr_equal(result, o->result);
}

/* a count without an array, and a negative count */
static void arrays_belong_to_their_counts(void **state) {
  objects *o = *state;
  ambulo_problem *problem = NULL;
  for (int count = -1; count <= 2; count += 3) {
    for (int k = 0; k < 5; k++) {
      ambulo_problem_definition d = ambulo_problem_definition_default();
      int *counts[5] = {&d.contact_count, &d.term_count, &d.user_row_count, &d.end_value_count,
                        &d.tube_count};
      d.model = o->model;
      *counts[k] = count;
      REFUSED(ambulo_problem_create(&d, NULL, NULL, &problem));
    }
    ambulo_model_definition m = ambulo_model_definition_default();
    ambulo_model *model = NULL;
    m.link_count = count;
    REFUSED(ambulo_model_create(&m, NULL, NULL, &model));
  }
  assert_null(problem);
}

static void points_and_outputs_are_needed(void **state) {
  objects *o = *state;
  const ambulo_problem *p = o->problem;
  ambulo_workspace *w = o->workspace;
  double *x = o->x, *out = o->out;
  REFUSED(ambulo_problem_evaluate(p, w, NULL, out, out, out));
  REFUSED(ambulo_problem_evaluate(NULL, w, x, out, out, out));
  REFUSED(ambulo_problem_evaluate(p, NULL, x, out, out, out));
  REFUSED(ambulo_problem_gradient(p, w, NULL, 1.0, NULL, out));
  REFUSED(ambulo_problem_gradient(p, w, x, 1.0, NULL, NULL));
  REFUSED(ambulo_problem_row_gradient(p, w, x, -1, out));
  REFUSED(ambulo_problem_row_gradient(p, w, x, ambulo_problem_row_count(p), out));
  REFUSED(ambulo_problem_row_gradient(p, w, x, 0, NULL));
  REFUSED(ambulo_problem_transfer(NULL, x, p, out));
  REFUSED(ambulo_problem_transfer(p, NULL, p, out));
  REFUSED(ambulo_problem_transfer(p, x, p, NULL));
  ambulo_derivative_error error;
  int count = 77;
  REFUSED(ambulo_problem_check_derivatives(p, w, x, 0.0, NULL, 1, &count));
  REFUSED(ambulo_problem_check_derivatives(p, w, x, 0.0, &error, -1, &count));
  REFUSED(ambulo_problem_check_derivatives(p, w, NULL, 0.0, &error, 1, &count));
  REFUSED(ambulo_problem_check_derivatives(p, w, x, 0.0, &error, 1, NULL));
  assert_int_equal(count, 77);
  ambulo_row row = {.node = 77};
  REFUSED(ambulo_problem_row(p, -1, &row));
  REFUSED(ambulo_problem_row(p, ambulo_problem_row_count(p), &row));
  REFUSED(ambulo_problem_row(p, 0, NULL));
  assert_int_equal(row.node, 77);
  ambulo_limits limits = {.low_of = 77};
  REFUSED(ambulo_problem_limits(NULL, 0, AMBULO_LIMITED_POSITION, &limits));
  REFUSED(ambulo_problem_limits(p, -1, AMBULO_LIMITED_POSITION, &limits));
  REFUSED(ambulo_problem_limits(p, 1 << 20, AMBULO_LIMITED_POSITION, &limits));
  REFUSED(ambulo_problem_limits(p, 0, (ambulo_limited)4, &limits));
  REFUSED(ambulo_problem_limits(p, 0, AMBULO_LIMITED_NOT_SET, &limits));
  REFUSED(ambulo_problem_limits(p, 0, AMBULO_LIMITED_POSITION, NULL));
  assert_int_equal(limits.low_of, 77);
  assert_untouched(o);
  assert_int_equal(ambulo_problem_evaluate(p, w, x, NULL, NULL, NULL), AMBULO_OK);
}

/* times lie in [0, T] */
static void motions_end_with_the_problem(void **state) {
  objects *o = *state;
  double last = ambulo_problem_duration(o->problem);
  double wrong[] = {-0.01, 1.01 * last, (double)NAN, (double)INFINITY};
  ambulo_motion motion = {.size = sizeof(ambulo_motion), .q = o->out};
  const ambulo_problem *p = o->problem;
  for (int i = 0; i < 4; i++)
    REFUSED(ambulo_problem_motion(p, o->workspace, o->x, 1, &wrong[i], &motion));
  REFUSED(ambulo_problem_motion(p, o->workspace, o->x, 0, &last, &motion));
  REFUSED(ambulo_problem_motion(p, o->workspace, o->x, 1, NULL, &motion));
  REFUSED(ambulo_problem_motion(p, o->workspace, o->x, 1, &last, NULL));
  assert_untouched(o);
  assert_int_equal(ambulo_problem_motion(p, o->workspace, o->x, 1, &last, &motion), AMBULO_OK);
  o->out[0] = o->out[1] = untouched;
}

/* nothing is written of what is not finite, but motions, which are filled all the same */
static void values_that_are_not_finite(void **state) {
  objects *o = *state;
  const ambulo_problem *p = o->problem;
  double *out = o->out, half = 0.5 * ambulo_problem_duration(p);
  for (int i = 0; i < ambulo_problem_variable_count(p); i++) o->x[i] = (double)NAN;
  assert_int_equal(ambulo_problem_evaluate(p, o->workspace, o->x, out, out, out), AMBULO_E_NUMERIC);
  assert_int_equal(ambulo_problem_gradient(p, o->workspace, o->x, 1.0, NULL, out),
                   AMBULO_E_NUMERIC);
  assert_int_equal(ambulo_problem_row_gradient(p, o->workspace, o->x, 0, out), AMBULO_E_NUMERIC);
  assert_int_equal(
      ambulo_mechanics_inverse_dynamics(
          o->mechanics, 2, o->x, o->x, o->x,
          &(ambulo_outputs){
              .size = sizeof(ambulo_outputs), .tau = out, .wrench = out, .points = out}),
      AMBULO_E_NUMERIC);
  assert_int_equal(ambulo_mechanics_gradient(
                       o->mechanics, 1, o->x, o->x, o->x,
                       &(ambulo_output_weights){.size = sizeof(ambulo_output_weights), .tau = o->x},
                       &(ambulo_motion_gradient){sizeof(ambulo_motion_gradient), out, out, out}),
                   AMBULO_E_NUMERIC);
  assert_untouched(o);
  double q[2] = {untouched, untouched};
  ambulo_motion motion = {.size = sizeof(ambulo_motion), .q = q};
  assert_int_equal(ambulo_problem_motion(p, o->workspace, o->x, 1, &half, &motion),
                   AMBULO_E_NUMERIC);
  assert_true(isnan(q[0]));
  memset(o->x, 0, sizeof o->x);
}

static void files_need_names(void **state) {
  objects *o = *state;
  char *text = NULL;
  ambulo_comparison *comparison = NULL;
  ambulo_file_kind kind = AMBULO_FILE_PROBLEM;
  REFUSED(ambulo_report_check(NULL, NULL, NULL));
  REFUSED(ambulo_report_write(o->problem, o->result, NULL, NULL, NULL, NULL));
  REFUSED(ambulo_report_write(NULL, o->result, "x", NULL, NULL, NULL));
  REFUSED(ambulo_report_write(o->problem, NULL, "x", NULL, NULL, NULL));
  REFUSED(ambulo_report_summary(NULL, o->result, NULL, NULL, &text));
  REFUSED(ambulo_report_summary(o->problem, o->result, NULL, NULL, NULL));
  REFUSED(ambulo_solution_load(NULL, o->problem, NULL, NULL, o->out));
  REFUSED(ambulo_solution_load("x", NULL, NULL, NULL, o->out));
  REFUSED(ambulo_solution_start("x", o->problem, NULL, NULL, NULL));
  REFUSED(ambulo_inverse_dynamics_motion(NULL, "x", "y", NULL, NULL, NULL, NULL));
  REFUSED(ambulo_inverse_dynamics_motion(o->model, NULL, "y", NULL, NULL, NULL, NULL));
  REFUSED(ambulo_inverse_dynamics_motion(o->model, "x", NULL, NULL, NULL, NULL, NULL));
  REFUSED(ambulo_compare(NULL, "x", NULL, NULL, NULL, &comparison));
  REFUSED(ambulo_compare("x", NULL, NULL, NULL, NULL, &comparison));
  REFUSED(ambulo_file_kind_of(NULL, NULL, NULL, &kind));
  REFUSED(ambulo_file_kind_of("x", NULL, NULL, NULL));
  /* options may be left out: what fails then is the file */
  assert_int_equal(ambulo_compare("no/such", "x", NULL, NULL, NULL, &comparison), AMBULO_E_IO);
  assert_int_equal(ambulo_report_check("no/such/folder", NULL, NULL), AMBULO_E_IO);
  assert_null(text);
  assert_null(comparison);
  assert_int_equal(kind, AMBULO_FILE_PROBLEM);
  assert_untouched(o);
}

static void batches_are_not_asked_for_nothing(void **state) {
  (void)state;
  ambulo_sweep *sweep = NULL;
  ambulo_batch_census census;
  REFUSED(ambulo_sweep_load(NULL, NULL, NULL, &sweep));
  REFUSED(ambulo_sweep_load("x", NULL, NULL, NULL));
  REFUSED(ambulo_batch_run(NULL, "x", NULL, NULL, NULL, NULL));
  REFUSED(ambulo_batch_status(NULL, NULL, NULL, &census));
  REFUSED(ambulo_batch_status("x", NULL, NULL, NULL));
  REFUSED(ambulo_batch_verify(NULL, NULL, NULL, NULL, NULL, &census));
  REFUSED(ambulo_batch_collect(NULL, NULL, NULL, &census));
  assert_null(sweep);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(objects_are_not_made_of_nothing),
      cmocka_unit_test(arrays_belong_to_their_counts),
      cmocka_unit_test(points_and_outputs_are_needed),
      cmocka_unit_test(motions_end_with_the_problem),
      cmocka_unit_test(values_that_are_not_finite),
      cmocka_unit_test(files_need_names),
      cmocka_unit_test(batches_are_not_asked_for_nothing),
  };
  return cmocka_run_group_tests(tests, open_objects, close_objects);
}
