/* contact/arc.h - heel and forefoot as arcs that roll on a surface: rows that are not linear.
 *
 * An arc of radius r has its centre C on the foot's link, r above the sole. With the axes f, l, n
 * of the surface (contact/contact_frame.h), heel and toe centre h, t a length L apart, and the
 * foot's pitch above the surface theta (toes up),
 *
 *     theta = asin(n . (t - h) / L)
 *     e = f . C - c + r theta                              m
 *
 * is how far C is from where rolling without slip has it; c: of the flat foot. Of the force F and
 * the moment M about a point p that the arc carries, F_n = n . F, the centre of pressure is ahead
 * of C by d,
 *
 *     F_n d = -l . M + F_n f . (p - C)                     N m
 *
 * Rows:   e0 -+ e >= 0   (m),     a + (e0 F_n -+ F_n d) / (m g) >= 0   (m), a the slack
 *
 * asin goes on as its tangent beyond a sine of .97, which no foot on the ground has. */
#ifndef AMBULO_CONTACT_ARC_H
#define AMBULO_CONTACT_ARC_H

enum { AMBULO__ARC_CHANNELS = 9 };

typedef struct ambulo__arc {
  double sign, room; /* -1 or 1; e0, m */
  double radius, length;
  double forward[3], left[3], up[3];
  double flat;                 /* c */
  int center, heel, toe;       /* first channels: C, h, t */
  int force, moment;           /* of a row on the centre of pressure: F, M; else -1 */
  double along, weight, slack; /* f . p, m g; m */
} ambulo__arc;

/* The row's value at a node from its channels, channel k at y[k * stride]. Its slopes are added to
 * slope [channels] unless NULL. */
double ambulo__arc_value(const ambulo__arc *arc, const double *y, int stride, double *slope);
/* The channels on which it stands: returns how many of channel[AMBULO__ARC_CHANNELS]. */
int ambulo__arc_channels(const ambulo__arc *arc, int channel[AMBULO__ARC_CHANNELS]);

#endif
