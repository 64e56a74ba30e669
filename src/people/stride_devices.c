/* people/stride_devices.c - what devices do over a stride (stride.h).
 *
 * In the mirrored step a device does what its partner did, with the opposite sign at a coordinate
 * that the mirror turns round; power stays. Work by the trapezoidal rule on the samples.
 */
#include "people/stride.h"

#include <math.h>

ambulo_status ambulo__stride_devices_allocate(ambulo__stride *s) {
  size_t count = (size_t)s->samples * (size_t)s->devices;
  double **arrays[] = {&s->effort, &s->along, &s->power};
  for (int i = 0; s->devices && i < 3; i++) {
    *arrays[i] = ambulo__alloc(&s->allocator, count, sizeof(double));
    if (!*arrays[i]) return AMBULO_E_MEMORY;
  }
  return AMBULO_OK;
}

static void exchange(double *row, int a, int b, double sign) {
  double own = row[a];
  row[a] = sign * row[b];
  if (a != b) row[b] = sign * own;
}

void ambulo__stride_devices_mirror(ambulo__stride *s, int k) {
  size_t at = (size_t)k * (size_t)s->devices;
  for (int i = 0; i < s->devices; i++) {
    double sign;
    int partner = ambulo__device_partner(&s->problem->definition, i, &sign);
    if (partner < i) continue;
    exchange(s->effort + at, i, partner, sign);
    exchange(s->along + at, i, partner, sign);
    exchange(s->power + at, i, partner, 1.0);
  }
}

ambulo__device_work ambulo__stride_device_work(const ambulo__stride *s, int device) {
  ambulo__device_work work = {0.0, 0.0, 0.0};
  for (int k = 0; k < s->samples; k++) {
    size_t at = (size_t)k * (size_t)s->devices + (size_t)device;
    double before = k > 0 ? s->times[k] - s->times[k - 1] : 0.0;
    double after = k + 1 < s->samples ? s->times[k + 1] - s->times[k] : 0.0;
    double part = 0.5 * (before + after) * s->power[at];
    *(part > 0.0 ? &work.positive : &work.negative) += part;
    if (fabs(s->effort[at]) > fabs(work.peak)) work.peak = s->effort[at];
  }
  return work;
}
