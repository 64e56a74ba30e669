/* linear/sparse_rows.c - see sparse_rows.h. */
#include "linear/sparse_rows.h"

#include "base/arithmetic.h"
#include "problem/nlp.h"

#include <math.h>
#include <string.h>

enum { POLL_ROWS = 4096 };

static const ambulo__basis_point *point_of(const ambulo_problem *p, int node) {
  return &ambulo__lane_map_points(p->map)[node];
}

/* ------------------------------------------------------------------ pattern */

/* control points [first, last] that a row depends on */
static void support(const ambulo_problem *p, const ambulo__table_row *row, int *first, int *last) {
  const ambulo__row_term *term = p->table.terms + row->first_term;
  *first = p->control_points;
  *last = -1;
  for (int t = 0; t < row->term_count; t++) {
    int from = term[t].channel / p->coordinates, to = from;
    if (term[t].node >= 0) {
      from = point_of(p, term[t].node)->first;
      to = from + point_of(p, term[t].node)->span - 1;
    }
    if (from < *first) *first = from;
    if (to > *last) *last = to;
  }
}

int ambulo__row_host(const ambulo_problem *p, int row) {
  const ambulo__table_row *r = &p->table.rows[row];
  if (r->node >= 0) return r->node;
  int first, last;
  support(p, r, &first, &last);
  for (int k = 0; k < p->nodes; k++) {
    const ambulo__basis_point *point = point_of(p, k);
    if (first >= point->first && last < point->first + point->span) return k;
  }
  return -1;
}

/* A channel of a node depends on the motion of some coordinates there, and so on all control points
 * of the node in these coordinates. Most rows stand on channels of one node, their host: their
 * columns are the same coordinates at each of its control points. */
typedef struct row_pattern {
  const ambulo_problem *problem;
  unsigned char *known;   /* [channels]: whether the next is filled */
  unsigned char *channel; /* [channels][d]: 1 for the coordinates that a channel depends on */
  unsigned char *mark;    /* [variables]: scratch for one row */
} row_pattern;

static ambulo_status create_pattern(const ambulo_problem *p, ambulo__pool *pool,
                                    row_pattern *pattern) {
  size_t channels = (size_t)ambulo__channel_count(&p->channels), d = (size_t)p->coordinates;
  pattern->problem = p;
  pattern->known = ambulo__pool_blocks(pool, channels, 1);
  pattern->channel = ambulo__pool_blocks(pool, channels * d, 1);
  pattern->mark = ambulo__pool_blocks(pool, (size_t)p->variables, 1);
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

static void find_channel(const ambulo_problem *p, int channel, unsigned char *mark) {
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(p->plan);
  ambulo__row_part part[AMBULO__MOST_PARTS];
  int output = channel - ambulo__channel_outputs(&p->channels);
  if (output < 0) {
    mark[channel % p->coordinates] = 1;
    return;
  }
  if ((p->holds || p->devices) && output < p->coordinates) { /* along both arms, other joints */
    memset(mark, 1, (size_t)p->coordinates);
    return;
  }
  int parts = ambulo__plan_parts(p->plan, output, part);
  for (int k = 0; k < parts; k++) {
    for (int e = pattern.start[part[k].row]; e < pattern.start[part[k].row + 1]; e++)
      mark[pattern.column[e]] = 1;
  }
}

/* [d]: 1 for the coordinates that a channel depends on */
static const unsigned char *coordinates_of(row_pattern *pattern, int channel) {
  unsigned char *mark = pattern->channel + (size_t)channel * (size_t)pattern->problem->coordinates;
  if (!pattern->known[channel]) find_channel(pattern->problem, channel, mark);
  pattern->known[channel] = 1;
  return mark;
}

static void join(int count, const unsigned char *restrict from, unsigned char *restrict to) {
  for (int i = 0; i < count; i++) to[i] |= from[i];
}

/* the coordinates of a row on its host alone, into mark [d]; the same at each control point */
static void mark_local(row_pattern *pattern, int row, unsigned char *mark) {
  const ambulo_problem *p = pattern->problem;
  const ambulo__table_row *r = &p->table.rows[row];
  const ambulo__row_term *term = p->table.terms + r->first_term;
  const ambulo__curved *curved = ambulo__row_curved_of(&p->table, r);
  const int d = p->coordinates;
  int channel[AMBULO__CURVED_CHANNELS];
  memset(mark, r->user >= 0 && !curved, (size_t)d);
  int count = curved ? ambulo__curved_channels(curved, channel) : r->user >= 0 ? 0 : r->term_count;
  for (int k = 0; k < count; k++)
    join(d, coordinates_of(pattern, curved ? channel[k] : term[k].channel), mark);
}

/* the same coordinates at each control point of the host */
static int local_columns(row_pattern *pattern, int row, int host, int *column, int *count) {
  const ambulo_problem *p = pattern->problem;
  const int d = p->coordinates, span = point_of(p, host)->span;
  int support = 0, first = ambulo__node_first(p, host);
  mark_local(pattern, row, pattern->mark);
  for (int i = 0; i < d; i++) {
    if (!pattern->mark[i]) continue;
    if (column) column[support] = first + i;
    support++;
  }
  *count = support * span;
  for (int e = support; e < *count && column; e++) column[e] = column[e - support] + d;
  return support;
}

/* marks the unknowns of a row on several nodes, or on unknowns themselves, in [from, to) */
static void mark_row(row_pattern *pattern, int row, int from, int to) {
  const ambulo_problem *p = pattern->problem;
  const ambulo__table_row *r = &p->table.rows[row];
  const ambulo__row_term *term = p->table.terms + r->first_term;
  memset(pattern->mark + from, 0, (size_t)(to - from));
  for (int t = 0; t < r->term_count; t++) {
    if (term[t].node < 0) {
      pattern->mark[term[t].channel] = 1;
      continue;
    }
    const ambulo__basis_point *point = point_of(p, term[t].node);
    const unsigned char *mark = coordinates_of(pattern, term[t].channel);
    for (int c = 0; c < point->span; c++)
      join(p->coordinates, mark, pattern->mark + (point->first + c) * p->coordinates);
  }
}

/* *count columns of a row, ascending, into `column` (NULL: they are only counted). Returns how many
 * of them belong to each control point, where these are the same for all of the host's; else 0. */
static int find_columns(row_pattern *pattern, int row, int host, int *column, int *count) {
  const ambulo_problem *p = pattern->problem;
  if (ambulo__row_is_local(p, row)) return local_columns(pattern, row, host, column, count);
  const int from = host < 0 ? 0 : ambulo__node_first(p, host);
  const int to = host < 0 ? p->variables : from + ambulo__node_width(p, host);
  mark_row(pattern, row, from, to);
  *count = 0;
  for (int j = from; j < to; j++) {
    if (!pattern->mark[j]) continue;
    if (column) column[*count] = j;
    ++*count;
  }
  return 0;
}

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
  row_pattern pattern;
  s->dense = ambulo__pool_doubles(pool, (size_t)p->variables + widest);
  if (create_pattern(p, pool, &pattern)) return AMBULO_E_MEMORY;
  for (int i = 0; i < count; i++) {
    const ambulo__table_row *row = &p->table.rows[rows[i]];
    int entries;
    if (is_over(poll, i)) return AMBULO_E_LIMIT;
    s->row[i] = rows[i];
    s->host[i] = ambulo__row_host(p, rows[i]);
    s->constant[i] = is_linear(p, row);
    s->scale[i] = 1.0;
    s->support[i] = find_columns(&pattern, rows[i], s->host[i], NULL, &entries);
    s->start[i + 1] = s->start[i] + entries;
  }
  s->column = ambulo__pool_ints(pool, (size_t)s->start[count]);
  s->run_end = ambulo__pool_ints(pool, (size_t)s->start[count]);
  s->value = ambulo__pool_doubles(pool, (size_t)s->start[count]);
  if (pool->failed) return AMBULO_E_MEMORY;
  for (int i = 0; i < count; i++) {
    int entries;
    if (is_over(poll, i)) return AMBULO_E_LIMIT;
    (void)find_columns(&pattern, rows[i], s->host[i], s->column + s->start[i], &entries);
  }
  ambulo__sparse_rows_find_runs(s);
  return AMBULO_OK;
}

/* ------------------------------------------------------------------- values */

/* (LR) the entries of a row on its host from slopes y [orders][support], times its scale */
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
  if (s->start[i + 1] == s->start[i]) return;
  if (s->support[i] > 0) {
    fill_local(s, workspace, i);
    return;
  }
  memset(s->dense, 0, (size_t)s->problem->variables * sizeof *s->dense);
  ambulo__row_add_gradient(workspace, s->row[i], 1.0, s->dense);
  for (int e = s->start[i]; e < s->start[i + 1]; e++)
    s->value[e] = s->scale[i] * s->dense[s->column[e]];
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

ambulo_status ambulo__sparse_rows_lay_blocks(ambulo__sparse_rows *s, ambulo__pool *pool) {
  ambulo__row_blocks *blocks = ambulo__pool_blocks(pool, 1, sizeof *blocks);
  int *stale = ambulo__pool_ints(pool, (size_t)s->count);
  if (pool->failed) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__row_blocks_create(s, pool, blocks);
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
