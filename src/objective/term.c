/* objective/term.c - the table of terms, and which channel each one looks at. */
#include "objective/term.h"

const ambulo__term_info *ambulo__term_info_of(ambulo_term_kind kind) {
  static const ambulo__term_info infos[] = {
      [AMBULO_TORQUE_SQUARED] = {.name = "torque_squared", .uses_tau = 1},
      [AMBULO_TORQUE_ABSOLUTE] = {.name = "torque_absolute", .uses_tau = 1},
      [AMBULO_ACCELERATION] = {.name = "acceleration", .uses_qdd = 1},
      [AMBULO_TRACKING] = {.name = "tracking", .uses_q = 1},
      [AMBULO_USER_TERM] = {.name = "user", .uses_tau = 1, .uses_qdd = 1, .uses_q = 1},
  };
  int index = (int)kind;
  if (index < 0 || index >= (int)(sizeof infos / sizeof infos[0])) return NULL;
  return &infos[index];
}

int ambulo__term_channel(const ambulo_term *term, const ambulo__channels *channels, int i) {
  switch (term->kind) {
  case AMBULO_ACCELERATION:
    return ambulo__channel_qdd(channels, i);
  case AMBULO_TRACKING:
    return ambulo__channel_q(channels, i);
  case AMBULO_TORQUE_SQUARED:
  case AMBULO_TORQUE_ABSOLUTE:
  case AMBULO_USER_TERM:
    break;
  }
  return ambulo__channel_tau(channels, i);
}

double ambulo__term_scale(const ambulo_term *term, int i) {
  return term->scale ? term->scale[i] : 1.0;
}

double ambulo__term_offset(const ambulo_term *term, int coordinates, int node, int i) {
  if (term->kind == AMBULO_TRACKING)
    return term->reference[(size_t)node * (size_t)coordinates + (size_t)i];
  if (term->kind == AMBULO_ACCELERATION || !term->offset) return 0.0;
  return term->offset[i];
}

ambulo__residual ambulo__term_residual(const ambulo_term *term, double u) {
  switch (term->kind) {
  case AMBULO_TORQUE_ABSOLUTE:
    return ambulo__torque_absolute(u, term->smoothing);
  case AMBULO_ACCELERATION:
    return ambulo__acceleration(u);
  case AMBULO_TRACKING:
    return ambulo__tracking(u);
  case AMBULO_TORQUE_SQUARED:
  case AMBULO_USER_TERM:
    break;
  }
  return ambulo__torque_squared(u);
}
