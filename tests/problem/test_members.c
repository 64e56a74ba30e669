/* Parts of a problem that a caller starts from. */
#include "support/problem_fixture.h"
#include "support/walker_fixture.h"

static double zero(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  (void)user;
  (void)state;
  (void)gradient;
  return 0.0;
}

static ambulo_status create(const ambulo_problem_definition *d, ambulo_problem **problem) {
  *problem = NULL;
  return ambulo_problem_create(d, NULL, NULL, problem);
}

static void row_stands_at_every_node(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition d = arm_definition(model);
  ambulo_user_row row = ambulo_user_row_default();
  row.name = "mine";
  row.unit = "m";
  row.function = zero;
  ambulo_problem *without, *with;
  assert_int_equal(create(&d, &without), AMBULO_OK);
  d.user_rows = &row;
  d.user_row_count = 1;
  assert_int_equal(create(&d, &with), AMBULO_OK);
  int last = ambulo_problem_row_count(with) - 1;
  assert_int_equal(last + 1,
                   ambulo_problem_row_count(without) + ambulo_problem_node_count(without));
  ambulo_row told;
  assert_int_equal(ambulo_problem_row(with, last, &told), AMBULO_OK);
  assert_int_equal(told.relation, AMBULO_NOT_NEGATIVE);
  ambulo_problem_free(with);
  ambulo_problem_free(without);
  ambulo_model_free(model);
}

static void reach_lasts_until_the_end(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition d = arm_definition(model);
  d.end_value_count = 0;
  ambulo_problem *problem;
  assert_int_equal(create(&d, &problem), AMBULO_OK);
  int rows = ambulo_problem_row_count(problem);
  ambulo_problem_free(problem);
  ambulo_reach reach = ambulo_reach_default();
  d.reaches = &reach;
  d.reach_count = 1;
  assert_int_equal(create(&d, &problem), AMBULO_E_PROBLEM); /* of no point */
  reach.point = 0;
  reach.tolerance = 0.5;
  assert_int_equal(create(&d, &problem), AMBULO_OK);
  assert_true(ambulo_problem_row_count(problem) > rows);
  ambulo_row last;
  assert_int_equal(ambulo_problem_row(problem, ambulo_problem_row_count(problem) - 1, &last),
                   AMBULO_OK);
  assert_string_equal(last.family, "reach");
  assert_true(last.time == ambulo_problem_duration(problem));
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

static void what_is_not_given_is_refused(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem *problem;
  const ambulo_contact contact = ambulo_contact_default();
  const ambulo_end_value end = ambulo_end_value_default();
  const ambulo_tube tube = ambulo_tube_default();
  const ambulo_obstacle obstacle = ambulo_obstacle_default();
  const ambulo_user_row row = ambulo_user_row_default();
  for (int missing = 0; missing < 5; missing++) {
    ambulo_problem_definition d = arm_definition(model);
    d.contacts = &contact;
    d.end_values = missing == 1 ? &end : d.end_values;
    d.end_value_count = missing == 1 ? 1 : d.end_value_count;
    d.tubes = &tube;
    d.obstacles = &obstacle;
    d.user_rows = &row;
    d.contact_count = missing == 0;
    d.tube_count = missing == 2;
    d.obstacle_count = missing == 3;
    d.user_row_count = missing == 4;
    if (create(&d, &problem) == AMBULO_OK) fail_msg("missing %d is not refused", missing);
  }
  ambulo_model_free(model);
}

static void gait_has_phases_of_people(void **state) {
  (void)state;
  ambulo_model *model = walker_create(1);
  ambulo_gait gait = ambulo_gait_default();
  gait.step_length = 0.7;
  gait.step_time = 0.55;
  ambulo_contact contacts[20];
  int count = 0;
  assert_int_equal(ambulo_gait_expand(model, &gait, contacts, 20, &count), AMBULO_OK);
  double down = 0.0;
  for (int i = 0; i < count; i++) down += contacts[i].to - contacts[i].from;
  /* of one step, in which both feet together are down for twice the share of a stride */
  assert_true(fabs(down - 2.0 * 0.62 * 0.55) < 1e-12);
  ambulo_model_free(model);
}

/* the parts that a definition has from the start */
static void parts_are_those_of_the_definition(void **state) {
  (void)state;
  const ambulo_problem_definition d = ambulo_problem_definition_default();
  const ambulo_ground_reaction reaction = ambulo_ground_reaction_default();
  const ambulo_clearance clearance = ambulo_clearance_default();
  const ambulo_collision collision = ambulo_collision_default();
  assert_int_equal(reaction.kind, AMBULO_REACTION_NONE);
  assert_true(reaction.moment_arm > 0.0 && reaction.moment_arm == d.ground_reaction.moment_arm);
  assert_true(isnan(clearance.height) && clearance.turn == d.clearance.turn &&
              clearance.turn > 0.0);
  assert_int_equal(collision.mode, AMBULO_COLLISION_AUTOMATIC);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(row_stands_at_every_node),
      cmocka_unit_test(reach_lasts_until_the_end),
      cmocka_unit_test(what_is_not_given_is_refused),
      cmocka_unit_test(gait_has_phases_of_people),
      cmocka_unit_test(parts_are_those_of_the_definition),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
