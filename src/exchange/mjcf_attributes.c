/* exchange/mjcf_attributes.c - attributes with their defaults, and placements (mjcf.h).
 *
 * Default classes are nested <default class=...>; an element takes what it does not say from the
 * class it names, else from the childclass around it, else from the top one, and what that does not
 * say from the class around that. Rotations are one of a quaternion (w, x, y, z), an axis with an
 * angle, three turns in the compiler's order (small letters: about turned axes, capitals: about
 * fixed ones), the x and y axes, or the z axis with the smallest turn that takes it there.
 */
#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "exchange/mjcf.h"

/* the <default> of a class, anywhere below; several of one name add up: the first that has `tag`
 * with the attribute counts */
static const char *below(const ambulo__xml_node *set, const char *name, const char *tag,
                         const char *attribute, int top, const ambulo__xml_node **found) {
  const char *own = ambulo__xml_attribute(set, "class");
  if (top && !own) own = "main";
  int here = name ? own && strcmp(own, name) == 0 : top;
  if (here) {
    *found = set;
    for (const ambulo__xml_node *n = ambulo__xml_child(set, tag); n; n = ambulo__xml_next(n, tag)) {
      const char *text = ambulo__xml_attribute(n, attribute);
      if (text) return text;
    }
  }
  for (const ambulo__xml_node *n = ambulo__xml_child(set, "default"); n;
       n = ambulo__xml_next(n, "default")) {
    const char *text = below(n, name, tag, attribute, 0, found);
    if (text) return text;
  }
  return NULL;
}

/* of a class and those around it, outwards */
static const char *of_class(const ambulo__mjcf *m, const char *name, const char *tag,
                            const char *attribute) {
  const ambulo__xml_node *found = NULL;
  const char *text = NULL;
  for (const ambulo__xml_node *n = ambulo__xml_child(m->root, "default"); n && !text;
       n = ambulo__xml_next(n, "default"))
    text = below(n, name, tag, attribute, 1, &found);
  for (const ambulo__xml_node *n = found ? found->parent : NULL;
       n && !text && ambulo__xml_is(n, "default"); n = n->parent) {
    for (const ambulo__xml_node *e = ambulo__xml_child(n, tag); e && !text;
         e = ambulo__xml_next(e, tag))
      text = ambulo__xml_attribute(e, attribute);
  }
  return text;
}

const char *ambulo__mjcf_text(const ambulo__mjcf *m, const ambulo__xml_node *node,
                              const char *around, const char *attribute) {
  const char *text = ambulo__xml_attribute(node, attribute);
  const char *name = ambulo__xml_attribute(node, "class");
  if (text) return text;
  return of_class(m, name ? name : around, node->name, attribute);
}

int ambulo__mjcf_numbers(const ambulo__mjcf *m, const ambulo__xml_node *node, const char *around,
                         const char *attribute, int least, int most, double *values) {
  enum { MOST = 16 };
  double read[MOST];
  const char *text = ambulo__mjcf_text(m, node, around, attribute);
  if (!text) return 0;
  int count = ambulo__xml_numbers(m->xml, node, attribute, text, MOST, 0, read);
  if (count < 0) return 0;
  if (count < least || count > most) {
    ambulo__xml_error(m->xml, node, AMBULO_E_SCHEMA, NULL, "%s of <%s> has %d numbers; expected %d",
                      attribute, node->name, count, most);
    return 0;
  }
  memcpy(values, read, (size_t)count * sizeof *values);
  return count;
}

int ambulo__mjcf_flag(const ambulo__mjcf *m, const ambulo__xml_node *node, const char *around,
                      const char *attribute, int otherwise) {
  static const char *const words[] = {"false", "true", "auto"};
  const char *text = ambulo__mjcf_text(m, node, around, attribute);
  if (!text) return otherwise;
  int choice = ambulo__xml_choice(m->xml, node, attribute, text, words, 3);
  return choice == 2 ? -1 : choice < 0 ? otherwise : choice;
}

/* ------------------------------------------------------------------------ rotations */

static void of_euler(const ambulo__mjcf *m, const double angles[3], ambulo__rigid *a) {
  for (int i = 0; i < 3; i++) {
    char c = m->sequence[i];
    int fixed = c >= 'A' && c <= 'Z', k = fixed ? c - 'X' : c - 'x';
    const double axis[3] = {k == 0, k == 1, k == 2};
    ambulo__rigid turn = ambulo__rigid_turn(axis, angles[i] * m->angle);
    *a = fixed ? ambulo__rigid_times(&turn, a) : ambulo__rigid_times(a, &turn);
  }
}

/* columns x, y made square to x, and x cross y */
static int of_axes(double x[3], double y[3], ambulo__rigid *a) {
  double z[3];
  if (!(ambulo__normalize(x) > 1e-12)) return 0;
  double along = ambulo__dot(x, y);
  for (int i = 0; i < 3; i++) y[i] -= along * x[i];
  if (!(ambulo__normalize(y) > 1e-12)) return 0;
  ambulo__cross(x, y, z);
  for (int i = 0; i < 3; i++) {
    a->r[i][0] = x[i];
    a->r[i][1] = y[i];
    a->r[i][2] = z[i];
  }
  return 1;
}

/* the smallest turn that takes z there */
static int of_z(double z[3], ambulo__rigid *a) {
  if (!(ambulo__normalize(z) > 1e-12)) return 0;
  double axis[3] = {-z[1], z[0], 0.0}, sine = ambulo__normalize(axis);
  if (sine < 1e-12) {
    axis[0] = 1.0;
    axis[1] = 0.0;
  }
  *a = ambulo__rigid_turn(axis, atan2(sine, z[2]));
  return 1;
}

static int read_rotation(const ambulo__mjcf *m, const ambulo__xml_node *node, const char *around,
                         ambulo__rigid *a) {
  double v[6];
  if (ambulo__mjcf_numbers(m, node, around, "quat", 4, 4, v))
    return ambulo__rotation_of_quaternion(v, a->r);
  if (ambulo__mjcf_numbers(m, node, around, "axisangle", 4, 4, v)) {
    if (!(ambulo__normalize(v) > 1e-12)) return 0;
    *a = ambulo__rigid_turn(v, v[3] * m->angle);
    return 1;
  }
  if (ambulo__mjcf_numbers(m, node, around, "xyaxes", 6, 6, v)) return of_axes(v, v + 3, a);
  if (ambulo__mjcf_numbers(m, node, around, "zaxis", 3, 3, v)) return of_z(v, a);
  if (ambulo__mjcf_numbers(m, node, around, "euler", 3, 3, v)) of_euler(m, v, a);
  return 1;
}

ambulo__rigid ambulo__mjcf_place(const ambulo__mjcf *m, const ambulo__xml_node *node,
                                 const char *around) {
  ambulo__rigid a = ambulo__rigid_identity();
  double p[3] = {0, 0, 0};
  if (!read_rotation(m, node, around, &a))
    ambulo__xml_error(m->xml, node, AMBULO_E_MODEL, NULL,
                      "the orientation of <%s> has no direction (got zeros); expected a rotation",
                      node->name);
  (void)ambulo__mjcf_numbers(m, node, around, "pos", 3, 3, p);
  memcpy(a.p, p, sizeof a.p);
  return a;
}
