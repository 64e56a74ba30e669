/* exchange/feet.c - heels and toes: by options, else from the solids of links.
 *
 * A foot is a link with all that is fixed to it. Of its solids the lowest points at q = 0 are
 * taken, and of those within 2 cm above the lowest one the rectangle along forward and left: its
 * back edge is the heel, its front edge the toe, all at the lowest height. In a planar body each
 * edge is one point.
 */
#include "base/numtext.h"
#include "base/arithmetic.h"
#include "exchange/body_tree.h"
#include "model/model_check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { MOST_FEET = 8 };

typedef struct feet {
  ambulo__tree *tree;
  double axes[3][3]; /* forward, left, up */
} feet;

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

/* a point at (forward, left, up) of the world on a link */
static int put(feet *f, const char *foot, const char *part, int link, const double at[3]) {
  double world[3], local[3];
  for (int i = 0; i < 3; i++)
    world[i] = at[0] * f->axes[0][i] + at[1] * f->axes[1][i] + at[2] * f->axes[2][i];
  ambulo__rigid place = ambulo__tree_place(f->tree, link);
  ambulo__rigid back = ambulo__rigid_inverse(&place);
  ambulo__rigid_point(&back, world, local);
  return ambulo__tree_add_point(
      f->tree, ambulo__arena_print(f->tree->arena, "%.40s_%s", foot, part), link, local);
}

/* one end of a foot: the middle, and in space its two corners, the lateral one first */
static int put_edge(feet *f, const char *foot, const char *part, int link, double along,
                    const double across[2], double height, int spatial, int corners[2]) {
  const double middle[3] = {along, 0.5 * (across[0] + across[1]), height};
  int center = put(f, foot, part, link, middle);
  corners[0] = center;
  corners[1] = -1;
  if (!spatial) return center;
  int left = ambulo__side_of(foot) == 'l';
  for (int k = 0; k < 2; k++) {
    const double at[3] = {along, across[left ? 1 - k : k], height};
    const char *name = ambulo__arena_print(f->tree->arena, "%s_%s", part, k ? "medial" : "lateral");
    corners[k] = put(f, foot, name, link, at);
  }
  return center;
}

static ambulo__tree_foot *add_foot(ambulo__tree *t, const char *name) {
  if (!ambulo__arena_grow(t->arena, &t->feet, t->foot_count, &t->foot_capacity, sizeof *t->feet))
    return NULL;
  t->feet[t->foot_count] = (ambulo__tree_foot){.name = name};
  return &t->feet[t->foot_count++];
}

static int foot_from_solids(feet *f, const char *name, int link) {
  ambulo__tree *t = f->tree;
  ambulo__sole sole;
  if (!ambulo__sole_of(t, link, (const double(*)[3])f->axes, &sole) &&
      !ambulo__sole_of_markers(t, link, name, (const double(*)[3])f->axes, &sole)) {
    ambulo__tree_note(t, t->links[link].node,
                      "%s: %s, so the foot '%s' has no points: give them by --heel %s=%s:X,Y,Z and "
                      "--toe",
                      t->links[link].name,
                      sole.meshes   ? "its geometry is a mesh that could not be read"
                      : sole.solids ? "its geometry touches the ground in one point"
                                    : "it has no geometry that touches the ground",
                      name, name, t->links[link].name);
    return 0;
  }
  int spatial = is_spatial(f) && sole.across[1] - sole.across[0] > 1e-3;
  ambulo__tree_foot *foot = add_foot(t, name);
  if (!foot) return 0;
  foot->heel_center =
      put_edge(f, name, "heel", link, sole.along[0], sole.across, sole.height, spatial, foot->heel);
  foot->toe_center =
      put_edge(f, name, "toe", link, sole.along[1], sole.across, sole.height, spatial, foot->toe);
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
    ambulo__tree_foot *foot = add_foot(t, name);
    if (!foot || !put_by_hand(t, "heel", text, name, &foot->heel_center, foot->heel) ||
        !put_by_hand(t, "toe", toe, name, &foot->toe_center, foot->toe))
      return;
  }
}

/* ------------------------------------------------------------------- by themselves */

static int says_foot(const char *name) {
  static const char *const words[] = {"foot", "sole", "calcn"};
  for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
    for (const char *c = name; *c; c++)
      if (strncasecmp(c, words[i], strlen(words[i])) == 0) return 1;
  return 0;
}

static int has_foot(const ambulo__tree *t, const char *name) {
  for (int i = 0; i < t->foot_count; i++)
    if (strcmp(t->feet[i].name, name) == 0) return 1;
  return 0;
}

/* The link of one side that is a foot: named so, and with a sole if one of those has one; -1. */
static int guess(const feet *f, char side) {
  ambulo__tree *t = f->tree;
  int best = -1;
  for (int i = 0; i < t->link_count; i++) {
    ambulo__sole sole;
    if (!says_foot(t->links[i].name) || ambulo__side_of_link(t, i) != side) continue;
    int has = ambulo__sole_of(t, i, (const double(*)[3])f->axes, &sole);
    if (has) return i;
    if (best < 0) best = i;
  }
  return best >= 0 ? best : ambulo__lowest_link(t, (const double(*)[3])f->axes, side);
}

static void guess_feet(feet *f) {
  static const char *const names[] = {"right", "left"};
  for (int k = 0; k < 2; k++) {
    int link = has_foot(f->tree, names[k]) ? -1 : guess(f, names[k][0]);
    if (link >= 0) (void)foot_from_solids(f, names[k], link);
  }
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
}

static int is_end(const ambulo__tree *t, int link) {
  for (int i = 0; i < t->link_count; i++)
    if (t->links[i].parent == link) return 0;
  return 1;
}

/* how to say what the source does not, with the links that may be feet */
static void note_no_feet(ambulo__tree *t) {
  char ends[240] = "";
  size_t used = 0;
  for (int i = 0; i < t->link_count && used + 80 < sizeof ends; i++)
    if (is_end(t, i))
      used += (size_t)snprintf(ends + used, sizeof ends - used, "%s%.64s", used ? ", " : "",
                               t->links[i].name);
  ambulo__tree_note(t, NULL,
                    "no feet: no link is named like a foot and has geometry; name them by --foot "
                    "left=LINK, or by --heel and --toe left=LINK:X,Y,Z; links at the ends of the "
                    "body: %s",
                    ends);
}

void ambulo__find_feet(ambulo__tree *tree) {
  feet f = {.tree = tree};
  ambulo__tree_axes(tree, f.axes);
  feet_by_hand(tree);
  for (int i = 0; i < tree->options->foot_count && !tree->xml->status; i++) {
    const char *name = NULL, *rest = NULL;
    int link = parse_place(tree, "foot", tree->options->feet[i], &name, &rest);
    if (link >= 0) (void)foot_from_solids(&f, name, link);
  }
  if (tree->xml->status || tree->arena->failed) return;
  if (tree->foot_count == 0) guess_feet(&f);
  if (tree->foot_count == 0) note_no_feet(tree);
  stand(&f);
}

/* the pose that a solve begins at: defaults of the source, on the ground.
 *
 * A default outside its range goes to the nearer end. Then, where a slider that nothing drives goes
 * up between the world and the feet, its default changes by as much as the lowest point of the feet
 * is off the ground.
 */

static void keep_in_range(ambulo__tree *tree, ambulo__tree_link *link) {
  ambulo_coordinate *c = &link->coordinate;
  double inside = fmin(c->range[1], fmax(c->range[0], c->default_value));
  if (c->default_value == 0.0 || inside == c->default_value) return;
  ambulo__tree_note(tree, link->node, "%s is %s by default, outside its range: it starts at %s",
                    c->name, ambulo__number_text(c->default_value).text,
                    ambulo__number_text(inside).text);
  c->default_value = inside;
}

/* the slider on the way to a link that goes up and that nothing drives; -1 */
static int lift_of(ambulo__tree *tree, int link, const double up[3], double *along) {
  int found = -1;
  for (int i = link; i >= 0; i = tree->links[i].parent) {
    const ambulo__tree_link *l = &tree->links[i];
    double axis[3];
    if (l->type != AMBULO_PRISMATIC || l->follows || l->coordinate.actuated) continue;
    ambulo__rigid place = ambulo__tree_start_place(tree, i);
    ambulo__rigid_vector(&place, l->axis, axis);
    double cosine = ambulo__dot(axis, up);
    if (fabs(cosine) < 0.999) continue;
    *along = cosine;
    found = i;
  }
  return found;
}

static void start_pose_stand(ambulo__tree *tree) {
  double up[3], lowest = INFINITY, along = 1.0;
  for (int i = 0; i < 3; i++) up[i] = -tree->gravity[i];
  (void)ambulo__normalize(up);
  for (int f = 0; f < tree->foot_count; f++) {
    const ambulo__tree_foot *foot = &tree->feet[f];
    const int points[4] = {foot->heel[0], foot->heel[1], foot->toe[0], foot->toe[1]};
    for (int k = 0; k < 4; k++) {
      double at[3];
      if (points[k] < 0) continue;
      const ambulo__tree_point *point = &tree->points[points[k]];
      ambulo__rigid place = ambulo__tree_start_place(tree, point->link);
      ambulo__rigid_point(&place, point->position, at);
      lowest = fmin(lowest, ambulo__dot(at, up));
    }
  }
  if (!isfinite(lowest) || fabs(lowest) < 1e-6) return;
  int link = lift_of(tree, tree->points[tree->feet[0].heel[0]].link, up, &along);
  if (link < 0) return;
  ambulo_coordinate *c = &tree->links[link].coordinate;
  double value = c->default_value - lowest / along;
  if (!(value >= c->range[0] && value <= c->range[1])) return;
  c->default_value = value;
  if (fabs(lowest) > 1e-3)
    ambulo__tree_note(tree, tree->links[link].node,
                      "%s starts at %s m, %s mm %s than in the source, so that the feet stand on "
                      "the ground",
                      c->name, ambulo__three_digits(fabs(value)).text,
                      ambulo__three_digits(1e3 * fabs(lowest)).text,
                      lowest < 0.0 ? "higher" : "lower");
}

void ambulo__find_start(ambulo__tree *tree) {
  for (int i = 0; i < tree->link_count; i++) keep_in_range(tree, &tree->links[i]);
  start_pose_stand(tree);
}
