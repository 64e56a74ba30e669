/* contact/bounds.c - limits in both halves of a mirrored stride (bounds.h). */
#include "contact/bounds.h"

#include "contact/gait.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double rounding = 1e-9; /* m: what right angles leave of a travel across them */

const double *ambulo__limits_of(const ambulo_coordinate *c, ambulo_limited what) {
  if (what == AMBULO_LIMITED_SPEED) return c->speed;
  return what == AMBULO_LIMITED_TORQUE ? c->torque : c->range;
}

static ambulo__bound own(const double *limit, int coordinate, int is_upper) {
  ambulo__bound bound = {limit[is_upper], coordinate, is_upper, limit[is_upper], 0.0};
  return bound;
}

/* what a limit of the partner m leaves to i: s y_i + shift = limit */
static ambulo__bound image(const double *limit, int partner, int is_upper, double sign,
                           double shift, double duration) {
  ambulo__bound bound = {sign * (limit[is_upper] - shift), partner, is_upper, limit[is_upper],
                         duration};
  return bound;
}

ambulo__bounds ambulo__bounds_of(const ambulo_problem_definition *d, int i, ambulo_limited what) {
  const ambulo_coordinate *c = &d->model->coordinates[i];
  const double *limit = ambulo__limits_of(c, what);
  ambulo__bounds b = {own(limit, i, 0), own(limit, i, 1)};
  if (d->ends != AMBULO_ENDS_MIRRORED) return b;
  int m = c->mirror, turned = c->mirror_sign < 0.0;
  double shift = what == AMBULO_LIMITED_POSITION ? ambulo__end_shift(d, m) : 0.0;
  if (fabs(shift) < rounding) shift = 0.0;
  limit = ambulo__limits_of(&d->model->coordinates[m], what);
  ambulo__bound low = image(limit, m, turned, c->mirror_sign, shift, d->duration);
  ambulo__bound high = image(limit, m, !turned, c->mirror_sign, shift, d->duration);
  if (low.value > b.low.value) b.low = low;
  if (high.value < b.high.value) b.high = high;
  return b;
}

double ambulo__limit_given(const ambulo_model *model, const ambulo__table_row *row) {
  int i = ambulo_model_find_coordinate(model, row->subject);
  int is_upper = !strcmp(row->detail, "upper");
  int what = ambulo__row_kind_entry_of(row->kind)->limited;
  if (i < 0 || what == AMBULO__NOT_LIMITED) return is_upper ? row->constant : -row->constant;
  return ambulo__limits_of(&model->coordinates[i], (ambulo_limited)what)[is_upper];
}

void ambulo__bounds_whose(const ambulo_model *model, const ambulo__bounds *bounds,
                          char text[AMBULO__WHOSE_SIZE]) {
  const ambulo__bound *both[2] = {&bounds->low, &bounds->high};
  text[0] = '\0';
  for (int k = 0; k < 2; k++) {
    const ambulo__bound *b = both[k];
    size_t used = strlen(text);
    if (b->later == 0.0) continue;
    (void)snprintf(text + used, AMBULO__WHOSE_SIZE - used,
                   " (the %s end by the %s limit of %s, %.6g, in the mirrored half)",
                   k ? "upper" : "lower", b->is_upper ? "upper" : "lower",
                   model->coordinates[b->owner].name, b->given);
  }
}
