/* mechanics/plan_ground.c - what ground reaction adds to a plan: who carries the feet.
 *
 * A joint carries a foot if the foot's frame is its own or below it. Its torque then depends on
 * the foot's wrench, which depends on the motion of the whole body: the row of tau is dense. If a
 * joint carries both feet and every body, and nothing is fixed to the world, its load and the
 * ground's wrench cancel, and tau vanishes identically.
 *
 * The terms list, for each column k, the entries of the dense rows in it
 * (kernel_ground_jacobian.h).
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

void ambulo__plan_ground(ambulo__plan *plan, const ambulo_model *model, double ground_height) {
  plan->grounded = 1;
  plan->ground_height = ground_height;
  memcpy(plan->up, model->up, sizeof plan->up);
  for (int f = 0; f < 2; f++) {
    plan->foot_frame[f] = plan->point[model->feet[f].heel_center].frame;
  }
  for (int k = 0; k < plan->coordinates; k++) {
    ambulo__joint *joint = &plan->joints[k];
    joint->feet = carries(plan, k, plan->foot_frame[0]) + 2 * carries(plan, k, plan->foot_frame[1]);
    joint->torque_row = joint->feet == 0 ? AMBULO__ROW_SPARSE : AMBULO__ROW_DENSE;
    if (joint->feet == 3 && carries_everything(plan, k)) joint->torque_row = AMBULO__ROW_VANISHES;
    if (joint->torque_row == AMBULO__ROW_VANISHES) plan->whole = k + 1;
    plan->vanishing += joint->torque_row == AMBULO__ROW_VANISHES;
    plan->dense_count += joint->torque_row == AMBULO__ROW_DENSE;
  }
}

/* Written first: what no pair of joints writes; then the rows below k, where a pair stands. */
static void fill_terms(ambulo__plan *plan, int k, ambulo__reaction_term *term) {
  for (int add = 0; add < 2; add++) {
    for (int i = 0; i < plan->coordinates; i++) {
      const ambulo__joint *joint = &plan->joints[i];
      int above = carries(plan, i, k + 1), below = i != k && carries(plan, k, i + 1);
      if (joint->torque_row != AMBULO__ROW_DENSE || below != add) continue;
      term->entry = plan->start[i] + k;
      term->row_at = joint->reaction_at + (above ? 0 : 7 * AMBULO__LANES);
      term++;
      plan->term_fresh[k] += !add;
    }
  }
}

ambulo_status ambulo__plan_ground_terms(ambulo__plan *plan) {
  const ambulo_allocator *allocator = &plan->allocator;
  size_t d = (size_t)plan->coordinates, dense = (size_t)plan->dense_count;
  size_t pairs = (size_t)plan->ancestor_start[d];
  plan->term_fresh = ambulo__alloc(allocator, d, sizeof *plan->term_fresh);
  plan->term = ambulo__alloc(allocator, d * dense, sizeof *plan->term);
  plan->lower = ambulo__alloc(allocator, pairs, sizeof *plan->lower);
  if (!plan->term_fresh || !plan->term || !plan->lower) return AMBULO_E_MEMORY;
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__joint *joint = &plan->joints[k];
    fill_terms(plan, k, plan->term + (size_t)k * dense);
    for (int i = plan->ancestor_start[k]; i < plan->ancestor_start[k + 1]; i++) {
      int place = i - plan->ancestor_start[k];
      if (joint->torque_row == AMBULO__ROW_DENSE) place = plan->ancestor[i];
      plan->lower[i] = plan->start[k] + place;
    }
  }
  return AMBULO_OK;
}
