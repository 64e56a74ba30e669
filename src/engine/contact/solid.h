/* contact/solid.h - capsules keep clear of one another and of what stands around: rows that are not
 * linear.
 *
 * A capsule of a link is all that is within its radius of a segment whose ends are points of the
 * model (model/model_query.h). It keeps D = its radius + the other's radius + a margin away from
 * another capsule's segment, which moves or stands still, or from a box. With V and, of a box, P of
 * contact/segments.h, contact/segment_box.h,
 *
 *     c = sqrt(V) - sqrt(D^2 + W) - P >= 0      m
 *     w_i = eps (length_i^2 + radius_i^2),  W = sum of w_i / 4,  eps = 1e-3
 *
 * w_i of a capsule that stands still is that of the link's, so that it goes with no place.
 *
 * As V - W is at most the squared distance, c >= 0 keeps D indeed; at most W / 2 D more, .5 mm of
 * two shanks. c is about the distance less D, in m. Its slopes are those of V by 2 sqrt(V), and of
 * P: they go on without a jump but where segments cross (V = 0: there they are taken as 0), and
 * inside a box where two ways out are equally long.
 *
 *     dc/dD = -D / sqrt(D^2 + W)
 */
#ifndef AMBULO_CONTACT_SOLID_H
#define AMBULO_CONTACT_SOLID_H

enum { AMBULO__SOLID_CHANNELS = 12 };

typedef enum ambulo__solid_kind {
  AMBULO__SOLID_MOVING,  /* a capsule of another link */
  AMBULO__SOLID_CAPSULE, /* fixed in the world */
  AMBULO__SOLID_BOX      /* fixed in the world */
} ambulo__solid_kind;

typedef struct ambulo__solid {
  ambulo__solid_kind kind;
  int one, other;    /* first channels of the capsules' ends, 6 each; other: of one that moves */
  int about;         /* index of the obstacle; -1: a capsule that moves */
  double radius;     /* of both together, m */
  double distance;   /* D, m */
  double weight[2];  /* w_i, m^2; [1] of a box: 0 */
  double ends[2][3]; /* of a fixed capsule, world, m */
  double center[3], axes[3][3], half[3]; /* of a box: world, m; rows of axes are its directions */
} ambulo__solid;

/* w_i of a capsule of that length and radius, m^2. */
double ambulo__solid_weight(double length, double radius);
/* W. */
double ambulo__solid_excess(const ambulo__solid *solid);

/* The row's value at a node from its channels, channel k at y[k * stride]. Its slopes are added to
 * slope [channels] unless NULL. */
double ambulo__solid_value(const ambulo__solid *solid, const double *y, int stride, double *slope);
/* The channels on which it stands: returns how many of channel[AMBULO__SOLID_CHANNELS]. */
int ambulo__solid_channels(const ambulo__solid *solid, int channel[AMBULO__SOLID_CHANNELS]);
/* What air there is between the two, margin left out, without weights, m; negative: so far is one
 * inside the other. */
double ambulo__solid_gap(const ambulo__solid *solid, const double *y, int stride);
/* Slopes of the value by the obstacle's place, world: of a box by_place[0] by its middle, of a
 * capsule by both its ends; the rest, and all of what moves, 0. */
void ambulo__solid_by_place(const ambulo__solid *solid, const double *y, int stride,
                            double by_place[2][3]);

#endif
