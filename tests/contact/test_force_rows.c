/* Rows of contacts that share the load, by hand: double support from 0 to 0.5 s of a motion of 1 s
 * that does not repeat.
 *
 * Right foot on its toes, foothold (0, -0.1), leaves at 0.5 s; left foot on its heel, foothold
 * (0.5, 0.1), from before. Heel to toe 0.22 m, mass 72 kg; centre on the toes 0.24 m ahead of the
 * foothold. World: x forward, y up, z right. */
#include "contact/contacts.h"
#include "contact/row_families.h"
#include "support/patched_walker.h"
#include "support/row_fixture.h"

static const ambulo_contact level[] = {
    {WALKER_RIGHT, AMBULO_CONTACT_TOE, 0.0, 0.5, .place = {0.0, -0.1}},
    {WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.0, 1.0, .place = {0.5, 0.1}}};

static const double mg = 72.0 * 9.81;
static const double allowed = 4e-5; /* m: beyond the patch, whatever the force */

static void prepare(row_fixture *f, int planar, const ambulo_contact *contacts, int count) {
  row_fixture_open(f, planar);
  f->definition.contacts = contacts;
  f->definition.contact_count = count;
  f->definition.ground_reaction.kind = AMBULO_REACTION_SHARED;
  ambulo_ground_reaction *r = &f->definition.ground_reaction;
  r->heel_pressure[0] = r->toe_pressure[0] = -0.02;
  r->heel_pressure[1] = 0.03;
  r->flat_pressure[0] = -0.005;
  r->flat_pressure[1] = 0.02;
  r->toe_pressure[1] = 0.055;
  r->pressure_width = 0.035;
  f->context.channels.feet = f->context.channels.slots = 2;
  free(f->channel);
  f->channel =
      calloc((size_t)(ROW_NODES * ambulo__channel_count(&f->context.channels)), sizeof(double));
  for (int k = 0; k < ROW_NODES; k++) {
    f->active[2 * k + WALKER_LEFT] = 1;
    f->active[2 * k + WALKER_RIGHT] = k < 2 ? 0 : -1;
  }
}

/* force and moment about the centre, world axes, in body weights */
static void load(row_fixture *f, int node, int foot, const double force[3],
                 const double moment[3]) {
  const ambulo__channels *c = &f->context.channels;
  for (int i = 0; i < 3; i++) {
    *row_channel(f, node, ambulo__channel_foot_force(c, foot, i)) = mg * force[i];
    *row_channel(f, node, ambulo__channel_contact_moment(c, foot, i)) = mg * moment[i];
  }
}

static void expect(row_fixture *f, const char *family, const char *subject, const char *detail,
                   double time, double value) {
  double got = row_value(f, row_find(f, family, subject, detail, time));
  if (fabs(got - value) > 1e-12)
    print_error("%s %s %s at %g s: %.15g, expected %.15g\n", family, subject, detail, time, got,
                value);
  assert_close(got, value, 1e-12);
}

/* the cone with its tip rounded by 1e-4: mu n of the normal force, t along the surface */
static double cone(double held, double t) {
  return held + 1e-4 - hypot(t, 1e-4);
}

static void contacts_push_and_are_loaded_at_a_rate(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, 0, level, 2);
  ambulo__sharing_rows(&f.context, &f.table);
  const double force[3] = {0.05, 0.6, 0.02}, none[3] = {0, 0, 0};
  load(&f, 1, WALKER_RIGHT, force, none);
  expect(&f, "normal_force", "right", "pulls", 0.25, 0.6);
  /* leaves 0.25 s later; did not come down */
  double most = 15.0 * (0.25 - 0.0065 * (1.0 - exp(-0.25 / 0.0065)));
  expect(&f, "normal_force", "right", "loaded too fast", 0.25, most - 0.6);
  /* neither came down nor leaves */
  assert_int_equal(row_count(&f, "normal_force", "left", "loaded too fast", 0.25), 0);
  assert_int_equal(row_count(&f, "normal_force", "left", "pulls", 0.25), 1);
  row_fixture_close(&f);
}

static void each_contact_has_its_friction(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, 0, level, 2);
  ambulo__sharing_rows(&f.context, &f.table);
  const double force[3] = {-0.1, 0.4, -0.05}, none[3] = {0, 0, 0};
  load(&f, 1, WALKER_LEFT, force, none);
  expect(&f, "friction", "left", "slips", 0.25, cone(0.2, hypot(0.1, 0.05)));
  assert_int_equal(row_count(&f, "friction", "left", "slips", 0.25), 1);
  row_fixture_close(&f);
}

/* a force at a point of the patch has the moment (point - centre) x force about the centre */
static void pressure_stays_in_the_patch(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, 0, level, 2);
  ambulo__sharing_rows(&f.context, &f.table);
  double ahead = 0.03, aside = 0.01, up = 0.5;
  /* (ahead, 0, -aside) x (0, up, 0) */
  const double force[3] = {0, up, 0}, moment[3] = {aside * up, 0, ahead * up};
  load(&f, 1, WALKER_RIGHT, force, moment);
  expect(&f, "pressure", "right", "front", 0.25, allowed + up * (0.055 - 0.02 - ahead));
  expect(&f, "pressure", "right", "back", 0.25, allowed + up * (ahead + 0.02 + 0.02));
  expect(&f, "pressure", "right", "left", 0.25, allowed + up * (0.035 - aside));
  expect(&f, "pressure", "right", "right", 0.25, allowed + up * (0.035 + aside));
  f.table.row_count = 0;
  f.definition.ground_reaction.pressure = 0;
  ambulo__sharing_rows(&f.context, &f.table);
  assert_int_equal(row_count(&f, "pressure", "right", "front", 0.25), 0);
  row_fixture_close(&f);
}

static void each_contact_has_its_free_moment(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, 0, level, 2);
  ambulo__sharing_rows(&f.context, &f.table);
  const double force[3] = {0, 0.5, 0}, moment[3] = {0, 0.004, 0};
  load(&f, 1, WALKER_LEFT, force, moment);
  expect(&f, "free_moment", "left", "to the left", 0.25, 0.02 - 0.004);
  expect(&f, "free_moment", "left", "to the right", 0.25, 0.02 + 0.004);
  expect(&f, "free_moment", "right", "to the left", 0.25, 0.02);
  row_fixture_close(&f);
}

/* a force along the surface's normal has all of its room, whatever the surface's axes */
static void rows_are_about_the_axes_of_the_surface(void **state) {
  (void)state;
  static const ambulo_contact leaning[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_TOE, 0.0, 0.5, .place = {0.0, -0.1}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.5, 0.1, 0.2},
       .normal = {-0.3, 0.2, 1.0}, .heading = 0.5}};
  row_fixture f;
  prepare(&f, 0, leaning, 2);
  ambulo__sharing_rows(&f.context, &f.table);
  ambulo__contact_frame a = ambulo__contact_frame_of(&f.definition, &leaning[1]);
  double force[3], moment[3];
  for (int i = 0; i < 3; i++) {
    force[i] = 0.5 * a.up[i] + 0.1 * a.forward[i] - 0.05 * a.left[i];
    moment[i] = 0.004 * a.up[i] - 0.01 * a.left[i] + 0.006 * a.forward[i];
  }
  load(&f, 1, WALKER_LEFT, force, moment);
  expect(&f, "normal_force", "left", "pulls", 0.25, 0.5);
  expect(&f, "friction", "left", "slips", 0.25, cone(0.25, hypot(0.1, 0.05)));
  expect(&f, "pressure", "left", "front", 0.25, allowed + 0.5 * (0.12 + 0.0) - 0.01);
  expect(&f, "pressure", "left", "left", 0.25, allowed + 0.5 * 0.035 - 0.006);
  expect(&f, "free_moment", "left", "to the left", 0.25, 0.02 - 0.004);
  row_fixture_close(&f);
}

/* a foot that begins or ends carries nothing at that instant; one in the air never */
static void contacts_without_weight_have_no_rows(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, 0, level, 2);
  row_event(&f, 2, WALKER_RIGHT, 0);
  ambulo__sharing_rows(&f.context, &f.table);
  for (int r = 0; r < f.table.row_count; r++) {
    const ambulo__table_row *row = &f.table.rows[r];
    if (row->time >= 0.5) assert_string_not_equal(row->subject, "right");
  }
  assert_int_equal(row_count(&f, "pressure", "left", "back", 0.5), 1);
  row_fixture_close(&f);
}

/* heel, then flat: at the event the pressure is in both boxes, before it and after */
static void events_have_both_boxes(void **state) {
  (void)state;
  static const ambulo_contact three[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_TOE, 0.0, 0.5, .place = {0.0, -0.1}},
      {WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.0, 0.75, .place = {0.5, 0.1}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.75, 1.0, .place = {0.5, 0.1}}};
  row_fixture f;
  prepare(&f, 0, three, 3);
  for (int k = 3; k < ROW_NODES; k++) f.active[2 * k + WALKER_LEFT] = 2;
  row_event(&f, 3, WALKER_LEFT, 1);
  ambulo__sharing_rows(&f.context, &f.table);
  assert_int_equal(row_count(&f, "pressure", "left", "front", 0.5), 1);
  assert_int_equal(row_count(&f, "pressure", "left", "front", 0.75), 2);
  assert_int_equal(row_count(&f, "pressure", "left", "front", 1.0), 1);
  const double force[3] = {0, 1, 0}, none[3] = {0, 0, 0};
  load(&f, 3, WALKER_LEFT, force, none);
  int before = 0;
  double nearest = INFINITY;
  for (int r = 0; r < f.table.row_count; r++) {
    const ambulo__table_row *row = &f.table.rows[r];
    if (strcmp(row->family, "pressure") != 0 || strcmp(row->detail, "front") != 0 ||
        row->time != 0.75)
      continue;
    before += row->before;
    if (row->before) nearest = row_value(&f, r);
  }
  assert_int_equal(before, 1);
  /* did not strike: no roll; flat the centre is still at the heel */
  assert_close(nearest, allowed + 0.03, 1e-12);
  row_fixture_close(&f);
}

static void planar_bodies_have_forward_rows_only(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, 1, level, 2);
  ambulo__sharing_rows(&f.context, &f.table);
  assert_true(f.table.row_count > 0);
  for (int r = 0; r < f.table.row_count; r++) {
    assert_string_not_equal(f.table.rows[r].family, "free_moment");
    assert_string_not_equal(f.table.rows[r].detail, "to the left");
    assert_string_not_equal(f.table.rows[r].detail, "left");
  }
  row_fixture_close(&f);
}

static void bounds_can_be_off(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, 0, level, 2);
  f.definition.ground_reaction.friction = f.definition.ground_reaction.free_moment = AMBULO_OFF;
  f.definition.ground_reaction.loading_rate = AMBULO_OFF;
  f.definition.ground_reaction.pressure = 0;
  ambulo__sharing_rows(&f.context, &f.table);
  for (int r = 0; r < f.table.row_count; r++) assert_string_equal(f.table.rows[r].detail, "pulls");
  row_fixture_close(&f);
}

/* a hand that pushes the wall ahead: the normal is backward, its forward is up */
static void patches_have_rows_of_their_size(void **state) {
  (void)state;
  ambulo_contact wall = OF_PATCH(HAND_R, 0.0, 1.0, {0.4, -0.25, 1.2});
  wall.normal[0] = -1.0;
  const ambulo_contact with_hand[] = {level[0], level[1], wall};
  row_fixture f;
  prepare(&f, 0, with_hand, 3);
  ambulo_model_free(f.model);
  f.model = patched_walker(0);
  f.definition.model = f.model;
  f.context.model = f.model;
  f.context.channels.points = f.model->point_count;
  f.context.channels.slots = 3;
  free(f.channel);
  f.channel =
      calloc((size_t)(ROW_NODES * ambulo__channel_count(&f.context.channels)), sizeof(double));
  ambulo__sharing_rows(&f.context, &f.table);
  /* 0.1 of the weight, 0.03 m up and 0.01 m to the left (-z) of its middle, a little upward:
   * (0, 0.03, -0.01) x (-0.1, 0.02, 0) = (0.0002, 0.001, 0.003) and a free moment about -x */
  const double force[3] = {-0.1, 0.02, 0.0}, moment[3] = {0.0002 - 0.0005, 0.001, 0.003};
  load(&f, 1, 2, force, moment);
  expect(&f, "normal_force", "hand_r", "pulls", 0.25, 0.1);
  expect(&f, "friction", "hand_r", "slips", 0.25, cone(0.05, 0.02));
  expect(&f, "pressure", "hand_r", "front", 0.25, allowed + 0.1 * (0.04 - 0.03));
  expect(&f, "pressure", "hand_r", "back", 0.25, allowed + 0.1 * (0.04 + 0.03));
  expect(&f, "pressure", "hand_r", "left", 0.25, allowed + 0.1 * (0.02 - 0.01));
  expect(&f, "pressure", "hand_r", "right", 0.25, allowed + 0.1 * (0.02 + 0.01));
  expect(&f, "free_moment", "hand_r", "to the left", 0.25, 0.02 - (0.0005 - 0.0002));
  assert_int_equal(row_count(&f, "normal_force", "seat", "pulls", 0.25), 0);
  row_fixture_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(contacts_push_and_are_loaded_at_a_rate),
                                     cmocka_unit_test(each_contact_has_its_friction),
                                     cmocka_unit_test(pressure_stays_in_the_patch),
                                     cmocka_unit_test(each_contact_has_its_free_moment),
                                     cmocka_unit_test(rows_are_about_the_axes_of_the_surface),
                                     cmocka_unit_test(contacts_without_weight_have_no_rows),
                                     cmocka_unit_test(events_have_both_boxes),
                                     cmocka_unit_test(planar_bodies_have_forward_rows_only),
                                     cmocka_unit_test(bounds_can_be_off),
                                     cmocka_unit_test(patches_have_rows_of_their_size)};
  return cmocka_run_group_tests_name("contact/force_rows", tests, NULL, NULL);
}
