/* Cases of a study: a form with numbers in place of what changes, leaves, series in steps. */
#include "show/case_data.h"

#include "support/fail_alloc.h"
#include "support/test.h"

static const char summary[] =
    "{\"problem\": \"a \\\"b\\\"\", \"model\": \"m\", \"verdict\": \"optimal\", \"gait\": "
    "{\"speed\": "
    "1.23456789, \"steps\": 2}, \"work\": {\"positive\": 1.5, \"coordinates\": {\"knee\": 7}}, "
    "\"ground_reaction\": {\"foot\": {\"peak\": 1.25, \"impulse_up\": 9}}, \"sensitivities\": [1], "
    "\"audit\": {\"fault\": null, \"kkt\": 1e-7, \"rank\": 1234567, \"size\": 3}}";
static const char scene[] =
    "{\"schema\": \"ambulo-scene/1\", \"input_hash\": \"77\", \"samples\": 3, \"mass\": 50, "
    "\"weight\": 490, \"units\": {\"length\": 1e-4, \"angle\": 1e-4, \"torque\": 1e-2, \"power\": "
    ".1, \"force\": .1}, \"place\": [1, 2, 3], \"points\": [[[20, 20, -10], [0, 0, 0], [4, 5]]], "
    "\"coordinates\": [{\"unit\": \"rad\", \"q\": [34, 0, 0], \"tau\": [100, 50, 0], \"people_q\": "
    "{\"source\": 0, \"mean\": [0, 68, 0]}}, {\"unit\": \"m\", \"q\": [20, 0, 0], \"power\": [5, "
    "0, "
    "0]}], \"forces\": [{\"force\": [[98, 0, 0]], \"pressure\": [[0, 20, 0]]}], \"worn\": "
    "[{\"unit\": \"N\", \"effort\": [98, 0, 0]}, {\"unit\": \"N m\", \"effort\": [50, 0, 1.5]}]}";

typedef struct files {
  ambulo__page_result result;
} files;

static files open_files(const char *one, const char *other, const ambulo_allocator *a) {
  files f = {.result = {.summary = {.text = NULL}}};
  assert_int_equal(
      ambulo__yaml_load_text(one, strlen(one), "summary", a, NULL, &f.result.summary.document),
      AMBULO_OK);
  assert_int_equal(
      ambulo__yaml_load_text(other, strlen(other), "scene", a, NULL, &f.result.scene.document),
      AMBULO_OK);
  return f;
}

static void close_files(files *f) {
  ambulo__yaml_free(f->result.summary.document);
  ambulo__yaml_free(f->result.scene.document);
}

static void assert_leaves(const ambulo__case_data *data, const char *const *want, int count) {
  const char *leaf = ambulo__text_data(&data->leaves);
  assert_int_equal(data->leaf_count, count);
  for (int i = 0; i < count; i++, leaf += strlen(leaf) + 1) assert_string_equal(leaf, want[i]);
}

static void a_case(void **state) {
  (void)state;
  static const char form[] =
      "{\"summary\":{\"problem\":0,\"verdict\":1,\"gait\":{\"speed\":2,\"steps\":3},\"work\":{"
      "\"positive\":4},\"ground_reaction\":{\"foot\":{\"peak\":5}},\"audit\":{\"fault\":6,\"kkt\":"
      "7,\"rank\":8}},\"scene\":{\"mass\":9,\"weight\":10,\"place\":[11,12,13],\"points\":[[-1,-2,"
      "[14,15]]],\"coordinates\":[{\"unit\":16,\"q\":-3,\"tau\":-4,\"people_q\":{\"source\":17,"
      "\"mean\":-5}},{\"unit\":18,\"q\":-6,\"power\":-7}],\"forces\":[{\"force\":[-8],\"pressure\":"
      "[-9]}],\"worn\":[{\"unit\":19,\"effort\":-10},{\"unit\":20,\"effort\":[21,22,23]}]}}";
  static const char *const leaves[] = {
      "\"a \\\"b\\\"\"", "\"optimal\"", "1.23457", "2",     "1.5",     "1.25", "null", "1e-07",
      "1234567",         "50",          "490",     "1",     "2",       "3",    "4",    "5",
      "\"rad\"",         "0",           "\"m\"",   "\"N\"", "\"N m\"", "50",   "0",    "1.5"};
  static const double motion[][3] = {{1, 2, 2.5}, {0, 0, 0}, {1, 1, 1},    {2, 3, 4}, {0, 2, 4},
                                     {1, 1, 1},   {1, 1, 1}, {10, 10, 10}, {0, 1, 2}, {10, 10, 10}};
  files f = open_files(summary, scene, NULL);
  ambulo__case_data data;
  assert_int_equal(ambulo__case_data_create(&f.result, NULL, &data), AMBULO_OK);
  assert_string_equal(ambulo__text_data(&data.form), form);
  assert_leaves(&data, leaves, sizeof leaves / sizeof leaves[0]);
  assert_string_equal(ambulo__text_data(&data.kinds), "llatalpflf");
  assert_int_equal(data.samples, 3);
  assert_int_equal(data.length, sizeof motion / sizeof motion[0][0]);
  for (size_t s = 0; s < sizeof motion / sizeof motion[0]; s++)
    for (size_t k = 0; k < 3; k++) assert_close(data.motion[3 * s + k], motion[s][k], 1e-6);
  ambulo__case_data_free(&data);
  close_files(&f);
}

/* lists that grow beyond all bounds are no series, nor is what is empty a case that fails */
static void odd_cases(void **state) {
  (void)state;
  files f = open_files("{\"problem\": 1}",
                       "{\"samples\": 3, \"points\": [8000000000000, 8000000000000, "
                       "8000000000000], \"bones\": [], \"force\": [1, a, 2]}",
                       NULL);
  ambulo__case_data data;
  assert_int_equal(ambulo__case_data_create(&f.result, NULL, &data), AMBULO_OK);
  assert_string_equal(ambulo__text_data(&data.form),
                      "{\"summary\":{\"problem\":0},\"scene\":{\"points\":[1,2,3],\"bones\":[],"
                      "\"force\":[4,5,6]}}");
  assert_int_equal(data.length, 0);
  ambulo__case_data_free(&data);
  close_files(&f);
}

static void steps(void **state) {
  (void)state;
  ambulo__text_buffer out;
  ambulo__text_init(&out, NULL);
  ambulo__case_data_steps(&out, 2.0);
  assert_string_equal(ambulo__text_data(&out),
                      "{\"l\":0.001,\"a\":0.0017,\"t\":0.005,\"p\":0.005,\"f\":0.001}");
  ambulo__text_free(&out);
}

static void memory_may_run_out_anywhere(void **state) {
  (void)state;
  files f = open_files(summary, scene, NULL);
  for (long k = 0;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__case_data data;
    ambulo_status status = ambulo__case_data_create(&f.result, &allocator, &data);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    if (!status) ambulo__case_data_free(&data);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  close_files(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_case),
      cmocka_unit_test(odd_cases),
      cmocka_unit_test(steps),
      cmocka_unit_test(memory_may_run_out_anywhere),
  };
  return cmocka_run_group_tests_name("page/case_data", tests, NULL, NULL);
}
