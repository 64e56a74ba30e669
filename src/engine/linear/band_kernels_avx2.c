/* linear/band_kernels_avx2.c - vectors of four. */
#include "linear/band_kernels.h"

#if defined(__AVX2__) && defined(__FMA__)
#define AMBULO__WIDTH 4
#define AMBULO__BAND_KERNELS ambulo__band_kernels_avx2
#define AMBULO__BAND_KERNELS_NAME "avx2"
#include "linear/band_source.h"
#elif defined(__x86_64__)
const ambulo__band_kernels ambulo__band_kernels_avx2 = {.name = "avx2"};
#endif
