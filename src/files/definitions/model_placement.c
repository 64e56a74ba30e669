/* definitions/model_placement.c - `origin` and `axis` of a link, in place of `dh`.
 *
 * Links are read as they stand in the file, one each. Those with an origin then become the DH rows
 * of model/placement.h: the last row has the link's name, its frame, its body and its points, the
 * rows before it the names NAME.place, NAME.turn and NAME.joint. A coordinate keeps its name.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "model/placement.h"
#include "definitions/model_reader.h"

struct ambulo__origin {
  int given; /* origin or axis in place of dh */
  int first; /* of its rows, once expanded; the last is the one before the next link's first */
  int joint; /* row that moves, -1: fixed */
  ambulo__placement placement;
};

/* ------------------------------------------------------------------- reading */

static void read_axis(ambulo__reader *reader, const ambulo__yaml_node *node,
                      const ambulo_link *link, ambulo__placement *placement) {
  double *axis = placement->axis;
  if (!ambulo__read_vector(reader, node, 3, 1.0, axis)) return;
  double size = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  if (link->type == AMBULO_FIXED) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL, "link '%s' is fixed; expected no axis",
                             link->name);
  } else if (!(size > 1e-9) || !(size < 1e9)) {
    (void)ambulo__yaml_error(node, AMBULO_E_MODEL, NULL,
                             "the axis of link '%s' has no direction (got [%s, %s, %s]); expected "
                             "a vector such as [0, 0, 1]",
                             link->name, ambulo__number_text(axis[0]).text,
                             ambulo__number_text(axis[1]).text, ambulo__number_text(axis[2]).text);
  } else {
    for (int i = 0; i < 3; i++) axis[i] /= size;
  }
}

static void read_rotation(ambulo__reader *reader, const ambulo__yaml_node *node,
                          ambulo__placement *placement) {
  double rpy[3] = {0.0, 0.0, 0.0};
  const ambulo__yaml_node *list = ambulo__by_sex(reader, node);
  if (!node || !list) return;
  if (!ambulo__yaml_is(list, AMBULO__YAML_SEQUENCE) || ambulo__yaml_items(list) != 3) {
    (void)ambulo__yaml_numbers(list, 3, rpy); /* says what is wrong */
    return;
  }
  for (int i = 0; i < 3; i++)
    rpy[i] = ambulo__read_angle(reader, ambulo__yaml_item(list, i), reader->dh_angle);
  ambulo__rotation_of_rpy(rpy, placement->rotation);
}

int ambulo__read_origin(ambulo__reader *reader, const ambulo__yaml_node *item, int index) {
  const ambulo__yaml_node *dh = ambulo__yaml_get(item, "dh");
  const ambulo__yaml_node *origin = ambulo__yaml_get(item, "origin");
  const ambulo__yaml_node *axis = ambulo__yaml_get(item, "axis");
  const ambulo_link *link = &reader->links[index];
  ambulo__origin *o = &reader->origins[index];
  const double none[3] = {0.0, 0.0, 0.0};
  if (!origin && !axis) return 0;
  if (dh) {
    (void)ambulo__yaml_error(origin ? origin : axis, AMBULO_E_SCHEMA, NULL,
                             "link '%s' has `dh` and `%s`; expected one of `dh` and `origin`",
                             link->name, origin ? "origin" : "axis");
    return 1;
  }
  o->given = 1;
  ambulo__rotation_of_rpy(none, o->placement.rotation);
  if (origin) {
    const ambulo__yaml_node *xyz = ambulo__yaml_get(origin, "xyz");
    const ambulo__yaml_node *rpy = ambulo__yaml_get(origin, "rpy");
    if (xyz) (void)ambulo__read_vector(reader, xyz, 3, reader->length, o->placement.xyz);
    read_rotation(reader, rpy, &o->placement);
    ambulo__yaml_close(origin);
  }
  o->placement.axis[2] = 1.0;
  if (axis) read_axis(reader, axis, link, &o->placement);
  if (!axis && link->type != AMBULO_FIXED) {
    (void)ambulo__yaml_error(item, AMBULO_E_SCHEMA, NULL,
                             "joint '%s' has an origin but no axis; expected `axis`, the direction "
                             "in the link's frame that it moves about or along",
                             link->name);
  }
  return 1;
}

/* ----------------------------------------------------------------- expanding */

enum { TEXT = AMBULO__MAX_NAME + 1 };

/* NAME.place, NAME.turn, NAME.joint; by number where the name leaves no room for that */
static void name_row(char *text, const char *name, int link, const char *part) {
  if (snprintf(text, TEXT, "%s.%s", name, part) >= TEXT)
    (void)snprintf(text, TEXT, "link%d.%s", link + 1, part);
}

/* The row that moves has the function of a coupled joint, the others have none. */
static void move_function(ambulo_link *row, const ambulo_link *link, int moves) {
  const ambulo_link none = ambulo_link_default(), *from = moves ? link : &none;
  row->coupled_to = from->coupled_to;
  row->knots = from->knots;
  row->knot_count = from->knot_count;
  memcpy(row->polynomial, from->polynomial, sizeof row->polynomial);
}

/* Appends the rows of file link i; returns how many. Bodies go with the last. */
static int append_rows(ambulo__reader *reader, int i, ambulo_link *links, char *texts) {
  const ambulo_link *link = &reader->links[i];
  ambulo__origin *o = &reader->origins[i];
  ambulo_link row[AMBULO__MOST_ROWS];
  int count = ambulo__placement_rows(&o->placement, link->type, row, &o->joint);
  for (int k = 0; k < count; k++) {
    ambulo_link *target = &links[o->first + k];
    const char *part = k == o->joint                        ? "joint"
                       : row[k].a != 0.0 || row[k].d != 0.0 ? "place"
                                                            : "turn";
    *target = k == count - 1 ? *link : ambulo_link_default();
    target->type = row[k].type;
    move_function(target, link, k == o->joint);
    target->theta = row[k].theta;
    target->d = row[k].d;
    target->a = row[k].a;
    target->alpha = row[k].alpha;
    target->parent = o->first + k - 1; /* the first: later */
    if (k == count - 1) continue;
    name_row(texts + (size_t)(o->first + k) * TEXT, link->name, i, part);
    target->name = texts + (size_t)(o->first + k) * TEXT;
  }
  return count;
}

/* last row of link `i` of the file */
static int row_of(const ambulo__reader *reader, int i) {
  return i < 0 ? i : reader->origins[i + 1].first - 1;
}

static void expand(ambulo__reader *reader, ambulo_link *links, ambulo__place *places, char *texts) {
  int count = reader->definition.link_count, rows = 0;
  for (int i = 0; i < count; i++) {
    ambulo__origin *o = &reader->origins[i];
    int own = 1;
    o->first = rows;
    o->joint = -1;
    if (o->given)
      own = append_rows(reader, i, links, texts);
    else
      links[rows] = reader->links[i];
    for (int k = 0; k < own; k++) places[rows + k] = reader->place_of[AMBULO__LIST_LINKS][i];
    rows += own;
    if (o->joint >= 0) o->joint += o->first;
  }
  reader->origins[count].first = rows;
  for (int i = 0; i < count; i++)
    links[reader->origins[i].first].parent = row_of(reader, reader->links[i].parent);
  for (int i = 0; i < reader->definition.point_count; i++)
    reader->points[i].link = row_of(reader, reader->points[i].link);
  for (int i = 0; i < reader->definition.capsule_count; i++)
    reader->capsules[i].link = row_of(reader, reader->capsules[i].link);
  reader->definition.links = links;
  reader->definition.link_count = rows;
  reader->places.links = places;
}

void ambulo__expand_origins(ambulo__reader *reader) {
  const ambulo_allocator *a = &reader->allocator;
  size_t count = (size_t)reader->definition.link_count, most = count * AMBULO__MOST_ROWS;
  int given = 0;
  for (size_t i = 0; i < count; i++) given |= reader->origins[i].given;
  /* a file with faults has links without parents */
  if (!given || reader->status || ambulo__yaml_finish(reader->document)) return;
  reader->rows = ambulo__alloc(a, most, sizeof *reader->rows);
  reader->row_places = ambulo__alloc(a, most, sizeof *reader->row_places);
  reader->row_names = ambulo__alloc(a, most, TEXT);
  if (!reader->rows || !reader->row_places || !reader->row_names) {
    reader->status = AMBULO_E_MEMORY;
    return;
  }
  expand(reader, reader->rows, reader->row_places, reader->row_names);
}

ambulo__origin *ambulo__origins_create(const ambulo_allocator *allocator, int links) {
  return ambulo__alloc(allocator, (size_t)links + 1, sizeof(ambulo__origin));
}

void ambulo__name_written(const ambulo__reader *reader, ambulo_model *model) {
  if (!reader->rows) return;
  for (int c = 0; c < model->coordinate_count; c++) {
    const char *joint = model->links[model->coordinate_link[c]].name;
    for (int i = 0; reader->origins[i].first < reader->definition.link_count; i++) {
      int row = reader->origins[i].joint;
      if (row < 0 || strcmp(reader->rows[row].name, joint) != 0) continue;
      model->coordinate_written[c] =
          ambulo_model_find_link(model, reader->rows[row_of(reader, i)].name);
    }
  }
}
