/* cli/cmd_collect.c - ambulo collect: one table, and pictures, of a batch folder. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/commands.h"
#include "cli/format.h"
#include "cli/front_words.h"
#include "cli/output.h"

enum { MOST_CONDITIONS = 64 };

/* returns the exit code */
static int print_census(const char *directory, const ambulo_batch_census *c) {
  printf("%d cases: %d done (%d without a valid solution), %d missing, %d stale, %d corrupt\n",
         c->cases, c->done, c->failed, c->missing, c->stale, c->corrupt);
  int incomplete = c->missing + c->stale + c->corrupt;
  if (c->holder[0]) {
    printf("a batch runs in it: %s\n", c->holder);
  } else if (incomplete) {
    printf("run 'ambulo batch' with -o %s again to complete it\n", directory);
  }
  if (c->corrupt > 0) return ambulo_status_exit_code(AMBULO_E_IO);
  return incomplete ? 1 : 0;
}

/* a folder, but none that a batch has filled: most likely a result folder */
static int is_no_batch(const char *directory) {
  char path[4096];
  struct stat info;
  if (stat(directory, &info) || !S_ISDIR(info.st_mode)) return 0;
  ambulo__cli_format(path, sizeof path, "%s/batch.json", directory);
  return stat(path, &info) && errno == ENOENT;
}

static int run(const ambulo__cli_input *input) {
  const char *directory = input->arguments[0], *plot = ambulo__cli_value(input, "plot");
  const char *where[MOST_CONDITIONS];
  if (input->given_count > MOST_CONDITIONS)
    return ambulo__cli_usage_error("collect", NULL, "more than %d options", MOST_CONDITIONS);
  int conditions = ambulo__cli_values(input, "where", where);
  if (conditions > 0 && !plot)
    return ambulo__cli_usage_error("collect", "a table is always whole",
                                   "--where without --plot; expected X[,Y]:OUTPUT");
  if (is_no_batch(directory)) {
    ambulo__cli_error("E_IO", "'ambulo batch SWEEP.yaml -o DIR' fills one",
                      "%s: no batch folder (it has no batch.json)", directory);
    return ambulo_status_exit_code(AMBULO_E_IO);
  }
  ambulo_batch_census census;
  memset(&census, 0, sizeof census);
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_batch_collect(directory, NULL, diagnostics, &census);
  int code = 0;
  if (!status) {
    printf("written to %s/results.csv and %s/results.jsonl\n", directory, directory);
    ambulo__cli_print_front(directory, &census.front);
    code = print_census(directory, &census);
  }
  char *file = NULL;
  ambulo_plot_options drawing = ambulo_plot_options_default();
  drawing.where = where;
  drawing.where_count = conditions;
  if (!status && plot)
    status = ambulo_batch_plot(directory, plot, &drawing, NULL, diagnostics, &file);
  if (file) printf("drawn to %s\n", file);
  ambulo_text_free(file, NULL);
  int failed = ambulo__cli_diagnostics(diagnostics, status, directory);
  ambulo_diagnostics_free(diagnostics);
  return failed ? failed : code;
}

static const ambulo__cli_option options[] = {
    {"plot", 0, "X[,Y]:OUTPUT",
     "draw an output over one axis (curves) or two (a heat map), as SVG;\n"
     "every point names its case and leads to its gait.svg"},
    {"where", 0, "NAME<VALUE",
     "draw only the cases for which this holds (< <= > >= == !=; NAME is an\n"
     "axis, an output, name or state); may be repeated"},
};

const ambulo__cli_command ambulo__cli_collect = {
    .name = "collect",
    .arguments = "DIR",
    .summary = "write the table of a batch, and draw it",
    .description =
        "Writes DIR/results.csv and DIR/results.jsonl: one line per case, sorted by id, with the\n"
        "axes and the outputs the sweep file asks for. The same results give the same bytes,\n"
        "however they were computed. Every file is compared with its checksum. Exit code 0: every\n"
        "case is finished; 1: some are missing, or stale (of other inputs); 4: some are corrupt\n"
        "(damaged since, or cannot be read). The table is written all the same and says which.",
    .example = "ambulo collect walks --plot gait.speed:objective --where 'sex == male'",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum = 1,
    .maximum = 1,
    .run = run,
};
