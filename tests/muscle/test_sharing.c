/* Sharing of torques among muscles: the least cost, its gradients, on every instruction set.
 */
#include "muscle/muscles.h"
#include "support/random_muscles.h"

enum { nodes = 24, legs = 8 };

typedef struct shared {
  double q[nodes * leg_d], qd[nodes * leg_d], tau[nodes * leg_d], rate[nodes * leg_d];
  double cost[nodes], a[nodes * leg_m], force[nodes * leg_m], length[nodes * leg_m],
      speed[nodes * leg_m], e[nodes * leg_d];
  double by_q[nodes * leg_d], by_qd[nodes * leg_d], by_tau[nodes * leg_d], by_rate[nodes * leg_d];
  int steps[nodes];
} shared;

static const ambulo_sharing pricings[] = {{sizeof(ambulo_sharing), 1.0, 0.0, 0.2, 1},
                                          {sizeof(ambulo_sharing), 0.3, 0.7, 0.2, 0},
                                          {sizeof(ambulo_sharing), 0.0, 1.0, 5.0, 1}};
enum { pricing_count = sizeof pricings / sizeof *pricings };

static void random_states(shared *s, random_source *source, double torque) {
  for (int i = 0; i < nodes * leg_d; i++) {
    s->q[i] = random_between(source, -0.6, 0.6);
    s->qd[i] = random_between(source, -6, 6);
    s->tau[i] = random_between(source, -torque, torque);
    s->rate[i] = random_between(source, -1000, 1000);
  }
}

static void share(const leg *l, const ambulo_sharing *prices, shared *s) {
  ambulo_sharing_outputs out = ambulo_sharing_outputs_default();
  out.cost = s->cost;
  out.activation = s->a;
  out.force = s->force;
  out.length = s->length;
  out.speed = s->speed;
  out.reserve = s->e;
  out.by_q = s->by_q;
  out.by_qd = s->by_qd;
  out.by_tau = s->by_tau;
  out.by_tau_rate = s->by_rate;
  out.steps = s->steps;
  const ambulo_sharing_states states = {sizeof states, nodes, s->q, s->qd, s->tau, s->rate};
  assert_int_equal(ambulo_muscles_share(l->muscles, prices, &states, NULL, &out), AMBULO_OK);
}

static void node_of(const leg *l, const shared *s, const ambulo_sharing *prices, int k,
                    leg_state *x, leg_solution *y) {
  double unit = 1e-3 * ambulo_model_mass(l->model) * 9.81 * 1.75;
  for (int c = 0; c < leg_d; c++) {
    x->q[c] = s->q[k * leg_d + c];
    x->qd[c] = s->qd[k * leg_d + c];
    x->tau[c] = s->tau[k * leg_d + c];
    x->tau_rate[c] = s->rate[k * leg_d + c];
    y->e[c] = s->e[k * leg_d + c];
    y->L[c] = 2.0 * prices->reserve / (unit * unit) * y->e[c];
  }
  for (int i = 0; i < leg_m; i++) y->a[i] = s->a[k * leg_m + i];
}

static double largest_reserve(const shared *s, int k) {
  double most = 0.0;
  for (int c = 0; c < leg_d; c++) most = fmax(most, fabs(s->e[k * leg_d + c]));
  return most;
}

/* what the muscles and the reserve supply is the torque, and the cost is that of the sharing */
static void torques_are_supplied_at_the_cost_told(void **state) {
  (void)state;
  static leg l;
  static shared s;
  random_source source = {5};
  for (uint64_t seed = 1; seed <= legs; seed++) {
    leg_open(&l, seed);
    for (int p = 0; p < pricing_count; p++) {
      random_states(&s, &source, p == 1 ? 300 : 60);
      share(&l, &pricings[p], &s);
      for (int k = 0; k < nodes; k++) {
        leg_state x;
        leg_solution y;
        node_of(&l, &s, &pricings[p], k, &x, &y);
        double complex force, primal = leg_lagrangian(&l, &x, &y, &pricings[p]);
        assert_close(creal(primal), s.cost[k], 1e-12 * (1.0 + fabs(s.cost[k])));
        for (int c = 0; c < leg_d - 1; c++) {
          double supplied = s.e[k * leg_d + c];
          for (int i = 0; i < leg_m; i++) {
            (void)leg_part(&l, i, &x, &y, &pricings[p], &force);
            if (leg_spans(&l.list[i], c)) supplied -= creal(leg_length(&l, i, x.q, c) * force);
          }
          /* rounding of z grows with what cannot be supplied */
          assert_close(supplied, s.tau[k * leg_d + c], 1e-9 + 3e-8 * largest_reserve(&s, k));
        }
        assert_true(s.e[k * leg_d + leg_d - 1] == 0.0);
      }
    }
    leg_close(&l);
  }
}

static void check_gradient(const leg *l, const shared *s, const ambulo_sharing *prices, int k) {
  leg_state x;
  leg_solution y;
  node_of(l, s, prices, k, &x, &y);
  double complex *const variables[] = {x.q, x.qd, x.tau, x.tau_rate};
  const double *const slopes[] = {s->by_q, s->by_qd, s->by_tau, s->by_rate};
  for (int v = 0; v < 4; v++) {
    double most = 1e-3;
    for (int c = 0; c < leg_d; c++) most = fmax(most, fabs(slopes[v][k * leg_d + c]));
    for (int c = 0; c < leg_d; c++) {
      variables[v][c] += 1e-30 * I;
      double want = cimag(leg_lagrangian(l, &x, &y, prices)) * 1e30;
      variables[v][c] = creal(variables[v][c]);
      double got = slopes[v][k * leg_d + c];
      if (!(fabs(got - want) <= 1e-11 * most)) print_error("%d %d: %g for %g\n", v, c, got, want);
      assert_close(got, want, 1e-11 * most);
    }
  }
}

/* the Lagrangian's complex step, and differences of the cost itself */
static void gradients_are_exact(void **state) {
  (void)state;
  static leg l;
  static shared s, moved;
  random_source source = {6};
  for (uint64_t seed = 1; seed <= legs; seed++) {
    leg_open(&l, seed);
    for (int p = 0; p < pricing_count; p++) {
      random_states(&s, &source, 100);
      share(&l, &pricings[p], &s);
      for (int k = 0; k < nodes; k++) check_gradient(&l, &s, &pricings[p], k);
      const double h = 1e-6;
      double up[nodes];
      moved = s;
      random_source along = {seed};
      double step[4 * leg_d];
      for (int i = 0; i < 4 * leg_d; i++) step[i] = random_between(&along, -1, 1);
      for (int sign = 1; sign >= -1; sign -= 2) {
        for (int i = 0; i < nodes * leg_d; i++) {
          moved.q[i] = s.q[i] + sign * h * step[i % leg_d];
          moved.qd[i] = s.qd[i] + sign * h * step[leg_d + i % leg_d];
          moved.tau[i] = s.tau[i] + sign * h * step[2 * leg_d + i % leg_d];
          moved.rate[i] = s.rate[i] + sign * h * step[3 * leg_d + i % leg_d];
        }
        share(&l, &pricings[p], &moved);
        if (sign > 0) memcpy(up, moved.cost, sizeof up);
      }
      for (int k = 0; k < nodes; k++) {
        double want = 0.0;
        for (int c = 0; c < leg_d; c++)
          want += s.by_q[k * leg_d + c] * step[c] + s.by_qd[k * leg_d + c] * step[leg_d + c] +
                  s.by_tau[k * leg_d + c] * step[2 * leg_d + c] +
                  s.by_rate[k * leg_d + c] * step[3 * leg_d + c];
        assert_close((up[k] - moved.cost[k]) / (2.0 * h), want, 2e-5 * (1.0 + fabs(want)));
      }
    }
    leg_close(&l);
  }
}

/* nobody's activation can fall or rise for less: 0 < a < 1 only where the price of a is paid */
static void no_other_sharing_is_cheaper(void **state) {
  (void)state;
  static leg l;
  static shared s;
  random_source source = {7};
  leg_open(&l, 3);
  for (int p = 0; p < pricing_count; p++) {
    random_states(&s, &source, 150);
    share(&l, &pricings[p], &s);
    for (int k = 0; k < nodes; k++) {
      leg_state x;
      leg_solution y;
      node_of(&l, &s, &pricings[p], k, &x, &y);
      for (int i = 0; i < leg_m; i++) {
        double a = y.a[i], h = 1e-3, values[2];
        assert_true(a >= 0.0 && a <= 1.0);
        for (int side = 0; side < 2; side++) {
          y.a[i] = a + (side ? h : -h);
          values[side] = creal(leg_lagrangian(&l, &x, &y, &pricings[p]));
        }
        y.a[i] = a;
        double slope = (values[1] - values[0]) / (2.0 * h); /* exact: a parabola */
        double size = fabs(values[1]) + fabs(values[0]) + 1.0;
        if (a > 0.0) assert_true(slope <= 1e-9 * size);
        if (a < 1.0) assert_true(slope >= -1e-9 * size);
      }
    }
  }
  leg_close(&l);
}

/* bit by bit, in every set and whatever the other lanes hold; in at most 25 steps */
static void every_set_gives_the_same_bits(void **state) {
  (void)state;
  static const char *const sets[] = {"scalar", "baseline", "avx2", "avx512"};
  static leg l;
  static shared first, s;
  random_source source = {8};
  for (uint64_t seed = 1; seed <= legs; seed++) {
    leg_open(&l, seed);
    for (int p = 0; p < pricing_count; p++) {
      random_states(&first, &source, 500);
      s = first;
      for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        assert_int_equal(setenv("AMBULO_ISA", sets[i], 1), 0);
        share(&l, &pricings[p], i ? &s : &first);
        for (int k = 0; k < nodes; k++) assert_true((i ? &s : &first)->steps[k] <= 25);
        if (i) assert_memory_equal(&s, &first, sizeof s);
      }
      unsetenv("AMBULO_ISA");
    }
    leg_close(&l);
  }
}

/* one muscle at one joint has no choice */
static void one_muscle_bears_what_it_can(void **state) {
  (void)state;
  static leg l;
  leg_model(&l);
  ambulo_muscle m = ambulo_muscle_default();
  static const unsigned char exponents[2][AMBULO_MUSCLE_COORDINATES] = {{0}, {1}};
  static const double length[2] = {0.3, -0.05}; /* a moment arm of 5 cm */
  m.name = "alone";
  m.force = 2000.0;
  m.fiber = 0.1;
  m.tendon = 0.2;
  m.coordinate_count = 1;
  m.coordinates[0] = 2;
  m.term_count = 2;
  m.exponents = exponents;
  m.length = length;
  ambulo_muscles_definition d = ambulo_muscles_definition_default();
  d.muscles = &m;
  d.muscle_count = 1;
  assert_int_equal(ambulo_muscles_create(l.model, &d, NULL, NULL, &l.muscles), AMBULO_OK);
  double q[leg_d] = {0.0}, qd[leg_d] = {0.0}, tau[leg_d] = {0.0}, a, force, e[leg_d], n;
  ambulo_sharing prices = ambulo_sharing_default();
  prices.reserve = 1e6;
  ambulo_sharing_outputs out = ambulo_sharing_outputs_default();
  out.activation = &a;
  out.force = &force;
  out.reserve = e;
  out.length = &n;
  for (tau[2] = -20.0; tau[2] <= 150.0; tau[2] += 10.0) {
    const ambulo_sharing_states states = {sizeof states, 1, q, qd, tau, NULL};
    assert_int_equal(ambulo_muscles_share(l.muscles, &prices, &states, NULL, &out), AMBULO_OK);
    assert_close(0.05 * force + e[2], tau[2], 1e-9);
    if (tau[2] > 5.0 && tau[2] < 95.0) assert_true(a > 0.0 && a < 1.0 && fabs(e[2]) < 1e-3);
    if (tau[2] < 0.0) assert_true(a == 0.0);
    if (tau[2] > 105.0) assert_true(a == 1.0 && fabs(force - 2000.0) < 80.0);
    assert_close(n, 1.0, 0.06); /* the smooth floor of its length */
  }
  leg_close(&l);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(torques_are_supplied_at_the_cost_told),
      cmocka_unit_test(gradients_are_exact),
      cmocka_unit_test(no_other_sharing_is_cheaper),
      cmocka_unit_test(every_set_gives_the_same_bits),
      cmocka_unit_test(one_muscle_bears_what_it_can),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
