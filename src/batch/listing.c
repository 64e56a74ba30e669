/* batch/listing.c - reading a batch folder's own description (listing.h). */
#include "batch/listing.h"
#include "base/read_file.h"
#include "base/yaml_node.h"
#include "batch/paths.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST_LIST_BYTES ((size_t)2 << 30)

static ambulo_status corrupt(ambulo_diagnostics *diagnostics, const char *path, int line) {
  ambulo__place place = {path, line, 0, NULL};
  return ambulo__error(diagnostics, AMBULO_E_PARSE, place, "run the batch again to rewrite it",
                       "the list of cases is damaged; expected one line of cells a case");
}

/* cuts the text into cells; every line has as many as the first */
static ambulo_status cut(ambulo__listing *l, size_t length, const char *path,
                         ambulo_diagnostics *diagnostics) {
  int lines = 0, columns = 1;
  for (size_t i = 0; i < length; i++) lines += l->text[i] == '\n';
  for (const char *c = l->text; *c && *c != '\n'; c++) columns += *c == '\t';
  if (lines < 1 || columns < AMBULO__LISTING_AXES || l->text[length - 1] != '\n')
    return corrupt(diagnostics, path, 1);
  l->cell = ambulo__alloc(&l->allocator, (size_t)lines * (size_t)columns, sizeof *l->cell);
  if (!l->cell) return AMBULO_E_MEMORY;
  l->cases = lines - 1;
  l->columns = columns;
  char *c = l->text;
  for (int line = 0; line < lines; line++) {
    for (int column = 0; column < columns; column++) {
      l->cell[(size_t)line * (size_t)columns + (size_t)column] = c;
      c += strcspn(c, "\t\n");
      if (*c != (column + 1 < columns ? '\t' : '\n')) return corrupt(diagnostics, path, line + 1);
      *c++ = '\0';
    }
  }
  return AMBULO_OK;
}

static char *copy_text(const ambulo__listing *l, const ambulo__yaml_node *node) {
  const char *text = node ? ambulo__yaml_text(node) : NULL;
  return text ? ambulo__strdup(&l->allocator, text) : NULL;
}

static void free_texts(const ambulo_allocator *a, char **texts, int count) {
  for (int i = 0; texts && i < count; i++) ambulo__free(a, texts[i]);
  ambulo__free(a, texts);
}

/* a list of `count` texts under a key; NULL: another list, or no memory */
static char **copy_texts(const ambulo__listing *l, const ambulo__yaml_node *root, const char *key,
                         int count) {
  const ambulo__yaml_node *node = ambulo__yaml_require(root, key);
  char **texts = ambulo__alloc(&l->allocator, (size_t)count, sizeof *texts);
  int copied = 0;
  for (int i = 0; texts && node && i < count && i < ambulo__yaml_count(node); i++) {
    texts[i] = copy_text(l, ambulo__yaml_item(node, i));
    copied += texts[i] != NULL;
  }
  if (copied == count) return texts;
  free_texts(&l->allocator, texts, count);
  return NULL;
}

static ambulo_status read_description(ambulo__listing *l, const char *path,
                                      ambulo_diagnostics *diagnostics) {
  ambulo__yaml *document = NULL;
  ambulo_status status = ambulo__yaml_load(path, &l->allocator, diagnostics, &document);
  if (status) return status;
  const ambulo__yaml_node *root = ambulo__yaml_root(document);
  l->name = copy_text(l, ambulo__yaml_require(root, "name"));
  l->version = copy_text(l, ambulo__yaml_require(root, "version"));
  l->problem_hash = copy_text(l, ambulo__yaml_require(root, "problem_hash"));
  l->text_hash = copy_text(l, ambulo__yaml_require(root, "text_hash"));
  l->outputs = ambulo__yaml_count(ambulo__yaml_get(root, "outputs"));
  l->axes = ambulo__yaml_count(ambulo__yaml_get(root, "axis_units"));
  l->output = copy_texts(l, root, "outputs", l->outputs);
  l->output_unit = copy_texts(l, root, "output_units", l->outputs);
  l->axis_unit = copy_texts(l, root, "axis_units", l->axes);
  status = ambulo__yaml_finish(document);
  if (!status && (!l->output || !l->output_unit || !l->axis_unit || !l->name || !l->version ||
                  !l->problem_hash || !l->text_hash))
    status = AMBULO_E_MEMORY;
  ambulo__yaml_free(document);
  return status;
}

ambulo_status ambulo__listing_load(const char *directory, const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo__listing *listing) {
  ambulo__listing l;
  memset(&l, 0, sizeof l);
  l.allocator = ambulo__allocator_or_default(allocator);
  size_t length = 0;
  char *list = ambulo__join_paths(&l.allocator, directory, "cases.tsv", NULL);
  char *description = ambulo__join_paths(&l.allocator, directory, "batch.json", NULL);
  ambulo_status status = list && description ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = read_description(&l, description, diagnostics);
  if (!status)
    status = ambulo__read_file(list, MOST_LIST_BYTES, &l.allocator, diagnostics, &l.text, &length);
  if (!status) status = length ? cut(&l, length, list, diagnostics) : corrupt(diagnostics, list, 1);
  if (!status && l.columns != AMBULO__LISTING_AXES + l.axes) status = corrupt(diagnostics, list, 1);
  ambulo__free(&l.allocator, list);
  ambulo__free(&l.allocator, description);
  if (status) {
    ambulo__listing_free(&l);
  } else {
    *listing = l;
  }
  return status;
}

void ambulo__listing_free(ambulo__listing *l) {
  const ambulo_allocator *a = &l->allocator;
  free_texts(a, l->output, l->outputs);
  free_texts(a, l->output_unit, l->outputs);
  free_texts(a, l->axis_unit, l->axes);
  ambulo__free(a, l->name);
  ambulo__free(a, l->version);
  ambulo__free(a, l->problem_hash);
  ambulo__free(a, l->text_hash);
  ambulo__free(a, (void *)l->cell);
  ambulo__free(a, l->text);
  ambulo__listing empty;
  memset(&empty, 0, sizeof empty);
  empty.allocator = *a;
  *l = empty;
}

const char *ambulo__listing_cell(const ambulo__listing *l, int index, int column) {
  return l->cell[((size_t)index + 1) * (size_t)l->columns + (size_t)column];
}

const char *ambulo__listing_title(const ambulo__listing *l, int column) {
  return l->cell[column];
}

int ambulo__listing_key(const ambulo__listing *l, int index, unsigned long long *key) {
  const char *text = ambulo__listing_cell(l, index, AMBULO__LISTING_KEY);
  char *end = NULL;
  *key = strtoull(text, &end, 16);
  return end != text && *end == '\0';
}
