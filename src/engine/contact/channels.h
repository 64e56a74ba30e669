/* contact/channels.h - everything that is known at a time node, numbered.
 *
 * A channel is one scalar quantity at every node: a coordinate, its rates, a
 * torque, a component of the root wrench or of a point's position. Constraint rows
 * and objective terms are functions of channels; the chain rule from channels to
 * unknowns is then written once (problem/evaluate.c, problem/row_gradients.c).
 *
 * Storage: [block][channel][lane] (base/lanes.h).
 *
 *   q        [d]        rad, m             0
 *   qd       [d]        per s              d
 *   qdd      [d]        per s^2            2 d
 *   tau      [d]        N m, N             3 d   \
 *   moment   [3]        N m                4 d    | in the order of the mechanics'
 *   force    [3]        N                  4 d+3  | output rows (mechanics/plan.h)
 *   points   [p][3]     m                  4 d+6  |
 *
 * and with ground reaction, n = 4 d + 6 + 3 p, of s slots (contact/contact_load.h)
 *
 *   reaction [s][6]     N, N m             n      |  force, moment about the contact's centre
 *   com      [3]        m                  n+6 s /   centre of mass
 *
 * Behind all of these the efforts of the devices [v], N m or N (contact/devices.h). tau is what
 * they leave to the person.
 */
#ifndef AMBULO_CONTACT_CHANNELS_H
#define AMBULO_CONTACT_CHANNELS_H

enum { AMBULO__SLOT_CHANNELS = 6 };

typedef struct ambulo__channels {
  int coordinates, points;
  int feet;  /* of the model, with ground reaction; else 0 */
  int slots; /* of ground reaction; the first are the feet's */
  int devices;
} ambulo__channels;

static inline int ambulo__channel_q(const ambulo__channels *c, int i) {
  (void)c;
  return i;
}
static inline int ambulo__channel_qd(const ambulo__channels *c, int i) {
  return c->coordinates + i;
}
static inline int ambulo__channel_qdd(const ambulo__channels *c, int i) {
  return 2 * c->coordinates + i;
}
static inline int ambulo__channel_tau(const ambulo__channels *c, int i) {
  return 3 * c->coordinates + i;
}
static inline int ambulo__channel_moment(const ambulo__channels *c, int axis) {
  return 4 * c->coordinates + axis;
}
static inline int ambulo__channel_force(const ambulo__channels *c, int axis) {
  return 4 * c->coordinates + 3 + axis;
}
static inline int ambulo__channel_point(const ambulo__channels *c, int point, int axis) {
  return 4 * c->coordinates + 6 + 3 * point + axis;
}
static inline int ambulo__channel_foot_force(const ambulo__channels *c, int slot, int axis) {
  return 4 * c->coordinates + 6 + 3 * c->points + AMBULO__SLOT_CHANNELS * slot + axis;
}
static inline int ambulo__channel_contact_moment(const ambulo__channels *c, int slot, int axis) {
  return ambulo__channel_foot_force(c, slot, 3 + axis);
}
static inline int ambulo__channel_center(const ambulo__channels *c, int axis) {
  return ambulo__channel_foot_force(c, c->slots, axis);
}
static inline int ambulo__channel_effort(const ambulo__channels *c, int device) {
  return ambulo__channel_foot_force(c, c->slots, c->slots ? 3 : 0) + device;
}
static inline int ambulo__channel_count(const ambulo__channels *c) {
  return ambulo__channel_effort(c, c->devices);
}
/* First channel that the mechanics computes. */
static inline int ambulo__channel_outputs(const ambulo__channels *c) {
  return 3 * c->coordinates;
}

#endif
