/* exchange/osim.c - OpenSim models (.osim), versions 3 and 4.
 *
 * Angles are radians; y is up, x forward, z right. Bodies are numbered from the ground, each
 * subtree whole, in the order of the joints of the file. Several bodies that hang on the ground get
 * one fixed link there, for a model has one root.
 */
#include <string.h>

#include "exchange/osim.h"

static void read_body(ambulo__osim *o, const ambulo__osim_body *body) {
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

/* A body without a joint floats: OpenSim gives it six coordinates, and so is done here. */
static int float_freely(ambulo__osim *o, ambulo__osim_body *body, int parent) {
  ambulo__chain chain = ambulo__chain_begin(o->tree, parent, body->node);
  ambulo__tree_note(o->tree, body->node, "%s has no joint: it has six coordinates of its own",
                    body->name);
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
                               : ambulo__osim_add_joint(o, &o->joints[body->joint], parent);
  if (body->link < 0) return 0;
  read_body(o, body);
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
  for (int i = 1; i < o->body_count; i++) {
    if (o->bodies[i].reached) continue;
    ambulo__xml_error(
        o->xml, o->bodies[i].node, AMBULO_E_MODEL, "loops cannot be carried over: cut one joint",
        "body '%.60s' hangs on itself through its parents; expected a tree", o->bodies[i].name);
    return;
  }
}

void ambulo__read_osim(ambulo__tree *tree, const ambulo__xml_node *root) {
  const ambulo__xml_node *model = ambulo__xml_child(root, "Model");
  ambulo__osim o = {.tree = tree, .xml = tree->xml, .model = model};
  tree->format = "OpenSim";
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
}
