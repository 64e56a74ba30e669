/* model/placement.c - any placement and any joint axis as DH rows (placement.h).
 *
 * An axis is the z axis of a frame A that is turned twice,
 *
 *     A = Rot_z(phi) Rot_x(beta),   A e_z = (sin phi sin beta, -cos phi sin beta, cos beta) = axis
 *
 * and a turn about it a turn about z between A and its inverse. With the rotation R A taken apart
 * in the same way, R A = Rot_z(t1) Rot_x(a1) Rot_z(t2), and Rot_z(t2) commuting with the joint,
 *
 *     T(q) = Trans(xyz) R A Rot_z(q) A'
 *          = [Rot_z(p) Trans_z(z) Trans_x(r)]       p = atan2(y, x), r = |(x, y)|
 *            [Rot_z(t1 - p) Rot_x(a1)]
 *            [Rot_z(t2 + q) Rot_x(-beta)]           the joint; a slider: Rot_z(t2) Trans_z(q) ...
 *            [Rot_z(-phi)]
 *
 * row by row. Rows that do nothing are left out. The two angles of a direction along z are 0 and
 * 0 or 180 degrees: within `straight` of z it counts as along it, for phi would be noise.
 */
#include "model/placement.h"

#include <math.h>
#include <string.h>

static const double straight = 1e-14; /* sine of an angle; rounding of a product of rotations */
static const double snap = 1e-15;     /* cos(pi/2) is 6e-17 */

static double snapped(double x) {
  if (fabs(x) < snap) return 0.0;
  return fabs(fabs(x) - 1.0) < snap ? copysign(1.0, x) : x;
}

/* r <- r times a rotation by angle that mixes columns u and v */
static void rotate_columns(double r[3][3], int u, int v, double angle) {
  double c = snapped(cos(angle)), s = snapped(sin(angle));
  for (int i = 0; i < 3; i++) {
    double x = r[i][u], y = r[i][v];
    r[i][u] = c * x + s * y;
    r[i][v] = c * y - s * x;
  }
}

static void set_identity(double r[3][3]) {
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) r[i][k] = i == k;
}

void ambulo__rotation_of_rpy(const double rpy[3], double rotation[3][3]) {
  set_identity(rotation);
  rotate_columns(rotation, 0, 1, rpy[2]);
  rotate_columns(rotation, 2, 0, rpy[1]);
  rotate_columns(rotation, 1, 2, rpy[0]);
}

/* R = Rot_z(y) Rot_y(p) Rot_x(r): the first column gives y and p; what Rot_z(-y) leaves of the
 * second, r, whatever the noise in y is where cos p = 0 */
void ambulo__rpy_of_rotation(const double r[3][3], double rpy[3]) {
  double flat = hypot(r[0][0], r[1][0]);
  double yaw = flat < straight ? atan2(-r[0][1], r[1][1]) : atan2(r[1][0], r[0][0]);
  double c = cos(yaw), s = sin(yaw);
  rpy[2] = yaw;
  rpy[1] = atan2(-r[2][0], c * r[0][0] + s * r[1][0]);
  rpy[0] = flat < straight ? 0.0 : atan2(s * r[0][2] - c * r[1][2], c * r[1][1] - s * r[0][1]);
}

/* (phi, beta) of a unit vector, see above */
static void turns_to(const double axis[3], double *phi, double *beta) {
  double across = hypot(axis[0], axis[1]);
  if (across < straight) {
    *phi = 0.0;
    *beta = axis[2] < 0.0 ? acos(-1.0) : 0.0;
    return;
  }
  *phi = atan2(axis[0], -axis[1]);
  *beta = atan2(across, axis[2]);
  if (cos(*phi) < -snap) { /* the same axis, turned the other way: angles nearer to zero */
    *phi = atan2(-axis[0], axis[1]);
    *beta = -*beta;
  }
}

static void row_of(ambulo_link *row, ambulo_joint_type type, double theta, double d, double a,
                   double alpha) {
  row->type = type;
  row->theta = theta;
  row->d = d;
  row->a = a;
  row->alpha = alpha;
}

int ambulo__placement_rows(const ambulo__placement *placement, ambulo_joint_type type,
                           ambulo_link row[AMBULO__MOST_ROWS], int *joint) {
  double turned[3][3], phi = 0.0, beta = 0.0, t1, a1;
  const double *p = placement->xyz;
  memcpy(turned, placement->rotation, sizeof turned);
  if (type != AMBULO_FIXED) turns_to(placement->axis, &phi, &beta);
  rotate_columns(turned, 0, 1, phi);
  rotate_columns(turned, 1, 2, beta);
  const double z[3] = {turned[0][2], turned[1][2], turned[2][2]};
  turns_to(z, &t1, &a1);
  /* Rot_x(-a1) Rot_z(-t1) R A is a turn about z: its first column is (cos t2, sin t2, 0) */
  double c1 = snapped(cos(t1)), s1 = snapped(sin(t1)), ca = snapped(cos(a1)), sa = snapped(sin(a1));
  double x = c1 * turned[0][0] + s1 * turned[1][0];
  double y = ca * (c1 * turned[1][0] - s1 * turned[0][0]) + sa * turned[2][0];
  double t2 = fabs(y) < straight && x > 0.0 ? 0.0 : atan2(y, x);
  double across = hypot(p[0], p[1]), bearing = across > 0.0 ? atan2(p[1], p[0]) : 0.0;
  int count = 0;
  if (across > 0.0 || p[2] != 0.0) row_of(&row[count++], AMBULO_FIXED, bearing, p[2], across, 0.0);
  if (t1 - bearing != 0.0 || a1 != 0.0)
    row_of(&row[count++], AMBULO_FIXED, t1 - bearing, 0.0, 0.0, a1);
  *joint = type == AMBULO_FIXED ? -1 : count;
  if (type != AMBULO_FIXED || t2 != 0.0 || count == 0)
    row_of(&row[count++], type, t2, 0.0, 0.0, -beta);
  if (type != AMBULO_FIXED && phi != 0.0) row_of(&row[count++], AMBULO_FIXED, -phi, 0.0, 0.0, 0.0);
  return count;
}
