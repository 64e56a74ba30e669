/* definitions/problem_devices.c - `devices` of a problem file: springs, dampers, actuators.
 *
 * Numbers are in SI units, torques by angle in N m per rad; angles that a coordinate or a spring
 * has (rest, smoothing) in the file's unit. `mirror: true` adds the mirror image behind all others.
 */
#include "definitions/problem_reader.h"

#include "contact/devices.h"

#include <stdio.h>
#include <string.h>

enum { MOST_DEVICES = 200, MOST_POINTS = 1000 };
static const double most = 1e9;

static const char *const device_kinds[] = {"spring", "damper", "actuator"};

/* index of what a node names among names[count]; -1 after an error */
static int read_known(const ambulo__yaml_node *node, const char *what, const char *const *names,
                      int count) {
  const char *name = ambulo__yaml_name(node);
  char hint[100];
  if (!name[0]) return -1;
  for (int i = 0; i < count; i++)
    if (strcmp(name, names[i]) == 0) return i;
  const char *nearest = ambulo__nearest(name, names, (size_t)count);
  if (nearest) (void)snprintf(hint, sizeof hint, "did you mean '%s'?", nearest);
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, nearest ? hint : NULL,
                           "unknown %s (got '%s'); expected a %s of the model", what, name, what);
  return -1;
}

typedef const char *name_of(const ambulo_model *model, int index);

static const char *link_name(const ambulo_model *model, int index) {
  return ambulo_model_link(model, index)->name;
}
static const char *point_name(const ambulo_model *model, int index) {
  return ambulo_model_point(model, index)->name;
}
static const char *coordinate_name(const ambulo_model *model, int index) {
  return ambulo_model_coordinate(model, index)->name;
}
static const char *foot_name(const ambulo_model *model, int index) {
  return ambulo_model_foot(model, index)->name;
}

static int read_one_of(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                       const char *what, name_of *name, int count) {
  const char **names = ambulo__reader_alloc(reader, (size_t)count, sizeof *names);
  for (int i = 0; names && i < count; i++) names[i] = name(reader->model, i);
  return names ? read_known(node, what, names, count) : -1;
}

/* ------------------------------------------------------------------- place */

/* {point: heel_r}, or {link: foot_r, position: [x, y, z]} */
static int read_end(ambulo__problem_reader *reader, const ambulo__yaml_node *node, int end,
                    ambulo_device *device) {
  const ambulo_model *model = reader->model;
  const ambulo__yaml_node *point = ambulo__yaml_get(node, "point");
  int placed = 1;
  if (point) {
    int index = read_one_of(reader, point, "point", point_name, ambulo_model_point_count(model));
    const ambulo_point *of = ambulo_model_point(model, index);
    if (of) memcpy(device->position[end], of->position, sizeof of->position);
    device->link[end] = of ? of->link : -1;
  } else {
    device->link[end] = read_one_of(reader, ambulo__yaml_require(node, "link"), "link", link_name,
                                    ambulo_model_link_count(model));
    placed = ambulo__yaml_numbers(ambulo__yaml_require(node, "position"), 3, device->position[end]);
  }
  ambulo__yaml_close(node);
  return device->link[end] >= 0 && placed;
}

/* 0: it has no place, which was said */
static int read_site(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                     ambulo_device *device) {
  const ambulo__yaml_node *coordinate = ambulo__yaml_get(node, "coordinate");
  const ambulo__yaml_node *between = ambulo__yaml_get(node, "between");
  if (!coordinate == !between) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "a device with %s of 'coordinate' and 'between'; expected one of them",
                             coordinate ? "both" : "none");
    return 0;
  }
  if (coordinate) {
    device->coordinate = read_one_of(reader, coordinate, "coordinate", coordinate_name,
                                     ambulo_model_coordinate_count(reader->model));
    return device->coordinate >= 0;
  }
  if (ambulo__yaml_items(between) != 2) {
    (void)ambulo__yaml_error(between, AMBULO_E_SCHEMA, NULL,
                             "'between' is not a list of two places, each {link, position} or "
                             "{point}");
    return 0;
  }
  int first = read_end(reader, ambulo__yaml_item(between, 0), 0, device);
  return read_end(reader, ambulo__yaml_item(between, 1), 1, device) && first;
}

/* --------------------------------------------------------------------- law */

/* along the coordinate that the device acts at: the file's unit of angle where it turns */
static double read_along(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                         const ambulo_device *device, double fallback) {
  if (!node) return fallback;
  if (ambulo__device_turns(reader->model, device))
    return ambulo__read_plain_angle(reader, node, fallback);
  return ambulo__yaml_number(node, fallback);
}

static void read_spring(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                        ambulo_device *device) {
  static const char *const sides[] = {"both", "above", "below"};
  device->stiffness =
      ambulo__yaml_number_in(ambulo__yaml_require(node, "stiffness"), 0.0, most, 1.0);
  device->rest = read_along(reader, ambulo__yaml_require(node, "rest"), device, 0.0);
  device->pretension = ambulo__yaml_number(ambulo__yaml_get(node, "pretension"), 0.0);
  int side = ambulo__yaml_choice(ambulo__yaml_get(node, "side"), sides, 3, 0);
  device->side = (ambulo_device_side)(AMBULO_DEVICE_BOTH + side);
  device->smoothing =
      read_along(reader, ambulo__yaml_get(node, "smoothing"), device, device->smoothing);
}

static void read_points(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                        ambulo_device *device) {
  static const char *const clocks[] = {"time", "stride"};
  const ambulo__yaml_node *list = ambulo__yaml_get(node, "points");
  const ambulo__yaml_node *by = ambulo__yaml_get(node, "by");
  int given = list ? ambulo__yaml_items(list) : 0;
  if (!list && !by) return;
  if (!list || given < 1 || given > MOST_POINTS) {
    (void)ambulo__yaml_error(
        list ? list : by, AMBULO_E_SCHEMA, NULL,
        "%d points; expected 1 to %d, each [time or share of the stride, value]", given,
        MOST_POINTS);
    return;
  }
  device->clock = ambulo__yaml_choice(ambulo__yaml_require(node, "by"), clocks, 2, 0)
                      ? AMBULO_DEVICE_BY_STRIDE
                      : AMBULO_DEVICE_BY_TIME;
  double(*points)[2] = ambulo__reader_alloc(reader, (size_t)given, sizeof *points);
  for (int i = 0; points && i < given; i++)
    (void)ambulo__yaml_numbers(ambulo__yaml_item(list, i), 2, points[i]);
  device->points = (const double(*)[2])points;
  device->point_count = given;
  int closed = points && given > 1 && device->clock == AMBULO_DEVICE_BY_STRIDE &&
               points[given - 1][0] == points[0][0] + 1.0;
  if (!closed) return;
  device->point_count--; /* the stride begins anew with the same value */
  if (points[given - 1][1] == points[0][1]) return;
  (void)ambulo__yaml_error(ambulo__yaml_item(list, given - 1), AMBULO_E_PROBLEM, NULL,
                           "%g at the end of the stride and %g at its begin; expected the same",
                           points[given - 1][1], points[0][1]);
}

static void read_clutch(const ambulo__yaml_node *node, ambulo_device *device) {
  const ambulo__yaml_node *engaged = ambulo__yaml_get(node, "engaged");
  if (!engaged) return;
  device->clutch = 1;
  device->from = ambulo__yaml_number_in(ambulo__yaml_require(engaged, "from"), 0.0, 1.0, 0.0);
  device->to = ambulo__yaml_number_in(ambulo__yaml_require(engaged, "to"), 0.0, 1.0, 0.5);
  device->ramp = ambulo__yaml_number_in(ambulo__yaml_get(engaged, "ramp"), 1e-6, 0.5, device->ramp);
  ambulo__yaml_close(engaged);
}

/* the foot whose strike begins the stride */
static void read_foot(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                      ambulo_device *device) {
  const ambulo__yaml_node *foot = ambulo__yaml_get(node, "foot");
  if (!device->clutch && device->clock != AMBULO_DEVICE_BY_STRIDE && !foot) return;
  device->foot = read_one_of(reader, foot ? foot : ambulo__yaml_require(node, "foot"), "foot",
                             foot_name, ambulo_model_foot_count(reader->model));
  if (device->foot < 0) device->foot = 0; /* that was said */
}

static void read_law(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                     ambulo_device *device) {
  switch (device->kind) {
  case AMBULO_DEVICE_SPRING:
    read_spring(reader, node, device);
    break;
  case AMBULO_DEVICE_DAMPER:
    device->damping = ambulo__yaml_number_in(ambulo__yaml_require(node, "damping"), 0.0, most, 0.0);
    break;
  case AMBULO_DEVICE_ACTUATOR:
    device->amount = ambulo__yaml_number_in(ambulo__yaml_get(node, "amount"), -most, most, 1.0);
    read_points(reader, node, device);
    break;
  case AMBULO_DEVICE_KIND_NOT_SET:
    break;
  }
  read_clutch(node, device);
  read_foot(reader, node, device);
}

/* ------------------------------------------------------------------ mirror */

/* "spring_r" and "spring_l", "left_spring" and "right_spring"; else "spring_mirror" */
static const char *mirrored_name(ambulo__problem_reader *reader, const char *name) {
  size_t length = strlen(name);
  char *image = ambulo__reader_alloc(reader, length + 8, 1);
  if (!image) return NULL;
  memcpy(image, name, length + 1);
  if (length > 2 && image[length - 2] == '_' && image[length - 1] == 'r') {
    image[length - 1] = 'l';
  } else if (length > 2 && image[length - 2] == '_' && image[length - 1] == 'l') {
    image[length - 1] = 'r';
  } else {
    memcpy(image + length, "_mirror", 8);
  }
  return image;
}

/* one item; 0 after an error */
static int read_device(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                       ambulo_device *device, int *mirrored) {
  const ambulo__yaml_node *kind = ambulo__yaml_require(node, "kind");
  const char *name = ambulo__yaml_name(ambulo__yaml_require(node, "name"));
  int index = kind ? ambulo__yaml_choice(kind, device_kinds, 3, -1) : -1;
  *mirrored = ambulo__yaml_boolean(ambulo__yaml_get(node, "mirror"), 0);
  if (index < 0) return 0;
  *device = ambulo_device_default((ambulo_device_kind)(AMBULO_DEVICE_SPRING + index));
  device->name = name;
  int placed = read_site(reader, node, device);
  read_law(reader, node, device);
  ambulo__yaml_close(node);
  return placed && name[0];
}

void ambulo__read_devices(ambulo__problem_reader *reader, const ambulo__yaml_node *list) {
  int given = list ? ambulo__yaml_items(list) : 0, count = 0, images = 0;
  if (!list) return;
  if (given < 1 || given > MOST_DEVICES) {
    if (ambulo__yaml_is(list, AMBULO__YAML_SEQUENCE))
      (void)ambulo__yaml_error(list, AMBULO_E_SCHEMA, NULL, "%d devices; expected 1 to %d", given,
                               MOST_DEVICES);
    return;
  }
  ambulo_device *devices = ambulo__reader_alloc(reader, 2 * (size_t)given, sizeof *devices);
  ambulo_device *image = ambulo__reader_alloc(reader, (size_t)given, sizeof *image);
  for (int i = 0; devices && image && i < given; i++) {
    int mirrored;
    ambulo_device *device = &devices[count];
    if (!read_device(reader, ambulo__yaml_item(list, i), device, &mirrored)) continue;
    count++;
    if (!mirrored) continue;
    image[images] = ambulo__device_mirrored(reader->model, device);
    image[images].image_of = count - 1;
    image[images++].name = mirrored_name(reader, device->name);
  }
  for (int i = 0; i < images; i++) devices[count++] = image[i];
  reader->definition.devices = devices;
  reader->definition.device_count = count;
}
