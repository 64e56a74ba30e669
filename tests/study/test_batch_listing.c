/* A batch folder's own description: read back, and refused when it is damaged. */
#include "formats/read_file.h"
#include "study/study.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/scratch.h"
#include "support/sealed_lines.h"
#include "support/sweep_files.h"
#include "support/yaml_mutation.h"

static const char list[] = "id\tkey\tname\tmass\n"
                           "a\t000000000000000f\tlight\t60\n"
                           "b\t0000000000000010\theavy\t90\n";

/* batch.json of a list of two cases with this checksum */
static void write_description(void **state, const char *schema, const char *digest) {
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__text_append_format(
      &text,
      "{\n  \"schema\": \"%s\",\n  \"name\": \"s\",\n  \"version\": \"v\",\n"
      "  \"problem_hash\": \"1\",\n  \"text_hash\": \"2\",\n  \"cases\": 2,\n"
      "  \"cases_sha256\": \"%s\",\n  \"outputs\": [\"objective\", \"max(tau.pin)\"],\n"
      "  \"output_labels\": [\"effort\", \"max(tau.pin)\"],\n"
      "  \"output_units\": [\"\", \"N m\"],\n  \"axes\": [\"subject.mass\"],\n"
      "  \"zipped_axes\": 1,\n  \"axis_labels\": [\"body mass\"],\n  \"axis_units\": [\"kg\"]",
      schema, digest);
  ambulo__seal(&text);
  scratch_write(scratch_path(state, "batch.json"), ambulo__text_data(&text));
  ambulo__text_free(&text);
}

/* a folder whose checksums fit, whatever the list says */
static void write_folder(void **state, const char *cases) {
  char digest[AMBULO__SHA256_TEXT];
  ambulo__sha256_of(cases, strlen(cases), digest);
  write_description(state, "ambulo-batch/2", digest);
  scratch_write(scratch_path(state, "cases.tsv"), cases);
}

static void refuse(void **state, ambulo_status want, const char *message, int want_damaged) {
  ambulo_sweep *s;
  int damaged = -1;
  ambulo_diagnostics *messages = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo__study_try(*state, NULL, messages, &s, &damaged), want);
  assert_message(messages, 0, message);
  assert_int_equal(damaged, want_damaged);
  ambulo_diagnostics_free(messages);
}

static void it_is_read_back(void **state) {
  ambulo_sweep *s;
  write_folder(state, list);
  assert_int_equal(ambulo__study_load(*state, NULL, NULL, &s), AMBULO_OK);
  assert_int_equal(s->case_count, 2);
  assert_int_equal(s->axes, 1);
  assert_string_equal(s->axis[0].name, "mass");
  assert_string_equal(s->axis[0].key, "subject.mass");
  assert_string_equal(s->cases[1].name, "heavy");
  assert_string_equal(ambulo_sweep_value(s, 1, 0), "90");
  assert_true(s->cases[1].key == 16);
  assert_string_equal(s->output[1].path, "max(tau.pin)");
  assert_string_equal(s->output[1].unit, "N m");
  assert_string_equal(s->output[0].label, "effort");
  assert_string_equal(s->axis[0].unit, "kg");
  assert_string_equal(s->axis[0].label, "body mass");
  assert_int_equal(s->zipped, 1);
  ambulo_sweep_free(s);
}

/* what a sweep file says is what its folder says */
static void a_sweep_is_written_and_read_back(void **state) {
  ambulo_allocator plain = ambulo__allocator_or_default(NULL);
  ambulo_sweep *s = NULL, *back = NULL;
  assert_int_equal(
      sweep_load(state,
                 "axes:\n  - {key: time.intervals, name: n, values: [8, 10]}\n"
                 "  - {key: time.duration, name: \"a\\tb\", label: long, unit: s, values: [1, 2]}\n"
                 "combine: zip\noutputs: [objective, {output: duration, label: d, unit: s}]\n"
                 "cases:\n  - {name: own, set: {time.intervals: 9}}\n",
                 NULL, &s),
      AMBULO_OK);
  assert_int_equal(ambulo__study_describe(s, *state, &plain, NULL), AMBULO_OK);
  assert_int_equal(ambulo__study_load(*state, NULL, NULL, &back), AMBULO_OK);
  assert_true(back->case_count == 3 && back->axes == 2 && back->outputs == 2 && back->zipped == 2);
  assert_string_equal(back->axis[1].name, "a b");
  assert_string_equal(back->axis[1].label, "long");
  assert_string_equal(back->axis[0].label, "n");
  assert_string_equal(back->output[1].unit, "s");
  assert_string_equal(back->problem_hash, s->problem_hash);
  assert_string_equal(back->version, s->version);
  for (int k = 0; k < 3; k++) {
    assert_string_equal(back->cases[k].id, s->cases[k].id);
    assert_string_equal(back->cases[k].name, s->cases[k].name);
    assert_true(back->cases[k].key == s->cases[k].key);
    for (int i = 0; i < 2; i++)
      assert_string_equal(ambulo_sweep_value(back, k, i), ambulo_sweep_value(s, k, i));
  }
  ambulo_sweep_free(back);
  ambulo_sweep_free(s);
}

/* every byte of both files changed, every length cut: cases.tsv also where a line ends */
static void damage_is_told(void **state) {
  static const char *const files[] = {"cases.tsv", "batch.json"};
  write_folder(state, list);
  for (int f = 0; f < 2; f++) {
    const char *path = scratch_path(state, files[f]);
    char *text = read_whole(path), message[64];
    snprintf(message, sizeof message, "%s: error[E_IO]: damaged", files[f]);
    for (size_t i = 0; i < strlen(text); i++) {
      char kept = text[i];
      text[i] = kept == 'x' ? 'y' : 'x';
      scratch_write(path, text);
      refuse(state, AMBULO_E_IO, message, 1);
      text[i] = kept;
    }
    scratch_write(path, text);
    for (size_t length = strlen(text); length-- > 0;) {
      assert_int_equal(truncate(path, (off_t)length), 0);
      refuse(state, AMBULO_E_IO, message, 1);
    }
    scratch_write(path, text);
    free(text);
  }
  assert_int_equal(unlink(scratch_path(state, "cases.tsv")), 0);
  refuse(state, AMBULO_E_IO, "cases.tsv: error[E_IO]: damaged", 1);
}

/* written as a whole, and no list all the same */
static void nonsense_is_told_with_its_line(void **state) {
  static const char *const damaged[][2] = {
      {"", "cases.tsv"},
      {"id\tkey\n", "cases.tsv:1:1"},
      {"id\tkey\tname\tmass\na\t0f\tlight\n", "cases.tsv:2:1"},
      {"id\tkey\tname\tmass\na\t0f", "cases.tsv:2:1"},
      {"id\tkey\tname\na\t0f\tlight\n", "cases.tsv:1:1"},
      {"id\tkey\tname\tmass\na\t000000000000000f\tx\t1\n", "cases.tsv:3:1"},
      {"id\tkey\tname\tmass\na\t000000000000000f\tx\t1\nb\tzz\ty\t2\n", "cases.tsv:3:1"}};
  for (size_t i = 0; i < sizeof damaged / sizeof *damaged; i++) {
    write_folder(state, damaged[i][0]);
    refuse(state, AMBULO_E_IO, damaged[i][1], 1);
  }
}

static void folders_of_other_versions_are_named(void **state) {
  write_description(state, "ambulo-batch/1", "");
  refuse(state, AMBULO_E_PROBLEM, "filled by another version of ambulo (ambulo-batch/1", 0);
  write_description(state, "ambulo-batch/3", "");
  refuse(state, AMBULO_E_PROBLEM, "filled by another version of ambulo (ambulo-batch/3)", 0);
}

/* sealed, with a value of another type in each line in turn */
static void fields_of_another_type_are_damage(void **state) {
  int tried = 0;
  write_folder(state, list);
  const char *path = scratch_path(state, "batch.json");
  char *text = read_whole(path);
  for (int line = 0; line < 30; line++) {
    for (int i = 2; i < MUTATION_VALUES; i++) {
      ambulo_sweep *s;
      int damaged = 0;
      ambulo__text_buffer changed = sealed_with(text, line, mutation_values[i]);
      if (!changed.data) break;
      scratch_write(path, changed.data);
      ambulo__text_free(&changed);
      tried++;
      ambulo_status status = ambulo__study_try(*state, NULL, NULL, &s, &damaged);
      /* legal where a text is; where a list of one text is */
      int is_word = i == 2 || i == 4, is_list = i == 6;
      assert_true(is_word || is_list || status != AMBULO_OK);
      assert_true(status == AMBULO_OK || damaged || status == AMBULO_E_PROBLEM);
      if (!status) ambulo_sweep_free(s);
    }
  }
  free(text);
  assert_true(tried >= 10 * (MUTATION_VALUES - 2));
}

/* the k-th request for memory fails: E_MEMORY, and nothing is called damaged */
static void without_memory_nothing_is_damaged(void **state) {
  write_folder(state, list);
  for (long k = 0;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_sweep *s;
    int damaged = -1;
    ambulo_status status = ambulo__study_try(*state, &hook, NULL, &s, &damaged);
    if (!status) ambulo_sweep_free(s);
    assert_int_equal(memory.live, 0);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_int_equal(damaged, 0);
    if (!memory.failed) break;
  }
}

static void no_folder_no_listing(void **state) {
  ambulo_sweep *s;
  assert_int_equal(ambulo__study_load(*state, NULL, NULL, &s), AMBULO_E_IO);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(it_is_read_back),
                                     TEST(a_sweep_is_written_and_read_back),
                                     TEST(damage_is_told),
                                     TEST(fields_of_another_type_are_damage),
                                     TEST(nonsense_is_told_with_its_line),
                                     TEST(folders_of_other_versions_are_named),
                                     TEST(without_memory_nothing_is_damaged),
                                     TEST(no_folder_no_listing)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
