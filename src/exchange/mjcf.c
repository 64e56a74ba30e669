/* exchange/mjcf.c - the rigid part of a MuJoCo model (MJCF): settings, and what is left out.
 *
 * Bodies with their joints, masses and geoms (mjcf_bodies.c), default classes, included files,
 * torque limits from actuators. Angles are degrees unless the compiler says radian; z is up.
 * Tendons, equalities, springs and dampers of joints, armature and contacts are not carried over.
 */
#include <stdlib.h>
#include <string.h>

#include "base/numtext.h"
#include "exchange/mjcf.h"

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

static void tell_leftovers(ambulo__mjcf *m) {
  static const char *const sets[] = {"tendon", "equality", "deformable", "extension"};
  for (int i = 0; i < 4; i++) {
    int count = 0;
    for (const ambulo__xml_node *set = ambulo__xml_child(m->root, sets[i]); set;
         set = ambulo__xml_next(set, sets[i]))
      for (const ambulo__xml_node *n = set->first; n; n = n->next) count++;
    if (count) ambulo__tree_note(m->tree, NULL, "%d of <%s> are left out", count, sets[i]);
  }
  if (m->armatures)
    ambulo__tree_note(m->tree, NULL, "armature of %d joints is left out: rotors have no inertia",
                      m->armatures);
  if (m->springs)
    ambulo__tree_note(m->tree, NULL, "stiffness, damping and friction of %d joints are left out",
                      m->springs);
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
  ambulo__mjcf_include(tree->xml, root, path);
  tree->gravity[0] = tree->gravity[1] = 0.0;
  tree->gravity[2] = -9.81;
  tree->up = 'z';
  for (const ambulo__xml_node *n = ambulo__xml_child(root, "option"); n;
       n = ambulo__xml_next(n, "option"))
    read_option(tree, n);
  ambulo__tree_gravity(tree);
  for (const ambulo__xml_node *n = ambulo__xml_child(root, "compiler"); n;
       n = ambulo__xml_next(n, "compiler"))
    read_compiler(&m, n);
  if (tree->xml->status || tree->arena->failed) return;
  ambulo__mjcf_key(&m);
  ambulo__mjcf_bodies(&m);
  if (tree->xml->status || tree->arena->failed) return;
  set_total_mass(&m);
  ambulo__mjcf_actuators(&m);
  tell_leftovers(&m);
}
