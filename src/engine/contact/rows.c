/* contact/rows.c - the tables of row_kind.h. */
#include "contact/rows.h"

#include "contact/contacts.h"

#include <limits.h>
#include <math.h>
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
    {"passive", AMBULO__NEWTONS, AMBULO__NEWTON_METRES, AMBULO__AT_TIMES, NONE, 30.0},
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

/* growing arrays: rows, the terms they consist of, families. */

void ambulo__row_table_init(ambulo__row_table *table, const ambulo_allocator *allocator) {
  ambulo__row_table empty = {.allocator = ambulo__allocator_or_default(allocator), .weight = 1.0};
  *table = empty;
}

void ambulo__row_table_clear(ambulo__row_table *table) {
  if (!table) return;
  ambulo__free(&table->allocator, table->rows);
  ambulo__free(&table->allocator, table->terms);
  ambulo__free(&table->allocator, table->curved);
  ambulo__free(&table->allocator, table->group_row);
  ambulo__row_table_init(table, &table->allocator);
}

/* Doubles `*array` when `count` has reached `*capacity`; 0 when memory runs out. */
static int grow(const ambulo_allocator *allocator, void **array, int count, int *capacity,
                size_t size) {
  if (count < *capacity) return 1;
  if (*capacity > INT_MAX / 2) return 0;
  int larger = *capacity ? 2 * *capacity : 64;
  void *moved = ambulo__realloc(allocator, *array, (size_t)larger, size);
  if (!moved) return 0;
  *array = moved;
  *capacity = larger;
  return 1;
}

static int same_family(const ambulo__table_row *a, const ambulo__table_row *b) {
  if (a->kind != b->kind) return 0;
  return a->kind != AMBULO__KIND_USER || strcmp(a->family, b->family) == 0;
}

/* The number of the family of the row that comes next, which begins one if need be; -1 without
 * memory. Neighbours mostly share theirs, and there are few. */
static int group_of(ambulo__row_table *table, const ambulo__table_row *row) {
  for (int g = table->group_count - 1; g >= 0; g--) {
    if (same_family(&table->rows[table->group_row[g]], row)) return g;
  }
  void *groups = table->group_row;
  int grown = grow(&table->allocator, &groups, table->group_count, &table->group_capacity,
                   sizeof *table->group_row);
  table->group_row = groups;
  if (!grown) return -1;
  table->group_row[table->group_count] = table->row_count;
  return table->group_count++;
}

static void append(ambulo__row_table *table, ambulo__table_row row) {
  if (table->status) return;
  void *rows = table->rows;
  int grown =
      grow(&table->allocator, &rows, table->row_count, &table->row_capacity, sizeof *table->rows);
  table->rows = rows;
  row.group = grown ? group_of(table, &row) : -1;
  if (row.group < 0) {
    table->status = AMBULO_E_MEMORY;
    return;
  }
  row.size = ambulo__measure_size(row.measure, table->weight);
  row.first_term = table->term_count;
  table->rows[table->row_count++] = row;
}

void ambulo__row_begin(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                       const char *detail, ambulo__measure measure, ambulo_relation relation,
                       int node, double time, double constant) {
  ambulo__table_row row = {.kind = (unsigned char)kind,
                           .measure = (unsigned char)measure,
                           .family = ambulo__row_family(kind),
                           .subject = subject,
                           .detail = detail,
                           .unit = ambulo__measure_text(measure),
                           .relation = (unsigned char)relation,
                           .before = table->before != 0,
                           .node = node,
                           .time = time,
                           .constant = constant,
                           .user = -1};
  append(table, row);
}

void ambulo__row_user(ambulo__row_table *table, const ambulo_user_row *user, int index, int node,
                      double time) {
  ambulo__table_row row = {.kind = AMBULO__KIND_USER,
                           .measure = (unsigned char)ambulo__measure_of_text(user->unit),
                           .family = user->name,
                           .subject = "",
                           .detail = "",
                           .unit = user->unit,
                           .relation = (unsigned char)user->relation,
                           .node = node,
                           .time = time,
                           .user = index};
  append(table, row);
}

static void append_curved(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                          const char *detail, int node, double time, const ambulo__curved *row) {
  void *curved = table->curved;
  if (table->status) return;
  int grown =
      grow(&table->allocator, &curved, table->curved_count, &table->curved_capacity, sizeof *row);
  table->curved = curved;
  if (!grown) {
    table->status = AMBULO_E_MEMORY;
    return;
  }
  ambulo__measure measure =
      row->form == AMBULO__CURVED_CONE ? AMBULO__BODY_WEIGHTS : AMBULO__METRES;
  ambulo__row_begin(table, kind, subject, detail, measure, AMBULO_NOT_NEGATIVE, node, time, 0.0);
  if (table->status) return;
  table->curved[table->curved_count] = *row;
  table->rows[table->row_count - 1].user = table->curved_count++;
}

void ambulo__row_arc(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                     const char *detail, int node, double time, const ambulo__arc *arc) {
  ambulo__curved row = {.form = AMBULO__CURVED_ARC, .of.arc = *arc};
  append_curved(table, kind, subject, detail, node, time, &row);
}

void ambulo__row_apart(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                       const char *detail, int node, double time, const ambulo__apart *apart) {
  ambulo__curved row = {.form = AMBULO__CURVED_APART, .of.apart = *apart};
  append_curved(table, kind, subject, detail, node, time, &row);
}

void ambulo__row_solid(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                       const char *detail, int node, double time, const ambulo__solid *solid) {
  ambulo__curved row = {.form = AMBULO__CURVED_SOLID, .of.solid = *solid};
  append_curved(table, kind, subject, detail, node, time, &row);
}

void ambulo__row_spin(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                      const char *detail, int node, double time, const ambulo__spin *spin) {
  ambulo__curved row = {.form = AMBULO__CURVED_SPIN, .of.spin = *spin};
  append_curved(table, kind, subject, detail, node, time, &row);
}

void ambulo__row_cone(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                      const char *detail, int node, double time, const ambulo__cone *cone) {
  ambulo__curved row = {.form = AMBULO__CURVED_CONE, .of.cone = *cone};
  append_curved(table, kind, subject, detail, node, time, &row);
}

double ambulo__row_missed(const ambulo__table_row *row, double value) {
  if (!isfinite(value)) return HUGE_VAL;
  return row->relation == AMBULO_EQUAL ? fabs(value) : fmax(0.0, -value);
}

int ambulo__rows_alike(const ambulo__table_row *a, const ambulo__table_row *b) {
  return a->group == b->group && strcmp(a->subject, b->subject) == 0 &&
         strcmp(a->detail, b->detail) == 0;
}

void ambulo__row_term_add(ambulo__row_table *table, int node, int channel, double coefficient) {
  if (table->status || coefficient == 0.0) return;
  void *terms = table->terms;
  int grown = grow(&table->allocator, &terms, table->term_count, &table->term_capacity,
                   sizeof *table->terms);
  table->terms = terms;
  if (!grown) {
    table->status = AMBULO_E_MEMORY;
    return;
  }
  ambulo__row_term term = {node, channel, coefficient};
  table->terms[table->term_count++] = term;
  table->rows[table->row_count - 1].term_count++;
}

/* pairs of inequality rows (bounded.h). */

void ambulo__linear_add(ambulo__linear *form, int first, const double direction[3], double factor) {
  for (int axis = 0; axis < 3; axis++) {
    if (direction[axis] == 0.0) continue;
    if (form->count == AMBULO__FORM_TERMS) {
      form->overflow = 1;
      return;
    }
    form->channel[form->count] = first + axis;
    form->coefficient[form->count++] = factor * direction[axis];
  }
}

static void side(const ambulo__gait_context *context, int node, const ambulo__bounded_name *name,
                 const ambulo__linear *form, double sign, double bound, ambulo__row_table *table) {
  if (!isfinite(bound)) return;
  ambulo__row_begin(table, name->kind, name->subject, sign > 0.0 ? name->lower : name->upper,
                    name->measure, AMBULO_NOT_NEGATIVE, node, context->times[node],
                    sign * (form->constant - bound));
  for (int t = 0; t < form->count; t++)
    ambulo__row_term_add(table, node, form->channel[t], sign * form->coefficient[t]);
}

void ambulo__bounded_rows(const ambulo__gait_context *context, int node,
                          const ambulo__bounded_name *name, const ambulo__linear *form, double low,
                          double high, ambulo__row_table *table) {
  if (form->overflow && !table->status) table->status = AMBULO_E_INTERNAL;
  side(context, node, name, form, 1.0, low, table);
  side(context, node, name, form, -1.0, high, table);
}

/* the contact of an effector at a node, -1 in the air; patches are few, and found by their times */
static int contact_at(const ambulo__gait_context *context, int effector, int node) {
  const ambulo_problem_definition *d = context->definition;
  int feet = context->model->foot_count;
  if (effector < feet) return context->active[node * feet + effector];
  const ambulo_contact *contact = ambulo__contact_of(d, effector, context->times[node]);
  return contact ? (int)(contact - d->contacts) : -1;
}

/* just before a node, where that counts too */
static int contact_before(const ambulo__gait_context *context, int effector, int node) {
  const ambulo_problem_definition *d = context->definition;
  int feet = context->model->foot_count;
  if (!context->before || (effector >= feet && node == 0))
    return contact_at(context, effector, node);
  if (effector < feet) return context->before[node * feet + effector];
  const ambulo_contact *contact = ambulo__contact_before(d, effector, context->times[node]);
  return contact ? (int)(contact - d->contacts) : -1;
}

/* 1 if what an effector does up to T is not what it goes on with, which is what the first node has
 */
static int ends_at_last(const ambulo__gait_context *context, int effector, int before) {
  const ambulo_problem_definition *d = context->definition;
  int mirrored = d->ends == AMBULO_ENDS_MIRRORED;
  int image = mirrored ? ambulo__effector_mirror(context->model, effector) : effector;
  int next = contact_at(context, image, 0);
  if (before < 0 || next < 0) return before != next;
  return d->contacts[before].mode != d->contacts[next].mode;
}

ambulo__phases_of_foot ambulo__phases_at(const ambulo__gait_context *context, int order, int node,
                                         int effector) {
  int now = contact_at(context, effector, node);
  int before = contact_before(context, effector, node);
  ambulo__phases_of_foot phases = {0, {before, now}};
  if (node >= ambulo__distinct_nodes(context, order)) {
    phases.count = context->before != NULL && ends_at_last(context, effector, before);
    return phases;
  }
  phases.count = before == now ? 1 : 2;
  return phases;
}

int ambulo__distinct_nodes(const ambulo__gait_context *context, int order) {
  const ambulo_problem_definition *d = context->definition;
  int repeats = d->ends != AMBULO_ENDS_FREE && d->ends_order >= order &&
                (d->ground_reaction.kind != AMBULO_REACTION_NONE || d->contact_tolerance > 0.0);
  return repeats ? context->nodes - 1 : context->nodes;
}
