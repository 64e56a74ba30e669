/* import/rigid.h - rigid placements, and the ways in which files write rotations. */
#ifndef AMBULO_IMPORT_RIGID_H
#define AMBULO_IMPORT_RIGID_H

/* x in the frame -> R x + p in the frame it is placed in. */
typedef struct ambulo__rigid {
  double r[3][3], p[3];
} ambulo__rigid;

ambulo__rigid ambulo__rigid_identity(void);
ambulo__rigid ambulo__rigid_shift(const double p[3]);
/* the rotation of `a` alone */
ambulo__rigid ambulo__rigid_turned(const ambulo__rigid *a);
/* by `angle` (rad) about a unit axis through the origin */
ambulo__rigid ambulo__rigid_turn(const double axis[3], double angle);
/* by `value` about a unit axis, or (slides = 1) along it */
ambulo__rigid ambulo__rigid_step(int slides, const double axis[3], double value);
/* a b: b is placed in a */
ambulo__rigid ambulo__rigid_times(const ambulo__rigid *a, const ambulo__rigid *b);
ambulo__rigid ambulo__rigid_inverse(const ambulo__rigid *a);
void ambulo__rigid_point(const ambulo__rigid *a, const double x[3], double out[3]);
void ambulo__rigid_vector(const ambulo__rigid *a, const double v[3], double out[3]);
/* R' v: a vector of the outer frame in the placed one */
void ambulo__rigid_back(const ambulo__rigid *a, const double v[3], double out[3]);

/* Roll, pitch, yaw of URDF, rad: Rot_z(yaw) Rot_y(pitch) Rot_x(roll). */
ambulo__rigid ambulo__rigid_of_rpy(const double p[3], const double rpy[3]);
/* Turns about the body's own x, then y, then z (OpenSim's orientations), rad. */
ambulo__rigid ambulo__rigid_of_xyz(const double p[3], const double angles[3]);
/* A quaternion (w, x, y, z) of any length but zero; 0 for that. */
int ambulo__rotation_of_quaternion(const double q[4], double r[3][3]);

/* Inertia [xx yy zz xy xz yz] in the axes R turns into the others: R I R'. */
void ambulo__inertia_turn(const double r[3][3], const double inertia[6], double out[6]);
/* Length of v, which is made a unit vector; 0, and v stays, where it has no direction. */
double ambulo__normalize(double v[3]);

#endif
