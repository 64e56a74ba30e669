/* cli/cmd_solve.c - ambulo solve: one problem, one result folder.
 *
 * Order: output is checked before any work is done; the problem is read; it is solved with a
 * progress line on terminals; the result is written whatever the verdict, and marked. Until the
 * solve begins nothing is lost, and Ctrl-C and SIGTERM end the program. From then on they stop the
 * solver within a tenth of a second, in set-up and explanation too, and keep the best point; a
 * second one ends the program at once. Where the solver is deaf the watch ends it (watch.h). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/body.h"
#include "cli/output.h"
#include "cli/program.h"
#include "cli/shipped.h"
#include "cli/summary.h"
#include "cli/watch.h"

typedef struct job {
  const ambulo__cli_input *input;
  char *directory; /* where the result goes */
  ambulo_report_options report;
  ambulo_problem *problem; /* of the file; with free parameters, then that of their best values */
  ambulo_problem *coarser; /* of the file, when `problem` is that on a finer grid */
  ambulo_result *result;
  ambulo_sensitivity_list *sensitivities; /* NULL: not asked for */
  double *start;                          /* NULL: zero */
  ambulo_multipliers *multipliers;        /* of the start; NULL: none */
  ambulo_muscles *muscles;                /* report.muscles; NULL: not given */
  ambulo_ends repeat; /* the start is one period of the motion; free: it is all of it */
  double from_step;   /* s that the one step took which the start repeats; < 0: it is none */
  double time_limit;  /* s; < 0: as in the file */
  ambulo_diagnostics *diagnostics;
  ambulo__cli_watch watch;
  int terminal;     /* 1: show progress */
  char norms[4096]; /* the folder of report.norms */
  char *inputs;     /* of the file's problem, which the best values' may outlive */
} job;

/* "solve 3 (best 0.0921): " of a run over free parameters */
static void show_solve(const ambulo_progress *p) {
  fputc('\r', stderr);
  if (p->solve > 0) fprintf(stderr, "solve %d", p->solve);
  if (p->solve > 0 && !isnan(p->best)) fprintf(stderr, " (best %.6g)", p->best);
  if (p->solve > 0) fputs(": ", stderr);
}

static int show_progress(void *user, const ambulo_progress *p) {
  job *j = user;
  ambulo__cli_watch_note(&j->watch, p);
  if (j->terminal && isnan(p->objective) && p->iteration > 0) {
    /* within an iteration: its line stays */
  } else if (j->terminal && isnan(p->objective)) {
    show_solve(p);
    fprintf(stderr, "%s: %.1f s\033[K", p->stage, p->seconds);
    fflush(stderr);
  } else if (j->terminal) {
    char left[40] = "";
    if (p->seconds_left >= 0.0) snprintf(left, sizeof left, ", %.0f s left", p->seconds_left);
    show_solve(p);
    fprintf(stderr, "iteration %d: objective %.6g, violation %.1e, %d evaluations, %.1f s%s\033[K",
            p->iteration, p->objective, p->violation, p->evaluations, p->seconds, left);
    fflush(stderr);
  }
  return ambulo__cli_stops() > 0;
}

/* "<problem file without folder and ending>_result" */
static char *default_directory(const char *problem) {
  const char *base = strrchr(problem, '/');
  base = base ? base + 1 : problem;
  const char *dot = strrchr(base, '.');
  int length = dot && dot != base ? (int)(dot - base) : (int)strlen(base), size = length + 8;
  char *name = malloc((size_t)size);
  if (name) ambulo__cli_format(name, (size_t)size, "%.*s_result", length, base);
  return name;
}

static int read_repeat(job *j) {
  static const ambulo_ends ends[] = {AMBULO_ENDS_FREE, AMBULO_ENDS_MIRRORED, AMBULO_ENDS_PERIODIC};
  const char *start = ambulo__cli_value(j->input, "start");
  j->repeat = ends[ambulo__cli_choice(j->input, "repeat", -1) + 1];
  if (j->repeat == AMBULO_ENDS_FREE || (start && strcmp(start, "zero") != 0)) return 0;
  return ambulo__cli_usage_error("solve", NULL,
                                 "--repeat needs a solution to repeat; expected --start FILE");
}

static int read_options(job *j) {
  const ambulo__cli_input *input = j->input;
  const char *directory = ambulo__cli_value(input, "output");
  j->report = ambulo_report_options_default();
  j->report.overwrite = ambulo__cli_flag(input, "force");
  if (ambulo__cli_shipped_file("norms", j->norms, sizeof j->norms)) j->report.norms = j->norms;
  j->time_limit = j->from_step = -1.0;
  if (!ambulo__cli_number(input, "time-limit", 0.0, 1e9, &j->time_limit) ||
      !ambulo__cli_integer(input, "samples", 2, 1000000, &j->report.samples))
    return 2;
  int wrong = read_repeat(j);
  if (wrong) return wrong;
  j->directory = directory ? strdup(directory) : default_directory(input->arguments[0]);
  j->diagnostics = ambulo_diagnostics_create(NULL);
  if (!j->directory || !j->diagnostics)
    return ambulo__cli_diagnostics(NULL, AMBULO_E_MEMORY, input->arguments[0]);
  j->terminal = isatty(STDERR_FILENO) && !ambulo__cli_flag(input, "quiet");
  return 0;
}

static ambulo_status load_start(job *j) {
  const char *start = ambulo__cli_value(j->input, "start");
  if (!start || !strcmp(start, "zero")) return AMBULO_OK;
  j->start = calloc((size_t)ambulo_problem_variable_count(j->problem), sizeof *j->start);
  if (!j->start) return AMBULO_E_MEMORY;
  ambulo_status status =
      j->repeat == AMBULO_ENDS_FREE
          ? ambulo_solution_start(start, j->problem, NULL, j->diagnostics, j->start)
          : ambulo_solution_repeat(start, j->problem, j->repeat, NULL, j->diagnostics, j->start);
  return status ? status
                : ambulo_solution_multipliers(start, j->problem, j->repeat, NULL, j->diagnostics,
                                              &j->multipliers);
}

static ambulo_options solver_options(const job *j) {
  ambulo_options options = ambulo_problem_options(j->problem);
  if (j->time_limit >= 0.0) options.time_limit = j->time_limit > 0.0 ? j->time_limit : AMBULO_OFF;
  return options;
}

/* on the body of the problem as it is now */
static ambulo_status load_muscles(job *j) {
  const char *file = ambulo__cli_value(j->input, "muscles");
  if (!file) return AMBULO_OK;
  ambulo_muscles_free(j->muscles);
  j->report.muscles = j->muscles = NULL;
  ambulo_status status =
      ambulo__cli_load_muscles(file, ambulo_problem_model(j->problem), j->diagnostics, &j->muscles);
  j->report.muscles = j->muscles;
  return status;
}

static ambulo_status solve_parameters(job *j, const ambulo_options *options) {
  ambulo_problem *best = NULL;
  ambulo_parameters parameters = ambulo_problem_parameters(j->problem);
  parameters.start = j->start;
  ambulo_status status = ambulo_solve_parameters(j->problem, &parameters, options, NULL,
                                                 j->diagnostics, &best, &j->result);
  ambulo__cli_watch_end(&j->watch);
  if (status) return status;
  ambulo_problem_free(j->problem);
  j->problem = best;
  return load_muscles(j);
}

static ambulo_status solve_refined(job *j, const ambulo_options *options) {
  ambulo_problem *finer = NULL;
  ambulo_status status =
      ambulo_solve_refined(j->problem, options, j->start, NULL, j->diagnostics, &finer, &j->result);
  ambulo__cli_watch_end(&j->watch);
  if (status || !finer) return status;
  j->coarser = j->problem;
  j->problem = finer;
  return AMBULO_OK;
}

static ambulo_status print_json(const job *j) {
  char *text = NULL;
  ambulo_status status = ambulo_report_summary(j->problem, j->result, &j->report, NULL, &text);
  if (status) return status;
  fputs(text, stdout);
  ambulo_text_free(text, NULL);
  return AMBULO_OK;
}

static ambulo_status print_outcome(job *j, int written) {
  int quiet = ambulo__cli_flag(j->input, "quiet");
  if (ambulo__cli_flag(j->input, "json")) return print_json(j);
  if (!quiet) ambulo__cli_print_result(j->problem, j->result);
  if (!quiet && j->from_step >= 0.0)
    printf("start        from one step, repeated; %.3f s\n", j->from_step);
  if (j->sensitivities) ambulo__cli_print_sensitivities(j->sensitivities);
  if (quiet) return AMBULO_OK;
  ambulo_status status = ambulo__cli_print_muscles(j->problem, j->result, &j->report);
  if (written) {
    printf("written to   %s\n", j->directory);
    printf("picture      %s/gait.svg\n", j->directory);
  }
  ambulo__cli_print_resolution(j->result);
  ambulo__cli_print_last(j->result);
  return status;
}

static int verdict_exit_code(const ambulo_result *result) {
  ambulo_verdict verdict = ambulo_result_verdict(result);
  if (ambulo__cli_stops() > 0) return 128 + ambulo__cli_stop_signal();
  return ambulo_verdict_is_solution(verdict) ? 0 : 1;
}

/* the warning that a batch finds in each summary.json: a million logs need not hold it as well */
static const char *in_table(const job *j) {
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(j->result);
  return ambulo__cli_is_worker() && dense && dense->summary[0] ? dense->summary : NULL;
}

/* writes and prints what there is */
static int finish(job *j) {
  ambulo_status status =
      ambulo_report_write(j->problem, j->result, j->directory, &j->report, NULL, j->diagnostics);
  int code = ambulo__cli_diagnostics_but(j->diagnostics, status, j->directory, in_table(j));
  ambulo_status printed = print_outcome(j, !status);
  if (printed && !code) code = ambulo__cli_diagnostics(NULL, printed, "summary");
  return code ? code : verdict_exit_code(j->result);
}

/* A thread still works on the problem, the messages and the rest: they are left as they are. */
static void end_deaf(job *j, ambulo_status status) {
  int code =
      status ? ambulo__cli_diagnostics(j->diagnostics, status, j->input->arguments[0]) : finish(j);
  _exit(ambulo__cli_finish(code));
}

static job beside(const job *deaf) {
  job j = *deaf;
  j.sensitivities = NULL;
  j.diagnostics = ambulo_diagnostics_create(NULL);
  if (j.terminal) fprintf(stderr, "\r\033[K");
  return j;
}

static int holds_rows(const job *j, const ambulo_result *result) {
  const ambulo_violation *v = &ambulo_result_audit(result)->violation;
  return v->worst <= solver_options(j).feasibility_tolerance * v->size;
}

/* a start that held its rows may be better than what the solver has made of it */
static int is_better(const job *j, const ambulo_result *start, const ambulo_result *found) {
  if (!holds_rows(j, start)) return 0;
  return !holds_rows(j, found) || ambulo_result_objective(start) < ambulo_result_objective(found);
}

/* with the point that was shown last, or the start */
static void give_up_solve(void *user, const ambulo_progress *last, ambulo_ending ending) {
  job j = beside(user);
  ambulo_options options = solver_options(&j);
  ambulo_progress progress = *last;
  ambulo_result *found = NULL;
  progress.point = j.start;
  ambulo_status status =
      ambulo_audit_progress(j.problem, &options, &progress, ending, NULL, j.diagnostics, &j.result);
  if (!status && last->point)
    status = ambulo_audit_progress(j.problem, &options, last, ending, NULL, j.diagnostics, &found);
  if (found && !(j.start && is_better(&j, j.result, found))) j.result = found;
  end_deaf(&j, status);
}

/* with the result, whose sensitivities are not known */
static void give_up_sensitivities(void *user, const ambulo_progress *last, ambulo_ending ending) {
  job j = beside(user);
  (void)last, (void)ending;
  end_deaf(&j, AMBULO_OK);
}

static void watch_solve(job *j, double limit) {
  j->watch = (ambulo__cli_watch){
      .give_up = give_up_solve, .user = j, .problem = j->problem, .limit = limit};
  ambulo__cli_watch_begin(&j->watch);
}

/* a gait of several steps without a start has that of one, if it can; the limit is of both */
static ambulo_status start_from_step(job *j, ambulo_options *options) {
  if (ambulo__cli_value(j->input, "start")) return AMBULO_OK;
  double *x = calloc((size_t)ambulo_problem_variable_count(j->problem), sizeof *x);
  if (!x) return AMBULO_E_MEMORY;
  watch_solve(j, options->time_limit);
  ambulo_status status = ambulo_start_from_step(j->problem, options, NULL, x, &j->multipliers);
  ambulo__cli_watch_end(&j->watch);
  double taken = ambulo__cli_watch_seconds(&j->watch);
  if (options->time_limit > 0.0) options->time_limit = fmax(1e-3, options->time_limit - taken);
  if (!j->multipliers) {
    free(x);
    return status;
  }
  j->start = x;
  j->from_step = taken;
  return AMBULO_OK;
}

static ambulo_status solve(job *j) {
  ambulo_options options = solver_options(j);
  options.progress = show_progress;
  options.user = j;
  ambulo__cli_catch_stops(1);
  ambulo_status status = start_from_step(j, &options);
  if (status) return status;
  options.multipliers = j->multipliers;
  watch_solve(j, options.time_limit);
  if (options.refine || ambulo__cli_flag(j->input, "refine")) {
    status = solve_refined(j, &options);
  } else if (ambulo_problem_parameters(j->problem).count > 0) {
    status = solve_parameters(j, &options);
  } else {
    status = ambulo_solve(j->problem, &options, j->start, NULL, j->diagnostics, &j->result);
    ambulo__cli_watch_end(&j->watch);
  }
  if (j->terminal) fprintf(stderr, "\r\033[K");
  return status;
}

static ambulo_status find_sensitivities(job *j) {
  j->watch = (ambulo__cli_watch){
      .give_up = give_up_sensitivities, .user = j, .problem = j->problem, .limit = AMBULO_OFF};
  ambulo__cli_watch_begin(&j->watch);
  ambulo_status status = ambulo_sensitivities(j->problem, j->result, NULL, &j->sensitivities);
  ambulo__cli_watch_end(&j->watch);
  j->report.sensitivities = j->sensitivities;
  return status;
}

static int run_job(job *j) {
  int code = read_options(j);
  if (code) return code;
  const char *file = j->input->arguments[0];
  ambulo_status status = ambulo_report_check(j->directory, &j->report, j->diagnostics);
  if (status) return ambulo__cli_diagnostics(j->diagnostics, status, j->directory);
  status = ambulo__cli_load_problem(j->input, file, j->diagnostics, &j->problem);
  if (!status) {
    j->inputs = strdup(ambulo_problem_inputs(j->problem));
    if (!j->inputs) status = AMBULO_E_MEMORY;
    j->report.inputs = j->inputs;
  }
  if (!status) status = load_muscles(j);
  if (!status) status = load_start(j);
  if (!status) status = solve(j);
  if (!status && ambulo__cli_flag(j->input, "sensitivities")) status = find_sensitivities(j);
  if (status) return ambulo__cli_diagnostics(j->diagnostics, status, file);
  return finish(j);
}

static int run(const ambulo__cli_input *input) {
  job j = {.input = input};
  int code = run_job(&j);
  ambulo_sensitivities_free(j.sensitivities);
  ambulo_result_free(j.result);
  ambulo_muscles_free(j.muscles);
  ambulo_problem_free(j.problem);
  ambulo_problem_free(j.coarser);
  ambulo_diagnostics_free(j.diagnostics);
  free(j.inputs);
  free(j.start);
  ambulo_multipliers_free(j.multipliers);
  free(j.directory);
  return code;
}

static const ambulo__cli_option options[] = {
    {"output", 'o', "DIR", "result folder (default: <problem>_result)"},
    {"set", 0, "path=value",
     "replace a value of the problem file, e.g. time.intervals=36;\nmay be repeated"},
    {"start", 0, "zero|FILE",
     "start from zero (default; several steps: from one) or from a solution.yaml"},
    {"repeat", 0, "mirrored|periodic",
     "repeat the start over the duration: it is one step, followed by its\nmirror image, or one "
     "stride"},
    {"time-limit", 0, "S", "stop after S seconds and keep the best point; 0: no limit"},
    {"refine", 0, NULL,
     "solve on grids twice as fine until the objective changes by less than\n1 % and the motion "
     "holds between its nodes; write the best"},
    {"muscles", 0, "FILE", "share the torques among muscles (default: the problem's, if any)"},
    {"samples", 0, "n", "number of times in motion.csv (default: the time nodes)"},
    {"force", 0, NULL, "replace an existing result folder"},
    {"quiet", 'q', NULL, "no progress, no summary"},
    {"sensitivities", 0, NULL,
     "find how the objective changes with each number of the problem: print\nit, and write it to "
     "summary.json"},
    {"json", 0, NULL, "print summary.json instead of the summary"},
};

const ambulo__cli_command ambulo__cli_solve = {
    .name = "solve",
    .arguments = "PROBLEM.yaml",
    .summary = "predict a motion and write a result folder",
    .description =
        "Solves the problem and writes summary.json, motion.csv, motion.sto, solution.yaml,\n"
        "gait.svg, scene.json and, of muscles, muscles.csv into a new folder, all or nothing. The\n"
        "verdict comes from an independent audit of the solution. Exit code 0: feasible or\n"
        "optimal; 1: the result was written, but it is not a solution and says so.",
    .example = "ambulo solve models/walk_normal.yaml -o walk --time-limit 60\n"
               "ambulo solve models/walk_normal.yaml --set time.intervals=50 "
               "--start walk/solution.yaml -o finer\n"
               "ambulo solve models/walk_normal.yaml --set gait.steps=3 --set time.duration=1.62 "
               "--set time.intervals=192 --set trajectory.intervals=75 "
               "--start walk/solution.yaml --repeat mirrored -o three",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum = 1,
    .maximum = 1,
    .files = 1,
    .words = "ambulo models --names problem",
    .run = run,
};
