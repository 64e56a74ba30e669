/* picture/gait_people.h - curves of people behind those of a walk.
 *
 * The mean m(p) and deviation s(p) of a curve of people, over the percent p of the cycle of the
 * foot that strikes at 0, become a line and a band over the time t of the picture, in the unit
 * shown:
 *
 *     p(t) = 100 (t - t_i) / (t_(i+1) - t_i),  t_i <= t < t_(i+1) the strikes of the foot
 *     line scale (m - shift),  band from scale (m - shift) - 2 |scale| s to ... + 2 |scale| s
 *
 * where scale holds the sign and, for moments, the body mass, and shift is the tilt of a marker
 * frame of the pelvis (ambulo/report.h, pelvic_tilt). The strikes of a motion that repeats go on
 * before and after it. Drawn behind walks alone: what repeats, moves on, strikes with both feet,
 * and stands on level ground at every time. */
#ifndef AMBULO_PICTURE_GAIT_PEOPLE_H
#define AMBULO_PICTURE_GAIT_PEOPLE_H

#include "compare/compare_people.h"
#include "picture/skeleton.h"
#include "stride/stride.h"

typedef struct ambulo__gait_people {
  ambulo_allocator allocator;
  const ambulo__people *people; /* NULL: none are shown */
  const ambulo__stride *stride;
  double *strikes[3];              /* by ambulo__side, rising, s, in the motion as it is shown */
  int count[3];                    /* 0 for the middle */
  int shown[AMBULO__PEOPLE_FILES]; /* curves that were drawn, by their file */
} ambulo__gait_people;

/* One curve of people beside one of the motion. */
typedef struct ambulo__people_curve {
  const ambulo__reference_curve *curve; /* NULL: people have none */
  const ambulo__gait_people *of;
  int file; /* of the people */
  ambulo__side side;
  double scale, shift;
} ambulo__people_curve;

/* 1 if curves of people belong behind the motion of this problem. */
int ambulo__gait_is_walk(const ambulo_problem *problem);
/* `people` (may be NULL) must outlive it. Errors: E_MEMORY. */
ambulo_status ambulo__gait_people_create(const ambulo__stride *stride, const ambulo__people *people,
                                         const ambulo_allocator *allocator,
                                         ambulo__gait_people *gait);
void ambulo__gait_people_free(ambulo__gait_people *gait); /* accepts a zero-filled one */

/* Of a coordinate: its angle in degrees (`quantity` "q"), or its torque in N m ("tau"), which
 * people have only beside a motion with ground reaction. */
ambulo__people_curve ambulo__people_coordinate(const ambulo__gait_people *gait,
                                               const char *quantity, int coordinate);
/* Of a foot's force in body weights; `direction` "up" or "forward". */
ambulo__people_curve ambulo__people_force(const ambulo__gait_people *gait, const char *direction,
                                          ambulo__side side);

/* Mean and twice the deviation at sample k of the stride, in the unit shown; 0 outside of all
 * strides. The band is 0 where the people have no deviations. */
int ambulo__people_at(const ambulo__people_curve *curve, int k, double *mean, double *band);

#endif
