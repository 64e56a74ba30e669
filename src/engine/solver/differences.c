/* solver/differences.c - df*_dp of every number of a problem, by differences of its Lagrangian.
 *
 * At a solution x* with multipliers lambda the envelope theorem (Fiacco 1976; Boyd & Vandenberghe,
 * Convex Optimization, 5.6) gives the change of the least objective f* with a number p of the
 * problem, without another solve:
 *
 *     df* / dp = dL(x*, lambda; p) / dp,     L = f(x; p) - sum_r lambda_r c_r(x; p)
 *
 * for rows c_r = 0 and c_r >= 0, lambda_r >= 0 of the latter. The definition is made a problem
 * again with p a little smaller and a little larger (sensitivity.h), at the same x and lambda:
 *
 *     D(h) = (L(p + h) - L(p - h)) / 2 h = dL/dp + a h^2 + b h^4 + ...
 *
 * Steps h_k = h_0 / 4^k remove one power after the other (Richardson; the tableau of Romberg):
 *
 *     D_k0 = D(h_k),     D_kj = D_k,j-1 + (D_k,j-1 - D_k-1,j-1) / (16^j - 1)
 *
 * Its error is taken to be the larger of its distances from the two it was made of. h_0 is 5 % of
 * the change that a person can picture - 0.5 mm of a step, 5 % of 1 % of a ratio - and 1 % where
 * nodes go along, which are a millisecond apart. The tableau ends where that error is 1e-9 of D or
 * rounding of L, eps S / h with S the sum of the sizes of those terms and rows that change (the
 * others cancel, part by part).
 *
 * Where there is no such problem on one side (a margin below 0), or one whose phases have other
 * numbers of intervals (two that have equal claims to one), the other side alone is used,
 * L(p + h) - L(p) = h dL/dp + a h^2 + ...: with 4^j in place of 16^j.
 *
 * There is no derivative
 *   - where a side has other rows or events, at any step: an event that splits in two, a foot that
 *     leaves level ground;
 *   - at a kink: the slopes of the two sides stay as far apart as they are, however small the step,
 *     while those of a smooth function draw together in proportion to it;
 *   - where the tableau does not settle to 1e-4 of D.
 *
 * What does not depend on all is cheaper. A number of a term changes that term alone, at the same
 * channels. A bound b of rows y - b >= 0 and b - y >= 0 has dL/db = lambda and -lambda; where the
 * strength of a joint is its torque limit, the term has its part as well.
 */
#include "solver/sensitivity.h"

#include "contact/row_families.h"
#include "contact/schedule.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { LEVELS = 7, LIMITED_KINDS = AMBULO_LIMITED_TORQUE - AMBULO_LIMITED_POSITION + 1 };
static const double first_step = 0.05, first_of_events = 0.01; /* of what a person can picture */
static const double ratio = 4.0;                               /* of one step to the next */
static const double settled = 1e-9, unsettled = 1e-4, linear = 1e-8, apart = 1e-6;

typedef enum side_kind {
  SIDE_THERE,
  SIDE_MISSING, /* there is no such problem, or its phases have other numbers of intervals */
  SIDE_OTHER    /* it has other rows, or other events */
} side_kind;

/* What L is made of in one problem, and its travel. Of a number of a term that term alone, once. */
typedef struct side {
  side_kind kind;
  double *value; /* [terms + rows] */
  double travel;
} side;

typedef struct stationary {
  ambulo__parameters *p;
  ambulo_workspace *workspace; /* of the problem, at x */
  const double *x, *multiplier;
  double *block; /* all of the arrays */
  side here, low, high;
  double *pull; /* [d][kinds of limits][2]: what their bounds add to dL */
} stationary;

/* ------------------------------------------------------------------ one side */

/* no time has come near a neighbour's: phases have as many intervals as before */
static int same_grid(const double *a, const double *b, int intervals) {
  for (int k = 1; k < intervals; k++)
    if (fabs(b[k] - a[k]) > 0.5 * fmin(a[k] - a[k - 1], a[k + 1] - a[k])) return 0;
  return 1;
}

static int same_grids(const ambulo_problem *a, const ambulo_problem *b) {
  return a->variables == b->variables && a->nodes == b->nodes &&
         same_grid(a->times, b->times, a->nodes - 1) &&
         same_grid(ambulo__basis_breakpoints(a->basis), ambulo__basis_breakpoints(b->basis),
                   ambulo__basis_intervals(a->basis));
}

static int same_rows(const ambulo_problem *a, const ambulo_problem *b) {
  if (a->rows != b->rows) return 0;
  for (int r = 0; r < a->rows; r++) {
    const ambulo__table_row *one = &a->table.rows[r], *other = &b->table.rows[r];
    if (!ambulo__rows_alike(one, other) || one->kind != other->kind || one->node != other->node ||
        one->before != other->before || one->relation != other->relation)
      return 0;
  }
  return 1;
}

static void take(const ambulo_workspace *w, side *out) {
  const ambulo_problem *p = w->problem;
  size_t terms = (size_t)p->definition.term_count;
  memcpy(out->value, w->term_value, terms * sizeof *out->value);
  memcpy(out->value + terms, w->row_value, (size_t)p->rows * sizeof *out->value);
  out->travel = p->definition.travel;
}

/* L of one less that of the other, part by part, so that what has not changed adds no rounding;
 * *size of those that have. */
static double change(const stationary *s, const ambulo__parameter *n, const side *from,
                     const side *to, double *size) {
  const ambulo_problem *p = s->p->problem;
  int terms = n->enters == AMBULO__ENTERS_ALL ? p->definition.term_count : 1;
  int rows = n->enters == AMBULO__ENTERS_ALL ? p->rows : 0;
  double sum = 0.0;
  for (int i = 0; i < terms + rows; i++) {
    double part = to->value[i] - from->value[i],
           factor = i < terms ? 1.0 : -s->multiplier[i - terms];
    if (part == 0.0 || factor == 0.0) continue;
    double scale = i < terms ? 0.0 : p->table.rows[i - terms].size;
    sum += factor * part;
    *size += fabs(factor) * fmax(fabs(to->value[i]), scale);
  }
  return sum;
}

/* -1: memory ran out */
static int count_events(const ambulo_problem *p) {
  ambulo__events events;
  if (p->definition.grid != AMBULO_GRID_EVENTS) return 0;
  if (ambulo__events_create(&p->definition, AMBULO__EVENTS_OF_ROWS, &p->allocator, &events))
    return -1;
  ambulo__free(&p->allocator, events.time);
  return events.count;
}

/* of a problem on another side. E_MEMORY */
static ambulo_status kind_of(const ambulo_problem *p, const ambulo_problem *other,
                             side_kind *kind) {
  int before = count_events(p), now = count_events(other);
  if (before < 0 || now < 0) return AMBULO_E_MEMORY;
  *kind = before != now ? SIDE_OTHER : SIDE_MISSING;
  if (before == now && same_grids(p, other)) *kind = same_rows(p, other) ? SIDE_THERE : SIDE_OTHER;
  return AMBULO_OK;
}

/* E_MEMORY */
static ambulo_status look_again(const stationary *s, side *out) {
  ambulo_problem *other = NULL;
  ambulo_workspace *w = NULL;
  ambulo_status status = ambulo__variant_problem(&s->p->variant, NULL, 0, &other);
  if (status == AMBULO_E_MEMORY) return status;
  out->kind = SIDE_MISSING;
  status = other ? kind_of(s->p->problem, other, &out->kind) : AMBULO_OK;
  if (!status && out->kind == SIDE_THERE)
    status = ambulo__workspace_create_for_values(other, &s->p->allocator, &w);
  if (w && ambulo__evaluate(w, s->x)) out->kind = SIDE_MISSING;
  if (w && out->kind == SIDE_THERE) take(w, out);
  ambulo_workspace_free(w);
  ambulo_problem_free(other);
  return status;
}

/* at a value of the number, which is put back */
static ambulo_status look(const stationary *s, const ambulo__parameter *n, double value,
                          side *out) {
  enum { MOST = 64 };
  double before[MOST];
  if (n->addresses > MOST) {
    out->kind = SIDE_OTHER;
    return AMBULO_OK;
  }
  for (int i = 0; i < n->addresses; i++) before[i] = *s->p->address[n->address + i].at;
  ambulo_status status = AMBULO_OK;
  ambulo__parameter_set(s->p, n, value);
  if (n->enters == AMBULO__ENTERS_ALL) {
    status = look_again(s, out);
  } else {
    ambulo_term *term = ambulo__variant_own(&s->p->variant.definition.terms[n->term]);
    if (term->strength_is_limits)
      ambulo__strength_of_limits(s->p->variant.coordinates, s->p->problem->coordinates, term->price,
                                 ambulo__variant_own(term->strength));
    status = ambulo__variant_term_value(&s->p->variant, s->workspace, term, out->value);
    out->kind = isfinite(out->value[0]) ? SIDE_THERE : SIDE_MISSING;
    out->travel = 0.0;
  }
  for (int i = 0; i < n->addresses; i++) *s->p->address[n->address + i].at = before[i];
  return status;
}

/* -------------------------------------------------------------------- tableau */

typedef struct tableau {
  int levels, of_one_side;
  double entry[LEVELS][LEVELS];
  double best, error;
} tableau;

/* D_kj of one more level */
static void add_level(tableau *t, double slope) {
  int k = t->levels++;
  double base = t->of_one_side ? ratio : ratio * ratio, power = base;
  t->entry[k][0] = slope;
  if (k == 0) t->best = slope;
  for (int j = 1; j <= k; j++) {
    double left = t->entry[k][j - 1], above = t->entry[k - 1][j - 1];
    t->entry[k][j] = left + (left - above) / (power - 1.0);
    power *= base;
    double error = fmax(fabs(t->entry[k][j] - left), fabs(t->entry[k][j] - above));
    if (!(error <= t->error)) continue;
    t->error = error;
    t->best = t->entry[k][j];
  }
}

static int is_settled(const tableau *t, double tolerance, double noise) {
  return t->error <= tolerance * fabs(t->best) + noise;
}

/* the slopes of the two sides, (L(p + h) - L(p)) / h and (L(p) - L(p - h)) / h: how far apart */
typedef struct bend {
  double now, before;
  int levels;
} bend;

static int is_kink(const bend *b, double slope, double noise) {
  return b->levels >= 2 && fabs(b->now) > 0.6 * fabs(b->before) &&
         fabs(b->now) > apart * fabs(slope) + 10.0 * noise;
}

/* ----------------------------------------------------------------- one number */

/* derivative and travel at steps from h on; *found: it has one. E_MEMORY */
static ambulo_status differ(stationary *s, ambulo__parameter *n, int *found) {
  tableau slope = {.error = HUGE_VAL}, travel = {.error = HUGE_VAL};
  bend b = {0.0, 0.0, 0};
  double h = (n->moves_events ? first_of_events : first_step) * ambulo__parameter_step(n),
         noise = 0.0;
  ambulo_status status = AMBULO_OK;
  if (n->enters != AMBULO__ENTERS_ALL) status = look(s, n, n->value, &s->here);
  *found = 0;
  for (int k = 0; k < LEVELS && !status; k++) {
    if (k > 0) h /= ratio;
    status = look(s, n, n->value - h, &s->low);
    if (!status) status = look(s, n, n->value + h, &s->high);
    int low = s->low.kind == SIDE_THERE, high = s->high.kind == SIDE_THERE, one_side = low != high;
    if (status || (!low && !high) || s->low.kind == SIDE_OTHER || s->high.kind == SIDE_OTHER)
      continue;
    if (slope.levels == 0 || one_side != slope.of_one_side)
      slope = travel = (tableau){.error = HUGE_VAL, .of_one_side = one_side};
    double size = 0.0, width = (low + high) * h;
    double down = low ? change(s, n, &s->low, &s->here, &size) : 0.0;
    double up = high ? change(s, n, &s->here, &s->high, &size) : 0.0;
    noise = 4.0 * DBL_EPSILON * size / h;
    add_level(&slope, (down + up) / width);
    add_level(&travel,
              ((high ? s->high : s->here).travel - (low ? s->low : s->here).travel) / width);
    b = (bend){(up - down) / h, b.now, one_side ? 0 : b.levels + 1};
    int straight = k == 0 && !one_side && fabs(b.now) <= linear * fabs(slope.best) + noise;
    if (straight || is_settled(&slope, settled, noise)) break;
  }
  n->derivative = slope.best;
  n->travel = travel.best;
  *found = slope.levels > 0 && !is_kink(&b, slope.best, noise) &&
           (slope.levels == 1 || is_settled(&slope, unsettled, noise));
  return status;
}

/* --------------------------------------------------------------------- limits */

static int index_of(int coordinate, int what, int is_upper) {
  return 2 * (LIMITED_KINDS * coordinate + what - AMBULO_LIMITED_POSITION) + is_upper;
}

/* -sum lambda dc/db over the rows of limits: y - lo >= 0, hi - y >= 0. With mirrored
 * ends a row may be the partner's (contact/row_families.h): its upper bound has dc/db = 1 and its
 * lower one -1, whichever side it is on. */
static void pull_at_limits(const stationary *s) {
  const ambulo_problem *p = s->p->problem;
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    int what = ambulo__row_kind_entry_of(row->kind)->limited;
    if (s->multiplier[r] == 0.0 || row->relation == AMBULO_EQUAL || what == AMBULO__NOT_LIMITED)
      continue;
    const ambulo__row_term *term = p->table.terms + row->first_term;
    ambulo__bounds bounds =
        ambulo__bounds_of(&p->definition, term->channel % p->coordinates, (ambulo_limited)what);
    const ambulo__bound *bound = term->coefficient > 0.0 ? &bounds.low : &bounds.high;
    s->pull[index_of(bound->owner, what, bound->is_upper)] -=
        bound->is_upper ? s->multiplier[r] : -s->multiplier[r];
  }
}

/* which limit a member of the variant's coordinates is */
static int limit_at(const ambulo__variant *v, const double *at, int *what) {
  for (int i = 0; i < v->origin->coordinates; i++)
    for (*what = AMBULO_LIMITED_POSITION; *what <= AMBULO_LIMITED_TORQUE; ++*what) {
      const double *limits = ambulo__limits_of(&v->coordinates[i], (ambulo_limited)*what);
      if (at == limits || at == limits + 1) return index_of(i, *what, (int)(at - limits));
    }
  return -1;
}

static ambulo_status pull_at_strengths(stationary *s, ambulo__parameter *n) {
  for (int t = 0; t < s->p->problem->definition.term_count; t++) {
    ambulo__parameter of_term = *n;
    int found = 0;
    if (!s->p->variant.definition.terms[t].strength_is_limits) continue;
    of_term.term = t;
    ambulo_status status = differ(s, &of_term, &found);
    if (status) return status;
    if (found) n->derivative += of_term.derivative;
  }
  return AMBULO_OK;
}

/* of one limit; of an untouched one 0 */
static ambulo_status differ_limit(stationary *s, ambulo__parameter *n) {
  const ambulo__address *m = &s->p->address[n->address];
  int what = AMBULO__NOT_LIMITED;
  n->derivative = 0.0;
  for (int k = 0; k < n->addresses; k++)
    n->derivative += m[k].sign * s->pull[limit_at(&s->p->variant, m[k].at, &what)];
  return what == AMBULO_LIMITED_TORQUE ? pull_at_strengths(s, n) : AMBULO_OK;
}

/* ------------------------------------------------------------------------ all */

static ambulo_status differ_all(stationary *s) {
  ambulo__parameters *p = s->p;
  ambulo_status status = AMBULO_OK;
  int kept = 0;
  pull_at_limits(s);
  for (int i = 0; i < p->count && !status; i++) {
    ambulo__parameter *n = &p->list[i];
    if (n->enters == AMBULO__ENTERS_ALL) take(s->workspace, &s->here);
    int found = 1, limits = n->enters == AMBULO__ENTERS_LIMITS;
    status = limits ? differ_limit(s, n) : differ(s, n, &found);
    if (found && !(limits && n->derivative == 0.0)) p->list[kept++] = *n;
  }
  p->count = kept;
  return status;
}

/* E_MEMORY, E_NUMERIC; to be closed in either case */
static ambulo_status open_point(ambulo__parameters *p, const double *x, const double *multiplier,
                                stationary *s) {
  const ambulo_problem *problem = p->problem;
  size_t parts = (size_t)problem->definition.term_count + (size_t)problem->rows + 1;
  *s = (stationary){.p = p, .x = x, .multiplier = multiplier};
  size_t limits = 2 * LIMITED_KINDS * (size_t)problem->coordinates;
  s->block = ambulo__alloc(&p->allocator, 3 * parts + limits, sizeof *s->block);
  if (!s->block) return AMBULO_E_MEMORY;
  s->here.value = s->block;
  s->low.value = s->block + parts;
  s->high.value = s->block + 2 * parts;
  s->pull = s->block + 3 * parts;
  ambulo_status status = ambulo__workspace_create_for_values(problem, &p->allocator, &s->workspace);
  return status ? status : ambulo__evaluate(s->workspace, x);
}

static void close_point(stationary *s) {
  ambulo_workspace_free(s->workspace);
  ambulo__free(&s->p->allocator, s->block);
}

ambulo_status ambulo__parameters_differ(ambulo__parameters *p, const double *x,
                                        const double *multiplier) {
  stationary s;
  ambulo_status status = open_point(p, x, multiplier, &s);
  if (!status) status = differ_all(&s);
  close_point(&s);
  return status;
}

/* at a point of no meaning, where every row pulls in a way of its own */
ambulo_status ambulo__parameter_is_smooth(ambulo__parameters *p, const ambulo__parameter *number,
                                          int *smooth) {
  const ambulo_problem *problem = p->problem;
  size_t variables = (size_t)problem->variables, rows = (size_t)problem->rows;
  ambulo__parameter copy = *number;
  *smooth = 1;
  if (!number->moves_events) return AMBULO_OK;
  stationary s;
  double *x = ambulo__alloc(&p->allocator, variables + rows, sizeof *x),
         *multiplier = x + variables;
  if (!x) return AMBULO_E_MEMORY;
  ambulo__start_pose(problem, x);
  for (size_t k = 0; k < variables; k++) x[k] += 0.02 * sin((double)k + 1.0);
  for (size_t r = 0; r < rows; r++) multiplier[r] = sin((double)r + 1.0);
  ambulo_status status = open_point(p, x, multiplier, &s);
  if (!status) take(s.workspace, &s.here);
  if (!status) status = differ(&s, &copy, smooth);
  close_point(&s);
  ambulo__free(&p->allocator, x);
  return status == AMBULO_E_NUMERIC ? AMBULO_OK : status;
}
