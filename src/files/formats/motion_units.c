/* formats/motion_units.c - see motion_units.h. */
#include "formats/motion_units.h"

#include <math.h>

static const double turn = 6.283185307179586;

double ambulo__largest_plausible(const ambulo_coordinate *c) {
  double reach = fmax(fabs(c->range[0]), fabs(c->range[1]));
  int angle = c->type == AMBULO_REVOLUTE;
  if (!isfinite(reach)) return angle ? 10.0 * turn : (double)INFINITY;
  return angle ? fmax(fmin(10.0 * reach, turn), 2.0 * reach) : 10.0 * reach;
}
