/* solver/term_parameters.c - weights, scales, offsets, strengths and heights of the terms of
 * the objective, by their keys: objective[name].weight, .scale.knee_angle_r, ... */
#include "solver/sensitivity_parameters.h"

#include <stdio.h>
#include <string.h>

enum { ITEM_TEXT = 128 };

typedef struct term_keys {
  ambulo__parameters *p;
  const ambulo_term *term;
  const char *name;
  char item[ITEM_TEXT]; /* "upright"; "3" where the name is not its alone */
  size_t first;         /* its first entry in arrays by coordinate */
} term_keys;

static void make_item(const ambulo_problem *problem, int index, term_keys *t) {
  int alike = 0;
  t->name = ambulo_problem_term_name(problem, index);
  for (int k = 0; k < problem->definition.term_count; k++)
    alike += strcmp(t->name, ambulo_problem_term_name(problem, k)) == 0;
  if (alike == 1) {
    (void)snprintf(t->item, sizeof t->item, "%s", t->name);
  } else {
    (void)snprintf(t->item, sizeof t->item, "%d", index);
  }
}

/* the partner of i within the term; -1: its numbers stand alone */
static int partner_of(const term_keys *t, int i, double *sign) {
  int m = ambulo__parameter_partner(t->p->problem, i, sign);
  return m >= 0 && ambulo__term_scale(t->term, m) != 0.0 ? m : -1;
}

static void add_by_coordinate(const term_keys *t, int i, ambulo__quantity quantity, double value,
                              double by, const char *what, const char *key) {
  const char *coordinate = t->p->problem->model->coordinates[i].name;
  double sign;
  int m = partner_of(t, i, &sign);
  char label[AMBULO__PARAMETER_TEXT];
  (void)snprintf(label, sizeof label, "%s of %s%s in %s", what, coordinate,
                 m >= 0 && m != i ? AMBULO__BOTH_OF_A_PAIR : "", t->name);
  ambulo__parameter_add(t->p, quantity, value, by, label, "objective[%s].%s.%s", t->item, key,
                        coordinate);
}

static void add_pair(const term_keys *t, int m, double sign, const char *key) {
  ambulo__parameter_with(t->p, sign, "objective[%s].%s.%s", t->item, key,
                         t->p->problem->model->coordinates[m].name);
}

static void add_scale(const term_keys *t, int i) {
  const double *by = t->p->partials->scale + t->first;
  double sign;
  int m = partner_of(t, i, &sign), pair = m >= 0 && m != i;
  add_by_coordinate(t, i, AMBULO__RATIO, ambulo__term_scale(t->term, i),
                    by[i] + (pair ? by[m] : 0.0), "scale", "scale");
  if (pair) add_pair(t, m, 1.0, "scale");
}

/* nothing but zero is the same on both sides of what is turned round */
static void add_offset(const term_keys *t, int i) {
  const double *by = t->p->partials->offset + t->first;
  double sign, value = t->term->offset ? t->term->offset[i] : 0.0;
  int m = partner_of(t, i, &sign), rests = t->term->kind == AMBULO_POSTURE;
  int turns = t->p->problem->model->coordinates[i].type == AMBULO_REVOLUTE;
  if (m == i || (!rests && value == 0.0)) return;
  ambulo__quantity quantity = rests ? (turns ? AMBULO__ANGLE : AMBULO__STEP_LENGTH)
                                    : (turns ? AMBULO__TORQUE : AMBULO__FORCE);
  const char *key = rests ? "angles" : "offset";
  add_by_coordinate(t, i, quantity, value, by[i] + (m >= 0 ? sign * by[m] : 0.0),
                    rests ? "rest" : "offset", key);
  if (m >= 0) add_pair(t, m, sign, key);
}

static void add_tendon(const term_keys *t, int i) {
  const double *by = t->p->partials->tendon + t->first;
  double sign;
  int m = partner_of(t, i, &sign), pair = m >= 0 && m != i;
  if (!(t->term->tendon[i] > 0.0)) return;
  add_by_coordinate(t, i, AMBULO__RATIO, t->term->tendon[i], by[i] + (pair ? by[m] : 0.0),
                    "stiffness of the tendon", "tendon");
  if (pair) add_pair(t, m, 1.0, "tendon");
}

static void add_strength(const term_keys *t, int i) {
  static const char *const words[] = {"positive strength", "negative strength"};
  const ambulo_model *model = t->p->problem->model;
  const double *by = t->p->partials->strength + 2 * t->first;
  double sign;
  int m = partner_of(t, i, &sign);
  for (int down = 0; down < 2; down++) {
    double peak = t->term->strength[6 * i + 3 * down];
    int other = sign < 0.0 ? !down : down;
    if (!(peak > 0.0) || (m == i && down)) continue;
    char label[AMBULO__PARAMETER_TEXT];
    (void)snprintf(label, sizeof label, "%s of %s%s in %s", words[down], model->coordinates[i].name,
                   m >= 0 ? AMBULO__BOTH_OF_A_PAIR : "", t->name);
    ambulo__parameter_add(
        t->p, AMBULO__RATIO, peak, by[2 * i + down] + (m >= 0 ? by[2 * m + other] : 0.0), label,
        "objective[%s].strength.%s[%d]", t->item, model->coordinates[i].name, 3 * down);
    if (m >= 0)
      ambulo__parameter_with(t->p, 1.0, "objective[%s].strength.%s[%d]", t->item,
                             model->coordinates[m].name, 3 * other);
  }
}

static int has_prices(const term_keys *t, int i) {
  const double *price = t->term->price;
  return price && (price[2 * i] != 1.0 || price[2 * i + 1] != 1.0);
}

static void add_prices(const term_keys *t, int i) {
  static const char *const words[] = {"price of negative torque", "price of positive torque"};
  const ambulo_model *model = t->p->problem->model;
  const double *by = t->p->partials->price + 2 * t->first;
  double sign;
  int m = partner_of(t, i, &sign);
  for (int up = 0; up < 2; up++) {
    int other = sign < 0.0 ? !up : up;
    if (m == i && up) continue;
    char label[AMBULO__PARAMETER_TEXT];
    (void)snprintf(label, sizeof label, "%s of %s%s in %s", words[up], model->coordinates[i].name,
                   m >= 0 ? AMBULO__BOTH_OF_A_PAIR : "", t->name);
    ambulo__parameter_add(t->p, AMBULO__RATIO, t->term->price[2 * i + up],
                          by[2 * i + up] + (m >= 0 ? by[2 * m + other] : 0.0), label,
                          "objective[%s].scale.%s[%d]", t->item, model->coordinates[i].name, up);
    if (m >= 0)
      ambulo__parameter_with(t->p, 1.0, "objective[%s].scale.%s[%d]", t->item,
                             model->coordinates[m].name, other);
  }
}

static void add_coordinate(const term_keys *t, int i) {
  double sign;
  int m = partner_of(t, i, &sign);
  if (ambulo__term_scale(t->term, i) == 0.0 || (m >= 0 && m < i)) return; /* or said before */
  if (has_prices(t, i))
    add_prices(t, i);
  else if (t->term->scale)
    add_scale(t, i);
  if (t->term->kind != AMBULO_ACCELERATION && t->term->kind != AMBULO_TRACKING &&
      t->term->kind != AMBULO_MECHANICAL_POWER && t->term->kind != AMBULO_TORQUE_RATE)
    add_offset(t, i);
  if (t->term->strength && !t->term->strength_is_limits) add_strength(t, i);
  if (t->term->tendon) add_tendon(t, i);
}

void ambulo__parameters_of_terms(ambulo__parameters *p) {
  const ambulo_problem *problem = p->problem;
  char label[AMBULO__PARAMETER_TEXT];
  for (int k = 0; k < problem->definition.term_count; k++) {
    term_keys t = {
        p, &problem->definition.terms[k], NULL, {0}, (size_t)k * (size_t)problem->coordinates};
    make_item(problem, k, &t);
    (void)snprintf(label, sizeof label, "weight of %s", t.name);
    ambulo__parameter_add(p, AMBULO__RATIO, t.term->weight, p->partials->weight[k], label,
                          "objective[%s].weight", t.item);
    if (t.term->kind == AMBULO_CLEARANCE)
      ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, t.term->height, p->partials->height[k],
                            "height that swinging feet keep", "objective[%s].height", t.item);
    if (t.term->kind == AMBULO_UPRIGHT || t.term->kind == AMBULO_GROUND_FORCE ||
        t.term->kind == AMBULO_CLEARANCE || t.term->kind == AMBULO_FORCE_RATE ||
        t.term->kind == AMBULO_DEVICE_EFFORT || t.term->function)
      continue;
    for (int i = 0; i < problem->coordinates; i++) add_coordinate(&t, i);
  }
}
