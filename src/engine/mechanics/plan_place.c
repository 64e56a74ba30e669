/* mechanics/plan_place.c - where everything that the Jacobians keep stands in the scratch, and the
 * ground's wrenches, which they and the reverse sweep read in one place.
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

static void find_last_carried(ambulo__plan *plan) {
  for (int k = plan->coordinates - 1; k >= 0; k--) {
    ambulo__frame *frame = &plan->frames[k + 1], *parent = &plan->frames[plan->joints[k].parent];
    if (frame->last_carried < k) frame->last_carried = k;
    if (parent->last_carried < frame->last_carried) parent->last_carried = frame->last_carried;
  }
}

/* The lowest place among equal ones from `base` on that no frame holds that is still needed: with
 * the last coordinate that it carries its limb ends, and the next takes over its place; `kept`:
 * unless all are needed to the end. */
static int lowest_free(const ambulo__plan *plan, int k, int base, int entries, int kept,
                       int (*place_of)(const ambulo__plan *, int)) {
  int at = base, is_free = 0;
  while (!is_free) {
    is_free = 1;
    for (int f = 0; f < k; f++) {
      int needed = kept || plan->frames[f + 1].last_carried >= k;
      if (!needed || place_of(plan, f) != at) continue;
      at += entries * AMBULO__LANES;
      is_free = 0;
    }
  }
  return at;
}

static int motion_place(const ambulo__plan *plan, int k) {
  return plan->joints[k].motion_at;
}

static int subtree_place(const ambulo__plan *plan, int k) {
  return plan->frames[k + 1].subtree_at;
}

static void enlarge(size_t *used, int at, int entries) {
  size_t end = (size_t)at + (size_t)entries * AMBULO__LANES;
  if (end > *used) *used = end;
}

/* Motions of the joints, to which ground reaction comes back, and sums over subtrees where they are
 * stored; masses are constants. */
static void place_jacobian(ambulo__plan *plan, size_t *used) {
  const int motion = 18, kept = plan->contacts > 0;
  plan->frames[0].subtree_at = take(used, AMBULO__SUBTREE);
  int motions = (int)*used;
  for (int k = 0; k < plan->coordinates; k++) {
    plan->joints[k].motion_at = lowest_free(plan, k, motions, motion, kept, motion_place);
    enlarge(used, plan->joints[k].motion_at, motion);
  }
  int subtrees = (int)*used;
  for (int k = 0; k < plan->coordinates; k++) {
    ambulo__frame *frame = &plan->frames[k + 1];
    int own = frame->body >= 0 || child_count(plan, k + 1) != 1;
    frame->subtree_mass = frame->body >= 0 ? plan->body[frame->body].mass : 0;
    frame->subtree_at = -1;
    if (!own) continue;
    frame->subtree_at = lowest_free(plan, k, subtrees, AMBULO__SUBTREE, 0, subtree_place);
    enlarge(used, frame->subtree_at, AMBULO__SUBTREE);
  }
  for (int k = plan->coordinates - 1; k >= 0; k--) {
    plan->frames[plan->joints[k].parent].subtree_mass += plan->frames[k + 1].subtree_mass;
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
  find_last_carried(plan);
  if (plan->contacts > 0) plan->contacts_at = take(used, ambulo__plan_contact_entries(plan));
  place_jacobian(plan, used);
}
