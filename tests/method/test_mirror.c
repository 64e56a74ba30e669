/* The mirror is NLopt's own update: beside what NLopt prints of itself, on a small problem whose
 * rows come and go. */
#define _GNU_SOURCE /* dlsym's RTLD_DEFAULT */
#include "method/mirror.h"
#include "support/test.h"

#include <dlfcn.h>
#include <math.h>
#include <nlopt.h>
#include <unistd.h>

enum { ROWS = 3, MOST = 60 };

typedef struct watched {
  ambulo__mirror mirror;
  int bare;
  char line[MOST][160];
  int lines;
} watched;

/* c_i(x) <= 0: a circle, a line that is slack at the end, a hyperbola */
static void rows_at(const double *x, double *c) {
  c[0] = x[0] * x[0] + x[1] * x[1] - 2.0;
  c[1] = x[0] - 3.0;
  c[2] = 0.5 - x[0] * x[1];
}

static void note(watched *w, const char *format, double a, double b, double c) {
  assert_true(w->lines < MOST);
  (void)snprintf(w->line[w->lines++], sizeof w->line[0], format, a, b, c);
}

static double objective(unsigned n, const double *x, double *gradient, void *data) {
  watched *w = data;
  double value = (x[0] - 3.0) * (x[0] - 3.0) + 2.0 * (x[1] - 2.0) * (x[1] - 2.0), c[ROWS];
  (void)n;
  if (gradient) {
    gradient[0] = 2.0 * (x[0] - 3.0);
    gradient[1] = 4.0 * (x[1] - 2.0);
    return value;
  }
  rows_at(x, c);
  if (w->bare++ == 0) {
    ambulo__mirror_start(&w->mirror, value, c);
    note(w, "rho=%g", w->mirror.penalty, 0.0, 0.0);
  } else {
    (void)ambulo__mirror_update(&w->mirror, c);
    note(w, "ICM=%g rho=%g", w->mirror.measure, w->mirror.penalty, 0.0);
    note(w, "mu =  %g %g %g", w->mirror.multiplier[0], w->mirror.multiplier[1],
         w->mirror.multiplier[2]);
  }
  return value;
}

static void rows(unsigned m, double *c, unsigned n, const double *x, double *gradient, void *data) {
  (void)m, (void)n, (void)data;
  rows_at(x, c);
  if (!gradient) return;
  const double slope[2 * ROWS] = {2.0 * x[0], 2.0 * x[1], 1.0, 0.0, -x[1], -x[0]};
  memcpy(gradient, slope, sizeof slope);
}

/* what AUGLAG prints while it runs, into text */
static size_t run_and_listen(watched *w, char *text, size_t size) {
  int *verbose = dlsym(RTLD_DEFAULT, "auglag_verbose");
  if (!verbose) skip(); /* an NLopt that keeps it to itself */
  double x[2] = {0.1, 4.0}, least, tolerance[ROWS] = {0.0};
  FILE *file = tmpfile();
  nlopt_opt opt = nlopt_create(NLOPT_AUGLAG, 2), local = nlopt_create(NLOPT_LD_LBFGS, 2);
  assert_true(file && opt && local);
  nlopt_set_maxeval(local, 4);
  nlopt_set_local_optimizer(opt, local);
  nlopt_set_min_objective(opt, objective, w);
  nlopt_add_inequality_mconstraint(opt, ROWS, rows, NULL, tolerance);
  nlopt_set_maxeval(opt, 120);
  (void)fflush(stdout);
  int kept = dup(STDOUT_FILENO);
  assert_true(dup2(fileno(file), STDOUT_FILENO) >= 0);
  *verbose = 1;
  (void)nlopt_optimize(opt, x, &least);
  *verbose = 0;
  (void)fflush(stdout);
  assert_true(dup2(kept, STDOUT_FILENO) >= 0);
  (void)close(kept);
  rewind(file);
  size_t length = fread(text, 1, size - 1, file);
  text[length] = '\0';
  (void)fclose(file);
  nlopt_destroy(local);
  nlopt_destroy(opt);
  return length;
}

static void update_is_nlopts(void **state) {
  (void)state;
  static char text[65536];
  ambulo__pool pool;
  watched w = {.bare = 0};
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__mirror_create(ROWS, &pool, &w.mirror), AMBULO_OK);
  assert_true(run_and_listen(&w, text, sizeof text) > 0);
  assert_true(w.mirror.updates >= 8);
  const char *at = text;
  for (int i = 0; i < w.lines; i++) { /* in this order */
    char first[160], *rest = strstr(strcpy(first, w.line[i]), " rho=");
    if (rest) *rest = '\0';
    const char *found = strstr(at, first);
    if (!found) print_error("'%s' is not in\n%s\n", first, at);
    assert_non_null(found);
    at = found + strlen(first);
    assert_true(*at == '\n' || *at == ' ' || *at == ',');
    if (!rest) continue;
    char number[80];
    (void)snprintf(number, sizeof number, "%s\n", strstr(w.line[i], "rho="));
    found = strstr(at, number);
    assert_non_null(found);
    at = found;
  }
  ambulo__pool_clear(&pool);
}

/* a violation of nothing by f = 0 has no rho, as in NLopt */
static void penalty_starts_as_in_the_paper(void **state) {
  (void)state;
  ambulo__pool pool;
  ambulo__mirror m;
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__mirror_create(2, &pool, &m), AMBULO_OK);
  const double out[2] = {0.5, -3.0}, in[2] = {-1.0, -2.0};
  ambulo__mirror_start(&m, 0.0, out);
  assert_true(m.penalty == 1e-6);
  ambulo__mirror_start(&m, -0.25, out);
  assert_close(m.penalty, 2.0, 1e-15);
  ambulo__mirror_start(&m, 1.0, in);
  assert_true(m.penalty == 10.0);
  ambulo__mirror_start(&m, 0.0, in);
  assert_true(isnan(m.penalty));
  ambulo__pool_clear(&pool);
}

static void its_bounds_are_nlopts(void **state) {
  (void)state;
  ambulo__pool pool;
  ambulo__mirror none, one;
  double row[] = {1e30};
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__mirror_create(0, &pool, &none), AMBULO_OK);
  assert_int_equal(ambulo__mirror_create(1, &pool, &one), AMBULO_OK);
  ambulo__mirror_start(&none, 5.0, row);
  assert_true(none.penalty == 1.0);
  ambulo__mirror_start(&one, 5.0, row);
  assert_true(one.penalty == 1e-6);
  (void)ambulo__mirror_update(&one, row);
  assert_true(one.multiplier[0] == 1e20);
  ambulo__pool_clear(&pool);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(update_is_nlopts),
                                     cmocka_unit_test(penalty_starts_as_in_the_paper),
                                     cmocka_unit_test(its_bounds_are_nlopts)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
