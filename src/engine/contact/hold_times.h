/* contact/hold_times.h - when something is held: its window, and its events. */
#ifndef AMBULO_CONTACT_HOLD_TIMES_H
#define AMBULO_CONTACT_HOLD_TIMES_H

#include "ambulo/hold.h"

/* 1 where the window has a ramp at its beginning, at its end. */
int ambulo__hold_rises(const ambulo_hold *hold);
int ambulo__hold_falls(const ambulo_hold *hold, double duration);
/* w at a time of a motion that lasts `duration`. */
double ambulo__hold_window(const ambulo_hold *hold, double duration, double time);
/* w and its slopes, per s. */
typedef struct ambulo__hold_slopes {
  double value, by_time, by_from, by_to, by_ramp;
} ambulo__hold_slopes;
ambulo__hold_slopes ambulo__hold_slopes_at(const ambulo_hold *hold, double duration, double time);
/* Times inside (0, duration) at which the window begins or ends to change, time[4]; how many. */
int ambulo__hold_events(const ambulo_hold *hold, double duration, double time[4]);

#endif
