/* exchange/urdf_text.c - a model as URDF.
 *
 * X(q) = before J(axis, q) after, with the hinge's axis through the origin of `after`, is
 * before after J(after' axis, q): <origin> and <axis>. Points are links without mass on fixed
 * joints.
 */
#include <math.h>

#include "exchange/markup.h"
#include "exchange/texts.h"
#include "model/placement.h"

/* without a limit: larger than any of a body, small enough for programs that square it */
static const double unlimited = 1e9;

static void named(ambulo__text_buffer *text, const char *before, const char *name,
                  const char *after) {
  ambulo__text_append(text, before);
  ambulo__markup_text(text, name);
  ambulo__text_append(text, after);
}

static void numbers(ambulo__text_buffer *text, const char *before, const double *values, int count,
                    const char *after) {
  ambulo__text_append(text, before);
  ambulo__markup_numbers(text, values, count);
  ambulo__text_append(text, after);
}

static void print_origin(const ambulo__rigid *place, ambulo__text_buffer *text) {
  double rpy[3];
  ambulo__rpy_of_rotation(place->r, rpy);
  numbers(text, "    <origin xyz=\"", place->p, 3, "\"");
  numbers(text, " rpy=\"", rpy, 3, "\"/>\n");
}

static void print_link(const ambulo__export_body *body, ambulo__text_buffer *text) {
  static const char *const entries[] = {"ixx", "iyy", "izz", "ixy", "ixz", "iyz"};
  if (!(body->mass > 0.0)) {
    named(text, "  <link name=\"", body->name, "\"/>\n");
    return;
  }
  named(text, "  <link name=\"", body->name, "\">\n    <inertial>\n");
  numbers(text, "      <origin xyz=\"", body->com, 3, "\" rpy=\"0 0 0\"/>\n");
  numbers(text, "      <mass value=\"", &body->mass, 1, "\"/>\n      <inertia");
  for (int i = 0; i < 6; i++) {
    ambulo__text_append_format(text, " %s", entries[i]);
    numbers(text, "=\"", &body->inertia[i], 1, "\"");
  }
  ambulo__text_append(text, "/>\n    </inertial>\n  </link>\n");
}

static double largest(const double limits[2]) {
  double most = fmax(fabs(limits[0]), fabs(limits[1]));
  return isfinite(most) ? most : unlimited;
}

static void print_limit(const ambulo_coordinate *c, ambulo__text_buffer *text) {
  double effort = largest(c->torque), velocity = largest(c->speed);
  double low = isfinite(c->range[0]) ? c->range[0] : -unlimited;
  double high = isfinite(c->range[1]) ? c->range[1] : unlimited;
  int ranged = isfinite(c->range[0]) || isfinite(c->range[1]) || c->type == AMBULO_PRISMATIC;
  numbers(text, "    <limit effort=\"", &effort, 1, "\"");
  numbers(text, " velocity=\"", &velocity, 1, "\"");
  if (ranged) numbers(text, " lower=\"", &low, 1, "\"");
  if (ranged) numbers(text, " upper=\"", &high, 1, "\"");
  ambulo__text_append(text, "/>\n");
}

static const char *kind_of(const ambulo_coordinate *c) {
  if (!c) return "fixed";
  if (c->type == AMBULO_PRISMATIC) return "prismatic";
  return isfinite(c->range[0]) || isfinite(c->range[1]) ? "revolute" : "continuous";
}

static void print_joint(const ambulo__bodies *bodies, const ambulo__export_body *body,
                        ambulo__text_buffer *text) {
  const ambulo_coordinate *c =
      body->joints ? &bodies->model->coordinates[body->coordinate[0]] : NULL;
  ambulo__rigid origin = ambulo__rigid_times(&body->before, &body->after);
  named(text, "  <joint name=\"", c ? c->name : body->name, c ? "" : "_fixed");
  ambulo__text_append_format(text, "\" type=\"%s\">\n", kind_of(c));
  named(text, "    <parent link=\"", ambulo__export_name(bodies, body->parent), "\"/>\n");
  named(text, "    <child link=\"", body->name, "\"/>\n");
  print_origin(&origin, text);
  if (c) {
    double axis[3];
    ambulo__rigid_back(&body->after, body->axis[0], axis);
    numbers(text, "    <axis xyz=\"", axis, 3, "\"/>\n");
    print_limit(c, text);
  }
  ambulo__text_append(text, "  </joint>\n");
}

static void print_point(const ambulo__bodies *bodies, const ambulo_point *point,
                        ambulo__text_buffer *text) {
  double at[3];
  ambulo__body_point(bodies, point->link, point->position, at);
  ambulo__rigid place = ambulo__rigid_shift(at);
  named(text, "  <link name=\"", point->name, "_point\"/>\n");
  named(text, "  <joint name=\"", point->name, "_point_fixed\" type=\"fixed\">\n");
  named(text, "    <parent link=\"", ambulo__export_name(bodies, bodies->body_of[point->link]),
        "\"/>\n");
  named(text, "    <child link=\"", point->name, "_point\"/>\n");
  print_origin(&place, text);
  ambulo__text_append(text, "  </joint>\n");
}

void ambulo__export_urdf(const ambulo__bodies *bodies, ambulo__text_buffer *text) {
  const ambulo_model *model = bodies->model;
  ambulo__text_append(text, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" AMBULO__XML_MARK
                            "export: a URDF, z up, x forward -->\n");
  named(text, "<robot name=\"", model->name, "\">\n");
  if (bodies->root < 0) ambulo__text_append(text, "  <link name=\"world\"/>\n");
  for (int i = 0; i < bodies->count; i++) print_link(&bodies->list[i], text);
  for (int i = 0; i < bodies->count; i++)
    if (i > 0 || bodies->root < 0) print_joint(bodies, &bodies->list[i], text);
  for (int i = 0; i < model->point_count; i++)
    if (bodies->root < 0 || bodies->body_of[model->points[i].link] >= 0)
      print_point(bodies, &model->points[i], text);
  ambulo__text_append(text, "</robot>\n");
}
