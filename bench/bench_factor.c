/* bench/bench_factor.c - what the linear algebra of a solve costs.
 *
 * The metric of a problem with d coordinates on N intervals is a symmetric band matrix of order
 * d (N + 3) and half-bandwidth 4 d - 1 (a node touches four neighbouring control points). Times of
 * its Cholesky factor and of one solve with it (linear/band.h) for d = 6 ... 55 at N = 72 and for
 * N = 12 ... 576 at d = 18, the powers of d and of N they grow with, the rate of the
 * factorization (about order * (half-bandwidth)^2 operations), and how many times as long LAPACK
 * takes (dpbtrf, and dtbsv twice), in turns. */
#include "bench_csv.h"
#include "linear/band.h"

enum { repeats = 15 };

typedef struct times {
  double factor, solve;
} times;

/* Diagonally dominant. */
static void fill(ambulo__band *band, double *right) {
  ambulo__band_clear(band);
  for (int column = 0; column < band->n; column++) {
    double *at = band->a + (size_t)column * (size_t)band->ld;
    at[0] = 2.5;
    for (int k = 1; k <= band->kd && column + k < band->n; k++)
      at[k] = sin(0.7 * column + k) / band->kd;
    right[column] = cos(column);
  }
}

static times measure(ambulo__band *band, double *right) {
  times spent;
  fill(band, right);
  double start = bench_seconds();
  if (ambulo__band_factor(band)) exit(1);
  double factored = bench_seconds();
  ambulo__band_forward(band, right);
  ambulo__band_backward(band, right);
  spent.solve = bench_seconds() - factored;
  spent.factor = factored - start;
  return spent;
}

static times report(bench_table *table, int d, int intervals) {
  double factor[2][repeats], solve[2][repeats];
  char quantity[bench_key];
  ambulo__pool pool;
  ambulo__band band[2];
  ambulo__pool_init(&pool, NULL);
  int order = d * (intervals + 3), width = 4 * d - 1;
  double *right = ambulo__pool_doubles(&pool, (size_t)order);
  for (int k = 0; k < 2; k++) {
    if (!right || ambulo__band_create(&pool, order, width, &band[k])) exit(1);
  }
  band[1].kernels = NULL; /* LAPACK */
  for (int t = 0; t < repeats; t++) {
    for (int k = 0; k < 2; k++) {
      times spent = measure(&band[k], right);
      factor[k][t] = spent.factor;
      solve[k][t] = spent.solve;
    }
  }
  ambulo__pool_clear(&pool);
  times own = {bench_median(factor[0], repeats), bench_median(solve[0], repeats)};
  times lapack = {bench_median(factor[1], repeats), bench_median(solve[1], repeats)};
  (void)snprintf(quantity, sizeof quantity, "factor of %d coordinates at N = %d", d, intervals);
  bench_put(table, quantity, "us", 1e6 * own.factor);
  (void)snprintf(quantity, sizeof quantity, "rate of %d coordinates at N = %d", d, intervals);
  bench_put(table, quantity, "Gflop/s", 1e-9 * order * (double)width * width / own.factor);
  (void)snprintf(quantity, sizeof quantity, "solve with %d coordinates at N = %d", d, intervals);
  bench_put(table, quantity, "us", 1e6 * own.solve);
  printf("%-44s factor %.2f x, solve %.2f x\n", "  LAPACK", lapack.factor / own.factor,
         lapack.solve / own.solve);
  return own;
}

int main(void) {
  static const int sizes[] = {6, 12, 18, 30, 42, 55}, grids[] = {12, 36, 72, 144, 288, 576};
  enum { count = sizeof sizes / sizeof *sizes };
  double d[count], n[count], factor[2][count], solve[2][count];
  static bench_table table;
  bench_open(&table, ambulo_instruction_set(), "factor");
  for (int i = 0; i < count; i++) {
    times by_size = report(&table, sizes[i], 72), by_grid = report(&table, 18, grids[i]);
    d[i] = sizes[i];
    n[i] = grids[i] + 3;
    factor[0][i] = by_size.factor;
    solve[0][i] = by_size.solve;
    factor[1][i] = by_grid.factor;
    solve[1][i] = by_grid.solve;
  }
  bench_put(&table, "power of the coordinates of a factor", "-", bench_power(d, factor[0], count));
  bench_put(&table, "power of the coordinates of a solve", "-", bench_power(d, solve[0], count));
  bench_put(&table, "power of N + 3 of a factor", "-", bench_power(n, factor[1], count));
  bench_put(&table, "power of N + 3 of a solve", "-", bench_power(n, solve[1], count));
  bench_close(&table);
  return 0;
}
