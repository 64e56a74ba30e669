/* retarget/figure.c - see figure.h. */
#include "retarget/figure.h"

#include "base/arithmetic.h"

#include <math.h>
#include <string.h>

/* ----------------------------------------------------------------------- rotations */

double ambulo__heading_of(const ambulo__rigid *turn) {
  return atan2(turn->r[1][0], turn->r[0][0]);
}

/* Near a half turn the antisymmetric part vanishes; then the axis is the longest column of R + 1.
 */
void ambulo__turn_vector(const ambulo__rigid *turn, double vector[3]) {
  double v[3], trace = turn->r[0][0] + turn->r[1][1] + turn->r[2][2];
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, k = (i + 2) % 3;
    v[i] = 0.5 * (turn->r[k][j] - turn->r[j][k]);
  }
  double sine = sqrt(ambulo__dot(v, v)), angle = atan2(sine, 0.5 * (trace - 1.0));
  if (sine < 1e-9 && trace < 0.0) {
    int most = 0;
    for (int i = 1; i < 3; i++)
      if (turn->r[i][i] > turn->r[most][most]) most = i;
    for (int i = 0; i < 3; i++) v[i] = turn->r[i][most] + (i == most);
    (void)ambulo__normalize(v);
    sine = 1.0;
  }
  for (int i = 0; i < 3; i++) vector[i] = sine > 0.0 ? v[i] * (angle / sine) : 0.0;
}

ambulo__rigid ambulo__turn_of_vector(const double vector[3]) {
  double axis[3] = {vector[0], vector[1], vector[2]}, angle = sqrt(ambulo__dot(axis, axis));
  if (ambulo__normalize(axis) == 0.0) return ambulo__rigid_identity();
  return ambulo__rigid_turn(axis, angle);
}

/* the least turn from one direction to another; of opposite ones about left */
static ambulo__rigid least_turn(const double from[3], const double to[3]) {
  double axis[3], cosine = ambulo__dot(from, to);
  ambulo__cross(from, to, axis);
  double angle = atan2(sqrt(ambulo__dot(axis, axis)), cosine);
  if (ambulo__normalize(axis) == 0.0) {
    axis[0] = axis[2] = 0.0;
    axis[1] = 1.0;
  }
  return ambulo__rigid_turn(axis, angle);
}

/* ---------------------------------------------------------------------- kinematics */

static ambulo__rigid frame_of(const ambulo__figure *figure, int link) {
  const double *f = figure->pose.frames + 12 * (size_t)link;
  ambulo__rigid world = ambulo__rigid_identity();
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) world.r[i][j] = f[4 * i + j];
    world.p[i] = f[4 * i + 3];
  }
  return ambulo__rigid_times(&figure->axes, &world);
}

static void point_of(const ambulo__figure *figure, int point, double out[3]) {
  const ambulo_point *about = &figure->model->points[point];
  double world[3];
  ambulo__pose_point(&figure->pose, about->link, about->position, world);
  ambulo__rigid_vector(&figure->axes, world, out);
}

void ambulo__figure_axis(const ambulo__figure *figure, int coordinate, double point[3],
                         double direction[3]) {
  int parent = figure->model->links[figure->model->coordinate_link[coordinate]].parent;
  ambulo__rigid frame = parent < 0 ? figure->axes : frame_of(figure, parent);
  for (int i = 0; i < 3; i++) {
    point[i] = frame.p[i];
    direction[i] = frame.r[i][2];
  }
}

void ambulo__figure_at(ambulo__figure *figure, const double *q, ambulo__posture *posture) {
  ambulo__pose_at(&figure->pose, q);
  for (int s = 0; s < AMBULO__SEGMENTS; s++) {
    int link = figure->link[s];
    if (link < 0) {
      posture->turn[s] = posture->turn[ambulo__segment_above(s)];
      continue;
    }
    ambulo__rigid frame = frame_of(figure, link);
    if (s == AMBULO__PELVIS) memcpy(posture->pelvis, frame.p, sizeof frame.p);
    frame = ambulo__rigid_turned(&frame);
    posture->turn[s] = ambulo__rigid_times(&frame, &figure->neutral[s]);
  }
  for (int side = 0; side < AMBULO__SIDES; side++) {
    ambulo__rigid shank = frame_of(figure, figure->link[AMBULO__SHANK + side]);
    const ambulo__rigid *foot = &posture->turn[AMBULO__FOOT + side];
    double heel[3], toe[3];
    ambulo__rigid_point(&shank, figure->ankle[side], posture->ankle[side]);
    ambulo__rigid_vector(foot, figure->heel[side], heel);
    ambulo__rigid_vector(foot, figure->toe[side], toe);
    for (int i = 0; i < 3; i++) {
      posture->heel[side][i] = posture->ankle[side][i] + heel[i];
      posture->toe[side][i] = posture->ankle[side][i] + toe[i];
    }
  }
}

/* -------------------------------------------------------------------------- anatomy */

/* x that makes the sum of the squared distances to the last axes of a group least, and a little
 * that to their points: (sum (1 - a a') + e) x = sum (1 - a a') p + e p */
static void center_of(const ambulo__figure *figure, int segment, double center[3]) {
  enum { LAST = 3 };
  static const double little = 1e-3;
  double m[3][4] = {{0.0}};
  int count = figure->map.count[segment], first = count > LAST ? count - LAST : 0;
  for (int g = first; g < count; g++) {
    double p[3], a[3];
    ambulo__figure_axis(figure, figure->map.coordinate[segment][g], p, a);
    double along = ambulo__dot(a, p);
    for (int i = 0; i < 3; i++) {
      for (int j = 0; j < 3; j++) m[i][j] += (i == j) * (1.0 + little) - a[i] * a[j];
      m[i][3] += (1.0 + little) * p[i] - a[i] * along;
    }
  }
  for (int k = 0; k < 3; k++) { /* positive definite: no pivots */
    for (int i = k + 1; i < 3; i++)
      for (int j = 3; j >= k; j--) m[i][j] -= m[i][k] / m[k][k] * m[k][j];
  }
  for (int i = 2; i >= 0; i--) {
    center[i] = m[i][3];
    for (int j = i + 1; j < 3; j++) center[i] -= m[i][j] * center[j];
    center[i] /= m[i][i];
  }
}

/* centre of mass of all that hangs on a link */
static int mass_center(const ambulo__figure *figure, int link, double center[3]) {
  double mass = 0.0, sum[3] = {0.0};
  for (int i = link; i < figure->model->link_count; i++) {
    int above = i;
    while (above > link) above = figure->model->links[above].parent;
    if (above != link || figure->model->links[i].mass <= 0.0) continue;
    ambulo__rigid frame = frame_of(figure, i);
    double at[3];
    ambulo__rigid_point(&frame, figure->model->links[i].com, at);
    mass += figure->model->links[i].mass;
    for (int k = 0; k < 3; k++) sum[k] += figure->model->links[i].mass * at[k];
  }
  for (int k = 0; k < 3; k++) center[k] = mass > 0.0 ? sum[k] / mass : 0.0;
  return mass > 0.0;
}

static int next_of(int segment) {
  int arm = segment >= AMBULO__UPPER_ARM;
  return segment < AMBULO__THIGH || segment >= AMBULO__FOREARM || (!arm && segment >= AMBULO__FOOT)
             ? -1
             : segment + 2;
}

/* Turn A of limbs. How far a hinge of one axis is aside says nothing, so legs of bodies of hinges
 * turn in the plane of forward and up alone. */
static ambulo__rigid limb_turn(const ambulo__figure *figure, int segment,
                               double center[AMBULO__SEGMENTS][3]) {
  static const double down[3] = {0.0, 0.0, -1.0};
  double way[3], end[3];
  int next = next_of(segment), leg = segment < AMBULO__UPPER_ARM;
  if (next >= 0 && figure->map.count[next] > 0)
    memcpy(end, center[next], sizeof end);
  else if (!mass_center(figure, figure->link[segment], end))
    return ambulo__rigid_identity();
  for (int i = 0; i < 3; i++) way[i] = end[i] - center[segment][i];
  if (leg && figure->map.count[AMBULO__SHANK] == 1) way[1] = 0.0;
  return ambulo__normalize(way) > 0.0 ? least_turn(down, way) : ambulo__rigid_identity();
}

static ambulo__rigid foot_turn(const ambulo__figure *figure, int side) {
  static const double forward[3] = {1.0, 0.0, 0.0};
  double heel[3], toe[3];
  point_of(figure, figure->model->feet[figure->foot[side]].heel_center, heel);
  point_of(figure, figure->model->feet[figure->foot[side]].toe_center, toe);
  for (int i = 0; i < 3; i++) toe[i] -= heel[i];
  return ambulo__normalize(toe) > 0.0 ? least_turn(forward, toe) : ambulo__rigid_identity();
}

/* the model's foot whose heel hangs on a segment's link */
static int find_foot(const ambulo__figure *figure, int segment) {
  const ambulo_model *model = figure->model;
  for (int i = 0; i < model->foot_count; i++) {
    int link = model->points[model->feet[i].heel_center].link;
    while (link > figure->link[segment]) link = model->links[link].parent;
    if (link == figure->link[segment]) return i;
  }
  return -1;
}

static void measure_leg(ambulo__figure *figure, int side, double center[AMBULO__SEGMENTS][3]) {
  const double *hip = center[AMBULO__THIGH + side], *knee = center[AMBULO__SHANK + side],
               *ankle = center[AMBULO__FOOT + side];
  ambulo__rigid shank = frame_of(figure, figure->link[AMBULO__SHANK + side]);
  ambulo__rigid turn = foot_turn(figure, side), inside = ambulo__rigid_inverse(&shank);
  double heel[3], toe[3], thigh = 0.0, lower = 0.0;
  ambulo__rigid_point(&inside, ankle, figure->ankle[side]);
  point_of(figure, figure->model->feet[figure->foot[side]].heel_center, heel);
  point_of(figure, figure->model->feet[figure->foot[side]].toe_center, toe);
  for (int i = 0; i < 3; i++) {
    heel[i] -= ankle[i];
    toe[i] -= ankle[i];
  }
  ambulo__rigid_back(&turn, heel, figure->heel[side]);
  ambulo__rigid_back(&turn, toe, figure->toe[side]);
  for (int i = 0; i < 3; i += 2) {
    thigh += (knee[i] - hip[i]) * (knee[i] - hip[i]);
    lower += (ankle[i] - knee[i]) * (ankle[i] - knee[i]);
  }
  figure->leg += 0.5 * (sqrt(thigh) + sqrt(lower) - figure->heel[side][2]);
  figure->aside[side] = hip[1];
}

static ambulo_status measure(ambulo__figure *figure, const char *what,
                             ambulo_diagnostics *diagnostics) {
  double center[AMBULO__SEGMENTS][3];
  for (int s = 0; s < AMBULO__SEGMENTS; s++) {
    int count = figure->map.count[s];
    figure->link[s] =
        count ? figure->model->coordinate_link[figure->map.coordinate[s][count - 1]] : -1;
    if (count) center_of(figure, s, center[s]);
  }
  for (int side = 0; side < AMBULO__SIDES; side++) {
    figure->foot[side] = find_foot(figure, AMBULO__FOOT + side);
    if (figure->foot[side] < 0)
      return ambulo__error(diagnostics, AMBULO_E_MODEL, ambulo__nowhere,
                           "docs/model-format.md#feet", "%s '%s' has no foot on its %s", what,
                           figure->model->name, ambulo__segment_word(AMBULO__FOOT + side));
  }
  for (int s = 0; s < AMBULO__SEGMENTS; s++) {
    if (figure->link[s] < 0) continue;
    ambulo__rigid frame = frame_of(figure, figure->link[s]), turn = ambulo__rigid_identity();
    if (s == AMBULO__FOOT || s == AMBULO__FOOT + 1)
      turn = foot_turn(figure, s - AMBULO__FOOT);
    else if (s >= AMBULO__THIGH)
      turn = limb_turn(figure, s, center);
    frame = ambulo__rigid_turned(&frame);
    frame = ambulo__rigid_inverse(&frame);
    figure->neutral[s] = ambulo__rigid_times(&frame, &turn);
  }
  for (int side = 0; side < AMBULO__SIDES; side++) measure_leg(figure, side, center);
  return AMBULO_OK;
}

ambulo_status ambulo__figure_create(const ambulo_model *model, const ambulo__segment_map *map,
                                    const char *what, const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, ambulo__figure *figure) {
  ambulo__figure f = {.model = model, .map = *map, .axes = ambulo__rigid_identity()};
  const double *const rows[] = {model->forward, model->left, model->up};
  for (int i = 0; i < 3; i++) memcpy(f.axes.r[i], rows[i], sizeof f.axes.r[i]);
  ambulo_status status = ambulo__segments_check(model, map, what, diagnostics);
  if (!status) status = ambulo__pose_create(model, allocator, &f.pose);
  if (status) return status;
  double *zero = ambulo__alloc(&f.pose.allocator, (size_t)model->coordinate_count, sizeof *zero);
  status = zero ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) {
    ambulo__pose_at(&f.pose, zero);
    status = measure(&f, what, diagnostics);
  }
  ambulo__free(&f.pose.allocator, zero);
  if (status)
    ambulo__pose_free(&f.pose);
  else
    *figure = f;
  return status;
}

void ambulo__figure_free(ambulo__figure *figure) {
  ambulo__pose_free(&figure->pose);
}
