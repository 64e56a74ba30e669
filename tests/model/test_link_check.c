#include "support/chain_definition.h"

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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(parents),       cmocka_unit_test(cycles),
                                     cmocka_unit_test(long_cycle),    cmocka_unit_test(constants),
                                     cmocka_unit_test(several_roots), cmocka_unit_test(bodies)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
