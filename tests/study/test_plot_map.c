/* Heat maps of cells of any size: dots that do not hide each other, and stay in their cell. */
#include "study/plot.h"
#include "show/svg.h"
#include "support/test.h"

enum { MOST = 4000, COLUMNS = AMBULO__LISTING_AXES + 2 };

/* a drawing of x values by y values, each with `cases` cases; *side: of a cell, px */
static char *draw(int x, int y, int cases, double cell[2]) {
  static char number[100][16], *label = (char *)(uintptr_t) "", *output = (char *)(uintptr_t) "o";
  static const char *text[(MOST + 1) * COLUMNS];
  static ambulo__plot_point point[MOST];
  char *labels[] = {label, label};
  ambulo__listing l = {.allocator = ambulo__allocator_or_default(NULL),
                       .cell = text,
                       .columns = COLUMNS,
                       .cases = x * y * cases,
                       .name = label,
                       .output = &output,
                       .output_label = &output,
                       .output_unit = &label,
                       .axis_label = labels,
                       .axis_unit = labels,
                       .outputs = 1,
                       .axes = 2};
  assert_true(l.cases <= MOST);
  for (int i = 0; i < 100; i++) (void)snprintf(number[i], sizeof number[i], "%d", i);
  for (int k = 0; k < l.cases; k++) {
    const char **row = &text[(k + 1) * COLUMNS];
    for (int i = 0; i < AMBULO__LISTING_AXES; i++) row[i] = "id";
    row[AMBULO__LISTING_AXES] = number[k / cases % x];
    row[AMBULO__LISTING_AXES + 1] = number[k / cases / x];
    point[k] = (ambulo__plot_point){.index = k,
                                    .place = {k / cases % x, k / cases / x},
                                    .has_value = 1,
                                    .valid = 1,
                                    .value = k % 7,
                                    .state = "optimal"};
  }
  ambulo__plot p = {.listing = &l, .point = point, .points = l.cases, .values = l.cases};
  p.high = 6.0;
  for (int i = 0; i < 2; i++)
    assert_int_equal(
        ambulo__plot_axis_make(&l, point, l.cases, AMBULO__LISTING_AXES + i, &p.axis[i]),
        AMBULO_OK);
  ambulo__text_buffer svg;
  ambulo__text_init(&svg, NULL);
  assert_int_equal(ambulo__plot_map(&p, &svg), AMBULO_OK);
  for (int i = 0; i < 2; i++) ambulo__plot_axis_free(&l, &p.axis[i]);
  cell[0] = 590.0 / x;
  cell[1] = 360.0 / y;
  return svg.data;
}

static double attribute(const char *element, const char *name) {
  char lead[32];
  (void)snprintf(lead, sizeof lead, " %s=\"", name);
  const char *at = strstr(element, lead);
  return at ? strtod(at + strlen(lead), NULL) : 0.0;
}

static void dots_fit_or_are_left_out(void **state) {
  (void)state;
  static const int shapes[][3] = {{1, 1, 1},   {2, 2, 3},    {3, 3, 100}, {5, 20, 12},
                                  {20, 5, 30}, {12, 12, 25}, {2, 30, 60}, {30, 2, 60}};
  int with = 0, without = 0;
  for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
    double cell[2], x[MOST], y[MOST], r = 0.0;
    char *text = draw(shapes[s][0], shapes[s][1], shapes[s][2], cell);
    int dots = 0;
    for (const char *c = text; (c = strstr(c, "<circle")); c++) {
      x[dots] = attribute(c, "cx");
      y[dots] = attribute(c, "cy");
      r = attribute(c, "r");
      for (int k = dots - 1; k >= 0 && k >= dots - shapes[s][2]; k--)
        assert_true(hypot(x[dots] - x[k], y[dots] - y[k]) > 2.0 * r);
      dots++;
    }
    int cases = shapes[s][0] * shapes[s][1] * shapes[s][2];
    assert_true(dots == 0 || dots == cases);
    with += dots > 0;
    without += dots == 0;
    /* those of a cell, one after the other, keep within a cell's height and width */
    for (int k = 0; k < dots; k += shapes[s][2]) {
      for (int i = 1; i < shapes[s][2]; i++) {
        assert_true(fabs(x[k + i] - x[k]) < cell[0]);
        assert_true(fabs(y[k + i] - y[k]) < 0.5 * cell[1]);
      }
    }
    free(text);
  }
  assert_true(with >= 2 && without >= 3);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(dots_fit_or_are_left_out)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
