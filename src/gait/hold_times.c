/* gait/hold_times.c - see hold_times.h. */
#include "gait/hold_times.h"

#include "base/instant.h"
#include "base/vector.h"

/* 1 where a window has a ramp at its beginning, at its end */
static int rises(const ambulo_hold *hold) {
  return hold->from > AMBULO__INSTANT;
}

static int falls(const ambulo_hold *hold, double duration) {
  return hold->to < duration - AMBULO__INSTANT;
}

/* (H.5) S((t - from) / ramp) S((to - t) / ramp) */
double ambulo__hold_window(const ambulo_hold *hold, double duration, double time) {
  double window = 1.0;
  if (rises(hold)) window *= ambulo__smooth_step((time - hold->from) / hold->ramp);
  if (falls(hold, duration)) window *= ambulo__smooth_step((hold->to - time) / hold->ramp);
  return window;
}

int ambulo__hold_events(const ambulo_hold *hold, double duration, double time[4]) {
  int count = 0;
  if (rises(hold)) {
    time[count++] = hold->from;
    time[count++] = hold->from + hold->ramp;
  }
  if (falls(hold, duration)) {
    time[count++] = hold->to - hold->ramp;
    time[count++] = hold->to;
  }
  return count;
}
