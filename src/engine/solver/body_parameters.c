/* solver/body_parameters.c - margins, obstacles and reaches under the keys of a file. Sizes of
 * obstacles and capsules have no sensitivity. */
#include "solver/sensitivity_parameters.h"

#include <stdio.h>

static const char *const ways[] = {"forward", "to the left", "up"};

/* the middle of a box; ends of a capsule */
static void add_places(ambulo__parameters *p, int obstacle) {
  const ambulo_obstacle *o = &p->problem->definition.obstacles[obstacle];
  int is_box = o->shape == AMBULO_OBSTACLE_BOX;
  const double *place[] = {is_box ? o->center : o->from, o->to};
  const char *const keys[] = {is_box ? "center" : "from", "to"};
  const double *by = p->partials->obstacle_place + (size_t)(6 * obstacle);
  char label[AMBULO__PARAMETER_TEXT];
  for (int k = 0; k < (is_box ? 3 : 6); k++) {
    (void)snprintf(label, sizeof label, "%s of obstacle '%s', %s",
                   is_box  ? "place"
                   : k < 3 ? "one end"
                           : "other end",
                   o->name, ways[k % 3]);
    ambulo__parameter_add(p, AMBULO__STEP_LENGTH, place[k / 3][k % 3], by[k], label,
                          "obstacles[%s].%s[%d]", o->name, keys[k / 3], k % 3);
  }
}

static void add_reach(ambulo__parameters *p, int reach) {
  const ambulo_reach *r = &p->problem->definition.reaches[reach];
  const char *point = p->problem->model->points[r->point].name;
  char label[AMBULO__PARAMETER_TEXT];
  for (int axis = 0; axis < 3; axis++) {
    if (r->is_relative)
      (void)snprintf(label, sizeof label, "way from %s to %s, %s",
                     p->problem->model->points[r->about].name, point, ways[axis]);
    else
      (void)snprintf(label, sizeof label, "place that %s reaches, %s", point, ways[axis]);
    ambulo__parameter_add(p, AMBULO__STEP_LENGTH, r->place[axis],
                          p->partials->reach_place[3 * reach + axis], label,
                          "constraints.reach[%d].place[%d]", reach, axis);
  }
  if (r->tolerance == 0.0) return;
  (void)snprintf(label, sizeof label, "tolerance of the place that %s reaches", point);
  ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, r->tolerance, p->partials->reach_tolerance[reach],
                        label, "constraints.reach[%d].tolerance", reach);
}

void ambulo__parameters_of_bodies(ambulo__parameters *p) {
  const ambulo_problem_definition *d = &p->problem->definition;
  if (ambulo_problem_pairs(p->problem, 0, NULL) > 0)
    ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, d->collision.margin,
                          p->partials->collision_margin, "margin between capsules",
                          "constraints.collision.margin");
  for (int o = 0; o < d->obstacle_count; o++) {
    char label[AMBULO__PARAMETER_TEXT];
    add_places(p, o);
    (void)snprintf(label, sizeof label, "margin of obstacle '%s'", d->obstacles[o].name);
    ambulo__parameter_add(p, AMBULO__SHORT_LENGTH, d->obstacles[o].margin,
                          p->partials->obstacle_margin[o], label, "obstacles[%s].margin",
                          d->obstacles[o].name);
  }
  for (int r = 0; r < d->reach_count; r++) add_reach(p, r);
}
