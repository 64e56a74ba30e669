/* mechanics/plan_local.c - which constants of joints and bodies vanish, and where the tree forks.
 *
 * Coordinates are in an order in which parents come first; along a limb they follow each other.
 */
#include <string.h>

#include "mechanics/plan_layout.h"

/* The axis along which v lies, 3 if none; of a vector of zeros, axis 2. */
static int along(const double v[3]) {
  for (int k = 2; k >= 0; k--) {
    if (v[(k + 1) % 3] == 0 && v[(k + 2) % 3] == 0) return k;
  }
  return 3;
}

/* base 1 + first u u^T + second w w^T, see plan_inertia.c, in the frame's axes. */
static void set_inertia(ambulo__local_step *step, const ambulo__rigid_body *body) {
  static const int place[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  double u[3] = {0}, w[3] = {0};
  u[body->order[0]] = 1;
  u[body->order[1]] = body->lower[0];
  u[body->order[2]] = body->lower[1];
  w[body->order[1]] = 1;
  w[body->order[2]] = body->lower[2];
  for (int i = 0; i < 3; i++) {
    for (int k = i; k < 3; k++) {
      step->inertia[place[i][k]] =
          (i == k ? body->base : 0) + body->first * u[i] * u[k] + body->second * w[i] * w[k];
    }
  }
  for (int i = 0; i < 3; i++) {
    step->difference[i] = step->inertia[(i + 2) % 3] - step->inertia[(i + 1) % 3];
  }
}

static void set_body(ambulo__local_step *step, const ambulo__rigid_body *body) {
  static const ambulo__body_kind kinds[] = {AMBULO__BODY_X, AMBULO__BODY_Y, AMBULO__BODY_Z,
                                            AMBULO__BODY_DIAGONAL};
  step->mass = body->mass;
  for (int i = 0; i < 3; i++) {
    step->com[i] = body->com[i];
    step->first_moment[i] = body->mass * body->com[i];
  }
  set_inertia(step, body);
  step->body = (uint8_t)(body->diagonal ? kinds[along(step->com)] : AMBULO__BODY_ANY);
}

static void set_joint(ambulo__local_step *step, const ambulo__joint *joint) {
  static const ambulo__offset_kind kinds[] = {AMBULO__OFFSET_X, AMBULO__OFFSET_Y, AMBULO__OFFSET_Z,
                                              AMBULO__OFFSET_ANY};
  step->joint = (uint8_t)(joint->revolute ? joint->axis : AMBULO__SLIDES);
  if (!joint->revolute && joint->still && !joint->turned) {
    step->joint = (uint8_t)(AMBULO__SLIDES_X + joint->axis);
  }
  step->sign = joint->sign;
  step->still = joint->still;
  step->turned = joint->revolute && joint->turned;
  memcpy(step->turn, joint->turn, sizeof step->turn);
  for (int i = 0; i < 3; i++) {
    double axis = joint->turned ? joint->turn[3 * i + joint->axis] : i == joint->axis;
    step->slide[i] = joint->sign * axis;
    step->move[i] = joint->revolute && !joint->has_offset ? 0 : joint->offset[i];
  }
  step->offset = step->moving = AMBULO__OFFSET_NONE;
  if (step->move[0] == 0.0 && step->move[1] == 0.0 && step->move[2] == 0.0) return;
  int axis = along(step->move);
  step->offset = (uint8_t)kinds[axis];
  if (!step->still) step->moving = step->offset;
  if (axis < 3) step->length = step->move[axis];
}

/* Whose motion the reverse sweep does not get from the child's: of leaves, and above sliders, but
 * for those in frames that do not turn. */
static void set_stored(ambulo__local_plan *local, int count) {
  for (int k = 0; k < count; k++) {
    ambulo__local_step *step = &local->steps[k];
    bool followed = k + 1 < count && step[1].carried;
    step->stored = step->kept || !followed || step[1].joint == AMBULO__SLIDES;
    step->unwinds = k > 0 && step->carried && !step[-1].stored && step[-1].joint <= AMBULO__SLIDES;
  }
}

/* Who continues from registers, and who reads what the parent has stored. */
static void set_forks(ambulo__plan *plan) {
  ambulo__local_step *steps = plan->local.steps;
  for (int k = 0; k < plan->coordinates; k++) {
    ambulo__local_step *step = &steps[k];
    step->parent = plan->joints[k].parent - 1;
    step->carried = step->parent == k - 1;
    step->from_world = step->parent < 0;
    step->plain = step->carried && step->offset == AMBULO__OFFSET_NONE && !step->turned;
    step->loaded = step->body != AMBULO__BODY_NONE;
    if (step->carried) continue;
    if (step->from_world) {
      plan->local.branched = 1;
    } else {
      steps[step->parent].kept = 1;
    }
  }
}

/* As far up as loads go. */
static void set_rise(const ambulo__local_plan *local, ambulo__limb *limb) {
  while (limb->rise != limb->top && !local->steps[local->steps[limb->rise].parent].vanishes) {
    limb->rise = local->steps[limb->rise].parent;
  }
  int parent = local->steps[limb->rise].parent;
  limb->ends = parent >= 0 && local->steps[parent].vanishes;
}

/* The order of the passes; open: children of each frame that are not done yet (0: the world). */
static void set_limbs(ambulo__plan *plan, int *open) {
  ambulo__local_plan *local = &plan->local;
  int first = 0, rooted = 0;
  for (int k = 0; k < plan->coordinates; k++) open[plan->joints[k].parent]++;
  for (int k = 0; k < plan->coordinates; k++) {
    int top = k;
    if (open[k + 1] > 0) continue;
    while (local->steps[top].parent >= 0 && --open[local->steps[top].parent + 1] == 0) {
      top = local->steps[top].parent;
    }
    ambulo__limb *limb = &local->limbs[local->limb_count++];
    *limb = (ambulo__limb){.first = first, .stem = first - 1, .leaf = k, .top = top, .rise = k};
    set_rise(local, limb);
    first = k + 1;
    ambulo__local_step *step = &local->steps[top];
    ambulo__local_step *above = step->parent >= 0 ? &local->steps[step->parent] : NULL;
    step->first = above ? !above->loaded : !rooted;
    limb->fresh = step->first && !(above && above->contacts);
    rooted |= !above;
    if (above) above->loaded = 1;
  }
  for (int k = 0; k < plan->coordinates; k++) {
    if (local->steps[k].contacts) local->steps[k].loaded = 1;
  }
}

/* Where virtual motions go, and who is the first to leave adjoints to a frame: limbs are taken from
 * the last one on. Returns how many virtual motions the limbs share. */
static int set_stems(ambulo__plan *plan, int shared_at) {
  ambulo__local_plan *local = &plan->local;
  int longest = 0;
  for (int i = 0; i < local->limb_count; i++) {
    ambulo__limb *limb = &local->limbs[i];
    for (int k = limb->first; k <= limb->leaf; k++) {
      if (local->steps[k].kept) limb->stem = k;
    }
    for (int k = limb->first; k <= limb->leaf; k++) {
      ambulo__local_step *step = &local->steps[k];
      int place = k - limb->stem - 1;
      step->virtual_at = place < 0 ? step->at + local_turn : shared_at + place * 6 * AMBULO__LANES;
      if (place >= longest) longest = place + 1;
    }
  }
  for (int k = 0; k < plan->coordinates; k++) {
    ambulo__local_step *step = &local->steps[k];
    step->first_adjoint = !step->carried;
    for (int j = k + 1; j < plan->coordinates; j++) {
      if (local->steps[j].parent == step->parent) step->first_adjoint = 0;
    }
  }
  return longest;
}

static void set_angles(ambulo__plan *plan) {
  ambulo__local_plan *local = &plan->local;
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__local_step *step = &local->steps[k];
    if (step->joint >= AMBULO__SLIDES) continue;
    local->angles[local->angle_count++] = (ambulo__local_angle){step->input, step->at + local_angle,
                                                                step->sign, plan->joints[k].shift};
  }
  for (int last = local->angle_count - 1; local->angle_count % ambulo__angle_row != 0;) {
    local->angles[local->angle_count++] = local->angles[last];
  }
}

/* Frames down to each point, and with ground reaction to each body, to where masses stand, and to
 * what contacts act on.
 * Groups of points are in order of frames. */
static void set_points(ambulo__plan *plan) {
  ambulo__local_step *steps = plan->local.steps;
  plan->local.world_group = -1;
  for (int k = 0; k < plan->coordinates; k++) steps[k].group = -1;
  for (int f = 0, group = 0; f <= plan->coordinates; f++) {
    int *place = f > 0 ? &steps[f - 1].group : &plan->local.world_group;
    for (int i = 0; i < plan->points && *place < 0; i++) {
      if (plan->point[i].frame == f) *place = group;
    }
    if (*place >= 0) group++;
  }
  for (int k = plan->coordinates - 1; k >= 0; k--) {
    int parent = plan->joints[k].parent;
    ambulo__local_step *step = &steps[k], *above = parent > 0 ? &steps[parent - 1] : NULL;
    int bears = plan->contacts > 0 && (step->body != AMBULO__BODY_NONE || step->contacts != 0);
    if (step->group >= 0 || step->weighs || bears) step->pointed = 1;
    if (!step->pointed || !above) continue;
    above->pointed = 1;
    if (step->carried) {
      above->carries_points = 1;
    } else {
      step->first_weight = !above->weighted;
      above->weighted = 1;
    }
  }
}

/* Which steps of the passes for points have more to do than to turn. */
static void set_point_passes(ambulo__plan *plan) {
  for (int k = 0; k < plan->coordinates; k++) {
    ambulo__local_step *step = &plan->local.steps[k];
    const ambulo__local_step *after = step + 1;
    step->draws = !step->carries_points || step->weighted || step->group >= 0 || step->weighs ||
                  step->contacts != 0 || step->floats;
    step->levers =
        step->draws || after->joint >= AMBULO__SLIDES || after->offset != AMBULO__OFFSET_NONE;
    int shows = 0, keeps = step->keeps | (step->weighs & 7);
    if (step->kept || step->contacts) shows |= ambulo__shows_place;
    if (step->group >= 0) shows |= ambulo__shows_points;
    if (step->weighs) shows |= ambulo__shows_mass;
    if (step->body != AMBULO__BODY_NONE) shows |= ambulo__shows_body;
    if (step->group >= 0) keeps |= ambulo__shows_place;
    if (step->levers) keeps |= ambulo__shows_origin;
    keeps |= step->joint < AMBULO__SLIDES ? 1 << step->joint : ambulo__shows_axis;
    step->shows = (uint8_t)shows;
    step->keeps = (uint8_t)(shows | keeps);
  }
}

/* Adds a joint that carries a contact to the path whose first pivot is given. */
static void add_carrier(ambulo__local_plan *local, ambulo__local_step *step, int first_pivot) {
  int pivots = local->pivot_count, slides = step->joint >= AMBULO__SLIDES;
  ambulo__pivot *pivot = pivots > first_pivot ? &local->pivots[pivots - 1] : NULL;
  local->carrier[local->carrier_count++] =
      slides ? (ambulo__carrier){step->at + local_axis, step->input, 1}
             : (ambulo__carrier){step->at + local_columns + 3 * AMBULO__LANES * step->joint,
                                 step->input, step->sign};
  if (pivot && pivot->slides == slides && (slides || step->offset == AMBULO__OFFSET_NONE)) {
    pivot->count++;
    return;
  }
  local->pivots[local->pivot_count++] = (ambulo__pivot){step->at + local_origin, slides, 1};
  if (!slides) step->keeps |= ambulo__shows_origin;
}

/* The path of the joints that carry these contacts: it continues the last one that carries them
 * and more. */
static void add_path(const ambulo__plan *plan, ambulo__local_plan *local, int contacts) {
  int path = local->path_count++, above = path - 1;
  while (above >= 0 && (local->path[above].contacts & contacts) != contacts) above--;
  local->path[path] = (ambulo__path){contacts, above, local->carrier_count, local->pivot_count};
  for (int k = 0; k < plan->coordinates; k++) {
    if (plan->joints[k].contacts != contacts || local->steps[k].vanishes) continue;
    add_carrier(local, &local->steps[k], local->path[path].first_pivot);
  }
  for (int f = 0; f < plan->contacts; f++) {
    if (contacts >> f & 1) local->contact_path[f] = path;
  }
}

static int has_path(const ambulo__local_plan *local, int contacts) {
  for (int i = 0; i < local->path_count; i++) {
    if (local->path[i].contacts == contacts) return 1;
  }
  return 0;
}

/* Who carries the contacts. Joints come after those that carry them, hence paths do. */
static void set_contacts(ambulo__plan *plan) {
  ambulo__local_plan *local = &plan->local;
  for (int f = 0; f < plan->contacts; f++) local->contact_path[f] = -1;
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__joint *joint = &plan->joints[k];
    local->steps[k].vanishes = joint->torque_row == AMBULO__ROW_VANISHES;
  }
  for (int k = 0; k < plan->coordinates; k++) {
    int contacts = plan->joints[k].contacts;
    if (contacts == 0 || local->steps[k].vanishes || has_path(local, contacts)) continue;
    add_path(plan, local, contacts);
  }
  local->path[local->path_count] = (ambulo__path){0, -1, local->carrier_count, local->pivot_count};
  for (int f = 0; f < plan->contacts; f++) {
    local->contact_step[f] = plan->contact_frame[f] - 1;
    if (local->contact_step[f] < 0) continue;
    ambulo__local_step *step = &local->steps[local->contact_step[f]];
    local->bare[f] = step->body == AMBULO__BODY_NONE && step->contacts == 0;
    step->contacts |= (uint8_t)(1 << f);
  }
  if (plan->vanishing > 0) {
    local->steps[plan->roots[plan->vanishing - 1] / AMBULO__LANES].floats = 1;
  }
}

/* (W.C): Masses and moments of kernel_local_points.h. A frame's mass stands at its origin for the
 * parent, which it then is part of; that of a slider is left where it is. */
static void set_masses(ambulo__plan *plan) {
  ambulo__local_step *steps = plan->local.steps;
  for (int k = 0; k < plan->coordinates; k++) {
    ambulo__local_step *step = &steps[k];
    if (step->body == AMBULO__BODY_NONE) continue;
    step->anchored = step->mass;
    memcpy(step->moment, step->first_moment, sizeof step->moment);
  }
  for (int k = plan->coordinates - 1; k >= 0; k--) {
    ambulo__local_step *step = &steps[k], *above = step->parent >= 0 ? &steps[step->parent] : NULL;
    double *moment = above ? above->moment : plan->local.fixed_moment;
    if (step->joint < AMBULO__SLIDES) {
      for (int i = 0; i < 3; i++) moment[i] += step->anchored * step->move[i];
      if (above) above->anchored += step->anchored;
      step->anchored = 0;
    }
    for (int i = 0; i < 3; i++) step->weighs |= (uint8_t)((step->moment[i] != 0) << i);
    step->weighs |= (uint8_t)((step->anchored != 0) << 3);
  }
}

ambulo_status ambulo__plan_local_build(ambulo__plan *plan) {
  size_t d = (size_t)plan->coordinates + 1;
  int slots = (int)plan->scratch;
  ambulo__local_plan *local = &plan->local;
  local->steps = ambulo__alloc_aligned(&plan->allocator, d, sizeof *local->steps);
  local->carrier = ambulo__alloc(&plan->allocator, d, sizeof *local->carrier);
  local->pivots = ambulo__alloc(&plan->allocator, d, sizeof *local->pivots);
  local->limbs = ambulo__alloc(&plan->allocator, d, sizeof *local->limbs);
  local->angles = ambulo__alloc(&plan->allocator, d + ambulo__angle_row, sizeof *local->angles);
  int *open = ambulo__alloc(&plan->allocator, d, sizeof *open);
  if (!local->steps || !local->carrier || !local->pivots || !local->limbs || !local->angles ||
      !open) {
    ambulo__free(&plan->allocator, open);
    return AMBULO_E_MEMORY;
  }
  local->world_at = slots;
  for (int k = 0; k < plan->coordinates; k++) {
    ambulo__local_step *step = &local->steps[k];
    int body = plan->frames[k + 1].body;
    step->input = k * AMBULO__LANES;
    step->at = slots + (k + 1) * local_slot;
    step->above = slots + plan->joints[k].parent * local_slot;
    step->body = AMBULO__BODY_NONE;
    set_joint(step, &plan->joints[k]);
    if (body >= 0) set_body(step, &plan->body[body]);
  }
  if (plan->contacts > 0) set_contacts(plan);
  set_forks(plan);
  set_stored(local, plan->coordinates);
  if (plan->contacts > 0) set_masses(plan);
  set_limbs(plan, open);
  int shared = set_stems(plan, slots + (int)d * local_slot);
  set_angles(plan);
  ambulo__free(&plan->allocator, open);
  set_points(plan);
  set_point_passes(plan);
  plan->scratch += d * local_slot + (size_t)shared * 6 * AMBULO__LANES;
  return AMBULO_OK;
}

void ambulo__plan_local_free(ambulo__plan *plan) {
  ambulo__free_aligned(&plan->allocator, plan->local.steps);
  ambulo__free(&plan->allocator, plan->local.carrier);
  ambulo__free(&plan->allocator, plan->local.pivots);
  ambulo__free(&plan->allocator, plan->local.limbs);
  ambulo__free(&plan->allocator, plan->local.angles);
}
