/* exchange/osim_text.c - a model as OpenSim's version 4 has it.
 *
 * Bodies and joints are those of bodies.h; <inertia> is xx yy zz xy xz yz about the centre of mass,
 * as ours. Feet's points become markers, limits of torques coordinate actuators.
 */
#include <math.h>

#include "ambulo/status.h"
#include "exchange/markup.h"
#include "exchange/texts.h"

/* OpenSim's own word for no limit of a coordinate */
static const double unlimited = 99999.9;

const char *ambulo__export_name(const ambulo__bodies *bodies, int body) {
  if (body < 0) return bodies->single ? "world" : "ground";
  return bodies->list[body].name;
}

static void open_named(ambulo__text_buffer *text, int depth, const char *tag, const char *name) {
  ambulo__markup_tabs(text, depth);
  ambulo__text_append_format(text, "<%s name=\"", tag);
  ambulo__markup_text(text, name);
  ambulo__text_append(text, "\">\n");
}

static void frame_path(const ambulo__bodies *bodies, int body, ambulo__text_buffer *text) {
  ambulo__text_append(text, body < 0 ? "/" : "/bodyset/");
  ambulo__markup_text(text, ambulo__export_name(bodies, body));
}

/* ------------------------------------------------------------------------- joints */

static void print_coordinate(const ambulo__bodies *bodies, int index, ambulo__text_buffer *text) {
  const ambulo_coordinate *c = &bodies->model->coordinates[index];
  double offset = bodies->offset[index], start = c->default_value + offset;
  const double range[2] = {isfinite(c->range[0]) ? c->range[0] + offset : -unlimited,
                           isfinite(c->range[1]) ? c->range[1] + offset : unlimited};
  open_named(text, 6, "Coordinate", c->name);
  ambulo__markup_element(text, 7, "default_value", &start, 1);
  ambulo__markup_element(text, 7, "range", range, 2);
  ambulo__text_append(text, "\t\t\t\t\t\t\t<clamped>false</clamped>\n\t\t\t\t\t\t</Coordinate>\n");
}

static void print_frame(const ambulo__bodies *bodies, int body, const char *name, const char *end,
                        const ambulo__rigid *place, ambulo__text_buffer *text) {
  double angles[3];
  ambulo__xyz_of_rotation(place->r, angles);
  ambulo__text_append(text, "\t\t\t\t\t\t<PhysicalOffsetFrame name=\"");
  ambulo__markup_text(text, name);
  ambulo__text_append_format(text, "%s\">\n\t\t\t\t\t\t\t<socket_parent>", end);
  frame_path(bodies, body, text);
  ambulo__text_append(text, "</socket_parent>\n");
  ambulo__markup_element(text, 7, "translation", place->p, 3);
  ambulo__markup_element(text, 7, "orientation", angles, 3);
  ambulo__text_append(text, "\t\t\t\t\t\t</PhysicalOffsetFrame>\n");
}

/* one of the six rows of a custom joint; coordinate NULL: a constant 0 */
static void print_row(const char *row, const char *coordinate, const double axis[3],
                      ambulo__text_buffer *text) {
  open_named(text, 6, "TransformAxis", row);
  ambulo__text_append(text, "\t\t\t\t\t\t\t<coordinates>");
  if (coordinate) ambulo__markup_text(text, coordinate);
  ambulo__text_append(text, "</coordinates>\n");
  ambulo__markup_element(text, 7, "axis", axis, 3);
  ambulo__text_append(text, coordinate ? "\t\t\t\t\t\t\t<LinearFunction name=\"function\">\n"
                                         "\t\t\t\t\t\t\t\t<coefficients>1 0</coefficients>\n"
                                         "\t\t\t\t\t\t\t</LinearFunction>\n"
                                       : "\t\t\t\t\t\t\t<Constant name=\"function\">\n"
                                         "\t\t\t\t\t\t\t\t<value>0</value>\n"
                                         "\t\t\t\t\t\t\t</Constant>\n");
  ambulo__text_append(text, "\t\t\t\t\t\t</TransformAxis>\n");
}

/* axes of rows that no coordinate has: with those before, far from a plane */
static void fill_axes(double axis[3][3], int given) {
  for (int row = given; row < 3; row++) {
    double best = -1.0;
    for (int k = 0; k < 3; k++) {
      const double unit[3] = {k == 0, k == 1, k == 2};
      double most = 0.0;
      for (int i = 0; i < row; i++) most = fmax(most, fabs(axis[i][k]));
      if (row == 2) {
        double normal[3] = {axis[0][1] * axis[1][2] - axis[0][2] * axis[1][1],
                            axis[0][2] * axis[1][0] - axis[0][0] * axis[1][2],
                            axis[0][0] * axis[1][1] - axis[0][1] * axis[1][0]};
        most = 1.0 - fabs(normal[k]);
      }
      if (1.0 - most <= best) continue;
      best = 1.0 - most;
      for (int i = 0; i < 3; i++) axis[row][i] = unit[i];
    }
  }
}

static void print_transform(const ambulo__bodies *bodies, const ambulo__export_body *body,
                            ambulo__text_buffer *text) {
  static const char *const rows[2][3] = {{"rotation1", "rotation2", "rotation3"},
                                         {"translation1", "translation2", "translation3"}};
  ambulo__text_append(text, "\t\t\t\t\t<SpatialTransform>\n");
  for (int slides = 0; slides < 2; slides++) {
    const char *name[3] = {NULL, NULL, NULL};
    double axis[3][3];
    int count = 0;
    for (int i = 0; i < body->joints; i++) {
      const ambulo_coordinate *c = &bodies->model->coordinates[body->coordinate[i]];
      if ((c->type == AMBULO_PRISMATIC) != slides) continue;
      for (int k = 0; k < 3; k++) axis[count][k] = body->axis[i][k];
      name[count++] = c->name;
    }
    fill_axes(axis, count);
    for (int row = 0; row < 3; row++) print_row(rows[slides][row], name[row], axis[row], text);
  }
  ambulo__text_append(text, "\t\t\t\t\t</SpatialTransform>\n");
}

/* A joint's only axis is z (bodies.c), a pin's too; a slider goes along its frames' x: both are
 * turned. */
static void aim_slider(ambulo__rigid *before, ambulo__rigid *after) {
  static const double y[3] = {0, 1, 0};
  ambulo__rigid x_to_z = ambulo__rigid_turn(y, -1.5707963267948966),
                back = ambulo__rigid_inverse(&x_to_z);
  *before = ambulo__rigid_times(before, &x_to_z);
  *after = ambulo__rigid_times(&back, after);
}

static void print_joint(const ambulo__bodies *bodies, const ambulo__export_body *body,
                        ambulo__text_buffer *text) {
  static const char *const kinds[] = {"WeldJoint", "PinJoint", "SliderJoint", "CustomJoint"};
  int slides =
      body->joints == 1 && bodies->model->coordinates[body->coordinate[0]].type == AMBULO_PRISMATIC;
  const char *kind = kinds[body->joints > 1 ? 3 : body->joints + slides];
  const char *parent = ambulo__export_name(bodies, body->parent);
  ambulo__rigid before = body->before, after = body->after;
  if (slides) aim_slider(&before, &after);
  after = ambulo__rigid_inverse(&after);
  ambulo__text_append_format(text, "\t\t\t\t<%s name=\"", kind);
  ambulo__markup_text(text, body->name);
  ambulo__text_append(text, "_joint\">\n\t\t\t\t\t<socket_parent_frame>");
  ambulo__markup_text(text, parent);
  ambulo__text_append(text, "_offset</socket_parent_frame>\n\t\t\t\t\t<socket_child_frame>");
  ambulo__markup_text(text, body->name);
  ambulo__text_append(text, "_offset</socket_child_frame>\n");
  if (body->joints) ambulo__text_append(text, "\t\t\t\t\t<coordinates>\n");
  /* hinges first, as OpenSim numbers those of a custom joint */
  for (int pass = 0; pass < 2; pass++)
    for (int i = 0; i < body->joints; i++)
      if ((bodies->model->coordinates[body->coordinate[i]].type == AMBULO_PRISMATIC) == pass)
        print_coordinate(bodies, body->coordinate[i], text);
  if (body->joints) ambulo__text_append(text, "\t\t\t\t\t</coordinates>\n");
  ambulo__text_append(text, "\t\t\t\t\t<frames>\n");
  print_frame(bodies, body->parent, parent, "_offset", &before, text);
  print_frame(bodies, (int)(body - bodies->list), body->name, "_offset", &after, text);
  ambulo__text_append(text, "\t\t\t\t\t</frames>\n");
  if (body->joints > 1) print_transform(bodies, body, text);
  ambulo__text_append_format(text, "\t\t\t\t</%s>\n", kind);
}

/* ----------------------------------------------------------------- bodies and sets */

static void print_body(const ambulo__export_body *body, ambulo__text_buffer *text) {
  open_named(text, 4, "Body", body->name);
  ambulo__markup_element(text, 5, "mass", &body->mass, 1);
  ambulo__markup_element(text, 5, "mass_center", body->com, 3);
  ambulo__markup_element(text, 5, "inertia", body->inertia, 6);
  ambulo__text_append(text, "\t\t\t\t</Body>\n");
}

static void begin_set(ambulo__text_buffer *text, const char *tag, const char *name) {
  open_named(text, 2, tag, name);
  ambulo__text_append(text, "\t\t\t<objects>\n");
}

static void end_set(ambulo__text_buffer *text, const char *tag) {
  ambulo__text_append_format(text, "\t\t\t</objects>\n\t\t</%s>\n", tag);
}

static void print_actuator(const ambulo_coordinate *c, ambulo__text_buffer *text) {
  static const double one = 1.0;
  open_named(text, 4, "CoordinateActuator", c->name);
  if (isfinite(c->torque[0])) ambulo__markup_element(text, 5, "min_control", &c->torque[0], 1);
  if (isfinite(c->torque[1])) ambulo__markup_element(text, 5, "max_control", &c->torque[1], 1);
  ambulo__text_append(text, "\t\t\t\t\t<coordinate>");
  ambulo__markup_text(text, c->name);
  ambulo__text_append(text, "</coordinate>\n");
  ambulo__markup_element(text, 5, "optimal_force", &one, 1);
  ambulo__text_append(text, "\t\t\t\t</CoordinateActuator>\n");
}

static void print_marker(const ambulo__bodies *bodies, const ambulo_point *point,
                         ambulo__text_buffer *text) {
  double at[3];
  ambulo__body_point(bodies, point->link, point->position, at);
  open_named(text, 4, "Marker", point->name);
  ambulo__text_append(text, "\t\t\t\t\t<socket_parent_frame>");
  frame_path(bodies, bodies->body_of[point->link], text);
  ambulo__text_append(text, "</socket_parent_frame>\n");
  ambulo__markup_element(text, 5, "location", at, 3);
  ambulo__text_append(text, "\t\t\t\t\t<fixed>true</fixed>\n\t\t\t\t</Marker>\n");
}

void ambulo__export_osim(const ambulo__bodies *bodies, ambulo__text_buffer *text) {
  const ambulo_model *model = bodies->model;
  double gravity[3];
  ambulo__rigid_vector(&bodies->world, model->gravity, gravity);
  ambulo__text_append(text, "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n" AMBULO__XML_MARK
                            "export: an OpenSim model -->\n<OpenSimDocument Version=\"40000\">\n");
  open_named(text, 1, "Model", model->name);
  ambulo__markup_element(text, 2, "gravity", gravity, 3);
  ambulo__text_append(text, "\t\t<length_units>meters</length_units>\n"
                            "\t\t<force_units>N</force_units>\n");
  begin_set(text, "BodySet", "bodyset");
  for (int i = 0; i < bodies->count; i++) print_body(&bodies->list[i], text);
  end_set(text, "BodySet");
  begin_set(text, "JointSet", "jointset");
  for (int i = 0; i < bodies->count; i++) print_joint(bodies, &bodies->list[i], text);
  end_set(text, "JointSet");
  begin_set(text, "ForceSet", "forceset");
  for (int i = 0; i < model->coordinate_count; i++)
    if (model->coordinates[i].actuated) print_actuator(&model->coordinates[i], text);
  end_set(text, "ForceSet");
  begin_set(text, "MarkerSet", "markerset");
  for (int i = 0; i < model->point_count; i++) print_marker(bodies, &model->points[i], text);
  end_set(text, "MarkerSet");
  ambulo__text_append(text, "\t</Model>\n</OpenSimDocument>\n");
}
