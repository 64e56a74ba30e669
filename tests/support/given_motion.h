/* tests/support/given_motion.h - a shipped body, its segments, and motions of it for retargeting.
 */
#ifndef AMBULO_TESTS_GIVEN_MOTION_H
#define AMBULO_TESTS_GIVEN_MOTION_H

#include "ambulo/tools/tools.h"
#include "retarget/figure.h"
#include "support/test.h"

static const char person_file[] = "models/whole_body_37.yaml";

typedef struct person {
  ambulo_model *model;
  ambulo__figure figure;
} person;

static inline person person_open(const char *file, double stature) {
  person p = {.model = NULL};
  ambulo_subject subject = ambulo_subject_default();
  ambulo__segment_map map;
  if (stature > 0.0) subject.stature = stature;
  assert_int_equal(ambulo_model_load(file, &subject, NULL, NULL, &p.model), AMBULO_OK);
  ambulo__segments_find(p.model, NULL, &map);
  assert_int_equal(ambulo__figure_create(p.model, &map, "body", NULL, NULL, &p.figure), AMBULO_OK);
  return p;
}

static inline void person_close(person *p) {
  ambulo__figure_free(&p->figure);
  ambulo_model_free(p->model);
}

static inline double even(unsigned *seed) { /* [-1, 1] */
  *seed = *seed * 1664525u + 1013904223u;
  return (double)(*seed >> 8) / (double)(1u << 23) - 1.0;
}

/* how far two rotations are apart, rad */
static inline double apart(const ambulo__rigid *a, const ambulo__rigid *b) {
  ambulo__rigid back = ambulo__rigid_inverse(a), change = ambulo__rigid_times(&back, b);
  double v[3];
  ambulo__turn_vector(&change, v);
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* a table of a body that bends its knees and stands up again with flat feet, in degrees */
static inline void write_squat(const char *path, int rows) {
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fprintf(file, "# inDegrees=yes\ntime,hip_flexion_r,hip_flexion_l,knee_angle_r,"
                "knee_angle_l,ankle_angle_r,ankle_angle_l\n");
  for (int k = 0; k < rows; k++) {
    double u = (double)k / (rows - 1), bend = 15.0 * (1.0 - cos(2.0 * acos(-1.0) * u));
    fprintf(file, "%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f\n", 2.0 * u, bend, bend, 2 * bend, 2 * bend,
            bend, bend);
  }
  assert_int_equal(fclose(file), 0);
}

#endif
