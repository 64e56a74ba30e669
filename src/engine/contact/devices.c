/* contact/devices.c - what devices add to torques, and the derivatives (devices.h).
 *
 * Between points a and b, e = b - a, the length s = sqrt(e.e + t^2) with t = 1e-9 m, so that it has
 * derivatives where the points meet, and u = e / s. With e_i = de/dq_i, the slopes of b less those
 * of a (path.h),
 *
 *     s_i = u . e_i,    s_ij = (e_i . e_j - s_i s_j) / s + u . d2e/dq_i dq_j
 *
 * and the last part is not zero for two joints on one side only. A coupled joint stands at f(q_k):
 * then s_i f' and, with i and j such joints or f' = 1, s_ij f'_i f'_j are by coordinates, and s_ii
 * gains s_i f''. Kept of an element, n coordinates:
 * a header, s_i [n], s_i. [n], s_ij [n][n], and room for axes and slopes [n][3] of both sides.
 */
#include "contact/devices.h"

#include "base/arithmetic.h"

#include <math.h>
#include <string.h>

static const double touching = 1e-9; /* t, m */

typedef struct element {
  const ambulo_device *device;
  double sense; /* g */
  ambulo__device_path path[2];
  int count;       /* n */
  int *coordinate; /* [n] */
  size_t kept;     /* where its part of what is kept of a node begins */
} element;

struct ambulo__devices {
  ambulo_allocator allocator;
  int coordinates, count;
  element *elements; /* [count] */
  size_t entries, scratch;
};

/* The header of what is kept. */
enum { kept_effort, kept_by_along, kept_by_rate, kept_along, kept_rate, KEPT_HEADER };

static size_t entries_of(int n) {
  size_t count = (size_t)n;
  return KEPT_HEADER + 2 * count + count * count + 6 * count;
}

int ambulo__device_turns(const ambulo_model *model, const ambulo_device *device) {
  const ambulo_coordinate *c = ambulo_model_coordinate(model, device->coordinate);
  return c && c->type == AMBULO_REVOLUTE;
}

/* ------------------------------------------------------------ compilation */

static ambulo_status compile_between(const ambulo_model *model, const ambulo_allocator *a,
                                     element *e) {
  const ambulo_device *device = e->device;
  int common = ambulo__path_common(model, device->link);
  ambulo_status status = AMBULO_OK;
  for (int side = 0; side < 2 && !status; side++)
    status = ambulo__path_create(model, common, device->link[side], device->position[side], a,
                                 &e->path[side]);
  if (status) return status;
  e->count = e->path[0].count + e->path[1].count;
  e->coordinate = ambulo__alloc(a, (size_t)e->count, sizeof *e->coordinate);
  if (!e->coordinate) return AMBULO_E_MEMORY;
  int n = 0;
  for (int side = 0; side < 2; side++) {
    for (int i = 0; i < e->path[side].count; i++)
      e->coordinate[n++] = e->path[side].joints[i].coordinate;
  }
  return AMBULO_OK;
}

static ambulo_status compile(const ambulo_model *model, const ambulo_device *device,
                             const ambulo_allocator *a, element *e) {
  e->device = device;
  e->sense = device->coordinate >= 0 ? 1.0 : -1.0;
  if (device->coordinate < 0) return compile_between(model, a, e);
  e->count = 1;
  e->coordinate = ambulo__alloc(a, 1, sizeof *e->coordinate);
  if (!e->coordinate) return AMBULO_E_MEMORY;
  e->coordinate[0] = device->coordinate;
  return AMBULO_OK;
}

ambulo_status ambulo__devices_create(const ambulo_problem_definition *d,
                                     const ambulo_allocator *allocator, ambulo__devices **devices) {
  *devices = NULL;
  if (d->device_count == 0) return AMBULO_OK;
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  ambulo__devices *all = ambulo__alloc(&a, 1, sizeof *all);
  if (!all) return AMBULO_E_MEMORY;
  all->allocator = a;
  all->coordinates = ambulo_model_coordinate_count(d->model);
  all->elements = ambulo__alloc(&a, (size_t)d->device_count, sizeof *all->elements);
  if (!all->elements) {
    ambulo__free(&a, all);
    return AMBULO_E_MEMORY;
  }
  ambulo_status status = AMBULO_OK;
  for (; !status && all->count < d->device_count; all->count++) {
    element *e = &all->elements[all->count];
    status = compile(d->model, &d->devices[all->count], &a, e);
    e->kept = all->entries;
    all->entries += entries_of(e->count);
    if (entries_of(e->count) > all->scratch) all->scratch = entries_of(e->count);
  }
  if (status) {
    ambulo__devices_free(all);
    return status;
  }
  *devices = all;
  return AMBULO_OK;
}

void ambulo__devices_free(ambulo__devices *devices) {
  if (!devices) return;
  ambulo_allocator a = devices->allocator;
  for (int i = 0; i < devices->count; i++) {
    ambulo__path_free(&a, &devices->elements[i].path[0]);
    ambulo__path_free(&a, &devices->elements[i].path[1]);
    ambulo__free(&a, devices->elements[i].coordinate);
  }
  ambulo__free(&a, devices->elements);
  ambulo__free(&a, devices);
}

size_t ambulo__devices_scratch(const ambulo__devices *devices) {
  return devices ? devices->scratch : 0;
}

size_t ambulo__devices_entries(const ambulo__devices *devices) {
  return devices ? devices->entries : 0;
}

/* ------------------------------------------------------------- one element */

/* Where the parts of what is kept stand. */
typedef struct parts {
  double *slope, *slope_rate, *bend, *axis, *lever; /* [n], [n], [n][n], [n][3], [n][3] */
} parts;

static parts parts_of(const element *e, double *kept) {
  size_t n = (size_t)e->count;
  double *slope = kept + KEPT_HEADER;
  return (parts){slope, slope + n, slope + 2 * n, slope + 2 * n + n * n,
                 slope + 2 * n + n * n + 3 * n};
}

/* s, s_i, and u for the rest; levers become e_i */
static double measure_line(const element *e, const double *q, const parts *p, double u[3]) {
  int first = e->path[0].count;
  double a[3], b[3], square = touching * touching;
  ambulo__path_point(&e->path[0], q, a, p->axis, p->lever);
  ambulo__path_point(&e->path[1], q, b, p->axis + 3 * first, p->lever + 3 * first);
  for (int k = 0; k < 3; k++) square += (b[k] - a[k]) * (b[k] - a[k]);
  double length = sqrt(square);
  for (int k = 0; k < 3; k++) u[k] = (b[k] - a[k]) / length;
  for (int i = 0; i < 3 * first; i++) p->lever[i] = -p->lever[i];
  for (int i = 0; i < e->count; i++) p->slope[i] = ambulo__dot(u, p->lever + 3 * i);
  return length;
}

static const ambulo__path_joint *joint_of(const element *e, int i) {
  int first = e->path[0].count, side = i >= first;
  return &e->path[side].joints[i - (side ? first : 0)];
}

/* (D.5) s_ij */
static void bend_line(const element *e, const parts *p, double length, const double u[3]) {
  int first = e->path[0].count;
  for (int i = 0; i < e->count; i++) {
    for (int j = i; j < e->count; j++) {
      const double *e_i = p->lever + 3 * i, *e_j = p->lever + 3 * j;
      double bend = (ambulo__dot(e_i, e_j) - p->slope[i] * p->slope[j]) / length, turned[3];
      if ((i < first) == (j < first) && joint_of(e, i)->turns) {
        ambulo__cross(p->axis + 3 * i, e_j, turned);
        bend += ambulo__dot(u, turned);
      }
      p->bend[i * e->count + j] = p->bend[j * e->count + i] = bend;
    }
  }
}

/* s_i and s_ij of coupled joints, by their coordinates */
static void couple(const element *e, const double *q, int bends, const parts *p) {
  const int n = e->count;
  for (int i = 0; i < n; i++) {
    const ambulo__path_joint *joint = joint_of(e, i);
    double f[AMBULO__COUPLING_SLOPES];
    if (!joint->coupling) continue;
    (void)ambulo__path_value(joint, q[joint->coordinate * AMBULO__LANES], f);
    for (int j = 0; bends && j < n; j++) {
      p->bend[i * n + j] *= f[0];
      p->bend[j * n + i] *= f[0];
    }
    if (bends) p->bend[i * n + i] += f[1] * p->slope[i];
    p->slope[i] *= f[0];
  }
}

/* s, sd and s_i; with `bends` s_ij and s_i. */
static void measure(const element *e, const double *q, const double *qd, int bends, double *kept) {
  parts p = parts_of(e, kept);
  double rate = 0.0, u[3];
  if (e->device->coordinate >= 0) {
    kept[kept_along] = q[e->coordinate[0] * AMBULO__LANES];
    p.slope[0] = 1.0;
    p.slope_rate[0] = p.bend[0] = 0.0;
  } else {
    kept[kept_along] = measure_line(e, q, &p, u);
    if (bends) bend_line(e, &p, kept[kept_along], u);
    couple(e, q, bends, &p);
  }
  for (int i = 0; i < e->count; i++) {
    double turn = 0.0;
    rate += p.slope[i] * qd[e->coordinate[i] * AMBULO__LANES];
    for (int j = 0; bends && j < e->count; j++)
      turn += p.bend[i * e->count + j] * qd[e->coordinate[j] * AMBULO__LANES];
    if (bends) p.slope_rate[i] = turn;
  }
  kept[kept_rate] = rate;
}

static void evaluate(const element *e, const double *q, const double *qd, double factor, int bends,
                     double *kept) {
  measure(e, q, qd, bends, kept);
  ambulo__effort effort = ambulo__effort_of(e->device, kept[kept_along], kept[kept_rate], factor);
  kept[kept_effort] = effort.value;
  kept[kept_by_along] = effort.by_along;
  kept[kept_by_rate] = effort.by_rate;
}

/* -------------------------------------------------------- a block of nodes */

static void take_off(const element *e, const double *kept, const parts *p, double *tau) {
  double force = e->sense * kept[kept_effort];
  for (int i = 0; i < e->count; i++) tau[e->coordinate[i] * AMBULO__LANES] -= force * p->slope[i];
}

/* (D.3) tau_i - g E s_i */
void ambulo__devices_apply(const ambulo__devices *all, const double *q, const double *qd,
                           const double *told, double *tau, double *effort, double *scratch) {
  for (int k = 0; k < all->count; k++) {
    const element *e = &all->elements[k];
    parts p = parts_of(e, scratch);
    for (int lane = 0; lane < AMBULO__LANES; lane++) {
      double factor = told[k * AMBULO__LANES + lane];
      effort[k * AMBULO__LANES + lane] = 0.0;
      if (factor == 0.0) continue;
      evaluate(e, q + lane, qd + lane, factor, 0, scratch);
      effort[k * AMBULO__LANES + lane] = scratch[kept_effort];
      take_off(e, scratch, &p, tau + lane);
    }
  }
}

/* z */
static double virtual_rate(const element *e, const double *slope, const double *tau_weight) {
  double sum = 0.0;
  for (int i = 0; i < e->count; i++) sum += slope[i] * tau_weight[e->coordinate[i] * AMBULO__LANES];
  return sum;
}

/* of one node, from its lane on */
static void reverse_node(const element *e, const double *kept, const parts *p, int lane,
                         double effort_weight, const ambulo__device_adjoints *adjoints) {
  const double *tau_weight = adjoints->tau + lane;
  double *gq = adjoints->q + lane, *gqd = adjoints->qd + lane;
  double c = effort_weight - e->sense * virtual_rate(e, p->slope, tau_weight);
  double force = e->sense * kept[kept_effort];
  for (int j = 0; j < e->count; j++) {
    int at = e->coordinate[j] * AMBULO__LANES;
    double turned = 0.0;
    for (int i = 0; i < e->count; i++)
      turned += p->bend[j * e->count + i] * tau_weight[e->coordinate[i] * AMBULO__LANES];
    gq[at] += c * (kept[kept_by_along] * p->slope[j] + kept[kept_by_rate] * p->slope_rate[j]) -
              force * turned;
    gqd[at] += c * kept[kept_by_rate] * p->slope[j];
  }
}

/* (D.6) c (E_s s_j + E_sd s_j.) - g E sum y_i s_ij,  c E_sd s_j */
void ambulo__devices_reverse(const ambulo__devices *all, const double *q, const double *qd,
                             const double *told, double *tau,
                             const ambulo__device_adjoints *adjoints, double *scratch) {
  for (int k = 0; k < all->count; k++) {
    const element *e = &all->elements[k];
    parts p = parts_of(e, scratch);
    for (int lane = 0; lane < AMBULO__LANES; lane++) {
      double factor = told[k * AMBULO__LANES + lane];
      if (factor == 0.0) continue;
      evaluate(e, q + lane, qd + lane, factor, 1, scratch);
      take_off(e, scratch, &p, tau + lane);
      reverse_node(e, scratch, &p, lane, adjoints->effort[k * AMBULO__LANES + lane], adjoints);
    }
  }
}

/* ---------------------------------------------------------------- one node */

void ambulo__devices_keep(const ambulo__devices *all, const double *q, const double *qd,
                          const double *told, double *kept) {
  for (int k = 0; k < all->count; k++) {
    const element *e = &all->elements[k];
    evaluate(e, q, qd, told[k * AMBULO__LANES], 1, kept + e->kept);
  }
}

/* adds factor times the gradient of E */
static void add_effort(const element *e, const double *kept, const parts *p, double factor, int d,
                       double *gradient) {
  for (int j = 0; j < e->count; j++) {
    int c = e->coordinate[j];
    gradient[c] +=
        factor * (kept[kept_by_along] * p->slope[j] + kept[kept_by_rate] * p->slope_rate[j]);
    gradient[d + c] += factor * kept[kept_by_rate] * p->slope[j];
  }
}

/* what is kept is read only */
static parts parts_kept(const element *e, const double *kept) {
  union {
    const double *constant;
    double *plain;
  } view = {kept};
  return parts_of(e, view.plain);
}

/* (D.7) -dQ_i/dq, -dQ_i/dqd */
void ambulo__devices_add_torque(const ambulo__devices *all, const double *kept_of_node,
                                int coordinate, double *gradient) {
  for (int k = 0; k < all->count; k++) {
    const element *e = &all->elements[k];
    const double *kept = kept_of_node + e->kept;
    const parts p = parts_kept(e, kept);
    for (int i = 0; i < e->count; i++) {
      if (e->coordinate[i] != coordinate) continue;
      double force = e->sense * kept[kept_effort];
      add_effort(e, kept, &p, -e->sense * p.slope[i], all->coordinates, gradient);
      for (int j = 0; j < e->count; j++)
        gradient[e->coordinate[j]] -= force * p.bend[i * e->count + j];
    }
  }
}

void ambulo__devices_add_effort(const ambulo__devices *all, const double *kept_of_node, int device,
                                double *gradient) {
  const element *e = &all->elements[device];
  const double *kept = kept_of_node + e->kept;
  const parts p = parts_kept(e, kept);
  add_effort(e, kept, &p, 1.0, all->coordinates, gradient);
}

ambulo__device_state ambulo__device_at(const ambulo__devices *all, int device, const double *q,
                                       const double *qd, const double *told, double *scratch) {
  const element *e = &all->elements[device];
  evaluate(e, q, qd, told[device * AMBULO__LANES], 0, scratch);
  double effort = scratch[kept_effort], rate = scratch[kept_rate];
  return (ambulo__device_state){scratch[kept_along], rate, effort, e->sense * effort * rate};
}
