/* formats/yaml_set.c - replacing values by path, as `--set time.intervals=36` does, and leaving
 * keys and items out, as `--set gait.speed=null` does.
 *
 * A path may lead to what a file leaves at its default. Below the first key, what is missing on the
 * way is made, so that the number at its end is the only one that changes:
 *
 *     a missing key                        an empty mapping, or a sequence where [k] follows
 *     a missing item of a row of numbers   the row with '~' in front of it: those keep their values
 *     one word for all, `pressure: on`,    an empty mapping
 *     `collision: automatic`
 *     one number for all, `scale: 2`       {default: 2}
 *     a file alone, `muscles: legs.yaml`   {file: legs.yaml}
 *
 * A key that no reader asks for is refused by it, with the nearest name, as one in a file is. */
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

/* makes room for one more child, of a mapping under a key (a sequence has none) */
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
  value->key = key ? text : NULL;
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

/* ----------------------------------------------------------------- what is missing */

enum { LONGEST_ROW = 8 }; /* of numbers, that an index may lengthen */

/* What a path goes through: all of it may be made below the first key, unless it takes away. */
typedef struct walk {
  ambulo__yaml *document;
  const char *file; /* in messages */
  int makes;
  int depth;
} walk;

/* flow text in place of `old`, or as a new child of `parent` under a key */
static ambulo_status put_text(const walk *w, ambulo__yaml_node *parent, ambulo__yaml_node *old,
                              const char *key, const char *text, ambulo__yaml_node **made) {
  ambulo_status status =
      ambulo__yaml_parse(w->document, text, strlen(text), w->file, w->depth, made);
  return status ? status : put(w->document, w->file, parent, old, key, *made);
}

static int is_row_of_numbers(const ambulo__yaml_node *node) {
  if (node->kind != AMBULO__YAML_SEQUENCE || node->count >= LONGEST_ROW) return 0;
  for (int i = 0; i < node->count; i++)
    if (node->items[i]->kind != AMBULO__YAML_SCALAR) return 0;
  return node->grown || node->count > 0;
}

/* '~' up to an index: items that keep their values */
static ambulo_status lengthen(const walk *w, ambulo__yaml_node *row, int index) {
  ambulo_status status = AMBULO_OK;
  ambulo__yaml_node *made;
  row->grown = 1;
  while (row->count <= index && !status) status = put_text(w, row, NULL, NULL, "~", &made);
  return status;
}

/* the key of the mapping that a scalar stands for; NULL: of none */
static const char *key_of_all(const ambulo__yaml_node *scalar) {
  double number;
  if (!scalar->key) return NULL;
  if (strcmp(scalar->key->text, "muscles") == 0) return "file";
  return strcmp(scalar->key->text, "scale") == 0 &&
                 ambulo__parse_double(scalar->text, strlen(scalar->text), &number)
             ? "default"
             : NULL;
}

/* the mapping that one word, number or file for all stands for; *node stays where there is none */
static ambulo_status write_out(const walk *w, ambulo__yaml_node **node) {
  ambulo__yaml_node *scalar = *node;
  if (!w->makes || scalar->kind != AMBULO__YAML_SCALAR || !scalar->parent) return AMBULO_OK;
  if (strcmp(scalar->text, "on") == 0 || strcmp(scalar->text, "automatic") == 0)
    return put_text(w, scalar->parent, scalar, NULL, "{}", node);
  const char *key = key_of_all(scalar);
  if (!key) return AMBULO_OK;
  ambulo_status status = put_text(w, scalar->parent, scalar, NULL, "{}", node);
  return status ? status : put(w->document, w->file, *node, NULL, key, scalar);
}

/* ------------------------------------------------------------------------ the walk */

/* the child that a step leads to; *key_copy gets the key, so that it can be added */
static ambulo_status follow(const walk *w, ambulo__yaml_node **parent, step where,
                            ambulo__yaml_node **child, char **key_copy) {
  *child = NULL;
  *key_copy = NULL;
  if (where.kind == INDEX) {
    if (w->makes && where.index >= (*parent)->count && where.index < LONGEST_ROW &&
        is_row_of_numbers(*parent)) {
      ambulo_status status = lengthen(w, *parent, where.index);
      if (status) return status;
    }
    if ((*parent)->kind != AMBULO__YAML_SEQUENCE || where.index >= (*parent)->count)
      return no_item(w->document, w->file, *parent, where.index);
    *child = (*parent)->items[where.index];
    return AMBULO_OK;
  }
  char *word = ambulo__arena_copy(&w->document->arena, where.word, where.length);
  if (!word) return ambulo__io_memory_error(w->document->diagnostics, w->file);
  if (where.kind == NAME) {
    *child = named_item(*parent, word);
    return *child ? AMBULO_OK : no_name(w->document, w->file, *parent, word);
  }
  ambulo_status status = write_out(w, parent);
  if (status) return status;
  if ((*parent)->kind != AMBULO__YAML_MAPPING)
    return bad_path(w->document, w->file, "the path goes through a value that is no mapping");
  *key_copy = word;
  *child = ambulo__yaml_find(*parent, *key_copy);
  return AMBULO_OK;
}

/* a text that will take away */
static int is_null(const char *text) {
  size_t start = strspn(text, " "), length = strcspn(text + start, " ");
  return text[start + length + strspn(text + start + length, " ")] == '\0' &&
         ((length == 4 && strncmp(text + start, "null", 4) == 0) ||
          (length == 1 && text[start] == '~'));
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
static ambulo_status locate(walk *w, const char *path, ambulo__yaml_node **parent,
                            ambulo__yaml_node **old, char **key) {
  ambulo__yaml_node *node = w->document->root;
  const char *cursor = path;
  w->depth = 0;
  do {
    step where;
    if (!node && !*parent) return bad_path(w->document, w->file, "the document is empty");
    if (!node && (!w->makes || w->depth < 2)) return no_key(w->document, w->file, *parent, *key);
    const char *before = cursor;
    if (!next_step(&cursor, cursor == path, &where))
      return bad_path(w->document, w->file, "the path is not well-formed");
    if (!node) {
      ambulo_status made = put_text(w, *parent, NULL, *key, *before == '[' ? "[]" : "{}", &node);
      if (made) return made;
      node->grown = 1;
    }
    *parent = node;
    ++w->depth;
    ambulo_status status = follow(w, parent, where, old, key);
    if (status != AMBULO_OK) return status;
    node = *old;
  } while (*cursor);
  return AMBULO_OK;
}

const ambulo__yaml_node *ambulo__yaml_at(ambulo__yaml *document, const char *path) {
  ambulo__yaml_node *parent = NULL, *found = NULL;
  char *key = NULL;
  walk w = {.document = document};
  if (locate(&w, path, &parent, &found, &key)) return NULL;
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
  walk w = {.document = document, .file = file, .makes = !is_null(value)};
  ambulo_status status = locate(&w, path, &parent, &old, &key);
  if (status != AMBULO_OK) return status;
  status = ambulo__yaml_parse(document, value, strlen(value), file, w.depth, &made);
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
