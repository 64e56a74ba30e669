/* base/yaml_set.c - replacing values by path, as `--set time.intervals=36` does. */
#include "base/yaml_tree.h"

#include "base/numtext.h"

#include <stdio.h>
#include <string.h>

/* one step of a path: a key, or an index when key_length is 0 */
typedef struct step {
  const char *key;
  size_t key_length;
  int index;
} step;

static ambulo_status bad_path(const ambulo__yaml *document, const char *file, const char *message) {
  ambulo__place place = {file, 0, 0, NULL};
  ambulo__error(document->diagnostics, AMBULO_E_SCHEMA, place,
                "paths look like 'time.intervals' or 'objective[0].weight'", "%s", message);
  return AMBULO_E_SCHEMA;
}

static ambulo_status no_item(const ambulo__yaml *document, const char *file,
                             const ambulo__yaml_node *parent, int index) {
  ambulo__place place = {file, 0, 0, NULL};
  if (parent->kind != AMBULO__YAML_SEQUENCE) {
    return ambulo__error(document->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                         "no item [%d]; the value is no sequence", index);
  }
  return ambulo__error(document->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                       "no item [%d]; expected an index below %d", index, parent->count);
}

static ambulo_status no_memory(const ambulo__yaml *document, const char *file) {
  ambulo__place place = {file, 0, 0, NULL};
  return ambulo__error(document->diagnostics, AMBULO_E_MEMORY, place, NULL,
                       "cannot allocate memory for the value");
}

/* reads "key", ".key" or "[3]" at *cursor and moves it behind; 0: not a path */
static int next_step(const char **cursor, int first, step *out) {
  const char *at = *cursor;
  *out = (step){NULL, 0, 0};
  if (*at == '[') {
    size_t digits = strspn(++at, "0123456789");
    long long index;
    if (!ambulo__parse_integer(at, digits, 0, 1000000, &index) || at[digits] != ']') return 0;
    out->index = (int)index;
    *cursor = at + digits + 1;
    return 1;
  }
  if (!first && *at++ != '.') return 0;
  out->key = at;
  out->key_length = strcspn(at, ".[");
  *cursor = at + out->key_length;
  return out->key_length > 0;
}

/* the child that a step leads to; *key_copy gets the key, so that it can be added */
static ambulo_status follow(ambulo__yaml *document, const char *file, ambulo__yaml_node *parent,
                            step where, ambulo__yaml_node **child, char **key_copy) {
  *child = NULL;
  *key_copy = NULL;
  if (where.key_length == 0) {
    if (parent->kind != AMBULO__YAML_SEQUENCE || where.index >= parent->count)
      return no_item(document, file, parent, where.index);
    *child = parent->items[where.index];
    return AMBULO_OK;
  }
  if (parent->kind != AMBULO__YAML_MAPPING)
    return bad_path(document, file, "the path goes through a value that is no mapping");
  *key_copy = ambulo__yaml_copy(document, where.key, where.key_length);
  if (!*key_copy) return no_memory(document, file);
  *child = ambulo__yaml_find(parent, *key_copy);
  return AMBULO_OK;
}

/* makes room for one more child of a mapping */
static ambulo_status append(ambulo__yaml *document, const char *file, ambulo__yaml_node *parent,
                            ambulo__yaml_node *value, const char *key) {
  if (parent->count >= AMBULO__YAML_MAX_KEYS)
    return bad_path(document, file, "more than 1024 keys in one mapping");
  size_t count = (size_t)parent->count;
  ambulo__yaml_node **items = ambulo__yaml_allocate(document, count + 1, sizeof(*items));
  ambulo__yaml_key_text *text = ambulo__yaml_allocate(document, 1, sizeof *text);
  if (!items || !text) return no_memory(document, file);
  if (count > 0) memcpy(items, parent->items, count * sizeof *items);
  text->text = key;
  text->hash = ambulo__yaml_hash(key);
  value->key = text;
  value->index = parent->count++;
  items[count] = value;
  parent->items = items;
  return AMBULO_OK;
}

static ambulo_status put(ambulo__yaml *document, const char *file, ambulo__yaml_node *parent,
                         ambulo__yaml_node *old, const char *key, ambulo__yaml_node *value) {
  value->parent = parent;
  if (!old) return append(document, file, parent, value, key);
  value->key = old->key;
  value->index = old->index;
  parent->items[old->index] = value;
  return AMBULO_OK;
}

/* walks to the last step of `path`; *parent is what holds it, *old its value or NULL */
static ambulo_status locate(ambulo__yaml *document, const char *file, const char *path,
                            ambulo__yaml_node **parent, ambulo__yaml_node **old, char **key,
                            int *depth) {
  ambulo__yaml_node *node = document->root;
  const char *cursor = path;
  *depth = 0;
  do {
    step where;
    if (!node) return bad_path(document, file, "the path goes through a key that is not there");
    if (!next_step(&cursor, cursor == path, &where))
      return bad_path(document, file, "the path is not well-formed");
    *parent = node;
    ++*depth;
    ambulo_status status = follow(document, file, node, where, old, key);
    if (status != AMBULO_OK) return status;
    node = *old;
  } while (*cursor);
  return AMBULO_OK;
}

ambulo_status ambulo__yaml_set(ambulo__yaml *document, const char *path, const char *value) {
  static const char lead[] = "--set ";
  size_t length = strlen(path);
  char *file = ambulo__yaml_allocate(document, length + sizeof lead, 1);
  if (!file) return no_memory(document, NULL);
  memcpy(file, lead, sizeof lead);
  memcpy(file + sizeof lead - 1, path, length);
  ambulo__yaml_node *parent = NULL, *old = NULL, *made = NULL;
  char *key = NULL;
  int depth = 0;
  ambulo_status status = locate(document, file, path, &parent, &old, &key, &depth);
  if (status != AMBULO_OK) return status;
  status = ambulo__yaml_parse(document, value, strlen(value), file, depth, &made);
  if (status != AMBULO_OK) return status;
  if (!made) {
    ambulo__place place = {file, 0, 0, NULL};
    return ambulo__error(document->diagnostics, AMBULO_E_PARSE, place, NULL,
                         "got no value; expected YAML text such as 36, [1, 2] or off");
  }
  return put(document, file, parent, old, key, made);
}
