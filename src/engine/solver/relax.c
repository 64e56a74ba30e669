/* solver/relax.c - families of rows in conflict, and what each alone would have to give.
 *
 * 1. Every row gives way (elastic.c, all weights 1). The families that stay violated at the
 *    minimum are in conflict: their forces hold each other in balance.
 * 2. For each of these, the others are made stiff (weight 1000) and the family alone gives
 *    way. When the others then hold, it suffices to relax this family, by its worst violation:
 *    the point itself shows that this much is enough. Least squares spreads a violation over
 *    many rows; to lower the worst one the weights of its rows are multiplied by their share
 *    of the worst (Lawson's iteration for minimax problems), and the best point is kept.
 * 3. Of the family that gives way most easily, only one limit, or only the travel of periodic
 *    and mirrored ends, is tried: one number is better advice than three.
 */
#include "solver/explain.h"
#include "base/arithmetic.h"

#include <math.h>
#include <string.h>

enum { LAWSON_PASSES = 5 };
static const double stiff = 1e3;         /* weight of the other families */
static const double share = 1e-3;        /* of the worst: what still counts as in conflict */
static const double least_share = 0.03;  /* of the worst: a row below it keeps that much */
static const double narrowed_most = 4.0; /* how much more one limit may give than a family */
static const double main_part = 0.5;     /* of the time, for the first solve */

typedef struct relaxing {
  ambulo__elastic *elastic;
  int group;                     /* the family that gives way */
  const ambulo__table_row *only; /* NULL, or: only rows that say the same of another time */
  double *x, *candidate;         /* [n] */
  double *value;                 /* [rows] of the best point so far */
  double worst, others;          /* there; relative to the rows' sizes */
  double family_worst;           /* of the remedy, where its whole family gives way */
  int row;
} relaxing;

static const ambulo__row_kind_entry *kind_of(const ambulo_problem *p, int row) {
  return ambulo__row_kind_entry_of(p->table.rows[row].kind);
}

static int joins_ends(const ambulo__row_kind_entry *kind) {
  return kind->place == AMBULO__ACROSS_ENDS;
}

/* does row r give way? */
static int gives(const relaxing *s, int r) {
  const ambulo__table_row *row = &s->elastic->problem->table.rows[r], *only = s->only;
  if (row->group != s->group) return 0;
  if (!only) return 1;
  if (joins_ends(kind_of(s->elastic->problem, r)))
    return fabs(row->constant) > 1e-9; /* the travel, m */
  return ambulo__rows_alike(row, only);
}

/* worst row that gives way at `value`; -1 when all hold */
static int worst_row(const relaxing *s, const double *value) {
  const ambulo__elastic *e = s->elastic;
  int row = -1;
  double worst = 0.0;
  for (int r = 0; r < e->problem->rows; r++) {
    if (!gives(s, r)) continue;
    double excess = ambulo__elastic_excess(e, r, value[r]);
    if (excess > worst) {
      worst = excess;
      row = r;
    }
  }
  return row;
}

static double worst_outside(const relaxing *s, const double *value) {
  double worst = 0.0;
  for (int r = 0; r < s->elastic->problem->rows; r++) {
    if (!gives(s, r)) worst = ambulo__worse(worst, ambulo__elastic_excess(s->elastic, r, value[r]));
  }
  return worst;
}

/* ------------------------------------------------------------- all give way */

static int known(const ambulo_problem *p, const ambulo__explanation *out, int row) {
  for (int i = 0; i < out->view.conflict_count; i++) {
    if (p->table.rows[out->conflict_row[i]].group == p->table.rows[row].group) return 1;
  }
  return 0;
}

/* families by their worst excess at the point held, worst first */
static void list_conflicts(const ambulo__elastic *e, double floor, ambulo__explanation *out) {
  const double *value = e->workspace->row_value;
  for (double limit = floor; out->view.conflict_count < AMBULO__MOST_CONFLICTS;) {
    int next = -1;
    double worst = limit;
    for (int r = 0; r < e->problem->rows; r++) {
      double excess = ambulo__elastic_excess(e, r, value[r]);
      if (!(excess > worst) || known(e->problem, out, r)) continue;
      worst = excess;
      next = r;
    }
    if (next < 0) return;
    out->conflict_row[out->view.conflict_count] = next;
    ambulo_conflict *c = &out->conflict[out->view.conflict_count++];
    c->shared = ambulo__violation_of(e->problem, next, value[next]);
    c->alone = -1;
    limit = fmax(limit, share * ambulo__elastic_excess(e, next, value[next]));
  }
}

/* of all rows at the point held, relative to their sizes */
static double worst_violation(const ambulo__elastic *e) {
  double worst = 0.0;
  for (int r = 0; r < e->problem->rows; r++) {
    ambulo_violation v = ambulo__violation_of(e->problem, r, e->workspace->row_value[r]);
    worst = ambulo__worse(worst, ambulo__relative(&v));
  }
  return worst;
}

/* ------------------------------------------------------- one family gives way */

static void set_weights(const relaxing *s) {
  ambulo__elastic *e = s->elastic;
  for (int r = 0; r < e->problem->rows; r++) e->weight[r] = gives(s, r) ? 1.0 : stiff;
}

/* Lawson's step, from the excesses at the point held */
static void shift_weights(const relaxing *s) {
  ambulo__elastic *e = s->elastic;
  const double *value = e->workspace->row_value;
  int worst = worst_row(s, value);
  if (worst < 0) return;
  double largest = ambulo__elastic_excess(e, worst, value[worst]);
  for (int r = 0; r < e->problem->rows; r++) {
    if (!gives(s, r)) continue;
    double part = ambulo__elastic_excess(e, r, value[r]) / largest;
    e->weight[r] *= sqrt(fmax(least_share, part));
  }
}

/* keeps the point held when it is better */
static void keep(relaxing *s) {
  const ambulo__elastic *e = s->elastic;
  const double *value = e->workspace->row_value;
  double others = worst_outside(s, value);
  int row = worst_row(s, value);
  double worst = row < 0 ? 0.0 : ambulo__elastic_excess(e, row, value[row]);
  if (s->row >= -1 && (others > AMBULO__HOLDS || worst >= s->worst)) return;
  s->worst = worst;
  s->others = others;
  s->row = row;
  memcpy(s->value, value, (size_t)e->problem->rows * sizeof *value);
}

/* 1 when the family alone suffices, 0 when not, -1 when time was up before that was clear */
static int relax_alone(relaxing *s) {
  ambulo__elastic *e = s->elastic;
  memcpy(s->candidate, s->x, (size_t)e->n * sizeof *s->x);
  set_weights(s);
  s->row = -2; /* nothing kept yet */
  int settled = ambulo__elastic_minimize(e, s->candidate);
  if (ambulo__evaluate(e->workspace, s->candidate)) return -1;
  keep(s);
  if (s->others > AMBULO__HOLDS) return settled ? 0 : -1;
  for (int pass = 0; pass < LAWSON_PASSES && settled; pass++) {
    shift_weights(s);
    settled = ambulo__elastic_minimize(e, s->candidate);
    if (ambulo__evaluate(e->workspace, s->candidate)) break;
    keep(s);
  }
  return 1;
}

/* further subjects and details of the family that have to give way */
static void list_others(const relaxing *s, ambulo_conflict *c) {
  const ambulo__elastic *e = s->elastic;
  for (int r = 0; r < e->problem->rows; r++) {
    const ambulo__table_row *row = &e->problem->table.rows[r];
    double excess = ambulo__elastic_excess(e, r, s->value[r]);
    if (row->group != s->group || excess <= 0.01 * s->worst) continue;
    ambulo_violation v = ambulo__violation_of(e->problem, r, s->value[r]), *place = NULL;
    if (!strcmp(v.subject, c->relaxation.subject) && !strcmp(v.detail, c->relaxation.detail))
      continue;
    for (int i = 0; i < c->other_count && !place; i++) {
      if (!strcmp(v.subject, c->others[i].subject) && !strcmp(v.detail, c->others[i].detail))
        place = &c->others[i];
    }
    if (place) {
      if (v.worst > place->worst) *place = v;
    } else if (c->other_count < (int)(sizeof c->others / sizeof *c->others)) {
      c->others[c->other_count++] = v;
    }
  }
}

/* keeps what the remedy needs of the best point */
static void take_remedy(const relaxing *s, int conflict, ambulo__remedy *remedy) {
  remedy->conflict = conflict;
  remedy->row = s->row;
  memcpy(remedy->value, s->value, (size_t)s->elastic->problem->rows * sizeof *s->value);
}

/* a row of the group that stands for subject and detail of v */
static const ambulo__table_row *row_like(const ambulo_problem *p, int group,
                                         const ambulo_violation *v) {
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    if (row->group == group && !strcmp(row->subject, v->subject) && !strcmp(row->detail, v->detail))
      return row;
  }
  return NULL;
}

/* one limit, or the travel alone, instead of the whole family: a remedy of one number */
static void narrow(relaxing *s, double deadline, const ambulo__explanation *out,
                   ambulo__remedy *remedy) {
  if (remedy->conflict < 0) return;
  const ambulo_conflict *c = &out->conflict[remedy->conflict];
  const ambulo_problem *p = s->elastic->problem;
  int row = out->conflict_row[remedy->conflict], ends = joins_ends(kind_of(p, row));
  int tries = c->other_count == 0 ? 0 : ends ? 1 : 1 + c->other_count;
  double most = ends ? HUGE_VAL : narrowed_most * s->family_worst;
  s->group = p->table.rows[row].group;
  for (int i = 0; i < tries && !s->elastic->cancelled; i++) {
    double now = s->elastic->work;
    if (now >= deadline) break;
    s->elastic->deadline = now + (deadline - now) / (double)(tries - i);
    s->only = row_like(p, s->group, i == 0 ? &c->relaxation : &c->others[i - 1]);
    if (relax_alone(s) != 1 || s->row < 0 || s->worst >= most) continue;
    most = s->worst;
    remedy->single = 1;
    take_remedy(s, remedy->conflict, remedy);
  }
}

static void try_families(relaxing *s, double deadline, ambulo__explanation *out,
                         ambulo__remedy *remedy) {
  double least = HUGE_VAL;
  int count = out->view.conflict_count;
  for (int i = 0; i < count; i++) {
    ambulo_conflict *c = &out->conflict[i];
    double now = s->elastic->work;
    if (now >= deadline || s->elastic->cancelled) break;
    s->elastic->deadline = now + (deadline - now) / (double)(count - i + 1);
    const ambulo_problem *p = s->elastic->problem;
    const ambulo__row_kind_entry *kind = kind_of(p, out->conflict_row[i]);
    s->group = p->table.rows[out->conflict_row[i]].group;
    c->alone = relax_alone(s);
    if (c->alone != 1 || s->row < 0) continue;
    c->relaxation = ambulo__violation_of(p, s->row, s->value[s->row]);
    list_others(s, c);
    double cost = s->worst * kind->reluctance;
    if (kind->limited != AMBULO__NOT_LIMITED) cost *= (double)(1 + c->other_count);
    if (cost >= least) continue;
    s->family_worst = s->worst;
    least = cost;
    take_remedy(s, i, remedy);
  }
}

ambulo_status ambulo__relax(ambulo__elastic *e, double tolerance, double *x, ambulo__pool *pool,
                            ambulo__explanation *out, ambulo__remedy *remedy) {
  double now = e->work, deadline = e->deadline;
  relaxing s = {.elastic = e, .x = x};
  s.candidate = ambulo__pool_doubles(pool, (size_t)e->n);
  s.value = ambulo__pool_doubles(pool, (size_t)e->problem->rows);
  remedy->value = ambulo__pool_doubles(pool, (size_t)e->problem->rows);
  remedy->conflict = remedy->row = -1;
  if (pool->failed) return AMBULO_E_MEMORY;
  e->deadline = now + main_part * (deadline - now);
  out->view.complete = ambulo__elastic_minimize(e, x);
  if (ambulo__evaluate(e->workspace, x)) return AMBULO_OK;
  out->view.feasible_point = worst_violation(e) <= tolerance;
  if (out->view.feasible_point) return AMBULO_OK;
  list_conflicts(e, 10.0 * tolerance, out);
  int near = worst_violation(e) <= AMBULO__NEAR_MISS;
  out->view.confirmed |= out->view.complete && !near;
  if (near || ambulo__ended_by_cap(e->run)) return AMBULO_OK;
  try_families(&s, deadline, out, remedy);
  narrow(&s, deadline, out, remedy);
  for (int i = 0; i < out->view.conflict_count; i++) {
    if (out->conflict[i].alone < 0) out->view.complete = 0;
  }
  (void)ambulo__evaluate(e->workspace, x); /* was finite before */
  return AMBULO_OK;
}
