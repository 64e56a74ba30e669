/* What compiling a model saves: merged links, shared origins and axes, and the pattern. */
#include "mechanics/plan_layout.h"
#include "mechanics/kernel_fixture.h"
#include "support/fail_alloc.h"

static const double quarter = 1.5707963267948966;

static ambulo_link named_link(const char *name, int parent, ambulo_joint_type type, double theta,
                              double d, double a, double alpha) {
  ambulo_link link = ambulo_link_default();
  link.name = name;
  link.parent = parent;
  link.type = type;
  link.theta = theta;
  link.d = d;
  link.a = a;
  link.alpha = alpha;
  return link;
}

static ambulo__plan *plan_of(ambulo_link *links, int count) {
  ambulo_coordinate coordinates[16];
  ambulo_model_definition definition = ambulo_model_definition_default();
  ambulo_model *model = NULL;
  ambulo__plan *plan = NULL;
  int moving = 0;
  for (int i = 0; i < count; i++) {
    if (links[i].type == AMBULO_FIXED) continue;
    coordinates[moving] = ambulo_coordinate_default();
    coordinates[moving].name = links[i].name;
    coordinates[moving].type = links[i].type;
    coordinates[moving].mirror = moving;
    moving++;
  }
  definition.links = links;
  definition.link_count = count;
  definition.coordinates = coordinates;
  definition.coordinate_count = moving;
  assert_int_equal(ambulo_model_create(&definition, NULL, NULL, &model), AMBULO_OK);
  assert_int_equal(ambulo__plan_create(model, NULL, &plan), AMBULO_OK);
  ambulo_model_free(model);
  return plan;
}

static void give_body(ambulo_link *link, double mass, double x) {
  link->mass = mass;
  link->com[0] = x;
  for (int i = 0; i < 3; i++) link->inertia[i] = 0.1;
}

/* Three axes through one point, then one more along the limb: the DH form of hip and knee. */
static void a_hip_shares_its_origin_and_load(void **state) {
  (void)state;
  ambulo_link links[] = {named_link("place", -1, AMBULO_FIXED, 0, 0.9, 0.1, quarter),
                         named_link("flexion", 0, AMBULO_REVOLUTE, quarter, 0, 0, quarter),
                         named_link("abduction", 1, AMBULO_REVOLUTE, quarter, 0, 0, quarter),
                         named_link("rotation", 2, AMBULO_REVOLUTE, quarter, 0, 0, 0),
                         named_link("thigh", 3, AMBULO_FIXED, 0, -0.4, 0, -quarter),
                         named_link("knee", 4, AMBULO_REVOLUTE, 0, 0, 0, 0)};
  give_body(&links[3], 7, 0.01);
  give_body(&links[4], 1, 0);
  give_body(&links[5], 3, 0.2);
  ambulo__plan *plan = plan_of(links, 6);
  assert_int_equal(plan->coordinates, 4);
  assert_int_equal(plan->bodies, 2);
  assert_close(plan->body[0].mass, 8, 1e-15);
  for (int k = 0; k < 4; k++) {
    assert_false(plan->joints[k].turned);
    assert_true(fabs(plan->joints[k].sign) == 1 && plan->joints[k].shift == 0);
  }
  assert_true(plan->joints[0].has_offset && plan->joints[3].has_offset);
  assert_false(plan->joints[1].has_offset || plan->joints[2].has_offset);
  const ambulo__change_step *changes = plan->steps.changes;
  assert_int_equal(changes[0].subtree, changes[1].subtree);
  assert_int_equal(changes[0].subtree, changes[2].subtree);
  assert_int_not_equal(changes[2].subtree, changes[3].subtree);
  ambulo__plan_free(plan);
}

static void an_oblique_axis_is_turned(void **state) {
  (void)state;
  ambulo_link links[] = {named_link("tilt", -1, AMBULO_FIXED, 0.3, 0, 0, 0.4),
                         named_link("hinge", 0, AMBULO_REVOLUTE, 0.2, 0, 0, 0),
                         named_link("next", 1, AMBULO_REVOLUTE, 0, 0, 0.1, 0)};
  give_body(&links[2], 1, 0.1);
  ambulo__plan *plan = plan_of(links, 3);
  assert_true(plan->joints[0].turned);
  assert_false(plan->joints[1].turned);
  assert_close(plan->joints[0].shift, 0.2, 0);
  ambulo__plan_free(plan);
}

static void bodies_fixed_to_the_world_are_a_constant(void **state) {
  (void)state;
  ambulo_link links[] = {named_link("post", -1, AMBULO_FIXED, 0, 0, 0.5, 0),
                         named_link("arm", 0, AMBULO_REVOLUTE, 0, 0, 0, 0)};
  give_body(&links[0], 2, 0);
  give_body(&links[1], 1, 0.1);
  ambulo__plan *plan = plan_of(links, 2);
  assert_int_equal(plan->bodies, 1);
  assert_close(plan->fixed_load[4], 2 * 9.81, 1e-15);
  assert_close(plan->fixed_load[2], 0.5 * 2 * 9.81, 1e-15);
  ambulo__plan_free(plan);
}

/* The factors give the inertia back, for any inertia. */
static void inertia_factors_multiply_out(void **state) {
  (void)state;
  random_source source = {4};
  for (int number = 0; number < 500; number++) {
    ambulo_link links[1] = {named_link("only", -1, AMBULO_REVOLUTE, 0, 0, 0, 0)};
    random_body(&source, &links[0]);
    if (number % 5 == 0) links[0].inertia[0] = links[0].inertia[1] = links[0].inertia[2];
    if (number % 5 == 0) links[0].inertia[3] = links[0].inertia[4] = links[0].inertia[5] = 0;
    ambulo__plan *plan = plan_of(links, 1);
    const ambulo__rigid_body *body = &plan->body[0];
    const double *in = links[0].inertia, *l = body->lower;
    const double want[3][3] = {{in[0], in[3], in[4]}, {in[3], in[1], in[5]}, {in[4], in[5], in[2]}};
    const double u[3] = {1, l[0], l[1]}, w[3] = {0, 1, l[2]};
    for (int i = 0; i < 3; i++) {
      for (int j = 0; j < 3; j++) {
        double got = (i == j) * body->base + body->first * u[i] * u[j] + body->second * w[i] * w[j];
        assert_close(got / in[0], want[body->order[i]][body->order[j]] / in[0], 1e-13);
      }
    }
    ambulo__plan_free(plan);
  }
}

/* Rows ascend, tau's own column is in its row, and the pattern is symmetric in tau, but for rows
 * without entries, which are rows of the root force. */
static void pattern_is_well_formed(void **state) {
  (void)state;
  static kernel_case c;
  for (int number = 0; number < case_count; number++) {
    if (number >= 60 && number < rooted_cases) continue;
    case_open(&c, number);
    ambulo__plan_pattern p = ambulo__plan_get_pattern(c.plan);
    static char dense[max_rows][max_d];
    memset(dense, 0, sizeof dense);
    assert_int_equal(p.start[0], 0);
    assert_int_equal(p.start[c.rows], p.count);
    assert_int_equal(p.start[c.d + 6], p.dynamic_count);
    for (int row = 0; row < c.rows; row++) {
      for (int e = p.start[row]; e < p.start[row + 1]; e++) {
        assert_in_range(p.column[e], 0, c.d - 1);
        assert_true(e == p.start[row] || p.column[e] > p.column[e - 1]);
        dense[row][p.column[e]] = 1;
      }
    }
    for (int i = 0; i < c.rows; i++) {
      ambulo__row_part part[AMBULO__MOST_PARTS];
      assert_int_equal(ambulo__plan_parts(c.plan, i, part), 1);
      assert_false(part[0].by_acceleration);
      if (part[0].row != i) {
        assert_true(i < c.d && part[0].row >= c.d + 3 && part[0].row < c.d + 6);
        assert_true(fabs(part[0].factor) == 1 && p.start[i] == p.start[i + 1]);
        continue;
      }
      assert_true(part[0].factor == 1);
      for (int j = 0; j < c.d && i < c.d; j++) {
        assert_true(dense[i][j] == dense[j][i] || p.start[j] == p.start[j + 1] ||
                    number >= coupled_cases);
      }
      assert_true(i >= c.d || dense[i][i]);
    }
    case_close(&c);
  }
}

/* Which row of tau is which of the root force: +-1 to +-3 for +-x, y, z; 0: none. */
static void check_followers(ambulo_link *links, int count, const int *want) {
  ambulo__plan *plan = plan_of(links, count);
  ambulo__plan_pattern p = ambulo__plan_get_pattern(plan);
  for (int k = 0; k < plan->coordinates; k++) {
    ambulo__row_part part[AMBULO__MOST_PARTS];
    assert_int_equal(ambulo__plan_parts(plan, k, part), 1);
    assert_int_equal(part[0].row, want[k] ? plan->coordinates + 2 + abs(want[k]) : k);
    assert_true(part[0].factor == (want[k] < 0 ? -1 : 1));
    assert_int_equal(p.start[k] == p.start[k + 1], want[k] != 0);
  }
  ambulo__plan_free(plan);
}

/* Three sliders in the DH form of a root, on a base that turns them to one or the other side, and
 * a hinge; as many of the links as are asked for. */
static void check_root(double tilt, int heavy, int first, int second, int third) {
  const double turn = quarter;
  ambulo_link links[] = {named_link("base", -1, AMBULO_FIXED, turn, 0.9, 0, tilt),
                         named_link("forward", 0, AMBULO_PRISMATIC, turn, 0, 0, turn),
                         named_link("sideways", 1, AMBULO_PRISMATIC, turn, 0, 0, turn),
                         named_link("upward", 2, AMBULO_PRISMATIC, 0, 0, 0, 0),
                         named_link("hinge", 3, AMBULO_REVOLUTE, 0, 0, 0, 0)};
  const int want[] = {first, second, third, 0};
  give_body(&links[4], 1, 0.1);
  if (heavy >= 0) give_body(&links[heavy], 2, 0.1);
  check_followers(links, 5, want);
}

/* The second joint stands on the first, or on the world; `mass` is what the first has itself. */
static void check_two(ambulo_joint_type type, int parent, double mass, double below, int first,
                      int second) {
  ambulo_link links[] = {named_link("first", -1, type, 0, 0, 0, 0),
                         named_link("second", parent, AMBULO_PRISMATIC, 0, 0, 0, 0)};
  const int want[] = {first, second};
  if (mass > 0) give_body(&links[0], mass, 0.1);
  if (below > 0) give_body(&links[1], below, 0.1);
  check_followers(links, 2, want);
}

static void root_sliders_are_rows_of_the_force(void **state) {
  (void)state;
  check_root(quarter, -1, 1, 2, 3);
  check_root(-quarter, -1, -1, 2, -3);
  check_root(2 * quarter, -1, -3, 2, 1);
  check_root(0.3, -1, 0, 0, 0); /* oblique axes, and one behind them */
  check_root(quarter, 0, 1, 2, 3);
  check_root(quarter, 1, 1, 0, 0); /* the first slider carries a body that the others do not */
  check_root(quarter, 2, 1, 2, 0);
  check_root(quarter, 3, 1, 2, 3);
  check_two(AMBULO_PRISMATIC, 0, 0, 1, 3, 3);
  check_two(AMBULO_PRISMATIC, 0, 2, 1, 3, 0);
  check_two(AMBULO_PRISMATIC, -1, 2, 1, 0, 0); /* two trees on the world ... */
  check_two(AMBULO_PRISMATIC, -1, 2, 0, 3, 0); /* ... of which one weighs nothing */
  check_two(AMBULO_REVOLUTE, 0, 0, 1, 0, 0);
}

/* What the tests of the kernels go through: every axis, both signs, sliders that stand still but
 * are not rows of the force. */
static void rooted_trees_are_of_all_kinds(void **state) {
  (void)state;
  static kernel_case c;
  int followers[3][2] = {{0}}, driven = 0, oblique = 0, light = 0, behind = 0;
  for (int number = rooted_cases; number < coupled_cases; number++) {
    case_open(&c, number);
    for (int k = 0; k < c.d; k++) {
      const ambulo__joint *joint = &c.plan->joints[k];
      int parent = joint->parent - 1;
      ambulo__row_part part[AMBULO__MOST_PARTS];
      (void)ambulo__plan_parts(c.plan, k, part);
      if (joint->revolute || !joint->still) continue;
      if (part[0].row != k) {
        followers[part[0].row - c.d - 3][part[0].factor < 0]++;
      } else if (joint->driven && !joint->turned && parent < 0) {
        driven++;
      } else if (joint->turned) {
        oblique++;
      } else if (c.plan->frames[k + 1].subtree_mass < (1 - 1e-9) * c.plan->frames[0].subtree_mass) {
        light++;
      } else if (parent >= 0) {
        behind++;
      }
    }
    case_close(&c);
  }
  for (int i = 0; i < 6; i++) assert_true(followers[i / 2][i % 2] > 4);
  assert_true(driven > 5 && oblique > 5 && light > 5 && behind > 1);
}

/* a cart has a drive; on contacts, which carry it, it cannot */
static void what_contacts_carry_is_undriven(void **state) {
  (void)state;
  ambulo_link links[] = {named_link("cart", -1, AMBULO_PRISMATIC, 0, 0, 0, 0),
                         named_link("pole", 0, AMBULO_REVOLUTE, 0, 0, 0, 0)};
  ambulo_coordinate coordinates[] = {ambulo_coordinate_default(), ambulo_coordinate_default()};
  ambulo_model_definition d = ambulo_model_definition_default();
  const int foot = 1;
  give_body(&links[0], 2, 0.1);
  give_body(&links[1], 1, 0.1);
  coordinates[0].name = "along";
  coordinates[0].type = AMBULO_PRISMATIC;
  coordinates[1].name = "turn";
  coordinates[1].armature = 0.5;
  d.name = "cart";
  d.links = links;
  d.coordinates = coordinates;
  d.link_count = d.coordinate_count = 2;
  for (int driven = 0; driven < 2; driven++) {
    ambulo_model *model = NULL;
    ambulo__plan *plan = NULL;
    coordinates[0].damping = driven;
    assert_int_equal(ambulo_model_create(&d, NULL, NULL, &model), AMBULO_OK);
    assert_int_equal(ambulo__plan_create(model, NULL, &plan), AMBULO_OK);
    assert_int_equal(ambulo__plan_undriven(plan), -1);
    assert_int_equal(plan->drive_count, 1 + driven);
    ambulo__plan_free(plan);
    assert_int_equal(ambulo__plan_create_contacts(model, &foot, 1, 0.1, 1, NULL, &plan), AMBULO_OK);
    assert_int_equal(ambulo__plan_undriven(plan), driven ? 0 : -1);
    assert_int_equal(plan->drive_count, 1);
    ambulo__plan_free(plan);
    ambulo_model_free(model);
  }
}

static void failed_allocations_unwind(void **state) {
  (void)state;
  static kernel_case c;
  case_open(&c, 12);
  for (long k = 0;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__plan *plan = NULL;
    ambulo_status status = ambulo__plan_create(c.model, &allocator, &plan);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__plan_free(plan);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
    assert_true(k < 100);
  }
  case_close(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_hip_shares_its_origin_and_load),
                                     cmocka_unit_test(an_oblique_axis_is_turned),
                                     cmocka_unit_test(bodies_fixed_to_the_world_are_a_constant),
                                     cmocka_unit_test(inertia_factors_multiply_out),
                                     cmocka_unit_test(pattern_is_well_formed),
                                     cmocka_unit_test(root_sliders_are_rows_of_the_force),
                                     cmocka_unit_test(rooted_trees_are_of_all_kinds),
                                     cmocka_unit_test(what_contacts_carry_is_undriven),
                                     cmocka_unit_test(failed_allocations_unwind)};
  return cmocka_run_group_tests_name("mechanics/plan", tests, NULL, NULL);
}
