/* Tangents of torques and forces against the mechanics themselves. */
#include "ambulo/tools/tools.h"
#include "solver/node_forces.h"
#include "support/random_model.h"
#include "support/test.h"

enum { TREES = 40, MOST = 40 };

static ambulo_model *loaded(const ambulo_model *model, int link, double mass, const double at[3]) {
  ambulo_conditions c = ambulo_conditions_default();
  ambulo_model *out = NULL;
  c.load_link = link;
  c.load_mass = mass;
  memcpy(c.load_position, at, sizeof c.load_position);
  assert_int_equal(ambulo_model_adapt(model, &c, NULL, NULL, &out), AMBULO_OK);
  return out;
}

/* torques, then root wrench, of one state */
static void dynamics(const ambulo_model *model, const double *motion, double *out) {
  ambulo_mechanics *mechanics = NULL;
  int d = ambulo_model_coordinate_count(model);
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  assert_int_equal(
      ambulo_mechanics_inverse_dynamics(
          mechanics, 1, motion, motion + d, motion + 2 * d,
          &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = out, .wrench = out + d}),
      AMBULO_OK);
  ambulo_mechanics_free(mechanics);
}

typedef struct one_node {
  ambulo_problem *problem;
  ambulo_workspace *workspace;
  ambulo__stationary s;
  ambulo__pool pool;
  ambulo__node_forces forces;
  double motion[3 * MOST]; /* of node 3 */
} one_node;

static void open_node(one_node *n, const ambulo_model *model, random_source *source) {
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_term term = ambulo_term_default(AMBULO_TORQUE_SQUARED);
  d.model = model;
  d.intervals = 4;
  d.terms = &term;
  d.term_count = 1;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &n->problem), AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(n->problem, NULL, &n->workspace), AMBULO_OK);
  int unknowns = ambulo_problem_variable_count(n->problem);
  double *x = calloc((size_t)unknowns, sizeof *x);
  for (int i = 0; i < unknowns; i++) x[i] = random_between(source, -0.5, 0.5);
  assert_int_equal(ambulo__evaluate(n->workspace, x), AMBULO_OK);
  free(x);
  n->s = (ambulo__stationary){n->problem, n->workspace, NULL};
  ambulo__pool_init(&n->pool, NULL);
  assert_int_equal(ambulo__node_forces_create(&n->s, &n->pool, &n->forces), AMBULO_OK);
  ambulo__node_forces_at(&n->forces, 3);
  for (int i = 0; i < 3 * n->problem->coordinates; i++)
    n->motion[i] = ambulo__stationary_channel(&n->s, 3, i);
}

static void close_node(one_node *n) {
  ambulo__node_forces_free(&n->forces);
  ambulo__pool_clear(&n->pool);
  ambulo_workspace_free(n->workspace);
  ambulo_problem_free(n->problem);
}

/* Inverse dynamics are linear in masses: a load's part is what it adds, exactly. */
static void a_load_adds_its_part_on_any_tree(void **state) {
  (void)state;
  random_source source = {20};
  for (int t = 0; t < TREES; t++) {
    random_tree tree;
    ambulo_model *model = NULL;
    one_node n;
    random_tree_make(&tree, 900 + (uint64_t)t, 3 + t % 9);
    assert_int_equal(ambulo_model_create(&tree.definition, NULL, NULL, &model), AMBULO_OK);
    open_node(&n, model, &source);
    int d = n.problem->coordinates, link = random_below(&source, ambulo_model_link_count(model));
    double at[3], place[3], force[3], without[MOST + 6], with[MOST + 6], size = 1.0;
    for (int i = 0; i < 3; i++) at[i] = random_between(&source, -0.4, 0.4);
    ambulo_model *heavier = loaded(model, link, 2.5, at);
    dynamics(model, n.motion, without);
    dynamics(heavier, n.motion, with);
    ambulo__pose_point(&n.forces.pose, link, at, place);
    ambulo__node_forces_acceleration(&n.forces, link, place, force);
    for (int i = 0; i < 3; i++) force[i] -= ambulo_model_gravity(model)[i];
    ambulo__node_forces_clear(&n.forces);
    ambulo__node_forces_add(&n.forces, link, place, force);
    for (int i = 0; i < d + 6; i++) size = fmax(size, fabs(with[i]));
    for (int i = 0; i < d; i++)
      assert_true(fabs(with[i] - without[i] - 2.5 * n.forces.torque[i]) <= 1e-11 * size);
    for (int i = 0; i < 6; i++)
      assert_true(fabs(with[d + i] - without[d + i] - 2.5 * n.forces.wrench[i]) <= 1e-11 * size);
    close_node(&n);
    ambulo_model_free(heavier);
    ambulo_model_free(model);
  }
}

/* ------------------------------------------------------------- with the ground */

typedef struct walk {
  ambulo_problem *problem;
  ambulo_workspace *workspace;
} walk;

/* `changed` moved by `by`, at a point that is a little bent */
static void open_walk(walk *w, const char *changed, double by) {
  char text[64];
  const char *overrides[] = {text};
  (void)snprintf(text, sizeof text, "%s=%.17g", changed, by);
  assert_int_equal(
      ambulo_problem_load("models/walk_loaded.yaml", overrides, 1, NULL, NULL, &w->problem),
      AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(w->problem, NULL, &w->workspace), AMBULO_OK);
  int n = ambulo_problem_variable_count(w->problem);
  double *x = calloc((size_t)n, sizeof *x);
  for (int i = 0; i < n; i++) x[i] = 0.05 * sin(1.0 + 0.3 * i);
  assert_int_equal(ambulo__evaluate(w->workspace, x), AMBULO_OK);
  free(x);
}

static void close_walk(walk *w) {
  ambulo_workspace_free(w->workspace);
  ambulo_problem_free(w->problem);
}

/* sum of w y over every channel of every node, with weights of no meaning */
static double weighted(const walk *w) {
  double sum = 0.0;
  for (int k = 0; k < w->problem->nodes; k++) {
    for (int y = 0; y < w->workspace->channel_count; y++)
      sum += sin(1.0 + 3.0 * y + k) *
             w->workspace->channel[ambulo__lane_index(k, w->workspace->channel_count, y)];
  }
  return sum;
}

static double by_hand(const char *changed, double value, size_t member) {
  walk w;
  ambulo__partials partials;
  ambulo__pool pool;
  open_walk(&w, changed, value);
  const ambulo__stationary s = {w.problem, w.workspace, NULL};
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__partials_create(w.problem, &pool, &partials), AMBULO_OK);
  for (int k = 0; k < w.problem->nodes; k++) {
    for (int y = 0; y < w.workspace->channel_count; y++)
      w.workspace->weight[ambulo__lane_index(k, w.workspace->channel_count, y)] =
          sin(1.0 + 3.0 * y + k);
  }
  assert_int_equal(ambulo__partials_of_inertia(&s, &pool, &partials), AMBULO_OK);
  double result;
  memcpy(&result, (const char *)&partials + member, sizeof result);
  ambulo__pool_clear(&pool);
  close_walk(&w);
  return result;
}

/* also of what no row or term asks for yet, such as the centre of mass */
static void every_channel_answers(void **state) {
  (void)state;
  static const struct {
    const char *key;
    double value, step;
    size_t member;
  } cases[] = {
      {"load.mass", 20.0, 1e-3, offsetof(ambulo__partials, load)},
      {"ground_reaction.slant", 0.3, 1e-4,
       offsetof(ambulo__partials, reaction) + offsetof(ambulo_ground_reaction, slant)},
      {"constraints.ground_height", 0.01, 1e-5, offsetof(ambulo__partials, ground_height)},
  };
  for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
    double value[2];
    for (int k = 0; k < 2; k++) {
      walk w;
      open_walk(&w, cases[c].key, cases[c].value + (k ? cases[c].step : -cases[c].step));
      value[k] = weighted(&w);
      close_walk(&w);
    }
    double difference = (value[1] - value[0]) / (2.0 * cases[c].step);
    double hand = by_hand(cases[c].key, cases[c].value, cases[c].member);
    if (!(fabs(hand - difference) <= 1e-7 * fabs(hand)))
      fail_msg("%s: %.12g by hand, %.12g by differences", cases[c].key, hand, difference);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_load_adds_its_part_on_any_tree),
      cmocka_unit_test(every_channel_answers),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
