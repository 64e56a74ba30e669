/* Files of muscles: the shipped one on every body that has its joints, and the sizes. */
#include "ambulo/tools/load.h"
#include "support/messages.h"
#include "support/model_text.h"
#include "support/muscle_path.h"
#include "support/random_model.h"
#include "support/scratch.h"

#define SHIPPED "models/leg_muscles.yaml"

typedef struct body {
  ambulo_model *model;
  ambulo_muscles *muscles;
  int d, m;
} body;

static body body_of(const char *name, const char *file, double mass, double stature) {
  char path[200];
  body b = {NULL, NULL, 0, 0};
  ambulo_subject subject = ambulo_subject_default();
  if (mass > 0.0) subject.mass = mass;
  if (stature > 0.0) subject.stature = stature;
  subject.sex = AMBULO_MALE;
  (void)snprintf(path, sizeof path, "models/%s.yaml", name);
  assert_int_equal(ambulo_model_load(path, &subject, NULL, NULL, &b.model), AMBULO_OK);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_muscles_load(file, b.model, NULL, list, &b.muscles);
  if (status || ambulo_diagnostics_count(list)) assert_message(list, 0, "(nothing to say)");
  ambulo_diagnostics_free(list);
  b.d = ambulo_model_coordinate_count(b.model);
  b.m = ambulo_muscles_count(b.muscles);
  return b;
}

static void body_free(body *b) {
  ambulo_muscles_free(b->muscles);
  ambulo_model_free(b->model);
}

static const ambulo_muscle *muscle_of(const body *b, const char *name) {
  const ambulo_muscle *m = ambulo_muscles_get(b->muscles, ambulo_muscles_find(b->muscles, name));
  assert_non_null(m);
  return m;
}

/* ----------------------------------------------------------------- shipped file */

static const char *const bodies[] = {"lower_body_18", "lower_body_21", "lower_body_23",
                                     "whole_body_29", "whole_body_31", "whole_body_45"};
enum { BODIES = sizeof bodies / sizeof *bodies, ALL = 80 };

static void the_shipped_muscles_fit_every_body_with_their_joints(void **state) {
  (void)state;
  for (int i = 0; i < BODIES; i++) {
    body b = body_of(bodies[i], SHIPPED, 0.0, 0.0);
    assert_int_equal(b.m, ALL);
    assert_string_equal(ambulo_muscles_name(b.muscles), "leg_muscles");
    assert_non_null(strstr(ambulo_muscles_source(b.muscles), "licence Apache-2.0; opensim-core"));
    for (int k = 0; k < b.m; k++) {
      const ambulo_muscle *own = ambulo_muscles_get(b.muscles, k);
      const ambulo_muscle *image = ambulo_muscles_get(b.muscles, own->mirror);
      size_t length = strlen(own->name);
      assert_non_null(image);
      assert_ptr_not_equal(image, own);
      assert_int_equal(image->mirror, k);
      assert_int_equal(strlen(image->name), length);
      assert_memory_equal(image->name, own->name, length - 1);
      assert_true(own->name[length - 1] == (k < ALL / 2 ? 'r' : 'l'));
      assert_true(image->name[length - 1] == (k < ALL / 2 ? 'l' : 'r'));
      assert_string_equal(image->group, own->group);
      assert_true(image->force == own->force && image->fiber == own->fiber);
    }
    body_free(&b);
  }
}

enum { STATES = 6, MOST_D = 48 };

typedef struct answers {
  double q[STATES * MOST_D], qd[STATES * MOST_D], tau[STATES * MOST_D], rate[STATES * MOST_D];
  double activation[STATES * ALL], force[STATES * ALL], reserve[STATES * MOST_D];
} answers;

static void share(const body *b, answers *s) {
  ambulo_sharing prices = ambulo_sharing_default();
  ambulo_sharing_states states = ambulo_sharing_states_default();
  ambulo_sharing_outputs out = ambulo_sharing_outputs_default();
  prices.metabolic = 0.5;
  states.count = STATES;
  states.q = s->q;
  states.qd = s->qd;
  states.tau = s->tau;
  states.tau_rate = s->rate;
  out.activation = s->activation;
  out.force = s->force;
  out.reserve = s->reserve;
  assert_int_equal(ambulo_muscles_share(b->muscles, &prices, &states, NULL, &out), AMBULO_OK);
}

/* the image of row k stands in row STATES - 1 - k, elsewhere among the kernel's lanes */
static void reflect(const body *b, const double *from, double *to) {
  for (int k = 0; k < STATES; k++)
    for (int i = 0; i < b->d; i++) {
      const ambulo_coordinate *c = ambulo_model_coordinate(b->model, i);
      to[(STATES - 1 - k) * b->d + c->mirror] = c->mirror_sign * from[k * b->d + i];
    }
}

static void a_mirrored_state_has_the_mirrored_sharing_to_the_bit(void **state) {
  (void)state;
  static answers own, image;
  random_source source = {11};
  for (int i = 0; i < BODIES; i++) {
    body b = body_of(bodies[i], SHIPPED, 0.0, 0.0);
    assert_true(b.d <= MOST_D);
    for (int k = 0; k < STATES * b.d; k++) {
      own.q[k] = random_between(&source, -0.3, 0.3);
      own.qd[k] = random_between(&source, -4, 4);
      own.tau[k] = random_between(&source, -50, 50);
      own.rate[k] = random_between(&source, -400, 400);
    }
    reflect(&b, own.q, image.q);
    reflect(&b, own.qd, image.qd);
    reflect(&b, own.tau, image.tau);
    reflect(&b, own.rate, image.rate);
    share(&b, &own);
    share(&b, &image);
    double most = 0.0;
    for (int k = 0; k < STATES; k++)
      for (int m = 0; m < b.m; m++) {
        int at = k * ALL + m;
        int there = (STATES - 1 - k) * ALL + ambulo_muscles_get(b.muscles, m)->mirror;
        assert_true(own.activation[at] == image.activation[there]);
        assert_true(own.force[at] == image.force[there]);
        most = fmax(most, own.activation[at]);
      }
    assert_true(most > 0.2);
    static double mirrored[STATES * MOST_D];
    reflect(&b, own.reserve, mirrored);
    for (int k = 0; k < STATES * b.d; k++) assert_true(mirrored[k] == image.reserve[k]);
    body_free(&b);
  }
}

/* ------------------------------------------------------------------------ sizes */

static void forces_follow_the_mass_and_lengths_the_leg(void **state) {
  (void)state;
  body small = body_of("lower_body_23", SHIPPED, 50.0, 1.5),
       heavy = body_of("lower_body_23", SHIPPED, 100.0, 1.5),
       tall = body_of("lower_body_23", SHIPPED, 50.0, 1.8);
  for (int i = 0; i < ALL; i++) {
    const ambulo_muscle *a = ambulo_muscles_get(small.muscles, i),
                        *b = ambulo_muscles_get(heavy.muscles, i),
                        *c = ambulo_muscles_get(tall.muscles, i);
    assert_close(b->force / a->force, pow(2.0, 2.0 / 3.0), 1e-12);
    assert_close(b->fiber / a->fiber, 1.0, 1e-12);
    assert_close(c->force / a->force, 1.0, 1e-12);
    assert_close(c->fiber / a->fiber, 1.2, 1e-12);
    assert_close(c->tendon / a->tendon, 1.2, 1e-12);
    for (int t = 0; t < a->term_count; t++) assert_close(c->length[t], 1.2 * a->length[t], 1e-12);
    for (int p = 0; p < a->pull_count; p++)
      assert_memory_equal(c->pulls[p].slopes, a->pulls[p].slopes,
                          (size_t)a->pulls[p].term_count * sizeof *a->pulls[p].slopes);
  }
  /* 75.3 kg in the file */
  assert_close(muscle_of(&small, "addbrev_l")->force, 625.82 * pow(50.0 / 75.3, 2.0 / 3.0), 1e-12);
  body_free(&small);
  body_free(&heavy);
  body_free(&tall);
}

/* a chain of three links, 0.5 m (0.3 along and 0.4 aside) and 0.45 m long, of 6 kg; one side */
#define CHAIN                                                                                      \
  MODEL_HEAD "links:\n"                                                                            \
             "  - {name: a, parent: none, joint: revolute, dh: [0, 0.4, 0.3, 0], " MODEL_BODY      \
             "}\n"                                                                                 \
             "  - {name: b, parent: a, joint: revolute, dh: [0, 0, 0.45, 0], " MODEL_BODY "}\n"    \
             "  - {name: c, parent: b, joint: revolute, dh: [0, 0, 0.2, 0], " MODEL_BODY "}\n"

#define ONE_SIDE                                                                                   \
  "ambulo: 1\nkind: muscles\nname: m\nsource: [own]\nlicense: CC0-1.0\n"                           \
  "subject: {mass: 48, thigh: 0.3, shank: 0.2}\n"                                                  \
  "joints:\n  one: {link: a, axes: a}\n  two: {link: b, axes: a}\n  three: {link: c, axes: b}\n"   \
  "muscles:\n  - {name: m, force: 800, fiber: 0.1, tendon: 0.2, coordinates: [c, b],\n"            \
  "     exponents: [[0, 0], [2, 1]], length: [0.3, 0.02], pennation: 0.3,\n"                       \
  "     pull: {three: {exponents: [[0, 0], [1, 0]], x: [1, 2], y: [3, 4], z: [5, 6]}}}\n"

static void sizes_come_from_the_distances_of_joints(void **state) {
  const char *path = scratch_path(state, "m.yaml");
  model_case chain = model_good(CHAIN);
  ambulo_muscles *muscles = NULL;
  scratch_write(path, ONE_SIDE);
  assert_int_equal(ambulo_muscles_load(path, chain.model, NULL, NULL, &muscles), AMBULO_OK);
  assert_int_equal(ambulo_muscles_count(muscles), 1);
  const ambulo_muscle *m = ambulo_muscles_get(muscles, 0);
  double scale = (0.5 + 0.45) / (0.3 + 0.2), q[] = {9.0, 0.5, 0.7};
  assert_int_equal(m->mirror, 0);
  assert_close(m->force, 800.0 * pow(6.0 / 48.0, 2.0 / 3.0), 1e-12);
  assert_close(m->fiber, 0.1 * scale, 1e-12);
  assert_close(m->tendon, 0.2 * scale, 1e-12);
  assert_close(m->pennation, 0.3, 0.0);
  assert_close(path_of(m, q, -1), scale * (0.3 + 0.02 * 0.7 * 0.7 * 0.5), 1e-12);
  assert_int_equal(m->pull_count, 1);
  assert_string_equal(m->pulls[0].joint, "three");
  assert_close(m->pulls[0].slopes[1][2], 6.0, 0.0);
  ambulo_muscles_free(muscles);
  model_shut(&chain);
}

/* ---------------------------------------------------------------------- OpenSim */

/* Lengths, m, and moment arms, m/rad, of opensim-core at three poses, rad, for the subject of
 * example3DWalking (subject_walk_scaled.osim, ankle and subtalar axes along those of the bodies
 * here): what bench/leg_muscles.py --sample writes. Arms in the order of the muscle's coordinates
 * in the file. */
static const char *const posed[] = {"hip_flexion_r", "hip_adduction_r", "hip_rotation_r",
                                    "knee_angle_r",  "ankle_angle_r",   "subtalar_angle_r"};
enum { POSED = 6, POSES = 3 };
static const double poses[POSES][POSED] = {
    {0.632792, 0.011399, 0.404269, 1.45071, 0.0786449, -0.206728},
    {-0.550373, -0.132645, 0.00685729, 0.942011, -0.0767313, 0.0554044},
    {0.810572, -0.273723, 0.414533, 0.911806, -0.499768, 0.296053}};
static const struct {
  const char *muscle;
  double fiber; /* in the file */
  double length[POSES], arms[POSES][POSED];
} of_opensim[] = {{"bflh_r",
                   0.0959815,
                   {0.410177, 0.367153, 0.446922},
                   {{-0.070199, 0.020525, -0.011596, 0.035469},
                    {-0.016860, 0.041689, -0.006675, 0.035460},
                    {-0.062724, 0.014516, -0.010662, 0.035646}}},
                  {"glmed1_r",
                   0.0844427,
                   {0.128732, 0.123323, 0.112344},
                   {{0.018517, -0.049730, 0.034027},
                    {-0.016197, -0.057509, -0.021270},
                    {0.007686, -0.043647, 0.044882}}},
                  {"gasmed_r",
                   0.0700482,
                   {0.508261, 0.514049, 0.489716},
                   {{0, 0, 0, 0.027199, -0.053603, -0.006088},
                    {0, 0, 0, 0.025100, -0.056593, -0.000716},
                    {0, 0, 0, 0.024879, -0.058273, 0.003928}}},
                  {"tibant_r",
                   0.0807343,
                   {0.361269, 0.364301, 0.378494},
                   {{0, 0, 0, 0, 0.052509, 0.016556},
                    {0, 0, 0, 0, 0.050079, 0.021121},
                    {0, 0, 0, 0, 0.042850, 0.024134}}}};

/* the left leg is the right one's image: the same numbers under its names */
static void check_paths(const body *b, size_t entry, int pose, int left) {
  char name[32];
  double q[MOST_D] = {0.0};
  (void)snprintf(name, sizeof name, "%s", of_opensim[entry].muscle);
  if (left) name[strlen(name) - 1] = 'l';
  const ambulo_muscle *m = muscle_of(b, name);
  int at[POSED];
  for (int i = 0; i < POSED; i++) {
    char coordinate[32];
    (void)snprintf(coordinate, sizeof coordinate, "%s", posed[i]);
    if (left) coordinate[strlen(coordinate) - 1] = 'l';
    at[i] = ambulo_model_find_coordinate(b->model, coordinate);
    assert_true(at[i] >= 0);
    q[at[i]] = poses[pose][i];
  }
  double scale = m->fiber / of_opensim[entry].fiber;
  assert_true(scale > 0.8 && scale < 1.2);
  assert_close(path_of(m, q, -1), scale * of_opensim[entry].length[pose], scale * 0.7e-3);
  for (int i = 0; i < POSED; i++) {
    double arm = 0.0;
    for (int k = 0; k < m->coordinate_count; k++)
      if (m->coordinates[k] == at[i]) arm = -path_of(m, q, k);
    assert_close(arm, scale * of_opensim[entry].arms[pose][i], scale * 5e-3);
  }
}

static void paths_are_those_of_opensim(void **state) {
  (void)state;
  body b = body_of("lower_body_23", SHIPPED, 0.0, 0.0);
  for (size_t entry = 0; entry < sizeof of_opensim / sizeof *of_opensim; entry++)
    for (int pose = 0; pose < POSES; pose++)
      for (int left = 0; left < 2; left++) check_paths(&b, entry, pose, left);
  body_free(&b);
}

/* -------------------------------------------------------------------- two sides */

/* a muscle of the trunk: coordinates that are their own mirror image and change their sign */
static void an_image_across_the_middle_is_reflected(void **state) {
  const char *path = scratch_path(state, "m.yaml");
  scratch_write(path, "ambulo: 1\nkind: muscles\nname: m\nsource: [own]\nlicense: CC0-1.0\n"
                      "subject: {mass: 75, thigh: 0.4, shank: 0.45}\nmirror: {_r: _l}\n"
                      "coordinates: {lumbar_bending: [-30, 10], lumbar_extension: [-20, 40]}\n"
                      "joints: {lumbar: {link: thorax, axes: pelvis}}\n"
                      "muscles:\n  - {name: back_r, force: 800, fiber: 0.1, tendon: 0.2,\n"
                      "     coordinates: [lumbar_extension, lumbar_bending],\n"
                      "     exponents: [[0, 0], [1, 0], [0, 1], [1, 1], [0, 2]],\n"
                      "     length: [0.3, 0.05, -0.04, 0.01, 0.02],\n"
                      "     pull: {lumbar: {exponents: [[0, 0], [0, 1]], x: [1, 2], y: [3, 4], "
                      "z: [5, 6]}}}\n");
  body b = body_of("lower_body_23", path, 0.0, 0.0);
  const ambulo_muscle *own = muscle_of(&b, "back_r"), *image = muscle_of(&b, "back_l");
  int bending = ambulo_model_find_coordinate(b.model, "lumbar_bending"),
      extension = ambulo_model_find_coordinate(b.model, "lumbar_extension");
  double q[MOST_D] = {0.0}, degree = acos(-1.0) / 180.0;
  q[extension] = 0.3;
  q[bending] = 0.2;
  double length = path_of(own, q, -1);
  q[bending] = -0.2;
  assert_close(path_of(image, q, -1), length, 0.0);
  for (int i = 0; i < 2; i++) {
    int turned = own->coordinates[i] == bending;
    assert_int_equal(image->coordinates[i], own->coordinates[i]);
    assert_close(own->range[i][0], degree * (turned ? -30 : -20), 1e-15);
    assert_close(image->range[i][0], degree * (turned ? -10 : -20), 1e-15);
    assert_close(image->range[i][1], degree * (turned ? 30 : 40), 1e-15);
  }
  static const double slopes[2][3] = {{1, 3, -5}, {-2, -4, 6}};
  assert_memory_equal(image->pulls[0].slopes, slopes, sizeof slopes);
  body_free(&b);
}

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_shipped_muscles_fit_every_body_with_their_joints),
      cmocka_unit_test(a_mirrored_state_has_the_mirrored_sharing_to_the_bit),
      cmocka_unit_test(forces_follow_the_mass_and_lengths_the_leg),
      SCRATCH_TEST(sizes_come_from_the_distances_of_joints),
      cmocka_unit_test(paths_are_those_of_opensim),
      SCRATCH_TEST(an_image_across_the_middle_is_reflected),
  };
  return cmocka_run_group_tests_name("definitions/muscle_file", tests, NULL, NULL);
}
