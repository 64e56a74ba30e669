/* contact/gait_rule.c - see gait_rule.h. */
#include "contact/gait_rule.h"

#include "model/neutral_pose.h"

#include <math.h>

double ambulo__speed_unit(const ambulo_model *model) {
  const double *g = model->gravity;
  double unit = sqrt(sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]) * fmax(model->stature, 0.0));
  return unit > 0.0 ? unit : 0.0;
}

double ambulo__gait_speed(const ambulo_gait *gait) {
  return ambulo__gait_place(gait, gait->steps) / ambulo__gait_strike(gait, gait->steps);
}

double ambulo__speed_number(const ambulo_model *model, double speed) {
  double unit = ambulo__speed_unit(model);
  return unit > 0.0 && isfinite(speed) ? speed / unit : AMBULO__COMFORTABLE_NUMBER;
}

/* distance of the heel centres along left at q = 0, m */
static double neutral_width(const ambulo_model *model) {
  if (model->foot_count != 2) return 0.0;
  double width = 0.0;
  for (int foot = 0; foot < 2; foot++) {
    double r[3];
    ambulo__neutral_point(model, model->feet[foot].heel_center, r);
    for (int axis = 0; axis < 3; axis++) width += (foot ? -1.0 : 1.0) * model->left[axis] * r[axis];
  }
  return fabs(width);
}

/* mean of the steps where times are given, else NaN */
static double given_step_time(const ambulo__gait_rule *rule) {
  const double steps = (double)rule->fixed.steps;
  const ambulo_gait timed = {.step_time = rule->time[0], .other_step_time = rule->time[1]};
  if (rule->time_kind == AMBULO__TIME_OF_DURATION) return rule->duration / steps;
  return ambulo__gait_strike(&timed, rule->fixed.steps) / steps;
}

static double length_of(const ambulo__gait_rule *rule, const ambulo_model *model) {
  const double walk_ratio = 0.0035, usual = 1.75; /* statures per (step / min) at m */
  double stature = model->stature, beyond;
  switch (rule->length_kind) {
  case AMBULO__LENGTH_FUNCTION:
    beyond = ambulo__speed_number(model, rule->speed) - AMBULO__COMFORTABLE_NUMBER;
    return stature * (rule->length_comfortable + rule->length_slope * beyond);
  case AMBULO__LENGTH_OF_TIME:
    return rule->speed * given_step_time(rule);
  case AMBULO__LENGTH_OF_PEOPLE:
    return sqrt(60.0 * rule->speed * walk_ratio * stature * sqrt(stature / usual));
  case AMBULO__LENGTH_GIVEN:
    break;
  }
  return rule->length[0];
}

void ambulo__gait_follow(const ambulo__gait_rule *rule, const ambulo_model *model,
                         ambulo_gait *gait) {
  ambulo_gait own = rule->fixed;
  double *const phase[AMBULO__PHASES] = {&own.heel_strike, &own.foot_flat, &own.heel_off,
                                         &own.toe_off};
  own.step_length = length_of(rule, model);
  own.other_step_length = rule->length_kind == AMBULO__LENGTH_GIVEN ? rule->length[1] : (double)NAN;
  own.other_step_time = (double)NAN;
  if (rule->time_kind == AMBULO__TIME_GIVEN) {
    own.step_time = rule->time[0];
    own.other_step_time = rule->time[1];
  } else if (rule->time_kind == AMBULO__TIME_OF_DURATION) {
    own.step_time = rule->duration / (double)own.steps;
  } else {
    own.step_time = ambulo__gait_place(&own, own.steps) / (rule->speed * (double)own.steps);
  }
  own.step_width = isnan(rule->width) ? neutral_width(model) : rule->width;
  double beyond =
      ambulo__speed_number(model, ambulo__gait_speed(&own)) - AMBULO__COMFORTABLE_NUMBER;
  for (int i = 0; i < AMBULO__PHASES; i++) {
    int moves = rule->phase_kind[i] != AMBULO__PHASE_SHARE;
    *phase[i] = rule->phase[i] + (moves ? rule->phase_slope[i] * beyond : 0.0);
  }
  *gait = own;
}
