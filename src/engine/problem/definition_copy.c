/* problem/definition_copy.c - a problem owns every array of its definition. */
#include "problem/problem.h"

#include <math.h>
#include <string.h>

/* a copy of count * size bytes; NULL stays NULL; sets *failed when memory runs out */
static void *copy_array(const ambulo_allocator *a, const void *from, size_t count, size_t size,
                        int *failed) {
  if (!from || count == 0) return NULL;
  void *to = ambulo__alloc(a, count, size);
  if (to) {
    memcpy(to, from, count * size);
  } else {
    *failed = 1;
  }
  return to;
}

static char *copy_text(const ambulo_allocator *a, const char *text, int *failed) {
  if (!text) return NULL;
  char *copy = ambulo__strdup(a, text);
  if (!copy) *failed = 1;
  return copy;
}

/* [d][2][3]: torque limits by their prices, which do not depend on the angle; 0 of those without,
 * which stand for 1 */
static double *limits_as_strength(const ambulo_allocator *a, const ambulo_model *model,
                                  const double *price, int *failed) {
  size_t count = (size_t)ambulo_model_coordinate_count(model);
  double *curves = ambulo__alloc(a, 6 * count, sizeof *curves);
  if (!curves) *failed = 1;
  for (size_t i = 0; curves && i < count; i++) {
    const double *torque = ambulo_model_coordinate(model, (int)i)->torque;
    if (isfinite(torque[1])) curves[6 * i] = torque[1] / (price ? price[2 * i + 1] : 1.0);
    if (isfinite(torque[0])) curves[6 * i + 3] = -torque[0] / (price ? price[2 * i] : 1.0);
  }
  return curves;
}

static void copy_terms(const ambulo_problem_definition *from, const ambulo_allocator *a,
                       ambulo_problem_definition *to, int *failed) {
  size_t d = (size_t)ambulo_model_coordinate_count(from->model);
  size_t nodes = (size_t)from->intervals + 1;
  if (from->term_count <= 0) return;
  ambulo_term *terms = ambulo__alloc(a, (size_t)from->term_count, sizeof *terms);
  if (!terms) {
    *failed = 1;
    return;
  }
  to->terms = terms;
  to->term_count = from->term_count;
  for (int t = 0; t < from->term_count; t++) {
    const ambulo_term *source = &from->terms[t];
    terms[t] = *source;
    terms[t].name = copy_text(a, source->name, failed);
    terms[t].scale = copy_array(a, source->scale, d, sizeof(double), failed);
    terms[t].offset = copy_array(a, source->offset, d, sizeof(double), failed);
    terms[t].passive = copy_array(a, source->passive, 4 * d, sizeof(double), failed);
    terms[t].strength = source->strength_is_limits
                            ? limits_as_strength(a, from->model, source->price, failed)
                            : copy_array(a, source->strength, 6 * d, sizeof(double), failed);
    terms[t].device_scale =
        copy_array(a, source->device_scale, (size_t)from->device_count, sizeof(double), failed);
    terms[t].tendon = copy_array(a, source->tendon, d, sizeof(double), failed);
    terms[t].price = copy_array(a, source->price, 2 * d, sizeof(double), failed);
    terms[t].reference = copy_array(a, source->reference, nodes * d, sizeof(double), failed);
  }
}

static void copy_devices(const ambulo_problem_definition *from, const ambulo_allocator *a,
                         ambulo_problem_definition *to, int *failed) {
  if (from->device_count <= 0) return;
  ambulo_device *devices = ambulo__alloc(a, (size_t)from->device_count, sizeof *devices);
  if (!devices) {
    *failed = 1;
    return;
  }
  to->devices = devices;
  to->device_count = from->device_count;
  for (int i = 0; i < from->device_count; i++) {
    const ambulo_device *source = &from->devices[i];
    size_t points = source->point_count > 0 ? (size_t)source->point_count : 0;
    devices[i] = *source;
    devices[i].name = copy_text(a, source->name, failed);
    devices[i].points = copy_array(a, source->points, points, 2 * sizeof(double), failed);
  }
}

static void copy_holds(const ambulo_problem_definition *from, const ambulo_allocator *a,
                       ambulo_problem_definition *to, int *failed) {
  if (from->hold_count <= 0) return;
  ambulo_hold *holds = ambulo__alloc(a, (size_t)from->hold_count, sizeof *holds);
  if (!holds) {
    *failed = 1;
    return;
  }
  to->holds = holds;
  to->hold_count = from->hold_count;
  for (int i = 0; i < from->hold_count; i++) {
    holds[i] = from->holds[i];
    holds[i].name = copy_text(a, from->holds[i].name, failed);
  }
}

static void copy_tubes(const ambulo_problem_definition *from, const ambulo_allocator *a,
                       ambulo_problem_definition *to, int *failed) {
  size_t d = (size_t)ambulo_model_coordinate_count(from->model);
  if (from->tube_count <= 0) return;
  ambulo_tube *tubes = ambulo__alloc(a, (size_t)from->tube_count, sizeof *tubes);
  if (!tubes) {
    *failed = 1;
    return;
  }
  to->tubes = tubes;
  to->tube_count = from->tube_count;
  for (int t = 0; t < from->tube_count; t++) {
    const ambulo_tube *source = &from->tubes[t];
    size_t count = (size_t)source->samples * d;
    tubes[t].samples = source->samples;
    tubes[t].reference = copy_array(a, source->reference, count, sizeof(double), failed);
    tubes[t].half_width = copy_array(a, source->half_width, d, sizeof(double), failed);
  }
}

static void copy_user_rows(const ambulo_problem_definition *from, const ambulo_allocator *a,
                           ambulo_problem_definition *to, int *failed) {
  if (from->user_row_count <= 0) return;
  ambulo_user_row *rows = ambulo__alloc(a, (size_t)from->user_row_count, sizeof *rows);
  if (!rows) {
    *failed = 1;
    return;
  }
  to->user_rows = rows;
  to->user_row_count = from->user_row_count;
  for (int i = 0; i < from->user_row_count; i++) {
    rows[i] = from->user_rows[i];
    rows[i].name = copy_text(a, from->user_rows[i].name, failed);
    rows[i].unit = copy_text(a, from->user_rows[i].unit, failed);
  }
}

/* names stay those of the first problem that had them (problem/problem.c) */
static void copy_obstacles(const ambulo_problem_definition *from, const ambulo_allocator *a,
                           ambulo_problem_definition *to, int *failed) {
  if (from->obstacle_count <= 0) return;
  ambulo_obstacle *obstacles = ambulo__alloc(a, (size_t)from->obstacle_count, sizeof *obstacles);
  if (!obstacles) {
    *failed = 1;
    return;
  }
  to->obstacles = obstacles;
  to->obstacle_count = from->obstacle_count;
  for (int i = 0; i < from->obstacle_count; i++) {
    const ambulo_obstacle *source = &from->obstacles[i];
    obstacles[i] = *source;
    obstacles[i].capsules = copy_array(a, source->capsules, (size_t)source->capsule_count,
                                       sizeof *source->capsules, failed);
  }
}

ambulo_status ambulo__definition_copy(const ambulo_problem_definition *from,
                                      const ambulo_allocator *a, ambulo_problem_definition *to) {
  int failed = 0;
  *to = *from;
  to->terms = NULL;
  to->user_rows = NULL;
  to->devices = NULL;
  to->device_count = 0;
  to->holds = NULL;
  to->hold_count = 0;
  to->tubes = NULL;
  to->tube_count = 0;
  to->obstacles = NULL;
  to->obstacle_count = 0;
  to->term_count = to->user_row_count = 0;
  to->name = copy_text(a, from->name ? from->name : "problem", &failed);
  size_t nodes = from->node_times ? (size_t)from->intervals + 1 : 0;
  to->node_times = copy_array(a, from->node_times, nodes, sizeof(double), &failed);
  size_t breakpoints = from->breakpoints ? (size_t)from->spline_intervals + 1 : 0;
  to->breakpoints = copy_array(a, from->breakpoints, breakpoints, sizeof(double), &failed);
  to->contacts =
      copy_array(a, from->contacts, (size_t)from->contact_count, sizeof *from->contacts, &failed);
  to->end_values = copy_array(a, from->end_values, (size_t)from->end_value_count,
                              sizeof *from->end_values, &failed);
  copy_terms(from, a, to, &failed);
  copy_devices(from, a, to, &failed);
  copy_holds(from, a, to, &failed);
  copy_tubes(from, a, to, &failed);
  copy_user_rows(from, a, to, &failed);
  copy_obstacles(from, a, to, &failed);
  to->collision.pairs = copy_array(a, from->collision.pairs, (size_t)from->collision.pair_count,
                                   sizeof *from->collision.pairs, &failed);
  to->reaches =
      copy_array(a, from->reaches, (size_t)from->reach_count, sizeof *from->reaches, &failed);
  return failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

/* the copies are ours: casting the borrowed view's const away is sound here only */
static void release(const ambulo_allocator *a, const void *pointer) {
  union {
    const void *constant;
    void *owned;
  } view = {pointer};
  ambulo__free(a, view.owned);
}

void ambulo__definition_set_pairs(const ambulo_allocator *a, ambulo_problem_definition *d,
                                  ambulo_capsule_pair *pairs, int count) {
  release(a, d->collision.pairs);
  d->collision.pairs = pairs;
  d->collision.pair_count = count;
}

void ambulo__definition_free(const ambulo_allocator *a, ambulo_problem_definition *d) {
  for (int t = 0; t < d->term_count; t++) {
    release(a, d->terms[t].name);
    release(a, d->terms[t].scale);
    release(a, d->terms[t].offset);
    release(a, d->terms[t].passive);
    release(a, d->terms[t].strength);
    release(a, d->terms[t].price);
    release(a, d->terms[t].tendon);
    release(a, d->terms[t].device_scale);
    release(a, d->terms[t].reference);
  }
  for (int i = 0; i < d->device_count; i++) {
    release(a, d->devices[i].name);
    release(a, d->devices[i].points);
  }
  for (int i = 0; i < d->hold_count; i++) release(a, d->holds[i].name);
  for (int t = 0; t < d->tube_count; t++) {
    release(a, d->tubes[t].reference);
    release(a, d->tubes[t].half_width);
  }
  for (int i = 0; i < d->user_row_count; i++) {
    release(a, d->user_rows[i].name);
    release(a, d->user_rows[i].unit);
  }
  for (int i = 0; i < d->obstacle_count; i++) release(a, d->obstacles[i].capsules);
  release(a, d->obstacles);
  release(a, d->collision.pairs);
  release(a, d->reaches);
  release(a, d->terms);
  release(a, d->devices);
  release(a, d->holds);
  release(a, d->tubes);
  release(a, d->user_rows);
  release(a, d->name);
  release(a, d->node_times);
  release(a, d->breakpoints);
  release(a, d->contacts);
  release(a, d->end_values);
}
