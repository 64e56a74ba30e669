/* Muscles of a scene: lines that have the moment arms, series that are the analysis's own. */
#include "ambulo/tools/tools.h"
#include "base/arithmetic.h"
#include "people/stride.h"
#include "show/scene.h"
#include "solver/result.h"
#include "support/fail_alloc.h"
#include "support/muscle_path.h"
#include "support/scene_reading.h"

typedef struct drawn {
  ambulo_problem *problem;
  ambulo_result *result;
  ambulo__text_buffer text;
  yaml_case read;
  const ambulo__yaml_node *muscles; /* of the scene */
} drawn;

/* a point that no solver made; scale 0: the body stands at q = 0 */
static drawn open_drawn(double scale) {
  drawn d = {.problem = NULL};
  const char *const set = "time.intervals=12";
  assert_int_equal(ambulo_problem_load("models/walk_muscles.yaml", &set, 1, NULL, NULL, &d.problem),
                   AMBULO_OK);
  assert_int_equal(ambulo__result_create(d.problem, NULL, &d.result), AMBULO_OK);
  for (int j = 0; j < d.problem->variables; j++)
    d.result->x[j] = scale * (0.1 + 0.2 * sin(1.7 * j));
  ambulo__text_init(&d.text, NULL);
  assert_int_equal(ambulo__scene_json(d.problem, d.result, NULL, NULL, NULL, &d.text), AMBULO_OK);
  d.read = yaml_open(ambulo__text_data(&d.text));
  assert_int_equal(d.read.status, AMBULO_OK);
  d.muscles = ambulo__yaml_get(d.read.root, "muscles");
  assert_non_null(d.muscles);
  return d;
}

static void shut_drawn(drawn *d) {
  yaml_shut(&d->read);
  ambulo__text_free(&d->text);
  ambulo_result_free(d->result);
  ambulo_problem_free(d->problem);
}

static void three_of(const ambulo__yaml_node *series, int k, double unit, double out[3]) {
  for (int i = 0; i < 3; i++) out[i] = scene_value(ambulo__yaml_item(series, i), k, unit);
}

static double number_at(const ambulo__yaml_node *list, int i) {
  return ambulo__yaml_number(ambulo__yaml_item(list, i), (double)NAN);
}

/* forward, left and up of a corner at sample k */
static void corner_at(const drawn *d, const ambulo__yaml_node *corner, int k, double out[3]) {
  const ambulo__yaml_node *frames = ambulo__yaml_get(d->muscles, "frames");
  const int parts = ambulo__yaml_items(corner) / 4;
  memset(out, 0, 3 * sizeof *out);
  for (int p = 0; p < parts; p++) {
    const ambulo__yaml_node *frame = ambulo__yaml_item(frames, (int)number_at(corner, 4 * p));
    double place[3][3], axis[3][3];
    for (int e = 0; e < 3; e++) three_of(ambulo__yaml_item(frame, e), k, 1e-4, place[e]);
    for (int e = 0; e < 2; e++)
      for (int i = 0; i < 3; i++) axis[e][i] = (place[e + 1][i] - place[0][i]) / 0.3;
    ambulo__cross(axis[0], axis[1], axis[2]);
    assert_close(ambulo__dot(axis[0], axis[1]), 0.0, 2e-3);
    for (int e = 0; e < 3; e++) assert_close(ambulo__dot(axis[e], axis[e]), 1.0, 2e-3);
    for (int i = 0; i < 3; i++) {
      double at = place[0][i];
      for (int e = 0; e < 3; e++) at += axis[e][i] * number_at(corner, 4 * p + 1 + e);
      out[i] += at / parts;
    }
  }
}

/* Where its line passes a joint of the right leg, a muscle that pulls along the limb has the moment
 * arms of its own length: flexion of the hip and the ankle turns to the right, of the knee to the
 * left, adduction of the hip forward. */
static void lines_have_the_moment_arms(void **state) {
  (void)state;
  static const struct {
    const char *joint, *from, *to, *coordinate;
    double axis[3];
  } arms[] = {{"hip_r", "knee_r", "hip_r", "hip_flexion_r", {0.0, -1.0, 0.0}},
              {"hip_r", "knee_r", "hip_r", "hip_adduction_r", {1.0, 0.0, 0.0}},
              {"knee_r", "ankle_r", "knee_r", "knee_angle_r", {0.0, 1.0, 0.0}},
              {"ankle_r", "ankle_r", "knee_r", "ankle_angle_r", {0.0, -1.0, 0.0}}};
  drawn d = open_drawn(0.0);
  const ambulo_muscles *muscles = d.problem->definition.muscles;
  const ambulo__yaml_node *joints = ambulo__yaml_get(d.muscles, "joints");
  const ambulo__yaml_node *list = ambulo__yaml_get(d.muscles, "muscles");
  double *q = calloc((size_t)d.problem->coordinates, sizeof *q);
  int held = 0;
  for (int i = 0; i < ambulo_muscles_count(muscles); i++) {
    const ambulo_muscle *m = ambulo_muscles_get(muscles, i);
    const ambulo__yaml_node *path = ambulo__yaml_get(scene_named(list, m->name), "path");
    assert_int_equal(ambulo__yaml_items(path), m->pull_count + 2);
    for (size_t a = 0; a < sizeof arms / sizeof *arms; a++) {
      int own = -1, corner = 1; /* of the first joint; a muscle of knee and ankle begins there */
      for (int c = 0; c < m->coordinate_count; c++)
        if (!strcmp(ambulo_model_coordinate(d.problem->model, m->coordinates[c])->name,
                    arms[a].coordinate))
          own = c;
      for (int p = 0; p < m->pull_count; p++)
        corner += strcmp(m->pulls[p].joint, arms[a].joint) != 0 &&
                  (arms[a].joint[0] == 'a' || m->pulls[p].joint[0] == 'h');
      if (own < 0) continue;
      double u[3], from[3], to[3], at[3], joint[3], o[3], moment[3];
      three_of(ambulo__yaml_get(scene_named(joints, arms[a].from), "at"), 80, 1e-4, from);
      three_of(ambulo__yaml_get(scene_named(joints, arms[a].to), "at"), 80, 1e-4, to);
      three_of(ambulo__yaml_get(scene_named(joints, arms[a].joint), "at"), 80, 1e-4, joint);
      corner_at(&d, ambulo__yaml_item(path, corner), 80, at);
      double length =
          sqrt(pow(to[0] - from[0], 2.0) + pow(to[1] - from[1], 2.0) + pow(to[2] - from[2], 2.0));
      for (int k = 0; k < 3; k++) {
        u[k] = (to[k] - from[k]) / length;
        o[k] = at[k] - joint[k];
      }
      ambulo__cross(o, u, moment);
      assert_close(ambulo__dot(moment, arms[a].axis), -path_of(m, q, own), 6e-4);
      held++;
    }
  }
  assert_int_equal(held, 74);
  free(q);
  shut_drawn(&d);
}

/* of a standing body: left lines are the mirror images of right ones, and as long as muscles are */
static void lines_are_mirrored(void **state) {
  (void)state;
  drawn d = open_drawn(0.0);
  const ambulo_muscles *muscles = d.problem->definition.muscles;
  const ambulo__yaml_node *list = ambulo__yaml_get(d.muscles, "muscles");
  for (int i = 0; i < ambulo_muscles_count(muscles); i++) {
    const ambulo_muscle *m = ambulo_muscles_get(muscles, i);
    const ambulo_muscle *image = ambulo_muscles_get(muscles, m->mirror);
    const ambulo__yaml_node *one = scene_named(list, m->name),
                            *other = scene_named(list, image->name);
    assert_string_equal(ambulo__yaml_text(ambulo__yaml_get(one, "side")),
                        strstr(m->name, "_l") ? "left" : "right");
    assert_string_equal(ambulo__yaml_text(ambulo__yaml_get(one, "group")), m->group);
    const ambulo__yaml_node *path = ambulo__yaml_get(one, "path");
    for (int c = 0; c < ambulo__yaml_items(path); c++) {
      double at[3], mirrored[3];
      corner_at(&d, ambulo__yaml_item(path, c), 40, at);
      corner_at(&d, ambulo__yaml_item(ambulo__yaml_get(other, "path"), c), 40, mirrored);
      assert_close(at[0], mirrored[0], 4e-4);
      assert_close(at[1], -mirrored[1], 4e-4);
      assert_close(at[2], mirrored[2], 4e-4);
    }
  }
  shut_drawn(&d);
}

/* activations and contact forces are those of the analysis at the scene's times */
static void series_are_the_analysis(void **state) {
  (void)state;
  drawn d = open_drawn(1.0);
  ambulo_muscle_analysis *a = NULL;
  assert_int_equal(ambulo_muscle_analysis_of_result(d.problem, d.result, NULL,
                                                    AMBULO__SCENE_SAMPLES, NULL, NULL, &a),
                   AMBULO_OK);
  const ambulo_muscle_values *v = ambulo_muscle_analysis_values(a);
  const ambulo__yaml_node *list = ambulo__yaml_get(d.muscles, "muscles");
  const ambulo__yaml_node *joints = ambulo__yaml_get(d.muscles, "joints");
  const int count = ambulo_muscles_count(d.problem->definition.muscles);
  assert_int_equal(ambulo__yaml_items(list), count);
  assert_int_equal(ambulo__yaml_items(joints), v->joints);
  for (int k = 0; k < v->rows; k += 20) {
    for (int i = 0; i < count; i++)
      assert_close(scene_value(ambulo__yaml_get(ambulo__yaml_item(list, i), "activation"), k,
                               AMBULO__SCENE_ACTIVATION),
                   v->activation[k * count + i], 0.51 * AMBULO__SCENE_ACTIVATION);
    for (int j = 0; j < v->joints; j++) {
      const double *contact = v->contact + 3 * (k * v->joints + j);
      double force[3];
      three_of(ambulo__yaml_get(scene_named(joints, v->joint[j]), "force"), k, 0.1, force);
      assert_close(sqrt(ambulo__dot(force, force)), sqrt(ambulo__dot(contact, contact)), 0.1);
    }
  }
  ambulo_muscle_analysis_free(a);
  shut_drawn(&d);
}

static void memory_may_run_out_anywhere(void **state) {
  (void)state;
  drawn d = open_drawn(1.0);
  for (long k = 0;; k += 1 + k / 40) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__text_buffer text;
    ambulo__text_init(&text, &allocator);
    ambulo_status status = ambulo__scene_json(d.problem, d.result, NULL, NULL, NULL, &text);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    if (!status) assert_string_equal(ambulo__text_data(&text), ambulo__text_data(&d.text));
    ambulo__text_free(&text);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  shut_drawn(&d);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lines_have_the_moment_arms),
      cmocka_unit_test(lines_are_mirrored),
      cmocka_unit_test(series_are_the_analysis),
      cmocka_unit_test(memory_may_run_out_anywhere),
  };
  return cmocka_run_group_tests_name("scene/muscles", tests, NULL, NULL);
}
