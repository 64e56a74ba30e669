/* mechanics/kernels_avx512.c - a whole block of eight lanes at a time, on AVX-512. */
#include "mechanics/plan.h"

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__FMA__)
#define AMBULO__WIDTH 8
#define AMBULO__KERNELS ambulo__kernels_avx512
#define AMBULO__KERNELS_NAME "avx512"
#include "mechanics/kernel_source.h"
#elif defined(__x86_64__)
const ambulo__kernels ambulo__kernels_avx512 = {"avx512", NULL, NULL, NULL, NULL};
#endif
