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
#include "base/sized.h"

#include <math.h>
#include <string.h>

#include "model/model_check.h"

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
  if (model->load_count == AMBULO__MOST_LOADS) return;
  model->loads[model->load_count++] =
      (ambulo__model_load){link, mass, {position[0], position[1], position[2]}};
}

static void take_off(ambulo_link *carrier, const ambulo__model_load *load) {
  ambulo__part whole = {.mass = carrier->mass}, less = {.mass = -load->mass};
  if (carrier->mass - load->mass > 1e-12 * load->mass) {
    memcpy(whole.com, carrier->com, sizeof whole.com);
    memcpy(whole.inertia, carrier->inertia, sizeof whole.inertia);
    memcpy(less.com, load->position, sizeof less.com);
    ambulo__part_add(&whole, &less);
  } else {
    whole.mass = 0.0;
  }
  carrier->mass = whole.mass;
  memcpy(carrier->com, whole.com, sizeof whole.com);
  memcpy(carrier->inertia, whole.inertia, sizeof whole.inertia);
}

void ambulo__model_put_down(ambulo_model *model) {
  for (int i = 0; i < model->load_count; i++) {
    take_off(&model->links[model->loads[i].link], &model->loads[i]);
    model->mass -= model->loads[i].mass;
  }
  model->load_count = 0;
}

static void stretch(double *lengths, int count, double longer) {
  for (int i = 0; i < count; i++) lengths[i] *= longer;
}

static void resize_coordinate(ambulo_coordinate *c, double mass, double longer, double moment,
                              double force) {
  int turns = c->type == AMBULO_REVOLUTE;
  stretch(c->torque, 2, turns ? moment : force);
  c->armature *= turns ? mass * longer * longer : mass;
  c->damping *= turns ? moment : force / longer;
  c->friction *= turns ? moment : force;
  if (turns) return;
  stretch(c->range, 2, longer);
  stretch(c->speed, 2, longer);
  c->default_value *= longer;
}

static void stretch_places(ambulo_model *m, double longer) {
  for (int i = 0; i < m->point_count; i++) {
    stretch(m->points[i].position, 3, longer);
    stretch(m->neutral + (size_t)i * 3, 3, longer);
  }
  for (int i = 0; i < m->patch_count; i++) stretch(m->patches[i].size, 2, longer);
  for (int i = 0; i < m->capsule_count; i++) {
    stretch(m->capsules[i].from, 3, longer);
    stretch(m->capsules[i].to, 3, longer);
    m->capsules[i].radius *= longer;
  }
}

/* f of a coordinate x, either of them a length: where x is, x becomes longer too */
static void stretch_functions(ambulo_model *m, double longer) {
  double *at = m->splines;
  for (int i = 0; i < m->link_count; i++) {
    ambulo_link *link = &m->links[i];
    if (link->coupled_to < 0) continue;
    double value = link->type == AMBULO_PRISMATIC ? longer : 1.0;
    double by = m->coordinates[link->coupled_to].type == AMBULO_PRISMATIC ? longer : 1.0;
    for (int k = 0; k < link->knot_count; k++, at += 2) {
      at[0] *= by;
      at[1] *= value;
    }
    double factor = value;
    for (int k = 0; k < AMBULO__COUPLING_TERMS; k++, factor /= by) link->polynomial[k] *= factor;
  }
  ambulo__model_couple(m);
}

/* masses are shares of M, lengths of H, inertias of M H^2, torques of M g H, forces of M g */
void ambulo__model_resize(ambulo_model *m, double heavier, double longer) {
  ambulo__model_units *u = &m->units;
  double mass = u->mass == 1.0 ? 1.0 : heavier;
  double length = u->length == 1.0 || u->length == 0.0 ? 1.0 : longer;
  int by_weight = u->moment != 1.0 && u->moment != 0.0;
  double force = by_weight ? heavier : 1.0, moment = by_weight ? heavier * longer : 1.0;
  for (int i = 0; i < m->link_count; i++) {
    ambulo_link *link = &m->links[i];
    link->d *= length;
    link->a *= length;
    link->mass *= mass;
    stretch(link->com, 3, length);
    stretch(link->inertia, 6, mass * length * length);
  }
  stretch_functions(m, length);
  for (int i = 0; i < m->coordinate_count; i++)
    resize_coordinate(&m->coordinates[i], mass, length, moment, force);
  stretch_places(m, length);
  m->mass *= mass;
  m->stature *= longer;
  u->mass *= mass;
  u->length *= length;
  u->force *= force;
  u->moment *= moment;
}

double ambulo__model_load_mass(const ambulo_model *model) {
  double sum = 0.0;
  for (int i = 0; i < model->load_count; i++) sum += model->loads[i].mass;
  return sum;
}

void ambulo__model_tilt(ambulo_model *model, double slope) {
  const double *old = model->gravity;
  double g = sqrt(old[0] * old[0] + old[1] * old[1] + old[2] * old[2]);
  for (int i = 0; i < 3; i++)
    model->gravity[i] = -g * (cos(slope) * model->up[i] + sin(slope) * model->forward[i]);
}

/* --------------------------------------------------------------- in the open */

static int in_range(const ambulo_model *model, const ambulo_conditions *c) {
  if (!(fabs(c->slope) <= AMBULO__LARGEST_SLOPE)) return 0;
  if (c->load_link < 0) return c->load_link == -1;
  double position = c->load_position[0] + c->load_position[1] + c->load_position[2];
  return c->load_link < model->link_count && c->load_mass >= 1e-6 && c->load_mass <= 1000.0 &&
         isfinite(position);
}

ambulo_status ambulo__model_copy(const ambulo_model *model, const ambulo_point *points,
                                 int point_count, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo_model **copy) {
  ambulo_model_definition d = ambulo_model_definition_default();
  d.name = model->name;
  d.links = model->links;
  d.link_count = model->link_count;
  d.coordinates = model->coordinates;
  d.coordinate_count = model->coordinate_count;
  d.points = points;
  d.point_count = point_count;
  d.feet = model->feet;
  d.foot_count = model->foot_count;
  d.patches = model->patches;
  d.patch_count = model->patch_count;
  d.capsules = model->capsules;
  d.capsule_count = model->capsule_count;
  d.stature = model->stature > 0.0 ? model->stature : AMBULO_OFF;
  for (int i = 0; i < 3; i++) {
    d.gravity[i] = -9.81 * model->up[i];
    d.forward[i] = model->forward[i];
  }
  ambulo_status status = ambulo_model_create(&d, allocator, diagnostics, copy);
  if (status) return status;
  memcpy((*copy)->gravity, model->gravity, sizeof model->gravity);
  memcpy((*copy)->up, model->up, sizeof model->up);
  memcpy((*copy)->forward, model->forward, sizeof model->forward);
  memcpy((*copy)->left, model->left, sizeof model->left);
  (*copy)->mass = model->mass;
  (*copy)->units = model->units;
  memcpy((*copy)->coordinate_written, model->coordinate_written,
         (size_t)model->coordinate_count * sizeof *model->coordinate_written);
  memcpy((*copy)->capsule_point, model->capsule_point,
         (size_t)model->capsule_count * sizeof *model->capsule_point);
  memcpy((*copy)->loads, model->loads, sizeof model->loads);
  (*copy)->load_count = model->load_count;
  return AMBULO_OK;
}

ambulo_status ambulo_model_adapt(const ambulo_model *model, const ambulo_conditions *conditions,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 ambulo_model **adapted) {
  ambulo_conditions own;
  if (!model || !conditions || !adapted || !AMBULO__OWN(ambulo_conditions, &own, conditions))
    return AMBULO_E_ARGUMENT;
  conditions = &own;
  if (!in_range(model, conditions)) {
    return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                         "the conditions are out of range (slope %g rad, %g kg on link %d); "
                         "expected a slope of -%g to %g rad and 1e-6 to 1000 kg on a link",
                         conditions->slope, conditions->load_mass, conditions->load_link,
                         AMBULO__LARGEST_SLOPE, AMBULO__LARGEST_SLOPE);
  }
  ambulo_model *copy = NULL;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status =
      ambulo__model_copy(model, model->points, model->point_count, allocator, diagnostics, &copy);
  if (status) return ambulo__conclude(diagnostics, errors, status, NULL);
  if (conditions->load_link >= 0)
    ambulo__model_carry(copy, conditions->load_link, conditions->load_mass,
                        conditions->load_position);
  if (conditions->slope != 0.0) ambulo__model_tilt(copy, conditions->slope);
  *adapted = copy;
  return AMBULO_OK;
}
