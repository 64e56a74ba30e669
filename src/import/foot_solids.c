/* import/foot_solids.c - where a foot touches the ground: the lowest points of its solids
 * (body_tree.h).
 *
 * The lowest point of an ellipsoid with half axes S in axes R is c - R S^2 R' u / |S R' u|; a
 * sphere is one, a capsule two spheres. Of cylinders the eight points of the rims along their own x
 * and y are taken, of boxes the corners, of meshes all vertices.
 *
 * Only what is fixed to a foot counts, first what touches other things, then what is only seen, and
 * of each solids before meshes. Toes on a joint of their own belong to a foot that is short without
 * them. Feet are measured at q = 0 and in the start pose, and the flatter one counts: a robot that
 * stands with bent knees may have its feet in the air or on their tips at q = 0.
 */
#include "import/body_tree.h"

#include "base/arithmetic.h"

#include <math.h>
#include <string.h>

enum { MOST = 8 };
/* m: a sole that is not quite level is still one; on a tip, what is no more than twice that above
 */
static const double thickness = 0.02, tilted = 0.04;
static const double shortest = 0.05; /* m: below it toes of their own belong to the foot */
static const double pointed = 1e-3;  /* m: what is shorter touches in a point */

/* points[MOST] in the axes of the solid; how many */
static int points_of(const ambulo__tree_solid *s, const double down[3], double p[MOST][3]) {
  static const double ends[2] = {-1.0, 1.0};
  const double *z = s->size;
  double size[3] = {z[0], s->shape == AMBULO__ELLIPSOID ? z[1] : z[0],
                    s->shape == AMBULO__ELLIPSOID ? z[2] : z[0]};
  memset(p, 0, MOST * sizeof *p);
  if (s->shape == AMBULO__BOX) {
    for (int k = 0; k < 8; k++)
      for (int i = 0; i < 3; i++) p[k][i] = k >> i & 1 ? z[i] : -z[i];
    return 8;
  }
  if (s->shape == AMBULO__CYLINDER) {
    for (int k = 0; k < 8; k++) {
      p[k][k >> 1 & 1] = ends[k & 1] * z[0];
      p[k][2] = ends[k >> 2 & 1] * z[1];
    }
    return 8;
  }
  double length = 0.0;
  for (int i = 0; i < 3; i++) length += size[i] * size[i] * down[i] * down[i];
  length = sqrt(length);
  int count = s->shape == AMBULO__CAPSULE ? 2 : 1;
  for (int k = 0; k < count; k++) {
    for (int i = 0; i < 3; i++) p[k][i] = length > 0.0 ? size[i] * size[i] * down[i] / length : 0.0;
    if (count == 2) p[k][2] += ends[k] * z[1];
  }
  return count;
}

static ambulo__rigid solid_place(const ambulo__tree *tree, const ambulo__tree_solid *s, int start) {
  ambulo__rigid link = ambulo__tree_pose_of(tree, s->link, start);
  return ambulo__rigid_times(&link, &s->at);
}

/* in world axes (forward, left, up) */
static int world_points(const ambulo__tree *tree, const ambulo__tree_solid *s,
                        const double axes[3][3], int start, double out[MOST][3]) {
  double p[MOST][3], down[3], local[3], world[3];
  ambulo__rigid place = solid_place(tree, s, start);
  for (int i = 0; i < 3; i++) down[i] = -axes[2][i];
  ambulo__rigid_back(&place, down, local);
  int count = points_of(s, local, p);
  for (int k = 0; k < count; k++) {
    ambulo__rigid_point(&place, p[k], world);
    for (int i = 0; i < 3; i++) out[k][i] = ambulo__dot(axes[i], world);
  }
  return count;
}

/* which solids of a foot count */
typedef struct choice {
  int leader, toes; /* links; toes -1: none */
  int seen, meshes; /* what only is seen; meshes as well */
  int start;        /* in the start pose */
  double above;     /* m: what is no higher belongs to the sole */
} choice;

static int belongs(const ambulo__tree *tree, int solid, choice of) {
  const ambulo__tree_solid *s = &tree->solids[solid];
  int leader = ambulo__tree_leader(tree, s->link);
  return (leader == of.leader || leader == of.toes) && s->seen == of.seen;
}

static void widen(ambulo__sole *sole, int pass, double above, const double p[3]) {
  if (pass == 0) sole->height = fmin(sole->height, p[2]);
  if (pass == 0 || p[2] > sole->height + above) return;
  sole->along[0] = fmin(sole->along[0], p[0]);
  sole->along[1] = fmax(sole->along[1], p[0]);
  sole->across[0] = fmin(sole->across[0], p[1]);
  sole->across[1] = fmax(sole->across[1], p[1]);
}

static void widen_by_mesh(ambulo__tree *tree, const ambulo__tree_solid *s, const double axes[3][3],
                          choice of, int pass, ambulo__sole *sole) {
  if (!s->mesh) return;
  ambulo__mesh_read(tree, s->mesh);
  ambulo__rigid place = solid_place(tree, s, of.start);
  for (int k = 0; k < s->mesh->count; k++) {
    double own[3], world[3], p[3];
    for (int i = 0; i < 3; i++) own[i] = s->scale[i] * s->mesh->points[3 * k + i];
    ambulo__rigid_point(&place, own, world);
    for (int i = 0; i < 3; i++) p[i] = ambulo__dot(axes[i], world);
    widen(sole, pass, of.above, p);
  }
}

static int measure(ambulo__tree *tree, choice of, const double axes[3][3], ambulo__sole *sole) {
  double p[MOST][3];
  int meshes = sole->meshes;
  *sole = (ambulo__sole){.along = {INFINITY, -INFINITY},
                         .across = {INFINITY, -INFINITY},
                         .height = INFINITY,
                         .meshes = meshes,
                         .start = of.start};
  for (int pass = 0; pass < 2; pass++) {
    for (int s = 0; s < tree->solid_count; s++) {
      if (!belongs(tree, s, of)) continue;
      int is_mesh = tree->solids[s].shape == AMBULO__MESH;
      sole->meshes |= is_mesh;
      if (is_mesh && of.meshes) widen_by_mesh(tree, &tree->solids[s], axes, of, pass, sole);
      if (is_mesh) continue;
      int count = world_points(tree, &tree->solids[s], axes, of.start, p);
      for (int k = 0; k < count; k++) widen(sole, pass, of.above, p[k]);
    }
  }
  return isfinite(sole->height);
}

static double length_of(const ambulo__sole *sole) {
  return sole->along[1] - sole->along[0];
}

/* The link that hangs on a foot by one joint, has nothing below it and is as low: its toes. */
static int toes_of(ambulo__tree *tree, choice of, const double axes[3][3],
                   const ambulo__sole *foot) {
  for (int i = 0; i < tree->link_count; i++) {
    const ambulo__tree_link *link = &tree->links[i];
    if (link->type == AMBULO_FIXED || link->parent < 0 || !ambulo__tree_is_end(tree, i) ||
        ambulo__tree_leader(tree, link->parent) != of.leader)
      continue;
    ambulo__sole sole = {0};
    choice own = of;
    own.leader = i;
    if (measure(tree, own, axes, &sole) && fabs(sole.height - foot->height) <= thickness) return i;
  }
  return -1;
}

/* in one pose; toes on a joint of their own belong to a short one */
static int measure_foot(ambulo__tree *tree, choice of, const double axes[3][3],
                        ambulo__sole *sole) {
  of.above = thickness;
  if (!measure(tree, of, axes, sole)) return 0;
  if (length_of(sole) >= shortest) return 1;
  of.toes = toes_of(tree, of, axes, sole);
  for (int k = of.toes < 0; k < 3; k++) {
    ambulo__sole whole = *sole;
    choice other = of;
    if (k == 1) other.toes = -1;
    if (k > 0) other.above = tilted;
    if (measure(tree, other, axes, &whole) && length_of(&whole) >= shortest) {
      *sole = whole;
      return 1;
    }
  }
  return 1;
}

/* The flatter of both poses; of a point the start pose, as what is below a ball depends on it. */
static int flatter(ambulo__tree *tree, choice of, const double axes[3][3], ambulo__sole *sole) {
  ambulo__sole start = *sole;
  if (!measure_foot(tree, of, axes, sole)) return 0;
  of.start = 1;
  if (!measure_foot(tree, of, axes, &start)) return 1;
  int points = length_of(sole) < pointed && length_of(&start) < pointed;
  if (points || length_of(&start) > 1.05 * length_of(sole)) *sole = start;
  return 1;
}

int ambulo__height_of(ambulo__tree *tree, int leader, const double axes[3][3], double *height) {
  choice of = {.leader = leader, .toes = -1, .start = 1, .above = thickness};
  ambulo__sole sole = {0};
  for (of.seen = 0; of.seen < 2; of.seen++)
    for (of.meshes = 0; of.meshes < 2; of.meshes++)
      if (measure(tree, of, axes, &sole)) {
        *height = sole.height;
        return 1;
      }
  return 0;
}

int ambulo__sole_of(ambulo__tree *tree, int link, const double axes[3][3], ambulo__sole *sole) {
  choice of = {.leader = ambulo__tree_leader(tree, link), .toes = -1};
  *sole = (ambulo__sole){0};
  for (of.seen = 0; of.seen < 2; of.seen++)
    for (of.meshes = 0; of.meshes < 2; of.meshes++)
      if (flatter(tree, of, axes, sole)) {
        sole->is_point = length_of(sole) < pointed;
        return 1;
      }
  return 0;
}

/* The box with the mass and the moments of inertia of a foot, whose edges a, b, c along its own
 * axes are from  m (b^2 + c^2) / 12 = Ixx  and so on; none where it is larger than any foot. */
int ambulo__sole_of_inertia(const ambulo__tree *tree, int link, const double axes[3][3],
                            double longest, ambulo__sole *sole) {
  int leader = ambulo__tree_leader(tree, link);
  ambulo__part body;
  ambulo__tree_whole(tree, leader, &body);
  if (!(body.mass > 0.0)) return 0;
  double turned[6], com[3], r[3][3], half[3];
  ambulo__rigid place = ambulo__tree_pose_of(tree, leader, 1);
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++)
      r[i][k] =
          axes[i][0] * place.r[0][k] + axes[i][1] * place.r[1][k] + axes[i][2] * place.r[2][k];
  ambulo__inertia_turn((const double(*)[3])r, body.inertia, turned);
  ambulo__rigid_point(&place, body.com, com);
  for (int i = 0; i < 3; i++) {
    double square = turned[(i + 1) % 3] + turned[(i + 2) % 3] - turned[i];
    half[i] = sqrt(fmax(0.0, 1.5 * square / body.mass));
  }
  if (!(half[0] > pointed) || 2.0 * half[0] > longest || 2.0 * half[1] > longest) return 0;
  double along = ambulo__dot(axes[0], com), across = ambulo__dot(axes[1], com);
  *sole = (ambulo__sole){.along = {along - half[0], along + half[0]},
                         .across = {across - half[1], across + half[1]},
                         .height = ambulo__dot(axes[2], com) - half[2],
                         .start = 1};
  return 1;
}
