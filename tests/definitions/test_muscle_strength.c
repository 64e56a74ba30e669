/* Weaker muscles: which a key means, and what becomes of their force and of their tendons. */
#include <math.h>

#include "definitions/problem_text.h"

#define HEAD                                                                                       \
  "ambulo: 1\nkind: problem\nmodel: lower_body_23.yaml\ntime: {duration: 1, intervals: 4}\n"       \
  "objective: none\n"

static ambulo_problem *weak_by(const char *strength) {
  char text[1000];
  (void)snprintf(text, sizeof text, HEAD "muscles: {file: leg_muscles.yaml, strength: {%s}}\n",
                 strength);
  return problem_of(text);
}

static const ambulo_muscle *muscle_of(const ambulo_problem *p, const char *name) {
  const ambulo_muscles *all = ambulo_problem_muscles(p);
  return ambulo_muscles_get(all, ambulo_muscles_find(all, name));
}

static int ends_with(const char *text, const char *end) {
  size_t length = strlen(text), tail = strlen(end);
  return length >= tail && strcmp(text + length - tail, end) == 0;
}

/* what is left of each muscle: factor where group and side are, else 1 */
static void check(const char *strength, const char *group, const char *side, double factor,
                  int count) {
  ambulo_problem *strong = weak_by(""), *weak = weak_by(strength);
  const ambulo_muscles *before = ambulo_problem_muscles(strong),
                       *after = ambulo_problem_muscles(weak);
  int changed = 0;
  for (int i = 0; i < ambulo_muscles_count(before); i++) {
    const ambulo_muscle *was = ambulo_muscles_get(before, i), *is = ambulo_muscles_get(after, i);
    int meant = strcmp(was->group, group) == 0 && ends_with(was->name, side);
    assert_close(is->force / was->force, meant ? factor : 1.0, 1e-15);
    assert_close(is->fiber, was->fiber, 0.0);
    assert_close(is->passive_strain, was->passive_strain, 0.0);
    changed += is->force != was->force;
  }
  assert_int_equal(changed, count);
  ambulo_problem_free(strong);
  ambulo_problem_free(weak);
}

static void a_key_means_a_group_or_one_side_of_it(void **state) {
  (void)state;
  check("quadriceps: 0.4", "quadriceps", "", 0.4, 8);
  check("quadriceps_l: 0.4", "quadriceps", "_l", 0.4, 4);
  check("quadriceps_r: 10", "quadriceps", "_r", 10, 4);
}

static void a_key_means_a_muscle_and_factors_multiply(void **state) {
  (void)state;
  ambulo_problem *strong = weak_by(""),
                 *weak = weak_by("soleus_r: 0.5, plantarflexors: 0.5, plantarflexors_l: 3");
  assert_close(muscle_of(weak, "soleus_r")->force / muscle_of(strong, "soleus_r")->force, 0.25,
               1e-15);
  assert_close(muscle_of(weak, "soleus_l")->force / muscle_of(strong, "soleus_l")->force, 1.5,
               1e-15);
  assert_close(muscle_of(weak, "gasmed_r")->force / muscle_of(strong, "gasmed_r")->force, 0.5,
               1e-15);
  ambulo_problem_free(strong);
  ambulo_problem_free(weak);
}

/* l_M of a muscle at q = 0 with the torque at the right ankle */
static double fiber_length(const ambulo_problem *p, const char *name, double torque) {
  const ambulo_model *model = ambulo_problem_model(p);
  enum { MOST = 40, MUSCLES = 80 };
  double q[MOST] = {0}, qd[MOST] = {0}, tau[MOST] = {0}, length[MUSCLES];
  tau[ambulo_model_find_coordinate(model, "ankle_angle_r")] = torque;
  ambulo_sharing_states states = ambulo_sharing_states_default();
  states.count = 1;
  states.q = q;
  states.qd = qd;
  states.tau = tau;
  ambulo_sharing_outputs out = ambulo_sharing_outputs_default();
  out.length = length;
  assert_int_equal(ambulo_muscles_share(ambulo_problem_muscles(p), NULL, &states, NULL, &out),
                   AMBULO_OK);
  return length[ambulo_muscles_find(ambulo_problem_muscles(p), name)];
}

/* Under one torque an elastic tendon has one length, however strong its muscles are; but for the
 * corner c = 0.02 of the smooth maximum of T, which adds c^2 / 4 T. */
static void tendons_keep_their_stiffness(void **state) {
  (void)state;
  static const char *const strengths[] = {"plantarflexors: 0.2", "soleus_r: 0.3",
                                          "plantarflexors_r: 0.6"};
  ambulo_problem *strong = weak_by("");
  double slack = fiber_length(strong, "soleus_r", 0.0),
         loaded = fiber_length(strong, "soleus_r", -90.0);
  assert_true(slack - loaded > 0.05); /* by some of the length of the fibres */
  for (size_t i = 0; i < sizeof strengths / sizeof *strengths; i++) {
    ambulo_problem *weak = weak_by(strengths[i]);
    assert_close(fiber_length(weak, "soleus_r", -90.0), loaded, 1e-3);
    assert_close(fiber_length(weak, "gaslat_r", -90.0), fiber_length(strong, "gaslat_r", -90.0),
                 1e-3);
    ambulo_problem_free(weak);
  }
  ambulo_problem_free(strong);
}

static void refusals(void **state) {
  (void)state;
  static const struct {
    const char *strength, *message;
  } wrong[] = {
      {"plantarflexor: 0.5",
       "p.yaml:6:61: error[E_SCHEMA]: no muscle and no group of the muscles is named "
       "'plantarflexor'\n  hint: did you mean 'plantarflexors'?"},
      {"quadriceps_x: 0.5", "is named 'quadriceps_x'\n  hint: did you mean 'quadriceps_"},
      {"soleus_r: 0", "p.yaml:6:56: error[E_SCHEMA]: got '0'; expected above 0, at most 10"},
      {"soleus_r: -1", "p.yaml:6:56: error[E_SCHEMA]: got '-1'; expected a number from 0 to 10"},
      {"soleus_r: 10.5", "p.yaml:6:56: error[E_SCHEMA]: got '10.5'"},
      {"soleus_r: weak", "p.yaml:6:56: error[E_SCHEMA]: got 'weak'"},
  };
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    char text[1000];
    (void)snprintf(text, sizeof text, HEAD "muscles: {file: leg_muscles.yaml, strength: {%s}}\n",
                   wrong[i].strength);
    expect_refusal(text, AMBULO_E_SCHEMA, wrong[i].message);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_key_means_a_group_or_one_side_of_it),
      cmocka_unit_test(a_key_means_a_muscle_and_factors_multiply),
      cmocka_unit_test(tendons_keep_their_stiffness),
      cmocka_unit_test(refusals),
  };
  return cmocka_run_group_tests_name("definitions/muscle_strength", tests, NULL, NULL);
}
