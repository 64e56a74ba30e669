/* people/filtering.c - see filtering.h. */
#include "people/filtering.h"

#include <math.h>

#include "trajectory/butterworth.h"

/* the largest way of a time from where equal steps put it, in steps; *at: its row */
static double unevenness(const ambulo__filtering *f, double step, int *at) {
  double worst = 0.0;
  *at = 0;
  for (int k = 0; k < f->rows; k++) {
    double away = fabs(f->time[k] - f->time[0] - (double)k * step) / step;
    if (away <= worst) continue;
    worst = away;
    *at = k;
  }
  return worst;
}

ambulo_status ambulo__filter(const ambulo__filtering *f, double *values, int columns,
                             const ambulo_allocator *allocator) {
  ambulo__place place = {.file = f->file};
  int at = 0;
  double span = f->rows > 1 ? f->time[f->rows - 1] - f->time[0] : 0.0;
  double step = f->rows > 1 ? span / (double)(f->rows - 1) : 0.0;
  if (!(step > 0.0))
    return ambulo__error(f->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                         "%s needs rows of several times", f->option);
  if (unevenness(f, step, &at) > 0.1)
    return ambulo__error(
        f->diagnostics, AMBULO_E_SCHEMA, place, "resample the file first",
        "%s needs equally spaced times; with steps of %g s, t = %g s would be %g s", f->option,
        f->time_unit * step, f->time_unit * f->time[at],
        f->time_unit * (f->time[0] + (double)at * step));
  double rate = 1.0 / (f->time_unit * step);
  if (!(f->cutoff < 0.5 * rate))
    return ambulo__error(f->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                         "%s is %g Hz; expected less than half the %g rows a second", f->option,
                         f->cutoff, rate);
  return ambulo__butterworth(values, f->rows, columns, rate, f->cutoff, f->order, allocator);
}
