/* import/osim_bodies.c - bodies, joints and frames of an OpenSim model, versions 3 and 4
 * (osim.h). */
#include "import/osim.h"

#include "model/model_check.h"

#include <stdio.h>
#include <string.h>

const char *ambulo__osim_text(const ambulo__xml_node *node, const char *name, const char *other) {
  const ambulo__xml_node *child = ambulo__xml_child(node, name);
  if (!child && other) child = ambulo__xml_child(node, other);
  return child ? child->text : "";
}

ambulo__xml_node *ambulo__osim_objects(const ambulo__xml_node *node, const char *set) {
  const ambulo__xml_node *list = ambulo__xml_child(node, set);
  const ambulo__xml_node *objects = ambulo__xml_child(list, "objects");
  return objects ? objects->first : NULL;
}

int ambulo__osim_flag(const ambulo__xml_node *node, const char *name, int otherwise) {
  const char *text = ambulo__osim_text(node, name, NULL);
  if (strcmp(text, "true") == 0 || strcmp(text, "1") == 0) return 1;
  return strcmp(text, "false") == 0 || strcmp(text, "0") == 0 ? 0 : otherwise;
}

/* ------------------------------------------------------------------------- bodies */

static int find_body(const ambulo__osim *o, const char *name) {
  for (int i = 0; i < o->body_count; i++)
    if (strcmp(o->bodies[i].name, name) == 0) return i;
  return -1;
}

static void add_body(ambulo__osim *o, const char *name, const ambulo__xml_node *node) {
  int first = find_body(o, name);
  if (first >= 0) {
    if (first > 0)
      ambulo__xml_error(o->xml, node, AMBULO_E_MODEL, NULL,
                        "two bodies are named '%.60s' (the first one at line %d); expected "
                        "different names",
                        name, o->bodies[first].node->line);
    return;
  }
  if (o->body_count > AMBULO__MAX_LINKS) {
    ambulo__xml_error(o->xml, node, AMBULO_E_LIMIT, NULL, "too many bodies; expected at most %d",
                      (int)AMBULO__MAX_LINKS);
    return;
  }
  if (!ambulo__arena_grow(o->tree->arena, &o->bodies, o->body_count, &o->body_capacity,
                          sizeof *o->bodies))
    return;
  o->bodies[o->body_count++] =
      (ambulo__osim_body){.name = name, .node = node, .joint = -1, .link = -1};
}

static ambulo__rigid placement_of(ambulo__osim *o, const ambulo__xml_node *node,
                                  const char *translation, const char *orientation) {
  double p[3] = {0, 0, 0}, angles[3] = {0, 0, 0};
  (void)ambulo__xml_child_vector(o->xml, node, translation, 3, 0, p);
  (void)ambulo__xml_child_vector(o->xml, node, orientation, 3, 0, angles);
  return ambulo__rigid_of_xyz(p, angles);
}

/* ------------------------------------------------------------------------- frames */

/* an offset frame of that name below `node`, three levels deep at most (sets, objects, frames) */
static const ambulo__xml_node *find_offset(const ambulo__xml_node *node, const char *name,
                                           int depth) {
  for (const ambulo__xml_node *n = node ? node->first : NULL; n; n = n->next) {
    if (ambulo__xml_is(n, "PhysicalOffsetFrame") && strcmp(ambulo__xml_name(n), name) == 0)
      return n;
    const ambulo__xml_node *inner = depth > 0 ? find_offset(n, name, depth - 1) : NULL;
    if (inner) return inner;
  }
  return NULL;
}

static int unknown_frame(ambulo__osim *o, const ambulo__xml_node *node, const char *text) {
  const char **names = ambulo__arena_take(o->tree->arena, (size_t)o->body_count + 1, sizeof *names);
  for (int i = 0; names && i < o->body_count; i++) names[i] = o->bodies[i].name;
  ambulo__xml_error(
      o->xml, node, AMBULO_E_MODEL,
      ambulo__xml_nearest(o->xml, ambulo__xml_last_name(text), names, o->body_count),
      "unknown frame (got '%.80s'); expected a body, or a frame that is offset from one", text);
  return -1;
}

int ambulo__osim_frame(ambulo__osim *o, const ambulo__xml_node *scope, const ambulo__xml_node *node,
                       const char *text, ambulo__rigid *placement) {
  enum { MOST_OFFSETS = 16 };
  *placement = ambulo__rigid_identity();
  const char *at = text;
  for (int step = 0; step < MOST_OFFSETS; step++) {
    const char *name = ambulo__xml_last_name(at);
    const ambulo__xml_node *offset = find_offset(scope, name, 2);
    int body = find_body(o, name);
    if (!offset && body < 0) offset = find_offset(o->model, name, 4);
    if (!offset) return body >= 0 ? body : unknown_frame(o, node, text);
    ambulo__rigid here = placement_of(o, offset, "translation", "orientation");
    *placement = ambulo__rigid_times(&here, placement);
    at = ambulo__osim_text(offset, "socket_parent", "socket_parent_connectee_name");
  }
  return unknown_frame(o, node, text);
}

/* ------------------------------------------------------------------------- joints */

static void add_joint(ambulo__osim *o, const ambulo__osim_joint *joint) {
  if (joint->parent < 0 || joint->child < 0) return;
  ambulo__osim_body *child = &o->bodies[joint->child];
  if (joint->child == 0) {
    ambulo__xml_error(o->xml, joint->node, AMBULO_E_MODEL, "exchange its parent and its child",
                      "the ground is the child of joint '%.60s'; expected it to be a parent",
                      joint->name);
    return;
  }
  if (child->joint >= 0) {
    ambulo__xml_error(
        o->xml, joint->node, AMBULO_E_MODEL, "loops cannot be carried over: cut one joint",
        "body '%.60s' is the child of two joints ('%.60s', line %d, and '%.60s'); "
        "expected a tree",
        child->name, o->joints[child->joint].name, o->joints[child->joint].node->line, joint->name);
    return;
  }
  if (!ambulo__arena_grow(o->tree->arena, &o->joints, o->joint_count, &o->joint_capacity,
                          sizeof *o->joints))
    return;
  child->joint = o->joint_count;
  o->joints[o->joint_count++] = *joint;
}

/* version 3: <Body><Joint><PinJoint>, with the name of the parent body */
static void collect_inner(ambulo__osim *o, int body) {
  const ambulo__xml_node *holder = ambulo__xml_child(o->bodies[body].node, "Joint");
  const ambulo__xml_node *node = holder ? holder->first : NULL;
  if (!node) return;
  const char *parent = ambulo__osim_text(node, "parent_body", NULL);
  ambulo__osim_joint joint = {.name = ambulo__xml_name(node), .node = node, .child = body};
  ambulo__rigid none;
  joint.parent = ambulo__osim_frame(o, node, node, parent, &none);
  joint.in_parent = placement_of(o, node, "location_in_parent", "orientation_in_parent");
  joint.in_child = placement_of(o, node, "location", "orientation");
  if (ambulo__osim_flag(node, "reverse", 0))
    ambulo__xml_error(o->xml, node, AMBULO_E_MODEL, NULL,
                      "joint '%.60s' is reversed; expected the parent to come first", joint.name);
  add_joint(o, &joint);
}

/* version 4: <JointSet>, with frames */
static void collect_listed(ambulo__osim *o, const ambulo__xml_node *node) {
  ambulo__osim_joint joint = {.name = ambulo__xml_name(node), .node = node};
  const char *parent =
      ambulo__osim_text(node, "socket_parent_frame", "socket_parent_frame_connectee_name");
  const char *child =
      ambulo__osim_text(node, "socket_child_frame", "socket_child_frame_connectee_name");
  joint.parent = ambulo__osim_frame(o, node, node, parent, &joint.in_parent);
  joint.child = ambulo__osim_frame(o, node, node, child, &joint.in_child);
  add_joint(o, &joint);
}

void ambulo__osim_collect(ambulo__osim *o) {
  add_body(o, "ground", o->model);
  for (const ambulo__xml_node *n = ambulo__osim_objects(o->model, "BodySet"); n; n = n->next) {
    if (ambulo__xml_is(n, "Body"))
      add_body(o, ambulo__xml_name(n), n);
    else
      ambulo__xml_error(o->xml, n, AMBULO_E_SCHEMA, NULL,
                        "unknown object in BodySet (got <%.40s>); expected <Body>", n->name);
  }
  if (o->xml->status || o->tree->arena->failed) return;
  for (int i = 1; i < o->body_count; i++) collect_inner(o, i);
  for (const ambulo__xml_node *n = ambulo__osim_objects(o->model, "JointSet"); n; n = n->next)
    collect_listed(o, n);
}

/* ----------------------------------------------------------------------- masses */

void ambulo__osim_read_body(ambulo__osim *o, const ambulo__osim_body *body) {
  static const char *const entries[] = {"inertia_xx", "inertia_yy", "inertia_zz",
                                        "inertia_xy", "inertia_xz", "inertia_yz"};
  const ambulo__xml_node *node = body->node, *mass = ambulo__xml_child(node, "mass");
  ambulo__part part = {0};
  if (!mass) {
    ambulo__xml_error(o->xml, node, AMBULO_E_SCHEMA, NULL,
                      "body '%.60s' has no mass; expected <mass>", body->name);
    return;
  }
  (void)ambulo__xml_child_vector(o->xml, node, "mass", 1, 0, &part.mass);
  (void)ambulo__xml_child_vector(o->xml, node, "mass_center", 3, 0, part.com);
  int listed = ambulo__xml_child(node, "inertia") != NULL;
  if (listed) (void)ambulo__xml_child_vector(o->xml, node, "inertia", 6, 0, part.inertia);
  for (int i = 0; i < 6 && !listed; i++) {
    if (ambulo__xml_child(node, entries[i])) {
      (void)ambulo__xml_child_vector(o->xml, node, entries[i], 1, 0, &part.inertia[i]);
    } else if (i < 3 && part.mass > 0.0) {
      ambulo__xml_error(o->xml, node, AMBULO_E_SCHEMA, NULL,
                        "body '%.60s' has a mass but no inertia; expected <inertia> with six "
                        "numbers, or <%s>",
                        body->name, entries[i]);
      return;
    }
  }
  const ambulo__xml_node *inertia = ambulo__xml_child(node, listed ? "inertia" : entries[0]);
  ambulo__tree_body(o->tree, body->link, &part, mass, inertia ? inertia : mass);
}
