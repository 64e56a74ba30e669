/* problem/term_kinds.c - the kinds of objective terms: laws of the composite ones, and the table.
 *
 * A new kind is a constant of ambulo_term_kind, a law and a row of the table. */
#include "model/neutral_pose.h"
#include "problem/force_terms.h"
#include "problem/muscle_effort.h"
#include "problem/term.h"

#include <math.h>

static int each_coordinate(const ambulo_term *term, const ambulo__term_context *context) {
  (void)term;
  return context->channels.coordinates;
}

/* ---------------------------------------------------- torque over strength */

/* Active torque as a share of what the joint can give at its angle.
 *
 *     active_i = tau_i - offset_i - passive_i(q_i),   u_i = scale_i active_i / strength_i(q_i)
 *
 * passive: b1 exp(k1 q) + b2 exp(k2 q), strength: peak cos(c2 (q - c3)) with one set of
 * constants for each direction (Anderson, Madigan & Nussbaum, J Biomech 40, 2007, Eqs. 1-2,
 * isometric part). u is continuous through active = 0, where the direction changes, and so is
 * the slope of every phi with phi'(0) = 0.
 *     du/dtau = scale / s,  du/dq = -scale passive' / s - u s' / s
 */

/* (13.d) u: active torque over strength */
static void strength_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                          int i, ambulo__form *form) {
  double scale = ambulo__term_scale(term, i);
  if (scale == 0.0) return;
  int tau_channel = ambulo__channel_tau(&context->channels, i);
  int q_channel = ambulo__channel_q(&context->channels, i);
  double q = ambulo__frame_value(context, node, q_channel);
  double active = ambulo__frame_value(context, node, tau_channel);
  if (term->offset) active -= term->offset[i];
  double passive_slope = 0.0, strength = 1.0, strength_slope = 0.0;
  if (term->passive) active -= ambulo__passive_torque(&term->passive[4 * i], q, &passive_slope);
  if (term->strength) {
    const double *curve = &term->strength[6 * i + (active >= 0.0 ? 0 : 3)];
    if (curve[0] > 0.0) strength = ambulo__strength(curve, q, &strength_slope);
  }
  form->u = scale * active / strength;
  ambulo__form_add(form, tau_channel, 0, scale / strength);
  double slope = -scale * passive_slope / strength - form->u * strength_slope / strength;
  if (slope != 0.0) ambulo__form_add(form, q_channel, 0, slope);
}

/* -------------------------------------------------------- mechanical power */

/* Power of each joint, or of its muscles, per body mass, W/kg.
 *
 *     u_i = scale_i tau_i qd_i / m,   phi of two prices: negative work at `negative` of positive
 *     du/dtau = scale qd / m,  du/dqd = scale tau / m
 *
 * Behind a tendon of stiffness k, N m/rad, a torque tau stretches it by tau / k, and muscles have
 * to shorten for what the joint turns and for that: they move at qd + taud / k. What they do is the
 * joint's power and what goes into the tendon, tau qd + d(tau^2 / 2k)/dt. With tendons u is that of
 * an interval of length h, from means (a + b)/2 and differences b - a of its ends a and b,
 *
 *     w = qd_m + (tau_b - tau_a) / (k h),   u = scale tau_m w / m,   1/k = 0 where there is none,
 *     du/dtau_a = scale (w / 2 - tau_m / (k h)) / m,   du/dqd_a = scale tau_m / (2 m),
 *     du/dtau_b = scale (w / 2 + tau_m / (k h)) / m,   du/dqd_b = du/dqd_a
 *
 * so that h tau_m (tau_b - tau_a) / (k h) = tau_b^2 / 2k - tau_a^2 / 2k: over any time a tendon
 * gives back exactly what it took, on any grid.
 */

/* (13.m) tau_m (qd_m + dtau / (k h)) / m */
static void muscle_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                        int i, double factor, ambulo__form *form) {
  int tau_channel = ambulo__channel_tau(&context->channels, i);
  int qd_channel = ambulo__channel_qd(&context->channels, i);
  double tau[2], qd[2];
  for (int end = 0; end < 2; end++) {
    tau[end] = ambulo__frame_value(context, node + end, tau_channel);
    qd[end] = ambulo__frame_value(context, node + end, qd_channel);
  }
  double step = context->times[node + 1] - context->times[node];
  double give = term->tendon[i] > 0.0 ? 1.0 / (term->tendon[i] * step) : 0.0;
  double mean = 0.5 * (tau[0] + tau[1]), stretch = give * (tau[1] - tau[0]);
  double speed = 0.5 * (qd[0] + qd[1]) + stretch;
  form->u = factor * mean * speed;
  form->difference = factor * mean * stretch;
  for (int end = 0; end < 2; end++) {
    double by_stretch = end ? mean * give : -mean * give;
    ambulo__form_add(form, tau_channel, end, factor * (0.5 * speed + by_stretch));
    ambulo__form_add(form, qd_channel, end, 0.5 * factor * mean);
  }
}

/* (13.f) |tau qd| / m */
static void mechanical_power_form(const ambulo_term *term, const ambulo__term_context *context,
                                  int node, int i, ambulo__form *form) {
  double factor = ambulo__term_scale(term, i) / ambulo_model_mass(context->model);
  if (factor == 0.0) return;
  if (term->tendon) {
    muscle_form(term, context, node, i, factor, form);
    return;
  }
  int tau_channel = ambulo__channel_tau(&context->channels, i);
  int qd_channel = ambulo__channel_qd(&context->channels, i);
  double tau = ambulo__frame_value(context, node, tau_channel);
  double qd = ambulo__frame_value(context, node, qd_channel);
  form->u = factor * tau * qd;
  ambulo__form_add(form, tau_channel, 0, factor * qd);
  ambulo__form_add(form, qd_channel, 0, factor * tau);
}

/* ------------------------------------------------------------- torque rate */

/* How fast joint torques change.
 *
 *     u_i = scale_i (tau_i(t_k+1) - tau_i(t_k)) / (t_k+1 - t_k),   one residual per interval,
 *     booked on its first node (N m/s times scale)
 */

/* (13.g) (tau_k+1 - tau_k) / dt */
static void torque_rate_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                             int i, ambulo__form *form) {
  double step = context->times[node + 1] - context->times[node];
  double factor = ambulo__term_scale(term, i) / step;
  if (factor == 0.0) return;
  int channel = ambulo__channel_tau(&context->channels, i);
  double now = ambulo__frame_value(context, node, channel);
  double next = ambulo__frame_value(context, node + 1, channel);
  form->u = form->difference = factor * (next - now);
  ambulo__form_add(form, channel, 0, -factor);
  ambulo__form_add(form, channel, 1, factor);
}

/* ----------------------------------------------------------------- posture
 *
 * Joints rest at angles, and the root's pitch at one against gravity.
 *
 *     u_i = scale_i (q_i - angles_i - lean_i),   lean_i = sigma s of the root's pitch, else 0
 * On ground that rises by s the world's axes stay with the ground and gravity turns instead
 * (model/conditions.c): the vertical is cos s n + sin s f, n turned about l = n x f by s. With the
 * pitch q as the first rotation, about sigma l, the body's orientation is R_l(sigma q) Q, Q of the
 * other angles, and seen from the vertical
 *
 *     R_l(-s) R_l(sigma q) Q = R_l(sigma (q - sigma s)) Q,   sigma = +-1:
 *
 * it stands as it does on the level at q - sigma s, for all other angles. du/dq_i = scale_i as
 * before; du/ds = -scale_i sigma. Pitches that follow other rotations are measured from them.
 */

/* ----------------------------------------------------------------- upright */

/* The line from one point of the body to another stays vertical.
 *
 *     u_j = (p_to - p_from) . e_j / L,   e_0 = l x u,  e_1 = l,  u = -g / |g|, l left
 *
 * the horizontal direction cosines of the line (e_0 is the walking direction, level also where
 * the ground is not); L its length at q = 0. Where both points belong to one rigid
 * segment (hip centre and head of lower_body_18) that is its length, and u_j are direction cosines;
 * over several joints (hips and head of a whole body) it is a scale, and u_j how far the one is
 * off the other's plumb line, in lengths.
 */

double ambulo__upright_length(const ambulo_model *model, const int point[2]) {
  double a[3], b[3];
  ambulo__neutral_point(model, point[0], a);
  ambulo__neutral_point(model, point[1], b);
  return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
              (a[2] - b[2]) * (a[2] - b[2]));
}

static int two_directions(const ambulo_term *term, const ambulo__term_context *context) {
  (void)term, (void)context;
  return 2;
}

/* e_0 or e_1: both unit, since gravity is perpendicular to left */
static void horizontal(const ambulo_model *model, int j, double e[3]) {
  const double *g = ambulo_model_gravity(model), *l = ambulo_model_left(model);
  double size = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  for (int i = 0; i < 3; i++) {
    int a = (i + 1) % 3, b = (i + 2) % 3;
    e[i] = j == 1 ? l[i] : (l[b] * g[a] - l[a] * g[b]) / size;
  }
}

/* (13.h) horizontal direction cosines of a line of the body */
static void upright_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                         int j, ambulo__form *form) {
  double e[3];
  horizontal(context->model, j, e);
  double length = ambulo__upright_length(context->model, term->point);
  for (int end = 0; end < 2; end++) {
    double sign = end ? 1.0 : -1.0;
    for (int axis = 0; axis < 3; axis++) {
      double slope = sign * e[axis] / length;
      if (slope == 0.0) continue;
      int channel = ambulo__channel_point(&context->channels, term->point[end], axis);
      form->u += slope * ambulo__frame_value(context, node, channel);
      ambulo__form_add(form, channel, 0, slope);
    }
  }
}

/* --------------------------------------------------------------- clearance */

/* Feet in the air keep a height.
 *
 *     u = max(0, 1 - (n . p - h) / height),   phi = u^2,
 *
 * for the heel centre, the toe centre and, where there is one, the tip of every foot that is
 * in no contact at the node; n up, h the ground, height the one that is asked for. Zero, with
 * zero slope, for a point that is high enough. At a node on an event where a foot leaves the ground
 * or comes down, phi counts for the part of the node's time that it is in the air: u is times the
 * root of that part.
 *     du/dp = -n / height   where u > 0
 */

enum { POINTS_OF_A_FOOT = 3 };

static int each_foot_point(const ambulo_term *term, const ambulo__term_context *context) {
  (void)term;
  return POINTS_OF_A_FOOT * ambulo_model_foot_count(context->model);
}

int ambulo__clearance_foot(int j) {
  return j / POINTS_OF_A_FOOT;
}

static void clearance_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                           int j, ambulo__form *form) {
  int f = ambulo__clearance_foot(j), which = j % POINTS_OF_A_FOOT;
  const ambulo_foot *foot = ambulo_model_foot(context->model, f);
  double part = ambulo__air_part(context, node, f), root = sqrt(part);
  if (part == 0.0 || (which == 2 && !foot->has_tip)) return;
  int point = which == 0 ? foot->heel_center : which == 1 ? foot->toe_center : foot->tip;
  const double *up = ambulo_model_up(context->model);
  double height = -context->ground_height;
  for (int axis = 0; axis < 3; axis++) {
    int channel = ambulo__channel_point(&context->channels, point, axis);
    height += up[axis] * ambulo__frame_value(context, node, channel);
  }
  form->u = root * (1.0 - height / term->height);
  if (form->u <= 0.0) {
    form->u = 0.0;
    return;
  }
  for (int axis = 0; axis < 3; axis++) {
    if (up[axis] == 0.0) continue;
    ambulo__form_add(form, ambulo__channel_point(&context->channels, point, axis), 0,
                     -root * up[axis] / term->height);
  }
}

/* ---------------------------------------------------------- points that are followed */

/* Points of the body are near places of a reference, as markers on the skin were.
 *
 *     u_mi = scale_m (r_mi - reference_mi),   du/dr_mi = scale_m;   m a mark, i an axis of the
 * world
 */

static int each_mark_axis(const ambulo_term *term, const ambulo__term_context *context) {
  (void)context;
  return 3 * term->mark_count;
}

/* (13.r) scale (r - reference) */
static void point_tracking_form(const ambulo_term *term, const ambulo__term_context *context,
                                int node, int j, ambulo__form *form) {
  double scale = term->mark_scale ? term->mark_scale[j / 3] : 1.0;
  double reference = term->mark_reference[3 * (size_t)node * (size_t)term->mark_count + (size_t)j];
  if (scale == 0.0 || isnan(reference)) return;
  int channel = ambulo__channel_point(&context->channels, term->marks[j / 3], j % 3);
  form->u = scale * (ambulo__frame_value(context, node, channel) - reference);
  ambulo__form_add(form, channel, 0, scale);
}

/* ----------------------------------------------------------- device effort */

/* What devices do, where that is to cost something too.
 *
 *     u_i = scale_i E_i,   E_i the effort of device i, N m or N
 */

static int each_device(const ambulo_term *term, const ambulo__term_context *context) {
  (void)term;
  return context->channels.devices;
}

/* (13.l) scale E */
static void device_effort_form(const ambulo_term *term, const ambulo__term_context *context,
                               int node, int i, ambulo__form *form) {
  double scale = term->device_scale ? term->device_scale[i] : 1.0;
  int channel = ambulo__channel_effort(&context->channels, i);
  if (scale == 0.0) return;
  form->u = scale * ambulo__frame_value(context, node, channel);
  ambulo__form_add(form, channel, 0, scale);
}

/* ------------------------------------------------------------------- the table */

static const char *lacks_devices(const ambulo_problem_definition *d) {
  return d->device_count == 0 ? "there are no devices" : NULL;
}

/* name, what a residual is of, phi, members; then what is not 0 */
static const ambulo__term_info kinds[] = {
    [AMBULO_TORQUE_SQUARED] = {"torque_squared", AMBULO__TERM_OF_TORQUE, AMBULO__TERM_SQUARED,
                               AMBULO__TERM_SCALE | AMBULO__TERM_OFFSET,
                               .mirror = AMBULO__MIRROR_COORDINATES},
    [AMBULO_TORQUE_ABSOLUTE] = {"torque_absolute", AMBULO__TERM_OF_TORQUE, AMBULO__TERM_ABSOLUTE,
                                AMBULO__TERM_SCALE | AMBULO__TERM_OFFSET | AMBULO__TERM_SMOOTHING,
                                .smoothing = 1.0, .mirror = AMBULO__MIRROR_COORDINATES},
    [AMBULO_ACCELERATION] = {"acceleration", AMBULO__TERM_OF_ACCELERATION, AMBULO__TERM_SQUARED,
                             AMBULO__TERM_SCALE, .mirror = AMBULO__MIRROR_COORDINATES},
    [AMBULO_TRACKING] = {"tracking", AMBULO__TERM_OF_POSITION, AMBULO__TERM_SQUARED,
                         AMBULO__TERM_SCALE | AMBULO__TERM_REFERENCE,
                         .mirror = AMBULO__MIRROR_COORDINATES},
    [AMBULO_TORQUE_POWER] = {"torque_power", AMBULO__TERM_OF_TORQUE, AMBULO__TERM_POWER_LAW,
                             AMBULO__TERM_SCALE | AMBULO__TERM_OFFSET | AMBULO__TERM_SMOOTHING |
                                 AMBULO__TERM_POWER | AMBULO__TERM_CURVES,
                             .smoothing = 0.01, .power = 3.0, .forms = each_coordinate,
                             .form = strength_form, .mirror = AMBULO__MIRROR_COORDINATES},
    [AMBULO_TORQUE_RATE] = {"torque_rate", AMBULO__TERM_OF_TORQUE_RATE, AMBULO__TERM_SQUARED,
                            AMBULO__TERM_SCALE, .is_rate = 1, .forms = each_coordinate,
                            .form = torque_rate_form, .mirror = AMBULO__MIRROR_COORDINATES},
    [AMBULO_MECHANICAL_POWER] = {"mechanical_power", AMBULO__TERM_OF_POWER, AMBULO__TERM_ABSOLUTE,
                                 AMBULO__TERM_SCALE | AMBULO__TERM_SMOOTHING | AMBULO__TERM_TENDON |
                                     AMBULO__TERM_NEGATIVE,
                                 .smoothing = 0.05, .forms = each_coordinate,
                                 .form = mechanical_power_form,
                                 .mirror = AMBULO__MIRROR_COORDINATES},
    [AMBULO_POSTURE] = {"posture", AMBULO__TERM_OF_POSITION, AMBULO__TERM_SQUARED,
                        AMBULO__TERM_REST, .mirror = AMBULO__MIRROR_COORDINATES},
    [AMBULO_UPRIGHT] = {"upright", AMBULO__TERM_OF_OTHERS, AMBULO__TERM_SQUARED, AMBULO__TERM_LINE,
                        .forms = two_directions, .form = upright_form,
                        .mirror = AMBULO__MIRROR_LINE},
    [AMBULO_GROUND_FORCE] = {"ground_force", .forms = ambulo__ground_force_forms,
                             .form = ambulo__ground_force_form},
    [AMBULO_CLEARANCE] = {"clearance", .members = AMBULO__TERM_HEIGHT, .forms = each_foot_point,
                          .form = clearance_form},
    [AMBULO_FORCE_RATE] = {"force_rate", .is_rate = 1, .weight_is_length = 1,
                           .forms = ambulo__force_rate_forms, .form = ambulo__force_rate_form,
                           .lacks = ambulo__lacks_forces},
    [AMBULO_DEVICE_EFFORT] = {"device_effort", .members = AMBULO__TERM_DEVICES,
                              .forms = each_device, .form = device_effort_form,
                              .mirror = AMBULO__MIRROR_DEVICES, .lacks = lacks_devices},
    [AMBULO_MUSCLE_EFFORT] = {"muscle_effort", .members = AMBULO__TERM_MUSCLES,
                              .forms = ambulo__muscle_forms, .form = ambulo__muscle_form,
                              .whole = ambulo__muscle_value, .lacks = ambulo__muscle_lacks},
    [AMBULO_POINT_TRACKING] = {"point_tracking", .members = AMBULO__TERM_MARKS,
                               .forms = each_mark_axis, .form = point_tracking_form},
    [AMBULO_FORCE_TRACKING] = {"force_tracking", .members = AMBULO__TERM_LOADS,
                               .forms = ambulo__force_tracking_forms,
                               .form = ambulo__force_tracking_form, .lacks = ambulo__lacks_forces},
    [AMBULO_PRESSURE_TRACKING] = {"pressure_tracking", .members = AMBULO__TERM_LOADS,
                                  .forms = ambulo__pressure_tracking_forms,
                                  .form = ambulo__pressure_tracking_form,
                                  .lacks = ambulo__lacks_forces},
    [AMBULO_USER_TERM] = {"user", .members = AMBULO__TERM_CALLBACK},
    [AMBULO_USER_SQUARE] = {"user_square", .members = AMBULO__TERM_CALLBACK},
};

const ambulo__term_info *ambulo__term_info_of(ambulo_term_kind kind) {
  int index = (int)kind;
  if (index <= AMBULO_TERM_KIND_NOT_SET || index >= (int)(sizeof kinds / sizeof *kinds))
    return NULL;
  return &kinds[index];
}
