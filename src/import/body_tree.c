/* import/body_tree.c - links, bodies, names and notes of a tree (body_tree.h).
 *
 * Reading order: import.c, body_tree.h, body_tree.c, tree_links.c, rigid.h, xml.h; urdf.c; osim.c,
 * osim_bodies.c, osim_functions.c; mjcf.c, mjcf_bodies.c; tree_functions.c, loops.c; feet.c,
 * legs.c, foot_solids.c, foot_meshes.c, start_pose.c; mirror_pairs.c, symmetrize.c; tree_yaml.c,
 * tree_meshes.c.
 */
#include "import/body_tree.h"

#include "base/arithmetic.h"
#include "model/model_check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double rounding = 1e-15; /* kg m^2: of files that were written by programs */
/* kg, kg m^2: placeholders that weigh nothing, whose inertia may be mended unasked */
static const double trifle = 1e-3, trifling = 1e-5;
static const double LIGHTEST = 1e-9; /* kg: a body of a model file */
static const double FARTHEST = 1e4;  /* m: what is larger or farther away is no part of a body */
enum { MOST_SOLIDS = 2048 };         /* more than a body has, few enough to compare in pairs */

void ambulo__tree_note(ambulo__tree *tree, const ambulo__xml_node *node, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const char *text = ambulo__arena_vprint(tree->arena, format, arguments);
  va_end(arguments);
  ambulo__warning(tree->xml->diagnostics, ambulo__xml_place(node), NULL, "%s", text);
  if (!ambulo__arena_grow(tree->arena, &tree->notes, tree->note_count, &tree->note_capacity,
                          sizeof *tree->notes))
    return;
  tree->notes[tree->note_count++] = text;
}

/* --------------------------------------------------------------------- names */

static int is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == '.';
}

/* what a model file takes: other characters become '_', at most `most` of them */
static const char *plain(ambulo__tree *tree, const char *name, size_t most) {
  size_t length = strlen(name);
  char *copy = ambulo__arena_copy(tree->arena, name, length > most ? most : length);
  if (!copy) return "";
  for (char *c = copy; *c; c++)
    if (!is_name_character(*c)) *c = '_';
  /* of the rows that a link with an origin becomes (definitions/model_placement.c) */
  static const char *const taken[] = {".place", ".turn", ".joint"};
  for (int i = 0; i < 3; i++) {
    size_t end = strlen(taken[i]), own = strlen(copy);
    if (own >= end && strcmp(copy + own - end, taken[i]) == 0) copy[own - end] = '_';
  }
  if (!copy[0]) return "unnamed";
  return strcmp(copy, "world") == 0 || strcmp(copy, "none") == 0 ? "base" : copy;
}

typedef int (*finder)(const ambulo__tree *tree, const char *name);

/* that, and of nobody else's: NAME_2, NAME_3, ..., after a few by how many links there are */
static const char *own_name(ambulo__tree *tree, const char *name, finder find) {
  enum { FEW = 10 };
  const char *wanted = plain(tree, name, AMBULO__MAX_NAME), *given = wanted;
  for (int k = 2; find(tree, given) >= 0 && k <= AMBULO__MAX_LINKS + FEW; k++) {
    int number = k <= FEW ? k : tree->link_count + k;
    given = ambulo__arena_print(tree->arena, "%.56s_%d", wanted, number);
  }
  return given;
}

int ambulo__tree_find(const ambulo__tree *tree, const char *name) {
  for (int i = 0; i < tree->link_count; i++)
    if (strcmp(tree->links[i].name, name) == 0) return i;
  return -1;
}

int ambulo__tree_find_coordinate(const ambulo__tree *tree, const char *name) {
  for (int i = 0; i < tree->link_count; i++) {
    const ambulo__tree_link *link = &tree->links[i];
    if (link->coordinate.name && strcmp(link->coordinate.name, name) == 0) return i;
  }
  return -1;
}

/* --------------------------------------------------------------------- links */

int ambulo__tree_add(ambulo__tree *tree, const char *name, int parent, ambulo_joint_type type,
                     const ambulo__rigid *origin, const double axis[3],
                     const ambulo__xml_node *node) {
  if (tree->link_count >= AMBULO__MAX_LINKS) {
    ambulo__xml_error(tree->xml, node, AMBULO_E_LIMIT, NULL,
                      "the body has too many links; expected at most %d", (int)AMBULO__MAX_LINKS);
    return -1;
  }
  if (!ambulo__arena_grow(tree->arena, &tree->links, tree->link_count, &tree->link_capacity,
                          sizeof *tree->links))
    return -1;
  ambulo__tree_link link = {.parent = parent, .type = type, .origin = *origin, .node = node};
  if (axis) memcpy(link.axis, axis, sizeof link.axis);
  link.coordinate = ambulo_coordinate_default();
  link.coordinate.type = type;
  link.name = own_name(tree, name, ambulo__tree_find);
  if (type != AMBULO_FIXED) {
    link.coordinate.name = own_name(tree, name, ambulo__tree_find_coordinate);
  }
  tree->links[tree->link_count] = link;
  return tree->link_count++;
}

/* The smallest equal addition to the principal moments with which the largest is no more than the
 * sum of the others and none is negative: m1 + m2 + 2 t >= m3 + t, m1 + t >= 0. */
static double repair(const double inertia[6]) {
  double moments[3];
  ambulo__principal_moments(inertia, moments);
  double more = fmax(moments[2] - moments[0] - moments[1], -moments[0]);
  return more > 0.0 ? more * (1.0 + 1e-9) : 0.0;
}

ambulo__number ambulo__three_digits(double x) {
  double power = x > 0.0 ? pow(10.0, 2 - floor(log10(x))) : 1.0;
  return ambulo__number_text(round(x * power) / power);
}

void ambulo__tree_body(ambulo__tree *tree, int link, const ambulo__part *part,
                       const ambulo__xml_node *mass, const ambulo__xml_node *node) {
  if (link < 0) return;
  ambulo__part body = *part;
  const char *name = tree->links[link].name;
  int has_inertia = 0;
  for (int i = 0; i < 6; i++) has_inertia |= body.inertia[i] != 0.0;
  if (body.mass == 0.0) {
    if (has_inertia)
      ambulo__tree_note(tree, node, "%s: an inertia without a mass is left out", name);
    return;
  }
  if (body.mass > 0.0 && body.mass < LIGHTEST) {
    ambulo__tree_note(tree, node, "%s: its mass of %s kg is left out", name,
                      ambulo__number_text(body.mass).text);
    return;
  }
  double more = repair(body.inertia);
  if (more > 0.0 && more < rounding) {
    for (int i = 0; i < 3; i++) body.inertia[i] += more;
  } else if (more > 0.0 && (tree->options->repair_inertia || tree->repair_inertia ||
                            (body.mass <= trifle && more <= trifling))) {
    for (int i = 0; i < 3; i++) body.inertia[i] += more;
    ambulo__tree_note(tree, node,
                      "%s: its inertia is impossible: %s kg m^2 were added to its moments", name,
                      ambulo__three_digits(more).text);
  }
  ambulo__place place = ambulo__xml_place(node);
  size_t before = ambulo_diagnostics_error_count(tree->xml->diagnostics);
  ambulo_status status = ambulo__check_body(name, body.mass, body.com, body.inertia,
                                            (ambulo__body_places){ambulo__xml_place(mass), place},
                                            tree->xml->diagnostics);
  if (status && body.mass > 0.0 && repair(body.inertia) > 0.0 &&
      ambulo_diagnostics_error_count(tree->xml->diagnostics) > before)
    ambulo__note(tree->xml->diagnostics, place,
                 "--repair-inertia adds %s kg m^2 to the moments of '%s'",
                 ambulo__three_digits(repair(body.inertia)).text, name);
  if (status && !tree->xml->status) tree->xml->status = status;
  if (!status) ambulo__part_add(&tree->links[link].body, &body);
}

void ambulo__tree_add_solid(ambulo__tree *tree, const ambulo__tree_solid *solid) {
  for (int i = 0; i < 3; i++)
    if (!(fabs(solid->at.p[i]) <= FARTHEST) || !(fabs(solid->size[i]) <= FARTHEST)) return;
  if (solid->link < 0 || tree->solid_count >= MOST_SOLIDS ||
      !ambulo__arena_grow(tree->arena, &tree->solids, tree->solid_count, &tree->solid_capacity,
                          sizeof *tree->solids))
    return;
  tree->solids[tree->solid_count++] = *solid;
}

int ambulo__tree_add_point(ambulo__tree *tree, const char *name, int link, const double at[3]) {
  if (tree->point_count >= AMBULO__MAX_POINTS ||
      !ambulo__arena_grow(tree->arena, &tree->points, tree->point_count, &tree->point_capacity,
                          sizeof *tree->points))
    return -1;
  ambulo__tree_point point = {.name = plain(tree, name, AMBULO__MAX_NAME), .link = link};
  memcpy(point.position, at, sizeof point.position);
  tree->points[tree->point_count] = point;
  return tree->point_count++;
}

static const double LONGEST = 1e6, HEAVIEST = 1e6;               /* m; kg */
static const double LEAST_GRAVITY = 1e-3, LARGEST_GRAVITY = 1e5; /* m/s^2 */
static const double LARGEST_LIMIT = 1e9;                         /* rad, m, their rates, N m, N */

/* limits as large as that are how files write none */
static void drop_limits(double limits[2]) {
  for (int i = 0; i < 2; i++)
    if (!(fabs(limits[i]) <= LARGEST_LIMIT)) limits[i] = i ? INFINITY : -INFINITY;
}

void ambulo__tree_gravity(ambulo__tree *tree) {
  static const double x[3] = {1, 0, 0};
  double *g = tree->gravity, across[3];
  double size = fmax(fabs(g[0]), fmax(fabs(g[1]), fabs(g[2])));
  if (!(size >= LEAST_GRAVITY && size <= LARGEST_GRAVITY)) {
    ambulo__tree_note(tree, NULL, "gravity is %s m/s^2 in the source: it is 9.81 here, along -%c",
                      ambulo__number_text(size).text, tree->up);
    for (int i = 0; i < 3; i++) g[i] = tree->up - 'x' == i ? -9.81 : 0.0;
  }
  ambulo__cross(g, x, across);
  if (ambulo__normalize(across) > 1e-3 * size) return;
  ambulo__cross(g, tree->forward, across); /* else it is settled (import.c) */
  int along = ambulo__normalize(across) <= 1e-3 * size;
  for (int i = 0; i < 3 && along; i++) tree->forward[i] = i == 1; /* y is as good as z */
  ambulo__tree_note(tree, NULL, "gravity is along x in the source: forward is y here");
}

static void check_drive(ambulo__tree *tree, const ambulo__tree_link *link, const char *what,
                        double value) {
  if (value >= 0.0 && value <= LARGEST_LIMIT) return;
  ambulo__xml_error(tree->xml, link->node, AMBULO_E_MODEL, NULL,
                    "%s of '%.64s' is out of range (got %s); expected 0 to 1e9", what,
                    link->coordinate.name, ambulo__number_text(value).text);
}

void ambulo__tree_check(ambulo__tree *tree) {
  for (int i = 0; i < tree->link_count; i++) {
    ambulo__tree_link *link = &tree->links[i];
    double size = 0.0;
    for (int k = 0; k < 3; k++) size = fmax(size, fabs(link->origin.p[k]));
    if (!(link->body.mass <= HEAVIEST))
      ambulo__xml_error(tree->xml, link->node, AMBULO_E_MODEL, NULL,
                        "'%.64s' is too heavy (got %s kg in all); expected at most 1e6 kg",
                        link->name, ambulo__number_text(link->body.mass).text);
    if (!(size <= LONGEST))
      ambulo__xml_error(tree->xml, link->node, AMBULO_E_MODEL, NULL,
                        "'%.64s' is too far from its parent (got %s m); expected at most 1e6 m",
                        link->name, ambulo__number_text(size).text);
    drop_limits(link->coordinate.range);
    drop_limits(link->coordinate.speed);
    drop_limits(link->coordinate.torque);
    check_drive(tree, link, "armature", link->coordinate.armature);
    check_drive(tree, link, "damping", link->coordinate.damping);
    check_drive(tree, link, "friction", link->coordinate.friction);
  }
}

void ambulo__tree_range(ambulo__tree *tree, int link, const double range[2], double scale,
                        const ambulo__xml_node *node) {
  ambulo_coordinate *c = &tree->links[link].coordinate;
  if (range[0] > range[1])
    ambulo__xml_error(tree->xml, node, AMBULO_E_MODEL, NULL,
                      "the range of '%.60s' contradicts itself (got %s to %s); expected lower <= "
                      "upper",
                      c->name, ambulo__number_text(range[0]).text,
                      ambulo__number_text(range[1]).text);
  for (int i = 0; i < 2; i++) c->range[i] = scale * range[i];
}

int ambulo__tree_axis(ambulo__tree *tree, double axis[3], const char *joint,
                      const ambulo__xml_node *node) {
  if (ambulo__normalize(axis) > 1e-12) return 1;
  ambulo__xml_error(tree->xml, node, AMBULO_E_MODEL, NULL,
                    "the axis of joint '%.60s' has no direction (got 0 0 0); expected a vector",
                    joint);
  return 0;
}

void ambulo__tree_axes(const ambulo__tree *tree, double axes[3][3]) {
  for (int i = 0; i < 3; i++) {
    axes[2][i] = -tree->gravity[i];
    axes[0][i] = tree->forward[i];
  }
  (void)ambulo__normalize(axes[2]);
  ambulo__cross(axes[2], axes[0], axes[1]);
  (void)ambulo__normalize(axes[1]);
  ambulo__cross(axes[1], axes[2], axes[0]);
}

double ambulo__tree_pose(const ambulo__tree *tree, const char *coordinate, double fallback) {
  size_t length = strlen(coordinate);
  for (int i = 0; i < tree->options->pose_count; i++) {
    const char *text = tree->options->pose[i];
    double value;
    if (strncmp(text, coordinate, length) != 0 || text[length] != '=') continue;
    if (ambulo__parse_double(text + length + 1, strlen(text + length + 1), &value)) return value;
  }
  return fallback;
}

/* ----------------------------------------------------------------------- chains */

/* Joints of several coordinates as links, one coordinate each.
 *
 * Placements in between are put together. What comes after the last joint is taken into it where
 * that can be: with C = Trans(c) R_C,
 *
 *     P Trans(a q) C = (P C) Trans(R_C' a q)               always
 *     P Rot(a, q) C  = (P C) Rot(R_C' a, q)                for c = 0
 *
 * else the body hangs behind it on a fixed link, which costs nothing.
 */

static const double nothing = 1e-15; /* m, and as a sine: rounding of a product */

ambulo__chain ambulo__chain_begin(ambulo__tree *tree, int parent, const ambulo__xml_node *node) {
  return (ambulo__chain){
      .tree = tree, .node = node, .parent = parent, .pending = ambulo__rigid_identity()};
}

void ambulo__chain_place(ambulo__chain *chain, const ambulo__rigid *placement) {
  chain->pending = ambulo__rigid_times(&chain->pending, placement);
}

int ambulo__chain_joint(ambulo__chain *chain, ambulo_joint_type type, const double axis[3],
                        const char *coordinate) {
  double unit[3];
  memcpy(unit, axis, sizeof unit);
  (void)ambulo__normalize(unit);
  int link = ambulo__tree_add(chain->tree, coordinate, chain->parent, type, &chain->pending, unit,
                              chain->node);
  chain->pending = ambulo__rigid_identity();
  if (link < 0) return -1;
  chain->parent = link;
  chain->own++;
  return link;
}

static int taken_in(ambulo__tree_link *last, const ambulo__rigid *c) {
  int moves = fabs(c->p[0]) > nothing || fabs(c->p[1]) > nothing || fabs(c->p[2]) > nothing;
  if (last->type == AMBULO_FIXED || (last->type == AMBULO_REVOLUTE && moves)) return 0;
  double axis[3];
  ambulo__rigid_back(c, last->axis, axis);
  last->origin = ambulo__rigid_times(&last->origin, c);
  memcpy(last->axis, axis, sizeof axis);
  return 1;
}

int ambulo__chain_end(ambulo__chain *chain, const char *name) {
  ambulo__tree *tree = chain->tree;
  if (chain->own == 0 || !taken_in(&tree->links[chain->parent], &chain->pending))
    return ambulo__tree_add(tree, name, chain->parent, AMBULO_FIXED, &chain->pending, NULL,
                            chain->node);
  /* the last joint's link becomes the body's */
  ambulo__tree_link *last = &tree->links[chain->parent];
  const char *before = last->name;
  last->name = "";
  int named = ambulo__tree_add(tree, name, -1, AMBULO_FIXED, &chain->pending, NULL, chain->node);
  last = &tree->links[chain->parent];
  last->name = named < 0 ? before : tree->links[named].name;
  if (named >= 0) tree->link_count--;
  return chain->parent;
}

static void joint_named(ambulo__chain *chain, ambulo_joint_type type, const double axis[3],
                        const char *name, const char *part, int actuated) {
  const char *full = ambulo__arena_print(chain->tree->arena, "%.50s_%s", name, part);
  int link = ambulo__chain_joint(chain, type, axis, full);
  if (link >= 0) chain->tree->links[link].coordinate.actuated = actuated;
}

void ambulo__chain_free(ambulo__chain *chain, const char *prefix) {
  static const char *const slides[] = {"tx", "ty", "tz"};
  double axes[3][3];
  ambulo__tree_axes(chain->tree, axes);
  for (int i = 0; i < 3; i++) {
    const double axis[3] = {i == 0, i == 1, i == 2};
    joint_named(chain, AMBULO_PRISMATIC, axis, prefix, slides[i], 0);
  }
  joint_named(chain, AMBULO_REVOLUTE, axes[1], prefix, "tilt", 0);
  joint_named(chain, AMBULO_REVOLUTE, axes[0], prefix, "list", 0);
  joint_named(chain, AMBULO_REVOLUTE, axes[2], prefix, "rotation", 0);
}

void ambulo__chain_ball(ambulo__chain *chain, const char *name, int *first) {
  static const char *const parts[] = {"x", "y", "z"};
  *first = chain->tree->link_count;
  for (int i = 0; i < 3; i++) {
    const double axis[3] = {i == 0, i == 1, i == 2};
    joint_named(chain, AMBULO_REVOLUTE, axis, name, parts[i], 1);
  }
}
