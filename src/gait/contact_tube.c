/* gait/contact_tube.c - contacts that hold within a tolerance ("contact").
 *
 * On a loaded foot, with e the contact tolerance, o the orientation tolerance, r the point that the
 * contact holds and p its place (gait/foot_outline.h), x, y the axes of gait/foot_frame.h:
 *
 *     -e <= f.r - p_f <= e,   -e <= l.r - p_l <= e,   -e <= n.r - h <= e           m
 *     -o <= yaw, roll <= o      (twice that on the toes)                             rad
 *     heel   0 <= pitch <= sin 30 deg;  at the first node strike_pitch               rad
 *     flat   -o <= pitch <= o                toe   -0.95 <= pitch <= 0
 *
 * A body that rolls over its feet with fewer control points than nodes cannot hold every contact
 * exactly at every node; two millimetres leave it the room that soft tissue leaves people.
 * Rows along left, yaw and roll are left out for planar feet.
 */
#include "gait/foot_frame.h"
#include "gait/loading.h"

#include <math.h>

static const double most_toes_up = 0.5, most_heel_up = 0.95; /* sines */

typedef struct tube {
  const ambulo__gait_context *context;
  const ambulo__foot_outline *outline;
  const ambulo_contact *contact;
  int node;
  ambulo__row_table *table;
} tube;

static void place_bounds(const tube *t, int point, const double direction[3], double place,
                         const char *lower, const char *upper) {
  const ambulo__gait_context *context = t->context;
  double e = context->definition->contact_tolerance;
  ambulo__linear form = {.constant = -place};
  ambulo__linear_add(&form, ambulo__channel_point(&context->channels, point, 0), direction, 1.0);
  ambulo__bounded_name name = {AMBULO__KIND_CONTACT, context->model->points[point].name, lower,
                               upper, AMBULO__METRES};
  ambulo__bounded_rows(context, t->node, &name, &form, -e, e, t->table);
}

static void angle_bounds(const tube *t, const ambulo__linear *form, const char *lower,
                         const char *upper, double low, double high) {
  if (form->count == 0) return;
  const char *foot = t->context->model->feet[t->contact->foot].name;
  ambulo__bounded_name name = {AMBULO__KIND_CONTACT, foot, lower, upper, AMBULO__RADIANS};
  ambulo__bounded_rows(t->context, t->node, &name, form, low, high, t->table);
}

int ambulo__is_strike(const ambulo_problem_definition *d, int foot, double time) {
  ambulo__span span;
  double step = d->duration / d->intervals;
  return ambulo__loaded_span(d, foot, time, &span) && time - span.from < step * (1.0 - 1e-6);
}

static void pitch_bounds(const tube *t) {
  const ambulo_problem_definition *d = t->context->definition;
  double o = d->orientation_tolerance, low = -o, high = o;
  ambulo__linear pitch = ambulo__foot_pitch(t->context, t->contact->foot);
  if (t->contact->mode == AMBULO_CONTACT_TOE) {
    low = -most_heel_up;
    high = 0.0;
  } else if (t->contact->mode == AMBULO_CONTACT_HEEL) {
    double time = t->context->times[t->node];
    int strike =
        d->strike_pitch[0] < d->strike_pitch[1] && ambulo__is_strike(d, t->contact->foot, time);
    low = strike ? sin(d->strike_pitch[0]) : 0.0;
    high = strike ? sin(d->strike_pitch[1]) : most_toes_up;
  }
  angle_bounds(t, &pitch, "toes low", "toes high", low, high);
}

static void contact_rows(const tube *t) {
  const ambulo_model *model = t->context->model;
  const ambulo_problem_definition *d = t->context->definition;
  double place[2];
  int point = ambulo__contact_point(model, t->outline, t->contact, place);
  place_bounds(t, point, model->forward, place[0], "behind", "ahead");
  place_bounds(t, point, model->up, d->ground_height, "below", "above");
  pitch_bounds(t);
  if (!t->outline->moves_sideways) return;
  place_bounds(t, point, model->left, place[1], "to the right", "to the left");
  double o = d->orientation_tolerance * (t->contact->mode == AMBULO_CONTACT_TOE ? 2.0 : 1.0);
  ambulo__linear yaw = ambulo__foot_yaw(t->context, t->contact->foot);
  ambulo__linear roll = ambulo__foot_roll(t->context, t->contact->foot);
  angle_bounds(t, &yaw, "turned right", "turned left", -o, o);
  angle_bounds(t, &roll, "left side low", "left side high", -o, o);
}

/* (14.e) corners within a tolerance of where they are due */
void ambulo__contact_tube_rows(const ambulo__gait_context *context, ambulo__row_table *table) {
  int feet = context->model->foot_count;
  ambulo__foot_outline *outlines = ambulo__foot_outlines(context->model, &table->allocator);
  if (!outlines) {
    table->status = AMBULO_E_MEMORY;
    return;
  }
  for (int node = 0; node < ambulo__distinct_nodes(context, AMBULO__OF_PLACES); node++) {
    for (int foot = 0; foot < feet; foot++) {
      int contact = context->active[node * feet + foot];
      if (contact < 0) continue;
      tube t = {context, &outlines[foot], &context->definition->contacts[contact], node, table};
      contact_rows(&t);
    }
  }
  ambulo__free(&table->allocator, outlines);
}
