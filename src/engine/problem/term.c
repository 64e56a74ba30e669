/* problem/term.c - terms as functions of channels, by the table of their kinds (term.h). */
#include "problem/term.h"

#include "base/lanes.h"

int ambulo__term_has(const ambulo_term *term, int member) {
  const ambulo__term_info *info = ambulo__term_info_of(term->kind);
  return info && info->members & member;
}

const double **ambulo__term_reference(ambulo_term *term, const ambulo_model *model, size_t *width) {
  int members = ambulo__term_info_of(term->kind)->members;
  if (members & AMBULO__TERM_REFERENCE) {
    *width = (size_t)ambulo_model_coordinate_count(model);
    return &term->reference;
  }
  if (members & AMBULO__TERM_MARKS) {
    *width = 3 * (size_t)term->mark_count;
    return &term->mark_reference;
  }
  if (!(members & AMBULO__TERM_LOADS)) return NULL;
  *width = 3 * (size_t)ambulo_model_foot_count(model);
  return &term->foot_reference;
}

int ambulo__term_follows(const ambulo_term *term) {
  return ambulo__term_has(term, AMBULO__TERM_REFERENCE | AMBULO__TERM_MARKS | AMBULO__TERM_LOADS);
}

/* ------------------------------------------------------------ simple terms */

int ambulo__term_is_simple(const ambulo_term *term) {
  const ambulo__term_info *info = ambulo__term_info_of(term->kind);
  if (!info || info->subject == AMBULO__TERM_OF_OTHERS) return 0;
  int has_curves = term->passive || term->strength;
  return !info->form || (info->members & AMBULO__TERM_CURVES && !has_curves);
}

int ambulo__term_is_rate(const ambulo_term *term) {
  const ambulo__term_info *info = ambulo__term_info_of(term->kind);
  return info && (info->is_rate || (info->members & AMBULO__TERM_TENDON && term->tendon));
}

int ambulo__term_channel(const ambulo_term *term, const ambulo__channels *channels, int i) {
  ambulo__term_subject subject = ambulo__term_info_of(term->kind)->subject;
  if (subject == AMBULO__TERM_OF_ACCELERATION) return ambulo__channel_qdd(channels, i);
  if (subject == AMBULO__TERM_OF_POSITION) return ambulo__channel_q(channels, i);
  return ambulo__channel_tau(channels, i);
}

/* (13.n) the rest of a posture, against gravity */
double ambulo__term_offset(const ambulo_term *term, const double *lean, int coordinates, int node,
                           int i) {
  if (ambulo__term_has(term, AMBULO__TERM_REFERENCE))
    return term->reference[(size_t)node * (size_t)coordinates + (size_t)i];
  int rests = ambulo__term_has(term, AMBULO__TERM_REST);
  int has_offset = rests || ambulo__term_has(term, AMBULO__TERM_OFFSET);
  double offset = has_offset && term->offset ? term->offset[i] : 0.0;
  return rests && lean ? offset + lean[i] : offset;
}

double ambulo__term_least(const ambulo_term *term) {
  return ambulo__term_info_of(term->kind)->shape == AMBULO__TERM_POWER_LAW
             ? ambulo__power_least(term->power, term->smoothing)
             : 0.0;
}

/* (13.c) u of the simple terms */
ambulo__residual ambulo__term_residual_from(const ambulo_term *term, double least, double u) {
  ambulo__term_shape shape = ambulo__term_info_of(term->kind)->shape;
  if (ambulo__term_has(term, AMBULO__TERM_NEGATIVE))
    return ambulo__two_prices(u, term->smoothing, term->negative);
  if (shape == AMBULO__TERM_ABSOLUTE) return ambulo__absolute(u, term->smoothing);
  if (shape == AMBULO__TERM_POWER_LAW)
    return ambulo__power_law(u, term->power, term->smoothing, least);
  return ambulo__squared(u);
}

/* (13.c) */
ambulo__residual ambulo__term_residual(const ambulo_term *term, double u) {
  return ambulo__term_residual_from(term, ambulo__term_least(term), u);
}

/* --------------------------------------------------------- composite terms */

int ambulo__term_forms(const ambulo_term *term, const ambulo__term_context *context, int node) {
  const ambulo__term_info *info = ambulo__term_info_of(term->kind);
  if (!info->forms || (ambulo__term_is_rate(term) && node + 1 >= context->nodes)) return 0;
  return info->forms(term, context);
}

void ambulo__term_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                       int j, ambulo__form *form) {
  form->u = form->difference = 0.0;
  form->count = 0;
  ambulo__term_info_of(term->kind)->form(term, context, node, j, form);
}

/* --------------------------------------------------- eight nodes of a block at once */

/* Most terms are squares; theirs is a loop of fixed length that a compiler turns into vectors. */

void ambulo__term_lanes(const ambulo_term *term, const double *lean, int coordinates, int node,
                        int nodes, int i, const double *y, double *u) {
  double scale = ambulo__term_scale(term, i);
  double offset[AMBULO__LANES];
  if (ambulo__term_has(
          term,
          AMBULO__TERM_REFERENCE)) { /* the only offset that varies: none beyond the last node */
    for (int l = 0; l < AMBULO__LANES; l++)
      offset[l] =
          node + l < nodes ? ambulo__term_offset(term, lean, coordinates, node + l, i) : y[l];
  } else {
    double same = ambulo__term_offset(term, lean, coordinates, node, i);
    for (int l = 0; l < AMBULO__LANES; l++) offset[l] = same;
  }
  for (int l = 0; l < AMBULO__LANES; l++) u[l] = scale * (y[l] - offset[l]);
}

void ambulo__term_shapes(const ambulo_term *term, double least, const double *u, double *value,
                         double *slope) {
  if (ambulo__term_info_of(term->kind)->shape == AMBULO__TERM_SQUARED) {
    for (int l = 0; l < AMBULO__LANES; l++) {
      value[l] = u[l] * u[l];
      slope[l] = 2.0 * u[l];
    }
    return;
  }
  for (int l = 0; l < AMBULO__LANES; l++) {
    ambulo__residual residual = ambulo__term_residual_from(term, least, u[l]);
    value[l] = residual.value;
    slope[l] = residual.slope;
  }
}
