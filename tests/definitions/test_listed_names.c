/* Every number that the list of sensitivities may name, of every shipped problem: --set takes the
 * name as it is printed, and the number's own value leaves the problem as it was. */
#include "ambulo/tools/load.h"
#include "problem/nlp.h"
#include "solver/sensitivity.h"
#include "support/test.h"

#include <dirent.h>
#include <stdio.h>
#include <string.h>

enum { MOST = 16, TEXT = 512 };

typedef struct sets {
  char text[MOST][TEXT];
  const char *pointer[MOST];
  int count;
} sets;

static void add(sets *s, const char *name, size_t length, double value) {
  (void)snprintf(s->text[s->count], TEXT, "%.*s=%.17g", (int)length, name, value);
  s->pointer[s->count] = s->text[s->count];
  s->count++;
}

static void fill(sets *s, const ambulo__parameter *p, double value) {
  s->count = 0;
  add(s, p->name, strlen(p->name), value);
  for (const char *at = p->with; *at;) {
    size_t length = strcspn(at, ",");
    add(s, at, length, p->with_sign * value);
    at += length;
    at += strspn(at, ", ");
  }
}

static ambulo_problem *load(const char *path, const sets *s, char *why) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem *p = NULL;
  ambulo_status status = ambulo_problem_load(path, s ? s->pointer : NULL, s ? s->count : 0, NULL, list, &p);
  if (status) snprintf(why, TEXT, "%s", ambulo_diagnostics_get(list, 0)->message);
  ambulo_diagnostics_free(list);
  return p;
}

static void look(const char *path) {
  char why[TEXT];
  ambulo_problem *p = load(path, NULL, why);
  if (!p) { printf("%s: %s\n", path, why); return; }
  ambulo__parameters known;
  assert_int_equal(ambulo__parameters_init(p, NULL, &known), AMBULO_OK);
  int refused = 0, other = 0;
  for (int k = 0; k < known.count; k++) {
    const ambulo__parameter *n = &known.list[k];
    double unit = ambulo__parameter_unit(p, n);
    sets s;
    fill(&s, n, unit == 0.0 ? n->value : n->value / unit);
    ambulo_problem *q = load(path, &s, why);
    if (!q) {
      printf("%s: %s: %s\n", path, s.text[0], why);
      refused++;
      continue;
    }
    if (unit != 0.0 && ambulo_problem_hash(q) != ambulo_problem_hash(p)) {
      ambulo__parameters now;
      assert_int_equal(ambulo__parameters_init(q, NULL, &now), AMBULO_OK);
      double worst = now.count == known.count ? 0 : 1e9;
      const char *who = "count";
      for (int i = 0; i < now.count && now.count == known.count; i++) {
        double d = fabs(now.list[i].value - known.list[i].value) / (1e-3 + fabs(known.list[i].value));
        if (d > worst) { worst = d; who = now.list[i].name; }
      }
      if (worst > 1e-14) printf("%s: %s (value %.17g): other: %.3g at %s\n", path, s.text[0], n->value, worst, who), other++;
      ambulo__parameters_clear(&now);
    }
    ambulo_problem_free(q);
  }
  printf("%s: %d numbers, %d refused, %d other\n", path, known.count, refused, other);
  ambulo__parameters_clear(&known);
  ambulo_problem_free(p);
}

static void every_listed_name_can_be_set(void **state) {
  (void)state;
  DIR *folder = opendir("models");
  assert_non_null(folder);
  for (struct dirent *e; (e = readdir(folder));) {
    char path[TEXT];
    size_t length = strlen(e->d_name);
    if (length < 6 || strcmp(e->d_name + length - 5, ".yaml") != 0) continue;
    (void)snprintf(path, sizeof path, "models/%s", e->d_name);
    ambulo_file_kind kind;
    if (ambulo_file_kind_of(path, NULL, NULL, &kind) || kind != AMBULO_FILE_PROBLEM) continue;
    look(path);
  }
  closedir(folder);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_listed_name_can_be_set)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
