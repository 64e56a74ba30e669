/* import/urdf.c - URDF: <robot> with <link>s and <joint>s.
 *
 * A joint places its child in its parent by <origin> and moves it about or along <axis>, given in
 * the child's frame; a link's <inertial> has a frame of its own, in whose axes the inertia about
 * the centre of mass is given. Angles are radians, fixed-axis roll, pitch and yaw. The world's z is
 * up, x forward (REP 103). Links are numbered from the root, each subtree whole, in the order of
 * the joints of the file.
 *
 *   revolute, continuous, prismatic   one coordinate, named after the joint
 *   fixed                             none
 *   planar                            two sliders across the axis, then a hinge about it
 *   floating                          three sliders and three hinges (body_tree.c)
 *   with <mimic>                      none: it follows the coordinate of the other joint
 */
#include "base/numtext.h"
#include "base/arithmetic.h"
#include "import/body_tree.h"
#include "model/model_check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct urdf_link {
  const char *name;
  const ambulo__xml_node *node;
  const ambulo__xml_node *joint; /* whose child it is; NULL: a root */
  int parent, reached;
} urdf_link;

typedef struct urdf {
  ambulo__tree *tree;
  ambulo__xml *xml;
  urdf_link *links;
  int count, capacity;
  const char **names; /* [count], for hints */
} urdf;

/* <origin xyz rpy> of a node */
static ambulo__rigid origin_of(ambulo__xml *xml, const ambulo__xml_node *node) {
  const ambulo__xml_node *origin = ambulo__xml_child(node, "origin");
  double xyz[3] = {0, 0, 0}, rpy[3] = {0, 0, 0};
  (void)ambulo__xml_vector(xml, origin, "xyz", 3, xyz);
  (void)ambulo__xml_vector(xml, origin, "rpy", 3, rpy);
  return ambulo__rigid_of_rpy(xyz, rpy);
}

/* ------------------------------------------------------------------------ joints */

static void read_limits(ambulo__tree *tree, const ambulo__xml_node *joint, int ranged, int link) {
  const ambulo__xml_node *limit = ambulo__xml_child(joint, "limit");
  ambulo__xml *xml = tree->xml;
  ambulo_coordinate *c = &tree->links[link].coordinate;
  double range[2] = {0.0, 0.0}, most = 0.0;
  if (ranged && limit) {
    (void)ambulo__xml_vector(xml, limit, "lower", 1, &range[0]);
    (void)ambulo__xml_vector(xml, limit, "upper", 1, &range[1]);
    ambulo__tree_range(tree, link, range, 1.0, limit);
  }
  static const char *const names[] = {"velocity", "effort"};
  double *const limits[] = {c->speed, c->torque};
  for (int i = 0; i < 2; i++) {
    if (!ambulo__xml_vector(xml, limit, names[i], 1, &most) || !(most > 0.0)) continue;
    limits[i][0] = -most;
    limits[i][1] = most;
  }
}

/* two sliders across the axis, the first as near to x as can be, and a hinge about it */
static void add_planar(ambulo__chain *chain, const double axis[3], const char *name) {
  static const char *const parts[] = {"first", "second", "turn"};
  double axes[3][3];
  int k = fabs(axis[0]) < 0.9 ? 0 : 1;
  for (int i = 0; i < 3; i++) axes[0][i] = (i == k) - axis[k] * axis[i];
  (void)ambulo__normalize(axes[0]);
  ambulo__cross(axis, axes[0], axes[1]);
  memcpy(axes[2], axis, sizeof axes[2]);
  for (int i = 0; i < 3; i++)
    (void)ambulo__chain_joint(chain, i < 2 ? AMBULO_PRISMATIC : AMBULO_REVOLUTE, axes[i],
                              ambulo__arena_print(chain->tree->arena, "%.50s_%s", name, parts[i]));
}

/* <mimic>: multiplier times another joint's coordinate plus offset. */
static void follow(ambulo__tree *tree, const ambulo__xml_node *mimic, const char *name, int link) {
  const char *leader = ambulo__xml_attribute(mimic, "joint");
  double multiplier = 1.0, offset = 0.0;
  if (!leader) {
    ambulo__xml_error(tree->xml, mimic, AMBULO_E_SCHEMA, NULL,
                      "<mimic> of joint '%.60s' names no joint; expected joint=...", name);
    return;
  }
  (void)ambulo__xml_vector(tree->xml, mimic, "multiplier", 1, &multiplier);
  (void)ambulo__xml_vector(tree->xml, mimic, "offset", 1, &offset);
  ambulo__tree_function line = ambulo__tree_line(multiplier, offset);
  ambulo__tree_couple(tree, link, leader, &line);
}

enum { REVOLUTE, CONTINUOUS, PRISMATIC, FIXED, FLOATING, PLANAR, TYPES };

static int one_coordinate(ambulo__chain *chain, int type, const ambulo__xml_node *joint,
                          const double axis[3]) {
  ambulo__tree *tree = chain->tree;
  const char *name = ambulo__xml_name(joint);
  const ambulo__xml_node *mimic = ambulo__xml_child(joint, "mimic");
  int link = ambulo__chain_joint(chain, type == PRISMATIC ? AMBULO_PRISMATIC : AMBULO_REVOLUTE,
                                 axis, name);
  if (link < 0) return 0;
  if (mimic) {
    follow(tree, mimic, name, link);
    return 1;
  }
  ambulo_coordinate *c = &tree->links[link].coordinate;
  const ambulo__xml_node *dynamics = ambulo__xml_child(joint, "dynamics");
  read_limits(tree, joint, type != CONTINUOUS, link);
  c->default_value = ambulo__tree_pose(tree, name, 0.0);
  (void)ambulo__xml_vector(tree->xml, dynamics, "damping", 1, &c->damping);
  (void)ambulo__xml_vector(tree->xml, dynamics, "friction", 1, &c->friction);
  return 1;
}

static int add_joint(ambulo__tree *tree, int parent, const ambulo__xml_node *joint,
                     const char *child) {
  static const char *const types[TYPES] = {"revolute", "continuous", "prismatic",
                                           "fixed",    "floating",   "planar"};
  const char *word = ambulo__xml_attribute(joint, "type"), *name = ambulo__xml_name(joint);
  int type = ambulo__xml_choice(tree->xml, joint, "type of joint", word ? word : "", types, TYPES);
  double axis[3] = {1, 0, 0};
  const ambulo__xml_node *along = ambulo__xml_child(joint, "axis");
  (void)ambulo__xml_vector(tree->xml, along, "xyz", 3, axis);
  if (type < 0 ||
      (type != FIXED && type != FLOATING && !ambulo__tree_axis(tree, axis, name, along)))
    return -1;
  ambulo__chain chain = ambulo__chain_begin(tree, parent, joint);
  ambulo__rigid origin = origin_of(tree->xml, joint);
  ambulo__chain_place(&chain, &origin);
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

static void read_solid(ambulo__tree *tree, int link, const ambulo__xml_node *node, int seen) {
  static const char *const names[] = {"box", "sphere", "cylinder", "capsule"};
  static const ambulo__shape shapes[] = {AMBULO__BOX, AMBULO__SPHERE, AMBULO__CYLINDER,
                                         AMBULO__CAPSULE};
  const ambulo__xml_node *geometry = ambulo__xml_child(node, "geometry");
  const ambulo__xml_node *shape = geometry ? geometry->first : NULL;
  ambulo__tree_solid solid = {.link = link, .shape = AMBULO__MESH, .seen = seen, .hidden = !seen};
  if (!shape) return;
  solid.at = origin_of(tree->xml, node);
  for (int i = 0; i < 4; i++)
    if (ambulo__xml_is(shape, names[i])) solid.shape = shapes[i];
  if (solid.shape == AMBULO__MESH) {
    ambulo__tree_mesh(tree, ambulo__xml_attribute(shape, "filename"), &solid);
    if (solid.mesh) (void)ambulo__xml_vector(tree->xml, shape, "scale", 3, solid.scale);
  } else if (solid.shape == AMBULO__BOX) {
    if (!ambulo__xml_vector(tree->xml, shape, "size", 3, solid.size)) return;
    for (int i = 0; i < 3; i++) solid.size[i] *= 0.5;
  } else {
    if (!ambulo__xml_vector(tree->xml, shape, "radius", 1, solid.size)) return;
    int has_length = ambulo__xml_vector(tree->xml, shape, "length", 1, &solid.size[1]);
    if (!has_length && solid.shape != AMBULO__SPHERE) return;
    solid.size[1] *= 0.5;
  }
  ambulo__tree_add_solid(tree, &solid);
}

static void read_link(ambulo__tree *tree, int link, const ambulo__xml_node *node) {
  const ambulo__xml_node *inertial = ambulo__xml_child(node, "inertial");
  if (inertial) read_inertial(tree, link, inertial, ambulo__xml_name(node));
  AMBULO__XML_EACH (n, node, "collision") read_solid(tree, link, n, 0);
  AMBULO__XML_EACH (n, node, "visual") read_solid(tree, link, n, 1);
}

static void note_leftovers(ambulo__tree *tree, const ambulo__xml_node *root) {
  int damped = 0, unlimited = 0;
  AMBULO__XML_EACH (n, root, "joint") {
    const char *type = ambulo__xml_attribute(n, "type");
    int several = type && (strcmp(type, "planar") == 0 || strcmp(type, "floating") == 0);
    damped += several && ambulo__xml_child(n, "dynamics");
    int limited = type && (strcmp(type, "revolute") == 0 || strcmp(type, "prismatic") == 0);
    unlimited += limited && !ambulo__xml_child(n, "limit") && !ambulo__xml_child(n, "mimic");
  }
  if (damped)
    ambulo__tree_note(tree, root, "<dynamics> of %d planar or floating joints is left out", damped);
  if (unlimited)
    ambulo__tree_note(tree, root, "%d joints have no <limit>: their coordinates have no range",
                      unlimited);
}

/* ------------------------------------------------------------ links and joints */

static urdf_link *find(const urdf *u, const char *name) {
  for (int i = 0; i < u->count; i++)
    if (strcmp(u->links[i].name, name) == 0) return &u->links[i];
  return NULL;
}

static void collect_links(urdf *u, const ambulo__xml_node *root) {
  AMBULO__XML_EACH (n, root, "link") {
    const char *name = ambulo__xml_attribute(n, "name");
    const urdf_link *first = name ? find(u, name) : NULL;
    if (!name) {
      ambulo__xml_error(u->xml, n, AMBULO_E_SCHEMA, NULL, "a link has no name; expected name=...");
      continue;
    }
    if (first) {
      ambulo__xml_error(u->xml, n, AMBULO_E_MODEL, NULL,
                        "two links are named '%.60s' (the first one at line %d); expected "
                        "different names",
                        name, first->node->line);
      continue;
    }
    if (u->count >= AMBULO__MAX_LINKS) {
      ambulo__xml_error(u->xml, n, AMBULO_E_LIMIT, NULL, "too many links; expected at most %d",
                        (int)AMBULO__MAX_LINKS);
      return;
    }
    if (!ambulo__arena_grow(u->tree->arena, &u->links, u->count, &u->capacity, sizeof *u->links))
      return;
    u->links[u->count++] = (urdf_link){.name = name, .node = n, .parent = -1};
  }
  u->names = ambulo__arena_take(u->tree->arena, (size_t)u->count + 1, sizeof *u->names);
  for (int i = 0; u->names && i < u->count; i++) u->names[i] = u->links[i].name;
}

/* the link that <parent link=...> or <child link=...> names, NULL after an error */
static urdf_link *end_of(urdf *u, const ambulo__xml_node *joint, const char *which) {
  const ambulo__xml_node *end = ambulo__xml_child(joint, which);
  const char *name = ambulo__xml_attribute(end, "link");
  if (!name) {
    ambulo__xml_error(u->xml, joint, AMBULO_E_SCHEMA, NULL, "joint '%.60s' has no <%s link=...>",
                      ambulo__xml_name(joint), which);
    return NULL;
  }
  urdf_link *found = find(u, name);
  if (found) return found;
  ambulo__xml_error(u->xml, end, AMBULO_E_MODEL,
                    ambulo__xml_nearest(u->xml, name, u->names, u->count),
                    "unknown %s link of joint '%.60s' (got '%.60s'); expected a link of this robot",
                    which, ambulo__xml_name(joint), name);
  return NULL;
}

static void collect_joints(urdf *u, const ambulo__xml_node *root) {
  AMBULO__XML_EACH (n, root, "joint") {
    const urdf_link *parent = end_of(u, n, "parent");
    urdf_link *child = end_of(u, n, "child");
    if (!parent || !child) continue;
    if (child->joint) {
      ambulo__xml_error(u->xml, n, AMBULO_E_MODEL, "loops cannot be carried over: cut one joint",
                        "link '%.60s' is the child of two joints ('%.60s', line %d, and '%.60s'); "
                        "expected a tree",
                        child->name, ambulo__xml_name(child->joint), child->joint->line,
                        ambulo__xml_name(n));
      continue;
    }
    child->joint = n;
    child->parent = (int)(parent - u->links);
  }
}

/* The one link without a parent; -1 after an error. */
static int root_of(urdf *u, const ambulo__xml_node *robot) {
  int root = -1;
  for (int i = 0; i < u->count; i++) {
    if (u->links[i].joint) continue;
    if (root >= 0) {
      ambulo__xml_error(u->xml, u->links[i].node, AMBULO_E_MODEL, "join them by a fixed joint",
                        "two roots: no joint has '%.60s' (line %d) or '%.60s' as its child; "
                        "expected one",
                        u->links[root].name, u->links[root].node->line, u->links[i].name);
      return -1;
    }
    root = i;
  }
  if (root < 0)
    ambulo__xml_error(u->xml, robot, AMBULO_E_MODEL, NULL,
                      u->count ? "every link is the child of a joint: the links form a cycle; "
                                 "expected a tree"
                               : "the robot has no links; expected at least one");
  return root;
}

static int begin_root(urdf *u, int i) {
  ambulo__tree *t = u->tree;
  ambulo__chain chain = ambulo__chain_begin(t, -1, u->links[i].node);
  int is_world = strcmp(u->links[i].name, "world") == 0;
  t->root_free =
      t->options->root == AMBULO_ROOT_FREE || (t->options->root == AMBULO_ROOT_AS_IS && !is_world);
  if (t->root_free) ambulo__chain_free(&chain, "base");
  return ambulo__chain_end(&chain, u->links[i].name);
}

/* From the root, each subtree whole; the stack holds links whose parents are in the tree. */
static void walk(urdf *u, int root) {
  ambulo__arena *arena = u->tree->arena;
  int *stack = ambulo__arena_take(arena, (size_t)u->count + 1, sizeof *stack), top = 0;
  int *index = ambulo__arena_take(arena, (size_t)u->count + 1, sizeof *index);
  if (!stack || !index) return;
  stack[top++] = root;
  while (top > 0) {
    int i = stack[--top];
    const urdf_link *link = &u->links[i];
    u->links[i].reached = 1;
    index[i] = link->joint ? add_joint(u->tree, index[link->parent], link->joint, link->name)
                           : begin_root(u, i);
    if (index[i] < 0) return;
    read_link(u->tree, index[i], link->node);
    for (int k = u->count - 1; k >= 0; k--)
      if (u->links[k].joint && u->links[k].parent == i && !u->links[k].reached) stack[top++] = k;
  }
  for (int i = 0; i < u->count && !u->xml->status; i++)
    if (!u->links[i].reached)
      ambulo__xml_error(
          u->xml, u->links[i].joint, AMBULO_E_MODEL, "loops cannot be carried over: cut one joint",
          "link '%.60s' hangs on itself through its parents; expected a tree", u->links[i].name);
}

static void refuse_xacro(ambulo__xml *xml, const ambulo__xml_node *root) {
  for (const ambulo__xml_node *n = root->first; n && !xml->status; n = n->next)
    if (strncmp(n->name, "xacro:", 6) == 0)
      ambulo__xml_error(xml, n, AMBULO_E_SCHEMA, "expand it first: xacro FILE.xacro > robot.urdf",
                        "the file holds macros of xacro (got <%.40s>); expected a URDF", n->name);
}

void ambulo__read_urdf(ambulo__tree *tree, const ambulo__xml_node *root) {
  urdf u = {.tree = tree, .xml = tree->xml};
  const char *name = ambulo__xml_attribute(root, "name");
  tree->format = "URDF";
  if (name && name[0]) tree->name = name;
  tree->gravity[0] = tree->gravity[1] = 0.0;
  tree->gravity[2] = -9.81;
  tree->up = 'z';
  refuse_xacro(tree->xml, root);
  if (tree->xml->status) return;
  collect_links(&u, root);
  collect_joints(&u, root);
  if (tree->xml->status || tree->arena->failed) return;
  int first = root_of(&u, root);
  if (first >= 0) walk(&u, first);
  note_leftovers(tree, root);
}
