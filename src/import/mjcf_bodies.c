/* import/mjcf_bodies.c - the tree of bodies of a MuJoCo model (mjcf.h).
 *
 * A body stands in its parent by pos and a rotation; its joints move it one after the other, each
 * with an anchor and an axis in the body's frame:
 *
 *     T = P  prod_j  Trans(anchor_j) X_j(q_j) Trans(-anchor_j)
 *
 *   hinge   turn by q - ref about the axis
 *   slide   by q - ref along it
 *   ball    three hinges about x, y, z
 *   free    three sliders and three hinges, from where the body stands (body_tree.c)
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/numtext.h"
#include "base/arithmetic.h"
#include "import/mjcf.h"

/* ------------------------------------------------------------------- start pose */

/* The start pose is the first keyframe.
 *
 * qpos has of a free joint its place in the world and a quaternion, of a ball a quaternion, of
 * others a number, in rad or m, all in the order of the joints. With R the turn, of a free joint
 * against the body's own orientation in the file and in axes along forward, left and up,
 *
 *     free   R = Rot_y(tilt) Rot_x(list) Rot_z(rotation)     (body_tree.c)
 *     ball   R = Rot_x(x) Rot_y(y) Rot_z(z)
 */

enum { MOST = 4096 };

static void read_key(ambulo__mjcf *m) {
  const ambulo__xml_node *frames = ambulo__xml_child(m->root, "keyframe");
  const ambulo__xml_node *key = ambulo__xml_child(frames, "key");
  const char *text = key ? ambulo__xml_attribute(key, "qpos") : NULL;
  const char *name = key ? ambulo__xml_attribute(key, "name") : NULL;
  if (!text) return;
  m->key = ambulo__arena_take(m->tree->arena, MOST, sizeof *m->key);
  if (!m->key) return;
  m->key_count = ambulo__xml_numbers(m->xml, key, "qpos", text, MOST, 0, m->key);
  ambulo__tree_note(m->tree, key, "the start pose is that of keyframe '%.60s'",
                    name && name[0] ? name : "0");
}

static const double *take_key(ambulo__mjcf *m, int count) {
  int at = m->key_used;
  m->key_used += count;
  return m->key && m->key_used <= m->key_count ? m->key + at : NULL;
}

static void set(ambulo__tree *tree, int link, double value) {
  if (link < tree->link_count) tree->links[link].coordinate.default_value = value;
}

static void start_free(ambulo__mjcf *m, int first, const ambulo__rigid *body) {
  const double *key = take_key(m, 7);
  ambulo__rigid turn = ambulo__rigid_identity();
  double axes[3][3], n[3][3];
  if (!key || !ambulo__rotation_of_quaternion(key + 3, turn.r)) return;
  ambulo__rigid own = ambulo__rigid_turned(body), back = ambulo__rigid_inverse(&own);
  turn = ambulo__rigid_times(&turn, &back);
  ambulo__tree_axes(m->tree, axes);
  for (int j = 0; j < 3; j++) {
    double column[3];
    ambulo__rigid_vector(&turn, axes[j], column);
    for (int i = 0; i < 3; i++) n[i][j] = ambulo__dot(axes[i], column);
  }
  for (int i = 0; i < 3; i++) set(m->tree, first + i, key[i] - body->p[i]);
  set(m->tree, first + 3, atan2(n[0][2], n[2][2]));
  set(m->tree, first + 4, -asin(fmax(-1.0, fmin(1.0, n[1][2]))));
  set(m->tree, first + 5, atan2(n[1][0], n[1][1]));
}

static void start_ball(ambulo__mjcf *m, int first) {
  const double *key = take_key(m, 4);
  double n[3][3];
  if (!key || !ambulo__rotation_of_quaternion(key, n)) return;
  set(m->tree, first, atan2(-n[1][2], n[2][2]));
  set(m->tree, first + 1, asin(fmax(-1.0, fmin(1.0, n[0][2]))));
  set(m->tree, first + 2, atan2(-n[0][1], n[0][0]));
}

/* what is known while one body is read */
typedef struct reading {
  ambulo__mjcf *m;
  const ambulo__xml_node *node;
  const char *name, *around; /* of the body; default class of its elements */
  int joints;
} reading;

static const char *given_name(ambulo__mjcf *m, const ambulo__xml_node *node, const char *kind) {
  const char *name = ambulo__xml_attribute(node, "name");
  if (name && name[0]) return name;
  return ambulo__arena_print(m->tree->arena, "%s_%d", kind, ++m->unnamed);
}

/* -------------------------------------------------------------------------- joints */

static void read_limits(reading *b, const ambulo__xml_node *joint, int slides, int link) {
  ambulo__mjcf *m = b->m;
  ambulo_coordinate *c = &m->tree->links[link].coordinate;
  double range[2], unit = slides ? 1.0 : m->angle, force[2];
  int limited = ambulo__mjcf_flag(m, joint, b->around, "limited", -1);
  int given = ambulo__mjcf_numbers(m, joint, b->around, "range", 2, 2, range);
  if (limited < 0) limited = m->automatic_limits && given;
  if (limited && given) ambulo__tree_range(m->tree, link, range, unit, joint);
  if (ambulo__mjcf_numbers(m, joint, b->around, "actuatorfrcrange", 2, 2, force) &&
      force[0] < force[1]) {
    c->torque[0] = force[0];
    c->torque[1] = force[1];
  }
}

/* What the joint's drive adds, the same for each of its coordinates: links `first` and on. Those of
 * a free root cannot have it. */
static void read_drive(reading *b, const ambulo__xml_node *joint, int first, int is_root) {
  static const char *const names[] = {"armature", "damping", "frictionloss", "stiffness"};
  ambulo__mjcf *m = b->m;
  double value[4][3] = {{0.0}};
  for (int i = 0; i < 4; i++)
    (void)ambulo__mjcf_numbers(m, joint, b->around, names[i], 1, i == 0 ? 1 : 3, value[i]);
  int is_driven = value[0][0] != 0.0 || value[1][0] != 0.0 || value[2][0] != 0.0;
  m->springs += value[3][0] != 0.0 || value[3][1] != 0.0 || value[3][2] != 0.0;
  m->bent += value[1][1] != 0.0 || value[1][2] != 0.0;
  m->driven_roots += is_driven && is_root;
  m->driven_balls += is_driven && !is_root && m->tree->link_count - first > 1;
  for (int link = first; link < m->tree->link_count && !is_root; link++) {
    ambulo_coordinate *c = &m->tree->links[link].coordinate;
    c->armature = value[0][0];
    c->damping = value[1][0];
    c->friction = value[2][0];
    m->tree->links[link].stiffness = value[3][0];
  }
}

static void shift(ambulo__chain *chain, const double by[3], double factor) {
  ambulo__rigid step = ambulo__rigid_step(1, by, factor);
  ambulo__chain_place(chain, &step);
}

static void one_coordinate(reading *b, ambulo__chain *chain, const ambulo__xml_node *joint,
                           int slides, const char *name) {
  ambulo__mjcf *m = b->m;
  double axis[3] = {0, 0, 1}, zero = 0.0;
  (void)ambulo__mjcf_numbers(m, joint, b->around, "axis", 3, 3, axis);
  if (!ambulo__tree_axis(m->tree, axis, name, joint)) return;
  int link = ambulo__chain_joint(chain, slides ? AMBULO_PRISMATIC : AMBULO_REVOLUTE, axis, name);
  if (link < 0) return;
  read_limits(b, joint, slides, link);
  (void)ambulo__mjcf_numbers(m, joint, b->around, "ref", 1, 1, &zero);
  const double *key = take_key(m, 1);
  m->tree->links[link].reference = slides ? zero : zero * m->angle;
  m->tree->links[link].coordinate.default_value = ambulo__tree_pose(m->tree, name,
                                                                    key      ? *key
                                                                    : slides ? zero
                                                                             : zero * m->angle);
  if (zero == 0.0) return;
  ambulo__rigid reference = ambulo__rigid_step(slides, axis, slides ? -zero : -zero * m->angle);
  ambulo__chain_place(chain, &reference);
}

enum { FREE, BALL, SLIDE, HINGE, TYPES };

static void add_joint(reading *b, ambulo__chain *chain, const ambulo__xml_node *joint) {
  static const char *const types[TYPES] = {"free", "ball", "slide", "hinge"};
  ambulo__mjcf *m = b->m;
  const char *word = ambulo__mjcf_text(m, joint, b->around, "type");
  int type = HINGE, first = 0;
  double anchor[3] = {0, 0, 0};
  if (ambulo__xml_is(joint, "freejoint")) word = "free";
  if (word) type = ambulo__xml_choice(m->xml, joint, "type of joint", word, types, TYPES);
  if (type < 0) return;
  const char *own = ambulo__xml_attribute(joint, "name");
  const char *name =
      own && own[0]  ? own
      : type == FREE ? "base"
                     : ambulo__arena_print(m->tree->arena, "%.50s_joint%d", b->name, b->joints + 1);
  b->joints++;
  if (type == FREE) {
    m->tree->root_free |= chain->parent < 0;
    ambulo__rigid body = chain->pending,
                  turned = body; /* sliders and hinges are the world's, not the body's */
    chain->pending = ambulo__rigid_shift(turned.p);
    turned = ambulo__rigid_turned(&turned);
    first = m->tree->link_count;
    ambulo__chain_free(chain, name);
    ambulo__chain_place(chain, &turned);
    start_free(m, first, &body);
    if (ambulo__xml_is(joint, "joint")) read_drive(b, joint, first, 1); /* a <freejoint> has none */
    return;
  }
  (void)ambulo__mjcf_numbers(m, joint, b->around, "pos", 3, 3, anchor);
  shift(chain, anchor, 1.0);
  first = m->tree->link_count;
  if (type == BALL) {
    ambulo__chain_ball(chain, name, &first);
    start_ball(m, first);
  } else {
    one_coordinate(b, chain, joint, type == SLIDE, name);
  }
  read_drive(b, joint, first, 0);
  shift(chain, anchor, -1.0);
}

/* -------------------------------------------------------------------------- bodies */

static void read_inertial(reading *b, const ambulo__xml_node *node, ambulo__part *body) {
  ambulo__mjcf *m = b->m;
  double diagonal[3], full[6] = {0};
  ambulo__rigid frame = ambulo__mjcf_place(m, node, b->around);
  if (!ambulo__mjcf_numbers(m, node, b->around, "mass", 1, 1, &body->mass)) {
    ambulo__xml_error(m->xml, node, AMBULO_E_SCHEMA, NULL,
                      "<inertial> of body '%.60s' has no mass; expected mass=...", b->name);
    return;
  }
  if (ambulo__mjcf_numbers(m, node, b->around, "diaginertia", 3, 3, diagonal)) {
    memcpy(full, diagonal, sizeof diagonal);
  } else if (!ambulo__mjcf_numbers(m, node, b->around, "fullinertia", 6, 6, full) &&
             body->mass > 0.0) {
    ambulo__xml_error(m->xml, node, AMBULO_E_SCHEMA, NULL,
                      "<inertial> of body '%.60s' has a mass but no inertia; expected diaginertia "
                      "or fullinertia",
                      b->name);
  }
  memcpy(body->com, frame.p, sizeof body->com);
  ambulo__inertia_turn((const double(*)[3])frame.r, full, body->inertia);
}

static const char *class_of(const ambulo__xml_node *node, const char *around) {
  const char *name = ambulo__xml_attribute(node, "childclass");
  return name ? name : around;
}

/* geoms of the body and of frames in it */
static void read_geoms(reading *b, const ambulo__xml_node *node, const char *around,
                       const ambulo__rigid *frame, int massive, int link, ambulo__part *body) {
  for (const ambulo__xml_node *n = node->first; n; n = n->next) {
    if (ambulo__xml_is(n, "frame")) {
      ambulo__rigid own = ambulo__mjcf_place(b->m, n, around);
      ambulo__rigid inner = ambulo__rigid_times(frame, &own);
      read_geoms(b, n, class_of(n, around), &inner, massive, link, body);
    }
    if (!ambulo__xml_is(n, "geom")) continue;
    ambulo__tree_solid solid = {.link = link};
    int has_solid = 0;
    ambulo__mjcf_geom(b->m, n, around, frame, massive, body, &solid, &has_solid);
    if (has_solid) ambulo__tree_add_solid(b->m->tree, &solid);
  }
}

static void read_mass(reading *b, int link) {
  ambulo__mjcf *m = b->m;
  const ambulo__xml_node *inertial = ambulo__xml_child(b->node, "inertial");
  ambulo__part body = {0};
  ambulo__rigid none = ambulo__rigid_identity();
  int massive =
      m->inertia == AMBULO__FROM_GEOMS || (m->inertia == AMBULO__FROM_EITHER && !inertial);
  if (!massive && inertial) read_inertial(b, inertial, &body);
  read_geoms(b, b->node, b->around, &none, massive, link, &body);
  if (m->xml->status) return;
  if (body.mass < m->least_mass) body.mass = m->least_mass;
  for (int i = 0; i < 3; i++)
    if (body.inertia[i] < m->least_inertia) body.inertia[i] = m->least_inertia;
  const ambulo__xml_node *at = inertial ? inertial : b->node;
  ambulo__tree_body(m->tree, link, &body, at, at);
}

/* joints of a root of its own that nothing drives; if it slides, nothing but the world could turn
 * rotors there */
static void free_root(reading *b, int first) {
  ambulo__tree *t = b->m->tree;
  int slides = 0;
  for (int i = first; i < t->link_count; i++) slides |= t->links[i].type == AMBULO_PRISMATIC;
  for (int i = first; i < t->link_count && b->joints >= 2; i++) {
    ambulo_coordinate *c = &t->links[i].coordinate;
    if (!c->name || ambulo__mjcf_is_driven(b->m, c->name)) continue;
    c->actuated = 0;
    if (!slides) continue;
    b->m->driven_roots += c->armature != 0.0 || c->damping != 0.0 || c->friction != 0.0;
    c->armature = c->damping = c->friction = 0.0;
  }
}

static void read_bodies(ambulo__mjcf *m, const ambulo__xml_node *node, int parent,
                        const char *around, const ambulo__rigid *frame);

static void read_body(ambulo__mjcf *m, const ambulo__xml_node *node, int parent, const char *around,
                      const ambulo__rigid *frame) {
  ambulo__tree *tree = m->tree;
  reading b = {.m = m, .node = node, .name = given_name(m, node, "body")};
  b.around = class_of(node, around);
  ambulo__rigid place = ambulo__mjcf_place(m, node, b.around), none = ambulo__rigid_identity();
  ambulo__chain chain = ambulo__chain_begin(tree, parent, node);
  int first = tree->link_count, top = ambulo__xml_is(node->parent, "worldbody");
  ambulo__chain_place(&chain, frame);
  ambulo__chain_place(&chain, &place);
  for (const ambulo__xml_node *n = node->first; n; n = n->next)
    if (ambulo__xml_is(n, "joint") || ambulo__xml_is(n, "freejoint")) add_joint(&b, &chain, n);
  int link = ambulo__chain_end(&chain, b.name);
  if (link < 0 || m->xml->status) return;
  if (top) free_root(&b, first);
  read_mass(&b, link);
  read_bodies(m, node, link, b.around, &none);
}

/* bodies below a body, the world or a frame */
static void read_bodies(ambulo__mjcf *m, const ambulo__xml_node *node, int parent,
                        const char *around, const ambulo__rigid *frame) {
  static const char *const unknown[] = {"composite", "flexcomp", "replicate", "attach"};
  for (const ambulo__xml_node *n = node->first; n && !m->xml->status; n = n->next) {
    for (int i = 0; i < 4; i++)
      if (ambulo__xml_is(n, unknown[i]))
        ambulo__xml_error(m->xml, n, AMBULO_E_SCHEMA, "save the model from MuJoCo: mj_saveLastXML",
                          "<%s> generates bodies and is not supported; expected <body>", n->name);
    if (ambulo__xml_is(n, "body")) read_body(m, n, parent, around, frame);
    if (!ambulo__xml_is(n, "frame")) continue;
    ambulo__rigid own = ambulo__mjcf_place(m, n, around);
    ambulo__rigid inner = ambulo__rigid_times(frame, &own);
    read_bodies(m, n, parent, class_of(n, around), &inner);
  }
}

static int count_bodies(const ambulo__xml_node *node) {
  int count = 0;
  for (const ambulo__xml_node *n = node->first; n; n = n->next)
    count += ambulo__xml_is(n, "body") ? 1 : ambulo__xml_is(n, "frame") ? count_bodies(n) : 0;
  return count;
}

void ambulo__mjcf_bodies(ambulo__mjcf *m) {
  ambulo__rigid none = ambulo__rigid_identity();
  int roots = 0, ground = -1;
  read_key(m);
  AMBULO__XML_EACH (n, m->root, "worldbody") roots += count_bodies(n);
  if (roots > 1)
    ground = ambulo__tree_add(m->tree, "ground", -1, AMBULO_FIXED, &none, NULL, m->root);
  AMBULO__XML_EACH (n, m->root, "worldbody") read_bodies(m, n, ground, class_of(n, NULL), &none);
}
