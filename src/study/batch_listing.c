/* study/batch_listing.c - reading a batch folder's own description (listing.h). */
#include "study/batch_listing.h"
#include "formats/file_steps.h"
#include "formats/paths.h"
#include "formats/read_file.h"
#include "formats/seal.h"
#include "formats/yaml_node.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define MOST_LIST_BYTES ((size_t)2 << 30)
#define MOST_DESCRIPTION_BYTES ((size_t)16 << 20)

/* ----------------------------------------------------------------- cases.tsv */

/* inside this file; a caller gets E_IO */
static const ambulo_status DAMAGED = AMBULO_E_PARSE;

static ambulo_status corrupt(ambulo_diagnostics *diagnostics, const char *path, int line) {
  ambulo__place place = {path, line, 0, NULL};
  (void)ambulo__error(diagnostics, AMBULO_E_IO, place, "run the batch again to rewrite it",
                      "damaged: the list of cases is not what was written");
  return DAMAGED;
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

/* 16 hexadecimal digits */
static int is_key(const char *text) {
  return strlen(text) == 16 && strspn(text, "0123456789abcdef") == 16;
}

static ambulo_status check_keys(const ambulo__listing *l, const char *path,
                                ambulo_diagnostics *diagnostics) {
  for (int k = 0; k < l->cases; k++)
    if (!is_key(ambulo__listing_cell(l, k, AMBULO__LISTING_KEY)))
      return corrupt(diagnostics, path, k + 2);
  return AMBULO_OK;
}

/* ---------------------------------------------------------------- batch.json */

static char *copy_text(const ambulo__listing *l, const ambulo__yaml_node *root, const char *key) {
  return ambulo__strdup(&l->allocator, ambulo__yaml_text(ambulo__yaml_require(root, key)));
}

static void free_texts(const ambulo_allocator *a, char **texts, int count) {
  for (int i = 0; texts && i < count; i++) ambulo__free(a, texts[i]);
  ambulo__free(a, texts);
}

/* *texts of the list under a key, which has `count` of them; *right = 0: another number */
static ambulo_status copy_texts(const ambulo__listing *l, const ambulo__yaml_node *root,
                                const char *key, int count, char ***texts, int *right) {
  const ambulo__yaml_node *node = ambulo__yaml_require(root, key);
  *right &= ambulo__yaml_items(node) == count;
  *texts = ambulo__alloc(&l->allocator, (size_t)count, sizeof **texts);
  for (int i = 0; *texts && i < count; i++) {
    (*texts)[i] = ambulo__strdup(&l->allocator, ambulo__yaml_text(ambulo__yaml_item(node, i)));
    if (!(*texts)[i]) return AMBULO_E_MEMORY;
  }
  return *texts ? AMBULO_OK : AMBULO_E_MEMORY;
}

/* `front`, where the batch is one; its terms are the axes */
static ambulo_status read_front(ambulo__listing *l, const ambulo__yaml_node *node, int *right) {
  if (!node) return AMBULO_OK;
  ambulo__listing_front *f = &l->front;
  int terms = ambulo__yaml_items(ambulo__yaml_require(node, "terms"));
  *right &= terms == l->axes && terms >= 2 && terms <= AMBULO__FRONT_TERMS;
  if (!*right) return AMBULO_OK;
  f->terms = terms;
  f->points = ambulo__yaml_integer(ambulo__yaml_require(node, "points"), 2, INT_MAX, 2);
  f->least = ambulo__yaml_number(ambulo__yaml_require(node, "least"), 0.0);
  const ambulo__yaml_node *own = ambulo__yaml_require(node, "weights");
  for (int i = 0; i < terms; i++) f->own[i] = ambulo__yaml_number(ambulo__yaml_item(own, i), 0.0);
  l->front_text = copy_text(l, node, "text");
  ambulo_status status = copy_texts(l, node, "terms", terms, &f->name, right);
  return l->front_text ? status : AMBULO_E_MEMORY;
}

/* E_MEMORY, or AMBULO_OK, and then the document knows what was wrong, or *cases is -1 */
static ambulo_status read_fields(ambulo__listing *l, const ambulo__yaml_node *root, int *cases) {
  int right = 1;
  l->name = copy_text(l, root, "name");
  l->version = copy_text(l, root, "version");
  l->problem_hash = copy_text(l, root, "problem_hash");
  l->text_hash = copy_text(l, root, "text_hash");
  l->digest = copy_text(l, root, "cases_sha256");
  if (!l->name || !l->version || !l->problem_hash || !l->text_hash || !l->digest)
    return AMBULO_E_MEMORY;
  *cases = ambulo__yaml_integer(ambulo__yaml_require(root, "cases"), 0, INT_MAX, 0);
  l->outputs = ambulo__yaml_items(ambulo__yaml_require(root, "outputs"));
  l->axes = ambulo__yaml_items(ambulo__yaml_require(root, "axes"));
  l->zipped = ambulo__yaml_integer(ambulo__yaml_require(root, "zipped_axes"), 0, l->axes, 0);
  const struct {
    const char *key;
    int count;
    char ***texts;
  } lists[] = {{"outputs", l->outputs, &l->output},
               {"output_labels", l->outputs, &l->output_label},
               {"output_units", l->outputs, &l->output_unit},
               {"axis_labels", l->axes, &l->axis_label},
               {"axis_units", l->axes, &l->axis_unit}};
  ambulo_status status = AMBULO_OK;
  for (size_t i = 0; i < sizeof lists / sizeof *lists && !status; i++)
    status = copy_texts(l, root, lists[i].key, lists[i].count, lists[i].texts, &right);
  if (!status) status = read_front(l, ambulo__yaml_get(root, "front"), &right);
  if (!right) *cases = -1;
  return status;
}

static ambulo_status other_version(ambulo_diagnostics *diagnostics, const char *path,
                                   const char *own) {
  int earlier = strcmp(own, AMBULO__LISTING_WITHOUT_CHECKSUMS) == 0;
  ambulo__place place = {path, 0, 0, NULL};
  return ambulo__error(
      diagnostics, AMBULO_E_PROBLEM, place,
      "'ambulo batch' with --force computes its cases again; or give another folder",
      "the folder was filled by %s version of ambulo (%.40s%s); expected %s",
      earlier ? "an earlier" : "another", own, earlier ? ", without checksums" : "",
      AMBULO__LISTING_SCHEMA);
}

/* *cases: as many as batch.json says */
static ambulo_status read_description(ambulo__listing *l, const char *path,
                                      ambulo_diagnostics *diagnostics, int *cases) {
  char *text = NULL;
  size_t length = 0;
  ambulo__yaml *document = NULL;
  ambulo_status status =
      ambulo__read_file(path, MOST_DESCRIPTION_BYTES, &l->allocator, diagnostics, &text, &length);
  if (status) return status;
  status = ambulo__yaml_load_text(text, length, path, &l->allocator, NULL, &document);
  if (!status) {
    const ambulo__yaml_node *root = ambulo__yaml_root(document);
    const char *own = ambulo__yaml_text(ambulo__yaml_require(root, "schema"));
    int sealed = ambulo__seal_holds(text, length);
    if (strcmp(own, AMBULO__LISTING_WITHOUT_CHECKSUMS) == 0 ||
        (sealed && strcmp(own, AMBULO__LISTING_SCHEMA) != 0)) {
      status = other_version(diagnostics, path, own);
    } else if (!sealed) {
      status = corrupt(diagnostics, path, 0);
    } else {
      status = read_fields(l, root, cases);
      if (!status && (*cases < 0 || ambulo__yaml_finish(document)))
        status = corrupt(diagnostics, path, 0);
    }
  } else if (status != AMBULO_E_MEMORY) {
    status = corrupt(diagnostics, path, 0);
  }
  ambulo__yaml_free(document);
  ambulo__free(&l->allocator, text);
  return status;
}

static ambulo_status read_cases(ambulo__listing *l, const char *path, int cases,
                                ambulo_diagnostics *diagnostics) {
  char digest[AMBULO__SHA256_TEXT];
  size_t length = 0;
  struct stat entry;
  if (stat(path, &entry) != 0 && errno == ENOENT) return corrupt(diagnostics, path, 0);
  ambulo_status status =
      ambulo__read_file(path, MOST_LIST_BYTES, &l->allocator, diagnostics, &l->text, &length);
  if (status) return status;
  ambulo__sha256_of(l->text, length, digest);
  if (strcmp(digest, l->digest) != 0 || length == 0) return corrupt(diagnostics, path, 0);
  status = cut(l, length, path, diagnostics);
  if (!status && (l->columns != AMBULO__LISTING_AXES + l->axes || l->cases != cases))
    status = corrupt(diagnostics, path, 1);
  return status ? status : check_keys(l, path, diagnostics);
}

ambulo_status ambulo__listing_try(const char *directory, const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo__listing *listing,
                                  int *damaged) {
  ambulo__listing l;
  int cases = 0;
  memset(&l, 0, sizeof l);
  l.allocator = ambulo__allocator_or_default(allocator);
  char *list = ambulo__join_paths(&l.allocator, directory, "cases.tsv", NULL);
  char *description = ambulo__join_paths(&l.allocator, directory, "batch.json", NULL);
  ambulo_status status = list && description ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = read_description(&l, description, diagnostics, &cases);
  if (!status) status = read_cases(&l, list, cases, diagnostics);
  ambulo__free(&l.allocator, list);
  ambulo__free(&l.allocator, description);
  *damaged = status == DAMAGED;
  if (status) {
    ambulo__listing_free(&l);
  } else {
    *listing = l;
  }
  return *damaged ? AMBULO_E_IO : status;
}

ambulo_status ambulo__listing_load(const char *directory, const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo__listing *listing) {
  int damaged;
  ambulo_status status = ambulo__expect_path(directory, "batch folder", diagnostics);
  if (status) return status;
  return ambulo__listing_try(directory, allocator, diagnostics, listing, &damaged);
}

void ambulo__listing_free(ambulo__listing *l) {
  const ambulo_allocator *a = &l->allocator;
  free_texts(a, l->output, l->outputs);
  free_texts(a, l->output_label, l->outputs);
  free_texts(a, l->output_unit, l->outputs);
  free_texts(a, l->axis_label, l->axes);
  free_texts(a, l->axis_unit, l->axes);
  free_texts(a, l->front.name, l->front.terms);
  ambulo__free(a, l->front_text);
  ambulo__free(a, l->digest);
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

int ambulo__listing_output(const ambulo__listing *l, const char *name) {
  for (int i = 0; i < l->outputs; i++)
    if (strcmp(l->output_label[i], name) == 0 || strcmp(l->output[i], name) == 0) return i;
  return -1;
}

unsigned long long ambulo__listing_key(const ambulo__listing *l, int index) {
  return strtoull(ambulo__listing_cell(l, index, AMBULO__LISTING_KEY), NULL, 16);
}
