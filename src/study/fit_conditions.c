/* study/fit_conditions.c - `conditions:` of a fit file, and their references and the guards as
 * targets (fit.h). */
#include "formats/paths.h"
#include "people/compare.h"
#include "study/fit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LIST = 400, LEAST_POINTS = 3, MOST_NAMES = 128 };

int ambulo__fit_count(const ambulo__yaml_node *node, int most, const char *what) {
  int count = ambulo__yaml_is(node, AMBULO__YAML_MAPPING) ? ambulo__yaml_pairs(node)
                                                          : ambulo__yaml_items(node);
  if (!node || (count >= 1 && count <= most)) return count;
  (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL, "%d %s; expected 1 to %d", count, what,
                           most);
  return 0;
}

/* ------------------------------------------------------------------ overrides */

static ambulo_status read_set(ambulo_fit *fit, ambulo__fit_condition *c) {
  int count = ambulo__yaml_pairs(c->set_node);
  c->set = ambulo__alloc(&fit->allocator, (size_t)count, sizeof *c->set);
  if (!c->set) return AMBULO_E_MEMORY;
  for (int i = 0; i < count; i++) {
    const char *key = ambulo__yaml_key(c->set_node, i);
    const ambulo__yaml_node *value = ambulo__yaml_value(c->set_node, i);
    ambulo__text_buffer text;
    ambulo__yaml_expect(c->set_node, key);
    ambulo__text_init(&text, &fit->allocator);
    ambulo__text_append_format(&text, "%s=", key);
    ambulo__yaml_flow(value, &text);
    ambulo_status status = ambulo__text_status(&text);
    if (!status) c->set[i] = ambulo__strdup(&fit->allocator, ambulo__text_data(&text));
    ambulo__text_free(&text);
    if (status || !c->set[i]) return AMBULO_E_MEMORY;
    c->sets++;
  }
  return AMBULO_OK;
}

/* index of an earlier condition; -1: none */
static int find_earlier(const ambulo_fit *fit, int before, const char *name) {
  for (int i = 0; i < before; i++)
    if (strcmp(fit->condition[i].name, name) == 0) return i;
  return -1;
}

/* a name that is none of names[count]; `what` says so, with one %s */
static void unknown_name(const ambulo__yaml_node *node, const char *const *names, int count,
                         const char *lead, const char *expected) {
  char hint[LIST];
  const char *word = ambulo__yaml_text(node), *near = ambulo__nearest(word, names, (size_t)count);
  (void)snprintf(hint, sizeof hint, "did you mean '%s'?", near ? near : "");
  (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, near ? hint : NULL, "%s (got '%s'); expected %s",
                           lead, word, expected);
}

static void read_after(const ambulo_fit *fit, int index, const ambulo__yaml_node *node) {
  ambulo__fit_condition *c = &fit->condition[index];
  const char *names[AMBULO__FIT_CONDITIONS];
  if (!node) return;
  c->after = find_earlier(fit, index, ambulo__yaml_text(node));
  for (int i = 0; i < index; i++) names[i] = fit->condition[i].name;
  if (c->after < 0)
    unknown_name(node, names, index, "'after' names no earlier condition", "the name of one");
}

static ambulo_status read_condition(ambulo_fit *fit, int index, const ambulo__yaml_node *node) {
  ambulo__fit_condition *c = &fit->condition[index];
  const ambulo__yaml_node *name = ambulo__yaml_require(node, "name");
  c->node = node;
  c->after = -1;
  c->name = ambulo__yaml_name(name);
  c->set_node = ambulo__yaml_get(node, "set");
  c->reference_node = ambulo__yaml_get(node, "reference");
  c->curves_node = ambulo__yaml_get(node, "curves");
  c->held_out = ambulo__yaml_boolean(ambulo__yaml_get(node, "held_out"), 0);
  c->weight = ambulo__yaml_number_in(ambulo__yaml_get(node, "weight"), 1e-6, 1e6, 1.0);
  if (find_earlier(fit, index, c->name) >= 0)
    (void)ambulo__yaml_error(name, AMBULO_E_SCHEMA, NULL,
                             "two conditions are named '%s'; expected different names", c->name);
  read_after(fit, index, ambulo__yaml_get(node, "after"));
  ambulo_status status = AMBULO_OK;
  if (c->reference_node)
    status =
        ambulo__named_file(&fit->allocator, fit->path, ambulo__yaml_file_name(c->reference_node),
                           ambulo__yaml_place(c->reference_node), fit->diagnostics, &c->reference);
  if (!status) status = read_set(fit, c);
  if (!status) ambulo__yaml_close(node);
  return status;
}

ambulo_status ambulo__fit_read_conditions(ambulo_fit *fit, const ambulo__yaml_node *node) {
  int count = ambulo__fit_count(node, AMBULO__FIT_CONDITIONS, "conditions"), fitted = 0;
  fit->condition = ambulo__alloc(&fit->allocator, (size_t)count, sizeof *fit->condition);
  if (!fit->condition) return AMBULO_E_MEMORY;
  fit->conditions = count;
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < count && !status; i++) {
    status = read_condition(fit, i, ambulo__yaml_item(node, i));
    fitted += !fit->condition[i].held_out;
  }
  if (!status && count > 0 && fitted == 0)
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "all conditions are held out; expected one that is fitted");
  return status;
}

/* ----------------------------------------------------------------- references */

/* whether the condition's list `curves`, where it has one, names the curve of the distance */
static int is_wanted(const ambulo__fit_condition *c, const char *name) {
  int count = c->curves_node ? ambulo__yaml_items(c->curves_node) : 0;
  for (int i = 0; i < count; i++)
    if (strcmp(ambulo__yaml_text(ambulo__yaml_item(c->curves_node, i)), name) == 0) return 1;
  return c->curves_node == NULL;
}

/* The names of the list `curves` must be curves of the distance, and one of them must count. */
static void check_names(const ambulo_fit *fit, const ambulo__fit_condition *c) {
  const char *names[AMBULO__FIT_CURVES];
  double weights = 0.0;
  int unknown = 0, count = c->curves_node ? ambulo__yaml_items(c->curves_node) : 0;
  for (int k = 0; k < fit->curves; k++) {
    names[k] = fit->curve[k].name;
    if (is_wanted(c, names[k])) weights += fit->curve[k].weight;
  }
  for (int i = 0; i < count; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(c->curves_node, i);
    int known = 0;
    for (int k = 0; k < fit->curves; k++) known |= strcmp(names[k], ambulo__yaml_text(item)) == 0;
    if (!known)
      unknown_name(item, names, fit->curves, "no curve of 'distance'", "some of its curves");
    unknown |= !known;
  }
  if (!(weights > 0.0) && !unknown)
    (void)ambulo__yaml_error(c->curves_node, AMBULO_E_SCHEMA, NULL,
                             "condition '%s' has no curve with a weight above 0; expected one",
                             c->name);
}

static const ambulo__reference_curve *find_curve(const ambulo__fit_condition *c, const char *name) {
  const ambulo__reference *r = &c->people.files[0].reference;
  for (int i = 0; i < r->count; i++)
    if (strcmp(r->curves[i].entry->curve, name) == 0) return &r->curves[i];
  return NULL;
}

static void lacks_curve(const ambulo__fit_condition *c, const ambulo__fit_curve *curve) {
  char known[LIST] = "", hint[LIST + 120];
  size_t used = 0;
  const ambulo__reference *r = &c->people.files[0].reference;
  for (int i = 0; i < r->count && used < sizeof known; i++)
    used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "",
                             r->curves[i].entry->curve);
  (void)snprintf(hint, sizeof hint,
                 "it has %s; a list 'curves' in the condition leaves the others out", known);
  (void)ambulo__yaml_error(c->reference_node, AMBULO_E_SCHEMA, hint,
                           "the reference '%s' of condition '%s' has no curve '%s'; expected all "
                           "that 'distance' names",
                           c->reference, c->name, curve->curve);
}

/* of a curve that is no guard, in a condition without a reference: at its name in the list
 * `curves`, where there is one */
static void needs_reference(const ambulo__fit_condition *c, const ambulo__fit_curve *curve) {
  const ambulo__yaml_node *place = c->node;
  for (int i = 0; c->curves_node && i < ambulo__yaml_items(c->curves_node); i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(c->curves_node, i);
    if (strcmp(ambulo__yaml_text(item), curve->name) == 0) place = item;
  }
  (void)ambulo__yaml_error(place, AMBULO_E_SCHEMA,
                           "a list 'curves' in the condition names the guards that it has",
                           "condition '%s' has no reference, which its curve '%s' needs; expected "
                           "'reference', or no curves but guards (at_least, at_most)",
                           c->name, curve->name);
}

/* a reference that nothing is compared with */
static void expect_compared(const ambulo_fit *fit, const ambulo__fit_condition *c) {
  for (int k = 0; k < c->targets; k++)
    if (!fit->curve[c->target[k].curve].is_guard) return;
  if (!c->reference || c->targets == 0) return;
  (void)ambulo__yaml_error(c->reference_node, AMBULO_E_SCHEMA, NULL,
                           "all curves of condition '%s' are guards, which no reference bounds; "
                           "expected it without 'reference'",
                           c->name);
}

/* ---------------------------------------------------------------------- guards */

static void unknown_curve(const ambulo_fit *fit, const ambulo__fit_curve *curve) {
  char hint[LIST];
  const char *names[MOST_NAMES];
  const ambulo__yaml_node *name = ambulo__yaml_get(curve->node, "curve");
  int count = fit->map.count < MOST_NAMES ? fit->map.count : MOST_NAMES;
  for (int i = 0; i < count; i++) names[i] = fit->map.entries[i].curve;
  const char *near = ambulo__nearest(curve->curve, names, (size_t)count);
  (void)snprintf(hint, sizeof hint, "did you mean '%s'?", near ? near : "");
  (void)ambulo__yaml_error(name ? name : curve->node, AMBULO_E_SCHEMA,
                           near ? hint : "docs/compare.md lists the column map",
                           "the guard '%s' is of no curve of the column map (got '%s'); expected "
                           "one, such as knee_flexion",
                           curve->name, curve->curve);
}

/* the percents of a guard: half a percent apart or less, both ends among them */
static ambulo_status fill_percents(const ambulo_fit *fit, ambulo__fit_curve *c) {
  int steps = (int)ceil(2.0 * (c->to - c->from) - 1e-9);
  c->points = steps + 1;
  c->percent = ambulo__alloc(&fit->allocator, (size_t)c->points, sizeof *c->percent);
  if (!c->percent) return AMBULO_E_MEMORY;
  for (int i = 0; i <= steps; i++) c->percent[i] = c->from + (c->to - c->from) * i / steps;
  return AMBULO_OK;
}

static ambulo_status read_guards(ambulo_fit *fit) {
  ambulo_status status = AMBULO_OK;
  for (int k = 0; k < fit->curves && !status; k++) {
    ambulo__fit_curve *curve = &fit->curve[k];
    if (!curve->is_guard) continue;
    if (!fit->map.entries && fit->compare.map)
      status = ambulo__map_read(fit->compare.map, &fit->allocator, fit->diagnostics, &fit->map);
    else if (!fit->map.entries)
      status = ambulo__map_default(AMBULO__LAYOUT_WIDE, &fit->allocator, &fit->map);
    if (status) return status;
    curve->entry = ambulo__map_find(&fit->map, curve->curve);
    if (!curve->entry) unknown_curve(fit, curve);
    status = fill_percents(fit, curve);
  }
  return status;
}

/* --------------------------------------------------------------------- targets */

/* points of the reference from `from` to `to`; their deviation, root mean square */
static void cut_out(const ambulo__fit_curve *curve, const ambulo__reference_curve *r,
                    ambulo__fit_target *t) {
  int first = 0, last = r->points;
  double squares = 0.0;
  while (first < last && r->percent[first] < curve->from - 1e-9) first++;
  while (last > first && r->percent[last - 1] > curve->to + 1e-9) last--;
  t->entry = r->entry;
  t->points = last - first;
  t->percent = r->percent + first;
  t->mean = r->mean + first;
  for (int i = first; r->sd && i < last; i++) squares += r->sd[i] * r->sd[i];
  t->sd = t->points > 0 ? sqrt(squares / (double)t->points) : 0.0;
  if (curve->sd > 0.0) t->sd = curve->sd;
}

static void check_target(const ambulo__fit_condition *c, const ambulo__fit_curve *curve,
                         const ambulo__fit_target *t) {
  if (t->points < LEAST_POINTS)
    (void)ambulo__yaml_error(curve->node, AMBULO_E_SCHEMA, NULL,
                             "the reference of condition '%s' has %d points of '%s' between %g and "
                             "%g percent; expected at least %d",
                             c->name, t->points, curve->curve, curve->from, curve->to,
                             LEAST_POINTS);
  else if (!(t->sd > 0.0))
    (void)ambulo__yaml_error(curve->node, AMBULO_E_SCHEMA,
                             "write it as {weight: 1, sd: 3}, in the unit of the curve",
                             "the reference of condition '%s' has no deviations of '%s'; expected "
                             "'sd' with the curve",
                             c->name, curve->curve);
}

/* the target of a curve, added to those of the condition */
static void add_target(const ambulo_fit *fit, ambulo__fit_condition *c, int k) {
  const ambulo__fit_curve *curve = &fit->curve[k];
  const ambulo__reference_curve *r = NULL;
  if (!curve->is_guard && !c->reference) {
    needs_reference(c, curve);
    return;
  }
  if (!curve->is_guard) r = find_curve(c, curve->curve);
  if (!curve->is_guard && !r) {
    lacks_curve(c, curve);
    return;
  }
  ambulo__fit_target *t = &c->target[c->targets++];
  t->curve = k;
  if (r) {
    cut_out(curve, r, t);
    check_target(c, curve, t);
  } else {
    t->entry = curve->entry;
    t->points = curve->points;
    t->percent = curve->percent;
    t->sd = curve->sd;
  }
  t->first = c->residuals;
  t->count = curve->of == AMBULO__FIT_CURVE ? t->points + 2 : 1;
  c->residuals += t->count;
}

static ambulo_status make_targets(ambulo_fit *fit, ambulo__fit_condition *c) {
  c->target = ambulo__alloc(&fit->allocator, (size_t)fit->curves, sizeof *c->target);
  if (!c->target) return AMBULO_E_MEMORY;
  check_names(fit, c);
  for (int k = 0; k < fit->curves; k++)
    if (is_wanted(c, fit->curve[k].name)) add_target(fit, c, k);
  expect_compared(fit, c);
  if (c->held_out) return AMBULO_OK;
  c->first = fit->residuals;
  fit->residuals += c->residuals;
  return AMBULO_OK;
}

ambulo_status ambulo__fit_read_text(ambulo_fit *fit, ambulo_diagnostics *diagnostics) {
  ambulo__inputs inputs = {.known = &fit->known};
  if (fit->text) return AMBULO_OK;
  ambulo__text_init(&inputs.read, &fit->allocator);
  ambulo_status status =
      ambulo__inputs_read(&inputs, fit->problem, AMBULO__YAML_MAX_BYTES, &fit->allocator,
                          diagnostics, &fit->text, &fit->length);
  ambulo__text_free(&inputs.read);
  return status;
}

/* of the fitted conditions, and of their curves or their guards */
static double sum_of_weights(const ambulo_fit *fit, int of_guards) {
  double sum = 0.0;
  for (int c = 0; c < fit->conditions; c++)
    if (!fit->condition[c].held_out)
      sum += fit->condition[c].weight * ambulo__fit_weight(fit, &fit->condition[c], of_guards);
  return sum;
}

ambulo_status ambulo__fit_read_references(ambulo_fit *fit) {
  ambulo_status status = read_guards(fit);
  for (int i = 0; i < fit->conditions && !status; i++) {
    ambulo__fit_condition *c = &fit->condition[i];
    if (c->reference)
      status = ambulo__people_read(c->reference, fit->compare.map, &fit->allocator,
                                   fit->diagnostics, &c->people);
    if (status == AMBULO_E_MEMORY) return status;
    if (status)
      return ambulo__yaml_error(c->reference_node, status, NULL,
                                "the reference '%s' could not be read", c->reference);
    status = make_targets(fit, c);
  }
  fit->weights = sum_of_weights(fit, 0);
  if (!(fit->weights > 0.0)) fit->weights = sum_of_weights(fit, 1);
  return status;
}
