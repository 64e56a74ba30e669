/* solver/numbers_body.c - the body's numbers by their keys: `subject`, `load`, `ground.slope`, the
 * limits of its coordinates, what it wears and what its hands hold.
 *
 * `subject.mass` moves all bodies and, where the model's torques are shares of weight and stature,
 * the torque limits; `subject.stature` all lengths that are shares of it. Both move what is written
 * for another body.
 *
 * A file's `mirror: true` is one key of two devices; two that are listed have to stay alike with
 * mirrored ends, and move together. Numbers of what hands hold that are zero are mostly not in the
 * file and have no key; of a center or a push that is there, all three numbers have one. With
 * mirrored ends what it has to the side stays zero.
 */
#include "solver/sensitivity.h"

#include "contact/row_families.h"
#include "contact/devices.h"
#include "model/conditions.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ----------------------------------------------------------- subject and load */

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

static void add_load(ambulo__parameters *p, int i) {
  const ambulo_model *model = p->problem->model;
  const ambulo__problem_keys *keys = &p->problem->keys;
  double *load = p->variant.body.load;
  int partner = partner_of_load(p->problem, i);
  char label[AMBULO__PARAMETER_TEXT];
  if (partner < i) return; /* said before */
  if (!keys->loads && model->load_count == 1) {
    ambulo__parameter_add(p, AMBULO__MASS, &load[i], "load", "load.mass");
    return;
  }
  (void)snprintf(label, sizeof label, "load on %s%s", model->links[model->loads[i].link].name,
                 partner != i ? AMBULO__BOTH_OF_A_PAIR : "");
  const int *item = keys->load_item; /* hands hold others */
  ambulo__parameter_add(p, AMBULO__MASS, &load[i], label, "load[%d].mass",
                        keys->loads ? item[i] : i);
  if (partner != i)
    ambulo__parameter_with(p, 1.0, &load[partner], "load[%d].mass",
                           keys->loads ? item[partner] : partner);
}

/* --------------------------------------------------------------------- drives */

/* armature, damping, friction [3] */
static double *drive_of(ambulo_coordinate *c, int part) {
  double *const parts[] = {&c->armature, &c->damping, &c->friction};
  return parts[part];
}

/* what one of a file's is in SI units */
static double drive_unit(const ambulo__model_units *u, int turns, int part) {
  double length = u->length, torque = turns ? u->moment : u->force;
  if (part == 0) return turns ? u->mass * length * length : u->mass;
  return part == 1 && !turns ? torque / length : torque;
}

/* of those that the file has: a number, or both sides', which move together */
static void add_drive(ambulo__parameters *p, int i, int part) {
  static const char *const keys[] = {"armature", "damping", "friction"};
  const ambulo_model *model = p->problem->model;
  ambulo_coordinate *c = &p->variant.coordinates[i];
  double sign, *value = drive_of(c, part);
  int m = ambulo__parameter_partner(p->problem, i, &sign), pair = m >= 0 && m != i;
  if (*value == 0.0 || (pair && m < i)) return;
  char label[AMBULO__PARAMETER_TEXT];
  (void)snprintf(label, sizeof label, "%s of %s%s", keys[part], c->name,
                 pair ? AMBULO__BOTH_OF_A_PAIR : "");
  ambulo__parameter_add(p, AMBULO__RATIO, value, label, "model.links[%s].coordinate.%s",
                        model->links[model->coordinate_written[i]].name, keys[part]);
  ambulo__parameter_sized(p, drive_unit(&model->units, c->type == AMBULO_REVOLUTE, part));
  if (pair)
    ambulo__parameter_with(p, 1.0, drive_of(&p->variant.coordinates[m], part),
                           "model.links[%s].coordinate.%s",
                           model->links[model->coordinate_written[m]].name, keys[part]);
}

void ambulo__parameters_of_body(ambulo__parameters *p) {
  const ambulo__model_units *units = &p->problem->model->units;
  ambulo__body_numbers *body = &p->variant.body;
  if (body->mass > 0.0 && units->mass != 1.0) {
    ambulo__parameter_add(p, AMBULO__MASS, &body->mass, "body mass", "subject.mass");
    ambulo__parameter_within(p, 1.0, 1000.0);
  }
  if (body->stature > 0.0 && units->length != 1.0 && units->length != 0.0) {
    ambulo__parameter_add(p, AMBULO__STEP_LENGTH, &body->stature, "stature", "subject.stature");
    ambulo__parameter_within(p, 0.3, 3.0);
  }
  for (int i = 0; i < p->problem->model->load_count; i++) add_load(p, i);
  for (int i = 0; i < p->problem->coordinates; i++)
    for (int part = 0; part < 3; part++) add_drive(p, i, part);
  if (p->problem->definition.contact_count == 0) return;
  ambulo__parameter_add(p, AMBULO__ANGLE, &body->slope, "slope", "ground.slope");
  ambulo__parameter_within(p, -AMBULO__LARGEST_SLOPE, AMBULO__LARGEST_SLOPE);
}

/* --------------------------------------------------------------------- limits */

static int has_rows(const ambulo_problem *problem, ambulo_limited what) {
  const ambulo_problem_definition *d = &problem->definition;
  if (what == AMBULO_LIMITED_POSITION) return d->joint_limits != AMBULO_LIMIT_OFF;
  if (what == AMBULO_LIMITED_SPEED) return d->speed_limits;
  int strengths = 0;
  for (int t = 0; t < d->term_count; t++) strengths |= d->terms[t].strength_is_limits;
  return d->torque_limits || strengths;
}

/* of a coordinate, [2] */
static double *limits_of(ambulo_coordinate *c, ambulo_limited what) {
  if (what == AMBULO_LIMITED_POSITION) return c->range;
  return what == AMBULO_LIMITED_SPEED ? c->speed : c->torque;
}

/* half of a coordinate that is fixed cannot move alone */
static int is_fixed(const double limits[2]) {
  return limits[0] == limits[1];
}

/* one limit, or those of both sides, which hold in each other's half of the stride */
static void add_limit(ambulo__parameters *p, ambulo_limited what, int i, int side) {
  static const char *const keys[] = {"range", "speed", "torque"};
  static const char *const words[] = {"limit", "speed limit", "torque limit"};
  static const ambulo__quantity turning[] = {AMBULO__ANGLE, AMBULO__TURNING_SPEED, AMBULO__TORQUE};
  static const ambulo__quantity sliding[] = {AMBULO__STEP_LENGTH, AMBULO__SPEED, AMBULO__FORCE};
  const ambulo_model *model = p->problem->model;
  ambulo_coordinate *c = &p->variant.coordinates[i];
  double sign, *limit = limits_of(c, what);
  int k = (int)what - (int)AMBULO_LIMITED_POSITION;
  int m = ambulo__parameter_partner(p->problem, i, &sign), other = sign < 0.0 ? !side : side;
  if (!isfinite(limit[side]) || is_fixed(limit) || (m >= 0 && (m < i || (m == i && !side))))
    return; /* none, or said before */
  char label[AMBULO__PARAMETER_TEXT];
  (void)snprintf(label, sizeof label, "%s %s of %s%s", side ? "upper" : "lower", words[k], c->name,
                 m >= 0 ? AMBULO__BOTH_OF_A_PAIR : "");
  ambulo__parameter_add(p, c->type == AMBULO_REVOLUTE ? turning[k] : sliding[k], &limit[side],
                        label, "model.links[%s].coordinate.%s[%d]",
                        model->links[model->coordinate_written[i]].name, keys[k], side);
  if (m >= 0)
    ambulo__parameter_with(p, sign, &limits_of(&p->variant.coordinates[m], what)[other],
                           "model.links[%s].coordinate.%s[%d]",
                           model->links[model->coordinate_written[m]].name, keys[k], other);
}

void ambulo__parameters_of_limits(ambulo__parameters *p) {
  p->next.enters = AMBULO__ENTERS_LIMITS;
  for (int what = AMBULO_LIMITED_POSITION; what <= AMBULO_LIMITED_TORQUE; what++) {
    if (!has_rows(p->problem, (ambulo_limited)what)) continue;
    for (int i = 0; i < p->problem->coordinates; i++) {
      add_limit(p, (ambulo_limited)what, i, 0);
      add_limit(p, (ambulo_limited)what, i, 1);
    }
  }
  p->next.enters = AMBULO__ENTERS_ALL;
}

/* -------------------------------------------------------------------- devices */

typedef struct device_keys {
  ambulo__parameters *p;
  ambulo_device *all, *device;
  int image;   /* of what moves by the same key; -1 */
  int partner; /* of what has a key of its own and has to move along; -1 */
  double sign; /* of its rest, pretension and amount */
} device_keys;

/* the number of another device that stands where `at` does in this one */
static double *same_of(const device_keys *k, int device, const double *at) {
  char *here = (char *)&k->all[device];
  return (double *)(void *)(here + ((const char *)at - (const char *)k->device));
}

/* `odd`: what changes its sign in the mirror */
static void add_of_device(const device_keys *k, ambulo__quantity quantity, double *at, int odd,
                          const char *what, const char *key) {
  double sign = odd ? k->sign : 1.0;
  char label[AMBULO__PARAMETER_TEXT];
  (void)snprintf(label, sizeof label, "%s of %s%s", what, k->device->name,
                 k->image >= 0 || k->partner >= 0 ? AMBULO__BOTH_OF_A_PAIR : "");
  ambulo__parameter_add(k->p, quantity, at, label, "devices[%s].%s", k->device->name, key);
  if (k->image >= 0) ambulo__parameter_place(k->p, sign, same_of(k, k->image, at));
  if (k->partner >= 0)
    ambulo__parameter_with(k->p, sign, same_of(k, k->partner, at), "devices[%s].%s",
                           k->all[k->partner].name, key);
}

static void add_spring(const device_keys *k, int turns) {
  ambulo_device *v = k->device;
  ambulo__quantity along = turns ? AMBULO__ANGLE : AMBULO__STEP_LENGTH;
  ambulo__quantity stiff = turns ? AMBULO__TURNING_STIFF : AMBULO__STIFF;
  add_of_device(k, v->stiffness != 0.0 ? AMBULO__RATIO : stiff, &v->stiffness, 0, "stiffness",
                "stiffness");
  add_of_device(k, along, &v->rest, 1, "rest", "rest");
  if (v->pretension != 0.0)
    add_of_device(k, turns ? AMBULO__TORQUE : AMBULO__FORCE, &v->pretension, 1, "pretension",
                  "pretension");
  if (v->side != AMBULO_DEVICE_BOTH)
    add_of_device(k, along, &v->smoothing, 0, "smoothing", "smoothing");
}

static void add_device(const device_keys *k) {
  ambulo_device *v = k->device;
  int turns = ambulo__device_turns(k->p->problem->model, v);
  ambulo__quantity amount = v->clock != AMBULO_DEVICE_CONSTANT ? AMBULO__RATIO
                            : turns                            ? AMBULO__TORQUE
                                                               : AMBULO__FORCE;
  if (v->kind == AMBULO_DEVICE_SPRING) add_spring(k, turns);
  if (v->kind == AMBULO_DEVICE_DAMPER)
    add_of_device(k, AMBULO__RATIO, &v->damping, 0, "damping", "damping");
  if (v->kind == AMBULO_DEVICE_ACTUATOR)
    add_of_device(k, amount, &v->amount, 1, "amount", "amount");
  if (!v->clutch) return;
  add_of_device(k, AMBULO__RATIO, &v->from, 0, "engagement", "engaged.from");
  add_of_device(k, AMBULO__RATIO, &v->to, 0, "release", "engaged.to");
  add_of_device(k, AMBULO__RATIO, &v->ramp, 0, "ramp", "engaged.ramp");
}

void ambulo__parameters_of_devices(ambulo__parameters *p) {
  const ambulo_problem_definition *d = &p->problem->definition;
  ambulo_device *all = ambulo__variant_own(p->variant.definition.devices);
  for (int i = 0; i < d->device_count; i++) {
    device_keys k = {p, all, &all[i], -1, -1, 1.0};
    int partner = -1;
    if (all[i].image_of >= 0) continue;
    for (int image = 0; image < d->device_count; image++)
      if (all[image].image_of == i) k.image = image;
    if (all[i].coordinate >= 0) k.sign = d->model->coordinates[all[i].coordinate].mirror_sign;
    if (d->ends == AMBULO_ENDS_MIRRORED && k.image < 0)
      partner = ambulo__device_partner(d, i, &k.sign);
    if (partner >= 0 && partner < i) continue; /* said before */
    if (partner != i) k.partner = partner;
    add_device(&k);
  }
}

/* ----------------------------------------------------------- what hands hold */

static void name_path(const ambulo_problem *problem, const ambulo_hold *hold, int i,
                      char path[AMBULO__PARAMETER_TEXT]) {
  const ambulo__problem_keys *keys = &problem->keys;
  int alone = problem->definition.hold_count == 1 && problem->model->load_count == 0;
  if (alone && !keys->loads)
    (void)snprintf(path, AMBULO__PARAMETER_TEXT, "load");
  else if (strcmp(hold->name, "load") == 0) /* as loads without a name are called */
    (void)snprintf(path, AMBULO__PARAMETER_TEXT, "load[%d]", keys->loads ? keys->hold_item[i] : i);
  else
    (void)snprintf(path, AMBULO__PARAMETER_TEXT, "load[%s]", hold->name);
}

static int is_zero(const double vector[3]) {
  return vector[0] == 0.0 && vector[1] == 0.0 && vector[2] == 0.0;
}

static int is_time(const ambulo__member *m) {
  return m->quantity == AMBULO__EVENT_TIME || m->quantity == AMBULO__TIME;
}

static int is_not_in_file(const ambulo__parameters *p, const void *item, const ambulo__member *m,
                          int k) {
  const ambulo_hold *h = item;
  const double *at = (const double *)(const void *)((const char *)item + m->at);
  int rises = ambulo__hold_rises(h), falls = ambulo__hold_falls(h, p->problem->definition.duration);
  if (is_time(m) != p->next.moves_events) return 1;
  if (m->count == 3)
    return is_zero(at) || (k == 1 && p->problem->definition.ends == AMBULO_ENDS_MIRRORED);
  if (at == &h->from) return !rises;
  if (at == &h->to) return !falls;
  return at == &h->ramp ? !rises && !falls : *at == 0.0;
}

/* with its times nodes go along, on grids on events where nothing else begins or ends then */
void ambulo__parameters_of_holds(ambulo__parameters *p) {
  ambulo_hold *holds = ambulo__variant_own(p->variant.definition.holds);
  char path[AMBULO__PARAMETER_TEXT], of[AMBULO__PARAMETER_TEXT];
  for (int i = 0; i < p->problem->definition.hold_count; i++) {
    name_path(p->problem, &holds[i], i, path);
    (void)snprintf(of, sizeof of, "of %s", holds[i].name);
    for (int times = 0; times < 2; times++) {
      p->next.moves_events = times;
      ambulo__parameters_of_members(p, &ambulo__hold_members, &holds[i], path, of, is_not_in_file);
    }
    p->next.moves_events = 0;
  }
}
