/* people/stride.h - the motion as it is shown: whole strides at chosen times.
 *
 * A problem with mirrored ends predicts one step; its mirror image, moved on by the
 * travel and the rise, is the next one. With m the coordinate that takes the place of i:
 *
 *     q_m(T + t) = sign_i q_i(t) + shift_m,   qd_m, qdd_m, tau_m = sign_i (...)_i
 *     zmp(T + t) = zmp - 2 (zmp . l) l + travel f + rise n     (l: left, f: forward, n: up)
 *
 * so that the stride lasts 2 T. Other problems are shown as they are.
 */
#ifndef AMBULO_PEOPLE_STRIDE_H
#define AMBULO_PEOPLE_STRIDE_H

#include "ambulo/problem.h"
#include "problem/nlp.h"

typedef struct ambulo__stride {
  ambulo_allocator allocator;
  const ambulo_problem *problem;
  const ambulo_model *model;
  int mirrored;
  double duration; /* s: T or 2 T */
  int samples, coordinates;
  double *times;              /* [samples], s */
  double *q, *qd, *qdd, *tau; /* [samples][coordinates], rad, m, N m, N; not finite where the
                                 motion is not */
  double *zmp;                /* [samples][3], m; NaN where the body does not press down */
  int feet;                   /* 0 without ground reaction */
  double *grf, *cop;          /* [samples][feet][3], N, m; no centre of pressure (NaN) in the air */
  double *free_moment;        /* [samples][feet], about the normal, N m */
  double *grf_moment;         /* [samples][feet][3], about the world's origin, N m */
  int patches;                /* of the model; 0 unless contacts share the load */
  double *patch_force, *patch_cop, *patch_free_moment,
      *patch_moment; /* likewise, [samples][patches] */
  int devices;
  double *effort, *along, *power; /* [samples][devices]: N m or N; rad or m; W on the body */
  int holds;
  double *hold_force,
      *hold_moment;   /* [samples][holds][2][3], of each hand: N; N m about its point */
  double *hold_power; /* [samples][holds], W */
} ambulo__stride;

/* samples = 0: the time nodes (of both steps); otherwise that many (>= 2) evenly spaced
 * times. Fills *stride, which ambulo__stride_free releases. Errors: E_ARGUMENT, E_MEMORY. */
ambulo_status ambulo__stride_create(const ambulo_problem *problem, const double *x, int samples,
                                    const ambulo_allocator *allocator, ambulo__stride *stride);
void ambulo__stride_free(ambulo__stride *stride); /* accepts a zero-filled one */

/* The contact of an effector (contact/contacts.h) at time t in the stride, where and when it is in
 * the motion itself; NULL if it is in the air. */
const ambulo_contact *ambulo__stride_contact(const ambulo__stride *stride, int effector, double t);

/* The mirror image of a place, one step on; in place. */
void ambulo__stride_mirror_place(const ambulo__stride *stride, double *place);
/* Its parts for the feet (stride_feet.c): arrays, and the mirror image of sample k in place. */
ambulo_status ambulo__stride_feet_allocate(ambulo__stride *stride);
void ambulo__stride_feet_mirror(ambulo__stride *stride, int k);
/* The same for the devices (stride_devices.c). */
ambulo_status ambulo__stride_devices_allocate(ambulo__stride *stride);
void ambulo__stride_devices_mirror(ambulo__stride *stride, int k);

/* Force on a patch at sample k, N. */
const double *ambulo__stride_patch_force(const ambulo__stride *stride, int k, int patch);
/* Its largest size over the samples, in body weights. */
double ambulo__stride_patch_peak(const ambulo__stride *stride, int patch);
/* Force on a foot along `direction` at sample k, in body weights; its largest along the normal. */
double ambulo__stride_force(const ambulo__stride *stride, int k, int foot,
                            const double direction[3]);
double ambulo__stride_peak(const ambulo__stride *stride, int foot);

/* The same for what hands hold (stride_holds.c). */
ambulo_status ambulo__stride_holds_allocate(ambulo__stride *stride);
void ambulo__stride_holds_mirror(ambulo__stride *stride, int k);
/* The largest force and moment of a hand, N and N m, and when. */
typedef struct ambulo__hand_peak {
  double force, force_time, moment, moment_time;
} ambulo__hand_peak;
ambulo__hand_peak ambulo__stride_hand_peak(const ambulo__stride *stride, int hold, int hand);
/* What the hands' forces do to it: positive and negative, J. */
void ambulo__stride_hold_work(const ambulo__stride *stride, int hold, double work[2]);
/* A device over the stride: its effort where it is largest in size, N m or N; the work that it does
 * on the body, and that the body does on it (negative), J. */
typedef struct ambulo__device_work {
  double peak, positive, negative;
} ambulo__device_work;
ambulo__device_work ambulo__stride_device_work(const ambulo__stride *stride, int device);

/* when feet strike, from a problem's schedule. */

typedef struct ambulo__strike {
  int foot;    /* of the model */
  double time; /* s, in the motion as it is shown (people/stride.h) */
} ambulo__strike;

/* A foot strikes where a contact begins that no other contact of the same foot leads to; at the
 * beginning of a periodic or mirrored motion the end of it counts as what came before, and at
 * the beginning of any other motion nobody strikes. A mirrored step is followed by its mirror
 * image. Each strike is listed once, in the order of time: what is one event seen twice (a step's
 * last strike and the mirror image of its first; the end of a motion that repeats and its
 * beginning) stands there a single time, the earlier one.
 *
 * strikes [ambulo__most_strikes(problem)]; returns how many there are. */
int ambulo__most_strikes(const ambulo_problem *problem);
int ambulo__strikes(const ambulo_problem *problem, ambulo__strike *strikes);

#endif
