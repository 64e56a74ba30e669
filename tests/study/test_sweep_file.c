/* Sweep files: what case lists follow from them. */
#include "study/study.h"
#include "support/messages.h"
#include "support/sweep_files.h"

static ambulo_sweep *loaded(void **state, const char *text) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_sweep *sweep = NULL;
  ambulo_status status = sweep_load(state, text, list, &sweep);
  char buffer[1024] = "";
  ambulo_diagnostics_format(list, 0, buffer, sizeof buffer);
  if (status) print_error("%s\n", buffer);
  assert_int_equal(status, AMBULO_OK);
  ambulo_diagnostics_free(list);
  return sweep;
}

static void refused(void **state, const char *text, const char *message) {
  sweep_refused_over(state, sweep_problem, text, message);
}

static ambulo_case case_of(const ambulo_sweep *sweep, int index) {
  ambulo_case one;
  assert_int_equal(ambulo_sweep_case(sweep, index, &one), AMBULO_OK);
  return one;
}

#define TWO_AXES                                                                                   \
  "axes:\n  - {key: time.intervals, name: n, values: [8, 10]}\n"                                   \
  "  - {key: time.duration, name: T, range: [0.8, 1.2, 0.2]}\n"

static void a_grid_with_the_last_axis_fastest(void **state) {
  ambulo_sweep *s = loaded(state, TWO_AXES "case_name: \"{n}-{T}\"\n");
  assert_int_equal(ambulo_sweep_case_count(s), 6);
  assert_string_equal(case_of(s, 0).name, "8-0.8");
  assert_string_equal(case_of(s, 1).name, "8-1");
  assert_string_equal(case_of(s, 5).name, "10-1.2");
  assert_string_equal(case_of(s, 5).overrides[1], "time.duration=1.2");
  assert_int_equal(case_of(s, 5).previous, -1);
  ambulo_sweep_free(s);
}

static void a_filter_renames_nothing(void **state) {
  ambulo_sweep *all = loaded(state, TWO_AXES);
  ambulo_sweep *some = loaded(state, TWO_AXES "filters: [\"T < 1.1\", \"n == 10\"]\n");
  assert_int_equal(ambulo_sweep_case_count(some), 2);
  assert_string_equal(case_of(some, 0).id, case_of(all, 3).id);
  assert_true(case_of(some, 0).key == case_of(all, 3).key);
  assert_true(case_of(all, 3).key != case_of(all, 4).key);
  ambulo_sweep_free(all);
  ambulo_sweep_free(some);
}

static void zip_goes_side_by_side(void **state) {
  ambulo_sweep *s = loaded(state, "axes:\n  - {key: time.intervals, values: [8, 10, 12]}\n"
                                  "  - {key: time.duration, linspace: [1, 2, 3]}\ncombine: zip\n");
  assert_int_equal(ambulo_sweep_case_count(s), 3);
  assert_string_equal(ambulo_sweep_value(s, 1, 1), "1.5");
  ambulo_sweep_free(s);
  refused(state, TWO_AXES "combine: zip\n", "zip needs axes of one length");
}

static void a_chain_follows_its_axis(void **state) {
  ambulo_sweep *plain = loaded(state, TWO_AXES);
  ambulo_sweep *s = loaded(state, TWO_AXES "start_from: neighbour\nalong: n\n");
  for (int k = 0; k < 3; k++) assert_int_equal(case_of(s, k).previous, -1);
  for (int k = 3; k < 6; k++) assert_int_equal(case_of(s, k).previous, k - 3);
  assert_true(case_of(s, 0).key == case_of(plain, 0).key);
  assert_true(case_of(s, 4).key != case_of(plain, 4).key);
  ambulo_sweep_free(s);
  ambulo_sweep_free(plain);
  refused(state, TWO_AXES "start_from: neighbour\nalong: height\n", "unknown axis");
  /* what a filter takes away is stepped over */
  s = loaded(state, "axes:\n  - {key: time.duration, name: T, range: [1, 5, 1]}\n"
                    "filters: [\"T != 2\", \"T != 3\"]\nstart_from: neighbour\nalong: T\n");
  assert_int_equal(case_of(s, 0).previous, -1);
  assert_int_equal(case_of(s, 1).previous, 0);
  assert_int_equal(case_of(s, 2).previous, 1);
  ambulo_sweep_free(s);
  /* axes that advance together are one */
  scratch_write(scratch_path(state, "t.csv"), "time.duration,time.intervals\n1,8\n2,10\n3,12\n");
  s = loaded(state, "table: t.csv\naxes:\n  - {key: \"objective[0].weight\", values: [1, 2]}\n"
                    "start_from: neighbour\nalong: time.intervals\n");
  assert_int_equal(ambulo_sweep_case_count(s), 6);
  int linked = 0;
  for (int k = 0; k < 6; k++) linked += case_of(s, k).previous >= 0;
  assert_int_equal(linked, 4);
  ambulo_sweep_free(s);
}

/* of n and T in that order; a case continues the one `apart` places before it, `linked` do */
static void chain_found(void **state, const char *n, const char *T, int apart, int linked) {
  char text[300];
  (void)snprintf(text, sizeof text,
                 "axes:\n  - {key: time.intervals, values: %s}\n  - {key: %s}\n"
                 "start_from: neighbour\n",
                 n, T);
  ambulo_sweep *s = loaded(state, text);
  for (int k = 0; k < ambulo_sweep_case_count(s); k++) {
    int previous = case_of(s, k).previous;
    if (previous >= 0) assert_int_equal(k - previous, apart);
    linked -= previous >= 0;
  }
  assert_int_equal(linked, 0);
  ambulo_sweep_free(s);
}

static void a_chain_is_found(void **state) {
  chain_found(state, "[8, 10, 12]", "time.duration, values: [1, 2]", 2, 4); /* the longer one */
  chain_found(state, "[8, 10]", "time.duration, values: [2, 1]", 1, 2);     /* else the last */
  chain_found(state, "[8, 10]", "time.duration, values: [1, 3, 2]", 3, 3);  /* out of order */
  chain_found(state, "[8, 10]", "name, values: [a, b, c]", 3, 3);           /* words */
  refused(state, "axes:\n  - {key: time.intervals, values: [8]}\nstart_from: neighbour\n",
          "no axis has numbers in order");
}

static void a_table_is_one_axis(void **state) {
  scratch_write(scratch_path(state, "t.csv"),
                "# durations\ntime.duration,time.intervals\n1,8\n1.5,10\n");
  ambulo_sweep *s =
      loaded(state, "table: t.csv\naxes:\n  - {key: \"objective[0].weight\", values: [1, 2]}\n");
  assert_int_equal(ambulo_sweep_case_count(s), 4);
  assert_string_equal(ambulo_sweep_value(s, 1, 0), "1");
  assert_string_equal(ambulo_sweep_value(s, 1, 1), "1.5");
  assert_string_equal(ambulo_sweep_value(s, 1, 2), "10");
  ambulo_sweep_free(s);
}

#define SAMPLES(kind)                                                                              \
  kind ": {samples: 20, seed: 7, axes: [{key: time.duration, range: [1, 2]}, "                     \
       "{key: \"objective[0].weight\", range: [0, 20]}]}\n"

static void a_latin_hypercube_uses_each_stratum_once(void **state) {
  ambulo_sweep *s = loaded(state, SAMPLES("latin_hypercube"));
  ambulo_sweep *again = loaded(state, SAMPLES("latin_hypercube"));
  assert_int_equal(ambulo_sweep_case_count(s), 20);
  int used[2][20] = {{0}};
  for (int k = 0; k < 20; k++) {
    used[0][(int)((atof(ambulo_sweep_value(s, k, 0)) - 1.0) * 20.0)]++;
    used[1][(int)atof(ambulo_sweep_value(s, k, 1))]++;
    assert_string_equal(case_of(s, k).id, case_of(again, k).id);
  }
  ambulo_sweep *dice =
      loaded(state, "random: {samples: 60, seed: 7, axes: [{key: time.intervals, range: [7, 9], "
                    "whole: true}]}\n");
  int thrown[3] = {0};
  for (int k = 0; k < 60; k++) thrown[atoi(ambulo_sweep_value(dice, k, 0)) - 7]++;
  assert_true(thrown[0] > 10 && thrown[1] > 10 && thrown[2] > 10);
  ambulo_sweep_free(dice);
  for (int i = 0; i < 20; i++) {
    assert_int_equal(used[0][i], 1);
    assert_int_equal(used[1][i], 1);
  }
  ambulo_sweep_free(s);
  ambulo_sweep_free(again);
  s = loaded(state, SAMPLES("random"));
  assert_int_equal(ambulo_sweep_case_count(s), 20);
  ambulo_sweep_free(s);
}

static void explicit_cases_come_last(void **state) {
  ambulo_sweep *s =
      loaded(state, TWO_AXES "filters: [\"n == 8\"]\ncases:\n"
                             "  - {name: own, set: {time.intervals: 30, solver.time_limit: 5}}\n");
  assert_int_equal(ambulo_sweep_case_count(s), 4);
  ambulo_case own = case_of(s, 3);
  assert_string_equal(own.name, "own");
  assert_int_equal(own.override_count, 2);
  assert_string_equal(own.overrides[0], "time.intervals=30");
  assert_string_equal(own.overrides[1], "solver.time_limit=5");
  assert_string_equal(ambulo_sweep_value(s, 0, 2), "");
  ambulo_sweep_free(s);
}

static void a_named_file_is_part_of_the_key(void **state) {
  const char *text = "axes:\n  - {key: model, values: [two.yaml]}\n";
  scratch_write(scratch_path(state, "two.yaml"), sweep_model);
  ambulo_sweep *s = loaded(state, text);
  char changed_model[sizeof sweep_model + 20];
  snprintf(changed_model, sizeof changed_model, "# changed\n%s", sweep_model);
  scratch_write(scratch_path(state, "two.yaml"), changed_model);
  ambulo_sweep *changed = loaded(state, text);
  assert_string_equal(case_of(s, 0).id, case_of(changed, 0).id);
  assert_true(case_of(s, 0).key != case_of(changed, 0).key);
  ambulo_sweep_free(s);
  ambulo_sweep_free(changed);
}

static void the_base_problem_is_part_of_the_key(void **state) {
  const char *text = "axes:\n  - {key: time.duration, values: [1]}\n";
  ambulo_sweep *s = loaded(state, text), *changed = NULL;
  char problem[sizeof sweep_problem];
  memcpy(problem, sweep_problem, sizeof problem);
  strstr(problem, "weight: 1")[8] = '2';
  assert_int_equal(sweep_load_over(state, problem, text, NULL, NULL, &changed), AMBULO_OK);
  assert_string_equal(case_of(s, 0).id, case_of(changed, 0).id);
  assert_true(case_of(s, 0).key != case_of(changed, 0).key);
  ambulo_sweep_free(s);
  ambulo_sweep_free(changed);
}

static void a_model_key_is_an_axis(void **state) {
  ambulo_sweep *s =
      loaded(state, "axes:\n  - {key: \"model.links[rod].body.mass\", values: [1, 2]}\n");
  assert_string_equal(case_of(s, 1).overrides[0], "model.links[rod].body.mass=2");
  ambulo_sweep_free(s);
  refused(state, "axes:\n  - {key: \"model.links[rod].bdy.mass\", values: [1, 2]}\n",
          "did you mean 'body'?");
}

/* told once, where it stands, before anything is computed */
static void a_wrong_key_or_value_is_told_with_its_place(void **state) {
  refused(state, "axes:\n  - {key: time.duratoin, values: [1]}\n",
          "s.yaml:6:11: error[E_SCHEMA]: time.duratoin: unknown key 'duratoin' in time\n"
          "  hint: did you mean 'duration'?");
  refused(state, "axes:\n  - {key: tmie.duration, values: [1]}\n", "did you mean 'time'?");
  refused(state, "axes:\n  - {key: time.duration, values: [1, long]}\n", "s.yaml:6:38: error");
  refused(state, "axes:\n  - {key: time.duration, values: [1, .nan]}\n",
          "got '.nan'; expected a finite number");
  refused(state, "axes:\n  - {key: model, values: [nothing.yaml]}\n", "nothing.yaml");
  refused(state, "cases:\n  - {name: a, set: {time.duratoin: 1}}\n", "s.yaml:6:36: error");
}

static void names_are_used_once(void **state) {
  refused(state, TWO_AXES "  - {key: time.duration, name: T2, values: [1]}\n",
          "the key 'time.duration' is that of another axis (line 7)");
  refused(state, TWO_AXES "  - {key: name, name: T, values: [a]}\n", "the name 'T' is that of");
  refused(state, TWO_AXES "case_name: \"{n}\"\n", "two cases are named '8'");
  refused(state, TWO_AXES "case_name: \"{n}-{t}\"\n",
          "unknown axis in the name of a case (got '{t}')");
  refused(state, TWO_AXES "case_name: \"{n}_{T\"\n",
          "s.yaml:8:12: error[E_SCHEMA]: a brace without its other half in the name of a case (got "
          "'{T')");
  refused(state, TWO_AXES "case_name: \"{n}_T}\"\n", "(got '}')");
  refused(state, TWO_AXES "case_name: \"{n{T}\"\n", "(got '{n{T}')");
  refused(state, TWO_AXES "cases:\n  - {name: \"x{T\", set: {time.duration: 3}}\n",
          "s.yaml:9:12: error[E_SCHEMA]: a brace");
  refused(state, TWO_AXES "filters: [\"speed != 3\"]\n", "unknown axis in filter");
  refused(state, TWO_AXES "filters: \"n > 8\"\n", "expected a list");
}

static void table_refused(void **state, const char *table, const char *message) {
  scratch_write(scratch_path(state, "t.csv"), table);
  refused(state, "table: t.csv\n", message);
}

static void a_bad_cell_is_told_with_line_and_column(void **state) {
  table_refused(state, "time.duration,time.intervals\n1,8\n2,1o\n",
                "t.csv:3:3: error[E_SCHEMA]: got '1o' in column 'time.intervals', which begins "
                "with '8' in line 2; expected a number");
  table_refused(state, "time.duration,time.intervals\n1,8\n,10\n", "t.csv:3:1: error");
  table_refused(state, "time.duration,time.intervals\n1,8\n1\n", "t.csv:3:1: error");
  table_refused(state, "time.duration,time.intervals\n1,8\n1,-4\n",
                "t.csv:3:3: error[E_SCHEMA]: time.intervals: got '-4'; expected a whole number");
  table_refused(state, "time.duration,\n1,8\n", "t.csv:1:15: error");
  table_refused(state, "time.duration,time.intervls\n1,8\n", "t.csv:1:15: error");
  table_refused(state, "time.duration,time.intervals\n", "no row below the header");
}

static void faults_are_named(void **state) {
  refused(state, "axes:\n  - {key: time.duration, range: [1, 2, -1]}\n", "has no values");
  refused(state, "axes:\n  - {key: time.duration}\n", "needs one of");
  refused(state, "axes:\n  - {key: time.duration, values: [1], step: 2}\n", "step");
  refused(state, TWO_AXES "filters: [\"n ~ 3\"]\n", "is no comparison");
  refused(state, TWO_AXES "filters: [\"n > 100\"]\n", "no case left");
  refused(state, TWO_AXES "colour: red\n", "colour");
  refused(state, "axes:\n  - {key: ends.final, values: [{pin: 1}]}\noutputs: [objective]\n",
          "lists stand in quotes");
  refused(state, "table: nothing.csv\n", "nothing.csv");
  refused(state, "", "no case left");
}

#define AXIS(more) "axes:\n  - {key: time.duration, " more "}\n"

static void shapes_are_named(void **state) {
  static const struct {
    const char *text, *message;
  } wrong[] = {
      {"axes:\n  - {key: \"a=b\", values: [1]}\n", "no key that can be set (got 'a=b')"},
      {"axes:\n  - {key: \"\", values: [1]}\n", "s.yaml:6:"},
      {"axes:\n  - [time.duration]\n", "s.yaml:6:"},
      {"axes: 3\n", "s.yaml:5:"},
      {AXIS("values: []"), "'values' of 'time.duration' is empty; expected a list"},
      {AXIS("values: 3"), "'values' of 'time.duration' is not a list; expected a list"},
      {AXIS("values: [\"\"]"), "no value of 'time.duration'; expected one"},
      {AXIS("linspace: [1, 2]"), "s.yaml:6:"},
      {AXIS("linspace: [1, 2, 0]"), "[1, 2, 0] has no values; expected [first, last, count]"},
      {AXIS("linspace: [1, 2, 2.5]"), "[1, 2, 2.5] has no values"},
      {AXIS("linspace: [1, 2, 1e9]"), "has no values"},
      {AXIS("range: [1, 2, 0]"), "has no values; expected [first, last, step]"},
      {AXIS("range: [1, x, 1]"), "s.yaml:6:"},
      {"random: {samples: 5, axes: [{key: time.duration, range: [1]}]}\n", "s.yaml:5:"},
      {"random: {samples: 5, axes: [{key: \"\", range: [1, 2]}]}\n", "s.yaml:5:"},
      {"random: {samples: 0, axes: [{key: time.duration, range: [1, 2]}]}\n", "s.yaml:5:"},
      {"random: {samples: 5, axes: []}\n", "s.yaml:5:"},
      {AXIS("values: [1, 2]") "filters: [\"\"]\n", "no filter; expected one"},
      {AXIS("values: [1, 2]") "outputs: [\"\"]\n", "no output; expected one"},
      {AXIS("values: [1, 2]") "outputs: [{label: a}]\n", "missing required key 'output'"},
  };
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
    refused(state, wrong[i].text, wrong[i].message);
}

/* one value where first and last are one */
static void a_single_value(void **state) {
  ambulo_sweep *s = loaded(state, AXIS("linspace: [1.5, 3, 1]"));
  assert_int_equal(ambulo_sweep_case_count(s), 1);
  assert_string_equal(ambulo_sweep_value(s, 0, 0), "1.5");
  ambulo_sweep_free(s);
}

static void too_many(void **state) {
  char text[1900] = "axes:\n";
  for (int i = 0; i < 65; i++)
    (void)snprintf(text + strlen(text), sizeof text - strlen(text), "  - {key: k%d, values: [1]}\n",
                   i);
  refused(state, text, "more than 64 axes; expected at most 64");
}

/* what the file says, else what is known */
static void columns_have_titles_and_units(void **state) {
  static const char *const known[][2] = {{"objective", ""},
                                         {"duration", "s"},
                                         {"max(tau.pin)", "N m"},
                                         {"range(q.pin)", "rad"},
                                         {"min(qd.pin)", "rad/s"},
                                         {"max(q.nothing)", ""},
                                         {"max(free_moment.left)", "N m"},
                                         {"max(cop.right.x)", "m"},
                                         {"ground_reaction.right.peak", "body weights"},
                                         {"gait.step_time", "s"}};
  enum { KNOWN = sizeof known / sizeof *known };
  char text[1024] = "axes:\n  - {key: time.duration, values: [1, 2]}\n"
                    "  - {key: \"model.links[rod].body.mass\", name: m, label: rod, unit: g, "
                    "values: [1]}\noutputs:\n  - {output: verdict, label: how, unit: word}\n";
  for (int i = 0; i < KNOWN; i++) {
    size_t length = strlen(text);
    snprintf(text + length, sizeof text - length, "  - %s\n", known[i][0]);
  }
  ambulo_sweep *s = loaded(state, text);
  assert_string_equal(s->axis[0].label, "time.duration");
  assert_string_equal(s->axis[0].unit, "s");
  assert_string_equal(s->axis[1].label, "rod");
  assert_string_equal(s->axis[1].unit, "g");
  assert_string_equal(s->output[0].label, "how");
  assert_string_equal(s->output[0].unit, "word");
  for (int i = 0; i < KNOWN; i++) {
    assert_string_equal(s->output[i + 1].label, known[i][0]);
    assert_string_equal(s->output[i + 1].unit, known[i][1]);
  }
  ambulo_sweep_free(s);
}

#define SQUARE(side)                                                                               \
  "axes:\n  - {key: time.duration, name: T, range: [1, " side ", 1]}\n"                            \
  "  - {key: \"objective[0].weight\", name: w, range: [1, 1000, 1]}\n"

/* not one case above the bound, wherever the last one comes from */
static void at_most_a_million_cases(void **state) {
  ambulo_sweep *s = loaded(state, SQUARE("1000"));
  assert_int_equal(ambulo_sweep_case_count(s), 1000000);
  ambulo_sweep_free(s);
  refused(state, SQUARE("1001"), "s.yaml: error[E_LIMIT]: 1001000 cases; expected at most 1000000");
  refused(state, SQUARE("1000") "cases:\n  - {name: own, set: {time.intervals: 30}}\n",
          "1000001 cases; expected at most 1000000");
  refused(state, SQUARE("1001") "filters: [\"T <= 1001\"]\n",
          "more than 1000000 cases; expected at most 1000000\n  hint: split the sweep");
  refused(state, SQUARE("1000") "filters: [\"T > 0\"]\ncases:\n  - {name: own, set: {name: b}}\n",
          "more than 1000000 cases");
  refused(state, SQUARE("100001") "filters: [\"T == 1\"]\n",
          "100001000 combinations before filters; expected at most 100000000");
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(a_grid_with_the_last_axis_fastest),
      TEST(a_filter_renames_nothing),
      TEST(zip_goes_side_by_side),
      TEST(a_chain_follows_its_axis),
      TEST(a_chain_is_found),
      TEST(a_table_is_one_axis),
      TEST(a_latin_hypercube_uses_each_stratum_once),
      TEST(explicit_cases_come_last),
      TEST(a_named_file_is_part_of_the_key),
      TEST(the_base_problem_is_part_of_the_key),
      TEST(a_model_key_is_an_axis),
      TEST(a_wrong_key_or_value_is_told_with_its_place),
      TEST(names_are_used_once),
      TEST(a_bad_cell_is_told_with_line_and_column),
      TEST(faults_are_named),
      TEST(shapes_are_named),
      TEST(a_single_value),
      TEST(too_many),
      TEST(columns_have_titles_and_units),
      TEST(at_most_a_million_cases),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
