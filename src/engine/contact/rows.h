/* contact/rows.h - channels, and constraint rows as linear forms on them. */
#ifndef AMBULO_CONTACT_ROWS_H
#define AMBULO_CONTACT_ROWS_H

#include "ambulo/problem.h"
#include "base/alloc.h"
#include "contact/curved.h"
#include "model/model.h"
#include "trajectory/basis.h"

/* everything that is known at a time node, numbered.
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
 * and with ground reaction, n = 4 d + 6 + 3 p, of s slots (contact/contacts.h)
 *
 *   reaction [s][6]     N, N m             n      |  force, moment about the contact's centre
 *   com      [3]        m                  n+6 s /   centre of mass
 *
 * Behind all of these the efforts of the devices [v], N m or N (contact/devices.h). tau is what
 * they leave to the person.
 */

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

/* what rows are about: the one table of their kinds.
 *
 * A row carries its kind and its measure; whoever treats rows by what they are about reads it here
 * and never from a name. `family` and the texts of measures are for people.
 */

/* What the value of a row is measured in. Rates follow what they are the rates of. */
typedef enum ambulo__measure {
  AMBULO__METRES,
  AMBULO__METRES_PER_SECOND,
  AMBULO__METRES_PER_SECOND_SQUARED,
  AMBULO__RADIANS,
  AMBULO__RADIANS_PER_SECOND,
  AMBULO__RADIANS_PER_SECOND_SQUARED,
  AMBULO__NEWTONS,
  AMBULO__NEWTON_METRES,
  AMBULO__BODY_WEIGHTS,
  AMBULO__OTHER_MEASURE /* of a row of the caller: text of his own; of a rule: any */
} ambulo__measure;

enum { AMBULO__MEASURES = AMBULO__OTHER_MEASURE + 1 };

/* "m", "rad/s", ...; "" of AMBULO__OTHER_MEASURE */
const char *ambulo__measure_text(ambulo__measure measure);
/* The measure of that text; AMBULO__OTHER_MEASURE for any other. */
ambulo__measure ambulo__measure_of_text(const char *text);
/* What counts as one, for a body of `weight` N: 1 m (a leg is .9), 1 rad, 1 body weight; the body
 * weight of N, times 1 m of N m (what a step asks of the hips and ankles together); 10 m/s and
 * rad/s (a swinging knee turns at 7); 100 m/s^2 and rad/s^2; 1 of anything else. */
double ambulo__measure_size(ambulo__measure measure, double weight);

typedef enum ambulo__row_kind {
  AMBULO__KIND_GROUND_PENETRATION,
  AMBULO__KIND_FOOT_STRIKE,
  AMBULO__KIND_CONTACT,
  AMBULO__KIND_CLEARANCE,
  AMBULO__KIND_ZMP,
  AMBULO__KIND_NORMAL_FORCE,
  AMBULO__KIND_PRESSURE,
  AMBULO__KIND_FRICTION,
  AMBULO__KIND_FREE_MOMENT,
  AMBULO__KIND_FLIGHT,
  AMBULO__KIND_JOINT_LIMIT,
  AMBULO__KIND_SPEED_LIMIT,
  AMBULO__KIND_TORQUE_LIMIT,
  AMBULO__KIND_PASSIVE,
  AMBULO__KIND_TRACKING_TUBE,
  AMBULO__KIND_COLLISION,
  AMBULO__KIND_OBSTACLE,
  AMBULO__KIND_REACH,
  AMBULO__KIND_INITIAL_STATE,
  AMBULO__KIND_FINAL_STATE,
  AMBULO__KIND_PERIODIC,
  AMBULO__KIND_MIRRORED,
  AMBULO__KIND_USER, /* the caller's own, under whatever name */
  /* of no row: what is asked of a motion between its nodes beside them */
  AMBULO__KIND_SLIP,
  AMBULO__KIND_GROUND_FORCE
} ambulo__row_kind;

enum { AMBULO__ROW_KINDS = AMBULO__KIND_GROUND_FORCE + 1, AMBULO__NOT_LIMITED = -1 };

/* Where rows of a kind stand. */
typedef enum ambulo__row_place {
  AMBULO__AT_TIMES, /* nodes, or control points */
  AMBULO__AT_AN_END,
  AMBULO__ACROSS_ENDS /* joins the two ends; carries the travel */
} ambulo__row_place;

typedef struct ambulo__row_kind_entry {
  const char *family;                /* what users call it; "" of AMBULO__KIND_USER */
  ambulo__measure straight, turning; /* of translations, lengths and forces; of angles and moments,
                                        the same where there are none */
  ambulo__row_place place;
  int limited; /* ambulo_limited: rows are limits of that; AMBULO__NOT_LIMITED */
  /* How hard it is for a person to change what the rows stand for: 1 what bodies differ in, 3 what
   * the question asks for, 30 what makes it walking on a ground. */
  double reluctance;
} ambulo__row_kind_entry;

const ambulo__row_kind_entry *ambulo__row_kind_entry_of(ambulo__row_kind kind);
const char *ambulo__row_family(ambulo__row_kind kind);

/* The kind of limits on `what`. */
ambulo__row_kind ambulo__row_kind_of_limit(ambulo_limited what);

/* The measure of a row of that kind about a coordinate of that type, or about its order-th rate
 * (0 <= order <= 2; of lengths and angles). */
ambulo__measure ambulo__row_measure(ambulo__row_kind kind, ambulo_joint_type type, int order);

/* constraint rows as linear forms on channels.
 *
 *     value_r = constant_r + sum_t coefficient_t * channel_t(node_t)
 *
 * Every row of the gait problem has this form once the moment equation of the ZMP is
 * written without the division (Eq. 17'). A term may instead stand on one unknown
 * (node = -1, channel = index into x): control-point bounds. Curved rows (contact/curved.h)
 * and those of the caller are functions of one node's channels.
 *
 * Modules append rows here, in physical units; nlp gives them numbers.
 */

typedef struct ambulo__row_term {
  int node; /* -1: `channel` is the index of an unknown */
  int channel;
  double coefficient;
} ambulo__row_term;

typedef struct ambulo__table_row {
  const char *family;  /* text of the kind, or the caller's name */
  const char *subject; /* a name that lives in the model (or static text) */
  const char *detail;  /* static text, or a name that lives in the model or the problem */
  const char *unit;    /* text of the measure, or the caller's */
  /* small ambulo__row_kind, ambulo__measure, ambulo_relation: rows are many */
  unsigned char kind, measure, relation;
  unsigned char before; /* 1: it is about what the feet did just before its node, on an event */
  int group;            /* rows of one family have the same; 0 .. group_count - 1 */
  int node;             /* the node whose channels it uses; -1: several, or none */
  int user;             /* value and coefficients come from a function at every evaluation: index of
                           the caller's user row, of the table's curved row, by kind; -1: linear, as
                           above */
  double time;
  double constant;
  double size; /* in unit: what counts as one; violations are judged relative to it */
  int first_term, term_count;
} ambulo__table_row;

typedef struct ambulo__row_table {
  ambulo_allocator allocator;
  ambulo__table_row *rows;
  int row_count, row_capacity;
  ambulo__row_term *terms;
  int term_count, term_capacity;
  ambulo__curved *curved;
  int curved_count, curved_capacity;
  int *group_row; /* the first row of each group, in the order in which groups begin */
  int group_count, group_capacity;
  int before;           /* what rows begun from now on have of that name; 0 after init */
  double weight;        /* of the body, N: what forces are measured by; 1 after init */
  ambulo_status status; /* sticky: E_MEMORY once an append failed, E_INTERNAL for a form that
                           overflowed */
} ambulo__row_table;

void ambulo__row_table_init(ambulo__row_table *table, const ambulo_allocator *allocator);
void ambulo__row_table_clear(ambulo__row_table *table);
/* Starts a row (its terms follow by ambulo__row_term_add). */
void ambulo__row_begin(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                       const char *detail, ambulo__measure measure, ambulo_relation relation,
                       int node, double time, double constant);
/* Adds the caller's own row number `index` at a node, under the caller's name and unit. Names may
 * be those of the table: the row is of AMBULO__KIND_USER all the same. */
void ambulo__row_user(ambulo__row_table *table, const ambulo_user_row *user, int index, int node,
                      double time);
/* Adds a row at a node, not negative, in m, that is a function of an arc; of a point and a segment;
 * of a capsule and what it keeps clear of; of the root wrench; in body weights, of a contact's
 * force. */
void ambulo__row_arc(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                     const char *detail, int node, double time, const ambulo__arc *arc);
void ambulo__row_apart(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                       const char *detail, int node, double time, const ambulo__apart *apart);
void ambulo__row_solid(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                       const char *detail, int node, double time, const ambulo__solid *solid);
void ambulo__row_spin(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                      const char *detail, int node, double time, const ambulo__spin *spin);
void ambulo__row_cone(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                      const char *detail, int node, double time, const ambulo__cone *cone);
/* What a curved row is a function of; NULL: the row is linear, or the caller's. */
static inline const ambulo__curved *ambulo__row_curved_of(const ambulo__row_table *table,
                                                          const ambulo__table_row *row) {
  return row->user >= 0 && row->kind != AMBULO__KIND_USER ? &table->curved[row->user] : NULL;
}
/* The arc of a row; NULL: it has none. */
static inline const ambulo__arc *ambulo__row_arc_of(const ambulo__row_table *table,
                                                    const ambulo__table_row *row) {
  const ambulo__curved *curved = ambulo__row_curved_of(table, row);
  return curved && curved->form == AMBULO__CURVED_ARC ? &curved->of.arc : NULL;
}
/* The capsules of a row; NULL: it has none. */
static inline const ambulo__solid *ambulo__row_solid_of(const ambulo__row_table *table,
                                                        const ambulo__table_row *row) {
  const ambulo__curved *curved = ambulo__row_curved_of(table, row);
  return curved && curved->form == AMBULO__CURVED_SOLID ? &curved->of.solid : NULL;
}
/* Adds a term to the row begun last. Zero coefficients are skipped. */
void ambulo__row_term_add(ambulo__row_table *table, int node, int channel, double coefficient);

/* What is missed at `value`, in the row's unit; infinite where that is not finite. */
double ambulo__row_missed(const ambulo__table_row *row, double value);
/* 1: the two rows of one table say the same of different times. */
int ambulo__rows_alike(const ambulo__table_row *a, const ambulo__table_row *b);

/* What a family of rows is made from. */
typedef struct ambulo__gait_context {
  const ambulo_problem_definition *definition;
  const ambulo_model *model;
  const ambulo__basis *basis;
  ambulo__channels channels;
  const double *times; /* [nodes] */
  int nodes;
  const int *active; /* [nodes][feet]: contact index or -1 */
  const int *before; /* [nodes][feet]: just before the node, where that counts too; NULL: nowhere */
} ambulo__gait_context;

/* a linear form of one node's channels between two bounds: a pair of rows. */

enum { AMBULO__FORM_TERMS = 12 };

/* constant + sum coefficient * channel */
typedef struct ambulo__linear {
  double constant;
  int count;
  int overflow; /* 1: a term found no room; ambulo__bounded_rows then refuses the form */
  int channel[AMBULO__FORM_TERMS];
  double coefficient[AMBULO__FORM_TERMS];
} ambulo__linear;

/* What a pair of rows is about. Static text, except the subject, which lives in the model. */
typedef struct ambulo__bounded_name {
  ambulo__row_kind kind;
  const char *subject, *lower, *upper;
  ambulo__measure measure;
} ambulo__bounded_name;

/* Adds factor times the components first, first + 1, first + 2 along `direction`. */
void ambulo__linear_add(ambulo__linear *form, int first, const double direction[3], double factor);

/* form - low >= 0 and high - form >= 0; an infinite bound has no row. A form that overflowed makes
 * the table fail with E_INTERNAL. */
void ambulo__bounded_rows(const ambulo__gait_context *context, int node,
                          const ambulo__bounded_name *name, const ambulo__linear *form, double low,
                          double high, ambulo__row_table *table);

/* Derivatives of q that rows look at: places none, forces and the zero-moment point two. */
enum { AMBULO__OF_PLACES = 0, AMBULO__OF_FORCES = 2 };

/* Number of nodes that have rows of contact (`order` AMBULO__OF_PLACES) or force
 * (AMBULO__OF_FORCES): with ground reaction or tolerances and ends that match up to that
 * derivative, the last node is the first one again and has none. */
int ambulo__distinct_nodes(const ambulo__gait_context *context, int order);

/* What the rows of an effector (contact/contacts.h) at a node are about: contact[count], indices or
 * -1 in the air. One, but on a grid on events two where a contact begins or ends: that before the
 * node, then that from it on. Of a last node that is the first one again: only what ends there,
 * none otherwise. */
typedef struct ambulo__phases_of_foot {
  int count, contact[2];
} ambulo__phases_of_foot;
ambulo__phases_of_foot ambulo__phases_at(const ambulo__gait_context *context, int order, int node,
                                         int effector);
/* 1 if contact[i] of what ambulo__phases_at gives is that before the node. */
static inline int ambulo__phase_is_before(const ambulo__gait_context *context, int i) {
  return i == 0 && context->before != NULL;
}

#endif
