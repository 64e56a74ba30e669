/* muscle/kernels_avx2.c - four lanes at a time, on AVX2. */
#include "muscle/muscles.h"

#if defined(__AVX2__) && defined(__FMA__)
#define AMBULO__WIDTH 4
#define AMBULO__SHARE ambulo__share_avx2
#include "muscle/kernel_source.h"
#elif defined(__x86_64__)
const ambulo__share_kernels ambulo__share_avx2 = {NULL, NULL};
#endif
