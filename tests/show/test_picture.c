/* Pictures as files: units, axes, people, formats; and what there is to say when one cannot be. */
#include "ambulo/tools/picture.h"
#include "ambulo/tools/load.h"
#include "support/messages.h"
#include "support/scratch.h"
#include "support/walker_result.h"
#include "support/wellformed.h"

#define NORMS "models/norms"

static ambulo_picture_options curves_alone(void) {
  ambulo_picture_options o = ambulo_picture_options_default();
  o.parts = AMBULO_PICTURE_CURVES;
  return o;
}

/* the text of the picture, to be freed */
static char *drawn(void **state, const ambulo_problem *problem, const ambulo_result *result,
                   const ambulo_picture_options *options) {
  ambulo_picture_options o = *options;
  const char *path = scratch_path(state, "picture.svg");
  o.overwrite = 1;
  assert_int_equal(ambulo_picture_write(problem, result, path, &o, NULL, NULL), AMBULO_OK);
  char *svg = read_text(path);
  assert_true(is_xml(svg));
  assert_null(strstr(svg, "nan"));
  return svg;
}

/* what a number at this height of a panel is: by two labels of its axis */
static double value_at(const char *svg, const char *title, double y) {
  const char *at = strstr(svg, title);
  double height[2], value[2];
  if (!at) print_error("no panel '%s'\n", title);
  assert_non_null(at);
  for (int i = 0; i < 2; i++) {
    at = strstr(at, "<text class=\"end\"");
    assert_non_null(at);
    height[i] = strtod(strstr(at, "y=\"") + 3, NULL) - 4.0;
    const char *number = strchr(at, '>') + 1;
    int minus = strncmp(number, "\xe2\x88\x92", 3) == 0;
    value[i] = (minus ? -1.0 : 1.0) * strtod(number + (minus ? 3 : 0), NULL);
    at++;
  }
  return value[0] + (y - height[0]) / (height[1] - height[0]) * (value[1] - value[0]);
}

typedef struct points {
  int count;
  double x[1024], y[1024];
} points;

/* of the first curve of a side behind a title */
static void read_curve(const char *svg, const char *title, const char *style, points *p) {
  const char *at = strstr(svg, title);
  assert_non_null(at);
  at = strstr(at, style);
  assert_non_null(at);
  p->count = 0;
  for (at = strstr(at, " d=\"") + 4; *at != '"' && p->count < 1024;) {
    char *end;
    p->x[p->count] = strtod(at + 1, &end);
    p->y[p->count++] = strtod(end, &end);
    at = end;
  }
  assert_true(p->count > 200);
}

/* a torque per kg is the torque divided by the mass, wherever its axis puts it */
static void per_kg(void **state) {
  walk w;
  walk_open(&w, 12);
  double mass = ambulo__model_weight(w.model) / 9.81;
  ambulo_picture_options o = curves_alone();
  o.powers = 1;
  points p;
  static const char *const titles[2][2] = {
      {"Hip flexion torque, N m<", "Hip flexion power, W<"},
      {"Hip flexion torque, N m/kg<", "Hip flexion power, W/kg<"}};
  double value[2][2];
  for (int kg = 0; kg < 2; kg++) {
    o.per_kg = kg;
    char *svg = drawn(state, w.problem, w.result, &o);
    for (int i = 0; i < 2; i++) {
      read_curve(svg, titles[kg][i], "class=\"left curve\"", &p);
      int lowest = 0;
      for (int k = 0; k < p.count; k++)
        if (p.y[k] > p.y[lowest]) lowest = k;
      value[kg][i] = value_at(svg, titles[kg][i], p.y[lowest]);
    }
    assert_int_equal(strstr(svg, "upward, N/kg") != NULL, kg && strstr(svg, "Ground reaction"));
    free(svg);
  }
  for (int i = 0; i < 2; i++) {
    assert_true(fabs(value[0][i]) > 1.0);
    assert_close(value[1][i] * mass / value[0][i], 1.0, 2e-3);
  }
  walk_close(&w);
}

/* over the cycle of its own foot each leg of a mirrored walk does the same; the axis ends at 100 %
 */
static void percent(void **state) {
  walk w;
  walk_open(&w, 12);
  ambulo_picture_options o = curves_alone();
  o.percent = 1;
  o.norms = NORMS;
  char *svg = drawn(state, w.problem, w.result, &o);
  points left, right;
  read_curve(svg, "Hip flexion, degrees", "class=\"left curve\"", &left);
  read_curve(svg, "Hip flexion, degrees", "class=\"right curve\"", &right);
  double low = INFINITY, high = -INFINITY, compared = 0.0;
  for (int k = 0; k < left.count; k++) {
    low = fmin(low, left.x[k]);
    high = fmax(high, left.x[k]);
    for (int j = 0; j < right.count; j++) {
      if (fabs(left.x[k] - right.x[j]) > 0.015 || fabs(left.y[k] - right.y[j]) > 0.03) continue;
      compared += 1.0;
      break;
    }
  }
  assert_true(compared > 0.98 * (double)left.count);
  char first[64], last[64];
  snprintf(first, sizeof first, "<text class=\"middle\" x=\"%g\"", low);
  snprintf(last, sizeof last, "<text class=\"middle\" x=\"%g\"", high);
  assert_non_null(strstr(svg, first));
  assert_non_null(strstr(svg, last));
  assert_non_null(strstr(strstr(svg, last), ">100 %<"));
  /* one band for both: three angles, and the legend */
  assert_int_equal(occurrences(svg, "class=\"both-people\""), 4);
  assert_int_equal(occurrences(svg, "class=\"left-people\""), 0);
  assert_null(strstr(svg, " s<"));
  free(svg);
  walk_close(&w);
}

/* steps follow each other without a jump that the curve has not anywhere else: lines are short */
static void no_saw_teeth(void **state) {
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_problem_load("models/walk_normal.yaml", NULL, 0, NULL, NULL, &problem),
                   AMBULO_OK);
  assert_int_equal(ambulo__result_create(problem, NULL, &result), AMBULO_OK);
  ambulo_picture_options o = curves_alone();
  char *svg = drawn(state, problem, result, &o);
  points p;
  read_curve(svg, "Knee angle, degrees", "class=\"left curve\"", &p);
  for (int k = 1; k < p.count; k++) assert_true(p.x[k] > p.x[k - 1] && p.x[k] - p.x[k - 1] < 2.0);
  free(svg);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

/* any name: cut where it has no room, whole in the title that programs show */
static void names(void **state) {
  walk w;
  walk_open(&w, 12);
  char name[400] = "Gang <schnell> & l\xc3\xa4nger \xe6\xad\xa9\xe8\xa1\x8c ";
  while (strlen(name) < 380) strcat(name, "and on ");
  const char *kept = w.problem->definition.name;
  w.problem->definition.name = name;
  ambulo_picture_options o = ambulo_picture_options_default();
  o.millimetres = 180.0;
  char *svg = drawn(state, w.problem, w.result, &o);
  assert_non_null(strstr(svg, "Gang &lt;schnell&gt; &amp; l\xc3\xa4nger"));
  assert_non_null(strstr(svg, "and on </title>"));
  const char *title = strstr(svg, "<text class=\"title\"");
  assert_non_null(title);
  const char *dots = strstr(title, "\xe2\x80\xa6</text>");
  assert_non_null(dots);
  assert_true(dots < strchr(title, '\n'));
  assert_non_null(strstr(svg, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"180mm\""));
  free(svg);
  w.problem->definition.name = kept;
  walk_close(&w);
}

/* strip and curves are the parts of the whole */
static void parts(void **state) {
  walk w;
  walk_open(&w, 12);
  for (int part = 0; part < 3; part++) {
    ambulo_picture_options o = ambulo_picture_options_default();
    o.parts = (ambulo_picture_parts)part;
    char *svg = drawn(state, w.problem, w.result, &o);
    assert_int_equal(occurrences(svg, "class=\"figure\"") > 0, part != AMBULO_PICTURE_CURVES);
    assert_int_equal(occurrences(svg, "class=\"left curve\"") > 0, part != AMBULO_PICTURE_STRIP);
    free(svg);
  }
  walk_close(&w);
}

/* -------------------------------------------------------------------- formats */

static int has_converter(void) {
  if (system("rsvg-convert --version >/dev/null 2>&1") == 0) return 1;
  print_message("skipped: no rsvg-convert\n");
  return 0;
}

static int begins(const char *path, const char *signature) {
  char start[8] = "";
  FILE *file = fopen(path, "rb");
  assert_non_null(file);
  size_t count = fread(start, 1, strlen(signature), file);
  fclose(file);
  return count == strlen(signature) && memcmp(start, signature, count) == 0;
}

static void formats(void **state) {
  walk w;
  if (!has_converter()) skip();
  walk_open(&w, 12);
  ambulo_picture_options o = ambulo_picture_options_default();
  o.dots_per_inch = 48.0;
  const char *pdf = scratch_path(state, "a.pdf");
  assert_int_equal(ambulo_picture_write(w.problem, w.result, pdf, &o, NULL, NULL), AMBULO_OK);
  assert_true(begins(pdf, "%PDF-"));
  const char *png = scratch_path(state, "a.PNG");
  assert_int_equal(ambulo_picture_write(w.problem, w.result, png, &o, NULL, NULL), AMBULO_OK);
  assert_true(begins(png, "\x89PNG\r\n"));
  unsigned char head[24];
  FILE *file = fopen(png, "rb");
  assert_non_null(file);
  assert_int_equal(fread(head, 1, sizeof head, file), sizeof head);
  fclose(file);
  assert_int_equal(head[18] * 256 + head[19], 600); /* 1200 px at half the usual 96 to the inch */
  /* what is there is kept */
  assert_int_equal(ambulo_picture_write(w.problem, w.result, pdf, &o, NULL, NULL), AMBULO_E_IO);
  walk_close(&w);
}

static void expect_error(void **state, const char *source, const char *output, ambulo_status want,
                         const char *words) {
  char path[SCRATCH_PATH];
  snprintf(path, sizeof path, "%s", scratch_path(state, output));
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_picture_convert(source, path, NULL, NULL, list), want);
  char text[1024] = "";
  assert_true(ambulo_diagnostics_count(list) > 0);
  ambulo_diagnostics_format(list, 0, text, sizeof text);
  if (!strstr(text, words)) print_error("%s\n", text);
  assert_non_null(strstr(text, words));
  assert_int_not_equal(access(path, F_OK), 0);
  ambulo_diagnostics_free(list);
}

static void what_cannot_be(void **state) {
  char good[SCRATCH_PATH], bad[SCRATCH_PATH];
  snprintf(good, sizeof good, "%s", scratch_path(state, "good.svg"));
  snprintf(bad, sizeof bad, "%s", scratch_path(state, "bad.svg"));
  scratch_write(good, "<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'/>");
  scratch_write(bad, "<svg");
  expect_error(state, good, "a.jpg", AMBULO_E_ARGUMENT, "expected one that ends with .svg");
  expect_error(state, "Makefile", "a.svg", AMBULO_E_PARSE, "no picture");
  expect_error(state, "nowhere", "a.svg", AMBULO_E_IO, "nowhere");
  if (has_converter())
    expect_error(state, bad, "a.png", AMBULO_E_IO, "rsvg-convert made no picture");
  char *path = strdup(getenv("PATH"));
  assert_non_null(path);
  setenv("PATH", "/nowhere", 1);
  expect_error(state, good, "a.pdf", AMBULO_E_IO, "made by rsvg-convert, which is not on PATH");
  expect_error(state, good, "a.pdf", AMBULO_E_IO, "apt-get install librsvg2-bin");
  setenv("PATH", path, 1);
  free(path);
  ambulo_picture_options o = ambulo_picture_options_default();
  o.dots_per_inch = 0.0;
  assert_int_equal(ambulo_picture_convert(good, "x.svg", &o, NULL, NULL), AMBULO_E_ARGUMENT);
}

/* options beyond their bounds, names that end otherwise: nothing is written */
static void arguments(void **state) {
  walk w;
  walk_open(&w, 12);
  const char *output = scratch_path(state, "a.svg");
  for (int i = 0; i < 15; i++) {
    ambulo_picture_options o = ambulo_picture_options_default();
    if (i == 0) o.size = 0;
    if (i == 1) o.parts = (ambulo_picture_parts)-1;
    if (i == 2) o.parts = (ambulo_picture_parts)(AMBULO_PICTURE_CURVES + 1);
    if (i == 3) o.millimetres = 0.0;
    if (i == 4) o.millimetres = -1.0;
    if (i == 5) o.millimetres = 2000.5;
    if (i == 6) o.dots_per_inch = 9.5;
    if (i == 7) o.dots_per_inch = 2400.5;
    const char *name = i == 8    ? NULL
                       : i == 9  ? "svg"
                       : i == 10 ? ".svg"
                       : i == 11 ? "a.svgz"
                                 : output;
    ambulo_status status =
        ambulo_picture_write(i == 12 ? NULL : w.problem, i == 13 ? NULL : w.result, name,
                             i == 14 ? NULL : &o, NULL, NULL);
    assert_int_equal(status, i == 14 ? AMBULO_OK : AMBULO_E_ARGUMENT);
    if (i < 12 && i != 8)
      assert_int_equal(ambulo_picture_convert("a", name, &o, NULL, NULL), AMBULO_E_ARGUMENT);
  }
  assert_int_equal(ambulo_picture_convert(NULL, output, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(entries_in(*state), 1); /* with the defaults */
  walk_close(&w);
}

/* what is there and not empty is kept; an empty file is none */
static void what_is_there(void **state) {
  walk w;
  walk_open(&w, 12);
  char path[SCRATCH_PATH];
  (void)snprintf(path, sizeof path, "%s", scratch_path(state, "a.svg"));
  scratch_write(path, "mine\n");
  assert_int_equal(ambulo_picture_write(w.problem, w.result, path, NULL, NULL, NULL), AMBULO_E_IO);
  assert_file_equal(path, "mine\n");
  scratch_write(path, "");
  assert_int_equal(ambulo_picture_write(w.problem, w.result, path, NULL, NULL, NULL), AMBULO_OK);
  (void)snprintf(path, sizeof path, "%s/folder.svg", (const char *)*state);
  assert_int_equal(mkdir(path, 0777), 0);
  assert_int_equal(ambulo_picture_write(w.problem, w.result, path, NULL, NULL, NULL), AMBULO_E_IO);
  walk_close(&w);
}

/* curves of people by hand: that are not there, of another joint, behind a motion that is no walk
 */
static void curves_of_people(void **state) {
  walk w;
  walk_open(&w, 12);
  char table[SCRATCH_PATH];
  (void)snprintf(table, sizeof table, "%s", scratch_path(state, "people.csv"));
  const char *output = scratch_path(state, "a.svg");
  ambulo_picture_options o = ambulo_picture_options_default();
  o.overwrite = 1;
  o.reference = table;
  assert_int_equal(ambulo_picture_write(w.problem, w.result, output, &o, NULL, NULL), AMBULO_E_IO);
  scratch_write(table, "variable,percent,mean_deg,sd_deg\npelvic_tilt,0,1,2\n"
                       "pelvic_tilt,50,2,2\npelvic_tilt,100,1,2\n");
  for (int parts = 0; parts < 3; parts++) {
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    o.parts = (ambulo_picture_parts)parts;
    ambulo_status status = ambulo_picture_write(w.problem, w.result, output, &o, NULL, list);
    assert_int_equal(status, AMBULO_OK);
    assert_int_equal(ambulo_diagnostics_count(list), parts != AMBULO_PICTURE_STRIP);
    if (parts != AMBULO_PICTURE_STRIP)
      assert_message(list, 0,
                     "people.csv: warning: none of its curves is one that the picture has");
    ambulo_diagnostics_free(list);
  }
  walk_close(&w);
}

#define WITH_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_open, scratch_close)

int main(void) {
  const struct CMUnitTest tests[] = {WITH_SCRATCH(per_kg),         WITH_SCRATCH(percent),
                                     WITH_SCRATCH(no_saw_teeth),   WITH_SCRATCH(names),
                                     WITH_SCRATCH(parts),          WITH_SCRATCH(formats),
                                     WITH_SCRATCH(what_cannot_be), WITH_SCRATCH(arguments),
                                     WITH_SCRATCH(what_is_there),  WITH_SCRATCH(curves_of_people)};
  return cmocka_run_group_tests_name("picture/picture", tests, NULL, NULL);
}
