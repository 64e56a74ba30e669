/* model/link_bodies.c - bodies of links: could each exist, and several as one.
 *
 * Parallel-axis theorem for two bodies with masses m, n and centres a, b: with d = b - a,
 *   mass = m + n,  centre = a + n/(m + n) d,
 *   I = I_m + I_n + m n/(m + n) (|d|^2 1 - d d^T)        about the common centre
 */
#include "model/model_check.h"

#include <math.h>

void ambulo__part_add(ambulo__part *whole, const ambulo__part *part) {
  if (whole->mass == 0) {
    *whole = *part;
    return;
  }
  double mass = whole->mass + part->mass, reduced = whole->mass * part->mass / mass;
  double d[3];
  for (int i = 0; i < 3; i++) d[i] = part->com[i] - whole->com[i];
  const double offset[6] = {d[1] * d[1] + d[2] * d[2],
                            d[0] * d[0] + d[2] * d[2],
                            d[0] * d[0] + d[1] * d[1],
                            -d[0] * d[1],
                            -d[0] * d[2],
                            -d[1] * d[2]};
  for (int i = 0; i < 6; i++) whole->inertia[i] += part->inertia[i] + reduced * offset[i];
  for (int i = 0; i < 3; i++) whole->com[i] += part->mass / mass * d[i];
  whole->mass = mass;
}

/* could this body exist?
 *
 * Inertia I about the centre of mass, [xx yy zz xy xz yz], kg m^2. With the second moments of
 * mass S = tr(I)/2 - I >= 0 (an integral of squares), the principal moments obey
 *   0 <= I1 <= I2 <= I3 <= I1 + I2.
 * Equality is legal (a thin rod, a flat plate, a point), so rounding needs a tolerance.
 */

static const double LEAST_MASS = 1e-9, LARGEST_MASS = 1e6; /* kg */
static const double LONGEST = 1e6, LARGEST_INERTIA = 1e12; /* m, kg m^2: squares stay finite */
static const double ROUNDING = 1e-9;                       /* relative to the largest moment */

static int within(const double *v, int count, double most) {
  for (int i = 0; i < count; i++) {
    if (!(fabs(v[i]) <= most)) return 0;
  }
  return 1;
}

/* One Jacobi rotation that clears a[p][q]. */
static void rotate(double a[3][3], int p, int q) {
  if (a[p][q] == 0) return;
  double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  double t = (theta >= 0 ? 1 : -1) / (fabs(theta) + sqrt(theta * theta + 1));
  double c = 1 / sqrt(t * t + 1), s = t * c;
  for (int k = 0; k < 3; k++) {
    double kp = a[k][p], kq = a[k][q];
    a[k][p] = c * kp - s * kq;
    a[k][q] = s * kp + c * kq;
  }
  for (int k = 0; k < 3; k++) {
    double pk = a[p][k], qk = a[q][k];
    a[p][k] = c * pk - s * qk;
    a[q][k] = s * pk + c * qk;
  }
}

static void order(double *low, double *high) {
  if (*low <= *high) return;
  double swap = *low;
  *low = *high;
  *high = swap;
}

void ambulo__principal_moments(const double in[6], double moments[3]) {
  double a[3][3] = {{in[0], in[3], in[4]}, {in[3], in[1], in[5]}, {in[4], in[5], in[2]}};
  /* cyclic Jacobi converges quadratically: 3x3 is done to rounding after 5 sweeps */
  for (int sweep = 0; sweep < 10; sweep++) {
    rotate(a, 0, 1);
    rotate(a, 0, 2);
    rotate(a, 1, 2);
  }
  for (int i = 0; i < 3; i++) moments[i] = a[i][i];
  order(&moments[0], &moments[1]);
  order(&moments[1], &moments[2]);
  order(&moments[0], &moments[1]);
}

/* a computed number as text, six digits */
static ambulo__number rounded(double value) {
  if (value == 0 || !isfinite(value)) return ambulo__number_text(value);
  double shift = pow(10, 5 - floor(log10(fabs(value))));
  double digits = round(value * shift);
  return ambulo__number_text(shift >= 1 && isfinite(shift) ? digits / shift : value);
}

static ambulo_status check_inertia(const char *what, const double inertia[6], ambulo__place place,
                                   ambulo_diagnostics *diagnostics) {
  double m[3];
  ambulo__principal_moments(inertia, m);
  double slack = ROUNDING * fabs(m[2]);
  if (m[0] < -slack || m[2] < 0) {
    return ambulo__error(diagnostics, AMBULO_E_MODEL, place, NULL,
                         "inertia of '%s' is not positive semidefinite (smallest eigenvalue %s "
                         "kg m^2); expected no negative eigenvalue",
                         what, rounded(m[0]).text);
  }
  if (m[2] > m[0] + m[1] + slack) {
    return ambulo__error(diagnostics, AMBULO_E_MODEL, place,
                         "no distribution of mass has such an inertia",
                         "inertia of '%s' breaks the triangle inequality (principal moments %s, "
                         "%s, %s kg m^2); expected the largest at most the sum of the others",
                         what, rounded(m[0]).text, rounded(m[1]).text, rounded(m[2]).text);
  }
  return AMBULO_OK;
}

ambulo_status ambulo__check_body(const char *what, double mass, const double com[3],
                                 const double inertia[6], ambulo__body_places places,
                                 ambulo_diagnostics *diagnostics) {
  if (!(mass >= LEAST_MASS && mass <= LARGEST_MASS)) {
    return ambulo__error(diagnostics, AMBULO_E_MODEL, places.mass, NULL,
                         "mass of '%s' is out of range (got %s kg); expected 1e-9 to 1e6 kg", what,
                         ambulo__number_text(mass).text);
  }
  if (!within(com, 3, LONGEST) || !within(inertia, 6, LARGEST_INERTIA)) {
    return ambulo__error(diagnostics, AMBULO_E_MODEL, places.inertia, NULL,
                         "centre of mass or inertia of '%s' is out of range; expected finite "
                         "numbers of at most 1e6 m and 1e12 kg m^2",
                         what);
  }
  return check_inertia(what, inertia, places.inertia, diagnostics);
}
