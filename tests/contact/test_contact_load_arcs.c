/* Where the centre of pressure is under feet that roll on arcs, and on slopes. */
#include "contact_load_fixture.h"

/* at a strike, and half-way to toe-off, at the usual pitch; where the foot is flat under the arc's
 * centre */
static void the_centre_is_where_an_arc_touches(void **state) {
  (void)state;
  test_contact_load_fixture f;
  test_contact_load_open_with(&f, walker_create(0), 2);
  for (int i = 0; i < 2; i++) {
    ambulo__foot_outline *o = &f.outlines[i];
    o->has_arcs = 1;
    o->arc_ahead[0] = 0.01;
    o->arc_ahead[1] = 0.2;
    o->radius[0] = 0.02;
    o->radius[1] = 0.03;
  }
  static const struct {
    double time, ahead;
  } cases[] = {{1e-9, 0.01 - 0.02 * 0.35},
               {0.1 - 1e-9, 0.01},
               {0.4 + 1e-9, 0.2},
               {0.5, 0.2 + 0.03 * 0.9 / 4}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    ambulo__contact_load now = load_at(&f, WALKER_LEFT, cases[i].time);
    assert_close(now.center[0] - now.frame.origin[0], cases[i].ahead, 1e-8);
  }
  close_it(&f);
}

/* no jump of weight or centre as time goes on, and none of force: a slot that begins or ends has no
 * weight there; of feet with and without a joint of the toes */
static void nothing_jumps(void **state) {
  (void)state;
  for (int toed = 0; toed < 2; toed++) {
    test_contact_load_fixture f;
    test_contact_load_open_with(&f, toed ? toed_body() : walker_create(0), 2);
    const double step = 1e-5;
    for (int slot = 0; slot < f.slots.count; slot++) {
      ambulo__contact_load before = load_at(&f, slot, 0.0);
      double travelled = 0.0;
      for (int k = 1; k < 99999; k++) {
        ambulo__contact_load now = load_at(&f, slot, step * k);
        assert_true(fabs(now.weight - before.weight) < 50.0 * step);
        if (now.loaded && before.loaded) {
          double moved = fabs(now.center[0] - before.center[0]);
          /* a foothold further on belongs to another stance */
          if (fabs(now.frame.origin[0] - before.frame.origin[0]) < 1e-9) {
            assert_true(moved < 10.0 * step);
            travelled += moved;
          }
        }
        before = now;
      }
      if (!toed) assert_true(travelled > 0.2);
    }
    close_it(&f);
  }
}

/* the heel's part alone, both, the toes' part alone; each begins and ends without weight */
static void a_foot_with_a_joint_rolls_from_one_part_to_the_other(void **state) {
  (void)state;
  test_contact_load_fixture f;
  test_contact_load_open_with(&f, toed_body(), 2);
  double length = f.outlines[TOED_LEFT].length;
  static const double time[] = {0.08, 0.1, 0.175, 0.25, 0.325, 0.4, 0.45};
  static const double rear[] = {0, 1.0, 1.0, 1.0, 0.5, 0.0, 0.0};
  static const double fore[] = {0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0};
  for (int i = 1; i < 7; i++) {
    ambulo__contact_load heel = load_at(&f, TOED_LEFT, time[i]);
    ambulo__contact_load toes = load_at(&f, 2 + TOED_LEFT, time[i]);
    assert_close(heel.weight, rear[i], 1e-12);
    assert_close(toes.weight, fore[i], 1e-12);
    if (heel.loaded) {
      double roll = time[i] < 0.25 ? 0.5 * smooth((time[i] - 0.1) / 0.15) : 0.5;
      assert_close(heel.center[0] - heel.frame.origin[0], roll * length, 1e-12);
      assert_close(heel.box[1] + heel.center[0], heel.frame.origin[0] + length, 1e-12);
      assert_true(heel.cut[1] && !heel.cut[0]);
      assert_close(heel.since, time[i], 1e-12); /* down since the strike, up to heel-off */
      assert_close(heel.until, 0.4 - time[i], 1e-12);
    }
    assert_close(toes.center[0] - toes.frame.origin[0], length + 0.02, 1e-12);
    assert_close(toes.box[0], -0.02, 1e-12); /* from the ball on */
    assert_true(toes.cut[0] && !toes.cut[1]);
    assert_close(toes.since, time[i] - 0.1, 1e-12);
    assert_close(toes.until, 0.6 - time[i], 1e-12);
  }
  assert_false(load_at(&f, 2 + TOED_LEFT, 0.08).loaded);
  assert_false(load_at(&f, TOED_LEFT, 0.45).loaded);
  close_it(&f);
}

/* one mirrored step is told what the stride of two steps is told */
static void a_mirrored_step_is_told_the_same(void **state) {
  (void)state;
  test_contact_load_fixture one, two;
  test_contact_load_open_with(&one, walker_create(0), 1);
  test_contact_load_open_with(&two, walker_create(0), 2);
  for (int k = 0; k < 72; k++) {
    double t = 0.0069 * k;
    for (int foot = 0; foot < 2; foot++) {
      ambulo__contact_load a = load_at(&one, foot, t), b = load_at(&two, foot, t);
      assert_int_equal(a.loaded, b.loaded);
      assert_close(a.weight, b.weight, 1e-12);
      for (int i = 0; i < 3; i++) assert_close(a.center[i], b.center[i], 1e-12);
      for (int i = 0; i < 2; i++) assert_close(a.box[i], b.box[i], 1e-12);
      assert_close(a.most, b.most, 1e-10);
      /* and in the second half the other foot, mirrored */
      ambulo__contact_load c = load_at(&two, 1 - foot, t + 0.5);
      assert_close(a.weight, c.weight, 1e-12);
      if (!a.loaded) continue;
      assert_close(a.center[0] + 0.6, c.center[0], 1e-12);
      assert_close(a.center[2], -c.center[2], 1e-12);
      assert_close(a.most, c.most, 1e-10);
    }
  }
  close_it(&one);
  close_it(&two);
}

/* the centre is ahead along the surface, not along the world */
static void on_a_slope_the_centre_is_on_the_surface(void **state) {
  (void)state;
  test_contact_load_fixture f;
  test_contact_load_open_with(&f, walker_create(0), 2);
  for (int i = 0; i < f.definition.contact_count; i++) {
    f.contacts[i].place[2] = 0.3;
    f.contacts[i].normal[0] = -0.2;
    f.contacts[i].normal[2] = 1.0;
    f.contacts[i].heading = 0.4;
  }
  ambulo__contact_load load = load_at(&f, WALKER_LEFT, 0.25);
  for (int i = 0; i < 3; i++)
    assert_close(load.center[i], load.frame.origin[i] + 0.12 * load.frame.forward[i], 1e-12);
  assert_close(load.frame.origin[1], 0.3, 1e-12);
  assert_true(load.frame.forward[1] > 0.1);
  close_it(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_centre_is_where_an_arc_touches),
      cmocka_unit_test(nothing_jumps),
      cmocka_unit_test(a_foot_with_a_joint_rolls_from_one_part_to_the_other),
      cmocka_unit_test(a_mirrored_step_is_told_the_same),
      cmocka_unit_test(on_a_slope_the_centre_is_on_the_surface),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
