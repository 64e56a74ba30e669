/* study/fit_keys.c - what the keys of the parameters are by themselves, and whether the problem can
 * be read with what the fit will ask of it (fit.h). */
#include "ambulo/problem.h"
#include "ambulo/tools/load.h"
#include "base/numtext.h"
#include "formats/text_hash.h"
#include "formats/read_file.h"
#include "study/fit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_PROBLEM_BYTES = 16 << 20 };

static const char model_lead[] = "model.";

/* ------------------------------------------------------------------ own values */

static int is_of_model(const char *path) {
  return strncmp(path, model_lead, sizeof model_lead - 1) == 0;
}

/* says at `node` what a list says first */
static ambulo_status retell(const ambulo__yaml_node *node, ambulo_status status, const char *lead,
                            const ambulo_diagnostics *list) {
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
static ambulo_status load_text(const ambulo_fit *fit, const ambulo__fit_condition *c,
                               ambulo_diagnostics *list, ambulo__yaml **document) {
  ambulo_status status = ambulo__yaml_load(fit->problem, &fit->allocator, list, document);
  for (int i = 0; c && i < c->sets && !status; i++) {
    const char *equals = strchr(c->set[i], '=');
    if (is_of_model(c->set[i])) continue;
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

static void check_factor(const ambulo__fit_parameter *p, const ambulo__yaml_node *node, int key,
                         double own) {
  if (p->scale == AMBULO__FIT_LINEAR || own != 0.0) return;
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, "scale: linear adds to it",
                           "'%s' is 0, which no factor changes; expected another number",
                           p->key[key]);
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
      ambulo_diagnostics_clear(list);
      int found = value_at(document, p->key[k], list, value);
      (void)snprintf(lead, sizeof lead, "key '%.120s' of the problem", p->key[k]);
      ambulo_status told = found || !c ? AMBULO_OK : retell(node, AMBULO_E_SCHEMA, lead, list);
      if (told == AMBULO_E_MEMORY) status = told;
      if (found && c) check_factor(p, node, k, *value);
    }
  }
  if (status && status != AMBULO_E_MEMORY)
    status = retell(ambulo__yaml_get(ambulo__yaml_root(fit->document), "problem"), status,
                    "the problem cannot be read", list);
  ambulo__yaml_free(document);
  ambulo_diagnostics_free(list);
  return status;
}

static ambulo_status allocate(ambulo_fit *fit) {
  for (int i = 0; i < fit->parameters; i++) {
    ambulo__fit_parameter *p = &fit->parameter[i];
    size_t keys = (size_t)p->keys;
    p->own = ambulo__alloc(&fit->allocator, keys * (size_t)fit->conditions, sizeof *p->own);
    p->in_file = ambulo__alloc(&fit->allocator, keys, sizeof *p->in_file);
    if (!p->own || !p->in_file) return AMBULO_E_MEMORY;
  }
  return AMBULO_OK;
}

/* ---------------------------------------------------------------------- trying */

/* Only what a value is in itself ends the fit: whether values agree is a result of a solve. */
static ambulo_status try_at(const ambulo_fit *fit, int condition, const double *u,
                            const ambulo__yaml_node *node, const char *lead) {
  const char **overrides = NULL;
  int count = 0;
  ambulo_problem *problem = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(&fit->allocator);
  if (!list) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__fit_overrides(fit, condition, u, &overrides, &count);
  if (!status)
    status = ambulo_problem_load(fit->problem, overrides, count, &fit->allocator, list, &problem);
  ambulo_problem_free(problem);
  ambulo__free(&fit->allocator, (void *)overrides);
  int own = status == AMBULO_E_SCHEMA || status == AMBULO_E_PARSE || status == AMBULO_E_IO ||
            status == AMBULO_E_ARGUMENT;
  if (own)
    status = retell(node, status, lead, list);
  else if (status != AMBULO_E_MEMORY)
    status = AMBULO_OK;
  ambulo_diagnostics_free(list);
  return status;
}

static ambulo_status try_bounds(const ambulo_fit *fit, int condition) {
  double u[AMBULO__FIT_PARAMETERS] = {0.0};
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < fit->parameters && !status; i++) {
    const ambulo__fit_parameter *p = &fit->parameter[i];
    const ambulo__yaml_node *range = ambulo__yaml_get(p->node, "range");
    for (int side = 0; side < 2 && !status; side++) {
      char lead[160];
      u[i] = side ? p->upper : p->lower;
      (void)snprintf(lead, sizeof lead, "with '%.64s' at its %s bound the problem cannot be read",
                     p->name, side ? "upper" : "lower");
      status = try_at(fit, condition, u, ambulo__yaml_item(range, side), lead);
    }
    u[i] = 0.0;
  }
  return status;
}

static ambulo_status try_all(const ambulo_fit *fit) {
  const double u[AMBULO__FIT_PARAMETERS] = {0.0};
  ambulo_status status = AMBULO_OK;
  int fitted = -1;
  for (int c = 0; c < fit->conditions && !status; c++) {
    const ambulo__fit_condition *condition = &fit->condition[c];
    char lead[160];
    if (fitted < 0 && !condition->held_out) fitted = c;
    (void)snprintf(lead, sizeof lead, "the problem cannot be read as condition '%.64s' sets it",
                   condition->name);
    status = try_at(fit, c, u, condition->set_node ? condition->set_node : condition->node, lead);
  }
  return status || fitted < 0 ? status : try_bounds(fit, fitted);
}

ambulo_status ambulo__fit_read_keys(ambulo_fit *fit) {
  char *text = NULL;
  size_t length = 0;
  ambulo_status status = ambulo__read_file(fit->problem, MOST_PROBLEM_BYTES, &fit->allocator,
                                           fit->diagnostics, &text, &length);
  if (!status) fit->hash = ambulo__hash_text(fit->hash, text);
  ambulo__free(&fit->allocator, text);
  if (status)
    return ambulo__yaml_error(ambulo__yaml_get(ambulo__yaml_root(fit->document), "problem"), status,
                              NULL, "the problem '%s' could not be read", fit->problem);
  status = allocate(fit);
  for (int c = -1; c < fit->conditions && !status; c++) {
    status = read_values(fit, c);
    /* the next condition would say the same of a key */
    if (!status) status = ambulo__yaml_finish(fit->document);
  }
  return status ? status : try_all(fit);
}
