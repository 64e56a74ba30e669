/* people/inverse_span.c - which rows of a motion are used: those that are asked for, and of them
 * those at which there are forces (inverse.h).
 *
 * Rates, accelerations and filters are those of the whole motion; its rows are left out afterwards,
 * so that a part of a recording has the torques that it has in the whole. */
#include "people/inverse.h"

#include <math.h>
#include <string.h>

enum { FEWEST = 4 };
static const double least_share = 0.1; /* of the motion: forces over less are another's */

static void keep_rows(ambulo__inverse *v, int first, int count) {
  size_t d = (size_t)ambulo_model_coordinate_count(v->model), columns = (size_t)v->given->columns;
  size_t from = (size_t)first, rows = (size_t)count;
  double *const states[] = {v->q, v->qd, v->qdd};
  for (int i = 0; i < 3; i++)
    memmove(states[i], states[i] + from * d, rows * d * sizeof *states[i]);
  memmove(v->given->time, v->given->time + from, rows * sizeof *v->given->time);
  memmove(v->given->values, v->given->values + from * columns,
          rows * columns * sizeof *v->given->values);
  v->rows = v->given->rows = count;
}

/* the rows within [from, to], their first in *first; their number */
static int rows_between(const ambulo__inverse *v, double from, double to, int *first) {
  double slack = 1e-9 * fmax(1.0, fabs(v->given->time[v->rows - 1]));
  int count = 0;
  for (int k = 0; k < v->rows; k++) {
    if (v->given->time[k] < from - slack || v->given->time[k] > to + slack) continue;
    if (count++ == 0) *first = k;
  }
  return count;
}

ambulo_status ambulo__inverse_take_span(ambulo__inverse *v) {
  double begin = v->given->time[0], end = v->given->time[v->rows - 1];
  double from = isnan(v->options.from) ? begin : v->options.from;
  double to = isnan(v->options.to) ? end : v->options.to;
  ambulo__place place = {.file = v->file};
  int first = 0, count = rows_between(v, from, to, &first);
  if (count == 0)
    return ambulo__error(v->doubts.diagnostics, AMBULO_E_SCHEMA, place, "--from S, --to S",
                         "no rows from %g to %g s; the motion lasts from %g to %g s", from, to,
                         begin, end);
  if (count < v->rows) keep_rows(v, first, count);
  return AMBULO_OK;
}

ambulo_status ambulo__inverse_take_covered(ambulo__inverse *v) {
  const ambulo__motion *forces = v->force_table;
  double unit = v->options.force_time_unit, begin = v->given->time[0],
         end = v->given->time[v->rows - 1];
  if (!forces || forces->rows < 2) return AMBULO_OK;
  double first_force = unit * forces->time[0], last_force = unit * forces->time[forces->rows - 1];
  double from = fmax(begin, first_force), to = fmin(end, last_force);
  double slack = 1e-6 * (end - begin);
  if (from <= begin + slack && to >= end - slack) return AMBULO_OK;
  int first = 0, count = rows_between(v, from, to, &first);
  /* too little in common: units, or another trial; who reads the forces says so */
  if (count < FEWEST || to - from < least_share * (end - begin)) return AMBULO_OK;
  ambulo__doubt(&v->doubts, v->options.forces, "--from and --to choose the rows",
                "forces from %g to %g s, the motion from %g to %g s: its rows from %g to %g s are "
                "used",
                first_force, last_force, begin, end, v->given->time[first],
                v->given->time[first + count - 1]);
  keep_rows(v, first, count);
  return AMBULO_OK;
}
