/* import/symmetrize.c - left and right of a nearly symmetric body made exact images
 * (body_tree.h).
 *
 * With H the reflection of left, everything is taken in the world at q = 0. Of a joint i and its
 * partner j (itself in the middle) axis, place, mass, centre of mass, inertia and limits become the
 * mean of i's own and of the image of j's:
 *
 *   a_i <- unit(a_i + s H' a_j),  H' = H for sliders, -H for hinges, s = +-1 the sign that fits
 *   p_i <- p_i - d/2,  d the part of p_i - H p_j across a_i: where a joint is along its axis is
 *          nobody's concern
 *   m_i <- (m_i + m_j)/2,  c_i <- (c_i + H c_j)/2,  I_i <- (I_i + H I_j H)/2
 *
 * for both at once, which makes them images: the mean of physical inertias is one. The mass of
 * links that are fixed to another goes to that one. Frames keep their directions; feet follow.
 */
#include "import/symmetrize.h"

#include "base/arithmetic.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static double tidy(double x) {
  return fabs(x) < 1e3 ? round(x * 1e12) / 1e12 : x;
}

static const double same = 1e-9; /* of what there is: nothing to be done */

/* -------------------------------------------------------------------- taking stock */

static void look_at(ambulo__sides *s, int i) {
  const ambulo__tree_link *link = &s->tree->links[i];
  const ambulo__rigid *place = &s->place[i];
  ambulo__part own;
  ambulo__rigid_vector(place, link->axis, s->axis[i]);
  ambulo__tree_whole(s->tree, i, &own);
  s->body[i].mass = own.mass;
  ambulo__rigid_point(place, own.com, s->body[i].com);
  ambulo__inertia_turn((const double(*)[3])place->r, own.inertia, s->body[i].inertia);
  s->mass += own.mass;
}

/* The whole body into the mirror plane, where its coordinates can take it there anyway. */
static void into_the_plane(ambulo__sides *s) {
  ambulo__tree *t = s->tree;
  if (t->trunk < 0) return;
  ambulo__rigid trunk = ambulo__tree_place(t, t->trunk);
  double off = ambulo__dot(trunk.p, s->axes[1]), along = 0.0, axis[3];
  int first = t->trunk;
  for (int i = t->trunk; i >= 0; i = t->links[i].parent) {
    ambulo__rigid place = ambulo__tree_place(t, i);
    ambulo__rigid_vector(&place, t->links[i].axis, axis);
    if (t->links[i].type == AMBULO_PRISMATIC)
      along = fmax(along, fabs(ambulo__dot(axis, s->axes[1])));
    first = i;
  }
  for (int k = 0; k < 3 && along > 0.999; k++)
    t->links[first].origin.p[k] = tidy(t->links[first].origin.p[k] - off * s->axes[1][k]);
}

/* the longest side of a box around the joints */
static double size_of(const ambulo__sides *s) {
  double most = 0.1;
  for (int k = 0; k < 3; k++) {
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < s->count; i++) {
      if (!ambulo__tree_hangs_on(s->tree, i, s->tree->trunk)) continue;
      double at = ambulo__dot(s->place[i].p, s->axes[k]);
      low = fmin(low, at);
      high = fmax(high, at);
    }
    most = fmax(most, high - low);
  }
  return most;
}

static int begin(ambulo__sides *s, ambulo__tree *tree) {
  ambulo__arena *arena = tree->arena;
  size_t n = (size_t)tree->link_count + 1;
  *s = (ambulo__sides){.tree = tree, .count = tree->link_count};
  ambulo__tree_axes(tree, s->axes);
  s->partner = ambulo__arena_take(arena, n, sizeof *s->partner);
  s->sign = ambulo__arena_take(arena, n, sizeof *s->sign);
  s->place = ambulo__arena_take(arena, n, sizeof *s->place);
  s->old = ambulo__arena_take(arena, n, sizeof *s->old);
  s->axis = ambulo__arena_take(arena, n, sizeof *s->axis);
  s->body = ambulo__arena_take(arena, n, sizeof *s->body);
  if (arena->failed) return 0;
  into_the_plane(s);
  for (int i = 0; i < s->count; i++) {
    s->place[i] = s->old[i] = ambulo__tree_place(tree, i);
    s->partner[i] = -1;
  }
  s->size = size_of(s);
  s->near = 0.02 * s->size;
  int root = tree->trunk;
  while (root >= 0 && tree->links[root].parent >= 0 &&
         tree->links[ambulo__tree_leader(tree, tree->links[root].parent)].type != AMBULO_FIXED)
    root = ambulo__tree_leader(tree, tree->links[root].parent);
  for (int i = 0; i < s->count; i++) {
    if (ambulo__tree_leader(tree, i) != i || !ambulo__tree_hangs_on(tree, i, root)) continue;
    s->partner[i] = ambulo__side_moves(s, i) ? ambulo__partner_coordinate(tree, i) : i;
    look_at(s, i);
  }
  for (int i = 0; i < s->count; i++)
    if (s->partner[i] >= 0 && s->partner[s->partner[i]] != i) s->partner[i] = i;
  return 1;
}

/* -------------------------------------------------------------------------- means */

static void mean_joint(ambulo__sides *s, int i, int j) {
  double image[3], sign, d[3];
  if (!ambulo__side_moves(s, i)) return;
  ambulo__image_of_axis(s, i, j, image, &sign);
  for (int k = 0; k < 3; k++) image[k] += s->axis[i][k];
  (void)ambulo__normalize(image);
  ambulo__sides_away(s, i, j, image, d);
  double other[3];
  ambulo__reflect(s, d, other);
  memcpy(s->axis[i], image, sizeof image);
  for (int k = 0; k < 3; k++) {
    s->place[i].p[k] -= 0.5 * d[k];
    if (i != j) s->place[j].p[k] += 0.5 * other[k];
  }
  if (i == j) return;
  ambulo__reflect(s, image, s->axis[j]);
  double kind = sign * (s->tree->links[i].type == AMBULO_REVOLUTE ? -1.0 : 1.0);
  for (int k = 0; k < 3; k++) s->axis[j][k] *= kind;
}

static void mean_body(ambulo__sides *s, int i, int j) {
  ambulo__part *a = &s->body[i], *b = &s->body[j];
  double com[3], inertia[6];
  ambulo__reflect(s, b->com, com);
  ambulo__reflect_inertia(s, b->inertia, inertia);
  a->mass = b->mass = 0.5 * (a->mass + b->mass);
  for (int k = 0; k < 3; k++) a->com[k] = 0.5 * (a->com[k] + com[k]);
  for (int k = 0; k < 6; k++) a->inertia[k] = 0.5 * (a->inertia[k] + inertia[k]);
  if (i == j) return;
  ambulo__reflect(s, a->com, b->com);
  ambulo__reflect_inertia(s, a->inertia, b->inertia);
}

/* what a link and all that is fixed to it weigh, on the link */
static void put_body(ambulo__sides *s, int i) {
  ambulo__tree *t = s->tree;
  ambulo__rigid back = ambulo__rigid_inverse(&s->place[i]);
  ambulo__part own = {.mass = s->body[i].mass};
  ambulo__rigid_point(&back, s->body[i].com, own.com);
  ambulo__inertia_turn((const double(*)[3])back.r, s->body[i].inertia, own.inertia);
  for (int k = 0; k < 3; k++) own.com[k] = tidy(own.com[k]);
  for (int k = i; k < t->link_count; k++)
    if (ambulo__tree_leader(t, k) == i) t->links[k].body = (ambulo__part){0};
  t->links[i].body = own;
}

/* origins of links whose own place or parent's has moved, and axes */
static void put_joint(ambulo__sides *s, int i) {
  ambulo__tree_link *link = &s->tree->links[i];
  double p[3], axis[3];
  memcpy(p, s->place[i].p, sizeof p);
  if (link->parent >= 0) {
    /* fixed links between the parent and its leader go where that goes */
    int leader = ambulo__tree_leader(s->tree, link->parent);
    double from[3];
    for (int k = 0; k < 3; k++)
      from[k] = p[k] - s->old[link->parent].p[k] - s->place[leader].p[k] + s->old[leader].p[k];
    ambulo__rigid_back(&s->old[link->parent], from, p);
  }
  ambulo__rigid_back(&s->place[i], s->axis[i], axis);
  for (int k = 0; k < 3; k++) {
    if (fabs(p[k] - link->origin.p[k]) > 1e-13) link->origin.p[k] = tidy(p[k]);
    if (ambulo__side_moves(s, i) && fabs(axis[k] - link->axis[k]) > 1e-13) link->axis[k] = axis[k];
  }
}

/* ------------------------------------------------------------ limits, and where it starts */

/* one of two; where one side has none the other's */
static double mean_limit(double a, double b) {
  if (!isfinite(a) || !isfinite(b)) return isfinite(a) ? a : b;
  return a == b ? a : 0.5 * (a + b);
}

static void mean_limits(ambulo__sides *s, double a[2], double b[2], double sign) {
  double image[2] = {sign > 0.0 ? b[0] : -b[1], sign > 0.0 ? b[1] : -b[0]};
  if (!isfinite(a[0]) && !isfinite(a[1]) && !isfinite(b[0]) && !isfinite(b[1])) return;
  for (int k = 0; k < 2; k++) {
    s->limits += fabs(a[k] - image[k]) > 1e-9;
    image[k] = mean_limit(a[k], image[k]);
  }
  for (int k = 0; k < 2; k++) {
    a[k] = image[k];
    b[k] = sign > 0.0 ? image[k] : -image[1 - k];
  }
}

static void mean_number(ambulo__sides *s, double *a, double *b) {
  double mean = 0.5 * (*a + *b);
  s->limits += fabs(*a - mean) > 1e-9 * mean;
  *a = *b = mean;
}

static void mean_coordinate(ambulo__sides *s, int i, int j) {
  ambulo_coordinate *a = &s->tree->links[i].coordinate, *b = &s->tree->links[j].coordinate;
  double sign = s->sign[i];
  mean_limits(s, a->range, b->range, sign);
  mean_limits(s, a->speed, b->speed, sign);
  mean_limits(s, a->torque, b->torque, sign);
  mean_number(s, &a->armature, &b->armature);
  mean_number(s, &a->damping, &b->damping);
  mean_number(s, &a->friction, &b->friction);
  double start = 0.5 * (a->default_value + sign * b->default_value);
  if (i == j && sign < 0.0) start = 0.0;
  s->limits += fabs(a->default_value - start) > 1e-9;
  a->default_value = start;
  b->default_value = i == j ? start : sign * start;
}

/* --------------------------------------------------------------------------- feet */

static ambulo__rigid new_place(const ambulo__sides *s, int link) {
  ambulo__rigid place = s->old[link];
  int leader = ambulo__tree_leader(s->tree, link);
  for (int k = 0; k < 3; k++) place.p[k] += s->place[leader].p[k] - s->old[leader].p[k];
  return place;
}

static void mean_points(ambulo__sides *s, int a, int b) {
  if (a < 0 || b < 0) return;
  ambulo__tree_point *p = &s->tree->points[a], *q = &s->tree->points[b];
  ambulo__rigid first = new_place(s, p->link), second = new_place(s, q->link);
  double at[3], other[3], image[3];
  ambulo__rigid_point(&first, p->position, at);
  ambulo__rigid_point(&second, q->position, other);
  ambulo__reflect(s, other, image);
  double apart = 0.0;
  for (int k = 0; k < 3; k++) apart = fmax(apart, fabs(at[k] - image[k]));
  if (apart > s->near) {
    ambulo__xml_error(s->tree->xml, s->tree->links[p->link].node, AMBULO_E_MODEL, NULL,
                      "--symmetrize: points '%.60s' and '%.60s' differ too much (got %s m); "
                      "expected at most %s",
                      p->name, q->name, ambulo__three_digits(apart).text,
                      ambulo__three_digits(s->near).text);
    return;
  }
  for (int k = 0; k < 3; k++) at[k] = 0.5 * (at[k] + image[k]);
  ambulo__reflect(s, at, other);
  ambulo__rigid back = ambulo__rigid_inverse(&first);
  ambulo__rigid_point(&back, at, p->position);
  back = ambulo__rigid_inverse(&second);
  if (a != b) ambulo__rigid_point(&back, other, q->position);
}

static void mean_feet(ambulo__sides *s) {
  ambulo__tree *t = s->tree;
  for (int i = 0; i < t->foot_count; i++) {
    int j = ambulo__tree_mirror_foot(t, i);
    if (j < 0) j = i;
    if (j < i) continue;
    const ambulo__tree_foot *a = &t->feet[i], *b = &t->feet[j];
    int swap = i == j && a->heel[1] >= 0;
    for (int k = 0; k < 2 - swap; k++) {
      mean_points(s, a->heel[k], b->heel[swap ? 1 - k : k]);
      mean_points(s, a->toe[k], b->toe[swap ? 1 - k : k]);
    }
    if (a->heel[1] < 0) continue; /* the centre is the corner */
    mean_points(s, a->heel_center, b->heel_center);
    mean_points(s, a->toe_center, b->toe_center);
  }
}

/* -------------------------------------------------------------------------- whole */

static void say(const ambulo__sides *s) {
  static const double scales[AMBULO__SIDE_KINDS] = {1e3, 1e3, 1e3, 1.0, 57.29577951308232};
  static const char *const units[AMBULO__SIDE_KINDS] = {
      "mm in the place of a joint", "g in a mass", "mm in a centre of mass", "kg m^2 in an inertia",
      "degrees in an axis"};
  char text[600] = "";
  size_t used = 0;
  for (int k = 0; k < AMBULO__SIDE_KINDS; k++) {
    const ambulo__difference *d = &s->worst[k];
    if (!(d->value > same) || used + 200 > sizeof text) continue;
    used += (size_t)snprintf(
        text + used, sizeof text - used, "%s%s %s (%.40s%s%.40s)", used ? ", " : "",
        ambulo__three_digits(scales[k] * d->value).text, units[k], s->tree->links[d->link].name,
        d->link == d->other ? "" : ", ", d->link == d->other ? "" : s->tree->links[d->other].name);
  }
  if (used || s->limits)
    ambulo__tree_note(
        s->tree, NULL, "left and right are exact images now; they differed by up to %s%s%s%s", text,
        used && s->limits ? ", and in " : "", s->limits ? ambulo__number_text(s->limits).text : "",
        s->limits ? " limits or defaults" : "");
}

void ambulo__symmetrize(ambulo__tree *tree) {
  ambulo__sides s;
  if (!begin(&s, tree)) return;
  ambulo__sides_compare(&s);
  if (tree->xml->status) return;
  for (int i = 0; i < s.count; i++) {
    int j = s.partner[i];
    double d[AMBULO__SIDE_KINDS];
    if (j < i) continue;
    ambulo__sides_differ(&s, i, j, d);
    int apart = d[AMBULO__SIDE_PLACE] > same * s.size || d[AMBULO__SIDE_AXIS] > same;
    int uneven = d[AMBULO__SIDE_MASS] > same * s.body[i].mass ||
                 d[AMBULO__SIDE_CENTER] > same * s.size ||
                 d[AMBULO__SIDE_INERTIA] > same * ambulo__largest_entry(s.body[i].inertia);
    if (apart) mean_joint(&s, i, j);
    if (uneven) mean_body(&s, i, j);
    for (int k = 0; k < 2 && (apart || uneven); k++) put_body(&s, k ? j : i);
    if (ambulo__side_moves(&s, i)) mean_coordinate(&s, i, j);
  }
  mean_feet(&s);
  for (int i = 0; i < s.count; i++)
    if (s.partner[i] >= 0) put_joint(&s, i);
  say(&s);
}
