/* Marks of devices and loads: where they are, and only while they do something. */
#include "show/gait_worn.h"

#include "ambulo/tools/tools.h"
#include "support/test.h"

static const char *const overrides[] = {
    "time.intervals=30", "trajectory.intervals=9",
    "load={link: thorax, mass: 8, position: [-0.1, 0.2, 0]}",
    "devices=[{name: exo_r, kind: spring, coordinate: ankle_angle_r, stiffness: 150, rest: 0, "
    "side: "
    "above, foot: right, engaged: {from: 0.1, to: 0.6}, mirror: true}, {name: band, kind: spring, "
    "between: [{link: foot_r, position: [0.04, 0, 0]}, {link: foot_l, position: [0.04, 0, 0]}], "
    "stiffness: 120, rest: 0}]"};

static void marks_of_what_acts(void **state) {
  (void)state;
  ambulo_problem *p = NULL;
  ambulo__stride s;
  ambulo__worn mark;
  assert_int_equal(ambulo_problem_load("models/walk.yaml", overrides, 4, NULL, NULL, &p),
                   AMBULO_OK);
  double *x = calloc((size_t)p->variables, sizeof *x);
  for (int j = 0; j < p->variables; j++) x[j] = 0.2;
  assert_int_equal(ambulo__stride_create(p, x, 21, NULL, &s), AMBULO_OK);
  assert_int_equal(ambulo__worn_count(&s), 4);
  int seen = 0;
  for (int k = 0; k < s.samples; k++) {
    int acts = ambulo__worn_at(&s, k, 0, &mark);
    assert_int_equal(acts,
                     fabs(s.effort[3 * k]) >= 0.02 * fabs(ambulo__stride_device_work(&s, 0).peak));
    seen |= 1 << acts;
    assert_string_equal(mark.style, "device");
    assert_string_equal(p->model->links[mark.link[0]].name, "ankle_r");
    assert_true(mark.radius > 0);
    assert_true(ambulo__worn_at(&s, k, 1, &mark));
    assert_true(mark.radius == 0.0);
    assert_string_equal(p->model->links[mark.link[1]].name, "foot_l");
    assert_close(mark.at[1][0], 0.04, 0);
    assert_true(ambulo__worn_at(&s, k, 3, &mark));
    assert_string_equal(mark.style, "load");
    assert_close(mark.radius, 0.04, 1e-12);
    assert_close(mark.at[0][1], 0.2, 0);
  }
  assert_int_equal(seen, 3);
  ambulo__stride_free(&s);
  free(x);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(marks_of_what_acts)};
  return cmocka_run_group_tests_name("picture/gait_worn", tests, NULL, NULL);
}
