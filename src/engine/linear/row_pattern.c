/* linear/row_pattern.c - see row_pattern.h. */
#include "linear/row_pattern.h"

#include <string.h>

static const ambulo__basis_point *point_of(const ambulo_problem *p, int node) {
  return &ambulo__lane_map_points(p->map)[node];
}

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

ambulo_status ambulo__row_pattern_create(const ambulo_problem *p, ambulo__pool *pool,
                                         ambulo__row_pattern *pattern) {
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
static const unsigned char *coordinates_of(ambulo__row_pattern *pattern, int channel) {
  unsigned char *mark = pattern->channel + (size_t)channel * (size_t)pattern->problem->coordinates;
  if (!pattern->known[channel]) find_channel(pattern->problem, channel, mark);
  pattern->known[channel] = 1;
  return mark;
}

static void join(int count, const unsigned char *restrict from, unsigned char *restrict to) {
  for (int i = 0; i < count; i++) to[i] |= from[i];
}

/* the coordinates of a row on its host alone, into mark [d]; the same at each control point */
static void mark_local(ambulo__row_pattern *pattern, int row, unsigned char *mark) {
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
static int local_columns(ambulo__row_pattern *pattern, int row, int host, int *column, int *count) {
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
static void mark_row(ambulo__row_pattern *pattern, int row, int from, int to) {
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

int ambulo__row_pattern_columns(ambulo__row_pattern *pattern, int row, int host, int *column,
                                int *count) {
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
