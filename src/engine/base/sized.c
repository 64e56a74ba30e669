/* base/sized.c - reading and filling structures of older headers; the defaults of the engine's
 * structures, one row each. Those of a problem's definition and its parts are in the tables of
 * their members (problem/members.c). */
#include "base/sized.h"

#include "ambulo/ambulo.h"
#include "base/alloc.h"

#include <math.h>
#include <string.h>

int ambulo__sized_take(void *own, size_t full, const void *given) {
  size_t size;
  if (!given) return 1;
  memcpy(&size, given, sizeof size);
  if (size <= sizeof size || size > full) return 0;
  memcpy(own, given, size);
  memcpy(own, &full, sizeof full);
  return 1;
}

void ambulo__sized_fill(void *filled, size_t size, const void *usual, size_t full) {
  memcpy(filled, usual, size < full ? size : full);
  if (size > full) memset((char *)filled + full, 0, size - full);
}

int ambulo__sized_item(size_t size, size_t full) {
  return size > 0 && size <= full;
}

void *ambulo__sized_items(const ambulo_allocator *allocator, const void *items, int count,
                          size_t size, size_t full, const char *name) {
  if (!items || count < 1) return NULL;
  char *own = ambulo__alloc(allocator, (size_t)count, full);
  for (size_t i = 0; own && i < (size_t)count; i++) {
    char *item = own + i * full;
    ambulo_defaults(name, item, full);
    memcpy(item, (const char *)items + i * size, size);
  }
  return own;
}

ambulo_status ambulo__defaults_of(const ambulo__usual *table, int count, const char *name,
                                  void *structure, size_t bytes) {
  const ambulo__usual *row = table;
  if (!name || !structure) return AMBULO_E_ARGUMENT;
  while (row < table + count && strcmp(row->name, name) != 0) row++;
  size_t sizes = row < table + count ? (size_t)row->sizes * sizeof(size_t) : 0;
  if (row == table + count || bytes < sizes) return AMBULO_E_ARGUMENT;
  ambulo__sized_fill((char *)structure + sizes, bytes - sizes, (const char *)row->usual + sizes,
                     row->bytes - sizes);
  if (sizes) memcpy(structure, &bytes, sizeof bytes);
  return AMBULO_OK;
}

/* -------------------------------------------------------------------- defaults */

enum { NOT_GIVEN = -1, ITSELF = -1, NONE = -1 };

/* `sizes`: how many members at the beginning are sizes */
#define ROW(type, sizes, ...)                                                                      \
  { #type, &(const type)__VA_ARGS__, sizeof(type), sizes }

static const ambulo__usual rows[] = {
    ROW(ambulo_model_definition, 7,
        {.name = "model", .gravity = {0, -9.81, 0}, .forward = {1, 0, 0}, .stature = AMBULO_OFF}),
    ROW(ambulo_link, 0, {.parent = -1, .type = AMBULO_FIXED, .coordinate = -1, .coupled_to = NONE}),
    ROW(ambulo_coordinate, 0,
        {.type = AMBULO_REVOLUTE,
         .range = {-INFINITY, INFINITY},
         .speed = {-INFINITY, INFINITY},
         .torque = {-INFINITY, INFINITY},
         .actuated = 1,
         .mirror = ITSELF,
         .mirror_sign = 1}),
    ROW(ambulo_point, 0, {.link = NOT_GIVEN}),
    ROW(ambulo_foot, 0,
        {.heel = {NOT_GIVEN, NONE},
         .toe = {NOT_GIVEN, NONE},
         .heel_center = NOT_GIVEN,
         .toe_center = NOT_GIVEN,
         .mirror = ITSELF,
         .tip = NONE,
         .arc = {NONE, NONE}}),
    ROW(ambulo_patch, 0, {.point = NOT_GIVEN, .mirror = ITSELF}),
    ROW(ambulo_capsule, 0, {.link = NOT_GIVEN, .mirror = ITSELF}),
    ROW(ambulo_conditions, 1, {.load_link = NONE}),

    ROW(ambulo_outputs, 1, {0}),
    ROW(ambulo_output_weights, 1, {0}),
    ROW(ambulo_motion_gradient, 1, {0}),
    ROW(ambulo_jacobians, 1, {0}),
    ROW(ambulo_point_motion, 1, {0}),
    ROW(ambulo_motion, 1, {0}),

    /* phases of people at a comfortable speed, as docs/guide-gait.md has them */
    ROW(ambulo_gait, 2,
        {.steps = 1,
         .foot_flat = 0.08,
         .heel_off = 0.38,
         .toe_off = 0.62,
         .other_step_length = AMBULO_OFF,
         .other_step_time = AMBULO_OFF}),
    ROW(ambulo_extension, 3, {0}),

    ROW(ambulo_parameter, 0, {.lower = AMBULO_OFF, .upper = AMBULO_OFF}),
    ROW(ambulo_parameters, 2, {.maximum_solves = 60}),

    ROW(ambulo_muscle, 0,
        {.group = "",
         .mirror = ITSELF,
         .passive_strain = 0.6,
         .fast_fibers = 0.5,
         .elastic = NONE,
         .range = {{-INFINITY, INFINITY},
                   {-INFINITY, INFINITY},
                   {-INFINITY, INFINITY},
                   {-INFINITY, INFINITY}}}),
    ROW(ambulo_muscle_pull, 0, {.link = NOT_GIVEN, .axes = NOT_GIVEN}),
    ROW(ambulo_muscles_definition, 3, {.name = "muscles", .source = ""}),
    ROW(ambulo_sharing, 1, {.activation = 1.0, .reserve = 0.2, .by_volume = 1}),
    ROW(ambulo_sharing_states, 1, {0}),
    ROW(ambulo_sharing_outputs, 1, {0}),
};

ambulo_status ambulo_defaults(const char *name, void *structure, size_t bytes) {
  return ambulo__defaults_of(rows, (int)(sizeof rows / sizeof *rows), name, structure, bytes);
}
