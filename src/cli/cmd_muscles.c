/* cli/cmd_muscles.c - ambulo muscles: activations, contact forces and metabolic power of a motion.
 */
#include <math.h>
#include <stdio.h>
#include <sys/stat.h>

#include "cli/body.h"
#include "cli/output.h"
#include "cli/summary.h"

typedef struct job {
  ambulo__cli_body body;
  ambulo_muscles *muscles;
  ambulo_muscle_analysis *analysis;
  ambulo_diagnostics *diagnostics;
  char motion[4096];
} job;

/* the table of a result folder, or the file itself */
static void find_motion(const char *argument, job *j) {
  struct stat about;
  int folder = stat(argument, &about) == 0 && S_ISDIR(about.st_mode);
  ambulo__cli_format(j->motion, sizeof j->motion, "%s%s", argument, folder ? "/motion.csv" : "");
}

/* those of a file; of the problem, on the body as options change it; else the shipped ones */
static ambulo_status load_muscles(const ambulo__cli_input *input, job *j) {
  const char *file = ambulo__cli_value(input, "muscles");
  const ambulo_muscles *own = j->body.problem ? ambulo_problem_muscles(j->body.problem) : NULL;
  if (file || !own)
    return ambulo__cli_load_muscles(file, j->body.model, j->diagnostics, &j->muscles);
  ambulo_muscles_definition d = ambulo_muscles_definition_default();
  d.name = ambulo_muscles_name(own);
  d.source = ambulo_muscles_source(own);
  d.muscles = ambulo_muscles_get(own, 0);
  d.muscle_count = ambulo_muscles_count(own);
  return ambulo_muscles_create(j->body.model, &d, NULL, j->diagnostics, &j->muscles);
}

static ambulo_status analyse(const ambulo__cli_input *input, job *j, int overwrite) {
  ambulo_muscle_options options = ambulo_muscle_options_default();
  const char *output = ambulo__cli_value(input, "output");
  if (!ambulo__cli_number(input, "metabolic", 0.0, 1e6, &options.metabolic) ||
      !ambulo__cli_number(input, "activation", 0.0, 1e6, &options.activation))
    return AMBULO_E_ARGUMENT;
  if (!(options.metabolic > 0.0 || options.activation > 0.0)) {
    ambulo__cli_usage_error("muscles", NULL,
                            "--activation and --metabolic are 0; expected a price above 0");
    return AMBULO_E_ARGUMENT;
  }
  ambulo_status status = load_muscles(input, j);
  if (!status)
    status = ambulo_muscle_analysis_create(j->muscles, j->motion, &options, NULL, j->diagnostics,
                                           &j->analysis);
  if (!status && output)
    status = ambulo_muscle_analysis_write(j->analysis, output, overwrite, j->diagnostics);
  return status;
}

static double largest(const double *values, int rows, int entries, int entry, int *row) {
  double most = 0.0;
  *row = 0;
  for (int k = 0; k < rows; k++) {
    double value = values[(size_t)k * (size_t)entries + (size_t)entry];
    if (value <= most) continue;
    most = value;
    *row = k;
  }
  return most;
}

static double contact_at(const ambulo_muscle_values *v, int row, int joint) {
  const double *c = v->contact + 3 * ((size_t)row * (size_t)v->joints + (size_t)joint);
  return sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]) / v->body_weight;
}

static void print_joints(const ambulo_muscle_values *v) {
  if (v->joints > 0)
    printf("%-16s %14s %8s %8s %8s %8s\n", "joint", "contact, BW", "at, s", "x, N", "y, N", "z, N");
  for (int j = 0; j < v->joints; j++) {
    int at = 0;
    for (int k = 1; k < v->rows; k++)
      if (contact_at(v, k, j) > contact_at(v, at, j)) at = k;
    const double *c = v->contact + 3 * ((size_t)at * (size_t)v->joints + (size_t)j);
    printf("%-16s %14.2f %8.3f %8.0f %8.0f %8.0f\n", v->joint[j], contact_at(v, at, j),
           v->times[at], c[0], c[1], c[2]);
  }
}

static void print_muscles(const job *j, const ambulo_muscle_values *v) {
  const int m = ambulo_muscles_count(j->muscles);
  printf("\n%-16s %-16s %10s %8s %10s\n", "muscle", "group", "activation", "at, s", "force, N");
  for (int i = 0; i < m; i++) {
    int at, other;
    double activation = largest(v->activation, v->rows, m, i, &at);
    const ambulo_muscle *muscle = ambulo_muscles_get(j->muscles, i);
    printf("%-16s %-16s %10.2f %8.3f %10.0f\n", muscle->name, muscle->group, activation,
           v->times[at], largest(v->force, v->rows, m, i, &other));
  }
}

static void print_all(const job *j) {
  const ambulo_muscle_values *v = ambulo_muscle_analysis_values(j->analysis);
  ambulo__cli_print_metabolic(v);
  print_joints(v);
  print_muscles(j, v);
}

static int run(const ambulo__cli_input *input) {
  job j = {.diagnostics = ambulo_diagnostics_create(NULL)};
  ambulo_status status = AMBULO_OK;
  char *text = NULL;
  find_motion(input->arguments[1], &j);
  int code = ambulo__cli_body_load(input, input->arguments[0], j.diagnostics, &j.body, &status);
  if (!code) {
    if (!status) status = analyse(input, &j, ambulo__cli_flag(input, "force"));
    if (!status && ambulo__cli_flag(input, "json"))
      status = ambulo_muscle_analysis_json(j.analysis, NULL, &text);
    code = status == AMBULO_E_ARGUMENT && !ambulo_diagnostics_count(j.diagnostics)
               ? 2
               : ambulo__cli_diagnostics(j.diagnostics, status, input->arguments[0]);
  }
  if (text)
    fputs(text, stdout);
  else if (!code && !status)
    print_all(&j);
  ambulo_text_free(text, NULL);
  ambulo_muscle_analysis_free(j.analysis);
  ambulo_muscles_free(j.muscles);
  ambulo__cli_body_free(&j.body);
  ambulo_diagnostics_free(j.diagnostics);
  return code;
}

static const ambulo__cli_option options[] = {
    {"muscles", 0, "FILE", "muscles (default: those of the problem, else leg_muscles.yaml)"},
    {"output", 'o', "FILE", "write the table there: CSV, or STO by the name's ending"},
    {"force", 0, NULL, "overwrite a file that ambulo did not write"},
    {"json", 0, NULL, "print the summary as JSON"},
    {"activation", 0, "PRICE", "price of squared activations, by volume (default: 1)"},
    {"metabolic", 0, "PRICE", "price of metabolic power (default: 0)"},
    AMBULO__CLI_BODY_OPTIONS,
};

const ambulo__cli_command ambulo__cli_muscles = {
    .name = "muscles",
    .arguments = "MODEL.yaml|PROBLEM.yaml DIR|MOTION",
    .summary = "share the torques of a motion among muscles",
    .description =
        "Finds activations, forces and lengths of muscles, contact forces of joints and metabolic\n"
        "power. DIR is a result of solve; MOTION a table of 'ambulo inverse' or a motion.csv, "
        "with\n"
        "the columns q, qd, qdd and tau of every coordinate. Subject, slope and load are those of\n"
        "the problem or of the options, muscles and their strengths those of the problem.\n"
        "See docs/guide-muscles.md.",
    .example = "ambulo solve models/walk.yaml -o stride\n"
               "ambulo muscles models/walk.yaml stride -o muscles.csv",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum = 2,
    .maximum = 2,
    .files = 1,
    .words = "ambulo models --names",
    .run = run,
};
