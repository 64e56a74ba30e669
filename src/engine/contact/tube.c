/* contact/tube.c - the motion stays close to a reference.
 *
 *     lower: q - (r(t) - w) >= 0,   upper: (r(t) + w) - q >= 0        (rad, m)
 *
 * at every node, for the coordinates with a finite half width w; r is linear between the
 * samples of the reference. A tube of no width is one equation.
 */
#include "contact/gait.h"

#include <math.h>

static const double furthest = 1e6; /* rad, m: of a reference */

ambulo_status ambulo__tubes_check(const ambulo_problem_definition *definition,
                                  ambulo_diagnostics *diagnostics) {
  size_t coordinates = (size_t)ambulo_model_coordinate_count(definition->model);
  for (int t = 0; t < definition->tube_count; t++) {
    const ambulo_tube *tube = &definition->tubes[t];
    if (tube->samples < 2 || !tube->reference || !tube->half_width)
      return ambulo__error(diagnostics, AMBULO_E_PROBLEM, ambulo__nowhere, NULL,
                           "constraints.tubes[%d]: %d samples, %s reference; expected at least 2 "
                           "and half widths",
                           t, tube->samples, tube->reference ? "a" : "no");
    for (size_t i = 0; i < coordinates; i++) {
      if (tube->half_width[i] >= 0.0) continue;
      return ambulo__error(diagnostics, AMBULO_E_PROBLEM, ambulo__nowhere, NULL,
                           "constraints.tubes[%d]: half width %g of '%s'; expected at least 0", t,
                           tube->half_width[i],
                           ambulo_model_coordinate(definition->model, (int)i)->name);
    }
    for (size_t i = 0; i < (size_t)tube->samples * coordinates; i++) {
      if (fabs(tube->reference[i]) <= furthest || !isfinite(tube->half_width[i % coordinates]))
        continue;
      return ambulo__error(diagnostics, AMBULO_E_PROBLEM, ambulo__nowhere, NULL,
                           "constraints.tubes[%d]: the reference of '%s' is %g; expected -%g to %g",
                           t,
                           ambulo_model_coordinate(definition->model, (int)(i % coordinates))->name,
                           tube->reference[i], furthest, furthest);
    }
  }
  return AMBULO_OK;
}

static double reference_at(const ambulo_tube *tube, int coordinates, int i, double share) {
  double position = share * (double)(tube->samples - 1);
  int left = (int)floor(position + 1e-9);
  if (left > tube->samples - 2) left = tube->samples - 2;
  double fraction = position - (double)left;
  const double *r = tube->reference + (size_t)left * (size_t)coordinates + (size_t)i;
  return r[0] + fraction * (r[coordinates] - r[0]);
}

static void tube_row(const ambulo__gait_context *context, int node, int i, const char *detail,
                     ambulo_relation relation, double sign, double bound,
                     ambulo__row_table *table) {
  const ambulo_coordinate *c = &context->model->coordinates[i];
  ambulo__row_begin(table, AMBULO__KIND_TRACKING_TUBE, c->name, detail,
                    ambulo__row_measure(AMBULO__KIND_TRACKING_TUBE, c->type, 0), relation, node,
                    context->times[node], -sign * bound);
  ambulo__row_term_add(table, node, ambulo__channel_q(&context->channels, i), sign);
}

void ambulo__tube_rows(const ambulo__gait_context *context, ambulo__row_table *table) {
  const ambulo_problem_definition *definition = context->definition;
  int coordinates = context->model->coordinate_count;
  for (int t = 0; t < definition->tube_count; t++) {
    const ambulo_tube *tube = &definition->tubes[t];
    for (int node = 0; node < context->nodes; node++) {
      double share = context->times[node] / definition->duration;
      for (int i = 0; i < coordinates; i++) {
        double width = tube->half_width[i];
        if (!isfinite(width)) continue;
        double r = reference_at(tube, coordinates, i, share);
        if (width == 0.0) {
          tube_row(context, node, i, "on", AMBULO_EQUAL, 1.0, r, table);
        } else {
          tube_row(context, node, i, "lower", AMBULO_NOT_NEGATIVE, 1.0, r - width, table);
          tube_row(context, node, i, "upper", AMBULO_NOT_NEGATIVE, -1.0, r + width, table);
        }
      }
    }
  }
}
