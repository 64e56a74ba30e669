/* import/feet.c - heels and toes: by options, else from the solids of links.
 *
 * A foot is a link with all that is fixed to it. Of its solids the lowest points are taken, and of
 * those within 2 cm above the lowest one the rectangle along forward and left: its back edge is the
 * heel, its front edge the toe, all at the lowest height. In a planar body each edge is one point.
 *
 * A foot that is a ball, and those of a body with more than two, are point feet: the lowest point.
 */
#include "base/numtext.h"
#include "base/arithmetic.h"
#include "import/body_tree.h"
#include "model/model_check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_FEET = 32 };

typedef struct feet {
  ambulo__tree *tree;
  double axes[3][3]; /* forward, left, up */
} feet;

typedef struct spot {
  int link, start;
} spot;

/* ---------------------------------------------------------------------- geometry */

/* whether some joint leaves the plane of forward and up */
static int is_spatial(const feet *f) {
  ambulo__tree *t = f->tree;
  for (int i = 0; i < t->link_count; i++) {
    double axis[3];
    ambulo__rigid place = ambulo__tree_place(t, i);
    ambulo__rigid_vector(&place, t->links[i].axis, axis);
    double along = fabs(ambulo__dot(axis, f->axes[1]));
    if (t->links[i].type == AMBULO_REVOLUTE && along < 1.0 - 1e-9) return 1;
    if (t->links[i].type == AMBULO_PRISMATIC && along > 1e-9) return 1;
  }
  return 0;
}

/* a point at (forward, left, up) of the world on a link, at q = 0 or in the start pose */
static int put(feet *f, const char *foot, const char *part, spot on, const double at[3]) {
  double world[3], local[3];
  for (int i = 0; i < 3; i++)
    world[i] = at[0] * f->axes[0][i] + at[1] * f->axes[1][i] + at[2] * f->axes[2][i];
  ambulo__rigid place = ambulo__tree_pose_of(f->tree, on.link, on.start);
  ambulo__rigid back = ambulo__rigid_inverse(&place);
  ambulo__rigid_point(&back, world, local);
  return ambulo__tree_add_point(
      f->tree, ambulo__arena_print(f->tree->arena, "%.40s_%s", foot, part), on.link, local);
}

/* one end of a foot: the middle, and in space its two corners, the lateral one first */
static int put_edge(feet *f, const char *foot, const char *part, spot on, double along,
                    const double across[2], double height, int spatial, int corners[2]) {
  const double middle[3] = {along, 0.5 * (across[0] + across[1]), height};
  int center = put(f, foot, part, on, middle);
  corners[0] = center;
  corners[1] = -1;
  if (!spatial) return center;
  int left = ambulo__side_of(foot) == 'l';
  for (int k = 0; k < 2; k++) {
    const double at[3] = {along, across[left ? 1 - k : k], height};
    const char *name = ambulo__arena_print(f->tree->arena, "%s_%s", part, k ? "medial" : "lateral");
    corners[k] = put(f, foot, name, on, at);
  }
  return center;
}

static ambulo__tree_foot *add_foot(ambulo__tree *t, const char *name, int link) {
  if (!ambulo__arena_grow(t->arena, &t->feet, t->foot_count, &t->foot_capacity, sizeof *t->feet))
    return NULL;
  t->feet[t->foot_count] = (ambulo__tree_foot){.name = name, .link = link};
  return &t->feet[t->foot_count++];
}

static double height_of_body(const feet *f) {
  double lowest = INFINITY, top = -INFINITY;
  for (int i = 0; i < f->tree->link_count; i++) {
    ambulo__rigid place = ambulo__tree_pose_of(f->tree, i, 1);
    double at = ambulo__dot(f->axes[2], place.p);
    lowest = fmin(lowest, at);
    top = fmax(top, at);
  }
  return fmax(0.0, top - lowest);
}

/* the sole of a foot, or a box in its stead; 0 after a note */
static int find_sole(feet *f, const char *name, int link, ambulo__sole *sole) {
  ambulo__tree *t = f->tree;
  const char *body = t->links[link].name;
  if (ambulo__sole_of(t, link, (const double(*)[3])f->axes, sole)) return 1;
  int meshes = sole->meshes;
  if (ambulo__sole_of_markers(t, link, name, (const double(*)[3])f->axes, sole)) return 1;
  const char *why = meshes ? "its geometry is a mesh that could not be read"
                           : "it has no geometry that touches the ground";
  ambulo__sole box;
  if (ambulo__sole_of_inertia(t, link, (const double(*)[3])f->axes, 0.25 * height_of_body(f),
                              &box)) {
    ambulo__tree_note(t, t->links[link].node,
                      "%s: %s: the foot '%s' is guessed from its inertia, %s m long; give --heel "
                      "%s=%s:X,Y,Z and --toe",
                      body, why, name, ambulo__three_digits(box.along[1] - box.along[0]).text, name,
                      body);
    *sole = box;
    return 1;
  }
  ambulo__tree_note(t, t->links[link].node,
                    "%s: %s, so the foot '%s' has no points: give them by --heel %s=%s:X,Y,Z and "
                    "--toe",
                    body, why, name, name, body);
  return 0;
}

/* a foot that is one point, in the middle of its sole */
static void put_point(feet *f, spot on, const ambulo__sole *sole, ambulo__tree_foot *foot) {
  const double middle[3] = {0.5 * (sole->along[0] + sole->along[1]),
                            0.5 * (sole->across[0] + sole->across[1]), sole->height};
  foot->heel_center = foot->toe_center = put(f, foot->name, "point", on, middle);
  foot->heel[0] = foot->toe[0] = foot->heel_center;
  foot->heel[1] = foot->toe[1] = -1;
}

static int foot_from_solids(feet *f, const char *name, int link, int point) {
  ambulo__sole sole;
  if (!find_sole(f, name, link, &sole)) return 0;
  int spatial = is_spatial(f) && sole.across[1] - sole.across[0] > 1e-3;
  ambulo__tree_foot *foot = add_foot(f->tree, name, link);
  if (!foot) return 0;
  spot on = {link, sole.start};
  if (point || sole.is_point) {
    put_point(f, on, &sole, foot);
    return 1;
  }
  foot->heel_center =
      put_edge(f, name, "heel", on, sole.along[0], sole.across, sole.height, spatial, foot->heel);
  foot->toe_center =
      put_edge(f, name, "toe", on, sole.along[1], sole.across, sole.height, spatial, foot->toe);
  return 1;
}

/* ----------------------------------------------------------------------- options */

/* "FOOT=LINK..." : the foot's name in the arena, the link's index and what follows; -1 after an
 * error */
static int parse_place(ambulo__tree *t, const char *option, const char *text, const char **foot,
                       const char **rest) {
  const char *equals = strchr(text, '=');
  const char *end = equals ? equals + 1 + strcspn(equals + 1, ":") : NULL;
  if (!equals || equals == text || end == equals + 1) {
    ambulo__xml_error(t->xml, NULL, AMBULO_E_ARGUMENT, NULL,
                      "--%s '%.80s' names no link; expected FOOT=LINK%s", option, text,
                      strcmp(option, "foot") ? ":X,Y,Z" : "");
    return -1;
  }
  *foot = ambulo__arena_copy(t->arena, text, (size_t)(equals - text));
  const char *name = ambulo__arena_copy(t->arena, equals + 1, (size_t)(end - equals - 1));
  int link = *foot && name ? ambulo__tree_find(t, name) : -1;
  *rest = *end == ':' ? end + 1 : end;
  if (link < 0 && !t->arena->failed) {
    const char **names = ambulo__arena_take(t->arena, (size_t)t->link_count + 1, sizeof *names);
    for (int i = 0; names && i < t->link_count; i++) names[i] = t->links[i].name;
    ambulo__xml_error(
        t->xml, NULL, AMBULO_E_ARGUMENT, ambulo__xml_nearest(t->xml, name, names, t->link_count),
        "--%s: unknown link (got '%.60s'); expected a link of the body", option, name);
  }
  return link;
}

/* one or two corners "X,Y,Z" or "X,Y,Z:X,Y,Z" on a link; how many, 0 after an error */
static int parse_corners(ambulo__tree *t, const char *option, const char *text, double at[2][3]) {
  int count = 0;
  for (const char *part = text; count < 3 && *part; count++) {
    size_t length = strcspn(part, ":");
    for (int i = 0; i < 3; i++) {
      size_t digits = strcspn(part, i < 2 ? ",:" : ":");
      double value = 0.0;
      int good = count < 2 && ambulo__parse_double(part, digits, &value) && fabs(value) < 1e4 &&
                 (i == 2 || part[digits] == ',');
      if (!good) {
        ambulo__xml_error(
            t->xml, NULL, AMBULO_E_ARGUMENT, NULL,
            "--%s: '%.80s' is not a position; expected X,Y,Z or X,Y,Z:X,Y,Z in metres", option,
            text);
        return 0;
      }
      at[count][i] = value;
      part += digits + (part[digits] != '\0');
    }
    (void)length;
  }
  if (count == 0)
    ambulo__xml_error(t->xml, NULL, AMBULO_E_ARGUMENT, NULL,
                      "--%s has no position; expected FOOT=LINK:X,Y,Z", option);
  return count;
}

/* points of one end by hand: centre and corners; 0 after an error */
static int put_by_hand(ambulo__tree *t, const char *option, const char *text, const char *foot,
                       int *center, int corners[2]) {
  const char *same, *rest;
  double at[2][3], middle[3];
  int link = parse_place(t, option, text, &same, &rest);
  int count = link < 0 ? 0 : parse_corners(t, option, rest, at);
  if (count == 0) return 0;
  for (int i = 0; i < 3; i++) middle[i] = count > 1 ? 0.5 * (at[0][i] + at[1][i]) : at[0][i];
  const char *name = ambulo__arena_print(t->arena, "%.40s_%s", foot, option);
  *center = corners[0] = ambulo__tree_add_point(t, name, link, middle);
  corners[1] = -1;
  for (int k = 0; k < count && count > 1; k++)
    corners[k] =
        ambulo__tree_add_point(t, ambulo__arena_print(t->arena, "%s_%d", name, k + 1), link, at[k]);
  return 1;
}

/* each --heel wants its --toe */
static void feet_by_hand(ambulo__tree *t) {
  const ambulo_import_options *o = t->options;
  for (int h = 0; h < o->heel_count; h++) {
    const char *text = o->heels[h], *toe = NULL;
    size_t length = strcspn(text, "=");
    for (int k = 0; k < o->toe_count; k++)
      if (strncmp(o->toes[k], text, length + 1) == 0) toe = o->toes[k];
    const char *name = ambulo__arena_copy(t->arena, text, length);
    if (!name) return;
    if (!toe) {
      ambulo__xml_error(t->xml, NULL, AMBULO_E_ARGUMENT, NULL,
                        "--heel %.60s has no --toe; expected --toe %.40s=LINK:X,Y,Z", text, name);
      return;
    }
    ambulo__tree_foot *foot = add_foot(t, name, -1);
    if (!foot || !put_by_hand(t, "heel", text, name, &foot->heel_center, foot->heel) ||
        !put_by_hand(t, "toe", toe, name, &foot->toe_center, foot->toe))
      return;
    foot->link = t->points[foot->heel_center].link;
  }
}

/* ------------------------------------------------------------------- by themselves */

enum { LONG_FEET = 2 }; /* a body with more of them stands on points */

static void guess_feet(feet *f, int *legless) {
  ambulo__leg legs[MOST_FEET];
  int count = ambulo__find_legs(f->tree, (const double(*)[3])f->axes, legs, MOST_FEET, legless);
  for (int k = 0; k < count; k++)
    (void)foot_from_solids(f, legs[k].name, legs[k].link, count > LONG_FEET);
}

/* Lifts a root of the importer's own so that the lowest point of the feet is on the ground. */
static void stand(feet *f) {
  ambulo__tree *t = f->tree;
  double lowest = INFINITY;
  for (int i = 0; i < t->point_count; i++) {
    double at[3];
    ambulo__rigid place = ambulo__tree_place(t, t->points[i].link);
    ambulo__rigid_point(&place, t->points[i].position, at);
    lowest = fmin(lowest, ambulo__dot(at, f->axes[2]));
  }
  if (!t->root_free || !isfinite(lowest) || t->link_count == 0) return;
  for (int i = 0; i < 3; i++) t->links[0].origin.p[i] -= lowest * f->axes[2][i];
  for (int i = t->trunk; i >= 0; i = t->links[i].parent) { /* the source's start stays */
    ambulo_coordinate *c = &t->links[i].coordinate;
    double up = ambulo__dot(t->links[i].axis, f->axes[2]);
    if (t->links[i].type == AMBULO_PRISMATIC && fabs(up) > 0.999 && c->default_value != 0.0)
      c->default_value += lowest * up;
  }
}

static int is_last(const ambulo__tree *t, int link) {
  for (int i = 0; i < t->link_count; i++)
    if (t->links[i].parent == link) return 0;
  return 1;
}

/* how to say what the source does not, with the links that may be feet */
static void note_no_feet(ambulo__tree *t, int legless) {
  char ends[240] = "";
  size_t used = 0;
  for (int i = 0; i < t->link_count && used + 80 < sizeof ends; i++)
    if (is_last(t, i))
      used += (size_t)snprintf(ends + used, sizeof ends - used, "%s%.64s", used ? ", " : "",
                               t->links[i].name);
  if (legless) {
    ambulo__tree_note(
        t, NULL,
        "no feet: the model has no legs: none of its limbs ends lower than its trunk; "
        "--foot NAME=LINK names a foot all the same; links at the ends of the body: "
        "%s",
        ends);
    return;
  }
  ambulo__tree_note(t, NULL,
                    "no feet: no link is named like a foot and has geometry; name them by --foot "
                    "left=LINK, or by --heel and --toe left=LINK:X,Y,Z; links at the ends of the "
                    "body: %s",
                    ends);
}

void ambulo__find_feet(ambulo__tree *tree) {
  feet f = {.tree = tree};
  int legless = 0;
  ambulo__tree_axes(tree, f.axes);
  feet_by_hand(tree);
  for (int i = 0; i < tree->options->foot_count && !tree->xml->status; i++) {
    const char *name = NULL, *rest = NULL;
    int link = parse_place(tree, "foot", tree->options->feet[i], &name, &rest);
    if (link >= 0) (void)foot_from_solids(&f, name, link, tree->options->foot_count > LONG_FEET);
  }
  if (tree->xml->status || tree->arena->failed) return;
  if (tree->foot_count == 0) guess_feet(&f, &legless);
  if (tree->foot_count == 0) note_no_feet(tree, legless);
  ambulo__check_feet(tree, (const double(*)[3])f.axes);
  stand(&f);
}
