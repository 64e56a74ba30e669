/* mechanics/kernel_wide.h - the wide type, and vectors and matrices of it.
 *
 * AMBULO__WIDTH (8, 4, 2 or 1) lanes of double make a `wide`, by the vector extension of GCC and
 * Clang: + - * act lane by lane, a scalar operand is spread over the lanes. Memory is always
 * [entry][AMBULO__LANES]; a narrower type works on a part of each block.
 *
 * Included only by the kernels_*.c files, after AMBULO__WIDTH.
 */
#ifndef AMBULO_MECHANICS_KERNEL_WIDE_H
#define AMBULO_MECHANICS_KERNEL_WIDE_H

#include <stdint.h>

#include "mechanics/plan_layout.h"

enum { three = 3 * AMBULO__LANES };

#define AMBULO__INLINE static inline __attribute__((always_inline, unused))

/* Both compilers let a vector alias its element type; were it let alias everything (may_alias),
 * each store would make the plan be read again. */
typedef double wide __attribute__((vector_size(8 * AMBULO__WIDTH)));
typedef int64_t wide_bits __attribute__((vector_size(8 * AMBULO__WIDTH)));

typedef struct wide3 {
  wide x, y, z;
} wide3;

/* By rows. */
typedef struct wide33 {
  wide3 x, y, z;
} wide33;

/* Symmetric. */
typedef struct wide6 {
  wide xx, yy, zz, xy, xz, yz;
} wide6;

/* Motion (angular, linear) or wrench (moment, force) about the world origin. */
typedef struct wide_pair {
  wide3 angular, linear;
} wide_pair;

AMBULO__INLINE wide spread(double value) {
  return value - (wide){0};
}

AMBULO__INLINE wide3 spread3(const double v[3]) {
  return (wide3){spread(v[0]), spread(v[1]), spread(v[2])};
}

AMBULO__INLINE wide load(const double *at) {
  return *(const wide *)at;
}

AMBULO__INLINE void store(double *at, wide value) {
  *(wide *)at = value;
}

AMBULO__INLINE wide root(wide x) {
  wide y;
  for (int lane = 0; lane < AMBULO__WIDTH; lane++) y[lane] = __builtin_sqrt(x[lane]);
  return y;
}

AMBULO__INLINE wide3 load3(const double *at) {
  return (wide3){load(at), load(at + AMBULO__LANES), load(at + 2 * AMBULO__LANES)};
}

AMBULO__INLINE void store3(double *at, wide3 v) {
  store(at, v.x);
  store(at + AMBULO__LANES, v.y);
  store(at + 2 * AMBULO__LANES, v.z);
}

AMBULO__INLINE wide33 load33(const double *at) {
  return (wide33){load3(at), load3(at + 3 * AMBULO__LANES), load3(at + 6 * AMBULO__LANES)};
}

AMBULO__INLINE void store33(double *at, wide33 m) {
  store3(at, m.x);
  store3(at + 3 * AMBULO__LANES, m.y);
  store3(at + 6 * AMBULO__LANES, m.z);
}

AMBULO__INLINE wide6 load6(const double *at) {
  wide3 d = load3(at), o = load3(at + 3 * AMBULO__LANES);
  return (wide6){d.x, d.y, d.z, o.x, o.y, o.z};
}

AMBULO__INLINE void store6(double *at, wide6 m) {
  store3(at, (wide3){m.xx, m.yy, m.zz});
  store3(at + 3 * AMBULO__LANES, (wide3){m.xy, m.xz, m.yz});
}

AMBULO__INLINE wide3 add3(wide3 a, wide3 b) {
  return (wide3){a.x + b.x, a.y + b.y, a.z + b.z};
}

AMBULO__INLINE wide3 sub3(wide3 a, wide3 b) {
  return (wide3){a.x - b.x, a.y - b.y, a.z - b.z};
}

AMBULO__INLINE wide3 scale3(wide s, wide3 a) {
  return (wide3){s * a.x, s * a.y, s * a.z};
}

/* Of a sum of two products a compiler fuses one with the addition, and which one it takes hangs on
 * what else is in the file. rounded() takes the choice away: the product within is rounded by
 * itself, the other one is fused. */
#if defined(__has_builtin)
#if __has_builtin(__builtin_assoc_barrier)
#define rounded(product) __builtin_assoc_barrier(product)
#elif __has_builtin(__arithmetic_fence)
#define rounded(product) __arithmetic_fence(product)
#endif
#endif
#ifndef rounded
#define rounded(product) (product)
#endif

/* a + s b */
AMBULO__INLINE wide3 axpy3(wide3 a, wide s, wide3 b) {
  return (wide3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

AMBULO__INLINE wide dot3(wide3 a, wide3 b) {
  return a.x * b.x + rounded(a.y * b.y) + a.z * b.z;
}

/* c + a . b */
AMBULO__INLINE wide add_dot3(wide c, wide3 a, wide3 b) {
  return ((c + a.x * b.x) + a.y * b.y) + a.z * b.z;
}

/* c - a . b */
AMBULO__INLINE wide subtract_dot3(wide c, wide3 a, wide3 b) {
  return ((c - a.x * b.x) - a.y * b.y) - a.z * b.z;
}

AMBULO__INLINE wide3 cross3(wide3 a, wide3 b) {
  return (wide3){a.y * b.z - rounded(a.z * b.y), a.z * b.x - rounded(a.x * b.z),
                 a.x * b.y - rounded(a.y * b.x)};
}

/* c + a x b */
AMBULO__INLINE wide3 add_cross3(wide3 c, wide3 a, wide3 b) {
  return (wide3){(c.x + a.y * b.z) - a.z * b.y, (c.y + a.z * b.x) - a.x * b.z,
                 (c.z + a.x * b.y) - a.y * b.x};
}

AMBULO__INLINE wide3 multiply33(wide33 m, wide3 v) {
  return (wide3){dot3(m.x, v), dot3(m.y, v), dot3(m.z, v)};
}

/* c + M v */
AMBULO__INLINE wide3 add_multiply33(wide3 c, wide33 m, wide3 v) {
  return (wide3){c.x + m.x.x * v.x + m.x.y * v.y + m.x.z * v.z,
                 c.y + m.y.x * v.x + m.y.y * v.y + m.y.z * v.z,
                 c.z + m.z.x * v.x + m.z.y * v.y + m.z.z * v.z};
}

/* c + M^T v */
AMBULO__INLINE wide3 add_multiply33_transposed(wide3 c, wide33 m, wide3 v) {
  return axpy3(axpy3(axpy3(c, v.x, m.x), v.y, m.y), v.z, m.z);
}

AMBULO__INLINE wide3 multiply6(wide6 m, wide3 v) {
  return (wide3){m.xx * v.x + rounded(m.xy * v.y) + m.xz * v.z,
                 m.xy * v.x + rounded(m.yy * v.y) + m.yz * v.z,
                 m.xz * v.x + rounded(m.yz * v.y) + m.zz * v.z};
}

AMBULO__INLINE wide_pair load_pair(const double *at) {
  return (wide_pair){load3(at), load3(at + three)};
}

AMBULO__INLINE void store_pair(double *at, wide_pair pair) {
  store3(at, pair.angular);
  store3(at + three, pair.linear);
}

/* One chain of multiply-adds: an addition less than the sum of two dot products. */
AMBULO__INLINE wide add_dot_pair(wide c, wide_pair a, wide_pair b) {
  return add_dot3(add_dot3(c, a.angular, b.angular), a.linear, b.linear);
}

AMBULO__INLINE wide dot_pair(wide_pair a, wide_pair b) {
  return add_dot3(dot3(a.angular, b.angular), a.linear, b.linear);
}

/* a + s b */
AMBULO__INLINE wide_pair axpy_pair(wide_pair a, wide s, wide_pair b) {
  return (wide_pair){axpy3(a.angular, s, b.angular), axpy3(a.linear, s, b.linear)};
}

AMBULO__INLINE wide_pair add_pair(wide_pair a, wide_pair b) {
  return (wide_pair){add3(a.angular, b.angular), add3(a.linear, b.linear)};
}

#endif
