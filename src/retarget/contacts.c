/* retarget/contacts.c - see contacts.h. */
#include "retarget/contacts.h"

#include "base/arithmetic.h"

#include <math.h>
#include <string.h>

/* for legs of 0.9 m; s */
static const double leg_of_person = 0.9;
static const double heel_low = 0.018, heel_high = 0.018, toe_low = 0.022, toe_high = 0.03; /* m */
static const double slow = 0.25, fast = 0.35;            /* m/s of a body that stands */
static const double slow_share = 0.25, fast_share = 0.3; /* of the body's speed, in addition */
static const double neighbourhood = 0.35, shortest_gap = 0.07, shortest_stance = 0.08,
                    shortest_phase = 0.055;

enum { HEEL = 1, TOE = 2 };

typedef struct search {
  const ambulo__figure *figure;
  const double *time;
  const ambulo__posture *posture;
  int rows, side;
  double size;         /* of the body: factor on heights */
  double body_speed;   /* m/s, of the pelvis on average */
  double *floor;       /* [rows] */
  unsigned char *down; /* [rows]: HEEL | TOE */
} search;

static const double *point_at(const search *s, int row, int what) {
  const ambulo__posture *p = &s->posture[row];
  return what == HEEL ? p->heel[s->side] : p->toe[s->side];
}

static double speed_at(const search *s, int row, int what) {
  int before = row > 0 ? row - 1 : row, after = row + 1 < s->rows ? row + 1 : row;
  const double *a = point_at(s, before, what), *b = point_at(s, after, what);
  double way = 0.0;
  for (int i = 0; i < 3; i++) way += (b[i] - a[i]) * (b[i] - a[i]);
  return sqrt(way) / (s->time[after] - s->time[before]);
}

/* the lowest that the point comes to around each row */
static void find_floor(search *s, int what) {
  for (int k = 0; k < s->rows; k++) {
    double least = INFINITY;
    for (int i = k; i >= 0 && s->time[k] - s->time[i] <= neighbourhood; i--)
      least = fmin(least, point_at(s, i, what)[2]);
    for (int i = k; i < s->rows && s->time[i] - s->time[k] <= neighbourhood; i++)
      least = fmin(least, point_at(s, i, what)[2]);
    s->floor[k] = least;
  }
}

static void find_down(search *s, int what) {
  int down = 0;
  double low = what == HEEL ? heel_low : toe_low, high = what == HEEL ? heel_high : toe_high;
  find_floor(s, what);
  for (int k = 0; k < s->rows; k++) {
    double height = (point_at(s, k, what)[2] - s->floor[k]) / s->size, speed = speed_at(s, k, what);
    double share = down ? fast_share : slow_share;
    double limit = (down ? fast : slow) + share * s->body_speed;
    down = height < (down ? high : low) && speed < limit;
    if (down) s->down[k] = (unsigned char)(s->down[k] | what);
  }
}

/* the time between row k - 1 and row k; at the ends those of the motion */
static double border(const search *s, int k) {
  if (k <= 0) return s->time[0];
  if (k >= s->rows) return s->time[s->rows - 1];
  return 0.5 * (s->time[k - 1] + s->time[k]);
}

static int run_end(const search *s, int k) {
  int end = k + 1;
  while (end < s->rows && s->down[end] == s->down[k]) end++;
  return end;
}

/* short gaps between stances are filled with what was before, short stances are gone */
static void mend(search *s) {
  for (int k = 0, end; k < s->rows; k = end) {
    end = run_end(s, k);
    if (s->down[k] || k == 0 || end == s->rows || border(s, end) - border(s, k) >= shortest_gap)
      continue;
    memset(s->down + k, s->down[k - 1], (size_t)(end - k));
  }
  for (int k = 0, end; k < s->rows; k = end) {
    for (end = k; end < s->rows && s->down[end]; end++) continue;
    if (end == k)
      end++;
    else if (border(s, end) - border(s, k) < shortest_stance)
      memset(s->down + k, 0, (size_t)(end - k));
  }
}

/* ------------------------------------------------------------------------- phases */

static ambulo__tread tread_of(unsigned char down) {
  return down == HEEL ? AMBULO__ON_HEEL : down == TOE ? AMBULO__ON_TOE : AMBULO__ON_SOLE;
}

/* short ones become part of the one before, or else of the next */
static void merge_phases(ambulo__standing *stance) {
  for (int i = 0; i < stance->phases; i++) {
    ambulo__phase *p = &stance->phase[i];
    int same = i > 0 && p->tread == p[-1].tread;
    if (stance->phases == 1 || (!same && p->to - p->from >= shortest_phase)) continue;
    if (i > 0) {
      p[-1].to = p->to;
      p[-1].last = p->last;
    } else {
      p[1].from = p->from;
      p[1].first = p->first;
    }
    memmove(p, p + 1, (size_t)(stance->phases - i - 1) * sizeof *p);
    stance->phases--;
    i = -1; /* neighbours may be alike now */
  }
}

static void split_phases(const search *s, ambulo__standing *stance) {
  for (int k = stance->first, end; k < stance->last; k = end) {
    for (end = k + 1; end < stance->last && s->down[end] == s->down[k]; end++) continue;
    if (stance->phases == AMBULO__STANCE_PHASES) merge_phases(stance);
    if (stance->phases == AMBULO__STANCE_PHASES) stance->phases--;
    stance->phase[stance->phases++] = (ambulo__phase){.tread = tread_of(s->down[k]),
                                                      .first = k,
                                                      .last = end,
                                                      .from = border(s, k),
                                                      .to = border(s, end)};
  }
  merge_phases(stance);
}

/* where it stands: means over the rows in which the heel is down, else the toes */
static void place(const search *s, ambulo__standing *stance) {
  double sum[3] = {0.0}, east = 0.0, north = 0.0, count = 0.0;
  int heel = 0, middle = (stance->first + stance->last) / 2;
  for (int k = stance->first; k < stance->last; k++) heel |= s->down[k] & HEEL;
  int what = heel ? HEEL : TOE;
  for (int k = stance->first; k < stance->last; k++) {
    if (!(s->down[k] & what)) continue;
    double turn = ambulo__heading_of(&s->posture[k].turn[AMBULO__FOOT + s->side]);
    for (int i = 0; i < 3; i++) sum[i] += point_at(s, k, what)[i];
    east += cos(turn);
    north += sin(turn);
    count++;
  }
  const double *from = what == HEEL ? s->figure->heel[s->side] : s->figure->toe[s->side];
  stance->heading = atan2(north, east);
  stance->facing = ambulo__heading_of(&s->posture[middle].turn[AMBULO__PELVIS]);
  double c = cos(stance->heading), n = sin(stance->heading);
  stance->ankle[0] = sum[0] / count - c * from[0] + n * from[1];
  stance->ankle[1] = sum[1] / count - n * from[0] - c * from[1];
  stance->ankle[2] = sum[2] / count;
}

static ambulo_status add_stance(ambulo__standings *footing, const ambulo__standing *stance) {
  if (footing->count == footing->capacity) {
    int capacity = footing->capacity ? 2 * footing->capacity : 16;
    ambulo__standing *more =
        ambulo__realloc(&footing->allocator, footing->stance, (size_t)capacity, sizeof *more);
    if (!more) return AMBULO_E_MEMORY;
    footing->stance = more;
    footing->capacity = capacity;
  }
  footing->stance[footing->count++] = *stance;
  return AMBULO_OK;
}

static ambulo_status find_side(search *s, ambulo__standings *footing) {
  ambulo_status status = AMBULO_OK;
  memset(s->down, 0, (size_t)s->rows);
  find_down(s, HEEL);
  find_down(s, TOE);
  mend(s);
  for (int k = 0, end; !status && k < s->rows; k = end) {
    for (end = k; end < s->rows && s->down[end]; end++) continue;
    if (end > k) {
      ambulo__standing stance = {.side = s->side, .first = k, .last = end};
      split_phases(s, &stance);
      place(s, &stance);
      status = add_stance(footing, &stance);
    } else
      end++;
  }
  return status;
}

/* Floors that differ by less than an edge are one: the mean of them. */
static void level_floors(ambulo__standings *footing, double size) {
  static const double edge = 0.05;
  for (int i = 0; i < footing->count; i++) {
    double sum = 0.0, own = footing->stance[i].ankle[2];
    int count = 0, first = -1;
    for (int k = 0; k < footing->count; k++) {
      if (fabs(footing->stance[k].ankle[2] - own) > edge * size) continue;
      if (first < 0) first = k;
      sum += footing->stance[k].ankle[2];
      count++;
    }
    footing->stance[i].ankle[2] = first < i ? footing->stance[first].ankle[2] : sum / count;
  }
}

ambulo_status ambulo__standings_find(const ambulo__figure *figure, const double *time,
                                     const ambulo__posture *posture, int rows,
                                     const ambulo_allocator *allocator,
                                     ambulo_diagnostics *diagnostics, ambulo__standings *footing) {
  ambulo__standings f = {.allocator = ambulo__allocator_or_default(allocator)};
  search s = {.figure = figure,
              .time = time,
              .posture = posture,
              .rows = rows,
              .size = figure->leg / leg_of_person};
  double way = 0.0;
  for (int k = 1; k < rows; k++)
    way += hypot(posture[k].pelvis[0] - posture[k - 1].pelvis[0],
                 posture[k].pelvis[1] - posture[k - 1].pelvis[1]);
  s.body_speed = way / (time[rows - 1] - time[0]);
  s.floor = ambulo__alloc(&f.allocator, (size_t)rows, sizeof *s.floor);
  s.down = ambulo__alloc(&f.allocator, (size_t)rows, 1);
  ambulo_status status = s.floor && s.down ? AMBULO_OK : AMBULO_E_MEMORY;
  for (s.side = 0; !status && s.side < AMBULO__SIDES; s.side++) status = find_side(&s, &f);
  if (!status && f.count == 0)
    status = ambulo__error(diagnostics, AMBULO_E_SCHEMA, ambulo__nowhere,
                           "the motion needs the pelvis' way over the ground, or --speed",
                           "no foot of the motion is low and slow anywhere: it never stands");
  level_floors(&f, s.size);
  ambulo__free(&f.allocator, s.floor);
  ambulo__free(&f.allocator, s.down);
  if (status)
    ambulo__standings_free(&f);
  else
    *footing = f;
  return status;
}

void ambulo__standings_free(ambulo__standings *footing) {
  ambulo__free(&footing->allocator, footing->stance);
}
