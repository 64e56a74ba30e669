/* mechanics/plan_steps.c - the joints' and the points' part in the Jacobians. */
#include <string.h>

#include "mechanics/plan_build.h"
#include "mechanics/plan_layout.h"

static int lanes(int entry) {
  return entry * AMBULO__LANES;
}

static int is_straight(const ambulo__joint *joint) {
  return !joint->revolute && joint->still;
}

int ambulo__plan_world_axis(const ambulo__joint *joint) {
  return is_straight(joint) && joint->sign > 0 && !joint->turned ? joint->axis : -1;
}

/* The slot of a frame, or of its only child if it has none. */
static int subtree_of(const ambulo__plan *plan, int frame) {
  for (int f = frame; f <= plan->coordinates; f++) {
    int at = plan->frames[f].subtree_at;
    if (f != frame && plan->joints[f - 1].parent != frame) continue;
    if (at >= 0) return at;
    frame = f;
  }
  return -1;
}

static int is_rowless(const ambulo__joint *joint) {
  return joint->torque_row == AMBULO__ROW_FOLLOWS || joint->torque_row == AMBULO__ROW_VANISHES;
}

/* How many of the first `count` joints of a list are of a kind. */
static int count_first(const ambulo__plan *plan, const int *joints, int count,
                       int (*is_of_kind)(const ambulo__joint *)) {
  int n = 0;
  while (n < count && is_of_kind(&plan->joints[joints[n]])) n++;
  return n;
}

static void emit_changes(ambulo__plan *plan) {
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__frame *frame = &plan->frames[k + 1];
    int first = plan->ancestor_start[k], count = plan->ancestor_start[k + 1] - first;
    const int *above = plan->ancestor + first;
    plan->steps.changes[k] = (ambulo__change_step){
        .motion = plan->joints[k].motion_at,
        .subtree = subtree_of(plan, k + 1),
        .first = first,
        .rowless = count_first(plan, above, count, is_rowless),
        .straight = count_first(plan, above, count, is_straight),
        .is_straight = is_straight(&plan->joints[k]),
        .is_rowless = is_rowless(&plan->joints[k]),
        .count = count,
        .lower = lanes(plan->start[k]),
        .mass = frame->subtree_mass,
    };
    for (int i = first; i < first + count; i++) {
      const ambulo__joint *joint = &plan->joints[plan->ancestor[i]];
      plan->steps.pairs[i] =
          (ambulo__pair){joint->motion_at, lanes(plan->upper[i]), ambulo__plan_world_axis(joint)};
    }
  }
}

static void emit_points(ambulo__plan *plan) {
  ambulo__steps *steps = &plan->steps;
  int placed = 0, links = 0, rows = plan->coordinates + 6;
  for (int f = 0; f <= plan->coordinates; f++) {
    ambulo__group_step group = {.first = placed, .chain = links};
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
  int ok = (s->changes = ambulo__alloc(memory, d, sizeof *s->changes)) &&
           (s->pairs = ambulo__alloc(memory, pairs, sizeof *s->pairs)) &&
           (s->groups = ambulo__alloc(memory, points, sizeof *s->groups)) &&
           (s->points = ambulo__alloc(memory, points, sizeof *s->points)) &&
           (s->chains = ambulo__alloc(memory, points * d, sizeof *s->chains));
  if (!ok) return AMBULO_E_MEMORY;
  emit_changes(plan);
  emit_points(plan);
  return AMBULO_OK;
}

void ambulo__plan_steps_free(ambulo__plan *plan) {
  const ambulo__steps *s = &plan->steps;
  void *const lists[] = {s->changes, s->pairs, s->groups, s->points, s->chains};
  for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
    ambulo__free(&plan->allocator, lists[i]);
  }
}
