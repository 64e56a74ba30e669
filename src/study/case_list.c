/* study/case_list.c - the case list: product, filters, explicit cases, names, ids, chains.
 *
 * Everything here follows from the file alone. An id is the place in the list before filters
 * (so that adding a filter renames nothing) and a hash of the overrides; a key is a hash of all
 * that a result depends on: the base problem, the overrides, the solution it starts from.
 *
 * Chains: a case starts from the nearest one before it that differs from it along the chain's axis
 * alone; axes that advance together count as one. In the product that is the place one value of
 * the chain's group before, or more where filters have taken cases away.
 *
 * Who chooses the next cases by the results of the last ones has no list beforehand, and so no
 * places in it: there an id is the hash of what is asked for (ambulo__sweep_append). */
#include "formats/read_file.h"
#include "study/study.h"

#include <stdio.h>
#include <string.h>

static ambulo_status make_room(ambulo_sweep *s) {
  if (s->case_count >= AMBULO__SWEEP_CASES) {
    ambulo__place place = {s->path, 0, 0, NULL};
    return ambulo__error(s->diagnostics, AMBULO_E_LIMIT, place, "split the sweep",
                         "more than %d cases; expected at most %d", AMBULO__SWEEP_CASES,
                         AMBULO__SWEEP_CASES);
  }
  if (s->case_count < s->case_capacity) return AMBULO_OK;
  int capacity = s->case_capacity ? 2 * s->case_capacity : 64;
  size_t cells = (size_t)capacity * (size_t)s->axes;
  ambulo__sweep_case *cases =
      ambulo__realloc(&s->allocator, s->cases, (size_t)capacity, sizeof *cases);
  if (cases) s->cases = cases;
  const char **cell = ambulo__realloc(&s->allocator, (void *)s->cell, cells, sizeof *cell);
  if (cell) s->cell = cell;
  if (!cases || !cell) return AMBULO_E_MEMORY;
  s->case_capacity = capacity;
  return AMBULO_OK;
}

ambulo_sweep ambulo__sweep_without_cases(const ambulo_sweep *s) {
  ambulo_sweep view = *s;
  view.cases = NULL;
  view.cell = NULL;
  view.case_count = view.case_capacity = 0;
  return view;
}

void ambulo__sweep_free_cases(ambulo_sweep *s) {
  const ambulo_allocator *a = &s->allocator;
  for (int k = 0; k < s->case_count; k++) {
    ambulo__free(a, (void *)s->cases[k].override);
    if (s->list) continue;
    ambulo__free(a, s->cases[k].id);
    ambulo__free(a, s->cases[k].name);
  }
  ambulo__free(a, s->cases);
  ambulo__free(a, (void *)s->cell);
}

typedef struct builder {
  ambulo_sweep *sweep;
  int value[AMBULO__SWEEP_AXES]; /* of the case at hand; -1: not set */
  long long place;               /* in the list before filters */
  int own;                       /* 1: an explicit case */
  int alone;                     /* the last case that sets the chain's axes alone; -1: none */
  int probe[AMBULO__SWEEP_PROBES], probes;
} builder;

static void set_nothing(builder *b) {
  for (int i = 0; i < AMBULO__SWEEP_AXES; i++) b->value[i] = -1;
}

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

/* the overrides and cells of the case; a value that no case before it has is to be probed */
static ambulo_status fill_values(builder *b, ambulo__sweep_case *one) {
  ambulo_sweep *s = b->sweep;
  const char **cell = s->cell + (size_t)(s->case_count - 1) * (size_t)s->axes;
  int count = 0, fresh = 0;
  for (int i = 0; i < s->axes; i++) count += b->value[i] >= 0;
  one->override = ambulo__alloc(&s->allocator, (size_t)count, sizeof *one->override);
  if (!one->override) return AMBULO_E_MEMORY;
  for (int i = 0; i < s->axes; i++) {
    cell[i] = "";
    if (b->value[i] < 0) continue;
    ambulo__axis_value *value = &s->axis[i].value[b->value[i]];
    cell[i] = ambulo__axis_text(&s->axis[i], b->value[i]);
    one->override[one->overrides++] = value->override;
    fresh |= !value->used;
    value->used = 1;
  }
  if (fresh && b->probes < AMBULO__SWEEP_PROBES) b->probe[b->probes++] = s->case_count - 1;
  return AMBULO_OK;
}

/* `case_name` with {axis} replaced by the axis's text; ambulo__sweep_check_name has read it */
static char *expand_name(builder *b, const char *pattern) {
  char name[AMBULO__SWEEP_TEXT] = "", axis[AMBULO__SWEEP_TEXT];
  size_t length = 0;
  for (const char *c = pattern; *c && length + 1 < sizeof name;) {
    size_t plain = strcspn(c, "{");
    int copied = snprintf(name + length, sizeof name - length, "%.*s", (int)plain, c);
    length += (size_t)copied;
    c += plain;
    if (*c != '{' || length >= sizeof name) break;
    size_t inside = strcspn(++c, "}");
    (void)snprintf(axis, sizeof axis, "%.*s", (int)inside, c);
    length += (size_t)snprintf(name + length, sizeof name - length, "%s", text_of_axis(b, axis));
    c += inside + 1;
  }
  return ambulo__strdup(&b->sweep->allocator, name);
}

/* case of a place; -1: a filter has taken it away */
static int case_at(const ambulo_sweep *s, long long place) {
  int low = 0, high = s->case_count;
  while (low < high) {
    int middle = low + (high - low) / 2;
    if (s->cases[middle].place < place)
      low = middle + 1;
    else
      high = middle;
  }
  return low < s->case_count && s->cases[low].place == place ? low : -1;
}

/* the case that the one at hand continues; -1: none */
static int neighbour(builder *b) {
  const ambulo_sweep *s = b->sweep;
  int c = s->chain_axis, group = s->groups - 1, others = 0, unset = 0;
  if (c < 0) return -1;
  long long stride = 1; /* places from one value of the chain's group to the next */
  for (; s->group[group].first > c; group--) stride *= s->group[group].count;
  const ambulo__axis_group *chain = &s->group[group];
  for (int i = 0; i < s->axes; i++) {
    int in_chain = i >= chain->first && i < chain->first + chain->axes;
    others += !in_chain && b->value[i] >= 0;
    unset += in_chain && b->value[i] < 0;
  }
  if (unset || (b->own && others)) return -1;
  if (others == 0) {
    int before = b->alone;
    b->alone = s->case_count - 1;
    return before;
  }
  for (int down = 1; down <= b->value[c]; down++) {
    int found = case_at(s, b->place - down * stride);
    if (found >= 0) return found;
  }
  return -1;
}

static ambulo_status add_case(builder *b, const char *pattern) {
  ambulo_sweep *s = b->sweep;
  ambulo_status status = make_room(s);
  if (status) return status;
  ambulo__sweep_case *one = &s->cases[s->case_count++];
  *one = (ambulo__sweep_case){.place = b->place};
  status = fill_values(b, one);
  if (status) return status;
  unsigned long long hash = AMBULO__HASH_START;
  for (int i = 0; i < one->overrides; i++) hash = ambulo__hash_text(hash, one->override[i]);
  one->key = ambulo__hash_word(hash, s->base_hash);
  for (int i = 0; i < s->axes; i++)
    if (b->value[i] >= 0 && s->axis[i].value[b->value[i]].file)
      one->key = ambulo__hash_word(one->key, s->axis[i].value[b->value[i]].file);
  one->previous = neighbour(b);
  if (one->previous >= 0) one->key = ambulo__hash_word(one->key, s->cases[one->previous].key);
  char id[40];
  (void)snprintf(id, sizeof id, "%09lld-%08llx", b->place, hash & 0xffffffffULL);
  one->id = ambulo__strdup(&s->allocator, id);
  one->name = pattern ? expand_name(b, pattern) : ambulo__strdup(&s->allocator, id);
  return one->id && one->name ? AMBULO_OK : AMBULO_E_MEMORY;
}

/* ----------------------------------------------------------------- building */

/* Told before any case is stored; how many pass filters is only known afterwards (make_room), but
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
    set_nothing(b);
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

static ambulo_status explicit_case(builder *b, const ambulo__yaml_node *node) {
  const ambulo__yaml_node *name = ambulo__yaml_get(node, "name");
  const ambulo__yaml_node *set = ambulo__yaml_require(node, "set");
  ambulo_sweep *s = b->sweep;
  ambulo_status status = AMBULO_OK;
  set_nothing(b);
  for (int i = 0; i < ambulo__yaml_pairs(set) && !status; i++) {
    const char *key = ambulo__yaml_key(set, i);
    int axis = axis_of_key(s, key);
    ambulo__yaml_expect(set, key);
    if (axis < 0) return AMBULO_E_INTERNAL;
    status = ambulo__axis_add_node(s, &s->axis[axis], ambulo__yaml_value(set, i));
    b->value[axis] = s->axis[axis].count - 1;
  }
  status = ambulo__sweep_close(node, status);
  const char *pattern = name ? ambulo__yaml_text(name) : s->case_name;
  if (!status && name) status = ambulo__sweep_check_name(s, pattern, ambulo__spot_of(name));
  if (!status) status = add_case(b, pattern);
  b->place++;
  return status;
}

ambulo_status ambulo__sweep_build_cases(ambulo_sweep *s, const ambulo__yaml_node *explicit_cases) {
  builder b = {.sweep = s, .alone = -1};
  ambulo_status status = add_explicit_axes(s, explicit_cases);
  if (!status && s->case_name)
    status = ambulo__sweep_check_name(s, s->case_name, s->case_name_spot);
  if (!status) status = product(&b, ambulo__yaml_items(explicit_cases));
  b.own = 1;
  for (int i = 0; i < ambulo__yaml_items(explicit_cases) && !status; i++)
    status = explicit_case(&b, ambulo__yaml_item(explicit_cases, i));
  if (status) return status;
  ambulo__place place = {s->path, 0, 0, NULL};
  if (s->case_count == 0)
    return ambulo__error(s->diagnostics, AMBULO_E_PROBLEM, place,
                         s->filters ? NULL : "give axes, a table, samples or cases",
                         "the sweep has no case left; expected at least one%s",
                         s->filters ? " that passes the filters" : "");
  return ambulo__sweep_check_cases(s, b.probe, b.probes);
}

/* ------------------------------------------------------------------ growing */

/* pointers and their texts in one block, since no axis owns the latter */
static const char **pack(const ambulo_sweep *s, const char *const *overrides, int count) {
  size_t head = (size_t)count * sizeof *overrides, size = head;
  for (int i = 0; i < count; i++) size += strlen(overrides[i]) + 1;
  char *block = ambulo__alloc(&s->allocator, size, 1);
  const char **packed = (const char **)(void *)block;
  char *at = block ? block + head : NULL;
  for (int i = 0; block && i < count; i++) {
    size_t length = strlen(overrides[i]) + 1;
    memcpy(at, overrides[i], length);
    packed[i] = at;
    at += length;
  }
  return packed;
}

/* *id: hash of overrides and start; *key: with the base problem and the files that values name */
static ambulo_status hash_request(const ambulo_sweep *s, const char *const *overrides, int count,
                                  int previous, unsigned long long *id, unsigned long long *key) {
  unsigned long long hash = AMBULO__HASH_START, files = s->base_hash;
  for (int i = 0; i < count; i++) {
    const char *value = strchr(overrides[i], '=');
    unsigned long long file = 0;
    hash = ambulo__hash_text(hash, overrides[i]);
    ambulo_status status = value ? ambulo__sweep_hash_value(s, value + 1, &file) : AMBULO_OK;
    if (status) return status;
    if (file) files = ambulo__hash_word(files, file);
  }
  if (previous >= 0) {
    hash = ambulo__hash_text(hash, s->cases[previous].id);
    files = ambulo__hash_word(files, s->cases[previous].key);
  }
  *id = hash;
  *key = ambulo__hash_word(hash, files);
  return AMBULO_OK;
}

static ambulo_status append(ambulo_sweep *s, const char *name, const char *const *overrides,
                            int count, int previous, int *index) {
  unsigned long long hash = 0, key = 0;
  char id[24];
  ambulo_status status = hash_request(s, overrides, count, previous, &hash, &key);
  if (status) return status;
  (void)snprintf(id, sizeof id, "%016llx", hash);
  for (int k = 0; k < s->case_count; k++) {
    if (strcmp(s->cases[k].id, id) != 0) continue;
    *index = k;
    return AMBULO_OK;
  }
  status = make_room(s);
  if (status) return status;
  ambulo__sweep_case *one = &s->cases[s->case_count];
  *index = s->case_count++;
  *one =
      (ambulo__sweep_case){.key = key, .overrides = count, .previous = previous, .place = *index};
  one->id = ambulo__strdup(&s->allocator, id);
  one->name = ambulo__strdup(&s->allocator, name);
  one->override = pack(s, overrides, count);
  if (!one->id || !one->name || !one->override) return AMBULO_E_MEMORY;
  for (int i = 0; i < s->axes; i++)
    s->cell[*index * s->axes + i] = strchr(one->override[i], '=') + 1;
  return AMBULO_OK;
}

ambulo_status ambulo__sweep_append(ambulo_sweep *s, const char *name, const char *const *overrides,
                                   int count, int previous, ambulo_diagnostics *diagnostics,
                                   int *index) {
  ambulo_diagnostics *before = s->diagnostics;
  s->diagnostics = diagnostics;
  ambulo_status status = append(s, name, overrides, count, previous, index);
  s->diagnostics = before;
  return status;
}
