/* The term muscle_effort on a limb of seven coordinates: its value is the sharing's, its gradient
 * that of differences, and its forms bend as the cost does. */
#include "problem/muscle_effort.h"

#include "problem/callbacks.h"
#include "problem/nlp.h"
#include "support/random_muscles.h"

typedef struct walk {
  leg leg;
  ambulo_problem *problem;
  ambulo_workspace *workspace;
  double *x;
} walk;

static void walk_open(walk *w) {
  leg_open(&w->leg, 4);
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_term term = ambulo_term_default(AMBULO_MUSCLE_EFFORT);
  term.weight = 3.0;
  term.metabolic = 0.5;
  d.model = w->leg.model;
  d.muscles = w->leg.muscles;
  d.intervals = 37;
  d.spline_intervals = 6;
  d.terms = &term;
  d.term_count = 1;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &w->problem), AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(w->problem, NULL, &w->workspace), AMBULO_OK);
  random_source source = {11};
  w->x = calloc((size_t)w->problem->variables, sizeof *w->x);
  assert_non_null(w->x);
  for (int i = 0; i < w->problem->variables; i++) w->x[i] = random_between(&source, -0.3, 0.3);
  assert_int_equal(ambulo__evaluate(w->workspace, w->x), AMBULO_OK);
}

static void walk_close(walk *w) {
  free(w->x);
  ambulo_workspace_free(w->workspace);
  ambulo_problem_free(w->problem);
  leg_close(&w->leg);
}

static double channel(const walk *w, int node, int c) {
  return w->workspace->channel[ambulo__lane_index(node, w->workspace->channel_count, c)];
}

/* by the public sharing, node after node */
static void its_value_is_the_integral_of_the_least_cost(void **state) {
  (void)state;
  static walk w;
  walk_open(&w);
  const ambulo_problem *p = w.problem;
  const ambulo_term *term = &p->definition.terms[0];
  const int d = p->coordinates;
  double sum = 0.0, q[64], qd[64], tau[64], rate[64], cost;
  ambulo_sharing prices = ambulo_sharing_default();
  prices.activation = term->activation;
  prices.metabolic = term->metabolic;
  prices.reserve = term->reserve;
  ambulo_sharing_outputs out = ambulo_sharing_outputs_default();
  out.cost = &cost;
  for (int k = 0; k < p->nodes; k++) {
    int from = k, to = k;
    while (from > 0 && p->times[k] - p->times[from] < 0.01) from--;
    while (to + 1 < p->nodes && p->times[to] - p->times[k] < 0.01) to++;
    for (int c = 0; c < d; c++) {
      const int at = ambulo__channel_tau(&p->channels, c);
      q[c] = channel(&w, k, c);
      qd[c] = channel(&w, k, d + c);
      tau[c] = channel(&w, k, at);
      rate[c] = (channel(&w, to, at) - channel(&w, from, at)) / (p->times[to] - p->times[from]);
    }
    const ambulo_sharing_states states = {sizeof states, 1, q, qd, tau, rate};
    assert_int_equal(ambulo_muscles_share(p->definition.muscles, &prices, &states, NULL, &out),
                     AMBULO_OK);
    sum += p->quadrature[k] * cost;
  }
  assert_true(sum > 0.0);
  assert_close(w.workspace->term_value[0], term->weight * sum, 1e-12 * term->weight * sum);
  walk_close(&w);
}

static void its_gradient_is_that_of_differences(void **state) {
  (void)state;
  static walk w;
  walk_open(&w);
  const int n = w.problem->variables;
  double *gradient = calloc((size_t)n, sizeof *gradient), *moved = calloc((size_t)n, sizeof *moved);
  assert_non_null(gradient);
  assert_non_null(moved);
  assert_int_equal(ambulo__term_gradient(w.workspace, 0, gradient), AMBULO_OK);
  for (uint64_t seed = 1; seed <= 12; seed++) {
    random_source source = {seed};
    const double h = 1e-6;
    double want = 0.0, got = 0.0, size = 0.0;
    for (int side = 1; side >= -1; side -= 2) {
      random_source along = source;
      for (int i = 0; i < n; i++) {
        double step = random_between(&along, -1, 1);
        moved[i] = w.x[i] + side * h * step;
        if (side > 0) got += gradient[i] * step;
        if (side > 0) size += fabs(gradient[i] * step);
      }
      assert_int_equal(ambulo__evaluate(w.workspace, moved), AMBULO_OK);
      want += side * w.workspace->term_value[0] / (2.0 * h);
    }
    assert_close(got, want, 1e-6 * size);
  }
  free(gradient);
  free(moved);
  walk_close(&w);
}

/* along a torque the cost bends as the squares of its forms: g . g' by torques is dL/dtau, off the
 * kinks; a few nodes stand on one */
static void its_forms_bend_as_the_cost_does(void **state) {
  (void)state;
  static walk w;
  walk_open(&w);
  const ambulo_problem *p = w.problem;
  const ambulo_term *term = &p->definition.terms[0];
  const int d = p->coordinates, knee = 3;
  ambulo__term_context context = ambulo__term_context_of(w.workspace);
  ambulo_sharing prices = ambulo_sharing_default();
  prices.activation = term->activation;
  prices.metabolic = term->metabolic;
  prices.reserve = term->reserve;
  double q[64], qd[64], tau[64], by_tau[2][64];
  int agree = 0;
  for (int k = 0; k < p->nodes; k++) {
    const double h = 1e-4;
    double bend = 0.0;
    int forms = ambulo__term_forms(term, &context, k);
    assert_int_equal(forms, leg_d - 1);
    for (int j = 0; j < forms; j++) {
      ambulo__form form;
      ambulo__term_form(term, &context, k, j, &form);
      for (int c = 0; c < form.count; c++)
        if (form.channel[c] == ambulo__channel_tau(&p->channels, knee))
          bend += 2.0 * form.slope[c] * form.slope[c];
      assert_true(form.u == 0.0);
    }
    for (int side = 0; side < 2; side++) {
      ambulo_sharing_outputs out = ambulo_sharing_outputs_default();
      out.by_tau = by_tau[side];
      for (int c = 0; c < d; c++) {
        q[c] = channel(&w, k, c);
        qd[c] = channel(&w, k, d + c);
        tau[c] = channel(&w, k, ambulo__channel_tau(&p->channels, c));
      }
      tau[knee] += side ? h : -h;
      const ambulo_sharing_states states = {sizeof states, 1, q, qd, tau, NULL};
      assert_int_equal(ambulo_muscles_share(p->definition.muscles, &prices, &states, NULL, &out),
                       AMBULO_OK);
    }
    assert_true(bend > 0.0);
    agree += fabs((by_tau[1][knee] - by_tau[0][knee]) / (2.0 * h) - bend) <= 0.02 * bend;
  }
  assert_true(agree >= p->nodes * 3 / 4);
  walk_close(&w);
}

/* slope of a length at q = 0, by difference */
static double arm_at_zero(const ambulo_muscle *m, int index) {
  double length[2] = {0.0, 0.0};
  for (int side = 0; side < 2; side++)
    for (int t = 0; t < m->term_count; t++) {
      double term = m->length[t];
      for (int i = 0; i < m->coordinate_count; i++)
        term *= pow(i == index ? (side ? 1e-6 : -1e-6) : 0.0, m->exponents[t][i]);
      length[side] += term;
    }
  return (length[1] - length[0]) / 2e-6;
}

/* squared torques over what the muscles can give, each coordinate by itself */
static void a_coarse_grid_has_squared_torques(void **state) {
  (void)state;
  static walk w;
  walk_open(&w);
  ambulo_problem *coarse = NULL;
  assert_int_equal(ambulo__problem_coarser(w.problem, 18, 6, NULL, &coarse), AMBULO_OK);
  const ambulo_term *term = &coarse->definition.terms[0];
  const ambulo_muscles *m = w.leg.muscles;
  assert_int_equal(coarse->definition.intervals, 18);
  assert_int_equal(w.problem->definition.terms[0].kind, AMBULO_MUSCLE_EFFORT);
  assert_int_equal(term->kind, AMBULO_TORQUE_SQUARED);
  assert_true(term->weight == 3.0 && term->scale != NULL);
  double volume = 0.0;
  for (int i = 0; i < m->count; i++) volume += m->muscles[i].force * m->muscles[i].fiber;
  int seen = 0;
  for (int c = 0; c < coarse->coordinates; c++) {
    double leverage = 0.0;
    for (int i = 0; i < m->count; i++)
      for (int k = 0; k < m->muscles[i].coordinate_count; k++) {
        if (m->muscles[i].coordinates[k] != c) continue;
        double arm = arm_at_zero(&m->muscles[i], k);
        leverage += m->muscles[i].force * arm * arm / m->muscles[i].fiber;
      }
    double expected = leverage > 0.0 ? 1.5 / (0.5 * volume * leverage) : 0.0;
    assert_close(term->scale[c] * term->scale[c], expected, 1e-6 * expected);
    seen += leverage > 0.0;
  }
  assert_true(seen == leg_d - 1);
  ambulo_problem_free(coarse);
  walk_close(&w);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_coarse_grid_has_squared_torques),
      cmocka_unit_test(its_value_is_the_integral_of_the_least_cost),
      cmocka_unit_test(its_gradient_is_that_of_differences),
      cmocka_unit_test(its_forms_bend_as_the_cost_does),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
