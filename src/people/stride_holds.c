/* people/stride_holds.c - forces of hands over a stride (stride.h).
 *
 * In the mirrored step hands take one another's place: a force loses the part to the left twice, a
 * moment, which the mirror turns round, that in the mirror's plane. Work by the trapezoidal rule on
 * the samples.
 */
#include "people/stride.h"

#include "base/vector.h"

#include <math.h>

ambulo_status ambulo__stride_holds_allocate(ambulo__stride *s) {
  size_t count = (size_t)s->samples * (size_t)s->holds;
  if (s->holds == 0) return AMBULO_OK;
  s->hold_force = ambulo__alloc(&s->allocator, 6 * count, sizeof(double));
  s->hold_moment = ambulo__alloc(&s->allocator, 6 * count, sizeof(double));
  s->hold_power = ambulo__alloc(&s->allocator, count, sizeof(double));
  return s->hold_force && s->hold_moment && s->hold_power ? AMBULO_OK : AMBULO_E_MEMORY;
}

/* v - 2 (v . l) l, with a sign of its own */
static void reflect(const double left[3], double sign, double v[3]) {
  double part = 2.0 * ambulo__dot(left, v);
  for (int k = 0; k < 3; k++) v[k] = sign * (v[k] - part * left[k]);
}

static void exchange(const double left[3], double sign, double pair[6]) {
  for (int k = 0; k < 3; k++) {
    double own = pair[k];
    pair[k] = pair[3 + k];
    pair[3 + k] = own;
  }
  reflect(left, sign, pair);
  reflect(left, sign, pair + 3);
}

void ambulo__stride_holds_mirror(ambulo__stride *s, int k) {
  for (int i = 0; i < s->holds; i++) {
    size_t at = 6 * ((size_t)k * (size_t)s->holds + (size_t)i);
    if (s->problem->definition.holds[i].hand[1] < 0) {
      reflect(s->model->left, 1.0, s->hold_force + at);
      continue;
    }
    exchange(s->model->left, 1.0, s->hold_force + at);
    exchange(s->model->left, -1.0, s->hold_moment + at);
  }
}

ambulo__hand_peak ambulo__stride_hand_peak(const ambulo__stride *s, int hold, int hand) {
  ambulo__hand_peak peak = {0.0, 0.0, 0.0, 0.0};
  for (int k = 0; k < s->samples; k++) {
    size_t at = 6 * ((size_t)k * (size_t)s->holds + (size_t)hold) + 3 * (size_t)hand;
    const double *f = s->hold_force + at, *m = s->hold_moment + at;
    double force = sqrt(ambulo__dot(f, f)), moment = sqrt(ambulo__dot(m, m));
    if (force > peak.force) peak.force_time = s->times[k];
    if (moment > peak.moment) peak.moment_time = s->times[k];
    peak.force = fmax(peak.force, force);
    peak.moment = fmax(peak.moment, moment);
  }
  return peak;
}

void ambulo__stride_hold_work(const ambulo__stride *s, int hold, double work[2]) {
  work[0] = work[1] = 0.0;
  for (int k = 0; k < s->samples; k++) {
    double before = k > 0 ? s->times[k] - s->times[k - 1] : 0.0;
    double after = k + 1 < s->samples ? s->times[k + 1] - s->times[k] : 0.0;
    double power = s->hold_power[(size_t)k * (size_t)s->holds + (size_t)hold];
    work[power > 0.0 ? 0 : 1] += 0.5 * (before + after) * power;
  }
}
