/* contact/force_rows.c - what each contact can supply where contacts share the load
 * ("normal_force", "friction", "pressure", "free_moment").
 *
 * Of a loaded contact: force f and moment m about its centre p, axes f, l, n of its surface, its
 * region of pressure [back, front] x [-side, side] about p, W = m g. All rows but the cone are
 * linear in the channels.
 *
 *     0 <= n.f / W <= most              body weights; most: how fast it may be loaded
 *     |f - (n.f) n| <= mu n.f           body weights: one smooth cone (contact/curved.h), of planar
 *                                       models the two rows mu n.f -+ f.f >= 0
 *     back n.f <= -l.m <= front n.f     m, divided by W: -l.m / n.f is how far the centre of
 *     -side n.f <= f.m <= side n.f      pressure is ahead of p, f.m / n.f how far to the left;
 *                                       all with an allowance a of 4e-5 m at 1.75 m
 *     |n.m| <= bound W                  m, divided by W
 *
 * Of an arc that rolls, the centre of pressure is within arc_pressure of under its centre, and the
 * allowance goes with the load (contact/curved.h).
 *
 * Point feet: all moments are shares of one, m_c = w_c l^2 eta (kernel_contacts.h), so that rows of
 * pressure and of free moment on the foot with the largest weight speak for the others. Said by
 * each they depend on each other, and no method likes that.
 *
 * A contact without weight carries exactly nothing and has no rows.
 */
#include "contact/row_families.h"

#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "contact/rows.h"
#include "model/neutral_pose.h"

#include <math.h>

/* m, times the weight: a contact that carries a twentieth of the weight may do so .8 mm beyond its
 * box. Forces are so small just after a strike, and just before a foot leaves, that rows without it
 * can hardly be moved */
static const double allowance = 4e-5;
/* of an arc, whose region is a line, while it carries next to nothing */
static const double arc_allowance = 2e-4;

/* body weights: what the cone's tip is rounded by, and the most by which a force may exceed it */
static const double cone_smoothing = 1e-4;

/* body weights: a cone is judged relative to what its contact may carry at the time, at least this.
 * Its slopes turn with the drag: beside an event, where forces are as small as a tolerance, they
 * would else be anything (rigid feet on 217 intervals: KKT residual 2e-2) */
static const double least_load = 1e-2;
/* the same of an arc's pressure: without it walks take half as many iterations more */
static const double least_arc_load = 0.1;

typedef struct one {
  const ambulo__gait_context *context;
  int node, planar;
  int moments;   /* 1: its moments are limited here, and not by what another says */
  double weight; /* W, N */
  const char *subject;
  int force, moment; /* first channels */
  ambulo__contact_load load;
  ambulo__row_table *table;
} one;

static void bounded(const one *c, ambulo__row_kind kind, const char *lower, const char *upper,
                    ambulo__measure measure, const ambulo__linear *form, double low, double high) {
  ambulo__bounded_name name = {kind, c->subject, lower, upper, measure};
  ambulo__bounded_rows(c->context, c->node, &name, form, low, high, c->table);
}

static void normal_rows(const one *c) {
  ambulo__linear form = {.count = 0};
  ambulo__linear_add(&form, c->force, c->load.frame.up, 1.0 / c->weight);
  bounded(c, AMBULO__KIND_NORMAL_FORCE, "pulls", "loaded too fast", AMBULO__BODY_WEIGHTS, &form,
          0.0, c->load.most);
}

/* the row that came last */
static void relative_to_load(const one *c, double least) {
  if (c->table->status) return;
  c->table->rows[c->table->row_count - 1].size *= fmax(least, fmin(1.0, c->load.most));
}

static void cone_row(const one *c) {
  const double *up = c->load.frame.up;
  ambulo__cone cone = {.up = {up[0], up[1], up[2]},
                       .friction = c->context->definition->ground_reaction.friction,
                       .smoothing = cone_smoothing,
                       .weight = c->weight,
                       .force = c->force};
  ambulo__row_cone(c->table, AMBULO__KIND_FRICTION, c->subject, "slips", c->node,
                   c->context->times[c->node], &cone);
  relative_to_load(c, least_load);
}

/* of a planar model, whose cone is two half planes */
static void friction_rows(const one *c) {
  double mu = c->context->definition->ground_reaction.friction;
  for (int sign = -1; sign <= 1; sign += 2) {
    ambulo__linear form = {.count = 0};
    ambulo__linear_add(&form, c->force, c->load.frame.up, mu / c->weight);
    ambulo__linear_add(&form, c->force, c->load.frame.forward, -sign / c->weight);
    bounded(c, AMBULO__KIND_FRICTION, sign > 0 ? "slips forward" : "slips backward", "",
            AMBULO__BODY_WEIGHTS, &form, 0.0, INFINITY);
  }
}

/* axis . m - edge n . f >= 0, both times `sign` */
static void pressure_row(const one *c, const double axis[3], double sign, double edge,
                         const char *side) {
  ambulo__linear form = {.constant = allowance * ambulo__model_size(c->context->model)};
  ambulo__linear_add(&form, c->moment, axis, sign / c->weight);
  ambulo__linear_add(&form, c->force, c->load.frame.up, -edge / c->weight);
  bounded(c, AMBULO__KIND_PRESSURE, side, side, AMBULO__METRES, &form, 0.0, INFINITY);
}

/* of an arc that rolls: under its centre */
static void arc_rows(const one *c) {
  const ambulo__gait_context *context = c->context;
  const ambulo__contact_load *load = &c->load;
  ambulo__arc arc = {.room = context->definition->ground_reaction.arc_pressure,
                     .center = ambulo__channel_point(&context->channels, load->arc, 0),
                     .force = c->force,
                     .moment = c->moment,
                     .weight = c->weight,
                     .slack = arc_allowance * ambulo__model_size(context->model)};
  for (int i = 0; i < 3; i++) {
    arc.forward[i] = load->frame.forward[i];
    arc.left[i] = load->frame.left[i];
    arc.up[i] = load->frame.up[i];
    arc.along += load->frame.forward[i] * load->center[i];
  }
  for (int side = 0; side < 2; side++) {
    arc.sign = side ? -1.0 : 1.0;
    ambulo__row_arc(c->table, AMBULO__KIND_PRESSURE, c->subject, side ? "front" : "back", c->node,
                    context->times[c->node], &arc);
    relative_to_load(c, least_arc_load);
  }
}

static void pressure_rows(const one *c) {
  const ambulo__contact_load *load = &c->load;
  if (load->arc >= 0) {
    arc_rows(c);
  } else {
    pressure_row(c, load->frame.left, -1.0, load->box[0], "back");
    pressure_row(c, load->frame.left, 1.0, -load->box[1], "front");
  }
  if (c->planar) return;
  pressure_row(c, load->frame.forward, 1.0, -load->side, "right");
  pressure_row(c, load->frame.forward, -1.0, -load->side, "left");
}

static void contact_rows(const one *c) {
  const ambulo_ground_reaction *r = &c->context->definition->ground_reaction;
  normal_rows(c);
  if (r->friction >= 0.0) {
    if (c->planar)
      friction_rows(c);
    else
      cone_row(c);
  }
  if (!c->moments) return;
  if (r->pressure) pressure_rows(c);
  if (isnan(r->free_moment) || c->planar) return;
  ambulo__linear form = {.count = 0};
  ambulo__linear_add(&form, c->moment, c->load.frame.up, 1.0 / c->weight);
  bounded(c, AMBULO__KIND_FREE_MOMENT, "to the right", "to the left", AMBULO__METRES, &form,
          -r->free_moment, r->free_moment);
}

/* a contact of a slot at the node: what holds there, or what ends there */
static const ambulo_contact *contact_of(const ambulo__gait_context *context, int node, int effector,
                                        int i) {
  ambulo__phases_of_foot phases = ambulo__phases_at(context, AMBULO__OF_FORCES, node, effector);
  if (i >= phases.count || phases.contact[i] < 0) return NULL;
  return &context->definition->contacts[phases.contact[i]];
}

/* 1 unless a point foot's moments are what another point foot, with more weight, says */
static int says_moments(const one *c, const ambulo__foot_outline *outlines,
                        const ambulo__slots *slots, int slot, int i) {
  const ambulo__gait_context *context = c->context;
  const ambulo_problem_definition *d = context->definition;
  if (!slots->all_points) return 1;
  for (int other = 0; other < slots->count; other++) {
    const ambulo_contact *contact = contact_of(context, c->node, slots->effector[other], i);
    if (other == slot || !contact) continue;
    double weight =
        ambulo__contact_load_at(d, outlines, slots, other, contact, context->times[c->node]).weight;
    if (weight > c->load.weight || (weight == c->load.weight && other < slot)) return 0;
  }
  return 1;
}

/* on a grid on events also those of the contact that ends at the node */
static void slot_rows(one *c, const ambulo__foot_outline *outlines, const ambulo__slots *slots,
                      int slot) {
  const ambulo__gait_context *context = c->context;
  const ambulo_problem_definition *d = context->definition;
  int effector = slots->effector[slot];
  double time = context->times[c->node];
  ambulo__phases_of_foot phases = ambulo__phases_at(context, AMBULO__OF_FORCES, c->node, effector);
  c->subject = ambulo__slot_name(context->model, slots, slot);
  c->force = ambulo__channel_foot_force(&context->channels, slot, 0);
  c->moment = ambulo__channel_contact_moment(&context->channels, slot, 0);
  for (int i = 0; i < phases.count; i++) {
    if (phases.contact[i] < 0) continue;
    c->load =
        ambulo__contact_load_at(d, outlines, slots, slot, &d->contacts[phases.contact[i]], time);
    c->table->before = ambulo__phase_is_before(context, i);
    c->moments = says_moments(c, outlines, slots, slot, i);
    if (c->load.loaded && c->load.weight > AMBULO__LEAST_WEIGHT) contact_rows(c);
  }
  c->table->before = 0;
}

/* (W.9) normal force, friction, pressure, free moment of each contact */
void ambulo__sharing_rows(const ambulo__gait_context *context, ambulo__row_table *table) {
  const ambulo_model *model = context->model;
  ambulo__foot_outline *outlines = ambulo__foot_outlines(model, &table->allocator);
  if (!outlines) {
    table->status = AMBULO_E_MEMORY;
    return;
  }
  ambulo__slots slots = ambulo__slots_of(context->definition);
  one c = {.context = context, .table = table};
  c.planar = !ambulo__model_moves_sideways(model);
  c.weight = ambulo__model_weight(model);
  for (c.node = 0; c.node < context->nodes; c.node++) {
    if (ambulo__in_flight(context, c.node)) continue;
    for (int slot = 0; slot < slots.count; slot++) slot_rows(&c, outlines, &slots, slot);
  }
  ambulo__free(&table->allocator, outlines);
}
