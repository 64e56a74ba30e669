/* linear/spread_source.h - the inner loops of spread.c: compiled with it, and in band_source.h with
 * each instruction set; the compiler makes vectors of them. */
#include "linear/spread.h"

/* A += P' M P, m [3 d][step], column by column of M P */
static void spread(int d, int span, const double *const b[AMBULO__ORDERS], const double *m,
                   size_t step, double *restrict sums, int ld, double *restrict a) {
  for (int j = 0; j < d; j++) {
    const double *value = m + (size_t)j * step, *rate = value + (size_t)d * step;
    const double *acceleration = rate + (size_t)d * step;
    for (int right = 0; right < span; right++) {
      const double r0 = b[0][right], r1 = b[1][right], r2 = b[2][right];
      double *column = a + (size_t)(right * d + j) * (size_t)ld;
      for (int i = 0; i < AMBULO__ORDERS * d; i++)
        sums[i] = r0 * value[i] + r1 * rate[i] + r2 * acceleration[i];
      for (int left = right; left < span; left++) {
        const double b0 = b[0][left], b1 = b[1][left], b2 = b[2][left];
        double *block = column + (left - right) * d - j;
        for (int i = left == right ? j : 0; i < d; i++)
          block[i] += b0 * sums[i] + b1 * sums[d + i] + b2 * sums[2 * d + i];
      }
    }
  }
}
