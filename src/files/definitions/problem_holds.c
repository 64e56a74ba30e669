/* definitions/problem_holds.c - what hands hold: items of `load` with `hands`. */
#include "definitions/problem_reader.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double heaviest = 1000.0, strongest = 1e5, longest = 100.0; /* kg; N; m */
static const double shortest_ramp = 0.001, longest_time = 1e6;           /* s */

/* the index of a point that a node names; -1 after an error */
static int read_point(ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  const ambulo_model *model = reader->model;
  const char *name = ambulo__yaml_name(node);
  const char **names = ambulo__reader_alloc(reader, (size_t)model->point_count, sizeof *names);
  char hint[100];
  if (!name[0] || !names) return -1;
  for (int i = 0; i < model->point_count; i++) {
    names[i] = model->points[i].name;
    if (strcmp(names[i], name) == 0) return i;
  }
  const char *nearest = ambulo__nearest(name, names, (size_t)model->point_count);
  if (nearest) (void)snprintf(hint, sizeof hint, "did you mean '%s'?", nearest);
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, nearest ? hint : NULL,
                           "unknown point (got '%s'); expected a point of the model", name);
  return -1;
}

static void read_hands(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                       ambulo_hold *hold) {
  int count = ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE) ? ambulo__yaml_items(node) : 0;
  if (count < 1 || count > 2) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "'hands' is not a list of one or two points of the model");
    return;
  }
  for (int i = 0; i < count; i++) hold->hand[i] = read_point(reader, ambulo__yaml_item(node, i));
}

static void read_vector(const ambulo__yaml_node *section, const char *key, double most,
                        double value[3]) {
  const ambulo__yaml_node *node = ambulo__yaml_get(section, key);
  if (!node || !ambulo__yaml_numbers(node, 3, value)) return;
  for (int k = 0; k < 3; k++) {
    if (fabs(value[k]) <= most) continue;
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL, "%g; expected -%g to %g", value[k], most,
                             most);
    value[k] = 0.0;
  }
}

/* behind those that are there; NULL without memory */
static ambulo_hold *add_hold(ambulo__problem_reader *reader) {
  ambulo_problem_definition *d = &reader->definition;
  size_t count = (size_t)d->hold_count;
  ambulo_hold *holds = ambulo__reader_alloc(reader, count + 1, sizeof *holds);
  if (!holds) return NULL;
  if (count > 0) memcpy(holds, d->holds, count * sizeof *holds);
  holds[count] = ambulo_hold_default();
  d->holds = holds;
  d->hold_count++;
  return &holds[count];
}

void ambulo__read_hold(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  ambulo_hold *hold = add_hold(reader);
  if (!hold) return;
  const ambulo__yaml_node *name = ambulo__yaml_get(section, "name");
  hold->name = name ? ambulo__yaml_name(name) : "load";
  read_hands(reader, ambulo__yaml_get(section, "hands"), hold);
  hold->mass = ambulo__yaml_number_in(ambulo__yaml_get(section, "mass"), 0.0, heaviest, 0.0);
  hold->inertia = ambulo__yaml_number_in(ambulo__yaml_get(section, "inertia"), 0.0, heaviest, 0.0);
  read_vector(section, "center", longest, hold->center);
  read_vector(section, "force", strongest, hold->force);
  read_vector(section, "size", longest, hold->size);
  hold->from = ambulo__yaml_number_in(ambulo__yaml_get(section, "from"), 0.0, longest_time, 0.0);
  hold->to = ambulo__yaml_number_in(ambulo__yaml_get(section, "to"), 0.0, longest_time, INFINITY);
  hold->ramp = ambulo__yaml_number_in(ambulo__yaml_get(section, "ramp"), shortest_ramp,
                                      longest_time, hold->ramp);
  ambulo__yaml_close(section);
}
