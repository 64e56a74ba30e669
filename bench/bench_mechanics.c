/* bench/bench_mechanics.c - what a time node costs in the lane kernels.
 *
 *   bench_mechanics [MODEL.yaml]        default: models/yardstick_body.yaml
 *
 * For each instruction set the processor has: nanoseconds per time node of the outputs (tau, root
 * wrench, points), of outputs and vector-Jacobian product, of outputs and all Jacobians; the
 * same per coordinate, for bodies of limbs and for random trees of growing size. Times are the
 * median and the least of repeated runs over 16 blocks of different states, instruction sets and
 * models taking turns; ratios are against the reference recursion and the instruction set in use,
 * with ground reaction against without, and of large bodies against small ones, taken in turns. For
 * the set in use also the batch calls of ambulo/mechanics.h, which take and return one node after
 * the other.
 */
#include "mechanics/lagrangian.h"
#include "bench_csv.h"
#include "ambulo/tools/load.h"
#include "mechanics/plan.h"
#include "support/random_model.h"

enum { blocks = 16, repeats = 11, tasks = 3, turns = 9, repeats_in_turn = 3 };

static const char *const task_name[tasks] = {"tau", "tau_vjp", "tau_jacobians"};

typedef struct rig {
  const ambulo_model *model;
  ambulo__plan *plan;
  ambulo_mechanics *mechanics;
  const ambulo__kernels *kernels;
  double *ground;                 /* NULL: no ground reaction */
  double *q, *qd, *qdd, *weights; /* [blocks][d or rows][lanes] */
  double *out, *gradient, *jacobian, *scratch;
} rig;

typedef void (*task)(rig *rig, int block);

static void run_outputs(rig *r, int block) {
  size_t at = (size_t)(block * ambulo__plan_coordinates(r->plan)) * AMBULO__LANES;
  r->kernels->outputs(r->plan, r->q + at, r->qd + at, r->qdd + at, r->ground, r->out, r->scratch);
}

static void run_gradient(rig *r, int block) {
  int d = ambulo__plan_coordinates(r->plan), n = d * AMBULO__LANES;
  size_t at = (size_t)(block * d) * AMBULO__LANES;
  r->kernels->forward(r->plan, r->q + at, r->qd + at, r->qdd + at, r->ground, r->out, r->scratch);
  r->kernels->reverse(r->plan, r->qd + at, r->qdd + at, r->ground, r->weights, r->gradient,
                      r->gradient + n, r->gradient + 2 * n, r->scratch);
}

static void run_jacobian(rig *r, int block) {
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(r->plan);
  size_t at = (size_t)(block * ambulo__plan_coordinates(r->plan)) * AMBULO__LANES;
  double *jqd = r->jacobian + pattern.count * AMBULO__LANES;
  run_outputs(r, block);
  r->kernels->jacobian(r->plan, r->q + at, r->qd + at, r->qdd + at, r->ground, r->jacobian, jqd,
                       jqd + pattern.dynamic_count * AMBULO__LANES, r->scratch);
}

/* Through the public interface, all blocks in one call; the states are read node by node. */
static void run_batch(rig *r, int block) {
  if (block != 0) return;
  const ambulo_outputs out = {.size = sizeof out, .tau = r->out};
  if (ambulo_mechanics_inverse_dynamics(r->mechanics, blocks * AMBULO__LANES, r->q, r->qd, r->qdd,
                                        &out) != AMBULO_OK)
    exit(1);
}

static const task task_run[tasks] = {run_outputs, run_gradient, run_jacobian};

/* Nanoseconds per node, `count` times. */
static void measure_times(rig *r, task run, double *times, int count) {
  double elapsed = 0;
  long rounds = 1;
  for (;; rounds *= 2) {
    double start = bench_seconds();
    for (long i = 0; i < rounds * blocks; i++) run(r, (int)(i % blocks));
    elapsed = bench_seconds() - start;
    if (elapsed > 1e-3) break;
  }
  for (int t = 0; t < count; t++) {
    double start = bench_seconds();
    for (long i = 0; i < rounds * blocks; i++) run(r, (int)(i % blocks));
    times[t] = 1e9 * (bench_seconds() - start) / ((double)rounds * blocks * AMBULO__LANES);
  }
}

/* Median nanoseconds per node. */
static double measure(rig *r, task run) {
  double times[repeats];
  measure_times(r, run, times, repeats);
  return bench_median(times, repeats);
}

static double *doubles(size_t count) {
  double *at = NULL;
  count = (count + AMBULO__LANES) / AMBULO__LANES * AMBULO__LANES;
  at = aligned_alloc(64, count * sizeof *at);
  if (!at) exit(1);
  memset(at, 0, count * sizeof *at);
  return at;
}

/* A point, then weights and centres of two contacts, one metre below the world origin. */
static double *contact_weights(random_source *source) {
  static const double middle[11] = {0, 0, -1, 0.5, 0.3, 0.1, -1, 0.5, -0.3, -0.1, -1};
  double *ground = doubles(11 * AMBULO__LANES);
  for (int i = 0; i < 11 * AMBULO__LANES; i++) {
    ground[i] = middle[i / AMBULO__LANES] + random_between(source, -0.1, 0.1);
  }
  return ground;
}

typedef enum footing { in_air, on_contacts } footing;

static ambulo_status compile(const ambulo_model *model, footing kind, ambulo__plan **plan) {
  int link[2];
  if (kind == in_air) return ambulo__plan_create(model, NULL, plan);
  for (int f = 0; f < 2; f++) link[f] = model->points[model->feet[f].heel_center].link;
  return ambulo__plan_create_contacts(model, link, 2, 0.07, 0.2, NULL, plan);
}

static rig rig_create(const ambulo_model *model, footing kind) {
  rig r = {0};
  random_source source = {7};
  r.model = model;
  if (compile(model, kind, &r.plan) != AMBULO_OK) exit(1);
  if (kind == on_contacts) r.ground = contact_weights(&source);
  if (ambulo_mechanics_create(model, NULL, &r.mechanics) != AMBULO_OK) exit(1);
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(r.plan);
  size_t n = (size_t)ambulo__plan_coordinates(r.plan) * AMBULO__LANES;
  size_t rows = (size_t)ambulo__plan_rows(r.plan) * AMBULO__LANES;
  r.q = doubles(blocks * n);
  r.qd = doubles(blocks * n);
  r.qdd = doubles(blocks * n);
  r.weights = doubles(rows);
  r.out = doubles(blocks * rows);
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
  double *const arrays[] = {r->ground, r->q,        r->qd,       r->qdd,    r->weights,
                            r->out,    r->gradient, r->jacobian, r->scratch};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) free(arrays[i]);
  ambulo_mechanics_free(r->mechanics);
  ambulo__plan_free(r->plan);
}

/* The seed's matrix recursion, tau of one node. */
static double measure_reference(const rig *r) {
  int d = ambulo__plan_coordinates(r->plan);
  double *state = doubles(4 * (size_t)d), times[repeats], wrench[6];
  void *scratch = malloc(ambulo__lagrangian_scratch_size(r->model));
  if (!scratch) exit(1);
  for (int i = 0; i < 3 * d; i++) state[i] = r->q[i];
  for (int t = 0; t < repeats; t++) {
    double start = bench_seconds();
    for (int i = 0; i < 50; i++) {
      const ambulo_outputs out = {.size = sizeof out, .tau = state + 3 * d, .wrench = wrench};
      if (ambulo__lagrangian(0, r->model, state, state + d, state + 2 * d, &out, scratch) !=
          AMBULO_OK)
        exit(1);
    }
    times[t] = 1e9 * (bench_seconds() - start) / 50;
  }
  free(scratch);
  free(state);
  return bench_median(times, repeats);
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

/* ------------------------------------------------------------------- report */

enum { limb_sizes = 5, random_sizes = 6, most_models = 1 + limb_sizes + random_sizes };

typedef struct subject {
  char name[32];
  ambulo_model *model;
  rig rig;
} subject;

static void add_tree(subject *s, const char *kind, const random_tree *tree) {
  if (ambulo_model_create(&tree->definition, NULL, NULL, &s->model) != AMBULO_OK) exit(1);
  s->rig = rig_create(s->model, in_air);
  (void)snprintf(s->name, sizeof s->name, "%s_%d", kind, ambulo_model_coordinate_count(s->model));
}

static int collect(subject *subjects, const char *path) {
  static const int sizes[random_sizes] = {6, 12, 18, 30, 42, 55};
  static random_tree tree;
  int count = 1;
  if (ambulo_model_load(path, NULL, NULL, NULL, &subjects->model) != AMBULO_OK) {
    (void)fprintf(stderr, "bench_mechanics: cannot load %s\n", path);
    return 0;
  }
  subjects->rig = rig_create(subjects->model, in_air);
  (void)snprintf(subjects->name, sizeof subjects->name, "%.20s",
                 ambulo_model_name(subjects->model));
  for (int limbs = 0; limbs <= 8; limbs += 2) {
    body_of_limbs(&tree, limbs);
    add_tree(&subjects[count++], "limbs", &tree);
  }
  for (int i = 0; i < random_sizes; i++) {
    random_tree_make(&tree, 11 + (uint64_t)sizes[i], sizes[i]);
    add_tree(&subjects[count++], "random", &tree);
  }
  return count;
}

/* Time of one over that of the other, taken in turns: the median of the quotients does not see
 * how busy the machine is. */
static double quotient(rig *above, rig *below, task run) {
  double ratio[turns];
  for (int i = 0; i < turns; i++) {
    double time = measure(above, run);
    ratio[i] = time / measure(below, run);
  }
  return bench_median(ratio, turns);
}

/* The body on a contact at each foot over the body in the air. */
static void report_ground(bench_table *table, rig *air) {
  char quantity[bench_key];
  rig contacts = rig_create(air->model, on_contacts);
  contacts.kernels = air->kernels;
  for (int k = 0; k < tasks; k++) {
    (void)snprintf(quantity, sizeof quantity, "%s with two contacts over without", task_name[k]);
    bench_put(table, quantity, "ratio", quotient(&contacts, air, task_run[k]));
  }
  rig_free(&contacts);
}

static void report_ratios(bench_table *table, rig *r) {
  char quantity[bench_key];
  rig fastest = *r;
  fastest.kernels = ambulo__kernels_select();
  for (int k = 0; k < tasks; k++) {
    (void)snprintf(quantity, sizeof quantity, "%s over %s", task_name[k], fastest.kernels->name);
    bench_put(table, quantity, "ratio", quotient(r, &fastest, task_run[k]));
  }
  if (ambulo_model_foot_count(r->model) == 2) report_ground(table, r);
  double reference = measure_reference(r);
  bench_put(table, "reference recursion", "ns/node", reference);
  bench_put(table, "reference recursion over tau", "ratio", reference / measure(r, run_outputs));
  if (r->kernels == fastest.kernels)
    bench_put(table, "tau in a batch call", "ns/node", measure(r, run_batch));
}

static rig *rig_named(subject *subjects, int count, const char *name) {
  for (int i = 0; i < count; i++) {
    if (strcmp(subjects[i].name, name) == 0) return &subjects[i].rig;
  }
  return NULL;
}

/* A large body over a small one of the same kind, per coordinate. */
static void report_growth(bench_table *table, subject *subjects, int count) {
  static const char *const pairs[][2] = {{"limbs_54", "limbs_18"}, {"random_55", "random_18"}};
  char quantity[bench_key];
  for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
    rig *large = rig_named(subjects, count, pairs[i][0]);
    rig *small = rig_named(subjects, count, pairs[i][1]);
    if (!large || !small) continue;
    double sizes = (double)ambulo__plan_coordinates(small->plan);
    sizes /= (double)ambulo__plan_coordinates(large->plan);
    for (int k = 0; k < tasks; k++) {
      (void)snprintf(quantity, sizeof quantity, "%s %s over %s per coordinate", task_name[k],
                     pairs[i][0], pairs[i][1]);
      bench_put(table, quantity, "ratio", sizes * quotient(large, small, task_run[k]));
    }
  }
}

/* Times of all models and tasks with one instruction set. */
typedef struct set_times {
  double times[most_models][tasks][turns * repeats_in_turn];
} set_times;

static void record_turn(set_times *record, const char *set, subject *subjects, int count,
                        int turn) {
  for (int i = 0; i < count; i++) {
    rig *r = &subjects[i].rig;
    r->kernels = ambulo__kernels_by_name(set);
    for (int k = 0; k < tasks; k++) {
      measure_times(r, task_run[k], record->times[i][k] + turn * repeats_in_turn, repeats_in_turn);
    }
  }
}

/* Median and least, the least being what it takes when nothing else is going on; of the first
 * model also for the whole body. */
static void report_times(bench_table *table, const subject *s, int k, double *times, int whole) {
  char quantity[bench_key];
  double d = ambulo__plan_coordinates(s->rig.plan);
  double median = bench_median(times, turns * repeats_in_turn);
  double least = bench_least(times, turns * repeats_in_turn);
  if (whole) {
    (void)snprintf(quantity, sizeof quantity, "%s %s", task_name[k], s->name);
    bench_put(table, quantity, "ns/node", median);
    (void)snprintf(quantity, sizeof quantity, "%s %s at least", task_name[k], s->name);
    bench_put(table, quantity, "ns/node", least);
  }
  (void)snprintf(quantity, sizeof quantity, "%s %s per coordinate", task_name[k], s->name);
  bench_put(table, quantity, "ns/node", median / d);
  (void)snprintf(quantity, sizeof quantity, "%s %s per coordinate at least", task_name[k], s->name);
  bench_put(table, quantity, "ns/node", least / d);
}

/* All quantities of one instruction set. */
static void report_set(const char *set, subject *subjects, int count, set_times *record) {
  bench_table table;
  bench_open(&table, set, "mechanics");
  for (int i = 0; i < count; i++) {
    subjects[i].rig.kernels = ambulo__kernels_by_name(set);
    for (int k = 0; k < tasks; k++) {
      report_times(&table, &subjects[i], k, record->times[i][k], i == 0);
    }
    if (i == 0) report_ratios(&table, &subjects[i].rig);
  }
  report_growth(&table, subjects, count);
  bench_close(&table);
}

int main(int argc, char **argv) {
  static const char *const sets[] = {"avx512", "avx2", "baseline", "scalar"};
  enum { set_count = sizeof sets / sizeof *sets };
  static subject subjects[most_models];
  static set_times records[set_count];
  int count =
      collect(subjects, argc > 1 ? argv[1] : AMBULO_SOURCE_DIR "/models/yardstick_body.yaml");
  if (!count) return 1;
  for (int turn = 0; turn < turns; turn++) {
    for (int i = 0; i < set_count; i++) {
      if (ambulo__kernels_by_name(sets[i])) {
        record_turn(&records[i], sets[i], subjects, count, turn);
      }
    }
  }
  for (int i = 0; i < set_count; i++) {
    if (ambulo__kernels_by_name(sets[i])) report_set(sets[i], subjects, count, &records[i]);
  }
  for (int i = 0; i < count; i++) {
    rig_free(&subjects[i].rig);
    ambulo_model_free(subjects[i].model);
  }
  return 0;
}
