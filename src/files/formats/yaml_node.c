/* formats/yaml_node.c - a document: memory, walking, places and messages, flow text. */
#include "formats/yaml_tree.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { MAX_PATH = 512, MAX_MESSAGE = 1024 };

/* ---------------------------------------------------------------------- memory */

void ambulo__yaml_free(ambulo__yaml *document) {
  if (!document) return;
  ambulo_allocator allocator = document->arena.allocator;
  ambulo__arena_free(&document->arena);
  ambulo__free(&allocator, document);
}

/* --------------------------------------------------------------------- walking */

const ambulo__yaml_node *ambulo__yaml_root(const ambulo__yaml *document) {
  return document->root;
}

const char *ambulo__yaml_file(const ambulo__yaml *document) {
  return document->file;
}

ambulo_status ambulo__yaml_finish(const ambulo__yaml *document) {
  return document->status;
}

int ambulo__yaml_is(const ambulo__yaml_node *node, ambulo__yaml_kind kind) {
  return node && node->kind == kind;
}

static const ambulo__yaml_node *child(const ambulo__yaml_node *node, ambulo__yaml_kind kind,
                                      int index) {
  if (!node || node->kind != kind || index < 0 || index >= node->count) return NULL;
  return node->items[index];
}

const ambulo__yaml_node *ambulo__yaml_item(const ambulo__yaml_node *sequence, int index) {
  return child(sequence, AMBULO__YAML_SEQUENCE, index);
}

const char *ambulo__yaml_key(const ambulo__yaml_node *mapping, int index) {
  const ambulo__yaml_node *value = child(mapping, AMBULO__YAML_MAPPING, index);
  return value ? value->key->text : "";
}

const ambulo__yaml_node *ambulo__yaml_value(const ambulo__yaml_node *mapping, int index) {
  return child(mapping, AMBULO__YAML_MAPPING, index);
}

ambulo__yaml_node *ambulo__yaml_find(const ambulo__yaml_node *mapping, const char *key) {
  if (!mapping || mapping->kind != AMBULO__YAML_MAPPING) return NULL;
  for (int i = 0; i < mapping->count; i++) {
    ambulo__yaml_node *value = mapping->items[i];
    if (strcmp(value->key->text, key) == 0) return value;
  }
  return NULL;
}

/* --------------------------------------------------------- places and messages */

/* Writes "links[3].body.mass" from right to left; the beginning of a path that is too
 * long is lost. */
static const char *write_path(const ambulo__yaml_node *node, char buffer[MAX_PATH]) {
  size_t at = MAX_PATH - 1;
  buffer[at] = '\0';
  for (; node->parent; node = node->parent) {
    char part[MAX_PATH];
    int named = node->key != NULL;
    if (named) {
      (void)snprintf(part, sizeof part, "%s%s", node->parent->parent ? "." : "", node->key->text);
    } else {
      (void)snprintf(part, sizeof part, "[%d]", node->index);
    }
    size_t length = strlen(part);
    if (length > at) break;
    at -= length;
    memcpy(buffer + at, part, length);
  }
  return buffer + at;
}

ambulo__place ambulo__yaml_place(const ambulo__yaml_node *node) {
  char buffer[MAX_PATH];
  if (!node) return ambulo__nowhere;
  const char *path = write_path(node, buffer);
  ambulo__place place = {node->file, node->line, node->column, NULL};
  if (path[0] != '\0') place.path = ambulo__arena_copy(&node->document->arena, path, strlen(path));
  return place;
}

ambulo_status ambulo__yaml_error(const ambulo__yaml_node *node, ambulo_status status,
                                 const char *hint, const char *format, ...) {
  char message[MAX_MESSAGE];
  va_list arguments;
  if (!node) return status;
  va_start(arguments, format);
  (void)vsnprintf(message, sizeof message, format, arguments);
  va_end(arguments);
  ambulo__yaml *document = node->document;
  if (document->status == AMBULO_E_MEMORY) return status;
  if (document->status == AMBULO_OK || document->status == AMBULO_E_SCHEMA ||
      status == AMBULO_E_MEMORY)
    document->status = status;
  return ambulo__error(document->diagnostics, status, ambulo__yaml_place(node), hint, "%s",
                       message);
}

void ambulo__yaml_out_of_memory(ambulo__yaml *document) {
  ambulo__place place = {document->file, 0, 0, NULL};
  if (document->status == AMBULO_E_MEMORY) return;
  document->status = AMBULO_E_MEMORY;
  (void)ambulo__error(document->diagnostics, AMBULO_E_MEMORY, place, NULL, "%s",
                      ambulo_status_text(AMBULO_E_MEMORY));
}

void ambulo__yaml_warning(const ambulo__yaml_node *node, const char *hint, const char *format,
                          ...) {
  char message[MAX_MESSAGE];
  va_list arguments;
  if (!node) return;
  va_start(arguments, format);
  (void)vsnprintf(message, sizeof message, format, arguments);
  va_end(arguments);
  ambulo__warning(node->document->diagnostics, ambulo__yaml_place(node), hint, "%s", message);
}

/* ------------------------------------------------------------------- flow text
 *
 * Texts that were quoted are quoted again, so that "12" does not become a number. */

static void append_quoted(const char *word, ambulo__text_buffer *text) {
  ambulo__text_append_char(text, '"');
  for (; *word; word++) {
    if (*word == '\n') {
      ambulo__text_append(text, "\\n");
      continue;
    }
    if (*word == '"' || *word == '\\') ambulo__text_append_char(text, '\\');
    ambulo__text_append_char(text, *word);
  }
  ambulo__text_append_char(text, '"');
}

static void append_word(const char *word, int quoted, ambulo__text_buffer *text) {
  /* plain scalars of a block may hold what ends one of a flow */
  int plain = word[0] != '\0' && !strpbrk(word, ",[]{}\n\"") && !strstr(word, ": ");
  if (plain && !quoted)
    ambulo__text_append(text, word);
  else
    append_quoted(word, text);
}

void ambulo__yaml_flow(const ambulo__yaml_node *node, ambulo__text_buffer *text) {
  if (node->kind == AMBULO__YAML_SCALAR) {
    append_word(node->text, node->quoted, text);
    return;
  }
  int is_list = node->kind == AMBULO__YAML_SEQUENCE;
  ambulo__text_append_char(text, is_list ? '[' : '{');
  for (int i = 0; i < node->count; i++) {
    if (i > 0) ambulo__text_append(text, ", ");
    if (!is_list) {
      append_word(node->items[i]->key->text, 0, text);
      ambulo__text_append(text, ": ");
    }
    ambulo__yaml_flow(node->items[i], text);
  }
  ambulo__text_append_char(text, is_list ? ']' : '}');
}
