/* What joints bear: the intersegmental force, found as the generalized forces of three massless
 * sliders that are put into the tree at the cut; Newton's law of the whole body; the muscles. */
#include "ambulo/mechanics.h"
#include "ambulo/tools/load.h"
#include "mechanics/pose.h"
#include "support/cut_body.h"
#include "support/fail_alloc.h"
#include "support/random_model.h"

enum { ROWS = 6, MUSCLES = 5, TERMS = 3, CUTS = 4 };

/* ------------------------------------------------------------ muscles across it */

typedef struct crossing {
  ambulo_muscle list[MUSCLES];
  ambulo_muscle_pull pulls[MUSCLES][CUTS];
  unsigned char exponents[MUSCLES][CUTS][TERMS][AMBULO_MUSCLE_COORDINATES];
  double slopes[MUSCLES][CUTS][TERMS][3];
  ambulo_muscles *muscles;
} crossing;

static const double zero_length[TERMS];

/* each muscle spans two coordinates, and crosses some of the cuts */
static void cross(crossing *c, const ambulo_model *model, const ambulo__cut *cuts, int count,
                  random_source *source) {
  static const char *const names[MUSCLES] = {"a", "b", "c", "d", "e"};
  const int d = ambulo_model_coordinate_count(model);
  ambulo_muscles_definition definition = ambulo_muscles_definition_default();
  memset(c, 0, sizeof *c);
  for (int i = 0; i < MUSCLES; i++) {
    ambulo_muscle *m = &c->list[i];
    *m = ambulo_muscle_default();
    m->name = names[i];
    m->force = 1000.0;
    m->fiber = 0.1;
    m->coordinate_count = 2;
    m->coordinates[0] = d - 1;
    m->coordinates[1] = d - 2;
    m->term_count = 1;
    m->exponents = (const unsigned char(*)[AMBULO_MUSCLE_COORDINATES])c->exponents[i][0];
    m->length = zero_length;
    m->pulls = c->pulls[i];
    for (int k = 0; k < count; k++) {
      if (i > 0 && random_unit(source) < 0.4) continue; /* the first crosses each */
      int at = m->pull_count++;
      c->pulls[i][at] = (ambulo_muscle_pull){
          cuts[k].name,
          cuts[k].link,
          cuts[k].axes,
          TERMS,
          (const unsigned char(*)[AMBULO_MUSCLE_COORDINATES])c->exponents[i][at],
          (const double(*)[3])c->slopes[i][at]};
      for (int t = 0; t < TERMS; t++)
        for (int axis = 0; axis < 3; axis++) {
          c->exponents[i][at][t][axis % 2] = (unsigned char)random_below(source, 4);
          c->slopes[i][at][t][axis] = random_between(source, -1.0, 1.0);
        }
    }
  }
  definition.muscles = c->list;
  definition.muscle_count = MUSCLES;
  assert_int_equal(ambulo_muscles_create(model, &definition, NULL, NULL, &c->muscles), AMBULO_OK);
}

/* along the axes of a cut, on what lies below */
static void by_muscles(const crossing *c, const char *joint, const double *q, const double *force,
                       double out[3]) {
  out[0] = out[1] = out[2] = 0.0;
  for (int i = 0; i < MUSCLES; i++)
    for (int p = 0; p < c->list[i].pull_count; p++) {
      if (strcmp(c->pulls[i][p].joint, joint) != 0) continue;
      for (int t = 0; t < TERMS; t++) {
        double powers = 1.0;
        for (int k = 0; k < 2; k++)
          powers *= pow(q[c->list[i].coordinates[k]], c->exponents[i][p][t][k]);
        for (int axis = 0; axis < 3; axis++)
          out[axis] -= force[i] * powers * c->slopes[i][p][t][axis];
      }
    }
}

/* ----------------------------------------------------------------- the identity */

static double largest_force; /* of what is compared, in body weights: it must not be nothing */

static void check_cuts(const ambulo_model *model, const ambulo__cut *cuts, int count,
                       uint64_t seed) {
  static crossing c;
  static double q[ROWS * CUT_LINKS], qd[ROWS * CUT_LINKS], qdd[ROWS * CUT_LINKS], grf[ROWS * 3 * 8],
      force[ROWS * MUSCLES], contact[ROWS * CUTS * 3], between[ROWS * CUTS * 3];
  random_source source = {seed};
  const int d = ambulo_model_coordinate_count(model), feet = ambulo_model_foot_count(model);
  const double *g = ambulo_model_gravity(model);
  double weight = ambulo_model_mass(model) * sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  cross(&c, model, cuts, count, &source);
  for (int i = 0; i < ROWS * d; i++) {
    q[i] = random_between(&source, -1.5, 1.5);
    qd[i] = random_between(&source, -3.0, 3.0);
    qdd[i] = random_between(&source, -10.0, 10.0);
  }
  for (int i = 0; i < ROWS * 3 * feet; i++) grf[i] = random_between(&source, -1.0, 1.0) * weight;
  for (int i = 0; i < ROWS * MUSCLES; i++) force[i] = random_between(&source, 0.0, 1.0) * weight;
  const ambulo__cut_motion motion = {ROWS, q, qd, qdd, feet ? grf : NULL, force, 0, NULL, NULL};
  ambulo__cut found[CUTS];
  assert_int_equal(ambulo__cuts(c.muscles, CUTS, found), count);
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__joint_contact(c.muscles, found, count, &motion, &a, contact, between),
                   AMBULO_OK);
  for (int k = 0; k < ROWS; k++)
    for (int j = 0; j < count; j++) {
      double want[3], pulled[3], size = weight;
      const double *got = between + 3 * (k * count + j), *all = contact + 3 * (k * count + j);
      assert_string_equal(found[j].name, cuts[j].name);
      by_sliders(model, &cuts[j], q + k * d, qd + k * d, qdd + k * d,
                 feet ? grf + 3 * k * feet : NULL, want);
      by_muscles(&c, cuts[j].name, q + k * d, force + k * MUSCLES, pulled);
      for (int axis = 0; axis < 3; axis++) size = fmax(size, fabs(want[axis]));
      for (int axis = 0; axis < 3; axis++) {
        assert_true(fabs(got[axis] - want[axis]) <= 1e-12 * size);
        assert_true(fabs(all[axis] + pulled[axis] - want[axis]) <=
                    1e-12 * (size + fabs(pulled[axis])));
        largest_force = fmax(largest_force, fabs(want[axis]) / weight);
      }
    }
  ambulo_muscles_free(c.muscles);
}

static void sliders_bear_what_joints_do_in_random_trees(void **state) {
  (void)state;
  static const char *const names[CUTS] = {"j0", "j1", "j2", "j3"};
  static random_tree tree;
  for (uint64_t seed = 1; seed <= 12; seed++) {
    ambulo_model *model = NULL;
    ambulo__cut cuts[CUTS];
    int count = 0;
    largest_force = 0.0;
    random_tree_make(&tree, seed, 10);
    assert_int_equal(ambulo_model_create(&tree.definition, NULL, NULL, &model), AMBULO_OK);
    /* from the ends inwards: there is most above them */
    for (int i = ambulo_model_link_count(model) - 1; i >= 0 && count < CUTS; i -= 2) {
      int parent = ambulo_model_link(model, i)->parent;
      if (parent < 0) continue;
      cuts[count] = (ambulo__cut){names[count], i, parent};
      count++;
    }
    assert_true(count >= 2);
    check_cuts(model, cuts, count, seed);
    assert_true(largest_force > 1e-3);
    ambulo_model_free(model);
  }
}

/* with toes, and the ground under both feet; massless links lie between pelvis and thigh */
static void sliders_bear_what_joints_do_in_a_body(void **state) {
  (void)state;
  static const struct {
    const char *name, *link, *axes;
  } joints[CUTS] = {{"hip_r", "thigh_r", "pelvis"},
                    {"knee_r", "shank_r", "thigh_r"},
                    {"ankle_l", "talus_l", "shank_l"},
                    {"hip_l", "thigh_l", "pelvis"}};
  ambulo_model *model = NULL;
  ambulo__cut cuts[CUTS];
  assert_int_equal(ambulo_model_load("models/lower_body_23.yaml", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  for (int i = 0; i < CUTS; i++) {
    cuts[i] = (ambulo__cut){joints[i].name, ambulo_model_find_link(model, joints[i].link),
                            ambulo_model_find_link(model, joints[i].axes)};
    assert_true(cuts[i].link > cuts[i].axes && cuts[i].axes >= 0);
  }
  largest_force = 0.0;
  for (uint64_t seed = 1; seed <= 4; seed++) check_cuts(model, cuts, CUTS, seed);
  assert_true(largest_force > 1.0);
  ambulo_model_free(model);
}

/* -------------------------------------------------------------- the whole body */

/* cut off at each link on the world, the body needs the root wrench's force */
static void all_links_need_the_root_force(void **state) {
  (void)state;
  static random_tree tree;
  static double q[CUT_LINKS], qd[CUT_LINKS], qdd[CUT_LINKS];
  for (uint64_t seed = 1; seed <= 20; seed++) {
    ambulo_model *model = NULL;
    crossing c;
    random_source source = {seed};
    ambulo__cut cuts[CUT_LINKS];
    int count = 0;
    double between[3 * CUT_LINKS], force[MUSCLES] = {0.0}, sum[3] = {0.0}, wrench[6];
    random_tree_make(&tree, seed, 12);
    if (seed % 2) random_tree_couple(&tree, seed);
    assert_int_equal(ambulo_model_create(&tree.definition, NULL, NULL, &model), AMBULO_OK);
    cross(&c, model, NULL, 0, &source);
    for (int i = 0; i < ambulo_model_coordinate_count(model); i++) {
      q[i] = random_between(&source, -3, 3);
      qd[i] = random_between(&source, -3, 3);
      qdd[i] = random_between(&source, -10, 10);
    }
    for (int i = 0; i < ambulo_model_link_count(model); i++)
      if (ambulo_model_link(model, i)->parent < 0) cuts[count++] = (ambulo__cut){"root", i, i};
    const ambulo__cut_motion motion = {1, q, qd, qdd, NULL, force, 0, NULL, NULL};
    ambulo_allocator a = ambulo__allocator_or_default(NULL);
    double contact[3 * CUT_LINKS];
    assert_int_equal(ambulo__joint_contact(c.muscles, cuts, count, &motion, &a, contact, between),
                     AMBULO_OK);
    assert_memory_equal(contact, between, (size_t)(3 * count) * sizeof *contact);
    ambulo__pose pose;
    assert_int_equal(ambulo__pose_create(model, &a, &pose), AMBULO_OK);
    ambulo__pose_at(&pose, q);
    for (int j = 0; j < count; j++)
      for (int w = 0; w < 3; w++)
        for (int k = 0; k < 3; k++)
          sum[w] += pose.frames[12 * cuts[j].axes + 4 * w + k] * between[3 * j + k];
    ambulo__pose_free(&pose);
    ambulo_mechanics *mechanics = NULL;
    ambulo_outputs outputs = ambulo_outputs_default();
    outputs.wrench = wrench;
    assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
    assert_int_equal(ambulo_mechanics_inverse_dynamics(mechanics, 1, q, qd, qdd, &outputs),
                     AMBULO_OK);
    ambulo_mechanics_free(mechanics);
    double size = 9.81 * ambulo_model_mass(model);
    for (int w = 0; w < 3; w++) size = fmax(size, fabs(wrench[3 + w]));
    for (int w = 0; w < 3; w++) assert_true(fabs(sum[w] - wrench[3 + w]) <= 1e-12 * size);
    ambulo_muscles_free(c.muscles);
    ambulo_model_free(model);
  }
}

/* ------------------------------------------------------------------- the rest */

/* a body that stands still: each hip bears the thighs', shanks' and feet's weight less the ground
 */
static void a_standing_leg(void **state) {
  (void)state;
  ambulo_model *model = NULL;
  crossing c;
  random_source source = {3};
  assert_int_equal(ambulo_model_load("models/lower_body_23.yaml", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  const int d = ambulo_model_coordinate_count(model);
  const double *const still = calloc((size_t)d, sizeof *still);
  double below = 0.0, weight = 9.81 * ambulo_model_mass(model), contact[6], without[6];
  const ambulo__cut cuts[] = {
      {"hip_r", ambulo_model_find_link(model, "thigh_r"), ambulo_model_find_link(model, "pelvis")},
      {"hip_l", ambulo_model_find_link(model, "thigh_l"), ambulo_model_find_link(model, "pelvis")}};
  for (int i = 0; i < ambulo_model_link_count(model); i++) {
    const char *name = ambulo_model_link(model, i)->name;
    if (!strcmp(name + strlen(name) - 2, "_r")) below += ambulo_model_link(model, i)->mass;
  }
  double grf[6] = {0.0}, force[MUSCLES] = {0.0};
  grf[3 * ambulo_model_find_foot(model, "right") + 1] = weight;
  cross(&c, model, NULL, 0, &source);
  const ambulo__cut_motion motion = {1, still, still, still, grf, force, 0, NULL, NULL};
  ambulo__cut_motion unloaded = motion;
  unloaded.grf = NULL;
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__joint_contact(c.muscles, cuts, 2, &motion, &a, contact, NULL),
                   AMBULO_OK);
  assert_int_equal(ambulo__joint_contact(c.muscles, cuts, 2, &unloaded, &a, without, NULL),
                   AMBULO_OK);
  assert_close(contact[1], 9.81 * below - weight, 1e-13);
  assert_close(contact[4], 9.81 * below, 1e-13);
  assert_close(without[1], 9.81 * below, 1e-13);
  assert_true(fabs(contact[0]) < 1e-10 && fabs(contact[2]) < 1e-10);
  ambulo_muscles_free(c.muscles);
  free((double *)still);
  ambulo_model_free(model);
}

/* the box's two hands press on the lumbar joint, one of them on the elbow, none on the hip */
static void what_hands_hold_is_borne_above_them(void **state) {
  (void)state;
  enum { JOINTS = 3, LOADED = 2 };
  static const char *const names[JOINTS][2] = {
      {"thorax", "pelvis"}, {"forearm_l", "upper_arm_l"}, {"thigh_r", "pelvis"}};
  ambulo_model *model = NULL;
  crossing c;
  random_source source = {11};
  assert_int_equal(ambulo_model_load("models/whole_body_29.yaml", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  static double q[LOADED * CUT_LINKS], rates[LOADED * CUT_LINKS];
  double f[LOADED][2][3], force[LOADED * MUSCLES] = {0.0}, got[LOADED][JOINTS][3],
                                         without[LOADED][JOINTS][3];
  for (int i = 0; i < LOADED * CUT_LINKS; i++) {
    q[i] = random_between(&source, -1, 1);
    rates[i] = random_between(&source, -1, 1);
  }
  for (int i = 0; i < LOADED * 6; i++) (&f[0][0][0])[i] = random_between(&source, -200, 200);
  ambulo_hold hold = ambulo_hold_default();
  hold.hand[0] = ambulo_model_find_point(model, "hand_r");
  hold.hand[1] = ambulo_model_find_point(model, "hand_l");
  ambulo__cut cuts[JOINTS];
  for (int j = 0; j < JOINTS; j++)
    cuts[j] = (ambulo__cut){names[j][0], ambulo_model_find_link(model, names[j][0]),
                            ambulo_model_find_link(model, names[j][1])};
  cross(&c, model, NULL, 0, &source);
  ambulo__cut_motion motion = {LOADED, q, rates, rates, NULL, force, 0, NULL, NULL};
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__joint_contact(c.muscles, cuts, JOINTS, &motion, &a, without[0][0], NULL),
                   AMBULO_OK);
  motion.holds = 1;
  motion.hold = &hold;
  motion.hand_force = &f[0][0][0];
  assert_int_equal(ambulo__joint_contact(c.muscles, cuts, JOINTS, &motion, &a, got[0][0], NULL),
                   AMBULO_OK);
  ambulo__pose pose;
  assert_int_equal(ambulo__pose_create(model, &a, &pose), AMBULO_OK);
  for (int row = 0; row < LOADED; row++) {
    ambulo__pose_at(&pose, q + row * ambulo_model_coordinate_count(model));
    for (int j = 0; j < JOINTS; j++)
      for (int axis = 0; axis < 3; axis++) {
        double want = 0.0;
        for (int w = 0; w < 3; w++)
          want += pose.frames[12 * cuts[j].axes + 4 * w + axis] *
                  (j == 2 ? 0.0 : f[row][1][w] + (j == 0 ? f[row][0][w] : 0.0));
        assert_true(fabs(got[row][j][axis] - without[row][j][axis] - want) < 1e-9);
      }
  }
  ambulo__pose_free(&pose);
  ambulo_muscles_free(c.muscles);
  ambulo_model_free(model);
}

static void cuts_are_listed_once_and_no_further(void **state) {
  (void)state;
  static random_tree tree;
  ambulo_model *model = NULL;
  crossing c;
  random_source source = {5};
  random_tree_make(&tree, 4, 8);
  assert_int_equal(ambulo_model_create(&tree.definition, NULL, NULL, &model), AMBULO_OK);
  ambulo__cut cuts[CUTS], found[CUTS] = {{"-", 7, 7}, {"-", 7, 7}, {"-", 7, 7}, {"-", 7, 7}};
  int child = ambulo_model_link_count(model) - 1;
  while (ambulo_model_link(model, child)->parent < 0) child--;
  static const char *const names[] = {"z", "y", "x"};
  for (int k = 0; k < 3; k++)
    cuts[k] = (ambulo__cut){names[k], child, ambulo_model_link(model, child)->parent};
  cross(&c, model, cuts, 3, &source);
  assert_int_equal(ambulo__cuts(c.muscles, 2, found), 2);
  assert_string_equal(found[2].name, "-");
  assert_int_equal(ambulo__cuts(c.muscles, CUTS, found), 3);
  for (int k = 0; k < 3; k++) assert_string_equal(found[k].name, names[k]);
  /* memory */
  static double still[CUT_LINKS];
  double force[MUSCLES] = {0.0}, contact[9];
  const ambulo__cut_motion motion = {1, still, still, still, NULL, force, 0, NULL, NULL};
  long k = 0;
  for (int failed = 1; failed; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_status status =
        ambulo__joint_contact(c.muscles, found, 3, &motion, &hook, contact, NULL);
    failed = memory.failed;
    assert_int_equal(status, failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_int_equal(memory.live, 0);
  }
  assert_true(k >= 3);
  ambulo_muscles_free(c.muscles);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sliders_bear_what_joints_do_in_random_trees),
      cmocka_unit_test(sliders_bear_what_joints_do_in_a_body),
      cmocka_unit_test(all_links_need_the_root_force),
      cmocka_unit_test(a_standing_leg),
      cmocka_unit_test(what_hands_hold_is_borne_above_them),
      cmocka_unit_test(cuts_are_listed_once_and_no_further),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
