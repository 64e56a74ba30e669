/* solver/body_words.c - see body_words.h.
 *
 * Rows keep the distance D = radii + margin + what passing parts are allowed for (solid.h); missed
 * by v, the air between them is margin + allowance - v, to half a millimetre. */
#include "solver/body_words.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double exact_to = 1e-4; /* m: less air than that is none */

/* what a row's two things have to keep between them, m; -1: it is no such row */
static double air_asked_for(const ambulo_problem *p, const ambulo_violation *v, int *obstacle) {
  const ambulo_problem_definition *d = &p->definition;
  double allowance = ambulo__passing_allowance(d);
  *obstacle = -1;
  if (!strcmp(v->family, ambulo__row_family(AMBULO__KIND_COLLISION)))
    return d->collision.margin + allowance;
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
