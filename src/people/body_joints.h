/* people/body_joints.h - which coordinate of a body is which joint of a person.
 *
 * Curves of people, and the shipped models, call joints hip_flexion_r, knee_angle_l, pelvis_tilt;
 * flexion, adduction, inward rotation and dorsiflexion are positive, of the pelvis a tilt backward,
 * a list that lowers the right side, a rotation that brings it forward. Other models and files call
 * them otherwise (knee_flexion_r, RKnee_rz), and count some of them the other way round. The
 * direction is read off the joint's axis in the neutral pose (body_joints.c). */
#ifndef AMBULO_PEOPLE_BODY_JOINTS_H
#define AMBULO_PEOPLE_BODY_JOINTS_H

#include "ambulo/model.h"

enum { AMBULO__BODY_JOINTS = 19, AMBULO__JOINT_NAME = 48 };

typedef struct ambulo__body_joint {
  char name[AMBULO__JOINT_NAME]; /* that of people */
  int coordinate;                /* -1: the body has no such joint */
  int sign;                      /* 1, or -1: it counts the other way round */
} ambulo__body_joint;

void ambulo__body_joints(const ambulo_model *model, ambulo__body_joint joints[AMBULO__BODY_JOINTS]);

/* The name of people of joint `index`, and another one by which files call it, from 0 on: 0 when
 * there are no more. */
void ambulo__joint_name(int index, char name[AMBULO__JOINT_NAME]);
int ambulo__joint_alias(int index, int alias, char name[AMBULO__JOINT_NAME]);

#endif
