/* retarget/retargeting.c - see retargeting.h. */
#include "retarget/retargeting.h"

#include "base/arithmetic.h"
#include "retarget/imitate.h"

#include <math.h>
#include <string.h>

typedef struct making {
  const ambulo__given *given;
  ambulo__figure *person, *target;
  ambulo__retargeting *plan;
  ambulo__posture *posture; /* [rows], of the person */
  ambulo__posture *tiled; /* [tiled_rows]: of a motion that repeats three periods, else the same */
  double *tiled_time;
  int rows, tiled_rows, before; /* rows before the own period */
  double travel, rise;          /* of the person */
  ambulo_times times;
} making;

/* ------------------------------------------------------------- the person's motion */

enum { POINTS = 7 };
typedef double *points_of[POINTS];

/* soles first */
static void list_points(ambulo__posture *p, points_of points) {
  points_of all = {p->heel[0],  p->heel[1],  p->toe[0], p->toe[1],
                   p->ankle[0], p->ankle[1], p->pelvis};
  memcpy(points, all, sizeof all);
}

static int lowest_sole(points_of points) {
  enum { SOLES = 4 };
  int least = 0;
  for (int i = 1; i < SOLES; i++)
    if (points[i][2] < points[least][2]) least = i;
  return least;
}

static void turn_about_up(double angle, double v[3]) {
  double c = cos(angle), s = sin(angle), x = v[0];
  v[0] = c * x - s * v[1];
  v[1] = s * x + c * v[1];
}

/* the way of a walk that hardly turns, else where the pelvis looks at first */
static double direction_of(const making *t) {
  static const double turned = 0.4, far = 0.6; /* rad; of a leg */
  const ambulo__posture *a = &t->posture[0], *b = &t->posture[t->rows - 1];
  double x = b->pelvis[0] - a->pelvis[0], y = b->pelvis[1] - a->pelvis[1];
  double first = ambulo__heading_of(&a->turn[AMBULO__PELVIS]);
  double change = remainder(ambulo__heading_of(&b->turn[AMBULO__PELVIS]) - first, 2.0 * acos(-1.0));
  double away = remainder(atan2(y, x) - first, 2.0 * acos(-1.0));
  int walks =
      hypot(x, y) > far * t->person->leg && fabs(change) < turned && fabs(away) < 2.0 * turned;
  return walks ? atan2(y, x) : first;
}

/* begins above the origin and goes forward */
static void align(making *t) {
  double angle = direction_of(t), start[3] = {t->posture[0].pelvis[0], t->posture[0].pelvis[1], 0};
  static const double up[3] = {0.0, 0.0, 1.0};
  ambulo__rigid back = ambulo__rigid_turn(up, -angle);
  for (int k = 0; k < t->rows; k++) {
    ambulo__posture *p = &t->posture[k];
    points_of points;
    list_points(p, points);
    for (int i = 0; i < POINTS; i++) {
      for (int j = 0; j < 2; j++) points[i][j] -= start[j];
      turn_about_up(-angle, points[i]);
    }
    for (int s = 0; s < AMBULO__SEGMENTS; s++) p->turn[s] = ambulo__rigid_times(&back, &p->turn[s]);
  }
}

/* of a belt that runs backward, or of periods before and after */
static void move_on(ambulo__posture *p, double forward, double up) {
  points_of points;
  list_points(p, points);
  for (int i = 0; i < POINTS; i++) {
    points[i][0] += forward;
    points[i][2] += up;
  }
}

/* Where angles are all there is, the lowest point of the soles is on the ground and stays where it
 * is until another one is lower. */
static void place_by_feet(making *t) {
  for (int k = 0; k < t->rows; k++) {
    points_of before, points;
    double shift[3] = {0.0};
    list_points(&t->posture[k > 0 ? k - 1 : 0], before);
    list_points(&t->posture[k], points);
    int held = lowest_sole(before);
    for (int i = 0; k > 0 && i < 2; i++) shift[i] = before[held][i] - points[held][i];
    shift[2] = -points[lowest_sole(points)][2];
    for (int p = 0; p < POINTS; p++)
      for (int i = 0; i < 3; i++) points[p][i] += shift[i];
  }
}

/* 1: ends as it began, further on */
static int finds_period(making *t) {
  static const double alike = 0.12, step = 0.5; /* rad rms of the segments; of a leg */
  const ambulo__posture *a = &t->posture[0], *b = &t->posture[t->rows - 1];
  double sum = 0.0;
  for (int s = 0; s < AMBULO__SEGMENTS; s++) {
    ambulo__rigid back = ambulo__rigid_inverse(&a->turn[s]);
    ambulo__rigid change = ambulo__rigid_times(&back, &b->turn[s]);
    double v[3];
    ambulo__turn_vector(&change, v);
    sum += ambulo__dot(v, v);
  }
  t->travel = b->pelvis[0] - a->pelvis[0];
  t->rise = b->pelvis[2] - a->pelvis[2];
  return sqrt(sum / AMBULO__SEGMENTS) < alike && t->travel > step * t->person->leg;
}

/* the period before, the period, the one after: contacts of a motion that repeats know no ends */
static ambulo_status tile(making *t) {
  int n = t->rows, repeats = t->plan->repeats, m = repeats ? n - 1 : 0;
  double period = t->given->time[n - 1];
  ambulo_allocator *allocator = &t->plan->allocator;
  t->before = m;
  t->tiled_rows = n + 2 * m;
  t->tiled = ambulo__alloc(allocator, (size_t)t->tiled_rows, sizeof *t->tiled);
  t->tiled_time = ambulo__alloc(allocator, (size_t)t->tiled_rows, sizeof *t->tiled_time);
  if (!t->tiled || !t->tiled_time) return AMBULO_E_MEMORY;
  for (int k = 0; k < t->tiled_rows; k++) {
    int turns = k < m ? -1 : k < m + n ? 0 : 1, row = k - m - turns * m;
    t->tiled[k] = t->posture[row];
    t->tiled_time[k] = t->given->time[row] + turns * period;
    move_on(&t->tiled[k], turns * t->travel, turns * t->rise);
  }
  return AMBULO_OK;
}

static ambulo_status read_person(making *t, double speed) {
  const ambulo__given *g = t->given;
  t->rows = g->rows;
  t->posture = ambulo__alloc(&t->plan->allocator, (size_t)g->rows, sizeof *t->posture);
  if (!t->posture) return AMBULO_E_MEMORY;
  for (int k = 0; k < g->rows; k++)
    ambulo__figure_at(t->person, g->q + (size_t)k * (size_t)g->body->coordinate_count,
                      &t->posture[k]);
  if (g->unplaced) place_by_feet(t);
  for (int k = 0; k < g->rows; k++) move_on(&t->posture[k], speed * g->time[k], 0.0);
  align(t);
  t->plan->repeats = finds_period(t);
  return tile(t);
}

/* ----------------------------------------------------------------------- footholds */

/* an ankle of the person as one of the target; the pelvis looks to `facing` */
static void carry(const making *t, int side, double facing, double floor, double ankle[3]) {
  double l = t->plan->ratio, aside = t->target->aside[side] - l * t->person->aside[side];
  ankle[0] = l * ankle[0] - sin(facing) * aside;
  ankle[1] = l * ankle[1] + cos(facing) * aside;
  ankle[2] = l * (ankle[2] - floor);
}

/* 1: some foot stands at this time */
static int stands(const ambulo__standings *footing, double time) {
  for (int i = 0; i < footing->count; i++) {
    const ambulo__standing *s = &footing->stance[i];
    if (time >= s->phase[0].from - AMBULO__INSTANT &&
        time <= s->phase[s->phases - 1].to + AMBULO__INSTANT)
      return 1;
  }
  return 0;
}

/* times of the motion without a foot on the ground */
static int count_flights(const making *t) {
  int flights = 0, before = 1;
  for (int k = 0; k < t->rows; k++) {
    int now = stands(&t->plan->footing, t->given->time[k]);
    flights += before && !now;
    before = now;
  }
  return flights;
}

/* what is of the own period, in its time */
static void clip(making *t, ambulo__standing *stance, double floor) {
  double factor = t->plan->time_ratio, end = t->given->time[t->rows - 1];
  int kept = 0;
  for (int i = 0; i < stance->phases; i++) {
    ambulo__phase p = stance->phase[i];
    if (p.to <= 1e-6 || p.from >= end - 1e-6) continue;
    p.from = factor * fmax(p.from, 0.0);
    p.to = factor * fmin(p.to, end);
    stance->phase[kept++] = p;
  }
  stance->phases = kept;
  carry(t, stance->side, stance->facing, floor, stance->ankle);
}

static ambulo_status find_footholds(making *t, ambulo_diagnostics *diagnostics, double *floor) {
  ambulo__standings *footing = &t->plan->footing;
  ambulo_status status = ambulo__standings_find(t->person, t->tiled_time, t->tiled, t->tiled_rows,
                                                &t->plan->allocator, diagnostics, footing);
  if (status) return status;
  t->plan->flights = count_flights(t);
  if (t->times == AMBULO_TIMES_KEPT || (t->times == AMBULO_TIMES_NOT_SET && !t->plan->flights))
    t->plan->time_ratio = 1.0;
  double earliest = INFINITY;
  for (int i = 0; i < footing->count; i++) {
    const ambulo__standing *s = &footing->stance[i];
    if (s->phase[s->phases - 1].to <= 1e-6 || s->phase[0].from >= earliest) continue;
    earliest = s->phase[0].from;
    *floor = s->ankle[2];
  }
  int kept = 0;
  for (int i = 0; i < footing->count; i++) {
    clip(t, &footing->stance[i], *floor);
    if (footing->stance[i].phases > 0) footing->stance[kept++] = footing->stance[i];
  }
  footing->count = kept;
  return AMBULO_OK;
}

/* ----------------------------------------------------------------------- reference */

/* the pelvis between its feet, as far over them as the person's */
static void put_pelvis(making *t, int row, double floor, double *q) {
  const ambulo__posture *p = &t->posture[row];
  double facing = ambulo__heading_of(&p->turn[AMBULO__PELVIS]), shift[3] = {0.0};
  ambulo__posture now;
  for (int i = 0; i < t->target->map.slides; i++) q[t->target->map.slide[i]] = 0.0;
  ambulo__figure_at(t->target, q, &now);
  for (int side = 0; side < AMBULO__SIDES; side++) {
    double goal[3] = {p->ankle[side][0], p->ankle[side][1],
                      p->ankle[side][2] + t->person->heel[side][2]};
    carry(t, side, facing, floor, goal);
    goal[2] -= t->target->heel[side][2];
    for (int i = 0; i < 3; i++) shift[i] += 0.5 * (goal[i] - now.ankle[side][i]);
  }
  for (int i = 0; i < t->target->map.slides; i++) {
    double point[3], axis[3];
    ambulo__figure_axis(t->target, t->target->map.slide[i], point, axis);
    q[t->target->map.slide[i]] = ambulo__dot(axis, shift);
  }
}

/* before the first row: the start pose, arms at ease */
static void begin(const making *t, double *q) {
  const ambulo__segment_map *map = &t->target->map;
  const ambulo_coordinate *about = t->target->model->coordinates;
  for (int c = 0; c < t->target->model->coordinate_count; c++) q[c] = about[c].default_value;
  for (int s = AMBULO__UPPER_ARM; s < AMBULO__SEGMENTS; s++)
    for (int i = 0; i < map->count[s]; i++)
      q[map->coordinate[s][i]] = ambulo__at_ease(&about[map->coordinate[s][i]]);
}

static ambulo_status make_reference(making *t, double floor) {
  ambulo__retargeting *plan = t->plan;
  size_t d = (size_t)t->target->model->coordinate_count;
  double miss[AMBULO__SEGMENTS];
  plan->rows = t->rows;
  plan->time = ambulo__alloc(&plan->allocator, (size_t)t->rows, sizeof *plan->time);
  plan->q = ambulo__alloc(&plan->allocator, (size_t)t->rows * d, sizeof *plan->q);
  if (!plan->time || !plan->q) return AMBULO_E_MEMORY;
  for (int k = 0; k < t->rows; k++) {
    double *q = plan->q + (size_t)k * d;
    plan->time[k] = plan->time_ratio * t->given->time[k];
    if (k)
      memcpy(q, q - d, d * sizeof *q);
    else
      begin(t, q);
    ambulo__imitate(t->target, &t->posture[k], q, miss);
    put_pelvis(t, k, floor, q);
  }
  return AMBULO_OK;
}

/* takes what is left between the ends off evenly; slides go on by the period's way */
static void close_period(making *t) {
  ambulo__retargeting *plan = t->plan;
  size_t d = (size_t)t->target->model->coordinate_count, last = (size_t)plan->rows - 1;
  for (size_t c = 0; c < d; c++) {
    double left = plan->q[last * d + c] - plan->q[c];
    for (int i = 0; i < t->target->map.slides; i++) {
      double point[3], axis[3];
      if ((int)c != t->target->map.slide[i]) continue;
      ambulo__figure_axis(t->target, (int)c, point, axis);
      left -= axis[0] * plan->travel + axis[2] * plan->rise;
    }
    for (size_t k = 0; k <= last; k++)
      plan->q[k * d + c] -= left * plan->time[k] / plan->time[last];
  }
}

/* A stance over the end goes on at the start: there it is the same one, moved on by the period,
 * whose way has four digits as the file does. */
static void join_ends(making *t) {
  ambulo__retargeting *plan = t->plan;
  double end = plan->time_ratio * t->given->time[t->rows - 1];
  for (int i = 0; i < plan->footing.count; i++) {
    ambulo__standing *last = &plan->footing.stance[i];
    if (last->phase[last->phases - 1].to < end || last->phase[0].from <= 0.0) continue;
    for (int k = 0; k < plan->footing.count; k++) {
      const ambulo__standing *first = &plan->footing.stance[k];
      if (first->side != last->side || first->phase[0].from > 0.0) continue;
      last->heading = first->heading;
      last->ankle[0] = first->ankle[0] + plan->travel;
      last->ankle[1] = first->ankle[1];
      last->ankle[2] = first->ankle[2] + plan->rise;
    }
  }
}

ambulo_status ambulo__retargeting_make(const ambulo__given *given, ambulo__figure *person,
                                       ambulo__figure *target, ambulo_times times, double speed,
                                       ambulo_diagnostics *diagnostics, ambulo__retargeting *plan) {
  double ratio = target->leg / person->leg, floor = 0.0;
  ambulo__retargeting p = {
      .allocator = given->allocator, .target = target, .ratio = ratio, .time_ratio = sqrt(ratio)};
  making t = {.given = given, .person = person, .target = target, .plan = &p, .times = times};
  ambulo_status status = read_person(&t, speed);
  if (!status) status = find_footholds(&t, diagnostics, &floor);
  if (!status) status = make_reference(&t, floor);
  if (!status && p.repeats) {
    p.travel = nearbyint(1e4 * ratio * t.travel) / 1e4;
    p.rise = fabs(t.rise) > 0.03 * person->leg ? nearbyint(1e4 * ratio * t.rise) / 1e4 : 0.0;
    close_period(&t);
    join_ends(&t);
  }
  ambulo__free(&p.allocator, t.posture);
  ambulo__free(&p.allocator, t.tiled);
  ambulo__free(&p.allocator, t.tiled_time);
  if (status)
    ambulo__retargeting_free(&p);
  else
    *plan = p;
  return status;
}

void ambulo__retargeting_free(ambulo__retargeting *plan) {
  ambulo__free(&plan->allocator, plan->time);
  ambulo__free(&plan->allocator, plan->q);
  ambulo__standings_free(&plan->footing);
}
