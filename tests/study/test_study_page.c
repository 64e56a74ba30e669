/* The page of a batch folder: its table, its motions as far as there is room, whole or not at all.
 */
#include "ambulo/ambulo.h"
#include "ambulo/tools/tools.h"
#include "show/page.h"
#include "support/fail_alloc.h"
#include "support/fake_batch.h"
#include "support/inflate.h"
#include "support/walker_result.h"
#include "support/yaml.h"

/* two cases that end as one walk does, and one that nobody has solved */
static const char *study_folder(void **state, fake_batch *b) {
  walk w;
  char script[2 * SCRATCH_PATH + 200];
  walk_open(&w, 12);
  assert_int_equal(
      ambulo_report_write(w.problem, w.result, scratch_path(state, "walk"), NULL, NULL, NULL),
      AMBULO_OK);
  walk_close(&w);
  memset(b, 0, sizeof *b);
  b->state = state;
  snprintf(b->folder, sizeof b->folder, "%s/b", (const char *)*state);
  snprintf(script, sizeof script,
           "#!/bin/sh\ncase $* in *duration=3*) exit 2 ;; esac\ncp -r '%s/walk' \"$5\"\n",
           (const char *)*state);
  scratch_write(scratch_path(state, "worker"), script);
  assert_int_equal(chmod(scratch_path(state, "worker"), 0700), 0);
  assert_int_equal(sweep_load(state,
                              "axes:\n  - {key: time.duration, name: T, values: [1, 2, 3]}\n"
                              "outputs: [objective, {output: verdict, label: <how>}]\n",
                              NULL, &b->sweep),
                   AMBULO_OK);
  assert_int_equal(fake_batch_run(b, NULL, NULL), AMBULO_OK);
  return b->folder;
}

/* what stands packed behind a key of the page; to be freed */
static char *packed_in(const char *page, const char *key) {
  size_t bytes, size;
  char begin[40], *base64;
  snprintf(begin, sizeof begin, "\"%s\":\"", key);
  const char *from = strstr(page, begin);
  assert_non_null(from);
  from += strlen(begin);
  base64 = calloc(strcspn(from, "\"") + 1, 1);
  memcpy(base64, from, strcspn(from, "\""));
  char *packed = unbase64(base64, &bytes), *text = (char *)unpacked(packed, bytes, &size);
  free(base64);
  free(packed);
  return text;
}

static void a_page_of_a_study(void **state) {
  fake_batch b;
  const char *folder = study_folder(state, &b), *path = scratch_path(state, "page.html");
  assert_int_equal(ambulo_batch_page(folder, path, NULL, NULL, NULL, NULL), AMBULO_OK);
  char *page = read_whole(path), *table = packed_in(page, "table");
  assert_null(strstr(table, "<how>"));
  assert_non_null(strstr(table, "{\"columns\":[\"T, s\",\"objective\",\"\\u003chow>\"],"
                                "\"axes\":1,\"zipped\":0,\"cases\":[{\"id\":\""));
  assert_non_null(strstr(table, "\"state\":\"feasible\",\"values\":[2,0.3,\"feasible\"]}"));
  assert_non_null(strstr(table, "\"state\":\"invalid\",\"values\":[3,null,null]}"));
  assert_non_null(strstr(table, "\"shown\":[0,1]}"));
  assert_non_null(strstr(page, "\"study\":{\"name\":\"s\",\"motions\":[{\"count\":2,"));
  free(table);
  free(page);
  fake_batch_close(&b);
}

static void without_room_there_are_no_motions(void **state) {
  fake_batch b;
  const char *folder = study_folder(state, &b), *path = scratch_path(state, "page.html");
  ambulo_page_options options = ambulo_page_options_default();
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  options.megabytes = 0.0;
  assert_int_equal(ambulo_batch_page(folder, path, &options, NULL, list, NULL), AMBULO_OK);
  assert_message(list, 0, "2 cases are in the table without motion: 0 MB");
  char *page = read_whole(path), *table = packed_in(page, "table");
  assert_non_null(strstr(table, "\"shown\":[]}"));
  assert_non_null(strstr(page, "\"motions\":[]"));
  free(table);
  free(page);
  ambulo_diagnostics_free(list);
  fake_batch_close(&b);
}

/* no page is larger than it may be, from one without motions on */
static void pages_keep_to_their_size(void **state) {
  fake_batch b;
  const char *folder = study_folder(state, &b), *path = scratch_path(state, "page.html");
  ambulo_page_options options = ambulo_page_options_default();
  double size[2], count = 20.0;
  for (int i = 0; i < 2; i++) {
    options.megabytes = i ? 3.0 : 0.0;
    assert_int_equal(ambulo_batch_page(folder, path, &options, NULL, NULL, NULL), AMBULO_OK);
    char *page = read_whole(path);
    size[i] = (double)strlen(page);
    free(page);
  }
  for (int i = 1; i < (int)count; i++) {
    double most = size[0] + 100.0 + (size[1] - size[0]) * i / count;
    options.megabytes = 1e-6 * most;
    assert_int_equal(ambulo_batch_page(folder, path, &options, NULL, NULL, NULL), AMBULO_OK);
    char *page = read_whole(path);
    assert_true((double)strlen(page) <= most);
    free(page);
  }
  fake_batch_close(&b);
}

static void what_is_refused(void **state) {
  fake_batch b;
  const char *folder = study_folder(state, &b), *path = scratch_path(state, "page.html");
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  scratch_write(path, "<!doctype html><p>my thesis</p>");
  assert_int_equal(ambulo_batch_page(folder, path, NULL, NULL, list, NULL), AMBULO_E_IO);
  assert_file_equal(path, "<!doctype html><p>my thesis</p>");
  assert_int_equal(ambulo_batch_page(scratch_path(state, "walk"), scratch_path(state, "p.html"),
                                     NULL, NULL, list, NULL),
                   AMBULO_E_IO);
  assert_int_not_equal(access(scratch_path(state, "p.html"), F_OK), 0);
  assert_int_equal(ambulo_batch_page(NULL, path, NULL, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_batch_page(folder, NULL, NULL, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_page_write(&folder, 1, scratch_path(state, "p.html"), NULL, NULL, list),
                   AMBULO_E_SCHEMA);
  ambulo_diagnostics_free(list);
  fake_batch_close(&b);
}

static void memory_may_run_out_anywhere(void **state) {
  fake_batch b;
  const char *folder = study_folder(state, &b), *path = scratch_path(state, "page.html");
  for (long k = 0;; k += 1 + k / 20) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_status status = ambulo_batch_page(folder, path, NULL, &allocator, NULL, NULL);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_int_equal(memory.live, 0);
    assert_int_equal(access(path, F_OK) == 0, status == AMBULO_OK);
    if (!memory.failed) break;
  }
  fake_batch_close(&b);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(a_page_of_a_study), TEST(without_room_there_are_no_motions),
      TEST(pages_keep_to_their_size), TEST(what_is_refused), TEST(memory_may_run_out_anywhere)};
  return cmocka_run_group_tests_name("study/study_page", tests, NULL, NULL);
}
