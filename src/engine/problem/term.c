/* problem/term.c - the table of terms, and which channels each one looks at. */
#include "problem/term.h"

const ambulo__term_info *ambulo__term_info_of(ambulo_term_kind kind) {
  static const ambulo__term_info infos[] = {
      [AMBULO_TORQUE_SQUARED] = {.name = "torque_squared", .uses_tau = 1},
      [AMBULO_TORQUE_ABSOLUTE] = {.name = "torque_absolute", .uses_tau = 1},
      [AMBULO_ACCELERATION] = {.name = "acceleration", .uses_qdd = 1},
      [AMBULO_TRACKING] = {.name = "tracking", .uses_q = 1},
      [AMBULO_USER_TERM] = {.name = "user", .uses_tau = 1, .uses_qdd = 1, .uses_q = 1},
      [AMBULO_TORQUE_POWER] = {.name = "torque_power", .uses_tau = 1, .uses_q = 1},
      [AMBULO_TORQUE_RATE] = {.name = "torque_rate", .uses_tau = 1},
      [AMBULO_MECHANICAL_POWER] = {.name = "mechanical_power", .uses_tau = 1},
      [AMBULO_POSTURE] = {.name = "posture", .uses_q = 1},
      [AMBULO_UPRIGHT] = {.name = "upright", .uses_q = 1},
      [AMBULO_GROUND_FORCE] = {.name = "ground_force", .uses_tau = 1},
      [AMBULO_CLEARANCE] = {.name = "clearance", .uses_q = 1},
      [AMBULO_FORCE_RATE] = {.name = "force_rate", .uses_tau = 1},
      [AMBULO_DEVICE_EFFORT] = {.name = "device_effort", .uses_q = 1},
      [AMBULO_USER_SQUARE] = {.name = "user_square", .uses_tau = 1, .uses_qdd = 1, .uses_q = 1},
  };
  int index = (int)kind;
  if (index < AMBULO_TORQUE_SQUARED || index >= (int)(sizeof infos / sizeof infos[0])) return NULL;
  return &infos[index];
}

/* ------------------------------------------------------------ simple terms */

int ambulo__term_is_simple(const ambulo_term *term) {
  switch (term->kind) {
  case AMBULO_TORQUE_SQUARED:
  case AMBULO_TORQUE_ABSOLUTE:
  case AMBULO_ACCELERATION:
  case AMBULO_TRACKING:
  case AMBULO_POSTURE:
    return 1;
  case AMBULO_TORQUE_POWER:
    return !term->passive && !term->strength;
  case AMBULO_USER_TERM:
  case AMBULO_USER_SQUARE:
  case AMBULO_TORQUE_RATE:
  case AMBULO_MECHANICAL_POWER:
  case AMBULO_UPRIGHT:
  case AMBULO_GROUND_FORCE:
  case AMBULO_CLEARANCE:
  case AMBULO_FORCE_RATE:
  case AMBULO_DEVICE_EFFORT:
  case AMBULO_TERM_KIND_NOT_SET:
    break;
  }
  return 0;
}

int ambulo__term_is_rate(const ambulo_term *term) {
  return term->kind == AMBULO_TORQUE_RATE || term->kind == AMBULO_FORCE_RATE ||
         (term->kind == AMBULO_MECHANICAL_POWER && term->tendon);
}

int ambulo__term_channel(const ambulo_term *term, const ambulo__channels *channels, int i) {
  if (term->kind == AMBULO_ACCELERATION) return ambulo__channel_qdd(channels, i);
  if (term->kind == AMBULO_TRACKING || term->kind == AMBULO_POSTURE)
    return ambulo__channel_q(channels, i);
  return ambulo__channel_tau(channels, i);
}

double ambulo__term_offset(const ambulo_term *term, int coordinates, int node, int i) {
  if (term->kind == AMBULO_TRACKING)
    return term->reference[(size_t)node * (size_t)coordinates + (size_t)i];
  if (term->kind == AMBULO_ACCELERATION || !term->offset) return 0.0;
  return term->offset[i];
}

double ambulo__term_least(const ambulo_term *term) {
  return term->kind == AMBULO_TORQUE_POWER ? ambulo__power_least(term->power, term->smoothing)
                                           : 0.0;
}

/* (13.c) u of the simple terms */
ambulo__residual ambulo__term_residual_from(const ambulo_term *term, double least, double u) {
  if (term->kind == AMBULO_TORQUE_ABSOLUTE || term->kind == AMBULO_MECHANICAL_POWER)
    return ambulo__absolute(u, term->smoothing);
  if (term->kind == AMBULO_TORQUE_POWER)
    return ambulo__power_law(u, term->power, term->smoothing, least);
  return ambulo__squared(u);
}

/* (13.c) */
ambulo__residual ambulo__term_residual(const ambulo_term *term, double u) {
  return ambulo__term_residual_from(term, ambulo__term_least(term), u);
}

/* --------------------------------------------------------- composite terms */

int ambulo__term_forms(const ambulo_term *term, const ambulo__term_context *context, int node) {
  switch (term->kind) {
  case AMBULO_TORQUE_POWER:
  case AMBULO_TORQUE_RATE:
  case AMBULO_MECHANICAL_POWER:
    if (ambulo__term_is_rate(term) && node + 1 >= context->nodes) return 0;
    return context->channels.coordinates;
  case AMBULO_UPRIGHT:
    return 2;
  case AMBULO_GROUND_FORCE:
    return 3;
  case AMBULO_CLEARANCE:
    return ambulo__clearance_forms(context);
  case AMBULO_FORCE_RATE:
    return ambulo__force_rate_forms(context, node);
  case AMBULO_DEVICE_EFFORT:
    return ambulo__device_effort_forms(context);
  case AMBULO_TORQUE_SQUARED:
  case AMBULO_TORQUE_ABSOLUTE:
  case AMBULO_ACCELERATION:
  case AMBULO_TRACKING:
  case AMBULO_POSTURE:
  case AMBULO_USER_TERM:
  case AMBULO_USER_SQUARE:
  case AMBULO_TERM_KIND_NOT_SET:
    break;
  }
  return 0;
}

void ambulo__term_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                       int j, ambulo__form *form) {
  form->u = form->difference = 0.0;
  form->count = 0;
  switch (term->kind) {
  case AMBULO_TORQUE_POWER:
    ambulo__strength_form(term, context, node, j, form);
    break;
  case AMBULO_MECHANICAL_POWER:
    ambulo__mechanical_power_form(term, context, node, j, form);
    break;
  case AMBULO_TORQUE_RATE:
    ambulo__torque_rate_form(term, context, node, j, form);
    break;
  case AMBULO_UPRIGHT:
    ambulo__upright_form(term, context, node, j, form);
    break;
  case AMBULO_GROUND_FORCE:
    ambulo__ground_force_form(context, node, j, form);
    break;
  case AMBULO_CLEARANCE:
    ambulo__clearance_form(term, context, node, j, form);
    break;
  case AMBULO_FORCE_RATE:
    ambulo__force_rate_form(context, node, j, form);
    break;
  case AMBULO_DEVICE_EFFORT:
    ambulo__device_effort_form(term, context, node, j, form);
    break;
  case AMBULO_TORQUE_SQUARED:
  case AMBULO_TORQUE_ABSOLUTE:
  case AMBULO_ACCELERATION:
  case AMBULO_TRACKING:
  case AMBULO_POSTURE:
  case AMBULO_USER_TERM:
  case AMBULO_USER_SQUARE:
  case AMBULO_TERM_KIND_NOT_SET:
    break;
  }
}
