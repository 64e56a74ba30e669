/* problem/mirror_terms.c - terms on the two sides of the body (term.h).
 *
 * In the mirror image tau_m = s tau_i, and so for q and its rates. The residual of a term on
 * partner m is that on i, up to its sign, when
 *
 *     scale_m = scale_i,   offset_m = s offset_i,   passive_m(s q) = s passive_i(q),
 *     strength_m(s q) of direction s D = strength_i(q) of direction D,   tendon_m = tendon_i
 *
 * Curves are compared as functions, at five angles: their constants may be ordered otherwise. Left
 * and right may stand in different terms; the share of term t on i needs as many like it on m as
 * on i.
 *
 * An upright term asks where one point is off another, r_to - r_from over its length at q = 0,
 * squared: it has to be the reflection of its own, or of another upright term's of the same weight,
 * from either end. With P the reflection and m the partner of what a point moves with, lines a and
 * b are, at every q,
 *
 *     both ends of a on segment s, of b on m(s):     P (r_to - r_from)_a = +- L_a / L_b (r_to -
 * r_from)_b ends on segments that move against each other: P r_from,a = r_from,b and P r_to,a =
 * r_to,b, on m(s_from) and m(s_to); or to and from changed
 *
 * at q = 0: a rigid line is known by its direction, one over joints by the place of either end.
 */

#include "contact/devices.h"
#include "contact/row_families.h"
#include "base/numtext.h"
#include "model/mirror_image.h"
#include "model/neutral_pose.h"
#include "problem/term.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { ANGLES = 5 };
static const double angles[ANGLES] = {-1.0, -0.5, 0.0, 0.5, 1.0}; /* rad */

#define REFUSE(list, ...)                                                                          \
  ambulo__error(list, AMBULO_E_PROBLEM, ambulo__nowhere, AMBULO__BOTH_SIDES, __VA_ARGS__)

/* What a term asks of one coordinate, seen with a sign: -1 in the mirror. */
typedef struct share {
  const ambulo_term *term;
  int coordinate;
  double sign;
} share;

/* The first number in which two shares differ. */
typedef struct difference {
  const char *what; /* NULL: they agree */
  const char *unit; /* with a blank before it, or "" */
  double own, other, angle;
  int at_angle; /* it is that at +-angle */
  int odd;      /* expected to be opposite */
} difference;

static int same(double a, double b) {
  return a == b || fabs(a - b) <= AMBULO__MIRROR_TOLERANCE * fmax(fabs(a), fabs(b));
}

static double scale_of(const share *s) {
  return ambulo__term_scale(s->term, s->coordinate);
}

static double offset_of(const share *s) {
  int has_offset = ambulo__term_has(s->term, AMBULO__TERM_OFFSET | AMBULO__TERM_REST);
  return has_offset && s->term->offset ? s->term->offset[s->coordinate] : 0.0;
}

static double tendon_of(const share *s) {
  return s->term->tendon ? s->term->tendon[s->coordinate] : 0.0;
}

static double passive_at(const share *s, double q) {
  double slope;
  if (!ambulo__term_has(s->term, AMBULO__TERM_CURVES) || !s->term->passive) return 0.0;
  return ambulo__passive_torque(&s->term->passive[4 * s->coordinate], q, &slope);
}

/* direction 0: for positive torque */
static double strength_at(const share *s, int direction, double q) {
  double slope;
  if (!ambulo__term_has(s->term, AMBULO__TERM_CURVES) || !s->term->strength) return 1.0;
  const double *curve = &s->term->strength[6 * s->coordinate + 3 * direction];
  return curve[0] > 0.0 ? ambulo__strength(curve, q, &slope) : 1.0;
}

static difference curves_of(const share *a, const share *b) {
  static const char *const strengths[] = {"strength for positive torque",
                                          "strength for negative torque"};
  double sign = a->sign * b->sign;
  for (int k = 0; k < ANGLES; k++) {
    double q = angles[k], own = passive_at(a, q), other = passive_at(b, sign * q);
    if (!same(own, sign * other))
      return (difference){"passive torque", " N m", own, other, q, 1, sign < 0.0};
    for (int direction = 0; direction < 2; direction++) {
      own = strength_at(a, direction, q);
      other = strength_at(b, sign < 0.0 ? 1 - direction : direction, sign * q);
      if (!same(own, other)) return (difference){strengths[direction], " N m", own, other, q, 1, 0};
    }
  }
  return (difference){.what = NULL};
}

static difference compare(const share *a, const share *b) {
  double sign = a->sign * b->sign;
  double own = scale_of(a), other = scale_of(b);
  int tracked = ambulo__term_has(a->term, AMBULO__TERM_REFERENCE) && a->term == b->term;
  if ((own == 0.0 && other == 0.0) || (tracked && (own == 0.0 || other == 0.0)))
    return (difference){.what = NULL};
  if (!same(own, other)) return (difference){"scale", "", own, other, 0.0, 0, 0};
  own = tendon_of(a);
  other = tendon_of(b);
  if (!same(own, other)) return (difference){"tendon", " N m/rad", own, other, 0.0, 0, 0};
  own = offset_of(a);
  other = offset_of(b);
  if (!same(own, sign * other)) return (difference){"offset", "", own, other, 0.0, 0, sign < 0.0};
  return curves_of(a, b);
}

/* terms whose share of b's coordinate is like a */
static int count_like(const ambulo_problem_definition *d, const share *a, share b) {
  int count = 0;
  for (int u = 0; u < d->term_count; u++) {
    b.term = &d->terms[u];
    if (b.term->kind != a->term->kind || !same(b.term->weight, a->term->weight)) continue;
    if (ambulo__term_has(a->term, AMBULO__TERM_SMOOTHING) &&
        !same(b.term->smoothing, a->term->smoothing))
      continue;
    if (ambulo__term_has(a->term, AMBULO__TERM_NEGATIVE) &&
        !same(b.term->negative, a->term->negative))
      continue;
    if (ambulo__term_is_rate(b.term) != ambulo__term_is_rate(a->term)) continue;
    if (ambulo__term_has(a->term, AMBULO__TERM_POWER) && !same(b.term->power, a->term->power))
      continue;
    count += compare(a, &b).what == NULL;
  }
  return count;
}

static int is_balanced(const ambulo_problem_definition *d, share a, share b) {
  share a_itself = a, b_itself = b;
  int left = scale_of(&a) == 0.0 || count_like(d, &a, a_itself) == count_like(d, &a, b);
  int right = scale_of(&b) == 0.0 || count_like(d, &b, b_itself) == count_like(d, &b, a);
  return left && right;
}

/* an offset has the unit of what it is taken off */
static const char *unit_of(const difference *e, const ambulo_term *term,
                           const ambulo_coordinate *c) {
  int angle = c->type == AMBULO_REVOLUTE;
  if (strcmp(e->what, "offset") != 0) return e->unit;
  if (ambulo__term_has(term, AMBULO__TERM_REST)) return angle ? " rad" : " m";
  return angle ? " N m" : " N";
}

static ambulo_status refuse(const ambulo_problem_definition *d, int t, int i, const difference *e,
                            ambulo_diagnostics *list) {
  const ambulo_coordinate *c = &d->model->coordinates[i];
  const char *term = ambulo__term_info_of(d->terms[t].kind)->name;
  const char *partner = d->model->coordinates[c->mirror].name;
  const char *unit = unit_of(e, &d->terms[t], c);
  char at[2][40] = {"", ""};
  if (e->at_angle) {
    (void)snprintf(at[0], sizeof at[0], " at %g rad", e->angle);
    (void)snprintf(at[1], sizeof at[1], " at %g rad", c->mirror_sign * e->angle);
  }
  int digits = ambulo__digits_apart(e->own, e->odd ? -e->other : e->other);
  if (c->mirror == i && !e->at_angle)
    return REFUSE(list,
                  "objective[%d] (%s): the %s of '%s' is %.6g%s; expected 0 with mirrored ends, "
                  "since it is its own mirror image",
                  t, term, e->what, c->name, e->own, unit);
  return REFUSE(list,
                "objective[%d] (%s): the %s of '%s'%s is %.*g%s, that of its mirror partner '%s'%s "
                "%.*g%s; expected %s with mirrored ends",
                t, term, e->what, c->name, at[0], digits, e->own, unit, partner, at[1], digits,
                e->other, unit, e->odd ? "the opposite" : "the same");
}

static ambulo_status check_coordinates(const ambulo_problem_definition *d,
                                       const ambulo__segments *s, int t, ambulo_diagnostics *list) {
  (void)s;
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < d->model->coordinate_count; i++) {
    const ambulo_coordinate *c = &d->model->coordinates[i];
    if (c->mirror < i) continue;
    share own = {&d->terms[t], i, 1.0}, other = {&d->terms[t], c->mirror, c->mirror_sign};
    difference e = compare(&own, &other);
    if (e.what && !is_balanced(d, own, other)) status = refuse(d, t, i, &e, list);
  }
  return status;
}

/* ---------------------------------------------------------------- upright lines */

/* of an upright term at q = 0: what its ends move with and where they are, forward, up, left, m */
typedef struct line {
  int segment[2];
  double place[2][3];
} line;

static line line_of(const ambulo__segments *s, const ambulo_term *term) {
  line l;
  for (int end = 0; end < 2; end++) {
    l.segment[end] = s->of_link[s->model->points[term->point[end]].link];
    ambulo__segment_point(s, term->point[end], l.place[end]);
  }
  return l;
}

static int is_rigid(const line *l) {
  return l->segment[0] == l->segment[1];
}

/* unit vector from one end to the other */
static void direction_of(const line *l, double direction[3]) {
  double length = 0.0;
  for (int k = 0; k < 3; k++) {
    direction[k] = l->place[1][k] - l->place[0][k];
    length = hypot(length, direction[k]);
  }
  for (int k = 0; k < 3; k++) direction[k] /= length;
}

static const char *mover_of(const ambulo__segments *s, int segment) {
  return segment == 0 ? "the world" : s->model->coordinates[segment - 1].name;
}

/* 1 if b is the reflection of a in the size of a */
static int is_reflected(const double a[3], double sign, const double b[3]) {
  double off = 0.0, size = 0.0;
  for (int k = 0; k < 3; k++) {
    off = fmax(off, fabs((k == 2 ? -a[k] : a[k]) - sign * b[k]));
    size = hypot(size, a[k]);
  }
  return off <= AMBULO__MIRROR_TOLERANCE * size;
}

/* turned: b's second end is the image of a's first one */
static int are_reflections(const ambulo__segments *s, const line *a, const line *b, int turned) {
  for (int end = 0; end < 2; end++) {
    int segment = a->segment[end], other = b->segment[turned ? 1 - end : end];
    if (other != (segment == 0 ? 0 : s->model->coordinates[segment - 1].mirror + 1)) return 0;
  }
  if (is_rigid(a)) {
    double from[3], to[3];
    direction_of(a, from);
    direction_of(b, to);
    return is_reflected(from, turned ? -1.0 : 1.0, to);
  }
  return is_reflected(a->place[0], 1.0, b->place[turned]) &&
         is_reflected(a->place[1], 1.0, b->place[1 - turned]);
}

static ambulo_status refuse_line(const ambulo_problem_definition *d, const ambulo__segments *s,
                                 int t, ambulo_diagnostics *list) {
  const ambulo_term *term = &d->terms[t];
  const char *name = ambulo__term_info_of(term->kind)->name;
  const char *names[2];
  char expected[120];
  line own = line_of(s, term);
  double direction[3], left[2];
  direction_of(&own, direction);
  if (fabs(direction[2]) < AMBULO__MIRROR_TOLERANCE) direction[2] = 0.0;
  for (int end = 0; end < 2; end++) {
    names[end] = d->model->points[term->point[end]].name;
    left[end] = fabs(own.place[end][2]) < AMBULO__MIRROR_TOLERANCE ? 0.0 : own.place[end][2];
  }
  (void)snprintf(expected, sizeof expected,
                 "expected a line in the mirror plane, or another %s term of weight %g", name,
                 term->weight);
  if (is_rigid(&own))
    return REFUSE(list,
                  "objective[%d] (%s): the line from '%s' to '%s' has no mirror image; it moves "
                  "with '%s' and points %.6g to the left at q = 0; %s on the other side, with "
                  "mirrored ends",
                  t, name, names[0], names[1], mover_of(s, own.segment[0]), direction[2], expected);
  return REFUSE(list,
                "objective[%d] (%s): the line from '%s' to '%s' has no mirror image; '%s' moves "
                "with '%s' and is %.6g m to the left at q = 0, '%s' with '%s' %.6g m; %s on the "
                "other side, with mirrored ends",
                t, name, names[0], names[1], names[0], mover_of(s, own.segment[0]), left[0],
                names[1], mover_of(s, own.segment[1]), left[1], expected);
}

static ambulo_status check_line(const ambulo_problem_definition *d, const ambulo__segments *s,
                                int t, ambulo_diagnostics *list) {
  const ambulo_term *term = &d->terms[t];
  line own = line_of(s, term);
  for (int u = 0; u < d->term_count; u++) {
    const ambulo_term *other = &d->terms[u];
    if (other->kind != term->kind || !same(other->weight, term->weight)) continue;
    line image = line_of(s, other);
    if (are_reflections(s, &own, &image, 0) || are_reflections(s, &own, &image, 1))
      return AMBULO_OK;
  }
  return refuse_line(d, s, t, list);
}

/* ---------------------------------------------------------------------- devices */

static ambulo_status check_devices(const ambulo_problem_definition *d, const ambulo__segments *s,
                                   int t, ambulo_diagnostics *list) {
  (void)s;
  const double *scale = d->terms[t].device_scale;
  for (int i = 0; scale && i < d->device_count; i++) {
    double sign;
    int partner = ambulo__device_partner(d, i, &sign);
    if (partner < 0 || same(scale[i], scale[partner])) continue;
    return REFUSE(list,
                  "objective[%d] (%s): the scale of '%s' is %.6g, that of its mirror "
                  "image '%s' %.6g; expected the same with mirrored ends",
                  t, ambulo__term_info_of(d->terms[t].kind)->name, d->devices[i].name, scale[i],
                  d->devices[partner].name, scale[partner]);
  }
  return AMBULO_OK;
}

static ambulo_status (*const checks[])(const ambulo_problem_definition *d,
                                       const ambulo__segments *s, int t,
                                       ambulo_diagnostics *list) = {
    [AMBULO__MIRROR_COORDINATES] = check_coordinates,
    [AMBULO__MIRROR_LINE] = check_line,
    [AMBULO__MIRROR_DEVICES] = check_devices};

ambulo_status ambulo__mirror_terms_check(const ambulo_problem_definition *d,
                                         const ambulo_allocator *allocator,
                                         ambulo_diagnostics *list) {
  if (d->ends != AMBULO_ENDS_MIRRORED || d->term_count == 0) return AMBULO_OK;
  ambulo__segments segments;
  ambulo_status status = ambulo__segments_create(d->model, allocator, &segments);
  if (status) return status;
  for (int t = 0; t < d->term_count; t++) {
    const ambulo__term_info *info = ambulo__term_info_of(d->terms[t].kind);
    if (d->terms[t].weight == 0.0 || info->mirror == AMBULO__MIRROR_NOTHING) continue;
    ambulo_status one = checks[info->mirror](d, &segments, t, list);
    if (one) status = one;
  }
  ambulo__segments_free(&segments);
  return status;
}
