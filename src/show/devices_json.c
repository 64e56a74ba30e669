/* show/devices_json.c - see devices_json.h. */
#include "show/devices_json.h"

#include "people/stride.h"

enum { SAMPLES = 1001 }; /* as work of the joints (economy_json.c) */

ambulo_status ambulo__devices_json(ambulo__json *json, const ambulo_problem *problem,
                                   const ambulo_result *result) {
  ambulo__stride stride = {.samples = 0};
  if (!problem->devices) return AMBULO_OK;
  ambulo_status status = ambulo__stride_create(problem, ambulo_result_x(result), SAMPLES,
                                               &json->text->allocator, &stride);
  if (status) return status;
  ambulo__json_open(json, "devices", '{');
  for (int i = 0; i < stride.devices; i++) {
    const ambulo_device *device = &problem->definition.devices[i];
    ambulo__device_work work = ambulo__stride_device_work(&stride, i);
    ambulo__json_open(json, device->name, '{');
    ambulo__json_text(json, "unit", ambulo__device_turns(problem->model, device) ? "N m" : "N");
    ambulo__json_number(json, "peak", work.peak);
    ambulo__json_number(json, "positive", work.positive);
    ambulo__json_number(json, "negative", work.negative);
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, '}');
  ambulo__stride_free(&stride);
  return AMBULO_OK;
}
