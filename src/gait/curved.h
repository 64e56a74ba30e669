/* gait/curved.h - rows that are not linear in the channels of their node. */
#ifndef AMBULO_GAIT_CURVED_H
#define AMBULO_GAIT_CURVED_H

#include "gait/apart.h"
#include "gait/arc.h"

enum { AMBULO__CURVED_CHANNELS = AMBULO__ARC_CHANNELS };

typedef struct ambulo__curved {
  int is_arc;
  union {
    ambulo__arc arc;     /* of an arc that rolls */
    ambulo__apart apart; /* of a point and a segment */
  } of;
} ambulo__curved;

/* The row's value at a node from its channels, channel k at y[k * stride]. Its slopes are added to
 * slope [channels] unless NULL. */
static inline double ambulo__curved_value(const ambulo__curved *row, const double *y, int stride,
                                          double *slope) {
  return row->is_arc ? ambulo__arc_value(&row->of.arc, y, stride, slope)
                     : ambulo__apart_value(&row->of.apart, y, stride, slope);
}
/* The channels on which it stands: returns how many of channel[AMBULO__CURVED_CHANNELS]. */
static inline int ambulo__curved_channels(const ambulo__curved *row,
                                          int channel[AMBULO__CURVED_CHANNELS]) {
  if (row->is_arc) return ambulo__arc_channels(&row->of.arc, channel);
  const int first[3] = {row->of.apart.point, row->of.apart.from, row->of.apart.to};
  for (int i = 0; i < 9; i++) channel[i] = first[i / 3] + i % 3;
  return 9;
}

#endif
