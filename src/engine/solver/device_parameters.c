/* solver/device_parameters.c - numbers of devices by their keys: devices[exo_r].stiffness.
 *
 * A file's `mirror: true` is one key of two devices, whose partials are added up, with the opposite
 * sign of what a turned coordinate turns; two that are listed have to stay alike with mirrored
 * ends, and move together.
 */
#include "solver/sensitivity_parameters.h"

#include <math.h>
#include <stdio.h>

typedef struct device_keys {
  ambulo__parameters *p;
  const ambulo_device *device;
  int index, image; /* of what moves by the same key; -1 */
  int partner;      /* of what has a key of its own and has to move along; -1 */
  double sign;      /* of its rest, pretension and amount */
} device_keys;

static double partial_of(const device_keys *k, int device, int number) {
  return k->p->partials->device[device * AMBULO__DEVICE_NUMBERS + number];
}

/* `odd`: what changes its sign in the mirror */
static void add(const device_keys *k, int number, ambulo__quantity quantity, double value, int odd,
                const char *what, const char *key) {
  double sign = odd ? k->sign : 1.0, by = partial_of(k, k->index, number);
  char label[AMBULO__PARAMETER_TEXT];
  if (k->image >= 0) by += sign * partial_of(k, k->image, number);
  if (k->partner >= 0) by += sign * partial_of(k, k->partner, number);
  (void)snprintf(label, sizeof label, "%s of %s%s", what, k->device->name,
                 k->image >= 0 || k->partner >= 0 ? AMBULO__BOTH_OF_A_PAIR : "");
  ambulo__parameter_add(k->p, quantity, value, by, label, "devices[%s].%s", k->device->name, key);
  if (k->partner >= 0)
    ambulo__parameter_with(k->p, sign, "devices[%s].%s",
                           k->p->problem->definition.devices[k->partner].name, key);
}

static void add_spring(const device_keys *k, int turns) {
  const ambulo_device *v = k->device;
  ambulo__quantity along = turns ? AMBULO__ANGLE : AMBULO__STEP_LENGTH;
  ambulo__quantity stiff = turns ? AMBULO__TURNING_STIFF : AMBULO__STIFF;
  add(k, AMBULO__DEVICE_STIFFNESS, v->stiffness != 0.0 ? AMBULO__RATIO : stiff, v->stiffness, 0,
      "stiffness", "stiffness");
  add(k, AMBULO__DEVICE_REST, along, v->rest, 1, "rest", "rest");
  if (v->pretension != 0.0)
    add(k, AMBULO__DEVICE_PRETENSION, turns ? AMBULO__TORQUE : AMBULO__FORCE, v->pretension, 1,
        "pretension", "pretension");
  if (v->side != AMBULO_DEVICE_BOTH)
    add(k, AMBULO__DEVICE_SMOOTHING, along, v->smoothing, 0, "smoothing", "smoothing");
}

static void add_keys(const device_keys *k) {
  const ambulo_device *v = k->device;
  int turns = ambulo__device_turns(k->p->problem->model, v);
  switch (v->kind) {
  case AMBULO_DEVICE_SPRING:
    add_spring(k, turns);
    break;
  case AMBULO_DEVICE_DAMPER:
    add(k, AMBULO__DEVICE_DAMPING, AMBULO__RATIO, v->damping, 0, "damping", "damping");
    break;
  case AMBULO_DEVICE_ACTUATOR:
    add(k, AMBULO__DEVICE_AMOUNT,
        v->clock != AMBULO_DEVICE_CONSTANT ? AMBULO__RATIO
        : turns                            ? AMBULO__TORQUE
                                           : AMBULO__FORCE,
        v->amount, 1, "amount", "amount");
    break;
  case AMBULO_DEVICE_KIND_NOT_SET:
    break;
  }
  if (!v->clutch) return;
  add(k, AMBULO__DEVICE_FROM, AMBULO__RATIO, v->from, 0, "engagement", "engaged.from");
  add(k, AMBULO__DEVICE_TO, AMBULO__RATIO, v->to, 0, "release", "engaged.to");
  add(k, AMBULO__DEVICE_RAMP, AMBULO__RATIO, v->ramp, 0, "ramp", "engaged.ramp");
}

void ambulo__parameters_of_devices(ambulo__parameters *p) {
  const ambulo_problem_definition *d = &p->problem->definition;
  for (int i = 0; i < d->device_count; i++) {
    device_keys k = {p, &d->devices[i], i, -1, -1, 1.0};
    int partner = -1;
    if (k.device->image_of >= 0) continue;
    for (int image = 0; image < d->device_count; image++)
      if (d->devices[image].image_of == i) k.image = image;
    if (k.device->coordinate >= 0) k.sign = d->model->coordinates[k.device->coordinate].mirror_sign;
    if (d->ends == AMBULO_ENDS_MIRRORED && k.image < 0)
      partner = ambulo__device_partner(d, i, &k.sign);
    if (partner >= 0 && partner < i) continue; /* said before */
    if (partner != i) k.partner = partner;
    add_keys(&k);
  }
}
