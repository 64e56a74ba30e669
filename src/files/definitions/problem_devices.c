/* definitions/problem_devices.c - `devices` of a problem file, and what hands hold: items of `load`
 * with `hands`.
 *
 * Numbers of devices are in SI units, torques by angle in N m per rad; angles that a coordinate or
 * a spring has (rest, smoothing) in the file's unit. `mirror: true` adds the mirror image behind
 * all others.
 */
#include "contact/devices.h"
#include "definitions/problem_reader.h"

#include <string.h>

enum { MOST_DEVICES = 200, MOST_POINTS = 1000 };
/* ------------------------------------------------------------------- place */

/* {point: heel_r}, or {link: foot_r, position: [x, y, z]} */
static void read_end(ambulo__problem_reader *reader, const ambulo__yaml_node *node, int end,
                     ambulo_device *device) {
  const ambulo__yaml_node *point = ambulo__yaml_get(node, "point");
  if (point) {
    int index = ambulo__read_name_of(reader, point, AMBULO__NAMED_POINT);
    const ambulo_point *of = ambulo_model_point(reader->model, index);
    if (of) memcpy(device->position[end], of->position, sizeof of->position);
    device->link[end] = of ? of->link : -1;
  } else {
    device->link[end] =
        ambulo__read_name_of(reader, ambulo__yaml_require(node, "link"), AMBULO__NAMED_LINK);
    (void)ambulo__yaml_numbers(ambulo__yaml_require(node, "position"), 3, device->position[end]);
  }
  ambulo__yaml_close(node);
}

static void read_site(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                      ambulo_device *device) {
  const ambulo__yaml_node *coordinate = ambulo__yaml_get(node, "coordinate");
  const ambulo__yaml_node *between = ambulo__yaml_get(node, "between");
  if (!coordinate == !between) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "a device with %s of 'coordinate' and 'between'; expected one of them",
                             coordinate ? "both" : "none");
    return;
  }
  if (coordinate) {
    device->coordinate = ambulo__read_name_of(reader, coordinate, AMBULO__NAMED_COORDINATE);
  } else if (ambulo__yaml_items(between) != 2) {
    (void)ambulo__yaml_error(between, AMBULO_E_SCHEMA, NULL,
                             "'between' is not a list of two places, each {link, position} or "
                             "{point}");
  } else {
    read_end(reader, ambulo__yaml_item(between, 0), 0, device);
    read_end(reader, ambulo__yaml_item(between, 1), 1, device);
  }
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

/* a member that is read for this kind alone */
static void read_own(ambulo__problem_reader *reader, const ambulo__yaml_node *value,
                     const char *key, ambulo_device *device) {
  ambulo__read_member(reader, value, &ambulo__device_members, key, device);
}

static void read_spring(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                        ambulo_device *device) {
  read_own(reader, ambulo__yaml_require(node, "stiffness"), "stiffness", device);
  device->rest = read_along(reader, ambulo__yaml_require(node, "rest"), device, 0.0);
  read_own(reader, ambulo__yaml_get(node, "pretension"), "pretension", device);
  read_own(reader, ambulo__yaml_get(node, "side"), "side", device);
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

static void read_clutch(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                        ambulo_device *device) {
  const ambulo__yaml_node *engaged = ambulo__yaml_get(node, "engaged");
  if (!engaged) return;
  device->clutch = 1;
  ambulo__read_members(reader, engaged, &ambulo__device_members, "engaged.", device);
  ambulo__yaml_close(engaged);
}

/* the foot whose strike begins the stride */
static void read_foot(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                      ambulo_device *device) {
  const ambulo__yaml_node *foot = ambulo__yaml_get(node, "foot");
  if (!device->clutch && device->clock != AMBULO_DEVICE_BY_STRIDE && !foot) return;
  device->foot = ambulo__read_name_of(reader, foot ? foot : ambulo__yaml_require(node, "foot"),
                                      AMBULO__NAMED_FOOT);
  if (device->foot < 0) device->foot = 0; /* that was said */
}

static void read_law(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                     ambulo_device *device) {
  switch (device->kind) {
  case AMBULO_DEVICE_SPRING:
    read_spring(reader, node, device);
    break;
  case AMBULO_DEVICE_DAMPER:
    read_own(reader, ambulo__yaml_require(node, "damping"), "damping", device);
    break;
  case AMBULO_DEVICE_ACTUATOR:
    read_own(reader, ambulo__yaml_get(node, "amount"), "amount", device);
    read_points(reader, node, device);
    break;
  case AMBULO_DEVICE_KIND_NOT_SET:
    break;
  }
  read_clutch(reader, node, device);
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

static void read_device(ambulo__problem_reader *reader, const ambulo__yaml_node *node, void *out) {
  ambulo_device *device = out;
  read_own(reader, ambulo__yaml_require(node, "kind"), "kind", device);
  device->name = ambulo__yaml_name(ambulo__yaml_require(node, "name"));
  ambulo__yaml_expect(node, "mirror");
  if (device->kind == AMBULO_DEVICE_KIND_NOT_SET) return; /* that was said */
  read_site(reader, node, device);
  if (device->coordinate >= 0) read_own(reader, ambulo__yaml_get(node, "alone"), "alone", device);
  read_law(reader, node, device);
  ambulo__yaml_close(node);
}

void ambulo__read_devices(ambulo__problem_reader *reader, const ambulo__yaml_node *list) {
  int count = 0, given;
  ambulo_device *read = ambulo__read_items(reader, list, &ambulo__device_members, 1, MOST_DEVICES,
                                           read_device, &given);
  ambulo_device *devices = ambulo__reader_alloc(reader, 2 * (size_t)given, sizeof *devices);
  for (; devices && count < given; count++) devices[count] = read[count];
  for (int i = 0; devices && i < given; i++) {
    const ambulo__yaml_node *mirror = ambulo__yaml_get(ambulo__yaml_item(list, i), "mirror");
    int placed = devices[i].coordinate >= 0 || (devices[i].link[0] >= 0 && devices[i].link[1] >= 0);
    if (!ambulo__yaml_boolean(mirror, 0) || !placed) continue;
    devices[count] = ambulo__device_mirrored(reader->model, &devices[i]);
    devices[count].image_of = i;
    devices[count++].name = mirrored_name(reader, devices[i].name);
  }
  reader->definition.devices = devices;
  reader->definition.device_count = count;
}

/* ----------------------------------------------------------------------- in hands */

static void read_hands(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                       ambulo_hold *hold) {
  int count = ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE) ? ambulo__yaml_items(node) : 0;
  if (count < 1 || count > 2) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "'hands' is not a list of one or two points of the model");
    return;
  }
  for (int i = 0; i < count; i++)
    hold->hand[i] = ambulo__read_name_of(reader, ambulo__yaml_item(node, i), AMBULO__NAMED_POINT);
}

/* behind those that are there; NULL without memory */
static ambulo_hold *add_hold(ambulo__problem_reader *reader) {
  ambulo_problem_definition *d = &reader->definition;
  size_t count = (size_t)d->hold_count;
  ambulo_hold *holds = ambulo__reader_alloc(reader, count + 1, sizeof *holds);
  if (!holds) return NULL;
  if (count > 0) memcpy(holds, d->holds, count * sizeof *holds);
  holds[count] = ambulo_hold_default();
  d->holds = holds;
  d->hold_count++;
  return &holds[count];
}

void ambulo__read_hold(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  ambulo_hold *hold = add_hold(reader);
  if (!hold) return;
  const ambulo__yaml_node *name = ambulo__yaml_get(section, "name");
  hold->name = name ? ambulo__yaml_name(name) : "load";
  read_hands(reader, ambulo__yaml_get(section, "hands"), hold);
  ambulo__read_members(reader, section, &ambulo__hold_members, "", hold);
  ambulo__yaml_close(section);
}
