/* Functions of one coordinate: splines against values that OpenSim 4.6 computed, and against what a
 * cubic spline with such ends must reproduce. */
#include "import/osim.h"
#include "support/import_case.h"

static ambulo__arena arena;
static ambulo__xml xml;
static ambulo__tree tree;
static ambulo__osim osim;

/* the function of <holder> in a file; what was read before is forgotten */
static const ambulo__xml_node *function_of(void **state, const char *text) {
  const char *path = scratch_path(state, "f.xml");
  ambulo__arena_free(&arena);
  ambulo_diagnostics_free(xml.diagnostics);
  arena = (ambulo__arena){.allocator = ambulo__allocator_or_default(NULL)};
  xml = (ambulo__xml){.arena = &arena, .diagnostics = ambulo_diagnostics_create(NULL)};
  tree = (ambulo__tree){.arena = &arena, .xml = &xml};
  osim = (ambulo__osim){.tree = &tree, .xml = &xml};
  scratch_write(path, text);
  return ambulo__osim_function(ambulo__xml_load(&xml, path));
}

#define IN(inner) "<holder><function>" inner "</function></holder>"
#define SPLINE(kind, x, y) "<" kind "><x>" x "</x><y>" y "</y></" kind ">"

static void as_opensim(void **state) {
  skip_without_expat();
  static const double six[][2] = {{-3, -0.125615165601078},     {-2.1, -0.032},
                                  {-1.6, 0.004859523244967197}, {-0.5, 0.01347868111942593},
                                  {0.1, 0.0036281474335492694}, {0.9, 0.005085655020520044},
                                  {1.65, 0.027802061598218842}, {1.7, 0.03},
                                  {2.5, 0.06584904426404328}};
  static const double three[][2] = {{-3, -0.3612293956043956},
                                    {-1, -0.02025526556776555},
                                    {0.1, 0.12486263736263736},
                                    {3, 0.35305631868131865}};
  const ambulo__xml_node *f =
      function_of(state, "<holder><SimmSpline><x>-2.1 -1 -0.2 0.4 1 1.7</x><y>-0.032 0.0179 "
                         "0.0083 0.0012 0.007 0.03</y></SimmSpline></holder>");
  for (size_t i = 0; i < sizeof six / sizeof six[0]; i++)
    assert_close(ambulo__osim_value(&osim, f, six[i][0]), six[i][1], 1e-15);
  f = function_of(state, IN(SPLINE("NaturalCubicSpline", "-2.1 -0.5 2.1", "-0.2 0.05 0.3")));
  for (size_t i = 0; i < sizeof three / sizeof three[0]; i++)
    assert_close(ambulo__osim_value(&osim, f, three[i][0]), three[i][1], 1e-15);
  assert_int_equal(xml.status, AMBULO_OK);
}

/* ends closed by the cubic through four points: a cubic is reproduced */
static void a_cubic_is_itself(void **state) {
  skip_without_expat();
  const ambulo__xml_node *f = function_of(
      state, IN(SPLINE("SimmSpline", "-1 0 0.5 2 3", "-3 1 1.5 15 49"))); /* 2x^3 - x^2 + x + 1 */
  for (double x = -1; x <= 3; x += 0.1)
    assert_close(ambulo__osim_value(&osim, f, x), ((2 * x - 1) * x + 1) * x + 1, 1e-13);
}

static void simple_functions(void **state) {
  skip_without_expat();
  assert_close(ambulo__osim_value(
                   &osim, function_of(state, IN("<Constant><value>0.3</value></Constant>")), 5),
               0.3, 0);
  assert_close(
      ambulo__osim_value(
          &osim,
          function_of(state,
                      IN("<LinearFunction><coefficients>2 -1</coefficients></LinearFunction>")),
          3),
      5, 0);
  assert_close(ambulo__osim_value(
                   &osim,
                   function_of(state, IN("<PolynomialFunction><coefficients>1 2 3</coefficients>"
                                         "</PolynomialFunction>")),
                   2),
               11, 0);
  const ambulo__xml_node *f =
      function_of(state, IN(SPLINE("PiecewiseLinearFunction", "0 1 3", "0 2 2")));
  assert_close(ambulo__osim_value(&osim, f, 0.25), 0.5, 0);
  assert_close(ambulo__osim_value(&osim, f, 2), 2, 0);
  assert_close(ambulo__osim_value(&osim, f, -1), -2, 0);
  f = function_of(
      state,
      IN("<MultiplierFunction><scale>3</scale><function><Constant><value>2</value></Constant>"
         "</function></MultiplierFunction>"));
  assert_close(ambulo__osim_value(&osim, f, 0), 6, 0);
}

static void what_is_a_line(void **state) {
  skip_without_expat();
  double slope = 0, offset = 0;
  assert_true(ambulo__osim_is_linear(
      &osim, function_of(state, IN(SPLINE("SimmSpline", "-2 -0.5 0 2", "2 0.5 0 -2"))), &slope,
      &offset));
  assert_close(slope, -1, 0);
  assert_close(offset, 0, 0);
  assert_true(ambulo__osim_is_linear(
      &osim,
      function_of(
          state,
          IN("<MultiplierFunction><scale>3</scale><function><LinearFunction><coefficients>2 -1"
             "</coefficients></LinearFunction></function></MultiplierFunction>")),
      &slope, &offset));
  assert_close(slope, 6, 0);
  assert_close(offset, -3, 0);
  assert_false(ambulo__osim_is_linear(
      &osim, function_of(state, IN(SPLINE("SimmSpline", "0 1 2", "0 1 2.001"))), &slope, &offset));
}

static void faults(void **state) {
  skip_without_expat();
  static const char *const texts[] = {IN(SPLINE("SimmSpline", "0 2 1", "0 1 2")),
                                      IN(SPLINE("SimmSpline", "0 1 2", "0 1")),
                                      IN(SPLINE("SimmSpline", "0", "0")),
                                      IN("<StepFunction/>"),
                                      IN("<SimmSpline/>"),
                                      IN(SPLINE("SimmSpline", "0 1 1", "0 1 2")),
                                      IN(SPLINE("SimmSpline", "0 a", "0 1")),
                                      IN(SPLINE("SimmSpline", "0 1", "0 b")),
                                      IN("<PolynomialFunction><coefficients>1 c</coefficients>"
                                         "</PolynomialFunction>")};
  static const char *const want[] = {
      "<SimmSpline> has 3 x and 3 y; expected as many of both",
      "<SimmSpline> has 3 x and 2 y",
      "<SimmSpline> has 1 x and 1 y",
      "unknown function (got 'StepFunction'); expected one of Constant",
      "<SimmSpline> has 0 x and 0 y",
      "with x rising",
      "x of <x> is not a number (got 'a')",
      "y of <y> is not a number (got 'b')",
      "is not a number (got 'c')"};
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
    double slope, offset;
    const ambulo__xml_node *f = function_of(state, texts[i]);
    assert_int_equal(ambulo__osim_is_linear(&osim, f, &slope, &offset), 0);
    (void)ambulo__osim_value(&osim, function_of(state, texts[i]), 0.5);
    assert_int_equal(xml.status, AMBULO_E_SCHEMA);
    assert_message(xml.diagnostics, 0, want[i]);
  }
}

/* two points are a line, a third makes a spline of it; without an inner function nothing is scaled
 */
static void few_points(void **state) {
  skip_without_expat();
  double slope = 0, offset = 0;
  const ambulo__xml_node *f = function_of(state, IN(SPLINE("SimmSpline", "1 3", "2 8")));
  assert_close(ambulo__osim_value(&osim, f, 2), 5, 1e-15);
  assert_close(ambulo__osim_value(&osim, f, 0), -1, 1e-15);
  assert_true(ambulo__osim_is_linear(&osim, f, &slope, &offset));
  assert_close(slope, 3, 0);
  assert_close(offset, -1, 0);
  f = function_of(state, IN("<MultiplierFunction><scale>3</scale></MultiplierFunction>"));
  assert_close(ambulo__osim_value(&osim, f, 2), 0, 0);
  assert_false(ambulo__osim_is_linear(&osim, f, &slope, &offset));
  f = function_of(state, IN("<PolynomialFunction/>"));
  assert_close(ambulo__osim_value(&osim, f, 2), 0, 0);
  assert_false(ambulo__osim_is_linear(&osim, f, &slope, &offset));
  assert_int_equal(xml.status, AMBULO_OK);
}

/* multipliers of multipliers, to eight levels */
static void nested(void **state) {
  skip_without_expat();
  for (int levels = 7; levels < 11; levels++) {
    char text[2048] = "<holder><function>";
    double slope = 0, offset = 0;
    for (int i = 0; i < levels; i++) strcat(text, "<MultiplierFunction><scale>2</scale><function>");
    strcat(text, "<LinearFunction><coefficients>1 1</coefficients></LinearFunction>");
    for (int i = 0; i < levels; i++) strcat(text, "</function></MultiplierFunction>");
    strcat(text, "</function></holder>");
    const ambulo__xml_node *f = function_of(state, text);
    int read = levels <= 8;
    assert_close(ambulo__osim_value(&osim, f, 1), read ? ldexp(2, levels) : 0, 0);
    assert_int_equal(ambulo__osim_is_linear(&osim, f, &slope, &offset), read);
    if (read) assert_close(offset, ldexp(1, levels), 0);
  }
}

/* what is rounding is taken for what was meant: an offset of zero, a slope of one */
static void what_was_meant(void **state) {
  skip_without_expat();
  double slope = 0, offset = 0;
  assert_true(ambulo__osim_is_linear(
      &osim, function_of(state, IN(SPLINE("SimmSpline", "-1 1", "-1 1.0000000000000002"))), &slope,
      &offset));
  assert_true(slope == 1 && offset == 0);
  assert_true(ambulo__osim_is_linear(
      &osim, function_of(state, IN(SPLINE("SimmSpline", "-1 1", "-1 1.001"))), &slope, &offset));
  assert_close(slope, 1.0005, 1e-15);
  assert_close(offset, 0.0005, 1e-12);
}

/* the first function of a holder, by its name; what is none is passed over */
static void which_function(void **state) {
  skip_without_expat();
  static const struct {
    const char *text, *name;
  } cases[] = {{"<h><note/><axis/><Constant/></h>", "Constant"},
               {"<h><function/><MySpline/></h>", "MySpline"},
               {"<h><Spline/><Function/><Constant/></h>", "Constant"},
               {"<h><AFunction/><Constant/></h>", "AFunction"},
               {"<h><note/></h>", NULL}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    const ambulo__xml_node *f = function_of(state, cases[i].text);
    if (cases[i].name) assert_string_equal(f->name, cases[i].name);
    if (!cases[i].name) assert_null(f);
  }
  assert_null(ambulo__osim_function(NULL));
}

static int shut(void **state) {
  ambulo__arena_free(&arena);
  ambulo_diagnostics_free(xml.diagnostics);
  return scratch_close(state);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(as_opensim),       cmocka_unit_test(a_cubic_is_itself),
      cmocka_unit_test(simple_functions), cmocka_unit_test(what_is_a_line),
      cmocka_unit_test(faults),           cmocka_unit_test(few_points),
      cmocka_unit_test(nested),           cmocka_unit_test(what_was_meant),
      cmocka_unit_test(which_function)};
  return cmocka_run_group_tests(tests, scratch_open, shut);
}
