/* tests/mechanics/kernel_fixture.h - random trees, states and the reference's derivatives.
 *
 * A case is a tree, its plan, and one block of states in one of the pose regimes; from number
 * rooted_cases on, the tree stands on a chain of sliders along (mostly) world axes; from number
 * coupled_cases on, some joints of one or the other kind are functions of coordinates. One in three
 * has drives. The reference gives the outputs of any lane, and their Jacobians by complex steps of
 * 1e-40, which are as accurate as the values themselves. Differences are relative to the largest
 * entry of a group
 * (tau and wrench; points). */
#ifndef TESTS_MECHANICS_KERNEL_FIXTURE_H
#define TESTS_MECHANICS_KERNEL_FIXTURE_H

#include "mechanics/lagrangian.h"
#include "ambulo/mechanics.h"
#include "mechanics/plan.h"
#include "support/random_model.h"
#include "support/test.h"

enum {
  rooted_cases = 240,
  coupled_cases = 340,
  case_count = 460,
  max_d = 64,
  max_rows = max_d + 6 + 3 * random_max_points
};

static const char *const isa_names[] = {"scalar", "baseline", "avx2", "avx512"};
enum { isa_count = 4 };

typedef struct kernel_case {
  random_tree tree;
  ambulo_model *model;
  ambulo__plan *plan;
  int number, d, rows;
  double *q, *qd, *qdd, *weights, *out, *scratch; /* lanes */
  void *reference_scratch;
} kernel_case;

static inline double *lane_array(size_t count) {
  double *at = aligned_alloc(64, (count + 1) * 64);
  assert_non_null(at);
  memset(at, 0xff, (count + 1) * 64);
  return at;
}

static inline double *zero_lane_array(size_t count) {
  double *at = lane_array(count);
  memset(at, 0, (count + 1) * 64);
  return at;
}

static inline void case_open(kernel_case *c, int number) {
  random_source source = {1000 + (uint64_t)number};
  c->number = number;
  if (number < rooted_cases || (number >= coupled_cases && number % 3 == 0)) {
    random_tree_make(&c->tree, 77 * (uint64_t)number + 5, 1 + number % 60);
  } else {
    random_tree_make(&c->tree, 77 * (uint64_t)number + 5, 1 + number % 20);
    random_tree_put_on_root(&c->tree, 31 * (uint64_t)number + 2);
  }
  if (number % 3 == 0) random_tree_drive(&c->tree, 7 * (uint64_t)number + 3);
  if (number >= coupled_cases) random_tree_couple(&c->tree, 19 * (uint64_t)number + 3);
  c->model = NULL;
  c->plan = NULL;
  assert_int_equal(ambulo_model_create(&c->tree.definition, NULL, NULL, &c->model), AMBULO_OK);
  assert_int_equal(ambulo__plan_create(c->model, NULL, &c->plan), AMBULO_OK);
  c->d = ambulo__plan_coordinates(c->plan);
  c->rows = ambulo__plan_rows(c->plan);
  size_t d = (size_t)c->d;
  c->q = lane_array(d);
  c->qd = lane_array(d);
  c->qdd = lane_array(d);
  c->weights = lane_array((size_t)c->rows);
  c->out = lane_array((size_t)c->rows);
  c->scratch = lane_array(ambulo__plan_scratch(c->plan) / AMBULO__LANES);
  c->reference_scratch = malloc(ambulo__lagrangian_scratch_size(c->model));
  assert_non_null(c->reference_scratch);
  for (int i = 0; i < c->d * AMBULO__LANES; i++) {
    c->q[i] = random_pose(&source, number % random_poses);
    c->qd[i] = random_between(&source, -3, 3);
    c->qdd[i] = random_between(&source, -9, 9);
  }
  for (int i = 0; i < c->rows * AMBULO__LANES; i++) c->weights[i] = random_between(&source, -1, 1);
}

static inline void case_close(kernel_case *c) {
  double *const arrays[] = {c->q, c->qd, c->qdd, NULL, c->weights, c->out, c->scratch};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) free(arrays[i]);
  free(c->reference_scratch);
  ambulo__plan_free(c->plan);
  ambulo_model_free(c->model);
}

/* State [3 d] of a lane: q, qd, qdd. */
static inline void case_state(const kernel_case *c, int lane, double *state) {
  for (int i = 0; i < c->d; i++) {
    state[i] = c->q[i * AMBULO__LANES + lane];
    state[c->d + i] = c->qd[i * AMBULO__LANES + lane];
    state[2 * c->d + i] = c->qdd[i * AMBULO__LANES + lane];
  }
}

static inline void case_reference(const kernel_case *c, const double *state, double *rows) {
  assert_int_equal(ambulo__lagrangian(0, c->model, state, state + c->d, state + 2 * c->d,
                                      &(ambulo_outputs){.size = sizeof(ambulo_outputs),
                                                        .tau = rows,
                                                        .wrench = rows + c->d,
                                                        .points = rows + c->d + 6},
                                      c->reference_scratch),
                   AMBULO_OK);
}

/* jacobian[group][row][column] of the reference; group 0: q, 1: qd, 2: qdd. */
static inline void case_jacobian(const kernel_case *c, const double *state, double *jacobian) {
  const double step = 1e-40;
  double z[2 * 3 * max_d], out[2 * max_rows];
  for (int i = 0; i < 3 * c->d; i++) {
    z[2 * i] = state[i];
    z[2 * i + 1] = 0;
  }
  for (int k = 0; k < 3 * c->d; k++) {
    z[2 * k + 1] = step;
    assert_int_equal(ambulo__lagrangian(1, c->model, z, z + 2 * c->d, z + 4 * c->d,
                                        &(ambulo_outputs){.size = sizeof(ambulo_outputs),
                                                          .tau = out,
                                                          .wrench = out + 2 * c->d,
                                                          .points = out + 2 * (c->d + 6)},
                                        c->reference_scratch),
                     AMBULO_OK);
    z[2 * k + 1] = 0;
    for (int row = 0; row < c->rows; row++) {
      jacobian[(k / c->d * c->rows + row) * c->d + k % c->d] = out[2 * row + 1] / step;
    }
  }
}

/* Dense [rows][d] of one order (by q, qd or qdd) in one lane of the entries jq, jqd, jqdd, one
 * after the other; every row is made of its parts, and what the pattern does not name is zero. */
static inline void case_dense(const kernel_case *c, const double *entries, int order, int lane,
                              double *dense) {
  ambulo__plan_pattern p = ambulo__plan_get_pattern(c->plan);
  memset(dense, 0, (size_t)(c->rows * c->d) * sizeof *dense);
  for (int row = 0; row < c->rows; row++) {
    ambulo__row_part part[AMBULO__MOST_PARTS];
    int parts = ambulo__plan_parts(c->plan, row, part);
    for (int k = 0; k < parts; k++) {
      int from = part[k].row, by = part[k].by_acceleration ? 2 : order;
      if (by > 0 && p.rate_start[from] < 0) continue;
      if (part[k].by_acceleration && order > 0) continue;
      int block = by > 0 ? p.count + (by - 1) * p.dynamic_count : 0;
      int at = block + (by > 0 ? p.rate_start[from] : p.start[from]), times = part[k].times;
      double factor = part[k].factor * (times < 0 ? 1 : entries[times * AMBULO__LANES + lane]);
      for (int e = p.start[from]; e < p.start[from + 1]; e++, at++) {
        int place = by == 2 ? block + p.by_qdd[at - block] : at;
        dense[row * c->d + p.column[e]] += factor * entries[place * AMBULO__LANES + lane];
      }
    }
  }
}

/* Largest |a - b| over n entries `stride` apart in a and adjacent in b, relative to the largest
 * |b|; NaN counts as infinite. */
static inline double difference(const double *a, int stride, const double *b, int n, int *where) {
  double scale = 1e-3, worst = 0;
  for (int i = 0; i < n; i++) scale = fmax(scale, fabs(b[i]));
  for (int i = 0; i < n; i++) {
    double e = fabs(a[i * stride] - b[i]) / scale;
    if (e <= worst) continue;
    worst = isnan(e) ? INFINITY : e;
    *where = i;
  }
  return worst;
}

static inline void case_forget(kernel_case *c) {
  for (size_t i = 0; i < ambulo__plan_scratch(c->plan); i++) c->scratch[i] = NAN;
}

/* The rows, by the kernel that fills scratch and by the one that does not. */
static inline void case_outputs(kernel_case *c, const ambulo__kernels *kernels,
                                const double *ground) {
  int n = c->rows * AMBULO__LANES;
  double *alone = malloc((size_t)n * sizeof *alone);
  assert_non_null(alone);
  case_forget(c);
  kernels->outputs(c->plan, c->q, c->qd, c->qdd, ground, c->out, c->scratch);
  memcpy(alone, c->out, (size_t)n * sizeof *alone);
  case_forget(c);
  kernels->forward(c->plan, c->q, c->qd, c->qdd, ground, c->out, c->scratch);
  for (int i = 0; i < n; i++) {
    if (alone[i] == c->out[i] || (isnan(alone[i]) && isnan(c->out[i]))) continue;
    print_error("%s: row %d, lane %d: %.17g alone, %.17g before the reverse sweep\n", kernels->name,
                i / AMBULO__LANES, i % AMBULO__LANES, alone[i], c->out[i]);
    fail();
  }
  free(alone);
}

static inline void case_forward(kernel_case *c, const ambulo__kernels *kernels) {
  case_outputs(c, kernels, NULL);
}

/* The gradient of the weighted rows, [3][d][lanes]. */
static inline void case_reverse(kernel_case *c, const ambulo__kernels *kernels, double *gradient) {
  int n = c->d * AMBULO__LANES;
  case_forward(c, kernels);
  kernels->reverse(c->plan, c->qd, c->qdd, NULL, c->weights, gradient, gradient + n,
                   gradient + 2 * n, c->scratch);
}

static inline void report_difference(const kernel_case *c, const char *isa, const char *what,
                                     int where, double error, double allowed) {
  if (error <= allowed) return;
  print_error("tree %d (%d coordinates), %s: %s, entry %d: relative error %.3g, allowed %.3g\n",
              c->number, c->d, isa, what, where, error, allowed);
  fail();
}

#endif
