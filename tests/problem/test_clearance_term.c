/* Heights of feet in the air. */
#include "form_fixture.h"

/* the arm with its two points as heel and ball of one foot */
static ambulo_model *footed_arm(const ambulo_model *arm) {
  ambulo_foot foot = {.name = "hand", .heel = {0, -1}, .toe = {1, -1}, .heel_center = 0};
  foot.toe_center = 1;
  ambulo_link links[2] = {*ambulo_model_link(arm, 0), *ambulo_model_link(arm, 1)};
  ambulo_coordinate coordinates[2] = {*ambulo_model_coordinate(arm, 0),
                                      *ambulo_model_coordinate(arm, 1)};
  ambulo_point points[2] = {*ambulo_model_point(arm, 0), *ambulo_model_point(arm, 1)};
  ambulo_model_definition definition = ambulo_model_definition_default();
  definition.name = "arm";
  definition.links = links;
  definition.link_count = definition.coordinate_count = definition.point_count = 2;
  definition.coordinates = coordinates;
  definition.points = points;
  definition.feet = &foot;
  definition.foot_count = 1;
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_create(&definition, NULL, NULL, &model), AMBULO_OK);
  return model;
}

static void low_feet_in_the_air_cost(void **state) {
  (void)state;
  static const int active[FORM_NODES] = {-1, 0, -1};
  form_fixture f;
  form_open(&f);
  ambulo_model *model = footed_arm(f.model);
  f.context.model = model;
  f.context.active = active;
  f.context.ground_height = 0.5;
  ambulo_term term = {.kind = AMBULO_CLEARANCE, .height = 0.04};
  ambulo__form form;
  for (int node = 0; node < FORM_NODES; node++) {
    *form_at(&f, node, ambulo__channel_point(&f.context.channels, 0, 1)) = 0.51;
    *form_at(&f, node, ambulo__channel_point(&f.context.channels, 1, 1)) = 0.55;
  }
  assert_int_equal(ambulo__term_forms(&term, &f.context, 0), 3);
  ambulo__term_form(&term, &f.context, 0, 0, &form);
  assert_close(form.u, 0.75, 1e-13);
  check_form_slopes(&f, &term, 0, 0);
  ambulo__term_form(&term, &f.context, 0, 1, &form); /* high enough */
  assert_int_equal(form.count, 0);
  assert_close(ambulo__term_residual(&term, form.u).value, 0.0, 0.0);
  ambulo__term_form(&term, &f.context, 0, 2, &form); /* no tip */
  assert_int_equal(form.count, 0);
  ambulo__term_form(&term, &f.context, 1, 0, &form); /* on the ground */
  assert_int_equal(form.count, 0);
  ambulo_model_free(model);
  form_close(&f);
}

/* at a node on an event a foot counts for the part of the node's time that it is in the air */
static void feet_that_leave_or_land_count_in_part(void **state) {
  (void)state;
  static const int active[FORM_NODES] = {-1, 0, -1}, before[FORM_NODES] = {-1, -1, 0};
  static const double times[FORM_NODES] = {0.0, 0.1, 0.4};
  form_fixture f;
  form_open(&f);
  ambulo_model *model = footed_arm(f.model);
  f.context.model = model;
  f.context.active = active;
  f.context.before = before;
  f.context.times = times;
  f.context.ground_height = 0.5;
  ambulo_term term = {.kind = AMBULO_CLEARANCE, .height = 0.04};
  for (int node = 0; node < FORM_NODES; node++)
    *form_at(&f, node, ambulo__channel_point(&f.context.channels, 0, 1)) = 0.51;
  const double part[FORM_NODES] = {1.0, 0.25, 0.0};
  for (int node = 0; node < FORM_NODES; node++) {
    ambulo__form form;
    ambulo__term_form(&term, &f.context, node, 0, &form);
    assert_close(form.u * form.u, part[node] * 0.75 * 0.75, 1e-13);
    if (part[node] > 0.0) check_form_slopes(&f, &term, node, 0);
  }
  ambulo_model_free(model);
  form_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(feet_that_leave_or_land_count_in_part),
                                     cmocka_unit_test(low_feet_in_the_air_cost)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
