/* Multipliers of one solve for another: densities over time, by the rows' labels. */
#include "method/multipliers.h"
#include "problem/nlp.h"
#include "support/engine_fixture.h"

static const ambulo__table_row *row_of(const ambulo__engine *e, int i) {
  return &e->setup->problem->table.rows[e->linearized.rows.inequality.row[i]];
}

/* to the same grid: as they are */
static void on_the_same_grid_nothing_changes(void **state) {
  (void)state;
  engine_fixture f;
  ambulo_multipliers *saved = NULL;
  engine_open(&f, "support/walk_rigid");
  ambulo__engine *e = f.engine;
  double *was = calloc((size_t)e->setup->inequalities, sizeof *was);
  for (int i = 0; i < e->setup->inequalities; i++)
    e->iterate.lambda[i] = was[i] = i % 3 ? 0.0 : 0.01 * i;
  e->reached.objective = 3.0 * e->setup->objective_scale;
  assert_int_equal(ambulo__multipliers_save(e, NULL, &saved), AMBULO_OK);
  for (int i = 0; i < e->setup->inequalities; i++) e->iterate.lambda[i] = -1.0;
  assert_true(e->iterate.carried_objective < 0.0);
  ambulo__multipliers_transfer(saved, e);
  assert_close(e->iterate.carried_objective, 3.0, 1e-12);
  for (int i = 0; i < e->setup->inequalities; i++)
    assert_close(e->iterate.lambda[i], was[i], 1e-12);
  ambulo_multipliers_free(saved);
  free(was);
  engine_close(&f);
}

/* A density that is linear in time, of one family: on a grid of twice the nodes the same density,
 * so half the multipliers. */
static void densities_are_linear_between_nodes(void **state) {
  (void)state;
  engine_fixture coarse, fine;
  ambulo_multipliers *saved = NULL;
  engine_open_with(&coarse, "support/walk_rigid", "time.intervals=24");
  engine_open_with(&fine, "support/walk_rigid", "time.intervals=48");
  ambulo__engine *c = coarse.engine, *e = fine.engine;
  for (int i = 0; i < c->setup->inequalities; i++) {
    const ambulo__table_row *row = row_of(c, i);
    if (strcmp(row->family, "joint_limit") != 0 || row->node < 0) continue;
    double density = 2.0 + row->time, scale = -c->linearized.rows.inequality.scale[i];
    c->iterate.lambda[i] =
        density * coarse.problem->quadrature[row->node] * c->setup->objective_scale / scale;
  }
  assert_int_equal(ambulo__multipliers_save(c, NULL, &saved), AMBULO_OK);
  ambulo__multipliers_transfer(saved, e);
  int seen = 0;
  for (int i = 0; i < e->setup->inequalities; i++) {
    const ambulo__table_row *row = row_of(e, i);
    if (strcmp(row->family, "joint_limit") != 0 || row->node < 0) {
      assert_true(e->iterate.lambda[i] == 0.0);
      continue;
    }
    double scale = -e->linearized.rows.inequality.scale[i];
    double density = e->iterate.lambda[i] * scale /
                     (e->setup->objective_scale * fine.problem->quadrature[row->node]);
    assert_close(density, 2.0 + row->time, 1e-9);
    seen++;
  }
  assert_true(seen > 100);
  ambulo_multipliers_free(saved);
  engine_close(&coarse);
  engine_close(&fine);
}

/* limits on control points stand for no time: the same multipliers on a grid of twice the nodes */
static void rows_on_control_points_keep_their_multipliers(void **state) {
  (void)state;
  engine_fixture coarse, fine;
  ambulo_multipliers *saved = NULL;
  engine_open_with(&coarse, "support/two_link_reach", "constraints.joint_limits=control_points");
  fine.options = ambulo_options_default();
  ambulo__run_begin(&fine.run, &fine.options);
  assert_int_equal(ambulo__problem_with_grid(coarse.problem, 40, 10, NULL, &fine.problem),
                   AMBULO_OK);
  fine.x = calloc((size_t)fine.problem->variables, sizeof *fine.x);
  assert_int_equal(ambulo__engine_create(fine.problem, fine.x, NULL, &fine.run, NULL, &fine.engine),
                   AMBULO_OK);
  ambulo__engine *c = coarse.engine, *e = fine.engine;
  for (int i = 0; i < c->setup->inequalities; i++)
    c->iterate.lambda[i] = row_of(c, i)->node < 0 ? 2.0 * c->setup->objective_scale : 0.0;
  assert_int_equal(ambulo__multipliers_save(c, NULL, &saved), AMBULO_OK);
  ambulo__multipliers_transfer(saved, e);
  int seen = 0;
  for (int i = 0; i < e->setup->inequalities; i++) {
    if (row_of(e, i)->node >= 0) continue;
    assert_close(e->iterate.lambda[i] / e->setup->objective_scale, 2.0, 1e-9);
    seen++;
  }
  assert_true(seen > 10);
  ambulo_multipliers_free(saved);
  engine_close(&fine);
  engine_close(&coarse);
}

/* beside a hole in time a density lasts for half an interval; nothing carried is nothing */
static void holes_stay_empty(void **state) {
  (void)state;
  engine_fixture coarse, fine;
  ambulo_multipliers *saved = NULL;
  engine_open_with(&coarse, "support/walk_rigid", "time.intervals=24");
  engine_open_with(&fine, "support/walk_rigid", "time.intervals=96");
  ambulo__engine *c = coarse.engine, *e = fine.engine;
  double T = coarse.problem->definition.duration, interval = T / 24.0, worst = 0.0;
  for (int i = 0; i < c->setup->inequalities; i++) {
    const ambulo__table_row *row = row_of(c, i);
    double scale = -c->linearized.rows.inequality.scale[i];
    if (strcmp(row->family, "joint_limit") == 0 && row->node >= 0)
      c->iterate.lambda[i] =
          coarse.problem->quadrature[row->node] * c->setup->objective_scale / scale;
  }
  c->reached.objective = -3.0 * c->setup->objective_scale;
  assert_int_equal(ambulo__multipliers_save(c, NULL, &saved), AMBULO_OK);
  int kept = 0; /* the rows from 5 to 10 intervals go */
  for (int k = 0; k < saved->count; k++) {
    double at = saved->row[k].time * 24.0;
    if (at < 4.5 || at > 10.5) saved->row[kept++] = saved->row[k];
  }
  saved->count = kept;
  ambulo__multipliers_transfer(saved, e);
  assert_close(e->iterate.carried_objective, 3.0, 1e-12);
  for (int i = 0; i < e->setup->inequalities; i++) {
    const ambulo__table_row *row = row_of(e, i);
    if (strcmp(row->family, "joint_limit") != 0 || row->node < 0) continue;
    double scale = -e->linearized.rows.inequality.scale[i], at = row->time / interval;
    double density = e->iterate.lambda[i] * scale /
                     (e->setup->objective_scale * fine.problem->quadrature[row->node]);
    worst = fmax(worst, fabs(density - (at > 4.6 && at < 10.4 ? 0.0 : 1.0)));
  }
  assert_close(worst, 0.0, 1e-9);
  double lambda = e->iterate.lambda[0];
  ambulo__multipliers_transfer(NULL, e); /* there are none */
  assert_true(e->iterate.lambda[0] == lambda);
  ambulo_multipliers_free(saved);
  engine_close(&coarse);
  engine_close(&fine);
}

/* One step for two, each other of which is the mirror image: the engine of two steps has in its
 * second half the densities of the partners. The rows of the coordinates' limits tell. */
static void periods_are_mirrored(void **state) {
  (void)state;
  engine_fixture f;
  engine_open_with(&f, "support/walk_rigid", "time.intervals=24");
  ambulo__engine *e = f.engine;
  const ambulo_problem *p = f.problem;
  const ambulo_model *model = p->model;
  int count = 4 * model->coordinate_count, seen = 0;
  static const char *const details[] = {"lower", "upper"};
  ambulo_multipliers *m = NULL;
  assert_int_equal(ambulo__multipliers_allocate(count, NULL, &m), AMBULO_OK);
  m->interval = 1.0; /* constant over the period, another for each series */
  m->periods = 2;
  m->mirrored = 1;
  for (int i = 0; i < count; i++) {
    const ambulo_coordinate *c = &model->coordinates[i / 4];
    m->row[i] = (ambulo__multiplier){
        ambulo__multiplier_series("joint_limit", c->name, details[i / 2 % 2]), i % 2, 1.0 + i / 2};
  }
  ambulo__multipliers_sort(m);
  ambulo__multipliers_transfer(m, e);
  for (int i = 0; i < e->setup->inequalities; i++) {
    const ambulo__table_row *row = row_of(e, i);
    if (strcmp(row->family, "joint_limit") != 0 || row->time > p->definition.duration) continue;
    int second = row->time > 0.5 * p->definition.duration * (1.0 + 1e-9);
    if (fabs(row->time - 0.5 * p->definition.duration) < 1e-9) continue;
    int c = ambulo_model_find_coordinate(model, row->subject), upper = row->detail[0] == 'u';
    int partner = second ? model->coordinates[c].mirror : c;
    if (second && model->coordinates[c].mirror_sign < 0.0) upper = !upper;
    double density = e->iterate.lambda[i] * -e->linearized.rows.inequality.scale[i] /
                     (e->setup->objective_scale * p->quadrature[row->node]);
    assert_close(density, 1.0 + 2 * partner + upper, 1e-9);
    seen += second;
  }
  assert_true(seen > 100);
  ambulo_multipliers_free(m);
  engine_close(&f);
}

/* the density of one row that is asked for in the second of two mirrored periods */
static double in_the_mirror(engine_fixture *f, const char *family, const char *subject,
                            const char *detail, const ambulo__table_row *asked) {
  ambulo_multipliers *m = NULL;
  assert_int_equal(ambulo__multipliers_allocate(1, NULL, &m), AMBULO_OK);
  double duration = f->problem->definition.duration, density = 0.0;
  m->interval = m->mirrored = 1;
  m->periods = 2;
  m->row[0] = (ambulo__multiplier){ambulo__multiplier_series(family, subject, detail),
                                   2.0 * asked->time / duration - 1.0, 3.0};
  ambulo__multipliers_transfer(m, f->engine);
  for (int i = 0; i < f->engine->setup->inequalities; i++)
    if (row_of(f->engine, i) == asked)
      density = f->engine->iterate.lambda[i] * -f->engine->linearized.rows.inequality.scale[i] /
                (f->engine->setup->objective_scale * f->problem->quadrature[asked->node]);
  ambulo_multipliers_free(m);
  return density;
}

/* what is no coordinate has its side in words: right and left, _r and _l */
static void sides_are_words(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "support/walk_rigid");
  static const char *const sides[][2] = {
      {"right", "left"}, {"left", "right"}, {"heel_r", "heel_l"}, {"heel_l", "heel_r"}};
  int seen[4] = {0};
  for (int i = 0; i < f.engine->setup->inequalities; i++) {
    const ambulo__table_row *row = row_of(f.engine, i);
    if (row->node < 0 || row->time <= 0.51 * f.problem->definition.duration ||
        strstr(row->detail, "left") || strstr(row->detail, "right"))
      continue;
    for (int k = 0; k < 4; k++) {
      if (seen[k] || strcmp(row->subject, sides[k][0]) != 0) continue;
      double same = in_the_mirror(&f, row->family, sides[k][0], row->detail, row);
      double other = in_the_mirror(&f, row->family, sides[k][1], row->detail, row);
      assert_close(other, 3.0, 1e-9);
      assert_true(same == 0.0);
      seen[k] = 1;
    }
  }
  assert_true((seen[0] || seen[1]) && (seen[2] || seen[3]));
  engine_close(&f);
}

/* what was at t + d is at t */
static void a_shift_brings_later_ones(void **state) {
  (void)state;
  ambulo_multipliers *m = NULL;
  assert_int_equal(ambulo__multipliers_allocate(2, NULL, &m), AMBULO_OK);
  m->row[1].time = 0.75;
  ambulo__multipliers_shift(m, 0.25);
  assert_true(m->row[0].time == -0.25 && m->row[1].time == 0.5);
  ambulo_multipliers_free(m);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(on_the_same_grid_nothing_changes),
      cmocka_unit_test(densities_are_linear_between_nodes),
      cmocka_unit_test(rows_on_control_points_keep_their_multipliers),
      cmocka_unit_test(holes_stay_empty),
      cmocka_unit_test(periods_are_mirrored),
      cmocka_unit_test(sides_are_words),
      cmocka_unit_test(a_shift_brings_later_ones),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
