/* exchange/foot_solids.c - the lowest points of solids (foot_solids.h).
 *
 * The lowest point of an ellipsoid with half axes S in axes R is c - R S^2 R' u / |S R' u|; a
 * sphere is one, a capsule two spheres. Of cylinders the eight points of the rims along their own x
 * and y are taken, of boxes the corners, of meshes all vertices, where a foot has no other solids.
 */
#include "exchange/foot_solids.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "exchange/side.h"

enum { MOST = 8 };
static const double thickness = 0.02; /* m: a sole that is not quite level is still one */
static const double shortest = 0.05;  /* m: below it toes of their own belong to the foot */

char ambulo__side_of_link(const ambulo__tree *tree, int link) {
  const char *name = tree->links[link].name;
  char other[80], side = ambulo__side_of(name);
  if (side || !ambulo__flip_letter(name, 0, other, sizeof other)) return side;
  return ambulo__tree_find(tree, other) >= 0 ? name[0] : 0;
}

int ambulo__rigid_leader(const ambulo__tree *tree, int link) {
  while (tree->links[link].type == AMBULO_FIXED && tree->links[link].parent >= 0)
    link = tree->links[link].parent;
  return link;
}

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

/* in world axes (forward, left, up) */
static int world_points(const ambulo__tree *tree, const ambulo__tree_solid *s,
                        const double axes[3][3], double out[MOST][3]) {
  double p[MOST][3], down[3], local[3], world[3];
  ambulo__rigid link = ambulo__tree_place(tree, s->link);
  ambulo__rigid place = ambulo__rigid_times(&link, &s->at);
  for (int i = 0; i < 3; i++) down[i] = -axes[2][i];
  ambulo__rigid_back(&place, down, local);
  int count = points_of(s, local, p);
  for (int k = 0; k < count; k++) {
    ambulo__rigid_point(&place, p[k], world);
    for (int i = 0; i < 3; i++) out[k][i] = ambulo__dot(axes[i], world);
  }
  return count;
}

static int hangs_on(const ambulo__tree *tree, int link, int above) {
  while (link >= 0 && link != above) link = tree->links[link].parent;
  return link == above;
}

/* one of `whole`: of the link and all below it, else of what is fixed to it */
static int belongs(const ambulo__tree *tree, int solid, int leader, int whole) {
  int link = tree->solids[solid].link;
  return whole ? hangs_on(tree, link, leader) : ambulo__rigid_leader(tree, link) == leader;
}

/* which solids of a foot count */
typedef struct choice {
  int leader, whole, meshes;
} choice;

static void widen(ambulo__sole *sole, int pass, const double p[3]) {
  if (pass == 0) sole->height = fmin(sole->height, p[2]);
  if (pass == 0 || p[2] > sole->height + thickness) return;
  sole->along[0] = fmin(sole->along[0], p[0]);
  sole->along[1] = fmax(sole->along[1], p[0]);
  sole->across[0] = fmin(sole->across[0], p[1]);
  sole->across[1] = fmax(sole->across[1], p[1]);
}

static void widen_by_mesh(const ambulo__tree *tree, const ambulo__tree_solid *s,
                          const double axes[3][3], int pass, ambulo__sole *sole) {
  if (!s->mesh) return;
  ambulo__mesh_read(tree->arena, s->mesh);
  ambulo__rigid link = ambulo__tree_place(tree, s->link);
  ambulo__rigid place = ambulo__rigid_times(&link, &s->at);
  for (int k = 0; k < s->mesh->count; k++) {
    double world[3], p[3];
    ambulo__rigid_point(&place, s->mesh->points + 3 * k, world);
    for (int i = 0; i < 3; i++) p[i] = ambulo__dot(axes[i], world);
    widen(sole, pass, p);
  }
}

static int measure(const ambulo__tree *tree, choice of, const double axes[3][3],
                   ambulo__sole *sole) {
  double p[MOST][3];
  *sole = (ambulo__sole){
      .along = {INFINITY, -INFINITY}, .across = {INFINITY, -INFINITY}, .height = INFINITY};
  for (int pass = 0; pass < 2; pass++) {
    for (int s = 0; s < tree->solid_count; s++) {
      if (!belongs(tree, s, of.leader, of.whole)) continue;
      if (tree->solids[s].shape == AMBULO__MESH) {
        sole->meshes += pass;
        if (of.meshes) widen_by_mesh(tree, &tree->solids[s], axes, pass, sole);
        continue;
      }
      sole->solids += pass;
      int count = world_points(tree, &tree->solids[s], axes, p);
      for (int k = 0; k < count; k++) widen(sole, pass, p[k]);
    }
  }
  return isfinite(sole->height);
}

/* from solids that are no meshes: toes of their own may belong to it */
static int sole_of_solids(const ambulo__tree *tree, int leader, const double axes[3][3],
                          ambulo__sole *sole) {
  int found = measure(tree, (choice){leader, 0, 0}, axes, sole);
  if (!found || sole->along[1] - sole->along[0] >= shortest) return found;
  ambulo__sole whole;
  if (measure(tree, (choice){leader, 1, 0}, axes, &whole) &&
      whole.along[1] - whole.along[0] >= shortest)
    *sole = whole;
  return sole->along[1] - sole->along[0] >= 1e-3;
}

static int sole_of_meshes(const ambulo__tree *tree, int leader, const double axes[3][3],
                          ambulo__sole *sole) {
  return measure(tree, (choice){leader, 0, 1}, axes, sole) &&
         sole->along[1] - sole->along[0] >= 1e-3;
}

int ambulo__sole_of(const ambulo__tree *tree, int link, const double axes[3][3],
                    ambulo__sole *sole) {
  int leader = ambulo__rigid_leader(tree, link);
  if (sole_of_solids(tree, leader, axes, sole)) return 1;
  return sole->solids == 0 && sole->meshes > 0 && sole_of_meshes(tree, leader, axes, sole);
}

int ambulo__lowest_link(const ambulo__tree *tree, const double axes[3][3], char side) {
  int lowest = -1;
  double height = INFINITY;
  for (int meshes = 0; meshes < 2 && lowest < 0; meshes++) {
    for (int s = 0; s < tree->solid_count; s++) {
      ambulo__sole sole;
      int leader = ambulo__rigid_leader(tree, tree->solids[s].link);
      if (ambulo__side_of_link(tree, leader) != side) continue;
      int found = meshes ? sole_of_meshes(tree, leader, axes, &sole)
                         : sole_of_solids(tree, leader, axes, &sole);
      if (!found || !(sole.height < height)) continue;
      height = sole.height;
      lowest = leader;
    }
  }
  return lowest;
}
