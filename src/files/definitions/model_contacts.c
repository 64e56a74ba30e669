/* definitions/model_contacts.c - `points`, `feet`, `patches` and `capsules` of a model file. */
#include "definitions/model_reader.h"

static int point_at(const ambulo__reader *reader, const ambulo__yaml_node *node) {
  return ambulo__read_reference(reader, node, AMBULO__LIST_POINTS);
}

static int link_of(const ambulo__reader *reader, const ambulo__yaml_node *item) {
  return ambulo__read_reference(reader, ambulo__yaml_require(item, "link"), AMBULO__LIST_LINKS);
}

/* a place in the link's frame */
static void read_place(ambulo__reader *reader, const ambulo__yaml_node *item, const char *key,
                       double place[3]) {
  (void)ambulo__read_vector(reader, ambulo__yaml_require(item, key), 3, reader->length, place);
}

/* Mirror images can be resolved once all items of a list have names. */
static int mirror_of(const ambulo__reader *reader, const ambulo__yaml_node *list, int index,
                     ambulo__model_list of) {
  const ambulo__yaml_node *mirror = ambulo__yaml_get(ambulo__yaml_item(list, index), "mirror");
  return ambulo__read_reference(reader, mirror, of);
}

void ambulo__read_points(ambulo__reader *reader, const ambulo__yaml_node *list) {
  for (int i = 0; i < reader->definition.point_count; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(list, i);
    ambulo_point *point = &reader->points[i];
    point->name = ambulo__read_item_name(reader, item, AMBULO__LIST_POINTS, i);
    point->link = link_of(reader, item);
    read_place(reader, item, "position", point->position);
    ambulo__yaml_close(item);
  }
}

/* One or two corners. */
static void read_corners(const ambulo__reader *reader, const ambulo__yaml_node *node,
                         int corners[2]) {
  corners[0] = corners[1] = -1;
  if (!node) return;
  int count = ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE) ? ambulo__yaml_items(node) : 0;
  if (count < 1 || count > 2) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "expected a list of one or two point names");
    return;
  }
  for (int k = 0; k < count; k++) corners[k] = point_at(reader, ambulo__yaml_item(node, k));
}

/* The centre may be left out where there is one corner only. */
static int read_center(const ambulo__reader *reader, const ambulo__yaml_node *item, const char *key,
                       const int corners[2]) {
  const ambulo__yaml_node *node =
      corners[1] < 0 ? ambulo__yaml_get(item, key) : ambulo__yaml_require(item, key);
  return node ? point_at(reader, node) : corners[0];
}

/* {heel: point, toe: point} */
static void read_arcs(const ambulo__reader *reader, const ambulo__yaml_node *node,
                      ambulo_foot *foot) {
  foot->has_arcs = node != NULL;
  foot->arc[0] = foot->arc[1] = -1;
  if (!node) return;
  foot->arc[0] = point_at(reader, ambulo__yaml_require(node, "heel"));
  foot->arc[1] = point_at(reader, ambulo__yaml_require(node, "toe"));
  ambulo__yaml_close(node);
}

static void read_sole(ambulo__reader *reader, const ambulo__yaml_node *item, ambulo_foot *foot) {
  read_corners(reader, ambulo__yaml_require(item, "heel"), foot->heel);
  read_corners(reader, ambulo__yaml_require(item, "toe"), foot->toe);
  foot->heel_center = read_center(reader, item, "heel_center", foot->heel);
  foot->toe_center = read_center(reader, item, "toe_center", foot->toe);
  const ambulo__yaml_node *tip = ambulo__yaml_get(item, "tip");
  foot->has_tip = tip != NULL;
  foot->tip = tip ? point_at(reader, tip) : -1;
  read_arcs(reader, ambulo__yaml_get(item, "arcs"), foot);
}

static void read_point_foot(ambulo__reader *reader, const ambulo__yaml_node *node,
                            ambulo_foot *foot) {
  int point = point_at(reader, node);
  foot->heel[0] = foot->toe[0] = foot->heel_center = foot->toe_center = point;
  foot->heel[1] = foot->toe[1] = foot->tip = foot->arc[0] = foot->arc[1] = -1;
  foot->has_tip = foot->has_arcs = 0;
}

void ambulo__read_feet(ambulo__reader *reader, const ambulo__yaml_node *list) {
  int count = reader->definition.foot_count;
  for (int i = 0; i < count; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(list, i);
    ambulo_foot *foot = &reader->feet[i];
    foot->name = ambulo__read_item_name(reader, item, AMBULO__LIST_FEET, i);
    const ambulo__yaml_node *point = ambulo__yaml_get(item, "point");
    if (point)
      read_point_foot(reader, point, foot);
    else
      read_sole(reader, item, foot);
    ambulo__yaml_expect(item, "mirror");
    ambulo__yaml_close(item);
  }
  for (int i = 0; i < count; i++)
    reader->feet[i].mirror = mirror_of(reader, list, i, AMBULO__LIST_FEET);
}

void ambulo__read_patches(ambulo__reader *reader, const ambulo__yaml_node *list) {
  int count = reader->definition.patch_count;
  for (int i = 0; i < count; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(list, i);
    ambulo_patch *patch = &reader->patches[i];
    patch->name = ambulo__read_item_name(reader, item, AMBULO__LIST_PATCHES, i);
    patch->point = point_at(reader, ambulo__yaml_require(item, "point"));
    (void)ambulo__read_vector(reader, ambulo__yaml_require(item, "size"), 2, reader->length,
                              patch->size);
    ambulo__yaml_expect(item, "mirror");
    ambulo__yaml_close(item);
  }
  for (int i = 0; i < count; i++)
    reader->patches[i].mirror = mirror_of(reader, list, i, AMBULO__LIST_PATCHES);
}

void ambulo__read_capsules(ambulo__reader *reader, const ambulo__yaml_node *list) {
  int count = reader->definition.capsule_count;
  for (int i = 0; i < count; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(list, i);
    ambulo_capsule *capsule = &reader->capsules[i];
    capsule->name = ambulo__read_item_name(reader, item, AMBULO__LIST_CAPSULES, i);
    capsule->link = link_of(reader, item);
    read_place(reader, item, "from", capsule->from);
    read_place(reader, item, "to", capsule->to);
    capsule->radius =
        ambulo__read_scaled(reader, ambulo__yaml_require(item, "radius"), reader->length, 0.0);
    ambulo__yaml_expect(item, "mirror");
    ambulo__yaml_close(item);
  }
  for (int i = 0; i < count; i++)
    reader->capsules[i].mirror = mirror_of(reader, list, i, AMBULO__LIST_CAPSULES);
}
