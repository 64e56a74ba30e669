#include "model/model_check.h"
#include "support/chain_definition.h"

static void arguments(void **state) {
  (void)state;
  chain c;
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_create(NULL, NULL, NULL, &model), AMBULO_E_ARGUMENT);
  chain_make(&c);
  assert_int_equal(ambulo_model_create(&c.definition, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  c.definition.size = 0;
  chain_bad(&c, AMBULO_E_ARGUMENT, NULL);
  chain_make(&c);
  c.definition.links = NULL;
  chain_bad(&c, AMBULO_E_ARGUMENT, NULL);
  chain_make(&c);
  c.definition.point_count = -1;
  chain_bad(&c, AMBULO_E_ARGUMENT, NULL);
  assert_null(model);
}

/* each list of a definition: of a negative length, or not there */
static void lists(void **state) {
  (void)state;
  for (int i = 0; i < 6; i++) {
    for (int missing = 0; missing < 2; missing++) {
      chain c;
      chain_make(&c);
      ambulo_model_definition *d = &c.definition;
      int *const counts[] = {&d->link_count, &d->coordinate_count, &d->point_count,
                             &d->foot_count, &d->patch_count,      &d->capsule_count};
      *counts[i] = missing ? 1 : -1;
      if (missing) {
        if (i == 0) d->links = NULL;
        if (i == 1) d->coordinates = NULL;
        if (i == 2) d->points = NULL;
        if (i == 3) d->feet = NULL;
        if (i == 4) d->patches = NULL;
        if (i == 5) d->capsules = NULL;
      }
      chain_bad(&c, AMBULO_E_ARGUMENT, NULL);
    }
  }
}

/* items of sizes that no header has */
static void sizes_of_items(void **state) {
  (void)state;
  for (int i = 0; i < 6; i++) {
    for (size_t size = 0; size < 2; size++) {
      chain c;
      chain_make(&c);
      ambulo_model_definition *d = &c.definition;
      size_t *const sizes_of[] = {&d->link_size, &d->coordinate_size, &d->point_size,
                                  &d->foot_size, &d->patch_size,      &d->capsule_size};
      *sizes_of[i] = size ? 1000000 : 0;
      chain_bad(&c, AMBULO_E_ARGUMENT, NULL);
    }
  }
}

/* a billion links are refused before anything is read or allocated */
static void sizes(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.definition.link_count = 1000000000;
  chain_bad(&c, AMBULO_E_LIMIT, "too many links (got 1000000000); expected at most 4096");
  chain_make(&c);
  c.definition.point_count = 5000;
  chain_bad(&c, AMBULO_E_LIMIT, "too many points");
  chain_make(&c);
  c.definition.foot_count = 65;
  chain_bad(&c, AMBULO_E_LIMIT, "too many feet");
  chain_make(&c);
  c.definition.link_count = 0;
  chain_bad(&c, AMBULO_E_MODEL, "the model cannot move");
  chain_make(&c);
  c.definition.coordinate_count = 2;
  chain_bad(&c, AMBULO_E_MODEL, "(got 2 coordinates for 3 such links)");
  chain_make(&c);
  c.links[1].type = AMBULO_JOINT_TYPE_NOT_SET;
  chain_bad(&c, AMBULO_E_MODEL, "not set (got 0); expected");
}

static void names(void **state) {
  (void)state;
  static const char *const bad[] = {"", "a/b", "a\nb", "\x1b[31m", "a b", "\xc3\xa4"};
  chain c;
  for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
    chain_make(&c);
    c.links[1].name = bad[i];
    chain_bad(&c, AMBULO_E_MODEL, "link name is not allowed");
  }
  for (const char *letter = "/:@[`{"; *letter; letter++) { /* beside those that are allowed */
    char one[] = {'a', *letter, '\0'};
    chain_make(&c);
    c.links[1].name = one;
    chain_bad(&c, AMBULO_E_MODEL, "link name is not allowed");
  }
  chain_make(&c);
  c.links[1].name = "azAZ09_-.";
  ambulo_model_free(chain_good(&c));
  chain_make(&c);
  c.coordinates[0].name = NULL;
  chain_bad(&c, AMBULO_E_MODEL, "coordinate name is not allowed");
  char text[80] = "";
  memset(text, 'x', 65);
  chain_make(&c);
  c.points[0].name = text;
  chain_bad(&c, AMBULO_E_MODEL, "point name is not allowed");
  text[64] = '\0';
  ambulo_model_free(chain_good(&c));
  c.definition.name = "a title with spaces";
  ambulo_model_free(chain_good(&c));
  c.definition.name = "";
  chain_bad(&c, AMBULO_E_MODEL, "model name is not allowed");
  c.definition.name = "two\nlines";
  chain_bad(&c, AMBULO_E_MODEL, "model name is not allowed");
}

static void duplicates(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.links[2].name = "a";
  chain_bad(&c, AMBULO_E_MODEL, "two links are named 'a'; expected different names");
  chain_make(&c);
  c.coordinates[1].name = "qa";
  chain_bad(&c, AMBULO_E_MODEL, "two coordinates are named 'qa'");
  chain_make(&c);
  c.points[1].name = "heel";
  chain_bad(&c, AMBULO_E_MODEL, "two points are named 'heel'");
  chain_make(&c);
  c.definition.foot_count = 2;
  c.feet[1].name = "foot";
  chain_bad(&c, AMBULO_E_MODEL, "two feet are named 'foot'");
}

static void world(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.definition.gravity[1] = 0;
  chain_bad(&c, AMBULO_E_MODEL, "gravity must be finite and not zero");
  c.definition.gravity[1] = NAN;
  chain_bad(&c, AMBULO_E_MODEL, "(got [0, nan, 0])");
  chain_make(&c);
  c.definition.forward[0] = 0;
  chain_bad(&c, AMBULO_E_MODEL, "`forward` must not be zero or vertical (got [0, 0, 0])");
  c.definition.forward[1] = 3;
  chain_bad(&c, AMBULO_E_MODEL, "must not be zero or vertical (got [0, 3, 0])");
  chain_make(&c);
  c.definition.stature = -1;
  chain_bad(&c, AMBULO_E_MODEL, "stature is out of range (got -1)");
}

/* one run finds them all */
static void all_faults_at_once(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.links[0].mass = -1;
  c.links[1].a = NAN;
  c.coordinates[2].range[0] = INFINITY;
  c.definition.gravity[1] = 0;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo__model_check(&c.definition, NULL, list), AMBULO_E_MODEL);
  assert_int_equal(ambulo_diagnostics_error_count(list), 4);
  ambulo_diagnostics_free(list);
}

/* numbers that are not finite, or whose products overflow, in every place that holds one; no limit
 * is what an infinite one means */
static void absurd_numbers(void **state) {
  (void)state;
  static const double absurd[] = {NAN, 1e308, -1e308, INFINITY, -INFINITY};
  chain c;
  chain_make(&c);
  ambulo_link *link = &c.links[1];
  ambulo_coordinate *coordinate = &c.coordinates[1];
  double *const numbers[] = {&link->theta,
                             &link->d,
                             &link->a,
                             &link->alpha,
                             &link->mass,
                             &link->com[2],
                             &link->inertia[0],
                             &link->inertia[5],
                             &c.points[1].position[1],
                             &c.definition.gravity[1],
                             &c.definition.forward[0],
                             &c.definition.stature,
                             &coordinate->range[0],
                             &coordinate->range[1],
                             &coordinate->speed[0],
                             &coordinate->speed[1],
                             &coordinate->torque[0],
                             &coordinate->torque[1]};
  const size_t limits = 12;
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
    size_t first = numbers[i] == &c.definition.stature; /* of which NaN is unknown */
    for (size_t k = first; k < (i < limits ? 5 : 3); k++) {
      double kept = *numbers[i];
      ambulo_model *model = NULL;
      *numbers[i] = absurd[k];
      ambulo_status status = ambulo_model_create(&c.definition, NULL, NULL, &model);
      if (status != AMBULO_E_MODEL) print_error("number %zu as %g passes\n", i, absurd[k]);
      assert_int_equal(status, AMBULO_E_MODEL);
      *numbers[i] = kept;
    }
  }
  ambulo_model_free(chain_good(&c));
}

static int test_model_check_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(arguments),      cmocka_unit_test(lists),
      cmocka_unit_test(sizes_of_items), cmocka_unit_test(sizes),
      cmocka_unit_test(names),          cmocka_unit_test(duplicates),
      cmocka_unit_test(world),          cmocka_unit_test(all_faults_at_once),
      cmocka_unit_test(absurd_numbers)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

static void parents(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.links[1].parent = 7;
  chain_bad(&c, AMBULO_E_MODEL, "parent of link 'b' does not exist (got index 7); expected -1");
  c.links[1].parent = -2;
  chain_bad(&c, AMBULO_E_MODEL, "(got index -2)");
}

static void cycles(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.links[1].parent = 2;
  chain_bad(&c, AMBULO_E_MODEL, "the links form a cycle (b-c-b, each the child of the next)");
  c.links[0].parent = 2; /* a hangs below the cycle */
  chain_bad(&c, AMBULO_E_MODEL, "(b-c-b,");
  chain_make(&c);
  c.links[0].parent = 0;
  chain_bad(&c, AMBULO_E_MODEL, "(a-a,");
  chain_make(&c);
  c.links[0].parent = 2;
  chain_bad(&c, AMBULO_E_MODEL, "(a-c-b-a,");
}

/* a cycle of 4096 links is found, and its text is cut */
static void long_cycle(void **state) {
  (void)state;
  enum { N = 4096 };
  ambulo_link *links = calloc(N, sizeof *links);
  ambulo_coordinate one = ambulo_coordinate_default();
  one.name = "q";
  char(*names)[16] = calloc(N, sizeof *names);
  chain c;
  chain_make(&c);
  for (int i = 0; i < N; i++) {
    links[i] = ambulo_link_default();
    snprintf(names[i], sizeof names[i], "link_%d", i);
    links[i].name = names[i];
    links[i].parent = (i + 1) % N;
  }
  links[0].type = AMBULO_REVOLUTE;
  links[0].mass = 1;
  c.definition.links = links;
  c.definition.link_count = N;
  c.definition.coordinates = &one;
  c.definition.coordinate_count = 1;
  c.definition.foot_count = c.definition.point_count = 0;
  chain_bad(&c, AMBULO_E_MODEL, "form a cycle (link_0-link_1-");
  free(links);
  free(names);
}

/* several trees may share the world; their masses add up */
static void several_roots(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.links[1].parent = -1;
  ambulo_model *model = chain_good(&c);
  assert_close(ambulo_model_mass(model), 7, 0);
  ambulo_model_free(model);
}

static void constants(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.links[1].theta = NAN;
  chain_bad(&c, AMBULO_E_MODEL, "DH constant theta of link 'b' is out of range (got nan)");
  chain_make(&c);
  c.links[2].d = -INFINITY;
  chain_bad(&c, AMBULO_E_MODEL, "DH constant d of link 'c' is out of range (got -inf)");
  chain_make(&c);
  c.links[2].a = 1e7;
  chain_bad(&c, AMBULO_E_MODEL, "DH constant a of link 'c'");
  chain_make(&c);
  c.links[2].alpha = NAN;
  chain_bad(&c, AMBULO_E_MODEL, "DH constant alpha of link 'c'");
}

static void bodies(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.links[1].mass = -2;
  chain_bad(&c, AMBULO_E_MODEL, "mass of 'b' is out of range (got -2 kg)");
  c.links[1].mass = 0; /* inertia without mass */
  chain_bad(&c, AMBULO_E_MODEL, "mass of 'b' is out of range (got 0 kg)");
  chain_make(&c);
  c.links[2].com[1] = NAN;
  chain_bad(&c, AMBULO_E_MODEL, "centre of mass or inertia of 'c' is out of range");
  chain_make(&c);
  c.links[2].inertia[3] = 5;
  chain_bad(&c, AMBULO_E_MODEL, "inertia of 'c' is not positive semidefinite");
  chain_make(&c);
  for (int i = 0; i < 3; i++) c.links[i].mass = 0;
  for (int i = 0; i < 3; i++) memset(c.links[i].inertia, 0, sizeof c.links[i].inertia);
  chain_bad(&c, AMBULO_E_MODEL, "the model has no mass");
}

static int test_link_check_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(parents),       cmocka_unit_test(cycles),
                                     cmocka_unit_test(long_cycle),    cmocka_unit_test(constants),
                                     cmocka_unit_test(several_roots), cmocka_unit_test(bodies)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_model_check_tests() + test_link_check_tests();
}
