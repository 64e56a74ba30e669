/* contact/apart.h - a point stays away from a segment, seen from above: rows that are not linear.
 *
 * With the vertical n, x_ = x - (n . x) n what is level of a vector x, the point p, the segment
 * from a to b, and the distance D to keep,
 *
 *     s = (p - a)_ . (b - a)_ / |(b - a)_|^2,   at least 0, at most 1
 *     e = (p - a)_ - s (b - a)_                  from the nearest point of the segment, m
 *     c = (|e|^2 - D^2) / (2 D) >= 0             m
 *
 * c is |e| - D where they are D apart, and smooth where they touch too. Its slopes go on without
 * a jump: between the ends e is across b - a, at the ends s stays, so that a change of s counts
 * nowhere,
 *
 *     dc/dp = e / D,   dc/da = -(1 - s) e / D,   dc/db = -s e / D
 *     dc/dD = -1 - c / D
 */
#ifndef AMBULO_CONTACT_APART_H
#define AMBULO_CONTACT_APART_H

typedef struct ambulo__apart {
  double up[3];        /* n */
  double distance;     /* D > 0, m */
  int point, from, to; /* first channels: p, a, b */
} ambulo__apart;

/* The row's value at a node from its channels, channel k at y[k * stride]. Its slopes are added to
 * slope [channels] unless NULL. */
double ambulo__apart_value(const ambulo__apart *apart, const double *y, int stride, double *slope);

#endif
