/* mechanics/plan_contacts.c - the rows that contacts add to a plan, and what the kernels keep.
 *
 * A contact's wrench (kernel_contacts.h) changes with the root wrench (M, F), by its rows, and with
 * the centre of mass r_G, which q_j moves as qdd_j accelerates it: dr_G/dq = (dF/dqdd) / m. Every
 * row of a contact, and the contacts' part in a row of tau above one, is therefore a sum of six
 * factors on (dM, dF) and three on dF by qdd over m (kernel_jacobian_contacts.h). Behind the
 * entries of jq stand those of the joints, then, contact by contact, those of its six rows.
 */
#include "mechanics/plan_build.h"

void ambulo__plan_contact_factors(ambulo__plan *plan) {
  for (int k = 0; k < plan->coordinates; k++) {
    if (plan->joints[k].torque_row != AMBULO__ROW_REACTS) continue;
    plan->joints[k].factors = plan->count;
    plan->count += AMBULO__CONTACT_FACTORS;
  }
  plan->foot_factors = plan->count;
  plan->count += plan->contacts * 6 * AMBULO__CONTACT_FACTORS;
}

/* The three parts by the centre of mass; without factors, one for component k. */
static int add_center(const ambulo__plan *plan, int times, ambulo__row_part *part) {
  for (int k = 0; k < 3; k++) {
    part[k] = (ambulo__row_part){plan->coordinates + 3 + k, 1, times + k, 1 / plan->mass};
  }
  return 3;
}

static int add_factors(const ambulo__plan *plan, int times, ambulo__row_part *part) {
  int count = ambulo__plan_add_wrench(plan, times, part);
  return count + add_center(plan, times + 6, part + count);
}

/* (W'.J) which factors a row of the Jacobian has */
int ambulo__plan_contact_parts(const ambulo__plan *plan, int row, ambulo__row_part *part) {
  int of = row - ambulo__plan_first_foot_row(plan), center = of - 6 * plan->contacts;
  if (center >= 0) {
    part[0] = (ambulo__row_part){plan->coordinates + 3 + center, 1, -1, 1 / plan->mass};
    return 1;
  }
  if (of >= 0) return add_factors(plan, plan->foot_factors + of * AMBULO__CONTACT_FACTORS, part);
  part[0] = (ambulo__row_part){row, 0, -1, 1};
  if (row >= plan->coordinates || plan->joints[row].torque_row != AMBULO__ROW_REACTS) return 1;
  return 1 + add_factors(plan, plan->joints[row].factors, part + 1);
}

int ambulo__plan_contact_entries(const ambulo__plan *plan) {
  return (contacts_first + plan->contacts * contact_slot) / AMBULO__LANES;
}
