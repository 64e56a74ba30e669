/* tests/support/gait_folder.h - a result folder with a made-up gait of known curves.
 *
 * One stride of 1.2 s in 40 intervals from t = 0.1 s; the left foot strikes at 0.4 s, the right
 * one half a stride later. With s the share of a foot's own cycle, in degrees, N m and N:
 *   hip flexion 10 + 20 cos(2 pi s), knee 30 - 30 cos(4 pi s), their torques -80 cos(2 pi s) and 0,
 *   vertical force 700 sin(pi s / 0.6) for s < 0.6, forward force 0; 70 kg. */
#ifndef AMBULO_TESTS_GAIT_FOLDER_H
#define AMBULO_TESTS_GAIT_FOLDER_H

#include "support/scratch.h"

#define GAIT_PI 3.14159265358979323846

static inline double gait_hip(double s) {
  return 10.0 + 20.0 * cos(2.0 * GAIT_PI * s);
}
static inline double gait_knee(double s) {
  return 30.0 - 30.0 * cos(4.0 * GAIT_PI * s);
}
static inline double gait_force(double s) {
  s -= floor(s + 1e-9);
  return s < 0.6 ? fmax(0.0, 700.0 * sin(GAIT_PI * s / 0.6)) : 0.0;
}

/* extra degrees on the right hip; columns of forces or not */
static inline void gait_motion(const char *folder, double limp, int forces) {
  char path[SCRATCH_PATH + 64];
  (void)snprintf(path, sizeof path, "%s/motion.csv", folder);
  FILE *f = fopen(path, "w");
  assert_non_null(f);
  fprintf(f, "# SI units\ntime,q.hip_flexion_l,q.hip_flexion_r,q.knee_angle_l,q.knee_angle_r,"
             "qd.knee_angle_l,tau.hip_flexion_l,tau.hip_flexion_r,zmp.x");
  if (forces) fprintf(f, ",grf.left.x,grf.left.y,grf.left.z,grf.right.x,grf.right.y,grf.right.z");
  fprintf(f, "\n");
  for (int k = 0; k <= 40; k++) {
    double t = 0.1 + 0.03 * k, l = (t - 0.4) / 1.2, r = l - 0.5, rad = GAIT_PI / 180.0;
    fprintf(f, "%.12g,%.17g,%.17g,%.17g,%.17g,0,%.17g,%.17g,nan", t, rad * gait_hip(l),
            rad * (gait_hip(r) + limp), rad * gait_knee(l), rad * gait_knee(r),
            -80.0 * cos(2.0 * GAIT_PI * l), -80.0 * cos(2.0 * GAIT_PI * r));
    if (forces) fprintf(f, ",0,%.17g,0,0,%.17g,0", gait_force(l), gait_force(r));
    fprintf(f, "\n");
  }
  assert_int_equal(fclose(f), 0);
}

static inline void gait_summary(const char *folder, const char *text) {
  char path[SCRATCH_PATH + 64];
  (void)snprintf(path, sizeof path, "%s/summary.json", folder);
  scratch_write(path, text);
}

#define GAIT_BODY "\"body\": {\"mass\": 70, \"gravity\": 10, \"up\": [0, 1, 0]}"
#define GAIT_STRIKES                                                                               \
  "\"strikes\": [{\"foot\": \"right\", \"time\": 1.0}, {\"foot\": \"left\", \"time\": 0.4}]"

#endif
