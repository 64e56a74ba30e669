/* muscle/kernels_baseline.c - two lanes at a time: what every processor of the family has. */
#include "muscle/muscles.h"

#define AMBULO__WIDTH 2
#define AMBULO__SHARE ambulo__share_baseline
#include "muscle/kernel_source.h"
