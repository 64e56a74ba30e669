/* mechanics/kernel_local_axes.h - vectors across a turn about an axis, a constant turn, and a
 * constant offset, with the zeros that the kinds of plan_local.h promise.
 *
 * (u, v, k) stands for the components of a vector in cyclic order, the axis k last.
 */
#ifndef AMBULO_MECHANICS_KERNEL_LOCAL_AXES_H
#define AMBULO_MECHANICS_KERNEL_LOCAL_AXES_H

#include "mechanics/kernel_wide.h"

typedef struct local_state {
  wide3 w, alpha, a;
} local_state;

/* (u, v, k) from (x, y, z), and back; k is known when this is compiled. */
AMBULO__INLINE wide3 cycled(wide3 v, int k) {
  return k == 0 ? (wide3){v.y, v.z, v.x} : k == 1 ? (wide3){v.z, v.x, v.y} : v;
}

AMBULO__INLINE wide3 uncycled(wide3 v, int k) {
  return k == 0 ? (wide3){v.z, v.x, v.y} : k == 1 ? (wide3){v.y, v.z, v.x} : v;
}

AMBULO__INLINE wide3 load_cycled(const double *at, int k) {
  return (wide3){load(at + (k + 1) % 3 * AMBULO__LANES), load(at + (k + 2) % 3 * AMBULO__LANES),
                 load(at + k * AMBULO__LANES)};
}

AMBULO__INLINE void store_across(double *at, wide3 v, int k) {
  store(at + (k + 1) % 3 * AMBULO__LANES, v.x);
  store(at + (k + 2) % 3 * AMBULO__LANES, v.y);
}

AMBULO__INLINE void store_cycled(double *at, wide3 v, int k) {
  store_across(at, v, k);
  store(at + k * AMBULO__LANES, v.z);
}

/* R^T v and R v of a turn about the last component. */
AMBULO__INLINE wide3 into_frame(wide3 v, wide s, wide c) {
  return (wide3){c * v.x + s * v.y, c * v.y - s * v.x, v.z};
}

AMBULO__INLINE wide3 from_frame(wide3 v, wide s, wide c) {
  return (wide3){c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

/* T v and T^T v with a constant matrix. */
AMBULO__INLINE wide3 out_of_turn(const double t[9], wide3 v) {
  return multiply33((wide33){spread3(t), spread3(t + 3), spread3(t + 6)}, v);
}

AMBULO__INLINE wide3 into_turn(const double t[9], wide3 v) {
  const wide3 zero = {{0}, {0}, {0}};
  return add_multiply33_transposed(zero, (wide33){spread3(t), spread3(t + 3), spread3(t + 6)}, v);
}

/* a + Omega r */
AMBULO__INLINE wide3 moved_any(wide3 a, wide3 w, wide3 alpha, wide3 r) {
  a = add_cross3(a, alpha, r);
  return axpy3(axpy3(a, dot3(w, r), w), -dot3(w, w), r);
}

AMBULO__INLINE wide3 moved_along(wide3 a, wide3 w, wide3 alpha, int k, double length) {
  wide r = spread(length);
  a = cycled(a, k);
  w = cycled(w, k);
  alpha = cycled(alpha, k);
  a.x += r * (w.x * w.z + alpha.y);
  a.y += r * (w.y * w.z - alpha.x);
  a.z -= r * (w.x * w.x + w.y * w.y);
  return uncycled(a, k);
}

/* a + sign Omega r, r the offset. */
AMBULO__INLINE wide3 moved(const ambulo__local_step *step, double sign, local_state s) {
  switch (step->moving) {
  case AMBULO__OFFSET_X:
    return moved_along(s.a, s.w, s.alpha, 0, sign * step->length);
  case AMBULO__OFFSET_Y:
    return moved_along(s.a, s.w, s.alpha, 1, sign * step->length);
  case AMBULO__OFFSET_Z:
    return moved_along(s.a, s.w, s.alpha, 2, sign * step->length);
  case AMBULO__OFFSET_ANY:
    return moved_any(s.a, s.w, s.alpha, scale3(spread(sign), spread3(step->move)));
  default:
    return s.a;
  }
}

AMBULO__INLINE wide3 moved_by_offset(const ambulo__local_step *step, local_state s) {
  return moved(step, 1, s);
}

AMBULO__INLINE wide3 moved_back(const ambulo__local_step *step, local_state s) {
  return moved(step, -1, s);
}

/* n + r x f, r the offset */
AMBULO__INLINE wide3 levered_along(wide3 n, wide3 f, int k, double length) {
  n = cycled(n, k);
  f = cycled(f, k);
  n.x -= length * f.y;
  n.y += length * f.x;
  return uncycled(n, k);
}

AMBULO__INLINE wide3 levered(const ambulo__local_step *step, wide3 n, wide3 f) {
  switch (step->offset) {
  case AMBULO__OFFSET_X:
    return levered_along(n, f, 0, step->length);
  case AMBULO__OFFSET_Y:
    return levered_along(n, f, 1, step->length);
  case AMBULO__OFFSET_Z:
    return levered_along(n, f, 2, step->length);
  case AMBULO__OFFSET_ANY:
    return add_cross3(n, spread3(step->move), f);
  default:
    return n;
  }
}

/* A pair that goes as a motion does, across the offset and the constant turn of a joint. */
AMBULO__INLINE wide_pair offset_down(const ambulo__local_step *step, wide_pair v) {
  /* u + eta x r = u - r x eta */
  v.linear = levered(step, v.linear, scale3(spread(-1), v.angular));
  if (step->turned) {
    v = (wide_pair){into_turn(step->turn, v.angular), into_turn(step->turn, v.linear)};
  }
  return v;
}

#endif
