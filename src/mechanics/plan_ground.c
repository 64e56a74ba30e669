/* mechanics/plan_ground.c - what ground reaction adds to a plan: who carries the feet.
 *
 * A joint carries a foot if the foot's frame is its own or below it. Its torque then depends on
 * the foot's wrench, which depends on the motion of the whole body: the row of tau is dense. If a
 * joint carries both feet and every body, and nothing is fixed to the world, its load and the
 * ground's wrench cancel, and tau vanishes identically.
 *
 * The terms list, for each column k, the entries of the dense rows in it
 * (kernel_jacobian_ground.h).
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
      term->entry = (plan->start[i] + k) * AMBULO__LANES;
      term->row_at = joint->reaction_at + (above ? 0 : 7 * AMBULO__LANES);
      term++;
      plan->term_fresh[k] += !add;
    }
  }
}

static void fill_pairs(ambulo__plan *plan, int k) {
  const ambulo__joint *joint = &plan->joints[k];
  int first = plan->ancestor_start[k];
  for (int i = first; i < plan->ancestor_start[k + 1]; i++) {
    int j = plan->ancestor[i], place = joint->torque_row == AMBULO__ROW_DENSE ? j : i - first;
    ambulo__ground_pair *pair = &plan->pairs[i];
    pair->motion = plan->joints[j].motion_at;
    pair->lower = (plan->start[k] + place) * AMBULO__LANES;
    pair->upper = plan->upper[i] < 0 ? -1 : plan->upper[i] * AMBULO__LANES;
    pair->mass = pair->upper < 0 ? pair->lower : pair->upper;
  }
}

static void fill_roots(ambulo__plan *plan) {
  ambulo__root_column *root = plan->roots;
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__joint *joint = &plan->joints[k];
    if (joint->torque_row != AMBULO__ROW_VANISHES) continue;
    root->motion = joint->motion_at;
    root->column = k * AMBULO__LANES;
    root->straight = !joint->revolute && joint->still;
    root++;
  }
}

ambulo_status ambulo__plan_ground_terms(ambulo__plan *plan) {
  const ambulo_allocator *allocator = &plan->allocator;
  size_t d = (size_t)plan->coordinates, dense = (size_t)plan->dense_count;
  size_t pairs = (size_t)plan->ancestor_start[d];
  plan->term_fresh = ambulo__alloc(allocator, d, sizeof *plan->term_fresh);
  plan->term = ambulo__alloc(allocator, d * dense, sizeof *plan->term);
  plan->pairs = ambulo__alloc(allocator, pairs, sizeof *plan->pairs);
  plan->roots = ambulo__alloc(allocator, (size_t)plan->vanishing, sizeof *plan->roots);
  if (!plan->term_fresh || !plan->term || !plan->pairs || !plan->roots) return AMBULO_E_MEMORY;
  for (int k = 0; k < plan->coordinates; k++) {
    fill_terms(plan, k, plan->term + (size_t)k * dense);
    fill_pairs(plan, k);
  }
  fill_roots(plan);
  return AMBULO_OK;
}
