/* show/motion_pack.c - see motion_pack.h. */
#include "show/motion_pack.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "show/principal.h"

/* numbers of components that are tried, as far as there are motions */
static const int tries[] = {0, 1, 2, 3, 4, 6, 8, 12, 16, 20, 24, 30, 36, 44, 54, 66, 80, 100, 128};
enum { TRIES = sizeof tries / sizeof tries[0] };

/* bytes a value from which on differences of the motions themselves are tried */
static const double many = 0.2;

typedef struct packing {
  const ambulo__motions *motions;
  ambulo_allocator allocator;
  size_t values;
  double *mean, *weights, *left; /* [values], [n][n], [n] */
  double **component;            /* [n]; NULL: not asked for yet */
  double *whole;                 /* M and B_k: [n + 1][values] at most */
  size_t held;                   /* of these */
  double *row, *rest;            /* [values] */
} packing;

/* ------------------------------------------------------------ whole numbers */

static void append_whole(ambulo__text_buffer *out, double value) {
  int64_t x = (int64_t)value;
  uint64_t bits = x < 0 ? ~((uint64_t)x * 2u) : (uint64_t)x * 2u;
  for (; bits > 127u; bits >>= 7) ambulo__text_append_char(out, (char)(bits | 128u));
  ambulo__text_append_char(out, (char)bits);
}

/* in place, along each series, from the last sample on */
static void differences(double *values, const ambulo__motions *m, int order) {
  int samples = (m->samples - 1) / m->every + 1;
  for (int s = 0; s < m->series; s++, values += samples)
    for (int round = 0; round < order; round++)
      for (int k = samples - 1; k > 0; k--) values[k] -= values[k - 1];
}

static void append_differences(packing *p, ambulo__text_buffer *out, const double *values,
                               int order) {
  memcpy(p->row, values, p->values * sizeof *p->row);
  differences(p->row, p->motions, order);
  for (size_t i = 0; i < p->values; i++) append_whole(out, p->row[i]);
}

static void append_rest(ambulo__text_buffer *out, const double *rest, size_t count) {
  size_t left = 0, zeros = 0;
  for (size_t i = 0; i < count; i++) left += rest[i] != 0.0;
  append_whole(out, (double)left);
  for (size_t i = 0; i < count; i++) {
    if (rest[i] == 0.0) {
      zeros++;
      continue;
    }
    append_whole(out, (double)zeros);
    append_whole(out, rest[i]);
    zeros = 0;
  }
}

/* --------------------------------------------------------------- components */

/* b_k; NULL: no memory */
static const double *component(packing *p, int k) {
  if (p->component[k]) return p->component[k];
  double *b = ambulo__alloc(&p->allocator, p->values, sizeof *b);
  int n = p->motions->count;
  for (int i = 0; i < n && b; i++) {
    double share = p->weights[(size_t)k * (size_t)n + (size_t)i] / n;
    ambulo__motion_row(p->motions, i, p->row);
    for (size_t v = 0; v < p->values; v++) b[v] += share * (p->row[v] - p->mean[v]);
  }
  return p->component[k] = b;
}

static double whole_numbers(double *to, const double *from, double times, size_t count) {
  double largest = 1.0;
  for (size_t i = 0; i < count; i++) {
    to[i] = rint(times * from[i]);
    largest = fmax(largest, fabs(to[i]));
  }
  return largest;
}

/* M, B_k in p->whole; scale[k] = e_k */
static ambulo_status round_components(packing *p, int components, double q, double *scale) {
  size_t rows = (size_t)components + 1;
  if (rows > p->held) {
    double *grown = ambulo__realloc(&p->allocator, p->whole, rows * p->values, sizeof *grown);
    if (!grown) return AMBULO_E_MEMORY;
    p->whole = grown;
    p->held = rows;
  }
  (void)whole_numbers(p->whole, p->mean, q, p->values);
  for (int k = 0; k < components; k++) {
    const double *b = component(p, k);
    if (!b) return AMBULO_E_MEMORY;
    double *to = p->whole + (size_t)(k + 1) * p->values;
    scale[k] = q / (4.0 * whole_numbers(to, b, q, p->values));
  }
  return AMBULO_OK;
}

/* ------------------------------------------------------------------ a trial */

/* r_i in p->rest */
static void remainder_of(packing *p, int i, int components, double q, const double *scale) {
  memcpy(p->rest, p->whole, p->values * sizeof *p->rest);
  for (int k = 0; k < components; k++) {
    size_t at = (size_t)k * (size_t)p->motions->count + (size_t)i;
    double weight = rint(p->weights[at] / scale[k]) * scale[k];
    const double *b = p->whole + (size_t)(k + 1) * p->values;
    for (size_t v = 0; v < p->values; v++) p->rest[v] += weight * b[v];
  }
  ambulo__motion_row(p->motions, i, p->row);
  for (size_t v = 0; v < p->values; v++) p->rest[v] = rint(p->row[v] - p->rest[v] / q);
}

/* *head: how many bytes stand before the motions' rests */
static ambulo_status append_packed(packing *p, ambulo__text_buffer *out, int components, int order,
                                   size_t *head) {
  int n = p->motions->count;
  double q = 2.0 * ceil(sqrt(components + 1.0));
  double *scale = ambulo__alloc(&p->allocator, (size_t)components, sizeof *scale);
  ambulo_status status = scale ? round_components(p, components, q, scale) : AMBULO_E_MEMORY;
  if (!status) {
    append_whole(out, components);
    append_whole(out, order);
    for (int k = 0; k <= components; k++)
      append_differences(p, out, p->whole + (size_t)k * p->values, k ? 1 : 2);
    for (int k = 0; k < components; k++)
      for (int i = 0; i < n; i++)
        append_whole(out, rint(p->weights[(size_t)k * (size_t)n + (size_t)i] / scale[k]));
    *head = out->length;
    for (int i = 0; i < n && !out->failed; i++) {
      remainder_of(p, i, components, q, scale);
      differences(p->rest, p->motions, order);
      append_rest(out, p->rest, p->values);
    }
  }
  ambulo__free(&p->allocator, scale);
  return status ? status : ambulo__text_status(out);
}

/* what so many bytes take at least, where each is coded by how often it comes (Shannon); matches
 * that a compressor finds go beyond it, alike in all trials */
static double entropy(const char *bytes, size_t length) {
  size_t often[256] = {0};
  double size = 0.0;
  for (size_t i = 0; i < length; i++) often[(unsigned char)bytes[i]]++;
  for (int b = 0; b < 256; b++)
    if (often[b]) size -= (double)often[b] * log2((double)often[b] / (double)length) / 8.0;
  return size;
}

/* *best takes the trial if it is shorter; *size: its length */
static ambulo_status try_one(packing *p, int components, int order, ambulo__text_buffer *best,
                             double *size) {
  ambulo__text_buffer trial;
  size_t head = 0;
  ambulo__text_init(&trial, &p->allocator);
  ambulo_status status = append_packed(p, &trial, components, order, &head);
  if (!status) {
    const char *bytes = ambulo__text_data(&trial);
    double length = entropy(bytes, head) + entropy(bytes + head, trial.length - head);
    if (best->length == 0 || length < *size) {
      ambulo__text_buffer before = *best;
      *size = length;
      *best = trial;
      trial = before;
    }
  }
  ambulo__text_free(&trial);
  return status;
}

/* upwards from as many components as leave less than a step, until more of them take more */
static ambulo_status try_all(packing *p, ambulo__text_buffer *best) {
  int n = p->motions->count, from = 0;
  while (from + 1 < TRIES && tries[from + 1] < n && p->left[tries[from]] > 1.0) from++;
  double size = 0.0, before = -1.0;
  ambulo_status status = AMBULO_OK;
  for (int t = from; t < TRIES && (t == from || tries[t] < n) && !status && size != before; t++) {
    before = size;
    status = try_one(p, tries[t], 0, best, &size);
  }
  if (!status && n > 1 && size > many * (double)n * (double)p->values)
    status = try_one(p, 0, 2, best, &size);
  return status;
}

static ambulo_status prepare(packing *p) {
  size_t n = (size_t)p->motions->count;
  p->mean = ambulo__alloc(&p->allocator, p->values, sizeof *p->mean);
  p->row = ambulo__alloc(&p->allocator, p->values, sizeof *p->row);
  p->rest = ambulo__alloc(&p->allocator, p->values, sizeof *p->rest);
  p->weights = ambulo__alloc(&p->allocator, n * n, sizeof *p->weights);
  p->left = ambulo__alloc(&p->allocator, n, sizeof *p->left);
  p->component = ambulo__alloc(&p->allocator, n, sizeof *p->component);
  if (!p->mean || !p->row || !p->rest || !p->weights || !p->left || !p->component)
    return AMBULO_E_MEMORY;
  for (int i = 0; i < p->motions->count; i++) {
    ambulo__motion_row(p->motions, i, p->row);
    for (size_t v = 0; v < p->values; v++) p->mean[v] += p->row[v] / (double)n;
  }
  return ambulo__principal_weights(p->motions, p->mean, &p->allocator, p->weights, p->left);
}

ambulo_status ambulo__motion_pack(ambulo__text_buffer *out, const ambulo__motions *motions) {
  packing p = {
      .motions = motions, .allocator = out->allocator, .values = ambulo__motion_values(motions)};
  ambulo__text_buffer best;
  ambulo__text_init(&best, &out->allocator);
  ambulo_status status = prepare(&p);
  if (!status) status = try_all(&p, &best);
  if (!status) ambulo__text_append_bytes(out, ambulo__text_data(&best), best.length);
  ambulo__text_free(&best);
  for (int k = 0; k < motions->count && p.component; k++)
    ambulo__free(&p.allocator, p.component[k]);
  ambulo__free(&p.allocator, (void *)p.component);
  double *const blocks[] = {p.mean, p.row, p.rest, p.weights, p.left, p.whole};
  for (size_t i = 0; i < sizeof blocks / sizeof blocks[0]; i++)
    ambulo__free(&p.allocator, blocks[i]);
  return status ? status : ambulo__text_status(out);
}
