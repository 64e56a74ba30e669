/* problem/term.h - objective terms as functions of channels.
 *
 * A term is a sum over nodes of scalar functions phi of residuals u:
 *
 *     J_term = weight * sum_k w_k sum_j phi(u_jk),    w_k trapezoidal, s
 *
 * Simple terms have one residual per coordinate, u = scale (channel - offset); their
 * gradient and (Gauss-Newton) curvature are diagonal in channel space:
 *     slope = weight w_k phi'(u) scale,   curvature = weight w_k phi''(u) scale^2 >= 0.
 * Composite terms have residuals in several channels, given with their slopes du/dchannel
 * as an ambulo__form; curvature then is weight w_k phi''(u) g g' with g = grad u.
 *
 * phi'' of a smoothed absolute value is replaced by phi'(u)/u, the curvature of the
 * quadratic that majorizes it (iteratively reweighted least squares).
 *
 * User terms are functions of a node of the caller's own (problem/user_term.h).
 *
 * Reading order: term.h, term.c, shapes.c, term_lanes.c; form.c and one composite term:
 * ground_force.c; strength.c with joint_curves.c.
 */
#ifndef AMBULO_PROBLEM_TERM_H
#define AMBULO_PROBLEM_TERM_H

#include "ambulo/problem.h"
#include "contact/channels.h"

/* One scalar residual of a term. */
typedef struct ambulo__residual {
  double value, slope, curvature; /* phi, phi', phi'' of u */
} ambulo__residual;

/* phi of each shape at u. */
ambulo__residual ambulo__squared(double u);
ambulo__residual ambulo__absolute(double u, double smoothing);
/* least: s^p, which no u changes; where only derivatives are looked at, any will do. */
ambulo__residual ambulo__power_law(double u, double power, double smoothing, double least);
double ambulo__power_least(double power, double smoothing);

/* What the evaluation needs to know about a term. */
typedef struct ambulo__term_info {
  const char *name; /* as written in problem files */
  int uses_tau, uses_qdd, uses_q;
} ambulo__term_info;
const ambulo__term_info *ambulo__term_info_of(ambulo_term_kind kind); /* NULL if unknown */

/* ------------------------------------------------------------ simple terms */

/* 1 if every residual stands on one channel: the next four serve then. */
int ambulo__term_is_simple(const ambulo_term *term);
/* The residual of `term` on coordinate i: its channel, scale, offset at node k. */
int ambulo__term_channel(const ambulo_term *term, const ambulo__channels *channels, int i);
double ambulo__term_scale(const ambulo_term *term, int i);
double ambulo__term_offset(const ambulo_term *term, int coordinates, int node, int i);
ambulo__residual ambulo__term_residual(const ambulo_term *term, double u);
/* The same with what phi(0) = 0 takes away, found once for all residuals of a term; where only
 * derivatives are looked at, any will do. */
ambulo__residual ambulo__term_residual_from(const ambulo_term *term, double least, double u);
double ambulo__term_least(const ambulo_term *term);

/* Simple terms at a whole block (term_lanes.c). Residuals u[8] on coordinate i from the channel
 * y[8] of the nodes from `node` on; beyond the last of `nodes` whatever the padding gives
 * (tracking: 0), which the caller weighs with zero. */
void ambulo__term_lanes(const ambulo_term *term, int coordinates, int node, int nodes, int i,
                        const double *y, double *u);
/* phi and phi' of eight residuals; `least` as above. */
void ambulo__term_shapes(const ambulo_term *term, double least, const double *u, double *value,
                         double *slope);

/* --------------------------------------------------------- composite terms */

/* A residual u and its slopes. Channels may stand on the next node as well (torque
 * rate); ahead[c] is 0 for the node itself, 1 for the next. */
enum { AMBULO__FORM_CHANNELS = 8 };
typedef struct ambulo__form {
  double u;
  double difference; /* the part of u that is a difference of nodes over their interval's length */
  int count;
  int channel[AMBULO__FORM_CHANNELS];
  int ahead[AMBULO__FORM_CHANNELS];
  double slope[AMBULO__FORM_CHANNELS];
} ambulo__form;

/* Where a composite term finds its channels. */
typedef struct ambulo__term_context {
  const ambulo_model *model;
  ambulo__channels channels;
  int channel_count;
  const double *lanes; /* [blocks][channels][8], base/lanes.h */
  int nodes;
  const double *times; /* [nodes], s */
  const int *active;   /* [nodes][feet]: contact, or -1 in the air */
  const int *before;   /* the same just before each node, on grids on events; NULL: as active */
  double ground_height;
} ambulo__term_context;

/* 1 if its residuals are those of the interval between a node and the next. */
int ambulo__term_is_rate(const ambulo_term *term);
/* Residuals at one node (0 at nodes where the term says nothing). */
int ambulo__term_forms(const ambulo_term *term, const ambulo__term_context *context, int node);
/* Residual j of `term` at `node`. */
void ambulo__term_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                       int j, ambulo__form *form);

/* The pieces, one file each. */
void ambulo__mechanical_power_form(const ambulo_term *term, const ambulo__term_context *context,
                                   int node, int i, ambulo__form *form);
/* the length of upright lines, m: the distance of two points at q = 0 */
double ambulo__upright_length(const ambulo_model *model, const int point[2]);
void ambulo__upright_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                          int j, ambulo__form *form);
void ambulo__ground_force_form(const ambulo__term_context *context, int node, int axis,
                               ambulo__form *form);
int ambulo__clearance_forms(const ambulo__term_context *context);
/* The part of a node's time that a foot is in the air: of the half intervals before and after. */
double ambulo__air_part(const ambulo__term_context *context, int node, int foot);
/* Whose height residual j of the clearance term is. */
int ambulo__clearance_foot(int j);
void ambulo__clearance_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                            int j, ambulo__form *form);
void ambulo__torque_rate_form(const ambulo_term *term, const ambulo__term_context *context,
                              int node, int i, ambulo__form *form);
void ambulo__strength_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                           int i, ambulo__form *form);

int ambulo__device_effort_forms(const ambulo__term_context *context);
void ambulo__device_effort_form(const ambulo_term *term, const ambulo__term_context *context,
                                int node, int i, ambulo__form *form);
int ambulo__force_rate_forms(const ambulo__term_context *context, int node);
void ambulo__force_rate_form(const ambulo__term_context *context, int node, int j,
                             ambulo__form *form);

/* Value of a channel at a node; adds a channel with a slope to a form. A form that is full has no
 * value any more, u is NaN: a term that outgrows it fails loudly. */
double ambulo__frame_value(const ambulo__term_context *context, int node, int channel);
void ambulo__form_add(ambulo__form *form, int channel, int ahead, double slope);

/* Passive torque b1 exp(k1 q) + b2 exp(k2 q) and its derivative (joint_curves.c). */
double ambulo__passive_torque(const double curve[4], double q, double *derivative);
/* Isometric strength peak cos(c2 (q - c3)), kept above a tenth of the peak. */
double ambulo__strength(const double curve[3], double q, double *derivative);

#endif
