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

/* loads and composite inertias of subtrees in world axes.
 *
 * A body with mass m, centre of mass x = o + c, its velocity v, and the inertia J about it:
 *   F = m (a + Omega c),   H = J alpha + w x J w,   N = x x F + H            (15')
 *   h = m x,   P = m v,   I = J + (h.x) 1 - h x^T,   K = v h^T + [w x] (tr(J)/2 1 - J),
 *   E = tr(K) 1 - K
 * (kernel_jacobian.h says what the second line is for.) Those of a subtree are the sums over its
 * bodies; about the world origin they need no shifting. The load (N, F) of the whole tree is the
 * root wrench. Bodies are done on the way down a limb, where their frames are in registers, and
 * summed up on the way back.
 */

/* Where they stand in a slot. */
enum {
  subtree_load = 0,
  subtree_first = 2 * three,
  subtree_momentum = 3 * three,
  subtree_inertia = 4 * three,
  subtree_coriolis = 6 * three
};

typedef struct wide_subtree {
  wide_pair load;        /* N, F */
  wide3 first, momentum; /* h, P */
  wide6 inertia;         /* I */
  wide33 coriolis;       /* E */
} wide_subtree;

AMBULO__INLINE wide_subtree load_subtree(const double *at) {
  return (wide_subtree){load_pair(at + subtree_load), load3(at + subtree_first),
                        load3(at + subtree_momentum), load6(at + subtree_inertia),
                        load33(at + subtree_coriolis)};
}

AMBULO__INLINE void store_subtree(double *at, const wide_subtree *s) {
  store_pair(at + subtree_load, s->load);
  store3(at + subtree_first, s->first);
  store3(at + subtree_momentum, s->momentum);
  store6(at + subtree_inertia, s->inertia);
  store33(at + subtree_coriolis, s->coriolis);
}

AMBULO__INLINE wide_subtree add_subtrees(wide_subtree a, wide_subtree b) {
  const wide6 i = a.inertia, j = b.inertia;
  const wide33 e = a.coriolis, f = b.coriolis;
  return (wide_subtree){
      axpy_pair(a.load, spread(1), b.load),
      add3(a.first, b.first),
      add3(a.momentum, b.momentum),
      {i.xx + j.xx, i.yy + j.yy, i.zz + j.zz, i.xy + j.xy, i.xz + j.xz, i.yz + j.yz},
      {add3(e.x, f.x), add3(e.y, f.y), add3(e.z, f.z)}};
}

/* Adds what stands at `from` to what stands at `to`. */
AMBULO__INLINE void add_subtree(double *to, const double *from) {
  const wide_subtree sum = add_subtrees(load_subtree(to), load_subtree(from));
  store_subtree(to, &sum);
}

AMBULO__INLINE void copy_subtree(double *to, const double *from) {
  const wide_subtree copy = load_subtree(from);
  store_subtree(to, &copy);
}

AMBULO__INLINE void clear_subtree(double *at) {
  const wide_subtree none = {0};
  store_subtree(at, &none);
}

/* base 1 + u x^T + w y^T, u along x and w along y. */
AMBULO__INLINE wide6 sum_of_squares(wide base, wide3 u, wide3 x, wide3 w, wide3 y) {
  return (wide6){base + u.x * x.x + w.x * y.x, base + u.y * x.y + w.y * y.y,
                 base + u.z * x.z + w.z * y.z, u.x * x.y + w.x * y.y,
                 u.x * x.z + w.x * y.z,        u.y * x.z + w.y * y.z};
}

/* Of a diagonal inertia: zz 1 + (xx - zz) x x^T + (yy - zz) y y^T, x and y columns of the frame. */
AMBULO__INLINE wide6 diagonal_inertia(const ambulo__local_step *step, const local_place *p) {
  wide3 u = scale3(spread(step->difference[1]), p->x);
  wide3 w = scale3(spread(-step->difference[0]), p->y);
  return sum_of_squares(spread(step->inertia[2]), u, p->x, w, p->y);
}

/* base 1 + first u u^T + second w w^T, see plan_inertia.c. */
AMBULO__INLINE wide6 oblique_inertia(const ambulo__rigid_body *body, const local_place *p) {
  const wide3 columns[3] = {p->x, p->y, p->z};
  wide3 x = columns[body->order[0]], y = columns[body->order[1]], z = columns[body->order[2]];
  x = axpy3(axpy3(x, spread(body->lower[0]), y), spread(body->lower[1]), z);
  y = axpy3(y, spread(body->lower[2]), z);
  wide3 u = scale3(spread(body->first), x), w = scale3(spread(body->second), y);
  return sum_of_squares(spread(body->base), u, x, w, y);
}

/* The centre of mass from the frame's origin, in world axes. */
AMBULO__INLINE wide3 body_center(const ambulo__local_step *step, const local_place *p) {
  switch (step->body) {
  case AMBULO__BODY_X:
    return scale3(spread(step->com[0]), p->x);
  case AMBULO__BODY_Y:
    return scale3(spread(step->com[1]), p->y);
  case AMBULO__BODY_Z:
    return scale3(spread(step->com[2]), p->z);
  default:
    return place_of(p, (wide3){{0}, {0}, {0}}, step->com);
  }
}

/* (v.h) 1 - v h^T - [w x] (tr(J)/2 1 - J); the last part has no trace. */
AMBULO__INLINE wide33 body_coriolis(wide3 v, wide3 h, wide3 w, wide6 j) {
  wide trace = dot3(v, h), half = 0.5 * (j.xx + j.yy + j.zz);
  wide3 k1 = cross3(w, (wide3){half - j.xx, -j.xy, -j.xz});
  wide3 k2 = cross3(w, (wide3){-j.xy, half - j.yy, -j.yz});
  wide3 k3 = cross3(w, (wide3){-j.xz, -j.yz, half - j.zz});
  return (wide33){{trace - v.x * h.x - k1.x, -v.x * h.y - k2.x, -v.x * h.z - k3.x},
                  {-v.y * h.x - k1.y, trace - v.y * h.y - k2.y, -v.y * h.z - k3.y},
                  {-v.z * h.x - k1.z, -v.z * h.y - k2.z, trace - v.z * h.z - k3.z}};
}

/* (10 W) load of the subtree about the world origin */
AMBULO__INLINE void store_body(const ambulo__local_step *step, const ambulo__rigid_body *body,
                               const world_state *s, double *to) {
  wide3 w = s->w, c = body_center(step, &s->place), x = add3(s->place.o, c);
  wide3 sweep = cross3(w, c), v = add3(s->v, sweep);
  wide3 force = add_cross3(add_cross3(s->a, s->alpha, c), w, sweep);
  wide mass = spread(step->mass);
  wide6 j = step->body == AMBULO__BODY_ANY ? oblique_inertia(body, &s->place)
                                           : diagonal_inertia(step, &s->place);
  wide_subtree sum;
  sum.load.linear = force = scale3(mass, force);
  sum.load.angular = add_cross3(multiply6(j, s->alpha), w, multiply6(j, w));
  sum.load.angular = add_cross3(sum.load.angular, x, force);
  wide3 h = sum.first = scale3(mass, x);
  sum.momentum = scale3(mass, v);
  sum.coriolis = body_coriolis(v, h, w, j);
  wide square = dot3(h, x);
  sum.inertia =
      (wide6){j.xx + square - h.x * x.x, j.yy + square - h.y * x.y, j.zz + square - h.z * x.z,
              j.xy - h.x * x.y,          j.xz - h.x * x.z,          j.yz - h.y * x.z};
  store_subtree(to, &sum);
}

/* (S.1): Down a limb: the joints' motions, the points, the bodies. */
static void world_limb(const ambulo__plan *plan, const ambulo__limb *limb, const world_inputs *x,
                       double *scratch) {
  const world_state start = world_itself(plan);
  world_state s = start;
  for (int i = limb->first; i <= limb->leaf; i++) {
    const ambulo__local_step *step = &plan->local.steps[i];
    const ambulo__change_step *change = &plan->steps.changes[i];
    double *motion = scratch + change->motion;
    wide q = load(x->q + step->input), qd = load(x->qd + step->input);
    wide qdd = load(x->qdd + step->input);
    if (!step->carried) s = step->from_world ? start : load_state(scratch + step->above);
    if (step->offset != AMBULO__OFFSET_NONE) world_offset(step, &s);
    if (step->turned) s.place = turned_place(step, &s.place);
    if (step->joint >= AMBULO__SLIDES) {
      world_slider(step, &s, q, qd, qdd, change->is_straight, motion);
    } else {
      world_hinge(step, &s, qd, qdd, motion, scratch);
    }
    if (step->kept) store_state(scratch + step->at, &s);
    if (step->group >= 0) world_points(plan, step->group, &s.place, scratch);
    if (step->body == AMBULO__BODY_NONE) {
      if (i == limb->leaf) clear_subtree(scratch + change->subtree);
      continue;
    }
    store_body(step, &plan->body[plan->frames[i + 1].body], &s, scratch + change->subtree);
  }
}

/* (15'): Where the subtree of step k's frame stands, given that of its last child. A frame that has
 * nothing of its own, neither body nor branches, has its child's. */
AMBULO__INLINE const double *complete_subtree(const ambulo__plan *plan, int k, const double *child,
                                              double *scratch) {
  double *own = scratch + plan->steps.changes[k].subtree;
  if (child && child != own) add_subtree(own, child);
  return own;
}

/* What a limb leaves to the frame above its top. */
AMBULO__INLINE void pass_subtree_on(const ambulo__plan *plan, int top, const double *sum,
                                    double *scratch) {
  const ambulo__local_step *step = &plan->local.steps[top];
  double *above = scratch + plan->frames[step->parent + 1].subtree_at;
  if (step->first) {
    copy_subtree(above, sum);
  } else {
    add_subtree(above, sum);
  }
}

#endif
