/* mechanics/kernel_world.h - motion of the frames in world axes, where the Jacobians are taken, one
 * block of time nodes.
 *
 * Down the tree, with z the joint's axis, p the parent frame and r the constant offset between
 * the origins (in world axes), frame by frame:
 *   w     = w_p + z qd                                       angular velocity
 *   alpha = alpha_p + z qdd + w_p x z qd                     angular acceleration
 *   Omega r = alpha x r + w x (w x r)                        acceleration of a fixed r
 *   o     = o_p + r,      a = a_p + Omega_p r                origin (revolute)
 *   o     = o_p + z q,    a = a_p + Omega_p z q + 2 w_p x z qd + z qdd      (prismatic)
 *   v     = v_p + w_p x r,   or v_p + w_p x z q + z qd
 * The world's a is -gravity, so that weight needs no term of its own.
 */
#ifndef AMBULO_MECHANICS_KERNEL_WORLD_H
#define AMBULO_MECHANICS_KERNEL_WORLD_H

#include <math.h>

#include "mechanics/kernel_sincos.h"
#include "mechanics/kernel_wide.h"

static __attribute__((noinline)) void libm_angles(const ambulo__steps *steps, const double *q,
                                                  double *scratch) {
  for (int i = 0; i < steps->angle_count; i++) {
    const ambulo__angle_step *step = &steps->angles[i];
    for (int lane = 0; lane < AMBULO__WIDTH; lane++) {
      double angle = step->sign * q[step->input + lane] + step->shift;
      scratch[step->output + lane] = sin(angle);
      scratch[step->output + AMBULO__LANES + lane] = cos(angle);
    }
  }
}

static void world_frame(const ambulo__plan *plan, double *scratch) {
  const ambulo__frame *world = &plan->frames[0];
  const wide3 zero = {{0}, {0}, {0}};
  for (int i = 0; i < 3; i++) {
    double *column = scratch + world->column_at[i];
    store3(column, zero);
    store(column + i * AMBULO__LANES, spread(1));
  }
  store3(scratch + world->rate_at, zero);
  store3(scratch + world->rate_at + three, zero);
  store3(scratch + world->place_at, zero);
  store3(scratch + world->velocity_at, zero);
  store3(scratch + world->place_at + three,
         (wide3){spread(-plan->gravity[0]), spread(-plan->gravity[1]), spread(-plan->gravity[2])});
}

AMBULO__INLINE void world_turn(const ambulo__turn_step *step, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  for (int i = step->first; i < 3; i++) {
    const double column[3] = {step->turn[i], step->turn[3 + i], step->turn[6 + i]};
    store3(scratch + step->to[i], add_rotated(zero, scratch, step->from, column));
  }
}

/* Orientations and their rates; sines and cosines from the table that libm_angles has made, or
 * on the way. Returns the sum of the squares of the angles. */
AMBULO__INLINE wide world_hinges(const ambulo__steps *steps, const double *q, const double *qd,
                                 const double *qdd, int from_table, double *scratch) {
  wide squares = {0};
  for (int i = 0; i < steps->angle_count; i++) {
    const ambulo__hinge_step *step = &steps->hinges[i];
    if (step->turn >= 0) world_turn(&steps->turns[step->turn], scratch);
    wide s, c;
    if (from_table) {
      s = load(scratch + step->angle);
      c = load(scratch + step->angle + AMBULO__LANES);
    } else {
      wide angle = step->sign * load(q + step->input) + step->shift;
      squares += angle * angle;
      sincos_wide(angle, &s, &c);
    }
    wide3 u = load3(scratch + step->from[0]), v = load3(scratch + step->from[1]);
    store3(scratch + step->to[0], axpy3(scale3(c, u), s, v));
    store3(scratch + step->to[1], (wide3){c * v.x - s * u.x, c * v.y - s * u.y, c * v.z - s * u.z});
    wide3 z = load3(scratch + step->axis), w = load3(scratch + step->rate_from);
    wide3 turn = scale3(step->sign * load(qd + step->input), z);
    wide3 gain = add_cross3(scale3(step->sign * load(qdd + step->input), z), w, turn);
    store3(scratch + step->rate_to, add3(w, turn));
    store3(scratch + step->rate_to + three, add3(load3(scratch + step->rate_from + three), gain));
  }
  for (int i = steps->late_turn; i < steps->turn_count; i++) {
    world_turn(&steps->turns[i], scratch);
  }
  return squares;
}

/* A vector that turns with a frame: its velocity and acceleration, w x r and alpha x r + w x w x r.
 */
AMBULO__INLINE wide_pair swept(const double *rate, wide3 r) {
  wide3 w = load3(rate), velocity = cross3(w, r);
  return (wide_pair){velocity, add_cross3(cross3(load3(rate + three), r), w, velocity)};
}

/* Origins that move, their accelerations and velocities. What comes from the parent is added last:
 * the next step waits for it. */
static void world_origins(const ambulo__steps *steps, const double *q, const double *qd,
                          const double *qdd, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  for (int i = 0; i < steps->origin_count; i++) {
    const ambulo__origin_step *step = &steps->origins[i];
    wide3 r = add_rotated(zero, scratch, step->columns, step->offset), gain = zero, v = zero;
    if (step->prismatic) {
      wide3 z = load3(scratch + step->axis);
      r = axpy3(r, step->sign * load(q + step->input), z);
      v = scale3(step->sign * load(qd + step->input), z);
      gain = scale3(step->sign * load(qdd + step->input), z);
      if (!step->still) {
        wide3 twice = scale3(2 * step->sign * load(qd + step->input), z);
        gain = add_cross3(gain, load3(scratch + step->rate), twice);
      }
    }
    if (!step->still) {
      wide_pair turn = swept(scratch + step->rate, r);
      v = add3(v, turn.angular);
      gain = add3(gain, turn.linear);
    }
    store3(scratch + step->velocity_to, add3(load3(scratch + step->velocity_from), v));
    store3(scratch + step->place_to, add3(load3(scratch + step->place_from), r));
    wide3 a = load3(scratch + step->place_from + three);
    store3(scratch + step->place_to + three, add3(a, gain));
  }
}

/* Positions of the points, one after the other in order of groups. */
AMBULO__INLINE void world_positions(const ambulo__steps *steps, double *out,
                                    const double *scratch) {
  for (int g = 0; g < steps->group_count; g++) {
    const ambulo__group_step *group = &steps->groups[g];
    wide3 o = load3(scratch + group->place), x = load3(scratch + group->columns[0]);
    wide3 y = load3(scratch + group->columns[1]), z = load3(scratch + group->columns[2]);
    for (int i = group->first; i < group->first + group->count; i++) {
      const double *r = steps->points[i].position;
      wide3 p = axpy3(axpy3(axpy3(o, spread(r[0]), x), spread(r[1]), y), spread(r[2]), z);
      store3(out + i * three, p);
    }
  }
}

static void world_part(const ambulo__plan *plan, const double *q, const double *qd,
                       const double *qdd, double *scratch) {
  const ambulo__steps *steps = &plan->steps;
  world_frame(plan, scratch);
  if (!sincos_inside(world_hinges(steps, q, qd, qdd, 0, scratch))) {
    libm_angles(steps, q, scratch);
    world_hinges(steps, q, qd, qdd, 1, scratch);
  }
  world_origins(steps, q, qd, qdd, scratch);
}

#endif
