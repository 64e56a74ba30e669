/* contact/load_profile.c - see stride_clock.h.
 *
 *     share = (t - b) / (b' - b),   b, b' the beginnings of the stances around t
 */
#include "contact/devices.h"

#include "base/arithmetic.h"
#include "base/lanes.h"
#include "contact/contacts.h"

#include <math.h>

int ambulo__stride_at(const ambulo_problem_definition *d, int foot, double time,
                      ambulo__stride_now *now) {
  int last = ambulo__image_periods(d) + 1; /* the stride that begins at T ends 3 T after 0 */
  *now = (ambulo__stride_now){{-INFINITY, INFINITY}, {-1, -1}, 0.0};
  if (d->ends == AMBULO_ENDS_FREE) return 0;
  for (int i = 0; i < d->contact_count; i++) {
    for (int period = -last; period <= last; period++) {
      if (ambulo__image_effector(d, i, period) != foot) continue;
      ambulo__span image = ambulo__image_span(d, i, period);
      ambulo__span span = ambulo__uninterrupted(d, foot, AMBULO__ANY_MODE, image);
      int side = span.from > time + AMBULO__INSTANT;
      if (side ? span.from >= now->begin[1] : span.from <= now->begin[0]) continue;
      now->begin[side] = span.from;
      now->contact[side] = span.begins;
    }
  }
  if (now->contact[0] < 0 || now->contact[1] < 0) return 0;
  double share = (time - now->begin[0]) / (now->begin[1] - now->begin[0]);
  now->share = share > 0.0 ? share : 0.0;
  return 1;
}

/*
 * With u = (t - from) / ramp, v = (to - t) / ramp, S' = 6 u (1 - u) inside of (0, 1):
 *
 *     dw/dfrom = -S'(u) S(v) / ramp,   dw/dto = S(u) S'(v) / ramp,   dw/dt = -dw/dfrom - dw/dto
 *     dw/dramp = -(u S'(u) S(v) + v S(u) S'(v)) / ramp
 */

int ambulo__hold_rises(const ambulo_hold *hold) {
  return hold->from > AMBULO__INSTANT;
}

int ambulo__hold_falls(const ambulo_hold *hold, double duration) {
  return hold->to < duration - AMBULO__INSTANT;
}

/* (H.5) S((t - from) / ramp) S((to - t) / ramp) */
double ambulo__hold_window(const ambulo_hold *hold, double duration, double time) {
  double window = 1.0;
  if (ambulo__hold_rises(hold)) window *= ambulo__smooth_step((time - hold->from) / hold->ramp);
  if (ambulo__hold_falls(hold, duration))
    window *= ambulo__smooth_step((hold->to - time) / hold->ramp);
  return window;
}

int ambulo__hold_events(const ambulo_hold *hold, double duration, double time[4]) {
  int count = 0;
  if (ambulo__hold_rises(hold)) {
    time[count++] = hold->from;
    time[count++] = hold->from + hold->ramp;
  }
  if (ambulo__hold_falls(hold, duration)) {
    time[count++] = hold->to - hold->ramp;
    time[count++] = hold->to;
  }
  return count;
}

/*
 * With the share s of the stride, b and b' the strikes around t (contact/devices.h),
 *
 *     factor = w(s) f,   w = S(v / r) S((l - v) / r),   v = s - from and l = to - from, modulo 1
 *     dw/dt = w' / (b' - b),   dw/db = -w' (1 - s) / (b' - b),   dw/db' = -w' s / (b' - b)
 *
 * S(u) = u^2 (3 - 2 u), r the ramp, f the profile: a cubic Hermite spline with the slopes m_i of
 * Fritsch & Butland (1984), the weighted harmonic means of neighbouring secants, 0 where these have
 * not one sign: no overshoot.
 */

/* ---------------------------------------------------------------- profile */

typedef struct curve {
  const double (*points)[2];
  int count;
  double period;
} curve;

/* point i of a curve that repeats or ends, i from -1 to count */
static void point_of(const curve *c, int i, double point[2]) {
  int n = c->count, turn = i < 0 ? -1 : i >= n ? 1 : 0, at = i - turn * n;
  if (c->period == 0.0) {
    at = i < 0 ? 0 : i < n ? i : n - 1;
    turn = 0;
  }
  point[0] = c->points[at][0] + turn * c->period;
  point[1] = c->points[at][1];
}

/* m_i; between a and c, at b */
static double knot_slope(const double a[2], const double b[2], const double c[2]) {
  double before = b[0] - a[0], after = c[0] - b[0];
  if (!(before > 0.0) || !(after > 0.0)) return 0.0; /* the end of a curve that does not repeat */
  double left = (b[1] - a[1]) / before, right = (c[1] - b[1]) / after;
  double w = 2.0 * after + before, v = after + 2.0 * before;
  return left * right > 0.0 ? (w + v) / (w / left + v / right) : 0.0;
}

/* (D.8) between points i and i + 1 */
static double hermite(const curve *c, int i, double x, double *slope) {
  double p[4][2];
  for (int k = 0; k < 4; k++) point_of(c, i - 1 + k, p[k]);
  double h = p[2][0] - p[1][0], u = (x - p[1][0]) / h, rise = p[2][1] - p[1][1];
  double m = h * knot_slope(p[0], p[1], p[2]), n = h * knot_slope(p[1], p[2], p[3]);
  *slope = (m + 2.0 * u * (3.0 * rise - 2.0 * m - n) + 3.0 * u * u * (m + n - 2.0 * rise)) / h;
  return p[1][1] + u * (m + u * (3.0 * rise - 2.0 * m - n + u * (m + n - 2.0 * rise)));
}

double ambulo__device_curve(const double (*points)[2], int count, double period, double x,
                            double *slope) {
  const curve c = {points, count, period};
  *slope = 0.0;
  if (count == 1) return points[0][1];
  if (period > 0.0) x -= period * floor((x - points[0][0]) / period);
  if (period == 0.0 && x <= points[0][0]) return points[0][1];
  if (period == 0.0 && x >= points[count - 1][0]) return points[count - 1][1];
  int i = count - 1;
  while (i > 0 && x < points[i][0]) i--;
  return i == count - 1 && period == 0.0 ? points[i][1] : hermite(&c, i, x, slope);
}

/* ----------------------------------------------------------------- window */

static double step_of(double u, double *slope) {
  u = u > 1.0 ? 1.0 : u > 0.0 ? u : 0.0;
  *slope = 6.0 * u * (1.0 - u);
  return u * u * (3.0 - 2.0 * u);
}

static double fraction(double x) {
  return x - floor(x);
}

typedef struct window {
  double value, by_share, by_from, by_to, by_ramp;
} window;

/* (D.8) w and its slopes */
static window window_of(const ambulo_device *device, double share) {
  double length = fraction(device->to - device->from), v = fraction(share - device->from);
  double r = device->ramp, rise, fall;
  if (v > length) return (window){0.0, 0.0, 0.0, 0.0, 0.0};
  double up = step_of(v / r, &rise), down = step_of((length - v) / r, &fall);
  double since = rise * down / r, until = up * fall / r; /* by v, by l - v */
  return (window){up * down, since - until, -since, until, -(since * v + until * (length - v)) / r};
}

ambulo__device_told ambulo__device_told_at(const ambulo_problem_definition *d, int device,
                                           double time) {
  const ambulo_device *one = &d->devices[device];
  ambulo__device_told told = {.factor = 1.0, .contact = {-1, -1}};
  int profiled = one->kind == AMBULO_DEVICE_ACTUATOR;
  double value = 1.0, slope = 0.0;
  if (profiled && one->clock == AMBULO_DEVICE_BY_TIME)
    value = ambulo__device_curve(one->points, one->point_count, 0.0, time, &slope);
  int by_stride = profiled && one->clock == AMBULO_DEVICE_BY_STRIDE;
  told.factor = value;
  told.by_time = slope;
  ambulo__stride_now now;
  if (!by_stride && !one->clutch) return told;
  if (!ambulo__stride_at(d, one->foot, time, &now)) /* device_check.c refuses that */
    return (ambulo__device_told){.contact = {-1, -1}};
  double profile = 1.0, change = 0.0, stride = now.begin[1] - now.begin[0];
  window w = {.value = 1.0};
  if (one->clutch) w = window_of(one, now.share);
  if (by_stride)
    profile = ambulo__device_curve(one->points, one->point_count, 1.0, now.share, &change);
  double by_share = value * (w.by_share * profile + w.value * change) / stride;
  told.factor = value * w.value * profile;
  told.by_time = slope * w.value * profile + by_share;
  told.by_from = value * profile * w.by_from;
  told.by_to = value * profile * w.by_to;
  told.by_ramp = value * profile * w.by_ramp;
  told.by_strike[0] = -by_share * (1.0 - now.share);
  told.by_strike[1] = -by_share * now.share;
  for (int i = 0; i < 2; i++) {
    told.strike[i] = now.begin[i];
    told.contact[i] = now.contact[i];
  }
  return told;
}

ambulo_status ambulo__devices_tell(const ambulo_problem_definition *d, const ambulo_allocator *a,
                                   const double *times, int count, double **told) {
  *told = NULL;
  int devices = d->device_count, n = devices + d->hold_count;
  if (n == 0) return AMBULO_OK;
  int padded = ambulo__block_count(count) * AMBULO__LANES;
  double *factors = ambulo__alloc_aligned(a, (size_t)padded * (size_t)n, sizeof *factors);
  if (!factors) return AMBULO_E_MEMORY;
  for (int k = 0; k < padded; k++) {
    double time = times[k < count ? k : count - 1];
    for (int i = 0; i < d->hold_count; i++)
      factors[ambulo__lane_index(k, n, devices + i)] =
          ambulo__hold_window(&d->holds[i], d->duration, time);
    for (int i = 0; i < devices; i++)
      factors[ambulo__lane_index(k, n, i)] = ambulo__device_told_at(d, i, time).factor;
  }
  *told = factors;
  return AMBULO_OK;
}
