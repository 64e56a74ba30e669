/* contact/devices.h - the devices of a problem, compiled: their efforts at the nodes, what they add
 * to torques, and their derivatives (ambulo/device.h has the laws).
 *
 * d coordinates, n devices. Of one device s is the coordinate or length that it acts along, sd its
 * rate, E(s, sd) its effort, and g = 1 at a joint, -1 between points. The torques of the person
 * lose Q_i = g E s_i with s_i = ds/dq_i, not zero for the coordinates of its path: one at a joint,
 * between points those that move one of the points but not the other.
 *
 * Derivatives, with s_ij = d2s/dq_i dq_j, sd = sum s_i qd_i, a dot on s_i for sum_j s_ij qd_j:
 *
 *     dQ_i/dq_j  = g ((E_s s_j + E_sd s_j.) s_i + E s_ij),    dQ_i/dqd_j = g E_sd s_i s_j
 *     dE/dq_j    = E_s s_j + E_sd s_j.,                       dE/dqd_j   = E_sd s_j
 *
 * E s_ij is the stiffness that geometry makes of a force. For weights y on the torques and e on the
 * effort, with z = sum y_i s_i the virtual rate of s and c = e - g z,
 *
 *     gq_j  += c (E_s s_j + E_sd s_j.) - g E sum_i y_i s_ij,    gqd_j += c E_sd s_j
 *
 * Time enters through one factor a device, its window times its profile (load_profile.c).
 */
#ifndef AMBULO_CONTACT_DEVICES_H
#define AMBULO_CONTACT_DEVICES_H

#include "ambulo/problem.h"
#include "base/alloc.h"
#include "base/diagnostics.h"
#include "base/lanes.h"
#include "mechanics/plan.h"

typedef struct ambulo__devices ambulo__devices;

/* Of a checked definition, whose devices must outlive them. *devices is NULL where it has none.
 * E_MEMORY. */
ambulo_status ambulo__devices_create(const ambulo_problem_definition *definition,
                                     const ambulo_allocator *allocator, ambulo__devices **devices);
void ambulo__devices_free(ambulo__devices *devices); /* accepts NULL */

/* Doubles that apply and reverse need to work with; what is kept of a node for its derivatives. */
size_t ambulo__devices_scratch(const ambulo__devices *devices);
size_t ambulo__devices_entries(const ambulo__devices *devices);

/* One block of nodes. q, qd, tau: [d][lanes]; told: [n][lanes]; effort: [n][lanes]. Takes the
 * devices' torques off tau, sets their efforts. */
void ambulo__devices_apply(const ambulo__devices *devices, const double *q, const double *qd,
                           const double *told, double *tau, double *effort, double *scratch);
/* Takes them off tau, and adds to gq and gqd [d][lanes] what weights on what is left and on the
 * efforts come to. */
typedef struct ambulo__device_adjoints {
  const double *tau, *effort; /* [d][lanes], [n][lanes] */
  double *q, *qd;             /* [d][lanes] */
} ambulo__device_adjoints;
void ambulo__devices_reverse(const ambulo__devices *devices, const double *q, const double *qd,
                             const double *told, double *tau,
                             const ambulo__device_adjoints *adjoints, double *scratch);

/* What the derivatives of one node are made of, kept[entries]; arrays as above, from its lane on.
 */
void ambulo__devices_keep(const ambulo__devices *devices, const double *q, const double *qd,
                          const double *told, double *kept);
/* Adds to gradient[2 or more][d], by q and qd, those of tau of a coordinate, of an effort. */
void ambulo__devices_add_torque(const ambulo__devices *devices, const double *kept, int coordinate,
                                double *gradient);
void ambulo__devices_add_effort(const ambulo__devices *devices, const double *kept, int device,
                                double *gradient);

/* One device at one node; arrays as of ambulo__devices_keep. */
typedef struct ambulo__device_state {
  double along, rate; /* s, sd */
  double effort;      /* E */
  double power;       /* g E sd, W, on the body */
} ambulo__device_state;
ambulo__device_state ambulo__device_at(const ambulo__devices *devices, int device, const double *q,
                                       const double *qd, const double *told, double *scratch);

/* 1 where an effort is a torque, in N m; else a force, in N. */
int ambulo__device_turns(const ambulo_model *model, const ambulo_device *device);

/* ------------------------------------------------------------------ the law */

/* E by its members at s, sd and a factor. */
typedef struct ambulo__effort {
  double value, by_along, by_rate;                           /* E, E_s, E_sd */
  double by_factor;                                          /* E / factor */
  double by_stiffness, by_rest, by_pretension, by_smoothing; /* of a spring */
  double by_damping, by_amount;
} ambulo__effort;
ambulo__effort ambulo__effort_of(const ambulo_device *device, double along, double rate,
                                 double factor);

/* ------------------------------------------------------------------- checks */

/* What is wrong with each of them alone. E_PROBLEM. */
ambulo_status ambulo__devices_check(const ambulo_problem_definition *definition,
                                    ambulo_diagnostics *diagnostics);
/* Feet that devices go by strike; of contacts that are valid. E_PROBLEM. */
ambulo_status ambulo__devices_check_strides(const ambulo_problem_definition *definition,
                                            ambulo_diagnostics *diagnostics);
/* With mirrored ends each needs its mirror image among them (it may be its own). E_PROBLEM. */
ambulo_status ambulo__devices_mirror_check(const ambulo_problem_definition *definition,
                                           ambulo_diagnostics *diagnostics);
/* The mirror image of a device on a body that is symmetric, with the name and the points of the
 * device itself. */
ambulo_device ambulo__device_mirrored(const ambulo_model *model, const ambulo_device *device);
/* 1 if a place of one link is the mirror image of a place of another, within 1e-6 m, and moves with
 * the partner. */
int ambulo__places_mirror(const ambulo_model *model, int link, const double position[3],
                          int other_link, const double other[3]);
/* Which device takes the place of one in the mirror image; -1: none. *sign: of its effort and
 * coordinate there. */
int ambulo__device_partner(const ambulo_problem_definition *definition, int device, double *sign);

/* a point of one link seen from another, with what moves it: the kinematics
 * of a linear element.
 *
 * The coordinates that move one of two points but not the other are those of the links between
 * them, below the link that carries both; the distance depends on these alone, and on where they
 * hang on that link, whose frame is taken as the world's. On each side, from there down, the
 * constants between two joints are one transform. Joint i turns about, or slides along, the z axis
 * of the frame before it (classical Denavit-Hartenberg): axis z_i through o_i. With p the side's
 * point,
 *
 *     turning   dp/dq_i = z_i x (p - o_i),    sliding   dp/dq_i = z_i
 *     d2p/dq_i dq_j = z_i x dp/dq_j           i turns, and is j or above it; 0 if i slides
 *
 * A coupled joint stands at f(q_k), and what is written for its q above is by that value.
 */

typedef struct ambulo__path_joint {
  int coordinate, turns;
  const ambulo__coupling *coupling; /* of a coupled joint, which the coordinate moves; NULL */
  double angle, offset;             /* theta, d at q = 0 */
  double after[12]; /* to the next joint, rows of 3 x 4; behind the last: to the point */
} ambulo__path_joint;

typedef struct ambulo__device_path {
  double start[12]; /* from the common frame to the first joint; to the point where there is none */
  int count;
  ambulo__path_joint *joints; /* [count] */
} ambulo__device_path;

/* From link `common` (-1: the world) down to a point of `link`. E_MEMORY. */
ambulo_status ambulo__path_create(const ambulo_model *model, int common, int link,
                                  const double position[3], const ambulo_allocator *allocator,
                                  ambulo__device_path *path);
void ambulo__path_free(const ambulo_allocator *allocator, ambulo__device_path *path);
/* The deepest link that carries both, or is one of them; -1: the world. */
int ambulo__path_common(const ambulo_model *model, const int link[2]);

/* frame (rows of 3 x 4) before a joint to that before the next, behind the last: at the point. */
void ambulo__path_follow(double frame[12], const ambulo__path_joint *joint, double q);

/* Where a joint stands at q, with the derivatives by its coordinate (NULL: without). */
double ambulo__path_value(const ambulo__path_joint *joint, double q,
                          double slope[AMBULO__COUPLING_SLOPES]);

/* Where the point is, with axis[count][3] and slope[count][3] = dp/dq of the joints; q has a stride
 * of AMBULO__LANES. */
void ambulo__path_point(const ambulo__device_path *path, const double *q, double point[3],
                        double *axis, double *slope);

/* a point of the body, how it moves, and what each coordinate does to that.
 *
 * p, v, a are its position, velocity and acceleration in the world. Of coordinate j of the chain
 * that carries it, with the axis z through o of the frame before the joint, which turns with w and
 * alpha, and has v_o and a_o at o:
 *
 *     zd = w x z,   zdd = alpha x z + w x zd
 *     turning   J = z x (p - o),   Jd = zd x (p - o) + z x (v - v_o),
 *               Jdd = zdd x (p - o) + 2 zd x (v - v_o) + z x (a - a_o)
 *     sliding   J = z,  Jd = zd,  Jdd = zdd
 *
 * and since p is a function of q alone, with J = dp/dq_j along the motion,
 *
 *     da/dq_j = Jdd,   da/dqd_j = 2 Jd,   da/dqdd_j = J
 */

/* Where the parts stand in what is kept of a point: n joints of the chain. */
typedef struct ambulo__hand_motion {
  double *place, *velocity, *acceleration; /* [3] */
  double *axis, *axis_rate, *axis_gain;    /* z, zd, zdd: [n][3] */
  double *slope, *slope_rate, *slope_gain; /* J, Jd, Jdd: [n][3] */
} ambulo__hand_motion;

static inline size_t ambulo__hand_entries(int joints) {
  return 9 + 18 * (size_t)joints;
}
ambulo__hand_motion ambulo__hand_motion_in(double *kept, int joints);

/* Of a path from the world; q, qd, qdd have a stride of AMBULO__LANES. */
void ambulo__hand_move(const ambulo__device_path *path, const double *q, const double *qd,
                       const double *qdd, const ambulo__hand_motion *motion);

/* where a foot is in its stride, from its strike to the next. */

typedef struct ambulo__stride_now {
  double begin[2]; /* s: the strike at or before the time (within 1e-9 s), and the next; may lie
                      outside [0, T] */
  int contact[2];  /* with whose `from` they begin */
  double share;    /* of the stride, 0 to 1 */
} ambulo__stride_now;

/* In a motion that repeats; 0 where the foot does not strike. */
int ambulo__stride_at(const ambulo_problem_definition *definition, int foot, double time,
                      ambulo__stride_now *now);

/* when something is held: its window, and its events. */

/* 1 where the window has a ramp at its beginning, at its end. */
int ambulo__hold_rises(const ambulo_hold *hold);
int ambulo__hold_falls(const ambulo_hold *hold, double duration);
/* w at a time of a motion that lasts `duration`. */
double ambulo__hold_window(const ambulo_hold *hold, double duration, double time);
/* Times inside (0, duration) at which the window begins or ends to change, time[4]; how many. */
int ambulo__hold_events(const ambulo_hold *hold, double duration, double time[4]);

/* what devices know about time: the window of a clutch times the
 * profile. */

/* One device's factor at a time, with its slopes by the time, and by the strikes that begin and end
 * the stride (contact/devices.h), per s; `contact`: with whose `from` they are, -1: none. */
typedef struct ambulo__device_told {
  double factor, by_time, by_strike[2];
  double strike[2]; /* s */
  int contact[2];
  double by_from, by_to, by_ramp; /* of a clutch */
} ambulo__device_told;

ambulo__device_told ambulo__device_told_at(const ambulo_problem_definition *definition, int device,
                                           double time);

/* At `count` times, [blocks][devices and holds][8]: factors of the devices, then the windows of
 * what hands hold (contact/devices.h), padded with the last; freed with ambulo__free_aligned.
 * *told is NULL without either. E_MEMORY. */
ambulo_status ambulo__devices_tell(const ambulo_problem_definition *definition,
                                   const ambulo_allocator *allocator, const double *times,
                                   int count, double **told);

/* The cubic through points [count][2], rising, at x: that of Fritsch & Carlson, which stays between
 * them, and its slope. period > 0: it repeats after that; 0: beyond its ends it is constant. */
double ambulo__device_curve(const double (*points)[2], int count, double period, double x,
                            double *slope);

/* what hands hold, compiled: forces at the hands, what they add to torques and to
 * the root wrench, and the derivatives (ambulo/hold.h has the law).
 *
 * f_k and the moment m_k are what hand k exerts, at its point p_k, with J_ki = dp_k/dq_i and the
 * axes z_ki of joints that turn (hand_motion.h); of an inverse dynamics they add
 *
 *     tau_i += sum_k J_ki . f_k + z_ki . m_k          (joints that carry the whole body on contacts
 *     (M, F) += sum_k (p_k x f_k + m_k, f_k)           have tau = 0 and keep it)
 *
 * For weights y on tau and (M', F') on the root wrench, the hands have the virtual motions
 *
 *     u_k = sum_i y_i J_ki + F' + M' x p_k,    t_k = sum_i y_i z_ki + M'
 *
 * and L = sum_k u_k . f_k + t_k . m_k. With U = (u_1 + u_2) / 2, l = u_2 - u_1, T = t_1 + t_2, s =
 * d . d, e = a_2 - a_1, G = w m (a_c - g), mu = o x G, P_d = 1 - d d^T / s, and m_1 = m_2,
 *
 *     L = U . F + w I l . P_d e / s + mu . (d x l) / s + (T . d)(d . mu) / (2 s)
 *
 * so that the adjoints of the middle's acceleration, of e and of d are
 *
 *     b   = (d x l) / s + d (T . d) / (2 s)                      of mu
 *     a_c'= w m (U + b x o)
 *     e'  = w I P_d l / s
 *     d'  = w I (-2 d (l . e) - l (d . e) - e (l . d) + 4 d (l . d)(d . e) / s) / s^2
 *           + l x mu / s - 2 d (mu . (d x l)) / s^2
 *           + (T (d . mu) + mu (T . d)) / (2 s) - d (T . d)(d . mu) / s^2
 *
 * a_k' = a_c' / 2 -+ e' and p_k' = -+ d' + f_k x M'. What is left is that J and z turn: dJ_i/dq_j =
 * z_i x J_j for i above j or j itself, if i turns, and z_j x J_i for i below; dz_i/dq_j = z_j x z_i
 * below. With sums from above to j, O_j = sum y_i z_i, and from below, U_j = sum y_i J_i, Z_j = sum
 * y_i z_i,
 *
 *     q_j'   += a_k' . Jdd_j + p_k' . J_j + f_k . (O_j x J_j + z_j x U_j) + m_k . (z_j x Z_j)
 *     qd_j'  += 2 a_k' . Jd_j,     qdd_j' += a_k' . J_j
 *
 * One hand: F = w (m (a - g) + P) at it, a' = w m u. A row of the Jacobian is a sweep with one
 * weight of 1.
 */

typedef struct ambulo__holds ambulo__holds;

/* Of a checked definition, whose holds must outlive them, and the plan of its body. *holds is NULL
 * where it has none. E_MEMORY. */
ambulo_status ambulo__holds_create(const ambulo_problem_definition *definition,
                                   const ambulo__plan *plan, const ambulo_allocator *allocator,
                                   ambulo__holds **holds);
void ambulo__holds_free(ambulo__holds *holds); /* accepts NULL */

/* Doubles that are kept of a node; 0 of NULL. */
size_t ambulo__holds_entries(const ambulo__holds *holds);
/* What all that follows is made of, kept[entries]. q, qd, qdd, told: [...][lanes] from the node's
 * lane on. */
void ambulo__holds_keep(const ambulo__holds *holds, const double *q, const double *qd,
                        const double *qdd, const double *told, double *kept);

/* Adds them to tau [d][lanes] from the node's lane on, and to the root wrench (M, F), whose entries
 * are `stride` apart. */
void ambulo__holds_add_torques(const ambulo__holds *holds, const double *kept, double *tau);
void ambulo__holds_add_wrench(const ambulo__holds *holds, const double *kept, double *wrench,
                              int stride);

/* Weights of a sweep, and where the gradient is added to. */
typedef struct ambulo__hold_adjoints {
  const double *tau;    /* [d][lanes] from the node's lane on, or NULL: */
  int coordinate;       /* then 1 on tau of this one alone; -1: of none */
  double wrench[6];     /* M', F' */
  double *q, *qd, *qdd; /* [d], entries `stride` apart */
  int stride;
} ambulo__hold_adjoints;
void ambulo__holds_reverse(const ambulo__holds *holds, const double *kept,
                           const ambulo__hold_adjoints *adjoints);

/* Of one hold at a node: force and moment that each hand exerts (world axes, moment about the
 * hand's point), power of both on what is held, W, and the window. */
typedef struct ambulo__hold_state {
  double force[2][3], moment[2][3], power, window;
} ambulo__hold_state;
ambulo__hold_state ambulo__hold_at(const ambulo__holds *holds, int hold, const double *kept);

/* What is wrong with each of them. E_PROBLEM. */
ambulo_status ambulo__holds_check(const ambulo_problem_definition *definition,
                                  ambulo_diagnostics *diagnostics);
/* With mirrored ends each is its own mirror image, and held all along. E_PROBLEM. */
ambulo_status ambulo__holds_mirror_check(const ambulo_problem_definition *definition,
                                         ambulo_diagnostics *diagnostics);

#endif
