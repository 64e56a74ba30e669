/* gait/curved.h - rows that are not linear in the channels of their node. */
#ifndef AMBULO_GAIT_CURVED_H
#define AMBULO_GAIT_CURVED_H

#include "gait/apart.h"
#include "gait/arc.h"
#include "gait/solid.h"

enum { AMBULO__CURVED_CHANNELS = AMBULO__SOLID_CHANNELS };

typedef enum ambulo__curve { AMBULO__IS_ARC, AMBULO__IS_APART, AMBULO__IS_SOLID } ambulo__curve;

typedef struct ambulo__curved {
  ambulo__curve is;
  union {
    ambulo__arc arc;     /* of an arc that rolls */
    ambulo__apart apart; /* of a point and a segment */
    ambulo__solid solid; /* of a capsule and another, or an obstacle */
  } of;
} ambulo__curved;

/* The row's value at a node from its channels, channel k at y[k * stride]. Its slopes are added to
 * slope [channels] unless NULL. */
static inline double ambulo__curved_value(const ambulo__curved *row, const double *y, int stride,
                                          double *slope) {
  if (row->is == AMBULO__IS_ARC) return ambulo__arc_value(&row->of.arc, y, stride, slope);
  if (row->is == AMBULO__IS_SOLID) return ambulo__solid_value(&row->of.solid, y, stride, slope);
  return ambulo__apart_value(&row->of.apart, y, stride, slope);
}
/* The channels on which it stands: returns how many of channel[AMBULO__CURVED_CHANNELS]. */
static inline int ambulo__curved_channels(const ambulo__curved *row,
                                          int channel[AMBULO__CURVED_CHANNELS]) {
  if (row->is == AMBULO__IS_ARC) return ambulo__arc_channels(&row->of.arc, channel);
  if (row->is == AMBULO__IS_SOLID) return ambulo__solid_channels(&row->of.solid, channel);
  const int first[3] = {row->of.apart.point, row->of.apart.from, row->of.apart.to};
  for (int i = 0; i < 9; i++) channel[i] = first[i / 3] + i % 3;
  return 9;
}

#endif
