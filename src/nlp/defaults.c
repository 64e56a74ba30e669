/* nlp/defaults.c - what parts of a problem definition are before a caller says otherwise. Those
 * with numbers of their own have them in ambulo_problem_definition_default() (nlp/problem.c). */
#include "ambulo/problem.h"

#include <math.h>

enum { NOT_GIVEN = -1, NONE = -1 };

ambulo_contact ambulo_contact_default(void) {
  return (ambulo_contact){.foot = NONE, .mode = AMBULO_CONTACT_FLAT, .patch = NONE};
}

/* phases of people at a comfortable speed, as docs/guide-gait.md has them */
ambulo_gait ambulo_gait_default(void) {
  return (ambulo_gait){.steps = 1, .foot_flat = 0.08, .heel_off = 0.38, .toe_off = 0.62};
}

ambulo_end_value ambulo_end_value_default(void) {
  return (ambulo_end_value){.coordinate = NOT_GIVEN};
}

ambulo_tube ambulo_tube_default(void) {
  return (ambulo_tube){.samples = 0};
}

ambulo_user_row ambulo_user_row_default(void) {
  return (ambulo_user_row){.relation = AMBULO_NOT_NEGATIVE, .to = (double)INFINITY};
}

ambulo_ground_reaction ambulo_ground_reaction_default(void) {
  return ambulo_problem_definition_default().ground_reaction;
}

ambulo_clearance ambulo_clearance_default(void) {
  return ambulo_problem_definition_default().clearance;
}

ambulo_collision ambulo_collision_default(void) {
  return ambulo_problem_definition_default().collision;
}

ambulo_obstacle ambulo_obstacle_default(void) {
  return (ambulo_obstacle){.shape = AMBULO_OBSTACLE_BOX};
}

ambulo_reach ambulo_reach_default(void) {
  return (ambulo_reach){.point = NOT_GIVEN, .about = NONE, .to = (double)INFINITY};
}
