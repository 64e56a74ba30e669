/* Terms of forces, feet in the air and devices: values by hand, slopes by differences. */
#include "ambulo/tools/load.h"
#include "form_fixture.h"
#include "problem/term.h"
#include "support/test.h"

/* Differences of the forces on contacts between neighbouring nodes, as shares of ten body weights a
 * second. */

enum { RATE_SLOTS = 3, RATE_CHANNELS = 4 * 2 + 6 + 3 * 2 + 6 * RATE_SLOTS + 3 };

typedef struct rate_fixture {
  ambulo_model *model;
  double lanes[RATE_CHANNELS * AMBULO__LANES];
  ambulo__term_context context;
  double weight;
} rate_fixture;

static const double rate_times[FORM_NODES] = {0.0, 0.1, 0.35};

static void rate_open(rate_fixture *f, int slots) {
  f->model = arm_create();
  const double *g = ambulo_model_gravity(f->model);
  f->weight = ambulo_model_mass(f->model) * sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  for (int i = 0; i < RATE_CHANNELS * AMBULO__LANES; i++) f->lanes[i] = sin(1.7 * i);
  f->context = (ambulo__term_context){
      .model = f->model,
      .channels = {.coordinates = 2, .points = 2, .feet = slots ? 2 : 0, .slots = slots},
      .channel_count = RATE_CHANNELS,
      .lanes = f->lanes,
      .nodes = FORM_NODES,
      .times = rate_times};
}

static double *rate_at(rate_fixture *f, int node, int slot, int axis) {
  int channel = ambulo__channel_foot_force(&f->context.channels, slot, axis);
  return &f->lanes[ambulo__lane_index(node, RATE_CHANNELS, channel)];
}

static void the_force_rate_is_the_difference_over_the_step(void **state) {
  (void)state;
  rate_fixture f;
  ambulo_term term = ambulo_term_default(AMBULO_FORCE_RATE);
  rate_open(&f, RATE_SLOTS);
  for (int node = 0; node < 2; node++) {
    assert_int_equal(ambulo__term_forms(&term, &f.context, node), 3 * RATE_SLOTS);
    for (int j = 0; j < 3 * RATE_SLOTS; j++) {
      ambulo__form form;
      ambulo__term_form(&term, &f.context, node, j, &form);
      double change = *rate_at(&f, node + 1, j / 3, j % 3) - *rate_at(&f, node, j / 3, j % 3);
      double step = rate_times[node + 1] - rate_times[node];
      assert_close(form.u, change / (10.0 * f.weight * step), 1e-15);
      assert_int_equal(form.count, 2);
    }
  }
  ambulo_model_free(f.model);
}

/* u is linear in the two forces: its slopes are exact differences */
static void slopes_are_what_a_change_makes(void **state) {
  (void)state;
  rate_fixture f;
  ambulo_term term = ambulo_term_default(AMBULO_FORCE_RATE);
  rate_open(&f, RATE_SLOTS);
  for (int j = 0; j < 3 * RATE_SLOTS; j++) {
    ambulo__form form, moved;
    ambulo__term_form(&term, &f.context, 1, j, &form);
    for (int c = 0; c < form.count; c++) {
      double *value =
          &f.lanes[ambulo__lane_index(1 + form.ahead[c], RATE_CHANNELS, form.channel[c])];
      assert_true(value == rate_at(&f, 1 + form.ahead[c], j / 3, j % 3));
      *value += 1000.0;
      ambulo__term_form(&term, &f.context, 1, j, &moved);
      assert_close(form.slope[c], (moved.u - form.u) / 1000.0, 1e-12);
      *value -= 1000.0;
    }
  }
  ambulo_model_free(f.model);
}

/* ten body weights more in a second are 1, steady forces 0; the last node begins no interval */
static void a_steady_force_costs_nothing(void **state) {
  (void)state;
  rate_fixture f;
  ambulo_term term = ambulo_term_default(AMBULO_FORCE_RATE);
  ambulo__form form;
  rate_open(&f, 1);
  *rate_at(&f, 0, 0, 1) = *rate_at(&f, 1, 0, 1) = 500.0;
  *rate_at(&f, 2, 0, 1) = 500.0 + 2.5 * f.weight;
  ambulo__term_form(&term, &f.context, 0, 1, &form);
  assert_close(form.u, 0.0, 0.0);
  ambulo__term_form(&term, &f.context, 1, 1, &form);
  assert_close(form.u, 1.0, 1e-14);
  assert_int_equal(ambulo__term_forms(&term, &f.context, 2), 0);
  assert_true(ambulo__term_is_rate(&term));
  ambulo_model_free(f.model);
}

/* Heights of feet in the air. */

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

/* Efforts of devices, scaled one by one; none where the scale is 0. */

enum { DEVICES = 3, EFFORT_CHANNELS = 4 * 2 + 6 + 3 * 2 + DEVICES };

static void efforts_times_their_scale(void **state) {
  (void)state;
  static const double scale[DEVICES] = {0.5, 0.0, 2.0};
  double lanes[EFFORT_CHANNELS * AMBULO__LANES];
  ambulo_model *model = arm_create();
  ambulo_term term = ambulo_term_default(AMBULO_DEVICE_EFFORT);
  for (int i = 0; i < EFFORT_CHANNELS * AMBULO__LANES; i++) lanes[i] = sin(1.7 * i);
  const ambulo__term_context context = {
      .model = model,
      .channels = {.coordinates = 2, .points = 2, .devices = DEVICES},
      .channel_count = EFFORT_CHANNELS,
      .lanes = lanes,
      .nodes = FORM_NODES};
  assert_int_equal(ambulo__channel_count(&context.channels), EFFORT_CHANNELS);
  assert_string_equal(ambulo__term_info_of(term.kind)->name, "device_effort");
  for (int scaled = 0; scaled < 2; scaled++) {
    term.device_scale = scaled ? scale : NULL;
    assert_int_equal(ambulo__term_forms(&term, &context, 1), DEVICES);
    for (int i = 0; i < DEVICES; i++) {
      double factor = scaled ? scale[i] : 1.0;
      int channel = EFFORT_CHANNELS - DEVICES + i;
      ambulo__form form;
      ambulo__term_form(&term, &context, 1, i, &form);
      assert_int_equal(form.count, factor != 0.0);
      assert_close(form.u, factor * lanes[channel * AMBULO__LANES + 1], 1e-15);
      if (!form.count) continue;
      assert_int_equal(form.channel[0], channel);
      assert_int_equal(form.ahead[0], 0);
      assert_close(form.slope[0], factor, 0.0);
    }
  }
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_force_rate_is_the_difference_over_the_step),
      cmocka_unit_test(slopes_are_what_a_change_makes),
      cmocka_unit_test(a_steady_force_costs_nothing),
      cmocka_unit_test(feet_that_leave_or_land_count_in_part),
      cmocka_unit_test(low_feet_in_the_air_cost),
      cmocka_unit_test(efforts_times_their_scale)};
  return cmocka_run_group_tests_name("problem/term_kinds_contacts", tests, NULL, NULL);
}
