/* solver/numbers_task.c - numbers of the objective's terms, of the constraints, of the ground and
 * of what stands in the way, by their keys: objective[name].weight, constraints.zmp_margin, ... */
#include "solver/sensitivity.h"

#include "contact/row_families.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---------------------------------------------------------------------- terms */

enum { ITEM_TEXT = 128 };

typedef struct term_keys {
  ambulo__parameters *p;
  ambulo_term *term;
  const char *name;
  char item[ITEM_TEXT]; /* "upright"; "3" where the name is not its alone */
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

/* A number of an array by coordinate, `stride` each: number `own` of coordinate i, which moves with
 * `sign` times number `other` of its partner. */
typedef struct entry {
  const double *array;
  int stride, own, other;
  double sign;
  const char *what, *key;
} entry;

static void add_entry(const term_keys *t, int i, ambulo__quantity quantity, const entry *e) {
  const ambulo_model *model = t->p->problem->model;
  double sign, *array = ambulo__variant_array(e->array);
  int m = partner_of(t, i, &sign), pair = m >= 0 && (m != i || e->own != e->other);
  char label[AMBULO__PARAMETER_TEXT], index[2][8] = {"", ""};
  if (e->stride > 1) {
    (void)snprintf(index[0], sizeof index[0], "[%d]", e->own);
    (void)snprintf(index[1], sizeof index[1], "[%d]", e->other);
  }
  (void)snprintf(label, sizeof label, "%s of %s%s in %s", e->what, model->coordinates[i].name,
                 pair ? AMBULO__BOTH_OF_A_PAIR : "", t->name);
  ambulo__parameter_add(t->p, quantity, &array[e->stride * i + e->own], label,
                        "objective[%s].%s.%s%s", t->item, e->key, model->coordinates[i].name,
                        index[0]);
  if (pair)
    ambulo__parameter_with(t->p, e->sign, &array[e->stride * m + e->other], "objective[%s].%s.%s%s",
                           t->item, e->key, model->coordinates[m].name, index[1]);
}

/* nothing but zero is the same on both sides of what is turned round */
static void add_offset(const term_keys *t, int i) {
  double sign, value = t->term->offset ? t->term->offset[i] : 0.0;
  int m = partner_of(t, i, &sign), rests = ambulo__term_has(t->term, AMBULO__TERM_REST);
  int turns = t->p->problem->model->coordinates[i].type == AMBULO_REVOLUTE;
  ambulo__quantity quantity = rests ? (turns ? AMBULO__ANGLE : AMBULO__STEP_LENGTH)
                                    : (turns ? AMBULO__TORQUE : AMBULO__FORCE);
  const entry e = {
      t->term->offset, 1, 0, 0, sign, rests ? "rest" : "offset", rests ? "angles" : "offset"};
  if (!t->term->offset || m == i || (!rests && value == 0.0)) return;
  add_entry(t, i, quantity, &e);
}

/* of a coordinate that is turned round the other direction's are the partner's, at opposite angles
 */
static void add_strength(const term_keys *t, int i) {
  static const char *const words[] = {"positive strength", "negative strength"};
  double sign;
  int m = partner_of(t, i, &sign);
  for (int down = 0; down < 2; down++) {
    int other = sign < 0.0 ? !down : down;
    if (!(t->term->strength[6 * i + 3 * down] > 0.0) || (m == i && down)) continue;
    for (int k = 0; k < 3; k++) {
      const entry e = {t->term->strength,
                       6,
                       3 * down + k,
                       3 * other + k,
                       sign < 0.0 && k == 2 ? -1.0 : 1.0,
                       k == 0   ? words[down]
                       : k == 1 ? "breadth of strength"
                                : "angle of strength",
                       "strength"};
      add_entry(t, i, AMBULO__RATIO, &e);
    }
  }
}

/* b1, k1, b2, k2 of b1 exp(k1 q) + b2 exp(k2 q): all opposite where the angle turns round */
static void add_passive(const term_keys *t, int i) {
  double sign;
  int m = partner_of(t, i, &sign);
  for (int k = 0; k < 4 && m != i; k++) {
    const entry e = {t->term->passive, 4, k, k, sign, "passive torque", "passive"};
    if (t->term->passive[4 * i + k] != 0.0) add_entry(t, i, AMBULO__RATIO, &e);
  }
}

static void add_prices(const term_keys *t, int i) {
  static const char *const words[] = {"weight on negative torque", "weight on positive torque"};
  double sign;
  int m = partner_of(t, i, &sign);
  for (int up = 0; up < 2; up++) {
    const entry e = {t->term->price, 2, up, sign < 0.0 ? !up : up, 1.0, words[up], "scale"};
    if (m != i || !up) add_entry(t, i, AMBULO__RATIO, &e);
  }
}

static int has_prices(const term_keys *t, int i) {
  const double *price = t->term->price;
  return price && (price[2 * i] != 1.0 || price[2 * i + 1] != 1.0);
}

static void add_coordinate(const term_keys *t, int i) {
  double sign;
  int m = partner_of(t, i, &sign);
  const ambulo_term *term = t->term;
  const entry scale = {term->scale, 1, 0, 0, 1.0, "scale", "scale"};
  const entry tendon = {term->tendon, 1, 0, 0, 1.0, "stiffness of the tendon", "tendon"};
  if (ambulo__term_scale(term, i) == 0.0 || (m >= 0 && m < i)) return; /* or said before */
  if (has_prices(t, i))
    add_prices(t, i);
  else if (term->scale)
    add_entry(t, i, AMBULO__RATIO, &scale);
  if (ambulo__term_has(term, AMBULO__TERM_OFFSET | AMBULO__TERM_REST)) add_offset(t, i);
  if (term->strength && !term->strength_is_limits) add_strength(t, i);
  if (term->passive) add_passive(t, i);
  if (term->tendon && term->tendon[i] > 0.0) add_entry(t, i, AMBULO__RATIO, &tendon);
}

static void add_term(const term_keys *t) {
  ambulo_term *term = t->term;
  char label[AMBULO__PARAMETER_TEXT];
  (void)snprintf(label, sizeof label, "weight of %s", t->name);
  ambulo__parameter_add(t->p, AMBULO__RATIO, &term->weight, label, "objective[%s].weight", t->item);
  if (ambulo__term_has(term, AMBULO__TERM_HEIGHT))
    ambulo__parameter_add(t->p, AMBULO__SHORT_LENGTH, &term->height,
                          "height that swinging feet keep", "objective[%s].height", t->item);
  (void)snprintf(label, sizeof label, "smoothing of %s", t->name);
  if (ambulo__term_has(term, AMBULO__TERM_SMOOTHING) && term->smoothing > 0.0)
    ambulo__parameter_add(t->p, AMBULO__RATIO, &term->smoothing, label, "objective[%s].smoothing",
                          t->item);
  (void)snprintf(label, sizeof label, "exponent of %s", t->name);
  if (ambulo__term_has(term, AMBULO__TERM_POWER))
    ambulo__parameter_add(t->p, AMBULO__RATIO, &term->power, label, "objective[%s].power", t->item);
  if (ambulo__term_info_of(term->kind)->subject == AMBULO__TERM_OF_OTHERS) return;
  for (int i = 0; i < t->p->problem->coordinates; i++) add_coordinate(t, i);
}

void ambulo__parameters_of_terms(ambulo__parameters *p) {
  ambulo_term *terms = ambulo__variant_terms(&p->variant);
  p->next.enters = AMBULO__ENTERS_TERM;
  for (int k = 0; k < p->problem->definition.term_count; k++) {
    term_keys t = {p, &terms[k], NULL, {0}};
    make_item(p->problem, k, &t);
    p->next.term = k;
    add_term(&t);
  }
  p->next.enters = AMBULO__ENTERS_ALL;
}

/* ---------------------------------------------------------------- constraints */

static void add_clearance(ambulo__parameters *p) {
  ambulo_clearance *c = &p->variant.definition.clearance;
  if (isnan(c->height)) return;
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, &c->height, "clearance",
                        "constraints.clearance.height");
  ambulo__parameter_add(p, AMBULO__STEP_LENGTH, &c->ceiling, "height allowed to swinging feet",
                        "constraints.clearance.ceiling");
  ambulo__parameter_add(p, AMBULO__SMALL_ANGLE, &c->turn, "turn allowed to swinging feet",
                        "constraints.clearance.turn");
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, &c->outward, "outward room of swinging feet",
                        "constraints.clearance.outward");
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, &c->inward, "inward room of swinging feet",
                        "constraints.clearance.inward");
  if (isnan(c->feet)) return;
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, &c->feet, "gap between the feet",
                        "constraints.clearance.feet");
}

static void add_tube(ambulo__parameters *p, int t, int i) {
  const ambulo_problem *problem = p->problem;
  const ambulo_coordinate *c = &problem->model->coordinates[i];
  double sign, *width = ambulo__variant_array(p->variant.definition.tubes[t].half_width);
  int m = ambulo__parameter_partner(problem, i, &sign), pair = m >= 0 && m != i;
  char label[AMBULO__PARAMETER_TEXT];
  if (!isfinite(width[i]) || width[i] == 0.0 || (pair && m < i)) return;
  (void)snprintf(label, sizeof label, "half width of the tube around %s%s", c->name,
                 pair ? AMBULO__BOTH_OF_A_PAIR : "");
  ambulo__parameter_add(p, c->type == AMBULO_REVOLUTE ? AMBULO__ANGLE : AMBULO__STEP_LENGTH,
                        &width[i], label, "constraints.tubes[%d].coordinates.%s", t, c->name);
  if (pair)
    ambulo__parameter_with(p, 1.0, &width[m], "constraints.tubes[%d].coordinates.%s", t,
                           problem->model->coordinates[m].name);
}

static void add_constraints(ambulo__parameters *p) {
  ambulo_problem_definition *d = &p->variant.definition;
  if (d->contact_tolerance > 0.0) {
    ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, &d->contact_tolerance, "contact tolerance",
                          "constraints.contact_tolerance");
    ambulo__parameter_add(p, AMBULO__SMALL_ANGLE, &d->orientation_tolerance,
                          "orientation tolerance", "constraints.orientation_tolerance");
  }
  if (d->contact_tolerance > 0.0 && d->strike_pitch[0] < d->strike_pitch[1]) {
    ambulo__parameter_add(p, AMBULO__ANGLE, &d->strike_pitch[0], "least pitch at heel strike",
                          "constraints.strike_pitch[0]");
    ambulo__parameter_add(p, AMBULO__ANGLE, &d->strike_pitch[1], "largest pitch at heel strike",
                          "constraints.strike_pitch[1]");
  }
  if (d->support != AMBULO_SUPPORT_OFF)
    ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, &d->support_margin,
                          "margin of the support polygon", "constraints.zmp_margin");
  if (d->contact_count > 0)
    ambulo__parameter_add(p, AMBULO__STEP_LENGTH, &d->ground_height, "height of the ground",
                          "constraints.ground_height");
  add_clearance(p);
  for (int t = 0; t < d->tube_count; t++)
    for (int i = 0; i < p->problem->coordinates; i++) add_tube(p, t, i);
}

/* --------------------------------------------------------- obstacles, reaches */

static const char *const ways[] = {"forward", "to the left", "up"};

/* "place of obstacle 'beam', up" at obstacles[beam].center[2] */
static void add_vector(ambulo__parameters *p, const ambulo_obstacle *o, double value[3],
                       const char *what, const char *key) {
  char label[AMBULO__PARAMETER_TEXT];
  for (int k = 0; k < 3; k++) {
    (void)snprintf(label, sizeof label, "%s of obstacle '%s', %s", what, o->name, ways[k]);
    ambulo__parameter_add(p, AMBULO__STEP_LENGTH, &value[k], label, "obstacles[%s].%s[%d]", o->name,
                          key, k);
  }
}

static void add_obstacle(ambulo__parameters *p, ambulo_obstacle *o) {
  char label[AMBULO__PARAMETER_TEXT];
  if (o->shape == AMBULO_OBSTACLE_BOX) {
    add_vector(p, o, o->center, "place", "center");
    (void)snprintf(label, sizeof label, "heading of obstacle '%s'", o->name);
    ambulo__parameter_add(p, AMBULO__ANGLE, &o->heading, label, "obstacles[%s].heading", o->name);
  } else {
    add_vector(p, o, o->from, "one end", "from");
    add_vector(p, o, o->to, "other end", "to");
    (void)snprintf(label, sizeof label, "radius of obstacle '%s'", o->name);
    ambulo__parameter_add(p, AMBULO__STEP_LENGTH, &o->radius, label, "obstacles[%s].radius",
                          o->name);
  }
  (void)snprintf(label, sizeof label, "margin of obstacle '%s'", o->name);
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, &o->margin, label, "obstacles[%s].margin",
                        o->name);
}

static void add_reach(ambulo__parameters *p, ambulo_reach *r, int index) {
  const ambulo_point *points = p->problem->model->points;
  const char *point = points[r->point].name;
  char label[AMBULO__PARAMETER_TEXT];
  for (int axis = 0; axis < 3; axis++) {
    if (axis != 1 && p->problem->definition.ends == AMBULO_ENDS_MIRRORED) continue; /* straight */
    if (r->is_relative)
      (void)snprintf(label, sizeof label, "way from %s to %s, %s", points[r->about].name, point,
                     ways[axis]);
    else
      (void)snprintf(label, sizeof label, "place that %s reaches, %s", point, ways[axis]);
    ambulo__parameter_add(p, AMBULO__STEP_LENGTH, &r->place[axis], label,
                          "constraints.reach[%d].place[%d]", index, axis);
  }
  if (r->tolerance == 0.0) return;
  (void)snprintf(label, sizeof label, "tolerance of the place that %s reaches", point);
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, &r->tolerance, label,
                        "constraints.reach[%d].tolerance", index);
}

static void add_bodies(ambulo__parameters *p) {
  ambulo_problem_definition *d = &p->variant.definition;
  ambulo_obstacle *obstacles = ambulo__variant_obstacles(&p->variant);
  ambulo_reach *reaches = ambulo__variant_reaches(&p->variant);
  if (ambulo_problem_pairs(p->problem, 0, NULL) > 0)
    ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, &d->collision.margin, "margin between capsules",
                          "constraints.collision.margin");
  for (int o = 0; o < d->obstacle_count; o++) add_obstacle(p, &obstacles[o]);
  for (int r = 0; r < d->reach_count; r++) add_reach(p, &reaches[r], r);
}

/* --------------------------------------------------------------------- ground */

static void add_ends(ambulo__parameters *p, double value[2], const char *rear, const char *front,
                     const char *key) {
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, &value[0], rear, "ground_reaction.pressure.%s[0]",
                        key);
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, &value[1], front, "ground_reaction.pressure.%s[1]",
                        key);
}

static void add_pressure(ambulo__parameters *p, ambulo_ground_reaction *r) {
  add_ends(p, r->heel_pressure, "rear end of the pressure under the heel",
           "front end of the pressure under the heel", "heel");
  add_ends(p, r->flat_pressure, "rear end of the pressure under the flat foot",
           "front end of the pressure under the flat foot", "flat");
  add_ends(p, r->toe_pressure, "rear end of the pressure under the toes",
           "front end of the pressure under the toes", "toe");
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, &r->heel_roll,
                        "roll of the pressure under the heel", "ground_reaction.pressure.roll");
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, &r->pressure_width, "width of the pressure",
                        "ground_reaction.pressure.width");
  if (r->arc_pressure > 0.0)
    ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, &r->arc_pressure,
                          "distance of the pressure from an arc's", "ground_reaction.pressure.arc");
}

static void add_sharing(ambulo__parameters *p, ambulo_ground_reaction *r) {
  ambulo__span flight;
  ambulo__parameter_add(p, AMBULO__STEP_LENGTH, &r->moment_arm, "moment arm of contacts",
                        "ground_reaction.moment_arm");
  ambulo__parameter_add(p, AMBULO__RATIO, &r->slant, "slant of forces on contacts",
                        "ground_reaction.slant");
  if (r->loading_rate >= 0.0)
    ambulo__parameter_add(p, AMBULO__LOADING_RATE, &r->loading_rate, "loading rate of contacts",
                          "ground_reaction.loading_rate");
  if (ambulo__flight_span(&p->problem->definition, &flight))
    ambulo__parameter_add(p, AMBULO__RATIO, &r->flight_tolerance, "force that is left in flight",
                          "ground_reaction.flight_tolerance");
}

static void add_ground(ambulo__parameters *p) {
  ambulo_problem_definition *d = &p->variant.definition;
  ambulo_ground_reaction *r = &d->ground_reaction;
  int reacts = r->kind != AMBULO_REACTION_NONE;
  if (d->minimum_force >= 0.0)
    ambulo__parameter_add(p, AMBULO__BODY_WEIGHT, &d->minimum_force, "least vertical force",
                          "%s.minimum_force", reacts ? "ground_reaction" : "constraints");
  if (!reacts) return;
  add_sharing(p, r);
  if (r->friction >= 0.0)
    ambulo__parameter_add(p, AMBULO__RATIO, &r->friction, "friction", "ground_reaction.friction");
  if (r->free_moment >= 0.0)
    ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, &r->free_moment, "free moment allowed",
                          "ground_reaction.free_moment");
  if (r->pressure) add_pressure(p, r);
}

void ambulo__parameters_of_task(ambulo__parameters *p) {
  add_constraints(p);
  add_bodies(p);
  add_ground(p);
}
