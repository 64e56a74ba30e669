/* tests/support/still_walker.h - a planar walker and a motion of it with forces on a foot. */
#ifndef AMBULO_TESTS_STILL_WALKER_H
#define AMBULO_TESTS_STILL_WALKER_H

#include "ambulo/tools/tools.h"
#include "support/test.h"

/* a walker that hangs still, its right foot pressed from 0.2 s on */
static const char motion_text[] =
    "time,q.pelvis_ty,q.knee_angle_r,grf.right.x,grf.right.y,grf.right.z,cop.right.x,cop.right.y,"
    "cop.right.z,free_moment.right,grf.left.x,grf.left.y,grf.left.z,cop.left.x,cop.left.y,"
    "cop.left.z,free_moment.left\n"
    "0,0.1,0.5,0,0,0,nan,nan,nan,0,0,0,0,nan,nan,nan,0\n"
    "0.1,0.1,0.5,0,0,0,nan,nan,nan,0,0,0,0,nan,nan,nan,0\n"
    "0.2,0.1,0.5,10,700,20,0.1,0,0.05,3,0,0,0,nan,nan,nan,0\n"
    "0.3,0.1,0.5,10,700,20,0.2,0,0.05,3,0,0,0,nan,nan,nan,0\n"
    "0.4,0.1,0.5,10,700,20,0.2,0,0.05,3,0,0,0,nan,nan,nan,0\n";

static inline ambulo_model *walker(void) {
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/walker_2d.yaml", NULL, NULL, NULL, &model), AMBULO_OK);
  return model;
}

#endif
