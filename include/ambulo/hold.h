/* ambulo/hold.h - what hands hold or push during an interval.
 *
 * Hands are one or two points of the model, p_1 and p_2, with accelerations a_1 and a_2. Two hands
 * hold a rigid body that keeps its attitude about the line between them. Its mass m is at
 *
 *     c = (p_1 + p_2) / 2 + o          o = `center`, constant in the world's axes
 *
 * and its moment of inertia about any axis across the line is I; it turns as the line
 * d = p_2 - p_1 does. One hand holds a point mass at p_1. The hands may also push: `force` P is
 * what they exert on something else, such as a wall, at the middle of the line. With the window
 * w(t) of the hold, the required force and moment are, exactly,
 *
 *     F = w (m (a_c - g) + P),    about the middle  o x w m (a_c - g)  and  w I (d x dd) / d.d
 *
 * where dd is the acceleration of d. They add to the root wrench that the surroundings must supply,
 * and to the torques along both arms. Two hands and their load form a closed loop, so the squeeze
 * between them is not determined. The engine takes the least-squares share: the forces with the
 * smallest sum of squares. Moments cover only what forces at two points cannot: the twist about the
 * line, half at each hand:
 *
 *     f = F / 2 -+ h,   h = w I (dd - d (d . dd) / d.d) / d.d + (o x w m (a_c - g)) x d / d.d
 *     moment of each    d (d . (o x w m (a_c - g))) / (2 d.d)
 *
 * w = 1 between `from` and `to` and 0 outside, with a smooth step u^2 (3 - 2 u) over `ramp` inside
 * each end. During a ramp the surface below the load carries 1 - w of its weight. This is exact if
 * the load is at rest there, so keep the hands at a place by ambulo_reach. A window that begins at
 * 0 or earlier, or ends at T or later, has no ramp at that end.
 *
 * A hold does not keep the hands on the load: rows of ambulo_reach with `is_relative` do.
 */
#ifndef AMBULO_HOLD_H
#define AMBULO_HOLD_H

#include "ambulo/model.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ambulo_hold {
  const char *name; /* for columns and reports, unique */
  int hand[2];      /* points of the model; the second -1: one hand */
  double mass;      /* m, kg, >= 0 */
  double inertia;   /* I, kg m^2, >= 0; two hands only */
  double center[3]; /* o, along forward, left and up, m; two hands only */
  double force[3];  /* P, exerted by the hands, along forward, left and up, N */
  double from, to;  /* s; to INFINITY: until the end */
  double ramp;      /* s, > 0, at most half of the window */
  double size[3];   /* in pictures only: along forward, left and up, m; zeros: a disc */
} ambulo_hold;

/* One hand, whose point must be set; the whole motion; a ramp of 0.1 s; all else 0. */
AMBULO_PROBLEM_DEFAULT(ambulo_hold);

#ifdef __cplusplus
}
#endif
#endif
