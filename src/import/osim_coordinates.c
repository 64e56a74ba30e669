/* import/osim_coordinates.c - coordinates of OpenSim, and what holds, drives and touches
 * (osim.h).
 */
#include <math.h>
#include <string.h>

#include "base/numtext.h"
#include "import/osim.h"

/* the constraint that makes a coordinate follow another; NULL without */
static const ambulo__xml_node *coupler_of(const ambulo__osim *o, const char *coordinate) {
  for (const ambulo__xml_node *n = ambulo__osim_objects(o->model, "ConstraintSet"); n;
       n = n->next) {
    if (!ambulo__xml_is(n, "CoordinateCouplerConstraint")) continue;
    int off = ambulo__osim_flag(n, "isDisabled", 0) || !ambulo__osim_flag(n, "isEnforced", 1);
    if (!off && strcmp(ambulo__osim_text(n, "dependent_coordinate_name", NULL), coordinate) == 0)
      return n;
  }
  return NULL;
}

/* <Coordinate> of a name, anywhere below: joints stand in bodies (version 3) or in a set */
static const ambulo__xml_node *find_coordinate(const ambulo__xml_node *node, const char *name,
                                               int depth) {
  for (const ambulo__xml_node *n = node ? node->first : NULL; n; n = n->next) {
    if (ambulo__xml_is(n, "Coordinate") && strcmp(ambulo__xml_name(n), name) == 0) return n;
    const ambulo__xml_node *inner = depth > 0 ? find_coordinate(n, name, depth - 1) : NULL;
    if (inner) return inner;
  }
  return NULL;
}

static double default_of(ambulo__osim *o, const ambulo__xml_node *node, const char *name) {
  double value = 0.0;
  if (node) (void)ambulo__xml_child_vector(o->xml, node, "default_value", 1, 0, &value);
  return ambulo__tree_pose(o->tree, name, value);
}

static int is_held(const ambulo__osim *o, const ambulo__xml_node *node) {
  int held = ambulo__osim_flag(node, "locked", 0) || ambulo__osim_flag(node, "prescribed", 0);
  return held && !o->tree->options->unlock;
}

/* A dependent coordinate: a function of another; where that does not move, or the function is none
 * that a joint can have, it is held where the function says, and a note says so. */
static void follow(ambulo__osim *o, ambulo__osim_coordinate *c, const ambulo__xml_node *coupler) {
  const char *leader = ambulo__osim_text(coupler, "independent_coordinate_names", NULL);
  const ambulo__xml_node *holder = ambulo__xml_child(coupler, "coupled_coordinates_function");
  const ambulo__xml_node *function = holder ? holder->first : ambulo__osim_function(coupler);
  const ambulo__xml_node *leading = find_coordinate(o->model, leader, 9);
  ambulo__tree_function inner, scale = ambulo__tree_line(1.0, 0.0);
  double x = default_of(o, leading, leader);
  (void)ambulo__xml_child_vector(o->xml, coupler, "scale_factor", 1, 0, &scale.polynomial[1]);
  c->value = function ? scale.polynomial[1] * ambulo__osim_value(o, function, x) : 0.0;
  int moves = leading && !is_held(o, leading) && !coupler_of(o, leader);
  if (moves && function && ambulo__osim_read_function(o, function, &inner) &&
      ambulo__function_of_function(o->tree, &scale, &inner, &c->function)) {
    c->leader = leader;
    return;
  }
  double most =
      function ? ambulo__osim_travel(o, function, scale.polynomial[1], leading, x, c->value) : 0.0;
  c->held = 1;
  ambulo__tree_note(
      o->tree, c->node,
      "%s follows %s (%s): it is held at %s; by its %s it would move by up to %s (rad "
      "or m) over that coordinate's range",
      c->name, leader, ambulo__xml_name(coupler), ambulo__number_text(c->value).text,
      function ? function->name : "function", ambulo__three_digits(most).text);
}

static void read_coordinate(ambulo__osim *o, const ambulo__xml_node *node,
                            ambulo__osim_coordinate *c) {
  ambulo__tree *tree = o->tree;
  *c = (ambulo__osim_coordinate){.name = ambulo__xml_name(node), .node = node};
  c->value = default_of(o, node, c->name);
  const ambulo__xml_node *coupler = coupler_of(o, c->name);
  int locked = ambulo__osim_flag(node, "locked", 0);
  if (coupler) {
    follow(o, c, coupler);
  } else if (is_held(o, node)) {
    c->held = 1;
    ambulo__tree_note(tree, node, "%s is %s in the source: it is held at %s (--unlock: it moves)",
                      c->name, locked ? "locked" : "prescribed",
                      ambulo__number_text(c->value).text);
  }
}

int ambulo__osim_coordinates(ambulo__osim *o, const ambulo__osim_joint *joint, int most,
                             ambulo__osim_coordinate *list) {
  /* version 3: <CoordinateSet><objects>; version 4: <coordinates> */
  const ambulo__xml_node *first = ambulo__osim_objects(joint->node, "CoordinateSet");
  const ambulo__xml_node *holder = ambulo__xml_child(joint->node, "coordinates");
  int count = 0;
  if (!first && holder) first = holder->first;
  for (const ambulo__xml_node *n = first; n; n = n->next) {
    if (!ambulo__xml_is(n, "Coordinate")) continue;
    if (count == most) {
      ambulo__xml_error(o->xml, n, AMBULO_E_SCHEMA, NULL,
                        "joint '%.60s' has too many coordinates; expected at most %d", joint->name,
                        most);
      return -1;
    }
    read_coordinate(o, n, &list[count++]);
  }
  return count;
}

void ambulo__osim_limits(ambulo__osim *o, const ambulo__osim_coordinate *coordinate, double scale,
                         int link) {
  double range[2];
  if (link < 0 || !ambulo__xml_child_vector(o->xml, coordinate->node, "range", 2, 1, range)) return;
  ambulo__tree_range(o->tree, link, range, scale, coordinate->node);
}

/* --------------------------------------------------------------------------- forces */

static void read_actuator(ambulo__osim *o, const ambulo__xml_node *node) {
  const char *name = ambulo__osim_text(node, "coordinate", NULL);
  double force = 0.0, low = -INFINITY, high = INFINITY;
  int link = ambulo__tree_find_coordinate(o->tree, name);
  (void)ambulo__xml_child_vector(o->xml, node, "optimal_force", 1, 0, &force);
  (void)ambulo__xml_child_vector(o->xml, node, "min_control", 1, 1, &low);
  (void)ambulo__xml_child_vector(o->xml, node, "max_control", 1, 1, &high);
  if (link < 0 || !(fabs(force) > 0.0) || !(low <= high)) return;
  ambulo_coordinate *c = &o->tree->links[link].coordinate;
  c->torque[0] = force > 0.0 ? force * low : force * high;
  c->torque[1] = force > 0.0 ? force * high : force * low;
}

/* "80 Thelen2003Muscle, 3 BushingForce": each kind once, where it is first met */
static void note_kinds(ambulo__osim *o, const ambulo__xml_node *first, const char *what,
                       const char *known) {
  for (const ambulo__xml_node *n = first; n; n = n->next) {
    int count = 0, before = 0;
    for (const ambulo__xml_node *m = first; m; m = m->next) {
      if (!ambulo__xml_is(m, n->name)) continue;
      if (m == n) before = count;
      count++;
    }
    if (before == 0 && strcmp(n->name, known) != 0)
      ambulo__tree_note(o->tree, n, "%d %s (%s) %s left out", count, n->name, what,
                        count == 1 ? "is" : "are");
  }
}

enum { MOST_OBJECTS = 20000 }; /* of a set: kinds are compared in pairs */

static int is_short(ambulo__osim *o, const ambulo__xml_node *first) {
  int count = 0;
  for (const ambulo__xml_node *n = first; n; n = n->next) count++;
  if (count > MOST_OBJECTS)
    ambulo__xml_error(o->xml, first, AMBULO_E_LIMIT, NULL,
                      "a set has %d objects; expected at most %d", count, (int)MOST_OBJECTS);
  return count <= MOST_OBJECTS;
}

void ambulo__osim_forces(ambulo__osim *o) {
  const ambulo__xml_node *forces = ambulo__osim_objects(o->model, "ForceSet");
  const ambulo__xml_node *constraints = ambulo__osim_objects(o->model, "ConstraintSet");
  if (!is_short(o, forces) || !is_short(o, constraints)) return;
  for (const ambulo__xml_node *n = forces; n; n = n->next)
    if (ambulo__xml_is(n, "CoordinateActuator")) read_actuator(o, n);
  note_kinds(o, forces, "muscles and other forces", "CoordinateActuator");
  note_kinds(o, constraints, "constraints: loops that they close stay open",
             "CoordinateCouplerConstraint");
}

/* ------------------------------------------------------------------------- contacts */

void ambulo__osim_contacts(ambulo__osim *o) {
  for (const ambulo__xml_node *n = ambulo__osim_objects(o->model, "ContactGeometrySet"); n;
       n = n->next) {
    int sphere = ambulo__xml_is(n, "ContactSphere"), mesh = ambulo__xml_is(n, "ContactMesh");
    const char *frame = ambulo__osim_text(n, "socket_frame", "body_name");
    if (!frame[0]) frame = ambulo__osim_text(n, "socket_frame_connectee_name", NULL);
    if (!sphere && !mesh) continue;
    ambulo__rigid place;
    int body = ambulo__osim_frame(o, NULL, n, frame, &place);
    double at[3] = {0, 0, 0}, turn[3] = {0, 0, 0};
    (void)ambulo__xml_child_vector(o->xml, n, "location", 3, 0, at);
    (void)ambulo__xml_child_vector(o->xml, n, "orientation", 3, 0, turn);
    if (body <= 0 || o->bodies[body].link < 0) continue;
    ambulo__rigid shift = ambulo__rigid_of_xyz(at, turn);
    ambulo__tree_solid solid = {.link = o->bodies[body].link,
                                .shape = sphere ? AMBULO__SPHERE : AMBULO__MESH,
                                .at = ambulo__rigid_times(&place, &shift)};
    (void)ambulo__xml_child_vector(o->xml, n, "radius", 1, 0, solid.size);
    if (mesh) ambulo__tree_mesh(o->tree, ambulo__osim_text(n, "filename", NULL), &solid);
    ambulo__tree_add_solid(o->tree, &solid);
  }
}

/* ------------------------------------------------------------------------- markers */

void ambulo__osim_markers(ambulo__osim *o) {
  for (const ambulo__xml_node *n = ambulo__osim_objects(o->model, "MarkerSet"); n; n = n->next) {
    const char *frame = ambulo__osim_text(n, "socket_parent_frame", "body");
    if (!frame[0]) frame = ambulo__osim_text(n, "socket_parent_frame_connectee_name", "body_name");
    if (!ambulo__xml_is(n, "Marker") || !frame[0]) continue;
    const char *name = ambulo__xml_last_name(frame);
    for (int b = 1; b < o->body_count; b++) { /* frames with an offset of their own are left out */
      if (strcmp(o->bodies[b].name, name) != 0 || o->bodies[b].link < 0) continue;
      double at[3] = {0, 0, 0};
      if (ambulo__xml_child_vector(o->xml, n, "location", 3, 0, at))
        ambulo__tree_add_marker(o->tree, ambulo__xml_name(n), o->bodies[b].link, at);
    }
  }
}
