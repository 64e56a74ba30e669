/* show/holds_json.c - see holds_json.h. */
#include "show/holds_json.h"

#include "people/stride.h"

#include <math.h>

enum { SAMPLES = 1001 }; /* as work of the joints (economy_json.c) */

static void hand(ambulo__json *json, const ambulo__stride *stride, int hold, int which) {
  int point = stride->problem->definition.holds[hold].hand[which];
  ambulo__hand_peak peak = ambulo__stride_hand_peak(stride, hold, which);
  ambulo__json_open(json, stride->model->points[point].name, '{');
  ambulo__json_number(json, "peak_force", peak.force);
  ambulo__json_number(json, "peak_force_time", peak.force_time);
  ambulo__json_number(json, "peak_moment", peak.moment);
  ambulo__json_number(json, "peak_moment_time", peak.moment_time);
  ambulo__json_close(json, '}');
}

static void hold(ambulo__json *json, const ambulo__stride *stride, int i) {
  const ambulo_hold *held = &stride->problem->definition.holds[i];
  double work[2];
  ambulo__stride_hold_work(stride, i, work);
  ambulo__json_open(json, held->name, '{');
  ambulo__json_number(json, "mass", held->mass);
  ambulo__json_number(json, "from", fmax(held->from, 0.0));
  ambulo__json_number(json, "to", fmin(held->to, stride->duration));
  ambulo__json_open(json, "hands", '{');
  for (int k = 0; k < 2 && held->hand[k] >= 0; k++) hand(json, stride, i, k);
  ambulo__json_close(json, '}');
  ambulo__json_number(json, "positive_work", work[0]);
  ambulo__json_number(json, "negative_work", work[1]);
  ambulo__json_close(json, '}');
}

ambulo_status ambulo__holds_json(ambulo__json *json, const ambulo_problem *problem,
                                 const ambulo_result *result) {
  ambulo__stride stride = {.samples = 0};
  if (problem->definition.hold_count == 0) return AMBULO_OK;
  ambulo_status status = ambulo__stride_create(problem, ambulo_result_x(result), SAMPLES,
                                               &json->text->allocator, &stride);
  if (status) return status;
  ambulo__json_open(json, "held", '{');
  for (int i = 0; i < stride.holds; i++) hold(json, &stride, i);
  ambulo__json_close(json, '}');
  ambulo__stride_free(&stride);
  return AMBULO_OK;
}
