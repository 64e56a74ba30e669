/* contact/curved.h - rows that are not linear in the channels of their node. */
#ifndef AMBULO_CONTACT_CURVED_H
#define AMBULO_CONTACT_CURVED_H

#include "contact/capsules.h"

/* heel and forefoot as arcs that roll on a surface: rows that are not linear.
 *
 * An arc of radius r has its centre C on the foot's link, r above the sole. With the axes f, l, n
 * of the surface (contact/foot.h), heel and toe centre h, t a length L apart, and the
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

/* a point stays away from a segment, seen from above: rows that are not linear.
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

typedef struct ambulo__apart {
  double up[3];        /* n */
  double distance;     /* D > 0, m */
  int point, from, to; /* first channels: p, a, b */
} ambulo__apart;

/* The row's value at a node from its channels, channel k at y[k * stride]. Its slopes are added to
 * slope [channels] unless NULL. */
double ambulo__apart_value(const ambulo__apart *apart, const double *y, int stride, double *slope);

/* how fast the angular momentum of the body about its centre of mass changes: rows
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

typedef struct ambulo__spin {
  double axis[3];            /* a */
  double sign, bound;        /* s; b, m */
  double weight;             /* W, N */
  int moment, force, center; /* first channels: M, F, r */
} ambulo__spin;

/* The row's value at a node from its channels, channel k at y[k * stride]. Its slopes are added to
 * slope [channels] unless NULL. */
double ambulo__spin_value(const ambulo__spin *spin, const double *y, int stride, double *slope);

enum { AMBULO__CURVED_CHANNELS = AMBULO__SOLID_CHANNELS };

typedef enum ambulo__curved_form {
  AMBULO__CURVED_ARC,   /* of an arc that rolls */
  AMBULO__CURVED_APART, /* of a point and a segment */
  AMBULO__CURVED_SOLID, /* of a capsule and another, or an obstacle */
  AMBULO__CURVED_SPIN   /* of the root wrench about the centre of mass */
} ambulo__curved_form;

typedef struct ambulo__curved {
  ambulo__curved_form form;
  union {
    ambulo__arc arc;
    ambulo__apart apart;
    ambulo__solid solid;
    ambulo__spin spin;
  } of;
} ambulo__curved;

/* The row's value at a node from its channels, channel k at y[k * stride]. Its slopes are added to
 * slope [channels] unless NULL. */
static inline double ambulo__curved_value(const ambulo__curved *row, const double *y, int stride,
                                          double *slope) {
  switch (row->form) {
  case AMBULO__CURVED_ARC:
    return ambulo__arc_value(&row->of.arc, y, stride, slope);
  case AMBULO__CURVED_SOLID:
    return ambulo__solid_value(&row->of.solid, y, stride, slope);
  case AMBULO__CURVED_SPIN:
    return ambulo__spin_value(&row->of.spin, y, stride, slope);
  case AMBULO__CURVED_APART:
    break;
  }
  return ambulo__apart_value(&row->of.apart, y, stride, slope);
}
/* The channels on which it stands: returns how many of channel[AMBULO__CURVED_CHANNELS]. */
static inline int ambulo__curved_channels(const ambulo__curved *row,
                                          int channel[AMBULO__CURVED_CHANNELS]) {
  if (row->form == AMBULO__CURVED_ARC) return ambulo__arc_channels(&row->of.arc, channel);
  if (row->form == AMBULO__CURVED_SOLID) return ambulo__solid_channels(&row->of.solid, channel);
  const ambulo__apart *apart = &row->of.apart;
  const ambulo__spin *spin = &row->of.spin;
  int is_spin = row->form == AMBULO__CURVED_SPIN;
  const int first[3] = {is_spin ? spin->moment : apart->point, is_spin ? spin->force : apart->from,
                        is_spin ? spin->center : apart->to};
  for (int i = 0; i < 9; i++) channel[i] = first[i / 3] + i % 3;
  return 9;
}

#endif
