/* The muscles of a problem with numbers moved: as a file makes them. */
#include "ambulo/tools/load.h"
#include "muscle/muscles.h"
#include "solver/sensitivity.h"
#include "support/test.h"

static const char walk[] = "models/walk_muscles.yaml";

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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_variant_owns_its_muscles)};
  return cmocka_run_group_tests_name("solver/variant_muscles", tests, NULL, NULL);
}
