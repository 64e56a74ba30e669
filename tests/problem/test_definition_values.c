/* A program of an older header gives shorter items, shorter parts and a shorter definition, and
 * gets the problem that it meant: the same hash as that of a definition with the defaults in what
 * it lacks. */
#include "problem/definition.h"
#include "support/fail_alloc.h"
#include "support/older.h"
#include "support/planar_walker.h"
#include "support/messages.h"
#include "support/test.h"

enum { MOST_CONTACTS = 12, MOST_BLOCKS = 12 };

static double nothing(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  (void)user;
  (void)state;
  (void)gradient;
  return 1.0;
}

/* a step with one of everything; what the older one lacks is at its default */
typedef struct walk {
  ambulo_model *model;
  ambulo_contact contacts[MOST_CONTACTS];
  ambulo_term terms[2];
  ambulo_device device;
  ambulo_user_row row;
  ambulo_end_value end;
  ambulo_reach reach;
  ambulo_problem_definition definition;
  void *block[MOST_BLOCKS]; /* of the older one */
  int blocks;
} walk;

static void make(walk *w) {
  memset(w, 0, sizeof *w);
  w->model = planar_walker_create();
  w->definition = ambulo_problem_definition_default();
  ambulo_problem_definition *d = &w->definition;
  ambulo_gait gait = ambulo_gait_default();
  gait.step_length = walker_step_length;
  gait.step_time = walker_step_time;
  assert_int_equal(
      ambulo_gait_expand(w->model, &gait, w->contacts, MOST_CONTACTS, &d->contact_count),
      AMBULO_OK);
  w->terms[0] = ambulo_term_default(AMBULO_TORQUE_POWER);
  w->terms[0].weight = 0.7;
  w->terms[1] = ambulo_term_default(AMBULO_MECHANICAL_POWER);
  w->device = ambulo_device_default(AMBULO_DEVICE_DAMPER);
  w->device.name = "damper";
  w->device.coordinate = 3;
  w->device.damping = 2.0;
  w->row = ambulo_user_row_default();
  w->row.name = "row";
  w->row.unit = "m";
  w->row.function = nothing;
  w->end = ambulo_end_value_default();
  w->end.coordinate = 2;
  w->reach = ambulo_reach_default();
  w->reach.point = 0;
  w->reach.place[2] = 1.6;
  w->reach.tolerance = 1.0;
  d->model = w->model;
  d->duration = walker_step_time;
  d->contacts = w->contacts;
  d->ground_penetration = d->foot_strike = 1;
  d->clearance.height = 0.02;
  d->clearance.turn = 0.15;
  d->ground_reaction.kind = AMBULO_REACTION_SHARED;
  d->ground_reaction.slant = 0.8;
  d->collision.mode = AMBULO_COLLISION_OFF;
  d->terms = w->terms;
  d->term_count = 2;
  d->devices = &w->device;
  d->device_count = 1;
  d->end_values = &w->end;
  d->end_value_count = 1;
  d->reaches = &w->reach;
  d->reach_count = 1;
}

static void clear(walk *w) {
  for (int i = 0; i < w->blocks; i++) free(w->block[i]);
  ambulo_model_free(w->model);
}

static void *shorter(walk *w, const void *items, int count, size_t full, size_t size) {
  return w->block[w->blocks++] = older_items(items, count, full, size);
}

static void shorten_items(walk *w, ambulo_problem_definition *d) {
  *d = w->definition;
  d->contact_size = offsetof(ambulo_contact, normal);
  d->term_size = offsetof(ambulo_term, passive);
  d->device_size = offsetof(ambulo_device, points);
  d->end_value_size = offsetof(ambulo_end_value, value);
  d->reach_size = sizeof(ambulo_reach); /* beside the others */
  d->contacts = shorter(w, w->contacts, d->contact_count, sizeof(ambulo_contact), d->contact_size);
  d->terms = shorter(w, w->terms, 2, sizeof(ambulo_term), d->term_size);
  d->devices = shorter(w, &w->device, 1, sizeof(ambulo_device), d->device_size);
  d->end_values = shorter(w, &w->end, 1, sizeof(ambulo_end_value), d->end_value_size);
}

/* the same bytes as a header would have them in which the parts by value end earlier, and the
 * whole before user_rows */
static ambulo_problem_definition *shorten_parts(walk *w, const ambulo_problem_definition *full) {
  ambulo_problem_definition d = *full;
  d.clearance_size = offsetof(ambulo_clearance, feet);
  d.ground_reaction_size = offsetof(ambulo_ground_reaction, flight_tolerance);
  d.collision_size = offsetof(ambulo_collision, margin);
  size_t behind = offsetof(ambulo_problem_definition, collision) + sizeof d.collision;
  d.size =
      offsetof(ambulo_problem_definition, user_rows) - (sizeof d.clearance - d.clearance_size) -
      (sizeof d.ground_reaction - d.ground_reaction_size) - (sizeof d.collision - d.collision_size);
  char *older = malloc(d.size), *at = older;
  const char *from = (const char *)&d;
  const size_t pieces[][2] = {
      {0, offsetof(ambulo_problem_definition, clearance)},
      {offsetof(ambulo_problem_definition, clearance), d.clearance_size},
      {offsetof(ambulo_problem_definition, ground_reaction), d.ground_reaction_size},
      {offsetof(ambulo_problem_definition, joint_limits),
       offsetof(ambulo_problem_definition, collision) -
           offsetof(ambulo_problem_definition, joint_limits)},
      {offsetof(ambulo_problem_definition, collision), d.collision_size},
      {behind, offsetof(ambulo_problem_definition, user_rows) - behind}};
  for (size_t i = 0; i < sizeof pieces / sizeof *pieces; i++) {
    memcpy(at, from + pieces[i][0], pieces[i][1]);
    at += pieces[i][1];
  }
  assert_int_equal(at - older, d.size);
  w->block[w->blocks++] = older;
  return (ambulo_problem_definition *)(void *)older;
}

static unsigned long long hash_of(const ambulo_problem_definition *d) {
  ambulo_problem *problem = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_problem_create(d, NULL, list, &problem);
  if (status && ambulo_diagnostics_count(list)) assert_message(list, 0, "no message");
  ambulo_diagnostics_free(list);
  assert_int_equal(status, AMBULO_OK);
  unsigned long long hash = ambulo_problem_hash(problem);
  ambulo_problem_free(problem);
  return hash;
}

static void shorter_items_mean_the_same(void **state) {
  (void)state;
  walk w;
  ambulo_problem_definition older;
  make(&w);
  shorten_items(&w, &older);
  unsigned long long hash = hash_of(&w.definition);
  assert_true(hash_of(&older) == hash);
  w.contacts[1].place[1] += 1e-3; /* the hash looks at them */
  assert_true(hash_of(&w.definition) != hash);
  clear(&w);
}

static void shorter_parts_mean_the_same(void **state) {
  (void)state;
  walk w;
  ambulo_problem_definition items;
  make(&w);
  unsigned long long hash = hash_of(&w.definition);
  assert_true(hash_of(shorten_parts(&w, &w.definition)) == hash);
  shorten_items(&w, &items);
  assert_true(hash_of(shorten_parts(&w, &items)) == hash);
  clear(&w);
}

/* members of each piece, and of both ends of the parts; between members stands anything */
static void same_numbers(const ambulo_problem_definition *filled,
                         const ambulo_problem_definition *expected) {
  ambulo__taken_definition one, other;
  assert_int_equal(ambulo__definition_take(filled, NULL, &one), AMBULO_OK);
  assert_int_equal(ambulo__definition_take(expected, NULL, &other), AMBULO_OK);
  const ambulo_problem_definition *a = &one.definition, *b = &other.definition;
  assert_true(a->clearance.tip_from == b->clearance.tip_from);
  assert_true(a->clearance.inward == b->clearance.inward);
  assert_true(isnan(a->clearance.height) && isnan(b->clearance.height));
  assert_int_equal(a->ground_reaction.kind, b->ground_reaction.kind);
  assert_true(a->ground_reaction.arc_pressure == b->ground_reaction.arc_pressure);
  assert_true(a->ground_reaction.loading_rate == b->ground_reaction.loading_rate);
  assert_int_equal(a->joint_limits, b->joint_limits);
  assert_int_equal(a->collision.mode, b->collision.mode);
  assert_int_equal(a->ends_order, b->ends_order);
  assert_int_equal(a->device_count, b->device_count);
  ambulo__definition_drop(&one);
  ambulo__definition_drop(&other);
}

/* a program of an older header asks for its defaults: they fit, and are those of ours */
static void defaults_fit_an_older_definition(void **state) {
  (void)state;
  walk w;
  make(&w);
  ambulo_problem_definition usual = ambulo_problem_definition_default();
  ambulo_problem_definition *expected = shorten_parts(&w, &usual);
  char *filled = malloc(expected->size);
  memset(filled, 0xa5, expected->size);
  memcpy(filled, expected, offsetof(ambulo_problem_definition, name)); /* the sizes */
  ambulo_problem_defaults("ambulo_problem_definition", filled, expected->size);
  same_numbers((ambulo_problem_definition *)(void *)filled, expected);
  free(filled);
  clear(&w);
}

static void shorter_extensions_mean_the_same(void **state) {
  (void)state;
  walk w;
  make(&w);
  ambulo_problem *base = NULL, *whole = NULL, *older = NULL;
  assert_int_equal(ambulo_problem_create(&w.definition, NULL, NULL, &base), AMBULO_OK);
  ambulo_extension e = ambulo_extension_default();
  e.terms = w.terms;
  e.term_count = 2;
  e.user_rows = &w.row;
  e.user_row_count = 1;
  assert_int_equal(ambulo_problem_extend(base, &e, NULL, NULL, &whole), AMBULO_OK);
  e.term_size = offsetof(ambulo_term, passive);
  e.terms = shorter(&w, w.terms, 2, sizeof(ambulo_term), e.term_size);
  e.size = offsetof(ambulo_extension, user_rows);
  assert_int_equal(ambulo_problem_extend(base, &e, NULL, NULL, &older), AMBULO_OK);
  assert_int_equal(ambulo_problem_term_count(older), 4);
  assert_true(ambulo_problem_row_count(older) < ambulo_problem_row_count(whole));
  ambulo_problem_free(older);
  e.size = sizeof e;
  assert_int_equal(ambulo_problem_extend(base, &e, NULL, NULL, &older), AMBULO_OK);
  assert_true(ambulo_problem_hash(older) == ambulo_problem_hash(whole));
  ambulo_problem_free(older);
  ambulo_problem_free(whole);
  e.user_row_size = 0;
  assert_int_equal(ambulo_problem_extend(base, &e, NULL, NULL, &older), AMBULO_E_ARGUMENT);
  ambulo_problem_free(base);
  clear(&w);
}

static void wrong_sizes_are_refused(void **state) {
  (void)state;
  walk w;
  make(&w);
  ambulo_problem_definition *d = &w.definition;
  size_t *const sizes[] = {&d->size,
                           &d->contact_size,
                           &d->end_value_size,
                           &d->tube_size,
                           &d->obstacle_size,
                           &d->reach_size,
                           &d->device_size,
                           &d->hold_size,
                           &d->term_size,
                           &d->user_row_size,
                           &d->capsule_pair_size,
                           &d->clearance_size,
                           &d->ground_reaction_size,
                           &d->collision_size};
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
    size_t kept = *sizes[i], wrong[] = {0, kept + 8};
    for (int k = 0; k < 2; k++) {
      ambulo_problem *problem = NULL;
      *sizes[i] = wrong[k];
      assert_int_equal(ambulo_problem_create(d, NULL, NULL, &problem), AMBULO_E_ARGUMENT);
    }
    *sizes[i] = kept;
  }
  clear(&w);
}

static void memory_that_runs_out(void **state) {
  (void)state;
  walk w;
  ambulo_problem_definition older;
  make(&w);
  shorten_items(&w, &older);
  for (int n = 0; n < 8; n++) {
    fail_alloc memory = fail_alloc_at(n);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_problem *problem = NULL;
    assert_int_equal(ambulo_problem_create(&older, &hook, NULL, &problem), AMBULO_E_MEMORY);
    assert_int_equal(memory.live, 0);
  }
  clear(&w);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(shorter_items_mean_the_same),
                                     cmocka_unit_test(shorter_parts_mean_the_same),
                                     cmocka_unit_test(defaults_fit_an_older_definition),
                                     cmocka_unit_test(shorter_extensions_mean_the_same),
                                     cmocka_unit_test(wrong_sizes_are_refused),
                                     cmocka_unit_test(memory_that_runs_out)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
