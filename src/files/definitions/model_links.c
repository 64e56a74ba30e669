/* definitions/model_links.c - `links` of a model file: tree, DH constants, coordinates, bodies. */
#include "definitions/model_reader.h"

#include <math.h>
#include <string.h>

static int is_world(const char *name) {
  return strcmp(name, "none") == 0 || strcmp(name, "world") == 0;
}

static void read_names(ambulo__reader *reader, const ambulo__yaml_node *list) {
  for (int i = 0; i < reader->definition.link_count; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(list, i);
    const char *name = ambulo__read_item_name(reader, item, AMBULO__LIST_LINKS, i);
    reader->links[i] = ambulo_link_default();
    reader->links[i].name = name;
    if (is_world(name)) {
      (void)ambulo__yaml_error(ambulo__yaml_get(item, "name"), AMBULO_E_MODEL, NULL,
                               "no link can be named '%s': it stands for the world", name);
    }
  }
}

/* Only one link hangs on the world; *root is its index, -1 before it is met. */
static void read_parent(ambulo__reader *reader, const ambulo__yaml_node *item, int index,
                        int *root) {
  const ambulo__yaml_node *node = ambulo__yaml_require(item, "parent");
  const char *name = ambulo__yaml_text(node);
  ambulo_link *link = &reader->links[index];
  if (!name[0]) return;
  if (!is_world(name)) {
    link->parent = ambulo__read_reference(reader, node, AMBULO__LIST_LINKS);
    return;
  }
  if (*root >= 0) {
    (void)ambulo__yaml_error(node, AMBULO_E_MODEL, "hang both on one fixed link",
                             "two roots: '%s' (line %d) and '%s' hang on the world; expected one",
                             reader->links[*root].name,
                             reader->place_of[AMBULO__LIST_LINKS][*root].line, link->name);
    return;
  }
  *root = index;
}

static void read_dh(ambulo__reader *reader, const ambulo__yaml_node *item, ambulo_link *link) {
  const ambulo__yaml_node *node = ambulo__yaml_get(item, "dh");
  if (!node && !ambulo__yaml_is(item, AMBULO__YAML_MAPPING)) return; /* said before */
  if (!node) {
    (void)ambulo__yaml_error(item, AMBULO_E_SCHEMA, NULL,
                             "link '%s' has no place; expected `dh`, or `origin` and `axis`",
                             link->name);
    return;
  }
  const ambulo__yaml_node *list = ambulo__by_sex(reader, node);
  double unused[4];
  if (!list) return;
  if (!ambulo__yaml_is(list, AMBULO__YAML_SEQUENCE) || ambulo__yaml_items(list) != 4) {
    (void)ambulo__yaml_numbers(list, 4, unused); /* says what is wrong */
    return;
  }
  link->theta = ambulo__read_angle(reader, ambulo__yaml_item(list, 0), reader->dh_angle);
  link->d = ambulo__read_scaled(reader, ambulo__yaml_item(list, 1), reader->length, 0);
  link->a = ambulo__read_scaled(reader, ambulo__yaml_item(list, 2), reader->length, 0);
  link->alpha = ambulo__read_angle(reader, ambulo__yaml_item(list, 3), reader->dh_angle);
}

static double sign_at(const ambulo__yaml_node *node) {
  static const char *const signs[] = {"1", "-1", "+1"};
  return ambulo__yaml_choice(node, signs, 3, 0) == 1 ? -1 : 1;
}

/* Inertia has the unit of the bodies', damping that of torque by rad/s, or of force by length. */
static void read_drive(ambulo__reader *reader, const ambulo__yaml_node *node,
                       ambulo_coordinate *coordinate) {
  int is_angle = coordinate->type == AMBULO_REVOLUTE;
  double torque = is_angle ? reader->moment : reader->force, length = reader->length;
  double inertia = is_angle ? reader->mass * length * length : reader->mass;
  const ambulo__yaml_node *armature = ambulo__yaml_get(node, "armature");
  const ambulo__yaml_node *damping = ambulo__yaml_get(node, "damping");
  const ambulo__yaml_node *friction = ambulo__yaml_get(node, "friction");
  if (armature) coordinate->armature = ambulo__read_scaled(reader, armature, inertia, 0);
  if (damping)
    coordinate->damping =
        ambulo__read_scaled(reader, damping, is_angle ? torque : torque / length, 0);
  if (friction) coordinate->friction = ambulo__read_scaled(reader, friction, torque, 0);
}

/* `node` may be NULL: a joint without limits, named after its link. */
static void read_coordinate(ambulo__reader *reader, const ambulo__yaml_node *node,
                            const ambulo_link *link, ambulo__place link_place) {
  int index = reader->definition.coordinate_count++;
  ambulo_coordinate *coordinate = &reader->coordinates[index];
  int is_angle = link->type == AMBULO_REVOLUTE;
  double unit = is_angle ? reader->angle : reader->length;
  *coordinate = ambulo_coordinate_default();
  coordinate->type = link->type;
  coordinate->name = link->name;
  reader->place_of[AMBULO__LIST_COORDINATES][index] = node ? ambulo__yaml_place(node) : link_place;
  const ambulo__yaml_node *name = ambulo__yaml_get(node, "name");
  if (name) coordinate->name = ambulo__yaml_name(name);
  reader->names[AMBULO__LIST_COORDINATES][index] = coordinate->name;
  ambulo__read_interval(reader, ambulo__yaml_get(node, "range"), unit, is_angle, coordinate->range);
  ambulo__read_interval(reader, ambulo__yaml_get(node, "speed"), unit, 0, coordinate->speed);
  ambulo__read_interval(reader, ambulo__yaml_get(node, "torque"),
                        is_angle ? reader->moment : reader->force, 0, coordinate->torque);
  read_drive(reader, node, coordinate);
  const ambulo__yaml_node *start = ambulo__yaml_get(node, "default");
  if (start)
    coordinate->default_value = is_angle ? ambulo__read_angle(reader, start, unit)
                                         : ambulo__read_scaled(reader, start, unit, 0);
  coordinate->actuated = ambulo__yaml_boolean(ambulo__yaml_get(node, "actuated"), 1);
  coordinate->mirror_sign = sign_at(ambulo__yaml_get(node, "mirror_sign"));
  ambulo__yaml_expect(node, "mirror");
  ambulo__yaml_close(node);
}

static void read_link(ambulo__reader *reader, const ambulo__yaml_node *item, int index, int *root) {
  static const char *const types[] = {"fixed", "revolute", "prismatic"};
  ambulo_link *link = &reader->links[index];
  int choice = ambulo__yaml_choice(ambulo__yaml_require(item, "joint"), types, 3, -1);
  link->type = choice == 1 ? AMBULO_REVOLUTE : choice == 2 ? AMBULO_PRISMATIC : AMBULO_FIXED;
  read_parent(reader, item, index, root);
  if (!ambulo__read_origin(reader, item, index)) read_dh(reader, item, link);
  ambulo__read_body(reader, item, link);
  const ambulo__yaml_node *coordinate = ambulo__yaml_get(item, "coordinate");
  const ambulo__yaml_node *coupled = ambulo__yaml_get(item, "coupled");
  if (coupled) {
    if (coordinate || (link->type == AMBULO_FIXED && choice == 0))
      (void)ambulo__yaml_error(coupled, AMBULO_E_SCHEMA, NULL,
                               "link '%s' is coupled and %s; expected a joint that moves, without "
                               "a coordinate of its own",
                               link->name, coordinate ? "has a coordinate" : "fixed");
  } else if (link->type != AMBULO_FIXED) {
    read_coordinate(reader, coordinate, link, reader->place_of[AMBULO__LIST_LINKS][index]);
  } else if (coordinate && choice == 0) {
    (void)ambulo__yaml_error(coordinate, AMBULO_E_SCHEMA, NULL,
                             "link '%s' is fixed; expected no coordinate", link->name);
  }
  ambulo__yaml_close(item);
}

/* Mirror images, and what joints follow, can be resolved once all coordinates have names. */
static void read_mirrors(ambulo__reader *reader, const ambulo__yaml_node *list) {
  for (int i = 0, index = 0; i < reader->definition.link_count; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(list, i);
    const ambulo__yaml_node *coupled = ambulo__yaml_get(item, "coupled");
    if (coupled) ambulo__read_coupling(reader, coupled, &reader->links[i]);
    if (coupled || reader->links[i].type == AMBULO_FIXED) continue;
    const ambulo__yaml_node *coordinate = ambulo__yaml_get(item, "coordinate");
    reader->coordinates[index++].mirror = ambulo__read_reference(
        reader, ambulo__yaml_get(coordinate, "mirror"), AMBULO__LIST_COORDINATES);
  }
}

void ambulo__read_links(ambulo__reader *reader, const ambulo__yaml_node *list) {
  int root = -1;
  read_names(reader, list);
  for (int i = 0; i < reader->definition.link_count; i++) {
    read_link(reader, ambulo__yaml_item(list, i), i, &root);
  }
  read_mirrors(reader, list);
}

/* ------------------------------------------------------------------------- bodies */

/* gyration [x, y, z]: radii about the axes of the link through the centre of mass,
 * I_xx = m k_x^2 and so on, no products. */
static int read_inertia(ambulo__reader *reader, const ambulo__yaml_node *node,
                        const ambulo__yaml_node *inertia, const ambulo__yaml_node *gyration,
                        ambulo__part *part) {
  if ((inertia == NULL) == (gyration == NULL)) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, "a point mass has `gyration: [0, 0, 0]`",
                             "a body has %s; expected one of `inertia` and `gyration`",
                             inertia ? "both" : "no inertia");
    return 0;
  }
  if (inertia) {
    double unit = reader->mass * reader->length * reader->length;
    return ambulo__read_vector(reader, inertia, 6, unit, part->inertia);
  }
  double radius[3];
  if (!ambulo__read_vector(reader, gyration, 3, reader->length, radius)) return 0;
  for (int i = 0; i < 3; i++) part->inertia[i] = part->mass * radius[i] * radius[i];
  return 1;
}

static void read_part(ambulo__reader *reader, const ambulo__yaml_node *node, const char *owner,
                      ambulo__part *whole) {
  ambulo__part part = {0};
  const ambulo__yaml_node *name = ambulo__yaml_get(node, "name");
  const ambulo__yaml_node *mass = ambulo__yaml_require(node, "mass");
  const ambulo__yaml_node *com = ambulo__yaml_require(node, "com");
  const ambulo__yaml_node *inertia = ambulo__yaml_get(node, "inertia");
  const ambulo__yaml_node *gyration = ambulo__yaml_get(node, "gyration");
  const char *what = name ? ambulo__yaml_name(name) : owner;
  ambulo__yaml_close(node);
  if (!mass || !com) return;
  part.mass = ambulo__read_scaled(reader, mass, reader->mass, NAN);
  int good = ambulo__read_vector(reader, com, 3, reader->length, part.com);
  good &= read_inertia(reader, node, inertia, gyration, &part);
  if (!good || isnan(part.mass)) return; /* reported already */
  ambulo__body_places places = {ambulo__yaml_place(mass),
                                ambulo__yaml_place(inertia ? inertia : gyration)};
  ambulo_status status = ambulo__check_body(what[0] ? what : owner, part.mass, part.com,
                                            part.inertia, places, reader->diagnostics);
  if (status == AMBULO_OK) {
    ambulo__part_add(whole, &part);
  } else if (reader->status == AMBULO_OK) {
    reader->status = status;
  }
}

void ambulo__read_body(ambulo__reader *reader, const ambulo__yaml_node *link_node,
                       ambulo_link *link) {
  const ambulo__yaml_node *body = ambulo__yaml_get(link_node, "body");
  const ambulo__yaml_node *bodies = ambulo__yaml_get(link_node, "bodies");
  ambulo__part whole = {0};
  int count = 0;
  if (body && bodies) {
    (void)ambulo__yaml_error(bodies, AMBULO_E_SCHEMA, NULL,
                             "link '%s' has `body` and `bodies`; expected one of them", link->name);
    return;
  }
  if (body) read_part(reader, body, link->name, &whole);
  if (!ambulo__read_count(bodies, "bodies", AMBULO__MAX_PARTS, &count)) return;
  for (int i = 0; i < count; i++) {
    read_part(reader, ambulo__yaml_item(bodies, i), link->name, &whole);
  }
  link->mass = whole.mass;
  for (int i = 0; i < 3; i++) link->com[i] = whole.com[i];
  for (int i = 0; i < 6; i++) link->inertia[i] = whole.inertia[i];
}
