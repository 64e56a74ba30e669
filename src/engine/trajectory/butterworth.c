/* trajectory/butterworth.c - zero-lag Butterworth filter (butterworth.h).
 *
 * One pass of order n by the bilinear transform, as a chain of sections; with the warped frequency
 * w = tan(pi f / rate) its gain is 1 / sqrt(1 + (w / W)^(2n)). A pass forward and one backward in
 * time have no phase shift and the square of that gain, which is to be 1/sqrt(2) at the cut-off:
 *
 *     W = tan(pi cutoff / rate) / C,    C = (sqrt(2) - 1)^(1 / 2n)
 *
 * C = 0.802 for n = 2: Winter, Biomechanics and Motor Control of Human Movement, 4th ed. 2009,
 * chapter 3. One section, from the poles s^2 + d s + 1 (d = 0.. for a single one s + 1):
 *
 *     y_k = b0 x_k + b1 x_k-1 + b2 x_k-2 - a1 y_k-1 - a2 y_k-2
 *
 * Edges: the signal is continued by its odd reflection, 2 x_0 - x_k, which keeps value and slope,
 * and by the reflections of that where it is short, until what a pass has made of its start has
 * decayed to 1e-7; each pass starts in the steady state of the first value. */
#include "trajectory/butterworth.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

enum { MOST_PADDING = 1000000 };

typedef struct section {
  double b0, b1, b2, a1, a2;
} section;

typedef struct filter {
  section sections[AMBULO__FILTER_MOST_ORDER / 4];
  int count;
  int padding; /* rows */
} filter;

static section second_order(double warped, double damping) {
  double square = warped * warped, scale = 1.0 / (1.0 + damping * warped + square);
  section s = {square * scale, 2.0 * square * scale, square * scale, 2.0 * (square - 1.0) * scale,
               (1.0 - damping * warped + square) * scale};
  return s;
}

static section first_order(double warped) {
  double scale = 1.0 / (1.0 + warped);
  section s = {warped * scale, warped * scale, 0.0, (warped - 1.0) * scale, 0.0};
  return s;
}

/* modulus of the section's larger pole: what remains of its start from one row to the next */
static double memory(const section *s) {
  double root = s->a1 * s->a1 - 4.0 * s->a2;
  return root < 0.0 ? sqrt(s->a2) : 0.5 * (fabs(s->a1) + sqrt(root));
}

/* (I.1) gain of both passes together */
static filter design(double rate, double cutoff, int order) {
  filter f = {.count = 0};
  int n = order / 2;
  double warped = tan(pi * cutoff / rate) / pow(sqrt(2.0) - 1.0, 0.5 / n), slowest = 0.0;
  for (int k = 0; 2 * k + 1 < n; k++)
    f.sections[f.count++] = second_order(warped, 2.0 * sin(pi * (2 * k + 1) / (2.0 * n)));
  if (n % 2) f.sections[f.count++] = first_order(warped);
  for (int i = 0; i < f.count; i++) slowest = fmax(slowest, memory(&f.sections[i]));
  double needed = slowest > 0.0 ? ceil(-16.0 / log(slowest)) + 1.0 : 1.0;
  f.padding = needed < MOST_PADDING ? (int)needed : MOST_PADDING;
  return f;
}

/* one section over x[count] in steps of `stride` (1 or -1) */
static void run(const section *s, double *x, int count, int stride) {
  double z1 = (1.0 - s->b0) * x[0], z2 = (s->b2 - s->a2) * x[0];
  for (int k = 0; k < count; k++) {
    double *at = x + (ptrdiff_t)k * stride, in = *at, out = s->b0 * in + z1;
    z1 = s->b1 * in - s->a1 * out + z2;
    z2 = s->b2 * in - s->a2 * out;
    *at = out;
  }
}

/* row k of x[0..last] and its odd reflections: x_k+2last = x_k + 2 (x_last - x_0); last >= 1 */
static double continued(const double *x, int last, int k) {
  int period = last > 0 ? 2 * last : 1, turns = k >= 0 ? k / period : -((period - 1 - k) / period);
  int at = k - turns * period;
  double within = at <= last ? x[at] : 2.0 * x[last] - x[period - at];
  return within + 2.0 * (double)turns * (x[last] - x[0]);
}

/* work [rows + 2 padding] */
static void filter_column(const filter *f, double *values, int rows, int columns, double *work) {
  int pad = f->padding, count = rows + 2 * pad;
  double *inside = work + pad;
  for (int k = 0; k < rows; k++) inside[k] = values[(size_t)k * (size_t)columns];
  for (int k = 1; k <= pad; k++) {
    inside[-k] = continued(inside, rows - 1, -k);
    inside[rows - 1 + k] = continued(inside, rows - 1, rows - 1 + k);
  }
  for (int i = 0; i < f->count; i++) run(&f->sections[i], work, count, 1);
  for (int i = 0; i < f->count; i++) run(&f->sections[i], work + count - 1, count, -1);
  for (int k = 0; k < rows; k++) values[(size_t)k * (size_t)columns] = inside[k];
}

ambulo_status ambulo__butterworth(double *values, int rows, int columns, double rate, double cutoff,
                                  int order, const ambulo_allocator *allocator) {
  if (!values || rows < 2 || columns < 0 || !(cutoff > 0.0 && cutoff < 0.5 * rate) ||
      !isfinite(rate) || order < 2 || order > AMBULO__FILTER_MOST_ORDER || order % 2)
    return AMBULO_E_ARGUMENT;
  filter f = design(rate, cutoff, order);
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  double *work = ambulo__alloc(&own, (size_t)rows + 2 * (size_t)f.padding, sizeof *work);
  if (!work) return AMBULO_E_MEMORY;
  for (int c = 0; c < columns; c++) filter_column(&f, values + c, rows, columns, work);
  ambulo__free(&own, work);
  return AMBULO_OK;
}
