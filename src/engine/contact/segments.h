/* contact/segments.h - how near two segments come to each other, as a smooth function of their
 * ends.
 *
 * Segments from a to b and from c to d, points of them x(s) = a + s (b - a), y(t) = c + t (d - c),
 * 0 <= s, t <= 1, and weights w, v > 0 (m^2):
 *
 *     V = min over s, t of  |x(s) - y(t)|^2 + w (s - 1/2)^2 + v (t - 1/2)^2              m^2
 *
 * Without weights V is the squared distance, but where segments are parallel its nearest points are
 * not unique and jump from one end to the other as the segments turn: its slopes jump too. With
 * them the function of s and t is strictly convex. Its minimum is unique and moves continuously
 * with the ends, so that V has continuous slopes everywhere, crossing and parallel segments
 * included; as at the minimum a change of s and t counts nowhere (envelope theorem), with
 * e = x(s) - y(t)
 *
 *     dV/da = 2 (1 - s) e,  dV/db = 2 s e,  dV/dc = -2 (1 - t) e,  dV/dd = -2 t e
 *
 * And it is next to the squared distance d^2:
 *
 *     d^2 <= V,   V - (w + v) / 4 <= d^2
 */
#ifndef AMBULO_CONTACT_SEGMENTS_H
#define AMBULO_CONTACT_SEGMENTS_H

typedef struct ambulo__segment_nearest {
  double at[2]; /* s, t */
  double e[3];  /* x(s) - y(t), m */
  double value; /* V, m^2 */
} ambulo__segment_nearest;

/* one[0], one[1]: a, b; other: c, d; weight: w, v. They are only read. */
ambulo__segment_nearest ambulo__segments_nearest(double one[2][3], double other[2][3],
                                                 const double weight[2]);

#endif
