/* formats/yaml_file_kind.c - which of the formats a file is in, and what to do with the wrong one.
 */
#include "formats/yaml_tree.h"

#include <stdio.h>
#include <string.h>

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
