/* mechanics/mechanics.c - the public batches: node-major arrays through the lane kernels.
 *
 * Nodes are gathered into blocks of AMBULO__LANES, the last one padded with copies of the last
 * node, and the results scattered back. Inputs are looked through before anything is written.
 * Results can only overflow if an input is enormous; then a dry run comes first, so that outputs
 * stay untouched on failure.
 *
 * Reading order: lagrangian.c (the equations as printed), plan.c, plan_layout.h, plan_local.h,
 * plan_steps.c; kernel_source.h, and from there kernel_wide.h,
 * kernel_local_forward.h, kernel_local_reverse.h, kernel_jacobian.h; kernel_contacts.h where
 * the ground's force acts.
 */
#include "ambulo/mechanics.h"
#include "base/sized.h"
#include "mechanics/lane_transpose.h"
#include "mechanics/plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Inputs up to this cannot make results overflow. */
static const double moderate = 1e30;

struct ambulo_mechanics {
  ambulo_allocator allocator;
  ambulo__plan *plan;
  const ambulo__kernels *kernels;
  double *q, *qd, *qdd;    /* [d][lanes] */
  double *out, *weights;   /* [rows][lanes] */
  double *gq, *gqd, *gqdd; /* [d][lanes] */
  double *jq, *jqd, *jqdd; /* [count] and [dynamic_count][lanes] */
  double *scratch;
};

typedef struct batch {
  int nodes;
  const double *q, *qd, *qdd; /* [nodes][d] */
} batch;

void ambulo_mechanics_free(ambulo_mechanics *mechanics) {
  if (!mechanics) return;
  ambulo_allocator memory = mechanics->allocator;
  ambulo__plan_free(mechanics->plan);
  ambulo__free_aligned(&memory, mechanics->q);
  ambulo__free(&memory, mechanics);
}

/* One allocation, cut into the arrays. */
static ambulo_status allocate_arrays(ambulo_mechanics *m) {
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(m->plan);
  size_t d = (size_t)ambulo__plan_coordinates(m->plan) * AMBULO__LANES;
  size_t rows = (size_t)ambulo__plan_rows(m->plan) * AMBULO__LANES;
  size_t all = (size_t)pattern.count * AMBULO__LANES;
  size_t dynamic = (size_t)pattern.dynamic_count * AMBULO__LANES;
  size_t total = 6 * d + 2 * rows + all + 2 * dynamic + ambulo__plan_scratch(m->plan);
  double *at = ambulo__alloc_aligned(&m->allocator, total, sizeof(double));
  if (!at) return AMBULO_E_MEMORY;
  double **const arrays[] = {&m->q,   &m->qd,      &m->qdd, &m->gq,  &m->gqd,  &m->gqdd,
                             &m->out, &m->weights, &m->jq,  &m->jqd, &m->jqdd, &m->scratch};
  const size_t sizes[] = {d, d, d, d, d, d, rows, rows, all, dynamic, dynamic, 0};
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
    *arrays[i] = at;
    at += sizes[i];
  }
  return AMBULO_OK;
}

ambulo_status ambulo_mechanics_create(const ambulo_model *model, const ambulo_allocator *allocator,
                                      ambulo_mechanics **mechanics) {
  if (!model || !mechanics) return AMBULO_E_ARGUMENT;
  ambulo_allocator memory = ambulo__allocator_or_default(allocator);
  ambulo_mechanics *m = ambulo__alloc(&memory, 1, sizeof *m);
  if (!m) return AMBULO_E_MEMORY;
  m->allocator = memory;
  m->kernels = ambulo__kernels_select();
  ambulo_status status = ambulo__plan_create(model, allocator, &m->plan);
  if (status == AMBULO_OK) status = allocate_arrays(m);
  if (status != AMBULO_OK) {
    ambulo_mechanics_free(m);
    return status;
  }
  *mechanics = m;
  return AMBULO_OK;
}

/* The largest magnitude; infinite if anything is not finite. NULL counts as zeros. */
static double largest_of(const double *x, size_t count) {
  double most = 0;
  for (size_t i = 0; i < count; i++) {
    if (!isfinite(x[i])) return INFINITY;
    most = fmax(most, fabs(x[i]));
  }
  return most;
}

/* The same, or, where that is moderate, a moderate bound of it: a sum of squares takes two
 * operations for a number, side by side, and shows what is not finite. */
static double largest(const double *x, size_t count) {
  ambulo__two a = {0}, b = {0}, c = {0}, d = {0};
  if (!x) return 0;
  size_t i = 0;
  for (; i + 8 <= count; i += 8) {
    a += ambulo__square_two(x + i);
    b += ambulo__square_two(x + i + 2);
    c += ambulo__square_two(x + i + 4);
    d += ambulo__square_two(x + i + 6);
  }
  a = (a + b) + (c + d);
  double total = a[0] + a[1];
  for (; i < count; i++) total += x[i] * x[i];
  return total <= moderate * moderate ? sqrt(total) : largest_of(x, count);
}

static double largest_input(const ambulo_mechanics *m, const batch *motion) {
  size_t count = (size_t)motion->nodes * (size_t)ambulo__plan_coordinates(m->plan);
  double most = fmax(largest(motion->q, count), largest(motion->qd, count));
  return fmax(most, largest(motion->qdd, count));
}

static int is_legal(const ambulo_mechanics *m, const batch *motion) {
  if (!m || motion->nodes < 0) return 0;
  return (motion->q && motion->qd && motion->qdd) || motion->nodes == 0 ||
         ambulo__plan_coordinates(m->plan) == 0;
}

/* Number of runs: 0 if an input is not finite, 2 if a dry run is called for. */
static int run_count(double most) {
  return isinf(most) ? 0 : (most > moderate ? 2 : 1);
}

/* 0 x is zero, or NaN if x is not finite. */
static int all_finite(const double *lanes, size_t entries) {
  ambulo__two a = {0}, b = {0}, c = {0}, d = {0};
  for (size_t e = 0; e < entries; e++, lanes += AMBULO__LANES) {
    ambulo__two p = ambulo__load_two(lanes), q = ambulo__load_two(lanes + 2);
    ambulo__two r = ambulo__load_two(lanes + 4), s = ambulo__load_two(lanes + 6);
    a += 0 * p;
    b += 0 * q;
    c += 0 * r;
    d += 0 * s;
  }
  a = (a + b) + (c + d);
  return a[0] + a[1] == 0;
}

static void gather_block(ambulo_mechanics *m, const batch *motion, int first) {
  int d = ambulo__plan_coordinates(m->plan);
  ambulo__lanes_gather(m->q, motion->q, d, first, motion->nodes);
  ambulo__lanes_gather(m->qd, motion->qd, d, first, motion->nodes);
  ambulo__lanes_gather(m->qdd, motion->qdd, d, first, motion->nodes);
}

ambulo_status ambulo_mechanics_inverse_dynamics(ambulo_mechanics *m, int nodes, const double *q,
                                                const double *qd, const double *qdd,
                                                const ambulo_outputs *outputs) {
  batch motion = {nodes, q, qd, qdd};
  ambulo_outputs out;
  if (!is_legal(m, &motion) || !AMBULO__OWN(ambulo_outputs, &out, outputs))
    return AMBULO_E_ARGUMENT;
  int d = ambulo__plan_coordinates(m->plan), p = 3 * ambulo__plan_points(m->plan);
  size_t rows = (size_t)ambulo__plan_rows(m->plan);
  int runs = run_count(largest_input(m, &motion));
  if (runs == 0) return AMBULO_E_NUMERIC;
  for (int run = runs; run > 0; run--) {
    for (int first = 0; first < nodes; first += AMBULO__LANES) {
      gather_block(m, &motion, first);
      m->kernels->outputs(m->plan, m->q, m->qd, m->qdd, NULL, m->out, m->scratch);
      if (!all_finite(m->out, rows)) return AMBULO_E_NUMERIC;
      if (run > 1) continue;
      ambulo__lanes_scatter(out.tau, m->out, d, first, nodes);
      ambulo__lanes_scatter(out.wrench, m->out + d * AMBULO__LANES, 6, first, nodes);
      ambulo__lanes_scatter(out.points, m->out + (d + 6) * AMBULO__LANES, p, first, nodes);
    }
  }
  return AMBULO_OK;
}

ambulo_status ambulo_mechanics_gradient(ambulo_mechanics *m, int nodes, const double *q,
                                        const double *qd, const double *qdd,
                                        const ambulo_output_weights *weights,
                                        const ambulo_motion_gradient *gradient) {
  batch motion = {nodes, q, qd, qdd};
  ambulo_output_weights by;
  ambulo_motion_gradient to;
  if (!is_legal(m, &motion) || !weights || !gradient ||
      !AMBULO__OWN(ambulo_output_weights, &by, weights) ||
      !AMBULO__OWN(ambulo_motion_gradient, &to, gradient) || !to.q || !to.qd || !to.qdd)
    return AMBULO_E_ARGUMENT;
  weights = &by;
  gradient = &to;
  int d = ambulo__plan_coordinates(m->plan), p = 3 * ambulo__plan_points(m->plan);
  size_t n = (size_t)nodes, columns = (size_t)d;
  double most = fmax(largest_input(m, &motion), largest(weights->tau, n * columns));
  most = fmax(most, fmax(largest(weights->wrench, n * 6), largest(weights->points, n * (size_t)p)));
  int runs = run_count(most);
  if (runs == 0) return AMBULO_E_NUMERIC;
  for (int run = runs; run > 0; run--) {
    for (int first = 0; first < nodes; first += AMBULO__LANES) {
      gather_block(m, &motion, first);
      m->kernels->forward(m->plan, m->q, m->qd, m->qdd, NULL, m->out, m->scratch);
      ambulo__lanes_gather(m->weights, weights->tau, d, first, nodes);
      ambulo__lanes_gather(m->weights + d * AMBULO__LANES, weights->wrench, 6, first, nodes);
      ambulo__lanes_gather(m->weights + (d + 6) * AMBULO__LANES, weights->points, p, first, nodes);
      m->kernels->reverse(m->plan, m->qd, m->qdd, NULL, m->weights, m->gq, m->gqd, m->gqdd,
                          m->scratch);
      if (!all_finite(m->gq, 3 * columns)) return AMBULO_E_NUMERIC;
      if (run > 1) continue;
      ambulo__lanes_scatter(gradient->q, m->gq, d, first, nodes);
      ambulo__lanes_scatter(gradient->qd, m->gqd, d, first, nodes);
      ambulo__lanes_scatter(gradient->qdd, m->gqdd, d, first, nodes);
    }
  }
  return AMBULO_OK;
}

/* values[node][row - from][column] for rows from..to, which have one part each without ground
 * reaction; zeros elsewhere. place: where entries stand, NULL: in order. */
static void scatter_rows(const ambulo_mechanics *m, double *values, const double *entries,
                         const int *place, int from, int to, int first, int nodes) {
  if (!values) return;
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(m->plan);
  size_t d = (size_t)ambulo__plan_coordinates(m->plan), size = (size_t)(to - from) * d;
  for (int lane = 0; lane < AMBULO__LANES && first + lane < nodes; lane++) {
    double *matrix = values + (size_t)(first + lane) * size;
    memset(matrix, 0, size * sizeof *matrix);
    for (int row = from; row < to; row++) {
      double *to_row = matrix + (size_t)(row - from) * d;
      ambulo__row_part part[AMBULO__MOST_PARTS];
      (void)ambulo__plan_parts(m->plan, row, part);
      for (int e = pattern.start[part[0].row]; e < pattern.start[part[0].row + 1]; e++) {
        int at = place ? place[e] : e;
        to_row[pattern.column[e]] += part[0].factor * entries[at * AMBULO__LANES + lane];
      }
    }
  }
}

ambulo_status ambulo_mechanics_jacobians(ambulo_mechanics *m, int nodes, const double *q,
                                         const double *qd, const double *qdd,
                                         const ambulo_jacobians *jacobians) {
  batch motion = {nodes, q, qd, qdd};
  ambulo_jacobians own;
  if (!jacobians || !is_legal(m, &motion) || !AMBULO__OWN(ambulo_jacobians, &own, jacobians))
    return AMBULO_E_ARGUMENT;
  jacobians = &own;
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(m->plan);
  int d = ambulo__plan_coordinates(m->plan), rows = ambulo__plan_rows(m->plan);
  size_t count = (size_t)pattern.count + 2 * (size_t)pattern.dynamic_count;
  int runs = run_count(largest_input(m, &motion));
  if (runs == 0) return AMBULO_E_NUMERIC;
  for (int run = runs; run > 0; run--) {
    for (int first = 0; first < nodes; first += AMBULO__LANES) {
      gather_block(m, &motion, first);
      m->kernels->jacobian(m->plan, m->q, m->qd, m->qdd, NULL, m->jq, m->jqd, m->jqdd, m->scratch);
      if (!all_finite(m->jq, count)) return AMBULO_E_NUMERIC;
      if (run > 1) continue;
      scatter_rows(m, jacobians->tau_q, m->jq, NULL, 0, d, first, nodes);
      scatter_rows(m, jacobians->tau_qd, m->jqd, NULL, 0, d, first, nodes);
      scatter_rows(m, jacobians->tau_qdd, m->jqdd, pattern.by_qdd, 0, d, first, nodes);
      scatter_rows(m, jacobians->wrench_q, m->jq, NULL, d, d + 6, first, nodes);
      scatter_rows(m, jacobians->wrench_qd, m->jqd, NULL, d, d + 6, first, nodes);
      scatter_rows(m, jacobians->wrench_qdd, m->jqdd, pattern.by_qdd, d, d + 6, first, nodes);
      scatter_rows(m, jacobians->points_q, m->jq, NULL, d + 6, rows, first, nodes);
    }
  }
  return AMBULO_OK;
}

/* Choosing a kernel set at run time.
 *
 * Nothing is cached (the library has no writable globals): callers keep the pointer.
 */

#if defined(__x86_64__)
static int runs_avx2(void) {
  return ambulo__kernels_avx2.forward && __builtin_cpu_supports("avx2") &&
         __builtin_cpu_supports("fma");
}

static int runs_avx512(void) {
  return ambulo__kernels_avx512.forward && __builtin_cpu_supports("avx512f") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("fma");
}
#endif

const ambulo__kernels *ambulo__kernels_by_name(const char *name) {
  if (!name) return NULL;
  if (!strcmp(name, "scalar")) return &ambulo__kernels_scalar;
  if (!strcmp(name, "baseline")) return &ambulo__kernels_baseline;
#if defined(__x86_64__)
  if (!strcmp(name, "avx2") && runs_avx2()) return &ambulo__kernels_avx2;
  if (!strcmp(name, "avx512") && runs_avx512()) return &ambulo__kernels_avx512;
#endif
  return NULL;
}

const ambulo__kernels *ambulo__kernels_select(void) {
  const ambulo__kernels *set = ambulo__kernels_by_name(getenv("AMBULO_ISA"));
  if (!set) set = ambulo__kernels_by_name("avx512");
  if (!set) set = ambulo__kernels_by_name("avx2");
  if (!set) set = &ambulo__kernels_baseline;
  return set;
}

const char *ambulo__instruction_set(void) {
  return ambulo__kernels_select()->name;
}
