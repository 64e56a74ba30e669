/* mechanics/kernel_world.h - motion of the frames and of the joints' axes in world axes, where the
 * Jacobians are taken, one block of time nodes.
 *
 * Down a limb, with z the joint's axis, p the parent frame and r the constant offset between the
 * origins (in world axes):
 *   revolute:   o = o_p + r,  v = v_p + w_p x r,  a = a_p + alpha_p x r + w_p x (w_p x r),
 *               w = w_p + z qd,  alpha = alpha_p + z qdd + zd qd
 *   prismatic:  the same r, then  o += z q,  v += z qd + zd q,  a += z qdd + 2 zd qd + zdd q
 * with the axis fixed in the parent:  zd = w_p x z,  zdd = alpha_p x z + w_p x zd. The world's a is
 * -gravity, so that weight needs no term of its own.
 *
 * The motion that joint i gives a point r of its subtree, dr/dq_i = S_i(r) = s + z x r, is that of
 * S_i = (z, s) = (z, o x z), or (0, z) if prismatic, about the world origin. It goes along with the
 * parent frame: with the velocity v and the acceleration a of the origin,
 *   Sd  = (zd,  v x z + o x zd),   Sdd = (zdd, a x z + 2 v x zd + o x zdd)
 * or (0, zd), (0, zdd). Stored per joint: S, 2 Sd, Sdd; S alone where nobody reads the others,
 * which are zero. (a, which has -gravity in it, stands for the acceleration: see
 * kernel_jacobian.h.)
 *
 * What a branch starts from is kept in the slots of the frames' own kernels.
 */
#ifndef AMBULO_MECHANICS_KERNEL_WORLD_H
#define AMBULO_MECHANICS_KERNEL_WORLD_H

#include "mechanics/kernel_local_points.h"

/* [coordinates][lanes] */
typedef struct world_inputs {
  const double *q, *qd, *qdd;
} world_inputs;

typedef struct world_state {
  local_place place;
  wide3 v, a, w, alpha;
} world_state;

AMBULO__INLINE world_state world_itself(const ambulo__plan *plan) {
  const wide zero = {0}, one = spread(1);
  const wide3 none = {zero, zero, zero};
  const local_place place = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}, none};
  return (world_state){place, none, scale3(spread(-1), spread3(plan->gravity)), none, none};
}

AMBULO__INLINE world_state load_state(const double *at) {
  return (world_state){place_load(at), load3(at + local_slide), load3(at + local_pull),
                       load3(at + local_rate), load3(at + local_gain)};
}

AMBULO__INLINE void store_place(double *at, const local_place *p) {
  store3(at + local_columns, p->x);
  store3(at + local_columns + three, p->y);
  store3(at + local_columns + 2 * three, p->z);
  store3(at + local_origin, p->o);
}

AMBULO__INLINE void store_state(double *at, const world_state *s) {
  store_place(at, &s->place);
  store3(at + local_slide, s->v);
  store3(at + local_pull, s->a);
  store3(at + local_rate, s->w);
  store3(at + local_gain, s->alpha);
}

AMBULO__INLINE void world_offset(const ambulo__local_step *step, world_state *s) {
  wide3 r = add_offset(step, &s->place, (wide3){{0}, {0}, {0}});
  s->place.o = add3(s->place.o, r);
  if (step->still) return;
  wide3 sweep = cross3(s->w, r);
  s->v = add3(s->v, sweep);
  s->a = add_cross3(add_cross3(s->a, s->alpha, r), s->w, sweep);
}

AMBULO__INLINE void world_hinge(const ambulo__local_step *step, world_state *s, wide qd, wide qdd,
                                double *motion, const double *scratch) {
  const double *angle = scratch + step->at + local_angle;
  wide3 axis = turn_columns(step, &s->place, load(angle), load(angle + AMBULO__LANES));
  wide3 z = scale3(spread(step->sign), axis), o = s->place.o;
  wide3 zd = cross3(s->w, z), zdd = add_cross3(cross3(s->w, zd), s->alpha, z);
  wide3 zd2 = scale3(spread(2), zd), v2 = scale3(spread(2), s->v);
  store_pair(motion, (wide_pair){z, cross3(o, z)});
  store_pair(motion + 2 * three, (wide_pair){zd2, add_cross3(cross3(v2, z), o, zd2)});
  wide3 moved = add_cross3(add_cross3(cross3(s->a, z), v2, zd), o, zdd);
  store_pair(motion + 4 * three, (wide_pair){zdd, moved});
  s->alpha = axpy3(axpy3(s->alpha, qd, zd), qdd, z);
  s->w = axpy3(s->w, qd, z);
}

AMBULO__INLINE void world_slider(const ambulo__local_step *step, world_state *s, wide q, wide qd,
                                 wide qdd, int is_straight, double *motion) {
  const wide3 zero = {{0}, {0}, {0}};
  wide3 z = slide_axis(step, &s->place);
  store_pair(motion, (wide_pair){zero, z});
  s->place.o = axpy3(s->place.o, q, z);
  s->v = axpy3(s->v, qd, z);
  s->a = axpy3(s->a, qdd, z);
  if (is_straight) return;
  wide3 zd = cross3(s->w, z), zdd = add_cross3(cross3(s->w, zd), s->alpha, z);
  wide3 zd2 = scale3(spread(2), zd);
  store_pair(motion + 2 * three, (wide_pair){zero, zd2});
  store_pair(motion + 4 * three, (wide_pair){zero, zdd});
  s->v = axpy3(s->v, q, zd);
  s->a = axpy3(axpy3(s->a, qd, zd2), q, zdd);
}

/* Positions of the points of a frame. */
AMBULO__INLINE void world_points(const ambulo__plan *plan, int number, const local_place *p,
                                 double *scratch) {
  const ambulo__group_step *group = &plan->steps.groups[number];
  double *out = scratch + plan->positions_at;
  for (int i = group->first; i < group->first + group->count; i++) {
    store3(out + i * three, place_of(p, p->o, plan->steps.points[i].position));
  }
}

#endif
