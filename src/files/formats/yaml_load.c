/* formats/yaml_load.c - from a file to a document; which of the formats it is in, and what to do
 * with the wrong one. */
#include "formats/atomic_file.h"
#include "formats/foreign_format.h"
#include "formats/read_file.h"
#include "formats/yaml_tree.h"

#include <stdio.h>
#include <string.h>

/* --------------------------------------------------------------------- loading */

static ambulo_status check_root(const ambulo__yaml *document, size_t length) {
  static const char *const kinds[] = {"scalar", "sequence", "mapping"};
  const ambulo__yaml_node *root = document->root;
  ambulo__place place = {document->file, 1, 1, NULL};
  if (!root || (root->kind == AMBULO__YAML_SCALAR && !root->quoted && root->text[0] == '\0')) {
    return ambulo__error(document->diagnostics, AMBULO_E_PARSE, place, NULL,
                         "%s; expected YAML: lines 'key: value'",
                         length ? "nothing but blank lines and comments" : "the file is empty");
  }
  if (root->kind != AMBULO__YAML_MAPPING) {
    return ambulo__error(document->diagnostics, AMBULO_E_SCHEMA, ambulo__yaml_place(root),
                         "the file should hold YAML: lines 'key: value'",
                         "got a %s at the top level; expected a mapping", kinds[root->kind]);
  }
  return AMBULO_OK;
}

static ambulo_status fill(ambulo__yaml *document, const char *text, size_t length,
                          const char *name) {
  ambulo__place place = {name, 0, 0, NULL};
  if (length > AMBULO__YAML_MAX_BYTES) {
    return ambulo__error(document->diagnostics, AMBULO_E_LIMIT, place, NULL,
                         "text too large (got %zu bytes); expected at most %d", length,
                         AMBULO__YAML_MAX_BYTES);
  }
  if (name) {
    document->file = ambulo__arena_copy(&document->arena, name, strlen(name));
    if (!document->file) return ambulo__io_memory_error(document->diagnostics, name);
  }
  ambulo_status status = ambulo__refuse_foreign(text, length, AMBULO__TAKES_YAML, document->file,
                                                document->diagnostics);
  if (status == AMBULO_OK)
    status = ambulo__yaml_parse(document, text, length, document->file, 0, &document->root);
  return status == AMBULO_OK ? check_root(document, length) : status;
}

ambulo_status ambulo__yaml_load_text(const char *text, size_t length, const char *name,
                                     const ambulo_allocator *allocator,
                                     ambulo_diagnostics *diagnostics, ambulo__yaml **document) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo__yaml *made = ambulo__alloc(&own, 1, sizeof *made);
  if (!made) return ambulo__io_memory_error(diagnostics, name);
  made->arena.allocator = own;
  made->diagnostics = diagnostics;
  ambulo_status status = fill(made, text, length, name);
  if (status == AMBULO_OK) {
    *document = made;
  } else {
    ambulo__yaml_free(made);
  }
  return status;
}

ambulo_status ambulo__yaml_load(const char *path, const ambulo_allocator *allocator,
                                ambulo_diagnostics *diagnostics, ambulo__yaml **document) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  char *text = NULL;
  size_t length = 0;
  ambulo_status status =
      ambulo__read_file(path, AMBULO__YAML_MAX_BYTES, &own, diagnostics, &text, &length);
  if (status != AMBULO_OK) return status;
  status = ambulo__yaml_load_text(text, length, path, &own, diagnostics, document);
  ambulo__free(&own, text);
  return status;
}

/* -------------------------------------------------------------------- which format */

enum { MAX_TEXT = 200 };

/* A format: its word under `kind`, what people call it, a key that only it has (a guess, where
 * `kind` is missing), and who takes it. */
typedef struct format {
  const char *kind, *name, *key, *hint;
} format;

static const format formats[] = {
    {"summary", "the summary of a result", "schema",
     "the problem is the YAML file it was solved from"},
    {"model", "a skeleton model", "links", "a problem names its skeleton under 'model:'"},
    {"problem", "a problem", "objective", "ambulo solve, evaluate and check take it"},
    {"solution", "a solution", "control_points", "ambulo evaluate takes it, and solve --start"},
    {"sweep", "a sweep", "axes",
     "ambulo batch takes it; its --dry-run checks it and lists the cases"},
    {"fit", "a fit", "conditions", "ambulo fit takes it"},
    {"muscles", "a file of muscles", "muscles", "ambulo muscles takes it, as --muscles"},
};
enum { FORMAT_COUNT = sizeof formats / sizeof formats[0] };

static const format *of_kind(const char *kind) {
  for (int i = 0; i < FORMAT_COUNT; i++)
    if (strcmp(kind, formats[i].kind) == 0) return &formats[i];
  return NULL;
}

static const format *of_keys(const ambulo__yaml_node *root) {
  for (int i = 0; i < FORMAT_COUNT; i++)
    if (ambulo__yaml_find(root, formats[i].key)) return &formats[i];
  return NULL;
}

static int place_in(const format *found, const char *const *kinds, int count) {
  for (int i = 0; found && i < count; i++)
    if (strcmp(found->kind, kinds[i]) == 0) return i;
  return -1;
}

/* "a problem", "a skeleton model or a problem" */
static void list_expected(char *buffer, const char *const *kinds, int count) {
  size_t used = 0;
  buffer[0] = '\0';
  for (int i = 0; i < count && used < MAX_TEXT; i++) {
    const format *one = of_kind(kinds[i]);
    int length = snprintf(buffer + used, MAX_TEXT - used, "%s%s", i ? " or " : "",
                          one ? one->name : kinds[i]);
    used += length > 0 ? (size_t)length : 0;
  }
}

/* neither version nor kind, nor a key that tells: of some other program */
static int is_strange(const ambulo__yaml_node *root) {
  return !ambulo__yaml_find(root, "ambulo") && !ambulo__yaml_find(root, "kind") && !of_keys(root);
}

static void refuse_strange(const ambulo__yaml_node *root, const char *const *kinds, int count) {
  char expected[MAX_TEXT], hint[MAX_TEXT];
  list_expected(expected, kinds, count);
  (void)snprintf(hint, sizeof hint, "such a file begins with 'ambulo: 1' and 'kind: %s'",
                 kinds[count - 1]);
  (void)ambulo__yaml_error(root, AMBULO_E_SCHEMA, hint,
                           "no key 'ambulo' and no 'kind': this is no file of Ambulo; expected %s",
                           expected);
}

int ambulo__yaml_file_kind(const ambulo__yaml_node *root, const char *const *kinds, int count) {
  const ambulo__yaml_node *node = ambulo__yaml_get(root, "kind");
  const format *found = NULL;
  if (is_strange(root)) {
    refuse_strange(root, kinds, count);
    return -1;
  }
  if (!node) {
    found = of_keys(root);
  } else if (node->kind == AMBULO__YAML_SCALAR) {
    found = of_kind(node->text);
  }
  int place = place_in(found, kinds, count);
  /* a model need not say its kind */
  int implied = strcmp(place >= 0 ? kinds[place] : kinds[0], "model") == 0;
  if (!node && (place >= 0 || !found)) {
    if (!implied || (!found && count > 1)) (void)ambulo__yaml_require(root, "kind");
    return place >= 0 ? place : 0;
  }
  if (place >= 0) return place;
  if (!found) return ambulo__yaml_choice(node, kinds, count, -1);
  char expected[MAX_TEXT];
  list_expected(expected, kinds, count);
  (void)ambulo__yaml_error(node ? node : root, AMBULO_E_SCHEMA, found->hint,
                           "this is %s; expected %s", found->name, expected);
  return -1;
}
