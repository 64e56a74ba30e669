/* cli/cmd_batch.c - ambulo batch: many cases, on all processors, resumable; ambulo collect: their
 * table. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/body.h"
#include "cli/output.h"
#include "cli/program.h"

/* --------------------------------------------------------------------- progress */

enum { MOST_WORKERS = 1024, MOST_SHARDS = 1000000, LINE = 240 };

typedef struct view {
  int terminal, quiet, warned;
  int refused;    /* 1: the first case without a result is named */
  double line_at; /* s: when the last plain line was printed */
  int line_done;
} view;

static void print_line(const ambulo_batch_progress *p, int room, const char *begin,
                       const char *end) {
  char left[48] = "", worst[96] = "", line[LINE];
  double rate = p->seconds > 0.0 ? 60.0 * (p->done - p->resumed) / p->seconds : 0.0;
  if (p->seconds_left >= 0.0)
    ambulo__cli_format(left, sizeof left, ", %.0f s left", p->seconds_left);
  if (p->worst)
    ambulo__cli_format(worst, sizeof worst, ", worst violation %.1e (%.40s)", p->worst_violation,
                       p->worst);
  ambulo__cli_format(line, sizeof line, "%d of %d done, %d failed, %d running, %.1f cases/min%s%s",
                     p->done - p->no_result, p->cases, p->failed, p->running, rate, left, worst);
  fprintf(stderr, "%s%.*s%s", begin, room, line, end);
  fflush(stderr);
}

/* at once, and even with --quiet: most likely the others have the same fault */
static void print_refusal(view *v, const ambulo_batch_progress *p) {
  if (!p->refusal[0] || v->refused) return;
  v->refused = 1;
  fprintf(stderr, "%s%s\n", v->terminal && !v->quiet ? "\r\033[K" : "", p->refusal);
}

static int show(void *user, const ambulo_batch_progress *p) {
  view *v = user;
  print_refusal(v, p);
  if (!v->quiet && v->terminal) {
    print_line(p, ambulo__cli_line_room(), "\r", "\033[K");
  } else if (!v->quiet && p->done != v->line_done && p->seconds >= v->line_at + 5.0) {
    print_line(p, LINE, "", "\n");
    v->line_at = p->seconds;
    v->line_done = p->done;
  }
  int seen = ambulo__cli_stops();
  if (seen == 1 && !v->warned && !v->quiet) {
    v->warned = 1;
    fprintf(stderr, "%sfinishing %d running cases; press Ctrl-C again to stop now\n",
            v->terminal ? "\r\033[K" : "", p->running);
  }
  return seen > 2 ? 2 : seen;
}

static int read_shard(const ambulo__cli_input *input, ambulo_batch_options *o) {
  const char *text = ambulo__cli_value(input, "shard");
  if (!text) return 1;
  char *end = NULL;
  errno = 0;
  long shard = strtol(text, &end, 10), shards = 0;
  int good = end != text && *end == '/' && end[1] >= '0' && end[1] <= '9';
  if (good) shards = strtol(end + 1, &end, 10);
  if (!good || *end || errno || shards < 1 || shards > MOST_SHARDS || shard < 1 || shard > shards) {
    ambulo__cli_usage_error("batch", NULL, "--shard is '%s'; expected i/k with 1 <= i <= k <= %d",
                            text, MOST_SHARDS);
    return 0;
  }
  o->shard = (int)shard;
  o->shards = (int)shards;
  return 1;
}

static int read_options(const ambulo__cli_input *input, ambulo_batch_options *o) {
  *o = ambulo_batch_options_default();
  o->force = ambulo__cli_flag(input, "force");
  o->program = ambulo__cli_worker_program();
  return ambulo__cli_integer(input, "jobs", 1, MOST_WORKERS, &o->workers) &&
         ambulo__cli_limit(input, "case-time", &o->case_seconds) &&
         ambulo__cli_integer(input, "case-memory", 0, 100000000, &o->case_megabytes) &&
         ambulo__cli_number(input, "grace", 0.0, 1e9, &o->grace) && read_shard(input, o);
}

/* nothing where the folder has no front */
static void print_front(const ambulo_front_census *f) {
  if (f->terms == 0) return;
  printf("front of %d points", f->points);
  if (f->points > 1 && f->mean_gap > 0.0)
    printf(", largest gap %.2f mean gaps", f->largest_gap / f->mean_gap);
  if (f->refused > 0)
    printf(", %d gap%s could not be closed", f->refused, f->refused > 1 ? "s" : "");
  if (f->left_out > 0) printf(", %d dominated points left out", f->left_out);
  printf("\n");
}

/* the table of a front, and what became of it */
static int collect_front(const char *directory, int quiet) {
  ambulo_batch_census census;
  memset(&census, 0, sizeof census);
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_batch_collect(directory, NULL, diagnostics, &census);
  int code = ambulo__cli_diagnostics(diagnostics, status, directory);
  ambulo_diagnostics_free(diagnostics);
  if (!code && !quiet) print_front(&census.front);
  return code || census.corrupt == 0 ? code : ambulo__cli_census_code(&census);
}

/* "17 of 18 cases done, 1 without a result (0 before): 15 optimal, 2 infeasible, 1 invalid, 7.2 s"
 */
static void print_end(const ambulo_batch_progress *p) {
  printf("%d of %d cases done", p->done - p->no_result, p->cases);
  if (p->no_result > 0) printf(", %d without a result", p->no_result);
  printf(" (%d before)", p->resumed);
  for (int i = 0; i < AMBULO_BATCH_STATES && p->tally[i].cases > 0; i++)
    printf("%s %d %s", i ? "," : ":", p->tally[i].cases, p->tally[i].state);
  printf(", %.1f s\n", p->seconds);
}

static int run_sweep(const ambulo__cli_input *input, const ambulo_sweep *sweep,
                     ambulo_batch_options *o, ambulo_diagnostics *diagnostics) {
  const char *directory = ambulo__cli_value(input, "output");
  view v = {.terminal = isatty(STDERR_FILENO), .quiet = ambulo__cli_flag(input, "quiet")};
  o->progress = show;
  o->user = &v;
  ambulo__cli_catch_stops(0);
  ambulo_batch_progress end;
  memset(&end, 0, sizeof end);
  ambulo_status status = ambulo_batch_run(sweep, directory, o, NULL, diagnostics, &end);
  if (v.terminal && !v.quiet) fprintf(stderr, "\r\033[K");
  int code = ambulo__cli_diagnostics(diagnostics, status, directory);
  print_refusal(&v, &end);
  if (end.cases > 0 && !v.quiet) print_end(&end);
  if (code) return code;
  if (ambulo_sweep_front_points(sweep) > 0 && end.done > 0)
    code = collect_front(directory, v.quiet);
  if (code) return code;
  if (ambulo__cli_stops() > 0 && end.done < end.cases) return 128 + ambulo__cli_stop_signal();
  return end.failed > 0 || end.done < end.cases ? 1 : 0;
}

/* ----------------------------------------------------------------------- folders */

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

/* the case list, and how long it takes by the finished cases in `directory` (may be NULL) */
static int dry_run(const ambulo_sweep *sweep, const char *directory, int workers) {
  ambulo_batch_census census;
  memset(&census, 0, sizeof census);
  int cases = ambulo_sweep_case_count(sweep), code = 0;
  print_cases(sweep);
  if (ambulo_sweep_front_points(sweep) > cases) {
    printf("and at least %d between them, whose weights depend on these\n",
           ambulo_sweep_front_points(sweep) - cases);
    cases = ambulo_sweep_front_points(sweep);
  }
  if (directory && ambulo__cli_is_batch(directory)) {
    ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
    ambulo_status status = ambulo_batch_status(directory, NULL, diagnostics, &census);
    code = ambulo__cli_diagnostics(diagnostics, status, directory);
    ambulo_diagnostics_free(diagnostics);
  }
  if (code) return code;
  int left = cases > census.done ? cases - census.done : 0,
      processes = ambulo_batch_workers(workers, 0);
  printf("%d cases, %d to do", cases, left);
  if (census.done > 0)
    printf("; about %.0f s with %d processes", census.seconds / census.done * left / processes,
           processes);
  printf("\n");
  return 0;
}

static void print_damage(void *user, const ambulo_batch_damage *damage) {
  (void)user;
  printf("damaged  %s: %s (case '%s')\n", damage->file, damage->what, damage->name);
}

static int print_status(const char *directory, int verify) {
  ambulo_batch_census c;
  memset(&c, 0, sizeof c);
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo_status status =
      verify ? ambulo_batch_verify(directory, print_damage, NULL, NULL, diagnostics, &c)
             : ambulo_batch_status(directory, NULL, diagnostics, &c);
  int code = ambulo__cli_diagnostics(diagnostics, status, directory);
  ambulo_diagnostics_free(diagnostics);
  if (code) return code;
  printf("cases    %d\ndone     %d\nfailed   %d\nunsolved %d\n", c.cases, c.done - c.no_result,
         c.failed - c.no_result, c.no_result);
  printf("missing  %d\nstale    %d\ncorrupt  %d\n", c.missing, c.stale, c.corrupt);
  if (c.done > 0) printf("seconds  %.2f per case\n", c.seconds / c.done);
  printf("running  %s\n", c.holder[0] ? c.holder : "no");
  return verify || c.corrupt > 0 ? ambulo__cli_census_code(&c) : 0;
}

static int run(const ambulo__cli_input *input) {
  const char *folder = ambulo__cli_value(input, "status");
  const char *verified = ambulo__cli_value(input, "verify");
  if (folder && verified)
    return ambulo__cli_usage_error("batch", NULL,
                                   "--status and --verify are given; expected one of them");
  if (folder || verified) return print_status(folder ? folder : verified, verified != NULL);
  int dry = ambulo__cli_flag(input, "dry-run");
  const char *directory = ambulo__cli_value(input, "output");
  if (input->argument_count == 0)
    return ambulo__cli_usage_error("batch", NULL, "missing argument; expected SWEEP.yaml");
  if (!dry && !directory)
    return ambulo__cli_usage_error("batch", NULL, "no folder given; expected -o DIR");
  ambulo_batch_options o;
  if (!read_options(input, &o)) return 2;
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo_sweep *sweep = NULL;
  ambulo_status status = ambulo_sweep_load(input->arguments[0], NULL, diagnostics, &sweep);
  int code;
  if (status) {
    code = ambulo__cli_diagnostics(diagnostics, status, input->arguments[0]);
  } else if (ambulo_sweep_front_points(sweep) > 0 && o.shards > 1) {
    code = ambulo__cli_usage_error("batch", "its points depend on each other",
                                   "--shard cannot divide a front; expected one run with -j N");
  } else {
    if (dry) (void)ambulo__cli_diagnostics(diagnostics, status, input->arguments[0]);
    code = dry ? dry_run(sweep, directory, o.workers) : run_sweep(input, sweep, &o, diagnostics);
  }
  ambulo_sweep_free(sweep);
  ambulo_diagnostics_free(diagnostics);
  return code;
}

static const ambulo__cli_option options[] = {
    {"output", 'o', "DIR", "batch folder; an existing one is resumed"},
    {"jobs", 'j', "N", "number of processes (default: usable processors, as memory allows)"},
    {"shard", 0, "i/k", "only part i of k, for the tasks of a cluster"},
    {"case-time", 0, "S", "kill a case after S seconds"},
    {"case-memory", 0, "MB", "limit the address space of a case"},
    {"grace", 0, "S", "time that running cases have after Ctrl-C (default: 30)"},
    {"force", 0, NULL, "if inputs changed, compute the cases that differ and keep the others"},
    {"dry-run", 0, NULL, "print the list of cases, solve nothing"},
    {"status", 0, "DIR", "print the state of a batch folder, from its records"},
    {"verify", 0, "DIR",
     "the same from all files and their checksums; names damaged files.\nExit code 0: all cases "
     "are finished and intact; 1: some are missing or\nstale; 4: some are damaged, and the same "
     "batch computes them again"},
    {"quiet", 'q', NULL, "no progress, no summary"},
};

const ambulo__cli_command ambulo__cli_batch = {
    .name = "batch",
    .arguments = "SWEEP.yaml",
    .summary = "solve all cases of a sweep in parallel",
    .description =
        "Solves every case of the sweep in a process of its own and keeps results and records in\n"
        "the folder. The same command resumes after an interruption. Ctrl-C finishes the running\n"
        "cases; a second one stops at once. The first case that ends without a result is named at\n"
        "once, with its error. Exit code 0: all cases solved; 1: some have no valid solution, or\n"
        "no result; 3: the folder was filled from other inputs; 4: the folder is locked or cannot "
        "be\n"
        "written.",
    .example = "ambulo batch models/sweep_walk.yaml -o walks -j 4\nambulo collect walks",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum = 0,
    .maximum = 1,
    .files = 1,
    .words = "ambulo models --names sweep",
    .run = run,
};

/* ----------------------------------------------------------------------- collect */

/* returns the exit code */
static int print_census(const char *directory, const ambulo_batch_census *c) {
  printf("%d cases: %d done (%d without a valid solution), ", c->cases, c->done - c->no_result,
         c->failed - c->no_result);
  if (c->no_result > 0) printf("%d without a result, ", c->no_result);
  printf("%d missing, %d stale, %d corrupt\n", c->missing, c->stale, c->corrupt);
  int incomplete = c->missing + c->stale + c->corrupt;
  if (c->holder[0]) {
    printf("a batch is running in it: %s\n", c->holder);
  } else if (incomplete) {
    printf("run 'ambulo batch' with -o %s again to complete it\n", directory);
  }
  return ambulo__cli_census_code(c);
}

/* a folder, but none that a batch has filled: most likely a result folder */
static int is_no_batch(const char *directory) {
  struct stat info;
  return stat(directory, &info) == 0 && S_ISDIR(info.st_mode) && !ambulo__cli_is_batch(directory);
}

static int collect(const ambulo__cli_input *input) {
  const char *directory = input->arguments[0];
  if (is_no_batch(directory)) {
    ambulo__cli_error("E_IO", "'ambulo batch SWEEP.yaml -o DIR' creates one",
                      "%s is not a batch folder (it has no batch.json)", directory);
    return ambulo_status_exit_code(AMBULO_E_IO);
  }
  ambulo_batch_census census;
  memset(&census, 0, sizeof census);
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_batch_collect(directory, NULL, diagnostics, &census);
  int code = 0;
  if (!status) {
    printf("written to %s/results.csv and %s/results.jsonl\n", directory, directory);
    print_front(&census.front);
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
        "Writes DIR/results.csv and DIR/results.jsonl: one line for each case, sorted by id, with\n"
        "the axes and the outputs that the sweep asks for. The same results give the same bytes.\n"
        "Every file is compared with its checksum. Exit code 0: every case is finished; 1: some "
        "are\n"
        "missing or stale (of other inputs); 4: some are corrupt (damaged or unreadable). The "
        "table\n"
        "is written in any case and marks them.",
    .example = "ambulo collect walks",
    .former = former,
    .minimum = 1,
    .maximum = 1,
    .run = collect,
};
