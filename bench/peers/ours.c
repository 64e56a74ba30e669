/* bench/peers/ours.c - our side of the comparison with other programs.
 *
 *   ours write MODEL.yaml FOLDER    model.txt and states.bin for the peers (see timing.h)
 *   ours time  MODEL.yaml           ns per node of the kernels picked for this processor
 *   ours folder                     name of this machine's folder of results
 *
 * The peers get the tree of moving joints with every fixed link merged into its carrier and all
 * frames along the world's axes, the form that is cheapest for them. Where a joint turns about a
 * negative axis, its coordinate is reversed for the peers. Times are of the model without its
 * named points, as the peers have none, and once with them. */
#include "bench_csv.h"
#include "ambulo/tools/load.h"
#include "mechanics/plan.h"
#include "timing.h"

enum { blocks = peer_states / AMBULO__LANES };

/* ------------------------------------------------------------ model for peers */

typedef struct frame {
  double r[3][3], p[3];
} frame;

/* x of T = Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha), put behind `parent` */
static frame link_frame(const frame *parent, const ambulo_link *link) {
  double c = cos(link->theta), s = sin(link->theta);
  double ca = cos(link->alpha), sa = sin(link->alpha);
  double r[3][3] = {{c, -s * ca, s * sa}, {s, c * ca, -c * sa}, {0, sa, ca}};
  double p[3] = {link->a * c, link->a * s, link->d};
  frame f;
  for (int i = 0; i < 3; i++) {
    f.p[i] = parent->p[i];
    for (int k = 0; k < 3; k++) {
      f.p[i] += parent->r[i][k] * p[k];
      f.r[i][k] = 0;
      for (int m = 0; m < 3; m++) f.r[i][k] += parent->r[i][m] * r[m][k];
    }
  }
  return f;
}

/* Mass, first moment and inertia about the origin of the row's frame, added up. */
static void add_body(peer_row *row, const double origin[3], const frame *f,
                     const ambulo_link *link) {
  static const int at[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  const double *v = link->inertia;
  double local[3][3] = {{v[0], v[3], v[4]}, {v[3], v[1], v[5]}, {v[4], v[5], v[2]}};
  double com[3], square = 0;
  for (int i = 0; i < 3; i++) {
    com[i] = f->p[i] - origin[i];
    for (int k = 0; k < 3; k++) com[i] += f->r[i][k] * link->com[k];
    square += com[i] * com[i];
  }
  for (int e = 0; e < 6; e++) {
    int i = at[e][0], k = at[e][1];
    for (int m = 0; m < 3; m++)
      for (int n = 0; n < 3; n++) row->inertia[e] += f->r[i][m] * local[m][n] * f->r[k][n];
    row->inertia[e] += link->mass * ((i == k ? square : 0) - com[i] * com[k]);
  }
  for (int i = 0; i < 3; i++) row->com[i] += link->mass * com[i];
  row->mass += link->mass;
}

/* From sums about the frame's origin to the centre of mass. */
static void finish_body(peer_row *row) {
  static const int at[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  double square = 0;
  if (row->mass == 0) return;
  for (int i = 0; i < 3; i++) {
    row->com[i] /= row->mass;
    square += row->com[i] * row->com[i];
  }
  for (int e = 0; e < 6; e++) {
    int i = at[e][0], k = at[e][1];
    row->inertia[e] -= row->mass * ((i == k ? square : 0) - row->com[i] * row->com[k]);
  }
}

/* Fills rows and sign[] (-1: the coordinate is reversed). */
static void build_rows(const ambulo_model *model, peer_row *rows, double *sign) {
  static const frame world = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
  enum { most_links = 256 };
  static frame frames[most_links];
  int carrier[most_links];
  double origin[peer_most][3];
  for (int i = 0; i < ambulo_model_link_count(model); i++) {
    const ambulo_link *link = ambulo_model_link(model, i);
    const frame *parent = link->parent < 0 ? &world : &frames[link->parent];
    int row = link->coordinate, above = link->parent < 0 ? -1 : carrier[link->parent];
    if (i >= most_links || row >= peer_most) exit(1);
    carrier[i] = row >= 0 ? row : above;
    frames[i] = link_frame(parent, link);
    if (row >= 0) {
      double sum = 0;
      memset(&rows[row], 0, sizeof rows[row]);
      rows[row].parent = above;
      rows[row].prismatic = link->type == AMBULO_PRISMATIC;
      for (int k = 0; k < 3; k++) {
        double z = parent->r[k][2];
        rows[row].axis[k] = fabs(z) < 1e-12 ? 0 : fabs(z) > 1 - 1e-12 ? copysign(1, z) : z;
        sum += rows[row].axis[k];
        origin[row][k] = parent->p[k];
        double place = parent->p[k] - (above < 0 ? 0 : origin[above][k]);
        rows[row].place[k] = fabs(place) < 1e-15 ? 0 : place;
      }
      sign[row] = sum == -1 ? -1 : 1;
      for (int k = 0; k < 3; k++) rows[row].axis[k] = sign[row] * rows[row].axis[k] + 0.0;
    }
    if (carrier[i] >= 0) add_body(&rows[carrier[i]], origin[carrier[i]], &frames[i], link);
  }
  for (int k = 0; k < ambulo_model_coordinate_count(model); k++) finish_body(&rows[k]);
}

/* Traces of rounding become zeros, which the peers can leave out. */
static void print_numbers(FILE *file, const double *values, int count) {
  for (int i = 0; i < count; i++)
    fprintf(file, " %.17g", fabs(values[i]) < 1e-14 ? 0.0 : values[i]);
}

static void write_model(const ambulo_model *model, const char *folder, double *sign) {
  static peer_row rows[peer_most];
  char path[512];
  (void)snprintf(path, sizeof path, "%s/model.txt", folder);
  FILE *file = fopen(path, "w");
  if (!file) exit(1);
  build_rows(model, rows, sign);
  fprintf(file, "%d", ambulo_model_coordinate_count(model));
  print_numbers(file, ambulo_model_gravity(model), 3);
  for (int i = 0; i < ambulo_model_coordinate_count(model); i++) {
    fprintf(file, "\n%d %d", rows[i].parent, rows[i].prismatic);
    print_numbers(file, rows[i].axis, 3);
    print_numbers(file, rows[i].place, 3);
    print_numbers(file, &rows[i].mass, 1);
    print_numbers(file, rows[i].com, 3);
    print_numbers(file, rows[i].inertia, 6);
  }
  fprintf(file, "\n");
  fclose(file);
}

/* Deterministic numbers in [-1, 1]. */
static double spread(unsigned *state) {
  *state = *state * 1664525u + 1013904223u;
  return (double)*state / 2147483648.0 - 1;
}

static void write_states(const ambulo_model *model, const char *folder, const double *sign) {
  int d = ambulo_model_coordinate_count(model);
  double *record = malloc(peer_record(d) * sizeof *record);
  char path[512];
  unsigned seed = 12345;
  ambulo_mechanics *mechanics = NULL;
  (void)snprintf(path, sizeof path, "%s/states.bin", folder);
  FILE *file = fopen(path, "wb");
  if (!file || !record || ambulo_mechanics_create(model, NULL, &mechanics)) exit(1);
  double *q = record, *qd = q + d, *qdd = qd + d, *w = qdd + d, *tau = w + d, *gradient = tau + d;
  double *jacobian = gradient + 3 * d;
  ambulo_jacobians all = {.size = sizeof(ambulo_jacobians),
                          .tau_q = jacobian,
                          .tau_qd = jacobian + d * d,
                          .tau_qdd = jacobian + 2 * d * d};
  for (int s = 0; s < peer_states; s++) {
    for (int i = 0; i < d; i++) {
      q[i] = 0.8 * spread(&seed);
      qd[i] = 4 * spread(&seed);
      qdd[i] = 30 * spread(&seed);
      w[i] = spread(&seed);
    }
    if (ambulo_mechanics_inverse_dynamics(
            mechanics, 1, q, qd, qdd,
            &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau}) ||
        ambulo_mechanics_gradient(
            mechanics, 1, q, qd, qdd,
            &(ambulo_output_weights){.size = sizeof(ambulo_output_weights), .tau = w},
            &(ambulo_motion_gradient){sizeof(ambulo_motion_gradient), gradient, gradient + d,
                                      gradient + 2 * d}) ||
        ambulo_mechanics_jacobians(mechanics, 1, q, qd, qdd, &all))
      exit(1);
    for (int i = 0; i < 8 * d; i++) record[i] *= sign[i % d];
    for (int i = 0; i < 3 * d * d; i++) jacobian[i] *= sign[i / d % d] * sign[i % d];
    fwrite(record, sizeof *record, peer_record(d), file);
  }
  fclose(file);
  free(record);
  ambulo_mechanics_free(mechanics);
}

/* -------------------------------------------------------------------- timing */

static ambulo__plan *plan;
static const ambulo__kernels *kernels;
static double *q, *qd, *qdd, *weights, *out, *gradient, *jacobian, *scratch;

static void run_tau(int b) {
  size_t at = (size_t)b * (size_t)ambulo__plan_coordinates(plan) * AMBULO__LANES;
  kernels->outputs(plan, q + at, qd + at, qdd + at, NULL, out, scratch);
}

static void run_vjp(int b) {
  size_t n = (size_t)ambulo__plan_coordinates(plan) * AMBULO__LANES, at = (size_t)b * n;
  kernels->forward(plan, q + at, qd + at, qdd + at, NULL, out, scratch);
  kernels->reverse(plan, qd + at, qdd + at, NULL, weights, gradient, gradient + n, gradient + 2 * n,
                   scratch);
}

static void run_jacobians(int b) {
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(plan);
  size_t at = (size_t)b * (size_t)ambulo__plan_coordinates(plan) * AMBULO__LANES;
  double *rates = jacobian + (size_t)pattern.count * AMBULO__LANES;
  kernels->jacobian(plan, q + at, qd + at, qdd + at, NULL, jacobian, rates,
                    rates + (size_t)pattern.dynamic_count * AMBULO__LANES, scratch);
}

static double *lanes_of(int entries) {
  size_t count = (size_t)(entries + 1) * AMBULO__LANES;
  double *at = aligned_alloc(64, count * sizeof *at);
  unsigned seed = 777;
  if (!at) exit(1);
  for (size_t i = 0; i < count; i++) at[i] = spread(&seed);
  return at;
}

static void time_model(const char *program, const ambulo_model *model) {
  if (ambulo__plan_create(model, NULL, &plan)) exit(1);
  int d = ambulo__plan_coordinates(plan), rows = ambulo__plan_rows(plan);
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(plan);
  kernels = ambulo__kernels_select();
  q = lanes_of(blocks * d);
  qd = lanes_of(blocks * d);
  qdd = lanes_of(blocks * d);
  weights = lanes_of(rows);
  out = lanes_of(rows);
  gradient = lanes_of(3 * d);
  jacobian = lanes_of(pattern.count + 2 * pattern.dynamic_count);
  scratch = lanes_of((int)(ambulo__plan_scratch(plan) / AMBULO__LANES) + 1);
  peer_time(program, "tau", run_tau, blocks, AMBULO__LANES);
  peer_time(program, "tau+vjp", run_vjp, blocks, AMBULO__LANES);
  peer_time(program, "jacobians", run_jacobians, blocks, AMBULO__LANES);
  double *const arrays[] = {q, qd, qdd, weights, out, gradient, jacobian, scratch};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) free(arrays[i]);
  ambulo__plan_free(plan);
}

/* The same tree without points and feet. */
static ambulo_model *without_points(const ambulo_model *model) {
  static ambulo_link links[256];
  static ambulo_coordinate coordinates[peer_most];
  ambulo_model_definition definition = ambulo_model_definition_default();
  ambulo_model *bare = NULL;
  definition.link_count = ambulo_model_link_count(model);
  definition.coordinate_count = ambulo_model_coordinate_count(model);
  if (definition.link_count > 256 || definition.coordinate_count > peer_most) exit(1);
  for (int i = 0; i < definition.link_count; i++) links[i] = *ambulo_model_link(model, i);
  for (int i = 0; i < definition.coordinate_count; i++)
    coordinates[i] = *ambulo_model_coordinate(model, i);
  definition.links = links;
  definition.coordinates = coordinates;
  for (int k = 0; k < 3; k++) {
    definition.gravity[k] = ambulo_model_gravity(model)[k];
    definition.forward[k] = ambulo_model_forward(model)[k];
  }
  if (ambulo_model_create(&definition, NULL, NULL, &bare)) exit(1);
  return bare;
}

int main(int argc, char **argv) {
  ambulo_model *model = NULL;
  double sign[peer_most];
  if (argc == 2 && strcmp(argv[1], "folder") == 0) {
    char machine[128];
    bench_machine(machine, sizeof machine);
    printf("%s_%s\n", machine, ambulo__instruction_set());
    return 0;
  }
  if (argc < 3 || ambulo_model_load(argv[2], NULL, NULL, NULL, &model)) {
    fprintf(stderr, "usage: ours write MODEL.yaml FOLDER | ours time MODEL.yaml\n");
    return 1;
  }
  if (strcmp(argv[1], "write") == 0 && argc > 3) {
    write_model(model, argv[3], sign);
    write_states(model, argv[3], sign);
  } else {
    ambulo_model *bare = without_points(model);
    time_model("ambulo", bare);
    time_model("ambulo_with_points", model);
    ambulo_model_free(bare);
  }
  ambulo_model_free(model);
  return 0;
}
