/* definitions/problem_ground.c - `ground`, `load` and `ground_reaction` of a problem file, and the
 * parts of `constraints` that go with them: tolerances of the contacts, clearance. */
#include "definitions/problem_reader.h"

#include "model/conditions.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ------------------------------------------------------------ ground and load */

static void read_slope(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  if (!section) return;
  const ambulo__yaml_node *node = ambulo__yaml_get(section, "slope");
  double slope = ambulo__read_plain_angle(reader, node, 0.0);
  if (fabs(slope) > AMBULO__LARGEST_SLOPE)
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "a slope of %g rad; expected -%g to %g rad", slope,
                             AMBULO__LARGEST_SLOPE, AMBULO__LARGEST_SLOPE);
  else if (slope != 0.0)
    ambulo__model_tilt(reader->model, slope);
  ambulo__yaml_close(section);
}

static void read_one_load(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  double position[3] = {0.0, 0.0, 0.0};
  if (ambulo__yaml_get(section, "hands")) {
    ambulo__read_hold(reader, section);
    return;
  }
  int link =
      ambulo__read_name_of(reader, ambulo__yaml_require(section, "link"), AMBULO__NAMED_LINK);
  double mass = ambulo__yaml_number_in(ambulo__yaml_require(section, "mass"), 1e-6, 1000.0, 1.0);
  int placed = ambulo__yaml_numbers(ambulo__yaml_require(section, "position"), 3, position);
  ambulo__yaml_close(section);
  if (link >= 0 && placed) ambulo__model_carry(reader->model, link, mass, position);
}

/* one mapping, or a list of them */
static void read_load(ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  if (!node) return;
  reader->keys.loads = ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE);
  if (!reader->keys.loads) {
    read_one_load(reader, node);
    return;
  }
  int count = ambulo__yaml_items(node);
  if (count < 1 || count > AMBULO__MOST_LOADS) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL, "%d loads; expected 1 to %d", count,
                             AMBULO__MOST_LOADS);
    return;
  }
  for (int i = 0; i < count; i++) {
    int on_links = reader->model->load_count, in_hands = reader->definition.hold_count;
    read_one_load(reader, ambulo__yaml_item(node, i));
    if (reader->definition.hold_count > in_hands) reader->keys.hold_item[in_hands] = i;
    if (reader->model->load_count > on_links) reader->keys.load_item[on_links] = i;
  }
}

/* ------------------------------------------------------------ ground reaction */

static void read_pressure(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                          ambulo_ground_reaction *r) {
  static const char *const words[] = {"off", "on"};
  if (!node) return;
  if (ambulo__yaml_is(node, AMBULO__YAML_SCALAR)) {
    r->pressure = ambulo__yaml_choice(node, words, 2, 1);
    return;
  }
  ambulo__read_members(reader, node, &ambulo__ground_reaction_members, "pressure.", r);
  ambulo__yaml_close(node);
}

/* a law has numbers of its own; those of the other one may stay in the file */
static void warn_of_others(const ambulo__yaml_node *section, int kind) {
  static const char *const kinds[] = {"none", "two_step", "shared"};
  static const struct {
    const char *key;
    int kind;
  } own[] = {{"transfer", AMBULO_REACTION_TWO_STEP},      {"exponent", AMBULO_REACTION_TWO_STEP},
             {"shear", AMBULO_REACTION_TWO_STEP},         {"moment_arm", AMBULO_REACTION_SHARED},
             {"slant", AMBULO_REACTION_SHARED},           {"loading_rate", AMBULO_REACTION_SHARED},
             {"flight_tolerance", AMBULO_REACTION_SHARED}};
  for (size_t i = 0; i < sizeof own / sizeof *own; i++) {
    const ambulo__yaml_node *node = ambulo__yaml_get(section, own[i].key);
    if (!node || kind == AMBULO_REACTION_NONE || kind == own[i].kind) continue;
    ambulo__yaml_warning(node, NULL, "'%s' has no effect with kind %s; it belongs to kind %s",
                         own[i].key, kinds[kind], kinds[own[i].kind]);
  }
}

static void read_reaction(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  static const char *const kinds[] = {"none", "two_step", "shared"};
  ambulo_problem_definition *d = &reader->definition;
  ambulo_ground_reaction *r = &d->ground_reaction;
  if (!section) return;
  const ambulo__yaml_node *given = ambulo__yaml_get(section, "kind");
  int kind = ambulo__yaml_choice(given, kinds, 3, given ? -1 : AMBULO_REACTION_TWO_STEP);
  if (kind >= 0) warn_of_others(section, kind);
  if (kind < 0) kind = AMBULO_REACTION_TWO_STEP; /* that was said */
  r->kind = (ambulo_reaction_kind)kind;
  ambulo__read_members(reader, section, &ambulo__ground_reaction_members, "", r);
  int is_split = kind == AMBULO_REACTION_TWO_STEP;
  if (is_split && !(d->minimum_force >= 0.0)) d->minimum_force = 0.2;
  ambulo__read_member(reader, ambulo__yaml_get(section, "minimum_force"),
                      &ambulo__definition_members, "constraints.minimum_force", d);
  read_pressure(reader, ambulo__yaml_get(section, "pressure"), r);
  ambulo__yaml_close(section);
}

void ambulo__read_ground(ambulo__problem_reader *reader, const ambulo__yaml_node *root) {
  read_slope(reader, ambulo__reader_section(root, "ground"));
  read_load(reader, ambulo__yaml_get(root, "load"));
  read_reaction(reader, ambulo__reader_section(root, "ground_reaction"));
}
