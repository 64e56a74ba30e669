/* exchange/foot_collada.c - vertices of a COLLADA file (.dae), placed as its scene says
 * (body_tree.h).
 *
 * <node>s of <visual_scene> hold <matrix>, <translate>, <rotate> and <scale>, each applied to what
 * stands after it, and <instance_geometry url="#ID">. Of that <geometry> the <float_array> counts
 * that the input POSITION of its <vertices> names. Lengths are <unit meter>, and what goes up by
 * <up_axis> goes along z here.
 */
#include "exchange/body_tree.h"

#include "base/numtext.h"

#include <math.h>
#include <string.h>

enum { MOST_INSTANCES = 4096 }; /* more than a foot has parts */

typedef struct affine {
  double m[3][4];
} affine;

typedef struct collada {
  ambulo__xml *xml;
  const ambulo__xml_node *geometries;
  double *points; /* NULL: they are counted */
  size_t count, most;
  int instances;
} collada;

static affine times(const affine *a, const affine *b) {
  affine c;
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 4; k++) {
      c.m[i][k] = k == 3 ? a->m[i][3] : 0.0;
      for (int j = 0; j < 3; j++) c.m[i][k] += a->m[i][j] * b->m[j][k];
    }
  return c;
}

/* what one element of a node does; 0: it is no transform */
static int transform_of(collada *c, const ambulo__xml_node *node, affine *a) {
  double v[16];
  *a = (affine){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  int rotates = ambulo__xml_is(node, "rotate"), scales = ambulo__xml_is(node, "scale"),
      moves = ambulo__xml_is(node, "translate"), whole = ambulo__xml_is(node, "matrix");
  int wanted = whole ? 16 : rotates ? 4 : scales || moves ? 3 : 0;
  if (!wanted || ambulo__xml_numbers(c->xml, node, node->name, node->text, 16, 0, v) != wanted)
    return 0;
  for (int i = 0; i < 3 && scales; i++) a->m[i][i] = v[i];
  for (int i = 0; i < 3 && moves; i++) a->m[i][3] = v[i];
  if (whole) memcpy(a->m, v, sizeof a->m);
  if (rotates && ambulo__normalize(v) > 1e-12) {
    ambulo__rigid turn = ambulo__rigid_turn(v, v[3] * 0.017453292519943295);
    for (int i = 0; i < 3; i++) memcpy(a->m[i], turn.r[i], sizeof turn.r[i]);
  }
  return 1;
}

/* the child of that kind whose id a reference "#ID" names */
static const ambulo__xml_node *referred(const ambulo__xml_node *from, const char *kind,
                                        const char *reference) {
  if (!reference || reference[0] != '#') return NULL;
  AMBULO__XML_EACH (n, from, kind) {
    const char *id = ambulo__xml_attribute(n, "id");
    if (id && strcmp(id, reference + 1) == 0) return n;
  }
  return NULL;
}

/* all numbers of a text, three at a time */
static void take_points(collada *c, const char *text, const affine *place) {
  double p[3];
  int k = 0;
  for (const char *at = text; *at && c->count <= c->most;) {
    at += strspn(at, " \t\r\n");
    size_t digits = strcspn(at, " \t\r\n");
    if (digits == 0 || !ambulo__parse_double(at, digits, &p[k])) return;
    at += digits;
    if (++k < 3) continue;
    k = 0;
    for (int i = 0; i < 3 && c->points; i++) {
      double *to = &c->points[3 * c->count + (size_t)i];
      *to = place->m[i][3];
      for (int j = 0; j < 3; j++) *to += place->m[i][j] * p[j];
    }
    c->count++;
  }
}

static void take_geometry(collada *c, const char *reference, const affine *place) {
  if (c->instances++ >= MOST_INSTANCES) return;
  const ambulo__xml_node *geometry = referred(c->geometries, "geometry", reference);
  const ambulo__xml_node *mesh = ambulo__xml_child(geometry, "mesh");
  AMBULO__XML_EACH (input, ambulo__xml_child(mesh, "vertices"), "input") {
    const char *what = ambulo__xml_attribute(input, "semantic");
    if (!what || strcmp(what, "POSITION") != 0) continue;
    const ambulo__xml_node *source =
        referred(mesh, "source", ambulo__xml_attribute(input, "source"));
    const ambulo__xml_node *numbers = ambulo__xml_child(source, "float_array");
    if (numbers) take_points(c, numbers->text, place);
  }
}

/* levels of nodes are at most those of the document */
static void take_node(collada *c, const ambulo__xml_node *node, affine place) {
  affine own;
  for (const ambulo__xml_node *n = node->first; n; n = n->next) {
    if (transform_of(c, n, &own)) place = times(&place, &own);
    if (ambulo__xml_is(n, "instance_geometry"))
      take_geometry(c, ambulo__xml_attribute(n, "url"), &place);
    if (ambulo__xml_is(n, "node")) take_node(c, n, place);
  }
}

static void take_scene(collada *c, const ambulo__xml_node *root) {
  double unit = 1.0;
  const ambulo__xml_node *asset = ambulo__xml_child(root, "asset");
  (void)ambulo__xml_vector(c->xml, ambulo__xml_child(asset, "unit"), "meter", 1, &unit);
  const ambulo__xml_node *up = ambulo__xml_child(asset, "up_axis");
  const char *axis = up ? up->text : "Z_UP";
  affine place = {{{unit, 0, 0, 0}, {0, unit, 0, 0}, {0, 0, unit, 0}}};
  if (strcmp(axis, "Z_UP") != 0 && unit > 0.0) {
    int y = strcmp(axis, "X_UP") != 0;
    place = y ? (affine){{{unit, 0, 0, 0}, {0, 0, -unit, 0}, {0, unit, 0, 0}}}
              : (affine){{{0, 0, -unit, 0}, {0, unit, 0, 0}, {unit, 0, 0, 0}}};
  }
  c->count = 0;
  c->instances = 0;
  AMBULO__XML_EACH (scene, ambulo__xml_child(root, "library_visual_scenes"), "visual_scene")
    take_node(c, scene, place);
}

/* points that are no numbers go */
static int finite_ones(double *points, size_t count) {
  size_t kept = 0;
  for (size_t k = 0; k < count; k++) {
    const double *p = points + 3 * k;
    if (!isfinite(p[0]) || !isfinite(p[1]) || !isfinite(p[2])) continue;
    memmove(points + 3 * kept++, p, 3 * sizeof *p);
  }
  return (int)kept;
}

size_t ambulo__collada_points(ambulo__arena *arena, const char *path, size_t most, double **points,
                              int *count) {
  ambulo__arena own = {.allocator = arena->allocator};
  ambulo__xml xml = {.arena = &own};
  collada c = {.xml = &xml, .most = most};
  const ambulo__xml_node *root = ambulo__xml_load(&xml, path);
  c.geometries = ambulo__xml_child(root, "library_geometries");
  if (root) take_scene(&c, root);
  size_t found = c.count;
  if (found > 0 && found <= most) c.points = ambulo__arena_take(arena, 3 * found, sizeof *c.points);
  if (c.points) {
    take_scene(&c, root);
    *points = c.points;
    *count = finite_ones(c.points, c.count);
  }
  ambulo__arena_free(&own);
  return found;
}
