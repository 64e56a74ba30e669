/* mechanics/kernels.h - the compiled kernel sets. Only those the compiler could build exist. */
#ifndef AMBULO_MECHANICS_KERNELS_H
#define AMBULO_MECHANICS_KERNELS_H

#include "mechanics/plan.h"

extern const ambulo__kernels ambulo__kernels_scalar;
extern const ambulo__kernels ambulo__kernels_baseline;
#if defined(__x86_64__)
/* Without functions (all NULL) when the file was built without its instruction set. */
extern const ambulo__kernels ambulo__kernels_avx2;
extern const ambulo__kernels ambulo__kernels_avx512;
#endif

/* Name of the selected set: "avx512", "avx2", "baseline" or "scalar". The best that the processor
 * has, or what AMBULO_ISA in the environment names. */
const char *ambulo__instruction_set(void);

#endif
