/* solver/numbers_task.c - numbers of the objective's terms, of the constraints, of the ground and
 * of what stands in the way, by their keys: objective[name].weight, constraints.zmp_margin, ... */
#include "solver/sensitivity.h"

#include "contact/row_families.h"
#include "problem/definition.h"

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
  double sign, size;
  const char *what, *key;
} entry;

/* what they are multiplied by for another body */
static ambulo__term_sizes sizes_of(const term_keys *t, int i) {
  const ambulo__problem_keys *keys = &t->p->problem->keys;
  int turns = t->p->problem->model->coordinates[i].type == AMBULO_REVOLUTE;
  return ambulo__term_sizes_of(t->term, turns, keys->longer, keys->heavier);
}

static void add_entry(const term_keys *t, int i, ambulo__quantity quantity, const entry *e) {
  const ambulo_model *model = t->p->problem->model;
  double sign, *array = ambulo__variant_own(e->array);
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
  ambulo__parameter_sized(t->p, e->size);
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
  const entry e = {.array = t->term->offset,
                   .stride = 1,
                   .sign = sign,
                   .size = sizes_of(t, i).offset,
                   .what = rests ? "rest" : "offset",
                   .key = rests ? "angles" : "offset"};
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
                       k == 0 ? sizes_of(t, i).peak : 1.0,
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
    double size = k % 2 == 0 ? sizes_of(t, i).peak : 1.0;
    const entry e = {t->term->passive, 4, k, k, sign, size, "passive torque", "passive"};
    if (t->term->passive[4 * i + k] != 0.0) add_entry(t, i, AMBULO__RATIO, &e);
  }
}

static void add_prices(const term_keys *t, int i) {
  static const char *const words[] = {"weight on negative torque", "weight on positive torque"};
  double sign;
  int m = partner_of(t, i, &sign);
  for (int up = 0; up < 2; up++) {
    const entry e = {t->term->price, 2, up, sign < 0.0 ? !up : up, 1.0, 1.0, words[up], "scale"};
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
  const ambulo__term_sizes sizes = sizes_of(t, i);
  const entry scale = {term->scale, 1, 0, 0, 1.0, sizes.scale, "scale", "scale"};
  const entry tendon = {term->tendon, 1, 0, 0, 1.0, sizes.tendon, "stiffness of the tendon",
                        "tendon"};
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

static int is_of_another_kind(const ambulo__parameters *p, const void *term,
                              const ambulo__member *m, int k) {
  (void)p;
  (void)k;
  return m->of_kinds && !ambulo__term_has(term, m->of_kinds);
}

/* of the term's own numbers, which are those from `first` on */
static void set_size_of_weight(const term_keys *t, int first) {
  double *weight = &t->term->weight;
  for (int i = first; i < t->p->count && t->p->problem->keys.written_for; i++)
    if (t->p->address[t->p->list[i].address].at == weight)
      t->p->list[i].size = sizes_of(t, 0).weight;
}

static void add_term(const term_keys *t) {
  char path[ITEM_TEXT + 12];
  int first = t->p->count;
  (void)snprintf(path, sizeof path, "objective[%s]", t->item);
  ambulo__parameters_of_members(t->p, &ambulo__term_members, t->term, path, t->name,
                                is_of_another_kind);
  set_size_of_weight(t, first);
  if (ambulo__term_info_of(t->term->kind)->subject == AMBULO__TERM_OF_OTHERS) return;
  for (int i = 0; i < t->p->problem->coordinates; i++) add_coordinate(t, i);
}

void ambulo__parameters_of_terms(ambulo__parameters *p) {
  ambulo_term *terms = ambulo__variant_own(p->variant.definition.terms);
  p->next.enters = AMBULO__ENTERS_TERM;
  for (int k = 0; k < p->problem->definition.term_count; k++) {
    term_keys t = {p, &terms[k], NULL, {0}};
    make_item(p->problem, k, &t);
    p->next.term = k;
    add_term(&t);
  }
  p->next.enters = AMBULO__ENTERS_ALL;
}

/* ------------------------------------------------------- constraints, ground */

/* numbers that rows do not have */
static int is_idle(const ambulo__parameters *p, const void *item, const ambulo__member *m, int k) {
  const ambulo_problem_definition *d = &p->variant.definition;
  const double *at = (const double *)(const void *)((const char *)item + m->at);
  int tolerant = d->contact_tolerance > 0.0;
  ambulo__span flight;
  (void)k;
  if (at == &d->contact_tolerance || at == &d->orientation_tolerance) return !tolerant;
  if (at == d->strike_pitch) return !tolerant || !(at[0] < at[1]);
  if (at == &d->support_margin) return d->support == AMBULO_SUPPORT_OFF;
  if (at == &d->ground_height) return d->contact_count == 0;
  if (at == &d->ground_reaction.flight_tolerance) return !ambulo__flight_span(d, &flight);
  if (at == &d->ground_reaction.heel_pad) return d->ground_reaction.heel_pad == 0.0;
  if (strncmp(m->key, "pressure.", 9) == 0) return !d->ground_reaction.pressure;
  /* others are moved with what they belong to; the least force has a key of its own with forces */
  return at == &d->duration || at == &d->travel || at == &d->rise || at == &d->minimum_force;
}

static void add_tube(ambulo__parameters *p, int t, int i) {
  const ambulo_problem *problem = p->problem;
  const ambulo_coordinate *c = &problem->model->coordinates[i];
  double sign, *width = ambulo__variant_own(p->variant.definition.tubes[t].half_width);
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

static void add_part(ambulo__parameters *p, const ambulo__structure *s, void *part) {
  ambulo__parameters_of_members(p, s, part, s->key, "", is_idle);
}

static void add_rows(ambulo__parameters *p) {
  ambulo_problem_definition *d = &p->variant.definition;
  int reacts = d->ground_reaction.kind != AMBULO_REACTION_NONE;
  ambulo__parameters_of_members(p, &ambulo__definition_members, d, "", "", is_idle);
  if (!isnan(d->clearance.height)) add_part(p, &ambulo__clearance_members, &d->clearance);
  if (ambulo_problem_pairs(p->problem, 0, NULL) > 0)
    add_part(p, &ambulo__collision_members, &d->collision);
  if (reacts) add_part(p, &ambulo__ground_reaction_members, &d->ground_reaction);
  if (d->minimum_force >= 0.0)
    ambulo__parameter_add(p, AMBULO__BODY_WEIGHT, &d->minimum_force, "least vertical force",
                          "%s.minimum_force", reacts ? "ground_reaction" : "constraints");
  for (int t = 0; t < d->tube_count; t++)
    for (int i = 0; i < p->problem->coordinates; i++) add_tube(p, t, i);
}

/* --------------------------------------------------------- obstacles, reaches */

static int is_of_another_shape(const ambulo__parameters *p, const void *item,
                               const ambulo__member *m, int k) {
  const ambulo_obstacle *o = item;
  const void *at = (const char *)item + m->at;
  int of_box = at == o->center || at == o->half || at == &o->heading;
  int of_capsule = at == o->from || at == o->to || at == &o->radius;
  (void)p;
  (void)k;
  return o->shape == AMBULO_OBSTACLE_BOX ? of_capsule : of_box;
}

/* with mirrored ends a way to the mirror image is straight to the side */
static int is_not_asked(const ambulo__parameters *p, const void *item, const ambulo__member *m,
                        int k) {
  const ambulo_reach *r = item;
  const void *at = (const char *)item + m->at;
  if (at == &r->tolerance) return r->tolerance == 0.0;
  return at == r->place && k != 1 && p->problem->definition.ends == AMBULO_ENDS_MIRRORED;
}

static void add_bodies(ambulo__parameters *p) {
  const ambulo_problem_definition *d = &p->variant.definition;
  const ambulo_point *points = p->problem->model->points;
  ambulo_obstacle *obstacles = ambulo__variant_own(p->variant.definition.obstacles);
  ambulo_reach *reaches = ambulo__variant_own(p->variant.definition.reaches);
  char path[AMBULO__PARAMETER_TEXT], name[AMBULO__PARAMETER_TEXT];
  for (int o = 0; o < d->obstacle_count; o++) {
    (void)snprintf(path, sizeof path, "obstacles[%s]", obstacles[o].name);
    (void)snprintf(name, sizeof name, "'%s'", obstacles[o].name);
    ambulo__parameters_of_members(p, &ambulo__obstacle_members, &obstacles[o], path, name,
                                  is_of_another_shape);
  }
  for (int r = 0; r < d->reach_count; r++) {
    int relative = reaches[r].is_relative;
    (void)snprintf(path, sizeof path, "constraints.reach[%d]", r);
    (void)snprintf(name, sizeof name, "%s%s%s", points[reaches[r].point].name,
                   relative ? " from " : "", relative ? points[reaches[r].about].name : "");
    ambulo__parameters_of_members(p, &ambulo__reach_members, &reaches[r], path, name, is_not_asked);
  }
}

void ambulo__parameters_of_task(ambulo__parameters *p) {
  add_rows(p);
  add_bodies(p);
}
