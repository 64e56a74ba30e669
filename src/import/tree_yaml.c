/* import/tree_yaml.c - a tree as the text of a model file (docs/model-format.md).
 *
 * Angles are in degrees. Placements and bodies are printed to 15 digits, which keeps a rotation to
 * 1e-15 rad and spares the reader 0.30000000000000004; limits to a millionth of a degree, so that
 * -2.0943951 rad reads -120.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/numtext.h"
#include "import/body_tree.h"
#include "model/placement.h"

static const double degree = 0.017453292519943295; /* rad */

/* x to `digits` significant digits; exactly the number whose shortest text has them */
static double rounded(double x, int digits) {
  if (x == 0.0 || !isfinite(x)) return isfinite(x) ? 0.0 : x;
  int exponent = digits - 1 - (int)floor(log10(fabs(x)));
  if (exponent > 22 || exponent < -22) return x;
  double power = pow(10.0, abs(exponent));
  return exponent >= 0 ? round(x * power) / power : round(x / power) * power;
}

static double neat(double x) {
  return fabs(x) < 1e-17 ? 0.0 : rounded(x, 15);
}

/* of directions and angles, where what is left of a right angle is noise */
static double neat_turn(double x) {
  return fabs(x) < 1e-15 ? 0.0 : rounded(x, 15);
}

/* of places on links that were computed */
static double neat_point(double x) {
  return fabs(x) < 1e-12 ? 0.0 : rounded(x, 12);
}

static void list(ambulo__text_buffer *text, const double *values, int count,
                 double (*form)(double)) {
  ambulo__text_append(text, "[");
  for (int i = 0; i < count; i++) {
    if (i) ambulo__text_append(text, ", ");
    ambulo__text_append_number(text, form(values[i]));
  }
  ambulo__text_append(text, "]");
}

/* what a comment or a quoted text may hold: printable ASCII but quotes and backslashes */
static void plain_text(ambulo__text_buffer *text, const char *from) {
  for (; *from; from++) {
    unsigned char c = (unsigned char)*from;
    int good = c >= ' ' && c < 0x7f && c != '"' && c != '\\';
    ambulo__text_append_char(text, good ? (char)c : c == '"' ? '\'' : '?');
  }
}

/* ------------------------------------------------------------------------ parts */

static double limit_of(double value, double unit) {
  value /= unit;
  return unit == 1.0 || !isfinite(value) ? value : round(value * 1e6) / 1e6;
}

static void print_limits(ambulo__text_buffer *text, const char *key, const double limits[2],
                         double unit) {
  if (!isfinite(limits[0]) && !isfinite(limits[1])) return;
  ambulo__text_append_format(text, ", %s: [", key);
  for (int i = 0; i < 2; i++) {
    double value = limit_of(limits[i], unit);
    if (i) ambulo__text_append(text, ", ");
    if (isfinite(value))
      ambulo__text_append_number(text, value == 0.0 ? 0.0 : value);
    else
      ambulo__text_append(text, "none");
  }
  ambulo__text_append(text, "]");
}

static void print_drive(const ambulo_coordinate *c, ambulo__text_buffer *text) {
  static const char *const keys[] = {"armature", "damping", "friction"};
  const double values[] = {c->armature, c->damping, c->friction};
  for (int i = 0; i < 3; i++) {
    if (values[i] == 0.0) continue;
    ambulo__text_append_format(text, ", %s: ", keys[i]);
    ambulo__text_append_number(text, values[i]);
  }
}

static void print_coordinate(const ambulo__tree *tree, const ambulo__tree_link *link,
                             ambulo__text_buffer *text) {
  const ambulo_coordinate *c = &link->coordinate;
  double unit = link->type == AMBULO_REVOLUTE ? degree : 1.0;
  ambulo__text_append_format(text, ",\n     coordinate: {name: %s", c->name);
  print_limits(text, "range", c->range, unit);
  if (c->default_value != 0.0) {
    ambulo__text_append(text, ", default: ");
    ambulo__text_append_number(text, neat(limit_of(c->default_value, unit)));
  }
  print_limits(text, "speed", c->speed, unit);
  print_limits(text, "torque", c->torque, 1.0);
  print_drive(c, text);
  if (!c->actuated) ambulo__text_append(text, ", actuated: false");
  if (link->has_mirror) {
    const char *partner = tree->links[c->mirror].coordinate.name;
    if (strcmp(partner, c->name) != 0) ambulo__text_append_format(text, ", mirror: %s", partner);
    if (c->mirror_sign < 0.0) ambulo__text_append(text, ", mirror_sign: -1");
  }
  ambulo__text_append(text, "}");
}

/* Angles of both sides in degrees: c_i becomes c_i X^i / Y. */
static void print_function(const ambulo__tree *tree, const ambulo__tree_link *link,
                           ambulo__text_buffer *text) {
  const ambulo__tree_function *f = &link->function;
  const ambulo__tree_link *to = &tree->links[ambulo__tree_find_coordinate(tree, link->follows)];
  double x = to->type == AMBULO_REVOLUTE ? degree : 1.0;
  double y = link->type == AMBULO_REVOLUTE ? degree : 1.0, factor = 1.0 / y;
  int last = AMBULO__COUPLING_TERMS - 1;
  while (last > 0 && f->polynomial[last] == 0.0) last--;
  ambulo__text_append_format(text, ",\n     coupled: {to: %s, %s: [", to->coordinate.name,
                             f->count ? "spline" : "polynomial");
  for (int i = 0; i <= last && f->count == 0; i++, factor *= x) {
    if (i) ambulo__text_append(text, ", ");
    ambulo__text_append_number(text, neat(factor * f->polynomial[i]));
  }
  for (int i = 0; i < f->count; i++) {
    const double pair[2] = {f->points[2 * i] / x, f->points[2 * i + 1] / y};
    if (i) ambulo__text_append(text, i % 4 ? ", " : ",\n       ");
    list(text, pair, 2, neat);
  }
  ambulo__text_append(text, "]}");
}

static void print_link(const ambulo__tree *tree, const ambulo__tree_link *link,
                       ambulo__text_buffer *text) {
  static const char *const types[] = {"", "fixed", "revolute", "prismatic"};
  double rpy[3];
  ambulo__rpy_of_rotation((const double(*)[3])link->origin.r, rpy);
  for (int i = 0; i < 3; i++) rpy[i] = fabs(rpy[i]) < 1e-15 ? 0.0 : rpy[i] / degree;
  if (link->comment) {
    ambulo__text_append(text, "  # ");
    plain_text(text, link->comment);
    ambulo__text_append(text, "\n");
  }
  ambulo__text_append_format(
      text, "  - {name: %s, parent: %s, joint: %s,\n     origin: {xyz: ", link->name,
      link->parent < 0 ? "none" : tree->links[link->parent].name, types[link->type]);
  list(text, link->origin.p, 3, neat);
  if (rpy[0] != 0.0 || rpy[1] != 0.0 || rpy[2] != 0.0) {
    ambulo__text_append(text, ", rpy: ");
    list(text, rpy, 3, neat_turn);
  }
  ambulo__text_append(text, "}");
  if (link->type != AMBULO_FIXED) {
    ambulo__text_append(text, ", axis: ");
    list(text, link->axis, 3, neat_turn);
    if (link->follows)
      print_function(tree, link, text);
    else
      print_coordinate(tree, link, text);
  }
  if (link->body.mass > 0.0) {
    ambulo__text_append(text, ",\n     body: {mass: ");
    ambulo__text_append_number(text, neat(link->body.mass));
    ambulo__text_append(text, ", com: ");
    list(text, link->body.com, 3, neat);
    ambulo__text_append(text, ",\n       inertia: ");
    list(text, link->body.inertia, 6, neat);
    ambulo__text_append(text, "}");
  }
  ambulo__text_append(text, "}\n");
}

static void print_corners(const ambulo__tree *tree, const char *key, const int corners[2],
                          ambulo__text_buffer *text) {
  ambulo__text_append_format(text, ", %s: [%s", key, tree->points[corners[0]].name);
  if (corners[1] >= 0) ambulo__text_append_format(text, ", %s", tree->points[corners[1]].name);
  ambulo__text_append(text, "]");
}

static void print_sole(const ambulo__tree *tree, const ambulo__tree_foot *foot,
                       ambulo__text_buffer *text) {
  print_corners(tree, "heel", foot->heel, text);
  print_corners(tree, "toe", foot->toe, text);
  ambulo__text_append_format(text, ",\n     heel_center: %s, toe_center: %s",
                             tree->points[foot->heel_center].name,
                             tree->points[foot->toe_center].name);
}

static void print_feet(const ambulo__tree *tree, ambulo__text_buffer *text) {
  ambulo__text_append(text, "\nfeet:\n");
  for (int i = 0; i < tree->foot_count; i++) {
    const ambulo__tree_foot *foot = &tree->feet[i];
    int mirror = ambulo__tree_mirror_foot(tree, i);
    ambulo__text_append_format(text, "  - {name: %s", foot->name);
    if (foot->heel_center == foot->toe_center)
      ambulo__text_append_format(text, ", point: %s", tree->points[foot->heel_center].name);
    else
      print_sole(tree, foot, text);
    if (mirror >= 0) ambulo__text_append_format(text, ", mirror: %s", tree->feet[mirror].name);
    ambulo__text_append(text, "}\n");
  }
}

/* ------------------------------------------------------------------------- whole */

/* Not the mark of tables that are ambulo's own (formats/atomic_file.h): the text is to be changed
 * by people, and is not written over unasked. */
static void print_head(const ambulo__tree *tree, const char *source, ambulo__text_buffer *text) {
  ambulo__text_append_format(text, "# A model that ambulo imported from the %s file ",
                             tree->format);
  plain_text(text, source);
  ambulo__text_append(text, "\n# Lengths in m, masses in kg, angles in degrees, speeds per second, "
                            "torques in N m; limits "
                            "are\n# rounded to a millionth of a degree.\n");
  if (tree->note_count)
    ambulo__text_append(text, "#\n# What was changed, and what of the source is missing here:\n");
  for (int i = 0; i < tree->note_count; i++) {
    ambulo__text_append(text, "#   - ");
    plain_text(text, tree->notes[i]);
    ambulo__text_append(text, "\n");
  }
  ambulo__text_append_format(text, "\nambulo: 1\nkind: model\nname: %s\nsource: \"", tree->name);
  plain_text(text, source);
  ambulo__text_append_format(text, " (%s)\"\nunits: {angle: degrees}\ngravity: ", tree->format);
  list(text, tree->gravity, 3, neat);
  ambulo__text_append(text, "\nforward: ");
  list(text, tree->forward, 3, neat);
  ambulo__text_append(text, "\n\nlinks:\n");
}

void ambulo__tree_print(const ambulo__tree *tree, const char *source, ambulo__text_buffer *text) {
  print_head(tree, source, text);
  for (int i = 0; i < tree->link_count; i++) print_link(tree, &tree->links[i], text);
  if (tree->point_count) ambulo__text_append(text, "\npoints:\n");
  for (int i = 0; i < tree->point_count; i++) {
    const ambulo__tree_point *p = &tree->points[i];
    ambulo__text_append_format(text, "  - {name: %s, link: %s, position: ", p->name,
                               tree->links[p->link].name);
    list(text, p->position, 3, neat_point);
    ambulo__text_append(text, "}\n");
  }
  if (tree->foot_count) print_feet(tree, text);
}
