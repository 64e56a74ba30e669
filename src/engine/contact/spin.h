/* contact/spin.h - how fast the angular momentum of the body about its centre of mass changes: rows
 * that are not linear.
 *
 * Of the root wrench, the moment M about the world origin and the force F, both without the pull of
 * gravity, and the centre of mass r, along a unit axis a, W = m g:
 *
 *     c = b + s a . (M - r x F) / W                m, s = -1 or 1, b the bound
 *
 * With a . (r x F) = F . (a x r) = r . (F x a) the slopes are
 *
 *     dc/dM = s a / W,   dc/dF = -s (a x r) / W,   dc/dr = -s (F x a) / W                      */
#ifndef AMBULO_CONTACT_SPIN_H
#define AMBULO_CONTACT_SPIN_H

typedef struct ambulo__spin {
  double axis[3];            /* a */
  double sign, bound;        /* s; b, m */
  double weight;             /* W, N */
  int moment, force, center; /* first channels: M, F, r */
} ambulo__spin;

/* The row's value at a node from its channels, channel k at y[k * stride]. Its slopes are added to
 * slope [channels] unless NULL. */
double ambulo__spin_value(const ambulo__spin *spin, const double *y, int stride, double *slope);

#endif
