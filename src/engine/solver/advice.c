/* solver/advice.c - how a suggestion is written (explain.h); what helps rows on capsules, obstacles
 * and places to reach: less air between them, a wider tolerance. */
#include "solver/explain.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

double ambulo__outward(double value, int up) {
  if (value == 0.0 || !isfinite(value)) return value;
  double scale = pow(10.0, 3.0 - floor(log10(fabs(value))));
  double steps = value * scale;
  return (up ? ceil(steps - 1e-6) : floor(steps + 1e-6)) / scale;
}

void ambulo__advice_say(const ambulo__advice *a, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(a->out->suggestion, AMBULO__LINE_SIZE, format, arguments);
  va_end(arguments);
}

void ambulo__advice_set(const ambulo__advice *a, const char *format, ...) {
  ambulo__explanation *out = a->out;
  int i = out->view.setting_count;
  if (!a->problem->keys.file || i >= AMBULO__MOST_SETTINGS) return;
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(out->setting[i], AMBULO__LINE_SIZE, format, arguments);
  va_end(arguments);
  out->settings[i] = out->setting[i];
  out->view.setting_count++;
}

void ambulo__advice_set_step(const ambulo__advice *a, double length) {
  const ambulo__problem_keys *keys = &a->problem->keys;
  double travel = length * (double)keys->steps;
  if (!keys->gait || keys->unlike_steps) return;
  ambulo__advice_set(a, "gait.step_length=%.7g", length);
  if (keys->speed)
    ambulo__advice_set(a, "gait.speed=%.9g", fabs(travel) / a->problem->definition.duration);
  if (keys->travel) ambulo__advice_set(a, "ends.travel=%.7g", travel);
}

/* --------------------------------------------------------- bodies in words */

/* Rows keep the distance D = radii + margin + what passing parts are allowed for (solid.h); missed
 * by v, the air between them is margin + allowance - v, to half a millimetre. */

static const double exact_to = 1e-4; /* m: less air than that is none */

/* what a row's two things have to keep between them, m; -1: it is no such row */
static double air_asked_for(const ambulo_problem *p, const ambulo_violation *v, int *obstacle) {
  const ambulo_problem_definition *d = &p->definition;
  double allowance = ambulo__passing_allowance(d);
  *obstacle = -1;
  int touches = !strcmp(v->detail, "ground"); /* boxes in hands stand on it, and on obstacles */
  for (int o = 0; o < d->obstacle_count; o++) touches |= !strcmp(d->obstacles[o].name, v->detail);
  if (!strcmp(v->family, ambulo__row_family(AMBULO__KIND_COLLISION)))
    return touches ? 0.0 : d->collision.margin + allowance;
  if (strcmp(v->family, ambulo__row_family(AMBULO__KIND_OBSTACLE)) != 0) return -1.0;
  for (int o = 0; o < d->obstacle_count; o++) {
    if (!strcmp(d->obstacles[o].name, v->detail)) *obstacle = o;
  }
  return *obstacle < 0 ? -1.0 : d->obstacles[*obstacle].margin + allowance;
}

int ambulo__bodies_in_words(const ambulo_problem *p, const ambulo_violation *v, char *text,
                            size_t size) {
  int obstacle;
  double asked = air_asked_for(p, v, &obstacle), air = asked - v->worst;
  if (asked < 0.0 || !isfinite(v->worst)) return 0;
  const char *before = obstacle < 0 ? "" : "obstacle '", *after = obstacle < 0 ? "" : "'";
  if (air < -exact_to)
    (void)snprintf(text, size, "%s is %.3g m inside %s%s%s at t = %.4g s", v->subject, -air, before,
                   v->detail, after, v->time);
  else
    (void)snprintf(text, size, "%s comes within %.3g m of %s%s%s at t = %.4g s, %.3g m too near",
                   v->subject, fmax(0.0, air), before, v->detail, after, v->time, v->worst);
  return 1;
}

/* ------------------------------------------------------------------ bodies */

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
