/* problem/queries.c - what a problem tells about itself. */
#include "base/arithmetic.h"
#include "contact/row_families.h"
#include "contact/contacts.h"
#include "contact/schedule.h"
#include "problem/definition.h"
#include "problem/nlp.h"

#include <math.h>
#include <string.h>

const char *ambulo_problem_name(const ambulo_problem *p) {
  return p->definition.name;
}
const ambulo_model *ambulo_problem_model(const ambulo_problem *p) {
  return p->model;
}
const ambulo_muscles *ambulo_problem_muscles(const ambulo_problem *p) {
  return p->definition.muscles;
}
double ambulo_problem_duration(const ambulo_problem *p) {
  return p->definition.duration;
}
int ambulo_problem_node_count(const ambulo_problem *p) {
  return p->nodes;
}
int ambulo_problem_control_point_count(const ambulo_problem *p) {
  return p->control_points;
}
int ambulo_problem_variable_count(const ambulo_problem *p) {
  return p->variables;
}
int ambulo_problem_row_count(const ambulo_problem *p) {
  return p->rows;
}
int ambulo_problem_equality_count(const ambulo_problem *p) {
  return p->equalities;
}
double ambulo_problem_ground_height(const ambulo_problem *p) {
  return p->definition.ground_height;
}
ambulo_ends ambulo_problem_ends(const ambulo_problem *p) {
  return p->definition.ends;
}
int ambulo_problem_contact_count(const ambulo_problem *p) {
  return p->definition.contact_count;
}
int ambulo_problem_device_count(const ambulo_problem *p) {
  return p->definition.device_count;
}

const ambulo_device *ambulo_problem_device(const ambulo_problem *p, int index) {
  return index >= 0 && index < p->definition.device_count ? &p->definition.devices[index] : NULL;
}

int ambulo_problem_hold_count(const ambulo_problem *p) {
  return p->definition.hold_count;
}

const ambulo_hold *ambulo_problem_hold(const ambulo_problem *p, int index) {
  return index >= 0 && index < p->definition.hold_count ? &p->definition.holds[index] : NULL;
}

int ambulo_problem_term_count(const ambulo_problem *p) {
  return p->definition.term_count;
}
unsigned long long ambulo_problem_hash(const ambulo_problem *p) {
  return p->hash;
}

const ambulo_contact *ambulo_problem_contact(const ambulo_problem *p, int index) {
  if (index < 0 || index >= p->definition.contact_count) return NULL;
  return &p->definition.contacts[index];
}

const char *ambulo_problem_term_name(const ambulo_problem *p, int index) {
  if (index < 0 || index >= p->definition.term_count) return NULL;
  const ambulo_term *term = &p->definition.terms[index];
  return term->name ? term->name : ambulo__term_info_of(term->kind)->name;
}

ambulo_status ambulo_problem_limits(const ambulo_problem *p, int index, ambulo_limited what,
                                    ambulo_limits *limits) {
  int known = (int)what >= AMBULO_LIMITED_POSITION && (int)what <= AMBULO_LIMITED_TORQUE;
  if (!p || !limits || !known || index < 0 || index >= p->coordinates) return AMBULO_E_ARGUMENT;
  ambulo__bounds b = ambulo__bounds_of(&p->definition, index, what);
  ambulo_limits view = {b.low.value, b.high.value, b.low.owner, b.high.owner};
  *limits = view;
  return AMBULO_OK;
}

ambulo_status ambulo_problem_row(const ambulo_problem *p, int index, ambulo_row *row) {
  if (!p || !row || index < 0 || index >= p->rows) return AMBULO_E_ARGUMENT;
  const ambulo__table_row *r = &p->table.rows[index];
  ambulo_row view = {r->family, r->subject, r->detail, r->unit, r->relation, r->node, r->time};
  *row = view;
  return AMBULO_OK;
}

double ambulo_problem_node_time(const ambulo_problem *p, int node) {
  return node >= 0 && node < p->nodes ? p->times[node] : (double)NAN;
}

ambulo_grid ambulo_problem_grid(const ambulo_problem *p) {
  return p->definition.grid;
}

int ambulo__node_at(const ambulo_problem *p, double time, double *between) {
  int low = 0, high = p->nodes - 1;
  while (high - low > 1) {
    int middle = low + (high - low) / 2;
    if (p->times[middle] <= time + AMBULO__INSTANT) {
      low = middle;
    } else {
      high = middle;
    }
  }
  double part = (time - p->times[low]) / (p->times[low + 1] - p->times[low]);
  *between = fmin(1.0, fmax(0.0, part));
  return low;
}

/* how many there are; the index-th one into *pair */
static int nth(const ambulo_capsule_pair *pairs, int count, int index, ambulo_capsule_pair *pair) {
  if (pair && index >= 0 && index < count) *pair = pairs[index];
  return count;
}

int ambulo_problem_pairs(const ambulo_problem *p, int index, ambulo_capsule_pair *pair) {
  if (!p || p->definition.collision.mode == AMBULO_COLLISION_OFF) return 0;
  return nth(p->definition.collision.pairs, p->definition.collision.pair_count, index, pair);
}

int ambulo_problem_pairs_left_out(const ambulo_problem *p, int index, ambulo_capsule_pair *pair) {
  if (!p) return 0;
  const ambulo__pairs *pairs = &ambulo__problem_root(p)->pairs; /* an extension is given the rest */
  return nth(pairs->left, pairs->left_count, index, pair);
}

int ambulo_problem_obstacle_count(const ambulo_problem *p) {
  return p ? p->definition.obstacle_count : 0;
}

const ambulo_obstacle *ambulo_problem_obstacle(const ambulo_problem *p, int index) {
  return p && index >= 0 && index < p->definition.obstacle_count ? &p->definition.obstacles[index]
                                                                 : NULL;
}
