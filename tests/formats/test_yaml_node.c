#include "formats/yaml_node.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/test.h"
#include "support/yaml.h"

#include <sys/stat.h>
#include <unistd.h>

static void expect_load(const char *path, ambulo_status status, const char *want) {
  yaml_case c = {ambulo_diagnostics_create(NULL), NULL, NULL, AMBULO_OK};
  char text[512];
  (void)snprintf(text, sizeof text, "%s%s", path, want);
  assert_int_equal(ambulo__yaml_load(path, NULL, c.list, &c.document), status);
  expect_message(&c, 0, text);
  expect_messages(&c, 1);
  assert_null(c.document);
  yaml_shut(&c);
}

/* a folder of our own, gone afterwards */
static int make_folder(void **state) {
  static char folder[] = "/tmp/ambulo_yaml_XXXXXX";
  *state = mkdtemp(folder);
  return *state == NULL || chdir(folder) != 0;
}
static int remove_folder(void **state) {
  return chdir("/") != 0 || rmdir(*state) != 0;
}

static void write_file(const char *name, const char *text, size_t length) {
  FILE *file = fopen(name, "wb");
  assert_non_null(file);
  assert_int_equal(fwrite(text, 1, length, file), length);
  assert_int_equal(fclose(file), 0);
}

static void files_that_are_none(void **state) {
  (void)state;
  expect_load("missing.yaml", AMBULO_E_IO, ": error[E_IO]: cannot open: No such file or directory");
  expect_load(".", AMBULO_E_IO, ": error[E_IO]: not a regular file (it is a folder)");
  expect_load("/dev/null", AMBULO_E_IO, ": error[E_IO]: not a regular file");
  assert_int_equal(mkfifo("fifo", 0600), 0);
  expect_load("fifo", AMBULO_E_IO, ": error[E_IO]: not a regular file");
  (void)unlink("fifo");
}

/* root reads everything: becomes nobody for the time of the call */
static void unreadable_file(void **state) {
  int root = geteuid() == 0;
  write_file("secret.yaml", "a: 1\n", 5);
  assert_int_equal(chmod("secret.yaml", 0), 0);
  assert_int_equal(chmod(*state, 0755), 0);
  if (root) assert_int_equal(seteuid(65534), 0);
  expect_load("secret.yaml", AMBULO_E_IO, ": error[E_IO]: cannot open: Permission denied");
  if (root) assert_int_equal(seteuid(0), 0);
  (void)unlink("secret.yaml");
}

static void file_too_large(void **state) {
  (void)state;
  write_file("large.yaml", "a: 1\n", 5);
  assert_int_equal(truncate("large.yaml", (16 << 20) + 1), 0);
  expect_load("large.yaml", AMBULO_E_LIMIT,
              ": error[E_LIMIT]: file too large (got 16777217 bytes); expected at most 16777216");
  (void)unlink("large.yaml");
}

static void a_file_is_read(void **state) {
  (void)state;
  write_file("good.yaml", "a: 1\nb: {c: x}\n", 15);
  for (long k = -1; k < 6; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo__yaml *document = NULL;
    ambulo_status status = ambulo__yaml_load("good.yaml", &hook, NULL, &document);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    if (document) assert_string_equal(ambulo__yaml_file(document), "good.yaml");
    ambulo__yaml_free(document);
    assert_int_equal(memory.live, 0);
  }
  (void)unlink("good.yaml");
}

static void the_top_level_is_a_mapping(void **state) {
  (void)state;
  static const char *const empty[] = {"# only a comment\n", "---\n", "\n\n", "\xEF\xBB\xBF"};
  for (size_t i = 0; i < sizeof empty / sizeof empty[0]; i++) {
    yaml_case c = yaml_open(empty[i]);
    assert_int_equal(c.status, AMBULO_E_PARSE);
    expect_message(
        &c, 0,
        "t.yaml:1:1: error[E_PARSE]: nothing but blank lines and comments; expected YAML: "
        "lines 'key: value'");
    yaml_shut(&c);
  }
  yaml_case none = yaml_open("");
  assert_int_equal(none.status, AMBULO_E_PARSE);
  expect_message(
      &none, 0, "t.yaml:1:1: error[E_PARSE]: the file is empty; expected YAML: lines 'key: value'");
  yaml_shut(&none);
  yaml_case list = yaml_open("- a\n- b\n");
  assert_int_equal(list.status, AMBULO_E_SCHEMA);
  expect_message(&list, 0,
                 "t.yaml:1:1: error[E_SCHEMA]: got a sequence at the top level; expected a mapping"
                 "\n  hint: the file should hold YAML: lines 'key: value'");
  yaml_shut(&list);
  yaml_case scalar = yaml_open("\n 3.5\n");
  assert_int_equal(scalar.status, AMBULO_E_SCHEMA);
  expect_message(&scalar, 0,
                 "t.yaml:2:2: error[E_SCHEMA]: got a scalar at the top level; expected a mapping"
                 "\n  hint: the file should hold YAML: lines 'key: value'");
  yaml_shut(&scalar);
}

static void walking_a_tree(void **state) {
  (void)state;
  yaml_case c = yaml_open("name: walk\nlinks:\n- {mass: 1}\n- {mass: 2, at: [3, 4]}\n");
  assert_int_equal(ambulo__yaml_pairs(c.root), 2);
  assert_string_equal(ambulo__yaml_key(c.root, 0), "name");
  assert_string_equal(ambulo__yaml_key(c.root, 1), "links");
  assert_string_equal(ambulo__yaml_key(c.root, 2), "");
  assert_string_equal(ambulo__yaml_key(c.root, -1), "");
  const ambulo__yaml_node *links = ambulo__yaml_value(c.root, 1);
  assert_true(ambulo__yaml_is(links, AMBULO__YAML_SEQUENCE));
  assert_int_equal(ambulo__yaml_items(links), 2);
  assert_null(ambulo__yaml_item(links, 2));
  assert_null(ambulo__yaml_item(c.root, 0));
  assert_null(ambulo__yaml_value(links, 0));
  assert_null(ambulo__yaml_item(NULL, 0));
  assert_int_equal(ambulo__yaml_items(NULL), 0);
  const ambulo__yaml_node *at = ambulo__yaml_get(ambulo__yaml_item(links, 1), "at");
  ambulo__place place = ambulo__yaml_place(ambulo__yaml_item(at, 1));
  assert_string_equal(place.path, "links[1].at[1]");
  assert_string_equal(place.file, "t.yaml");
  assert_int_equal(place.line, 4);
  assert_int_equal(place.column, 21);
  assert_null(ambulo__yaml_place(c.root).path);
  yaml_shut(&c);
}

/* a path of 31 long keys is cut from the left, not written past its end */
static void a_very_long_path(void **state) {
  (void)state;
  static char text[31 * 110];
  size_t length = 0;
  for (int i = 0; i < 31; i++) {
    memset(text + length, 'k', 100);
    memcpy(text + length + 100, i < 30 ? ": {" : ": 1", 3);
    length += 103;
  }
  memset(text + length, '}', 30);
  yaml_case c = yaml_open(text);
  assert_int_equal(c.status, AMBULO_OK);
  const ambulo__yaml_node *node = c.root;
  while (ambulo__yaml_is(node, AMBULO__YAML_MAPPING)) node = ambulo__yaml_value(node, 0);
  const char *path = ambulo__yaml_place(node).path;
  assert_non_null(path);
  assert_true(strlen(path) < 512 && strlen(path) > 300);
  yaml_shut(&c);
}

static void errors_of_the_reader(void **state) {
  (void)state;
  yaml_case c = yaml_open("a: 1\nb: 2\n");
  ambulo__yaml_warning(ambulo__yaml_value(c.root, 0), "hint", "large %d", 5);
  assert_int_equal(ambulo__yaml_finish(c.document), AMBULO_OK);
  assert_int_equal(ambulo__yaml_error(ambulo__yaml_value(c.root, 1), AMBULO_E_SCHEMA, NULL, "bad"),
                   AMBULO_E_SCHEMA);
  assert_int_equal(ambulo__yaml_finish(c.document), AMBULO_E_SCHEMA);
  ambulo__yaml_error(ambulo__yaml_value(c.root, 1), AMBULO_E_MODEL, NULL, "bad %s", "mass");
  ambulo__yaml_error(ambulo__yaml_value(c.root, 1), AMBULO_E_LIMIT, NULL, "bad");
  assert_int_equal(ambulo__yaml_finish(c.document), AMBULO_E_MODEL);
  expect_message(&c, 0, "t.yaml:1:4: warning: large 5\n  hint: hint");
  expect_message(&c, 2, "t.yaml:2:4: error[E_MODEL]: bad mass");
  yaml_shut(&c);
}

/* Nodes as flow text: what --set takes, and reads as the same again; nodes by path. */

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
  const struct CMUnitTest tests[] = {cmocka_unit_test(files_that_are_none),
                                     cmocka_unit_test(unreadable_file),
                                     cmocka_unit_test(file_too_large),
                                     cmocka_unit_test(a_file_is_read),
                                     cmocka_unit_test(the_top_level_is_a_mapping),
                                     cmocka_unit_test(walking_a_tree),
                                     cmocka_unit_test(a_very_long_path),
                                     cmocka_unit_test(errors_of_the_reader),
                                     cmocka_unit_test(texts),
                                     cmocka_unit_test(there_and_back),
                                     cmocka_unit_test(nodes_by_path)};
  return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
