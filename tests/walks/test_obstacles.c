/* The shipped tasks among obstacles, from zero: all solve and hold between their nodes; on a grid
 * ten times as fine as the nodes every capsule keeps clear, and each body does what is asked. */
#include "ambulo/tools/tools.h"
#include "mechanics/pose.h"
#include "problem/nlp.h"
#include "people/stride_measures.h"
#include "people/stride.h"
#include "support/shared_data.h"
#include "support/test.h"

enum { FINER = 10 };

typedef struct task {
  ambulo_problem *p;
  ambulo_result *result;
  ambulo__approach *list;
  int count;
} task;

static void open_task(task *k, const char *name) {
  char path[512];
  snprintf(path, sizeof path, "%s/models/%s.yaml", AMBULO_SOURCE_DIR, name);
  assert_int_equal(ambulo_problem_load(path, NULL, 0, NULL, NULL, &k->p), AMBULO_OK);
  ambulo_options options = ambulo_problem_options(k->p);
  assert_int_equal(ambulo_solve(k->p, &options, NULL, NULL, NULL, &k->result), AMBULO_OK);
  assert_int_equal(ambulo_result_verdict(k->result), AMBULO_OPTIMAL);
  assert_int_equal(ambulo_result_dense_audit(k->result)->failing, 0);
  ambulo_allocator own = ambulo__allocator_or_default(NULL);
  int samples = FINER * (k->p->nodes - 1) + 1;
  assert_int_equal(
      ambulo__approaches(k->p, ambulo_result_x(k->result), samples, &own, &k->list, &k->count),
      AMBULO_OK);
}

static void close_task(task *k) {
  free(k->list);
  ambulo_result_free(k->result);
  ambulo_problem_free(k->p);
}

/* margins are kept to a millimetre, of obstacles and of legs; the least gap to an obstacle */
static double expect_margins(const task *k, double obstacle, double legs) {
  double least = INFINITY;
  assert_true(k->count > 8);
  for (int i = 0; i < k->count; i++) {
    const ambulo__approach *a = &k->list[i];
    double margin = a->is_obstacle ? obstacle : legs;
    if (!(a->gap >= margin - 0.001))
      print_error("%s and %s: %g m at %g s\n", a->capsule, a->other, a->gap, a->time);
    assert_true(a->gap >= margin - 0.001);
    if (a->is_obstacle) least = fmin(least, a->gap);
  }
  return least;
}

static void over_a_beam(void **state) {
  (void)state;
  ONLY_IN_CHECK_LONG();
  task k;
  open_task(&k, "step_over");
  assert_true(expect_margins(&k, 0.02, 0.0) < 0.03); /* and hardly higher than it has to */
  close_task(&k);
}

static void under_a_ceiling(void **state) {
  (void)state;
  task k;
  open_task(&k, "doorway");
  assert_true(expect_margins(&k, 0.03, 0.0) < 0.04);
  close_task(&k);
}

/* the place is reached at its time, within the tolerance along each axis */
static void to_a_place_behind_a_fence(void **state) {
  (void)state;
  task k;
  open_task(&k, "reach_standing");
  (void)expect_margins(&k, 0.02, 0.0);
  const ambulo_reach *reach = &k.p->definition.reaches[0];
  ambulo_workspace *workspace = NULL;
  assert_int_equal(ambulo_workspace_create(k.p, NULL, &workspace), AMBULO_OK);
  assert_int_equal(ambulo__evaluate(workspace, ambulo_result_x(k.result)), AMBULO_OK);
  int node = 0;
  while (k.p->times[node] < 1.2 - 1e-9) node++;
  assert_close(k.p->times[node], 1.2, 1e-9);
  const double place[3] = {reach->place[0], reach->place[2], -reach->place[1]}; /* x, y, z */
  for (int axis = 0; axis < 3; axis++) {
    int channel = ambulo__channel_point(&k.p->channels, reach->point, axis);
    double at = workspace->channel[ambulo__lane_index(node, workspace->channel_count, channel)];
    assert_true(fabs(at - place[axis]) <= reach->tolerance + 1e-6);
  }
  ambulo_workspace_free(workspace);
  close_task(&k);
}

/* On ten times the nodes: the hands keep the box's length and are at one height, and it keeps clear
 * of the body. The load's weight is on the feet. */
static void expect_box(const char *name, double longest) {
  task k;
  open_task(&k, name);
  const ambulo_model *m = ambulo_problem_model(k.p);
  assert_int_equal(ambulo_result_dense_audit(k.result)->overlap_count, 0);
  int hand[2] = {ambulo_model_find_point(m, "hand_r"), ambulo_model_find_point(m, "hand_l")};
  ambulo__pose pose;
  ambulo__stride stride;
  double weight = 0.0, place[2][3];
  assert_int_equal(ambulo__pose_create(m, NULL, &pose), AMBULO_OK);
  assert_int_equal(ambulo__stride_create(k.p, ambulo_result_x(k.result), 501, NULL, &stride),
                   AMBULO_OK);
  for (int s = 0; s < 501; s++) {
    ambulo__pose_at(&pose, stride.q + (size_t)s * (size_t)stride.coordinates);
    for (int h = 0; h < 2; h++)
      ambulo__pose_point(&pose, m->points[hand[h]].link, m->points[hand[h]].position, place[h]);
    assert_true(fabs(place[0][0] - place[1][0]) <= 0.006);
    assert_true(fabs(place[0][1] - place[1][1]) <= 0.006);
    assert_true(fabs(place[0][2] - place[1][2] - longest) <= 0.006);
    double share = s == 0 || s == 500 ? 0.5 / 500.0 : 1.0 / 500.0;
    for (int f = 0; f < 2; f++) weight += share * ambulo__stride_force(&stride, s, f, m->up);
  }
  /* mean force of a motion that ends as it began, in weights of the body alone */
  assert_close(weight, 85.0 / 75.0, 2e-3);
  assert_close(m->mass, 75.0, 1e-4);
  ambulo__stride_free(&stride);
  ambulo__pose_free(&pose);
  close_task(&k);
}

static void a_box_while_walking(void **state) {
  (void)state;
  expect_box("walk_carrying", 0.34);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(over_a_beam), cmocka_unit_test(under_a_ceiling),
      cmocka_unit_test(to_a_place_behind_a_fence), cmocka_unit_test(a_box_while_walking)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
