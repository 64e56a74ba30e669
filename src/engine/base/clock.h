/* base/clock.h - the one clock: what budgets, reports and limits on time are measured by. */
#ifndef AMBULO_BASE_CLOCK_H
#define AMBULO_BASE_CLOCK_H

/* s since some fixed moment; never goes back. */
double ambulo__seconds_now(void);

#endif
