/* solver/sensitivities.c - ambulo_sensitivities: partials at a result, by name, in words. */
#include "ambulo/sensitivity.h"

#include "contact/effector.h"
#include "solver/sensitivity_parameters.h"

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

static ambulo_status collect(const ambulo_problem *problem, const ambulo_result *result,
                             sensitivity_block *block) {
  ambulo_workspace *workspace = NULL;
  ambulo__partials partials;
  ambulo__pool pool;
  ambulo__parameters p = {.allocator = block->allocator, .problem = problem, .partials = &partials};
  ambulo_status status =
      ambulo__workspace_create_for_values(problem, &block->allocator, &workspace);
  if (status) return status;
  ambulo__pool_init(&pool, &block->allocator);
  status = ambulo__partials_at(problem, workspace, ambulo_result_x(result),
                               ambulo_result_multipliers(result), &pool, &partials);
  if (!status) status = ambulo__parameters_collect(&p);
  block->parameters = p.list;
  if (!status) {
    ambulo__parameters_say(&p, ambulo_result_objective(result));
    status = fill(&p, block);
  }
  ambulo__pool_clear(&pool);
  ambulo_workspace_free(workspace);
  return status;
}

static const char none_of_patches[] = "there are none yet for contacts of patches";

static const char *reason_against(const ambulo_problem *problem, const ambulo_result *result) {
  if (problem->definition.term_count == 0) return "there is no objective";
  if (ambulo__holds_patches(&problem->definition)) return none_of_patches;
  if (ambulo_result_verdict(result) != AMBULO_OPTIMAL)
    return "the point is not shown to be optimal";
  return "";
}

static ambulo_status list_of(const ambulo_problem *problem, const ambulo_result *result,
                             const char *reason, const ambulo_allocator *allocator,
                             ambulo_sensitivity_list **list) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  sensitivity_block *block = ambulo__alloc(&own, 1, sizeof *block);
  if (!block) return AMBULO_E_MEMORY;
  block->allocator = own;
  block->list.reason = reason;
  ambulo_status status = block->list.reason[0] ? AMBULO_OK : collect(problem, result, block);
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
  return list_of(problem, result, reason_against(problem, result), allocator, list);
}

ambulo_status ambulo__sensitivities_nearly(const ambulo_problem *problem,
                                           const ambulo_result *result,
                                           const ambulo_allocator *allocator,
                                           ambulo_sensitivity_list **list) {
  const char *reason = ambulo__holds_patches(&problem->definition) ? none_of_patches : "";
  return list_of(problem, result, reason, allocator, list);
}
