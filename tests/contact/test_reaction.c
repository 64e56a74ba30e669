/* Rows of the ground's force, by hand: double support from 0 to 0.5 s of a motion of 1 s.
 *
 * Right foot on its toes, foothold (0, -0.1); left foot on its heel, foothold (0.5, 0.1); heel to
 * toe 0.22 m. With linear transfer the left foot carries 2 t. D (right less left) is
 * (0.24 - 0.5, -0.2). Mass 72 kg. A force F at a point p has the moment p x F. */
#include "contact/loading.h"
#include "support/row_fixture.h"

static const ambulo_contact contacts[] = {
    {WALKER_RIGHT, AMBULO_CONTACT_TOE, 0.0, 0.5, .place = {0.0, -0.1}},
    {WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.0, 1.0, .place = {0.5, 0.1}}};

static const double mg = 72.0 * 9.81;

static void prepare(row_fixture *f, int planar) {
  row_fixture_open(f, planar);
  f->definition.contacts = contacts;
  f->definition.contact_count = 2;
  f->definition.ground_reaction.kind = AMBULO_REACTION_TWO_STEP;
  f->definition.ground_reaction.transfer = AMBULO_TRANSFER_LINEAR;
  f->context.channels.feet = f->context.channels.slots = 2;
  f->context.channels.slot_rows = 4;
  free(f->channel);
  f->channel =
      calloc((size_t)(ROW_NODES * ambulo__channel_count(&f->context.channels)), sizeof(double));
  for (int k = 0; k < ROW_NODES; k++) {
    f->active[2 * k + WALKER_LEFT] = 1;
    f->active[2 * k + WALKER_RIGHT] = k < 2 ? 0 : -1;
  }
}

static void open_with(row_fixture *f, int planar) {
  prepare(f, planar);
  ambulo__reaction_rows(&f->context, &f->table);
}

/* total force F (forward, up, left) at (x, y) on the ground */
static void press(row_fixture *f, int node, double x, double y, const double force[3]) {
  double p[3] = {x, 0.0, -y}, v[3] = {force[0], force[1], -force[2]};
  for (int i = 0; i < 3; i++) {
    int a = (i + 1) % 3, b = (i + 2) % 3;
    *row_channel(f, node, ambulo__channel_moment(&f->context.channels, i)) =
        p[a] * v[b] - p[b] * v[a];
    *row_channel(f, node, ambulo__channel_force(&f->context.channels, i)) = v[i];
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

/* half way the shares are 0.5: c_right = zmp + 0.5 D, c_left = zmp - 0.5 D */
static void centres_of_pressure_stay_under_their_feet(void **state) {
  (void)state;
  row_fixture f;
  open_with(&f, 0);
  const double force[3] = {30.0, 1.5 * mg, -20.0};
  press(&f, 1, 0.3, 0.01, force);
  double right[2] = {0.3 - 0.13, 0.01 - 0.1}, left[2] = {0.3 + 0.13, 0.01 + 0.1};
  expect(&f, "pressure", "right", "back", 0.25, 1.5 * (right[0] - (0.22 - 0.02)));
  expect(&f, "pressure", "right", "front", 0.25, 1.5 * (0.22 + 0.055 - right[0]));
  expect(&f, "pressure", "right", "right", 0.25, 1.5 * (right[1] + 0.1 + 0.035));
  expect(&f, "pressure", "right", "left", 0.25, 1.5 * (-0.1 + 0.035 - right[1]));
  expect(&f, "pressure", "left", "back", 0.25, 1.5 * (left[0] - (0.5 - 0.02)));
  /* the front end has moved on by a quarter of the roll, 0.04 m */
  expect(&f, "pressure", "left", "front", 0.25, 1.5 * (0.5 + 0.03 + 0.01 - left[0]));
  /* alone: the zero-moment point itself */
  press(&f, 3, 0.52, 0.09, force);
  expect(&f, "pressure", "left", "back", 0.75, 1.5 * (0.52 - 0.48));
  expect(&f, "pressure", "left", "left", 0.75, 1.5 * (0.1 + 0.035 - 0.09));
  row_fixture_close(&f);
}

/* at 0 s the left foot carries nothing yet: no rows */
static void unloaded_feet_have_no_rows(void **state) {
  (void)state;
  row_fixture f;
  open_with(&f, 0);
  for (int r = 0; r < f.table.row_count; r++) {
    const ambulo__table_row *row = &f.table.rows[r];
    if (row->time == 0.0) assert_string_not_equal(row->subject, "left");
  }
  row_fixture_close(&f);
}

static void friction_is_a_pyramid(void **state) {
  (void)state;
  row_fixture f;
  open_with(&f, 0);
  const double force[3] = {0.3 * mg, mg, -0.2 * mg};
  press(&f, 1, 0.3, 0.0, force);
  expect(&f, "friction", "total", "forward", 0.25, 0.5 - 0.3);
  expect(&f, "friction", "total", "backward", 0.25, 0.5 + 0.3);
  expect(&f, "friction", "total", "to the left", 0.25, 0.5 + 0.2);
  expect(&f, "friction", "total", "to the right", 0.25, 0.5 - 0.2);
  const double foot[3] = {-0.1 * mg, 0.4 * mg, -0.05 * mg};
  for (int i = 0; i < 3; i++)
    *row_channel(&f, 1, ambulo__channel_foot_force(&f.context.channels, WALKER_LEFT, i)) = foot[i];
  expect(&f, "friction", "left", "backward", 0.25, 0.2 - 0.1);
  expect(&f, "friction", "left", "to the left", 0.25, 0.2 - 0.05); /* left is -z */
  row_fixture_close(&f);
}

static void free_moments_add_up(void **state) {
  (void)state;
  row_fixture f;
  open_with(&f, 0);
  *row_channel(&f, 1, ambulo__channel_free_moment(&f.context.channels, WALKER_RIGHT)) = 0.004 * mg;
  *row_channel(&f, 1, ambulo__channel_free_moment(&f.context.channels, WALKER_LEFT)) = 0.003 * mg;
  expect(&f, "free_moment", "ground", "to the left", 0.25, 0.02 - 0.007);
  expect(&f, "free_moment", "ground", "to the right", 0.25, 0.02 + 0.007);
  row_fixture_close(&f);
}

static void planar_bodies_have_forward_rows_only(void **state) {
  (void)state;
  row_fixture f;
  open_with(&f, 1);
  for (int r = 0; r < f.table.row_count; r++) {
    assert_string_not_equal(f.table.rows[r].family, "free_moment");
    assert_string_not_equal(f.table.rows[r].detail, "to the left");
  }
  row_fixture_close(&f);
}

/* from heel to flat while the foot is loaded: the pressure is in both boxes; a foot that leaves
 * carries nothing and has none */
static void events_have_both_boxes(void **state) {
  (void)state;
  static const ambulo_contact three[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_TOE, 0.0, 0.5, .place = {0.0, -0.1}},
      {WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.0, 0.75, .place = {0.5, 0.1}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.75, 1.0, .place = {0.5, 0.1}}};
  row_fixture f;
  prepare(&f, 0);
  f.definition.contacts = three;
  f.definition.contact_count = 3;
  for (int k = 3; k < ROW_NODES; k++) f.active[2 * k + WALKER_LEFT] = 2;
  row_event(&f, 2, WALKER_RIGHT, 0);
  row_event(&f, 3, WALKER_LEFT, 1);
  ambulo__reaction_rows(&f.context, &f.table);
  assert_int_equal(row_count(&f, "pressure", "left", "back", 0.5), 1);
  assert_int_equal(row_count(&f, "pressure", "left", "back", 0.75), 2);
  assert_int_equal(row_count(&f, "pressure", "left", "back", 1.0), 1);
  assert_int_equal(row_count(&f, "pressure", "right", "back", 0.25), 1);
  assert_int_equal(row_count(&f, "pressure", "right", "back", 0.5), 0);
  assert_int_equal(row_count(&f, "friction", "total", "forward", 0.75), 1);
  const double force[3] = {0.0, mg, 0.0};
  press(&f, 3, 0.5, 0.1, force); /* at the heel */
  double nearest = INFINITY;
  for (int r = 0; r < f.table.row_count; r++) {
    const ambulo__table_row *row = &f.table.rows[r];
    if (!strcmp(row->family, "pressure") && !strcmp(row->detail, "front") && row->time == 0.75)
      nearest = fmin(nearest, row_value(&f, r));
  }
  assert_close(nearest, 0.03 + 0.04, 1e-12); /* the heel's box, rolled to its end */
  row_fixture_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(events_have_both_boxes),
                                     cmocka_unit_test(centres_of_pressure_stay_under_their_feet),
                                     cmocka_unit_test(unloaded_feet_have_no_rows),
                                     cmocka_unit_test(friction_is_a_pyramid),
                                     cmocka_unit_test(free_moments_add_up),
                                     cmocka_unit_test(planar_bodies_have_forward_rows_only)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
