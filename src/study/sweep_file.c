/* study/sweep_file.c - reading a sweep file (study.h). */
#include "ambulo/mechanics.h"
#include "ambulo/tools/load.h"
#include "ambulo/tools/report.h"
#include "definitions/problem_load.h"
#include "formats/paths.h"
#include "formats/read_file.h"
#include "study/study.h"

#include <stdio.h>
#include <string.h>

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

/* ------------------------------------------------------------------ outputs */

/* a text, or {output, label, unit} */
static ambulo_status read_output(ambulo_sweep *s, const ambulo__yaml_node *node,
                                 ambulo__sweep_output *output) {
  int is_mapping = ambulo__yaml_is(node, AMBULO__YAML_MAPPING);
  const ambulo__yaml_node *path = is_mapping ? ambulo__yaml_require(node, "output") : node;
  ambulo_status status = path ? ambulo__sweep_copy(s, path, &output->path) : AMBULO_E_SCHEMA;
  if (!status && !output->path[0])
    status = ambulo__yaml_error(path, AMBULO_E_SCHEMA, NULL, "no output; expected one");
  if (!is_mapping) return status;
  if (!status) status = ambulo__sweep_copy(s, ambulo__yaml_get(node, "label"), &output->label);
  if (!status) status = ambulo__sweep_copy(s, ambulo__yaml_get(node, "unit"), &output->unit);
  return ambulo__sweep_close(node, status);
}

/* whether another column of the table has this title */
static int is_taken(const ambulo_sweep *s, const char *label, int own) {
  static const char *const words[] = {"id", "name", "state", "front", "place", "better"};
  for (size_t i = 0; i < (s->front.terms > 0 ? 6 : 3); i++)
    if (strcmp(words[i], label) == 0) return 1;
  for (int i = 0; i < s->front.terms; i++)
    if (strcmp(s->front.name[i], label) == 0) return 1;
  for (int i = 0; i < s->outputs; i++) {
    const ambulo__sweep_output *other = &s->output[i];
    if (i == own) continue;
    if ((other->label && strcmp(other->label, label) == 0) || strcmp(other->path, label) == 0)
      return 1;
  }
  return ambulo__sweep_find_axis(s, label) >= 0;
}

static ambulo_status check_label(ambulo_sweep *s, const ambulo__yaml_node *node, int i) {
  const char *label = s->output[i].label;
  if (!label) return AMBULO_OK;
  const ambulo__yaml_node *at = ambulo__yaml_get(node, "label");
  if (!label[0])
    return ambulo__yaml_error(at, AMBULO_E_SCHEMA, NULL, "the label is empty; expected a text");
  if (!is_taken(s, label, i)) return AMBULO_OK;
  return ambulo__yaml_error(at, AMBULO_E_SCHEMA, NULL,
                            "the label '%s' is that of another column of the table; expected "
                            "another one",
                            label);
}

static ambulo_status read_outputs(ambulo_sweep *s, const ambulo__yaml_node *node) {
  int items = ambulo__yaml_items(node);
  ambulo_status status = AMBULO_OK;
  s->output = ambulo__alloc(&s->allocator, (size_t)items, sizeof *s->output);
  if (!s->output) return AMBULO_E_MEMORY;
  for (int i = 0; i < items && !status; i++)
    status = read_output(s, ambulo__yaml_item(node, i), &s->output[s->outputs++]);
  for (int i = 0; i < items && !status; i++) status = check_label(s, ambulo__yaml_item(node, i), i);
  return status;
}

static ambulo_status default_text(const ambulo_sweep *s, char **text, const char *usual) {
  if (!*text) *text = ambulo__strdup(&s->allocator, usual);
  return *text ? AMBULO_OK : AMBULO_E_MEMORY;
}

/* what is known of a column of motion.csv: motion files are in SI units and radians */
static const char *unit_of_column(const char *column, const ambulo_model *model) {
  static const char *const kinds[][3] = {
      {"q", "m", "rad"},       {"qd", "m/s", "rad/s"}, {"qdd", "m/s\xc2\xb2", "rad/s\xc2\xb2"},
      {"tau", "N", "N m"},     {"time", "s", "s"},     {"zmp", "m", "m"},
      {"cop", "m", "m"},       {"grf", "N", "N"},      {"free_moment", "N m", "N m"},
      {"moment", "N m", "N m"}};
  size_t length = strcspn(column, ".)");
  char name[AMBULO__SWEEP_TEXT] = "";
  if (column[length] == '.')
    (void)snprintf(name, sizeof name, "%.*s", (int)strcspn(column + length + 1, ")"),
                   column + length + 1);
  int i = ambulo_model_find_coordinate(model, name);
  int angle = i >= 0 && ambulo_model_coordinate(model, i)->type == AMBULO_REVOLUTE;
  for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
    if (strncmp(column, kinds[k][0], length) == 0 && !kinds[k][0][length] && (k > 3 || i >= 0))
      return kinds[k][angle ? 2 : 1];
  return "";
}

/* of an output, or of a key of the problem; a model has units of its own */
static const char *unit_of(const char *path, const ambulo_model *model) {
  static const char *const tails[][2] = {
      {"duration", "s"},          {"_time", "s"},           {".time", "s"},
      {"time_limit", "s"},        {"speed", "m/s"},         {"step_length", "m"},
      {"step_width", "m"},        {"stature", "m"},         {".mass", "kg"},
      {"contact_tolerance", "m"}, {"clearance", "m"},       {"clearance.height", "m"},
      {"stride_frequency", "Hz"}, {"peak", "body weights"}, {"impulse_forward", "N s"},
      {"impulse_up", "N s"},      {"impulse_left", "N s"}};
  static const char *const reductions[] = {"max(", "min(", "mean(", "range("};
  size_t length = strlen(path);
  for (size_t i = 0; i < sizeof reductions / sizeof *reductions; i++)
    if (strncmp(path, reductions[i], strlen(reductions[i])) == 0)
      return unit_of_column(path + strlen(reductions[i]), model);
  for (size_t i = 0; i < sizeof tails / sizeof *tails && strncmp(path, "model.", 6) != 0; i++) {
    size_t tail = strlen(tails[i][0]);
    if (length >= tail && strcmp(path + length - tail, tails[i][0]) == 0) return tails[i][1];
  }
  return "";
}

/* labels and units that the file leaves out */
static ambulo_status fill_titles(ambulo_sweep *s, const ambulo_model *model) {
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < s->outputs && !status; i++) {
    status = default_text(s, &s->output[i].label, s->output[i].path);
    if (!status) status = default_text(s, &s->output[i].unit, unit_of(s->output[i].path, model));
  }
  for (int i = 0; i < s->axes && !status; i++) {
    status = default_text(s, &s->axis[i].label, s->axis[i].name);
    if (!status) status = default_text(s, &s->axis[i].unit, unit_of(s->axis[i].key, model));
  }
  return status;
}

/* ------------------------------------------------------------------ the rest */

static void read_limits(ambulo_sweep *s, const ambulo__yaml_node *root) {
  const ambulo__yaml_node *limits = ambulo__yaml_get(root, "limits");
  s->case_seconds = ambulo__yaml_number_in(ambulo__yaml_get(limits, "seconds"), 0.0, 1e9, 0.0);
  s->case_megabytes = ambulo__yaml_integer(ambulo__yaml_get(limits, "megabytes"), 0, 10000000, 0);
  if (limits) ambulo__yaml_close(limits);
}

/* start_from: zero (default), or neighbour, along an axis that is named, or found */
static ambulo_status read_chain(ambulo_sweep *s, const ambulo__yaml_node *root) {
  static const char *const starts[] = {"zero", "neighbour"};
  const ambulo__yaml_node *from = ambulo__yaml_get(root, "start_from");
  int start = ambulo__yaml_choice(from, starts, 2, 0);
  s->front.neighbour = start;
  if (ambulo__yaml_get(root, "front")) start = 0; /* the next point of the front is the neighbour */
  const ambulo__yaml_node *chain = ambulo__yaml_get(root, "along");
  const char *name = ambulo__yaml_text(chain);
  if (!start || (chain && !name[0])) return AMBULO_OK;
  s->chain_axis = chain ? ambulo__sweep_find_axis(s, name) : ambulo__sweep_find_chain(s);
  if (s->chain_axis >= 0) return AMBULO_OK;
  if (!chain)
    return ambulo__yaml_error(from, AMBULO_E_SCHEMA, "'along' names the axis of the chains",
                              "no axis has numbers in order; expected one whose values only rise "
                              "or only fall");
  return ambulo__yaml_error(chain, AMBULO_E_SCHEMA, NULL,
                            "unknown axis (got '%s'); expected the name of an axis", name);
}

static unsigned long long hash_of_line(const char *line) {
  char digest[AMBULO__SHA256_TEXT] = "";
  if (line) (void)snprintf(digest, sizeof digest, "%s", line);
  return ambulo__hash_text(AMBULO__HASH_START, digest);
}

/* the base problem is loaded once: its faults are reported now, and its hash enters every key.
 * *base is to be freed, also where that fails */
static ambulo_status load_base(ambulo_sweep *s, ambulo_problem **base) {
  ambulo_problem *problem = NULL;
  ambulo_versions versions;
  ambulo_status status = ambulo__problem_load_known(s->base, NULL, 0, s->known, &s->allocator,
                                                    s->diagnostics, &problem);
  if (!status) {
    s->base_inputs = ambulo__strdup(&s->allocator, ambulo_problem_inputs(problem));
    if (!s->base_inputs) status = AMBULO_E_MEMORY;
  }
  if (!status) {
    ambulo_versions_get(&versions);
    unsigned long long hash = ambulo_problem_hash(problem);
    (void)snprintf(s->problem_hash, sizeof s->problem_hash, "%016llx", hash);
    (void)snprintf(s->text_hash, sizeof s->text_hash, "%016llx",
                   hash_of_line(ambulo__inputs_find(s->base_inputs, s->base)));
    (void)snprintf(s->version, sizeof s->version, "ambulo %s, engine %.8s, NLopt %s",
                   versions.ambulo, versions.engine, versions.nlopt);
    /* not the instruction set: the nodes of a cluster may differ in it */
    hash = ambulo__hash_word(AMBULO__HASH_START, hash);
    hash = ambulo__hash_text(hash, versions.ambulo);
    hash = ambulo__hash_text(hash, versions.engine);
    s->base_hash = ambulo__hash_text(hash, versions.nlopt);
  }
  *base = problem;
  return status;
}

static ambulo_status read_base(ambulo_sweep *s, const ambulo__yaml_node *node,
                               ambulo_problem **base) {
  size_t errors = ambulo_diagnostics_error_count(s->diagnostics);
  ambulo_status status = load_base(s, base);
  if (!status || ambulo_diagnostics_error_count(s->diagnostics) == errors) return status;
  return ambulo__yaml_error(node, status, NULL, "the base problem '%s' could not be loaded",
                            s->base);
}

/* a fault in one key must not make the keys behind it unknown */
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

static ambulo_status read_sweep(ambulo_sweep *s, const ambulo__yaml *document) {
  const ambulo__yaml_node *root = ambulo__yaml_root(document);
  static const char *const kinds[] = {"sweep"};
  if (ambulo__yaml_file_kind(root, kinds, 1) < 0) return ambulo__yaml_finish(document);
  expect_all(root);
  ambulo_status status = read_head(s, document, root);
  if (!status) status = ambulo__sweep_read_front(s, root);
  if (!status) status = ambulo__sweep_read_axes(s, root);
  const ambulo__yaml_node *filters = ambulo__yaml_get(root, "filters");
  if (!status) status = ambulo__sweep_check_axes(s);
  if (!status) status = read_filters(s, filters);
  if (!status) status = ambulo__sweep_check_filters(s, filters);
  if (!status) status = read_outputs(s, ambulo__yaml_get(root, "outputs"));
  if (!status) read_limits(s, root);
  if (!status) status = read_chain(s, root);
  status = ambulo__sweep_close(root, status);
  if (!status) status = ambulo__yaml_finish(document);
  ambulo_problem *problem = NULL;
  if (!status) status = read_base(s, ambulo__yaml_get(root, "base"), &problem);
  if (!status)
    status = s->front.terms > 0
                 ? ambulo__sweep_build_front(s, ambulo__yaml_get(root, "front"), problem)
                 : ambulo__sweep_build_cases(s, ambulo__yaml_get(root, "cases"));
  if (!status) status = ambulo__yaml_finish(document);
  if (!status) status = fill_titles(s, ambulo_problem_model(problem));
  ambulo_problem_free(problem);
  return status;
}

/* --------------------------------------------------------------- life, queries */

static ambulo_sweep *create(const char *path, const ambulo_allocator *allocator,
                            ambulo_diagnostics *diagnostics) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo_sweep *s = ambulo__alloc(&own, 1, sizeof *s);
  if (!s) return NULL;
  s->allocator = own;
  s->diagnostics = diagnostics;
  s->chain_axis = -1;
  s->path = ambulo__strdup(&own, path);
  s->known = ambulo__alloc(&own, 1, sizeof *s->known);
  if (s->known) ambulo__text_init(s->known, &own);
  if (s->path && s->known) return s;
  ambulo_sweep_free(s);
  return NULL;
}

/* *sweep takes it, as `status` says */
static ambulo_status hand_over(ambulo_sweep *s, ambulo_status status, ambulo_sweep **sweep) {
  if (status) {
    ambulo_sweep_free(s);
  } else {
    s->diagnostics = NULL;
    *sweep = s;
  }
  return status;
}

ambulo_status ambulo_sweep_load(const char *path, const ambulo_allocator *allocator,
                                ambulo_diagnostics *diagnostics, ambulo_sweep **sweep) {
  if (!path || !sweep) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_sweep *s = create(path, allocator, diagnostics);
  ambulo__yaml *document = NULL;
  ambulo_status status = s ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = ambulo__yaml_load(path, &s->allocator, diagnostics, &document);
  if (!status) status = read_sweep(s, document);
  ambulo__yaml_free(document);
  return ambulo__conclude(diagnostics, errors, hand_over(s, status, sweep), path);
}

ambulo_status ambulo__sweep_begin(const char *name, const char *path, const char *base,
                                  const char *known, const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo_sweep **sweep) {
  ambulo_sweep *s = create(path, allocator, diagnostics);
  if (!s) return AMBULO_E_MEMORY;
  ambulo__text_append(s->known, known);
  s->name = ambulo__strdup(&s->allocator, name);
  s->base = ambulo__strdup(&s->allocator, base);
  s->output = ambulo__alloc(&s->allocator, 0, sizeof *s->output);
  ambulo_problem *problem = NULL;
  int whole = s->name && s->base && s->output && !ambulo__text_status(s->known);
  ambulo_status status = whole ? load_base(s, &problem) : AMBULO_E_MEMORY;
  ambulo_problem_free(problem);
  return hand_over(s, status, sweep);
}

void ambulo_sweep_free(ambulo_sweep *s) {
  if (!s) return;
  ambulo_allocator a = s->allocator;
  ambulo__sweep_free_cases(s);
  for (int i = 0; i < s->axes; i++) {
    for (int k = 0; k < s->axis[i].count; k++) ambulo__free(&a, s->axis[i].value[k].override);
    char *const texts[] = {s->axis[i].name, s->axis[i].key, s->axis[i].label, s->axis[i].unit};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) ambulo__free(&a, texts[k]);
    ambulo__free(&a, s->axis[i].value);
  }
  for (int i = 0; s->output && i < s->outputs; i++) {
    ambulo__free(&a, s->output[i].path);
    ambulo__free(&a, s->output[i].label);
    ambulo__free(&a, s->output[i].unit);
  }
  for (int i = 0; s->filter && i < s->filters; i++) ambulo__free(&a, s->filter[i]);
  for (int i = 0; i < AMBULO__FRONT_TERMS; i++) ambulo__free(&a, s->front.name[i]);
  char *const texts[] = {s->name,  s->path, s->base,       s->case_name,
                         s->table, s->list, s->base_inputs};
  for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) ambulo__free(&a, texts[k]);
  if (s->known) ambulo__text_free(s->known);
  ambulo__free(&a, s->known);
  ambulo__free(&a, (void *)s->filter);
  ambulo__free(&a, s->output);
  ambulo__free(&a, s);
}

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
  return s->front.terms > 0 ? s->front.wanted : 0;
}
int ambulo_sweep_axis_count(const ambulo_sweep *s) {
  return s->axes;
}

const char *ambulo_sweep_axis_name(const ambulo_sweep *s, int axis) {
  return axis >= 0 && axis < s->axes ? s->axis[axis].name : NULL;
}

const char *ambulo_sweep_value(const ambulo_sweep *s, int index, int axis) {
  if (index < 0 || index >= s->case_count || axis < 0 || axis >= s->axes) return "";
  return s->cell[(size_t)index * (size_t)s->axes + (size_t)axis];
}

ambulo_status ambulo_sweep_case(const ambulo_sweep *s, int index, ambulo_case *one) {
  if (!s || !one || index < 0 || index >= s->case_count) return AMBULO_E_ARGUMENT;
  const ambulo__sweep_case *c = &s->cases[index];
  *one = (ambulo_case){c->id, c->name, c->override, c->overrides, c->previous, c->key};
  return AMBULO_OK;
}
