/* Numbers of single muscles in a problem file. */
#include "definitions/problem_text.h"

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

/* in place of what size and strength make of it; the other side stays */
static void a_number_of_a_muscle(void **state) {
  (void)state;
  ambulo_problem *p =
      problem_of(HEAD "muscles: {file: leg_muscles.yaml, strength: {gasmed_r: 0.5}, soleus_r: "
                      "{force: 4321, fiber: 0.05}, gasmed_r: {tendon: 0.3}}\n");
  const ambulo_muscles *all = ambulo_problem_muscles(p);
  const ambulo_muscle *own = ambulo_muscles_get(all, ambulo_muscles_find(all, "soleus_r")),
                      *image = ambulo_muscles_get(all, own->mirror),
                      *other = ambulo_muscles_get(all, ambulo_muscles_find(all, "gasmed_r"));
  assert_close(own->force, 4321.0, 0.0);
  assert_close(own->fiber, 0.05, 0.0);
  assert_close(own->tendon, image->tendon, 0.0);
  assert_true(image->force != 4321.0 && image->fiber != 0.05);
  assert_close(other->tendon, 0.3, 0.0);
  assert_close(force_of(p, "gasmed_l") / other->force, 2.0, 1e-15);
  ambulo_problem *set_alone = set(HEAD "muscles: leg_muscles.yaml\n", "muscles.soleus_l.force=99");
  assert_close(force_of(set_alone, "soleus_l"), 99.0, 0.0);
  ambulo_problem_free(p);
  ambulo_problem_free(set_alone);
}

static void refusals(void **state) {
  (void)state;
  expect_refusal(HEAD "muscles: {file: leg_muscles.yaml, soleus_r: {force: 0}}\n", AMBULO_E_SCHEMA,
                 "p.yaml:6:53: error[E_SCHEMA]: ");
  expect_refusal(HEAD "muscles: {file: leg_muscles.yaml, soleus_r: {fibre: 0.1}}\n",
                 AMBULO_E_SCHEMA, "unknown key 'fibre' in muscles.soleus_r");
  expect_refusal(HEAD "muscles: {file: leg_muscles.yaml, soleos_l: {fiber: 0.1}}\n",
                 AMBULO_E_SCHEMA,
                 "error[E_SCHEMA]: unknown key 'soleos_l' in muscles\n"
                 "  hint: did you mean 'soleus_l'?");
  expect_refusal(HEAD "muscles: {file: leg_muscles.yaml, soleus_r: 3}\n", AMBULO_E_SCHEMA,
                 "p.yaml:6:45: error[E_SCHEMA]: ");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_number_of_a_muscle),
                                     cmocka_unit_test(refusals)};
  return cmocka_run_group_tests_name("definitions/muscle_numbers", tests, NULL, NULL);
}
