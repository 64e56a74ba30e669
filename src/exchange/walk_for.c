/* exchange/walk_for.c - ambulo_walk_for: a problem file with which a body walks, for a model that
 * nobody has seen before. */
#include <math.h>
#include <string.h>

#include "ambulo/tools/load.h"
#include "base/diagnostics.h"
#include "base/sized.h"
#include "exchange/walker.h"

/* A speed that is given brings its step along, and so does a step: s / l = 0.4 sqrt(v / v0),
 * v0 = 0.2 sqrt(g l); of people 0.75 and 0.42, so that they walk at a comfortable 1.27 m/s on legs
 * of 0.93 m. */
static void choose_speed(ambulo__walker *w, const ambulo_walk_options *o, int person) {
  double usual = (person ? 0.42 : 0.2) * sqrt(w->gravity * w->leg);
  double step = (person ? 0.735 : 0.4) * w->leg;
  w->speed = usual;
  if (isfinite(o->step_length))
    w->speed = usual * (o->step_length / step) * (o->step_length / step);
  if (isfinite(o->speed)) w->speed = o->speed;
  w->step = isfinite(o->step_length) ? o->step_length : step * sqrt(w->speed / usual);
}

static const char *last_name(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

static ambulo_status write_text(const char *path, const ambulo_walk_options *options,
                                const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                ambulo__text_buffer *text) {
  const char *gait = options->gait ? options->gait : "walk";
  ambulo_model *model = NULL;
  ambulo__walker walker = {0};
  ambulo_status status = ambulo_model_load(path, NULL, allocator, diagnostics, &model);
  if (!status) status = ambulo__walker_measure(model, allocator, diagnostics, &walker);
  if (!status && walker.feet == 2 && strcmp(gait, "walk") != 0)
    status = ambulo__error(diagnostics, AMBULO_E_MODEL, ambulo__nowhere, NULL,
                           "a %s needs four feet (got 2); expected a walk", gait);
  if (!status) {
    int person = walker.feet == 2 && options->shipped && ambulo__walker_is_person(&walker);
    walker.file = options->model ? options->model : last_name(path);
    if (walker.feet == 4) {
      walker.speed = isfinite(options->speed) ? options->speed : 0.0;
      walker.step = isfinite(options->step_length) ? options->step_length : 0.0;
    } else {
      choose_speed(&walker, options, person);
    }
    if (walker.feet == 4)
      ambulo__walk_of_quadruped(&walker, gait, text);
    else if (person)
      status = ambulo__walk_of_person(&walker, options->shipped, diagnostics, text);
    else
      ambulo__walk_of_robot(&walker, text);
  }
  ambulo__walker_free(&walker);
  ambulo_model_free(model);
  if (!status) status = ambulo__text_status(text);
  return status;
}

static int is_sane(double value) {
  return isnan(value) || (value > 0.0 && value <= 100.0);
}

/* names stand in comments */
static int is_one_line(const char *name) {
  for (; *name; name++)
    if ((unsigned char)*name < ' ') return 0;
  return 1;
}

ambulo_status ambulo_walk_for(const char *model, const ambulo_walk_options *options,
                              const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                              char **text) {
  ambulo_walk_options own;
  if (!AMBULO__OWN(ambulo_walk_options, &own, options)) return AMBULO_E_ARGUMENT;
  if (!model || !model[0] || !text || !is_one_line(model) ||
      (own.model && !is_one_line(own.model)) || !is_sane(own.speed) || !is_sane(own.step_length) ||
      (own.gait && !ambulo__is_gait_of_four(own.gait)))
    return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo__text_buffer buffer;
  ambulo__text_init(&buffer, allocator);
  ambulo_status status = write_text(model, &own, allocator, diagnostics, &buffer);
  if (!status) {
    char *copy = ambulo__strdup(&buffer.allocator, ambulo__text_data(&buffer));
    if (copy) *text = copy;
    status = copy ? AMBULO_OK : AMBULO_E_MEMORY;
  }
  ambulo__text_free(&buffer);
  return ambulo__conclude(diagnostics, errors, status, model);
}
