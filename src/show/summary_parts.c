/* show/summary_parts.c - the parts of summary.json: versions, clearances, devices, work,
 * convergence, loads in hands, ground reaction. */
#include "mechanics/plan.h"
#include "show/summary_json.h"

#include "ambulo/tools/tools.h"
#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "people/stride.h"
#include "people/stride_measures.h"
#include "people/walking_cost.h"

#include <math.h>
#include <nlopt.h>
#include <stdio.h>
#include <string.h>
#include <yaml.h>

/* Only OpenBLAS has it; with another BLAS the symbol stays undefined and its address NULL. */
extern char *openblas_get_config(void) __attribute__((weak));

/* "OpenBLAS 0.3.21 NO_LAPACKE ..." -> "OpenBLAS 0.3.21" */
static void blas_version(char *text, size_t size) {
  const char *config = openblas_get_config ? openblas_get_config() : "unnamed BLAS";
  const char *space = strchr(config, ' ');
  space = space ? strchr(space + 1, ' ') : NULL;
  int length = space ? (int)(space - config) : (int)strlen(config);
  snprintf(text, size, "%.*s", length, config);
}

void ambulo_versions_get(ambulo_versions *versions) {
  int major, minor, patch;
  snprintf(versions->ambulo, sizeof versions->ambulo, "%s", ambulo_version());
  nlopt_version(&major, &minor, &patch);
  snprintf(versions->nlopt, sizeof versions->nlopt, "%d.%d.%d", major, minor, patch);
  yaml_get_version(&major, &minor, &patch);
  snprintf(versions->libyaml, sizeof versions->libyaml, "%d.%d.%d", major, minor, patch);
  blas_version(versions->blas, sizeof versions->blas);
  snprintf(versions->instruction_set, sizeof versions->instruction_set, "%s",
           ambulo__instruction_set());
  snprintf(versions->engine, sizeof versions->engine, "%s", ambulo__engine_digest);
}

void ambulo__versions_json(ambulo__json *json) {
  ambulo_versions v;
  ambulo_versions_get(&v);
  ambulo__json_open(json, "versions", '{');
  ambulo__json_text(json, "ambulo", v.ambulo);
  ambulo__json_text(json, "nlopt", v.nlopt);
  ambulo__json_text(json, "libyaml", v.libyaml);
  ambulo__json_text(json, "blas", v.blas);
  ambulo__json_text(json, "instruction_set", v.instruction_set);
  ambulo__json_text(json, "engine", v.engine);
  ambulo__json_close(json, '}');
}

enum { PER_INTERVAL = 10 };

ambulo_status ambulo__approach_json(ambulo__json *json, const ambulo_problem *problem,
                                    const ambulo_result *result) {
  const ambulo_allocator *a = &json->text->allocator;
  ambulo__approach *list = NULL;
  int count = 0, samples = PER_INTERVAL * (problem->nodes - 1) + 1;
  if (ambulo_problem_pairs(problem, 0, NULL) == 0 && ambulo_problem_obstacle_count(problem) == 0)
    return AMBULO_OK;
  ambulo_status status =
      ambulo__approaches(problem, ambulo_result_x(result), samples, a, &list, &count);
  if (status) return status;
  ambulo__json_open(json, "approaches", '[');
  for (int i = 0; i < count; i++) {
    ambulo__json_open(json, NULL, '{');
    ambulo__json_text(json, "capsule", list[i].capsule);
    ambulo__json_text(json, list[i].is_obstacle ? "obstacle" : "other", list[i].other);
    ambulo__json_number(json, "gap", list[i].gap);
    ambulo__json_number(json, "time", list[i].time);
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, ']');
  ambulo__free(a, list);
  return AMBULO_OK;
}

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

enum {
  ECONOMY_JSON_SAMPLES = 1001
}; /* a stride of 1 s by the millisecond: work of a walk to 0.1 % */

static const double shortest_way = 0.01; /* m: nothing is said by the metre of less */

/* the estimate, what it is made of, and people's beside it where they are known */
static void walking_cost(ambulo__json *json, const ambulo__walking_cost *cost) {
  if (!cost->is_walk) return;
  ambulo__json_number(json, "metabolic", cost->net);
  ambulo__json_number(json, "metabolic_per_kg_metre", cost->per_kg_metre);
  if (isfinite(cost->people)) ambulo__json_number(json, "people_per_kg_metre", cost->people);
  ambulo__json_open(json, "walking", '{');
  ambulo__json_number(json, "limb_work", cost->limbs);
  ambulo__json_number(json, "unsteadiness", cost->unsteadiness);
  ambulo__json_number(json, "swing", cost->swing);
  ambulo__json_close(json, '}');
}

static void work(ambulo__json *json, const ambulo__stride *s, const ambulo__economy *e,
                 const ambulo__walking_cost *cost) {
  const ambulo_model *m = s->model;
  double way =
      e->distance * (m->mass - ambulo__model_load_mass(m)); /* by the person, whatever is carried */
  ambulo__json_open(json, "work", '{');
  ambulo__json_number(json, "positive", e->positive_sum);
  ambulo__json_number(json, "negative", e->negative_sum);
  if (fmin(e->distance, e->feet) >= shortest_way) {
    ambulo__json_number(json, "positive_per_kg_metre", e->positive_sum / way);
    ambulo__json_number(json, "negative_per_kg_metre", e->negative_sum / way);
  }
  walking_cost(json, cost);
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
                                   const ambulo_result *result, int with_muscles) {
  ambulo__stride stride = {.samples = 0};
  ambulo__economy economy = {.positive = NULL};
  ambulo__walking_cost cost = {.is_walk = 0};
  const ambulo_allocator *a = &json->text->allocator;
  ambulo_status status =
      ambulo__stride_create(problem, ambulo_result_x(result), ECONOMY_JSON_SAMPLES, a, &stride);
  if (!status && !with_muscles) status = ambulo__walking_cost_of(&stride, a, &cost);
  if (!status) status = ambulo__economy_of(&stride, a, &economy);
  if (!status) {
    if (problem->channels.slots) work(json, &stride, &economy, &cost);
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

typedef double column(const ambulo_iteration *iteration);

static double number_of(const ambulo_iteration *i) {
  return i->iteration;
}
static double evaluations_of(const ambulo_iteration *i) {
  return i->evaluations;
}
static double intervals_of(const ambulo_iteration *i) {
  return i->intervals;
}
static double objective_of(const ambulo_iteration *i) {
  return i->objective;
}
static double violation_of(const ambulo_iteration *i) {
  return i->violation;
}
static double gradient_of(const ambulo_iteration *i) {
  return i->gradient;
}
/* to the microsecond: more says nothing */
static double seconds_of(const ambulo_iteration *i) {
  return round(i->seconds * 1e6) / 1e6;
}

/* on one line */
static void list(ambulo__json *json, const char *key, const ambulo_history *history, column *of) {
  ambulo__text_buffer line;
  ambulo__text_init_part(&line, json->text);
  ambulo__text_append_char(&line, '[');
  for (int i = 0; i < history->count; i++) {
    double value = of(&history->items[i]);
    if (i) ambulo__text_append(&line, ", ");
    if (isfinite(value)) {
      ambulo__text_append_number(&line, value);
    } else {
      ambulo__text_append(&line, "null");
    }
  }
  ambulo__text_append_char(&line, ']');
  ambulo__json_raw(json, key, ambulo__text_data(&line));
  ambulo__text_free(&line);
}

void ambulo__starts_json(ambulo__json *json, const ambulo_result *result) {
  const ambulo_starts *s = ambulo_result_starts(result);
  if (!s) return;
  ambulo__json_open(json, "starts", '{');
  ambulo__json_integer(json, "count", s->count);
  ambulo__json_integer(json, "solved", s->solved);
  ambulo__json_integer(json, "intervals", s->intervals);
  ambulo__json_integer(json, "chosen", s->chosen);
  ambulo__json_open(json, "basins", '[');
  for (int b = 0; b < s->basin_count; b++) {
    ambulo__json_open(json, NULL, '{');
    ambulo__json_number(json, "objective", s->basins[b].objective);
    ambulo__json_integer(json, "found", s->basins[b].found);
    ambulo__json_integer(json, "first", s->basins[b].first);
    ambulo__json_number(json, "distance", s->basins[b].distance);
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, ']');
  ambulo__json_close(json, '}');
}

void ambulo__resolution_json(ambulo__json *json, const ambulo_result *result) {
  const ambulo_refinement *r = ambulo_result_refinement(result);
  ambulo__json_open(json, "resolution", '{');
  ambulo__json_number(json, "estimate", r ? r->resolution : (double)NAN);
  ambulo__json_open(json, "grids", '[');
  for (int g = 0; r && g < r->grid_count; g++) {
    const ambulo_refined_grid *grid = &r->grids[g];
    ambulo__json_open(json, NULL, '{');
    ambulo__json_integer(json, "intervals", grid->intervals);
    ambulo__json_integer(json, "trajectory_intervals", grid->spline_intervals);
    ambulo__json_number(json, "objective", grid->objective);
    ambulo__json_text(json, "verdict", ambulo_verdict_name(grid->verdict));
    ambulo__json_integer(json, "holds", grid->holds);
    ambulo__json_integer(json, "kept", grid->kept);
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, ']');
  ambulo__json_close(json, '}');
}

void ambulo__history_json(ambulo__json *json, const ambulo_result *result) {
  const ambulo_history *history = ambulo_result_history(result);
  if (history->count == 0) return;
  ambulo__json_open(json, "convergence", '{');
  ambulo__json_integer(json, "every", history->every);
  ambulo__json_number(json, "tolerance", history->tolerance);
  list(json, "iteration", history, number_of);
  list(json, "evaluations", history, evaluations_of);
  list(json, "intervals", history, intervals_of);
  list(json, "objective", history, objective_of);
  list(json, "violation", history, violation_of);
  list(json, "gradient", history, gradient_of);
  list(json, "seconds", history, seconds_of);
  ambulo__json_close(json, '}');
}

enum { HOLDS_JSON_SAMPLES = 1001 }; /* as work of the joints (economy_json.c) */

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
  ambulo_status status = ambulo__stride_create(problem, ambulo_result_x(result), HOLDS_JSON_SAMPLES,
                                               &json->text->allocator, &stride);
  if (status) return status;
  ambulo__json_open(json, "held", '{');
  for (int i = 0; i < stride.holds; i++) hold(json, &stride, i);
  ambulo__json_close(json, '}');
  ambulo__stride_free(&stride);
  return AMBULO_OK;
}

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
