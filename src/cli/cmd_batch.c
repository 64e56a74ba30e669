/* cli/cmd_batch.c - ambulo batch: many cases, on all processors, resumable. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/batch_dry_run.h"
#include "cli/commands.h"
#include "cli/format.h"
#include "cli/front_words.h"
#include "cli/output.h"
#include "cli/own_program.h"
#include "cli/stop_signals.h"

enum { MOST_WORKERS = 1024, MOST_SHARDS = 1000000, LINE = 240 };

typedef struct view {
  int terminal, quiet, told;
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
                     p->done, p->cases, p->failed, p->running, rate, left, worst);
  fprintf(stderr, "%s%.*s%s", begin, room, line, end);
  fflush(stderr);
}

static int show(void *user, const ambulo_batch_progress *p) {
  view *v = user;
  if (!v->quiet && v->terminal) {
    print_line(p, ambulo__cli_line_room(), "\r", "\033[K");
  } else if (!v->quiet && p->done != v->line_done && p->seconds >= v->line_at + 5.0) {
    print_line(p, LINE, "", "\n");
    v->line_at = p->seconds;
    v->line_done = p->done;
  }
  int seen = ambulo__cli_stops();
  if (seen == 1 && v->told == 0 && !v->quiet) {
    v->told = 1;
    fprintf(stderr, "%sfinishing %d running cases; once more to stop now\n",
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

/* the table of a front, and what became of it */
static int collect_front(const char *directory, int quiet) {
  ambulo_batch_census census;
  memset(&census, 0, sizeof census);
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_batch_collect(directory, NULL, diagnostics, &census);
  int code = ambulo__cli_diagnostics(diagnostics, status, directory);
  ambulo_diagnostics_free(diagnostics);
  if (!code && !quiet) ambulo__cli_print_front(&census.front);
  return code;
}

static int run_sweep(const ambulo__cli_input *input, const ambulo_sweep *sweep,
                     ambulo_batch_options *o, ambulo_diagnostics *diagnostics) {
  const char *directory = ambulo__cli_value(input, "output");
  view v = {isatty(STDERR_FILENO), ambulo__cli_flag(input, "quiet"), 0, 0.0, 0};
  o->progress = show;
  o->user = &v;
  ambulo__cli_catch_stops();
  ambulo_batch_progress end;
  memset(&end, 0, sizeof end);
  ambulo_status status = ambulo_batch_run(sweep, directory, o, NULL, diagnostics, &end);
  if (v.terminal && !v.quiet) fprintf(stderr, "\r\033[K");
  int code = ambulo__cli_diagnostics(diagnostics, status, directory);
  if (end.cases > 0 && !v.quiet)
    printf("%d of %d cases done (%d before), %d without a valid solution, %.1f s\n", end.done,
           end.cases, end.resumed, end.failed, end.seconds);
  if (code) return code;
  if (ambulo_sweep_front_points(sweep) > 0 && end.done > 0)
    code = collect_front(directory, v.quiet);
  if (code) return code;
  if (ambulo__cli_stops() > 0 && end.done < end.cases) return 128 + ambulo__cli_stop_signal();
  return end.failed > 0 || end.done < end.cases ? 1 : 0;
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
  printf("cases    %d\ndone     %d\nfailed   %d\nmissing  %d\nstale    %d\ncorrupt  %d\n", c.cases,
         c.done, c.failed, c.missing, c.stale, c.corrupt);
  if (c.done > 0) printf("seconds  %.2f a case\n", c.seconds / c.done);
  printf("running  %s\n", c.holder[0] ? c.holder : "no");
  if (!verify) return 0;
  if (c.corrupt > 0) return ambulo_status_exit_code(AMBULO_E_IO);
  return c.missing + c.stale > 0 ? 1 : 0;
}

static int run(const ambulo__cli_input *input) {
  const char *folder = ambulo__cli_value(input, "status");
  const char *verified = ambulo__cli_value(input, "verify");
  if (folder && verified)
    return ambulo__cli_usage_error("batch", NULL, "--status and --verify; expected one of them");
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
    code = ambulo__cli_usage_error("batch", "its points follow from each other",
                                   "--shard with a front; expected one run with -j N");
  } else {
    if (dry) (void)ambulo__cli_diagnostics(diagnostics, status, input->arguments[0]);
    code = dry ? ambulo__cli_dry_run(sweep, directory, o.workers)
               : run_sweep(input, sweep, &o, diagnostics);
  }
  ambulo_sweep_free(sweep);
  ambulo_diagnostics_free(diagnostics);
  return code;
}

static const ambulo__cli_option options[] = {
    {"output", 'o', "DIR", "batch folder; one that exists is resumed"},
    {"jobs", 'j', "N", "processes at once (default: usable processors, as memory allows)"},
    {"shard", 0, "i/k", "only the i-th of k parts, for the tasks of a cluster"},
    {"case-time", 0, "S", "kill a case after S seconds"},
    {"case-memory", 0, "MB", "address space of a case"},
    {"grace", 0, "S", "what running cases get after Ctrl-C (default: 30)"},
    {"force", 0, NULL, "inputs changed: compute the cases that differ, keep the others"},
    {"dry-run", 0, NULL, "print the case list, and the time and disk it will take"},
    {"status", 0, "DIR", "print the state of a batch folder, running or not, by its records"},
    {"verify", 0, "DIR",
     "the same by reading every file and comparing it with its checksum; names\n"
     "what is damaged. Exit code 0: all is finished and intact; 1: some cases are\n"
     "missing or stale; 4: some are damaged, which the same batch computes again"},
    {"quiet", 'q', NULL, "no progress, no summary"},
};

const ambulo__cli_command ambulo__cli_batch = {
    .name = "batch",
    .arguments = "SWEEP.yaml",
    .summary = "solve the cases of a sweep, many at a time",
    .description =
        "Solves every case of the sweep in a process of its own and keeps results and records in\n"
        "the folder. What is finished stays: the same command goes on where it was stopped or\n"
        "killed. Ctrl-C finishes the running cases, a second one stops at once. Exit code 0: all\n"
        "cases solved; 1: some have no valid solution; 3: the inputs are not those the folder\n"
        "was filled from; 4: the folder is locked or cannot be written.",
    .example = "ambulo batch models/sweep_walk.yaml -o walks -j 4\nambulo collect walks",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum = 0,
    .maximum = 1,
    .files = 1,
    .words = "ambulo models --names sweep",
    .run = run,
};
