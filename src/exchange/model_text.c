/* exchange/model_text.c - a model as XML: as OpenSim's version 4 has it, and as URDF.
 *
 * Bodies and joints are those of export.h; in OpenSim <inertia> is xx yy zz xy xz yz about the
 * centre of mass, as ours. Feet's points become markers, limits of torques coordinate actuators.
 */
#include "exchange/export.h"

#include "ambulo/status.h"
#include "model/placement.h"

#include <math.h>

/* R[0] = (cb cc, -cb sc, sb), (R[1][2], R[2][2]) = cb (-sa, ca). The last angle is that of
 * Rot_y(b)' Rot_x(a)' R, so that where cb vanishes, and a is any, c makes up for it. */
void ambulo__xyz_of_rotation(const double r[3][3], double angles[3]) {
  double a = atan2(-r[1][2], r[2][2]);
  double b = atan2(r[0][2], hypot(r[0][0], r[0][1]));
  double ca = cos(a), sa = sin(a);
  double c = atan2(ca * r[1][0] + sa * r[2][0], ca * r[1][1] + sa * r[2][1]);
  angles[0] = a;
  angles[1] = b;
  angles[2] = c;
}

/* ----------------------------------------------------------------------- OpenSim */

/* OpenSim's own word for no limit of a coordinate */
static const double unlimited = 99999.9;

const char *ambulo__export_name(const ambulo__bodies *bodies, int body) {
  if (body < 0) return bodies->single ? "world" : "ground";
  return bodies->list[body].name;
}

static void open_named(ambulo__text_buffer *text, int depth, const char *tag, const char *name) {
  ambulo__markup_tabs(text, depth);
  ambulo__text_append_format(text, "<%s name=\"", tag);
  ambulo__markup_text(text, "", name, "\">\n");
}

static void frame_path(const ambulo__bodies *bodies, int body, ambulo__text_buffer *text) {
  ambulo__markup_text(text, body < 0 ? "/" : "/bodyset/", ambulo__export_name(bodies, body), "");
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

/* the coordinate of a joint, which may be there for it alone; none where it follows one of its body
 */
static void print_mover(const ambulo__bodies *bodies, const ambulo__export_body *body, int i,
                        ambulo__text_buffer *text) {
  if (body->coordinate[i] >= 0) print_coordinate(bodies, body->coordinate[i], text);
  if (!ambulo__follows_elsewhere(body, bodies->model, i)) return;
  ambulo__text_append(text, "\t\t\t\t\t\t<Coordinate name=\"");
  ambulo__mover_name(body, bodies->model, i, text);
  ambulo__text_append(text, "\"/>\n");
}

static void print_frame(const ambulo__bodies *bodies, int body, const char *name, const char *end,
                        const ambulo__rigid *place, ambulo__text_buffer *text) {
  double angles[3];
  ambulo__xyz_of_rotation(place->r, angles);
  ambulo__markup_text(text, "\t\t\t\t\t\t<PhysicalOffsetFrame name=\"", name, "");
  ambulo__text_append_format(text, "%s\">\n\t\t\t\t\t\t\t<socket_parent>", end);
  frame_path(bodies, body, text);
  ambulo__text_append(text, "</socket_parent>\n");
  ambulo__markup_element(text, 7, "translation", place->p, 3);
  ambulo__markup_element(text, 7, "orientation", angles, 3);
  ambulo__text_append(text, "\t\t\t\t\t\t</PhysicalOffsetFrame>\n");
}

/* one of the six rows of a custom joint, that of the body's joint i; -1: a constant 0 */
static void print_row(const char *row, const ambulo_model *model, const ambulo__export_body *body,
                      int i, const double axis[3], ambulo__text_buffer *text) {
  open_named(text, 6, "TransformAxis", row);
  ambulo__text_append(text, "\t\t\t\t\t\t\t<coordinates>");
  if (i >= 0) ambulo__mover_name(body, model, i, text);
  ambulo__text_append(text, "</coordinates>\n");
  ambulo__markup_element(text, 7, "axis", axis, 3);
  if (i >= 0)
    ambulo__mover_function(body, model, i, text);
  else
    ambulo__text_append(text, "\t\t\t\t\t\t\t<Constant name=\"function\">\n"
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

static int slides_at(const ambulo__bodies *bodies, const ambulo__export_body *body, int i) {
  return bodies->model->links[body->link_of[i]].type == AMBULO_PRISMATIC;
}

static void print_transform(const ambulo__bodies *bodies, const ambulo__export_body *body,
                            ambulo__text_buffer *text) {
  static const char *const rows[2][3] = {{"rotation1", "rotation2", "rotation3"},
                                         {"translation1", "translation2", "translation3"}};
  ambulo__text_append(text, "\t\t\t\t\t<SpatialTransform>\n");
  for (int slides = 0; slides < 2; slides++) {
    double axis[3][3];
    int count = 0, joint[3] = {-1, -1, -1};
    for (int i = 0; i < body->joints; i++) {
      if (slides_at(bodies, body, i) != slides) continue;
      for (int k = 0; k < 3; k++) axis[count][k] = body->axis[i][k];
      joint[count++] = i;
    }
    fill_axes(axis, count);
    for (int row = 0; row < 3; row++)
      print_row(rows[slides][row], bodies->model, body, joint[row], axis[row], text);
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
  int slides = body->joints == 1 && slides_at(bodies, body, 0);
  const char *kind = kinds[body->joints > 1 ? 3 : body->joints + slides];
  const char *parent = ambulo__export_name(bodies, body->parent);
  ambulo__rigid before = body->before, after = body->after;
  if (slides) aim_slider(&before, &after);
  after = ambulo__rigid_inverse(&after);
  ambulo__text_append_format(text, "\t\t\t\t<%s name=\"", kind);
  ambulo__markup_text(text, "", body->name, "_joint\">\n\t\t\t\t\t<socket_parent_frame>");
  ambulo__markup_text(text, "", parent,
                      "_offset</socket_parent_frame>\n\t\t\t\t\t<socket_child_frame>");
  ambulo__markup_text(text, "", body->name, "_offset</socket_child_frame>\n");
  if (body->joints) ambulo__text_append(text, "\t\t\t\t\t<coordinates>\n");
  /* hinges first, as OpenSim numbers those of a custom joint */
  for (int pass = 0; pass < 2; pass++)
    for (int i = 0; i < body->joints; i++)
      if (slides_at(bodies, body, i) == pass) print_mover(bodies, body, i, text);
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
  ambulo__markup_text(text, "\t\t\t\t\t<coordinate>", c->name, "</coordinate>\n");
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
  if (model->coupled_count > 0) {
    begin_set(text, "ConstraintSet", "constraintset");
    ambulo__export_couplers(bodies, text);
    end_set(text, "ConstraintSet");
  }
  begin_set(text, "MarkerSet", "markerset");
  for (int i = 0; i < model->point_count; i++) print_marker(bodies, &model->points[i], text);
  end_set(text, "MarkerSet");
  ambulo__text_append(text, "\t</Model>\n</OpenSimDocument>\n");
}

/* ------------------------------------------------------------------------- URDF */

/* X(q) = before J(axis, q) after, with the hinge's axis through the origin of `after`, is
 * before after J(after' axis, q): <origin> and <axis>. Points are links without mass on fixed
 * joints.
 */

/* without a limit: larger than any of a body, small enough for programs that square it */
static const double urdf_unlimited = 1e9;

static void print_origin(const ambulo__rigid *place, ambulo__text_buffer *text) {
  double rpy[3];
  ambulo__rpy_of_rotation(place->r, rpy);
  ambulo__markup_numbers(text, "    <origin xyz=\"", place->p, 3, "\"");
  ambulo__markup_numbers(text, " rpy=\"", rpy, 3, "\"/>\n");
}

static void print_link(const ambulo__export_body *body, ambulo__text_buffer *text) {
  static const char *const entries[] = {"ixx", "iyy", "izz", "ixy", "ixz", "iyz"};
  if (!(body->mass > 0.0)) {
    ambulo__markup_text(text, "  <link name=\"", body->name, "\"/>\n");
    return;
  }
  ambulo__markup_text(text, "  <link name=\"", body->name, "\">\n    <inertial>\n");
  ambulo__markup_numbers(text, "      <origin xyz=\"", body->com, 3, "\" rpy=\"0 0 0\"/>\n");
  ambulo__markup_numbers(text, "      <mass value=\"", &body->mass, 1, "\"/>\n      <inertia");
  for (int i = 0; i < 6; i++) {
    ambulo__text_append_format(text, " %s", entries[i]);
    ambulo__markup_numbers(text, "=\"", &body->inertia[i], 1, "\"");
  }
  ambulo__text_append(text, "/>\n    </inertial>\n  </link>\n");
}

static double largest(const double limits[2]) {
  double most = fmax(fabs(limits[0]), fabs(limits[1]));
  return isfinite(most) ? most : urdf_unlimited;
}

static void print_limit(const ambulo_coordinate *c, ambulo_joint_type type,
                        ambulo__text_buffer *text) {
  double effort = largest(c->torque), velocity = largest(c->speed);
  double low = isfinite(c->range[0]) ? c->range[0] : -urdf_unlimited;
  double high = isfinite(c->range[1]) ? c->range[1] : urdf_unlimited;
  int ranged = isfinite(c->range[0]) || isfinite(c->range[1]) || type == AMBULO_PRISMATIC;
  ambulo__markup_numbers(text, "    <limit effort=\"", &effort, 1, "\"");
  ambulo__markup_numbers(text, " velocity=\"", &velocity, 1, "\"");
  if (ranged) ambulo__markup_numbers(text, " lower=\"", &low, 1, "\"");
  if (ranged) ambulo__markup_numbers(text, " upper=\"", &high, 1, "\"");
  ambulo__text_append(text, "/>\n");
  if (c->damping == 0.0 && c->friction == 0.0) return;
  ambulo__markup_numbers(text, "    <dynamics damping=\"", &c->damping, 1, "\"");
  ambulo__markup_numbers(text, " friction=\"", &c->friction, 1, "\"/>\n");
}

static const char *kind_of(const ambulo_link *link, const ambulo_coordinate *c) {
  if (!link) return "fixed";
  if (!c) return link->type == AMBULO_PRISMATIC ? "prismatic" : "continuous";
  if (c->type == AMBULO_PRISMATIC) return "prismatic";
  return isfinite(c->range[0]) || isfinite(c->range[1]) ? "revolute" : "continuous";
}

static void print_urdf_joint(const ambulo__bodies *bodies, const ambulo__export_body *body,
                             ambulo__text_buffer *text) {
  const ambulo_model *model = bodies->model;
  const ambulo_link *link = body->joints ? &model->links[body->link_of[0]] : NULL;
  const ambulo_coordinate *c =
      link && link->coordinate >= 0 ? &model->coordinates[link->coordinate] : NULL;
  const ambulo_coordinate unlimited_one = ambulo_coordinate_default();
  ambulo__rigid origin = ambulo__rigid_times(&body->before, &body->after);
  ambulo__markup_text(text, "  <joint name=\"", c ? c->name : body->name,
                      c      ? ""
                      : link ? "_coupled"
                             : "_fixed");
  ambulo__text_append_format(text, "\" type=\"%s\">\n", kind_of(link, c));
  ambulo__markup_text(text, "    <parent link=\"", ambulo__export_name(bodies, body->parent),
                      "\"/>\n");
  ambulo__markup_text(text, "    <child link=\"", body->name, "\"/>\n");
  print_origin(&origin, text);
  if (link) {
    double axis[3];
    ambulo__rigid_back(&body->after, body->axis[0], axis);
    ambulo__markup_numbers(text, "    <axis xyz=\"", axis, 3, "\"/>\n");
    print_limit(c ? c : &unlimited_one, link->type, text);
    if (!c) ambulo__export_mimic(model, body->link_of[0], text);
  }
  ambulo__text_append(text, "  </joint>\n");
}

static void print_point(const ambulo__bodies *bodies, const ambulo_point *point,
                        ambulo__text_buffer *text) {
  double at[3];
  ambulo__body_point(bodies, point->link, point->position, at);
  ambulo__rigid place = ambulo__rigid_shift(at);
  ambulo__markup_text(text, "  <link name=\"", point->name, "_point\"/>\n");
  ambulo__markup_text(text, "  <joint name=\"", point->name, "_point_fixed\" type=\"fixed\">\n");
  ambulo__markup_text(text, "    <parent link=\"",
                      ambulo__export_name(bodies, bodies->body_of[point->link]), "\"/>\n");
  ambulo__markup_text(text, "    <child link=\"", point->name, "_point\"/>\n");
  print_origin(&place, text);
  ambulo__text_append(text, "  </joint>\n");
}

void ambulo__export_urdf(const ambulo__bodies *bodies, ambulo__text_buffer *text) {
  const ambulo_model *model = bodies->model;
  ambulo__text_append(text, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" AMBULO__XML_MARK
                            "export: a URDF, z up, x forward -->\n");
  ambulo__markup_text(text, "<robot name=\"", model->name, "\">\n");
  if (bodies->root < 0) ambulo__text_append(text, "  <link name=\"world\"/>\n");
  for (int i = 0; i < bodies->count; i++) print_link(&bodies->list[i], text);
  for (int i = 0; i < bodies->count; i++)
    if (i > 0 || bodies->root < 0) print_urdf_joint(bodies, &bodies->list[i], text);
  for (int i = 0; i < model->point_count; i++)
    if (bodies->root < 0 || bodies->body_of[model->points[i].link] >= 0)
      print_point(bodies, &model->points[i], text);
  ambulo__text_append(text, "</robot>\n");
}
