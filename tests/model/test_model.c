#include "model/model.h"
#include "support/chain_definition.h"
#include "support/fail_alloc.h"
#include "support/older.h"

static void defaults(void **state) {
  (void)state;
  ambulo_coordinate q = ambulo_coordinate_default();
  assert_true(isinf(q.range[0]) && q.range[0] < 0 && isinf(q.torque[1]) && q.speed[1] > 0);
  assert_int_equal(q.actuated, 1);
  assert_int_equal(ambulo_link_default().parent, -1);
  assert_close(ambulo_model_definition_default().gravity[1], -9.81, 0);
}

static void copies(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  char name[] = "b";
  c.links[1].name = name;
  c.coordinates[1].name = name; /* a link and a coordinate may share a name */
  ambulo_model *model = chain_good(&c);
  memset(c.links, 0, sizeof c.links);
  memset(c.points, 0, sizeof c.points);
  name[0] = '?';
  assert_string_equal(model->links[1].name, "b");
  assert_string_equal(model->coordinates[1].name, "b");
  assert_string_equal(model->coordinates[2].name, "qc");
  assert_string_equal(model->points[1].name, "toe");
  assert_close(model->points[1].position[0], 0.2, 0);
  assert_close(model->mass, 7, 0);
  assert_int_equal(model->coordinates[2].mirror, 2);
  assert_int_equal(model->feet[0].mirror, 0);
  ambulo_model_free(model);
  ambulo_model_free(NULL);
}

/* children given before their parents: sorted, every number carried over */
static void sorting(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.links[0].parent = 2; /* b - c - a */
  c.links[1].parent = -1;
  c.links[2].parent = 1;
  c.coordinates[0].mirror = 2;
  c.coordinates[2].mirror = 0;
  c.points[0].link = 0;
  ambulo_model *model = chain_good(&c);
  static const char *const names[] = {"b", "c", "a"}, *const q[] = {"qb", "qc", "qa"};
  for (int i = 0; i < 3; i++) {
    assert_string_equal(model->links[i].name, names[i]);
    assert_string_equal(model->coordinates[i].name, q[i]);
    assert_int_equal(model->links[i].parent, i - 1);
    assert_int_equal(model->links[i].coordinate, i);
    assert_int_equal(model->coordinate_link[i], i);
  }
  assert_int_equal(model->coordinates[0].mirror, 0);
  assert_int_equal(model->coordinates[1].mirror, 2);
  assert_int_equal(model->coordinates[2].mirror, 1);
  assert_int_equal(model->points[0].link, 2);
  assert_int_equal(model->points[1].link, 1);
  ambulo_model_free(model);
}

/* a sorted definition keeps its order, fixed links among the others */
static void sorted_stays(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.links[1].type = AMBULO_FIXED;
  c.links[2].parent = 0;
  c.definition.coordinate_count = 2;
  ambulo_model *model = chain_good(&c);
  assert_string_equal(model->links[1].name, "b");
  assert_int_equal(model->links[1].coordinate, -1);
  assert_int_equal(model->links[2].coordinate, 1);
  assert_int_equal(model->links[2].parent, 0);
  assert_string_equal(model->coordinates[1].name, "qb");
  assert_int_equal(model->coordinate_link[1], 2);
  ambulo_model_free(model);
}

static void reversed_long_chain(void **state) {
  (void)state;
  enum { N = 4096 };
  chain c;
  chain_make(&c);
  ambulo_link *links = calloc(N, sizeof *links);
  ambulo_coordinate one = ambulo_coordinate_default();
  one.name = "q";
  char(*names)[16] = calloc(N, sizeof *names);
  for (int i = 0; i < N; i++) {
    links[i] = ambulo_link_default();
    snprintf(names[i], sizeof names[i], "link_%d", i);
    links[i].name = names[i];
    links[i].parent = i + 1 < N ? i + 1 : -1;
  }
  links[0].type = AMBULO_REVOLUTE;
  links[0].mass = 1;
  c.definition.links = links;
  c.definition.link_count = N;
  c.definition.coordinates = &one;
  c.definition.coordinate_count = 1;
  c.definition.foot_count = c.definition.point_count = 0;
  ambulo_model *model = chain_good(&c);
  for (int i = 0; i < N; i++) assert_int_equal(model->links[i].parent, i - 1);
  assert_string_equal(model->links[N - 1].name, "link_0");
  ambulo_model_free(model);
  free(links);
  free(names);
}

static void directions(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.definition.forward[1] = 0.7; /* climbs: made horizontal */
  ambulo_model *model = chain_good(&c);
  static const double up[3] = {0, 1, 0}, forward[3] = {1, 0, 0}, left[3] = {0, 0, -1};
  for (int i = 0; i < 3; i++) {
    assert_close(model->up[i], up[i], 1e-15);
    assert_close(model->forward[i], forward[i], 1e-15);
    assert_close(model->left[i], left[i], 1e-15);
  }
  ambulo_model_free(model);
}

static void memory_runs_out(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  long k = 0;
  for (;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_model *model = NULL;
    ambulo_status status = ambulo_model_create(&c.definition, &allocator, NULL, &model);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_int_equal(model != NULL, status == AMBULO_OK);
    ambulo_model_free(model);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  assert_in_range(k, 5, 20);
}

static int test_model_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults),       cmocka_unit_test(copies),
      cmocka_unit_test(sorting),        cmocka_unit_test(sorted_stays),
      cmocka_unit_test(directions),     cmocka_unit_test(reversed_long_chain),
      cmocka_unit_test(memory_runs_out)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* A program of an older header gives shorter structures, and gets the model that it meant. */

/* the chain with everything that a definition may hold */
typedef struct body {
  chain chain;
  ambulo_patch patch;
  ambulo_capsule capsule;
} body;

static void make(body *b) {
  chain_make(&b->chain);
  ambulo_model_definition *d = &b->chain.definition;
  b->patch = ambulo_patch_default();
  b->patch.name = "palm";
  b->patch.point = 1;
  b->patch.size[0] = b->patch.size[1] = 0.1;
  b->capsule = ambulo_capsule_default();
  b->capsule.name = "bone";
  b->capsule.link = 1;
  b->capsule.radius = 0.05;
  d->patches = &b->patch;
  d->capsules = &b->capsule;
  d->patch_count = d->capsule_count = 1;
}

/* what each item lacks is at its default in the chain: mirror, mirror_sign, tips and arcs */
static void shorten(body *b, ambulo_model_definition *d, void *blocks[5]) {
  *d = b->chain.definition;
  d->coordinate_size = offsetof(ambulo_coordinate, actuated);
  d->foot_size = offsetof(ambulo_foot, has_tip);
  d->patch_size = offsetof(ambulo_patch, mirror);
  d->capsule_size = offsetof(ambulo_capsule, mirror);
  blocks[0] = older_items(b->chain.coordinates, 3, sizeof(ambulo_coordinate), d->coordinate_size);
  blocks[1] = older_items(b->chain.feet, 1, sizeof(ambulo_foot), d->foot_size);
  blocks[2] = older_items(&b->patch, 1, sizeof(ambulo_patch), d->patch_size);
  blocks[3] = older_items(&b->capsule, 1, sizeof(ambulo_capsule), d->capsule_size);
  d->coordinates = blocks[0];
  d->feet = blocks[1];
  d->patches = blocks[2];
  d->capsules = blocks[3];
}

static void shorter_items_mean_the_same(void **state) {
  (void)state;
  body b;
  ambulo_model_definition d;
  void *block[5] = {NULL};
  ambulo_model *model = NULL;
  make(&b);
  shorten(&b, &d, block);
  assert_int_equal(ambulo_model_create(&d, NULL, NULL, &model), AMBULO_OK);
  for (int i = 0; i < 3; i++) {
    const ambulo_coordinate *c = ambulo_model_coordinate(model, i);
    assert_string_equal(c->name, b.chain.coordinates[i].name);
    assert_int_equal(c->actuated, 1);
    assert_int_equal(c->mirror, i);
    assert_true(c->mirror_sign == 1.0);
  }
  const ambulo_foot *foot = ambulo_model_foot(model, 0);
  assert_int_equal(foot->tip, -1);
  assert_int_equal(foot->arc[1], -1);
  assert_int_equal(foot->mirror, 0);
  assert_int_equal(foot->toe_center, 1);
  assert_int_equal(ambulo_model_patch(model, 0)->mirror, 0);
  assert_true(ambulo_model_capsule(model, 0)->radius == 0.05);
  ambulo_model_free(model);
  for (int i = 0; i < 5; i++) free(block[i]);
}

static void a_shorter_definition_has_no_more(void **state) {
  (void)state;
  body b;
  ambulo_model *model = NULL;
  make(&b);
  b.chain.definition.size = offsetof(ambulo_model_definition, patches);
  ambulo_model_definition *older =
      older_items(&b.chain.definition, 1, sizeof *older, b.chain.definition.size);
  assert_int_equal(ambulo_model_create(older, NULL, NULL, &model), AMBULO_OK);
  assert_int_equal(ambulo_model_patch_count(model), 0);
  assert_int_equal(ambulo_model_capsule_count(model), 0);
  assert_int_equal(ambulo_model_foot_count(model), 1);
  ambulo_model_free(model);
  free(older);
}

static void wrong_sizes_are_refused(void **state) {
  (void)state;
  body b;
  make(&b);
  ambulo_model_definition *d = &b.chain.definition;
  size_t *const sizes[] = {&d->size,      &d->link_size,  &d->coordinate_size, &d->point_size,
                           &d->foot_size, &d->patch_size, &d->capsule_size};
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
    size_t kept = *sizes[i], wrong[] = {0, kept + 8};
    for (int k = 0; k < 2; k++) {
      *sizes[i] = wrong[k];
      chain_bad(&b.chain, AMBULO_E_ARGUMENT, NULL);
    }
    *sizes[i] = kept;
  }
}

static void memory_that_runs_out(void **state) {
  (void)state;
  body b;
  ambulo_model_definition d;
  void *block[5] = {NULL};
  make(&b);
  shorten(&b, &d, block);
  for (int n = 0;; n++) {
    fail_alloc memory = fail_alloc_at(n);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_model *model = NULL;
    ambulo_status status = ambulo_model_create(&d, &hook, NULL, &model);
    ambulo_model_free(model);
    assert_int_equal(memory.live, 0);
    if (!status) break;
    assert_int_equal(status, AMBULO_E_MEMORY);
    assert_true(n < 100);
  }
  for (int i = 0; i < 5; i++) free(block[i]);
}

static int test_definition_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(shorter_items_mean_the_same),
                                     cmocka_unit_test(a_shorter_definition_has_no_more),
                                     cmocka_unit_test(wrong_sizes_are_refused),
                                     cmocka_unit_test(memory_that_runs_out)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_model_tests() + test_definition_tests();
}
