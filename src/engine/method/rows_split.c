/* method/rows_split.c - see rows_split.h. */
#include "method/rows_split.h"

#include <math.h>
#include <string.h>

static const double least_gradient = 1e-6; /* of a row of the caller, where it vanishes */

/* what an inequality is divided by: see rows_split.h */
double ambulo__rows_size(const ambulo_problem *p, const ambulo__sparse_rows *s, int i) {
  const ambulo__table_row *row = &p->table.rows[s->row[i]];
  if (row->user < 0 || row->kind != AMBULO__KIND_USER) return row->size;
  double norm = ambulo__sparse_rows_norm(s, i);
  return norm >= least_gradient ? norm : least_gradient;
}

int ambulo__rows_contradict(const ambulo__rows_split *rows, int count) {
  for (int r = 0; r < count; r++) {
    if (rows->rank[r] == AMBULO__ROW_CONTRADICTORY) return 1;
  }
  return 0;
}

typedef struct lists {
  int *equality, *border, *inequality;
  int equalities, borders, inequalities;
} lists;

static void classify(const ambulo_problem *p, const int *rank, lists *l, ambulo__rows_split *out) {
  out->regular = 1;
  out->dropped = 0;
  for (int r = 0; r < p->rows; r++) {
    int host = ambulo__row_host(p, r);
    if (p->table.rows[r].relation == AMBULO_NOT_NEGATIVE) {
      l->inequality[l->inequalities++] = r;
      if (host < 0) out->regular = 0;
    } else if (rank[r] != AMBULO__ROW_INDEPENDENT) {
      out->dropped++;
    } else if (host >= 0) {
      l->equality[l->equalities++] = r;
    } else {
      l->border[l->borders++] = r;
    }
  }
}

ambulo_status ambulo__rows_split_create(const ambulo_problem *p, ambulo_workspace *workspace,
                                        const double *start, ambulo__run *run, ambulo__pool *pool,
                                        ambulo_diagnostics *diagnostics, ambulo__rows_split *out) {
  size_t rows = (size_t)p->rows;
  out->rank = ambulo__pool_ints(pool, rows);
  lists l = {.equality = ambulo__pool_ints(pool, rows),
             .border = ambulo__pool_ints(pool, rows),
             .inequality = ambulo__pool_ints(pool, rows)};
  if (pool->failed) return AMBULO_E_MEMORY;
  ambulo_status status =
      ambulo__presolve_rank(p, workspace, start, run, pool, diagnostics, out->rank);
  if (status) return status;
  classify(p, out->rank, &l, out);
  ambulo__poll poll = ambulo__run_poller(run);
  status = ambulo__sparse_rows_create(p, l.equality, l.equalities, &poll, pool, &out->equality);
  if (!status)
    status = ambulo__sparse_rows_create(p, l.border, l.borders, &poll, pool, &out->border);
  if (!status)
    status =
        ambulo__sparse_rows_create(p, l.inequality, l.inequalities, &poll, pool, &out->inequality);
  if (!status) status = ambulo__sparse_rows_lay_blocks(&out->inequality, pool);
  if (!status) status = ambulo__evaluate_jacobian(workspace, start);
  if (status) return status;
  /* gradients that are not finite here are met again, and named, by whoever works with them */
  (void)ambulo__sparse_rows_fill(&out->equality, workspace, 1);
  (void)ambulo__sparse_rows_fill(&out->border, workspace, 1);
  (void)ambulo__sparse_rows_fill(&out->inequality, workspace, 1);
  out->unit = ambulo__pool_doubles(pool, (size_t)l.inequalities);
  out->size = ambulo__pool_doubles(pool, (size_t)l.inequalities);
  if (pool->failed) return AMBULO_E_MEMORY;
  for (int i = 0; i < l.inequalities; i++) {
    out->size[i] = out->unit[i] = ambulo__rows_size(p, &out->inequality, i);
    ambulo__sparse_rows_set_scale(&out->inequality, i, -1.0 / out->size[i]);
  }
  return AMBULO_OK;
}
