/* cli/cmd_draw.c - ambulo draw: pictures for a paper.
 *
 * With one argument a picture that is there goes into another format; with two the motion is drawn
 * anew from the problem and its solution. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/body.h"
#include "cli/output.h"
#include "cli/shipped.h"

typedef struct drawing {
  ambulo_problem *problem;
  double *x;
  ambulo_result *result;
  ambulo_diagnostics *diagnostics;
  ambulo_picture_options options;
  char norms[4096]; /* the folder of options.norms */
} drawing;

/* what only a picture that is drawn anew can be asked for */
static const char *const of_motion[] = {"set",     "strip",     "curves", "powers", "per-kg",
                                        "percent", "reference", "bare",   "width"};

static const char *needs_problem(const ambulo__cli_input *input) {
  for (size_t i = 0; i < sizeof of_motion / sizeof *of_motion; i++)
    if (ambulo__cli_flag(input, of_motion[i])) return of_motion[i];
  return NULL;
}

static int read_options(const ambulo__cli_input *input, drawing *d) {
  ambulo_picture_options *o = &d->options;
  const char *alone = input->argument_count == 1 ? needs_problem(input) : NULL;
  int strip = ambulo__cli_flag(input, "strip"), curves = ambulo__cli_flag(input, "curves");
  *o = ambulo_picture_options_default();
  if (!ambulo__cli_value(input, "output"))
    return ambulo__cli_usage_error("draw", NULL,
                                   "no output is given; expected -o FILE.pdf, .png or .svg");
  if (alone)
    return ambulo__cli_usage_error("draw", NULL,
                                   "--%s needs the problem; expected PROBLEM.yaml DIR", alone);
  if (strip && curves)
    return ambulo__cli_usage_error(
        "draw", NULL,
        "--strip and --curves are given; expected one of them, or none for both parts");
  o->parts = strip ? AMBULO_PICTURE_STRIP : curves ? AMBULO_PICTURE_CURVES : AMBULO_PICTURE_ALL;
  o->powers = ambulo__cli_flag(input, "powers");
  o->per_kg = ambulo__cli_flag(input, "per-kg");
  o->percent = ambulo__cli_flag(input, "percent");
  o->overwrite = ambulo__cli_flag(input, "force");
  o->reference = ambulo__cli_value(input, "reference");
  if (!ambulo__cli_flag(input, "bare") &&
      ambulo__cli_shipped_file("norms", d->norms, sizeof d->norms))
    o->norms = d->norms;
  return ambulo__cli_number(input, "width", 10.0, 2000.0, &o->millimetres) &&
                 ambulo__cli_number(input, "dpi", 10.0, 2400.0, &o->dots_per_inch)
             ? 0
             : 2;
}

/* a solution, or that of a result folder; to be freed, NULL: no memory */
static char *solution_of(const char *given) {
  struct stat there;
  size_t length = strlen(given), size = length + sizeof "/solution.yaml";
  int folder = stat(given, &there) == 0 && S_ISDIR(there.st_mode);
  char *path = malloc(size);
  if (path) ambulo__cli_format(path, size, "%s%s", given, folder ? "/solution.yaml" : "");
  return path;
}

static ambulo_status load(const ambulo__cli_input *input, drawing *d) {
  char *solution = solution_of(input->arguments[1]), found[4096];
  /* a name of a shipped file, of two arguments alone: one is a picture, whatever it is called */
  const char *file = input->arguments[0];
  if (ambulo__cli_find_file(file, found, sizeof found)) file = found;
  ambulo_status status = solution ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = ambulo__cli_load_problem(input, file, d->diagnostics, &d->problem);
  if (!status) d->x = calloc((size_t)ambulo_problem_variable_count(d->problem), sizeof *d->x);
  if (!status && !d->x) status = AMBULO_E_MEMORY;
  if (!status) status = ambulo_solution_load(solution, d->problem, NULL, d->diagnostics, d->x);
  free(solution);
  if (status) return status;
  ambulo_options options = ambulo_problem_options(d->problem);
  return ambulo_audit_point(d->problem, &options, d->x, NULL, d->diagnostics, &d->result);
}

static int run(const ambulo__cli_input *input) {
  drawing d = {.problem = NULL};
  int code = read_options(input, &d);
  if (code) return code;
  const char *output = ambulo__cli_value(input, "output");
  d.diagnostics = ambulo_diagnostics_create(NULL);
  ambulo_status status = AMBULO_OK;
  if (input->argument_count == 1) {
    status = ambulo_picture_convert(input->arguments[0], output, &d.options, NULL, d.diagnostics);
  } else {
    status = load(input, &d);
    if (!status)
      status = ambulo_picture_write(d.problem, d.result, output, &d.options, NULL, d.diagnostics);
  }
  code = ambulo__cli_diagnostics(d.diagnostics, status, input->arguments[0]);
  if (!code) printf("written to %s\n", output);
  ambulo_result_free(d.result);
  free(d.x);
  ambulo_problem_free(d.problem);
  ambulo_diagnostics_free(d.diagnostics);
  return code;
}

static const ambulo__cli_option options[] = {
    {"output", 'o', "FILE", "the picture: FILE.pdf, FILE.png or FILE.svg"},
    {"strip", 0, NULL, "only the figures and contacts"},
    {"curves", 0, NULL, "only the curves"},
    {"powers", 0, NULL, "add a third row of curves: powers"},
    {"per-kg", 0, NULL, "torques in N m/kg, powers in W/kg, ground reaction in N/kg"},
    {"percent", 0, NULL, "curves over % of the cycle of each foot, from its own strike"},
    {"reference", 0, "FILE", "curves (CSV) behind those of a walk, instead of models/norms"},
    {"bare", 0, NULL, "without curves of people"},
    {"width", 0, "MM", "width on paper (default: 317.5)"},
    {"dpi", 0, "N", "dots per inch of PNG (default: 300)"},
    {"set", 0, "path=value", "replace a value of the problem file; may be repeated"},
    {"force", 0, NULL, "overwrite an existing file"},
};

const ambulo__cli_command ambulo__cli_draw = {
    .name = "draw",
    .arguments = "DIR|PICTURE.svg | PROBLEM.yaml DIR|SOLUTION.yaml",
    .summary = "draw a motion and its curves as PDF, PNG or SVG",
    .description =
        "With a result folder alone, converts its gait.svg to PDF or PNG; any other SVG likewise.\n"
        "With a problem and its result folder, draws the motion again from the solution, with the\n"
        "parts, units and reference curves that the options ask for. PDF and PNG need "
        "rsvg-convert\n"
        "(librsvg) on PATH. See docs/guide-page.md.",
    .example = "ambulo solve models/walk_normal.yaml -o on_paper\n"
               "ambulo draw on_paper -o walk.pdf\n"
               "ambulo draw models/walk_normal.yaml on_paper --curves --powers --per-kg --percent "
               "--width 180 "
               "-o curves.pdf",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum = 1,
    .maximum = 2,
    .words = "ambulo models --names problem",
    .run = run,
};
