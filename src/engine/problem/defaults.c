/* problem/defaults.c - what a problem definition and its parts are before a caller says otherwise.
 */
#include "ambulo/evaluate.h"
#include "ambulo/extend.h"
#include "base/sized.h"
#include "problem/definition_parts.h"
#include "problem/term.h"

#include <math.h>

enum { NOT_GIVEN = -1, NONE = -1 };

AMBULO__FILL(ambulo_contact, {.foot = NONE, .mode = AMBULO_CONTACT_FLAT, .patch = NONE})

AMBULO__FILL(ambulo_end_value, {.coordinate = NOT_GIVEN})

AMBULO__FILL(ambulo_tube, {.samples = 0})

AMBULO__FILL(ambulo_user_row, {.relation = AMBULO_NOT_NEGATIVE, .to = (double)INFINITY})

AMBULO__FILL(ambulo_ground_reaction, {.kind = AMBULO_REACTION_NONE,
                                      .transfer = AMBULO_TRANSFER_EARLY,
                                      .exponent = 1.4,
                                      .shear = 1.0,
                                      .friction = 0.5,
                                      .free_moment = 0.02,
                                      .pressure = 1,
                                      .heel_pressure = {-0.02, 0.03},
                                      .heel_roll = 0.04,
                                      .flat_pressure = {-0.005, 0.02},
                                      .toe_pressure = {-0.02, 0.055},
                                      .pressure_width = 0.035,
                                      .arc_pressure = 0.0045,
                                      .moment_arm = 0.2,
                                      .slant = 0.2,
                                      .loading_rate = 15.0,
                                      .flight_tolerance = 0.002})

AMBULO__FILL(ambulo_clearance, {.height = AMBULO_OFF,
                                .tip_from = 0.3,
                                .ceiling = 0.35,
                                .turn = 0.2,
                                .outward = 0.06,
                                .inward = 0.03,
                                .feet = AMBULO_OFF})

AMBULO__FILL(ambulo_collision, {.mode = AMBULO_COLLISION_OFF})

AMBULO__FILL(ambulo_capsule_pair, {.one = NOT_GIVEN, .other = NOT_GIVEN})

AMBULO__FILL(ambulo_obstacle, {.shape = AMBULO_OBSTACLE_BOX})

AMBULO__FILL(ambulo_reach, {.point = NOT_GIVEN, .about = NONE, .to = (double)INFINITY})

AMBULO__FILL(ambulo_motion, {.size = size})

void ambulo_term_fill(ambulo_term *filled, ambulo_term_kind kind, size_t size) {
  const ambulo__term_info *info = ambulo__term_info_of(kind);
  ambulo_term usual = {.kind = kind, .weight = 1.0, .smoothing = 1.0, .power = 2.0, .height = 0.02};
  if (info && info->smoothing > 0.0) usual.smoothing = info->smoothing;
  if (info && info->power > 0.0) usual.power = info->power;
  ambulo__sized_fill(filled, size, &usual, sizeof usual);
}

void ambulo_extension_fill(ambulo_extension *filled) {
  const ambulo_extension usual = {
      .size = filled->size, .term_size = filled->term_size, .user_row_size = filled->user_row_size};
  ambulo__sized_fill(filled, filled->size, &usual, sizeof usual);
}

void ambulo_problem_definition_fill(ambulo_problem_definition *filled) {
  ambulo_problem_definition usual = {.duration = 1.0,
                                     .intervals = 12,
                                     .grid = AMBULO_GRID_UNIFORM,
                                     .discretization = AMBULO_BSPLINE,
                                     .degree = 3,
                                     .knots = AMBULO_GRID_UNIFORM,
                                     .minimum_force = AMBULO_OFF,
                                     .orientation_tolerance = 0.01,
                                     .strike_pitch = {AMBULO_OFF, AMBULO_OFF},
                                     .clearance = ambulo_clearance_default(),
                                     .ground_reaction = ambulo_ground_reaction_default(),
                                     .collision = ambulo_collision_default(),
                                     .ends_order = 1};
  ambulo__definition_give(&usual, filled);
}
