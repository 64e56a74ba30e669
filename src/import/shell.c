/* import/shell.c - fewer triangles of a mesh, by cells (meshes.h).
 *
 * Cells and triangles are found by tables with open addressing, at least twice as long as what may
 * stand in them.
 */
#include "import/meshes.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

typedef struct key {
  int64_t at[3];
} key;

typedef struct table {
  key *keys;
  int *values; /* 0: empty, else a number from 1 */
  size_t mask;
} table;

static int table_create(table *t, size_t most, const ambulo_allocator *a) {
  size_t size = 64;
  while (size < 2 * most) size *= 2;
  t->keys = ambulo__alloc(a, size, sizeof *t->keys);
  t->values = ambulo__alloc(a, size, sizeof *t->values);
  t->mask = size - 1;
  return t->keys && t->values;
}

static void table_free(table *t, const ambulo_allocator *a) {
  ambulo__free(a, t->keys);
  ambulo__free(a, t->values);
}

/* the number under a key, which becomes `next` where there is none */
static int number_of(table *t, const key *k, int next) {
  uint64_t mixed = 0;
  for (int i = 0; i < 3; i++) {
    mixed = (mixed ^ (uint64_t)k->at[i]) * 0x9e3779b97f4a7c15u;
    mixed ^= mixed >> 29;
  }
  size_t slot = (size_t)mixed & t->mask;
  while (t->values[slot] && memcmp(&t->keys[slot], k, sizeof *k) != 0) slot = (slot + 1) & t->mask;
  if (!t->values[slot]) {
    t->keys[slot] = *k;
    t->values[slot] = next + 1;
  }
  return t->values[slot] - 1;
}

/* which[point]: its cell; the points of `out` are the sums of theirs, then their means */
static void find_cells(const ambulo__shell *shell, double cell, table *cells, int *which,
                       int *members, ambulo__shell *out) {
  for (int p = 0; p < shell->point_count; p++) {
    key k;
    for (int i = 0; i < 3; i++)
      k.at[i] = (int64_t)floor(shell->points[3 * (size_t)p + (size_t)i] / cell);
    int c = which[p] = number_of(cells, &k, out->point_count);
    out->point_count += c == out->point_count;
    for (size_t i = 0; i < 3; i++)
      out->points[3 * (size_t)c + i] += shell->points[3 * (size_t)p + i];
    members[c]++;
  }
  for (int c = 0; c < out->point_count; c++)
    for (size_t i = 0; i < 3; i++) out->points[3 * (size_t)c + i] /= members[c];
}

/* the same three points, whichever way around */
static key key_of(const int *corner) {
  int a = corner[0], b = corner[1], c = corner[2], t;
  if (a > b) t = a, a = b, b = t;
  if (b > c) t = b, b = c, c = t;
  if (a > b) t = a, a = b, b = t;
  return (key){{a, b, c}};
}

static void take_triangles(const ambulo__shell *shell, const int *which, table *known,
                           ambulo__shell *out) {
  for (int t = 0; t < shell->count; t++) {
    int *corner = out->corners + 3 * (size_t)out->count;
    for (int v = 0; v < 3; v++) corner[v] = which[shell->corners[3 * (size_t)t + (size_t)v]];
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
    key k = key_of(corner);
    out->count += number_of(known, &k, out->count) == out->count;
  }
}

/* points in the order in which triangles name them, those that none names left out: differences of
 * their numbers are small */
static void sort_points(ambulo__shell *out, int *order, double *room) {
  int count = 0;
  for (int p = 0; p < out->point_count; p++) order[p] = -1;
  for (size_t i = 0; i < 3 * (size_t)out->count; i++) {
    int *corner = &out->corners[i];
    if (order[*corner] < 0) {
      memcpy(room + 3 * (size_t)count, out->points + 3 * (size_t)*corner, 3 * sizeof *room);
      order[*corner] = count++;
    }
    *corner = order[*corner];
  }
  memcpy(out->points, room, 3 * (size_t)count * sizeof *room);
  out->point_count = count;
}

void ambulo__shell_free(const ambulo_allocator *allocator, ambulo__shell *shell) {
  ambulo__free(allocator, shell->points);
  ambulo__free(allocator, shell->corners);
  *shell = (ambulo__shell){.points = NULL};
}

ambulo_status ambulo__shell_coarsen(const ambulo__shell *shell, double cell,
                                    const ambulo_allocator *a, ambulo__shell *out) {
  size_t points = (size_t)shell->point_count + 1, count = (size_t)shell->count + 1;
  ambulo__shell s = {.points = ambulo__alloc(a, 3 * points, sizeof *s.points),
                     .corners = ambulo__alloc(a, 3 * count, sizeof *s.corners)};
  int *which = ambulo__alloc(a, 2 * points, sizeof *which);
  double *room = ambulo__alloc(a, 3 * points, sizeof *room);
  table cells = {.keys = NULL}, known = {.keys = NULL};
  int good = table_create(&cells, points, a) && table_create(&known, count, a) && s.points &&
             s.corners && which && room;
  if (good) {
    find_cells(shell, cell, &cells, which, which + points, &s);
    take_triangles(shell, which, &known, &s);
    sort_points(&s, which, room);
    *out = s;
  } else {
    ambulo__shell_free(a, &s);
  }
  ambulo__free(a, which);
  ambulo__free(a, room);
  table_free(&cells, a);
  table_free(&known, a);
  return good ? AMBULO_OK : AMBULO_E_MEMORY;
}
