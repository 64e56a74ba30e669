/* definitions/model_contacts.c - `points`, `feet`, `patches` and `capsules` of a model file. */
#include "definitions/model_reader.h"

void ambulo__read_points(ambulo__reader *reader, const ambulo__yaml_node *list) {
  for (int i = 0; i < reader->definition.point_count; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(list, i);
    ambulo_point *point = &reader->points[i];
    const char *name = ambulo__yaml_name(ambulo__yaml_require(item, "name"));
    point->name = reader->point_names[i] = name;
    reader->point_places[i] = ambulo__yaml_place(item);
    point->link = ambulo__read_reference(ambulo__yaml_require(item, "link"), "link",
                                         reader->link_names, reader->definition.link_count);
    (void)ambulo__read_vector(reader, ambulo__yaml_require(item, "position"), 3, reader->length,
                              point->position);
    ambulo__yaml_close(item);
  }
}

static int point_at(const ambulo__reader *reader, const ambulo__yaml_node *node) {
  return ambulo__read_reference(node, "point", reader->point_names, reader->definition.point_count);
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

void ambulo__read_feet(ambulo__reader *reader, const ambulo__yaml_node *list) {
  for (int i = 0; i < reader->definition.foot_count; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(list, i);
    ambulo_foot *foot = &reader->feet[i];
    const char *name = ambulo__yaml_name(ambulo__yaml_require(item, "name"));
    foot->name = reader->foot_names[i] = name;
    reader->foot_places[i] = ambulo__yaml_place(item);
    read_corners(reader, ambulo__yaml_require(item, "heel"), foot->heel);
    read_corners(reader, ambulo__yaml_require(item, "toe"), foot->toe);
    foot->heel_center = read_center(reader, item, "heel_center", foot->heel);
    foot->toe_center = read_center(reader, item, "toe_center", foot->toe);
    const ambulo__yaml_node *tip = ambulo__yaml_get(item, "tip");
    foot->has_tip = tip != NULL;
    foot->tip = tip ? point_at(reader, tip) : -1;
    read_arcs(reader, ambulo__yaml_get(item, "arcs"), foot);
    ambulo__yaml_expect(item, "mirror");
    ambulo__yaml_close(item);
  }
  for (int i = 0; i < reader->definition.foot_count; i++) {
    reader->feet[i].mirror =
        ambulo__read_reference(ambulo__yaml_get(ambulo__yaml_item(list, i), "mirror"), "foot",
                               reader->foot_names, reader->definition.foot_count);
  }
}

void ambulo__read_patches(ambulo__reader *reader, const ambulo__yaml_node *list) {
  for (int i = 0; i < reader->definition.patch_count; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(list, i);
    ambulo_patch *patch = &reader->patches[i];
    const char *name = ambulo__yaml_name(ambulo__yaml_require(item, "name"));
    patch->name = reader->patch_names[i] = name;
    reader->patch_places[i] = ambulo__yaml_place(item);
    patch->point = point_at(reader, ambulo__yaml_require(item, "point"));
    (void)ambulo__read_vector(reader, ambulo__yaml_require(item, "size"), 2, reader->length,
                              patch->size);
    ambulo__yaml_expect(item, "mirror");
    ambulo__yaml_close(item);
  }
  for (int i = 0; i < reader->definition.patch_count; i++) {
    reader->patches[i].mirror =
        ambulo__read_reference(ambulo__yaml_get(ambulo__yaml_item(list, i), "mirror"), "patch",
                               reader->patch_names, reader->definition.patch_count);
  }
}

void ambulo__read_capsules(ambulo__reader *reader, const ambulo__yaml_node *list) {
  for (int i = 0; i < reader->definition.capsule_count; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(list, i);
    ambulo_capsule *capsule = &reader->capsules[i];
    const char *name = ambulo__yaml_name(ambulo__yaml_require(item, "name"));
    capsule->name = reader->capsule_names[i] = name;
    reader->capsule_places[i] = ambulo__yaml_place(item);
    capsule->link = ambulo__read_reference(ambulo__yaml_require(item, "link"), "link",
                                           reader->link_names, reader->definition.link_count);
    (void)ambulo__read_vector(reader, ambulo__yaml_require(item, "from"), 3, reader->length,
                              capsule->from);
    (void)ambulo__read_vector(reader, ambulo__yaml_require(item, "to"), 3, reader->length,
                              capsule->to);
    capsule->radius =
        ambulo__read_scaled(reader, ambulo__yaml_require(item, "radius"), reader->length, 0.0);
    ambulo__yaml_expect(item, "mirror");
    ambulo__yaml_close(item);
  }
  for (int i = 0; i < reader->definition.capsule_count; i++) {
    reader->capsules[i].mirror =
        ambulo__read_reference(ambulo__yaml_get(ambulo__yaml_item(list, i), "mirror"), "capsule",
                               reader->capsule_names, reader->definition.capsule_count);
  }
}
