/* solver/sensitivity_parameters.c - the numbers of constraints, ground, ends and body, by their
 * keys.
 *
 * What a key moves beside: `subject.mass` all bodies and, where the model's torques are shares of
 * weight and stature, the torque limits. A key that is one of several for one member, or an end
 * of a pair, has that member's partial; keys that move several have the chain rule's sum.
 */
#include "solver/sensitivity_parameters.h"

#include "contact/bounds.h"
#include "contact/flight.h"

#include <math.h>
#include <stdio.h>

/* ---------------------------------------------------------------- constraints */

static void add_clearance(ambulo__parameters *p) {
  const ambulo_clearance *c = &p->problem->definition.clearance, *by = &p->partials->clearance;
  if (isnan(c->height)) return;
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, c->height, by->height, "clearance",
                        "constraints.clearance.height");
  ambulo__parameter_add(p, AMBULO__STEP_LENGTH, c->ceiling, by->ceiling,
                        "height allowed to swinging feet", "constraints.clearance.ceiling");
  ambulo__parameter_add(p, AMBULO__SMALL_ANGLE, c->turn, by->turn, "turn allowed to swinging feet",
                        "constraints.clearance.turn");
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, c->outward, by->outward,
                        "outward room of swinging feet", "constraints.clearance.outward");
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, c->inward, by->inward,
                        "inward room of swinging feet", "constraints.clearance.inward");
  if (isnan(c->feet)) return;
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, c->feet, by->feet, "gap between the feet",
                        "constraints.clearance.feet");
}

static void add_contact_rows(ambulo__parameters *p) {
  const ambulo_problem_definition *d = &p->problem->definition;
  const ambulo__partials *by = p->partials;
  if (d->contact_tolerance > 0.0) {
    ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, d->contact_tolerance, by->contact_tolerance,
                          "contact tolerance", "constraints.contact_tolerance");
    ambulo__parameter_add(p, AMBULO__SMALL_ANGLE, d->orientation_tolerance,
                          by->orientation_tolerance, "orientation tolerance",
                          "constraints.orientation_tolerance");
  }
  if (d->contact_tolerance > 0.0 && d->strike_pitch[0] < d->strike_pitch[1]) {
    ambulo__parameter_add(p, AMBULO__ANGLE, d->strike_pitch[0], by->strike_pitch[0],
                          "least pitch at heel strike", "constraints.strike_pitch[0]");
    ambulo__parameter_add(p, AMBULO__ANGLE, d->strike_pitch[1], by->strike_pitch[1],
                          "largest pitch at heel strike", "constraints.strike_pitch[1]");
  }
  if (d->support != AMBULO_SUPPORT_OFF)
    ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, d->support_margin, by->support_margin,
                          "margin of the support polygon", "constraints.zmp_margin");
  if (d->contact_count > 0)
    ambulo__parameter_add(p, AMBULO__STEP_LENGTH, d->ground_height, by->ground_height,
                          "height of the ground", "constraints.ground_height");
  add_clearance(p);
  ambulo__parameters_of_bodies(p);
}

static void add_tube(ambulo__parameters *p, int t, int i) {
  const ambulo_problem *problem = p->problem;
  const ambulo_coordinate *c = &problem->model->coordinates[i];
  const double *by = p->partials->half_width + t * problem->coordinates;
  double sign, width = problem->definition.tubes[t].half_width[i];
  int m = ambulo__parameter_partner(problem, i, &sign), pair = m >= 0 && m != i;
  if (!isfinite(width) || width == 0.0 || (pair && m < i)) return;
  char label[AMBULO__PARAMETER_TEXT];
  (void)snprintf(label, sizeof label, "half width of the tube around %s%s", c->name,
                 pair ? AMBULO__BOTH_OF_A_PAIR : "");
  ambulo__parameter_add(p, c->type == AMBULO_REVOLUTE ? AMBULO__ANGLE : AMBULO__STEP_LENGTH, width,
                        by[i] + (pair ? by[m] : 0.0), label, "constraints.tubes[%d].coordinates.%s",
                        t, c->name);
  if (pair)
    ambulo__parameter_with(p, 1.0, "constraints.tubes[%d].coordinates.%s", t,
                           problem->model->coordinates[m].name);
}

static void add_tubes(ambulo__parameters *p) {
  for (int t = 0; t < p->problem->definition.tube_count; t++) {
    for (int i = 0; i < p->problem->coordinates; i++) add_tube(p, t, i);
  }
}

/* --------------------------------------------------------------------- ground */

static void add_pair(ambulo__parameters *p, const double value[2], const double by[2],
                     const char *rear, const char *front, const char *key) {
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, value[0], by[0], rear,
                        "ground_reaction.pressure.%s[0]", key);
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, value[1], by[1], front,
                        "ground_reaction.pressure.%s[1]", key);
}

static void add_pressure(ambulo__parameters *p) {
  const ambulo_ground_reaction *r = &p->problem->definition.ground_reaction;
  const ambulo_ground_reaction *by = &p->partials->reaction;
  add_pair(p, r->heel_pressure, by->heel_pressure, "rear end of the pressure under the heel",
           "front end of the pressure under the heel", "heel");
  add_pair(p, r->flat_pressure, by->flat_pressure, "rear end of the pressure under the flat foot",
           "front end of the pressure under the flat foot", "flat");
  add_pair(p, r->toe_pressure, by->toe_pressure, "rear end of the pressure under the toes",
           "front end of the pressure under the toes", "toe");
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, r->heel_roll, by->heel_roll,
                        "roll of the pressure under the heel", "ground_reaction.pressure.roll");
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, r->pressure_width, by->pressure_width,
                        "width of the pressure", "ground_reaction.pressure.width");
  if (r->arc_pressure > 0.0)
    ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, r->arc_pressure, by->arc_pressure,
                          "distance of the pressure from an arc's", "ground_reaction.pressure.arc");
}

static void add_sharing(ambulo__parameters *p) {
  const ambulo_ground_reaction *r = &p->problem->definition.ground_reaction;
  const ambulo_ground_reaction *by = &p->partials->reaction;
  ambulo__parameter_add(p, AMBULO__STEP_LENGTH, r->moment_arm, by->moment_arm,
                        "moment arm of contacts", "ground_reaction.moment_arm");
  ambulo__parameter_add(p, AMBULO__RATIO, r->slant, by->slant, "slant of forces on contacts",
                        "ground_reaction.slant");
  if (r->loading_rate >= 0.0)
    ambulo__parameter_add(p, AMBULO__LOADING_RATE, r->loading_rate, by->loading_rate,
                          "loading rate of contacts", "ground_reaction.loading_rate");
  ambulo__span flight;
  if (ambulo__flight_span(&p->problem->definition, &flight))
    ambulo__parameter_add(p, AMBULO__RATIO, r->flight_tolerance, by->flight_tolerance,
                          "force that is left in flight", "ground_reaction.flight_tolerance");
}

static void add_ground(ambulo__parameters *p) {
  const ambulo_problem_definition *d = &p->problem->definition;
  const ambulo_ground_reaction *r = &d->ground_reaction, *by = &p->partials->reaction;
  int reacts = r->kind != AMBULO_REACTION_NONE;
  if (d->minimum_force >= 0.0)
    ambulo__parameter_add(p, AMBULO__BODY_WEIGHT, d->minimum_force, p->partials->minimum_force,
                          "least vertical force", "%s.minimum_force",
                          reacts ? "ground_reaction" : "constraints");
  if (!reacts) return;
  add_sharing(p);
  if (r->friction >= 0.0)
    ambulo__parameter_add(p, AMBULO__RATIO, r->friction, by->friction, "friction",
                          "ground_reaction.friction");
  if (r->free_moment >= 0.0)
    ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, r->free_moment, by->free_moment,
                          "free moment allowed", "ground_reaction.free_moment");
  if (r->pressure) add_pressure(p);
}

/* ----------------------------------------------------------------------- body */

/* d/d ln M of torque limits that are shares of weight and stature */
static double by_strength(const ambulo_problem *problem, const ambulo__partials *partials) {
  const ambulo_model *model = problem->model;
  double sum = 0.0, moment = model->units.moment;
  for (int i = 0; moment != 0.0 && moment != 1.0 && i < problem->coordinates; i++) {
    for (int side = 0; side < 2; side++) {
      double limit = model->coordinates[i].torque[side];
      int at = 2 * (ambulo__limited_place(AMBULO_LIMITED_TORQUE) * problem->coordinates + i) + side;
      if (isfinite(limit)) sum += limit * partials->limit[at];
    }
  }
  return sum;
}

/* d/d ln M of terms that are written for another body (definitions/problem_written_for.c), but for
 * offsets that are the body weight, which partials->body has; NaN: not known */
static double by_written_for(const ambulo__parameters *p) {
  const ambulo_problem_definition *d = &p->problem->definition;
  const ambulo__partials *by = p->partials;
  double sum = 0.0;
  for (int t = 0; p->problem->keys.written_for && t < p->problem->keys.terms; t++) {
    const ambulo_term *term = &d->terms[t];
    int priced = term->kind == AMBULO_TORQUE_POWER && term->strength;
    for (int i = 0; term->tendon && i < p->problem->coordinates; i++)
      sum += by->tendon[t * p->problem->coordinates + i] * term->tendon[i];
    int counts = term->kind == AMBULO_TORQUE_POWER || term->kind == AMBULO_TORQUE_SQUARED ||
                 term->kind == AMBULO_TORQUE_ABSOLUTE || term->kind == AMBULO_TORQUE_RATE;
    if (!counts) continue;
    if (term->passive) return (double)NAN;
    for (int i = 0; i < p->problem->coordinates; i++) {
      size_t at = (size_t)t * (size_t)p->problem->coordinates + (size_t)i;
      if (!priced && ambulo__term_scale(term, i) != 0.0)
        sum -= by->scale[at] * ambulo__term_scale(term, i);
      if (term->offset && !ambulo__offset_is_weight(p->problem, term, i))
        sum += by->offset[at] * term->offset[i];
      if (!priced || term->strength_is_limits) continue;
      sum += by->strength[2 * at] * term->strength[6 * i];
      sum += by->strength[2 * at + 1] * term->strength[6 * i + 3];
    }
  }
  return sum;
}

/* with mirrored ends, the load on the other side that moves along; i itself in the middle */
static int partner_of_load(const ambulo_problem *problem, int i) {
  const ambulo_model *m = problem->model;
  const ambulo__model_load *load = &m->loads[i];
  if (problem->definition.ends != AMBULO_ENDS_MIRRORED) return i;
  for (int k = 0; k < m->load_count; k++) {
    const ambulo__model_load *other = &m->loads[k];
    if (ambulo__places_mirror(m, load->link, load->position, other->link, other->position))
      return k;
  }
  return i;
}

static void add_loads(ambulo__parameters *p) {
  const ambulo_model *model = p->problem->model;
  for (int i = 0; i < model->load_count; i++) {
    double mass = model->loads[i].mass;
    int partner = partner_of_load(p->problem, i);
    if (partner < i) continue; /* said before */
    if (!p->problem->keys.loads && model->load_count == 1) {
      ambulo__parameter_add(p, AMBULO__MASS, mass, p->partials->load[i], "load", "load.mass");
      continue;
    }
    char label[AMBULO__PARAMETER_TEXT];
    (void)snprintf(label, sizeof label, "load on %s%s", model->links[model->loads[i].link].name,
                   partner != i ? AMBULO__BOTH_OF_A_PAIR : "");
    double by = p->partials->load[i] + (partner != i ? p->partials->load[partner] : 0.0);
    const int *item = p->problem->keys.load_item; /* hands hold others */
    ambulo__parameter_add(p, AMBULO__MASS, mass, by, label, "load[%d].mass",
                          p->problem->keys.loads ? item[i] : i);
    if (partner != i)
      ambulo__parameter_with(p, 1.0, "load[%d].mass",
                             p->problem->keys.loads ? item[partner] : partner);
  }
}

static void add_body(ambulo__parameters *p) {
  const ambulo_model *model = p->problem->model;
  const double *g = model->gravity;
  double along[2] = {0.0, 0.0}, mass = model->units.mass;
  for (int i = 0; i < 3; i++) {
    along[0] -= g[i] * model->up[i];
    along[1] -= g[i] * model->forward[i];
  }
  if (mass == 0.0) mass = model->mass - ambulo__model_load_mass(model); /* made from C */
  double by_mass = p->partials->body + by_strength(p->problem, p->partials) + by_written_for(p);
  if (mass > 0.0 && model->units.mass != 1.0 && isfinite(by_mass))
    ambulo__parameter_add(p, AMBULO__MASS, mass, by_mass / mass, "body mass", "subject.mass");
  add_loads(p);
  if (p->problem->definition.contact_count > 0)
    ambulo__parameter_add(p, AMBULO__ANGLE, atan2(along[1], along[0]), p->partials->slope, "slope",
                          "ground.slope");
}

static int has_rows(const ambulo_problem *problem, ambulo_limited what) {
  const ambulo_problem_definition *d = &problem->definition;
  if (what == AMBULO_LIMITED_POSITION) return d->joint_limits != AMBULO_LIMIT_OFF;
  return what == AMBULO_LIMITED_SPEED ? d->speed_limits : d->torque_limits;
}

/* one limit, or those of both sides, which hold in each other's half of the stride */
static void add_limit(ambulo__parameters *p, ambulo_limited what, int i, int side) {
  static const char *const keys[] = {"range", "speed", "torque"};
  static const char *const words[] = {"limit", "speed limit", "torque limit"};
  static const ambulo__quantity turning[] = {AMBULO__ANGLE, AMBULO__TURNING_SPEED, AMBULO__TORQUE};
  static const ambulo__quantity sliding[] = {AMBULO__STEP_LENGTH, AMBULO__SPEED, AMBULO__FORCE};
  const ambulo_model *model = p->problem->model;
  const ambulo_coordinate *c = &model->coordinates[i];
  int k = ambulo__limited_place(what);
  const double *limit = p->partials->limit + 2 * k * p->problem->coordinates;
  double sign, by = limit[2 * i + side];
  int m = ambulo__parameter_partner(p->problem, i, &sign), other = sign < 0.0 ? !side : side;
  if (m >= 0) by += sign * limit[2 * m + other];
  if ((by == 0.0 && !(p->all && has_rows(p->problem, what))) ||
      (m >= 0 && (m < i || (m == i && !side))))
    return; /* no use, or said before */
  char label[AMBULO__PARAMETER_TEXT];
  (void)snprintf(label, sizeof label, "%s %s of %s%s", side ? "upper" : "lower", words[k], c->name,
                 m >= 0 ? AMBULO__BOTH_OF_A_PAIR : "");
  ambulo__parameter_add(p, c->type == AMBULO_REVOLUTE ? turning[k] : sliding[k],
                        ambulo__limits_of(c, what)[side], by, label,
                        "model.links[%s].coordinate.%s[%d]",
                        model->links[model->coordinate_written[i]].name, keys[k], side);
  if (m >= 0)
    ambulo__parameter_with(p, sign, "model.links[%s].coordinate.%s[%d]",
                           model->links[model->coordinate_written[m]].name, keys[k], other);
}

static void add_ends(ambulo__parameters *p) {
  static const char *const keys[] = {"", "_speed", "_acceleration"};
  static const char *const words[] = {"", "speed of ", "acceleration of "};
  static const ambulo__quantity turning[] = {AMBULO__ANGLE, AMBULO__TURNING_SPEED,
                                             AMBULO__TURNING_JOLT};
  static const ambulo__quantity sliding[] = {AMBULO__STEP_LENGTH, AMBULO__SPEED, AMBULO__JOLT};
  const ambulo_problem_definition *d = &p->problem->definition;
  char label[AMBULO__PARAMETER_TEXT];
  for (int e = 0; e < d->end_value_count; e++) {
    const ambulo_end_value *end = &d->end_values[e];
    const ambulo_coordinate *c = &d->model->coordinates[end->coordinate];
    (void)snprintf(label, sizeof label, "%s %s%s", end->final ? "final" : "initial",
                   words[end->order], c->name);
    ambulo__parameter_add(p, c->type == AMBULO_REVOLUTE ? turning[end->order] : sliding[end->order],
                          end->value, p->partials->end_value[e], label, "ends.%s%s.%s",
                          end->final ? "final" : "initial", keys[end->order], c->name);
  }
}

ambulo_status ambulo__parameters_name(ambulo__parameters *p) {
  ambulo__partials partials;
  ambulo__pool pool;
  ambulo__pool_init(&pool, &p->allocator);
  ambulo_status status = ambulo__partials_create(p->problem, &pool, &partials);
  if (!status) ambulo__partials_name_places(p->problem, &partials);
  if (!status) status = ambulo__partials_name_events(p->problem, &pool, &partials);
  p->partials = &partials;
  p->all = 1;
  if (!status) status = ambulo__parameters_collect(p);
  p->partials = NULL;
  ambulo__pool_clear(&pool);
  return status;
}

ambulo_status ambulo__parameters_collect(ambulo__parameters *p) {
  ambulo__parameters_of_walk(p);
  ambulo__parameters_of_events(p);
  add_body(p);
  ambulo__parameters_of_devices(p);
  ambulo__parameters_of_holds(p);
  ambulo__parameters_of_terms(p);
  add_contact_rows(p);
  add_tubes(p);
  add_ground(p);
  add_ends(p);
  for (int what = AMBULO_LIMITED_POSITION; what <= AMBULO_LIMITED_TORQUE; what++) {
    for (int i = 0; i < p->problem->coordinates; i++) {
      add_limit(p, (ambulo_limited)what, i, 0);
      add_limit(p, (ambulo_limited)what, i, 1);
    }
  }
  return p->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}
