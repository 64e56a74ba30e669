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
 * A heel's pad gives by d while the foot is on its heel or flat (14.k). It is a spring between heel
 * and ground, k = W / b, b the way that it gives under the body weight W = m g: what it takes,
 * k d^2 / 2, it gives back.
 *
 *     d = b F / W,   F = n.f on the heel,   F = ((a1 - c) n.f + l.m) / (a1 - a0) of a flat foot
 *
 * with f, m force and moment of the contact (of a foot in two parts: of the rear one) about its
 * centre, c that centre's place, a0, a1 those where heel and ball touch, all ahead of the heel's
 * foothold: F is what presses at a0 if the rest presses at a1. The foot turns about where its ball
 * touches. What is at x ahead sinks by d (a1 - x) / (a1 - a0), and the foot pitches:
 *
 *     -e <= n.(r - p) + d (a1 - x) / (a1 - a0) <= e,   pitch - d / (a1 - a0) in place of pitch
 *
 * A point foot is held in its place alone, without pad: its link turns about it.
 *
 * Ahead of the ball F is negative, and the heel rises: pressure reaches 2 cm there, for 1 mm of 8.
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
  const ambulo__foot_outline *outlines, *outline; /* of all feet, of this one */
  const ambulo__slots *slots;
  const ambulo_contact
      *contact[2];       /* of one foot: one, or the one that ends and the one that begins */
  int before[2];         /* 1: the one that ends */
  ambulo__linear pad[2]; /* d of each, m; without terms where it has none */
  int contacts, node;
  ambulo__row_table *table;
} tube;

/* (14.k) d of a contact */
static ambulo__linear pad_of(const tube *t, const ambulo_contact *contact) {
  const ambulo__gait_context *context = t->context;
  const ambulo_problem_definition *d = context->definition;
  ambulo__linear pad = {.count = 0};
  int slot = contact->foot; /* the first slots are of feet, or of their rear parts */
  if (d->ground_reaction.heel_pad == 0.0 || ambulo__mode_is_on_toes(contact->mode) ||
      t->outline->is_point)
    return pad;
  ambulo__contact_load load =
      ambulo__contact_load_at(d, t->outlines, t->slots, slot, contact, context->times[t->node]);
  if (!load.loaded || load.weight <= AMBULO__LEAST_WEIGHT) return pad;
  double give = d->ground_reaction.heel_pad / ambulo__model_weight(context->model);
  double share = 1.0, turn = 0.0;
  if (ambulo__mode_is_flat(contact->mode)) {
    turn = 1.0 / (t->outline->touch[1] - t->outline->touch[0]);
    share = turn * (t->outline->touch[1] -
                    ambulo__contact_frame_along(&load.frame, load.frame.forward, load.center));
  }
  ambulo__linear_add(&pad, ambulo__channel_foot_force(&context->channels, slot, 0), load.frame.up,
                     give * share);
  ambulo__linear_add(&pad, ambulo__channel_contact_moment(&context->channels, slot, 0),
                     load.frame.left, give * turn);
  return pad;
}

/* adds factor times d of contact i */
static void add_pad(const tube *t, int i, double factor, ambulo__linear *form) {
  static const double one[3] = {1.0, 0.0, 0.0};
  const ambulo__linear *pad = &t->pad[i];
  for (int k = 0; k < pad->count; k++)
    ambulo__linear_add(form, pad->channel[k], one, factor * pad->coefficient[k]);
}

/* direction . (r - place) */
static ambulo__linear way_off(const tube *t, int point, const double direction[3],
                              const double place[3]) {
  ambulo__linear form = {.constant = 0.0};
  for (int i = 0; i < 3; i++) form.constant -= direction[i] * place[i];
  ambulo__linear_add(&form, ambulo__channel_point(&t->context->channels, point, 0), direction, 1.0);
  return form;
}

static void within(const tube *t, int point, const ambulo__linear *form, const char *lower,
                   const char *upper) {
  double e = t->context->definition->contact_tolerance;
  ambulo__bounded_name name = {AMBULO__KIND_CONTACT, t->context->model->points[point].name, lower,
                               upper, AMBULO__METRES};
  ambulo__bounded_rows(t->context, t->node, &name, form, -e, e, t->table);
}

static void place_bounds(const tube *t, int point, const double direction[3], const double place[3],
                         const char *lower, const char *upper) {
  ambulo__linear form = way_off(t, point, direction, place);
  within(t, point, &form, lower, upper);
}

/* of what contact i holds, `ahead` of the heel's foothold */
static void height_bounds(const tube *t, int i, int point, double ahead, const double up[3],
                          const double place[3]) {
  ambulo__linear form = way_off(t, point, up, place);
  if (!t->outline->is_point)
    add_pad(t, i, (t->outline->touch[1] - ahead) / (t->outline->touch[1] - t->outline->touch[0]),
            &form);
  within(t, point, &form, "below", "above");
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

/* the sine of the pitch, less what the pad of contact i has the foot pitch */
static ambulo__linear pitch_over_pad(const tube *t, int i) {
  const ambulo_contact *contact = t->contact[0];
  ambulo__contact_frame frame = ambulo__contact_frame_of(t->context->definition, contact);
  ambulo__linear pitch = ambulo__foot_pitch(t->context, contact->foot, frame.up);
  add_pad(t, i, -1.0 / (t->outline->touch[1] - t->outline->touch[0]), &pitch);
  return pitch;
}

/* each side is that of the contact which leaves less room */
static void pitch_bounds(const tube *t) {
  double range[2] = {-INFINITY, INFINITY}, one[2];
  int from[2] = {0, 0};
  for (int i = 0; i < t->contacts; i++) {
    pitch_range(t, t->contact[i], one);
    if (one[0] > range[0]) from[0] = i;
    if (one[1] < range[1]) from[1] = i;
    range[0] = fmax(range[0], one[0]);
    range[1] = fmin(range[1], one[1]);
  }
  for (int side = 0; side < 2; side++) {
    ambulo__linear pitch = pitch_over_pad(t, from[side]);
    t->table->before = t->before[from[side]];
    angle_bounds(t, &pitch, "toes low", "toes high", side ? -INFINITY : range[0],
                 side ? range[1] : INFINITY);
  }
}

/* the arc on which the foot rolls: its centre at its radius above the surface, on the track, and
 * ahead as far as it has rolled */
static void arc_rows(const tube *t, int i, const ambulo__contact_frame *frame) {
  const ambulo__gait_context *context = t->context;
  const ambulo_contact *contact = t->contact[i];
  const ambulo_foot *foot = &context->model->feet[contact->foot];
  int end = ambulo__mode_is_on_toes(contact->mode), point = t->outline->arc[end];
  double ahead = t->outline->arc_ahead[end], radius = t->outline->radius[end], place[3];
  for (int k = 0; k < 3; k++)
    place[k] = frame->origin[k] + ahead * frame->forward[k] + radius * frame->up[k];
  height_bounds(t, i, point, t->outline->touch[0], frame->up, place);
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
  for (int k = 0; k < 3; k++) {
    arc.forward[k] = frame->forward[k];
    arc.up[k] = frame->up[k];
    arc.flat += frame->forward[k] * place[k];
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
    arc_rows(t, i, &frame);
    return;
  }
  int point = ambulo__contact_point(d, t->outline, t->contact[i], place);
  place_bounds(t, point, frame.forward, place, "behind", "ahead");
  height_bounds(t, i, point, 0.0, frame.up, place);
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
  if (t->outline->is_point) return;
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

/* the contacts that a foot has at a node, just before it too where that counts */
static void add_contacts(tube *t, int order, int foot) {
  const ambulo__gait_context *context = t->context;
  ambulo__phases_of_foot phases = ambulo__phases_at(context, order, t->node, foot);
  for (int i = 0; i < 2 && i < phases.count; i++) {
    if (phases.contact[i] < 0) continue;
    t->before[t->contacts] = ambulo__phase_is_before(context, i);
    t->contact[t->contacts] = &context->definition->contacts[phases.contact[i]];
    t->pad[t->contacts] = pad_of(t, t->contact[t->contacts]);
    t->contacts++;
  }
}

/* (14.e) corners within a tolerance of where they are due */
void ambulo__contact_tube_rows(const ambulo__gait_context *context, ambulo__row_table *table) {
  const ambulo_problem_definition *d = context->definition;
  int feet = context->model->foot_count;
  /* a pad goes with the force, which where ends match in places alone is not that of the start */
  int order = d->ground_reaction.heel_pad > 0.0 ? AMBULO__OF_FORCES : AMBULO__OF_PLACES;
  ambulo__foot_outline *outlines = ambulo__foot_outlines(context->model, &table->allocator);
  if (!outlines) {
    table->status = AMBULO_E_MEMORY;
    return;
  }
  ambulo__slots slots = ambulo__slots_of(d);
  for (int node = 0; node < context->nodes; node++) {
    for (int foot = 0; foot < feet; foot++) {
      tube t = {.context = context,
                .outlines = outlines,
                .outline = &outlines[foot],
                .slots = &slots,
                .node = node,
                .table = table};
      add_contacts(&t, order, foot);
      if (t.contacts > 0) contact_rows(&t);
    }
  }
  table->before = 0;
  ambulo__free(&table->allocator, outlines);
}
