/* definitions/model_coupling.c - `coupled` of a link: a joint that follows a coordinate.
 *
 * A function y = f(x) in the units of the file, x of the coordinate and y of the joint, X and Y in
 * SI: points become (x X, y Y), and of the sum of c_i x^i the coefficients c_i Y / X^i.
 */
#include "definitions/model_reader.h"

#include <math.h>

#include "model/coupling.h"

typedef struct units {
  double x, y;
} units;

static double unit_of(const ambulo__reader *reader, ambulo_joint_type type) {
  return type == AMBULO_REVOLUTE ? reader->angle : reader->length;
}

static void read_polynomial(ambulo__reader *reader, const ambulo__yaml_node *node, units unit,
                            ambulo_link *link) {
  const ambulo__yaml_node *list = ambulo__by_sex(reader, node);
  double factor = unit.y;
  int count = 0;
  if (!list || !ambulo__read_count(list, "polynomial", AMBULO__COUPLING_TERMS, &count)) return;
  if (count == 0)
    (void)ambulo__yaml_error(list, AMBULO_E_SCHEMA, NULL,
                             "a polynomial without coefficients; expected 1 to %d numbers",
                             (int)AMBULO__COUPLING_TERMS);
  for (int i = 0; i < count; i++, factor /= unit.x)
    link->polynomial[i] = ambulo__read_scaled(reader, ambulo__yaml_item(list, i), factor, 0.0);
}

static void read_spline(ambulo__reader *reader, const ambulo__yaml_node *node, units unit,
                        ambulo_link *link) {
  const ambulo__yaml_node *list = ambulo__by_sex(reader, node);
  int count = 0;
  if (!list || !ambulo__read_count(list, "spline", AMBULO__MOST_KNOTS, &count)) return;
  if (count < 2) {
    (void)ambulo__yaml_error(list, AMBULO_E_SCHEMA, NULL,
                             "a spline has %d points; expected 2 to %d, each [coordinate, value]",
                             count, (int)AMBULO__MOST_KNOTS);
    return;
  }
  double *points = ambulo__arena_take(&reader->arena, 2 * (size_t)count, sizeof *points);
  if (!points) {
    ambulo__yaml_out_of_memory(reader->document);
    return;
  }
  double pair[2] = {0.0, 0.0}, before = -INFINITY;
  for (int i = 0; i < count; i++, before = pair[0]) {
    const ambulo__yaml_node *item = ambulo__yaml_item(list, i);
    if (!ambulo__read_vector(reader, item, 2, 1.0, pair)) return;
    points[2 * i] = pair[0] * unit.x;
    points[2 * i + 1] = pair[1] * unit.y;
    if (pair[0] > before) continue;
    (void)ambulo__yaml_error(item, AMBULO_E_SCHEMA, NULL,
                             "the points of a spline do not ascend (got %s after %s); expected "
                             "coordinates that rise from point to point",
                             ambulo__number_text(pair[0]).text, ambulo__number_text(before).text);
    return;
  }
  link->knots = (const double(*)[2])(const void *)points;
  link->knot_count = count;
}

void ambulo__read_coupling(ambulo__reader *reader, const ambulo__yaml_node *node,
                           ambulo_link *link) {
  const ambulo__yaml_node *to = ambulo__yaml_require(node, "to");
  const ambulo__yaml_node *spline = ambulo__yaml_get(node, "spline");
  const ambulo__yaml_node *polynomial = ambulo__yaml_get(node, "polynomial");
  ambulo__yaml_close(node);
  link->coupled_to = ambulo__read_reference(reader, to, AMBULO__LIST_COORDINATES);
  if ((spline == NULL) == (polynomial == NULL)) {
    if (ambulo__yaml_is(node, AMBULO__YAML_MAPPING))
      (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                               "link '%s' is coupled by %s; expected one of `spline` and "
                               "`polynomial`",
                               link->name, spline ? "both" : "no function");
    return;
  }
  if (link->coupled_to < 0) return;
  const units unit = {unit_of(reader, reader->coordinates[link->coupled_to].type),
                      unit_of(reader, link->type)};
  if (spline) read_spline(reader, spline, unit, link);
  if (polynomial) read_polynomial(reader, polynomial, unit, link);
}
