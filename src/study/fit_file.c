/* study/fit_file.c - reading a fit file: parameters, distance, method (fit.h, docs/guide-fit.md).
 */
#include "formats/paths.h"
#include "formats/read_file.h"
#include "study/fit.h"

#include <math.h>
#include <string.h>

static const double least_step = 1e-6, radians_per_degree = 0.017453292519943295;

/* ----------------------------------------------------------------- parameters */

/* whether the key stands in an earlier parameter, or earlier in this one */
static int is_taken(const ambulo_fit *fit, int parameter, int before, const char *key) {
  for (int i = 0; i <= parameter; i++) {
    const ambulo__fit_parameter *p = &fit->parameter[i];
    for (int k = 0; k < (i < parameter ? p->keys : before); k++)
      if (strcmp(p->key[k], key) == 0) return 1;
  }
  return 0;
}

static ambulo_status read_keys(ambulo_fit *fit, int index, const ambulo__yaml_node *node) {
  ambulo__fit_parameter *p = &fit->parameter[index];
  int count = ambulo__fit_count(node, AMBULO__FIT_KEYS, "keys");
  p->key = ambulo__alloc(&fit->allocator, (size_t)count, sizeof *p->key);
  if (!p->key) return AMBULO_E_MEMORY;
  for (int k = 0; k < count; k++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(node, k);
    const char *key = ambulo__yaml_text(item);
    if (!key[0] || strchr(key, '='))
      (void)ambulo__yaml_error(item, AMBULO_E_SCHEMA, NULL,
                               "no key that can be set (got '%.60s'); expected a path such as "
                               "objective[0].weight",
                               key);
    else if (strncmp(key, "model.", 6) == 0)
      (void)ambulo__yaml_error(item, AMBULO_E_SCHEMA, NULL,
                               "'%.100s' is a key of the model file; expected one of the problem",
                               key);
    else if (is_taken(fit, index, k, key))
      (void)ambulo__yaml_error(item, AMBULO_E_SCHEMA, NULL,
                               "the key '%.100s' is taken already; expected each key once", key);
    p->key[p->keys++] = key;
  }
  return AMBULO_OK;
}

/* the range, and from it the bounds of u */
static void read_range(ambulo__fit_parameter *p, const ambulo__yaml_node *node) {
  int is_log = p->scale == AMBULO__FIT_LOG;
  double own = is_log ? 1.0 : 0.0;
  p->range[0] = p->range[1] = own;
  if (!node || !ambulo__yaml_numbers(node, 2, p->range)) return;
  if (!(p->range[0] < p->range[1]) || (is_log && !(p->range[0] > 0.0)))
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL, "range [%g, %g]; expected two rising %s",
                             p->range[0], p->range[1],
                             is_log ? "factors above 0" : "numbers to be added");
  else if (own < p->range[0] || own > p->range[1])
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA,
                             "ranges are of the factor or the addend on the file's own value",
                             "range [%g, %g] is without %g, where the problem stands; expected one "
                             "around it",
                             p->range[0], p->range[1], own);
  else
    for (int side = 0; side < 2; side++) {
      double bound = (is_log ? log(p->range[side]) : p->range[side]) / p->step;
      *(side ? &p->upper : &p->lower) = bound;
    }
}

static ambulo_status read_parameter(ambulo_fit *fit, int index, const ambulo__yaml_node *node) {
  static const char *const scales[] = {"log", "linear"};
  ambulo__fit_parameter *p = &fit->parameter[index];
  p->node = node;
  const ambulo__yaml_node *name = ambulo__yaml_require(node, "name");
  p->name = ambulo__yaml_name(name);
  for (int i = 0; i < index; i++)
    if (strcmp(fit->parameter[i].name, p->name) == 0)
      (void)ambulo__yaml_error(name, AMBULO_E_SCHEMA, NULL,
                               "two parameters are named '%s'; expected different names", p->name);
  p->scale = (ambulo__fit_scale)ambulo__yaml_choice(ambulo__yaml_get(node, "scale"), scales, 2, 0);
  const ambulo__yaml_node *range = ambulo__yaml_require(node, "range");
  const ambulo__yaml_node *step = p->scale == AMBULO__FIT_LOG ? ambulo__yaml_get(node, "step")
                                                              : ambulo__yaml_require(node, "step");
  p->step = ambulo__yaml_number_in(step, least_step, 1e9, 0.3);
  read_range(p, range);
  ambulo_status status = read_keys(fit, index, ambulo__yaml_require(node, "keys"));
  if (!status) ambulo__yaml_close(node);
  return status;
}

static ambulo_status read_parameters(ambulo_fit *fit, const ambulo__yaml_node *node) {
  int count = ambulo__fit_count(node, AMBULO__FIT_PARAMETERS, "parameters");
  fit->parameter = ambulo__alloc(&fit->allocator, (size_t)count, sizeof *fit->parameter);
  if (!fit->parameter) return AMBULO_E_MEMORY;
  fit->parameters = count;
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < count && !status; i++)
    status = read_parameter(fit, i, ambulo__yaml_item(node, i));
  return status;
}

/* ------------------------------------------------------------------- distance */

static void read_between(ambulo__fit_curve *c, const ambulo__yaml_node *node) {
  double between[2] = {0.0, 100.0};
  if (!ambulo__yaml_numbers(node, 2, between)) return;
  c->from = between[0];
  c->to = between[1];
  if (!(between[0] >= 0.0 && between[0] < between[1] && between[1] <= 100.0))
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "between %g and %g; expected two rising percents of the cycle, from 0 "
                             "to 100",
                             between[0], between[1]);
}

static const char *const of_names[] = {"curve", "range", "peak", "lowest", "largest"};

/* what only whole curves have */
static void expect_whole(const ambulo__fit_curve *c, const ambulo__yaml_node *node,
                         const char *key) {
  const ambulo__yaml_node *value = ambulo__yaml_get(node, key);
  if (!value || c->of == AMBULO__FIT_CURVE) return;
  (void)ambulo__yaml_error(value, AMBULO_E_SCHEMA, NULL,
                           "'%s' is of whole curves; expected it without 'of: %s'", key,
                           of_names[c->of]);
}

/* at_least, at_most: one of them makes a number of a curve a guard */
static void read_bounds(ambulo__fit_curve *c, const ambulo__yaml_node *node) {
  static const char *const keys[] = {"at_least", "at_most"};
  for (int side = 0; side < 2; side++) {
    const ambulo__yaml_node *bound = ambulo__yaml_get(node, keys[side]);
    if (!bound) continue;
    c->bound[side] = ambulo__yaml_number_in(bound, -1e9, 1e9, 0.0);
    c->is_guard = 1;
    if (c->of == AMBULO__FIT_CURVE)
      (void)ambulo__yaml_error(bound, AMBULO_E_SCHEMA, NULL,
                               "'%s' bounds a number of a curve; expected 'of: peak', 'lowest', "
                               "'largest' or 'range' with it",
                               keys[side]);
    if (side && c->bound[0] > c->bound[1])
      (void)ambulo__yaml_error(bound, AMBULO_E_SCHEMA, NULL,
                               "at_least %g and at_most %g; expected the first not above the other",
                               c->bound[0], c->bound[1]);
  }
  if (c->is_guard) (void)ambulo__yaml_require(node, "sd");
}

/* a weight alone, or a mapping */
static void read_curve(const ambulo_fit *fit, ambulo__fit_curve *c, const char *name,
                       const ambulo__yaml_node *node) {
  *c = (ambulo__fit_curve){.name = name,
                           .curve = name,
                           .weight = 1.0,
                           .correlation = fit->correlation,
                           .range_cost = fit->range_cost,
                           .to = 100.0,
                           .bound = {-(double)INFINITY, (double)INFINITY},
                           .node = node};
  if (!ambulo__yaml_is(node, AMBULO__YAML_MAPPING)) {
    c->weight = ambulo__yaml_number_in(node, 0.0, 1e6, 1.0);
    return;
  }
  const ambulo__yaml_node *curve = ambulo__yaml_get(node, "curve");
  const ambulo__yaml_node *sd = ambulo__yaml_get(node, "sd");
  if (curve) c->curve = ambulo__yaml_text(curve);
  c->of = (ambulo__fit_of)ambulo__yaml_choice(ambulo__yaml_get(node, "of"), of_names, 5, 0);
  c->weight = ambulo__yaml_number_in(ambulo__yaml_get(node, "weight"), 0.0, 1e6, 1.0);
  c->centred = ambulo__yaml_boolean(ambulo__yaml_get(node, "centred"), 0);
  c->correlation =
      ambulo__yaml_number_in(ambulo__yaml_get(node, "correlation"), 0.0, 1e6, c->correlation);
  c->range_cost = ambulo__yaml_number_in(ambulo__yaml_get(node, "range"), 0.0, 1e6, c->range_cost);
  c->sd = ambulo__yaml_number_in(sd, 0.0, 1e9, 0.0);
  if (sd && !(c->sd > 0.0))
    (void)ambulo__yaml_error(sd, AMBULO_E_SCHEMA, NULL,
                             "a deviation of %g; expected one above 0, in the unit of the curve",
                             c->sd);
  if (c->centred) expect_whole(c, node, "centred");
  expect_whole(c, node, "correlation");
  expect_whole(c, node, "range");
  read_bounds(c, node);
  read_between(c, ambulo__yaml_get(node, "between"));
  ambulo__yaml_close(node);
}

static ambulo_status read_curves(ambulo_fit *fit, const ambulo__yaml_node *curves) {
  int count = ambulo__fit_count(curves, AMBULO__FIT_CURVES, "curves");
  fit->curve = ambulo__alloc(&fit->allocator, (size_t)count, sizeof *fit->curve);
  if (!fit->curve) return AMBULO_E_MEMORY;
  double sum = 0.0;
  for (int i = 0; i < count; i++) {
    const char *name = ambulo__yaml_key(curves, i);
    ambulo__yaml_expect(curves, name);
    read_curve(fit, &fit->curve[i], name, ambulo__yaml_value(curves, i));
    sum += fit->curve[i].weight;
  }
  fit->curves = count;
  if (count > 0 && !(sum > 0.0))
    (void)ambulo__yaml_error(curves, AMBULO_E_SCHEMA, NULL,
                             "all weights are 0; expected one above 0");
  return AMBULO_OK;
}

static ambulo_status read_distance(ambulo_fit *fit, const ambulo__yaml_node *node) {
  if (!node) return AMBULO_OK;
  fit->correlation =
      ambulo__yaml_number_in(ambulo__yaml_get(node, "correlation"), 0.0, 1e6, fit->correlation);
  fit->range_cost =
      ambulo__yaml_number_in(ambulo__yaml_get(node, "range"), 0.0, 1e6, fit->range_cost);
  fit->cap = ambulo__yaml_number_in(ambulo__yaml_get(node, "cap"), 1e-3, 1e9, fit->cap);
  ambulo_status status = read_curves(fit, ambulo__yaml_require(node, "curves"));
  ambulo__yaml_close(node);
  return status;
}

/* --------------------------------------------------------------- other sections */

static void read_method(ambulo_fit *fit, const ambulo__yaml_node *node) {
  fit->iterations = 6;
  if (!node) return;
  const ambulo__yaml_node *kind = ambulo__yaml_get(node, "kind");
  const ambulo__yaml_node *former = ambulo__yaml_get(node, "evaluations");
  if (kind && strcmp(ambulo__yaml_text(kind), "gauss_newton") != 0) former = kind;
  if (former)
    (void)ambulo__yaml_error(former, AMBULO_E_SCHEMA,
                             "leave out 'kind' and 'evaluations'; 'iterations' limits the search",
                             "the methods bobyqa and sbplx are no longer offered (got '%s'); "
                             "expected gauss_newton",
                             ambulo__yaml_text(former));
  fit->iterations = ambulo__yaml_integer(ambulo__yaml_get(node, "iterations"), 0, 1000, 6);
  fit->ridge = ambulo__yaml_number_in(ambulo__yaml_get(node, "ridge"), 0.0, 1e6, fit->ridge);
  fit->tolerance =
      ambulo__yaml_number_in(ambulo__yaml_get(node, "tolerance"), 0.0, 1.0, fit->tolerance);
  ambulo__yaml_close(node);
}

static void read_limits(ambulo_fit *fit, const ambulo__yaml_node *node) {
  fit->case_seconds = 60.0;
  if (!node) return;
  fit->case_seconds =
      ambulo__yaml_number_in(ambulo__yaml_get(node, "seconds"), 1e-3, 1e9, fit->case_seconds);
  fit->case_megabytes = ambulo__yaml_integer(ambulo__yaml_get(node, "megabytes"), 1, 10000000, 0);
  ambulo__yaml_close(node);
}

/* *path: as seen from the fit file; NULL: not given */
static ambulo_status read_compare(ambulo_fit *fit, const ambulo__yaml_node *node) {
  static const char *const feet[] = {"left", "right"};
  fit->compare = ambulo_compare_options_default();
  if (!node) return AMBULO_OK;
  const ambulo__yaml_node *map = ambulo__yaml_get(node, "map"),
                          *foot = ambulo__yaml_get(node, "foot");
  const ambulo__yaml_node *tilt = ambulo__yaml_get(node, "pelvic_tilt");
  if (foot) fit->compare.foot = feet[ambulo__yaml_choice(foot, feet, 2, 0)];
  if (tilt)
    fit->compare.pelvic_tilt = radians_per_degree * ambulo__yaml_number_in(tilt, -90.0, 90.0, 0.0);
  ambulo__yaml_close(node);
  if (!map) return AMBULO_OK;
  char *path = NULL;
  ambulo_status status = ambulo__named_file(&fit->allocator, fit->path, ambulo__yaml_file_name(map),
                                            ambulo__yaml_place(map), fit->diagnostics, &path);
  fit->compare.map = path;
  return status;
}

static ambulo_status read_sections(ambulo_fit *fit) {
  const ambulo__yaml_node *root = ambulo__yaml_root(fit->document);
  static const char *const kinds[] = {"fit"};
  if (ambulo__yaml_file_kind(root, kinds, 1) < 0) return AMBULO_OK;
  (void)ambulo__yaml_integer(ambulo__yaml_require(root, "ambulo"), 1, 1, 1);
  fit->name = ambulo__yaml_name(ambulo__yaml_require(root, "name"));
  const ambulo__yaml_node *problem = ambulo__yaml_require(root, "problem");
  ambulo_status status =
      ambulo__named_file(&fit->allocator, fit->path, ambulo__yaml_file_name(problem),
                         ambulo__yaml_place(problem), fit->diagnostics, &fit->problem);
  if (!status) status = read_compare(fit, ambulo__yaml_get(root, "compare"));
  if (!status) status = read_parameters(fit, ambulo__yaml_require(root, "parameters"));
  if (!status) status = ambulo__fit_read_conditions(fit, ambulo__yaml_require(root, "conditions"));
  if (!status) status = read_distance(fit, ambulo__yaml_require(root, "distance"));
  if (status) return status;
  read_method(fit, ambulo__yaml_get(root, "method"));
  read_limits(fit, ambulo__yaml_get(root, "limits"));
  ambulo__yaml_close(root);
  return AMBULO_OK;
}

static ambulo_status hash_file(const char *path, ambulo_diagnostics *diagnostics,
                               unsigned long long *hash) {
  char digest[AMBULO__SHA256_TEXT];
  ambulo_status status = path ? ambulo__digest_file(path, diagnostics, digest) : AMBULO_OK;
  if (path && !status) *hash = ambulo__hash_text(*hash, digest);
  return status;
}

static ambulo_status hash_inputs(const ambulo_fit *fit, ambulo_diagnostics *diagnostics,
                                 unsigned long long *hash) {
  const char *const paths[] = {fit->path, fit->problem, fit->compare.map};
  ambulo_status status = AMBULO_OK;
  *hash = AMBULO__HASH_START;
  for (int i = 0; i < 3 && !status; i++) status = hash_file(paths[i], diagnostics, hash);
  for (int i = 0; i < fit->conditions && !status; i++)
    status = hash_file(fit->condition[i].reference, diagnostics, hash);
  return status;
}

/* references and problem, between two looks at the files: what is read is what is hashed */
static ambulo_status read_files(ambulo_fit *fit) {
  unsigned long long before = 0;
  ambulo__place place = {.file = fit->path};
  /* the reader reports a file that is missing */
  ambulo_status seen = hash_inputs(fit, NULL, &before);
  ambulo_status status = ambulo__fit_read_references(fit);
  if (!status) status = ambulo__yaml_finish(fit->document);
  if (!status) status = ambulo__fit_read_keys(fit);
  if (!status) status = ambulo__yaml_finish(fit->document);
  if (!status) status = hash_inputs(fit, fit->diagnostics, &fit->hash);
  if (status || (!seen && before == fit->hash)) return status;
  return ambulo__error(fit->diagnostics, AMBULO_E_IO, place, "run it again",
                       "the fit file, its problem, map or references changed while they were read; "
                       "expected the same files");
}

static ambulo_status read_all(ambulo_fit *fit) {
  ambulo_status status =
      ambulo__yaml_load(fit->path, &fit->allocator, fit->diagnostics, &fit->document);
  if (!status) status = read_sections(fit);
  if (!status) status = ambulo__yaml_finish(fit->document);
  return status ? status : read_files(fit);
}

/* ---------------------------------------------------------------- entry points */

ambulo_status ambulo_fit_load(const char *path, const ambulo_allocator *allocator,
                              ambulo_diagnostics *diagnostics, ambulo_fit **fit) {
  if (!path || !fit) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo_fit *f = ambulo__alloc(&own, 1, sizeof *f);
  if (!f) return ambulo__conclude(diagnostics, errors, AMBULO_E_MEMORY, path);
  f->allocator = own;
  f->diagnostics = diagnostics;
  ambulo__text_init(&f->known, &own);
  f->correlation = 1.2;
  f->range_cost = 0.8;
  f->cap = 12.0;
  f->ridge = 0.0025;
  f->tolerance = 0.005;
  f->path = ambulo__strdup(&own, path);
  ambulo_status status = f->path ? read_all(f) : AMBULO_E_MEMORY;
  f->diagnostics = NULL;
  if (status) {
    ambulo_fit_free(f);
  } else {
    *fit = f;
  }
  return ambulo__conclude(diagnostics, errors, status, path);
}

void ambulo_fit_free(ambulo_fit *f) {
  if (!f) return;
  ambulo_allocator a = f->allocator;
  for (int i = 0; i < f->parameters; i++) {
    ambulo__free(&a, (void *)f->parameter[i].key);
    ambulo__free(&a, f->parameter[i].own);
    ambulo__free(&a, f->parameter[i].in_file);
  }
  for (int i = 0; i < f->conditions; i++) {
    ambulo__fit_condition *c = &f->condition[i];
    for (int k = 0; k < c->sets; k++) ambulo__free(&a, c->set[k]);
    ambulo__free(&a, c->set);
    ambulo__free(&a, c->reference);
    ambulo__free(&a, c->target);
    ambulo__people_free(&c->people);
  }
  for (int i = 0; i < f->curves; i++) ambulo__free(&a, f->curve[i].percent);
  ambulo__map_free(&f->map);
  ambulo__free(&a, f->parameter);
  ambulo__free(&a, f->condition);
  ambulo__free(&a, f->curve);
  ambulo__free(&a, (void *)f->compare.map);
  ambulo__free(&a, f->path);
  ambulo__free(&a, f->problem);
  ambulo__free(&a, f->text);
  ambulo__text_free(&f->known);
  ambulo__yaml_free(f->document);
  ambulo__free(&a, f);
}
