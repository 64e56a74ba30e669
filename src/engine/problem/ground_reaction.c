/* problem/ground_reaction.c - what the kernels need to know of the ground at given times.
 *
 * Per block of 8 times [3 + 4 K][8]: a point o near them, and for each of K slots its
 * weight and centre (contact/contacts.h, mechanics/kernel_contacts.h). o is the mean of the
 * centres that are loaded.
 */
#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "problem/nlp.h"

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
  for (int k = 0; k < (int)lanes; k++) fill_contacts(&f, k, k < count ? times[k] : (double)NAN);
  ambulo__free(a, outlines);
  *ground = f.ground;
  return AMBULO_OK;
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
 * moment, by the allowance of its rows (contact/force_rows.c): no centre says which, so that the
 * moment about the world's origin, M + origin x f, is given besides */
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
