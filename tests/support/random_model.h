/* tests/support/random_model.h - random trees for the tests of the mechanics.
 *
 * Joints are revolute or prismatic, about aligned or oblique axes, with and without offsets;
 * fixed and massless links, branches, bodies fixed to the world and points are mixed in. The
 * same seed gives the same tree on every machine.
 */
#ifndef TESTS_SUPPORT_RANDOM_MODEL_H
#define TESTS_SUPPORT_RANDOM_MODEL_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "ambulo/model.h"

enum { random_max_links = 160, random_max_points = 6, random_max_root = 6, random_max_knots = 7 };

typedef struct random_source {
  uint64_t state;
} random_source;

static inline double random_unit(random_source *source) {
  uint64_t z = (source->state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static inline double random_between(random_source *source, double low, double high) {
  return low + (high - low) * random_unit(source);
}

static inline int random_below(random_source *source, int limit) {
  return (int)(random_unit(source) * limit);
}

enum { random_poses = 5 };

/* A coordinate, rad or m, in a regime below random_poses: zero, small, moderate, large,
 * near-singular: multiples of 90 degrees but for a little. */
static inline double random_pose(random_source *source, int regime) {
  double quarter = 0.5 * acos(-1);
  switch (regime) {
  case 0:
    return 0;
  case 1:
    return random_between(source, -1, 1) * pow(10, random_between(source, -9, -2));
  case 2:
    return random_between(source, -3, 3);
  case 3:
    return random_between(source, -200, 200);
  default:
    return (random_below(source, 5) - 2) * quarter + random_between(source, -1e-9, 1e-9);
  }
}

typedef struct random_tree {
  ambulo_link links[random_max_links];
  ambulo_coordinate coordinates[random_max_links];
  ambulo_point points[random_max_points];
  double splines[random_max_links][2 * random_max_knots];
  char names[2 * random_max_links + random_max_points][24];
  ambulo_model_definition definition;
} random_tree;

/* A multiple of 90 degrees two times out of three, else anything. */
static inline double random_angle(random_source *source) {
  if (random_unit(source) < 0.67) return (random_below(source, 5) - 2) * 0.5 * acos(-1);
  return random_between(source, -3, 3);
}

/* Zero half of the time. */
static inline double random_length(random_source *source) {
  return random_unit(source) < 0.5 ? 0 : random_between(source, -0.5, 0.5);
}

/* Mass, centre of mass and an inertia that three pairs of mass points could have. */
static inline void random_body(random_source *source, ambulo_link *link) {
  double trace = 0, s[3][3] = {{0}};
  int diagonal = random_unit(source) < 0.5;
  link->mass = random_between(source, 0.2, 20);
  for (int i = 0; i < 3; i++) link->com[i] = random_length(source);
  for (int i = 0; i < 3; i++) {
    double p[3];
    for (int u = 0; u < 3; u++) {
      p[u] = random_between(source, -0.2, 0.2) * (diagonal && u != i ? 0 : 1);
    }
    for (int u = 0; u < 3; u++) {
      for (int v = 0; v < 3; v++) s[u][v] += link->mass * p[u] * p[v];
    }
  }
  for (int i = 0; i < 3; i++) trace += (s[i][i] += 1e-3 * link->mass);
  for (int i = 0; i < 3; i++) link->inertia[i] = trace - s[i][i];
  link->inertia[3] = -s[0][1];
  link->inertia[4] = -s[0][2];
  link->inertia[5] = -s[1][2];
}

static inline void random_link(random_source *source, random_tree *tree, int index, int moving) {
  ambulo_link *link = &tree->links[index];
  *link = ambulo_link_default();
  snprintf(tree->names[index], sizeof tree->names[0], "link_%d", index);
  link->name = tree->names[index];
  link->parent = index - 1;
  if (index > 0 && random_unit(source) < 0.3) link->parent = random_below(source, index + 1) - 1;
  link->type = AMBULO_FIXED;
  if (moving) link->type = random_unit(source) < 0.75 ? AMBULO_REVOLUTE : AMBULO_PRISMATIC;
  link->theta = random_angle(source);
  link->alpha = random_angle(source);
  link->a = random_length(source);
  link->d = random_length(source);
  if (random_unit(source) < 0.5) random_body(source, link);
}

/* A tree with so many coordinates, and about a third of fixed links. */
static inline void random_tree_make(random_tree *tree, uint64_t seed, int coordinates) {
  random_source source = {seed};
  int count = 0, moving = 0;
  memset(tree, 0, sizeof *tree);
  while (moving < coordinates) {
    int moves = random_unit(&source) < 0.67;
    random_link(&source, tree, count, moves);
    if (moves) {
      char *name = tree->names[random_max_links + moving];
      snprintf(name, sizeof tree->names[0], "q_%d", moving);
      tree->coordinates[moving] = ambulo_coordinate_default();
      tree->coordinates[moving].name = name;
      tree->coordinates[moving].type = tree->links[count].type;
      tree->coordinates[moving].mirror = moving;
      moving++;
    }
    count++;
  }
  if (tree->links[count - 1].mass == 0) random_body(&source, &tree->links[count - 1]);
  int points = random_below(&source, random_max_points + 1);
  for (int i = 0; i < points; i++) {
    char *name = tree->names[2 * random_max_links + i];
    snprintf(name, sizeof tree->names[0], "point_%d", i);
    tree->points[i].name = name;
    tree->points[i].link = random_below(&source, count);
    for (int k = 0; k < 3; k++) tree->points[i].position[k] = random_length(&source);
  }
  tree->definition = ambulo_model_definition_default();
  tree->definition.name = "random tree";
  tree->definition.links = tree->links;
  tree->definition.link_count = count;
  tree->definition.coordinates = tree->coordinates;
  tree->definition.coordinate_count = moving;
  tree->definition.points = tree->points;
  tree->definition.point_count = points;
  tree->definition.gravity[0] = random_between(&source, -2, 2);
  tree->definition.gravity[2] = random_between(&source, -2, 2);
}

/* Gives about half of the coordinates a drive, with some or all of its parts. */
static inline void random_tree_drive(random_tree *tree, uint64_t seed) {
  random_source source = {seed};
  for (int i = 0; i < tree->definition.coordinate_count; i++) {
    ambulo_coordinate *c = &tree->coordinates[i];
    int parts = random_below(&source, 16);
    if (parts & 1) c->armature = random_between(&source, 0.01, 2);
    if (parts & 2) c->damping = random_between(&source, 0.01, 2);
    if (parts & 4) c->friction = random_between(&source, 0.01, 2);
    if (parts & 8) c->armature = c->damping = c->friction = 0;
  }
}

/* A link of the chain that random_tree_put_on_root puts below a tree: most often a slider along a
 * world axis. */
static inline void random_root_link(random_source *source, ambulo_link *link, int parent) {
  static const char *const names[random_max_root] = {"root_0", "root_1", "root_2",
                                                     "root_3", "root_4", "post"};
  const double quarter = 0.5 * acos(-1);
  double kind = random_unit(source);
  *link = ambulo_link_default();
  link->name = names[parent + 1];
  link->parent = parent;
  link->type = kind < 0.6 ? AMBULO_PRISMATIC : kind < 0.9 ? AMBULO_FIXED : AMBULO_REVOLUTE;
  link->theta = (random_below(source, 5) - 2) * quarter;
  link->alpha = (random_below(source, 5) - 2) * quarter;
  if (random_unit(source) < 0.1) link->alpha = random_between(source, -3, 3);
  link->a = random_length(source);
  link->d = random_length(source);
  if (random_unit(source) < 0.15) random_body(source, link);
}

/* Puts what stands on the world on a chain of random_max_root - 1 links instead, each tree three
 * times out of four, and may fix a body to the world. The chain's joints come first; returns how
 * many they are. */
static inline int random_tree_put_on_root(random_tree *tree, uint64_t seed) {
  random_source source = {seed};
  ambulo_model_definition *definition = &tree->definition;
  ambulo_link root[random_max_root];
  const int count = random_max_root, end = count - 2;
  int moving = 0;
  for (int i = 0; i < count; i++) random_root_link(&source, &root[i], i - 1);
  root[end + 1].parent = -1;
  root[end + 1].type = AMBULO_FIXED;
  for (int i = 0; i < count; i++) moving += root[i].type != AMBULO_FIXED;
  for (int i = 0; i < definition->link_count; i++) {
    int *parent = &tree->links[i].parent;
    *parent = *parent >= 0 ? *parent + count : random_unit(&source) < 0.75 ? end : -1;
  }
  memmove(tree->links + count, tree->links, (size_t)definition->link_count * sizeof *root);
  memmove(tree->coordinates + moving, tree->coordinates,
          (size_t)definition->coordinate_count * sizeof *tree->coordinates);
  memcpy(tree->links, root, sizeof root);
  definition->link_count += count;
  definition->coordinate_count += moving;
  for (int i = 0, k = 0; i < count; i++) {
    if (root[i].type == AMBULO_FIXED) continue;
    tree->coordinates[k] = ambulo_coordinate_default();
    tree->coordinates[k].name = root[i].name;
    tree->coordinates[k++].type = root[i].type;
  }
  for (int k = 0; k < definition->coordinate_count; k++) tree->coordinates[k].mirror = k;
  for (int i = 0; i < definition->point_count; i++) tree->points[i].link += count;
  return moving;
}

/* A function of moderate slopes, whatever the pose: a spline, a polynomial or a straight line. */
static inline void random_function(random_source *source, ambulo_link *link, double *spline) {
  int count = random_below(source, random_max_knots + 1);
  double x = random_between(source, -3, 0), scale = 1;
  for (int i = 0; i<5; i++, scale *= i> 1 ? 0.01 : 1)
    link->polynomial[i] = scale * random_between(source, -1, 1);
  if (random_unit(source) < 0.3)
    link->polynomial[2] = link->polynomial[3] = link->polynomial[4] = 0;
  if (count < 2) return;
  for (int k = 0; k < count; k++) {
    spline[2 * k] = x;
    spline[2 * k + 1] = random_between(source, -0.5, 0.5);
    x += random_between(source, 0.2, 1.5);
  }
  link->knots = (const double(*)[2])(const void *)spline;
  link->knot_count = count;
}

/* Couples about a third of the joints to coordinates that are left, at least one: above, below or
 * beside them. */
static inline void random_tree_couple(random_tree *tree, uint64_t seed) {
  random_source source = {seed};
  ambulo_model_definition *d = &tree->definition;
  int left = 0, seen = 0;
  for (int i = 0; i < d->link_count; i++) {
    ambulo_link *link = &tree->links[i];
    if (link->type == AMBULO_FIXED) continue;
    int last = seen + 1 == d->coordinate_count && left == 0;
    if (!last && random_unit(&source) < 0.35) {
      link->coupled_to = 0;
      random_function(&source, link, tree->splines[i]);
    } else {
      tree->coordinates[left++] = tree->coordinates[seen];
    }
    seen++;
  }
  d->coordinate_count = left;
  for (int k = 0; k < left; k++) tree->coordinates[k].mirror = k;
  for (int i = 0; i < d->link_count; i++)
    if (tree->links[i].coupled_to >= 0) tree->links[i].coupled_to = random_below(&source, left);
}

#endif
