/* exchange/mjcf_actuators.c - torque limits from MuJoCo's actuators (mjcf.h).
 *
 * An actuator with a joint pushes with gear times its force. The force is within forcerange; of a
 * motor, without one, within ctrlrange. Forces of several actuators of a joint add up, and the
 * joint's actuatorfrcrange bounds the sum.
 */
#include <math.h>
#include <string.h>

#include "exchange/mjcf.h"

/* the actuator's bounds on the joint's torque; 0: none */
static int bounds_of(ambulo__mjcf *m, const ambulo__xml_node *n, double bounds[2]) {
  double gear[6] = {1.0}, force[2];
  int motor = ambulo__xml_is(n, "motor");
  (void)ambulo__mjcf_numbers(m, n, NULL, "gear", 1, 6, gear);
  int limited = ambulo__mjcf_flag(m, n, NULL, "forcelimited", -1);
  int given = limited != 0 && ambulo__mjcf_numbers(m, n, NULL, "forcerange", 2, 2, force);
  if (!given && motor && ambulo__mjcf_flag(m, n, NULL, "ctrllimited", -1) != 0)
    given = ambulo__mjcf_numbers(m, n, NULL, "ctrlrange", 2, 2, force);
  if (!given || !(force[0] < force[1])) return 0;
  bounds[0] = gear[0] * force[gear[0] < 0.0];
  bounds[1] = gear[0] * force[gear[0] >= 0.0];
  return 1;
}

static void apply(ambulo_coordinate *c, const double bounds[2], int others) {
  for (int i = 0; i < 2; i++) {
    if (others)
      c->torque[i] += bounds[i];
    else if (!isfinite(c->torque[i]) || fabs(bounds[i]) < fabs(c->torque[i]))
      c->torque[i] = bounds[i];
  }
}

/* whether an actuator before this one has the same joint */
static int has_earlier(const ambulo__xml_node *set, const ambulo__xml_node *node,
                       const char *joint) {
  for (const ambulo__xml_node *n = set->first; n && n != node; n = n->next) {
    const char *other = ambulo__xml_attribute(n, "joint");
    if (other && strcmp(other, joint) == 0) return 1;
  }
  return 0;
}

void ambulo__mjcf_actuators(ambulo__mjcf *m) {
  int elsewhere = 0;
  for (const ambulo__xml_node *set = ambulo__xml_child(m->root, "actuator"); set;
       set = ambulo__xml_next(set, "actuator")) {
    for (const ambulo__xml_node *n = set->first; n; n = n->next) {
      const char *joint = ambulo__xml_attribute(n, "joint");
      int link = joint ? ambulo__tree_find_coordinate(m->tree, joint) : -1;
      double bounds[2];
      elsewhere += link < 0;
      if (link >= 0 && bounds_of(m, n, bounds))
        apply(&m->tree->links[link].coordinate, bounds, has_earlier(set, n, joint));
    }
  }
  if (elsewhere)
    ambulo__tree_note(m->tree, NULL,
                      "%d actuators on tendons, sites or joints of three axes are left out",
                      elsewhere);
}

int ambulo__mjcf_is_driven(const ambulo__mjcf *m, const char *joint) {
  for (const ambulo__xml_node *set = ambulo__xml_child(m->root, "actuator"); set;
       set = ambulo__xml_next(set, "actuator")) {
    if (has_earlier(set, NULL, joint)) return 1;
  }
  return 0;
}
