/* problem/force_terms.c - terms of the forces of the ground (force_terms.h). */
#include "problem/force_terms.h"

#include "base/arithmetic.h"
#include "base/lanes.h"

#include <math.h>

static double body_weight(const ambulo_model *model) {
  const double *g = ambulo_model_gravity(model);
  return ambulo_model_mass(model) * sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
}

const char *ambulo__lacks_forces(const ambulo_problem_definition *d) {
  return d->ground_reaction.kind == AMBULO_REACTION_NONE
             ? "no forces on feet without ground_reaction; expected kind shared"
             : NULL;
}

/* ------------------------------------------------------------ ground force */

/* The total ground reaction stays near the body weight.
 *
 *     u_j = F_j / (m g) - n_j,   F the root force (15'), n the unit vector against gravity
 */

int ambulo__ground_force_forms(const ambulo_term *term, const ambulo__term_context *context) {
  (void)term, (void)context;
  return 3;
}

/* (13.i) F / (m g) - n */
void ambulo__ground_force_form(const ambulo_term *term, const ambulo__term_context *context,
                               int node, int axis, ambulo__form *form) {
  (void)term;
  const double *g = ambulo_model_gravity(context->model);
  double size = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]), weight = body_weight(context->model);
  int channel = ambulo__channel_force(&context->channels, axis);
  form->u = ambulo__frame_value(context, node, channel) / weight + g[axis] / size;
  ambulo__form_add(form, channel, 0, 1.0 / weight);
}

/* -------------------------------------------------------------- force rate */

/* How fast the forces on contacts change.
 *
 *     u = (f(t_k+1) - f(t_k)) / (dt r m g),   r = 10 / s,   one residual per contact slot, axis and
 *     interval, booked on its first node (1: ten body weights a second)
 *
 * What shares the load among contacts prices forces, not their changes: loading fast would be free.
 */

static const double reference_rate = 10.0; /* body weights per s: people's fastest at strike */

int ambulo__force_rate_forms(const ambulo_term *term, const ambulo__term_context *context) {
  (void)term;
  return 3 * context->channels.slots;
}

/* (13.k) (f_k+1 - f_k) / (dt 10 m g) */
void ambulo__force_rate_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                             int j, ambulo__form *form) {
  (void)term;
  double weight = body_weight(context->model);
  double step = context->times[node + 1] - context->times[node];
  double factor = 1.0 / (reference_rate * weight * step);
  int channel = ambulo__channel_foot_force(&context->channels, j / 3, j % 3);
  double now = ambulo__frame_value(context, node, channel);
  double next = ambulo__frame_value(context, node + 1, channel);
  form->u = form->difference = factor * (next - now);
  ambulo__form_add(form, channel, 0, -factor);
  ambulo__form_add(form, channel, 1, factor);
}

/* ---------------------------------------------------------- forces that are followed */

/* The force on each foot is near a reference.
 *
 *     u_fj = scale_f (sum_s f_sj - reference_fj) / (m g),   s the slots of foot f
 * (contact/contacts.h): the foot, or what is behind and before a joint of its toes
 */

static double foot_scale(const ambulo_term *term, const ambulo__term_context *context, int foot) {
  return (term->foot_scale ? term->foot_scale[foot] : 1.0) / body_weight(context->model);
}

/* [3], or NULL where nothing is asked */
static const double *foot_reference(const ambulo_term *term, const ambulo__term_context *context,
                                    int node, int foot) {
  size_t feet = (size_t)ambulo_model_foot_count(context->model);
  const double *r = term->foot_reference + 3 * ((size_t)node * feet + (size_t)foot);
  return isnan(r[0]) || isnan(r[1]) || isnan(r[2]) ? NULL : r;
}

int ambulo__force_tracking_forms(const ambulo_term *term, const ambulo__term_context *context) {
  (void)term;
  return 3 * ambulo_model_foot_count(context->model);
}

/* (13.s) scale (f - reference) / (m g) */
void ambulo__force_tracking_form(const ambulo_term *term, const ambulo__term_context *context,
                                 int node, int j, ambulo__form *form) {
  int foot = j / 3, axis = j % 3;
  double factor = foot_scale(term, context, foot);
  const double *reference = foot_reference(term, context, node, foot);
  if (factor == 0.0 || !reference) return;
  form->u = -factor * reference[axis];
  for (int slot = 0; slot < context->slots->count; slot++) {
    if (context->slots->effector[slot] != foot) continue;
    int channel = ambulo__channel_foot_force(&context->channels, slot, axis);
    form->u += factor * ambulo__frame_value(context, node, channel);
    ambulo__form_add(form, channel, 0, factor);
  }
}

/* ------------------------------------------------ centres of pressure that are followed */

/* The centre of pressure of each foot is near a reference r, along the ground.
 *
 * Of a force f with the moment M about r, the centre of pressure is c = r + n x M / (n . f) on the
 * plane through r with the normal n. A quotient would have no value in the air and large
 * ones under small forces. Weighed by its share of the body weight it is linear in force and
 * moment,
 *
 *     u_fe = scale_f (n . f) (c - r) . e / (m g) = scale_f a . M / (m g),   a = e x n,
 *
 * for e forward and e left. Slot s has the force f_s and, about its centre c_s, the moment M_s:
 *
 *     M = sum_s M_s + (c_s - r) x f_s,   du/dM_s = scale a / (m g),
 *     du/df_s = scale a x (c_s - r) / (m g)       since a . (b x f) = (a x b) . f
 */

int ambulo__pressure_tracking_forms(const ambulo_term *term, const ambulo__term_context *context) {
  (void)term;
  return 2 * ambulo_model_foot_count(context->model);
}

static void add_slope(const ambulo__term_context *context, int node, int channel, double slope,
                      ambulo__form *form) {
  if (slope == 0.0) return;
  form->u += slope * ambulo__frame_value(context, node, channel);
  ambulo__form_add(form, channel, 0, slope);
}

/* (13.t) scale N (c - r) / (m g) */
void ambulo__pressure_tracking_form(const ambulo_term *term, const ambulo__term_context *context,
                                    int node, int j, ambulo__form *form) {
  int foot = j / 2, entries = 3 + 4 * context->slots->count;
  double factor = foot_scale(term, context, foot), a[3] = {0.0, 0.0, 0.0};
  const double *reference = foot_reference(term, context, node, foot);
  const double *e =
      j % 2 ? ambulo_model_left(context->model) : ambulo_model_forward(context->model);
  if (factor == 0.0 || !reference) return;
  ambulo__add_cross(e, ambulo_model_up(context->model), factor, a);
  for (int slot = 0; slot < context->slots->count; slot++) {
    if (context->slots->effector[slot] != foot) continue;
    const double *at = context->ground + ambulo__lane_index(node, entries, 4 + 4 * slot);
    double arm[3], by_force[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < 3; i++) arm[i] = at[i * AMBULO__LANES] - reference[i];
    ambulo__add_cross(a, arm, 1.0, by_force);
    for (int i = 0; i < 3; i++) {
      int moment = ambulo__channel_contact_moment(&context->channels, slot, i);
      add_slope(context, node, moment, a[i], form);
      int force = ambulo__channel_foot_force(&context->channels, slot, i);
      add_slope(context, node, force, by_force[i], form);
    }
  }
}
