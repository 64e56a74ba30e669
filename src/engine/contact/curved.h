/* contact/curved.h - rows that are not linear in the channels of their node. */
#ifndef AMBULO_CONTACT_CURVED_H
#define AMBULO_CONTACT_CURVED_H

#include "contact/apart.h"
#include "contact/arc.h"
#include "contact/solid.h"
#include "contact/spin.h"

enum { AMBULO__CURVED_CHANNELS = AMBULO__SOLID_CHANNELS };

typedef enum ambulo__curved_form {
  AMBULO__CURVED_ARC,   /* of an arc that rolls */
  AMBULO__CURVED_APART, /* of a point and a segment */
  AMBULO__CURVED_SOLID, /* of a capsule and another, or an obstacle */
  AMBULO__CURVED_SPIN   /* of the root wrench about the centre of mass */
} ambulo__curved_form;

typedef struct ambulo__curved {
  ambulo__curved_form form;
  union {
    ambulo__arc arc;
    ambulo__apart apart;
    ambulo__solid solid;
    ambulo__spin spin;
  } of;
} ambulo__curved;

/* The row's value at a node from its channels, channel k at y[k * stride]. Its slopes are added to
 * slope [channels] unless NULL. */
static inline double ambulo__curved_value(const ambulo__curved *row, const double *y, int stride,
                                          double *slope) {
  switch (row->form) {
  case AMBULO__CURVED_ARC:
    return ambulo__arc_value(&row->of.arc, y, stride, slope);
  case AMBULO__CURVED_SOLID:
    return ambulo__solid_value(&row->of.solid, y, stride, slope);
  case AMBULO__CURVED_SPIN:
    return ambulo__spin_value(&row->of.spin, y, stride, slope);
  case AMBULO__CURVED_APART:
    break;
  }
  return ambulo__apart_value(&row->of.apart, y, stride, slope);
}
/* The channels on which it stands: returns how many of channel[AMBULO__CURVED_CHANNELS]. */
static inline int ambulo__curved_channels(const ambulo__curved *row,
                                          int channel[AMBULO__CURVED_CHANNELS]) {
  if (row->form == AMBULO__CURVED_ARC) return ambulo__arc_channels(&row->of.arc, channel);
  if (row->form == AMBULO__CURVED_SOLID) return ambulo__solid_channels(&row->of.solid, channel);
  const ambulo__apart *apart = &row->of.apart;
  const ambulo__spin *spin = &row->of.spin;
  int is_spin = row->form == AMBULO__CURVED_SPIN;
  const int first[3] = {is_spin ? spin->moment : apart->point, is_spin ? spin->force : apart->from,
                        is_spin ? spin->center : apart->to};
  for (int i = 0; i < 9; i++) channel[i] = first[i / 3] + i % 3;
  return 9;
}

#endif
