/* model/conditions.c - load and slope (conditions.h).
 *
 * On ground that rises by s along forward f, with normal n and |g| = g:
 *
 *     gravity = -g (cos s n + sin s f)
 *
 * in axes that stay with the ground. What stood on level ground stands on the slope; only the
 * direction of its weight has changed.
 */
#include "model/conditions.h"

#include <math.h>
#include <string.h>

#include "model/reader.h"

void ambulo__model_carry(ambulo_model *model, int link, double mass, const double position[3]) {
  ambulo_link *carrier = &model->links[link];
  ambulo__part whole = {.mass = carrier->mass}, load = {.mass = mass};
  memcpy(whole.com, carrier->com, sizeof whole.com);
  memcpy(whole.inertia, carrier->inertia, sizeof whole.inertia);
  memcpy(load.com, position, sizeof load.com);
  ambulo__part_add(&whole, &load);
  carrier->mass = whole.mass;
  memcpy(carrier->com, whole.com, sizeof whole.com);
  memcpy(carrier->inertia, whole.inertia, sizeof whole.inertia);
  model->mass += mass;
}

void ambulo__model_tilt(ambulo_model *model, double slope) {
  const double *old = model->gravity;
  double g = sqrt(old[0] * old[0] + old[1] * old[1] + old[2] * old[2]);
  for (int i = 0; i < 3; i++)
    model->gravity[i] = -g * (cos(slope) * model->up[i] + sin(slope) * model->forward[i]);
}
