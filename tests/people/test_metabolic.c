/* Metabolic power of a muscle: closed forms, the published equations term by term, the curves of
 * the sharing. */
#include "muscle/muscles.h"
#include "people/metabolic.h"
#include "support/muscle_definition.h"
#include "support/random_model.h"

static ambulo_muscle muscle_of(double fast) {
  ambulo_muscle m = ambulo_muscle_default();
  m.name = "m";
  m.force = 3000.0;
  m.fiber = 0.08;
  m.fast_fibers = fast;
  return m;
}

/* kg: density 1059.7 kg/m^3, stress 0.6 MPa */
static const double mass = 3000.0 * 0.08 * 1059.7 / 0.6e6;

/* as its force is in an analysis */
static ambulo__fiber_state state_of(const ambulo_muscle *m, double a, double n, double v) {
  ambulo__fiber_state s = {a, n, v, 0.0};
  s.force = a * m->force * ambulo__force_by_length(n) * ambulo__force_by_speed(v);
  return s;
}

/* ------------------------------------------------------------------ closed forms */

static void at_rest_a_kilogram_takes_a_watt(void **state) {
  (void)state;
  for (double fast = 0.0; fast <= 1.0; fast += 0.25)
    for (double n = 0.6; n < 1.5; n += 0.2)
      for (double v = -8.0; v <= 8.0; v += 4.0) {
        const ambulo_muscle m = muscle_of(fast);
        const ambulo__fiber_state s = state_of(&m, 0.0, n, v);
        const ambulo__metabolic b = ambulo__bhargava(&m, &s), u = ambulo__umberger(&m, &s);
        assert_close(b.heat, mass, 1e-14);
        assert_close(u.heat, mass, 1e-14);
        assert_true(b.work == 0.0 && u.work == 0.0);
        assert_true(b.power == b.heat && u.power == u.heat);
      }
}

/* a = 1 at the optimal length, no motion: rates of the papers, per kilogram of slow and of fast */
static void held_at_full_activation(void **state) {
  (void)state;
  const double peak = ambulo__force_by_length(1.0);
  assert_close(peak, 1.0, 0.01);
  for (double fast = 0.0; fast <= 1.0; fast += 0.25) {
    const ambulo_muscle m = muscle_of(fast);
    const ambulo__fiber_state s = state_of(&m, 1.0, 1.0, 0.0);
    const double slow_rate = 40.0 + 74.0 * peak, fast_rate = 133.0 + 111.0 * peak;
    assert_close(ambulo__bhargava(&m, &s).power,
                 mass * ((1.0 - fast) * slow_rate + fast * fast_rate), 1e-14);
    assert_close(ambulo__umberger(&m, &s).power, mass * 1.5 * (25.0 + 128.0 * fast), 1e-14);
  }
}

/* a = 1/2: sin(pi/4) of slow fibres, 1 - cos(pi/4) of fast ones */
static void held_at_half_activation(void **state) {
  (void)state;
  const ambulo_muscle slow = muscle_of(0.0), fast = muscle_of(1.0);
  const double root = sqrt(0.5), peak = ambulo__force_by_length(1.2);
  ambulo__fiber_state s = state_of(&slow, 0.5, 1.2, 0.0);
  assert_close(ambulo__bhargava(&slow, &s).heat, mass * (40.0 + 74.0 * peak) * root, 1e-14);
  assert_close(ambulo__bhargava(&fast, &s).heat, mass * (133.0 + 111.0 * peak) * (1.0 - root),
               1e-14);
  /* beyond the optimal length, less is kept up */
  assert_close(ambulo__umberger(&slow, &s).heat,
               mass * 1.5 * 25.0 * pow(0.5, 0.6) * (0.4 + 0.6 * peak), 1e-14);
  s.length = 0.8;
  assert_close(ambulo__umberger(&slow, &s).heat, mass * 1.5 * 25.0 * pow(0.5, 0.6), 1e-14);
}

/* what motion adds, per unit of activation */
static void shortening_and_lengthening(void **state) {
  (void)state;
  const ambulo_muscle slow = muscle_of(0.0), fast = muscle_of(1.0);
  const double still = mass * (40.0 + 74.0 * ambulo__force_by_length(1.0));
  for (double v = -9.0; v <= 3.0; v += 1.5) {
    const ambulo__fiber_state s = state_of(&slow, 1.0, 1.0, v);
    const double along = 0.08 * v, force = s.force;
    const ambulo__metabolic b = ambulo__bhargava(&slow, &s);
    assert_close(b.work, -force * along, 1e-13);
    double heat = v <= 0.0 ? -(0.16 * 3000.0 * ambulo__force_by_length(1.0) + 0.18 * force) * along
                           : -0.157 * force * along;
    assert_close(b.heat, fmax(mass, still + heat), 1e-13);
    const ambulo__metabolic u = ambulo__umberger(&slow, &s), f = ambulo__umberger(&fast, &s);
    /* slow fibres: V = 4.8 l_o/s, up to 100 W/kg; fast ones: 153 W/kg at 12 l_o/s, no limit */
    if (v < 0.0) {
      assert_close(u.heat, mass * 1.5 * (25.0 + fmin(100.0, 100.0 / 4.8 * -v)), 1e-13);
      assert_close(f.heat, mass * 1.5 * (153.0 + 153.0 / 12.0 * -v), 1e-13);
    } else {
      assert_close(u.heat, mass * 1.5 * (25.0 + 4.0 * 100.0 / 4.8 * v), 1e-13);
      assert_true(f.work == u.work);
    }
  }
  /* the limit was reached */
  const ambulo__fiber_state s = state_of(&slow, 1.0, 1.0, -9.0);
  assert_close(ambulo__umberger(&slow, &s).heat, mass * 1.5 * 125.0, 1e-13);
}

/* ------------------------------------------------------- the published equations */

/* Bhargava et al. 2004, Eqs. 1-9, rate by rate */
static double published_bhargava(double a, double f, double n, double v, double force) {
  const double pi = acos(-1.0), lo = 0.08;
  double excited[2] = {sin(0.5 * pi * a), 1.0 - cos(0.5 * pi * a)}, share[2] = {1.0 - f, f};
  const double activation[2] = {40.0, 133.0}, maintenance[2] = {74.0, 111.0};
  double rate = 0.0;
  for (int type = 0; type < 2; type++) {
    rate += mass * share[type] * activation[type] * excited[type];
    rate += mass * share[type] * maintenance[type] * excited[type] * ambulo__force_by_length(n);
  }
  double isometric = 3000.0 * ambulo__force_by_length(n) * a;
  if (v > 0.0)
    rate -= 0.157 * force * v * lo;
  else
    rate -= (0.16 * isometric + 0.18 * force) * v * lo;
  if (rate < mass) rate = mass;
  double power = rate - force * v * lo;
  return power > 0.0 ? power : 0.0;
}

/* Umberger et al. 2003, Eqs. 5-15, in W/kg; %FT in percent */
static double published_umberger(double a, double f, double n, double v, double force) {
  const double percent = 100.0 * f, fast = 12.0, slow = fast / 2.5;
  double alpha_slow = 4.0 * 25.0 / slow, alpha_fast = 1.0 * 153.0 / fast;
  double activation = 1.28 * percent + 25.0, motion;
  if (v <= 0.0) {
    double of_slow = -alpha_slow * v;
    if (of_slow > 100.0) of_slow = 100.0; /* no more than at V of slow fibres */
    motion = (of_slow * (1.0 - percent / 100.0) - alpha_fast * v * percent / 100.0) * a * a;
  } else {
    motion = 4.0 * alpha_slow * v * a;
  }
  double kept = activation * pow(a, 0.6) * 1.5, moved = motion * 1.5;
  if (n > 1.0) {
    kept = kept * 0.4 + kept * 0.6 * ambulo__force_by_length(n);
    moved *= ambulo__force_by_length(n);
  }
  double heat = kept + moved;
  if (heat < 1.0) heat = 1.0;
  double power = heat * mass - force * v * 0.08;
  return power > 0.0 ? power : 0.0;
}

static void published_equations(void **state) {
  (void)state;
  random_source source = {9};
  int none = 0;
  for (int i = 0; i < 5000; i++) {
    double a = random_unit(&source), f = random_unit(&source);
    double n = random_between(&source, 0.4, 1.6), v = random_between(&source, -10.0, 10.0);
    const ambulo_muscle m = muscle_of(f);
    const ambulo__fiber_state s = state_of(&m, a, n, v);
    const ambulo__metabolic b = ambulo__bhargava(&m, &s), u = ambulo__umberger(&m, &s);
    assert_close(b.power, published_bhargava(a, f, n, v, s.force), 1e-12);
    assert_close(u.power, published_umberger(a, f, n, v, s.force), 1e-12);
    assert_true(b.power >= 0.0 && u.power >= 0.0);
    assert_true(b.heat >= mass && u.heat >= mass);
    assert_true(b.power >= b.heat + b.work && u.power >= u.heat + u.work);
    none += b.power == 0.0;
  }
  assert_true(none > 100); /* lengthening muscles take up more than heat: there, power is 0 */
}

/* ------------------------------------------------------------------- the curves */

/* f_l and f_v are those of ambulo_muscles_share: a muscle without pennation, whose length and speed
 * come back with its force */
static void curves_are_those_of_the_sharing(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  s.definition.muscles = &s.muscles[2];
  s.definition.muscle_count = 1;
  ambulo_muscles *muscles = straps_good(&s);
  double q[strap_d] = {0.0}, qd[strap_d] = {0.0}, tau[strap_d] = {0.0}, a, force, n, v;
  ambulo_sharing_outputs out = ambulo_sharing_outputs_default();
  out.activation = &a;
  out.force = &force;
  out.length = &n;
  out.speed = &v;
  tau[4] = 100.0;
  for (q[4] = -0.8; q[4] <= 0.8; q[4] += 0.1)
    for (qd[4] = -18.0; qd[4] <= 18.0; qd[4] += 3.0) {
      const ambulo_sharing_states states = {sizeof states, 1, q, qd, tau, NULL};
      assert_int_equal(ambulo_muscles_share(muscles, NULL, &states, NULL, &out), AMBULO_OK);
      double passive = 3000.0 * exp(4.0 * ((n - 1.0) / 0.6 - 1.0));
      double active = a * 3000.0 * ambulo__force_by_length(n) * ambulo__force_by_speed(v);
      assert_close(force, active + passive, 1e-12);
      assert_true(a > 0.05);
      assert_close(v, -0.5 * qd[4], 0.05); /* 0.05 m arm over 0.1 m of fibre */
    }
  ambulo_muscles_free(muscles);
  straps_close(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(at_rest_a_kilogram_takes_a_watt),
      cmocka_unit_test(held_at_full_activation),
      cmocka_unit_test(held_at_half_activation),
      cmocka_unit_test(shortening_and_lengthening),
      cmocka_unit_test(published_equations),
      cmocka_unit_test(curves_are_those_of_the_sharing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
