/* What muscles did, as a table and as JSON; and what the table is never written over. */
#include "people/walk_muscles.h"
#include "support/fail_alloc.h"
#include "support/wellformed.h"

/* of row k, by the name of a column */
static double value_of(const ambulo_muscle_values *v, const ambulo_muscles *muscles,
                       const ambulo_model *model, int k, const char *name) {
  const struct {
    const char *prefix;
    const double *values;
  } kinds[] = {{"activation.", v->activation},
               {"force.", v->force},
               {"fiber_length.", v->fiber_length},
               {"fiber_speed.", v->fiber_speed},
               {"metabolic.", v->metabolic}};
  const int m = ambulo_muscles_count(muscles), d = ambulo_model_coordinate_count(model);
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
    size_t length = strlen(kinds[i].prefix);
    if (strncmp(name, kinds[i].prefix, length) == 0)
      return kinds[i].values[k * m + ambulo_muscles_find(muscles, name + length)];
  }
  if (strncmp(name, "reserve.", 8) == 0)
    return v->reserve[k * d + ambulo_model_find_coordinate(model, name + 8)];
  assert_int_equal(strncmp(name, "contact.", 8), 0);
  for (int j = 0; j < v->joints; j++) {
    size_t length = strlen(v->joint[j]);
    if (strncmp(name + 8, v->joint[j], length) == 0 && name[8 + length] == '.')
      return v->contact[3 * (k * v->joints + j) + name[9 + length] - 'x'];
  }
  fail();
  return 0.0;
}

static void both_tables_hold_every_value(void **state) {
  const walk_muscles *w = *state;
  ambulo_muscle_analysis *a = analysis_of(w, w->path, NULL);
  const ambulo_muscle_values *v = ambulo_muscle_analysis_values(a);
  static const char *const endings[] = {"muscles.csv", "muscles.sto"};
  for (int i = 0; i < 2; i++) {
    void *scratch = w->scratch;
    const char *path = scratch_path(&scratch, endings[i]);
    ambulo__motion *back = NULL;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    assert_int_equal(ambulo_muscle_analysis_write(a, path, 0, list), AMBULO_OK);
    assert_int_equal(ambulo_muscle_analysis_write(a, path, 0, list), AMBULO_OK); /* its own */
    assert_int_equal(ambulo__motion_read(path, 0, NULL, list, &back), AMBULO_OK);
    assert_int_equal(ambulo_diagnostics_count(list), 0);
    assert_int_equal(back->rows, v->rows);
    assert_int_equal(back->columns, 5 * 80 + 12 + 3 * 6);
    assert_true(back->unit_stated == i && !back->in_degrees);
    if (i == 1) assert_int_equal(back->declared_columns, back->columns + 1);
    for (int k = 0; k < back->rows; k++) {
      assert_true(back->time[k] == v->times[k]);
      for (int c = 0; c < back->columns; c++)
        assert_true(back->values[k * back->columns + c] ==
                    value_of(v, w->muscles, w->model, k, back->names[c]));
    }
    char *text = read_whole(path);
    assert_int_equal(strncmp(text, "# ambulo", 8), 0);
    if (i == 0) assert_non_null(strstr(text, "licence Apache-2.0; opensim-core"));
    free(text);
    ambulo__motion_free(back);
    ambulo_diagnostics_free(list);
  }
  ambulo_muscle_analysis_free(a);
}

/* the number behind "key": in `text` */
static double number_of(const char *text, const char *key) {
  char quoted[64];
  (void)snprintf(quoted, sizeof quoted, "\"%s\":", key);
  const char *at = strstr(text, quoted);
  if (!at) print_error("no %s\n", quoted);
  assert_non_null(at);
  return strtod(at + strlen(quoted), NULL);
}

static void the_summary_has_peaks_and_means(void **state) {
  const walk_muscles *w = *state;
  ambulo_muscle_analysis *a = analysis_of(w, w->path, NULL);
  const ambulo_muscle_values *v = ambulo_muscle_analysis_values(a);
  const int m = ambulo_muscles_count(w->muscles), s = ambulo_muscles_find(w->muscles, "soleus_l");
  char *text = NULL;
  assert_int_equal(ambulo_muscle_analysis_json(a, NULL, &text), AMBULO_OK);
  assert_true(is_json(text));
  double duration = v->times[v->rows - 1] - v->times[0], most = 0.0, power = 0.0;
  int peak = 0;
  for (int k = 0; k < v->rows; k++) {
    if (v->activation[k * m + s] > v->activation[peak * m + s]) peak = k;
    most = fmax(most, v->force[k * m + s]);
    if (k > 0)
      power += 0.5 * (v->times[k] - v->times[k - 1]) *
               (v->metabolic[k * m + s] + v->metabolic[(k - 1) * m + s]) / duration;
  }
  const char *joints = strstr(text, "\"joints\""), *reserves = strstr(text, "\"reserves\""),
             *muscles = strstr(text, "\"muscles\""), *soleus = strstr(text, "\"soleus_l\"");
  assert_true(joints && reserves && muscles && soleus && joints < reserves && reserves < muscles);
  assert_non_null(strstr(text, "\"muscles_of\": \"leg_muscles\""));
  assert_non_null(strstr(text, "\"source\": \"licence Apache-2.0; opensim-core"));
  assert_close(number_of(text, "duration"), duration, 1e-12);
  assert_close(number_of(text, "distance"), v->distance, 1e-12);
  assert_close(number_of(text, "resting"), 1.2, 0.0);
  assert_close(number_of(text, "bhargava"), v->bhargava, 1e-12);
  assert_close(number_of(text, "umberger"), v->umberger, 1e-12);
  assert_close(number_of(text, "bhargava_per_kg_metre"), v->bhargava * duration / v->distance,
               1e-12);
  double contact = number_of(strstr(joints, "\"knee_l\""), "contact");
  assert_true(contact > v->body_weight && contact < 8.0 * v->body_weight);
  assert_close(number_of(strstr(joints, "\"knee_l\""), "contact_body_weights"),
               contact / v->body_weight, 1e-12);
  assert_true(number_of(strstr(joints, "\"knee_l\""), "intersegmental") < contact);
  assert_true(number_of(reserves, "knee_angle_r") >= 0.0);
  assert_non_null(strstr(soleus, "\"group\": \"plantarflexors\""));
  assert_close(number_of(soleus, "activation"), v->activation[peak * m + s], 1e-12);
  assert_close(number_of(soleus, "time"), v->times[peak], 1e-12);
  assert_close(number_of(soleus, "force"), most, 1e-12);
  assert_close(number_of(soleus, "metabolic"), power, 1e-12);
  ambulo_text_free(text, NULL);
  ambulo_muscle_analysis_free(a);
}

/* a motion on the spot has no cost of transport */
static void without_a_way_there_is_no_cost_of_it(void **state) {
  const walk_muscles *w = *state;
  write_table(w, "mine", 2, NULL);
  ambulo_muscle_analysis *a = analysis_of(w, w->other, NULL);
  char *text = NULL;
  assert_int_equal(ambulo_muscle_analysis_json(a, NULL, &text), AMBULO_OK);
  assert_true(is_json(text));
  assert_non_null(strstr(text, "\"bhargava\""));
  assert_null(strstr(text, "per_kg_metre"));
  ambulo_text_free(text, NULL);
  ambulo_muscle_analysis_free(a);
}

/* ------------------------------------------------------------------- written over */

static void expect_refused(const ambulo_muscle_analysis *a, const char *path, const char *message) {
  char *before = read_whole(path);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_muscle_analysis_write(a, path, 0, list), AMBULO_E_IO);
  assert_message(list, 0, message);
  char *after = read_whole(path);
  assert_string_equal(after, before);
  free(before);
  free(after);
  ambulo_diagnostics_free(list);
}

static void inputs_and_others_files_stay(void **state) {
  const walk_muscles *w = *state;
  void *scratch = w->scratch;
  write_table(w, "ambulo motion: my own", 8, NULL);
  ambulo_muscle_analysis *a = analysis_of(w, w->other, NULL);
  const char *notes = scratch_path(&scratch, "notes.csv"), *link = scratch_path(&scratch, "l.csv");
  scratch_write(notes, "time,notes\n0,1\n");
  assert_int_equal(symlink(w->other, link), 0);
  expect_refused(a, w->other, "the output is the input");
  expect_refused(a, link, "the output is the input");
  expect_refused(a, notes, "the file exists, and ambulo did not write it");
  assert_int_equal(ambulo_muscle_analysis_write(a, notes, 1, NULL), AMBULO_OK);
  assert_int_equal(ambulo_muscle_analysis_write(a, w->other, 1, NULL), AMBULO_OK);
  assert_int_equal(ambulo_muscle_analysis_write(a, NULL, 1, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_muscle_analysis_write(NULL, notes, 1, NULL), AMBULO_E_ARGUMENT);
  ambulo_muscle_analysis_free(a);
}

static void memory_may_run_out_anywhere(void **state) {
  const walk_muscles *w = *state;
  void *scratch = w->scratch;
  const char *path = scratch_path(&scratch, "full.csv");
  long refused = 0;
  write_table(w, "mine", 3, NULL);
  for (long k = 0;; k++) {
    assert_in_range(k, 0, 5000);
    fail_alloc memory = fail_alloc_at(-1);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_muscle_analysis *a = NULL;
    char *text = NULL;
    assert_int_equal(ambulo_muscle_analysis_create(w->muscles, w->other, NULL, &hook, NULL, &a),
                     AMBULO_OK);
    memory.fail_at = memory.requests + k;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    ambulo_status written = ambulo_muscle_analysis_write(a, path, 0, list);
    assert_int_equal(written, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_int_equal(access(path, F_OK) == 0, !written);
    if (written) assert_message(list, 0, "error[E_MEMORY]");
    unlink(path);
    ambulo_status told = ambulo_muscle_analysis_json(a, &hook, &text);
    assert_int_equal(told, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_int_equal(text != NULL, !told);
    refused += memory.failed;
    ambulo_text_free(text, &hook);
    ambulo_muscle_analysis_free(a);
    ambulo_diagnostics_free(list);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  assert_true(refused > 5);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(both_tables_hold_every_value),
      cmocka_unit_test(the_summary_has_peaks_and_means),
      cmocka_unit_test(without_a_way_there_is_no_cost_of_it),
      cmocka_unit_test(inputs_and_others_files_stay),
      cmocka_unit_test(memory_may_run_out_anywhere),
  };
  return cmocka_run_group_tests_name("people/muscle_table", tests, open_walk_muscles,
                                     close_walk_muscles);
}
