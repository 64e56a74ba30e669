/* muscle/kernels_avx512.c - a whole block of eight lanes at a time, on AVX-512. */
#include "muscle/muscles.h"

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__FMA__)
#define AMBULO__WIDTH 8
#define AMBULO__SHARE ambulo__share_avx512
#include "muscle/kernel_source.h"
#elif defined(__x86_64__)
const ambulo__share_kernels ambulo__share_avx512 = {NULL, NULL};
#endif
