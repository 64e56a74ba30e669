/* study/sweep_check.c - what makes a case list wrong before anything is computed (study.h), and
 * filters: "speed < 1.5", "subject.sex == female".
 *
 * Both sides of a filter are axis names, numbers or words. Numbers compare as numbers, anything
 * else as text, and then only for equality. */
#include "base/numtext.h"
#include "definitions/problem_load.h"
#include "study/study.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HINT = 200 };

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

typedef enum comparison { LESS, LESS_EQUAL, GREATER, GREATER_EQUAL, EQUAL, DIFFERENT } comparison;

/* trimmed copy of text[0..length); 0 if empty or too long */
static int side(const char *text, size_t length, char out[AMBULO__SWEEP_TEXT]) {
  size_t lead = strspn(text, " \t");
  lead = lead < length ? lead : length;
  text += lead;
  length -= lead;
  while (length > 0 && (text[length - 1] == ' ' || text[length - 1] == '\t')) length--;
  if (length == 0 || length >= AMBULO__SWEEP_TEXT) return 0;
  memcpy(out, text, length);
  out[length] = '\0';
  return 1;
}

/* both sides, trimmed; 0: the text is no comparison */
static int take_apart(const char *filter, char left[AMBULO__SWEEP_TEXT],
                      char right[AMBULO__SWEEP_TEXT], comparison *which) {
  static const struct {
    const char *word;
    comparison which;
  } words[] = {{"<=", LESS_EQUAL}, {">=", GREATER_EQUAL}, {"==", EQUAL},
               {"!=", DIFFERENT},  {"<", LESS},           {">", GREATER}};
  size_t at = strcspn(filter, "<>=!");
  for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
    size_t length = strlen(words[i].word);
    const char *rest = filter + at + length;
    if (strncmp(filter + at, words[i].word, length) != 0) continue;
    *which = words[i].which;
    return side(filter, at, left) && side(rest, strlen(rest), right);
  }
  return 0;
}

static int compare_numbers(double a, double b, comparison which) {
  switch (which) {
  case LESS:
    return a < b;
  case LESS_EQUAL:
    return a <= b;
  case GREATER:
    return a > b;
  case GREATER_EQUAL:
    return a >= b;
  case EQUAL:
    return a == b;
  case DIFFERENT:
    break;
  }
  return a != b;
}

int ambulo__filter_holds(const char *filter, const char *(*text_of)(void *user, const char *name),
                         void *user) {
  char left[AMBULO__SWEEP_TEXT], right[AMBULO__SWEEP_TEXT];
  comparison which = EQUAL;
  if (!take_apart(filter, left, right, &which)) return -1;
  const char *a = text_of(user, left), *b = text_of(user, right);
  if (!a) a = left;
  if (!b) b = right;
  double x = 0.0, y = 0.0;
  if (ambulo__parse_double(a, strlen(a), &x) && ambulo__parse_double(b, strlen(b), &y))
    return compare_numbers(x, y, which);
  if (which == EQUAL) return strcmp(a, b) == 0;
  if (which == DIFFERENT) return strcmp(a, b) != 0;
  return -1;
}

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
    comparison which;
    const ambulo__yaml_node *node = ambulo__yaml_item(filters, i);
    if (!take_apart(s->filter[i], left, right, &which))
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

/* by name, then in the order of the list */
static int by_name(const void *left, const void *right) {
  const ambulo__sweep_case *a = *(const ambulo__sweep_case *const *)left,
                           *b = *(const ambulo__sweep_case *const *)right;
  int order = strcmp(a->name, b->name);
  return order ? order : (a > b) - (a < b);
}

static ambulo_status names_differ(ambulo_sweep *s) {
  size_t count = (size_t)s->case_count;
  const ambulo__sweep_case **sorted = ambulo__alloc(&s->allocator, count, sizeof *sorted);
  if (!sorted) return AMBULO_E_MEMORY;
  ambulo_status status = AMBULO_OK;
  for (size_t k = 0; k < count; k++) sorted[k] = &s->cases[k];
  qsort((void *)sorted, count, sizeof *sorted, by_name);
  const ambulo__sweep_case *twin = NULL, *first = NULL;
  for (size_t k = 1; k < count; k++) {
    if (strcmp(sorted[k]->name, sorted[k - 1]->name) != 0 || (twin && twin < sorted[k])) continue;
    twin = sorted[k];
    first = sorted[k - 1];
  }
  if (twin)
    status =
        ambulo__error(s->diagnostics, AMBULO_E_SCHEMA, ambulo__spot_place(s, s->case_name_spot),
                      "name every axis that varies in case_name, or leave it out",
                      "two cases are named '%s' (%s and %s); expected different names", twin->name,
                      first->id, twin->id);
  ambulo__free(&s->allocator, (void *)sorted);
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
static void report_causes(ambulo_sweep *s, const ambulo_diagnostics *list, size_t count) {
  for (size_t k = 0; k < count; k++) {
    const ambulo_diagnostic *m = ambulo_diagnostics_get(list, k);
    ambulo__place place = {m->file, m->line, m->column, m->path};
    if (m->severity == AMBULO_ERROR)
      (void)ambulo__error(s->diagnostics, m->status, place, m->hint, "%s", m->message);
  }
}

/* where the value of a case stands; the axis, where it is no value of a sweep file */
static ambulo__spot spot_of_value(const ambulo_sweep *s, int index, int i) {
  const ambulo__axis *axis = &s->axis[i];
  const char *cell = s->cell[(size_t)index * (size_t)s->axes + (size_t)i];
  for (int k = 0; k < axis->count; k++)
    if (ambulo__axis_text(axis, k) == cell) return axis->value[k].spot;
  return axis->spot;
}

/* a message of the problem's reader, reported at the key (it has no position in the value) or at
 * the value that it is about */
static ambulo_status report_fault(ambulo_sweep *s, int index, ambulo_status status,
                                  const ambulo_diagnostics *list) {
  const ambulo_diagnostic *message = NULL;
  int i = -1;
  size_t causes = 0;
  for (size_t k = 0; k < ambulo_diagnostics_count(list) && i < 0; k++) {
    message = ambulo_diagnostics_get(list, k);
    i = message->severity == AMBULO_ERROR ? axis_of_message(s, message) : -1;
    causes = k;
  }
  if (i < 0) {
    message = ambulo_diagnostics_get(list, 0);
    return ambulo__error(s->diagnostics, status, ambulo__spot_place(s, (ambulo__spot){0, 0, 0}),
                         message ? message->hint : NULL, "case '%s': %s", s->cases[index].name,
                         message ? message->message : ambulo_status_text(status));
  }
  report_causes(s, list, causes);
  ambulo__spot spot = message->line > 0 ? spot_of_value(s, index, i) : s->axis[i].spot;
  return ambulo__error(s->diagnostics, status, ambulo__spot_place(s, spot), message->hint, "%s: %s",
                       s->axis[i].key, message->message);
}

/* Only what a value is in itself ends the sweep; whether the values of a case agree with each
 * other (E_PROBLEM, E_MODEL) is a result of that case. */
static ambulo_status probe(ambulo_sweep *s, int index) {
  const ambulo__sweep_case *one = &s->cases[index];
  ambulo_problem *problem = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(&s->allocator);
  if (!list) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__problem_load_known(s->base, one->override, one->overrides,
                                                    s->known, &s->allocator, list, &problem);
  ambulo_problem_free(problem);
  if (status == AMBULO_E_SCHEMA || status == AMBULO_E_PARSE || status == AMBULO_E_IO ||
      status == AMBULO_E_ARGUMENT)
    status = report_fault(s, index, status, list);
  else if (status != AMBULO_E_MEMORY)
    status = AMBULO_OK;
  ambulo_diagnostics_free(list);
  return status;
}

ambulo_status ambulo__sweep_check_cases(ambulo_sweep *s, const int *probed, int probes) {
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < probes && !status; i++) status = probe(s, probed[i]);
  return status ? status : names_differ(s);
}
