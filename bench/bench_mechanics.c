/* bench/bench_mechanics.c - what a time node costs in the lane kernels.
 *
 *   bench_mechanics [MODEL.yaml]        default: models/yardstick_body.yaml
 *
 * For each instruction set the processor has: nanoseconds per time node of the outputs (tau, root
 * wrench, points), of outputs and vector-Jacobian product, of outputs and all Jacobians; then the
 * same per coordinate, for bodies of limbs and for random trees of growing size. Times are the
 * median of repeated runs over 16 blocks of different states; the ratios are against the reference
 * recursion and between instruction sets, in the same run.
 */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "ambulo/mechanics.h"
#include "mechanics/plan.h"
#include "support/random_model.h"

enum { blocks = 16, repeats = 15 };

typedef struct rig {
  ambulo__plan *plan;
  const ambulo__kernels *kernels;
  double *q, *qd, *qdd, *weights; /* [blocks][d or rows][lanes] */
  double *out, *gradient, *jacobian, *scratch;
} rig;

typedef void (*task)(rig *rig, int block);

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static void run_forward(rig *r, int block) {
  size_t at = (size_t)(block * ambulo__plan_coordinates(r->plan)) * AMBULO__LANES;
  r->kernels->forward(r->plan, r->q + at, r->qd + at, r->qdd + at, r->out, r->scratch);
}

static void run_gradient(rig *r, int block) {
  int d = ambulo__plan_coordinates(r->plan), n = d * AMBULO__LANES;
  size_t at = (size_t)(block * d) * AMBULO__LANES;
  run_forward(r, block);
  r->kernels->reverse(r->plan, r->qd + at, r->qdd + at, r->weights, r->gradient, r->gradient + n,
                      r->gradient + 2 * n, r->scratch);
}

static void run_jacobian(rig *r, int block) {
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(r->plan);
  size_t at = (size_t)(block * ambulo__plan_coordinates(r->plan)) * AMBULO__LANES;
  double *jqd = r->jacobian + pattern.count * AMBULO__LANES;
  run_forward(r, block);
  r->kernels->jacobian(r->plan, r->qd + at, r->qdd + at, r->jacobian, jqd,
                       jqd + pattern.dynamic_count * AMBULO__LANES, r->scratch);
}

static int by_size(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Median nanoseconds per node. */
static double measure(rig *r, task run) {
  double times[repeats], elapsed = 0;
  long rounds = 1;
  for (;; rounds *= 2) {
    double start = now();
    for (long i = 0; i < rounds * blocks; i++) run(r, (int)(i % blocks));
    elapsed = now() - start;
    if (elapsed > 2e6) break;
  }
  for (int t = 0; t < repeats; t++) {
    double start = now();
    for (long i = 0; i < rounds * blocks; i++) run(r, (int)(i % blocks));
    times[t] = (now() - start) / ((double)rounds * blocks * AMBULO__LANES);
  }
  qsort(times, repeats, sizeof *times, by_size);
  return times[repeats / 2];
}

static double *doubles(size_t count) {
  double *at = NULL;
  count = (count + AMBULO__LANES) / AMBULO__LANES * AMBULO__LANES;
  at = aligned_alloc(64, count * sizeof *at);
  if (!at) exit(1);
  memset(at, 0, count * sizeof *at);
  return at;
}

static rig rig_create(const ambulo_model *model) {
  rig r = {0};
  random_source source = {7};
  if (ambulo__plan_create(model, NULL, &r.plan) != AMBULO_OK) exit(1);
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(r.plan);
  size_t n = (size_t)ambulo__plan_coordinates(r.plan) * AMBULO__LANES;
  size_t rows = (size_t)ambulo__plan_rows(r.plan) * AMBULO__LANES;
  r.q = doubles(blocks * n);
  r.qd = doubles(blocks * n);
  r.qdd = doubles(blocks * n);
  r.weights = doubles(rows);
  r.out = doubles(rows);
  r.gradient = doubles(3 * n);
  r.jacobian = doubles((size_t)(pattern.count + 2 * pattern.dynamic_count) * AMBULO__LANES);
  r.scratch = doubles(ambulo__plan_scratch(r.plan));
  for (size_t i = 0; i < blocks * n; i++) {
    r.q[i] = random_between(&source, -1, 1);
    r.qd[i] = random_between(&source, -3, 3);
    r.qdd[i] = random_between(&source, -9, 9);
  }
  for (size_t i = 0; i < rows; i++) r.weights[i] = random_between(&source, -1, 1);
  return r;
}

static void rig_free(rig *r) {
  double *const arrays[] = {r->q,   r->qd,       r->qdd,      r->weights,
                            r->out, r->gradient, r->jacobian, r->scratch};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) free(arrays[i]);
  ambulo__plan_free(r->plan);
}

static double measure_reference(const ambulo_model *model, const rig *r) {
  int d = ambulo__plan_coordinates(r->plan);
  double *state = doubles(4 * (size_t)d), best = 1e300, wrench[6];
  void *scratch = malloc(ambulo_lagrangian_scratch_size(model));
  if (!scratch) exit(1);
  for (int i = 0; i < 3 * d; i++) state[i] = r->q[i];
  for (int t = 0; t < repeats; t++) {
    double start = now();
    for (int i = 0; i < 50; i++) {
      if (ambulo_lagrangian_inverse_dynamics(model, state, state + d, state + 2 * d, state + 3 * d,
                                             wrench, NULL, scratch) != AMBULO_OK) {
        exit(1);
      }
    }
    double each = (now() - start) / 50;
    if (each < best) best = each;
  }
  free(scratch);
  free(state);
  return best;
}

static void report_sets(const ambulo_model *model) {
  static const char *const names[] = {"avx512", "avx2", "baseline", "scalar"};
  rig r = rig_create(model);
  double fastest[3] = {0};
  double reference = measure_reference(model, &r);
  printf("%s: %d coordinates, %d points, scratch %.1f kB; reference recursion %.0f ns per node\n",
         ambulo_model_name(model), ambulo__plan_coordinates(r.plan), ambulo__plan_points(r.plan),
         (double)ambulo__plan_scratch(r.plan) / 128, reference);
  printf("%-10s %10s %10s %10s   ratio to the first, reference / outputs\n", "ns / node", "outputs",
         "+ VJP", "+ Jacobian");
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    r.kernels = ambulo__kernels_by_name(names[i]);
    if (!r.kernels) continue;
    double times[3] = {measure(&r, run_forward), measure(&r, run_gradient),
                       measure(&r, run_jacobian)};
    if (fastest[0] == 0) memcpy(fastest, times, sizeof times);
    printf("%-10s %10.1f %10.1f %10.1f   %.2f %.2f %.2f, %.0f\n", names[i], times[0], times[1],
           times[2], times[0] / fastest[0], times[1] / fastest[1], times[2] / fastest[2],
           reference / times[0]);
  }
  rig_free(&r);
}

static void report_growth(const char *what, const ambulo_model *model) {
  rig r = rig_create(model);
  r.kernels = ambulo__kernels_select();
  double d = ambulo__plan_coordinates(r.plan);
  double times[3] = {measure(&r, run_forward), measure(&r, run_gradient),
                     measure(&r, run_jacobian)};
  printf("%-8s %4.0f %10.2f %10.2f %10.2f   (scratch %.1f kB)\n", what, d, times[0] / d,
         times[1] / d, times[2] / d, (double)ambulo__plan_scratch(r.plan) / 128);
  rig_free(&r);
}

/* A root of 3 + 3 coordinates that carries limbs of 3 + 1 + 2, like a leg each. */
static void body_of_limbs(random_tree *tree, int limbs) {
  static const double quarter = 1.5707963267948966;
  int count = 6 + 6 * limbs;
  memset(tree, 0, sizeof *tree);
  for (int i = 0; i < count; i++) {
    ambulo_link *link = &tree->links[i];
    int place = (i - 6) % 6;
    *link = ambulo_link_default();
    snprintf(tree->names[i], sizeof tree->names[0], "link_%d", i);
    link->name = tree->names[i];
    link->type = i < 3 ? AMBULO_PRISMATIC : AMBULO_REVOLUTE;
    link->parent = i >= 6 && place == 0 ? 5 : i - 1;
    link->theta = link->alpha = quarter;
    if (i >= 6 && (place == 2 || place == 3)) link->d = -0.4;
    tree->coordinates[i] = ambulo_coordinate_default();
    tree->coordinates[i].name = link->name;
    tree->coordinates[i].type = link->type;
    tree->coordinates[i].mirror = i;
    if (i != 5 && !(i >= 6 && (place == 2 || place == 3 || place == 5))) continue;
    link->mass = 5;
    link->com[2] = -0.2;
    for (int k = 0; k < 3; k++) link->inertia[k] = 0.1 + 0.02 * k;
  }
  tree->definition = ambulo_model_definition_default();
  tree->definition.links = tree->links;
  tree->definition.link_count = count;
  tree->definition.coordinates = tree->coordinates;
  tree->definition.coordinate_count = count;
}

static void report_tree(const char *what, const random_tree *tree) {
  ambulo_model *model = NULL;
  if (ambulo_model_create(&tree->definition, NULL, NULL, &model) != AMBULO_OK) exit(1);
  report_growth(what, model);
  ambulo_model_free(model);
}

int main(int argc, char **argv) {
  static const int sizes[] = {6, 12, 18, 30, 42, 55};
  static random_tree tree;
  const char *path = argc > 1 ? argv[1] : "models/yardstick_body.yaml";
  ambulo_model *model = NULL;
  if (ambulo_model_load(path, NULL, NULL, NULL, &model) != AMBULO_OK) {
    fprintf(stderr, "bench_mechanics: cannot load %s\n", path);
    return 1;
  }
  report_sets(model);
  ambulo_model_free(model);
  printf("\nns / node / coordinate, %s\n%-8s %4s %10s %10s %10s\n", ambulo_instruction_set(),
         "model", "size", "outputs", "+ VJP", "+ Jacobian");
  for (int limbs = 2; limbs <= 8; limbs += 2) {
    body_of_limbs(&tree, limbs);
    report_tree("limbs", &tree);
  }
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
    random_tree_make(&tree, 11 + (uint64_t)sizes[i], sizes[i]);
    report_tree("random", &tree);
  }
  return 0;
}
