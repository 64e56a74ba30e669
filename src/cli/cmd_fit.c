/* cli/cmd_fit.c - ambulo fit: numbers of a problem by which its motions come closest to people's.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/command.h"
#include "cli/output.h"
#include "cli/program.h"

enum { MOST_WORKERS = 1024, LINE = 240 };

typedef struct view {
  int terminal, quiet, warned;
} view;

/* a distance, or a dash */
static const char *distance_text(double value, char text[24]) {
  if (isnan(value))
    ambulo__cli_format(text, 24, "-");
  else
    ambulo__cli_format(text, 24, "%.4g", value);
  return text;
}

static int show(void *user, const ambulo_fit_progress *p) {
  view *v = user;
  char line[LINE], first[24], best[24], left[48] = "";
  if (p->seconds_left >= 0.0)
    ambulo__cli_format(left, sizeof left, ", about %.0f s left", p->seconds_left);
  if (!v->quiet && v->terminal) {
    ambulo__cli_format(
        line, sizeof line,
        "iteration %d of %d, distance %s (from %s), solve %d of %d here, %d of about "
        "%d%s",
        p->iteration, p->iterations, distance_text(p->best, best), distance_text(p->first, first),
        p->round, p->rounds, p->solves, p->expected, left);
    fprintf(stderr, "\r%.*s\033[K", ambulo__cli_line_room(), line);
    fflush(stderr);
  }
  int seen = ambulo__cli_stops();
  if (seen > 0 && !v->warned && !v->quiet) {
    v->warned = 1;
    fprintf(stderr, "%sfinishing the running solves; press Ctrl-C again to stop now\n",
            v->terminal ? "\r\033[K" : "");
  }
  return seen > 2 ? 2 : seen;
}

static int read_options(const ambulo__cli_input *input, ambulo_fit_options *o) {
  *o = ambulo_fit_options_default();
  o->force = ambulo__cli_flag(input, "force");
  o->program = ambulo__cli_worker_program();
  return ambulo__cli_integer(input, "jobs", 1, MOST_WORKERS, &o->workers) &&
         ambulo__cli_limit(input, "case-time", &o->case_seconds) &&
         ambulo__cli_integer(input, "case-memory", 0, 100000000, &o->case_megabytes) &&
         ambulo__cli_number(input, "grace", 0.0, 1e9, &o->grace);
}

static void print_end(const char *directory, const char *report, const ambulo_fit_progress *end,
                      ambulo_fit_ending ending) {
  if (report) fputs(report, stdout);
  printf("computed     %d solves here, %d before, %.1f s\n", end->solves - end->resumed,
         end->resumed, end->seconds);
  if (report) printf("written to   %s/fit.json, %s/fitted.yaml\n", directory, directory);
  if (ending == AMBULO_FIT_INTERRUPTED)
    printf("%s; the same command resumes\n",
           report ? "stopped: the best parameters so far were written"
                  : "stopped before the first solves ended: nothing was written");
}

static int run_fit(const ambulo__cli_input *input, const ambulo_fit *fit, ambulo_fit_options *o,
                   ambulo_diagnostics *diagnostics) {
  const char *directory = ambulo__cli_value(input, "output");
  view v = {isatty(STDERR_FILENO), ambulo__cli_flag(input, "quiet"), 0};
  ambulo_fit_progress end;
  char *report = NULL;
  memset(&end, 0, sizeof end);
  o->progress = show;
  o->user = &v;
  ambulo__cli_catch_stops(0);
  ambulo_status status = ambulo_fit_run(fit, directory, o, NULL, diagnostics, &end, &report);
  if (v.terminal && !v.quiet) fprintf(stderr, "\r\033[K");
  int code = ambulo__cli_diagnostics(diagnostics, status, directory);
  if (!code && !v.quiet) print_end(directory, report, &end, end.ending);
  ambulo_text_free(report, NULL);
  if (code) return code;
  if (end.ending == AMBULO_FIT_INTERRUPTED && ambulo__cli_stops() > 0)
    return 128 + ambulo__cli_stop_signal();
  return end.ending == AMBULO_FIT_STUCK ? 1 : 0;
}

static int describe(const ambulo_fit *fit, ambulo_diagnostics *diagnostics) {
  char *text = NULL;
  ambulo_status status = ambulo_fit_describe(fit, NULL, &text);
  int code = ambulo__cli_diagnostics(diagnostics, status, "fit");
  if (text) fputs(text, stdout);
  ambulo_text_free(text, NULL);
  return code;
}

static int run(const ambulo__cli_input *input) {
  int dry = ambulo__cli_flag(input, "dry-run");
  if (!dry && !ambulo__cli_value(input, "output"))
    return ambulo__cli_usage_error("fit", NULL, "no folder given; expected -o DIR");
  ambulo_fit_options o;
  if (!read_options(input, &o)) return 2;
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo_fit *fit = NULL;
  ambulo_status status = ambulo_fit_load(input->arguments[0], NULL, diagnostics, &fit);
  int code = status ? ambulo__cli_diagnostics(diagnostics, status, input->arguments[0])
             : dry  ? describe(fit, diagnostics)
                    : run_fit(input, fit, &o, diagnostics);
  ambulo_fit_free(fit);
  ambulo_diagnostics_free(diagnostics);
  return code;
}

static const ambulo__cli_option options[] = {
    {"output", 'o', "DIR", "folder of the fit; an existing one is resumed"},
    {"jobs", 'j', "N", "number of processes (default: usable processors, as memory allows)"},
    {"case-time", 0, "S", "kill a solve after S seconds (default: limits.seconds, 60)"},
    {"case-memory", 0, "MB", "limit the address space of a solve"},
    {"grace", 0, "S", "time that running solves have after Ctrl-C (default: 30)"},
    {"force", 0, NULL, "if inputs changed, continue and keep the solves that are the same"},
    {"dry-run", 0, NULL, "check the files and print how they were understood"},
    {"quiet", 'q', NULL, "no progress, no report"},
};

const ambulo__cli_command ambulo__cli_fit = {
    .name = "fit",
    .arguments = "FIT.yaml",
    .summary = "fit weights and other numbers to curves of people",
    .description =
        "Inverse optimal control: changes the parameters of the fit file until the predicted\n"
        "motions of all its conditions come as close as possible to their reference curves. Every\n"
        "solve runs in a process of its own and is kept in the folder, so that the same command\n"
        "resumes. Ctrl-C finishes the running solves and keeps the best parameters so far. Writes\n"
        "DIR/fit.json, the result, and DIR/fitted.yaml, the problem with the fitted numbers. Exit\n"
        "code 0: done; 1: every solve of a condition failed; 3: invalid input, or the folder was\n"
        "filled from other inputs; 130: interrupted.",
    .example =
        "ambulo fit fit_walk.yaml -o fitted -j 2\nambulo solve fitted/fitted.yaml -o fitted_walk",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum = 1,
    .maximum = 1,
    .files = 1,
    .words = "ambulo models --names fit",
    .run = run,
};
