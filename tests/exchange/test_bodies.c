/* Bodies of random trees: where (E.1) puts each link's mass and points is where the model has them.
 */
#include "exchange/export.h"

#include "ambulo/mechanics.h"
#include "ambulo/tools/load.h"
#include "mechanics/pose.h"
#include "support/fail_alloc.h"
#include "support/random_model.h"
#include "support/test.h"

enum { SEEDS = 300, MOST_BODIES = 200 };

/* (E.1), plainly */
static void place_bodies(const ambulo__bodies *b, const double *q, ambulo__rigid *place) {
  for (int i = 0; i < b->count; i++) {
    const ambulo__export_body *body = &b->list[i];
    ambulo__rigid x = body->before;
    for (int j = 0; j < body->joints; j++) {
      int c = body->coordinate[j];
      const double *axis = body->axis[j];
      double value = q[c] + b->offset[c], p[3];
      for (int k = 0; k < 3; k++) p[k] = value * axis[k];
      int hinge = b->model->coordinates[c].type == AMBULO_REVOLUTE;
      ambulo__rigid step = hinge ? ambulo__rigid_turn(axis, value) : ambulo__rigid_shift(p);
      x = ambulo__rigid_times(&x, &step);
    }
    x = ambulo__rigid_times(&x, &body->after);
    assert_true(body->parent < i);
    place[i] = body->parent < 0 ? x : ambulo__rigid_times(&place[body->parent], &x);
  }
}

static void compare_point(const ambulo__bodies *b, const ambulo__rigid *place,
                          const ambulo__pose *pose, int link, const double local[3]) {
  double ours[3], turned[3], inner[3], theirs[3];
  ambulo__pose_point(pose, link, local, ours);
  ambulo__rigid_point(&b->world, ours, turned);
  ambulo__body_point(b, link, local, inner);
  int body = b->body_of[link];
  if (body < 0)
    memcpy(theirs, inner, sizeof theirs);
  else
    ambulo__rigid_point(&place[body], inner, theirs);
  for (int k = 0; k < 3; k++) assert_close(theirs[k], turned[k], 1e-12);
}

/* masses, and points with their links, of a model at q */
static void compare(const ambulo__bodies *b, const double *q) {
  const ambulo_model *model = b->model;
  ambulo__rigid place[MOST_BODIES];
  ambulo__pose pose = {.model = NULL};
  double mass = 0.0;
  assert_true(b->count < MOST_BODIES);
  assert_int_equal(ambulo__pose_create(model, NULL, &pose), AMBULO_OK);
  ambulo__pose_at(&pose, q);
  place_bodies(b, q, place);
  for (int i = 0; i < model->link_count; i++)
    if (model->links[i].mass > 0.0) compare_point(b, place, &pose, i, model->links[i].com);
  for (int i = 0; i < model->point_count; i++)
    compare_point(b, place, &pose, model->points[i].link, model->points[i].position);
  for (int i = 0; i < b->count; i++) {
    const ambulo__export_body *body = &b->list[i];
    mass += body->mass;
    if (!(body->mass > 0.0)) continue;
    /* its own centre is that of the link */
    double inner[3];
    ambulo__body_point(b, body->link, model->links[body->link].com, inner);
    for (int k = 0; k < 3; k++) assert_close(body->com[k], inner[k], 1e-14);
  }
  assert_close(mass, ambulo_model_mass(model), 1e-9);
  ambulo__pose_free(&pose);
}

static void random_case(uint64_t seed, int *merged) {
  random_tree *tree = malloc(sizeof *tree);
  random_source source = {seed + 5000};
  ambulo_model *model = NULL;
  double q[random_max_links];
  random_tree_make(tree, seed, 1 + (int)(seed % 12));
  if (seed % 3) random_tree_put_on_root(tree, seed + 1);
  for (int i = 0; i < tree->definition.coordinate_count; i++)
    tree->coordinates[i].actuated = random_unit(&source) < 0.3;
  /* hinges' own places, which merged joints keep */
  for (int i = 0; i < tree->definition.point_count; i++)
    if (random_unit(&source) < 0.5) memset(tree->points[i].position, 0, 3 * sizeof(double));
  assert_int_equal(ambulo_model_create(&tree->definition, NULL, NULL, &model), AMBULO_OK);
  for (int single = 0; single < 2; single++) {
    ambulo__bodies b;
    assert_int_equal(single ? ambulo__bodies_single(model, 0, NULL, &b)
                            : ambulo__bodies_merged(model, NULL, &b),
                     AMBULO_OK);
    for (int i = 0; i < b.count; i++) {
      if (single) assert_true(b.list[i].joints <= 1);
      *merged += b.list[i].joints > 1;
    }
    for (int i = 0; i < model->coordinate_count; i++) q[i] = random_pose(&source, 2);
    compare(&b, q);
    ambulo__bodies_free(&b);
  }
  ambulo_model_free(model);
  free(tree);
}

static void random_trees(void **state) {
  (void)state;
  int merged = 0;
  for (uint64_t seed = 1; seed <= SEEDS; seed++) random_case(seed, &merged);
  assert_true(merged > SEEDS / 4); /* there was something to merge */
}

/* joints as people know them, and a pelvis that counts from the ground */
static void a_body(void **state) {
  (void)state;
  ambulo_model *model = NULL;
  ambulo__bodies b;
  static const char *const names[] = {"pelvis", "thorax",  "thigh_r", "shank_r",
                                      "foot_r", "thigh_l", "shank_l", "foot_l"};
  static const int joints[] = {6, 3, 3, 1, 2, 3, 1, 2};
  assert_int_equal(ambulo_model_load("models/lower_body_21.yaml", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  assert_int_equal(ambulo__bodies_merged(model, NULL, &b), AMBULO_OK);
  assert_int_equal(b.count, 8);
  for (int i = 0; i < 8; i++) {
    assert_string_equal(b.list[i].name, names[i]);
    assert_int_equal(b.list[i].joints, joints[i]);
  }
  for (int i = 0; i < model->coordinate_count; i++) {
    int height = i == ambulo_model_find_coordinate(model, "pelvis_ty");
    assert_close(b.offset[i], height ? 0.534643 * 1.75 : 0.0, 1e-12);
  }
  for (int k = 0; k < 3; k++) assert_close(b.list[0].before.p[k], 0.0, 0.0);
  ambulo__bodies_free(&b);

  /* a free root is its pelvis */
  int pelvis = ambulo_model_find_link(model, "pelvis");
  assert_int_equal(ambulo__free_root(model), pelvis);
  assert_int_equal(ambulo__bodies_single(model, 1, NULL, &b), AMBULO_OK);
  assert_string_equal(b.list[0].name, "pelvis");
  assert_int_equal(b.list[0].joints, 0);
  assert_int_equal(b.root, pelvis);
  ambulo__bodies_free(&b);
  ambulo_model_free(model);
}

static void no_free_root(void **state) {
  (void)state;
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/pendulum.yaml", NULL, NULL, NULL, &model), AMBULO_OK);
  assert_int_equal(ambulo__free_root(model), -1);
  ambulo_model_free(model);
}

static void check_turn(const double gravity[3], const double forward[3], int z_up,
                       const double want_up[3], const double want_forward[3]) {
  ambulo_link link = ambulo_link_default();
  ambulo_coordinate coordinate = ambulo_coordinate_default();
  ambulo_model_definition d = ambulo_model_definition_default();
  ambulo_model *model = NULL;
  link.name = "a";
  link.type = AMBULO_REVOLUTE;
  link.mass = link.inertia[0] = link.inertia[1] = link.inertia[2] = 1.0;
  coordinate.name = "q";
  coordinate.type = AMBULO_REVOLUTE;
  d.name = "m";
  d.links = &link;
  d.coordinates = &coordinate;
  d.link_count = d.coordinate_count = 1;
  memcpy(d.gravity, gravity, sizeof d.gravity);
  memcpy(d.forward, forward, sizeof d.forward);
  assert_int_equal(ambulo_model_create(&d, NULL, NULL, &model), AMBULO_OK);
  ambulo__rigid turn = ambulo__ground_turn(model, z_up ? AMBULO__Z_UP : AMBULO__Y_UP);
  double up[3], ahead[3], determinant = 0.0;
  ambulo__rigid_vector(&turn, model->up, up);
  ambulo__rigid_vector(&turn, model->forward, ahead);
  for (int k = 0; k < 3; k++) {
    assert_close(up[k], want_up[k], 1e-15);
    assert_close(ahead[k], want_forward[k], 1e-15);
    int i = (k + 1) % 3, j = (k + 2) % 3;
    determinant += turn.r[0][k] * (turn.r[1][i] * turn.r[2][j] - turn.r[1][j] * turn.r[2][i]);
  }
  assert_close(determinant, 1.0, 0.0); /* a turn, no mirror */
  ambulo_model_free(model);
}

static void axes_of_the_ground(void **state) {
  (void)state;
  static const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, z[3] = {0, 0, 1};
  check_turn((double[]){0, -9.81, 0}, x, 0, y, x);
  check_turn((double[]){0, -9.81, 0}, x, 1, z, x);
  check_turn((double[]){0, 0, -9.81}, x, 0, y, x);
  check_turn((double[]){0, 0, -9.81}, (double[]){0, -1, 0}, 1, z, x);
  check_turn((double[]){1.6, 0, 0}, (double[]){0, 0, -1}, 0, y, x);
  /* a slope stays one: forward rises by 0.1 */
  double g[3] = {-9.81 * sin(0.1), -9.81 * cos(0.1), 0};
  check_turn(g, x, 0, (double[]){sin(0.1), cos(0.1), 0}, (double[]){cos(0.1), -sin(0.1), 0});
}

static void memory_may_run_out_anywhere(void **state) {
  (void)state;
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/walker_2d.yaml", NULL, NULL, NULL, &model), AMBULO_OK);
  for (long k = 0; k < 1000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__bodies b;
    ambulo_status status = ambulo__bodies_merged(model, &allocator, &b);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    if (!status) ambulo__bodies_free(&b);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(random_trees), cmocka_unit_test(a_body), cmocka_unit_test(no_free_root),
      cmocka_unit_test(axes_of_the_ground), cmocka_unit_test(memory_may_run_out_anywhere)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
