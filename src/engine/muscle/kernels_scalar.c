/* muscle/kernels_scalar.c - one lane at a time: the scalar twin that the tests compare. */
#include "muscle/muscles.h"

#define AMBULO__WIDTH 1
#define AMBULO__SHARE ambulo__share_scalar
#include "muscle/kernel_source.h"
