/* people/body_joints.c - names and directions of joints (body_joints.h).
 *
 * A joint turns what it carries about its axis a, a place p from it by a x p. With f forward, l
 * left and u = f x l up, what is below the hip (p = -u) goes forward for a = -l, what is below the
 * knee goes backward for a = l, toes (p = f) rise for a = -l. To the left go the right leg for a =
 * f, its toes for a = u; the left leg mirrors that. The pelvis leans back (p = u) for a = -l,
 * lowers its right (p = -l) for a = f, and brings it forward for a = u; the trunk leans back for a
 * = -l and to the right for a = f. */
#include "people/body_joints.h"

#include "model/neutral_pose.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

typedef enum direction { ABOUT_LEFT, ABOUT_FORWARD, ABOUT_UP } direction;

enum { MOST_STEMS = 7, SIDES = 2, SHAPES = 4 };

/* a joint of each side, or one of the middle */
typedef struct joint_kind {
  const char *stems[MOST_STEMS]; /* the first is that of people */
  direction about;
  int sign;    /* along it on the right */
  int mirrors; /* 1: on the left the other way round */
  int middle;
} joint_kind;

static const joint_kind kinds[] = {
    {{"hip_flexion", "hip_flex", "hip_rz", "hip"}, ABOUT_LEFT, -1, 0, 0},
    {{"hip_adduction", "hip_add"}, ABOUT_FORWARD, 1, 1, 0},
    {{"hip_rotation", "hip_rot"}, ABOUT_UP, 1, 1, 0},
    {{"knee_angle", "knee_flexion", "knee_flex", "knee_rz", "knee"}, ABOUT_LEFT, 1, 0, 0},
    {{"ankle_angle", "ankle_flexion", "ankle_flex", "ankle_dorsiflexion", "ankle_plantarflexion",
      "ankle_rz", "ankle"},
     ABOUT_LEFT,
     -1,
     0,
     0},
    {{"subtalar_angle", "subtalar"}, ABOUT_FORWARD, 1, 1, 0},
    {{"mtp_angle", "mtp"}, ABOUT_LEFT, -1, 0, 0},
    {{"pelvis_tilt"}, ABOUT_LEFT, -1, 0, 1},
    {{"pelvis_list"}, ABOUT_FORWARD, 1, 0, 1},
    {{"pelvis_rotation", "pelvis_rot"}, ABOUT_UP, 1, 0, 1},
    {{"lumbar_extension", "lumbar_ext"}, ABOUT_LEFT, -1, 0, 1},
    {{"lumbar_bending", "lumbar_latbend"}, ABOUT_FORWARD, 1, 0, 1},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

/* the kind of joint `index`, and its side: 0 left, 1 right, -1 of the middle */
static const joint_kind *kind_of(int index, int *side) {
  for (int k = 0; k < KINDS; k++) {
    int count = kinds[k].middle ? 1 : SIDES;
    *side = kinds[k].middle ? -1 : index;
    if (index < count) return &kinds[k];
    index -= count;
  }
  return NULL;
}

static const char letter[] = "lr";
static const char *const word[] = {"left", "right"};

void ambulo__joint_name(int index, char name[AMBULO__JOINT_NAME]) {
  int side;
  const joint_kind *kind = kind_of(index, &side);
  if (side < 0)
    (void)snprintf(name, AMBULO__JOINT_NAME, "%s", kind->stems[0]);
  else
    (void)snprintf(name, AMBULO__JOINT_NAME, "%s_%c", kind->stems[0], letter[side]);
}

/* each stem as knee_r, knee_right, right_knee, Rknee; letters of either case are the same */
int ambulo__joint_alias(int index, int alias, char name[AMBULO__JOINT_NAME]) {
  int side;
  const joint_kind *kind = kind_of(index, &side);
  int shapes = side < 0 ? 1 : SHAPES, at = alias / shapes;
  if (at >= MOST_STEMS || !kind->stems[at]) return 0;
  const char *stem = kind->stems[at];
  if (side < 0) {
    (void)snprintf(name, AMBULO__JOINT_NAME, "%s", stem);
    return 1;
  }
  switch (alias % SHAPES) {
  case 0:
    (void)snprintf(name, AMBULO__JOINT_NAME, "%s_%c", stem, letter[side]);
    break;
  case 1:
    (void)snprintf(name, AMBULO__JOINT_NAME, "%s_%s", stem, word[side]);
    break;
  case 2:
    (void)snprintf(name, AMBULO__JOINT_NAME, "%s_%s", word[side], stem);
    break;
  default:
    (void)snprintf(name, AMBULO__JOINT_NAME, "%c%s", toupper((unsigned char)letter[side]), stem);
  }
  return 1;
}

static int find_coordinate(const ambulo_model *model, int index) {
  char name[AMBULO__JOINT_NAME];
  for (int alias = 0; ambulo__joint_alias(index, alias, name); alias++) {
    for (int i = 0; i < ambulo_model_coordinate_count(model); i++) {
      const ambulo_coordinate *c = ambulo_model_coordinate(model, i);
      if (c->type == AMBULO_REVOLUTE && strcasecmp(c->name, name) == 0) return i;
    }
  }
  return -1;
}

static int sign_of(const ambulo_model *model, const joint_kind *kind, int side, int coordinate) {
  const double *directions[] = {ambulo_model_left(model), ambulo_model_forward(model),
                                ambulo_model_up(model)};
  const double *d = directions[kind->about];
  double axis[3];
  ambulo__neutral_axis(model, coordinate, axis);
  double along = axis[0] * d[0] + axis[1] * d[1] + axis[2] * d[2];
  int expected = side == 0 && kind->mirrors ? -kind->sign : kind->sign;
  if (fabs(along) < 0.5) return 1; /* it turns about something else */
  return along * expected > 0.0 ? 1 : -1;
}

void ambulo__body_joints(const ambulo_model *model,
                         ambulo__body_joint joints[AMBULO__BODY_JOINTS]) {
  for (int i = 0; i < AMBULO__BODY_JOINTS; i++) {
    int side;
    const joint_kind *kind = kind_of(i, &side);
    ambulo__body_joint *joint = &joints[i];
    ambulo__joint_name(i, joint->name);
    joint->coordinate = find_coordinate(model, i);
    joint->sign = joint->coordinate < 0 ? 1 : sign_of(model, kind, side, joint->coordinate);
  }
}
