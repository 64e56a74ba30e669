/* contact/curved.h - rows that are not linear in the channels of their node. */
#ifndef AMBULO_CONTACT_CURVED_H
#define AMBULO_CONTACT_CURVED_H

/* how near two segments come to each other, as a smooth function of their
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

typedef struct ambulo__segment_nearest {
  double at[2];     /* s, t */
  double e[3];      /* x(s) - y(t), m */
  double value;     /* V, m^2 */
  double square[3]; /* A, C, B: half the second derivatives by s, by t; less that by both, m^2 */
} ambulo__segment_nearest;

/* one[0], one[1]: a, b; other: c, d; weight: w, v. They are only read. */
ambulo__segment_nearest ambulo__segments_nearest(double one[2][3], double other[2][3],
                                                 const double weight[2]);

/* how far a segment is outside a box, or inside, as a function of its ends.
 *
 * In the box's own axes, origin in its middle, half sizes h: the segment x(s) = a + s (b - a),
 * 0 <= s <= 1, and a weight w > 0 (m^2) as in contact/curved.h. Outside
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

typedef struct ambulo__box_nearest {
  double at;     /* s */
  double o[3];   /* o(x(s)), m */
  double value;  /* V, m^2 */
  double square; /* half the second derivative by s, m^2 */
} ambulo__box_nearest;

/* ends[0], ends[1]: a, b in the box's axes, m; half: h >= 0; weight: w. */
ambulo__box_nearest ambulo__box_nearest_of(double ends[2][3], const double half[3], double weight);
/* P, m. The way out: a segment's end i that moves by dx makes it shorter by share[i] * (out . dx);
 * set where P > 0. */
double ambulo__box_depth(double ends[2][3], const double half[3], double out[3], double share[2]);

/* Capsules keep clear of one another and of obstacles: rows that are not linear.
 *
 * A capsule of a link is all that is within its radius of a segment whose ends are points of the
 * model (model/model_query.h). It keeps D = its radius + the other's radius + a margin away from
 * another capsule's segment, which moves or stands still, or from a box. With V and, of a box, P of
 * contact/curved.h, contact/curved.h,
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
 *
 * Where two capsules are nearly parallel, the nearest points run from end to end as they turn, and
 * c is nearly a roof: the less of two distances. That is most of the curvature of c. With
 * n_s = (-e, e; 0, 0) and n_t = (0, 0; e, -e) by the ends a, b; c, d, and A, B, C of capsules.c, s
 * and t following the ends adds to -d2c/dy2
 *
 *     (C n_s n_s' + B (n_s n_t' + n_t n_s') + A n_t n_t') / (|e| (A C - B^2))        1/m
 *
 * and n_s n_s' / (|e| A) where t is at an end or there is none. What is left out is negative, or
 * small.
 *
 * A box in the hands keeps its directions forward, left and up, as its grip does. Its middle is
 * m = o + (h_1 + h_2) / 2 of the hands (o + h of one). With the slopes c_a, c_b by the ends of the
 * capsule that keeps clear of it,
 *
 *     dc/dh_i = -(c_a + c_b) / 2   of two hands, -(c_a + c_b) of one
 *
 * Of the two boxes, of which one is carried, the sum of Minkowski is a box again where they are
 * parallel, and contains it where they are not: half sizes H_k + sum_j |a_k . b_j| h_j, a_k and b_j
 * the axes of both. The carried one is its middle there, a segment without length.
 */

enum { AMBULO__SOLID_CHANNELS = 12 };

typedef enum ambulo__solid_kind {
  AMBULO__SOLID_MOVING,  /* a capsule of another link */
  AMBULO__SOLID_CAPSULE, /* fixed in the world */
  AMBULO__SOLID_BOX,     /* fixed in the world */
  AMBULO__SOLID_HELD,    /* a box in the hands, of which a capsule keeps clear */
  AMBULO__SOLID_CARRIED  /* a box in the hands, which keeps clear of a box fixed in the world */
} ambulo__solid_kind;

typedef struct ambulo__solid {
  ambulo__solid_kind kind;
  int one, other;    /* first channels of the capsules' ends, 6 each; other: of one that moves */
  int hand[2];       /* first channels of the hands of a held box; [1] of one hand: -1 */
  int about;         /* index of the obstacle; -1: what moves, or the ground */
  int held;          /* index of the held box plus 1; 0: none */
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
/* Rows of as many numbers as there are channels, in their order: sum of r r' is the part of
 * -d2c/dy2 named above. Returns how many of rows[2]. */
int ambulo__solid_curvature(const ambulo__solid *solid, const double *y, int stride,
                            double rows[2][AMBULO__SOLID_CHANNELS]);
/* What air there is between the two, margin left out, without weights, m; negative: so far is one
 * inside the other. */
double ambulo__solid_gap(const ambulo__solid *solid, const double *y, int stride);

/* heel and forefoot as arcs that roll on a surface: rows that are not linear.
 *
 * An arc of radius r has its centre C on the foot's link, r above the sole. With the axes f, l, n
 * of the surface (contact/contacts.h), heel and toe centre h, t a length L apart, and the
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
 * Rows:   e0 -+ e >= 0   (m),     a + (e0 F_n -+ F_n d) / (m g) >= 0   (m)
 *
 * What a contact without load is allowed, a0, goes as the load comes:
 *
 *     a = a0 exp(-(F_n / (k m g))^2),   k = .028
 *
 * so that a light contact, whose force hardly moves d, leaves the solve its way, and a loaded one
 * presses under C: with a0 = .2 mm and e0 = .6 mm, within .8 mm from a twentieth of the weight on.
 * An arc that rolls takes power from the ground at the rate F_n d dtheta/dt: d is what makes
 * a ground that stands still do work.
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
  double along, weight, slack; /* f . p, m g; a0, m */
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

/* the cone of dry friction: a row that is not linear.
 *
 * Of the force F of a contact, with n the normal of its surface, W = m g, mu the friction and s a
 * small smoothing, all in body weights:
 *
 *     N = n . F / W,   T = F / W - N n
 *     c = mu N + s - sqrt(|T|^2 + s^2) >= 0
 *
 * The resultant of both directions is limited. The root has continuous slopes where nothing is
 * dragged (T = 0), and c = 0 without force. As sqrt(|T|^2 + s^2) - s <= |T|, c >= 0 allows |T| to
 * exceed mu N by less than s. With e = T / sqrt(|T|^2 + s^2), which is level,
 *
 *     dc/dF = (mu n - e) / W
 *
 * and with L = sqrt(|T|^2 + s^2), a unit vector t along T, and p = n x t, both level,
 *
 *     -d2c/dF2 = (p p' + (s / L)^2 t t') / (L W^2)
 *
 * c is concave; near the tip its curvature is most of what a Lagrangian has.
 */

typedef struct ambulo__cone {
  double up[3];     /* n */
  double friction;  /* mu */
  double smoothing; /* s > 0 */
  double weight;    /* W, N */
  int force;        /* first channel of F */
} ambulo__cone;

/* The row's value at a node from its channels, channel k at y[k * stride]. Its slopes are added to
 * slope [channels] unless NULL. */
double ambulo__cone_value(const ambulo__cone *cone, const double *y, int stride, double *slope);
/* Two rows r of three numbers, by F: the sum of r r' is -d2c/dF2. */
void ambulo__cone_curvature(const ambulo__cone *cone, const double *y, int stride,
                            double rows[2][3]);

enum { AMBULO__CURVED_CHANNELS = AMBULO__SOLID_CHANNELS };

typedef enum ambulo__curved_form {
  AMBULO__CURVED_ARC,   /* of an arc that rolls */
  AMBULO__CURVED_APART, /* of a point and a segment */
  AMBULO__CURVED_SOLID, /* of a capsule and another, or an obstacle */
  AMBULO__CURVED_SPIN,  /* of the root wrench about the centre of mass */
  AMBULO__CURVED_CONE   /* of the force of a contact */
} ambulo__curved_form;

typedef struct ambulo__curved {
  ambulo__curved_form form;
  union {
    ambulo__arc arc;
    ambulo__apart apart;
    ambulo__solid solid;
    ambulo__spin spin;
    ambulo__cone cone;
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
  case AMBULO__CURVED_CONE:
    return ambulo__cone_value(&row->of.cone, y, stride, slope);
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
  int is_cone = row->form == AMBULO__CURVED_CONE;
  for (int i = 0; is_cone && i < 3; i++) channel[i] = row->of.cone.force + i;
  if (is_cone) return 3;
  const ambulo__apart *apart = &row->of.apart;
  const ambulo__spin *spin = &row->of.spin;
  int is_spin = row->form == AMBULO__CURVED_SPIN;
  const int first[3] = {is_spin ? spin->moment : apart->point, is_spin ? spin->force : apart->from,
                        is_spin ? spin->center : apart->to};
  for (int i = 0; i < 9; i++) channel[i] = first[i / 3] + i % 3;
  return 9;
}
/* Rows of slopes by the row's channels, in their order: sum of r r' is the part of -d2c/dy2 that is
 * not negative and large. Returns how many of rows[2]; 0 of forms that have none. */
static inline int ambulo__curved_curvature(const ambulo__curved *row, const double *y, int stride,
                                           double rows[2][AMBULO__CURVED_CHANNELS]) {
  if (row->form == AMBULO__CURVED_SOLID)
    return ambulo__solid_curvature(&row->of.solid, y, stride, rows);
  if (row->form != AMBULO__CURVED_CONE) return 0;
  double bend[2][3];
  ambulo__cone_curvature(&row->of.cone, y, stride, bend);
  for (int i = 0; i < 6; i++) rows[i / 3][i % 3] = bend[i / 3][i % 3];
  return 2;
}

#endif
