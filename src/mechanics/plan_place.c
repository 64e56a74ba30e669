/* mechanics/plan_place.c - where everything stands in the scratch, and what frames can share.
 *
 * Sharing keeps the scratch small and saves additions:
 *   - a joint keeps its axis column, a prismatic joint keeps the whole orientation;
 *   - a revolute joint whose axis meets the parent's origin keeps the origin;
 *   - a frame without a body and with one child carries the same load as that child (unless it
 *     is a foot that the ground acts on), and its
 *     adjoints (if no point hangs on it either) may be accumulated in place.
 * The scratch of the reverse sweep and of the Jacobians start at the same place: each is written
 * before it is read, after the part that the forward pass leaves behind.
 */
#include <stddef.h>

#include "mechanics/plan_build.h"

static int take(size_t *used, int entries) {
  size_t at = *used;
  *used += (size_t)entries * AMBULO__LANES;
  return (int)at;
}

static int child_count(const ambulo__plan *plan, int frame, int *only) {
  int count = 0;
  for (int k = 0; k < plan->coordinates; k++) {
    if (plan->joints[k].parent != frame) continue;
    *only = k + 1;
    count++;
  }
  return count;
}

static int has_point(const ambulo__plan *plan, int frame) {
  for (int i = 0; i < plan->points; i++) {
    if (plan->point[i].frame == frame) return 1;
  }
  return 0;
}

/* Whether the frame's load is that of its only child. */
static int passes_load_on(const ambulo__plan *plan, int frame, int *only) {
  int one = child_count(plan, frame, only) == 1 && plan->frames[frame].body < 0;
  if (!plan->grounded) return one;
  return one && frame != plan->foot_frame[0] && frame != plan->foot_frame[1];
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

/* Omega where a body, or a joint whose origin moves, needs it. */
static void place_spins(ambulo__plan *plan, size_t *used) {
  for (int f = 0; f <= plan->coordinates; f++) plan->frames[f].spin_at = -1;
  for (int f = 1; f <= plan->coordinates; f++) {
    int needy = plan->joints[f - 1].own_origin && !plan->joints[f - 1].still;
    ambulo__frame *bearer = &plan->frames[owner(plan, plan->joints[f - 1].parent, 0)];
    if (needy && bearer->spin_at < 0) bearer->spin_at = take(used, 9);
    bearer = &plan->frames[owner(plan, f, 0)];
    if (plan->frames[f].body >= 0 && bearer->spin_at < 0) bearer->spin_at = take(used, 9);
  }
  for (int f = 1; f <= plan->coordinates; f++) {
    int bearer = owner(plan, f, 0);
    plan->frames[f].spin_at = plan->frames[bearer].spin_at;
  }
}

/* Loads and moments, children first. */
static void place_loads(ambulo__plan *plan, size_t *used) {
  for (int f = plan->coordinates; f >= 1; f--) {
    ambulo__frame *frame = &plan->frames[f];
    ambulo__joint *joint = &plan->joints[f - 1];
    int only = 0, shared = passes_load_on(plan, f, &only);
    frame->zero_load = frame->body < 0 && !shared;
    frame->load_at = shared ? plan->frames[only].load_at : take(used, 6);
    const ambulo__frame *child = &plan->frames[only];
    int same = shared && child->place_at == frame->place_at && child->moment_at >= 0;
    joint->new_moment = joint->revolute && !same;
    frame->moment_at = -1;
    if (joint->revolute) frame->moment_at = same ? child->moment_at : take(used, 3);
    if (shared) plan->joints[only - 1].own_load = 0;
    joint->own_load = 1;
  }
  plan->frames[0].load_at = take(used, 6);
}

static void place_virtual(ambulo__plan *plan, size_t *used) {
  for (int f = 0; f <= plan->coordinates; f++) {
    ambulo__frame *frame = &plan->frames[f];
    int turner = owner(plan, f, 0), mover = owner(plan, f, 1);
    frame->virtual_at = turner == f ? take(used, 3) : plan->frames[turner].virtual_at;
    frame->slide_at = mover == f ? take(used, 3) : plan->frames[mover].slide_at;
    frame->own_spin = turner == f && frame->spin_at >= 0;
    frame->spin_adjoint_at = frame->own_spin ? take(used, 9) : plan->frames[turner].spin_adjoint_at;
    if (frame->spin_at < 0) frame->spin_adjoint_at = -1;
  }
}

/* The child whose adjoints a frame's are, or 0: nothing else may be added to
 * them here. */
static int heir(const ambulo__plan *plan, int f) {
  const ambulo__frame *frame = &plan->frames[f];
  int only = 0, children = child_count(plan, f, &only);
  if (children != 1 || frame->body >= 0 || frame->own_spin || has_point(plan, f)) return 0;
  const ambulo__joint *joint = &plan->joints[only - 1];
  return joint->revolute || joint->still ? only : 0;
}

static void place_reverse(ambulo__plan *plan, size_t *used) {
  place_virtual(plan, used);
  plan->nowhere_at = take(used, 3);
  for (int f = plan->coordinates; f >= 1; f--) {
    ambulo__frame *frame = &plan->frames[f];
    ambulo__joint *joint = &plan->joints[f - 1];
    int child = heir(plan, f);
    frame->adjoint_at = child ? plan->frames[child].adjoint_at : take(used, 15);
    frame->zero_adjoint = frame->body < 0 && !child;
    joint->own_adjoint = joint->parent != 0;
    joint->correction_at = take(used, 3);
    if (child) plan->joints[child - 1].own_adjoint = 0;
  }
}

/* Composite inertias by load; the mass is a constant. */
static void place_jacobian(ambulo__plan *plan, size_t *used) {
  for (int f = 0; f <= plan->coordinates; f++) {
    ambulo__frame *frame = &plan->frames[f];
    frame->velocity_at = owner(plan, f, 1) == f ? take(used, 3) : 0;
    frame->velocity_at = plan->frames[owner(plan, f, 1)].velocity_at;
    frame->subtree_mass = frame->body >= 0 ? plan->body[frame->body].mass : 0;
  }
  for (int f = plan->coordinates; f >= 1; f--) {
    ambulo__joint *joint = &plan->joints[f - 1];
    ambulo__frame *frame = &plan->frames[f];
    int only = 0, shared = passes_load_on(plan, f, &only);
    frame->composite_at = shared ? plan->frames[only].composite_at : take(used, 21);
    plan->frames[joint->parent].subtree_mass += frame->subtree_mass;
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
  size_t used = 0;
  place_order(plan);
  place_motion(plan, &used);
  place_spins(plan, &used);
  for (int i = 0; i < plan->bodies; i++) plan->body[i].at = take(&used, 18);
  place_loads(plan, &used);
  if (plan->grounded) plan->ground_at = take(&used, 23);
  size_t reverse = used, jacobian = used, angles = used;
  plan->angle_at = take(&angles, 2 * plan->coordinates);
  place_reverse(plan, &reverse);
  place_jacobian(plan, &jacobian);
  plan->scratch = angles > reverse ? angles : reverse;
  if (jacobian > plan->scratch) plan->scratch = jacobian;
}
