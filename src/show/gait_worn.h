/* show/gait_worn.h - what a body wears and carries, as marks on its stick figures. */
#ifndef AMBULO_SHOW_GAIT_WORN_H
#define AMBULO_SHOW_GAIT_WORN_H

#include "show/skeleton.h"
#include "people/stride.h"

/* A line between two places, or a disc at the first of them. */
typedef struct ambulo__worn {
  int link[2]; /* -1: the world */
  double at[2][3];
  double radius; /* m; 0: a line */
  const char *style;
} ambulo__worn;

/* Devices, then loads. */
int ambulo__worn_count(const ambulo__stride *stride);
/* Mark i at a sample; 0: a device that does nothing then. */
int ambulo__worn_at(const ambulo__stride *stride, int sample, int i, ambulo__worn *mark);

#endif
