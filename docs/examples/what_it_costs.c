/* what_it_costs.c - what the numbers of a walk cost, and one of them left to the solver.
 *
 *     cc what_it_costs.c $(pkg-config --cflags --libs ambulo) -o what_it_costs
 *     ./what_it_costs models/walker_2d_step.yaml gait.step_length 0.4 1.1
 *
 * Arguments: a problem, a number of it that may be free, and its bounds in SI units and rad. */
#include <ambulo/tools/tools.h>
#include <stdio.h>
#include <stdlib.h>

/* the five dearest, in words */
static ambulo_status costs(const ambulo_problem *problem, ambulo_diagnostics *messages) {
  ambulo_result *result = NULL;
  ambulo_sensitivity_list *list = NULL;
  ambulo_status status = ambulo_solve(problem, NULL, NULL, NULL, messages, &result);
  if (!status) status = ambulo_sensitivities(problem, result, NULL, &list);
  if (!status && list->reason[0]) printf("%s\n", list->reason);
  for (int i = 0; !status && i < list->count && i < 5; i++)
    printf("%-32s %10.4g %-6s %s\n", list->items[i].name, list->items[i].value, list->items[i].unit,
           list->items[i].words);
  ambulo_sensitivities_free(list);
  ambulo_result_free(result);
  return status;
}

/* the problem with the number elsewhere: its file, read with one more setting */
typedef struct source {
  const char *file, *name;
} source;

static ambulo_status problem_at(void *user, const double *values, const ambulo_allocator *allocator,
                                ambulo_diagnostics *diagnostics, ambulo_problem **problem) {
  const source *s = user;
  char setting[200];
  snprintf(setting, sizeof setting, "%s=%.17g", s->name, values[0]);
  const char *const overrides[] = {setting};
  return ambulo_problem_load(s->file, overrides, 1, allocator, diagnostics, problem);
}

static ambulo_status find(const ambulo_problem *problem, source *s, double lower, double upper,
                          ambulo_diagnostics *messages) {
  const ambulo_parameter item = {s->name, lower, upper};
  ambulo_parameters parameters = ambulo_parameters_default();
  parameters.items = &item;
  parameters.count = 1;
  parameters.problem_at = problem_at;
  parameters.user = s;
  ambulo_problem *best = NULL;
  ambulo_result *result = NULL;
  ambulo_status status =
      ambulo_solve_parameters(problem, &parameters, NULL, NULL, messages, &best, &result);
  if (!status) {
    const ambulo_parameters_outcome *outcome = ambulo_result_parameters(result);
    const ambulo_parameter_value *value = &outcome->items[0];
    printf("best %s: %.4f %s instead of %.4f; %s %.5g instead of %.5g, %d solves\n", value->name,
           value->value, value->unit, value->first,
           outcome->per == AMBULO_PER_DISTANCE ? "per metre" : "objective", outcome->objective,
           outcome->first, outcome->solves);
    printf("%s\n", outcome->ending);
  }
  ambulo_result_free(result); /* before the problem it belongs to */
  ambulo_problem_free(best);
  return status;
}

int main(int argc, char **argv) {
  if (argc != 5) {
    fprintf(stderr, "usage: %s PROBLEM NAME LOWER UPPER\n", argv[0]);
    return 2;
  }
  ambulo_diagnostics *messages = ambulo_diagnostics_create(NULL);
  ambulo_problem *problem = NULL;
  source s = {argv[1], argv[2]};
  ambulo_status status = ambulo_problem_load(argv[1], NULL, 0, NULL, messages, &problem);
  if (!status) status = costs(problem, messages);
  if (!status) status = find(problem, &s, strtod(argv[3], NULL), strtod(argv[4], NULL), messages);
  for (size_t i = 0; status && i < ambulo_diagnostics_count(messages); i++)
    fprintf(stderr, "%s\n", ambulo_diagnostics_get(messages, i)->message);
  ambulo_problem_free(problem);
  ambulo_diagnostics_free(messages);
  return ambulo_status_exit_code(status);
}
