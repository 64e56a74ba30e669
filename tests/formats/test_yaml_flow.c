/* Nodes as flow text: what --set takes, and reads as the same again; nodes by path. */
#include "formats/yaml_node.h"
#include "support/messages.h"
#include "support/test.h"

static void check(const char *text, const char *flow) {
  char whole[512];
  ambulo__yaml *document = NULL;
  ambulo__text_buffer buffer;
  (void)snprintf(whole, sizeof whole, "a: %s\n", text);
  assert_int_equal(ambulo__yaml_load_text(whole, strlen(whole), "f", NULL, NULL, &document), 0);
  ambulo__text_init(&buffer, NULL);
  ambulo__yaml_flow(ambulo__yaml_get(ambulo__yaml_root(document), "a"), &buffer);
  assert_string_equal(ambulo__text_data(&buffer), flow);
  ambulo__text_free(&buffer);
  ambulo__yaml_free(document);
}

static void texts(void **state) {
  (void)state;
  check("36", "36");
  check("null", "null");
  check("[1, 2.5, off]", "[1, 2.5, off]");
  check("\n  - 1\n  - b: 2\n    c: [x]\n", "[1, {b: 2, c: [x]}]");
  check("\"12\"", "\"12\"");
  check("'a \"b\" \\c'", "\"a \\\"b\\\" \\\\c\"");
  check("x, y", "\"x, y\""); /* plain in a block, not in a flow */
  check("{\"k, l\": 1}", "{\"k, l\": 1}");
  check("\"a\\nb\"", "\"a\\nb\"");
}

/* what a flow text sets is what was read */
static void there_and_back(void **state) {
  (void)state;
  static const char text[] = "a: {b: [1, \"2\", {c: 'it''s'}], d: x}\n";
  ambulo__yaml *document = NULL;
  ambulo__text_buffer first, second;
  assert_int_equal(ambulo__yaml_load_text(text, strlen(text), "f", NULL, NULL, &document), 0);
  ambulo__text_init(&first, NULL);
  ambulo__text_init(&second, NULL);
  ambulo__yaml_flow(ambulo__yaml_at(document, "a"), &first);
  assert_int_equal(ambulo__yaml_set(document, "a", ambulo__text_data(&first)), AMBULO_OK);
  ambulo__yaml_flow(ambulo__yaml_at(document, "a"), &second);
  assert_string_equal(ambulo__text_data(&first), ambulo__text_data(&second));
  assert_string_equal(ambulo__yaml_text(ambulo__yaml_at(document, "a.b[2].c")), "it's");
  ambulo__text_free(&first);
  ambulo__text_free(&second);
  ambulo__yaml_free(document);
}

static void nodes_by_path(void **state) {
  (void)state;
  static const char text[] =
      "list:\n  - {name: one, x: 3}\n  - {term: two, x: 4}\nkey: {deep: 5}\n";
  ambulo__yaml *document = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo__yaml_load_text(text, strlen(text), "f", NULL, list, &document), 0);
  assert_close(ambulo__yaml_number(ambulo__yaml_at(document, "list[one].x"), 0.0), 3.0, 0.0);
  assert_close(ambulo__yaml_number(ambulo__yaml_at(document, "list[1].x"), 0.0), 4.0, 0.0);
  assert_close(ambulo__yaml_number(ambulo__yaml_at(document, "list[two].x"), 0.0), 4.0, 0.0);
  assert_int_equal(ambulo__yaml_place(ambulo__yaml_at(document, "key.deep")).column, 13);
  assert_null(ambulo__yaml_at(document, "key.dep"));
  assert_message(list, 0, "did you mean 'deep'?");
  assert_null(ambulo__yaml_at(document, "list[2]"));
  assert_message(list, 1, "expected an index below 2");
  assert_null(ambulo__yaml_at(document, "list[three].x"));
  assert_message(list, 2, "no item is named 'three'");
  assert_null(ambulo__yaml_at(document, ".."));
  ambulo_diagnostics_free(list);
  ambulo__yaml_free(document);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(texts), cmocka_unit_test(there_and_back),
                                     cmocka_unit_test(nodes_by_path)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
