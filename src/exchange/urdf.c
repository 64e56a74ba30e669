/* exchange/urdf.c - URDF: <robot> with <link>s and <joint>s.
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
 *   floating                          three sliders and three hinges (chain.c)
 *   with <mimic>                      held where it is when the joint it follows is at its pose
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/numtext.h"
#include "exchange/formats.h"
#include "exchange/urdf_parts.h"
#include "model/check.h"

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

/* ------------------------------------------------------------ links and joints */

static urdf_link *find(const urdf *u, const char *name) {
  for (int i = 0; i < u->count; i++)
    if (strcmp(u->links[i].name, name) == 0) return &u->links[i];
  return NULL;
}

static void collect_links(urdf *u, const ambulo__xml_node *root) {
  for (const ambulo__xml_node *n = ambulo__xml_child(root, "link"); n;
       n = ambulo__xml_next(n, "link")) {
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
    void *room =
        ambulo__arena_grow(u->tree->arena, u->links, u->count, &u->capacity, sizeof *u->links);
    if (!room) return;
    u->links = room;
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
                      ambulo__urdf_name(joint), which);
    return NULL;
  }
  urdf_link *found = find(u, name);
  if (found) return found;
  char hint[120];
  const char *near = u->names ? ambulo__nearest(name, u->names, (size_t)u->count) : NULL;
  if (near) (void)snprintf(hint, sizeof hint, "did you mean '%.80s'?", near);
  ambulo__xml_error(u->xml, end, AMBULO_E_MODEL, near ? hint : NULL,
                    "unknown %s link of joint '%.60s' (got '%.60s'); expected a link of this robot",
                    which, ambulo__urdf_name(joint), name);
  return NULL;
}

static void collect_joints(urdf *u, const ambulo__xml_node *root) {
  for (const ambulo__xml_node *n = ambulo__xml_child(root, "joint"); n;
       n = ambulo__xml_next(n, "joint")) {
    const urdf_link *parent = end_of(u, n, "parent");
    urdf_link *child = end_of(u, n, "child");
    if (!parent || !child) continue;
    if (child->joint) {
      ambulo__xml_error(u->xml, n, AMBULO_E_MODEL, "loops cannot be carried over: cut one joint",
                        "link '%.60s' is the child of two joints ('%.60s', line %d, and '%.60s'); "
                        "expected a tree",
                        child->name, ambulo__urdf_name(child->joint), child->joint->line,
                        ambulo__urdf_name(n));
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

/* ---------------------------------------------------------------------- walking */

static int begin_root(urdf *u, int i) {
  ambulo__tree *t = u->tree;
  ambulo__chain chain = ambulo__chain_begin(t, -1, u->links[i].node);
  ambulo_import_root asked = t->options->root;
  int is_free = asked == AMBULO_ROOT_FREE ||
                (asked == AMBULO_ROOT_AS_IS && strcmp(u->links[i].name, "world") != 0);
  if (is_free) ambulo__chain_free(&chain, "base");
  t->root_free = is_free;
  return ambulo__chain_end(&chain, u->links[i].name);
}

static void report_cycle(urdf *u) {
  for (int i = 0; i < u->count; i++) {
    if (u->links[i].reached) continue;
    ambulo__xml_error(
        u->xml, u->links[i].joint, AMBULO_E_MODEL, "loops cannot be carried over: cut one joint",
        "link '%.60s' hangs on itself through its parents; expected a tree", u->links[i].name);
    return;
  }
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
    index[i] = link->joint
                   ? ambulo__urdf_joint(u->tree, index[link->parent], link->joint, link->name)
                   : begin_root(u, i);
    if (index[i] < 0) return;
    ambulo__urdf_link(u->tree, index[i], link->node);
    for (int k = u->count - 1; k >= 0; k--)
      if (u->links[k].joint && u->links[k].parent == i && !u->links[k].reached) stack[top++] = k;
  }
  report_cycle(u);
}

static int is_xacro(ambulo__xml *xml, const ambulo__xml_node *root) {
  for (const ambulo__xml_node *n = root->first; n; n = n->next) {
    if (strncmp(n->name, "xacro:", 6) != 0) continue;
    ambulo__xml_error(xml, n, AMBULO_E_SCHEMA, "expand it first: xacro FILE.xacro > robot.urdf",
                      "the file holds macros of xacro (got <%.40s>); expected a URDF", n->name);
    return 1;
  }
  return 0;
}

void ambulo__read_urdf(ambulo__tree *tree, const ambulo__xml_node *root) {
  urdf u = {.tree = tree, .xml = tree->xml};
  const char *name = ambulo__xml_attribute(root, "name");
  tree->format = "URDF";
  if (name && name[0]) tree->name = name;
  tree->gravity[0] = tree->gravity[1] = 0.0;
  tree->gravity[2] = -9.81;
  tree->up = 'z';
  if (is_xacro(tree->xml, root)) return;
  collect_links(&u, root);
  collect_joints(&u, root);
  if (tree->xml->status || tree->arena->failed) return;
  int first = root_of(&u, root);
  if (first >= 0) walk(&u, first);
  ambulo__urdf_leftovers(tree, root);
}
