/* retarget/skeleton_model.c - see skeleton_model.h. */
#include "retarget/skeleton_model.h"

#include "ambulo/tools/load.h"
#include "retarget/segments.h"

#include <math.h>
#include <string.h>

/* R = Rot_x(a) Rot_y(b) Rot_z(c):  r02 = sin b,  r12 = -sin a cos b,  r01 = -cos b sin c. Where
 * cos b vanishes only a + c or a - c is known, and c is 0. */
void ambulo__joint_angles(const double r[3][3], double angles[3]) {
  double cosine = hypot(r[0][0], r[0][1]);
  angles[1] = atan2(r[0][2], cosine);
  if (cosine > 1e-9) {
    angles[0] = atan2(-r[1][2], r[2][2]);
    angles[2] = atan2(-r[0][1], r[0][0]);
  } else {
    angles[0] = atan2(r[2][1], r[1][1]);
    angles[2] = 0.0;
  }
}

int ambulo__joint_coordinate(const ambulo__skeleton_joints *joints, int joint) {
  int first = 3;
  for (int i = 0; i < joint; i++) first += joints->joint[i].is_end ? 0 : 3;
  return first;
}

static void vector(ambulo__text_buffer *text, const double v[3]) {
  ambulo__text_append(text, "[");
  for (int i = 0; i < 3; i++) {
    if (i) ambulo__text_append(text, ", ");
    ambulo__text_append_number(text, v[i]);
  }
  ambulo__text_append(text, "]");
}

static void print_link(ambulo__text_buffer *text, const char *joint, const char *suffix,
                       const char *parent, const char *parent_suffix, const char *kind,
                       const double offset[3], const char *axis) {
  ambulo__text_append_format(text,
                             "  - {name: %s%s, parent: %s%s, joint: %s, origin: {xyz: ", joint,
                             suffix, parent, parent_suffix, kind);
  vector(text, offset);
  ambulo__text_append_format(text, "}, axis: %s", axis);
}

static void print_ball(ambulo__text_buffer *text, const ambulo__skeleton_joint *joint,
                       const char *parent, const char *parent_suffix, const double offset[3]) {
  static const double here[3] = {0.0};
  print_link(text, joint->name, "_x", parent, parent_suffix, "revolute", offset, "[1, 0, 0]}\n");
  print_link(text, joint->name, "_y", joint->name, "_x", "revolute", here, "[0, 1, 0]}\n");
  print_link(text, joint->name, "_z", joint->name, "_y", "revolute", here, "[0, 0, 1]");
  ambulo__text_append(text,
                      ",\n     body: {mass: 1, com: [0, 0, 0], gyration: [0.1, 0.1, 0.1]}}\n");
}

/* the joints below one, and what is deepest and furthest ahead of them */
static void look_below(const ambulo__skeleton_joints *joints, int joint, double *deepest,
                       double *ahead) {
  double at[AMBULO__MOST_JOINTS][3];
  unsigned char below[AMBULO__MOST_JOINTS] = {0};
  memset(at[joint], 0, sizeof at[joint]);
  below[joint] = 1;
  *deepest = *ahead = 0.0;
  for (int i = joint + 1; i < joints->count; i++) {
    int parent = joints->joint[i].parent;
    if (parent < joint || !below[parent]) continue;
    below[i] = 1;
    for (int k = 0; k < 3; k++) at[i][k] = at[parent][k] + joints->joint[i].offset[k];
    *deepest = fmin(*deepest, at[i][1]);
    *ahead = fmax(*ahead, at[i][2]);
  }
}

static const char *side_word(int segment) {
  return segment % 2 ? "left" : "right";
}

/* points of a foot's sole: heels as far behind the ankle as a third of the way to the front */
static void print_points(ambulo__text_buffer *text, const ambulo__skeleton_joints *joints,
                         int joint, int segment) {
  static const double half_width = 0.03, sole = 0.015;
  double deepest, ahead;
  look_below(joints, joint, &deepest, &ahead);
  /* the ball: toes beyond it would not be flat */
  int ball = joint;
  for (int i = joints->count - 1; i > joint; i--)
    if (joints->joint[i].parent == joint) ball = i;
  double forward[3] = {0.0, deepest - sole, 0.7 * ahead};
  if (ball != joint) {
    forward[0] = joints->joint[ball].offset[0];
    forward[2] = joints->joint[ball].offset[2];
  }
  static const char *const ends[] = {"heel", "toe"};
  static const char *const corners[] = {"", "_one", "_other"};
  for (int end = 0; end < 2; end++) {
    for (int corner = 0; corner < 3; corner++) {
      double at[3] = {end ? forward[0] : -0.3 * forward[0], forward[1],
                      end ? forward[2] : -0.3 * forward[2]};
      at[0] += corner == 0 ? 0.0 : corner == 1 ? half_width : -half_width;
      ambulo__text_append_format(text,
                                 "  - {name: %s_%s%s, link: %s_z, position: ", side_word(segment),
                                 ends[end], corners[corner], joints->joint[joint].name);
      vector(text, at);
      ambulo__text_append(text, "}\n");
    }
  }
}

static void print_model(const ambulo__skeleton_joints *joints, const char *name, int foot[2],
                        ambulo__text_buffer *text) {
  static const double here[3] = {0.0};
  static const char *const slides[] = {"root_tx", "root_ty", "root_tz"}, *const axes[] = {
                                                                             "[1, 0, 0]}\n",
                                                                             "[0, 1, 0]}\n",
                                                                             "[0, 0, 1]}\n"};
  ambulo__text_append_format(text,
                             "# ambulo retarget: the skeleton of the motion; masses mean nothing\n"
                             "ambulo: 1\nkind: model\nname: %s\nunits: {angle: radians}\n"
                             "gravity: [0, -9.81, 0]\nforward: [0, 0, 1]\nlinks:\n",
                             name);
  for (int i = 0; i < 3; i++)
    print_link(text, slides[i], "", i ? slides[i - 1] : "none", "", "prismatic", here, axes[i]);
  for (int i = 0; i < joints->count; i++) {
    const ambulo__skeleton_joint *j = &joints->joint[i];
    if (j->is_end) continue;
    const char *parent = j->parent < 0 ? slides[2] : joints->joint[j->parent].name;
    print_ball(text, j, parent, j->parent < 0 ? "" : "_z", j->parent < 0 ? here : j->offset);
  }
  ambulo__text_append(text, "points:\n");
  for (int side = 0; side < 2; side++)
    if (foot[side] >= 0) print_points(text, joints, foot[side], side);
  ambulo__text_append(text, "feet:\n");
  for (int side = 0; side < 2; side++) {
    const char *word = side_word(side);
    ambulo__text_append_format(text,
                               "  - {name: %s, heel: [%s_heel_one, %s_heel_other], toe: "
                               "[%s_toe_one, %s_toe_other],\n     heel_center: %s_heel, "
                               "toe_center: %s_toe}\n",
                               word, word, word, word, word, word, word);
  }
}

ambulo_status ambulo__joints_model(const ambulo__skeleton_joints *joints, const char *name,
                                   ambulo_diagnostics *diagnostics, ambulo__given *given) {
  int foot[2] = {-1, -1};
  for (int i = joints->count - 1; i > 0; i--) {
    int segment = joints->joint[i].is_end ? -1 : ambulo__segment_of(joints->joint[i].name);
    if (segment == AMBULO__FOOT || segment == AMBULO__FOOT + 1) foot[segment - AMBULO__FOOT] = i;
  }
  if (foot[0] < 0 || foot[1] < 0)
    return ambulo__error(diagnostics, AMBULO_E_MODEL, ambulo__nowhere, NULL,
                         "the skeleton has no joint named as a %s foot or ankle",
                         side_word(foot[0] < 0 ? 0 : 1));
  print_model(joints, name, foot, &given->text);
  ambulo_status status = ambulo__text_status(&given->text);
  if (!status)
    status =
        ambulo_model_load_text(ambulo__text_data(&given->text), given->text.length, "source.yaml",
                               NULL, &given->allocator, diagnostics, &given->own);
  given->body = given->own;
  return status;
}
