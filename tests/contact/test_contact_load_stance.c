/* How long a foot is down without interruption, and beside which others. */
#include "contact/contacts.h"
#include "support/patched_walker.h"
#include "support/toed_body.h"
#include "support/walker_fixture.h"

typedef struct fixture {
  ambulo_model *model;
  ambulo_contact contacts[12];
  ambulo_problem_definition definition;
} fixture;

/* left strikes at 0, flat at 0.1, heel off at 0.4, toe off at 0.6 of the stride of 1 s */
static void open_walk(fixture *f, int steps, ambulo_ends ends) {
  f->model = walker_create(0);
  ambulo_gait gait = {.size = sizeof(ambulo_gait),
                      .contact_size = sizeof(ambulo_contact),
                      .steps = steps,
                      .first_foot = WALKER_LEFT,
                      .step_length = 0.6,
                      .step_time = 0.5,
                      .step_width = 0.18,
                      .foot_flat = 0.1,
                      .heel_off = 0.4,
                      .toe_off = 0.6,
                      .other_step_length = AMBULO_OFF,
                      .other_step_time = AMBULO_OFF};
  f->definition = ambulo_problem_definition_default();
  f->definition.model = f->model;
  f->definition.duration = 0.5 * steps;
  f->definition.ends = ends;
  f->definition.contacts = f->contacts;
  assert_int_equal(
      ambulo_gait_expand(f->model, &gait, f->contacts, 12, &f->definition.contact_count), 0);
}

static void open_with(fixture *f, ambulo_ends ends, const ambulo_contact *contacts, int count) {
  f->model = walker_create(0);
  f->definition = ambulo_problem_definition_default();
  f->definition.model = f->model;
  f->definition.ends = ends;
  f->definition.contacts = f->contacts;
  f->definition.contact_count = count;
  memcpy(f->contacts, contacts, (size_t)count * sizeof *contacts);
}

static const ambulo_contact *contact_at(const fixture *f, int foot, double time) {
  for (int i = 0; i < f->definition.contact_count; i++) {
    const ambulo_contact *c = &f->contacts[i];
    if (c->foot == foot && c->from <= time && time < c->to) return c;
  }
  fail_msg("no contact of foot %d at %g s", foot, time);
  return NULL;
}

static ambulo__stance stance_at(const fixture *f, int foot, double time) {
  return ambulo__stance_of(&f->definition, contact_at(f, foot, time));
}

static void same(double got, double want) {
  if (isinf(want)) {
    assert_true(got == want);
  } else {
    assert_close(got, want, 1e-12);
  }
}

static void expect(const ambulo__stance *s, double from, double leaves, double comes, double to) {
  same(s->from, from);
  same(s->leaves, leaves);
  same(s->comes, comes);
  same(s->to, to);
}

/* the left foot: 0 .. 0.6 s beside the right one up to 0.1 and from 0.5 s on */
static void a_mirrored_step_has_stances_beyond_its_ends(void **state) {
  (void)state;
  fixture f;
  open_walk(&f, 1, AMBULO_ENDS_MIRRORED);
  ambulo__stance heel = stance_at(&f, WALKER_LEFT, 0.05);
  ambulo__stance flat = stance_at(&f, WALKER_LEFT, 0.3);
  ambulo__stance toe = stance_at(&f, WALKER_RIGHT, 0.05);
  expect(&heel, 0.0, 0.1, 0.5, 0.6);
  expect(&flat, 0.0, 0.1, 0.5, 0.6);
  expect(&toe, -0.5, -0.4, 0.0, 0.1);
  same(heel.phase.from, 0.0);
  same(heel.phase.to, 0.1);
  assert_int_equal(heel.before, -1);
  assert_int_equal(heel.after, AMBULO_CONTACT_FLAT);
  same(flat.phase.from, 0.1);
  same(flat.phase.to, 0.4);
  assert_int_equal(flat.before, AMBULO_CONTACT_HEEL);
  assert_int_equal(flat.after, AMBULO_CONTACT_TOE);
  same(toe.phase.from, -0.1);
  same(toe.phase.to, 0.1);
  assert_int_equal(toe.before, AMBULO_CONTACT_FLAT);
  assert_int_equal(toe.after, -1);
  ambulo_model_free(f.model);
}

/* two steps with periodic ends say the same as one with mirrored ends */
static void a_stride_of_two_steps_has_the_same_stances(void **state) {
  (void)state;
  fixture one, two;
  open_walk(&one, 1, AMBULO_ENDS_MIRRORED);
  open_walk(&two, 2, AMBULO_ENDS_PERIODIC);
  for (int i = 0; i < one.definition.contact_count; i++) {
    const ambulo_contact *c = &one.contacts[i];
    double time = 0.5 * (c->from + c->to);
    ambulo__stance a = ambulo__stance_of(&one.definition, c);
    ambulo__stance b = stance_at(&two, c->foot, time);
    expect(&a, b.from, b.leaves, b.comes, b.to);
    assert_int_equal(a.before, b.before);
    assert_int_equal(a.after, b.after);
  }
  ambulo_model_free(one.model);
  ambulo_model_free(two.model);
}

/* from standing: the left foot leaves and comes down again; nobody came down before or leaves */
static void a_motion_that_is_cut_has_no_beginning(void **state) {
  (void)state;
  static const ambulo_contact contacts[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.0, -0.1}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 0.4, .place = {0.0, 0.1}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.8, 1.0, .place = {0.3, 0.1}}};
  fixture f;
  open_with(&f, AMBULO_ENDS_FREE, contacts, 3);
  ambulo__stance right = stance_at(&f, WALKER_RIGHT, 0.5);
  ambulo__stance leaving = stance_at(&f, WALKER_LEFT, 0.2);
  ambulo__stance coming = stance_at(&f, WALKER_LEFT, 0.9);
  expect(&right, -INFINITY, -INFINITY, INFINITY, INFINITY);
  /* the right foot outlasts it on that side: half of the time there is */
  expect(&leaving, -INFINITY, -INFINITY, 0.2, 0.4);
  expect(&coming, 0.8, 0.9, INFINITY, INFINITY);
  ambulo__span down = ambulo__stance_in(&f.definition, &contacts[1], AMBULO__ANY_MODE);
  assert_true(down.from == -INFINITY);
  same(down.to, 0.4);
  ambulo_model_free(f.model);
}

/* also where a period is shorter than what two of them would reach */
static void a_foot_that_is_always_down_has_no_end(void **state) {
  (void)state;
  static const ambulo_contact contacts[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.0, -0.1}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 0.6, .place = {0.0, 0.1}},
      {WALKER_LEFT, AMBULO_CONTACT_TOE, 0.6, 1.0, .place = {0.0, 0.1}}};
  static const ambulo_ends ends[] = {AMBULO_ENDS_PERIODIC, AMBULO_ENDS_MIRRORED};
  for (int i = 0; i < 2; i++) {
    fixture f;
    open_with(&f, ends[i], contacts, 3);
    for (int foot = 0; foot < 2; foot++) {
      ambulo__stance s = stance_at(&f, foot, 0.3);
      expect(&s, -INFINITY, -INFINITY, INFINITY, INFINITY);
    }
    ambulo_model_free(f.model);
  }
}

/* standing on one foot, with a touch of the other: it shares the time of that touch alone */
static void a_short_touch_is_loaded_up_to_half_its_time(void **state) {
  (void)state;
  static const ambulo_contact contacts[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.0, -0.1}},
      {WALKER_LEFT, AMBULO_CONTACT_TOE, 0.3, 0.5, .place = {0.0, 0.1}}};
  fixture f;
  open_with(&f, AMBULO_ENDS_PERIODIC, contacts, 2);
  ambulo__stance s = stance_at(&f, WALKER_LEFT, 0.4);
  expect(&s, 0.3, 0.4, 0.4, 0.5);
  ambulo_model_free(f.model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_mirrored_step_has_stances_beyond_its_ends),
                                     cmocka_unit_test(a_stride_of_two_steps_has_the_same_stances),
                                     cmocka_unit_test(a_motion_that_is_cut_has_no_beginning),
                                     cmocka_unit_test(a_foot_that_is_always_down_has_no_end),
                                     cmocka_unit_test(a_short_touch_is_loaded_up_to_half_its_time)};
  return cmocka_run_group_tests_name("contact/contact_load_stance", tests, NULL, NULL);
}
