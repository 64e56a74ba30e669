/* The seeds of all targets (tests/fuzz/seeds/TARGET), and some texts near them: what `make fuzz`
 * looks for in earnest, for a moment in every `make check`. FUZZ_NEAR: how many near each. */
#include "mutate.h"
#include "targets.h"

enum { NEAR = 40, MOST = 1 << 16 };

static int near_each(void) {
  const char *text = getenv("FUZZ_NEAR");
  return text ? atoi(text) : NEAR;
}

/* FUZZ_LAST: a file that is to hold what is read, so that it is there after a fault */
static void keep(const uint8_t *data, size_t size) {
  const char *path = getenv("FUZZ_LAST");
  FILE *file = path ? fopen(path, "wb") : NULL;
  if (!file) return;
  (void)fwrite(data, 1, size, file);
  (void)fclose(file);
}

static void run_seed(const fuzz_target *target, const char *path) {
  static uint8_t data[MOST];
  char *text = NULL;
  FILE *file = fopen(path, "rb");
  assert_non_null(file);
  size_t length = fread(data, 1, sizeof data, file);
  assert_int_equal(fclose(file), 0);
  text = malloc(length + 1);
  assert_non_null(text);
  memcpy(text, data, length);
  fuzz_last = path;
  fuzz_near = -1;
  fuzz_run(target, data, length);
  for (int k = 0; k < near_each(); k++) {
    uint32_t state = 1U + 7919U * (uint32_t)k;
    memcpy(data, text, length);
    size_t size = mutate(data, length, sizeof data, &state);
    uint8_t *exact = malloc(size + 1); /* so that a byte too far is seen */
    assert_non_null(exact);
    memcpy(exact, data, size);
    fuzz_last = path;
    fuzz_near = k;
    keep(exact, size);
    fuzz_run(target, exact, size);
    free(exact);
  }
  free(text);
}

static void run_seeds(const fuzz_target *target) {
  char folder[200], path[500];
  (void)snprintf(folder, sizeof folder, "tests/fuzz/seeds/%s", target->name);
  DIR *stream = opendir(folder);
  if (!stream) print_error("%s is not there\n", folder);
  assert_non_null(stream);
  int count = 0;
  if (target->open) target->open();
  for (struct dirent *e = readdir(stream); e; e = readdir(stream)) {
    if (e->d_name[0] == '.') continue;
    (void)snprintf(path, sizeof path, "%s/%s", folder, e->d_name);
    run_seed(target, path);
    count++;
  }
  assert_int_equal(closedir(stream), 0);
  assert_true(count > 0);
}

static void every_target(void **state) {
  (void)state;
  const char *only = getenv("FUZZ_ONLY");
  for (int i = 0; i < FUZZ_TARGETS; i++) {
    if (only && strcmp(only, fuzz_targets[i].name) != 0) continue;
    assert_int_equal(scratch_open(&fuzz_state), 0);
    run_seeds(&fuzz_targets[i]);
    assert_int_equal(scratch_close(&fuzz_state), 0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_target)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
