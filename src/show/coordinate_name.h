/* show/coordinate_name.h - what coordinates are called in pictures, and on which side they are.
 *
 * A coordinate that has a mirror image is called as the other one but for the side, which is where
 * the two names part: hip_flexion_l and hip_flexion_r, left_knee and right_knee, LLEG_HIP_R and
 * RLEG_HIP_R (whose last letter is no side). */
#ifndef AMBULO_SHOW_COORDINATE_NAME_H
#define AMBULO_SHOW_COORDINATE_NAME_H

#include "base/text_buffer.h"
#include "model/model.h"

typedef enum ambulo__side { AMBULO__MIDDLE, AMBULO__LEFT, AMBULO__RIGHT } ambulo__side;

/* Left, right or neither, of a coordinate that has a mirror image: by the two names, else by where
 * its joint stands at q = 0, beside the other's. */
ambulo__side ambulo__coordinate_side(const ambulo_model *model, int coordinate);

/* Appends the name without its side, in words: "Hip flexion", "LEG HIP R". */
void ambulo__coordinate_title(const ambulo_model *model, int coordinate, ambulo__text_buffer *out);

#endif
