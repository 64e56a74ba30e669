/* cli/batch_dry_run.c - see batch_dry_run.h. */
#include "cli/format.h"
#include "cli/batch_dry_run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/output.h"

static const char *const files[] = {"summary.json",  "motion.csv", "motion.sto",
                                    "solution.yaml", "gait.svg",   "scene.json"};
enum { FILES = sizeof files / sizeof files[0], RECORD_BYTES = 4096 };

/* bytes on disk of a result folder, which is removed */
static double weigh_and_remove(const char *folder) {
  char path[600];
  struct stat entry;
  double bytes = RECORD_BYTES;
  for (int i = 0; i < FILES; i++) {
    ambulo__cli_format(path, sizeof path, "%s/%s", folder, files[i]);
    if (stat(path, &entry) == 0) bytes += 512.0 * (double)entry.st_blocks;
    (void)unlink(path);
  }
  (void)rmdir(folder);
  return bytes;
}

/* solves the first case; AMBULO_OK: *seconds and *bytes are set */
static ambulo_status time_first_case(const ambulo_sweep *sweep, ambulo_diagnostics *diagnostics,
                                     double *seconds, double *bytes) {
  ambulo_case one;
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  const char *parent = getenv("TMPDIR");
  char folder[512];
  ambulo__cli_format(folder, sizeof folder, "%.400s/ambulo-dry-XXXXXX",
                     parent && *parent ? parent : "/tmp");
  ambulo_status status = ambulo_sweep_case(sweep, 0, &one);
  if (!status)
    status = ambulo_problem_load(ambulo_sweep_base(sweep), one.overrides, one.override_count, NULL,
                                 diagnostics, &problem);
  if (!status) {
    ambulo_options options = ambulo_problem_options(problem);
    status = ambulo_solve(problem, &options, NULL, NULL, diagnostics, &result);
  }
  if (!status && !mkdtemp(folder)) status = AMBULO_E_IO;
  if (!status) {
    ambulo_report_options options = ambulo_report_options_default();
    status = ambulo_report_write(problem, result, folder, &options, NULL, diagnostics);
    *bytes = weigh_and_remove(folder);
    *seconds = ambulo_result_timing(result)->total + 0.05;
  }
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  return status;
}

static void print_cases(const ambulo_sweep *sweep) {
  ambulo_case one, before;
  for (int k = 0; k < ambulo_sweep_case_count(sweep); k++) {
    if (ambulo_sweep_case(sweep, k, &one)) continue;
    printf("%s  %s ", one.id, one.name);
    for (int i = 0; i < one.override_count; i++) printf(" %s", one.overrides[i]);
    if (one.previous >= 0 && !ambulo_sweep_case(sweep, one.previous, &before))
      printf("  continues %s", before.id);
    printf("\n");
  }
}

int ambulo__cli_is_batch(const char *directory) {
  char path[4200];
  struct stat entry;
  if (!directory) return 0;
  ambulo__cli_format(path, sizeof path, "%.4096s/batch.json", directory);
  return stat(path, &entry) == 0;
}

int ambulo__cli_dry_run(const ambulo_sweep *sweep, const char *directory, int workers) {
  double seconds = 0.0, bytes = 0.0;
  ambulo_batch_census census;
  memset(&census, 0, sizeof census);
  int cases = ambulo_sweep_case_count(sweep), left = cases;
  const char *source = "the first case";
  print_cases(sweep);
  if (ambulo_sweep_front_points(sweep) > cases) {
    cases = left = ambulo_sweep_front_points(sweep);
    printf("and at least %d between them, whose weights follow from these\n",
           cases - ambulo_sweep_case_count(sweep));
  }
  ambulo_diagnostics *trial = ambulo_diagnostics_create(NULL);
  ambulo_status timed = time_first_case(sweep, trial, &seconds, &bytes);
  int code = timed ? ambulo__cli_diagnostics(trial, timed, ambulo_sweep_base(sweep)) : 0;
  ambulo_diagnostics_free(trial);
  if (code == ambulo_status_exit_code(AMBULO_E_MEMORY)) return code;
  if (ambulo__cli_is_batch(directory)) {
    ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
    ambulo_status status = ambulo_batch_status(directory, NULL, diagnostics, &census);
    code = ambulo__cli_diagnostics(diagnostics, status, directory);
    ambulo_diagnostics_free(diagnostics);
    if (code) return code;
  }
  if (census.done > 0) {
    seconds = census.seconds / census.done;
    left = cases > census.done ? cases - census.done : 0;
    source = "the finished cases";
  }
  int processes = ambulo_batch_workers(workers, 0);
  printf("%d cases, %d to do", cases, left);
  if (timed)
    printf("; no estimate, since the first case could not be solved");
  else
    printf("; about %.0f s with %d processes and %.1f MB, judged by %s", seconds * left / processes,
           processes, bytes * cases / 1e6, source);
  printf("\n");
  return 0;
}
