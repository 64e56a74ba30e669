/* Commands whose every request for memory fails from the k-th on, wherever it is made, in libraries
 * too: exit code 5 and "error[E_MEMORY]", or all of the output. malloc() of this program fails;
 * that is done with the GNU C library, and not below a sanitizer, which has its own. */
#include "cli/command.h"
#include "cli/output.h"
#include "support/fake_batch.h"

static struct { long at, count; /* at < 0: none fails */ } fault = {-1, 0};

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
enum { CAN_FAIL = 1 };

extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *pointer, size_t size);

static int fails(void) {
  return fault.at >= 0 && fault.count++ >= fault.at;
}

/* seen by the libraries that this program is linked with */
#define SEEN __attribute__((visibility("default")))
SEEN void *malloc(size_t size) {
  return fails() ? NULL : __libc_malloc(size);
}
SEEN void *calloc(size_t count, size_t size) {
  return fails() ? NULL : __libc_calloc(count, size);
}
SEEN void *realloc(void *pointer, size_t size) {
  return size > 0 && fails() ? NULL : __libc_realloc(pointer, size);
}
#else
enum { CAN_FAIL = 0 };
#endif

static char out[SCRATCH_PATH + 8], err[SCRATCH_PATH + 8];

/* runs a command with its streams in files; the exit code, as main() would return it */
static int run(const ambulo__cli_command *command, int argc, const char *const *words, long at,
               int *failed) {
  char *argv[8];
  for (int i = 0; i < argc; i++) argv[i] = (char *)(uintptr_t)words[i];
  argv[argc] = NULL;
  fflush(stdout);
  fflush(stderr);
  int kept[2] = {dup(1), dup(2)}, files[2];
  files[0] = open(out, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  files[1] = open(err, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  for (int i = 0; i < 2; i++) (void)dup2(files[i], i + 1);
  fault.at = at;
  fault.count = 0;
  int code = ambulo__cli_run(command, argc, argv);
  fflush(stdout);
  *failed = at >= 0 && fault.count > at;
  fault.at = -1;
  for (int i = 0; i < 2; i++) {
    (void)dup2(kept[i], i + 1);
    close(kept[i]);
    close(files[i]);
  }
  return code;
}

static void try_all(void **state, const ambulo__cli_command *command, int argc,
                    const char *const *words) {
  int failed = 0, short_of_it = 0;
  (void)snprintf(out, sizeof out, "%s/out", (const char *)*state);
  (void)snprintf(err, sizeof err, "%s/err", (const char *)*state);
  assert_int_equal(run(command, argc, words, -1, &failed), 0);
  char *good = read_whole(out), *warned = read_whole(err);
  failed = CAN_FAIL;
  for (long k = 0; failed; k++) {
    int code = run(command, argc, words, k, &failed);
    char *said = read_whole(out), *told = read_whole(err);
    int right = code == 0 ? strcmp(said, good) == 0 && strcmp(told, warned) == 0
                          : code == 5 && strstr(told, "error[E_MEMORY]");
    if (!right) print_error("%s, request %ld: exit code %d\n%s", words[1], k, code, told);
    assert_true(right);
    short_of_it += code == 5;
    free(said);
    free(told);
  }
  free(good);
  free(warned);
  print_message("%s: %d failures\n", words[1], short_of_it);
  assert_true(short_of_it > 50 || !CAN_FAIL);
}

static void reading(void **state) {
  static const char *const info[] = {"ambulo", "info", "models/pendulum.yaml"};
  static const char *const problem[] = {"ambulo", "info", "models/pendulum_swing.yaml"};
  static const char *const check[] = {"ambulo", "check", "models/pendulum_swing.yaml"};
  const char *const doubtful[] = {"ambulo", "check", scratch_path(state, "p.yaml")};
  scratch_write(scratch_path(state, "t.csv"), "time,swing\n0,-90\n1,90\n");
  scratch_write(doubtful[2],
                "ambulo: 1\nkind: problem\nname: p\nmodel: pendulum.yaml\nangles: radians\n"
                "time: {duration: 1, intervals: 4}\n"
                "objective: [{term: tracking, weight: 1, reference: t.csv}]\n");
  assert_int_equal(setenv("AMBULO_MODELS", "models", 1), 0);
  try_all(state, &ambulo__cli_info, 3, info);
  try_all(state, &ambulo__cli_info, 3, problem);
  try_all(state, &ambulo__cli_check, 3, check);
  try_all(state, &ambulo__cli_check, 3, doubtful);
}

static void batches(void **state) {
  fake_batch b;
  assert_int_equal(fake_batch_open(&b, state,
                                   "axes:\n  - {key: time.duration, name: T, values: [1, 2]}\n"
                                   "outputs: [objective, max(tau.pin)]\n"),
                   0);
  const char *const collect[] = {"ambulo", "collect", b.folder};
  const char *const verify[] = {"ambulo", "batch", "--verify", b.folder};
  const char *const status[] = {"ambulo", "batch", "--status", b.folder};
  try_all(state, &ambulo__cli_collect, 3, collect);
  try_all(state, &ambulo__cli_batch, 4, verify);
  try_all(state, &ambulo__cli_batch, 4, status);
  fake_batch_close(&b);
}
int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(reading, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(batches, scratch_open, scratch_close)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
