/* linear/band_kernels_avx512.c - vectors of eight. */
#include "linear/band_kernels.h"

#if defined(__AVX512F__)
#define AMBULO__WIDTH 8
#define AMBULO__BAND_KERNELS ambulo__band_kernels_avx512
#define AMBULO__BAND_KERNELS_NAME "avx512"
#include "linear/band_source.h"
#elif defined(__x86_64__)
const ambulo__band_kernels ambulo__band_kernels_avx512 = {.name = "avx512"};
#endif
