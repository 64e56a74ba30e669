/* show/motions.c - see motions.h. */
#include "show/motions.h"

size_t ambulo__motion_values(const ambulo__motions *motions) {
  return (size_t)motions->series * (size_t)((motions->samples - 1) / motions->every + 1);
}

void ambulo__motion_row(const ambulo__motions *motions, int i, double *row) {
  const float *from = motions->motion[i];
  for (int s = 0; s < motions->series; s++, from += motions->samples)
    for (int k = 0; k < motions->samples; k += motions->every)
      *row++ = motions->finer * (double)from[k];
}
