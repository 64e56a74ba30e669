/* linear/band_kernels_baseline.c - vectors of two: what every processor of the family has; and the
 * choice of a set. */
#include "linear/band_kernels.h"

#define AMBULO__WIDTH 2
#define AMBULO__BAND_KERNELS ambulo__band_kernels_baseline
#define AMBULO__BAND_KERNELS_NAME "baseline"
#include "linear/band_source.h"

#include "mechanics/plan.h"

#include <string.h>

/* by the rule of mechanics/mechanics.c; a set without functions was not compiled in */
const ambulo__band_kernels *ambulo__band_kernels_select(void) {
#if defined(__x86_64__)
  const char *name = ambulo__instruction_set();
  if (!strcmp(name, "avx512") && ambulo__band_kernels_avx512.factor)
    return &ambulo__band_kernels_avx512;
  if (!strcmp(name, "avx2") && ambulo__band_kernels_avx2.factor) return &ambulo__band_kernels_avx2;
#endif
  return &ambulo__band_kernels_baseline;
}
