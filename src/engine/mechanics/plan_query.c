/* mechanics/plan_query.c - the sizes of a plan. */
#include "mechanics/plan_layout.h"

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

int ambulo__plan_vanishes(const ambulo__plan *plan, int coordinate) {
  return plan->joints[coordinate].torque_row == AMBULO__ROW_VANISHES;
}

size_t ambulo__plan_take_wrench(ambulo__plan *plan) {
  plan->taken_at = plan->scratch;
  plan->scratch += (size_t)12 * AMBULO__LANES;
  return plan->taken_at;
}

size_t ambulo__plan_scratch(const ambulo__plan *plan) {
  return plan->scratch;
}
