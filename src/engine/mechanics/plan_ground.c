/* mechanics/plan_ground.c - what ground reaction adds to a plan: who carries the feet or contacts.
 *
 * A joint carries a foot, or contact, if the frame that it acts on is the joint's own or below it.
 * Its torque then depends on the foot's wrench, which depends on the motion of the whole body. If a
 * joint carries all feet and every body, and nothing is fixed to the world, its load and the
 * ground's wrench cancel, and tau vanishes identically.
 */
#include <string.h>

#include "mechanics/plan_build.h"

static int carries(const ambulo__plan *plan, int coordinate, int frame) {
  while (frame > coordinate + 1) frame = plan->joints[frame - 1].parent;
  return frame == coordinate + 1;
}

static int carries_everything(const ambulo__plan *plan, int coordinate) {
  for (int i = 0; i < 3; i++) {
    if (plan->fixed_load[3 + i] != 0) return 0;
  }
  for (int i = 0; i < plan->bodies; i++) {
    if (!carries(plan, coordinate, plan->body[i].frame)) return 0;
  }
  return 1;
}

ambulo_status ambulo__plan_ground(ambulo__plan *plan, const ambulo_model *model,
                                  const ambulo__footing *footing, const ambulo__placing *placings) {
  const int all = (1 << footing->feet) - 1;
  plan->grounded = 1;
  plan->feet = footing->feet;
  plan->contacts = footing->contacts ? footing->feet : 0;
  plan->ground_height = footing->height;
  plan->moment_arm = footing->moment_arm;
  plan->slant = footing->slant;
  memcpy(plan->up, model->up, sizeof plan->up);
  for (int f = 0; f < plan->feet; f++) plan->foot_frame[f] = placings[footing->link[f]].frame;
  plan->roots = ambulo__alloc(&plan->allocator, (size_t)plan->coordinates, sizeof *plan->roots);
  if (!plan->roots) return AMBULO_E_MEMORY;
  for (int k = 0; k < plan->coordinates; k++) {
    ambulo__joint *joint = &plan->joints[k];
    for (int f = 0; f < plan->feet; f++) joint->feet |= carries(plan, k, plan->foot_frame[f]) << f;
    joint->torque_row = joint->feet == 0 ? AMBULO__ROW_SPARSE : AMBULO__ROW_REACTS;
    if (joint->feet != all || !carries_everything(plan, k)) continue;
    joint->torque_row = AMBULO__ROW_VANISHES;
    plan->roots[plan->vanishing++] = k * AMBULO__LANES;
  }
  return AMBULO_OK;
}
