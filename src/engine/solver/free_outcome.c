/* solver/free_outcome.c - see outcome.h. */
#include "solver/verdict.h"
#include "solver/free_outcome.h"
#include "base/machine.h"
#include "solver/result.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { ENDING = 240 };

/* texts stand behind the structure, in its block */
typedef struct ambulo__outcome {
  ambulo_parameters_outcome shown;
  char ending[ENDING];
  ambulo_parameter_value item[];
} ambulo__outcome;

static const char *why(const ambulo__outer *run) {
  if (!(run->best.objective < HUGE_VAL))
    return "the first solve found no motion that holds, so that nothing was varied";
  if (run->ending != AMBULO_ENDING_NONE) return ambulo__ending_text(run->ending);
  if (run->converged) return "the gradient is small, or points out of the bounds";
  if (run->settled) return "objective and parameters settled";
  return "no better values were found";
}

static size_t texts_of(const ambulo__outer *run) {
  size_t size = 0;
  for (int i = 0; i < run->parameters.count; i++) {
    const ambulo__parameter *p = run->which[i];
    size += strlen(p->name) + strlen(p->label) + 2;
  }
  return size;
}

static const char *put(char **at, const char *text) {
  char *own = *at;
  size_t size = strlen(text) + 1;
  memcpy(own, text, size);
  *at += size;
  return own;
}

static void fill_items(const ambulo__outer *run, ambulo__outcome *outcome) {
  char *text = (char *)(outcome->item + run->parameters.count);
  int known = run->best.objective < HUGE_VAL;
  for (int i = 0; i < run->parameters.count; i++) {
    const ambulo__parameter *p = run->which[i];
    const ambulo_parameter *item = &run->parameters.items[i];
    outcome->item[i] =
        (ambulo_parameter_value){.name = put(&text, p->name),
                                 .label = put(&text, p->label),
                                 .unit = ambulo__quantity_unit(p->quantity),
                                 .value = run->best.value[i],
                                 .lower = item->lower,
                                 .upper = item->upper,
                                 .first = p->value,
                                 .derivative = known ? run->best.gradient[i] : (double)NAN};
    outcome->item[i].bound =
        (ambulo_bound)(AMBULO_BETWEEN + ambulo__outer_bound(run, run->best.value, i));
  }
}

ambulo_status ambulo__outcome_attach(ambulo__outer *run) {
  ambulo_result *result = run->best.result;
  size_t items = (size_t)run->parameters.count * sizeof(ambulo_parameter_value);
  ambulo__outcome *outcome =
      ambulo__alloc(&result->allocator, sizeof *outcome + items + texts_of(run), 1);
  if (!outcome) return AMBULO_E_MEMORY;
  int known = run->best.objective < HUGE_VAL;
  fill_items(run, outcome);
  (void)snprintf(outcome->ending, sizeof outcome->ending, "%s; %d solves, %d rejected", why(run),
                 run->solves, run->failed);
  outcome->shown = (ambulo_parameters_outcome){
      .items = outcome->item,
      .count = run->parameters.count,
      .per = run->parameters.per,
      .distance = run->best.distance,
      .objective = known ? run->best.objective : (double)NAN,
      .first = known ? run->first : (double)NAN,
      .solves = run->solves,
      .failed = run->failed,
      .evaluations = run->evaluations,
      .converged = run->converged || (run->settled && run->ending == AMBULO_ENDING_NONE),
      .seconds = ambulo__seconds_now() - run->started,
      .ending = outcome->ending};
  result->outcome = outcome;
  return AMBULO_OK;
}

const ambulo_parameters_outcome *ambulo_result_parameters(const ambulo_result *result) {
  return result->outcome ? &result->outcome->shown : NULL;
}
