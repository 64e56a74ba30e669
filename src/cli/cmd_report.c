/* cli/cmd_report.c - ambulo report: results as a page to watch. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/body.h"
#include "cli/output.h"
#include "cli/shipped.h"

/* --motion with the body that it moves; returns 0, or the exit code after a usage error */
static int read_motion(const ambulo__cli_input *input, ambulo_page_options *options) {
  const char *body = ambulo__cli_value(input, "body");
  options->motion = ambulo__cli_value(input, "motion");
  if (options->motion && !body)
    return ambulo__cli_usage_error("report", NULL,
                                   "--motion needs --body, the model that it moves");
  if (!options->motion && body)
    return ambulo__cli_usage_error("report", NULL, "--body needs --motion");
  if (!ambulo__cli_number(input, "from", -1e9, 1e9, &options->from) ||
      !ambulo__cli_number(input, "to", -1e9, 1e9, &options->to))
    return 2;
  if (options->from < options->to) return 0;
  return ambulo__cli_usage_error("report", NULL, "--from is not before --to");
}

/* DIR/report.html unless -o names another; to be freed, NULL: no memory */
static char *output_of(const ambulo__cli_input *input) {
  const char *given = ambulo__cli_value(input, "output"), *directory = input->arguments[0];
  size_t size = strlen(given ? given : directory) + sizeof "/report.html";
  char *path = malloc(size);
  if (!path) return NULL;
  size_t length = strlen(directory);
  while (length > 1 && directory[length - 1] == '/') length--;
  if (given)
    ambulo__cli_format(path, size, "%s", given);
  else
    ambulo__cli_format(path, size, "%.*s/report.html", (int)length, directory);
  return path;
}

static int run(const ambulo__cli_input *input) {
  enum { PATH = 4096 };
  char shipped[PATH];
  const char *named = ambulo__cli_value(input, "body");
  ambulo_page_options options = ambulo_page_options_default();
  int code = read_motion(input, &options);
  if (code) return code;
  if (!ambulo__cli_number(input, "size", 0.0, 1e6, &options.megabytes)) return 2;
  options.overwrite = ambulo__cli_flag(input, "force");
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo__cli_body body = {.model = NULL};
  char *output = output_of(input);
  ambulo_status status = output ? AMBULO_OK : AMBULO_E_MEMORY;
  if (named && ambulo__cli_find_file(named, shipped, sizeof shipped)) named = shipped;
  if (!status && options.motion)
    code = ambulo__cli_body_load(input, named, diagnostics, &body, &status);
  if (!code) {
    options.body = body.model;
    options.ground_height = body.ground_height;
    ambulo_batch_census census;
    memset(&census, 0, sizeof census);
    int study =
        input->argument_count == 1 && !options.motion && ambulo__cli_is_batch(input->arguments[0]);
    if (!status)
      status = study ? ambulo_batch_page(input->arguments[0], output, &options, NULL, diagnostics,
                                         &census)
                     : ambulo_page_write(input->arguments, input->argument_count, output, &options,
                                         NULL, diagnostics);
    code = ambulo__cli_diagnostics(diagnostics, status, input->arguments[0]);
    if (!code) printf("written to %s\n", output);
    if (!code) code = ambulo__cli_census_code(&census);
  }
  free(output);
  ambulo__cli_body_free(&body);
  ambulo_diagnostics_free(diagnostics);
  return code;
}

static const ambulo__cli_option options_table[] = {
    {"output", 'o', "FILE", "the page (default: DIR/report.html)"},
    {"force", 0, NULL, "overwrite a file that is not a page by ambulo"},
    {"size", 0, "MB", "maximal size of the page of a batch (default: 3)"},
    {"motion", 0, "FILE", "show a measured motion (CSV, STO, MOT) as a ghost"},
    {"body", 0, "FILE", "the model or problem that this motion belongs to"},
    {"from", 0, "S", "first time of the motion to show (default: its start)"},
    {"to", 0, "S", "last time of the motion to show (default: its end)"},
    AMBULO__CLI_BODY_OPTIONS,
};

const ambulo__cli_command ambulo__cli_report = {
    .name = "report",
    .arguments = "DIR [DIR...]",
    .summary = "make an HTML page of a result or a batch",
    .description =
        "Writes one HTML file that opens in a browser without a network: the body in motion, to\n"
        "turn, play and scrub; curves beside those of people; verdict, audit, sensitivities and\n"
        "objective in words. Further result folders appear as ghosts beside the first. The page "
        "of\n"
        "a batch folder has a table of its cases, a plot of any two columns, and its front; a "
        "click\n"
        "shows the motion of a case; its exit code is that of 'ambulo collect'. See\n"
        "docs/guide-page.md.",
    .example = "ambulo report walk\n"
               "ambulo report walks",
    .options = options_table,
    .option_count = sizeof options_table / sizeof options_table[0],
    .minimum = 1,
    .maximum = -1,
    .run = run,
};
