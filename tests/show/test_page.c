/* JSON inside of a page: whatever a text says, it stays a text. */
#include "ambulo/tools/tools.h"
#include "show/page.h"
#include "support/fail_alloc.h"
#include "support/inflate.h"
#include "support/messages.h"
#include "support/scene_reading.h"
#include "support/scratch.h"
#include "support/test.h"
#include "support/walker_result.h"

#include <signal.h>
#include <sys/resource.h>

static void assert_text(const char *given, const char *want) {
  ambulo__text_buffer out;
  ambulo__text_init(&out, NULL);
  ambulo__script_text(&out, given);
  assert_string_equal(ambulo__text_data(&out), want);
  ambulo__text_free(&out);
}

static void texts(void **state) {
  (void)state;
  assert_text("walk", "\"walk\"");
  assert_text("</script><!--", "\"\\u003c/script>\\u003c!--\"");
  assert_text("a \"b\" \\ & '", "\"a \\\"b\\\" \\\\ & '\"");
  assert_text("a\nb\x01\x7f", "\"a\\u000ab\\u0001\\u007f\"");
  assert_text("Gang \xc3\xbc \xe6\xad\xa9 \xf0\x9f\x9a\xb6",
              "\"Gang \xc3\xbc \xe6\xad\xa9 \xf0\x9f\x9a\xb6\"");
  assert_text("a\xe2\x80\xa8"
              "b\xe2\x80\xa9"
              "c\xe2\x80\xaa",
              "\"a\\u2028b\\u2029c\xe2\x80\xaa\"");
}

/* names of files may be any bytes: overlong forms, surrogates, a character that is cut off */
static void bytes_that_are_no_text(void **state) {
  (void)state;
  assert_text("a\xff", "\"a\\ufffd\"");
  assert_text("\xc0\xbc", "\"\\ufffd\\ufffd\"");
  assert_text("\xe0\x80\xbc", "\"\\ufffd\\ufffd\\ufffd\"");
  assert_text("\xed\xa0\x80", "\"\\ufffd\\ufffd\\ufffd\"");
  assert_text("\xe2\x80", "\"\\ufffd\\ufffd\"");
  assert_text("\xf4\x90\x80\x80", "\"\\ufffd\\ufffd\\ufffd\\ufffd\"");
}

static void json_without_blanks(void **state) {
  (void)state;
  static const char given[] =
      "{\n  \"a b\": [1, -2.5e3 ,\t{ }],\r\n \"c\\\" d\\\\\": \"</script> \xe2\x80\xa8\"\n}\n";
  ambulo__text_buffer out;
  ambulo__text_init(&out, NULL);
  ambulo__script_json(&out, given, strlen(given));
  assert_string_equal(ambulo__text_data(&out),
                      "{\"a b\":[1,-2.5e3,{}],\"c\\\" d\\\\\":\"\\u003c/script> \\u2028\"}");
  ambulo__text_free(&out);
}

/* as JSON: numbers to six digits, whole ones to all of theirs */
static void values(void **state) {
  (void)state;
  static const char *const both[][2] = {
      {"1.23456789", "1.23457"},
      {"-0.000123456789", "-0.000123457"},
      {"9.9999996", "10"},
      {"123456.789", "123457"},
      {"12345678", "12345678"},
      {"1234567.5", "1234570"},
      {"1e-320", "1e-320"},
      {"0.1", "0.1"},
      {"0", "0"},
      {"", "null"},
      {"null", "null"},
      {"nan", "\"nan\""},
      {"1.2 m", "\"1.2 m\""},
      {"<b>", "\"\\u003cb>\""},
  };
  for (size_t i = 0; i < sizeof both / sizeof both[0]; i++) {
    ambulo__text_buffer out;
    ambulo__text_init(&out, NULL);
    ambulo__script_value(&out, both[i][0]);
    assert_string_equal(ambulo__text_data(&out), both[i][1]);
    ambulo__text_free(&out);
  }
}

static int test_script_text_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(texts),
      cmocka_unit_test(bytes_that_are_no_text),
      cmocka_unit_test(json_without_blanks),
      cmocka_unit_test(values),
  };
  return cmocka_run_group_tests_name("page/script_text", tests, NULL, NULL);
}

/* Texts in a page: a JSON string of base64, in which the text stands packed. */

static void comes_out_again(const char *text, size_t length) {
  ambulo__text_buffer out;
  ambulo__text_init(&out, NULL);
  ambulo__packed_text(&out, text, length);
  assert_int_equal(ambulo__text_status(&out), AMBULO_OK);
  assert_true(out.length >= 2 && out.data[0] == '"' && out.data[out.length - 1] == '"');
  out.data[out.length - 1] = '\0';
  size_t bytes, size;
  char *packed = unbase64(out.data + 1, &bytes);
  unsigned char *got = unpacked(packed, bytes, &size);
  assert_int_equal(size, length);
  assert_memory_equal(got, text, length);
  free(got);
  free(packed);
  ambulo__text_free(&out);
}

static void any_length(void **state) {
  (void)state;
  static const char text[] = "{\"summary\": [1, 2, 3], \"name\": \"\xc3\xbc<\\u2028\"}";
  for (size_t length = 0; length < sizeof text; length++) comes_out_again(text, length);
}

static int test_packed_text_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(any_length)};
  return cmocka_run_group_tests_name("page/packed_text", tests, NULL, NULL);
}

/* The page: whole or not at all, safe with any name, from folders that hold what they should. */

enum { MOST_BYTES = 1200000 };

static const char *inside(const char *folder, const char *name) {
  static char path[4][SCRATCH_PATH + 512];
  static int next;
  char *text = path[next++ % 4];
  snprintf(text, sizeof path[0], "%s/%s", folder, name);
  return text;
}

/* a result folder of that name in the scratch */
static const char *result_folder(void **state, const char *name) {
  walk w;
  walk_open(&w, 12);
  const char *folder = scratch_path(state, name);
  assert_int_equal(ambulo_report_write(w.problem, w.result, folder, NULL, NULL, NULL), AMBULO_OK);
  walk_close(&w);
  return folder;
}

/* what stands in the page's element of data; to be freed */
static char *data_of(const char *page) {
  static const char open[] = "<script type=\"application/json\" id=\"data\">";
  const char *from = strstr(page, open);
  assert_non_null(from);
  from += strlen(open);
  const char *to = strstr(from, "</script>");
  assert_non_null(to);
  char *data = calloc((size_t)(to - from) + 1, 1);
  memcpy(data, from, (size_t)(to - from));
  return data;
}

/* what is packed in an item of "results"; to be freed */
static char *text_packed_in(const ambulo__yaml_node *item) {
  size_t bytes, size;
  char *packed = unbase64(ambulo__yaml_text(ambulo__yaml_get(item, "packed")), &bytes);
  char *text = (char *)unpacked(packed, bytes, &size);
  free(packed);
  assert_int_equal(strlen(text), size);
  return text;
}

/* the viewer that is built in is the page of the sources, with its licences and one place for data
 */
static void the_viewer_is_whole(void **state) {
  (void)state;
  const char *viewer = (const char *)ambulo__viewer;
  assert_int_equal(strlen(viewer), ambulo__viewer_size);
  char *file = read_whole("src/show/viewer.html");
  assert_string_equal(viewer, file);
  free(file);
  const char *mark = strstr(viewer, "/*DATA*/");
  assert_non_null(mark);
  assert_null(strstr(mark + 1, "/*DATA*/"));
  assert_non_null(strstr(viewer, "three.js authors"));
  assert_non_null(strstr(viewer, "Leon Sorokin"));
  assert_non_null(strstr(viewer, "Content-Security-Policy"));
  assert_null(strstr(viewer, "src=\"http"));
}

static void a_page_of_a_result(void **state) {
  const char *folder = result_folder(state, "walk");
  const char *page = inside(folder, "report.html");
  assert_int_equal(ambulo_page_write(&folder, 1, page, NULL, NULL, NULL), AMBULO_OK);
  char *text = read_whole(page), *data = data_of(text);
  assert_true(strlen(text) < MOST_BYTES);
  yaml_case c = yaml_open(data);
  assert_int_equal(c.status, AMBULO_OK);
  const ambulo__yaml_node *list = ambulo__yaml_get(c.root, "results");
  const ambulo__yaml_node *one = ambulo__yaml_item(list, 0);
  assert_int_equal(ambulo__yaml_items(list), 1);
  assert_string_equal(ambulo__yaml_text(ambulo__yaml_get(one, "name")), "walk");
  char *summary = read_whole(inside(folder, "summary.json")), *packed = text_packed_in(one);
  yaml_case p = yaml_open(packed);
  assert_int_equal(p.status, AMBULO_OK);
  assert_non_null(strstr(summary, ambulo__yaml_text(ambulo__yaml_get(
                                      ambulo__yaml_get(p.root, "summary"), "input_hash"))));
  const char *picture = ambulo__yaml_text(ambulo__yaml_get(p.root, "strip"));
  assert_int_equal(strncmp(picture, "<svg", 4) == 0 || strncmp(picture, "<?xml", 5) == 0, 1);
  free(summary);
  yaml_shut(&p);
  free(packed);
  yaml_shut(&c);
  free(data);
  free(text);
  assert_int_equal(entries_in(folder), 7);
}

/* a folder may have any name; nothing of it ends the element or is read as HTML */
static void names_are_only_names(void **state) {
  static const char name[] = "a<b>'\"&\xe2\x80\xa8\xc3\xbc <!-- \xff";
  const char *folder = result_folder(state, name);
  const char *page = scratch_path(state, "page.html");
  assert_int_equal(ambulo_page_write(&folder, 1, page, NULL, NULL, NULL), AMBULO_OK);
  char *text = read_whole(page), *data = data_of(text);
  assert_null(strchr(data, '<'));
  assert_non_null(strstr(data, "\"a\\u003cb>'\\\"&\\u2028\xc3\xbc \\u003c!-- \\ufffd\""));
  free(data);
  free(text);
}

static void two_results_and_a_measured_motion(void **state) {
  const char *folders[2] = {result_folder(state, "one"), result_folder(state, "two")};
  const char *page = scratch_path(state, "page.html");
  ambulo_page_options options = ambulo_page_options_default();
  ambulo_model *model = planar_walker_create();
  options.motion = inside(folders[0], "motion.csv");
  options.body = model;
  options.to = 0.25;
  assert_int_equal(ambulo_page_write(folders, 2, page, &options, NULL, NULL), AMBULO_OK);
  char *text = read_whole(page), *data = data_of(text);
  yaml_case c = yaml_open(data);
  assert_int_equal(c.status, AMBULO_OK);
  const ambulo__yaml_node *list = ambulo__yaml_get(c.root, "results");
  assert_int_equal(ambulo__yaml_items(list), 3);
  char *packed[2] = {text_packed_in(ambulo__yaml_item(list, 2)),
                     text_packed_in(ambulo__yaml_item(list, 0))};
  yaml_case two[2] = {yaml_open(packed[0]), yaml_open(packed[1])};
  const ambulo__yaml_node *motion = ambulo__yaml_get(two[0].root, "scene");
  assert_close(ambulo__yaml_number(ambulo__yaml_get(motion, "duration"), 0), 0.25, 1e-12);
  /* the same body at the same times: the measured motion begins where the result does */
  const ambulo__yaml_node *own = ambulo__yaml_get(two[1].root, "scene");
  for (int axis = 0; axis < 3; axis++)
    assert_close(scene_point(motion, 0, axis, 0), scene_point(own, 0, axis, 0), 1.01e-4);
  for (int i = 0; i < 2; i++) {
    yaml_shut(&two[i]);
    free(packed[i]);
  }
  yaml_shut(&c);
  free(data);
  free(text);
  options.from = 1e6;
  options.to = INFINITY;
  ambulo_diagnostics *list2 = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_page_write(folders, 2, page, &options, NULL, list2), AMBULO_E_SCHEMA);
  assert_message(list2, 0, "no motion from");
  ambulo_diagnostics_free(list2);
  ambulo_model_free(model);
}

static void expect(void **state, const char *folder, ambulo_status status, const char *message) {
  const char *page = scratch_path(state, "refused.html");
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_page_write(&folder, 1, page, NULL, NULL, list), status);
  assert_message(list, 0, message);
  assert_int_not_equal(access(page, F_OK), 0);
  ambulo_diagnostics_free(list);
}

static void folders_that_are_no_results(void **state) {
  expect(state, scratch_path(state, "nowhere"), AMBULO_E_IO, "nowhere: error[E_IO]: cannot open");
  scratch_write(scratch_path(state, "file"), "x");
  expect(state, scratch_path(state, "file"), AMBULO_E_IO, "a file; expected a result folder");
  const char *folder = result_folder(state, "walk");
  char *scene = read_whole(inside(folder, "scene.json"));
  size_t length = strlen(scene);
  scene[length / 2] = '\0';
  scratch_write(inside(folder, "scene.json"), scene);
  expect(state, folder, AMBULO_E_PARSE, "scene.json:");
  scratch_write(inside(folder, "scene.json"), "{\"schema\": \"ambulo-summary/1\"}");
  expect(state, folder, AMBULO_E_SCHEMA, "schema is 'ambulo-summary/1'; expected ambulo-scene/1");
  scratch_write(inside(folder, "scene.json"),
                "{\"schema\": \"ambulo-scene/1\", \"input_hash\": \"other\"}");
  expect(state, folder, AMBULO_E_SCHEMA, "input_hash is 'other', in summary.json");
  assert_int_equal(unlink(inside(folder, "scene.json")), 0);
  expect(state, folder, AMBULO_E_IO, "the folder has no scene.json");
  assert_int_equal(unlink(inside(folder, "summary.json")), 0);
  expect(state, folder, AMBULO_E_IO, "the folder has no summary.json");
  free(scene);
}

static void what_stands_there(void **state) {
  const char *folder = result_folder(state, "walk"), *page = scratch_path(state, "page.html");
  ambulo_page_options options = ambulo_page_options_default();
  scratch_write(page, "<!doctype html><p>my thesis</p>");
  assert_int_equal(ambulo_page_write(&folder, 1, page, &options, NULL, NULL), AMBULO_E_IO);
  assert_file_equal(page, "<!doctype html><p>my thesis</p>");
  options.overwrite = 1;
  assert_int_equal(ambulo_page_write(&folder, 1, page, &options, NULL, NULL), AMBULO_OK);
  options.overwrite = 0; /* ours now */
  assert_int_equal(ambulo_page_write(&folder, 1, page, &options, NULL, NULL), AMBULO_OK);
  assert_int_equal(
      ambulo_page_write(&folder, 1, scratch_path(state, "no/page.html"), &options, NULL, NULL),
      AMBULO_E_IO);
  assert_int_equal(ambulo_page_write(&folder, 0, page, &options, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_page_write(&folder, 1, NULL, &options, NULL, NULL), AMBULO_E_ARGUMENT);
  options.motion = "x.csv"; /* without a body */
  assert_int_equal(ambulo_page_write(&folder, 1, page, &options, NULL, NULL), AMBULO_E_ARGUMENT);
  options = ambulo_page_options_default();
  options.size = 0;
  assert_int_equal(ambulo_page_write(&folder, 1, page, &options, NULL, NULL), AMBULO_E_ARGUMENT);
}

/* a disk that is full after 8 kB: the old page stays, nothing half is left */
static void a_full_disk(void **state) {
  const char *folder = result_folder(state, "walk"), *page = scratch_path(state, "page.html");
  assert_int_equal(ambulo_page_write(&folder, 1, page, NULL, NULL, NULL), AMBULO_OK);
  char *before = read_whole(page);
  struct rlimit old, small;
  assert_int_equal(getrlimit(RLIMIT_FSIZE, &old), 0);
  small = old;
  small.rlim_cur = 8192;
  signal(SIGXFSZ, SIG_IGN);
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
  ambulo_status status = ambulo_page_write(&folder, 1, page, NULL, NULL, NULL);
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &old), 0);
  assert_int_equal(status, AMBULO_E_IO);
  char *after = read_whole(page);
  assert_string_equal(before, after);
  assert_int_equal(entries_in(*state), 2);
  free(before);
  free(after);
}

static void memory_may_run_out_anywhere(void **state) {
  const char *folder = result_folder(state, "walk"), *page = scratch_path(state, "page.html");
  ambulo_page_options options = ambulo_page_options_default();
  ambulo_model *model = planar_walker_create();
  options.motion = inside(folder, "motion.csv");
  options.body = model;
  long k = 0;
  for (;; k += 1 + k / 30) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_status status = ambulo_page_write(&folder, 1, page, &options, &allocator, NULL);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_int_equal(memory.live, 0);
    assert_int_equal(access(page, F_OK) == 0, status == AMBULO_OK);
    if (!memory.failed) break;
  }
  assert_true(k > 20);
  ambulo_model_free(model);
}

static int test_page_tests(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(the_viewer_is_whole),
      TEST(a_page_of_a_result),
      TEST(names_are_only_names),
      TEST(two_results_and_a_measured_motion),
      TEST(folders_that_are_no_results),
      TEST(what_stands_there),
      TEST(a_full_disk),
      TEST(memory_may_run_out_anywhere),
  };
  return cmocka_run_group_tests_name("page/page", tests, NULL, NULL);
}

int main(void) {
  return test_script_text_tests() + test_packed_text_tests() + test_page_tests();
}
