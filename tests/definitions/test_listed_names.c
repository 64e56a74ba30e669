/* Every number that the list of sensitivities may name, of every shipped problem: --set takes its
 * name and its value in the file's unit, and the problem stays as it was. */
#include "ambulo/tools/load.h"
#include "problem/nlp.h"
#include "solver/sensitivity.h"
#include "support/test.h"

#include <dirent.h>

enum { MOST = 128, TEXT = 512, AT_ONCE = 16 };

/* "name=value" of numbers and of those that move along */
typedef struct settings {
  char text[MOST][TEXT];
  const char *pointer[MOST];
  int count;
} settings;

static void add(settings *s, const char *name, size_t length, double value) {
  assert_true(s->count < MOST);
  (void)snprintf(s->text[s->count], TEXT, "%.*s=%.17g", (int)length, name, value);
  s->pointer[s->count] = s->text[s->count];
  s->count++;
}

static void add_number(settings *s, const ambulo__parameter *p, double value) {
  add(s, p->name, strlen(p->name), value);
  for (const char *at = p->with; *at;) {
    size_t length = strcspn(at, ",");
    add(s, at, length, p->with_sign * value);
    at += length;
    at += strspn(at, ", ");
  }
}

/* NULL: refused, which is said */
static ambulo_problem *load(const char *path, const settings *s) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem *p = NULL;
  if (ambulo_problem_load(path, s ? s->pointer : NULL, s ? s->count : 0, NULL, list, &p))
    print_error("%s --set %s: %s\n", path, s ? s->text[0] : "",
                ambulo_diagnostics_get(list, 0)->message);
  ambulo_diagnostics_free(list);
  return p;
}

/* how far a number is off what it was, in parts of it */
static double change_of(const ambulo__parameters *before, const ambulo_problem *now) {
  ambulo__parameters known;
  double worst = 0.0;
  assert_int_equal(ambulo__parameters_init(now, NULL, &known), AMBULO_OK);
  if (known.count != before->count) worst = HUGE_VAL;
  for (int i = 0; i < known.count && known.count == before->count; i++) {
    double was = before->list[i].value;
    worst = fmax(worst, fabs(known.list[i].value - was) / (fabs(was) + 1e-3));
  }
  ambulo__parameters_clear(&known);
  return worst;
}

/* how many names are refused, or change the problem */
static int faults_of(const char *path) {
  ambulo_problem *p = load(path, NULL);
  ambulo__parameters known;
  settings s;
  int faults = 0;
  assert_non_null(p);
  assert_int_equal(ambulo__parameters_init(p, NULL, &known), AMBULO_OK);
  assert_true(known.count > 0);
  int groups = (known.count + AT_ONCE - 1) / AT_ONCE;
  for (int g = 0; g < groups; g++) { /* neighbours apart: one may make the way of the next */
    s.count = 0;
    for (int k = g; k < known.count; k += groups)
      add_number(&s, &known.list[k],
                 known.list[k].value / ambulo__parameter_unit(p, &known.list[k]));
    ambulo_problem *q = load(path, &s);
    int same =
        q && (ambulo_problem_hash(q) == ambulo_problem_hash(p) || change_of(&known, q) <= 1e-14);
    if (q && !same) print_error("%s --set %s ...: another problem\n", path, s.text[0]);
    faults += !same;
    ambulo_problem_free(q);
  }
  ambulo__parameters_clear(&known);
  ambulo_problem_free(p);
  return faults;
}

static void every_listed_name_can_be_set(void **state) {
  (void)state;
  DIR *folder = opendir("models");
  int problems = 0, faults = 0;
  assert_non_null(folder);
  for (struct dirent *e; (e = readdir(folder));) {
    char path[TEXT];
    ambulo_file_kind kind;
    size_t length = strlen(e->d_name);
    if (length < 6 || strcmp(e->d_name + length - 5, ".yaml") != 0) continue;
    (void)snprintf(path, sizeof path, "models/%s", e->d_name);
    if (ambulo_file_kind_of(path, NULL, NULL, &kind) || kind != AMBULO_FILE_PROBLEM) continue;
    faults += faults_of(path);
    problems++;
  }
  closedir(folder);
  assert_true(problems > 40);
  assert_int_equal(faults, 0);
}

/* one number of a row, one coordinate of a scale for all, in files that have no such key */
static void what_a_file_leaves_at_its_default(void **state) {
  (void)state;
  static const struct {
    const char *before, *set, *name;
    double value;
  } cases[] = {
      {"time.duration=2", "objective[torque_squared].scale.swing=3",
       "objective[torque_squared].scale.swing", 3.0},
      {"objective[torque_squared].scale=2", "objective[torque_squared].scale.swing=3",
       "objective[torque_squared].scale.swing", 3.0},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    settings s = {.pointer = {cases[i].before, cases[i].set}, .count = 2};
    ambulo_problem *p = load("models/pendulum_swing.yaml", &s);
    ambulo__parameters known;
    assert_non_null(p);
    assert_int_equal(ambulo__parameters_init(p, NULL, &known), AMBULO_OK);
    const ambulo__parameter *n = ambulo__parameters_find(&known, cases[i].name);
    assert_non_null(n);
    assert_close(n->value, cases[i].value, 0.0);
    ambulo__parameters_clear(&known);
    ambulo_problem_free(p);
  }
  settings s = {.pointer = {"ground_reaction.pressure=on", "ground_reaction.pressure.arc=0.002"},
                .count = 2};
  ambulo_problem *p = load("models/walk.yaml", NULL), *q = load("models/walk.yaml", &s);
  assert_non_null(p);
  assert_non_null(q);
  const ambulo_ground_reaction *was = &p->definition.ground_reaction,
                               *now = &q->definition.ground_reaction;
  assert_close(now->arc_pressure, 0.002, 1e-15);
  assert_true(was->arc_pressure != now->arc_pressure && now->pressure && was->pressure);
  ambulo_problem_free(p);
  ambulo_problem_free(q);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_listed_name_can_be_set),
                                     cmocka_unit_test(what_a_file_leaves_at_its_default)};
  return cmocka_run_group_tests_name("definitions/listed_names", tests, NULL, NULL);
}
