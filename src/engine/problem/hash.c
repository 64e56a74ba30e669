/* problem/hash.c - one number for everything a problem was resolved to.
 *
 * FNV-1a, 64 bit (Fowler, Noll, Vo 1991; offset basis and prime of their page), over the
 * bytes of names and the bit patterns of numbers. It tells two inputs apart; it is no
 * cryptographic digest. */
#include "problem/problem.h"

#include <string.h>

typedef unsigned long long hash;

static hash add_bytes(hash h, const void *data, size_t size) {
  const unsigned char *byte = data;
  for (size_t i = 0; i < size; i++) h = (h ^ byte[i]) * 1099511628211ULL;
  return h;
}

static hash add_text(hash h, const char *text) {
  return text ? add_bytes(h, text, strlen(text) + 1) : add_bytes(h, "", 1);
}

static hash add_numbers(hash h, const double *value, size_t count) {
  for (size_t i = 0; value && i < count; i++) {
    double number = value[i] == 0.0 ? 0.0 : value[i]; /* -0 is 0 */
    h = add_bytes(h, &number, sizeof number);
  }
  return h;
}

static hash add_integer(hash h, long long value) {
  return add_bytes(h, &value, sizeof value);
}

static hash add_model(hash h, const ambulo_model *model) {
  h = add_text(h, ambulo_model_name(model));
  h = add_numbers(h, ambulo_model_gravity(model), 3);
  for (int i = 0; i < ambulo_model_link_count(model); i++) {
    const ambulo_link *link = ambulo_model_link(model, i);
    double constants[] = {link->theta, link->d, link->a, link->alpha, link->mass};
    h = add_integer(add_text(h, link->name), link->parent * 8 + (int)link->type);
    h = add_numbers(h, constants, 5);
    h = add_numbers(add_numbers(h, link->com, 3), link->inertia, 6);
  }
  for (int i = 0; i < model->coordinate_count; i++) { /* all zero: as before there was one */
    double start = model->coordinates[i].default_value;
    if (start != 0.0) h = add_numbers(add_integer(h, i), &start, 1);
  }
  for (int i = 0; i < ambulo_model_point_count(model); i++) {
    const ambulo_point *point = ambulo_model_point(model, i);
    h = add_numbers(add_integer(add_text(h, point->name), point->link), point->position, 3);
  }
  return h;
}

static hash add_terms(hash h, const ambulo_problem *p) {
  size_t d = (size_t)p->coordinates;
  for (int t = 0; t < p->definition.term_count; t++) {
    const ambulo_term *term = &p->definition.terms[t];
    double constants[] = {term->weight, term->smoothing, term->power, term->height};
    h = add_numbers(add_integer(add_text(h, term->name), (int)term->kind), constants, 4);
    h = add_numbers(add_numbers(h, term->scale, d), term->offset, d);
    h = add_numbers(add_numbers(h, term->passive, 4 * d), term->strength, 6 * d);
    h = add_integer(add_integer(h, term->point[0]), term->point[1]);
    h = add_numbers(h, term->reference, (size_t)p->nodes * d);
    h = add_numbers(h, term->device_scale, (size_t)p->definition.device_count);
    if (term->tendon) h = add_numbers(h, term->tendon, d);
  }
  return h;
}

static hash add_solid(hash h, const ambulo__solid *solid) {
  h = add_numbers(add_integer(h, (int)solid->kind), &solid->distance, 1);
  h = add_numbers(add_numbers(h, &solid->radius, 1), solid->weight, 2);
  if (solid->kind == AMBULO__SOLID_CAPSULE) return add_numbers(h, solid->ends[0], 6);
  if (solid->kind == AMBULO__SOLID_MOVING) return h;
  h = add_numbers(add_numbers(h, solid->center, 3), solid->half, 3);
  return add_numbers(h, solid->axes[0], 9);
}

static hash add_curved(hash h, const ambulo__curved *row) {
  const ambulo__arc *arc = &row->of.arc;
  int channel[AMBULO__CURVED_CHANNELS], count = ambulo__curved_channels(row, channel);
  for (int i = 0; i < count; i++) h = add_integer(h, channel[i]);
  if (row->form == AMBULO__CURVED_SOLID) return add_solid(h, &row->of.solid);
  if (row->form == AMBULO__CURVED_SPIN) {
    const double of_spin[] = {row->of.spin.sign, row->of.spin.bound};
    return add_numbers(add_numbers(h, of_spin, 2), row->of.spin.axis, 3);
  }
  if (row->form == AMBULO__CURVED_APART) {
    h = add_numbers(h, &row->of.apart.distance, 1);
    return add_numbers(h, row->of.apart.up, 3);
  }
  double number[] = {arc->sign, arc->room, arc->radius, arc->length, arc->flat, arc->along};
  h = add_numbers(h, number, sizeof number / sizeof *number);
  return add_numbers(add_numbers(h, arc->forward, 3), arc->up, 3);
}

static hash add_devices(hash h, const ambulo_problem *p) {
  for (int i = 0; i < p->definition.device_count; i++) {
    const ambulo_device *v = &p->definition.devices[i];
    double numbers[] = {v->stiffness, v->rest, v->pretension, v->smoothing, v->damping,
                        v->amount,    v->from, v->to,         v->ramp};
    h = add_integer(add_text(h, v->name), (int)v->kind * 16 + (int)v->side * 4 + (int)v->clock);
    h = add_integer(add_integer(h, v->coordinate), v->clutch * 16 + v->foot);
    h = add_numbers(h, numbers, sizeof numbers / sizeof *numbers);
    for (int end = 0; end < 2; end++)
      h = add_numbers(add_integer(h, v->link[end]), v->position[end], 3);
    for (int k = 0; k < v->point_count; k++) h = add_numbers(h, v->points[k], 2);
  }
  return h;
}

static hash add_holds(hash h, const ambulo_problem *p) {
  for (int i = 0; i < p->definition.hold_count; i++) {
    const ambulo_hold *v = &p->definition.holds[i];
    double numbers[] = {v->mass, v->inertia, v->from, v->to, v->ramp};
    h = add_integer(add_integer(add_text(h, v->name), v->hand[0]), v->hand[1]);
    h = add_numbers(h, numbers, sizeof numbers / sizeof *numbers);
    h = add_numbers(add_numbers(h, v->center, 3), v->force, 3);
  }
  return h;
}

static hash add_rows(hash h, const ambulo_problem *p) {
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    h = add_text(add_text(add_text(h, row->family), row->subject), row->detail);
    const ambulo__curved *curved = ambulo__row_curved_of(&p->table, row);
    h = add_numbers(add_integer(h, (int)row->relation), &row->constant, 1);
    if (curved) h = add_curved(h, curved);
    for (int t = 0; t < row->term_count; t++) {
      const ambulo__row_term *term = &p->table.terms[row->first_term + t];
      h = add_integer(add_integer(h, term->node), term->channel);
      h = add_numbers(h, &term->coefficient, 1);
    }
  }
  return h;
}

unsigned long long ambulo__problem_hash_of(const ambulo_problem *p) {
  hash h = 14695981039346656037ULL;
  h = add_model(h, p->model);
  h = add_integer(h, (int)p->definition.discretization * 16 + p->definition.degree);
  h = add_numbers(h, &p->definition.duration, 1);
  h = add_integer(add_integer(h, p->nodes), p->control_points);
  h = add_numbers(h, ambulo__basis_breakpoints(p->basis),
                  (size_t)ambulo__basis_intervals(p->basis) + 1);
  if (p->definition.grid != AMBULO_GRID_UNIFORM) h = add_numbers(h, p->times, (size_t)p->nodes);
  h = add_numbers(h, p->ground,
                  (size_t)(p->blocks * ambulo__plan_ground_entries(p->plan)) * AMBULO__LANES);
  return add_rows(add_holds(add_devices(add_terms(h, p), p), p), p);
}
