/* definitions/problem_constraints.c - `constraints:` and `ends:` of a problem file. */
#include "definitions/problem_reader.h"

#include <math.h>

/* ---------------------------------------------------------------- constraints */

static void read_strike_pitch(ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  double *pitch = reader->definition.strike_pitch;
  if (!node) return;
  if (!ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE) || ambulo__yaml_items(node) != 2) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "'strike_pitch' is not a list of two angles");
    return;
  }
  for (int i = 0; i < 2; i++)
    pitch[i] = ambulo__read_plain_angle(reader, ambulo__yaml_item(node, i), 0.0);
  if (pitch[0] < pitch[1] && fabs(pitch[0]) < 1.5 && fabs(pitch[1]) < 1.5) return;
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL,
                           "from %g to %g rad; expected two rising angles of less than 1.5 rad",
                           pitch[0], pitch[1]);
}

void ambulo__read_constraints(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  ambulo_problem_definition *d = &reader->definition;
  if (!section) return;
  ambulo__read_members(reader, section, &ambulo__definition_members, "constraints.", d);
  read_strike_pitch(reader, ambulo__yaml_get(section, "strike_pitch"));
  const ambulo__yaml_node *clearance = ambulo__reader_section(section, "clearance");
  if (clearance)
    ambulo__read_members(reader, clearance, &ambulo__clearance_members, "", &d->clearance);
  ambulo__yaml_close(clearance);
  ambulo__yaml_expect(section, "tubes");     /* read with the schedule known */
  ambulo__yaml_expect(section, "collision"); /* with the model known */
  ambulo__yaml_expect(section, "reach");
  ambulo__yaml_close(section);
}

/* ----------------------------------------------------------------------- ends */

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
  ambulo__read_members(reader, section, &ambulo__definition_members, "ends.", d);
  const ambulo__yaml_node *given = ambulo__yaml_get(section, "kind");
  int kind = ambulo__yaml_choice(given, kinds, 3, given ? -1 : 0); /* -1: that was said */
  d->ends = kind < 0 ? AMBULO_ENDS_FREE : (ambulo_ends)kind;
  check_steps(reader, ambulo__yaml_get(section, "kind"));
  reader->keys.travel = ambulo__yaml_get(section, "travel") != NULL;
  if (kind == 0) check_idle(section, d->rise);
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
