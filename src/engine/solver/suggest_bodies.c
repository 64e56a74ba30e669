/* solver/suggest_bodies.c - what helps rows on capsules, obstacles and places to reach: less air
 * between them, a wider tolerance. */
#include "solver/body_words.h"
#include "solver/suggest.h"

#include <math.h>

/* the row's violation in words */
static void what_happens(const ambulo__advice *a, char *text, size_t size) {
  ambulo_violation v = {.worst = a->give,
                        .unit = a->row->unit,
                        .family = a->row->family,
                        .subject = a->row->subject,
                        .detail = a->row->detail,
                        .time = a->row->time};
  text[0] = '\0';
  (void)ambulo__bodies_in_words(a->problem, &v, text, size);
}

static void collision(const ambulo__advice *a) {
  char text[300];
  double margin = a->problem->definition.collision.margin;
  double enough = ambulo__outward(margin - a->room, 0);
  what_happens(a, text, sizeof text);
  if (enough < 0.0) {
    ambulo__advice_say(
        a, "%s: give them another way past each other, as footholds further apart do", text);
    return;
  }
  ambulo__advice_say(a, "%s: keep a margin of %.4g m instead of %.4g m", text, enough, margin);
  ambulo__advice_set(a, "constraints.collision.margin=%.6g", enough);
}

static void obstacle(const ambulo__advice *a) {
  char text[300];
  const ambulo__solid *solid = ambulo__row_solid_of(&a->problem->table, a->row);
  const ambulo_obstacle *o = &a->problem->definition.obstacles[solid->about];
  double enough = ambulo__outward(o->margin - a->room, 0);
  what_happens(a, text, sizeof text);
  if (enough < 0.0) {
    ambulo__advice_say(a,
                       "%s: make '%s' smaller, put it or the footholds elsewhere, or give the "
                       "motion more time",
                       text, o->name);
    return;
  }
  ambulo__advice_say(a, "%s: keep a margin of %.4g m instead of %.4g m", text, enough, o->margin);
  ambulo__advice_set(a, "obstacles[%s].margin=%.6g", o->name, enough);
}

static void reach(const ambulo__advice *a) {
  const ambulo_problem_definition *d = &a->problem->definition;
  int only = -1;
  for (int i = 0; i < d->reach_count; i++) {
    const ambulo_reach *r = &d->reaches[i];
    int here = r->from <= a->row->time + 1e-9 && a->row->time <= r->to + 1e-9 &&
               !strcmp(a->problem->model->points[r->point].name, a->row->subject);
    if (here) only = only < 0 ? i : d->reach_count;
  }
  ambulo__advice_say(a,
                     "%s does not come to its place at t = %.4g s, by %.4g m (%s): let it be so "
                     "far off, or put the place nearer",
                     a->row->subject, a->row->time, a->give, a->row->detail);
  if (only < 0 || only >= d->reach_count) return;
  ambulo__advice_set(a, "constraints.reach[%d].tolerance=%.6g", only,
                     ambulo__outward(d->reaches[only].tolerance + a->room, 1));
}

int ambulo__advise_bodies(const ambulo__advice *a) {
  switch (a->row->kind) {
  case AMBULO__KIND_COLLISION:
    collision(a);
    return 1;
  case AMBULO__KIND_OBSTACLE:
    obstacle(a);
    return 1;
  case AMBULO__KIND_REACH:
    reach(a);
    return 1;
  default:
    return 0;
  }
}
