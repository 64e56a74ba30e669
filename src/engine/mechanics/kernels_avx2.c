/* mechanics/kernels_avx2.c - four lanes at a time, on AVX2 with fused multiply-add. */
#include "mechanics/plan.h"

#if defined(__AVX2__) && defined(__FMA__)
#define AMBULO__WIDTH 4
#define AMBULO__KERNELS ambulo__kernels_avx2
#define AMBULO__KERNELS_NAME "avx2"
#include "mechanics/kernel_source.h"
#elif defined(__x86_64__)
const ambulo__kernels ambulo__kernels_avx2 = {"avx2", NULL, NULL, NULL, NULL};
#endif
