/* study/sweep.c - reading a sweep file.
 *
 * Reading order: sweep.h, sweep.c, sweep_axis.c, sweep_values.c, filter.c, sweep_cases.c,
 * sweep_chains.c, sweep_check.c, sweep_append.c, sweep_front.c, sweep_front_cases.c,
 * sweep_front_clone.c, units.h.
 */
#include "study/sweep.h"
#include "ambulo/mechanics.h"
#include "ambulo/tools/report.h"
#include "ambulo/tools/load.h"
#include "formats/paths.h"
#include "formats/read_file.h"
#include "formats/text_hash.h"
#include "study/units.h"

#include <string.h>

enum { MOST_BASE_BYTES = 16 << 20 };

static ambulo_status read_filters(ambulo_sweep *s, const ambulo__yaml_node *node) {
  int items = ambulo__yaml_items(node);
  ambulo_status status = AMBULO_OK;
  s->filter = ambulo__alloc(&s->allocator, (size_t)items, sizeof *s->filter);
  if (!s->filter) return AMBULO_E_MEMORY;
  for (int i = 0; i < items && !status; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(node, i);
    status = ambulo__sweep_copy(s, item, &s->filter[i]);
    s->filters += !status;
    if (!status && !s->filter[i][0])
      status = ambulo__yaml_error(item, AMBULO_E_SCHEMA, NULL, "no filter; expected one");
  }
  return status;
}

static ambulo_status read_axis(ambulo_sweep *s, const ambulo__yaml_node *node) {
  const ambulo__yaml_node *key = ambulo__yaml_require(node, "key");
  const char *name = ambulo__yaml_text(ambulo__yaml_get(node, "name"));
  ambulo__axis *axis = NULL;
  const char *path = ambulo__yaml_text(key);
  if (!ambulo__yaml_is(key, AMBULO__YAML_SCALAR)) return AMBULO_E_SCHEMA;
  ambulo_status status = ambulo__sweep_add_axis(s, name, path, ambulo__spot_of(key), &axis);
  if (!status) status = ambulo__sweep_read_label(s, axis, node);
  if (!status) status = ambulo__sweep_read_values(s, axis, node);
  return ambulo__sweep_close(node, status);
}

/* one group an axis, or one for all */
static ambulo_status group_axes(ambulo_sweep *s, const ambulo__yaml_node *node, int zip) {
  for (int i = 0; i < s->axes; i++) {
    if (zip && i > 0) {
      if (s->axis[i].count != s->axis[0].count)
        return ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                                  "combine: zip needs axes of one length; '%s' has %d values, "
                                  "'%s' has %d",
                                  s->axis[i].name, s->axis[i].count, s->axis[0].name,
                                  s->axis[0].count);
      s->group[0].axes++;
      continue;
    }
    ambulo__axis_group group = {i, 1, s->axis[i].count};
    s->group[s->groups++] = group;
  }
  s->zipped = zip ? s->axes : 0;
  return AMBULO_OK;
}

static ambulo_status read_axes(ambulo_sweep *s, const ambulo__yaml_node *root) {
  static const char *const ways[] = {"grid", "zip"};
  const ambulo__yaml_node *axes = ambulo__yaml_get(root, "axes");
  int zip = ambulo__yaml_choice(ambulo__yaml_get(root, "combine"), ways, 2, 0);
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < ambulo__yaml_items(axes) && !status; i++)
    status = read_axis(s, ambulo__yaml_item(axes, i));
  if (!status) status = group_axes(s, axes, zip);
  const ambulo__yaml_node *table = ambulo__yaml_get(root, "table");
  const ambulo__yaml_node *latin = ambulo__yaml_get(root, "latin_hypercube");
  const ambulo__yaml_node *random = ambulo__yaml_get(root, "random");
  if (!status && table) status = ambulo__sweep_read_table(s, table);
  if (!status && latin) status = ambulo__sweep_read_samples(s, latin, 1);
  if (!status && random) status = ambulo__sweep_read_samples(s, random, 0);
  return status;
}

static ambulo_status read_limits(ambulo_sweep *s, const ambulo__yaml_node *root) {
  const ambulo__yaml_node *limits = ambulo__yaml_get(root, "limits");
  s->case_seconds = ambulo__yaml_number_in(ambulo__yaml_get(limits, "seconds"), 0.0, 1e9, 0.0);
  s->case_megabytes = ambulo__yaml_integer(ambulo__yaml_get(limits, "megabytes"), 0, 10000000, 0);
  if (limits) ambulo__yaml_close(limits);
  return AMBULO_OK;
}

/* start_from: zero (default), or neighbour together with along: AXIS */
static ambulo_status read_chain(ambulo_sweep *s, const ambulo__yaml_node *root) {
  static const char *const starts[] = {"zero", "neighbour"};
  int start = ambulo__yaml_choice(ambulo__yaml_get(root, "start_from"), starts, 2, 0);
  s->front.neighbour = start;
  if (ambulo__yaml_get(root, "front")) start = 0; /* the next point of the front is the neighbour */
  const ambulo__yaml_node *chain =
      start ? ambulo__yaml_require(root, "along") : ambulo__yaml_get(root, "along");
  s->chain_axis = -1;
  const char *name = ambulo__yaml_text(chain);
  if (!start || !name[0]) return AMBULO_OK;
  s->chain_axis = ambulo__sweep_find_axis(s, name);
  if (s->chain_axis < 0)
    return ambulo__yaml_error(chain, AMBULO_E_SCHEMA, NULL,
                              "unknown axis (got '%s'); expected the name of an axis", name);
  return AMBULO_OK;
}

static ambulo_status hash_file(ambulo_sweep *s, const char *path, unsigned long long *hash) {
  char *text = NULL;
  size_t length = 0;
  ambulo_status status =
      ambulo__read_file(path, MOST_BASE_BYTES, &s->allocator, s->diagnostics, &text, &length);
  if (!status) *hash = ambulo__hash_text(AMBULO__HASH_START, text);
  ambulo__free(&s->allocator, text);
  return status;
}

/* the base problem is loaded once: a fault in it is told now, and its hash enters every key */
static ambulo_status load_base(ambulo_sweep *s) {
  ambulo_problem *problem = NULL;
  ambulo_status status =
      ambulo_problem_load(s->base, NULL, 0, &s->allocator, s->diagnostics, &problem);
  if (status) return status;
  ambulo_versions versions;
  ambulo_versions_get(&versions);
  s->problem_hash = ambulo_problem_hash(problem);
  for (int i = 0; i < s->outputs; i++)
    s->output[i].known_unit =
        ambulo__unit_of_output(s->output[i].path, ambulo_problem_model(problem));
  status = hash_file(s, s->base, &s->text_hash);
  /* not the instruction set: the nodes of a cluster may differ in it */
  unsigned long long hash = ambulo__hash_word(AMBULO__HASH_START, s->problem_hash);
  hash = ambulo__hash_text(hash, versions.ambulo);
  s->base_hash = ambulo__hash_text(hash, versions.nlopt);
  ambulo_problem_free(problem);
  return status;
}

static ambulo_status read_base(ambulo_sweep *s, const ambulo__yaml_node *node) {
  size_t errors = ambulo_diagnostics_error_count(s->diagnostics);
  ambulo_status status = load_base(s);
  if (!status || ambulo_diagnostics_error_count(s->diagnostics) == errors) return status;
  return ambulo__yaml_error(node, status, NULL, "the base problem '%s' could not be loaded",
                            s->base);
}

/* a fault in one key must not make strangers of those that would have been read after it */
static void expect_all(const ambulo__yaml_node *root) {
  static const char *const keys[] = {"axes",   "combine", "table",   "latin_hypercube",
                                     "random", "filters", "outputs", "start_from",
                                     "along",  "limits",  "cases",   "front"};
  for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) ambulo__yaml_expect(root, keys[i]);
}

/* the first keys, which nothing else can be read without */
static ambulo_status read_head(ambulo_sweep *s, const ambulo__yaml *document,
                               const ambulo__yaml_node *root) {
  (void)ambulo__yaml_integer(ambulo__yaml_require(root, "ambulo"), 1, 1, 1);
  const ambulo__yaml_node *name = ambulo__yaml_require(root, "name");
  ambulo_status status = ambulo__sweep_copy(s, name, &s->name);
  const ambulo__yaml_node *base = ambulo__yaml_require(root, "base");
  const char *base_name = ambulo__yaml_file_name(base);
  const ambulo__yaml_node *pattern = ambulo__yaml_get(root, "case_name");
  if (!status) status = ambulo__sweep_copy(s, pattern, &s->case_name);
  s->case_name_spot = ambulo__spot_of(pattern);
  if (s->name && !s->name[0])
    status = ambulo__yaml_error(name, AMBULO_E_SCHEMA, NULL, "the name is empty; expected a text");
  if (!status)
    status = ambulo__named_file(&s->allocator, s->path, base_name, ambulo__yaml_place(base),
                                s->diagnostics, &s->base);
  return status ? status : ambulo__yaml_finish(document);
}

ambulo_status ambulo__sweep_read(ambulo_sweep *s, const ambulo__yaml *document) {
  const ambulo__yaml_node *root = ambulo__yaml_root(document);
  static const char *const kinds[] = {"sweep"};
  if (ambulo__yaml_file_kind(root, kinds, 1) < 0) return ambulo__yaml_finish(document);
  expect_all(root);
  ambulo_status status = read_head(s, document, root);
  if (!status) status = ambulo__sweep_read_front(s, root);
  if (!status) status = read_axes(s, root);
  const ambulo__yaml_node *filters = ambulo__yaml_get(root, "filters");
  if (!status) status = ambulo__sweep_check_axes(s);
  if (!status) status = read_filters(s, filters);
  if (!status) status = ambulo__sweep_check_filters(s, filters);
  if (!status) status = ambulo__sweep_read_outputs(s, ambulo__yaml_get(root, "outputs"));
  if (!status) status = read_limits(s, root);
  if (!status) status = read_chain(s, root);
  status = ambulo__sweep_close(root, status);
  if (!status) status = ambulo__yaml_finish(document);
  if (!status) status = read_base(s, ambulo__yaml_get(root, "base"));
  if (!status)
    status = s->front.terms > 0 ? ambulo__sweep_build_front(s, ambulo__yaml_get(root, "front"))
                                : ambulo__sweep_build_cases(s, ambulo__yaml_get(root, "cases"));
  if (!status) status = ambulo__yaml_finish(document);
  return status;
}

ambulo_status ambulo_sweep_load(const char *path, const ambulo_allocator *allocator,
                                ambulo_diagnostics *diagnostics, ambulo_sweep **sweep) {
  if (!path || !sweep) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo_sweep *s = ambulo__alloc(&own, 1, sizeof *s);
  if (!s) return ambulo__conclude(diagnostics, errors, AMBULO_E_MEMORY, path);
  s->allocator = own;
  s->diagnostics = diagnostics;
  s->path = ambulo__strdup(&own, path);
  ambulo__yaml *document = NULL;
  ambulo_status status = s->path ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = ambulo__yaml_load(path, &own, diagnostics, &document);
  if (!status) status = ambulo__sweep_read(s, document);
  ambulo__yaml_free(document);
  s->diagnostics = NULL;
  if (status) {
    ambulo_sweep_free(s);
    return ambulo__conclude(diagnostics, errors, status, path);
  }
  *sweep = s;
  return AMBULO_OK;
}

ambulo_status ambulo__sweep_begin(const char *name, const char *path, const char *base,
                                  const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo_sweep **sweep) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo_sweep *s = ambulo__alloc(&own, 1, sizeof *s);
  if (!s) return AMBULO_E_MEMORY;
  s->allocator = own;
  s->diagnostics = diagnostics;
  s->chain_axis = -1;
  s->name = ambulo__strdup(&own, name);
  s->path = ambulo__strdup(&own, path);
  s->base = ambulo__strdup(&own, base);
  ambulo_status status = s->name && s->path && s->base ? load_base(s) : AMBULO_E_MEMORY;
  s->diagnostics = NULL;
  if (status) {
    ambulo_sweep_free(s);
  } else {
    *sweep = s;
  }
  return status;
}

static void free_texts(const ambulo_allocator *a, char **texts, int count) {
  for (int i = 0; texts && i < count; i++) ambulo__free(a, texts[i]);
  ambulo__free(a, texts);
}

void ambulo_sweep_free(ambulo_sweep *s) {
  if (!s) return;
  ambulo_allocator a = s->allocator;
  for (int i = 0; i < s->axes; i++) {
    for (int k = 0; k < s->axis[i].count; k++) ambulo__free(&a, s->axis[i].value[k].override);
    ambulo__free(&a, s->axis[i].value);
    ambulo__free(&a, s->axis[i].name);
    ambulo__free(&a, s->axis[i].key);
    ambulo__free(&a, s->axis[i].label);
    ambulo__free(&a, s->axis[i].unit);
  }
  for (int i = 0; i < s->case_count; i++) {
    ambulo__free(&a, (void *)s->cases[i].override);
    ambulo__free(&a, s->cases[i].id);
    ambulo__free(&a, s->cases[i].name);
  }
  free_texts(&a, s->filter, s->filters);
  for (int i = 0; s->output && i < s->outputs; i++) {
    ambulo__free(&a, s->output[i].path);
    ambulo__free(&a, s->output[i].label);
    ambulo__free(&a, s->output[i].unit);
  }
  for (int i = 0; i < AMBULO__FRONT_TERMS; i++) ambulo__free(&a, s->front.name[i]);
  ambulo__free(&a, s->output);
  ambulo__free(&a, s->cases);
  ambulo__free(&a, s->value);
  ambulo__free(&a, s->name);
  ambulo__free(&a, s->case_name);
  ambulo__free(&a, s->base);
  ambulo__free(&a, s->path);
  ambulo__free(&a, s->table);
  ambulo__free(&a, s);
}

/* ------------------------------------------------------------------ queries */

const char *ambulo_sweep_name(const ambulo_sweep *s) {
  return s->name;
}
const char *ambulo_sweep_base(const ambulo_sweep *s) {
  return s->base;
}
int ambulo_sweep_case_count(const ambulo_sweep *s) {
  return s->case_count;
}
int ambulo_sweep_front_points(const ambulo_sweep *s) {
  return s->front.terms > 0 ? s->front.points : 0;
}
int ambulo_sweep_axis_count(const ambulo_sweep *s) {
  return s->axes;
}

const char *ambulo_sweep_axis_name(const ambulo_sweep *s, int axis) {
  return axis >= 0 && axis < s->axes ? s->axis[axis].name : NULL;
}

const char *ambulo_sweep_value(const ambulo_sweep *s, int index, int axis) {
  if (index < 0 || index >= s->case_count || axis < 0 || axis >= s->axes) return "";
  int value = s->value[(size_t)index * (size_t)s->stride + (size_t)axis];
  return value < 0 ? "" : ambulo__axis_text(&s->axis[axis], value);
}

ambulo_status ambulo_sweep_case(const ambulo_sweep *s, int index, ambulo_case *one) {
  if (!s || !one || index < 0 || index >= s->case_count) return AMBULO_E_ARGUMENT;
  const ambulo__sweep_case *c = &s->cases[index];
  ambulo_case view = {c->id, c->name, c->override, c->overrides, c->previous, c->key};
  *one = view;
  return AMBULO_OK;
}
