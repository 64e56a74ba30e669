/* mechanics/plan_place.c - where everything that the Jacobians keep stands in the scratch.
 *
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

/* Motions of the joints, and sums over subtrees where they are stored; masses are constants. */
static void place_jacobian(ambulo__plan *plan, size_t *used) {
  for (int f = 0; f <= plan->coordinates; f++) {
    ambulo__frame *frame = &plan->frames[f];
    int own = f == 0 || child_count(plan, f) != 1 || frame->body >= 0;
    frame->subtree_mass = frame->body >= 0 ? plan->body[frame->body].mass : 0;
    frame->subtree_at = own ? take(used, AMBULO__SUBTREE) : -1;
  }
  for (int f = plan->coordinates; f >= 1; f--) {
    ambulo__joint *joint = &plan->joints[f - 1];
    plan->frames[joint->parent].subtree_mass += plan->frames[f].subtree_mass;
    joint->motion_at = take(used, 18);
    if (joint->torque_row == AMBULO__ROW_DENSE) joint->reaction_at = take(used, 17);
  }
  plan->positions_at = take(used, 3 * plan->points);
}

/* Whether a joint's parent never turns. */
static int is_still(const ambulo__plan *plan, const ambulo__joint *joint) {
  int parent = joint->parent;
  while (parent > 0 && !plan->joints[parent - 1].revolute) parent = plan->joints[parent - 1].parent;
  return parent == 0;
}

void ambulo__plan_place(ambulo__plan *plan) {
  size_t *used = &plan->scratch;
  for (int k = 0; k < plan->coordinates; k++) {
    plan->joints[k].still = is_still(plan, &plan->joints[k]);
  }
  if (plan->grounded) plan->ground_at = take(used, 23);
  place_jacobian(plan, used);
}
