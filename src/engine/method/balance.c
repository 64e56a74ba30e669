/* method/balance.c - see balance.h. */
#include "method/balance.h"
#include "method/engine_point.h"

#include <math.h>

/* the gradients held, row i divided by `size` */
static void divide(ambulo__engine *e, int i, double size) {
  ambulo__rows_split *rows = &e->linearized.rows;
  e->iterate.lambda[i] *= size / rows->size[i];
  rows->size[i] = size;
  ambulo__sparse_rows_set_scale(&rows->inequality, i, -1.0 / size);
}

/* (P.15) v = -c / (s max(1, sqrt l)) */
void ambulo__balance_rows(ambulo__engine *e, const double *x) {
  ambulo__rows_split *rows = &e->linearized.rows;
  if (ambulo__evaluate_jacobian(e->workspace, x) ||
      ambulo__sparse_rows_fill(&rows->inequality, e->workspace, 0) ||
      ambulo__engine_fill_metric(e, e->iterate.mu))
    return;
  for (int i = 0; i < e->setup->inequalities; i++) {
    divide(e, i, rows->unit[i]);
    double length = ambulo__band_row_length(&e->linearized.base, &rows->inequality, i);
    if (length > 1.0 && isfinite(length)) divide(e, i, rows->unit[i] * sqrt(length));
  }
}
