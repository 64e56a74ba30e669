/* mechanics/kernel_subtree.h - loads and composite inertias of subtrees in world axes.
 *
 * A body with mass m, centre of mass x = o + c, its velocity v, and the inertia J about it:
 *   F = m (a + Omega c),   H = J alpha + w x J w,   N = x x F + H            (15')
 *   h = m x,   P = m v,   I = J + (h.x) 1 - h x^T,   K = v h^T + [w x] (tr(J)/2 1 - J),
 *   E = tr(K) 1 - K
 * (kernel_jacobian.h says what the second line is for.) Those of a subtree are the sums over its
 * bodies; about the world origin they need no shifting. The load (N, F) of the whole tree is the
 * root wrench.
 */
#ifndef AMBULO_MECHANICS_KERNEL_SUBTREE_H
#define AMBULO_MECHANICS_KERNEL_SUBTREE_H

#include "mechanics/kernel_world.h"

typedef struct wide_subtree {
  wide_pair load;        /* N, F */
  wide3 first, momentum; /* h, P */
  wide6 inertia;         /* I */
  wide33 coriolis;       /* E */
} wide_subtree;

AMBULO__INLINE wide6 add6(wide6 a, wide6 b) {
  return (wide6){a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
}

AMBULO__INLINE wide_subtree load_subtree(const double *at) {
  return (wide_subtree){load_pair(at), load3(at + 2 * three), load3(at + 3 * three),
                        load6(at + 4 * three), load33(at + 6 * three)};
}

AMBULO__INLINE void store_subtree(double *at, const wide_subtree *s) {
  store_pair(at, s->load);
  store3(at + 2 * three, s->first);
  store3(at + 3 * three, s->momentum);
  store6(at + 4 * three, s->inertia);
  store33(at + 6 * three, s->coriolis);
}

AMBULO__INLINE void add_subtree(wide_subtree *sum, const double *at) {
  const wide_subtree s = load_subtree(at);
  wide33 *e = &sum->coriolis;
  sum->load = axpy_pair(sum->load, spread(1), s.load);
  sum->first = add3(sum->first, s.first);
  sum->momentum = add3(sum->momentum, s.momentum);
  sum->inertia = add6(sum->inertia, s.inertia);
  *e = (wide33){add3(e->x, s.coriolis.x), add3(e->y, s.coriolis.y), add3(e->z, s.coriolis.z)};
}

/* base 1 + first u u^T + second w w^T, see plan_mass.c. */
AMBULO__INLINE wide6 body_inertia(const ambulo__body *body, const double *scratch) {
  wide3 x = load3(scratch + body->ordered[0]), y = load3(scratch + body->ordered[1]);
  if (!body->diagonal) {
    wide3 z = load3(scratch + body->ordered[2]);
    x = axpy3(axpy3(x, spread(body->lower[0]), y), spread(body->lower[1]), z);
    y = axpy3(y, spread(body->lower[2]), z);
  }
  wide3 u = scale3(spread(body->first), x), w = scale3(spread(body->second), y);
  return (wide6){body->base + u.x * x.x + w.x * y.x,
                 body->base + u.y * x.y + w.y * y.y,
                 body->base + u.z * x.z + w.z * y.z,
                 u.x * x.y + w.x * y.y,
                 u.x * x.z + w.x * y.z,
                 u.y * x.z + w.y * y.z};
}

AMBULO__INLINE void add_body(wide_subtree *sum, const ambulo__body *body, const double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  const double *place = scratch + body->place;
  wide3 w = load3(scratch + body->rate), alpha = load3(scratch + body->rate + three);
  wide3 c = add_rotated(zero, scratch, body->columns, body->com), x = add3(load3(place), c);
  wide_pair turn = swept(scratch + body->rate, c);
  wide3 v = add3(load3(scratch + body->velocity), turn.angular);
  wide3 force = scale3(spread(body->mass), add3(load3(place + three), turn.linear));
  wide6 j = body_inertia(body, scratch);
  wide3 rate = add_cross3(multiply6(j, alpha), w, multiply6(j, w));
  sum->load.angular = add3(sum->load.angular, add_cross3(rate, x, force));
  sum->load.linear = add3(sum->load.linear, force);
  wide3 h = scale3(spread(body->mass), x);
  sum->first = add3(sum->first, h);
  sum->momentum = axpy3(sum->momentum, spread(body->mass), v);
  wide square = dot3(h, x), trace = dot3(v, h), half = 0.5 * (j.xx + j.yy + j.zz);
  wide6 *i = &sum->inertia;
  *i = (wide6){i->xx + (j.xx + square - h.x * x.x), i->yy + (j.yy + square - h.y * x.y),
               i->zz + (j.zz + square - h.z * x.z), i->xy + (j.xy - h.x * x.y),
               i->xz + (j.xz - h.x * x.z),          i->yz + (j.yz - h.y * x.z)};
  /* columns of [w x] (half - J), which has no trace; E = (v.h) 1 - v h^T - [w x] (...) */
  wide3 k1 = cross3(w, (wide3){half - j.xx, -j.xy, -j.xz});
  wide3 k2 = cross3(w, (wide3){-j.xy, half - j.yy, -j.yz});
  wide3 k3 = cross3(w, (wide3){-j.xz, -j.yz, half - j.zz});
  wide33 *e = &sum->coriolis;
  e->x = add3(e->x, (wide3){trace - v.x * h.x - k1.x, -v.x * h.y - k2.x, -v.x * h.z - k3.x});
  e->y = add3(e->y, (wide3){-v.y * h.x - k1.y, trace - v.y * h.y - k2.y, -v.y * h.z - k3.y});
  e->z = add3(e->z, (wide3){-v.z * h.x - k1.z, -v.z * h.y - k2.z, trace - v.z * h.z - k3.z});
}

/* The subtree of step k's frame, from that of its last child; the rest is stored. */
AMBULO__INLINE void complete_subtree(const ambulo__plan *plan, int k, wide_subtree *sum,
                                     const double *scratch) {
  const ambulo__frame *frame = &plan->frames[k + 1];
  if (frame->body >= 0) add_body(sum, &plan->body[frame->body], scratch);
  if (plan->local.steps[k].adjoined) add_subtree(sum, scratch + frame->subtree_at);
}

/* What a limb leaves to the frame above its top. */
AMBULO__INLINE void pass_subtree_on(const ambulo__plan *plan, int top, wide_subtree *sum,
                                    double *scratch) {
  const ambulo__local_step *step = &plan->local.steps[top];
  double *above = scratch + plan->frames[step->parent + 1].subtree_at;
  int first = step->from_world ? step->first : step->first_adjoint;
  if (!first) add_subtree(sum, above);
  store_subtree(above, sum);
}

#endif
