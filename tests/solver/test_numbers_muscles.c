/* Numbers of muscles, prices of their term, and the body whose muscles grow along, by hand against
 * central differences over files read anew; and the muscles of a variant. */
#include "ambulo/tools/load.h"
#include "muscle/muscles.h"
#include "support/sensitivity_check.h"

static const char walk[] = "models/walk_muscles.yaml";

/* soleus has an elastic tendon, semimembranosus spans two joints. On 32 intervals a difference of
 * this step passes a kink of the sharing, at 40 none. */
static void a_walk_by_muscles(void **state) {
  (void)state;
  static const setting c = {
      "models/walk_muscles.yaml",
      {"written_for=null", "time.intervals=40"},
      {"objective[muscle_effort].activation", "objective[muscle_effort].metabolic",
       "objective[muscle_effort].reserve", "objective[muscle_effort].weight",
       "muscles.soleus_r.force", "muscles.soleus_r.fiber", "muscles.soleus_r.tendon",
       "muscles.semimem_r.force", "muscles.semimem_r.fiber", "muscles.semimem_r.tendon",
       "muscles.glmed1_r.force", "subject.mass", "subject.stature"}};
  check(&c, "muscles.soleus_l.force");
}

/* of ends that are not mirrored each side has its own; what a file gives stays as the body grows */
static void a_side_alone(void **state) {
  (void)state;
  static const setting c = {
      "models/walk_muscles.yaml",
      {"gait.steps=2", "ends.kind=periodic", "time.intervals=64", "muscles.soleus_l.force=4000",
       "muscles.glmax1_r.fiber=0.14", "muscles.strength.quadriceps=0.8",
       "load={link: pelvis, mass: 5, position: [0, 0, 0]}"},
      {"muscles.soleus_r.force", "muscles.soleus_l.force", "muscles.glmax1_r.fiber",
       "muscles.vasmed_l.force", "subject.mass", "subject.stature", "load.mass"}};
  check(&c, NULL);
}

static ambulo_problem *load(const char *override) {
  ambulo_problem *p = NULL;
  assert_int_equal(ambulo_problem_load(walk, &override, override != NULL, NULL, NULL, &p),
                   AMBULO_OK);
  return p;
}

static const ambulo_muscle *muscle_of(const ambulo_problem *p, const char *name) {
  const ambulo_muscles *all = ambulo_problem_muscles(p);
  return ambulo_muscles_get(all, ambulo_muscles_find(all, name));
}

/* and outlives the problem that it came from; what was moved stays */
static void a_variant_owns_its_muscles(void **state) {
  (void)state;
  ambulo_problem *p = load(NULL), *heavier = load("subject.mass=90"), *made = NULL;
  ambulo__parameters list;
  assert_int_equal(ambulo__parameters_init(p, NULL, &list), AMBULO_OK);
  ambulo__parameter *force = ambulo__parameters_find(&list, "muscles.soleus_r.force");
  assert_non_null(force);
  assert_string_equal(force->with, "muscles.soleus_l.force");
  ambulo__parameter_set(&list, force, 4321.0);
  ambulo__parameter_set(&list, ambulo__parameters_find(&list, "subject.mass"), 90.0);
  assert_int_equal(ambulo__variant_problem(&list.variant, NULL, 1, &made), AMBULO_OK);
  ambulo__parameters_clear(&list);
  ambulo_problem_free(p);
  assert_ptr_equal(made->owned_muscles, ambulo_problem_muscles(made));
  assert_ptr_equal(made->owned_muscles->model, made->model);
  const ambulo_muscle *want = muscle_of(heavier, "gasmed_l"), *got = muscle_of(made, "gasmed_l");
  assert_close(muscle_of(made, "soleus_r")->force, 4321.0, 0.0);
  assert_close(muscle_of(made, "soleus_l")->force, 4321.0, 0.0);
  assert_close(got->force / want->force, 1.0, 1e-13);
  assert_close(got->fiber / want->fiber, 1.0, 1e-13);
  for (int t = 0; t < got->term_count; t++) assert_close(got->length[t], want->length[t], 1e-13);
  assert_int_equal(made->owned_muscles->fixed[ambulo_muscles_find(made->owned_muscles, "soleus_l")],
                   AMBULO__FIXED_FORCE);
  ambulo_problem_free(made);
  ambulo_problem_free(heavier);
}

/* muscles that cost nothing have no numbers */
static void none_without_the_term(void **state) {
  (void)state;
  ambulo_problem *p = load("objective=[{term: torque_squared, scale: 0.01}]");
  ambulo__parameters list;
  assert_non_null(ambulo_problem_muscles(p));
  assert_int_equal(ambulo__parameters_init(p, NULL, &list), AMBULO_OK);
  for (int i = 0; i < list.count; i++) assert_null(strstr(list.list[i].name, "muscles."));
  ambulo__parameters_clear(&list);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_walk_by_muscles),
      cmocka_unit_test(a_side_alone),
      cmocka_unit_test(a_variant_owns_its_muscles),
      cmocka_unit_test(none_without_the_term),
  };
  return cmocka_run_group_tests_name("solver/numbers_muscles", tests, NULL, NULL);
}
