/* Series: whole numbers that add up to the rounded values, whatever the values are. */
#include "ambulo/tools/tools.h"
#include "people/stride.h"
#include "show/scene.h"
#include "solver/result.h"
#include "support/fail_alloc.h"
#include "support/scene_reading.h"

enum { COUNT = 200 };

/* the series of values, read back as numbers of units */
static void round_trip(const double *values, int count, double unit, double *back) {
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__json json = {&text, 0, 1};
  ambulo__json_open(&json, NULL, '{');
  ambulo__series(&json, "s", values, 1, count, unit);
  ambulo__json_close(&json, '}');
  yaml_case c = yaml_open(ambulo__text_data(&text));
  assert_int_equal(c.status, AMBULO_OK);
  const ambulo__yaml_node *series = ambulo__yaml_get(c.root, "s");
  assert_int_equal(ambulo__yaml_items(series), count);
  for (int k = 0; k < count; k++) back[k] = scene_value(series, k, unit);
  yaml_shut(&c);
  ambulo__text_free(&text);
}

static void half_a_unit_everywhere(void **state) {
  (void)state;
  double values[COUNT], back[COUNT];
  for (int k = 0; k < COUNT; k++) values[k] = 3.0 * sin(0.11 * k) + 1e3 * (k % 7 == 3) - 0.01 * k;
  round_trip(values, COUNT, 1e-4, back);
  for (int k = 0; k < COUNT; k++) assert_true(fabs(back[k] - values[k]) <= 0.5e-4 + 1e-9);
  round_trip(values, 1, 1e-4, back);
  assert_true(fabs(back[0] - values[0]) <= 0.5e-4);
}

/* every second of a table of two columns */
static void steps_over_columns(void **state) {
  (void)state;
  const double values[] = {1, -9, 2, -9, 4, -9};
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__json json = {&text, 0, 1};
  ambulo__series(&json, NULL, values, 2, 3, 1.0);
  assert_string_equal(ambulo__text_data(&text), "[1,1,1]");
  ambulo__text_free(&text);
}

static void what_is_not_finite_stays(void **state) {
  (void)state;
  double values[6] = {(double)NAN, 1.0, (double)INFINITY, -2.0, 1e300, 0.0}, back[6];
  const double want[6] = {0.0, 1.0, 1.0, -2.0, -2.0, 0.0};
  round_trip(values, 6, 1e-3, back);
  for (int k = 0; k < 6; k++) assert_close(back[k], want[k], 1e-12);
}

static int test_scene_series_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(half_a_unit_everywhere),
      cmocka_unit_test(steps_over_columns),
      cmocka_unit_test(what_is_not_finite_stays),
  };
  return cmocka_run_group_tests_name("scene/series", tests, NULL, NULL);
}

/* scene.json: places against the mechanics' own, curves against the stride, surroundings against
 * the problem. */

#ifndef AMBULO_SOURCE_DIR
#define AMBULO_SOURCE_DIR "."
#endif

typedef struct scene {
  ambulo_problem *problem;
  ambulo_result *result;
  ambulo__stride stride;
  ambulo__text_buffer text;
  yaml_case read;
} scene;

/* a point that no solver made: every unknown another small number */
static scene open_scene(const char *file, const char *const *overrides, int count,
                        const ambulo__people *people, double scale) {
  scene s = {.problem = NULL};
  assert_int_equal(ambulo_problem_load(file, overrides, count, NULL, NULL, &s.problem), AMBULO_OK);
  int variables = s.problem->variables;
  assert_int_equal(ambulo__result_create(s.problem, NULL, &s.result), AMBULO_OK);
  double *x = s.result->x;
  for (int j = 0; j < variables; j++) x[j] = scale * (0.1 + 0.2 * sin(1.7 * j));
  assert_int_equal(ambulo__stride_create(s.problem, x, AMBULO__SCENE_SAMPLES, NULL, &s.stride), 0);
  ambulo__text_init(&s.text, NULL);
  assert_int_equal(ambulo__scene_json(s.problem, s.result, people, NULL, NULL, &s.text), AMBULO_OK);
  s.read = yaml_open(ambulo__text_data(&s.text));
  assert_int_equal(s.read.status, AMBULO_OK);
  return s;
}

static void shut_scene(scene *s) {
  yaml_shut(&s->read);
  ambulo__text_free(&s->text);
  ambulo__stride_free(&s->stride);
  ambulo_result_free(s->result);
  ambulo_problem_free(s->problem);
}

static double dot(const double *a, const double *b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void soles_are_where_the_mechanics_has_them(void **state) {
  (void)state;
  scene s = open_scene("models/walk.yaml", NULL, 0, NULL, 1.0);
  const ambulo_model *m = s.stride.model;
  int samples = s.stride.samples, points = m->point_count;
  double *place = calloc((size_t)samples * (size_t)points * 3, sizeof *place);
  ambulo_mechanics *mechanics = NULL;
  assert_int_equal(ambulo_mechanics_create(m, NULL, &mechanics), AMBULO_OK);
  assert_int_equal(ambulo_mechanics_inverse_dynamics(
                       mechanics, samples, s.stride.q, s.stride.qd, s.stride.qdd,
                       &(ambulo_outputs){.size = sizeof(ambulo_outputs), .points = place}),
                   AMBULO_OK);
  const ambulo__yaml_node *feet = ambulo__yaml_get(s.read.root, "feet");
  assert_int_equal(ambulo__yaml_items(feet), 2);
  for (int f = 0; f < 2; f++) {
    const ambulo_foot *foot = &m->feet[f];
    const int corner[4] = {foot->heel[0], foot->heel[1], foot->toe[1], foot->toe[0]};
    const ambulo__yaml_node *item = scene_named(feet, foot->name);
    const ambulo__yaml_node *sole = ambulo__yaml_get(item, "sole");
    assert_string_equal(ambulo__yaml_text(ambulo__yaml_get(item, "side")), foot->name);
    assert_int_equal(ambulo__yaml_items(sole), 4);
    for (int c = 0; c < 4; c++) {
      int p = (int)ambulo__yaml_number(ambulo__yaml_item(sole, c), -1.0);
      for (int k = 0; k < samples; k += 23) {
        const double *r = place + ((size_t)k * (size_t)points + (size_t)corner[c]) * 3;
        double ground = s.problem->definition.ground_height;
        assert_close(scene_point(s.read.root, p, 0, k), dot(m->forward, r), 0.51e-4);
        assert_close(scene_point(s.read.root, p, 1, k), dot(m->left, r), 0.51e-4);
        assert_close(scene_point(s.read.root, p, 2, k), dot(m->up, r) - ground, 0.51e-4);
      }
    }
  }
  ambulo_mechanics_free(mechanics);
  free(place);
  shut_scene(&s);
}

static void curves_are_the_strides(void **state) {
  (void)state;
  scene s = open_scene("models/walk.yaml", NULL, 0, NULL, 1.0);
  const ambulo__stride *st = &s.stride;
  const ambulo__yaml_node *list = ambulo__yaml_get(s.read.root, "coordinates");
  assert_int_equal(ambulo__yaml_items(list), st->coordinates);
  for (int i = 0; i < st->coordinates; i++) {
    const ambulo__yaml_node *c = ambulo__yaml_item(list, i);
    assert_string_equal(ambulo__yaml_text(ambulo__yaml_get(c, "name")),
                        st->model->coordinates[i].name);
    for (int k = 0; k < st->samples; k += 31) {
      int at = k * st->coordinates + i;
      double power = scene_value(ambulo__yaml_get(c, "power"), k, 0.1);
      double tau = scene_value(ambulo__yaml_get(c, "tau"), k, 0.01);
      assert_true(fabs(scene_value(ambulo__yaml_get(c, "q"), k, 1e-4) - st->q[at]) < 0.51e-4);
      assert_true(fabs(tau - st->tau[at]) < 0.0051);
      assert_true(fabs(power - st->tau[at] * st->qd[at]) < 0.051);
    }
  }
  const ambulo__yaml_node *right = scene_named(ambulo__yaml_get(s.read.root, "forces"), "right");
  int foot = ambulo_model_find_foot(st->model, "right");
  for (int k = 0; k < st->samples; k += 7) {
    const double *force = st->grf + (k * st->feet + foot) * 3;
    const ambulo__yaml_node *upward = ambulo__yaml_item(ambulo__yaml_get(right, "force"), 2);
    assert_true(fabs(scene_value(upward, k, 0.1) - dot(st->model->up, force)) < 0.051);
  }
  shut_scene(&s);
}

/* a stance lasts as long as the problem's, the steps of stairs are there, a beam is where it is */
static void surroundings_are_the_problems(void **state) {
  (void)state;
  scene walk = open_scene("models/walk.yaml", NULL, 0, NULL, 1.0);
  const ambulo__yaml_node *contacts = ambulo__yaml_get(walk.read.root, "contacts");
  double down = 0.0;
  for (int i = 0; i < ambulo__yaml_items(contacts); i++) {
    const ambulo__yaml_node *c = ambulo__yaml_item(contacts, i);
    if (strcmp(ambulo__yaml_text(ambulo__yaml_get(c, "name")), "left") != 0) continue;
    down += ambulo__yaml_number(ambulo__yaml_get(c, "to"), 0) -
            ambulo__yaml_number(ambulo__yaml_get(c, "from"), 0);
  }
  const ambulo_gait *g = &walk.problem->keys.walk;
  assert_true(fabs(down / walk.stride.duration - (g->toe_off - g->heel_strike)) < 2e-3);
  assert_int_equal(ambulo__yaml_integer(ambulo__yaml_get(walk.read.root, "repeats"), 0, 1, -1), 1);
  double travel = ambulo__yaml_number(ambulo__yaml_get(walk.read.root, "travel"), 0);
  assert_close(travel, 2.0 * walk.problem->definition.travel, 1e-12);
  shut_scene(&walk);

  scene stairs = open_scene("models/stairs_up.yaml", NULL, 0, NULL, 1.0);
  const ambulo__yaml_node *ground = ambulo__yaml_get(stairs.read.root, "ground");
  assert_true(ambulo__yaml_items(ambulo__yaml_get(ground, "surfaces")) > 3);
  shut_scene(&stairs);

  scene over = open_scene("models/step_over.yaml", NULL, 0, NULL, 1.0);
  const ambulo__yaml_node *beam =
      scene_named(ambulo__yaml_get(over.read.root, "obstacles"), "beam");
  double center[3], half[3];
  assert_true(ambulo__yaml_numbers(ambulo__yaml_get(beam, "center"), 3, center));
  assert_true(ambulo__yaml_numbers(ambulo__yaml_get(beam, "half_size"), 3, half));
  const double at[3] = {1.73, 0, 0.1}, size[3] = {0.05, 0.6, 0.1};
  for (int i = 0; i < 3; i++) {
    assert_close(center[i], at[i], 1e-9);
    assert_close(half[i], size[i], 1e-9);
  }
  shut_scene(&over);
}

static void seats_and_places(void **state) {
  (void)state;
  scene sit = open_scene("models/sit_to_stand.yaml", NULL, 0, NULL, 1.0);
  const ambulo__yaml_node *seat = scene_named(ambulo__yaml_get(sit.read.root, "contacts"), "seat");
  const ambulo__yaml_node *surface = ambulo__yaml_get(seat, "surface");
  double mean[3] = {0, 0, 0}, corner[3];
  assert_int_equal(ambulo__yaml_items(surface), 4);
  for (int i = 0; i < 4; i++) {
    assert_true(ambulo__yaml_numbers(ambulo__yaml_item(surface, i), 3, corner));
    for (int axis = 0; axis < 3; axis++) mean[axis] += 0.25 * corner[axis];
  }
  const ambulo_contact *held = sit.problem->definition.contacts;
  while (held->mode != AMBULO_CONTACT_PATCH) held++;
  for (int axis = 0; axis < 3; axis++) assert_close(mean[axis], held->place[axis], 1e-4);
  (void)scene_named(ambulo__yaml_get(sit.read.root, "forces"), "seat");
  shut_scene(&sit);

  static const char *const load[] = {"load=[{link: thorax, mass: 8, position: [0, 0, 0]}, {link: "
                                     "pelvis, mass: 2, position: [0, 0, 0]}]"};
  scene carrying = open_scene("models/walk.yaml", load, 1, NULL, 1.0);
  const ambulo__yaml_node *worn = ambulo__yaml_get(carrying.read.root, "worn");
  assert_int_equal(ambulo__yaml_items(worn), 2);
  for (int i = 0; i < 2; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(worn, i);
    const ambulo__yaml_node *size = ambulo__yaml_get(item, "size");
    int middle = ambulo__yaml_integer(ambulo__yaml_get(item, "from"), 0, 9999, -1);
    int front = ambulo__yaml_integer(ambulo__yaml_get(item, "ahead"), 0, 9999, -1);
    assert_close(ambulo__yaml_number(ambulo__yaml_get(item, "mass"), 0), i ? 2 : 8, 0);
    assert_true(middle >= 0 && front >= 0 && middle != front);
    assert_close(ambulo__yaml_number(ambulo__yaml_item(size, 2), 0),
                 1.4 * cbrt((i ? 2.0 : 8.0) / 500.0), 1e-3);
  }
  shut_scene(&carrying);

  scene reach = open_scene("models/reach_standing.yaml", NULL, 0, NULL, 1.0);
  const ambulo_problem_definition *d = &reach.problem->definition;
  int places = 0; /* not those that are relative */
  for (int i = 0; i < d->reach_count; i++) places += !d->reaches[i].is_relative;
  assert_true(places > 0);
  assert_int_equal(ambulo__yaml_items(ambulo__yaml_get(reach.read.root, "places")), places);
  shut_scene(&reach);
}

/* a body between two hands, which are two points of its own list */
static void what_hands_hold(void **state) {
  (void)state;
  scene lift = open_scene("models/lift.yaml", NULL, 0, NULL, 1.0);
  const ambulo_hold *hold = lift.problem->definition.holds;
  const ambulo__yaml_node *held = ambulo__yaml_get(lift.read.root, "held");
  assert_int_equal(ambulo__yaml_items(held), lift.problem->definition.hold_count);
  const ambulo__yaml_node *box = scene_named(held, hold->name);
  int one = ambulo__yaml_integer(ambulo__yaml_get(box, "one"), 0, 9999, -1);
  int other = ambulo__yaml_integer(ambulo__yaml_get(box, "other"), 0, 9999, -1);
  assert_int_not_equal(one, other);
  assert_close(ambulo__yaml_number(ambulo__yaml_get(box, "mass"), 0), hold->mass, 0);
  assert_close(ambulo__yaml_number(ambulo__yaml_get(box, "from"), 0), hold->from, 1e-12);
  shut_scene(&lift);
}

static void people_beside_a_walk(void **state) {
  (void)state;
  ambulo__people people;
  assert_int_equal(ambulo__norms_read(AMBULO_SOURCE_DIR "/models/norms", NULL, NULL, &people), 0);
  scene s = open_scene("models/walk.yaml", NULL, 0, &people, 1.0);
  const ambulo__yaml_node *list = ambulo__yaml_get(s.read.root, "coordinates");
  const ambulo__yaml_node *knee = ambulo__yaml_get(scene_named(list, "knee_angle_l"), "people_q");
  assert_non_null(knee);
  double least = 9.0, most = -9.0, widest = 0.0;
  for (int k = 0; k < s.stride.samples; k++) {
    double mean = scene_value(ambulo__yaml_get(knee, "mean"), k, 1e-4);
    least = fmin(least, mean);
    most = fmax(most, mean);
    widest = fmax(widest, scene_value(ambulo__yaml_get(knee, "band"), k, 1e-4));
  }
  /* in radians: people's knees bend by about 60 degrees in swing */
  assert_true(least > -0.1 && least < 0.2 && most > 0.9 && most < 1.25 && widest < 0.4);
  assert_null(ambulo__yaml_get(scene_named(list, "pelvis_tx"), "people_q"));
  assert_int_equal(ambulo__yaml_items(ambulo__yaml_get(s.read.root, "people")), 2);
  shut_scene(&s);
  ambulo__people_free(&people);
}

/* numbers that are none do not make a file that is none */
static void a_motion_that_is_not_finite(void **state) {
  (void)state;
  scene s = open_scene("models/walk.yaml", NULL, 0, NULL, 1e200);
  assert_int_equal(ambulo__yaml_integer(ambulo__yaml_get(s.read.root, "is_finite"), 0, 1, -1), 1);
  double value = scene_point(s.read.root, 0, 0, s.stride.samples - 1);
  assert_true(isfinite(value));
  shut_scene(&s);
  s = open_scene("models/walk.yaml", NULL, 0, NULL, (double)INFINITY);
  assert_int_equal(ambulo__yaml_integer(ambulo__yaml_get(s.read.root, "is_finite"), 0, 1, -1), 0);
  shut_scene(&s);
}

static void memory_may_run_out_anywhere(void **state) {
  (void)state;
  scene s = open_scene("models/walk.yaml", NULL, 0, NULL, 1.0);
  long k = 0;
  for (;; k += 1 + k / 40) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__text_buffer text;
    ambulo__text_init(&text, &allocator);
    ambulo_status status = ambulo__scene_json(s.problem, s.result, NULL, NULL, NULL, &text);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    if (!status) assert_string_equal(ambulo__text_data(&text), ambulo__text_data(&s.text));
    ambulo__text_free(&text);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  assert_true(k > 10);
  shut_scene(&s);
}

static int test_scene_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(soles_are_where_the_mechanics_has_them),
      cmocka_unit_test(curves_are_the_strides),
      cmocka_unit_test(surroundings_are_the_problems),
      cmocka_unit_test(seats_and_places),
      cmocka_unit_test(what_hands_hold),
      cmocka_unit_test(people_beside_a_walk),
      cmocka_unit_test(a_motion_that_is_not_finite),
      cmocka_unit_test(memory_may_run_out_anywhere),
  };
  return cmocka_run_group_tests_name("scene/scene", tests, NULL, NULL);
}

int main(void) {
  return test_scene_series_tests() + test_scene_tests();
}
