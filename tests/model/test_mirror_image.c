/* Random bodies that are their own mirror image are recognized, whatever their frames; one number
 * changed is found, with the name of what it moved. What "is its own mirror image" means is asked
 * of the dynamics: mirrored states have mirrored torques. */
#include "mechanics/lagrangian.h"
#include "model/mirror_image.h"

#include "ambulo/tools/tools.h"
#include "ambulo/tools/load.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/symmetric_model.h"
#include "support/test.h"

enum { MOST = 64, BODIES = 150 };

static ambulo_model *create(const symmetric_body *b) {
  ambulo_model *model = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  if (ambulo_model_create(&b->definition, NULL, list, &model)) assert_message(list, 0, "nothing");
  ambulo_diagnostics_free(list);
  assert_non_null(model);
  assert_true(ambulo_model_coordinate_count(model) <= MOST);
  return model;
}

static void torques(const ambulo_model *model, double (*state)[MOST], double *tau) {
  double wrench[6], points[3 * symmetric_points + 3 * 32];
  void *scratch = malloc(ambulo__lagrangian_scratch_size(model));
  const ambulo_outputs out = {sizeof out, tau, wrench, points};
  assert_int_equal(ambulo__lagrangian(0, model, state[0], state[1], state[2], &out, scratch),
                   AMBULO_OK);
  free(scratch);
}

/* how far the torques of mirrored states are from mirrored, relative to the largest */
static double asymmetry(const ambulo_model *model) {
  double state[3][MOST], image[3][MOST], tau[MOST], other[MOST], worst = 0.0, size = 1e-9;
  int count = ambulo_model_coordinate_count(model);
  for (int i = 0; i < count; i++) {
    const ambulo_coordinate *c = ambulo_model_coordinate(model, i);
    for (int k = 0; k < 3; k++) {
      state[k][i] = sin(1.0 + 2.39996 * (i + 31 * k));
      image[k][c->mirror] = c->mirror_sign * state[k][i];
    }
  }
  torques(model, state, tau);
  torques(model, image, other);
  for (int i = 0; i < count; i++) {
    const ambulo_coordinate *c = ambulo_model_coordinate(model, i);
    worst = fmax(worst, fabs(other[c->mirror] - c->mirror_sign * tau[i]));
    size = fmax(size, fabs(tau[i]));
  }
  return worst / size;
}

static void make(symmetric_body *b, uint64_t seed) {
  symmetric_make(b, seed, 1 + (int)(seed % 5), 1 + (int)(seed % 3), 1 + (int)(seed % 6));
}

/* the verdict, and the first message if there is one */
static ambulo_status check(const ambulo_model *model, char message[1024]) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_model_check_mirror(model, NULL, list);
  const ambulo_diagnostic *first = ambulo_diagnostics_get(list, 0);
  assert_int_equal(status != AMBULO_OK, first != NULL);
  message[0] = '\0';
  if (first) (void)snprintf(message, 1024, "%s", first->message);
  ambulo_diagnostics_free(list);
  return status;
}

static void symmetric_bodies_are_never_refused(void **state) {
  (void)state;
  char message[1024];
  for (uint64_t seed = 1; seed <= BODIES; seed++) {
    symmetric_body b;
    make(&b, seed);
    ambulo_model *model = create(&b), *sloped = NULL;
    if (asymmetry(model) > 1e-9) print_error("the fixture is wrong: seed %d\n", (int)seed);
    assert_true(asymmetry(model) <= 1e-9);
    if (check(model, message)) print_error("seed %d: %s\n", (int)seed, message);
    assert_string_equal(message, "");
    ambulo_conditions slope = ambulo_conditions_default();
    slope.slope = 0.3;
    assert_int_equal(ambulo_model_adapt(model, &slope, NULL, NULL, &sloped), AMBULO_OK);
    assert_int_equal(check(sloped, message), AMBULO_OK);
    ambulo_model_free(sloped);
    ambulo_model_free(model);
  }
}

/* ---------------------------------------------------------------- one number */

static int is_below(const symmetric_body *b, int link, int root) {
  while (link >= 0 && link != root) link = b->links[link].parent;
  return link == root;
}

/* first link of the segment that `link` belongs to */
static int segment_root(const symmetric_body *b, int link) {
  while (b->links[link].parent >= 0 && b->links[link].type == AMBULO_FIXED)
    link = b->links[link].parent;
  return link;
}

/* does the message name a link or coordinate of what the change moved? A partner is as good. */
static int names_it(const symmetric_body *b, const ambulo_model *model, int changed,
                    const char *message) {
  char quoted[40];
  for (int i = 0; i < b->definition.link_count; i++) {
    int moved = is_below(b, i, changed) || segment_root(b, i) == segment_root(b, changed);
    int link = ambulo_model_find_link(model, b->links[i].name);
    int coordinate = ambulo_model_link(model, link)->coordinate;
    if (!moved) continue;
    (void)snprintf(quoted, sizeof quoted, "'%s'", b->links[i].name);
    if (strstr(message, quoted)) return 1;
    if (coordinate < 0) continue;
    (void)snprintf(quoted, sizeof quoted, "'%s'", ambulo_model_coordinate(model, coordinate)->name);
    if (strstr(message, quoted)) return 1;
  }
  for (int i = 0; i < b->definition.point_count; i++) {
    (void)snprintf(quoted, sizeof quoted, "'%s'", b->points[i].name);
    if (is_below(b, b->points[i].link, changed) && strstr(message, quoted)) return 1;
  }
  return 0;
}

enum { NUMBERS = 9 };

/* changes one number of a link by a part in a thousand; 0 if there is nothing to change */
static int change(symmetric_body *b, int index, int number) {
  ambulo_link *link = &b->links[index];
  double *dh[4] = {&link->theta, &link->d, &link->a, &link->alpha};
  int across = b->across[index], in_trunk = index < b->trunk;
  if (number < 4) {
    *dh[number] += 1e-3;
    return 1;
  }
  if (link->mass == 0) return 0;
  if (number < 7) {
    if (in_trunk && number - 4 != across) return 0; /* it may move in the plane */
    link->com[number - 4] += 1e-3;
    return 1;
  }
  if (in_trunk) return 0;
  if (number == 7) link->mass *= 1.001;
  for (int k = 0; k < 6; k++) link->inertia[k] *= 1.001;
  return 1;
}

static void one_number_is_found_by_name(void **state) {
  (void)state;
  char message[1024];
  int found = 0, kinds[NUMBERS] = {0};
  for (uint64_t seed = 1; seed <= 12 * BODIES; seed++) {
    symmetric_body b;
    make(&b, 1 + seed / 12);
    random_source source = {seed};
    int index = random_below(&source, b.definition.link_count);
    int number = random_below(&source, NUMBERS);
    if (!change(&b, index, number)) continue;
    ambulo_model *model = create(&b);
    /* some change nothing, such as a length along an axis that carries nothing */
    if (asymmetry(model) > 1e-8) {
      if (!check(model, message))
        print_error("seed %d: number %d of %s is not found\n", (int)seed, number,
                    b.links[index].name);
      if (!names_it(&b, model, index, message))
        print_error("seed %d: number %d of %s: %s\n", (int)seed, number, b.links[index].name,
                    message);
      assert_true(names_it(&b, model, index, message));
      kinds[number]++;
      found++;
    }
    ambulo_model_free(model);
  }
  assert_true(found > 500);
  for (int k = 0; k < NUMBERS; k++) assert_true(kinds[k] > 10);
}

/* --------------------------------------------------------------- a known body */

static ambulo_model *shipped(const char *name, const ambulo_subject *subject) {
  char path[160];
  ambulo_model *model = NULL;
  (void)snprintf(path, sizeof path, "models/%s.yaml", name);
  assert_int_equal(ambulo_model_load(path, subject, NULL, NULL, &model), AMBULO_OK);
  return model;
}

/* parts in a hundred thousand are found, parts in a hundred million are rounding */
static void the_tolerance_is_as_documented(void **state) {
  (void)state;
  char message[1024];
  static const double parts[2] = {1e-5, 1e-8};
  for (int fine = 0; fine < 2; fine++) {
    for (int number = 0; number < 4; number++) {
      ambulo_model *model = shipped("lower_body_18", NULL);
      ambulo_link *shank = &model->links[ambulo_model_find_link(model, "shank_l")];
      double *numbers[4] = {&shank->mass, &shank->com[1], &shank->inertia[0], &shank->alpha};
      *numbers[number] += parts[fine] * (number == 1 || number == 3 ? 1.0 : *numbers[number]);
      assert_int_equal(check(model, message), fine ? AMBULO_OK : AMBULO_E_MODEL);
      ambulo_model_free(model);
    }
  }
}

static void shipped_bodies_are_symmetric_at_any_size(void **state) {
  (void)state;
  static const char *const names[] = {"lower_body_18", "lower_body_21", "lower_body_23",
                                      "whole_body_31", "walker_2d",     "opensim_2d_gait10",
                                      "yardstick_body"};
  const size_t size = sizeof(ambulo_subject);
  const ambulo_subject subjects[] = {ambulo_subject_default(),
                                     {size, 50, 1.52, AMBULO_FEMALE},
                                     {size, 117, 1.97, AMBULO_MALE},
                                     {size, 1, 0.31, AMBULO_MALE}};
  char message[1024];
  for (int i = 0; i < 7; i++) {
    for (int s = 0; s < (i < 5 ? 4 : 1); s++) {
      ambulo_model *model = shipped(names[i], &subjects[s]);
      if (check(model, message)) print_error("%s: %s\n", names[i], message);
      assert_string_equal(message, "");
      ambulo_model_free(model);
    }
  }
}

/* one value of lower_body_18, and what has to be said about it */
static void differences_are_told_with_both_numbers(void **state) {
  (void)state;
  static const struct {
    const char *key, *message;
  } cases[] = {
      {"links[shank_l].body.mass=0.0866", "the mass of 'shank_r' is 3.2475 kg, that of its mirror "
                                          "partner 'shank_l' 6.495 kg; expected "
                                          "the same"},
      {"links[shank_l].body.com=[0, -0.109559, 0.01]",
       "the centre of mass of 'shank_r' along left at q = 0 is -0.0849993 m, that of its mirror "
       "partner 'shank_l' 0.0674992 m; expected the opposite"},
      {"links[pelvis].bodies[head].com=[0, 0.41626, 0.01]",
       "the centre of mass of 'pelvis' along left at q = 0 is -0.002"},
      {"links[shank_l].body.gyration=[0.06257, 0.025427, 0.0614]",
       "the moment of inertia of 'shank_r' about left is 0.037"},
      {"links[ankle_l].dh=[-90, 0, 0.26, 0]",
       "the axis of 'ankle_angle_r' along up at q = 0 is 0.0749997 m, that of its mirror partner "
       "'ankle_angle_l' 0.0562432 m; expected the same"},
      {"links[ankle_l].dh=[-91, 0, 0.249282, 0]",
       "the axis of 'ankle_angle_r' along forward at q = 0 is 0 m, that of its mirror partner "
       "'ankle_angle_l' "},
      {"links[shank_l].dh=[-90, 0, 0.01, 180]",
       "the centre of mass of 'shank_r' along forward at q = 0 is 0 m, that of its mirror partner "
       "'shank_l' "},
      {"links[knee_l].dh=[-90, 0, 0.242504, 170]", "the axis of 'knee_angle_r' points to (0, 0, 1) "
                                                   "along forward, up, left at q = 0, that of its "
                                                   "mirror partner 'knee_angle_l' to ("},
      {"points[toe_l].position=[0.12, -0.042857, 0]",
       "the place of 'toe_r' along forward at q = 0 is 0.195001 m, that of its mirror partner "
       "'toe_l' 0.21 m; expected the same"},
      {"feet[left].toe=[ball_l, toe_medial_l]", "the place of 'toe_lateral_r' along left"},
      {"links[shank_l].coordinate.armature=0.1",
       "armature of 'knee_angle_r' is 0 kg m^2, that of its mirror partner 'knee_angle_l' 22.9688"},
      {"links[shank_l].coordinate.damping=2", "damping of 'knee_angle_r' is 0 N m s/rad, that of"},
      {"links[shank_l].coordinate.friction=3", "dry friction of 'knee_angle_r' is 0 N m, that of"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    ambulo_model *model = NULL;
    assert_int_equal(ambulo_model_load_with("models/lower_body_18.yaml", &cases[i].key, 1, NULL,
                                            NULL, NULL, &model),
                     AMBULO_OK);
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    assert_int_equal(ambulo_model_check_mirror(model, NULL, list), AMBULO_E_MODEL);
    assert_message(list, 0, cases[i].message);
    /* what hangs on the displaced part is no news */
    assert_int_equal(ambulo_diagnostics_count(list), 1);
    ambulo_diagnostics_free(list);
    ambulo_model_free(model);
  }
}

/* pairs and signs that no mirror makes */
static void wrong_pairs_are_told(void **state) {
  (void)state;
  static const struct {
    int one, other; /* coordinates that are made a pair; the same: its own image */
    double sign;
    const char *message;
  } cases[] = {
      {2, 2, 1,
       "the axis of 'pelvis_tz' points to (0, 0, -1) along forward, up, left at q = 0; with "
       "itself as mirror image and mirror_sign 1 expected (0, 0, 1)"},
      {3, 3, -1, "the axis of 'pelvis_tilt' points"},
      {9, 15, -1,
       "'knee_angle_l' to (0, 0, 1); with this pair and mirror_sign -1 expected (0, 0, -1)"},
      {9, 9, 1,
       "'knee_angle_r' is its own mirror image, but hangs on 'hip_rotation_r', whose mirror "
       "partner is 'hip_rotation_l'"},
      {9, 16, 1,
       "'knee_angle_r' hangs on 'hip_rotation_r', its mirror partner 'ankle_angle_l' on "
       "'knee_angle_l'; expected 'hip_rotation_l', the mirror partner of "
       "'hip_rotation_r'"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char message[1024];
    ambulo_model *model = shipped("lower_body_18", NULL);
    ambulo_coordinate *c = model->coordinates;
    int one = cases[i].one, other = cases[i].other;
    c[c[one].mirror].mirror = c[one].mirror;
    c[c[other].mirror].mirror = c[other].mirror;
    c[one].mirror = other;
    c[other].mirror = one;
    c[one].mirror_sign = c[other].mirror_sign = cases[i].sign;
    assert_int_equal(check(model, message), AMBULO_E_MODEL);
    if (!strstr(message, cases[i].message))
      print_error("case %zu says\n  %s\nexpected\n  %s\n", i, message, cases[i].message);
    assert_non_null(strstr(message, cases[i].message));
    ambulo_model_free(model);
  }
}

static void the_sign_that_fits_is_hinted(void **state) {
  (void)state;
  ambulo_model *model = shipped("lower_body_18", NULL);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  model->coordinates[5].mirror_sign = 1;
  assert_int_equal(ambulo_model_check_mirror(model, NULL, list), AMBULO_E_MODEL);
  assert_message(list, 0, "hint: mirror_sign: -1 is the sign that these axes have");
  ambulo_diagnostics_free(list);
  ambulo_model_free(model);
}

static void feet_follow_the_coordinates(void **state) {
  (void)state;
  char message[1024];
  ambulo_model *model = shipped("lower_body_18", NULL);
  model->feet[0].mirror = 0;
  model->feet[1].mirror = 1;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_model_check_mirror(model, NULL, list), AMBULO_E_MODEL);
  assert_message(list, 0, "hint: 'mirror' of a foot names the one on the other side");
  ambulo_diagnostics_free(list);
  assert_int_equal(check(model, message), AMBULO_E_MODEL);
  assert_non_null(strstr(message, "foot 'right' moves with 'subtalar_angle_r', its mirror image "
                                  "'right' with 'subtalar_angle_r'; expected 'subtalar_angle_l'"));
  model->feet[0].mirror = 1;
  model->feet[1].mirror = 0;
  model->feet[1].has_tip = 0;
  assert_int_equal(check(model, message), AMBULO_E_MODEL);
  assert_non_null(strstr(message, "foot 'right' has 4 corners and a tip, its mirror partner 'left' "
                                  "4 corners and no tip"));
  ambulo_model_free(model);
}

/* a point that no foot uses is a marker: it needs no partner */
static void markers_need_no_partner(void **state) {
  (void)state;
  char message[1024];
  ambulo_model *model = shipped("lower_body_18", NULL);
  int ankle = ambulo_model_find_point(model, "ankle_l");
  model->points[ankle].position[1] += 0.05;
  assert_int_equal(check(model, message), AMBULO_OK);
  ambulo_model_free(model);
}

static void any_allocation_may_fail(void **state) {
  (void)state;
  ambulo_model *model = shipped("walker_2d", NULL);
  for (long k = 0; k < 100; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_status status = ambulo_model_check_mirror(model, &allocator, NULL);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  assert_int_equal(ambulo_model_check_mirror(NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(symmetric_bodies_are_never_refused),
                                     cmocka_unit_test(one_number_is_found_by_name),
                                     cmocka_unit_test(the_tolerance_is_as_documented),
                                     cmocka_unit_test(shipped_bodies_are_symmetric_at_any_size),
                                     cmocka_unit_test(differences_are_told_with_both_numbers),
                                     cmocka_unit_test(wrong_pairs_are_told),
                                     cmocka_unit_test(the_sign_that_fits_is_hinted),
                                     cmocka_unit_test(feet_follow_the_coordinates),
                                     cmocka_unit_test(markers_need_no_partner),
                                     cmocka_unit_test(any_allocation_may_fail)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
