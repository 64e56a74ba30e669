/* solver/sensitivities.c - ambulo_sensitivities: the numbers of a problem at a result, as a person
 * says them: "1 cm more step length raises the objective by 0.8 %". */
#include "solver/result.h"
#include "solver/sensitivity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---------------------------------------------------------------------- words */

static void say(ambulo__parameter *p, double objective) {
  const char *more = ambulo__parameter_more(p);
  p->step = ambulo__parameter_step(p);
  double change = p->derivative * p->step;
  p->share = objective > 0.0 ? change / objective : (double)NAN;
  if (!isfinite(p->share)) {
    (void)snprintf(p->words, sizeof p->words, "%s %s changes the objective by %.2g", more, p->label,
                   change);
  } else if (change == 0.0) {
    (void)snprintf(p->words, sizeof p->words, "%s %s leaves the objective as it is", more,
                   p->label);
  } else {
    (void)snprintf(p->words, sizeof p->words, "%s %s %s the objective by %.2g %%", more, p->label,
                   change > 0.0 ? "raises" : "lowers", 100.0 * fabs(p->share));
  }
}

static double size_of(const ambulo__parameter *p) {
  return fabs(p->derivative * p->step);
}

/* larger first; what is not finite last; alike ones as they were */
static int compare(const void *left, const void *right) {
  const ambulo__parameter *a = left, *b = right;
  double x = size_of(a), y = size_of(b);
  if (x > y || (!isnan(x) && isnan(y))) return -1;
  if (x < y || (isnan(x) && !isnan(y))) return 1;
  return a->order - b->order;
}

static void say_all(ambulo__parameters *p, double objective) {
  for (int i = 0; i < p->count; i++) {
    say(&p->list[i], objective);
    p->list[i].order = i;
  }
  if (p->count > 0) qsort(p->list, (size_t)p->count, sizeof *p->list, compare);
}

/* ------------------------------------------------------------------ the list */

/* one block: the public list first, so that it is freed by its own address */
typedef struct sensitivity_block {
  ambulo_sensitivity_list list;
  ambulo_allocator allocator;
  ambulo__parameter *parameters;
  ambulo_sensitivity *items;
} sensitivity_block;

void ambulo_sensitivities_free(ambulo_sensitivity_list *list) {
  sensitivity_block *block = (sensitivity_block *)list;
  if (!block) return;
  ambulo_allocator a = block->allocator;
  ambulo__free(&a, block->parameters);
  ambulo__free(&a, block->items);
  ambulo__free(&a, block);
}

static ambulo_status fill(const ambulo__parameters *p, sensitivity_block *block) {
  block->items = ambulo__alloc(&block->allocator, (size_t)p->count, sizeof *block->items);
  if (!block->items) return AMBULO_E_MEMORY;
  for (int i = 0; i < p->count; i++) {
    const ambulo__parameter *from = &p->list[i];
    ambulo_sensitivity item = {.name = from->name,
                               .with = from->with,
                               .with_sign = from->with_sign,
                               .label = from->label,
                               .unit = ambulo__quantity_unit(from->quantity),
                               .value = from->value,
                               .derivative = from->derivative,
                               .travel = from->travel,
                               .step = from->step,
                               .share = from->share,
                               .words = from->words};
    block->items[i] = item;
  }
  block->list.items = block->items;
  block->list.count = p->count;
  return AMBULO_OK;
}

ambulo_status ambulo__parameters_init(const ambulo_problem *problem,
                                      const ambulo_allocator *allocator, ambulo__parameters *p) {
  *p = (ambulo__parameters){.allocator = ambulo__allocator_or_default(allocator),
                            .problem = problem};
  ambulo_status status = ambulo__variant_init(problem, &p->allocator, &p->variant);
  if (status) return status;
  ambulo__parameters_of_walk(p);
  ambulo__parameters_of_body(p);
  ambulo__parameters_of_devices(p);
  ambulo__parameters_of_holds(p);
  ambulo__parameters_of_terms(p);
  ambulo__parameters_of_task(p);
  ambulo__parameters_of_limits(p);
  return p->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

/* those of these names alone */
static void choose(ambulo__parameters *p, const char *const *names, int count) {
  int kept = 0;
  for (int i = 0; i < p->count; i++) {
    int chosen = 0;
    for (int k = 0; k < count; k++) chosen |= strcmp(p->list[i].name, names[k]) == 0;
    if (chosen) p->list[kept++] = p->list[i];
  }
  p->count = kept;
}

static ambulo_status collect(const ambulo_problem *problem, const ambulo_result *result,
                             const char *const *names, int count, sensitivity_block *block) {
  ambulo__parameters p;
  ambulo_status status = ambulo__parameters_init(problem, &block->allocator, &p);
  if (names) choose(&p, names, count);
  if (!status)
    status =
        ambulo__parameters_differ(&p, ambulo_result_x(result), ambulo_result_multipliers(result));
  if (!status) {
    say_all(&p, ambulo_result_objective(result));
    status = fill(&p, block);
  }
  block->parameters = p.list;
  p.list = NULL;
  ambulo__parameters_clear(&p);
  return status;
}

static const char *reason_against(const ambulo_problem *problem, const ambulo_result *result) {
  if (problem->definition.term_count == 0) return "there is no objective";
  if (ambulo__verdict_at_nodes(ambulo_result_verdict(result)) != AMBULO_OPTIMAL)
    return "the point is not shown to be optimal";
  return "";
}

static ambulo_status list_of(const ambulo_problem *problem, const ambulo_result *result,
                             const char *reason, const char *const *names, int count,
                             const ambulo_allocator *allocator, ambulo_sensitivity_list **list) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  sensitivity_block *block = ambulo__alloc(&own, 1, sizeof *block);
  if (!block) return AMBULO_E_MEMORY;
  block->allocator = own;
  block->list.reason = reason;
  ambulo_status status = reason[0] ? AMBULO_OK : collect(problem, result, names, count, block);
  if (status) {
    ambulo_sensitivities_free(&block->list);
    return status;
  }
  *list = &block->list;
  return AMBULO_OK;
}

ambulo_status ambulo_sensitivities(const ambulo_problem *problem, const ambulo_result *result,
                                   const ambulo_allocator *allocator,
                                   ambulo_sensitivity_list **list) {
  if (!problem || !result || !list) return AMBULO_E_ARGUMENT;
  return list_of(problem, result, reason_against(problem, result), NULL, 0, allocator, list);
}

ambulo_status ambulo__sensitivities_nearly(const ambulo_problem *problem,
                                           const ambulo_result *result, const char *const *names,
                                           int count, const ambulo_allocator *allocator,
                                           ambulo_sensitivity_list **list) {
  return list_of(problem, result, "", names, count, allocator, list);
}
