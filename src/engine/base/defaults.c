/* base/defaults.c - the defaults of the engine's structures, one row each.
 *
 * Those of a problem's definition and of its parts are in the tables of their members
 * (problem/members.c).
 */
#include "ambulo/ambulo.h"
#include "base/sized.h"

#include <math.h>

enum { NOT_GIVEN = -1, ITSELF = -1, NONE = -1 };

/* `sizes`: how many members at the beginning are sizes */
#define ROW(type, sizes, ...)                                                                      \
  { #type, &(const type)__VA_ARGS__, sizeof(type), sizes }

static const ambulo__usual rows[] = {
    ROW(ambulo_model_definition, 7,
        {.name = "model", .gravity = {0, -9.81, 0}, .forward = {1, 0, 0}, .stature = AMBULO_OFF}),
    ROW(ambulo_link, 0, {.parent = -1, .type = AMBULO_FIXED, .coordinate = -1}),
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

    ROW(ambulo_options, 1,
        {.algorithm = AMBULO_AUTO,
         .presolve = 1,
         .maximum_evaluations = 20000,
         .maximum_iterations = 150,
         .time_limit = AMBULO_OFF,
         .maximum_memory = AMBULO_OFF,
         .feasibility_tolerance = 1e-6,
         .optimality_tolerance = 1e-3,
         .continuation = 1,
         .starts = 1,
         .dense_samples = 10,
         .equalities = AMBULO_EQUALITIES_HELD}),
    ROW(ambulo_parameter, 0, {.lower = AMBULO_OFF, .upper = AMBULO_OFF}),
    ROW(ambulo_parameters, 2, {.maximum_solves = 60}),
};

ambulo_status ambulo_defaults(const char *name, void *structure, size_t bytes) {
  return ambulo__defaults_of(rows, (int)(sizeof rows / sizeof *rows), name, structure, bytes);
}
