/* tests/support/symmetric_model.h - random bodies that are their own mirror image.
 *
 * A trunk of joints in the mirror plane or across it carries pairs of limbs. A limb is a chain of
 * random links; its partner is built from frames that are reflected, F_l = M F_r S, with S the
 * reflection along one of the frame's own axes, which changes from link to link (a fixed link
 * between them turns by 180 degrees): so left and right are described in frames of either
 * handedness, with either sign; and an origin may lie elsewhere on its axis. A DH row (theta, d, a,
 * alpha) between two such frames becomes
 *
 *     S along z   ( theta, -d,  a, -alpha),   hinge +q, slider -q
 *     S along y   (-theta,  d,  a, -alpha),   hinge -q, slider +q
 *     S along x   (-theta,  d, -a,  alpha),   hinge -q, slider +q
 */
#ifndef TESTS_SUPPORT_SYMMETRIC_MODEL_H
#define TESTS_SUPPORT_SYMMETRIC_MODEL_H

#include "support/random_model.h"

enum { symmetric_points = 10 };

typedef struct symmetric_body {
  ambulo_link links[random_max_links];
  int across[random_max_links];  /* axis of the frame along which it is reflected; of a trunk link
                                    the one across the mirror plane */
  int partner[random_max_links]; /* link on the other side; itself in the trunk; -1: none */
  ambulo_coordinate coordinates[random_max_links];
  ambulo_point points[symmetric_points];
  ambulo_foot feet[2];
  char names[2 * random_max_links][16];
  int name_count, trunk; /* trunk: number of its links, which come first */
  ambulo_model_definition definition;
} symmetric_body;

static inline const char *symmetric_name(symmetric_body *b, const char *prefix, int number) {
  char *name = b->names[b->name_count++];
  snprintf(name, sizeof b->names[0], "%s_%d", prefix, number);
  return name;
}

static inline double right_angles(random_source *source) {
  return (random_below(source, 4) - 1) * 0.5 * acos(-1);
}

/* is `angle` an odd multiple of 90 degrees? */
static inline int is_quarter(double angle) {
  return fabs(cos(angle)) < 0.5;
}

static inline ambulo_link *symmetric_link(symmetric_body *b, const char *prefix, int parent,
                                          ambulo_joint_type type) {
  int index = b->definition.link_count++;
  ambulo_link *link = &b->links[index];
  *link = ambulo_link_default();
  link->name = symmetric_name(b, prefix, index);
  link->parent = parent;
  link->type = type;
  b->partner[index] = -1;
  return link;
}

/* of the link made last; `mirror` -1: itself */
static inline int symmetric_coordinate(symmetric_body *b, const char *prefix, int mirror,
                                       double sign) {
  int index = b->definition.coordinate_count++;
  ambulo_coordinate *c = &b->coordinates[index];
  *c = ambulo_coordinate_default();
  c->name = symmetric_name(b, prefix, index);
  c->mirror = mirror;
  c->mirror_sign = sign;
  if (mirror >= 0) b->coordinates[mirror].mirror = index;
  return index;
}

static inline ambulo_joint_type symmetric_type(random_source *source) {
  double kind = random_unit(source);
  return kind < 0.25 ? AMBULO_FIXED : kind < 0.8 ? AMBULO_REVOLUTE : AMBULO_PRISMATIC;
}

/* a joint that keeps the mirror plane, on link `parent`, whose frame has `across` across it */
static inline void symmetric_trunk_link(random_source *source, symmetric_body *b, int parent,
                                        int across) {
  ambulo_joint_type type = parent < 0 ? AMBULO_REVOLUTE : symmetric_type(source);
  ambulo_link *link = symmetric_link(b, "t", parent, type);
  int index = b->definition.link_count - 1, lateral = across == 2;
  link->theta = lateral ? random_angle(source) : right_angles(source);
  link->d = lateral ? 0 : random_length(source);
  if (!lateral && is_quarter(link->theta)) across = 1 - across;
  link->a = across == 0 ? 0 : random_length(source);
  link->alpha = across == 0 ? random_angle(source) : right_angles(source);
  if (across != 0 && is_quarter(link->alpha)) across = 3 - across;
  if (type != AMBULO_FIXED)
    (void)symmetric_coordinate(b, "qt", -1, (type == AMBULO_REVOLUTE) == lateral ? 1 : -1);
  if (random_unit(source) < 0.6) {
    static const int odd[3][2] = {{3, 4}, {3, 5}, {4, 5}};
    random_body(source, link);
    link->com[across] = 0;
    for (int k = 0; k < 2; k++) link->inertia[odd[across][k]] = 0;
  }
  b->across[index] = across;
  b->partner[index] = index;
}

/* a vector of a right frame in the left one */
static inline void symmetric_vector(int across, const double from[3], double to[3]) {
  for (int k = 0; k < 3; k++) to[k] = k == across ? -from[k] : from[k];
}

/* the row of a left link from that of the right one */
static inline void symmetric_row(int across, const ambulo_link *right, ambulo_link *left) {
  static const int odd[3][2] = {{3, 4}, {3, 5}, {4, 5}};
  left->theta = across == 2 ? right->theta : -right->theta;
  left->d = across == 2 ? -right->d : right->d;
  left->a = across == 0 ? -right->a : right->a;
  left->alpha = across == 0 ? right->alpha : -right->alpha;
  left->mass = right->mass;
  symmetric_vector(across, right->com, left->com);
  memcpy(left->inertia, right->inertia, sizeof left->inertia);
  for (int k = 0; k < 2; k++) left->inertia[odd[across][k]] = -right->inertia[odd[across][k]];
}

/* one more pair of links; *right and *left are their parents, then they themselves */
static inline void symmetric_pair(random_source *source, symmetric_body *b, int *right, int *left) {
  int across = b->across[*left], wanted = random_below(source, 3);
  ambulo_joint_type type = symmetric_type(source);
  if (wanted != across && random_unit(source) < 0.5) { /* reflected along another axis */
    ambulo_link *turn = symmetric_link(b, "k", *left, AMBULO_FIXED);
    *left = b->definition.link_count - 1;
    if (wanted + across != 3) turn->theta = acos(-1); /* not about x: y and z stay */
    if (wanted + across != 1) turn->alpha = acos(-1); /* not about z */
    b->across[*left] = across = wanted;
  }
  ambulo_link *r = symmetric_link(b, "r", *right, type);
  *right = b->definition.link_count - 1;
  r->theta = random_angle(source);
  r->alpha = random_angle(source);
  r->a = random_length(source);
  r->d = random_length(source);
  if (random_unit(source) < 0.7) random_body(source, r);
  int coordinate = type == AMBULO_FIXED ? -1 : symmetric_coordinate(b, "qr", -1, 1);
  double along = random_unit(source) < 0.3 ? random_between(source, -0.3, 0.3) : 0;
  if (along != 0) { /* the joint's frame stands elsewhere on the same axis */
    symmetric_link(b, "k", *left, AMBULO_FIXED)->d = along;
    *left = b->definition.link_count - 1;
    b->across[*left] = across;
  }
  ambulo_link *l = symmetric_link(b, "l", *left, type);
  *left = b->definition.link_count - 1;
  symmetric_row(across, r, l);
  l->d -= along;
  b->across[*right] = b->across[*left] = across;
  b->partner[*right] = *left;
  b->partner[*left] = *right;
  if (coordinate < 0) return;
  double sign = (type == AMBULO_REVOLUTE) == (across == 2) ? 1 : -1;
  b->coordinates[coordinate].mirror_sign = sign;
  (void)symmetric_coordinate(b, "ql", coordinate, sign);
}

/* feet of four corners on the links right and left */
static inline void symmetric_feet(random_source *source, symmetric_body *b, int right, int left) {
  for (int i = 0; i < symmetric_points / 2; i++) {
    ambulo_point *r = &b->points[i], *l = &b->points[i + symmetric_points / 2];
    r->name = symmetric_name(b, "pr", i);
    l->name = symmetric_name(b, "pl", i);
    r->link = right;
    l->link = left;
    for (int k = 0; k < 3; k++) r->position[k] = random_between(source, -0.3, 0.3);
    symmetric_vector(b->across[left], r->position, l->position);
  }
  b->feet[0] = (ambulo_foot){"right", {0, 1}, {2, 3}, 0, 2, 1, 1, 4, 0, {-1, -1}};
  /* corners in another order */
  b->feet[1] = (ambulo_foot){"left", {6, 5}, {7, 8}, 5, 7, 0, 1, 9, 0, {-1, -1}};
  b->definition.points = b->points;
  b->definition.point_count = symmetric_points;
  b->definition.feet = b->feet;
  b->definition.foot_count = 2;
}

/* which way the world is turned: gravity, forward, and the axis across the mirror plane */
static inline int symmetric_world(random_source *source, ambulo_model_definition *d) {
  static const int up[3] = {2, 2, 1}, forward[3] = {1, 0, 0};
  int across = random_below(source, 3);
  for (int k = 0; k < 3; k++) d->gravity[k] = d->forward[k] = 0;
  d->gravity[up[across]] = -9.81;
  d->forward[forward[across]] = random_unit(source) < 0.5 ? 1 : -1;
  return across;
}

static inline void symmetric_make(symmetric_body *b, uint64_t seed, int trunk, int limbs,
                                  int length) {
  random_source source = {seed};
  memset(b, 0, sizeof *b);
  ambulo_model_definition *d = &b->definition;
  *d = ambulo_model_definition_default();
  d->name = "symmetric body";
  int across = symmetric_world(&source, d);
  for (int i = 0; i < trunk; i++) {
    int parent = i > 0 && random_unit(&source) < 0.3 ? random_below(&source, i) : i - 1;
    symmetric_trunk_link(&source, b, parent, parent < 0 ? across : b->across[parent]);
  }
  b->trunk = trunk;
  for (int i = 0; i < limbs; i++) {
    int right = random_below(&source, trunk), left = right;
    for (int k = 0; k < length; k++) symmetric_pair(&source, b, &right, &left);
    if (b->links[right].mass == 0) {
      random_body(&source, &b->links[right]);
      double kept = b->links[left].d;
      symmetric_row(b->across[left], &b->links[right], &b->links[left]);
      b->links[left].d = kept;
    }
    if (i == 0) symmetric_feet(&source, b, right, left);
  }
  d->links = b->links;
  d->coordinates = b->coordinates;
}

#endif
