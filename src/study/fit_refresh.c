/* study/fit_refresh.c - solutions that a fit follows, against those that zero finds (evaluate.h).
 *
 * The choice is made by the objective of the inner problem, never by the distance to people: what
 * comes closest to them among several valleys would be a fit of the starts. */
#include "formats/paths.h"
#include "study/case_path.h"
#include "study/fit_evaluate.h"

#include <math.h>
#include <string.h>

/* less by this share is better, and no rounding */
static const double least_gain = 1e-4;

/* *total: the objective of a case's result; NaN: there is none */
static ambulo_status read_objective(const ambulo__fit_runner *r, int index, double *total) {
  ambulo__yaml *document = NULL;
  char *path =
      ambulo__case_path(r->allocator, r->solves, r->sweep->cases[index].id, "/summary.json");
  *total = (double)NAN;
  if (!path) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__yaml_load(path, r->allocator, r->diagnostics, &document);
  if (!status) {
    const ambulo__yaml_node *objective = ambulo__yaml_get(ambulo__yaml_root(document), "objective");
    *total = ambulo__yaml_number(ambulo__yaml_get(objective, "total"), (double)NAN);
  }
  ambulo__yaml_free(document);
  ambulo__free(r->allocator, path);
  return status;
}

static ambulo_status is_better(const ambulo__fit_runner *r, const ambulo__fit_trial *trial,
                               const ambulo__fit_trial *fresh, int c, int *better) {
  double own = 0.0, other = 0.0;
  *better = 0;
  if (!fresh->solved[c] || fresh->index[c] == trial->index[c]) return AMBULO_OK;
  *better = !trial->solved[c];
  if (*better) return AMBULO_OK;
  ambulo_status status = read_objective(r, trial->index[c], &own);
  if (!status) status = read_objective(r, fresh->index[c], &other);
  *better = !status && other < own - least_gain * fabs(own);
  return status;
}

static void take(const ambulo__fit_runner *r, const ambulo__fit_trial *fresh, int c,
                 ambulo__fit_trial *trial) {
  const ambulo__fit_condition *condition = &r->fit->condition[c];
  size_t curves = (size_t)r->fit->curves, first = (size_t)condition->first;
  if (!condition->held_out)
    memcpy(trial->residual + first, fresh->residual + first,
           (size_t)condition->residuals * sizeof *trial->residual);
  memcpy(trial->score + (size_t)c * curves, fresh->score + (size_t)c * curves,
         curves * sizeof *trial->score);
  trial->apart[c] = fresh->apart[c];
  trial->index[c] = fresh->index[c];
  trial->solved[c] = fresh->solved[c];
}

ambulo_status ambulo__fit_take_better(const ambulo__fit_runner *r, const ambulo__fit_sizes *sizes,
                                      const ambulo__fit_trial *fresh, ambulo__fit_trial *trial) {
  ambulo_status status = AMBULO_OK;
  for (int c = 0; c < sizes->conditions && !status; c++) {
    int better = 0;
    if (trial->index[c] < 0 || fresh->index[c] < 0) continue;
    status = is_better(r, trial, fresh, c, &better);
    if (better) take(r, fresh, c, trial);
  }
  return status;
}

ambulo_status ambulo__fit_refresh(ambulo__fit_runner *r, const ambulo__fit_sizes *sizes,
                                  ambulo__fit_trial *trial) {
  ambulo__fit_trial *fresh = ambulo__fit_trials_make(sizes, 1, r->allocator);
  if (!fresh) return AMBULO_E_MEMORY;
  memcpy(fresh->u, trial->u, (size_t)sizes->parameters * sizeof *fresh->u);
  memcpy(fresh->label, "from zero", sizeof "from zero");
  ambulo_status status = ambulo__fit_evaluate(r, AMBULO__FIT_FRESH, NULL, fresh, 1);
  if (!status && fresh->complete) status = ambulo__fit_take_better(r, sizes, fresh, trial);
  trial->distance = 0.0;
  for (int k = 0; k < sizes->residuals; k++)
    trial->distance += trial->residual[k] * trial->residual[k];
  ambulo__free(r->allocator, fresh);
  return status;
}
