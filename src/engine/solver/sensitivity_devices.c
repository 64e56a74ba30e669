/* solver/sensitivity_devices.c - the numbers of devices, through their efforts.
 *
 * With e and y the adjoints of an effort E and of the torques, z = sum y_i ds/dq_i and g of
 * contact/devices.h, a change of E at a node changes L by c = e - g z, for tau_i loses g E s_i:
 *
 *     number p of the law        c dE/dp
 *     what the device is told    c (E / f) df:  from, to, ramp; the node's time, the strikes around
 *     duration T                 c (E / f) (f_t t + f_b b + f_b' b') / T, contacts at fixed
 *                                fractions of T, profiles by time in seconds
 *     all masses alike           tau + sum g E s is what is as large as they are: sum g E z
 */
#include "solver/partials.h"

#include "contact/load_profile.h"

typedef struct device_pull {
  const ambulo__stationary *s;
  int node, device;
  double pull; /* c */
  const ambulo__effort *effort;
} device_pull;

static void add_law(const device_pull *d, double *by) {
  const ambulo__effort *e = d->effort;
  by[AMBULO__DEVICE_STIFFNESS] += d->pull * e->by_stiffness;
  by[AMBULO__DEVICE_REST] += d->pull * e->by_rest;
  by[AMBULO__DEVICE_PRETENSION] += d->pull * e->by_pretension;
  by[AMBULO__DEVICE_SMOOTHING] += d->pull * e->by_smoothing;
  by[AMBULO__DEVICE_DAMPING] += d->pull * e->by_damping;
  by[AMBULO__DEVICE_AMOUNT] += d->pull * e->by_amount;
}

static void add_told(const device_pull *d, const ambulo__device_told *told, double *by,
                     ambulo__partials *partials) {
  const ambulo_problem *p = d->s->problem;
  double pull = d->pull * d->effort->by_factor, duration = p->definition.duration;
  by[AMBULO__DEVICE_FROM] += pull * told->by_from;
  by[AMBULO__DEVICE_TO] += pull * told->by_to;
  by[AMBULO__DEVICE_RAMP] += pull * told->by_ramp;
  partials->node_time[d->node] += pull * told->by_time;
  partials->duration += pull * told->by_time * p->times[d->node] / duration;
  for (int i = 0; i < 2; i++) {
    if (told->contact[i] < 0) continue;
    partials->contact_time[2 * told->contact[i]] += pull * told->by_strike[i];
    partials->duration += pull * told->by_strike[i] * told->strike[i] / duration;
  }
}

static void add_device(const ambulo__stationary *s, int node, int device, double *scratch,
                       ambulo__partials *partials) {
  const ambulo_problem *p = s->problem;
  const ambulo_workspace *w = s->workspace;
  const ambulo_device *of = &p->definition.devices[device];
  const double *q = w->channel + ambulo__lane_index(node, w->channel_count, 0);
  const double *qd = q + (size_t)p->coordinates * AMBULO__LANES;
  const double *y =
      w->weight + ambulo__lane_index(node, w->channel_count, ambulo__channel_tau(&p->channels, 0));
  ambulo__device_told told = ambulo__device_told_at(&p->definition, device, p->times[node]);
  ambulo__device_state state =
      ambulo__device_at(p->devices, device, q, qd,
                        p->time_factors + ambulo__lane_index(node, ambulo__time_factor_entries(p), 0), scratch);
  ambulo__effort effort = ambulo__effort_of(of, state.along, state.rate, told.factor);
  double pull = ambulo__device_pull(p->devices, device, q, y, scratch);
  double own = ambulo__stationary_adjoint(s, node, ambulo__channel_effort(&p->channels, device));
  const device_pull d = {s, node, device, own - pull, &effort};
  double *by = partials->device + (size_t)device * AMBULO__DEVICE_NUMBERS;
  add_law(&d, by);
  add_told(&d, &told, by, partials);
  partials->of_others += pull * effort.value;
}

/* (S.20) c dE/dp */
ambulo_status ambulo__partials_of_devices(const ambulo__stationary *s, ambulo__pool *pool,
                                          ambulo__partials *partials) {
  const ambulo_problem *p = s->problem;
  double *scratch = ambulo__pool_doubles(pool, ambulo__devices_scratch(p->devices));
  if (pool->failed) return AMBULO_E_MEMORY;
  for (int node = 0; node < p->nodes; node++) {
    for (int i = 0; i < p->channels.devices; i++) add_device(s, node, i, scratch, partials);
  }
  return AMBULO_OK;
}
