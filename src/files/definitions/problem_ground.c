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

/* the prescribed split between two feet, which earlier versions had */
static void refuse_split(const ambulo__yaml_node *section, const ambulo__yaml_node *kind) {
  static const char *const keys[] = {"transfer", "exponent", "shear"};
  for (int i = 0; i < 3; i++) (void)ambulo__yaml_get(section, keys[i]);
  (void)ambulo__yaml_error(kind, AMBULO_E_SCHEMA,
                           "write 'kind: shared', and leave out transfer, exponent and shear",
                           "the prescribed split of the load is no longer a law (got 'two_step'); "
                           "expected shared or none");
}

static ambulo_reaction_kind read_kind(const ambulo__yaml_node *section) {
  static const char *const kinds[] = {"none", "shared"};
  const ambulo__yaml_node *kind = ambulo__yaml_get(section, "kind");
  if (strcmp(ambulo__yaml_text(kind), "two_step") != 0)
    return (ambulo_reaction_kind)ambulo__yaml_choice(kind, kinds, 2, AMBULO_REACTION_SHARED);
  refuse_split(section, kind);
  return AMBULO_REACTION_SHARED;
}

static void read_reaction(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  ambulo_problem_definition *d = &reader->definition;
  ambulo_ground_reaction *r = &d->ground_reaction;
  if (!section) return;
  r->kind = read_kind(section);
  ambulo__read_members(reader, section, &ambulo__ground_reaction_members, "", r);
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
