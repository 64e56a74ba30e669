/* model/defaults.c - what parts of a model definition are before a caller says otherwise. */
#include "ambulo/model.h"

enum { NOT_GIVEN = -1, ITSELF = -1, NONE = -1 };

ambulo_point ambulo_point_default(void) {
  return (ambulo_point){.link = NOT_GIVEN};
}

ambulo_foot ambulo_foot_default(void) {
  return (ambulo_foot){.heel = {NOT_GIVEN, NONE},
                       .toe = {NOT_GIVEN, NONE},
                       .heel_center = NOT_GIVEN,
                       .toe_center = NOT_GIVEN,
                       .mirror = ITSELF,
                       .tip = NONE,
                       .arc = {NONE, NONE}};
}

ambulo_patch ambulo_patch_default(void) {
  return (ambulo_patch){.point = NOT_GIVEN, .mirror = ITSELF};
}

ambulo_capsule ambulo_capsule_default(void) {
  return (ambulo_capsule){.link = NOT_GIVEN, .mirror = ITSELF};
}

ambulo_subject ambulo_subject_default(void) {
  return (ambulo_subject){.sex = AMBULO_SEX_FILE};
}
