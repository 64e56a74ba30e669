/* show/gait_people.h - curves of people behind those of a walk.
 *
 * The mean m(p) and deviation s(p) of a curve of people, over the percent p of the cycle of the
 * foot that strikes at 0, become a line and a band over the time t of the picture, in the unit
 * shown:
 *
 *     p(t) = 100 (t - t_i) / (t_(i+1) - t_i),  t_i <= t < t_(i+1) the strikes of the foot
 *     line scale (m - shift),  band from scale (m - shift) - 2 |scale| s to ... + 2 |scale| s
 *
 * where scale holds the sign and, for moments, the body mass, and shift is the tilt of a marker
 * frame of the pelvis (ambulo/tools/report.h, pelvic_tilt). The strikes of a motion that repeats go
 * on before and after it. Drawn behind walks alone: what repeats, moves on, strikes with both feet,
 * and stands on level ground at every time. */
#ifndef AMBULO_SHOW_GAIT_PEOPLE_H
#define AMBULO_SHOW_GAIT_PEOPLE_H

#include "base/text_buffer.h"
#include "model/model.h"
#include "people/compare.h"
#include "people/stride.h"
#include "show/skeleton.h"

typedef struct ambulo__gait_people {
  ambulo_allocator allocator;
  const ambulo__people *people; /* NULL: none are shown */
  const ambulo__stride *stride;
  double *strikes[3];              /* by ambulo__side, rising, s, in the motion as it is shown */
  int count[3];                    /* 0 for the middle */
  int shown[AMBULO__PEOPLE_FILES]; /* curves that were drawn, by their file */
  ambulo__body_joint joints[AMBULO__BODY_JOINTS]; /* of the model, as people call them */
  int per_kg;                                     /* 1: moments and powers per kg, forces in N/kg */
} ambulo__gait_people;

/* One curve of people beside one of the motion. */
typedef struct ambulo__people_curve {
  const ambulo__reference_curve *curve; /* NULL: people have none */
  const ambulo__gait_people *of;
  int file; /* of the people */
  ambulo__side side;
  double scale, shift;
} ambulo__people_curve;

/* Mass of the body with what it carries, kg: what moments are divided by. */
double ambulo__gait_mass(const ambulo_model *model);
/* 1 if curves of people belong behind the motion of this problem. */
int ambulo__gait_is_walk(const ambulo_problem *problem);
/* `people` (may be NULL) must outlive it. Errors: E_MEMORY. */
ambulo_status ambulo__gait_people_create(const ambulo__stride *stride, const ambulo__people *people,
                                         const ambulo_allocator *allocator,
                                         ambulo__gait_people *gait);
/* The cycle of a side alone, without people: 1 when both feet strike in a motion that repeats.
 * Percent of the cycle at time t; of the side that strikes first, for the middle. */
int ambulo__gait_cycles(const ambulo__gait_people *gait);
double ambulo__gait_percent(const ambulo__gait_people *gait, ambulo__side side, double t);
void ambulo__gait_people_free(ambulo__gait_people *gait); /* accepts a zero-filled one */

/* Of a coordinate: its angle in degrees (`quantity` "q"), its torque in N m ("tau") or its power in
 * W ("power"), which people have only beside a motion with ground reaction; the latter two per kg
 * where gait->per_kg says so. */
ambulo__people_curve ambulo__people_coordinate(const ambulo__gait_people *gait,
                                               const char *quantity, int coordinate);
/* Of a foot's force in body weights, or N/kg; `direction` "up" or "forward". */
ambulo__people_curve ambulo__people_force(const ambulo__gait_people *gait, const char *direction,
                                          ambulo__side side);

/* Mean and twice the deviation at sample k of the stride, in the unit shown; 0 outside of all
 * strides. The band is 0 where the people have no deviations. */
int ambulo__people_at(const ambulo__people_curve *curve, int k, double *mean, double *band);

/* The same at a percent of the cycle. */
int ambulo__people_at_percent(const ambulo__people_curve *curve, double percent, double *mean,
                              double *band);

#endif
