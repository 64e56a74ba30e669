/* import/side_differences.c - how much left and right of a body differ (symmetrize.h). */
#include "import/symmetrize.h"

#include "base/arithmetic.h"

#include <math.h>
#include <string.h>

/* how far apart left and right may be: m, of the body's size; masses, centres of mass and
 * inertias of their own, or of what they are to the whole body */
static const double mass_limit = 0.1, inertia_limit = 0.25, axis_limit = 0.09,
                    whole_mass_limit = 0.005, whole_inertia_limit = 1e-4;

int ambulo__side_moves(const ambulo__sides *s, int i) {
  return s->tree->links[i].type != AMBULO_FIXED;
}

void ambulo__reflect(const ambulo__sides *s, const double v[3], double out[3]) {
  double across = 2.0 * ambulo__dot(v, s->axes[1]);
  for (int i = 0; i < 3; i++) out[i] = v[i] - across * s->axes[1][i];
}

void ambulo__reflect_inertia(const ambulo__sides *s, const double inertia[6], double out[6]) {
  double h[3][3];
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) h[i][k] = (i == k) - 2.0 * s->axes[1][i] * s->axes[1][k];
  ambulo__inertia_turn((const double(*)[3])h, inertia, out);
}

/* the image of j's axis, with the sign that takes it nearer to i's */
void ambulo__image_of_axis(const ambulo__sides *s, int i, int j, double image[3], double *sign) {
  double kind = s->tree->links[i].type == AMBULO_REVOLUTE ? -1.0 : 1.0;
  ambulo__reflect(s, s->axis[j], image);
  *sign = kind * ambulo__dot(image, s->axis[i]) < 0.0 ? -1.0 : 1.0;
  for (int k = 0; k < 3; k++) image[k] *= kind * *sign;
}

/* p_i - H p_j; of a hinge the part across its axis, of a slider nothing */
void ambulo__sides_away(const ambulo__sides *s, int i, int j, const double axis[3], double d[3]) {
  ambulo__reflect(s, s->place[j].p, d);
  for (int k = 0; k < 3; k++) d[k] = s->place[i].p[k] - d[k];
  if (s->tree->links[i].type == AMBULO_PRISMATIC) memset(d, 0, 3 * sizeof *d);
  if (s->tree->links[i].type != AMBULO_REVOLUTE) return;
  double along = ambulo__dot(d, axis);
  for (int k = 0; k < 3; k++) d[k] -= along * axis[k];
}

static double length(const double v[3]) {
  return sqrt(ambulo__dot(v, v));
}

double ambulo__largest_entry(const double inertia[6]) {
  double most = 0.0;
  for (int k = 0; k < 6; k++) most = fmax(most, fabs(inertia[k]));
  return most;
}

void ambulo__sides_differ(const ambulo__sides *s, int i, int j, double d[AMBULO__SIDE_KINDS]) {
  double image[3], sign, apart[3], turned[6];
  const ambulo__part *a = &s->body[i], *b = &s->body[j];
  ambulo__image_of_axis(s, i, j, image, &sign);
  ambulo__sides_away(s, i, j, s->axis[i], apart);
  d[AMBULO__SIDE_PLACE] = length(apart);
  for (int k = 0; k < 3; k++) apart[k] = s->axis[i][k] - image[k];
  d[AMBULO__SIDE_AXIS] = ambulo__side_moves(s, i) ? length(apart) : 0.0;
  d[AMBULO__SIDE_MASS] = fabs(a->mass - b->mass);
  ambulo__reflect(s, b->com, apart);
  for (int k = 0; k < 3; k++) apart[k] -= a->com[k];
  d[AMBULO__SIDE_CENTER] = a->mass > 0.0 && b->mass > 0.0 ? length(apart) : 0.0;
  ambulo__reflect_inertia(s, b->inertia, turned);
  for (int k = 0; k < 6; k++) turned[k] -= a->inertia[k];
  d[AMBULO__SIDE_INERTIA] = ambulo__largest_entry(turned);
  if (i != j) return; /* how far off the middle */
  d[AMBULO__SIDE_PLACE] *= 0.5;
  d[AMBULO__SIDE_CENTER] *= 0.5;
}

/* what is too much: NULL, or which */
static const char *too_far(const ambulo__sides *s, int i, int j, const double d[AMBULO__SIDE_KINDS],
                           double *limit) {
  double mass = 0.5 * (s->body[i].mass + s->body[j].mass);
  double inertia =
      fmax(ambulo__largest_entry(s->body[i].inertia), ambulo__largest_entry(s->body[j].inertia));
  double limits[AMBULO__SIDE_KINDS] = {
      [AMBULO__SIDE_PLACE] = s->near,
      [AMBULO__SIDE_MASS] = fmax(mass_limit * mass, whole_mass_limit * s->mass),
      [AMBULO__SIDE_CENTER] = fmax(1.0, whole_mass_limit * s->mass / fmax(mass, 1e-9)) * s->near,
      [AMBULO__SIDE_INERTIA] =
          fmax(inertia_limit * inertia, whole_inertia_limit * s->mass * s->size * s->size),
      [AMBULO__SIDE_AXIS] = axis_limit};
  static const char *const names[AMBULO__SIDE_KINDS] = {"m between joints", "kg",
                                                        "m between centres of mass", "kg m^2",
                                                        "between unit vectors along their axes"};
  for (int k = 0; k < AMBULO__SIDE_KINDS; k++) {
    *limit = limits[k];
    if (d[k] > limits[k]) return names[k];
  }
  return NULL;
}

static int same_tree(const ambulo__sides *s, int i, int j) {
  const ambulo__tree *t = s->tree;
  int above = t->links[i].parent, other = t->links[j].parent;
  if (above < 0 || other < 0) return above == other;
  above = ambulo__tree_leader(t, above);
  other = ambulo__tree_leader(t, other);
  return s->partner[above] < 0 ? above == other : s->partner[above] == other;
}

static void refuse(const ambulo__sides *s, int i, int j, const char *what, double value,
                   double limit) {
  const ambulo__tree_link *a = &s->tree->links[i], *b = &s->tree->links[j];
  ambulo__xml_error(s->tree->xml, a->node, AMBULO_E_MODEL, NULL,
                    "--symmetrize: '%.60s' and %s'%.60s' differ too much (got %s %s); expected at "
                    "most %s",
                    a->name, i == j ? "its own image " : "", b->name,
                    ambulo__three_digits(value).text, what, ambulo__three_digits(limit).text);
}

/* checks all pairs and keeps the largest difference of each kind */
void ambulo__sides_compare(ambulo__sides *s) {
  for (int i = 0; i < s->count; i++) {
    int j = s->partner[i];
    double d[AMBULO__SIDE_KINDS], limit, image[3];
    if (j < i) continue;
    ambulo__image_of_axis(s, i, j, image, &s->sign[i]);
    s->sign[j] = s->sign[i];
    if (!same_tree(s, i, j) || s->tree->links[i].type != s->tree->links[j].type) {
      ambulo__xml_error(s->tree->xml, s->tree->links[i].node, AMBULO_E_MODEL, NULL,
                        "--symmetrize: '%.60s' and '%.60s' are no images (they hang on different "
                        "links, or move in different ways); expected the same joints on both sides",
                        s->tree->links[i].name, s->tree->links[j].name);
      continue;
    }
    ambulo__sides_differ(s, i, j, d);
    const char *what = too_far(s, i, j, d, &limit);
    for (int k = 0; k < AMBULO__SIDE_KINDS && what; k++)
      if (d[k] > limit) {
        refuse(s, i, j, what, d[k], limit);
        break;
      }
    for (int k = 0; k < AMBULO__SIDE_KINDS; k++)
      if (d[k] > s->worst[k].value) s->worst[k] = (ambulo__difference){d[k], i, j};
  }
}
