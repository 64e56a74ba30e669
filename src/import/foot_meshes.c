/* import/foot_meshes.c - vertices and triangles of meshes, as far as feet and the page ask for
 * them (body_tree.h). */
#include "import/body_tree.h"

#include "base/numtext.h"
#include "formats/paths.h"
#include "formats/read_file.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

/*
 *   STL, binary   80 bytes, the number n of triangles, n times 12 floats (the normal, three
 *                 vertices) and 2 bytes; all little-endian
 *   STL, text     "vertex X Y Z"
 *   OBJ           "v X Y Z"; "f A B C ...", vertices from 1, or back from the last: -1, each with
 *                 "/..." behind it
 *   COLLADA       foot_collada.c
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

/* ------------------------------------------------------------------- triangles */

/* those of STL, three vertices each, one after the other */
static void three_by_three(ambulo__arena *arena, ambulo__mesh *mesh, size_t count) {
  mesh->corners = ambulo__arena_take(arena, count, sizeof *mesh->corners);
  if (!mesh->corners) return;
  for (size_t i = 0; i < count; i++) mesh->corners[i] = (int)i;
  mesh->triangle_count = (int)(count / 3);
}

static int is_word(const char *line, char word) {
  return line[0] == word && (line[1] == ' ' || line[1] == '\t');
}

/* vertices of a face, of `known` before it; returns how many */
static int read_face(const char *line, int known, int most, int *corner) {
  int count = 0;
  for (line++; count < most; line += strcspn(line, " \t\r\n")) {
    double number;
    line += strspn(line, " \t");
    if (!ambulo__parse_double(line, strcspn(line, "/ \t\r\n"), &number) || fabs(number) > 1e9)
      return count;
    corner[count++] = number < 0.0 ? known + (int)number : (int)number - 1;
  }
  return count;
}

/* those of OBJ, faces as fans; counts them, where there is no room for them yet */
static int read_faces(ambulo__mesh *mesh, const char *text) {
  enum { MOST = 64 }; /* corners of a face */
  int count = 0, known = 0, corner[MOST];
  for (const char *line = text; line; line = strchr(line, '\n')) {
    line += *line == '\n';
    line += strspn(line, " \t");
    known += is_word(line, 'v');
    if (!is_word(line, 'f')) continue;
    int corners = read_face(line, known, MOST, corner), good = 1;
    for (int k = 0; k < corners; k++) good &= corner[k] >= 0 && corner[k] < mesh->count;
    for (int k = 2; k < corners && good; k++, count++) {
      const int triangle[3] = {corner[0], corner[k - 1], corner[k]};
      if (mesh->corners) memcpy(mesh->corners + 3 * (size_t)count, triangle, sizeof triangle);
    }
  }
  return count;
}

/* a vertex that is no number was left out: then no number of a vertex is what it was */
static void read_triangles(ambulo__arena *arena, ambulo__mesh *mesh, const char *text, int is_stl,
                           size_t count) {
  if (!mesh->whole || (size_t)mesh->count != count) return;
  if (is_stl) {
    if (count % 3 == 0) three_by_three(arena, mesh, count);
    return;
  }
  int triangles = read_faces(mesh, text);
  if (triangles == 0) return;
  mesh->corners = ambulo__arena_take(arena, 3 * (size_t)triangles, sizeof *mesh->corners);
  if (mesh->corners) mesh->triangle_count = read_faces(mesh, text);
}

/* ------------------------------------------------------------------------- files */

static int is_too_much(ambulo__tree *tree, const ambulo__mesh *mesh, size_t count) {
  if (count <= most_points - tree->mesh_points) return 0;
  ambulo__tree_note(tree, NULL,
                    "mesh '%.80s' is left out: the meshes of feet have more than %zu vertices",
                    mesh->file, most_points);
  return 1;
}

static void read_text(ambulo__tree *tree, ambulo__mesh *mesh, const char *text, size_t length) {
  uint32_t triangles = length >= HEAD ? little_endian(text + 80) : 0;
  int binary = length >= HEAD && length == HEAD + TRIANGLE * (size_t)triangles;
  const char *word = strncmp(text, "solid", 5) == 0 ? "vertex" : "v";
  size_t count = binary ? 3 * (size_t)triangles : (size_t)read_lines(mesh, text, word);
  if (count == 0 || is_too_much(tree, mesh, count)) return;
  mesh->points = ambulo__arena_take(tree->arena, 3 * count, sizeof *mesh->points);
  if (!mesh->points) return;
  tree->mesh_points += count;
  if (binary)
    read_binary(mesh, text, triangles);
  else
    (void)read_lines(mesh, text, word);
  read_triangles(tree->arena, mesh, text, binary || word[1], count);
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

static int is_collada(const char *path) {
  size_t length = path ? strlen(path) : 0;
  return length > 4 && strcasecmp(path + length - 4, ".dae") == 0;
}

void ambulo__mesh_read(ambulo__tree *tree, ambulo__mesh *mesh) {
  const ambulo_allocator *a = &tree->arena->allocator;
  char *text = NULL;
  size_t length = 0;
  if (mesh->tried) return;
  mesh->tried = 1;
  char *path = find(a, tree->path, mesh->file);
  if (is_collada(path)) {
    size_t count = ambulo__collada_read(tree->arena, path, most_points - tree->mesh_points, mesh);
    if (!is_too_much(tree, mesh, count)) tree->mesh_points += count;
    ambulo__free(a, path);
    return;
  }
  ambulo_status status =
      path ? ambulo__read_file(path, most_bytes, a, NULL, &text, &length) : AMBULO_E_IO;
  if (!status) read_text(tree, mesh, text, length);
  if (status == AMBULO_E_LIMIT)
    ambulo__tree_note(tree, NULL, "mesh '%.80s' is left out: it has more than %zu MB", mesh->file,
                      most_bytes >> 20);
  ambulo__free(a, text);
  ambulo__free(a, path);
}
