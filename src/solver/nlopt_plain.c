/* solver/nlopt_plain.c - presolve: off. The problem as it stands, every family of rows
 * handed straight to NLopt, unscaled but for sign: for small problems and for comparison. */
#include "solver/nlopt_direct.h"

#include <math.h>
#include <string.h>

static ambulo_status create_sets(const ambulo_problem *p, const double *x, ambulo__pool *pool,
                                 ambulo__direct *d, ambulo__sparse_rows sets[2]) {
  int counts[2] = {0, 0};
  int *list[2] = {ambulo__pool_ints(pool, (size_t)p->rows),
                  ambulo__pool_ints(pool, (size_t)p->rows)};
  if (pool->failed) return AMBULO_E_MEMORY;
  for (int r = 0; r < p->rows; r++) {
    int which = p->table.rows[r].relation == AMBULO_NOT_NEGATIVE;
    list[which][counts[which]++] = r;
  }
  ambulo_status status = ambulo__evaluate_jacobian(d->workspace, x);
  for (int s = 0; s < 2 && !status; s++) {
    status = ambulo__sparse_rows_create(p, list[s], counts[s], pool, &sets[s]);
    if (status) break;
    ambulo__sparse_rows_fill(&sets[s], d->workspace, 1);
    for (int i = 0; s == 1 && i < counts[s]; i++) ambulo__sparse_rows_set_scale(&sets[s], i, -1.0);
    d->set[s] = &sets[s];
    d->is_equality[s] = s == 0;
    d->sets = s + 1;
  }
  return status;
}

ambulo_status ambulo__solve_plain(const ambulo_problem *p, ambulo_algorithm algorithm,
                                  const ambulo_allocator *allocator, ambulo__run *run,
                                  ambulo_diagnostics *diagnostics, double *x,
                                  const char **message) {
  static const ambulo__place nowhere = {NULL, 0, 0, NULL};
  ambulo__pool pool;
  ambulo__sparse_rows sets[2];
  ambulo__direct d = {.problem = p, .run = run, .objective_scale = 1.0, .message = "not called"};
  size_t bytes = (size_t)p->variables * sizeof *x;
  ambulo__pool_init(&pool, allocator);
  ambulo_status status = ambulo_workspace_create(p, allocator, &d.workspace);
  if (!status) status = create_sets(p, x, &pool, &d, sets);
  if (!status) status = ambulo__direct_create(&d, &pool);
  if (!status) {
    memcpy(d.center, x, bytes);
    status = ambulo__direct_minimize(&d, algorithm, run->options->maximum_evaluations);
  }
  if (status == AMBULO_E_LIMIT)
    (void)ambulo__error(diagnostics, status, nowhere, "use solver.algorithm: auto",
                        "%d unknowns and %d rows need more memory than 4 GB in dense form",
                        p->variables, p->rows);
  if (!status && d.best_violation < HUGE_VAL) memcpy(x, d.best_x, bytes);
  if (d.workspace) run->seconds_evaluate += d.workspace->seconds_evaluate;
  run->iterations++;
  *message = d.message;
  ambulo_workspace_free(d.workspace);
  ambulo__pool_clear(&pool);
  return status;
}
