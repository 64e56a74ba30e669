/* import/tree_functions.c - joints of a tree that are functions of coordinates.
 *
 * A joint that follows one that follows another is a function of the last: g(f(x)). With f = a x +
 * b
 *
 *     spline      the points (x, y) of g become ((x - b) / a, y): it stays the spline through them
 *     polynomial  g's coefficients in powers of a x + b
 *
 * and with g straight, f's points or coefficients are scaled. Two curves are not put together.
 *
 * What drives a joint y = a x + b is carried over to x by virtual work: armature and damping times
 * a^2, dry friction times |a|.
 */
#include <math.h>
#include <string.h>

#include "base/numtext.h"
#include "import/body_tree.h"

enum { TERMS = AMBULO__COUPLING_TERMS };

ambulo__tree_function ambulo__tree_line(double slope, double offset) {
  return (ambulo__tree_function){.polynomial = {offset, slope}};
}

int ambulo__function_is_line(const ambulo__tree_function *f) {
  const double *c = f->polynomial;
  return f->count == 0 && c[2] == 0.0 && c[3] == 0.0 && c[4] == 0.0;
}

double ambulo__function_value(const ambulo__tree *tree, const ambulo__tree_function *f, double x) {
  ambulo_link link = {.knots = (const double(*)[2])(const void *)f->points, .knot_count = f->count};
  memcpy(link.polynomial, f->polynomial, sizeof link.polynomial);
  ambulo__coupling coupling = {.count = ambulo__coupling_count(&link)};
  ambulo__piece *pieces = ambulo__arena_take(tree->arena, (size_t)coupling.count, sizeof *pieces);
  if (!pieces) return 0.0;
  ambulo__coupling_fill(&link, pieces);
  coupling.pieces = pieces;
  return ambulo__coupling_value(&coupling, x, NULL);
}

/* scale f + shift */
static int scaled(ambulo__tree *tree, const ambulo__tree_function *f, double scale, double shift,
                  ambulo__tree_function *out) {
  *out = *f;
  for (int i = 0; i < TERMS; i++) out->polynomial[i] *= scale;
  out->polynomial[0] += shift;
  if (f->count == 0) return 1;
  double *points = ambulo__arena_take(tree->arena, 2 * (size_t)f->count, sizeof *points);
  if (!points) return 0;
  for (int i = 0; i < f->count; i++) {
    points[2 * i] = f->points[2 * i];
    points[2 * i + 1] = scale * f->points[2 * i + 1] + shift;
  }
  out->points = points;
  return 1;
}

/* g(a x + b), a not 0 */
static int substituted(ambulo__tree *tree, const ambulo__tree_function *g, double a, double b,
                       ambulo__tree_function *out) {
  *out = (ambulo__tree_function){.count = g->count};
  double power[TERMS] = {1.0};
  for (int i = 0; i < TERMS; i++) { /* of (a x + b) to the power of i */
    for (int k = 0; k < TERMS; k++) out->polynomial[k] += g->polynomial[i] * power[k];
    for (int k = TERMS - 1; k >= 0; k--) power[k] = b * power[k] + (k > 0 ? a * power[k - 1] : 0.0);
  }
  if (g->count == 0) return 1;
  double *points = ambulo__arena_take(tree->arena, 2 * (size_t)g->count, sizeof *points);
  if (!points) return 0;
  for (int i = 0; i < g->count; i++) {
    const double *from = g->points + (size_t)(2 * (a > 0.0 ? i : g->count - 1 - i));
    points[2 * i] = (from[0] - b) / a;
    points[2 * i + 1] = from[1];
  }
  out->points = points;
  return 1;
}

int ambulo__function_of_function(ambulo__tree *tree, const ambulo__tree_function *g,
                                 const ambulo__tree_function *f, ambulo__tree_function *out) {
  if (ambulo__function_is_line(g)) return scaled(tree, f, g->polynomial[1], g->polynomial[0], out);
  if (!ambulo__function_is_line(f)) return 0;
  if (f->polynomial[1] != 0.0) return substituted(tree, g, f->polynomial[1], f->polynomial[0], out);
  *out = ambulo__tree_line(0.0, ambulo__function_value(tree, g, f->polynomial[0]));
  return 1;
}

void ambulo__tree_couple(ambulo__tree *tree, int link, const char *to,
                         const ambulo__tree_function *function) {
  if (link < 0) return;
  ambulo__tree_link *l = &tree->links[link];
  ambulo_coordinate own = l->coordinate;
  l->was = own.name;
  l->coordinate = ambulo_coordinate_default();
  l->coordinate.armature = own.armature;
  l->coordinate.damping = own.damping;
  l->coordinate.friction = own.friction;
  l->coordinate.name = NULL;
  l->coordinate.type = l->type;
  l->follows = to;
  l->function = *function;
}

double ambulo__tree_stands(const ambulo__tree *tree, int link, int start) {
  const ambulo__tree_link *l = &tree->links[link];
  int to = l->follows ? ambulo__tree_find_coordinate(tree, l->follows) : -1;
  if (!l->follows) return start ? l->coordinate.default_value : 0.0;
  double x = start && to >= 0 ? tree->links[to].coordinate.default_value : 0.0;
  return ambulo__function_value(tree, &l->function, x);
}

/* ----------------------------------------------------------------- what they follow */

/* A joint that cannot follow stands where it would stand at the other's pose. */
static void hold(ambulo__tree *tree, ambulo__tree_link *l, const char *why) {
  double x = ambulo__tree_pose(tree, l->follows, 0.0);
  double value = ambulo__function_value(tree, &l->function, x);
  ambulo__rigid step = ambulo__rigid_step(l->type == AMBULO_PRISMATIC, l->axis, value);
  ambulo__tree_note(tree, l->node, "%s follows %s, %s: it is held at %s", l->was ? l->was : l->name,
                    l->follows, why, ambulo__number_text(value).text);
  l->origin = ambulo__rigid_times(&l->origin, &step);
  l->type = l->coordinate.type = AMBULO_FIXED;
  l->follows = NULL;
}

/* the link whose coordinate had that name before it became a function; -1 */
static int find_follower(const ambulo__tree *tree, const char *name) {
  for (int i = 0; i < tree->link_count; i++) {
    const ambulo__tree_link *l = &tree->links[i];
    if (l->was && strcmp(l->was, name) == 0) return i;
  }
  return -1;
}

static void resolve(ambulo__tree *tree, ambulo__tree_link *l) {
  for (int depth = 0; l->follows; depth++) {
    if (ambulo__tree_find_coordinate(tree, l->follows) >= 0) return;
    int other = find_follower(tree, l->follows);
    const ambulo__tree_link *next = other >= 0 ? &tree->links[other] : NULL;
    ambulo__tree_function whole;
    if (!next || !next->follows) {
      hold(tree, l, "which does not move");
    } else if (depth > tree->link_count) {
      hold(tree, l, "which follows it in turn");
    } else if (!ambulo__function_of_function(tree, &l->function, &next->function, &whole)) {
      hold(tree, l, "itself a curve of another");
    } else {
      l->function = whole;
      l->follows = next->follows;
    }
  }
}

/* What drives a joint that follows becomes its leader's; 1: it is on a curve, and is left out. */
static int pass_drive(ambulo__tree *tree, ambulo__tree_link *l) {
  ambulo_coordinate *own = &l->coordinate;
  int leader = l->follows ? ambulo__tree_find_coordinate(tree, l->follows) : -1;
  if (own->armature == 0.0 && own->damping == 0.0 && own->friction == 0.0) return 0;
  int left_out = leader >= 0 && !ambulo__function_is_line(&l->function);
  if (leader >= 0 && ambulo__function_is_line(&l->function)) {
    ambulo_coordinate *c = &tree->links[leader].coordinate;
    double slope = l->function.polynomial[1];
    c->armature += slope * slope * own->armature;
    c->damping += slope * slope * own->damping;
    c->friction += fabs(slope) * own->friction;
  }
  own->armature = own->damping = own->friction = 0.0;
  return left_out;
}

void ambulo__tree_resolve(ambulo__tree *tree) {
  int left_out = 0;
  for (int i = 0; i < tree->link_count && !tree->arena->failed; i++) resolve(tree, &tree->links[i]);
  for (int i = 0; i < tree->link_count && !tree->arena->failed; i++) {
    int follows = tree->links[i].follows || tree->links[i].type == AMBULO_FIXED;
    if (follows) left_out += pass_drive(tree, &tree->links[i]);
  }
  if (left_out)
    ambulo__tree_note(
        tree, NULL,
        "armature, damping and friction of %d joints that follow others on curves are "
        "left out",
        left_out);
}
