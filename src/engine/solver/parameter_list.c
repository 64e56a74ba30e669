/* solver/parameter_list.c - a growing list of numbers, and which of them move together. */
#include "solver/sensitivity_parameters.h"

#include "model/model.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void ambulo__parameter_add(ambulo__parameters *p, ambulo__quantity quantity, double value,
                           double derivative, const char *label, const char *name, ...) {
  if (p->count == p->capacity && !p->failed) {
    int larger = p->capacity ? 2 * p->capacity : 16;
    void *moved = ambulo__realloc(&p->allocator, p->list, (size_t)larger, sizeof *p->list);
    if (moved) {
      p->list = moved;
      p->capacity = larger;
    }
    p->failed = !moved;
  }
  if (p->failed) return;
  ambulo__parameter *next = &p->list[p->count++];
  *next = (ambulo__parameter){.quantity = quantity, .value = value, .derivative = derivative};
  va_list arguments;
  va_start(arguments, name);
  (void)vsnprintf(next->name, sizeof next->name, name, arguments);
  va_end(arguments);
  (void)snprintf(next->label, sizeof next->label, "%s", label);
}

void ambulo__parameter_with(ambulo__parameters *p, double sign, const char *name, ...) {
  if (p->failed) return;
  ambulo__parameter *last = &p->list[p->count - 1];
  size_t used = strlen(last->with), room = sizeof last->with - used;
  int comma = used ? snprintf(last->with + used, room, ", ") : 0;
  last->with_sign = sign;
  va_list arguments;
  va_start(arguments, name);
  int length = vsnprintf(last->with + used + comma, room - (size_t)comma, name, arguments);
  va_end(arguments);
  if ((size_t)(comma + length) >= room) p->count--;
}

/* what a file's number is multiplied by where it is written for another body; 0: not known */
static double size_of(const ambulo__problem_keys *keys, const char *name) {
  static const char *const lengths[] = {"gait.step_width",
                                        "constraints.contact_tolerance",
                                        "constraints.zmp_margin",
                                        "constraints.clearance.height",
                                        "constraints.clearance.ceiling",
                                        "constraints.clearance.outward",
                                        "constraints.clearance.inward",
                                        "constraints.clearance.feet",
                                        "constraints.collision.margin",
                                        "ground_reaction.moment_arm",
                                        "ground_reaction.free_moment",
                                        "ground_reaction.pressure."};
  if (!keys->written_for) return 1.0;
  if (strncmp(name, "objective[", 10) == 0) return 0.0;
  if (strcmp(name, "ground_reaction.loading_rate") == 0) return 1.0 / sqrt(keys->longer);
  for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++)
    if (strncmp(name, lengths[i], strlen(lengths[i])) == 0) return keys->longer;
  return 1.0;
}

double ambulo__parameter_unit(const ambulo_problem *problem, const ambulo__parameter *p) {
  const ambulo__model_units *units = &problem->model->units;
  int of_model = strncmp(p->name, "model.", 6) == 0;
  int turns = p->quantity == AMBULO__ANGLE || p->quantity == AMBULO__TURNING_SPEED ||
              p->quantity == AMBULO__TURNING_JOLT;
  if (!of_model) return size_of(&problem->keys, p->name) * (turns ? problem->keys.radians : 1.0);
  if (turns) return units->angle;
  if (p->quantity == AMBULO__TORQUE) return units->moment;
  return p->quantity == AMBULO__FORCE ? units->force : units->length;
}

void ambulo__parameter_travels(ambulo__parameters *p, double travel) {
  if (!p->failed) p->list[p->count - 1].travel = travel;
}

int ambulo__parameter_partner(const ambulo_problem *problem, int i, double *sign) {
  const ambulo_coordinate *c = &problem->model->coordinates[i];
  *sign = c->mirror_sign;
  if (problem->definition.ends != AMBULO_ENDS_MIRRORED) return -1;
  return c->mirror == i && c->mirror_sign > 0.0 ? -1 : c->mirror;
}
