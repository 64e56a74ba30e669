/* Point feet: the walker on its two heel centres, which stand at (-0.05, +-0.09) m at q = 0. */
#include "ambulo/ambulo.h"
#include "contact/contacts.h"
#include "contact/row_families.h"
#include "support/messages.h"
#include "support/row_fixture.h"

static const ambulo_contact both[] = {
    {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 0.4, .place = {0.0, -0.1}},
    {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.5, 0.1}}};

static ambulo_foot point_foot(const ambulo_foot *like) {
  ambulo_foot foot = *like;
  foot.heel[0] = foot.toe[0] = foot.toe_center = foot.heel_center;
  foot.heel[1] = foot.toe[1] = foot.tip = -1;
  foot.has_tip = 0;
  return foot;
}

static ambulo_status build(const ambulo_model *body, const ambulo_foot *feet, ambulo_model **model,
                           ambulo_diagnostics *list) {
  ambulo_model_definition d = ambulo_model_definition_default();
  d.name = "points";
  d.links = body->links;
  d.link_count = body->link_count;
  d.coordinates = body->coordinates;
  d.coordinate_count = body->coordinate_count;
  d.points = body->points;
  d.point_count = body->point_count;
  d.feet = feet;
  d.foot_count = body->foot_count;
  return ambulo_model_create(&d, NULL, list, model);
}

static ambulo_model *on_points(void) {
  ambulo_model *body = walker_create(0), *model = NULL;
  ambulo_foot feet[2] = {point_foot(&body->feet[0]), point_foot(&body->feet[1])};
  assert_int_equal(build(body, feet, &model, NULL), AMBULO_OK);
  ambulo_model_free(body);
  return model;
}

static void a_point_is_one_corner(void **state) {
  (void)state;
  ambulo_model *model = on_points();
  ambulo__foot_outline outline = ambulo__foot_outline_of(model, WALKER_LEFT);
  assert_int_equal(outline.is_point, 1);
  assert_int_equal(outline.count, 1);
  assert_int_equal(outline.point[0], model->feet[WALKER_LEFT].heel_center);
  assert_close(outline.length, 0.0, 0.0);
  ambulo_problem_definition d = {.model = model};
  assert_int_equal(ambulo__slots_of(&d).all_points, 1);
  ambulo_model_free(model);
  model = walker_create(0);
  assert_int_equal(ambulo__foot_outline_of(model, WALKER_LEFT).is_point, 0);
  d.model = model;
  assert_int_equal(ambulo__slots_of(&d).all_points, 0);
  ambulo_model_free(model);
}

/* one point at two of the four places is a mistake */
static void half_a_point_is_refused(void **state) {
  (void)state;
  ambulo_model *body = walker_create(0), *model = NULL;
  ambulo_foot feet[2] = {body->feet[0], body->feet[1]};
  feet[0].toe_center = feet[0].heel_center;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(build(body, feet, &model, list), AMBULO_E_MODEL);
  expect_message(list, "uses one point twice");
  ambulo_diagnostics_free(list);
  ambulo_model_free(body);
}

static void prepare(row_fixture *f) {
  row_fixture_open_body(f, on_points());
  f->definition.contacts = both;
  f->definition.contact_count = 2;
  f->definition.contact_tolerance = 0.002;
  f->definition.ground_reaction.kind = AMBULO_REACTION_SHARED;
  f->context.channels.feet = f->context.channels.slots = 2;
  free(f->channel);
  f->channel =
      calloc((size_t)(ROW_NODES * ambulo__channel_count(&f->context.channels)), sizeof(double));
  for (int k = 0; k < ROW_NODES; k++) {
    f->active[2 * k + WALKER_LEFT] = 1;
    f->active[2 * k + WALKER_RIGHT] = k < 2 ? 0 : -1;
  }
}

/* three directions of the point, either way, and nothing of how the link is turned */
static void a_loaded_point_stays_and_turns(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f);
  ambulo__contact_tube_rows(&f.context, &f.table);
  int rows = 0;
  for (int r = 0; r < f.table.row_count; r++) rows += f.table.rows[r].time == 0.0;
  assert_int_equal(rows, 12);
  assert_int_equal(row_count(&f, "contact", "l_heel", "behind", 0.0), 1);
  row_fixture_close(&f);
}

/* a point in the air keeps its height; feet that can turn keep yaw and roll too */
static void a_point_in_the_air_has_one_height(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f);
  f.definition.clearance.height = 0.03;
  ambulo__clearance_rows(&f.context, &f.table);
  assert_int_equal(row_count(&f, "clearance", "r_heel", "low", 0.75), 1);
  for (int r = 0; r < f.table.row_count; r++)
    assert_string_not_equal(f.table.rows[r].detail, "turned left");
  row_fixture_close(&f);
}

/* the foot with more weight speaks of moments for both: the left one, which stays */
static void one_point_speaks_of_moments(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f);
  ambulo__sharing_rows(&f.context, &f.table);
  assert_int_equal(row_count(&f, "normal_force", "right", "pulls", 0.25), 1);
  assert_int_equal(row_count(&f, "pressure", "right", "front", 0.25), 0);
  assert_int_equal(row_count(&f, "free_moment", "right", "to the left", 0.25), 0);
  assert_int_equal(row_count(&f, "pressure", "left", "front", 0.25), 1);
  const ambulo__channels *c = &f.context.channels;
  double mg = 72.0 * 9.81; /* of all of it 5 mm ahead of the point: at the edge of its region */
  *row_channel(&f, 1, ambulo__channel_foot_force(c, WALKER_LEFT, 1)) = mg;
  *row_channel(&f, 1, ambulo__channel_contact_moment(c, WALKER_LEFT, 2)) = mg * 0.005;
  assert_close(row_value(&f, row_find(&f, "pressure", "left", "front", 0.25)), 4e-5, 1e-12);
  row_fixture_close(&f);
}

static void a_gait_puts_points_down_once(void **state) {
  (void)state;
  ambulo_model *model = on_points();
  ambulo_gait gait = ambulo_gait_default();
  gait.steps = 2;
  gait.step_time = 0.5;
  gait.step_length = 0.3;
  gait.step_width = 0.2;
  ambulo_contact contacts[16];
  int count = 0, left = 0;
  assert_int_equal(ambulo_gait_expand(model, &gait, contacts, 16, &count), AMBULO_OK);
  for (int i = 0; i < count; i++) {
    assert_int_equal(contacts[i].mode, AMBULO_CONTACT_FLAT);
    if (contacts[i].foot != gait.first_foot || contacts[i].from != 0.0) continue;
    assert_close(contacts[i].to, gait.toe_off, 1e-12); /* a stride lasts 1 s */
    left++;
  }
  assert_int_equal(left, 1);
  ambulo_model_free(model);
}

static ambulo_problem_definition definition_of(const ambulo_model *model,
                                               const ambulo_contact *contacts) {
  ambulo_problem_definition d = ambulo_problem_definition_default();
  d.model = model;
  d.contacts = contacts;
  d.contact_count = 2;
  d.duration = 1.0;
  d.intervals = 8;
  d.ground_reaction.kind = AMBULO_REACTION_SHARED;
  d.contact_tolerance = 0.002;
  d.clearance.height = 0.03;
  return d;
}

static void points_are_on_no_heel(void **state) {
  (void)state;
  ambulo_model *model = on_points();
  ambulo_contact contacts[2] = {both[0], both[1]};
  contacts[1].mode = AMBULO_CONTACT_HEEL;
  ambulo_problem_definition d = definition_of(model, contacts);
  ambulo_problem *problem = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_problem_create(&d, NULL, list, &problem), AMBULO_E_PROBLEM);
  expect_message(list, "the point foot 'left' is on its heel; expected mode flat");
  ambulo_diagnostics_free(list);
  ambulo_model_free(model);
}

static void gradients_of_points_are_exact(void **state) {
  (void)state;
  ambulo_model *model = on_points();
  ambulo_problem_definition d = definition_of(model, both);
  ambulo_problem *problem = NULL;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &problem), AMBULO_OK);
  int n = ambulo_problem_variable_count(problem), count = 0;
  double *x = calloc((size_t)n, sizeof *x);
  for (int i = 0; i < n; i++) x[i] = 0.1 * sin(1.7 * i);
  ambulo_derivative_error errors[32];
  ambulo_workspace *workspace = NULL;
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  assert_int_equal(ambulo_problem_check_derivatives(problem, workspace, x, 0.0, errors, 32, &count),
                   AMBULO_OK);
  assert_true(count > 3);
  for (int i = 0; i < count; i++) {
    if (!(errors[i].error < 1e-6))
      print_error("%s %s %g s: %g beside %g\n", errors[i].family, errors[i].subject, errors[i].time,
                  errors[i].analytic, errors[i].numeric);
    assert_true(errors[i].error < 1e-6);
  }
  free(x);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

/* rows at one motion, with the moments of contacts counted by an arm */
static double *rows_with_arm(const ambulo_model *model, double arm, int *count) {
  ambulo_problem_definition d = definition_of(model, both);
  ambulo_problem *problem = NULL;
  ambulo_workspace *workspace = NULL;
  d.ground_reaction.moment_arm = arm;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &problem), AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  int n = ambulo_problem_variable_count(problem);
  *count = ambulo_problem_row_count(problem);
  double *x = calloc((size_t)n, sizeof *x), *rows = calloc((size_t)*count, sizeof *rows);
  for (int i = 0; i < n; i++) x[i] = 0.1 * sin(1.7 * i);
  assert_int_equal(ambulo_problem_evaluate(problem, workspace, x, NULL, NULL, rows), AMBULO_OK);
  free(x);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(problem);
  return rows;
}

/* no more than the region of a point, whatever the arm of soles; less is as it is given */
static void points_turn_next_to_nothing(void **state) {
  (void)state;
  ambulo_model *model = on_points();
  static const double arms[] = {0.2, 0.005, 0.001};
  double *rows[3];
  int count = 0, others = 0;
  for (int i = 0; i < 3; i++) rows[i] = rows_with_arm(model, arms[i], &count);
  for (int r = 0; r < count; r++) {
    assert_close(rows[0][r], rows[1][r], 0.0);
    others += rows[2][r] != rows[1][r];
  }
  assert_true(others > 0);
  for (int i = 0; i < 3; i++) free(rows[i]);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_point_is_one_corner),
                                     cmocka_unit_test(half_a_point_is_refused),
                                     cmocka_unit_test(a_loaded_point_stays_and_turns),
                                     cmocka_unit_test(a_point_in_the_air_has_one_height),
                                     cmocka_unit_test(one_point_speaks_of_moments),
                                     cmocka_unit_test(a_gait_puts_points_down_once),
                                     cmocka_unit_test(points_are_on_no_heel),
                                     cmocka_unit_test(gradients_of_points_are_exact),
                                     cmocka_unit_test(points_turn_next_to_nothing)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
