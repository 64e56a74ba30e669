/* `muscles` of a problem file: the name of a file, or {file, strength}. */
#include "definitions/problem_text.h"
#include "support/fail_alloc.h"

#define HEAD                                                                                       \
  "ambulo: 1\nkind: problem\nmodel: lower_body_23.yaml\ntime: {duration: 1, intervals: 4}\n"       \
  "objective: none\n"

static double force_of(const ambulo_problem *p, const char *muscle) {
  const ambulo_muscles *all = ambulo_problem_muscles(p);
  const ambulo_muscle *m = ambulo_muscles_get(all, ambulo_muscles_find(all, muscle));
  assert_non_null(m);
  return m->force;
}

static ambulo_problem *set(const char *text, const char *override) {
  ambulo_problem *p = NULL;
  ambulo_problem_text given = {.size = sizeof given,
                               .text = text,
                               .length = strlen(text),
                               .name = "p.yaml",
                               .directory = "models",
                               .overrides = &override,
                               .override_count = 1};
  assert_int_equal(ambulo_problem_load_text(&given, NULL, NULL, &p), AMBULO_OK);
  return p;
}

static void a_name_alone_and_a_mapping_are_the_same(void **state) {
  (void)state;
  ambulo_problem *none = problem_of(HEAD), *alone = problem_of(HEAD "muscles: leg_muscles.yaml\n"),
                 *mapping = problem_of(HEAD "muscles: {file: leg_muscles.yaml}\n");
  assert_null(ambulo_problem_muscles(none));
  assert_int_equal(ambulo_muscles_count(ambulo_problem_muscles(mapping)), 80);
  assert_close(force_of(mapping, "soleus_l"), force_of(alone, "soleus_l"), 0.0);
  ambulo_problem_free(none);
  ambulo_problem_free(alone);
  ambulo_problem_free(mapping);
}

static void settings_reach_a_strength(void **state) {
  (void)state;
  static const char *const texts[] = {
      HEAD "muscles: leg_muscles.yaml\n", HEAD "muscles: {file: leg_muscles.yaml}\n",
      HEAD "muscles: {file: leg_muscles.yaml, strength: {quadriceps: 0.5}}\n"};
  for (int i = 0; i < 3; i++) {
    ambulo_problem *strong = problem_of(texts[i]),
                   *weak = set(texts[i], "muscles.strength.plantarflexors=0.25");
    assert_close(force_of(weak, "soleus_r") / force_of(strong, "soleus_r"), 0.25, 1e-15);
    assert_close(force_of(weak, "vasmed_l") / force_of(strong, "vasmed_l"), 1.0, 0.0);
    ambulo_problem_free(strong);
    ambulo_problem_free(weak);
  }
}

static void refusals(void **state) {
  (void)state;
  expect_refusal(HEAD "muscles: {strength: {quadriceps: 1}}\n", AMBULO_E_SCHEMA,
                 "p.yaml:6:10: error[E_SCHEMA]: missing required key 'file'");
  expect_refusal(HEAD "muscles: {file: leg_muscles.yaml, strenght: {quadriceps: 1}}\n",
                 AMBULO_E_SCHEMA,
                 "error[E_SCHEMA]: unknown key 'strenght' in muscles\n"
                 "  hint: did you mean 'strength'?");
  expect_refusal(HEAD "muscles: {file: leg_muscles.yaml, strength: 0.5}\n", AMBULO_E_SCHEMA,
                 "p.yaml:6:45: error[E_SCHEMA]: ");
  expect_refusal(HEAD "muscles: [leg_muscles.yaml]\n", AMBULO_E_SCHEMA, "p.yaml:6:10: ");
  expect_refusal(HEAD "muscles: {file: leg_muscels.yaml}\n", AMBULO_E_IO,
                 "leg_muscels.yaml: error[E_IO]: cannot open");
}

static void memory_may_run_out_anywhere(void **state) {
  (void)state;
  static const char text[] = HEAD "muscles: {file: leg_muscles.yaml, strength: {plantarflexors_r: "
                                  "0.5}, soleus_l: {force: 9}}\n";
  const ambulo_problem_text given = {
      .size = sizeof given, .text = text, .length = strlen(text), .directory = "models"};
  long k = 0;
  for (;; k++) {
    assert_in_range(k, 0, 20000);
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_problem *p = NULL;
    ambulo_status status = ambulo_problem_load_text(&given, &hook, NULL, &p);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo_problem_free(p);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  assert_true(k > 100);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_name_alone_and_a_mapping_are_the_same),
      cmocka_unit_test(settings_reach_a_strength),
      cmocka_unit_test(refusals),
      cmocka_unit_test(memory_may_run_out_anywhere),
  };
  return cmocka_run_group_tests_name("definitions/problem_muscles", tests, NULL, NULL);
}
