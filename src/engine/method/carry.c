/* method/carry.c - see carry.h */
#include "method/carry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* FNV-1a 64 of the labels, each with its end */
static unsigned long long series_of(const ambulo__table_row *row) {
  const char *const label[] = {row->family, row->subject, row->detail};
  unsigned long long hash = 14695981039346656037ULL;
  for (int i = 0; i < 3; i++) {
    for (const char *c = label[i];; c++) {
      hash = (hash ^ (unsigned char)*c) * 1099511628211ULL;
      if (!*c) break;
    }
  }
  return hash;
}

static int by_series_and_time(const void *a, const void *b) {
  const ambulo__carried_row *one = a, *other = b;
  if (one->series != other->series) return one->series < other->series ? -1 : 1;
  return (one->time > other->time) - (one->time < other->time);
}

/* time that a row stands for, s */
static double time_of(const ambulo_problem *p, const ambulo__table_row *row) {
  return row->node < 0 ? 1.0 : p->quadrature[row->node];
}

ambulo_status ambulo__carry_from(const ambulo__engine *e, const ambulo_allocator *allocator,
                                 ambulo__carried *carried) {
  const ambulo_problem *p = e->setup->problem;
  const ambulo__sparse_rows *rows = &e->setup->rows->inequality;
  ambulo__carry_clear(allocator, carried);
  carried->row = ambulo__alloc(allocator, (size_t)e->setup->inequalities, sizeof *carried->row);
  if (!carried->row) return AMBULO_E_MEMORY;
  carried->interval = 0.0;
  for (int k = 0; k + 1 < p->nodes; k++)
    carried->interval = fmax(carried->interval, p->times[k + 1] - p->times[k]);
  carried->count = e->setup->inequalities;
  carried->objective = e->reached.objective / e->setup->objective_scale;
  for (int i = 0; i < e->setup->inequalities; i++) {
    const ambulo__table_row *row = &p->table.rows[rows->row[i]];
    double multiplier = -rows->scale[i] * e->iterate.lambda[i] / e->setup->objective_scale;
    carried->row[i] =
        (ambulo__carried_row){series_of(row), row->time, multiplier / time_of(p, row)};
  }
  qsort(carried->row, (size_t)carried->count, sizeof *carried->row, by_series_and_time);
  return AMBULO_OK;
}

/* the first row that is not before this one */
static int find(const ambulo__carried *carried, const ambulo__carried_row *wanted) {
  int low = 0, high = carried->count;
  while (low < high) {
    int middle = low + (high - low) / 2;
    if (by_series_and_time(&carried->row[middle], wanted) < 0) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

/* of rows next to each other: linear between them; of one alone: constant for half an interval */
static double density_at(const ambulo__carried *carried, unsigned long long series, double time) {
  const ambulo__carried_row wanted = {series, time, 0.0};
  int after = find(carried, &wanted), before = after - 1;
  int has_after = after < carried->count && carried->row[after].series == series;
  int has_before = before >= 0 && carried->row[before].series == series;
  const ambulo__carried_row *b = has_before ? &carried->row[before] : NULL;
  const ambulo__carried_row *a = has_after ? &carried->row[after] : NULL;
  if (a && b && a->time - b->time < 1.5 * carried->interval)
    return b->density + (a->density - b->density) * (time - b->time) / (a->time - b->time);
  double reach = 0.5 * carried->interval * (1.0 + 1e-9);
  if (a && a->time - time <= reach) return a->density;
  return b && time - b->time <= reach ? b->density : 0.0;
}

/* (P.13) densities of the coarse grid times w_k of this one */
void ambulo__carry_to(const ambulo__carried *carried, ambulo__engine *e) {
  const ambulo_problem *p = e->setup->problem;
  const ambulo__sparse_rows *rows = &e->setup->rows->inequality;
  for (int i = 0; i < e->setup->inequalities; i++) {
    const ambulo__table_row *row = &p->table.rows[rows->row[i]];
    double multiplier = time_of(p, row) * density_at(carried, series_of(row), row->time);
    e->iterate.lambda[i] = fmax(0.0, e->setup->objective_scale * multiplier / -rows->scale[i]);
  }
  e->iterate.carried_objective = carried->count > 0 ? fabs(carried->objective) : -1.0;
}

void ambulo__carry_clear(const ambulo_allocator *allocator, ambulo__carried *carried) {
  ambulo__free(allocator, carried->row);
  memset(carried, 0, sizeof *carried);
}
