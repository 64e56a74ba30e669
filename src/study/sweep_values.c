/* study/sweep_values.c - what an axis takes: lists, ranges, samples.
 *
 * Samples come from a generator of our own, so that a seed means the same everywhere: a 64-bit
 * linear congruential generator (Knuth, The Art of Computer Programming 2, 3.3.4; constants of
 * MMIX), its upper 53 bits as a fraction. Latin hypercube: every axis is cut into as many equal
 * strata as there are samples, each used once, in an order shuffled by axis (McKay, Beckman &
 * Conover, Technometrics 21, 1979). */
#include "study/sweep.h"

#include <math.h>
#include <string.h>

/* [first, last, step], both ends included where a step lands on them */
static ambulo_status add_range(ambulo_sweep *sweep, ambulo__axis *axis,
                               const ambulo__yaml_node *node) {
  double r[3];
  if (!ambulo__yaml_numbers(node, 3, r)) return AMBULO_E_SCHEMA;
  double steps = floor((r[1] - r[0]) / r[2] + 1e-9);
  if (r[2] == 0.0 || !(steps >= 0.0) || steps > AMBULO__AXIS_VALUES)
    return ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                              "range [%g, %g, %g] has no values; expected [first, last, step]",
                              r[0], r[1], r[2]);
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i <= (int)steps && !status; i++) {
    /* rounded to what a person would have written: 0.8 + 2 * 0.1 is 1 */
    double value = r[0] + i * r[2];
    status =
        ambulo__axis_add_number(sweep, axis, round(value * 1e12) / 1e12, ambulo__spot_of(node));
  }
  return status;
}

static ambulo_status add_linspace(ambulo_sweep *sweep, ambulo__axis *axis,
                                  const ambulo__yaml_node *node) {
  double r[3];
  if (!ambulo__yaml_numbers(node, 3, r)) return AMBULO_E_SCHEMA;
  int count = r[2] >= 1.0 && r[2] <= AMBULO__AXIS_VALUES ? (int)r[2] : 0;
  if (count < 1 || (double)count != r[2])
    return ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                              "linspace asks for %g values; expected [first, last, count]", r[2]);
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < count && !status; i++) {
    double fraction = count > 1 ? (double)i / (count - 1) : 0.0;
    status = ambulo__axis_add_number(sweep, axis, r[0] + fraction * (r[1] - r[0]),
                                     ambulo__spot_of(node));
  }
  return status;
}

static ambulo_status add_list(ambulo_sweep *sweep, ambulo__axis *axis,
                              const ambulo__yaml_node *node) {
  int list = ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE);
  int count = list ? ambulo__yaml_items(node) : 0;
  if (count < 1)
    return ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                              "'values' of '%s' %s; expected a list of one or more values",
                              axis->name, list ? "is empty" : "is not a list");
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < count && !status; i++)
    status = ambulo__axis_add_node(sweep, axis, ambulo__yaml_item(node, i));
  return status;
}

ambulo_status ambulo__sweep_read_values(ambulo_sweep *sweep, ambulo__axis *axis,
                                        const ambulo__yaml_node *node) {
  const ambulo__yaml_node *values = ambulo__yaml_get(node, "values");
  const ambulo__yaml_node *range = ambulo__yaml_get(node, "range");
  const ambulo__yaml_node *linspace = ambulo__yaml_get(node, "linspace");
  if ((values != NULL) + (range != NULL) + (linspace != NULL) != 1)
    return ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                              "axis '%s' needs one of 'values', 'range', 'linspace'", axis->name);
  if (values) return add_list(sweep, axis, values);
  return range ? add_range(sweep, axis, range) : add_linspace(sweep, axis, linspace);
}

/* ----------------------------------------------------------------- samples */

typedef unsigned long long generator;

static double fraction(generator *g) {
  *g = *g * 6364136223846793005ULL + 1442695040888963407ULL;
  return (double)(*g >> 11) / 9007199254740992.0;
}

static ambulo_status sample_axis(ambulo_sweep *sweep, const ambulo__yaml_node *node, int samples,
                                 int latin, generator *g) {
  const ambulo__yaml_node *key = ambulo__yaml_require(node, "key");
  const char *name = ambulo__yaml_text(ambulo__yaml_get(node, "name"));
  int whole = ambulo__yaml_boolean(ambulo__yaml_get(node, "whole"), 0);
  double range[2];
  ambulo__axis *axis = NULL;
  const char *path = ambulo__yaml_text(key);
  if (!ambulo__yaml_numbers(ambulo__yaml_require(node, "range"), 2, range) ||
      !ambulo__yaml_is(key, AMBULO__YAML_SCALAR))
    return AMBULO_E_SCHEMA;
  ambulo_status status = ambulo__sweep_add_axis(sweep, name, path, ambulo__spot_of(key), &axis);
  if (status || !axis) return status;
  status = ambulo__sweep_read_label(sweep, axis, node);
  int *order = ambulo__alloc(&sweep->allocator, (size_t)samples, sizeof *order);
  if (!order) return AMBULO_E_MEMORY;
  for (int i = 0; i < samples; i++) order[i] = i;
  for (int i = samples - 1; latin && i > 0; i--) {
    int j = (int)(fraction(g) * (i + 1)), kept = order[i];
    order[i] = order[j];
    order[j] = kept;
  }
  for (int i = 0; i < samples && !status; i++) {
    double u = fraction(g), place = latin ? (order[i] + u) / samples : u;
    double value = range[0] + place * (range[1] - range[0] + whole);
    if (whole) value = fmin(floor(value), range[1]);
    status = ambulo__axis_add_number(sweep, axis, value, ambulo__spot_of(key));
  }
  ambulo__free(&sweep->allocator, order);
  return ambulo__sweep_close(node, status);
}

ambulo_status ambulo__sweep_read_samples(ambulo_sweep *sweep, const ambulo__yaml_node *node,
                                         int latin) {
  int samples =
      ambulo__yaml_integer(ambulo__yaml_require(node, "samples"), 1, AMBULO__AXIS_VALUES, 1);
  int seed = ambulo__yaml_integer(ambulo__yaml_require(node, "seed"), 0, 2000000000, 0);
  const ambulo__yaml_node *axes = ambulo__yaml_require(node, "axes");
  ambulo__axis_group *group = &sweep->group[sweep->groups];
  group->first = sweep->axes;
  group->count = samples;
  generator g = (generator)seed * 2862933555777941757ULL + 3037000493ULL;
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < ambulo__yaml_items(axes) && !status; i++)
    status = sample_axis(sweep, ambulo__yaml_item(axes, i), samples, latin, &g);
  group->axes = sweep->axes - group->first;
  if (!status && axes && group->axes == 0)
    status = ambulo__yaml_error(axes, AMBULO_E_SCHEMA, NULL, "no axis; expected at least one");
  if (group->axes > 0) sweep->groups++;
  return ambulo__sweep_close(node, status);
}
