/* import/osim_functions.c - OpenSim's functions of one coordinate (osim.h).
 *
 *   Constant                         value
 *   LinearFunction                   slope x + offset
 *   PolynomialFunction               c0 x^n + ... + cn
 *   PiecewiseLinearFunction          between points, ends continued
 *   SimmSpline, NaturalCubicSpline   the spline of model/coupling.c
 *   MultiplierFunction               scale times another one
 */
#include <math.h>
#include <string.h>

#include "import/osim.h"

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

/* the points in pairs */
static ambulo__tree_function spline_of(ambulo__osim *o, const points *p) {
  double *pairs = ambulo__arena_take(o->tree->arena, 2 * (size_t)p->count, sizeof *pairs);
  for (int i = 0; pairs && i < p->count; i++) {
    pairs[2 * i] = p->x[i];
    pairs[2 * i + 1] = p->y[i];
  }
  return (ambulo__tree_function){.count = pairs ? p->count : 0, .points = pairs};
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
  if (kind == PIECEWISE) return piecewise(&p, x);
  ambulo__tree_function spline = spline_of(o, &p);
  return ambulo__function_value(o->tree, &spline, x);
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

/* ------------------------------------------------------------- as joints can have them */

/* c0 x^n + ... + cn; 0: of a degree above 4 */
static int read_polynomial(ambulo__osim *o, const ambulo__xml_node *function,
                           ambulo__tree_function *f) {
  double c[16] = {0.0};
  const ambulo__xml_node *node = ambulo__xml_child(function, "coefficients");
  int count = node ? ambulo__xml_numbers(o->xml, node, "the text", node->text, 16, 0, c) : 0;
  if (count > 16) return 0;
  for (int i = 0; i < count; i++) {
    int power = count - 1 - i;
    if (power >= AMBULO__COUPLING_TERMS && c[i] != 0.0) return 0;
    if (power < AMBULO__COUPLING_TERMS) f->polynomial[power] = c[i];
  }
  return 1;
}

static int function_of(ambulo__osim *o, const ambulo__xml_node *function, ambulo__tree_function *f,
                       int depth) {
  int kind = kind_of(o, function);
  double slope, offset;
  points p;
  *f = (ambulo__tree_function){0};
  if (kind == MULTIPLIER) {
    const ambulo__xml_node *inner = ambulo__osim_function(function);
    ambulo__tree_function whole, times = ambulo__tree_line(1.0, 0.0);
    (void)ambulo__xml_child_vector(o->xml, function, "scale", 1, 0, &times.polynomial[1]);
    if (!inner || depth >= MOST_NESTING || !function_of(o, inner, f, depth + 1)) return 0;
    if (!ambulo__function_of_function(o->tree, &times, f, &whole)) return 0;
    *f = whole;
    return 1;
  }
  if (kind == POLYNOMIAL) return read_polynomial(o, function, f);
  if (linear_of(o, function, &slope, &offset, depth)) {
    *f = ambulo__tree_line(slope, offset);
    return 1;
  }
  if (kind < 0 || kind == PIECEWISE || !read_points(o, function, &p)) return 0;
  if (p.count > AMBULO__MOST_KNOTS) return 0;
  *f = spline_of(o, &p);
  return f->count > 0;
}

int ambulo__osim_read_function(ambulo__osim *o, const ambulo__xml_node *function,
                               ambulo__tree_function *f) {
  return function_of(o, function, f, 0);
}
