/* The list of numbers: what stands where, under which name and in which unit; and the problem that
 * follows from moving one. */
#include "ambulo/tools/load.h"
#include "solver/sensitivity.h"
#include "support/test.h"

static const char arm[] = "tests/support/two_link_reach.yaml", walk[] = "models/walk_normal.yaml";

typedef struct numbers {
  ambulo_problem *problem;
  ambulo__parameters list;
} numbers;

static void open_numbers(numbers *n, const char *file, const char *override) {
  const char *const overrides[] = {override};
  assert_int_equal(ambulo_problem_load(file, overrides, override != NULL, NULL, NULL, &n->problem),
                   AMBULO_OK);
  assert_int_equal(ambulo__parameters_init(n->problem, NULL, &n->list), AMBULO_OK);
}

static void close_numbers(numbers *n) {
  ambulo__parameters_clear(&n->list);
  ambulo_problem_free(n->problem);
}

static ambulo__parameter *find(const numbers *n, const char *name) {
  ambulo__parameter *found = ambulo__parameters_find(&n->list, name);
  if (!found) fail_msg("no number '%s'", name);
  return found;
}

static void names_are_its_own(void **state) {
  (void)state;
  numbers n;
  open_numbers(&n, walk, NULL);
  for (int i = 0; i < n.list.count; i++)
    assert_ptr_equal(ambulo__parameters_find(&n.list, n.list.list[i].name), &n.list.list[i]);
  assert_null(ambulo__parameters_find(&n.list, "gait.step_lengths"));
  assert_null(ambulo__parameters_find(&n.list, ""));
  close_numbers(&n);
}

static ambulo_problem *problem_of(const numbers *n) {
  ambulo_problem *made = NULL;
  assert_int_equal(ambulo__variant_problem(&n->list.variant, NULL, 1, &made), AMBULO_OK);
  return made;
}

/* the same places, times, limits and masses as the problem it came from */
static void nothing_moved_makes_the_same(void **state) {
  (void)state;
  numbers n;
  open_numbers(&n, walk, NULL);
  ambulo_problem *same = problem_of(&n);
  const ambulo_problem_definition *a = &n.problem->definition, *b = &same->definition;
  assert_int_equal(n.problem->rows, same->rows);
  assert_int_equal(a->contact_count, b->contact_count);
  assert_true(a->duration == b->duration && a->travel == b->travel);
  for (int c = 0; c < a->contact_count; c++) {
    assert_true(a->contacts[c].from == b->contacts[c].from);
    assert_memory_equal(a->contacts[c].place, b->contacts[c].place, sizeof a->contacts[c].place);
  }
  assert_true(n.problem->model->mass == same->model->mass);
  assert_memory_equal(n.problem->model->coordinates[8].range, same->model->coordinates[8].range,
                      2 * sizeof(double));
  ambulo_problem_free(same);
  close_numbers(&n);
}

/* what follows from the number goes along */
static void a_mass_moves_the_body(void **state) {
  (void)state;
  numbers n;
  open_numbers(&n, walk, NULL);
  ambulo__parameter *mass = find(&n, "subject.mass");
  double before = mass->value;
  ambulo__parameter_set(&n.list, mass, 1.1 * before);
  ambulo_problem *heavier = problem_of(&n);
  assert_close(heavier->model->mass / n.problem->model->mass, 1.1, 1e-12);
  assert_close(heavier->keys.heavier, 1.1 * n.problem->keys.heavier, 1e-12);
  assert_true(heavier->owned_model == heavier->model);
  ambulo_problem_free(heavier);
  ambulo__parameter_set(&n.list, mass, before);
  ambulo_problem *same = problem_of(&n);
  assert_true(same->model->mass == n.problem->model->mass);
  ambulo_problem_free(same);
  close_numbers(&n);
}

static void both_sides_move_together(void **state) {
  (void)state;
  numbers n;
  open_numbers(&n, walk, NULL);
  int some = 0;
  for (int i = 0; i < n.list.count; i++) {
    const ambulo__parameter *p = &n.list.list[i];
    if (p->enters != AMBULO__ENTERS_LIMITS || !p->with[0]) continue;
    assert_int_equal(p->addresses, 2);
    ambulo__parameter_set(&n.list, p, 1.25);
    assert_true(*n.list.address[p->address].at == 1.25);
    assert_true(*n.list.address[p->address + 1].at == 1.25 * p->with_sign);
    some++;
  }
  assert_true(some > 0);
  close_numbers(&n);
}

/* more names than there is room for: the number is not listed at all */
static void too_many_names_drop_it(void **state) {
  (void)state;
  numbers n;
  char name[AMBULO__PARAMETER_TEXT];
  double at[2] = {1.0, 1.0};
  open_numbers(&n, arm, NULL);
  int count = n.list.count;
  memset(name, 'x', sizeof name);
  name[sizeof name - 1] = '\0';
  ambulo__parameter_add(&n.list, AMBULO__RATIO, &at[0], "label", "number");
  for (int k = 0; k < 4 && n.list.count > count; k++)
    ambulo__parameter_with(&n.list, 1.0, &at[1], "%s", name);
  assert_int_equal(n.list.count, count);
  close_numbers(&n);
}

static void units_are_those_of_the_file(void **state) {
  (void)state;
  static const double degree = 0.017453292519943295;
  numbers n;
  open_numbers(&n, walk, "angles=degrees");
  assert_close(ambulo__parameter_unit(n.problem, find(&n, "ground.slope")), degree, 1e-15);
  assert_close(ambulo__parameter_unit(n.problem, find(&n, "gait.step_length")), 1.0, 1e-15);
  close_numbers(&n);
}

/* a share of the value, unless that is zero */
static void steps_can_be_pictured(void **state) {
  (void)state;
  ambulo__parameter p = {.quantity = AMBULO__RATIO, .value = -4.0};
  assert_close(ambulo__parameter_step(&p), 0.04, 1e-15);
  assert_string_equal(ambulo__parameter_more(&p), "1 % more");
  p.value = 0.0;
  assert_close(ambulo__parameter_step(&p), 0.01, 1e-15);
  assert_string_equal(ambulo__parameter_more(&p), "0.01 more");
  p = (ambulo__parameter){.quantity = AMBULO__STEP_LENGTH, .value = 0.7};
  assert_close(ambulo__parameter_step(&p), 0.01, 1e-15);
  assert_string_equal(ambulo__parameter_more(&p), "1 cm more");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(names_are_its_own),      cmocka_unit_test(nothing_moved_makes_the_same),
      cmocka_unit_test(a_mass_moves_the_body),  cmocka_unit_test(both_sides_move_together),
      cmocka_unit_test(too_many_names_drop_it), cmocka_unit_test(units_are_those_of_the_file),
      cmocka_unit_test(steps_can_be_pictured),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
