/* How long a foot stays down, and who is down beside it. */
#include "contact_load_fixture.h"

static void feet_are_slots_and_toes_behind_a_joint_too(void **state) {
  (void)state;
  ambulo_model *walker = walker_create(0), *toed = toed_body();
  ambulo_problem_definition of_walker = {.model = walker}, of_toed = {.model = toed};
  ambulo__slots two = ambulo__slots_of(&of_walker), four = ambulo__slots_of(&of_toed);
  assert_int_equal(two.count, 2);
  assert_int_equal(four.count, 4);
  for (int i = 0; i < 4; i++) {
    int foot = i % 2;
    const ambulo_foot *f = &toed->feet[foot];
    int point = i < 2 ? f->heel_center : f->toe_center;
    assert_int_equal(four.effector[i], foot);
    assert_int_equal(four.link[i], toed->points[point].link);
    assert_int_equal(four.part[i], i < 2 ? AMBULO__REAR_FOOT : AMBULO__FORE_FOOT);
    assert_string_equal(ambulo__slot_name(toed, &four, i), toed->points[point].name);
    if (i >= 2) continue;
    assert_int_equal(two.effector[i], i);
    assert_int_equal(two.part[i], AMBULO__WHOLE_FOOT);
    assert_string_equal(ambulo__slot_name(walker, &two, i), walker->feet[i].name);
  }
  ambulo_model_free(walker);
  ambulo_model_free(toed);
}

static void weights_rise_while_the_other_foot_is_there(void **state) {
  (void)state;
  test_contact_load_fixture f;
  test_contact_load_open_with(&f, walker_create(0), 2);
  static const double time[] = {0.0, 0.025, 0.05, 0.1, 0.3, 0.5, 0.525, 0.575};
  static const double share[] = {0.0, 0.25, 0.5, 1.0, 1.0, 1.0, 0.75, 0.25};
  for (int i = 0; i < 8; i++) {
    assert_close(load_at(&f, WALKER_LEFT, time[i]).weight, smooth(share[i]), 1e-12);
    /* the other foot's the other way round */
    double other = time[i] < 0.2 ? 1.0 - share[i] : time[i] < 0.5 ? 0.0 : 1.0 - share[i];
    assert_close(load_at(&f, WALKER_RIGHT, time[i]).weight, smooth(other), 1e-12);
  }
  ambulo__contact_load air = load_at(&f, WALKER_RIGHT, 0.3);
  assert_false(air.loaded);
  const ambulo_contact *left = &f.contacts[0];
  for (int i = 0; i < f.definition.contact_count; i++)
    if (f.contacts[i].foot == WALKER_LEFT && f.contacts[i].mode == AMBULO_CONTACT_TOE)
      left = &f.contacts[i];
  ambulo__contact_load last =
      ambulo__contact_load_at(&f.definition, f.outlines, &f.slots, WALKER_LEFT, left, left->to);
  assert_true(last.loaded);
  assert_close(last.weight, 0.0, 1e-12);
  assert_close(last.most, 0.0, 1e-9);
  close_it(&f);
}

/* 0.24 m from the heel's to the toes': flat 0.12, reached when nobody else is there any more */
static void the_centre_glides_from_heel_to_toes(void **state) {
  (void)state;
  test_contact_load_fixture f;
  test_contact_load_open_with(&f, walker_create(0), 2);
  /* flat from 0.1 to 0.4 s: neither the toe-off at 0.1 s nor the strike at 0.5 s is inside */
  static const double time[] = {0.05, 0.1, 0.175, 0.25, 0.325, 0.45};
  static const double roll[] = {0.0, 0.0, 0.25, 0.5, 0.75, 1.0};
  for (int i = 0; i < 6; i++) {
    ambulo__contact_load load = load_at(&f, WALKER_LEFT, time[i]);
    assert_close(load.center[0] - load.frame.origin[0], 0.24 * roll[i], 1e-12);
    assert_close(load.center[2], -0.09, 1e-12);
    assert_close(load.center[1], 0.0, 1e-12);
  }
  /* the other foot leaves at 0.16 s, and comes at 0.34 s: the foot stays put in between */
  for (int i = 0; i < f.definition.contact_count; i++) {
    ambulo_contact *c = &f.contacts[i];
    if (c->foot != WALKER_RIGHT) continue;
    if (fabs(c->to - 0.1) < 1e-9) c->to = 0.16;
    if (fabs(c->from - 0.5) < 1e-9 && c->to > c->from) c->from = 0.34;
  }
  assert_close(load_at(&f, WALKER_LEFT, 0.13).center[0], 0.12 * smooth(0.5), 1e-12);
  for (int i = 0; i <= 6; i++)
    assert_close(load_at(&f, WALKER_LEFT, 0.16 + 0.03 * i).center[0], 0.12, 1e-12);
  assert_close(load_at(&f, WALKER_LEFT, 0.37).center[0], 0.12 + 0.12 * smooth(0.5), 1e-12);
  close_it(&f);
}

/* The other foot leaves at 0.1 s and a bit, or comes a bit before 0.4 s: a sixteenth of the 0.3 s
 * between is the least. Within the bit the centre would jump, and the load with it */
static void no_glide_is_shorter_than_a_sixteenth(void **state) {
  (void)state;
  static const double bits[] = {1e-4, 1e-3, 0.018};
  for (int b = 0; b < 3; b++) {
    test_contact_load_fixture f;
    test_contact_load_open_with(&f, walker_create(0), 2);
    for (int i = 0; i < f.definition.contact_count; i++) {
      ambulo_contact *c = &f.contacts[i];
      if (c->foot != WALKER_RIGHT) continue;
      if (fabs(c->to - 0.1) < 1e-9) c->to = 0.1 + bits[b];
      if (fabs(c->from - 0.5) < 1e-9 && c->to > c->from) c->from = 0.4 - bits[b];
    }
    for (int i = 0; i <= 4; i++) {
      double part = 0.25 * i, glide = 0.3 / 16.0;
      assert_close(load_at(&f, WALKER_LEFT, 0.1 + part * glide).center[0], 0.12 * smooth(part),
                   1e-12);
      assert_close(load_at(&f, WALKER_LEFT, 0.4 - part * glide).center[0],
                   0.24 - 0.12 * smooth(part), 1e-12);
    }
    close_it(&f);
  }
}

/* down on the toes, then flat: from the toes back */
static void a_foot_may_come_down_on_its_toes(void **state) {
  (void)state;
  test_contact_load_fixture f;
  test_contact_load_open_with(&f, walker_create(0), 2);
  static const ambulo_contact contacts[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_TOE, 0.0, 0.2, .place = {0.0, -0.1}},
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.2, 0.6, .place = {0.0, -0.1}},
      {WALKER_RIGHT, AMBULO_CONTACT_HEEL, 0.6, 1.0, .place = {0.0, -0.1}}};
  f.definition.contacts = contacts;
  f.definition.contact_count = 3;
  f.definition.ends = AMBULO_ENDS_FREE;
  static const double time[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.9};
  static const double roll[] = {1.0, 1.0, 0.75, 0.5, 0.25, 0.0, 0.0};
  for (int i = 0; i < 7; i++) {
    ambulo__contact_load load = load_at(&f, WALKER_RIGHT, time[i]);
    assert_close(load.center[0], 0.24 * roll[i], 1e-12);
    assert_close(load.weight, 1.0, 0.0);
    assert_true(isinf(load.most));
  }
  close_it(&f);
}

/* boxes that a problem gives, m along the foot */
static void give_boxes(ambulo_ground_reaction *r) {
  static const double heel[2] = {-0.02, 0.03}, flat[2] = {-0.005, 0.02}, toe[2] = {-0.02, 0.055};
  for (int end = 0; end < 2; end++) {
    r->heel_pressure[end] = heel[end];
    r->flat_pressure[end] = flat[end];
    r->toe_pressure[end] = toe[end];
  }
  r->pressure_width = 0.035;
}

static void patches_are_about_the_centre(void **state) {
  (void)state;
  test_contact_load_fixture f;
  test_contact_load_open_with(&f, walker_create(0), 2);
  give_boxes(&f.definition.ground_reaction);
  ambulo__contact_load heel = load_at(&f, WALKER_LEFT, 0.05);
  ambulo__contact_load flat = load_at(&f, WALKER_LEFT, 0.25);
  ambulo__contact_load toe = load_at(&f, WALKER_LEFT, 0.45);
  assert_close(heel.box[0], -0.02, 1e-12);
  assert_close(heel.box[1], 0.03 + 0.04 * 0.5, 1e-12);
  assert_close(heel.rolled, 0.5, 1e-12);
  assert_close(flat.box[0], -0.005 - 0.12, 1e-12);
  assert_close(flat.box[1], 0.22 + 0.02 - 0.12, 1e-12);
  assert_close(toe.box[0], -0.02 - 0.02, 1e-12);
  assert_close(toe.box[1], 0.055 - 0.02, 1e-12);
  assert_close(toe.side, 0.035, 0.0);
  assert_close(flat.rolled + toe.rolled, 0.0, 0.0);
  for (int end = 0; end < 2; end++) assert_int_equal(heel.cut[end] + flat.cut[end], 0);
  close_it(&f);
}

/* from the heel's foothold: without boxes, flat from the heel's corners to 2 cm ahead of the ball,
 * no further than the tip; on an edge what is within .8 mm of it, and the toes */
static void contacts_press_where_the_sole_is(void **state) {
  (void)state;
  test_contact_load_fixture f;
  test_contact_load_open_with(&f, walker_create(0), 2);
  for (int longer = 0; longer < 2; longer++) {
    for (int i = 0; i < 2; i++) {
      f.outlines[i].back = -0.01;
      f.outlines[i].tip = longer ? 0.27 : 0.225;
      f.outlines[i].half_width = 0.03;
    }
    ambulo__contact_load heel = load_at(&f, WALKER_LEFT, 0.05);
    ambulo__contact_load flat = load_at(&f, WALKER_LEFT, 0.25);
    ambulo__contact_load toe = load_at(&f, WALKER_LEFT, 0.45);
    assert_close(heel.box[0], -0.01, 1e-12);
    assert_close(heel.box[1], 0.0006, 1e-12);
    assert_close(flat.box[0], -0.01 - 0.12, 1e-12);
    assert_close(flat.box[1], (longer ? 0.24 : 0.225) - 0.12, 1e-12);
    assert_close(toe.box[0], -0.0006 - 0.02, 1e-12);
    assert_close(toe.box[1], (longer ? 0.05 : 0.005) - 0.02, 1e-12);
    assert_close(flat.side, 0.03, 0.0);
  }
  close_it(&f);
}

/* of the model's points at q = 0 */
static void outlines_end_at_corners_and_tip(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  for (int i = 0; i < 2; i++) {
    ambulo__foot_outline o = ambulo__foot_outline_of(model, i);
    double back = 0.0, narrow = INFINITY;
    for (int c = 0; c < o.count; c++) {
      back = fmin(back, o.place[c][0]);
      narrow = fmin(narrow, fabs(o.place[c][1]));
    }
    assert_close(o.back, back, 0.0);
    assert_close(o.half_width, narrow, 0.0);
    assert_true(narrow > 0.01);
    assert_close(o.tip, fmax(o.length, ambulo__foot_reach(model, i)), 0.0);
  }
  ambulo_model_free(model);
}

/* rate 15 / s that sets in over 6.5 ms, from either end of the stance of 0.6 s */
static void the_load_comes_and_goes_at_a_rate(void **state) {
  (void)state;
  test_contact_load_fixture f;
  test_contact_load_open_with(&f, walker_create(0), 1);
  static const double time[] = {0.0, 0.004, 0.03, 0.2, 0.3, 0.45};
  for (int i = 0; i < 6; i++) {
    double s = fmin(time[i], 0.6 - time[i]), h = 1e-6;
    ambulo__contact_load load = load_at(&f, WALKER_LEFT, time[i]);
    assert_close(load.most, 15.0 * (s - 0.0065 * (1.0 - exp(-s / 0.0065))), 1e-12);
    assert_close(load.since, time[i], 1e-12);
    assert_close(load.until, 0.6 - time[i], 1e-12);
    /* all times h longer */
    double longer = s * (1.0 + h);
    double more = 15.0 * (longer - 0.0065 * (1.0 - exp(-longer / 0.0065)));
    assert_close(load.most_by_time, (more - load.most) / h, 1e-5);
  }
  f.definition.ground_reaction.loading_rate = AMBULO_OFF;
  assert_true(isinf(load_at(&f, WALKER_LEFT, 0.03).most));
  close_it(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(feet_are_slots_and_toes_behind_a_joint_too),
      cmocka_unit_test(weights_rise_while_the_other_foot_is_there),
      cmocka_unit_test(the_centre_glides_from_heel_to_toes),
      cmocka_unit_test(no_glide_is_shorter_than_a_sixteenth),
      cmocka_unit_test(a_foot_may_come_down_on_its_toes),
      cmocka_unit_test(patches_are_about_the_centre),
      cmocka_unit_test(contacts_press_where_the_sole_is),
      cmocka_unit_test(outlines_end_at_corners_and_tip),
      cmocka_unit_test(the_load_comes_and_goes_at_a_rate),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
