/* mechanics/plan_steps.c - writing the lists of steps.
 *
 * They lead down the tree and follow plan->order, parents first, so that a step is independent of
 * its neighbours wherever the tree allows it. The way up goes limb by limb (plan_local.h).
 */
#include <string.h>

#include "mechanics/plan_build.h"
#include "mechanics/plan_layout.h"

static void copy_columns(int to[3], const int from[3]) {
  memcpy(to, from, 3 * sizeof *to);
}

static int lanes(int entry) {
  return entry * AMBULO__LANES;
}

static void add_turn(ambulo__plan *plan, const ambulo__joint *joint) {
  ambulo__turn_step *step = &plan->steps.turns[plan->steps.turn_count++];
  copy_columns(step->from, plan->frames[joint->parent].column_at);
  copy_columns(step->to, joint->turn_at);
  step->first = joint->revolute ? 0 : 2;
  memcpy(step->turn, joint->turn, sizeof step->turn);
}

static void add_hinge(ambulo__plan *plan, int k) {
  const ambulo__joint *joint = &plan->joints[k];
  const ambulo__frame *frame = &plan->frames[k + 1], *parent = &plan->frames[joint->parent];
  ambulo__angle_step *angle = &plan->steps.angles[plan->steps.angle_count];
  ambulo__hinge_step *step = &plan->steps.hinges[plan->steps.angle_count++];
  *angle = (ambulo__angle_step){lanes(k), plan->angle_at + lanes(2 * k), joint->sign, joint->shift};
  *step = (ambulo__hinge_step){
      .turn = joint->turned ? plan->steps.turn_count : -1,
      .angle = angle->output,
      .input = lanes(k),
      .axis = joint->axis_at,
      .from = {joint->from_at[0], joint->from_at[1]},
      .to = {joint->to_at[0], joint->to_at[1]},
      .rate_from = parent->rate_at,
      .rate_to = frame->rate_at,
      .sign = joint->sign,
      .shift = joint->shift,
      .place = frame->place_at,
      .velocity = frame->velocity_at,
      .motion = joint->motion_at,
  };
  if (joint->turned) add_turn(plan, joint);
}

static void add_origin(ambulo__plan *plan, int k) {
  const ambulo__joint *joint = &plan->joints[k];
  const ambulo__frame *frame = &plan->frames[k + 1], *parent = &plan->frames[joint->parent];
  ambulo__origin_step *step = &plan->steps.origins[plan->steps.origin_count++];
  *step = (ambulo__origin_step){
      .prismatic = !joint->revolute,
      .still = joint->still,
      .input = lanes(k),
      .axis = joint->axis_at,
      .sign = joint->sign,
      .offset = {joint->offset[0], joint->offset[1], joint->offset[2]},
      .place_from = parent->place_at,
      .place_to = frame->place_at,
      .rate = parent->rate_at,
      .velocity_from = parent->velocity_at,
      .velocity_to = frame->velocity_at,
      .motion = joint->motion_at,
  };
  copy_columns(step->columns, parent->column_at);
}

/* Joints, down the tree. */
static void emit_joints(ambulo__plan *plan) {
  for (int i = 0; i < plan->coordinates; i++) {
    int k = plan->order[i];
    if (plan->joints[k].revolute) add_hinge(plan, k);
    if (plan->joints[k].own_origin) add_origin(plan, k);
  }
  plan->steps.late_turn = plan->steps.turn_count;
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__joint *joint = &plan->joints[k];
    if (!joint->revolute && joint->turned) add_turn(plan, joint);
  }
}

static void emit_bodies(ambulo__plan *plan) {
  for (int i = 0; i < plan->bodies; i++) {
    ambulo__body *body = &plan->body[i];
    const ambulo__frame *frame = &plan->frames[body->frame];
    copy_columns(body->columns, frame->column_at);
    for (int k = 0; k < 3; k++) body->ordered[k] = frame->column_at[body->order[k]];
    body->place = frame->place_at;
    body->rate = frame->rate_at;
    body->velocity = frame->velocity_at;
  }
}

static int is_straight(const ambulo__joint *joint) {
  return !joint->revolute && joint->still;
}

/* The world axis of a straight joint, -1: another direction. */
static int world_axis(const ambulo__plan *plan, const ambulo__joint *joint) {
  const ambulo__frame *world = &plan->frames[0];
  if (!is_straight(joint) || joint->sign < 0) return -1;
  for (int i = 0; i < 3; i++) {
    if (joint->axis_at == world->column_at[i]) return i;
  }
  return -1;
}

static void emit_changes(ambulo__plan *plan) {
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__frame *frame = &plan->frames[k + 1];
    int first = plan->ancestor_start[k], straight = 0, count = plan->ancestor_start[k + 1] - first;
    while (straight < count && is_straight(&plan->joints[plan->ancestor[first + straight]])) {
      straight++;
    }
    plan->steps.changes[k] = (ambulo__change_step){
        .motion = plan->joints[k].motion_at,
        .first = first,
        .straight = straight,
        .is_straight = is_straight(&plan->joints[k]),
        .count = count,
        .lower = lanes(plan->start[k]),
        .mass = frame->subtree_mass,
    };
    for (int i = first; i < first + count; i++) {
      const ambulo__joint *above = &plan->joints[plan->ancestor[i]];
      plan->steps.pairs[i] =
          (ambulo__pair){above->motion_at, lanes(plan->upper[i]), world_axis(plan, above)};
    }
  }
}

static void emit_points(ambulo__plan *plan) {
  ambulo__steps *steps = &plan->steps;
  int placed = 0, links = 0, rows = plan->coordinates + 6;
  for (int f = 0; f <= plan->coordinates; f++) {
    const ambulo__frame *frame = &plan->frames[f];
    ambulo__group_step group = {.place = frame->place_at, .first = placed, .chain = links};
    copy_columns(group.columns, frame->column_at);
    for (int i = 0; i < plan->points; i++) {
      if (plan->point[i].frame != f) continue;
      int row = rows + 3 * i;
      ambulo__point_step *point = &steps->points[placed++];
      memcpy(point->position, plan->point[i].position, sizeof point->position);
      point->output = lanes(row);
      point->entry = lanes(plan->start[row]);
      if (group.count++ > 0) continue;
      for (int e = plan->start[row]; e < plan->start[row + 1]; e++) {
        steps->chains[links++] = plan->joints[plan->column[e]].motion_at;
      }
      group.chain_count = links - group.chain;
    }
    if (group.count > 0) steps->groups[steps->group_count++] = group;
  }
}

ambulo_status ambulo__plan_steps_build(ambulo__plan *plan) {
  const ambulo_allocator *memory = &plan->allocator;
  ambulo__steps *s = &plan->steps;
  size_t d = (size_t)plan->coordinates + 1, points = (size_t)plan->points;
  size_t pairs = (size_t)plan->ancestor_start[plan->coordinates];
  int ok = (s->angles = ambulo__alloc(memory, d, sizeof *s->angles)) &&
           (s->turns = ambulo__alloc(memory, d, sizeof *s->turns)) &&
           (s->hinges = ambulo__alloc(memory, d, sizeof *s->hinges)) &&
           (s->origins = ambulo__alloc(memory, d, sizeof *s->origins)) &&
           (s->changes = ambulo__alloc(memory, d, sizeof *s->changes)) &&
           (s->pairs = ambulo__alloc(memory, pairs, sizeof *s->pairs)) &&
           (s->groups = ambulo__alloc(memory, points, sizeof *s->groups)) &&
           (s->points = ambulo__alloc(memory, points, sizeof *s->points)) &&
           (s->chains = ambulo__alloc(memory, points * d, sizeof *s->chains));
  if (!ok) return AMBULO_E_MEMORY;
  emit_joints(plan);
  emit_bodies(plan);
  emit_changes(plan);
  emit_points(plan);
  return AMBULO_OK;
}

void ambulo__plan_steps_free(ambulo__plan *plan) {
  const ambulo__steps *s = &plan->steps;
  void *const lists[] = {s->angles, s->turns,  s->hinges, s->origins, s->changes,
                         s->pairs,  s->groups, s->points, s->chains};
  for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
    ambulo__free(&plan->allocator, lists[i]);
  }
}
