/* show/gait_worn.c - see gait_worn.h.
 *
 * A device between two points is the line between them, one at a joint a disc there, while it does
 * at least a fiftieth of the most that it does. A load of m kg is a disc of .02 m m^(1/3).
 */
#include "show/gait_worn.h"

#include <math.h>
#include <string.h>

static const double joint_radius = 0.035, load_radius = 0.02, least = 0.02;

int ambulo__worn_count(const ambulo__stride *stride) {
  return stride->devices + stride->model->load_count;
}

static int acts(const ambulo__stride *stride, int sample, int device) {
  double most = 0.0;
  for (int k = 0; k < stride->samples; k++)
    most = fmax(most, fabs(stride->effort[(size_t)k * (size_t)stride->devices + (size_t)device]));
  size_t at = (size_t)sample * (size_t)stride->devices + (size_t)device;
  return most > 0.0 && fabs(stride->effort[at]) >= least * most;
}

/* the joint of a coordinate is at the origin of the link before it */
static void place_device(const ambulo_model *model, const ambulo_device *device,
                         ambulo__worn *mark) {
  mark->style = "device";
  if (device->coordinate < 0) {
    memcpy(mark->link, device->link, sizeof mark->link);
    memcpy(mark->at, device->position, sizeof mark->at);
    return;
  }
  mark->radius = joint_radius;
  mark->link[0] = model->links[model->coordinate_link[device->coordinate]].parent;
}

int ambulo__worn_at(const ambulo__stride *stride, int sample, int i, ambulo__worn *mark) {
  const ambulo_model *model = stride->model;
  *mark = (ambulo__worn){.style = "load"};
  if (i < stride->devices) {
    place_device(model, &stride->problem->definition.devices[i], mark);
    return acts(stride, sample, i);
  }
  const ambulo__model_load *load = &model->loads[i - stride->devices];
  mark->radius = load_radius * cbrt(load->mass);
  mark->link[0] = load->link;
  memcpy(mark->at[0], load->position, sizeof load->position);
  return 1;
}
