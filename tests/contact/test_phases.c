/* Events, and grids that have a node at each: by hand and from the shipped walk. */
#include "contact/schedule.h"
#include "ambulo/tools/load.h"
#include "support/dense_fixture.h"
#include "support/engine_fixture.h"
#include "support/fail_alloc.h"
#include "support/messages.h"

/* the walk's phases by hand: stride 1.08 s, left foot first; the tip of the right foot has to clear
 * from 30 % of its swing on */
static void events_are_those_of_the_gait(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/walk_rigid");
  ambulo__events events;
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__events_create(&p->definition, AMBULO__EVENTS_OF_ROWS, &a, &events),
                   AMBULO_OK);
  const double want[] = {0.08 * 1.08, 0.62 * 1.08 - 0.54,
                         0.62 * 1.08 - 0.54 + 0.3 * (1.08 - 0.62 * 1.08), 0.38 * 1.08};
  assert_int_equal(events.count, 4);
  for (int i = 0; i < 4; i++) assert_close(events.time[i], want[i], 1e-9);
  ambulo__free(&a, events.time);
  ambulo_problem_free(p);
}

/* on stairs also where a foot in the air comes to the first edge and has passed the last one: up at
 * 38 and 56 % of its swing from 0.156 to 0.65 s, down at 44 and 62 % */
static void edges_of_steps_are_events(void **state) {
  (void)state;
  static const char *const names[] = {"stairs_up", "stairs_down"};
  static const double first[] = {0.38, 0.44}, last[] = {0.56, 0.62};
  for (int i = 0; i < 2; i++) {
    ambulo_problem *p = load_problem(names[i]);
    ambulo__events events;
    ambulo_allocator a = ambulo__allocator_or_default(NULL);
    assert_int_equal(ambulo__events_create(&p->definition, AMBULO__EVENTS_OF_ROWS, &a, &events),
                     AMBULO_OK);
    int found = 0;
    for (int k = 0; k < events.count; k++) {
      double s = (events.time[k] - 0.156) / (0.65 - 0.156);
      found += fabs(s - first[i]) < 1e-9 || fabs(s - last[i]) < 1e-9;
    }
    assert_int_equal(found, 2);
    ambulo__free(&a, events.time);
    ambulo_problem_free(p);
  }
}

/* contacts alone: no tip */
static void knots_know_contacts_only(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/walk_rigid");
  ambulo__events events;
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__events_create(&p->definition, AMBULO__EVENTS_OF_CONTACTS, &a, &events),
                   AMBULO_OK);
  assert_int_equal(events.count, 3);
  assert_close(events.time[2], 0.38 * 1.08, 1e-9);
  ambulo__free(&a, events.time);
  ambulo_problem_free(p);
}

/* nothing has to clear the ground without rows that ask for it, nor a foot without a tip */
static void tips_that_need_not_clear_make_no_event(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/walk_rigid");
  dense_fixture f;
  ambulo__events events;
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  p->definition.clearance.height = AMBULO_OFF;
  assert_int_equal(ambulo__events_create(&p->definition, AMBULO__EVENTS_OF_ROWS, &a, &events),
                   AMBULO_OK);
  assert_int_equal(events.count, 3);
  ambulo__free(&a, events.time);
  ambulo_problem_free(p);
  dense_open(&f, 20);
  f.problem->definition.clearance.height = 0.01;
  f.problem->definition.clearance.tip_from = 0.3;
  assert_int_equal(
      ambulo__events_create(&f.problem->definition, AMBULO__EVENTS_OF_ROWS, &a, &events),
      AMBULO_OK);
  const double want[] = {0.16 * 0.55, 0.24 * 0.55, 0.76 * 0.55};
  assert_int_equal(events.count, 3);
  for (int i = 0; i < 3; i++) assert_close(events.time[i], want[i], 1e-9);
  ambulo__free(&a, events.time);
  dense_close(&f);
}

static void a_problem_without_contacts_has_none(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/two_link_reach");
  ambulo__events events;
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__events_create(&p->definition, AMBULO__EVENTS_OF_ROWS, &a, &events),
                   AMBULO_OK);
  assert_int_equal(events.count, 0);
  ambulo__free(&a, events.time);
  ambulo_problem_free(p);
}

/* phases of 0.2, 0.1, 0.7 s */
static void expect_counts(int intervals, int least, int first, int second, int third) {
  double event[2] = {0.2, 0.3}, times[64];
  ambulo__events events = {2, event};
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__phase_grid(&events, 1.0, intervals, least, 0.0, &a, times), AMBULO_OK);
  const int count[3] = {first, second, third};
  const double begin[4] = {0.0, 0.2, 0.3, 1.0};
  int k = 0;
  for (int p = 0; p < 3; p++) {
    for (int i = 0; i < count[p]; i++, k++)
      assert_close(times[k], begin[p] + (begin[p + 1] - begin[p]) * i / count[p], 1e-15);
  }
  assert_int_equal(k, intervals);
  assert_true(times[first] == 0.2 && times[first + second] == 0.3 && times[intervals] == 1.0);
}

static void intervals_go_by_duration(void **state) {
  (void)state;
  expect_counts(10, 1, 2, 1, 7);
  expect_counts(20, 2, 4, 2, 14);
  expect_counts(14, 1, 3, 1, 10); /* due 2.8, 1.4, 9.8: the two largest remainders round up */
  expect_counts(10, 2, 2, 2, 6);  /* the short phase takes one from the others' 9: 1.8, 6.2 ... */
  expect_counts(6, 2, 2, 2, 2);
  expect_counts(3, 1, 1, 1, 1);
}

static void too_few_intervals_are_refused(void **state) {
  (void)state;
  double event[2] = {0.2, 0.3}, times[8];
  ambulo__events events = {2, event};
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__phase_grid(&events, 1.0, 5, 2, 0.0, &a, times), AMBULO_E_LIMIT);
  events.count = 0;
  assert_int_equal(ambulo__phase_grid(&events, 1.0, 4, 2, 0.0, &a, times), AMBULO_OK);
  for (int k = 0; k <= 4; k++) assert_close(times[k], 0.25 * k, 0.0);
}

/* whatever the durations: rising, every event a node, at least two intervals a phase, and no phase
 * further than one interval from its share among those that have more than the least */
static void any_phases_are_shared_out(void **state) {
  (void)state;
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  unsigned seed = 7;
  for (int trial = 0; trial < 300; trial++) {
    double event[12], times[128], at = 0.0, all = 0.0, length[13];
    int count = trial % 12, intervals = 2 * (count + 1) + trial % 90, node = 0;
    for (int i = 0; i <= count; i++) {
      seed = seed * 1664525u + 1013904223u;
      all += length[i] = pow((double)(seed >> 8) / 16777216.0, 4.0) + 1e-6;
    }
    for (int i = 0; i < count; i++) event[i] = at += length[i];
    ambulo__events events = {count, event};
    assert_int_equal(ambulo__phase_grid(&events, all, intervals, 2, 0.0, &a, times), AMBULO_OK);
    for (int k = 0; k < intervals; k++) assert_true(times[k + 1] > times[k]);
    for (int i = 0; i <= count; i++) {
      double end = i < count ? event[i] : all;
      int first = node;
      while (times[node] < end) node++;
      assert_true(times[node] == end);
      assert_true(node - first >= 2);
      assert_true(node - first <= 2 || node - first <= intervals * length[i] / all + 1.0);
    }
    assert_int_equal(node, intervals);
  }
}

/* where the k-th of n nodes stands in its phase: dense beside the events, by 0.8 */
static double graded(int k, int n) {
  double s = (double)k / n, turn = 2.0 * acos(-1.0);
  return s - 0.8 * sin(turn * s) / turn;
}

/* N = 25: 4, 2, 5.7, 7.3 and 6 are due */
static void the_walk_has_nodes_at_its_events(void **state) {
  (void)state;
  static const int first[] = {0, 4, 6, 12, 19, 25};
  static const char *const settings[] = {"time.grid=events", "trajectory.knots=events"};
  ambulo_problem *p = NULL;
  assert_int_equal(
      ambulo_problem_load("tests/support/walk_rigid.yaml", settings, 2, NULL, NULL, &p), AMBULO_OK);
  const double toe_off = 0.62 * 1.08 - 0.54, tip = toe_off + 0.3 * (1.08 - 0.62 * 1.08);
  const double want[] = {0.0, 0.08 * 1.08, toe_off, tip, 0.38 * 1.08, 0.54};
  for (int i = 0; i < 6; i++) assert_close(p->times[first[i]], want[i], 1e-12);
  for (int i = 0; i < 5; i++) {
    int count = first[i + 1] - first[i];
    for (int k = 0; k < count; k++)
      assert_close(p->times[first[i] + k], want[i] + (want[i + 1] - want[i]) * graded(k, count),
                   1e-12);
  }
  /* K = 17: 2.72, 1.36, 8.84 and 4.08 are due */
  static const int knot[] = {0, 3, 4, 13, 17};
  const double knots[] = {0.0, want[1], want[2], want[4], want[5]};
  for (int i = 0; i < 5; i++)
    assert_close(ambulo__basis_breakpoints(p->basis)[knot[i]], knots[i], 1e-12);
  double times[26];
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__node_times(&p->definition, &a, NULL, times), AMBULO_OK);
  for (int k = 0; k < 26; k++) {
    assert_true(times[k] == p->times[k]);
    assert_true(ambulo_problem_node_time(p, k) == times[k]);
  }
  assert_true(isnan(ambulo_problem_node_time(p, 26)) && isnan(ambulo_problem_node_time(p, -1)));
  assert_int_equal(ambulo_problem_grid(p), AMBULO_GRID_EVENTS);
  ambulo_problem_free(p);
}

/* foot-flat at .08 of the stride of 1.08 s, the other toe-off 1 ms or 9 ms later; a fifth of the
 * mean of 17 knot intervals is 6.4 ms */
static void knots_are_kept_apart(void **state) {
  (void)state;
  static const double toe_off[] = {0.581, 0.5884};
  for (int i = 0; i < 2; i++) {
    ambulo_problem *p = NULL;
    char text[64];
    int nodes = 0, knots = 0;
    const char *const settings[] = {"time.grid=events", "trajectory.knots=events", text};
    (void)snprintf(text, sizeof text, "gait.phases.toe_off=%.17g", toe_off[i]);
    assert_int_equal(
        ambulo_problem_load("tests/support/walk_rigid.yaml", settings, 3, NULL, NULL, &p), 0);
    const double *knot = ambulo__basis_breakpoints(p->basis);
    double flat = 1.08 * 0.08, leaves = 1.08 * (toe_off[i] - 0.5);
    for (int k = 0; k < p->nodes; k++) nodes += fabs(p->times[k] - leaves) < 1e-9;
    for (int k = 0; k <= 17; k++)
      knots += 2 * (fabs(knot[k] - flat) < 1e-9) + (fabs(knot[k] - leaves) < 1e-9);
    assert_int_equal(nodes, 1);
    assert_int_equal(knots, i ? 3 : 2);
    for (int k = 0; k < 17; k++) assert_true(knot[k + 1] - knot[k] > 0.54 / 17 / 5);
    ambulo_problem_free(p);
  }
}

static void uniform_grids_are_as_before(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/walk_rigid");
  assert_int_equal(ambulo_problem_grid(p), AMBULO_GRID_UNIFORM);
  assert_null(p->before);
  for (int k = 0; k <= 25; k++) assert_true(p->times[k] == k * p->definition.duration / 25);
  int knots;
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__knots_least(&p->definition, &a, &knots), AMBULO_OK);
  assert_int_equal(knots, 1);
  p->definition.grid = p->definition.knots = AMBULO_GRID_EVENTS;
  assert_int_equal(ambulo__knots_least(&p->definition, &a, &knots), AMBULO_OK);
  assert_int_equal(knots, 4);
  p->definition.grid = p->definition.knots = AMBULO_GRID_UNIFORM;
  ambulo_problem_free(p);
}

/* contacts that no problem would have still give rising times */
static void contacts_need_not_be_legal(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/walk_rigid");
  ambulo_problem_definition d = p->definition;
  const ambulo_contact odd[] = {{7, AMBULO_CONTACT_FLAT, 0.3, 0.1, .place = {0, 0}},
                                {-1, AMBULO_CONTACT_FLAT, NAN, 9.0, .place = {0, 0}},
                                {0, AMBULO_CONTACT_TOE, -1.0, 0.3 + 1e-12, .place = {0, 0}}};
  double times[26];
  d.contacts = odd;
  d.contact_count = 3;
  d.grid = AMBULO_GRID_EVENTS;
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__node_times(&d, &a, NULL, times), AMBULO_OK);
  for (int k = 0; k < 25; k++) assert_true(times[k + 1] > times[k]);
  d.intervals = 5;
  assert_int_equal(ambulo__node_times(&d, &a, NULL, times), AMBULO_E_PROBLEM);
  ambulo_problem_free(p);
}

/* definitions with grids on events, every allocation failing once */
static void lack_of_memory_is_survived(void **state) {
  (void)state;
  static const char *const settings[] = {"time.grid=events", "trajectory.knots=events"};
  ambulo_problem *p = NULL;
  int done = 0;
  assert_int_equal(
      ambulo_problem_load("tests/support/walk_rigid.yaml", settings, 2, NULL, NULL, &p), AMBULO_OK);
  for (long k = 0; k < 400 && !done; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_problem *copy = NULL;
    ambulo_status status = ambulo_problem_create(&p->definition, &allocator, NULL, &copy);
    if (status) assert_int_equal(status, AMBULO_E_MEMORY);
    ambulo_problem_free(copy);
    assert_int_equal(memory.live, 0);
    done = !memory.failed;
  }
  assert_true(done);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(events_are_those_of_the_gait),
      cmocka_unit_test(knots_know_contacts_only),
      cmocka_unit_test(edges_of_steps_are_events),
      cmocka_unit_test(tips_that_need_not_clear_make_no_event),
      cmocka_unit_test(a_problem_without_contacts_has_none),
      cmocka_unit_test(intervals_go_by_duration),
      cmocka_unit_test(too_few_intervals_are_refused),
      cmocka_unit_test(any_phases_are_shared_out),
      cmocka_unit_test(the_walk_has_nodes_at_its_events),
      cmocka_unit_test(knots_are_kept_apart),
      cmocka_unit_test(uniform_grids_are_as_before),
      cmocka_unit_test(contacts_need_not_be_legal),
      cmocka_unit_test(lack_of_memory_is_survived),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
