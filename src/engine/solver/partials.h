/* solver/partials.h - what the best objective does when a number of the problem changes.
 *
 * At a solution x* with multipliers lambda the envelope theorem (Fiacco 1976; Boyd & Vandenberghe,
 * Convex Optimization, 5.6) gives the change of the least objective f* with a number p of the
 * problem, without another solve:
 *
 *     df* / dp = dL(x*, lambda; p) / dp,     L = f(x; p) - sum_r lambda_r c_r(x; p)
 *
 * for rows c_r = 0 and c_r >= 0, lambda_r >= 0 of the latter. With the channels y(x; p) of
 * contact/channels.h and their adjoints w = dL/dy (problem/gradient.h), whose rows have the weights
 * -lambda_r,
 *
 *     dL / dp = df/dp | y - sum_r lambda_r dc_r/dp | y + sum w dy/dp | x
 *
 * Each file of this folder adds one of these parts to the partials of the members of the
 * problem's definition; parameters.c makes of them what a file's keys say. All by hand.
 *
 * Reading order: partials.h, partials.c; surface.h, surface.c, step_rows.h, step_rows.c,
 * place_rows.c; force_rows.c, support_side.c; devices.c, holds.c; contact_pull.h, contact_times.c,
 * sharing_rows.c; bound_rows.c; body_rows.c; terms.c; node_forces.h, node_forces.c, inertia.c,
 * contact_split.h, contact_forces.c, contact_told.c, node_pull.c; duration.c;
 * event_rates.h, event_rates.c, event_times.c; parameters.h, parameter_list.c, parameters.c,
 * walk_parameters.c, time_parameters.c, device_parameters.c, hold_parameters.c,
 * term_parameters.c, words.c,
 * sensitivities.c.
 */
#ifndef AMBULO_SOLVER_PARTIALS_H
#define AMBULO_SOLVER_PARTIALS_H

#include "contact/foot_outline.h"
#include "linear/pool.h"
#include "problem/nlp.h"

/* Numbers of a device, in this order. */
enum {
  AMBULO__DEVICE_STIFFNESS,
  AMBULO__DEVICE_REST,
  AMBULO__DEVICE_PRETENSION,
  AMBULO__DEVICE_SMOOTHING,
  AMBULO__DEVICE_DAMPING,
  AMBULO__DEVICE_AMOUNT,
  AMBULO__DEVICE_FROM,
  AMBULO__DEVICE_TO,
  AMBULO__DEVICE_RAMP,
  AMBULO__DEVICE_NUMBERS
};

/* Numbers of what hands hold, in this order. */
enum {
  AMBULO__HOLD_MASS,
  AMBULO__HOLD_INERTIA,
  AMBULO__HOLD_CENTER,    /* along forward, left and up */
  AMBULO__HOLD_FORCE = 5, /* likewise */
  AMBULO__HOLD_FROM = 8,
  AMBULO__HOLD_TO,
  AMBULO__HOLD_RAMP,
  AMBULO__HOLD_NUMBERS
};

/* dL/dp of the members of a definition of the same names, per their SI units (those of J and of a
 * row's multiplier in it). Members that are no numbers are unused. */
typedef struct ambulo__partials {
  double *place;          /* [contacts][2]: footholds, along forward and left */
  double *rise, *heading; /* [contacts]: of the place along up, m; rad */
  double *normal;         /* [contacts][3]: of a normal that is given */
  double *limit;      /* [3][d][2]: by ambulo__limited_place, of a coordinate that is not fixed */
  double *end_value;  /* [end_value_count] */
  double *half_width; /* [tubes][d] */
  double *weight, *height; /* [terms] */
  double *scale, *offset;  /* [terms][d] */
  double *strength;        /* [terms][d][2]: of the peaks */
  double *tendon;          /* [terms][d] */
  double *price;           /* [terms][d][2]: of prices of negative, positive torque */
  double travel, end_rise, ground_height; /* m */
  double duration;                        /* s; contacts and breakpoints at fixed fractions of it */
  double support_margin, minimum_force;
  double contact_tolerance, orientation_tolerance, strike_pitch[2];
  ambulo_clearance clearance;
  ambulo_ground_reaction reaction;
  double slope;         /* rad: gravity turned against forward, its size kept */
  double *node_time;    /* [nodes], s: of a node alone */
  double *contact_time; /* [contacts][2], s: of from and to alone, nodes where they are; of
                           contacts that begin and end at one time any may have all of it */
  int events;           /* 0 where the grid is not on events */
  double *event_time;   /* [events], s: where contacts begin and end, inside (0, T) */
  double *event;        /* [events]: of an event, with all contacts, nodes and knots that go along;
                           NaN where something else is there at the same time */
  double of_others;     /* dL/d ln of what torques and forces would have more of, were all as large
                           as the bodies' masses: what devices do for the person, less what is
                           held */
  double *device;       /* [devices][AMBULO__DEVICE_NUMBERS] */
  double *hold;         /* [holds][AMBULO__HOLD_NUMBERS]; NaN: a time that has none */
  double log_mass;      /* of the mass m wherever it stands in rows and terms, torques left out:
                           dL/d ln m */
  double body;          /* dL/d ln of the mass of all bodies but the loads, in every place */
  double collision_margin, *obstacle_margin; /* m; [obstacles] */
  double *obstacle_place; /* [obstacles][2][3]: of a box's middle, of a capsule's two ends; along
                             forward, left and up */
  double *reach_place, *reach_tolerance; /* [reaches][3], [reaches] */
  double load[AMBULO__MOST_LOADS];       /* kg: of ambulo_model.loads */
} ambulo__partials;

static inline int ambulo__limited_place(ambulo_limited what) {
  return (int)what - (int)AMBULO_LIMITED_POSITION;
}

/* A solution: x* is the point that the workspace holds. */
typedef struct ambulo__stationary {
  const ambulo_problem *problem;
  ambulo_workspace *workspace;
  const double *multiplier; /* [rows] */
} ambulo__stationary;

/* Memory from `pool`; zero. E_MEMORY. */
ambulo_status ambulo__partials_create(const ambulo_problem *problem, ambulo__pool *pool,
                                      ambulo__partials *partials);
/* All of them, at a point that need not be optimal: then they are those of L, not of f*. The
 * workspace's adjoints are used up. E_MEMORY; E_NUMERIC if the point has no finite values. */
ambulo_status ambulo__partials_at(const ambulo_problem *problem, ambulo_workspace *workspace,
                                  const double *x, const double *multiplier, ambulo__pool *pool,
                                  ambulo__partials *partials);

/* The pieces, one file each; what the rows say of themselves. */
void ambulo__partials_of_places(const ambulo__stationary *s, ambulo__partials *partials);
ambulo_status ambulo__partials_of_forces(const ambulo__stationary *s, ambulo__partials *partials);
void ambulo__partials_of_bounds(const ambulo__stationary *s, ambulo__partials *partials);
void ambulo__partials_of_bodies(const ambulo__stationary *s, ambulo__partials *partials);
void ambulo__partials_of_terms(const ambulo__stationary *s, ambulo__partials *partials);
/* 1: the offset of coordinate i is the body weight, whose pull that of the mass has. */
int ambulo__offset_is_weight(const ambulo_problem *problem, const ambulo_term *term, int i);
/* Through torques and forces; needs the adjoints of the channels, and log_mass. */
ambulo_status ambulo__partials_of_inertia(const ambulo__stationary *s, ambulo__pool *pool,
                                          ambulo__partials *partials);
/* Through efforts and torques; needs the adjoints of the channels. E_MEMORY. */
ambulo_status ambulo__partials_of_devices(const ambulo__stationary *s, ambulo__pool *pool,
                                          ambulo__partials *partials);
/* Through forces of hands; needs the adjoints of the channels. E_MEMORY. */
ambulo_status ambulo__partials_of_holds(const ambulo__stationary *s, ambulo__pool *pool,
                                        ambulo__partials *partials);
/* After the others: leaves the adjoints of q, qd, qdd with the mechanics' part in them. */
void ambulo__partials_of_duration(const ambulo__stationary *s, ambulo__partials *partials);

/* Places and heights that have none, without a solution: NaN. */
void ambulo__partials_name_places(const ambulo_problem *problem, ambulo__partials *partials);
/* The events alone, without a solution: 0 where there is a derivative. E_MEMORY. */
ambulo_status ambulo__partials_name_events(const ambulo_problem *problem, ambulo__pool *pool,
                                           ambulo__partials *partials);
/* Last: nodes, knots and contacts with the events. E_MEMORY. */
ambulo_status ambulo__partials_of_events(const ambulo__stationary *s, ambulo__pool *pool,
                                         ambulo__partials *partials);

/* A side of a support region displaced: adds dc/d(place) of a row on it to the contacts' places,
 * times pull. */
typedef struct ambulo__support_row {
  int node, before; /* of the row */
  int turns;        /* 1: a side of a hull, which turns when its ends move apart */
  double normal[2]; /* inwards */
  double force;     /* n.F / m g */
  double moment[2]; /* zero-moment point times `force`, along forward and left, m */
} ambulo__support_row;
void ambulo__support_side(const ambulo__stationary *s, const ambulo__foot_outline *outlines,
                          const ambulo__support_row *row, double pull, ambulo__partials *partials);

/* A channel of the contact that a row of its force, pressure or free moment stands on; -1: an arc
 * that rolls. */
int ambulo__sharing_channel(const ambulo_problem *problem, const ambulo__table_row *row);
/* A row of a contact that shares the load, times pull; `weight` m g, N. */
void ambulo__partials_of_sharing(const ambulo__stationary *s, const ambulo__foot_outline *outlines,
                                 const ambulo__table_row *row, double pull, double weight,
                                 ambulo__partials *partials);

/* What the feet do that a row at a node speaks of: [feet], contacts or -1. */
static inline const int *ambulo__stationary_contacts(const ambulo__stationary *s, int node,
                                                     int before) {
  const ambulo_problem *p = s->problem;
  return (before ? p->before : p->active) + (size_t)node * (size_t)p->model->foot_count;
}
static inline double ambulo__stationary_channel(const ambulo__stationary *s, int node,
                                                int channel) {
  const ambulo_workspace *w = s->workspace;
  return w->channel[ambulo__lane_index(node, w->channel_count, channel)];
}
/* dL/dy of a channel at a node. */
static inline double ambulo__stationary_adjoint(const ambulo__stationary *s, int node,
                                                int channel) {
  const ambulo_workspace *w = s->workspace;
  return w->weight[ambulo__lane_index(node, w->channel_count, channel)];
}
/* Three channels from `first` on at a node, along a direction. */
static inline double ambulo__stationary_along(const ambulo__stationary *s, int node, int first,
                                              const double direction[3]) {
  double sum = 0.0;
  for (int i = 0; i < 3; i++) sum += direction[i] * ambulo__stationary_channel(s, node, first + i);
  return sum;
}

#endif
