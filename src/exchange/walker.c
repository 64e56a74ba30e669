/* exchange/walker.c - legs, feet and sizes of a body that is to walk, from its start pose.
 *
 * A leg is what lies between one foot and where the paths of both feet to the root meet; all before
 * that is the root. With p_j the places of a leg's joints, from the hip down, f and n forward and
 * up, and s the sole, the leg's length is
 *
 *     sum_j |(f, n) . (p_j+1 - p_j)| + n . (p_last - s)                                     m
 *
 * which bent knees do not shorten and the offsets of a hip to the side do not lengthen. Where the
 * hip is less than a third of the way along all joints above the sole, the body does not stand. */
#include "exchange/walker.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/arithmetic.h"
#include "base/diagnostics.h"

enum { MOST_LINKS = 4096 };

/* where a place on a link is in the start pose */
static void place_of(const ambulo__walker *w, int link, const double local[3], double at[3]) {
  ambulo_point_motion motion = ambulo_point_motion_default();
  double *rest = w->work;
  memset(rest, 0, (size_t)w->count * sizeof *rest);
  motion.position = at;
  if (ambulo_model_point_motion(w->model, link, local, w->pose, rest, &motion))
    at[0] = at[1] = at[2] = 0.0; /* a start pose beyond all numbers */
}

static void point_at(const ambulo__walker *w, int index, double at[3]) {
  const ambulo_point *point = ambulo_model_point(w->model, index);
  place_of(w, point->link, point->position, at);
}

static void heel_of(const ambulo__walker *w, int side, double at[3]) {
  point_at(w, ambulo_model_foot(w->model, w->foot[side])->heel_center, at);
}

double ambulo__walker_slope(const ambulo__walker *w, int foot, const double direction[3],
                            int coordinate) {
  const ambulo_foot *part = ambulo_model_foot(w->model, foot);
  const ambulo_point *heel = ambulo_model_point(w->model, part->heel_center);
  ambulo_point_motion motion = ambulo_point_motion_default();
  double at[3], *slopes = w->work + w->count, *rest = w->work, sum = 0.0;
  memset(w->work, 0, 4 * (size_t)w->count * sizeof *rest);
  motion.position = at;
  motion.position_q = slopes;
  if (ambulo_model_point_motion(w->model, heel->link, heel->position, w->pose, rest, &motion))
    return 0.0;
  for (int k = 0; k < 3; k++) sum += direction[k] * slopes[k * w->count + coordinate];
  return sum;
}

/* ------------------------------------------------------------------------ parts */

/* coordinates between the world and the parts of a foot count one more */
static void count_path(const ambulo__walker *w, int side, int *passes) {
  const ambulo_foot *foot = ambulo_model_foot(w->model, w->foot[side]);
  for (int end = 0; end < 2; end++) {
    int link = ambulo_model_point(w->model, end ? foot->toe_center : foot->heel_center)->link;
    for (; link >= 0; link = ambulo_model_link(w->model, link)->parent) {
      int c = ambulo_model_link(w->model, link)->coordinate;
      if (c >= 0) passes[c] |= 1 << side;
    }
  }
}

static void find_parts(ambulo__walker *w) {
  int *passes = (int *)w->part; /* the same size, read before it is written */
  int all = (1 << w->feet) - 1;
  for (int side = 0; side < w->feet; side++) count_path(w, side, passes);
  for (int c = 0; c < w->count; c++) {
    int one = passes[c] != 0 && (passes[c] & (passes[c] - 1)) == 0; /* of one leg alone */
    w->part[c] = passes[c] == all ? AMBULO__PART_ROOT : one ? AMBULO__PART_LEG : AMBULO__PART_REST;
  }
}

/* The length of a leg: from the foot up, joint by joint; *stands: the hip is above the sole. */
static double length_of(const ambulo__walker *w, int side, int *stands) {
  static const double origin[3] = {0, 0, 0};
  const double *forward = ambulo_model_forward(w->model), *up = ambulo_model_up(w->model);
  int link =
      ambulo_model_point(w->model, ambulo_model_foot(w->model, w->foot[side])->heel_center)->link;
  double sole[3], below[3] = {0, 0, 0}, at[3], length = 0.0, whole = 0.0;
  int joints = 0;
  heel_of(w, side, sole);
  for (; link >= 0; link = ambulo_model_link(w->model, link)->parent) {
    const ambulo_link *here = ambulo_model_link(w->model, link);
    if (here->coordinate < 0 || w->part[here->coordinate] != AMBULO__PART_LEG) continue;
    place_of(w, here->parent, origin, at);
    for (int k = 0; k < 3; k++) below[k] = at[k] - (joints ? below[k] : sole[k]);
    whole += sqrt(ambulo__dot(below, below));
    length += joints ? hypot(ambulo__dot(below, forward), ambulo__dot(below, up))
                     : fmax(ambulo__dot(below, up), 0.0);
    memcpy(below, at, sizeof below);
    joints++;
  }
  *stands &= ambulo__dot(below, up) - ambulo__dot(sole, up) > whole / 3.0;
  return length;
}

/* ----------------------------------------------------------------------- checks */

static ambulo_status refuse(ambulo_diagnostics *diagnostics, const char *hint, const char *format,
                            int value) {
  return ambulo__error(diagnostics, AMBULO_E_MODEL, ambulo__nowhere, hint, format, value);
}

/* four feet: the two in front, left and right, then the hind ones */
static void choose_four(ambulo__walker *w) {
  double along[4], aside[4];
  for (int i = 0; i < 4; i++) {
    double at[3];
    w->foot[i] = i;
    heel_of(w, i, at);
    along[i] = ambulo__dot(ambulo_model_forward(w->model), at);
    aside[i] = ambulo__dot(ambulo_model_left(w->model), at);
  }
  for (int pass = 0; pass < 3; pass++) {
    for (int i = 0; i < 3; i++) {
      int a = w->foot[i], b = w->foot[i + 1], pair = pass == 2;
      int wrong = pair ? i != 1 && aside[a] < aside[b] : along[a] < along[b];
      if (!wrong) continue;
      w->foot[i] = b;
      w->foot[i + 1] = a;
    }
  }
}

static ambulo_status choose_feet(ambulo__walker *w, ambulo_diagnostics *diagnostics) {
  int count = ambulo_model_foot_count(w->model);
  double at[2][3];
  w->feet = count == 4 ? 4 : 2;
  if (count == 4) {
    choose_four(w);
    return AMBULO_OK;
  }
  if (count != 2)
    return refuse(diagnostics,
                  "'ambulo import' takes feet by --foot left=LINK, or by --heel and --toe",
                  "a walk needs two feet or four (got %d); expected 'left' and 'right', or 'fl', "
                  "'fr', 'hl' and 'hr', under 'feet' of the model",
                  count);
  w->foot[1] = 1;
  for (int i = 0; i < 2; i++) heel_of(w, i, at[i]);
  const double *left = ambulo_model_left(w->model);
  int named = strcmp(ambulo_model_foot(w->model, 1)->name, "left") == 0 ||
              strcmp(ambulo_model_foot(w->model, 0)->name, "right") == 0;
  w->width = ambulo__dot(left, at[0]) - ambulo__dot(left, at[1]);
  if (w->width < 0.0 || (w->width == 0.0 && named)) {
    w->foot[0] = 1;
    w->foot[1] = 0;
    w->width = -w->width;
  }
  return AMBULO_OK;
}

static int legs_joints(const ambulo__walker *w) {
  int legs = 0;
  for (int c = 0; c < w->count; c++) legs += w->part[c] == AMBULO__PART_LEG;
  return legs;
}

static ambulo_status check_parts(const ambulo__walker *w, ambulo_diagnostics *diagnostics) {
  int roots = 0, legs = legs_joints(w);
  for (int c = 0; c < w->count; c++) roots += w->part[c] == AMBULO__PART_ROOT;
  if (roots == 0)
    return refuse(diagnostics, "a URDF becomes free by 'ambulo import --root free'",
                  "the body is fixed to the world (got %d coordinates before its legs); expected "
                  "sliders and hinges between the world and the body",
                  roots);
  if (legs < 2)
    return refuse(diagnostics, NULL,
                  "the legs have too few joints (got %d); expected at least one each", legs);
  return AMBULO_OK;
}

/* ---------------------------------------------------------------------- measures */

/* Of a foot, in the start pose: half of its width, m. */
static double half_width(const ambulo__walker *w, int side) {
  const ambulo_foot *foot = ambulo_model_foot(w->model, w->foot[side]);
  const double *left = ambulo_model_left(w->model);
  double a[3], b[3], most = 0.0;
  for (int end = 0; end < 2; end++) {
    const int *corner = end ? foot->toe : foot->heel;
    if (corner[1] < 0) continue;
    point_at(w, corner[0], a);
    point_at(w, corner[1], b);
    most = fmax(most, 0.5 * fabs(ambulo__dot(left, a) - ambulo__dot(left, b)));
  }
  return most;
}

static void take_pose(ambulo__walker *w) {
  for (int c = 0; c < w->count; c++) {
    const ambulo_coordinate *one = ambulo_model_coordinate(w->model, c);
    const ambulo_coordinate *other = ambulo_model_coordinate(w->model, one->mirror);
    w->pose[c] = one->default_value;
    if (w->symmetric)
      w->pose[c] = 0.5 * (one->default_value + one->mirror_sign * other->default_value);
  }
}

static void take_limits(ambulo__walker *w) {
  for (int c = 0; c < w->count; c++) {
    const ambulo_coordinate *one = ambulo_model_coordinate(w->model, c);
    if (w->part[c] == AMBULO__PART_ROOT) continue;
    for (int k = 0; k < 2; k++) {
      w->has_torque_limits |= isfinite(one->torque[k]) != 0;
      w->has_speed_limits |= isfinite(one->speed[k]) != 0;
    }
  }
}

static ambulo_status measure(ambulo__walker *w, ambulo_diagnostics *diagnostics) {
  w->symmetric = ambulo_model_check_mirror(w->model, &w->allocator, NULL) == AMBULO_OK;
  take_pose(w);
  ambulo_status status = choose_feet(w, diagnostics);
  if (status) return status;
  find_parts(w);
  status = check_parts(w, diagnostics);
  if (status) return status;
  int stands = 1;
  for (int side = 0; side < w->feet; side++) {
    double at[3];
    heel_of(w, side, at);
    w->at[side][0] = ambulo__dot(ambulo_model_forward(w->model), at);
    w->at[side][1] = ambulo__dot(ambulo_model_left(w->model), at);
    w->leg += length_of(w, side, &stands) / w->feet;
  }
  for (int left = 0; left < w->feet && w->symmetric; left += 2) {
    double *a = w->at[left], *b = w->at[left + 1];
    a[0] = b[0] = 0.5 * (a[0] + b[0]);
    a[1] = 0.5 * (a[1] - b[1]);
    b[1] = -a[1];
  }
  if (!stands || !(w->leg > 1e-3))
    return refuse(diagnostics, NULL,
                  "the body does not stand in its start pose (got legs of %d mm, along forward and "
                  "up); expected hips above feet",
                  (int)(1000.0 * w->leg));
  w->planar = ambulo_model_foot(w->model, w->foot[0])->heel[1] < 0;
  w->rocks = !w->planar && legs_joints(w) <= 8;
  w->width = fmax(w->width, half_width(w, 0) + half_width(w, 1));
  take_limits(w);
  return AMBULO_OK;
}

ambulo_status ambulo__walker_measure(const ambulo_model *model, const ambulo_allocator *allocator,
                                     ambulo_diagnostics *diagnostics, ambulo__walker *walker) {
  const double *gravity = ambulo_model_gravity(model);
  *walker = (ambulo__walker){.model = model,
                             .allocator = ambulo__allocator_or_default(allocator),
                             .count = ambulo_model_coordinate_count(model),
                             .mass = ambulo_model_mass(model),
                             .gravity = sqrt(ambulo__dot(gravity, gravity))};
  size_t count = (size_t)walker->count;
  walker->pose = ambulo__alloc(&walker->allocator, count, sizeof *walker->pose);
  walker->part = ambulo__alloc(&walker->allocator, count, sizeof *walker->part);
  walker->work = ambulo__alloc(&walker->allocator, 4 * count, sizeof *walker->work);
  if (!walker->pose || !walker->part || !walker->work)
    return ambulo__error(diagnostics, AMBULO_E_MEMORY, ambulo__nowhere, NULL, "out of memory");
  return measure(walker, diagnostics);
}

void ambulo__walker_free(ambulo__walker *walker) {
  ambulo__free(&walker->allocator, walker->pose);
  ambulo__free(&walker->allocator, walker->part);
  ambulo__free(&walker->allocator, walker->work);
  *walker = (ambulo__walker){0};
}
