/* study/fit_distance.c - `distance:` of a fit file: which curves count, and how. */
#include "study/fit.h"

#include <math.h>
#include <string.h>

static void read_between(ambulo__fit_curve *c, const ambulo__yaml_node *node) {
  double between[2] = {0.0, 100.0};
  if (!node) return;
  if (!ambulo__yaml_numbers(node, 2, between)) return;
  c->from = between[0];
  c->to = between[1];
  if (!(between[0] >= 0.0 && between[0] < between[1] && between[1] <= 100.0))
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "between %g and %g; expected two rising percents of the cycle, from 0 "
                             "to 100",
                             between[0], between[1]);
}

/* a weight alone, or a mapping */
static void read_curve(ambulo__fit_curve *c, const char *name, const ambulo__yaml_node *node) {
  static const char *const kinds[] = {"curve", "range", "peak", "lowest"};
  *c = (ambulo__fit_curve){name, name, AMBULO__FIT_CURVE, 1.0, 0.0, 0.0, 100.0, 0, node};
  if (!ambulo__yaml_is(node, AMBULO__YAML_MAPPING)) {
    c->weight = ambulo__yaml_number_in(node, 0.0, 1e6, 1.0);
    return;
  }
  const ambulo__yaml_node *curve = ambulo__yaml_get(node, "curve");
  const ambulo__yaml_node *centred = ambulo__yaml_get(node, "centred");
  const ambulo__yaml_node *sd = ambulo__yaml_get(node, "sd");
  if (curve) c->curve = ambulo__yaml_text(curve);
  c->of = (ambulo__fit_of)ambulo__yaml_choice(ambulo__yaml_get(node, "of"), kinds, 4, 0);
  c->weight = ambulo__yaml_number_in(ambulo__yaml_get(node, "weight"), 0.0, 1e6, 1.0);
  c->centred = ambulo__yaml_boolean(centred, 0);
  c->sd = ambulo__yaml_number_in(sd, 0.0, 1e9, 0.0);
  if (sd && !(c->sd > 0.0))
    (void)ambulo__yaml_error(sd, AMBULO_E_SCHEMA, NULL,
                             "a deviation of %g; expected one above 0, in the unit of the curve",
                             c->sd);
  if (c->centred && c->of != AMBULO__FIT_CURVE)
    (void)ambulo__yaml_error(centred, AMBULO_E_SCHEMA, NULL,
                             "'centred' is of whole curves; expected it without 'of: %s'",
                             kinds[c->of]);
  read_between(c, ambulo__yaml_get(node, "between"));
  ambulo__yaml_close(node);
}

static ambulo_status read_curves(ambulo_fit *fit, const ambulo__yaml_node *curves) {
  int count = ambulo__yaml_pairs(curves);
  if (curves && (count < 1 || count > AMBULO__FIT_CURVES)) {
    (void)ambulo__yaml_error(curves, AMBULO_E_SCHEMA, NULL, "%d curves; expected 1 to %d", count,
                             AMBULO__FIT_CURVES);
    return AMBULO_OK;
  }
  fit->curve = ambulo__alloc(&fit->allocator, (size_t)count, sizeof *fit->curve);
  if (!fit->curve) return AMBULO_E_MEMORY;
  double sum = 0.0;
  for (int i = 0; i < count; i++) {
    const char *name = ambulo__yaml_key(curves, i);
    ambulo__yaml_expect(curves, name);
    read_curve(&fit->curve[i], name, ambulo__yaml_value(curves, i));
    sum += fit->curve[i].weight;
  }
  fit->curves = count;
  if (curves && !(sum > 0.0))
    (void)ambulo__yaml_error(curves, AMBULO_E_SCHEMA, NULL,
                             "all weights are 0; expected one above 0");
  return AMBULO_OK;
}

ambulo_status ambulo__fit_read_distance(ambulo_fit *fit, const ambulo__yaml_node *node) {
  if (!node) return AMBULO_OK;
  fit->correlation =
      ambulo__yaml_number_in(ambulo__yaml_get(node, "correlation"), 0.0, 1e6, fit->correlation);
  fit->range_cost =
      ambulo__yaml_number_in(ambulo__yaml_get(node, "range"), 0.0, 1e6, fit->range_cost);
  fit->cap = ambulo__yaml_number_in(ambulo__yaml_get(node, "cap"), 1e-3, 1e9, fit->cap);
  ambulo_status status = read_curves(fit, ambulo__yaml_require(node, "curves"));
  ambulo__yaml_close(node);
  return status;
}
