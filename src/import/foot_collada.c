/* import/foot_collada.c - vertices and triangles of a COLLADA file (.dae), placed as its scene
 * says (body_tree.h).
 *
 * <node>s of <visual_scene> hold <matrix>, <translate>, <rotate> and <scale>, each applied to what
 * stands after it, and <instance_geometry url="#ID">. Of that <geometry> the <float_array> counts
 * that the input POSITION of its <vertices> names. <triangles>, <polylist> and <polygons> list
 * their vertices in <p>, at the offset of the input VERTEX among as many numbers as there are
 * offsets; how many make a face is 3, what <vcount> says, and all of a <p>. Lengths are <unit
 * meter>, and what goes up by <up_axis> goes along z here.
 */
#include "import/body_tree.h"

#include "base/numtext.h"

#include <limits.h>
#include <math.h>
#include <stdint.h>
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
  int *corners; /* NULL: they are counted */
  size_t corner_count;
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

/* the next whole number of a text; 0: there is none */
static int next_number(const char **at, long *number) {
  double value;
  *at += strspn(*at, " \t\r\n");
  size_t digits = strcspn(*at, " \t\r\n");
  if (digits == 0 || !ambulo__parse_double(*at, digits, &value) || !(fabs(value) < 1e9)) return 0;
  *at += digits;
  *number = (long)value;
  return 1;
}

/* how many numbers belong to a corner, and which of them is its vertex; 0: none is */
static long stride_of(const ambulo__xml_node *faces, long *vertex) {
  long most = -1;
  *vertex = -1;
  AMBULO__XML_EACH (input, faces, "input") {
    const char *what = ambulo__xml_attribute(input, "semantic");
    const char *text = ambulo__xml_attribute(input, "offset");
    long offset;
    if (!what || !text || !next_number(&text, &offset) || offset < 0 || offset > 64) continue;
    if (offset > most) most = offset;
    if (strcmp(what, "VERTEX") == 0) *vertex = offset;
  }
  return *vertex < 0 ? 0 : most + 1;
}

/* the faces of one <p>, as fans, of vertices from `first` on; those that do not exist end it */
static void take_faces(collada *c, const char *at, const char *sizes, int is_one, long stride,
                       long vertex, size_t first) {
  long size = is_one ? LONG_MAX : 3, number;
  while (!sizes || next_number(&sizes, &size)) {
    size_t corner[3] = {0, 0, 0};
    for (long k = 0; k < size; k++) {
      size_t now = SIZE_MAX;
      for (long i = 0; i < stride; i++) {
        if (!next_number(&at, &number)) return;
        if (i == vertex && number >= 0) now = first + (size_t)number;
      }
      if (now >= c->count) return;
      corner[k < 2 ? k : 2] = now;
      if (k < 2) continue;
      for (int v = 0; v < 3 && c->corners; v++)
        c->corners[c->corner_count + (size_t)v] = (int)corner[v];
      c->corner_count += 3;
      corner[1] = now;
    }
  }
}

static void take_triangles(collada *c, const ambulo__xml_node *mesh, size_t first) {
  static const char *const kinds[] = {"triangles", "polylist", "polygons"};
  long vertex;
  for (int kind = 0; kind < 3; kind++)
    AMBULO__XML_EACH (faces, mesh, kinds[kind]) {
      const ambulo__xml_node *sizes = ambulo__xml_child(faces, "vcount");
      long stride = stride_of(faces, &vertex);
      AMBULO__XML_EACH (p, faces, "p")
        if (stride && (kind != 1 || sizes))
          take_faces(c, p->text, kind == 1 ? sizes->text : NULL, kind == 2, stride, vertex, first);
    }
}

static void take_geometry(collada *c, const char *reference, const affine *place) {
  size_t first = c->count;
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
  take_triangles(c, mesh, first);
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
  c->count = c->corner_count = 0;
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

size_t ambulo__collada_read(ambulo__arena *arena, const char *path, size_t most,
                            ambulo__mesh *mesh) {
  ambulo__arena own = {.allocator = arena->allocator};
  ambulo__xml xml = {.arena = &own};
  collada c = {.xml = &xml, .most = most};
  const ambulo__xml_node *root = ambulo__xml_load(&xml, path);
  c.geometries = ambulo__xml_child(root, "library_geometries");
  if (root) take_scene(&c, root);
  size_t found = c.count, corners = c.corner_count;
  if (found > 0 && found <= most) c.points = ambulo__arena_take(arena, 3 * found, sizeof *c.points);
  if (mesh->whole && c.points && corners > 0 && corners <= 8 * most)
    c.corners = ambulo__arena_take(arena, corners, sizeof *c.corners);
  if (c.points) {
    take_scene(&c, root);
    mesh->points = c.points;
    mesh->count = finite_ones(c.points, c.count);
  }
  /* where a point is left out, no number of one is what it was */
  if (c.corners && (size_t)mesh->count == c.count) {
    mesh->corners = c.corners;
    mesh->triangle_count = (int)(corners / 3);
  }
  ambulo__arena_free(&own);
  return found;
}
