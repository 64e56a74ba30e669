/* show/scene.c - scene.json: curves over time, and the file (scene.h).
 *
 * power_i = tau_i qd_i, W. Curves of people are in SI units and radians; their bands are two
 * standard deviations to either side.
 */
#include "show/scene.h"

#include "ambulo/tools/load.h"
#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "show/gait_svg.h"

#include <math.h>

static const double degree = 0.017453292519943295; /* rad */

/* ---------------------------------------------------------------- one curve */

/* mean and band under `key`; nothing where some time of the motion has no people */
static ambulo_status beside(ambulo__json *json, const char *key, const ambulo__people_curve *curve,
                            double factor, double unit) {
  int samples = curve->of->stride->samples, there = curve->curve != NULL;
  const ambulo_allocator *a = &json->text->allocator;
  if (!there) return AMBULO_OK;
  double *mean = ambulo__alloc(a, 2 * (size_t)samples, sizeof *mean);
  if (!mean) return AMBULO_E_MEMORY;
  double *band = mean + samples;
  for (int k = 0; k < samples && there; k++) {
    there = ambulo__people_at(curve, k, &mean[k], &band[k]);
    mean[k] *= factor;
    band[k] *= factor;
  }
  if (there) {
    ambulo__json_open(json, key, '{');
    ambulo__json_integer(json, "source", curve->file);
    ambulo__series(json, "mean", mean, 1, samples, unit);
    if (curve->curve->sd) ambulo__series(json, "band", band, 1, samples, unit);
    ambulo__json_close(json, '}');
  }
  ambulo__free(a, mean);
  return AMBULO_OK;
}

static void limits(ambulo__json *json, const char *key, const double limit[2]) {
  ambulo__json_open(json, key, '[');
  ambulo__json_number(json, NULL, limit[0]);
  ambulo__json_number(json, NULL, limit[1]);
  ambulo__json_close(json, ']');
}

static double unit_of(const ambulo_coordinate *c) {
  return c->type == AMBULO_REVOLUTE ? AMBULO__SCENE_ANGLE : AMBULO__SCENE_LENGTH;
}

static void about(ambulo__json *json, const ambulo_model *model, int i) {
  const ambulo_coordinate *c = &model->coordinates[i];
  ambulo__json_text(json, "name", c->name);
  ambulo__json_text(json, "unit", c->type == AMBULO_REVOLUTE ? "rad" : "m");
  ambulo__json_text(json, "side", ambulo__scene_side(ambulo__coordinate_side(model, i)));
  ambulo__json_integer(json, "mirror", c->mirror);
  ambulo__json_integer(json, "actuated", c->actuated);
  limits(json, "range", c->range);
  limits(json, "torque", c->torque);
}

void ambulo__scene_coordinates(ambulo__json *json, const ambulo_model *model, const double *q,
                               int samples) {
  int count = model->coordinate_count;
  ambulo__json_open(json, "coordinates", '[');
  for (int i = 0; i < count; i++) {
    ambulo__json_open(json, NULL, '{');
    about(json, model, i);
    ambulo__series(json, "q", q + i, count, samples, unit_of(&model->coordinates[i]));
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, ']');
}

/* --------------------------------------------------------------- coordinates */

static ambulo_status coordinate(ambulo__json *json, const ambulo__stride *s,
                                const ambulo__gait_people *people, int i, double *power) {
  int count = s->coordinates;
  int revolute = s->model->coordinates[i].type == AMBULO_REVOLUTE;
  double unit = unit_of(&s->model->coordinates[i]);
  for (int k = 0; k < s->samples; k++) power[k] = s->tau[k * count + i] * s->qd[k * count + i];
  ambulo__json_open(json, NULL, '{');
  about(json, s->model, i);
  ambulo__series(json, "q", s->q + i, count, s->samples, unit);
  ambulo__series(json, "tau", s->tau + i, count, s->samples, AMBULO__SCENE_TORQUE);
  ambulo__series(json, "power", power, 1, s->samples, AMBULO__SCENE_POWER);
  ambulo__people_curve angle = ambulo__people_coordinate(people, "q", i);
  ambulo__people_curve torque = ambulo__people_coordinate(people, "tau", i);
  ambulo_status status = beside(json, "people_q", &angle, revolute ? degree : 1.0, unit);
  if (!status) status = beside(json, "people_tau", &torque, 1.0, AMBULO__SCENE_TORQUE);
  ambulo__json_close(json, '}');
  return status;
}

static ambulo_status coordinates(ambulo__json *json, const ambulo__stride *s,
                                 const ambulo__gait_people *people) {
  const ambulo_allocator *a = &json->text->allocator;
  double *power = ambulo__alloc(a, (size_t)s->samples, sizeof *power);
  ambulo_status status = power ? AMBULO_OK : AMBULO_E_MEMORY;
  ambulo__json_open(json, "coordinates", '[');
  for (int i = 0; i < s->coordinates && !status; i++)
    status = coordinate(json, s, people, i, power);
  ambulo__json_close(json, ']');
  ambulo__free(a, power);
  return status;
}

/* -------------------------------------------------------------------- forces */

static ambulo__side side_of(const ambulo__stride *s, int effector) {
  int patch = ambulo__effector_patch(s->model, effector);
  if (patch >= 0) return ambulo__gait_patch_side(s->model, patch);
  const ambulo_foot *foot = &s->model->feet[effector];
  for (int i = 0; i < s->coordinates; i++) {
    const ambulo_link *link = &s->model->links[s->model->points[foot->heel_center].link];
    for (; link->coordinate < 0 && link->parent >= 0;) link = &s->model->links[link->parent];
    if (link->coordinate >= 0) return ambulo__coordinate_side(s->model, link->coordinate);
  }
  return AMBULO__MIDDLE;
}

/* along forward, left and up: of a force, N; of its centre of pressure, m, with the ground's height
 * taken off */
static void turn(const ambulo__stride *s, const double *force, const double *pressure, int step,
                 double *out) {
  for (int k = 0; k < s->samples; k++, out += 6) {
    ambulo__scene_place(s->model, 0.0, force + (size_t)k * (size_t)step, out);
    ambulo__scene_place(s->model, s->problem->definition.ground_height,
                        pressure + (size_t)k * (size_t)step, out + 3);
  }
}

static void six_series(ambulo__json *json, const ambulo__stride *s, const double *turned) {
  ambulo__json_open(json, "force", '[');
  for (int i = 0; i < 3; i++)
    ambulo__series(json, NULL, turned + i, 6, s->samples, AMBULO__SCENE_FORCE);
  ambulo__json_close(json, ']');
  ambulo__json_open(json, "pressure", '[');
  for (int i = 3; i < 6; i++)
    ambulo__series(json, NULL, turned + i, 6, s->samples, AMBULO__SCENE_LENGTH);
  ambulo__json_close(json, ']');
}

static ambulo_status force(ambulo__json *json, const ambulo__stride *s, int effector,
                           const ambulo__gait_people *people, double *turned) {
  int patch = ambulo__effector_patch(s->model, effector);
  ambulo__side side = side_of(s, effector);
  ambulo__json_open(json, NULL, '{');
  ambulo__json_text(json, "name", ambulo__effector_name(s->model, effector));
  ambulo__json_text(json, "kind", ambulo__effector_kind(s->model, effector));
  ambulo__json_text(json, "side", ambulo__scene_side(side));
  if (patch < 0) {
    turn(s, s->grf + 3 * effector, s->cop + 3 * effector, 3 * s->feet, turned);
  } else {
    turn(s, s->patch_force + 3 * patch, s->patch_cop + 3 * patch, 3 * s->patches, turned);
  }
  six_series(json, s, turned);
  ambulo_status status = AMBULO_OK;
  if (patch < 0 && side != AMBULO__MIDDLE) {
    double weight = ambulo__model_weight(s->model);
    ambulo__people_curve up = ambulo__people_force(people, "up", side);
    ambulo__people_curve ahead = ambulo__people_force(people, "forward", side);
    status = beside(json, "people_up", &up, weight, AMBULO__SCENE_FORCE);
    if (!status) status = beside(json, "people_forward", &ahead, weight, AMBULO__SCENE_FORCE);
  }
  ambulo__json_close(json, '}');
  return status;
}

static ambulo_status forces(ambulo__json *json, const ambulo__stride *s,
                            const ambulo__gait_people *people) {
  const ambulo_allocator *a = &json->text->allocator;
  double *turned = ambulo__alloc(a, 6 * (size_t)s->samples, sizeof *turned);
  ambulo_status status = turned ? AMBULO_OK : AMBULO_E_MEMORY;
  ambulo__json_open(json, "forces", '[');
  for (int e = 0; e < ambulo__effector_count(s->model) && !status; e++) {
    int patch = ambulo__effector_patch(s->model, e);
    int known = patch < 0 ? e < s->feet : patch < s->patches;
    if (known && ambulo__gait_shows(s, e)) status = force(json, s, e, people, turned);
  }
  ambulo__json_close(json, ']');
  ambulo__free(a, turned);
  return status;
}

ambulo_status ambulo__scene_curves(ambulo__json *json, const ambulo__stride *s,
                                   const ambulo__gait_people *people) {
  ambulo_status status = coordinates(json, s, people);
  if (!status) status = forces(json, s, people);
  ambulo__json_open(json, "people", '[');
  for (int f = 0; people->people && f < people->people->count; f++) {
    const ambulo__people_file *file = &people->people->files[f];
    ambulo__json_text(json, NULL, file->source ? file->source : file->path);
  }
  ambulo__json_close(json, ']');
  return status;
}

/* ------------------------------------------------------------------ the file */

static void units(ambulo__json *json) {
  ambulo__json_open(json, "units", '{');
  ambulo__json_number(json, "length", AMBULO__SCENE_LENGTH);
  ambulo__json_number(json, "angle", AMBULO__SCENE_ANGLE);
  ambulo__json_number(json, "torque", AMBULO__SCENE_TORQUE);
  ambulo__json_number(json, "power", AMBULO__SCENE_POWER);
  ambulo__json_number(json, "force", AMBULO__SCENE_FORCE);
  ambulo__json_number(json, "activation", AMBULO__SCENE_ACTIVATION);
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

static ambulo_status body_of(ambulo__json *json, const ambulo__stride *s, const char *inputs) {
  ambulo__scene_body body = {.model = NULL};
  ambulo_status status =
      ambulo__scene_body_create(s->model, s->q, s->samples, s->problem->definition.ground_height,
                                &json->text->allocator, &body);
  if (!status) {
    ambulo__scene_bones(json, &body);
    status = ambulo__scene_worn(json, s, &body);
    if (!status) status = ambulo__scene_points(json, &body);
    if (!status)
      status =
          ambulo__scene_meshes(json, &body, inputs ? inputs : ambulo_problem_inputs(s->problem));
  }
  ambulo__scene_body_free(&body);
  return status;
}

ambulo_status ambulo__scene_json(const ambulo_problem *problem, const ambulo_result *result,
                                 const ambulo__people *people, const ambulo_muscles *muscles,
                                 const char *inputs, ambulo__text_buffer *text) {
  ambulo__json json = {.text = text, .first = 1};
  ambulo_muscle_analysis *analysis = NULL;
  ambulo__stride stride = {.samples = 0};
  ambulo__gait_people beside = {.people = NULL};
  ambulo_status status = ambulo__stride_create(problem, ambulo_result_x(result),
                                               AMBULO__SCENE_SAMPLES, &text->allocator, &stride);
  if (status) return status;
  status = ambulo_muscle_analysis_of_result(problem, result, muscles, AMBULO__SCENE_SAMPLES,
                                            &text->allocator, NULL, &analysis);
  if (!status) status = ambulo__gait_people_create(&stride, people, &text->allocator, &beside);
  if (!status) {
    begin(&json, stride.model, ambulo_problem_name(problem), stride.samples, stride.duration);
    about_problem(&json, &stride);
    status = ambulo__scene_surroundings(&json, &stride);
  }
  if (!status) status = body_of(&json, &stride, inputs);
  if (!status) status = ambulo__scene_curves(&json, &stride, &beside);
  if (!status && analysis) status = ambulo__scene_muscles(&json, &stride, analysis);
  if (!status) ambulo__json_close(&json, '}');
  ambulo_muscle_analysis_free(analysis);
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
