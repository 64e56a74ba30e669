/* cli/cmd_evaluate.c - ambulo evaluate: objective, rows and audit of given control points. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/body.h"
#include "cli/output.h"
#include "cli/summary.h"

typedef struct evaluation {
  ambulo_problem *problem;
  double *x;
  ambulo_result *result;
  ambulo_diagnostics *diagnostics;
} evaluation;

static ambulo_status audit(const ambulo__cli_input *input, evaluation *e) {
  ambulo_status status =
      ambulo__cli_load_problem(input, input->arguments[0], e->diagnostics, &e->problem);
  if (status) return status;
  e->x = calloc((size_t)ambulo_problem_variable_count(e->problem), sizeof *e->x);
  if (!e->x) return AMBULO_E_MEMORY;
  if (strcmp(input->arguments[1], "zero") != 0) {
    status = ambulo_solution_load(input->arguments[1], e->problem, NULL, e->diagnostics, e->x);
    if (status) return status;
  }
  ambulo_options options = ambulo_problem_options(e->problem);
  return ambulo_audit_point(e->problem, &options, e->x, NULL, e->diagnostics, &e->result);
}

static ambulo_status print_json(const evaluation *e) {
  char *text = NULL;
  ambulo_status status = ambulo_report_summary(e->problem, e->result, NULL, NULL, &text);
  if (status) return status;
  fputs(text, stdout);
  ambulo_text_free(text, NULL);
  return AMBULO_OK;
}

static int run(const ambulo__cli_input *input) {
  evaluation e = {.diagnostics = ambulo_diagnostics_create(NULL)};
  int rows = ambulo__cli_flag(input, "rows");
  ambulo_status status = audit(input, &e);
  int code = ambulo__cli_diagnostics(e.diagnostics, status, input->arguments[0]);
  if (!status && ambulo__cli_flag(input, "json")) {
    status = print_json(&e);
    if (status) code = ambulo__cli_diagnostics(NULL, status, "summary");
  } else if (!status) {
    ambulo__cli_print_result(e.problem, e.result);
    if (rows) ambulo__cli_print_rows(e.problem, e.result);
    ambulo__cli_print_last(e.result);
  }
  ambulo_result_free(e.result);
  free(e.x);
  ambulo_problem_free(e.problem);
  ambulo_diagnostics_free(e.diagnostics);
  return code;
}

static const ambulo__cli_option options[] = {
    {"set", 0, "path=value", "replace a value of the problem file; may be repeated"},
    {"rows", 0, NULL, "list every constraint row by name"},
    {"json", 0, NULL, "print what summary.json would hold"},
};

const ambulo__cli_command ambulo__cli_evaluate = {
    .name = "evaluate",
    .arguments = "PROBLEM.yaml SOLUTION.yaml",
    .summary = "audit given control points",
    .description =
        "Recomputes everything from the control points in SOLUTION.yaml ('zero': all zero) and\n"
        "judges them as if a solver had returned them. Exit code 0 whatever the verdict.",
    .example = "ambulo evaluate models/walk_normal.yaml walk/solution.yaml --json",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum = 2,
    .maximum = 2,
    .files = 1,
    .words = "ambulo models --names problem",
    .run = run,
};
