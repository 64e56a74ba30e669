/* linear/band_kernels.c - choosing a set at run time, by the rule of mechanics/dispatch.c. */
#include "mechanics/kernels.h"
#include "linear/band_kernels.h"
#include "ambulo/mechanics.h"

#include <stddef.h>
#include <string.h>

const ambulo__band_kernels *ambulo__band_kernels_select(void) {
#if defined(__x86_64__)
  const char *name = ambulo__instruction_set();
  if (!strcmp(name, "avx512") && ambulo__band_kernels_avx512.factor)
    return &ambulo__band_kernels_avx512;
  if (!strcmp(name, "avx2") && ambulo__band_kernels_avx2.factor) return &ambulo__band_kernels_avx2;
#endif
  return NULL;
}
