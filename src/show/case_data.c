/* show/case_data.c - see case_data.h. */
#include "show/case_data.h"

#include <math.h>
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

/* units of scene.json, by kind */
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

/* a tree that is being taken apart; kind KINDS: no series stand here */
typedef struct parting {
  ambulo__case_data *data;
  double in_steps[KINDS]; /* how many steps a unit of the scene is */
  int series;
  int failed;
} parting;

/* ------------------------------------------------------------------ leaves */

static void leaf(parting *p, const char *text) {
  ambulo__case_data *d = p->data;
  ambulo__text_append_format(&d->form, "%d", d->leaf_count++);
  ambulo__script_value(&d->leaves, text);
  ambulo__text_append_char(&d->leaves, '\0');
}

/* ------------------------------------------------------------------ series */

static float *more(parting *p, size_t count) {
  ambulo__case_data *d = p->data;
  if (d->length + count > d->capacity) {
    size_t capacity = 2 * d->capacity + count;
    float *grown = ambulo__realloc(&d->form.allocator, d->motion, capacity, sizeof *grown);
    if (!grown) p->failed = 1;
    if (!grown) return NULL;
    d->motion = grown;
    d->capacity = capacity;
  }
  return d->motion + d->length;
}

/* 1 if the list is one of as many whole numbers as there are samples, which then are taken: the
 * first one, the step to the next, and from then on how steps change (show/scene.h) */
static int take_series(parting *p, const ambulo__yaml_node *list, quantity kind) {
  ambulo__case_data *d = p->data;
  if (kind == KINDS || d->samples == 0 || ambulo__yaml_items(list) != d->samples) return 0;
  static const long long most = 1LL << 43; /* more than show/scene.c writes */
  float *to = more(p, (size_t)d->samples);
  long long value = 0, slope = 0, number;
  for (int k = 0; k < d->samples && to; k++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(list, k);
    if (!ambulo__yaml_is(item, AMBULO__YAML_SCALAR)) return 0;
    const char *text = ambulo__yaml_text(item);
    if (!ambulo__parse_integer(text, strlen(text), -most, most, &number)) return 0;
    slope = k ? slope + number : 0;
    value = k ? value + slope : number;
    if (llabs(slope) > most || llabs(value) > most) return 0;
    to[k] = (float)((double)value * p->in_steps[kind]);
  }
  d->length += to ? (size_t)d->samples : 0;
  ambulo__text_append_format(&d->form, "%d", -1 - p->series++);
  ambulo__text_append_char(&d->kinds, letters[kind]);
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

static void tree(parting *p, const ambulo__yaml_node *value, quantity kind) {
  ambulo__text_buffer *form = &p->data->form;
  if (ambulo__yaml_is(value, AMBULO__YAML_MAPPING)) {
    ambulo__text_append_char(form, '{');
    for (int i = 0; i < ambulo__yaml_pairs(value); i++) {
      const char *key = ambulo__yaml_key(value, i);
      if (i) ambulo__text_append_char(form, ',');
      ambulo__script_text(form, key);
      ambulo__text_append_char(form, ':');
      tree(p, ambulo__yaml_value(value, i), kind_below(value, key, kind));
    }
    ambulo__text_append_char(form, '}');
  } else if (!ambulo__yaml_is(value, AMBULO__YAML_SEQUENCE)) {
    leaf(p, ambulo__yaml_text(value));
  } else if (!take_series(p, value, kind)) {
    ambulo__text_append_char(form, '[');
    for (int i = 0; i < ambulo__yaml_items(value); i++) {
      if (i) ambulo__text_append_char(form, ',');
      tree(p, ambulo__yaml_item(value, i), kind);
    }
    ambulo__text_append_char(form, ']');
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

static void summary(parting *p, const ambulo__yaml_node *map, const char **path, int length) {
  ambulo__text_buffer *form = &p->data->form;
  int written = 0;
  ambulo__text_append_char(form, '{');
  for (int i = 0; i < ambulo__yaml_pairs(map); i++) {
    const ambulo__yaml_node *value = ambulo__yaml_value(map, i);
    int whole = 0, is_map = ambulo__yaml_is(value, AMBULO__YAML_MAPPING);
    path[length] = ambulo__yaml_key(map, i);
    if (!is_kept(path, length + 1, &whole) || (!whole && !is_map)) continue;
    if (written++) ambulo__text_append_char(form, ',');
    ambulo__script_text(form, path[length]);
    ambulo__text_append_char(form, ':');
    if (whole)
      tree(p, value, KINDS);
    else
      summary(p, value, path, length + 1);
  }
  ambulo__text_append_char(form, '}');
}

/* `input_hash` and the units, in which series do not stand any more, are left out */
static void scene(parting *p, const ambulo__yaml_node *map) {
  static const char *const left[] = {"schema", "model", "input_hash", "units", "samples"};
  ambulo__text_buffer *form = &p->data->form;
  int written = 0;
  ambulo__text_append_char(form, '{');
  for (int i = 0; i < ambulo__yaml_pairs(map); i++) {
    const char *key = ambulo__yaml_key(map, i);
    int skipped = 0;
    for (size_t k = 0; k < sizeof left / sizeof left[0]; k++) skipped |= !strcmp(left[k], key);
    if (skipped) continue;
    if (written++) ambulo__text_append_char(form, ',');
    ambulo__script_text(form, key);
    ambulo__text_append_char(form, ':');
    tree(p, ambulo__yaml_value(map, i), kind_below(map, key, KINDS));
  }
  ambulo__text_append_char(form, '}');
}

/* a positive number of the scene, or one */
static double size_of(const ambulo__yaml_node *map, const char *key) {
  const ambulo__yaml_node *node = ambulo__yaml_get(map, key);
  double value = node ? ambulo__yaml_number(node, 1.0) : 1.0;
  return value > 0.0 && isfinite(value) ? value : 1.0;
}

ambulo_status ambulo__case_data_create(const ambulo__page_result *result,
                                       const ambulo_allocator *allocator, ambulo__case_data *data) {
  const ambulo__yaml_node *root = ambulo__yaml_root(result->scene.document);
  const ambulo__yaml_node *unit = ambulo__yaml_get(root, "units");
  const ambulo__yaml_node *samples = ambulo__yaml_get(root, "samples");
  double mass = size_of(root, "mass"), weight = size_of(root, "weight");
  const double sizes[KINDS] = {1.0, 1.0, mass, mass, weight};
  const char *path[DEPTH + 1];
  memset(data, 0, sizeof *data);
  ambulo__text_init(&data->form, allocator);
  ambulo__text_init(&data->leaves, allocator);
  ambulo__text_init(&data->kinds, allocator);
  data->samples = samples ? ambulo__yaml_integer(samples, 0, 1000000, 0) : 0;
  parting p = {.data = data};
  for (int k = 0; k < KINDS; k++) p.in_steps[k] = size_of(unit, units[k]) / (steps[k] * sizes[k]);
  ambulo__text_append(&data->form, "{\"summary\":");
  summary(&p, ambulo__yaml_root(result->summary.document), path, 0);
  ambulo__text_append(&data->form, ",\"scene\":");
  scene(&p, root);
  ambulo__text_append_char(&data->form, '}');
  int failed = p.failed || data->form.failed || data->leaves.failed || data->kinds.failed;
  ambulo_status status = failed ? AMBULO_E_MEMORY : ambulo__yaml_finish(result->scene.document);
  if (!status) status = ambulo__yaml_finish(result->summary.document);
  if (status) ambulo__case_data_free(data);
  return status;
}

void ambulo__case_data_free(ambulo__case_data *data) {
  ambulo__free(&data->form.allocator, data->motion);
  ambulo__text_free(&data->form);
  ambulo__text_free(&data->leaves);
  ambulo__text_free(&data->kinds);
  data->motion = NULL;
}

void ambulo__case_data_steps(ambulo__text_buffer *out, double finer) {
  for (int k = 0; k < KINDS; k++) {
    ambulo__text_append_format(out, "%s\"%c\":", k ? "," : "{", letters[k]);
    ambulo__text_append_number(out, steps[k] / finer);
  }
  ambulo__text_append_char(out, '}');
}
