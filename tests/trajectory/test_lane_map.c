/* The lane-blocked map against the basis itself, and its transpose against the map. */
#include "support/fail_alloc.h"
#include "trajectory/basis_fixture.h"
#include "trajectory/lane_map.h"

enum { D = 5, MAX_NODES = 40, STRIDE = (4 * D + 3) * AMBULO__LANES };

typedef struct lane_arrays {
  double data[(MAX_NODES / AMBULO__LANES) * STRIDE];
} lane_arrays;

static double *part(lane_arrays *arrays, int order) {
  return arrays->data + order * D * AMBULO__LANES;
}

static double *cell(lane_arrays *arrays, int order, int node, int i) {
  int block = node / AMBULO__LANES, lane = node % AMBULO__LANES;
  return part(arrays, order) + block * STRIDE + i * AMBULO__LANES + lane;
}

typedef struct setup {
  ambulo__basis *basis;
  ambulo__lane_map *map;
  int nodes, count;
  double times[MAX_NODES];
  double x[64 * D];
} setup;

static void open_setup(setup *s, ambulo__basis_kind kind, int degree, int intervals, int nodes) {
  s->basis = make_basis(kind, degree, intervals, 1.3, NULL);
  s->nodes = nodes;
  for (int k = 0; k < nodes; k++) s->times[k] = 1.3 * k / (nodes > 1 ? nodes - 1 : 1);
  assert_int_equal(ambulo__lane_map_create(s->basis, s->times, nodes, D, NULL, &s->map), AMBULO_OK);
  s->count = ambulo__basis_control_points(s->basis) * D;
  fill_pseudo_random(s->x, s->count, 21);
  for (int j = s->count; j < 64 * D; j++) s->x[j] = NAN; /* a read past the end shows */
}

static void close_setup(setup *s) {
  ambulo__lane_map_free(s->map);
  ambulo__basis_free(s->basis);
}

static const struct {
  ambulo__basis_kind kind;
  int degree, intervals, nodes;
} cases[] = {{AMBULO__BSPLINE, 3, 12, 37},
             {AMBULO__BSPLINE, 3, 36, 37},
             {AMBULO__BSPLINE, 3, 1, 9},
             {AMBULO__BSPLINE, 4, 7, 16},
             {AMBULO__BSPLINE, 7, 11, 40},
             {AMBULO__CENTRAL_DIFFERENCE, 0, 12, 13},
             {AMBULO__CENTRAL_DIFFERENCE, 0, 9, 25},
             {AMBULO__HERMITE, 0, 12, 13},
             {AMBULO__HERMITE, 0, 9, 25},
             {AMBULO__BSPLINE, 3, 5, 1}};
enum { CASES = sizeof cases / sizeof *cases };

static void open_case(setup *s, int c) {
  open_setup(s, cases[c].kind, cases[c].degree, cases[c].intervals, cases[c].nodes);
}

static void forward_equals_the_basis(void **state) {
  (void)state;
  for (int c = 0; c < CASES; c++) {
    setup s;
    open_case(&s, c);
    static lane_arrays a;
    memset(&a, 0xff, sizeof a); /* NaN: what is not written shows */
    ambulo__lane_map_forward(s.map, s.x, part(&a, 0), part(&a, 1), part(&a, 2), part(&a, 3),
                             STRIDE);
    int padded = ambulo__block_count(s.nodes) * AMBULO__LANES;
    for (int k = 0; k < padded; k++) {
      int node = k < s.nodes ? k : s.nodes - 1;
      for (int i = 0; i < D; i++) {
        double single[64];
        for (int j = 0; j < s.count / D; j++) single[j] = s.x[j * D + i];
        for (int order = 0; order <= 3; order++) {
          double want = curve(s.basis, single, s.times[node], order);
          assert_close(*cell(&a, order, k, i), want, 1e-13);
        }
      }
    }
    /* the entries behind q, qd, qdd and jerk belong to somebody else */
    assert_true(isnan(a.data[4 * D * AMBULO__LANES]));
    close_setup(&s);
  }
}

static void transpose_is_the_adjoint_of_forward(void **state) {
  (void)state;
  for (int c = 0; c < CASES; c++) {
    setup s;
    open_case(&s, c);
    static lane_arrays a, g;
    double gx[64 * D] = {0.0};
    memset(&a, 0, sizeof a);
    fill_pseudo_random(g.data, (int)(sizeof g.data / sizeof *g.data), 33);
    ambulo__lane_map_forward(s.map, s.x, part(&a, 0), part(&a, 1), part(&a, 2), part(&a, 3),
                             STRIDE);
    ambulo__lane_map_transpose(s.map, part(&g, 0), part(&g, 1), part(&g, 2), part(&g, 3), STRIDE,
                               gx);
    double left = 0.0, right = 0.0, size = 1.0;
    for (int k = 0; k < s.nodes; k++) {
      for (int order = 0; order <= 3; order++) {
        for (int i = 0; i < D; i++) {
          double product = *cell(&a, order, k, i) * *cell(&g, order, k, i);
          left += product;
          size += fabs(product);
        }
      }
    }
    for (int j = 0; j < s.count; j++) right += s.x[j] * gx[j];
    assert_close(left / size, right / size, 1e-14);
    close_setup(&s);
  }
}

static void transpose_adds_and_ignores_padding(void **state) {
  (void)state;
  setup s;
  open_setup(&s, AMBULO__BSPLINE, 3, 6, 11);
  static lane_arrays g;
  memset(&g, 0, sizeof g);
  for (int lane = 3; lane < AMBULO__LANES; lane++) {
    for (int i = 0; i < D; i++) *cell(&g, 0, AMBULO__LANES + lane, i) = NAN;
  }
  double gx[64 * D];
  for (int j = 0; j < s.count; j++) gx[j] = j;
  ambulo__lane_map_transpose(s.map, part(&g, 0), part(&g, 1), part(&g, 2), NULL, STRIDE, gx);
  for (int j = 0; j < s.count; j++) assert_true(gx[j] == j);
  close_setup(&s);
}

static void points_are_those_of_the_basis(void **state) {
  (void)state;
  setup s;
  open_setup(&s, AMBULO__BSPLINE, 3, 12, 13);
  const ambulo__basis_point *points = ambulo__lane_map_points(s.map);
  for (int k = 0; k < 16; k++) {
    ambulo__basis_point point;
    ambulo__basis_at(s.basis, s.times[k < 13 ? k : 12], &point);
    assert_memory_equal(&points[k], &point, sizeof point);
  }
  close_setup(&s);
}

static void impossible_arguments_are_refused(void **state) {
  (void)state;
  ambulo__basis *basis = make_basis(AMBULO__BSPLINE, 3, 4, 1.0, NULL);
  ambulo__lane_map *map = NULL;
  double time = 0.0;
  assert_int_equal(ambulo__lane_map_create(NULL, &time, 1, 1, NULL, &map), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo__lane_map_create(basis, &time, 0, 1, NULL, &map), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo__lane_map_create(basis, &time, 1, 0, NULL, &map), AMBULO_E_ARGUMENT);
  assert_null(map);
  ambulo__lane_map_free(NULL);
  ambulo__basis_free(basis);
}

static void every_failed_allocation_is_survived(void **state) {
  (void)state;
  ambulo__basis *basis = make_basis(AMBULO__BSPLINE, 3, 4, 1.0, NULL);
  const double times[2] = {0.0, 1.0};
  for (long k = 0;; k++) {
    assert_in_range(k, 0, 100);
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo__lane_map *map = NULL;
    ambulo_status status = ambulo__lane_map_create(basis, times, 2, 1, &hook, &map);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__lane_map_free(map);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  ambulo__basis_free(basis);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(forward_equals_the_basis),
      cmocka_unit_test(transpose_is_the_adjoint_of_forward),
      cmocka_unit_test(transpose_adds_and_ignores_padding),
      cmocka_unit_test(points_are_those_of_the_basis),
      cmocka_unit_test(impossible_arguments_are_refused),
      cmocka_unit_test(every_failed_allocation_is_survived),
  };
  return cmocka_run_group_tests_name("trajectory/lane_map", tests, NULL, NULL);
}
