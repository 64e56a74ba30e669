/* XML as a tree: what is kept, where faults are, and what is refused for its size. */
#include "support/import_case.h"

#include "import/xml.h"

static void what_is_kept(void **state) {
  skip_without_expat();
  const char *path = scratch_path(state, "a.xml");
  scratch_write(path, "<?xml version='1.0'?>\n<!-- word --><a x='1' y='&lt;'>\n one <b/> two\n  <c "
                      "z=''> 3 </c>\n</a>\n");
  ambulo__arena arena = {.allocator = ambulo__allocator_or_default(NULL)};
  ambulo__xml xml = {.arena = &arena};
  ambulo__xml_node *a = ambulo__xml_load(&xml, path);
  assert_non_null(a);
  assert_string_equal(a->text, "one  two");
  assert_string_equal(ambulo__xml_attribute(a, "y"), "<");
  assert_null(ambulo__xml_attribute(a, "z"));
  const ambulo__xml_node *c = ambulo__xml_child(a, "c");
  assert_string_equal(c->text, "3");
  assert_int_equal(c->line, 4);
  assert_int_equal(c->column, 3);
  assert_ptr_equal(ambulo__xml_next(ambulo__xml_child(a, "b"), "c"), c);
  ambulo__arena_free(&arena);
}

static void numbers(void **state) {
  skip_without_expat();
  const char *path = scratch_path(state, "n.xml");
  scratch_write(path, "<a>.5 -5. +1e-3,2</a>");
  ambulo__arena arena = {.allocator = ambulo__allocator_or_default(NULL)};
  ambulo__xml xml = {.arena = &arena};
  const ambulo__xml_node *a = ambulo__xml_load(&xml, path);
  double v[4];
  assert_int_equal(ambulo__xml_numbers(&xml, a, "x", a->text, 4, 0, v), 4);
  assert_close(v[0], 0.5, 0);
  assert_close(v[1], -5, 0);
  assert_close(v[2], 1e-3, 0);
  assert_int_equal(ambulo__xml_numbers(&xml, a, "x", "-Inf infinity", 4, 1, v), 2);
  assert_true(isinf(v[0]) && v[0] < 0 && isinf(v[1]) && v[1] > 0);
  static const char *const bad[] = {"inf", "nan", "1,5x", ".", "-", "0x10", "1e999", "--1"};
  for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
    assert_int_equal(ambulo__xml_numbers(&xml, a, "x", bad[i], 4, 0, v), -1);
  ambulo__arena_free(&arena);
}

static void what_is_no_xml(void **state) {
  import_bad(state, "<robot name='r'>\n  <link></robot>", AMBULO_E_PARSE,
             "t.xml:2:11: error[E_PARSE]: the text is not XML (mismatched tag)");
  import_bad(state, "", AMBULO_E_PARSE,
             "t.xml:1:1: error[E_PARSE]: the text is not XML (no element found)");
  import_bad(state, "<robot name='r'><link a='1' a='2'/></robot>", AMBULO_E_PARSE,
             "duplicate attribute");
  import_bad(state, "<sdf/>", AMBULO_E_SCHEMA,
             "t.xml:1:1: error[E_SCHEMA]: this is not a model that can be imported (got <sdf>)");
}

/* a billion laughs, and a file of the system, are entities: none is read */
static void entities(void **state) {
  import_bad(state,
             "<?xml version='1.0'?>\n<!DOCTYPE robot [\n<!ENTITY a 'ha'>\n<!ENTITY b "
             "'&a;&a;&a;&a;'>\n]>\n<robot>&b;</robot>",
             AMBULO_E_PARSE,
             "t.xml:3:12: error[E_PARSE]: the document declares an entity; expected none");
  import_bad(state, "<!DOCTYPE robot [<!ENTITY a SYSTEM 'file:///etc/passwd'>]><robot>&a;</robot>",
             AMBULO_E_PARSE, "the document declares an entity");
}

/* expat leaves out what may be declared elsewhere: half a number would be read */
static void what_is_declared_elsewhere(void **state) {
  static const char *const types[] = {
      "<!DOCTYPE robot SYSTEM 'robot.dtd'>", "<!DOCTYPE robot PUBLIC '-//R//EN' 'robot.dtd'>",
      "<!DOCTYPE robot SYSTEM 'robot.dtd' []>", "<!DOCTYPE robot [%undef;]>",
      "<!DOCTYPE robot [<!ELEMENT robot ANY> %undef; <!ATTLIST robot name CDATA 'x'>]>"};
  static const char *const robots[] = {"<robot name='1&undef;0'/>", "<robot>1&undef;0</robot>",
                                       "<robot/>"};
  for (int i = 0; i < 5; i++) {
    for (int k = 0; k < 3; k++) {
      char text[300];
      (void)snprintf(text, sizeof text, "<?xml version='1.0'?>\n%s\n%s", types[i], robots[k]);
      import_bad(state, text, AMBULO_E_PARSE, "t.xml:2:");
    }
  }
  /* where all of it is here, expat knows */
  import_bad(state, "<!DOCTYPE robot [<!ELEMENT robot ANY>]><robot name='1&undef;0'/>",
             AMBULO_E_PARSE, "undefined entity");
  import_bad(state, "<?xml version='1.0' standalone='yes'?><!DOCTYPE r SYSTEM 'r.dtd'><r/>",
             AMBULO_E_PARSE, "the document type is declared outside of the document");
  import_bad(state, "<!DOCTYPE robot [<!ELEMENT robot ANY>]><robot/>", AMBULO_E_MODEL, "");
}

static void too_deep(void **state) {
  enum { LEVELS = 300 };
  char text[LEVELS * 7 + 1] = "";
  for (int i = 0; i < LEVELS; i++) memcpy(text + 3 * i, "<a>", 4);
  import_bad(state, text, AMBULO_E_LIMIT,
             "elements are nested too deeply; expected at most 200 levels");
}

static void too_large(void **state) {
  const char *path = scratch_path(state, "t.xml");
  FILE *file = fopen(path, "wb");
  assert_non_null(file);
  assert_int_equal(fseek(file, 65L << 20, SEEK_SET), 0); /* a hole */
  assert_int_equal(fputc('x', file), 'x');
  assert_int_equal(fclose(file), 0);
  import_case c = import_file(path, NULL);
  assert_int_equal(c.status, AMBULO_E_LIMIT);
  import_shut(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_kept),
                                     cmocka_unit_test(numbers),
                                     cmocka_unit_test(what_is_no_xml),
                                     cmocka_unit_test(entities),
                                     cmocka_unit_test(what_is_declared_elsewhere),
                                     cmocka_unit_test(too_deep),
                                     cmocka_unit_test(too_large)};
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
