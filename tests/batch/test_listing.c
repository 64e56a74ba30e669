/* A batch folder's own description: read back, and refused when it is damaged. */
#include "batch/listing.h"
#include "support/messages.h"
#include "support/scratch.h"

static const char description[] =
    "{\"name\": \"s\", \"version\": \"v\", \"problem_hash\": \"1\", \"text_hash\": \"2\",\n"
    "\"outputs\": [\"objective\", \"max(tau.pin)\"], \"output_units\": [\"\", \"N m\"],\n"
    "\"axis_units\": [\"kg\"]}\n";
static const char list[] = "id\tkey\tname\tmass\n"
                           "a\t000000000000000f\tlight\t60\n"
                           "b\t0000000000000010\theavy\t90\n";

static void write_folder(void **state, const char *cases) {
  scratch_write(scratch_path(state, "batch.json"), description);
  scratch_write(scratch_path(state, "cases.tsv"), cases);
}

static void it_is_read_back(void **state) {
  ambulo__listing l;
  unsigned long long key = 0;
  write_folder(state, list);
  assert_int_equal(ambulo__listing_load(*state, NULL, NULL, &l), AMBULO_OK);
  assert_int_equal(l.cases, 2);
  assert_int_equal(l.columns, AMBULO__LISTING_AXES + 1);
  assert_string_equal(ambulo__listing_title(&l, AMBULO__LISTING_AXES), "mass");
  assert_string_equal(ambulo__listing_cell(&l, 1, AMBULO__LISTING_NAME), "heavy");
  assert_true(ambulo__listing_key(&l, 1, &key) && key == 16);
  assert_string_equal(l.output[1], "max(tau.pin)");
  assert_string_equal(l.output_unit[1], "N m");
  assert_string_equal(l.axis_unit[0], "kg");
  ambulo__listing_free(&l);
}

static void damage_is_told_with_its_line(void **state) {
  static const char *const damaged[][2] = {{"", "cases.tsv"},
                                           {"id\tkey\n", "cases.tsv:1:1"},
                                           {"id\tkey\tname\tmass\na\t0f\tlight\n", "cases.tsv:2:1"},
                                           {"id\tkey\tname\tmass\na\t0f", "cases.tsv:1:1"},
                                           {"id\tkey\tname\na\t0f\tlight\n", "cases.tsv:1:1"}};
  for (size_t i = 0; i < sizeof damaged / sizeof *damaged; i++) {
    ambulo__listing l;
    ambulo_diagnostics *messages = ambulo_diagnostics_create(NULL);
    write_folder(state, damaged[i][0]);
    assert_int_not_equal(ambulo__listing_load(*state, NULL, messages, &l), AMBULO_OK);
    assert_message(messages, 0, damaged[i][1]);
    ambulo_diagnostics_free(messages);
  }
}

static void no_folder_no_listing(void **state) {
  ambulo__listing l;
  assert_int_equal(ambulo__listing_load(*state, NULL, NULL, &l), AMBULO_E_IO);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(it_is_read_back), TEST(damage_is_told_with_its_line),
                                     TEST(no_folder_no_listing)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
