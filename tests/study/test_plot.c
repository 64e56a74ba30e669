/* Drawings of a study: what is joined, what is left out, and that nothing hides or leaves the page.
 */
#include "ambulo/report.h"
#include "study/plot.h"
#include "support/fake_batch.h"
#include "support/messages.h"

static fake_batch b;

static void open_study(void **state, const char *study) {
  assert_int_equal(fake_batch_open(&b, state, study), 0);
}

/* the drawing's text, to be freed */
static char *draw(const char *plot, const char *const *where, int conditions) {
  ambulo_plot_options options = ambulo_plot_options_default();
  char *file = NULL;
  options.where = where;
  options.where_count = conditions;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_batch_plot(b.folder, plot, &options, NULL, list, &file);
  if (status) print_error("%s\n", ambulo_diagnostics_get(list, 0)->message);
  assert_int_equal(status, AMBULO_OK);
  char *text = read_whole(file);
  ambulo_text_free(file, NULL);
  ambulo_diagnostics_free(list);
  return text;
}

static void refuse(const char *plot, const char *condition, const char *message) {
  ambulo_plot_options options = ambulo_plot_options_default();
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  char *file = NULL;
  options.where = &condition;
  options.where_count = 1;
  assert_int_equal(ambulo_batch_plot(b.folder, plot, &options, NULL, list, &file),
                   AMBULO_E_ARGUMENT);
  assert_message(list, 0, message);
  assert_null(file);
  ambulo_diagnostics_free(list);
}

static int count(const char *text, const char *what) {
  int found = 0;
  for (const char *c = text; (c = strstr(c, what)); c++) found++;
  return found;
}

static double attribute(const char *element, const char *name) {
  char lead[32];
  (void)snprintf(lead, sizeof lead, " %s=\"", name);
  const char *at = strstr(element, lead), *end = strchr(element, '>');
  return at && at < end ? strtod(at + strlen(lead), NULL) : 0.0;
}

/* -------------------------------------------------------------------- lines */

/* stature (here a duration) and device (here a name) of four subjects: a table is no path from one
 * subject to the next */
static void only_cases_of_one_device_are_joined(void **state) {
  scratch_write(scratch_path(state, "t.csv"),
                "time.duration,name\n1,stiff\n1.1,soft\n1.2,stiff\n1.3,soft\n");
  open_study(state, "table: t.csv\noutputs: [objective]\n");
  char *text = draw("time.duration:objective", NULL, 0);
  assert_int_equal(count(text, "<circle"), 4 + 2);
  assert_int_equal(count(text, "class=\"thin\""), 2);
  for (const char *c = text; (c = strstr(c, "class=\"thin\""));
       c++) /* stiff to stiff, soft to soft */
    assert_close(attribute(c, "x2") - attribute(c, "x1"), 531.0 * 2.0 / 3.0, 1e-3);
  free(text);
  fake_batch_close(&b);
}

/* as many values on both axes, advancing together by the sweep's own word */
static void axes_that_are_zipped_count_as_one(void **state) {
  static const char axes[] = "axes:\n  - {key: time.duration, name: T, values: [1, 2, 3]}\n"
                             "  - {key: time.intervals, name: n, values: [8, 9, 10]}\n";
  for (int zip = 0; zip < 2; zip++) {
    char study[512];
    (void)snprintf(study, sizeof study, "%soutputs: [objective]\ncombine: %s\n", axes,
                   zip ? "zip" : "grid");
    open_study(state, study);
    char *text = draw("T:objective", NULL, 0);
    assert_int_equal(count(text, "class=\"thin\""), zip ? 2 : 6);
    free(text);
    fake_batch_close(&b);
    (void)scratch_remove_at(AT_FDCWD, b.folder);
  }
}

/* ------------------------------------------------------------------- filters */

#define GRID                                                                                       \
  "axes:\n  - {key: time.duration, name: T, values: [1, 2, 3]}\n"                                  \
  "  - {key: name, name: device, values: [none, brace]}\noutputs: [objective]\n"

static void conditions_take_cases_away(void **state) {
  static const char *const where[] = {"device == brace", "T < 3"};
  static const char *const outputs[] = {"objective >= 1.002", "state == optimal"};
  open_study(state, GRID);
  char *text = draw("T:objective", where, 2);
  assert_int_equal(count(text, "<a href"), 2);
  assert_non_null(strstr(text, ">s, 2 of 6 cases: 2 optimal<"));
  assert_non_null(strstr(text, ">where device == brace and T &lt; 3<"));
  assert_null(strstr(text, ">3<")); /* no case stands there */
  free(text);
  text = draw("T:objective", outputs, 2);
  assert_int_equal(count(text, "<a href"), 4);
  free(text);
  assert_int_equal(access(fake_batch_path(&b, "results_T_objective_where_device____brace_and_T___3"
                                              ".svg"),
                          F_OK),
                   0);
  fake_batch_close(&b);
}

static void conditions_that_mean_nothing_are_refused(void **state) {
  open_study(state, GRID);
  refuse("T:objective", "devise == brace", "did you mean 'device'?");
  refuse("T:objective", "device", "'device' is no comparison; expected NAME < VALUE");
  refuse("T:objective", "device < brace", "compares words by size in case");
  refuse("T:objective", "T > 100", "no number for the output of");
  fake_batch_close(&b);
}

/* --------------------------------------------------------------------- page */

static double letter_of(const char *style) {
  return strstr(style, "title") == style ? 22.0 : 13.0;
}

/* every text lies on the page, as wide as it is estimated */
static void expect_texts_on_page(const char *text) {
  double page = attribute(strstr(text, "<svg"), "width");
  assert_true(page >= 880.0);
  for (const char *c = text; (c = strstr(c, "<text class=\"")); c++) {
    char style[64] = "", label[256] = "";
    const char *from = c + strlen("<text class=\""), *begin = strchr(c, '>') + 1;
    (void)snprintf(style, sizeof style, "%.*s", (int)strcspn(from, "\""), from);
    (void)snprintf(label, sizeof label, "%.*s", (int)strcspn(begin, "<"), begin);
    if (strstr(c, "transform=") && strstr(c, "transform=") < begin) continue;
    double x = attribute(c, "x");
    double width = 0.9 * ambulo__plot_text_width(label, letter_of(style), 0);
    double left = strstr(style, "end") ? x - width : strstr(style, "middle") ? x - width / 2 : x;
    if (left < 0.0 || left + width > page) print_error("off the page: %s\n", label);
    assert_true(left >= 0.0 && left + width <= page);
  }
}

/* circles of the panel do not hide each other */
static void expect_marks_apart(const char *text, int most) {
  double x[256], y[256], r[256];
  int marks = 0;
  for (const char *c = text; (c = strstr(c, "<a href")); c++) {
    const char *circle = strstr(c, "<circle"), *end = strstr(c, "</a>");
    if (!circle || circle > end) continue;
    assert_true(marks < 256);
    x[marks] = attribute(circle, "cx");
    y[marks] = attribute(circle, "cy");
    r[marks++] = attribute(circle, "r");
  }
  assert_int_equal(marks, most);
  for (int i = 0; i < marks; i++)
    for (int k = 0; k < i; k++) assert_true(hypot(x[i] - x[k], y[i] - y[k]) > 1.9 * r[i]);
}

#define LONG_NAME "the_second_of_two_subjects_with_an_ankle_prosthesis_and_a_cane"
#define LONG                                                                                       \
  "axes:\n  - {key: time.duration, name: T, label: a long way to say how long it lasts,\n"         \
  "     unit: seconds of the wall clock, values: [1, 2]}\n"                                        \
  "  - {key: name, name: device, label: 'device, as its maker calls it in the brochure',\n"        \
  "     values: [none, " LONG_NAME "]}\n"                                                          \
  "outputs: [{output: objective, label: what all of this costs the body in the end after all,\n"   \
  "  unit: kg m per week}]\n"

static void long_texts_stay_on_the_page(void **state) {
  static const char *const plots[] = {"T:objective", "device:objective", "T,device:objective",
                                      "device,T:objective"};
  open_study(state, LONG);
  for (size_t i = 0; i < sizeof plots / sizeof *plots; i++) {
    char *text = draw(plots[i], NULL, 0);
    expect_texts_on_page(text);
    assert_non_null(strstr(text, "what all of this costs the body in the end after all in kg m per "
                                 "week<"));
    free(text);
  }
  fake_batch_close(&b);
}

/* names, labels and units of both axes stand at them */
static void axes_have_names_and_units(void **state) {
  open_study(state, "axes:\n  - {key: time.duration, name: T, values: [1, 2]}\n"
                    "  - {key: time.intervals, name: n, label: intervals, unit: pieces,\n"
                    "     values: [8, 9]}\noutputs: [objective, max(tau.pin)]\n");
  char *text = draw("n:max(tau.pin)", NULL, 0);
  assert_non_null(strstr(text, ">intervals in pieces<"));
  assert_non_null(strstr(text, "rotate(-90)\">max(tau.pin) in N m<"));
  assert_non_null(strstr(text, ">T in s<")); /* the legend */
  free(text);
  text = draw("n,T:max(tau.pin)", NULL, 0);
  assert_non_null(strstr(text, "rotate(-90)\">T in s<"));
  assert_non_null(strstr(text, ">N m<")); /* the scale */
  free(text);
  fake_batch_close(&b);
}

/* ten cases of one value at each place: all are seen */
static void equal_cases_do_not_hide_each_other(void **state) {
  assert_int_equal(setenv("FAKE_VALUE", "5", 1), 0);
  open_study(state, "axes:\n  - {key: time.duration, name: T, values: [1, 2]}\n"
                    "  - {key: time.intervals, name: n, range: [8, 17, 1]}\n"
                    "outputs: [objective]\n");
  assert_int_equal(unsetenv("FAKE_VALUE"), 0);
  char *text = draw("T:objective", NULL, 0);
  expect_marks_apart(text, 20);
  expect_texts_on_page(text);
  free(text);
  fake_batch_close(&b);
}

/* dots of the cases of a cell, in rows; smaller ones in small cells */
static void dots_of_a_cell_stand_apart(void **state) {
  open_study(state, "axes:\n  - {key: time.duration, name: T, values: [1, 2]}\n"
                    "  - {key: name, name: device, values: [a, b]}\n"
                    "  - {key: time.intervals, name: n, range: [8, 20, 1]}\n"
                    "outputs: [objective]\n");
  char *text = draw("T,device:objective", NULL, 0);
  expect_marks_apart(text, 52);
  free(text);
  text = draw("T,n:objective", NULL, 0);
  expect_marks_apart(text, 52);
  free(text);
  fake_batch_close(&b);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(only_cases_of_one_device_are_joined), TEST(axes_that_are_zipped_count_as_one),
      TEST(conditions_take_cases_away),          TEST(conditions_that_mean_nothing_are_refused),
      TEST(long_texts_stay_on_the_page),         TEST(axes_have_names_and_units),
      TEST(equal_cases_do_not_hide_each_other),  TEST(dots_of_a_cell_stand_apart)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
