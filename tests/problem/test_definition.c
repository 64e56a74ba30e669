/* The tables of members: nothing of a structure is left out, and every member counts for the hash
 * and belongs to a copy. */
#include "base/alloc.h"
#include "model/model.h"
#include "problem/definition.h"
#include "support/arm.h"
#include "support/test.h"

/* ------------------------------------------------------------------ all structures */

static const ambulo__structure *const structures[] = {
    &ambulo__definition_members, &ambulo__clearance_members,    &ambulo__ground_reaction_members,
    &ambulo__collision_members,  &ambulo__contact_members,      &ambulo__end_value_members,
    &ambulo__tube_members,       &ambulo__obstacle_members,     &ambulo__reach_members,
    &ambulo__device_members,     &ambulo__hold_members,         &ambulo__term_members,
    &ambulo__user_row_members,   &ambulo__capsule_pair_members, &ambulo__options_members};

static int is_whole(const ambulo__member *m) {
  return m->type >= AMBULO__INTEGER && m->type <= AMBULO__INDEX;
}

static size_t bytes_of(const ambulo__member *m) {
  if (m->type == AMBULO__PART) return m->of->size;
  if (m->type > AMBULO__INDEX) return sizeof(void *);
  return (size_t)m->count * (is_whole(m) ? sizeof(int) : sizeof(double));
}

/* rows follow one another as members do, but for what alignment asks for */
static void rows_cover_their_structures(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof structures / sizeof *structures; i++) {
    const ambulo__structure *s = structures[i];
    size_t end = 0; /* behind the sizes */
    if (s == &ambulo__definition_members) end = offsetof(ambulo_problem_definition, name);
    if (s == &ambulo__options_members) end = offsetof(ambulo_options, algorithm);
    for (int k = 0; k < s->count; k++) {
      const ambulo__member *m = &s->members[k];
      size_t align = is_whole(m) ? sizeof(int) : sizeof(double);
      assert_int_equal(m->at, (end + align - 1) / align * align);
      end = m->at + bytes_of(m);
    }
    assert_true(s->size >= end && s->size - end < sizeof(double));
  }
}

/* a default is within the range that a file may say, and `low` below `high` */
static void defaults_are_in_their_ranges(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof structures / sizeof *structures; i++) {
    for (int k = 0; k < structures[i]->count; k++) {
      const ambulo__member *m = &structures[i]->members[k];
      double range[2];
      ambulo__member_range(m, range);
      if (m->type > AMBULO__INTEGER || !(m->low < m->high)) continue;
      for (int n = 0; n < 2; n++) {
        if (isnan(m->usual[n]) || isinf(m->usual[n]) || m->flags & AMBULO__REQUIRED) continue;
        if (n > 0 && m->count < 2) continue;
        assert_true(m->usual[n] >= m->low && m->usual[n] <= m->high);
        assert_true(range[0] <= m->low && range[1] >= m->high);
      }
    }
  }
}

/* ------------------------------------------------------------- one of everything */

enum { MOST_BLOCKS = 64, LENGTH = 64 };

typedef struct whole {
  ambulo_model *model;
  ambulo_problem_definition d;
  void *block[MOST_BLOCKS];
  size_t size[MOST_BLOCKS]; /* 0: a text */
  int blocks;
} whole;

static void *zeros(whole *w, size_t size) {
  assert_true(w->blocks < MOST_BLOCKS);
  w->block[w->blocks] = calloc(1, size);
  assert_non_null(w->block[w->blocks]);
  w->size[w->blocks] = size;
  return w->block[w->blocks++];
}

/* two items, numbers or letters of each */
static void furnish(whole *w, const ambulo__structure *s, char *item) {
  for (int i = 0; i < s->count; i++) {
    const ambulo__member *m = &s->members[i];
    const int two = 2;
    const void *pointer = w;
    if (m->type == AMBULO__PART) furnish(w, m->of, item + m->at);
    if (m->type < AMBULO__TEXT || m->type == AMBULO__PART) continue;
    if (m->type == AMBULO__ITEMS) {
      char *items = zeros(w, 2 * m->of->size);
      for (int k = 0; k < 2; k++) ambulo__members_fill(m->of, items + (size_t)k * m->of->size);
      for (int k = 0; k < 2; k++) furnish(w, m->of, items + (size_t)k * m->of->size);
      pointer = items;
    } else if (m->type == AMBULO__TEXT) {
      pointer = strcpy(zeros(w, 8), "name");
      w->size[w->blocks - 1] = 0;
    } else if (m->type != AMBULO__BORROWED) {
      pointer = zeros(w, LENGTH * sizeof(double));
    }
    memcpy(item + m->at, &pointer, sizeof pointer);
    if (m->extent == AMBULO__EACH_SAMPLE_COORDINATE ||
        (m->extent == AMBULO__COUNTED &&
         (m->type == AMBULO__ITEMS || m->type == AMBULO__NUMBER_ARRAY ||
          m->type == AMBULO__INDEX_ARRAY)))
      memcpy(item + m->count_at, &two, sizeof two);
  }
}

static void open(whole *w) {
  memset(w, 0, sizeof *w);
  w->model = arm_create();
  w->d = ambulo_problem_definition_default();
  furnish(w, &ambulo__definition_members, (char *)&w->d);
  w->d.model = w->model;
  w->d.intervals = 4;
  w->d.spline_intervals = 3;
}

static void close(whole *w) {
  for (int i = 0; i < w->blocks; i++) free(w->block[i]);
  ambulo_model_free(w->model);
}

/* --------------------------------------------------------------------- the hash */

static unsigned long long hash_of(const whole *w) {
  return ambulo__definition_hash(&w->d, w->model);
}

/* another value at `at` makes another hash */
static void expect_seen(const whole *w, const char *key, void *at, const void *other, size_t size) {
  char kept[sizeof(double)];
  unsigned long long before = hash_of(w);
  memcpy(kept, at, size);
  memcpy(at, other, size);
  if (hash_of(w) == before) print_error("the hash does not see '%s'\n", key ? key : "(no key)");
  assert_true(hash_of(w) != before);
  memcpy(at, kept, size);
  assert_true(hash_of(w) == before);
}

static void expect_all_seen(const whole *w, const ambulo__structure *s, char *item) {
  const double number = 0.37;
  const int integer = 1; /* counts of two, indices and choices: another one, and within arrays */
  const char letter = 'x';
  for (int i = 0; i < s->count; i++) {
    const ambulo__member *m = &s->members[i];
    char *at = item + m->at, *array = NULL;
    if (m->type >= AMBULO__TEXT && m->type != AMBULO__PART) memcpy(&array, at, sizeof array);
    size_t length = m->type >= AMBULO__NUMBER_ARRAY && m->type <= AMBULO__ITEMS
                        ? ambulo__member_length(m, &w->d, item)
                        : 0;
    if (m->type <= AMBULO__FILE_ANGLE)
      for (int k = 0; k < m->count; k++)
        expect_seen(w, m->key, at + (size_t)k * sizeof number, &number, sizeof number);
    if (is_whole(m)) {
      int kept, other;
      memcpy(&kept, at, sizeof kept);
      other = kept == integer ? 0 : integer;
      expect_seen(w, m->key, at, &other, sizeof other);
    }
    if (m->flags & AMBULO__NOT_HASHED) { /* seen by nobody */
      unsigned long long before = hash_of(w);
      array[1] = letter;
      assert_true(hash_of(w) == before);
      continue;
    }
    if (m->type == AMBULO__TEXT) expect_seen(w, m->key, array + 1, &letter, 1);
    if (m->type == AMBULO__NUMBER_ARRAY)
      for (size_t k = 0; k < length * (size_t)m->count; k++)
        expect_seen(w, m->key, array + k * sizeof number, &number, sizeof number);
    if (m->type == AMBULO__INDEX_ARRAY)
      for (size_t k = 0; k < length; k++)
        expect_seen(w, m->key, array + k * sizeof integer, &integer, sizeof integer);
    if (m->type == AMBULO__PART) expect_all_seen(w, m->of, at);
    for (size_t k = 0; m->type == AMBULO__ITEMS && k < length; k++)
      expect_all_seen(w, m->of, array + k * m->of->size);
    char *nothing = NULL;
    if (m->type == AMBULO__BORROWED && s != &ambulo__definition_members)
      expect_seen(w, m->key, at, &nothing, sizeof nothing);
  }
}

static void the_hash_sees_every_member(void **state) {
  (void)state;
  whole w;
  open(&w);
  expect_all_seen(&w, &ambulo__definition_members, (char *)&w.d);
  close(&w);
}

static void the_hash_sees_the_model(void **state) {
  (void)state;
  whole w;
  open(&w);
  const double number = 0.37;
  ambulo_model *m = w.model;
  for (int k = 0; k < 3; k++) {
    expect_seen(&w, "gravity", &m->gravity[k], &number, sizeof number);
    expect_seen(&w, "com", &m->links[1].com[k], &number, sizeof number);
    expect_seen(&w, "position", &m->points[0].position[k], &number, sizeof number);
  }
  expect_seen(&w, "mass", &m->links[1].mass, &number, sizeof number);
  for (int k = 0; k < 6; k++)
    expect_seen(&w, "inertia", &m->links[1].inertia[k], &number, sizeof number);
  for (int side = 0; side < 2; side++) {
    expect_seen(&w, "range", &m->coordinates[1].range[side], &number, sizeof number);
    expect_seen(&w, "speed", &m->coordinates[1].speed[side], &number, sizeof number);
    expect_seen(&w, "torque", &m->coordinates[1].torque[side], &number, sizeof number);
  }
  expect_seen(&w, "default", &m->coordinates[0].default_value, &number, sizeof number);
  expect_seen(&w, "armature", &m->coordinates[0].armature, &number, sizeof number);
  expect_seen(&w, "damping", &m->coordinates[0].damping, &number, sizeof number);
  expect_seen(&w, "friction", &m->coordinates[1].friction, &number, sizeof number);
  close(&w);
}

/* ---------------------------------------------------------------------- copies */

static void a_copy_has_every_member_of_its_own(void **state) {
  (void)state;
  whole w;
  ambulo_problem_definition copy;
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  open(&w);
  assert_int_equal(ambulo__definition_copy(&w.d, &a, &copy), AMBULO_OK);
  unsigned long long hash = hash_of(&w);
  assert_ptr_equal(copy.obstacles[0].name, w.d.obstacles[0].name); /* names outlive copies */
  assert_ptr_not_equal(copy.terms[0].name, w.d.terms[0].name);
  for (int i = 0; i < w.blocks; i++) memset(w.block[i], 0, w.size[i]);
  assert_true(ambulo__definition_hash(&copy, w.model) == hash);
  ambulo__definition_free(&a, &copy);
  close(&w);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rows_cover_their_structures), cmocka_unit_test(defaults_are_in_their_ranges),
      cmocka_unit_test(the_hash_sees_every_member), cmocka_unit_test(the_hash_sees_the_model),
      cmocka_unit_test(a_copy_has_every_member_of_its_own)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
