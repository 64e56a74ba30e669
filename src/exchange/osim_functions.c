/* exchange/osim_functions.c - OpenSim's functions of one coordinate (osim.h).
 *
 *   Constant                         value
 *   LinearFunction                   slope x + offset
 *   PolynomialFunction               c0 x^n + ... + cn
 *   PiecewiseLinearFunction          between points, ends continued
 *   SimmSpline, NaturalCubicSpline   the cubic spline below, ends continued as straight lines
 *   MultiplierFunction               scale times another one
 *
 * The cubic spline through (x_i, y_i) with steps h_i = x_(i+1) - x_i and slopes of chords
 * m_i = (y_(i+1) - y_i)/h_i has second derivatives 6 s_i with
 *
 *     h_(i-1) s_(i-1) + 2 (h_(i-1) + h_i) s_i + h_i s_(i+1) = m_i - m_(i-1)
 *
 * and is closed at both ends by the third derivative of the cubic through the four points there
 * (Forsythe, Malcolm & Moler 1977), 6 times its third divided difference D:
 *
 *     s_1 - s_0 = h_0 D_0,      s_n - s_(n-1) = h_(n-1) D_n
 *
 * Three points: a parabola (both differences are zero). Two: the line.
 */
#include <math.h>
#include <string.h>

#include "exchange/osim.h"

enum { MOST_POINTS = 4096, MOST_NESTING = 8 };

const ambulo__xml_node *ambulo__osim_function(const ambulo__xml_node *holder) {
  const ambulo__xml_node *inner = ambulo__xml_child(holder, "function");
  if (inner && inner->first) return inner->first;
  for (const ambulo__xml_node *n = holder ? holder->first : NULL; n; n = n->next) {
    size_t length = strlen(n->name);
    if (length > 8 && strcmp(n->name + length - 8, "Function") == 0) return n;
    if (length > 6 && strcmp(n->name + length - 6, "Spline") == 0) return n;
    if (strcmp(n->name, "Constant") == 0) return n;
  }
  return NULL;
}

/* ------------------------------------------------------------------------- points */

typedef struct points {
  double *x, *y;
  int count;
} points;

/* the numbers of <x> and <y>; 0 after an error */
static int read_points(ambulo__osim *o, const ambulo__xml_node *function, points *p) {
  const ambulo__xml_node *x = ambulo__xml_child(function, "x");
  const ambulo__xml_node *y = ambulo__xml_child(function, "y");
  p->x = ambulo__arena_take(o->tree->arena, 2 * MOST_POINTS, sizeof *p->x);
  p->y = p->x ? p->x + MOST_POINTS : NULL;
  if (!p->x) return 0;
  p->count = x ? ambulo__xml_numbers(o->xml, x, "x", x->text, MOST_POINTS, 0, p->x) : 0;
  int ys = y ? ambulo__xml_numbers(o->xml, y, "y", y->text, MOST_POINTS, 0, p->y) : 0;
  if (p->count < 0 || ys < 0) return 0;
  int rising = p->count == ys && p->count >= 2 && p->count <= MOST_POINTS;
  for (int i = 0; rising && i + 1 < p->count; i++) rising = p->x[i] < p->x[i + 1];
  if (!rising)
    ambulo__xml_error(
        o->xml, function, AMBULO_E_SCHEMA, NULL,
        "<%s> has %d x and %d y; expected as many of both, two or more, with x rising",
        function->name, p->count, ys);
  return rising;
}

static int segment_of(const points *p, double x) {
  int i = 0;
  while (i + 2 < p->count && x >= p->x[i + 1]) i++;
  return i;
}

static double piecewise(const points *p, double x) {
  int i = segment_of(p, x);
  double slope = (p->y[i + 1] - p->y[i]) / (p->x[i + 1] - p->x[i]);
  return p->y[i] + slope * (x - p->x[i]);
}

/* third divided difference of the points i .. i + 3; 0 where there are not so many */
static double third(const points *p, int i) {
  double d[4];
  if (p->count < 4) return 0.0;
  for (int k = 0; k < 4; k++) d[k] = p->y[i + k];
  for (int order = 1; order < 4; order++)
    for (int k = 0; k + order < 4; k++)
      d[k] = (d[k + 1] - d[k]) / (p->x[i + k + order] - p->x[i + k]);
  return d[0];
}

/* s[0 .. count): a sixth of the second derivatives, by elimination from the top; work[count] */
static void curvatures(const points *p, double *s, double *work) {
  int n = p->count - 1;
  double h = p->x[1] - p->x[0];
  /* -s_0 + s_1 = h_0 D_0, times h_0 to be symmetric */
  double diagonal = -h;
  s[0] = h * h * third(p, 0);
  work[0] = h / diagonal;
  s[0] /= diagonal;
  for (int i = 1; i <= n; i++) {
    double before = p->x[i] - p->x[i - 1], right;
    if (i < n) {
      double behind = p->x[i + 1] - p->x[i];
      diagonal = 2.0 * (before + behind);
      right = (p->y[i + 1] - p->y[i]) / behind - (p->y[i] - p->y[i - 1]) / before;
      h = behind;
    } else { /* s_(n-1) - s_n = -h D_n */
      diagonal = -before;
      right = -before * before * third(p, n - 3);
    }
    double pivot = diagonal - before * work[i - 1];
    work[i] = h / pivot;
    s[i] = (right - before * s[i - 1]) / pivot;
  }
  for (int i = n - 1; i >= 0; i--) s[i] -= work[i] * s[i + 1];
}

static double cubic(ambulo__osim *o, const points *p, double x) {
  double *s = ambulo__arena_take(o->tree->arena, 2 * (size_t)p->count, sizeof *s);
  if (!s || p->count < 3) return piecewise(p, x);
  curvatures(p, s, s + p->count);
  int n = p->count - 1, i = segment_of(p, x);
  double h = p->x[i + 1] - p->x[i], chord = (p->y[i + 1] - p->y[i]) / h;
  if (x < p->x[0]) return p->y[0] + (x - p->x[0]) * (chord - h * (s[1] + 2.0 * s[0]));
  if (x > p->x[n]) return p->y[n] + (x - p->x[n]) * (chord + h * (s[n - 1] + 2.0 * s[n]));
  double t = x - p->x[i];
  return p->y[i] +
         t * (chord - h * (s[i + 1] + 2.0 * s[i]) + t * (3.0 * s[i] + t * (s[i + 1] - s[i]) / h));
}

/* ---------------------------------------------------------------------- functions */

enum { CONSTANT, LINEAR, POLYNOMIAL, PIECEWISE, SIMM, NATURAL, MULTIPLIER, KINDS };

static int kind_of(ambulo__osim *o, const ambulo__xml_node *function) {
  static const char *const names[KINDS] = {
      "Constant",   "LinearFunction",     "PolynomialFunction", "PiecewiseLinearFunction",
      "SimmSpline", "NaturalCubicSpline", "MultiplierFunction"};
  return ambulo__xml_choice(o->xml, function, "function", function->name, names, KINDS);
}

static double polynomial(const double *c, int count, double x) {
  double value = 0.0;
  for (int i = 0; i < count; i++) value = value * x + c[i];
  return value;
}

static double value_of(ambulo__osim *o, const ambulo__xml_node *function, double x, int depth) {
  int kind = kind_of(o, function);
  double c[16] = {0.0};
  points p;
  if (kind == CONSTANT) {
    (void)ambulo__xml_child_vector(o->xml, function, "value", 1, 0, c);
    return c[0];
  }
  if (kind == LINEAR) {
    c[0] = 1.0;
    (void)ambulo__xml_child_vector(o->xml, function, "coefficients", 2, 0, c);
    return c[0] * x + c[1];
  }
  if (kind == POLYNOMIAL) {
    const ambulo__xml_node *node = ambulo__xml_child(function, "coefficients");
    int count = node ? ambulo__xml_numbers(o->xml, node, "the text", node->text, 16, 0, c) : 0;
    return polynomial(c, count > 16 ? 16 : count, x);
  }
  if (kind == MULTIPLIER) {
    const ambulo__xml_node *inner = ambulo__osim_function(function);
    c[0] = 1.0;
    (void)ambulo__xml_child_vector(o->xml, function, "scale", 1, 0, c);
    return inner && depth < MOST_NESTING ? c[0] * value_of(o, inner, x, depth + 1) : 0.0;
  }
  if (kind < 0 || !read_points(o, function, &p)) return 0.0;
  return kind == PIECEWISE ? piecewise(&p, x) : cubic(o, &p, x);
}

double ambulo__osim_value(ambulo__osim *o, const ambulo__xml_node *function, double x) {
  return value_of(o, function, x, 0);
}

double ambulo__osim_travel(ambulo__osim *o, const ambulo__xml_node *function, double scale,
                           const ambulo__xml_node *coordinate, double x, double from) {
  enum { SAMPLES = 64 };
  double range[2] = {x, x}, most = 0.0;
  (void)ambulo__xml_child_vector(o->xml, coordinate, "range", 2, 1, range);
  for (int i = 0; i <= SAMPLES; i++) {
    double at = range[0] + (range[1] - range[0]) * i / SAMPLES;
    if (isfinite(at)) most = fmax(most, fabs(scale * ambulo__osim_value(o, function, at) - from));
  }
  return most;
}

/* whether all points are on the line through the first and the last, but for what is printed */
static int on_a_line(const points *p, double *slope, double *offset) {
  int n = p->count - 1;
  *slope = (p->y[n] - p->y[0]) / (p->x[n] - p->x[0]);
  *offset = p->y[0] - *slope * p->x[0];
  double size = fmax(fabs(p->y[0]), fabs(p->y[n]));
  for (int i = 0; i <= n; i++) {
    if (fabs(p->y[i] - (*slope * p->x[i] + *offset)) > 1e-9 * size) return 0;
  }
  if (fabs(*offset) <= 1e-12 * size) *offset = 0.0;
  if (fabs(fabs(*slope) - 1.0) <= 1e-12) *slope = copysign(1.0, *slope);
  return 1;
}

static int linear_of(ambulo__osim *o, const ambulo__xml_node *function, double *slope,
                     double *offset, int depth) {
  int kind = kind_of(o, function);
  points p;
  if (kind == CONSTANT || kind == LINEAR) {
    *offset = ambulo__osim_value(o, function, 0.0);
    double c[2] = {1.0, 0.0};
    if (kind == LINEAR) (void)ambulo__xml_child_vector(o->xml, function, "coefficients", 2, 0, c);
    *slope = kind == LINEAR ? c[0] : 0.0;
    return 1;
  }
  if (kind == MULTIPLIER) {
    const ambulo__xml_node *inner = ambulo__osim_function(function);
    double scale = 1.0;
    (void)ambulo__xml_child_vector(o->xml, function, "scale", 1, 0, &scale);
    if (!inner || depth >= MOST_NESTING || !linear_of(o, inner, slope, offset, depth + 1)) return 0;
    *slope *= scale;
    *offset *= scale;
    return 1;
  }
  if (kind == POLYNOMIAL || kind < 0 || !read_points(o, function, &p)) return 0;
  return on_a_line(&p, slope, offset);
}

int ambulo__osim_is_linear(ambulo__osim *o, const ambulo__xml_node *function, double *slope,
                           double *offset) {
  return linear_of(o, function, slope, offset, 0);
}
