/* cli/cmd_retarget.c - ambulo retarget: a motion of one body becomes that of another.
 *
 * The folder of the task is written, its problem is solved as `ambulo solve` does, into result
 * below it, and the result is judged beside what it follows. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/body.h"
#include "cli/output.h"
#include "cli/shipped.h"

enum { PATH = 4096 };

/* the shipped body whose coordinates have OpenSim's names */
static const char usual_body[] = "whole_body_37.yaml";

static int read_options(const ambulo__cli_input *input, ambulo_retarget_options *o) {
  *o = ambulo_retarget_options_default();
  o->map = ambulo__cli_value(input, "map");
  static const ambulo_times times[] = {AMBULO_TIMES_NOT_SET, AMBULO_TIMES_SCALED,
                                       AMBULO_TIMES_KEPT};
  o->times = times[ambulo__cli_choice(input, "times", -1) + 1];
  o->overwrite = ambulo__cli_flag(input, "force");
  if (!ambulo__cli_value(input, "onto"))
    return ambulo__cli_usage_error("retarget", NULL,
                                   "no body is given; expected --onto MODEL.yaml");
  if (!ambulo__cli_value(input, "output"))
    return ambulo__cli_usage_error("retarget", NULL, "no folder is given; expected -o DIR");
  return ambulo__cli_number(input, "from", -1e9, 1e9, &o->from) &&
                 ambulo__cli_number(input, "to", -1e9, 1e9, &o->to) &&
                 ambulo__cli_number(input, "speed", -100.0, 100.0, &o->speed)
             ? 0
             : 2;
}

/* `ambulo solve` of the folder's problem; its exit code */
static int solve(const ambulo__cli_input *input, char *problem, char *result) {
  char name[] = "ambulo", command[] = "solve", output[] = "-o", limit[] = "--time-limit",
       quiet[] = "--quiet", seconds[64];
  char *argv[9] = {name, command, problem, output, result};
  int argc = 5;
  const char *given = ambulo__cli_value(input, "time-limit");
  if (given) {
    ambulo__cli_format(seconds, sizeof seconds, "%s", given);
    argv[argc++] = limit;
    argv[argc++] = seconds;
  }
  if (ambulo__cli_flag(input, "quiet")) argv[argc++] = quiet;
  return ambulo__cli_run(&ambulo__cli_solve, argc, argv);
}

/* beside what it follows */
static ambulo_status judge(const char *file, const char *solution,
                           ambulo_diagnostics *diagnostics) {
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  char *text = NULL;
  double *x = NULL;
  ambulo_status status = ambulo_problem_load(file, NULL, 0, NULL, diagnostics, &problem);
  if (!status) {
    x = calloc((size_t)ambulo_problem_variable_count(problem), sizeof *x);
    status = x ? ambulo_solution_load(solution, problem, NULL, diagnostics, x) : AMBULO_E_MEMORY;
  }
  if (!status) status = ambulo_audit_point(problem, NULL, x, NULL, NULL, &result);
  if (!status) status = ambulo_retarget_report(problem, result, NULL, &text);
  if (!status) printf("\n%s", text);
  ambulo_text_free(text, NULL);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  free(x);
  return status;
}

static int run(const ambulo__cli_input *input) {
  const char *motion = input->arguments[0], *directory = ambulo__cli_value(input, "output");
  char problem[PATH], result[PATH], solution[PATH], onto[PATH], shipped[PATH];
  ambulo_retarget_options options;
  int code = read_options(input, &options);
  if (code) return code;
  const char *target = ambulo__cli_value(input, "onto"), *body = ambulo__cli_value(input, "body");
  if (ambulo__cli_find_file(target, onto, sizeof onto)) target = onto;
  if (!body) {
    if (ambulo__cli_shipped_file(usual_body, shipped, sizeof shipped)) body = shipped;
  } else if (ambulo__cli_find_file(body, shipped, sizeof shipped)) {
    body = shipped;
  }
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo__cli_body person = {.model = NULL};
  ambulo_status status = AMBULO_OK;
  code = ambulo__cli_body_load(input, body ? body : usual_body, diagnostics, &person, &status);
  options.body = person.model;
  if (!code && !status)
    status = ambulo_retarget_write(motion, target, directory, &options, NULL, diagnostics);
  if (!code) code = ambulo__cli_diagnostics(diagnostics, status, motion);
  ambulo__cli_format(problem, sizeof problem, "%s/problem.yaml", directory);
  ambulo__cli_format(result, sizeof result, "%s/result", directory);
  ambulo__cli_format(solution, sizeof solution, "%s/result/solution.yaml", directory);
  if (!code && !ambulo__cli_flag(input, "only-write")) {
    code = solve(input, problem, result);
    if (code <= 1) {
      ambulo_diagnostics *more = ambulo_diagnostics_create(NULL);
      status = judge(problem, solution, more);
      if (status) code = ambulo__cli_diagnostics(more, status, problem);
      ambulo_diagnostics_free(more);
    }
  }
  ambulo__cli_body_free(&person);
  ambulo_diagnostics_free(diagnostics);
  return code;
}

static const ambulo__cli_option options_table[] = {
    {"onto", 0, "MODEL.yaml", "the body that shall move so"},
    {"output", 'o', "DIR", "folder for the problem, its reference and the result"},
    {"force", 0, NULL, "replace an earlier folder of this command"},
    {"only-write", 0, NULL, "write the problem, and do not solve it"},
    {"body", 0, "FILE",
     "the model or problem whose angles MOTION holds (default:\n"
     "whole_body_37.yaml, which has OpenSim's names)"},
    {"map", 0, "FILE", "segments and their coordinates, as map.yaml in DIR has them"},
    {"from", 0, "S", "first time of the motion (default: its start)"},
    {"to", 0, "S", "last time of the motion (default: its end)"},
    {"times", 0, "scaled|kept",
     "scale times as the root of the legs' lengths, or keep them (default:\n"
     "scaled where the motion flies)"},
    {"speed", 0, "M/S", "speed of the treadmill on which it was measured"},
    {"time-limit", 0, "S", "stop the solve after this time"},
    {"quiet", 'q', NULL, "print only what follows from the motion, and messages"},
    AMBULO__CLI_BODY_OPTIONS,
};

const ambulo__cli_command ambulo__cli_retarget = {
    .name = "retarget",
    .arguments = "MOTION",
    .summary = "make a motion of a person that of another body, such as a robot",
    .description =
        "Reads a motion (CSV, STO, MOT, BVH, SMPL in .npz), finds its contacts, scales its "
        "footholds, and writes a\n"
        "problem that follows its angles within what the other body can do: problem.yaml,\n"
        "reference.csv, model.yaml and map.yaml in DIR. Then it solves the problem into "
        "DIR/result,\n"
        "as 'ambulo solve' does, and prints how far each joint is from the motion, and why. See\n"
        "docs/guide-retarget.md.",
    .example = "ambulo retarget walk/motion.csv --onto robot.yaml -o robot_walk\n"
               "ambulo report robot_walk/result",
    .options = options_table,
    .option_count = sizeof options_table / sizeof options_table[0],
    .minimum = 1,
    .maximum = 1,
    .run = run,
};
