/* formats/yaml_flow.c - a node as YAML flow text. Texts that were quoted are quoted again, so that
 * "12" does not become a number. */
#include "formats/yaml_tree.h"

#include <string.h>

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

/* plain scalars of a block may hold what ends one of a flow */
static int is_plain(const char *word) {
  return word[0] != '\0' && !strpbrk(word, ",[]{}\n\"") && !strstr(word, ": ");
}

void ambulo__yaml_flow(const ambulo__yaml_node *node, ambulo__text_buffer *text) {
  if (node->kind == AMBULO__YAML_SCALAR) {
    if (!node->quoted && is_plain(node->text))
      ambulo__text_append(text, node->text);
    else
      append_quoted(node->text, text);
    return;
  }
  int is_list = node->kind == AMBULO__YAML_SEQUENCE;
  ambulo__text_append_char(text, is_list ? '[' : '{');
  for (int i = 0; i < node->count; i++) {
    if (i > 0) ambulo__text_append(text, ", ");
    if (!is_list) {
      const char *key = node->items[i]->key->text;
      if (is_plain(key))
        ambulo__text_append(text, key);
      else
        append_quoted(key, text);
      ambulo__text_append(text, ": ");
    }
    ambulo__yaml_flow(node->items[i], text);
  }
  ambulo__text_append_char(text, is_list ? ']' : '}');
}
