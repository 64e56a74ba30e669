/* formats/motion_units.h - values of a coordinate that hardly are in the unit they pass for. */
#ifndef AMBULO_FORMATS_MOTION_UNITS_H
#define AMBULO_FORMATS_MOTION_UNITS_H

#include "ambulo/model.h"

/* The size beyond which a value (rad or m) is doubted: ten times the range of the joint, and for an
 * angle that has a range no more than a turn; ten turns for an angle without range, INFINITY for a
 * length without. Degrees taken for radians, and millimetres for metres, are beyond it unless the
 * motion is minute. */
double ambulo__largest_plausible(const ambulo_coordinate *coordinate);

#endif
