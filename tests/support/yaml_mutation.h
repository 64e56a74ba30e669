/* tests/support/yaml_mutation.h - a YAML file with one node replaced by something else.
 *
 * A document is written out again in block form, one node a line, so that the place of the
 * replaced one is known. Places that differ in nothing but the numbers of list items (links[3].body
 * and links[7].body) are one kind of place; `mutation_places` takes the first `most` of a kind. */
#ifndef AMBULO_TESTS_YAML_MUTATION_H
#define AMBULO_TESTS_YAML_MUTATION_H

#include "formats/yaml_tree.h"
#include "support/test.h"

static const char *const mutation_values[] = {
    "7",   "-0.25",         "nonsense", "",       "\"quoted\"",   "[]",
    "[7]", "[[1, 2], [3]]", "{}",       "{a: 1}", "{a: {b: [1]}}"};
enum { MUTATION_VALUES = sizeof mutation_values / sizeof *mutation_values };

typedef struct mutation {
  char *text;
  size_t length, capacity;
  const ambulo__yaml_node *target;
  const char *replacement;
  int lines;        /* written so far */
  int line, column; /* of the replacement */
} mutation;

static inline void mutation_put(mutation *m, const char *text) {
  size_t length = strlen(text);
  if (m->length + length + 1 > m->capacity) {
    m->capacity = 2 * (m->capacity + length + 1);
    m->text = realloc(m->text, m->capacity);
    assert_non_null(m->text);
  }
  memcpy(m->text + m->length, text, length + 1);
  m->length += length;
  for (; *text; text++) m->lines += *text == '\n';
}

static inline int mutation_column(const mutation *m) {
  size_t start = m->length;
  while (start > 0 && m->text[start - 1] != '\n') start--;
  return (int)(m->length - start) + 1;
}

static inline void mutation_put_scalar(mutation *m, const char *text, int quoted) {
  static const char safe[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+-";
  char letter[2] = "";
  if (!quoted && strspn(text, safe) == strlen(text)) {
    mutation_put(m, text);
    return;
  }
  mutation_put(m, "\"");
  for (; *text; text++) {
    letter[0] = *text;
    if (*text == '"' || *text == '\\') mutation_put(m, "\\");
    mutation_put(m, *text == '\n' ? "\\n" : letter);
  }
  mutation_put(m, "\"");
}

static inline void mutation_put_node(mutation *m, const ambulo__yaml_node *node, int indent);

static inline void mutation_put_child(mutation *m, const ambulo__yaml_node *child, int indent) {
  int block = child != m->target && child->count > 0;
  mutation_put(m, block ? "\n" : " ");
  mutation_put_node(m, child, indent + 2);
  if (!block) mutation_put(m, "\n");
}

static inline void mutation_put_node(mutation *m, const ambulo__yaml_node *node, int indent) {
  if (node == m->target) {
    m->line = m->lines + 1;
    m->column = mutation_column(m);
    mutation_put(m, m->replacement);
    return;
  }
  if (node->kind == AMBULO__YAML_SCALAR) {
    mutation_put_scalar(m, node->text, node->quoted);
    return;
  }
  int sequence = node->kind == AMBULO__YAML_SEQUENCE;
  if (node->count == 0) mutation_put(m, sequence ? "[]" : "{}");
  for (int i = 0; i < node->count; i++) {
    for (int k = 0; k < indent; k++) mutation_put(m, " ");
    if (!sequence) mutation_put_scalar(m, node->items[i]->key->text, 1);
    mutation_put(m, sequence ? "-" : ":");
    mutation_put_child(m, node->items[i], indent);
  }
}

/* The whole document with `target` replaced; m->text is to be freed. */
static inline mutation mutation_make(const ambulo__yaml *document, const ambulo__yaml_node *target,
                                     const char *replacement) {
  mutation m = {.target = target, .replacement = replacement};
  mutation_put(&m, "");
  mutation_put_node(&m, ambulo__yaml_root(document), 0);
  mutation_put(&m, "\n");
  return m;
}

/* ------------------------------------------------------------------- places */

enum { MUTATION_KINDS = 2048 };

/* kinds of places met, and how often */
typedef struct mutation_places {
  char *kind[MUTATION_KINDS];
  int count[MUTATION_KINDS], kinds, most;
} mutation_places;

/* 1 if this place is to be tried: not yet `most` of its kind */
static inline int mutation_take(mutation_places *places, const ambulo__yaml_node *node) {
  char kind[512] = "";
  const char *path = ambulo__yaml_place(node).path;
  size_t length = 0;
  for (; path && *path && length + 1 < sizeof kind; path++)
    if (*path < '0' || *path > '9') kind[length++] = *path;
  int k = 0;
  while (k < places->kinds && strcmp(places->kind[k], kind) != 0) k++;
  if (k == places->kinds) {
    assert_true(k < MUTATION_KINDS);
    places->kind[places->kinds++] = strdup(kind);
  }
  return places->count[k]++ < places->most;
}

static inline void mutation_places_free(mutation_places *places) {
  for (int k = 0; k < places->kinds; k++) free(places->kind[k]);
  places->kinds = 0;
}

/* Calls attempt() with every document that differs from this one in one node, of the places to be
 * tried. */
static inline void mutation_walk(const ambulo__yaml *document, const ambulo__yaml_node *node,
                                 mutation_places *places,
                                 void (*attempt)(void *user, const mutation *m), void *user) {
  int values = mutation_take(places, node) ? MUTATION_VALUES : 0;
  for (int i = 0; i < values; i++) {
    mutation m = mutation_make(document, node, mutation_values[i]);
    attempt(user, &m);
    free(m.text);
  }
  for (int i = 0; i < node->count; i++)
    mutation_walk(document, node->items[i], places, attempt, user);
}

#endif
