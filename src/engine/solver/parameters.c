/* solver/parameters.c - the list of numbers: adding, finding, moving, units. */
#include "solver/sensitivity.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* ----------------------------------------------------------------------- list */

/* room for one more of `count` items; 0: memory ran out */
static int grow(ambulo__parameters *p, void **items, int count, int *capacity, size_t size) {
  if (count < *capacity) return 1;
  int larger = *capacity ? 2 * *capacity : 16;
  void *moved = ambulo__realloc(&p->allocator, *items, (size_t)larger, size);
  p->failed |= !moved;
  if (!moved) return 0;
  *items = moved;
  *capacity = larger;
  return 1;
}

void ambulo__parameter_place(ambulo__parameters *p, double sign, double *at) {
  void *addresses = p->address;
  if (p->failed || !grow(p, &addresses, p->addresses, &p->address_capacity, sizeof *p->address))
    return;
  p->address = addresses;
  p->address[p->addresses++] = (ambulo__address){at, sign};
  p->list[p->count - 1].addresses++;
}

void ambulo__parameter_add(ambulo__parameters *p, ambulo__quantity quantity, double *at,
                           const char *label, const char *name, ...) {
  void *list = p->list;
  if (p->failed || !grow(p, &list, p->count, &p->capacity, sizeof *p->list)) return;
  p->list = list;
  ambulo__parameter *next = &p->list[p->count++];
  *next = p->next;
  next->quantity = quantity;
  next->value = *at;
  next->low = -HUGE_VAL;
  next->high = HUGE_VAL;
  next->address = p->addresses;
  va_list arguments;
  va_start(arguments, name);
  (void)vsnprintf(next->name, sizeof next->name, name, arguments);
  va_end(arguments);
  (void)snprintf(next->label, sizeof next->label, "%s", label);
  ambulo__parameter_place(p, 1.0, at);
}

void ambulo__parameter_with(ambulo__parameters *p, double sign, double *at, const char *name, ...) {
  if (p->failed) return;
  ambulo__parameter *last = &p->list[p->count - 1];
  size_t used = strlen(last->with), room = sizeof last->with - used;
  int comma = used ? snprintf(last->with + used, room, ", ") : 0;
  last->with_sign = sign;
  va_list arguments;
  va_start(arguments, name);
  int length = vsnprintf(last->with + used + comma, room - (size_t)comma, name, arguments);
  va_end(arguments);
  if ((size_t)(comma + length) >= room)
    p->count--;
  else
    ambulo__parameter_place(p, sign, at);
}

void ambulo__parameter_within(ambulo__parameters *p, double low, double high) {
  if (p->failed) return;
  p->list[p->count - 1].low = low;
  p->list[p->count - 1].high = high;
}

void ambulo__member_label(const ambulo__member *m, int k, const char *of,
                          char text[AMBULO__PARAMETER_TEXT]) {
  const char *label = m->label;
  for (; k > 0 && strchr(label, '|'); k--) label = strchr(label, '|') + 1;
  (void)snprintf(text, AMBULO__PARAMETER_TEXT, "%.*s%s%s", (int)strcspn(label, "|"), label,
                 of[0] ? " " : "", of);
}

void ambulo__parameters_of_members(ambulo__parameters *p, const ambulo__structure *s, void *item,
                                   const char *path, const char *of, ambulo__idle_number *idle) {
  char label[AMBULO__PARAMETER_TEXT], index[16] = "";
  for (int i = 0; i < s->count; i++) {
    const ambulo__member *m = &s->members[i];
    double *at = (double *)(void *)((char *)item + m->at);
    if (!m->label || m->type > AMBULO__FILE_ANGLE) continue;
    for (int k = 0; k < m->count; k++) {
      if (!isfinite(at[k]) || idle(p, item, m, k)) continue;
      ambulo__member_label(m, k, of, label);
      if (m->count > 1) (void)snprintf(index, sizeof index, "[%d]", k);
      ambulo__parameter_add(p, m->quantity, &at[k], label, "%s%s%s%s", path, path[0] ? "." : "",
                            m->key, m->count > 1 ? index : "");
      double size = m->flags & AMBULO__BODY_LENGTH && p->problem->keys.written_for
                        ? p->problem->keys.longer
                        : 1.0;
      if (m->low < m->high) ambulo__parameter_within(p, m->low * size, m->high * size);
      if (!p->failed) p->list[p->count - 1].is_length = (m->flags & AMBULO__BODY_LENGTH) != 0;
    }
  }
}

int ambulo__parameter_partner(const ambulo_problem *problem, int i, double *sign) {
  const ambulo_coordinate *c = &problem->model->coordinates[i];
  *sign = c->mirror_sign;
  if (problem->definition.ends != AMBULO_ENDS_MIRRORED) return -1;
  return c->mirror == i && c->mirror_sign > 0.0 ? -1 : c->mirror;
}

void ambulo__parameters_clear(ambulo__parameters *p) {
  ambulo__free(&p->allocator, p->list);
  ambulo__free(&p->allocator, p->address);
  ambulo__variant_clear(&p->variant);
  *p = (ambulo__parameters){.count = 0};
}

ambulo__parameter *ambulo__parameters_find(const ambulo__parameters *p, const char *name) {
  for (int i = 0; i < p->count; i++)
    if (strcmp(p->list[i].name, name) == 0) return &p->list[i];
  return NULL;
}

void ambulo__parameter_set(ambulo__parameters *p, const ambulo__parameter *parameter,
                           double value) {
  for (int i = 0; i < parameter->addresses; i++) {
    const ambulo__address *m = &p->address[parameter->address + i];
    *m->at = m->sign * value;
  }
}

/* ---------------------------------------------------------------------- units */

/* what a file's number is multiplied by where it is written for another body; 0: not known */
static double size_of(const ambulo__problem_keys *keys, const ambulo__parameter *p) {
  if (!keys->written_for) return 1.0;
  if (strncmp(p->name, "objective[", 10) == 0) return 0.0;
  if (p->quantity == AMBULO__LOADING_RATE) return 1.0 / sqrt(keys->longer);
  return p->is_length ? keys->longer : 1.0;
}

double ambulo__parameter_unit(const ambulo_problem *problem, const ambulo__parameter *p) {
  const ambulo__model_units *units = &problem->model->units;
  int of_model = strncmp(p->name, "model.", 6) == 0;
  int turns = p->quantity == AMBULO__ANGLE || p->quantity == AMBULO__TURNING_SPEED ||
              p->quantity == AMBULO__TURNING_JOLT;
  if (!of_model) return size_of(&problem->keys, p) * (turns ? problem->keys.radians : 1.0);
  if (turns) return units->angle;
  if (p->quantity == AMBULO__TORQUE) return units->moment;
  return p->quantity == AMBULO__FORCE ? units->force : units->length;
}

/* ---------------------------------------------------------------------- steps */

#define DEGREE 0.017453292519943295

/* a change that a person can picture, in the unit of the quantity (of a ratio: share of the value),
 * and in words */
static const struct {
  double step;
  const char *more;
} changes[] = {
    [AMBULO__STEP_LENGTH] = {0.01, "1 cm more"},
    [AMBULO__SHORT_LENGTH] = {0.001, "1 mm more"},
    [AMBULO__ANGLE] = {DEGREE, "1 degree more"},
    [AMBULO__SMALL_ANGLE] = {0.1 * DEGREE, "0.1 degrees more"},
    [AMBULO__TIME] = {0.01, "10 ms more"},
    [AMBULO__SPEED] = {0.1, "0.1 m/s more"},
    [AMBULO__TURNING_SPEED] = {0.1, "0.1 rad/s more"},
    [AMBULO__MASS] = {1.0, "1 kg more"},
    [AMBULO__TORQUE] = {1.0, "1 N m more"},
    [AMBULO__FORCE] = {10.0, "10 N more"},
    [AMBULO__BODY_WEIGHT] = {0.01, "0.01 body weights more"},
    [AMBULO__TURNING_JOLT] = {1.0, "1 rad/s^2 more"},
    [AMBULO__JOLT] = {0.1, "0.1 m/s^2 more"},
    [AMBULO__LOADING_RATE] = {1.0, "1 body weight/s more"},
    [AMBULO__STRIDE_SHARE] = {0.01, "1 % of the stride later"},
    [AMBULO__EVENT_TIME] = {0.01, "10 ms later"},
    [AMBULO__TURNING_STIFF] = {1.0, "1 N m/rad more"},
    [AMBULO__STIFF] = {10.0, "10 N/m more"},
    [AMBULO__RATIO] = {0.01, "1 % more"},
};

static int is_relative(const ambulo__parameter *p) {
  return p->quantity == AMBULO__RATIO && p->value != 0.0;
}

double ambulo__parameter_step(const ambulo__parameter *p) {
  return changes[p->quantity].step * (is_relative(p) ? fabs(p->value) : 1.0);
}

const char *ambulo__parameter_more(const ambulo__parameter *p) {
  int is_share = p->quantity == AMBULO__RATIO && !is_relative(p);
  return is_share ? "0.01 more" : changes[p->quantity].more;
}
