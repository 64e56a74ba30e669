/* tests/support/model_text.h - a model written in a test, and the messages it caused. */
#ifndef AMBULO_TESTS_MODEL_TEXT_H
#define AMBULO_TESTS_MODEL_TEXT_H

#include "ambulo/model.h"
#include "ambulo/tools/load.h"
#include "support/messages.h"
#include "support/test.h"

/* the first three lines of a model file: links start at line 4 */
#define MODEL_HEAD "ambulo: 1\nname: t\nunits: {angle: degrees}\n"
#define MODEL_BODY "body: {mass: 2, com: [0, 0, 0], gyration: [0.1, 0.1, 0.1]}"
/* lines 4 and 5: a pendulum */
#define MODEL_ROD                                                                                  \
  "links:\n"                                                                                       \
  "  - {name: rod, parent: none, joint: revolute, dh: [0, 0, 1, 0], " MODEL_BODY "}\n"

typedef struct model_case {
  ambulo_diagnostics *list;
  ambulo_model *model; /* NULL when loading failed */
  ambulo_status status;
} model_case;

static inline model_case model_open_as(const char *text, const ambulo_subject *subject) {
  model_case c = {ambulo_diagnostics_create(NULL), NULL, AMBULO_OK};
  assert_non_null(c.list);
  c.status = ambulo_model_load_text(text, strlen(text), "t.yaml", subject, NULL, c.list, &c.model);
  return c;
}

static inline model_case model_open(const char *text) {
  return model_open_as(text, NULL);
}

static inline void model_shut(model_case *c) {
  ambulo_model_free(c->model);
  ambulo_diagnostics_free(c->list);
}

static inline void model_print(const model_case *c) {
  for (size_t i = 0; i < ambulo_diagnostics_count(c->list); i++) {
    char text[2048];
    ambulo_diagnostics_format(c->list, i, text, sizeof text);
    print_error("%s\n", text);
  }
}

/* the text loads without a word */
static inline model_case model_good(const char *text) {
  model_case c = model_open(text);
  model_print(&c);
  assert_int_equal(c.status, AMBULO_OK);
  assert_int_equal(ambulo_diagnostics_count(c.list), 0);
  assert_non_null(c.model);
  return c;
}

/* the text is refused with exactly one message, which starts with `want` */
static inline void model_bad(const char *text, ambulo_status status, const char *want) {
  model_case c = model_open(text);
  char got[2048] = "";
  ambulo_diagnostics_format(c.list, 0, got, sizeof got);
  if (strncmp(got, want, strlen(want)) != 0) {
    print_error("message is\n  %s\nexpected it to start with\n  %s\n", got, want);
    fail();
  }
  if (ambulo_diagnostics_count(c.list) != 1) {
    model_print(&c);
    fail();
  }
  assert_int_equal(c.status, status);
  assert_null(c.model);
  model_shut(&c);
}

#endif
