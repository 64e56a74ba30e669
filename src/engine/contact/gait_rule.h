/* contact/gait_rule.h - a regular walk as it is asked for: what is given, and what follows from it.
 *
 * Lengths, times and speed of the steps say the same thing twice: what is given decides, the rest
 * follows. With the stature H, g = |gravity|, the speed v and its number u = v / sqrt(g H):
 *
 *     length   given; H (comfortable + slope (u - 0.31)); v times the time of a step; or that
 *              which people choose, who keep the walk ratio of step length and cadence (Sekiya et
 *              al. 1996; down to about 1 m/s: Murakami & Otaka 2017), W = 0.0035 of the stature per
 *              step a minute at H = 1.75 m, as H^1.5, so that bodies of one speed number make alike
 *              steps: v = L C / 60, L = W C, L = sqrt(60 v W)
 *     time     given; the duration over the steps; or length / v
 *     phase    a share of the stride, or comfortable + slope (u - 0.31)
 *     width    given, or the distance of the heels in the neutral pose
 *
 * 0.31 is 1.28 m/s for 1.75 m.
 */
#ifndef AMBULO_CONTACT_GAIT_RULE_H
#define AMBULO_CONTACT_GAIT_RULE_H

#include "contact/row_families.h"

#define AMBULO__COMFORTABLE_NUMBER 0.31
enum { AMBULO__PHASES = 4 }; /* heel_strike, foot_flat, heel_off, toe_off of a gait */

typedef enum ambulo__phase_kind {
  AMBULO__PHASE_SHARE,    /* of the stride, at any speed */
  AMBULO__PHASE_FUNCTION, /* of the speed, as the file has it */
  AMBULO__PHASE_OF_PEOPLE /* of the speed, the program's own */
} ambulo__phase_kind;

typedef enum ambulo__length_kind {
  AMBULO__LENGTH_GIVEN,
  AMBULO__LENGTH_FUNCTION, /* of the speed */
  AMBULO__LENGTH_OF_TIME,  /* speed times time */
  AMBULO__LENGTH_OF_PEOPLE /* by the walk ratio */
} ambulo__length_kind;

typedef enum ambulo__time_kind {
  AMBULO__TIME_OF_SPEED,
  AMBULO__TIME_OF_DURATION,
  AMBULO__TIME_GIVEN
} ambulo__time_kind;

typedef struct ambulo__gait_rule {
  ambulo_gait fixed; /* steps, feet, landing and start; the rest follows */
  ambulo__length_kind length_kind;
  ambulo__time_kind time_kind;
  double length[2];                        /* m: of odd and of even steps; NaN: of all alike */
  double length_comfortable, length_slope; /* statures */
  double time[2], duration;                /* s; time as length */
  double speed;                            /* m/s; NaN: not given */
  double width;                            /* m; NaN: of the neutral pose */
  ambulo__phase_kind phase_kind[AMBULO__PHASES];
  double phase[AMBULO__PHASES], phase_slope[AMBULO__PHASES];
} ambulo__gait_rule;

/* The walk that follows. */
void ambulo__gait_follow(const ambulo__gait_rule *rule, const ambulo_model *model,
                         ambulo_gait *gait);
/* sqrt(g H), m/s; 0: the model has no stature, or no gravity. */
double ambulo__speed_unit(const ambulo_model *model);
/* Mean speed of a walk, m/s, and its number; a comfortable one where there is none. */
double ambulo__gait_speed(const ambulo_gait *gait);
double ambulo__speed_number(const ambulo_model *model, double speed);

#endif
