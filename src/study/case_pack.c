/* study/case_pack.c - see case_pack.h. */
#include "study/case_pack.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/numtext.h"
#include "show/page.h"

/* paths in summary.json; what stands below them is kept too */
enum { DEPTH = 3 };
static const char *const kept[][DEPTH] = {
    {"problem"},
    {"verdict"},
    {"ending"},
    {"strikes"},
    {"gait"},
    {"objective"},
    {"ground_reaction", "*", "peak"},
    {"work", "positive"},
    {"work", "negative"},
    {"work", "metabolic_per_kg_metre"},
    {"work", "people_per_kg_metre"},
    {"muscles", "metabolic"},
    {"center_of_mass"},
    {"audit", "fault"},
    {"audit", "violation"},
    {"audit", "active_rows"},
    {"audit", "rank"},
    {"audit", "kkt"},
    {"explanation", "lines"},
    {"explanation", "suggestion"},
    {"iterations"},
    {"evaluations"},
    {"sizes"},
    {"seconds"},
    {"starts"},
    {"free"},
};

/* units of scene.json, and steps, by kind */
typedef enum quantity { LENGTH, ANGLE, TORQUE, POWER, FORCE, KINDS } quantity;
static const char letters[] = "latpf";
static const char *const units[KINDS] = {"length", "angle", "torque", "power", "force"};
static const double steps[KINDS] = {2e-3, 3.4e-3, 1e-2, 1e-2, 2e-3};

static const struct {
  const char *key;
  quantity kind;
} series_keys[] = {
    {"points", LENGTH},        {"center_of_mass", LENGTH},
    {"pressure", LENGTH},      {"q", ANGLE},
    {"people_q", ANGLE},       {"tau", TORQUE},
    {"effort", TORQUE},        {"people_tau", TORQUE},
    {"power", POWER},          {"force", FORCE},
    {"people_up", FORCE},      {"mean", KINDS},
    {"people_forward", FORCE}, {"band", KINDS},
};

/* What a page shows of a case. */
typedef struct shown_case {
  ambulo__text_buffer tree;  /* "summary": ..., "scene": ... */
  ambulo__text_buffer kinds; /* a letter for each series */
  int samples;
  float *motion; /* [series][samples], in steps */
  size_t length, capacity;
  double in_steps[KINDS]; /* how many steps a unit of the scene is */
  int failed;
} shown_case;

/* ------------------------------------------------------------------ series */

static float *more(shown_case *c, size_t count) {
  if (c->length + count > c->capacity) {
    size_t capacity = 2 * c->capacity + count;
    float *grown = ambulo__realloc(&c->tree.allocator, c->motion, capacity, sizeof *grown);
    if (!grown) c->failed = 1;
    if (!grown) return NULL;
    c->motion = grown;
    c->capacity = capacity;
  }
  return c->motion + c->length;
}

/* 1 if the list is one of as many whole numbers as there are samples, which then are taken: the
 * first one, the step to the next, and from then on how steps change (show/scene.h) */
static int take_series(shown_case *c, const ambulo__yaml_node *list, quantity kind) {
  if (kind == KINDS || c->samples == 0 || ambulo__yaml_items(list) != c->samples) return 0;
  static const long long most = 1LL << 43; /* more than show/scene.c writes */
  float *to = more(c, (size_t)c->samples);
  long long value = 0, slope = 0, number;
  for (int k = 0; k < c->samples && to; k++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(list, k);
    if (!ambulo__yaml_is(item, AMBULO__YAML_SCALAR)) return 0;
    const char *text = ambulo__yaml_text(item);
    if (!ambulo__parse_integer(text, strlen(text), -most, most, &number)) return 0;
    slope = k ? slope + number : 0;
    value = k ? value + slope : number;
    if (llabs(slope) > most || llabs(value) > most) return 0;
    to[k] = (float)((double)value * c->in_steps[kind]);
  }
  ambulo__text_append_format(&c->tree, "{\"series\":%zu}", c->kinds.length);
  ambulo__text_append_char(&c->kinds, letters[kind]);
  c->length += to ? (size_t)c->samples : 0;
  return 1;
}

/* the kind of series that stand below `key` of `map`; `above`: of those that the map stands in */
static quantity kind_below(const ambulo__yaml_node *map, const char *key, quantity above) {
  quantity found = KINDS;
  for (size_t i = 0; i < sizeof series_keys / sizeof series_keys[0]; i++)
    if (strcmp(series_keys[i].key, key) == 0)
      found = series_keys[i].kind == KINDS ? above : series_keys[i].kind;
  const ambulo__yaml_node *unit = ambulo__yaml_get(map, "unit");
  const char *text = unit ? ambulo__yaml_text(unit) : "";
  if (found == ANGLE && strcmp(text, "m") == 0) return LENGTH;
  if (found == TORQUE && strcmp(text, "N") == 0 && strcmp(key, "effort") == 0) return FORCE;
  return found;
}

/* -------------------------------------------------------------------- trees */

static void key_of(shown_case *c, int first, const char *key) {
  if (!first) ambulo__text_append_char(&c->tree, ',');
  ambulo__script_text(&c->tree, key);
  ambulo__text_append_char(&c->tree, ':');
}

static void tree(shown_case *c, const ambulo__yaml_node *value, quantity kind) {
  if (ambulo__yaml_is(value, AMBULO__YAML_MAPPING)) {
    ambulo__text_append_char(&c->tree, '{');
    for (int i = 0; i < ambulo__yaml_pairs(value); i++) {
      const char *key = ambulo__yaml_key(value, i);
      key_of(c, i == 0, key);
      tree(c, ambulo__yaml_value(value, i), kind_below(value, key, kind));
    }
    ambulo__text_append_char(&c->tree, '}');
  } else if (!ambulo__yaml_is(value, AMBULO__YAML_SEQUENCE)) {
    ambulo__script_value(&c->tree, ambulo__yaml_text(value));
  } else if (!take_series(c, value, kind)) {
    ambulo__text_append_char(&c->tree, '[');
    for (int i = 0; i < ambulo__yaml_items(value); i++) {
      if (i) ambulo__text_append_char(&c->tree, ',');
      tree(c, ambulo__yaml_item(value, i), kind);
    }
    ambulo__text_append_char(&c->tree, ']');
  }
}

/* 1: the path [length] leads to something that is kept; *whole: and so does all below it */
static int is_kept(const char *const *path, int length, int *whole) {
  for (size_t i = 0; i < sizeof kept / sizeof kept[0]; i++) {
    int same = 1, k = 0;
    for (; k < length && k < DEPTH && kept[i][k] && same; k++)
      same = strcmp(kept[i][k], path[k]) == 0 || strcmp(kept[i][k], "*") == 0;
    if (!same) continue;
    *whole = k == DEPTH || !kept[i][k];
    return 1;
  }
  return 0;
}

static void summary(shown_case *c, const ambulo__yaml_node *map, const char **path, int length) {
  int written = 0;
  ambulo__text_append_char(&c->tree, '{');
  for (int i = 0; i < ambulo__yaml_pairs(map); i++) {
    const ambulo__yaml_node *value = ambulo__yaml_value(map, i);
    int whole = 0, is_map = ambulo__yaml_is(value, AMBULO__YAML_MAPPING);
    path[length] = ambulo__yaml_key(map, i);
    if (!is_kept(path, length + 1, &whole) || (!whole && !is_map)) continue;
    key_of(c, written++ == 0, path[length]);
    if (whole)
      tree(c, value, KINDS);
    else
      summary(c, value, path, length + 1);
  }
  ambulo__text_append_char(&c->tree, '}');
}

/* `input_hash` and the units, in which series do not stand any more, are left out; and muscles
 * and meshes, of which a page of many cases would be made */
static void scene(shown_case *c, const ambulo__yaml_node *map) {
  static const char *const left[] = {"schema",  "model",   "input_hash", "units",
                                     "samples", "muscles", "meshes"};
  int written = 0;
  ambulo__text_append_char(&c->tree, '{');
  for (int i = 0; i < ambulo__yaml_pairs(map); i++) {
    const char *key = ambulo__yaml_key(map, i);
    int skipped = 0;
    for (size_t k = 0; k < sizeof left / sizeof left[0]; k++) skipped |= !strcmp(left[k], key);
    if (skipped) continue;
    key_of(c, written++ == 0, key);
    tree(c, ambulo__yaml_value(map, i), kind_below(map, key, KINDS));
  }
  ambulo__text_append_char(&c->tree, '}');
}

/* a positive number of the scene, or one */
static double size_of(const ambulo__yaml_node *map, const char *key) {
  const ambulo__yaml_node *node = ambulo__yaml_get(map, key);
  double value = node ? ambulo__yaml_number(node, 1.0) : 1.0;
  return value > 0.0 && isfinite(value) ? value : 1.0;
}

static void free_case(shown_case *c) {
  ambulo__free(&c->tree.allocator, c->motion);
  ambulo__text_free(&c->tree);
  ambulo__text_free(&c->kinds);
}

static ambulo_status read_case(const char *folder, const ambulo_allocator *a,
                               ambulo_diagnostics *diagnostics, shown_case *c) {
  const char *path[DEPTH + 1];
  ambulo__page_result result;
  ambulo_status status = ambulo__page_result_read(folder, a, diagnostics, &result);
  if (status) return status;
  const ambulo__yaml_node *root = ambulo__yaml_root(result.scene.document);
  const ambulo__yaml_node *unit = ambulo__yaml_get(root, "units");
  const ambulo__yaml_node *samples = ambulo__yaml_get(root, "samples");
  double mass = size_of(root, "mass"), weight = size_of(root, "weight");
  const double sizes[KINDS] = {1.0, 1.0, mass, mass, weight};
  memset(c, 0, sizeof *c);
  ambulo__text_init(&c->tree, a);
  ambulo__text_init(&c->kinds, a);
  c->samples = samples ? ambulo__yaml_integer(samples, 0, 1000000, 0) : 0;
  for (int k = 0; k < KINDS; k++) c->in_steps[k] = size_of(unit, units[k]) / (steps[k] * sizes[k]);
  ambulo__text_append(&c->tree, "\"summary\":");
  summary(c, ambulo__yaml_root(result.summary.document), path, 0);
  ambulo__text_append(&c->tree, ",\"scene\":");
  scene(c, root);
  status = c->failed || c->tree.failed || c->kinds.failed
               ? AMBULO_E_MEMORY
               : ambulo__yaml_finish(result.scene.document);
  if (!status) status = ambulo__yaml_finish(result.summary.document);
  if (status) free_case(c);
  ambulo__page_result_free(&result);
  return status;
}

/* -------------------------------------------------------------------- blocks */

enum { MOST_CASES = 100, AROUND = 64 };

/* How well motions are kept: one sample in `every`, steps so many times finer. */
typedef struct quality {
  int every;
  double finer;
} quality;

/* from the best one on */
static const quality qualities[] = {{1, 4.0}, {1, 1.0}, {2, 1.0}, {4, 1.0}};
enum { QUALITIES = sizeof qualities / sizeof qualities[0] };

static int stride_of(const shown_case *c, const quality *q) {
  return (c->samples - 1) % q->every == 0 ? q->every : 1;
}

static void append_whole(ambulo__text_buffer *out, double value) {
  int64_t x = (int64_t)value;
  uint64_t bits = x < 0 ? ~((uint64_t)x * 2u) : (uint64_t)x * 2u;
  for (; bits > 127u; bits >>= 7) ambulo__text_append_char(out, (char)(bits | 128u));
  ambulo__text_append_char(out, (char)bits);
}

static void append_motion(ambulo__text_buffer *out, const shown_case *c, const shown_case *like,
                          const quality *q) {
  int stride = stride_of(c, q);
  for (size_t s = 0; s < c->length; s += (size_t)c->samples) {
    double before = 0.0;
    for (size_t k = s; k < s + (size_t)c->samples; k += (size_t)stride) {
      double value = rint(q->finer * (double)c->motion[k]);
      if (like) value -= rint(q->finer * (double)like->motion[k]);
      append_whole(out, value - before);
      before = value;
    }
  }
}

/* the first case with the same series; -1: it is this one */
static int find_like(const shown_case *cases, int i) {
  for (int k = 0; k < i; k++)
    if (cases[k].samples == cases[i].samples &&
        strcmp(ambulo__text_data(&cases[k].kinds), ambulo__text_data(&cases[i].kinds)) == 0)
      return k;
  return -1;
}

static ambulo_status append_block(ambulo__text_buffer *out, const shown_case *cases, int count,
                                  const quality *q) {
  ambulo__text_buffer head, bytes;
  ambulo__text_init_part(&head, out);
  ambulo__text_init_part(&bytes, out);
  ambulo__text_append_format(&head, "{\"every\":%d,\"steps\":", q->every);
  for (int k = 0; k < KINDS; k++) {
    ambulo__text_append_format(&head, "%s\"%c\":", k ? "," : "{", letters[k]);
    ambulo__text_append_number(&head, steps[k] / q->finer);
  }
  ambulo__text_append(&head, "},\"cases\":[");
  for (int i = 0; i < count; i++) {
    const shown_case *c = &cases[i];
    int like = find_like(cases, i),
        samples = c->samples > 0 ? (c->samples - 1) / stride_of(c, q) + 1 : 0;
    size_t before = bytes.length;
    append_motion(&bytes, c, like < 0 ? NULL : &cases[like], q);
    ambulo__text_append_format(
        &head, "%s{\"samples\":%d,\"kinds\":\"%s\",\"like\":%d,\"bytes\":%zu,", i ? "," : "",
        samples, ambulo__text_data(&c->kinds), like, bytes.length - before);
    ambulo__text_append(&head, ambulo__text_data(&c->tree));
    ambulo__text_append_char(&head, '}');
  }
  ambulo__text_append(&head, "]}");
  ambulo__text_append_char(&head, '\0');
  ambulo__text_append_bytes(&head, ambulo__text_data(&bytes), bytes.length);
  if (bytes.failed) head.failed = 1;
  ambulo__packed_text(out, ambulo__text_data(&head), head.length);
  ambulo_status status = ambulo__text_status(&head);
  ambulo__text_free(&head);
  ambulo__text_free(&bytes);
  return status ? status : ambulo__text_status(out);
}

/* as well as `room` allows; *fits: as many of its cases as there is place for */
static ambulo_status fit_block(ambulo__text_buffer *out, const shown_case *cases, int count,
                               double room, int *fits) {
  ambulo_status status = AMBULO_OK;
  int q = 0;
  for (*fits = count; *fits > 0 && !status;) {
    ambulo__text_clear(out);
    status = append_block(out, cases, *fits, &qualities[q]);
    if (status || (double)out->length <= room) break;
    double share = fmax(room, 0.0) / (double)out->length;
    if (q + 1 < QUALITIES)
      q++;
    else
      *fits = (int)fmin(*fits - 1, floor(0.98 * share * *fits));
  }
  return status;
}

ambulo_status ambulo__case_pack(ambulo__text_buffer *out, char *const *folders, int count,
                                double room, ambulo_diagnostics *diagnostics, char *packed) {
  const ambulo_allocator *a = &out->allocator;
  shown_case *cases = ambulo__alloc(a, MOST_CASES, sizeof *cases);
  ambulo__text_buffer block;
  ambulo__text_init_part(&block, out);
  ambulo_status status = cases ? AMBULO_OK : AMBULO_E_MEMORY;
  int written = 0;
  ambulo__text_append_char(out, '[');
  for (int from = 0, most; from < count && !status; from += most) {
    int read = 0, fits = 0;
    most = count - from < MOST_CASES ? count - from : MOST_CASES;
    while (read < most && !status) {
      status = read_case(folders[from + read], a, diagnostics, &cases[read]);
      read += !status;
    }
    if (!status)
      status = fit_block(&block, cases, most, room * most / (count - from) - AROUND, &fits);
    if (!status && fits > 0) {
      room -= (double)block.length + AROUND;
      ambulo__text_append_format(out, "%s{\"count\":%d,\"packed\":", written++ ? "," : "", fits);
      ambulo__text_append_bytes(out, ambulo__text_data(&block), block.length);
      ambulo__text_append_char(out, '}');
      memset(packed + from, 1, (size_t)fits);
    }
    while (read > 0) free_case(&cases[--read]);
  }
  ambulo__text_append_char(out, ']');
  ambulo__text_free(&block);
  ambulo__free(a, cases);
  return status ? status : ambulo__text_status(out);
}
