/* exchange/foot_solids.c - the lowest points of solids (body_tree.h).
 *
 * The lowest point of an ellipsoid with half axes S in axes R is c - R S^2 R' u / |S R' u|; a
 * sphere is one, a capsule two spheres. Of cylinders the eight points of the rims along their own x
 * and y are taken, of boxes the corners, of meshes all vertices, where a foot has no other solids.
 */
#include "exchange/body_tree.h"

#include "base/numtext.h"
#include "base/arithmetic.h"
#include "formats/paths.h"
#include "formats/read_file.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* ----------------------------------------------------------------------- meshes */

/*
 *   STL, binary   80 bytes, the number n of triangles, n times 12 floats (the normal, three
 *                 vertices) and 2 bytes; all little-endian
 *   STL, text     "vertex X Y Z"
 *   OBJ           "v X Y Z"
 */

enum { HEAD = 84, TRIANGLE = 50, ABOVE = 6 };
/* a file; vertices of all meshes of feet together, which is more than any one file has */
static const size_t most_bytes = (size_t)64 << 20, most_points = (size_t)4 << 20;

static uint32_t little_endian(const char *at) {
  uint32_t value = 0;
  for (int i = 3; i >= 0; i--) value = value << 8 | (unsigned char)at[i];
  return value;
}

static double float_at(const char *at) {
  uint32_t bits = little_endian(at);
  float value;
  memcpy(&value, &bits, sizeof value);
  return (double)value;
}

static void add(ambulo__mesh *mesh, const double p[3]) {
  if (!isfinite(p[0]) || !isfinite(p[1]) || !isfinite(p[2])) return;
  for (int i = 0; i < 3; i++) mesh->points[3 * mesh->count + i] = p[i];
  mesh->count++;
}

static void read_binary(ambulo__mesh *mesh, const char *text, size_t triangles) {
  for (size_t t = 0; t < triangles; t++)
    for (size_t v = 1; v < 4; v++) {
      const char *at = text + HEAD + TRIANGLE * t + 12 * v;
      const double p[3] = {float_at(at), float_at(at + 4), float_at(at + 8)};
      add(mesh, p);
    }
}

/* the three numbers behind `word` at the beginning of a line; 0 where it has another */
static int read_line(const char *line, const char *word, double p[3]) {
  size_t length = strlen(word);
  line += strspn(line, " \t");
  if (strncmp(line, word, length) != 0 || !strchr(" \t", line[length]) || !line[length]) return 0;
  line += length;
  for (int i = 0; i < 3; i++) {
    line += strspn(line, " \t");
    size_t digits = strcspn(line, " \t\r\n");
    if (!ambulo__parse_double(line, digits, &p[i])) return 0;
    line += digits;
  }
  return 1;
}

/* counts them, where there is no room for them yet */
static int read_lines(ambulo__mesh *mesh, const char *text, const char *word) {
  int count = 0;
  for (const char *line = text; line; line = strchr(line, '\n')) {
    double p[3];
    line += *line == '\n';
    if (!read_line(line, word, p)) continue;
    count++;
    if (mesh->points) add(mesh, p);
  }
  return count;
}

static void read_text(ambulo__tree *tree, ambulo__mesh *mesh, const char *text, size_t length) {
  uint32_t triangles = length >= HEAD ? little_endian(text + 80) : 0;
  int binary = length >= HEAD && length == HEAD + TRIANGLE * (size_t)triangles;
  const char *word = strncmp(text, "solid", 5) == 0 ? "vertex" : "v";
  size_t count = binary ? 3 * (size_t)triangles : (size_t)read_lines(mesh, text, word);
  if (count == 0) return;
  if (count > most_points - tree->mesh_points) {
    ambulo__tree_note(tree, NULL,
                      "mesh '%.80s' is left out: the meshes of feet have more than %zu vertices",
                      mesh->file, most_points);
    return;
  }
  mesh->points = ambulo__arena_take(tree->arena, 3 * count, sizeof *mesh->points);
  if (!mesh->points) return;
  tree->mesh_points += count;
  if (binary)
    read_binary(mesh, text, triangles);
  else
    (void)read_lines(mesh, text, word);
}

static int is_there(const char *path) {
  struct stat about;
  return path && stat(path, &about) == 0 && S_ISREG(about.st_mode);
}

/* beside the model, and with `above` also in the folders above; to be freed, NULL: not there */
static char *beside(const ambulo_allocator *allocator, const char *model, const char *file,
                    int above) {
  char name[1024];
  for (int up = 0; up <= above; up++) {
    int length = 0;
    for (int k = 0; k < up; k++)
      length += snprintf(name + length, sizeof name - (size_t)length, "../");
    int all = snprintf(name + length, sizeof name - (size_t)length, "%s", file);
    if (all < 0 || (size_t)(length + all) >= sizeof name) return NULL;
    char *path = ambulo__sibling_path(allocator, model, name);
    if (is_there(path)) return path;
    ambulo__free(allocator, path);
  }
  return NULL;
}

static char *find(const ambulo_allocator *allocator, const char *model, const char *file) {
  static const char *const schemes[] = {"package://", "model://", "file://"};
  int in_package = 0;
  for (int i = 0; i < 3; i++) {
    size_t length = strlen(schemes[i]);
    if (strncmp(file, schemes[i], length) != 0) continue;
    file += length;
    in_package = i < 2;
    break;
  }
  char *path = beside(allocator, model, file, in_package ? ABOVE : 0);
  const char *inner = in_package ? strchr(file, '/') : NULL;
  if (!path && inner) path = beside(allocator, model, inner + 1, ABOVE);
  return path;
}

void ambulo__tree_mesh(ambulo__tree *tree, const char *file, ambulo__tree_solid *solid) {
  if (!tree->path || !file || !file[0]) return;
  for (int i = 0; i < 3; i++) solid->scale[i] = 1.0;
  for (int i = 0; i < tree->mesh_count && !solid->mesh; i++)
    if (strcmp(tree->meshes[i]->file, file) == 0) solid->mesh = tree->meshes[i];
  if (solid->mesh || !ambulo__arena_grow(tree->arena, &tree->meshes, tree->mesh_count,
                                         &tree->mesh_capacity, sizeof(ambulo__mesh *)))
    return;
  solid->mesh = ambulo__arena_take(tree->arena, 1, sizeof *solid->mesh);
  if (!solid->mesh) return;
  solid->mesh->file = file;
  tree->meshes[tree->mesh_count++] = solid->mesh;
}

static void read_mesh(ambulo__tree *tree, ambulo__mesh *mesh) {
  const ambulo_allocator *a = &tree->arena->allocator;
  char *text = NULL;
  size_t length = 0;
  if (mesh->tried) return;
  mesh->tried = 1;
  char *path = find(a, tree->path, mesh->file);
  ambulo_status status =
      path ? ambulo__read_file(path, most_bytes, a, NULL, &text, &length) : AMBULO_E_IO;
  if (!status) read_text(tree, mesh, text, length);
  if (status == AMBULO_E_LIMIT)
    ambulo__tree_note(tree, NULL, "mesh '%.80s' is left out: it has more than %zu MB", mesh->file,
                      most_bytes >> 20);
  ambulo__free(a, text);
  ambulo__free(a, path);
}

/* ------------------------------------------------------------------------ soles */

enum { MOST = 8 };
static const double thickness = 0.02; /* m: a sole that is not quite level is still one */
static const double shortest = 0.05;  /* m: below it toes of their own belong to the foot */

char ambulo__side_of_link(const ambulo__tree *tree, int link) {
  const char *name = tree->links[link].name;
  char other[80], side = ambulo__side_of(name);
  if (side || !ambulo__flip_letter(name, 0, other, sizeof other)) return side;
  return ambulo__tree_find(tree, other) >= 0 ? name[0] : 0;
}

static int rigid_leader(const ambulo__tree *tree, int link) {
  while (tree->links[link].type == AMBULO_FIXED && tree->links[link].parent >= 0)
    link = tree->links[link].parent;
  return link;
}

/* points[MOST] in the axes of the solid; how many */
static int points_of(const ambulo__tree_solid *s, const double down[3], double p[MOST][3]) {
  static const double ends[2] = {-1.0, 1.0};
  const double *z = s->size;
  double size[3] = {z[0], s->shape == AMBULO__ELLIPSOID ? z[1] : z[0],
                    s->shape == AMBULO__ELLIPSOID ? z[2] : z[0]};
  memset(p, 0, MOST * sizeof *p);
  if (s->shape == AMBULO__BOX) {
    for (int k = 0; k < 8; k++)
      for (int i = 0; i < 3; i++) p[k][i] = k >> i & 1 ? z[i] : -z[i];
    return 8;
  }
  if (s->shape == AMBULO__CYLINDER) {
    for (int k = 0; k < 8; k++) {
      p[k][k >> 1 & 1] = ends[k & 1] * z[0];
      p[k][2] = ends[k >> 2 & 1] * z[1];
    }
    return 8;
  }
  double length = 0.0;
  for (int i = 0; i < 3; i++) length += size[i] * size[i] * down[i] * down[i];
  length = sqrt(length);
  int count = s->shape == AMBULO__CAPSULE ? 2 : 1;
  for (int k = 0; k < count; k++) {
    for (int i = 0; i < 3; i++) p[k][i] = length > 0.0 ? size[i] * size[i] * down[i] / length : 0.0;
    if (count == 2) p[k][2] += ends[k] * z[1];
  }
  return count;
}

/* in world axes (forward, left, up) */
static int world_points(ambulo__tree *tree, const ambulo__tree_solid *s, const double axes[3][3],
                        double out[MOST][3]) {
  double p[MOST][3], down[3], local[3], world[3];
  ambulo__rigid link = ambulo__tree_place(tree, s->link);
  ambulo__rigid place = ambulo__rigid_times(&link, &s->at);
  for (int i = 0; i < 3; i++) down[i] = -axes[2][i];
  ambulo__rigid_back(&place, down, local);
  int count = points_of(s, local, p);
  for (int k = 0; k < count; k++) {
    ambulo__rigid_point(&place, p[k], world);
    for (int i = 0; i < 3; i++) out[k][i] = ambulo__dot(axes[i], world);
  }
  return count;
}

static int hangs_on(const ambulo__tree *tree, int link, int above) {
  while (link >= 0 && link != above) link = tree->links[link].parent;
  return link == above;
}

/* one of `whole`: of the link and all below it, else of what is fixed to it */
static int belongs(const ambulo__tree *tree, int solid, int leader, int whole) {
  int link = tree->solids[solid].link;
  return whole ? hangs_on(tree, link, leader) : rigid_leader(tree, link) == leader;
}

/* which solids of a foot count */
typedef struct choice {
  int leader, whole, meshes;
} choice;

static void widen(ambulo__sole *sole, int pass, const double p[3]) {
  if (pass == 0) sole->height = fmin(sole->height, p[2]);
  if (pass == 0 || p[2] > sole->height + thickness) return;
  sole->along[0] = fmin(sole->along[0], p[0]);
  sole->along[1] = fmax(sole->along[1], p[0]);
  sole->across[0] = fmin(sole->across[0], p[1]);
  sole->across[1] = fmax(sole->across[1], p[1]);
}

static void widen_by_mesh(ambulo__tree *tree, const ambulo__tree_solid *s, const double axes[3][3],
                          int pass, ambulo__sole *sole) {
  if (!s->mesh) return;
  read_mesh(tree, s->mesh);
  ambulo__rigid link = ambulo__tree_place(tree, s->link);
  ambulo__rigid place = ambulo__rigid_times(&link, &s->at);
  for (int k = 0; k < s->mesh->count; k++) {
    double own[3], world[3], p[3];
    for (int i = 0; i < 3; i++) own[i] = s->scale[i] * s->mesh->points[3 * k + i];
    ambulo__rigid_point(&place, own, world);
    for (int i = 0; i < 3; i++) p[i] = ambulo__dot(axes[i], world);
    widen(sole, pass, p);
  }
}

static int measure(ambulo__tree *tree, choice of, const double axes[3][3], ambulo__sole *sole) {
  double p[MOST][3];
  *sole = (ambulo__sole){
      .along = {INFINITY, -INFINITY}, .across = {INFINITY, -INFINITY}, .height = INFINITY};
  for (int pass = 0; pass < 2; pass++) {
    for (int s = 0; s < tree->solid_count; s++) {
      if (!belongs(tree, s, of.leader, of.whole)) continue;
      if (tree->solids[s].shape == AMBULO__MESH) {
        sole->meshes += pass;
        if (of.meshes) widen_by_mesh(tree, &tree->solids[s], axes, pass, sole);
        continue;
      }
      sole->solids += pass;
      int count = world_points(tree, &tree->solids[s], axes, p);
      for (int k = 0; k < count; k++) widen(sole, pass, p[k]);
    }
  }
  return isfinite(sole->height);
}

/* from solids that are no meshes: toes of their own may belong to it */
static int sole_of_solids(ambulo__tree *tree, int leader, const double axes[3][3],
                          ambulo__sole *sole) {
  int found = measure(tree, (choice){leader, 0, 0}, axes, sole);
  if (!found || sole->along[1] - sole->along[0] >= shortest) return found;
  ambulo__sole whole;
  if (measure(tree, (choice){leader, 1, 0}, axes, &whole) &&
      whole.along[1] - whole.along[0] >= shortest)
    *sole = whole;
  return sole->along[1] - sole->along[0] >= 1e-3;
}

static int sole_of_meshes(ambulo__tree *tree, int leader, const double axes[3][3],
                          ambulo__sole *sole) {
  return measure(tree, (choice){leader, 0, 1}, axes, sole) &&
         sole->along[1] - sole->along[0] >= 1e-3;
}

int ambulo__sole_of(ambulo__tree *tree, int link, const double axes[3][3], ambulo__sole *sole) {
  int leader = rigid_leader(tree, link);
  if (sole_of_solids(tree, leader, axes, sole)) return 1;
  return sole->solids == 0 && sole->meshes > 0 && sole_of_meshes(tree, leader, axes, sole);
}

int ambulo__lowest_link(ambulo__tree *tree, const double axes[3][3], char side) {
  int lowest = -1;
  double height = INFINITY;
  int *seen = ambulo__arena_take(tree->arena, (size_t)tree->link_count + 1, sizeof *seen);
  for (int meshes = 0; seen && meshes < 2 && lowest < 0; meshes++) {
    for (int s = 0; s < tree->solid_count; s++) {
      ambulo__sole sole;
      int leader = rigid_leader(tree, tree->solids[s].link);
      if (seen[leader] > meshes) continue; /* its other solids were measured with it */
      seen[leader] = meshes + 1;
      if (ambulo__side_of_link(tree, leader) != side) continue;
      int found = meshes ? sole_of_meshes(tree, leader, axes, &sole)
                         : sole_of_solids(tree, leader, axes, &sole);
      if (!found || !(sole.height < height)) continue;
      height = sole.height;
      lowest = leader;
    }
  }
  return lowest;
}
