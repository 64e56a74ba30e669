/* tests/support/row_fixture.h - a context for the row families, and values of their rows. */
#ifndef AMBULO_TESTS_ROW_FIXTURE_H
#define AMBULO_TESTS_ROW_FIXTURE_H

#include "contact/row_families.h"
#include "model/neutral_pose.h"
#include "support/walker_fixture.h"

enum { ROW_NODES = 5 };

/* A body, usually the walker, for 1 s at nodes 0, 0.25, ... 1 with a cubic B-spline of 4 intervals.
 */
typedef struct row_fixture {
  ambulo_model *model;
  ambulo__basis *basis;
  ambulo_problem_definition definition;
  ambulo__gait_context context;
  ambulo__row_table table;
  double times[ROW_NODES];
  int active[2 * ROW_NODES], before[2 * ROW_NODES];
  double *channel; /* [nodes][channels] */
} row_fixture;

/* takes the body over */
static inline void row_fixture_open_body(row_fixture *f, ambulo_model *body) {
  memset(f, 0, sizeof *f);
  f->model = body;
  f->definition = ambulo_problem_definition_default();
  f->definition.model = f->model;
  f->definition.intervals = ROW_NODES - 1;
  assert_int_equal(ambulo__basis_create(AMBULO__BSPLINE, 3, 4, 1.0, NULL, NULL, &f->basis),
                   AMBULO_OK);
  for (int k = 0; k < ROW_NODES; k++) f->times[k] = 0.25 * k;
  f->context = (ambulo__gait_context){
      .definition = &f->definition,
      .model = f->model,
      .basis = f->basis,
      .channels = {.coordinates = f->model->coordinate_count, .points = f->model->point_count},
      .times = f->times,
      .nodes = ROW_NODES,
      .active = f->active};
  int count = ambulo__channel_count(&f->context.channels);
  f->channel = calloc((size_t)(ROW_NODES * count), sizeof(double));
  ambulo__row_table_init(&f->table, NULL);
  for (int k = 0; k < ROW_NODES; k++) {
    f->active[2 * k] = f->active[2 * k + 1] = -1;
    for (int p = 0; p < f->model->point_count; p++) {
      ambulo__neutral_point(
          f->model, p, f->channel + k * count + ambulo__channel_point(&f->context.channels, p, 0));
    }
  }
}

static inline void row_fixture_open(row_fixture *f, int planar) {
  row_fixture_open_body(f, walker_create(planar));
}

/* a grid on events: at `node` the foot was in contact `before` (-1: in the air) until then */
static inline void row_event(row_fixture *f, int node, int foot, int before) {
  if (!f->context.before) memcpy(f->before, f->active, sizeof f->before);
  f->context.before = f->before;
  f->before[2 * node + foot] = before;
}

/* rows with these labels at a time */
static inline int row_count(const row_fixture *f, const char *family, const char *subject,
                            const char *detail, double time) {
  int count = 0;
  for (int r = 0; r < f->table.row_count; r++) {
    const ambulo__table_row *row = &f->table.rows[r];
    count += !strcmp(row->family, family) && !strcmp(row->subject, subject) &&
             !strcmp(row->detail, detail) && fabs(row->time - time) <= 1e-12;
  }
  return count;
}

static inline void row_fixture_close(row_fixture *f) {
  free(f->channel);
  ambulo__row_table_clear(&f->table);
  ambulo__basis_free(f->basis);
  ambulo_model_free(f->model);
}

/* where a channel of a node is kept */
static inline double *row_channel(row_fixture *f, int node, int channel) {
  return f->channel + node * ambulo__channel_count(&f->context.channels) + channel;
}

static inline double row_value(row_fixture *f, int row) {
  const ambulo__table_row *r = &f->table.rows[row];
  const ambulo__curved *curved = ambulo__row_curved_of(&f->table, r);
  double value = r->constant;
  if (curved) return ambulo__curved_value(curved, row_channel(f, r->node, 0), 1, NULL);
  for (int t = r->first_term; t < r->first_term + r->term_count; t++) {
    const ambulo__row_term *term = &f->table.terms[t];
    assert_true(term->node >= 0);
    value += term->coefficient * *row_channel(f, term->node, term->channel);
  }
  return value;
}

/* number of the only row with these labels; fails the test when there is none or two */
static inline int row_find(const row_fixture *f, const char *family, const char *subject,
                           const char *detail, double time) {
  int found = -1;
  for (int r = 0; r < f->table.row_count; r++) {
    const ambulo__table_row *row = &f->table.rows[r];
    if (strcmp(row->family, family) || strcmp(row->subject, subject)) continue;
    if (strcmp(row->detail, detail) || fabs(row->time - time) > 1e-12) continue;
    if (found >= 0) print_error("two rows %s %s %s at %g s\n", family, subject, detail, time);
    assert_int_equal(found, -1);
    found = r;
  }
  if (found < 0) print_error("no row %s %s %s at %g s\n", family, subject, detail, time);
  assert_true(found >= 0);
  return found;
}

/* the status, and a first message that contains `text` */
static inline void expect_message(const ambulo_diagnostics *list, const char *text) {
  assert_true(ambulo_diagnostics_count(list) > 0);
  const char *message = ambulo_diagnostics_get(list, 0)->message;
  if (!strstr(message, text)) print_error("got '%s', expected '%s'\n", message, text);
  assert_non_null(strstr(message, text));
}

#endif
