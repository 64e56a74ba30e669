/* import/mjcf_geoms.c - attributes with their defaults, and placements (mjcf.h).
 *
 * Default classes are nested <default class=...>; an element takes what it does not say from the
 * class it names, else from the childclass around it, else from the top one, and what that does not
 * say from the class around that. Rotations are one of a quaternion (w, x, y, z), an axis with an
 * angle, three turns in the compiler's order (small letters: about turned axes, capitals: about
 * fixed ones), the x and y axes, or the z axis with the smallest turn that takes it there.
 */
#include "base/arithmetic.h"
#include "import/mjcf.h"

#include <math.h>
#include <string.h>

const char *ambulo__mjcf_text(const ambulo__mjcf *m, const ambulo__xml_node *node,
                              const char *around, const char *attribute) {
  const char *text = ambulo__xml_attribute(node, attribute);
  const char *name = ambulo__xml_attribute(node, "class");
  if (text) return text;
  return ambulo__mjcf_default(m, name ? name : around, node->name, attribute);
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

/* mass, inertia and shape of MuJoCo's geoms (mjcf.h).
 *
 * Homogeneous solids of mass m; r radius, h half of the cylinder's length along z:
 *
 *   sphere     I = 2/5 m r^2
 *   capsule    cylinder and ball of m_c : m_b = 2 h : 4/3 r,
 *              Izz = m_c r^2/2 + 2/5 m_b r^2,
 *              Ixx = m_c (r^2/4 + h^2/3) + m_b (2/5 r^2 + h^2 + 3/4 r h)
 *   cylinder   Izz = m r^2/2,  Ixx = m (r^2/4 + h^2/3)
 *   ellipsoid  Ixx = m (b^2 + c^2)/5
 *   box        Ixx = m (b^2 + c^2)/3
 */

enum { PLANE, SPHERE, CAPSULE, ELLIPSOID, CYLINDER, BOX, MESH, HFIELD, SDF, TYPES };
enum { LAST_SHOWN = 2 }; /* groups of geoms that MuJoCo shows unasked: 0 to 2 */

static const double pi = 3.14159265358979323846;

/* volume, and the moments of a solid of mass 1 */
static double moments(ambulo__shape shape, const double s[3], double inertia[3]) {
  double r = s[0], h = s[1], flat = 0.25 * r * r + h * h / 3.0;
  double cylinder = 2.0 * pi * r * r * h, ball = 4.0 / 3.0 * pi * r * r * r;
  if (shape == AMBULO__SPHERE) {
    for (int i = 0; i < 3; i++) inertia[i] = 0.4 * r * r;
    return ball;
  }
  if (shape == AMBULO__CYLINDER) {
    inertia[0] = inertia[1] = flat;
    inertia[2] = 0.5 * r * r;
    return cylinder;
  }
  if (shape == AMBULO__CAPSULE) {
    double c = cylinder / (cylinder + ball), b = 1.0 - c;
    inertia[0] = inertia[1] = c * flat + b * (0.4 * r * r + h * h + 0.75 * r * h);
    inertia[2] = c * 0.5 * r * r + b * 0.4 * r * r;
    return cylinder + ball;
  }
  double part = shape == AMBULO__BOX ? 1.0 / 3.0 : 0.2;
  for (int i = 0; i < 3; i++) {
    double u = s[(i + 1) % 3], v = s[(i + 2) % 3];
    inertia[i] = part * (u * u + v * v);
  }
  return (shape == AMBULO__BOX ? 8.0 : 4.0 / 3.0 * pi) * s[0] * s[1] * s[2];
}

/* fromto: along z between two points, whose distance is the length */
static void stretch(const double ends[6], int length_at, ambulo__rigid *at, double size[3]) {
  double axis[3], turned[3] = {0, 0, 1};
  for (int i = 0; i < 3; i++) {
    axis[i] = ends[i] - ends[3 + i]; /* MuJoCo's z points from the second to the first */
    at->p[i] = 0.5 * (ends[i] + ends[3 + i]);
  }
  size[length_at] = 0.5 * ambulo__normalize(axis);
  double turn[3];
  ambulo__cross(turned, axis, turn);
  double sine = ambulo__normalize(turn);
  if (!(sine > 1e-14)) {
    turn[0] = 1.0;
    turn[1] = turn[2] = 0.0;
    sine = 0.0;
  }
  ambulo__rigid rotation = ambulo__rigid_turn(turn, atan2(sine, axis[2]));
  memcpy(at->r, rotation.r, sizeof at->r);
}

/* how many sizes a type needs: fewer with fromto, which gives the length */
static int needed(int type, int stretched) {
  static const int sizes[TYPES] = {0, 1, 2, 3, 2, 3, 0, 0, 0};
  return stretched && type != SPHERE ? 1 : sizes[type];
}

/* of the file of <asset><mesh> */
static void read_mesh(ambulo__mjcf *m, const char *name, ambulo__tree_solid *solid) {
  const ambulo__xml_node *mesh = name ? ambulo__mjcf_mesh(m, name) : NULL;
  if (!mesh) return;
  const char *file = ambulo__mjcf_text(m, mesh, NULL, "file");
  if (m->mesh_folder) file = ambulo__arena_print(m->tree->arena, "%s/%s", m->mesh_folder, file);
  ambulo__tree_mesh(m->tree, file, solid);
  (void)ambulo__mjcf_numbers(m, mesh, NULL, "scale", 3, 3, solid->scale);
}

static int read_shape(ambulo__mjcf *m, const ambulo__xml_node *geom, const char *around, int type,
                      ambulo__tree_solid *solid) {
  static const ambulo__shape shapes[TYPES] = {AMBULO__MESH,      AMBULO__SPHERE,   AMBULO__CAPSULE,
                                              AMBULO__ELLIPSOID, AMBULO__CYLINDER, AMBULO__BOX,
                                              AMBULO__MESH,      AMBULO__MESH,     AMBULO__MESH};
  double ends[6];
  solid->shape = shapes[type];
  if (solid->shape == AMBULO__MESH) {
    read_mesh(m, ambulo__mjcf_text(m, geom, around, "mesh"), solid);
    return 1;
  }
  int stretched = ambulo__mjcf_numbers(m, geom, around, "fromto", 6, 6, ends) == 6;
  int given = ambulo__mjcf_numbers(m, geom, around, "size", 1, 3, solid->size);
  if (given < needed(type, stretched)) {
    ambulo__xml_error(m->xml, geom, AMBULO_E_SCHEMA, NULL,
                      "size of <geom> has %d numbers; expected %d", given, needed(type, stretched));
    return 0;
  }
  if (stretched) {
    int wide = type == BOX || type == ELLIPSOID;
    if (wide) solid->size[1] = solid->size[0];
    stretch(ends, wide ? 2 : 1, &solid->at, solid->size);
  }
  for (int i = 0; i < needed(type, 0); i++) {
    if (solid->size[i] > 0.0) continue;
    ambulo__xml_error(m->xml, geom, AMBULO_E_MODEL, NULL,
                      "a size of <geom> is not positive; expected more than 0");
    return 0;
  }
  return 1;
}

static void add_mass(ambulo__mjcf *m, const ambulo__xml_node *geom, const char *around,
                     const ambulo__tree_solid *solid, ambulo__part *body) {
  double mass = 0.0, density = 1000.0, own[3] = {0}, inertia[6] = {0};
  int given = ambulo__mjcf_numbers(m, geom, around, "mass", 1, 1, &mass);
  (void)ambulo__mjcf_numbers(m, geom, around, "density", 1, 1, &density);
  if (solid->shape == AMBULO__MESH) {
    if ((given && mass == 0.0) || (!given && density == 0.0)) return;
    ambulo__xml_error(m->xml, geom, AMBULO_E_MODEL, "give the body an <inertial>",
                      "the mass of a body comes from a mesh, which is not read; expected "
                      "<inertial>, or geoms of simple shapes");
    return;
  }
  if (ambulo__mjcf_flag(m, geom, around, "shellinertia", 0) == 1)
    ambulo__xml_error(m->xml, geom, AMBULO_E_MODEL, "give the body an <inertial>",
                      "the mass of <geom> is in its surface (shellinertia); expected a solid");
  double volume = moments(solid->shape, solid->size, own);
  if (!given) mass = density * volume;
  if (mass == 0.0) return;
  for (int i = 0; i < 3; i++) inertia[i] = mass * own[i];
  ambulo__part part = {.mass = mass};
  memcpy(part.com, solid->at.p, sizeof part.com);
  ambulo__inertia_turn((const double(*)[3])solid->at.r, inertia, part.inertia);
  if (mass > 0.0)
    ambulo__part_add(body, &part);
  else
    ambulo__xml_error(m->xml, geom, AMBULO_E_MODEL, NULL,
                      "the mass of <geom> is negative; expected more than 0");
}

void ambulo__mjcf_geom(ambulo__mjcf *m, const ambulo__xml_node *geom, const char *around,
                       const ambulo__rigid *frame, int massive, ambulo__part *body,
                       ambulo__tree_solid *solid, int *has_solid) {
  static const char *const types[TYPES] = {"plane", "sphere", "capsule", "ellipsoid", "cylinder",
                                           "box",   "mesh",   "hfield",  "sdf"};
  const char *word = ambulo__mjcf_text(m, geom, around, "type");
  double number = 0.0, touches[2] = {1.0, 1.0};
  if (!word) word = ambulo__mjcf_text(m, geom, around, "mesh") ? "mesh" : "sphere";
  int type = ambulo__xml_choice(m->xml, geom, "type of geom", word, types, TYPES);
  *has_solid = 0;
  if (type < 0 || type == PLANE) return;
  solid->at = ambulo__mjcf_place(m, geom, around);
  if (!read_shape(m, geom, around, type, solid)) return;
  solid->at = ambulo__rigid_times(frame, &solid->at);
  (void)ambulo__mjcf_numbers(m, geom, around, "group", 1, 1, &number);
  if (massive && number >= m->groups[0] && number <= m->groups[1])
    add_mass(m, geom, around, solid, body);
  (void)ambulo__mjcf_numbers(m, geom, around, "contype", 1, 1, &touches[0]);
  (void)ambulo__mjcf_numbers(m, geom, around, "conaffinity", 1, 1, &touches[1]);
  solid->seen = touches[0] == 0.0 && touches[1] == 0.0;
  solid->hidden = number > LAST_SHOWN;
  *has_solid = 1;
}
