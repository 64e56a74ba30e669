/* problem/mechanical_power.c - power of each joint, or of its muscles, per body mass, W/kg.
 *
 *     u_i = scale_i tau_i qd_i / m,   phi the smoothed absolute value: positive and
 *     negative work cost the same.
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
#include "problem/term.h"

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
void ambulo__mechanical_power_form(const ambulo_term *term, const ambulo__term_context *context,
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
