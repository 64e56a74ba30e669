/* Links of a tree: what is fixed to what, where the whole body begins, the start pose, and bodies
 * put together. */
#include "import/body_tree.h"
#include "support/test.h"

#include <math.h>

enum { GROUND, BALL, SLIDE, TRUNK, PLATE, LEG, SHOE, COUNT };

/* ground: a ball, and a trunk on a slider; on the trunk a plate, on that a leg with a shoe */
static void build(ambulo__tree *tree, ambulo__tree_link links[COUNT]) {
  static const int parents[COUNT] = {-1, GROUND, GROUND, SLIDE, TRUNK, PLATE, LEG};
  static const ambulo_joint_type types[COUNT] = {AMBULO_FIXED,    AMBULO_REVOLUTE, AMBULO_PRISMATIC,
                                                 AMBULO_REVOLUTE, AMBULO_FIXED,    AMBULO_REVOLUTE,
                                                 AMBULO_FIXED};
  static const double masses[COUNT] = {0, 1, 0, 5, 2, 1, 3};
  for (int i = 0; i < COUNT; i++) {
    const double up[3] = {0, 0, i == LEG || i == SHOE ? -0.5 : 0};
    links[i] = (ambulo__tree_link){.name = "",
                                   .parent = parents[i],
                                   .type = types[i],
                                   .origin = ambulo__rigid_shift(up),
                                   .axis = {0, 1, 0},
                                   .body = {.mass = masses[i], .inertia = {1, 1, 1, 0, 0, 0}},
                                   .coordinate = {.default_value = 0.5}};
  }
  *tree = (ambulo__tree){.links = links, .link_count = COUNT};
  tree->trunk = ambulo__tree_trunk(tree);
}

static void what_is_fixed(void **state) {
  (void)state;
  ambulo__tree tree;
  ambulo__tree_link links[COUNT];
  build(&tree, links);
  assert_int_equal(tree.trunk, TRUNK);
  assert_int_equal(ambulo__tree_leader(&tree, PLATE), TRUNK);
  assert_int_equal(ambulo__tree_leader(&tree, SHOE), LEG);
  assert_int_equal(ambulo__tree_leader(&tree, GROUND), GROUND);
  assert_true(ambulo__tree_is_end(&tree, SHOE));
  assert_true(ambulo__tree_is_end(&tree, BALL));
  assert_false(ambulo__tree_is_end(&tree, PLATE));
  assert_false(ambulo__tree_is_end(&tree, TRUNK));
  assert_true(ambulo__tree_hangs_on(&tree, SHOE, SLIDE));
  assert_true(ambulo__tree_hangs_on(&tree, LEG, LEG));
  assert_false(ambulo__tree_hangs_on(&tree, SHOE, BALL));
}

/* a body whose whole mass hangs on two joints of one massless link begins there */
static void a_trunk_without_mass(void **state) {
  (void)state;
  ambulo__tree tree;
  ambulo__tree_link links[COUNT];
  build(&tree, links);
  links[TRUNK].body.mass = links[PLATE].body.mass = 0.0;
  assert_int_equal(ambulo__tree_trunk(&tree), LEG);
  links[BALL].parent = TRUNK;
  assert_int_equal(ambulo__tree_trunk(&tree), TRUNK);
  for (int i = 0; i < COUNT; i++) links[i].type = AMBULO_FIXED;
  for (int i = 0; i < COUNT; i++) links[i].body.mass = 0.0;
  assert_int_equal(ambulo__tree_trunk(&tree), -1);
}

/* defaults of all but the whole body's coordinates: of the leg alone */
static void the_start_pose(void **state) {
  (void)state;
  ambulo__tree tree;
  ambulo__tree_link links[COUNT];
  build(&tree, links);
  ambulo__rigid zero = ambulo__tree_pose_of(&tree, SHOE, 0),
                start = ambulo__tree_pose_of(&tree, SHOE, 1);
  assert_close(zero.p[2], -1.0, 1e-15);
  assert_close(start.p[0], -0.5 * sin(0.5), 1e-15);
  assert_close(start.p[1], 0.0, 1e-15);
  assert_close(start.p[2], -0.5 - 0.5 * cos(0.5), 1e-15);
}

/* a leg of 1 kg and a shoe of 3 kg half a metre below */
static void bodies_together(void **state) {
  (void)state;
  ambulo__tree tree;
  ambulo__tree_link links[COUNT];
  ambulo__part whole;
  build(&tree, links);
  ambulo__tree_whole(&tree, LEG, &whole);
  assert_close(whole.mass, 4.0, 1e-15);
  assert_close(whole.com[2], -0.375, 1e-15);
  assert_close(whole.inertia[0], 2.0 + 1.0 * 3.0 / 4.0 * 0.25, 1e-15);
  assert_close(whole.inertia[2], 2.0, 1e-15);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_is_fixed), cmocka_unit_test(a_trunk_without_mass),
      cmocka_unit_test(the_start_pose), cmocka_unit_test(bodies_together)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
