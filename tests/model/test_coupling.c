/* Functions of coupled joints: the spline through its points against the conditions that define it,
 * derivatives against differences, and what no model may have. */
#include "model/coupling.h"

#include "ambulo/model.h"
#include "model/model.h"
#include "support/random_model.h"
#include "support/test.h"

enum { most = 12 };

typedef struct curve {
  double points[2 * most];
  ambulo__piece pieces[most + 1];
  ambulo__coupling coupling;
} curve;

static void curve_make(curve *c, uint64_t seed, int count) {
  random_source source = {seed};
  double x = random_between(&source, -3, 1);
  for (int i = 0; i < count; i++) {
    c->points[2 * i] = x;
    c->points[2 * i + 1] = random_between(&source, -1, 1);
    x += random_between(&source, 0.1, 1);
  }
  ambulo__spline_fill(c->points, count, c->pieces);
  c->coupling = (ambulo__coupling){0, count + 1, c->pieces};
}

/* Through its points, straight beyond its ends; value, slope and curvature go on at inner points.
 */
static void splines_are_smooth_and_straight_outside(void **state) {
  (void)state;
  for (int count = 2; count <= most; count++) {
    curve c;
    curve_make(&c, (uint64_t)count, count);
    double end = c.points[2 * count - 2], slope[3], beside[3];
    for (int i = 0; i < count; i++) {
      double x = c.points[2 * i];
      assert_close(ambulo__coupling_value(&c.coupling, x, slope), c.points[2 * i + 1], 1e-13);
      (void)ambulo__coupling_value(&c.coupling, nextafter(x, -INFINITY), beside);
      assert_close(slope[0], beside[0], 1e-11);
      if (i > 0 && i + 1 < count) assert_close(slope[1], beside[1], 1e-9);
    }
    double low = ambulo__coupling_value(&c.coupling, c.points[0] - 2, slope);
    assert_close(low, c.points[1] - 2 * slope[0], 1e-13);
    assert_true(slope[1] == 0 && slope[2] == 0);
    double high = ambulo__coupling_value(&c.coupling, end + 3, slope);
    assert_close(high, c.points[2 * count - 1] + 3 * slope[0], 1e-12);
    assert_true(slope[1] == 0 && slope[2] == 0);
  }
}

/* What the ends are closed by: a cubic is its own spline, and of three points a parabola. */
static void splines_keep_cubics(void **state) {
  (void)state;
  for (int count = 3; count <= most; count++) {
    curve c;
    curve_make(&c, 40 + (uint64_t)count, count);
    double cube = count == 3 ? 0 : 0.7;
    for (int i = 0; i < count; i++) {
      double x = c.points[2 * i];
      c.points[2 * i + 1] = 0.3 + x * (-1.1 + x * (0.4 + x * cube));
    }
    ambulo__spline_fill(c.points, count, c.pieces);
    for (double t = 0; t <= 1; t += 0.03125) {
      double x = c.points[0] + t * (c.points[2 * count - 2] - c.points[0]), slope[3];
      assert_close(ambulo__coupling_value(&c.coupling, x, slope),
                   0.3 + x * (-1.1 + x * (0.4 + x * cube)), 1e-10);
      assert_close(slope[1], 0.8 + 6 * cube * x, 1e-8);
    }
  }
}

static void check_derivatives(const ambulo__coupling *f, double x) {
  const double h = 1e-3;
  double at[3], left[3], right[3];
  (void)ambulo__coupling_value(f, x, at);
  double before = ambulo__coupling_value(f, x - h, left);
  double after = ambulo__coupling_value(f, x + h, right);
  assert_close((after - before) / (2 * h), at[0], 1e-4 * (1 + fabs(at[2])));
  assert_close((right[0] - left[0]) / (2 * h), at[1], 1e-4 * (1 + fabs(at[2])));
  assert_close((right[1] - left[1]) / (2 * h), at[2], 1e-9 * (1 + fabs(at[1])) / h);
}

static void derivatives_are_those_of_differences(void **state) {
  (void)state;
  curve c;
  curve_make(&c, 7, 9);
  for (int i = 0; i + 1 < 9; i++)
    check_derivatives(&c.coupling, 0.5 * (c.points[2 * i] + c.points[2 * i + 2]));
  ambulo_link link = ambulo_link_default();
  for (int i = 0; i < 5; i++) link.polynomial[i] = 1.0 / (1 + i);
  ambulo__piece piece;
  assert_int_equal(ambulo__coupling_count(&link), 1);
  ambulo__coupling_fill(&link, &piece);
  const ambulo__coupling f = {0, 1, &piece};
  for (double x = -1; x <= 1; x += 0.25) check_derivatives(&f, x);
  assert_close(ambulo__coupling_value(&f, 2, NULL), 1 + 1 + 4.0 / 3 + 2 + 16.0 / 5, 1e-14);
}

/* ------------------------------------------------------------------- in a model */

static ambulo_status build(int coupled_to, ambulo_joint_type type, int count, const double *spline,
                           double coefficient, ambulo_model **model) {
  ambulo_model_definition d = ambulo_model_definition_default();
  ambulo_link links[2] = {ambulo_link_default(), ambulo_link_default()};
  ambulo_coordinate coordinate = ambulo_coordinate_default();
  coordinate.name = links[0].name = "thigh";
  links[1].name = "shank";
  links[0].type = AMBULO_REVOLUTE;
  links[1].type = type;
  links[1].parent = 0;
  links[1].mass = 1;
  links[1].coupled_to = coupled_to;
  links[1].knots = (const double(*)[2])(const void *)spline;
  links[1].knot_count = count;
  links[1].polynomial[1] = coefficient;
  d.links = links;
  d.link_count = 2;
  d.coordinates = &coordinate;
  d.coordinate_count = 1;
  *model = NULL;
  return ambulo_model_create(&d, NULL, NULL, model);
}

static void a_model_keeps_its_functions(void **state) {
  (void)state;
  double spline[] = {0, 1, 1, 3};
  ambulo_model *model = NULL, *copy = NULL;
  assert_int_equal(build(0, AMBULO_PRISMATIC, 2, spline, 0, &model), AMBULO_OK);
  spline[1] = 9;
  assert_int_equal(ambulo_model_coordinate_count(model), 1);
  const ambulo_link *link = ambulo_model_link(model, 1);
  assert_int_equal(link->coordinate, -1);
  assert_int_equal(link->coupled_to, 0);
  assert_close(link->knots[0][1], 1, 0);
  const double q[1] = {0.5};
  assert_close(ambulo__joint_value(model, 1, q, NULL), 2, 1e-15);
  ambulo_conditions conditions = ambulo_conditions_default();
  assert_int_equal(ambulo_model_adapt(model, &conditions, NULL, NULL, &copy), AMBULO_OK);
  ambulo_model_free(model);
  assert_close(ambulo__joint_value(copy, 1, q, NULL), 2, 1e-15);
  ambulo_model_free(copy);
}

static void what_is_no_function_is_refused(void **state) {
  (void)state;
  const double falling[] = {0, 1, 1, 2, 1, 3}, lost[] = {0, 1, NAN, 2}, good[] = {0, 1, 1, 2};
  ambulo_model *model;
  assert_int_equal(build(0, AMBULO_REVOLUTE, 2, good, 0, &model), AMBULO_OK);
  ambulo_model_free(model);
  assert_int_equal(build(0, AMBULO_FIXED, 2, good, 0, &model), AMBULO_E_MODEL);
  assert_int_equal(build(1, AMBULO_REVOLUTE, 2, good, 0, &model), AMBULO_E_MODEL);
  assert_int_equal(build(-1, AMBULO_REVOLUTE, 0, NULL, 0, &model), AMBULO_E_MODEL);
  assert_int_equal(build(0, AMBULO_REVOLUTE, 1, good, 0, &model), AMBULO_E_MODEL);
  assert_int_equal(build(0, AMBULO_REVOLUTE, 3, falling, 0, &model), AMBULO_E_MODEL);
  assert_int_equal(build(0, AMBULO_REVOLUTE, 2, lost, 0, &model), AMBULO_E_MODEL);
  assert_int_equal(build(0, AMBULO_REVOLUTE, 2, NULL, 0, &model), AMBULO_E_MODEL);
  assert_int_equal(build(0, AMBULO_REVOLUTE, 0, NULL, INFINITY, &model), AMBULO_E_MODEL);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(splines_are_smooth_and_straight_outside),
                                     cmocka_unit_test(splines_keep_cubics),
                                     cmocka_unit_test(derivatives_are_those_of_differences),
                                     cmocka_unit_test(a_model_keeps_its_functions),
                                     cmocka_unit_test(what_is_no_function_is_refused)};
  return cmocka_run_group_tests_name("model/coupling", tests, NULL, NULL);
}
