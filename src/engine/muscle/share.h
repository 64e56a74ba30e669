/* muscle/share.h - the sharing of a limb's torques, with memory of its own. */
#ifndef AMBULO_MUSCLE_SHARE_H
#define AMBULO_MUSCLE_SHARE_H

#include "muscle/muscles.h"

typedef struct ambulo__share {
  ambulo_allocator allocator;
  const ambulo_muscles *muscles;
  ambulo_sharing sharing;
  const ambulo__share_kernels *kernels;
  double *numbers, *scratch;
} ambulo__share;

/* Free with ambulo__share_free, which accepts NULL. `muscles` must outlive it. E_MEMORY. */
ambulo_status ambulo__share_create(const ambulo_muscles *muscles, const ambulo_sharing *sharing,
                                   const ambulo_allocator *allocator, ambulo__share **created);
void ambulo__share_free(ambulo__share *share);

ambulo__prices ambulo__share_prices(const ambulo_muscles *muscles, const ambulo_sharing *sharing,
                                    const ambulo__muscle_limb *limb);

enum { AMBULO__SHARE_INPUTS = 4 }; /* q, qd, tau, tau_rate */

/* One limb at eight states. *block points into the memory of `share`, until the next limb; the
 * caller fills inputs[..][coordinates][LANES] before the end. */
void ambulo__share_begin(ambulo__share *share, int limb, ambulo__share_block *block,
                         double *inputs[AMBULO__SHARE_INPUTS]);
void ambulo__share_end(const ambulo__share *share, int limb, const ambulo__share_block *block);

#endif
