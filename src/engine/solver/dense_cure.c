/* solver/dense_cure.c - how many intervals would bring the ratios under 1.
 *
 * Between nodes that both hold a row its violation goes down with a power p of the number of
 * intervals (dense.h). Beside an event it grows from the last node that holds the row, at a
 * rate that the motion has: e at the end of contacts, e' at their beginning. Predicted for N'
 * intervals
 *
 *     ratio(N') = max( between (N / N')^p,  max_E e_E gap_before(E, N'),  max_E e'_E gap_after(E,
 * N') )
 *
 * The rates come from the same motion with all events a little later (the rows of contacts that
 * end, where they are not asked for) and a little earlier (the rows of contacts that begin): an
 * event that falls on a node today has a gap of zero, and none on another grid.
 *
 * Grids on events have no gaps, whatever their number of intervals: no rates are looked for.
 *
 * A new solve has another motion. What is predicted must therefore stay below `target`, not 1.
 */
#include "solver/dense.h"

#include <math.h>
#include <string.h>

enum { SAMPLES = 5, MOST_INTERVALS = 1000, END = 0, BEGINNING = 1 };

static const double target = 0.7;
static const double shortest_distance = 0.2; /* of a sample to its node, in intervals */

typedef struct forecast {
  const ambulo_problem *problem;
  const ambulo__events *events;
  const ambulo__dense_worst *worst;
  double *rate; /* [2][events][rules], 1/s */
  int side;     /* that is looked at: END or BEGINNING */
  double reach; /* s, beyond the event */
} forecast;

int ambulo__dense_is_strict(const ambulo_problem *p) {
  const ambulo_problem_definition *d = &p->definition;
  return d->contact_count > 0 && !(d->contact_tolerance > 0.0) &&
         (d->ground_penetration || d->foot_strike);
}

int ambulo__dense_spline_intervals(const ambulo_problem *p, int intervals) {
  int own = ambulo__basis_intervals(p->basis), n = p->definition.intervals;
  if (!ambulo__dense_is_strict(p) || p->definition.breakpoints) return own;
  return (int)ceil((double)own * intervals / n);
}

static double *rate_of(const forecast *f, int side, int event, int rule) {
  size_t at = (size_t)side * (size_t)f->events->count + (size_t)event;
  return &f->rate[at * AMBULO__DENSE_RULES + (size_t)rule];
}

/* ------------------------------------------------------------------- rates */

/* distance of a time from the node that holds the rows beside the event; 0: too near, or beyond the
 * event although the gap itself is long enough to tell */
static double distance(const forecast *f, int event, double time) {
  const ambulo_problem_definition *d = &f->problem->definition;
  double e = f->events->time[event], step = d->duration / d->intervals;
  double gap = f->side == END ? ambulo__dense_gap_before(e, d->duration, d->intervals)
                              : ambulo__dense_gap_after(e, d->duration, d->intervals);
  double beyond = f->side == END ? time - e : e - time;
  double away = gap + beyond;
  return away >= shortest_distance * step && beyond <= fmax(0.0, f->reach - gap) ? away : 0.0;
}

static void note_rate(void *user, const ambulo__dense_sample *sample) {
  forecast *f = user;
  double ratio = ambulo__dense_ratio(sample);
  if (!(ratio > 0.0) || !ambulo__dense_rule_at(sample->rule)->at_events) return;
  for (int event = 0; event < f->events->count; event++) {
    double away = distance(f, event, sample->time);
    double *rate = rate_of(f, f->side, event, sample->rule);
    double power = f->side == END ? 1.0 : ambulo__dense_rule_at(sample->rule)->order_landing;
    if (away > 0.0) *rate = fmax(*rate, ratio / pow(away, power));
  }
}

/* half of the shortest time between two events or nodes: moved events keep their order */
static double reach_of(const forecast *f) {
  const ambulo_problem_definition *d = &f->problem->definition;
  double reach = d->duration / d->intervals, before = 0.0;
  for (int i = 0; i <= f->events->count; i++) {
    double time = i < f->events->count ? f->events->time[i] : d->duration;
    reach = fmin(reach, time - before);
    before = time;
  }
  return 0.5 * reach;
}

static ambulo_status find_rates(forecast *f, const double *x, const ambulo_allocator *allocator) {
  f->reach = reach_of(f);
  if (f->events->count == 0 || f->problem->definition.grid != AMBULO_GRID_UNIFORM) return AMBULO_OK;
  for (f->side = END; f->side <= BEGINNING; f->side++) {
    ambulo__dense dense;
    double shift = f->side == END ? f->reach : -f->reach;
    ambulo_status status =
        ambulo__dense_open(f->problem, x, SAMPLES, shift, allocator, NULL, &dense);
    if (status == AMBULO_E_MEMORY) return status;
    if (status) continue; /* no such motion is legal: what is measured at the nodes must do */
    ambulo__dense_rows(&dense, note_rate, f);
    ambulo__dense_slip(&dense, note_rate, f);
    ambulo__dense_close(&dense);
  }
  return AMBULO_OK;
}

/* ---------------------------------------------------------------- forecast */

/* the power of the number of intervals with which a rule goes down between nodes */
static double order_of(const forecast *f, const ambulo__dense_rule *rule) {
  return ambulo__dense_is_strict(f->problem) ? rule->order_both : rule->order_alone;
}

/* (A.2c) error expected on a grid of N' intervals */
static double predicted(const forecast *f, int rule, int intervals) {
  const ambulo_problem_definition *d = &f->problem->definition;
  const ambulo__dense_rule *r = ambulo__dense_rule_at(rule);
  double finer = (double)d->intervals / intervals;
  double ratio = f->worst->entry[rule].between * pow(finer, order_of(f, r));
  for (int i = 0; r->at_events && i < f->events->count; i++) {
    double e = f->events->time[i];
    double before = ambulo__dense_gap_before(e, d->duration, intervals);
    double after = ambulo__dense_gap_after(e, d->duration, intervals);
    ratio = fmax(ratio, *rate_of(f, END, i, rule) * before);
    ratio = fmax(ratio, *rate_of(f, BEGINNING, i, rule) * pow(after, r->order_landing));
  }
  return ratio;
}

/* whether more intervals help this rule at all */
static int helps(const forecast *f, int rule) {
  const ambulo__dense_entry *entry = &f->worst->entry[rule];
  if (ambulo__dense_is_strict(f->problem) && f->problem->definition.breakpoints)
    return 0; /* those would have to be new */
  return entry->present && !isnan(entry->ratio) && order_of(f, ambulo__dense_rule_at(rule)) > 0.0;
}

static int most_intervals(const forecast *f) {
  int own = f->problem->definition.intervals;
  return own < MOST_INTERVALS / 4 ? MOST_INTERVALS : 4 * own; /* a problem has 100000 at most */
}

/* the fewest intervals that are predicted to suffice for this rule; 0: not within the limit */
static int fewest_for(const forecast *f, int rule) {
  int most = most_intervals(f);
  for (int n = f->problem->definition.intervals + 1; n <= most; n++) {
    if (predicted(f, rule, n) <= target) return n;
  }
  return 0;
}

/* the fewest that suffice for every rule in `fewest` with a number at once; 0: none */
static int fewest_for_all(const forecast *f, const int *fewest) {
  int n = 0, most = most_intervals(f);
  for (int rule = 0; rule < AMBULO__DENSE_RULES; rule++) n = fewest[rule] > n ? fewest[rule] : n;
  for (; n > 0 && n <= most; n++) {
    int rule = 0;
    while (rule < AMBULO__DENSE_RULES && (fewest[rule] == 0 || predicted(f, rule, n) <= target))
      rule++;
    if (rule == AMBULO__DENSE_RULES) return n;
  }
  return 0;
}

/* the rule that asks for most is left out until a number suffices for the others */
static int leave_out_one(int *fewest) {
  int most = 0;
  for (int rule = 1; rule < AMBULO__DENSE_RULES; rule++) {
    if (fewest[rule] > fewest[most]) most = rule;
  }
  int found = fewest[most] > 0;
  fewest[most] = 0;
  return found;
}

static void find(const forecast *f, ambulo__dense_cure *cure) {
  int fewest[AMBULO__DENSE_RULES], fails = 0;
  for (int rule = 0; rule < AMBULO__DENSE_RULES; rule++) {
    fewest[rule] = helps(f, rule) ? fewest_for(f, rule) : 0;
    fails |= fewest[rule] > 0 && !(f->worst->entry[rule].ratio <= 1.0);
    cure->out_of_reach[rule] = helps(f, rule);
  }
  if (!fails) return;
  do cure->intervals = fewest_for_all(f, fewest);
  while (cure->intervals == 0 && leave_out_one(fewest));
  for (int rule = 0; rule < AMBULO__DENSE_RULES; rule++) {
    cure->cured[rule] = fewest[rule] > 0;
    cure->out_of_reach[rule] &= !cure->cured[rule];
  }
  if (cure->intervals == 0) return;
  cure->spline_intervals = ambulo__dense_spline_intervals(f->problem, cure->intervals);
}

ambulo_status ambulo__dense_cure_find(const ambulo_problem *p, const double *x,
                                      const ambulo__events *events,
                                      const ambulo__dense_worst *worst,
                                      const ambulo_allocator *allocator, ambulo__dense_cure *cure) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  forecast f = {.problem = p, .events = events, .worst = worst};
  memset(cure, 0, sizeof *cure);
  f.rate = ambulo__alloc(&own, 2 * (size_t)events->count * AMBULO__DENSE_RULES, sizeof *f.rate);
  if (!f.rate) return AMBULO_E_MEMORY;
  ambulo_status status = find_rates(&f, x, &own);
  if (!status) find(&f, cure);
  ambulo__free(&own, f.rate);
  return status;
}
