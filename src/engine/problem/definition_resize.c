/* problem/definition_resize.c - a definition's numbers for a body of another size.
 *
 * Bodies of one shape walk alike at one speed number v / sqrt(g H) if all that a walk is made of
 * is alike in units of the body: length H, time sqrt(H / g), mass M. Numbers for one body, in SI,
 * become for a body H' = longer H, M' = heavier M
 *
 *     lengths (tolerances, clearance, pressure, moment arm, free moment, step width)  longer
 *     loading rate, 1/s                                        1 / sqrt(longer)
 *     scale of a torque, 1 / N m                               1 / (heavier longer)
 *     scale of a force, 1 / N                                  1 / heavier
 *     torques and forces (offset, passive, strength)           their inverses
 *     rate of a torque, scale in s / N m                       sqrt(longer) / (heavier longer)
 *     turning acceleration, scale in s^2                       longer; of a translation as it is
 *     mechanical power, scale in kg / W                        1 / sqrt(longer)
 *     tendon, N m/rad; of a translation, N/m                   heavier longer; heavier / longer
 *     rate of a force, weight in s^2 by its square             longer
 *     rest of a translation, m; its scale, 1/m                 longer; 1 / longer
 *
 * Left as they are: angles, ratios, forces in body weights, prices (strength: limits), and the
 * task: speed, lengths and times of steps, contacts, ground, load, ends, tubes, references.
 * Integrals over time come out sqrt(longer) times as large, all alike.
 */
#include "problem/definition.h"

#include "problem/members.h"
#include "problem/term.h"

#include <math.h>

/* members that are as long as the body is, and the rate of loading; those of parts, too */
static void resize_members(const ambulo__structure *structure, double longer, void *item) {
  for (int i = 0; i < structure->count; i++) {
    const ambulo__member *m = &structure->members[i];
    double *value = (double *)(void *)((char *)item + m->at);
    if (m->type == AMBULO__PART) resize_members(m->of, longer, value);
    if (m->type != AMBULO__NUMBER) continue;
    for (int k = 0; k < m->count; k++) { /* NaN, which says off, stays so */
      if (m->flags & AMBULO__BODY_LENGTH) value[k] *= longer;
      if (m->quantity == AMBULO__LOADING_RATE) value[k] /= sqrt(longer);
    }
  }
}

/* what one coordinate's scale and offset are multiplied by */
typedef struct factors {
  double scale, offset;
} factors;

static factors factors_of(const ambulo_term *term, int turns, double longer, double heavier) {
  double force = turns ? heavier * longer : heavier, place = turns ? 1.0 : longer;
  int is_price = term->strength_is_limits || term->strength;
  switch (ambulo__term_info_of(term->kind)->subject) {
  case AMBULO__TERM_OF_TORQUE:
    return (factors){is_price ? 1.0 : 1.0 / force, force};
  case AMBULO__TERM_OF_TORQUE_RATE:
    return (factors){sqrt(longer) / force, 1.0};
  case AMBULO__TERM_OF_POWER:
    return (factors){1.0 / sqrt(longer), 1.0};
  case AMBULO__TERM_OF_ACCELERATION:
    return (factors){turns ? longer : 1.0, 1.0};
  case AMBULO__TERM_OF_POSITION:
    return (factors){1.0 / place, place};
  case AMBULO__TERM_OF_OTHERS: /* a device is what it is, whoever wears it */
    break;
  }
  return (factors){1.0, 1.0};
}

/* what a const view of an array of the caller's own shows */
static double *own(const double *array) {
  union {
    const double *view;
    double *array;
  } of = {array};
  return of.array;
}

/* count blocks of `stride` numbers, of which the first is a torque */
static void resize_peaks(const double *peaks, int count, int stride, double factor) {
  for (int i = 0; peaks && i < count; i++) own(peaks)[i * stride] *= factor;
}

static void resize_term(ambulo_term *term, const ambulo_model *model, double longer,
                        double heavier) {
  int count = ambulo_model_coordinate_count(model);
  for (int i = 0; i < count; i++) {
    int turns = ambulo_model_coordinate(model, i)->type == AMBULO_REVOLUTE;
    factors by = factors_of(term, turns, longer, heavier);
    if (term->scale) own(term->scale)[i] *= by.scale;
    if (term->offset) own(term->offset)[i] *= by.offset;
    if (term->tendon) own(term->tendon)[i] *= turns ? heavier * longer : heavier / longer;
  }
  resize_peaks(term->passive, 2 * count, 2, heavier * longer);
  resize_peaks(term->strength, 2 * count, 3, heavier * longer);
  if (ambulo__term_info_of(term->kind)->weight_is_length) term->weight *= longer;
  resize_members(&ambulo__term_members, longer, term); /* height */
}

void ambulo__definition_resize(ambulo_problem_definition *d, int terms, double longer,
                               double heavier) {
  union {
    const ambulo_term *view;
    ambulo_term *terms;
  } of = {d->terms};
  resize_members(&ambulo__definition_members, longer, d);
  for (int t = 0; t < terms; t++) resize_term(&of.terms[t], d->model, longer, heavier);
}
