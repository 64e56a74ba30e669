/* problem/ground.c - what the kernels are told about the ground at given times.
 *
 * Per block of 8 times [AMBULO__GROUND_ENTRIES][8] (mechanics/plan.h): share a_0 of foot 0, D in
 * world axes = D_f f + D_l l, kappa. Times beyond the last (padding) get a_0 = 1, D = 0,
 * kappa = 0. Centre of pressure of foot j, from the ZMP p (contact/loading.h):
 *
 *     c_0 = p + a_1 D,    c_1 = p - a_0 D
 *
 * Where contacts share the load: [3 + 4 K][8], a point o near them, and for each of K slots its
 * weight and centre (contact/contact_load.h, mechanics/kernel_contacts.h). o is the mean of the
 * centres that are loaded.
 */
#include "problem/nlp.h"
#include "base/vector.h"

#include "contact/contact_load.h"
#include "contact/effector.h"
#include "contact/loading.h"

#include <math.h>

typedef struct fill {
  const ambulo_problem *problem;
  const ambulo__foot_outline *outlines;
  ambulo__slots slots;
  double *ground;
} fill;

static void set(double *lane, int entry, double value) {
  lane[(size_t)entry * AMBULO__LANES] = value;
}

static void fill_split(const fill *f, int k, double time) {
  const ambulo_problem *p = f->problem;
  const ambulo_model *m = p->model;
  ambulo__load load = {{1.0, 0.0}, {0.0, 0.0}};
  double *lane = f->ground + ambulo__lane_index(k, AMBULO__GROUND_ENTRIES, 0);
  if (isfinite(time)) load = ambulo__load_at(&p->definition, f->outlines, time);
  set(lane, 0, load.share[0]);
  for (int axis = 0; axis < 3; axis++)
    set(lane, 1 + axis, load.apart[0] * m->forward[axis] + load.apart[1] * m->left[axis]);
  set(lane, 4, isfinite(time) ? p->definition.ground_reaction.shear : 0.0);
}

static void fill_contacts(const fill *f, int k, double time) {
  const ambulo_problem *p = f->problem;
  double *lane = f->ground + ambulo__lane_index(k, ambulo__plan_ground_entries(p->plan), 0);
  double sum[3] = {0.0, 0.0, 0.0};
  int loaded = 0;
  for (int i = 0; isfinite(time) && i < f->slots.count; i++) {
    ambulo__contact_load load =
        ambulo__contact_load_at(&p->definition, f->outlines, &f->slots, i, NULL, time);
    set(lane, 3 + 4 * i, load.weight);
    for (int axis = 0; axis < 3; axis++) {
      set(lane, 4 + 4 * i + axis, load.center[axis]);
      sum[axis] += load.center[axis];
    }
    loaded += load.loaded;
  }
  for (int axis = 0; loaded && axis < 3; axis++) set(lane, axis, sum[axis] / loaded);
}

ambulo_status ambulo__ground_fill(const ambulo_problem *p, const ambulo_allocator *a,
                                  const double *times, int count, double **ground) {
  *ground = NULL;
  if (!p->channels.slots) return AMBULO_OK;
  size_t lanes = (size_t)ambulo__block_count(count) * AMBULO__LANES;
  size_t entries = (size_t)ambulo__plan_ground_entries(p->plan);
  ambulo__foot_outline *outlines = ambulo__foot_outlines(p->model, a);
  fill f = {p, outlines, ambulo__slots_of(&p->definition), NULL};
  f.ground = ambulo__alloc_aligned(a, lanes * entries, sizeof *f.ground);
  if (!f.ground || !outlines) {
    ambulo__free_aligned(a, f.ground);
    ambulo__free(a, outlines);
    return AMBULO_E_MEMORY;
  }
  int shared = p->definition.ground_reaction.kind == AMBULO_REACTION_SHARED;
  for (int k = 0; k < (int)lanes; k++)
    (shared ? fill_contacts : fill_split)(&f, k, k < count ? times[k] : (double)NAN);
  ambulo__free(a, outlines);
  *ground = f.ground;
  return AMBULO_OK;
}

/* (W.6) c_0 = p + a_1 D, c_1 = p - a_0 D */
void ambulo__pressure_centers(const double *ground, int node, const double *zmp, double *cop) {
  const double *lane = ground + ambulo__lane_index(node, AMBULO__GROUND_ENTRIES, 0);
  double share[2] = {lane[0], 1.0 - lane[0]};
  for (int foot = 0; foot < 2; foot++) {
    double factor = foot == 0 ? share[1] : -share[0];
    for (int axis = 0; axis < 3; axis++) {
      double apart = lane[(size_t)(1 + axis) * AMBULO__LANES];
      cop[3 * foot + axis] = share[foot] > 0.0 ? zmp[axis] + factor * apart : (double)NAN;
    }
  }
}

/* adds what the contact of a slot does about the origin of its surface, the same for both of a foot
 */
static void add_slot(const ambulo_problem *p, const ambulo__contact_load *load, int slot,
                     const double *channel, double force[3], double moment[3]) {
  double own[3], arm[3];
  for (int i = 0; i < 3; i++) {
    int f = ambulo__channel_foot_force(&p->channels, slot, i);
    int m = ambulo__channel_contact_moment(&p->channels, slot, i);
    own[i] = channel[(size_t)f * AMBULO__LANES];
    arm[i] = load->center[i] - load->frame.origin[i];
    force[i] += own[i];
    moment[i] += channel[(size_t)m * AMBULO__LANES];
  }
  ambulo__add_cross(arm, own, 1.0, moment);
}

/* (W.10) origin + n x M / (n.f), M.f / (n.f). A contact without normal force may still have a
 * moment, by the allowance of its rows (contact/sharing.c): no centre says which, so that the
 * moment about the world's origin, M + origin x f, is told besides */
static void place_pressure(const ambulo__contact_frame *frame, const double moment[3],
                           ambulo__pressure *at) {
  double normal = ambulo__dot(at->force, frame->up), shift[3] = {0.0, 0.0, 0.0};
  ambulo__add_cross(frame->up, moment, 1.0, shift);
  for (int i = 0; i < 3; i++) {
    at->center[i] = normal > 0.0 ? frame->origin[i] + shift[i] / normal : (double)NAN;
    at->moment[i] = moment[i];
  }
  ambulo__add_cross(frame->origin, at->force, 1.0, at->moment);
  at->free_moment = normal > 0.0 ? ambulo__dot(at->force, moment) / normal : 0.0;
}

ambulo__pressure ambulo__contact_pressure(const ambulo_problem *p,
                                          const ambulo__foot_outline *outlines, int effector,
                                          double time, const double *channel) {
  ambulo__slots slots = ambulo__slots_of(&p->definition);
  ambulo__contact_frame frame = {{0.0}, {0.0}, {0.0}, {0.0}};
  ambulo__pressure at = {.free_moment = 0.0};
  double moment[3] = {0.0, 0.0, 0.0};
  for (int slot = 0; slot < slots.count; slot++) {
    if (slots.effector[slot] != effector) continue;
    ambulo__contact_load load =
        ambulo__contact_load_at(&p->definition, outlines, &slots, slot, NULL, time);
    if (!load.loaded) continue;
    frame = load.frame;
    add_slot(p, &load, slot, channel, at.force, moment);
  }
  place_pressure(&frame, moment, &at);
  return at;
}

const ambulo_ground_reaction *ambulo_problem_ground_reaction(const ambulo_problem *p) {
  return &p->definition.ground_reaction;
}

double ambulo_problem_load_share(const ambulo_problem *p, int foot, double time) {
  if (!p->channels.slots || foot < 0 || foot >= p->channels.feet) return 0.0;
  if (p->definition.ground_reaction.kind == AMBULO_REACTION_SHARED) return (double)NAN;
  ambulo__foot_outline outlines[2] = {ambulo__foot_outline_of(p->model, 0),
                                      ambulo__foot_outline_of(p->model, 1)};
  return ambulo__load_at(&p->definition, outlines, time).share[foot];
}
