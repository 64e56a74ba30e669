/* Every fault of a definition of muscles: one message each, that says which muscle, what and how.
 */
#include "muscle/muscles.h"
#include "support/muscle_definition.h"

static void what_is_good_is_taken(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  ambulo_muscles_free(straps_good(&s));
  straps_close(&s);
}

/* both ends of each interval are taken, what lies beyond or is no number is not */
static void numbers(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  ambulo_muscle *m = &s.muscles[1];
  const struct {
    double *number, good[2], bad[2];
    const char *expected;
  } cases[] = {
      {&m->force, {1e-3, 1e6}, {0, 1.1e6}, "b': force (got %s); expected above 0 and at most 1e6"},
      {&m->fiber, {1e-3, 2}, {0, 2.1}, "b': fiber (got %s); expected above 0 and at most 2 m"},
      {&m->tendon, {0, 2}, {-1e-3, 2.1}, "b': tendon (got %s); expected 0 to 2 m"},
      {&m->pennation, {0, 1.4}, {-1e-3, 1.5}, "b': pennation (got %s); expected 0 to 1.4 rad"},
      {&m->passive_strain, {1e-3, 10}, {0, 11}, "b': passive_strain (got %s); expected above 0"},
      {&m->fast_fibers, {0, 1}, {-1e-3, 1.1}, "b': fast_fibers (got %s); expected 0 to 1"},
      {&m->tendon_strain, {1e-3, 1}, {0, 1.1}, "b': tendon_strain (got %s); expected above 0"},
  };
  m->elastic = 1;
  m->tendon_strain = 0.05;
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    double kept = *cases[i].number;
    const double bad[] = {cases[i].bad[0], cases[i].bad[1], NAN, INFINITY, -INFINITY};
    for (int k = 0; k < 2; k++) {
      *cases[i].number = cases[i].good[k];
      ambulo_muscles_free(straps_good(&s));
    }
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
      char want[200], number[32];
      *cases[i].number = bad[k];
      (void)snprintf(number, sizeof number, "%g", bad[k]);
      if (isfinite(bad[k]) && fabs(bad[k]) >= 1e6) (void)snprintf(number, sizeof number, "1100000");
      if (isnan(bad[k])) (void)snprintf(number, sizeof number, "nan");
      const char *format = cases[i].expected, *hole = strstr(format, "%s");
      (void)snprintf(want, sizeof want, "%.*s%s%s", (int)(hole - format), format, number, hole + 2);
      straps_bad(&s, AMBULO_E_MODEL, want);
    }
    *cases[i].number = kept;
  }
  /* a rigid tendon's strain is not looked at */
  m->elastic = -1;
  m->tendon_strain = NAN;
  ambulo_muscles_free(straps_good(&s));
  straps_close(&s);
}

static void coordinates(void **state) {
  (void)state;
  static const struct {
    int count, coordinates[2];
    const char *want;
  } cases[] = {{0, {1, 2}, "b': coordinates (got 0); expected 1 to 4 of them"},
               {5, {1, 2}, "b': coordinates (got 5); expected 1 to 4 of them"},
               {-1, {1, 2}, "b': coordinates (got -1); expected 1 to 4 of them"},
               {2, {1, 1}, "b': a coordinate twice (got 1); expected each once"},
               {2, {1, strap_d}, "b': a coordinate (got 12); expected one of a joint that muscles"},
               {2, {-1, 2}, "b': a coordinate (got -1); expected one of a joint that muscles"},
               {2, {1, strap_d - 1}, "b': a coordinate (got 11); expected one of a joint"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    straps s;
    straps_open(&s);
    s.muscles[1].coordinate_count = cases[i].count;
    memcpy(s.muscles[1].coordinates, cases[i].coordinates, sizeof cases[i].coordinates);
    straps_bad(&s, AMBULO_E_MODEL, cases[i].want);
    straps_close(&s);
  }
}

enum { MANY = AMBULO__MOST_TERMS + 1 };

static void polynomials(void **state) {
  (void)state;
  static unsigned char exponents[MANY][AMBULO_MUSCLE_COORDINATES];
  static double slopes[MANY][3];
  straps s;
  straps_open(&s);
  ambulo_muscle *m = &s.muscles[2];
  ambulo_muscle_pull *p = &s.pulls[2];
  m->exponents = p->exponents = (const unsigned char(*)[AMBULO_MUSCLE_COORDINATES])exponents;
  m->length = &slopes[0][0];
  p->slopes = (const double(*)[3])slopes;
  int *const counts[] = {&m->term_count, &p->term_count};
  for (int which = 0; which < 2; which++) {
    const int bad[] = {0, -1, MANY};
    *counts[which] = MANY - 1;
    ambulo_muscles_free(straps_good(&s));
    for (int k = 0; k < 3; k++) {
      char want[100];
      *counts[which] = bad[k];
      (void)snprintf(want, sizeof want, "c': terms of a polynomial (got %d); expected 1 to 400",
                     bad[k]);
      straps_bad(&s, AMBULO_E_MODEL, want);
    }
    *counts[which] = 1;
  }
  m->exponents = NULL;
  straps_bad(&s, AMBULO_E_MODEL, "c': terms of a polynomial (got 1)");
  m->exponents = (const unsigned char(*)[AMBULO_MUSCLE_COORDINATES])exponents;
  m->length = NULL;
  straps_bad(&s, AMBULO_E_MODEL, "c': terms of a polynomial (got 1)");
  m->length = &slopes[0][0];
  p->exponents = NULL;
  straps_bad(&s, AMBULO_E_MODEL, "c': terms of a polynomial (got 1)");
  p->exponents = (const unsigned char(*)[AMBULO_MUSCLE_COORDINATES])exponents;
  p->slopes = NULL;
  straps_bad(&s, AMBULO_E_MODEL, "c': terms of a polynomial (got 1)");
  straps_close(&s);
}

static void exponents_and_coefficients(void **state) {
  (void)state;
  const double bad[] = {NAN, INFINITY, -INFINITY};
  const char *const names[] = {"nan", "inf", "-inf"};
  straps s;
  straps_open(&s);
  s.muscles[0].term_count = s.muscles[1].term_count = 2; /* the third term is of no one */
  unsigned char own[strap_terms][AMBULO_MUSCLE_COORDINATES] = {{6, 0}, {0, 6}, {0, 0}};
  double length[strap_terms] = {0.3, 0.1, 0.1}, slopes[strap_terms][3] = {{0}};
  s.muscles[1].exponents = s.pulls[1].exponents =
      (const unsigned char(*)[AMBULO_MUSCLE_COORDINATES])own;
  s.muscles[1].length = length;
  s.pulls[1].slopes = (const double(*)[3])slopes;
  ambulo_muscles_free(straps_good(&s));
  own[1][1] = 7;
  straps_bad(&s, AMBULO_E_MODEL, "b': an exponent (got 7); expected 0 to 6");
  own[1][1] = 6;
  for (int k = 0; k < 3; k++) {
    char want[100];
    (void)snprintf(want, sizeof want, "b': a coefficient (got %s); expected a finite number",
                   names[k]);
    double *const numbers[] = {&length[1], &slopes[0][0], &slopes[0][2]};
    for (int i = 0; i < 3; i++) {
      double kept = *numbers[i];
      *numbers[i] = bad[k];
      straps_bad(&s, AMBULO_E_MODEL, want);
      *numbers[i] = kept;
    }
  }
  straps_close(&s);
}

static void mirrors(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  s.muscles[0].mirror = 1;
  s.muscles[1].mirror = 0;
  s.muscles[2].mirror = 2; /* itself, as -1 */
  ambulo_muscles_free(straps_good(&s));
  s.muscles[2].mirror = 3;
  straps_bad(&s, AMBULO_E_MODEL, "muscle 'c': mirror (got 3); expected a muscle");
  s.muscles[2].mirror = -2;
  straps_bad(&s, AMBULO_E_MODEL, "muscle 'c': mirror (got -2); expected a muscle");
  s.muscles[2].mirror = 1;
  straps_bad(&s, AMBULO_E_MODEL,
             "muscle 'c': mirror (got 1); expected a muscle whose mirror image is this one");
  s.muscles[2].mirror = -1;
  s.muscles[0].mirror = -1;
  straps_bad(&s, AMBULO_E_MODEL, "muscle 'b': mirror (got 0); expected a muscle whose mirror");
  straps_close(&s);
}

static void elastic_coordinates(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  s.muscles[1].tendon_strain = 0.05;
  s.muscles[1].elastic = 2;
  ambulo_muscles_free(straps_good(&s));
  for (const int *bad = (const int[]){0, 3, strap_d, -1}; *bad >= 0; bad++) {
    char want[100];
    s.muscles[1].elastic = *bad;
    (void)snprintf(want, sizeof want,
                   "muscle 'b': elastic (got %d); expected a coordinate that the muscle spans",
                   *bad);
    straps_bad(&s, AMBULO_E_MODEL, want);
  }
  straps_close(&s);
}

static void names(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  s.muscles[2].name = "a";
  straps_bad(&s, AMBULO_E_MODEL, "muscle 'a': its name is another's too (got 0)");
  straps_close(&s);
}

/* a cut has one link below, and axes of a link above that */
static void pulls(void **state) {
  (void)state;
  static const struct {
    int link, axes;
    const char *want;
  } cases[] = {
      {strap_d, 0, "c': the link of a pull (got 12); expected a link of the model"},
      {-1, 0, "c': the link of a pull (got -1); expected a link of the model"},
      {4, strap_d, "c': the axes of a pull (got 12); expected a link above its link"},
      {4, -1, "c': the axes of a pull (got -1); expected a link above its link"},
      {4, 4, "c': the axes of a pull (got 4); expected a link above its link"},
      {4, 5, "c': the axes of a pull (got 5); expected a link above its link"},
  };
  straps s;
  straps_open(&s);
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    s.pulls[2].link = cases[i].link;
    s.pulls[2].axes = cases[i].axes;
    straps_bad(&s, AMBULO_E_MODEL, cases[i].want);
  }
  straps_close(&s);
}

/* two muscles cannot mean two cuts by one name: the second would be taken for the first */
static void one_joint_is_one_cut(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  s.pulls[2] = s.pulls[1];
  ambulo_muscles_free(straps_good(&s));
  s.pulls[2].link = 2;
  straps_bad(&s, AMBULO_E_MODEL, "muscle 'c': the link of joint 'q1' (got 2); expected 1");
  s.pulls[2] = s.pulls[1];
  s.pulls[1].link = s.pulls[2].link = 2;
  s.pulls[2].axes = 1;
  straps_bad(&s, AMBULO_E_MODEL, "muscle 'c': the axes of joint 'q1' (got 1); expected 0");
  straps_close(&s);
}

static void counts(void **state) {
  (void)state;
  static ambulo_muscle many[AMBULO__MOST_MUSCLES + 1];
  straps s;
  straps_open(&s);
  s.definition.muscles = many;
  s.definition.muscle_count = AMBULO__MOST_MUSCLES + 1;
  straps_bad(&s, AMBULO_E_MODEL, "number of muscles is out of range (got 1001); expected 1 to");
  s.definition.muscle_count = 0;
  straps_bad(&s, AMBULO_E_MODEL, "number of muscles is out of range (got 0); expected 1 to");
  s.definition.muscle_count = -1;
  straps_bad(&s, AMBULO_E_ARGUMENT, NULL);
  s.definition.muscles = s.muscles;
  s.definition.muscle_count = strap_m;
  s.muscles[2].pull_count = -1;
  straps_bad(&s, AMBULO_E_ARGUMENT, NULL);
  straps_close(&s);
}

/* all faults are told in one go */
static void every_fault_is_told(void **state) {
  (void)state;
  straps s;
  straps_open(&s);
  s.muscles[0].force = -1.0;
  s.muscles[1].fiber = 0.0;
  s.muscles[1].elastic = 4;
  s.muscles[1].tendon_strain = 0.05;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_muscles *muscles = NULL;
  assert_int_equal(ambulo_muscles_create(s.model, &s.definition, NULL, list, &muscles),
                   AMBULO_E_MODEL);
  assert_int_equal(ambulo_diagnostics_count(list), 3);
  assert_message(list, 0, "muscle 'a': force");
  assert_message(list, 1, "muscle 'b': fiber");
  assert_message(list, 2, "muscle 'b': elastic");
  assert_null(muscles);
  ambulo_diagnostics_free(list);
  straps_close(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_is_good_is_taken),
      cmocka_unit_test(numbers),
      cmocka_unit_test(coordinates),
      cmocka_unit_test(polynomials),
      cmocka_unit_test(exponents_and_coefficients),
      cmocka_unit_test(mirrors),
      cmocka_unit_test(elastic_coordinates),
      cmocka_unit_test(names),
      cmocka_unit_test(pulls),
      cmocka_unit_test(one_joint_is_one_cut),
      cmocka_unit_test(counts),
      cmocka_unit_test(every_fault_is_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
