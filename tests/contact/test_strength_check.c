/* Joints that could not carry the body at rest are named before solving. */
#include "support/messages.h"
#include "support/test.h"

#include "ambulo/tools/tools.h"

static const char text[] = "ambulo: 1\n"
                           "kind: problem\n"
                           "name: standing\n"
                           "model: %s.yaml\n"
                           "time: {duration: 0.6, intervals: 6}\n"
                           "trajectory: {basis: bspline, degree: 3, intervals: 6}\n"
                           "contacts:\n"
                           "  - {foot: right, mode: flat, from: 0, to: 0.6, place: [0, 0]}\n"
                           "  - {foot: left, mode: flat, from: 0, to: 0.6, place: [0, 0]}\n"
                           "ground_reaction: {kind: shared}\n"
                           "constraints: {ground_penetration: true, torque_limits: true}\n"
                           "objective: none\n";

static size_t warnings(const char *folder, const char *model, const char *phrase) {
  char problem_text[1200];
  ambulo_problem *problem = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  (void)snprintf(problem_text, sizeof problem_text, text, model);
  ambulo_status status =
      ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                      .text = problem_text,
                                                      .length = strlen(problem_text),
                                                      .name = "standing",
                                                      .directory = folder},
                               NULL, list, &problem);
  if (status) assert_message(list, 0, "no error");
  assert_int_equal(status, AMBULO_OK);
  size_t count = ambulo_diagnostics_count(list);
  if (phrase) assert_message(list, 0, phrase);
  ambulo_problem_free(problem);
  ambulo_diagnostics_free(list);
  return count;
}

static void a_strong_body_stands(void **state) {
  (void)state;
  assert_int_equal(warnings("models", "walker_2d", NULL), 0);
}

/* ankles that push the toes up with 1 % of weight times stature or more */
static void a_weak_joint_is_named(void **state) {
  (void)state;
  assert_int_equal(
      warnings("tests/infeasible/models", "weak_ankles",
               "ankle_angle_r needs 0 N m to carry the body standing still; its torque limits are "
               "12.88 to 55.37 N m"),
      2);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_strong_body_stands),
                                     cmocka_unit_test(a_weak_joint_is_named)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
