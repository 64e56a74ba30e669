/* solver/overlaps.c - which bodies overlap in a motion, by their exact distance.
 *
 * Rows stand at nodes, keep a smoothed distance, and may be off. So every pair of bodies that could
 * meet is looked at along the motion, at SAMPLES times of each interval: capsules (those that
 * automatic collision would keep apart, whatever the problem asks for), boxes in hands while they
 * are held, obstacles, and the ground below what is not a foot and does not press on anything.
 * What overlaps in the rest pose counts by how much deeper it is.
 */
#include "base/alloc.h"
#include "base/arithmetic.h"
#include "mechanics/pose.h"
#include "problem/nlp.h"
#include "solver/dense.h"

#include <math.h>
#include <string.h>

enum { SAMPLES = 4 };
static const double least = 1e-3;      /* m */
static const double no_weight = 1e-12; /* m^2 */

typedef struct search {
  const ambulo_problem *problem;
  const ambulo_model *model;
  ambulo__pose pose;
  double *q;           /* [coordinates] */
  ambulo__pairs pairs; /* of automatic collision */
  double *rest;        /* [kept]: how deep pairs overlap in the rest pose, m */
  double time;
  ambulo_overlap *found;
  int count;
} search;

/* ------------------------------------------------------------------- what is found */

/* the deepest of each two */
static void note(search *s, const char *one, const char *other, double depth) {
  ambulo_overlap *o = s->found;
  int at = 0;
  if (!(depth > least)) return;
  while (at < s->count && (o[at].one != one || o[at].other != other)) at++;
  if (at == AMBULO__OVERLAPS) return;
  if (at == s->count) o[s->count++] = (ambulo_overlap){one, other, 0.0, 0.0};
  if (!(depth > o[at].depth)) return;
  o[at].depth = depth;
  o[at].time = s->time;
}

/* by insertion */
static void sort(search *s) {
  for (int i = 1; i < s->count; i++) {
    ambulo_overlap o = s->found[i];
    int at = i;
    for (; at > 0 && s->found[at - 1].depth < o.depth; at--) s->found[at] = s->found[at - 1];
    s->found[at] = o;
  }
}

/* ------------------------------------------------------------------------ distances */

static void ends_of(const search *s, int capsule, double ends[2][3]) {
  const ambulo_capsule *c = &s->model->capsules[capsule];
  ambulo__pose_point(&s->pose, c->link, c->from, ends[0]);
  ambulo__pose_point(&s->pose, c->link, c->to, ends[1]);
}

/* how far a segment is outside a box; negative: inside */
static double outside(const ambulo__solid *box, const double center[3], double ends[2][3]) {
  double own[2][3], out[3], share[2];
  for (int end = 0; end < 2; end++) {
    double from[3];
    for (int i = 0; i < 3; i++) from[i] = ends[end][i] - center[i];
    for (int k = 0; k < 3; k++) own[end][k] = ambulo__dot(box->axes[k], from);
  }
  double depth = ambulo__box_depth(own, box->half, out, share);
  return sqrt(ambulo__box_nearest_of(own, box->half, no_weight).value) - depth;
}

static double fixed_gap(const ambulo__solid *solid, double ends[2][3], double radius) {
  double fixed[2][3], weight[2] = {no_weight, no_weight};
  if (solid->kind == AMBULO__SOLID_BOX) return outside(solid, solid->center, ends) - radius;
  memcpy(fixed, solid->ends, sizeof fixed);
  return sqrt(ambulo__segments_nearest(ends, fixed, weight).value) - solid->radius - radius;
}

/* ------------------------------------------------------------------------- one time */

static void look_at_pairs(search *s) {
  const ambulo_capsule *capsules = s->model->capsules;
  for (int k = 0; k < s->pairs.kept_count; k++) {
    ambulo_capsule_pair pair = s->pairs.kept[k];
    double gap = ambulo__capsules_gap(&s->pose, pair);
    note(s, capsules[pair.one].name, capsules[pair.other].name, -gap - s->rest[k]);
  }
}

static void look_at_obstacles(search *s) {
  const ambulo_problem_definition *d = &s->problem->definition;
  for (int o = 0; o < d->obstacle_count; o++) {
    ambulo__solid solid = ambulo__solid_of_obstacle(d, o);
    for (int c = 0; c < s->model->capsule_count; c++) {
      double ends[2][3];
      ends_of(s, c, ends);
      note(s, s->model->capsules[c].name, d->obstacles[o].name,
           -fixed_gap(&solid, ends, s->model->capsules[c].radius));
    }
  }
}

/* a link with corners of a foot, or a patch that presses */
static int touches_ground(const search *s, int link) {
  const ambulo_model *m = s->model;
  for (int f = 0; f < m->foot_count; f++) {
    const ambulo_foot *foot = &m->feet[f];
    if (m->points[foot->heel_center].link == link || m->points[foot->toe_center].link == link)
      return 1;
  }
  for (int p = 0; p < m->patch_count; p++) {
    if (m->points[m->patches[p].point].link == link) return 1;
  }
  return 0;
}

static void look_at_ground(search *s) {
  const ambulo_problem_definition *d = &s->problem->definition;
  if (d->contact_count == 0 || !ambulo__ground_is_level(d)) return;
  for (int c = 0; c < s->model->capsule_count; c++) {
    const ambulo_capsule *own = &s->model->capsules[c];
    double ends[2][3];
    if (touches_ground(s, own->link)) continue;
    ends_of(s, c, ends);
    double low = fmin(ambulo__dot(s->model->up, ends[0]), ambulo__dot(s->model->up, ends[1]));
    note(s, own->name, "ground", d->ground_height + own->radius - low);
  }
}

static void look_at_hold(search *s, int hold) {
  const ambulo_problem_definition *d = &s->problem->definition;
  const ambulo_hold *h = &d->holds[hold];
  ambulo__solid box = ambulo__solid_of_hold(d, hold);
  double middle[3], point[3], ends[2][3];
  int hands = h->hand[1] < 0 ? 1 : 2;
  memcpy(middle, box.ends[0], sizeof middle);
  for (int k = 0; k < hands; k++) {
    const ambulo_point *hand = &s->model->points[h->hand[k]];
    ambulo__pose_point(&s->pose, hand->link, hand->position, point);
    for (int i = 0; i < 3; i++) middle[i] += point[i] / hands;
  }
  for (int c = 0; c < s->model->capsule_count; c++) {
    if (!ambulo__hold_meets(d, hold, c)) continue;
    ends_of(s, c, ends);
    note(s, s->model->capsules[c].name, h->name,
         s->model->capsules[c].radius - outside(&box, middle, ends));
  }
  for (int o = -1; o < d->obstacle_count; o++) {
    if (o < 0 && !ambulo__ground_is_level(d)) continue;
    ambulo__solid fixed = o < 0 ? ambulo__solid_of_ground(d) : ambulo__solid_of_obstacle(d, o);
    if (fixed.kind != AMBULO__SOLID_BOX) continue;
    ambulo__solid both = ambulo__solid_carried(&box, &fixed, 0.0);
    memcpy(ends[0], middle, sizeof middle);
    memcpy(ends[1], middle, sizeof middle);
    note(s, h->name, o < 0 ? "ground" : d->obstacles[o].name, -outside(&both, both.center, ends));
  }
}

static void look(search *s, const double *x) {
  const ambulo_problem_definition *d = &s->problem->definition;
  const int n = s->problem->coordinates;
  ambulo__basis_point point;
  ambulo__basis_at(s->problem->basis, s->time, &point);
  memset(s->q, 0, (size_t)n * sizeof *s->q);
  for (int c = 0; c < point.span; c++) {
    for (int i = 0; i < n; i++) s->q[i] += point.weight[0][c] * x[(point.first + c) * n + i];
  }
  ambulo__pose_at(&s->pose, s->q);
  look_at_pairs(s);
  look_at_obstacles(s);
  look_at_ground(s);
  for (int h = 0; h < d->hold_count; h++) {
    const ambulo_hold *hold = &d->holds[h];
    if (ambulo__hold_is_box(d, h) && s->time >= hold->from && s->time <= hold->to)
      look_at_hold(s, h);
  }
}

/* ------------------------------------------------------------------------ the motion */

static ambulo_status open_search(const ambulo_problem *p, const ambulo_allocator *a, search *s) {
  ambulo_problem_definition asked = p->definition;
  asked.collision.mode = AMBULO_COLLISION_AUTOMATIC;
  ambulo_status status = ambulo__pairs_create(&asked, a, &s->pairs);
  if (status) return status;
  s->rest = ambulo__alloc(a, (size_t)s->pairs.kept_count, sizeof *s->rest);
  s->q = ambulo__alloc(a, (size_t)p->coordinates, sizeof *s->q);
  if (!s->rest || !s->q) return AMBULO_E_MEMORY;
  for (int k = 0; k < s->pairs.kept_count && !status; k++)
    status = ambulo__rest_overlap(p->model, s->pairs.kept[k], a, &s->rest[k]);
  return status ? status : ambulo__pose_create(p->model, a, &s->pose);
}

ambulo_status ambulo__overlaps_find(const ambulo_problem *p, const double *x,
                                    const ambulo_allocator *allocator, ambulo_overlap *overlap,
                                    int *count) {
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  search s = {.problem = p, .model = p->model, .found = overlap};
  *count = 0;
  if (p->model->capsule_count == 0) return AMBULO_OK;
  ambulo_status status = open_search(p, &a, &s);
  for (int k = 0; k + 1 < p->nodes && !status; k++) {
    for (int i = k ? 1 : 0; i <= SAMPLES; i++) {
      s.time = p->times[k] + (p->times[k + 1] - p->times[k]) * i / SAMPLES;
      look(&s, x);
    }
  }
  sort(&s);
  *count = s.count;
  ambulo__pose_free(&s.pose);
  ambulo__pairs_free(&a, &s.pairs);
  ambulo__free(&a, s.rest);
  ambulo__free(&a, s.q);
  return status;
}
