/* model/defaults.c - what parts of a model definition are before a caller says otherwise. */
#include "ambulo/model.h"
#include "base/sized.h"

#include <math.h>

enum { NOT_GIVEN = -1, ITSELF = -1, NONE = -1 };

void ambulo_model_definition_fill(ambulo_model_definition *filled) {
  const ambulo_model_definition usual = {.size = filled->size,
                                         .link_size = filled->link_size,
                                         .coordinate_size = filled->coordinate_size,
                                         .point_size = filled->point_size,
                                         .foot_size = filled->foot_size,
                                         .patch_size = filled->patch_size,
                                         .capsule_size = filled->capsule_size,
                                         .name = "model",
                                         .gravity = {0, -9.81, 0},
                                         .forward = {1, 0, 0},
                                         .stature = AMBULO_OFF};
  ambulo__sized_fill(filled, filled->size, &usual, sizeof usual);
}

AMBULO__FILL(ambulo_link, {.parent = -1, .type = AMBULO_FIXED, .coordinate = -1})

AMBULO__FILL(ambulo_coordinate, {.type = AMBULO_REVOLUTE,
                                 .range = {-INFINITY, INFINITY},
                                 .speed = {-INFINITY, INFINITY},
                                 .torque = {-INFINITY, INFINITY},
                                 .actuated = 1,
                                 .mirror = ITSELF,
                                 .mirror_sign = 1})

AMBULO__FILL(ambulo_point, {.link = NOT_GIVEN})

AMBULO__FILL(ambulo_foot, {.heel = {NOT_GIVEN, NONE},
                           .toe = {NOT_GIVEN, NONE},
                           .heel_center = NOT_GIVEN,
                           .toe_center = NOT_GIVEN,
                           .mirror = ITSELF,
                           .tip = NONE,
                           .arc = {NONE, NONE}})

AMBULO__FILL(ambulo_patch, {.point = NOT_GIVEN, .mirror = ITSELF})

AMBULO__FILL(ambulo_capsule, {.link = NOT_GIVEN, .mirror = ITSELF})
