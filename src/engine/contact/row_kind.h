/* contact/row_kind.h - what rows are about: the one table of their kinds.
 *
 * A row carries its kind and its measure; whoever treats rows by what they are about reads it here
 * and never from a name. `family` and the texts of measures are for people.
 */
#ifndef AMBULO_CONTACT_ROW_KIND_H
#define AMBULO_CONTACT_ROW_KIND_H

#include "ambulo/model.h"

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

#endif
