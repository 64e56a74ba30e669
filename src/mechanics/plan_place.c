/* mechanics/plan_place.c - where everything stands in the scratch, and what frames can share.
 *
 * Sharing keeps the scratch small and saves additions:
 *   - a joint keeps its axis column, a prismatic joint keeps the whole orientation;
 *   - a revolute joint whose axis meets the parent's origin keeps the origin;
 * The kernels in the frames' own axes have slots of their own, behind this (plan_local.c).
 */
#include <stddef.h>

#include "mechanics/plan_build.h"

static int take(size_t *used, int entries) {
  size_t at = *used;
  *used += (size_t)entries * AMBULO__LANES;
  return (int)at;
}

static int child_count(const ambulo__plan *plan, int frame) {
  int count = 0;
  for (int k = 0; k < plan->coordinates; k++) count += plan->joints[k].parent == frame;
  return count;
}

/* The frame whose orientation (or, with `place`, origin) this frame has. */
static int owner(const ambulo__plan *plan, int frame, int place) {
  while (frame > 0) {
    const ambulo__joint *joint = &plan->joints[frame - 1];
    if (place ? (!joint->revolute || joint->has_offset) : joint->revolute) break;
    frame = joint->parent;
  }
  return frame;
}

static void place_columns(ambulo__plan *plan, int k, size_t *used) {
  ambulo__joint *joint = &plan->joints[k];
  ambulo__frame *frame = &plan->frames[k + 1];
  const ambulo__frame *parent = &plan->frames[joint->parent];
  int base[3], u = (joint->axis + 1) % 3, v = (joint->axis + 2) % 3;
  for (int i = 0; i < 3; i++) {
    base[i] = parent->column_at[i];
    frame->column_at[i] = base[i];
    if (!joint->turned) continue;
    joint->turn_at[i] = joint->revolute || i == 2 ? take(used, 3) : 0;
    base[i] = joint->turn_at[i];
  }
  joint->axis_at = base[joint->axis];
  if (!joint->revolute) return;
  joint->from_at[0] = base[u];
  joint->from_at[1] = base[v];
  joint->to_at[0] = take(used, 3);
  joint->to_at[1] = take(used, 3);
  frame->column_at[joint->axis] = joint->axis_at;
  frame->column_at[u] = joint->to_at[0];
  frame->column_at[v] = joint->to_at[1];
}

static void place_motion(ambulo__plan *plan, size_t *used) {
  ambulo__frame *world = &plan->frames[0];
  for (int i = 0; i < 3; i++) world->column_at[i] = take(used, 3);
  world->rate_at = take(used, 6);
  world->place_at = take(used, 6);
  for (int k = 0; k < plan->coordinates; k++) {
    ambulo__joint *joint = &plan->joints[k];
    ambulo__frame *frame = &plan->frames[k + 1];
    const ambulo__frame *parent = &plan->frames[joint->parent];
    place_columns(plan, k, used);
    joint->own_origin = !joint->revolute || joint->has_offset;
    joint->still = owner(plan, joint->parent, 0) == 0;
    frame->rate_at = joint->revolute ? take(used, 6) : parent->rate_at;
    frame->place_at = joint->own_origin ? take(used, 6) : parent->place_at;
  }
}

/* Motions of the joints, and sums over subtrees where they are stored; masses are constants. */
static void place_jacobian(ambulo__plan *plan, size_t *used) {
  for (int f = 0; f <= plan->coordinates; f++) {
    ambulo__frame *frame = &plan->frames[f];
    frame->velocity_at = owner(plan, f, 1) == f ? take(used, 3) : 0;
    frame->velocity_at = plan->frames[owner(plan, f, 1)].velocity_at;
    frame->subtree_mass = frame->body >= 0 ? plan->body[frame->body].mass : 0;
    frame->subtree_at = -1;
    if (f == 0 || f == plan->whole || child_count(plan, f) > 1) frame->subtree_at = take(used, 27);
  }
  for (int f = plan->coordinates; f >= 1; f--) {
    ambulo__joint *joint = &plan->joints[f - 1];
    plan->frames[joint->parent].subtree_mass += plan->frames[f].subtree_mass;
    joint->motion_at = take(used, 18);
    if (joint->torque_row == AMBULO__ROW_DENSE) joint->reaction_at = take(used, 17);
  }
  plan->positions_at = take(used, 3 * plan->points);
}

static int depth_of(const ambulo__plan *plan, int frame) {
  int depth = 0;
  for (; frame > 0; frame = plan->joints[frame - 1].parent) depth++;
  return depth;
}

/* Limbs side by side: what one joint waits for is computed while another limb's joint runs. */
static void place_order(ambulo__plan *plan) {
  int placed = 0;
  for (int depth = 1; placed < plan->coordinates; depth++) {
    for (int k = 0; k < plan->coordinates; k++) {
      if (depth_of(plan, k + 1) == depth) plan->order[placed++] = k;
    }
  }
}

void ambulo__plan_place(ambulo__plan *plan) {
  size_t *used = &plan->scratch;
  place_order(plan);
  place_motion(plan, used);
  if (plan->grounded) plan->ground_at = take(used, 23);
  plan->angle_at = take(used, 2 * plan->coordinates);
  place_jacobian(plan, used);
}
