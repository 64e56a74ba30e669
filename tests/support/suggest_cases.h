/* support/suggest_cases.h - rows that are missed by a known amount, and what is suggested for them.
 */
#ifndef AMBULO_TEST_SUGGEST_CASES_H
#define AMBULO_TEST_SUGGEST_CASES_H

#include "ambulo/tools/tools.h"
#include "solver/explain.h"
#include "support/engine_fixture.h"
#include "support/test.h"

static const char WALK[] = "tests/support/walk_rigid.yaml";

typedef struct miss {
  const char *file;
  const char *overrides[3]; /* of the problem that is missed */
  const char *family, *subject, *detail;
  double value;       /* of the last row of these labels */
  const char *phrase; /* in the sentence */
  const char *setting[3];
  int elsewhere; /* 1: the bound is not the row's constant */
} miss;

static inline ambulo_problem *load(const char *file, const char *const *overrides, int count) {
  ambulo_problem *problem = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  if (ambulo_problem_load(file, overrides, count, NULL, list, &problem)) {
    char text[600];
    ambulo_diagnostics_format(list, 0, text, sizeof text);
    for (int i = 0; i < count; i++) print_error("--set '%s' ", overrides[i]);
    print_error("%s\n", text);
  }
  ambulo_diagnostics_free(list);
  return problem;
}

/* the last row of the labels, at node `node` or any */
static inline int find_row(const ambulo_problem *p, const miss *m, int node) {
  int found = -1;
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    if (!strcmp(row->family, m->family) && !strcmp(row->subject, m->subject) &&
        !strcmp(row->detail, m->detail) && (node < -1 || row->node == node))
      found = r;
  }
  return found;
}

static inline ambulo__explanation *suggest(const ambulo_problem *p, int row, double value) {
  ambulo__explanation *out = calloc(1, sizeof *out);
  double *values = calloc((size_t)p->rows, sizeof *values);
  values[row] = value;
  ambulo__remedy remedy = {.conflict = 0, .row = row, .value = values, .single = 1};
  ambulo__suggest(p, &remedy, out);
  free(values);
  return out;
}

/* the settings are accepted, and the row's bound has moved by what it was missed by */
static inline void follow(const miss *m, const ambulo_problem *p, int row,
                          const ambulo__explanation *out) {
  const char *all[6] = {NULL};
  int count = 0;
  for (int i = 0; i < 3 && m->overrides[i]; i++) all[count++] = m->overrides[i];
  for (int i = 0; i < out->view.setting_count; i++) all[count++] = out->setting[i];
  ambulo_problem *cured = load(m->file, all, count);
  assert_non_null(cured);
  if (!m->elsewhere) {
    int again = find_row(cured, m, p->table.rows[row].node);
    assert_true(again >= 0);
    double moved = cured->table.rows[again].constant - p->table.rows[row].constant;
    double wanted = p->table.rows[row].relation == AMBULO_EQUAL ? fabs(moved) : moved;
    if (!(wanted >= fabs(m->value) * (1.0 - 1e-3)))
      print_error("%s %s %s moved by %g\n", m->family, m->subject, m->detail, moved);
    assert_true(wanted >= fabs(m->value) * (1.0 - 1e-3)); /* settings of ends have four figures */
    assert_true(wanted <= fabs(m->value) * 1.2);
  }
  ambulo_problem_free(cured);
}

/* the sentence, and the settings, no more */
static inline void expect_advice(const miss *m, const ambulo__explanation *out) {
  int settings = 0;
  if (!strstr(out->suggestion, m->phrase)) print_error("got '%s'\n", out->suggestion);
  assert_non_null(strstr(out->suggestion, m->phrase));
  while (settings < 3 && m->setting[settings]) settings++;
  if (out->view.setting_count != settings) print_error("of '%s'\n", out->suggestion);
  assert_int_equal(out->view.setting_count, settings);
  for (int k = 0; k < settings; k++) {
    int same = !strncmp(out->setting[k], m->setting[k], strlen(m->setting[k]));
    if (!same) print_error("got '%s'; expected '%s'\n", out->setting[k], m->setting[k]);
    assert_true(same);
    assert_ptr_equal(out->settings[k], out->setting[k]);
  }
}

/* the same for the row at one node; the problem may have been changed since it was read */
static inline void expect_at(const ambulo_problem *p, const miss *m, int node) {
  int row = find_row(p, m, node);
  assert_true(row >= 0);
  ambulo__explanation *out = suggest(p, row, m->value);
  expect_advice(m, out);
  free(out);
}

/* each miss: the sentence, the settings, and what becomes of the row with them */
static inline void try_misses(const miss *misses, int count) {
  for (int i = 0; i < count; i++) {
    const miss *m = &misses[i];
    int overrides = 0;
    while (overrides < 3 && m->overrides[overrides]) overrides++;
    ambulo_problem *p = load(m->file, m->overrides, overrides);
    assert_non_null(p);
    int row = find_row(p, m, -2);
    if (row < 0) print_error("no %s %s %s in %s\n", m->family, m->subject, m->detail, m->file);
    assert_true(row >= 0);
    ambulo__explanation *out = suggest(p, row, m->value);
    expect_advice(m, out);
    if (m->setting[0]) follow(m, p, row, out);
    free(out);
    ambulo_problem_free(p);
  }
}

/* a problem made from C has no keys: the sentence alone */
static inline void try_without_keys(const miss *misses, int count) {
  ambulo_problem *p = load(WALK, NULL, 0);
  memset(&p->keys, 0, sizeof p->keys);
  for (int i = 0; i < count; i++) {
    if (misses[i].file != WALK || misses[i].overrides[0]) continue;
    int row = find_row(p, &misses[i], -2);
    assert_true(row >= 0);
    ambulo__explanation *out = suggest(p, row, misses[i].value);
    assert_int_equal(out->view.setting_count, 0);
    assert_non_null(strstr(out->suggestion, misses[i].phrase));
    free(out);
  }
  ambulo_problem_free(p);
}

#endif
