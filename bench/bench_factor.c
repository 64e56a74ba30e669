/* bench/bench_factor.c - what the linear algebra of a solve costs.
 *
 * The metric of a problem with d coordinates on N intervals is a symmetric band matrix of order
 * d (N + 3) and half-bandwidth 4 d - 1 (a node touches four neighbouring control points). Times of
 * its Cholesky factor (LAPACK's dpbtrf) and of one solve with it (dpbtrs) for d = 6 ... 55 at
 * N = 72 and for N = 12 ... 576 at d = 18, the powers of d and of N they grow with, and the rate
 * of the factorization: about order * (half-bandwidth)^2 operations. */
#include "base/lapack.h"
#include "bench_csv.h"

enum { repeats = 7 };

/* Diagonally dominant, lower band storage. */
static void fill(double *band, int order, int width) {
  for (int column = 0; column < order; column++) {
    double *at = band + (size_t)column * (size_t)(width + 1);
    at[0] = 2.5;
    for (int k = 1; k <= width; k++) at[k] = sin(0.7 * column + k) / width;
  }
}

static double report(bench_table *table, int d, int intervals, double *solve) {
  int order = d * (intervals + 3), width = 4 * d - 1, rows = width + 1, one = 1, info = 0;
  double factor_times[repeats], solve_times[repeats];
  double *band = malloc((size_t)order * (size_t)rows * sizeof *band);
  double *right = malloc((size_t)order * sizeof *right);
  char quantity[bench_key];
  if (!band || !right) exit(1);
  for (int t = 0; t < repeats; t++) {
    fill(band, order, width);
    for (int i = 0; i < order; i++) right[i] = cos(i);
    double start = bench_seconds();
    dpbtrf_("L", &order, &width, band, &rows, &info);
    double factored = bench_seconds();
    dpbtrs_("L", &order, &width, &one, band, &rows, right, &order, &info);
    solve_times[t] = bench_seconds() - factored;
    factor_times[t] = factored - start;
    if (info) exit(1);
  }
  free(band);
  free(right);
  double time = bench_median(factor_times, repeats);
  *solve = bench_median(solve_times, repeats);
  (void)snprintf(quantity, sizeof quantity, "factor of %d coordinates at N = %d", d, intervals);
  bench_put(table, quantity, "us", 1e6 * time);
  (void)snprintf(quantity, sizeof quantity, "rate of %d coordinates at N = %d", d, intervals);
  bench_put(table, quantity, "Gflop/s", 1e-9 * order * (double)width * width / time);
  (void)snprintf(quantity, sizeof quantity, "solve with %d coordinates at N = %d", d, intervals);
  bench_put(table, quantity, "us", 1e6 * *solve);
  return time;
}

int main(void) {
  static const int sizes[] = {6, 12, 18, 30, 42, 55}, grids[] = {12, 36, 72, 144, 288, 576};
  enum { count = sizeof sizes / sizeof *sizes };
  double d[count], n[count], factor[2][count], solve[2][count];
  bench_table table;
  bench_open(&table, ambulo_instruction_set(), "factor");
  for (int i = 0; i < count; i++) {
    d[i] = sizes[i];
    factor[0][i] = report(&table, sizes[i], 72, &solve[0][i]);
  }
  for (int i = 0; i < count; i++) {
    n[i] = grids[i] + 3;
    factor[1][i] = report(&table, 18, grids[i], &solve[1][i]);
  }
  bench_put(&table, "power of the coordinates of a factor", "-", bench_power(d, factor[0], count));
  bench_put(&table, "power of the coordinates of a solve", "-", bench_power(d, solve[0], count));
  bench_put(&table, "power of N + 3 of a factor", "-", bench_power(n, factor[1], count));
  bench_put(&table, "power of N + 3 of a solve", "-", bench_power(n, solve[1], count));
  bench_close(&table);
  return 0;
}
