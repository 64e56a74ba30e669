/* tests/support/yaml.h - a text as a document, and the messages it caused. */
#ifndef AMBULO_TESTS_YAML_H
#define AMBULO_TESTS_YAML_H

#include "formats/yaml_node.h"
#include "support/test.h"

typedef struct yaml_case {
  ambulo_diagnostics *list;
  ambulo__yaml *document; /* NULL when loading failed */
  const ambulo__yaml_node *root;
  ambulo_status status;
} yaml_case;

static inline yaml_case yaml_open_bytes(const char *text, size_t length) {
  yaml_case c = {ambulo_diagnostics_create(NULL), NULL, NULL, AMBULO_OK};
  assert_non_null(c.list);
  c.status = ambulo__yaml_load_text(text, length, "t.yaml", NULL, c.list, &c.document);
  if (c.document) c.root = ambulo__yaml_root(c.document);
  return c;
}

static inline yaml_case yaml_open(const char *text) {
  return yaml_open_bytes(text, strlen(text));
}

static inline void yaml_shut(yaml_case *c) {
  ambulo__yaml_free(c->document);
  ambulo_diagnostics_free(c->list);
}

/* message `index` as the program prints it must be `want` */
static inline void expect_message(const yaml_case *c, size_t index, const char *want) {
  char text[1024];
  ambulo_diagnostics_format(c->list, index, text, sizeof text);
  assert_string_equal(text, want);
}

static inline void expect_messages(const yaml_case *c, size_t count) {
  for (size_t i = count; i < ambulo_diagnostics_count(c->list); i++) {
    char text[1024];
    ambulo_diagnostics_format(c->list, i, text, sizeof text);
    print_error("unexpected message: %s\n", text);
  }
  assert_int_equal(ambulo_diagnostics_count(c->list), count);
}

#endif
