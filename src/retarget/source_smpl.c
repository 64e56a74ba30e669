/* retarget/source_smpl.c - poses of SMPL, SMPL-H and SMPL-X in .npz, as AMASS has them.
 *
 *   poses [frames][3 n]   turns of the joints against their parents, axis times angle
 *   trans [frames][3]     of the root, m, z up
 *   mocap_framerate       (or mocap_frame_rate), per second
 *
 * The first 22 joints are the body's in all of them; hands are left out. The skeleton is that of an
 * average adult: places of joints depend on the shape (betas), which is not read. At rest SMPL has
 * y up and faces along z; what is z up becomes y up by a turn about x.
 */
#include "retarget/source.h"

#include "exchange/npz_read.h"
#include "formats/read_file.h"
#include "model/model.h"
#include "retarget/figure.h"
#include "retarget/skeleton_model.h"

#include <math.h>
#include <string.h>

enum { JOINTS = 22 };

static const ambulo__skeleton_joint smpl[JOINTS] = {
    {"pelvis", -1, {0, 0, 0}, 0},
    {"left_hip", 0, {0.059, -0.082, -0.018}, 0},
    {"right_hip", 0, {-0.059, -0.082, -0.018}, 0},
    {"spine1", 0, {0, 0.124, -0.038}, 0},
    {"left_knee", 1, {0.043, -0.386, 0.008}, 0},
    {"right_knee", 2, {-0.043, -0.386, 0.008}, 0},
    {"spine2", 3, {0, 0.138, 0.027}, 0},
    {"left_ankle", 4, {-0.015, -0.427, -0.037}, 0},
    {"right_ankle", 5, {0.015, -0.427, -0.037}, 0},
    {"spine3", 6, {0, 0.056, 0.003}, 0},
    {"left_toe", 7, {0.041, -0.060, 0.122}, 0},
    {"right_toe", 8, {-0.041, -0.060, 0.122}, 0},
    {"neck", 9, {0, 0.212, -0.033}, 0},
    {"left_collar", 9, {0.072, 0.114, -0.019}, 0},
    {"right_collar", 9, {-0.072, 0.114, -0.019}, 0},
    {"head", 12, {0, 0.089, 0.050}, 0},
    {"left_shoulder", 13, {0.123, 0.045, -0.019}, 0},
    {"right_shoulder", 14, {-0.123, 0.045, -0.019}, 0},
    {"left_elbow", 16, {0.255, -0.016, -0.023}, 0},
    {"right_elbow", 17, {-0.255, -0.016, -0.023}, 0},
    {"left_wrist", 18, {0.266, 0.013, -0.007}, 0},
    {"right_wrist", 19, {-0.266, 0.013, -0.007}, 0},
};

typedef struct amass {
  const char *path;
  char *bytes;
  size_t length;
  ambulo__npz_array poses, trans, rate;
} amass;

static ambulo_status expect(const amass *a, int found, const char *name,
                            ambulo_diagnostics *diagnostics) {
  if (found) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_SCHEMA, (ambulo__place){.file = a->path}, NULL,
                       "no array '%s'; expected poses, trans and mocap_framerate, as AMASS has "
                       "them",
                       name);
}

static ambulo_status read_arrays(amass *a, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics) {
  int found = 0;
  static const size_t limit = (size_t)1 << 30;
  ambulo_status status =
      ambulo__read_file(a->path, limit, allocator, diagnostics, &a->bytes, &a->length);
  struct {
    const char *name, *other;
    ambulo__npz_array *array;
  } wanted[] = {{"poses", NULL, &a->poses},
                {"trans", NULL, &a->trans},
                {"mocap_framerate", "mocap_frame_rate", &a->rate}};
  for (size_t i = 0; !status && i < sizeof wanted / sizeof *wanted; i++) {
    status = ambulo__npz_read(a->bytes, a->length, wanted[i].name, a->path, allocator, diagnostics,
                              wanted[i].array, &found);
    if (!status && !found && wanted[i].other)
      status = ambulo__npz_read(a->bytes, a->length, wanted[i].other, a->path, allocator,
                                diagnostics, wanted[i].array, &found);
    if (!status) status = expect(a, found, wanted[i].name, diagnostics);
  }
  if (status) return status;
  if (a->poses.columns < 3 * JOINTS || a->trans.columns != 3 || a->trans.rows != a->poses.rows ||
      a->poses.rows > (size_t)1 << 24 || !(a->rate.values[0] > 0.0))
    return ambulo__error(diagnostics, AMBULO_E_SCHEMA, (ambulo__place){.file = a->path}, NULL,
                         "poses are %zu x %zu, trans %zu x %zu; expected n x 66 or more, and n x 3",
                         a->poses.rows, a->poses.columns, a->trans.rows, a->trans.columns);
  return AMBULO_OK;
}

static void take_frame(const amass *a, const ambulo__skeleton_joints *joints, size_t frame,
                       double *q) {
  static const double axis[3] = {1.0, 0.0, 0.0};
  const double *pose = a->poses.values + frame * a->poses.columns;
  const double *trans = a->trans.values + 3 * frame;
  ambulo__rigid upright = ambulo__rigid_turn(axis, -0.5 * acos(-1.0));
  ambulo__rigid_vector(&upright, trans, q);
  for (int j = 0; j < JOINTS; j++) {
    ambulo__rigid turn = ambulo__turn_of_vector(pose + 3 * j);
    if (j == 0) turn = ambulo__rigid_times(&upright, &turn);
    ambulo__joint_angles((const double(*)[3])turn.r, q + ambulo__joint_coordinate(joints, j));
  }
}

ambulo_status ambulo__given_smpl(const char *path, ambulo_diagnostics *diagnostics,
                                 ambulo__given *given) {
  amass a = {.path = path};
  ambulo__skeleton_joints *joints = ambulo__alloc(&given->allocator, 1, sizeof *joints);
  ambulo_status status = joints ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) {
    memcpy(joints->joint, smpl, sizeof smpl);
    joints->count = JOINTS;
    status = read_arrays(&a, &given->allocator, diagnostics);
  }
  if (!status) status = ambulo__joints_model(joints, "smpl", diagnostics, given);
  if (!status) status = ambulo__given_rows(given, (int)a.poses.rows);
  for (size_t k = 0; !status && k < a.poses.rows; k++) {
    given->time[k] = (double)k / a.rate.values[0];
    take_frame(&a, joints, k, given->q + k * (size_t)given->body->coordinate_count);
  }
  ambulo__free(&given->allocator, joints);
  ambulo__free(&given->allocator, a.bytes);
  ambulo__free(&given->allocator, a.poses.values);
  ambulo__free(&given->allocator, a.trans.values);
  ambulo__free(&given->allocator, a.rate.values);
  return status;
}
