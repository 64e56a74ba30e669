/* Sides and titles of coordinates, whatever they are called. */
#include "ambulo/tools/compare.h"
#include "ambulo/tools/load.h"
#include "people/stride.h"
#include "show/gait_people.h"
#include "show/gait_svg.h"
#include "support/fail_alloc.h"
#include "support/test.h"
#include "support/walker_result.h"
#include "support/wellformed.h"

typedef struct named {
  const char *own, *other, *title;
  ambulo__side side;
} named;

static void check(ambulo_model *model, const int pair[2], const named *n) {
  const char *kept[2] = {model->coordinates[pair[0]].name, model->coordinates[pair[1]].name};
  model->coordinates[pair[0]].name = n->own;
  model->coordinates[pair[1]].name = n->other;
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__coordinate_title(model, pair[0], &text);
  assert_string_equal(ambulo__text_data(&text), n->title);
  assert_int_equal(ambulo__coordinate_side(model, pair[0]), n->side);
  ambulo__text_free(&text);
  for (int e = 0; e < 2; e++) model->coordinates[pair[e]].name = kept[e];
}

static void test_names(void **state) {
  (void)state;
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/whole_body_29.yaml", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  /* the pair's own sides: the right one's joint is on the right */
  int right = ambulo_model_find_coordinate(model, "knee_angle_r");
  assert_true(right >= 0);
  const int pair[2] = {right, model->coordinates[right].mirror};
  const named cases[] = {{"hip_flexion_r", "hip_flexion_l", "Hip flexion", AMBULO__RIGHT},
                         {"hip_flexion_l", "hip_flexion_r", "Hip flexion", AMBULO__LEFT},
                         {"left_ankle_X", "right_ankle_X", "Ankle X", AMBULO__LEFT},
                         {"arm_right_2_joint", "arm_left_2_joint", "Arm 2 joint", AMBULO__RIGHT},
                         {"LLEG_HIP_R", "RLEG_HIP_R", "LEG HIP R", AMBULO__LEFT},
                         {"R_KNEE", "L_KNEE", "KNEE", AMBULO__RIGHT},
                         {"kneeLeft", "kneeRight", "Knee", AMBULO__LEFT},
                         {"upright_l", "upright_r", "Upright", AMBULO__LEFT},
                         /* told apart by where they stand */
                         {"joint3", "joint9", "Joint3", AMBULO__RIGHT},
                         {"\xc3\xa9paule_r", "\xc3\xa9paule_l", "\xc3\xa9paule", AMBULO__RIGHT},
                         {"a<b&c_l", "a<b&c_r", "A<b&c", AMBULO__LEFT}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) check(model, pair, &cases[i]);
  const int other[2] = {pair[1], pair[0]};
  const named left = {"joint9", "joint3", "Joint9", AMBULO__LEFT};
  check(model, other, &left);
  int middle = ambulo_model_find_coordinate(model, "pelvis_tilt");
  assert_true(middle >= 0);
  assert_int_equal(ambulo__coordinate_side(model, middle), AMBULO__MIDDLE);
  ambulo_model_free(model);
}

static int test_coordinate_name_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_names)};
  return cmocka_run_group_tests_name("picture/coordinate_name", tests, NULL, NULL);
}

/* People behind the curves of a walk: where they stand in time, their signs and units, and behind
 * which motions they are. */

#ifndef AMBULO_SOURCE_DIR
#define AMBULO_SOURCE_DIR "."
#endif

enum { SAMPLES = 201 };
static const double tilt = 11.4;

typedef struct scene {
  ambulo_problem *problem;
  ambulo_result *result;
  ambulo__people people;
  ambulo__stride stride;
  ambulo__gait_people gait;
} scene;

static void scene_open(scene *s, const char *path, const char *override) {
  assert_int_equal(ambulo_problem_load(path, &override, override ? 1 : 0, NULL, NULL, &s->problem),
                   AMBULO_OK);
  assert_int_equal(ambulo__result_create(s->problem, NULL, &s->result), AMBULO_OK);
  assert_int_equal(ambulo__norms_read(AMBULO_SOURCE_DIR "/models/norms", NULL, NULL, &s->people),
                   AMBULO_OK);
  assert_int_equal(
      ambulo__stride_create(s->problem, ambulo_result_x(s->result), SAMPLES, NULL, &s->stride),
      AMBULO_OK);
  assert_int_equal(ambulo__gait_people_create(&s->stride, &s->people, NULL, &s->gait), AMBULO_OK);
}

static void scene_close(scene *s) {
  ambulo__gait_people_free(&s->gait);
  ambulo__stride_free(&s->stride);
  ambulo__people_free(&s->people);
  ambulo_result_free(s->result);
  ambulo_problem_free(s->problem);
}

static int coordinate(const scene *s, const char *name) {
  int index = ambulo_model_find_coordinate(s->stride.model, name);
  assert_true(index >= 0);
  return index;
}

/* the sample nearest to `share` of the cycle that begins at `strike` */
static int sample_at(const scene *s, double strike, double share) {
  double t = (strike + share * s->stride.duration) / s->stride.duration;
  t -= floor(t);
  return (int)lround(t * (SAMPLES - 1));
}

/* walk_normal: the left foot strikes at 0, the right one half a stride later */
static void times_and_signs(void **state) {
  (void)state;
  static const struct {
    const char *quantity, *coordinate;
    double share, mean, band; /* of the table, at this share of the foot's cycle */
    double shift, scale;
  } cases[] = {{"q", "knee_angle_l", 0.0, 0.07635, 3.8831, 0.0, 1.0},
               {"q", "knee_angle_l", 0.74, 62.16476, 3.89553, 0.0, 1.0},
               {"q", "knee_angle_r", 0.74, 62.16476, 3.89553, 0.0, 1.0},
               {"q", "hip_flexion_r", 0.54, -7.74633, 6.83741, 11.4, 1.0},
               {"q", "hip_adduction_l", 0.16, 6.34615, 3.08684, 0.0, 1.0},
               {"q", "hip_rotation_r", 0.56, -5.99257, 4.51163, 0.0, 1.0},
               {"q", "ankle_angle_l", 0.64, -12.95149, 5.54383, 0.0, 1.0},
               {"tau", "knee_angle_l", 0.14, 0.615, 0.0, 0.0, -75.0},
               {"tau", "hip_flexion_r", 0.5, -0.404, 0.0, 0.0, -75.0},
               {"tau", "ankle_angle_r", 0.46, 1.688, 0.0, 0.0, -75.0}};
  scene s;
  scene_open(&s, "models/walk_normal.yaml", NULL);
  assert_non_null(s.gait.people);
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    const char *name = cases[i].coordinate;
    double strike = name[strlen(name) - 1] == 'l' ? 0.0 : 0.5 * s.stride.duration, mean, band;
    ambulo__people_curve curve =
        ambulo__people_coordinate(&s.gait, cases[i].quantity, coordinate(&s, name));
    assert_non_null(curve.curve);
    assert_int_equal(curve.file, cases[i].band > 0.0 ? 0 : 1);
    assert_true(ambulo__people_at(&curve, sample_at(&s, strike, cases[i].share), &mean, &band));
    assert_close(mean, cases[i].scale * (cases[i].mean - cases[i].shift), 1e-6);
    assert_close(band, 2.0 * cases[i].band, 1e-9);
  }
  /* per kg it is the table's own number, and a force in N/kg that in body weights times g */
  s.gait.per_kg = 1;
  double mean = 0.0, band;
  ambulo__people_curve knee =
      ambulo__people_coordinate(&s.gait, "tau", coordinate(&s, "knee_angle_l"));
  assert_true(ambulo__people_at_percent(&knee, 14.0, &mean, &band));
  assert_close(mean, -0.615, 1e-12);
  ambulo__people_curve power =
      ambulo__people_coordinate(&s.gait, "power", coordinate(&s, "knee_angle_l"));
  assert_true(!power.curve || power.scale == 1.0);
  double newtons = ambulo__people_force(&s.gait, "up", AMBULO__LEFT).scale;
  s.gait.per_kg = 0;
  assert_close(newtons, 9.81 * ambulo__people_force(&s.gait, "up", AMBULO__LEFT).scale, 1e-3);
  const int none = coordinate(&s, "pelvis_tilt");
  assert_null(ambulo__people_coordinate(&s.gait, "q", none).curve);
  assert_null(ambulo__people_coordinate(&s.gait, "tau", coordinate(&s, "subtalar_angle_l")).curve);
  assert_close(tilt, ambulo_compare_options_default().pelvic_tilt * 57.295779513082321, 1e-9);
  scene_close(&s);
}

/* a knee that bends with negative angles: curves of people turn with it, powers do not */
static void knees_that_bend_the_other_way(void **state) {
  (void)state;
  scene s;
  scene_open(&s, "models/walk_normal.yaml", NULL);
  const int knee = coordinate(&s, "knee_angle_l");
  double before[2], after[2];
  static const char *const quantities[] = {"q", "tau"};
  for (int i = 0; i < 2; i++)
    before[i] = ambulo__people_coordinate(&s.gait, quantities[i], knee).scale;
  for (int i = 0; i < AMBULO__BODY_JOINTS; i++)
    if (s.gait.joints[i].coordinate == knee) s.gait.joints[i].sign = -1;
  for (int i = 0; i < 2; i++) {
    after[i] = ambulo__people_coordinate(&s.gait, quantities[i], knee).scale;
    assert_true(before[i] != 0.0);
    assert_close(after[i], -before[i], 0.0);
  }
  scene_close(&s);
}

/* in body weights; the right foot is half a stride late */
static void forces(void **state) {
  (void)state;
  scene s;
  scene_open(&s, "models/walk_normal.yaml", NULL);
  for (int side = AMBULO__LEFT; side <= AMBULO__RIGHT; side++) {
    double strike = side == AMBULO__LEFT ? 0.0 : 0.5 * s.stride.duration, mean, band;
    ambulo__people_curve up = ambulo__people_force(&s.gait, "up", (ambulo__side)side);
    ambulo__people_curve ahead = ambulo__people_force(&s.gait, "forward", (ambulo__side)side);
    assert_true(ambulo__people_at(&up, sample_at(&s, strike, 0.14), &mean, &band));
    assert_close(mean, 10.82 / 9.81, 1e-6);
    assert_true(ambulo__people_at(&ahead, sample_at(&s, strike, 0.52), &mean, &band));
    assert_close(mean, 2.19 / 9.81, 1e-6);
  }
  scene_close(&s);
}

/* torques of a leg that hangs are not those of people */
static void without_ground_reaction(void **state) {
  (void)state;
  scene s;
  scene_open(&s, "tests/support/walk_without_reaction.yaml", NULL);
  int knee = coordinate(&s, "knee_angle_l");
  assert_non_null(ambulo__people_coordinate(&s.gait, "q", knee).curve);
  assert_null(ambulo__people_coordinate(&s.gait, "tau", knee).curve);
  scene_close(&s);
}

/* one cycle after the other, wherever they begin */
static void several_strides(void **state) {
  (void)state;
  scene s;
  scene_open(&s, "models/yardstick_12.yaml", NULL);
  ambulo__strike strikes[64];
  int count = ambulo__strikes(s.problem, strikes);
  assert_int_equal(count, 4);
  ambulo__people_curve hip =
      ambulo__people_coordinate(&s.gait, "q", coordinate(&s, "hip_flexion_r"));
  for (int i = 0; i < 4; i += 2) { /* right, left, right, left */
    double mean, band;
    int k = (int)lround(strikes[i].time / s.stride.duration * (SAMPLES - 1));
    assert_true(ambulo__people_at(&hip, k, &mean, &band));
    assert_close(mean, 30.48956 - tilt, 0.02);
    assert_true(ambulo__people_at(&hip, (k + 27 * (SAMPLES - 1) / 100) % SAMPLES, &mean, &band));
    assert_close(mean, -7.74633 - tilt, 0.02);
  }
  scene_close(&s);
}

/* a band goes there along its upper edge and back along the lower one */
static int steps_of_path(const char *svg, const char *style) {
  const char *path = strstr(svg, style);
  int steps = 0;
  for (path = path ? strstr(path, " d=\"") + 4 : ""; *path && *path != '"'; path++)
    steps += *path == 'L';
  return steps;
}

/* bands, lines and who they are; nothing of it behind anything but a level walk */
static void drawn_behind_walks(void **state) {
  (void)state;
  static const struct {
    const char *file;
    int bands, lines; /* with those of the legend */
  } cases[] = {{"models/walk_normal.yaml", 2 * 3 + 2, 2 * 5 + 2},
               {"tests/support/walk_without_reaction.yaml", 2 * 3 + 2, 0},
               {"models/walk_uphill.yaml", 0, 0},
               {"models/stairs_up.yaml", 0, 0},
               {"models/walk_turn.yaml", 0, 0},
               {"models/squat.yaml", 0, 0},
               {"models/stand_quietly.yaml", 0, 0}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    scene s;
    scene_open(&s, cases[i].file, NULL);
    ambulo__text_buffer text;
    ambulo__text_init(&text, NULL);
    assert_int_equal(ambulo__gait_svg(s.problem, s.result, &s.people, &text), AMBULO_OK);
    const char *svg = ambulo__text_data(&text);
    assert_true(is_xml(svg));
    assert_int_equal(occurrences(svg, "class=\"left-people\"") +
                         occurrences(svg, "class=\"right-people\""),
                     cases[i].bands);
    assert_int_equal(occurrences(svg, "class=\"left people\"") +
                         occurrences(svg, "class=\"right people\""),
                     cases[i].lines);
    /* there and back: a corner of the spline is always one of the samples */
    int pieces = 2 * ambulo__basis_intervals(s.problem->basis);
    int steps = (steps_of_path(svg, "<path class=\"left-p") + 1) / 2 - 1;
    if (cases[i].bands) assert_true(steps >= 240 && steps % pieces == 0);
    int told = strstr(svg, "people, mean \xc2\xb1 2 SD: 24 young adults") != NULL;
    assert_int_equal(told, cases[i].bands > 0);
    assert_int_equal(strstr(svg, "CC BY 4.0") != NULL, cases[i].bands > 0);
    assert_int_equal(strstr(svg, "(Winter, ") != NULL, cases[i].lines > 0);
    assert_int_equal(s.gait.people != NULL, cases[i].bands > 0);
    ambulo__text_free(&text);
    scene_close(&s);
  }
}

/* feet of a planar body stand in one line: they are told apart by their names */
static void feet_in_one_line(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  scene s = {.problem = w.problem, .result = w.result};
  assert_int_equal(ambulo__norms_read(AMBULO_SOURCE_DIR "/models/norms", NULL, NULL, &s.people),
                   AMBULO_OK);
  assert_int_equal(
      ambulo__stride_create(w.problem, ambulo_result_x(w.result), SAMPLES, NULL, &s.stride),
      AMBULO_OK);
  assert_int_equal(ambulo__gait_people_create(&s.stride, &s.people, NULL, &s.gait), AMBULO_OK);
  assert_int_equal(s.gait.count[AMBULO__LEFT], 1);
  assert_int_equal(s.gait.count[AMBULO__RIGHT], 1);
  ambulo__gait_people_free(&s.gait);
  w.problem->definition.rise = 0.1;
  assert_false(ambulo__gait_is_walk(w.problem));
  w.problem->definition.rise = 0.0;
  assert_true(ambulo__gait_is_walk(w.problem));
  w.problem->definition.travel = 0.0;
  assert_false(ambulo__gait_is_walk(w.problem));
  ambulo__stride_free(&s.stride);
  ambulo__people_free(&s.people);
  walk_close(&w);
}

static void memory_runs_out(void **state) {
  (void)state;
  scene s;
  scene_open(&s, "models/walk_normal.yaml", NULL);
  for (long k = 0; k < 100; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__gait_people gait;
    ambulo_status status = ambulo__gait_people_create(&s.stride, &s.people, &allocator, &gait);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    if (!status) ambulo__gait_people_free(&gait);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  scene_close(&s);
}

static int test_gait_people_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(times_and_signs),  cmocka_unit_test(knees_that_bend_the_other_way),
      cmocka_unit_test(forces),           cmocka_unit_test(without_ground_reaction),
      cmocka_unit_test(several_strides),  cmocka_unit_test(drawn_behind_walks),
      cmocka_unit_test(feet_in_one_line), cmocka_unit_test(memory_runs_out)};
  return cmocka_run_group_tests_name("picture/gait_people", tests, NULL, NULL);
}

int main(void) {
  return test_coordinate_name_tests() + test_gait_people_tests();
}
