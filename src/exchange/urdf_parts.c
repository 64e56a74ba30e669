/* exchange/urdf_parts.c - joints, inertial frames and collision geometry of a URDF (urdf.c). */
#include "exchange/urdf_parts.h"

#include <math.h>
#include <string.h>

#include "base/numtext.h"

const char *ambulo__urdf_name(const ambulo__xml_node *node) {
  const char *name = ambulo__xml_attribute(node, "name");
  return name ? name : "";
}

/* <origin xyz rpy> of a node */
static ambulo__rigid origin_of(ambulo__xml *xml, const ambulo__xml_node *node) {
  const ambulo__xml_node *origin = ambulo__xml_child(node, "origin");
  double xyz[3] = {0, 0, 0}, rpy[3] = {0, 0, 0};
  (void)ambulo__xml_vector(xml, origin, "xyz", 3, xyz);
  (void)ambulo__xml_vector(xml, origin, "rpy", 3, rpy);
  return ambulo__rigid_of_rpy(xyz, rpy);
}

/* ------------------------------------------------------------------------ joints */

static void read_limits(ambulo__xml *xml, const ambulo__xml_node *joint, int ranged,
                        ambulo_coordinate *c) {
  const ambulo__xml_node *limit = ambulo__xml_child(joint, "limit");
  double lower = 0.0, upper = 0.0, most = 0.0;
  if (ranged && limit) {
    (void)ambulo__xml_vector(xml, limit, "lower", 1, &lower);
    (void)ambulo__xml_vector(xml, limit, "upper", 1, &upper);
    if (lower > upper)
      ambulo__xml_error(xml, limit, AMBULO_E_MODEL, NULL,
                        "limits of joint '%.60s' contradict each other (got %s to %s); expected "
                        "lower <= upper",
                        ambulo__urdf_name(joint), ambulo__number_text(lower).text,
                        ambulo__number_text(upper).text);
    c->range[0] = lower;
    c->range[1] = upper;
  }
  if (ambulo__xml_vector(xml, limit, "velocity", 1, &most) && most > 0.0) {
    c->speed[0] = -most;
    c->speed[1] = most;
  }
  most = 0.0;
  if (ambulo__xml_vector(xml, limit, "effort", 1, &most) && most > 0.0) {
    c->torque[0] = -most;
    c->torque[1] = most;
  }
}

/* two directions across the axis, the first as near to x as can be */
static void across(const double axis[3], double first[3], double second[3]) {
  int k = fabs(axis[0]) < 0.9 ? 0 : 1;
  for (int i = 0; i < 3; i++) first[i] = (i == k) - axis[k] * axis[i];
  (void)ambulo__normalize(first);
  for (int i = 0; i < 3; i++)
    second[i] = axis[(i + 1) % 3] * first[(i + 2) % 3] - axis[(i + 2) % 3] * first[(i + 1) % 3];
}

static void add_planar(ambulo__chain *chain, const double axis[3], const char *name) {
  double first[3], second[3];
  ambulo__arena *arena = chain->tree->arena;
  across(axis, first, second);
  (void)ambulo__chain_joint(chain, AMBULO_PRISMATIC, first,
                            ambulo__arena_print(arena, "%.50s_first", name));
  (void)ambulo__chain_joint(chain, AMBULO_PRISMATIC, second,
                            ambulo__arena_print(arena, "%.50s_second", name));
  (void)ambulo__chain_joint(chain, AMBULO_REVOLUTE, axis,
                            ambulo__arena_print(arena, "%.50s_turn", name));
}

/* the joint beside this one that has a name; NULL */
static const ambulo__xml_node *joint_named(const ambulo__xml_node *beside, const char *name) {
  const ambulo__xml_node *n = ambulo__xml_child(beside->parent, "joint");
  while (n && strcmp(ambulo__urdf_name(n), name) != 0) n = ambulo__xml_next(n, "joint");
  return n;
}

/* The value at which a joint with <mimic> is held. */
static double follow(ambulo__tree *tree, const ambulo__xml_node *joint,
                     const ambulo__xml_node *mimic) {
  const char *leader = ambulo__xml_attribute(mimic, "joint"), *name = ambulo__urdf_name(joint);
  double multiplier = 1.0, offset = 0.0;
  if (!leader) {
    ambulo__xml_error(tree->xml, mimic, AMBULO_E_SCHEMA, NULL,
                      "<mimic> of joint '%.60s' names no joint; expected joint=...", name);
    return 0.0;
  }
  (void)ambulo__xml_vector(tree->xml, mimic, "multiplier", 1, &multiplier);
  (void)ambulo__xml_vector(tree->xml, mimic, "offset", 1, &offset);
  double stands = ambulo__tree_pose(tree, leader, 0.0), range[2] = {stands, stands};
  double value = multiplier * stands + offset;
  const ambulo__xml_node *limit = ambulo__xml_child(joint_named(joint, leader), "limit");
  (void)ambulo__xml_vector(tree->xml, limit, "lower", 1, &range[0]);
  (void)ambulo__xml_vector(tree->xml, limit, "upper", 1, &range[1]);
  double most = fabs(multiplier) * fmax(fabs(range[0] - stands), fabs(range[1] - stands));
  ambulo__tree_note(tree, joint,
                    "%s follows %s (times %s plus %s): it is held at %s; it would move by up to %s "
                    "(rad or m) over the range of that",
                    name, leader, ambulo__number_text(multiplier).text,
                    ambulo__number_text(offset).text, ambulo__number_text(value).text,
                    ambulo__three_digits(most).text);
  return value;
}

static void hold(ambulo__chain *chain, const double axis[3], int slides, double value) {
  double shift[3] = {value * axis[0], value * axis[1], value * axis[2]};
  ambulo__rigid held = slides ? ambulo__rigid_shift(shift) : ambulo__rigid_turn(axis, value);
  ambulo__chain_place(chain, &held);
}

static int read_axis(ambulo__xml *xml, const ambulo__xml_node *joint, double axis[3]) {
  const ambulo__xml_node *node = ambulo__xml_child(joint, "axis");
  (void)ambulo__xml_vector(xml, node, "xyz", 3, axis);
  if (ambulo__normalize(axis) > 1e-9) return 1;
  ambulo__xml_error(xml, node, AMBULO_E_MODEL, NULL,
                    "the axis of joint '%.60s' has no direction (got 0 0 0); expected a vector",
                    ambulo__urdf_name(joint));
  return 0;
}

enum { REVOLUTE, CONTINUOUS, PRISMATIC, FIXED, FLOATING, PLANAR, TYPES };

static int one_coordinate(ambulo__chain *chain, int type, const ambulo__xml_node *joint,
                          const double axis[3]) {
  ambulo__tree *tree = chain->tree;
  const char *name = ambulo__urdf_name(joint);
  const ambulo__xml_node *mimic = ambulo__xml_child(joint, "mimic");
  if (mimic) {
    hold(chain, axis, type == PRISMATIC, follow(tree, joint, mimic));
    return 1;
  }
  int link = ambulo__chain_joint(chain, type == PRISMATIC ? AMBULO_PRISMATIC : AMBULO_REVOLUTE,
                                 axis, name);
  if (link < 0) return 0;
  read_limits(tree->xml, joint, type != CONTINUOUS, &tree->links[link].coordinate);
  tree->links[link].coordinate.default_value = ambulo__tree_pose(tree, name, 0.0);
  return 1;
}

int ambulo__urdf_joint(ambulo__tree *tree, int parent, const ambulo__xml_node *joint,
                       const char *child) {
  static const char *const types[TYPES] = {"revolute", "continuous", "prismatic",
                                           "fixed",    "floating",   "planar"};
  const char *word = ambulo__xml_attribute(joint, "type");
  int type = ambulo__xml_choice(tree->xml, joint, "type of joint", word ? word : "", types, TYPES);
  double axis[3] = {1, 0, 0};
  if (type < 0 || (type != FIXED && type != FLOATING && !read_axis(tree->xml, joint, axis)))
    return -1;
  ambulo__chain chain = ambulo__chain_begin(tree, parent, joint);
  ambulo__rigid origin = origin_of(tree->xml, joint);
  ambulo__chain_place(&chain, &origin);
  const char *name = ambulo__urdf_name(joint);
  if (type == FLOATING) ambulo__chain_free(&chain, name);
  if (type == PLANAR) add_planar(&chain, axis, name);
  if (type <= PRISMATIC && !one_coordinate(&chain, type, joint, axis)) return -1;
  return ambulo__chain_end(&chain, child);
}

/* ------------------------------------------------------------------------- links */

static void read_inertial(ambulo__tree *tree, int link, const ambulo__xml_node *node,
                          const char *name) {
  static const char *const entries[] = {"ixx", "iyy", "izz", "ixy", "ixz", "iyz"};
  ambulo__xml *xml = tree->xml;
  const ambulo__xml_node *mass = ambulo__xml_child(node, "mass");
  const ambulo__xml_node *inertia = ambulo__xml_child(node, "inertia");
  ambulo__rigid frame = origin_of(xml, node);
  ambulo__part part = {0};
  double entry[6] = {0};
  if (!mass || !ambulo__xml_attribute(mass, "value")) {
    ambulo__xml_error(xml, node, AMBULO_E_SCHEMA, NULL,
                      "<inertial> of link '%.60s' has no mass; expected <mass value=...>", name);
    return;
  }
  (void)ambulo__xml_vector(xml, mass, "value", 1, &part.mass);
  if (!inertia && part.mass > 0.0) {
    ambulo__xml_error(xml, node, AMBULO_E_SCHEMA, NULL,
                      "<inertial> of link '%.60s' has a mass but no inertia; expected <inertia ixx "
                      "ixy ixz iyy iyz izz>",
                      name);
    return;
  }
  for (int i = 0; i < 6; i++) {
    if (!inertia || ambulo__xml_attribute(inertia, entries[i])) {
      (void)ambulo__xml_vector(xml, inertia, entries[i], 1, &entry[i]);
    } else if (i < 3) {
      ambulo__xml_error(xml, inertia, AMBULO_E_SCHEMA, NULL,
                        "<inertia> of link '%.60s' has no %s; expected six numbers", name,
                        entries[i]);
    }
  }
  memcpy(part.com, frame.p, sizeof part.com);
  ambulo__inertia_turn((const double(*)[3])frame.r, entry, part.inertia);
  ambulo__tree_body(tree, link, &part, mass, inertia ? inertia : node);
}

static void read_collision(ambulo__tree *tree, int link, const ambulo__xml_node *node) {
  const ambulo__xml_node *geometry = ambulo__xml_child(node, "geometry");
  const ambulo__xml_node *shape = geometry ? geometry->first : NULL;
  ambulo__tree_solid solid = {.link = link, .at = origin_of(tree->xml, node)};
  double length = 0.0;
  if (!shape) return;
  if (ambulo__xml_is(shape, "box")) {
    solid.shape = AMBULO__BOX;
    if (!ambulo__xml_vector(tree->xml, shape, "size", 3, solid.size)) return;
    for (int i = 0; i < 3; i++) solid.size[i] *= 0.5;
  } else if (ambulo__xml_is(shape, "sphere")) {
    solid.shape = AMBULO__SPHERE;
    if (!ambulo__xml_vector(tree->xml, shape, "radius", 1, solid.size)) return;
  } else if (ambulo__xml_is(shape, "cylinder") || ambulo__xml_is(shape, "capsule")) {
    solid.shape = ambulo__xml_is(shape, "capsule") ? AMBULO__CAPSULE : AMBULO__CYLINDER;
    if (!ambulo__xml_vector(tree->xml, shape, "radius", 1, solid.size) ||
        !ambulo__xml_vector(tree->xml, shape, "length", 1, &length))
      return;
    solid.size[1] = 0.5 * length;
  } else {
    solid.shape = AMBULO__MESH;
    solid.mesh =
        ambulo__mesh_named(tree->arena, tree->path, ambulo__xml_attribute(shape, "filename"));
    if (solid.mesh) (void)ambulo__xml_vector(tree->xml, shape, "scale", 3, solid.mesh->scale);
  }
  ambulo__tree_add_solid(tree, &solid);
}

void ambulo__urdf_link(ambulo__tree *tree, int link, const ambulo__xml_node *node) {
  const ambulo__xml_node *inertial = ambulo__xml_child(node, "inertial");
  if (inertial) read_inertial(tree, link, inertial, ambulo__urdf_name(node));
  for (const ambulo__xml_node *n = ambulo__xml_child(node, "collision"); n;
       n = ambulo__xml_next(n, "collision"))
    read_collision(tree, link, n);
}

void ambulo__urdf_leftovers(ambulo__tree *tree, const ambulo__xml_node *root) {
  int damped = 0, unlimited = 0;
  for (const ambulo__xml_node *n = ambulo__xml_child(root, "joint"); n;
       n = ambulo__xml_next(n, "joint")) {
    const ambulo__xml_node *dynamics = ambulo__xml_child(n, "dynamics");
    double damping = 0.0, friction = 0.0;
    (void)ambulo__xml_vector(tree->xml, dynamics, "damping", 1, &damping);
    (void)ambulo__xml_vector(tree->xml, dynamics, "friction", 1, &friction);
    damped += damping != 0.0 || friction != 0.0;
    const char *type = ambulo__xml_attribute(n, "type");
    int limited = type && (strcmp(type, "revolute") == 0 || strcmp(type, "prismatic") == 0);
    unlimited += limited && !ambulo__xml_child(n, "limit") && !ambulo__xml_child(n, "mimic");
  }
  if (damped)
    ambulo__tree_note(tree, root, "damping and friction of %d joints are left out", damped);
  if (unlimited)
    ambulo__tree_note(tree, root, "%d joints have no <limit>: their coordinates have no range",
                      unlimited);
}
