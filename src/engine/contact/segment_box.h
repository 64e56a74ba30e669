/* contact/segment_box.h - how far a segment is outside a box, or inside, as a function of its ends.
 *
 * In the box's own axes, origin in its middle, half sizes h: the segment x(s) = a + s (b - a),
 * 0 <= s <= 1, and a weight w > 0 (m^2) as in contact/segments.h. Outside
 *
 *     o(x)_k = x_k - h_k where x_k > h_k,  x_k + h_k where x_k < -h_k,  else 0
 *     V = min over s of  |o(x(s))|^2 + w (s - 1/2)^2                                     m^2
 *
 * is convex, with a unique minimum and continuous slopes, dV/da = 2 (1 - s) o, dV/db = 2 s o;
 * d^2 <= V and V - w / 4 <= d^2 of the distance d. Inside V tells no direction: how deep the
 * segment is in the box is
 *
 *     P = the shortest way that it can be moved to be outside, 0 if it is              m
 *
 * along a normal of a face of the box or one of segment and edge, u x e_k: of these six directions
 * n (separating axes of convex bodies) that with the least overlap. P is continuous, 0 where the
 * segment touches, and its slopes are those of n; where two ways out are equally long they jump. */
#ifndef AMBULO_CONTACT_SEGMENT_BOX_H
#define AMBULO_CONTACT_SEGMENT_BOX_H

typedef struct ambulo__box_nearest {
  double at;    /* s */
  double o[3];  /* o(x(s)), m */
  double value; /* V, m^2 */
} ambulo__box_nearest;

/* ends[0], ends[1]: a, b in the box's axes, m; half: h >= 0; weight: w. */
ambulo__box_nearest ambulo__box_nearest_of(double ends[2][3], const double half[3], double weight);
/* P, m. The way out: a segment's end i that moves by dx makes it shorter by share[i] * (out . dx);
 * set where P > 0. */
double ambulo__box_depth(double ends[2][3], const double half[3], double out[3], double share[2]);

#endif
