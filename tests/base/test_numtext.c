#include "base/numtext.h"
#include "support/test.h"

#include <float.h>
#include <locale.h>
#include <stdio.h>

static uint64_t next_random(uint64_t *seed) {
  *seed ^= *seed << 13;
  *seed ^= *seed >> 7;
  *seed ^= *seed << 17;
  return *seed;
}

static void expect_round_trip(double value) {
  const ambulo__number number = ambulo__number_text(value);
  const char *text = number.text;
  double back = 0.0;
  assert_non_null(memchr(text, '\0', sizeof number.text));
  if (!ambulo__parse_double(text, strlen(text), &back) || memcmp(&back, &value, sizeof back) != 0) {
    print_error("%a prints as '%s', which reads as %a\n", value, text, back);
    fail();
  }
}

static void any_double_survives(void **state) {
  (void)state;
  uint64_t seed = 88172645463325252ULL;
  for (int i = 0; i < 20000; i++) {
    uint64_t bits = next_random(&seed);
    double value;
    memcpy(&value, &bits, sizeof value);
    if (isfinite(value)) expect_round_trip(value);
    bits &= 0x800fffffffffffffULL; /* subnormal */
    memcpy(&value, &bits, sizeof value);
    expect_round_trip(value);
    expect_round_trip((double)(int64_t)(next_random(&seed) >> 40) / 1000.0);
  }
  static const double special[] = {
      0.0,         -0.0, 5e-324,    DBL_MIN, DBL_MAX,           -DBL_MAX,
      DBL_EPSILON, 0.1,  1.0 / 3.0, 2.442,   9007199254740993.0};
  for (size_t i = 0; i < sizeof special / sizeof special[0]; i++) expect_round_trip(special[i]);
}

static void shortest_text(void **state) {
  (void)state;
  static const struct {
    double value;
    const char *want;
  } cases[] = {{0.1, "0.1"},
               {1e-5, "1e-05"},
               {-2.0, "-2"},
               {0.0, "0"},
               {-0.0, "-0"},
               {100.0, "100"},
               {5e-324, "5e-324"},
               {1e22, "1e+22"},
               {0.3, "0.3"},
               {0.1 + 0.2, "0.30000000000000004"},
               {(double)NAN, "nan"},
               {(double)INFINITY, "inf"},
               {-(double)INFINITY, "-inf"}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    assert_string_equal(ambulo__number_text(cases[i].value).text, cases[i].want);
  }
}

static void what_is_a_number(void **state) {
  (void)state;
  static const struct {
    const char *text;
    double want;
  } good[] = {{"0", 0.0},          {"-0.0", -0.0},
              {"+1.5", 1.5},       {".5", 0.5},
              {"5.", 5.0},         {"1e3", 1000.0},
              {"1E-2", 0.01},      {"0e999", 0.0},
              {"000012", 12.0},    {"2.2250738585072014e-308", DBL_MIN},
              {"4.9e-324", 5e-324}};
  for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
    double value = 7.0;
    if (!ambulo__parse_double(good[i].text, strlen(good[i].text), &value))
      print_error("'%s' was refused\n", good[i].text);
    assert_memory_equal(&value, &good[i].want, sizeof value);
  }
  static const char *const bad[] = {"",       "1,5", "1_000", "7x5",   "1e",    "1e+",
                                    ".",      "-",   "+-1",   "1.2.3", " 1",    "1 ",
                                    "0x10",   "nan", ".nan",  "inf",   "1e999", "-1e999",
                                    "1e-400", "1d3", "--1",   "e5",    "1e5.0", "\xd9\xa1"};
  for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
    double value = 7.0;
    if (ambulo__parse_double(bad[i], strlen(bad[i]), &value))
      print_error("'%s' was read as %g\n", bad[i], value);
    assert_true(value == 7.0);
  }
}

/* ties and 17 digits: what a hand-written scaling loop gets wrong */
static void correctly_rounded(void **state) {
  (void)state;
  static const struct {
    const char *text;
    double want;
  } cases[] = {{"9007199254740993", 9007199254740992.0},
               {"9007199254740993.00000000000000000000000001", 9007199254740994.0},
               {"1.7976931348623157e308", DBL_MAX},
               {"2.4703282292062328e-324", 5e-324},
               {"8.41e21", 8.41e21},
               {"0.500000000000000166533453693773481063544750213623046875", 0x1.0000000000002p-1}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    double value = 0.0;
    assert_true(ambulo__parse_double(cases[i].text, strlen(cases[i].text), &value));
    if (value != cases[i].want) print_error("%s read as %a\n", cases[i].text, value);
    assert_true(value == cases[i].want);
  }
}

static void the_length_is_respected(void **state) {
  (void)state;
  double value = 0.0;
  long long whole = 0;
  assert_true(ambulo__parse_double("1.25e1x", 4, &value));
  assert_true(value == 1.25);
  assert_true(ambulo__parse_integer("1234", 2, 0, 100, &whole));
  assert_int_equal(whole, 12);
  char longest[1000];
  memset(longest, '1', sizeof longest);
  assert_false(ambulo__parse_double(longest, sizeof longest, &value));
}

static void whole_numbers(void **state) {
  (void)state;
  static const char *const bad[] = {"",    "3.5", "-1", "1e30", "9223372036854775808", "101", "+",
                                    "1_0", "0x1", " 1", "1e1",  "99999999999999999999"};
  long long value = 7;
  for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
    if (ambulo__parse_integer(bad[i], strlen(bad[i]), 0, 100, &value))
      print_error("'%s' was read as %lld\n", bad[i], value);
    assert_int_equal(value, 7);
  }
  assert_false(ambulo__parse_integer("9999999999999999999", 19, INT64_MIN, INT64_MAX, &value));
  assert_true(ambulo__parse_integer("-12", 3, -12, 100, &value));
  assert_int_equal(value, -12);
  assert_true(ambulo__parse_integer("+100", 4, 0, 100, &value));
  assert_int_equal(value, 100);
  assert_true(ambulo__parse_integer("000", 3, 0, 100, &value));
  assert_int_equal(value, 0);
}

/* needs a locale with a comma; LOCPATH may name a folder that holds a compiled one */
static void a_comma_locale_changes_nothing(void **state) {
  (void)state;
  static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8"};
  const char *chosen = NULL;
  for (size_t i = 0; !chosen && i < sizeof names / sizeof names[0]; i++)
    chosen = setlocale(LC_ALL, names[i]);
  if (!chosen) {
    print_message("no locale with a decimal comma is installed\n");
    skip();
  }
  char process[32];
  (void)snprintf(process, sizeof process, "%g", 0.5);
  double value = 0.0;
  int read = ambulo__parse_double("2.5", 3, &value);
  int comma = ambulo__parse_double("2,5", 3, &value);
  const ambulo__number number = ambulo__number_text(1234567.125);
  (void)setlocale(LC_ALL, "C");
  assert_string_equal(process, "0,5");
  assert_true(read && !comma && value == 2.5);
  assert_string_equal(number.text, "1234567.125");
}

/* the first of 15 to 17 digits that reads back, as printf writes it */
static void expect_as_printed(double value) {
  char want[AMBULO__NUMTEXT_SIZE];
  for (int digits = 15; digits <= 17; digits++) {
    (void)snprintf(want, sizeof want, "%.*g", digits, value);
    if (strtod(want, NULL) == value) break;
  }
  assert_string_equal(ambulo__number_text(value).text, want);
}

static void numbers_are_those_of_printf(void **state) {
  (void)state;
  uint64_t seed = 88172645463325252ULL;
  for (int decade = -14; decade < 18; decade++) {
    for (int i = 0; i < 3000; i++) {
      seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
      double part = (double)(seed >> 11) / 9007199254740992.0; /* any digits */
      double few = (double)(seed >> 44) / 1048576.0;           /* and few of them */
      double value = (i & 1 ? part : few) * pow(10.0, decade) * (i & 2 ? -1.0 : 1.0);
      expect_as_printed(value);
      expect_as_printed(round(part * 1e6) / 1e6 * pow(10.0, decade));
    }
  }
}

static void edges(void **state) {
  (void)state;
  static const double values[] = {1e-6,
                                  1e-7,
                                  1e-9,
                                  0.1,
                                  0.3,
                                  1e-4,
                                  9.9999999999999991e-5,
                                  1e-5,
                                  0.999999999999999944,
                                  9.999999999999999,
                                  99999999999999.98,
                                  123456789012345680.0,
                                  1e15,
                                  1e16,
                                  1.5,
                                  2.5,
                                  1e-11,
                                  9007199254740991.0,
                                  0.0,
                                  1.0,
                                  0.5,
                                  4503599627370497.5,
                                  1e300,
                                  5e-324,
                                  0.1 + 0.2,
                                  999999999999999.9};
  for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
    for (int k = -3; k <= 3; k++) { /* and the numbers beside them */
      double value = values[i];
      for (int step = 0; step < abs(k); step++)
        value = nextafter(value, k < 0 ? -HUGE_VAL : HUGE_VAL);
      if (fabs(value) < DBL_MIN) continue; /* fewer digits */
      expect_as_printed(value);
      expect_as_printed(-value);
    }
  }
}

static void two_numbers_are_told_apart(void **state) {
  (void)state;
  assert_int_equal(ambulo__digits_apart(3.0, 4.0), 6);
  assert_int_equal(ambulo__digits_apart(3.0, 3.0), 6);
  assert_int_equal(ambulo__digits_apart(3.2475, 3.24750001), 9);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(any_double_survives),
                                     cmocka_unit_test(shortest_text),
                                     cmocka_unit_test(what_is_a_number),
                                     cmocka_unit_test(correctly_rounded),
                                     cmocka_unit_test(the_length_is_respected),
                                     cmocka_unit_test(whole_numbers),
                                     cmocka_unit_test(a_comma_locale_changes_nothing),
                                     cmocka_unit_test(numbers_are_those_of_printf),
                                     cmocka_unit_test(edges),
                                     cmocka_unit_test(two_numbers_are_told_apart)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
