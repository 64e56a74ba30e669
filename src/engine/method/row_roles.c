/* method/row_roles.c - see row_roles.h. */
#include "method/row_roles.h"

#include "base/arithmetic.h"
#include "linear/sparse_rows.h"
#include "method/parameters.h"

#include <math.h>
#include <string.h>

static const double least_gradient = 1e-6; /* of a row of the caller, where it vanishes */

/* what an inequality is divided by: see row_roles.h */
double ambulo__rows_size(const ambulo_problem *p, const ambulo__sparse_rows *s, int i) {
  const ambulo__table_row *row = &p->table.rows[s->row[i]];
  if (row->user < 0 || row->kind != AMBULO__KIND_USER) return row->size;
  double norm = ambulo__sparse_rows_norm(s, i);
  return norm >= least_gradient ? norm : least_gradient;
}

int ambulo__rows_contradict(const ambulo__row_roles *rows, int count) {
  for (int r = 0; r < count; r++) {
    if (rows->rank[r] == AMBULO__ROW_CONTRADICTORY) return 1;
  }
  return 0;
}

typedef struct lists {
  int *equality, *border, *inequality;
  int equalities, borders, inequalities;
} lists;

static void classify(const ambulo_problem *p, const unsigned char *far, const int *rank, lists *l,
                     ambulo__row_roles *out) {
  out->regular = 1;
  out->dropped = 0;
  for (int r = 0; r < p->rows; r++) {
    if (far[r]) continue;
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

void ambulo__row_roles_set_far(ambulo_workspace *w, const double *x) {
  const ambulo_problem *p = w->problem;
  memset(w->far, 0, (size_t)p->rows);
  if (ambulo__evaluate(w, x)) return;
  for (int r = 0; r < p->rows; r++)
    w->far[r] =
        p->table.rows[r].kind == AMBULO__KIND_COLLISION && w->row_value[r] > AMBULO__NEAR_ROWS;
}

ambulo_status ambulo__row_roles_create(const ambulo_problem *p, ambulo_workspace *workspace,
                                       const double *start, ambulo__run *run, ambulo__pool *pool,
                                       ambulo_diagnostics *diagnostics, ambulo__row_roles *out) {
  size_t rows = (size_t)p->rows;
  out->rank = ambulo__pool_ints(pool, rows);
  lists l = {.equality = ambulo__pool_ints(pool, rows),
             .border = ambulo__pool_ints(pool, rows),
             .inequality = ambulo__pool_ints(pool, rows)};
  if (pool->failed) return AMBULO_E_MEMORY;
  ambulo_status status =
      ambulo__presolve_rank(p, workspace, start, run, pool, diagnostics, out->rank);
  if (status) return status;
  classify(p, workspace->far, out->rank, &l, out);
  ambulo__poll poll = run ? ambulo__run_poller(run) : (ambulo__poll){NULL, NULL};
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

/* independent equality rows.
 *
 * Dependent equalities stop SLSQP at its first step and leave multipliers undefined. They
 * arise in three ways: a flat sole has four coplanar corners (three heights), a periodic or
 * mirrored end makes the contact rows of the last node copies of those of the first, and
 * prescribed values may repeat a row. All three show inside small groups:
 *
 *   ends   border rows (periodic, mirrored), then the rows of the first, then of the last node
 *   node   the rows of one node
 *
 * In a group the gradients g_r are orthogonalized in order (Gram-Schmidt, twice):
 *
 *   g_r = sum_i a_i e_i + b,   dependent when |b| <= 1e-8 |g_r|;
 *   with v_i the value that belongs to e_i, it contradicts the others when
 *   |c_r - sum_i a_i v_i| is not small.
 *
 * The rows are taken at a generic point (the start plus a fixed pseudo-random shift, so that
 * straight knees do not hide a direction) that satisfies the border rows, which are linear,
 * by cyclic projections.
 */

enum { MOST_WARNINGS = 5, POLL_NODES = 256 };

typedef struct group {
  const ambulo__sparse_rows *rows;
  const double *value;  /* [rows] */
  int *member, members; /* indices into rows, in order of priority */
  int *by_host, *first; /* [rows], [nodes + 2]: rows in the order of their hosts, border rows first;
                           where those of node k - 1 begin */
  int *position;        /* [variables]: place of an unknown among the group's, or -1 */
  int width;
  double *vector;    /* [capacity][width]: orthonormal */
  double *level;     /* [capacity] */
  double *candidate; /* [width] */
  int basis;
} group;

/* reproducible numbers in [-1, 1): a linear congruential generator (Knuth, MMIX) */
static double next_random(unsigned long long *state) {
  *state = *state * 6364136223846793005ULL + 1442695040888963407ULL;
  return (double)(*state >> 11) / 4503599627370496.0 - 1.0;
}

static void generic_point(const ambulo_problem *p, const double *start, double *x) {
  unsigned long long state = 20190731ULL;
  for (int j = 0; j < p->variables; j++) {
    x[j] = (start ? start[j] : 0.0) + AMBULO__RANK_SHIFT * next_random(&state);
  }
}

/* value of a linear row at x, from its value `at0` at x0 and its gradient */
static double linear_value(const ambulo__sparse_rows *s, int i, double at0, const double *x0,
                           const double *x) {
  double value = at0;
  for (int e = s->start[i]; e < s->start[i + 1]; e++)
    value += s->value[e] * (x[s->column[e]] - x0[s->column[e]]);
  return value;
}

static void satisfy_border(const ambulo__sparse_rows *s, const double *at0, const double *x0,
                           double *x) {
  for (int sweep = 0; sweep < AMBULO__RANK_SWEEPS; sweep++) {
    double worst = 0.0;
    for (int i = 0; i < s->count; i++) {
      if (s->host[i] >= 0 || !s->constant[i]) continue;
      double value = linear_value(s, i, at0[i], x0, x), norm = ambulo__sparse_rows_norm(s, i);
      worst = ambulo__worse(worst, fabs(value));
      double factor = value / (norm * norm);
      for (int e = s->start[i]; e < s->start[i + 1]; e++) x[s->column[e]] -= factor * s->value[e];
    }
    if (worst < 1e-14) break;
  }
}

static void group_columns(group *g) {
  const ambulo__sparse_rows *s = g->rows;
  g->width = 0;
  for (int m = 0; m < g->members; m++) {
    int i = g->member[m];
    for (int e = s->start[i]; e < s->start[i + 1]; e++) {
      if (g->position[s->column[e]] < 0) g->position[s->column[e]] = g->width++;
    }
  }
}

/* removes from the candidate its part along the basis; returns the value that goes with it */
static double orthogonalize(group *g) {
  double value = 0.0;
  size_t w = (size_t)g->width;
  for (int pass = 0; pass < 2; pass++) {
    for (int b = 0; b < g->basis; b++) {
      const double *e = g->vector + (size_t)b * w;
      double a = 0.0;
      for (size_t j = 0; j < w; j++) a += e[j] * g->candidate[j];
      for (size_t j = 0; j < w; j++) g->candidate[j] -= a * e[j];
      value += a * g->level[b];
    }
  }
  return value;
}

static double norm_of(const double *v, int n) {
  double sum = 0.0;
  for (int j = 0; j < n; j++) sum += v[j] * v[j];
  return sqrt(sum);
}

static ambulo__row_rank add_member(group *g, int i) {
  const ambulo__sparse_rows *s = g->rows;
  memset(g->candidate, 0, (size_t)g->width * sizeof *g->candidate);
  for (int e = s->start[i]; e < s->start[i + 1]; e++)
    g->candidate[g->position[s->column[e]]] += s->value[e];
  double before = norm_of(g->candidate, g->width);
  double rest = g->value[i] - orthogonalize(g);
  double after = norm_of(g->candidate, g->width);
  if (after > AMBULO__HALF_DIGITS * before && before > 0.0 && g->basis < g->width) {
    double *e = g->vector + (size_t)g->basis * (size_t)g->width;
    for (int j = 0; j < g->width; j++) e[j] = g->candidate[j] / after;
    g->level[g->basis++] = rest / after;
    return AMBULO__ROW_INDEPENDENT;
  }
  int agrees = fabs(rest) <= AMBULO__RANK_CONTRADICTION * (1.0 + fabs(g->value[i]));
  return agrees ? AMBULO__ROW_DEPENDENT : AMBULO__ROW_CONTRADICTORY;
}

/* forgets the columns of the group */
static void clear_columns(group *g) {
  const ambulo__sparse_rows *s = g->rows;
  for (int m = 0; m < g->members; m++) {
    int i = g->member[m];
    for (int e = s->start[i]; e < s->start[i + 1]; e++) g->position[s->column[e]] = -1;
  }
}

static void sort_group(group *g, int *rank) {
  group_columns(g);
  g->basis = 0;
  for (int m = 0; m < g->members; m++) {
    int row = g->rows->row[g->member[m]];
    rank[row] = (int)add_member(g, g->member[m]);
  }
  clear_columns(g);
}

/* fills by_host and first, by counting */
static void order_by_host(group *g) {
  const ambulo__sparse_rows *s = g->rows;
  int hosts = s->problem->nodes + 1;
  for (int i = 0; i < s->count; i++) g->first[s->host[i] + 2]++;
  for (int h = 0; h < hosts; h++) g->first[h + 1] += g->first[h];
  for (int i = 0; i < s->count; i++) g->by_host[g->first[s->host[i] + 1]++] = i;
  for (int h = hosts; h > 0; h--) g->first[h] = g->first[h - 1];
  g->first[0] = 0;
}

/* appends the rows hosted by `node` (-1: border rows) */
static void collect(group *g, int node) {
  for (int k = g->first[node + 1]; k < g->first[node + 2]; k++)
    g->member[g->members++] = g->by_host[k];
}

/* 1 when the run was stopped before all was sorted */
static int sort_all(group *g, ambulo__run *run, int *rank) {
  const ambulo_problem *p = g->rows->problem;
  int last = p->nodes - 1, borders = 0;
  for (int i = 0; i < g->rows->count; i++) borders += g->rows->host[i] < 0;
  for (int node = 0; node <= last; node++) {
    if (borders > 0 && (node == 0 || node == last)) continue;
    if (node % POLL_NODES == POLL_NODES - 1 && ambulo__run_poll(run)) return 1;
    g->members = 0;
    collect(g, node);
    sort_group(g, rank);
  }
  if (borders == 0) return 0;
  g->members = 0;
  collect(g, -1);
  collect(g, 0);
  if (last > 0) collect(g, last);
  sort_group(g, rank);
  return 0;
}

/* most unknowns that one group can touch */
static int widest_group(const ambulo__sparse_rows *s) {
  const ambulo_problem *p = s->problem;
  int width = 2 * ambulo__basis_span(p->basis) * p->coordinates;
  for (int i = 0; i < s->count; i++) {
    if (s->host[i] < 0) width += s->start[i + 1] - s->start[i];
  }
  return width < p->variables ? width : p->variables;
}

/* Rows that follow from others are left out in silence: contacts of rigid soles and repeated ends
 * have them by nature, and the audit counts them. */
static void report(const ambulo_problem *p, const int *rank, ambulo_diagnostics *diagnostics) {
  int warnings = 0;
  for (int r = 0; r < p->rows && warnings < MOST_WARNINGS; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    if (rank[r] != AMBULO__ROW_CONTRADICTORY) continue;
    warnings++;
    ambulo__warning(diagnostics, ambulo__nowhere, NULL,
                    "equality %s of %s (%s) at t = %.6g s contradicts the equalities before it",
                    row->family, row->subject, row->detail, row->time);
  }
}

ambulo_status ambulo__rank_sort(const ambulo__sparse_rows *rows, const double *value,
                                ambulo__run *run, ambulo__pool *pool, int *rank) {
  int width = widest_group(rows), capacity = width < rows->count ? width : rows->count;
  group g = {.rows = rows, .value = value};
  g.member = ambulo__pool_ints(pool, (size_t)rows->count);
  g.by_host = ambulo__pool_ints(pool, (size_t)rows->count);
  g.first = ambulo__pool_ints(pool, (size_t)rows->problem->nodes + 3);
  g.position = ambulo__pool_ints(pool, (size_t)rows->problem->variables);
  g.vector = ambulo__pool_doubles(pool, (size_t)capacity * (size_t)width);
  g.level = ambulo__pool_doubles(pool, (size_t)capacity);
  g.candidate = ambulo__pool_doubles(pool, (size_t)width);
  if (pool->failed) return AMBULO_E_MEMORY;
  memset(g.position, -1, (size_t)rows->problem->variables * sizeof *g.position);
  order_by_host(&g);
  for (int i = 0; i < rows->count; i++) rank[rows->row[i]] = AMBULO__ROW_INDEPENDENT;
  return sort_all(&g, run, rank) ? AMBULO_E_LIMIT : AMBULO_OK;
}

/* gradients and values of the rows at x; 0 when they are finite */
static int take(ambulo__sparse_rows *s, ambulo_workspace *workspace, const double *x,
                double *value) {
  if (ambulo__evaluate_jacobian(workspace, x) || ambulo__sparse_rows_fill(s, workspace, 1))
    return 1;
  ambulo__sparse_rows_values(s, workspace, value);
  return 0;
}

/* (P.1) what each equality adds to the span of those before it */
ambulo_status ambulo__presolve_rank(const ambulo_problem *p, ambulo_workspace *workspace,
                                    const double *start, ambulo__run *run, ambulo__pool *pool,
                                    ambulo_diagnostics *diagnostics, int *rank) {
  int count = 0;
  int *list = ambulo__pool_ints(pool, (size_t)p->equalities);
  double *x = ambulo__pool_doubles(pool, 2 * (size_t)p->variables);
  double *value = ambulo__pool_doubles(pool, (size_t)p->equalities);
  ambulo__sparse_rows s;
  if (pool->failed) return AMBULO_E_MEMORY;
  for (int r = 0; r < p->rows; r++) {
    rank[r] = AMBULO__ROW_INDEPENDENT;
    if (p->table.rows[r].relation == AMBULO_EQUAL) list[count++] = r;
  }
  ambulo__poll poll = run ? ambulo__run_poller(run) : (ambulo__poll){NULL, NULL};
  ambulo_status status = ambulo__sparse_rows_create(p, list, count, &poll, pool, &s);
  if (status) return status;
  double *x0 = x + p->variables;
  generic_point(p, start, x0);
  memcpy(x, x0, (size_t)p->variables * sizeof *x);
  if (take(&s, workspace, x0, value)) return AMBULO_OK; /* no finite point: keep every row */
  satisfy_border(&s, value, x0, x);
  if (take(&s, workspace, x, value)) return AMBULO_OK;
  status = ambulo__rank_sort(&s, value, run, pool, rank);
  if (!status) report(p, rank, diagnostics);
  return status;
}
