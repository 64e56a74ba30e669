/* formats/yaml_set.c - replacing values by path, as `--set time.intervals=36` does, and leaving
 * keys and items out, as `--set gait.speed=null` does. */
#include "formats/yaml_tree.h"

#include "base/numtext.h"
#include "formats/atomic_file.h"

#include <stdio.h>
#include <string.h>

/* one step of a path: a key, an index, or the name of an item */
typedef enum step_kind { KEY, INDEX, NAME } step_kind;
typedef struct step {
  step_kind kind;
  const char *word; /* key or name */
  size_t length;
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

/* a key that is not there, in a mapping that the path goes through or that should lose it */
static ambulo_status no_key(const ambulo__yaml *document, const char *file,
                            const ambulo__yaml_node *parent, const char *key) {
  const char *names[AMBULO__YAML_MAX_KEYS];
  char hint[160] = "paths look like 'time.intervals' or 'objective[0].weight'";
  for (int i = 0; i < parent->count; i++) names[i] = parent->items[i]->key->text;
  const char *nearest = ambulo__nearest(key, names, (size_t)parent->count);
  if (nearest) (void)snprintf(hint, sizeof hint, "did you mean '%.100s'?", nearest);
  ambulo__place place = {file, 0, 0, NULL};
  return ambulo__error(document->diagnostics, AMBULO_E_SCHEMA, place, hint,
                       "the path needs a key that is not there (got '%.100s')", key);
}

/* the item of a sequence whose `name`, or else whose `term`, is the word; NULL: none */
static ambulo__yaml_node *named_item(const ambulo__yaml_node *parent, const char *word) {
  static const char *const keys[] = {"name", "term"};
  for (int k = 0; k < 2 && parent->kind == AMBULO__YAML_SEQUENCE; k++) {
    for (int i = 0; i < parent->count; i++) {
      const ambulo__yaml_node *item = parent->items[i];
      const ambulo__yaml_node *name =
          item->kind == AMBULO__YAML_MAPPING ? ambulo__yaml_find(item, keys[k]) : NULL;
      if (name && name->kind == AMBULO__YAML_SCALAR && strcmp(name->text, word) == 0)
        return parent->items[i];
    }
  }
  return NULL;
}

static ambulo_status no_name(const ambulo__yaml *document, const char *file,
                             const ambulo__yaml_node *parent, const char *word) {
  ambulo__place place = {file, 0, 0, NULL};
  return ambulo__error(document->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                       parent->kind == AMBULO__YAML_SEQUENCE
                           ? "no item is named '%.100s'; expected the name of one, or its number"
                           : "no item [%.100s]; the value is no sequence",
                       word);
}

/* reads "key", ".key", "[3]" or "[name]" at *cursor and moves it behind; 0: not a path */
static int next_step(const char **cursor, int first, step *out) {
  const char *at = *cursor;
  *out = (step){KEY, NULL, 0, 0};
  if (*at == '[') {
    size_t length = strcspn(++at, "]"), digits = strspn(at, "-0123456789");
    long long index = 0;
    if (length == 0 || at[length] != ']') return 0;
    out->kind = digits == length ? INDEX : NAME;
    if (out->kind == INDEX && !ambulo__parse_integer(at, digits, 0, 1000000, &index)) return 0;
    out->word = at;
    out->length = length;
    out->index = (int)index;
    *cursor = at + length + 1;
    return 1;
  }
  if (!first && *at++ != '.') return 0;
  out->word = at;
  out->length = strcspn(at, ".[");
  *cursor = at + out->length;
  return out->length > 0;
}

/* the child that a step leads to; *key_copy gets the key, so that it can be added */
static ambulo_status follow(ambulo__yaml *document, const char *file, ambulo__yaml_node *parent,
                            step where, ambulo__yaml_node **child, char **key_copy) {
  *child = NULL;
  *key_copy = NULL;
  if (where.kind == INDEX) {
    if (parent->kind != AMBULO__YAML_SEQUENCE || where.index >= parent->count)
      return no_item(document, file, parent, where.index);
    *child = parent->items[where.index];
    return AMBULO_OK;
  }
  char *word = ambulo__arena_copy(&document->arena, where.word, where.length);
  if (!word) return ambulo__io_memory_error(document->diagnostics, file);
  if (where.kind == NAME) {
    *child = named_item(parent, word);
    return *child ? AMBULO_OK : no_name(document, file, parent, word);
  }
  if (parent->kind != AMBULO__YAML_MAPPING)
    return bad_path(document, file, "the path goes through a value that is no mapping");
  *key_copy = word;
  *child = ambulo__yaml_find(parent, *key_copy);
  return AMBULO_OK;
}

/* makes room for one more child of a mapping */
static ambulo_status append(ambulo__yaml *document, const char *file, ambulo__yaml_node *parent,
                            ambulo__yaml_node *value, const char *key) {
  if (parent->count >= AMBULO__YAML_MAX_KEYS)
    return bad_path(document, file, "more than 1024 keys in one mapping");
  size_t count = (size_t)parent->count;
  ambulo__yaml_node **items = ambulo__arena_take(&document->arena, count + 1, sizeof(*items));
  ambulo__yaml_key_text *text = ambulo__arena_take(&document->arena, 1, sizeof *text);
  if (!items || !text) return ambulo__io_memory_error(document->diagnostics, file);
  if (count > 0) memcpy(items, parent->items, count * sizeof *items);
  text->text = key;
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

/* null and ~ without quotes take away what the path leads to */
static int takes_away(const ambulo__yaml_node *value) {
  return value->kind == AMBULO__YAML_SCALAR && !value->quoted &&
         (strcmp(value->text, "null") == 0 || strcmp(value->text, "~") == 0);
}

static void take_away(ambulo__yaml_node *parent, const ambulo__yaml_node *old) {
  parent->count--;
  for (int i = old->index; i < parent->count; i++) {
    parent->items[i] = parent->items[i + 1];
    parent->items[i]->index = i;
  }
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
    if (!node && *parent) return no_key(document, file, *parent, *key);
    if (!node) return bad_path(document, file, "the document is empty");
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

const ambulo__yaml_node *ambulo__yaml_at(ambulo__yaml *document, const char *path) {
  ambulo__yaml_node *parent = NULL, *found = NULL;
  char *key = NULL;
  int depth = 0;
  if (locate(document, NULL, path, &parent, &found, &key, &depth)) return NULL;
  if (!found) (void)no_key(document, NULL, parent, key);
  return found;
}

ambulo_status ambulo__yaml_set_below(ambulo__yaml *document, const char *above, const char *path,
                                     const char *value) {
  size_t size = strlen("--set ") + strlen(above) + strlen(path) + 1;
  char *file = ambulo__arena_take(&document->arena, size, 1);
  if (!file) return ambulo__io_memory_error(document->diagnostics, NULL);
  (void)snprintf(file, size, "--set %s%s", above, path);
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
                         "got no value; expected YAML text such as 36, [1, 2] or off, or null "
                         "to leave the key out");
  }
  if (takes_away(made)) {
    if (!old) return no_key(document, file, parent, key);
    take_away(parent, old);
    return AMBULO_OK;
  }
  return put(document, file, parent, old, key, made);
}

ambulo_status ambulo__yaml_set(ambulo__yaml *document, const char *path, const char *value) {
  return ambulo__yaml_set_below(document, "", path, value);
}
