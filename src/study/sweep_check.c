/* study/sweep_check.c - what makes a case list wrong before anything is computed (sweep.h). */
#include "ambulo/problem.h"
#include "ambulo/tools/load.h"
#include "base/numtext.h"
#include "formats/text_hash.h"
#include "study/sweep.h"

#include <stdio.h>
#include <string.h>

enum { MOST_PROBES = 200, HINT = 200 };

/* "did you mean 'speed'?", or the names there are */
static void hint_axis(const ambulo_sweep *s, const char *word, char hint[HINT]) {
  const char *name[AMBULO__SWEEP_AXES];
  for (int i = 0; i < s->axes; i++) name[i] = s->axis[i].name;
  const char *near = ambulo__nearest(word, name, (size_t)s->axes);
  size_t used = 0;
  if (near) {
    (void)snprintf(hint, HINT, "did you mean '%s'?", near);
    return;
  }
  (void)snprintf(hint, HINT, "there are no axes");
  for (int i = 0; i < s->axes && used < HINT; i++) {
    int length = snprintf(hint + used, HINT - used, "%s%s", i ? ", " : "axes: ", name[i]);
    used += length > 0 ? (size_t)length : 0;
  }
}

/* --------------------------------------------------------------------- axes */

static ambulo_status repeated(ambulo_sweep *s, const ambulo__axis *axis, const char *what,
                              const char *text, const ambulo__axis *first) {
  return ambulo__error(s->diagnostics, AMBULO_E_SCHEMA, ambulo__spot_place(s, axis->spot), NULL,
                       "the %s '%s' is that of another axis (line %d); expected another one", what,
                       text, first->spot.line);
}

ambulo_status ambulo__sweep_check_axes(ambulo_sweep *s) {
  for (int i = 0; i < s->axes; i++) {
    const ambulo__axis *axis = &s->axis[i];
    for (int k = 0; k < i; k++) {
      if (strcmp(axis->key, s->axis[k].key) == 0)
        return repeated(s, axis, "key", axis->key, &s->axis[k]);
      if (strcmp(axis->name, s->axis[k].name) == 0)
        return repeated(s, axis, "name", axis->name, &s->axis[k]);
    }
  }
  return AMBULO_OK;
}

/* ------------------------------------------------------------------ filters */

static int is_number(const char *text) {
  double number;
  return ambulo__parse_double(text, strlen(text), &number);
}

/* the side that should name an axis and does not; NULL: fine */
static const char *stranger(const ambulo_sweep *s, const char *left, const char *right) {
  int axes = (ambulo__sweep_find_axis(s, left) >= 0) + (ambulo__sweep_find_axis(s, right) >= 0);
  if (axes > 0) return NULL;
  return is_number(left) ? right : left;
}

ambulo_status ambulo__sweep_check_filters(ambulo_sweep *s, const ambulo__yaml_node *filters) {
  for (int i = 0; i < s->filters; i++) {
    char left[AMBULO__SWEEP_TEXT], right[AMBULO__SWEEP_TEXT], hint[HINT];
    const ambulo__yaml_node *node = ambulo__yaml_item(filters, i);
    if (!ambulo__filter_sides(s->filter[i], left, right))
      return ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                                "filter '%s' is no comparison; expected NAME < VALUE with < <= > "
                                ">= == !=",
                                s->filter[i]);
    const char *word = stranger(s, left, right);
    if (!word) continue;
    hint_axis(s, word, hint);
    return ambulo__yaml_error(node, AMBULO_E_SCHEMA, hint,
                              "unknown axis in filter '%s' (got '%s'); expected the name of an "
                              "axis",
                              s->filter[i], word);
  }
  return AMBULO_OK;
}

/* --------------------------------------------------------------- case names */

static ambulo_status stray_brace(ambulo_sweep *s, ambulo__spot spot, const char *at) {
  return ambulo__error(s->diagnostics, AMBULO_E_SCHEMA, ambulo__spot_place(s, spot),
                       "an axis stands in braces: \"walk_{speed}\"",
                       "a brace without its other half in the name of a case (got '%.40s'); "
                       "expected {AXIS}",
                       at);
}

ambulo_status ambulo__sweep_check_name(ambulo_sweep *s, const char *pattern, ambulo__spot spot) {
  if (!pattern[0])
    return ambulo__error(s->diagnostics, AMBULO_E_SCHEMA, ambulo__spot_place(s, spot), NULL,
                         "the name of a case is empty; expected a text");
  for (const char *c = pattern; *c; c++) {
    char word[AMBULO__SWEEP_TEXT], hint[HINT];
    if (*c == '}') return stray_brace(s, spot, c);
    if (*c != '{') continue;
    size_t length = strcspn(c + 1, "{}");
    if (c[1 + length] != '}' || length >= sizeof word) return stray_brace(s, spot, c);
    memcpy(word, c + 1, length);
    word[length] = '\0';
    if (ambulo__sweep_find_axis(s, word) < 0) {
      hint_axis(s, word, hint);
      return ambulo__error(s->diagnostics, AMBULO_E_SCHEMA, ambulo__spot_place(s, spot), hint,
                           "unknown axis in the name of a case (got '{%s}'); expected the name of "
                           "an axis",
                           word);
    }
    c += length + 1;
  }
  return AMBULO_OK;
}

static ambulo_status names_differ(ambulo_sweep *s) {
  size_t slots = 2;
  while (slots < 2 * (size_t)s->case_count) slots *= 2;
  int *slot = ambulo__alloc(&s->allocator, slots, sizeof *slot);
  if (!slot) return AMBULO_E_MEMORY;
  memset(slot, 0xff, slots * sizeof *slot);
  ambulo_status status = AMBULO_OK;
  for (int k = 0; k < s->case_count && !status; k++) {
    const char *name = s->cases[k].name;
    size_t at = (size_t)ambulo__hash_text(AMBULO__HASH_START, name) & (slots - 1);
    while (slot[at] >= 0 && strcmp(s->cases[slot[at]].name, name) != 0) at = (at + 1) & (slots - 1);
    if (slot[at] >= 0)
      status =
          ambulo__error(s->diagnostics, AMBULO_E_SCHEMA, ambulo__spot_place(s, s->case_name_spot),
                        "name every axis that varies in case_name, or leave it out",
                        "two cases are named '%s' (%s and %s); expected different names", name,
                        s->cases[slot[at]].id, s->cases[k].id);
    slot[at] = k;
  }
  ambulo__free(&s->allocator, slot);
  return status;
}

/* -------------------------------------------------------------------- cases */

/* the axis that a message about "--set KEY" is about; -1: none */
static int axis_of_message(const ambulo_sweep *s, const ambulo_diagnostic *message) {
  static const char lead[] = "--set ";
  if (!message->file || strncmp(message->file, lead, sizeof lead - 1) != 0) return -1;
  for (int i = 0; i < s->axes; i++)
    if (strcmp(s->axis[i].key, message->file + sizeof lead - 1) == 0) return i;
  return -1;
}

/* why a file that a value names cannot be read: what was said of it before */
static void tell_causes(ambulo_sweep *s, const ambulo_diagnostics *list, size_t count) {
  for (size_t k = 0; k < count; k++) {
    const ambulo_diagnostic *m = ambulo_diagnostics_get(list, k);
    ambulo__place place = {m->file, m->line, m->column, m->path};
    if (m->severity == AMBULO_ERROR)
      (void)ambulo__error(s->diagnostics, m->status, place, m->hint, "%s", m->message);
  }
}

/* a message of the problem's reader, told at the key (it has no position in the value) or at the
 * value that it is about */
static ambulo_status tell(ambulo_sweep *s, int index, ambulo_status status,
                          const ambulo_diagnostics *list) {
  const ambulo_diagnostic *message = NULL;
  int i = -1;
  size_t causes = 0;
  for (size_t k = 0; k < ambulo_diagnostics_count(list) && i < 0; k++) {
    message = ambulo_diagnostics_get(list, k);
    i = message->severity == AMBULO_ERROR ? axis_of_message(s, message) : -1;
    causes = k;
  }
  int value = i < 0 ? -1 : s->value[(size_t)index * (size_t)s->stride + (size_t)i];
  if (value < 0) {
    message = ambulo_diagnostics_get(list, 0);
    return ambulo__error(s->diagnostics, status, ambulo__spot_place(s, (ambulo__spot){0, 0, 0}),
                         message ? message->hint : NULL, "case '%s': %s", s->cases[index].name,
                         message ? message->message : ambulo_status_text(status));
  }
  tell_causes(s, list, causes);
  const ambulo__axis *axis = &s->axis[i];
  ambulo__spot spot = message->line > 0 ? axis->value[value].spot : axis->spot;
  return ambulo__error(s->diagnostics, status, ambulo__spot_place(s, spot), message->hint, "%s: %s",
                       axis->key, message->message);
}

/* Only what a value is in itself ends the sweep; whether the values of a case agree with each
 * other (E_PROBLEM, E_MODEL) is a result of that case. */
static ambulo_status probe(ambulo_sweep *s, int index) {
  const ambulo__sweep_case *one = &s->cases[index];
  ambulo_problem *problem = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(&s->allocator);
  if (!list) return AMBULO_E_MEMORY;
  ambulo_status status =
      ambulo_problem_load(s->base, one->override, one->overrides, &s->allocator, list, &problem);
  ambulo_problem_free(problem);
  if (status == AMBULO_E_SCHEMA || status == AMBULO_E_PARSE || status == AMBULO_E_IO ||
      status == AMBULO_E_ARGUMENT)
    status = tell(s, index, status, list);
  else if (status != AMBULO_E_MEMORY)
    status = AMBULO_OK;
  ambulo_diagnostics_free(list);
  return status;
}

ambulo_status ambulo__sweep_check_cases(ambulo_sweep *s) {
  ambulo_status status = AMBULO_OK;
  size_t first[AMBULO__SWEEP_AXES] = {0}, values = 0;
  for (int i = 0; i < s->axes; i++) {
    first[i] = values;
    values += (size_t)s->axis[i].count;
  }
  unsigned char *seen = ambulo__alloc(&s->allocator, values, 1);
  if (!seen) status = AMBULO_E_MEMORY;
  int probes = 0;
  for (int k = 0; k < s->case_count && !status && probes < MOST_PROBES; k++) {
    const int *value = s->value + (size_t)k * (size_t)s->stride;
    int fresh = 0;
    for (int i = 0; i < s->axes; i++) {
      if (value[i] < 0 || seen[first[i] + (size_t)value[i]]) continue;
      seen[first[i] + (size_t)value[i]] = 1;
      fresh = 1;
    }
    if (!fresh) continue;
    probes++;
    status = probe(s, k);
  }
  ambulo__free(&s->allocator, seen);
  return status ? status : names_differ(s);
}
