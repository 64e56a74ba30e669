/* Command lines: forms of options, refusals, numbers, nearest words. */
#include "cli/command.h"
#include "support/test.h"

#include <fcntl.h>
#include <unistd.h>

/* what the command saw */
static char seen[512];
static int want_number;

static int remember(const ambulo__cli_input *input) {
  int count;
  const char *const *values = ambulo__cli_values(input, "set", &count);
  const char *output = ambulo__cli_value(input, "output");
  double limit = -1.0;
  int samples = -1;
  if (!ambulo__cli_number(input, "limit", 0.0, 100.0, &limit)) return 2;
  if (!ambulo__cli_integer(input, "samples", 2, 50, &samples)) return 2;
  int used =
      snprintf(seen, sizeof seen, "%s %d", output ? output : "-", ambulo__cli_flag(input, "quiet"));
  if (want_number)
    used += snprintf(seen + used, sizeof seen - (size_t)used, " %g %d", limit, samples);
  for (int i = 0; i < count; i++)
    used += snprintf(seen + used, sizeof seen - (size_t)used, " [%s]", values[i]);
  for (int i = 0; i < input->argument_count; i++)
    used += snprintf(seen + used, sizeof seen - (size_t)used, " <%s>", input->arguments[i]);
  int root = ambulo__cli_choice(input, "root", -1);
  if (root >= 0) (void)snprintf(seen + used, sizeof seen - (size_t)used, " root %d", root);
  return 42;
}

static const ambulo__cli_option options[] = {
    {"output", 'o', "DIR", "where"},        {"set", 0, "path=value", "what"},
    {"limit", 0, "S", "how long"},          {"samples", 0, "n", "how many"},
    {"root", 0, "free|fixed|any", "which"}, {"quiet", 'q', NULL, "how loud"}};
static const ambulo__cli_command command = {.name = "test",
                                            .arguments = "FILE",
                                            .summary = "",
                                            .description = "",
                                            .example = "",
                                            .options = options,
                                            .option_count = 6,
                                            .minimum = 1,
                                            .maximum = 2,
                                            .run = remember};

/* runs "ambulo test <words>" with messages kept off the screen */
static int run(const char *words) {
  char line[512], *argv[32] = {(char *)"ambulo", (char *)"test"};
  int argc = 2;
  snprintf(line, sizeof line, "%s", words);
  for (char *word = strtok(line, " "); word; word = strtok(NULL, " ")) argv[argc++] = word;
  fflush(stderr);
  int kept = dup(2), nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, 2);
  seen[0] = '\0';
  int code = ambulo__cli_run(&command, argc, argv);
  fflush(stderr);
  dup2(kept, 2);
  close(kept);
  close(nowhere);
  return code;
}

static void expect(const char *words, const char *result) {
  int code = run(words);
  if (code != 42 || strcmp(seen, result) != 0)
    print_error("'%s' gave %d and '%s'\n", words, code, seen);
  assert_int_equal(code, 42);
  assert_string_equal(seen, result);
}

static void test_forms(void **state) {
  (void)state;
  want_number = 0;
  expect("a", "- 0 <a>");
  expect("a -o out", "out 0 <a>");
  expect("-oout a", "out 0 <a>");
  expect("--output=out a b -q", "out 1 <a> <b>");
  expect("--output x --output y a", "y 0 <a>");
  expect("--set p=1 a --set=q=2", "- 0 [p=1] [q=2] <a>");
  expect("-q --set p=1 a -o out --set=q=2 --limit 1 --set r=3", "out 1 [p=1] [q=2] [r=3] <a>");
  expect("a --root fixed", "- 0 <a> root 1");
  expect("a --root free --root any", "- 0 <a> root 2");
  expect("-- -o --quiet", "- 0 <-o> <--quiet>");
  expect("-", "- 0 <->");
}

static void test_refusals(void **state) {
  (void)state;
  static const char *const bad[] = {"",
                                    "a b c",
                                    "a --outpt x",
                                    "a -x",
                                    "a -o",
                                    "a --quiet=1",
                                    "a -qx",
                                    "a --limit x",
                                    "a --limit 1,5",
                                    "a --limit 0x10",
                                    "a --limit inf",
                                    "a --limit 101",
                                    "a --samples 1",
                                    "a --root loose",
                                    "a --root fre",
                                    "a --root free|fixed",
                                    "a --samples 2.5",
                                    "a --samples 99999999999999999999"};
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    int code = run(bad[i]);
    if (code != 2 || seen[0]) print_error("'%s' gave %d and '%s'\n", bad[i], code, seen);
    assert_int_equal(code, 2);
    assert_string_equal(seen, "");
  }
}

static void test_numbers(void **state) {
  (void)state;
  want_number = 1;
  expect("a", "- 0 -1 -1 <a>");
  expect("a --limit 1e1 --samples 50", "- 0 10 50 <a>");
  expect("a --limit .5", "- 0 0.5 -1 <a>");
}

static void test_nearest(void **state) {
  (void)state;
  static const char *const words[] = {"solve", "evaluate", "check"};
  assert_string_equal(ambulo__cli_nearest("slove", words, 3), "solve");
  assert_string_equal(ambulo__cli_nearest("chek", words, 3), "check");
  assert_null(ambulo__cli_nearest("batch-mode", words, 3));
  assert_null(ambulo__cli_nearest("", words, 3));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_forms), cmocka_unit_test(test_refusals),
                                     cmocka_unit_test(test_numbers),
                                     cmocka_unit_test(test_nearest)};
  return cmocka_run_group_tests_name("cli/args", tests, NULL, NULL);
}
