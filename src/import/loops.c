/* import/loops.c - chains of links that are closed by points: four-bars, rods (body_tree.h).
 *
 * A closure holds a point a of one link on a point b of another: c = r_a - r_b = 0, three rows. Its
 * loop are the coordinates between the two links and their common ancestor. Loops that share a
 * coordinate are one group. Where one motor drives a group, everything in it is a function of that
 * motor's coordinate m, and the joints become coupled ones (docs/model-format.md): the
 * forces in rods then do no work in any motion, and tau of m is what the motor has to supply:
 * tau_m + sum over the group dq_j/dm tau_j, which is J^T lambda eliminated by virtual work.
 *
 * The functions are found along the range of m, from the start pose both ways, as points q(m_i)
 * with c(q, m_i) = 0 by Newton's method of least norm,
 *
 *     q += J^T (J J^T + epsilon 1)^-1 (-c),   J = dc/dq without the column of m,
 *     dr/dq_j = a_j x (r - o_j) of a hinge, a_j of a slider
 *
 * whose rows may depend on each other (a planar four-bar closes in two directions of three), and
 * whose columns may leave a motion free (a rod turns about its own line: it stays as it is). A
 * spring in a group is held where it rests: it is stiff beside what a motor does.
 */
#include "base/arithmetic.h"
#include "base/lapack.h"
#include "import/body_tree.h"

#include <math.h>
#include <string.h>

enum { MOST_JOINTS = 24, MOST_ROWS = 12, SAMPLES = 49, BEYOND = 3, LEAST = 8, STEPS = 60 };

static const double closed = 1e-11;  /* m */
static const double damping = 1e-13; /* of the largest diagonal */
static const double widest = 6.5;    /* rad or m: of a range that is one */

typedef struct loop {
  ambulo__tree *tree;
  const ambulo__closure *closure[MOST_ROWS / 3];
  int closures;
  int link[MOST_JOINTS]; /* that have the coordinates of the group, but for the motor's */
  int count, motor;
  double *q; /* [links of the tree] */
} loop;

/* ------------------------------------------------------------------ kinematics */

/* c of all closures, and J [rows][count] where it is asked for; the largest |c| */
static double residual(const loop *l, double c[MOST_ROWS], double j[MOST_ROWS][MOST_JOINTS]) {
  double worst = 0.0;
  if (j) memset(j, 0, MOST_ROWS * sizeof *j);
  memset(c, 0, MOST_ROWS * sizeof *c);
  for (int k = 0; k < l->closures; k++) {
    for (int side = 0; side < 2; side++) {
      int link = l->closure[k]->link[side];
      double r[3], sign = side ? -1.0 : 1.0;
      ambulo__rigid at = ambulo__tree_place_at(l->tree, link, l->q);
      ambulo__rigid_point(&at, l->closure[k]->point[side], r);
      for (int i = 0; i < 3; i++) c[3 * k + i] += sign * r[i];
      for (int n = 0; j && n < l->count; n++) {
        const ambulo__tree_link *t = &l->tree->links[l->link[n]];
        if (!ambulo__tree_hangs_on(l->tree, link, l->link[n])) continue;
        ambulo__rigid joint = ambulo__tree_place_at(l->tree, l->link[n], l->q);
        double axis[3], arm[3], moved[3];
        ambulo__rigid_vector(&joint, t->axis, axis);
        for (int i = 0; i < 3; i++) arm[i] = r[i] - joint.p[i];
        ambulo__cross(axis, arm, moved);
        const double *by = t->type == AMBULO_PRISMATIC ? axis : moved;
        for (int i = 0; i < 3; i++) j[3 * k + i][n] += sign * by[i];
      }
    }
    for (int i = 0; i < 3; i++) worst = fmax(worst, fabs(c[3 * k + i]));
  }
  return worst;
}

/* 1: the group closes at the motor's value in l->q, from the values there */
static int close_at(loop *l) {
  double c[MOST_ROWS], j[MOST_ROWS][MOST_JOINTS], a[MOST_ROWS][MOST_ROWS];
  int rows = 3 * l->closures, one = 1, most_rows = MOST_ROWS, pivots[MOST_ROWS], fault = 0;
  for (int step = 0; step < STEPS; step++) {
    if (residual(l, c, j) <= closed) return 1;
    double most = 0.0;
    for (int u = 0; u < rows; u++)
      for (int v = 0; v < rows; v++) {
        a[u][v] = 0.0;
        for (int n = 0; n < l->count; n++) a[u][v] += j[u][n] * j[v][n];
        if (u == v) most = fmax(most, a[u][v]);
      }
    for (int u = 0; u < rows; u++) a[u][u] += damping * most;
    dgesv_(&rows, &one, a[0], &most_rows, pivots, c, &most_rows, &fault);
    if (fault) return 0;
    for (int n = 0; n < l->count; n++) {
      double change = 0.0;
      for (int u = 0; u < rows; u++) change -= j[u][n] * c[u];
      l->q[l->link[n]] += fmax(-0.5, fmin(0.5, change));
    }
  }
  return residual(l, c, NULL) <= 1e3 * closed;
}

/* ---------------------------------------------------------------------- groups */

/* 1: a joint of the closure's loop */
static int is_in(const ambulo__tree *tree, const ambulo__closure *c, int link) {
  return tree->links[link].type != AMBULO_FIXED &&
         ambulo__tree_hangs_on(tree, c->link[0], link) !=
             ambulo__tree_hangs_on(tree, c->link[1], link);
}

static int share(const ambulo__tree *tree, const ambulo__closure *a, const ambulo__closure *b) {
  for (int i = 0; i < tree->link_count; i++)
    if (is_in(tree, a, i) && is_in(tree, b, i)) return 1;
  return 0;
}

static int is_inside(const loop *l, int link) {
  int inside = 0;
  for (int k = 0; k < l->closures; k++) inside |= is_in(l->tree, l->closure[k], link);
  return inside;
}

/* the motor and the other joints of the group; "", or why it cannot be solved */
static const char *collect(loop *l) {
  ambulo__tree *tree = l->tree;
  for (int i = 0; i < tree->link_count; i++) {
    if (!is_inside(l, i)) continue;
    if (tree->links[i].follows) return "a joint in it follows another";
    if (tree->links[i].driven) {
      if (l->motor >= 0) return "more than one motor drives it";
      l->motor = i;
      continue;
    }
    if (tree->links[i].stiffness > 0.0) continue;
    if (l->count == MOST_JOINTS) return "it has too many joints";
    l->link[l->count++] = i;
  }
  if (l->motor < 0) return "no motor drives it";
  return l->count == 0 ? "nothing in it moves" : "";
}

/* Points of the functions on a grid over the motor's range and a little beyond, [total][count]. */
typedef struct grid {
  double origin, step;
  int total, start; /* points; the one next to the start pose */
  int first, last;  /* those where the group closes, around the start */
  double *values;
} grid;

/* from the start pose on in steps of `by` points, for as long as the group closes */
static int trace(loop *l, const grid *g, const double *start, int by) {
  int at = g->start;
  memcpy(l->q, start, (size_t)l->tree->link_count * sizeof *l->q);
  for (; at >= 0 && at < g->total; at += by) {
    l->q[l->motor] = g->origin + at * g->step;
    if (!close_at(l)) break;
    for (int n = 0; n < l->count; n++) g->values[at * l->count + n] = l->q[l->link[n]];
  }
  return at - by;
}

static void write_functions(loop *l, const grid *g) {
  ambulo__tree *tree = l->tree;
  const char *motor = tree->links[l->motor].coordinate.name;
  int count = g->last - g->first + 1;
  for (int n = 0; n < l->count; n++) {
    double(*points)[2] = ambulo__arena_take(tree->arena, (size_t)count, sizeof *points);
    if (!points) return;
    for (int i = 0; i < count; i++) {
      points[i][0] = g->origin + (g->first + i) * g->step;
      points[i][1] = g->values[(g->first + i) * l->count + n];
    }
    ambulo__tree_function f = {.count = count, .points = points[0]};
    ambulo__tree_couple(tree, l->link[n], motor, &f);
  }
}

/* The motor goes as far as the group closes. */
static void narrow(loop *l, const grid *g) {
  ambulo__tree_link *motor = &l->tree->links[l->motor];
  double *range = motor->coordinate.range;
  double from = g->origin + g->first * g->step, to = g->origin + g->last * g->step;
  if (from <= range[0] && to >= range[1]) return;
  range[0] = fmax(range[0], from);
  range[1] = fmin(range[1], to);
  ambulo__tree_note(l->tree, motor->node,
                    "the loop that '%s' drives closes from %.3f to %.3f: that is its range",
                    motor->coordinate.name, range[0], range[1]);
}

static void hold_springs(loop *l) {
  ambulo__tree *tree = l->tree;
  for (int i = 0; i < tree->link_count; i++) {
    ambulo__tree_link *link = &tree->links[i];
    if (!is_inside(l, i) || i == l->motor || !(link->stiffness > 0.0)) continue;
    ambulo__tree_note(tree, link->node, "the spring '%s' in a loop is held where it stands",
                      link->coordinate.name);
    ambulo__rigid step = ambulo__rigid_step(link->type == AMBULO_PRISMATIC, link->axis,
                                            link->coordinate.default_value);
    link->origin = ambulo__rigid_times(&link->origin, &step);
    link->was = link->coordinate.name;
    link->coordinate = ambulo_coordinate_default();
    link->coordinate.name = NULL;
    link->type = link->coordinate.type = AMBULO_FIXED;
  }
}

/* The joints of the group become functions of the motor's coordinate; "", or why not. */
static const char *couple(loop *l) {
  ambulo__tree *tree = l->tree;
  const double *range = tree->links[l->motor].coordinate.range;
  grid g = {.total = SAMPLES + 2 * BEYOND};
  size_t links = (size_t)tree->link_count;
  if (!(range[1] - range[0] < widest)) return "its motor has no range";
  if (!(range[1] > range[0])) return "its motor does not move";
  double *start = ambulo__arena_take(tree->arena, links, sizeof *start);
  l->q = ambulo__arena_take(tree->arena, links, sizeof *l->q);
  g.values = ambulo__arena_take(tree->arena, (size_t)(g.total * l->count), sizeof *g.values);
  if (!start || !l->q || !g.values) return "";
  for (int i = 0; i < tree->link_count; i++) l->q[i] = ambulo__tree_stands(tree, i, 1);
  if (!close_at(l)) return "it does not close in the start pose";
  memcpy(start, l->q, links * sizeof *start);
  g.step = (range[1] - range[0]) / (SAMPLES - 1);
  g.origin = range[0] - BEYOND * g.step;
  double along = floor((start[l->motor] - g.origin) / g.step + 0.5);
  g.start = (int)fmax(0.0, fmin(g.total - 1.0, along));
  g.last = trace(l, &g, start, 1);
  g.first = trace(l, &g, start, -1);
  if (g.last - g.first < LEAST) return "it closes in the start pose alone";
  hold_springs(l);
  write_functions(l, &g);
  narrow(l, &g);
  return "";
}

/* the closure and all that share a joint with one of the group, and so on; "", or why not */
static const char *gather(loop *l, const ambulo__closure *closures, int count, int first,
                          int *done) {
  l->closure[l->closures++] = &closures[first];
  done[first] = 1;
  for (int k = 0; k < l->closures; k++) {
    for (int i = 0; i < count; i++) {
      if (done[i] || !share(l->tree, l->closure[k], &closures[i])) continue;
      done[i] = 1;
      if (l->closures == MOST_ROWS / 3) return "too many points close it";
      l->closure[l->closures++] = &closures[i];
    }
  }
  return "";
}

void ambulo__close_loops(ambulo__tree *tree, const ambulo__closure *closures, int count) {
  int *done = ambulo__arena_take(tree->arena, (size_t)count + 1, sizeof *done);
  for (int k = 0; done && k < count && !tree->arena->failed; k++) {
    if (done[k]) continue;
    loop l = {.tree = tree, .motor = -1};
    const char *why = gather(&l, closures, count, k, done);
    if (!why[0]) why = collect(&l);
    if (!why[0]) why = couple(&l);
    if (why[0])
      ambulo__tree_note(tree, closures[k].node, "the loop between %s and %s stays open: %s",
                        tree->links[closures[k].link[0]].name,
                        tree->links[closures[k].link[1]].name, why);
  }
}
