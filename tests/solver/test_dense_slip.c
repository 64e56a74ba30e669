/* Slip of a body that is moved as a whole, by hand. The step lasts 0.55 s: the left foot, on its
 * toes at first, leaves at 0.62 * 1.1 - 0.55 = 0.132 s; the right one lands flat at 0.088 s and
 * goes on its toes at 0.418 s. */
#include "support/dense_fixture.h"

static const double toe_off = 0.62 * 1.1 - 0.55, foot_flat = 0.08 * 1.1, heel_off = 0.38 * 1.1;

static dense_largest largest_of(const dense_fixture *f, const char *subject, double after,
                                double before) {
  dense_largest largest = {.subject = subject, .after = after, .before = before};
  ambulo__dense_slip(&f->dense, dense_keep_largest, &largest);
  return largest;
}

/* at constant speed every place between two nodes is on the line; from the last node on nothing
 * holds the toe: speed times the time until toe-off, which is between two samples */
static void a_toe_that_leaves_slips_from_its_last_node_on(void **state) {
  (void)state;
  dense_fixture f;
  dense_open(&f, 20);
  dense_move(&f, 0, 0.0, 0.4, 0.0);
  dense_look(&f, 7);
  double last = 4 * 0.55 / 20;
  dense_largest toe = largest_of(&f, "left_toe", -1.0, 1.0);
  assert_close(toe.sample.value, 0.4 * (toe_off - last), 1e-9);
  assert_close(toe.sample.time, toe_off, 1e-12);
  assert_string_equal(toe.sample.family, "slip");
  assert_string_equal(toe.sample.unit, "m");
  assert_true(largest_of(&f, "left_toe", -1.0, last + 1e-9).sample.value < 1e-12);
  /* and the right toe before its first node: it is down from 0.088 s, the node comes at 0.11 s */
  dense_largest landing = largest_of(&f, "right_toe", -1.0, 0.2);
  assert_close(landing.sample.value, 0.4 * (4 * 0.55 / 20 - foot_flat), 1e-9);
  assert_close(landing.sample.time, foot_flat, 1e-12);
  /* the right heel is held until the last node before it leaves */
  dense_largest heel = largest_of(&f, "right_heel", -1.0, 1.0);
  assert_close(heel.sample.value, 0.4 * (heel_off - 15 * 0.55 / 20), 1e-9);
  dense_close(&f);
}

/* a contact that ends on a node is not held by it: the whole interval before is free */
static void toe_off_on_a_node_leaves_the_interval_before_free(void **state) {
  (void)state;
  dense_fixture f;
  dense_open(&f, 25);
  dense_move(&f, 0, 0.0, 0.4, 0.0);
  dense_look(&f, 10);
  assert_close(largest_of(&f, "left_toe", -1.0, 1.0).sample.value, 0.4 * 0.55 / 25, 1e-9);
  dense_close(&f);
}

/* on events the node at toe-off holds the toe, and the one at foot-flat the other foot's: a body
 * that glides on a straight line slips nowhere, one that is accelerated as between any two nodes */
static void on_events_no_interval_is_free(void **state) {
  (void)state;
  dense_fixture f;
  dense_open_on(&f, 20, AMBULO_GRID_EVENTS);
  dense_move(&f, 0, 0.0, 0.4, 0.0);
  dense_look(&f, 7);
  dense_largest all = largest_of(&f, NULL, -1.0, 1.0);
  assert_true(all.count > 50 && all.sample.value < 1e-12);
  dense_close(&f);
  dense_open_on(&f, 20, AMBULO_GRID_EVENTS);
  dense_move(&f, 0, 0.0, 0.0, 3.0);
  dense_look(&f, 10);
  double h = (toe_off - foot_flat) / 2.0; /* two intervals of the second phase */
  assert_close(f.problem->times[5], toe_off, 1e-12);
  assert_close(largest_of(&f, "left_toe", foot_flat, 1.0).sample.value, 6.0 * h * h / 8.0, 1e-9);
  dense_close(&f);
}

/* with an acceleration a the distance from the line is a h^2 / 8 half-way */
static void between_two_nodes_it_is_the_distance_from_the_line(void **state) {
  (void)state;
  dense_fixture f;
  dense_open(&f, 20);
  dense_move(&f, 0, 0.0, 0.0, 3.0);
  dense_look(&f, 10);
  double h = 0.55 / 20;
  assert_close(largest_of(&f, "left_toe", -1.0, 4 * h).sample.value, 6.0 * h * h / 8.0, 1e-9);
  dense_close(&f);
}

/* heights do not count, nor points in the air */
static void only_loaded_points_and_only_along_the_ground(void **state) {
  (void)state;
  dense_fixture f;
  dense_open(&f, 20);
  dense_move(&f, 1, 0.8, 1.0, 2.0);
  dense_look(&f, 10);
  assert_true(largest_of(&f, NULL, -1.0, 1.0).sample.value < 1e-12);
  assert_int_equal(largest_of(&f, "left_toe", toe_off + 1e-6, 0.54).count, 0);
  assert_int_equal(largest_of(&f, "left_heel", -1.0, 0.54).count, 0);
  dense_close(&f);
}

/* on its heel and on its toes a foot with arcs rolls: its corners move, and do not slip */
static void corners_that_roll_do_not_slip(void **state) {
  (void)state;
  for (int arcs = 0; arcs < 2; arcs++) {
    dense_fixture f;
    dense_open(&f, 20);
    for (int i = 0; i < 2; i++) {
      ambulo_foot *foot = &f.model->feet[i];
      foot->has_arcs = arcs;
      foot->arc[0] = foot->heel_center;
      foot->arc[1] = foot->toe_center;
    }
    dense_move(&f, 0, 0.0, 0.0, 3.0);
    dense_look(&f, 10);
    assert_int_equal(largest_of(&f, "right_heel", -1.0, foot_flat - 1e-6).count == 0, arcs);
    assert_int_equal(largest_of(&f, "left_toe", -1.0, toe_off).count == 0, arcs);
    assert_true(largest_of(&f, "right_heel", foot_flat + 0.06, heel_off - 0.03).count > 0);
    dense_close(&f);
  }
}

/* four intervals: the left toe has one node at 0, is down until 0.132 s, before the next one */
static void a_coarse_grid_still_has_a_place_to_start_from(void **state) {
  (void)state;
  dense_fixture f;
  dense_open(&f, 4);
  dense_move(&f, 0, 0.0, 0.4, 0.0);
  dense_look(&f, 10);
  assert_close(largest_of(&f, "left_toe", -1.0, 0.2).sample.value, 0.4 * toe_off, 1e-9);
  /* the right foot is on its toes from 0.418 s to the end, and has a node there only */
  assert_close(largest_of(&f, "right_heel", 0.2, 1.0).sample.value, 0.4 * (heel_off - 0.4125),
               1e-9);
  dense_close(&f);
}

/* Both feet flat; the left one comes 0.3 m further within its flight, on four intervals of 1 s. */
static void open_leap(dense_fixture *f, double down, double up) {
  memset(f, 0, sizeof *f);
  f->model = planar_walker_create();
  ambulo_contact contacts[] = {{0, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.0, 0.0}},
                               {1, AMBULO_CONTACT_FLAT, 0.0, 0.2, .place = {0.0, 0.0}},
                               {1, AMBULO_CONTACT_FLAT, down, up, .place = {0.3, 0.0}}};
  ambulo_problem_definition d = ambulo_problem_definition_default();
  d.model = f->model;
  d.duration = 1.0;
  d.intervals = 4;
  d.contacts = contacts;
  d.contact_count = 3;
  d.ground_penetration = d.foot_strike = 1;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &f->problem), AMBULO_OK);
  f->x = calloc((size_t)ambulo_problem_variable_count(f->problem), sizeof *f->x);
  dense_move(f, 0, 0.0, 0.4, 0.0);
  dense_look(f, 10);
}

/* from 0.3 s on the left foot stands where only the node at 0.5 s has it: the one at 0 s has it on
 * the foothold before, and a line between the two would hide the way between them */
static void another_foothold_does_not_hold(void **state) {
  (void)state;
  dense_fixture f;
  open_leap(&f, 0.3, 1.0);
  dense_largest toe = largest_of(&f, "left_toe", 0.25, 0.5);
  assert_close(toe.sample.value, 0.4 * (0.5 - 0.3), 1e-9);
  assert_close(toe.sample.time, 0.3, 1e-12);
  dense_close(&f);
}

/* down and up again between two nodes: nothing has the foot there, it moves from where it came */
static void a_landing_without_a_node_counts_from_where_it_came_down(void **state) {
  (void)state;
  dense_fixture f;
  open_leap(&f, 0.3, 0.45);
  dense_largest toe = largest_of(&f, "left_toe", 0.25, 0.5);
  assert_close(toe.sample.value, 0.4 * (0.45 - 0.3), 1e-9);
  assert_close(toe.sample.time, 0.45, 1e-12);
  dense_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_toe_that_leaves_slips_from_its_last_node_on),
      cmocka_unit_test(toe_off_on_a_node_leaves_the_interval_before_free),
      cmocka_unit_test(on_events_no_interval_is_free),
      cmocka_unit_test(between_two_nodes_it_is_the_distance_from_the_line),
      cmocka_unit_test(only_loaded_points_and_only_along_the_ground),
      cmocka_unit_test(corners_that_roll_do_not_slip),
      cmocka_unit_test(a_coarse_grid_still_has_a_place_to_start_from),
      cmocka_unit_test(another_foothold_does_not_hold),
      cmocka_unit_test(a_landing_without_a_node_counts_from_where_it_came_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
