/* exchange/coupled_text.c - joints that follow a coordinate, in OpenSim models and URDFs.
 *
 * A custom joint of OpenSim moves along an axis by a function of one of its own coordinates. So
 * what follows a coordinate of the same body is such a function; what follows another's has a
 * coordinate of its own, and a CoordinateCouplerConstraint. A URDF knows straight lines alone,
 * <mimic>.
 */
#include "exchange/export.h"

#include <string.h>

#include "model/coupling.h"

int ambulo__is_curved(const ambulo_link *link) {
  const double *c = link->polynomial;
  return link->coupled_to >= 0 &&
         (link->knot_count > 0 || c[2] != 0.0 || c[3] != 0.0 || c[4] != 0.0);
}

static int has(const ambulo__export_body *body, int coordinate) {
  for (int i = 0; i < body->joints; i++)
    if (body->coordinate[i] == coordinate) return 1;
  return 0;
}

int ambulo__follows_elsewhere(const ambulo__export_body *body, const ambulo_model *model, int i) {
  return body->coordinate[i] < 0 && !has(body, model->links[body->link_of[i]].coupled_to);
}

void ambulo__mover_name(const ambulo__export_body *body, const ambulo_model *model, int i,
                        ambulo__text_buffer *text) {
  const ambulo_link *link = &model->links[body->link_of[i]];
  int c = body->coordinate[i] >= 0 ? body->coordinate[i] : link->coupled_to;
  if (ambulo__follows_elsewhere(body, model, i))
    ambulo__markup_text(text, "", link->name, "_coupled");
  else
    ambulo__markup_text(text, "", model->coordinates[c].name, "");
}

static void line(double slope, double offset, int depth, ambulo__text_buffer *text) {
  const double coefficients[2] = {slope, offset};
  ambulo__markup_tabs(text, depth);
  ambulo__text_append(text, "<LinearFunction name=\"function\">\n");
  ambulo__markup_element(text, depth + 1, "coefficients", coefficients, 2);
  ambulo__markup_tabs(text, depth);
  ambulo__text_append(text, "</LinearFunction>\n");
}

/* x or y of the points of a spline */
static void column(const ambulo_link *link, int which, int depth, ambulo__text_buffer *text) {
  static const char *const tags[] = {"x", "y"};
  ambulo__markup_tabs(text, depth);
  ambulo__text_append_format(text, "<%s>", tags[which]);
  for (int i = 0; i < link->knot_count; i++) {
    if (i) ambulo__text_append_char(text, ' ');
    ambulo__text_append_number(text, link->knots[i][which]);
  }
  ambulo__text_append_format(text, "</%s>\n", tags[which]);
}

static void function_of(const ambulo_link *link, int depth, ambulo__text_buffer *text) {
  const double *c = link->polynomial;
  if (!ambulo__is_curved(link)) {
    line(c[1], c[0], depth, text);
    return;
  }
  const char *kind = link->knot_count > 0 ? "SimmSpline" : "PolynomialFunction";
  ambulo__markup_tabs(text, depth);
  ambulo__text_append_format(text, "<%s name=\"function\">\n", kind);
  if (link->knot_count > 0) {
    column(link, 0, depth + 1, text);
    column(link, 1, depth + 1, text);
  } else {
    const double falling[AMBULO__COUPLING_TERMS] = {c[4], c[3], c[2], c[1], c[0]};
    ambulo__markup_element(text, depth + 1, "coefficients", falling, AMBULO__COUPLING_TERMS);
  }
  ambulo__markup_tabs(text, depth);
  ambulo__text_append_format(text, "</%s>\n", kind);
}

void ambulo__mover_function(const ambulo__export_body *body, const ambulo_model *model, int i,
                            ambulo__text_buffer *text) {
  if (body->coordinate[i] >= 0 || ambulo__follows_elsewhere(body, model, i))
    line(1.0, 0.0, 7, text);
  else
    function_of(&model->links[body->link_of[i]], 7, text);
}

void ambulo__export_couplers(const ambulo__bodies *bodies, ambulo__text_buffer *text) {
  const ambulo_model *model = bodies->model;
  for (int b = 0; b < bodies->count; b++) {
    const ambulo__export_body *body = &bodies->list[b];
    for (int i = 0; i < body->joints; i++) {
      const ambulo_link *link = &model->links[body->link_of[i]];
      if (!ambulo__follows_elsewhere(body, model, i)) continue;
      ambulo__markup_text(text, "\t\t\t\t<CoordinateCouplerConstraint name=\"", link->name,
                          "_coupler\">\n");
      ambulo__text_append(text, "\t\t\t\t\t<coupled_coordinates_function>\n");
      function_of(link, 6, text);
      ambulo__text_append(text, "\t\t\t\t\t</coupled_coordinates_function>\n");
      ambulo__markup_text(text, "\t\t\t\t\t<independent_coordinate_names>",
                          model->coordinates[link->coupled_to].name,
                          "</independent_coordinate_names>\n");
      ambulo__markup_text(text, "\t\t\t\t\t<dependent_coordinate_name>", link->name,
                          "_coupled</dependent_coordinate_name>\n");
      ambulo__text_append(text, "\t\t\t\t</CoordinateCouplerConstraint>\n");
    }
  }
}

void ambulo__export_mimic(const ambulo_model *model, int index, ambulo__text_buffer *text) {
  const ambulo_link *link = &model->links[index];
  ambulo__markup_text(text, "    <mimic joint=\"", model->coordinates[link->coupled_to].name,
                      "\" multiplier=\"");
  ambulo__text_append_number(text, link->polynomial[1]);
  ambulo__text_append(text, "\" offset=\"");
  ambulo__text_append_number(text, link->polynomial[0]);
  ambulo__text_append(text, "\"/>\n");
}

/* -------------------------------------------------------- what has no counterpart */

static int is_driven(const ambulo_problem *problem, int coordinate) {
  for (int i = 0; problem && i < problem->definition.device_count; i++)
    if (problem->definition.devices[i].coordinate == coordinate) return 1;
  return 0;
}

ambulo_status ambulo__coupled_check(const ambulo_model *model, const ambulo_export_options *options,
                                    ambulo_diagnostics *diagnostics) {
  for (int i = 0; i < model->link_count; i++) {
    const ambulo_link *link = &model->links[i];
    if (link->coupled_to < 0) continue;
    const char *leader = model->coordinates[link->coupled_to].name;
    const char *why = NULL;
    if (options->format == AMBULO_EXPORT_NPZ)
      why = ": an .npz has no coupled joints; expected --format opensim";
    else if (options->format == AMBULO_EXPORT_URDF && ambulo__is_curved(link))
      why = " by a curve; a URDF has straight lines alone";
    else if (is_driven(options->problem, link->coupled_to))
      why = ", where a device acts: that cannot be exported";
    if (why)
      return ambulo__error(diagnostics, AMBULO_E_MODEL, ambulo__nowhere, NULL,
                           "'%s' follows '%s'%s", link->name, leader, why);
  }
  return AMBULO_OK;
}
