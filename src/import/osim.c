/* import/osim.c - OpenSim models (.osim), versions 3 and 4.
 *
 * Angles are radians; y is up, x forward, z right. Bodies are numbered from the ground, each
 * subtree whole, in the order of the joints of the file. Several bodies that hang on the ground get
 * one fixed link there, for a model has one root.
 *
 * A joint places its child's frame in its parent's by X(q), the frames F and M of the two bodies:
 *
 *   WeldJoint        1
 *   PinJoint         turn about z
 *   SliderJoint      slide along x
 *   UniversalJoint   turns about x, then the turned y
 *   GimbalJoint      turns about x, y, z, each turned by those before; BallJoint likewise
 *   FreeJoint        slides along x, y, z of F, then turns as a gimbal; its first three coordinates
 *                    are the turns
 *   PlanarJoint      slides along x and y of F, then turns about z; its first coordinate is the
 * turn CustomJoint      Trans(a4 f4 + a5 f5 + a6 f6) Rot(a1, f1) Rot(a2, f2) Rot(a3, f3), with each
 * f a function of a coordinate
 *
 * A function slope q + offset with a slope of 1 is a joint of the coordinate itself; with -1 about
 * the opposite axis. What else a coordinate drives is a joint that follows it. Where it has no such
 * axis, a link without mass has the coordinate. A function with corners, or of a high degree, is
 * frozen at the default of the coordinate; a note says by how much it would have moved.
 */
#include <math.h>
#include <string.h>

#include "base/numtext.h"
#include "import/osim.h"

enum { MOST_COORDINATES = 6, AXES = 6 };

typedef struct building {
  ambulo__osim *o;
  const ambulo__osim_joint *joint;
  ambulo__chain chain;
  ambulo__osim_coordinate coordinates[MOST_COORDINATES];
  int count;
  int has_link[MOST_COORDINATES]; /* some axis is the coordinate's own */
} building;

/* ------------------------------------------------------------------- one degree */

static void put_still(building *b, int slides, const double axis[3], double value) {
  double unit[3] = {axis[0], axis[1], axis[2]};
  (void)ambulo__normalize(unit);
  ambulo__rigid still = ambulo__rigid_step(slides, unit, value);
  ambulo__chain_place(&b->chain, &still);
}

/* a joint that follows a coordinate, by `function` */
static void put_following(building *b, int slides, const double axis[3], const char *name,
                          const char *to, const ambulo__tree_function *function) {
  const char *full = ambulo__arena_print(b->o->tree->arena, "%.40s_%.20s", b->joint->name, name);
  int link =
      ambulo__chain_joint(&b->chain, slides ? AMBULO_PRISMATIC : AMBULO_REVOLUTE, axis, full);
  ambulo__tree_couple(b->o->tree, link, to, function);
}

/* slope q + offset about or along an axis */
static void put_moving(building *b, int slides, const double axis[3], int c, double slope,
                       double offset) {
  ambulo__osim_coordinate *coordinate = &b->coordinates[c];
  const double along[3] = {slope < 0 ? -axis[0] : axis[0], slope < 0 ? -axis[1] : axis[1],
                           slope < 0 ? -axis[2] : axis[2]};
  if (coordinate->held) {
    put_still(b, slides, axis, slope * coordinate->value + offset);
    return;
  }
  if (coordinate->leader) {
    ambulo__tree_function whole, line = ambulo__tree_line(slope, offset);
    if (ambulo__function_of_function(b->o->tree, &line, &coordinate->function, &whole))
      put_following(b, slides, axis, coordinate->name, coordinate->leader, &whole);
    return;
  }
  if (offset != 0.0) put_still(b, slides, axis, offset);
  int link = ambulo__chain_joint(&b->chain, slides ? AMBULO_PRISMATIC : AMBULO_REVOLUTE, along,
                                 coordinate->name);
  b->has_link[c] = 1;
  if (fabs(slope) != 1.0)
    ambulo__tree_note(
        b->o->tree, b->joint->node,
        "%s is %s times the source's coordinate, so that it is the joint's angle or length",
        coordinate->name, ambulo__number_text(fabs(slope)).text);
  ambulo__osim_limits(b->o, coordinate, fabs(slope), link);
  if (link >= 0) b->o->tree->links[link].coordinate.default_value = fabs(slope) * coordinate->value;
}

static void simple(building *b, int slides, int along, int c) {
  const double axis[3] = {along == 0, along == 1, along == 2};
  if (c < b->count) put_moving(b, slides, axis, c, 1.0, 0.0);
}

/* ------------------------------------------------------------------ custom joints */

typedef struct transform_axis {
  const ambulo__xml_node *node, *function;
  double axis[3];
  int coordinate; /* -1: none */
  int linear;
  double slope, offset;
} transform_axis;

static int find_coordinate(const building *b, const char *name) {
  for (int i = 0; i < b->count; i++)
    if (strcmp(b->coordinates[i].name, name) == 0) return i;
  return -1;
}

static int read_axis(building *b, const ambulo__xml_node *node, transform_axis *a) {
  const char *names = ambulo__osim_text(node, "coordinates", NULL);
  ambulo__xml *xml = b->o->xml;
  *a = (transform_axis){.node = node, .coordinate = -1, .function = ambulo__osim_function(node)};
  a->axis[0] = 1.0;
  (void)ambulo__xml_child_vector(xml, node, "axis", 3, 0, a->axis);
  if (!ambulo__tree_axis(b->o->tree, a->axis, b->joint->name, node)) return 0;
  if (names[0]) {
    a->coordinate = find_coordinate(b, names);
    if (a->coordinate < 0) {
      ambulo__xml_error(
          xml, node, AMBULO_E_MODEL,
          strpbrk(names, " \t\n") ? "functions of several coordinates are not read" : NULL,
          "unknown coordinate of joint '%.60s' (got '%.60s'); expected one of the joint",
          b->joint->name, names);
      return 0;
    }
  }
  a->linear = 1;
  if (a->function) a->linear = ambulo__osim_is_linear(b->o, a->function, &a->slope, &a->offset);
  return 1;
}

/* a function that no joint can have: frozen */
static void put_frozen(building *b, const transform_axis *a, int slides) {
  const ambulo__osim_coordinate *c = &b->coordinates[a->coordinate];
  double value = ambulo__osim_value(b->o, a->function, c->value);
  put_still(b, slides, a->axis, value);
  double most =
      c->held ? 0.0 : ambulo__osim_travel(b->o, a->function, 1.0, c->node, c->value, value);
  if (most == 0.0) return;
  ambulo__tree_note(b->o->tree, a->node,
                    "%s: %s follows %s by a %s: frozen at %s = %s; over its range it %s up to "
                    "%s %s",
                    b->joint->name,
                    ambulo__xml_attribute(a->node, "name") ? ambulo__xml_attribute(a->node, "name")
                                                           : "an axis",
                    c->name, a->function->name, c->name, ambulo__number_text(c->value).text,
                    slides ? "slides by" : "turns by",
                    ambulo__three_digits(slides ? 1e3 * most : most * 180.0 / acos(-1.0)).text,
                    slides ? "mm" : "degrees");
}

/* a function that is no joint of its own: it follows the coordinate, or what that follows */
static void put_function(building *b, const transform_axis *a, int slides) {
  const ambulo__osim_coordinate *c = &b->coordinates[a->coordinate];
  const char *name = ambulo__xml_attribute(a->node, "name");
  ambulo__tree_function own, whole;
  int can = !c->held && ambulo__osim_read_function(b->o, a->function, &own);
  if (can && c->leader) {
    can = ambulo__function_of_function(b->o->tree, &own, &c->function, &whole);
    own = whole;
  }
  if (can)
    put_following(b, slides, a->axis, name ? name : "axis", c->leader ? c->leader : c->name, &own);
  else
    put_frozen(b, a, slides);
}

static void put_axis(building *b, const transform_axis *a, int slides) {
  if (a->coordinate < 0 || (a->linear && a->slope == 0.0)) {
    double value = a->linear     ? a->offset
                   : a->function ? ambulo__osim_value(b->o, a->function, 0.0)
                                 : 0.0;
    if (value != 0.0) put_still(b, slides, a->axis, value);
  } else if (a->linear && !b->has_link[a->coordinate]) {
    put_moving(b, slides, a->axis, a->coordinate, a->slope, a->offset);
  } else {
    put_function(b, a, slides);
  }
}

/* 1: some axis moves with the coordinate; *turns: a hinge. */
static int drives(const transform_axis *axes, int c, int *turns) {
  int any = 0;
  *turns = 0;
  for (int i = 0; i < AXES; i++) {
    int moves = axes[i].coordinate == c && !(axes[i].linear && axes[i].slope == 0.0);
    any |= moves;
    *turns |= moves && i < 3;
  }
  return any;
}

/* A coordinate without an axis of its own: a link without mass has it. 0: there is no place. */
static int put_carrier(building *b, int c, int turns) {
  ambulo__osim_coordinate *coordinate = &b->coordinates[c];
  const double axis[3] = {0, 0, 1};
  ambulo__rigid none = ambulo__rigid_identity();
  if (b->chain.parent < 0) return 0; /* the world has one link */
  int link =
      ambulo__tree_add(b->o->tree, coordinate->name, b->chain.parent,
                       turns ? AMBULO_REVOLUTE : AMBULO_PRISMATIC, &none, axis, b->joint->node);
  if (link < 0) return 1;
  b->has_link[c] = 1;
  ambulo__osim_limits(b->o, coordinate, 1.0, link);
  b->o->tree->links[link].coordinate.default_value = coordinate->value;
  ambulo__tree_note(b->o->tree, coordinate->node,
                    "%s is no axis' own angle or length: a link without mass has it",
                    coordinate->name);
  return 1;
}

/* Which of the axes that are linear in a coordinate gets it: a turn rather than a slide, and one
 * that moves as far. */
static void choose(building *b, transform_axis *axes) {
  for (int c = 0; c < b->count; c++) {
    int owner = -1, other = -1, turns = 0;
    if (b->coordinates[c].held || b->coordinates[c].leader) continue;
    for (int i = AXES - 1; i >= 0; i--) {
      if (axes[i].coordinate != c || !axes[i].linear || axes[i].slope == 0.0) continue;
      other = i;
      if (fabs(axes[i].slope) == 1.0) owner = i;
    }
    if (owner < 0 && drives(axes, c, &turns) && !put_carrier(b, c, turns)) owner = other;
    for (int i = 0; i < AXES; i++)
      if (axes[i].coordinate == c && i != owner && axes[i].slope != 0.0) axes[i].linear = 0;
    if (owner < 0 && !b->has_link[c])
      ambulo__tree_note(b->o->tree, b->coordinates[c].node,
                        "%s drives no axis linearly: it is left out, and its joint is held at %s",
                        b->coordinates[c].name, ambulo__number_text(b->coordinates[c].value).text);
  }
}

static int custom(building *b) {
  static const char *const names[AXES] = {"rotation1",    "rotation2",    "rotation3",
                                          "translation1", "translation2", "translation3"};
  const ambulo__xml_node *spatial = ambulo__xml_child(b->joint->node, "SpatialTransform");
  transform_axis axes[AXES];
  for (int i = 0; i < AXES; i++)
    axes[i] = (transform_axis){
        .coordinate = -1, .linear = 1, .axis = {i % 3 == 0, i % 3 == 1, i % 3 == 2}};
  AMBULO__XML_EACH (n, spatial, "TransformAxis") {
    const char *name = ambulo__xml_attribute(n, "name");
    int i = ambulo__xml_choice(b->o->xml, n, "transform axis", name ? name : "", names, AXES);
    if (i < 0 || !read_axis(b, n, &axes[i])) return 0;
  }
  choose(b, axes);
  for (int i = 3; i < AXES; i++) put_axis(b, &axes[i], 1);
  for (int i = 0; i < 3; i++) put_axis(b, &axes[i], 0);
  return 1;
}

/* -------------------------------------------------------------------------- joints */

enum { WELD, PIN, SLIDER, UNIVERSAL, GIMBAL, BALL, FREE, PLANAR, CUSTOM, TYPES };

static int put_joint(building *b, int type) {
  switch (type) {
  case PIN:
    simple(b, 0, 2, 0);
    break;
  case SLIDER:
    simple(b, 1, 0, 0);
    break;
  case UNIVERSAL:
    for (int i = 0; i < 2; i++) simple(b, 0, i, i);
    break;
  case GIMBAL:
  case BALL:
    for (int i = 0; i < 3; i++) simple(b, 0, i, i);
    break;
  case FREE:
    for (int i = 0; i < 3; i++) simple(b, 1, i, 3 + i);
    for (int i = 0; i < 3; i++) simple(b, 0, i, i);
    break;
  case PLANAR:
    for (int i = 0; i < 2; i++) simple(b, 1, i, 1 + i);
    simple(b, 0, 2, 0);
    break;
  case CUSTOM:
    return custom(b);
  default:
    break; /* a weld */
  }
  return 1;
}

static int type_of(ambulo__osim *o, const ambulo__osim_joint *joint) {
  static const char *const types[TYPES] = {"WeldJoint",      "PinJoint",    "SliderJoint",
                                           "UniversalJoint", "GimbalJoint", "BallJoint",
                                           "FreeJoint",      "PlanarJoint", "CustomJoint"};
  return ambulo__xml_choice(o->xml, joint->node, "joint", joint->node->name, types, TYPES);
}

static int add_joint(ambulo__osim *o, const ambulo__osim_joint *joint, int parent) {
  static const int wanted[TYPES] = {0, 1, 1, 2, 3, 3, 6, 3, -1};
  int type = type_of(o, joint);
  if (type < 0) return -1;
  building b = {.o = o, .joint = joint, .chain = ambulo__chain_begin(o->tree, parent, joint->node)};
  b.count = ambulo__osim_coordinates(o, joint, MOST_COORDINATES, b.coordinates);
  if (b.count < 0 || (wanted[type] >= 0 && b.count != wanted[type])) {
    if (b.count >= 0)
      ambulo__xml_error(o->xml, joint->node, AMBULO_E_SCHEMA, NULL,
                        "<%s> '%.60s' has %d coordinates; expected %d", joint->node->name,
                        joint->name, b.count, wanted[type]);
    return -1;
  }
  int first = o->tree->link_count;
  ambulo__rigid back = ambulo__rigid_inverse(&joint->in_child);
  ambulo__chain_place(&b.chain, &joint->in_parent);
  if (!put_joint(&b, type)) return -1;
  ambulo__chain_place(&b.chain, &back);
  int link = ambulo__chain_end(&b.chain, o->bodies[joint->child].name);
  /* what moves the whole body as three or more coordinates has no muscle */
  for (int i = first; i < o->tree->link_count && joint->parent == 0 && b.count >= 3; i++)
    o->tree->links[i].coordinate.actuated = 0;
  return link;
}

/* ------------------------------------------------------------------------ reading */

/* A body without a joint floats: OpenSim gives it six coordinates, and so is done here. */
static int float_freely(ambulo__osim *o, ambulo__osim_body *body, int parent) {
  ambulo__chain chain = ambulo__chain_begin(o->tree, parent, body->node);
  ambulo__tree_note(o->tree, body->node, "%s has no joint: it gets six coordinates", body->name);
  ambulo__chain_free(&chain, body->name);
  return ambulo__chain_end(&chain, body->name);
}

static int parent_of(const ambulo__osim *o, int body) {
  return o->bodies[body].joint < 0 ? 0 : o->joints[o->bodies[body].joint].parent;
}

static int hang(ambulo__osim *o, int i) {
  ambulo__osim_body *body = &o->bodies[i];
  int parent = o->bodies[parent_of(o, i)].link;
  body->reached = 1;
  body->link = body->joint < 0 ? float_freely(o, body, parent)
                               : add_joint(o, &o->joints[body->joint], parent);
  if (body->link < 0) return 0;
  ambulo__osim_read_body(o, body);
  return 1;
}

/* several bodies on the ground stand on one fixed link */
static void begin_ground(ambulo__osim *o) {
  ambulo__rigid none = ambulo__rigid_identity();
  int roots = 0;
  for (int i = 1; i < o->body_count; i++) roots += parent_of(o, i) == 0;
  o->bodies[0].reached = 1;
  o->bodies[0].link =
      roots > 1 ? ambulo__tree_add(o->tree, "ground", -1, AMBULO_FIXED, &none, NULL, o->model) : -1;
}

/* From the ground, each subtree whole. */
static void walk(ambulo__osim *o) {
  int *stack = ambulo__arena_take(o->tree->arena, (size_t)o->body_count + 1, sizeof *stack),
      top = 0;
  if (!stack) return;
  begin_ground(o);
  stack[top++] = 0;
  while (top > 0) {
    int i = stack[--top];
    if (i > 0 && !hang(o, i)) return;
    for (int k = o->body_count - 1; k > 0; k--)
      if (parent_of(o, k) == i && !o->bodies[k].reached) stack[top++] = k;
  }
  for (int i = 1; i < o->body_count && !o->xml->status; i++)
    if (!o->bodies[i].reached)
      ambulo__xml_error(
          o->xml, o->bodies[i].node, AMBULO_E_MODEL, "loops cannot be carried over: cut one joint",
          "body '%.60s' hangs on itself through its parents; expected a tree", o->bodies[i].name);
}

void ambulo__read_osim(ambulo__tree *tree, const ambulo__xml_node *root) {
  const ambulo__xml_node *model = ambulo__xml_child(root, "Model");
  ambulo__osim o = {.tree = tree, .xml = tree->xml, .model = model};
  tree->format = "OpenSim";
  tree->repair_inertia = 1;
  if (!model) {
    ambulo__xml_error(tree->xml, root, AMBULO_E_SCHEMA, NULL,
                      "this OpenSim file holds no model (got <%.40s>); expected <Model>",
                      root->first ? root->first->name : "nothing");
    return;
  }
  const char *name = ambulo__xml_attribute(model, "name");
  if (name && name[0]) tree->name = name;
  tree->gravity[1] = -9.80665;
  tree->up = 'y';
  (void)ambulo__xml_child_vector(tree->xml, model, "gravity", 3, 0, tree->gravity);
  ambulo__tree_gravity(tree);
  ambulo__osim_collect(&o);
  if (tree->xml->status || tree->arena->failed) return;
  walk(&o);
  if (tree->xml->status || tree->arena->failed) return;
  ambulo__osim_forces(&o);
  ambulo__osim_contacts(&o);
  ambulo__osim_markers(&o);
}
