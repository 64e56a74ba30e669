/* Empty names of files and folders: told at once, with what the name is of, before anything is read
 * or written; an unset variable of a script is the usual cause. */
#include "base/diagnostics.h"
#include "support/arm.h"
#include "ambulo/tools/tools.h"
#include "support/messages.h"
#include "support/scratch.h"

typedef struct objects {
  ambulo_model *model;
  ambulo_problem *problem;
  ambulo_result *result;
  ambulo_diagnostics *list;
  double x[4000];
} objects;

static void open_objects(objects *o) {
  o->list = ambulo_diagnostics_create(NULL);
  o->model = arm_create();
  assert_true(o->model && o->list);
  ambulo_problem_definition definition = arm_definition(o->model);
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &o->problem), AMBULO_OK);
  assert_int_equal(ambulo_audit_point(o->problem, NULL, o->x, NULL, NULL, &o->result), AMBULO_OK);
}

static void close_objects(objects *o) {
  ambulo_result_free(o->result);
  ambulo_problem_free(o->problem);
  ambulo_model_free(o->model);
  ambulo_diagnostics_free(o->list);
}

/* the status of a call, and the one message it left */
static void refused(objects *o, ambulo_status status, const char *says) {
  assert_int_equal(status, AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_diagnostics_count(o->list), 1);
  assert_message(o->list, 0, says);
  ambulo__diagnostics_clear(o->list);
}

static void files_that_are_read(void **state) {
  static objects o;
  open_objects(&o);
  ambulo_model *model = NULL;
  ambulo_problem *problem = NULL;
  ambulo_sweep *sweep = NULL;
  ambulo_file_kind kind;
  char *text = NULL;
  const char *says = "ambulo: error[E_ARGUMENT]: the name of the file is empty; expected a path";
  (void)state;
  refused(&o, ambulo_model_load("", NULL, NULL, o.list, &model), says);
  refused(&o, ambulo_model_load_with("", NULL, 0, NULL, NULL, o.list, &model), says);
  refused(&o, ambulo_problem_load("", NULL, 0, NULL, o.list, &problem), says);
  refused(&o, ambulo_file_kind_of("", NULL, o.list, &kind), says);
  refused(&o, ambulo_sweep_load("", NULL, o.list, &sweep), says);
  refused(&o, ambulo_solution_load("", o.problem, NULL, o.list, o.x), says);
  refused(&o, ambulo_solution_start("", o.problem, NULL, o.list, o.x), says);
  refused(&o, ambulo_inverse_dynamics_motion(o.model, "", "x", NULL, NULL, o.list, NULL),
          "the name of the motion is empty");
  ambulo_inverse_options nameless = ambulo_inverse_options_default();
  ambulo_inverse_outputs outputs = ambulo_inverse_outputs_default();
  nameless.forces = "";
  outputs.text = &text;
  refused(&o, ambulo_inverse_dynamics_motion(o.model, "x", NULL, &nameless, NULL, o.list, &outputs),
          "the name of the file of forces is empty");
  assert_true(!model && !problem && !sweep && !text);
  close_objects(&o);
}

static void folders_that_are_read(void **state) {
  static objects o;
  open_objects(&o);
  ambulo_comparison *comparison = NULL;
  ambulo_batch_census census;
  char *text = NULL;
  (void)state;
  refused(&o, ambulo_compare("", "x", NULL, NULL, o.list, &comparison),
          "the name of the result folder is empty");
  const char *says = "the name of the batch folder is empty";
  refused(&o, ambulo_batch_status("", NULL, o.list, &census), says);
  refused(&o, ambulo_batch_verify("", NULL, NULL, NULL, o.list, &census), says);
  refused(&o, ambulo_batch_collect("", NULL, o.list, &census), says);
  assert_true(!comparison && !text);
  close_objects(&o);
}

static void what_is_written(void **state) {
  static objects o;
  open_objects(&o);
  ambulo_sweep *sweep = NULL;
  ambulo_batch_options options = ambulo_batch_options_default();
  options.program = "";
  const char *motion = scratch_path(state, "m.csv"), *file = scratch_path(state, "s.yaml");
  scratch_write(motion, "time,shoulder\n0,0\n1,1\n2,2\n3,3\n");
  char here[SCRATCH_PATH], text[2 * SCRATCH_PATH];
  assert_non_null(getcwd(here, sizeof here));
  (void)snprintf(text, sizeof text,
                 "ambulo: 1\nkind: sweep\nname: s\nbase: %s/models/two_link_reach.yaml\n"
                 "axes: [{key: time.intervals, values: [20]}]\n",
                 here);
  scratch_write(file, text);
  assert_int_equal(ambulo_sweep_load(file, NULL, o.list, &sweep), AMBULO_OK);
  const char *folder = "the name of the folder to write is empty; expected a path";
  refused(&o, ambulo_report_check("", NULL, o.list), folder);
  refused(&o, ambulo_report_write(o.problem, o.result, "", NULL, NULL, o.list), folder);
  refused(&o, ambulo_inverse_dynamics_motion(o.model, motion, "", NULL, NULL, o.list, NULL),
          "the name of the output is empty");
  refused(&o, ambulo_batch_run(sweep, "", NULL, NULL, o.list, NULL),
          "the name of the batch folder is empty");
  refused(&o, ambulo_batch_run(sweep, scratch_path(state, "b"), &options, NULL, o.list, NULL),
          "the name of the program is empty");
  assert_int_equal(entries_in(*state), 2);
  ambulo_sweep_free(sweep);
  close_objects(&o);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(files_that_are_read),
      cmocka_unit_test(folders_that_are_read),
      cmocka_unit_test_setup_teardown(what_is_written, scratch_open, scratch_close),
  };
  return cmocka_run_group_tests_name("api/names", tests, NULL, NULL);
}
