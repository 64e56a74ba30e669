/* solver/event_rates.c - see event_rates.h.
 *
 * Between neighbouring events e, e' nodes and knots are equally spaced (contact/phases.c), so that
 * one at t moves by
 *
 *     t. = e. + (t - e) / (e' - e) (e'. - e.),    0. = T. = 0
 *
 * Where the tip of a foot begins to have to clear the ground, or where a foot comes to the edge of
 * a step and is past it, off + r (down - off) of a swing, that moves by (1 - r) off. + r down. s.
 * What hands hold has its window's ramps from `from` to from + ramp and from to - ramp to `to`.
 */
#include "solver/event_rates.h"

#include "base/arithmetic.h"
#include "contact/hold_times.h"

#include <math.h>
#include <string.h>

static const double rounding = 1e-12; /* of factors */

typedef struct sum {
  int source[2];
  double factor[2];
} sum;

static int same(const sum *a, const sum *b) {
  for (int i = 0; i < 2; i++)
    if (a->source[i] != b->source[i] || fabs(a->factor[i] - b->factor[i]) > rounding) return 0;
  return 1;
}

static void blur(ambulo__event_map *map, const sum *s) {
  for (int i = 0; i < 2; i++)
    if (s->source[i] >= 0) map->unclear[s->source[i]] = 1;
}

/* what the event of the rows at `time` is; two different answers are none */
static void settle(ambulo__event_map *map, double time, sum is) {
  double duration = map->problem->definition.duration;
  int row = ambulo__event_at(&map->rows, time);
  if (fabs(time) <= AMBULO__INSTANT || fabs(time - duration) <= AMBULO__INSTANT) blur(map, &is);
  if (row < 0) return;
  sum was = {{map->source[2 * row], map->source[2 * row + 1]},
             {map->factor[2 * row], map->factor[2 * row + 1]}};
  if (was.source[0] < 0 && was.source[1] < 0) {
    memcpy(map->source + 2 * row, is.source, sizeof is.source);
    memcpy(map->factor + 2 * row, is.factor, sizeof is.factor);
  } else if (!same(&was, &is)) {
    blur(map, &was);
    blur(map, &is);
  }
}

/* what is at `time`, a fixed share of a swing */
static void settle_share(ambulo__event_map *map, ambulo__span air, double time) {
  double r = (time - air.from) / (air.to - air.from);
  int off = air.begins >= 0 ? map->of_contact[2 * air.begins + 1] : -1;
  int down = air.ends >= 0 ? map->of_contact[2 * air.ends] : -1;
  sum is = {{off, down}, {off >= 0 ? 1.0 - r : 0.0, down >= 0 ? r : 0.0}};
  if (off == down) is = (sum){{off, -1}, {off >= 0 ? 1.0 : 0.0, 0.0}}; /* between two contacts */
  settle(map, time, is);
}

/* the swing beside one end of a contact */
static void settle_swing(ambulo__event_map *map, int foot, double time) {
  const ambulo_problem_definition *d = &map->problem->definition;
  ambulo__span air;
  double tip = ambulo__tip_time(d, foot, time, &air), edge[2];
  if (!(air.to - air.from > AMBULO__INSTANT)) return; /* between two contacts */
  if (d->model->feet[foot].has_tip) settle_share(map, air, tip);
  int edges = ambulo__edge_times(d, foot, air, edge);
  for (int i = 0; i < edges; i++) settle_share(map, air, edge[i]);
}

/* what is asked for at a time of its own: an event that would carry it along is unclear */
static void hold(ambulo__event_map *map, double time) {
  int row = ambulo__event_at(&map->rows, time);
  if (row < 0) return;
  sum was = {{map->source[2 * row], map->source[2 * row + 1]}, {0.0, 0.0}};
  blur(map, &was);
}

static void settle_all(ambulo__event_map *map) {
  const ambulo_problem_definition *d = &map->problem->definition;
  for (int e = 0; e < map->contacts.count; e++)
    settle(map, map->contacts.time[e], (sum){{e, -1}, {1.0, 0.0}});
  for (int c = 0; ambulo__has_tip_rows(d) && c < d->contact_count; c++) {
    if (d->contacts[c].foot < 0) continue;
    settle_swing(map, d->contacts[c].foot, d->contacts[c].from);
    settle_swing(map, d->contacts[c].foot, d->contacts[c].to);
  }
  for (int i = 0; i < d->reach_count; i++) {
    hold(map, d->reaches[i].from);
    hold(map, d->reaches[i].to);
  }
  for (int i = 0; i < d->hold_count; i++) {
    double time[4];
    int count = ambulo__hold_events(&d->holds[i], d->duration, time);
    for (int k = 0; k < count; k++) hold(map, time[k]);
  }
}

static ambulo_status take_events(ambulo__event_map *map, ambulo__event_kind kind,
                                 ambulo__pool *pool, ambulo__events *events) {
  ambulo__events found;
  const ambulo_allocator *a = &pool->allocator;
  ambulo_status status = ambulo__events_create(&map->problem->definition, kind, a, &found);
  if (status) return status;
  events->count = found.count;
  events->time = ambulo__pool_doubles(pool, (size_t)found.count);
  if (events->time && found.count)
    memcpy(events->time, found.time, (size_t)found.count * sizeof *found.time);
  ambulo__free(a, found.time);
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

/* not all events have a knot (contact/phases.h) */
static ambulo_status take_knots(ambulo__event_map *map, ambulo__pool *pool) {
  const ambulo__basis *basis = map->problem->basis;
  const double *knot = ambulo__basis_breakpoints(basis);
  map->knots.time = ambulo__pool_doubles(pool, (size_t)map->contacts.count);
  if (pool->failed) return AMBULO_E_MEMORY;
  for (int e = 0, k = 0; e < map->contacts.count; e++) {
    double time = map->contacts.time[e];
    while (k < ambulo__basis_intervals(basis) && knot[k] < time - AMBULO__INSTANT) k++;
    if (fabs(knot[k] - time) <= AMBULO__INSTANT) map->knots.time[map->knots.count++] = time;
  }
  return AMBULO_OK;
}

ambulo_status ambulo__event_map_create(const ambulo_problem *problem, ambulo__pool *pool,
                                       ambulo__event_map *map) {
  const ambulo_problem_definition *d = &problem->definition;
  *map = (ambulo__event_map){.problem = problem};
  ambulo_status status = take_events(map, AMBULO__EVENTS_OF_CONTACTS, pool, &map->contacts);
  if (!status) status = take_events(map, AMBULO__EVENTS_OF_ROWS, pool, &map->rows);
  if (!status && d->knots == AMBULO_GRID_EVENTS) status = take_knots(map, pool);
  if (status) return status;
  map->of_contact = ambulo__pool_ints(pool, 2 * (size_t)d->contact_count);
  map->source = ambulo__pool_ints(pool, 2 * (size_t)map->rows.count);
  map->factor = ambulo__pool_doubles(pool, 2 * (size_t)map->rows.count);
  map->unclear = ambulo__pool_ints(pool, (size_t)map->contacts.count);
  if (pool->failed) return AMBULO_E_MEMORY;
  for (int c = 0; c < d->contact_count; c++) {
    map->of_contact[2 * c] = ambulo__event_at(&map->contacts, d->contacts[c].from);
    map->of_contact[2 * c + 1] = ambulo__event_at(&map->contacts, d->contacts[c].to);
  }
  for (int i = 0; i < 2 * map->rows.count; i++) map->source[i] = -1;
  settle_all(map);
  return AMBULO_OK;
}

static double rate_of_row(const ambulo__event_map *map, int row, int event) {
  double rate = 0.0;
  for (int i = 0; i < 2; i++)
    if (map->source[2 * row + i] == event) rate += map->factor[2 * row + i];
  return rate;
}

/* What moves: an event of the contacts, or (event -1) up to two times of a hold. */
typedef struct mover {
  int event, count;
  double time[2], rate[2];
} mover;

static double rate_of(const ambulo__event_map *map, const ambulo__events *events, int i,
                      const mover *moves) {
  double rate = 0.0;
  int event = moves->event;
  if (i < 0 || i >= events->count) return 0.0;
  for (int k = 0; k < moves->count; k++)
    if (fabs(moves->time[k] - events->time[i]) <= AMBULO__INSTANT) rate += moves->rate[k];
  if (event < 0) return rate;
  return events == &map->rows ? rate_of_row(map, i, event)
                              : ambulo__event_at(&map->contacts, events->time[i]) == event;
}

/* (S.12) e. + (t - e) / (e' - e) (e'. - e.) */
static void spread(const ambulo__event_map *map, const ambulo__events *events, const mover *moves,
                   const double *times, int count, double *rates) {
  double duration = map->problem->definition.duration;
  for (int k = 0, last = -1; k < count; k++) {
    while (last + 1 < events->count && events->time[last + 1] <= times[k] + AMBULO__INSTANT) last++;
    double begin = last < 0 ? 0.0 : events->time[last];
    double end = last + 1 < events->count ? events->time[last + 1] : duration;
    double first = rate_of(map, events, last, moves);
    double second = rate_of(map, events, last + 1, moves);
    rates[k] = first + (times[k] - begin) / (end - begin) * (second - first);
  }
}

void ambulo__event_node_rates(const ambulo__event_map *map, int event, double *rates) {
  const mover moves = {.event = event};
  spread(map, &map->rows, &moves, map->problem->times, map->problem->nodes, rates);
}

void ambulo__event_knot_rates(const ambulo__event_map *map, int event, double *rates) {
  const ambulo__basis *basis = map->problem->basis;
  const mover moves = {.event = event};
  int count = ambulo__basis_intervals(basis) + 1;
  memset(rates, 0, (size_t)count * sizeof *rates);
  if (map->problem->definition.knots == AMBULO_GRID_EVENTS)
    spread(map, &map->knots, &moves, ambulo__basis_breakpoints(basis), count, rates);
}

/* ------------------------------------------------------------ what hands hold */

static int is_at(double a, double b) {
  return fabs(a - b) <= AMBULO__INSTANT;
}

/* 1 if a time of a hold's window is all that is there */
static int is_alone(const ambulo__event_map *map, double time) {
  const ambulo_problem_definition *d = &map->problem->definition;
  int row = ambulo__event_at(&map->rows, time), there = 0;
  if (row < 0 || map->source[2 * row] >= 0 || map->source[2 * row + 1] >= 0) return 0;
  for (int i = 0; i < d->reach_count; i++)
    there += is_at(time, d->reaches[i].from) || is_at(time, d->reaches[i].to);
  for (int i = 0; i < d->hold_count; i++) {
    double own[4];
    int count = ambulo__hold_events(&d->holds[i], d->duration, own);
    for (int k = 0; k < count; k++) there += is_at(time, own[k]);
  }
  return there == 1;
}

/* (S.22) both ends of a ramp go along with it, or the inner ones with its length */
int ambulo__event_hold_rates(const ambulo__event_map *map, int hold, ambulo__hold_time which,
                             double *rates) {
  const ambulo_hold *h = &map->problem->definition.holds[hold];
  double duration = map->problem->definition.duration;
  mover moves = {.event = -1};
  if (ambulo__hold_rises(h) && which != AMBULO__TIME_TO) {
    moves.time[moves.count] = h->from + h->ramp;
    moves.rate[moves.count++] = 1.0;
  }
  if (ambulo__hold_falls(h, duration) && which != AMBULO__TIME_FROM) {
    moves.time[moves.count] = h->to - h->ramp;
    moves.rate[moves.count++] = which == AMBULO__TIME_RAMP ? -1.0 : 1.0;
  }
  if (which != AMBULO__TIME_RAMP && moves.count > 0) {
    moves.time[moves.count] = which == AMBULO__TIME_FROM ? h->from : h->to;
    moves.rate[moves.count++] = 1.0;
  }
  for (int k = 0; k < moves.count; k++)
    if (!is_alone(map, moves.time[k])) return 0;
  spread(map, &map->rows, &moves, map->problem->times, map->problem->nodes, rates);
  return 1;
}
