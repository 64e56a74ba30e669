/* gait/hold_times.h - when something is held: its window, and its events. */
#ifndef AMBULO_GAIT_HOLD_TIMES_H
#define AMBULO_GAIT_HOLD_TIMES_H

#include "ambulo/hold.h"

/* w at a time of a motion that lasts `duration`. */
double ambulo__hold_window(const ambulo_hold *hold, double duration, double time);
/* Times inside (0, duration) at which the window begins or ends to change, time[4]; how many. */
int ambulo__hold_events(const ambulo_hold *hold, double duration, double time[4]);

#endif
