/* solve_walk.c - predicts a shipped walk and writes its result folder, as `ambulo solve` does.
 *
 *     cc solve_walk.c $(pkg-config --cflags --libs ambulo) -o solve_walk
 *     ./solve_walk models/walk_normal.yaml walk gait.step_width=0.12 subject.mass=60
 *
 * Arguments: a problem file, a folder that is not there yet, and any number of settings. Ctrl-C
 * ends the solve; the best point so far is written all the same. */
#include <ambulo/tools/tools.h>
#include <signal.h>
#include <stdio.h>

static volatile sig_atomic_t stopped;
static void stop(int signal_number) {
  (void)signal_number;
  stopped = 1;
}

/* a line that is written over; what it returns ends the solve */
static int progress(void *user, const ambulo_progress *now) {
  (void)user;
  fprintf(stderr, "\r%s %d: objective %.5f, violation %.1e, %.1f s", now->stage, now->iteration,
          now->objective, now->violation, now->seconds);
  return stopped;
}

static void tell(const ambulo_diagnostics *messages) {
  for (size_t i = 0; i < ambulo_diagnostics_count(messages); i++) {
    char line[1000];
    ambulo_diagnostics_format(messages, i, line, sizeof line);
    fprintf(stderr, "%s\n", line);
  }
}

static void describe(const ambulo_problem *problem, const ambulo_result *result) {
  printf("%s: %s\n", ambulo_problem_name(problem),
         ambulo_verdict_text(ambulo_result_verdict(result)));
  printf("objective %.6f\n", ambulo_result_objective(result));
  for (int i = 0; i < ambulo_problem_term_count(problem); i++)
    printf("  %-20s %.6f\n", ambulo_problem_term_name(problem, i), ambulo_result_terms(result)[i]);
  const ambulo_audit *audit = ambulo_result_audit(result);
  printf("worst violation %.1e %s (%s), KKT residual %.1e\n", audit->violation.worst,
         audit->violation.unit, audit->violation.family, audit->kkt);
  const ambulo_explanation *why = ambulo_result_explanation(result);
  for (int i = 0; why && i < why->line_count; i++) printf("%s\n", why->lines[i]);
}

int main(int argc, char **argv) {
  if (argc < 3) {
    fprintf(stderr, "usage: %s PROBLEM FOLDER [KEY=VALUE]...\n", argv[0]);
    return 2;
  }
  ambulo_diagnostics *messages = ambulo_diagnostics_create(NULL);
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  /* a folder that cannot be written is found before the solve, not after */
  ambulo_status status = ambulo_report_check(argv[2], NULL, messages);
  if (!status)
    status = ambulo_problem_load(argv[1], (const char *const *)argv + 3, argc - 3, NULL, messages,
                                 &problem);
  if (!status) {
    signal(SIGINT, stop);
    ambulo_options options = ambulo_problem_options(problem); /* what the file asks for */
    options.progress = progress;
    status = ambulo_solve(problem, &options, NULL, NULL, messages, &result);
    fprintf(stderr, "\n");
  }
  if (!status) {
    describe(problem, result);
    status = ambulo_report_write(problem, result, argv[2], NULL, NULL, messages);
  }
  tell(messages);
  /* a point is returned whatever the verdict: 1 says that it is no motion to use */
  int code = status ? ambulo_status_exit_code(status)
                    : !ambulo_verdict_is_solution(ambulo_result_verdict(result));
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  ambulo_diagnostics_free(messages);
  return code;
}
