/* Every number of a definition built in code: what is not finite, or absurd, is refused by name. */
#include "model/model.h"
#include "ambulo/tools/load.h"
#include "support/messages.h"
#include "support/problem_fixture.h"

typedef struct built {
  ambulo_model *model;
  ambulo_problem_definition d;
  ambulo_term terms[3];
  ambulo_user_row row;
  ambulo_tube tube;
  ambulo_end_value end;
  double scale[2], offset[2], passive[8], strength[12], reference[22], samples[6], width[2];
} built;

static double zero(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  (void)user, (void)state, (void)gradient;
  return 1.0;
}

/* the arm with one of everything that holds numbers */
static void build(built *b) {
  memset(b, 0, sizeof *b);
  b->model = arm_create();
  b->d = arm_definition(b->model);
  for (int i = 0; i < 2; i++) {
    b->scale[i] = b->width[i] = 1.0;
    for (int k = 0; k < 2; k++) b->strength[6 * i + 3 * k] = 40.0;
  }
  b->terms[0] = ambulo_term_default(AMBULO_TORQUE_POWER);
  b->terms[0].scale = b->scale;
  b->terms[0].offset = b->offset;
  b->terms[0].passive = b->passive;
  b->terms[0].strength = b->strength;
  b->terms[1] = ambulo_term_default(AMBULO_TRACKING);
  b->terms[1].reference = b->reference;
  b->terms[2] = ambulo_term_default(AMBULO_CLEARANCE);
  b->row = (ambulo_user_row){"row", "m", AMBULO_NOT_NEGATIVE, 0.0, 1.0, zero, NULL};
  b->tube = (ambulo_tube){3, b->samples, b->width};
  b->end = (ambulo_end_value){0, 0, 0, 0.1};
  b->d.strike_pitch[0] = 0.1;
  b->d.strike_pitch[1] = 0.3;
  b->d.terms = b->terms;
  b->d.term_count = 3;
  b->d.user_rows = &b->row;
  b->d.user_row_count = 1;
  b->d.tubes = &b->tube;
  b->d.tube_count = 1;
  b->d.end_values = &b->end;
  b->d.end_value_count = 1;
}

static ambulo_status create(const built *b, ambulo_diagnostics *list) {
  ambulo_problem *problem = NULL;
  ambulo_status status = ambulo_problem_create(&b->d, NULL, list, &problem);
  ambulo_problem_free(problem);
  return status;
}

/* `value` in place of *number is refused with E_PROBLEM and a message that holds `name` */
static void expect_refused(built *b, double *number, double value, const char *name) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  double kept = *number;
  *number = value;
  ambulo_status status = create(b, list);
  *number = kept;
  if (status != AMBULO_E_PROBLEM)
    print_error("%s = %g: %s\n", name, value, ambulo_status_name(status));
  assert_int_equal(status, AMBULO_E_PROBLEM);
  assert_message(list, 0, name);
  ambulo_diagnostics_free(list);
}

static void what_is_built_is_legal(void **state) {
  (void)state;
  built b;
  build(&b);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = create(&b, list);
  if (status) assert_message(list, 0, "nothing is wrong");
  assert_int_equal(status, AMBULO_OK);
  ambulo_diagnostics_free(list);
  ambulo_model_free(b.model);
}

enum { MAY_BE_INFINITE = 1, MAY_BE_OFF };

static void expect_range(built *b, double *number, const char *name, int what) {
  expect_refused(b, number, what == MAY_BE_OFF ? -1.0 : NAN, name);
  if (what == MAY_BE_INFINITE) return;
  expect_refused(b, number, INFINITY, name);
  expect_refused(b, number, -INFINITY, name);
  expect_refused(b, number, 1e300, name);
}

static void numbers_have_ranges(void **state) {
  (void)state;
  built b;
  build(&b);
  ambulo_ground_reaction *r = &b.d.ground_reaction;
  ambulo_clearance *c = &b.d.clearance;
  const struct {
    double *number;
    const char *name;
    int what; /* MAY_BE_... */
  } all[] = {
      {&b.d.duration, "time.duration", 0},
      {&b.d.ground_height, "ground_height", 0},
      {&b.d.support_margin, "zmp_margin", 0},
      {&b.d.minimum_force, "minimum_force", MAY_BE_OFF},
      {&b.d.contact_tolerance, "contact_tolerance", 0},
      {&b.d.orientation_tolerance, "orientation_tolerance", 0},
      {&b.d.strike_pitch[0], "strike_pitch", 0},
      {&b.d.strike_pitch[1], "strike_pitch", 0},
      {&b.d.travel, "ends.travel", 0},
      {&c->height, "clearance.height", MAY_BE_OFF},
      {&c->tip_from, "clearance.tip_from", 0},
      {&c->ceiling, "clearance.ceiling", 1},
      {&c->turn, "clearance.turn", 1},
      {&c->outward, "clearance.outward", 1},
      {&c->inward, "clearance.inward", 1},
      {&c->feet, "clearance.feet", MAY_BE_OFF},
      {&r->friction, "ground_reaction.friction", MAY_BE_OFF},
      {&r->free_moment, "ground_reaction.free_moment", MAY_BE_OFF},
      {&r->loading_rate, "ground_reaction.loading_rate", MAY_BE_OFF},
      {&r->heel_pressure[0], "pressure.heel", MAY_BE_OFF},
      {&r->heel_pressure[1], "pressure.heel", MAY_BE_OFF},
      {&r->heel_roll, "pressure.roll", 0},
      {&r->flat_pressure[1], "pressure.flat", MAY_BE_OFF},
      {&r->toe_pressure[0], "pressure.toe", MAY_BE_OFF},
      {&r->pressure_width, "pressure.width", MAY_BE_OFF},
      {&r->arc_pressure, "pressure.arc", 0},
      {&r->heel_pad, "ground_reaction.heel_pad", 0},
      {&b.terms[0].weight, "objective[0]", 0},
      {&b.terms[0].smoothing, "objective[0]", 0},
      {&b.terms[0].power, "objective[0]", 0},
      {&b.terms[2].height, "objective[2]", 0},
      {&b.scale[1], "objective[0] (torque_power): scale[1]", 0},
      {&b.offset[0], "objective[0] (torque_power): offset[0]", 0},
      {&b.passive[5], "objective[0] (torque_power): passive[5]", 0},
      {&b.strength[11], "objective[0] (torque_power): strength[11]", 0},
      {&b.reference[21], "objective[1] (tracking): reference[21]", 0},
      {&b.samples[5], "tubes[0]", 0},
      {&b.width[1], "tubes[0]", 1},
      {&b.end.value, "end value 0", 0},
      {&b.row.from, "user row 0", 1},
      {&b.row.to, "user row 0", 1},
  };
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
    expect_range(&b, all[i].number, all[i].name, all[i].what);
  }
  ambulo_model_free(b.model);
}

/* where infinity says that there is no bound it passes */
static void no_bound_is_a_bound(void **state) {
  (void)state;
  built b;
  build(&b);
  b.d.clearance.ceiling = b.d.clearance.turn = b.d.clearance.outward = INFINITY;
  b.width[0] = INFINITY;
  b.row.from = -INFINITY;
  b.row.to = INFINITY;
  assert_int_equal(create(&b, NULL), AMBULO_OK);
  ambulo_model_free(b.model);
}

/* refused with a message that holds `text` */
static void expect_message(built *b, const char *text) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(create(b, list), AMBULO_E_PROBLEM);
  assert_message(list, 0, text);
  ambulo_diagnostics_free(list);
}

static void what_is_missing_is_named(void **state) {
  (void)state;
  built b;
  build(&b);
  double breakpoints[11];
  for (int i = 0; i <= 10; i++) breakpoints[i] = i == 4 ? NAN : 0.1 * i;
  b.d.breakpoints = breakpoints;
  b.d.spline_intervals = 10;
  expect_message(&b, "trajectory.breakpoints[4] is nan");
  b.d.breakpoints = NULL;
  b.terms[0] = ambulo_term_default(AMBULO_USER_SQUARE);
  expect_message(&b, "objective[0] (user_square): no function");
  b.terms[0] = ambulo_term_default(AMBULO_FORCE_RATE);
  expect_message(&b, "objective[0] (force_rate): no forces on feet without ground_reaction");
  ambulo_model_free(b.model);
}

/* a pad goes with a force, and a foot gives within a tolerance */
static void a_pad_needs_forces_and_a_tolerance(void **state) {
  (void)state;
  built b;
  build(&b);
  b.d.ground_reaction.heel_pad = 0.008;
  expect_message(&b, "ground_reaction.heel_pad is 0.008 m and no forces press on it");
  b.d.ground_reaction.kind = AMBULO_REACTION_SHARED;
  expect_message(&b, "ground_reaction.heel_pad is 0.008 m without constraints.contact_tolerance");
  b.d.contact_tolerance = 0.001;
  expect_message(&b, "press on the surroundings with 0 links");
  ambulo_model_free(b.model);
}

/* one weight is enough, wherever it stands */
static void some_weight_is_not_zero(void **state) {
  (void)state;
  built b;
  build(&b);
  b.terms[1].weight = b.terms[2].weight = 0.0;
  assert_int_equal(create(&b, NULL), AMBULO_OK);
  b.terms[0].weight = 0.0;
  expect_message(&b, "every objective weight is 0");
  ambulo_model_free(b.model);
}

static void a_line_has_a_length(void **state) {
  (void)state;
  ambulo_model *body = NULL;
  assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", NULL, NULL, NULL, &body),
                   AMBULO_OK);
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_term term = ambulo_term_default(AMBULO_UPRIGHT);
  term.point[0] = ambulo_model_find_point(body, "heel_r");
  term.point[1] = ambulo_model_find_point(body, "heel_r");
  d.model = body;
  d.terms = &term;
  d.term_count = 1;
  built b = {.model = body, .d = d};
  expect_message(&b, "points heel_r and heel_r; expected two points that are apart");
  ambulo_model_free(body);
}

static void expect_grid_refused(const built *b, const char *text) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(create(b, list), AMBULO_E_PROBLEM);
  assert_message(list, 0, text);
  ambulo_diagnostics_free(list);
}

static void grids_are_checked(void **state) {
  (void)state;
  built b;
  build(&b);
  double times[11], breaks[3] = {0.0, 0.5, 1.0};
  for (int k = 0; k < 11; k++) times[k] = 0.01 * k * k;
  b.d.node_times = times;
  expect_grid_refused(&b, "node_times are given for a uniform grid");
  b.d.grid = AMBULO_GRID_EVENTS;
  assert_int_equal(create(&b, NULL), AMBULO_OK);
  times[10] = 1.1;
  expect_grid_refused(&b, "node_times run from 0 s to 1.1 s; expected 0 s to 1 s");
  times[10] = 1.0;
  times[0] = 0.001;
  expect_grid_refused(&b, "node_times run from 0.001 s to 1 s");
  times[0] = 0.0;
  times[4] = times[3];
  expect_grid_refused(&b, "node_times[4] is 0.09 s after 0.09 s; expected rising times");
  times[4] = NAN;
  expect_grid_refused(&b, "node_times[4] is nan s after 0.09 s");
  b.d.node_times = NULL;
  b.d.discretization = AMBULO_HERMITE;
  expect_grid_refused(&b, "a grid on events with basis hermite; expected bspline");
  b.d.discretization = AMBULO_BSPLINE;
  b.d.grid = (ambulo_grid)3;
  expect_grid_refused(&b, "time.grid is unknown (got 3); expected 1 (uniform) or 2 (events)");
  b.d.grid = AMBULO_GRID_UNIFORM;
  b.d.knots = AMBULO_GRID_EVENTS;
  b.d.breakpoints = breaks;
  b.d.spline_intervals = 2;
  expect_grid_refused(&b, "trajectory.breakpoints are given and knots on events asked for");
  b.d.breakpoints = NULL;
  assert_int_equal(create(&b, NULL), AMBULO_OK);
  b.d.knots = (ambulo_grid)-1;
  expect_grid_refused(&b, "trajectory.knots is unknown (got -1)");
  ambulo_model_free(b.model);
}

/* 0 of an enumeration says nothing, and where a choice is needed nothing is refused */
static void choices_that_are_not_set(void **state) {
  (void)state;
  built b;
  build(&b);
  const ambulo_problem_definition good = b.d;
  b.d.grid = AMBULO_GRID_NOT_SET;
  expect_grid_refused(&b, "time.grid is not set (got 0)");
  b.d = good;
  b.d.knots = AMBULO_GRID_NOT_SET;
  expect_grid_refused(&b, "trajectory.knots is not set (got 0)");
  b.d = good;
  b.d.discretization = AMBULO_DISCRETIZATION_NOT_SET;
  expect_grid_refused(&b, "not set (got 0)");
  b.d = good;
  ambulo_term term = ambulo_term_default(AMBULO_TORQUE_SQUARED);
  term.kind = AMBULO_TERM_KIND_NOT_SET;
  b.d.terms = &term;
  b.d.term_count = 1;
  expect_grid_refused(&b, "not set (got 0)");
  ambulo_model_free(b.model);
}

/* one of strength that is limits, with a price for each direction */
static void strength_that_is_limits(void **state) {
  (void)state;
  built b;
  build(&b);
  double price[4] = {1.0, 2.0, 0.5, 1.0};
  const char *priced = "a price of", *limits = "and shoulder has none in the model";
  double *torque = b.model->coordinates[0].torque;
  b.terms[0].price = price;
  expect_refused(&b, &price[0], 1.0, "prices without strength: limits");
  b.terms[0].strength_is_limits = 1;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(create(&b, list), AMBULO_OK);
  ambulo_diagnostics_free(list);
  for (int k = 0; k < 4; k++) {
    expect_range(&b, &price[k], priced, 0);
    expect_refused(&b, &price[k], 0.0, priced);
    expect_refused(&b, &price[k], -1.0, priced);
  }
  for (int side = 0; side < 2; side++) {
    expect_refused(&b, &torque[side], side ? INFINITY : -INFINITY, limits);
    expect_refused(&b, &torque[side], 0.0, limits);
  }
  b.terms[0].price = NULL;
  b.terms[1].strength_is_limits = 1;
  expect_refused(&b, &b.terms[0].weight, 1.0, "strength is limits; expected torque_power");
  ambulo_model_free(b.model);
}

/* 2 is the square, and 8 the most */
static void exponents_are_between_two_and_eight(void **state) {
  (void)state;
  static const double legal[] = {2.0, 2.5, 8.0}, refused[] = {1.99, 8.01};
  built b;
  build(&b);
  for (size_t i = 0; i < sizeof legal / sizeof *legal; i++) {
    b.terms[0].power = legal[i];
    assert_int_equal(create(&b, NULL), AMBULO_OK);
  }
  for (size_t i = 0; i < sizeof refused / sizeof *refused; i++)
    expect_refused(&b, &b.terms[0].power, refused[i], "objective[0]");
  ambulo_model_free(b.model);
}

static void tendons_are_those_of_power(void **state) {
  (void)state;
  built b;
  build(&b);
  double tendon[2] = {40.0, 0.0};
  b.terms[0].tendon = tendon;
  b.terms[0].kind = AMBULO_MECHANICAL_POWER;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(create(&b, list), AMBULO_OK);
  ambulo_diagnostics_free(list);
  expect_range(&b, &tendon[1], "objective[0] (mechanical_power): tendon", 0);
  expect_refused(&b, &tendon[1], -1.0, "objective[0] (mechanical_power): tendon");
  b.terms[0].kind = AMBULO_TORQUE_SQUARED;
  expect_refused(&b, &tendon[1], 1.0, "objective[0] (torque_squared): tendons; expected mech");
  ambulo_model_free(b.model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(exponents_are_between_two_and_eight),
                                     cmocka_unit_test(tendons_are_those_of_power),
                                     cmocka_unit_test(what_is_built_is_legal),
                                     cmocka_unit_test(strength_that_is_limits),
                                     cmocka_unit_test(grids_are_checked),
                                     cmocka_unit_test(choices_that_are_not_set),
                                     cmocka_unit_test(numbers_have_ranges),
                                     cmocka_unit_test(no_bound_is_a_bound),
                                     cmocka_unit_test(what_is_missing_is_named),
                                     cmocka_unit_test(a_pad_needs_forces_and_a_tolerance),
                                     cmocka_unit_test(some_weight_is_not_zero),
                                     cmocka_unit_test(a_line_has_a_length)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
