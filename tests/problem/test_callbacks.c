/* Terms of the caller: squares have the curvature of Gauss and Newton, others that of probes, at
 * any scale; what is bent down or not finite has none. */
#include "problem/callbacks.h"
#include "support/problem_fixture.h"

typedef struct bent {
  double scale; /* of the function */
  int kind;     /* see below */
} bent;

enum { SEPARATE, COUPLED, CONCAVE, LOST, LINEAR, SPOILT };

/* a function of tau, q and the hand's height with known second derivatives */
static double function(void *user, const ambulo_node_state *s, ambulo_node_gradient *g) {
  const bent *b = user;
  double f = b->scale, x = s->tau[0], y = s->tau[1], q = s->q[1], h = s->points[1];
  if (b->kind == LOST) return NAN;
  if (b->kind == SPOILT) {
    if (g) g->tau[0] = NAN;
    return 0.0;
  }
  if (b->kind == LINEAR) {
    if (g) g->tau[0] += 2.0 * f;
    return f * (2.0 * x + 1.0);
  }
  if (b->kind == COUPLED) {
    if (g) {
      g->tau[0] += f * (4.0 * x - 2.0 * y);
      g->tau[1] += f * (4.0 * y - 2.0 * x);
    }
    return f * (2.0 * x * x + 2.0 * y * y - 2.0 * x * y);
  }
  double sign = b->kind == CONCAVE ? -1.0 : 1.0;
  if (g) {
    g->tau[0] += sign * 6.0 * f * x;
    g->q[1] += sign * 4.0 * f * q * q * q;
    g->points[1] += sign * f * 10.0 * (h - 0.2);
  }
  return sign * f * (3.0 * x * x + q * q * q * q + 5.0 * (h - 0.2) * (h - 0.2));
}

typedef struct probed {
  fixture f;
  bent bent;
  ambulo_term term;
  double *scratch, *curvature;
  int count;
} probed;

static void open_probed(probed *p, ambulo_term_kind kind, int shape, double scale) {
  memset(p, 0, sizeof *p);
  p->f.model = arm_create();
  p->bent = (bent){scale, shape};
  p->term = ambulo_term_default(kind);
  p->term.function = function;
  p->term.user = &p->bent;
  ambulo_problem_definition definition = arm_definition(p->f.model);
  fixture_open(&p->f, &definition);
  assert_int_equal(ambulo__evaluate(p->f.workspace, p->f.x), AMBULO_OK);
  size_t all = (size_t)p->f.workspace->channel_count;
  p->scratch = calloc(4 * all, sizeof(double));
  p->curvature = calloc(all, sizeof(double));
}

static void close_probed(probed *p) {
  free(p->scratch);
  free(p->curvature);
  fixture_close(&p->f);
}

static void probe(probed *p, int node) {
  ambulo__user_term_curvature(p->f.workspace, &p->term, node, p->scratch, p->curvature, &p->count);
}

static double channel(const probed *p, int node, int c) {
  return p->f.workspace->channel[ambulo__lane_index(node, p->f.workspace->channel_count, c)];
}

/* second derivatives 6 f, 12 f q^2, 10 f, and nothing else */
static void sums_over_channels_are_exact(void **state) {
  (void)state;
  static const double scales[] = {1e-8, 1.0, 1e8};
  for (int i = 0; i < 3; i++) {
    probed p;
    open_probed(&p, AMBULO_USER_TERM, SEPARATE, scales[i]);
    const ambulo__channels *channels = &p.f.problem->channels;
    int tau = ambulo__channel_tau(channels, 0), q = ambulo__channel_q(channels, 1);
    int height = ambulo__channel_point(channels, 0, 1);
    for (int node = 0; node <= 10; node++) {
      double angle = channel(&p, node, q);
      probe(&p, node);
      assert_int_equal(p.count, p.f.workspace->channel_count);
      for (int c = 0; c < p.count; c++) {
        double want = c == tau ? 6.0 : c == q ? 12.0 * angle * angle : c == height ? 10.0 : 0.0;
        /* steps of 5e-5 to one side of a fourth power */
        assert_close(p.curvature[c] / scales[i], want, 1e-3);
      }
    }
    close_probed(&p);
  }
}

/* of 2 x^2 + 2 y^2 - 2 x y the cross terms are +-2 beside a diagonal of 4: gone on average */
static void cross_terms_cancel(void **state) {
  (void)state;
  probed p;
  open_probed(&p, AMBULO_USER_TERM, COUPLED, 1.0);
  double sum[2] = {0.0, 0.0};
  for (int node = 0; node <= 10; node++) {
    probe(&p, node);
    for (int i = 0; i < 2; i++) {
      double value = p.curvature[ambulo__channel_tau(&p.f.problem->channels, i)];
      assert_true(value >= 2.0 - 1e-6 && value <= 6.0 + 1e-6);
      sum[i] += value / 11.0;
    }
  }
  assert_close(sum[0], 4.0, 0.3);
  assert_close(sum[1], 4.0, 0.3);
  close_probed(&p);
}

static void no_curvature_is_none(void **state) {
  (void)state;
  static const int shapes[] = {CONCAVE, LOST, LINEAR, SPOILT};
  for (int i = 0; i < 4; i++) {
    probed p;
    open_probed(&p, AMBULO_USER_TERM, shapes[i], 1e6);
    for (int node = 0; node <= 10; node++) {
      probe(&p, node);
      for (int c = 0; c < p.count; c++) {
        /* a linear function: rounding alone, far below one part in a million of its slope */
        double most = shapes[i] == LINEAR ? 1.0 : 0.0;
        assert_true(p.curvature[c] >= 0.0 && p.curvature[c] <= most);
      }
    }
    close_probed(&p);
  }
}

/* a square: value r^2, slope 2 r dr, curvature 2 dr dr' as one form */
static void squares(void **state) {
  (void)state;
  probed r, square;
  open_probed(&r, AMBULO_USER_TERM, SEPARATE, 0.7);
  open_probed(&square, AMBULO_USER_SQUARE, SEPARATE, 0.7);
  int all = r.f.workspace->channel_count;
  double *slope = calloc((size_t)all, sizeof *slope), *want = calloc((size_t)all, sizeof *want);
  for (int node = 0; node <= 10; node++) {
    double value = ambulo__user_term_value(r.f.workspace, &r.term, node);
    assert_close(ambulo__user_term_value(square.f.workspace, &square.term, node), value * value,
                 1e-14);
    ambulo__user_term_slope(r.f.workspace, &r.term, node, want);
    ambulo__user_term_slope(square.f.workspace, &square.term, node, slope);
    probe(&square, node);
    assert_int_equal(square.count, -1);
    for (int c = 0; c < all; c++) {
      assert_close(slope[c], 2.0 * value * want[c], 1e-13);
      assert_close(square.curvature[c], sqrt(2.0) * want[c], 1e-14);
    }
  }
  free(slope);
  free(want);
  close_probed(&r);
  close_probed(&square);
}

/* through the whole gradient, against central differences */
static void squares_pass_the_derivative_check(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  bent b = {0.3, SEPARATE};
  ambulo_term term = ambulo_term_default(AMBULO_USER_SQUARE);
  term.function = function;
  term.user = &b;
  ambulo_problem_definition definition = arm_definition(f.model);
  definition.terms = &term;
  definition.term_count = 1;
  fixture_open(&f, &definition);
  ambulo_derivative_error errors[16];
  int count = 0;
  assert_int_equal(
      ambulo_problem_check_derivatives(f.problem, f.workspace, f.x, 0.0, errors, 16, &count),
      AMBULO_OK);
  for (int i = 0; i < count; i++) assert_true(errors[i].error < 1e-7);
  assert_string_equal(ambulo_problem_term_name(f.problem, 0), "user_square");
  fixture_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sums_over_channels_are_exact), cmocka_unit_test(cross_terms_cancel),
      cmocka_unit_test(no_curvature_is_none), cmocka_unit_test(squares),
      cmocka_unit_test(squares_pass_the_derivative_check)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
