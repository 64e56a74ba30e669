/* contact/hold_times.c - see hold_times.h.
 *
 * With u = (t - from) / ramp, v = (to - t) / ramp, S' = 6 u (1 - u) inside of (0, 1):
 *
 *     dw/dfrom = -S'(u) S(v) / ramp,   dw/dto = S(u) S'(v) / ramp,   dw/dt = -dw/dfrom - dw/dto
 *     dw/dramp = -(u S'(u) S(v) + v S(u) S'(v)) / ramp
 */
#include "contact/hold_times.h"

#include "base/arithmetic.h"

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

/* S'(u) */
static double step_slope(double u) {
  return u > 0.0 && u < 1.0 ? 6.0 * u * (1.0 - u) : 0.0;
}

/* (H.6) dw by the time, from, to and ramp */
ambulo__hold_slopes ambulo__hold_slopes_at(const ambulo_hold *hold, double duration, double time) {
  double u = (time - hold->from) / hold->ramp, v = (hold->to - time) / hold->ramp;
  double up = 1.0, down = 1.0, rise = 0.0, fall = 0.0;
  if (ambulo__hold_rises(hold)) {
    up = ambulo__smooth_step(u);
    rise = step_slope(u) / hold->ramp;
  }
  if (ambulo__hold_falls(hold, duration)) {
    down = ambulo__smooth_step(v);
    fall = step_slope(v) / hold->ramp;
  }
  ambulo__hold_slopes w = {.value = up * down, .by_from = -rise * down, .by_to = up * fall};
  w.by_time = -w.by_from - w.by_to;
  if (rise != 0.0) w.by_ramp -= u * rise * down;
  if (fall != 0.0) w.by_ramp -= v * fall * up;
  return w;
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
