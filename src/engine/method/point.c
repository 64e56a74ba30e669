/* method/point.c - see point.h. */
#include "method/point.h"

#include "base/arithmetic.h"
#include "method/parameters.h"
#include "problem/nlp.h"

#include <math.h>
#include <string.h>

int ambulo__engine_at_lower_bound(const ambulo__engine *e) {
  const ambulo__setup *s = e->setup;
  for (int t = 0; t < s->problem->definition.term_count; t++) {
    if (s->negligible < 0.0 || e->workspace->term_value[t] > s->negligible_term[t]) return 0;
  }
  return s->negligible >= 0.0;
}

/* worst of a set of equalities whose values are there, relative to the sizes of the rows */
static double worst_equality(const ambulo__setup *s, const ambulo__sparse_rows *rows,
                             const double *value) {
  const ambulo__table_row *table = s->problem->table.rows;
  double worst = 0.0;
  for (int i = 0; i < rows->count; i++)
    worst = ambulo__worse(worst, fabs(value[i]) / table[rows->row[i]].size);
  return worst;
}

double ambulo__engine_equality_error(ambulo__engine *e) {
  const ambulo__row_roles *rows = e->setup->rows;
  ambulo__measured *m = &e->measured;
  ambulo__sparse_rows_values(&rows->equality, e->workspace, m->equality);
  ambulo__sparse_rows_values(&rows->border, e->workspace, m->border);
  return ambulo__worse(worst_equality(e->setup, &rows->equality, m->equality),
                       worst_equality(e->setup, &rows->border, m->border));
}

double ambulo__engine_excess(const ambulo__engine *e, double *excess) {
  const ambulo__sparse_rows *rows = &e->setup->rows->inequality;
  const ambulo__table_row *table = e->setup->problem->table.rows;
  double worst = 0.0;
  ambulo__sparse_rows_values(rows, e->workspace, excess);
  for (int i = 0; i < rows->count; i++) {
    if (excess[i] <= 0.0) continue;
    worst = ambulo__worse(worst, excess[i] / (-rows->scale[i] * table[rows->row[i]].size));
  }
  return worst;
}

ambulo_status ambulo__engine_gradient(ambulo__engine *e, double scale, const double *p,
                                      const double *l, double *gradient) {
  const ambulo__sparse_rows *inequality = &e->setup->rows->inequality;
  const ambulo__sparse_rows *equality = &e->setup->rows->equality;
  double *weight = e->measured.row_weight;
  memset(weight, 0, (size_t)e->setup->problem->rows * sizeof *weight);
  for (int i = 0; p && i < inequality->count; i++)
    weight[inequality->row[i]] = inequality->scale[i] * p[i];
  for (int i = 0; l && i < equality->count; i++)
    weight[equality->row[i]] = equality->scale[i] * l[i];
  ambulo_status status = ambulo__gradient(e->workspace, scale, weight, gradient);
  if (status) ambulo__run_fault(e->run, &e->workspace->fault);
  return status;
}

double ambulo__engine_roughness(const ambulo__engine *e) {
  return AMBULO__METRIC_SHARE *
         fmin(AMBULO__USUAL_OPTIMALITY, e->run->options->optimality_tolerance);
}

/* whether the point in the workspace is so near to where H0 was filled in that this H0 will do */
static int is_near(const ambulo__engine *e) {
  const ambulo__linearized *at = &e->linearized;
  double reach = ambulo__engine_roughness(e);
  if (at->filled_mu < 0.0) return 0;
  for (int j = 0; j < e->setup->n; j++) {
    if (!(fabs(e->workspace->x[j] - at->filled_at[j]) <= reach)) return 0;
  }
  return 1;
}

int ambulo__engine_fill_metric(ambulo__engine *e, double mu) {
  ambulo__linearized *at = &e->linearized;
  double in_base = at->filled_mu;
  at->assembled = 0;
  if (!is_near(e)) {
    ambulo__metric_fill(&at->metric, e->workspace, e->setup->objective_scale, &at->base);
    ambulo__metric_add_bends(&at->metric, e->workspace, &e->setup->rows->inequality,
                             e->iterate.lambda, &at->base);
    ambulo__band_raise_diagonal(&at->base, AMBULO__METRIC_ROUNDING);
    memcpy(at->filled_at, e->workspace->x, (size_t)e->setup->n * sizeof *at->filled_at);
    in_base = 0.0;
  }
  ambulo__band_add_diagonal(&at->base, mu - in_base);
  double largest = ambulo__band_largest(&at->base);
  at->filled_mu = isfinite(largest) ? mu : -1.0;
  if (isfinite(largest)) return 0;
  ambulo__fault_of_curvature(e->workspace, largest);
  ambulo__run_fault(e->run, &e->workspace->fault);
  return 1;
}

double ambulo__step_limit(const ambulo__setup *s, const double *step, double part) {
  int d = s->problem->coordinates;
  double largest = 0.0;
  for (int j = 0; j < s->n; j++) largest = ambulo__worse(largest, fabs(step[j]) / s->cap[j % d]);
  return largest <= part ? 1.0 : part / largest;
}

ambulo_status ambulo__trial_create(int n, int inequalities, int equalities, ambulo__pool *pool,
                                   ambulo__trial *trial) {
  *trial = (ambulo__trial){.n = n,
                           .inequalities = inequalities,
                           .equalities = equalities,
                           .value = HUGE_VAL,
                           .x = ambulo__pool_doubles(pool, (size_t)n),
                           .excess = ambulo__pool_doubles(pool, (size_t)inequalities),
                           .multiplier = ambulo__pool_doubles(pool, (size_t)inequalities),
                           .equality_multiplier = ambulo__pool_doubles(pool, (size_t)equalities)};
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

void ambulo__trial_copy(const ambulo__trial *from, ambulo__trial *to) {
  size_t rows = (size_t)from->inequalities * sizeof *to->excess;
  to->value = from->value;
  to->objective = from->objective;
  to->violation = from->violation;
  to->gradient_norm = from->gradient_norm;
  memcpy(to->x, from->x, (size_t)from->n * sizeof *to->x);
  memcpy(to->excess, from->excess, rows);
  memcpy(to->multiplier, from->multiplier, rows);
  memcpy(to->equality_multiplier, from->equality_multiplier,
         (size_t)from->equalities * sizeof *to->equality_multiplier);
}
