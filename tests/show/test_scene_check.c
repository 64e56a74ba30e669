/* Scenes that are read back: what no page can show is refused where it stands. */
#include "ambulo/tools/tools.h"
#include "show/page.h"
#include "support/messages.h"
#include "support/scratch.h"
#include "support/walker_result.h"

#include <ctype.h>

static ambulo_status read_folder(const char *folder, ambulo_diagnostics *list) {
  ambulo__page_result result;
  ambulo_status status = ambulo__page_result_read(folder, NULL, list, &result);
  if (!status) ambulo__page_result_free(&result);
  return status;
}

/* a real scene in a folder; its text */
static char *open_scene(void **state, char folder[SCRATCH_PATH + 8]) {
  walk w;
  ambulo_report_options options = ambulo_report_options_default();
  (void)snprintf(folder, SCRATCH_PATH + 8, "%s/r", (const char *)*state);
  walk_open(&w, 8);
  assert_int_equal(ambulo_report_write(w.problem, w.result, folder, &options, NULL, NULL),
                   AMBULO_OK);
  walk_close(&w);
  return read_whole(scratch_path(state, "r/scene.json"));
}

/* each number that a number could stand for as a text, one at a time; of series some of them */
static void texts_in_the_place_of_numbers(void **state) {
  char folder[SCRATCH_PATH + 8];
  char *text = open_scene(state, folder);
  size_t length = strlen(text);
  char *changed = malloc(length + 3);
  assert_non_null(changed);
  assert_int_equal(read_folder(folder, NULL), AMBULO_OK);
  int numbers = 0, tried = 0, quoted = 0;
  for (size_t at = 0; at < length; at++) {
    if (text[at] == '"' && text[at - 1] != '\\') quoted = !quoted;
    if (quoted || (!isdigit((unsigned char)text[at]) && text[at] != '-')) continue;
    size_t size = strspn(text + at, "0123456789.eE+-");
    if (numbers++ < 80 || numbers % 400 == 0) {
      (void)snprintf(changed, length + 3, "%.*s\"%.*s\"%s", (int)at, text, (int)size, text + at,
                     text + at + size);
      scratch_write(scratch_path(state, "r/scene.json"), changed);
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      assert_int_equal(read_folder(folder, list), AMBULO_E_SCHEMA);
      assert_message(list, 0, "scene.json:");
      assert_message(list, 0, "number");
      ambulo_diagnostics_free(list);
      tried++;
    }
    at += size - 1;
  }
  assert_true(tried > 100);
  free(changed);
  free(text);
}

static void numbers_without_end(void **state) {
  static const char *const bad[][2] = {{"\"samples\": 161", "\"samples\": 1"},
                                       {"\"samples\": 161", "\"samples\": 2000000000"},
                                       {"\"samples\": 161", "\"samples\": 2.5"},
                                       {"\"duration\": ", "\"duration\": -"},
                                       {"\"duration\": ", "\"duration\": 1e99, \"was\": "},
                                       {"\"length\": ", "\"length\": -"}};
  char folder[SCRATCH_PATH + 8];
  char *text = open_scene(state, folder);
  size_t length = strlen(text) + 40;
  char *changed = malloc(length);
  assert_non_null(changed);
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    char *at = strstr(text, bad[i][0]);
    assert_non_null(at);
    (void)snprintf(changed, length, "%.*s%s%s", (int)(at - text), text, bad[i][1],
                   at + strlen(bad[i][0]));
    scratch_write(scratch_path(state, "r/scene.json"), changed);
    assert_int_equal(read_folder(folder, NULL), AMBULO_E_SCHEMA);
  }
  free(changed);
  free(text);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(texts_in_the_place_of_numbers),
                                     TEST(numbers_without_end)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
