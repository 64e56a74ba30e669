/* contact/row_kind.c - the tables of row_kind.h. */
#include "contact/row_kind.h"

#include <string.h>

/* In the order of ambulo__measure. Per body weight: sizes are shares of it. */
static const struct {
  const char *text;
  double size;
  int per_body_weight;
} measures[AMBULO__MEASURES] = {
    {"m", 1.0, 0},   {"m/s", 10.0, 0},   {"m/s^2", 100.0, 0},
    {"rad", 1.0, 0}, {"rad/s", 10.0, 0}, {"rad/s^2", 100.0, 0},
    {"N", 1.0, 1},   {"N m", 1.0, 1},    {"body weights", 1.0, 0},
    {"", 1.0, 0},
};

const char *ambulo__measure_text(ambulo__measure measure) {
  return measures[measure].text;
}

ambulo__measure ambulo__measure_of_text(const char *text) {
  int i = 0;
  while (i < AMBULO__OTHER_MEASURE && strcmp(measures[i].text, text) != 0) i++;
  return (ambulo__measure)i;
}

double ambulo__measure_size(ambulo__measure measure, double weight) {
  return measures[measure].size * (measures[measure].per_body_weight ? weight : 1.0);
}

#define M AMBULO__METRES
#define RAD AMBULO__RADIANS
#define WEIGHTS AMBULO__BODY_WEIGHTS
#define NONE AMBULO__NOT_LIMITED

/* In the order of ambulo__row_kind. */
static const ambulo__row_kind_entry kinds[AMBULO__ROW_KINDS] = {
    /* family, straight, turning, place, limited, reluctance */
    {"ground_penetration", M, M, AMBULO__AT_TIMES, NONE, 30.0},
    {"foot_strike", M, M, AMBULO__AT_TIMES, NONE, 3.0},
    {"contact", M, RAD, AMBULO__AT_TIMES, NONE, 3.0},
    {"clearance", M, RAD, AMBULO__AT_TIMES, NONE, 1.0},
    {"zmp", M, M, AMBULO__AT_TIMES, NONE, 1.0},
    {"normal_force", WEIGHTS, WEIGHTS, AMBULO__AT_TIMES, NONE, 30.0},
    {"pressure", M, M, AMBULO__AT_TIMES, NONE, 1.0},
    {"friction", WEIGHTS, WEIGHTS, AMBULO__AT_TIMES, NONE, 1.0},
    {"free_moment", M, M, AMBULO__AT_TIMES, NONE, 1.0},
    {"flight", M, M, AMBULO__AT_TIMES, NONE, 30.0},
    {"joint_limit", M, RAD, AMBULO__AT_TIMES, AMBULO_LIMITED_POSITION, 1.0},
    {"speed_limit", AMBULO__METRES_PER_SECOND, AMBULO__RADIANS_PER_SECOND, AMBULO__AT_TIMES,
     AMBULO_LIMITED_SPEED, 1.0},
    {"torque_limit", AMBULO__NEWTONS, AMBULO__NEWTON_METRES, AMBULO__AT_TIMES,
     AMBULO_LIMITED_TORQUE, 1.0},
    {"tracking_tube", M, RAD, AMBULO__AT_TIMES, NONE, 1.0},
    {"collision", M, M, AMBULO__AT_TIMES, NONE, 30.0},
    {"obstacle", M, M, AMBULO__AT_TIMES, NONE, 3.0},
    {"reach", M, M, AMBULO__AT_TIMES, NONE, 3.0},
    {"initial_state", M, RAD, AMBULO__AT_AN_END, NONE, 3.0},
    {"final_state", M, RAD, AMBULO__AT_AN_END, NONE, 3.0},
    {"periodic", M, RAD, AMBULO__ACROSS_ENDS, NONE, 3.0},
    {"mirrored", M, RAD, AMBULO__ACROSS_ENDS, NONE, 3.0},
    {"", AMBULO__OTHER_MEASURE, AMBULO__OTHER_MEASURE, AMBULO__AT_TIMES, NONE, 1.0},
    {"slip", M, M, AMBULO__AT_TIMES, NONE, 1.0},
    {"ground_force", WEIGHTS, WEIGHTS, AMBULO__AT_TIMES, NONE, 1.0},
};

const ambulo__row_kind_entry *ambulo__row_kind_entry_of(ambulo__row_kind kind) {
  return &kinds[kind];
}

const char *ambulo__row_family(ambulo__row_kind kind) {
  return kinds[kind].family;
}

ambulo__row_kind ambulo__row_kind_of_limit(ambulo_limited what) {
  if (what == AMBULO_LIMITED_SPEED) return AMBULO__KIND_SPEED_LIMIT;
  return what == AMBULO_LIMITED_TORQUE ? AMBULO__KIND_TORQUE_LIMIT : AMBULO__KIND_JOINT_LIMIT;
}

ambulo__measure ambulo__row_measure(ambulo__row_kind kind, ambulo_joint_type type, int order) {
  const ambulo__row_kind_entry *entry = &kinds[kind];
  return (ambulo__measure)((int)(type == AMBULO_REVOLUTE ? entry->turning : entry->straight) +
                           order);
}
