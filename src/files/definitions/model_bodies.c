/* definitions/model_bodies.c - `body` and `bodies` of a link. */
#include <math.h>

#include "definitions/model_reader.h"

/* gyration [x, y, z]: radii about the axes of the link through the centre of mass,
 * I_xx = m k_x^2 and so on, no products. */
static int read_inertia(ambulo__reader *reader, const ambulo__yaml_node *node,
                        const ambulo__yaml_node *inertia, const ambulo__yaml_node *gyration,
                        ambulo__part *part) {
  if ((inertia == NULL) == (gyration == NULL)) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, "a point mass has `gyration: [0, 0, 0]`",
                             "a body has %s; expected one of `inertia` and `gyration`",
                             inertia ? "both" : "no inertia");
    return 0;
  }
  if (inertia) {
    double unit = reader->mass * reader->length * reader->length;
    return ambulo__read_vector(reader, inertia, 6, unit, part->inertia);
  }
  double radius[3];
  if (!ambulo__read_vector(reader, gyration, 3, reader->length, radius)) return 0;
  for (int i = 0; i < 3; i++) part->inertia[i] = part->mass * radius[i] * radius[i];
  return 1;
}

static void read_part(ambulo__reader *reader, const ambulo__yaml_node *node, const char *owner,
                      ambulo__part *whole) {
  ambulo__part part = {0};
  const ambulo__yaml_node *name = ambulo__yaml_get(node, "name");
  const ambulo__yaml_node *mass = ambulo__yaml_require(node, "mass");
  const ambulo__yaml_node *com = ambulo__yaml_require(node, "com");
  const ambulo__yaml_node *inertia = ambulo__yaml_get(node, "inertia");
  const ambulo__yaml_node *gyration = ambulo__yaml_get(node, "gyration");
  const char *what = name ? ambulo__yaml_name(name) : owner;
  ambulo__yaml_close(node);
  if (!mass || !com) return;
  part.mass = ambulo__read_scaled(reader, mass, reader->mass, NAN);
  int good = ambulo__read_vector(reader, com, 3, reader->length, part.com);
  good &= read_inertia(reader, node, inertia, gyration, &part);
  if (!good || isnan(part.mass)) return; /* reported already */
  ambulo__body_places places = {ambulo__yaml_place(mass),
                                ambulo__yaml_place(inertia ? inertia : gyration)};
  ambulo_status status = ambulo__check_body(what[0] ? what : owner, part.mass, part.com,
                                            part.inertia, places, reader->diagnostics);
  if (status == AMBULO_OK) {
    ambulo__part_add(whole, &part);
  } else if (reader->status == AMBULO_OK) {
    reader->status = status;
  }
}

void ambulo__read_body(ambulo__reader *reader, const ambulo__yaml_node *link_node,
                       ambulo_link *link) {
  const ambulo__yaml_node *body = ambulo__yaml_get(link_node, "body");
  const ambulo__yaml_node *bodies = ambulo__yaml_get(link_node, "bodies");
  ambulo__part whole = {0};
  int count = 0;
  if (body && bodies) {
    (void)ambulo__yaml_error(bodies, AMBULO_E_SCHEMA, NULL,
                             "link '%s' has `body` and `bodies`; expected one of them", link->name);
    return;
  }
  if (body) read_part(reader, body, link->name, &whole);
  if (!ambulo__read_count(reader, bodies, "bodies", AMBULO__MAX_PARTS, &count)) return;
  for (int i = 0; i < count; i++) {
    read_part(reader, ambulo__yaml_item(bodies, i), link->name, &whole);
  }
  link->mass = whole.mass;
  for (int i = 0; i < 3; i++) link->com[i] = whole.com[i];
  for (int i = 0; i < 6; i++) link->inertia[i] = whole.inertia[i];
}
