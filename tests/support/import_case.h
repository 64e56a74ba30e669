/* tests/support/import_case.h - a text as a file of another program, imported, and what came of it.
 *
 * Where the library was built without expat every import test is skipped, and says so. */
#ifndef AMBULO_TESTS_IMPORT_CASE_H
#define AMBULO_TESTS_IMPORT_CASE_H

#include "ambulo/tools/tools.h"
#include "support/messages.h"
#include "support/scratch.h"

typedef struct import_case {
  ambulo_status status;
  ambulo_diagnostics *list;
  char *text; /* NULL when the import failed */
  ambulo_model *model;
} import_case;

/* as the library was built: its tests are compiled with the same flags */
static inline int reads_xml(void) {
#ifdef AMBULO_HAS_EXPAT
  return 1;
#else
  return 0;
#endif
}

static inline void skip_without_expat(void) {
  if (reads_xml()) return;
  print_message("skipped: built without expat\n");
  skip();
}

static inline import_case import_file(const char *path, const ambulo_import_options *options) {
  import_case c = {AMBULO_OK, ambulo_diagnostics_create(NULL), NULL, NULL};
  skip_without_expat();
  c.status = ambulo_import_model(path, NULL, options, NULL, c.list, &c.text);
  if (c.status == AMBULO_OK) {
    assert_int_equal(
        ambulo_model_load_text(c.text, strlen(c.text), "imported", NULL, NULL, c.list, &c.model),
        AMBULO_OK);
  }
  return c;
}

static inline import_case import_text(void **state, const char *xml,
                                      const ambulo_import_options *options) {
  const char *path = scratch_path(state, "t.xml");
  scratch_write(path, xml);
  return import_file(path, options);
}

static inline void import_shut(import_case *c) {
  ambulo_text_free(c->text, NULL);
  ambulo_model_free(c->model);
  ambulo_diagnostics_free(c->list);
}

static inline void import_print(const import_case *c) {
  for (size_t i = 0; i < ambulo_diagnostics_count(c->list); i++) {
    char text[2048];
    ambulo_diagnostics_format(c->list, i, text, sizeof text);
    print_error("%s\n", text);
  }
}

static inline import_case import_good(void **state, const char *xml) {
  import_case c = import_text(state, xml, NULL);
  if (c.status) import_print(&c);
  assert_int_equal(c.status, AMBULO_OK);
  return c;
}

/* some message contains `text` */
static inline void assert_told(const import_case *c, const char *text) {
  for (size_t i = 0; i < ambulo_diagnostics_count(c->list); i++) {
    char buffer[2048] = "";
    ambulo_diagnostics_format(c->list, i, buffer, sizeof buffer);
    if (strstr(buffer, text)) return;
  }
  import_print(c);
  print_error("expected a message with\n  %s\n", text);
  fail();
}

/* refused, with a message that contains `want` ("3:5: error[E_MODEL]: ...") */
static inline void import_bad(void **state, const char *xml, ambulo_status status,
                              const char *want) {
  import_case c = import_text(state, xml, NULL);
  if (c.status != status) import_print(&c);
  assert_int_equal(c.status, status);
  assert_null(c.text);
  assert_told(&c, want);
  import_shut(&c);
}

/* torques of the model at the state q_i = .3 sin(1 + i), qd_i = .7 cos(2 + i), qdd_i = 1.1 sin(3 +
 * 2 i)
 */
static inline void assert_torques(const ambulo_model *model, const double *want, int count,
                                  double tolerance) {
  double q[64], qd[64], qdd[64], tau[64];
  ambulo_mechanics *mechanics = NULL;
  assert_int_equal(ambulo_model_coordinate_count(model), count);
  for (int i = 0; i < count; i++) {
    q[i] = 0.3 * sin(1.0 + i);
    qd[i] = 0.7 * cos(2.0 + i);
    qdd[i] = 1.1 * sin(3.0 + 2.0 * i);
  }
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  assert_int_equal(
      ambulo_mechanics_inverse_dynamics(
          mechanics, 1, q, qd, qdd, &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau}),
      AMBULO_OK);
  for (int i = 0; i < count; i++) assert_close(tau[i], want[i], tolerance);
  ambulo_mechanics_free(mechanics);
}

#endif
