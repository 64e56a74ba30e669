/* contact/contact_tube.c - contacts that hold within a tolerance ("contact").
 *
 * On a loaded foot, with e the contact tolerance, o the orientation tolerance, r the point that the
 * contact holds and p its place (contact/contacts.h), f, l, n the axes of its surface
 * (contact/contacts.h), yaw, pitch, roll those of contact/contacts.h:
 *
 *     -e <= f.(r - p) <= e,   -e <= l.(r - p) <= e,   -e <= n.(r - p) <= e         m
 *     -o <= yaw, roll <= o      (twice that on the toes)                             rad
 *     heel   0 <= pitch <= sin 30 deg;  at the first node strike_pitch               rad
 *     toe    where it comes down on its toes, and strike_pitch is of toes that point down, the same
 *     flat   -o <= pitch <= o                toe   -0.95 <= pitch <= 0
 *
 * Feet with arcs roll on their heel and on their toes: there C, the arc's centre, is held at its
 * radius above the surface, and ahead within e of where it has rolled to (contact/curved.h).
 *
 * Toes on a joint of their own (tip on another link than the ball): n . (tip - p) >= -e.
 *
 * A body that rolls over its feet with fewer control points than nodes cannot hold every contact
 * exactly at every node; two millimetres leave it the room that soft tissue leaves people.
 * Rows along left, yaw and roll are left out for planar feet. At a node where one contact ends and
 * another begins both points are held, and directions within what both allow.
 */
#include "contact/contacts.h"
#include "contact/row_families.h"

#include <math.h>

static const double most_toes_up = 0.5, most_heel_up = 0.95; /* sines */

typedef struct tube {
  const ambulo__gait_context *context;
  const ambulo__foot_outline *outline;
  const ambulo_contact
      *contact[2]; /* of one foot: one, or the one that ends and the one that begins */
  int before[2];   /* 1: the one that ends */
  int contacts, node;
  ambulo__row_table *table;
} tube;

static void place_bounds(const tube *t, int point, const double direction[3], const double place[3],
                         const char *lower, const char *upper) {
  const ambulo__gait_context *context = t->context;
  double e = context->definition->contact_tolerance;
  ambulo__linear form = {.constant = 0.0};
  for (int i = 0; i < 3; i++) form.constant -= direction[i] * place[i];
  ambulo__linear_add(&form, ambulo__channel_point(&context->channels, point, 0), direction, 1.0);
  ambulo__bounded_name name = {AMBULO__KIND_CONTACT, context->model->points[point].name, lower,
                               upper, AMBULO__METRES};
  ambulo__bounded_rows(context, t->node, &name, &form, -e, e, t->table);
}

static void angle_bounds(const tube *t, const ambulo__linear *form, const char *lower,
                         const char *upper, double low, double high) {
  if (form->count == 0) return;
  const char *foot = t->context->model->feet[t->contact[0]->foot].name;
  ambulo__bounded_name name = {AMBULO__KIND_CONTACT, foot, lower, upper, AMBULO__RADIANS};
  ambulo__bounded_rows(t->context, t->node, &name, form, low, high, t->table);
}

int ambulo__is_strike(const ambulo_problem_definition *d, int foot, const double *times, int nodes,
                      int node) {
  ambulo__span span;
  int last = nodes - 1;
  double step = node > 0 ? times[node] - times[node - 1] : times[last] - times[last - 1];
  return ambulo__loaded_span(d, foot, times[node], &span) &&
         times[node] - span.from < step * (1.0 - 1e-6);
}

int ambulo__is_pitched(const ambulo_problem_definition *d, const ambulo_contact *contact,
                       const double *times, int nodes, int node) {
  const double *pitch = d->strike_pitch;
  int lands = pitch[1] <= 0.0 ? ambulo__mode_is_on_toes(contact->mode)
                              : ambulo__mode_is_on_heel(contact->mode);
  return pitch[0] < pitch[1] && lands && ambulo__is_strike(d, contact->foot, times, nodes, node);
}

/* what one contact allows */
static void pitch_range(const tube *t, const ambulo_contact *contact, double range[2]) {
  const ambulo__gait_context *context = t->context;
  const ambulo_problem_definition *d = context->definition;
  double o = d->orientation_tolerance;
  int toe = ambulo__mode_is_on_toes(contact->mode), heel = ambulo__mode_is_on_heel(contact->mode);
  range[0] = toe ? -most_heel_up : heel ? 0.0 : -o;
  range[1] = toe ? 0.0 : heel ? most_toes_up : o;
  if (!ambulo__is_pitched(d, contact, context->times, context->nodes, t->node)) return;
  for (int i = 0; i < 2; i++) range[i] = sin(d->strike_pitch[i]);
}

/* each side is that of the contact which leaves less room */
static void pitch_bounds(const tube *t) {
  double range[2] = {-INFINITY, INFINITY}, one[2];
  int before[2] = {0, 0};
  ambulo__contact_frame frame = ambulo__contact_frame_of(t->context->definition, t->contact[0]);
  ambulo__linear pitch = ambulo__foot_pitch(t->context, t->contact[0]->foot, frame.up);
  for (int i = 0; i < t->contacts; i++) {
    pitch_range(t, t->contact[i], one);
    if (one[0] > range[0]) before[0] = t->before[i];
    if (one[1] < range[1]) before[1] = t->before[i];
    range[0] = fmax(range[0], one[0]);
    range[1] = fmin(range[1], one[1]);
  }
  t->table->before = before[0];
  angle_bounds(t, &pitch, "toes low", "toes high", range[0], INFINITY);
  t->table->before = before[1];
  angle_bounds(t, &pitch, "toes low", "toes high", -INFINITY, range[1]);
}

/* the arc on which the foot rolls: its centre at its radius above the surface, on the track, and
 * ahead as far as it has rolled */
static void arc_rows(const tube *t, const ambulo_contact *contact,
                     const ambulo__contact_frame *frame) {
  const ambulo__gait_context *context = t->context;
  const ambulo_foot *foot = &context->model->feet[contact->foot];
  int end = ambulo__mode_is_on_toes(contact->mode), point = t->outline->arc[end];
  double ahead = t->outline->arc_ahead[end], radius = t->outline->radius[end], place[3];
  for (int i = 0; i < 3; i++)
    place[i] = frame->origin[i] + ahead * frame->forward[i] + radius * frame->up[i];
  place_bounds(t, point, frame->up, place, "below", "above");
  if (t->outline->moves_sideways)
    place_bounds(t, point, frame->left, place, "to the right", "to the left");
  ambulo__arc arc = {.room = context->definition->contact_tolerance,
                     .radius = radius,
                     .length = ambulo__foot_length(context->model, contact->foot),
                     .center = ambulo__channel_point(&context->channels, point, 0),
                     .heel = ambulo__channel_point(&context->channels, foot->heel_center, 0),
                     .toe = ambulo__channel_point(&context->channels, foot->toe_center, 0),
                     .force = -1,
                     .moment = -1};
  for (int i = 0; i < 3; i++) {
    arc.forward[i] = frame->forward[i];
    arc.up[i] = frame->up[i];
    arc.flat += frame->forward[i] * place[i];
  }
  for (int side = 0; side < 2; side++) {
    arc.sign = side ? -1.0 : 1.0;
    ambulo__row_arc(t->table, AMBULO__KIND_CONTACT, context->model->points[point].name,
                    side ? "ahead" : "behind", t->node, context->times[t->node], &arc);
  }
}

/* 1 if contact i holds an arc, on which the foot rolls */
static int rolls(const tube *t, int i) {
  return t->outline->has_arcs && !ambulo__mode_is_flat(t->contact[i]->mode);
}

/* 1 if the other contact of the node says what contact i says: the same point at the same place;
 * and of a foot that is flat the arcs are where they are due */
static int is_said(const tube *t, int i) {
  const ambulo_problem_definition *d = t->context->definition;
  double place[3], other[3];
  if (t->contacts == 1) return 0;
  if (rolls(t, i) || rolls(t, 1 - i))
    return rolls(t, i) && ambulo__mode_is_flat(t->contact[1 - i]->mode);
  return i > 0 &&
         ambulo__contact_point(d, t->outline, t->contact[i], place) ==
             ambulo__contact_point(d, t->outline, t->contact[0], other) &&
         place[0] == other[0] && place[1] == other[1] && place[2] == other[2];
}

/* the point or the arc that contact i holds */
static void place_rows(const tube *t, int i) {
  const ambulo_problem_definition *d = t->context->definition;
  ambulo__contact_frame frame = ambulo__contact_frame_of(d, t->contact[i]);
  double place[3];
  if (is_said(t, i)) return;
  if (rolls(t, i)) {
    arc_rows(t, t->contact[i], &frame);
    return;
  }
  int point = ambulo__contact_point(d, t->outline, t->contact[i], place);
  place_bounds(t, point, frame.forward, place, "behind", "ahead");
  place_bounds(t, point, frame.up, place, "below", "above");
  if (t->outline->moves_sideways)
    place_bounds(t, point, frame.left, place, "to the right", "to the left");
}

/* toes of their own, on a joint at the ball: they stay above the surface while the foot is loaded,
 * and so bend as it turns over them */
static void toe_rows(const tube *t) {
  const ambulo__gait_context *context = t->context;
  const ambulo_foot *foot = &context->model->feet[t->contact[0]->foot];
  const ambulo_point *points = context->model->points;
  if (!foot->has_tip || points[foot->tip].link == points[foot->toe_center].link) return;
  ambulo__contact_frame frame = ambulo__contact_frame_of(context->definition, t->contact[0]);
  ambulo__linear form = {.constant = 0.0};
  for (int i = 0; i < 3; i++) form.constant -= frame.up[i] * frame.origin[i];
  ambulo__linear_add(&form, ambulo__channel_point(&context->channels, foot->tip, 0), frame.up, 1.0);
  ambulo__bounded_name name = {AMBULO__KIND_CONTACT, points[foot->tip].name, "below", "above",
                               AMBULO__METRES};
  ambulo__bounded_rows(context, t->node, &name, &form, -context->definition->contact_tolerance,
                       INFINITY, t->table);
}

static void contact_rows(const tube *t) {
  const ambulo_problem_definition *d = t->context->definition;
  int on_toes = 1, foot = t->contact[0]->foot;
  for (int i = 0; i < t->contacts; i++) {
    t->table->before = t->before[i];
    place_rows(t, i);
    on_toes &= ambulo__mode_is_on_toes(t->contact[i]->mode);
  }
  pitch_bounds(t);
  t->table->before = t->before[0];
  toe_rows(t);
  if (!t->outline->moves_sideways) return;
  t->table->before = t->before[t->contacts > 1 && ambulo__mode_is_on_toes(t->contact[0]->mode)];
  double o = d->orientation_tolerance * (on_toes ? 2.0 : 1.0);
  ambulo__contact_frame frame = ambulo__contact_frame_of(d, t->contact[0]);
  ambulo__linear yaw = ambulo__foot_yaw(t->context, foot, frame.left);
  ambulo__linear roll = ambulo__foot_roll(t->context, foot, frame.up);
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
  for (int node = 0; node < context->nodes; node++) {
    for (int foot = 0; foot < feet; foot++) {
      ambulo__phases_of_foot phases = ambulo__phases_at(context, AMBULO__OF_PLACES, node, foot);
      tube t = {.context = context, .outline = &outlines[foot], .node = node, .table = table};
      for (int i = 0; i < 2 && i < phases.count; i++) {
        if (phases.contact[i] < 0) continue;
        t.before[t.contacts] = ambulo__phase_is_before(context, i);
        t.contact[t.contacts++] = &context->definition->contacts[phases.contact[i]];
      }
      if (t.contacts > 0) contact_rows(&t);
    }
  }
  table->before = 0;
  ambulo__free(&table->allocator, outlines);
}
