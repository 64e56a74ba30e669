/* picture/gait_obstacles.h - obstacles of a problem, seen from the side. */
#ifndef AMBULO_PICTURE_GAIT_OBSTACLES_H
#define AMBULO_PICTURE_GAIT_OBSTACLES_H

#include "nlp/nlp.h"

/* Along forward, and above the ground's height, m. */
typedef struct ambulo__outline {
  double from, to, low, high;
  int is_round; /* 1: the end of a capsule that lies across, as long as high */
} ambulo__outline;

/* The smallest upright rectangle around it. */
ambulo__outline ambulo__obstacle_outline(const ambulo_problem *problem, int obstacle);

#endif
