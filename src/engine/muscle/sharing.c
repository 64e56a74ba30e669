/* muscle/sharing.c - torques at many times shared among muscles, a block of times after the other.
 */
#include <math.h>
#include <string.h>

#include "base/arithmetic.h"
#include "base/sized.h"
#include "mechanics/plan.h"
#include "model/model.h"
#include "muscle/share.h"

/* ------------------------------------------------------------------ kernels */

static const ambulo__share_kernels *share_kernels(void) {
  const char *name = ambulo__instruction_set();
#if defined(__x86_64__)
  if (!strcmp(name, "avx512") && ambulo__share_avx512.share) return &ambulo__share_avx512;
  if (!strncmp(name, "avx", 3) && ambulo__share_avx2.share) return &ambulo__share_avx2;
#endif
  return strcmp(name, "scalar") ? &ambulo__share_baseline : &ambulo__share_scalar;
}

/* ------------------------------------------------------------------ workspace */

/* entries of a block, each of LANES numbers: inputs, then outputs */
enum { SLOPES = 5, PER_MUSCLE = 4, SINGLE = 2 };

ambulo_status ambulo__share_create(const ambulo_muscles *muscles, const ambulo_sharing *sharing,
                                   const ambulo_allocator *allocator, ambulo__share **created) {
  const ambulo__share_kernels *kernels = share_kernels();
  size_t most = 0, scratch = 0;
  for (int i = 0; i < muscles->limb_count; i++) {
    const ambulo__muscle_limb *limb = &muscles->limbs[i];
    size_t j = (size_t)limb->coordinate_count;
    size_t entries = (AMBULO__SHARE_INPUTS + SLOPES) * j + j * (j + 1) / 2 +
                     PER_MUSCLE * (size_t)limb->count + SINGLE;
    if (entries > most) most = entries;
    if (kernels->scratch(limb) > scratch) scratch = kernels->scratch(limb);
  }
  ambulo__share *s = ambulo__alloc(allocator, 1, sizeof *s);
  double *numbers =
      ambulo__alloc_aligned(allocator, most * AMBULO__LANES + scratch, sizeof *numbers);
  if (!s || !numbers) {
    ambulo__free(allocator, s);
    ambulo__free_aligned(allocator, numbers);
    return AMBULO_E_MEMORY;
  }
  *s = (ambulo__share){.allocator = *allocator,
                       .muscles = muscles,
                       .sharing = *sharing,
                       .kernels = kernels,
                       .numbers = numbers,
                       .scratch = numbers + most * AMBULO__LANES};
  *created = s;
  return AMBULO_OK;
}

void ambulo__share_free(ambulo__share *share) {
  if (!share) return;
  ambulo_allocator a = share->allocator;
  ambulo__free_aligned(&a, share->numbers);
  ambulo__free(&a, share);
}

void ambulo__share_begin(ambulo__share *s, int index, ambulo__share_block *b,
                         double *inputs[AMBULO__SHARE_INPUTS]) {
  const ambulo__muscle_limb *limb = &s->muscles->limbs[index];
  size_t j = (size_t)limb->coordinate_count * AMBULO__LANES;
  size_t m = (size_t)limb->count * AMBULO__LANES;
  double *at = s->numbers;
  for (int k = 0; k < AMBULO__SHARE_INPUTS; k++, at += j) inputs[k] = at;
  double **const slopes[] = {&b->by_q, &b->by_qd, &b->by_tau, &b->by_tau_rate, &b->reserve};
  for (int k = 0; k < SLOPES; k++, at += j) *slopes[k] = at;
  double **const each[] = {&b->activation, &b->force, &b->length, &b->speed};
  for (int k = 0; k < PER_MUSCLE; k++, at += m) *each[k] = at;
  b->cost = at;
  b->steps = at + AMBULO__LANES;
  b->rows = at + SINGLE * AMBULO__LANES;
  b->q = inputs[0];
  b->qd = inputs[1];
  b->tau = inputs[2];
  b->tau_rate = inputs[3];
  b->scratch = s->scratch;
}

void ambulo__share_end(const ambulo__share *s, int limb, const ambulo__share_block *b) {
  const ambulo__muscle_limb *l = &s->muscles->limbs[limb];
  ambulo__prices prices = ambulo__share_prices(s->muscles, &s->sharing, l);
  s->kernels->share(l, &prices, b);
}

ambulo__prices ambulo__share_prices(const ambulo_muscles *muscles, const ambulo_sharing *sharing,
                                    const ambulo__muscle_limb *limb) {
  const ambulo_model *model = muscles->model;
  double stature = model->stature > 0.0 ? model->stature : 1.75;
  double weight = ambulo__model_weight(model), g = weight / model->mass;
  double unit = 1e-3 * weight * stature;
  ambulo__prices p = {.activation = sharing->activation,
                      .by_volume = sharing->by_volume,
                      .volume = muscles->volume,
                      .count = muscles->count,
                      .metabolic = sharing->metabolic / (weight * sqrt(g * stature))};
  for (int j = 0; j < limb->coordinate_count; j++) p.reserve[j] = sharing->reserve / (unit * unit);
  return p;
}

/* ------------------------------------------------------------------ one block */

/* entry of lane l at node first + l, the last node for lanes beyond */
static void gather(double *lanes, const double *values, int entries, const int *chosen, int count,
                   int first, int nodes) {
  for (int j = 0; j < count; j++)
    for (int lane = 0; lane < AMBULO__LANES; lane++) {
      int node = first + lane < nodes ? first + lane : nodes - 1;
      lanes[j * AMBULO__LANES + lane] =
          values ? values[(size_t)node * (size_t)entries + (size_t)chosen[j]] : 0.0;
    }
}

static void scatter(double *values, const double *lanes, int entries, int entry, int first,
                    int nodes) {
  for (int lane = 0; values && lane < AMBULO__LANES && first + lane < nodes; lane++)
    values[(size_t)(first + lane) * (size_t)entries + (size_t)entry] = lanes[lane];
}

static void put(const ambulo_muscles *m, const ambulo__muscle_limb *limb,
                const ambulo__share_block *b, int first, int nodes,
                const ambulo_sharing_outputs *out) {
  const int d = m->model->coordinate_count;
  for (int j = 0; j < limb->coordinate_count; j++) {
    const int c = limb->coordinates[j], at = j * AMBULO__LANES;
    scatter(out->by_q, b->by_q + at, d, c, first, nodes);
    scatter(out->by_qd, b->by_qd + at, d, c, first, nodes);
    scatter(out->by_tau, b->by_tau + at, d, c, first, nodes);
    scatter(out->by_tau_rate, b->by_tau_rate + at, d, c, first, nodes);
    scatter(out->reserve, b->reserve + at, d, c, first, nodes);
  }
  for (int i = 0; i < limb->count; i++) {
    const int c = limb->strands[i].muscle, at = i * AMBULO__LANES;
    scatter(out->activation, b->activation + at, m->count, c, first, nodes);
    scatter(out->force, b->force + at, m->count, c, first, nodes);
    scatter(out->length, b->length + at, m->count, c, first, nodes);
    scatter(out->speed, b->speed + at, m->count, c, first, nodes);
  }
  for (int lane = 0; lane < AMBULO__LANES && first + lane < nodes; lane++) {
    int steps = (int)b->steps[lane], node = first + lane;
    if (out->cost) out->cost[node] += b->cost[lane];
    if (out->steps && steps > out->steps[node]) out->steps[node] = steps;
  }
}

static void fill(const ambulo_muscles *m, const ambulo__muscle_limb *limb,
                 const ambulo_sharing_states *states, int first,
                 double *const inputs[AMBULO__SHARE_INPUTS]) {
  const double *const given[] = {states->q, states->qd, states->tau, states->tau_rate};
  for (int k = 0; k < AMBULO__SHARE_INPUTS; k++)
    gather(inputs[k], given[k], m->model->coordinate_count, limb->coordinates,
           limb->coordinate_count, first, states->count);
}

/* ------------------------------------------------------------------ all */

static int is_finite(const ambulo_muscles *m, const double *values, int n) {
  const int d = m->model->coordinate_count;
  for (int c = 0; values && c < d; c++) {
    if (!ambulo__muscles_span(m, c)) continue;
    for (int k = 0; k < n; k++)
      if (!isfinite(values[(size_t)k * (size_t)d + (size_t)c])) return 0;
  }
  return 1;
}

static void clear(const ambulo_muscles *m, int n, const ambulo_sharing_outputs *out) {
  size_t all = (size_t)n * (size_t)m->model->coordinate_count;
  double *const by_coordinate[] = {out->by_q, out->by_qd, out->by_tau, out->by_tau_rate,
                                   out->reserve};
  for (size_t i = 0; i < sizeof by_coordinate / sizeof *by_coordinate; i++)
    if (by_coordinate[i]) memset(by_coordinate[i], 0, all * sizeof(double));
  if (out->cost) memset(out->cost, 0, (size_t)n * sizeof *out->cost);
  if (out->steps) memset(out->steps, 0, (size_t)n * sizeof *out->steps);
}

static int prices_are_sane(const ambulo_sharing *s) {
  return s->activation >= 0.0 && s->metabolic >= 0.0 && s->activation + s->metabolic > 0.0 &&
         s->reserve > 0.0 && isfinite(s->activation + s->metabolic + s->reserve);
}

static int states_are_finite(const ambulo_muscles *m, const ambulo_sharing_states *s) {
  return is_finite(m, s->q, s->count) && is_finite(m, s->qd, s->count) &&
         is_finite(m, s->tau, s->count) && is_finite(m, s->tau_rate, s->count);
}

ambulo_status ambulo_muscles_share(const ambulo_muscles *muscles, const ambulo_sharing *sharing,
                                   const ambulo_sharing_states *states,
                                   const ambulo_allocator *allocator,
                                   const ambulo_sharing_outputs *outputs) {
  ambulo_sharing own;
  ambulo_sharing_states given;
  ambulo_sharing_outputs out;
  if (!muscles || !states || !outputs || !AMBULO__OWN(ambulo_sharing, &own, sharing) ||
      !AMBULO__OWN(ambulo_sharing_states, &given, states) ||
      !AMBULO__OWN(ambulo_sharing_outputs, &out, outputs) || given.count < 1 || !given.q ||
      !given.qd || !given.tau || !prices_are_sane(&own))
    return AMBULO_E_ARGUMENT;
  if (!states_are_finite(muscles, &given)) return AMBULO_E_NUMERIC;
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  ambulo__share *share = NULL;
  ambulo_status status = ambulo__share_create(muscles, &own, &a, &share);
  if (status) return status;
  clear(muscles, given.count, &out);
  for (int first = 0; first < given.count; first += AMBULO__LANES)
    for (int i = 0; i < muscles->limb_count; i++) {
      ambulo__share_block block;
      double *inputs[AMBULO__SHARE_INPUTS];
      ambulo__share_begin(share, i, &block, inputs);
      fill(muscles, &muscles->limbs[i], &given, first, inputs);
      ambulo__share_end(share, i, &block);
      put(muscles, &muscles->limbs[i], &block, first, given.count, &out);
    }
  ambulo__share_free(share);
  return AMBULO_OK;
}
