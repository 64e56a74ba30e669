/* mechanics/plan_steps.c - what joints, points and contacts do in the Jacobians, and where it
 * stands in the scratch. */
#include "mechanics/plan_layout.h"

#include <stddef.h>
#include <string.h>

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

/* where everything that the Jacobians keep stands in the scratch, and the
 * ground's wrenches, which they and the reverse sweep read in one place.
 *
 * The kernels in the frames' own axes have slots of their own, behind this (plan_local.c).
 */

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

/* what contacts add to a plan: who carries them, and their rows.
 *
 * A joint carries a contact if the frame that this acts on is the joint's own or below it. Its
 * torque then depends on the contact's wrench, which depends on the motion of the whole body. If a
 * joint carries all contacts and every body, and nothing is fixed to the world, its load and the
 * contacts' wrenches cancel, and tau vanishes identically.
 *
 * A contact's wrench (kernel_contacts.h) changes with the root wrench (M, F), by its rows, and with
 * the centre of mass r_G, which q_j moves as qdd_j accelerates it: dr_G/dq = (dF/dqdd) / m. Every
 * row of a contact, and the contacts' part in a row of tau above one, is therefore a sum of six
 * factors on (dM, dF) and three on dF by qdd over m (kernel_jacobian_contacts.h). Behind the
 * entries of jq stand those of the joints, then, contact by contact, those of its six rows.
 */

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

/* Which joints carry which contact, and their rows. */
ambulo_status ambulo__plan_carriers(ambulo__plan *plan, const ambulo__footing *footing,
                                    const ambulo__placing *placings) {
  const int all = (1 << footing->count) - 1;
  plan->contacts = footing->count;
  plan->moment_arm = footing->moment_arm;
  plan->slant = footing->slant;
  for (int c = 0; c < plan->contacts; c++)
    plan->contact_frame[c] = placings[footing->link[c]].frame;
  plan->roots = ambulo__alloc(&plan->allocator, (size_t)plan->coordinates, sizeof *plan->roots);
  if (!plan->roots) return AMBULO_E_MEMORY;
  for (int k = 0; k < plan->coordinates; k++) {
    ambulo__joint *joint = &plan->joints[k];
    for (int c = 0; c < plan->contacts; c++)
      joint->contacts |= carries(plan, k, plan->contact_frame[c]) << c;
    joint->torque_row = joint->contacts == 0 ? AMBULO__ROW_SPARSE : AMBULO__ROW_REACTS;
    if (joint->contacts != all || !carries_everything(plan, k)) continue;
    joint->torque_row = AMBULO__ROW_VANISHES;
    plan->roots[plan->vanishing++] = k * AMBULO__LANES;
  }
  return AMBULO_OK;
}

void ambulo__plan_contact_factors(ambulo__plan *plan) {
  for (int k = 0; k < plan->coordinates; k++) {
    if (plan->joints[k].torque_row != AMBULO__ROW_REACTS) continue;
    plan->joints[k].factors = plan->count;
    plan->count += AMBULO__CONTACT_FACTORS;
  }
  plan->contact_factors = plan->count;
  plan->count += plan->contacts * 6 * AMBULO__CONTACT_FACTORS;
}

/* The six parts by the root wrench and the three by the centre of mass. */
static int add_factors(const ambulo__plan *plan, int times, ambulo__row_part *part) {
  int wrench = plan->coordinates, force = wrench + 3;
  for (int k = 0; k < 6; k++) part[k] = (ambulo__row_part){wrench + k, 0, times + k, 1};
  for (int k = 0; k < 3; k++)
    part[6 + k] = (ambulo__row_part){force + k, 1, times + 6 + k, 1 / plan->mass};
  return AMBULO__CONTACT_FACTORS;
}

/* (W'.J) which factors a row of the Jacobian has */
int ambulo__plan_contact_parts(const ambulo__plan *plan, int row, ambulo__row_part *part) {
  int of = row - ambulo__plan_first_contact_row(plan), center = of - 6 * plan->contacts;
  if (center >= 0) {
    part[0] = (ambulo__row_part){plan->coordinates + 3 + center, 1, -1, 1 / plan->mass};
    return 1;
  }
  if (of >= 0) return add_factors(plan, plan->contact_factors + of * AMBULO__CONTACT_FACTORS, part);
  part[0] = (ambulo__row_part){row, 0, -1, 1};
  if (row >= plan->coordinates || plan->joints[row].torque_row != AMBULO__ROW_REACTS) return 1;
  return 1 + add_factors(plan, plan->joints[row].factors, part + 1);
}

int ambulo__plan_contact_entries(const ambulo__plan *plan) {
  return (contacts_first + plan->contacts * contact_slot) / AMBULO__LANES;
}

/* the sizes of a plan. */

int ambulo__plan_coordinates(const ambulo__plan *plan) {
  return plan->coordinates;
}

int ambulo__plan_points(const ambulo__plan *plan) {
  return plan->points;
}

int ambulo__plan_contacts(const ambulo__plan *plan) {
  return plan->contacts;
}

int ambulo__plan_ground_entries(const ambulo__plan *plan) {
  return plan->contacts > 0 ? 3 + 4 * plan->contacts : 0;
}
