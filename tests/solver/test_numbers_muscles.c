/* Numbers of muscles, prices of their term, and the body whose muscles grow along, by hand against
 * central differences over files read anew. */
#include "ambulo/tools/load.h"
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
      cmocka_unit_test(none_without_the_term),
  };
  return cmocka_run_group_tests_name("solver/numbers_muscles", tests, NULL, NULL);
}
