/* model/mirror_image.c - the body at q = 0 against its reflection (mirror_image.h).
 *
 * With xi_k the motion axes at q = 0 and M the pose there, a link moves as the product
 *
 *     T(q) = exp(xi_1 q_1) ... exp(xi_n q_n) M          over the joints above it
 *
 * (Brockett 1984). Reflected by H, every factor becomes exp(H xi_k H q_k): so the mirrored motion
 * is that of the partners for every q if, and generically only if, at q = 0
 *
 *   chain     the partner of i hangs on the partner of what i hangs on
 *   axis      a_m = s H a_i of a slider, -s H a_i of a hinge, whose sense of turning a mirror
 *             reverses; the axes of hinges are the same lines
 *   drive     armature, damping and dry friction
 *   segment   mass m, centre H c, inertia H I H of what each joint carries, m_m = m_i
 *
 * and then torques are mirrored too, gravity being perpendicular to left. No link frame enters:
 * left and right may be described in frames of either handedness. Feet: the points that touch the
 * ground are reflected, the two corners at one end in either order.
 *
 * Coupled joints belong to what carries them. The body with these where they stand at some values
 * of what they follow, the partner's value with its sign, has to be its own image as well.
 *
 * All in the axes (forward, up, left) of model/neutral_pose.h, H = diag(1, 1, -1).
 */
#include "model/mirror_image.h"

#include "base/numtext.h"
#include "model/neutral_pose.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double tolerance = AMBULO__MIRROR_TOLERANCE;
static const char *const directions[3] = {"forward", "up", "left"};

typedef struct comparison {
  const ambulo_model *model;
  const ambulo__mirror_words *words;
  ambulo_diagnostics *diagnostics;
  ambulo__segments segments;
  char *displaced; /* [coordinates + 1]: what hangs on it stands elsewhere, too */
  double size;     /* m */
  ambulo_status status;
} comparison;

/* Something a partner has one of: "the mass of 'shank_r' is 3 kg". */
typedef struct quantity {
  const char *what, *unit;
  const char *along; /* "" or " along up at q = 0" */
  int odd;           /* changes its sign in the mirror */
} quantity;

/* -------------------------------------------------------------------- messages */

#define DIFFER(c, hint, format, ...)                                                               \
  (c)->status = ambulo__error((c)->diagnostics, (c)->words->status, ambulo__nowhere, hint,         \
                              "%s" format, (c)->words->before, __VA_ARGS__)

/* 0 for what rounding has left of it beside a number of size `beside` */
static double clean(double value, double beside) {
  return fabs(value) < 1e-9 * fabs(beside) ? 0.0 : value;
}

/* a thing that is its own partner comes with the same name twice */
static void report(comparison *c, const quantity *q, const char *name, double value,
                   const char *partner, double other) {
  if (partner == name) {
    DIFFER(c, c->words->hint,
           "%s of '%s'%s is %.6g %s; expected 0, since '%s' is its own mirror image", q->what, name,
           q->along, value, q->unit, name);
    return;
  }
  int digits = ambulo__digits_apart(value, q->odd ? -other : other);
  DIFFER(c, c->words->hint,
         "%s of '%s'%s is %.*g %s, that of its mirror partner '%s' %.*g %s; expected %s", q->what,
         name, q->along, digits, clean(value, other), q->unit, partner, digits, clean(other, value),
         q->unit, q->odd ? "the opposite" : "the same");
}

/* 1 if b is not the mirror image of a; NaN differs from everything */
static int differs(double a, double b, int odd, double most) {
  return !(fabs(odd ? a + b : a - b) <= most);
}

/* the worst component of two places that should be reflections of each other; 1 if they are not */
static int compare_places(comparison *c, const char *what, const char *name, const double a[3],
                          const char *partner, const double b[3]) {
  int worst = -1;
  double most = tolerance * c->size;
  for (int k = 0; k < 3; k++) {
    if (!differs(a[k], b[k], k == 2, most)) continue;
    most = fabs(k == 2 ? a[k] + b[k] : a[k] - b[k]);
    worst = k;
  }
  if (worst < 0) return 0;
  char along[32];
  (void)snprintf(along, sizeof along, " along %s at q = 0", directions[worst]);
  quantity q = {what, "m", along, worst == 2};
  report(c, &q, name, a[worst], partner, b[worst]);
  return 1;
}

/* ---------------------------------------------------------------------- joints */

static const char *name_of(const comparison *c, int segment) {
  return segment == 0 ? "the world" : c->model->coordinates[segment - 1].name;
}

static int image_of(const comparison *c, int segment) {
  return segment == 0 ? 0 : c->model->coordinates[segment - 1].mirror + 1;
}

static int compare_chain(comparison *c, int i, int m) {
  int parent = ambulo__segment_parent(&c->segments, i);
  int other = ambulo__segment_parent(&c->segments, m), expected = image_of(c, parent);
  if (other == expected) return 0;
  if (i == m) {
    DIFFER(c, "'mirror' of a coordinate names the one on the other side",
           "'%s' is its own mirror image, but hangs on '%s', whose mirror partner is '%s'",
           name_of(c, i + 1), name_of(c, parent), name_of(c, expected));
    return 1;
  }
  DIFFER(c, c->words->hint,
         "'%s' hangs on '%s', its mirror partner '%s' on '%s'; expected '%s', the mirror partner "
         "of '%s'",
         name_of(c, i + 1), name_of(c, parent), name_of(c, m + 1), name_of(c, other),
         name_of(c, expected), name_of(c, parent));
  return 1;
}

static int compare_directions(comparison *c, int i, int m, const double a[3], const double b[3]) {
  const ambulo_coordinate *of = &c->model->coordinates[i];
  double sign = of->type == AMBULO_REVOLUTE ? -of->mirror_sign : of->mirror_sign;
  double expected[3] = {sign * a[0], sign * a[1], -sign * a[2]}, off = 0.0, off_opposite = 0.0;
  for (int k = 0; k < 3; k++) {
    off = fmax(off, fabs(b[k] - expected[k]));
    off_opposite = fmax(off_opposite, fabs(b[k] + expected[k]));
  }
  if (off <= tolerance) return 0;
  char sign_hint[100];
  (void)snprintf(sign_hint, sizeof sign_hint, "mirror_sign: %d is the sign that these axes have",
                 of->mirror_sign > 0.0 ? -1 : 1);
  char partner[200] = "";
  if (i != m)
    (void)snprintf(partner, sizeof partner,
                   ", that of its mirror partner '%s' to (%.6g, %.6g, %.6g)", name_of(c, m + 1),
                   clean(b[0], 1.0), clean(b[1], 1.0), clean(b[2], 1.0));
  DIFFER(c, off_opposite <= tolerance ? sign_hint : c->words->hint,
         "the axis of '%s' points to (%.6g, %.6g, %.6g) along forward, up, left at q = 0%s; with "
         "%s and mirror_sign %d expected (%.6g, %.6g, %.6g)",
         of->name, clean(a[0], 1.0), clean(a[1], 1.0), clean(a[2], 1.0), partner,
         i == m ? "itself as mirror image" : "this pair", of->mirror_sign > 0.0 ? 1 : -1,
         clean(expected[0], 1.0), clean(expected[1], 1.0), clean(expected[2], 1.0));
  return 1;
}

/* of the axis, a line, only its distance counts: what is not along it */
static int compare_lines(comparison *c, int i, int m, const double from[3], const double to[3],
                         const double axis[3]) {
  double apart[3] = {from[0] - to[0], from[1] - to[1], -from[2] - to[2]}, along = 0.0, near[3];
  if (c->model->coordinates[i].type != AMBULO_REVOLUTE) return 0;
  for (int k = 0; k < 3; k++) along += apart[k] * axis[k];
  for (int k = 0; k < 3; k++) {
    double across = apart[k] - along * axis[k];
    near[k] = k == 2 ? -to[k] - across : to[k] + across;
  }
  return compare_places(c, "the axis", name_of(c, i + 1), near, name_of(c, m + 1), to);
}

static int compare_axes(comparison *c, int i, int m) {
  ambulo__segment_frame own = ambulo__segment_joint(&c->segments, i);
  ambulo__segment_frame other = ambulo__segment_joint(&c->segments, m);
  double a[3], b[3];
  for (int k = 0; k < 3; k++) {
    a[k] = own.axes[k][2];
    b[k] = other.axes[k][2];
  }
  return compare_directions(c, i, m, a, b) || compare_lines(c, i, m, own.origin, other.origin, b);
}

/* what a drive adds does not change its sign in the mirror */
static void compare_drives(comparison *c, int i, int m) {
  const ambulo_coordinate *a = &c->model->coordinates[i], *b = &c->model->coordinates[m];
  int slides = a->type == AMBULO_PRISMATIC;
  const double own[] = {a->armature, a->damping, a->friction};
  const double other[] = {b->armature, b->damping, b->friction};
  const quantity of[] = {{"armature", slides ? "kg" : "kg m^2", "", 0},
                         {"damping", slides ? "N s/m" : "N m s/rad", "", 0},
                         {"dry friction", slides ? "N" : "N m", "", 0}};
  for (int k = 0; k < 3; k++)
    if (differs(own[k], other[k], 0, tolerance * fmax(own[k], other[k])))
      report(c, &of[k], a->name, own[k], b->name, other[k]);
}

/* -------------------------------------------------------------------- segments */

static const char *body_name(const comparison *c, int segment) {
  int link = c->segments.heaviest[segment];
  return link < 0 ? "the world" : c->model->links[link].name;
}

static void compare_inertias(comparison *c, int segment, int image) {
  static const char *const about[6] = {" about forward",       " about up",
                                       " about left",          " of forward and up",
                                       " of forward and left", " of up and left"};
  const double *a = c->segments.body[segment].inertia, *b = c->segments.body[image].inertia;
  double largest = 0.0;
  for (int e = 0; e < 6; e++) largest = fmax(largest, fmax(fabs(a[e]), fabs(b[e])));
  for (int e = 0; e < 6; e++) {
    int odd = e >= 4;
    if (!differs(a[e], b[e], odd, tolerance * largest)) continue;
    quantity q = {e < 3 ? "the moment of inertia" : "the product of inertia", "kg m^2", about[e],
                  odd};
    report(c, &q, body_name(c, segment), a[e], body_name(c, image), b[e]);
    return;
  }
}

static void compare_bodies(comparison *c, int segment, int image) {
  const ambulo__part *a = &c->segments.body[segment], *b = &c->segments.body[image];
  const char *name = body_name(c, segment), *partner = body_name(c, image);
  if (differs(a->mass, b->mass, 0, tolerance * fmax(a->mass, b->mass))) {
    quantity q = {"the mass", "kg", "", 0};
    report(c, &q, name, a->mass, partner, b->mass);
    return; /* what follows from it is no news */
  }
  if (a->mass == 0.0 || c->displaced[segment]) return;
  if (compare_places(c, "the centre of mass", name, a->com, partner, b->com)) {
    c->displaced[segment] = c->displaced[image] = segment > 0;
  } else {
    compare_inertias(c, segment, image);
  }
}

/* ------------------------------------------------------------------------ feet */

static int compare_points(comparison *c, int a, int b) {
  const ambulo_point *own = &c->model->points[a], *other = &c->model->points[b];
  double from[3], to[3];
  ambulo__segment_point(&c->segments, a, from);
  ambulo__segment_point(&c->segments, b, to);
  return compare_places(c, "the place", own->name, from, a == b ? own->name : other->name, to);
}

static double distance(const comparison *c, int a, int b) {
  double from[3], to[3];
  ambulo__segment_point(&c->segments, a, from);
  ambulo__segment_point(&c->segments, b, to);
  return hypot(hypot(from[0] - to[0], from[1] - to[1]), from[2] + to[2]);
}

/* the corners at one end, in the order in which they fit */
static int compare_corners(comparison *c, const int a[2], const int b[2]) {
  if (a[1] < 0 || b[1] < 0) return compare_points(c, a[0], b[0]);
  int crossed = distance(c, a[0], b[1]) + distance(c, a[1], b[0]) <
                distance(c, a[0], b[0]) + distance(c, a[1], b[1]);
  return compare_points(c, a[0], b[crossed]) || compare_points(c, a[1], b[!crossed]);
}

static int segment_of(const comparison *c, int point) {
  return c->segments.of_link[c->model->points[point].link];
}

static void compare_feet(comparison *c, int i, int m) {
  const ambulo_foot *a = &c->model->feet[i], *b = &c->model->feet[m];
  int segment = segment_of(c, a->heel_center), image = segment_of(c, b->heel_center);
  if (image != image_of(c, segment)) {
    DIFFER(c, i == m ? "'mirror' of a foot names the one on the other side" : c->words->hint,
           "foot '%s' moves with '%s', its mirror image '%s' with '%s'; expected '%s', the mirror "
           "partner of '%s'",
           a->name, name_of(c, segment), b->name, name_of(c, image),
           name_of(c, image_of(c, segment)), name_of(c, segment));
    return;
  }
  if ((a->heel[1] < 0) != (b->heel[1] < 0) || a->has_tip != b->has_tip) {
    DIFFER(c, c->words->hint,
           "foot '%s' has %d corners and %s tip, its mirror partner '%s' %d corners and %s tip; "
           "expected the same points",
           a->name, a->heel[1] < 0 ? 2 : 4, a->has_tip ? "a" : "no", b->name,
           b->heel[1] < 0 ? 2 : 4, b->has_tip ? "a" : "no");
    return;
  }
  if (c->displaced[segment]) return;
  if (compare_points(c, a->heel_center, b->heel_center) ||
      compare_points(c, a->toe_center, b->toe_center) || compare_corners(c, a->heel, b->heel) ||
      compare_corners(c, a->toe, b->toe))
    return;
  if (a->has_tip && compare_points(c, a->tip, b->tip)) return;
  for (int end = 0; a->has_arcs && b->has_arcs && end < 2; end++)
    if (compare_points(c, a->arc[end], b->arc[end])) return;
}

/* ------------------------------------------------------------------------- all */

/* the furthest joint, centre of mass or point of a foot */
static double size_of(const comparison *c) {
  double size = 0.0, r[3];
  for (int i = 0; i < c->model->coordinate_count; i++) {
    ambulo__segment_frame joint = ambulo__segment_joint(&c->segments, i);
    const double *com = c->segments.body[i + 1].com;
    size = fmax(size, hypot(hypot(joint.origin[0], joint.origin[1]), joint.origin[2]));
    size = fmax(size, hypot(hypot(com[0], com[1]), com[2]));
  }
  for (int f = 0; f < c->model->foot_count; f++) {
    ambulo__segment_point(&c->segments, c->model->feet[f].toe_center, r);
    size = fmax(size, hypot(hypot(r[0], r[1]), r[2]));
  }
  return size;
}

static void compare(comparison *c) {
  const ambulo_model *model = c->model;
  c->size = size_of(c);
  compare_bodies(c, 0, 0);
  for (int i = 0; i < model->coordinate_count; i++) {
    int m = model->coordinates[i].mirror;
    if (m < i) continue;
    int parent = ambulo__segment_parent(&c->segments, i);
    int elsewhere = c->displaced[parent] || compare_chain(c, i, m) || compare_axes(c, i, m);
    c->displaced[i + 1] = c->displaced[m + 1] = (char)elsewhere;
    if (i != m) compare_drives(c, i, m);
    compare_bodies(c, i + 1, m + 1);
  }
  for (int f = 0; f < model->foot_count; f++) {
    if (model->feet[f].mirror >= f) compare_feet(c, f, model->feet[f].mirror);
  }
}

static int is_followed(const ambulo_model *model, int coordinate) {
  for (int i = 0; i < model->link_count; i++)
    if (model->couplings[i].to == coordinate) return 1;
  return 0;
}

/* the joints that follow coordinate i and its partner; reports where these stand at first */
static void compare_followers(comparison *c, int i, double *followed) {
  static const double places[] = {-1.5, -0.7, -0.1, 0.2, 0.6, 1.7};
  const ambulo_coordinate *own = &c->model->coordinates[i];
  for (size_t k = 0; k < sizeof places / sizeof *places; k++) {
    comparison silent = *c;
    silent.diagnostics = NULL;
    followed[own->mirror] = own->mirror_sign * places[k];
    followed[i] = places[k];
    ambulo__segments_at(&silent.segments, followed);
    memset(c->displaced, 0, (size_t)c->model->coordinate_count + 1);
    compare(&silent);
    followed[i] = followed[own->mirror] = 0.0;
    if (silent.status == AMBULO_OK) continue;
    DIFFER(c, c->words->hint,
           "joints that follow '%s' and '%s' are not mirror images of each other where these stand "
           "at %g and %g",
           own->name, c->model->coordinates[own->mirror].name, places[k],
           own->mirror_sign * places[k]);
    return;
  }
}

/* Each pair once; what is its own image with the sign turned is so at 0 alone. */
static void compare_functions(comparison *c) {
  const ambulo_model *model = c->model;
  double *followed =
      ambulo__alloc(&c->segments.allocator, (size_t)model->coordinate_count, sizeof *followed);
  if (!followed) c->status = AMBULO_E_MEMORY;
  for (int i = 0; followed && i < model->coordinate_count && !c->status; i++) {
    const ambulo_coordinate *own = &model->coordinates[i];
    int alone = own->mirror == i && own->mirror_sign < 0.0;
    if (own->mirror < i || alone) continue;
    if (is_followed(model, i) || is_followed(model, own->mirror)) compare_followers(c, i, followed);
  }
  ambulo__free(&c->segments.allocator, followed);
}

ambulo_status ambulo__mirror_image_check(const ambulo_model *model,
                                         const ambulo__mirror_words *words,
                                         const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics) {
  comparison c = {.model = model, .words = words, .diagnostics = diagnostics};
  ambulo_status status = ambulo__segments_create(model, allocator, &c.segments);
  if (status) return status;
  c.displaced = ambulo__alloc(&c.segments.allocator, (size_t)model->coordinate_count + 1, 1);
  if (c.displaced) {
    compare(&c);
    if (model->coupled_count > 0 && !c.status) compare_functions(&c);
  } else {
    c.status = AMBULO_E_MEMORY;
  }
  ambulo__free(&c.segments.allocator, c.displaced);
  ambulo__segments_free(&c.segments);
  return c.status;
}

ambulo_status ambulo_model_check_mirror(const ambulo_model *model,
                                        const ambulo_allocator *allocator,
                                        ambulo_diagnostics *diagnostics) {
  static const ambulo__mirror_words words = {AMBULO_E_MODEL, "", NULL};
  if (!model) return AMBULO_E_ARGUMENT;
  return ambulo__mirror_image_check(model, &words, allocator, diagnostics);
}
