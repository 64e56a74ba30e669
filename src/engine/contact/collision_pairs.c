/* contact/collision_pairs.c - which capsules are kept apart.
 *
 * Automatic mode takes all pairs but three kinds: those of neighbouring links
 * (model/model_query.h), which overlap at their joint; those that overlap in the rest pose and have
 * a neighbour in common, such as trunk and thigh, whose rows could never hold; and those too far
 * apart to meet, which stay `far` apart in all POSES poses. With mirrored ends the mirror image of
 * each kept pair is kept too.
 *
 * Coordinates of the poses are within their ranges, or anywhere if ranges have no rows. The poses
 * are the same in every run: coordinate i takes the radical inverse of the pose's number in the
 * i-th prime (Halton, Numer Math 2:84-90, 1960).
 */
#include "contact/row_families.h"
#include "base/arithmetic.h"
#include "contact/curved.h"
#include "mechanics/pose.h"
#include "model/model_query.h"

#include <math.h>
#include <string.h>

enum { POSES = 1024, FIRST_POSE = 20 };
static const double far = 0.1;            /* m, of a body of 1.75 m */
static const double half_turn = 3.141593; /* rad, where there is no range */
static const double exact = 1e-9;         /* m^2, weights of a distance */
static const double millimetre = 1e-3, rounding = 1e-6;

/* ------------------------------------------------------------------ distance */

double ambulo__capsules_gap(const ambulo__pose *pose, ambulo_capsule_pair pair) {
  const ambulo_capsule *capsule[2] = {&pose->model->capsules[pair.one],
                                      &pose->model->capsules[pair.other]};
  double ends[2][2][3], weight[2] = {exact, exact};
  for (int c = 0; c < 2; c++) {
    ambulo__pose_point(pose, capsule[c]->link, capsule[c]->from, ends[c][0]);
    ambulo__pose_point(pose, capsule[c]->link, capsule[c]->to, ends[c][1]);
  }
  double square = ambulo__segments_nearest(ends[0], ends[1], weight).value;
  return sqrt(square) - capsule[0]->radius - capsule[1]->radius;
}

/* all coordinates 0, or as near as their ranges let them */
static void rest(const ambulo_model *m, double *q) {
  for (int i = 0; i < m->coordinate_count; i++) {
    const double *range = m->coordinates[i].range;
    q[i] = fmin(range[1], fmax(range[0], 0.0));
  }
}

/* a pose and room for its coordinates, q [coordinates] */
static ambulo_status open_pose(const ambulo_model *model, const ambulo_allocator *allocator,
                               ambulo__pose *pose, double **q) {
  memset(pose, 0, sizeof *pose);
  *q = ambulo__alloc(allocator, (size_t)model->coordinate_count, sizeof **q);
  return *q ? ambulo__pose_create(model, allocator, pose) : AMBULO_E_MEMORY;
}

ambulo_status ambulo__rest_gap(const ambulo_model *model, ambulo_capsule_pair pair,
                               const ambulo_allocator *allocator, double *gap) {
  ambulo__pose pose;
  double *q = NULL;
  ambulo_status status = open_pose(model, allocator, &pose, &q);
  if (!status) {
    rest(model, q);
    ambulo__pose_at(&pose, q);
    *gap = ambulo__capsules_gap(&pose, pair);
  }
  ambulo__pose_free(&pose);
  ambulo__free(allocator, q);
  return status;
}

ambulo_status ambulo__rest_overlap(const ambulo_model *model, ambulo_capsule_pair pair,
                                   const ambulo_allocator *allocator, double *overlap) {
  double gap = 0.0;
  ambulo_status status = ambulo__rest_gap(model, pair, allocator, &gap);
  *overlap = gap < 0.0 ? millimetre * ceil(-gap / millimetre - rounding) : 0.0;
  return status;
}

/* --------------------------------------------------------------------- lists */

static int is_listed(const ambulo__pairs *pairs, int one, int other) {
  for (int k = 0; k < pairs->kept_count; k++) {
    if (pairs->kept[k].one == one && pairs->kept[k].other == other) return 1;
  }
  return 0;
}

/* once, whichever is named first */
static void keep(ambulo__pairs *pairs, int a, int b) {
  int one = a < b ? a : b, other = a < b ? b : a;
  if (!is_listed(pairs, one, other))
    pairs->kept[pairs->kept_count++] = (ambulo_capsule_pair){one, other};
}

static void keep_named(const ambulo_problem_definition *d, ambulo__pairs *pairs) {
  const ambulo_capsule *capsules = d->model->capsules;
  for (int k = 0; k < d->collision.pair_count; k++) {
    const ambulo_capsule_pair *pair = &d->collision.pairs[k];
    keep(pairs, pair->one, pair->other);
    if (d->ends == AMBULO_ENDS_MIRRORED)
      keep(pairs, capsules[pair->one].mirror, capsules[pair->other].mirror);
  }
}

/* ----------------------------------------------------------------- automatic */

static double radical_inverse(int number, int base) {
  double value = 0.0, part = 1.0 / base;
  for (; number > 0; number /= base) {
    value += part * (number % base);
    part /= base;
  }
  return value;
}

static int next_prime(int after) {
  for (int p = after + 1;; p++) {
    int divisor = 2;
    while (divisor * divisor <= p && p % divisor) divisor++;
    if (divisor * divisor > p) return p;
  }
}

static void pose_number(const ambulo_problem_definition *d, int number, double *q) {
  const ambulo_model *m = d->model;
  int prime = 1, limited = d->joint_limits != AMBULO_LIMIT_OFF;
  for (int i = 0; i < m->coordinate_count; i++) {
    const ambulo_coordinate *c = &m->coordinates[i];
    double most = c->type == AMBULO_REVOLUTE ? half_turn : ambulo__model_size(m);
    double low = limited && isfinite(c->range[0]) ? c->range[0] : -most;
    double high = limited && isfinite(c->range[1]) ? c->range[1] : most;
    prime = next_prime(prime);
    q[i] = low + (high - low) * radical_inverse(number, prime);
  }
}

/* keeps of the candidates, pairs->kept[count], those that come near in some pose */
static void keep_those_that_meet(const ambulo_problem_definition *d, ambulo__pose *pose, double *q,
                                 ambulo__pairs *pairs) {
  int count = pairs->kept_count, waiting = count; /* kept[0 .. met) have met, the others wait */
  double near = far * ambulo__model_size(d->model) + d->collision.margin;
  int met = 0;
  for (int k = FIRST_POSE; k < FIRST_POSE + POSES && met < waiting; k++) {
    pose_number(d, k, q);
    ambulo__pose_at(pose, q);
    for (int i = met; i < count; i++) {
      if (ambulo__capsules_gap(pose, pairs->kept[i]) > near) continue;
      ambulo_capsule_pair pair = pairs->kept[i];
      for (int j = i; j > met; j--) pairs->kept[j] = pairs->kept[j - 1];
      pairs->kept[met++] = pair;
    }
  }
  pairs->kept_count = met;
  pairs->too_far = count - met;
}

static int is_before(const ambulo_capsule_pair *a, const ambulo_capsule_pair *b) {
  return a->one < b->one || (a->one == b->one && a->other < b->other);
}

/* in the order of the model; by insertion */
static void sort(ambulo__pairs *pairs) {
  for (int i = 1; i < pairs->kept_count; i++) {
    ambulo_capsule_pair pair = pairs->kept[i];
    int at = i;
    for (; at > 0 && is_before(&pair, &pairs->kept[at - 1]); at--)
      pairs->kept[at] = pairs->kept[at - 1];
    pairs->kept[at] = pair;
  }
}

/* With mirrored ends, inserts the mirror image of each kept pair behind it: other poses bring the
 * image near. keep_named() yields the same pairs if these are named. */
static void keep_images(const ambulo_problem_definition *d, ambulo__pairs *pairs) {
  const ambulo_capsule *capsules = d->model->capsules;
  int met = pairs->kept_count;
  for (int k = 0; d->ends == AMBULO_ENDS_MIRRORED && k < pairs->kept_count; k++) {
    int a = capsules[pairs->kept[k].one].mirror, b = capsules[pairs->kept[k].other].mirror, at = 0;
    ambulo_capsule_pair image = {a < b ? a : b, a < b ? b : a};
    keep(pairs, a, b);
    while (is_before(&pairs->kept[at], &image) || is_before(&image, &pairs->kept[at])) at++;
    if (at <= k) continue;
    for (; at > k + 1; at--) pairs->kept[at] = pairs->kept[at - 1];
    pairs->kept[++k] = image;
  }
  pairs->too_far -= pairs->kept_count - met;
}

/* 1: their links are neither neighbours nor both neighbours of one link */
static int is_far_in_tree(const ambulo_model *m, ambulo_capsule_pair pair) {
  int a = m->capsules[pair.one].link, b = m->capsules[pair.other].link;
  for (int l = 0; l < m->link_count; l++) {
    if (m->links[l].mass > 0.0 && ambulo__links_are_neighbours(m, a, l) &&
        ambulo__links_are_neighbours(m, l, b))
      return 0;
  }
  return 1;
}

static ambulo_status keep_automatic(const ambulo_problem_definition *d,
                                    const ambulo_allocator *allocator, ambulo__pairs *pairs) {
  const ambulo_model *m = d->model;
  ambulo__pose pose;
  double *q = NULL;
  ambulo_status status = open_pose(m, allocator, &pose, &q);
  if (!status) {
    rest(m, q);
    ambulo__pose_at(&pose, q);
    for (int a = 0; a < m->capsule_count; a++) {
      for (int b = a + 1; b < m->capsule_count; b++) {
        if (ambulo__links_are_neighbours(m, m->capsules[a].link, m->capsules[b].link)) continue;
        ambulo_capsule_pair pair = {a, b};
        if (ambulo__capsules_gap(&pose, pair) >= 0.0 || is_far_in_tree(m, pair))
          pairs->kept[pairs->kept_count++] = pair;
        else
          pairs->left[pairs->left_count++] = pair;
      }
    }
    keep_those_that_meet(d, &pose, q, pairs);
    sort(pairs);
    keep_images(d, pairs);
  }
  ambulo__pose_free(&pose);
  ambulo__free(allocator, q);
  return status;
}

ambulo_status ambulo__pairs_create(const ambulo_problem_definition *d,
                                   const ambulo_allocator *allocator, ambulo__pairs *pairs) {
  memset(pairs, 0, sizeof *pairs);
  size_t n = (size_t)d->model->capsule_count;
  if (d->collision.mode == AMBULO_COLLISION_OFF || n == 0) return AMBULO_OK;
  size_t most =
      d->collision.mode == AMBULO_COLLISION_PAIRS ? 2 * (size_t)d->collision.pair_count : n * n / 2;
  pairs->kept = ambulo__alloc(allocator, most, sizeof *pairs->kept);
  pairs->left = ambulo__alloc(allocator, most, sizeof *pairs->left);
  ambulo_status status = pairs->kept && pairs->left ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status && d->collision.mode == AMBULO_COLLISION_PAIRS)
    keep_named(d, pairs);
  else if (!status)
    status = keep_automatic(d, allocator, pairs);
  if (status) ambulo__pairs_free(allocator, pairs);
  return status;
}

void ambulo__pairs_free(const ambulo_allocator *allocator, ambulo__pairs *pairs) {
  ambulo__free(allocator, pairs->kept);
  ambulo__free(allocator, pairs->left);
  memset(pairs, 0, sizeof *pairs);
}
