/* base/clock.h - time that only goes forward. */
#ifndef AMBULO_BASE_CLOCK_H
#define AMBULO_BASE_CLOCK_H

/* Monotonic clock, s. */
double ambulo__seconds_now(void);

#endif
