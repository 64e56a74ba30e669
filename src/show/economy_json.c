/* show/economy_json.c - see economy_json.h. */
#include "show/economy_json.h"

#include "people/stride_measures.h"

#include <math.h>

enum { SAMPLES = 1001 }; /* a stride of 1 s by the millisecond: work of a walk to 0.1 % */

static const double shortest_way = 0.01; /* m: nothing is said by the metre of less */

static void work(ambulo__json *json, const ambulo__stride *s, const ambulo__economy *e) {
  const ambulo_model *m = s->model;
  double metabolic = ambulo__economy_metabolic(e);
  double way =
      e->distance * (m->mass - ambulo__model_load_mass(m)); /* by the person, whatever is carried */
  ambulo__json_open(json, "work", '{');
  ambulo__json_number(json, "positive", e->positive_sum);
  ambulo__json_number(json, "negative", e->negative_sum);
  ambulo__json_number(json, "metabolic", metabolic);
  if (fmin(e->distance, e->feet) >= shortest_way) {
    ambulo__json_number(json, "positive_per_kg_metre", e->positive_sum / way);
    ambulo__json_number(json, "negative_per_kg_metre", e->negative_sum / way);
    ambulo__json_number(json, "metabolic_per_kg_metre", metabolic / way);
  }
  ambulo__json_open(json, "coordinates", '{');
  for (int i = 0; i < s->coordinates; i++) {
    const ambulo_coordinate *c = &s->model->coordinates[i];
    if (!c->actuated) continue;
    ambulo__json_open(json, c->name, '{');
    ambulo__json_number(json, "positive", e->positive[i]);
    ambulo__json_number(json, "negative", e->negative[i]);
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, '}');
  ambulo__json_close(json, '}');
}

ambulo_status ambulo__economy_json(ambulo__json *json, const ambulo_problem *problem,
                                   const ambulo_result *result) {
  ambulo__stride stride = {.samples = 0};
  ambulo__economy economy = {.positive = NULL};
  const ambulo_allocator *a = &json->text->allocator;
  ambulo_status status =
      ambulo__stride_create(problem, ambulo_result_x(result), SAMPLES, a, &stride);
  if (!status) status = ambulo__economy_of(&stride, a, &economy);
  if (!status) {
    if (problem->channels.slots) work(json, &stride, &economy);
    ambulo__json_open(json, "center_of_mass", '{');
    ambulo__json_number(json, "distance", economy.distance);
    ambulo__json_number(json, "rise", economy.rise);
    ambulo__json_number(json, "sway", economy.sway);
    ambulo__json_close(json, '}');
    ambulo__economy_free(&economy);
  }
  ambulo__stride_free(&stride);
  return status;
}
