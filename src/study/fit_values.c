/* study/fit_values.c - from u to numbers of the problem: what the keys are by themselves,
 * overrides, the problem file with fitted numbers (fit.h).
 *
 * Numbers are rounded to nine digits, so that what is solved is exactly what fitted.yaml and
 * fit.json say. In the file, scalars are found by the line and column that the document remembers,
 * and must be there what the document says. */
#include "base/diagnostics.h"
#include "base/numtext.h"
#include "definitions/problem_load.h"
#include "formats/atomic_file.h"
#include "formats/paths.h"
#include "study/fit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_PLACES = AMBULO__FIT_PARAMETERS * AMBULO__FIT_KEYS + 256 };

static double nine_digits(double value) {
  if (value == 0.0 || !isfinite(value)) return value;
  int place = 8 - (int)floor(log10(fabs(value)));
  if (place < -300 || place > 300) return value;
  /* powers of ten up to 22 are exact: divide by them rather than multiply by tenths */
  double power = pow(10.0, abs(place));
  return place >= 0 ? round(value * power) / power : round(value / power) * power;
}

double ambulo__fit_change(const ambulo__fit_parameter *p, double u) {
  double change = p->scale == AMBULO__FIT_LOG ? exp(p->step * u) : p->step * u;
  return fmin(p->range[1], fmax(p->range[0], change));
}

double ambulo__fit_value(const ambulo__fit_parameter *p, double own, double u) {
  if (u == 0.0) return own;
  double change = ambulo__fit_change(p, u);
  return nine_digits(p->scale == AMBULO__FIT_LOG ? own * change : own + change);
}

ambulo_status ambulo__fit_overrides(const ambulo_fit *fit, int condition, const double *u,
                                    const char ***overrides, int *count) {
  const ambulo__fit_condition *c = &fit->condition[condition];
  ambulo__text_buffer text;
  int n = c->sets;
  ambulo__text_init(&text, &fit->allocator);
  for (int i = 0; i < c->sets; i++)
    ambulo__text_append_bytes(&text, c->set[i], strlen(c->set[i]) + 1);
  for (int i = 0; i < fit->parameters; i++) {
    const ambulo__fit_parameter *p = &fit->parameter[i];
    const double *own = p->own + condition * p->keys;
    for (int k = 0; k < p->keys; k++, n++) {
      ambulo__text_append_format(&text, "%s=", p->key[k]);
      ambulo__text_append_number(&text, ambulo__fit_value(p, own[k], u[i]));
      ambulo__text_append_bytes(&text, "", 1);
    }
  }
  size_t head = (size_t)n * sizeof **overrides;
  char *block =
      ambulo__text_status(&text) ? NULL : ambulo__alloc(&fit->allocator, head + text.length, 1);
  if (block) {
    char *at = memcpy(block + head, ambulo__text_data(&text), text.length);
    *overrides = (const char **)(void *)block;
    *count = n;
    for (int i = 0; i < n; i++, at += strlen(at) + 1) (*overrides)[i] = at;
  }
  ambulo__text_free(&text);
  return block ? AMBULO_OK : AMBULO_E_MEMORY;
}

/* ------------------------------------------------------------------ own values */

/* reports at `node` the first error of a list */
static ambulo_status report_at(const ambulo__yaml_node *node, ambulo_status status,
                               const char *lead, const ambulo_diagnostics *list) {
  const ambulo_diagnostic *m = NULL;
  for (size_t i = 0; i < ambulo_diagnostics_count(list) && !m; i++) {
    m = ambulo_diagnostics_get(list, i);
    if (m->severity != AMBULO_ERROR) m = NULL;
  }
  if (m && m->status == AMBULO_E_MEMORY) status = AMBULO_E_MEMORY;
  return ambulo__yaml_error(node, status, m ? m->hint : NULL, "%s: %s", lead,
                            m ? m->message : ambulo_status_text(status));
}

/* the problem's text, with what a condition sets (NULL: as it is) */
static ambulo_status load_text(ambulo_fit *fit, const ambulo__fit_condition *c,
                               ambulo_diagnostics *list, ambulo__yaml **document) {
  ambulo_status status = ambulo__fit_read_text(fit, list);
  if (!status)
    status = ambulo__yaml_load_text(fit->text, fit->length, fit->problem, &fit->allocator, list,
                                    document);
  for (int i = 0; c && i < c->sets && !status; i++) {
    const char *equals = strchr(c->set[i], '=');
    if (strncmp(c->set[i], "model.", 6) == 0) continue;
    char *path = ambulo__strdup(&fit->allocator, c->set[i]);
    if (!path) return AMBULO_E_MEMORY;
    path[equals - c->set[i]] = '\0';
    /* what the problem's reader makes of a section that is not there is its own matter */
    status = ambulo__yaml_set(*document, path, equals + 1);
    if (status != AMBULO_E_MEMORY) status = AMBULO_OK;
    ambulo__free(&fit->allocator, path);
  }
  return status;
}

/* *value of a key; 0: there is none, and the list says why */
static int value_at(ambulo__yaml *document, const char *key, ambulo_diagnostics *list,
                    double *value) {
  const ambulo__yaml_node *node = ambulo__yaml_at(document, key);
  if (!node) return 0;
  if (ambulo__yaml_is(node, AMBULO__YAML_SCALAR)) {
    const char *text = ambulo__yaml_text(node);
    if (ambulo__parse_double(text, strlen(text), value)) return 1;
  }
  (void)ambulo__error(list, AMBULO_E_SCHEMA, ambulo__nowhere, NULL,
                      "no number stands there; expected a key with one");
  return 0;
}

/* index: of the condition; -1: as the file is, where a key may lack */
static ambulo_status read_values(ambulo_fit *fit, int index) {
  static const char *const kinds[] = {"problem"};
  const ambulo__fit_condition *c = index < 0 ? NULL : &fit->condition[index];
  ambulo_diagnostics *list = ambulo_diagnostics_create(&fit->allocator);
  ambulo__yaml *document = NULL;
  ambulo_status status = list ? load_text(fit, c, list, &document) : AMBULO_E_MEMORY;
  if (!status && ambulo__yaml_file_kind(ambulo__yaml_root(document), kinds, 1) < 0)
    status = AMBULO_E_SCHEMA;
  for (int i = 0; i < fit->parameters && !status; i++) {
    ambulo__fit_parameter *p = &fit->parameter[i];
    for (int k = 0; k < p->keys && !status; k++) {
      double *value = c ? &p->own[index * p->keys + k] : &p->in_file[k];
      const ambulo__yaml_node *keys = ambulo__yaml_get(p->node, "keys");
      const ambulo__yaml_node *node = ambulo__yaml_item(keys, k);
      char lead[200];
      *value = (double)NAN;
      ambulo__diagnostics_clear(list);
      int found = value_at(document, p->key[k], list, value);
      (void)snprintf(lead, sizeof lead, "key '%.120s' of the problem", p->key[k]);
      ambulo_status error = found || !c ? AMBULO_OK : report_at(node, AMBULO_E_SCHEMA, lead, list);
      if (error == AMBULO_E_MEMORY) status = error;
      if (found && c && p->scale == AMBULO__FIT_LOG && *value == 0.0)
        (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, "scale: linear adds to it",
                                 "'%s' is 0, which no factor changes; expected another number",
                                 p->key[k]);
    }
  }
  if (status && status != AMBULO_E_MEMORY)
    status = report_at(ambulo__yaml_get(ambulo__yaml_root(fit->document), "problem"), status,
                       "the problem cannot be read", list);
  ambulo__yaml_free(document);
  ambulo_diagnostics_free(list);
  return status;
}

/* ---------------------------------------------------------------------- trying */

/* Only what a value is in itself ends the fit: whether values agree is a result of a solve. */
static ambulo_status try_at(ambulo_fit *fit, int condition, const double *u,
                            const ambulo__yaml_node *node, const char *lead) {
  const char **overrides = NULL;
  int count = 0;
  ambulo_problem *problem = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(&fit->allocator);
  if (!list) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__fit_overrides(fit, condition, u, &overrides, &count);
  if (!status)
    status = ambulo__problem_load_known(fit->problem, overrides, count, &fit->known,
                                        &fit->allocator, list, &problem);
  ambulo_problem_free(problem);
  ambulo__free(&fit->allocator, (void *)overrides);
  int own = status == AMBULO_E_SCHEMA || status == AMBULO_E_PARSE || status == AMBULO_E_IO ||
            status == AMBULO_E_ARGUMENT;
  if (own)
    status = report_at(node, status, lead, list);
  else if (status != AMBULO_E_MEMORY)
    status = AMBULO_OK;
  ambulo_diagnostics_free(list);
  return status;
}

/* all conditions at u = 0, and of one that is fitted both bounds of each parameter */
static ambulo_status try_all(ambulo_fit *fit) {
  double u[AMBULO__FIT_PARAMETERS] = {0.0};
  ambulo_status status = AMBULO_OK;
  char lead[160];
  int fitted = 0;
  for (int c = fit->conditions - 1; c >= 0 && !status; c--) {
    const ambulo__fit_condition *condition = &fit->condition[c];
    if (!condition->held_out) fitted = c;
    (void)snprintf(lead, sizeof lead, "the problem cannot be read as condition '%.64s' sets it",
                   condition->name);
    status = try_at(fit, c, u, condition->set_node ? condition->set_node : condition->node, lead);
  }
  for (int k = 0; k < 2 * fit->parameters && !status; k++) {
    const ambulo__fit_parameter *p = &fit->parameter[k / 2];
    const ambulo__yaml_node *range = ambulo__yaml_get(p->node, "range");
    u[k / 2] = k % 2 ? p->upper : p->lower;
    (void)snprintf(lead, sizeof lead, "with '%.64s' at its %s bound the problem cannot be read",
                   p->name, k % 2 ? "upper" : "lower");
    status = try_at(fit, fitted, u, ambulo__yaml_item(range, k % 2), lead);
    u[k / 2] = 0.0;
  }
  return status;
}

ambulo_status ambulo__fit_read_keys(ambulo_fit *fit) {
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < fit->parameters; i++) {
    ambulo__fit_parameter *p = &fit->parameter[i];
    size_t keys = (size_t)p->keys, conditions = (size_t)fit->conditions;
    p->own = ambulo__alloc(&fit->allocator, keys * conditions, sizeof *p->own);
    p->in_file = ambulo__alloc(&fit->allocator, keys, sizeof *p->in_file);
    if (!p->own || !p->in_file) return AMBULO_E_MEMORY;
  }
  for (int c = -1; c < fit->conditions && !status; c++) {
    status = read_values(fit, c);
    /* the next condition would say the same of a key */
    if (!status) status = ambulo__yaml_finish(fit->document);
  }
  return status ? status : try_all(fit);
}

/* ------------------------------------------------------- the problem with new numbers */

/* text[at .. at + length) becomes `with` */
typedef struct place {
  size_t at, length;
  char *with;
} place;

typedef struct rewrite {
  const ambulo_fit *fit;
  ambulo_diagnostics *diagnostics;
  const char *text;
  size_t length;
  const char *way; /* from the new folder to the problem's */
  place *places;   /* [MOST_PLACES] */
  int count;
} rewrite;

/* byte of a line and a column, which counts characters */
static size_t offset_of(const rewrite *w, int line, int column) {
  size_t at = 0;
  if (w->length >= 3 && memcmp(w->text, "\xef\xbb\xbf", 3) == 0) at = 3;
  for (int l = 1; l < line && at < w->length; at++) l += w->text[at] == '\n';
  for (int c = 1; c < column && at < w->length; c++) {
    at++;
    while (at < w->length && ((unsigned char)w->text[at] & 0xc0U) == 0x80U) at++;
  }
  return at;
}

/* length of the scalar at `at` as it is written, quotes and all; 0: it is not the one expected */
static size_t length_of(const rewrite *w, size_t at, const char *word) {
  size_t size = strlen(word);
  char quote = at < w->length ? w->text[at] : '\0';
  if (quote != '"' && quote != '\'')
    return size <= w->length - at && memcmp(w->text + at, word, size) == 0 ? size : 0;
  for (size_t end = at + 1; end < w->length; end++) {
    if (quote == '"' && w->text[end] == '\\')
      end++;
    else if (quote == '\'' && w->text[end] == quote && w->text[end + 1] == quote)
      end++;
    else if (w->text[end] == quote)
      return end + 1 - at;
  }
  return 0;
}

static ambulo_status add(rewrite *w, const ambulo__yaml_node *node, const char *with) {
  ambulo__place at = ambulo__yaml_place(node);
  size_t offset = offset_of(w, at.line, at.column);
  size_t length = length_of(w, offset, ambulo__yaml_text(node));
  if (length == 0)
    return ambulo__error(w->diagnostics, AMBULO_E_PROBLEM, at, NULL,
                         "the problem file changed while it was fitted; expected it as it was");
  if (w->count == MOST_PLACES)
    return ambulo__error(w->diagnostics, AMBULO_E_LIMIT, at, NULL,
                         "more than %d places to be changed in one problem file", MOST_PLACES);
  place *p = &w->places[w->count];
  *p = (place){offset, length, ambulo__strdup(&w->fit->allocator, with)};
  if (!p->with) return AMBULO_E_MEMORY;
  w->count++;
  return AMBULO_OK;
}

static ambulo_status add_numbers(rewrite *w, ambulo__yaml *document, const double *u) {
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < w->fit->parameters; i++) {
    const ambulo__fit_parameter *p = &w->fit->parameter[i];
    for (int k = 0; k < p->keys && !status; k++) {
      if (isnan(p->in_file[k])) continue;
      const ambulo__yaml_node *node = ambulo__yaml_at(document, p->key[k]);
      if (!node) return AMBULO_E_PROBLEM;
      double value = ambulo__fit_value(p, p->in_file[k], u[i]);
      if (value == p->in_file[k]) continue;
      status = add(w, node, ambulo__number_text(value).text);
    }
  }
  return status;
}

/* *yes: the name is found from anywhere, since it is that of a shipped file that the problem takes,
 * by the name or as its neighbour */
static ambulo_status is_shipped(const ambulo_fit *fit, const char *name, int *yes) {
  const ambulo_allocator *a = &fit->allocator;
  char *taken = NULL, *shipped = NULL, *beside = ambulo__sibling_path(a, fit->problem, name);
  ambulo_status status = beside ? ambulo__shipped_path(a, beside, name, &taken) : AMBULO_E_MEMORY;
  if (!status) status = ambulo__shipped_path(a, "", name, &shipped);
  *yes = taken || (shipped && strcmp(shipped, beside) == 0);
  ambulo__free(a, taken);
  ambulo__free(a, shipped);
  ambulo__free(a, beside);
  return status;
}

static ambulo_status add_name(rewrite *w, const ambulo__yaml_node *node) {
  const char *name = ambulo__yaml_text(node);
  int shipped = 0;
  if (!name[0] || name[0] == '/' || !w->way[0]) return AMBULO_OK;
  if (is_shipped(w->fit, name, &shipped)) return AMBULO_E_MEMORY;
  if (shipped) return AMBULO_OK; /* found by its name from anywhere */
  ambulo__text_buffer text;
  ambulo__text_init(&text, &w->fit->allocator);
  ambulo__text_append_char(&text, '"');
  for (const char *part = w->way; part; part = part == w->way ? name : NULL)
    for (const char *c = part; *c; c++) {
      if (*c == '"' || *c == '\\') ambulo__text_append_char(&text, '\\');
      ambulo__text_append_char(&text, *c);
    }
  ambulo__text_append_char(&text, '"');
  ambulo_status status = ambulo__text_status(&text);
  if (!status) status = add(w, node, ambulo__text_data(&text));
  ambulo__text_free(&text);
  return status;
}

/* each scalar under `key`, wherever it stands */
static ambulo_status add_names(rewrite *w, const ambulo__yaml_node *node, const char *key) {
  ambulo_status status = AMBULO_OK;
  int is_list = ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE);
  if (!is_list && !ambulo__yaml_is(node, AMBULO__YAML_MAPPING)) return AMBULO_OK;
  int count = is_list ? ambulo__yaml_items(node) : ambulo__yaml_pairs(node);
  for (int i = 0; i < count && !status; i++) {
    const ambulo__yaml_node *child =
        is_list ? ambulo__yaml_item(node, i) : ambulo__yaml_value(node, i);
    int is_name = !is_list && strcmp(ambulo__yaml_key(node, i), key) == 0 &&
                  ambulo__yaml_is(child, AMBULO__YAML_SCALAR);
    status = is_name ? add_name(w, child) : add_names(w, child, key);
  }
  return status;
}

static int by_place(const void *left, const void *right) {
  const place *a = left, *b = right;
  return a->at < b->at ? -1 : a->at > b->at;
}

static ambulo_status rewrite_text(rewrite *w, const double *u, ambulo__text_buffer *text) {
  ambulo__yaml *document = NULL;
  size_t from = 0;
  ambulo_status status = ambulo__yaml_load_text(w->text, w->length, w->fit->problem,
                                                &w->fit->allocator, w->diagnostics, &document);
  if (!status) status = add_numbers(w, document, u);
  if (!status) status = add_names(w, ambulo__yaml_root(document), "model");
  if (!status) status = add_names(w, ambulo__yaml_root(document), "reference");
  ambulo__yaml_free(document);
  if (status) return status;
  qsort(w->places, (size_t)w->count, sizeof *w->places, by_place);
  for (int i = 0; i < w->count; i++) {
    ambulo__text_append_bytes(text, w->text + from, w->places[i].at - from);
    ambulo__text_append(text, w->places[i].with);
    from = w->places[i].at + w->places[i].length;
  }
  ambulo__text_append_bytes(text, w->text + from, w->length - from);
  return ambulo__text_status(text);
}

ambulo_status ambulo__fitted_problem(const ambulo_fit *fit, const double *u, const char *directory,
                                     ambulo_diagnostics *diagnostics, ambulo__text_buffer *text) {
  const ambulo_allocator *a = &fit->allocator;
  rewrite w = {.fit = fit, .diagnostics = diagnostics};
  char *folder = ambulo__parent_path(a, fit->problem);
  char *way = folder ? ambulo__path_between(a, directory, folder) : NULL;
  w.places = ambulo__alloc(a, MOST_PLACES, sizeof *w.places);
  ambulo_status status = folder && w.places ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status && !way) status = ambulo__io_error(diagnostics, folder, "find the way to the folder");
  w.text = fit->text;
  w.length = fit->length;
  w.way = way ? way : "";
  if (!status) status = rewrite_text(&w, u, text);
  for (int i = 0; i < w.count; i++) ambulo__free(a, w.places[i].with);
  ambulo__free(a, w.places);
  ambulo__free(a, way);
  ambulo__free(a, folder);
  return status;
}
