/* problem/motion.c - the motion of given control points at any times.
 *
 * The same route as evaluate.c (linear map, forward recursion), on times of the caller's
 * choice, unpacked to node-major arrays. ZMP on the plane n . r = h (Eq. 16'):
 *
 *     p = (n x M + h F) / (n . F)
 */
#include "problem/nlp.h"
#include "base/sized.h"

#include "contact/devices.h"
#include "contact/contacts.h"

#include <math.h>
#include <string.h>

typedef struct dense {
  ambulo__lane_map *map;
  double *channel, *scratch, *ground, *factors, *room;
} dense;

static void dense_free(const ambulo_allocator *a, dense *d) {
  ambulo__lane_map_free(d->map);
  ambulo__free_aligned(a, d->channel);
  ambulo__free_aligned(a, d->scratch);
  ambulo__free_aligned(a, d->ground);
  ambulo__free_aligned(a, d->factors);
  ambulo__free_aligned(a, d->room);
}

static ambulo_status dense_create(const ambulo_problem *p, const ambulo_allocator *a,
                                  const double *times, int count, dense *d) {
  size_t channels = (size_t)ambulo__channel_count(&p->channels);
  size_t lanes = (size_t)ambulo__block_count(count) * AMBULO__LANES;
  d->channel = ambulo__alloc_aligned(a, channels * lanes, sizeof(double));
  d->scratch = ambulo__alloc_aligned(a, ambulo__plan_scratch(p->plan), sizeof(double));
  ambulo_status status =
      ambulo__lane_map_create(p->basis, times, count, p->coordinates, a, &d->map);
  d->room = ambulo__alloc_aligned(a, ambulo__device_scratch_size(p), sizeof(double));
  if (!status && (!d->channel || !d->scratch || !d->room)) status = AMBULO_E_MEMORY;
  if (!status) status = ambulo__ground_fill(p, a, times, count, &d->ground);
  if (!status) status = ambulo__devices_tell(&p->definition, a, times, count, &d->factors);
  return status;
}

/* copies channels [first, first + size) of every node to out[node][size] */
static int unpack(const dense *d, int channels, int first, int size, int count, double *out) {
  int finite = 1;
  for (int k = 0; out && k < count; k++) {
    for (int c = 0; c < size; c++) {
      double value = d->channel[ambulo__lane_index(k, channels, first + c)];
      out[(size_t)k * (size_t)size + (size_t)c] = value;
      finite &= isfinite(value) != 0;
    }
  }
  return finite;
}

/* (16') (n x M + h F) / (n.F) */
static void zero_moment_point(const double *n, double height, const double *wrench, double *zmp) {
  const double *m = wrench, *f = wrench + 3;
  double normal = n[0] * f[0] + n[1] * f[1] + n[2] * f[2];
  double cross[3] = {n[1] * m[2] - n[2] * m[1], n[2] * m[0] - n[0] * m[2],
                     n[0] * m[1] - n[1] * m[0]};
  for (int i = 0; i < 3; i++)
    zmp[i] = normal > 0.0 ? (cross[i] + height * f[i]) / normal : (double)NAN;
}

static void fill_zmp(const ambulo_problem *p, const dense *d, int channels, int count,
                     double *zmp) {
  for (int k = 0; k < count; k++) {
    double wrench[6];
    for (int c = 0; c < 6; c++) {
      int channel = ambulo__channel_moment(&p->channels, c);
      wrench[c] = d->channel[ambulo__lane_index(k, channels, channel)];
    }
    zero_moment_point(ambulo_model_up(p->model), p->definition.ground_height, wrench, zmp + 3 * k);
  }
}

/* where one foot or patch of sample k stands in the outputs of the caller */
typedef struct outputs {
  double *force, *cop, *free_moment, *moment;
} outputs;

static outputs outputs_of(const ambulo_model *m, const ambulo_motion *motion, int effector, int k) {
  int patch = ambulo__effector_patch(m, effector);
  outputs all = patch < 0
                    ? (outputs){motion->grf, motion->cop, motion->free_moment, motion->grf_moment}
                    : (outputs){motion->patch_force, motion->patch_cop, motion->patch_free_moment,
                                motion->patch_moment};
  size_t of = (size_t)(patch < 0 ? m->foot_count : m->patch_count);
  size_t at = (size_t)k * of + (size_t)(patch < 0 ? effector : patch);
  return (outputs){all.force ? all.force + 3 * at : NULL, all.cop ? all.cop + 3 * at : NULL,
                   all.free_moment ? all.free_moment + at : NULL,
                   all.moment ? all.moment + 3 * at : NULL};
}

/* of contacts that share the load */
static ambulo_status fill_contacts(const ambulo_problem *p, const dense *d,
                                   const ambulo_allocator *a, const double *times, int count,
                                   const ambulo_motion *motion) {
  int channels = ambulo__channel_count(&p->channels), effectors = ambulo__effector_count(p->model);
  ambulo__foot_outline *outlines = ambulo__foot_outlines(p->model, a);
  if (!outlines) return AMBULO_E_MEMORY;
  for (int at = 0; at < count * effectors; at++) {
    int k = at / effectors, effector = at % effectors;
    outputs out = outputs_of(p->model, motion, effector, k);
    if (!out.force && !out.cop && !out.free_moment && !out.moment) continue;
    const double *channel = d->channel + ambulo__lane_index(k, channels, 0);
    ambulo__pressure has = ambulo__contact_pressure(p, outlines, effector, times[k], channel);
    if (out.force) memcpy(out.force, has.force, sizeof has.force);
    if (out.cop) memcpy(out.cop, has.center, sizeof has.center);
    if (out.free_moment) *out.free_moment = has.free_moment;
    if (out.moment) memcpy(out.moment, has.moment, sizeof has.moment);
  }
  ambulo__free(a, outlines);
  return AMBULO_OK;
}

static void fill_none(int numbers, double *out) {
  for (int i = 0; out && i < numbers; i++) out[i] = NAN;
}

static ambulo_status fill_effectors(const ambulo_problem *p, const dense *d,
                                    const ambulo_allocator *a, const double *times, int count,
                                    const ambulo_motion *motion) {
  int feet = ambulo_model_foot_count(p->model), patches = ambulo_model_patch_count(p->model);
  if (p->channels.slots) return fill_contacts(p, d, a, times, count, motion);
  fill_none(3 * count * feet, motion->grf);
  fill_none(3 * count * feet, motion->cop);
  fill_none(count * feet, motion->free_moment);
  fill_none(3 * count * feet, motion->grf_moment);
  fill_none(3 * count * patches, motion->patch_force);
  fill_none(3 * count * patches, motion->patch_cop);
  fill_none(count * patches, motion->patch_free_moment);
  fill_none(3 * count * patches, motion->patch_moment);
  return AMBULO_OK;
}

/* effort, place and power of every device at sample k */
static void fill_devices(const ambulo_problem *p, const dense *d, int k,
                         const ambulo_motion *motion) {
  int channels = ambulo__channel_count(&p->channels), n = p->channels.devices;
  const double *q = d->channel + ambulo__lane_index(k, channels, 0);
  const double *factors = d->factors + ambulo__lane_index(k, ambulo__time_factor_entries(p), 0);
  for (int i = 0; i < n; i++) {
    ambulo__device_state state = ambulo__device_at(
        p->devices, i, q, q + (size_t)p->coordinates * AMBULO__LANES, factors, d->room);
    size_t at = (size_t)k * (size_t)n + (size_t)i;
    if (motion->device_effort) motion->device_effort[at] = state.effort;
    if (motion->device_along) motion->device_along[at] = state.along;
    if (motion->device_power) motion->device_power[at] = state.power;
  }
}

/* forces and moments of hands, and power, of every hold at sample k */
static void fill_holds(const ambulo_problem *p, const dense *d, int k,
                       const ambulo_motion *motion) {
  size_t d8 = (size_t)p->coordinates * AMBULO__LANES, n = (size_t)p->definition.hold_count;
  const double *q = d->channel + ambulo__lane_index(k, ambulo__channel_count(&p->channels), 0);
  const double *factors =
      d->factors + ambulo__lane_index(k, ambulo__time_factor_entries(p), p->channels.devices);
  ambulo__holds_keep(p->holds, q, q + d8, q + 2 * d8, factors, d->room);
  for (size_t i = 0; i < n; i++) {
    ambulo__hold_state state = ambulo__hold_at(p->holds, (int)i, d->room);
    size_t at = (size_t)k * n + i;
    if (motion->hold_force) memcpy(motion->hold_force + 6 * at, state.force, sizeof state.force);
    if (motion->hold_moment)
      memcpy(motion->hold_moment + 6 * at, state.moment, sizeof state.moment);
    if (motion->hold_power) motion->hold_power[at] = state.power;
  }
}

/* within the motion, but for rounding */
static int times_valid(const ambulo_problem *p, const double *times, int count) {
  double last = p->definition.duration, slack = 1e-9 * last;
  for (int k = 0; k < count; k++)
    if (!(times[k] >= -slack && times[k] <= last + slack)) return 0;
  return 1;
}

ambulo_status ambulo_problem_motion(const ambulo_problem *p, ambulo_workspace *workspace,
                                    const double *x, int count, const double *times,
                                    const ambulo_motion *motion) {
  ambulo_motion own;
  if (!p || !workspace || workspace->problem != p || !x || count < 1 || !times || !motion ||
      !AMBULO__OWN(ambulo_motion, &own, motion))
    return AMBULO_E_ARGUMENT;
  motion = &own;
  if (!times_valid(p, times, count)) return AMBULO_E_ARGUMENT;
  dense d = {NULL, NULL, NULL, NULL, NULL, NULL};
  const ambulo_allocator *a = &workspace->allocator;
  ambulo_status status = dense_create(p, a, times, count, &d);
  if (!status) {
    int channels = ambulo__channel_count(&p->channels), c = p->coordinates;
    size_t stride = (size_t)channels * AMBULO__LANES, d8 = (size_t)c * AMBULO__LANES;
    ambulo__lane_map_forward(d.map, x, d.channel, d.channel + d8, d.channel + 2 * d8, NULL, stride);
    for (int b = 0; b < ambulo__block_count(count); b++) {
      double *y = d.channel + (size_t)b * stride;
      ambulo__mechanics_block(p, d.ground, d.factors, b, y, d.scratch, d.room);
    }
    int finite = unpack(&d, channels, 0, c, count, motion->q);
    finite &= unpack(&d, channels, c, c, count, motion->qd);
    finite &= unpack(&d, channels, 2 * c, c, count, motion->qdd);
    finite &= unpack(&d, channels, 3 * c, c, count, motion->tau);
    finite &= unpack(&d, channels, 4 * c, 6, count, motion->wrench);
    finite &= unpack(&d, channels, 4 * c + 6, 3 * p->channels.points, count, motion->points);
    if (motion->zmp) fill_zmp(p, &d, channels, count, motion->zmp);
    for (int k = 0; p->devices && k < count; k++) fill_devices(p, &d, k, motion);
    for (int k = 0; p->holds && k < count; k++) fill_holds(p, &d, k, motion);
    status = fill_effectors(p, &d, a, times, count, motion);
    if (!status && !finite) status = AMBULO_E_NUMERIC;
  }
  dense_free(a, &d);
  return status;
}
