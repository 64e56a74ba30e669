/* contact/load_profile.h - where a foot is in its stride, from its strike to the next. */
#ifndef AMBULO_CONTACT_LOAD_PROFILE_H
#define AMBULO_CONTACT_LOAD_PROFILE_H

#include "ambulo/hold.h"
#include "ambulo/problem.h"
#include "base/alloc.h"

typedef struct ambulo__stride_now {
  double begin[2]; /* s: the strike at or before the time (within 1e-9 s), and the next; may lie
                      outside [0, T] */
  int contact[2];  /* with whose `from` they begin */
  double share;    /* of the stride, 0 to 1 */
} ambulo__stride_now;

/* In a motion that repeats; 0 where the foot does not strike. */
int ambulo__stride_at(const ambulo_problem_definition *definition, int foot, double time,
                      ambulo__stride_now *now);

/* when something is held: its window, and its events. */

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

/* what devices are told about time: the window of a clutch times the
 * profile. */

/* One device's factor at a time, with its slopes by the time, and by the strikes that begin and end
 * the stride (contact/load_profile.h), per s; `contact`: with whose `from` they are, -1: none. */
typedef struct ambulo__device_told {
  double factor, by_time, by_strike[2];
  double strike[2]; /* s */
  int contact[2];
  double by_from, by_to, by_ramp; /* of a clutch */
} ambulo__device_told;

ambulo__device_told ambulo__device_told_at(const ambulo_problem_definition *definition, int device,
                                           double time);

/* At `count` times, [blocks][devices and holds][8]: factors of the devices, then the windows of
 * what hands hold (contact/load_profile.h), padded with the last; freed with ambulo__free_aligned.
 * *told is NULL without either. E_MEMORY. */
ambulo_status ambulo__devices_tell(const ambulo_problem_definition *definition,
                                   const ambulo_allocator *allocator, const double *times,
                                   int count, double **told);

/* The cubic through points [count][2], rising, at x: that of Fritsch & Carlson, which stays between
 * them, and its slope. period > 0: it repeats after that; 0: beyond its ends it is constant. */
double ambulo__device_curve(const double (*points)[2], int count, double period, double x,
                            double *slope);

#endif
