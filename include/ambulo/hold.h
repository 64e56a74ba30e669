/* ambulo/hold.h - what hands hold or push, from one time to another.
 *
 * Hands are one or two points of the model, p_1 and p_2, with accelerations a_1 and a_2. What they
 * hold is a rigid body that keeps its attitude about the line between them: its mass m is at
 *
 *     c = (p_1 + p_2) / 2 + o          o = `center`, constant along the world's axes
 *
 * (of one hand: a point at p_1), and about any axis across the line it has the moment of inertia I,
 * of a body that turns as the line d = p_2 - p_1 does. Besides, the hands may push: `force` P is
 * what they exert on something else, a wall, at the middle of the line. With the window w(t) of the
 * hold, the force and the moment that it asks for are, exactly,
 *
 *     F = w (m (a_c - g) + P),    about the middle  o x w m (a_c - g)  and  w I (d x dd) / d.d
 *
 * in which dd is the acceleration of d. They add to the root wrench that the surroundings must
 * supply, and the torques carry them along both arms. Two hands and what they hold are a closed
 * loop: any squeeze between them would do as well. Theirs is the least-squares share: of all forces
 * and moments at the hands that add up, the forces are the smallest in the sum of squares, and
 * moments stand for what forces at two points cannot do only, the twist about the line, half each:
 *
 *     f = F / 2 -+ h,   h = w I (dd - d (d . dd) / d.d) / d.d + (o x w m (a_c - g)) x d / d.d
 *     moment of each    d (d . (o x w m (a_c - g))) / (2 d.d)
 *
 * w = 1 between `from` and `to`, 0 outside, and next to either end a smooth step u^2 (3 - 2 u) over
 * `ramp`, inside the window: over it the surface that the body stands on hands it over, and carries
 * 1 - w of its weight. The motion has to leave it at rest there (ambulo_reach holds hands at a
 * place): then this is exact too, since what is at rest has weight alone. Where a window begins at
 * 0 or before, or ends at T or beyond, it has no ramp there.
 *
 * Nothing here keeps the hands on it: rows of ambulo_reach do, with `is_relative`.
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
  double inertia;   /* I, kg m^2, >= 0; of two hands */
  double center[3]; /* o, along forward, left and up, m; of two hands */
  double force[3];  /* P, that the hands exert, along forward, left and up, N */
  double from, to;  /* s; to INFINITY: until the end */
  double ramp;      /* s, > 0, at most half of the window */
  double size[3];   /* for pictures: along forward, left and up, m; zeros: a disc */
} ambulo_hold;

/* One hand (-1), all along, a ramp of 0.1 s, zeros. */
AMBULO_PROBLEM_DEFAULT(ambulo_hold);

#ifdef __cplusplus
}
#endif
#endif
