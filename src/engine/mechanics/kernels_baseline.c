/* mechanics/kernels_baseline.c - two lanes at a time: what every processor of the family has. */
#include "mechanics/plan.h"

#define AMBULO__WIDTH 2
#define AMBULO__KERNELS ambulo__kernels_baseline
#define AMBULO__KERNELS_NAME "baseline"
#include "mechanics/kernel_source.h"
