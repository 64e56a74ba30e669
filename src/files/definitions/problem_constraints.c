/* definitions/problem_constraints.c - `constraints:` and `ends:` of a problem file. */
#include "definitions/problem_reader.h"

#include <math.h>

/* ---------------------------------------------------------------- constraints */

/* a number, or the word `off`: no row */
static double read_minimum_force(const ambulo__yaml_node *node) {
  static const char *const words[] = {"off"};
  const char *text = ambulo__yaml_text(node);
  if (!text[0]) return AMBULO_OFF;
  if (text[0] == 'o') {
    (void)ambulo__yaml_choice(node, words, 1, 0);
    return AMBULO_OFF;
  }
  return ambulo__yaml_number_in(node, 0.0, 100.0, AMBULO_OFF);
}

void ambulo__read_constraints(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  static const char *const supports[] = {"off", "box", "hull"};
  static const char *const limits[] = {"off", "nodes", "control_points"};
  ambulo_problem_definition *d = &reader->definition;
  if (!section) return;
  d->ground_height =
      ambulo__yaml_number_in(ambulo__yaml_get(section, "ground_height"), -1e3, 1e3, 0.0);
  d->ground_penetration = ambulo__yaml_boolean(ambulo__yaml_get(section, "ground_penetration"), 0);
  d->foot_strike = ambulo__yaml_boolean(ambulo__yaml_get(section, "foot_strike"), 0);
  int support = ambulo__yaml_choice(ambulo__yaml_get(section, "zmp"), supports, 3, 0);
  d->support = (ambulo_support)support;
  d->support_margin =
      ambulo__yaml_number_in(ambulo__yaml_get(section, "zmp_margin"), 0.0, 10.0, 0.0);
  d->minimum_force = read_minimum_force(ambulo__yaml_get(section, "minimum_force"));
  int joint_limits = ambulo__yaml_choice(ambulo__yaml_get(section, "joint_limits"), limits, 3, 0);
  d->joint_limits = (ambulo_limit_mode)joint_limits;
  d->speed_limits = ambulo__yaml_boolean(ambulo__yaml_get(section, "speed_limits"), 0);
  d->torque_limits = ambulo__yaml_boolean(ambulo__yaml_get(section, "torque_limits"), 0);
  ambulo__read_contact_rows(reader, section);
  ambulo__yaml_expect(section, "tubes");     /* read with the schedule known */
  ambulo__yaml_expect(section, "collision"); /* with the model known */
  ambulo__yaml_expect(section, "reach");
  ambulo__yaml_close(section);
}

/* ----------------------------------------------------------------------- ends */

double ambulo__read_coordinate_value(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                                     int i) {
  const ambulo_coordinate *c = ambulo_model_coordinate(reader->model, i);
  double value = ambulo__yaml_number(node, 0.0);
  if (c->type != AMBULO_REVOLUTE) return value;
  if (reader->radians == 0.0) {
    if (!reader->asked_for_unit) {
      (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                               "'%s' is an angle, but the file does not state its unit; expected "
                               "'angles: degrees' or 'angles: radians'",
                               c->name);
    }
    reader->asked_for_unit = 1;
    return 0.0;
  }
  if (reader->radians == 1.0 && fabs(value) > 6.2832) {
    ambulo__yaml_warning(node, "write 'angles: degrees' if these are degrees",
                         "%g for '%s' is more than a whole turn in radians", value, c->name);
  }
  return reader->radians * value;
}

typedef struct end_list {
  ambulo_end_value *values;
  int count;
} end_list;

/* one mapping of coordinate names to values, `default` for those not named; all names of the model
 * are known keys */
static void read_values(ambulo__problem_reader *reader, const ambulo__yaml_node *section,
                        const char *key, int final, int order, end_list *list) {
  const ambulo__yaml_node *mapping = ambulo__reader_section(section, key);
  if (!mapping) return;
  const ambulo__yaml_node *others = ambulo__yaml_get(mapping, "default");
  for (int i = 0; i < ambulo_model_coordinate_count(reader->model); i++) {
    const ambulo__yaml_node *node =
        ambulo__yaml_get(mapping, ambulo_model_coordinate(reader->model, i)->name);
    if (!node) node = others;
    if (!node) continue;
    ambulo_end_value value = {.coordinate = i, .order = order, .final = final};
    value.value = ambulo__read_coordinate_value(reader, node, i);
    list->values[list->count++] = value;
  }
  ambulo__yaml_close(mapping);
}

/* Feet alternate: after an odd number of steps the other one leads, and the motion can only go on
 * as its mirror image; after an even number as itself. */
static void check_steps(const ambulo__problem_reader *reader, const ambulo__yaml_node *kind) {
  ambulo_ends ends = reader->definition.ends;
  int odd = reader->steps % 2;
  if (reader->steps == 0 || ends == AMBULO_ENDS_FREE) return;
  if (odd != (ends == AMBULO_ENDS_MIRRORED))
    (void)ambulo__yaml_error(kind, AMBULO_E_PROBLEM,
                             odd ? "ends: {kind: mirrored}, or an even number of steps"
                                 : "ends: {kind: periodic}, or an odd number of steps",
                             "%s ends with %d step%s; expected an %s number, after which %s",
                             odd ? "periodic" : "mirrored", reader->steps,
                             reader->steps == 1 ? "" : "s", odd ? "even" : "odd",
                             odd ? "the same foot strikes again" : "the other foot strikes");
  else if (odd && reader->unlike_steps)
    (void)ambulo__yaml_error(kind, AMBULO_E_PROBLEM,
                             "ends: {kind: periodic} with an even number of steps",
                             "mirrored ends make each step the mirror image of the one before, but "
                             "the gait has steps of two lengths or times; expected equal steps");
}

/* keys of ends that match: a height is not given for nothing, an order may stay in the file */
static void check_idle(const ambulo__yaml_node *section, double rise) {
  const ambulo__yaml_node *order = ambulo__yaml_get(section, "order");
  if (order)
    ambulo__yaml_warning(order, NULL,
                         "'order' has no effect with free ends; it belongs to kind "
                         "periodic or mirrored");
  if (rise != 0.0)
    (void)ambulo__yaml_error(ambulo__yaml_get(section, "rise"), AMBULO_E_PROBLEM, NULL,
                             "a rise of %g m with free ends, which do nothing with it; expected "
                             "'kind: periodic' or 'kind: mirrored' beside it",
                             rise);
}

void ambulo__read_ends(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  static const char *const kinds[] = {"free", "periodic", "mirrored"};
  ambulo_problem_definition *d = &reader->definition;
  if (!section) return;
  const ambulo__yaml_node *given = ambulo__yaml_get(section, "kind");
  int kind = ambulo__yaml_choice(given, kinds, 3, given ? -1 : 0); /* -1: that was said */
  d->ends = kind < 0 ? AMBULO_ENDS_FREE : (ambulo_ends)kind;
  check_steps(reader, ambulo__yaml_get(section, "kind"));
  d->ends_order = ambulo__yaml_integer(ambulo__yaml_get(section, "order"), 0, 2, 1);
  reader->keys.travel = ambulo__yaml_get(section, "travel") != NULL;
  d->rise = ambulo__yaml_number_in(ambulo__yaml_get(section, "rise"), -1e6, 1e6, 0.0);
  if (kind == 0) check_idle(section, d->rise);
  d->travel = ambulo__yaml_number_in(ambulo__yaml_get(section, "travel"), -1e6, 1e6, d->travel);
  size_t coordinates = (size_t)ambulo_model_coordinate_count(reader->model);
  end_list list = {ambulo__reader_alloc(reader, 6 * coordinates, sizeof(ambulo_end_value)), 0};
  if (!list.values) return;
  read_values(reader, section, "initial", 0, 0, &list);
  read_values(reader, section, "initial_speed", 0, 1, &list);
  read_values(reader, section, "initial_acceleration", 0, 2, &list);
  read_values(reader, section, "final", 1, 0, &list);
  read_values(reader, section, "final_speed", 1, 1, &list);
  read_values(reader, section, "final_acceleration", 1, 2, &list);
  d->end_values = list.values;
  d->end_value_count = list.count;
  ambulo__yaml_close(section);
}
