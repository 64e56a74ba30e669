/* linear/band_kernels_baseline.c - vectors of two: what every processor of the family has. */
#include "linear/band_kernels.h"

#define AMBULO__WIDTH 2
#define AMBULO__BAND_KERNELS ambulo__band_kernels_baseline
#define AMBULO__BAND_KERNELS_NAME "baseline"
#include "linear/band_source.h"
