/* Between which steps a foot in the air is: right foot down 0 .. 0.3 s and 0.8 .. 1 s. */
#include "ambulo/tools/load.h"
#include "contact/schedule.h"
#include "model/model.h"
#include "problem/nlp.h"
#include "solver/explain.h"
#include "support/test.h"
#include "support/walker_fixture.h"

static const ambulo_contact swings[] = {
    {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 0.2, .place = {0.0, -0.1, 0.0}, .normal = {0, 0, 0},
     .heading = 0.1},
    {WALKER_RIGHT, AMBULO_CONTACT_TOE, 0.2, 0.3, .place = {0.0, -0.1, 0.0}, .normal = {0, 0, 0},
     .heading = 0.1},
    {WALKER_RIGHT, AMBULO_CONTACT_HEEL, 0.8, 1.0, .place = {0.9, -0.1, 0.3},
     .normal = {-0.1, 0.2, 1.0}, .heading = 0.2},
    {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.2, 0.7, .place = {0.5, 0.1, 0.15}, .normal = {0, 0, 0},
     .heading = 0.0}};

static ambulo_problem_definition definition_of(ambulo_model *model, ambulo_ends ends) {
  ambulo_problem_definition d = ambulo_problem_definition_default();
  d.model = model;
  d.contacts = swings;
  d.contact_count = 4;
  d.ends = ends;
  d.travel = 1.0;
  d.rise = 0.3;
  return d;
}

static void a_swing_is_between_its_neighbours(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_problem_definition d = definition_of(model, AMBULO_ENDS_FREE);
  ambulo_contact from, to;
  static const double time[] = {0.3, 0.5, 0.8};
  for (int i = 0; i < 3; i++) { /* at its ends too */
    assert_int_equal(ambulo__swing_contacts(&d, WALKER_RIGHT, time[i], &from, &to), 1);
    assert_int_equal(from.mode, AMBULO_CONTACT_TOE);
    assert_int_equal(to.mode, AMBULO_CONTACT_HEEL);
    assert_close(to.place[2], 0.3, 0.0);
  }
  ambulo_model_free(model);
}

static void a_cut_motion_knows_one_side(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_problem_definition d = definition_of(model, AMBULO_ENDS_FREE);
  ambulo_contact from, to;
  assert_int_equal(ambulo__swing_contacts(&d, WALKER_LEFT, 0.1, &from, &to), 1);
  assert_close(from.from, 0.2, 0.0);
  assert_close(to.from, 0.2, 0.0);
  assert_int_equal(ambulo__swing_contacts(&d, WALKER_LEFT, 0.9, &from, &to), 1);
  assert_close(from.to, 0.7, 0.0);
  assert_close(to.to, 0.7, 0.0);
  d.contact_count = 3;
  assert_int_equal(ambulo__swing_contacts(&d, WALKER_LEFT, 0.9, &from, &to), 0);
  ambulo_model_free(model);
}

/* left, periodic: comes from the period before, lower by the rise, and goes to the next one */
static void a_repeating_motion_goes_on(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_problem_definition d = definition_of(model, AMBULO_ENDS_PERIODIC);
  ambulo_contact from, to;
  assert_int_equal(ambulo__swing_contacts(&d, WALKER_LEFT, 0.1, &from, &to), 1);
  assert_close(from.to, -0.3, 1e-12);
  assert_close(from.place[0], -0.5, 1e-12);
  assert_close(from.place[2], -0.15, 1e-12);
  assert_close(to.place[0], 0.5, 1e-12);
  /* mirrored: the right heel that is down up to -0.0 s of the period before is the left's */
  d.ends = AMBULO_ENDS_MIRRORED;
  assert_int_equal(ambulo__swing_contacts(&d, WALKER_LEFT, 0.1, &from, &to), 1);
  assert_int_equal(from.mode, AMBULO_CONTACT_HEEL);
  assert_close(from.to, 0.0, 1e-12);
  assert_close(from.place[0], -0.1, 1e-12);
  assert_close(from.place[1], 0.1, 1e-12);
  assert_close(from.place[2], 0.0, 1e-12);
  assert_close(from.normal[1], -0.2, 0.0);
  assert_close(from.heading, -0.2, 0.0);
  ambulo_model_free(model);
}

static void corners_stay_above_the_lower_of_both(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_problem_definition d = definition_of(model, AMBULO_ENDS_FREE);
  d.ground_height = 0.05;
  ambulo__contact_frame swing = ambulo__surface_below(&d, WALKER_RIGHT, 0.5);
  assert_close(swing.origin[1], 0.05, 1e-15); /* of the contact that it leaves */
  ambulo__contact_frame down = ambulo__surface_below(&d, WALKER_RIGHT, 0.9);
  assert_close(down.origin[1], 0.35, 1e-15);
  assert_true(down.up[0] < -0.05);
  d.ends = AMBULO_ENDS_PERIODIC; /* right after 1 s is where it was at 0 s, 0.3 m higher */
  ambulo__contact_frame left = ambulo__surface_below(&d, WALKER_LEFT, 0.9);
  assert_close(left.origin[1], 0.2, 1e-15);
  d.ends = AMBULO_ENDS_FREE;
  d.contact_count = 3;
  ambulo__contact_frame none = ambulo__surface_below(&d, WALKER_LEFT, 0.5);
  assert_close(none.origin[1], 0.05, 1e-15);
  assert_close(none.up[1], 1.0, 0.0);
  ambulo_model_free(model);
}

static int test_swing_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_swing_is_between_its_neighbours),
                                     cmocka_unit_test(a_cut_motion_knows_one_side),
                                     cmocka_unit_test(a_repeating_motion_goes_on),
                                     cmocka_unit_test(corners_stay_above_the_lower_of_both)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Edges of steps on the way of a foot: stairs of 0.17 m by 0.3 m, walker with feet of 0.22 m. */

static const double foot = 0.22, rise = 0.17, run = 0.3;

typedef struct fixture {
  ambulo_model *model;
  ambulo_contact contacts[3]; /* of the right foot, the left one, the right foot again */
  ambulo_problem_definition definition;
} fixture;

/* the right foot goes from 0 to `steps` steps ahead, the left one stands on `other` */
static void open_stairs(fixture *f, int steps, int other, int up) {
  f->model = walker_create(0);
  const ambulo_contact contacts[3] = {
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 0.1, .place = {0.0, -0.1, 0.0}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {other * run, 0.1, other * up * rise}},
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.6, 1.0,
       .place = {steps * run, -0.1, steps * up * rise}}};
  memcpy(f->contacts, contacts, sizeof contacts);
  f->definition = ambulo_problem_definition_default();
  f->definition.model = f->model;
  f->definition.contacts = f->contacts;
  f->definition.contact_count = 3;
}

static ambulo__step_edges edges_of(const fixture *f) {
  return ambulo__step_edges_between(&f->definition, WALKER_RIGHT, 0.3, &f->contacts[0],
                                    &f->contacts[2]);
}

/* above . r - height at x forward, z up */
static double over(const ambulo__step_edges *e, double x, double z) {
  return e->above[0] * x + e->above[1] * z - e->height;
}

static void the_plane_lies_on_both_edges(void **state) {
  (void)state;
  for (int up = 1; up >= -1; up -= 2) {
    fixture f;
    open_stairs(&f, 2, 1, up);
    ambulo__step_edges e = edges_of(&f);
    double first = 0.5 * (foot + run), second = first + run;
    assert_int_equal(e.count, 2);
    assert_close(e.ahead[0], 1.0, 1e-15);
    assert_close(e.riser, up > 0 ? first : second, 1e-12);
    assert_close(over(&e, first, up > 0 ? rise : 0.0), 0.0, 1e-12);
    assert_close(over(&e, second, up > 0 ? 2 * rise : -rise), 0.0, 1e-12);
    assert_close(hypot(e.above[0], e.above[1]), 1.0, 1e-15);
    ambulo_model_free(f.model);
  }
}

/* the other foot beside the one that leaves, beside the next foothold, or out of the way */
static void one_step_has_one_edge(void **state) {
  (void)state;
  static const int beside[] = {0, 1, 5, -3};
  for (int i = 0; i < 4; i++) {
    fixture f;
    open_stairs(&f, 1, beside[i], 1);
    ambulo__step_edges e = edges_of(&f);
    assert_int_equal(e.count, 1);
    assert_close(e.riser, 0.5 * (foot + run), 1e-12);
    assert_close(over(&e, e.riser, rise), 0.0, 1e-12);
    ambulo_model_free(f.model);
  }
}

/* the other foot a little ahead on the lower floor: its tip, not that of the foot that leaves */
static void the_edge_is_beside_the_nearest_feet(void **state) {
  (void)state;
  fixture f;
  open_stairs(&f, 1, 0, 1);
  f.contacts[1].place[0] = 0.05;
  assert_close(edges_of(&f).riser, 0.5 * (0.05 + foot + run), 1e-12);
  ambulo_model_free(f.model);
}

/* steps of unlike height: the plane is on one edge, and above the other */
static void the_plane_is_over_all_edges(void **state) {
  (void)state;
  for (int i = 0; i < 2; i++) {
    fixture f;
    open_stairs(&f, 2, 1, 1);
    f.contacts[1].place[2] += i ? 0.03 : -0.03;
    double first = 0.5 * (foot + run), second = first + run;
    ambulo__step_edges e = edges_of(&f);
    double one = over(&e, first, f.contacts[1].place[2]), other = over(&e, second, 2 * rise);
    assert_close(fmax(one, other), 0.0, 1e-12);
    assert_true(fmin(one, other) < -1e-3);
    ambulo_model_free(f.model);
  }
}

/* a foot on something higher than both footholds is no step of this way */
static void what_is_out_of_the_way_does_not_count(void **state) {
  (void)state;
  for (int i = 0; i < 2; i++) {
    fixture f;
    open_stairs(&f, 1, 0, i ? 1 : -1);
    f.contacts[1].place[0] = 0.15;
    f.contacts[1].place[2] = i ? 3 * rise : 2 * rise;
    assert_close(edges_of(&f).riser, 0.5 * (foot + run), 1e-12);
    ambulo_model_free(f.model);
  }
}

static void level_ramps_and_the_spot_have_none(void **state) {
  (void)state;
  for (int i = 0; i < 3; i++) {
    fixture f;
    open_stairs(&f, 2, 1, 1);
    if (i == 0) f.contacts[2].place[2] = 0.0;
    if (i == 1) f.contacts[2].normal[0] = -0.5;
    if (i == 1) f.contacts[2].normal[2] = 1.0;
    if (i == 2) f.contacts[2].place[0] = 0.02;
    assert_int_equal(edges_of(&f).count, 0);
    ambulo_model_free(f.model);
  }
}

/* down is the way up, backward */
static void edges_have_their_times(void **state) {
  (void)state;
  const ambulo__span air = {1.0, 3.0, -1, -1};
  fixture f;
  open_stairs(&f, 2, 1, 1);
  double first = ambulo__step_edge_time(air, &f.contacts[0], &f.contacts[2], 0);
  double last = ambulo__step_edge_time(air, &f.contacts[0], &f.contacts[2], 1);
  assert_true(1.0 < first && first < last && last < 3.0);
  assert_close(ambulo__step_edge_time(air, &f.contacts[2], &f.contacts[0], 0), 4.0 - last, 1e-12);
  assert_close(ambulo__step_edge_time(air, &f.contacts[2], &f.contacts[0], 1), 4.0 - first, 1e-12);
  ambulo_model_free(f.model);
}

static int test_step_edge_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_plane_lies_on_both_edges),
                                     cmocka_unit_test(one_step_has_one_edge),
                                     cmocka_unit_test(the_edge_is_beside_the_nearest_feet),
                                     cmocka_unit_test(the_plane_is_over_all_edges),
                                     cmocka_unit_test(what_is_out_of_the_way_does_not_count),
                                     cmocka_unit_test(level_ramps_and_the_spot_have_none),
                                     cmocka_unit_test(edges_have_their_times)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_swing_tests() + test_step_edge_tests();
}
