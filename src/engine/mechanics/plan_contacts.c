/* mechanics/plan_contacts.c - what contacts add to a plan: who carries them, and their rows.
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
