/* tests/support/subject_motion.h - a person's own motion as files, of known curves.
 *
 * Six seconds at 100 Hz, strides of 1.2 s; the left foot strikes at 0.5 s + 1.2 n, the right one at
 * 1.1 s + 1.2 n. With s the share of a foot's cycle, in degrees:
 *   hip flexion 10 + 25 cos(2 pi (s + 0.11)), knee 30 + 28 cos(2 pi (s - 0.72)), hip adduction 5
 * cos(2 pi s), hip rotation 3 sin(2 pi s), ankle 8 sin(2 pi s), pelvis (of the left cycle): own
 * side up 4 cos(2 pi s), own side forward 6 cos(2 pi s), forward tilt 11 + 2 cos(4 pi s) and in N
 * the vertical force 700 sin(pi s / 0.6), forward -100 sin(2 pi s / 0.6) for s < 0.6. */
#ifndef AMBULO_TESTS_SUBJECT_MOTION_H
#define AMBULO_TESTS_SUBJECT_MOTION_H

#include "support/scratch.h"

#include <math.h>

#define SUBJECT_PI 3.14159265358979323846
enum { SUBJECT_ROWS = 601, SUBJECT_ANGLES = 13 };
static const double subject_stride = 1.2, subject_first[2] = {0.5, 1.1};

/* in degrees, signs of the models; by side 0, 1 */
static inline double subject_angle(const char *name, int side, double s) {
  double turn = 2.0 * SUBJECT_PI * s, own = side == 0 ? 1.0 : -1.0;
  if (!strcmp(name, "hip_flexion")) return 10.0 + 25.0 * cos(turn + 2.0 * SUBJECT_PI * 0.11);
  if (!strcmp(name, "knee_angle")) return 30.0 + 28.0 * cos(turn - 2.0 * SUBJECT_PI * 0.72);
  if (!strcmp(name, "hip_adduction")) return 5.0 * cos(turn);
  if (!strcmp(name, "hip_rotation")) return 3.0 * sin(turn);
  if (!strcmp(name, "ankle_angle")) return 8.0 * sin(turn);
  if (!strcmp(name, "pelvis_list")) return own * 4.0 * cos(turn);
  if (!strcmp(name, "pelvis_rotation")) return -own * 6.0 * cos(turn);
  return -11.0 - 2.0 * cos(2.0 * turn); /* pelvis_tilt */
}

static inline double subject_share(int side, double t) {
  double s = (t - subject_first[side]) / subject_stride;
  return s - floor(s + 1e-9);
}

typedef struct subject_column {
  const char *title, *angle; /* NULL: force */
  int side;                  /* of angle or force */
  int axis;                  /* of a force */
  double scale;
} subject_column;

/* a CSV, or an STO where `header` ends with "endheader\n" */
static inline const char *subject_write(void **state, const char *file, const char *header,
                                        const subject_column *columns, int count, double from) {
  const char *path = scratch_path(state, file);
  FILE *f = fopen(path, "w");
  assert_non_null(f);
  int sto = strstr(header, "endheader") != NULL;
  fprintf(f, "%stime", header);
  for (int c = 0; c < count; c++) fprintf(f, "%c%s", sto ? '\t' : ',', columns[c].title);
  for (int k = 0; k < SUBJECT_ROWS; k++) {
    double t = from + 0.01 * k;
    fprintf(f, "\n%.10g", t);
    for (int c = 0; c < count; c++) {
      double s = subject_share(columns[c].side, t), value;
      if (columns[c].angle) {
        value = subject_angle(columns[c].angle, columns[c].side, s);
      } else if (s >= 0.6 || columns[c].axis == 2) {
        value = 0.0;
      } else {
        value = columns[c].axis == 1 ? 700.0 * sin(SUBJECT_PI * s / 0.6)
                                     : -100.0 * sin(2.0 * SUBJECT_PI * s / 0.6);
      }
      fprintf(f, "%c%.10g", sto ? '\t' : ',', columns[c].scale * value);
    }
  }
  fprintf(f, "\n");
  assert_int_equal(fclose(f), 0);
  return path;
}

/* OpenSim's plain names, degrees */
static inline const char *subject_plain(void **state) {
  static const subject_column columns[SUBJECT_ANGLES] = {
      {"pelvis_tilt", "pelvis_tilt", 0, 0, 1},
      {"pelvis_list", "pelvis_list", 0, 0, 1},
      {"pelvis_rotation", "pelvis_rotation", 0, 0, 1},
      {"hip_flexion_l", "hip_flexion", 0, 0, 1},
      {"hip_flexion_r", "hip_flexion", 1, 0, 1},
      {"hip_adduction_l", "hip_adduction", 0, 0, 1},
      {"hip_adduction_r", "hip_adduction", 1, 0, 1},
      {"hip_rotation_l", "hip_rotation", 0, 0, 1},
      {"hip_rotation_r", "hip_rotation", 1, 0, 1},
      {"knee_angle_l", "knee_angle", 0, 0, 1},
      {"knee_angle_r", "knee_angle", 1, 0, 1},
      {"ankle_angle_l", "ankle_angle", 0, 0, 1},
      {"ankle_angle_r", "ankle_angle", 1, 0, 1}};
  return subject_write(state, "plain.csv", "# inDegrees=yes\n", columns, SUBJECT_ANGLES, 0.0);
}

/* of both feet, with these names of their groups */
static inline const char *subject_forces(void **state, const char *left, const char *right,
                                         double from) {
  char title[6][64];
  subject_column columns[6];
  for (int c = 0; c < 6; c++) {
    (void)snprintf(title[c], sizeof title[c], "%s_v%c", c < 3 ? left : right, "xyz"[c % 3]);
    columns[c] = (subject_column){title[c], NULL, c / 3, c % 3, 1.0};
  }
  return subject_write(state, "forces.mot", "forces\nendheader\n", columns, 6, from);
}

/* share of the cycle at which the ankle is farthest ahead of the hip, by search */
static inline double subject_reach_peak(void) {
  double best = -INFINITY, at = 0.0, rad = SUBJECT_PI / 180.0;
  for (int k = 0; k < 20000; k++) {
    double s = k / 20000.0;
    double f = rad * (subject_angle("hip_flexion", 0, s) + subject_angle("pelvis_tilt", 0, s));
    double x = 0.2425 * sin(f) + 0.2493 * sin(f - rad * subject_angle("knee_angle", 0, s));
    if (x > best) {
      best = x;
      at = s;
    }
  }
  return at > 0.5 ? at - 1.0 : at;
}

#endif
