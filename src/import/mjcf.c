/* import/mjcf.c - the rigid part of a MuJoCo model (MJCF): settings, and what is left out.
 *
 * Bodies with their joints, masses and geoms (mjcf_bodies.c), default classes, included files,
 * torque limits from actuators; joints that an equality makes a polynomial of another, or closes to
 * a loop. Angles are degrees unless the compiler says radian; z is up. Tendons, other equalities,
 * springs of joints and contacts are not carried over.
 */
#include "import/mjcf.h"

#include "base/numtext.h"
#include "base/arithmetic.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* <include file=...> of a MuJoCo model (mjcf.h).
 *
 * The element is replaced by the children of the file's root. Names are relative to the folder of
 * the model; a file may be included once, as MuJoCo has it, so that none can include itself. */

enum { MOST_FILES = 64, MOST_DEPTH = 200 };

typedef struct includes {
  ambulo__xml *xml;
  const char *path; /* of the model */
  const char *files[MOST_FILES];
  int count;
} includes;

/* in the folder of the model */
static const char *path_of(includes *in, const char *file) {
  const char *slash = strrchr(in->path, '/');
  if (file[0] == '/' || !slash) return ambulo__arena_copy(in->xml->arena, file, strlen(file));
  return ambulo__arena_print(in->xml->arena, "%.*s/%s", (int)(slash - in->path), in->path, file);
}

static ambulo__xml_node *load(includes *in, const ambulo__xml_node *node) {
  const char *file = ambulo__xml_attribute(node, "file");
  if (!file || !file[0]) {
    ambulo__xml_error(in->xml, node, AMBULO_E_SCHEMA, NULL,
                      "<include> names no file; expected file=...");
    return NULL;
  }
  for (int i = 0; i < in->count; i++) {
    if (strcmp(in->files[i], file) != 0) continue;
    ambulo__xml_error(in->xml, node, AMBULO_E_SCHEMA, NULL,
                      "'%.80s' is included twice; expected each file once", file);
    return NULL;
  }
  if (in->count == MOST_FILES) {
    ambulo__xml_error(in->xml, node, AMBULO_E_LIMIT, NULL,
                      "too many <include>; expected at most %d", (int)MOST_FILES);
    return NULL;
  }
  in->files[in->count++] = file;
  const char *path = path_of(in, file);
  ambulo__xml_node *root = path && path[0] ? ambulo__xml_load(in->xml, path) : NULL;
  if (!root)
    ambulo__xml_error(in->xml, node, in->xml->status ? in->xml->status : AMBULO_E_MEMORY, NULL,
                      "the included file '%.80s' could not be read", file);
  return root;
}

/* `node` of `parent` behind `before` (NULL: the first) by the children of `root` */
static void replace(ambulo__xml_node *parent, ambulo__xml_node *before, ambulo__xml_node *node,
                    ambulo__xml_node *root) {
  ambulo__xml_node *first = root->first ? root->first : node->next;
  for (ambulo__xml_node *n = root->first; n; n = n->next) n->parent = parent;
  if (root->last) root->last->next = node->next;
  *(before ? &before->next : &parent->first) = first;
  if (parent->last == node) parent->last = root->last ? root->last : before;
}

static void expand(includes *in, ambulo__xml_node *parent, int depth) {
  if (depth > MOST_DEPTH) {
    ambulo__xml_error(in->xml, parent, AMBULO_E_LIMIT, NULL,
                      "included elements are nested too deeply; expected at most %d levels",
                      (int)MOST_DEPTH);
    return;
  }
  ambulo__xml_node *before = NULL, *node = parent->first;
  while (node && !in->xml->status) {
    if (!ambulo__xml_is(node, "include")) {
      expand(in, node, depth + 1);
      before = node;
      node = node->next;
      continue;
    }
    ambulo__xml_node *root = load(in, node);
    if (!root) return;
    replace(parent, before, node, root);
    node = before ? before->next : parent->first;
  }
}

static void include_files(ambulo__xml *xml, ambulo__xml_node *root, const char *path) {
  includes in = {.xml = xml, .path = path};
  expand(&in, root, 0);
}

/* torque limits from MuJoCo's actuators (mjcf.h).
 *
 * An actuator with a joint pushes with gear times its force. The force is within forcerange; of a
 * motor, without one, within ctrlrange. Forces of several actuators of a joint add up, and the
 * joint's actuatorfrcrange bounds the sum.
 */

/* the actuator's bounds on the joint's torque; 0: none */
static int bounds_of(ambulo__mjcf *m, const ambulo__xml_node *n, double bounds[2]) {
  double gear[6] = {1.0}, force[2];
  int motor = ambulo__xml_is(n, "motor");
  (void)ambulo__mjcf_numbers(m, n, NULL, "gear", 1, 6, gear);
  int limited = ambulo__mjcf_flag(m, n, NULL, "forcelimited", -1);
  int given = limited != 0 && ambulo__mjcf_numbers(m, n, NULL, "forcerange", 2, 2, force);
  if (!given && motor && ambulo__mjcf_flag(m, n, NULL, "ctrllimited", -1) != 0)
    given = ambulo__mjcf_numbers(m, n, NULL, "ctrlrange", 2, 2, force);
  if (!given || !(force[0] < force[1])) return 0;
  bounds[0] = gear[0] * force[gear[0] < 0.0];
  bounds[1] = gear[0] * force[gear[0] >= 0.0];
  return 1;
}

static void apply(ambulo_coordinate *c, const double bounds[2], int others) {
  for (int i = 0; i < 2; i++) {
    if (others)
      c->torque[i] += bounds[i];
    else if (!isfinite(c->torque[i]) || fabs(bounds[i]) < fabs(c->torque[i]))
      c->torque[i] = bounds[i];
  }
}

static void read_actuators(ambulo__mjcf *m) {
  int elsewhere = 0, number = 0;
  int *seen = ambulo__arena_take(m->tree->arena, (size_t)m->tree->link_count + 1, sizeof *seen);
  if (!seen) return;
  AMBULO__XML_EACH (set, m->root, "actuator") {
    number++;
    for (const ambulo__xml_node *n = set->first; n; n = n->next) {
      const char *joint = ambulo__xml_attribute(n, "joint");
      int link = joint ? ambulo__tree_find_coordinate(m->tree, joint) : -1;
      double bounds[2];
      elsewhere += link < 0;
      if (link < 0) continue;
      int others = seen[link] == number; /* of this set */
      seen[link] = number;
      if (bounds_of(m, n, bounds)) apply(&m->tree->links[link].coordinate, bounds, others);
    }
  }
  if (elsewhere)
    ambulo__tree_note(m->tree, NULL,
                      "%d actuators on tendons, sites or joints of three axes are left out",
                      elsewhere);
}

/* ------------------------------------------------------------------------ settings */

static void read_sequence(ambulo__mjcf *m, const ambulo__xml_node *compiler) {
  const char *text = ambulo__xml_attribute(compiler, "eulerseq");
  if (!text) return;
  if (strlen(text) == 3 && strspn(text, "xyzXYZ") == 3) {
    memcpy(m->sequence, text, 4);
    return;
  }
  ambulo__xml_error(m->xml, compiler, AMBULO_E_SCHEMA, NULL,
                    "eulerseq of <compiler> is '%.40s'; expected three of x, y, z, X, Y, Z", text);
}

static void read_compiler(ambulo__mjcf *m, const ambulo__xml_node *compiler) {
  static const char *const angles[] = {"degree", "radian"}, *const frames[] = {"local"};
  const char *angle = ambulo__xml_attribute(compiler, "angle");
  const char *frame = ambulo__xml_attribute(compiler, "coordinate");
  double groups[2];
  if (angle)
    m->angle = ambulo__xml_choice(m->xml, compiler, "angle", angle, angles, 2) == 1
                   ? 1.0
                   : 0.017453292519943295;
  const char *assets = ambulo__xml_attribute(compiler, "assetdir");
  const char *meshes = ambulo__xml_attribute(compiler, "meshdir");
  if (assets) m->mesh_folder = assets;
  if (meshes) m->mesh_folder = meshes;
  if (frame) (void)ambulo__xml_choice(m->xml, compiler, "coordinate", frame, frames, 1);
  read_sequence(m, compiler);
  int from = ambulo__mjcf_flag(m, compiler, NULL, "inertiafromgeom", -1);
  m->inertia = from < 0 ? AMBULO__FROM_EITHER : from ? AMBULO__FROM_GEOMS : AMBULO__FROM_INERTIAL;
  m->automatic_limits = ambulo__mjcf_flag(m, compiler, NULL, "autolimits", m->automatic_limits);
  (void)ambulo__xml_vector(m->xml, compiler, "boundmass", 1, &m->least_mass);
  (void)ambulo__xml_vector(m->xml, compiler, "boundinertia", 1, &m->least_inertia);
  (void)ambulo__xml_vector(m->xml, compiler, "settotalmass", 1, &m->total_mass);
  if (!ambulo__xml_vector(m->xml, compiler, "inertiagrouprange", 2, groups)) return;
  for (int i = 0; i < 2; i++)
    m->groups[i] = groups[i] > 100.0 ? 100 : groups[i] < -100.0 ? -100 : (int)groups[i];
}

static void set_total_mass(ambulo__mjcf *m) {
  ambulo__tree *t = m->tree;
  double mass = 0.0;
  for (int i = 0; i < t->link_count; i++) mass += t->links[i].body.mass;
  if (!(m->total_mass > 0.0) || !(mass > 0.0)) return;
  for (int i = 0; i < t->link_count; i++) {
    ambulo__part *body = &t->links[i].body;
    body->mass *= m->total_mass / mass;
    for (int k = 0; k < 6; k++) body->inertia[k] *= m->total_mass / mass;
  }
}

/* joints that follow others (mjcf.h).
 *
 * <equality><joint joint1 joint2 polycoef>: with positions that begin at each joint's reference,
 *
 *     y - y0 = a0 + a1 (x - x0) + ... + a4 (x - x0)^4
 *
 * in radians or metres, also where the file has degrees. */

/* 1: it became a function. */
static int couple(ambulo__mjcf *m, const ambulo__xml_node *n) {
  const char *own = ambulo__xml_attribute(n, "joint1"), *to = ambulo__xml_attribute(n, "joint2");
  int link = own && to ? ambulo__tree_find_coordinate(m->tree, own) : -1;
  int leader = own && to ? ambulo__tree_find_coordinate(m->tree, to) : -1;
  ambulo__tree_function f = ambulo__tree_line(1.0, 0.0), whole;
  if (!ambulo__xml_is(n, "joint") || link < 0 || leader < 0 || link == leader) return 0;
  if (!ambulo__mjcf_flag(m, n, NULL, "active", 1)) return 0;
  (void)ambulo__mjcf_numbers(m, n, NULL, "polycoef", 1, AMBULO__COUPLING_TERMS, f.polynomial);
  f.polynomial[0] += m->tree->links[link].reference;
  ambulo__tree_function from = ambulo__tree_line(1.0, -m->tree->links[leader].reference);
  if (!ambulo__function_of_function(m->tree, &f, &from, &whole)) return 0;
  ambulo__tree_couple(m->tree, link, to, &whole);
  return 1;
}

/* <equality><connect body1 body2 anchor>: the anchor, in the frame of body1, is a point of both
 * where all joints are at their references. */

static int read_closure(ambulo__mjcf *m, const ambulo__xml_node *n, const double *references,
                        ambulo__closure *c) {
  static const char *const names[] = {"body1", "body2"};
  double world[3];
  ambulo__rigid place[2];
  if (!ambulo__xml_is(n, "connect") || !ambulo__mjcf_flag(m, n, NULL, "active", 1)) return 0;
  for (int i = 0; i < 2; i++) {
    const char *body = ambulo__xml_attribute(n, names[i]);
    c->link[i] = body ? ambulo__tree_find(m->tree, body) : -1;
    if (c->link[i] < 0) return 0;
    place[i] = ambulo__tree_place_at(m->tree, c->link[i], references);
  }
  if (!ambulo__mjcf_numbers(m, n, NULL, "anchor", 3, 3, c->point[0])) return 0;
  c->node = n;
  ambulo__rigid back = ambulo__rigid_inverse(&place[1]);
  ambulo__rigid_point(&place[0], c->point[0], world);
  ambulo__rigid_point(&back, world, c->point[1]);
  return 1;
}

/* how many of them became functions, or notes of their own */
static int couple_joints(ambulo__mjcf *m) {
  int count = 0, closed = 0, capacity = 0;
  ambulo__closure *closures = NULL;
  size_t links = (size_t)m->tree->link_count;
  double *references = ambulo__arena_take(m->tree->arena, links, sizeof *references);
  if (!references) return 0;
  for (size_t i = 0; i < links; i++) references[i] = m->tree->links[i].reference;
  AMBULO__XML_EACH (set, m->root, "equality") {
    for (const ambulo__xml_node *n = set->first; n; n = n->next) {
      if (!ambulo__arena_grow(m->tree->arena, &closures, closed, &capacity, sizeof *closures))
        return count;
      count += couple(m, n);
      closed += read_closure(m, n, references, &closures[closed]);
    }
  }
  for (int i = 0; i < m->tree->link_count && closed > 0; i++) {
    ambulo__tree_link *l = &m->tree->links[i];
    l->driven = l->coordinate.name && ambulo__mjcf_is_driven(m, l->coordinate.name);
  }
  ambulo__close_loops(m->tree, closures, closed);
  return count + closed;
}

static void note_leftovers(ambulo__mjcf *m, int coupled) {
  static const char *const sets[] = {"tendon", "equality", "deformable", "extension"};
  for (int i = 0; i < 4; i++) {
    int count = 0;
    for (const ambulo__xml_node *set = ambulo__xml_child(m->root, sets[i]); set;
         set = ambulo__xml_next(set, sets[i]))
      for (const ambulo__xml_node *n = set->first; n; n = n->next) count++;
    if (i == 1) count -= coupled;
    if (count) ambulo__tree_note(m->tree, NULL, "%d of <%s> are left out", count, sets[i]);
  }
  const struct {
    int count;
    const char *what, *done;
  } joints[] = {
      {m->springs, "stiffness", "joints is left out"},
      {m->bent, "damping that grows faster than the speed", "joints is left out"},
      {m->driven_roots, "armature, damping and friction",
       "joints of the free root are left out: no drive is there to have them"},
      {m->driven_balls, "armature, damping and friction",
       "ball joints are those of each of their three hinges: MuJoCo's at 0"},
  };
  for (int i = 0; i < 4; i++)
    if (joints[i].count)
      ambulo__tree_note(m->tree, NULL, "%s of %d %s", joints[i].what, joints[i].count,
                        joints[i].done);
}

static void read_option(ambulo__tree *tree, const ambulo__xml_node *option) {
  const char *flag = ambulo__xml_attribute(ambulo__xml_child(option, "flag"), "gravity");
  (void)ambulo__xml_vector(tree->xml, option, "gravity", 3, tree->gravity);
  if (flag && strcmp(flag, "disable") == 0)
    for (int i = 0; i < 3; i++) tree->gravity[i] = 0.0;
}

void ambulo__read_mjcf(ambulo__tree *tree, ambulo__xml_node *root, const char *path) {
  ambulo__mjcf m = {.tree = tree,
                    .xml = tree->xml,
                    .root = root,
                    .angle = 0.017453292519943295,
                    .sequence = "xyz",
                    .automatic_limits = 1,
                    .groups = {0, 5},
                    .inertia = AMBULO__FROM_EITHER};
  const char *name = ambulo__xml_attribute(root, "model");
  tree->format = "MuJoCo";
  if (name && name[0]) tree->name = name;
  include_files(tree->xml, root, path);
  ambulo__mjcf_index(&m);
  tree->gravity[0] = tree->gravity[1] = 0.0;
  tree->gravity[2] = -9.81;
  tree->up = 'z';
  AMBULO__XML_EACH (n, root, "option") read_option(tree, n);
  ambulo__tree_gravity(tree);
  AMBULO__XML_EACH (n, root, "compiler") read_compiler(&m, n);
  if (tree->xml->status || tree->arena->failed) return;
  ambulo__mjcf_bodies(&m);
  if (tree->xml->status || tree->arena->failed) return;
  set_total_mass(&m);
  read_actuators(&m);
  note_leftovers(&m, couple_joints(&m));
}
