/* cli/cmd_collect.c - ambulo collect: one table of a batch folder. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/batch_dry_run.h"
#include "cli/commands.h"
#include "cli/front_words.h"
#include "cli/output.h"

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
  struct stat info;
  return stat(directory, &info) == 0 && S_ISDIR(info.st_mode) && !ambulo__cli_is_batch(directory);
}

static int run(const ambulo__cli_input *input) {
  const char *directory = input->arguments[0];
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
    ambulo__cli_print_front(&census.front);
    code = print_census(directory, &census);
  }
  int failed = ambulo__cli_diagnostics(diagnostics, status, directory);
  ambulo_diagnostics_free(diagnostics);
  return failed ? failed : code;
}

static const char *const former[] = {
    "plot", "'ambulo report DIR' draws any columns of the table, and fronts; so does Python",
    "where", "a table is always whole; the page of 'ambulo report DIR' filters it", NULL};

const ambulo__cli_command ambulo__cli_collect = {
    .name = "collect",
    .arguments = "DIR",
    .summary = "write the table of a batch",
    .description =
        "Writes DIR/results.csv and DIR/results.jsonl: one line per case, sorted by id, with the\n"
        "axes and the outputs the sweep file asks for. The same results give the same bytes,\n"
        "however they were computed. Every file is compared with its checksum. Exit code 0: every\n"
        "case is finished; 1: some are missing, or stale (of other inputs); 4: some are corrupt\n"
        "(damaged since, or cannot be read). The table is written all the same and says which.",
    .example = "ambulo collect walks",
    .former = former,
    .minimum = 1,
    .maximum = 1,
    .run = run,
};
