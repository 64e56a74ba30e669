/* mechanics/kernels_scalar.c - one lane at a time: the scalar twin that the tests compare. */
#include "mechanics/plan.h"

#define AMBULO__WIDTH 1
#define AMBULO__KERNELS ambulo__kernels_scalar
#define AMBULO__KERNELS_NAME "scalar"
#include "mechanics/kernel_source.h"
