/* Building immutable muscles: what is copied, what an older program may leave out, queries, memory.
 */
#include "muscle/muscles.h"
#include "support/fail_alloc.h"
#include "support/muscle_definition.h"
#include "support/older.h"

static void defaults(void **state) {
  (void)state;
  ambulo_muscle m = ambulo_muscle_default();
  assert_int_equal(m.elastic, -1);
  assert_int_equal(m.mirror, -1);
  assert_string_equal(m.group, "");
  assert_true(m.passive_strain == 0.6 && m.fast_fibers == 0.5 && m.pull_count == 0);
  assert_true(isinf(m.range[3][0]) && m.range[3][0] < 0.0 && m.range[0][1] > 1e300);
  assert_int_equal(ambulo_muscle_pull_default().link, -1);
  assert_int_equal(ambulo_muscle_pull_default().axes, -1);
  assert_string_equal(ambulo_muscles_definition_default().source, "");
}

/* the definition may be overwritten afterwards, to its last array */
static void everything_is_copied(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  char name[] = "calf", group[] = "flexors", joint[] = "ankle", set[] = "set", credits[] = "me";
  s.muscles[1].name = name;
  s.muscles[1].group = group;
  s.pulls[1].joint = joint;
  s.definition.name = set;
  s.definition.source = credits;
  ambulo_muscles *muscles = straps_good(&s);
  for (char *text[] = {name, group, joint, set, credits}, **t = text; t < text + 5; t++)
    (*t)[0] = '?';
  memset(s.muscles, 0xff, sizeof s.muscles);
  memset(s.pulls, 0xff, sizeof s.pulls);
  memset(s.exponents, 0xff, sizeof s.exponents);
  memset(s.length, 0xff, sizeof s.length);
  memset(s.slopes, 0xff, sizeof s.slopes);
  const ambulo_muscle *m = ambulo_muscles_get(muscles, 1);
  assert_string_equal(m->name, "calf");
  assert_string_equal(m->group, "flexors");
  assert_string_equal(m->pulls[0].joint, "ankle");
  assert_string_equal(ambulo_muscles_name(muscles), "set");
  assert_string_equal(ambulo_muscles_source(muscles), "me");
  assert_true(m->force == 2000.0 && m->length[0] == 0.35 && m->length[2] == -0.02);
  assert_true(m->exponents[1][0] == 1 && m->exponents[2][1] == 1 && m->exponents[2][0] == 0);
  assert_true(m->pulls[0].slopes[0][2] == 3.0 && m->pulls[0].link == 1 && m->pulls[0].axes == 0);
  assert_int_equal(m->mirror, 1); /* itself */
  assert_close(muscles->volume, 0.1 * 6000.0, 1e-12);
  ambulo_muscles_free(muscles);
  ambulo_muscles_free(NULL);
  straps_close(&s);
}

/* exponents of coordinates that a muscle does not have are not looked at */
static void exponents_of_no_coordinate_are_dropped(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  s.exponents[1][2] = s.exponents[1][3] = 99;
  ambulo_muscles *muscles = straps_good(&s);
  for (int i = 0; i < strap_m; i++)
    for (int e = 2; e < AMBULO_MUSCLE_COORDINATES; e++)
      assert_int_equal(ambulo_muscles_get(muscles, i)->exponents[1][e], 0);
  ambulo_muscles_free(muscles);
  straps_close(&s);
}

static void queries(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  ambulo_muscles *muscles = straps_good(&s);
  assert_int_equal(ambulo_muscles_count(muscles), 3);
  assert_int_equal(ambulo_muscles_find(muscles, "c"), 2);
  assert_int_equal(ambulo_muscles_find(muscles, "d"), -1);
  assert_int_equal(ambulo_muscles_find(muscles, NULL), -1);
  assert_int_equal(ambulo_muscles_find(NULL, "a"), -1);
  assert_null(ambulo_muscles_get(muscles, 3));
  assert_null(ambulo_muscles_get(muscles, -1));
  assert_null(ambulo_muscles_get(NULL, 0));
  assert_null(ambulo_muscles_name(NULL));
  assert_null(ambulo_muscles_source(NULL));
  assert_int_equal(ambulo_muscles_count(NULL), 0);
  assert_int_equal(muscles->limb_count, 2);
  for (int c = -1; c <= strap_d; c++)
    assert_int_equal(ambulo__muscles_span(muscles, c), c == 0 || c == 1 || c == 2 || c == 4);
  ambulo_muscles_free(muscles);
  straps_close(&s);
}

/* items and definitions that end sooner, as those of an older header */
static void older_structures(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  const ambulo_muscles_definition full = s.definition;
  s.definition.muscle_size = offsetof(ambulo_muscle, pulls);
  void *older = older_items(s.muscles, strap_m, sizeof *s.muscles, offsetof(ambulo_muscle, pulls));
  s.definition.muscles = older;
  ambulo_muscles *muscles = straps_good(&s);
  for (int i = 0; i < strap_m; i++) {
    const ambulo_muscle *m = ambulo_muscles_get(muscles, i);
    assert_int_equal(m->pull_count, 0);
    assert_true(m->force == s.muscles[i].force && m->length[1] == -0.05);
  }
  ambulo_muscles_free(muscles);
  free(older);
  s.definition = full;
  s.definition.size = offsetof(ambulo_muscles_definition, muscle_count);
  straps_bad(&s, AMBULO_E_MODEL, "the number of muscles is out of range (got 0)");
  straps_close(&s);
}

static void sizes_that_no_header_had(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  const ambulo_muscles_definition full = s.definition;
  size_t *const sizes[] = {&s.definition.size, &s.definition.muscle_size,
                           &s.definition.muscle_pull_size};
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
    for (int larger = 0; larger < 2; larger++) {
      s.definition = full;
      *sizes[i] = larger ? *sizes[i] + 8 : 0;
      straps_bad(&s, AMBULO_E_ARGUMENT, NULL);
    }
  straps_close(&s);
}

static void null_arguments(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  ambulo_muscles *muscles = NULL;
  const ambulo_muscles_definition full = s.definition, *d = &s.definition;
  assert_int_equal(ambulo_muscles_create(NULL, d, NULL, NULL, &muscles), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_muscles_create(s.model, NULL, NULL, NULL, &muscles), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_muscles_create(s.model, d, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  const char **const texts[] = {&s.definition.name, &s.definition.source, &s.muscles[1].name,
                                &s.muscles[1].group, &s.pulls[1].joint};
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
    const char *kept = *texts[i];
    *texts[i] = NULL;
    straps_bad(&s, AMBULO_E_ARGUMENT, NULL);
    *texts[i] = kept;
  }
  s.muscles[1].pulls = NULL;
  straps_bad(&s, AMBULO_E_ARGUMENT, NULL);
  s.muscles[1].pulls = &s.pulls[1];
  /* with items of either size */
  for (int shorter = 0; shorter < 2; shorter++) {
    s.definition = full;
    if (shorter) s.definition.muscle_size = offsetof(ambulo_muscle, pulls);
    s.definition.muscles = NULL;
    straps_bad(&s, AMBULO_E_ARGUMENT, NULL);
  }
  assert_null(muscles);
  straps_close(&s);
}

static void every_allocation_may_fail(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  for (int shorter = 0; shorter < 2; shorter++) {
    void *older = NULL;
    if (shorter) {
      s.definition.muscle_size = offsetof(ambulo_muscle, pulls);
      older = older_items(s.muscles, strap_m, sizeof *s.muscles, s.definition.muscle_size);
      s.definition.muscles = older;
    }
    long k = 0;
    for (int failed = 1; failed; k++) {
      fail_alloc memory = fail_alloc_at(k);
      ambulo_allocator hook = fail_alloc_hook(&memory);
      ambulo_muscles *muscles = NULL;
      ambulo_status status = ambulo_muscles_create(s.model, &s.definition, &hook, NULL, &muscles);
      failed = memory.failed;
      assert_int_equal(status, failed ? AMBULO_E_MEMORY : AMBULO_OK);
      assert_int_equal(muscles != NULL, !failed);
      ambulo_muscles_free(muscles);
      assert_int_equal(memory.live, 0);
    }
    assert_true(k > 8);
    free(older);
  }
  straps_close(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults),
      cmocka_unit_test(everything_is_copied),
      cmocka_unit_test(exponents_of_no_coordinate_are_dropped),
      cmocka_unit_test(queries),
      cmocka_unit_test(older_structures),
      cmocka_unit_test(sizes_that_no_header_had),
      cmocka_unit_test(null_arguments),
      cmocka_unit_test(every_allocation_may_fail),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
