/* mechanics/plan_steps.c - writing the lists of steps.
 *
 * Lists that lead down the tree follow plan->order, parents first; lists that
 * lead up run the other way. A step is independent of its neighbours wherever
 * the tree allows it.
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
  int zero_at = plan->frames[0].rate_at;
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
      .virtual_from = parent->virtual_at,
      .virtual_to = frame->virtual_at,
      .moment = frame->moment_at,
      .adjoint = frame->adjoint_at,
      .correction_from = joint->has_offset ? joint->correction_at : zero_at,
      .correction = joint->correction_at,
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
      .spin = parent->spin_at,
      .rate = parent->rate_at,
      .virtual_from = parent->virtual_at,
      .slide_from = parent->slide_at,
      .slide_to = frame->slide_at,
      .load = frame->load_at,
      .adjoint = frame->adjoint_at,
      .adjoint_above = parent->adjoint_at,
      .spin_adjoint = parent->spin_adjoint_at,
      .correction = joint->correction_at,
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

/* What belongs to frames: Omega, bodies, and what starts at zero. */
static void emit_frames(ambulo__plan *plan) {
  ambulo__steps *steps = &plan->steps;
  if (plan->frames[0].own_spin) {
    steps->zero_spins[steps->zero_spin_count++] = plan->frames[0].spin_adjoint_at;
  }
  for (int i = 0; i < plan->coordinates; i++) {
    const ambulo__frame *frame = &plan->frames[plan->order[i] + 1];
    if (frame->own_spin) {
      steps->spins[steps->spin_count++] = (ambulo__spin_step){
          frame->rate_at, frame->spin_at, frame->spin_adjoint_at, frame->adjoint_at};
    }
    if (frame->own_spin && frame->body < 0) {
      steps->zero_spins[steps->zero_spin_count++] = frame->spin_adjoint_at;
    }
    if (frame->zero_load) {
      steps->zero_loads[steps->zero_load_count++] = frame->load_at;
      steps->zero_composites[steps->zero_composite_count++] = frame->composite_at;
    }
    if (frame->zero_adjoint) {
      steps->zero_adjoints[steps->zero_adjoint_count++] = frame->adjoint_at;
    }
  }
  for (int i = 0; i < plan->bodies; i++) {
    ambulo__body *body = &plan->body[i];
    const ambulo__frame *frame = &plan->frames[body->frame];
    copy_columns(body->columns, frame->column_at);
    for (int k = 0; k < 3; k++) body->ordered[k] = frame->column_at[body->order[k]];
    body->place = frame->place_at;
    body->rate = frame->rate_at;
    body->spin = frame->spin_at;
    body->load = frame->load_at;
    body->turn = frame->virtual_at;
    body->slide = frame->slide_at;
    body->adjoint = frame->adjoint_at;
    body->spin_adjoint = frame->spin_adjoint_at;
    body->adds_spin = !frame->own_spin;
    body->velocity = frame->velocity_at;
    body->composite = frame->composite_at;
  }
}

/* Sums over subtrees, up the tree, and what is read from them at the joints. */
static void emit_sums(ambulo__plan *plan) {
  ambulo__steps *steps = &plan->steps;
  int zero_at = plan->frames[0].rate_at;
  for (int k = plan->coordinates - 1, n = 0; k >= 0; k--, n++) {
    const ambulo__joint *joint = &plan->joints[k];
    const ambulo__frame *frame = &plan->frames[k + 1], *parent = &plan->frames[joint->parent];
    int shares = joint->parent != 0 && !joint->own_adjoint;
    if (joint->own_load) {
      steps->loads[steps->load_count++] = (ambulo__add_step){frame->load_at, parent->load_at, 0};
    }
    if (joint->own_load && joint->parent != 0) {
      steps->composites[steps->composite_count++] =
          (ambulo__add_step){frame->composite_at, parent->composite_at, 0};
    }
    if (joint->own_adjoint) {
      steps->adjoints[steps->adjoint_count++] =
          (ambulo__add_step){frame->adjoint_at, parent->adjoint_at, 0};
    }
    if (joint->new_moment) {
      steps->moments[steps->moment_count++] =
          (ambulo__moment_step){frame->place_at, frame->load_at, frame->moment_at};
    }
    steps->pushes[n] = (ambulo__push_step){
        joint->axis_at, joint->revolute ? frame->moment_at : frame->load_at + lanes(3), lanes(k),
        joint->sign};
    steps->turnings[n] = (ambulo__turning_step){
        .axis = joint->axis_at,
        .rho = frame->adjoint_at,
        .correction = joint->correction_at,
        .add = joint->own_adjoint ? parent->adjoint_at : zero_at,
        .to = shares || joint->own_adjoint ? parent->adjoint_at : plan->nowhere_at,
        .output = joint->revolute ? lanes(k) : -1,
        .sign = joint->sign,
    };
  }
}

static void mark_carried(ambulo__add_step *steps, int count) {
  for (int i = 1; i < count; i++) steps[i].carried = steps[i].from == steps[i - 1].to;
}

/* Chains in order of coordinates run along one limb after the other: what a
 * step needs is mostly what the step before has written. */
static void emit_chains(ambulo__plan *plan) {
  ambulo__steps *steps = &plan->steps;
  mark_carried(steps->loads, steps->load_count);
  mark_carried(steps->composites, steps->composite_count);
  mark_carried(steps->adjoints, steps->adjoint_count);
  for (int i = 1; i < plan->coordinates; i++) {
    steps->turnings[i].carried = steps->turnings[i].rho == steps->turnings[i - 1].to;
  }
  for (int k = 0, n = 0, before = -1; k < plan->coordinates; k++) {
    const ambulo__joint *joint = &plan->joints[k];
    int from = plan->frames[joint->parent].virtual_at, to = plan->frames[k + 1].virtual_at;
    if (!joint->revolute) continue;
    steps->virtuals[n++] =
        (ambulo__virtual_step){joint->axis_at, lanes(k), from, to, from == before, joint->sign};
    before = to;
  }
}

static void emit_changes(ambulo__plan *plan) {
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__frame *frame = &plan->frames[k + 1];
    int first = plan->ancestor_start[k], fixed = 0, count = plan->ancestor_start[k + 1] - first;
    for (; fixed < count; fixed++) {
      const ambulo__joint *above = &plan->joints[plan->ancestor[first + fixed]];
      if (above->revolute || !above->still) break;
    }
    plan->steps.changes[k] = (ambulo__change_step){
        .composite = frame->composite_at,
        .motion = plan->joints[k].motion_at,
        .load = frame->load_at,
        .column = lanes(k),
        .first = first,
        .fixed = fixed,
        .count = count,
        .lower = lanes(plan->start[k]),
        .mass = frame->subtree_mass,
    };
    for (int i = first; i < first + count; i++) {
      plan->steps.pairs[i].motion = plan->joints[plan->ancestor[i]].motion_at;
      plan->steps.pairs[i].upper = lanes(plan->upper[i]);
    }
  }
}

static void emit_points(ambulo__plan *plan) {
  ambulo__steps *steps = &plan->steps;
  int placed = 0, links = 0, rows = plan->coordinates + 6;
  for (int f = 0; f <= plan->coordinates; f++) {
    const ambulo__frame *frame = &plan->frames[f];
    ambulo__group_step group = {.place = frame->place_at, .first = placed, .chain = links};
    group.adjoint = f > 0 ? frame->adjoint_at : -1;
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
           (s->virtuals = ambulo__alloc(memory, d, sizeof *s->virtuals)) &&
           (s->origins = ambulo__alloc(memory, d, sizeof *s->origins)) &&
           (s->spins = ambulo__alloc(memory, d, sizeof *s->spins)) &&
           (s->moments = ambulo__alloc(memory, d, sizeof *s->moments)) &&
           (s->pushes = ambulo__alloc(memory, d, sizeof *s->pushes)) &&
           (s->turnings = ambulo__alloc(memory, d, sizeof *s->turnings)) &&
           (s->loads = ambulo__alloc(memory, d, sizeof *s->loads)) &&
           (s->composites = ambulo__alloc(memory, d, sizeof *s->composites)) &&
           (s->adjoints = ambulo__alloc(memory, d, sizeof *s->adjoints)) &&
           (s->zero_loads = ambulo__alloc(memory, d, sizeof *s->zero_loads)) &&
           (s->zero_composites = ambulo__alloc(memory, d, sizeof *s->zero_composites)) &&
           (s->zero_adjoints = ambulo__alloc(memory, d, sizeof *s->zero_adjoints)) &&
           (s->zero_spins = ambulo__alloc(memory, d, sizeof *s->zero_spins)) &&
           (s->changes = ambulo__alloc(memory, d, sizeof *s->changes)) &&
           (s->pairs = ambulo__alloc(memory, pairs, sizeof *s->pairs)) &&
           (s->groups = ambulo__alloc(memory, points, sizeof *s->groups)) &&
           (s->points = ambulo__alloc(memory, points, sizeof *s->points)) &&
           (s->chains = ambulo__alloc(memory, points * d, sizeof *s->chains));
  if (!ok) return AMBULO_E_MEMORY;
  emit_joints(plan);
  emit_frames(plan);
  emit_sums(plan);
  emit_chains(plan);
  emit_changes(plan);
  emit_points(plan);
  return AMBULO_OK;
}

void ambulo__plan_steps_free(ambulo__plan *plan) {
  const ambulo__steps *s = &plan->steps;
  void *const lists[] = {s->angles,          s->turns,         s->hinges,     s->origins,
                         s->spins,           s->moments,       s->pushes,     s->turnings,
                         s->loads,           s->composites,    s->adjoints,   s->zero_loads,
                         s->zero_composites, s->zero_adjoints, s->zero_spins, s->changes,
                         s->virtuals,        s->pairs,         s->groups,     s->points,
                         s->chains};
  for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
    ambulo__free(&plan->allocator, lists[i]);
  }
}
