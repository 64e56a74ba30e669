/* contact/load_profile.h - what devices are told about time: the window of a clutch times the
 * profile. */
#ifndef AMBULO_CONTACT_LOAD_PROFILE_H
#define AMBULO_CONTACT_LOAD_PROFILE_H

#include "ambulo/problem.h"
#include "base/alloc.h"

/* One device's factor at a time, with its slopes by the time, and by the strikes that begin and end
 * the stride (contact/stride_clock.h), per s; `contact`: with whose `from` they are, -1: none. */
typedef struct ambulo__device_told {
  double factor, by_time, by_strike[2];
  double strike[2]; /* s */
  int contact[2];
  double by_from, by_to, by_ramp; /* of a clutch */
} ambulo__device_told;

ambulo__device_told ambulo__device_told_at(const ambulo_problem_definition *definition, int device,
                                           double time);

/* At `count` times, [blocks][devices and holds][8]: factors of the devices, then the windows of
 * what hands hold (contact/hold_times.h), padded with the last; freed with ambulo__free_aligned.
 * *told is NULL without either. E_MEMORY. */
ambulo_status ambulo__devices_tell(const ambulo_problem_definition *definition,
                                   const ambulo_allocator *allocator, const double *times,
                                   int count, double **told);

/* The cubic through points [count][2], rising, at x: that of Fritsch & Carlson, which stays between
 * them, and its slope. period > 0: it repeats after that; 0: beyond its ends it is constant. */
double ambulo__device_curve(const double (*points)[2], int count, double period, double x,
                            double *slope);

#endif
