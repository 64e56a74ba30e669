/* show/scene.c - see scene.h.
 *
 * Reading order: scene.h, series.h, scene.c, body.c, surroundings.c, curves.c.
 */
#include "show/scene.h"

#include <math.h>

#include "show/scene_curves.h"
#include "show/scene_series.h"
#include "show/scene_surroundings.h"

static void units(ambulo__json *json) {
  ambulo__json_open(json, "units", '{');
  ambulo__json_number(json, "length", AMBULO__SCENE_LENGTH);
  ambulo__json_number(json, "angle", AMBULO__SCENE_ANGLE);
  ambulo__json_number(json, "torque", AMBULO__SCENE_TORQUE);
  ambulo__json_number(json, "power", AMBULO__SCENE_POWER);
  ambulo__json_number(json, "force", AMBULO__SCENE_FORCE);
  ambulo__json_close(json, '}');
}

static void begin(ambulo__json *json, const ambulo_model *model, const char *name, int samples,
                  double duration) {
  ambulo__json_open(json, NULL, '{');
  ambulo__json_text(json, "schema", AMBULO__SCENE_SCHEMA);
  ambulo__json_text(json, "problem", name);
  ambulo__json_text(json, "model", ambulo_model_name(model));
  ambulo__json_number(json, "duration", duration);
  ambulo__json_integer(json, "samples", samples);
  ambulo__json_number(json, "mass", ambulo_model_mass(model));
  ambulo__json_number(json, "weight", ambulo__model_weight(model));
  ambulo__json_number(json, "stature", ambulo_model_stature(model));
  units(json);
}

/* 1 where every coordinate is finite at every time */
static int is_finite(const double *q, size_t count) {
  for (size_t i = 0; i < count; i++)
    if (!isfinite(q[i])) return 0;
  return 1;
}

static void about_problem(ambulo__json *json, const ambulo__stride *s) {
  const ambulo_problem_definition *d = &s->problem->definition;
  double periods = s->mirrored ? 2.0 : 1.0;
  ambulo__json_hash(json, "input_hash", ambulo_problem_hash(s->problem));
  ambulo__json_integer(json, "repeats", d->ends != AMBULO_ENDS_FREE);
  ambulo__json_integer(json, "mirrored", s->mirrored);
  ambulo__json_number(json, "travel", d->ends == AMBULO_ENDS_FREE ? 0.0 : periods * d->travel);
  ambulo__json_number(json, "rise", d->ends == AMBULO_ENDS_FREE ? 0.0 : periods * d->rise);
  ambulo__json_integer(json, "is_finite",
                       is_finite(s->q, (size_t)s->samples * (size_t)s->coordinates));
}

static ambulo_status body_of(ambulo__json *json, const ambulo__stride *s) {
  ambulo__scene_body body = {.model = NULL};
  ambulo_status status =
      ambulo__scene_body_create(s->model, s->q, s->samples, s->problem->definition.ground_height,
                                &json->text->allocator, &body);
  if (!status) {
    ambulo__scene_bones(json, &body);
    ambulo__scene_worn(json, s, &body);
    status = ambulo__scene_points(json, &body);
  }
  ambulo__scene_body_free(&body);
  return status;
}

ambulo_status ambulo__scene_json(const ambulo_problem *problem, const ambulo_result *result,
                                 const ambulo__people *people, ambulo__text_buffer *text) {
  ambulo__json json = {.text = text, .first = 1};
  ambulo__stride stride = {.samples = 0};
  ambulo__gait_people beside = {.people = NULL};
  ambulo_status status = ambulo__stride_create(problem, ambulo_result_x(result),
                                               AMBULO__SCENE_SAMPLES, &text->allocator, &stride);
  if (status) return status;
  status = ambulo__gait_people_create(&stride, people, &text->allocator, &beside);
  if (!status) {
    begin(&json, stride.model, ambulo_problem_name(problem), stride.samples, stride.duration);
    about_problem(&json, &stride);
    status = ambulo__scene_surroundings(&json, &stride);
  }
  if (!status) status = body_of(&json, &stride);
  if (!status) status = ambulo__scene_curves(&json, &stride, &beside);
  if (!status) ambulo__json_close(&json, '}');
  ambulo__gait_people_free(&beside);
  ambulo__stride_free(&stride);
  return status ? status : ambulo__text_status(text);
}

ambulo_status ambulo__scene_of_motion(const ambulo_model *model, const char *name, const double *q,
                                      int samples, double duration, double ground,
                                      ambulo__text_buffer *text) {
  ambulo__json json = {.text = text, .first = 1};
  ambulo__scene_body body = {.model = NULL};
  ambulo_status status =
      ambulo__scene_body_create(model, q, samples, ground, &text->allocator, &body);
  if (!status) {
    begin(&json, model, name, samples, duration);
    ambulo__json_text(&json, "input_hash", NULL);
    ambulo__scene_bones(&json, &body);
    status = ambulo__scene_points(&json, &body);
  }
  if (!status) {
    ambulo__scene_coordinates(&json, model, q, samples);
    ambulo__json_close(&json, '}');
  }
  ambulo__scene_body_free(&body);
  return status ? status : ambulo__text_status(text);
}
