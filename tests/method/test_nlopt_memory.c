/* Solves while malloc itself runs out, in NLopt too: E_MEMORY with a message, or the point that is
 * found with all memory; never a crash.
 *
 * This program brings its own malloc, which keeps the bytes in use within a budget once it is
 * armed: what has been freed can be had again, as from the system's. NLopt 2.7.1's nlopt_copy does
 * not look at what malloc returns, and its L-BFGS goes on without its steps: ambulo__nlopt_can_copy
 * and ambulo__nlopt_can_descend keep them from being called in vain. */
#include "method/mirror.h"
#include "support/engine_fixture.h"
#include "support/test.h"

#include <nlopt.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__SANITIZE_ADDRESS__)
#define OWN_MALLOC 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define OWN_MALLOC 0
#endif
#endif
#if !defined(OWN_MALLOC) && defined(__GLIBC__)
#define OWN_MALLOC 1
#elif !defined(OWN_MALLOC)
#define OWN_MALLOC 0
#endif

#if OWN_MALLOC
#include <malloc.h>

/* for the shared libraries too */
#define EVERYWHERE __attribute__((visibility("default")))

extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *pointer, size_t size);
extern void __libc_free(void *pointer);

static int armed, refused;
static long long in_use, budget;

static int allowed(size_t size) {
  if (!armed || in_use + (long long)size <= budget) return 1;
  refused = 1;
  return 0;
}

EVERYWHERE void *malloc(size_t size) {
  if (!allowed(size)) return NULL;
  void *block = __libc_malloc(size);
  if (armed && block) in_use += (long long)malloc_usable_size(block);
  return block;
}

EVERYWHERE void *calloc(size_t count, size_t size) {
  if (size && count > SIZE_MAX / size) return NULL;
  if (!allowed(count * size)) return NULL;
  void *block = __libc_calloc(count, size);
  if (armed && block) in_use += (long long)malloc_usable_size(block);
  return block;
}

EVERYWHERE void *realloc(void *pointer, size_t size) {
  long long before = pointer ? (long long)malloc_usable_size(pointer) : 0;
  if ((long long)size > before && !allowed(size)) return NULL;
  void *block = __libc_realloc(pointer, size);
  if (armed && block) in_use += (long long)malloc_usable_size(block) - before;
  if (armed && !block && size == 0) in_use -= before;
  return block;
}

EVERYWHERE void free(void *pointer) {
  if (armed && pointer) in_use -= (long long)malloc_usable_size(pointer);
  __libc_free(pointer);
}

static void arm(long long bytes) {
  in_use = 0;
  refused = 0;
  budget = bytes;
  armed = 1;
}

static long long disarm(void) {
  armed = 0;
  return in_use;
}

/* ------------------------------------------------------------------------ solves */

/* a point found goes to `x` where that is empty, and is compared with it where it is not */
static ambulo_status solve(const ambulo_problem *problem, const ambulo_options *options,
                           ambulo_diagnostics *list, double **x) {
  ambulo_result *result = NULL;
  ambulo_status status = ambulo_solve(problem, options, NULL, NULL, list, &result);
  armed = 0;
  size_t size = (size_t)ambulo_problem_variable_count(problem) * sizeof **x;
  if (status == AMBULO_OK && !*x) {
    *x = malloc(size);
    assert_non_null(*x);
    memcpy(*x, ambulo_result_x(result), size);
  }
  if (status == AMBULO_OK) assert_memory_equal(*x, ambulo_result_x(result), size);
  ambulo_result_free(result);
  return status;
}

/* budgets from next to nothing up to enough, in small steps */
static void starve(const char *name, ambulo_algorithm algorithm, int intervals) {
  char override[40];
  (void)snprintf(override, sizeof override, "time.intervals=%d", intervals);
  ambulo_problem *problem = load_problem_with(name, override);
  ambulo_options options = ambulo_problem_options(problem);
  options.algorithm = algorithm;
  options.maximum_iterations = 2;
  double *x = NULL;
  assert_int_equal(solve(problem, &options, NULL, &x), AMBULO_OK);
  int failures = 0, enough = 0;
  for (long long bytes = 1000; !enough; bytes += bytes / 60 + 200) {
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    arm(bytes);
    ambulo_status status = solve(problem, &options, list, &x);
    if (status == AMBULO_OK && !refused) enough = 1;
    if (status == AMBULO_E_MEMORY) {
      failures++;
      assert_true(refused);
      assert_true(ambulo_diagnostics_count(list) > 0);
      assert_int_equal(ambulo_diagnostics_get(list, ambulo_diagnostics_count(list) - 1)->status,
                       AMBULO_E_MEMORY);
    } else if (status != AMBULO_OK) {
      char text[400];
      ambulo_diagnostics_format(list, 0, text, sizeof text);
      print_error("%s in %lld bytes: %s\n", name, bytes, text);
      fail();
    }
    ambulo_diagnostics_free(list);
  }
  assert_true(failures > 50);
  free(x);
  ambulo_problem_free(problem);
}

static void the_pipeline_runs_out_of_memory(void **state) {
  (void)state;
  starve("support/walker_2d_step", AMBULO_AUTO, 12);
}

static void small_problems_run_out_of_memory(void **state) {
  (void)state;
  starve("support/two_link_reach", AMBULO_AUTO, 20);
  starve("support/two_link_reach", AMBULO_SLSQP, 20);
  starve("support/two_link_reach", AMBULO_AUGLAG, 20);
}

typedef struct famine {
  int from, to; /* iterations */
  long long bytes;
} famine;

static int starve_between(void *user, const ambulo_progress *progress) {
  const famine *f = user;
  if (progress->iteration == f->from) arm(f->bytes);
  if (progress->iteration == f->to) armed = 0;
  return 0;
}

/* L-BFGS without room for its steps would find another point */
static void a_short_famine_ends_a_solve_or_changes_nothing(void **state) {
  (void)state;
  famine f = {-1, -1, 0};
  ambulo_problem *problem = load_problem_with("support/two_link_reach", "time.intervals=20");
  ambulo_options options = ambulo_problem_options(problem);
  options.algorithm = AMBULO_AUGLAG;
  options.maximum_iterations = 8;
  options.progress = starve_between;
  options.user = &f;
  double *x = NULL;
  int seen[2] = {0, 0};
  assert_int_equal(solve(problem, &options, NULL, &x), AMBULO_OK);
  f.from = 2, f.to = 4;
  for (f.bytes = 0; f.bytes < 60000; f.bytes += 500) {
    ambulo_status status = solve(problem, &options, NULL, &x);
    assert_true(status == AMBULO_OK || status == AMBULO_E_MEMORY);
    seen[status == AMBULO_OK]++;
  }
  assert_true(seen[0] > 10 && seen[1] > 10);
  free(x);
  ambulo_problem_free(problem);
}

/* whatever passes the question can be copied, and what is asked for is little more */
static void what_is_promised_is_there(void **state) {
  (void)state;
  for (unsigned n = 1; n < 3000; n += 1 + n / 2) {
    long long copy = 3LL * (long long)(n * sizeof(double)), most = copy + 5 * 4096;
    int answers[2] = {0, 0};
    for (long long bytes = 0; bytes <= most; bytes += most / 64 + 1) {
      nlopt_opt local = nlopt_create(NLOPT_LD_LBFGS, n), outer = nlopt_create(NLOPT_AUGLAG, n);
      arm(bytes);
      int can = ambulo__nlopt_can_copy(n);
      assert_true(in_use == 0);
      int copied = can && nlopt_set_local_optimizer(outer, local) >= 0;
      (void)disarm();
      assert_true(can || refused);
      assert_int_equal(copied, can);
      answers[can]++;
      nlopt_destroy(outer);
      nlopt_destroy(local);
    }
    assert_true(answers[0] > 0 && answers[1] > 0);
  }
}
#endif

static void nothing_is_left_to_test(void **state) {
  (void)state;
  if (!OWN_MALLOC) skip();
}

int main(void) {
  const struct CMUnitTest tests[] = {
#if OWN_MALLOC
    cmocka_unit_test(what_is_promised_is_there),
    cmocka_unit_test(a_short_famine_ends_a_solve_or_changes_nothing),
    cmocka_unit_test(small_problems_run_out_of_memory),
    cmocka_unit_test(the_pipeline_runs_out_of_memory),
#endif
    cmocka_unit_test(nothing_is_left_to_test)
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
