/* cli/cmd_check.c - ambulo check: is the file sound, and are the gradients right?
 *
 * Problem: every gradient family against central differences at a fixed, unremarkable point,
 * by name; then how many of the rows at the zero start are independent. Both: do the feet stand on
 * the ground where a solve begins? */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/body.h"
#include "cli/output.h"

enum { MOST_FAMILIES = 64 };
/* relative disagreement above which a gradient counts as wrong; see ambulo_derivative_error */
static const double tolerance = 1e-7;

/* a point without special structure, |x| <= 0.1 rad or m, that changes slowly from one control
 * point to the next: a body that does not fly has a zero-moment point */
static void unremarkable_point(double *x, int count, int coordinates) {
  for (int i = 0; i < count; i++) {
    int point = i / coordinates, coordinate = i % coordinates;
    x[i] = 0.1 * sin(1.0 + 0.15 * point + 2.39996 * coordinate);
  }
}

static int print_gradients(const ambulo_derivative_error *errors, int count) {
  int wrong = 0;
  printf("  %-22s %-10s %-20s %-20s %s\n", "gradient", "error", "row", "unknown", "time");
  for (int i = 0; i < count; i++) {
    const ambulo_derivative_error *e = &errors[i];
    int bad = !(e->error <= tolerance);
    wrong += bad;
    printf("  %-22s %-10.1e %-20s %-20s", e->family, e->error,
           e->subject && e->subject[0] ? e->subject : "-", e->variable ? e->variable : "-");
    printf(" %.4f s%s\n", e->time, bad ? "  WRONG" : "");
    if (bad) printf("    analytic %.9g, numeric %.9g\n", e->analytic, e->numeric);
  }
  return wrong;
}

static ambulo_status check_gradients(const ambulo_problem *problem, int *wrong) {
  int n = ambulo_problem_variable_count(problem), count = 0;
  ambulo_derivative_error errors[MOST_FAMILIES];
  ambulo_workspace *workspace = NULL;
  double *x = calloc((size_t)n + 1, sizeof *x);
  ambulo_status status = x ? ambulo_workspace_create(problem, NULL, &workspace) : AMBULO_E_MEMORY;
  if (!status) {
    unremarkable_point(x, n, n / ambulo_problem_control_point_count(problem));
    status =
        ambulo_problem_check_derivatives(problem, workspace, x, 0.0, errors, MOST_FAMILIES, &count);
  }
  if (!status) *wrong += print_gradients(errors, count);
  ambulo_workspace_free(workspace);
  free(x);
  return status;
}

static ambulo_status check_rank(const ambulo_problem *problem, ambulo_diagnostics *diagnostics) {
  double *zero = calloc((size_t)ambulo_problem_variable_count(problem) + 1, sizeof *zero);
  if (!zero) return AMBULO_E_MEMORY;
  ambulo_options options = ambulo_problem_options(problem);
  ambulo_result *result = NULL;
  ambulo_status status = ambulo_audit_point(problem, &options, zero, NULL, diagnostics, &result);
  if (!status) {
    const ambulo_audit *audit = ambulo_result_audit(result);
    printf("  at the zero start: %d active rows of rank %d, %d dependent equalities\n",
           audit->active_rows, audit->rank, audit->dropped_equalities);
  }
  ambulo_result_free(result);
  free(zero);
  return status;
}

static ambulo_status check_problem(const char *file, const ambulo_problem *problem,
                                   ambulo_diagnostics *diagnostics, int *wrong) {
  printf("%s: problem '%s', %d unknowns, %d rows%s\n", file,
         ambulo_problem_name(problem) ? ambulo_problem_name(problem) : "",
         ambulo_problem_variable_count(problem), ambulo_problem_row_count(problem),
         ambulo_problem_contact_count(problem) ? "; every foothold is within reach" : "");
  ambulo_status status = check_gradients(problem, wrong);
  return status ? status : check_rank(problem, diagnostics);
}

/* the lowest of the points that the feet stand on, and its height along up; -1: none */
static int lowest_point(const ambulo_model *model, const double *places, double *height) {
  const double *up = ambulo_model_up(model);
  int lowest = -1;
  for (int f = 0; f < ambulo_model_foot_count(model); f++) {
    const ambulo_foot *foot = ambulo_model_foot(model, f);
    const int points[4] = {foot->heel[0], foot->heel[1], foot->toe[0], foot->toe[1]};
    for (int k = 0; k < 4; k++) {
      if (points[k] < 0) continue;
      const double *p = places + 3 * points[k];
      double at = p[0] * up[0] + p[1] * up[1] + p[2] * up[2];
      if (lowest >= 0 && at >= *height) continue;
      lowest = points[k];
      *height = at;
    }
  }
  return lowest;
}

/* q[coordinates] of the start pose; 1 if that is not q = 0 */
static int start_pose(const ambulo_model *model, double *q) {
  int other = 0;
  for (int i = 0; i < ambulo_model_coordinate_count(model); i++) {
    q[i] = ambulo_model_coordinate(model, i)->default_value;
    other |= q[i] != 0.0;
  }
  return other;
}

static ambulo_status check_standing(const ambulo_model *model, double ground) {
  static const double level = 1e-3; /* m */
  size_t d = (size_t)ambulo_model_coordinate_count(model);
  size_t points = (size_t)ambulo_model_point_count(model);
  double *q = calloc(d + 1, sizeof *q), *zero = calloc(d + 1, sizeof *zero);
  double *places = calloc(3 * points + 1, sizeof *places);
  double height = ground;
  ambulo_mechanics *mechanics = NULL;
  ambulo_status status =
      q && zero && places ? ambulo_mechanics_create(model, NULL, &mechanics) : AMBULO_E_MEMORY;
  int other = q && start_pose(model, q);
  if (!status)
    status = ambulo_mechanics_inverse_dynamics(
        mechanics, 1, q, zero, zero,
        &(ambulo_outputs){.size = sizeof(ambulo_outputs), .points = places});
  int lowest = status ? -1 : lowest_point(model, places, &height);
  if (lowest >= 0 && fabs(height - ground) > level)
    printf("  at %s the feet are off the ground: %s is %.3f m %s it, and a solve from %s has to "
           "correct that\n",
           other ? "the start pose" : "q = 0", ambulo_model_point(model, lowest)->name,
           fabs(height - ground), height > ground ? "above" : "below", other ? "there" : "zero");
  ambulo_mechanics_free(mechanics);
  free(q);
  free(zero);
  free(places);
  return status;
}

static void print_model_size(const char *file, const ambulo_model *model) {
  int links = ambulo_model_link_count(model), d = ambulo_model_coordinate_count(model);
  printf("%s: model '%s', %d link%s, %d coordinate%s, %.3f kg\n", file, ambulo_model_name(model),
         links, links == 1 ? "" : "s", d, d == 1 ? "" : "s", ambulo_model_mass(model));
}

static int check_file(const ambulo__cli_input *input, const char *file) {
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo__cli_body body = {.model = NULL};
  int wrong = 0;
  ambulo_status status = ambulo__cli_load(input, file, diagnostics, &body);
  if (!status && body.problem) status = check_problem(file, body.problem, diagnostics, &wrong);
  if (!status && !body.problem) print_model_size(file, body.model);
  if (!status) status = check_standing(body.model, body.ground_height);
  int code = ambulo__cli_diagnostics(diagnostics, status, file);
  if (code && input->argument_count > 1 && ambulo__cli_flag(input, "set"))
    ambulo__cli_error(ambulo_status_name(status), NULL, "%s: not valid with these settings", file);
  ambulo__cli_body_free(&body);
  ambulo_diagnostics_free(diagnostics);
  if (!code && wrong) {
    ambulo__cli_error("E_NUMERIC", NULL, "%s: %d gradients disagree with central differences", file,
                      wrong);
    code = ambulo_status_exit_code(AMBULO_E_NUMERIC);
  }
  return code;
}

/* the worst code of all files: every file is looked at */
static int run(const ambulo__cli_input *input) {
  int worst = 0;
  for (int i = 0; i < input->argument_count; i++) {
    int code = check_file(input, input->arguments[i]);
    if (code > worst) worst = code;
  }
  return worst;
}

static const ambulo__cli_option options[] = {
    AMBULO__CLI_SET_OPTION,
};

const ambulo__cli_command ambulo__cli_check = {
    .name = "check",
    .arguments = "FILE.yaml...",
    .summary = "validate models and problems; check gradients",
    .description =
        "Reads each file with every check that a solve makes. Compares the gradients of a problem\n"
        "with central differences: one line for each family, with the worst row, unknown and "
        "time.\n"
        "Reports feet that are off the ground in the start pose. --set applies to every file.\n"
        "Exit code 1: a gradient is off by more than 1e-7 of its size; 3: a file is invalid.",
    .example = "ambulo check models/lower_body_18.yaml models/yardstick_12.yaml\n"
               "ambulo check models/yardstick_12.yaml --set time.intervals=24",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum = 1,
    .maximum = -1,
    .files = -1,
    .words = "ambulo models --names",
    .run = run,
};
