/* The worst of each family: a value that is not finite is worse than any number, named, and never
 * lost among larger ones. */
#include "support/engine_fixture.h"
#include "solver/dense.h"

typedef struct poison {
  ambulo_problem *problem;
  ambulo__dense dense;
  ambulo__events events;
  ambulo__dense_worst clean, worst;
} poison;

static void open_with(poison *f, const char *name) {
  unsigned seed = 3;
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  f->problem = load_problem(name);
  double *x = calloc((size_t)f->problem->variables, sizeof *x);
  for (int i = 0; i < f->problem->variables; i++) x[i] = 0.1 * random_number(&seed);
  assert_int_equal(ambulo__dense_open(f->problem, x, 10, 0.0, NULL, NULL, &f->dense), AMBULO_OK);
  assert_int_equal(
      ambulo__events_create(&f->problem->definition, AMBULO__EVENTS_OF_ROWS, &a, &f->events),
      AMBULO_OK);
  ambulo__dense_worst_of(&f->dense, &f->events, &f->clean);
  free(x);
}

static void close_all(poison *f) {
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  ambulo__free(&a, f->events.time);
  ambulo__dense_close(&f->dense);
  ambulo_problem_free(f->problem);
}

/* one row of each family in turn, in the middle of the motion */
static void a_row_that_is_not_finite_is_named(void **state) {
  (void)state;
  static const char *const names[] = {"support/walk_rigid", "support/walk_without_reaction"};
  static const double bad[] = {NAN, INFINITY, -INFINITY};
  int tried = 0;
  for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
    poison f;
    open_with(&f, names[n]);
    const ambulo_problem *fine = f.dense.fine;
    int last[AMBULO__DENSE_RULES] = {0};
    for (int r = 0; r < fine->rows; r++) {
      const ambulo__table_row *row = &fine->table.rows[r];
      int rule = row->node < 0 ? -1 : ambulo__dense_rule_of_row(row);
      if (rule < 0 || row->time < 0.3 || last[rule]) continue;
      double keep = f.dense.row_value[r], poisoned = bad[tried++ % 3];
      last[rule] = 1;
      f.dense.row_value[r] = poisoned;
      ambulo__dense_worst_of(&f.dense, &f.events, &f.worst);
      f.dense.row_value[r] = keep;
      const ambulo__dense_entry *entry = &f.worst.entry[rule];
      if (!isnan(entry->ratio)) print_error("%s: %s was lost\n", names[n], row->family);
      assert_true(isnan(entry->ratio));
      assert_string_equal(entry->sample.family, row->family);
      assert_string_equal(entry->sample.subject, row->subject);
      assert_string_equal(entry->sample.detail, row->detail);
      assert_close(entry->sample.time, row->time, 0.0);
      for (int other = 0; other < AMBULO__DENSE_RULES; other++) {
        if (other != rule && f.clean.entry[other].present)
          assert_close(f.worst.entry[other].ratio, f.clean.entry[other].ratio, 0.0);
      }
    }
    close_all(&f);
  }
  assert_true(tried >= 12);
}

static void poison_channel(poison *f, int node, int channel, double value) {
  int channels = ambulo__channel_count(&f->problem->channels);
  double *at = &f->dense.channel[ambulo__lane_index(node, channels, channel)], keep = *at;
  *at = value;
  ambulo__dense_worst_of(&f->dense, &f->events, &f->worst);
  *at = keep;
}

/* between two nodes, and at a node, where the lines to both sides are gone */
static void a_force_or_place_that_is_not_finite_is_named(void **state) {
  (void)state;
  static const int nodes[] = {123, 120};
  static const double bad[] = {NAN, INFINITY};
  poison f;
  open_with(&f, "support/walk_rigid");
  const ambulo_model *model = f.problem->model;
  int up = fabs(model->up[1]) > 0.5 ? 1 : 2, ahead = fabs(model->forward[0]) > 0.5 ? 0 : 1;
  int left = strcmp(model->feet[0].name, "left") == 0 ? 0 : 1; /* it stands at 0.26 s */
  const ambulo__dense_entry *force = &f.worst.entry[AMBULO__DENSE_RULE_FORCE];
  const ambulo__dense_entry *slip = &f.worst.entry[AMBULO__DENSE_RULE_SLIP];
  for (int i = 0; i < 4; i++) {
    int node = nodes[i / 2];
    double least = node == 123 ? 0.54 * 123 / 250 : 0.54 * 110 / 250;
    poison_channel(&f, node, ambulo__channel_force(&f.problem->channels, up), bad[i % 2]);
    assert_true(isnan(force->ratio) && !isnan(slip->ratio));
    assert_string_equal(force->sample.subject, "total");
    assert_true(force->sample.time >= least - 1e-9 && force->sample.time < 0.28);
    poison_channel(&f, node, ambulo__channel_foot_force(&f.problem->channels, left, up),
                   bad[i % 2]);
    assert_true(isnan(force->ratio));
    assert_string_equal(force->sample.subject, "left");
    int point = model->feet[left].toe[0];
    poison_channel(&f, node, ambulo__channel_point(&f.problem->channels, point, ahead), bad[i % 2]);
    assert_true(isnan(slip->ratio) && !isnan(force->ratio));
    assert_string_equal(slip->sample.subject, model->points[point].name);
  }
  close_all(&f);
}

/* lengths and angles of one family are kept apart; what is worst is worst by its tolerance */
static void units_are_not_mixed(void **state) {
  (void)state;
  poison f;
  open_with(&f, "support/walk_rigid");
  int contacts = 0;
  for (int rule = 0; rule < AMBULO__DENSE_RULES; rule++) {
    const ambulo__dense_entry *entry = &f.clean.entry[rule];
    const ambulo__dense_rule *r = ambulo__dense_rule_at(rule);
    if (!entry->present) continue;
    assert_string_equal(entry->sample.family, ambulo__row_family(r->kind));
    if (!r->of_limit) assert_string_equal(entry->sample.unit, ambulo__measure_text(r->measure));
    assert_close(entry->ratio, entry->sample.value / entry->sample.tolerance, 1e-12);
    assert_true(entry->between <= entry->ratio);
    contacts += strcmp(entry->sample.family, "contact") == 0;
  }
  assert_int_equal(contacts, 2);
  close_all(&f);
}

/* the first of two that are not finite is named: what follows it is often its consequence */
static void the_first_that_is_not_finite_stays(void **state) {
  (void)state;
  poison f;
  open_with(&f, "support/walk_rigid");
  const ambulo_problem *fine = f.dense.fine;
  double first = -1.0;
  int poisoned = 0, rule = -1;
  for (int r = 0; r < fine->rows && poisoned < 2; r++) {
    const ambulo__table_row *row = &fine->table.rows[r];
    if (row->kind != AMBULO__KIND_PRESSURE || row->time < 0.3 || row->time == first) continue;
    if (poisoned++ == 0) first = row->time;
    rule = ambulo__dense_rule_of_row(row);
    f.dense.row_value[r] = NAN;
  }
  assert_int_equal(poisoned, 2);
  ambulo__dense_worst_of(&f.dense, &f.events, &f.worst);
  assert_true(isnan(f.worst.entry[rule].ratio));
  assert_close(f.worst.entry[rule].sample.time, first, 0.0);
  close_all(&f);
}

/* rows of a contact are off beside its events for another reason than between nodes: `between`
 * leaves those intervals out, and no others; forces know no events */
static void what_lies_beside_an_event_is_kept_apart(void **state) {
  (void)state;
  poison f;
  open_with(&f, "support/walk_rigid");
  const ambulo_problem *fine = f.dense.fine;
  const ambulo_problem_definition *d = &f.problem->definition;
  int beside = 0, apart = 0, rule = -1;
  for (int r = 0; r < fine->rows; r++) f.dense.row_value[r] = 1.0;
  for (int r = 0; r < fine->rows; r++) {
    const ambulo__table_row *row = &fine->table.rows[r];
    if (row->kind != AMBULO__KIND_NORMAL_FORCE && row->kind != AMBULO__KIND_ZMP) continue;
    if (row->node < 0) continue;
    rule = ambulo__dense_rule_of_row(row);
    int near = ambulo__dense_near_event(&f.events, row->time, d->duration, d->intervals);
    f.dense.row_value[r] = -0.3;
    ambulo__dense_worst_of(&f.dense, &f.events, &f.worst);
    f.dense.row_value[r] = 1.0;
    const ambulo__dense_entry *entry = &f.worst.entry[rule];
    assert_true(entry->ratio > 1.0);
    assert_close(entry->between, near ? 0.0 : entry->ratio, 0.0);
    beside += near;
    apart += !near;
  }
  assert_true(beside > 0 && apart > 0);
  close_all(&f);
}

/* a torque beyond its limit counts by the limit: 0.9 N m of 30 N m are 3 %, of which 2 % are
 * allowed; rows on control points are the same on every grid and left out */
static void limits_count_by_their_size(void **state) {
  (void)state;
  poison f;
  ambulo__table_row any = {.kind = AMBULO__KIND_JOINT_LIMIT, .measure = AMBULO__RADIANS};
  open_with(&f, "support/two_link_reach");
  assert_true(f.clean.entry[ambulo__dense_rule_of_row(&any)].present);
  const ambulo_problem *fine = f.dense.fine;
  int r = 0;
  for (int i = 0; i < fine->rows; i++) f.dense.row_value[i] = 1.0;
  while (fine->table.rows[r].kind != AMBULO__KIND_TORQUE_LIMIT) r++;
  const ambulo__table_row *row = &fine->table.rows[r];
  double limit = ambulo__dense_limit_size(f.problem, row);
  assert_true(limit > 1.5);
  f.dense.row_value[r] = -0.03 * limit;
  ambulo__dense_worst_of(&f.dense, &f.events, &f.worst);
  assert_close(f.worst.entry[ambulo__dense_rule_of_row(row)].ratio, 1.5, 1e-12);
  close_all(&f);
  f.problem =
      load_problem_with("support/two_link_reach", "constraints.joint_limits=control_points");
  double *x = calloc((size_t)f.problem->variables, sizeof *x);
  for (int i = 0; i < f.problem->variables; i++) x[i] = 20.0;
  assert_int_equal(ambulo__dense_open(f.problem, x, 10, 0.0, NULL, NULL, &f.dense), AMBULO_OK);
  f.events = (ambulo__events){0, NULL};
  ambulo__dense_worst_of(&f.dense, &f.events, &f.worst);
  assert_false(f.worst.entry[ambulo__dense_rule_of_row(&any)].present);
  free(x);
  close_all(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_row_that_is_not_finite_is_named),
      cmocka_unit_test(a_force_or_place_that_is_not_finite_is_named),
      cmocka_unit_test(units_are_not_mixed),
      cmocka_unit_test(the_first_that_is_not_finite_stays),
      cmocka_unit_test(what_lies_beside_an_event_is_kept_apart),
      cmocka_unit_test(limits_count_by_their_size),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
