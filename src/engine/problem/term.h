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
 * User terms are functions of a node of the caller's own (problem/callbacks.h).
 */
#ifndef AMBULO_PROBLEM_TERM_H
#define AMBULO_PROBLEM_TERM_H

#include "ambulo/problem.h"
#include "contact/contacts.h"
#include "contact/rows.h"

/* One scalar residual of a term. */
typedef struct ambulo__residual {
  double value, slope, curvature; /* phi, phi', phi'' of u */
} ambulo__residual;

/* phi of each shape at u. */
ambulo__residual ambulo__squared(double u);
ambulo__residual ambulo__absolute(double u, double smoothing);
ambulo__residual ambulo__two_prices(double u, double smoothing, double negative);
/* least: s^p, which no u changes; where only derivatives are looked at, any will do. */
ambulo__residual ambulo__power_law(double u, double power, double smoothing, double least);
double ambulo__power_least(double power, double smoothing);

/* ------------------------------------------------------------------- kinds */

struct ambulo__term_context;
struct ambulo__form;
struct ambulo__muscle_effort;

/* What a residual stands for: decides on its channel, its units and its size in another body.
 * Kinds by coordinate have a residual, a scale and a mirror partner for each coordinate. */
typedef enum ambulo__term_subject {
  AMBULO__TERM_OF_OTHERS = 0, /* not by coordinate */
  AMBULO__TERM_OF_TORQUE,
  AMBULO__TERM_OF_TORQUE_RATE,
  AMBULO__TERM_OF_POWER, /* by body mass */
  AMBULO__TERM_OF_ACCELERATION,
  AMBULO__TERM_OF_POSITION
} ambulo__term_subject;

typedef enum ambulo__term_shape {
  AMBULO__TERM_SQUARED = 0,
  AMBULO__TERM_ABSOLUTE,
  AMBULO__TERM_POWER_LAW
} ambulo__term_shape;

/* Members of ambulo_term that a kind has besides kind, name and weight. */
enum {
  AMBULO__TERM_SCALE = 1,          /* scale; 1 for coordinates that are not named */
  AMBULO__TERM_OFFSET = 1 << 1,    /* offset */
  AMBULO__TERM_REST = 1 << 2,      /* offset and scale, of the coordinates that are named alone */
  AMBULO__TERM_SMOOTHING = 1 << 3, /* smoothing */
  AMBULO__TERM_POWER = 1 << 4,     /* power */
  AMBULO__TERM_CURVES = 1 << 5,    /* passive, strength, strength_is_limits, price */
  AMBULO__TERM_LINE = 1 << 6,      /* point */
  AMBULO__TERM_HEIGHT = 1 << 7,    /* height */
  AMBULO__TERM_DEVICES = 1 << 8,   /* device_scale */
  AMBULO__TERM_REFERENCE = 1 << 9, /* reference */
  AMBULO__TERM_TENDON = 1 << 10,   /* tendon */
  AMBULO__TERM_CALLBACK = 1 << 11, /* function, user: not in files */
  AMBULO__TERM_NEGATIVE = 1 << 12, /* negative */
  AMBULO__TERM_MUSCLES = 1 << 13,  /* activation, metabolic, reserve */
  AMBULO__TERM_MARKS = 1 << 14,    /* marks, mark_scale, mark_reference */
  AMBULO__TERM_LOADS = 1 << 15     /* foot_scale, foot_reference */
};

/* Which two sides have to agree, with mirrored ends (mirror_terms.c). */
typedef enum ambulo__term_mirror {
  AMBULO__MIRROR_NOTHING = 0,
  AMBULO__MIRROR_COORDINATES,
  AMBULO__MIRROR_LINE,
  AMBULO__MIRROR_DEVICES
} ambulo__term_mirror;

/* A kind of term: all that readers, checks, evaluation and the solver ask about it. */
typedef struct ambulo__term_info {
  const char *name; /* in problem files and reports */
  ambulo__term_subject subject;
  ambulo__term_shape shape;
  int members;             /* AMBULO__TERM_SCALE | ... */
  double smoothing, power; /* usual ones; 0: 1 and 2 */
  int is_rate;             /* residuals are those of intervals, not of nodes */
  int weight_is_length;    /* the weight is as large as the body is long (problem/definition.h)
                            */
  /* Of composite kinds: how many residuals there are at a node, and one of them. */
  int (*forms)(const ambulo_term *term, const struct ambulo__term_context *context);
  void (*form)(const ambulo_term *term, const struct ambulo__term_context *context, int node, int j,
               struct ambulo__form *form);
  /* Of kinds that are no sum over residuals: value and slopes as in ambulo__term_value. Their forms
   * have a curvature alone, u = 0. */
  double (*whole)(struct ambulo_workspace *workspace, const ambulo_term *term, double factor,
                  double *slopes);
  ambulo__term_mirror mirror; /* what mirrored ends ask of it */
  const char *(*lacks)(
      const ambulo_problem_definition *definition); /* what it needs; NULL: nothing */
} ambulo__term_info;
const ambulo__term_info *ambulo__term_info_of(ambulo_term_kind kind); /* NULL if unknown */
/* 1 if the kind of a term has the member. */
int ambulo__term_has(const ambulo_term *term, int member);
/* The member with what the term follows at the nodes, and how many numbers that is for each node of
 * this model; NULL: its kind follows nothing. */
const double **ambulo__term_reference(ambulo_term *term, const ambulo_model *model, size_t *width);
/* 1 if it follows something. */
int ambulo__term_follows(const ambulo_term *term);

/* ------------------------------------------------------------ simple terms */

/* 1 if every residual stands on one channel: the next four serve then. */
int ambulo__term_is_simple(const ambulo_term *term);
/* The residual of `term` on coordinate i: its channel, scale, offset at node k. `lean`: what rests
 * have beside their angles (ambulo_problem.lean). */
int ambulo__term_channel(const ambulo_term *term, const ambulo__channels *channels, int i);
double ambulo__term_scale(const ambulo_term *term, int i);
double ambulo__term_offset(const ambulo_term *term, const double *lean, int coordinates, int node,
                           int i);
ambulo__residual ambulo__term_residual(const ambulo_term *term, double u);
/* The same with what phi(0) = 0 takes away, found once for all residuals of a term; where only
 * derivatives are looked at, any will do. */
ambulo__residual ambulo__term_residual_from(const ambulo_term *term, double least, double u);
double ambulo__term_least(const ambulo_term *term);

/* Simple terms at a whole block. Residuals u[8] on coordinate i from the channel
 * y[8] of the nodes from `node` on; beyond the last of `nodes` whatever the padding gives
 * (tracking: 0), which the caller weighs with zero. */
void ambulo__term_lanes(const ambulo_term *term, const double *lean, int coordinates, int node,
                        int nodes, int i, const double *y, double *u);
/* phi and phi' of eight residuals; `least` as above. */
void ambulo__term_shapes(const ambulo_term *term, double least, const double *u, double *value,
                         double *slope);

/* --------------------------------------------------------- composite terms */

/* A residual u and its slopes. Channels may stand on the next node as well (torque
 * rate); ahead[c] is 0 for the node itself, 1 for the next. */
enum { AMBULO__FORM_CHANNELS = 12 }; /* forces and moments of two slots */
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
  const struct ambulo__muscle_effort *muscles; /* NULL: no such term */
  const ambulo__slots *slots;                  /* of ground reaction */
  const double *ground; /* [blocks][3 + 4 slots][8]: their weights and centres */
} ambulo__term_context;

/* 1 if its residuals are those of the interval between a node and the next. */
int ambulo__term_is_rate(const ambulo_term *term);
/* Residuals at one node (0 at nodes where the term says nothing). */
int ambulo__term_forms(const ambulo_term *term, const ambulo__term_context *context, int node);
/* Residual j of `term` at `node`. */
void ambulo__term_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                       int j, ambulo__form *form);

/* the length of upright lines, m: the distance of two points at q = 0 */
double ambulo__upright_length(const ambulo_model *model, const int point[2]);
/* The part of a node's time that a foot is in the air: of the half intervals before and after. */
double ambulo__air_part(const ambulo__term_context *context, int node, int foot);
/* Whose height residual j of the clearance term is. */
int ambulo__clearance_foot(int j);

/* Value of a channel at a node; adds a channel with a slope to a form. A form that is full has no
 * value any more, u is NaN: a term that outgrows it fails loudly. */
double ambulo__frame_value(const ambulo__term_context *context, int node, int channel);
void ambulo__form_add(ambulo__form *form, int channel, int ahead, double slope);

/* Passive torque b1 exp(k1 q) + b2 exp(k2 q) and its derivative. */
double ambulo__passive_torque(const double curve[4], double q, double *derivative);
/* Isometric strength peak cos(c2 (q - c3)), kept above a tenth of the peak. */
double ambulo__strength(const double curve[3], double q, double *derivative);

/* ------------------------------------------- the two sides of the body (mirror_terms.c) */

/* With mirrored ends: what a term asks of a coordinate or a line, it or another term asks of the
 * mirror partner. Left alone are references of tracking terms and what a reference lacks on one
 * side (they are about one step), and user terms. E_PROBLEM, each difference with both names and
 * numbers; E_MEMORY. */
ambulo_status ambulo__mirror_terms_check(const ambulo_problem_definition *definition,
                                         const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics);

#endif
