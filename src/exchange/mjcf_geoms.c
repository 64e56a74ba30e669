/* exchange/mjcf_geoms.c - mass, inertia and shape of MuJoCo's geoms (mjcf.h).
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
#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "exchange/mjcf.h"

enum { PLANE, SPHERE, CAPSULE, ELLIPSOID, CYLINDER, BOX, MESH, HFIELD, SDF, TYPES };

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

/* the file of <asset><mesh name=...>, whose name is by default that of the file */
static ambulo__mesh *mesh_of(ambulo__mjcf *m, const char *name) {
  const char *folder = NULL;
  for (const ambulo__xml_node *n = ambulo__xml_child(m->root, "compiler"); n;
       n = ambulo__xml_next(n, "compiler")) {
    if (ambulo__xml_attribute(n, "assetdir")) folder = ambulo__xml_attribute(n, "assetdir");
    if (ambulo__xml_attribute(n, "meshdir")) folder = ambulo__xml_attribute(n, "meshdir");
  }
  for (const ambulo__xml_node *set = ambulo__xml_child(m->root, "asset"); set && name;
       set = ambulo__xml_next(set, "asset")) {
    for (const ambulo__xml_node *n = ambulo__xml_child(set, "mesh"); n;
         n = ambulo__xml_next(n, "mesh")) {
      const char *file = ambulo__mjcf_text(m, n, NULL, "file");
      const char *own = ambulo__xml_attribute(n, "name");
      if (!file) continue;
      const char *slash = strrchr(file, '/'), *base = slash ? slash + 1 : file;
      const char *dot = strrchr(base, '.');
      size_t length = dot ? (size_t)(dot - base) : strlen(base);
      int same =
          own ? strcmp(own, name) == 0 : strncmp(base, name, length) == 0 && name[length] == '\0';
      if (!same) continue;
      ambulo__mesh *mesh = ambulo__mesh_named(
          m->tree->arena, m->tree->path,
          folder ? ambulo__arena_print(m->tree->arena, "%s/%s", folder, file) : file);
      if (mesh) (void)ambulo__mjcf_numbers(m, n, NULL, "scale", 3, 3, mesh->scale);
      return mesh;
    }
  }
  return NULL;
}

static int read_shape(ambulo__mjcf *m, const ambulo__xml_node *geom, const char *around, int type,
                      ambulo__tree_solid *solid) {
  static const ambulo__shape shapes[TYPES] = {AMBULO__MESH,      AMBULO__SPHERE,   AMBULO__CAPSULE,
                                              AMBULO__ELLIPSOID, AMBULO__CYLINDER, AMBULO__BOX,
                                              AMBULO__MESH,      AMBULO__MESH,     AMBULO__MESH};
  double ends[6];
  solid->shape = shapes[type];
  if (solid->shape == AMBULO__MESH) {
    solid->mesh = mesh_of(m, ambulo__mjcf_text(m, geom, around, "mesh"));
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
  *has_solid = touches[0] != 0.0 || touches[1] != 0.0;
}
