/* study/sweep_cases.c - the case list: product, filters, explicit cases, names, ids, chains.
 *
 * Everything here follows from the file alone. An id is the place in the list before filters
 * (so that adding a filter renames nothing) and a hash of the overrides; a key is a hash of all
 * that a result depends on: the base problem, the overrides, the solution it starts from. */
#include "formats/text_hash.h"
#include "study/sweep.h"

#include <stdio.h>
#include <string.h>

typedef struct builder {
  ambulo_sweep *sweep;
  int value[AMBULO__SWEEP_AXES]; /* of the case at hand */
  long long place;               /* in the list before filters */
} builder;

static const char *text_of_axis(void *user, const char *name) {
  const builder *b = user;
  int axis = ambulo__sweep_find_axis(b->sweep, name);
  if (axis < 0) return NULL;
  return b->value[axis] < 0 ? "" : ambulo__axis_text(&b->sweep->axis[axis], b->value[axis]);
}

static ambulo_status passes(builder *b, int *pass) {
  *pass = 1;
  for (int i = 0; i < b->sweep->filters && *pass; i++) {
    int holds = ambulo__filter_holds(b->sweep->filter[i], text_of_axis, b);
    if (holds < 0) {
      ambulo__place place = {b->sweep->path, 0, 0, "filters"};
      return ambulo__error(b->sweep->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                           "filter '%s' is no comparison; expected NAME < VALUE with < <= > >= "
                           "== !=, numbers on both sides of an order",
                           b->sweep->filter[i]);
    }
    *pass = holds;
  }
  return AMBULO_OK;
}

static ambulo_status grow(ambulo_sweep *s) {
  if (s->case_count >= AMBULO__SWEEP_CASES) {
    ambulo__place place = {s->path, 0, 0, NULL};
    return ambulo__error(s->diagnostics, AMBULO_E_LIMIT, place, "split the sweep",
                         "more than %d cases; expected at most %d", AMBULO__SWEEP_CASES,
                         AMBULO__SWEEP_CASES);
  }
  if (s->case_count < s->case_capacity) return AMBULO_OK;
  int capacity = s->case_capacity ? 2 * s->case_capacity : 64;
  ambulo__sweep_case *cases =
      ambulo__realloc(&s->allocator, s->cases, (size_t)capacity, sizeof *cases);
  if (cases) s->cases = cases;
  int *value =
      ambulo__realloc(&s->allocator, s->value, (size_t)capacity * (size_t)s->stride, sizeof *value);
  if (value) s->value = value;
  if (!cases || !value) return AMBULO_E_MEMORY;
  s->case_capacity = capacity;
  return AMBULO_OK;
}

static ambulo_status fill_overrides(builder *b, ambulo__sweep_case *one) {
  const ambulo_sweep *s = b->sweep;
  int count = 0;
  for (int i = 0; i < s->axes; i++) count += b->value[i] >= 0;
  one->override = ambulo__alloc(&s->allocator, (size_t)count, sizeof *one->override);
  if (!one->override) return AMBULO_E_MEMORY;
  for (int i = 0; i < s->axes; i++)
    if (b->value[i] >= 0) one->override[one->overrides++] = s->axis[i].value[b->value[i]].override;
  return AMBULO_OK;
}

/* `case_name` with {axis} replaced by the axis's text */
static char *expand_name(builder *b, const char *pattern) {
  char name[AMBULO__SWEEP_TEXT];
  size_t length = 0;
  for (const char *c = pattern; *c && length + 1 < sizeof name;) {
    const char *end = *c == '{' ? strchr(c, '}') : NULL;
    if (!end || (size_t)(end - c) >= sizeof name) {
      name[length++] = *c++;
      continue;
    }
    char axis[AMBULO__SWEEP_TEXT];
    memcpy(axis, c + 1, (size_t)(end - c) - 1);
    axis[end - c - 1] = '\0';
    const char *text = text_of_axis(b, axis);
    for (text = text ? text : axis; *text && length + 1 < sizeof name; text++)
      name[length++] = *text;
    c = end + 1;
  }
  name[length] = '\0';
  return ambulo__strdup(&b->sweep->allocator, name);
}

static ambulo_status add_case(builder *b, const char *pattern) {
  ambulo_sweep *s = b->sweep;
  ambulo_status status = grow(s);
  if (status) return status;
  ambulo__sweep_case *one = &s->cases[s->case_count];
  memset(one, 0, sizeof *one);
  memcpy(s->value + (size_t)s->case_count * (size_t)s->stride, b->value,
         (size_t)s->stride * sizeof *b->value);
  s->case_count++;
  one->previous = -1;
  status = fill_overrides(b, one);
  if (status) return status;
  unsigned long long hash = AMBULO__HASH_START;
  for (int i = 0; i < one->overrides; i++) hash = ambulo__hash_text(hash, one->override[i]);
  one->key = ambulo__hash_word(hash, s->base_hash);
  for (int i = 0; i < s->axes; i++) {
    if (b->value[i] >= 0 && s->axis[i].value[b->value[i]].file)
      one->key = ambulo__hash_word(one->key, s->axis[i].value[b->value[i]].file);
  }
  char id[40];
  (void)snprintf(id, sizeof id, "%09lld-%08llx", b->place, hash & 0xffffffffULL);
  one->id = ambulo__strdup(&s->allocator, id);
  one->name = pattern ? expand_name(b, pattern) : ambulo__strdup(&s->allocator, id);
  return one->id && one->name ? AMBULO_OK : AMBULO_E_MEMORY;
}

/* ----------------------------------------------------------------- product */

/* Told before any case is stored; how many pass filters is only known afterwards (grow), but
 * going through the combinations should end within minutes. */
static ambulo_status check_size(const ambulo_sweep *s, double combinations, int explicit_cases) {
  double count = combinations + explicit_cases, most = AMBULO__SWEEP_CASES;
  if (s->filters > 0) {
    count = combinations;
    most *= 100.0;
  }
  if (count <= most) return AMBULO_OK;
  ambulo__place place = {s->path, 0, 0, NULL};
  return ambulo__error(s->diagnostics, AMBULO_E_LIMIT, place, "split the sweep",
                       "%.0f %s; expected at most %.0f", count,
                       s->filters > 0 ? "combinations before filters" : "cases", most);
}

static ambulo_status product(builder *b, int explicit_cases) {
  ambulo_sweep *s = b->sweep;
  double total = s->groups > 0 ? 1.0 : 0.0;
  for (int g = 0; g < s->groups; g++) total *= s->group[g].count;
  ambulo_status status = check_size(s, total, explicit_cases);
  for (; b->place < (long long)total && !status; b->place++) {
    long long rest = b->place;
    int pass = 1;
    for (int i = 0; i < AMBULO__SWEEP_AXES; i++) b->value[i] = -1;
    for (int g = s->groups - 1; g >= 0; g--) {
      const ambulo__axis_group *group = &s->group[g];
      for (int i = 0; i < group->axes; i++) b->value[group->first + i] = (int)(rest % group->count);
      rest /= group->count;
    }
    status = passes(b, &pass);
    if (!status && pass) status = add_case(b, s->case_name);
  }
  return status;
}

static int axis_of_key(const ambulo_sweep *s, const char *key) {
  for (int i = 0; i < s->axes; i++)
    if (strcmp(s->axis[i].key, key) == 0) return i;
  return -1;
}

/* axes for the keys that only explicit cases set, before any case is stored */
static ambulo_status add_explicit_axes(ambulo_sweep *s, const ambulo__yaml_node *cases) {
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < ambulo__yaml_items(cases); i++) {
    const ambulo__yaml_node *set = ambulo__yaml_require(ambulo__yaml_item(cases, i), "set");
    for (int j = 0; j < ambulo__yaml_pairs(set) && !status; j++) {
      const char *key = ambulo__yaml_key(set, j);
      ambulo__axis *axis;
      if (axis_of_key(s, key) < 0)
        status =
            ambulo__sweep_add_axis(s, "", key, ambulo__spot_of(ambulo__yaml_value(set, j)), &axis);
    }
  }
  return status;
}

static ambulo_status set_value(builder *b, const char *key, const ambulo__yaml_node *node) {
  ambulo_sweep *s = b->sweep;
  int axis = axis_of_key(s, key);
  if (axis < 0) return AMBULO_E_INTERNAL;
  ambulo_status status = ambulo__axis_add_node(s, &s->axis[axis], node);
  if (!status) b->value[axis] = s->axis[axis].count - 1;
  return status;
}

static ambulo_status explicit_case(builder *b, const ambulo__yaml_node *node) {
  const ambulo__yaml_node *name = ambulo__yaml_get(node, "name");
  const ambulo__yaml_node *set = ambulo__yaml_require(node, "set");
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < AMBULO__SWEEP_AXES; i++) b->value[i] = -1;
  for (int i = 0; i < ambulo__yaml_pairs(set) && !status; i++) {
    const char *key = ambulo__yaml_key(set, i);
    ambulo__yaml_expect(set, key);
    status = set_value(b, key, ambulo__yaml_value(set, i));
  }
  status = ambulo__sweep_close(node, status);
  const char *pattern = name ? ambulo__yaml_text(name) : b->sweep->case_name;
  if (!status && name) status = ambulo__sweep_check_name(b->sweep, pattern, ambulo__spot_of(name));
  if (!status) status = add_case(b, pattern);
  b->place++;
  return status;
}

ambulo_status ambulo__sweep_build_cases(ambulo_sweep *sweep,
                                        const ambulo__yaml_node *explicit_cases) {
  builder b = {.sweep = sweep};
  ambulo_status status = add_explicit_axes(sweep, explicit_cases);
  sweep->stride = sweep->axes > 0 ? sweep->axes : 1;
  if (!status && sweep->case_name)
    status = ambulo__sweep_check_name(sweep, sweep->case_name, sweep->case_name_spot);
  if (!status) status = product(&b, ambulo__yaml_items(explicit_cases));
  for (int i = 0; i < ambulo__yaml_items(explicit_cases) && !status; i++)
    status = explicit_case(&b, ambulo__yaml_item(explicit_cases, i));
  if (status) return status;
  if (sweep->case_count == 0) {
    ambulo__place place = {sweep->path, 0, 0, NULL};
    return ambulo__error(sweep->diagnostics, AMBULO_E_PROBLEM, place,
                         sweep->filters ? NULL : "give axes, a table, samples or cases",
                         "the sweep has no case left; expected at least one%s",
                         sweep->filters ? " that passes the filters" : "");
  }
  status = ambulo__sweep_check_cases(sweep);
  return status ? status : ambulo__sweep_link_chains(sweep);
}
