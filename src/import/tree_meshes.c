/* import/tree_meshes.c - the meshes of a body, coarse enough for a page (meshes.h).
 *
 * Each solid that is shown is read, thinned and forgotten before the next. Then the whole body is
 * made of cells of one size, the finest with at most MOST triangles: about 2 A / cell^2 of an area
 * A. So a hand is drawn as finely as a trunk.
 */
#include "import/meshes.h"

#include "import/body_tree.h"
#include "formats/json_text.h"

#include <math.h>
#include <string.h>

enum {
  MOST = 30000,
  FINEST = 96
}; /* triangles; cells along the longest side of a mesh, once read */
static const double farthest = 1e3; /* m: what is beyond is no part of a body */
/* of the mass that what is shown must have: less is no body, but feet for contacts, or what is left
 * where files are missing */
static const double least_mass = 0.75;

ambulo_status ambulo__meshes_path(const ambulo_allocator *allocator, const char *model,
                                  char **path) {
  static const char *const ends[] = {".yaml", ".yml"};
  size_t length = strlen(model);
  *path = NULL;
  for (int i = 0; i < 2; i++) {
    size_t end = strlen(ends[i]);
    if (length <= end || strcmp(model + length - end, ends[i]) != 0) continue;
    *path = ambulo__alloc(allocator, length + sizeof ".meshes", 1);
    if (!*path) return AMBULO_E_MEMORY;
    memcpy(*path, model, length - end);
    memcpy(*path + length - end, ".meshes", sizeof ".meshes");
    return AMBULO_OK;
  }
  return AMBULO_OK;
}

/* ------------------------------------------------------------------------ reading */

/* appends one shell to another */
static ambulo_status join(const ambulo_allocator *a, ambulo__shell *to, const ambulo__shell *more) {
  size_t points = (size_t)to->point_count, count = (size_t)to->count;
  double *all =
      ambulo__realloc(a, to->points, 3 * (points + (size_t)more->point_count) + 1, sizeof *all);
  if (!all) return AMBULO_E_MEMORY;
  to->points = all;
  int *corners =
      ambulo__realloc(a, to->corners, 3 * (count + (size_t)more->count) + 1, sizeof *corners);
  if (!corners) return AMBULO_E_MEMORY;
  to->corners = corners;
  memcpy(all + 3 * points, more->points, 3 * (size_t)more->point_count * sizeof *all);
  for (size_t i = 0; i < 3 * (size_t)more->count; i++)
    corners[3 * count + i] = more->corners[i] + to->point_count;
  to->point_count += more->point_count;
  to->count += more->count;
  return AMBULO_OK;
}

/* the points of a mesh in the link's frame; returns its longest side, 0: it cannot be shown */
static double place(const ambulo__tree_solid *solid, ambulo__mesh *mesh) {
  double low[3] = {farthest, farthest, farthest}, high[3] = {-farthest, -farthest, -farthest};
  double longest = 0.0;
  for (int k = 0; k < mesh->count; k++) {
    double *p = mesh->points + 3 * (size_t)k, scaled[3];
    for (int i = 0; i < 3; i++) scaled[i] = solid->scale[i] * p[i];
    ambulo__rigid_point(&solid->at, scaled, p);
    for (int i = 0; i < 3; i++) {
      if (!(fabs(p[i]) < farthest)) return 0.0;
      low[i] = fmin(low[i], p[i]);
      high[i] = fmax(high[i], p[i]);
    }
  }
  for (int i = 0; i < 3; i++) longest = fmax(longest, high[i] - low[i]);
  return longest;
}

/* a solid of revolution about z, or of four sides: rings of [radius, z] for half axes of 1 */
static void turn_rings(ambulo__arena *arena, const double (*ring)[2], int rings, int around,
                       const double half[3], ambulo__mesh *mesh) {
  const double pi = 3.14159265358979323846;
  mesh->count = rings * around;
  mesh->triangle_count = 2 * (rings - 1) * around;
  mesh->points = ambulo__arena_take(arena, 3 * (size_t)mesh->count, sizeof *mesh->points);
  mesh->corners = ambulo__arena_take(arena, 3 * (size_t)mesh->triangle_count, sizeof(int));
  if (!mesh->points || !mesh->corners) return;
  int *corner = mesh->corners;
  for (int i = 0; i < rings; i++)
    for (int k = 0; k < around; k++) {
      double angle = 2.0 * pi * (k + 0.5) / around, *p = mesh->points + 3 * (i * around + k);
      int a = i * around + k, b = i * around + (k + 1) % around;
      const int sides[6] = {a, b, a + around, b, b + around, a + around};
      p[0] = half[0] * ring[i][0] * cos(angle);
      p[1] = half[1] * ring[i][0] * sin(angle);
      p[2] = half[2] * ring[i][1];
      if (i + 1 == rings) continue;
      memcpy(corner, sides, sizeof sides);
      corner += 6;
    }
}

/* the surface of a simple solid */
static void build(ambulo__arena *arena, const ambulo__tree_solid *solid, ambulo__mesh *mesh) {
  enum { ARC = 6, AROUND = 20 }; /* rings of half a ball; points of a ring */
  const double edge = 1.41421356237309505, quarter = 1.57079632679489662;
  const double flat[4][2] = {{0, -1}, {1, -1}, {1, 1}, {0, 1}};
  const double square[4][2] = {{0, -1}, {edge, -1}, {edge, 1}, {0, 1}};
  const double *s = solid->size;
  double ball[2 * ARC][2], round[3] = {s[0], s[0], s[0]};
  double shift = solid->shape == AMBULO__CAPSULE ? s[1] / s[0] : 0.0;
  for (int i = 0; i < 2 * ARC; i++) {
    double angle =
        quarter * (i < ARC ? (double)i / (ARC - 1) - 1.0 : (double)(i - ARC) / (ARC - 1));
    ball[i][0] = cos(angle);
    ball[i][1] = sin(angle) + (i < ARC ? -shift : shift);
  }
  if (solid->shape == AMBULO__BOX) {
    turn_rings(arena, square, 4, 4, s, mesh);
  } else if (solid->shape == AMBULO__CYLINDER) {
    round[2] = s[1];
    turn_rings(arena, flat, 4, AROUND, round, mesh);
  } else {
    int ellipsoid = solid->shape == AMBULO__ELLIPSOID;
    turn_rings(arena, (const double(*)[2])ball, 2 * ARC, AROUND, ellipsoid ? s : round, mesh);
  }
}

static int is_mesh(const ambulo__tree_solid *solid) {
  return solid->shape == AMBULO__MESH;
}

/* reads the mesh of a solid in memory of its own, in silence: feet have said what cannot be read */
static ambulo_status add_solid(ambulo__tree *tree, const ambulo__tree_solid *solid,
                               ambulo__shell *to) {
  const ambulo_allocator *a = &tree->arena->allocator;
  ambulo__arena own = {.allocator = *a};
  ambulo__xml xml = {.arena = &own};
  ambulo__tree reader = {.arena = &own, .xml = &xml, .path = tree->path};
  ambulo__mesh mesh = {.file = solid->mesh ? solid->mesh->file : NULL, .whole = 1};
  ambulo__tree_solid placed = *solid;
  ambulo__shell thin = {.points = NULL};
  for (int i = 0; i < 3 && !is_mesh(solid); i++) placed.scale[i] = 1.0;
  if (mesh.file)
    ambulo__mesh_read(&reader, &mesh);
  else if (!is_mesh(solid))
    build(&own, solid, &mesh);
  ambulo_status status = own.failed ? AMBULO_E_MEMORY : AMBULO_OK;
  double size = !status && mesh.corners ? place(&placed, &mesh) : 0.0;
  if (size > 0.0) {
    const ambulo__shell all = {mesh.points, mesh.corners, mesh.count, mesh.triangle_count};
    status = ambulo__shell_coarsen(&all, size / FINEST, a, &thin);
    if (!status) status = join(a, to, &thin);
    ambulo__shell_free(a, &thin);
  }
  ambulo__arena_free(&own);
  return status;
}

/* What the source's own program shows, all of it where it shows nothing: but for what stands for a
 * mesh in contacts, on a link with a mesh that is only seen. skinned[links]: zeros, to work in. */
static ambulo_status read_shells(ambulo__tree *tree, int *skinned, ambulo__shell *shells) {
  ambulo_status status = AMBULO_OK;
  int some = 0;
  for (int i = 0; i < tree->solid_count; i++) {
    const ambulo__tree_solid *solid = &tree->solids[i];
    some |= !solid->hidden;
    skinned[solid->link] |= !solid->hidden && solid->seen && is_mesh(solid);
  }
  for (int i = 0; i < tree->solid_count && !status; i++) {
    const ambulo__tree_solid *solid = &tree->solids[i];
    if (!some || (!solid->hidden && (solid->seen || !skinned[solid->link])))
      status = add_solid(tree, solid, &shells[solid->link]);
  }
  return status;
}

/* share of the body's mass on links that are shown, with what is fixed to them; has[links]: to work
 * in */
static double mass_shown(const ambulo__tree *tree, const ambulo__shell *shells, int *has) {
  double shown = 0.0, whole = 0.0;
  memset(has, 0, (size_t)tree->link_count * sizeof *has);
  for (int i = 0; i < tree->link_count; i++)
    has[ambulo__tree_leader(tree, i)] |= shells[i].count > 0;
  for (int i = 0; i < tree->link_count; i++) {
    whole += tree->links[i].body.mass;
    shown += has[ambulo__tree_leader(tree, i)] ? tree->links[i].body.mass : 0.0;
  }
  return whole > 0.0 ? shown / whole : 0.0;
}

/* that meshes are missing, where some were there */
static void warn(const ambulo__tree *tree, double shown) {
  int meshes = 0;
  for (int i = 0; i < tree->solid_count; i++)
    meshes += is_mesh(&tree->solids[i]) && tree->solids[i].mesh && !tree->solids[i].hidden;
  if (!meshes) return;
  ambulo__place place = {.file = tree->path};
  ambulo__warning(tree->xml->diagnostics, place,
                  "put the files of meshes where the model names them",
                  "the page will not show meshes: those that can be read (STL, OBJ, COLLADA) show "
                  "%.0f %% of the mass, expected at least %.0f %%",
                  100.0 * shown, 100.0 * least_mass);
}

/* ----------------------------------------------------------------------- thinning */

static double area_of(const ambulo__shell *shell) {
  double area = 0.0;
  for (int t = 0; t < shell->count; t++) {
    const int *corner = shell->corners + 3 * (size_t)t;
    const double *p[3];
    double u[3], v[3], n[3];
    for (int k = 0; k < 3; k++) p[k] = shell->points + 3 * (size_t)corner[k];
    for (int i = 0; i < 3; i++) {
      u[i] = p[1][i] - p[0][i];
      v[i] = p[2][i] - p[0][i];
    }
    for (int i = 0; i < 3; i++) {
      int j = (i + 1) % 3, k = (i + 2) % 3;
      n[i] = u[j] * v[k] - u[k] * v[j];
    }
    area += 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  }
  return area;
}

/* thin[links]: the shells in cells of one size; *count: of triangles */
static ambulo_status thin_all(const ambulo__shell *shells, int links, double cell,
                              const ambulo_allocator *a, ambulo__shell *thin, int *count) {
  ambulo_status status = AMBULO_OK;
  *count = 0;
  for (int i = 0; i < links && !status; i++) {
    ambulo__shell_free(a, &thin[i]);
    if (shells[i].count) status = ambulo__shell_coarsen(&shells[i], cell, a, &thin[i]);
    *count += thin[i].count;
  }
  return status;
}

static ambulo_status thin_shells(const ambulo__shell *shells, int links, const ambulo_allocator *a,
                                 ambulo__shell *thin) {
  double area = 0.0;
  int count = 0;
  for (int i = 0; i < links; i++) {
    area += area_of(&shells[i]);
    count += shells[i].count;
  }
  double cell = count > MOST ? 0.7 * sqrt(2.0 * area / MOST) : AMBULO__MESHES_UNIT;
  ambulo_status status = thin_all(shells, links, fmax(cell, AMBULO__MESHES_UNIT), a, thin, &count);
  for (; !status && count > MOST; cell *= 1.1)
    status = thin_all(shells, links, 1.1 * cell, a, thin, &count);
  return status;
}

/* ----------------------------------------------------------------------- the text */

static void print_shell(ambulo__json *json, const char *link, const ambulo__shell *shell) {
  long last[3] = {0, 0, 0};
  int corner = 0;
  ambulo__text_buffer line;
  ambulo__text_init_part(&line, json->text);
  ambulo__json_open(json, NULL, '{');
  ambulo__json_text(json, "link", link);
  for (size_t i = 0; i < 3 * (size_t)shell->point_count; i++) {
    long now = lround(shell->points[i] / AMBULO__MESHES_UNIT);
    ambulo__text_append_format(&line, i ? " %ld" : "%ld", now - last[i % 3]);
    last[i % 3] = now;
  }
  ambulo__json_text(json, "vertices", ambulo__text_data(&line));
  ambulo__text_clear(&line);
  for (size_t i = 0; i < 3 * (size_t)shell->count; i++) {
    ambulo__text_append_format(&line, i ? " %d" : "%d", shell->corners[i] - corner);
    corner = shell->corners[i];
  }
  ambulo__json_text(json, "triangles", ambulo__text_data(&line));
  ambulo__json_close(json, '}');
  ambulo__text_free(&line);
}

static void print(const ambulo__tree *tree, const ambulo__shell *thin, ambulo__text_buffer *text) {
  ambulo__json json = {.text = text, .first = 1};
  int count = 0;
  for (int i = 0; i < tree->link_count; i++) count += thin[i].count;
  if (count == 0) return;
  ambulo__json_open(&json, NULL, '{');
  ambulo__json_text(&json, "schema", AMBULO__MESHES_SCHEMA);
  ambulo__json_open(&json, "meshes", '[');
  for (int i = 0; i < tree->link_count; i++)
    if (thin[i].count) print_shell(&json, tree->links[i].name, &thin[i]);
  ambulo__json_close(&json, ']');
  ambulo__json_close(&json, '}');
  ambulo__text_append_char(text, '\n');
}

ambulo_status ambulo__tree_meshes(ambulo__tree *tree, ambulo__text_buffer *text) {
  const ambulo_allocator *a = &tree->arena->allocator;
  size_t links = (size_t)tree->link_count;
  if (strcmp(tree->format, "OpenSim") == 0)
    return AMBULO_OK; /* its solids are for contacts alone */
  ambulo__shell *shells = ambulo__alloc(a, 2 * links, sizeof *shells);
  int *flags = ambulo__arena_take(tree->arena, links, sizeof *flags);
  if (!shells || !flags) {
    ambulo__free(a, shells);
    return AMBULO_E_MEMORY;
  }
  ambulo_status status = read_shells(tree, flags, shells);
  double shown = status ? 0.0 : mass_shown(tree, shells, flags);
  if (shown > 0.0 && shown < least_mass) warn(tree, shown);
  if (shown >= least_mass) status = thin_shells(shells, tree->link_count, a, shells + links);
  if (!status) print(tree, shells + links, text);
  for (size_t i = 0; i < 2 * links; i++) ambulo__shell_free(a, &shells[i]);
  ambulo__free(a, shells);
  return status ? status : ambulo__text_status(text);
}
