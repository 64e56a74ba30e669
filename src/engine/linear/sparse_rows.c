/* linear/sparse_rows.c - see sparse_rows.h. */
#include "linear/sparse_rows.h"
#include "base/arithmetic.h"
#include "problem/nonfinite.h"

#include <math.h>
#include <string.h>

enum { POLL_ROWS = 4096 };

static const ambulo__basis_point *point_of(const ambulo_problem *p, int node) {
  return &ambulo__lane_map_points(p->map)[node];
}

/* ------------------------------------------------------------------ pattern */

static int is_linear(const ambulo_problem *p, const ambulo__table_row *row) {
  if (row->user >= 0) return 0;
  const ambulo__row_term *term = p->table.terms + row->first_term;
  for (int t = 0; t < row->term_count; t++) {
    if (term[t].node >= 0 && term[t].channel >= ambulo__channel_outputs(&p->channels)) return 0;
  }
  return 1;
}

void ambulo__sparse_rows_find_runs(ambulo__sparse_rows *s) {
  for (int i = 0; i < s->count; i++) {
    int last = s->start[i + 1] - 1, end = last + 1;
    for (int e = last; e >= s->start[i]; e--) {
      if (e < last && s->column[e + 1] != s->column[e] + 1) end = e + 1;
      s->run_end[e] = end;
    }
  }
}

/* asked every few thousand rows */
static int is_over(const ambulo__poll *poll, int i) {
  return poll && poll->ask && i % POLL_ROWS == POLL_ROWS - 1 && poll->ask(poll->user);
}

ambulo_status ambulo__sparse_rows_create(const ambulo_problem *p, const int *rows, int count,
                                         const ambulo__poll *poll, ambulo__pool *pool,
                                         ambulo__sparse_rows *s) {
  size_t n = (size_t)count;
  s->problem = p;
  s->count = count;
  s->row = ambulo__pool_ints(pool, n);
  s->host = ambulo__pool_ints(pool, n);
  s->constant = ambulo__pool_ints(pool, n);
  s->start = ambulo__pool_ints(pool, n + 1);
  s->support = ambulo__pool_ints(pool, n);
  s->scale = ambulo__pool_doubles(pool, n);
  s->slopes = ambulo__pool_doubles(pool, 3 * (size_t)p->coordinates);
  s->blocks = NULL;
  s->stale = NULL;
  size_t widest = (size_t)ambulo__basis_span(p->basis) * (size_t)p->coordinates;
  ambulo__row_pattern pattern;
  s->dense = ambulo__pool_doubles(pool, (size_t)p->variables + widest);
  if (ambulo__row_pattern_create(p, pool, &pattern)) return AMBULO_E_MEMORY;
  for (int i = 0; i < count; i++) {
    const ambulo__table_row *row = &p->table.rows[rows[i]];
    int entries;
    if (is_over(poll, i)) return AMBULO_E_LIMIT;
    s->row[i] = rows[i];
    s->host[i] = ambulo__row_host(p, rows[i]);
    s->constant[i] = is_linear(p, row);
    s->scale[i] = 1.0;
    s->support[i] = ambulo__row_pattern_columns(&pattern, rows[i], s->host[i], NULL, &entries);
    s->start[i + 1] = s->start[i] + entries;
  }
  s->column = ambulo__pool_ints(pool, (size_t)s->start[count]);
  s->run_end = ambulo__pool_ints(pool, (size_t)s->start[count]);
  s->value = ambulo__pool_doubles(pool, (size_t)s->start[count]);
  if (pool->failed) return AMBULO_E_MEMORY;
  for (int i = 0; i < count; i++) {
    int entries;
    if (is_over(poll, i)) return AMBULO_E_LIMIT;
    (void)ambulo__row_pattern_columns(&pattern, rows[i], s->host[i], s->column + s->start[i],
                                      &entries);
  }
  ambulo__sparse_rows_find_runs(s);
  return AMBULO_OK;
}

/* ------------------------------------------------------------------- values */

/* the entries of a row on its host from slopes y [orders][support], times its scale */
static void spread(const ambulo__sparse_rows *s, int i, int orders, const double *restrict y) {
  const ambulo__basis_point *point = point_of(s->problem, s->host[i]);
  const int width = s->support[i];
  double *restrict value = s->value + s->start[i];
  for (int c = 0; c < point->span; c++, value += width) {
    const double b0 = s->scale[i] * point->weight[0][c];
    for (int e = 0; e < width; e++) value[e] = b0 * y[e];
    if (orders == 1) continue;
    const double b1 = s->scale[i] * point->weight[1][c], b2 = s->scale[i] * point->weight[2][c];
    for (int e = 0; e < width; e++) value[e] += b1 * y[width + e] + b2 * y[2 * width + e];
  }
}

void ambulo__sparse_rows_expand(const ambulo__sparse_rows *s, int i) {
  ambulo__row_blocks_recall(s->blocks, i, s->dense);
  spread(s, i, s->blocks->shape[i].orders, s->dense);
  s->stale[i] = 0;
}

static void fill_local(ambulo__sparse_rows *s, const ambulo_workspace *workspace, int i) {
  const int d = s->problem->coordinates, width = s->support[i];
  const int *column = s->column + s->start[i], first = ambulo__node_first(s->problem, s->host[i]);
  ambulo__row_slopes(workspace, s->row[i], s->slopes);
  if (s->stale && s->blocks->block_of[i] >= 0) {
    ambulo__row_blocks_keep(s->blocks, i, s->slopes);
    s->stale[i] = 1;
    return;
  }
  for (int o = 0; o < 3; o++) {
    for (int e = 0; e < width; e++) s->dense[o * width + e] = s->slopes[o * d + column[e] - first];
  }
  spread(s, i, 3, s->dense);
}

static void fill_row(ambulo__sparse_rows *s, const ambulo_workspace *workspace, int i) {
  const ambulo_problem *p = s->problem;
  int from = 0;
  if (s->support[i] > 0) {
    fill_local(s, workspace, i);
    return;
  }
  if (ambulo__row_is_local(p, s->row[i])) {
    from = ambulo__node_first(p, s->host[i]);
    ambulo__row_local_gradient(workspace, s->row[i], s->dense);
  } else {
    memset(s->dense, 0, (size_t)p->variables * sizeof *s->dense);
    ambulo__row_add_gradient(workspace, s->row[i], 1.0, s->dense);
  }
  for (int e = s->start[i]; e < s->start[i + 1]; e++) {
    s->value[e] = s->scale[i] * s->dense[s->column[e] - from];
  }
}

/* of rows that are stale the slopes are looked at */
static int is_finite(const ambulo__sparse_rows *s) {
  if (!s->stale) return ambulo__all_finite(s->value, (size_t)s->start[s->count]);
  for (int i = 0; i < s->count; i++) {
    size_t entries = (size_t)(s->start[i + 1] - s->start[i]);
    if (!s->stale[i] && !ambulo__all_finite(s->value + s->start[i], entries)) return 0;
  }
  return ambulo__row_blocks_finite(s->blocks);
}

/* names the first entry that is not finite */
static void find_fault(const ambulo__sparse_rows *s, ambulo_workspace *workspace) {
  for (int i = 0; i < s->count; i++) {
    const double *value = ambulo__sparse_rows_gradient(s, i);
    for (int e = 0; e < s->start[i + 1] - s->start[i]; e++) {
      if (isfinite(value[e])) continue;
      ambulo__fault_of_row(workspace, s->row[i], s->column[s->start[i] + e], value[e]);
      return;
    }
  }
}

ambulo_status ambulo__sparse_rows_fill(ambulo__sparse_rows *s, ambulo_workspace *workspace,
                                       int all) {
  for (int i = 0; i < s->count; i++) {
    if (all || !s->constant[i]) fill_row(s, workspace, i);
  }
  if (is_finite(s)) return AMBULO_OK;
  find_fault(s, workspace);
  return AMBULO_E_NUMERIC;
}

void ambulo__sparse_rows_set_scale(ambulo__sparse_rows *s, int i, double scale) {
  double ratio = scale / s->scale[i];
  int stale = s->stale && s->stale[i];
  for (int e = s->start[i]; e < s->start[i + 1] && !stale; e++) s->value[e] *= ratio;
  s->scale[i] = scale;
}

void ambulo__sparse_rows_values(const ambulo__sparse_rows *s, const ambulo_workspace *workspace,
                                double *value) {
  for (int i = 0; i < s->count; i++) value[i] = s->scale[i] * workspace->row_value[s->row[i]];
}

/* how much of the motion of its host a row needs */
static int orders_of(const ambulo_problem *p, const ambulo__table_row *row) {
  const ambulo__row_term *term = p->table.terms + row->first_term;
  const ambulo__curved *curved = ambulo__row_curved_of(&p->table, row);
  int channel[AMBULO__CURVED_CHANNELS], most = 1;
  if (row->user >= 0 && !curved) return 3;
  int count = curved ? ambulo__curved_channels(curved, channel) : row->term_count;
  for (int k = 0; k < count; k++) {
    int orders = ambulo__channel_orders(p, curved ? channel[k] : term[k].channel);
    if (orders > most) most = orders;
  }
  return most;
}

/* others than limits on one number, of linear rows, are left to their gradients, which are short */
static ambulo__row_shape shape_of(const ambulo__sparse_rows *s, int i) {
  const ambulo_problem *p = s->problem;
  const ambulo__table_row *row = &p->table.rows[s->row[i]];
  const ambulo__row_term *term = p->table.terms + row->first_term;
  ambulo__row_shape shape = {.host = s->host[i], .entry = -1};
  if (s->support[i] == 0) return shape;
  shape.support = s->support[i];
  shape.column = s->column + s->start[i];
  if (!s->constant[i]) {
    shape.orders = orders_of(p, row);
  } else if (row->term_count == 1) {
    shape.entry = term->channel;
    shape.coefficient = term->coefficient;
  }
  return shape;
}

ambulo_status ambulo__sparse_rows_lay_blocks(ambulo__sparse_rows *s, ambulo__pool *pool) {
  ambulo__row_shape *shape = ambulo__pool_blocks(pool, (size_t)s->count, sizeof *shape);
  ambulo__row_blocks *blocks = ambulo__pool_blocks(pool, 1, sizeof *blocks);
  int *stale = ambulo__pool_ints(pool, (size_t)s->count);
  if (pool->failed) return AMBULO_E_MEMORY;
  for (int i = 0; i < s->count; i++) shape[i] = shape_of(s, i);
  ambulo_status status = ambulo__row_blocks_create(s->problem, s->count, shape, pool, blocks);
  if (status) return status;
  s->blocks = blocks;
  s->stale = stale;
  return AMBULO_OK;
}

/* three sums side by side, since one waits for itself */
static double product(const ambulo__sparse_rows *s, int i, const double *d) {
  const double *value = s->value;
  const int *column = s->column;
  double sum[3] = {0.0};
  int e = s->start[i], end = s->start[i + 1];
  for (; e + 3 <= end; e += 3) {
    for (int l = 0; l < 3; l++) sum[l] += value[e + l] * d[column[e + l]];
  }
  for (; e < end; e++) sum[0] += value[e] * d[column[e]];
  return sum[0] + sum[1] + sum[2];
}

void ambulo__sparse_rows_multiply(const ambulo__sparse_rows *s, const double *d, double *out) {
  if (s->blocks) ambulo__row_blocks_multiply(s->blocks, s->scale, d, out);
  for (int i = 0; i < s->count; i++) {
    if (!s->blocks || !ambulo__row_blocks_have(s->blocks, i)) out[i] = product(s, i, d);
  }
}

void ambulo__sparse_rows_add_transpose(const ambulo__sparse_rows *s, double factor, const double *w,
                                       double *restrict y) {
  for (int i = 0; i < s->count; i++) {
    double f = factor * w[i];
    if (f == 0.0) continue;
    const double *restrict value = ambulo__sparse_rows_gradient(s, i) - s->start[i];
    for (int e = s->start[i]; e < s->start[i + 1]; e = s->run_end[e]) {
      double *restrict to = y + s->column[e];
      for (int k = 0; k < s->run_end[e] - e; k++) to[k] += f * value[e + k];
    }
  }
}

double ambulo__sparse_rows_norm(const ambulo__sparse_rows *s, int i) {
  const double *value = ambulo__sparse_rows_gradient(s, i);
  double sum = 0.0;
  for (int e = 0; e < s->start[i + 1] - s->start[i]; e++) sum += value[e] * value[e];
  return sqrt(sum);
}
