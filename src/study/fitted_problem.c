/* study/fitted_problem.c - see fitted_problem.h. Scalars are found by the line and column that the
 * document remembers, and must be there what the document says. */
#include "study/fitted_problem.h"

#include "formats/file_steps.h"
#include "base/numtext.h"
#include "formats/paths.h"
#include "formats/read_file.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_BYTES = 16 << 20, MOST_PLACES = AMBULO__FIT_PARAMETERS * AMBULO__FIT_KEYS + 256 };

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

/* --------------------------------------------------------------- what is changed */

static ambulo_status add_numbers(rewrite *w, ambulo__yaml *document, const double *u) {
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < w->fit->parameters; i++) {
    const ambulo__fit_parameter *p = &w->fit->parameter[i];
    for (int k = 0; k < p->keys && !status; k++) {
      char number[AMBULO__NUMTEXT_SIZE];
      if (isnan(p->in_file[k])) continue;
      const ambulo__yaml_node *node = ambulo__yaml_at(document, p->key[k]);
      if (!node) return AMBULO_E_PROBLEM;
      double value = ambulo__fit_value(p, p->in_file[k], u[i]);
      if (value == p->in_file[k]) continue;
      (void)ambulo__print_double(number, value);
      status = add(w, node, number);
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

/* --------------------------------------------------------------------- writing */

static int by_place(const void *left, const void *right) {
  const place *a = left, *b = right;
  return a->at < b->at ? -1 : a->at > b->at;
}

static void write_all(rewrite *w, ambulo__text_buffer *text) {
  size_t from = 0;
  qsort(w->places, (size_t)w->count, sizeof *w->places, by_place);
  for (int i = 0; i < w->count; i++) {
    ambulo__text_append_bytes(text, w->text + from, w->places[i].at - from);
    ambulo__text_append(text, w->places[i].with);
    from = w->places[i].at + w->places[i].length;
  }
  ambulo__text_append_bytes(text, w->text + from, w->length - from);
}

static ambulo_status rewrite_text(rewrite *w, const double *u, ambulo__text_buffer *text) {
  ambulo__yaml *document = NULL;
  ambulo_status status = ambulo__yaml_load_text(w->text, w->length, w->fit->problem,
                                                &w->fit->allocator, w->diagnostics, &document);
  if (!status) status = add_numbers(w, document, u);
  if (!status) {
    const ambulo__yaml_node *root = ambulo__yaml_root(document);
    const ambulo__yaml_node *model = ambulo__yaml_get(root, "model");
    if (model) status = add_name(w, model);
    if (!status) status = add_names(w, root, "reference");
  }
  if (!status) {
    write_all(w, text);
    status = ambulo__text_status(text);
  }
  ambulo__yaml_free(document);
  return status;
}

ambulo_status ambulo__fitted_problem(const ambulo_fit *fit, const double *u, const char *directory,
                                     ambulo_diagnostics *diagnostics, ambulo__text_buffer *text) {
  const ambulo_allocator *a = &fit->allocator;
  rewrite w = {.fit = fit, .diagnostics = diagnostics};
  char *own = NULL, *folder = ambulo__parent_path(a, fit->problem);
  char *way = folder ? ambulo__path_between(a, directory, folder) : NULL;
  w.places = ambulo__alloc(a, MOST_PLACES, sizeof *w.places);
  ambulo_status status = folder && w.places ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status && !way) status = ambulo__io_error(diagnostics, folder, "find the way to the folder");
  if (!status)
    status = ambulo__read_file(fit->problem, MOST_BYTES, a, diagnostics, &own, &w.length);
  w.text = own;
  w.way = way ? way : "";
  if (!status) status = rewrite_text(&w, u, text);
  for (int i = 0; i < w.count; i++) ambulo__free(a, w.places[i].with);
  ambulo__free(a, w.places);
  ambulo__free(a, own);
  ambulo__free(a, way);
  ambulo__free(a, folder);
  return status;
}
