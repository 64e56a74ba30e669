/* bench/bench_factor.c - what the linear algebra of a solve costs.
 *
 * The metric of a problem with d coordinates on N intervals is a symmetric band matrix of order
 * d (N + 3) and half-bandwidth 4 d - 1 (a node touches four neighbouring control points). Times of
 * its Cholesky factor and of one solve with it (linear/band.h) for d = 6 ... 55 at N = 72 and for
 * N = 12 ... 576 at d = 18, the powers of d and of N they grow with, the rate of the
 * factorization (about order * (half-bandwidth)^2 operations), and how many times as long LAPACK
 * takes (dpbtrf, and dtbsv twice), in turns. The band is full here; that of a problem ends with
 * whole control points, and its factor takes a sixth to a quarter less.
 *
 * Also the forward solves of 3 d border columns, and the Gram matrix of a node: 2 d rows of which
 * half is zero, on splines of degree 3 (linear/band.h). */
#include "mechanics/plan.h"
#include "base/lapack.h"
#include "bench_csv.h"
#include "linear/band.h"

#include <stddef.h>

enum { repeats = 15, span = 4 };

typedef struct times {
  double factor, solve, border, node;
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

/* half of a row in blocks of d / 3: limbs */
static void fill_rows(int d, double *rows) {
  int stride = ambulo__whole_tiles(AMBULO__ORDERS * d);
  for (int r = 0; r < 2 * d; r++) {
    for (int j = 0; j < AMBULO__ORDERS * d; j++)
      rows[r * stride + j] = j / (d / 3) % 2 == r % 2 ? 0.0 : sin(r + 0.3 * j);
  }
}

/* columns [order rounded up][3 d, in tiles]; rows [2 d][3 d, in tiles] */
static void measure_many(ambulo__band *band, int d, double *columns, double *rows, times *spent) {
  static const double weight[span] = {0.04, 0.46, 0.46, 0.04};
  static const double *const b[] = {weight, weight, weight};
  ambulo__pool pool;
  ambulo__spread spread;
  int width = ambulo__whole_tiles(3 * d);
  for (int k = 0; k < band->n * width; k++) columns[k] = sin(k);
  fill_rows(d, rows);
  ambulo__pool_init(&pool, NULL);
  if (ambulo__spread_create(&pool, d, &spread)) exit(1);
  double start = bench_seconds();
  ambulo__band_forward_many(band, width, columns);
  double solved = bench_seconds();
  ambulo__spread_rows(&spread, 2 * d, width, rows, span, b, 0, band);
  spent->node = bench_seconds() - solved;
  spent->border = solved - start;
  ambulo__pool_clear(&pool);
}

static times measure(ambulo__band *band, int d, double *right, double *columns, double *rows) {
  times spent;
  fill(band, right);
  double start = bench_seconds();
  if (ambulo__band_factor(band)) exit(1);
  double factored = bench_seconds();
  ambulo__band_forward(band, right);
  ambulo__band_backward(band, right);
  spent.solve = bench_seconds() - factored;
  spent.factor = factored - start;
  measure_many(band, d, columns, rows, &spent);
  return spent;
}

/* factor and solve by LAPACK */
static times measure_lapack(ambulo__band *band, double *right) {
  times spent = {0};
  int info, step = 1;
  fill(band, right);
  double start = bench_seconds();
  dpbtrf_("L", &band->n, &band->kd, band->a, &band->ld, &info);
  double factored = bench_seconds();
  dtbsv_("L", "N", "N", &band->n, &band->kd, band->a, &band->ld, right, &step);
  dtbsv_("L", "T", "N", &band->n, &band->kd, band->a, &band->ld, right, &step);
  spent.solve = bench_seconds() - factored;
  spent.factor = factored - start;
  if (info) exit(1);
  return spent;
}

/* the median of what runs spent on a part, offset as in struct times */
static double median_of(const times *run, size_t offset) {
  double part[repeats];
  for (int t = 0; t < repeats; t++)
    memcpy(&part[t], (const char *)(run + t) + offset, sizeof *part);
  return bench_median(part, repeats);
}

static times median_times(const times *run) {
  return (times){median_of(run, offsetof(times, factor)), median_of(run, offsetof(times, solve)),
                 median_of(run, offsetof(times, border)), median_of(run, offsetof(times, node))};
}

static void put(bench_table *table, const char *what, int d, int intervals, const char *unit,
                double value) {
  char quantity[bench_key];
  (void)snprintf(quantity, sizeof quantity, "%s %d coordinates at N = %d", what, d, intervals);
  bench_put(table, quantity, unit, value);
}

static times report(bench_table *table, int d, int intervals) {
  times run[2][repeats];
  ambulo__pool pool;
  ambulo__band band[2];
  ambulo__pool_init(&pool, NULL);
  int order = d * (intervals + 3), kd = 4 * d - 1, width = ambulo__whole_tiles(3 * d);
  double *right = ambulo__pool_doubles(&pool, (size_t)order);
  double *columns = ambulo__pool_doubles(&pool, (size_t)(ambulo__whole_tiles(order) * width));
  double *rows = ambulo__pool_doubles(&pool, (size_t)(2 * d * width));
  for (int k = 0; k < 2; k++) {
    if (!right || !columns || !rows || ambulo__band_create(&pool, order, kd, &band[k])) exit(1);
  }
  for (int t = 0; t < repeats; t++) {
    run[0][t] = measure(&band[0], d, right, columns, rows);
    run[1][t] = measure_lapack(&band[1], right);
  }
  ambulo__pool_clear(&pool);
  times own = median_times(run[0]), lapack = median_times(run[1]);
  put(table, "factor of", d, intervals, "us", 1e6 * own.factor);
  put(table, "rate of", d, intervals, "Gflop/s", 1e-9 * order * (double)kd * kd / own.factor);
  put(table, "solve with", d, intervals, "us", 1e6 * own.solve);
  put(table, "border of", d, intervals, "us", 1e6 * own.border);
  put(table, "node of", d, intervals, "us", 1e6 * own.node);
  printf("%-44s factor %.2f x, solve %.2f x\n", "  LAPACK", lapack.factor / own.factor,
         lapack.solve / own.solve);
  return own;
}

int main(void) {
  static const int sizes[] = {6, 12, 18, 30, 42, 55}, grids[] = {12, 36, 72, 144, 288, 576};
  enum { count = sizeof sizes / sizeof *sizes };
  double d[count], n[count], factor[2][count], solve[2][count];
  static bench_table table;
  bench_open(&table, ambulo__instruction_set(), "factor");
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
