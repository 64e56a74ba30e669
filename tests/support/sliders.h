/* tests/support/sliders.h - masses on rails, one after the other, for one second on four intervals
 * with seven control points each. What is asked of them are rows of the caller that are linear in
 * the places, so that the least violations are known by hand. */
#ifndef AMBULO_TESTS_SLIDERS_H
#define AMBULO_TESTS_SLIDERS_H

#include "solver/explain.h"
#include "support/test.h"

enum { SLIDERS = 6, SLIDER_ROWS = 4, SLIDER_POINTS = 7 };

/* sum a_i q_i = value, or >= value, at one time or all of them */
typedef struct slider_row {
  const char *name;
  double from, to, value;
  double a[SLIDERS];
  int at_least;
} slider_row;

static inline double slider_row_value(void *user, const ambulo_node_state *s,
                                      ambulo_node_gradient *g) {
  const slider_row *row = user;
  double value = -row->value;
  for (int i = 0; i < SLIDERS; i++) {
    value += row->a[i] * s->q[i];
    if (g) g->q[i] += row->a[i];
  }
  return value;
}

typedef struct sliders {
  ambulo_model *model;
  ambulo_problem *problem;
  ambulo_workspace *workspace;
  ambulo_options options;
  ambulo__run run;
  ambulo__pool pool;
  ambulo__elastic elastic;
  ambulo__explanation out;
  ambulo__remedy remedy;
  slider_row row[SLIDER_ROWS];
  double *x;
} sliders;

/* the rows, up to the first without a name, of a definition that is then created and opened */
static inline void sliders_ask(sliders *s, ambulo_problem_definition *d, const slider_row *rows) {
  ambulo_user_row user[SLIDER_ROWS];
  int count = 0;
  for (; count < SLIDER_ROWS && rows[count].name; count++) {
    const slider_row *row = &rows[count];
    s->row[count] = *row;
    user[count] = (ambulo_user_row){.name = row->name,
                                    .unit = "m",
                                    .relation = row->at_least ? AMBULO_NOT_NEGATIVE : AMBULO_EQUAL,
                                    .from = row->from,
                                    .to = row->to,
                                    .function = slider_row_value,
                                    .user = &s->row[count]};
  }
  d->user_rows = user;
  d->user_row_count = count;
  assert_int_equal(ambulo_problem_create(d, NULL, NULL, &s->problem), AMBULO_OK);
  s->x = calloc((size_t)s->problem->variables, sizeof *s->x);
  s->options = ambulo_options_default();
  ambulo__run_begin(&s->run, &s->options);
  ambulo_allocator allocator = ambulo__allocator_or_default(NULL);
  ambulo__pool_init(&s->pool, &allocator);
  assert_int_equal(ambulo_workspace_create(s->problem, NULL, &s->workspace), AMBULO_OK);
  assert_int_equal(ambulo__evaluate(s->workspace, s->x), AMBULO_OK);
  assert_int_equal(ambulo__elastic_create(s->problem, s->workspace, &s->run, &s->pool, &s->elastic),
                   AMBULO_OK);
}

/* rows up to the first without a name; no place above `upper`, at the nodes (INFINITY: none).
 * `term`: an objective, or NULL */
static inline sliders *sliders_open(const slider_row *rows, double upper, const ambulo_term *term) {
  static const char *const names[SLIDERS] = {"s0", "s1", "s2", "s3", "s4", "s5"};
  ambulo_link links[SLIDERS];
  ambulo_coordinate coordinates[SLIDERS];
  sliders *s = calloc(1, sizeof *s);
  assert_non_null(s);
  for (int i = 0; i < SLIDERS; i++) {
    links[i] = ambulo_link_default();
    links[i].name = names[i];
    links[i].parent = i - 1;
    links[i].type = AMBULO_PRISMATIC;
    links[i].mass = 1.0;
    coordinates[i] = ambulo_coordinate_default();
    coordinates[i].name = names[i];
    coordinates[i].type = AMBULO_PRISMATIC;
    coordinates[i].range[1] = upper;
  }
  ambulo_model_definition m = ambulo_model_definition_default();
  m.name = "sliders";
  m.links = links;
  m.coordinates = coordinates;
  m.link_count = m.coordinate_count = SLIDERS;
  assert_int_equal(ambulo_model_create(&m, NULL, NULL, &s->model), AMBULO_OK);
  ambulo_problem_definition d = ambulo_problem_definition_default();
  d.model = s->model;
  d.intervals = 4;
  d.joint_limits = isfinite(upper) ? AMBULO_LIMIT_NODES : AMBULO_LIMIT_OFF;
  d.terms = term;
  d.term_count = term != NULL;
  sliders_ask(s, &d, rows);
  assert_int_equal(s->problem->variables, SLIDERS * SLIDER_POINTS);
  return s;
}

static inline void sliders_close(sliders *s) {
  ambulo__pool_clear(&s->pool);
  ambulo_workspace_free(s->workspace);
  ambulo_problem_free(s->problem);
  ambulo_model_free(s->model);
  free(s->x);
  free(s);
}

#endif
