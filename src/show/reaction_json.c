/* show/reaction_json.c - see reaction_json.h. */
#include "show/reaction_json.h"

#include "base/vector.h"
#include "contact/effector.h"
#include "people/stride_measures.h"
#include "people/stride.h"

static void impulse_of(ambulo__json *json, const ambulo_model *model, const double impulse[3]) {
  const double *axes[3] = {model->forward, model->up, model->left};
  static const char *const keys[3] = {"impulse_forward", "impulse_up", "impulse_left"};
  for (int axis = 0; axis < 3; axis++)
    ambulo__json_number(json, keys[axis], ambulo__dot(impulse, axes[axis]));
}

/* per foot and per patch that is in contact at some time: impulse of the force on it over the
 * stride, N s, along forward, up and left, and the largest force in body weights, of a foot along
 * the normal; nothing without ground reaction */
static void effectors(ambulo__json *json, const ambulo_problem *problem,
                      const ambulo__stride *stride, const double *impulses) {
  const ambulo_model *model = problem->model;
  for (int e = 0; e < stride->feet + stride->patches; e++) {
    int patch = ambulo__effector_patch(model, e);
    if (patch >= 0 && !ambulo__patch_is_used(&problem->definition, patch)) continue;
    ambulo__json_open(json, ambulo__effector_name(model, e), '{');
    impulse_of(json, model, impulses + 3 * e);
    ambulo__json_number(json, "peak",
                        patch < 0 ? ambulo__stride_peak(stride, e)
                                  : ambulo__stride_patch_peak(stride, patch));
    ambulo__json_close(json, '}');
  }
}

ambulo_status ambulo__reaction_json(ambulo__json *json, const ambulo_problem *problem,
                                    const ambulo_result *result) {
  ambulo__stride stride = {.samples = 0};
  const ambulo_allocator *a = &json->text->allocator;
  if (!problem->channels.slots) return AMBULO_OK;
  size_t count = 3 * (size_t)ambulo__effector_count(problem->model);
  double *impulses = ambulo__alloc(a, count, sizeof *impulses);
  ambulo_status status = impulses ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = ambulo__impulses(problem, ambulo_result_x(result), a, impulses);
  if (!status) status = ambulo__stride_create(problem, ambulo_result_x(result), 0, a, &stride);
  if (!status) {
    ambulo__json_open(json, "ground_reaction", '{');
    effectors(json, problem, &stride, impulses);
    ambulo__json_close(json, '}');
    ambulo__stride_free(&stride);
  }
  ambulo__free(a, impulses);
  return status;
}
